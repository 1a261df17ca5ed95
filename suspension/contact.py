"""Does a wheel leave the ground? The normal forces and the verdict read from them."""

from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.road import road_input

__all__ = ["Loss", "first_loss", "normal_forces"]


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
