"""Wheels that weigh something, on tyres that only push: is the massless wheel of the book true?

Each wheel gets a mass, and a tyre between itself and the road. With ``y_i`` for the height of a
wheel above that on an unloaded tyre on level ground, spring and damper press it down with
``f_i = k_i (y_i - Y_i) + c_i (y_i' - Y_i')``, the tyre lifts it with

``N_i = max(0, kt (h_i - y_i) + ct (h_i' - y_i'))`` while ``y_i < h_i``, else 0,

and ``mass y_i'' = N_i - f_i - mass g``. The body feels f_i, the road N_i. A wheel without mass on a
rigid tyre has ``y_i = h_i`` and ``N_i = f_i``: the model of the book.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import OdeSolution, Radau
from scipy.optimize import brentq, minimize_scalar

from suspension import _checks
from suspension.exact import Crossing
from suspension.least_force import exact_forces, turning_points
from suspension.road import checked_input, road_input
from suspension.robot import Robot

__all__ = ["Rolling", "Tyre", "heaviest_wheel", "roll"]

MAX_STEPS = 10**5  # of the integrator: half a minute
MAX_SAMPLES = 10**6
LOOKS = np.linspace(0, 1, 9)  # where a step is searched for a switch, in parts of it


@dataclass(frozen=True)
class Tyre:
    """A wheel pair and what it rolls on.

    Parameters
    ----------
    mass : float
        Of the wheel pair, kg, > 0.
    stiffness : float
        Of the tyres, kt, N/m, > 0.
    damping : float
        Of the tyres, ct, N s/m, >= 0.

    Raises
    ------
    ValueError
        If a parameter is out of its range.
    """

    mass: float
    stiffness: float
    damping: float = 0.0

    def __post_init__(self):
        for name in ("mass", "stiffness"):
            object.__setattr__(self, name, _checks.positive(name, getattr(self, name)))
        object.__setattr__(self, "damping", _checks.nonnegative("damping", self.damping))

    @classmethod
    def with_ratio(cls, mass, stiffness, ratio):
        """The tyre on which the wheel alone would bounce with this damping ratio.

        Parameters
        ----------
        mass, stiffness : float
            As for the class, kg and N/m, > 0.
        ratio : float
            Damping over the critical one, ``ct / (2 sqrt(kt mass))``, >= 0.

        Raises
        ------
        ValueError
            If an argument is out of its range, or the damping no finite number.
        """
        mass, stiffness = _checks.positive("mass", mass), _checks.positive("stiffness", stiffness)
        ratio = _checks.nonnegative("ratio", ratio)
        return cls(mass, stiffness, 2 * ratio * np.sqrt(mass * stiffness))


@dataclass(frozen=True, eq=False)
class Rolling:
    """A computed run on tyres.

    Attributes
    ----------
    T : ndarray, shape (J+1,)
        Times, s, equally spaced.
    W : ndarray, shape (8, J+1)
        States ``[Y, Y', theta, theta', y1, y2, y1', y2']``: the body, then both wheels.
    N, gaps : ndarray, shape (2, J+1)
        Forces of the tyres on the wheels, N, and heights of the tyres above the ground, m.
    flights : tuple of (wheel, start, end)
        Every time in which wheel 1 (rear) or 2 (front) bears no force, from when to when, s.
    v : float
        Speed, m/s.
    """

    T: np.ndarray
    W: np.ndarray
    N: np.ndarray
    gaps: np.ndarray
    flights: tuple
    v: float

    @property
    def airtime(self):
        """How long each wheel bears no force, s, shape (2,)."""
        times = np.zeros(2)
        for wheel, start, end in self.flights:
            times[wheel - 1] += end - start
        return times

    @property
    def loss(self):
        """The first loss of contact, (wheel, s), or None."""
        return min(((w, start) for w, start, _ in self.flights), key=lambda f: f[1], default=None)


def roll(robot, road, tyre, *, v, tfinal, samples=2001, resolution=None, rtol=1e-8):
    """Drive over a road on wheels with mass, from rest.

    The equations are stiff, piecewise linear and continuous, but for the jump of a tyre's damper at
    touch-down: SciPy's `Radau`, of order five, follows them, and the times at which a tyre's force
    comes and goes are found in its dense output.

    Parameters
    ----------
    robot : Robot
    road : callable
        ``road(x) -> (H, dHdx)``.
    tyre : Tyre
        Of both wheel pairs.
    v, tfinal : float
        Speed, m/s, and final time, s, > 0.
    samples : int
        Number of equally spaced times in the result, >= 2.
    resolution : float, optional
        Size of the road's smallest feature, m, > 0; by default its `sigma` if any, else 1 mm.
    rtol : float
        Relative tolerance of the integrator; its absolute one is a thousandth of it, m and rad.

    Returns
    -------
    Rolling

    Raises
    ------
    ValueError
        If an argument is out of its range, or the run needs more than 10^5 steps: then a softer or
        more damped tyre, a shorter time or a larger `rtol` will do.
    """
    _checks.instance("robot", robot, Robot)
    _checks.instance("tyre", tyre, Tyre)
    v, tfinal = _checks.positive("v", v), _checks.positive("tfinal", tfinal)
    samples = _checks.whole("samples", samples, 2)
    if samples > MAX_SAMPLES:
        raise ValueError(f"samples must be at most {MAX_SAMPLES}, got {samples}")
    rtol = _checks.interval("rtol", rtol, 1e-13, 1e-2)
    resolution = getattr(road, "sigma", 1e-3) if resolution is None else resolution
    max_step = 0.5 * _checks.positive("resolution", resolution) / v
    if tfinal / max_step > MAX_STEPS:
        raise ValueError(
            f"tfinal must take at most {MAX_STEPS} steps of half of resolution, "
            f"got tfinal={tfinal:g} and resolution={resolution:g} at v={v:g}"
        )
    road_input(robot, road, v, tfinal * np.array([0.25, 0.75]))  # answers in arrays
    model = _Model(robot, road, tyre, v)
    z0 = model.rest()
    solver = Radau(
        model.rate, 0.0, z0, tfinal, max_step=max_step, rtol=rtol, atol=rtol / 1000, jac=model.slope
    )
    times, pieces = [0.0], []
    lifted = [None, None]  # since when each wheel is in the air
    for i in np.flatnonzero(model.presses(0.0, z0) <= 0):
        lifted[i] = 0.0
    flights = []
    while solver.status == "running":
        if len(pieces) == MAX_STEPS:
            raise ValueError(
                f"tfinal must take at most {MAX_STEPS} steps on this tyre, got {solver.t:g} s of "
                f"{tfinal:g} s: a softer or more damped tyre, a shorter time or a larger rtol do"
            )
        message = solver.step()
        if solver.status == "failed":
            raise RuntimeError(f"road is too rough to integrate at t = {solver.t:g} s: {message}")
        piece = solver.dense_output()
        times.append(solver.t)
        pieces.append(piece)
        for t, i in _switches(model, piece, solver.t_old, solver.t):
            if lifted[i] is None:
                lifted[i] = t
            else:
                flights.append((i + 1, lifted[i], t))
                lifted[i] = None
    flights += [(i + 1, t, tfinal) for i, t in enumerate(lifted) if t is not None]
    T = np.linspace(0, tfinal, samples)
    W = OdeSolution(times, pieces)(T)
    q, force = model.tyres(T, W)
    N = np.where(q > 0, np.maximum(force, 0), 0)
    flights.sort(key=lambda flight: flight[1])
    return Rolling(T, W, N, np.maximum(-q, 0), tuple(flights), v)


def _switches(model, piece, start, end):
    """When a tyre's force comes or goes in one step, and which wheel, 0 or 1, in order."""
    t = start + LOOKS * (end - start)
    sign = model.presses(t, piece(t)) > 0
    found = []
    for i, j in zip(*np.nonzero(sign[:, 1:] != sign[:, :-1])):

        def presses(s, i=i):
            return model.presses(s, piece(s))[i]

        found.append((brentq(presses, t[j], t[j + 1], xtol=1e-15), int(i)))
    return sorted(found)


