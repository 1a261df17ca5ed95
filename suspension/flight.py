"""After a wheel has left the ground: forces that switch off and on, every switch located.

Between two switches the robot is linear, with one or both forces missing: a leg, smooth, for
SciPy's DOP853. The zeros of Eq. 5 tell where it ends. With the compression ``p = h - Y`` of a
spring and Eq. 5 written ``E = k p + c p'``, a wheel lifts off where E turns negative, and while
E > 0 its height above the ground, times ``exp(k t / c)``, only falls: it lands at most once.
"""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from scipy.integrate import DOP853, OdeSolution
from scipy.optimize import brentq

from suspension import _checks
from suspension.road import road_input

__all__ = ["Event", "Flight", "fly", "make_flight_gfunc"]

TOLERANCES = {"rtol": 1e-12, "atol": 1e-13}
DEGREE = 16  # of the polynomials whose roots are the zeros of Eq. 5
SHORTEST = 1e-11  # s; what lasts less is not told from roundoff
CHATTER = 100  # switches within the robot's shortest time constant
MAX_STEPS = 10**5


class Event(NamedTuple):
    """A switch: wheel 1 (rear) or 2 (front), "lift-off" or "landing", the time in s, the place
    of the centre of mass in m, and the normal force just after it in N."""

    wheel: int
    kind: str
    t: float
    X: float
    force: float


@dataclass(frozen=True, eq=False)
class Flight:
    """A computed run in which contact is lost and found again.

    Attributes
    ----------
    T : ndarray, shape (J+1,)
        Times, s: equally spaced ones and every switch, twice, just before and just after it.
    W : ndarray, shape (4, J+1)
        States ``[Y, Y', theta, theta']``.
    N, gaps : ndarray, shape (2, J+1)
        Normal forces, N, never negative, and heights of the wheels above the ground, m.
    events : tuple of Event
    legs : tuple of (start, end, pressing)
        What lies between events: from when to when, s, and which wheels press, two bools.
    v : float
        Speed, m/s.
    """

    T: np.ndarray
    W: np.ndarray
    N: np.ndarray
    gaps: np.ndarray
    events: tuple
    legs: tuple
    v: float

    @property
    def airtime(self):
        """How long each wheel bears no force, s, shape (2,)."""
        return sum((end - start) * ~np.array(pressing) for start, end, pressing in self.legs)

    def settled(self, robot, fraction=0.05):
        """Time in s from which both forces stay within `fraction` of those at rest, or nan."""
        rest = (robot.C @ robot.equilibrium)[:, None]
        away = np.flatnonzero((np.abs(self.N - rest) > fraction * rest).any(axis=0))
        return float(np.append(self.T, np.nan)[away[-1] + 1]) if away.size else 0.0


