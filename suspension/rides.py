"""Long rides on rough roads, all robots, roads and speeds side by side, on a ground that pushes.

What a ride costs in forces and comfort is a mean over the way, and one road is not a class: `rides`
drives on many of them at once.
"""

from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.frequency import steady_start
from suspension.motion import Cases, Small, step
from suspension.road import RoughRoad
from suspension.robot import Robot

__all__ = ["Rides", "rides"]

WAVE = 32  # steps for the shortest wave of the roads
SWING = 12  # steps for each swing of the stiffest spring
DECAY = 1.0  # steps for each time constant of the strongest damper
MAX_STEPS = 10**8  # of all rides together, a step of any number of rides counting 1000 more
# Of all roads together, a wheelbase on a road each, a step long: half a gigabyte.
MAX_PLACES = 10**7


class Rides(NamedTuple):
    """What is kept of rides over one period of their roads; wheel 1 is the rear one.

    Attributes
    ----------
    force : ndarray, shape (2, ...)
        Root mean square of each wheel's normal force about its load at rest, N.
    acceleration : ndarray, shape (...)
        Root mean square of ``Y''``, m/s^2.
    air : ndarray, shape (2, ...)
        The part of the time in which each wheel bears no force.
    flights : ndarray of int, shape (2, ...)
        How often each wheel leaves the ground.
    """

    force: np.ndarray
    acceleration: np.ndarray
    air: np.ndarray
    flights: np.ndarray


def rides(robots, roads, v, *, ground="pushes"):
    """Drive twice around periodic roads, with RK4, and keep the means of the second time.

    Each ride begins in the steady state of the linear robot (`suspension.frequency.steady_start`),
    so that the first round is only there for what the flights change.

    Parameters
    ----------
    robots : Robot or array_like of Robot
    roads : RoughRoad or array_like of RoughRoad
        All of one length.
    v : array_like
        Speeds, m/s, > 0. Robots, roads and speeds broadcast like any arrays.
    ground : {"pushes", "pulls"}
        Whether the ground lets go, as in `suspension.sweep.drive`.

    Returns
    -------
    Rides

    Raises
    ------
    ValueError
        If an argument is out of its range, they cannot be broadcast, the roads differ in length,
        or the rides would take more than 10^8 steps together, or roads with more than 10^7.

    Notes
    -----
    A step is a 32nd of the shortest wave, or what makes 12 of each swing of the stiffest spring.
    What is counted is counted sample by sample.

    Examples
    --------
    >>> from suspension.road import ISO_8608
    >>> roads = [[RoughRoad(ISO_8608["C"], length=4, seed=seed)] for seed in range(3)]
    >>> found = rides(Robot(800, 800), roads, [0.25, 1.2])
    >>> found.flights.sum(axis=(0, 1)) > 0
    array([False,  True])
    """
    _checks.one_of("ground", ground, ("pushes", "pulls"))
    v = _checks.positives("v", v)
    robots = _checks.instances("robots", robots, Robot)
    roads = _checks.instances("roads", roads, RoughRoad)
    lengths = {road.length for road in roads.flat}
    if len(lengths) > 1:
        raise ValueError(f"roads must be of one length, got {sorted(lengths)}")
    waves = WAVE * max((road.length / road.shortest for road in roads.flat), default=0)
    try:
        robots, roads, v = np.broadcast_arrays(robots, roads, v)
    except ValueError:
        raise ValueError(
            "robots, roads and v must have shapes that fit, "
            f"got {robots.shape}, {roads.shape} and {v.shape}"
        ) from None
    shape = v.shape
    if not v.size:
        return Rides(*(np.empty((*wheels, *shape)) for wheels in ((2,), (), (2,), (2,))))
    _allow(waves, v.size)  # before so many cases are written down
    cases, roads = Cases(robots.ravel(), v.ravel(), None), roads.ravel()
    found = _run(cases, roads, waves, lengths.pop(), ground == "pulls")
    return Rides(*(values.reshape(values.shape[:-1] + shape) for values in found))


def _allow(steps, n):
    """Refuse n rides that would take too many steps together."""
    if not 2 * steps * (n + 1000) <= MAX_STEPS:
        raise ValueError(
            "v must not be so low, the springs or dampers so strong, or roads so long or so many, "
            f"that all rides together take more than {MAX_STEPS:.0e} steps, got {2 * steps:.2g} "
            f"for each of {n}"
        )


def _run(cases, roads, waves, length, pulls):
    """The fields of `Rides` of n cases with so many steps or more, each (n,) or (2, n)."""
    rate = np.maximum(cases.swings() * SWING, DECAY * cases.decays())  # steps a second
    steps = np.ceil(max(waves, (length / cases.v * rate).max()))
    _allow(steps, cases.v.size)
    steps = int(steps)
    motion = Small(cases, length / steps, pulls)
    H, rise, which = _ground(roads, motion, length, steps)
    y, u = _start(cases, roads, motion)

    def rates(y, u, place):
        i = place % (2 * steps)
        return motion.rates(y, u, H[i][:, which], rise[i][:, which])

    forces, bounces, off, flights = np.zeros((2, cases.v.size)), 0.0, 0, 0
    pressing = None
    for j in range(2 * steps):
        a1, _, _, _, N = rates(y, u, 2 * j)
        before, pressing = pressing, N > 0
        if j >= steps:
            forces += (N - motion.loads) ** 2
            bounces += ((N[0] + N[1]) / motion.m - motion.g) ** 2
            off += ~pressing
            flights += before & ~pressing
        y, u = step(lambda y, u, place: rates(y, u, place)[0], y, u, a1, 2 * j)
    if not np.isfinite(y).all():
        raise ValueError("roads must be so smooth that a ride stays finite")
    return np.sqrt(forces / steps), np.sqrt(bounces / steps), off / steps, flights


def _ground(roads, motion, length, steps):
    """Heights and rises in half a step under the wheels at every half step of the roads.

    Returns
    -------
    H, rise : ndarray, shape (2 steps, 2, grounds)
        m; one ground for each road and wheelbase.
    which : ndarray, shape (n,)
        The ground of each case.
    """
    keys = list(zip(roads, *motion.arms))
    grounds = list(dict.fromkeys(keys))
    if steps * len(grounds) > MAX_PLACES:
        raise ValueError(
            f"roads must have at most {MAX_PLACES:.0e} steps together, "
            f"got {steps} on each of {len(grounds)}"
        )
    half, spectrum = length / (2 * steps), np.zeros((2, steps + 1), dtype=complex)
    H, rise = np.empty((2, 2 * steps, 2, len(grounds)))
    for i, (road, *arms) in enumerate(grounds):
        rate = 2j * np.pi * road.wavenumbers
        waves = steps * road.amplitudes * np.exp(np.multiply.outer(arms, rate))
        spectrum[:] = 0
        for values, each in ((H, waves), (rise, half * rate * waves)):
            spectrum[:, 1 : 1 + len(rate)] = each
            values[..., i] = np.fft.irfft(spectrum, 2 * steps).T
    place = {key: i for i, key in enumerate(grounds)}
    return H, rise, np.array([place[key] for key in keys])


def _start(cases, roads, motion):
    """The steady state of the linear robots as the ends of the body and their rates, (2, n)."""
    known = {}
    for key in zip(cases.robots, roads, cases.v):
        if key not in known:
            known[key] = steady_start(*key)
    w = np.array([known[key] for key in zip(cases.robots, roads, cases.v)]).T
    return w[0] + motion.arms * w[2], motion.time * (w[1] + motion.arms * w[3])
