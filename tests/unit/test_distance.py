"""How far one looks: no answer depends on where the bump lies, and none is cut short silently."""

import re
from dataclasses import replace
from functools import cache
from inspect import signature

import numpy as np
import pytest
from cases import fitted
from scipy.integrate import solve_ivp

from suspension import (
    accuracy,
    branches,
    choice,
    contact,
    critical,
    exact,
    least_force,
    problem,
    travel,
    uncertainty,
)
from suspension.contact import critical_speeds, exact_loss, margin, regimes
from suspension.flight import fly
from suspension.least_force import distance_over
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import RK4

ROBOT, BUMP = Robot(800, 800), GaussianBump()
LOPSIDED = Robot(700, 1000, L1=0.12, L2=0.09, c1=2.0, c2=0.5)
FAR = replace(BUMP, centre=1.4)
FIT = fitted(800)
GRID = {"v": [5.0], "k": [700.0, 800.0], "c": [1.0, 1.5]}
DRIVES = {  # every function that drives over the bump, with the rest of its arguments
    "margin": lambda bump, **way: margin(ROBOT, bump, 5, **way),
    "minima": lambda bump, **way: contact.minima(ROBOT, bump, 5, **way),
    "turning_points": lambda bump, **way: least_force.turning_points(
        exact.Crossing(ROBOT, bump, 5), **way
    ),
    "distance_over": lambda bump, **way: distance_over(ROBOT, bump, **way),
    "duration": lambda bump, **way: least_force.duration(ROBOT, bump, 5, **way),
    "exact_loss": lambda bump, **way: exact_loss(ROBOT, bump, 5, **way),
    "critical_speeds": lambda bump, **way: critical_speeds(ROBOT, bump, 7, 9, **way),
    "regimes": lambda bump, **way: regimes(ROBOT, bump, 7, 9, **way),
    "critical_stiffness": lambda bump, **way: critical.critical_stiffness(
        ROBOT, bump, 5, 560, 590, **way
    ),
    "sensitivity": lambda bump, **way: critical.sensitivity(ROBOT, bump, 5, "k1", **way),
    "travel": lambda bump, **way: travel.travel(ROBOT, bump, 5, **way),
    "overtravel": lambda bump, **way: travel.overtravel(ROBOT, bump, 0.0165, 7, 9, **way),
    "margin_map": lambda bump, **way: travel.margin_map(ROBOT, bump, [5], [800], **way),
    "compression_map": lambda bump, **way: travel.compression_map(ROBOT, bump, [5], [800], **way),
    "balance": lambda bump, **way: travel.balance(ROBOT, bump, 5, **way),
    "moments": lambda bump, **way: travel.moments(
        fly(ROBOT, bump, v=5, tfinal=0.1), ROBOT, bump, **way
    ),
    "branches": lambda bump, **way: branches.branches(ROBOT, bump, 7.9, 8, 790, 800, **way),
    "critical_speed_intervals": lambda bump, **way: uncertainty.critical_speed_intervals(
        FIT.slope, ROBOT, bump, 7.9, 8, **way
    ),
    "critical_speeds_by_stiffness": lambda bump, **way: uncertainty.critical_speeds_by_stiffness(
        FIT, ROBOT, bump, 7.9, 8, **way
    ),
    "loss_probability": lambda bump, **way: uncertainty.loss_probability(
        FIT, ROBOT, bump, 5, **way
    ),
    "errors": lambda bump, **way: accuracy.errors(ROBOT, bump, v=5, dt=0.01, scheme=RK4, **way),
    "error_table": lambda bump, **way: accuracy.error_table(
        ROBOT, bump, v=5, dts=[0.01], scheme=RK4, **way
    ),
    "solve_ivp_errors": lambda bump, **way: accuracy.solve_ivp_errors(
        ROBOT, bump, v=5, method="RK45", tolerances=[0.1], **way
    ),
    "disagreement": lambda bump, **way: accuracy.disagreement(ROBOT, bump, 5, **way),
    "event_run": lambda bump, **way: accuracy.event_run(ROBOT, bump, 5, **way),
    "overlooked": lambda bump, **way: accuracy.overlooked(ROBOT, bump, [5], **way),
    "just_lost": lambda bump, **way: accuracy.just_lost(ROBOT, bump, [7.9457], 2, **way),
    "missed_dip": lambda bump, **way: accuracy.missed_dip(ROBOT, bump, 5, **way),
    "candidate": lambda bump, **way: choice.candidate(ROBOT, bump, [7, 9], **way),
    "cheapest": lambda bump, **way: choice.cheapest(ROBOT, bump, **GRID, **way),
    "farthest": lambda bump, **way: choice.farthest(ROBOT, bump, **GRID, name="k", **way),
}
each_drive = pytest.mark.parametrize("drive", DRIVES.values(), ids=DRIVES)


