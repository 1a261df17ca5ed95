"""Sentences about the wheels' contact, for springs, robots and speeds of every kind."""

import re
from functools import cache

import numpy as np
import pytest
from cases import DELTA_MAX, STIFFNESSES, faults, fitted

from suspension.problem import BUMP, DISTANCE, SPEEDS
from suspension.report import verdicts as part
from suspension.report.words import speed_list
from suspension.robot import Robot
from suspension.schemes import CRANK_NICOLSON, RK4
from suspension.simulation import simulate
from suspension.travel import travel

STRAIGHT = fitted(793)
FITTED = float(STRAIGHT.stiffness)
OTHERS = {
    "undamped": Robot(793, 793, c1=0, c2=0),
    "unsymmetric": Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
}
LOST = {250: [], 405: [1.2], 500: [1.2], 793: [1.2, 5], 987: [1.2, 5, 10], 2300: [1.2, 5, 10]}


@cache
def drives(robot, dt=0.001, beyond=0.0, scheme=CRANK_NICOLSON):
    return [
        simulate(robot, BUMP, v=v, dt=dt, tfinal=DISTANCE / v + beyond, scheme=scheme)
        for v in SPEEDS
    ]


@cache
def compressions(robot):
    return [travel(robot, BUMP, v).compression / DELTA_MAX for v in SPEEDS]


def later(runs, longer):
    return part.later(runs, longer, DISTANCE)


@pytest.mark.parametrize("k", LOST)
def test_the_verdict_follows_the_spring(k):
    robot = Robot(k, k)
    runs = drives(robot)
    text = part.contact(runs, compressions(robot), robot, STRAIGHT)
    assert not faults(text)
    first = text.split("\n")[0]
    if LOST[k]:
        assert f"lost at v = {speed_list(LOST[k])}, and at no other" in first
    else:
        assert "lost at none of the four speeds" in first
    rows = [row.split("|") for row in text.split("\n") if row.startswith("| ")][1:]
    assert [float(row[1]) for row in rows if row[2].strip() == "lost"] == LOST[k]


def test_no_loss_and_losses_everywhere():
    kept = drives(Robot(250, 250))
    assert part.lost_sentence(kept).startswith("Contact is lost at none of the four speeds:")
    lost = [drives(Robot(2300, 2300))[i] for i in (1, 2, 3)]
    assert part.lost_sentence(lost).endswith("at every one of the three speeds.")


def test_the_spring_beyond_its_measured_range_is_named():
    robot = Robot(FITTED, FITTED)
    ratios = compressions(robot)
    text = part.contact(drives(robot), ratios, robot, STRAIGHT)
    assert "stiffness of Question 1" in text and "where its readings end" in text
    assert "**if the spring stays linear**" in text and "Even at rest" not in text
    assert "At 1.2, 5 and 10\u00a0m/s they hold" in text
    soft = Robot(250, 250)
    assert "Even at rest" in part.contact(drives(soft), compressions(soft), soft, STRAIGHT)
    text = part.spring_sentence(drives(robot), [0.2] * 4, robot, STRAIGHT)
    assert "no spring is compressed beyond" in text and "if the spring" not in text
    text = part.spring_sentence(drives(robot), [0.2, 0.2, 0.2, 1.5], robot, STRAIGHT)
    assert not faults(text)
    assert "At 10\u00a0m/s they hold" in text


def test_stiffnesses_that_were_chosen_are_not_called_measured():
    runs = drives(Robot(793, 793))
    for robot, told in [
        (Robot(500, 500), "$k_1 = k_2$ = 500\u00a0N/m"),
        (OTHERS["unsymmetric"], "$k_1$ = 700\u00a0N/m and $k_2$ = 900\u00a0N/m"),
        (Robot(FITTED, 900), "and $k_2$ = 900\u00a0N/m"),
    ]:
        for ratios in ([0.2] * 4, [0.2, 1.3, 1.4, 1.5]):
            text = part.spring_sentence(runs, ratios, robot, fitted(793, curvature=4))
            assert "stiffnesses that were chosen" in text and told in text
            assert "stiffness of Question 1" not in text and "contradict" not in text
            assert "where the readings of Part I end" in text
            assert not faults(text)


def test_a_spring_that_is_not_linear_is_named():
    curved = fitted(793, curvature=4)
    robot = Robot(curved.stiffness, curved.stiffness)
    text = part.spring_sentence(drives(robot), [0.2] * 4, robot, curved)
    assert "a linear spring, which the data contradict" in text and not faults(text)
    robot = Robot(FITTED, FITTED)
    text = part.spring_sentence(drives(robot), [0.2] * 4, robot, STRAIGHT)
    assert "contradict" not in text


def test_what_comes_after_a_loss_is_told_only_where_there_is_one():
    runs = drives(Robot(793, 793))
    assert "margin" in part.table_note(runs) and "After" in part.table_note(runs)
    assert "After" not in part.table_note([runs[0]])


