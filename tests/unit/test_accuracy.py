"""Errors against the truth: orders, costs, and what an integrator without events misses."""

import numpy as np
import pytest
from helpers import near

from suspension import accuracy
from suspension.contact import critical_speeds, exact_loss, margin, normal_forces
from suspension.exact import over_bump
from suspension.flight import fly
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import BACKWARD_EULER, CRANK_NICOLSON, EULER, RK4, Scheme
from suspension.simulation import simulate

ROBOT = Robot(800, 800)
LOPSIDED = Robot(700, 1000, L1=0.12, L2=0.09, c1=2.0, c2=0.5)
BUMP = GaussianBump()
HEUN = Scheme("Heun", 2, a=[[0, 0], [1, 0]], b=[0.5, 0.5], c=[0, 1])


@pytest.mark.parametrize("scheme", [EULER, BACKWARD_EULER, CRANK_NICOLSON, HEUN, RK4])
@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED], ids=["symmetric", "lopsided"])
def test_errors_of_state_and_force_shrink_with_the_schemes_order(robot, scheme):
    dts = np.array([4e-4, 2e-4, 1e-4])
    found = [accuracy.errors(robot, BUMP, v=1.2, dt=dt, scheme=scheme) for dt in dts]
    for name in ("state", "force"):
        values = [getattr(error, name) for error in found]
        assert accuracy.fitted_order(dts, values) == pytest.approx(scheme.order, abs=0.1)


def test_the_state_error_is_relative_to_the_largest_value_and_the_force_error_in_newtons():
    found = accuracy.errors(LOPSIDED, BUMP, v=1.2, dt=1e-3, scheme=HEUN)
    run = simulate(LOPSIDED, BUMP, v=1.2, dt=1e-3, tfinal=1.25 / 1.2, scheme=HEUN)
    W = over_bump(LOPSIDED, BUMP, 1.2, run.T)
    worst = max(np.abs(run.W[i] - W[i]).max() / np.abs(W[i]).max() for i in range(4))
    assert found.state == pytest.approx(worst, rel=1e-12)
    N = normal_forces(LOPSIDED, BUMP, 1.2, run.T, W)
    assert found.force == pytest.approx(np.abs(run.N - N).max(), rel=1e-12)


def test_the_moment_of_the_loss_is_told_finer_than_the_step():
    dt = 1e-3
    error = accuracy.errors(ROBOT, BUMP, v=1.2, dt=dt, scheme=RK4).loss
    sampled = simulate(ROBOT, BUMP, v=1.2, dt=dt, tfinal=1).loss
    assert error < 1e-7 < abs(sampled.t - exact_loss(ROBOT, BUMP, 1.2).t) < dt


def test_no_moment_of_loss_where_contact_is_kept():
    assert np.isnan(accuracy.errors(ROBOT, BUMP, v=0.25, dt=1e-3, scheme=RK4).loss)


def test_the_run_ends_where_it_is_told_to():
    before_the_bump = accuracy.errors(ROBOT, BUMP, v=1.2, dt=1e-3, scheme=EULER, tfinal=0.02)
    assert before_the_bump.force < 1e-6
    assert np.isnan(before_the_bump.loss)


@pytest.mark.parametrize("scheme, stages", [(EULER, 1), (BACKWARD_EULER, 1), (HEUN, 2), (RK4, 4)])
def test_every_stage_is_an_evaluation(scheme, stages):
    assert accuracy.evaluations(scheme, 50) == 50 * stages


def test_crank_nicolsons_last_stage_is_the_next_steps_first():
    assert accuracy.evaluations(CRANK_NICOLSON, 50) == 51


@pytest.mark.parametrize("lam", [-3.0 + 0j, -4 + 40j, 25j])
def test_a_run_shows_the_eigenvalue_of_its_own_powers(lam):
    dts = np.linspace(1e-4, 0.06, 400)
    for scheme in (CRANK_NICOLSON, RK4, BACKWARD_EULER):
        seen = accuracy.seen_mode(scheme, lam, dts)
        np.testing.assert_allclose(
            np.exp(seen * dts), scheme.stability_function(lam * dts), rtol=1e-10
        )
        assert seen[0] == pytest.approx(lam, rel=0.03)
        assert np.abs(np.diff(seen.imag)).max() < 1 + abs(lam) / 10  # no leap to another branch


@pytest.mark.slow
@pytest.mark.parametrize("method", ["RK45", "DOP853", "Radau", "LSODA"])
def test_tighter_tolerances_cost_more_and_err_less(method):
    costs, worst = accuracy.solve_ivp_errors(
        ROBOT, BUMP, v=1.2, method=method, tolerances=[1e-3, 1e-6, 1e-9]
    )
    assert (np.diff(costs) > 0).all()
    assert (np.diff(worst) < 0).all()
    assert worst[-1] < 1e-5


