"""The exact margin of contact: the least normal force, found in the closed form.

A sampled history can miss a short dip. Here the samples are only the start: they are dense
enough for every time scale of the motion, and each minimum between them is then solved for.
"""

from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.exact import Crossing, times
from suspension.problem import DISTANCE
from suspension.road import GaussianBump
from suspension.robot import Robot

__all__ = [
    "Minimum",
    "bottom",
    "distance_over",
    "duration",
    "exact_forces",
    "forces_and_minima",
    "margin",
    "minima",
    "roundoff",
    "sample_count",
    "turning_points",
]

CLEAR = 4.0  # sigmas from its centre, where a Gaussian bump has 0.03 % of its height left
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


def margin(
    robot: Robot,
    bump: GaussianBump,
    v: float,
    tfinal: float | None = None,
    *,
    distance: float | None = None,
) -> float:
    """The least normal force of both wheels on the way over the bump, exact.

    The robot starts at X = 0, in the equilibrium of level ground, and keeps contact if and only if
    the margin is positive.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.
    tfinal : float, optional
        End of the run, s, > 0, in the place of `distance`. Such a run is taken as it is, wherever
        the bump lies: a wheel may start on it, in the state that is at rest on level ground.
    distance : float, optional
        How far the run goes, m, as in `distance_over`: 1.25 m if the whole bump lies within.

    Returns
    -------
    margin : float
        The minimum of N1 and N2 (Eq. 5) over the run, N.

    Raises
    ------
    ValueError
        If an argument is out of its range; if, without `tfinal`, `distance_over` refuses; if the
        modes swing so often in the run that more than 2 million samples were needed; or if robot
        and bump are so extreme that the forces overflow, or lose digits: their rounding error
        (`roundoff`) must stay below a millionth of the force at rest, or of the margin if that is
        larger.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> [round(margin(Robot(800, 800), GaussianBump(), v), 3) for v in (0.25, 1.2, 5, 10)]
    [5.598, -25.231, -5.012, 1.673]
    """
    return min(minimum.force for minimum in minima(robot, bump, v, tfinal, distance=distance))


def distance_over(robot, bump, distance=None):
    """How far a run goes that starts at X = 0 and takes a robot over a bump, m.

    What is left of a bump four sigmas from its centre, 0.03 % of its height, counts as level.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    distance : float, optional
        What was asked for, m, > 0. It is taken as it is, also one that ends before or on the bump.
        If not given, the 1.25 m of the problem set (`suspension.problem.DISTANCE`), provided that
        both wheels pass the whole bump within it.

    Returns
    -------
    distance : float

    Raises
    ------
    ValueError
        If a wheel stands on the bump at X = 0; or if no distance is given and a wheel does not
        pass the whole bump within 1.25 m: the distance that would do is told.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> distance_over(Robot(800, 800), GaussianBump())
    1.25
    >>> distance_over(Robot(800, 800), GaussianBump(centre=3.0), 4.0)
    4.0
    """
    _checks.instance("robot", robot, Robot)
    _checks.instance("bump", bump, GaussianBump)
    reach = CLEAR * bump.sigma
    roundoff = EPS * (4 * reach + abs(bump.centre))
    asked = None if distance is None else _checks.positive("distance", distance)
    first, last = robot.L2 + reach, bump.centre + reach + robot.L1
    on_it = np.abs(robot.arms - bump.centre) < reach - roundoff
    if on_it.any() or (asked is None and bump.centre < first - roundoff):
        # Moved there, a wide bump or a long robot still does not fit.
        enough = first + reach + robot.L1
        too = f", and distance {_round_up(enough)} m or more" if enough > DISTANCE else ""
        raise ValueError(
            "bump must begin ahead of the robot, which starts at X = 0 on level ground: its centre "
            f"must be at {_round_up(first)} m or more (L2 + {CLEAR:g} sigma){too}, got "
            f"centre={bump.centre:g} with sigma={bump.sigma:g}, L1={robot.L1:g}, L2={robot.L2:g}"
        )
    if asked is not None:
        return asked
    if last > DISTANCE + roundoff:
        raise ValueError(
            f"distance must be given, {_round_up(last)} m or more, for both wheels to pass the "
            f"whole bump (centre={bump.centre:g}, sigma={bump.sigma:g}): it reaches beyond the "
            f"{DISTANCE:g} m of the problem set, got distance=None"
        )
    return DISTANCE


def _round_up(x):
    """A length in three digits, not less than it is."""
    unit = 10.0 ** (np.floor(np.log10(x)) - 2)
    return f"{np.ceil(x / unit * (1 - 1e-12)) * unit:.6g}"


