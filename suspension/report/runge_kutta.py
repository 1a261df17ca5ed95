"""Sentences of Part III: stability of RK4, its right-hand side, and its accuracy."""

import math

import numpy as np

from suspension.accuracy import evaluations
from suspension.report.rows import mode_name, table
from suspension.report.stability import dt_list
from suspension.report.words import SPACE, Caption, fixed, join, number, quantity
from suspension.road import road_input
from suspension.schemes import RK4

__all__ = [
    "agreement",
    "at_rest",
    "comparison",
    "growth_caption",
    "limit",
    "slopes_caption",
    "won_back",
]

ROUNDOFF = 1e-9  # a mode whose amplitude grows by less has kept it
NOTHING = 1e-12  # an acceleration below it is roundoff, SI units
ALIKE = 1e-6  # of the weight: forces nearer than this are one in all the digits that are told
AS_PROMISED = 0.1  # an error that falls by the factor of its order, within this part


def slopes_caption(end, truth):
    """Caption of one long step of RK4, that ends at `end` where the solution is `truth`."""
    off = quantity(100 * abs(end / truth - 1), "%", 2)
    text = (
        "One step of RK4. A symbol marks where it looks, the short line through it the slope it "
        "finds there. The dashed step has the weighted mean of the four slopes; it ends (star) "
        f"within {off} of the exact solution."
    )
    alt = (
        "A curve, the exact solution, with four short slopes at the start, twice in the middle and "
        "at the end of one step, and the dashed straight line of the step, ending near the curve."
    )
    return Caption(text, alt)


def limit(eigenvalues):
    """The largest stable step, and how far the region of stability reaches."""
    step = quantity(RK4.max_stable_dt(eigenvalues), "s", 4)
    up, left = RK4.max_stable_dt([1j]), RK4.max_stable_dt([-1])
    return (
        f"The largest stable step for this robot is {step}. The region reaches to {fixed(up, 4)}i "
        f"on the imaginary axis ($2\\sqrt2\\,i$) and to {fixed(-left, 4)} on the real one."
    )


def at_rest(robot, road, output):
    """Answer 8(ii): what `gfunc_linear` returns at equilibrium, and where the rest comes from.

    Parameters
    ----------
    robot : Robot
    road : callable
        ``road(x) -> (H, dHdx)``.
    output : tuple
        ``(wdot, N1, N2)`` of the equilibrium at t = 0 and v = 0.
    """
    wdot, N1, N2 = output
    weight = robot.m * robot.g
    share = f"together the weight of {quantity(weight, 'N', 4)}"
    if abs(N1 - N2) < ALIKE * weight:
        share = "half the weight each"
    entries = ", ".join("0" if abs(x) < NOTHING else number(x) for x in wdot)
    return (
        r"At rest on flat ground nothing accelerates, so $\dot w = 0$ is expected. The function "
        rf"returns $\dot w$ = ({entries}), with $N_1$ = {fixed(N1, 4)}{SPACE}N and "
        f"$N_2$ = {fixed(N2, 4)}{SPACE}N, {share}. {_residue(robot, road, wdot)}"
    )


def _residue(robot, road, wdot):
    """Where what is left of the accelerations comes from: the bump's tail, or roundoff."""
    if np.abs(wdot).max() < NOTHING:
        return "It is as expected."
    u = road_input(robot, road, 0.0, 0.0)
    if not np.allclose(wdot, robot.B @ u, rtol=0.01, atol=NOTHING):
        return "What is left is roundoff."
    wheel = int(np.abs(u[:2]).argmax())
    name, place = (("rear", "-L_1"), ("front", "L_2"))[wheel]
    return (
        "What is left is not roundoff but the bump: its tail reaches the robot. The ground at the "
        f"{name} wheel is $H({place})$ = {quantity(u[wheel], 'm')} high, and what both wheels feel "
        "of it, $B u$, is just these accelerations."
    )


def growth_caption(runs, robot, shown):
    """Caption of how the modes of two runs grow or die away.

    Parameters
    ----------
    runs : pair of Trajectory
    robot : Robot
    shown : sequence of int
        Which modes are drawn.
    """
    names = join(dict.fromkeys(mode_name(robot, k) for k in shown))
    fates = [_fate(run, robot, shown) for run in runs]
    left, right = (f"{run.dt:g}{SPACE}s" for run in runs)
    seen = f"At {left} (left) {fates[0]}; at {right} (right) {fates[1]}."
    if fates[0] == fates[1]:
        seen = f"Both at {left} (left) and at {right} (right) {fates[0]}."
    text = (
        f"Amplitude of the modes ({names}) step by step by {runs[0].scheme.name}, computed "
        rf"(symbols) and predicted from $\lvert R(\lambda_k\Delta t)\rvert$ (lines). {seen} "
        "A symbol leaves its line only where rounding errors of the larger mode cover the smaller."
    )
    alt = (
        f"Two panels, amplitude of the modes ({names}) on a logarithmic axis against the step "
        f"number; the computed symbols lie on the straight predicted lines. {seen}"
    )
    return Caption(text, alt)


