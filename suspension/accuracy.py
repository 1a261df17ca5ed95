"""How far from the truth: errors of a run over the bump, and what they cost."""

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from suspension import _checks
from suspension.contact import exact_loss, is_lost, margin, normal_forces
from suspension.course import RK4, make_forcing
from suspension.exact import over_bump
from suspension.flight import fly, make_flight_gfunc
from suspension.least_force import distance_over, duration, sample_count
from suspension.road import GaussianBump
from suspension.schemes import Scheme
from suspension.simulation import simulate

__all__ = [
    "Errors",
    "after_landing",
    "disagreement",
    "error_table",
    "errors",
    "evaluations",
    "event_run",
    "fitted_order",
    "flight_errors",
    "half_turn",
    "just_lost",
    "missed_dip",
    "overlooked",
    "seen_mode",
    "solve_ivp_errors",
]


MAX_SAMPLES = 10**5


class Errors(NamedTuple):
    """Largest errors of a run: state (each component over its largest value), normal force in N,
    and time of the first loss of contact in s (nan if there is none)."""

    state: float
    force: float
    loss: float


def errors(robot, bump, *, v, dt, scheme, tfinal=None, distance=None):
    """Compare a run from equilibrium with the closed form.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v, dt : float
        Speed, m/s, and time step, s.
    scheme : Scheme
    tfinal, distance : float, optional
        Final time, s, or how far the run goes, m, as in `suspension.margin`.

    Returns
    -------
    Errors
        The run's loss of contact is where a cubic spline through its forces crosses zero.

    Raises
    ------
    ValueError
        If an argument is out of its range, or `suspension.simulation.simulate` or
        `suspension.margin` refuses the run.
    """
    _checks.instance("bump", bump, GaussianBump)
    v = _checks.positive("v", v)
    tfinal = duration(robot, bump, v, tfinal, distance)
    run = simulate(robot, bump, v=v, dt=dt, tfinal=tfinal, scheme=scheme)
    W, N = _truth(robot, bump, v, run.T)
    loss = exact_loss(robot, bump, v, tfinal)
    scale = np.abs(W).max(axis=1, keepdims=True)
    return Errors(
        (np.abs(run.W - W) / scale).max(),
        np.abs(run.N - N).max(),
        abs(_first_zero(run.T, run.N) - loss.t) if loss else np.nan,
    )


def error_table(robot, bump, *, v, dts, scheme, distance=None):
    """`errors` for several time steps `dts`, s, shape (n,): an ndarray, shape (n, 3)."""
    run = {"v": v, "scheme": scheme, "distance": distance}
    return np.array([errors(robot, bump, dt=dt, **run) for dt in dts])


def _truth(robot, bump, v, T):
    W = over_bump(robot, bump, v, T)
    return W, normal_forces(robot, bump, v, T, W)


def _first_zero(T, N):
    if not (N <= 0).any():
        return np.nan
    roots = [CubicSpline(T, force).roots(extrapolate=False) for force in N]
    return min(r[0] for r in roots if r.size)


def evaluations(scheme, J):
    """Right-hand sides evaluated in J steps; a stage that starts where the last ended is free.

    So a step of Crank-Nicolson, whose second stage is the first one of the next step, counts as
    one new evaluation (and one linear system to solve), RK4's as four, Euler's as one.

    Raises
    ------
    ValueError
        If `J` is no whole number >= 0.

    Examples
    --------
    >>> from suspension.schemes import CRANK_NICOLSON, RK4
    >>> evaluations(CRANK_NICOLSON, 100), evaluations(RK4, 100)
    (101, 400)
    """
    _checks.instance("scheme", scheme, Scheme)
    J = _checks.whole("J", J, 0)
    starts_at_the_old_end = scheme.c[0] == 0 and not scheme.a[0].any()
    ends_at_the_new_one = np.all(scheme.a[-1] == scheme.b)
    reused = int(starts_at_the_old_end and ends_at_the_new_one)
    return (len(scheme.b) - reused) * J + reused


