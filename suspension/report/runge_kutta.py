"""Sentences of Part III: stability of RK4, its right-hand side, and the runs."""

import math

import numpy as np

from suspension.accuracy import evaluations
from suspension.report.rows import error_rows, mode_name, table
from suspension.report.stability import diagram_caption, diagram_link, dt_list, stability_table
from suspension.report.verdicts import (
    change_words,
    forces_caption,
    forces_plot,
    lost_sentence,
    same_verdicts,
    verdict_table,
)
from suspension.report.words import SPACE, Caption, count, fixed, join, number, percent, quantity
from suspension.schemes import RK4

__all__ = [
    "accuracy",
    "agreement",
    "at_rest",
    "beyond_the_limit",
    "contact",
    "equal_work",
    "final_pitch",
    "forces_figure",
    "forces_plots",
    "growth_figure",
    "limit",
    "reach",
    "slopes_caption",
    "stability",
    "stability_figure",
    "stability_plot",
]

PAGE = "03-runge-kutta"
QUESTION_6 = "../notebooks/02-crank-nicolson.ipynb#question-6-over-the-bump"
ROUNDOFF = 1e-9  # a mode whose amplitude grows by less has kept it


def slopes_caption(end, truth):
    """Caption of one long step of RK4, that ends at `end` where the solution is `truth`."""
    off = quantity(100 * abs(end / truth - 1), "%", 2)
    text = (
        "One step of RK4. Each symbol is a place where it looks, each short line the slope it "
        f"finds there; the dashed line has their weighted mean. It ends (star) within {off} of "
        "the exact solution."
    )
    alt = (
        "A curve, the exact solution, with four short slopes at the start, twice in the middle and "
        "at the end of one step, and the dashed straight line of the step, ending near the curve."
    )
    return Caption(text, alt)


def stability_figure(eigenvalues, dts):
    """Caption of the stability diagram."""
    caption = diagram_caption("7(i)", RK4, "region", eigenvalues, dts)
    border = r" The border was found by following $R(z) = e^{i\varphi}$ from $z = 0$."
    return Caption(caption.text + border, caption.alt)


def stability_plot(eigenvalues, dts):
    """Answer 7(i)."""
    return diagram_link(eigenvalues, dts, PAGE, "fig-rk4-stability")


def stability(eigenvalues, dts):
    """Answer 7(ii)."""
    return stability_table(RK4, eigenvalues, dts) + "\n\n" + limit(eigenvalues)


def limit(eigenvalues):
    """The largest stable step, and how far the region of stability reaches."""
    step = quantity(RK4.max_stable_dt(eigenvalues), "s", 4)
    up, left = RK4.max_stable_dt([1j]), RK4.max_stable_dt([-1])
    return (
        f"The largest stable step for this robot is {step}. The region reaches to "
        f"{fixed(up, 4)}i on the imaginary axis ($2\\sqrt2\\,i$) and to {fixed(-left, 4)} on the "
        "real one."
    )


def reach(robot):
    """How good the rule of thumb ``2 sqrt(2) / |lambda|`` for the largest stable step is."""
    z = robot.eigenvalues
    fastest = int(np.abs(z).argmax())
    rule = 2 * math.sqrt(2) / abs(z[fastest])
    true = RK4.max_stable_dt(z)
    if abs(true / rule - 1) < 1e-6:
        verdict = f"For this undamped robot it is exact: {quantity(true, 's')}."
    else:
        more = "longer" if true > rule else "shorter"
        ratio = -z[fastest].real / abs(z[fastest])
        verdict = (
            f"Here the rule gives {quantity(rule, 's')}. It ignores the damping, which tilts the "
            f"points away from the axis (damping ratio {fixed(ratio, 3)}); the true limit, "
            f"{quantity(true, 's')}, is {percent(abs(true / rule - 1))} {more}."
        )
    return (
        "As the step grows the points move away from zero on straight lines. Were the modes "
        "undamped they would climb the imaginary axis, and the height of the region there would "
        rf"set the limit: $\Delta t = 2\sqrt2/\lvert\lambda\rvert_{{\max}}$. {verdict}"
    )


def at_rest(robot, road, output):
    """Answer 8(ii): what `gfunc_linear` returns at equilibrium.

    Parameters
    ----------
    robot : Robot
    road : callable
        ``road(x) -> (H, dHdx)``.
    output : tuple
        ``(wdot, N1, N2)`` of the equilibrium at t = 0 and v = 0.
    """
    wdot, N1, N2 = output
    entries = ", ".join("0" if abs(x) < 1e-12 else number(x) for x in wdot)
    returned = (
        r"At rest on flat ground nothing accelerates, so $\dot w = 0$ is expected. The function "
        rf"returns $\dot w$ = ({entries}), with $N_1$ = {fixed(N1, 4)}{SPACE}N and "
        f"$N_2$ = {fixed(N2, 4)}{SPACE}N, {_share(robot, N1, N2)}."
    )
    return f"{returned} {_residue(robot, road, wdot)}"