def _fate(run, robot, shown):
    growth = np.abs(run.scheme.stability_function(robot.eigenvalues[shown] * run.dt))
    grows = growth > 1 + ROUNDOFF
    if grows.all():
        return "every mode grows, and the run blows up"
    if grows.any():
        name = mode_name(robot, shown[int(growth.argmax())])
        return f"the {name} grows and another mode does not, and the run blows up"
    return "no mode grows"


def agreement(runs, modes, eigenvalues):
    """Answer 9(iii): whether the runs grow where Question 7 says they do, with a table.

    Parameters
    ----------
    runs : sequence of Trajectory
    modes : sequence of array_like, shape (n, J+1)
        Amplitudes of the modes in each run.
    eigenvalues : array_like
        1/s.
    """
    predicted = [run.scheme.is_stable(eigenvalues, run.dt) for run in runs]
    bounded = [not _grows(amplitude) for amplitude in modes]
    wrong = [run.dt for run, *both in zip(runs, predicted, bounded) if both[0] != both[1]]
    answer = "Yes: the runs predicted unstable grow, and those predicted stable stay bounded."
    if all(predicted):
        answer = "Yes: all runs were predicted stable, and stay bounded."
    elif not any(predicted):
        answer = "Yes: all runs were predicted unstable, and grow."
    if wrong:
        answer = f"**No**: at {dt_list(wrong)} the run does not do what Question 7 predicts."
    rows = [
        {
            r"$\Delta t$ (s)": f"{run.dt:g}",
            "predicted": "stable" if stable else "unstable",
            "the modes": "stay bounded" if stays else "grow",
            "largest pitch (rad)": _largest(run),
        }
        for run, stable, stays in zip(runs, predicted, bounded)
    ]
    return f"{answer}\n\n{table(rows)}"


def _grows(amplitude):
    """Whether any mode is larger at the end than at the start, by more than roundoff."""
    start, end = np.asarray(amplitude)[:, 0], np.asarray(amplitude)[:, -1]
    return not bool((end <= (1 + ROUNDOFF) * start + ROUNDOFF * start.max()).all())


def _largest(run):
    pitch = np.abs(run.W[2]).max()
    return number(pitch, 2) if math.isfinite(pitch) else "> 10³⁰⁸"


def comparison(first, second, exact):
    """Answer 9(iv), and at equal work: which of two runs is more accurate, with a table.

    Parameters
    ----------
    first, second : Trajectory
    exact : pair of array_like
        Exact pitch at the times of each, rad.
    """
    runs = first, second
    errors = [_errors(run, theta) for run, theta in zip(runs, exact)]
    largest, last = [error.max() for error in errors], [error[-1] for error in errors]
    best = int(largest[1] < largest[0])
    names = [run.scheme.name for run in (runs[best], runs[1 - best])]
    sentence = (
        f"{names[0]} is more accurate than {names[1]}: its largest error is smaller by a factor of "
        f"{number(largest[1 - best] / largest[best])}."
    )
    if last[best] > last[1 - best]:
        sentence += " At the one instant at the end it happens to be the other way round."
    rows = [
        {
            "method": run.scheme.name,
            r"$\Delta t$ (s)": f"{run.dt:g}",
            "evaluations": str(evaluations(run.scheme, len(run.T) - 1)),
            "largest error (rad)": number(error.max()),
            r"error at $t_\text{final}$ (rad)": number(error[-1]),
        }
        for run, error in zip(runs, errors)
    ]
    return f"{sentence}\n\n{table(rows)}"


def _errors(run, exact):
    """Of the pitch at every time, rad."""
    return np.abs(run.W[2] - exact)


def won_back(first, second, finer, exact):
    """What a method wins back by shorter steps, as the answer to a prediction.

    Parameters
    ----------
    first, second : Trajectory
        Two methods at the same step.
    finer : Trajectory
        The second method at a shorter step.
    exact : pair of array_like
        Exact pitch at the times of the first two and of the last, rad.
    """
    goal, before = (_errors(run, exact[0]).max() for run in (first, second))
    now = _errors(finer, exact[1]).max()
    times, order = round(second.dt / finer.dt), second.scheme.order
    promise = f"The step is {times} times shorter, and a method of order {order} promises "
    promise += f"${times}^{order} = {times**order}$"
    if now <= goal:
        return f"**All of it.** {promise}; here that is enough."
    if abs(before / now / times**order - 1) < AS_PROMISED:
        return f"**A factor of {number(before / now, 2)}.** {promise}."
    return (
        f"**A factor of {number(before / now, 2)}.** {promise}; these steps are still too long "
        "for it."
    )
