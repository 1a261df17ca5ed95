"""Sentences and tables about the wheels' contact in sampled runs: Questions 6 and 10."""

import numpy as np

from suspension.forces import WHEEL
from suspension.report.rows import table, verdict
from suspension.report.words import (
    SPACE,
    Caption,
    count,
    fixed,
    quantity,
    seconds,
    speed_list,
)

__all__ = [
    "contact",
    "forces_caption",
    "forces_link",
    "later",
    "lost_sentence",
    "same_at_half_the_step",
    "same_by_another_scheme",
    "spring_sentence",
    "table_note",
    "verdict_table",
]

FEELS = "../notebooks/01-regression.ipynb#which-stiffness-does-the-robot-feel"
QUESTION_6 = "../notebooks/02-crank-nicolson.ipynb#question-6-over-the-bump"


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


def same_at_half_the_step(runs, halved):
    """Answer 6(iii): where contact is lost at half the step, and whether the conclusions change."""
    change = "do not change" if _lost(runs) == _lost(halved) else "**change**"
    sentence = (
        rf"At $\Delta t$ = {halved[0].dt:g} s {_lost_phrase(halved)}: the conclusions {change}."
    )
    kept = _both_kept(runs, halved)
    if not kept:
        return sentence
    return f"{sentence} Where contact is kept, the least forces move by {_difference(kept)}."


def same_by_another_scheme(runs, others):
    """Answer 10(i): where contact is lost, and whether Part II, `others`, says the same."""
    agree = "agree" if _lost(runs) == _lost(others) else "do **not** agree"
    after = " and of the forces “after” a loss" if any(_lost(runs)) else ""
    kept = _both_kept(runs, others)
    differ = ""
    if kept:
        differ = f"; where contact is kept, the least forces differ by {_difference(kept)}"
    parts = [
        lost_sentence(runs),
        table([verdict(run) for run in runs]),
        f"The verdicts {agree} with those of Part II{differ}. What "
        f"[Question 6]({QUESTION_6}) says of the spring{after} holds here, too.",
    ]
    return "\n\n".join(parts)


def _lost(runs):
    return [run.loss is not None for run in runs]


def _both_kept(runs, others):
    """The pairs of runs that both keep contact; after a loss a least force is no quantity."""
    return [pair for pair in zip(runs, others, strict=True) if not any(_lost(pair))]


def _difference(pairs):
    """By how much the wheels' least forces differ between the runs of each pair."""
    largest = max(np.abs(a.N.min(axis=1) - b.N.min(axis=1)).max() for a, b in pairs)
    return f"at most {quantity(largest, 'N', 2)}"


def _lost_phrase(runs):
    speeds = [run.v for run in runs if run.loss]
    if speeds:
        return f"contact is lost at v = {speed_list(speeds)}"
    if len(runs) == 1:
        return f"contact is kept at v = {speed_list([runs[0].v])}"
    return f"contact is lost at none of the {count(len(runs), 'speed')}"


def lost_sentence(runs):
    """At which of the tried speeds contact is lost; `runs` is a sequence of Trajectory."""
    lost, tried = sum(_lost(runs)), count(len(runs), "speed")
    if lost == 0:
        rest = ": both wheels press on the ground all the way"
    elif len(runs) == 1:
        rest = ""
    else:
        rest = (
            f", at every one of the {tried}"
            if lost == len(runs)
            else (f", and at no other of the {tried}")
        )
    return f"C{_lost_phrase(runs)[1:]}{rest}."


def verdict_table(runs, compression):
    """A row for each run; arguments as in `contact`."""
    return table([verdict(run, ratio) for run, ratio in zip(runs, compression, strict=True)])


def table_note(runs):
    """What the forces in a verdict table are."""
    note = (
        "Where contact is kept, the smaller of the two least forces is the margin. The further it "
        "is from zero, the less can a numerical error, another spring or a heavier load turn the "
        "verdict."
    )
    if any(_lost(runs)):
        note += (
            " “After” is after the first loss, where the linear model lets the ground pull. What "
            "it finds there is no force of the real robot: the table gives only its sign."
        )
    return note


