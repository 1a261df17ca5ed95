"""One chart for every robot: the groups that matter, the highest bump, and its limits by hand.

A symmetric robot on a Gaussian bump has five groups. Measure heights by the sag ``m g / 2k`` of
the springs at rest, lengths along the road by sigma, times by ``1 / omega0`` and forces by the
load ``m g / 2``. With ``s`` the place of a wheel on the bump and a prime for ``d/dtau``,

    n_i = 1 + (h_i - y_i) + 2 zeta (h_i - y_i)',   h_i = eta exp(-s_i^2 / 2),   s_i' = nu,
    y'' = (n_1 + n_2) / 2 - 1,   j phi'' = (n_2 - n_1) / 2,   y_i = y -+ phi.

The motion is linear in the height, ``n_i = 1 + eta f_i(tau)``. So at each speed there is one
highest bump that is crossed with contact, ``eta* = -1 / min f``; so is every lower one.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq, minimize_scalar

from suspension import _checks
from suspension.exact import Crossing
from suspension.least_force import DIGITS_LOST, distance_over, forces_and_minima, sample_count
from suspension.road import GaussianBump
from suspension.robot import Robot

__all__ = [
    "Groups",
    "Window",
    "closing",
    "closing_limit",
    "comb",
    "follow",
    "groups",
    "highest_bump",
    "natural_units",
    "skim",
    "still",
    "throw",
    "way",
    "window",
    "window_limit",
]

AHEAD = 8.0  # in units of sigma: so far ahead a bump of natural units begins
MAX_SAMPLES = 2 * 10**7  # of the forces, at all speeds together: half a minute
MOST = 1e150  # its square is a number
MODERATE = 1e-149, 1e149  # so far apart a search for a limit may begin
SPACING = 0.03  # of the first grid of speeds in `window`, in ln v


class Groups(NamedTuple):
    """The five numbers that a symmetric robot and a Gaussian bump are.

    nu : float
        Speed ``v / (sigma omega0)``, ``omega0^2 = 2k / m``: sigmas passed in a swing's 1/omega0.
    zeta : float
        Damping ``c / sqrt(2 k m)``, that of the heave as a part of the critical one.
    eta : float
        Height of the bump over the sag ``m g / 2k`` of the springs at rest.
    j : float
        Inertia ``Izz / (m L^2)``; 1 if each wheel carries half of the mass and knows no other.
    lam : float
        Half of the wheelbase over the width, ``L / sigma``.
    """

    nu: float
    zeta: float
    eta: float
    j: float
    lam: float


class Window(NamedTuple):
    """Where going faster is safest: a speed, and the highest bump crossed there with contact."""

    v: float
    height: float


def groups(robot: Robot, bump: GaussianBump, v: float) -> Groups:
    """The five groups of a symmetric robot that crosses a bump.

    Parameters
    ----------
    robot : Robot
        With k1 = k2, c1 = c2 and L1 = L2, and g > 0.
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.

    Returns
    -------
    groups : Groups

    Raises
    ------
    ValueError
        If the robot is not symmetric or has no weight, or `v` is not a number > 0.

    Examples
    --------
    >>> G = groups(Robot(800, 800), GaussianBump(), v=1.2)
    >>> [round(x, 3) for x in G]
    [1.257, 0.031, 2.845, 0.72, 3.715]
    """
    _symmetric(robot)
    _checks.instance("bump", bump, GaussianBump)
    v = _checks.positive("v", v)
    if robot.g == 0:
        raise ValueError("robot must have a weight (g > 0) to tell a height by, got g=0.0")
    omega0 = np.sqrt(2 * robot.k1 / robot.m)
    return Groups(
        nu=float(v / (bump.sigma * omega0)),
        zeta=float(robot.c1 / (robot.m * omega0)),
        eta=float(bump.height * 2 * robot.k1 / (robot.m * robot.g)),
        j=robot.Izz / (robot.m * robot.L1**2),
        lam=robot.L1 / bump.sigma,
    )


def natural_units(groups: Groups) -> tuple[Robot, GaussianBump, float]:
    """The robot, bump and speed of given groups for which mass, sag, omega0 and sigma are one.

    Parameters
    ----------
    groups : Groups
        nu, j, lam > 0 and zeta >= 0.

    Returns
    -------
    robot : Robot
    bump : GaussianBump
        It begins eight sigma ahead of the front wheel.
    v : float

    Raises
    ------
    ValueError
        If a group is out of its range or not finite, or so extreme that the moment of inertia,
        ``j lam^2``, is no finite number > 0.
    TypeError
        If `groups` is not a Groups.

    Examples
    --------
    >>> robot, bump, v = natural_units(Groups(nu=2, zeta=0.1, eta=3, j=1, lam=4))
    >>> robot.equilibrium[0], bump.height, v
    (np.float64(-1.0), 3.0, 2.0)
    """
    _checks.instance("groups", groups, Groups)
    nu, j, lam = (_checks.positive(name, getattr(groups, name)) for name in ("nu", "j", "lam"))
    zeta = _checks.nonnegative("zeta", groups.zeta)
    moderate = "so moderate that the moment of inertia, j lam^2, is a finite number > 0"
    _checks.number("lam", lam, moderate, lambda x: 0 < j * (x * x) < np.inf)
    robot = Robot(0.5, 0.5, g=1, m=1, Izz=j * lam**2, L1=lam, L2=lam, c1=zeta, c2=zeta)
    return robot, GaussianBump(groups.eta, 1, lam + AHEAD), nu


def way(robot, bump, v, swings=8):
    """How far a run goes that ends so many swings after both wheels have passed the bump, m.

    A distance for `highest_bump` that grows with the speed, as the way of a swing does.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : array_like
        Speeds, m/s, > 0.
    swings : float
        Swings of the slower mode to wait for, >= 0.

    Returns
    -------
    distance : float or ndarray of the shape of `v`

    Raises
    ------
    ValueError
        If a speed is not > 0, `swings` no finite number >= 0, or the bump so far behind the robot
        that a run ends before it begins.
    """
    _checks.instance("robot", robot, Robot)
    _checks.instance("bump", bump, GaussianBump)
    swings = _checks.nonnegative("swings", swings)
    slowest = np.abs(robot.eigenvalues).min()
    passed = bump.centre + robot.L1 + AHEAD * bump.sigma
    distance = passed + swings * 2 * np.pi / slowest * _positive("v", v)[()]
    if not np.all(distance > 0):
        raise ValueError(
            f"bump must lie ahead of the robot at X = 0, or v and swings be so high that a run "
            f"ends beyond, got {bump}: a distance of {np.min(distance):g} m"
        )
    return distance


def highest_bump(
    robot: Robot, bump: GaussianBump, v: ArrayLike, *, distance: ArrayLike | None = None
) -> float | np.ndarray:
    """Height of the highest bump that is crossed with contact: a higher one lifts a wheel.

    Forces are linear in the height, ``N_i = load_i + height f_i(t)``, so the answer is the least
    of ``load_i / max(-f_i)`` over both wheels. Any robot; each wheel has its own load at rest.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
        Its width and place count, its height does not.
    v : array_like
        Speeds, m/s, > 0.
    distance : array_like, optional
        How far the run goes, m, > 0, of a shape that broadcasts with `v` (see `way`); 1.25 m, the
        problem's, if the whole bump lies within.

    Returns
    -------
    height : float or ndarray of the shape of `v`
        In m; inf where no height lifts a wheel, as on a way that ends while the wheels climb.

    Raises
    ------
    ValueError
        If an argument is out of its range, no distance is given and 1.25 m will not do, or robot
        and bump are so extreme that the answer would lose more than six digits.

    Examples
    --------
    >>> highest_bump(Robot(800, 800), GaussianBump(), [0.25, 1.2, 5, 10]).round(4)
    array([0.1175, 0.0056, 0.0149, 0.0332])
    """
    v, distance = _runs(robot, bump, _positive("v", v), distance)
    load = robot.C @ robot.equilibrium
    light = replace(robot, g=0)  # its forces are those of the bump alone, with all their digits
    bump = replace(bump, height=1.0)
    heights = [
        _least_ratio(load, Crossing(light, bump, speed), length / speed)
        for speed, length in zip(v.flat, distance.flat)
    ]
    return np.reshape(heights, v.shape)[()]


def _runs(robot, bump, v, distance):
    """Speeds and distances of the same shape, of runs that are not too long together."""
    if distance is None:
        distance = distance_over(robot, bump)
    distance = _positive("distance", distance)
    if distance.size:
        distance_over(robot, bump, distance.min())  # no wheel may stand on the bump at the start
    try:
        v, distance = np.broadcast_arrays(v, distance)
    except ValueError:
        raise ValueError(
            f"distance must have a shape that goes with that of v, {v.shape}, got {distance.shape}"
        ) from None
    with np.errstate(over="ignore"):
        needed = np.sum(sample_count(robot, v, distance))
    if not needed <= MAX_SAMPLES:
        raise ValueError(
            f"v must be so few or so high, or distance so short, that at most {MAX_SAMPLES:.0e} "
            f"samples of the forces are needed, got {v.size} speeds from {v.min():g} m/s and "
            f"distances up to {distance.max():g} m: {needed:.2g}"
        )
    return v, distance


def _least_ratio(load, crossing, tfinal):
    """Least ``load / lift`` of both wheels, m, where lift is the most that one metre takes away."""
    _, N, error = forces_and_minima(crossing, tfinal)
    lift, largest = -N.min(axis=1), np.abs(N).max()
    if np.isfinite(largest) and error <= DIGITS_LOST * largest and lift.max() <= error:
        return np.inf
    if not error <= DIGITS_LOST * lift.max():
        raise ValueError(
            "robot and bump must be so moderate that double precision can tell the forces, "
            f"got {crossing.robot} and {crossing.bump} at v = {crossing.v:g} m/s, where a metre of "
            f"bump takes {lift.max():.2g} N from a wheel, with an error of {error:.2g} N"
        )
    return min(load[lift > 0] / lift[lift > 0])


def follow(nu, j):
    """The highest bump that is passed slowly: the body rides it, and the crest falls away.

    ``eta* = 2 / ((1 + j) nu^2)``, too high by a part ``3 (1 + j^2) / (1 + j) nu^2``. It holds for
    ``nu`` and ``zeta nu^2`` well below 1, if only one wheel at a time is on the bump (lam > 2).

    Parameters
    ----------
    nu : array_like
        Speed ``v / (sigma omega0)``, > 0.
    j : float
        Inertia ``Izz / (m L^2)``, > 0.

    Returns
    -------
    eta : float or ndarray of the shape of `nu`
        Height of the bump over the sag.

    Raises
    ------
    ValueError
        If `j` or a `nu` is not > 0.
    """
    return 2 / ((1 + _checks.positive("j", j)) * _positive("nu", nu)[()] ** 2)


def throw(nu):
    """The highest bump that is over before the body moves: a kick, then free swing.

    Each wheel hands over the momentum of its spring's force; two kicks at once lift the body
    without turning it. ``eta* = nu / sqrt(2 pi)``, too high by a part ``lam / (j nu)`` after a long
    look. It holds for ``nu`` well above 1 and lam / j and little damping, which raises it by a part
    ``pi zeta / 2``. For j = 1 the wheels do not feel each other, and ``nu`` above 1 is enough: then
    it is too low, by a part ``1 / (2 nu^2)``.

    Parameters
    ----------
    nu : array_like
        Speed ``v / (sigma omega0)``, > 0.

    Returns
    -------
    eta : float or ndarray of the shape of `nu`
        Height of the bump over the sag.

    Raises
    ------
    ValueError
        If a `nu` is not > 0.
    """
    return _positive("nu", nu)[()] / np.sqrt(2 * np.pi)


def skim(nu, zeta):
    """The highest bump that is passed so fast that the body stands still: the damper pulls.

    ``eta* = sqrt(e) / (2 zeta nu)``, too low by a part ``(1 / (2 zeta) - (1 + 1/j) zeta) / nu``. It
    holds for ``zeta nu`` well above 1, and ``nu`` well above ``(1 + 1/j) zeta``.

    Parameters
    ----------
    nu : array_like
        Speed ``v / (sigma omega0)``, > 0.
    zeta : float
        Damping ``c / sqrt(2 k m)``, > 0.

    Returns
    -------
    eta : float or ndarray of the shape of `nu`
        Height of the bump over the sag.

    Raises
    ------
    ValueError
        If `zeta` or a `nu` is not > 0.
    """
    return np.sqrt(np.e) / (2 * _checks.positive("zeta", zeta) * _positive("nu", nu)[()])


def still(nu, zeta):
    """The highest bump under a body that stands still, with the spring that `skim` leaves out.

    ``n = 1 + eta exp(-s^2 / 2) (1 - a s)`` with ``a = 2 zeta nu`` is least at
    ``s = (1 + sqrt(1 + 4 a^2)) / 2a``, whence ``eta* = exp(s^2 / 2) / (a s - 1)``. It holds for
    ``nu`` well above 1 and ``(1 + 1/j) zeta``, where it is lower than what the swing that follows
    allows (`throw`).

    Parameters
    ----------
    nu : array_like
        Speed ``v / (sigma omega0)``, > 0.
    zeta : float
        Damping ``c / sqrt(2 k m)``, > 0.

    Returns
    -------
    eta : float or ndarray of the shape of `nu`
        Height of the bump over the sag; inf at speeds so low that no number tells it.

    Raises
    ------
    ValueError
        If `zeta` or a `nu` is not > 0, or their product is 10^150 or more.
    """
    zeta, nu = _checks.positive("zeta", zeta), _positive("nu", nu)[()]
    # So low a speed that no number tells the height, and a product that none tells.
    with np.errstate(over="ignore", divide="ignore"):
        a = 2 * zeta * nu
        if not np.all(a < 2 * MOST):
            raise ValueError(
                f"nu and zeta must have a product < {MOST:g}, "
                f"got nu={np.max(nu):g} and zeta={zeta:g}"
            )
        return np.exp(_log_still(a))


def _log_still(a):
    """Logarithm of the height of `still`, from ``a = 2 zeta nu``."""
    root = np.sqrt(1 + 4 * a * a)
    return (1 + root) ** 2 / (8 * a * a) - np.log(2 * a * a / (1 + root))


def comb(nu, j, lam):
    """The highest bump for the free swing that an undamped robot keeps, from both of its kicks.

    The kicks come ``2 lam / nu`` apart, in or out of step with the swing of the first. They leave
    the heave with an amplitude of ``cos(lam / nu)`` and the pitch with one of
    ``sin(lam / (sqrt(j) nu)) / sqrt(j)`` kicks, each weakened as it swings while the bump passes::

        1 / eta* = sqrt(2 pi) / nu (|cos(lam / nu)| exp(-1 / (2 nu^2))
                   + |sin(lam / (sqrt(j) nu))| exp(-1 / (2 j nu^2)) / sqrt(j)).

    Sooner or later the two swings unload a wheel together, unless their frequencies have a simple
    ratio (j = 1); so a long look finds this, a short one a little more.

    Parameters
    ----------
    nu : array_like
        Speed ``v / (sigma omega0)``, > 0.
    j, lam : float
        Inertia ``Izz / (m L^2)`` and wheelbase ``L / sigma``, > 0.

    Returns
    -------
    eta : float or ndarray of the shape of `nu`
        Height of the bump over the sag; inf at speeds so low that no number tells it.

    Raises
    ------
    ValueError
        If `j`, `lam` or a `nu` is not > 0.
    """
    nu = _positive("nu", nu)[()]
    j, lam = _checks.positive("j", j), _checks.positive("lam", lam)
    heave = np.abs(np.cos(lam / nu)) * np.exp(-1 / (2 * nu**2))
    pitch = np.abs(np.sin(lam / (np.sqrt(j) * nu))) * np.exp(-1 / (2 * j * nu**2)) / np.sqrt(j)
    with np.errstate(divide="ignore"):  # so slow that nothing swings
        return nu / (np.sqrt(2 * np.pi) * (heave + pitch))


def window_limit(zeta):
    """Where the lines of `throw` and `still` meet: the top of the window "faster is safer".

    Parameters
    ----------
    zeta : float
        Damping ``c / sqrt(2 k m)``, > 0.

    Returns
    -------
    nu, eta : float
        Speed and height, dimensionless.

    Raises
    ------
    ValueError
        If `zeta` is not between 10^-149 and 10^149: beyond, the search overflows.
    """
    zeta = _checks.interval("zeta", zeta, *MODERATE)

    def above(x):  # how far `still` lies above `throw` at a = exp(x), logarithmic; it falls
        return _log_still(np.exp(x)) - np.log(throw(np.exp(x) / (2 * zeta)))

    far = 10 + abs(np.log(zeta))
    nu = np.exp(brentq(above, -far, far, xtol=1e-14)) / (2 * zeta)
    return float(nu), float(throw(nu))


def closing_limit(eta):
    """The damping above which the window is closed for a bump, by the lines of `window_limit`.

    ``zeta = a / (2 sqrt(2 pi) eta)``, where ``a`` is the ``2 zeta nu`` of `still` at this height.

    Parameters
    ----------
    eta : float
        Height of the bump over the sag, > 0.

    Returns
    -------
    zeta : float
        Damping ``c / sqrt(2 k m)``.

    Raises
    ------
    ValueError
        If `eta` is not between 10^-149 and 10^149: beyond, the search overflows.
    """
    eta = _checks.interval("eta", eta, *MODERATE)
    far = 10 + abs(np.log(eta))
    a = np.exp(brentq(lambda x: _log_still(np.exp(x)) - np.log(eta), -far, far, xtol=1e-14))
    return float(a / (2 * np.sqrt(2 * np.pi) * eta))


def window(robot, bump, vmin, vmax, *, distance=None):
    """Where "faster is safer" is most so: the safest speed beyond the slowest that loses contact.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    vmin, vmax : float
        Range of speeds, m/s, 0 < vmin < vmax.
    distance : float or callable, optional
        As for `highest_bump`, or a function of the speeds.

    Returns
    -------
    window : Window or None
        None if no speed loses contact, or none beyond the slowest that does is safer. The window is
        open, the bump itself is crossed there with contact, if its height is more than the bump's.
        It is found among speeds 3 % apart, then to roundoff.

    Raises
    ------
    ValueError
        If an argument is out of its range, or `highest_bump` refuses.
    """
    vmin, vmax = _checks.ends("vmin", vmin, "vmax", vmax)
    if not (distance is None or callable(distance)):
        distance = _checks.positive("distance", distance)

    def height(v):
        far = distance(v) if callable(distance) else distance
        return highest_bump(robot, bump, v, distance=far)

    v = np.geomspace(vmin, vmax, 3 + int(np.log(vmax / vmin) / SPACING))
    heights = height(v)
    lost = np.flatnonzero(heights <= bump.height)
    if not len(lost):
        return None
    best = lost[0] + int(np.argmax(heights[lost[0] :]))
    if best == lost[0]:
        return None
    if best == len(v) - 1:
        return Window(float(v[best]), float(heights[best]))
    top = minimize_scalar(
        lambda x: -height(np.exp(x)),
        bounds=np.log(v[[best - 1, best + 1]]),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return Window(float(np.exp(top.x)), float(-top.fun))


def closing(robot, bump, vmin, vmax, *, distance=None):
    """The damping above which the window is closed for a bump, exactly.

    Parameters
    ----------
    robot : Robot
        A symmetric one; its damping does not count.
    bump : GaussianBump
    vmin, vmax : float
        Range of speeds, m/s, 0 < vmin < vmax.
    distance : float or callable, optional
        As for `window`.

    Returns
    -------
    zeta : float
        Damping ``c / sqrt(2 k m)`` at which the top of the window is as high as the bump.

    Raises
    ------
    ValueError
        If the robot is not symmetric, or no window closes on the bump at a damping between a
        hundredth and a hundred times that of `closing_limit`.
    """
    eta = groups(robot, bump, 1.0).eta
    vmin, vmax = _checks.ends("vmin", vmin, "vmax", vmax)
    if not eta > 0:
        raise ValueError(f"bump must have a height > 0, got {bump}")

    def above(x):
        c = np.exp(x) * np.sqrt(2 * robot.k1 * robot.m)
        top = window(replace(robot, c1=c, c2=c), bump, vmin, vmax, distance=distance)
        return -1.0 if top is None else np.log(top.height / bump.height)

    start = np.log(closing_limit(eta))
    step = 0.25 if above(start) > 0 else -0.25
    for x in np.arange(start, start + np.copysign(np.log(100), step), step):
        if above(x + step) * step < 0:
            return float(np.exp(brentq(above, *sorted((x, x + step)), xtol=1e-8)))
    raise ValueError(
        f"bump must be one whose window closes between {vmin:g} and {vmax:g} m/s, got {bump}"
    )


def _symmetric(robot):
    _checks.instance("robot", robot, Robot)
    if (robot.k1, robot.c1, robot.L1) != (robot.k2, robot.c2, robot.L2):
        raise ValueError(
            "robot must be symmetric (k1 = k2, c1 = c2, L1 = L2) to have five groups, got "
            f"k1={robot.k1}, k2={robot.k2}, c1={robot.c1}, c2={robot.c2}, "
            f"L1={robot.L1}, L2={robot.L2}"
        )


def _positive(name, value):
    value = _checks.array(name, value)
    if not (value > 0).all():
        raise ValueError(f"{name} must be > 0, got {value.min():g}")
    return value
