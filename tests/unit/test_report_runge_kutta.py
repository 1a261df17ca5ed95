"""Sentences of Part III, for springs and robots of every kind."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from cases import DELTA_MAX, STIFFNESSES, faults

from suspension import exact
from suspension.course import make_gfunc
from suspension.report import runge_kutta as part
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.schemes import CRANK_NICOLSON, RK4
from suspension.simulation import simulate
from suspension.travel import travel

BUMP = GaussianBump()
UNDAMPED = Robot(793, 793, c1=0, c2=0)
UNSYMMETRIC = Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9)
ROBOTS = [Robot(k, k) for k in STIFFNESSES] + [UNDAMPED, UNSYMMETRIC]
NAMES = [f"k={k}" for k in STIFFNESSES] + ["undamped", "unsymmetric"]
DTS = (0.2, 0.1, 0.001)
SPEEDS = (0.25, 1.2, 5, 10)
W0 = [0, 0, 0.1, 0]
each_robot = pytest.mark.parametrize("robot", ROBOTS, ids=NAMES)
each_spring = pytest.mark.parametrize("robot", ROBOTS[:-1], ids=NAMES[:-1])


@cache
def released(robot, dt, scheme=RK4, tfinal=2):
    return simulate(robot, FlatRoad(), v=0, dt=dt, tfinal=tfinal, scheme=scheme, w0=W0)


def amplitudes(robot, run):
    return np.abs(np.linalg.solve(robot.eigenvectors, run.W - robot.equilibrium[:, None]))


def agreement(robot, dts=DTS):
    runs = [released(robot, dt) for dt in dts]
    modes = [amplitudes(robot, run) for run in runs]
    return part.agreement(runs, modes, robot.eigenvalues, 0.001)


@each_robot
def test_sentences_about_stability_are_sound(robot):
    z = robot.eigenvalues
    texts = [part.stability(z, DTS), part.stability_plot(z, DTS), part.limit(z)]
    texts += [part.reach(robot), part.beyond_the_limit(z), *part.stability_figure(z, DTS)]
    texts += part.growth_figure([released(robot, dt) for dt in DTS[:2]], robot)
    assert not [fault for text in texts for fault in faults(text)]


def test_the_steps_are_sorted_by_their_verdict():
    text = part.stability(Robot(793, 793).eigenvalues, DTS)
    assert "stable at 0.001\u00a0s, and unstable at 0.2 and 0.1\u00a0s" in text
    text = part.stability(Robot(405, 405).eigenvalues, DTS)
    assert "stable at 0.1 and 0.001\u00a0s, and unstable at 0.2\u00a0s" in text
    assert "none of the steps" in part.stability(Robot(405, 405).eigenvalues, [0.3, 0.2])
    assert "every one of the steps" in part.stability(Robot(405, 405).eigenvalues, [0.1])


def test_the_captions_follow_the_spring():
    stiff = part.stability_figure(Robot(793, 793).eigenvalues, DTS)
    assert "all lie outside at 0.2 and 0.1\u00a0s" in stiff.text
    soft = part.stability_figure(Robot(405, 405).eigenvalues, DTS)
    assert "all lie inside at 0.1 and 0.001\u00a0s" in soft.alt
    between = part.stability_figure(Robot(500, 500).eigenvalues, DTS)
    assert "two lie inside and two lie outside at 0.1" in between.text
    soft = Robot(405, 405)
    caption = part.growth_figure([released(soft, dt) for dt in DTS[:2]], soft)
    assert "Left: at 0.2\u00a0s both modes grow" in caption.text
    assert "Right: at 0.1\u00a0s no mode grows" in caption.alt
    between = Robot(500, 500)
    caption = part.growth_figure([released(between, dt) for dt in DTS[:2]], between)
    assert "the pitch grows and the other mode does not" in caption.text


def test_the_rule_of_thumb_is_held_against_the_true_limit():
    text = part.reach(Robot(793, 793))
    assert "0.0727\u00a0s" in text and "0.0744\u00a0s" in text and "2.3\u00a0% longer" in text
    assert "exact" in part.reach(UNDAMPED)
    assert "shorter" in part.reach(Robot(793, 793, c1=40, c2=40))


@each_robot
def test_at_rest(robot):
    output = make_gfunc(robot, BUMP)(robot.equilibrium, 0, 0)
    text = part.at_rest(robot, BUMP, output)
    assert not faults(text)
    assert "not roundoff but the bump" in text
    assert ("half the weight each" in text) == (robot is not UNSYMMETRIC)


def test_at_rest_where_there_is_no_bump():
    robot = Robot(793, 793)
    assert "It is as expected." in part.at_rest(robot, BUMP, (np.zeros(4), 7.1, 7.1))
    assert "roundoff" in part.at_rest(robot, BUMP, (np.full(4, 1e-11), 7.1, 7.1))


@each_robot
def test_the_runs_do_what_stability_predicts(robot):
    text = agreement(robot)
    assert text.startswith("Yes: ")
    assert not faults(text)


def test_only_unstable_runs_are_called_so():
    assert "the runs with 0.2 and 0.1\u00a0s, predicted unstable, grow" in agreement(ROBOTS[3])
    soft = agreement(Robot(405, 405))
    assert "the run with 0.2\u00a0s, predicted unstable, grows" in soft
    assert "the runs with 0.1 and 0.001\u00a0s, predicted stable, stay bounded" in soft
    assert "unstable" not in agreement(Robot(405, 405), [0.001])
    assert "predicted stable" not in agreement(Robot(405, 405), [0.2])


def test_a_run_that_overflows_is_still_told():
    robot = Robot(793, 793)
    run = released(robot, 0.2, tfinal=200)
    assert not np.isfinite(run.W).all()
    with np.errstate(all="ignore"):
        modes = amplitudes(robot, run)
    text = part.agreement([run], [modes], robot.eigenvalues, 0.0)
    assert "10³⁰⁸" in text and not faults(text)


def test_a_contradiction_would_be_told():
    robot = Robot(793, 793)
    runs = [released(robot, dt) for dt in DTS]
    modes = [amplitudes(robot, run) for run in runs]
    text = part.agreement(runs, modes[::-1], robot.eigenvalues, 0.0)
    assert text.startswith("**No**: at 0.2 and 0.001\u00a0s")


@each_spring
def test_which_is_more_accurate(robot):
    fourth, second = released(robot, 0.001), released(robot, 0.001, CRANK_NICOLSON)
    finer = released(robot, 0.00025, CRANK_NICOLSON)
    theta, theta_finer = (exact.flat_ground(robot, W0, run.T)[2] for run in (fourth, finer))
    text = part.accuracy(fourth, second, theta)
    assert not faults(text)
    assert "RK4 is more accurate than Crank-Nicolson: at" in text
    text = part.equal_work(fourth, finer, (theta, theta_finer))
    assert not faults(text)
    assert "8000 times" in text and "8001 times" in text
    assert not faults(part.final_pitch([fourth], theta[-1]))


def test_the_other_way_round_is_told_too():
    robot = Robot(793, 793)
    fourth, second = released(robot, 0.2), released(robot, 0.2, CRANK_NICOLSON)
    theta = exact.flat_ground(robot, W0, fourth.T)[2]
    text = part.accuracy(fourth, second, theta)
    assert "Crank-Nicolson is more accurate than RK4: at" in text
    assert not faults(text)


def test_an_instant_that_says_the_opposite_is_told():
    robot = Robot(793, 793)
    fourth, second = released(robot, 0.001), released(robot, 0.001, CRANK_NICOLSON)
    theta = exact.flat_ground(robot, W0, fourth.T)[2]
    W = second.W.copy()
    W[2, -1] = theta[-1] + 1e-12
    text = part.accuracy(fourth, replace(second, W=W), theta)
    assert "RK4 is more accurate over the whole run" in text
    assert "the other way round" in text
    assert not faults(text)


@each_robot
def test_contact_by_both_methods(robot):
    def drive(v, scheme):
        return simulate(robot, BUMP, v=v, dt=0.001, tfinal=1.25 / v, scheme=scheme)

    runs, others = ([drive(v, scheme) for v in SPEEDS] for scheme in (RK4, CRANK_NICOLSON))
    compression = [travel(robot, BUMP, v).compression / DELTA_MAX for v in SPEEDS]
    text = part.contact(runs, others, compression)
    assert not faults(text)
    assert "The verdicts agree with those of Part II" in text
    assert ("after" in text.split("What is said of the spring")[1]) == any(run.loss for run in runs)
    other = part.contact(runs, runs[::-1], compression)
    differs = (runs[0].loss is None) != (runs[3].loss is None)
    differs |= (runs[1].loss is None) != (runs[2].loss is None)
    assert ("do **not** agree" in other) == differs
    caption = part.forces_figure(runs)
    assert "10(ii)" in caption.text and not faults(caption.alt)
    assert not faults(part.forces_plots(runs))


def test_the_caption_of_the_slopes_says_how_far_the_step_ends_from_the_truth():
    caption = part.slopes_caption(1.05, 1.0)
    assert not faults(caption.text) and "within 5.0\u00a0%" in caption.text
