"""Normal forces, and when a wheel first leaves the ground: sampled and exact."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension import contact, critical, least_force
from suspension.contact import Loss, exact_loss, first_loss, margin, minima, normal_forces
from suspension.exact import Crossing, over_bump
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.schemes import RK4
from suspension.simulation import simulate

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
UNSYMMETRIC = Robot(500, 1100, L1=0.09, L2=0.13, c1=1, c2=4)
SHORT = Robot(800, 800, L1=1e-4, L2=1e-4)  # both wheels lift nearly at once

quick = settings(derandomize=True, deadline=None, max_examples=100)


# --- normal forces ----------------------------------------------------------------------------


@pytest.mark.parametrize("robot", [ROBOT, UNSYMMETRIC])
def test_at_rest_the_forces_carry_the_weight_and_do_not_turn_the_robot(robot):
    T = np.array([0.0, 1.0])
    N = normal_forces(robot, FlatRoad(), 1.0, T, np.tile(robot.equilibrium, (2, 1)).T)
    np.testing.assert_allclose(N.sum(axis=0), robot.m * robot.g)
    np.testing.assert_allclose(N[0] * robot.L1, N[1] * robot.L2)


def test_forces_are_equation_5_written_out():
    T, v, robot = np.linspace(0, 0.5, 7), 1.3, UNSYMMETRIC
    W = np.random.default_rng(2086).normal(size=(4, 7))
    Y, Ydot, theta, thetadot = W
    for N, k, c, arm in zip(
        normal_forces(robot, BUMP, v, T, W),
        (robot.k1, robot.k2),
        (robot.c1, robot.c2),
        (-robot.L1, robot.L2),
        strict=True,
    ):
        H, dHdx = BUMP(v * T + arm)
        expected = k * (H - Y - arm * theta) + c * (v * dHdx - Ydot - arm * thetadot)
        np.testing.assert_allclose(N, expected, rtol=1e-12)


def test_forces_obey_the_equations_of_motion():
    t, v, step = np.linspace(0.1, 0.5, 30), 1.2, 1e-5
    W = over_bump(UNSYMMETRIC, BUMP, v, t)
    after, before = (over_bump(UNSYMMETRIC, BUMP, v, t + s) for s in (step, -step))
    acceleration = ((after - before) / (2 * step))[[1, 3]]
    N1, N2 = normal_forces(UNSYMMETRIC, BUMP, v, t, W)
    robot = UNSYMMETRIC
    expected = [(N1 + N2) / robot.m - robot.g, (N2 * robot.L2 - N1 * robot.L1) / robot.Izz]
    np.testing.assert_allclose(acceleration, expected, rtol=0, atol=1e-3)


@pytest.mark.parametrize(
    ("T", "W", "message"),
    [
        ([0, 1], np.zeros((4, 3)), r"W must have shape \(4, 2\), got \(4, 3\)"),
        ([0, 1], np.zeros((2, 2)), r"W must have shape \(4, 2\), got \(2, 2\)"),
        ([[0, 1]], np.zeros((4, 2)), r"T must have shape \(n\), got \(1, 2\)"),
        ([0, np.nan], np.zeros((4, 2)), "T must be finite everywhere, got nan"),
    ],
)
def test_histories_of_the_wrong_shape_are_refused(T, W, message):
    with pytest.raises(ValueError, match=message):
        normal_forces(ROBOT, BUMP, 1.0, T, W)


# --- the first loss of a sampled history ------------------------------------------------------

histories = st.integers(1, 8).flatmap(
    lambda n: st.lists(st.lists(st.integers(-2, 9), min_size=n, max_size=n), min_size=2, max_size=2)
)


@quick
@given(N=histories)
def test_the_first_loss_is_the_first_sample_that_does_not_press(N):
    N = np.array(N, dtype=float)
    T = 0.5 * np.arange(N.shape[1])
    loss = first_loss(T, N)
    if loss is None:
        assert (N > 0).all()
    else:
        j = int(loss.t / 0.5)
        assert (N[:, :j] > 0).all()
        assert N[loss.wheel - 1, j] == N[:, j].min() <= 0


def test_zero_force_is_a_loss_and_an_unstable_run_can_be_read():
    assert first_loss([0, 1], [[7, 0], [7, 7]]) == Loss(1, 1.0)
    assert first_loss([0, 1], [[7, 7], [7, np.nextafter(0, 1)]]) is None
    assert first_loss([0, 1, 2], [[7, np.nan, -1], [7, -1, np.nan]]) == Loss(2, 1.0)


def test_forces_of_another_length_are_refused():
    with pytest.raises(ValueError, match=r"N must have shape \(2, 3\), got \(2, 2\)"):
        first_loss([0, 1, 2], [[7, 7], [7, 7]])


# --- the exact loss ---------------------------------------------------------------------------


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
    assert exact_loss(ROBOT, steep, 30.0) == Loss(2, 0.0)


def test_a_loss_needs_a_moving_robot():
    with pytest.raises(ValueError, match="v must be a finite number > 0, got 0"):
        exact_loss(ROBOT, BUMP, 0)


def test_contact_is_where_every_verdict_is_found():
    for name in ("margin", "minima", "Minimum"):
        assert getattr(contact, name) is getattr(least_force, name)
    for name in ("critical_speeds", "critical_stiffness", "sensitivity"):
        assert getattr(contact, name) is getattr(critical, name)
