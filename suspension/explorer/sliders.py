"""The two sliders of ipywidgets, for speed and time step, above an explorer in JupyterLab.

Each chooses among round values, so that an arrow key takes a small step on a logarithmic scale.
What is set elsewhere is never rounded: a value that is not among them becomes one of them.
"""

from bisect import bisect_left

import numpy as np
from ipywidgets import HBox, Layout, SelectionSlider

from suspension.explorer.controls import CONTROLS
from suspension.explorer.settings import DTS

__all__ = ["STEPS", "row", "slider", "stops"]

STEPS = {"v": 120, "dt": 64}  # so that each is less than a fiftieth of the way


def stops(reach, count, known=()):
    """Round values from one end of a range to the other, evenly spaced in their logarithms.

    Parameters
    ----------
    reach : suspension.explorer.family.Range
        From where to where; both ends are among them.
    count : int
        How many there are.
    known : iterable of float
        More values that must be among them.

    Returns
    -------
    tuple of float, increasing
    """
    low, high = reach.low, reach.high
    for digits in range(3, 18):  # three, or as many as tell a narrow range's values apart
        rounded = (float(f"{value:.{digits}g}") for value in np.geomspace(low, high, count)[1:-1])
        chosen = {low, high, *(min(max(value, low), high) for value in rounded)}
        if len(chosen) == count:
            break
    return tuple(sorted(chosen | {value for value in known if value in reach}))


def slider(explorer, control, known=()):
    """A slider for one of an explorer's numbers; either follows the other.

    They are joined in Python: only what a user does to the slider is written to the explorer, and
    that is a value from `stops`, or the one that was set last.

    Parameters
    ----------
    explorer : suspension.explorer.Explorer
    control : suspension.explorer.controls.Control
        Says which number, and what it is called.
    known : iterable of float
        More values to choose from.

    Returns
    -------
    ipywidgets.SelectionSlider
    """
    name = control.trait
    usual = stops(explorer.ranges[name], STEPS[name], known)
    following = False

    def options(values):
        return [(f"{value * control.scale:.12g}", value) for value in values]

    def with_exact(value):
        place = bisect_left(usual, value)
        return usual if value in usual else (*usual[:place], value, *usual[place:])

    def follow(_):
        nonlocal following
        value = getattr(explorer, name)
        if made.value == value:
            return
        following = True
        try:
            with made.hold_sync():  # the page must not see new values at the old place
                values = [offered for _, offered in made.options]
                if value not in values:
                    values = with_exact(value)
                    made.options = options(values)  # which goes to the first of them
                made.index = values.index(value)
        finally:
            following = False

    def lead(change):
        if not following:
            setattr(explorer, name, change["new"])

    value, label = getattr(explorer, name), f"{control.label} ({control.unit})"
    made = SelectionSlider(
        options=options(with_exact(value)),
        value=value,
        description=label,
        tooltip=label,
        style={"description_width": "initial"},
        layout=Layout(flex="1 1 20rem", width="auto", min_width="0"),  # or there is no track left
    )
    explorer.observe(follow, name)
    made.observe(lead, "value")
    return made


def row(explorer):
    """An explorer's sliders, side by side where there is room; a compact one's is for v alone.

    Returns
    -------
    HBox
    dict of str to SelectionSlider
    """
    known = {"v": explorer.asked, "dt": DTS}
    sliders = {
        control.trait: slider(explorer, control, known[control.trait])
        for control in CONTROLS
        if control.trait in STEPS and control.trait in explorer.sliders
    }
    return HBox(list(sliders.values()), layout=Layout(flex_flow="row wrap")), sliders
