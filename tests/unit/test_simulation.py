"""The time loop: what it computes, and that the band solve is the plain loop."""

import io
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import integrate, signal

from suspension.contact import first_loss, normal_forces
from suspension.road import FlatRoad, GaussianBump, road_input
from suspension.robot import Robot
from suspension.schemes import BACKWARD_EULER, CRANK_NICOLSON, EULER, RK4, Scheme
from suspension.simulation import MAX_STEPS, simulate, steps

KUTTA38 = Scheme(  # with abscissae that no other scheme here has
    "Kutta 3/8",
    4,
    b=[1 / 8, 3 / 8, 3 / 8, 1 / 8],
    c=[0, 1 / 3, 2 / 3, 1],
    a=[[0, 0, 0, 0], [1 / 3, 0, 0, 0], [-1 / 3, 1, 0, 0], [1, -1, 1, 0]],
)
SCHEMES = [EULER, BACKWARD_EULER, CRANK_NICOLSON, RK4, KUTTA38]
ROBOT = Robot(900, 500, c1=1, c2=3, L1=0.09, L2=0.12)
BUMP = GaussianBump()
W0 = [0.01, -0.1, 0.05, 1.0]

each_scheme = pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
quick = settings(derandomize=True, deadline=None, max_examples=100)


def error(W, expected):
    """Largest distance between states over the largest state."""
    return np.linalg.norm(W - expected, axis=0).max() / np.linalg.norm(expected, axis=0).max()


def step_by_step(robot, road, v, dt, J, scheme, w0=None):
    """The history in a plain loop, one product ``w = R w + sum_i G_i F(t + c_i dt)`` a step.

    It runs about the equilibrium, so that the weight drops out.
    """
    R, G = scheme.one_step(robot.A, dt)
    t = dt * np.arange(J)
    u = [road_input(robot, road, v, t + c * dt) for c in scheme.c]
    forcing = sum(Gi @ robot.B @ ui for Gi, ui in zip(G, u, strict=True))
    y = np.zeros((4, J + 1))
    y[:, 0] = 0 if w0 is None else w0 - robot.equilibrium
    with np.errstate(over="ignore", invalid="ignore"):
        for n in range(J):
            y[:, n + 1] = R @ y[:, n] + forcing[:, n]
    return y + robot.equilibrium[:, None]


# --- the band solve ---------------------------------------------------------------------------


@each_scheme
@pytest.mark.parametrize("dt", [1e-3, 4e-3])  # Euler's method grows, but does not overflow
def test_runs_of_every_length_are_those_of_the_plain_loop(scheme, dt):
    expected = step_by_step(ROBOT, BUMP, 0.05, dt, 8300, scheme, W0)
    size = np.maximum.accumulate(np.linalg.norm(expected, axis=0))
    for J in [*range(1, 101), *range(4095, 4201, 15), 4096, 4097, 8191, 8192, 8193, 8300]:
        run = simulate(ROBOT, BUMP, v=0.05, dt=dt, tfinal=J * dt, scheme=scheme, w0=W0)
        assert run.W.shape == (4, J + 1) and run.N.shape == (2, J + 1)
        off = np.linalg.norm(run.W - expected[:, : J + 1], axis=0)
        assert (off <= 1e-11 * size[: J + 1]).all()


@pytest.mark.parametrize("dt", [0.1, 0.5, 10, 1e6, 1e12])
def test_an_unstable_run_is_finite_for_as_long_as_the_plain_loop(dt):
    expected = step_by_step(ROBOT, BUMP, 0.1, dt, 4200, RK4, W0)
    run = simulate(ROBOT, BUMP, v=0.1, dt=dt, tfinal=4200 * dt, w0=W0)
    end = np.isfinite(expected).all(axis=0).argmin()
    assert end > 0 and abs(np.isfinite(run.W).all(axis=0).argmin() - end) <= 1
    W, expected = run.W[:, : end - 1], expected[:, : end - 1]
    assert (np.abs(W - expected) <= 1e-11 * np.abs(expected).max(axis=0)).all()


