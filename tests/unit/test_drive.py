"""Very many runs on a ground that pushes or pulls: beside `fly`, exact margins, Newton's laws."""

import math
from dataclasses import replace

import numpy as np
import pytest
from cases import DELTA_MAX
from scipy.integrate import solve_ivp

from suspension import sweep as module
from suspension.contact import critical_speeds, exact_loss, margin
from suspension.exact import Crossing, over_bump
from suspension.flight import fly
from suspension.least_force import exact_forces
from suspension.road import ISO_8608, FlatRoad, GaussianBump, RoughRoad
from suspension.robot import Robot
from suspension.spring_law import SpringLaw
from suspension.sweep import Drive, drive

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
UNEQUAL = Robot(900, 500, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9)
ASKED = np.array([0.25, 1.2, 5, 10])
LINE = SpringLaw(0.0, 800 * DELTA_MAX, 0.0, DELTA_MAX)
CURVED = SpringLaw(1.5, 11.0, 4.0, DELTA_MAX)
STOPS = SpringLaw(1.5, 11.0, 4.0, DELTA_MAX, [0.0, 8e3, 8e5])
grounds = pytest.mark.parametrize("ground", ["pushes", "pulls"])


def random_robots(rng, n):
    """Robots whose axles differ, from weakly to strongly damped."""
    return [
        Robot(
            *(10 ** rng.uniform(2.3, 3.4, 2)),
            m=rng.uniform(1, 2.5),
            Izz=rng.uniform(0.008, 0.02),
            L1=rng.uniform(0.08, 0.12),
            L2=rng.uniform(0.08, 0.12),
            **dict(zip(("c1", "c2"), 10 ** rng.uniform(-0.5, 0.9, 2))),
        )
        for _ in range(n)
    ]


# --- a ground that only pushes --------------------------------------------------------------------


def beside_fly(robots, speeds):
    """Hold runs against `fly`, which locates every switch."""
    found = drive(robots, BUMP, speeds)
    off = []
    for i, (robot, v) in enumerate(zip(robots, speeds)):
        flight = fly(robot, BUMP, v=v, tfinal=1.25 / v)
        lifts = [event for event in flight.events if event.kind == "lift-off"]
        assert list(found.flights[:, i]) == [
            sum(event.wheel == wheel for event in lifts) for wheel in (1, 2)
        ]
        assert found.kept[i] == (not lifts) == np.isinf(found.lost[i])
        assert found.wheel[i] == (lifts[0].wheel if lifts else 0)
        if lifts:
            assert abs(found.lost[i] - lifts[0].X) < 1e-5
        else:
            assert math.isclose(found.margin[i], margin(robot, BUMP, v), abs_tol=1e-3)
        largest = np.abs(flight.N.sum(axis=0) / robot.m - robot.g).max()
        x = np.add.outer(robot.arms, v * flight.T)
        p = BUMP(x)[0] - flight.W[0] - robot.arms[:, None] * flight.W[2]
        off.append([
            abs(found.acceleration[i] / largest - 1),
            np.abs(found.airtime[:, i] - flight.airtime).max() * v / 1.25,
            abs(found.compression[i] / p.max() - 1),
            abs(max(found.extension[i], 0) - max(-p.min(), 0)) / p.max(),
            abs(found.pitch[i] / np.abs(flight.W[2]).max() - 1),
        ])  # fmt: skip
    off = np.array(off)
    assert off.max() < 0.01
    assert np.median(off, axis=0).max() < 1e-3


def test_flights_and_peaks_are_those_of_fly():
    rng = np.random.default_rng(1)
    beside_fly([ROBOT, ROBOT, *random_robots(rng, 2)], [1.2, 10, *(10 ** rng.uniform(0, 1, 2))])


@pytest.mark.slow
def test_flights_and_peaks_of_200_settings_are_those_of_fly():
    rng = np.random.default_rng(7)
    beside_fly(random_robots(rng, 200), 10 ** rng.uniform(-0.4, 1, 200))


