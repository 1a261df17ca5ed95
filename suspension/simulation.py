"""Drive the robot over a road with a one-step method.

The motion is linear, so one step of any scheme is ``w_{n+1} = R w_n + b_n`` with a constant
matrix R. NumPy runs that recurrence a block of steps at a time.
"""

from dataclasses import dataclass

import numpy as np

from suspension import _checks
from suspension.contact import first_loss
from suspension.road import road_input
from suspension.schemes import RK4, Scheme

__all__ = ["Trajectory", "affine_scan", "simulate", "steps"]

MAX_STEPS = 10**8
CHUNK = 4096  # steps whose arrays stay in the processor's cache
BLOCK = 16  # steps that one matrix product takes at once


@dataclass(frozen=True, eq=False)
class Trajectory:
    """A computed run: what was asked for and what came out.

    Attributes
    ----------
    T : ndarray, shape (J+1,)
        Times ``t_n = n dt``, s.
    W : ndarray, shape (4, J+1)
        States ``[Y, Y', theta, theta']``.
    N : ndarray, shape (2, J+1)
        Normal forces, rear and front, N (Eq. 5).
    v, dt : float
        Speed, m/s, and time step, s.
    scheme : Scheme
    """

    T: np.ndarray
    W: np.ndarray
    N: np.ndarray
    v: float
    dt: float
    scheme: Scheme

    @property
    def loss(self):
        """First sample without contact: `suspension.contact.Loss`, or None."""
        return first_loss(self.T, self.N)

    @property
    def X(self):
        """Position of the centre of mass, m (Eq. 1), shape (J+1,)."""
        return self.v * self.T


def simulate(robot, road, *, v, dt, tfinal, scheme=RK4, w0=None):
    """Integrate ``w' = A w + B u(t) + e`` (Eqs. 1 to 6) from t = 0.

    Parameters
    ----------
    robot : Robot
    road : callable
        ``road(x) -> (H, dHdx)``, arrays in, arrays out.
    v : float
        Speed, m/s.
    dt : float
        Time step, s, > 0; used as given, so the last time may lie beyond `tfinal`.
    tfinal : float
        Final time, s, > 0; the run takes ``ceil(tfinal / dt)`` steps.
    scheme : Scheme
        The one-step method.
    w0 : array_like, shape (4,), optional
        State at t = 0; the equilibrium on flat ground if not given.

    Returns
    -------
    Trajectory

    Raises
    ------
    ValueError
        If an argument is out of its range, or the run would take more than 10^8 steps.

    Notes
    -----
    An unstable run grows as the scheme says it does; past the largest float it is inf or nan.

    Examples
    --------
    >>> from suspension.road import FlatRoad
    >>> from suspension.robot import Robot
    >>> simulate(Robot(800, 800), FlatRoad(), v=1, dt=0.1, tfinal=1).N[:, -1].round(4)
    array([7.1417, 7.1417])
    """
    v, dt = _checks.number("v", v), _checks.positive("dt", dt)
    J = steps(tfinal, dt)
    R, G = scheme.one_step(robot.A, dt)
    GB, weight = G @ robot.B, (G @ robot.e).sum(axis=0)
    T = dt * np.arange(J + 1)
    W, N = np.empty((4, J + 1)), np.empty((2, J + 1))
    W[:, 0] = robot.equilibrium if w0 is None else _checks.array("w0", w0, (4,))
    for j in range(0, J + 1, CHUNK):
        t = T[j : j + CHUNK + 1]
        # The chunk's last sample is the next one's first: known there, computed here.
        u = road_input(robot, road, v, t)
        b = np.empty((len(t), 4))
        b[0], b[1:] = W[:, j], weight
        for c in np.unique(scheme.c):
            u_c = {0.0: u[:, :-1], 1.0: u[:, 1:]}.get(c)
            if u_c is None:
                u_c = road_input(robot, road, v, t[:-1] + c * dt)
            b[1:] += u_c.T @ GB[scheme.c == c].sum(axis=0).T
        with np.errstate(over="ignore", invalid="ignore"):
            W[:, j : j + CHUNK + 1] = affine_scan(R, b).T
            N[:, j : j + CHUNK + 1] = robot.C @ W[:, j : j + CHUNK + 1] + robot.D @ u
    return Trajectory(T, W, N, v, dt, scheme)


def steps(tfinal, dt):
    """Number of steps J from 0 to `tfinal`: ``ceil(tfinal / dt)``, forgiving roundoff.

    >>> steps(0.3, 0.1), steps(0.3001, 0.1)
    (3, 4)
    """
    tfinal, dt = _checks.positive("tfinal", tfinal), _checks.positive("dt", dt)
    J = tfinal / dt
    J = round(J) if abs(J - round(J)) <= 1e-9 * J else np.ceil(J)
    if J > MAX_STEPS:
        raise ValueError(
            f"dt must give at most {MAX_STEPS:.0e} steps, got dt={dt!r}, "
            f"tfinal={tfinal!r}: {J:.3g} steps"
        )
    return max(int(J), 1)


def affine_scan(R, b):
    """All states of ``x_0 = b_0, x_n = R x_{n-1} + b_n``.

    A block of steps from a zero state is one product with a block Toeplitz matrix of powers
    of R. The ends of the blocks obey the same recurrence with a power of R, and are found by the
    same function; one more product carries them into the blocks.

    Parameters
    ----------
    R : ndarray, shape (n, n)
    b : ndarray, shape (m, n)

    Returns
    -------
    x : ndarray, shape (m, n)
        Finite wherever the recurrence, done step by step, is.
    """
    x = _scan_blocks(R, b) if len(b) > BLOCK else None
    return x if x is not None and np.isfinite(x).all() else _scan_steps(R, b)


def _scan_steps(R, b):
    x = b.copy()
    for n in range(1, len(x)):
        x[n] += R @ x[n - 1]
    return x


def _scan_blocks(R, b):
    m, n = b.shape
    powers = [np.eye(n)]
    for _ in range(BLOCK):
        powers.append(powers[-1] @ R.T)
    toeplitz = np.zeros((BLOCK, n, BLOCK, n))
    for lag in range(BLOCK):
        for i in range(BLOCK - lag):
            toeplitz[i, :, i + lag] = powers[lag]
    blocks = -(-m // BLOCK)
    x = np.zeros((blocks, BLOCK * n))
    x.reshape(-1, n)[:m] = b
    x = x @ toeplitz.reshape(BLOCK * n, BLOCK * n)
    ends = affine_scan(powers[BLOCK].T, x[:, -n:])
    x[1:] += ends[:-1] @ np.stack(powers[1:], axis=1).reshape(n, BLOCK * n)
    return x.reshape(-1, n)[:m]