@pytest.mark.parametrize("dt", [0.2, 0.5, 10])
def test_a_late_bump_in_an_unstable_run_survives_the_overflow_of_powers(dt):
    weightless, J = replace(ROBOT, g=0), 4200  # so that nothing at all happens before the bump
    bump = GaussianBump(0.0254, 0.3 * dt, (J - 8) * dt)
    expected = step_by_step(weightless, bump, 1, dt, J, RK4)
    run = simulate(weightless, bump, v=1, dt=dt, tfinal=J * dt)
    assert np.isfinite(expected).all() and np.abs(expected[:, -1]).max() > 1e6
    assert not run.W[:, : J - 50].any()
    size = np.maximum.accumulate(np.abs(expected).max(axis=0))
    assert (np.abs(run.W - expected) <= 1e-8 * size).all()  # x has lost 4 digits by then


# --- times ------------------------------------------------------------------------------------


@quick
@given(tfinal=st.floats(1e-3, 1e3), J=st.integers(1, 10**6))
def test_steps_undoes_a_division_in_spite_of_roundoff(tfinal, J):
    assert steps(tfinal, tfinal / J) == J
    assert steps(J * tfinal, tfinal) == J


@quick
@given(dt=st.floats(1e-6, 1), J=st.integers(1, 10**5), part=st.floats(1e-3, 0.999))
def test_steps_rounds_a_broken_step_up(dt, J, part):
    assert steps((J - part) * dt, dt) == J


@pytest.mark.parametrize(
    "tfinal, dt, J",
    [(0.3, 0.1, 3), (2, 5e-4, 4000), (1.25 / 1.2, 1e-3, 1042), (0.1, 5, 1), (1e-300, 1e300, 1)],
)
def test_steps_known_by_hand(tfinal, dt, J):
    assert steps(tfinal, dt) == J and type(steps(tfinal, dt)) is int


@pytest.mark.parametrize(
    "tfinal, dt, count",
    [
        (1, 1e-9, r"1e\+09"),
        (MAX_STEPS + 1, 1, r"1e\+08"),
        (1e300, 1e-300, "inf"),
    ],
)
def test_a_run_of_more_than_a_hundred_million_steps_is_refused_with_the_count(tfinal, dt, count):
    assert steps(MAX_STEPS, 1) == 10**8
    for run in (steps, lambda tfinal, dt: simulate(ROBOT, BUMP, v=1, dt=dt, tfinal=tfinal)):
        with pytest.raises(ValueError, match=rf"^dt must .* at most 1e.08 steps.*: {count} steps"):
            run(tfinal, dt)


@pytest.mark.parametrize("dt, tfinal", [(0.1, 0.3), (0.07, 1), (1e-3, 1.25 / 1.2), (3, 1)])
def test_time_steps_are_never_altered(dt, tfinal):
    run = simulate(ROBOT, BUMP, v=1.2, dt=dt, tfinal=tfinal)
    np.testing.assert_array_equal(run.T, dt * np.arange(run.T.size))
    assert run.dt == dt and run.T[-1] >= tfinal * (1 - 1e-12) and run.T[-2] < tfinal
    assert run.W.shape == (4, run.T.size) and run.N.shape == (2, run.T.size)


@pytest.mark.parametrize("J", [1, 4096, 8192, 8193])
def test_the_road_is_only_asked_for_places(J):
    def road(x):
        assert x.size > 0
        return 0 * x, 0 * x

    simulate(ROBOT, road, v=1, dt=1e-3, tfinal=J * 1e-3)


# --- the motion -------------------------------------------------------------------------------


@each_scheme
@pytest.mark.parametrize("dt", [1e-4, 1e-3])
def test_the_discrete_solution_is_a_power_of_the_stability_function(scheme, dt):
    run = simulate(ROBOT, FlatRoad(), v=0, dt=dt, tfinal=1000 * dt, scheme=scheme, w0=W0)
    lam, V = np.linalg.eig(ROBOT.A)
    modes = np.linalg.solve(V, W0 - ROBOT.equilibrium)
    R = scheme.stability_function(lam * dt)
    powers = R[:, None] ** np.arange(1001)
    expected = ROBOT.equilibrium[:, None] + (V @ (powers * modes[:, None])).real
    assert error(run.W, expected) < 1e-13


