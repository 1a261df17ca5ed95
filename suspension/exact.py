"""Exact solutions to hold the integrators against: flat ground, and one Gaussian bump.

A mode of the robot answers a Gaussian bump with an error function of complex argument. With
``xi`` the distance of a wheel from the top of the bump in units of ``sqrt(2) sigma``, the bump is
``exp(-xi^2)`` and a mode goes like ``exp(kappa xi)``, where ``kappa = sqrt(2) sigma lam / |v|``.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import wofz

from suspension import _checks
from suspension.road import GaussianBump
from suspension.robot import Robot

__all__ = ["Crossing", "bump_memory", "flat_ground", "modes", "over_bump", "times"]

ILL_CONDITIONED = 30.0  # eigenvectors lose digits as the square of this
CIRCLE = 8  # points in a mean over a circle, whose error is about (1/40)^CIRCLE
FAR = 40.0  # exp(-FAR) is below roundoff beside 1


def flat_ground(robot, w0, t):
    """Free motion of a symmetric robot on flat ground, in closed form (Eq. 7).

    Heave and pitch are two damped oscillators that do not feel each other. Overdamped and
    critically damped robots are included: the frequency of Eq. 7 may be imaginary or zero.

    Parameters
    ----------
    robot : Robot
        With k1 = k2, c1 = c2 and L1 = L2.
    w0 : array_like, shape (4,)
        State at t = 0, ``[Y, Y', theta, theta']`` in m, m/s, rad, rad/s.
    t : array_like, shape (n,) or ()
        Times, s, >= 0.

    Returns
    -------
    W : ndarray, shape (4, n) or (4,)

    Raises
    ------
    ValueError
        If the robot is not symmetric, or `w0` or `t` is not finite or out of its range.
    """
    _checks.instance("robot", robot, Robot)
    if (robot.k1, robot.c1, robot.L1) != (robot.k2, robot.c2, robot.L2):
        raise ValueError(
            "robot must be symmetric (k1 = k2, c1 = c2, L1 = L2), got "
            f"k1={robot.k1}, k2={robot.k2}, c1={robot.c1}, c2={robot.c2}, "
            f"L1={robot.L1}, L2={robot.L2}"
        )
    w0, t = _checks.array("w0", w0, (4,)), times(t)
    Y_eq = robot.equilibrium[0]
    inertia = {0: robot.m, 2: robot.Izz / robot.L1**2}  # heave; pitch, as a mass at the wheels
    W = np.empty((4, *t.shape))
    for i, mass in inertia.items():
        beta, omega0_squared = robot.c1 / mass, 2 * robot.k1 / mass
        y0 = w0[i] - (Y_eq if i == 0 else 0.0)
        cosine, sine = _decaying_cosine_and_sine(beta, omega0_squared, t)
        W[i] = w0[i] - y0 + y0 * cosine + (beta * y0 + w0[i + 1]) * sine
        W[i + 1] = w0[i + 1] * cosine - (beta * w0[i + 1] + omega0_squared * y0) * sine
    return W


def _decaying_cosine_and_sine(beta, omega0_squared, t):
    """``exp(-beta t) cos(omega t)`` and ``exp(-beta t) sin(omega t) / omega``, any damping."""
    omega = np.sqrt(complex(omega0_squared - beta**2))
    slow, fast = np.exp((-beta - 1j * omega) * t), np.exp((-beta + 1j * omega) * t)
    # (fast - slow) / (2 i omega), without cancellation where the two nearly coincide
    sine = slow * (np.expm1(2j * omega * t) / (2j * omega) if omega else t)
    return ((fast + slow) / 2).real, sine.real


def over_bump(
    robot: Robot, bump: GaussianBump, v: float, t: ArrayLike, w0: ArrayLike | None = None
) -> np.ndarray:
    """The state of a robot that crosses a Gaussian bump, in closed form.

    Any robot: unsymmetric, undamped, overdamped, at or near critical damping (see `Crossing`).

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s; at 0 the robot stands where it is, below 0 it drives backwards.
    t : array_like, shape (n,) or ()
        Times, s, >= 0.
    w0 : array_like, shape (4,), optional
        State at t = 0; the equilibrium on flat ground if not given.

    Returns
    -------
    W : ndarray, shape (4, n) or (4,)

    Raises
    ------
    ValueError
        If an argument is out of its range, or so extreme that the motion overflows.
    TypeError
        If `robot` is not a Robot, or `bump` not a GaussianBump.

    Examples
    --------
    >>> from suspension.robot import Robot
    >>> over_bump(Robot(800, 800), GaussianBump(), v=1.2, t=0.25).round(6)
    array([-0.006496, -0.555074, -0.058938, -5.662561])
    """
    crossing = Crossing(robot, bump, v, w0)
    with np.errstate(over="ignore", invalid="ignore"):
        W = crossing(t)
    if not np.isfinite(W).all():
        raise ValueError(
            "robot and bump must be so moderate that double precision can tell the motion, "
            f"got {robot} and {bump} at v = {crossing.v:g} m/s"
        )
    return W


class Crossing:
    """The motion over a Gaussian bump as a function of time, ``W = Crossing(...)(t)``.

    What the dampers pass on at once is split off: ``y = w - w_eq - sum_i c_i P_i h_i`` obeys
    ``y' = A y + sum_i b_i h_i`` with ``b_i = k_i P_i + c_i A P_i``. There a mode with eigenvalue
    lam, driven by ``gain h``, is ``q(t) = exp(lam t) (q(0) - gain memory(0)) + gain memory(t)``,
    where ``memory = height sqrt(pi) sigma / (sqrt(2) |v|) bump_memory(xi)`` is what the mode
    remembers of the bump, from infinitely far.

    Parameters and errors are those of `over_bump`, but a motion that overflows is not refused.

    Attributes
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s.
    lam : ndarray of complex, shape (modes,)
        Eigenvalues, 1/s, one of each conjugate pair (or those on the circle of `modes`).
    start : ndarray, shape (2,)
        ``xi`` at t = 0, rear and front wheel, counted along the way of travel.
    rate : float
        ``dxi/dt = |v| / (sqrt(2) sigma)``, 1/s.
    """

    @np.errstate(over="ignore", invalid="ignore")  # extremes show in the motion, and in `roundoff`
    def __init__(self, robot, bump, v, w0=None):
        _checks.instance("robot", robot, Robot)
        _checks.instance("bump", bump, GaussianBump)
        self.robot, self.bump, self.v = robot, bump, _checks.number("v", v)
        w0 = robot.equilibrium if w0 is None else _checks.array("w0", w0, (4,))
        width = np.sqrt(2) * bump.sigma
        self.start = np.copysign(1.0, self.v) * (robot.arms - bump.centre) / width
        self.rate = abs(self.v) / width
        self.lam, self.right, left = modes(robot)
        self.direct = robot.P * robot.c
        self.gain = left @ (robot.P * robot.k + robot.A @ self.direct)
        start = np.zeros(1)
        y0 = w0 - robot.equilibrium - self.direct @ self.road(start)[0][:, 0]
        self.free = left @ y0 - np.sum(self.gain * self.memory(start)[:, :, 0], axis=1)

    def __call__(self, t):
        """State at times `t` >= 0, s, of shape (n,) or (): ndarray, shape (4, n) or (4,)."""
        t = times(t)
        s = t.ravel()
        return self.state(s, self.road(s)[0], self.memory(s)).reshape(4, *t.shape)

    def state(self, t, h, memory):
        """State at times `t`, shape (4, n), from the heights (2, n) and what the modes remember."""
        q = self.free[:, None] * np.exp(self.lam[:, None] * t)
        q += np.einsum("mi,min->mn", self.gain, memory)
        return self.robot.equilibrium[:, None] + (self.direct @ h + (self.right @ q).real)

    def road(self, t, order=0):
        """Height under both wheels and its time derivatives: a list of ndarrays, shape (2, n)."""
        xi = self.start[:, None] + self.rate * t
        h = [self.bump.height * np.exp(-xi * xi)]
        if order > 0:
            h.append(-2 * self.rate * xi * h[0])
        for n in range(1, order):  # Hermite's recurrence
            h.append(-2 * self.rate * (xi * h[n] + n * self.rate * h[n - 1]))
        return h

    def memory(self, t):
        """What each mode remembers of the bump under each wheel, shape (modes, 2, n), complex."""
        xi, lam = self.start[:, None] + self.rate * t, self.lam[:, None, None]
        if self.rate < 1e-16 * np.abs(lam).min():  # so slow that the ground is level
            return -self.bump.height * np.exp(-xi * xi) / lam
        scale = self.bump.height * np.sqrt(np.pi) / (2 * self.rate)
        return scale * bump_memory(xi, lam / self.rate)


def times(t):
    """Return `t` as an array of finite numbers >= 0.

    Raises
    ------
    ValueError
        If a time is negative or not finite.
    """
    t = _checks.array("t", t)
    if (t < 0).any():
        raise ValueError(f"t must be >= 0, got {t.min()}")
    return t


def bump_memory(xi, kappa):
    """What a mode remembers of the bump: ``E(xi) = exp(-xi^2) w(-i (xi + kappa/2))``.

    It is ``2 / sqrt(pi)`` times the integral of ``exp(kappa (xi - r) - r^2)`` over r up to xi,
    and at most 2 for a damped mode; w is the Faddeeva function (`scipy.special.wofz`). Where w is
    large, ``w(-z) = 2 exp(-z^2) - w(z)`` replaces it.

    Parameters
    ----------
    xi : array_like
        Distance from the top of the bump over ``sqrt(2) sigma``.
    kappa : array_like of complex
        ``sqrt(2) sigma lam / v``, of a shape that broadcasts with `xi`.

    Returns
    -------
    E : ndarray of complex
    """
    xi, kappa = np.asarray(xi), np.asarray(kappa)
    z = xi + kappa / 2
    past = z.real > 0
    side = np.where(past, -1.0, 1.0)
    near = np.broadcast_to(xi * xi < FAR, z.shape)
    memory = np.zeros(z.shape, dtype=complex)
    memory[near] = wofz(-1j * (side * z)[near])
    memory *= side * np.exp(-xi * xi)
    memory[past] += 2 * np.exp((kappa * (xi + kappa / 4))[past])
    return memory


@lru_cache(maxsize=32)
def modes(robot):
    """A as modes: ``f(A) b = Re sum_m right[:, m] f(lam[m]) (left[m] @ b)`` for f entire and real.

    Near critical damping the eigenvectors nearly coincide and the sum cancels. But f(A) is an
    entire function of the stiffness, hence its own mean over a circle of complex stiffnesses
    around the real one, and on the circle the modes are apart.

    Parameters
    ----------
    robot : Robot

    Returns
    -------
    lam : ndarray of complex, shape (modes,)
        1/s.
    right : ndarray of complex, shape (4, modes)
    left : ndarray of complex, shape (modes, 4)
    """
    A = robot.A
    lam, right = np.linalg.eig(A)
    if _condition(right) < ILL_CONDITIONED:
        half = lam.imag >= 0
        twice = np.where(lam[half].imag > 0, 2, 1)
        return _constant(lam[half], right[:, half] * twice, np.linalg.inv(right)[half])
    # Small against the damping, or exp(lam t) would vary too much along the circle.
    radius = max((-lam.real / np.abs(lam)).min() / 40, 1e-5)
    angle = np.pi * (2 * np.arange(CIRCLE // 2) + 1) / CIRCLE  # the lower half mirrors the upper
    springs = robot.P @ (robot.C * [[1, 0, 1, 0], [0.5, 0, 0.5, 0]])  # unequal: no mode is spared
    lam, right = np.linalg.eig(A + radius * np.exp(1j * angle)[:, None, None] * springs)
    left = np.linalg.inv(right)
    return _constant(lam.ravel(), np.hstack(list(right)) * (2 / CIRCLE), left.reshape(-1, 4))


def _constant(*arrays):
    for array in arrays:
        array.setflags(write=False)  # every crossing of this robot gets the same ones
    return arrays


def _condition(V):
    # In the units of the state that suit V best (Bauer); inf if singular.
    try:
        return np.abs(np.linalg.eigvals(np.abs(V) @ np.abs(np.linalg.inv(V)))).max()
    except np.linalg.LinAlgError:
        return np.inf
