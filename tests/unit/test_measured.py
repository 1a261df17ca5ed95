"""The measured spring: its law, its rest, and runs beside other methods and the linear robot."""

import math

import numpy as np
import pytest
from cases import DELTA_MAX, fitted
from helpers import near
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from suspension import course
from suspension.contact import critical_speeds, margin
from suspension.measured import (
    SpringLaw,
    drive,
    follow_speed,
    joint_draws,
    linearised,
    make_measured_gfunc,
    rest,
    zero_speeds,
)
from suspension.road import FlatRoad, GaussianBump, road_input
from suspension.robot import Robot

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
UNEQUAL = Robot(800, 800, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9)
LINE = SpringLaw(0.0, 800 * DELTA_MAX, 0.0, DELTA_MAX)
CURVED = SpringLaw(1.5, 11.0, 4.0, DELTA_MAX)
BENT = SpringLaw(-0.4, 15.0, -3.0, DELTA_MAX, stop=8000.0)
METAL = SpringLaw(1.5, 11.0, 4.0, DELTA_MAX, stop=8e5)
LAWS = {"line": LINE, "curved": CURVED, "bent": BENT, "metal": METAL}
each_law = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
ASKED = np.array([0.25, 1.2, 5, 10])


# --- the law --------------------------------------------------------------------------------------


@each_law
def test_inside_the_law_is_the_parabola(law):
    x = np.linspace(0, 1, 11)
    parabola = law.beta0 + law.beta1 * x + law.beta2 * x**2
    near(law.force(x * DELTA_MAX), parabola, 1e-14)


@each_law
def test_the_tangent_is_the_slope_of_the_force(law):
    delta = np.array([-2.0, -0.3, 0.2, 0.7, 1.4, 2.5]) * DELTA_MAX
    h = 1e-8
    slope = (law.force(delta + h) - law.force(delta - h)) / (2 * h)
    np.testing.assert_allclose(law.tangent(delta), slope, rtol=1e-5)


@each_law
def test_the_force_is_the_integral_of_the_tangent(law):
    for end in (-1.7, 0.6, 1.9):
        points = sorted({0, min(end, 1) if end > 0 else 0})
        work = quad(law.tangent, 0, end * DELTA_MAX, points=[p * DELTA_MAX for p in points])[0]
        assert math.isclose(law.force(end * DELTA_MAX), law.beta0 + work, rel_tol=1e-9)


@each_law
def test_the_force_is_continuous_and_grows(law):
    force = law.force(np.linspace(-2, 3, 50001) * DELTA_MAX)
    rise = np.diff(force)
    assert (rise > 0).all()
    steepest = law.tangent(np.array([0, 1.5]) * DELTA_MAX).max() * DELTA_MAX * 5 / 50000
    assert rise.max() < 1.001 * steepest


@each_law
@pytest.mark.parametrize("load", [-3.0, 0.0, 1.0, 7.14, 14.0, 60.0])
def test_the_displacement_is_the_root(law, load):
    root = brentq(lambda d: law.force(d) - load, -1, 1, xtol=1e-16, rtol=1e-14)
    assert math.isclose(law.displacement(load), root, rel_tol=1e-9, abs_tol=1e-14)


def test_many_laws_are_each_of_them():
    many = SpringLaw(*np.transpose([[0, 13, 0], [1.5, 11, 4]]), DELTA_MAX, [0.0, 500.0])
    assert many.shape == (2,)
    for i in range(2):
        assert many[i].shape == ()
        assert many.force(0.02)[i] == many[i].force(0.02)
    assert many[:, None].shape == (2, 1)


def test_of_a_fit_it_has_its_coefficients():
    fit = fitted(793, preload=0.4, curvature=1.0)
    law = SpringLaw.of(fit, 8000)
    assert [law.beta0, law.beta1, law.beta2] == list(fit.beta)
    assert (law.delta_max, law.stop) == (DELTA_MAX, 8000)
    load = ROBOT.m * ROBOT.g / 2
    assert math.isclose(law.displacement(load) / DELTA_MAX, fit.displacement(load))
    assert math.isclose(linearised(ROBOT, law).k1, fit.tangent(load).value)


