"""The exact margin of contact: the least normal force, found in the closed form.

A sampled history can miss a short dip. Here the samples are only the start: they are dense
enough for every time scale of the motion, and each minimum between them is then solved for.
"""

from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.exact import Crossing
from suspension.road import GaussianBump
from suspension.robot import Robot

__all__ = [
    "COURSE",
    "Minimum",
    "exact_forces",
    "margin",
    "minima",
    "roundoff",
    "sample_count",
    "turning_points",
]

COURSE = 1.25  # m, the distance of the problem's runs: they end at 1.25 / v
MAX_SAMPLES = 2 * 10**6  # a few seconds
CHUNK = 2**16  # samples worked on at a time, to bound the memory
DIGITS_LOST = 1e-6  # the largest rounding error allowed, relative to the forces
EPS = np.finfo(float).eps


class Minimum(NamedTuple):
    """The least normal force of a wheel, 1 (rear) or 2 (front): force in N, time in s, X in m."""

    wheel: int
    force: float
    t: float
    X: float


def margin(robot: Robot, bump: GaussianBump, v: float, tfinal: float | None = None) -> float:
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

    Raises
    ------
    ValueError
        If an argument is out of its range; if the modes swing so often until `tfinal` that more
        than 2 million samples were needed; or if robot and bump are so extreme that the forces
        overflow, or lose digits: their rounding error (`roundoff`) must stay below a millionth of
        the force at rest, or of the margin if that is larger.

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

    Raises
    ------
    ValueError
        As `margin` does.
    """
    tfinal = COURSE / crossing.v if tfinal is None else _checks.positive("tfinal", tfinal)
    samples = _samples(crossing, tfinal)
    with np.errstate(all="ignore"):
        parts = [
            _with_minima(crossing, samples[i : i + CHUNK + 1])
            for i in range(0, len(samples) - 1, CHUNK)
        ]
        t, N = (np.concatenate(part, axis=-1) for part in zip(*parts))
        t, once = np.unique(t, return_index=True)  # the parts share their ends
        N = N[:, once]
        error = roundoff(crossing, tfinal)
    scale = max(np.abs(crossing.robot.C @ crossing.robot.equilibrium).max(), -N.min())
    if not (np.isfinite(N).all() and error <= DIGITS_LOST * scale):
        raise ValueError(
            "robot and bump must be so moderate that double precision can tell the forces, "
            f"got {crossing.robot} and {crossing.bump} at v = {crossing.v:g} m/s, "
            f"whose forces may be off by {error:.2g} N"
        )
    return t, N


def _with_minima(crossing, t):
    """The samples `t` and the minima between them: times, s, and forces, N."""
    N, slope = exact_forces(crossing, t, 1)
    dt, rise = np.diff(t), np.diff(N)
    # The cubic through both ends of an interval has slope q(s) = p0 + p1 s + p2 s^2, 0 < s < 1.
    p0, end = slope[:, :-1] * dt, slope[:, 1:] * dt
    p1, p2 = 6 * rise - 4 * p0 - 2 * end, 3 * (p0 + end - 2 * rise)
    root = np.sqrt(p1 * p1 - 4 * p0 * p2)
    s = np.where(p1 > 0, -2 * p0 / (p1 + root), (root - p1) / (2 * p2))  # where q rises
    wheel, j = np.nonzero((s > 0) & (s < 1))
    at = t[j] + s[wheel, j] * dt[j]
    each = np.arange(len(j))
    for _ in range(2):  # Newton's method, from 1e-2 of a sample to roundoff
        _, slope, bend = exact_forces(crossing, at, 2)[:, wheel, each]
        step = np.divide(slope, bend, out=np.zeros_like(at), where=bend > 0)
        at = np.clip(at - step, t[j], t[j + 1])
    t, order = np.unique(np.concatenate([t, at]), return_index=True)
    return t, np.concatenate([N, exact_forces(crossing, at)[0]], axis=1)[:, order]


def roundoff(crossing, tfinal):
    """An estimate of the largest rounding error in the forces of a crossing until `tfinal`, N.

    The state is a sum over the modes. Each term carries a few units in its own last place, and
    what an error of the eigenvalue, of the size of a unit in the last place of the *largest* one,
    adds up to while the mode lives. Strong dampers multiply such errors by c. Over 120 robots of
    six kinds (stiff, undamped, critically damped, c up to 1e8), held against 60 digits, the error
    reached 0.7 of this estimate.
    """
    robot, bump, lam = crossing.robot, crossing.bump, crossing.lam
    passing = _passing(crossing)
    passing = passing[(passing >= 0) & (passing <= tfinal)]
    swing = np.abs(crossing.gain[:, :, None] * crossing._memory(np.append(0.0, passing)))
    modes = np.abs(crossing.free) + swing.sum(axis=1).max(axis=1)
    alive = np.minimum(tfinal, 1 / np.maximum(-lam.real, 1e-300))
    units = 8 + np.abs(lam).max() * alive
    state = np.abs(crossing.right) @ (units * modes)
    state += np.abs(crossing.direct).sum(axis=1) * abs(bump.height) + np.abs(robot.equilibrium)
    slope = abs(crossing.v * bump.height / bump.sigma)
    road = np.array([abs(bump.height)] * 2 + [slope] * 2)
    return float(4 * EPS * (np.abs(robot.C) @ state + np.abs(robot.D) @ road).max())


def exact_forces(crossing, t, order=0):
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
    robot = crossing.robot
    w, h, N = crossing(t), crossing.road(t, order + 1), []
    for n in range(order + 1):
        u = np.concatenate(h[n : n + 2])
        N.append(robot.C @ w + robot.D @ u)
        w = robot.A @ w + robot.B @ u
        if n == 0:
            w += robot.e[:, None]
    return np.array(N)


def sample_count(robot, v):
    """About how many samples of the forces a margin at speed `v` takes."""
    return 400 + 2.5 * COURSE / v * np.abs(robot.eigenvalues.imag).max()


def _samples(crossing, tfinal):
    # Three clocks: how fast a wheel passes the bump (and moves away from it), how fast the modes
    # swing, and how fast what is left from t = 0 dies away.
    swings = 2.5 * tfinal * np.abs(crossing.lam.imag).max()
    if not swings <= MAX_SAMPLES:
        raise ValueError(
            "v must be so high, or tfinal so short, that the swings of the modes can be followed "
            f"with {MAX_SAMPLES} samples, got v={crossing.v:g}, tfinal={tfinal:g}: {swings:.3g}"
        )
    swinging = np.linspace(0, tfinal, 2 + int(swings))
    fastest = 0.1 / np.abs(crossing.lam).max()
    dying = np.geomspace(fastest, max(tfinal, fastest), 2 + int(7 * np.log1p(tfinal / fastest)))
    t = np.concatenate([_passing(crossing), swinging, dying])
    return np.unique(t[(t >= 0) & (t <= tfinal)])


def _passing(crossing):
    """Times at which either wheel passes given places before, on and behind the bump, s."""
    places = 6 * np.sinh(np.arange(-66, 133) / 30)
    return ((places - crossing.start[:, None]) / crossing.rate).ravel()
