"""The exact first loss of contact, and one place for all that answers for contact."""

import numpy as np
import pytest

from suspension import contact, critical, least_force
from suspension.contact import Loss, exact_loss, margin, minima
from suspension.exact import Crossing
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import RK4
from suspension.simulation import simulate

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
UNSYMMETRIC = Robot(500, 1100, L1=0.09, L2=0.13, c1=1, c2=4)
SHORT = Robot(800, 800, L1=1e-4, L2=1e-4)  # both wheels lift nearly at once


@pytest.mark.parametrize("v", [0.44, 0.7, 1.2, 5, 7.9, 20.5, 30])
@pytest.mark.parametrize("robot", [ROBOT, UNSYMMETRIC])
def test_a_finely_sampled_run_loses_contact_just_after_the_exact_moment(robot, v):
    run = simulate(robot, BUMP, v=v, dt=1.25 / v / 20_000, tfinal=1.25 / v, scheme=RK4)
    loss = exact_loss(robot, BUMP, v)
    if margin(robot, BUMP, v) > 0:
        assert loss is None and run.loss is None
    else:
        assert loss.wheel == run.loss.wheel
        assert -1e-9 <= run.loss.t - loss.t <= run.dt * (1 + 1e-6)


@pytest.mark.parametrize(
    ("robot", "v"),
    [(ROBOT, 0.45), (ROBOT, 1.2), (ROBOT, 25), (UNSYMMETRIC, 3), (SHORT, 0.8), (SHORT, 30)],
)
def test_the_force_is_zero_at_the_exact_loss_and_positive_before(robot, v):
    loss, crossing = exact_loss(robot, BUMP, v), Crossing(robot, BUMP, v)
    before = loss.t * np.concatenate([np.linspace(0, 1, 5000)[:-1], 1 - np.geomspace(1e-9, 1e-2)])
    assert (least_force.exact_forces(crossing, before)[0] > 0).all()
    assert abs(least_force.exact_forces(crossing, np.array([loss.t]))[0, loss.wheel - 1, 0]) < 1e-11


def test_a_dip_too_short_for_the_samples_is_not_missed():
    """Just inside a critical speed the force is negative for a moment only."""
    v = critical.critical_speeds(ROBOT, BUMP, 5, 10)[0] * (1 - 1e-10)
    loss, least = exact_loss(ROBOT, BUMP, v), min(minima(ROBOT, BUMP, v), key=lambda m: m.force)
    assert -1e-8 < least.force < 0
    assert loss.wheel == least.wheel and 0 < least.t - loss.t < 1e-5
    assert simulate(ROBOT, BUMP, v=v, dt=1e-4, tfinal=1.25 / v).loss is None


def test_no_loss_where_contact_is_kept_nor_before_the_end_of_a_short_run():
    assert exact_loss(ROBOT, BUMP, 0.25) is None
    lost = exact_loss(ROBOT, BUMP, 1.2)
    assert exact_loss(ROBOT, BUMP, 1.2, tfinal=0.99 * lost.t) is None
    assert exact_loss(ROBOT, BUMP, 1.2, tfinal=1.01 * lost.t).t == pytest.approx(lost.t, rel=1e-12)


def test_a_robot_that_starts_on_a_falling_slope_loses_contact_at_once():
    steep = GaussianBump(height=0.05, sigma=0.01, centre=0.097)
    assert exact_loss(ROBOT, steep, 30.0, tfinal=0.04) == Loss(2, 0.0)


def test_a_loss_needs_a_moving_robot():
    with pytest.raises(ValueError, match="v must be a finite number > 0, got 0"):
        exact_loss(ROBOT, BUMP, 0)


def test_contact_is_where_every_verdict_is_found():
    for name in ("margin", "minima", "Minimum"):
        assert getattr(contact, name) is getattr(least_force, name)
    for name in ("critical_speeds", "critical_stiffness", "sensitivity"):
        assert getattr(contact, name) is getattr(critical, name)