def test_where_contact_is_kept_both_grounds_are_the_same():
    v = np.geomspace(0.2, 30, 40)
    pushed, pulled = (drive(ROBOT, BUMP, v, ground=ground) for ground in ("pushes", "pulls"))
    assert np.array_equal(pushed.kept, pulled.kept) and 10 < pushed.kept.sum() < 30
    for one, other in zip(pushed, pulled):
        np.testing.assert_array_equal(one[..., pushed.kept], other[..., pushed.kept])
    assert np.array_equal(pushed.wheel, pulled.wheel)
    np.testing.assert_allclose(pushed.lost, pulled.lost, atol=1e-5)


def test_after_a_loss_there_is_no_margin_on_a_ground_that_pushes():
    found = drive(ROBOT, BUMP, [1.2, 5])
    assert list(found.margin) == [0, 0] and (found.airtime > 0).all()
    pulled = drive(ROBOT, BUMP, [1.2, 5], ground="pulls")
    assert (pulled.margin < 0).all() and np.isnan(pulled.airtime).all()
    assert not pulled.flights.any()
    assert (pulled.acceleration < found.acceleration).any()


# --- a ground that pulls: the closed form ---------------------------------------------------------


def test_margins_and_places_are_the_exact_ones():
    rng = np.random.default_rng(3)
    robots, speeds = random_robots(rng, 20), 10 ** rng.uniform(-0.5, 1.3, 20)
    found = drive(robots, BUMP, speeds, ground="pulls")
    for i, (robot, v) in enumerate(zip(robots, speeds)):
        exact, loss = margin(robot, BUMP, v), exact_loss(robot, BUMP, v)
        assert math.isclose(found.margin[i], exact, rel_tol=2e-4, abs_tol=1e-3)
        assert found.wheel[i] == (loss.wheel if loss else 0)
        assert not loss or abs(found.lost[i] - v * loss.t) < 1e-5


def test_extremes_are_those_up_to_the_loss():
    found = drive(UNEQUAL, BUMP, ASKED, ground="pulls")
    assert np.isfinite(found.lost).sum() == 2
    for i, v in enumerate(ASKED):
        T = np.linspace(0, min(found.lost[i], 1.25) / v, 40001)
        W = over_bump(UNEQUAL, BUMP, v, T)
        N = exact_forces(Crossing(UNEQUAL, BUMP, v), T)[0]
        x = np.add.outer(UNEQUAL.arms, v * T)
        p = BUMP(x)[0] - W[0] - UNEQUAL.arms[:, None] * W[2]
        for mine, true in [
            (found.acceleration[i], np.abs(N.sum(axis=0) / UNEQUAL.m - UNEQUAL.g).max()),
            (found.compression[i], p.max()),
            (found.pitch[i], np.abs(W[2]).max()),
        ]:
            assert math.isclose(mine, true, rel_tol=3e-3)
        assert math.isclose(found.extension[i], max(0, -p.min()), rel_tol=3e-3, abs_tol=1e-5)


@pytest.mark.slow
@grounds
def test_a_loss_has_a_place_exactly_where_the_margin_is_not_positive(ground):
    near = np.concatenate([[-1e-3, -1e-4, -1e-6], [1e-6, 1e-4, 1e-3]])
    speeds = np.outer(critical_speeds(ROBOT, BUMP, 0.2, 30), 1 + near).ravel()
    found = drive(ROBOT, BUMP, speeds, ground=ground)
    assert np.array_equal(np.isfinite(found.lost), found.margin <= 0)
    assert np.array_equal(found.wheel > 0, found.margin <= 0)
    by_sign = [margin(ROBOT, BUMP, v) > 0 for v in speeds]
    assert np.array_equal(found.kept, by_sign)


@pytest.mark.slow
@grounds
def test_so_it_is_on_stops(ground):
    rng = np.random.default_rng(2)
    n = 256
    law = SpringLaw(0.0, 13.2, 0.0, DELTA_MAX, 10 ** rng.uniform(3, 5.9, n))
    robots = [Robot(1, 1, m=m, c1=5, c2=5) for m in rng.choice([3.0, 3.7], n)]
    found = drive(
        robots, GaussianBump(0.0146, 0.018), 10 ** rng.uniform(-0.3, 0.4, n), law=law, ground=ground
    )
    assert np.array_equal(np.isfinite(found.lost), found.margin <= 0)
    assert 0.1 < found.kept.mean() < 0.9


