"""What the sliders offer, and where they begin and end."""

from suspension.schemes import CRANK_NICOLSON, RK4

__all__ = ["DTS", "MOMENTS", "SCHEMES", "VIEWS", "VMAX", "VMIN"]

SCHEMES = (CRANK_NICOLSON, RK4)
# Seconds, whole multiples of the last one: every run can be compared with it sample by sample.
DTS = (0.2, 0.1, 0.08, 0.07, 0.06, 0.05, 0.02, 0.01, 0.005, 0.0025, 0.002, 0.001, 0.0005, 0.00025)
VMIN, VMAX = 0.1, 25.0  # m/s
MOMENTS = 1000  # stops of the time slider
VIEWS = ("forces", "stability", "robot")
