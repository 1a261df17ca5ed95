"""Critical speeds over an interval of stiffnesses, beside all critical speeds at many of them."""

from dataclasses import replace
from functools import cache

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from suspension import GaussianBump, Robot
from suspension.contact import critical_speeds, margin
from suspension.springs import Stiffness, fit_spring
from suspension.uncertainty import (
    critical_speed_intervals,
    critical_speeds_by_stiffness,
    loss_probability,
)

ROBOT, BUMP = Robot(800, 800), GaussianBump()


def known_to(half, k):
    """A stiffness with a 95 % interval of so many N/m on either side."""
    return Stiffness("known", k, half / stats.t.ppf(0.975, 18), 18)


def robot_at(k):
    return replace(ROBOT, k1=k, k2=k)


@cache
def speeds_at(k, vmin, vmax):
    return critical_speeds(robot_at(k), BUMP, vmin, vmax)


@cache
def intervals(k, half, vmin, vmax):
    return critical_speed_intervals(known_to(half, k), ROBOT, BUMP, vmin, vmax)


def fitted(k, beta0=0.0, beta2=0.0, sigma=0.05, n=21):
    x = np.linspace(0, 1, n)
    noise = np.random.default_rng(1).normal(0, sigma, n)
    force = beta0 + k * 0.0165 * x + beta2 * x**2 + noise
    return fit_spring(pd.DataFrame({"delta_over_delta_max": x, "force": force}))


# --- branches ---------------------------------------------------------------------------------

# Ranges of speed around the slow critical speeds, where pairs come and go, and around the others.
SLOW, FAST = (0.38, 0.5), (4.0, 30.0)


@pytest.mark.slow
@pytest.mark.parametrize("k, half, vmin, vmax", [
    (1000, 300, *SLOW),
    (986.7, 37, *SLOW),
    (1000, 30, 0.4021, 0.45),  # a branch leaves the range of speeds
    (600, 60, 4.9, 6.0),
    (970, 60, 0.3999, 0.41),  # a branch leaves the range and comes back
    (405, 15, 2.5, 4.0),
])  # fmt: skip
def test_branches_are_the_critical_speeds_at_every_stiffness(k, half, vmin, vmax):
    found = intervals(k, half, vmin, vmax)
    assert list(found) == sorted(found, key=lambda c: c.low * c.high)
    at_estimate = [c.speed for c in found if c.speed is not None]
    np.testing.assert_allclose(at_estimate, speeds_at(k, vmin, vmax), rtol=1e-9)

    low, high = k - half, k + half
    lowest, highest = np.full(len(found), np.inf), np.zeros(len(found))
    for stiffness in np.linspace(low, high, 9)[1:-1]:
        expected = speeds_at(stiffness, vmin, vmax)
        alive = [
            i
            for i, c in enumerate(found)
            if (c.born.k if c.born else low) <= stiffness <= (c.dies.k if c.dies else high)
        ]
        assert len(alive) == len(expected), f"at k = {stiffness}"
        for i, v in zip(alive, expected):
            lowest[i], highest[i] = min(lowest[i], v), max(highest[i], v)
    for i, c in enumerate(found):
        assert c.low <= lowest[i] * (1 + 1e-9) and highest[i] <= c.high * (1 + 1e-9)
        assert c.speed is None or c.low <= c.speed <= c.high
        if np.isfinite(lowest[i]) and c.everywhere:  # the ends belong to the interval
            ends = [speeds_at(end, vmin, vmax) for end in (low, high)]
            for end in ends:
                assert np.isclose(end, np.clip(end, c.low, c.high), rtol=1e-9).any()


@pytest.mark.slow
def test_a_pair_vanishes_where_the_search_at_one_stiffness_finds_it_no_more():
    found = intervals(986.7, 37, *SLOW)
    first, second, third = found
    assert first.everywhere and first.born is None and first.dies is None
    assert second.dies == third.dies and second.dies.why == "pair"
    end = second.dies.k
    assert end == pytest.approx(990.54, abs=0.01)
    assert len(speeds_at(end - 0.01, *SLOW)) == 3 and len(speeds_at(end + 0.02, *SLOW)) == 1
    assert second.low < second.speed < second.high <= second.dies.v * (1 + 1e-5)
    assert second.speed == pytest.approx(0.44484, abs=1e-5)
    assert third.speed == pytest.approx(0.44594, abs=1e-5)


@pytest.mark.slow
def test_a_pair_that_is_not_there_at_the_estimate_is_reported():
    found = intervals(1000, 300, *SLOW)
    assert [c.speed is None for c in found] == [False, True, True]
    assert found[1].dies.k == found[2].dies.k == pytest.approx(990.54, abs=0.01)
    assert found[1].born and found[2].born is None


@pytest.mark.slow
def test_a_pair_is_born():
    found = intervals(1000, 300, *SLOW)
    born = [c for c in found if c.born is not None]
    assert len(born) == 2
    for c in born:
        assert c.born.k == pytest.approx(906.05, abs=0.01)
        assert c.born.v == pytest.approx(0.40646, abs=1e-5)
    assert born[0].low < born[0].born.v == born[1].low < born[1].high