def _share(robot, N1, N2):
    weight = robot.m * robot.g
    if abs(N1 - N2) < 1e-6 * weight:
        return "half the weight each"
    return f"together the weight of {quantity(weight, 'N', 4)}"


def _residue(robot, road, wdot):
    """Where what is left of the accelerations comes from: the bump's tail, or roundoff."""
    if np.abs(wdot).max() < 1e-12:
        return "It is as expected."
    height = road(robot.L2)[0]
    tail = robot.k2 * height
    heave, pitch = tail / robot.m, tail * robot.L2 / robot.Izz
    if not np.allclose(wdot[[1, 3]], [heave, pitch], rtol=0.01):
        return "What is left is roundoff, and what the road is not quite flat by."
    return (
        "What is left is not roundoff but the bump: at the front wheel its Gaussian tail is "
        f"$H(L_2)$ = {quantity(height, 'm')} high and adds {quantity(tail, 'N', 2)}, which "
        rf"accounts for $\ddot Y$ = {quantity(heave, 'm/s²')} and $\ddot\theta$ = "
        f"{quantity(pitch, 'rad/s²')}."
    )


def final_pitch(runs, theta):
    """Answer 9(ii): the pitch at the end of each run beside the exact one, `theta` in rad."""
    sentence = f"Final pitch in radians, exact and by {runs[0].scheme.name}:"
    return sentence + "\n\n" + table(error_rows(runs, theta))


def growth_figure(runs, robot):
    """Caption of how the modes of two runs grow or die away."""
    left, right = (_fate(run, robot) for run in runs)
    modes = join(dict.fromkeys(mode_name(robot, k) for k in range(0, 4, 2)))
    text = (
        f"Amplitude of the modes ({modes}) step by step by {runs[0].scheme.name}, computed "
        r"(symbols) and predicted from $\lvert R(\lambda_k\Delta t)\rvert$ (lines). "
        f"Left: {left}. Right: {right}."
    )
    alt = (
        f"Two panels, amplitude of the modes ({modes}) on a logarithmic axis against the step "
        f"number; the computed symbols lie on the straight predicted lines. "
        f"Left: {left}. Right: {right}."
    )
    return Caption(text, alt)


def _fate(run, robot):
    growth = np.abs(run.scheme.stability_function(robot.eigenvalues[::2] * run.dt))
    step = f"at {run.dt:g}{SPACE}s"
    if (growth > 1 + ROUNDOFF).all():
        return f"{step} both modes grow, the run blows up"
    if (growth > 1 + ROUNDOFF).any():
        grows = mode_name(robot, 2 * int(growth.argmax()))
        return f"{step} the {grows} grows and the other mode does not, the run blows up"
    return f"{step} no mode grows"


def agreement(runs, modes, eigenvalues, exact):
    """Answer 9(iii): whether the runs grow where Question 7 says they do.

    Parameters
    ----------
    runs : sequence of Trajectory
    modes : sequence of array_like, shape (n, J+1)
        Amplitudes of the modes in each run.
    eigenvalues : array_like
        1/s.
    exact : float
        Exact pitch at the end, rad.
    """
    predicted = [run.scheme.is_stable(eigenvalues, run.dt) for run in runs]
    bounded = [not _grows(amplitude) for amplitude in modes]
    pairs = list(zip(runs, predicted, bounded))
    if predicted != bounded:
        wrong = [run.dt for run, stable, seen in pairs if stable != seen]
        return f"**No**: at {dt_list(wrong)} the run does not do what Question 7 predicts."
    sentences = []
    if unstable := [run for run, stable, _ in pairs if not stable]:
        largest = join(_largest(run) for run in unstable)
        verb = "grows" if len(unstable) == 1 else "grow"
        sentences.append(
            f"{_the_runs(unstable)}, predicted unstable, {verb} until the largest pitch is "
            f"{largest}{SPACE}rad"
        )
    if stable := [run for run, is_stable, _ in pairs if is_stable]:
        errors = join(number(abs(run.W[2, -1] - exact), 2) for run in stable)
        verb, noun = ("stays", "an error") if len(stable) == 1 else ("stay", "errors")
        ends = "ends" if len(stable) == 1 else "end"
        sentences.append(
            f"{_the_runs(stable)}, predicted stable, {verb} bounded and {ends} with {noun} of "
            f"{errors}{SPACE}rad"
        )
    return f"Yes: {'; '.join(sentences)}."


