"""Sentences of Part II: the matrix, its modes, and the runs by Crank-Nicolson."""

import numpy as np

from suspension.report.rows import error_rows, matrix_rows, mode_name, mode_rows, table
from suspension.report.stability import diagram_caption, diagram_link, stability_table
from suspension.report.verdicts import (
    change_words,
    forces_caption,
    forces_plot,
    later,
    lost_phrase,
    lost_sentence,
    same_verdicts,
    spring_sentence,
    table_note,
    verdict_table,
)
from suspension.report.words import (
    SPACE,
    Caption,
    count,
    fixed,
    join,
    number,
    percent,
    quantity,
    seconds,
)
from suspension.schemes import CRANK_NICOLSON, EULER, RK4

__all__ = [
    "coarse_caption",
    "contact",
    "contact_at_half_the_step",
    "eigenvalues",
    "final_pitch",
    "forces_figure",
    "forces_plots",
    "frame_caption",
    "halving",
    "later",
    "matrix",
    "modes",
    "phase_error",
    "road_caption",
    "stability",
    "stability_figure",
    "stability_plot",
    "swing",
]

PAGE = "02-crank-nicolson"
LIGHT = 0.2  # a damping ratio below it is called light
APPRECIABLE = 0.01  # a change by less than this part of the largest pitch is not
AS_EXPECTED = 0.05  # how far, relatively, an observed factor may be from the promised one


def matrix(robot):
    """Answer 3(i): the entries of A."""
    if robot.k1 == robot.k2:
        springs = f"$k_1 = k_2$ = {quantity(robot.k1, 'N/m', 4)}"
    else:
        springs = f"$k_1$ = {number(robot.k1, 4)} and $k_2$ = {quantity(robot.k2, 'N/m', 4)}"
    sentence = f"With {springs} from Part I, row $i$ and column $j$ of $A$ hold"
    return sentence + "\n\n" + table(matrix_rows(robot.A))


def eigenvalues(robot):
    """Answer 3(ii): the eigenvalues of A, and which mode each belongs to."""
    pairs = int((robot.eigenvalues.imag > 0).sum())
    kinds = {
        2: "two conjugate pairs, one for each mode",
        1: "one conjugate pair, a mode that swings, and two real numbers, a mode that creeps back",
        0: "four real numbers: neither mode swings",
    }
    return f"The eigenvalues are {kinds[pairs]}:\n\n{table(mode_rows(robot))}"


def modes(robot):
    """What the eigenvalues mean for what follows: damping, and the mode that limits the step."""
    z = robot.eigenvalues
    ratios = -z.real / np.abs(z)
    shown = sorted({fixed(ratio, 3) for ratio in ratios})
    ratio = f"damping ratio{'s' if len(shown) > 1 else ''} {join(shown)}"
    if ratios.max() < 1e-9:
        damping = "The robot is *undamped*: the eigenvalues lie on the imaginary axis."
    elif ratios.max() < LIGHT:
        damping = (
            f"The robot is *lightly* damped ({ratio}): the eigenvalues lie close to the imaginary "
            "axis."
        )
    else:
        damping = f"The damping is not light ({ratio}): the eigenvalues lie off the imaginary axis."
    up, left = RK4.max_stable_dt([1j]), RK4.max_stable_dt([-1])
    explicit = (
        "On that axis explicit methods differ most: "
        f"{EULER.name}'s method is unstable there at every step, RK4 is stable up to "
        f"{fixed(up, 2)}i, a little further than the {fixed(left, 2)} it reaches along the "
        "negative real axis."
    )
    fast = mode_name(robot, int(np.abs(z).argmax()))
    slow = mode_name(robot, int(np.abs(z).argmin()))
    if fast == slow:
        limit = "Both modes mix heave and pitch, and the faster of the two limits the step."
    else:
        limit = f"And {fast} is the faster mode, so it is {fast} that limits the step."
    return " ".join([damping, explicit, limit])