@pytest.mark.slow
def test_a_critical_speed_that_leaves_the_range_says_where():
    (only,) = intervals(600, 100, 5.2, 8.0)
    assert only.born is not None and only.born.why == "range" and only.dies is None
    assert only.low == only.born.v == pytest.approx(5.2, rel=1e-14)
    assert margin(robot_at(only.born.k), BUMP, 5.2) == pytest.approx(0, abs=1e-6)


@pytest.mark.slow
def test_a_critical_speed_that_hardly_leaves_the_range_is_not_counted_twice():
    (only,) = intervals(960, 30, 0.39974, 0.41)  # leaves it by 1.5e-5 of its value, for 4 N/m
    assert only.low == pytest.approx(0.39974, rel=1e-4)
    assert only.speed == pytest.approx(0.400242, abs=1e-6)


@pytest.mark.slow
def test_a_stiffness_known_exactly_has_critical_speeds_known_exactly():
    exact = Stiffness("exact", 800.0, 0.0, 18)
    found = critical_speed_intervals(exact, ROBOT, BUMP, *FAST)
    assert [(c.speed, c.low, c.high) for c in found] == [(v,) * 3 for v in speeds_at(800, *FAST)]
    assert found and all(c.everywhere for c in found)


@pytest.mark.slow
def test_a_stiffness_that_is_hardly_known_is_followed_no_further_than_a_factor_of_twenty():
    found = intervals(800, 810, 20, 21)
    assert found and all(20 <= c.low * (1 + 1e-14) for c in found)
    assert all(c.high <= 21 * (1 + 1e-14) for c in found)


@pytest.mark.slow
@pytest.mark.parametrize("fit, vmin, vmax", [
    (fitted(800), 7.5, 8.5),
    (fitted(500, 0.5, 2.5), 3.9, 7.0),
], ids=["linear", "curved"])  # fmt: skip
def test_each_stiffness_of_a_spring_has_its_critical_speeds(fit, vmin, vmax):
    pairs = critical_speeds_by_stiffness(fit, ROBOT, BUMP, vmin, vmax)
    assert [s for s, _ in pairs] == list(fit.stiffnesses(ROBOT.m * ROBOT.g / 2))
    for stiffness, found in pairs:
        alone = critical_speed_intervals(stiffness, ROBOT, BUMP, vmin, vmax)
        assert found
        assert len(found) == len(alone)
        for together, apart in zip(found, alone):
            np.testing.assert_allclose(together[:3], apart[:3], rtol=1e-9)
            assert together.everywhere and apart.everywhere


@pytest.mark.slow
def test_a_fit_stands_for_its_slope_at_zero():
    fit = fitted(800)
    assert critical_speed_intervals(fit, ROBOT, BUMP, 7, 9) == critical_speed_intervals(
        fit.slope, ROBOT, BUMP, 7, 9
    )
    assert loss_probability(fit, ROBOT, BUMP, 8) == loss_probability(fit.slope, ROBOT, BUMP, 8)


@pytest.mark.parametrize("function", [
    lambda k: critical_speed_intervals(k, ROBOT, BUMP, 1, 2),
    lambda k: loss_probability(k, ROBOT, BUMP, 1)])  # fmt: skip
def test_a_bare_number_is_no_stiffness(function):
    with pytest.raises(TypeError, match="^stiffness must be a Stiffness or a SpringFit, got 800"):
        function(800)


# --- probabilities ----------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("v", [0.4455, 7.9, 20.4])
def test_the_probability_of_a_loss_is_the_share_of_stiffnesses_that_lose(v):
    stiffness = known_to(30, 985) if v < 1 else known_to(40, 800)
    levels = (np.arange(250) + 0.5) / 250
    lost = [margin(robot_at(k), BUMP, v) <= 0 for k in stiffness.distribution.ppf(levels)]
    share = np.mean(lost)
    assert 0.02 < share < 0.98
    assert loss_probability(stiffness, ROBOT, BUMP, v) == pytest.approx(share, abs=0.009)


@pytest.mark.parametrize("v, lost", [(0.25, 0.0), (5, 1.0)])
def test_far_from_a_critical_speed_the_verdict_is_certain(v, lost):
    assert loss_probability(known_to(40, 800), ROBOT, BUMP, v) == pytest.approx(lost, abs=1e-6)
    assert loss_probability(Stiffness("exact", 800.0, 0.0, 18), ROBOT, BUMP, v) == lost


@pytest.mark.slow
def test_a_stiffness_that_is_known_to_roundoff_is_known():
    """Its speeds are points; and where it just keeps contact there is a verdict, no chance."""
    v = critical_speeds(ROBOT, BUMP, 0.3, 30)[0]
    sure, unsure = (Stiffness("near", 800.0, error, 18) for error in (1e-7, 1e-5))
    assert loss_probability(sure, ROBOT, BUMP, v) in (0, 1)
    assert 0 < loss_probability(unsure, ROBOT, BUMP, v) < 1
    for stiffness, is_point in ((sure, True), (unsure, False)):
        found = critical_speed_intervals(stiffness, ROBOT, BUMP, 0.3, 30)
        assert all((part.low == part.high) == is_point for part in found)
