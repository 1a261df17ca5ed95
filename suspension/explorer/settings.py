"""What every explorer offers, and the methods by which it judges a run."""

import numpy as np

from suspension.schemes import BACKWARD_EULER, CRANK_NICOLSON, EULER, RK4, Scheme

__all__ = [
    "CLOSE",
    "CURVE",
    "DTS",
    "EDGE",
    "MOTIONS",
    "PACES",
    "REFERENCE",
    "SCHEMES",
    "SECONDS",
    "VIEWS",
]

SCHEMES = (EULER, BACKWARD_EULER, CRANK_NICOLSON, RK4)
# Round steps, s, fine to coarse: an arrow key goes from one to the next, any between can be set.
DTS = (0.00025, 0.0005, 0.001, 0.002, 0.0025, 0.005, 0.01, 0.02, 0.05, 0.06, 0.07, 0.08, 0.1, 0.2)
MOTIONS = ("linear", "flying")
PACES = ("fit", "same")  # of the clock: each crossing takes as long, or all are slowed alike
SECONDS = 8  # a crossing at a middling speed takes, where all are slowed alike
# Of the weight on a wheel: forces that differ by less are called equal, and a least force that is
# smaller has no sign that one could rely on.
CLOSE, EDGE = 1e-6, 1e-4
VIEWS = ("forces", "stability", "robot", "speeds")

# What every run is judged by: Gauss's methods, stable at any step; the one with two stages for the
# curve over all speeds.
_root = np.sqrt(3) / 6
CURVE = Scheme(
    "Gauss-Legendre (4)",
    4,
    a=[[1 / 4, 1 / 4 - _root], [1 / 4 + _root, 1 / 4]],
    b=[1 / 2, 1 / 2],
    c=[1 / 2 - _root, 1 / 2 + _root],
)
_root = np.sqrt(15)
REFERENCE = Scheme(
    "Gauss-Legendre",
    6,
    a=[
        [5 / 36, 2 / 9 - _root / 15, 5 / 36 - _root / 30],
        [5 / 36 + _root / 24, 2 / 9, 5 / 36 - _root / 24],
        [5 / 36 + _root / 30, 2 / 9 + _root / 15, 5 / 36],
    ],
    b=[5 / 18, 4 / 9, 5 / 18],
    c=[1 / 2 - _root / 10, 1 / 2, 1 / 2 + _root / 10],
)
