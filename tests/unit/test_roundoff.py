"""Lost digits are refused: the rounding error of extreme forces is estimated, and told."""

import pickle
from copy import deepcopy

import numpy as np
import pytest

from suspension.contact import critical_speeds, critical_stiffness, exact_loss, margin, minima
from suspension.exact import Crossing, modes
from suspension.flight import fly
from suspension.forces import first_loss
from suspension.least_force import roundoff
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import RK4, Scheme
from suspension.simulation import simulate

BUMP = GaussianBump()


def damped(c):
    return Robot(800, 800, c1=c, c2=c)


def test_a_stronger_damper_approaches_a_rigid_leg_until_its_digits_are_refused():
    # With c -> infinity the wheel's force is that of a body that follows the road.
    limits = [margin(damped(c), BUMP, 5.0) for c in (1e4, 1e5, 1e6)]
    assert limits == pytest.approx([limits[-1]] * 3, rel=2e-4)
    for c in (1e8, 1e10, 1e200):
        with pytest.raises(ValueError, match="^robot and bump must be so moderate"):
            margin(damped(c), BUMP, 5.0)


@pytest.mark.parametrize("c", [0, 1.5, 100, 1e4])
def test_the_estimate_covers_the_noise_between_neighbouring_robots(c):
    # Stiffnesses that differ in the last place have the same margin; what differs is roundoff.
    values = [margin(Robot(k, k, c1=c, c2=c), BUMP, 3.0) for k in 800 * (1 + 1e-15 * np.arange(9))]
    assert np.ptp(values) <= 2 * roundoff(Crossing(damped(c), BUMP, 3.0), 1.25 / 3)


@pytest.mark.parametrize(
    "robot, bump",
    [
        (Robot(800, 800, m=1e-300), BUMP),
        (damped(1e200), BUMP),
        (Robot(800, 800), GaussianBump(sigma=1e-300)),
    ],
)
def test_extremes_are_an_error_and_never_contact_kept(robot, bump):
    for question in (margin, minima, exact_loss):
        with pytest.raises(ValueError):
            question(robot, bump, 5.0)


def test_forces_that_are_not_finite_give_no_verdict():
    nothing = np.full((2, 3), np.nan)
    with pytest.raises(ValueError, match="^N must be finite until contact is lost"):
        first_loss([0, 1, 2], nothing)
    lost_before = np.array([[7, -1, np.nan], [7, 7, np.nan]])
    assert first_loss([0, 1, 2], lost_before) == (1, 1.0)


@pytest.mark.parametrize(
    "question, word",
    [
        (lambda: margin(Robot(800, 800), BUMP, 1.2, tfinal=1e5), "samples"),
        (lambda: margin(Robot(1e6, 1e6), BUMP, 0.001), "samples"),
        (lambda: margin(Robot(1e-3, 1e6), BUMP, 0.001), "samples"),
        (lambda: fly(Robot(1e-3, 1e6), BUMP, v=0.001, tfinal=1250), "steps"),
        (lambda: fly(Robot(800, 800), BUMP, v=1e12, tfinal=1e-9), "nanosecond"),
        (lambda: critical_speeds(Robot(800, 800), GaussianBump(sigma=1e-4), 0.1, 30), "samples"),
        (lambda: critical_speeds(Robot(800, 800), GaussianBump(sigma=1e-9), 0.1, 30), "samples"),
        (lambda: critical_speeds(Robot(800, 800), BUMP, 1e-3, 1e3), "samples"),
        (lambda: critical_stiffness(Robot(800, 800), BUMP, 5, 200, 1e30), "samples"),
        (lambda: simulate(Robot(800, 800), BUMP, v=1, dt=1e-9, tfinal=1), "steps"),
    ],
)
def test_what_would_take_minutes_is_refused_before_it_starts(question, word):
    with pytest.raises(ValueError, match=word):
        question()


def test_no_caller_can_poison_a_cache():
    robot = Robot(800, 800)
    before = margin(robot, BUMP, 1.2)
    crossing = Crossing(robot, BUMP, 1.2)
    for array in (
        crossing.lam,
        crossing.right,
        *modes(robot),
        robot.A,
        robot.k,
        robot.eigenvalues,
    ):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0
    for other in (deepcopy(robot), pickle.loads(pickle.dumps(robot))):
        assert other == robot
        with pytest.raises(ValueError, match="read-only"):
            other.A[...] = 0
    assert margin(robot, BUMP, 1.2) == before


def test_schemes_are_equal_by_content_after_pickling_too():
    for scheme in (deepcopy(RK4), pickle.loads(pickle.dumps(RK4))):
        assert scheme == RK4 and hash(scheme) == hash(RK4)
        assert not scheme.a.flags.writeable
    assert Scheme("RK4", 4, RK4.a, RK4.b, RK4.c) == RK4
    assert Scheme("another name", 4, RK4.a, RK4.b, RK4.c) != RK4
    assert RK4 != "RK4"
