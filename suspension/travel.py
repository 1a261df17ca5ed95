"""Where the model itself is in doubt: how far the springs travel and how far the body tilts.

And what to look at in a flight: the moments that tell its story.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.contact import critical_speeds, exact_loss, margin, minima
from suspension.critical import zeros
from suspension.exact import over_bump
from suspension.forces import WHEEL
from suspension.least_force import distance_over
from suspension.road import road_input

__all__ = [
    "Balance",
    "Travel",
    "balance",
    "compression_map",
    "margin_map",
    "moments",
    "overtravel",
    "travel",
]


MAX_SAMPLES = 10**6


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
    ranges : ndarray, shape (n, 2)
        Lower and upper edges, m/s, in order. A range narrower than a fortieth of its speed may be
        missed.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> overtravel(Robot(800, 800), GaussianBump(), 0.0165, 0.5, 2).round(2)
    array([[0.73, 2.  ]])
    """
    limit = _checks.positive("limit", limit)
    vmin, vmax = _checks.ends("vmin", vmin, "vmax", vmax)

    def excess(x):
        most = travel(robot, bump, np.exp(x), 1001, distance=distance).compression
        return most / limit - 1

    samples = 2 + int(40 * np.log(vmax / vmin))
    x = np.linspace(np.log(vmin), np.log(vmax), samples)
    # The moment of the loss jumps at a critical speed.
    turns = np.log(critical_speeds(robot, bump, vmin, vmax, distance=distance))
    edges = np.array([vmin, *np.exp(zeros(excess, np.union1d(x, turns))), vmax])
    inside = [excess(np.log(middle)) > 0 for middle in np.sqrt(edges[1:] * edges[:-1])]
    ranges = []
    for left, right, beyond in zip(edges[:-1], edges[1:], inside, strict=True):
        if beyond and ranges and ranges[-1][1] == left:
            ranges[-1][1] = right
        elif beyond:
            ranges.append([left, right])
    return np.array(ranges).reshape(-1, 2)


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
    """
    robots = [replace(robot, k1=stiffness, k2=stiffness) for stiffness in k]
    return np.array(
        [[margin(other, bump, speed, distance=distance) for speed in v] for other in robots]
    )


def compression_map(robot, bump, v, k, *, distance=None):
    """The largest compression of a spring, in m, over speed and stiffness, as `margin_map`."""
    robots = [replace(robot, k1=stiffness, k2=stiffness) for stiffness in k]
    return np.array(
        [
            [travel(other, bump, speed, 501, distance=distance).compression for speed in v]
            for other in robots
        ]
    )


class Balance(NamedTuple):
    """What the force on a wheel, 1 (rear) or 2 (front), is the sum of: spring and damper, N."""

    wheel: int
    spring: float
    damper: float


def balance(robot, bump, v, *, distance=None):
    """The two parts of the least normal force on the way over the bump, at `v` in m/s.

    `distance` is that of `travel`.
    """
    least = min(minima(robot, bump, v, distance=distance), key=lambda minimum: minimum.force)
    t = np.array([least.t])
    i = least.wheel - 1
    compression = _compression(robot, bump, v, t, over_bump(robot, bump, v, t))
    spring = float(robot.k[i] * compression[i, 0])
    return Balance(least.wheel, spring, least.force - spring)


def moments(flight, robot, bump, *, distance=None):
    """The moments on the way over the bump that tell the story of a flight, with words for each.

    Parameters
    ----------
    flight : suspension.flight.Flight
    robot : Robot
    bump : GaussianBump
    distance : float, optional
        How far the story goes, m, as in `travel`.

    Returns
    -------
    moments : dict of float to str
        Times, s, in order. With a lift-off: the front wheel at the foot of the bump, the first
        lift-off, the highest point of that flight, its landing, and the highest wheel of all.
        Without: the front wheel at the foot and on the top of the bump, the body over the top, the
        rear wheel on it, and both past it.
    """
    v = _checks.positive("flight's v", flight.v)
    end = distance_over(robot, bump, distance) / v
    foot = bump.centre - 2 * bump.sigma
    told = {(foot - robot.L2) / v: f"the {WHEEL[2]} wheel reaches the bump"}
    lift_offs = [event for event in flight.events if event.kind == "lift-off" and event.t <= end]
    if not lift_offs:
        told[(bump.centre - robot.L2) / v] = f"the {WHEEL[2]} wheel is on its top"
        told[bump.centre / v] = "the body is over it"
        told[(bump.centre + robot.L1) / v] = f"the {WHEEL[1]} wheel is on its top"
        told[(bump.centre + 2 * bump.sigma + robot.L1) / v] = "both have passed"
        return told
    first = lift_offs[0]
    told[first.t] = f"the {WHEEL[first.wheel]} wheel lifts off"
    landings = [
        event.t
        for event in flight.events
        if event.wheel == first.wheel and event.kind == "landing" and first.t < event.t <= end
    ]
    gaps = np.where(flight.T <= end, flight.gaps, -1)
    aloft = (flight.T > first.t) & (flight.T < (landings[0] if landings else end))
    height = np.where(aloft, gaps[first.wheel - 1], 0)
    if height.max() > 0:  # a very short flight has no sample, and a wheel need not rise in it
        told[float(flight.T[height.argmax()])] = "it is at the top of this flight"
    if landings:
        told[landings[0]] = "it lands"
    i, j = np.unravel_index(gaps.argmax(), gaps.shape)
    if gaps[i, j] > 0 and float(flight.T[j]) not in told:
        told[float(flight.T[j])] = f"the {WHEEL[i + 1]} wheel is at its highest"
    return dict(sorted(told.items()))
