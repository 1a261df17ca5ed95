"""Drive the robot over a road with a one-step method.

The motion is linear, so one step of any scheme is ``w_{n+1} = R w_n + b_n`` with a constant
matrix R, which `suspension.recurrence` runs many steps at a time.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from suspension import _checks
from suspension.contact import first_loss
from suspension.recurrence import Discrete
from suspension.road import under_wheels
from suspension.schemes import RK4, Scheme

__all__ = ["Trajectory", "simulate", "steps"]

MAX_STEPS = 10**8
CHUNK = 8192  # steps whose arrays stay in the processor's cache


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
    _checks.instance("scheme", scheme, Scheme)
    T = dt * np.arange(steps(tfinal, dt) + 1)
    rest = robot.equilibrium
    w0 = rest if w0 is None else _checks.array("w0", w0, (4,))
    W, N = np.empty((4, len(T))), np.empty((2, len(T)))
    run = _discrete(robot, scheme, dt)
    later = run.abscissae[:, None] * dt
    k, vc = np.array([[robot.k1, robot.k2], [v * robot.c1, v * robot.c2]])[..., None]
    # About the equilibrium the weight drops out: every scheme stays there exactly.
    x, offset = None, np.concatenate([rest, robot.C @ rest])[:, None]
    for j in range(0, len(T), CHUNK):
        part = slice(j, j + CHUNK)
        X = v * np.minimum(T[part] + later, T[-1])  # no road is asked for beyond the end
        H, dHdx = under_wheels(robot, road, X)
        f = (k * H + vc * dHdx).reshape(-1, X.shape[-1])  # D u
        y, x = run(run.start(w0 - rest, f) if x is None else x, f)
        np.add(y[:4], offset[:4], out=W[:, part])
        np.add(y[4:], offset[4:], out=N[:, part])
    W[:, 0] = w0
    return Trajectory(T, W, N, v, dt, scheme)


@lru_cache(maxsize=32)
def _discrete(robot, scheme, dt):
    # The road acts by f = D u alone: w' = A w + P f + e, and N = C w + f.
    C, D = np.vstack([np.eye(4), robot.C]), np.vstack([np.zeros((4, 2)), np.eye(2)])
    return Discrete(scheme, robot.A, robot.P, C, D, dt)


def steps(tfinal, dt):
    """Number of steps J from 0 to `tfinal`: ``ceil(tfinal / dt)``, forgiving roundoff.

    >>> steps(0.3, 0.1), steps(0.3001, 0.1)
    (3, 4)
    """
    tfinal, dt = _checks.positive("tfinal", tfinal), _checks.positive("dt", dt)
    J = tfinal / dt
    if J < MAX_STEPS + 1:
        J = round(J) if abs(J - round(J)) <= 1e-12 * J else np.ceil(J)
    if J > MAX_STEPS:
        raise ValueError(
            f"dt must give at most {MAX_STEPS:.0e} steps, got dt={dt!r}, "
            f"tfinal={tfinal!r}: {J:.3g} steps"
        )
    return max(int(J), 1)
