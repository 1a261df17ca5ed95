"""A half-robot on springs and dampers that drives over a bump (MIT 2.086, Problem Set 4).

The model and its time loop, which the ten questions ask for:

- `problem`: the facts of the problem set
- `robot`, `road`, `schemes`: the matrices, the ground, one-step methods as Butcher tableaux
- `forces`, `simulation`: what the wheels press with, and the motion step by step
- `springs`, `course`: the regression, and the problem set's own functions by its names

What goes beyond:

- `exact`: the crossing of a bump in closed form
- `least_force`, `critical`: its least forces, and the speeds at which they vanish
- `contact`: all that answers "does a wheel leave the ground?", in one place
- `profiles`: the same over a road in pieces, one that was measured or drawn
- `similarity`: one chart for every speed, bump and robot, and its limits by hand
- `vehicles`: published vehicles on it
- `flight`: what happens after it has
- `tyre`: wheels that weigh something, and how light they must be
- `energy`: what the road puts in, and where it goes
- `spring_law`: the spring with its preload, its curvature and an end stop
- `motion`, `extremes`, `sweep`: very many runs at once, on a ground that only pushes
- `frequency`: what the robot makes of waves in the road, and of rough roads
- `rides`: rides on many rough roads at once
- `choice`: what a suspension must do, and the least change that does it
- `travel`, `accuracy`, `branches`, `uncertainty`: how far the answers can be trusted
- `small_angle`: what a pitch that is not small changes
- `measured`: which verdicts the measured spring leaves standing

And what makes a book of it: `figures`, `animation`, `report`, `explorer`, and `practice`, which
checks what a student writes in the workbook. These draw and write, and nothing above imports them;
`explore`, a picture with sliders, is loaded when it is first used.

>>> import suspension
>>> robot = suspension.Robot(k1=800, k2=800)
>>> suspension.simulate(robot, suspension.GaussianBump(), v=1.2, dt=0.001, tfinal=1).loss
Loss(wheel=2, t=0.177)
"""

from typing import TYPE_CHECKING

from suspension.contact import regimes
from suspension.critical import critical_speeds
from suspension.exact import over_bump
from suspension.flight import fly
from suspension.least_force import margin
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.schemes import BACKWARD_EULER, CRANK_NICOLSON, EULER, RK4, Scheme
from suspension.similarity import highest_bump
from suspension.simulation import simulate

__version__ = "2.0.0"

__all__ = [
    "BACKWARD_EULER",
    "CRANK_NICOLSON",
    "EULER",
    "RK4",
    "FlatRoad",
    "GaussianBump",
    "Robot",
    "Scheme",
    "critical_speeds",
    "explore",
    "fly",
    "highest_bump",
    "margin",
    "over_bump",
    "regimes",
    "simulate",
]

if TYPE_CHECKING:
    from suspension.explorer import explore
else:

    def __getattr__(name):
        # Widgets and figures take longer to load than all the rest, and most runs need none.
        if name == "explore":
            from suspension.explorer import explore

            return explore
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
