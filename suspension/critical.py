"""Where the verdict flips: every speed, or stiffness, at which the margin of contact is zero."""

from dataclasses import fields, replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.optimize import brentq

from suspension import _checks
from suspension.least_force import distance_over, margin, sample_count
from suspension.road import GaussianBump
from suspension.robot import Robot

__all__ = ["critical_speeds", "critical_stiffness", "sensitivity", "zeros"]

RESOLUTION = 1e-5  # two critical values closer to each other than this (relative) may be missed
MAX_SAMPLES = 4 * 10**6  # of the forces, in all margins on the first grid: some ten seconds


def critical_speeds(
    robot: Robot,
    bump: GaussianBump,
    vmin: float,
    vmax: float,
    *,
    distance: float | None = None,
) -> np.ndarray:
    """Every speed at which the margin is zero: only there can the verdict change.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    vmin, vmax : float
        Range of speeds, m/s, 0 < vmin < vmax.
    distance : float, optional
        How far each run goes, m: 1.25 m if the whole bump lies within (`distance_over`).

    Returns
    -------
    v : ndarray, shape (n,)
        In order, m/s, to roundoff. Two that differ by less than 1e-5 of their size may be missed.

    Raises
    ------
    ValueError
        If an argument is out of its range; if `suspension.least_force.distance_over` refuses; or if
        the search would need more than 4 million samples of the forces; the number is told.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> critical_speeds(Robot(800, 800), GaussianBump(), 0.1, 30).round(4)
    array([ 0.4367,  7.9457, 20.4232])
    """
    distance = distance_over(robot, bump, distance)
    vmin, vmax = _checks.ends("vmin", vmin, "vmax", vmax)
    cost = np.mean([sample_count(robot, v, distance) for v in np.geomspace(vmin, vmax)])
    x = _logarithmic(robot, bump, "vmin and vmax", vmin, vmax, cost, distance)
    return np.exp(zeros(lambda x: margin(robot, bump, np.exp(x), distance=distance), x))


def critical_stiffness(robot, bump, v, kmin, kmax, *, distance=None):
    """Every rear stiffness k1 at which the margin is zero, when k2 / k1 stays as it is.

    Parameters
    ----------
    robot, bump, distance
        As in `critical_speeds`.
    v : float
        Speed, m/s, > 0.
    kmin, kmax : float
        Range of k1, N/m, 0 < kmin < kmax.

    Returns
    -------
    k : ndarray, shape (n,)
        In order, N/m, to roundoff. Two that differ by less than 1e-5 of their size may be missed.

    Raises
    ------
    ValueError
        As `critical_speeds` does.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> critical_stiffness(Robot(800, 800), GaussianBump(), 5, 200, 2000).round(2)
    array([572.83])
    """
    distance = distance_over(robot, bump, distance)
    v = _checks.positive("v", v)
    kmin, kmax = _checks.ends("kmin", kmin, "kmax", kmax)

    def with_stiffness(k1):
        return replace(robot, k1=k1, k2=k1 * (robot.k2 / robot.k1))

    stiffnesses = np.geomspace(kmin, kmax)
    cost = np.mean([sample_count(with_stiffness(k), v, distance) for k in stiffnesses])
    x = _logarithmic(robot, bump, "kmin and kmax", kmin, kmax, cost, distance)
    return np.exp(zeros(lambda x: margin(with_stiffness(np.exp(x)), bump, v, distance=distance), x))


