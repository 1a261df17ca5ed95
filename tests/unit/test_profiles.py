"""The exact margin over a road in pieces, against solvers that know nothing of it."""

from dataclasses import replace

import numpy as np
import pytest
from helpers import near
from scipy.integrate import solve_ivp

from suspension import (
    GaussianBump,
    Robot,
    critical_speeds,
    fly,
    highest_bump,
    profiles,
    simulate,
)
from suspension.least_force import minima
from suspension.profiles import (
    Passage,
    highest_multiple,
    profile_loss,
    profile_margin,
    profile_minima,
    profile_regimes,
    stand_in,
)
from suspension.road import RoadProfile
from suspension.schemes import RK4
from suspension.similarity import groups

ROBOT = Robot(800, 800)
LOPSIDED = Robot(700, 1000, L1=0.12, L2=0.09, c1=2.0, c2=0.5)
ROBOTS = {
    "the problem's": ROBOT,
    "unsymmetric": LOPSIDED,
    "undamped": Robot(800, 800, c1=0, c2=0),
    "overdamped": Robot(800, 800, c1=90, c2=70),
    "critically damped": replace(ROBOT, c1=np.sqrt(2 * 800 * 1.456), c2=np.sqrt(2 * 800 * 1.456)),
}
STEP = RoadProfile([0.2, 0.3, 0.4, 0.45], [0, 0.02, 0.02, 0], kind="linear")


def rough(seed, points=12, kind="pchip", high=0.01):
    """A road of random points, from 0.15 m on."""
    rng = np.random.default_rng(seed)
    x = 0.15 + np.cumsum(rng.uniform(0.01, 0.12, points))
    h = rng.normal(0, high, points)
    return RoadProfile(x, h - h[0], kind)


def by_dop853(robot, road, v, distance):
    """Both forces on a fine grid, a solver's run from each point of the road to the next."""
    places = np.subtract.outer(road.x, robot.arms).ravel()
    inside = np.unique(places[(places > 0) & (places < distance)])
    w, found = robot.equilibrium, []
    for a, b in zip([0, *inside], [*inside, distance]):
        if b - a < 1e-12:
            continue
        edge = 1e-9 * (b - a)

        def u(X, a=a, b=b, edge=edge):
            x = np.add.outer(robot.arms, np.clip(X, a + edge, b - edge))
            H, slope = road(x.ravel())
            return np.concatenate([H, v * slope]).reshape(4, *np.shape(X))

        def rate(X, w, u=u):
            return (robot.A @ w + robot.B @ u(X) + robot.e) / v

        X = np.linspace(a, b, 401)
        run = solve_ivp(rate, (a, b), w, "DOP853", t_eval=X, rtol=1e-12, atol=1e-14)
        found.append((X, robot.C @ run.y + robot.D @ u(X)))
        w = run.y[:, -1]
    return (np.concatenate(part, axis=-1) for part in zip(*found))


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["pchip", "linear"])
@pytest.mark.parametrize("name", ROBOTS)
def test_least_forces_are_those_of_a_tight_solver(name, kind):
    robot = ROBOTS[name]
    for seed, v in enumerate((0.3, 1.2, 6.0)):
        road = rough(seed, kind=kind)
        X, N = by_dop853(robot, road, v, 1.4)
        found = profile_minima(robot, road, v, distance=1.4)
        least = N.min(axis=1)
        for minimum, sampled in zip(found, least):
            # Between the solver's samples a force may fall a little lower, never rise.
            assert -2e-3 < minimum.force - sampled < 1e-6
            nearest = np.abs(X - minimum.X).argmin()
            assert (
                np.abs(N[minimum.wheel - 1, nearest - 1 : nearest + 2] - minimum.force).min() < 0.1
            )


