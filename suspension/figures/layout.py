"""A figure as SVG, as it was drawn and once more for a screen as narrow as a phone's."""

from io import StringIO

import matplotlib.pyplot as plt
from matplotlib.gridspec import GridSpec

__all__ = ["PHONE_WIDTH", "narrow", "svg"]

PHONE_WIDTH = 3.75  # inches, of 96 pixels each: type is not scaled down on a phone
PANEL_HEIGHT = 2.5  # inches, of panels that stood side by side


def svg(figure):
    """The figure as the text of an SVG file that is the same every time.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    """
    text = StringIO()
    with plt.rc_context({"svg.hashsalt": "suspension"}):
        figure.savefig(text, format="svg", bbox_inches="tight", metadata={"Date": None})
    return text.getvalue()


def narrow(figure):
    """Lay a figure out anew for a phone and return it.

    Panels that stood side by side come to stand below each other, and a legend that stood beside
    or below its panel at the foot of the figure; type keeps its size.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    """
    panels = [ax for ax in figure.axes if ax.get_subplotspec() is not None]
    outside = [ax.get_legend() for ax in panels if ax.get_legend() and not _inside(ax)]
    height = figure.get_figheight()
    if panels and panels[0].get_subplotspec().get_gridspec().ncols > 1:
        _stack(figure, panels)
        height = PANEL_HEIGHT * len(panels)
    figure.set_size_inches(PHONE_WIDTH, height)
    for legend in [*outside, *figure.legends]:
        new = _in_fewer_columns(legend, figure, "outside lower center")
        height += new.get_window_extent().height / figure.dpi
    for ax in panels:
        if ax.get_legend() and ax.get_legend().get_window_extent().width > 0.8 * figure.bbox.width:
            _in_fewer_columns(ax.get_legend(), ax, "best")
    figure.set_size_inches(PHONE_WIDTH, height)
    return figure


def _inside(ax):
    """Whether the legend of a panel lies on the panel."""
    ax.figure.draw_without_rendering()
    return ax.get_window_extent().count_overlaps([ax.get_legend().get_window_extent()]) > 0


def _stack(figure, panels):
    """Put panels below each other, each with labels of its own."""
    grid = GridSpec(len(panels), 1, figure=figure)
    for i, ax in enumerate(panels):
        ax.set_subplotspec(grid[i])
        ax.tick_params(labelleft=True, labelbottom=True)
        if not ax.get_ylabel():
            ax.set_ylabel(panels[0].get_ylabel())


def _in_fewer_columns(legend, owner, place):
    """Draw a legend again, on a figure or a panel, in as many columns as there is room for."""
    handles, labels = legend.legend_handles, [text.get_text() for text in legend.get_texts()]
    title = legend.get_title().get_text() or None
    legend.remove()
    for columns in (3, 2, 1):
        new = owner.legend(handles, labels, title=title, loc=place, ncols=columns)
        if columns == 1 or new.get_window_extent().width < 0.8 * new.figure.bbox.width:
            return new
        new.remove()