def test_finer_steps_approach_the_exact_margin_with_order_four():
    # Steps of a third of a sigma and less: the looks between the samples, of second order with a
    # small factor, are not seen yet.
    fine = np.array([0.12, 0.16, 0.22, 0.3])
    errors = []
    for f in fine:
        found = drive(UNEQUAL, BUMP, ASKED, ground="pulls", fine=f).margin
        errors.append(np.abs(found - [margin(UNEQUAL, BUMP, v) for v in ASKED]).max())
    assert -np.polyfit(np.log(fine), np.log(errors), 1)[0] > 3


# --- other laws -----------------------------------------------------------------------------------


def plain(robots, law, bump, v, steps, pushes=True):
    """The same by a plain loop in SI units: samples only, far more of them."""
    m, inertia, L, c = (
        np.array([getattr(robot, name) for robot in robots]) for name in ("m", "Izz", "L1", "c1")
    )
    arms, dt = np.array([-L, L]), 1.25 / v / steps

    def rate(t, w):
        x = v * t + arms
        s = (x - bump.centre) / bump.sigma
        h = bump.height * np.exp(-(s**2) / 2)
        p = h - w[0] - arms * w[2]
        spring = law.force(p)
        f = spring + c * (-s * h / bump.sigma * v - w[1] - arms * w[3])
        N = np.where((spring > 0) & (f > 0), f, 0) if pushes else f
        acceleration = N.sum(axis=0) / m - 9.81
        return np.array([w[1], acceleration, w[3], L * (N[1] - N[0]) / inertia]), f, p

    w = np.array([-law.displacement(m * 9.81 / 2), 0 * m, 0 * m, 0 * m])
    least, lost = np.full(m.size, np.inf), np.full(m.size, np.inf)
    most, deepest = np.zeros(m.size), np.zeros(m.size)
    for j in range(steps + 1):
        t = j * dt
        k1, f, p = rate(t, w)
        lost = np.where(np.isinf(lost) & (f.min(axis=0) <= 0), v * t, lost)
        least = np.minimum(least, f.min(axis=0))
        most, deepest = np.maximum(most, np.abs(k1[1])), np.maximum(deepest, p.max(axis=0))
        k2 = rate(t + dt / 2, w + dt / 2 * k1)[0]
        k3 = rate(t + dt / 2, w + dt / 2 * k2)[0]
        k4 = rate(t + dt, w + dt * k3)[0]
        w = w + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return least, lost, most, deepest


def test_a_heavy_robot_keeps_contact_on_a_stiff_stop():
    robot, bump = Robot(1, 1, m=3.7, c1=5, c2=5), GaussianBump(0.0146, 0.018, 0.3)
    law = SpringLaw(0, 13.2, 0, 0.0165, stop=8e5)
    found = drive(robot, bump, 0.77, law=law)
    assert abs(found.margin - 0.900) < 0.02 and np.isinf(found.lost)
    assert found.compression > law.delta_max


@pytest.mark.slow
def test_60_robots_on_stops_are_those_of_a_fine_plain_loop():
    rng = np.random.default_rng(5)
    n = 60
    robots = [Robot(1, 1, m=m, c1=c, c2=c) for m, c in rng.uniform([1.5, 1], [4, 6], (n, 2))]
    law = SpringLaw(0.0, 13.2, 0.0, DELTA_MAX, 10 ** rng.uniform(3, np.log10(8e5), n))
    bump, v = GaussianBump(0.008, 0.02), 10 ** rng.uniform(-0.2, 0.9, n)
    found = drive(robots, bump, v, law=law)
    least, lost, most, deepest = plain(robots, law, bump, v, 40_000)
    load = np.array([robot.m * robot.g / 2 for robot in robots])
    assert np.array_equal(found.kept, least > 0) and 0.2 < found.kept.mean() < 0.8
    assert (deepest > DELTA_MAX).mean() > 0.7
    assert (np.abs(found.margin - np.maximum(least, 0)) < 0.01 * load).all()
    gone = ~found.kept
    assert np.abs(found.lost[gone] - lost[gone]).max() < 1e-4
    np.testing.assert_allclose(found.acceleration, most, rtol=5e-3)
    np.testing.assert_allclose(found.compression, deepest, rtol=1e-3)


