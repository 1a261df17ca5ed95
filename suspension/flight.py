"""After a wheel has left the ground: forces that switch off and on, every switch located.

Between two switches the robot is linear, with one or both forces missing: a leg, smooth, for
SciPy's DOP853. The zeros of Eq. 5 tell where it ends. With the compression ``p = h - Y`` of a
spring and Eq. 5 written ``f = k p + c p'``, a wheel lifts off where f turns negative, and while
f > 0 its height above the ground, times ``exp(k t / c)``, only falls: it lands at most once.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from scipy.integrate import DOP853, OdeSolution
from scipy.optimize import brentq

from suspension import _checks
from suspension.road import road_input
from suspension.robot import Robot

__all__ = ["Event", "Flight", "fly", "make_flight_gfunc"]

TOLERANCES = {"rtol": 1e-12, "atol": 1e-13}
DEGREE = 16  # of the polynomials whose roots are the zeros of Eq. 5
SHORTEST = 1e-11  # s; what lasts less is not told from roundoff
CHATTER = 100  # switches within the robot's shortest time constant
MAX_STEPS = 10**4  # of the integrator: some ten seconds
MAX_SAMPLES = 10**6


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
        """Time in s from which both forces stay within `fraction` of those at rest.

        nan if they have not settled before the run ends.
        """
        at_rest = (robot.C @ robot.equilibrium)[:, None]
        away = np.flatnonzero((np.abs(self.N - at_rest) > fraction * at_rest).any(axis=0))
        if not away.size:
            return 0.0
        if away[-1] == len(self.T) - 1:
            return np.nan
        return float(self.T[away[-1] + 1])

    def __repr__(self):
        return (
            f"<Flight: v = {self.v:g} m/s to t = {self.T[-1]:g} s, {len(self.events)} events, "
            f"airtime {self.airtime[0]:.3g} s rear, {self.airtime[1]:.3g} s front>"
        )


def fly(robot, road, *, v, tfinal, w0=None, wheel="follows", resolution=None, samples=2001):
    """Drive with normal forces that switch off and on, as the problem's footnote 1 describes.

    With ``p = h - Y`` for the compression of the spring above a wheel on the ground, Eq. 5 is
    ``f = k p + c p'``. A wheel that presses has ``N = f`` and lifts off where f falls below 0. A
    wheel that does not has ``N = 0`` and lands as soon as ``p >= x`` and ``f > 0``, where x is
    the compression of the spring above the free wheel, whose height above the ground is ``x - p``:

    - ``"follows"`` (footnote 1): ``x = 0``, a free wheel keeps to the fully extended spring, so
      ``N = max(0, f)`` while ``Y <= h`` and 0 above. At lift-off the spring is still compressed
      and the damper about to pull: the force ends without a jump. It comes back without one if
      f turns positive before the spring has extended; else the wheel rises and comes down at
      ``p = 0`` with the jump ``c p'``.
    - ``"relaxes"``: a massless wheel bears no force, ``k x + c x' = 0``, so x decays from p at
      lift-off with the time constant c / k. The landing force is c times the speed at which
      wheel and ground meet. With ``c = 0`` both models are the same.

    At t = 0 a wheel presses if ``p >= 0`` and ``f > 0``; else it is free, with ``x = 0``, or
    ``max(0, p)`` if it relaxes.

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
        If an argument is out of its range, asks for more than 10^4 steps of the integrator, or is
        so fast that the road's smallest feature lasts less than a nanosecond.
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
    _checks.instance("robot", robot, Robot)
    v, tfinal = _checks.number("v", v), _checks.positive("tfinal", tfinal)
    w = robot.equilibrium if w0 is None else _checks.array("w0", w0, (4,))
    _checks.one_of("wheel", wheel, ("follows", "relaxes"))
    samples = _checks.whole("samples", samples, 2)
    if samples > MAX_SAMPLES:
        raise ValueError(f"samples must be at most {MAX_SAMPLES}, got {samples}")
    resolution = getattr(road, "sigma", 1e-3) if resolution is None else resolution
    max_step = _longest_step(robot, v, tfinal, _checks.positive("resolution", resolution))

    springs = _spring_forces(robot, road)
    grid = np.linspace(0.0, tfinal, samples)
    relaxes = (robot.c > 0) & (wheel == "relaxes")
    rate = robot.k / np.where(relaxes, robot.c, np.inf)
    noise = TOLERANCES["atol"] * np.abs(robot.C).max(axis=1)  # forces the integrator cannot tell
    p, f = springs(w, 0.0, v)
    pressing = (p >= 0) & (f > 0)
    # Of a free wheel: when it left the ground, and its spring's compression then.
    lifted = np.zeros(2)
    compression = np.where(relaxes & (p > 0), p, 0.0)

    def gaps_and_forces(motion, t):
        p, f = springs(motion(t), t, v)
        free = compression * np.exp(-rate * np.subtract.outer(t, lifted))
        return free.T - p, f

    history, legs, events = [], [], []
    t = 0.0
    while t < tfinal:
        start = t
        gfunc = make_flight_gfunc(robot, road, pressing)
        t, motion, switched = _leg(
            gfunc, v, gaps_and_forces, noise, pressing, w, start, tfinal, max_step
        )
        if motion is not None:
            w = motion(t)
            T = np.concatenate([[start], grid[(grid > start) & (grid < t)], [t]])
            gaps, f = gaps_and_forces(motion, T)
            N = np.where(pressing[:, None], np.maximum(f, 0), 0)
            gaps = np.where(pressing[:, None], 0, np.maximum(gaps, 0))
            history.append((T, motion(T), N, gaps))
            legs.append((start, t, tuple(pressing.tolist())))
        p, f = springs(w, t, v)
        pressing = pressing ^ switched
        lifted = np.where(switched, t, lifted)
        compression = np.where(switched, p * relaxes, compression)
        for i in np.flatnonzero(switched):
            kind, force = ("landing", float(f[i])) if pressing[i] else ("lift-off", 0.0)
            events.append(Event(int(i) + 1, kind, t, v * t, force))
        if len(events) > CHATTER:
            shortest = 1 / np.abs(robot.eigenvalues).max()
            if t - events[-CHATTER - 1].t < shortest:
                raise RuntimeError(
                    f"the robot chatters: {CHATTER} switches just before t = {t:g} s"
                )
    T, W, N, gaps = map(np.hstack, zip(*history, strict=True))
    return Flight(T, W, N, gaps, tuple(events), tuple(legs), v)