def seen_mode(scheme, lam, dts):
    """The eigenvalue that a run shows in the place of `lam`: ``ln R(lam dt) / dt``.

    The logarithm has many branches; the imaginary part is followed from the shortest step on, so
    that the frequency is continuous. Beyond ``pi / dt`` (Nyquist) no sample can tell it from the
    one that is lower by ``2 pi / dt``.

    Parameters
    ----------
    scheme : Scheme
    lam : complex
        Eigenvalue of a mode, 1/s.
    dts : array_like, shape (n,)
        Time steps, s, in order, the first one short against ``1 / abs(lam)``.

    Returns
    -------
    seen : ndarray of complex, shape (n,)
        1/s.

    Raises
    ------
    ValueError
        If `lam` is no finite number, a time step is not > 0, or they are not in order.
    TypeError
        If `scheme` is not a Scheme.
    """
    _checks.instance("scheme", scheme, Scheme)
    lam = _checks.array("lam", lam, (), complex)
    dts = _checks.in_order("dts", _steps(dts))
    R = scheme.stability_function(lam * dts)
    return (np.log(np.abs(R)) + 1j * np.unwrap(np.angle(R))) / dts


def _steps(dts):
    dts = _checks.array("dts", dts, (None,))
    if not (dts > 0).all():
        raise ValueError(f"dts must be time steps > 0, got {dts[~(dts > 0)][0]:g}")
    return dts


def half_turn(seen, dts):
    """The first step in which a mode turns by more than half a circle, s; None if there is none.

    Parameters
    ----------
    seen : array_like of complex, shape (n,)
        The eigenvalue of the mode that a run shows, 1/s: `seen_mode`.
    dts : array_like, shape (n,)
        Time steps, s, in order, n >= 1.

    Returns
    -------
    dt : float or None
        Between two of `dts`; the first of them if the mode turns so far in it already.

    Raises
    ------
    ValueError
        If the time steps are not > 0 and in order, there is none, or `seen` does not hold a finite
        number for each.

    Examples
    --------
    >>> half_turn([50j, 50j], [0.1, 0.2]), half_turn([10j, 10j], [0.1, 0.2])
    (0.1, None)
    """
    dts = _checks.in_order("dts", _steps(dts), 1)
    angle = _checks.array("seen", seen, dts.shape, complex).imag * dts
    over = np.flatnonzero(angle > np.pi)
    if not over.size:
        return None
    around = slice(max(over[0] - 1, 0), over[0] + 1)
    return float(np.interp(np.pi, angle[around], dts[around]))


def solve_ivp_errors(robot, bump, *, v, method, tolerances, distance=None):
    """Largest error of the normal force by `scipy.integrate.solve_ivp`, and what it cost.

    Parameters
    ----------
    method : str
        As in `solve_ivp`; the implicit ones are given the Jacobian A.
    tolerances : sequence of float
        Values of `rtol`; `atol` is a hundredth of it, since the heights are of that size.
    distance : float, optional
        How far the run goes, m: 1.25 m if the whole bump lies within
        (`suspension.least_force.distance_over`).

    Returns
    -------
    evaluations, errors : ndarray, shape (len(tolerances),)
        Right-hand sides evaluated, and the error at 201 times in N.

    Raises
    ------
    ValueError
        If an argument is out of its range (a tolerance is no finite number > 0, say),
        `suspension.least_force.distance_over` or SciPy refuses,
        or more than 10^5 samples would be needed to follow the swings of the modes.
    """
    tolerances = _checks.positives("tolerances", tolerances, (None,))
    tfinal = _duration(robot, bump, v, distance)
    T = np.linspace(0, tfinal, 201)
    N = _truth(robot, bump, v, T)[1]
    options = {} if method in ("RK45", "DOP853") else {"jac": lambda t, w: robot.A}
    costs, worst = [], []
    for rtol in tolerances:
        run = _solve_ivp(
            robot, bump, v, tfinal, method=method, rtol=rtol, atol=rtol / 100, t_eval=T, **options
        )
        costs.append(run.nfev)
        worst.append(np.abs(normal_forces(robot, bump, v, T, run.y) - N).max())
    return np.array(costs), np.array(worst)