def minima(robot, bump, v, tfinal=None, *, distance=None):
    """The least normal force of each wheel on the way over the bump, rear before front.

    Parameters and errors are those of `margin`.

    Returns
    -------
    minima : tuple of two Minimum
    """
    v = _checks.positive("v", v)
    t, N = turning_points(Crossing(robot, bump, v), tfinal, distance=distance)
    return tuple(
        Minimum(wheel, float(N[i, j]), float(t[j]), float(v * t[j]))
        for wheel, i, j in zip((1, 2), (0, 1), N.argmin(axis=1), strict=True)
    )


def turning_points(crossing, tfinal=None, *, distance=None):
    """Samples of both normal forces that contain every minimum of each.

    Parameters
    ----------
    crossing : Crossing
        With v > 0 if `tfinal` is not given.
    tfinal, distance : float, optional
        As in `margin`.

    Returns
    -------
    t : ndarray, shape (n,)
        Times, s, in order, from 0 to `tfinal`.
    N : ndarray, shape (2, n)
        Normal forces, N.

    Raises
    ------
    ValueError
        As `margin` does; also if the crossing's v is not > 0 and `tfinal` is not given.
    TypeError
        If `crossing` is not a Crossing.
    """
    _checks.instance("crossing", crossing, Crossing)
    tfinal = duration(crossing.robot, crossing.bump, crossing.v, tfinal, distance)
    t, N, error = forces_and_minima(crossing, tfinal)
    scale = max(np.abs(crossing.robot.C @ crossing.robot.equilibrium).max(), -N.min())
    if not (np.isfinite(N).all() and error <= DIGITS_LOST * scale):
        raise ValueError(
            "robot and bump must be so moderate that double precision can tell the forces, "
            f"got {crossing.robot} and {crossing.bump} at v = {crossing.v:g} m/s, "
            f"whose forces may be off by {error:.2g} N"
        )
    return t, N


def forces_and_minima(crossing, tfinal):
    """What `turning_points` looks for, with an estimate of its rounding error (`roundoff`), N.

    Nothing is refused here: forces may overflow, or drown in the error.
    """
    samples, passing = _samples(crossing, tfinal)
    with np.errstate(all="ignore"):
        parts, swings = [], []
        for i in range(0, len(samples) - 1, CHUNK):
            part = slice(i, i + CHUNK + 1)
            memory = crossing.memory(samples[part])
            parts.append(_with_minima(crossing, samples[part], memory))
            swings.append(_swings(crossing, memory)[:, passing[part]])
        t, N = parts[0] if len(parts) == 1 else _joined(parts)
        return t, N, _roundoff(crossing, tfinal, np.concatenate(swings, axis=1))


def _joined(parts):
    t, N = (np.concatenate(part, axis=-1) for part in zip(*parts))
    t, once = np.unique(t, return_index=True)  # the parts share their ends
    return t, N[:, once]


def duration(robot, bump, v, tfinal=None, distance=None):
    """How long a run at speed `v` lasts, s: until `tfinal` if given, else over `distance`.

    Raises
    ------
    ValueError
        If `v` is no finite number, `tfinal` and `distance` are both given, `tfinal` is no finite
        number > 0, or, without it, `v` is not > 0 or `distance_over` refuses.
    """
    if tfinal is None:
        return distance_over(robot, bump, distance) / _checks.positive("v", v)
    _checks.number("v", v)
    if distance is not None:
        raise ValueError(
            f"distance must be None if tfinal is given, got distance={distance}, tfinal={tfinal}"
        )
    return _checks.positive("tfinal", tfinal)


def _with_minima(crossing, t, memory):
    """The samples `t` and the minima between them: times, s, and forces, N."""
    N, slope = _forces(crossing, t, 1, memory)
    dt = np.diff(t)
    s = bottom(dt, np.diff(N), slope[:, :-1], slope[:, 1:])
    wheel, j = np.nonzero((s > 0) & (s < 1))
    at = t[j] + s[wheel, j] * dt[j]
    each = np.arange(len(j))
    for _ in range(2):  # Newton's method, from 1e-2 of a sample to roundoff
        _, slope, bend = _forces(crossing, at, 2, crossing.memory(at))[:, wheel, each]
        step = np.divide(slope, bend, out=np.zeros_like(at), where=bend > 0)
        at = np.clip(at - step, t[j], t[j + 1])
    t, order = np.unique(np.concatenate([t, at]), return_index=True)
    (least,) = _forces(crossing, at, 0, crossing.memory(at))
    return t, np.concatenate([N, least], axis=1)[:, order]