def test_the_table_holds_every_function_over_a_bump():
    modules = (least_force, contact, critical, travel, branches, uncertainty, accuracy, choice)
    found = {"turning_points"}  # of a crossing, which has the bump
    for module in modules:
        functions = {name: getattr(module, name) for name in module.__all__}
        for name, function in functions.items():
            if callable(function) and "bump" in signature(function).parameters:
                found.add(name)
    assert found == set(DRIVES)


@each_drive
def test_a_bump_beyond_the_course_is_refused_with_a_distance_that_does(drive):
    with pytest.raises(ValueError, match="^distance must be given") as refused:
        drive(FAR)
    told = float(re.search(r"given, ([\d.]+) m or more", str(refused.value))[1])
    assert FAR.centre + 4 * FAR.sigma + ROBOT.L1 <= told < FAR.centre + 5 * FAR.sigma + ROBOT.L1
    drive(FAR, distance=told)


@each_drive
@pytest.mark.parametrize(
    "way",
    [
        pytest.param({}, id="course"),
        pytest.param({"distance": 3.0}, id="distance", marks=pytest.mark.slow),
    ],
)
def test_a_wheel_that_starts_on_the_bump_is_refused_with_a_place_that_does(drive, way):
    with pytest.raises(ValueError, match="^bump must begin ahead") as refused:
        drive(replace(BUMP, centre=0.2), **way)
    told = float(re.search(r"centre must be at ([\d.]+) m or more", str(refused.value))[1])
    assert 0.107 + 4 * BUMP.sigma <= told < 0.107 + 5 * BUMP.sigma
    drive(replace(BUMP, centre=told), **way)


def test_both_are_told_where_place_and_distance_are_wrong():
    car = Robot(28000, 25000, c1=1800, c2=1600, m=730, Izz=1230, L1=1.4, L2=1.1)
    wide = GaussianBump(height=0.1, sigma=0.3, centre=2.0)
    with pytest.raises(ValueError, match="centre must be at") as refused:
        margin(car, wide, 10)
    found = re.search(r"at ([\d.]+) m or more .*, and distance ([\d.]+) m or", str(refused.value))
    centre, distance = map(float, found.groups())
    assert np.isfinite(margin(car, replace(wide, centre=centre), 10, distance=distance))
    with pytest.raises(ValueError, match="distance must be given"):
        margin(car, replace(wide, centre=centre), 10)


@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED], ids=["symmetric", "lopsided"])
@pytest.mark.parametrize("sigma", [0.01, 0.0288, 0.05])
def test_the_course_is_long_enough_exactly_if_both_wheels_pass_four_sigmas(robot, sigma):
    first, last = robot.L2 + 4 * sigma, problem.DISTANCE - robot.L1 - 4 * sigma
    for centre, allowed in (
        (first, True),
        (last, True),
        (first - 1e-6, False),
        (last + 1e-6, False),
    ):
        bump = GaussianBump(sigma=sigma, centre=centre)
        if allowed:
            assert distance_over(robot, bump) == problem.DISTANCE
        else:
            with pytest.raises(ValueError, match="distance|bump"):
                distance_over(robot, bump)


