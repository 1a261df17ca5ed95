"""The workshop of schemes: a Butcher tableau to type into, and all that follows from it."""

import base64
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import traitlets
from scipy.optimize import minimize_scalar

from suspension import _checks
from suspension.explorer.bundle import bundle, without_comments
from suspension.explorer.family import before_the_bump
from suspension.explorer.instrument import Instrument
from suspension.explorer.settings import REFERENCE
from suspension.explorer.still import svg
from suspension.explorer.tables import shape_of
from suspension.figures import plot_stability
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import RK4, Scheme

__all__ = ["KNOWN", "Workshop", "workshop_script", "workshop_style"]

PAGE = Path(__file__).parent / "page"
# As one writes them: rows of a and the weights b; c are the row sums.
KNOWN = {
    "Euler": ("0", "1"),
    "Midpoint": ("0 0; 1/2 0", "0 1"),
    "Heun": ("0 0; 1 0", "1/2 1/2"),
    "Kutta, order 3": ("0 0 0; 1/2 0 0; -1 2 0", "1/6 2/3 1/6"),
    "RK4": ("0 0 0 0; 1/2 0 0 0; 0 1/2 0 0; 0 0 1 0", "1/6 1/3 1/3 1/6"),
    "3/8 rule": ("0 0 0 0; 1/3 0 0 0; -1/3 1 0 0; 1 -1 1 0", "1/8 3/8 3/8 1/8"),
    "Butcher, order 5": (
        "0 0 0 0 0 0; 1/4 0 0 0 0 0; 1/8 1/8 0 0 0 0; 0 -1/2 1 0 0 0;"
        "3/16 0 0 9/16 0 0; -3/7 2/7 12/7 -12/7 8/7 0",
        "7/90 0 16/45 2/15 16/45 7/90",
    ),
    "Backward Euler": ("1", "1"),
    "Implicit midpoint": ("1/2", "1"),
    "Crank-Nicolson": ("0 0; 1/2 1/2", "1/2 1/2"),
    "SDIRK, order 2": ("1-√2/2 0; √2/2 1-√2/2", "√2/2 1-√2/2"),
    "Gauss-Legendre, order 4": ("1/4 1/4-√3/6; 1/4+√3/6 1/4", "1/2 1/2"),
    "Radau IIA, order 3": ("5/12 -1/12; 3/4 1/4", "3/4 1/4"),
    "Lobatto IIIA, order 4": ("0 0 0; 5/24 1/3 -1/24; 1/6 2/3 1/6", "1/6 2/3 1/6"),
}
START = "RK4"
