"""Drive the robot over a road with a one-step method.

The motion is linear, so one step of any scheme is ``w_{n+1} = R w_n + b_n`` with a constant matrix
R. All steps together, ``w_{n+1} - R w_n = b_n``, are one triangular system with a narrow band, and
solving it from the top down *is* the time loop: LAPACK's ``dtbtrs`` runs it.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg.lapack import dtbtrs

from suspension import _checks
from suspension.forces import Loss, first_loss
from suspension.road import Road, under_wheels
from suspension.robot import Robot
from suspension.schemes import RK4, Scheme

if TYPE_CHECKING:
    import pandas

__all__ = ["Trajectory", "simulate", "steps"]

MAX_STEPS = 10**8
CHUNK = 8192  # steps solved at a time, so that their arrays stay in the processor's cache


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
    def loss(self) -> Loss | None:
        """First sample without contact: `suspension.forces.Loss`, or None."""
        return first_loss(self.T, self.N)

    @property
    def X(self) -> np.ndarray:
        """Position of the centre of mass, m (Eq. 1), shape (J+1,)."""
        return self.v * self.T

    def to_frame(self) -> "pandas.DataFrame":
        """The run as a pandas DataFrame, a row for each time, with units in the columns' names.

        >>> from suspension.road import FlatRoad
        >>> run = simulate(Robot(800, 800), FlatRoad(), v=1, dt=0.1, tfinal=1)
        >>> run.to_frame().columns[-2:].tolist()
        ['N1 rear (N)', 'N2 front (N)']
        """
        return as_frame(self)

    def __repr__(self):
        return (
            f"<Trajectory: {self.scheme.name}, v = {self.v:g} m/s, dt = {self.dt:g} s, "
            f"{len(self.T) - 1} steps to t = {self.T[-1]:g} s>"
        )


def as_frame(run, more=None):
    """A `Trajectory` or another run with T, v, W and N as a pandas DataFrame, `more` after them."""
    import pandas  # on demand: it takes longer to load than the package and most runs to compute

    Y, dY, theta, dtheta = run.W
    columns = {
        "t (s)": run.T,
        "X (m)": run.v * run.T,
        "Y (m)": Y,
        "Y' (m/s)": dY,
        "theta (rad)": theta,
        "theta' (rad/s)": dtheta,
        "N1 rear (N)": run.N[0],
        "N2 front (N)": run.N[1],
    }
    return pandas.DataFrame(columns | (more or {}))


def simulate(
    robot: Robot,
    road: Road,
    *,
    v: float,
    dt: float,
    tfinal: float,
    scheme: Scheme = RK4,
    w0: ArrayLike | None = None,
) -> Trajectory:
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
    _checks.instance("robot", robot, Robot)
    _checks.instance("scheme", scheme, Scheme)
    v, dt = _checks.number("v", v), _checks.positive("dt", dt)
    equilibrium = robot.equilibrium
    w0 = equilibrium if w0 is None else _checks.array("w0", w0, (4,))
    T = dt * np.arange(steps(tfinal, dt) + 1.0)
    W, N = np.empty((len(T), 4)), np.empty((2, len(T)))  # of W a step's four numbers side by side
    with np.errstate(over="ignore", invalid="ignore"):  # an unstable run may overflow
        _fill(W, N, robot, road, v, T, dt, scheme, w0)
    return Trajectory(T, W.T, N, v, dt, scheme)


def _fill(W, N, robot, road, v, T, dt, scheme, w0):
    """Write the states, shape (J+1, 4), and the forces, shape (2, J+1), of a run from `w0`.

    Computed as deviations from equilibrium, where the weight drops out: so every scheme stays in
    equilibrium exactly.
    """
    equilibrium = robot.equilibrium
    weight = robot.C @ equilibrium
    R, stages, band = _step(robot, scheme, dt)
    d = w0 - equilibrium
    W[0] = w0
    N[:, 0] = weight + robot.C @ d + _road_force(robot, road, v, T[:1])[:, 0]
    for start in range(0, len(T) - 1, CHUNK):
        t = T[start : start + CHUNK + 1]
        at_ends = _road_force(robot, road, v, t)
        b = np.zeros((len(t) - 1, 4))
        for c, GP in stages:
            if c == 0:
                f = at_ends[:, :-1]
            elif c == 1:
                f = at_ends[:, 1:]
            else:
                f = _road_force(robot, road, v, t[:-1] + c * dt)
            b += f.T @ GP.T
        b[0] += R @ d
        deviation = _forward_substitution(band, b)
        d = deviation[-1]
        later = slice(start + 1, start + len(t))
        W[later] = deviation + equilibrium
        N[:, later] = robot.C @ deviation.T + at_ends[:, 1:] + weight[:, None]


@lru_cache(maxsize=8)
def _step(robot, scheme, dt):
    """What every step needs: R, ``(c, G_c P)`` for the different abscissae c, and the band."""
    R, G = scheme.one_step(robot.A, dt)
    stages = [(c, G[scheme.c == c].sum(axis=0) @ robot.P) for c in np.unique(scheme.c)]
    return R, stages, _band(R, CHUNK)


def _road_force(robot, road, v, t):
    """What the road adds to the normal forces, ``D u``, shape (2, n)."""
    H, dHdx = under_wheels(robot, road, v * t)
    return robot.k[:, None] * H + (v * robot.c)[:, None] * dHdx


def _band(R, steps):
    """The matrix of ``w_{n+1} - R w_n``, its lower band by columns, shape (8, 4 steps).

    Entry ``[d, j]`` is that of column j, d rows below the diagonal.
    """
    columns = np.zeros((4, 8))
    columns[:, 0] = 1
    for j in range(4):
        columns[j, 4 - j : 8 - j] = -R[:, j]
    return np.tile(columns, (steps, 1)).T


def _forward_substitution(band, b):
    """Solve ``w_{n+1} - R w_n = b_n`` for n = 0, 1, ...; all of shape (steps, 4)."""
    w, _ = dtbtrs(band[:, : b.size], b.ravel(), uplo="L", diag="U", overwrite_b=True)
    return w.reshape(b.shape)


def steps(tfinal: float, dt: float, name: str = "dt") -> int:
    """Number of steps J from 0 to `tfinal`: ``ceil(tfinal / dt)``, forgiving roundoff.

    Raises
    ------
    ValueError
        If a time is not > 0, or there are more than 10^8 steps.

    Examples
    --------
    >>> steps(0.3, 0.1), steps(0.3001, 0.1)
    (3, 4)
    """
    tfinal, dt = _checks.positive("tfinal", tfinal), _checks.positive(name, dt)
    J = tfinal / dt
    if J < MAX_STEPS + 1:
        J = round(J) if abs(J - round(J)) <= 1e-12 * J else np.ceil(J)
    if J > MAX_STEPS:
        raise ValueError(
            f"{name} must give at most {MAX_STEPS:.0e} steps, got {name}={dt!r}, "
            f"tfinal={tfinal!r}: {J:.3g} steps"
        )
    return max(int(J), 1)