@pytest.mark.slow
@pytest.mark.parametrize("name", ROBOTS)
def test_forces_between_samples_are_those_of_a_tight_solver(name):
    robot, road, v = ROBOTS[name], rough(7), 1.7
    X, N = by_dop853(robot, road, v, 1.4)
    passage = Passage(robot, road, [v], 1.4).solve()
    leg = np.clip(np.searchsorted(passage.start, X, side="right") - 1, 0, len(passage.start) - 2)
    mine = passage.forces(np.zeros_like(leg), leg, (X - passage.start[leg]) / v)[0]
    inside = np.abs(np.subtract.outer(passage.start, X)).min(axis=0) > 1e-6  # of the legs
    near(mine[:, inside], N[:, inside], 1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("road", [STEP, rough(3), rough(4, kind="linear")])
def test_the_first_loss_is_the_flight_s_first_lift_off(road):
    for robot in (ROBOT, LOPSIDED):
        for v in (0.8, 2.0, 5.0):
            loss = profile_loss(robot, road, v, distance=1.4)
            flight = fly(robot, road, v=v, tfinal=1.4 / v)
            assert (loss is None) == (not flight.events)
            if loss:
                first = flight.events[0]
                assert (loss.wheel, first.kind) == (first.wheel, "lift-off")
                assert loss.t == pytest.approx(first.t, abs=1e-9)


def test_a_wheel_may_be_lost_in_a_jump():
    peak = RoadProfile([0.2, 0.3, 0.4], [0, 0.03, 0], kind="linear")
    robot, v = replace(ROBOT, c1=15, c2=15), 3.0
    loss = profile_loss(robot, peak, v)
    assert loss.wheel == 2 and v * loss.t == pytest.approx(0.3 - robot.L2, abs=1e-12)
    X, N = by_dop853(robot, peak, v, 0.25)
    top = 0.3 - robot.L2
    assert N[:, X < top - 1e-6].min() > 0 > N[1, X > top + 1e-6].max()


@pytest.mark.slow
def test_a_bump_in_many_pieces_is_the_bump():
    bump = GaussianBump()
    x = np.linspace(0.11, 0.49, 1201)
    road = RoadProfile(x, bump(x)[0] - bump(x[:1])[0])
    for v in (1.2, 5, 10):
        exact, found = minima(ROBOT, bump, v), profile_minima(ROBOT, road, v)
        for one, other in zip(exact, found):
            assert other.force == pytest.approx(one.force, abs=2e-4)
            assert other.X == pytest.approx(one.X, abs=1e-4)
    few = RoadProfile(*(np.array(part)[::12] for part in (road.x, road.h)))
    edges = profile_regimes(ROBOT, few, 5, 25).critical
    np.testing.assert_allclose(edges, critical_speeds(ROBOT, bump, 5, 25), rtol=2e-3)
    heights = highest_multiple(ROBOT, road, [0.5, 5, 12]) * road.h.max()
    np.testing.assert_allclose(heights, highest_bump(ROBOT, bump, [0.5, 5, 12]), rtol=1e-3)


def test_the_time_loop_comes_to_the_same():
    road, v = rough(5), 1.5
    run = simulate(LOPSIDED, road, v=v, dt=2e-5, tfinal=1.25 / v, scheme=RK4)
    assert profile_margin(LOPSIDED, road, v) == pytest.approx(run.N.min(), abs=1e-4)


def test_where_the_slope_jumps_the_force_does_and_both_sides_count():
    v = 2.0
    passage = Passage(LOPSIDED, STEP, [v], 1.25).solve()
    leg = int(np.abs(passage.start - (0.4 - LOPSIDED.L2)).argmin())  # the front wheel at the edge
    legs, length = np.array([leg - 1, leg]), np.diff(passage.start)[leg - 1] / v
    before, after = passage.forces(np.zeros(2, int), legs, np.array([length, 0.0]))[0].T
    jump = LOPSIDED.c2 * v * -0.02 / 0.05
    assert after - before == pytest.approx([0, jump], abs=1e-9)
    [(t, _, N)] = passage.extremes()
    there = np.flatnonzero(np.abs(v * t - passage.start[leg]) < 1e-12)
    assert len(there) == 2 and N[1, there] == pytest.approx([before[1], after[1]])


def test_forces_are_linear_in_the_heights():
    road = rough(6)
    multiple = highest_multiple(LOPSIDED, road, [0.4, 1.5, 8.0])
    for v, part in zip((0.4, 1.5, 8.0), multiple):
        scaled = RoadProfile(road.x, part * road.h)
        assert profile_margin(LOPSIDED, scaled, v) == pytest.approx(0, abs=1e-9)
    assert highest_multiple(ROBOT, RoadProfile([0.2, 0.3], [0, 0]), 1.0) == np.inf


def test_no_height_lifts_a_wheel_on_a_way_that_ends_while_it_climbs():
    ramp = RoadProfile([0.107, 0.4], [0, 0.02], kind="linear")
    assert highest_multiple(replace(ROBOT, k2=813, c2=1.7), ramp, 40.0, distance=0.02) == np.inf


def test_moving_the_road_and_the_end_along_changes_nothing():
    road = rough(8)
    one = profile_minima(LOPSIDED, road, 1.3, distance=1.3)
    moved = RoadProfile(road.x + 2.5, road.h)
    for here, there in zip(one, profile_minima(LOPSIDED, moved, 1.3, distance=3.8)):
        assert there.force == pytest.approx(here.force, abs=1e-9)
        assert there.X - 2.5 == pytest.approx(here.X, abs=1e-9)


def test_at_the_edges_the_margin_is_zero_and_its_sign_is_that_of_the_ranges():
    road = rough(9, points=6)
    found = profile_regimes(LOPSIDED, road, 0.2, 8)
    assert len(found.critical)
    for v in found.critical:
        assert profile_margin(LOPSIDED, road, v) == pytest.approx(0, abs=1e-9)
    for v in np.geomspace(0.2, 8, 60):
        assert found(v) == (profile_margin(LOPSIDED, road, v) <= 0)


@pytest.mark.parametrize("height", [0.0254, -0.01])
def test_the_bump_that_stands_in_for_a_bump_is_the_bump(height):
    bump = GaussianBump(height=height, sigma=0.03, centre=0.4)
    x = np.linspace(0.2, 0.6, 2001)
    found = stand_in(RoadProfile(x, bump(x)[0] - bump(x[:1])[0]))
    assert found.height == pytest.approx(height, rel=1e-3)
    assert found.sigma == pytest.approx(0.03, rel=1e-3) and found.centre == pytest.approx(0.4)
    assert groups(ROBOT, found, 1.2).nu == pytest.approx(groups(ROBOT, bump, 1.2).nu, rel=1e-3)


def test_the_steepest_place_may_lie_between_two_points():
    road = rough(11)
    x = np.linspace(road.x[0], road.x[-1], 200001)
    steepest = np.abs(road(x)[1]).max()
    bump = stand_in(road)
    assert abs(bump.height) / (np.sqrt(np.e) * bump.sigma) == pytest.approx(steepest, rel=1e-7)


REFUSED = [
    ((Robot, STEP, 1), TypeError, "robot must be a Robot"),
    ((ROBOT, GaussianBump(), 1), TypeError, "road must be a RoadProfile"),
    ((ROBOT, STEP, 0), ValueError, "v must be"),
    ((ROBOT, STEP, np.nan), ValueError, "v must be"),
    ((ROBOT, RoadProfile([0.1, 0.3], [0, 0.01]), 1), ValueError, "x = 0.107 m .L2. or more"),
    ((ROBOT, RoadProfile([0.2, 0.3], [0.01, 0]), 1), ValueError, "at height 0, got x.0.=0.2, h.0."),
    ((ROBOT, RoadProfile([0.2, 1.2], [0, 0.01]), 1), ValueError, "distance must be given, 1.307 m"),
    ((ROBOT, STEP, 1e-6), ValueError, "v must be so high"),
]


@pytest.mark.parametrize("arguments, kind, words", REFUSED)
def test_what_cannot_be_is_refused_by_name(arguments, kind, words):
    for function in (profile_margin, profile_minima, profile_loss):
        with pytest.raises(kind, match=words):
            function(*arguments)


def test_more_that_is_refused():
    with pytest.raises(ValueError, match="distance must be"):
        profile_margin(ROBOT, STEP, 1, distance=-1)
    with pytest.raises(ValueError, match="v must be"):
        highest_multiple(ROBOT, STEP, [1, -1])
    with pytest.raises(ValueError, match="vmax must be > vmin"):
        profile_regimes(ROBOT, STEP, 2, 1)
    with pytest.raises(ValueError, match="samples of the forces are needed"):
        profile_regimes(ROBOT, rough(1, points=60, high=0.05), 1e-3, 1, distance=9)
    with pytest.raises(ValueError, match="road must not be level"):
        stand_in(RoadProfile([0, 1], [2, 2]))
    with pytest.raises(TypeError, match="road must be a RoadProfile"):
        stand_in(GaussianBump())


def test_forces_that_lost_digits_are_refused(monkeypatch):
    monkeypatch.setattr(profiles, "DIGITS_LOST", 1e-17)
    with pytest.raises(ValueError, match="robot and road must be so moderate.*may be off by"):
        profile_margin(ROBOT, STEP, 1)


def test_an_end_before_or_on_the_road_is_taken_as_it_is():
    load = ROBOT.m * ROBOT.g / 2
    assert profile_margin(ROBOT, STEP, 1, distance=0.05) == pytest.approx(load)
    assert profile_margin(ROBOT, STEP, 1, distance=0.3) < load
