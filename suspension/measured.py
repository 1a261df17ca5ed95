"""The spring as it was measured: preload, curvature, and an end stop beyond the readings.

The force of a spring pair is the fitted parabola of Part I where it was measured, ``0 <= delta <=
delta_max``, and its tangents at the two ends outside. A stop of stiffness ``stop`` adds its force
beyond delta_max: a unilateral contact. The equations of motion are those of the linear robot with
this force in place of ``k delta``, so they are no longer linear; everything here runs with RK4.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy import stats

from suspension import _checks
from suspension.least_force import COURSE
from suspension.road import profile
from suspension.robot import Robot
from suspension.springs import SpringFit

__all__ = [
    "Drive",
    "SpringLaw",
    "drive",
    "follow_speed",
    "joint_draws",
    "linearised",
    "make_measured_gfunc",
    "rest",
    "zero_speeds",
]

MAX_WORK = 3 * 10**8  # cases times steps: half a minute and more
FEWEST = 1000  # steps of a run, 23 for each sigma of the problem's bump
ALL_ROUND = 2.5  # RK4 is stable where |z| is smaller and Re z <= 0
WITHIN = 2  # steps within the longest one that is stable
REACH = 1.3  # a critical speed is looked for within this factor of where it was


@dataclass(frozen=True, eq=False)
class SpringLaw:
    """The force of a spring pair, ``F(delta)``, for one law or for many side by side.

    With ``x = delta / delta_max`` and x' the nearest point to x in [0, 1],

    ``F = beta0 + beta1 x + beta2 x' (2 x - x') + stop max(0, delta - delta_max)``:

    the parabola of Eq. 9 inside, its end tangents outside, and the stop on top.

    Parameters
    ----------
    beta0, beta1, beta2 : array_like, shape () or (n,)
        Coefficients of Eq. 9, N. The force must grow: ``beta1 > 0``, ``beta1 + 2 beta2 > 0``.
    delta_max : float
        Largest displacement that was measured, m, > 0: the place of the stop.
    stop : array_like, shape () or (n,)
        Stiffness of the stop, N/m, >= 0; 0 is none.

    Raises
    ------
    ValueError
        If an argument is out of its range.

    Examples
    --------
    >>> law = SpringLaw(0.0, 13.2, 0.0, 0.0165, stop=8000)
    >>> law.force([0, 0.0165, 0.0175]).round(2)
    array([ 0. , 13.2, 22. ])
    """

    beta0: np.ndarray
    beta1: np.ndarray
    beta2: np.ndarray
    delta_max: float
    stop: np.ndarray = 0.0

    def __post_init__(self):
        names = ("beta0", "beta1", "beta2", "stop")
        values = [_checks.array(name, getattr(self, name)) for name in names]
        if not (values[1] > 0).all():
            raise ValueError(f"beta1 must be > 0, got {values[1].min():g}: the force must grow")
        if not (values[3] >= 0).all():
            raise ValueError(f"stop must be >= 0, got {values[3].min():g}")
        try:
            values = np.broadcast_arrays(*values)
        except ValueError:
            shapes = [value.shape for value in values]
            raise ValueError(f"beta0, beta1, beta2 and stop must fit, got {shapes}") from None
        end = values[1] + 2 * values[2]
        if not (end > 0).all():
            raise ValueError(
                f"beta2 must be > -beta1 / 2, so that the force grows up to delta_max, got a slope "
                f"of {end.min():g} N there"
            )
        for name, value in zip(names, values):
            object.__setattr__(self, name, value)
        object.__setattr__(self, "delta_max", _checks.positive("delta_max", self.delta_max))

    @classmethod
    def of(cls, fit, stop=0.0):
        """The law of a fit: its parabola, with a stop of so many N/m."""
        _checks.instance("fit", fit, SpringFit)
        return cls(*fit.beta, fit.delta_max, stop)

    @property
    def shape(self):
        """() for one law, (n,) for n of them."""
        return self.stop.shape

    def __getitem__(self, index):
        """Some of the laws, indexed like an array."""
        beta = (coefficient[index] for coefficient in (self.beta0, self.beta1, self.beta2))
        return SpringLaw(*beta, self.delta_max, self.stop[index])

    def force(self, delta):
        """Force in N at compressions `delta` in m; shapes broadcast."""
        x = np.asarray(delta) / self.delta_max
        nearest = np.minimum(np.maximum(x, 0), 1)
        force = self.beta0 + self.beta1 * x + self.beta2 * nearest * (2 * x - nearest)
        if self.stop.any():
            force = force + self.stop * self.delta_max * np.maximum(x - 1, 0)
        return force

    def tangent(self, delta):
        """Slope dF/ddelta in N/m; at the stop, where it jumps, that beyond it."""
        x = np.asarray(delta) / self.delta_max
        slope = (self.beta1 + 2 * self.beta2 * np.clip(x, 0, 1)) / self.delta_max
        return slope + self.stop * (x >= 1)

    def displacement(self, load):
        """The compression in m at which the spring carries `load` in N: the root of F = load."""
        load = np.asarray(load)
        end = self.beta1 + 2 * self.beta2
        at_end = self.beta0 + self.beta1 + self.beta2
        inside = np.minimum(np.maximum(load, self.beta0), at_end)
        root = np.sqrt(self.beta1**2 - 4 * self.beta2 * (self.beta0 - inside))
        x = 2 * (inside - self.beta0) / (self.beta1 + root)
        below = np.minimum(load - self.beta0, 0) / self.beta1
        above = np.maximum(load - at_end, 0) / (end + self.stop * self.delta_max)
        return self.delta_max * (x + below + above)


def rest(robot, law, small=True):
    """The state at rest on flat ground: each spring carries its wheel's share of the weight.

    Parameters
    ----------
    robot : Robot
        Its stiffnesses are not used.
    law : SpringLaw
        Of both springs.
    small : bool
        Whether the pitch is taken for small; if not, ``sin theta`` takes the place of theta.

    Returns
    -------
    w : ndarray, shape (4,) or (4, n)
    """
    _checks.instance("robot", robot, Robot)
    _checks.instance("law", law, SpringLaw)
    span = robot.L1 + robot.L2
    # The rear wheel carries L2 / span of the weight, the front wheel L1 / span.
    rear, front = (-law.displacement(robot.m * robot.g * L / span) for L in (robot.L2, robot.L1))
    tilt = (front - rear) / span  # of ends that are so much lower than unstretched
    w = np.zeros((4, *np.shape(rear)))
    w[0] = (robot.L2 * rear + robot.L1 * front) / span
    w[2] = tilt if small else np.arcsin(tilt)
    return w


def linearised(robot, law, w=None):
    """The linear robot that the springs' tangents make: what small swings about a state feel.

    Parameters
    ----------
    robot : Robot
        Its stiffnesses are replaced.
    law : SpringLaw
        One law.
    w : array_like, shape (4,), optional
        A state on flat ground, small pitch; at rest if not given.

    Returns
    -------
    Robot
        Its `A` is the Jacobian of ``w' = g(w)`` at `w`.
    """
    _checks.instance("robot", robot, Robot)
    _one_law(law)
    w = rest(robot, law) if w is None else _checks.array("w", w, (4,))
    k1, k2 = law.tangent(-(w[0] + robot.arms * w[2]))
    return replace(robot, k1=k1, k2=k2)


def make_measured_gfunc(robot, law, road, small=True):
    """Return ``gfunc(w, t, v) -> (wdot, N1, N2)``, as `suspension.course.make_gfunc` does.

    Parameters
    ----------
    robot : Robot
        Its stiffnesses are not used.
    law : SpringLaw
        One law, of both springs.
    road : callable
        ``road(x) -> (H, dHdx)``.
    small : bool
        As in `rest`: if not, heights, places, lever arms and rates are those of a rigid body.

    Returns
    -------
    gfunc : callable
        For the problem's own `suspension.course.RK4`; state of shape (4,), t in s, v in m/s.
    """
    _checks.instance("robot", robot, Robot)
    _checks.function("road", road, "road(x) -> (H, dHdx)")
    _one_law(law)
    ground, motion = _ground(robot, road, small), _motion(robot, law, small)

    def gfunc(w, t, v):
        w = _checks.array("w", w, (4,), finite=False)[:, None]
        wdot, N, _ = motion(w, *ground(w, v * t), v)
        return wdot[:, 0], N[0, 0], N[1, 0]

    return gfunc


def _ground(robot, road, small):
    """Return ``ground(w, X) -> H, dHdx`` under the wheels of n cases at X in m, shape (2, n).

    With a small pitch the places do not depend on the states w, shape (4, n).
    """
    arms = robot.arms[:, None]

    def ground(w, X):
        x = X + (arms if small else arms * np.cos(w[2]))
        H, dHdx = profile(road, x.ravel())
        return H.reshape(x.shape), dHdx.reshape(x.shape)

    return ground


def _motion(robot, law, small):
    """Return ``motion(w, H, dHdx, v) -> wdot, N, p`` for n cases: shapes (4, n), (2, n), (2, n)."""
    arms, c = robot.arms[:, None], robot.c[:, None]

    def motion(w, H, dHdx, v):
        _, rise, theta, turn = w
        sine, cosine, along = theta, 1.0, v
        if not small:
            sine, cosine = np.sin(theta), np.cos(theta)
            along = v - arms * sine * turn  # how fast a wheel goes, m/s
        p = H - w[0] - arms * sine
        N = law.force(p) + c * (dHdx * along - rise - arms * cosine * turn)
        wdot = np.empty_like(w)
        wdot[0], wdot[2] = rise, turn
        wdot[1] = (N[0] + N[1]) / robot.m - robot.g
        wdot[3] = (robot.L2 * N[1] - robot.L1 * N[0]) * cosine / robot.Izz
        return wdot, N, p

    return motion


class Drive(NamedTuple):
    """What is kept of runs over a bump, each array of the shape of the cases.

    Attributes
    ----------
    margin : ndarray
        Least normal force of both wheels on the whole way, N.
    lost : ndarray
        Place of the centre of mass at the first loss of contact, m; inf if there is none.
    compression, extension, pitch : ndarray
        Largest compression of a spring, m, largest extension beyond its free length, m, and
        largest pitch, rad, up to a loss.
    """

    margin: np.ndarray
    lost: np.ndarray
    compression: np.ndarray
    extension: np.ndarray
    pitch: np.ndarray


def drive(robot, law, road, v, *, fine=1.0, small=True):
    """Many runs from rest over 1.25 m, all speeds and laws side by side, with RK4.

    Parameters
    ----------
    robot : Robot
        Its stiffnesses are not used.
    law : SpringLaw
        Broadcast against `v` like an array: ``law[:, None]`` and ``v`` give all pairs.
    road : callable
        ``road(x) -> (H, dHdx)``.
    v : array_like
        Speeds, m/s, > 0.
    fine : float
        How many times the steps of every run are multiplied, to see the error, > 0.
    small : bool
        As in `rest`.

    Returns
    -------
    Drive

    Raises
    ------
    ValueError
        If an argument is out of its range, or the runs would take more than 3 10^8 steps together.

    Notes
    -----
    A run takes 1000 steps of equal length, or as many as keep its time step below half of the
    largest one at which RK4 is stable. One that reaches the stop is done again, with as many steps
    as that asks for. A least force
    between two samples is that of the parabola through three of them. After a loss the ground
    pulls, as in Part V, so that the margin is a continuous function of the speed; only its sign has
    a meaning then.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> law = SpringLaw(0, 13.2, 0, 0.0165, stop=[0, 8000])
    >>> drive(Robot(800, 800), law, GaussianBump(), 10).margin.round(1)
    array([  1.7, -28.2])
    """
    _checks.instance("robot", robot, Robot)
    _checks.function("road", road, "road(x) -> (H, dHdx)")
    _checks.instance("law", law, SpringLaw)
    fine, v = _checks.positive("fine", fine), _checks.array("v", v)
    if not (v > 0).all():
        raise ValueError(f"v must be > 0 everywhere, got {v[~(v > 0)].flat[0]}")
    try:
        shape = np.broadcast_shapes(law.shape, v.shape)
    except ValueError:
        raise ValueError(
            f"v must have a shape that fits law's, {law.shape}, got {v.shape}"
        ) from None
    v = np.broadcast_to(v, shape).ravel()
    law = SpringLaw(
        *(np.broadcast_to(b, shape).ravel() for b in (law.beta0, law.beta1, law.beta2)),
        law.delta_max,
        np.broadcast_to(law.stop, shape).ravel(),
    )
    free = SpringLaw(law.beta0, law.beta1, law.beta2, law.delta_max)
    found = np.empty((len(Drive._fields) + 1, v.size))
    _fill(found, np.ones(v.size, dtype=bool), robot, free, road, v, fine, small)
    touched = (law.stop > 0) & (found[-1] > law.delta_max)
    _fill(found, touched, robot, law, road, v, fine, small)
    return Drive(*found[:-1].reshape(len(Drive._fields), *shape))


def _fill(found, some, robot, law, road, v, fine, small):
    """Do the runs of `some` cases, bool (n,), and write what `_runs` returns into `found`."""
    steps = np.maximum(FEWEST, WITHIN * COURSE / (v * _longest_steps(robot, law)))
    steps = np.ceil(fine * steps)
    if not steps[some].sum() <= MAX_WORK:
        raise ValueError(
            f"v must not be so low or so many, law's stop so stiff, or fine so large, that all "
            f"runs together take more than {MAX_WORK:.0e} steps, got {steps[some].sum():.2g}"
        )
    # Runs of similar length side by side, each group as long as its longest.
    group = np.floor(np.log2(steps / FEWEST))
    for number in np.unique(group[some]):
        those = np.flatnonzero(some & (group == number))
        longest = int(steps[those].max())
        found[:, those] = _runs(robot, law[those], road, v[those], longest, small)


def _longest_steps(robot, law):
    """A time step at which RK4 is stable at the stiffest place of each law, s, shape (n,).

    A pair of eigenvalues of an oscillator has at most the modulus of its frequency, or, with a
    strong damper, of what the damper alone would give.
    """
    stiffest = np.maximum(law.beta1, law.beta1 + 2 * law.beta2) / law.delta_max + law.stop
    unit = replace(robot, k1=1, k2=1, c1=0, c2=0)  # frequencies grow like sqrt(k)
    frequency = np.abs(unit.eigenvalues).max() * np.sqrt(stiffest)
    damper = np.abs(np.linalg.eigvals(robot.P * robot.c @ unit.C)).max()
    return ALL_ROUND / np.maximum(frequency, damper)


def _runs(robot, law, road, v, steps, small):
    """The rows of a `Drive` for n runs of so many steps, shape (6, n).

    The last row is the largest compression in the whole run, m, after a loss as well.
    """
    ground, motion = _ground(robot, road, small), _motion(robot, law, small)
    dX, dt = COURSE / steps, COURSE / (v * steps)
    if small:  # all cases see the same road, at the ends and in the middle of every step
        H, dHdx = ground(None, dX / 2 * np.arange(2 * steps + 1))

    def rate(w, i):
        road_there = (H[:, [i]], dHdx[:, [i]]) if small else ground(w, i * dX / 2)
        return motion(w, *road_there, v)

    w = rest(robot, law, small)
    least = np.full((2, v.size), np.inf)
    lost = np.full(v.size, np.inf)
    compression, extension, pitch = np.full(v.size, -np.inf), np.zeros(v.size), np.zeros(v.size)
    deepest = compression.copy()
    before = middle = least
    for j in range(steps + 1):
        g1, N, p = rate(w, 2 * j)
        pressing = np.isinf(lost)
        lost[pressing & (N <= 0).any(axis=0)] = j * dX
        deepest = np.maximum(deepest, np.maximum(p[0], p[1]))
        np.copyto(compression, deepest, where=pressing)
        np.maximum(extension, -np.minimum(p[0], p[1]), out=extension, where=pressing)
        np.maximum(pitch, np.abs(w[2]), out=pitch, where=pressing)
        least = np.minimum(least, N)
        dips = (middle < before) & (middle <= N)
        if dips.any() and j > 1:
            bend = np.where(dips, before - 2 * middle + N, 1.0)
            dip = np.where(dips, middle - (N - before) ** 2 / (8 * bend), np.inf)
            least = np.minimum(least, dip)
        before, middle = middle, N
        if j < steps:
            g2 = rate(w + dt / 2 * g1, 2 * j + 1)[0]
            g3 = rate(w + dt / 2 * g2, 2 * j + 1)[0]
            g4 = rate(w + dt * g3, 2 * j + 2)[0]
            w = w + dt / 6 * (g1 + 2 * g2 + 2 * g3 + g4)
    if not np.isfinite(w).all():
        raise ValueError("road must be so smooth that a run stays finite")
    margin = least.min(axis=0)
    lost[margin > 0] = np.inf
    return np.array([margin, lost, compression, extension, pitch, deepest])


def zero_speeds(robot, law, road, v, *, zooms=1, small=True):
    """The speeds at which the margin changes its sign between samples: critical speeds.

    Parameters
    ----------
    robot, road, small
        As in `drive`.
    law : SpringLaw
        One law.
    v : array_like, shape (n,)
        Speeds in order, m/s, n >= 2. Two zeros between two neighbours are not seen.
    zooms : int
        How often eight intervals take the place of one, before a straight line ends it.

    Returns
    -------
    speeds : ndarray
        In order, m/s.
    margins : ndarray, shape (n,)
        At the samples, N.
    """
    v, zooms = _checks.array("v", v, (None,)), _checks.whole("zooms", zooms, 0)
    if v.size < 2 or not (np.diff(v) > 0).all():
        raise ValueError("v must hold two speeds or more, in order")
    _one_law(law)
    margins = drive(robot, law, road, v, small=small).margin
    j = np.flatnonzero(margins[:-1] * margins[1:] < 0)
    ends, values = np.log([v[j], v[j + 1]]), np.array([margins[j], margins[j + 1]])
    return np.exp(_zeros_between(robot, law, road, ends, values, zooms, small)), margins


def _zeros_between(robot, law, road, ends, values, zooms, small):
    """Zeros of the margin in ln v between `ends` at which it has `values` of unlike sign.

    Parameters
    ----------
    law : SpringLaw
        One law, or one for each zero.
    ends, values : ndarray, shape (2, n)
    """
    for _ in range(zooms if ends.size else 0):
        finer = np.linspace(*ends, 9)
        inside = drive(robot, law, road, np.exp(finer[1:-1]), small=small).margin
        inside = np.vstack([values[:1], inside, values[1:]])
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
    robot, road
        As in `drive`.
    law : SpringLaw
        n laws.
    v : float
        Where the critical speed was, m/s, > 0.

    Returns
    -------
    speeds : ndarray, shape (n,)
        m/s; nan where the margin has one sign at nine speeds up to a factor 1.3 to both sides.
    """
    _checks.instance("law", law, SpringLaw)
    if len(law.shape) != 1:
        raise ValueError(f"law must be a row of laws, got shape {law.shape}")
    x = np.log(_checks.positive("v", v)) + np.linspace(-1, 1, 9) * np.log(REACH)
    margins = drive(robot, law, road, np.exp(x)[:, None]).margin
    turns = margins[:-1] * margins[1:] < 0
    # From the middle outwards, so that the first change of sign is the nearest.
    order = np.argsort(np.abs(np.arange(8) - 3.5), kind="stable")
    j = order[np.argmax(turns[order], axis=0)]
    some = np.flatnonzero(turns.any(axis=0))
    j = j[some]
    ends, values = np.array([x[j], x[j + 1]]), np.array([margins[j, some], margins[j + 1, some]])
    speeds = np.full(law.shape, np.nan)
    speeds[some] = np.exp(_zeros_between(robot, law[some], road, ends, values, 1, True))
    return speeds


def _one_law(law):
    _checks.instance("law", law, SpringLaw)
    if law.shape:
        raise ValueError(f"law must be one law, got laws of shape {law.shape}")
