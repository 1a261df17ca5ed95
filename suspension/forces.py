"""The wheels' normal forces, and the first loss of contact read from them."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from suspension import _checks
from suspension.road import Road, road_input
from suspension.robot import Robot

__all__ = ["WHEEL", "Loss", "first_loss", "normal_forces"]

WHEEL = {1: "rear", 2: "front"}


class Loss(NamedTuple):
    """The first loss of contact: wheel 1 (rear) or 2 (front), and the time in s."""

    wheel: int
    t: float


def normal_forces(robot: Robot, road: Road, v: float, T: ArrayLike, W: ArrayLike) -> np.ndarray:
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

    Raises
    ------
    ValueError
        If `v` or a time is not finite, `W` has not the shape (4, J+1), or the road returns another
        shape than it was given, or a value that is not finite.
    """
    _checks.instance("robot", robot, Robot)
    T = _checks.array("T", T, (None,))
    W = _checks.array("W", W, (4, len(T)), finite=False)
    return robot.C @ W + robot.D @ road_input(robot, road, _checks.number("v", v), T)


def first_loss(T: ArrayLike, N: ArrayLike) -> Loss | None:
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

    Raises
    ------
    ValueError
        If a force is not finite before contact is lost: then there is no verdict.

    Examples
    --------
    >>> first_loss([0, 1, 2], [[7, 7, 7], [7, -1, 2]])
    Loss(wheel=2, t=1.0)
    """
    T = _checks.array("T", T, (None,))
    N = _checks.array("N", N, (2, len(T)), finite=False)
    lost = (N <= 0).any(axis=0)
    broken = ~np.isfinite(N).all(axis=0)
    first = lost.argmax() if lost.any() else len(T)
    if broken[:first].any():
        raise ValueError(
            "N must be finite until contact is lost, "
            f"got a force that is not at t = {T[broken.argmax()]:g} s"
        )
    if not lost.any():
        return None
    return Loss(int(np.nanargmin(N[:, first])) + 1, float(T[first]))
