"""Where the model itself is in doubt: how far the springs travel and how far the body tilts.

And what to look at: the two parts of the least force, the moments that tell the story of a flight.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.contact import critical_speeds, exact_loss, margin, minima, regimes_between
from suspension.critical import zeros
from suspension.exact import over_bump
from suspension.flight import Flight
from suspension.least_force import distance_over
from suspension.road import road_input

__all__ = [
    "Balance",
    "Moment",
    "Overtravel",
    "Travel",
    "balance",
    "compression_map",
    "margin_map",
    "moments",
    "overtravel",
    "travel",
]


MAX_SAMPLES = 10**6
REAR, FRONT = 1, 2
PUSHES = 1 / 7  # of the force at rest: a spring that gives more is still compressed


class Travel(NamedTuple):
    """Largest compression and extension of a spring, m, and largest pitch, rad, of a run."""

    compression: float
    extension: float
    pitch: float


def travel(robot, bump, v, samples=2001, *, distance=None):
    """How far springs and body move while both wheels press on the ground.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.
    samples : int
        Equally spaced times from 0 to the first loss of contact, or to the end of the run.
    distance : float, optional
        How far it goes, m: 1.25 m if the whole bump lies within (`distance_over`).

    Returns
    -------
    Travel
        The compression is ``h_i - Y_i``, counted from the unstretched spring.

    Raises
    ------
    ValueError
        If `samples` is no whole number from 2 to 10^6, or `suspension.margin` refuses.
    """
    samples = _checks.whole("samples", samples, 2)
    if samples > MAX_SAMPLES:
        raise ValueError(f"samples must be at most {MAX_SAMPLES}, got {samples}")
    distance = distance_over(robot, bump, distance)
    loss = exact_loss(robot, bump, v, distance=distance)
    t = np.linspace(0, loss.t if loss else distance / v, samples)
    W = over_bump(robot, bump, v, t)
    compression = _compression(robot, bump, v, t, W)
    return Travel(compression.max(), max(-compression.min(), 0.0), np.abs(W[2]).max())


def _compression(robot, bump, v, t, W):
    """``h_i - Y_i`` at times `t`, shape (n,), and states `W`, shape (4, n): m, shape (2, n)."""
    ends = W[0] + np.outer(robot.arms, W[2])
    return road_input(robot, bump, v, t)[:2] - ends


class Overtravel(NamedTuple):
    """A range of speeds, m/s, in which a spring is compressed by more than a limit.

    `times` is the largest compression found there, in units of the limit.
    """

    low: float
    high: float
    times: float


def overtravel(robot, bump, limit, vmin, vmax, *, distance=None):
    """The ranges of speed in which a spring is compressed by more than `limit`.

    Only what happens before a loss of contact counts. The compression until then jumps where the
    moment of the loss does; elsewhere it is continuous in the speed, and the edges are solved for.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    limit : float
        Compression, m, > 0.
    vmin, vmax : float
        Range of speeds, m/s, 0 < vmin < vmax.
    distance : float, optional
        As in `travel`.

    Returns
    -------
    ranges : tuple of Overtravel
        In order. A range narrower than a fortieth of its speed may be missed.

    Raises
    ------
    ValueError
        If an argument is out of its range, or `critical_speeds` or `travel` refuses.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> (found,) = overtravel(Robot(800, 800), GaussianBump(), 0.0165, 0.5, 2)
    >>> round(found.low, 2), round(found.high, 2), round(found.times, 2)
    (0.73, 2.0, 1.71)
    """
    limit = _checks.positive("limit", limit)
    vmin, vmax = _checks.ends("vmin", vmin, "vmax", vmax)
    distance = distance_over(robot, bump, distance)
    reached = {}  # by speed, in units of the limit

    def spare(v):
        reached[v] = travel(robot, bump, v, 1001, distance=distance).compression / limit
        return 1 - reached[v]

    samples = 2 + int(40 * np.log(vmax / vmin))
    x = np.linspace(np.log(vmin), np.log(vmax), samples)
    # The moment of the loss jumps at a critical speed.
    turns = np.log(critical_speeds(robot, bump, vmin, vmax, distance=distance))
    edges = np.exp(zeros(lambda x: spare(np.exp(x)), np.union1d(x, turns)))
    inside = edges[(vmin < edges) & (edges < vmax)]
    beyond = regimes_between(spare, [vmin, *inside, vmax]).spans(lost=True)  # no way is spare
    return tuple(
        Overtravel(
            float(low), float(high), float(max(r for v, r in reached.items() if low <= v <= high))
        )
        for low, high in beyond
    )


def margin_map(robot, bump, v, k, *, distance=None):
    """The margin over speed and stiffness.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v, k : array_like, shapes (n,) and (m,)
        Speeds, m/s, and stiffnesses of all springs, N/m.
    distance : float, optional
        As in `travel`.

    Returns
    -------
    margin : ndarray, shape (m, n)
        N.

    Raises
    ------
    ValueError
        If a stiffness is not > 0, or `suspension.margin` refuses.
    """
    robots = [replace(robot, k1=stiffness, k2=stiffness) for stiffness in k]
    return np.array(
        [[margin(other, bump, speed, distance=distance) for speed in v] for other in robots]
    )


def compression_map(robot, bump, v, k, *, distance=None):
    """The largest compression of a spring, in m, over speed and stiffness.

    Parameters and errors are those of `margin_map`.

    Returns
    -------
    compression : ndarray, shape (m, n)
        m.
    """
    robots = [replace(robot, k1=stiffness, k2=stiffness) for stiffness in k]
    return np.array(
        [
            [travel(other, bump, speed, 501, distance=distance).compression for speed in v]
            for other in robots
        ]
    )


class Balance(NamedTuple):
    """What the least force on a wheel, 1 (rear) or 2 (front), is the sum of: spring and damper, N.

    `rest` is the force on this wheel at rest, N.
    """

    wheel: int
    spring: float
    damper: float
    rest: float

    @property
    def pulled(self):
        """Whether the spring still pushes, so that it is the damper that takes the force away."""
        return self.spring > PUSHES * self.rest


def balance(robot, bump, v, *, distance=None):
    """The two parts of the least normal force on the way over the bump, at `v` in m/s.

    `distance` is that of `travel`, errors are those of `suspension.margin`.
    """
    least = min(minima(robot, bump, v, distance=distance), key=lambda minimum: minimum.force)
    t = np.array([least.t])
    i = least.wheel - 1
    compression = _compression(robot, bump, v, t, over_bump(robot, bump, v, t))
    spring = float(robot.k[i] * compression[i, 0])
    rest = float(robot.C[i] @ robot.equilibrium)
    return Balance(least.wheel, spring, least.force - spring, rest)


class Moment(NamedTuple):
    """A moment of a drive: what happens, to which wheel (None: to the body), and when, s.

    `kind` is ``"foot"``, ``"top"`` (of the bump) or ``"past"`` (it), ``"lift-off"``, ``"apex"``
    (the highest point of that flight), ``"landing"``, or ``"highest"`` (of both wheels).
    """

    kind: str
    wheel: int | None
    t: float


def moments(flight, robot, bump, *, distance=None):
    """The moments on the way over the bump that tell the story of a flight.

    Parameters
    ----------
    flight : suspension.flight.Flight
    robot : Robot
    bump : GaussianBump
    distance : float, optional
        How far the story goes, m, as in `travel`.

    Returns
    -------
    moments : tuple of Moment
        In order. With a lift-off: the front wheel at the foot of the bump, the first lift-off, the
        apex of that flight, its landing, and the highest wheel of all. Without: the front wheel at
        the foot and on the top of the bump, the body over the top, the rear wheel on it, and both
        past it.

    Raises
    ------
    ValueError
        If the flight's speed is not > 0, or `suspension.least_force.distance_over` refuses.
    TypeError
        If `flight` is not a Flight, `robot` not a Robot, or `bump` not a GaussianBump.
    """
    _checks.instance("flight", flight, Flight)
    v = _checks.positive("flight's v", flight.v)
    end = distance_over(robot, bump, distance) / v

    def passing(kind, place, wheel=None):
        """The moment at which a wheel, or the body, is at a place."""
        arm = 0.0 if wheel is None else robot.arms[wheel - 1]
        return Moment(kind, wheel, float((place - arm) / v))

    foot = passing("foot", bump.centre - 2 * bump.sigma, FRONT)
    events = [event for event in flight.events if event.t <= end]
    first = next((event for event in events if event.kind == "lift-off"), None)
    if first is None:
        return (
            foot,
            passing("top", bump.centre, FRONT),
            passing("top", bump.centre),
            passing("top", bump.centre, REAR),
            passing("past", bump.centre + 2 * bump.sigma, REAR)._replace(wheel=None),
        )
    landing = next(
        (
            event
            for event in events
            if (event.kind, event.wheel) == ("landing", first.wheel) and event.t > first.t
        ),
        None,
    )
    told = [foot, Moment("lift-off", first.wheel, first.t)]
    gaps = np.where(flight.T <= end, flight.gaps, -1)
    aloft = (flight.T > first.t) & (flight.T < (landing.t if landing else end))
    height = np.where(aloft, gaps[first.wheel - 1], 0)
    if height.max() > 0:  # a very short flight has no sample, and a wheel need not rise in it
        told.append(Moment("apex", first.wheel, float(flight.T[height.argmax()])))
    if landing:
        told.append(Moment("landing", first.wheel, landing.t))
    i, j = np.unravel_index(gaps.argmax(), gaps.shape)
    if gaps[i, j] > 0 and flight.T[j] not in [moment.t for moment in told]:
        told.append(Moment("highest", int(i) + 1, float(flight.T[j])))
    return tuple(sorted(told, key=lambda moment: moment.t))
