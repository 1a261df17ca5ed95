"""After a wheel has left the ground: forces that switch off and on, every switch located.

Between two switches the robot is linear, with one or both forces missing: a leg, smooth, for
SciPy's DOP853. The zeros of Eq. 5 tell where it ends. With the compression ``p = h - Y`` of a
spring and Eq. 5 written ``f = k p + c p'``, a wheel lifts off where f turns negative, and while
f > 0 its height above the ground, times ``exp(k t / c)``, only falls: it lands at most once.

Where the road has a kink f jumps. If the road names its `kinks`, a leg ends at each of them, under
either wheel. If it does not, DOP853 creeps over those under wheels that press, and a switch is
looked for by halving an interval, which finds a jump like a zero.
"""

from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike
from scipy.integrate import DOP853, OdeSolution

from suspension import _checks
from suspension.road import Road, checked_input, profile, road_input
from suspension.robot import Robot
from suspension.simulation import as_frame

if TYPE_CHECKING:
    import pandas

__all__ = ["Event", "Flight", "fly", "make_flight_gfunc"]

TOLERANCES = {"rtol": 1e-12, "atol": 1e-13}
DEGREE = 16  # of the polynomials whose roots are the zeros of Eq. 5
SHORTEST = 1e-11  # s; what lasts less is not told from roundoff
BESIDE = 1e-14  # of its place, m: how near a kink the road is still asked for its own side
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
        Times, s: equally spaced ones, and both ends of every leg: a switch stands there twice, just
        before and just after it.
    W : ndarray, shape (4, J+1)
        States ``[Y, Y', theta, theta']``.
    N, gaps : ndarray, shape (2, J+1)
        Normal forces, N, never negative, and heights of the wheels above the ground, m.
    events : tuple of Event
    legs : tuple of (start, end, pressing)
        What lies between events, and between the road's `kinks`: from when to when, s, and which
        wheels press, two bools.
    v : float
        Speed, m/s.
    """

    T: np.ndarray
    W: np.ndarray
    N: np.ndarray
    gaps: np.ndarray
    events: tuple[Event, ...]
    legs: tuple[tuple[float, float, tuple[bool, bool]], ...]
    v: float

    @property
    def airtime(self) -> np.ndarray:
        """How long each wheel bears no force, s, shape (2,)."""
        start, end, pressing = map(np.array, zip(*self.legs, strict=True))
        return (end - start) @ ~pressing

    @property
    def flights(self) -> np.ndarray:
        """How often each wheel is in the air, shape (2,), of int; a start in the air counts."""
        pressing = np.array([(True, True), *(leg[2] for leg in self.legs)])
        return (pressing[:-1] & ~pressing[1:]).sum(axis=0)

    @property
    def highest(self) -> np.ndarray:
        """Largest height of each wheel above the ground, at the times `T`, m, shape (2,)."""
        return self.gaps.max(axis=1)

    def to_frame(self) -> "pandas.DataFrame":
        """The run as a pandas DataFrame, a row for each time, with units in the columns' names."""
        return as_frame(self, {"gap1 rear (m)": self.gaps[0], "gap2 front (m)": self.gaps[1]})

    def settled(self, robot: Robot, fraction: float = 0.05) -> float:
        """Time in s from which both forces stay within `fraction` of those at rest.

        nan if they have not settled before the run ends.

        Raises
        ------
        ValueError
            If `fraction` is no finite number >= 0.
        """
        _checks.instance("robot", robot, Robot)
        fraction = _checks.nonnegative("fraction", fraction)
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