class _Model:
    """The equations of motion of body and wheels, for states like those of `Rolling`."""

    def __init__(self, robot, road, tyre, v):
        self.robot, self.road, self.tyre, self.v = robot, road, tyre, v
        still, one, wheels = np.zeros(2), np.ones(2), np.eye(2)
        ends = np.column_stack([one, still, robot.arms, still])
        rates = np.column_stack([still, one, still, robot.arms])
        compression = np.hstack([-ends, wheels, 0 * wheels])
        self.spring = robot.k[:, None] * compression
        self.spring += robot.c[:, None] * np.hstack([-rates, 0 * wheels, wheels])
        self.free = np.zeros((8, 8))  # the Jacobian without any tyre
        self.free[:4, :4] = robot.S
        self.free[:4] += robot.P @ self.spring
        self.free[[4, 5], [6, 7]] = 1
        self.free[6:] = -self.spring / tyre.mass

    def rest(self):
        """The state at rest on level ground, shape (8,)."""
        robot, tyre = self.robot, self.tyre
        load = robot.C @ robot.equilibrium
        y = -(load + tyre.mass * robot.g) / tyre.stiffness
        ends = y - load / robot.k
        span = robot.L1 + robot.L2
        middle = (robot.L2 * ends[0] + robot.L1 * ends[1]) / span
        return np.array([middle, 0, (ends[1] - ends[0]) / span, 0, *y, 0, 0])

    def tyres(self, t, z):
        """How far tyres are pressed in, m, and what spring and damper of them give, N."""
        u = checked_input(self.robot, self.road, self.v, t)
        q = u[:2] - z[4:6]
        return q, self.tyre.stiffness * q + self.tyre.damping * (u[2:] - z[6:8])

    def presses(self, t, z):
        """Positive while a tyre presses on the ground, and continuous: N, shape (2,) or (2, n)."""
        q, force = self.tyres(t, z)
        return np.minimum(self.tyre.stiffness * q, force)

    def rate(self, t, z):
        """dz/dt, shape (8,)."""
        robot, mass = self.robot, self.tyre.mass
        q, force = self.tyres(t, z)
        N, f = np.where(q > 0, np.maximum(force, 0), 0), self.spring @ z
        body = robot.S @ z[:4] + robot.P @ f + robot.e
        return np.concatenate([body, z[6:8], (N - f) / mass - robot.g])

    def slope(self, t, z):
        """The Jacobian of `rate`, shape (8, 8)."""
        tyre, J = self.tyre, self.free.copy()
        on = np.diag((self.presses(t, z) > 0).astype(float))
        J[6:, 4:6] -= on * tyre.stiffness / tyre.mass
        J[6:, 6:] -= on * tyre.damping / tyre.mass
        return J


