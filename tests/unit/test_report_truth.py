"""Sentences of Part V and the appendix, for springs and robots of every kind."""

import re

import numpy as np
import pytest
from cases import STIFFNESSES, faults

from suspension import accuracy
from suspension.exact import over_bump
from suspension.report import truth as part
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import BACKWARD_EULER, CRANK_NICOLSON, EULER, RK4

BUMP = GaussianBump()
ROBOTS = {f"k = {k}": Robot(k, k) for k in STIFFNESSES} | {
    "undamped": Robot(793, 793, c1=0, c2=0),
    "unsymmetric": Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
}
METHODS = (EULER, BACKWARD_EULER, CRANK_NICOLSON, RK4)
PROMISED = {"Crank-Nicolson": 2, "RK4": 4}
each_robot = pytest.mark.parametrize("name", ROBOTS)


def plain(text):
    """A text without its no-break spaces."""
    return text.replace("\xa0", " ")


def slopes(orders, losses=True, n=9):
    """Errors that fall with given orders, without a time of loss if so wanted."""
    steps = 0.5 ** np.arange(n)[:, None]
    worst = {name: np.repeat(steps**p, 3, axis=1) for name, p in orders.items()}
    if not losses:
        for errors in worst.values():
            errors[:, 2] = np.nan
    return worst


@each_robot
def test_what_is_said_about_a_mode_is_sound(name):
    robot = ROBOTS[name]
    fastest = max(robot.eigenvalues, key=np.imag)
    steps = np.geomspace(0.01, 1.02, 300) * RK4.max_stable_dt(robot.eigenvalues)
    seen = {s.name: accuracy.seen_mode(s, fastest, steps) for s in METHODS}
    caption = part.seen_mode_caption(seen, steps, fastest)
    assert "Nyquist's for RK4 at" in plain(caption.text)
    assert "grows with Euler" in plain(caption.alt)
    turn = part.half_turn(seen["RK4"], steps, fastest)
    assert plain(caption.text).split("RK4 at ")[1].split()[0] in turn  # the same number of ms
    for text in (*caption, turn, part.coarse_mode(CRANK_NICOLSON, fastest, 0.2)):
        assert not faults(text)


@pytest.mark.slow
@each_robot
def test_the_measured_orders_are_told(name):
    robot, dts = ROBOTS[name], 0.002 / 2.0 ** np.arange(5)
    worst = {
        s.name: accuracy.error_table(robot, BUMP, v=1.2, dts=dts, scheme=s)
        for s in (CRANK_NICOLSON, RK4)
    }
    loss_is_there = bool(np.isfinite(worst["RK4"][:, 2]).all())
    assert (len(part.panels(worst)) == 3) == loss_is_there
    for text in (*part.convergence_caption(worst, 1.2), part.observed_orders(worst, PROMISED)):
        assert not faults(text)


def test_the_heave_of_every_speed_is_told():
    robot = ROBOTS["k = 793"]
    X = np.linspace(0, 1.25, 301)
    heave = {v: over_bump(robot, BUMP, v, X / v)[0] - robot.equilibrium[0] for v in (0.25, 10)}
    caption = part.heave_caption(heave, BUMP)
    assert "13.9 mm at 0.25 m/s" in plain(caption.text)
    assert not faults(caption.text) and not faults(caption.alt)


def test_orders_that_are_not_the_promised_ones_are_told():
    good = part.observed_orders(slopes({"Crank-Nicolson": 2, "RK4": 4}), PROMISED)
    assert "| RK4 | 4 | 4.00 | 4.00 | 4.00 |" in plain(good) and "not yet" not in plain(good)
    late = part.observed_orders(slopes({"Crank-Nicolson": 2, "RK4": 3.2}), PROMISED)
    assert "for RK4 are not yet the promised ones" in plain(late)


def test_without_a_loss_there_is_no_time_of_it():
    worst = slopes({"Crank-Nicolson": 2, "RK4": 4}, losses=False)
    assert list(part.panels(worst)) == list(part.READINGS[:2])
    assert "Contact is kept" in plain(part.convergence_caption(worst, 1.2).text)
    assert "time of loss" not in plain(part.observed_orders(worst, PROMISED))


