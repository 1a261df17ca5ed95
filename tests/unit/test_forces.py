"""Normal forces, and when a sampled history first says that a wheel leaves the ground."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension.exact import over_bump
from suspension.forces import Loss, first_loss, normal_forces
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
UNSYMMETRIC = Robot(500, 1100, L1=0.09, L2=0.13, c1=1, c2=4)

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
