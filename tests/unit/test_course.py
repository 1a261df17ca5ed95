"""The problem set's own functions: textbook loops, and that `simulate` computes the same."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension import course
from suspension.road import FlatRoad, GaussianBump, road_input
from suspension.robot import Robot
from suspension.schemes import CRANK_NICOLSON, RK4
from suspension.simulation import simulate
from suspension.springs import fit_spring, load_spring_data

ROBOTS = st.builds(
    Robot,
    k1=st.floats(300, 1500),
    k2=st.floats(300, 1500),
    c1=st.floats(0, 10),
    c2=st.floats(0, 10),
    L1=st.floats(0.05, 0.2),
    L2=st.floats(0.05, 0.2),
)
W0 = st.lists(st.floats(-0.1, 0.1), min_size=4, max_size=4)
SPEEDS = st.floats(-1, 1).map(lambda x: 10**x)
quick = settings(derandomize=True, deadline=None, max_examples=12)


def textbook(scheme, robot, road, v, dt, tfinal, w0):
    """The history that the problem set's own loop computes."""
    if scheme is RK4:
        return course.RK4(course.make_gfunc(robot, road), w0, dt, tfinal, v)

    def F(t):
        return robot.B @ road_input(robot, road, v, t) + robot.e

    return course.crank_nicolson(robot.A, F, w0, dt, tfinal)


@pytest.mark.slow
@pytest.mark.parametrize("scheme", [CRANK_NICOLSON, RK4], ids=lambda scheme: scheme.name)
@pytest.mark.parametrize("dt", [1e-3, 0.01, 0.1, 0.2], ids="dt={}".format)
@quick
@given(robot=ROBOTS, w0=W0, v=SPEEDS)
def test_textbook_loops_and_simulate_agree_stable_or_not(scheme, dt, robot, w0, v):
    W, T = textbook(scheme, robot, course.Hgauss, v, dt, 80 * dt, w0)
    run = simulate(robot, course.Hgauss, v=v, dt=dt, tfinal=80 * dt, scheme=scheme, w0=w0)
    np.testing.assert_array_equal(T, run.T)
    size = np.maximum.accumulate(np.abs(W).max(axis=0))
    assert (np.abs(run.W - W).max(axis=0) <= 1e-12 * size).all()


@pytest.mark.slow
@pytest.mark.parametrize("scheme", [CRANK_NICOLSON, RK4], ids=lambda scheme: scheme.name)
def test_the_slowest_runs_of_questions_6_and_10_agree(scheme):
    robot = course.the_robot()
    W, _ = textbook(scheme, robot, course.Hgauss, 0.25, 1e-3, 5, robot.equilibrium)
    run = simulate(robot, course.Hgauss, v=0.25, dt=1e-3, tfinal=5, scheme=scheme)
    assert np.abs(run.W - W).max() <= 1e-12 * np.abs(W).max()


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:overflow|invalid:RuntimeWarning")
def test_an_overflowing_run_is_finite_for_as_long_as_the_textbook_loop():
    robot, dt, J = Robot(800, 800), 0.5, 5000
    W, _ = textbook(RK4, robot, FlatRoad(), 0, dt, J * dt, [0, 0, 0.1, 0])
    run = simulate(robot, FlatRoad(), v=0, dt=dt, tfinal=J * dt, w0=[0, 0, 0.1, 0])
    ends = [np.isfinite(history).all(axis=0).argmin() for history in (W, run.W)]
    assert 0 < min(ends) and abs(ends[0] - ends[1]) <= 1
    W, fast = W[:, : min(ends) - 1], run.W[:, : min(ends) - 1]
    assert (np.abs(fast - W) <= 1e-12 * np.abs(W).max(axis=0)).all()


@pytest.mark.filterwarnings("ignore:overflow|invalid:RuntimeWarning")
def test_crank_nicolson_overflows_to_infinity_not_to_an_error():
    W, _ = course.crank_nicolson([[1.0]], lambda t: np.zeros(1), [1.0], 1.5, 600)
    end = np.isfinite(W[0]).argmin()
    assert end > 300 and not np.isfinite(W[0, end:]).any()
    np.testing.assert_allclose(W[0, :end], 7.0 ** np.arange(end), rtol=1e-12)


def test_rk4_takes_any_right_hand_side():
    def pendulum(w, t, v):
        return np.array([w[1], -np.sin(w[0]) + v * np.cos(t)])

    ends = [course.RK4(pendulum, [1.0, 0.0], 2.0 / J, 2.0, 0.3)[0][:, -1] for J in (50, 100, 200)]
    ratio = np.linalg.norm(ends[0] - ends[1]) / np.linalg.norm(ends[1] - ends[2])
    assert np.log2(ratio) == pytest.approx(4, abs=0.1)


