"""What all figures share: colours and lines of the wheels, symbols, and an axes to draw on."""

import matplotlib.pyplot as plt

__all__ = ["COLOURS", "FIELDS", "LINES", "MARKERS", "axes_or_new"]

COLOURS = ("C0", "C1")  # rear, front
FIELDS = {"kept": "#cfe6f5", "lost": "#fbe3d6"}  # book/style/suspension.css has a dark tone of each
LINES = ("-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)), (0, (1, 1)))  # rear, front, others
MARKERS = "o^sDvPX*"


def axes_or_new(ax):
    """Return `ax`, or the axes of a new figure if it is None."""
    return plt.subplots()[1] if ax is None else ax
