"""What the measured spring does to the verdicts: critical speeds and stops, and what draws say.

The laws are those of `suspension.spring_law`, the runs those of `suspension.sweep.drive`. There is
no closed form, so critical values are looked for where the margin changes its sign between samples.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy import stats

from suspension import _checks
from suspension.robot import Robot
from suspension.spring_law import SpringLaw, one_law
from suspension.springs import SpringFit
from suspension.sweep import Drive, drive

__all__ = [
    "Findings",
    "Share",
    "Study",
    "follow_speed",
    "follow_speeds",
    "joint_draws",
    "surviving",
    "zero_speeds",
    "zero_stops",
]

REACH = 1.3  # a critical speed is looked for within this factor of where it was
SAME = 0.1  # critical speeds of two laws nearer than this (of a logarithm) are called the same
MAX_ZOOMS = 17  # then an interval is as short as roundoff
SURE = 0.025  # a verdict with a smaller share of doubt is signed


def zero_speeds(robot, law, road, v, *, zooms=1, geometry="small"):
    """The speeds at which the margin changes its sign between samples: critical speeds.

    Parameters
    ----------
    robot : Robot
    law : SpringLaw
        One law.
    road : callable
        ``road(x) -> (H, dHdx)``.
    v : array_like, shape (n,)
        Speeds in order, m/s, n >= 2. Two zeros between two neighbours are not seen.
    zooms : int
        How often eight intervals take the place of one, at most 17, before a straight line ends it.
    geometry : {"small", "full"}
        As in `drive`.

    Returns
    -------
    speeds : ndarray
        In order, m/s.
    margins : ndarray, shape (n,)
        At the samples, on a ground that pulls, N.

    Raises
    ------
    ValueError
        If `v` are not two speeds or more, > 0 and in order, there are several robots or laws,
        `zooms` is out of its range, or `suspension.sweep.drive` refuses the runs.
    TypeError
        If `robot` is not a Robot, or `law` not a SpringLaw.
    """
    v = _in_order("v", v)
    _one_robot(robot)
    one_law(law)
    return _zeros(_margins_of(robot, law, road, geometry), np.log(v), zooms)


def zero_stops(robot, law, road, v, stops, *, zooms=2):
    """The stiffnesses of a stop at which the margin changes its sign between samples.

    Parameters
    ----------
    robot, road, zooms
        As in `zero_speeds`.
    law : SpringLaw
        One law, whose stop is replaced.
    v : float
        Speed, m/s, > 0.
    stops : array_like, shape (n,)
        Stiffnesses in order, N/m, > 0, n >= 2.

    Returns
    -------
    stops : ndarray
        In order, N/m.
    margins : ndarray, shape (n,)
        At the samples, on a ground that pulls, N.

    Raises
    ------
    ValueError
        If `stops` are not two numbers or more, > 0 and in order, there are several robots or laws,
        `v` or `zooms` is out of its range, or `suspension.sweep.drive` refuses the runs.
    TypeError
        If `robot` is not a Robot, or `law` not a SpringLaw.
    """
    stops = _in_order("stops", stops)
    _one_robot(robot)
    one_law(law)
    v = _checks.positive("v", v)

    def margin(x):
        stopped = SpringLaw(law.beta0, law.beta1, law.beta2, law.delta_max, np.exp(x))
        return drive(robot, road, v, law=stopped, ground="pulls").margin

    return _zeros(margin, np.log(stops), zooms)


def _margins_of(robot, law, road, geometry="small"):
    """The margin as a function of ln v."""

    def margin(x):
        return drive(robot, road, np.exp(x), law=law, ground="pulls", geometry=geometry).margin

    return margin


def _one_robot(robot):
    robots = _checks.instances("robot", robot, Robot)
    if robots.shape:
        raise ValueError(f"robot must be one robot, got robots of shape {robots.shape}")


def _in_order(name, values):
    values = _checks.array(name, values, (None,))
    if values.size < 2 or not (np.diff(values) > 0).all() or not values[0] > 0:
        raise ValueError(f"{name} must hold two numbers > 0 or more, in order, got {values}")
    return values


def _zeros(margin, x, zooms):
    """Where margin(x), a function of arrays, changes its sign between samples, as exp(x)."""
    if _checks.whole("zooms", zooms, 0) > MAX_ZOOMS:
        raise ValueError(f"zooms must be at most {MAX_ZOOMS}, got {zooms}")
    margins = margin(x)
    j = np.flatnonzero(margins[:-1] * margins[1:] < 0)
    ends, values = np.array([x[j], x[j + 1]]), np.array([margins[j], margins[j + 1]])
    return np.exp(_zeros_between(margin, ends, values, int(zooms))), margins


def _zeros_between(margin, ends, values, zooms):
    """Zeros of margin(x) between `ends` at which it has `values` of unlike sign.

    Parameters
    ----------
    margin : callable
        Of an array whose last axis goes over the zeros.
    ends, values : ndarray, shape (2, n)
    """
    for _ in range(zooms if ends.size else 0):
        finer = np.linspace(*ends, 9)
        inside = np.vstack([values[:1], margin(finer[1:-1]), values[1:]])
        first = np.argmax(inside[:-1] * inside[1:] <= 0, axis=0)
        pair = np.array([first, first + 1])
        ends, values = np.take_along_axis(finer, pair, 0), np.take_along_axis(inside, pair, 0)
    return ends[0] - values[0] * (ends[1] - ends[0]) / (values[1] - values[0])


def joint_draws(fit, n=128, seed=2086):
    """Coefficients drawn from the joint confidence distribution of a fit, Student's t.

    ``beta + L z sqrt(nu / q)``: L L^T is the estimated covariance, z standard normal, q chi-square
    with nu = m - 3 degrees of freedom. The numbers are a scrambled Sobol sequence in four
    dimensions, the same in every run.

    Parameters
    ----------
    fit : SpringFit
    n : int
        How many, a power of two.
    seed : int
        Of the scrambling.

    Returns
    -------
    beta : ndarray, shape (3, n)
        N. Some need not be those of a spring that grows.

    Raises
    ------
    ValueError
        If `n` is no power of two from 2 to 65536, `seed` no whole number >= 0, or the fit is one of
        three readings, which leave no error to draw from.
    """
    _checks.instance("fit", fit, SpringFit)
    n, seed = _checks.whole("n", n, 2), _checks.whole("seed", seed, 0)
    if n & (n - 1) or n > 2**16:
        raise ValueError(f"n must be a power of two, at most 65536, got {n}")
    free = fit.free
    if free < 1:
        raise ValueError("fit must have more points than the three coefficients, got 3")
    points = stats.qmc.Sobol(4, rng=seed).random(n).T
    values, axes = np.linalg.eigh(fit.covariance)
    z = stats.norm.ppf(points[:3]) * np.sqrt(free / stats.chi2.ppf(points[3], free))
    return fit.beta[:, None] + axes * np.sqrt(np.maximum(values, 0)) @ z


def follow_speed(robot, law, road, v):
    """Where a critical speed is when the law is another one: the nearest change of sign.

    Parameters
    ----------
    robot : Robot
    road : callable
        ``road(x) -> (H, dHdx)``.
    law : SpringLaw
        n laws.
    v : float
        Where the critical speed was, m/s, > 0.

    Returns
    -------
    speeds : ndarray, shape (n,)
        m/s; nan where the margin has one sign at nine speeds up to a factor 1.3 to both sides.

    Raises
    ------
    ValueError
        If `v` is no finite number > 0, there are several robots, `law` is not a row of laws, or
        `suspension.sweep.drive` refuses the runs.
    TypeError
        If `robot` is not a Robot, or `law` not a SpringLaw.
    """
    return follow_speeds(robot, law, road, [_checks.positive("v", v)])[0]


def follow_speeds(robot, law, road, v):
    """Where several critical speeds are when the law is another one: `follow_speed` in one go.

    Parameters
    ----------
    robot, law, road
        As in `follow_speed`.
    v : array_like, shape (m,)
        Where the critical speeds were, m/s, > 0.

    Returns
    -------
    speeds : ndarray, shape (m, n)
        m/s, or nan, as in `follow_speed`.

    Raises
    ------
    ValueError
        As `follow_speed` does, or if `v` has another shape.
    """
    _one_robot(robot)
    _checks.instance("law", law, SpringLaw)
    if len(law.shape) != 1:
        raise ValueError(f"law must be a row of laws, got shape {law.shape}")
    v = _checks.positives("v", v, (None,))
    x = np.log(v[:, None]) + np.linspace(-1, 1, 9)[:, None, None] * np.log(REACH)
    shape = (v.size, *law.shape)
    margins = _margins_of(robot, law, road)(x).reshape(9, -1)
    turns = margins[:-1] * margins[1:] < 0
    # From the middle outwards, so that the first change of sign is the nearest.
    order = np.argsort(np.abs(np.arange(8) - 3.5), kind="stable")
    some = np.flatnonzero(turns.any(axis=0))
    j = order[np.argmax(turns[order][:, some], axis=0)]
    which, case = np.unravel_index(some, shape)
    ends = np.array([x[j, which, 0], x[j + 1, which, 0]])
    values = np.array([margins[j, some], margins[j + 1, some]])
    speeds = np.full(shape, np.nan)
    margin = _margins_of(robot, law[case], road)
    speeds[which, case] = np.exp(_zeros_between(margin, ends, values, 1))
    return speeds


class Share(NamedTuple):
    """The share of draws in which contact is lost, and what n draws can say of the true one.

    Attributes
    ----------
    found : int
        In how many it is lost.
    n : int
    """

    found: int
    n: int

    @property
    def value(self):
        """The share, 0 to 1."""
        return self.found / self.n

    @property
    def low(self):
        """Lower 95 % confidence bound (Clopper and Pearson 1934); 0 if contact is never lost."""
        return (
            float(stats.beta.ppf(0.05, self.found, self.n - self.found + 1)) if self.found else 0.0
        )

    @property
    def high(self):
        """Upper 95 % bound: about 3 / n if contact is never lost, the rule of three."""
        kept = self.n - self.found
        return float(stats.beta.ppf(0.95, self.found + 1, kept)) if kept else 1.0

    @property
    def verdict(self):
        """True (lost) or False (kept) if the bound leaves less than 2.5 % of doubt, else None."""
        if self.low >= 1 - SURE:
            return True
        return False if self.high <= SURE else None


class Findings(NamedTuple):
    """What one law says, at the estimates and for draws of the coefficients.

    Attributes
    ----------
    run : Drive
        At the asked speeds, on a ground that only pushes.
    drawn : Drive
        The same for the draws: shape (draws, speeds).
    critical : array_like
        Critical speeds, m/s.
    followed : sequence of ndarray
        Where each of these goes with the coefficients (`follow_speeds`), m/s.
    """

    run: Drive
    drawn: Drive
    critical: np.ndarray
    followed: list

    def share(self, i):
        """The draws that lose contact at the i-th speed."""
        kept = self.drawn.kept[:, i]
        return Share(int(np.sum(~kept)), kept.size)

    def margins(self, i):
        """95 % interval of the margin at the i-th speed, N; None if some draws lose contact."""
        kept, margins = self.drawn.kept[:, i], self.drawn.margin[:, i]
        return np.quantile(margins, [0.025, 0.975]) if kept.all() else None


@dataclass(frozen=True, eq=False)
class Study:
    """What several laws say of the asked speeds. No law has a weight: all of them must agree.

    Parameters
    ----------
    asked : sequence of float
        Speeds, m/s.
    delta_max : float
        Largest displacement that was measured, m.
    laws : dict of str to Findings
        The first is the line.
    """

    asked: tuple
    delta_max: float
    laws: dict

    @property
    def line(self):
        """The findings of the first law."""
        return next(iter(self.laws.values()))

    def signed(self, i):
        """True (lost) or False (kept) if every law leaves no doubt of it, else None."""
        verdicts = {law.share(i).verdict for law in self.laws.values()}
        return verdicts.pop() if len(verdicts) == 1 else None

    @property
    def turned(self):
        """At which asked speeds the laws disagree, at the estimates, bool."""
        kept = [law.run.kept for law in self.laws.values()]
        return np.any(kept != kept[0], axis=0)

    @property
    def unsure(self):
        """At which asked speeds the draws leave the verdict on some law open, bool."""
        every = range(len(self.asked))
        return np.array([None in {x.share(i).verdict for x in self.laws.values()} for i in every])

    @property
    def touched(self):
        """At which asked speeds a spring goes beyond `delta_max` on some law, bool."""
        return np.max([law.run.compression for law in self.laws.values()], axis=0) > self.delta_max


def surviving(critical):
    """The critical speeds of the first law, m/s, that are there on every other one, too.

    Parameters
    ----------
    critical : sequence of array_like
        Critical speeds on each law, m/s.

    Returns
    -------
    speeds : list of float

    Raises
    ------
    ValueError
        If there is no law, or a speed is not positive.
    """
    laws = [_checks.positives("critical", speeds, (None,)) for speeds in critical]
    if not laws:
        raise ValueError("critical must hold the critical speeds of one law or more, got none")
    first, *others = laws
    return [float(v) for v in first if all((np.abs(np.log(w / v)) < SAME).any() for w in others)]