@pytest.mark.parametrize(
    ("beta", "words"), [((0, 0, 1), "beta1 must be > 0"), ((0, 10, -5), "beta2 must be")]
)
def test_a_spring_that_gives_way_is_refused(beta, words):
    with pytest.raises(ValueError, match=words):
        SpringLaw(*beta, DELTA_MAX)


# --- at rest --------------------------------------------------------------------------------------


@each_law
@pytest.mark.parametrize("robot", [ROBOT, UNEQUAL], ids=["equal", "unequal"])
@pytest.mark.parametrize("small", [True, False], ids=["small", "true"])
def test_at_rest_nothing_moves(law, robot, small):
    w = rest(robot, law, small)
    wdot, N1, N2 = make_measured_gfunc(robot, law, FlatRoad(), small)(w, 0.0, 0.0)
    assert np.abs(wdot).max() < 1e-11
    assert math.isclose(N1 + N2, robot.m * robot.g)


@each_law
def test_the_linearised_robot_is_the_jacobian(law):
    w, h = rest(UNEQUAL, law), 1e-7
    gfunc = make_measured_gfunc(UNEQUAL, law, FlatRoad())
    columns = [(gfunc(w + d, 0, 0)[0] - gfunc(w - d, 0, 0)[0]) / (2 * h) for d in h * np.eye(4)]
    near(np.transpose(columns), linearised(UNEQUAL, law).A, 1e-6)


def test_away_from_rest_the_tangent_is_that_of_the_place():
    pressed = np.array([-2 * DELTA_MAX, 0, 0, 0])
    assert linearised(ROBOT, METAL, pressed).k1 == METAL.tangent(2 * DELTA_MAX)
    assert linearised(ROBOT, METAL).k1 < 2000 < linearised(ROBOT, METAL, pressed).k1


# --- runs -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("v", [1.2, 10])
def test_the_linear_limit_is_the_linear_robot_to_roundoff(v):
    mine = make_measured_gfunc(ROBOT, LINE, BUMP)
    theirs = course.make_gfunc(ROBOT, BUMP)
    near(rest(ROBOT, LINE), ROBOT.equilibrium, 1e-14)
    w0, tfinal = ROBOT.equilibrium, 0.5 / v
    W, _ = course.RK4(mine, w0, tfinal / 400, tfinal, v)
    near(W, course.RK4(theirs, w0, tfinal / 400, tfinal, v)[0], 1e-12)


def test_a_preload_only_moves_the_rest_of_a_straight_spring():
    preloaded = SpringLaw(2.0, 800 * DELTA_MAX, 0.0, DELTA_MAX)
    near(drive(ROBOT, preloaded, BUMP, ASKED).margin, drive(ROBOT, LINE, BUMP, ASKED).margin, 1e-12)


def test_the_margins_of_the_line_are_the_exact_ones():
    exact = [margin(ROBOT, BUMP, v) for v in ASKED]
    np.testing.assert_allclose(drive(ROBOT, LINE, BUMP, ASKED).margin, exact, atol=1e-4)


