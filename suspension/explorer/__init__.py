"""Live sliders: the robot, the forces and the stability region, with a kernel or without.

Python computes the matrices and the road, the browser iterates them and draws. So the built page
needs no kernel and holds no physics: any `Robot` and any road work in it, and what it shows is
what `suspension.simulation.simulate` computes.
"""

import json
from pathlib import Path

import anywidget
import ipywidgets
import numpy as np
import traitlets

from suspension import _checks
from suspension.explorer.bundle import bundle
from suspension.explorer.controls import controls
from suspension.explorer.settings import DTS, MOMENTS, SCHEMES, VIEWS, VMAX, VMIN
from suspension.explorer.still import still
from suspension.explorer.tables import (
    ROBOT_FIELDS,
    region,
    road_table,
    robot_table,
    step_fields,
    step_table,
    vary_stiffness,
)
from suspension.robot import Robot
from suspension.schemes import RK4
from suspension.simulation import simulate

__all__ = ["DTS", "SCHEMES", "Explorer", "ExplorerBox", "explore"]

PAGE = Path(__file__).parent / "page"
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

    _esm = bundle(PAGE, "view")
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
                "robotFields": ROBOT_FIELDS,
                "schemes": [
                    {
                        "name": scheme.name,
                        "c": np.unique(scheme.c).tolist(),
                        "region": region(scheme),
                        "fields": step_fields(scheme),
                    }
                    for scheme in SCHEMES
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
            self.robot,
            self.road,
            v=self.v,
            dt=DTS[self.dt_index],
            tfinal=self.distance / self.v,
            scheme=SCHEMES[self.scheme_index],
        )


class ExplorerBox(ipywidgets.VBox):
    """The sliders above the `Explorer` they move; ``box.explorer`` is the latter.

    A page shows a still picture of the same settings until its scripts run, or where they do not.
    """

    def __init__(self, explorer, sliders):
        self.explorer = explorer
        super().__init__([sliders, explorer])
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
    TypeError
        If `robot` is not a Robot, or `road` cannot be called.
    ValueError
        If an argument is not in its range.
    """
    _checks.instance("robot", robot, Robot)
    robots, own = vary_stiffness(robot)
    k = robot.k1 if k is None else _checks.positive("k", k)
    if time is not None:
        time = _checks.number("time", time, "a fraction from 0 to 1", lambda time: 0 <= time <= 1)
    names = [known.name for known in SCHEMES]
    explorer = Explorer(
        robots,
        road,
        _checks.positive("distance", distance),
        v=_checks.number("v", v, f"{VMIN} to {VMAX} m/s", lambda v: VMIN <= v <= VMAX),
        dt_index=DTS.index(_checks.one_of("dt", dt, DTS)),
        k_index=int(np.argmin([abs(other.k1 - k) for other in robots])),
        scheme_index=names.index(_checks.one_of("scheme", getattr(scheme, "name", scheme), names)),
        view=_checks.one_of("view", view, VIEWS),
    )
    if time is None:
        run = explorer.trajectory()
        t = run.loss.t if run.loss else run.T[run.N.min(axis=0).argmin()]
        time = min(t * v / distance, 1)
    explorer.time = round(MOMENTS * time)
    return ExplorerBox(explorer, controls(explorer, own))
