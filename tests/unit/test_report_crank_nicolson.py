"""Sentences of Part II, for springs and robots of every kind."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from cases import DELTA_MAX, STIFFNESSES, faults, fitted

from suspension import exact
from suspension.report import crank_nicolson as part
from suspension.report import verdicts
from suspension.report.words import speed_list
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import CRANK_NICOLSON
from suspension.simulation import simulate
from suspension.travel import travel

BUMP = GaussianBump()
STRAIGHT = fitted(793)
ROBOTS = {f"k = {k}": Robot(k, k) for k in STIFFNESSES} | {
    "undamped": Robot(793, 793, c1=0, c2=0),
    "unsymmetric": Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
    "overdamped": Robot(5, 5, c1=20, c2=20),
    "one mode overdamped": Robot(50, 50, c1=11, c2=11),
}
SPEEDS = (0.25, 1.2, 5, 10)
DTS = (0.2, 0.1, 0.001)
each_robot = pytest.mark.parametrize("name", ROBOTS)
LOST = {250: [], 405: [1.2], 500: [1.2], 793: [1.2, 5], 987: [1.2, 5, 10], 2300: [1.2, 5, 10]}


@cache
def drives(robot, dt=0.001, beyond=0.0):
    return [
        simulate(robot, BUMP, v=v, dt=dt, tfinal=1.25 / v + beyond, scheme=CRANK_NICOLSON)
        for v in SPEEDS
    ]


@cache
def compressions(robot):
    return [travel(robot, BUMP, v).compression / DELTA_MAX for v in SPEEDS]


def released(robot, dt):
    """A run from a tilt of 0.1 rad, and the exact pitch at its times."""
    w0 = [0, 0, 0.1, 0]
    run = simulate(robot, BUMP, v=0, dt=dt, tfinal=2, scheme=CRANK_NICOLSON, w0=w0)
    return run, exact.flat_ground(robot, w0, run.T)[2]


@each_robot
@pytest.mark.parametrize("sentence", [part.matrix, part.eigenvalues, part.modes])
def test_sentences_about_the_robot_are_sound(name, sentence):
    assert not faults(sentence(ROBOTS[name]))


@each_robot
def test_sentences_about_stability_are_sound(name):
    robot = ROBOTS[name]
    z = robot.eigenvalues
    texts = [part.stability_plot(z, DTS), part.stability(z, DTS), *part.stability_figure(z, DTS)]
    texts += [part.swing(robot, dt) for dt in DTS]
    assert not [fault for text in texts for fault in faults(text)]


def test_the_kinds_of_eigenvalues():
    assert "two conjugate pairs" in part.eigenvalues(ROBOTS["k = 793"])
    assert "one conjugate pair" in part.eigenvalues(ROBOTS["one mode overdamped"])
    assert "four real numbers" in part.eigenvalues(ROBOTS["overdamped"])


def test_the_kinds_of_damping():
    assert "*lightly* damped (damping ratios 0.031 and 0.037)" in part.modes(ROBOTS["k = 793"])
    assert "*undamped*" in part.modes(ROBOTS["undamped"])
    assert "not light" in part.modes(ROBOTS["overdamped"])


def test_the_faster_mode_limits_the_step():
    assert "it is pitch that limits" in part.modes(ROBOTS["k = 793"])
    assert "it is heave that limits" in part.modes(replace(ROBOTS["k = 793"], Izz=0.05))


def test_the_caption_says_where_the_points_lie():
    damped, undamped = ROBOTS["k = 793"].eigenvalues, 30j * np.array([1, -1, 1.2, -1.2])
    place = "all lie inside at 0.2, 0.1 and 0.001\u00a0s"
    assert place in part.stability_figure(damped, DTS).text
    assert place in part.stability_figure(damped, DTS).alt
    assert "all lie on its border" in part.stability_figure(undamped, DTS).text


@pytest.mark.parametrize("k", STIFFNESSES)
def test_halving_the_step_answers_yes_or_no(k):
    runs, theta = zip(*(released(Robot(k, k), dt) for dt in (0.001, 0.0005)))
    text = part.halving(runs, theta)
    assert not faults(text)
    assert "appreciably? No*" in text
    assert "expected factor? Yes" in text
    assert not faults(part.final_pitch(runs, theta[0][-1]))


def test_a_change_is_held_against_the_largest_pitch_and_against_its_value():
    runs, theta = zip(*(released(Robot(793, 793), dt) for dt in (0.001, 0.0005)))
    text = part.halving(runs, theta)
    change, value = abs(runs[0].W[2, -1] - runs[1].W[2, -1]), abs(runs[1].W[2, -1])
    of_largest, of_value = re.search(
        r"([\d.]+)\s% of the largest .* ([\d.]+)\s% of the value", text
    ).groups()
    assert float(of_largest) == pytest.approx(1000 * change, rel=0.02)
    assert float(of_value) == pytest.approx(100 * change / value, rel=0.02)


@pytest.mark.parametrize("k", STIFFNESSES)
def test_the_error_is_largest_where_the_lag_has_grown_and_the_swing_not_yet_died_away(k):
    robot = Robot(k, k)
    run, theta = released(robot, 0.001)
    text = part.phase_error(robot, run, theta)
    assert not faults(text)
    predicted, found = map(
        float, re.findall(r"([\d.]+)\ss\b(?! is)", text.replace("0.001", ""))[:2]
    )
    assert predicted == pytest.approx(robot.Izz / robot.c1 / robot.L1**2, abs=0.005)
    assert abs(found - predicted) < 0.5 * np.pi / robot.eigenvalues.imag.max()


def test_without_enough_damping_the_lag_wins():
    robot = ROBOTS["undamped"]
    run, theta = released(robot, 0.001)
    assert "nothing dies away" in part.phase_error(robot, run, theta)
    robot = Robot(793, 793, c1=0.3, c2=0.3)
    run, theta = released(robot, 0.001)
    text = part.phase_error(robot, run, theta)
    assert "the lag wins" in text and not faults(text)


def test_one_instant_is_told_from_the_whole_run():
    """At 808 N/m the error at 2 s is nearly zero, and falls by a factor of 2.6 only."""
    runs, theta = zip(*(released(Robot(808, 808), dt) for dt in (0.001, 0.0005)))
    text = part.halving(runs, theta)
    assert "Yes, over the whole run*" in text
    assert "The one instant misleads" in text
    assert "2.65" in text and "4.000" in text


def test_steps_too_long_for_the_order_are_told():
    runs, theta = zip(*(released(Robot(793, 793), dt) for dt in (0.2, 0.1)))
    text = part.halving(runs, theta)
    assert "appreciably? Yes*" in text
    assert "expected factor? No*" in text


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
    robot = Robot(793, 793)
    text = part.contact(drives(robot), compressions(robot), robot, STRAIGHT)
    assert "**if the spring stays linear**" in text
    assert "1.39, 2.00 and 2.10 times" in text
    assert "At 1.2, 5 and 10\u00a0m/s they hold" in text
    assert "793\u00a0N/m" in text and "Even at rest" not in text
    soft = Robot(250, 250)
    assert "Even at rest" in part.contact(drives(soft), compressions(soft), soft, STRAIGHT)
    text = verdicts.spring_sentence(drives(robot), [0.2] * 4, robot, STRAIGHT)
    assert "no spring is compressed further" in text and "if the spring" not in text
    text = verdicts.spring_sentence(drives(robot), [0.2, 0.2, 0.2, 1.5], robot, STRAIGHT)
    assert not faults(text)
    assert "At 10\u00a0m/s they hold" in text and "in this order" not in text


def test_a_spring_that_is_not_linear_is_named():
    robot = Robot(793, 793)
    text = verdicts.spring_sentence(drives(robot), [0.2] * 4, robot, fitted(793, curvature=4))
    assert "a linear spring, which the data contradict" in text and not faults(text)
    text = verdicts.spring_sentence(drives(robot), [0.2] * 4, robot, STRAIGHT)
    assert "contradict" not in text


def test_a_margin_is_named_only_where_contact_is_kept():
    note = part.table_note(drives(Robot(793, 793)))
    assert "5.59\u00a0N at 0.25\u00a0m/s and 1.75\u00a0N at 10\u00a0m/s" in note
    assert "margin" not in part.table_note([drives(Robot(793, 793))[1]])
    assert "After" not in part.table_note([drives(Robot(793, 793))[0]])


@pytest.mark.parametrize("k", [250, 793, 2300])
def test_half_the_step(k):
    robot = Robot(k, k)
    text = part.contact_at_half_the_step(drives(robot), drives(robot, 0.0005), compressions(robot))
    assert not faults(text)
    assert "do not change" in text
    other = drives(Robot(987, 987))
    changed = part.contact_at_half_the_step(drives(Robot(793, 793)), other, compressions(robot))
    assert "the conclusions **change**" in changed


@pytest.mark.parametrize("k", STIFFNESSES)
def test_nothing_changes_after_the_course(k):
    robot = Robot(k, k)
    text = part.later(drives(robot), drives(robot, beyond=1.5))
    assert not faults(text)
    assert text.startswith("After $X$ = 1.25 m no verdict changes")
    assert "1.5\u00a0s" in text


def test_what_would_change_after_the_course_is_told():
    kept, lost = drives(Robot(250, 250)), drives(Robot(793, 793))
    text = part.later(kept, lost[:2] + kept[2:])
    assert text.startswith("**The end of the run decides:**") and "1.2\u00a0m/s as well" in text
    assert "at every speed" in part.later(lost[1:3], kept[1:3])
    deeper = [replace(run, N=run.N - 0.1) for run in kept]
    assert "becomes smaller at 0.25, 1.2, 5 and 10" in part.later(kept, deeper)


@pytest.mark.parametrize("k", STIFFNESSES)
def test_the_caption_of_the_forces_says_what_is_seen(k):
    runs = drives(Robot(k, k))
    caption = part.forces_figure(runs)
    assert not faults(caption.text) and not faults(caption.alt)
    lost = [run.v for run in runs if run.loss]
    assert ("greyed out" in caption.text) == bool(lost)
    assert caption.alt.count("loses the ground") == len(lost)
    assert not faults(part.forces_plots(runs))


def test_every_robot_gets_its_verdict():
    for name in ("undamped", "unsymmetric"):
        robot = ROBOTS[name]
        text = part.contact(drives(robot), compressions(robot), robot, STRAIGHT)
        assert not faults(text)
        assert not faults(part.later(drives(robot), drives(robot, beyond=1.5)))


def test_captions_of_the_road_and_of_long_steps_are_sound():
    run, _ = released(Robot(793, 793), 0.2)
    captions = part.road_caption([5, 1.2]), part.coarse_caption(run), part.frame_caption(run, 0.4)
    for caption in captions:
        assert not faults(caption.text) and not faults(caption.alt)
    assert "1.2 and at 5" in captions[0].text and "4.2 times the speed" in captions[0].text
    assert "10 steps of 0.200" in captions[1].text and "0.4\u00a0s" in captions[2].text
