"""Sentences of Part V and the appendix, for springs and robots of every kind."""

import numpy as np
import pytest
from cases import STIFFNESSES, faults
from helpers import plain

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
    for text in (*caption, part.coarse_mode(CRANK_NICOLSON, fastest, 0.2)):
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
    assert "13.9 mm at 0.25 m/s" in plain(caption.alt)
    assert not faults(caption.text) and not faults(caption.alt)


def test_orders_that_are_not_the_promised_ones_are_told():
    good = part.observed_orders(slopes({"Crank-Nicolson": 2, "RK4": 4}), PROMISED)
    assert "| RK4 | 4 | 4.00 | 4.00 | 4.00 |" in plain(good) and "not yet" not in plain(good)
    late = part.observed_orders(slopes({"Crank-Nicolson": 2, "RK4": 3.2}), PROMISED)
    assert "for RK4 are not yet the promised ones" in plain(late)


@pytest.mark.parametrize(("off", "late"), [(0.24, False), (0.26, True), (-0.24, False)])
def test_an_order_is_the_promised_one_within_a_quarter(off, late):
    text = part.observed_orders(slopes({"Crank-Nicolson": 2, "RK4": 4 - off}), PROMISED)
    assert ("not yet the promised ones" in text) == late


def test_without_a_loss_there_is_no_time_of_it():
    worst = slopes({"Crank-Nicolson": 2, "RK4": 4}, losses=False)
    assert list(part.panels(worst)) == list(part.READINGS[:2])
    assert "Contact is kept" in plain(part.convergence_caption(worst, 1.2).text)
    assert "time of loss" not in plain(part.observed_orders(worst, PROMISED))


@pytest.mark.parametrize(
    ("scheme", "lam", "row"),
    [
        (CRANK_NICOLSON, -1.4 + 38.9j, "| Crank-Nicolson at 0.2 s, stable | 2.10 | 0.087 |"),
        (EULER, -1.4 + 38.9j, "| Euler at 0.2 s, **unstable** |"),
        (CRANK_NICOLSON, 38.9j, "stable | 2.10 | 0.000 |"),
        (BACKWARD_EULER, -30.0 + 0j, "stable | 0 | 9.730 |"),
    ],
)
def test_a_coarse_run_is_described(scheme, lam, row):
    text = part.coarse_mode(scheme, lam, 0.2)
    assert row in plain(text).splitlines()[-1] and not faults(text)
    assert f"| {abs(lam.real):.3f} |" in text.splitlines()[2]  # the robot's own


def test_a_step_of_crank_nicolson_counts_once():
    rows = part.work_account(METHODS).splitlines()
    assert "| Crank-Nicolson | 1 | yes |" in rows and "| RK4 | 4 | no |" in rows


def test_the_work_to_a_goal():
    cost = {"RK4": [100, 200, 400], "Euler": [100, 200, 400], "Heun": [50, 100, 200]}
    force = {"RK4": [1.0, 1e-3, 1e-6], "Euler": [9.0, 5.0, 2.0], "Heun": [1.0, 0.1, 0.009]}
    text = part.work_verdict(cost, force, ["RK4", "Heun"])
    assert "| RK4 | 200 |" in text and "| Heun | 200 |" in text
    assert "| Euler | > 400 |" in part.work_verdict(cost, force, list(cost))
    caption = part.work_caption(cost, force, 1.2, [1e-3, 1e-9])
    assert "down to 0.01 N: Euler" in plain(caption.alt) and "$10^{-9}$" in plain(caption.text)


def test_dips_that_are_seen_and_dips_that_are_not():
    speeds = np.linspace(20.4, 21.3, 40)
    missed = part.missed_table(speeds, {"RK45": [21.0], "DOP853": []})
    assert "| RK45 | 1 |" in missed and "| DOP853 | 0 |" in missed and not faults(missed)
    assert "no critical speed" in plain(part.missed_table([], {"RK45": []}))
    for was_missed, words in ((True, "does not see"), (False, "that ends in the dip")):
        caption = part.dip_caption(21.1, was_missed)
        assert words in caption.text and not faults(caption.text) and not faults(caption.alt)


@pytest.mark.parametrize(
    ("coarse", "sharp", "words"),
    [
        ([1], [1, 2, 3], "The better method misses more. A tolerance"),
        ([1, 2], [1, 2], "The better method misses as many. A tolerance"),
        ([1, 2], [], "The better method misses fewer. A tolerance"),
        ([], [], "A tolerance bounds"),
    ],
)
def test_a_sharp_tolerance_promises_nothing_between_steps(coarse, sharp, words):
    assert part.missed_sentence(coarse, sharp).startswith(words)


def test_verdicts_read_from_samples_are_counted():
    speeds, exact = np.array([19.0, 20.0, 21.0]), np.array([0.2, -0.1, -0.3])
    sampled = {0.001: exact + 0.4, 0.0003: exact + 0.15, 0.0001: exact}
    text = plain(part.sampled_verdicts(sampled, exact))
    wrong = "2 with a sample every 1.0 ms, 1 with a sample every 0.30 ms and 0 with a sample every"
    assert text.startswith(f"Wrong verdicts out of 3: {wrong} 0.10 ms. Every wrong one says *kept*")
    for told in (text, *part.sampled_caption(speeds, sampled)):
        assert not faults(told)
    assert "That is luck" in part.sampled_verdicts({0.0001: exact}, exact)
    assert "Every wrong one" not in part.sampled_verdicts({0.001: -exact}, exact)


@pytest.mark.parametrize(
    ("off", "words"),
    [
        ([0, 0.2, 1.04], "**Too high only.** Of 3 least values that were read from samples none"),
        ([0, 0.2, 1.04], "the worst lies 1.0 N above it"),
        ([0, 1e-9, 0], "and here none above"),
        ([0, -1e-9, 0.3], "the worst lies 0.30 N above it"),
        ([0.1, -0.02, 0.3], "**Either way, here.** Of 3 least values that were read from samples"),
        ([0.1, -0.02, 0.3], "by up to 0.020 N"),
    ],
)
def test_in_which_direction_samples_are_wrong(off, words):
    exact = np.array([0.2, -0.1, -0.3])
    text = plain(part.sampled_direction({0.001: exact + off}, exact))
    assert words in text and not faults(text)