@pytest.mark.slow
@each_law
@pytest.mark.parametrize("small", [True, False], ids=["small", "true"])
def test_a_drive_is_the_problems_rk4(law, small):
    v, steps = 5.0, 2000
    gfunc = make_measured_gfunc(ROBOT, law, BUMP, small)
    dt = 1.25 / v / steps
    W, T = course.RK4(gfunc, rest(ROBOT, law, small), dt, 1.25 / v, v)
    N = np.array([gfunc(w, t, v)[1:] for w, t in zip(W.T, T)])
    found = drive(ROBOT, law, BUMP, v, fine=2, small=small)
    assert math.isclose(found.margin, N.min(), rel_tol=2e-3)
    gone = (N <= 0).any(axis=1)
    first = v * T[gone.argmax()] if gone.any() else np.inf
    assert found.lost == first or abs(found.lost - first) < 1e-3
    until = gone.argmax() + 1 if gone.any() else len(T)
    h = np.array([road_input(ROBOT, BUMP, v, t)[:2] for t in T[:until]])
    p = h - W[0, :until, None] - ROBOT.arms * W[2, :until, None]
    assert math.isclose(found.compression, p.max(), rel_tol=2e-3)
    assert math.isclose(found.pitch, np.abs(W[2, :until]).max(), rel_tol=5e-3)


@pytest.mark.slow
@each_law
def test_scipys_radau_finds_the_same_forces(law):
    v = 3.0
    gfunc = make_measured_gfunc(ROBOT, law, BUMP)
    tight = {"method": "Radau", "rtol": 1e-8, "atol": 1e-11, "max_step": 2e-4}
    T = np.linspace(0, 0.32 / v, 201)
    run = solve_ivp(lambda t, w: gfunc(w, t, v)[0], (0, T[-1]), rest(ROBOT, law), t_eval=T, **tight)
    W, _ = course.RK4(gfunc, rest(ROBOT, law), T[1] / 8, T[-1], v)
    near(W[:, ::8], run.y, 1e-4 if law.stop < 1e5 else 1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("law", "order"), [(CURVED, 2.7), (BENT, 1.7)], ids=["curved", "stop"])
def test_a_stop_costs_the_order(law, order):
    v, tfinal, J = 10.0, 0.03, 2 ** np.arange(5, 10)
    gfunc, start = make_measured_gfunc(ROBOT, law, BUMP), rest(ROBOT, law)
    true = course.RK4(gfunc, start, tfinal / 2**12, tfinal, v)[0][:, -1]
    ends = [course.RK4(gfunc, start, tfinal / j, tfinal, v)[0][:, -1] for j in J]
    errors = np.abs(np.array(ends) - true).max(axis=1)
    observed = -np.polyfit(np.log(J), np.log(errors), 1)[0]
    assert observed > order
    assert observed < 2.7 or law is CURVED


@pytest.mark.slow
def test_finer_steps_change_little():
    law = SpringLaw(1.5, 11.0, 4.0, DELTA_MAX, [0.0, 8e3, 8e5])[:, None]
    coarse, fine = (drive(ROBOT, law, BUMP, ASKED, fine=f).margin for f in (1, 4))
    np.testing.assert_allclose(coarse[0], fine[0], atol=1e-3)
    np.testing.assert_allclose(coarse, fine, rtol=0.02, atol=1e-3)


def test_a_stop_that_is_not_reached_changes_nothing():
    far = SpringLaw(0.0, 3 * 800 * DELTA_MAX, 0.0, 3 * DELTA_MAX, stop=8e5)
    assert np.array_equal(
        drive(ROBOT, far, BUMP, ASKED).margin,
        drive(ROBOT, SpringLaw(0.0, 3 * 800 * DELTA_MAX, 0.0, 3 * DELTA_MAX), BUMP, ASKED).margin,
    )
    assert math.isclose(drive(ROBOT, far, BUMP, 10).margin, margin(ROBOT, BUMP, 10), abs_tol=1e-4)


def test_a_stop_takes_contact_from_a_fast_crossing():
    law = SpringLaw(0.0, 800 * DELTA_MAX, 0.0, DELTA_MAX, [0.0, 800.0, 8e3, 8e5])
    assert list(drive(ROBOT, law, BUMP, 10).margin > 0) == [True, False, False, False]


def test_a_robot_on_its_stop_is_one_with_that_stiffness_while_it_stays_there():
    soft = SpringLaw(0.0, 100 * DELTA_MAX, 0.0, DELTA_MAX, stop=5000)
    low = GaussianBump(height=1e-3)
    stiff = Robot(5100, 5100)
    assert drive(ROBOT, soft, low, 0.5).compression > DELTA_MAX
    assert math.isclose(drive(ROBOT, soft, low, 0.5).margin, margin(stiff, low, 0.5), rel_tol=1e-4)