def fly(
    robot: Robot,
    road: Road,
    *,
    v: float,
    tfinal: float,
    w0: ArrayLike | None = None,
    wheel: Literal["follows", "relaxes"] = "follows",
    resolution: float | None = None,
    samples: int = 2001,
) -> Flight:
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
        ``road(x) -> (H, dHdx)``. Where its slope or curvature jumps it may say so, in an attribute
        `kinks`, positions in m: not needed, but some ten times as fast for each of them.
    v, tfinal : float
        Speed, m/s, and final time, s, > 0.
    w0 : array_like, shape (4,), optional
        State at t = 0; the equilibrium on flat ground if not given.
    wheel : {"follows", "relaxes"}
        What a wheel does in the air.
    resolution : float, optional
        Size of the road's smallest feature, m, > 0: no step is longer than twice that. By default
        the road's own attribute `resolution`, 1 mm for a road that has none.
    samples : int
        Number of equally spaced times in the result, >= 2.

    Returns
    -------
    Flight

    Raises
    ------
    ValueError
        If an argument is out of its range, asks for more than 10^4 steps of the integrator or for
        as many kinks, or is so fast that the road's smallest feature lasts less than a nanosecond.
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
    if resolution is None:
        resolution = getattr(road, "resolution", 1e-3)
    max_step = _longest_step(robot, v, tfinal, _checks.positive("resolution", resolution))
    stops = _stops(robot, road, v, tfinal)
    road_input(robot, road, v, stops[0] * np.array([0.25, 0.75]))  # answers in arrays

    grid = np.linspace(0.0, tfinal, samples)
    relaxes = (robot.c > 0) & (wheel == "relaxes")
    rate = robot.k / np.where(relaxes, robot.c, np.inf)
    noise = TOLERANCES["atol"] * np.abs(robot.C).max(axis=1)  # forces the integrator cannot tell
    p, f = _spring_forces(robot, road, 0.0, stops[0])(w, 0.0, v)
    pressing = (p >= 0) & (f > 0)
    # Of a free wheel: when it left the ground, and its spring's compression then.
    lifted = np.zeros(2)
    compression = np.where(relaxes & (p > 0), p, 0.0)

    def gaps_and_forces(springs, motion, t):
        p, f = springs(motion(t), t, v)
        free = compression * np.exp(-rate * np.subtract.outer(t, lifted))
        return free.T - p, f

    history, legs, events = [], [], []
    t = 0.0
    while t < tfinal:
        start, stop = t, float(stops[np.searchsorted(stops[:-1], t + SHORTEST)])
        springs = _spring_forces(robot, road, start, stop)
        on_this_leg = partial(gaps_and_forces, springs)
        gfunc = _gfunc(robot, springs, pressing)
        t, motion, switched = _leg(gfunc, v, on_this_leg, noise, pressing, w, start, stop, max_step)
        if motion is not None:
            w = motion(t)
            T = np.concatenate([[start], grid[(grid > start) & (grid < t)], [t]])
            gaps, f = on_this_leg(motion, T)
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
                    f"the robot chatters: {CHATTER} switches just before t = {t:g} s; "
                    "drive slower, or smooth the ripple of the road there"
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
    swings = np.abs(robot.eigenvalues).max() / 6
    steps = tfinal * (1 / longest + swings)
    if steps > MAX_STEPS:
        remedy = "shorten tfinal"
        if tfinal * swings < MAX_STEPS / 2:
            remedy += f", or give resolution=, larger than {resolution:g} m if the road allows"
        raise ValueError(
            f"tfinal must take at most {MAX_STEPS} steps, got tfinal={tfinal:g} at v={v:g} with "
            f"resolution={resolution:g}: {steps:.2g} steps; {remedy}"
        )
    return longest


def _stops(robot, road, v, tfinal):
    """Times at which a wheel stands on one of the road's kinks, then `tfinal`, shape (n,), s."""
    kinks = _checks.array("road's kinks", getattr(road, "kinks", ()), (None,))
    if v == 0 or not kinks.size:
        return np.array([tfinal])
    t = np.sort(np.subtract.outer(kinks, robot.arms).ravel() / v)
    t = t[(t > SHORTEST) & (t < tfinal - SHORTEST)]
    t = t[np.diff(t, prepend=0.0) > SHORTEST]
    if len(t) > MAX_STEPS:
        raise ValueError(
            f"tfinal must take the wheels over at most {MAX_STEPS} kinks of the road, "
            f"got tfinal={tfinal:g} at v={v:g}: {len(t)} kinks; shorten tfinal, or thin the road's "
            "points"
        )
    return np.append(t, tfinal)


def make_flight_gfunc(robot, road, pressing=None, start=0.0, end=None):
    """Return ``gfunc(w, t, v) -> (wdot, N1, N2)``, as `suspension.course.make_gfunc` does.

    The forces are those of "follows", told from the state alone, for a method that looks for no
    switch. With `pressing`, two bools, they are those of one leg of a `Flight`, and t counts from
    its `start`, s; with its `end` as well, a kink of the road there is seen from inside.

    Raises
    ------
    ValueError
        If `start` is no finite number, `end` is none or not later, `pressing` does not hold two
        bools, or the road returns another shape than it was given, or what is not finite; and from
        the returned function, if w has another shape, t or v is no finite number, or the road
        returns such a thing. What an unstable run makes of w, infinite or nan, is handed on.
    """
    _checks.instance("robot", robot, Robot)
    _checks.function("road", road, "road(x) -> (H, dHdx)")
    start = _checks.number("start", start)
    profile(road, robot.arms)  # answers in arrays
    sides = () if end is None else (start, _checks.number("end", end, "> start", start.__lt__))
    if pressing is not None:
        bools = _checks.array("pressing", pressing, (2,))
        if not np.isin(bools, (0, 1)).all():
            raise ValueError(f"pressing must hold True or False for each wheel, got {pressing}")
        pressing = bools.astype(bool)
    gfunc = _gfunc(robot, _spring_forces(robot, road, *sides), pressing, start)

    def checked(w, t, v):
        w = _checks.array("w", w, (4,), finite=False)
        return gfunc(w, _checks.number("t", t), _checks.number("v", v))

    return checked


