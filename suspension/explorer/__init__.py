"""Live sliders: the robot, the forces and the stability region, with a kernel or without.

Python computes the matrices and the road, the browser iterates them and draws. So the built page
needs no kernel and holds no physics: any `Robot` and any road work in it, and what it shows is
what `suspension.simulation.simulate` computes.
"""

import io
import json
import re
from pathlib import Path
from urllib.parse import quote

import anywidget
import ipywidgets
import matplotlib.pyplot as plt
import numpy as np
import traitlets

from suspension import _checks
from suspension.explorer.tables import region, road_table, robot_table, step_table, vary_stiffness
from suspension.figures import RobotDrawing, plot_forces, plot_stability
from suspension.forces import WHEEL
from suspension.schemes import CRANK_NICOLSON, RK4
from suspension.simulation import simulate

__all__ = ["DTS", "SCHEMES", "Explorer", "ExplorerBox", "explore"]

SCHEMES = (CRANK_NICOLSON, RK4)
# Whole multiples of the last one, so that every run can be compared with it sample by sample.
DTS = (0.2, 0.1, 0.08, 0.07, 0.06, 0.05, 0.02, 0.01, 0.005, 0.0025, 0.002, 0.001, 0.0005, 0.00025)
VMIN, VMAX = 0.1, 25.0
MOMENTS = 1000  # stops of the time slider
PAGE = Path(__file__).parent / "page"
SCRIPTS = ("model.js", "pen.js", "panels.js", "view.js")
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"


class Explorer(anywidget.AnyWidget):
    """The linked picture at the current settings.

    Attributes
    ----------
    v : float
        Speed, m/s.
    dt_index, k_index, scheme_index : int
        Places in `DTS`, `robots` and `SCHEMES`.
    time : int
        The moment shown, in thousandths of the run.
    view : str
        The panel drawn largest: "forces", "stability" or "robot".
    robots : list of Robot
        The given robot with every stiffness that the slider offers.
    """

    # One module for the browser, kept as four files for its readers.
    _esm = "".join((PAGE / name).read_text(encoding="utf-8") for name in SCRIPTS)
    _css = (PAGE / "explorer.css").read_text(encoding="utf-8")

    v = traitlets.Float(1.2).tag(sync=True)
    dt_index = traitlets.Int(0).tag(sync=True)
    k_index = traitlets.Int(0).tag(sync=True)
    scheme_index = traitlets.Int(0).tag(sync=True)
    time = traitlets.Int(0).tag(sync=True)
    view = traitlets.Unicode("forces").tag(sync=True)
    facts = traitlets.Dict().tag(sync=True)
    tables = traitlets.Dict().tag(sync=True)

    def __init__(self, robots, road, distance, **settings):
        self.robots, self.road, self.distance = robots, road, distance
        # A run may end one step past `distance`, and the front wheel is further ahead.
        start, stop = -robots[0].L1, distance + VMAX * DTS[0] + robots[0].L2
        tables = {"road": road_table(road, start, stop), "robots": robot_table(robots)}
        tables |= {scheme.name: step_table(scheme, robots, DTS) for scheme in SCHEMES}
        # What every run is compared with: the highest order that is stable at the finest step.
        stable = [scheme for scheme in SCHEMES if tables[scheme.name][:, -1, -1].all()]
        super().__init__(
            facts={
                "distance": distance,
                "wheels": [start, robots[0].L2],
                "road": [start, (stop - start) / len(tables["road"]), len(tables["road"][0])],
                "dts": DTS,
                "finest": SCHEMES.index(max(stable, key=lambda scheme: scheme.order)),
                "moments": MOMENTS,
                "schemes": [
                    {"name": s.name, "c": np.unique(s.c).tolist(), "region": region(s)}
                    for s in SCHEMES
                ],
            },
            tables={name: table.astype("<f8").tobytes() for name, table in tables.items()},
            **settings,
        )

    @property
    def robot(self):
        """The robot with the current stiffness."""
        return self.robots[self.k_index]

    def trajectory(self):
        """The run at the current settings, as Python computes it.

        Returns
        -------
        suspension.simulation.Trajectory
        """
        return simulate(
            self.robot, self.road, v=self.v, dt=DTS[self.dt_index],
            tfinal=self.distance / self.v, scheme=SCHEMES[self.scheme_index],
        )  # fmt: skip


class ExplorerBox(ipywidgets.VBox):
    """The sliders above the `Explorer` they move; ``box.explorer`` is the latter.

    A page shows a still picture of the same settings until its scripts run, or where they do not.
    """

    def __init__(self, explorer, controls):
        self.explorer = explorer
        super().__init__([controls, explorer])
        self.add_class("suspension-explorer-box")

    def _repr_mimebundle_(self, **kwargs):
        bundle = super()._repr_mimebundle_(**kwargs)
        view = json.dumps(bundle[WIDGET_VIEW])
        bundle["text/html"] = f'{still(self.explorer)}<script type="{WIDGET_VIEW}">{view}</script>'
        return bundle


