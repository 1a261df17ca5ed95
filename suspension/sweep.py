"""Many robots at many speeds over one road: the extremes of all the runs.

One loop over the steps of all cases at once, with the case as the last axis of every array.
"""

from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.road import under_wheels
from suspension.robot import Robot
from suspension.schemes import RK4, Scheme

__all__ = ["Peaks", "peaks", "sweep"]

BATCH = 1024  # cases worked on at a time, whose matrices stay in the processor's cache
MAX_STEPS = 10**5  # of one run: some ten seconds
MAX_WORK = 10**8  # steps of all runs together: as long


def sweep(robots, road, v, *, steps, distance=1.25, scheme=RK4):
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
    least, _ = _extremes(robots, road, v, steps, distance, scheme, _forces)
    at_rest = _at_rest(robots, least.shape[:-1])
    return least + at_rest


class Peaks(NamedTuple):
    """The extremes of runs, each over the samples of one run.

    Attributes
    ----------
    force : ndarray, shape (..., 2)
        Smallest normal force of the rear and the front wheel, N.
    acceleration : ndarray, shape (...)
        Largest ``|Y''|`` of the centre of mass, m/s^2.
    compression : ndarray, shape (..., 2)
        Largest compression ``h - Y_i`` of the rear and the front spring, m.
    """

    force: np.ndarray
    acceleration: np.ndarray
    compression: np.ndarray


def peaks(robots, road, v, *, steps, distance=1.25, scheme=RK4):
    """Smallest forces, largest acceleration and largest compressions of very many runs.

    The arguments, the runs and what is refused are those of `sweep`. All is linear: after a loss
    of contact the numbers are those of a ground that pulls.

    Returns
    -------
    Peaks

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> found = peaks(Robot(800, 800), GaussianBump(), [0.25, 1.2], steps=2000)
    >>> found.acceleration.round(2), (1000 * found.compression.max(axis=-1)).round(1)
    (array([ 1.29, 33.49]), array([ 9.8, 47.4]))
    """
    low, high = _extremes(robots, road, v, steps, distance, scheme, _demands)
    at_rest = _at_rest(robots, low.shape[:-1])
    sag = at_rest / _broadcast(robots, low.shape[:-1], lambda robot: robot.k)
    acceleration = np.maximum(high[..., 2], -low[..., 2])
    return Peaks(low[..., :2] + at_rest, acceleration, high[..., 3:] + sag)


def _forces(robot):
    """Deviation of both normal forces from those at rest, as ``C d + D u``."""
    return robot.C, robot.D


def _demands(robot):
    """The same of forces, acceleration of the centre of mass, and both compressions."""
    still, one = np.zeros(2), np.ones(2)
    Cp = -np.column_stack([one, still, robot.arms, still])
    C = np.vstack([robot.C, robot.C.sum(axis=0) / robot.m, Cp])
    return C, np.vstack([robot.D, robot.D.sum(axis=0) / robot.m, np.eye(2, 4)])


def _broadcast(robots, shape, quantity):
    """A quantity of shape (2,) of each robot, for all cases: shape (..., 2)."""
    robots = _robots(robots)
    values = np.array([quantity(robot) for robot in robots.flat]).reshape(*robots.shape, 2)
    return np.broadcast_to(values, (*shape, 2))


def _at_rest(robots, shape):
    """Normal forces at rest, N, of all cases."""
    return _broadcast(robots, shape, lambda robot: robot.C @ robot.equilibrium)


def _extremes(robots, road, v, steps, distance, scheme, outputs):
    """Smallest and largest outputs of every run, shape (..., outputs), from rest at zero."""
    robots, v = _robots(robots), _checks.array("v", v)
    _checks.instance("scheme", scheme, Scheme)
    if not (v > 0).all():
        raise ValueError(f"v must be > 0 everywhere, got {v[~(v > 0)].flat[0]}")
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
    rows = len(outputs(Robot(1, 1))[0])
    low, high = np.empty((v.size, rows)), np.empty((v.size, rows))
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
            low[some], high[some] = _batch(
                robots[some], v[some], ground, abscissae, distance / steps, scheme, outputs
            )
    return low.reshape(*shape, rows), high.reshape(*shape, rows)


def _batch(robots, v, ground, abscissae, dX, scheme, outputs):
    """Smallest and largest outputs of n cases on the same road, shape (n, outputs)."""
    A, B = (np.array([getattr(robot, name) for robot in robots]) for name in "AB")
    C, D = map(np.array, zip(*map(outputs, robots)))
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
    low = np.full((C.shape[0], len(v)), np.inf)
    high = -low
    with np.errstate(over="ignore", invalid="ignore"):  # an unstable run may overflow
        for u in ground:
            y = np.einsum("ijn,jn->in", C, d) + np.einsum("ijn,j->in", D, u[:4])
            np.minimum(low, y, out=low)
            np.maximum(high, y, out=high)
            d = np.einsum("ijn,jn->in", R, d) + np.einsum("ijn,j->in", inputs, u)
    return low.T, high.T


def _robots(robots):
    robots = np.asarray(robots, dtype=object)
    for robot in robots.flat:
        if not isinstance(robot, Robot):
            raise TypeError(f"robots must be a Robot or an array of them, got {robot!r}")
    return robots
