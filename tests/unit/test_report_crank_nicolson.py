"""Sentences of Part II, for springs and robots of every kind."""

import re
from dataclasses import replace

import numpy as np
import pytest
from cases import STIFFNESSES, faults, fitted

from suspension import exact
from suspension.report import crank_nicolson as part
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.schemes import CRANK_NICOLSON
from suspension.simulation import simulate

BUMP = GaussianBump()
STRAIGHT = fitted(793)
ROBOTS = {f"k = {k}": Robot(k, k) for k in STIFFNESSES} | {
    "undamped": Robot(793, 793, c1=0, c2=0),
    "unsymmetric": Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
    "overdamped": Robot(5, 5, c1=20, c2=20),
    "one mode overdamped": Robot(50, 50, c1=11, c2=11),
}
each_robot = pytest.mark.parametrize("name", ROBOTS)


def released(robot, dt):
    """A run from a tilt of 0.1 rad, and the exact pitch at its times."""
    w0 = [0, 0, 0.1, 0]
    run = simulate(robot, FlatRoad(), v=0, dt=dt, tfinal=2, scheme=CRANK_NICOLSON, w0=w0)
    return run, exact.flat_ground(robot, w0, run.T)[2]


@each_robot
def test_sentences_about_the_robot_are_sound(name):
    robot = ROBOTS[name]
    texts = [part.matrix(robot, STRAIGHT), part.eigenvalues(robot), part.modes(robot)]
    assert not [fault for text in texts for fault in faults(text)]


def test_where_the_stiffness_comes_from_is_said():
    k = float(STRAIGHT.stiffness)
    assert "N/m from Part I, row" in part.matrix(Robot(k, k), STRAIGHT)
    chosen = part.matrix(Robot(500, 500), STRAIGHT)
    assert "$k_1 = k_2$ = 500.0\u00a0N/m, chosen here" in chosen and "Part I found" in chosen
    both = part.matrix(Robot(k, 900), STRAIGHT)
    assert "$k_2$ = 900.0\u00a0N/m, chosen here" in both


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


@pytest.mark.parametrize("k", STIFFNESSES)
def test_halving_the_step_answers_yes_or_no(k):
    runs, theta = zip(*(released(Robot(k, k), dt) for dt in (0.001, 0.0005)))
    text = part.halving(runs, theta)
    assert not faults(text)
    assert "appreciably? No*" in text
    assert "expected factor? Yes" in text


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


@pytest.mark.parametrize("c", [0.3, 1.5, 4])
def test_where_the_pitch_turns_the_told_part_of_the_error_is_left(c):
    """The first term of the error at the turning points, beside its peaks before and after."""
    robot = Robot(793, 793, c1=c, c2=c)
    run, theta = released(robot, 0.001)
    text = part.phase_error(robot, run, theta)
    (told,) = re.findall(r"turns, ([\d.]+)\s%", text)
    error, rate = run.W[2] - theta, exact.flat_ground(robot, [0, 0, 0.1, 0], run.T)[3]
    turns = np.flatnonzero(rate[:-1] * rate[1:] < 0)[2:8]
    part_of = rate[turns] / (rate[turns] - rate[turns + 1])
    at_turn = np.abs(error[turns] + part_of * (error[turns + 1] - error[turns]))
    half = int(np.pi / robot.eigenvalues.imag.max() / 0.001)
    peaks = [np.abs(error[max(j - half, 0) : j + half]).max() for j in turns]
    assert float(told) / 100 == pytest.approx(np.median(at_turn / peaks), rel=0.2)


def test_two_modes_in_the_pitch_are_not_told_as_one():
    robot = ROBOTS["unsymmetric"]
    w0 = [0, 0, 0.1, 0]
    run = simulate(robot, BUMP, v=0, dt=0.001, tfinal=2, scheme=CRANK_NICOLSON, w0=w0)
    text = part.phase_error(robot, run, exact.over_bump(robot, BUMP, 0, run.T, w0)[2])
    assert "two modes make up the pitch" in text and not faults(text)


def test_a_pitch_that_creeps_back_is_not_told_as_a_swing():
    robot = Robot(793, 793, c1=60, c2=60)
    runs, theta = zip(*(released(robot, dt) for dt in (0.001, 0.0005)))
    assert "creeps back" in part.phase_error(robot, runs[0], theta[0])
    text = part.halving(runs, theta)
    assert "swings through zero" not in text
    assert "Yes*" in text and "at rest" in text and not faults(text)


def test_without_enough_damping_the_lag_wins():
    robot = ROBOTS["undamped"]
    run, theta = released(robot, 0.001)
    assert "nothing dies away" in part.phase_error(robot, run, theta)
    robot = Robot(793, 793, c1=0.3, c2=0.3)
    run, theta = released(robot, 0.001)
    text = part.phase_error(robot, run, theta)
    assert "the lag wins" in text and not faults(text)


