"""The problem set's own functions, by its names and in its order of arguments.

Loops that read like the textbook, for any right-hand side; `suspension.simulation` computes the
same trajectories faster. Histories are (4, J+1) and times (J+1,), as the problem has them.
"""

import warnings
from functools import cache

import numpy as np
from scipy.linalg import LinAlgWarning, lu_factor, lu_solve

from suspension import _checks
from suspension.road import GaussianBump, road_input
from suspension.robot import Robot
from suspension.simulation import steps
from suspension.springs import fit_spring, load_spring_data

__all__ = [
    "RK4",
    "Hgauss",
    "crank_nicolson",
    "gfunc_linear",
    "make_forcing",
    "make_gfunc",
    "the_robot",
]

Hgauss = GaussianBump()


@cache
def the_robot():
    """The problem's robot: Table 1, and on both axles the stiffness fitted in Part I."""
    k = fit_spring(load_spring_data()).stiffness
    return Robot(k, k)


def make_gfunc(robot, road):
    """Return ``gfunc(w, t, v) -> (wdot, N1, N2)`` for any robot and any road.

    The returned function takes the state w, shape (4,), the time t in s and the speed v in m/s,
    and gives ``w' = A w + F(t)``, shape (4,), and the two normal forces in N.

    Raises
    ------
    ValueError
        When the returned function is called, if t or v is no finite number, or the road returns
        another shape or what is not finite.
    """
    _checks.instance("robot", robot, Robot)
    _checks.function("road", road, "road(x) -> (H, dHdx)")

    def gfunc(w, t, v):
        t = _checks.number("t", t)
        u = road_input(robot, road, v, t)
        N1, N2 = robot.C @ w + robot.D @ u
        wdot = robot.A @ w + robot.B @ u + robot.e
        return wdot, N1, N2

    return gfunc


def make_forcing(robot, road, v):
    """Return ``F(t)``, shape (4,), of ``w' = A w + F(t)`` at speed `v` in m/s.

    Raises
    ------
    ValueError
        If v is no finite number, and from the returned function, if t is none or the road returns
        another shape or what is not finite.
    """
    _checks.instance("robot", robot, Robot)
    _checks.function("road", road, "road(x) -> (H, dHdx)")
    v = _checks.number("v", v)

    def F(t):
        return robot.B @ road_input(robot, road, v, t) + robot.e

    return F


def gfunc_linear(w, t, v):
    """Rate of change of the state and the normal forces, for the problem's robot and bump.

    Parameters
    ----------
    w : array_like, shape (4,)
        State ``[Y, Y', theta, theta']``.
    t : float
        Time, s.
    v : float
        Speed, m/s.

    Returns
    -------
    wdot : ndarray, shape (4,)
        ``A w + F(t)``.
    N1, N2 : float
        Normal forces at the rear and the front wheel, N (Eq. 5).

    Raises
    ------
    ValueError
        If w has another shape or is not finite, or t or v is no finite number.
    """
    return make_gfunc(the_robot(), Hgauss)(_checks.array("w", w, (4,)), t, v)


def RK4(gfunc_handle, w0, deltat, tfinal, v):
    """Integrate ``w' = g(w, t; v)`` with the four-stage Runge-Kutta method.

    Parameters
    ----------
    gfunc_handle : callable
        ``gfunc_handle(w, t, v)``, returning w' of the shape of w, alone or as the first of several
        outputs.
    w0 : array_like, shape (n,)
        State at t = 0.
    deltat, tfinal : float
        Time step and final time, s, > 0.
    v : float
        Speed, m/s, handed on.

    Returns
    -------
    W : ndarray, shape (n, J+1)
    T : ndarray, shape (J+1,)

    Raises
    ------
    ValueError
        If an argument is out of its range, there are more than 10^8 steps, or w' has not the shape
        of w.
    """

    def g(w, t):
        output = gfunc_handle(w, t, v)
        wdot = output[0] if isinstance(output, tuple) else output
        return _checks.array("gfunc_handle's wdot", wdot, w0.shape, finite=False)

    _checks.function("gfunc_handle", gfunc_handle, "gfunc_handle(w, t, v) -> wdot")
    w0 = _checks.array("w0", w0, (None,))
    T = deltat * np.arange(steps(tfinal, deltat, "deltat") + 1)
    W = np.empty((len(w0), len(T)))
    W[:, 0] = w0
    for j, t in enumerate(T[:-1]):
        w = W[:, j]
        g1 = g(w, t)
        g2 = g(w + deltat / 2 * g1, t + deltat / 2)
        g3 = g(w + deltat / 2 * g2, t + deltat / 2)
        g4 = g(w + deltat * g3, t + deltat)
        W[:, j + 1] = w + deltat / 6 * (g1 + 2 * g2 + 2 * g3 + g4)
    return W, T


def crank_nicolson(A, F, w0, deltat, tfinal):
    """Integrate ``w' = A w + F(t)`` with Crank-Nicolson, one LU factorisation for all steps.

    Parameters
    ----------
    A : array_like, shape (n, n)
        State matrix, 1/s.
    F : callable
        ``F(t)``, shape (n,).
    w0 : array_like, shape (n,)
        State at t = 0.
    deltat, tfinal : float
        Time step and final time, s, > 0.

    Returns
    -------
    W : ndarray, shape (n, J+1)
    T : ndarray, shape (J+1,)

    Raises
    ------
    ValueError
        If an argument is out of its range or F returns what is, there are more than 10^8 steps, or
        the step has no solution.
    """

    def forcing(t):
        return _checks.array("F", F(t), w0.shape)

    _checks.function("F", F, "F(t), of the shape of w0")
    w0 = _checks.array("w0", w0, (None,))
    T = deltat * np.arange(steps(tfinal, deltat, "deltat") + 1)
    A = _checks.array("A", A, (len(w0), len(w0)))
    half, identity = deltat / 2 * A, np.eye(len(A))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LinAlgWarning)
        lu = lu_factor(identity - half)
    if not lu[0].diagonal().all():
        raise ValueError(f"deltat must not make the step unsolvable, got {deltat}")
    W = np.empty((len(A), len(T)))
    W[:, 0] = w0
    for j, t in enumerate(T[:-1]):
        b = (identity + half) @ W[:, j] + deltat / 2 * (forcing(t) + forcing(t + deltat))
        W[:, j + 1] = lu_solve(lu, b, check_finite=False)
    return W, T