def _gfunc(robot, springs, pressing, start=0.0):
    def gfunc(w, t, v):
        p, f = springs(w, start + t, v)
        # A state of nan has forces of nan, not none.
        N = np.where(~((p < 0) | (f <= 0)) if pressing is None else pressing, f, 0.0)
        return robot.S @ w + robot.P @ N + robot.e, *N

    return gfunc


def _spring_forces(robot, road, first=-np.inf, last=np.inf):
    """Return ``springs(w, t, v) -> p, f``: compressions, m, and Eq. 5, N, shape (2, n) or (2,).

    With kinks at the times `first` and `last` the road is asked between them only: whatever it
    says on a kink itself, both ends of a leg belong to it. Who calls this has had the road's
    answer checked once.
    """
    still, one = np.zeros(2), np.ones(2)
    C = np.vstack([-np.column_stack([one, still, robot.arms, still]), robot.C])
    D = np.vstack([np.eye(2, 4), robot.D])
    one_sided = len(getattr(road, "kinks", ())) > 0

    def springs(w, t, v):
        if one_sided and v:
            beside = BESIDE * (1 / abs(v) + np.abs(t))
            t = np.clip(t, first + beside, last - beside)
        both = C @ w + D @ checked_input(robot, road, v, t)
        return both[:2], both[2:]

    return springs


def _leg(gfunc, v, gaps_and_forces, noise, pressing, w, t, stop, max_step):
    """Integrate to the next switch: when, the motion until then (None if at once), which wheels."""
    solver = DOP853(lambda t, w: gfunc(w, t, v)[0], t, w, stop, max_step=max_step, **TOLERANCES)
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
    raise RuntimeError(
        f"road is too rough to integrate at t = {solver.t:g} s: smooth it, or if it has kinks "
        "there, name their places in an attribute of it, road.kinks"
    )


def _first_switch(gaps_and_forces, noise, pressing, a, b):
    """Return the first switch in [a, b], b if none, and which wheels switch then, bool (2,)."""

    def turned(t, i):
        f = gaps_and_forces(t)[1][i]
        return f <= 0 if pressing[i] else f >= 0

    def touches(t, i):
        return gaps_and_forces(t)[0][i] <= 0

    edges = np.array([a, *_edges(lambda t: gaps_and_forces(t)[1], a, b), b])
    edges = edges[np.diff(edges, prepend=-np.inf) > SHORTEST]
    before = a
    for left, right in pairwise(edges.tolist()):
        middle = (left + right) / 2
        pushes = gaps_and_forces(middle)[1] > np.where(pressing, -noise, noise)
        in_reach = gaps_and_forces(right)[0] <= 0
        times = np.full(2, np.inf)
        for i in np.flatnonzero((pushes != pressing) & (pressing | in_reach)):
            # Between two middles f changes its sign once: at a zero, or in a jump.
            times[i] = _first_time(turned, i, before, middle)
            if not pressing[i]:
                times[i] = _first_time(touches, i, times[i], right)
        if times.min() < np.inf:
            return float(times.min()), times < times.min() + SHORTEST
        before = middle
    return b, np.zeros(2, dtype=bool)


def _first_time(happened, i, low, high):
    """The first time in [low, high], s, at which ``happened(t, i)``, which holds at `high`."""
    if happened(low, i):
        return low
    while low < (middle := (low + high) / 2) < high:
        low, high = (low, middle) if happened(middle, i) else (middle, high)
    return high


def _edges(f, a, b, halvings=5):
    """Sorted times in (a, b) between which no component of f changes its sign twice.

    f is a callable of t: (n,) -> (m, n). They are its zeros, the roots of Chebyshev interpolants,
    eigenvalues of a matrix: two close zeros are found like any other. Where an interpolant has not
    converged (a kink), the interval is halved, and its middle is one of them too.
    """
    middle, half = (a + b) / 2, (b - a) / 2
    series = chebyshev.chebinterpolate(lambda s: f(middle + half * s).T, DEGREE).T
    size = np.abs(series)
    converged = (size[:, -2:].max(axis=1) <= 1e-10 * size.max(axis=1)).all()
    if halvings and not converged:
        return [*_edges(f, a, middle, halvings - 1), middle, *_edges(f, middle, b, halvings - 1)]
    zeros = []
    for coefficients in series:
        if np.abs(coefficients[1:]).sum() < abs(coefficients[0]):
            continue  # too far from zero to reach it
        z = chebyshev.chebroots(coefficients)
        zeros += (middle + half * z.real[(np.abs(z.imag) < 1e-6) & (np.abs(z.real) < 1)]).tolist()
    return sorted(zeros)
