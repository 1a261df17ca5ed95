"""What a suspension must do, and the least change that does it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import OptimizeResult

from suspension import choice as module
from suspension.choice import candidate, cheapest, demands, efficient, farthest, fitted_with
from suspension.contact import is_lost
from suspension.flight import fly
from suspension.least_force import margin
from suspension.problem import DISTANCE
from suspension.road import GaussianBump
from suspension.robot import Robot

ROBOT, BUMP = Robot(800, 800), GaussianBump()
ASKED = (0.25, 1.2, 5, 10)
K, C = np.geomspace(150, 1200, 9), np.geomspace(0.4, 4, 7)


@pytest.mark.slow
def test_demands_are_the_worst_of_flights():
    k, c, v = [300, 900], [0.5, 2], [0.8, 3]
    found = demands(ROBOT, BUMP, v, k, c)
    for i, j in np.ndindex(2, 2):
        robot = fitted_with(ROBOT, k[j], c[i])
        least, largest, deepest, air = np.inf, 0, 0, 0
        for speed in v:
            flight = fly(robot, BUMP, v=speed, tfinal=DISTANCE / speed)
            x = np.add.outer(robot.arms, speed * flight.T)
            compression = BUMP(x)[0] - flight.W[0] - robot.arms[:, None] * flight.W[2]
            least = min(least, max(0, margin(robot, BUMP, speed)))
            largest = max(largest, np.abs(flight.N.sum(axis=0) / robot.m - robot.g).max())
            deepest = max(deepest, compression.max())
            air = max(air, flight.airtime.max() * speed / DISTANCE)
        np.testing.assert_allclose(found.margin[i, j], least, atol=1e-3)
        np.testing.assert_allclose(found.acceleration[i, j], largest, rtol=5e-3)
        np.testing.assert_allclose(found.compression[i, j], deepest, rtol=1e-3)
        np.testing.assert_allclose(found.air[i, j], air, atol=1e-3)


def test_nothing_is_better_than_the_problems_robot_in_every_respect():
    # On a ground that pulls some two hundred seem to be.
    own = demands(ROBOT, BUMP, ASKED, [800.0], [1.5])
    k, c = np.geomspace(100, 3200, 16), np.geomspace(0.3, 15, 16)
    maps = demands(ROBOT, BUMP, ASKED, k, c)
    calmer, shorter = maps.acceleration < own.acceleration, maps.compression < own.compression
    assert calmer.any() and shorter.any() and not (calmer & shorter).any()
    assert (maps.margin >= 0).all() and own.acceleration < 17


def test_a_candidate_is_what_its_parts_say():
    one = candidate(ROBOT, BUMP, ASKED)
    assert one.robot is ROBOT
    assert one.margins == {v: margin(ROBOT, BUMP, v) for v in ASKED}
    for mine, theirs in zip(one.worst, demands(ROBOT, BUMP, ASKED, [800.0], [1.5])):
        assert np.array_equal(mine, theirs)
    assert list(one.regimes(ASKED)) == [margin <= 0 for margin in one.margins.values()]


def test_who_keeps_contact_costs_less_than_who_loses_it():
    maps = demands(ROBOT, BUMP, ASKED, K, C)
    contact, kept = maps.costs[0], maps.margin > 0
    assert 0 < kept.mean() < 1
    assert contact[kept].max() < 0 <= contact[~kept].min()
    assert np.array_equal(maps.costs[1:], [maps.acceleration, maps.compression])


def test_best_compromises_are_those_that_nothing_beats():
    costs = np.random.default_rng(1).uniform(size=(60, 3))
    best = efficient(costs)
    assert 1 < best.sum() < 60
    for i in range(60):
        beaten = any(
            (costs[j] <= costs[i]).all() and (costs[j] < costs[i]).any() for j in range(60)
        )
        assert best[i] != beaten
    assert efficient([[1, 1], [1, 1]]).all()
    assert list(efficient([[1, 2], [1, 1], [1, 1], [0, 3]])) == [False, True, True, True]
    assert list(efficient([[1, 2, 0], [1, 1, 0]])) == [False, True]


@pytest.mark.slow
@pytest.mark.parametrize("reserve", [0, 0.7])
def test_the_cheapest_change_reaches_what_is_asked_and_no_smaller_one_does(reserve):
    choice = cheapest(ROBOT, BUMP, ASKED, K, C, reserve)
    margins = [margin(choice.robot, BUMP, v) for v in ASKED]
    np.testing.assert_allclose(min(margins), reserve, atol=1e-5)
    assert min(margins) >= reserve and not is_lost(margins).any()
    np.testing.assert_allclose(choice.margin, min(margins), atol=1e-12)
    way = np.log([choice.robot.k1 / ROBOT.k1, choice.robot.c1 / ROBOT.c1])
    np.testing.assert_allclose(np.hypot(*way), choice.distance)
    for angle in np.linspace(0, 2 * np.pi, 60):
        point = np.exp(0.98 * choice.distance * np.array([np.cos(angle), np.sin(angle)]))
        other = fitted_with(ROBOT, ROBOT.k1 * point[0], ROBOT.c1 * point[1])
        assert min(margin(other, BUMP, v) for v in ASKED) < reserve


def test_the_search_begins_at_the_nearest_two_that_keep_contact(monkeypatch):
    begun = []

    def minimize(cost, first, **_):
        begun.append(first)
        return OptimizeResult(x=first)

    monkeypatch.setattr(module, "minimize", minimize)
    choice = cheapest(ROBOT, BUMP, ASKED, K[::2], C[::2])
    grid = [fitted_with(ROBOT, k, c) for k in K[::2] for c in C[::2]]
    kept = [other for other in grid if all(margin(other, BUMP, v) >= 0 for v in ASKED)]
    ways = [np.log([other.k1 / ROBOT.k1, other.c1 / ROBOT.c1]) for other in kept]
    nearest = sorted(ways, key=lambda way: np.hypot(*way))[:2]
    np.testing.assert_allclose(begun - np.log([ROBOT.k1, ROBOT.c1]), nearest, atol=1e-12)
    assert choice.distance == pytest.approx(np.hypot(*nearest[0]))


def test_who_has_it_already_changes_nothing():
    soft = Robot(250, 250)
    choice = cheapest(soft, BUMP, ASKED, K, C)
    assert choice.robot is soft and choice.distance == 0 and choice.margin > 0.5


def test_where_nothing_keeps_contact_there_is_no_choice():
    assert cheapest(ROBOT, BUMP, ASKED, K[-3:], C) is None


@pytest.mark.slow
@pytest.mark.parametrize("name", ["k", "c"])
def test_nothing_beyond_the_farthest_keeps_contact(name):
    """Brute force: all of a fine grid, beside which the search starts on a coarse one."""
    most = farthest(ROBOT, BUMP, ASKED, K, C, name)
    np.testing.assert_allclose(most.margin, 0, atol=1e-6)
    assert not is_lost(most.margin)
    k, c = np.geomspace(150, 1200, 53), np.geomspace(0.4, 4, 47)
    kept = demands(ROBOT, BUMP, ASKED, k, c).margin > 0
    beyond, own = (k, most.robot.k1) if name == "k" else (c[:, None], most.robot.c1)
    assert not (kept & (beyond > own)).any()
    assert (kept & (beyond > 0.94 * own)).any()


def test_the_farthest_is_none_or_at_the_end_of_the_grid():
    assert farthest(ROBOT, BUMP, ASKED, K[-3:], C, "k") is None
    for name, end in (("k", K[-1]), ("c", C[-1])):
        free = farthest(ROBOT, BUMP, [0.25], K, C, name)
        np.testing.assert_allclose(getattr(free.robot, f"{name}1"), end)
        assert free.margin > 0


@pytest.mark.parametrize("other", [{"k2": 700}, {"c1": 0, "c2": 0}, {"c2": 2}])
def test_axles_must_be_alike_and_damped(other):
    for function, more in ((cheapest, ()), (farthest, ("k",))):
        with pytest.raises(ValueError, match="robot must have"):
            function(replace(ROBOT, **other), BUMP, ASKED, K, C, *more)
