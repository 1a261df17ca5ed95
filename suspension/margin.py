"""The exact margin of contact: the least normal force, found in the closed form.

A sampled history can miss a short dip. Here the samples are only the start: they are dense
enough for every time scale of the motion, and each minimum between them is then solved for.
"""

from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.exact import Crossing

__all__ = ["Minimum", "forces", "margin", "minima", "turning_points"]

COURSE = 1.25  # m, the distance of the problem's runs: they end at 1.25 / v
MAX_SAMPLES = 10**7


class Minimum(NamedTuple):
    """The least normal force of a wheel, 1 (rear) or 2 (front): force in N, time in s, X in m."""

    wheel: int
    force: float
    t: float
    X: float


def margin(robot, bump, v, tfinal=None):
    """The least normal force of both wheels on the way over the bump, exact.

    The robot starts at rest, in equilibrium, and keeps contact if and only if the margin is
    positive.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.
    tfinal : float, optional
        End of the run, s, > 0; 1.25 m / v if not given.

    Returns
    -------
    margin : float
        The minimum of N1 and N2 (Eq. 5) over [0, tfinal], N.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> [round(margin(Robot(800, 800), GaussianBump(), v), 3) for v in (0.25, 1.2, 5, 10)]
    [5.598, -25.231, -5.012, 1.673]
    """
    return min(minimum.force for minimum in minima(robot, bump, v, tfinal))


def minima(robot, bump, v, tfinal=None):
    """The least normal force of each wheel on the way over the bump, rear before front.

    Parameters are those of `margin`.

    Returns
    -------
    minima : tuple of two Minimum
    """
    v = _checks.positive("v", v)
    t, N = turning_points(Crossing(robot, bump, v), tfinal)
    return tuple(
        Minimum(wheel, float(N[i, j]), float(t[j]), float(v * t[j]))
        for wheel, i, j in zip((1, 2), (0, 1), N.argmin(axis=1), strict=True)
    )


def turning_points(crossing, tfinal=None):
    """Samples of both normal forces that contain every minimum of each.

    Parameters
    ----------
    crossing : Crossing
        With v > 0 if `tfinal` is not given.
    tfinal : float, optional
        End of the run, s, > 0; 1.25 m / v if not given.

    Returns
    -------
    t : ndarray, shape (n,)
        Times, s, in order, from 0 to `tfinal`.
    N : ndarray, shape (2, n)
        Normal forces, N.
    """
    tfinal = COURSE / crossing.v if tfinal is None else _checks.positive("tfinal", tfinal)
    t = _samples(crossing, tfinal)
    N, slope = forces(crossing, t, 1)
    dt, rise = np.diff(t), np.diff(N)
    # The cubic through both ends of an interval has slope q(s) = p0 + p1 s + p2 s^2, 0 < s < 1.
    p0, end = slope[:, :-1] * dt, slope[:, 1:] * dt
    p1, p2 = 6 * rise - 4 * p0 - 2 * end, 3 * (p0 + end - 2 * rise)
    with np.errstate(invalid="ignore", divide="ignore"):
        root = np.sqrt(p1 * p1 - 4 * p0 * p2)
        s = np.where(p1 > 0, -2 * p0 / (p1 + root), (root - p1) / (2 * p2))  # where q rises
    wheel, j = np.nonzero((s > 0) & (s < 1))
    at, each = t[j] + s[wheel, j] * dt[j], np.arange(len(j))
    for _ in range(2):  # Newton's method, from 1e-2 of a sample to roundoff
        _, slope, bend = forces(crossing, at, 2)[:, wheel, each]
        step = np.divide(slope, bend, out=np.zeros_like(at), where=bend > 0)
        at = np.clip(at - step, t[j], t[j + 1])
    t, order = np.unique(np.concatenate([t, at]), return_index=True)
    return t, np.concatenate([N, forces(crossing, at)[0]], axis=1)[:, order]


def forces(crossing, t, order=0):
    """Normal forces ``N = C w + D u`` (Eq. 5) of an exact crossing, and their time derivatives.

    Parameters
    ----------
    crossing : Crossing
    t : ndarray, shape (n,)
        Times, s, >= 0.
    order : int
        The highest derivative wanted; ``w' = A w + B u + e`` gives each from the one before.

    Returns
    -------
    N : ndarray, shape (order + 1, 2, n)
        In N, N/s, ...
    """
    A, B, C, D, e = crossing.matrices
    w, h, N = crossing(t), crossing.road(t, order + 1), []
    for n in range(order + 1):
        u = np.concatenate(h[n : n + 2])
        N.append(C @ w + D @ u)
        w = A @ w + B @ u + (e[:, None] if n == 0 else 0.0)
    return np.array(N)


def _samples(crossing, tfinal):
    # Three clocks: how fast a wheel passes the bump (and moves away from it), how fast the modes
    # swing, and how fast what is left from t = 0 dies away.
    passing = (6 * np.sinh(np.arange(-66, 133) / 30) - crossing.start[:, None]) / crossing.rate
    swings = tfinal * np.abs(crossing.lam.imag).max()
    fastest = 0.1 / np.abs(crossing.lam).max()
    if swings > MAX_SAMPLES:
        raise ValueError(
            f"v must be so fast, or tfinal so short, that modes swing less than {MAX_SAMPLES} rad, "
            f"got {swings:.3g} rad"
        )
    swinging = np.linspace(0, tfinal, 2 + int(2.5 * swings))
    dying = np.geomspace(fastest, max(tfinal, fastest), 2 + int(7 * np.log1p(tfinal / fastest)))
    t = np.concatenate([passing.ravel(), swinging, dying])
    return np.unique(t[(t >= 0) & (t <= tfinal)])