@pytest.mark.slow
def test_a_curved_law_is_that_of_a_fine_plain_loop():
    found = drive(ROBOT, BUMP, ASKED, law=CURVED)
    least, lost, most, deepest = plain([ROBOT] * 4, CURVED, BUMP, ASKED, 4000)
    assert np.array_equal(found.kept, least > 0)
    np.testing.assert_allclose(found.margin, np.maximum(least, 0), atol=1e-3)
    np.testing.assert_allclose(found.lost, lost, atol=4e-4)
    np.testing.assert_allclose(found.acceleration, most, rtol=2e-3)
    np.testing.assert_allclose(found.compression, deepest, rtol=1e-3)


@grounds
def test_a_preload_only_moves_the_rest_of_a_straight_spring(ground):
    preloaded = SpringLaw(2.0, 800 * DELTA_MAX, 0.0, DELTA_MAX)
    one, other = (drive(ROBOT, BUMP, ASKED, law=law, ground=ground) for law in (LINE, preloaded))
    for name in ("margin", "lost", "wheel", "acceleration", "pitch", "airtime", "flights"):
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(one.compression - other.compression, 2.0 / 800, rtol=1e-9)


def test_a_straight_law_is_no_law():
    one, other = (
        drive(UNEQUAL, BUMP, ASKED),
        drive(UNEQUAL, BUMP, ASKED, law=SpringLaw(0.0, 700 * DELTA_MAX, 0.0, DELTA_MAX)),
    )
    assert np.abs(one.margin - other.margin).max() > 0.1
    straight = replace(UNEQUAL, k1=700, k2=700)
    np.testing.assert_allclose(drive(straight, BUMP, ASKED).margin, other.margin, rtol=1e-9)


@grounds
def test_a_stop_that_is_not_reached_changes_nothing(ground):
    far = SpringLaw(0.0, 3 * 800 * DELTA_MAX, 0.0, 3 * DELTA_MAX, stop=[0.0, 8e5])
    for values in drive(ROBOT, BUMP, 10, law=far, ground=ground):
        assert (values[..., 0] == values[..., 1]).all()


def test_a_stop_takes_contact_from_a_fast_crossing():
    law = SpringLaw(0.0, 800 * DELTA_MAX, 0.0, DELTA_MAX, [0.0, 800.0, 8e3, 8e5])
    assert list(drive(ROBOT, BUMP, 10, law=law).kept) == [True, False, False, False]


def test_a_robot_on_its_stop_is_one_with_that_stiffness_while_it_stays_there():
    soft = SpringLaw(0.0, 100 * DELTA_MAX, 0.0, DELTA_MAX, stop=5000)
    low, stiff = GaussianBump(height=1e-3), Robot(5100, 5100)
    found = drive(ROBOT, low, 0.5, law=soft)
    assert found.compression > DELTA_MAX
    assert math.isclose(found.margin, margin(stiff, low, 0.5), rel_tol=1e-4)


# --- the full geometry ----------------------------------------------------------------------------