def test_a_distance_is_taken_as_it_is():
    assert distance_over(ROBOT, BUMP, 0.3) == 0.3  # ends on the bump
    between = GaussianBump(sigma=0.01, centre=0.0)  # under no wheel, and the rear one passes it
    assert distance_over(ROBOT, between, 0.5) == 0.5
    for centre in (0.0, -1.0):
        with pytest.raises(ValueError, match="bump must begin ahead"):
            distance_over(ROBOT, replace(between, centre=centre))


def test_time_or_distance_but_not_both():
    with pytest.raises(ValueError, match="distance must be None if tfinal is given"):
        margin(ROBOT, BUMP, 5, 0.25, distance=1.25)
    assert margin(ROBOT, BUMP, 5, 0.2) == margin(ROBOT, BUMP, 5, distance=1.0)


@pytest.mark.slow
@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED], ids=["symmetric", "lopsided"])
def test_robot_and_bump_moved_along_give_the_same_answers(robot):
    here = regimes(robot, BUMP, 0.1, 30)
    for away in (0.9, 5.0):
        moved = replace(BUMP, centre=BUMP.centre + away)
        there = regimes(robot, moved, 0.1, 30, distance=problem.DISTANCE + away)
        np.testing.assert_allclose(there.edges, here.edges, rtol=1e-9)
        np.testing.assert_array_equal(there.lost, here.lost)
        for v in (0.25, 1.2, 5, 10):
            loss, later = (
                exact_loss(robot, BUMP, v),
                exact_loss(robot, moved, v, distance=problem.DISTANCE + away),
            )
            assert (loss is None) == (later is None)
            if loss:
                assert loss.wheel == later.wheel
                assert later.t - away / v == pytest.approx(loss.t, rel=1e-8)


@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED, replace(ROBOT, c1=0, c2=0)])
@pytest.mark.parametrize("v", [0.3, 1.2, 7.5, 8.3, 25])
def test_a_longer_way_after_the_bump_only_adds_minima(robot, v):
    ways = np.linspace(0.6, 4, 18)
    least = [margin(robot, BUMP, v, distance=way) for way in ways]
    assert (np.diff(least) <= 1e-12).all()
    t, N = least_force.turning_points(exact.Crossing(robot, BUMP, v), distance=ways[-1])
    for way, force in zip(ways, least, strict=True):
        assert force <= N[:, v * t <= way].min() + 1e-12


@cache
def own_regimes(robot):
    """Those over the problem's bump, which are the same for every copy."""
    return regimes(robot, BUMP, 0.1, 30)


@pytest.mark.slow
@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED], ids=["symmetric", "lopsided"])
@pytest.mark.parametrize("units", [(1, 0.1, 1, 1), (500, 13, 2, 2.5), (0.03, 1, 0.2, 0.7)])
def test_a_scaled_copy_keeps_and_loses_contact_alike(robot, units):
    """Units of mass, length along the road, height and time are free: five groups are left."""
    mass, length, height, time = units
    copy = Robot(
        *(robot.k * mass / time**2),
        g=robot.g * height / time**2,
        m=robot.m * mass,
        Izz=robot.Izz * mass * length**2,
        L1=robot.L1 * length,
        L2=robot.L2 * length,
        c1=robot.c1 * mass / time,
        c2=robot.c2 * mass / time,
    )
    bump = GaussianBump(BUMP.height * height, BUMP.sigma * length, BUMP.centre * length)
    speed, way = length / time, problem.DISTANCE * length
    own = own_regimes(robot)
    others = regimes(copy, bump, 0.1 * speed, 30 * speed, distance=way)
    np.testing.assert_allclose(others.edges, own.edges * speed, rtol=1e-9)
    np.testing.assert_array_equal(others.lost, own.lost)
    assert margin(copy, bump, 5 * speed, distance=way) == pytest.approx(
        margin(robot, BUMP, 5) * mass * height / time**2, rel=1e-9
    )


