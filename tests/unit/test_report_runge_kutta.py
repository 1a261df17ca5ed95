"""Sentences of Part III, for springs and robots of every kind."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from cases import STIFFNESSES, faults

from suspension import exact
from suspension.course import make_gfunc
from suspension.problem import START, STEPS
from suspension.report import runge_kutta as part
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.schemes import CRANK_NICOLSON, RK4
from suspension.simulation import simulate

BUMP = GaussianBump()
UNDAMPED = Robot(793, 793, c1=0, c2=0)
UNSYMMETRIC = Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9)
ROBOTS = [Robot(k, k) for k in STIFFNESSES] + [UNDAMPED, UNSYMMETRIC]
NAMES = [f"k={k}" for k in STIFFNESSES] + ["undamped", "unsymmetric"]
each_robot = pytest.mark.parametrize("robot", ROBOTS, ids=NAMES)
each_spring = pytest.mark.parametrize("robot", ROBOTS[:-1], ids=NAMES[:-1])


@cache
def released(robot, dt, scheme=RK4, tfinal=2):
    return simulate(robot, FlatRoad(), v=0, dt=dt, tfinal=tfinal, scheme=scheme, w0=START)


def amplitudes(robot, run):
    return np.abs(np.linalg.solve(robot.eigenvectors, run.W - robot.equilibrium[:, None]))


def growth_caption(robot):
    runs = [released(robot, dt) for dt in STEPS[:2]]
    return part.growth_caption(runs, robot, [0, 2])


def agreement(robot, dts=STEPS):
    runs = [released(robot, dt) for dt in dts]
    modes = [amplitudes(robot, run) for run in runs]
    return part.agreement(runs, modes, robot.eigenvalues)


@each_robot
def test_sentences_about_stability_are_sound(robot):
    texts = [part.limit(robot.eigenvalues)]
    texts += growth_caption(robot)
    assert not [fault for text in texts for fault in faults(text)]


def test_the_caption_of_the_growth_follows_the_spring():
    def caption(k):
        return growth_caption(Robot(k, k))

    both = "Both at 0.2\u00a0s (left) and at 0.1\u00a0s (right) every mode grows"
    assert both in caption(793).text and caption(793).text.count("blows up") == 1
    assert "At 0.2\u00a0s (left) every mode grows" in caption(405).text
    assert "at 0.1\u00a0s (right) no mode grows" in caption(405).alt
    assert "the pitch grows and another mode does not" in caption(500).text


@each_robot
def test_at_rest(robot):
    output = make_gfunc(robot, BUMP)(robot.equilibrium, 0, 0)
    text = part.at_rest(robot, BUMP, output)
    assert not faults(text)
    assert "not roundoff but the bump" in text
    assert ("half the weight each" in text) == (robot is not UNSYMMETRIC)


@each_robot
def test_what_is_left_at_rest_is_put_down_to_the_wheel_that_feels_the_bump(robot):
    for centre, wheel, place in [(0.3, "front", "L_2"), (-0.3, "rear", "-L_1")]:
        bump = GaussianBump(centre=centre)
        output = make_gfunc(robot, bump)(robot.equilibrium, 0, 0)
        text = part.at_rest(robot, bump, output)
        assert f"at the {wheel} wheel" in text and f"$H({place})$" in text
        height = float(bump({"L_2": robot.L2, "-L_1": -robot.L1}[place])[0])
        assert f"{height:.2e}"[:4] in text


def test_at_rest_where_there_is_no_bump():
    robot = Robot(793, 793)
    assert "It is as expected." in part.at_rest(robot, BUMP, (np.zeros(4), 7.1, 7.1))
    assert "roundoff" in part.at_rest(robot, BUMP, (np.full(4, 1e-11), 7.1, 7.1))


@pytest.mark.parametrize(("apart", "half"), [(0.9e-6, True), (1.1e-6, False)])
def test_forces_at_rest_are_halves_of_the_weight_within_a_millionth(apart, half):
    robot = Robot(793, 793)
    N = robot.m * robot.g / 2 * (1 + apart * np.array([1, -1]))
    text = part.at_rest(robot, BUMP, (np.zeros(4), *N))
    assert ("half the weight each" in text) == half != ("together the weight" in text)


@each_robot
def test_the_runs_do_what_stability_predicts(robot):
    text = agreement(robot)
    assert text.startswith("Yes: ")
    assert not faults(text)


def test_the_runs_are_told_as_they_are():
    rows = [line.split("|")[1:5] for line in agreement(Robot(405, 405)).splitlines()[4:]]
    told = [[cell.strip() for cell in row[:3]] for row in rows]
    assert told == [
        ["0.2", "unstable", "grow"],
        ["0.1", "stable", "stay bounded"],
        ["0.001", "stable", "stay bounded"],
    ]
    assert "all runs were predicted stable" in agreement(Robot(405, 405), [0.001])
    assert "all runs were predicted unstable" in agreement(Robot(405, 405), [0.2])


def test_a_run_that_overflows_is_still_told():
    robot = Robot(793, 793)
    run = released(robot, 0.2, tfinal=200)
    assert not np.isfinite(run.W).all()
    with np.errstate(all="ignore"):
        modes = amplitudes(robot, run)
    text = part.agreement([run], [modes], robot.eigenvalues)
    assert "10³⁰⁸" in text and not faults(text)


def test_a_contradiction_would_be_told():
    robot = Robot(793, 793)
    runs = [released(robot, dt) for dt in STEPS]
    modes = [amplitudes(robot, run) for run in runs]
    text = part.agreement(runs, modes[::-1], robot.eigenvalues)
    assert text.startswith("**No**: at 0.2 and 0.001\u00a0s")


@each_spring
def test_which_is_more_accurate(robot):
    fourth, second = released(robot, 0.001), released(robot, 0.001, CRANK_NICOLSON)
    finer = released(robot, 0.00025, CRANK_NICOLSON)
    theta, theta_finer = (exact.flat_ground(robot, START, run.T)[2] for run in (fourth, finer))
    text = part.comparison(fourth, second, (theta, theta))
    assert not faults(text)
    assert "RK4 is more accurate than Crank-Nicolson: its" in text
    text = part.comparison(fourth, finer, (theta, theta_finer))
    assert not faults(text)
    assert "| 8000 |" in text and "| 8001 |" in text


def test_the_other_way_round_is_told_too():
    robot = Robot(793, 793)
    fourth, second = released(robot, 0.2), released(robot, 0.2, CRANK_NICOLSON)
    theta = exact.flat_ground(robot, START, fourth.T)[2]
    text = part.comparison(fourth, second, (theta, theta))
    assert "Crank-Nicolson is more accurate than RK4" in text
    assert not faults(text)


def test_an_instant_that_says_the_opposite_is_told():
    robot = Robot(793, 793)
    fourth, second = released(robot, 0.001), released(robot, 0.001, CRANK_NICOLSON)
    theta = exact.flat_ground(robot, START, fourth.T)[2]
    W = second.W.copy()
    W[2, -1] = theta[-1] + 1e-12
    text = part.comparison(fourth, replace(second, W=W), (theta, theta))
    assert "RK4 is more accurate" in text and "the other way round" in text
    assert not faults(text)


def test_the_caption_of_the_slopes_says_how_far_the_step_ends_from_the_truth():
    caption = part.slopes_caption(1.05, 1.0)
    assert not faults(caption.text) and "within 5.0\u00a0%" in caption.text


def won_back(off=0.0):
    """The answer for Crank-Nicolson at a quarter of the step, its error smaller by a part."""
    robot = Robot(793, 793)
    fourth, second = released(robot, 0.001), released(robot, 0.001, CRANK_NICOLSON)
    third = released(robot, 0.00025, CRANK_NICOLSON)
    theta, theta_finer = (exact.flat_ground(robot, START, run.T)[2] for run in (fourth, third))
    W = third.W.copy()
    W[2] = theta_finer + (1 - off) * (W[2] - theta_finer)
    return part.won_back(fourth, second, replace(third, W=W), (theta, theta_finer))


def test_what_shorter_steps_win_back_is_what_the_order_promises_or_is_told_not_to_be():
    promise = "The step is 4 times shorter, and a method of order 2 promises $4^2 = 16$"
    assert won_back() == f"**A factor of 16.** {promise}."
    late = won_back(off=-0.5)
    assert late.startswith("**A factor of 11.** ") and late.endswith("still too long for it.")
    assert promise in late
    assert won_back(off=1 - 1e-9).startswith(f"**All of it.** {promise}; here")
    for text in (late, won_back()):
        assert not faults(text)