def road_caption(speeds):
    """Caption of what a wheel feels of the bump at two speeds, m/s."""
    slow, fast = sorted(speeds)
    more = number(fast / slow, 2)
    text = (
        f"What a wheel feels of the bump at {slow:g} and at {fast:g}{SPACE}m/s: the height (left) "
        f"and its rate of change (right). With {more} times the speed the height passes in "
        f"1/{more} of the time, and the rate is {more} times as large."
    )
    alt = (
        "Two panels against time. Left, the height under a wheel: a hill for each speed, equally "
        f"high, that at {fast:g} m/s narrower. Right, its rate, up and down: at {fast:g} m/s "
        "narrower and larger."
    )
    return Caption(text, alt)


def coarse_caption(run):
    """Caption of the pitch by very long steps beside the exact one."""
    many = count(len(run.T) - 1, "step")
    text = (
        f"The pitch in {many} of {quantity(run.dt, 's')} by {run.scheme.name} (dots, joined for "
        "the eye), and the exact one (line)."
    )
    alt = (
        f"Pitch against time: the exact curve, and {many} by {run.scheme.name}, whose dots do "
        "not lie on it."
    )
    return Caption(text, alt)


def frame_caption(run, t):
    """Caption of the robot with its front wheel on the top of the bump."""
    text = (
        f"The robot at {run.v:g}{SPACE}m/s with its front wheel on the top of the bump, "
        f"{seconds(t, run.dt)}{SPACE}s after the start."
    )
    alt = (
        "The robot in true proportions over the bump, with its front wheel on the top and its rear "
        "wheel on the flat ground behind."
    )
    return Caption(text, alt)


def stability_figure(eigenvalues, dts):
    """Caption of the stability diagram."""
    return diagram_caption("4(i)", CRANK_NICOLSON, "left half-plane", eigenvalues, dts)


def stability_plot(eigenvalues, dts):
    """Answer 4(i)."""
    return diagram_link(eigenvalues, dts, PAGE, "fig-cn-stability")


def stability(eigenvalues, dts):
    """Answer 4(ii)."""
    return stability_table(CRANK_NICOLSON, eigenvalues, dts)


def swing(robot, dt):
    """How much of the fastest swing one step of `dt` seconds takes."""
    stable = CRANK_NICOLSON.is_stable(robot.eigenvalues, dt)
    start = "Stable does not mean accurate." if stable else "Not even stable."
    fastest = int(robot.eigenvalues.imag.argmax())
    frequency = robot.eigenvalues.imag[fastest]
    if frequency == 0:
        return f"{start} None of the modes swings, so a step of {dt:g} s can only be too coarse."
    part = dt * frequency / (2 * np.pi)
    if part > 0.25:
        value = "what the method computes there is bounded, and wrong"
    else:
        value = "the swing is still followed, coarsely"
    return (
        f"{start} A step of {quantity(dt, 's', 1)} spans {number(part, 2)} swings of the "
        f"{mode_name(robot, fastest)}: {value}. "
        "[Part IV](../notebooks/04-accuracy.ipynb) measures how wrong."
    )


def final_pitch(runs, theta):
    """Answer 5(ii): the pitch at the end of each run beside the exact one, `theta` in rad."""
    sentence = f"Final pitch in radians, exact and by {runs[0].scheme.name}:"
    return sentence + "\n\n" + table(error_rows(runs, theta))


def halving(runs, exact):
    """Answer 5(iii): whether the result changes, and whether the error falls as it should.

    Parameters
    ----------
    runs : pair of Trajectory
        With a step, and with half of it.
    exact : pair of array_like
        Exact pitch at the times of each, rad.
    """
    coarse, fine = (run.W[2] - theta for run, theta in zip(runs, exact))
    expected = 2 ** runs[0].scheme.order
    at_end = abs(coarse[-1] / fine[-1])
    overall = np.abs(coarse).max() / np.abs(fine).max()
    part = abs(coarse[-1]) / np.abs(coarse).max()
    return f"{_change(runs)} {_factor(at_end, overall, part, expected)}"


