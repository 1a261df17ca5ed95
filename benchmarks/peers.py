"""What one would otherwise pick to drive the robot over the bump, used as its documentation says.

Each function makes a callable ``run() -> N`` that computes the states and both normal forces, of
shape (2, J+1), at the times T; all that needs doing once per program is done beforehand.
"""

import math

import control
import diffrax
import jax
import jax.numpy as jnp
import numpy as np
from numba import njit
from scipy import integrate, signal

from suspension import course
from suspension.contact import normal_forces
from suspension.exact import over_bump
from suspension.road import road_input
from suspension.schemes import RK4
from suspension.simulation import simulate

jax.config.update("jax_enable_x64", True)


def package(robot, bump, v, T):
    """`simulate` with RK4, the default."""
    dt, tfinal = T[1], T[-1]
    return lambda: simulate(robot, bump, v=v, dt=dt, tfinal=tfinal).N


def closed_form(robot, bump, v, T):
    """`exact.over_bump` at the times T, and the forces."""
    return lambda: normal_forces(robot, bump, v, T, over_bump(robot, bump, v, T))


def textbook(robot, bump, v, T):
    """The course's RK4 loop."""
    gfunc, rest = course.make_gfunc(robot, bump), robot.equilibrium

    def run():
        W, times = course.RK4(gfunc, rest, T[1], T[-1], v)
        return normal_forces(robot, bump, v, times, W)

    return run


def textbook_implicit(robot, bump, v, T):
    """The course's Crank-Nicolson loop."""
    F, rest = course.make_forcing(robot, bump, v), robot.equilibrium

    def run():
        W, times = course.crank_nicolson(robot.A, F, rest, T[1], T[-1])
        return normal_forces(robot, bump, v, times, W)

    return run


def _system(robot):
    """States and forces as the outputs of a linear system about the equilibrium."""
    C = np.vstack([np.eye(4), robot.C])
    D = np.vstack([np.zeros((4, 4)), robot.D])
    return (robot.A, robot.B, C, D), (robot.C @ robot.equilibrium)[:, None]


def lsim(robot, bump, v, T):
    """`scipy.signal.lsim`, the input linear between the samples."""
    system, rest = _system(robot)
    system = signal.StateSpace(*system)

    def run():
        u = road_input(robot, bump, v, T)
        return signal.lsim(system, u.T, T)[1].T[4:] + rest

    return run


def dlsim(robot, bump, v, T):
    """`scipy.signal.dlsim` on `cont2discrete` with a first-order hold."""
    system, rest = _system(robot)

    def run():
        discrete = signal.cont2discrete(system, T[1], method="foh")
        u = road_input(robot, bump, v, T)
        return signal.dlsim(discrete, u.T)[1].T[4:] + rest

    return run


def forced_response(robot, bump, v, T):
    """`control.forced_response`, the input linear between the samples."""
    system, rest = _system(robot)
    system = control.ss(*system)

    def run():
        u = road_input(robot, bump, v, T)
        return control.forced_response(system, T, u).outputs[4:] + rest

    return run


def adaptive(method, rtol=1e-8):
    """`scipy.integrate.solve_ivp`; no step may leap over the bump."""

    def make(robot, bump, v, T):
        A, B, e = robot.A, robot.B, robot.e
        jacobian = {"jac": A} if method == "Radau" else {}
        if method == "LSODA":
            jacobian = {"jac": lambda t, w: A}

        def rate(t, w):
            return A @ w + B @ road_input(robot, bump, v, t) + e

        def run():
            W = integrate.solve_ivp(
                rate,
                (0, T[-1]),
                robot.equilibrium,
                method=method,
                t_eval=T,
                rtol=rtol,
                atol=rtol * 1e-2,
                max_step=2 * bump.sigma / v,
                **jacobian,
            ).y
            return normal_forces(robot, bump, v, T, W)

        return run

    return make


def on_a_ground_that_pushes(robot, bump, v, distance, rtol=1e-6):
    """Largest vertical acceleration, m/s^2: the footnote as a force law, by `solve_ivp`."""
    arms, time = robot.arms, distance / v
    k, c = np.array([robot.k1, robot.k2]), np.array([robot.c1, robot.c2])

    def forces(t, w):
        H, dHdx = bump(v * t + arms)
        p, rate = H - w[0] - arms * w[2], v * dHdx - w[1] - arms * w[3]
        return np.where(p >= 0, np.maximum(0, k * p + c * rate), 0)

    def motion(t, w):
        N = forces(t, w)
        return [w[1], N.sum() / robot.m - robot.g, w[3], arms @ N / robot.Izz]

    T = np.linspace(0, time, 2501)
    W = integrate.solve_ivp(
        motion,
        (0, time),
        robot.equilibrium,
        t_eval=T,
        rtol=rtol,
        atol=rtol * 1e-2,
        max_step=bump.sigma / v,
    ).y
    total = np.array([forces(t, w).sum() for t, w in zip(T, W.T)])
    return np.abs(total / robot.m - robot.g).max()


