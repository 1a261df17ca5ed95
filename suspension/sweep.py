"""Many robots at many speeds over one road, side by side: the case is every array's last axis.

`drive` keeps the extremes of runs on any spring law, with a ground that only pushes or with one
that pulls as well. `sweep` keeps the least forces of the linear robot with any scheme, step for
step those of `suspension.simulation.simulate`, in half the time of a `drive`.
"""

from dataclasses import replace
from math import prod
from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.extremes import Extremes
from suspension.least_force import distance_over
from suspension.motion import Cases, Full, Small, step
from suspension.problem import DISTANCE
from suspension.road import GaussianBump, profile, under_wheels
from suspension.robot import Robot
from suspension.schemes import RK4, Scheme
from suspension.spring_law import SpringLaw

__all__ = ["Drive", "drive", "sweep"]

BATCH = 1024  # cases of a sweep worked on at a time: its matrices stay in the processor's cache
SIDE_BY_SIDE = 2560  # cases of a drive, which has no matrices
MAX_STEPS = 10**5  # of one run: some ten seconds
MAX_WORK = 10**8  # steps of all runs together: as long
ROWS = 48  # samples that are digested at a time
OVERHEAD = 1000  # cases that take as long as what a step costs without any
MAX_DRIVES = 10**8  # steps of all drives together, each with that overhead: some ten seconds
SPACING = 24  # steps for each sigma of a bump
FEATURE = 0.03  # m, the smallest feature of a road that has no sigma
SWING = 24  # steps for each swing of the stiffest spring, or stop
DECAY = 1.0  # steps for each time constant of the strongest damper


class Drive(NamedTuple):
    """What is kept of runs, each array of the shape of the cases; wheel 1 is the rear one.

    Attributes
    ----------
    margin : ndarray
        Least normal force of both wheels on the whole way, N. It is positive if contact is kept. If
        it is lost, then 0 on a ground that only pushes; on one that pulls, what it would have to
        pull with: a number <= 0 that grows continuously through 0 as a parameter goes through a
        critical value, of which nothing but the sign is the robot's.
    lost : ndarray
        Place of the centre of mass at the first loss of contact, m; inf if ``margin > 0``.
    wheel : ndarray of int
        The wheel that is lost first, 1 or 2; 0 if there is none.
    acceleration, compression, extension, pitch : ndarray
        Largest ``|Y''|``, m/s^2, compression of a spring, m, extension beyond its free length, m,
        and pitch, rad; of the whole way, on a ground that pulls up to the first loss.
    airtime : ndarray, shape (2, ...)
        How long each wheel bears no force, s; nan after a loss on a ground that pulls.
    flights : ndarray of int, shape (2, ...)
        How often each wheel leaves the ground; 0 on one that pulls.
    """

    margin: np.ndarray
    lost: np.ndarray
    wheel: np.ndarray
    acceleration: np.ndarray
    compression: np.ndarray
    extension: np.ndarray
    pitch: np.ndarray
    airtime: np.ndarray
    flights: np.ndarray

    @property
    def kept(self):
        """Whether both wheels keep contact on the whole way, bool."""
        return self.margin > 0


