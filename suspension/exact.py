"""Exact solutions to hold the integrators against: flat ground, and one Gaussian bump.

A mode of the robot answers a Gaussian bump with an error function of complex argument. With
``u`` the distance of a wheel from the top of the bump in units of ``sqrt(2) sigma``, the bump is
``exp(-u^2)`` and a mode goes like ``exp(kappa u)``, where ``kappa = sqrt(2) sigma lam / v``.
"""

import numpy as np
from scipy.special import wofz

from suspension import _checks
from suspension.road import GaussianBump

__all__ = ["Crossing", "E", "flat_ground", "over_bump"]

ILL_CONDITIONED = 30.0  # eigenvectors lose digits as the square of this
CIRCLE = 8  # points in a mean over a circle, whose error is at most about (1/80)^CIRCLE
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
        Times, s.

    Returns
    -------
    W : ndarray, shape (4, n) or (4,)

    Raises
    ------
    ValueError
        If the robot is not symmetric, or `w0` is not four finite numbers.
    """
    if (robot.k1, robot.c1, robot.L1) != (robot.k2, robot.c2, robot.L2):
        raise ValueError(
            "robot must be symmetric (k1 = k2, c1 = c2, L1 = L2), got "
            f"k1={robot.k1}, k2={robot.k2}, c1={robot.c1}, c2={robot.c2}, "
            f"L1={robot.L1}, L2={robot.L2}"
        )
    w0, t = _checks.array("w0", w0, (4,)), _checks.array("t", t)
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
    if abs(omega) < 1e-6 * beta:  # critical: sin(omega t) / omega -> t (1 - (omega t)^2 / 6)
        sine = np.exp(-beta * t) * t * (1 - (omega * t) ** 2 / 6)
    else:
        sine = (fast - slow) / (2j * omega)
    return ((fast + slow) / 2).real, sine.real


def over_bump(robot, bump, v, t, w0=None):
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
        If `bump` is not a GaussianBump, or another argument is out of its range.

    Examples
    --------
    >>> from suspension.robot import Robot
    >>> over_bump(Robot(800, 800), GaussianBump(), v=1.2, t=0.25).round(6)
    array([-0.006496, -0.555074, -0.058938, -5.662561])
    """
    return Crossing(robot, bump, v, w0)(t)


class Crossing:
    """The exact motion over a Gaussian bump as a function of time, ``W = Crossing(...)(t)``.

    What the dampers pass on directly is split off: ``y = w - w_eq - sum_i c_i P_i h_i`` obeys
    ``y' = A y + sum_i b_i h_i`` with ``b_i = k_i P_i + c_i A P_i``. There a mode with eigenvalue
    lam, of size a at the start, driven by ``g h``, is ``exp(lam t) (a - g M(0)) + g M(t)`` with
    the memory ``M = height sqrt(2) sigma / v sqrt(pi) / 2 E(u)`` of a mode that has come from
    infinitely far.

    Parameters
    ----------
    robot, bump, v, w0
        As for `over_bump`.

    Attributes
    ----------
    lam : ndarray of complex, shape (modes,)
        Eigenvalues, 1/s, one of each conjugate pair (or of the robots of `_modes`).
    start : ndarray, shape (2,)
        ``u`` at t = 0, rear and front wheel.
    rate : float
        ``du/dt = |v| / (sqrt(2) sigma)``, 1/s.
    """

    def __init__(self, robot, bump, v, w0=None):
        if not isinstance(bump, GaussianBump):
            raise ValueError(f"bump must be a GaussianBump, got {bump!r}")
        v = _checks.number("v", v)
        self.robot, self.bump, self.rest = robot, bump, robot.equilibrium
        w0 = self.rest if w0 is None else _checks.array("w0", w0, (4,))
        width = np.sqrt(2) * bump.sigma
        ahead = np.array([-robot.L1, robot.L2]) - bump.centre
        self.start, self.rate = np.copysign(1.0, v) * ahead / width, abs(v) / width
        self.lam, self.right, left = _modes(robot)
        self.direct = robot.P * [robot.c1, robot.c2]
        self.g = left @ (robot.P * [robot.k1, robot.k2] + robot.A @ self.direct)
        y0 = w0 - self.rest - self.direct @ self._heights(np.zeros(1))[0][:, 0]
        self.a = left @ y0 - np.sum(self.g * self._memory(np.zeros(1))[:, :, 0], axis=1)

    def __call__(self, t):
        """State at times `t`, s, shape (n,) or (): ndarray, shape (4, n) or (4,)."""
        t = _checks.array("t", t)
        if (t < 0).any():
            raise ValueError(f"t must be >= 0, got {t.min()}")
        return self._state(t.ravel()).reshape(4, *t.shape)

    def forces(self, t, order=0):
        """Normal forces and their time derivatives, ``N = C w + D u`` (Eq. 5).

        Parameters
        ----------
        t : ndarray, shape (n,)
            Times, s.
        order : int
            The highest derivative wanted; ``w' = A w + B u + e`` gives each from the one before.

        Returns
        -------
        N : ndarray, shape (order + 1, 2, n)
        """
        A, B, C, D = self.robot.A, self.robot.B, self.robot.C, self.robot.D
        w, h, N = self._state(t), self._heights(t, order + 1), []
        for n in range(order + 1):
            u = np.concatenate(h[n : n + 2])
            N.append(C @ w + D @ u)
            w = A @ w + B @ u + (self.robot.e[:, None] if n == 0 else 0.0)
        return np.array(N)

    def _state(self, t):
        q = self.a[:, None] * np.exp(self.lam[:, None] * t)
        q += np.einsum("mi,min->mn", self.g, self._memory(t))
        return self.rest[:, None] + self.direct @ self._heights(t)[0] + (self.right @ q).real

    def _heights(self, t, order=0):
        # The road under both wheels and its time derivatives (Hermite's recurrence).
        u, r = self.start[:, None] + self.rate * t, self.rate
        h = [self.bump.height * np.exp(-u * u)]
        for n in range(order):
            h.append(-2 * r * (u * h[n] + (n * r * h[n - 1] if n else 0.0)))
        return h

    def _memory(self, t):
        u, lam = self.start[:, None] + self.rate * t, self.lam[:, None, None]
        if self.rate < 1e-16 * np.abs(lam).min():  # so slow that the ground is level: M = -h / lam
            return -self.bump.height * np.exp(-u * u) / lam
        return self.bump.height * np.sqrt(np.pi) / (2 * self.rate) * E(u, lam / self.rate)