def tsit5(rtol=1e-8):
    """`diffrax.diffeqsolve` with Tsit5, compiled."""

    def make(robot, bump, v, T):
        A, B, C, D, e = (jnp.asarray(getattr(robot, name)) for name in "ABCDe")
        L = jnp.array([-robot.L1, robot.L2])

        def road(t):
            s = (v * t + L - bump.centre) / bump.sigma
            H = bump.height * jnp.exp(-0.5 * s * s)
            return jnp.concatenate([H, -v * s / bump.sigma * H])

        @jax.jit
        def solve(w0, T):
            W = diffrax.diffeqsolve(
                diffrax.ODETerm(lambda t, w, args: A @ w + B @ road(t) + e),
                diffrax.Tsit5(),
                t0=0.0,
                t1=T[-1],
                dt0=1e-3,
                y0=w0,
                saveat=diffrax.SaveAt(ts=T),
                max_steps=10**6,
                stepsize_controller=diffrax.PIDController(
                    rtol=rtol, atol=rtol * 1e-2, dtmax=2 * bump.sigma / v
                ),
            ).ys
            return W.T, C @ W.T + D @ jax.vmap(road)(T).T

        w0, times = jnp.asarray(robot.equilibrium), jnp.asarray(T)
        return lambda: np.asarray(jax.block_until_ready(solve(w0, times))[1])

    return make


@njit
def _road(v, t, L1, L2, height, sigma, centre, u):
    for i in range(2):
        s = (v * t + (L2 if i else -L1) - centre) / sigma
        u[i] = height * math.exp(-0.5 * s * s)
        u[i + 2] = -v * s / sigma * u[i]


@njit
def _rate(A, B, w, u, out):
    for i in range(4):
        out[i] = 0.0
        for j in range(4):
            out[i] += A[i, j] * w[j] + B[i, j] * u[j]


@njit
def _record(C, D, rest, w, u, n, W, N):
    for i in range(4):
        W[i, n] = w[i] + rest[i]
    for i in range(2):
        N[i, n] = 0.0
        for j in range(4):
            N[i, n] += C[i, j] * W[j, n] + D[i, j] * u[j]


@njit
def _stages(A, B, C, D, rest, v, dt, J, *bump):
    """RK4 as the textbook has it, about the equilibrium."""
    T, W, N = np.empty(J + 1), np.empty((4, J + 1)), np.empty((2, J + 1))
    w, z = np.zeros(4), np.empty(4)
    u0, u1, u2 = np.empty(4), np.empty(4), np.empty(4)
    g1, g2, g3, g4 = np.empty(4), np.empty(4), np.empty(4), np.empty(4)
    _road(v, 0.0, *bump, u0)
    for n in range(J + 1):
        T[n] = n * dt
        _record(C, D, rest, w, u0, n, W, N)
        _road(v, T[n] + dt / 2, *bump, u1)
        _road(v, T[n] + dt, *bump, u2)
        _rate(A, B, w, u0, g1)
        for i in range(4):
            z[i] = w[i] + dt / 2 * g1[i]
        _rate(A, B, z, u1, g2)
        for i in range(4):
            z[i] = w[i] + dt / 2 * g2[i]
        _rate(A, B, z, u1, g3)
        for i in range(4):
            z[i] = w[i] + dt * g3[i]
        _rate(A, B, z, u2, g4)
        for i in range(4):
            w[i] += dt / 6 * (g1[i] + 2 * g2[i] + 2 * g3[i] + g4[i])
            u0[i] = u2[i]
    return T, W, N


@njit
def _recurrence(R, H0, H1, H2, C, D, rest, v, dt, J, *bump):
    """The same steps as the affine recurrence that they are."""
    T, W, N = np.empty(J + 1), np.empty((4, J + 1)), np.empty((2, J + 1))
    w, z = np.zeros(4), np.empty(4)
    u0, u1, u2 = np.empty(4), np.empty(4), np.empty(4)
    _road(v, 0.0, *bump, u0)
    for n in range(J + 1):
        T[n] = n * dt
        _record(C, D, rest, w, u0, n, W, N)
        _road(v, T[n] + dt / 2, *bump, u1)
        _road(v, T[n] + dt, *bump, u2)
        for i in range(4):
            z[i] = 0.0
            for j in range(4):
                z[i] += R[i, j] * w[j] + H0[i, j] * u0[j] + H1[i, j] * u1[j] + H2[i, j] * u2[j]
        for i in range(4):
            w[i], u0[i] = z[i], u2[i]
    return T, W, N


def _bump(robot, bump):
    return robot.L1, robot.L2, bump.height, bump.sigma, bump.centre


def numba_stages(robot, bump, v, T):
    """The textbook's RK4 loop, compiled by Numba."""
    matrices = robot.A, robot.B, robot.C, robot.D, robot.equilibrium
    return lambda: _stages(*matrices, v, T[1], len(T) - 1, *_bump(robot, bump))[2]


def numba_recurrence(robot, bump, v, T):
    """The recurrence with precomputed matrices, compiled by Numba."""
    R, G = RK4.one_step(robot.A, T[1])
    H = [G[c == RK4.c].sum(axis=0) @ robot.B for c in (0, 0.5, 1)]
    matrices = R, *H, robot.C, robot.D, robot.equilibrium
    return lambda: _recurrence(*matrices, v, T[1], len(T) - 1, *_bump(robot, bump))[2]
