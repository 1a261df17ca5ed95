"""Wheels with mass: energy, convergence, their massless limit, and how heavy one may be."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp, trapezoid

from suspension import FlatRoad, GaussianBump, Robot, fly, margin
from suspension.exact import over_bump
from suspension.road import road_input
from suspension.tyre import Tyre, heaviest_wheel, roll

ROBOT, BUMP = Robot(800, 800), GaussianBump()
CROOKED = Robot(500, 900, m=2.0, L1=0.08, L2=0.13, c1=3.0, c2=1.0)
SOFT = Tyre.with_ratio(0.05, 2e4, 0.1)


@pytest.mark.parametrize("robot", [ROBOT, CROOKED])
def test_at_rest_it_stays_and_the_tyres_carry_body_and_wheels(robot):
    run = roll(robot, FlatRoad(), SOFT, v=1, tfinal=0.05)  # five swings of the wheels
    assert np.ptp(run.W, axis=1) == pytest.approx(0, abs=1e-12)
    load = robot.C @ robot.equilibrium + SOFT.mass * robot.g
    assert run.N[:, -1] == pytest.approx(load, rel=1e-9)
    assert run.loss is None and run.flights == () and run.airtime.tolist() == [0, 0]


def dop853(robot, road, tyre, v, tfinal):
    """The same equations, typed anew from Newton's laws for body and wheels, integrated tightly."""
    a, b = robot.L1, robot.L2

    def rate(t, z):
        Y, dY, th, dth, y1, y2, d1, d2 = z
        f1 = robot.k1 * (y1 - Y + a * th) + robot.c1 * (d1 - dY + a * dth)
        f2 = robot.k2 * (y2 - Y - b * th) + robot.c2 * (d2 - dY - b * dth)
        (H1, H2), (s1, s2) = road(np.array([v * t - a, v * t + b]))
        N = []
        for H, s, y, d in ((H1, s1, y1, d1), (H2, s2, y2, d2)):
            push = tyre.stiffness * (H - y) + tyre.damping * (v * s - d)
            N.append(max(push, 0) if y < H else 0)
        ddY = (f1 + f2) / robot.m - robot.g
        ddth = (b * f2 - a * f1) / robot.Izz
        lift = [(N[i] - (f1, f2)[i]) / tyre.mass - robot.g for i in (0, 1)]
        return [dY, ddY, dth, ddth, d1, d2, *lift]

    z0 = roll(robot, FlatRoad(), tyre, v=v, tfinal=0.01, samples=2).W[:, 0]
    kw = {"method": "DOP853", "rtol": 1e-9, "atol": 1e-11, "max_step": 1e-3 / v}
    return solve_ivp(rate, (0, tfinal), z0, t_eval=np.linspace(0, tfinal, 201), **kw).y


@pytest.mark.slow
@pytest.mark.parametrize("robot", [ROBOT, CROOKED])
@pytest.mark.parametrize("v", [1.2, 10])
def test_it_agrees_with_newtons_laws_typed_anew(robot, v):
    tfinal = 0.6 / v
    truth = dop853(robot, BUMP, SOFT, v, tfinal)
    run = roll(robot, BUMP, SOFT, v=v, tfinal=tfinal, samples=201)
    assert run.flights
    size = np.abs(truth - truth[:, :1]).max(axis=1)
    assert np.abs(run.W - truth).max(axis=1) / size == pytest.approx(0, abs=2e-5)


@pytest.mark.slow
@pytest.mark.parametrize("v", [1.2, 10])
def test_energy_adds_up(v):
    tfinal = 0.7 / v
    run = roll(CROOKED, BUMP, SOFT, v=v, tfinal=tfinal, samples=200001)
    Y, dY, th, dth, *_ = run.W
    y, d = run.W[4:6], run.W[6:]
    u = road_input(CROOKED, BUMP, v, run.T)
    p, rate = y - (Y + np.outer(CROOKED.arms, th)), d - (dY + np.outer(CROOKED.arms, dth))
    q, squash = np.maximum(u[:2] - y, 0), u[2:] - d
    stored = (CROOKED.m * dY**2 + CROOKED.Izz * dth**2 + SOFT.mass * (d**2).sum(axis=0)) / 2
    stored += CROOKED.g * (CROOKED.m * Y + SOFT.mass * y.sum(axis=0))
    stored += (CROOKED.k @ p**2 + SOFT.stiffness * (q**2).sum(axis=0)) / 2
    work = trapezoid((run.N * u[2:]).sum(axis=0), run.T)
    in_dampers = trapezoid(CROOKED.c @ rate**2, run.T)
    in_tyres = trapezoid(((run.N - SOFT.stiffness * q) * squash).sum(axis=0), run.T)
    assert run.flights and in_tyres > 0
    scale = np.ptp(stored)
    assert abs(work - in_dampers - in_tyres - (stored[-1] - stored[0])) < 2e-5 * scale


