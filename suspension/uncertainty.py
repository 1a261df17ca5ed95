"""From the fitted spring to the verdict: what the regression's uncertainty does to the answers.

The stiffness is the only number that is measured. Given the data its confidence distribution is a
t distribution about the estimate; speeds and verdicts are functions of the stiffness, so their
distributions follow without any further assumption or sampling.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.branches import End, branches
from suspension.contact import (
    critical_speeds,
    critical_stiffness,
    is_lost,
    margin,
    regimes_between,
)
from suspension.least_force import distance_over
from suspension.robot import Robot
from suspension.springs import SpringFit, Stiffness

__all__ = [
    "CriticalSpeed",
    "critical_speed_intervals",
    "critical_speeds_by_stiffness",
    "loss_probability",
]

WIDEST = 20.0  # stiffnesses further from the estimate than this factor are left out
TAIL = 1e-9  # so little is left out at each end of a distribution
EXACT = 1e-9  # relative errors below this are roundoff: the stiffness is taken as known


class CriticalSpeed(NamedTuple):
    """A critical speed while the stiffness goes through its confidence interval.

    Attributes
    ----------
    speed : float or None
        At the estimate of the stiffness, m/s; None if there is none.
    low, high : float
        The least and the largest value, m/s.
    born, dies : End or None
        Where inside the interval of the stiffness it begins and ends to exist: `End.k`, `End.v`
        and `End.why`, ``"pair"`` if two critical speeds appear or vanish together, ``"range"`` if
        it enters or leaves the range of speeds. None if it exists to that end of the interval.
    """

    speed: float | None
    low: float
    high: float
    born: End | None
    dies: End | None

    @property
    def everywhere(self):
        """Whether it exists in the whole interval of the stiffness."""
        return self.born is None and self.dies is None


def critical_speed_intervals(stiffness, robot, bump, vmin, vmax, level=0.95, *, distance=None):
    """Every critical speed with its confidence interval.

    Each critical speed is followed while the stiffness goes through its interval. Where a pair
    appears or vanishes on the way the interval ends there, and that is told.

    Parameters
    ----------
    stiffness : Stiffness or SpringFit
        Of a fit, the slope at zero.
    robot : Robot
        Both stiffnesses are replaced.
    bump : GaussianBump
    vmin, vmax : float
        Range of speeds, m/s.
    level : float
        Confidence level of each interval.
    distance : float, optional
        How far each run goes, m: 1.25 m if the whole bump lies within
        (`suspension.least_force.distance_over`).

    Returns
    -------
    intervals : tuple of CriticalSpeed
        In order of speed; also those that do not exist at the estimate itself. Stiffnesses below
        a twentieth and above twenty times the estimate are left out.

    Raises
    ------
    ValueError
        If an argument is out of its range, the fit is one of three readings, which leave no error,
        or `suspension.critical_speeds` or `suspension.branches.branches` refuses.
    TypeError
        If `stiffness` is neither a Stiffness nor a SpringFit.
    """
    stiffness = _stiffness(stiffness)
    return _intervals([stiffness], robot, bump, vmin, vmax, level, distance)[0]


def critical_speeds_by_stiffness(fit, robot, bump, vmin, vmax, level=0.95, *, distance=None):
    """What each of the three stiffnesses of a spring does to the critical speeds.

    Parameters
    ----------
    fit : SpringFit
    robot : Robot
        Both stiffnesses are replaced; half of its weight is the load of the tangent.
    bump, vmin, vmax, level, distance
        As in `critical_speed_intervals`.

    Returns
    -------
    pairs : tuple of (Stiffness, tuple of CriticalSpeed)

    Raises
    ------
    ValueError
        As `critical_speed_intervals` does.
    """
    _checks.instance("fit", fit, SpringFit)
    _checks.instance("robot", robot, Robot)
    stiffnesses = [_positive("fit", one) for one in fit.stiffnesses(robot.m * robot.g / 2)]
    intervals = _intervals(stiffnesses, robot, bump, vmin, vmax, level, distance)
    return tuple(zip(stiffnesses, intervals))


def _intervals(stiffnesses, robot, bump, vmin, vmax, level, distance):
    """The critical speeds for each stiffness, from branches followed once for all of them."""
    distance = distance_over(robot, bump, distance)
    bounds = [_bounds(stiffness, *stiffness.interval(level)) for stiffness in stiffnesses]
    kmin, kmax = np.min(bounds), np.max(bounds)
    first = stiffnesses[0].value
    if kmax - kmin <= EXACT * first:
        exact = replace(robot, k1=first, k2=first)
        speeds = critical_speeds(exact, bump, vmin, vmax, distance=distance)
        known = tuple(CriticalSpeed(v, v, v, None, None) for v in map(float, speeds))
        return [known] * len(stiffnesses)
    found = branches(robot, bump, vmin, vmax, kmin, kmax, check=first, distance=distance)
    return [_within(found, stiffness.value, *ends) for stiffness, ends in zip(stiffnesses, bounds)]


def _within(found, k, low, high):
    """The parts of the branches between two stiffnesses, in order of speed."""
    parts = []
    for branch in found:
        extent = branch.extent(low, high)
        if extent is not None:
            born = branch.first if branch.first and branch.first.k > low else None
            dies = branch.last if branch.last and branch.last.k < high else None
            parts.append(CriticalSpeed(branch.speed(k), *extent, born, dies))
    return tuple(sorted(parts, key=lambda part: part.low * part.high))


def loss_probability(stiffness, robot, bump, v, *, distance=None):
    """How much of the stiffness's confidence distribution loses contact at speed `v`, 0 to 1.

    Between two critical stiffnesses the verdict is one and the same, so this is a sum of
    differences of the distribution function.

    Parameters
    ----------
    stiffness : Stiffness or SpringFit
        Of a fit, the slope at zero.
    robot : Robot
        Both stiffnesses are replaced.
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.
    distance : float, optional
        As in `critical_speed_intervals`.

    Returns
    -------
    probability : float

    Raises
    ------
    ValueError
        If an argument is out of its range, the fit is one of three readings, which leave no error,
        or `suspension.critical.critical_stiffness` refuses.
    TypeError
        If `stiffness` is neither a Stiffness nor a SpringFit.
    """
    stiffness = _stiffness(stiffness)
    distance = distance_over(robot, bump, distance)
    k = stiffness.distribution

    def margin_at(k):
        return margin(replace(robot, k1=k, k2=k), bump, v, distance=distance)

    if stiffness.error <= EXACT * stiffness.value:
        return float(is_lost(margin_at(stiffness.value)))
    low, high = _bounds(stiffness, k.ppf(TAIL), k.ppf(1 - TAIL))
    nominal = replace(robot, k1=stiffness.value, k2=stiffness.value)
    flips = critical_stiffness(nominal, bump, v, low, high, distance=distance)
    found = regimes_between(margin_at, [low, *flips, high], unit="N/m")
    return float(np.diff([0.0, *k.cdf(found.critical), 1.0]) @ found.lost)


def _bounds(stiffness, low, high):
    """The ends of an interval, but none further from the estimate than a factor `WIDEST`."""
    return max(low, stiffness.value / WIDEST), min(high, stiffness.value * WIDEST)


def _stiffness(stiffness):
    if isinstance(stiffness, SpringFit):
        return _positive("stiffness", stiffness.slope)
    if isinstance(stiffness, Stiffness):
        return _positive("stiffness", stiffness)
    raise TypeError(f"stiffness must be a Stiffness or a SpringFit, got {stiffness!r}")


def _positive(name, stiffness):
    _checks.positive(f"value of {name} ({stiffness.name})", stiffness.value)
    return stiffness