def test_rk4_integrates_a_cubic_exactly_as_simpsons_rule_does():
    W, T = course.RK4(lambda w, t, v: np.array([v * t**3]), [1.0], 0.5, 3, 4)
    np.testing.assert_allclose(W[0], 1 + T**4, rtol=1e-15)


def test_crank_nicolson_integrates_a_straight_line_exactly_as_the_trapezoidal_rule_does():
    W, T = course.crank_nicolson(np.zeros((1, 1)), lambda t: np.array([2 * t]), [1.0], 0.5, 3)
    np.testing.assert_allclose(W[0], 1 + T**2, rtol=1e-15)


def test_crank_nicolson_keeps_the_size_of_an_undamped_oscillation():
    A = np.array([[0, 3.0], [-3.0, 0]])
    W, _ = course.crank_nicolson(A, lambda t: np.zeros(2), [1.0, 0], 0.2, 100)
    np.testing.assert_allclose(np.linalg.norm(W, axis=0), 1, rtol=1e-13)


@pytest.mark.parametrize("wrap", [lambda g: g, lambda g: (g, 1.0, 2.0)], ids=["alone", "first"])
def test_rk4_takes_the_rate_alone_or_as_the_first_of_several_outputs(wrap):
    W, T = course.RK4(lambda w, t, v: wrap(-w), [1.0], 0.01, 1, 0)
    np.testing.assert_allclose(W[0], np.exp(-T), rtol=1e-9)


def test_gfunc_linear_is_at_rest_in_equilibrium():
    robot = course.the_robot()
    wdot, N1, N2 = course.gfunc_linear(robot.equilibrium, 0, 0)
    np.testing.assert_allclose(wdot, 0, atol=1e-7)  # the bump reaches the front wheel by 1e-11 m
    assert N1 == pytest.approx(robot.m * robot.g / 2) and N2 == pytest.approx(N1)
    on_flat_ground = course.make_gfunc(robot, FlatRoad())(robot.equilibrium, 0, 0)
    np.testing.assert_allclose(on_flat_ground[0], 0, atol=1e-13)


def test_gfunc_linear_is_the_robot_with_the_fitted_springs_on_the_bump():
    k = fit_spring(load_spring_data()).stiffness
    robot, w, t, v = Robot(k, k), np.array([0.01, -0.2, 0.03, 1.0]), 0.2, 1.2
    u = road_input(robot, GaussianBump(), v, t)
    wdot, N1, N2 = course.gfunc_linear(w, t, v)
    np.testing.assert_allclose(wdot, robot.A @ w + robot.B @ u + robot.e, rtol=1e-13)
    np.testing.assert_allclose([N1, N2], robot.C @ w + robot.D @ u, rtol=1e-13)


@pytest.mark.parametrize("loop", ["RK4", "crank_nicolson"])
@pytest.mark.parametrize(
    "name, value",
    [
        *[
            (name, value)
            for name in ("deltat", "tfinal")
            for value in (0, -1, np.nan, np.inf, None)
        ],
        ("w0", [0, 0, np.nan, 0]),
        ("w0", np.zeros((4, 1))),
        ("w0", 0.0),
    ],
)
def test_a_bad_argument_is_refused_by_name(loop, name, value):
    arguments = {"w0": np.zeros(4), "deltat": 0.1, "tfinal": 1} | {name: value}
    if loop == "RK4":
        arguments |= {"gfunc_handle": course.gfunc_linear, "v": 1}
    else:
        arguments |= {"A": np.eye(4), "F": lambda t: np.zeros(4)}
    with pytest.raises(ValueError, match=f"^{name} must "):
        getattr(course, loop)(**arguments)


@pytest.mark.parametrize("A", [np.eye(3), np.ones((4, 3)), np.full((4, 4), np.nan)])
def test_crank_nicolson_refuses_a_matrix_that_does_not_fit_the_state(A):
    with pytest.raises(ValueError, match=r"^A must "):
        course.crank_nicolson(A, lambda t: np.zeros(4), np.zeros(4), 0.1, 1)


@pytest.mark.parametrize("w", [np.zeros(3), np.zeros((4, 2)), [0, 0, np.nan, 0]])
def test_gfunc_linear_refuses_a_state_of_another_shape(w):
    with pytest.raises(ValueError, match=r"^w must "):
        course.gfunc_linear(w, 0, 1)
