"""The measured spring: its law, where a robot rests on it, and its equation of motion."""

import math

import numpy as np
import pytest
from cases import DELTA_MAX, fitted
from helpers import near
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from suspension import course
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.spring_law import SpringLaw, linearised, make_measured_gfunc, rest

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
UNEQUAL = Robot(800, 800, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9)
LINE = SpringLaw(0.0, 800 * DELTA_MAX, 0.0, DELTA_MAX)
CURVED = SpringLaw(1.5, 11.0, 4.0, DELTA_MAX)
BENT = SpringLaw(-0.4, 15.0, -3.0, DELTA_MAX, stop=8000.0)
METAL = SpringLaw(1.5, 11.0, 4.0, DELTA_MAX, stop=8e5)
LAWS = {"line": LINE, "curved": CURVED, "bent": BENT, "metal": METAL}
each_law = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)


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


def test_one_law_has_no_index_and_many_are_gone_through():
    with pytest.raises(ValueError, match="^law must be several laws"):
        LINE[0]
    many = SpringLaw([0.0, 1.0], 13.0, 0.0, DELTA_MAX)
    assert [float(one.beta0) for one in many] == [0.0, 1.0]
    with pytest.raises(IndexError):
        many[2]


@each_law
def test_the_stiffest_slope_is_that_of_the_steepest_place(law):
    slopes = law.tangent(np.linspace(-1, 2, 301) * DELTA_MAX)
    assert math.isclose(law.stiffest, slopes.max(), rel_tol=1e-12)
    inside = np.linspace(-1, 0.999, 99) * DELTA_MAX
    assert math.isclose(law.free.stiffest, law.tangent(inside).max(), rel_tol=2e-3)
    assert np.array_equal(law.free.force(inside), law.force(inside))


def test_of_a_fit_it_has_its_coefficients():
    fit = fitted(793, preload=0.4, curvature=1.0)
    assert SpringLaw.of(fit).stop == 0
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


def test_a_spring_that_hardly_grows_is_taken():
    for law in (SpringLaw(0, 1e-3, 0, DELTA_MAX), SpringLaw(0, 10, -4.99, DELTA_MAX)):
        assert law.tangent(2 * DELTA_MAX) > 0


# --- at rest --------------------------------------------------------------------------------------


@each_law
@pytest.mark.parametrize("robot", [ROBOT, UNEQUAL], ids=["equal", "unequal"])
def test_at_rest_nothing_moves(law, robot):
    w = rest(robot, law)
    wdot, N1, N2 = make_measured_gfunc(robot, law, FlatRoad())(w, 0.0, 0.0)
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


# --- the equation of motion -----------------------------------------------------------------------


@pytest.mark.parametrize("v", [1.2, 10])
def test_the_linear_limit_is_the_linear_robot_to_roundoff(v):
    mine = make_measured_gfunc(ROBOT, LINE, BUMP)
    theirs = course.make_gfunc(ROBOT, BUMP)
    near(rest(ROBOT, LINE), ROBOT.equilibrium, 1e-14)
    w0, tfinal = ROBOT.equilibrium, 0.5 / v
    W, _ = course.RK4(mine, w0, tfinal / 400, tfinal, v)
    near(W, course.RK4(theirs, w0, tfinal / 400, tfinal, v)[0], 1e-12)


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
