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
    inside = [any(found.low < v < found.high for found in ranges) for v in speeds]
    assert inside == beyond
    assert all(before.high < after.low for before, after in pairwise(ranges))
    for found in ranges:
        within = np.geomspace(found.low, found.high, 60)[1:-1]
        most = max(travel(robot, BUMP, v).compression for v in within) / limit
        assert found.times == pytest.approx(most, rel=0.01) and found.times > 1


@pytest.mark.slow
def test_overtravel_is_none_or_all_where_the_limit_is_out_of_reach():
    assert overtravel(ROBOT, BUMP, 1.0, 1, 3) == ()
    (found,) = overtravel(ROBOT, BUMP, 1e-4, 1, 3)
    near(found[:2], [1, 3], 1e-12)


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


@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED], ids=["symmetric", "lopsided"])
@pytest.mark.parametrize("v", [0.3, 0.4366, 5, 20.43])
def test_a_spring_that_still_pushes_at_the_least_force_is_pulled_by_its_damper(robot, v):
    found = balance(robot, BUMP, v)
    rear = robot.m * robot.g * robot.L2 / (robot.L1 + robot.L2)
    assert found.rest == pytest.approx([rear, robot.m * robot.g - rear][found.wheel - 1])
    assert found.pulled == (found.spring > found.rest / 7)


def test_whether_the_damper_pulls_does_not_depend_on_the_size_of_the_robot():
    for factor in (1e-3, 1, 1e3):
        sizes = {
            name: factor * getattr(ROBOT, name) for name in ("k1", "k2", "m", "Izz", "c1", "c2")
        }
        robot = replace(ROBOT, **sizes)
        assert not balance(robot, BUMP, 0.4367).pulled and balance(robot, BUMP, 20.42).pulled


def test_the_moments_of_a_flight_are_told_in_order_and_are_those_of_its_events():
    flight = fly(ROBOT, BUMP, v=5, tfinal=0.25)
    told = moments(flight, ROBOT, BUMP)
    times = [moment.t for moment in told]
    assert times == sorted(times) and len(set(told)) == len(told)
    at = {moment.kind: moment for moment in told}
    first = flight.events[0]
    assert at["lift-off"] == ("lift-off", first.wheel, first.t)
    landing = next(e for e in flight.events if (e.kind, e.wheel) == ("landing", first.wheel))
    assert at["landing"] == ("landing", first.wheel, landing.t)
    assert first.t < at["apex"].t < landing.t
    i, highest = np.unravel_index(flight.gaps.argmax(), flight.gaps.shape)
    assert any(t == flight.T[highest] for t in times)
    if at["apex"].t != flight.T[highest]:
        assert at["highest"].wheel == i + 1
    assert all(0 <= t <= flight.T[-1] for t in times)


def test_the_story_of_a_flight_ends_with_the_way():
    flight = fly(ROBOT, BUMP, v=5, tfinal=0.25)
    landing = next(m.t for m in moments(flight, ROBOT, BUMP) if m.kind == "landing")
    told = moments(flight, ROBOT, BUMP, distance=0.99 * 5 * landing)
    assert "landing" not in [moment.kind for moment in told]
    assert all(moment.t < landing for moment in told)
    with pytest.raises(ValueError, match="flight's v must be a finite number > 0"):
        moments(fly(ROBOT, BUMP, v=0, tfinal=0.25), ROBOT, BUMP)


@pytest.mark.slow
def test_the_moments_without_a_flight_are_the_wheels_on_the_bump():
    v = critical_speeds(ROBOT, BUMP, 0.3, 0.6)[0] / 2
    told = moments(fly(ROBOT, BUMP, v=v, tfinal=1.25 / v), ROBOT, BUMP)
    arms = {2: ROBOT.L2, None: 0, 1: -ROBOT.L1}
    top = {moment.wheel: v * moment.t for moment in told if moment.kind == "top"}
    assert list(top) == [2, None, 1]
    for wheel, arm in arms.items():
        assert top[wheel] + arm == pytest.approx(BUMP.centre)
    assert told[-1][:2] == ("past", None)
    assert v * told[-1].t - ROBOT.L1 == pytest.approx(BUMP.centre + 2 * BUMP.sigma)
    assert [moment.t for moment in told] == sorted(moment.t for moment in told)
