"""Critical speeds of the full geometry, beside a rigid body that another integrator moves."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from suspension.contact import critical_speeds, margin
from suspension.problem import DISTANCE
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.small_angle import TERMS, full_geometry, margin_with

BUMP = GaussianBump()
ROBOT = Robot(793, 793)


def margin_of_a_rigid_body(robot, v):
    """The least force on a ground that pulls, from Newton's and Euler's laws of a rigid body, N."""

    def forces(X, w):
        Y, rise, theta, turn = w
        sine, cosine = np.sin(theta), np.cos(theta)
        place = X + np.outer(robot.arms, cosine)
        h, slope = BUMP(place)
        p = h - Y - np.outer(robot.arms, sine)
        rate = slope * (v - np.outer(robot.arms, sine * turn))
        rate -= rise + np.outer(robot.arms, cosine * turn)
        return robot.k[:, None] * p + robot.c[:, None] * rate, np.outer(robot.arms, cosine)

    def motion(X, w):
        N, arm = forces(X, w[:, None])
        lift, moment = N.sum() / robot.m - robot.g, (N * arm).sum() / robot.Izz
        return np.array([w[1], lift, w[3], moment]) / v

    X = np.linspace(0, DISTANCE, 20001)
    start = robot.equilibrium.copy()
    run = solve_ivp(motion, (0, DISTANCE), start, "DOP853", X, rtol=1e-10, atol=1e-12)
    return forces(X, run.y)[0].min()


@pytest.mark.slow
def test_there_a_rigid_body_just_touches():
    found = critical_speeds(ROBOT, BUMP, 0.1, 30)
    assert len(found) == 3
    for v in found:
        full = full_geometry(ROBOT, BUMP, v)
        below, above = (margin_of_a_rigid_body(ROBOT, full * (1 + e)) for e in (-3e-5, 3e-5))
        assert below * above < 0


@pytest.mark.slow
def test_without_pitch_there_is_no_difference():
    # A body of very large inertia does not turn, so both geometries are the same.
    heavy = replace(ROBOT, Izz=1e3)
    v = critical_speeds(heavy, BUMP, 0.3, 30)[0]
    assert full_geometry(heavy, BUMP, v) == pytest.approx(v, rel=1e-5)


@pytest.mark.slow
def test_the_change_is_of_second_order_in_the_angle():
    # Bump and gravity are scaled alike, so all motions are, and every angle.
    low = GaussianBump(height=BUMP.height / 16)
    soft = replace(ROBOT, g=ROBOT.g / 16)
    v = critical_speeds(ROBOT, BUMP, 0.1, 1)[0]
    assert critical_speeds(soft, low, 0.1, 1)[0] == pytest.approx(v)  # linear: the same speed
    change, small = (full_geometry(r, b, v) / v - 1 for r, b in ((ROBOT, BUMP), (soft, low)))
    assert change > 0.01
    assert small == pytest.approx(change / 16**2, rel=0.2)


@pytest.mark.slow
def test_where_there_is_none_nearby_none_is_told():
    v = critical_speeds(ROBOT, BUMP, 0.1, 1)[0]
    assert full_geometry(ROBOT, BUMP, v, within=0.01) is None


UNSYMMETRIC = Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9)


@pytest.mark.parametrize("robot", [ROBOT, UNSYMMETRIC], ids=["symmetric", "unsymmetric"])
@pytest.mark.parametrize("v", [0.43, 1.2, 10])
def test_without_a_term_it_is_the_exact_margin_and_with_all_a_rigid_body(robot, v):
    assert margin_with(robot, BUMP, v, ()) == pytest.approx(margin(robot, BUMP, v), abs=1e-3)
    rigid = margin_of_a_rigid_body(robot, v)
    assert margin_with(robot, BUMP, v, TERMS) == pytest.approx(rigid, abs=1e-3)


@pytest.mark.slow
def test_the_places_of_the_wheels_matter_most_and_every_term_a_little():
    v = critical_speeds(ROBOT, BUMP, 0.1, 1)[0]
    changes = {term: margin_with(ROBOT, BUMP, v, [term]) for term in TERMS}
    assert all(abs(change) > 0.01 for change in changes.values())
    assert changes["places"] > 5 * max(abs(changes["heights"]), abs(changes["levers"]))


@pytest.mark.slow
def test_what_each_term_does_to_a_force_is_of_third_order_in_the_angle():
    # Bump and gravity are scaled alike, so all motions are, and every angle.
    low = GaussianBump(height=BUMP.height / 4)
    soft = replace(ROBOT, g=ROBOT.g / 4)
    for term in TERMS:
        small, large = (
            margin_with(r, b, 1.2, [term]) - margin_with(r, b, 1.2, [])
            for r, b in ((soft, low), (ROBOT, BUMP))
        )
        assert small / large == pytest.approx(1 / 4**3, rel=0.2)