def _duration(robot, bump, v, distance):
    """How long a run of `solve_ivp` lasts, s, refused if it would take minutes."""
    tfinal = duration(robot, bump, _checks.positive("v", v), None, distance)
    swings = sample_count(robot, v, v * tfinal)
    if not swings <= MAX_SAMPLES:
        raise ValueError(
            f"distance must be so short, or v so high, that at most {MAX_SAMPLES} samples follow "
            f"the swings of the modes, got v={v:g}, distance={v * tfinal:g}: {swings:.3g}"
        )
    return tfinal


def _solve_ivp(robot, bump, v, tfinal, **options):
    F = make_forcing(robot, bump, v)
    span = 0, tfinal
    return solve_ivp(lambda t, w: robot.A @ w + F(t), span, robot.equilibrium, **options)


def disagreement(robot, bump, v, *, distance=None):
    """Largest difference, in SI units, of the closed form from DOP853 at a tolerance of 1e-12."""
    tfinal = _duration(robot, bump, v, distance)
    T = np.linspace(0, tfinal, 101)
    tight = {"rtol": 1e-12, "atol": 1e-14, "max_step": bump.sigma / v}
    run = _solve_ivp(robot, bump, v, tfinal, method="DOP853", t_eval=T, **tight)
    return np.abs(run.y - over_bump(robot, bump, v, T)).max()


def event_run(robot, bump, v, *, distance=None, **options):
    """A run of `solve_ivp` that watches both forces, and whether it saw one cross zero.

    `distance` is that of `suspension.margin`; `options` go to `solve_ivp`. Returns its result and
    a bool.
    """

    def force(wheel):
        return lambda t, w: normal_forces(robot, bump, v, [t], w[:, None])[wheel, 0]

    tfinal = _duration(robot, bump, v, distance)
    run = _solve_ivp(robot, bump, v, tfinal, events=[force(0), force(1)], **options)
    return run, any(times.size for times in run.t_events)


def overlooked(robot, bump, speeds, **options):
    """Those of the `speeds`, m/s, at which `event_run` sees no loss of contact, a list.

    `options` are those of `event_run`, `distance` among them.
    """
    return [v for v in speeds if not event_run(robot, bump, v, **options)[1]]


def just_lost(robot, bump, critical, n=40, *, distance=None):
    """Speeds beside the last critical one, up to 5 % away, at which contact is lost.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    critical : array_like
        Critical speeds, m/s, in order.
    n : int
        How many speeds, >= 1, on the side on which contact is lost.
    distance : float, optional
        How far the run goes, m: 1.25 m if the whole bump lies within
        (`suspension.least_force.distance_over`).

    Returns
    -------
    v : ndarray, shape (n,)
        In order, m/s; those at which contact is kept (because another critical speed is near) are
        left out, and without a critical speed there are none.

    Raises
    ------
    ValueError
        If `n` is no whole number >= 1, a speed is not > 0, they are not in order, or
        `suspension.margin` refuses.
    """
    n = _checks.whole("n", n, 1)
    critical = _checks.in_order("critical", _checks.positives("critical", critical))
    distance = distance_over(robot, bump, distance)

    def lost(v):
        return is_lost(margin(robot, bump, v, distance=distance))

    if not len(critical):
        return np.array([])
    away = 0.05 * np.arange(1, n + 1) / (n + 1)
    above, below = (1 + away) * critical[-1], (1 - away[::-1]) * critical[-1]
    side = above if lost(above[0]) else below
    return np.array([v for v in side if lost(v)])


