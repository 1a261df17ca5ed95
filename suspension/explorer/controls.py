"""The sliders and buttons as HTML, for a page without a kernel and for JupyterLab.

There, the sliders of speed and step are those of ipywidgets instead, see `sliders.py`.
"""

from html import escape
from typing import NamedTuple

__all__ = ["CONTROLS", "Control", "native"]


class Control(NamedTuple):
    """A slider: the trait it moves, what it is called, and how many units its number counts."""

    trait: str
    label: str
    unit: str
    scale: float  # units in one of the trait's
    bump_only: bool = False


CONTROLS = (
    Control("v", "Speed v", "m/s", 1),
    Control("dt", "Step Δt", "ms", 1000),
    Control("k", "Stiffness k", "N/m", 1),
    Control("c", "Damping c", "N s/m", 1),
    Control("height", "Bump height", "mm", 1000, bump_only=True),
    Control("sigma", "Bump width σ", "mm", 1000, bump_only=True),
)


def offered(explorer):
    """The controls that an explorer has: none for a bump on a road that has none to change."""
    chosen = [control for control in CONTROLS if control.trait in explorer.sliders]
    return [control for control in chosen if explorer.family.has_bump or not control.bump_only]


def native(explorer):
    """The controls as HTML: a range and a number for each slider, buttons for the schemes.

    A script fills in the values and moves them; without it they are not shown. So are the buttons
    of the author's own presets. JupyterLab gets them, too, but for the ranges of speed and step:
    its style hides them, for `sliders.row` stands above the explorer, and keeps their numbers and,
    as a strip, the speeds at which contact is kept and lost.
    """
    rows = []
    for control in offered(explorer):
        name = f"{control.label} ({control.unit})"
        rows.append(
            f'<div class="se-control" data-trait="{control.trait}">'
            f'<span class="se-name">{escape(control.label)}</span>'
            f'<span class="se-number"><input type="text" inputmode="decimal" autocomplete="off" '
            f'aria-label="{escape(name)}, typed"> {escape(control.unit)}</span>'
            f'<input type="range" min="0" max="1" step="any" aria-label="{escape(name)}"></div>'
        )
    if explorer.compact:
        return "".join(rows)
    buttons = "".join(
        f'<button type="button" data-index="{i}">{escape(scheme.name)}</button>'
        for i, scheme in enumerate(explorer.schemes)
    )
    rows.append(
        '<div class="se-choice" data-trait="scheme_index" role="group" aria-label="Scheme">'
        f"{buttons}</div>"
    )
    if presets := explorer.facts["presets"]:
        buttons = "".join(
            f'<button type="button" data-preset="{i}">{escape(label)}</button>'
            for i, (label, _) in enumerate(presets)
        )
        rows.append(
            '<div class="se-presets se-experiments" role="group" aria-label="Experiments">'
            f"<span>Experiments</span>{buttons}</div>"
        )
    return "".join(rows)