def explore(
    robot, road, *, v=1.2, dt=0.001, k=None, scheme=RK4, time=None, view="forces", distance=1.25
):
    """Sliders for speed, step, stiffness and scheme, and a picture that follows them.

    Parameters
    ----------
    robot : Robot
        Its own stiffness is marked on the slider; the others keep the ratio k2 / k1.
    road : callable
        ``road(x) -> (H, dHdx)``.
    v : float
        Speed to start with, m/s, 0.1 to 25.
    dt : float
        Time step to start with, s, one of `DTS`.
    k : float, optional
        Rear stiffness to start with, N/m; the slider's nearest is taken, the robot's own if None.
    scheme : Scheme
        One of `SCHEMES`.
    time : float, optional
        The moment to show first, a fraction of the run; that of the loss of contact, or of the
        smallest force, if None.
    view : {"forces", "stability", "robot"}
        The panel drawn largest.
    distance : float
        How far the robot drives, m.

    Returns
    -------
    ExplorerBox
        ``box.explorer.trajectory()`` is the run at the sliders' current settings.

    Raises
    ------
    ValueError
        If an argument is not in its range.
    """
    robots, own = vary_stiffness(robot)
    k = robot.k1 if k is None else _checks.positive("k", k)
    names = [known.name for known in SCHEMES]
    explorer = Explorer(
        robots,
        road,
        _checks.positive("distance", distance),
        v=_checks.number("v", v, f"{VMIN} to {VMAX} m/s", lambda v: VMIN <= v <= VMAX),
        dt_index=DTS.index(_checks.one_of("dt", dt, DTS)),
        k_index=int(np.argmin([abs(other.k1 - k) for other in robots])),
        scheme_index=names.index(_checks.one_of("scheme", getattr(scheme, "name", scheme), names)),
        view=_checks.one_of("view", view, ("forces", "stability", "robot")),
    )
    if time is None:
        run = explorer.trajectory()
        t = run.loss.t if run.loss else run.T[run.N.min(axis=0).argmin()]
        time = min(t * v / distance, 1)
    time = _checks.number("time", time, "a fraction from 0 to 1", lambda time: 0 <= time <= 1)
    explorer.time = round(MOMENTS * time)
    return ExplorerBox(explorer, _controls(explorer, own))


def _controls(explorer, own):
    stiffness = [
        f"{r.k1:.0f}" if r.k1 == r.k2 else f"{r.k1:.0f} and {r.k2:.0f}" for r in explorer.robots
    ]
    stiffness[own] += " (fitted)"
    controls = {
        "v": ipywidgets.FloatLogSlider(
            explorer.v, min=np.log10(VMIN), max=np.log10(VMAX), readout_format=".3g",
            step=0,  # any other would round a typed value
        ),
        "dt_index": ipywidgets.SelectionSlider(
            options=[f"{1000 * dt:g}" for dt in DTS], index=explorer.dt_index
        ),
        "k_index": ipywidgets.SelectionSlider(options=stiffness, index=explorer.k_index),
        "scheme_index": ipywidgets.ToggleButtons(
            options=[scheme.name for scheme in SCHEMES], index=explorer.scheme_index
        ),
        "time": ipywidgets.IntSlider(explorer.time, max=MOMENTS, readout=False),
    }  # fmt: skip
    labels = ["Speed v (m/s)", "Step Δt (ms)", "Stiffness k (N/m)", "Scheme", "Moment"]
    for (trait, control), label in zip(controls.items(), labels, strict=True):
        control.description = label
        control.layout.width = "auto"
        source = (control, "index" if trait.endswith("index") else "value")
        ipywidgets.jslink(source, (explorer, trait))
    controls["v"].add_class("se-typed")
    return ipywidgets.Box(list(controls.values()))


def still(explorer):
    """The same picture as an HTML image, with a text for those who cannot see it."""
    run, robot = explorer.trajectory(), explorer.robot
    lifts = f"the {WHEEL[run.loss.wheel]} wheel leaves the ground" if run.loss else "no wheel lifts"
    stable = run.scheme.is_stable(robot.eigenvalues, run.dt)
    text = (
        f"The robot on the road, both normal forces and the stability region of {run.scheme.name}: "
        f"at {run.v:g} metres per second {lifts}, the smallest force is {run.N.min():.3g} newtons, "
        f"and a step of {1000 * run.dt:g} milliseconds is {'' if stable else 'un'}stable."
    )
    with plt.style.context("suspension.figures.report"):
        figure, axes = plt.subplot_mosaic(
            [["robot", "robot"], ["forces", "stability"]], figsize=(7.2, 4.8),
            height_ratios=[1, 1.6], width_ratios=[1.7, 1],
        )  # fmt: skip
        n = min(round(explorer.time / MOMENTS * explorer.distance / run.v / run.dt), len(run.T) - 1)
        drawing = RobotDrawing(axes["robot"], robot, explorer.road)
        drawing.ground(run.X[n] - 3 * robot.L1, run.X[n] + 3 * robot.L2)
        drawing.update(run.W[:, n], run.X[n])
        plot_forces(run, axes["forces"])
        plot_stability(run.scheme, robot.eigenvalues, [run.dt], ax=axes["stability"])
        axes["stability"].legend().remove()
        picture = io.StringIO()
        figure.savefig(picture, format="svg")
        plt.close(figure)
    # A hundredth of a point is enough, and text that is not base64 is easily compressed.
    picture = re.sub(r"(\d\.\d\d)\d+", r"\1", picture.getvalue())
    picture = quote(picture, safe=" /:;,=()")
    source = f"data:image/svg+xml,{picture}"
    return f'<img class="suspension-explorer-still" alt="{text}" src="{source}">'