def fly(robot, road, *, v, tfinal, w0=None, wheel="follows", resolution=None, samples=2001):
    """Drive with normal forces that switch off and on, as the problem's footnote 1 describes.

    With ``p = h - Y`` for the compression of the spring above a wheel on the ground, Eq. 5 is
    ``E = k p + c p'``. A wheel that presses has ``N = E`` and lifts off where E falls below 0. A
    wheel that does not has ``N = 0`` and lands as soon as ``p >= x`` and ``E > 0``, where x is
    the compression of the spring above the free wheel, whose height above the ground is ``x - p``:

    - ``"follows"`` (footnote 1): ``x = 0``, a free wheel keeps to the fully extended spring, so
      ``N = max(0, E)`` while ``Y <= h`` and 0 above. At lift-off the spring is still compressed
      and the damper about to pull: the force ends without a jump. It comes back without one if
      E turns positive before the spring has extended; else the wheel rises and comes down at
      ``p = 0`` with the jump ``c p'``.
    - ``"relaxes"``: a massless wheel bears no force, ``k x + c x' = 0``, so x decays from p at
      lift-off with the time constant c / k. The landing force is c times the speed at which
      wheel and ground meet. With ``c = 0`` both models are the same.

    At t = 0 a wheel presses if ``p >= 0`` and ``E > 0``; else it hangs, with ``x = max(0, p)``.

    Parameters
    ----------
    robot : Robot
    road : callable
        ``road(x) -> (H, dHdx)``, smooth: a spline through a table, not straight lines.
    v, tfinal : float
        Speed, m/s, and final time, s, > 0.
    w0 : array_like, shape (4,), optional
        State at t = 0; the equilibrium on flat ground if not given.
    wheel : {"follows", "relaxes"}
        What a wheel does in the air.
    resolution : float, optional
        Size of the road's smallest feature, m, > 0; by default its `sigma` if any, else 1 mm.
    samples : int
        Number of equally spaced times in the result, >= 2.

    Returns
    -------
    Flight

    Raises
    ------
    ValueError
        If an argument is out of its range, or asks for more than 10^5 steps.
    RuntimeError
        If the robot chatters (100 switches in its shortest time constant) or the road is rough.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> flight = fly(Robot(800, 800), GaussianBump(), v=5, tfinal=0.15)
    >>> [(e.wheel, e.kind, round(e.t, 4)) for e in flight.events]
    [(2, 'lift-off', 0.0565), (1, 'lift-off', 0.0978), (2, 'landing', 0.1048)]
    """
    v, tfinal = _checks.number("v", v), _checks.positive("tfinal", tfinal)
    w = robot.equilibrium if w0 is None else _checks.array("w0", w0, (4,))
    _checks.one_of("wheel", wheel, ("follows", "relaxes"))
    resolution = getattr(road, "sigma", 1e-3) if resolution is None else resolution
    max_step = 2 * _checks.positive("resolution", resolution) / abs(v) if v else np.inf
    samples = _checks.number("samples", samples, "an int >= 2", lambda n: n >= 2 and n % 1 == 0)
    fastest = np.abs(robot.eigenvalues).max()
    if (steps := tfinal * (1 / max_step + fastest / 6)) > MAX_STEPS:
        raise ValueError(f"tfinal must take at most {MAX_STEPS} steps, got {tfinal!r}: {steps:.2g}")

    contact, grid = _contact(robot, road), np.linspace(0.0, tfinal, int(samples))
    k, c = -robot.C[:, :2].T
    relaxes = (c > 0) & (wheel == "relaxes")
    rate = k / np.where(relaxes, c, np.inf)
    noise = TOLERANCES["atol"] * np.abs(robot.C).max(axis=1)  # forces the integrator cannot tell
    p, E = contact(w, 0.0, v)
    pressing, t0, x0 = (p >= 0) & (E > 0), np.zeros(2), np.where(relaxes & (p > 0), p, 0)

    def state(motion, t):
        p, E = contact(motion(t), t, v)
        return (x0 * np.exp(-rate * np.subtract.outer(t, t0))).T - p, E

    history, legs, events, t = [], [], [], 0.0
    while t < tfinal:
        start, gfunc = t, make_flight_gfunc(robot, road, pressing)
        t, motion, switched = _leg(gfunc, v, state, noise, pressing, w, t, tfinal, max_step)
        if motion is not None:
            w = motion(t)
            T = np.concatenate([[start], grid[(grid > start) & (grid < t)], [t]])
            on, (gaps, N) = pressing[:, None], np.maximum(state(motion, T), 0)
            history.append((T, motion(T), np.where(on, N, 0), np.where(on, 0, gaps)))
            legs.append((start, t, tuple(pressing.tolist())))
        p, E = contact(w, t, v)
        pressing = pressing ^ switched
        t0, x0 = np.where(switched, t, t0), np.where(switched, p * relaxes, x0)
        for i in np.flatnonzero(switched):
            kind, force = ("landing", float(E[i])) if pressing[i] else ("lift-off", 0.0)
            events.append(Event(int(i) + 1, kind, t, v * t, force))
        if len(events) > CHATTER and t - events[-CHATTER - 1].t < 1 / fastest:
            raise RuntimeError(f"the robot chatters: {CHATTER} switches just before t = {t:g} s")
    return Flight(*map(np.hstack, zip(*history, strict=True)), tuple(events), tuple(legs), v)


