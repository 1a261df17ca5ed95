"""Where the verdict flips: every speed, or stiffness, at which the margin of contact is zero."""

from dataclasses import fields, replace

import numpy as np
from scipy.optimize import brentq

from suspension import _checks
from suspension.least_force import margin

__all__ = ["critical_speeds", "critical_stiffness", "sensitivity", "zeros"]

RESOLUTION = 1e-5  # two critical values closer to each other than this (relative) may be missed


def critical_speeds(robot, bump, vmin, vmax):
    """Every speed at which the margin is zero: only there can the verdict change.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    vmin, vmax : float
        Range of speeds, m/s, 0 < vmin < vmax.

    Returns
    -------
    v : ndarray, shape (n,)
        In order, m/s, to roundoff.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> critical_speeds(Robot(800, 800), GaussianBump(), 0.1, 30).round(4)
    array([ 0.4367,  7.9457, 20.4232])
    """
    vmin, vmax = _range("vmin", vmin, "vmax", vmax)
    x = _logarithmic(robot, bump, vmin, vmax)
    return np.exp(zeros(lambda x: margin(robot, bump, np.exp(x)), x))


def critical_stiffness(robot, bump, v, kmin, kmax):
    """Every rear stiffness k1 at which the margin is zero, when k2 / k1 stays as it is.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.
    kmin, kmax : float
        Range of k1, N/m, 0 < kmin < kmax.

    Returns
    -------
    k : ndarray, shape (n,)
        In order, N/m, to roundoff.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> critical_stiffness(Robot(800, 800), GaussianBump(), 5, 200, 2000).round(2)
    array([572.83])
    """
    kmin, kmax = _range("kmin", kmin, "kmax", kmax)

    def at(x):
        k1 = np.exp(x)
        return margin(replace(robot, k1=k1, k2=k1 * robot.k2 / robot.k1), bump, v)

    return np.exp(zeros(at, _logarithmic(robot, bump, kmin, kmax)))


def sensitivity(robot, bump, v, *names):
    """How the margin answers to parameters, ``d margin / d ln p``, all of `names` scaled alike.

    A critical speed moves by ``d ln v / d ln p = -sensitivity(..., p) / sensitivity(..., "v")``.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.
    *names : str
        Parameters of the robot, such as ``"k1", "k2"``, or ``"v"``.

    Returns
    -------
    sensitivity : float
        In N: a hundredth of it is the change that one percent makes.
    """
    step, allowed = 1e-5, ["v", *(field.name for field in fields(robot))]
    for name in names:
        _checks.one_of("names", name, allowed)

    def at(factor):
        values = {name: factor * getattr(robot, name) for name in names if name != "v"}
        return margin(replace(robot, **values), bump, v * factor if "v" in names else v)

    return (at(1 + step) - at(1 - step)) / (2 * step)


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
    """
    x = _checks.array("x", x, (None,))
    y = np.array([f(s) for s in x])
    while True:
        dx, dy = np.diff(x), np.abs(np.diff(y))
        slope = np.pad(dy / dx, 2, mode="edge")
        slope = np.max([slope[i : i + len(dx)] for i in range(5)], axis=0)
        unsure = (np.abs(y[:-1]) + np.abs(y[1:]) < 2 * slope * dx) & (dx > RESOLUTION)
        if not unsure.any():
            break
        new = (x[:-1] + x[1:])[unsure] / 2
        at = np.nonzero(unsure)[0] + 1
        x, y = np.insert(x, at, new), np.insert(y, at, [f(s) for s in new])
    inside = [
        brentq(f, x[j], x[j + 1], xtol=1e-14, rtol=1e-15) for j in np.nonzero(y[:-1] * y[1:] < 0)[0]
    ]
    return np.sort(np.concatenate([x[y == 0], inside]))


def _logarithmic(robot, bump, low, high):
    # The margin ripples with the phase omega (L1 + L2) / v that a mode gains between the wheels.
    # A bump that lasts for more than a swing, omega sigma / v > 6, leaves the mode at rest. So
    # there is at most about one ripple in a factor e for each sigma of the wheelbase.
    ripples = 1 + (robot.L1 + robot.L2) / bump.sigma
    samples = (20 + 10 * ripples) * np.log(high / low)
    return np.linspace(np.log(low), np.log(high), 2 + int(samples))


def _range(low_name, low, high_name, high):
    low = _checks.positive(low_name, low)
    return low, _checks.number(high_name, high, f"> {low_name} = {low:g}", lambda x: x > low)