def test_the_witness_may_disagree():
    assert part.witness([1e-12, 3e-11], 1e-12).startswith("They agree")
    assert "less than $10^{-10}$" in plain(part.witness([1e-12], 1e-12))
    assert "do not agree" in plain(part.witness([1e-12, 3e-4], 1e-12))


@pytest.mark.parametrize(
    ("scheme", "lam", "words"),
    [
        (CRANK_NICOLSON, -1.4 + 38.9j, "times too slowly"),
        (BACKWARD_EULER, -1.4 + 38.9j, "times too fast"),
        (CRANK_NICOLSON, 38.9j, "like the robot's it does not decay"),
        (BACKWARD_EULER, 38.9j, "changes its size"),
        (EULER, -1.4 + 38.9j, "not even stable"),
        (BACKWARD_EULER, -30.0 + 0j, "does not swing"),
    ],
)
def test_a_coarse_run_is_described(scheme, lam, words):
    text = part.coarse_mode(scheme, lam, 0.2)
    assert words in text and not faults(text)


def test_without_damping_rk4_turns_a_mode_over_in_the_calmest_step():
    lam, steps = 30j, np.geomspace(0.001, 0.09, 300)
    text = part.half_turn(accuracy.seen_mode(RK4, lam, steps), steps, lam)
    assert plain(text).count("81.6 ms") == 2  # sqrt(6) / 30, twice
    short = steps[:50]
    text = part.half_turn(accuracy.seen_mode(RK4, lam, short), short, lam)
    assert "does not reach" in text and not faults(text)


def test_a_step_of_crank_nicolson_counts_once():
    rows = part.work_account(METHODS).splitlines()
    assert "| Crank-Nicolson | 1 | yes |" in rows and "| RK4 | 4 | no |" in rows


def test_the_work_to_a_goal():
    cost = {"RK4": [100, 200, 400], "Euler": [100, 200, 400], "Heun": [50, 100, 200]}
    force = {"RK4": [1.0, 1e-3, 1e-6], "Euler": [9.0, 5.0, 2.0], "Heun": [1.0, 0.1, 0.009]}
    text = part.work_verdict(cost, force, ["RK4", "Heun"])
    assert "200 evaluations with RK4 and 200 evaluations with Heun" in text.replace(
        "Heun and 200 evaluations with RK4", "RK4 and 200 evaluations with Heun"
    )
    assert "With Euler it is not reached in 400" in plain(
        part.work_verdict(cost, force, list(cost))
    )
    assert "No run" in plain(part.work_verdict(cost, force, ["Euler"]))
    caption = part.work_caption(cost, force, 1.2, [1e-3, 1e-9])
    assert "not reached by Euler" in plain(caption.alt) and "$10^{-9}$" in plain(caption.text)


def test_dips_that_are_seen_and_dips_that_are_not():
    speeds = np.linspace(20.4, 21.3, 40)
    missed = part.missed_table(speeds, {"RK45": [21.0], "DOP853": []}, 21.0, -0.5)
    assert "| RK45 | 1 |" in plain(missed) and "−0.5" in plain(missed) and not faults(missed)
    assert "every one is seen" in plain(part.missed_table(speeds, {"RK45": []}, 21.0, -0.5))
    assert "no critical speed" in plain(part.missed_table([], {"RK45": []}))
    assert "does not see" in plain(part.dip_caption(21.1, True).text)
    assert "seen by" in plain(part.dip_caption(0.527, False).text)
    assert not faults(part.dip_caption(0.527, False).text)


def test_verdicts_read_from_samples_are_counted():
    speeds, exact = np.array([19.0, 20.0, 21.0]), np.array([0.2, -0.1, -0.3])
    sampled = {0.001: exact + 0.4, 0.0003: exact + 0.15, 0.0001: exact}
    text = plain(part.sampled_verdicts(speeds, sampled, exact))
    assert "three speeds from 19.0 to 21.0 m/s" in text
    assert re.findall(r"(\d) with a sample every ([\d.]+) ms", text) == [
        ("2", "1.0"),
        ("1", "0.30"),
        ("0", "0.10"),
    ]
    kept = plain(part.sampled_verdicts(speeds, {0.001: exact + 0.01}, exact))
    assert "no verdict is wrong" in kept
    for told in (text, kept, *part.sampled_caption(speeds, sampled)):
        assert not faults(told)
