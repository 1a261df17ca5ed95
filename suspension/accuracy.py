"""How far from the truth: errors of a run over the bump, and what they cost."""

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from suspension.contact import exact_loss, normal_forces
from suspension.course import RK4, make_forcing
from suspension.exact import over_bump
from suspension.flight import fly, make_flight_gfunc
from suspension.simulation import simulate

__all__ = [
    "Errors",
    "disagreement",
    "errors",
    "evaluations",
    "event_run",
    "fitted_order",
    "flight_errors",
    "missed_dip",
    "solve_ivp_errors",
]


class Errors(NamedTuple):
    """Largest errors of a run: state (each component over its largest value), normal force in N,
    and time of the first loss of contact in s (nan if there is none)."""

    state: float
    force: float
    loss: float


def errors(robot, bump, *, v, dt, scheme, tfinal=None):
    """Compare a run from equilibrium with the closed form.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v, dt : float
        Speed, m/s, and time step, s.
    scheme : Scheme
    tfinal : float, optional
        Final time, s; 1.25 m / v if not given.

    Returns
    -------
    Errors
        The run's loss of contact is where a cubic spline through its forces crosses zero.
    """
    tfinal = 1.25 / v if tfinal is None else tfinal
    run = simulate(robot, bump, v=v, dt=dt, tfinal=tfinal, scheme=scheme)
    W, N = _truth(robot, bump, v, run.T)
    loss = exact_loss(robot, bump, v, tfinal)
    scale = np.abs(W).max(axis=1, keepdims=True)
    return Errors(
        (np.abs(run.W - W) / scale).max(),
        np.abs(run.N - N).max(),
        abs(_crossing(run.T, run.N) - loss.t) if loss else np.nan,
    )


def _truth(robot, bump, v, T):
    W = over_bump(robot, bump, v, T)
    return W, normal_forces(robot, bump, v, T, W)


def _crossing(T, N):
    if not (N <= 0).any():
        return np.nan
    roots = [CubicSpline(T, force).roots(extrapolate=False) for force in N]
    return min(r[0] for r in roots if r.size)


def evaluations(scheme, J):
    """Right-hand sides evaluated in J steps; a stage that starts where the last ended is free."""
    reused = bool(scheme.c[0] == 0 and not scheme.a[0].any() and np.all(scheme.a[-1] == scheme.b))
    return (len(scheme.b) - reused) * J + reused


def solve_ivp_errors(robot, bump, *, v, method, tolerances):
    """Largest error of the normal force by `scipy.integrate.solve_ivp`, and what it cost.

    Parameters
    ----------
    method : str
        As in `solve_ivp`; the implicit ones are given the Jacobian A.
    tolerances : sequence of float
        Values of `rtol`; `atol` is a hundredth of it, since the heights are of that size.

    Returns
    -------
    evaluations, errors : ndarray, shape (len(tolerances),)
        Right-hand sides evaluated, and the error at 201 times in N.
    """
    T = np.linspace(0, 1.25 / v, 201)
    N = _truth(robot, bump, v, T)[1]
    options = {} if method in ("RK45", "DOP853") else {"jac": lambda t, w: robot.A}
    costs, worst = [], []
    for rtol in tolerances:
        run = _solve_ivp(
            robot, bump, v, method=method, rtol=rtol, atol=rtol / 100, t_eval=T, **options
        )
        costs.append(run.nfev)
        worst.append(np.abs(normal_forces(robot, bump, v, T, run.y) - N).max())
    return np.array(costs), np.array(worst)


def _solve_ivp(robot, bump, v, **options):
    F = make_forcing(robot, bump, v)
    span = 0, 1.25 / v
    return solve_ivp(lambda t, w: robot.A @ w + F(t), span, robot.equilibrium, **options)


def disagreement(robot, bump, v):
    """Largest difference, in SI units, of the closed form from DOP853 at a tolerance of 1e-12."""
    T = np.linspace(0, 1.25 / v, 101)
    tight = {"rtol": 1e-12, "atol": 1e-14, "max_step": bump.sigma / v}
    run = _solve_ivp(robot, bump, v, method="DOP853", t_eval=T, **tight)
    return np.abs(run.y - over_bump(robot, bump, v, T)).max()


def event_run(robot, bump, v, **options):
    """A run of `solve_ivp` that watches both forces, and whether it saw one cross zero.

    `options` go to `solve_ivp`. Returns its result and a bool.
    """

    def force(wheel):
        return lambda t, w: normal_forces(robot, bump, v, [t], w[:, None])[wheel, 0]

    run = _solve_ivp(robot, bump, v, events=[force(0), force(1)], **options)
    return run, any(times.size for times in run.t_events)


def missed_dip(robot, bump, v, **options):
    """The exact force of the wheel that dips lowest, and the same force at the steps of a run.

    Returns T, N of the exact history and of the steps, each of shape (n,).
    """
    run, _ = event_run(robot, bump, v, **options)
    T = np.linspace(0, 1.25 / v, 20001)
    N = _truth(robot, bump, v, T)[1]
    wheel = N.min(axis=1).argmin()
    return T, N[wheel], run.t, normal_forces(robot, bump, v, run.t, run.y)[wheel]


def fitted_order(dts, errors):
    """Slope of log(error) against log(dt): the observed order of convergence.

    >>> round(fitted_order([0.1, 0.05], [4e-2, 1e-2]), 12)
    2.0
    """
    return float(np.polyfit(np.log(dts), np.log(errors), 1)[0])


def flight_errors(robot, road, *, v, tfinal, steps):
    """Error of RK4 in flight at the final time, with and without stopping at every switch.

    Parameters
    ----------
    robot : Robot
    road : callable
    v, tfinal : float
        Speed, m/s, and final time, s.
    steps : sequence of int
        Numbers of steps from 0 to `tfinal`.

    Returns
    -------
    blind, located : ndarray, shape (len(steps),)
        Largest error of a state component relative to its largest value in the run: for steps
        that ignore the switches, and for steps fitted between them.
    """
    flight = fly(robot, road, v=v, tfinal=tfinal)
    scale, gfunc = np.abs(flight.W).max(axis=1), make_flight_gfunc(robot, road)
    errors = []
    for J in steps:
        ends = [RK4(gfunc, robot.equilibrium, tfinal / J, tfinal, v)[0][:, -1], robot.equilibrium]
        for start, end, pressing in flight.legs:
            leg = make_flight_gfunc(robot, road, pressing, start)
            dt = (end - start) / np.ceil(J * (end - start) / tfinal)
            ends[1] = RK4(leg, ends[1], dt, end - start, v)[0][:, -1]
        errors.append([(np.abs(w - flight.W[:, -1]) / scale).max() for w in ends])
    return np.array(errors).T