def drive(robots, road, v, *, law=None, ground="pushes", geometry="small", distance=None, fine=1.0):
    """Very many runs from rest, all robots, laws and speeds side by side, with RK4.

    With ``p = h - Y`` for the compression of a spring, ``F(p)`` for its force and ``f = F(p) + c
    p'`` (Eq. 5), the normal force is ``N = max(0, f)`` where the spring is compressed, ``F(p) >=
    0``, and 0 elsewhere: the problem's footnote 1 as a law of force, the wheel that "follows" of
    `suspension.flight.fly`. It has no memory, so one loop takes all cases. A ground that pulls has
    ``N = f`` everywhere.

    Parameters
    ----------
    robots : Robot or array_like of Robot
    road : callable
        ``road(x) -> (H, dHdx)``, arrays in, arrays out.
    v : array_like
        Speeds, m/s, > 0. Robots, speeds and laws broadcast like any arrays: ``robots[:, None]``
        and ``v`` give all pairs.
    law : SpringLaw, optional
        Of all springs, whose stiffnesses ``k1`` and ``k2`` then play no part; straight springs of
        these if not given.
    ground : {"pushes", "pulls"}
        Whether the ground lets go.
    geometry : {"small", "full"}
        Whether the pitch is taken for small, as in Eqs. 1 to 6; if not, heights, places, lever
        arms and speeds of the wheels are those of a rigid body.
    distance : float, optional
        How far the centre of mass goes, m, > 0. If not given, 1.25 m: all of a Gaussian bump must
        lie within (`suspension.least_force.distance_over`); of other roads it is not known where
        they end.
    fine : float
        How many times the steps of every run are multiplied, to see the error, > 0.

    Returns
    -------
    Drive

    Raises
    ------
    ValueError
        If an argument is out of its range; if they cannot be broadcast; if a wheel starts on a
        Gaussian bump, or does not pass all of it within 1.25 m and `distance` is not given; or if
        the runs would take more than 10^8 steps together, where a step of any number of runs counts
        a thousand more.

    Notes
    -----
    A run takes steps of equal length, 24 for each sigma of a bump (of 1.25 mm on other roads), or
    as many as make 24 for each swing of the stiffest spring. One that reaches a stop is done again
    with the steps that the stop asks for. Between the samples the state is interpolated, never a
    force: see `suspension.extremes`. The place of a loss is good to 0.1 mm and better.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> robots = [[Robot(k, k)] for k in (160, 800)]
    >>> found = drive(robots, GaussianBump(), [0.25, 1.2, 10])
    >>> found.margin.round(2)
    array([[3.87, 3.36, 1.19],
           [5.6 , 0.  , 1.67]])
    >>> found.lost[1].round(4), found.wheel[1], found.flights[:, 1, 1]
    (array([   inf, 0.2121,    inf]), array([0, 2, 0]), array([4, 4]))
    """
    _checks.function("road", road, "road(x) -> (H, dHdx)")
    _checks.one_of("ground", ground, ("pushes", "pulls"))
    _checks.one_of("geometry", geometry, ("small", "full"))
    fine = _checks.positive("fine", fine)
    robots, v = _checks.instances("robots", robots, Robot), _checks.positives("v", v)
    distance = _passed(robots, road, distance)
    way = _Way(road, distance, fine, ground == "pulls", geometry == "full")
    shape, cases = _side_by_side(robots, v, law, way)
    n = cases.v.size
    found = Drive(np.empty(n), np.empty(n), np.empty(n, dtype=int), *np.empty((4, n)),
                  np.empty((2, n)), np.empty((2, n), dtype=int))  # fmt: skip
    free = cases if law is None else cases._replace(law=cases.law.free)
    _fill(found, np.arange(n), free, way)
    if law is not None:
        touched = (cases.law.stop > 0) & (found.compression > law.delta_max)
        _fill(found, np.flatnonzero(touched), cases, way)
    return Drive(*(values.reshape((*values.shape[:-1], *shape)) for values in found))


class _Way(NamedTuple):
    """What all runs have in common."""

    road: object
    distance: float
    fine: float
    pulls: bool
    full: bool

    @property
    def fewest(self):
        """Steps that every run takes at least, for the road's sake, float."""
        sigma = _checks.positive("road's sigma", getattr(self.road, "sigma", FEATURE))
        return self.fine * self.distance / (sigma / SPACING)


def _passed(robots, road, distance):
    """How far the runs go, m: `distance`, or that of the problem if the whole bump is in it."""
    if isinstance(road, GaussianBump) and robots.size:
        longest = {
            name: max(getattr(robot, name) for robot in robots.flat) for name in ("L1", "L2")
        }
        return distance_over(replace(robots.flat[0], **longest), road, distance)
    return DISTANCE if distance is None else _checks.positive("distance", distance)


def _side_by_side(robots, v, law, way):
    """The shape of all cases, and the cases in a row."""
    arrays = {"robots": robots, "v": v}
    if law is not None:
        arrays["law"] = _checks.instance("law", law, SpringLaw).stop
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        each = ", ".join(f"{name} {array.shape}" for name, array in arrays.items())
        raise ValueError(f"robots, v and law must have shapes that fit, got {each}") from None
    _allow(way.fewest * (prod(shape) + OVERHEAD))  # before so many cases are written down
    robots, v = (np.broadcast_to(array, shape).ravel() for array in (robots, v))
    if law is not None:
        each = (np.broadcast_to(x, shape).ravel() for x in (law.beta0, law.beta1, law.beta2))
        law = SpringLaw(*each, law.delta_max, np.broadcast_to(law.stop, shape).ravel())
    return shape, Cases(robots, v, law)