@pytest.mark.slow
def test_it_converges():
    def outcome(rtol):
        run = roll(ROBOT, BUMP, SOFT, v=1.2, tfinal=0.4, rtol=rtol)
        return np.array([*run.airtime, *run.gaps.max(axis=1)])

    truth = outcome(1e-10)
    errors = [np.abs(outcome(rtol) / truth - 1).max() for rtol in (1e-4, 1e-6, 1e-8)]
    assert errors[2] < 1e-5 and errors[2] < errors[1] < errors[0]


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [0.1, 1])
def test_light_wheels_on_stiff_tyres_relax(ratio):
    # Where the two massless rules differ it is the relaxing one that is approached.
    v, tfinal = 40, 0.03
    rules = {w: fly(ROBOT, BUMP, v=v, tfinal=tfinal, wheel=w) for w in ("follows", "relaxes")}
    away = []
    for mass, stiffness in ((1e-3, 1e6), (1e-4, 1e7), (1e-5, 1e8)):
        tyre = Tyre.with_ratio(mass, stiffness, ratio)
        run = roll(ROBOT, BUMP, tyre, v=v, tfinal=tfinal, rtol=1e-6)
        away.append(np.abs(run.airtime / rules["relaxes"].airtime - 1).max())
    assert away[2] < away[1] < away[0] and away[2] < 0.03
    assert np.abs(rules["follows"].airtime / rules["relaxes"].airtime - 1).min() > 0.3


@pytest.mark.parametrize("robot", [ROBOT, CROOKED])
@pytest.mark.parametrize("v", [0.25, 8.5, 10, 15])
def test_the_heaviest_wheel_just_keeps_contact(robot, v):
    # N = f + mass (g + h''), sampled by brute force from the closed form.
    t = np.linspace(0, 1.25 / v, 200001)
    W = over_bump(robot, BUMP, v, t)
    u = road_input(robot, BUMP, v, t)
    f = robot.C @ W + robot.D @ u
    x = (v * t + robot.arms[:, None] - BUMP.centre) / BUMP.sigma
    fall = robot.g + (v / BUMP.sigma) ** 2 * (x**2 - 1) * u[:2]
    mass = heaviest_wheel(robot, BUMP, v)
    if margin(robot, BUMP, v) <= 0:
        assert mass == 0
    elif fall.min() >= 0:
        assert mass == np.inf
    else:
        brute = (f / -fall)[fall < 0].min()
        assert mass == pytest.approx(brute, rel=1e-6) and mass <= brute * (1 + 1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("v", [9, 12])
def test_a_run_on_a_nearly_rigid_tyre_turns_at_the_heaviest_wheel(v):
    mass = heaviest_wheel(ROBOT, BUMP, v)
    for part, flies in ((0.97, False), (1.03, True)):
        tyre = Tyre.with_ratio(part * mass, 3e7, 0.5)
        assert bool(roll(ROBOT, BUMP, tyre, v=v, tfinal=0.5 / v).flights) is flies


def test_a_wheel_of_a_robot_that_loses_contact_anyway_may_weigh_nothing():
    assert heaviest_wheel(ROBOT, BUMP, 1.2) == 0
    assert heaviest_wheel(ROBOT, replace(BUMP, height=1e-4), 0.1) == np.inf


@pytest.mark.parametrize(
    "bad", [{"v": 0}, {"tfinal": -1}, {"samples": 1}, {"rtol": 1}, {"tyre": 3}, {"robot": None}]
)
def test_bad_input_is_named(bad):
    good = {"robot": ROBOT, "road": BUMP, "tyre": SOFT, "v": 1, "tfinal": 1} | bad
    with pytest.raises((ValueError, TypeError), match=next(iter(bad))):
        roll(**good)


def test_too_long_a_run_is_refused_with_the_remedy():
    with pytest.raises(ValueError, match="resolution"):
        roll(ROBOT, BUMP, SOFT, v=1, tfinal=1e5)