# Published half-cars: m, Izz, L2 (front), L1 (rear), k2, k1, c2, c1, with two wheels on each axle.
HALF_CARS = {
    # MathWorks, "Automotive Suspension" (sldemo_suspn), Table 1; its forces are twice a wheel's.
    "MathWorks": (1200, 2100, 0.9, 1.2, 2 * 28000, 2 * 21000, 2 * 2500, 2 * 2000),
    # x-engineer.org, "Modeling and simulation of an automotive suspension": a table of parameters.
    "x-engineer": (1200, 2100, 1.2, 0.8, 35000, 35000, 2900, 2900),
    # Abid, Chen and Nassar, Int. Scholarly Research Notices 2015, 974020, Table 2: a whole car.
    "Abid": (1460, 2460, 1.011, 1.803, 2 * 19960, 2 * 17500, 2 * 1290, 2 * 1690),
}


def least_by_newton(car, bump, v, distance):
    """The least force on each wheel from Newton's equations typed anew, by DOP853."""
    m, Izz, front, rear, kf, kr, cf, cr = car
    g = 9.81

    def forces(X, w):
        Y, dY, theta, dtheta = w
        pressed = []
        for arm, k, c in ((front, kf, cf), (-rear, kr, cr)):
            s = (X + arm - bump.centre) / bump.sigma
            h = bump.height * np.exp(-(s**2) / 2)
            dh = -v * h * s / bump.sigma
            pressed.append(k * (h - Y - arm * theta) + c * (dh - dY - arm * dtheta))
        return pressed

    def rate(X, w):
        F, R = forces(X, w)
        return np.array([w[1], (F + R) / m - g, w[3], (front * F - rear * R) / Izz]) / v

    # At rest: the axles share the weight as a lever does, and each spring gives by what it bears.
    low = [m * g * rear / (front + rear) / kf, m * g * front / (front + rear) / kr]
    theta = (low[1] - low[0]) / (front + rear)
    start = [-low[0] - front * theta, 0, theta, 0]
    X = np.linspace(0, distance, 12001)
    tight = {"rtol": 1e-8, "atol": 1e-11, "max_step": bump.sigma / 2}  # of 1e-4 that are asked for
    run = solve_ivp(rate, (0, distance), start, "DOP853", t_eval=X, **tight)
    return [np.min(N) for N in forces(X, run.y)]


@pytest.mark.slow
@pytest.mark.parametrize("name", HALF_CARS)
@pytest.mark.parametrize("height", [0.05, 0.1])
def test_published_half_cars_agree_with_a_tight_integration_on_every_verdict(name, height):
    car = HALF_CARS[name]
    m, Izz, front, rear, kf, kr, cf, cr = car
    robot = Robot(kr, kf, m=m, Izz=Izz, L1=rear, L2=front, c1=cr, c2=cf)
    bump, distance = GaussianBump(height, sigma=0.3, centre=5.0), 25.0
    found = regimes(robot, bump, 1, 40, distance=distance)
    speeds, sampled = np.geomspace(1, 40, 40), 1e-4 * m * robot.g
    for v in speeds:
        front_least, rear_least = least_by_newton(car, bump, v, distance)
        rear_exact, front_exact = contact.minima(robot, bump, v, distance=distance)
        assert abs(front_exact.force - front_least) < sampled
        assert abs(rear_exact.force - rear_least) < sampled
        assert abs(min(front_least, rear_least)) > sampled  # no case too close to call
        assert found(v) == (min(front_least, rear_least) <= 0)
    if height == 0.1:
        assert 0 < found(speeds).sum() < len(speeds)  # both verdicts are there