def E(u, kappa):
    """What a mode remembers of the bump it has met up to u.

    ``E(u) = exp(-u^2) w(-i (u + kappa/2)) = 2 / sqrt(pi) int_{-inf}^u exp(kappa (u - s) - s^2) ds``
    with the Faddeeva function w. Bounded by 2 for a damped mode, and computed so: where w grows,
    its reflection ``w(-z) = 2 exp(-z^2) - w(z)`` is used instead.

    Parameters
    ----------
    u : array_like
        Distance from the top of the bump, in ``sqrt(2) sigma``.
    kappa : array_like of complex
        ``sqrt(2) sigma lam / v``, of a shape that broadcasts with `u`.

    Returns
    -------
    E : ndarray of complex
    """
    u, kappa = np.broadcast_arrays(u, kappa)
    E = np.zeros(u.shape, dtype=complex)
    past = u + kappa.real / 2 > 0
    near = u * u < FAR
    side = np.where(past, -1.0, 1.0)[near]
    E[near] = side * np.exp(-(u[near] ** 2)) * wofz(-1j * side * (u + kappa / 2)[near])
    E[past] += 2 * np.exp((kappa * (u + kappa / 4))[past])
    return E


def _modes(robot):
    """A as modes: ``f(A) b = Re sum_m right[:, m] f(lam[m]) (left[m] @ b)`` for f entire and real.

    Where modes nearly coincide (critical damping) their eigenvectors do too, and the sum cancels.
    But f(A) is an entire function of the stiffness, hence its mean over a circle of complex
    stiffnesses around the real one, and there the modes are apart.

    Returns
    -------
    lam : ndarray of complex, shape (modes,)
    right : ndarray of complex, shape (4, modes)
    left : ndarray of complex, shape (modes, 4)
    """
    A = robot.A
    lam, right = np.linalg.eig(A)
    left = np.linalg.inv(right)
    # The spectral radius is the condition number in the best units of the state (Bauer).
    if np.abs(np.linalg.eigvals(np.abs(right) @ np.abs(left))).max() < ILL_CONDITIONED:
        half = lam.imag >= 0
        return lam[half], right[:, half] * np.where(lam[half].imag > 0, 2, 1), left[half]
    # Small against the damping, or exp(lam t) would vary too much along the circle.
    radius = np.clip((-lam.real / np.abs(lam)).min() / 40, 1e-5, 1e-2)
    angle = np.pi * (2 * np.arange(CIRCLE // 2) + 1) / CIRCLE  # the lower half mirrors the upper
    springs = robot.P @ (robot.C * [[1, 0, 1, 0], [0.5, 0, 0.5, 0]])  # unequal: no mode is spared
    lam, right = np.linalg.eig(A + radius * np.exp(1j * angle)[:, None, None] * springs)
    left = np.linalg.inv(right)
    return lam.ravel(), np.hstack(list(right)) * (2 / CIRCLE), left.reshape(-1, 4)