def _longest_step(robot, v, tfinal, resolution):
    """The longest step that sees every feature of the road, s, if that many can be taken."""
    if v == 0:
        return np.inf
    longest = 2 * resolution / abs(v)
    if longest < 100 * SHORTEST:
        raise ValueError(
            "v must be so low, or resolution so large, that a feature of the road lasts a "
            f"nanosecond, got v={v:g}, resolution={resolution:g}"
        )
    steps = tfinal * (1 / longest + np.abs(robot.eigenvalues).max() / 6)
    if steps > MAX_STEPS:
        raise ValueError(
            f"tfinal must take at most {MAX_STEPS} steps, got tfinal={tfinal:g} at v={v:g}: "
            f"{steps:.2g} steps"
        )
    return longest


def make_flight_gfunc(robot, road, pressing=None, start=0.0):
    """Return ``gfunc(w, t, v) -> (wdot, N1, N2)``, as `suspension.course.make_gfunc` does.

    The forces are those of "follows", told from the state alone, for a method that looks for no
    switch. With `pressing` they are those of one leg of a `Flight`, and t counts from its `start`.
    """
    _checks.instance("robot", robot, Robot)
    _checks.function("road", road, "road(x) -> (H, dHdx)")
    springs = _spring_forces(robot, road)

    def gfunc(w, t, v):
        p, f = springs(w, start + t, v)
        N = np.where((p >= 0) & (f > 0) if pressing is None else pressing, f, 0.0)
        return robot.S @ w + robot.P @ N + robot.e, *N

    return gfunc


def _spring_forces(robot, road):
    """Return ``springs(w, t, v) -> p, f``: compressions, m, and Eq. 5, N, shape (2, n) or (2,)."""
    still, one = np.zeros(2), np.ones(2)
    C = np.vstack([-np.column_stack([one, still, robot.arms, still]), robot.C])
    D = np.vstack([np.eye(2, 4), robot.D])

    def springs(w, t, v):
        both = C @ w + D @ road_input(robot, road, v, t)
        return both[:2], both[2:]

    return springs


def _leg(gfunc, v, gaps_and_forces, noise, pressing, w, t, tfinal, max_step):
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
        end, switched = _first_switch(
            lambda t, piece=piece: gaps_and_forces(piece, t),
            noise,
            pressing,
            solver.t_old,
            solver.t,
        )
        if end > times[-1]:
            times.append(end)
            pieces.append(piece)
        if switched.any() or solver.status == "finished":
            return end, OdeSolution(times, pieces) if pieces else None, switched
    raise RuntimeError(f"road is too rough to integrate at t = {solver.t:g} s")


def _first_switch(gaps_and_forces, noise, pressing, a, b):
    """Return the first switch in [a, b], b if none, and which wheels switch then, bool (2,)."""
    edges = np.array([a, *_zeros(lambda t: gaps_and_forces(t)[1], a, b), b])
    edges = edges[np.diff(edges, prepend=-np.inf) > SHORTEST]
    for left, right in pairwise(edges.tolist()):
        pushes = gaps_and_forces((left + right) / 2)[1] > np.where(pressing, -noise, noise)
        lifts = pressing & ~pushes
        if lifts.any():
            return left, lifts
        lands = ~pressing & pushes & (gaps_and_forces(right)[0] <= 0)
        if lands.any():
            high = gaps_and_forces(left)[0] > 0
            times = np.where(lands, left, np.inf)
            for i in np.flatnonzero(lands & high):
                times[i] = brentq(lambda t, i: gaps_and_forces(t)[0][i], left, right, (i,), 1e-14)
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
    converged = (size[:, -2:].max(axis=1) <= 1e-10 * size.max(axis=1)).all()
    if halvings and not converged:
        return _zeros(f, a, middle, halvings - 1) + _zeros(f, middle, b, halvings - 1)
    zeros = []
    for coefficients in series:
        if np.abs(coefficients[1:]).sum() < abs(coefficients[0]):
            continue  # too far from zero to reach it
        z = chebyshev.chebroots(coefficients)
        zeros += (middle + half * z.real[(np.abs(z.imag) < 1e-6) & (np.abs(z.real) < 1)]).tolist()
    return sorted(zeros)