@pytest.mark.parametrize(("ratio", "dies"), [(1e-10, False), (1e-8, True)])
def test_a_decay_like_roundoff_is_none(ratio, dies):
    c = ratio * np.sqrt(2 * 793 * ROBOTS["undamped"].m)  # ratio: of the heave; the pitch has more
    robot = Robot(793, 793, c1=c, c2=c)
    assert ("*lightly* damped" in part.modes(robot)) == dies
    assert ("hardly dies away" in part.coarse(robot, CRANK_NICOLSON, 0.2)) == dies
    run, theta = released(robot, 0.001)
    assert ("nothing dies away" in part.phase_error(robot, run, theta)) != dies


def test_one_instant_is_told_from_the_whole_run():
    """At 808 N/m the error at 2 s is nearly zero, and falls by a factor of 2.6 only."""
    runs, theta = zip(*(released(Robot(808, 808), dt) for dt in (0.001, 0.0005)))
    text = part.halving(runs, theta)
    assert "expected factor? Yes*" in text
    assert "The one instant misleads" in text
    assert "2.65" in text and "4.000" in text


def test_steps_too_long_for_the_order_are_told():
    runs, theta = zip(*(released(Robot(793, 793), dt) for dt in (0.2, 0.1)))
    text = part.halving(runs, theta)
    assert "appreciably? Yes*" in text
    assert "expected factor? No*" in text


CRAWLING = Robot(793, 793, c1=60, c2=60)  # its pitch does not swing


@pytest.mark.parametrize(
    ("robot", "dt", "told"),
    [
        (ROBOTS["k = 793"], 0.2, "It swings too slowly, and hardly dies away"),
        (ROBOTS["k = 793"], 0.03, "It swings too slowly, and dies away too slowly"),
        (ROBOTS["k = 793"], 0.001, "It swings as it should, and dies away as it should"),
        (Robot(793, 793, c1=30, c2=30), 0.06, "It swings too fast, and dies away too slowly"),
        (ROBOTS["undamped"], 0.2, "It swings too slowly, and never dies away, as it should not"),
        (CRAWLING, 0.001, "It creeps back as it should"),
        (CRAWLING, 0.015, "It creeps back too fast"),
        (CRAWLING, 0.05, "It flips its sign in every step"),
    ],
)
def test_what_a_long_step_makes_of_the_pitch(robot, dt, told):
    text = part.coarse(robot, CRANK_NICOLSON, dt)
    assert text.startswith(f"**{told}.**") and not faults(text)


def test_the_numbers_of_a_long_step_are_those_of_a_run():
    """A mode of the run is multiplied by the same number in every step."""
    robot, dt = ROBOTS["k = 793"], 0.2
    text = part.coarse(robot, CRANK_NICOLSON, dt)
    turned, kept = zip(*re.findall(r"makes ([\d.]+) \D+ keeps ([\d.]+)", text))
    run, _ = released(robot, dt)
    k = robot.heave_share.argmin()
    pitch = np.linalg.solve(robot.eigenvectors, run.W - robot.equilibrium[:, None])[k]
    computed, true = pitch[1:] / pitch[:-1], robot.eigenvalues[k] * dt
    angles = abs(true.imag), np.abs(np.angle(computed)).mean()
    sizes = np.exp(true.real), np.abs(computed).mean()
    assert [float(x) for x in turned] == pytest.approx(np.array(angles) / (2 * np.pi), rel=0.04)
    assert [float(x) / 100 for x in kept] == pytest.approx(sizes, rel=0.01)


def test_of_a_robot_that_mixes_its_modes_the_one_that_pitches_most_is_told():
    assert "the mode that pitches most" in part.coarse(ROBOTS["unsymmetric"], CRANK_NICOLSON, 0.2)
    assert "the robot's pitch" in part.coarse(ROBOTS["k = 793"], CRANK_NICOLSON, 0.2)


def test_captions_of_the_road_and_of_long_steps_are_sound():
    run, theta = released(Robot(793, 793), 0.2)
    captions = part.road_caption([5, 1.2]), part.coarse_caption(run, theta)
    for caption in captions:
        assert not faults(caption.text) and not faults(caption.alt)
    assert "1.2 and at 5" in captions[0].text and "4.2 times the speed" in captions[0].text
    assert "10 steps of 0.2\u00a0s" in captions[1].text
    assert "do not lie on it" in captions[1].alt
    run, theta = released(Robot(5, 5), 0.005)
    assert "whose dots lie on it" in part.coarse_caption(run, theta).alt