def missed_dip(robot, bump, v, *, distance=None, **options):
    """The exact force of the wheel that dips lowest, and the same force at the steps of a run.

    `distance` and `options` are those of `event_run`. Returns T, N of the exact history and of the
    steps, each of shape (n,).
    """
    distance = distance_over(robot, bump, distance)
    run, _ = event_run(robot, bump, v, distance=distance, **options)
    T = np.linspace(0, distance / v, 20001)
    N = _truth(robot, bump, v, T)[1]
    wheel = N.min(axis=1).argmin()
    return T, N[wheel], run.t, normal_forces(robot, bump, v, run.t, run.y)[wheel]


def fitted_order(dts, errors):
    """Slope of log(error) against log(dt): the observed order of convergence.

    Parameters
    ----------
    dts : array_like, shape (n,)
        Time steps, s, > 0.
    errors : array_like, shape (n,)
        Those that are zero or not finite are left out.

    Returns
    -------
    order : float
        nan if fewer than two errors are left.

    Raises
    ------
    ValueError
        If a time step is not > 0, there is not one error for each, or all that are left belong to
        one and the same step.

    Examples
    --------
    >>> round(fitted_order([0.1, 0.05, 0.025], [np.nan, 1e-2, 2.5e-3]), 12)
    2.0
    """
    dts = _steps(dts)
    errors = _checks.array("errors", errors, dts.shape, finite=False)
    good = np.isfinite(errors) & (errors > 0)
    if good.sum() < 2:
        return np.nan
    if np.ptp(dts[good]) == 0:
        raise ValueError(f"dts must hold two different time steps, got {dts[good][0]:g} only")
    return float(np.polyfit(np.log(dts[good]), np.log(errors[good]), 1)[0])


def after_landing(flight):
    """A time at which a study of steps can end: after the first landing with a jump of the force.

    Half-way to the next switch, and at most half as long after the landing as it took until
    then, s; None if no landing has a jump.
    """
    for event, following in zip(flight.events, [*flight.events[1:], None]):
        if event.kind == "landing" and event.force > 1e-3:
            end = following.t if following else flight.T[-1]
            return float(event.t + min(end - event.t, event.t) / 2)
    return None


def flight_errors(robot, road, *, v, tfinal, steps):
    """Error of RK4 in flight at the final time, with and without stopping at every switch.

    Parameters
    ----------
    robot : Robot
    road : callable
    v, tfinal : float
        Speed, m/s, and final time, s.
    steps : sequence of int
        Numbers of steps from 0 to `tfinal`, >= 1.

    Returns
    -------
    blind, located : ndarray, shape (len(steps),)
        Largest error of a state component relative to its largest value in the run: for steps
        that ignore the switches, and for steps fitted between them.

    Raises
    ------
    ValueError
        If a number of steps is no whole number >= 1 or more than 10^8, `suspension.flight.fly`
        refuses the run, or a component of the state stays zero in it, as on a level road.
    RuntimeError
        As `suspension.flight.fly` does.
    """
    try:
        steps = list(steps)
    except TypeError:
        raise ValueError(f"steps must hold numbers of steps, got {steps!r}") from None
    steps = [_checks.whole("steps", J, 1) for J in steps]
    flight = fly(robot, road, v=v, tfinal=tfinal)
    scale = np.abs(flight.W).max(axis=1)
    if not scale.all():
        raise ValueError(
            "robot must be moved by the road before tfinal, in heave and pitch, for errors to have "
            f"a measure, got largest values {scale}"
        )
    gfunc = make_flight_gfunc(robot, road)

    def last(gfunc, w, duration, J):
        return RK4(gfunc, w, duration / J, duration, v)[0][:, -1]

    def error(w):
        return (np.abs(w - flight.W[:, -1]) / scale).max()

    blind, located = [], []
    for J in steps:
        blind.append(error(last(gfunc, robot.equilibrium, tfinal, J)))
        w = robot.equilibrium
        for start, end, pressing in flight.legs:
            leg = make_flight_gfunc(robot, road, pressing, start, end)
            w = last(leg, w, end - start, int(np.ceil(J * (end - start) / tfinal)))
        located.append(error(w))
    return np.array(blind), np.array(located)
