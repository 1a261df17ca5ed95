"""Does a wheel leave the ground? The normal forces and the verdict read from them."""

from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from suspension import _checks
from suspension.critical import critical_speeds, critical_stiffness, sensitivity
from suspension.exact import Crossing
from suspension.margin import Minimum, forces, margin, minima, turning_points
from suspension.road import road_input

__all__ = [
    "Loss",
    "Minimum",
    "critical_speeds",
    "critical_stiffness",
    "exact_loss",
    "first_loss",
    "margin",
    "minima",
    "normal_forces",
    "sensitivity",
]


class Loss(NamedTuple):
    """The first loss of contact: wheel 1 (rear) or 2 (front), and the time in s."""

    wheel: int
    t: float


def normal_forces(robot, road, v, T, W):
    """Normal forces of a history, ``N = C w + D u`` (Eq. 5).

    Parameters
    ----------
    robot : Robot
    road : callable
        ``road(x) -> (H, dHdx)``.
    v : float
        Speed, m/s.
    T : array_like, shape (J+1,)
        Times, s.
    W : array_like, shape (4, J+1)
        States.

    Returns
    -------
    N : ndarray, shape (2, J+1)
        Rear and front normal force, N. Where it is <= 0 the wheel has lost the ground and the
        linear model no longer holds.
    """
    T = _checks.array("T", T, (None,))
    W = _checks.array("W", W, (4, len(T)), finite=False)
    return robot.C @ W + robot.D @ road_input(robot, road, _checks.number("v", v), T)


def first_loss(T, N):
    """The first sample at which a wheel no longer presses on the ground, N <= 0.

    Parameters
    ----------
    T : array_like, shape (J+1,)
        Times, s.
    N : array_like, shape (2, J+1)
        Rear and front normal force, N.

    Returns
    -------
    loss : Loss or None
        None if both wheels keep contact at every sample. If both lose it at the same sample,
        the wheel with the smaller force is named.

    Examples
    --------
    >>> first_loss([0, 1, 2], [[7, 7, 7], [7, -1, 2]])
    Loss(wheel=2, t=1.0)
    """
    T = _checks.array("T", T, (None,))
    N = _checks.array("N", N, (2, len(T)), finite=False)
    lost = (N <= 0).any(axis=0)
    if not lost.any():
        return None
    j = lost.argmax()
    return Loss(int(np.nanargmin(N[:, j])) + 1, float(T[j]))


def exact_loss(robot, bump, v, tfinal=None):
    """The very moment at which a wheel first leaves the ground on the way over the bump.

    Parameters are those of `margin`, and so is the start, at rest.

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
    t, N = turning_points(crossing, tfinal)
    loss = first_loss(t, N)
    if loss is None or loss.t == 0:
        return loss
    # Every minimum is among the samples, so on the last bit a force falls through zero once.
    j = np.searchsorted(t, loss.t)
    losses = []
    for i in np.nonzero(N[:, j] <= 0)[0]:
        ends = {t[j - 1]: N[i, j - 1], t[j]: N[i, j]}  # not computed anew: roundoff has a sign too

        def force(s, i=i, ends=ends):
            return ends[s] if s in ends else forces(crossing, np.array([s]))[0, i, 0]

        losses.append(Loss(int(i) + 1, brentq(force, *ends, xtol=1e-15)))
    return min(losses, key=lambda loss: loss.t)