def _fill(found, some, cases, way):
    """Do the runs of some of the cases and write what is found into a `Drive`."""
    steps = _steps(cases.some(some), way)
    some, steps = some[np.argsort(steps)], np.sort(steps)
    # Runs of similar length side by side, each batch as long as its longest.
    batches = [slice(i, i + SIDE_BY_SIDE) for i in range(0, some.size, SIDE_BY_SIDE)]
    _allow(sum(steps[batch][-1] * (steps[batch].size + OVERHEAD) for batch in batches))
    for batch in batches:
        result = _run(cases.some(some[batch]), int(steps[batch][-1]), way)
        for values, new in zip(found, result):
            values[..., some[batch]] = new


def _allow(work):
    """Refuse runs that would take too many steps together."""
    if not work <= MAX_DRIVES:
        raise ValueError(
            "v must not be so low or so many, the springs, stops or dampers so strong, or distance "
            f"or fine so large, that all runs together take more than {MAX_DRIVES:.0e} steps (one "
            f"of any number of runs counts {OVERHEAD} more), got {work:.2g}"
        )


def _steps(cases, way):
    """How many steps each run takes, shape (n,), float."""
    rate = np.maximum(cases.swings() * SWING, DECAY * cases.decays())  # steps a second
    return np.ceil(np.maximum(way.fewest, way.fine * way.distance / cases.v * rate))


class _Ground:
    """The road under the wheels of all cases at any half step, and its rise in half a step."""

    def __init__(self, motion, way):
        self.motion, self.way, self.full = motion, way, way.full
        self.bases, self.which = np.unique(motion.arms, axis=1, return_inverse=True)
        self.first, self.end = 0, 0

    def __call__(self, place, y):
        """Height, m, and rise, m, shape (2, n), or (2, 1) if it is the same for all."""
        half = self.motion.half
        if self.full:
            x = place * half + self.motion.arms * np.cos(y[1])
            H, dHdx = profile(self.way.road, x.ravel())
            return H.reshape(x.shape), half * dHdx.reshape(x.shape)
        if place >= self.end:
            self._read(place)
        i = place - self.first
        return self.H[i], self.rise[i]

    def _read(self, place):
        """The road at the next places, for each wheelbase once."""
        self.first, self.end = place, place + 2 * ROWS
        X = np.minimum(self.motion.half * np.arange(self.first, self.end), self.way.distance)
        x = X[:, None, None] + self.bases
        H, dHdx = profile(self.way.road, x.ravel())
        H, rise = H.reshape(x.shape), self.motion.half * dHdx.reshape(x.shape)
        many = self.bases.shape[1] > 1
        self.H, self.rise = (H[..., self.which], rise[..., self.which]) if many else (H, rise)


def _run(cases, steps, way):
    """The fields of a `Drive` of n cases with so many steps."""
    n, dX = cases.v.size, way.distance / steps
    motion = (Full if way.full else Small)(cases, dX, way.pulls)
    ground, extremes = _Ground(motion, way), Extremes(motion, n, dX)
    rows = [*np.empty((4, ROWS + 1, 2, n)), *np.empty((2, ROWS + 1, n))]

    def rate(y, u, place):
        return motion.rates(y, u, *ground(place, y))

    def keep(row, *values):
        for array, value in zip(rows, values):
            array[row] = value

    y, u, row = motion.start, np.zeros((2, n)), 1
    with np.errstate(over="ignore", invalid="ignore"):  # told below
        for j in range(steps + 1):
            a1, *now = rate(y, u, 2 * j)
            now += [motion.pitch(y), motion.pitch(u)]
            keep(row, *now)
            row += 1
            if j == 0:
                keep(0, *now)  # the first sample is its own neighbour
            if j == steps:
                keep(row, *now)  # and so is the last
                extremes.digest(j - row + 2, *(array[: row + 1] for array in rows))
                break
            if row == ROWS:
                extremes.digest(j - row + 2, *(array[:row] for array in rows))
                keep(slice(3), *(array[row - 3 : row].copy() for array in rows))
                row = 3
            y, u = step(lambda y, u, place: rate(y, u, place)[0], y, u, a1, 2 * j)
    if not np.isfinite(y).all():
        raise ValueError("road must be so smooth that a run stays finite")
    return extremes.result()