def by_power(robot, bump, v, law, ground="pulls", distance=1.25):
    """Least force, largest pitch and airtime of a rigid body, from its vertical forces' power.

    Nothing but the place of a wheel is written down. Rates and lever arms are derivatives of it,
    taken along an imaginary step: Newton's equations follow from the power of the forces.
    """
    eps = 1e-30

    def compressions(t, Y, theta):
        x = v * t + robot.arms * np.cos(theta)
        s = (x - bump.centre) / bump.sigma
        return bump.height * np.exp(-(s**2) / 2) - Y - robot.arms * np.sin(theta)

    def forces(t, w):
        step = 1j * eps
        moved = compressions(t + step, w[0] + step * w[1], w[2] + step * w[3])
        spring = law.force(moved.real)
        f = spring + robot.c * moved.imag / eps
        return f if ground == "pulls" else np.where(spring >= 0, np.maximum(f, 0), 0)

    def rate(t, w):
        N = forces(t, w)
        lever = (robot.arms * np.sin(w[2] + 1j * eps)).imag / eps
        return [w[1], N.sum() / robot.m - robot.g, w[3], lever @ N / robot.Izz]

    span = robot.L1 + robot.L2
    loads = robot.m * robot.g * np.array([robot.L2, robot.L1]) / span
    rear, front = -law.displacement(loads)
    theta = np.arcsin((front - rear) / span)
    start = [front - robot.L2 * np.sin(theta), 0, theta, 0]
    tight = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-12, "max_step": 0.5 * bump.sigma / v}
    run = solve_ivp(rate, (0, distance / v), start, dense_output=True, **tight)
    T = np.linspace(0, distance / v, 6001)
    W = run.sol(T)
    N = np.array([forces(t, w) for t, w in zip(T, W.T)]).T
    return N.min(), np.abs(W[2]).max(), (N <= 0).mean(axis=1) * distance / v