def test_one_speed_reads_well():
    runs = drives(Robot(793, 793))
    assert part.lost_sentence([runs[1]]) == "Contact is lost at v = 1.2\u00a0m/s."
    kept = "Contact is kept at v = 0.25\u00a0m/s: both wheels press on the ground all the way."
    assert part.lost_sentence([runs[0]]) == kept
    assert part.forces_link([runs[0]], "page", "fig").startswith("One plot: ")


def test_another_scheme_agrees_or_is_told_not_to():
    for robot in (Robot(793, 793), Robot(250, 250), *OTHERS.values()):
        runs, others = drives(robot, scheme=RK4), drives(robot)
        text = part.same_by_another_scheme(runs, others)
        assert not faults(text)
        assert "The verdicts agree with those of Part II" in text
        assert ("“after” a loss" in text) == any(run.loss for run in runs)
        assert ("; where contact is kept, the least forces differ" in text) == (
            not all(run.loss for run in runs)
        )
    other = drives(Robot(987, 987))
    text = part.same_by_another_scheme(drives(Robot(793, 793)), other)
    assert "do **not** agree" in text
    lost = part.same_by_another_scheme(drives(Robot(2300, 2300))[1:], other[1:])
    assert "agree with those of Part II. What" in lost and "differ" not in lost


@pytest.mark.parametrize("k", [250, 793, 2300])
def test_half_the_step(k):
    robot = Robot(k, k)
    runs, halved = drives(robot), drives(robot, 0.0005)
    text = part.same_at_half_the_step(runs, halved)
    assert not faults(text)
    assert "do not change" in text
    assert (f"lost at v = {speed_list(LOST[k])}: " in text) == bool(LOST[k])
    lost = [pair for pair in zip(runs, halved) if pair[0].loss]
    assert ("Where contact is kept" in text) == (len(lost) < len(runs))
    if lost:
        assert "Where contact is kept" not in part.same_at_half_the_step(*zip(*lost))
    changed = part.same_at_half_the_step(drives(Robot(793, 793)), drives(Robot(987, 987)))
    assert "the conclusions **change**" in changed


def test_how_far_the_least_forces_move_is_told_of_what_is_kept_alone():
    runs = drives(Robot(793, 793))
    others = {
        part.same_at_half_the_step: drives(Robot(793, 793), 0.0005),
        part.same_by_another_scheme: drives(Robot(793, 793), scheme=RK4),
    }
    for sentence, compared in others.items():
        (told,) = re.findall(r"at most ([\d.]+)", sentence(runs, compared))
        kept = [(a, b) for a, b in zip(runs, compared) if not a.loss]
        moved = max(np.abs(a.N.min(axis=1) - b.N.min(axis=1)).max() for a, b in kept)
        assert float(told) == pytest.approx(moved, rel=0.05)


def test_no_table_gives_the_tenths_of_a_force_after_a_loss():
    runs = drives(Robot(793, 793))
    text = part.verdict_table(runs, compressions(Robot(793, 793)))
    assert "< 0 (after)" in text and "−" not in text
    assert "only its sign" in part.table_note(runs)


@pytest.mark.parametrize("k", STIFFNESSES)
def test_nothing_changes_after_the_course(k):
    robot = Robot(k, k)
    text = later(drives(robot), drives(robot, beyond=1.5))
    assert not faults(text)
    assert text.startswith("After $X$ = 1.25 m no verdict changes")
    assert "1.5\u00a0s" in text


def test_what_would_change_after_the_course_is_told():
    kept, lost = drives(Robot(250, 250)), drives(Robot(793, 793))
    text = later(kept, lost[:2] + kept[2:])
    assert text.startswith("**The end of the run decides:**") and "1.2\u00a0m/s as well" in text
    assert "at every speed" in later(lost[1:3], kept[1:3])


@pytest.mark.parametrize("k", STIFFNESSES)
def test_the_caption_of_the_forces_says_what_is_seen(k):
    runs = drives(Robot(k, k))
    caption = part.forces_caption("6(ii)", runs)
    assert not faults(caption.text) and not faults(caption.alt)
    lost = [run.v for run in runs if run.loss]
    assert ("greyed out" in caption.text) == bool(lost)
    assert caption.alt.count("loses the ground") == len(lost)
    assert not faults(part.forces_link(runs, "page", "fig"))


def test_every_robot_gets_its_verdict():
    for robot in OTHERS.values():
        text = part.contact(drives(robot), compressions(robot), robot, STRAIGHT)
        assert not faults(text)
        assert not faults(later(drives(robot), drives(robot, beyond=1.5)))


def test_the_end_of_the_way_is_the_one_that_was_driven():
    kept, lost = drives(Robot(250, 250)), drives(Robot(793, 793))
    for runs, longer in [(kept, kept[:1] + lost[1:]), (lost[1:3], kept[1:3])]:
        text = part.later(runs, longer, 3.5)
        assert "$X$ = 3.5 m" in text and "1.25" not in text
