"""Checks for the workbook: each tells in words what is right, or which property fails and how.

``check_fit(fit)`` calls a student's function on random instances and asks for what must be true of
a right answer: residuals are orthogonal to the columns, an equilibrium stays, a run is of order 4.
A blank, an exception and a wrong shape are told in words, too.

>>> import numpy as np
>>> from suspension import practice
>>> def fit(x, F):
...     return np.polyfit(x, F, 2)
>>> practice.check_fit(fit).right
False
"""

from suspension.practice.contact import (
    check_accelerations,
    check_first_loss,
    check_normal_forces,
    check_road_under_wheels,
)
from suspension.practice.crank_nicolson import (
    check_cn_step,
    check_crank_nicolson,
    check_state_matrix,
)
from suspension.practice.feedback import Feedback
from suspension.practice.hunts import check_hunt, errors_of, listing_of
from suspension.practice.regression import (
    check_fit,
    check_half_widths,
    check_linearity,
    check_scatter,
)
from suspension.practice.runge_kutta import check_observed_order, check_rk4, check_rk4_step
from suspension.practice.stability import (
    check_is_stable,
    check_largest_step,
    check_stability_function,
)
from suspension.practice.steps import (
    check_between,
    check_integrate,
    check_locate,
    check_next_step,
    check_pair_step,
)

__all__ = [
    "Feedback",
    "check_accelerations",
    "check_between",
    "check_cn_step",
    "check_crank_nicolson",
    "check_first_loss",
    "check_fit",
    "check_half_widths",
    "check_hunt",
    "check_integrate",
    "check_is_stable",
    "check_largest_step",
    "check_linearity",
    "check_locate",
    "check_next_step",
    "check_normal_forces",
    "check_observed_order",
    "check_pair_step",
    "check_rk4",
    "check_rk4_step",
    "check_road_under_wheels",
    "check_scatter",
    "check_stability_function",
    "check_state_matrix",
    "errors_of",
    "listing_of",
]
