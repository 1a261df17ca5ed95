"""Critical speeds and stops of the measured spring, and draws of its coefficients."""

import math

import numpy as np
import pytest
from cases import DELTA_MAX, fitted
from scipy import stats

from suspension.contact import critical_speeds
from suspension.measured import (
    Findings,
    Share,
    Study,
    follow_speed,
    follow_speeds,
    joint_draws,
    surviving,
    zero_speeds,
    zero_stops,
)
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


def test_critical_speeds_are_followed_side_by_side_as_one_by_one():
    laws = SpringLaw(0.0, np.array([780.0, 800.0]) * DELTA_MAX, 0.0, DELTA_MAX, stop=[0.0, 8000.0])
    together = follow_speeds(ROBOT, laws, BUMP, [7.95, 20.4])
    single = [follow_speed(ROBOT, laws, BUMP, v) for v in (7.95, 20.4)]
    assert np.isfinite(together).sum() >= 2
    np.testing.assert_allclose(together, single, rtol=1e-6)
    assert follow_speeds(ROBOT, laws, BUMP, []).shape == (0, 2)


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


def driven(margins, compression=0.01):
    margins = np.maximum(margins, 0)
    nothing = np.zeros_like(margins)
    return Drive(
        margins, nothing, nothing, nothing, nothing + compression, *[nothing] * 2,
        *np.zeros((2, 2, *margins.shape)),
    )  # fmt: skip


def findings(*margins, spread=0.0, n=128, **how):
    """A law with such margins at the asked speeds, the n draws scatter evenly about them."""
    draws = np.array(margins) + np.linspace(-spread, spread, n)[:, None]
    return Findings(driven(np.array(margins), **how), driven(draws), [], [])


def study_of(**laws):
    return Study(range(len(laws["line"].run.margin)), DELTA_MAX, laws)


def test_a_share_counts_the_draws_that_lose_contact():
    law = findings(0.5, -2.0, spread=1.0)
    assert law.share(0) == (32, 128) and law.share(1) == (128, 128)
    assert law.margins(0) is None and law.margins(1) is None
    np.testing.assert_allclose(findings(3.0, spread=1.0).margins(0), [2.05, 3.95], rtol=1e-12)


def test_a_verdict_is_signed_if_every_law_leaves_no_doubt_of_it():
    """No mean over laws: one that disagrees, or is in doubt, cannot be outvoted."""
    sure, doubtful, lost = findings(1.0), findings(1.0, spread=1.05), findings(-1.0)
    assert study_of(line=sure).signed(0) is False and study_of(line=lost).signed(0) is True
    many = {f"law {i}": sure for i in range(50)}
    assert study_of(line=sure, **many).signed(0) is False
    assert study_of(line=sure, **many, other=lost).signed(0) is None
    assert study_of(line=sure, **many, other=doubtful).signed(0) is None
    few = findings(1.0, n=64)  # 3 / 64 is no certainty
    assert study_of(line=few).signed(0) is None


def test_laws_disagree_or_draws_do():
    study = study_of(
        line=findings(1.0, 1.0, 0.0), other=findings(1.0, -1.0, 0.0, spread=0.5, compression=0.02)
    )
    assert list(study.turned) == [False, True, False]
    assert list(study.unsure) == [False, False, True]
    assert study.touched.all() and study.line is study.laws["line"]
    assert not study_of(line=findings(1.0)).touched.any()


def test_critical_speeds_survive_if_every_law_has_them_within_a_tenth():
    assert surviving([[0.4, 8.0, 20.0], [0.41, 8.1], [0.4, 7.0, 20.0]]) == [0.4]
    assert surviving([[0.4, 8.0]]) == [0.4, 8.0]
    assert surviving([[], [0.4]]) == []
