"""Where the energy goes on the way over a road: what the road puts in, and what becomes of it.

The road works on the wheels with ``N_i h_i'``. While a wheel presses, ``N = k p + c p'`` with the
compression ``p = h - Y_i``, so that ``N h' = N Y_i' + d(k p^2 / 2)/dt + c p'^2``: a part moves the
body, a part is stored, a part becomes heat. A free wheel bears nothing; its spring moves against
its own damper, and all that it gives up is heat, too.
"""

from typing import NamedTuple

import numpy as np
from scipy.integrate import cumulative_trapezoid

from suspension import _checks
from suspension.flight import Flight
from suspension.road import road_input
from suspension.robot import Robot

__all__ = ["Energy", "Landing", "energy", "landings"]


class Energy(NamedTuple):
    """What the road has put in since t = 0 and where it is, J, each of shape (J+1,).

    `work` is the sum of the others: `kinetic` of the body, `potential` of the body's weight and the
    springs, less that at t = 0, and the `heat` of the dampers.
    """

    work: np.ndarray
    kinetic: np.ndarray
    potential: np.ndarray
    heat: np.ndarray


class Landing(NamedTuple):
    """What a landing does.

    Wheel 1 (rear) or 2 (front) lands at `t`, s; it meets the ground at a `speed`, m/s, with a
    `force` at once, N. Until it lifts off again (or the run ends), at `end`, s, the ground gives an
    `impulse`, N s, and its damper makes `heat`, J.
    """

    wheel: int
    t: float
    speed: float
    force: float
    end: float
    impulse: float
    heat: float


def energy(flight, robot, road):
    """The energy on the way, by the trapezoidal rule over the samples of a flight.

    Parameters
    ----------
    flight : Flight
        With samples as dense as the accuracy that is wanted.
    robot : Robot
    road : callable
        ``road(x) -> (H, dHdx)``, of the flight.

    Returns
    -------
    Energy

    Raises
    ------
    ValueError
        If the road returns another shape than it was given, or a value that is not finite.
    TypeError
        If `flight` is not a Flight, `robot` not a Robot, or `road` not a function.
    """
    _checks.instance("flight", flight, Flight)
    _checks.instance("robot", robot, Robot)
    u, p, rate = _compressions(flight, robot, road)
    Y, dY, _, turn = flight.W
    kinetic = (robot.m * dY**2 + robot.Izz * turn**2) / 2
    springs = robot.k[:, None] * (p + flight.gaps) ** 2 / 2
    potential = robot.m * robot.g * Y + springs.sum(axis=0)
    pressing = _pressing(flight)
    work = _since_start(flight, (flight.N * u[2:]).sum(axis=0))
    heat = _since_start(flight, np.where(pressing, robot.c[:, None] * rate**2, 0).sum(axis=0))
    # In the air, what the springs give up between two samples.
    free = ~(pressing[:, 1:] & pressing[:, :-1])
    given = np.where(free, -np.diff(springs, axis=1), 0).sum(axis=0)
    heat = heat + np.concatenate([[0.0], np.cumsum(given)])
    return Energy(work, kinetic - kinetic[0], potential - potential[0], heat)


def landings(flight, robot, road):
    """Every landing of a flight, what it passes on and what it costs.

    Parameters and errors are those of `energy`.

    Returns
    -------
    landings : tuple of Landing
    """
    _checks.instance("flight", flight, Flight)
    _checks.instance("robot", robot, Robot)
    _, _, rate = _compressions(flight, robot, road)
    impulse = _since_start(flight, flight.N)
    heat = _since_start(flight, np.where(_pressing(flight), robot.c[:, None] * rate**2, 0))
    found = []
    for event in flight.events:
        if event.kind != "landing":
            continue
        i = event.wheel - 1
        later = [e.t for e in flight.events if e.wheel == event.wheel and e.t > event.t]
        end = min(later, default=float(flight.T[-1]))
        a, b = np.searchsorted(flight.T, [event.t, end], side="right") - 1
        speed = event.force / robot.c[i] if robot.c[i] > 0 else rate[i, a]
        found.append(
            Landing(
                event.wheel,
                event.t,
                float(speed),
                event.force,
                end,
                float(impulse[i, b] - impulse[i, a]),
                float(heat[i, b] - heat[i, a]),
            )
        )
    return tuple(found)


def _compressions(flight, robot, road):
    """The road's input, and ``p = h - Y_i`` with its rate of change, m and m/s."""
    u = road_input(robot, road, flight.v, flight.T)
    ends = flight.W[0] + np.outer(robot.arms, flight.W[2])
    rates = flight.W[1] + np.outer(robot.arms, flight.W[3])
    return u, u[:2] - ends, u[2:] - rates


def _pressing(flight):
    """Which wheels press at each sample, bool, shape (2, J+1); a switch has one to each side."""
    pressing = np.empty((2, len(flight.T)), dtype=bool)
    first = 0
    for start, end, wheels in flight.legs:
        inside = (flight.T > start) & (flight.T < end)
        last = first + inside.sum() + 2
        pressing[:, first:last] = np.array(wheels)[:, None]
        first = last
    return pressing


def _since_start(flight, rate):
    return cumulative_trapezoid(rate, flight.T, axis=-1, initial=0)