@pytest.mark.parametrize("v", [0.25, 1.2, 10])
def test_the_closed_form_agrees_with_dop853(v):
    assert accuracy.disagreement(LOPSIDED, BUMP, v) < 2e-9


def test_a_disagreement_is_noticed():
    class Wrong(GaussianBump):
        def __call__(self, x):
            H, dHdx = super().__call__(x)
            return 1.001 * H, 1.001 * dHdx

    assert accuracy.disagreement(ROBOT, Wrong(), 1.2) > 1e-5


def test_an_event_is_seen_by_short_steps_and_missed_by_long_ones():
    v = 1.2
    _, seen = accuracy.event_run(ROBOT, BUMP, v, method="RK45", rtol=1e-8, max_step=5e-3)
    _, calm = accuracy.event_run(ROBOT, BUMP, 0.25, method="RK45", rtol=1e-6, max_step=2e-2)
    assert seen and not calm


def test_a_dip_is_shown_for_the_wheel_that_dips_lowest():
    T, N, steps, forces = accuracy.missed_dip(LOPSIDED, BUMP, 1.2, method="RK45", rtol=1e-6)
    assert N.min() == pytest.approx(margin(LOPSIDED, BUMP, 1.2), abs=1e-3)
    assert (T[0], T[-1]) == (0, pytest.approx(1.25 / 1.2))
    on_the_curve = np.interp(steps, T, N)
    near(forces, on_the_curve, 1e-3)


def test_the_fitted_order_is_the_slope_on_logarithmic_axes():
    dts = np.geomspace(1e-4, 1e-1, 7)
    for order in (0.5, 1, 4):
        assert accuracy.fitted_order(dts, 3 * dts**order) == pytest.approx(order)


@pytest.mark.slow
def test_steps_fitted_between_the_switches_keep_the_order_that_blind_ones_lose():
    steps = np.array([200, 400, 800])
    blind, located = accuracy.flight_errors(ROBOT, BUMP, v=5, tfinal=0.25, steps=steps)
    assert accuracy.fitted_order(1 / steps, located) > 3.5
    assert located[-1] < 1e-3 * blind[-1]


@pytest.mark.slow
def test_without_a_switch_both_are_the_same():
    blind, located = accuracy.flight_errors(ROBOT, BUMP, v=0.25, tfinal=1.0, steps=[500])
    assert not fly(ROBOT, BUMP, v=0.25, tfinal=1.0).events
    assert blind == pytest.approx(located, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("bump", [BUMP, GaussianBump(height=0.02)], ids=["high", "low"])
def test_speeds_beside_the_last_critical_one_lose_contact_and_lie_within_5_percent(bump):
    critical = critical_speeds(ROBOT, bump, 0.1, 30)
    v = accuracy.just_lost(ROBOT, bump, critical, n=8)
    assert len(v) == 8 and (np.diff(v) > 0).all()
    assert (np.abs(v / critical[-1] - 1) < 0.05).all()
    assert all(margin(ROBOT, bump, speed) < 0 for speed in v)


def test_without_a_critical_speed_there_are_none_beside_it():
    assert accuracy.just_lost(ROBOT, BUMP, []).shape == (0,)


@pytest.mark.parametrize("omega", [5.0, 40.0])
def test_rk4_turns_an_undamped_mode_over_at_root_six(omega):
    """There R(i y) is a negative number."""
    dts = np.linspace(0.01, 2.7, 2000) / omega
    dt = accuracy.half_turn(accuracy.seen_mode(RK4, 1j * omega, dts), dts)
    assert dt * omega == pytest.approx(np.sqrt(6), rel=1e-5)


def test_a_mode_that_turns_over_at_once_is_not_one_that_never_does():
    dts = [0.1, 0.2]
    assert accuracy.half_turn(np.array([50j, 50j]), dts) == 0.1  # by 5 and by 10 rad
    assert accuracy.half_turn(np.array([20j, 20j]), dts) == pytest.approx(np.pi / 20)
    assert accuracy.half_turn(np.array([10j, 10j]), dts) is None
    assert accuracy.half_turn([50j], [0.1]) == 0.1 and accuracy.half_turn([10j], [0.1]) is None


def test_crank_nicolson_never_turns_a_mode_over():
    dts = np.geomspace(1e-3, 100, 500)
    assert accuracy.half_turn(accuracy.seen_mode(CRANK_NICOLSON, 20j, dts), dts) is None