@pytest.mark.slow
def test_speeds_and_laws_are_broadcast():
    law = SpringLaw(0.0, 13.2, 0.0, DELTA_MAX, [0.0, 8e3])
    found = drive(ROBOT, law[:, None], BUMP, [2.0, 10.0, 20.0])
    assert found.margin.shape == (2, 3)
    assert found.margin[1, 1] == pytest.approx(drive(ROBOT, law[1], BUMP, 10.0).margin, rel=1e-9)
    assert drive(ROBOT, law[:, None], BUMP, []).margin.shape == (2, 0)


@pytest.mark.slow
def test_a_crawl_takes_as_many_steps_as_it_needs():
    found = drive(ROBOT, LINE, FlatRoad(), 0.01)
    assert math.isclose(found.margin, ROBOT.m * ROBOT.g / 2, rel_tol=1e-9)


# --- critical speeds and draws --------------------------------------------------------------------


@pytest.mark.slow
def test_the_zeros_of_the_line_are_its_critical_speeds():
    found, margins = zero_speeds(ROBOT, LINE, BUMP, np.geomspace(0.3, 30, 90))
    np.testing.assert_allclose(found, critical_speeds(ROBOT, BUMP, 0.3, 30), rtol=1e-4)
    assert margins.shape == (90,)
    none, _ = zero_speeds(ROBOT, LINE, BUMP, [9.0, 10.0, 11.0])
    assert none.shape == (0,)


@pytest.mark.slow
def test_a_critical_speed_is_followed_through_other_laws():
    stiffness = np.array([760.0, 800.0, 830.0])
    laws = SpringLaw(0.0, stiffness * DELTA_MAX, 0.0, DELTA_MAX)
    found = [follow_speed(ROBOT, laws, BUMP, v) for v in (7.95, 20.4)]
    for k, speeds in zip(stiffness, np.transpose(found)):
        exact = critical_speeds(Robot(k, k), BUMP, 5, 30)
        np.testing.assert_allclose(speeds, exact, rtol=2e-4)


def test_a_critical_speed_that_is_gone_is_not_found():
    stopped = SpringLaw(0.0, 800 * DELTA_MAX, 0.0, DELTA_MAX, stop=[0.0, 8000.0])
    assert list(np.isfinite(follow_speed(ROBOT, stopped, BUMP, 7.95))) == [True, False]


def test_draws_have_the_mean_and_the_covariance_of_students_t():
    fit = fitted(793, preload=0.4, curvature=1.0)
    beta = joint_draws(fit, 4096)
    free = fit.free
    error = fit.errors
    assert np.abs((beta.mean(axis=1) - fit.beta) / error).max() < 0.05
    expected = fit.covariance * free / (free - 2)
    np.testing.assert_allclose(np.cov(beta), expected, rtol=0.05)


def test_draws_of_one_coefficient_have_its_interval():
    fit = fitted(793, preload=0.4, curvature=1.0)
    ends = np.quantile(joint_draws(fit, 4096), [0.025, 0.975], axis=1).T
    wide = np.diff(fit.intervals(method="individual"), axis=1)
    assert np.abs((ends - fit.intervals(method="individual")) / wide).max() < 0.03


def test_draws_are_the_same_in_every_run():
    fit = fitted(793)
    assert np.array_equal(joint_draws(fit), joint_draws(fit))
    assert not np.array_equal(joint_draws(fit), joint_draws(fit, seed=1))


def test_readings_without_scatter_leave_nothing_to_draw():
    beta = joint_draws(fitted(793, noise=0.0), 8)
    np.testing.assert_allclose(beta, np.tile(beta[:, :1], 8), atol=1e-9)
