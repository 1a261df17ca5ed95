"""How far springs and body move: against the states themselves, and what moves with what."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from helpers import near

from suspension.contact import critical_speeds, exact_loss, margin, minima
from suspension.exact import over_bump
from suspension.flight import fly
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.simulation import simulate
from suspension.travel import balance, moments, overtravel, travel

ROBOT = Robot(800, 800)
LOPSIDED = Robot(700, 1000, L1=0.12, L2=0.09, c1=2.0, c2=0.5)
BUMP = GaussianBump()


def compressions(robot, bump, v, end):
    """The compressions of both springs in a fine run of the time loop, m, and the pitch, rad."""
    run = simulate(robot, bump, v=v, dt=end / 20000, tfinal=end)
    ends = run.W[0] - robot.L1 * run.W[2], run.W[0] + robot.L2 * run.W[2]
    grounds = bump(v * run.T - robot.L1)[0], bump(v * run.T + robot.L2)[0]
    return np.subtract(grounds, ends), run.W[2]


@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED], ids=["symmetric", "lopsided"])
@pytest.mark.parametrize("v", [0.25, 1.2, 10])
def test_travel_is_what_the_time_loop_does_until_contact_is_lost(robot, v):
    loss = exact_loss(robot, BUMP, v)
    compression, theta = compressions(robot, BUMP, v, loss.t if loss else 1.25 / v)
    found = travel(robot, BUMP, v)
    assert found.compression == pytest.approx(compression.max(), rel=1e-4)
    assert found.extension == pytest.approx(max(-compression.min(), 0), rel=1e-4, abs=1e-6)
    assert found.pitch == pytest.approx(np.abs(theta).max(), rel=1e-4)


def test_what_comes_after_a_loss_of_contact_does_not_count():
    v = 1.2
    whole, _ = compressions(ROBOT, BUMP, v, 1.25 / v)
    assert travel(ROBOT, BUMP, v).compression < 0.9 * whole.max()


def test_on_a_flat_road_the_springs_bear_the_weight_and_nothing_moves():
    found = travel(ROBOT, replace(BUMP, height=0), 1.0)
    assert found.compression == pytest.approx(ROBOT.m * ROBOT.g / (2 * 800), rel=1e-12)
    assert found.extension == 0
    assert found.pitch == pytest.approx(0, abs=1e-15)


@pytest.mark.parametrize("samples", [501, 4001])
def test_the_samples_are_dense_enough(samples):
    assert travel(ROBOT, BUMP, 1.2, samples).compression == pytest.approx(
        travel(ROBOT, BUMP, 1.2).compression, rel=1e-3
    )


@pytest.mark.slow
@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED], ids=["symmetric", "lopsided"])
@pytest.mark.parametrize("limit", [0.012, 0.0165, 0.02])
def test_overtravel_splits_the_speeds_where_the_limit_is_passed(robot, limit):
    ranges = overtravel(robot, BUMP, limit, 0.3, 15)
    speeds = np.geomspace(0.3001, 14.99, 50)
    beyond = [travel(robot, BUMP, v).compression > limit for v in speeds]
    inside = [any(low < v < high for low, high in ranges) for v in speeds]
    assert inside == beyond
    assert all(high < low for (_, high), (low, _) in pairwise(ranges))


@pytest.mark.slow
def test_overtravel_is_none_or_all_where_the_limit_is_out_of_reach():
    assert overtravel(ROBOT, BUMP, 1.0, 1, 3).shape == (0, 2)
    near(overtravel(ROBOT, BUMP, 1e-4, 1, 3), [[1, 3]], 1e-12)


@pytest.mark.parametrize("v", [0.25, 1.2, 5, 10])
def test_spring_and_damper_make_up_the_least_force(v):
    found = balance(LOPSIDED, BUMP, v)
    least = min(minima(LOPSIDED, BUMP, v), key=lambda minimum: minimum.force)
    assert found.wheel == least.wheel
    assert found.spring + found.damper == pytest.approx(margin(LOPSIDED, BUMP, v), rel=1e-12)
    w = over_bump(LOPSIDED, BUMP, v, least.t)
    x = least.X + LOPSIDED.arms
    arm, k = LOPSIDED.arms[found.wheel - 1], LOPSIDED.k[found.wheel - 1]
    height = BUMP(x)[0][found.wheel - 1]
    assert found.spring == pytest.approx(k * (height - w[0] - arm * w[2]), rel=1e-10)


def test_without_dampers_the_spring_is_all():
    undamped = Robot(800, 800, c1=0, c2=0)
    assert balance(undamped, BUMP, 1.2).damper == pytest.approx(0, abs=1e-11)


def test_the_moments_of_a_flight_are_told_in_order_and_are_those_of_its_events():
    flight = fly(ROBOT, BUMP, v=5, tfinal=0.25)
    told = moments(flight, ROBOT, BUMP)
    times = list(told)
    assert times == sorted(times) and len(set(told.values())) == len(told)
    assert flight.events[0].t in told
    landing = next(
        event
        for event in flight.events
        if event.kind == "landing" and event.wheel == flight.events[0].wheel
    )
    assert told[landing.t] == "it lands"
    _, highest = np.unravel_index(flight.gaps.argmax(), flight.gaps.shape)
    assert flight.T[highest] in told
    assert all(0 <= t <= flight.T[-1] for t in times)


@pytest.mark.slow
def test_the_moments_without_a_flight_are_the_wheels_on_the_bump():
    v = critical_speeds(ROBOT, BUMP, 0.3, 0.6)[0] / 2
    told = moments(fly(ROBOT, BUMP, v=v, tfinal=1.25 / v), ROBOT, BUMP)
    at = {words: v * t for t, words in told.items()}
    assert at["the front wheel is on its top"] + ROBOT.L2 == pytest.approx(BUMP.centre)
    assert at["the rear wheel is on its top"] - ROBOT.L1 == pytest.approx(BUMP.centre)
    assert list(told) == sorted(told)