def _grows(amplitude):
    """Whether any mode is larger at the end than at the start, by more than roundoff."""
    start, end = np.asarray(amplitude)[:, 0], np.asarray(amplitude)[:, -1]
    return not bool((end <= (1 + ROUNDOFF) * start + ROUNDOFF * start.max()).all())


def _largest(run):
    pitch = np.abs(run.W[2]).max()
    return number(pitch, 2) if math.isfinite(pitch) else "more than 10³⁰⁸"


def _the_runs(runs):
    noun = "the run" if len(runs) == 1 else "the runs"
    return f"{noun} with {dt_list([run.dt for run in runs])}"


def accuracy(fourth, second, exact):
    """Answer 9(iv): which of two runs is more accurate, at the end and all the way.

    Parameters
    ----------
    fourth, second : Trajectory
        By RK4 and by Crank-Nicolson, with the same step.
    exact : array_like, shape (J+1,)
        Exact pitch at their times, rad.
    """
    end, largest = _errors((fourth, second), (exact, exact))
    names = fourth.scheme.name, second.scheme.name
    at = rf"At $\Delta t$ = {fourth.dt:g} s"
    return (
        f"{at} {_winner(names, end, largest)} At one instant the factor depends on where in "
        "their swings it finds the two errors; that of the largest errors does not."
    )


def equal_work(fourth, second, exact):
    """Which is more accurate at equal work, counted in evaluations of the right-hand side.

    Parameters
    ----------
    fourth, second : Trajectory
        By RK4, and by Crank-Nicolson with a step for which both evaluate about equally often.
    exact : pair of array_like
        Exact pitch at the times of each, rad.
    """
    end, largest = _errors((fourth, second), exact)
    names = fourth.scheme.name, second.scheme.name
    work = [evaluations(run.scheme, len(run.T) - 1) for run in (fourth, second)]
    return (
        f"With {fourth.dt:g} s {names[0]} evaluates the right-hand side {work[0]} times in this "
        f"run, {names[1]} with {second.dt:g} s {work[1]} times and solves {len(second.T) - 1} "
        f"small systems besides. At this equal work {_winner(names, end, largest)}"
    )


def beyond_the_limit(eigenvalues):
    """What is left beyond the largest stable step of RK4."""
    step = quantity(RK4.max_stable_dt(eigenvalues), "s")
    return (
        f"Beyond its largest stable step, {step}, RK4 is no choice at all, while Crank-Nicolson "
        "still returns a bounded answer; whether that answer is worth having is a question of "
        "accuracy."
    )


def _errors(runs, exact):
    """Errors of two runs at the end and the largest all the way, two pairs."""
    errors = [np.abs(run.W[2] - theta) for run, theta in zip(runs, exact)]
    return [error[-1] for error in errors], [error.max() for error in errors]


def _winner(names, end, largest):
    """Which of two has the smaller error, at the end and over the run, by which factors."""
    best = int(largest[1] < largest[0])
    best_at_end = int(end[1] < end[0])
    overall = (
        f"the largest error of the whole run is {number(largest[best], 2)} rad against "
        f"{number(largest[1 - best], 2)} rad, smaller by a factor of "
        f"{number(largest[1 - best] / largest[best])}"
    )
    last = f"{number(end[best], 2)} rad against {number(end[1 - best], 2)} rad"
    if best != best_at_end:
        return (
            f"{names[best]} is more accurate over the whole run: {overall}. At the one instant "
            rf"$t_\text{{final}}$ it happens to be the other way round: {last}."
        )
    return (
        rf"{names[best]} is more accurate than {names[1 - best]}: at $t_\text{{final}}$ its error "
        f"is {last}, smaller by a "
        f"factor of {number(end[1 - best] / end[best])}, and {overall}."
    )


def forces_figure(runs):
    """Caption of the normal forces."""
    return forces_caption("10(ii)", runs)


def forces_plots(runs):
    """Answer 10(ii)."""
    return forces_plot(runs, PAGE, "fig-rk4-forces")


def contact(runs, others, compression):
    """Answer 10(i): where contact is lost, and whether Part II says the same.

    Parameters
    ----------
    runs, others : sequence of Trajectory
        By RK4, and by Crank-Nicolson.
    compression : sequence of float
        Largest compression of a spring in each while both wheels press, over delta_max.
    """
    agree = "agree" if same_verdicts(runs, others) else "do **not** agree"
    noted = "of the spring"
    if any(run.loss for run in runs):
        noted += " and of the forces “after” a loss"
    parts = [
        lost_sentence(runs),
        verdict_table(runs, compression),
        f"The verdicts {agree} with those of Part II for the {count(len(runs), 'speed')}; the "
        f"least forces differ by {change_words(runs, others)}. What is said {noted} in "
        f"[Question 6]({QUESTION_6}) holds here as well.",
    ]
    return "\n\n".join(parts)