@pytest.mark.parametrize("dt", [0.2, 0.1])
def test_the_unstable_runs_of_question_9_grow_by_the_stability_function_at_every_step(dt):
    robot = Robot(800, 800)
    growth = np.abs(RK4.stability_function(robot.eigenvalues * dt))
    fastest = growth.argmax()
    run = simulate(robot, FlatRoad(), v=0, dt=dt, tfinal=2, w0=[0, 0, 0.1, 0])
    modes = np.linalg.solve(np.linalg.eig(robot.A)[1], run.W - robot.equilibrium[:, None])
    assert growth[fastest] > 1
    size = np.abs(modes[np.isclose(np.linalg.eigvals(robot.A), robot.eigenvalues[fastest])][0])
    np.testing.assert_allclose(size[1:] / size[:-1], growth[fastest], rtol=1e-10)


@each_scheme
@pytest.mark.parametrize("dt", [1e-4, 1e-3, 1e-2])
def test_equilibrium_is_a_fixed_point_and_the_forces_carry_the_weight(scheme, dt):
    run = simulate(ROBOT, FlatRoad(), v=1, dt=dt, tfinal=200 * dt, scheme=scheme)
    unit = max(1.0, np.abs(scheme.stability_function(ROBOT.eigenvalues * dt)).max() ** 200)
    assert error(run.W, np.tile(ROBOT.equilibrium[:, None], run.T.size)) < 1e-12 * unit
    np.testing.assert_allclose(run.N.sum(axis=0), ROBOT.m * ROBOT.g, rtol=1e-11 * unit)
    np.testing.assert_allclose(run.N[0] * ROBOT.L1, run.N[1] * ROBOT.L2, rtol=1e-11 * unit)


@each_scheme
def test_superposition(scheme):
    weightless = replace(ROBOT, g=0)
    dip = GaussianBump(-0.01, 0.05, 0.5)

    def both(x):
        return [2 * one - 3 * other for one, other in zip(BUMP(x), dip(x), strict=True)]

    def drive(road, w0):
        return simulate(weightless, road, v=1.2, dt=1e-3, tfinal=0.8, scheme=scheme, w0=w0)

    w1, w2 = np.array(W0), np.array([-0.02, 0.3, 0.01, -2])
    one, other, sum_ = drive(BUMP, w1), drive(dip, w2), drive(both, 2 * w1 - 3 * w2)
    assert error(sum_.W, 2 * one.W - 3 * other.W) < 1e-13
    assert error(sum_.N, 2 * one.N - 3 * other.N) < 1e-13


@each_scheme
def test_the_mirror_image_driving_backwards_does_the_same(scheme):
    image = replace(
        ROBOT, k1=ROBOT.k2, k2=ROBOT.k1, c1=ROBOT.c2, c2=ROBOT.c1, L1=ROBOT.L2, L2=ROBOT.L1
    )
    flip = np.array([1, 1, -1, -1])[:, None]
    run = simulate(ROBOT, BUMP, v=1.2, dt=1e-3, tfinal=1, scheme=scheme)
    seen = simulate(image, GaussianBump(centre=-0.3), v=-1.2, dt=1e-3, tfinal=1, scheme=scheme)
    assert error(seen.W, flip * run.W) < 1e-13
    np.testing.assert_allclose(seen.N, run.N[::-1], rtol=0, atol=1e-11)


@pytest.mark.parametrize("v", [0.25, 1.2, 10])
def test_the_run_over_the_bump_is_that_of_a_tight_adaptive_solver(v):
    run = simulate(ROBOT, BUMP, v=v, dt=1e-4 / v, tfinal=1.25 / v, scheme=KUTTA38)
    truth = integrate.solve_ivp(
        lambda t, w: ROBOT.A @ w + ROBOT.B @ road_input(ROBOT, BUMP, v, t) + ROBOT.e,
        (0, run.T[-1]),
        ROBOT.equilibrium,
        t_eval=run.T,
        method="DOP853",
        rtol=1e-12,
        atol=1e-15,
    ).y
    assert error(run.W, truth) < 1e-9