def bottom(dt, rise, before, after):
    """Where the cubic between two samples is least inside, as a part of the way, 0 to 1.

    Parameters
    ----------
    dt, rise, before, after : ndarray
        Length of the interval, how much the force grows in it, and its slopes at both ends.

    Returns
    -------
    s : ndarray
        Not between 0 and 1, or nan, where it has no minimum inside.
    """
    # Its slope is q(s) = p0 + p1 s + p2 s^2.
    p0, end = before * dt, after * dt
    p1, p2 = 6 * rise - 4 * p0 - 2 * end, 3 * (p0 + end - 2 * rise)
    root = np.sqrt(p1 * p1 - 4 * p0 * p2)
    return np.where(p1 > 0, -2 * p0 / (p1 + root), (root - p1) / (2 * p2))  # where q rises


def roundoff(crossing, tfinal):
    """An estimate of the largest rounding error in the forces of a crossing until `tfinal`, N.

    The state is a sum over the modes. Each term carries a few units in its own last place, and
    what an error of the eigenvalue, of the size of a unit in the last place of the *largest* one,
    adds up to while the mode lives. Strong dampers multiply such errors by c. Over 120 robots of
    six kinds (stiff, undamped, critically damped, c up to 1e8), held against 60 digits, the error
    reached 0.7 of this estimate.
    """
    passing = _passing(crossing)
    passing = passing[(passing >= 0) & (passing <= tfinal)]
    return _roundoff(crossing, tfinal, _swings(crossing, crossing.memory(np.append(0, passing))))


def _swings(crossing, memory):
    """How far the bump makes each mode swing, shape (modes, n), from what it remembers of it."""
    return np.abs(crossing.gain[:, :, None] * memory).sum(axis=1)


def _roundoff(crossing, tfinal, swings):
    robot, bump, lam = crossing.robot, crossing.bump, crossing.lam
    modes = np.abs(crossing.free) + swings.max(axis=1)
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
    t = times(t)
    return _forces(crossing, t, order, crossing.memory(t))


def _forces(crossing, t, order, memory):
    robot = crossing.robot
    h, N = crossing.road(t, order + 1), np.empty((order + 1, 2, len(t)))
    w = crossing.state(t, h[0], memory)
    for n in range(order + 1):
        u = np.concatenate(h[n : n + 2])
        N[n] = robot.C @ w + robot.D @ u
        if n < order:
            w = robot.A @ w + robot.B @ u
            if n == 0:
                w += robot.e[:, None]
    return N


def sample_count(robot, v, distance):
    """About how many samples of the forces a margin at speed `v` over a distance takes.

    Speeds, m/s, and distances, m, may be arrays whose shapes fit.

    Raises
    ------
    ValueError
        If a speed or a distance is no finite number > 0.
    TypeError
        If `robot` is not a Robot.
    """
    _checks.instance("robot", robot, Robot)
    v, distance = _checks.positives("v", v), _checks.positives("distance", distance)
    return 400 + 2.5 * distance / v * np.abs(robot.eigenvalues.imag).max()


def _samples(crossing, tfinal):
    """Times, s, in order, and which of them are `_passing`, or the start."""
    # Three clocks: how fast a wheel passes the bump (and moves away from it), how fast the modes
    # swing, and how fast what is left from t = 0 dies away.
    swings = 2.5 * tfinal * np.abs(crossing.lam.imag).max()
    if not swings <= MAX_SAMPLES:
        raise ValueError(
            "v must be so high, or tfinal or distance so short, that the swings of the modes can "
            f"be followed with {MAX_SAMPLES} samples, got v={crossing.v:g}, tfinal={tfinal:g}: "
            f"{swings:.3g}"
        )
    swinging = np.linspace(0, tfinal, 2 + int(swings))
    fastest = 0.1 / np.abs(crossing.lam).max()
    dying = np.geomspace(fastest, max(tfinal, fastest), 2 + int(7 * np.log1p(tfinal / fastest)))
    passing = _passing(crossing)
    t = np.concatenate([passing, swinging, dying])
    inside = (t >= 0) & (t <= tfinal)
    t, first = np.unique(t[inside], return_index=True)
    among = first < np.count_nonzero(inside[: len(passing)])
    among[0] = True
    return t, among


def _passing(crossing):
    """Times at which either wheel passes given places before, on and behind the bump, s."""
    places = 6 * np.sinh(np.arange(-66, 133) / 30)
    return ((places - crossing.start[:, None]) / crossing.rate).ravel()
