"""Figures of the report: a function draws what it is given and returns its axes.

Nothing is computed here and nothing is shown; ``plt.style.use("suspension.figures.report")`` sets
the style. One module for each subject: `regression`, `stability`, `forces`, `signals`, `errors`,
`speeds`, `similarity`, `air`, `measured`, `choice`, and `robot`, the robot itself, still or
moving.
"""

from suspension.figures.air import plot_energy, plot_free_wheels, plot_heaviest_wheel
from suspension.figures.choice import (
    plot_demand_map,
    plot_front,
    plot_gains,
    plot_margins,
    plot_rides,
    plot_ripples,
    plot_rough_ride,
)
from suspension.figures.errors import plot_errors, plot_heave, plot_missed_dip, plot_seen_mode
from suspension.figures.forces import plot_all_forces, plot_flight, plot_forces
from suspension.figures.measured import (
    plot_measured_margins,
    plot_measured_run,
    plot_spring_laws,
    plot_stop_stiffness,
)
from suspension.figures.regression import (
    plot_confidence_region,
    plot_experiments,
    plot_fit,
    plot_residuals,
)
from suspension.figures.robot import RobotDrawing, animate_robot, film, plot_contact_states
from suspension.figures.signals import plot_pitch, plot_road_signal, plot_slopes
from suspension.figures.similarity import (
    plot_chart,
    plot_comb,
    plot_paths,
    plot_vehicles,
    plot_window,
)
from suspension.figures.speeds import (
    plot_branches,
    plot_margin,
    plot_margin_map,
    plot_sampled_margin,
    plot_sensitivities,
    plot_travel,
)
from suspension.figures.stability import plot_growth, plot_near_zero, plot_stability

__all__ = [
    "RobotDrawing",
    "animate_robot",
    "film",
    "plot_all_forces",
    "plot_branches",
    "plot_chart",
    "plot_comb",
    "plot_confidence_region",
    "plot_contact_states",
    "plot_demand_map",
    "plot_energy",
    "plot_errors",
    "plot_experiments",
    "plot_fit",
    "plot_flight",
    "plot_forces",
    "plot_free_wheels",
    "plot_front",
    "plot_gains",
    "plot_growth",
    "plot_heave",
    "plot_heaviest_wheel",
    "plot_margin",
    "plot_margin_map",
    "plot_margins",
    "plot_measured_margins",
    "plot_measured_run",
    "plot_missed_dip",
    "plot_near_zero",
    "plot_paths",
    "plot_pitch",
    "plot_residuals",
    "plot_rides",
    "plot_ripples",
    "plot_road_signal",
    "plot_rough_ride",
    "plot_sampled_margin",
    "plot_seen_mode",
    "plot_sensitivities",
    "plot_slopes",
    "plot_spring_laws",
    "plot_stability",
    "plot_stop_stiffness",
    "plot_travel",
    "plot_vehicles",
    "plot_window",
]