def heaviest_wheel(robot, bump, v, *, distance=None):
    """The mass at which a wheel on a rigid tyre just keeps contact over the bump.

    A wheel that stays on the ground moves as the road does, whatever it weighs, and the body does
    not notice. The road has to carry it: ``N_i = f_i + mass (g + h_i'')``, with f_i the force of
    the wheel without mass. Where the road falls away faster than gravity, ``g + h'' < 0``, mass
    lifts; so the verdict turns at

    ``mass = min of f_i / -(g + h_i'')`` over both wheels and all such moments.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.
    distance : float, optional
        How far the run goes, m, as for `margin`.

    Returns
    -------
    mass : float
        Of a wheel pair, kg; 0 if even a wheel without mass leaves the ground, inf if the road
        nowhere falls away faster than gravity.

    Raises
    ------
    ValueError
        As `suspension.margin` does.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> [round(heaviest_wheel(Robot(800, 800), GaussianBump(), v), 4) for v in (0.25, 1.2, 10)]
    [inf, 0.0, 0.0082]
    """
    crossing = Crossing(robot, bump, _checks.positive("v", v))
    t, N = turning_points(crossing, distance=distance)
    if N.min() <= 0:
        return 0.0

    def ratio(t, i):
        """``-(g + h'') / f``: the inverse of the mass, whose largest value counts."""
        return -(robot.g + crossing.road(t, 2)[2][i]) / exact_forces(crossing, t)[0, i]

    largest = 0.0
    for i in (0, 1):
        values = ratio(t, i)
        for j in np.flatnonzero(
            (values > 0) & (values >= np.roll(values, 1)) & (values >= np.roll(values, -1))
        ):
            inside = minimize_scalar(
                lambda s, i=i: -ratio(np.array([s]), i)[0],
                bounds=(t[max(j - 1, 0)], t[min(j + 1, len(t) - 1)]),
                method="bounded",
                options={"xatol": 1e-10 * t[-1]},
            )
            largest = max(largest, values[j], -inside.fun)
    return float(1 / largest) if largest > 0 else np.inf
