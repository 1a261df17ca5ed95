"""Does a wheel leave the ground? All that answers it, and the only place where a sign decides.

Contact is lost where the margin, the least normal force of both wheels, is zero or negative. Over a
range of speeds, or of stiffnesses, the answer is one object, `Regimes`: the ranges in which contact
is kept and lost. Sentences, captions and pictures read it.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from suspension import _checks
from suspension.critical import critical_speeds, critical_stiffness, sensitivity
from suspension.exact import Crossing
from suspension.forces import WHEEL, Loss, first_loss, normal_forces
from suspension.least_force import (
    Minimum,
    distance_over,
    exact_forces,
    margin,
    minima,
    turning_points,
)
from suspension.road import GaussianBump
from suspension.robot import Robot

__all__ = [
    "WHEEL",
    "Loss",
    "Minimum",
    "Regimes",
    "critical_speeds",
    "critical_stiffness",
    "exact_loss",
    "first_loss",
    "is_lost",
    "margin",
    "minima",
    "normal_forces",
    "regimes",
    "regimes_between",
    "sensitivity",
]


def is_lost(margin):
    """The verdict: whether a margin in N, a number or an array, means that contact is lost.

    Raises
    ------
    ValueError
        If a margin is no finite number: it would turn into "contact kept".
    """
    return _checks.array("margin", margin) <= 0


@dataclass(frozen=True, eq=False, repr=False)
class Regimes:
    """In which ranges of speed, or of another positive quantity, contact is kept and lost.

    Called with values it tells for each whether contact is lost there.

    Parameters
    ----------
    edges : array_like, shape (n + 1,)
        The ends of the n >= 1 ranges, in order, > 0.
    lost : array_like of bool, shape (n,)
        Whether contact is lost in each.
    unit : str
        Of the edges, as it is printed.

    Raises
    ------
    ValueError
        If the edges are not > 0 and in order, or `lost` does not hold a bool for each range; in a
        call, if a value lies outside the ranges.

    Examples
    --------
    >>> found = Regimes([0.1, 0.4367, 7.946, 30], [False, True, False])
    >>> found
    Regimes(
      kept from 0.1 to 0.4367 m/s
      lost from 0.4367 to 7.946 m/s
      kept from 7.946 to 30 m/s
    )
    >>> found([0.25, 1.2, 5, 10])
    array([False,  True,  True, False])
    >>> found.spans(lost=True)
    array([[0.4367, 7.946 ]])
    """

    edges: np.ndarray
    lost: np.ndarray
    unit: str = "m/s"

    def __post_init__(self):
        edges = _checks.array("edges", self.edges, (None,))
        if len(edges) < 2 or not edges[0] > 0 or not (np.diff(edges) > 0).all():
            raise ValueError(f"edges must be two numbers or more, > 0 and in order, got {edges}")
        lost = _checks.array("lost", self.lost, (len(edges) - 1,))
        if not np.isin(lost, (0, 1)).all():
            raise ValueError(f"lost must hold True or False for each range, got {lost}")
        for name, value in (("edges", edges.copy()), ("lost", lost.astype(bool))):
            value.setflags(write=False)
            object.__setattr__(self, name, value)

    @property
    def critical(self):
        """Where one range ends and the next begins, shape (n - 1,)."""
        return self.edges[1:-1]

    def spans(self, lost):
        """The ranges in which contact is lost (or, with False, kept), ends first: shape (m, 2).

        Neighbours with the same verdict are one.
        """
        turns = np.diff(np.concatenate([[0], self.lost == lost, [0]]))
        return np.column_stack([self.edges[turns > 0], self.edges[turns < 0]])

    @property
    def regained(self):
        """The ranges in which contact is kept although it is lost below them, ends first: (m, 2).

        >>> Regimes([0.1, 0.4, 8, 30], [False, True, False]).regained
        array([[ 8., 30.]])
        """
        kept = self.spans(lost=False)
        return kept[kept[:, 0] > self.edges[0]]

    def __call__(self, v: ArrayLike) -> np.ndarray:
        """Whether contact is lost at values `v` within the edges: bool, of the shape of `v`.

        At an edge between kept and lost the margin is zero, and contact lost.
        """
        v = _checks.array("v", v)
        low, high = self.edges[[0, -1]]
        outside = ~((low <= v) & (v <= high))
        if outside.any():
            raise ValueError(
                f"v must be from {low:g} to {high:g} {self.unit}, got {v[outside].flat[0]:g}"
            )
        below = np.searchsorted(self.critical, v, side="left")
        above = np.searchsorted(self.critical, v, side="right")  # another one at an edge only
        return self.lost[below] | self.lost[above]

    def __repr__(self):
        lines = [
            f"  {'lost' if lost else 'kept'} from {low:.6g} to {high:.6g} {self.unit}"
            for (low, high), lost in zip(pairwise(self.edges), self.lost, strict=True)
        ]
        return "\n".join(["Regimes(", *lines, ")"])


def regimes(
    robot: Robot,
    bump: GaussianBump,
    vmin: float,
    vmax: float,
    *,
    distance: float | None = None,
) -> Regimes:
    """At which speeds contact is kept on the way over the bump, and at which it is lost.

    Parameters and errors are those of `suspension.critical.critical_speeds`.

    Returns
    -------
    Regimes
        Between `vmin`, the critical speeds and `vmax`.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> regimes(Robot(800, 800), GaussianBump(), 0.1, 30)
    Regimes(
      kept from 0.1 to 0.43665 m/s
      lost from 0.43665 to 7.94569 m/s
      kept from 7.94569 to 20.4232 m/s
      lost from 20.4232 to 30 m/s
    )
    """
    distance = distance_over(robot, bump, distance)
    critical = critical_speeds(robot, bump, vmin, vmax, distance=distance)
    inside = critical[(vmin < critical) & (critical < vmax)]
    return regimes_between(
        lambda v: margin(robot, bump, v, distance=distance), [vmin, *inside, vmax]
    )


def regimes_between(margin_at, edges, unit="m/s"):
    """The regimes whose edges are known: what is decided is the sign in the middle of each range.

    Parameters
    ----------
    margin_at : callable
        ``margin_at(v) -> float``, N; its zeros are among the edges.
    edges : array_like, shape (n,)
        In order, > 0, n >= 2. Edges between ranges of the same verdict are left out.
    unit : str
        Of the edges.

    Returns
    -------
    Regimes

    Raises
    ------
    ValueError
        If the edges are not > 0 and in order, or fewer than two, or a margin is no finite number.

    Examples
    --------
    >>> regimes_between(lambda k: 300 - k, [200, 250, 300, 1000], unit="N/m")
    Regimes(
      kept from 200 to 300 N/m
      lost from 300 to 1000 N/m
    )
    """
    _checks.function("margin_at", margin_at, "margin_at(v) -> float")
    edges = _checks.array("edges", edges, (None,))
    edges = Regimes(edges, np.zeros_like(edges[1:])).edges  # checked
    lost = np.array([is_lost(margin_at(v)) for v in np.sqrt(edges[1:] * edges[:-1])], dtype=bool)
    turns = np.append(True, lost[1:] != lost[:-1])
    return Regimes(np.append(edges[:-1][turns], edges[-1:]), lost[turns], unit)


def exact_loss(robot, bump, v, tfinal=None, *, distance=None):
    """The very moment at which a wheel first leaves the ground on the way over the bump.

    Parameters and errors are those of `margin`, and so is the start.

    Returns
    -------
    loss : Loss or None
        None if both wheels keep contact all the way.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> loss = exact_loss(Robot(800, 800), GaussianBump(), v=5)
    >>> loss.wheel, round(loss.t, 6)
    (2, 0.056455)
    """
    crossing = Crossing(robot, bump, _checks.positive("v", v))
    t, N = turning_points(crossing, tfinal, distance=distance)
    loss = first_loss(t, N)
    if loss is None or loss.t == 0:
        return loss
    # Every minimum is among the samples, so before the loss each force falls through zero once.
    j = np.searchsorted(t, loss.t)
    losses = []
    for i in np.flatnonzero(N[:, j] <= 0):
        # The ends' forces are not computed anew: even the sign of a roundoff must stay.
        ends = {t[j - 1]: N[i, j - 1], t[j]: N[i, j]}

        def force(s, i=i, ends=ends):
            return ends[s] if s in ends else exact_forces(crossing, np.array([s]))[0, i, 0]

        losses.append(Loss(int(i) + 1, brentq(force, *ends, xtol=1e-15)))
    return min(losses, key=lambda loss: loss.t)