def _change(runs):
    change = abs(runs[1].W[2, -1] - runs[0].W[2, -1])
    relative = change / np.abs(runs[1].W[2]).max()
    verdict = "no" if relative < APPRECIABLE else "yes"
    return (
        f"*Does it change appreciably? {verdict.capitalize()}*: halving the step changes "
        rf"$\tilde\theta(t_\text{{final}})$ by {quantity(change, 'rad', 2)}, "
        f"{percent(relative)} of the largest pitch and "
        f"{percent(change / abs(runs[1].W[2, -1]))} of the value at that instant. The first is "
        "the yardstick: the pitch swings through zero, and beside a value near zero every change "
        "looks large."
    )


def _factor(at_end, overall, part, expected):
    """Whether the error falls by the expected factor, at the end and over the whole run."""
    end_fits = abs(at_end / expected - 1) <= AS_EXPECTED
    run_fits = abs(overall / expected - 1) <= AS_EXPECTED
    question = "*Does the error decrease by the expected factor?"
    promise = f"a method of second order promises {expected}"
    end = rf"at $t_\text{{final}}$ it falls by a factor of {fixed(at_end, 2)}"
    run = f"the largest error of the whole run by {fixed(overall, 3)}"
    if end_fits and run_fits:
        return f"{question} Yes*: {end}, {run}; {promise}."
    if run_fits:
        return (
            f"{question} Yes, over the whole run*: {run}, where {promise}. The one instant "
            rf"misleads: {end}, because there the error happens to be only {percent(part)} "
            "of its largest value."
        )
    if end_fits:
        return f"{question} Not over the whole run*: {end}, but {run}; {promise}."
    return f"{question} No*: {end} and {run}, where {promise}; the steps are too long for that."


def phase_error(robot, run, exact):
    """When the error of the pitch is largest: between a growing lag and a swing that dies away.

    Parameters
    ----------
    robot : Robot
    run : Trajectory
        On flat ground, let go with a tilt.
    exact : array_like, shape (J+1,)
        Exact pitch at its times, rad.
    """
    pitch = [k for k in range(4) if mode_name(robot, k) == "pitch"]
    decay = -robot.eigenvalues[pitch[0]].real
    error = np.abs(run.W[2] - exact)
    found = (
        rf"the largest error of the run with $\Delta t$ = {run.dt:g}{SPACE}s is "
        f"{quantity(error.max(), 'rad')}, at {fixed(run.T[error.argmax()], 2)}{SPACE}s"
    )
    if decay < 1e-9:
        return f"Here nothing dies away, and the error grows to the end: {found}."
    end = quantity(run.T[-1], "s", 1)
    if decay * run.T[-1] < 1:
        return rf"Here $1/\beta$ is longer than the {end} of the run, and the lag wins: {found}."
    return (
        rf"Here $1/\beta$ = {fixed(1 / decay, 2)}{SPACE}s, and {found}. At {end} it is "
        f"{quantity(error[-1], 'rad')}."
    )


def forces_figure(runs):
    """Caption of the normal forces."""
    return forces_caption("6(ii)", runs)


def forces_plots(runs):
    """Answer 6(ii)."""
    return forces_plot(runs, PAGE, "fig-cn-forces")


def contact(runs, compression, robot, fit):
    """Answer 6(i): where contact is lost, the verdict table, and on what it rests.

    Parameters
    ----------
    runs : sequence of Trajectory
    compression : sequence of float
        Largest compression of a spring in each while both wheels press, over delta_max.
    robot : Robot
    fit : SpringFit
    """
    parts = [
        lost_sentence(runs),
        verdict_table(runs, compression),
        spring_sentence(runs, compression, robot, fit),
        table_note(runs),
    ]
    return "\n\n".join(parts)


def contact_at_half_the_step(runs, halved, compression):
    """Answer 6(iii): the same at half the step, and whether the conclusions change."""
    change = "do not change" if same_verdicts(runs, halved) else "**change**"
    sentence = (
        rf"At $\Delta t$ = {halved[0].dt:g} s {lost_phrase(halved)}: the conclusions {change}. "
        f"The least forces move by {change_words(runs, halved)}:"
    )
    return sentence + "\n\n" + verdict_table(halved, compression)
