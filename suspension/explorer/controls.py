"""The sliders and buttons above the picture."""

import ipywidgets
import numpy as np

from suspension.explorer.settings import DTS, MOMENTS, SCHEMES, VMAX, VMIN

__all__ = ["controls"]


def controls(explorer, own):
    """The controls of an `Explorer`, joined to its traits; without a kernel they still are.

    Parameters
    ----------
    explorer : Explorer
    own : int
        The place of the robot's own stiffness.

    Returns
    -------
    ipywidgets.Box
    """
    speed = ipywidgets.FloatLogSlider(
        explorer.v,
        min=np.log10(VMIN),
        max=np.log10(VMAX),
        step=0,  # any other would round a typed value
        readout_format=".3g",
        description="Speed v (m/s)",
    )
    speed.add_class("se-typed")
    step = ipywidgets.SelectionSlider(
        options=[f"{1000 * dt:g}" for dt in DTS],
        index=explorer.dt_index,
        description="Step Δt (ms)",
    )
    stiffness = ipywidgets.SelectionSlider(
        options=_stiffnesses(explorer.robots, own),
        index=explorer.k_index,
        description="Stiffness k (N/m)",
    )
    scheme = ipywidgets.ToggleButtons(
        options=[scheme.name for scheme in SCHEMES],
        index=explorer.scheme_index,
        description="Scheme",
    )
    moment = ipywidgets.IntSlider(explorer.time, max=MOMENTS, readout=False, description="Moment")
    joined = [
        (speed, "value", "v"),
        (step, "index", "dt_index"),
        (stiffness, "index", "k_index"),
        (scheme, "index", "scheme_index"),
        (moment, "value", "time"),
    ]
    for control, name, trait in joined:
        control.layout.width = "auto"
        ipywidgets.jslink((control, name), (explorer, trait))
    return ipywidgets.Box([control for control, _, _ in joined])


def _stiffnesses(robots, own):
    """What the slider calls each robot's springs, N/m."""
    names = []
    for robot in robots:
        springs = [robot.k1] if robot.k1 == robot.k2 else [robot.k1, robot.k2]
        names.append(" and ".join(f"{k:.0f}" for k in springs))
    names[own] += " (fitted)"
    return names
