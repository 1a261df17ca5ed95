"""Sentences and tables about the wheels' contact in sampled runs: Questions 6 and 10."""

import numpy as np

from suspension.forces import WHEEL
from suspension.problem import DISTANCE
from suspension.report.rows import table, verdict
from suspension.report.words import (
    SPACE,
    Caption,
    count,
    fixed,
    join,
    quantity,
    seconds,
    speed_list,
)

__all__ = [
    "change_words",
    "forces_caption",
    "forces_plot",
    "later",
    "lost_phrase",
    "lost_sentence",
    "same_verdicts",
    "spring_sentence",
    "table_note",
    "verdict_table",
]

FEELS = "../notebooks/01-regression.ipynb#which-stiffness-does-the-robot-feel"


def lost_phrase(runs):
    """At which of the tried speeds contact is lost, within a sentence.

    Parameters
    ----------
    runs : sequence of Trajectory
    """
    speeds = [run.v for run in runs if run.loss]
    if not speeds:
        return f"contact is lost at none of the {count(len(runs), 'speed')}"
    return f"contact is lost at v = {speed_list(speeds)}"


def lost_sentence(runs):
    """At which of the tried speeds contact is lost; arguments as in `lost_phrase`."""
    lost = sum(run.loss is not None for run in runs)
    phrase = "C" + lost_phrase(runs)[1:]
    if lost == 0:
        return f"{phrase}: both wheels press on the ground all the way."
    if lost == len(runs):
        return f"{phrase}, at every one of the {count(len(runs), 'speed')}."
    return f"{phrase}, and at no other of the {count(len(runs), 'speed')}."


def verdict_table(runs, compression):
    """A row for each run.

    Parameters
    ----------
    runs : sequence of Trajectory
    compression : sequence of float
        Largest compression of a spring in each while both wheels press, over delta_max.
    """
    return table([verdict(run, ratio) for run, ratio in zip(runs, compression, strict=True)])


def table_note(runs):
    """What the forces in a verdict table are, and by how much contact is kept."""
    kept = [run for run in runs if run.loss is None]
    sentences = []
    if len(kept) < len(runs):
        sentences.append(
            "“After” is after the first loss, where the linear model lets the ground pull: such a "
            "number is no force, and how negative it is says nothing about the real robot."
        )
    if kept:
        margins = join(f"{fixed(run.N.min(), 2)}{SPACE}N at {speed_list([run.v])}" for run in kept)
        sentences.append(
            f"Where contact is kept the smaller of the two is the margin: {margins}. The further "
            "it is from zero, the less a numerical error, another spring or a heavier load could "
            "turn the verdict."
        )
    return " ".join(sentences)


def spring_sentence(runs, compression, robot, fit):
    """On which spring the verdicts rest: its stiffness, and how far beyond the measured range.

    Parameters
    ----------
    runs, compression
        As in `verdict_table`.
    robot : Robot
    fit : SpringFit
    """
    rests = (
        "All verdicts rest on the asked stiffness, the slope of the parabola at zero, "
        f"$k$ = {quantity(robot.k1, 'N/m')} ([which stiffness the robot feels]({FEELS}))"
    )
    if not fit.linearity().linear:
        rests += ", and on a linear spring, which the data contradict"
    beyond = [(run.v, ratio) for run, ratio in zip(runs, compression) if ratio > 1]
    if not beyond:
        return (
            f"{rests}. Up to each verdict no spring is compressed further than "
            r"$\delta_{\max}$, as far as it was measured."
        )
    speeds = speed_list([v for v, _ in beyond])
    ratios = join(fixed(ratio, 2) for _, ratio in beyond)
    order = ", in this order" if len(beyond) > 1 else ""
    return (
        f"{rests}. At {speeds} they hold **if the spring stays linear** beyond where it was "
        f"measured: until the verdict is reached a spring is compressed to {ratios} times "
        rf"$\delta_{{\max}}${order}.{_at_rest(robot, fit.delta_max)}"
    )


def _at_rest(robot, delta_max):
    """A sentence if the springs are compressed beyond `delta_max` even at rest, else nothing."""
    heave, _, pitch, _ = robot.equilibrium
    ratio = -(heave + robot.arms * pitch).min() / delta_max
    if ratio <= 1:
        return ""
    return f" Even at rest one is compressed to {fixed(ratio, 2)} times $\\delta_{{\\max}}$."


def later(runs, longer):
    """Whether the end of the runs decided a verdict.

    Parameters
    ----------
    runs, longer : sequence of Trajectory
        The same runs, and each continued further.
    """
    pairs = list(zip(runs, longer, strict=True))
    end = f"$X$ = {DISTANCE:g} m"
    extra = quantity(min(more.T[-1] - run.T[-1] for run, more in pairs), "s", 2)
    kept = [(run, more) for run, more in pairs if run.loss is None]
    turned = [run.v for run, more in kept if more.loss]
    if not kept:
        return (
            "Contact is lost on the way at every speed, so nothing that comes after "
            f"{end} can change a verdict."
        )
    if turned:
        return (
            f"**The end of the run decides:** continued for another {extra} beyond {end}, "
            f"contact is lost at {speed_list(turned)} as well."
        )
    deeper = [run.v for run, more in kept if more.N.min() < run.N.min() - 0.005]
    margins = (
        f", though the least force becomes smaller at {speed_list(deeper)}"
        if deeper
        else ", and no least force becomes smaller"
    )
    return f"After {end} no verdict changes: the runs were continued for {extra}{margins}."


def forces_caption(question, runs):
    """Caption of the normal forces, a panel for each run; `question` is ``"6(ii)"``."""
    dts = join(dict.fromkeys(f"{run.dt:g}" for run in runs))
    lost = [run for run in runs if run.loss]
    if lost:
        speeds = speed_list([run.v for run in lost])
        grey = (
            f"After the first loss of contact (×, at {speeds}) the linear model lets the ground "
            "pull; that part is greyed out."
        )
    else:
        grey = "Both forces stay positive at every speed: contact is kept."
    text = (
        f"**Question {question}.** Normal forces by {runs[0].scheme.name}, "
        rf"$\Delta t$ = {dts}{SPACE}s. {grey}"
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


def forces_plot(runs, page, name):
    """Where the plots of the normal forces are: a page of ``notebooks/`` and a figure's label."""
    link = f"[the normal forces by {runs[0].scheme.name}](../notebooks/{page}.ipynb#{name})"
    return f"{count(len(runs), 'plot').capitalize()}, one for each speed: {link}."


def same_verdicts(runs, others):
    """Whether contact is lost at the same speeds in two sets of runs."""
    return all((a.loss is None) == (b.loss is None) for a, b in zip(runs, others, strict=True))


def change_words(runs, others):
    """By how much the wheels' least forces differ between two sets of runs."""
    pairs = zip(runs, others, strict=True)
    largest = max(np.abs(a.N.min(axis=1) - b.N.min(axis=1)).max() for a, b in pairs)
    return f"at most {quantity(largest, 'N', 2)}"
