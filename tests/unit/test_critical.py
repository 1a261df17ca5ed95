"""Where the verdict flips: nothing missed, nothing invented."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension.critical import critical_speeds, critical_stiffness, sensitivity, zeros
from suspension.least_force import margin, minima
from suspension.road import GaussianBump
from suspension.robot import Robot

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
ROBOTS = {
    "of the problem": ROBOT,
    "undamped": Robot(900, 900, c1=0, c2=0),
    "unsymmetric": Robot(600, 1400, L1=0.08, L2=0.14, c1=0.5, c2=3),
}
quick = settings(derandomize=True, deadline=None, max_examples=200)


# --- finding every zero -----------------------------------------------------------------------


@pytest.mark.slow
@quick
@given(
    roots=st.lists(st.floats(0.001, 0.999), min_size=0, max_size=6, unique=True),
    samples=st.integers(20, 60),
)
def test_every_root_of_a_polynomial_is_found(roots, samples):
    roots = np.sort(roots)
    if (np.diff(roots) < 1e-4).any():
        return
    scale = 10.0 ** len(roots)
    found = zeros(lambda x: scale * np.prod(x - roots), np.linspace(0, 1, samples))
    assert len(found) == len(roots)
    np.testing.assert_allclose(found, roots, rtol=0, atol=1e-12)


@pytest.mark.parametrize("depth", [1e-2, 1e-4, 1e-6, 1e-8])
@pytest.mark.parametrize("at", [0.3, 0.5, 0.50123, 0.7071])
def test_a_dip_below_zero_between_two_samples_is_found(depth, at):
    round_dip = zeros(lambda x: (x - at) ** 2 - depth, np.linspace(0, 1, 30))
    np.testing.assert_allclose(round_dip, [at - depth**0.5, at + depth**0.5], rtol=0, atol=1e-9)
    if depth > 1e-5:
        sharp_dip = zeros(lambda x: abs(x - at) - depth, np.linspace(0, 1, 30))
        np.testing.assert_allclose(sharp_dip, [at - depth, at + depth], rtol=0, atol=1e-12)


def test_a_function_that_only_comes_close_has_no_zero():
    assert len(zeros(lambda x: (x - 0.41) ** 2 + 1e-9, np.linspace(0, 1, 30))) == 0
    assert len(zeros(lambda x: 1.0, [0, 1])) == 0


def test_a_zero_on_a_sample_counts_once():
    np.testing.assert_array_equal(zeros(lambda x: x - 0.5, [0, 0.5, 1]), [0.5])
    np.testing.assert_array_equal(zeros(lambda x: x, [0, 0.5, 1]), [0.0])


def test_far_from_zero_no_sample_is_added():
    calls = []
    zeros(lambda x: calls.append(x) or 5 + np.sin(20 * x), np.linspace(0, 1, 50))
    assert len(calls) == 50


# --- critical speeds --------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
def test_critical_speeds_are_complete(robot):
    """Against a dense scan, for the bump as it is and for heights at which a wheel just lifts.

    What the bump takes from a wheel's force is proportional to its height, so one scan serves all.
    """
    v = np.geomspace(0.1, 30, 800)
    rest = robot.m * robot.g * np.array([robot.L2, robot.L1]) / (robot.L1 + robot.L2)
    taken = (rest - [[m.force for m in minima(robot, BUMP, s)] for s in v]) / BUMP.height
    needed = (rest / taken).min(axis=1)  # height at which the first wheel lifts
    valleys = needed[1:-1][(needed[1:-1] < needed[:-2]) & (needed[1:-1] < needed[2:])]
    checked = 0
    for height in (BUMP.height, valleys[-1] * (1 + 1e-4), valleys[-1] * (1 - 1e-4)):
        bump = replace(BUMP, height=height)
        found = critical_speeds(robot, bump, 0.1, 30)
        assert all(abs(margin(robot, bump, s)) < 1e-9 for s in found)
        lost = needed < height
        flips = np.nonzero(lost[1:] != lost[:-1])[0]
        checked += len(flips)
        for j in flips:
            assert ((v[j] <= found) & (found <= v[j + 1])).any()
        between = [margin(robot, bump, s) > 0 for s in np.sqrt(found[:-1] * found[1:])]
        assert all(a != b for a, b in pairwise(between))  # kept and lost take turns
    assert checked >= 3


@pytest.mark.slow
def test_the_verdicts_of_the_problem_follow_from_its_critical_speeds():
    v = critical_speeds(ROBOT, BUMP, 0.05, 100)
    assert len(v) == 3  # slow is safe, the middle lifts, fast skims over, faster still lifts
    assert [np.searchsorted(v, s) for s in (0.25, 1.2, 5, 10, 30)] == [0, 1, 1, 2, 3]
    np.testing.assert_allclose(critical_speeds(ROBOT, BUMP, 1, 10), v[1:2], rtol=1e-12)


@pytest.mark.slow
def test_a_critical_speed_is_a_critical_stiffness_too():
    found = critical_speeds(ROBOT, BUMP, 0.3, 30)
    assert len(found) == 3
    for v in found:
        assert abs(critical_stiffness(ROBOT, BUMP, v, 700, 900) / 800 - 1).min() < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize(("v", "flip"), [(1.2, 275), (5, 573), (10, 945)])
def test_stiffness_at_which_the_verdict_flips(v, flip):
    (k,) = critical_stiffness(ROBOT, BUMP, v, 200, 2000)
    softer, stiffer = Robot(0.999 * k, 0.999 * k), Robot(1.001 * k, 1.001 * k)
    assert k == pytest.approx(flip, abs=2)
    assert margin(softer, BUMP, v) > 0 > margin(stiffer, BUMP, v)


@pytest.mark.slow
def test_both_springs_keep_their_ratio():
    robot = ROBOTS["unsymmetric"]
    (k,) = critical_stiffness(robot, BUMP, 3, 100, 3000)
    assert abs(margin(replace(robot, k1=k, k2=k * 1400 / 600), BUMP, 3)) < 1e-9


# --- sensitivity ------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("names", [("k1", "k2"), ("c1",), ("m",), ("L1", "L2"), ("g",)])
def test_critical_speeds_move_as_the_sensitivities_say(names):
    def changed(factor):
        return replace(ROBOT, **{name: factor * getattr(ROBOT, name) for name in names})

    step = 1e-4
    (v,) = critical_speeds(ROBOT, BUMP, 5, 10)
    slope = -sensitivity(ROBOT, BUMP, v, *names) / sensitivity(ROBOT, BUMP, v, "v")
    moved = [
        critical_speeds(changed(factor), BUMP, 0.99 * v, 1.01 * v)[0]
        for factor in (1 - step, 1 + step)
    ]
    assert np.log(moved[1] / moved[0]) / (2 * step) == pytest.approx(slope, rel=1e-4, abs=1e-6)


@pytest.mark.parametrize("v", [0.25, 1.2, 5, 10])
def test_a_robot_twice_as_heavy_stiff_and_damped_presses_twice_as_hard(v):
    everything = ("k1", "k2", "c1", "c2", "m", "Izz")
    assert sensitivity(ROBOT, BUMP, v, *everything) == pytest.approx(
        margin(ROBOT, BUMP, v), rel=1e-6
    )


# --- refusals ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("find", "message"),
    [
        (lambda: critical_speeds(ROBOT, BUMP, 0, 1), "vmin must be a finite number > 0, got 0"),
        (lambda: critical_speeds(ROBOT, BUMP, 2, 1), "vmax must be > vmin = 2, got 1"),
        (lambda: critical_speeds(ROBOT, BUMP, 1, np.inf), "vmax must be > vmin = 1, got inf"),
        (lambda: critical_stiffness(ROBOT, BUMP, 1, -5, 1), "kmin must be a finite number > 0"),
        (lambda: critical_stiffness(ROBOT, BUMP, 1, 5, 5), "kmax must be > kmin = 5, got 5"),
        (lambda: critical_stiffness(ROBOT, BUMP, 0, 5, 6), "v must be a finite number > 0, got 0"),
        (lambda: sensitivity(ROBOT, BUMP, 1, "k"), "names must be one of 'v', 'k1', .*, got 'k'"),
    ],
)
def test_what_cannot_be_is_refused(find, message):
    with pytest.raises(ValueError, match=message):
        find()


def test_a_search_without_end_is_refused_and_says_which_end_is_too_low():
    with pytest.raises(ValueError, match="vmin so far from zero, that at most .* 1e-12 and 30"):
        critical_speeds(Robot(800, 800), GaussianBump(), 1e-12, 30)
