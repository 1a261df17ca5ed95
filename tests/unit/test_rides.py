"""Long rides on rough roads: exact where nothing flies, those of `fly` where something does."""

from dataclasses import replace

import numpy as np
import pytest

from suspension.flight import fly
from suspension.frequency import rms, steady_start
from suspension.rides import rides
from suspension.road import ISO_8608, RoughRoad
from suspension.robot import Robot

ROBOT = Robot(800, 800)
ODD = Robot(700, 900, L1=0.09, L2=0.12, c1=2, c2=1)
ROAD = RoughRoad(ISO_8608["C"], length=4)


@pytest.mark.parametrize("robot", [ROBOT, ODD])
@pytest.mark.parametrize("v", [0.5, 1.2, 6])
def test_a_ground_that_pulls_leaves_the_exact_scatter(robot, v):
    found, exact = rides(robot, ROAD, v, ground="pulls"), rms(robot, ROAD, v)
    np.testing.assert_allclose(found.force, exact.force, rtol=1e-3)
    np.testing.assert_allclose(found.acceleration, exact.acceleration, rtol=1e-3)


def test_where_nothing_flies_the_ground_has_nothing_to_let_go():
    calm = replace(ROAD, roughness=ISO_8608["A"])
    pushes, pulls = (rides(ROBOT, calm, [0.5, 5], ground=name) for name in ("pushes", "pulls"))
    for one, other in zip(pushes, pulls):
        assert np.array_equal(one, other)
    assert not pushes.flights.any() and not pushes.air.any()


@pytest.mark.slow
@pytest.mark.parametrize("v", [1.2, 5])
@pytest.mark.parametrize("robot", [ROBOT, ODD])
def test_the_second_round_is_that_of_a_flight(robot, v):
    found = rides(robot, ROAD, v)
    period = ROAD.length / v
    start = steady_start(robot, ROAD, v)
    run = fly(robot, ROAD, v=v, tfinal=2 * period, w0=start, resolution=ROAD.shortest / 32)
    t = np.linspace(period, 2 * period, 40_001)
    N = np.array([np.interp(t, run.T, force) for force in run.N])
    load = robot.C @ robot.equilibrium
    force = np.sqrt(((N - load[:, None]) ** 2).mean(axis=1))
    np.testing.assert_allclose(found.force, force, rtol=0.01)
    squares = (N.sum(axis=0) / robot.m - robot.g) ** 2
    np.testing.assert_allclose(found.acceleration, np.sqrt(squares.mean()), rtol=0.01)
    np.testing.assert_allclose(found.air, (N <= 0).mean(axis=1), atol=2e-3)
    lifts = [e for e in run.events if e.kind == "lift-off" and e.t > period]
    assert found.flights.sum() == len(lifts) > 0


def test_a_ride_does_not_know_its_neighbours():
    roads = [[replace(ROAD, seed=seed)] for seed in (1, 2)]
    robots = np.array([ROBOT, ODD], dtype=object)
    together, alone = rides(robots, roads, 5), rides(ODD, roads[1][0], 5)
    for many, one in zip(together, alone):
        np.testing.assert_allclose(many[..., 1, 1], one, rtol=1e-9)
    assert together.force.shape == (2, 2, 2) and together.acceleration.shape == (2, 2)


def test_roads_are_of_one_length():
    with pytest.raises(ValueError, match="roads must be of one length"):
        rides(ROBOT, [ROAD, replace(ROAD, length=5)], 1)
    assert rides(ROBOT, ROAD, []).air.shape == (2, 0)


def test_the_roads_of_many_rides_are_refused_before_they_fill_the_memory(monkeypatch):
    monkeypatch.setattr("suspension.rides.MAX_PLACES", 3000)
    assert rides(ROBOT, replace(ROAD, seed=1), 5).air.shape == (2,)
    with pytest.raises(ValueError, match="roads must have at most 3e.03 steps together, got 12"):
        rides(ROBOT, [replace(ROAD, seed=seed) for seed in (1, 2, 3)], 5)


def test_very_many_rides_are_refused_before_they_are_written_down():
    robots, v = np.full((100_000, 1), ROBOT), np.linspace(1, 2, 100_000)
    with pytest.raises(ValueError, match="for each of 10000000000"):
        rides(robots, ROAD, v)