def sensitivity(robot, bump, v, *names, distance=None):
    """How the margin answers to parameters, ``d margin / d ln p``, all of `names` scaled alike.

    A critical speed moves by ``d ln v / d ln p = -sensitivity(..., p) / sensitivity(..., "v")``.

    Parameters
    ----------
    robot, bump, distance
        As in `critical_speeds`.
    v : float
        Speed, m/s, > 0.
    *names : str
        Parameters of the robot, such as ``"k1", "k2"``, or ``"v"``.

    Returns
    -------
    sensitivity : float
        In N: a hundredth of it is the change that one percent makes.

    Raises
    ------
    ValueError
        If an argument is out of its range, no name is given, or one is no parameter's.
    """
    distance = distance_over(robot, bump, distance)
    v = _checks.positive("v", v)
    if not names:
        raise ValueError("names must hold at least one parameter, got none")
    allowed = ["v", *(field.name for field in fields(robot) if field.init)]
    for name in names:
        _checks.one_of("names", name, allowed)

    def scaled_margin(factor):
        values = {name: factor * getattr(robot, name) for name in names if name != "v"}
        speed = factor * v if "v" in names else v
        # The run is given by its time, which a wheelbase a little longer cannot refuse.
        return margin(replace(robot, **values), bump, speed, distance / speed)

    step = 1e-5
    return (scaled_margin(1 + step) - scaled_margin(1 - step)) / (2 * step)


def zeros(f, x):
    """Every zero of a continuous function of one variable.

    Between two samples the function needs a slope of ``(|f(a)| + |f(b)|) / (b - a)`` to have a
    zero there if the signs are equal, or more than one if not. Wherever twice the slope found
    nearby is enough, samples are added, down to a distance of 1e-5.

    Parameters
    ----------
    f : callable
        ``f(x) -> float``.
    x : array_like, shape (n,)
        Samples in order, n >= 2, dense enough to show the hills and valleys of f.

    Returns
    -------
    zeros : ndarray
        In order, between x[0] and x[-1].

    Raises
    ------
    ValueError
        If `x` does not hold two finite numbers or more, in order, or a value of `f` is no finite
        number: it would hide a zero.
    TypeError
        If `f` is not a function.
    """
    _checks.function("f", f, "f(x) -> float")
    x = _checks.in_order("x", x, 2)

    def value(s):
        return _checks.number(f"f({s:g})", f(s))

    y = np.array([value(s) for s in x])
    while True:
        dx = np.diff(x)
        slope = _largest_nearby(np.abs(np.diff(y)) / dx)
        unsure = (np.abs(y[:-1]) + np.abs(y[1:]) < 2 * slope * dx) & (dx > RESOLUTION)
        if not unsure.any():
            break
        middle = (x[:-1] + x[1:])[unsure] / 2
        place = np.flatnonzero(unsure) + 1
        x = np.insert(x, place, middle)
        y = np.insert(y, place, [value(s) for s in middle])
    changes = np.flatnonzero(y[:-1] * y[1:] < 0)
    inside = [brentq(value, x[j], x[j + 1], xtol=1e-14, rtol=1e-15) for j in changes]
    return np.sort(np.concatenate([x[y == 0], inside]))


def _largest_nearby(slope):
    """The largest of each value and its two neighbours on either side."""
    padded = np.pad(slope, 2, mode="edge")
    return sliding_window_view(padded, 5).max(axis=1)


def _logarithmic(robot, bump, names, low, high, cost, distance):
    """A grid in ln v or ln k, dense enough for every ripple; `cost` is that of one value in it.

    The margin ripples with the phase omega (L1 + L2) / v that a mode gains between the wheels. A
    bump that lasts for more than a swing, omega sigma / v > 6, leaves the mode at rest. So there
    is at most about one ripple in a factor e for each sigma of the wheelbase.
    """
    ripples = 1 + (robot.L1 + robot.L2) / bump.sigma
    count = (20 + 10 * ripples) * np.log(high / low)
    needed = count * cost
    if not needed <= MAX_SAMPLES:
        raise ValueError(
            f"{names} must be so close to each other, and {names.split()[0]} so far from zero, "
            f"that at most {MAX_SAMPLES:.0e} samples of the forces are needed, "
            f"got {low:g} and {high:g} with sigma={bump.sigma:g}, distance={distance:g}: "
            f"{needed:.2g}"
        )
    return np.linspace(np.log(low), np.log(high), 2 + int(count))
