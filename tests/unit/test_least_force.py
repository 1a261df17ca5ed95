"""The exact margin, against fine sampling and against a solver that knows nothing of it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import integrate

from suspension import least_force
from suspension.exact import Crossing, over_bump
from suspension.least_force import exact_forces, margin, minima, turning_points
from suspension.road import FlatRoad, GaussianBump, road_input
from suspension.robot import Robot
from suspension.simulation import simulate

BUMP = GaussianBump()
K = 800.0
quick = settings(derandomize=True, deadline=None, max_examples=50)


def near(centre, spread):
    return st.floats(centre / spread, centre * spread)


damping = st.one_of(st.just(0.0), near(3, 50))
robots = st.builds(
    Robot,
    k1=near(K, 5),
    k2=near(K, 5),
    c1=damping,
    c2=damping,
    m=near(1.5, 4),
    Izz=near(0.012, 5),
    L1=near(0.1, 3),
    L2=near(0.1, 3),
)
bumps = st.builds(
    GaussianBump, height=st.floats(-0.05, 0.05), sigma=near(0.03, 5), centre=st.floats(-0.2, 0.6)
)


def minima_by_dop853(robots, bump, speeds):
    """Least force of each wheel of each robot at each speed, from one stacked run in X = v t.

    Shape (robots, speeds, 2): a parabola through the least of 4001 samples and its neighbours.
    """
    A, B, C, D, e = (np.array([getattr(r, name) for r in robots])[:, None] for name in "ABCDe")
    v, X = np.asarray(speeds)[:, None], np.linspace(0, 1.25, 4001)
    wheels = np.array([-robots[0].L1, robots[0].L2])
    start = np.repeat([[robot.equilibrium] for robot in robots], len(v), axis=1)

    def road(x):
        H, dHdx = bump(x + wheels)
        return np.hstack([np.broadcast_to(H, (len(v), 2)), v * dHdx])

    def times(M, w):
        return (M @ w[..., None])[..., 0]

    def rate(x, w):
        return ((times(A, w.reshape(start.shape)) + times(B, road(x)) + e) / v).ravel()

    W = integrate.solve_ivp(
        rate, (0, X[-1]), start.ravel(), "DOP853", t_eval=X, rtol=1e-11, atol=1e-13, max_step=0.01
    ).y.T
    N = np.array(
        [times(C, w.reshape(start.shape)) + times(D, road(x)) for x, w in zip(X, W, strict=True)]
    )
    j = N[1:-1].argmin(axis=0) + 1
    before, at, after = (np.take_along_axis(N, (j + i)[None], axis=0)[0] for i in (-1, 0, 1))
    return np.minimum(at - (after - before) ** 2 / (8 * (before - 2 * at + after)), N.min(axis=0))


@pytest.mark.slow
def test_no_wrong_verdict_in_600():
    fleet, speeds = [Robot(k, k) for k in (500, 800, 1000)], np.geomspace(0.1, 30, 200)
    expected = minima_by_dop853(fleet, BUMP, speeds)
    found = np.array([[[m.force for m in minima(r, BUMP, v)] for v in speeds] for r in fleet])
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-4)  # each wheel, in newtons
    kept, expected_kept = found.min(axis=-1) > 0, expected.min(axis=-1) > 0
    assert np.abs(expected.min(axis=-1)).min() > 1e-3  # no case too close to call
    assert kept.shape == (3, 200) and 100 < kept.sum() < 500
    assert (kept != expected_kept).sum() == 0


@pytest.mark.parametrize(("k", "lost"), [(500, {1.2}), (800, {1.2, 5}), (1000, {1.2, 5, 10})])
def test_the_four_speeds_of_the_problem(k, lost):
    robot = Robot(k, k)
    assert {v for v in (0.25, 1.2, 5, 10) if margin(robot, BUMP, v) <= 0} == lost


@pytest.mark.slow
@quick
@given(robot=robots, bump=bumps, v=near(1.5, 10))
def test_no_finer_sample_lies_below_the_minimum_nor_far_above(robot, bump, v):
    crossing = Crossing(robot, bump, v)
    t = np.linspace(0, 1.25 / v, 10_001)
    N = exact_forces(crossing, t)[0]
    for wheel, minimum in enumerate(minima(robot, bump, v, 1.25 / v)):
        swing = np.ptp(N[wheel]) + 1
        assert minimum.force <= N[wheel].min() + 1e-12 * swing
        assert minimum.force >= N[wheel].min() - 1e-2 * swing
        assert exact_forces(crossing, np.array([minimum.t]))[0, wheel, 0] == pytest.approx(
            minimum.force
        )


@pytest.mark.parametrize("v", [0.7, 2.0, 9.0])
def test_two_modes_that_never_die_are_least_when_they_meet_long_after(v):
    crossing = Crossing(Robot(500, 1100, L1=0.09, L2=0.13, c1=0, c2=0), BUMP, v)
    t, N = turning_points(crossing, 40.0)
    fine = exact_forces(crossing, np.linspace(0, 40, 200_001))[0]
    assert t[N.argmin(axis=1)].max() > 5
    np.testing.assert_allclose(N.min(axis=1), fine.min(axis=1), rtol=0, atol=1e-3)
    assert (N.min(axis=1) <= fine.min(axis=1) + 1e-12).all()


@pytest.mark.slow
@quick
@given(robot=robots, bump=bumps, v=near(1.5, 10))
def test_a_minimum_inside_the_run_is_level(robot, bump, v):
    for i, minimum in enumerate(minima(robot, bump, v, 1.25 / v)):
        if 0 < minimum.t < 1.25 / v:
            N, slope, bend = exact_forces(Crossing(robot, bump, v), np.array([minimum.t]), 2)[
                :, i, 0
            ]
            scale = np.abs(bend) * minimum.t + abs(N) / minimum.t
            assert abs(slope) <= 1e-9 * scale
            assert bend >= -1e-9 * scale / minimum.t


def test_forces_are_equation_5_and_its_derivatives():
    robot, v = Robot(500, 1100, L1=0.09, L2=0.13, c1=1, c2=4), 1.7
    t, step = np.linspace(0.01, 0.6, 80), 1e-6
    crossing = Crossing(robot, BUMP, v)
    N, slope, bend = exact_forces(crossing, t, 2)
    before, after = exact_forces(crossing, t - step, 1), exact_forces(crossing, t + step, 1)
    by_hand = robot.C @ over_bump(robot, BUMP, v, t) + robot.D @ road_input(robot, BUMP, v, t)
    np.testing.assert_allclose(N, by_hand, rtol=0, atol=1e-11)
    for value, n in ((slope, 0), (bend, 1)):
        difference = (after[n] - before[n]) / (2 * step)
        np.testing.assert_allclose(value, difference, rtol=0, atol=1e-6 * np.abs(value).max())


def test_a_sampled_run_has_the_same_margin():
    robot = Robot(K, K)
    for v in (0.25, 1.2, 5, 10):
        run = simulate(robot, BUMP, v=v, dt=5e-5 / v, tfinal=1.25 / v)
        assert margin(robot, BUMP, v) == pytest.approx(run.N.min(), abs=1e-4)


def test_minima_tell_wheel_time_and_place():
    rear, front = minima(Robot(K, K), BUMP, 1.2)
    assert (rear.wheel, front.wheel) == (1, 2)
    assert rear.X == pytest.approx(1.2 * rear.t) and front.X == pytest.approx(1.2 * front.t)
    assert front.t < rear.t  # the front wheel meets the bump first
    assert margin(Robot(K, K), BUMP, 1.2) == min(rear.force, front.force)


def test_the_end_of_the_run_counts():
    robot = Robot(K, K)
    whole = min(minima(robot, BUMP, 5), key=lambda m: m.force)
    assert margin(robot, BUMP, 5, tfinal=10) == pytest.approx(whole.force, abs=1e-12)
    before = margin(robot, BUMP, 5, tfinal=0.99 * whole.t)
    assert before > whole.force
    falling = 0.9 * whole.t  # a run that ends on the way down ends at its minimum
    last = minima(robot, BUMP, 5, tfinal=falling)[whole.wheel - 1]
    assert last.t == falling
    t, N = turning_points(Crossing(robot, BUMP, 5), falling)
    assert (t[0], t[-1]) == (0, falling) and (np.diff(t) > 0).all() and N.shape == (2, len(t))


def test_a_long_run_is_worked_on_in_parts_that_join(monkeypatch):
    crossing = Crossing(Robot(K, K), BUMP, 0.5)
    t, N = turning_points(crossing)
    monkeypatch.setattr(least_force, "CHUNK", 100)
    t_parts, N_parts = turning_points(crossing)
    assert len(t) > 500 and (np.diff(t_parts) > 0).all()
    np.testing.assert_allclose(t_parts, t, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(N_parts, N, rtol=0, atol=1e-11)


def test_a_flat_road_presses_with_half_the_weight():
    robot = Robot(K, K)
    assert margin(robot, replace(BUMP, height=0), 1.0) == pytest.approx(robot.m * robot.g / 2)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"v": 0}, "v must be a finite number > 0, got 0"),
        ({"v": -1.0}, r"v must be a finite number > 0, got -1\.0"),
        ({"tfinal": 0}, "tfinal must be a finite number > 0, got 0"),
        ({"bump": FlatRoad()}, "bump must be a GaussianBump, got FlatRoad"),
        ({"v": 1e-7}, r"v must be so high, or tfinal or distance so short, .*: 1.22e\+09"),
    ],
)
def test_what_cannot_be_is_refused(change, message):
    with pytest.raises((ValueError, TypeError), match=message):
        margin(**{"robot": Robot(K, K), "bump": BUMP, "v": 1.0} | change)


@pytest.mark.parametrize("v", [0.02, 0.05, 0.1])
def test_the_cost_is_foretold(v):
    robot = Robot(K, K)
    taken = len(turning_points(Crossing(robot, BUMP, v))[0])
    assert 0.5 < least_force.sample_count(robot, v, 1.25) / taken < 1.5


def test_the_estimate_of_roundoff_grows_in_proportion_to_the_bump():
    def estimate(height):
        return least_force.roundoff(Crossing(Robot(K, K), GaussianBump(height), 1.2), 1.0)

    none, one, two = (estimate(height) for height in (1e-12, 0.02, 0.04))
    weight = 1.456 * 9.81 / 2
    assert weight * np.finfo(float).eps < none < one
    assert np.isclose(two - one, one - none)