def test_states_and_forces_on_a_ramp_are_those_of_scipys_lsim():
    # On a ramp u(t) is linear between samples: there lsim, with its first-order hold, is exact.
    slope, v, dt = 0.1, 2.0, 1e-4
    run = simulate(ROBOT, lambda x: (slope * x, slope + 0 * x), v=v, dt=dt, tfinal=0.5)
    u = np.array([slope * (run.X - ROBOT.L1), slope * (run.X + ROBOT.L2)])
    u = np.vstack([u, np.full((2, run.T.size), slope * v)])
    _, N, x = signal.lsim((ROBOT.A, ROBOT.B, ROBOT.C, ROBOT.D), u.T, run.T)  # less the rest state
    assert error(run.W, x.T + ROBOT.equilibrium[:, None]) < 1e-10
    assert error(run.N, N.T + (ROBOT.C @ ROBOT.equilibrium)[:, None]) < 1e-10


def test_a_trajectory_carries_its_forces_its_place_and_its_verdict():
    run = simulate(ROBOT, BUMP, v=10, dt=1e-4, tfinal=0.125)
    np.testing.assert_allclose(run.N, normal_forces(ROBOT, BUMP, 10, run.T, run.W), atol=1e-11)
    np.testing.assert_array_equal(run.X, 10 * run.T)
    assert run.loss == first_loss(run.T, run.N) and run.loss is not None
    assert (run.v, run.dt, run.scheme) == (10, 1e-4, RK4)


def test_a_run_starts_where_it_is_told():
    start = np.array(W0)
    run = simulate(ROBOT, BUMP, v=1, dt=0.01, tfinal=0.1, w0=start)
    np.testing.assert_array_equal(run.W[:, 0], W0)
    np.testing.assert_array_equal(start, W0)
    at_rest = simulate(ROBOT, BUMP, v=1, dt=0.01, tfinal=0.1)
    np.testing.assert_array_equal(at_rest.W[:, 0], ROBOT.equilibrium)


@pytest.mark.parametrize(
    "name, value",
    [
        *[
            (name, value)
            for name in ("dt", "tfinal")
            for value in (0, -1, np.nan, np.inf, None, "1")
        ],
        *[("v", value) for value in (np.nan, np.inf, None)],
        ("w0", [0, 0, 0]),
        ("w0", np.zeros((4, 1))),
        ("w0", [0, 0, np.nan, 0]),
        ("w0", "wxyz"),
        ("w0", np.array([1j, 0, 0, 0])),
        ("road", lambda x: (x, np.full_like(x, np.nan))),
        ("road", lambda x: (0.0, 0.0)),
        ("scheme", "RK4"),
        ("scheme", None),
    ],
)
def test_a_bad_argument_is_refused_by_name(name, value):
    arguments = {"road": BUMP, "v": 1, "dt": 0.01, "tfinal": 0.1} | {name: value}
    with pytest.raises((ValueError, TypeError), match=f"^{name} must "):
        simulate(ROBOT, **arguments)


def test_the_first_forces_are_those_of_the_initial_state():
    w0 = [0.001, 0.2, -0.03, 1.0]
    run = simulate(ROBOT, BUMP, v=1.2, dt=0.01, tfinal=0.1, w0=w0)
    assert np.allclose(run.N[:, 0], normal_forces(ROBOT, BUMP, 1.2, [0.0], np.c_[w0])[:, 0])


def test_a_trajectory_says_what_it_is_and_cannot_be_changed():
    run = simulate(ROBOT, BUMP, v=1.2, dt=0.01, tfinal=0.1)
    assert repr(run) == "<Trajectory: RK4, v = 1.2 m/s, dt = 0.01 s, 10 steps to t = 0.1 s>"
    with pytest.raises(AttributeError):
        run.v = 2


def test_a_frame_has_what_the_run_has_with_units():
    run = simulate(Robot(800, 600), GaussianBump(), v=1.2, dt=0.01, tfinal=0.4)
    frame = run.to_frame()
    assert frame.columns.tolist() == [
        *("t (s)", "X (m)", "Y (m)", "Y' (m/s)", "theta (rad)", "theta' (rad/s)"),
        *("N1 rear (N)", "N2 front (N)"),
    ]
    np.testing.assert_array_equal(frame.to_numpy().T, np.vstack([run.T, run.X, run.W, run.N]))
    again = pd.read_csv(io.StringIO(frame.to_csv(index=False)))
    pd.testing.assert_frame_equal(again, frame, rtol=1e-15)
