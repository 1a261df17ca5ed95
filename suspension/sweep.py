"""Many robots at many speeds over one road: the smallest normal forces of all the runs."""

import numpy as np

from suspension import _checks
from suspension.recurrence import BLOCK, Discrete, abscissae
from suspension.road import under_wheels
from suspension.robot import Robot
from suspension.schemes import RK4, Scheme
from suspension.simulation import MAX_STEPS

__all__ = ["sweep"]

BATCH = 2**17  # steps of all cases that are worked on at a time


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
        If an argument is out of its range, or `robots` and `v` cannot be broadcast.

    Notes
    -----
    With the place ``X = v t`` for time, ``dw/dX = (A w + P f + e) / v``, every case takes the same
    steps and sees the same road, which is evaluated once per distinct (L1, L2). The memory in use
    does not grow with the number of cases.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> robots = [[Robot(k, k)] for k in (400, 800)]
    >>> sweep(robots, GaussianBump(), [0.25, 1.2, 10], steps=2000).min(axis=-1).round(2)
    array([[  4.7 ,  -4.4 ,   3.43],
           [  5.6 , -25.23,   1.67]])
    """
    robots, v = _robots(robots), _checks.array("v", v)
    _checks.instance("scheme", scheme, Scheme)
    if not (v > 0).all():
        raise ValueError(f"v must be > 0 everywhere, got {v[~(v > 0)].flat[0]}")
    steps, distance = _checks.whole("steps", steps, 1), _checks.positive("distance", distance)
    if steps > MAX_STEPS:
        raise ValueError(f"steps must be at most {MAX_STEPS:.0e}, got {steps}")
    try:
        robots, v = np.broadcast_arrays(robots, v)
    except ValueError:
        raise ValueError(
            f"robots must have a shape that fits v's, {v.shape}, got {robots.shape}"
        ) from None
    N, robots = np.empty((v.size, 2)), robots.ravel()
    bases = np.array([(robot.L1, robot.L2) for robot in robots]).reshape(-1, 2)
    bases, base = np.unique(bases, axis=0, return_inverse=True)
    dX, size = distance / steps, max(1, BATCH // steps)
    # Whole blocks need no padding later; what comes after the end is not looked at.
    n = np.arange(steps + 1 + -(steps + 1) % BLOCK)
    X = dX * np.minimum(n + abscissae(scheme)[:, None], steps)
    for i in range(len(bases)):
        cases = np.flatnonzero(base.ravel() == i)
        ground = np.concatenate(under_wheels(robots[cases[0]], road, X), axis=1)
        for some in np.split(cases, range(size, len(cases), size)):
            N[some] = _smallest(
                robots[some], v.ravel()[some, None, None], ground, steps, dX, scheme
            )
    return N.reshape(*v.shape, 2)


def _smallest(robots, v, ground, steps, dX, scheme):
    A, P, C, D = (np.array([getattr(robot, name) for robot in robots]) for name in "APCD")
    D[..., 2:] *= v  # acts on slopes
    run = Discrete(scheme, A / v, P @ D / v, C, D, dX)
    u = ground.reshape(-1, ground.shape[-1])
    y, _ = run(run.start(0.0, u), u)
    return y[..., : steps + 1].min(axis=-1) + [robot.C @ robot.equilibrium for robot in robots]


def _robots(robots):
    robots = np.asarray(robots, dtype=object)
    for robot in robots.flat:
        if not isinstance(robot, Robot):
            raise ValueError(f"robots must be a Robot or an array of them, got {robot!r}")
    return robots