@pytest.mark.slow
@pytest.mark.parametrize("v", [0.4, 0.9, 2.0])
@pytest.mark.parametrize("robot", [replace(ROBOT, c1=5, c2=5), UNEQUAL], ids=["equal", "unequal"])
def test_the_full_geometry_is_newtons(robot, v):
    law = SpringLaw(0.5, 12.0, 1.0, DELTA_MAX)
    least, tilt, _ = by_power(robot, BUMP, v, law)
    found = drive(robot, BUMP, v, law=law, ground="pulls", geometry="full")
    small = drive(robot, BUMP, v, law=law, ground="pulls")
    assert abs(found.margin - least) < 2e-3
    assert abs(small.margin - least) > 30 * abs(found.margin - least)
    if least > 0:
        assert math.isclose(found.pitch, tilt, rel_tol=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("v", [1.2, 5.0])
def test_a_rigid_body_flies_and_lands_in_the_full_geometry(v):
    law = SpringLaw(0.0, 13.2, 0.0, DELTA_MAX)
    _, tilt, airtime = by_power(ROBOT, BUMP, v, law, ground="pushes")
    small, full = (drive(ROBOT, BUMP, v, law=law, geometry=g) for g in ("small", "full"))
    assert math.isclose(full.pitch, tilt, rel_tol=1e-3)
    np.testing.assert_allclose(full.airtime, airtime, rtol=2e-3, atol=1.25 / v / 3000)
    assert abs(small.pitch / tilt - 1) > 3 * abs(full.pitch / tilt - 1)


def test_what_the_full_geometry_adds_is_cubic_in_the_height():
    # sin and cos leave out terms of third order, and the place of a wheel moves by one of second.
    apart = []
    for height in (8e-3, 4e-3):
        low = replace(BUMP, height=height)
        small, full = (drive(ROBOT, low, [0.5, 3], geometry=g) for g in ("small", "full"))
        assert small.kept.all()
        apart.append(np.abs(small.margin - full.margin))
    np.testing.assert_allclose(apart[0] / apart[1], 8, rtol=0.02)


@grounds
def test_at_rest_nothing_moves_in_any_geometry(ground):
    for geometry in ("small", "full"):
        found = drive(UNEQUAL, FlatRoad(), [0.5, 3], law=STOPS[2], ground=ground, geometry=geometry)
        least = UNEQUAL.m * UNEQUAL.g * min(UNEQUAL.L1, UNEQUAL.L2) / (UNEQUAL.L1 + UNEQUAL.L2)
        np.testing.assert_allclose(found.margin, least, rtol=1e-9)
        assert found.acceleration.max() < 1e-9


# --- side by side ---------------------------------------------------------------------------------


def test_robots_laws_and_speeds_are_broadcast():
    robots = np.array([ROBOT, UNEQUAL])[:, None, None]
    found = drive(robots, BUMP, [2.0, 10.0], law=STOPS[:2, None])
    assert found.margin.shape == found.lost.shape == (2, 2, 2)
    assert found.airtime.shape == found.flights.shape == (2, 2, 2, 2)
    alone = drive(UNEQUAL, BUMP, 10.0, law=STOPS[1])
    for many, one in zip(found, alone):
        np.testing.assert_allclose(many[..., 1, 1, 1], one, rtol=2e-3, atol=1e-6)
    assert drive(ROBOT, BUMP, [], law=STOPS[:, None]).airtime.shape == (2, 3, 0)
    assert drive(ROBOT, BUMP, 1.2).margin.shape == ()
    assert drive([], BUMP, 1.2).margin.shape == (0,)


@pytest.mark.parametrize("rows", [11, 17, 1000])
def test_how_the_work_is_cut_does_not_matter(monkeypatch, rows):
    robots = np.array([ROBOT, UNEQUAL])[:, None]
    v = np.array([0.5, 1.2, 4, 11])
    whole = drive(robots, BUMP, v)
    monkeypatch.setattr(module, "ROWS", rows)
    for one, other in zip(drive(robots, BUMP, v), whole):
        np.testing.assert_allclose(one, other, rtol=1e-6, atol=1e-9)


def test_batches_do_not_matter(monkeypatch):
    v = np.geomspace(1, 11, 7)
    whole = drive(ROBOT, BUMP, v)
    monkeypatch.setattr(module, "SIDE_BY_SIDE", 3)
    for one, other in zip(drive(ROBOT, BUMP, v), whole):
        np.testing.assert_array_equal(one, other)


def test_the_road_is_asked_for_on_the_way_only_and_once_for_each_wheelbase():
    asked = []

    def road(x):
        asked.append(x)
        return BUMP(x)

    drive([ROBOT, replace(ROBOT, k1=700), UNEQUAL], road, 3.0, distance=0.9)
    x = np.concatenate(asked)
    assert x.min() >= -0.107 - 1e-12 and x.max() <= 0.9 + 0.13 + 1e-12
    assert x.size < 3 * 2 * 2 * 1000


def test_a_rough_road_is_driven_on_as_far_as_it_is_said():
    road = RoughRoad(ISO_8608["C"], length=5, shortest=0.2)
    found = drive(ROBOT, road, [1.0, 5.0], distance=3)
    assert np.isfinite(found.margin).all() and (found.lost[~found.kept] < 3).all()


def test_where_the_bump_ends_is_asked_for():
    far = GaussianBump(centre=1.2)
    with pytest.raises(ValueError, match=r"^distance must be given, 1\.43 m or more"):
        drive(ROBOT, far, 1.2)
    shifted = drive(ROBOT, far, 1.2, distance=2.15)
    assert math.isclose(shifted.lost, drive(ROBOT, BUMP, 1.2).lost + 0.9, abs_tol=1e-6)
    with pytest.raises(ValueError, match="^bump must begin ahead"):
        drive(ROBOT, GaussianBump(centre=0.1), 1.2)
    assert drive(ROBOT, lambda x: GaussianBump(centre=0.1)(x), 1.2).margin.shape == ()


@pytest.mark.parametrize("many", [1, 2000])
def test_one_long_run_is_bounded_like_many(many):
    with pytest.raises(ValueError, match="^v must not be so low"):
        drive(ROBOT, BUMP, np.full(many, 1e-3 if many == 1 else 0.005))


def test_a_result_says_what_was_kept():
    found = drive(ROBOT, BUMP, ASKED)
    assert isinstance(found, Drive)
    assert list(found.kept) == [True, False, False, True]


def test_a_robot_that_would_stand_upright_is_no_fault_of_the_road():
    upright = Robot(800, 800, m=50, L1=0.01, L2=0.2)
    assert np.isfinite(drive(upright, FlatRoad(), 1.0).margin)
    with pytest.raises(ValueError, match="^robots and law must leave the springs at rest no furth"):
        drive(upright, FlatRoad(), 1.0, geometry="full")


def test_very_many_cases_are_refused_before_they_are_written_down():
    robots, v = np.full((100_000, 1), ROBOT), np.linspace(1, 2, 100_000)
    with pytest.raises(ValueError, match="v must not be so low or so many"):
        drive(robots, BUMP, v)