def sweep(robots, road, v, *, steps, distance=DISTANCE, scheme=RK4):
    """The smallest sampled normal force of each wheel, for every robot and every speed.

    Each case is the run ``simulate(robot, road, v=v, dt=distance / (v * steps), tfinal=distance /
    v)`` from rest, of which only the minimum over the samples is kept.

    Parameters
    ----------
    robots : Robot or array_like of Robot
        Broadcast against `v` like any array: ``robots[:, None]`` and ``v`` give all pairs.
    road : callable
        ``road(x) -> (H, dHdx)``, arrays in, arrays out.
    v : array_like
        Speeds, m/s, > 0.
    steps : int
        Number of steps of every run, >= 1.
    distance : float
        How far the centre of mass goes in every run, m, > 0.
    scheme : Scheme
        The one-step method.

    Returns
    -------
    N : ndarray, shape (..., 2)
        Rear and front wheel's force, N, for each element of the broadcast `robots` and `v`. An
        unstable run may end at inf or nan, and then its minimum does.

    Raises
    ------
    ValueError
        If an argument is out of its range, `robots` and `v` cannot be broadcast, or a run
        would take more than 10^5 steps, or all together more than 10^8.

    Notes
    -----
    With the place ``X = v t`` for time, ``dw/dX = (A w + B u + e) / v``, every case takes the same
    steps and sees the same road, which is evaluated once per distinct (L1, L2). Beyond
    the result, the memory in use grows with the steps and not with the cases.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> robots = [[Robot(k, k)] for k in (400, 800)]
    >>> sweep(robots, GaussianBump(), [0.25, 1.2, 10], steps=2000).min(axis=-1).round(2)
    array([[  4.7 ,  -4.4 ,   3.43],
           [  5.6 , -25.23,   1.67]])
    """
    robots, v = _checks.instances("robots", robots, Robot), _checks.positives("v", v)
    _checks.instance("scheme", scheme, Scheme)
    steps, distance = _checks.whole("steps", steps, 1), _checks.positive("distance", distance)
    if steps > MAX_STEPS:
        raise ValueError(f"steps must be at most {MAX_STEPS}, got {steps}")
    try:
        robots, v = np.broadcast_arrays(robots, v)
    except ValueError:
        raise ValueError(
            f"robots must have a shape that fits v's, {v.shape}, got {robots.shape}"
        ) from None
    if v.size * steps > MAX_WORK:
        raise ValueError(
            f"steps must be at most {MAX_WORK} in all cases together, "
            f"got {v.size} cases of {steps} steps"
        )
    shape, robots, v = v.shape, robots.ravel(), v.ravel()
    least = np.empty((v.size, 2))
    bases = [(robot.L1, robot.L2) for robot in robots]
    X = distance / steps * np.arange(steps + 1)
    abscissae = np.unique([0.0, *scheme.c])
    for base in set(bases):
        cases = np.array([i for i, other in enumerate(bases) if other == base])
        # All that the wheels meet in a step, shape (steps + 1, 4 * abscissae); none is asked for
        # beyond the end.
        places = np.minimum(np.add.outer(X, abscissae * distance / steps), distance)
        ground = np.vstack(under_wheels(robots[cases[0]], road, places.ravel()))
        ground = np.moveaxis(ground.reshape(4, *places.shape), 0, -1).reshape(steps + 1, -1)
        for some in np.split(cases, range(BATCH, len(cases), BATCH)):
            least[some] = _batch(robots[some], v[some], ground, abscissae, distance / steps, scheme)
    return least.reshape(*shape, 2)


def _batch(robots, v, ground, abscissae, dX, scheme):
    """Smallest forces of n cases on the same road, shape (n, 2)."""
    A, B, C, D = (np.array([getattr(robot, name) for robot in robots]) for name in "ABCD")
    at_rest = np.array([robot.C @ robot.equilibrium for robot in robots])
    slow = v[:, None, None]
    felt = np.concatenate([np.ones((2, len(v))), [v, v]]).T[:, None]  # height; rate of change
    B, D = B * felt, D * felt
    R, G = scheme.one_step(A / slow, dX)
    inputs = [G[scheme.c == c].sum(axis=0) @ (B / slow) for c in abscissae]
    # The case as the last axis, so that each step is a few long loops.
    R, inputs, C, D = (
        np.ascontiguousarray(np.moveaxis(M, 0, -1))
        for M in (R, np.concatenate(inputs, axis=2), C, D)
    )
    d = np.zeros((4, len(v)))  # deviation from equilibrium
    least = np.full((2, len(v)), np.inf)
    with np.errstate(over="ignore", invalid="ignore"):  # an unstable run may overflow
        for u in ground:
            y = np.einsum("ijn,jn->in", C, d) + np.einsum("ijn,j->in", D, u[:4])
            np.minimum(least, y, out=least)
            d = np.einsum("ijn,jn->in", R, d) + np.einsum("ijn,j->in", inputs, u)
    return least.T + at_rest