def make_flight_gfunc(robot, road, pressing=None, start=0.0):
    """Return ``gfunc(w, t, v) -> (wdot, N1, N2)``, as `suspension.course.make_gfunc` does.

    The forces are those of "follows", told from the state alone, for a method that looks for no
    switch. With `pressing` they are those of one leg of a `Flight`, and t counts from its `start`.
    """
    S, P, e, contact = robot.S, robot.P, robot.e, _contact(robot, road)

    def gfunc(w, t, v):
        p, E = contact(w, start + t, v)
        N = np.where((p >= 0) & (E > 0) if pressing is None else pressing, E, 0.0)
        return S @ w + P @ N + e, *N

    return gfunc


def _contact(robot, road):
    """Return ``f(w, t, v)``: compressions, m, and Eq. 5, N, stacked, shape (2, 2, ...)."""
    both = replace(robot, k1=1, k2=1, c1=0, c2=0), robot  # Eq. 5 of unit springs alone is p
    C, D = np.vstack([r.C for r in both]), np.vstack([r.D for r in both])
    return lambda w, t, v: (C @ w + D @ road_input(robot, road, v, t)).reshape(2, 2, *np.shape(t))


def _leg(gfunc, v, state, noise, pressing, w, t, tfinal, max_step):
    """Integrate to the next switch: when, the motion until then (None if at once), which wheels."""
    solver = DOP853(lambda t, w: gfunc(w, t, v)[0], t, w, tfinal, max_step=max_step, **TOLERANCES)
    times, pieces = [t], []
    while len(pieces) < MAX_STEPS:
        solver.step()
        # Over a kink some ten steps are as short as this, over noise all are.
        crawls = len(times) > 200 and times[-1] - times[-200] < 200 * SHORTEST
        if solver.status == "failed" or crawls:
            break
        piece = solver.dense_output()
        end, switched = _first_switch(state, noise, piece, pressing, solver.t_old, solver.t)
        if end > times[-1]:
            times.append(end)
            pieces.append(piece)
        if switched.any() or solver.status == "finished":
            return end, OdeSolution(times, pieces) if pieces else None, switched
    raise RuntimeError(f"road is too rough to integrate at t = {solver.t:g} s")


def _first_switch(state, noise, motion, pressing, a, b):
    """Return the first switch in [a, b], b if none, and which wheels switch then, bool (2,)."""
    edges = np.array([a, *_zeros(lambda t: state(motion, t)[1], a, b), b])
    edges = edges[np.diff(edges, prepend=-np.inf) > SHORTEST]
    for left, right in pairwise(edges.tolist()):
        push = state(motion, (left + right) / 2)[1] > np.where(pressing, -noise, noise)
        if (pressing & ~push).any():
            return left, pressing & ~push
        lands = ~pressing & push & (state(motion, right)[0] <= 0)
        if lands.any():
            times = np.where(lands, left, np.inf)
            for i in np.flatnonzero(lands & (state(motion, left)[0] > 0)):
                times[i] = brentq(lambda t, i: state(motion, t)[0][i], left, right, (i,), 1e-14)
            return float(times.min()), times < times.min() + SHORTEST
    return b, np.zeros(2, dtype=bool)


def _zeros(f, a, b, halvings=5):
    """Sorted zeros in (a, b) of the components of f, a callable of t: (n,) -> (m, n).

    They are roots of Chebyshev interpolants, eigenvalues of a matrix: two close zeros are found
    like any other. Where an interpolant has not converged (a kink), the interval is halved.
    """
    middle, half = (a + b) / 2, (b - a) / 2
    series = chebyshev.chebinterpolate(lambda s: f(middle + half * s).T, DEGREE).T
    size = np.abs(series)
    if halvings and (size[:, -2:].max(axis=1) > 1e-10 * size.max(axis=1)).any():
        return _zeros(f, a, middle, halvings - 1) + _zeros(f, middle, b, halvings - 1)
    roots = [chebyshev.chebroots(c) for c in series if np.abs(c[1:]).sum() >= abs(c[0])]
    z = np.concatenate([[], *roots])
    return sorted(middle + half * z.real[(np.abs(z.imag) < 1e-6) & (np.abs(z.real) < 1)])