def spring_sentence(runs, compression, robot, fit):
    """On which springs the verdicts rest, and how far beyond the measured range; as `contact`."""
    measured = robot.k1 == robot.k2 == float(fit.stiffness)
    if measured:
        rests = (
            "All verdicts rest on the stiffness of Question 1, the slope of the parabola at zero, "
            f"$k$ = {quantity(robot.k1, 'N/m')} ([which stiffness the robot feels]({FEELS}))"
        )
        if not fit.linearity().linear:
            rests += ", and on a linear spring, which the data contradict"
    else:
        rests = (
            f"All verdicts rest on stiffnesses that were chosen, {stiffnesses(robot)}, not on that "
            f"of Part I, {quantity(fit.stiffness, 'N/m')}"
        )
    beyond = [run.v for run, ratio in zip(runs, compression, strict=True) if ratio > 1]
    ends = "its readings end" if measured else "the readings of Part I end"
    if not beyond:
        return (
            f"{rests}. Up to each verdict no spring is compressed beyond "
            rf"$\delta_{{\max}}$, where {ends}."
        )
    return (
        f"{rests}. At {speed_list(beyond)} they hold **if the spring stays linear**: before the "
        rf"verdict is reached, a spring is compressed beyond $\delta_{{\max}}$, where {ends}."
        f"{_at_rest(robot, fit.delta_max)}"
    )


def stiffnesses(robot, digits=3):
    """The stiffnesses of a robot, in symbols and numbers."""
    if robot.k1 == robot.k2:
        return f"$k_1 = k_2$ = {quantity(robot.k1, 'N/m', digits)}"
    first, second = (quantity(k, "N/m", digits) for k in robot.k)
    return f"$k_1$ = {first} and $k_2$ = {second}"


def _at_rest(robot, delta_max):
    """A sentence if the springs are compressed beyond `delta_max` even at rest, else nothing."""
    ratio = -(robot.equilibrium[0] + robot.arms * robot.equilibrium[2]).min() / delta_max
    if ratio <= 1:
        return ""
    return f" Even at rest one is compressed to {fixed(ratio, 2)} times $\\delta_{{\\max}}$."


def later(runs, longer, distance):
    """Whether the end of the runs, at X = `distance` in m, decided a verdict.

    Parameters
    ----------
    runs, longer : sequence of Trajectory
        The same runs, and each continued further.
    """
    pairs = list(zip(runs, longer, strict=True))
    extra = quantity(min(more.T[-1] - run.T[-1] for run, more in pairs), "s", 2)
    end = f"$X$ = {distance:g} m"
    if all(_lost(runs)):
        return (
            "Contact is lost on the way at every speed, so nothing that comes after "
            f"{end} can change a verdict."
        )
    turned = [run.v for run, more in pairs if more.loss and not run.loss]
    if turned:
        return (
            f"**The end of the run decides:** continued for another {extra} beyond {end}, "
            f"contact is lost at {speed_list(turned)} as well."
        )
    return f"After {end} no verdict changes: the runs were continued for {extra}."


def forces_caption(question, runs):
    """Caption of the normal forces, a panel for each run; `question` is ``"6(ii)"``."""
    lost = [run.v for run in runs if run.loss]
    grey = "Both forces stay positive at every speed: contact is kept."
    if lost:
        grey = (
            f"After the first loss of contact (×, at {speed_list(lost)}) the linear model lets the "
            "ground pull; that part is greyed out."
        )
    text = (
        f"**Question {question}.** Normal forces by {runs[0].scheme.name}, "
        rf"$\Delta t$ = {runs[0].dt:g}{SPACE}s. {grey}"
    )
    panels = " ".join(f"At {run.v:g} m/s {_panel(run)}." for run in runs)
    alt = (
        f"{count(len(runs), 'panel').capitalize()} of the normal forces at the rear and the front "
        f"wheel against time. {panels}"
    )
    return Caption(text, alt)


def _panel(run):
    if run.loss is None:
        return f"contact is kept, the least force is {fixed(run.N.min(), 2)} N"
    wheel = WHEEL[run.loss.wheel]
    return f"the {wheel} wheel loses the ground at {seconds(run.loss.t, run.dt)} s, marked ×"


def forces_link(runs, page, name):
    """Where the plots of the normal forces are: a page of ``notebooks/`` and a figure's label."""
    link = f"[the normal forces by {runs[0].scheme.name}](../notebooks/{page}.ipynb#{name})"
    each = ", one for each speed" if len(runs) > 1 else ""
    return f"{count(len(runs), 'plot').capitalize()}{each}: {link}."
