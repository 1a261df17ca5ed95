"""Critical speeds and stops of the measured spring, and draws of its coefficients."""

import math

import numpy as np
import pytest
from cases import DELTA_MAX, fitted
from scipy import stats

from suspension.contact import critical_speeds
from suspension.measured import Share, Study, follow_speed, joint_draws, zero_speeds, zero_stops
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.spring_law import SpringLaw
from suspension.sweep import Drive, drive

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
LINE = SpringLaw(0.0, 800 * DELTA_MAX, 0.0, DELTA_MAX)


@pytest.mark.slow
def test_the_zeros_of_the_line_are_its_critical_speeds():
    found, margins = zero_speeds(ROBOT, LINE, BUMP, np.geomspace(0.3, 30, 90))
    np.testing.assert_allclose(found, critical_speeds(ROBOT, BUMP, 0.3, 30), rtol=1e-4)
    assert margins.shape == (90,)
    none, _ = zero_speeds(ROBOT, LINE, BUMP, [9.0, 10.0, 11.0])
    assert none.shape == (0,)


@pytest.mark.slow
def test_a_critical_speed_is_followed_through_other_laws():
    stiffness = np.array([760.0, 800.0, 830.0])
    laws = SpringLaw(0.0, stiffness * DELTA_MAX, 0.0, DELTA_MAX)
    found = [follow_speed(ROBOT, laws, BUMP, v) for v in (7.95, 20.4)]
    for k, speeds in zip(stiffness, np.transpose(found)):
        exact = critical_speeds(Robot(k, k), BUMP, 5, 30)
        np.testing.assert_allclose(speeds, exact, rtol=2e-4)


def test_a_critical_speed_that_is_gone_is_not_found():
    stopped = SpringLaw(0.0, 800 * DELTA_MAX, 0.0, DELTA_MAX, stop=[0.0, 8000.0])
    assert list(np.isfinite(follow_speed(ROBOT, stopped, BUMP, 7.95))) == [True, False]


def test_a_critical_stop_parts_the_stops_that_keep_contact():
    (critical,), margins = zero_stops(ROBOT, LINE, BUMP, 10, 800 * np.geomspace(0.1, 10, 5))
    assert (np.diff(margins) < 0).all()
    near = SpringLaw(0.0, 13.2, 0.0, DELTA_MAX, critical * np.array([0.999, 1.001]))
    assert list(drive(ROBOT, BUMP, 10, law=near).kept) == [True, False]


def test_draws_have_the_mean_and_the_covariance_of_students_t():
    fit = fitted(793, preload=0.4, curvature=1.0)
    beta = joint_draws(fit, 4096)
    free = fit.free
    error = fit.errors
    assert np.abs((beta.mean(axis=1) - fit.beta) / error).max() < 0.05
    expected = fit.covariance * free / (free - 2)
    np.testing.assert_allclose(np.cov(beta), expected, rtol=0.05)


def test_draws_of_one_coefficient_have_its_interval():
    fit = fitted(793, preload=0.4, curvature=1.0)
    ends = np.quantile(joint_draws(fit, 4096), [0.025, 0.975], axis=1).T
    wide = np.diff(fit.intervals(method="individual"), axis=1)
    assert np.abs((ends - fit.intervals(method="individual")) / wide).max() < 0.03


def test_draws_are_the_same_in_every_run():
    fit = fitted(793)
    assert np.array_equal(joint_draws(fit), joint_draws(fit))
    assert not np.array_equal(joint_draws(fit), joint_draws(fit, seed=1))


def test_readings_without_scatter_leave_nothing_to_draw():
    beta = joint_draws(fitted(793, noise=0.0), 8)
    np.testing.assert_allclose(beta, np.tile(beta[:, :1], 8), atol=1e-9)


# --- judgements -----------------------------------------------------------------------------------


def test_nothing_found_in_n_draws_leaves_three_nths():
    for n in (64, 128, 1024):
        assert math.isclose(Share(0, n).high, 3 / n, rel_tol=0.03)
        assert math.isclose(Share(n, n).low, 1 - 3 / n, rel_tol=0.03)
    assert (Share(0, 9).low, Share(9, 9).high) == (0, 1)


@pytest.mark.parametrize("found", [1, 7, 40])
def test_the_bounds_of_a_share_are_those_of_the_binomial_distribution(found):
    share = Share(found, 50)
    assert math.isclose(stats.binom.cdf(found, 50, share.high), 0.05, rel_tol=1e-6)
    assert math.isclose(stats.binom.sf(found - 1, 50, share.low), 0.05, rel_tol=1e-6)
    assert share.low < share.value < share.high


@pytest.mark.parametrize(
    ("found", "n", "verdict"),
    [(0, 128, False), (0, 64, None), (128, 128, True), (64, 128, None), (1, 128, None)],
)
def test_a_verdict_needs_draws_enough(found, n, verdict):
    assert Share(found, n).verdict is verdict


def driven(margins):
    margins = np.maximum(margins, 0)
    nothing = np.zeros_like(margins)
    return Drive(margins, *[nothing] * 6, *np.zeros((2, 2, *margins.shape)))


def test_the_same_draws_on_several_laws_count_once():
    drawn = {"a": driven(np.ones((8, 1))), "b": driven(-np.ones((8, 1)))}
    runs = {name: driven(one.margin[0]) for name, one in drawn.items()}
    study = Study((1.0,), DELTA_MAX, runs, drawn, {"a": [], "b": []}, {"a": [], "b": []})
    assert study.share(0) == (4, 8) and study.share(0, "b") == (8, 8)
    assert study.agreeing(0) == 1 and study.signed(0) is None
    assert study.margins(0, "b") is None and list(study.margins(0, "a")) == [1, 1]


def test_critical_speeds_within_a_tenth_are_one_family():
    critical = {"a": [0.4, 8.0], "b": [0.41], "c": [7.7]}
    followed = {name: [np.full(3, v) for v in speeds] for name, speeds in critical.items()}
    study = Study((), DELTA_MAX, dict.fromkeys("abc"), {}, critical, followed)
    slow, fast = study.families
    assert slow.laws == ("a", "b") and fast.laws == ("a", "c")
    assert slow.followed.shape == (3, 3) and np.isnan(slow.followed[2]).all()
    assert (fast.followed[2] == 7.7).all()
