"""Energy over a crossing: it adds up, and a landing costs what its damper takes."""

import numpy as np
import pytest

from suspension import FlatRoad, GaussianBump, Robot, fly
from suspension.energy import energy, landings

ROBOT, BUMP = Robot(800, 800), GaussianBump()
CROOKED = Robot(500, 900, m=2.0, L1=0.08, L2=0.13, c1=3.0, c2=1.0)


@pytest.mark.parametrize("robot", [ROBOT, CROOKED])
@pytest.mark.parametrize("v", [pytest.param(0.25, marks=pytest.mark.slow), 1.2, 5, 25])
@pytest.mark.parametrize("wheel", ["follows", "relaxes"])
def test_what_the_road_puts_in_is_all_there(robot, v, wheel):
    flight = fly(robot, BUMP, v=v, tfinal=1.25 / v, wheel=wheel, samples=40001)
    e = energy(flight, robot, BUMP)
    scale = e.work.max()
    assert np.abs(e.kinetic + e.potential + e.heat - e.work).max() < 5e-7 * scale
    if wheel == "relaxes":  # heat is made, never taken back
        assert np.diff(e.heat).min() > -1e-9 * scale
    assert min(e.kinetic.min(), e.potential.min()) > -1e-6 * scale


@pytest.mark.slow
def test_after_a_long_time_all_of_it_is_heat():
    flight = fly(ROBOT, BUMP, v=1.2, tfinal=4, samples=40001)
    e = energy(flight, ROBOT, BUMP)
    assert e.heat[-1] == pytest.approx(e.work[-1], rel=1e-3)


def test_a_robot_without_dampers_makes_no_heat():
    robot = Robot(800, 800, c1=0, c2=0)
    e = energy(fly(robot, BUMP, v=1.2, tfinal=1, samples=40001), robot, BUMP)
    # The rule of the free wheel lets a spring jump by nothing: it lifts off at p = 0.
    assert np.abs(e.heat).max() < 1e-7 * e.work.max()


def test_a_dropped_robot_turns_its_fall_into_an_impulse():
    y0, tfinal = 0.05, 6.0
    flight = fly(ROBOT, FlatRoad(), v=0, tfinal=tfinal, w0=[y0, 0, 0, 0], samples=60001)
    found = landings(flight, ROBOT, FlatRoad())
    first = found[0]
    assert first.speed == pytest.approx(np.sqrt(2 * 9.81 * y0), rel=1e-6)
    assert first.force == pytest.approx(1.5 * first.speed, rel=1e-9)
    # All impulses together carry the weight for the whole time: it rests at the end.
    total = sum(landing.impulse for landing in found)
    assert total == pytest.approx(ROBOT.m * ROBOT.g * tfinal, rel=1e-4)
    # All heat together is the fall from y0 to rest less what the springs keep; a little of it is
    # made in the air, by springs that had not quite stretched at lift-off.
    sag = ROBOT.equilibrium[0]
    lost = ROBOT.m * ROBOT.g * (y0 - sag) - ROBOT.k @ np.array([sag, sag]) ** 2 / 2
    heat = energy(flight, ROBOT, FlatRoad()).heat[-1]
    assert heat == pytest.approx(lost, rel=1e-4)
    assert 0.98 * heat < sum(landing.heat for landing in found) < heat


@pytest.mark.parametrize("bad", [{"flight": 1}, {"robot": None}])
@pytest.mark.parametrize("function", [energy, landings])
def test_bad_input_is_named(function, bad):
    good = {"flight": fly(ROBOT, BUMP, v=5, tfinal=0.1), "robot": ROBOT, "road": BUMP}
    with pytest.raises(TypeError, match=next(iter(bad))):
        function(**(good | bad))
