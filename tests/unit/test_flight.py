"""Contact that switches: against brute force, closed forms, energy, and runs without a switch."""

import math
import re
from bisect import bisect_right
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from suspension.contact import normal_forces
from suspension.course import RK4
from suspension.critical import critical_speeds
from suspension.flight import Event, Flight, _edges, _first_switch, fly, make_flight_gfunc
from suspension.least_force import margin
from suspension.road import ISO_8608, FlatRoad, GaussianBump, RoadProfile, RoughRoad, road_input
from suspension.robot import Robot
from suspension.simulation import simulate

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
LOPSIDED = Robot(800, 500, c1=20, c2=5, L2=0.15)  # its wheels relax slowly: 25 and 10 ms
MODELS = ["follows", "relaxes"]
run = cache(lambda robot, v, tfinal, wheel: fly(robot, BUMP, v=v, tfinal=tfinal, wheel=wheel))


def washboard(x):
    """A road that throws every robot off."""
    x = np.asarray(x, dtype=float)
    return 0.01 * np.sin(60 * x), 0.6 * np.cos(60 * x)


class Kinked(NamedTuple):
    """A road, and its pieces ``piece(x) -> (H, dHdx)`` of floats, each smooth beyond its ends."""

    road: object  # which tells its kinks
    pieces: list  # one more than kinks

    @property
    def kinks(self):
        return list(self.road.kinks)

    def silent(self):
        """The same road, which does not tell where its kinks are."""
        return lambda x: self.road(x)


def level(height):
    return lambda x: (height, 0.0)


def polygon(x, h):
    """A road of straight lines through points."""

    def line(x0, h0, slope):
        return lambda x: (h0 + slope * (x - x0), slope)

    lines = [line(a, p, (q - p) / (b - a)) for (a, b), (p, q) in zip(pairwise(x), pairwise(h))]
    return Kinked(RoadProfile(x, h, "linear"), [level(h[0]), *lines, level(h[-1])])


def half_sine(height=0.0254, length=0.08, start=0.25):
    q = math.pi / length

    def arch(x):
        return height * math.sin(q * (x - start)), height * q * math.cos(q * (x - start))

    def road(x):
        s = (np.asarray(x, float) - start) / length
        on = (s >= 0) & (s <= 1)
        slope = height * np.pi / length * np.cos(np.pi * s)
        return np.where(on, height * np.sin(np.pi * s), 0), np.where(on, slope, 0)

    road.kinks = [start, start + length]
    return Kinked(road, [level(0.0), arch, level(0.0)])


MEASURED = [(0.2, 0), (0.214, 1), (0.235, 0), (0.25, 7), (0.266, 11), (0.28, 19), (0.294, 17)]
MEASURED += [(0.312, 9), (0.326, 3), (0.341, 4), (0.36, 1)]  # m, mm
KINKED = {
    "half-sine": half_sine(),
    "trapezoid": polygon([0.25, 0.28, 0.34, 0.37], [0, 0.02, 0.02, 0]),
    "ramp": polygon([0.25, 0.255], [0, 0.012]),
    "measured": polygon([x for x, _ in MEASURED], [h / 1000 for _, h in MEASURED]),
}


def located(robot, road, v, tfinal, wheel, dt=5e-5):
    """RK4 in short steps that end at every kink, and at every switch by halving the step.

    Written in floats, of the equations as they stand in `fly`'s docstring; the road is never
    asked across a kink. Returns the switches, (wheel, kind, t, force), and the last state.
    """
    k, c, arms = (robot.k1, robot.k2), (robot.c1, robot.c2), (-robot.L1, robot.L2)
    relaxes = wheel == "relaxes"
    meets = sorted((kink - arm) / v for kink in road.kinks for arm in arms)
    ends = [t for t in meets if 0 < t < tfinal] + [tfinal]
    w, t, pressing, events = robot.equilibrium.tolist(), 0.0, [True, True], []
    left = [(0.0, 0.0), (0.0, 0.0)]  # of a free wheel: when, and its spring's compression then

    def spring(i, w, t):
        h, slope = under[i](v * t + arms[i])
        p = h - w[0] - arms[i] * w[2]
        return p, k[i] * p + c[i] * (v * slope - w[1] - arms[i] * w[3])

    def rate(w, t):
        N = [spring(i, w, t)[1] if pressing[i] else 0.0 for i in (0, 1)]
        turn = (N[0] * arms[0] + N[1] * arms[1]) / robot.Izz
        return w[1], (N[0] + N[1]) / robot.m - robot.g, w[3], turn

    def after(w, t, h):
        a = rate(w, t)
        b = rate([x + h / 2 * y for x, y in zip(w, a)], t + h / 2)
        d = rate([x + h / 2 * y for x, y in zip(w, b)], t + h / 2)
        e = rate([x + h * y for x, y in zip(w, d)], t + h)
        return [x + h / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip(w, a, b, d, e)]

    def wrong(i, w, t):
        p, f = spring(i, w, t)
        if pressing[i]:
            return f < 0
        since, x = left[i]
        return f > 0 and p >= (x * math.exp(-k[i] / c[i] * (t - since)) if relaxes else 0.0)

    for end in ends:
        middle = (t + end) / 2
        under = [road.pieces[bisect_right(road.kinks, v * middle + arm)] for arm in arms]
        while t < end:
            step = min(dt, end - t)
            here = [i for i in (0, 1) if wrong(i, w, t)]  # a kink has just been passed
            if not here:
                new = after(w, t, step)
                if not any(wrong(i, new, t + step) for i in (0, 1)):
                    w, t = new, (end if step == end - t else t + step)
                    continue
                low, high = 0.0, step
                while high - low > 1e-13:
                    half = (low + high) / 2
                    new = after(w, t, half)
                    if any(wrong(i, new, t + half) for i in (0, 1)):
                        high = half
                    else:
                        low = half
                w, t = after(w, t, high), t + high
                here = [i for i in (0, 1) if wrong(i, w, t)]
            for i in here:
                p, f = spring(i, w, t)
                events.append((i + 1, "lift-off" if pressing[i] else "landing", t, f))
                pressing[i] = not pressing[i]
                left[i] = (t, p)
    return events, w


def compressions(robot, road, flight):
    """``h_i - Y_i``, written out (Eq. 2)."""
    h = road_input(robot, road, flight.v, flight.T)[:2]
    Y, _, theta, _ = flight.W
    return h - [Y - robot.L1 * theta, Y + robot.L2 * theta]


def energy(robot, road, flight):
    """Weight, motion and springs; p + gap compresses a spring, on the ground or off."""
    Y, V, _, omega = flight.W
    springs = (
        np.array([robot.k1, robot.k2]) @ (compressions(robot, road, flight) + flight.gaps) ** 2
    )
    return robot.m * (robot.g * Y + V**2 / 2) + (robot.Izz * omega**2 + springs) / 2


def brute_force_follows(robot, road, v, tfinal, dt):
    """Clamped forces by the midpoint rule, with no thought for where they switch."""
    k1, k2, c1, c2, L1, L2 = robot.k1, robot.k2, robot.c1, robot.c2, robot.L1, robot.L2
    J = round(tfinal / dt)
    u = road_input(robot, road, v, dt / 2 * np.arange(2 * J + 1)).T.tolist()
    Y, V, theta, omega = robot.equilibrium.tolist()
    forces = np.empty((2, J))

    def clamped(Y, V, theta, omega, h1, h2, dh1, dh2):
        p1, p2 = h1 - Y + L1 * theta, h2 - Y - L2 * theta
        N1, N2 = k1 * p1 + c1 * (dh1 - V + L1 * omega), k2 * p2 + c2 * (dh2 - V - L2 * omega)
        return (N1 if p1 >= 0 and N1 > 0 else 0.0), (N2 if p2 >= 0 and N2 > 0 else 0.0)

    for j in range(J):
        N1, N2 = forces[:, j] = clamped(Y, V, theta, omega, *u[2 * j])
        Vm = V + dt / 2 * ((N1 + N2) / robot.m - robot.g)
        omegam = omega + dt / 2 * (N2 * L2 - N1 * L1) / robot.Izz
        middle = Y + dt / 2 * V, Vm, theta + dt / 2 * omega, omegam
        N1, N2 = clamped(*middle, *u[2 * j + 1])
        Y, theta = Y + dt * Vm, theta + dt * omegam
        V += dt * ((N1 + N2) / robot.m - robot.g)
        omega += dt * (N2 * L2 - N1 * L1) / robot.Izz
    return np.array([Y, V, theta, omega]), forces


def brute_force_relaxes(robot, road, v, tfinal, dt):
    """Each step tries the free wheel and takes the ground's force only if it would sink in.

    The force follows from the motion of the wheel; neither Eq. 5 nor its sign is asked.
    """
    k, c = np.array([[robot.k1, robot.k2], [robot.c1, robot.c2]])
    (k1, k2), (c1, c2), (decay1, decay2) = k, c, np.exp(-k * dt / c)
    L1, L2 = robot.L1, robot.L2
    J = round(tfinal / dt)
    h = road_input(robot, road, v, dt * np.arange(J + 1))[:2].T.tolist()
    Y, V, theta, omega = robot.equilibrium.tolist()
    x1, x2 = h[0][0] - Y + L1 * theta, h[0][1] - Y - L2 * theta
    forces = np.empty((2, J))
    for j in range(J):
        Y, theta = Y + dt * V, theta + dt * omega
        p1, p2 = h[j + 1][0] - Y + L1 * theta, h[j + 1][1] - Y - L2 * theta
        N1 = 0.0 if x1 * decay1 >= p1 else k1 * (p1 + x1) / 2 + c1 * (p1 - x1) / dt
        N2 = 0.0 if x2 * decay2 >= p2 else k2 * (p2 + x2) / 2 + c2 * (p2 - x2) / dt
        x1, x2 = max(x1 * decay1, p1), max(x2 * decay2, p2)
        forces[:, j] = N1, N2
        V += dt * ((N1 + N2) / robot.m - robot.g)
        omega += dt * (N2 * L2 - N1 * L1) / robot.Izz
    return np.array([Y, V, theta, omega]), forces


@pytest.mark.slow
@pytest.mark.parametrize(
    "robot, v, tfinal", [(ROBOT, 1.2, 0.68), (ROBOT, 5, 0.4), (LOPSIDED, 1.2, 0.6)]
)
@pytest.mark.parametrize(
    "wheel, brute_force, state_error, time_error",
    [
        ("follows", brute_force_follows, [1e-6, 1e-5, 1e-6, 1e-4], 4e-6),
        ("relaxes", brute_force_relaxes, [1e-5, 2e-4, 2e-4, 1e-2], 3e-5),
    ],
)
def test_brute_force_at_two_microseconds(
    robot, v, tfinal, wheel, brute_force, state_error, time_error
):
    dt = 2e-6
    flight = run(robot, v, tfinal, wheel)
    w, N = brute_force(robot, BUMP, v, tfinal, dt)
    assert (np.abs(flight.W[:, -1] - w) < state_error).all()
    switches = [
        (wheel, "landing" if N[wheel - 1, j + 1] > 0 else "lift-off", j + 1)
        for wheel in (1, 2)
        for j in np.flatnonzero(np.diff(N[wheel - 1] > 0))
    ]
    switches.sort(key=lambda switch: switch[2])
    assert [(e.wheel, e.kind) for e in flight.events] == [switch[:2] for switch in switches]
    for event, (wheel, _, j) in zip(flight.events, switches, strict=True):
        assert abs(event.t - j * dt) < time_error
        # The step after the one that lands: that one shares the shock with the air before it.
        assert abs(event.force - N[wheel - 1, j + 1]) < 0.02


@pytest.mark.slow
@pytest.mark.parametrize("v", [1.2, 3, 10])
@pytest.mark.parametrize("name", KINKED)
@pytest.mark.parametrize("wheel", MODELS)
def test_a_road_with_kinks_flies_as_in_fine_steps(name, v, wheel):
    """Whether the road tells where its kinks are or not."""
    road, tfinal = KINKED[name], 0.5 / v + 0.06
    robot = LOPSIDED if v == 1.2 else ROBOT
    expected, w = located(robot, road, v, tfinal, wheel)
    for told in (road.road, road.silent()):
        flight = fly(robot, told, v=v, tfinal=tfinal, wheel=wheel, resolution=0.005)
        assert [e[:2] for e in flight.events] == [e[:2] for e in expected]
        for event, (_, kind, t, force) in zip(flight.events, expected):
            assert abs(event.t - t) < 1e-7
            assert kind == "lift-off" or abs(event.force - force) < 1e-3
        np.testing.assert_allclose(flight.W[:, -1], w, atol=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize(
    "v, switches",
    [*(pytest.param(*one, marks=pytest.mark.slow) for one in ((3, 7), (5, 6))), (10, 4)],
)
def test_a_half_sine_bump_makes_nobody_chatter(v, switches):
    road = half_sine()
    told, silent = (fly(ROBOT, r, v=v, tfinal=0.9 / v) for r in (road.road, road.silent()))
    assert len(told.events) == switches
    for event, other in zip(told.events, silent.events, strict=True):
        assert event[:2] == other[:2]
        np.testing.assert_allclose(event[2:], other[2:], atol=1e-9)
    np.testing.assert_allclose(told.W[:, -1], silent.W[:, -1], atol=1e-9)


def test_a_leg_ends_where_a_wheel_meets_a_kink_and_its_force_jumps_there():
    v, road = 0.3, KINKED["trapezoid"]
    flight = fly(LOPSIDED, road.road, v=v, tfinal=2)
    assert flight.events == ()
    slopes = np.diff([0, 0.02 / 0.03, 0, -0.02 / 0.03, 0])
    meets = [
        ((kink - arm) / v, i, c * v * slope)
        for i, arm, c in [(0, -LOPSIDED.L1, 20), (1, LOPSIDED.L2, 5)]
        for kink, slope in zip(road.kinks, slopes, strict=True)
    ]
    meets.sort()
    assert [end for _, end, _ in flight.legs[:-1]] == pytest.approx([t for t, *_ in meets])
    for (end, *_), (t, wheel, jump) in zip(pairwise(leg[1] for leg in flight.legs), meets):
        before, after = np.flatnonzero(flight.T == end)
        assert end == pytest.approx(t, abs=1e-14)
        jumps = flight.N[:, after] - flight.N[:, before]
        np.testing.assert_allclose(jumps[wheel], jump, atol=1e-9)
        np.testing.assert_allclose(jumps[1 - wheel], 0, atol=1e-9)


def test_a_kink_at_the_start_or_the_end_or_under_both_wheels_is_no_leg():
    both = polygon([0.0, ROBOT.L1 + ROBOT.L2, 0.3, 0.36], [0, 0.001, 0.001, 0])
    tfinal = 0.3 - ROBOT.L2
    flight = fly(ROBOT, both.road, v=1, tfinal=tfinal)
    ends = [end for _, end, _ in flight.legs]
    np.testing.assert_allclose(ends, [ROBOT.L1, tfinal], rtol=1e-14)
    assert [leg[:2] for leg in fly(ROBOT, both.road, v=0, tfinal=0.1).legs] == [(0, 0.1)]


@pytest.mark.slow
@settings(max_examples=10, deadline=None, derandomize=True, phases=[Phase.generate])
@given(
    points=st.lists(st.tuples(st.floats(0.002, 0.1), st.floats(0, 0.02)), min_size=2, max_size=7),
    v=st.floats(0.3, 20),
    wheel=st.sampled_from(MODELS),
    robot=st.sampled_from([ROBOT, LOPSIDED]),
)
def test_any_road_of_straight_lines_flies_told_or_not(points, v, wheel, robot):
    x, h = np.cumsum([0.2, *(x for x, _ in points)]), [0, *(h for _, h in points)]
    road = RoadProfile(x, h, "linear")
    told, silent = (
        fly(robot, r, v=v, tfinal=0.5 / v + 0.05, wheel=wheel, resolution=0.005)
        for r in (road, lambda x: road(x))
    )
    # Where a force only just touches zero the two may differ by a hop of no length.
    shared = np.linspace(0, 0.5 / v + 0.05, 2001)  # at which neither is interpolated
    W = [np.array([np.interp(shared, f.T, w) for w in f.W]) for f in (told, silent)]
    np.testing.assert_allclose(*W, atol=1e-6)
    np.testing.assert_allclose(told.airtime, silent.airtime, atol=1e-6)


@pytest.mark.slow
def test_measured_points_of_a_bump_fly_like_the_bump():
    x = np.linspace(0.1, 0.5, 201)
    flight = fly(ROBOT, RoadProfile(x, BUMP(x)[0]), v=1.2, tfinal=0.68)
    bump = run(ROBOT, 1.2, 0.68, "follows")
    assert bump.events
    for event, other in zip(flight.events, bump.events, strict=True):
        assert event[:2] == other[:2] and abs(event.t - other.t) < 3e-5


@pytest.mark.slow
def test_the_two_wheel_models_differ_by_more_than_brute_force_errs():
    follows, relaxes = (run(LOPSIDED, 1.2, 0.6, wheel) for wheel in MODELS)
    landings = [[e.t for e in f.events if e.kind == "landing"] for f in (follows, relaxes)]
    assert max(np.abs(np.subtract(*landings))) > 3e-4


@pytest.mark.slow
@pytest.mark.parametrize("wheel", MODELS)
@pytest.mark.parametrize("v", [0.25, 10])
def test_a_run_that_keeps_contact_is_simulate(wheel, v):
    tfinal = 1.25 / v
    trajectory = simulate(ROBOT, BUMP, v=v, dt=tfinal / 40_000, tfinal=tfinal)
    flight = run(ROBOT, v, tfinal, wheel)
    assert flight.events == () and not flight.airtime.any() and not flight.gaps.any()
    np.testing.assert_allclose(flight.T, trajectory.T[::20], rtol=1e-14)
    np.testing.assert_allclose(flight.W, trajectory.W[:, ::20], atol=1e-10)
    np.testing.assert_allclose(flight.N, trajectory.N[:, ::20], atol=1e-8)


@pytest.mark.parametrize("wheel", MODELS)
@pytest.mark.parametrize("v", [1.2, 5])
def test_lift_off_is_where_the_linear_robot_loses_contact(wheel, v):
    trajectory = simulate(ROBOT, BUMP, v=v, dt=1e-6, tfinal=0.3 / v)
    event = run(ROBOT, v, 0.68 if v == 1.2 else 0.4, wheel).events[0]
    assert (event.wheel, event.kind, event.force) == (trajectory.loss.wheel, "lift-off", 0)
    assert trajectory.loss.t - 1e-6 <= event.t <= trajectory.loss.t
    assert event.X == v * event.t


def test_lossless_bounces_of_a_dropped_robot_have_a_closed_form():
    robot, drop = Robot(800, 800, c1=0, c2=0), 0.02
    flight = fly(robot, FlatRoad(), v=0, tfinal=2, w0=[drop, 0, 0, 0])
    speed, frequency = np.sqrt(2 * robot.g * drop), np.sqrt(2 * 800 / robot.m)
    contact = 2 / frequency * (np.pi - np.arctan(speed * frequency / robot.g))
    period = 2 * speed / robot.g + contact
    landings = speed / robot.g + period * np.arange(20)
    expected = np.sort(np.concatenate([landings, landings + contact]))
    expected = np.repeat(expected[expected < 2], 2)  # both wheels at once
    np.testing.assert_allclose([e.t for e in flight.events], expected, atol=1e-10)
    assert [e.wheel for e in flight.events] == [1, 2] * (len(expected) // 2)
    assert flight.gaps.max() == pytest.approx(drop, abs=1e-6)
    np.testing.assert_allclose(
        flight.airtime,
        sum(end - start for start, end, pressing in flight.legs if not any(pressing)),
    )


def test_without_dampers_the_two_models_are_one():
    robot = Robot(800, 600, c1=0, c2=0)
    follows, relaxes = (fly(robot, BUMP, v=1.2, tfinal=0.7, wheel=wheel) for wheel in MODELS)
    assert follows.events == relaxes.events and len(follows.events) > 4
    np.testing.assert_array_equal(follows.W, relaxes.W)


@pytest.mark.parametrize("wheel", MODELS)
def test_landing_force_is_what_the_damper_makes_of_the_closing_speed(wheel):
    flight = run(LOPSIDED, 1.2, 0.6, wheel)
    landings = [e for e in flight.events if e.kind == "landing"]
    assert len(landings) >= 2
    for event in landings:
        c = (LOPSIDED.c1, LOPSIDED.c2)[event.wheel - 1]
        before = np.searchsorted(flight.T, event.t) + np.array([-3, -2, -1, 0])
        gap = np.polynomial.Polynomial.fit(
            flight.T[before] - event.t, flight.gaps[event.wheel - 1, before], 3
        )
        assert event.force == pytest.approx(-c * gap.deriv()(0.0), rel=1e-4)
        assert event.force > 0


@pytest.mark.slow
def test_follows_is_the_footnote_at_every_sample():
    """No switch missed, none invented: the forces are a function of the state alone."""
    for road, v in [(BUMP, 1.2), (BUMP, 5), (washboard, 2)]:
        flight = fly(ROBOT, road, v=v, tfinal=0.7, samples=20_001, resolution=0.03)
        E = normal_forces(ROBOT, road, v, flight.T, flight.W)
        expected = np.where(compressions(ROBOT, road, flight) >= 0, np.maximum(E, 0), 0)
        switches = np.array([e.t for e in flight.events])
        away = np.abs(flight.T[:, None] - switches).min(axis=1) > 1e-9
        assert away.sum() >= 20_000
        np.testing.assert_allclose(flight.N[:, away], expected[:, away], atol=1e-9)


def test_relaxing_wheels_obey_their_own_equation_at_every_sample():
    """With x = p + gap, ``k x + c x' = N``, N and gap are >= 0, and one of them is 0."""
    flight = fly(LOPSIDED, washboard, v=1.2, tfinal=0.6, wheel="relaxes", samples=20_001)
    assert len(flight.events) > 20
    assert (flight.N >= 0).all() and (flight.gaps >= 0).all()
    assert not (flight.N * flight.gaps).any()
    x = compressions(LOPSIDED, washboard, flight) + flight.gaps
    for i, (k, c) in enumerate([(LOPSIDED.k1, LOPSIDED.c1), (LOPSIDED.k2, LOPSIDED.c2)]):
        dt = np.diff(flight.T)
        mean_N = (flight.N[i, 1:] + flight.N[i, :-1]) / 2
        mean_x = (x[i, 1:] + x[i, :-1]) / 2
        np.testing.assert_allclose(c * np.diff(x[i]), dt * (mean_N - k * mean_x), atol=1e-7 * c)


@pytest.mark.slow
def test_a_dip_below_zero_that_hardly_lasts_is_found():
    """Between keeping and losing contact lies one speed, whatever the length of the steps."""
    low, high = 0.4, 0.45
    while high - low > 1e-7:
        v = (low + high) / 2
        low, high = (low, v) if fly(ROBOT, BUMP, v=v, tfinal=0.35 / v).events else (v, high)
    lift_off, landing = fly(ROBOT, BUMP, v=high, tfinal=0.35 / high).events
    assert lift_off.wheel == landing.wheel and landing.t - lift_off.t < 1e-4
    for v, sign in [(low * (1 - 1e-6), 1), (high * (1 + 1e-6), -1)]:
        N = simulate(ROBOT, BUMP, v=v, dt=1e-5, tfinal=0.35 / v).N
        assert np.sign(N.min()) == sign and abs(N.min()) < 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("wheel", MODELS)
@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED], ids=["symmetric", "lopsided"])
def test_energy_never_grows_on_flat_ground(robot, wheel):
    flight = fly(robot, FlatRoad(), v=0, tfinal=2, w0=[0.03, 0.1, 0.2, -1], wheel=wheel)
    assert len(flight.events) >= 4
    E = energy(robot, FlatRoad(), flight)
    assert np.diff(E).max() <= 1e-10 * E[0]
    assert E[-1] < 0.5 * E[0]


@pytest.mark.parametrize("wheel", MODELS)
def test_both_wheels_in_the_air_is_a_throw(wheel):
    flight = run(ROBOT, 1.2, 0.68, wheel)
    start, end = next(leg[:2] for leg in flight.legs if not any(leg[2]))
    air = (flight.T > start) & (flight.T < end)
    assert air.sum() > 20
    Y, V, theta, omega = flight.W[:, air]
    np.testing.assert_allclose(ROBOT.g * Y + V**2 / 2, ROBOT.g * Y[0] + V[0] ** 2 / 2, rtol=1e-10)
    np.testing.assert_allclose(omega, omega[0], rtol=1e-10)
    np.testing.assert_allclose(theta, theta[0] + omega[0] * (flight.T[air] - flight.T[air][0]))


@pytest.mark.parametrize("wheel", MODELS)
def test_a_mirrored_robot_that_backs_over_a_mirrored_road_flies_alike(wheel):
    r = LOPSIDED
    mirrored = Robot(r.k2, r.k1, c1=r.c2, c2=r.c1, L1=r.L2, L2=r.L1)
    flight = run(r, 1.2, 0.6, wheel)
    image = fly(mirrored, GaussianBump(centre=-0.3), v=-1.2, tfinal=0.6, wheel=wheel)
    assert len(flight.events) >= 4
    for event, other in zip(flight.events, image.events, strict=True):
        assert (event.wheel, event.kind) == (3 - other.wheel, other.kind)
        np.testing.assert_allclose(event[2:], [other.t, -other.X, other.force], atol=1e-9)
    sign = np.array([[1], [1], [-1], [-1]])
    np.testing.assert_allclose(flight.W[:, -1:], sign * image.W[:, -1:], atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("wheel", MODELS)
def test_halving_every_step_moves_no_switch(wheel):
    coarse = run(ROBOT, 1.2, 0.68, wheel)
    fine = fly(ROBOT, BUMP, v=1.2, tfinal=0.68, wheel=wheel, resolution=BUMP.sigma / 20)
    assert fine.events
    for event, other in zip(coarse.events, fine.events, strict=True):
        assert event[:2] == other[:2] and abs(event.t - other.t) < 1e-11


def test_samples_are_equally_spaced_and_every_switch_is_there_twice():
    flight = run(ROBOT, 1.2, 0.68, "follows")
    times = [e.t for e in flight.events]
    assert [leg[1] for leg in flight.legs[:-1]] == times
    assert [leg[0] for leg in flight.legs[1:]] == times
    np.testing.assert_array_equal(np.setdiff1d(flight.T, times), np.linspace(0, 0.68, 2001))
    for event in flight.events:
        before, after = np.flatnonzero(flight.T == event.t)
        np.testing.assert_array_equal(flight.W[:, before], flight.W[:, after])
        assert flight.N[event.wheel - 1, after] == pytest.approx(event.force, abs=1e-12)
        assert abs(flight.N[event.wheel - 1, before]) < 1e-9
    assert flight.W.shape == (4, len(flight.T)) and flight.N.shape == flight.gaps.shape


@pytest.mark.parametrize("wheel", MODELS)
def test_a_robot_that_starts_in_the_air_lands_first(wheel):
    flight = fly(ROBOT, FlatRoad(), v=0, tfinal=0.5, w0=[0, 0, 0.1, 0], wheel=wheel)
    assert flight.legs[0][2] == (True, False)
    assert flight.N[1, 0] == 0 and flight.gaps[1, 0] == pytest.approx(0.1 * ROBOT.L2)
    assert next(e.kind for e in flight.events if e.wheel == 2) == "landing"
    touching = fly(ROBOT, FlatRoad(), v=0, tfinal=0.1, w0=np.zeros(4), wheel=wheel)
    assert touching.events == (Event(1, "landing", 0, 0, 0), Event(2, "landing", 0, 0, 0))


@pytest.mark.parametrize("wheel", MODELS)
def test_a_wheel_that_falls_so_fast_that_its_damper_would_push_is_in_the_air_all_the_same(wheel):
    height, speed = 0.001, 1.0
    flight = fly(ROBOT, FlatRoad(), v=0, tfinal=0.01, w0=[height, -speed, 0, 0], wheel=wheel)
    lands = (np.sqrt(speed**2 + 2 * ROBOT.g * height) - speed) / ROBOT.g
    assert flight.legs[0][2] == (False, False)
    assert [e[:2] for e in flight.events] == [(1, "landing"), (2, "landing")]
    np.testing.assert_allclose([e.t for e in flight.events], lands, rtol=1e-9)


@pytest.mark.parametrize("wheel", MODELS)
def test_contact_is_lost_just_past_the_critical_speed_of_the_closed_form(wheel):
    """A tenth of a millionth of a newton below zero is told from as much above."""
    v = critical_speeds(ROBOT, BUMP, 0.3, 1)[0]
    below, above = (v * (1 + 1e-8 * sign) for sign in (-1, 1))
    if margin(ROBOT, BUMP, below) < 0:
        below, above = above, below
    assert -2e-7 < margin(ROBOT, BUMP, above) < 0
    assert fly(ROBOT, BUMP, v=below, tfinal=0.35 / v, wheel=wheel).events == ()
    events = fly(ROBOT, BUMP, v=above, tfinal=0.35 / v, wheel=wheel).events
    assert [e.kind for e in events] == ["lift-off", "landing"]
    assert 0 < events[1].t - events[0].t < 1e-4


def test_a_force_of_nothing_but_roundoff_switches_no_wheel():
    flight = fly(Robot(800, 800, g=0), GaussianBump(centre=0.9), v=1.2, tfinal=0.4)
    assert 0 < flight.N.max() < 1e-20 and flight.events == ()
    # A road like the one above, whose waves the integrator cannot tell from level ground.
    flight = fly(
        Robot(800, 800, g=0),
        lambda x: (1e-15 * np.sin(100 * x), 1e-13 * np.cos(100 * x)),
        v=1.2,
        tfinal=0.4,
        resolution=0.01,
    )
    assert flight.events == ()


@pytest.mark.parametrize("at", [0.5, 0.25, 0.03125, 0.1])
@pytest.mark.parametrize("side", [np.less, np.less_equal])
def test_a_jump_is_found_wherever_an_interval_is_halved(at, side):
    def gaps_and_forces(t):
        f = np.where(side(t, at), 1.0, -2.0)
        return np.zeros((2, *np.shape(t))), np.stack([f, np.ones_like(f)])

    t, switched = _first_switch(gaps_and_forces, np.full(2, 1e-9), np.array([True, True]), 0.0, 1.0)
    assert t == pytest.approx(at, abs=1e-15) and switched.tolist() == [True, False]
    assert gaps_and_forces(t)[1][0] < 0  # just after it


def test_a_wheel_that_starts_pulled_off_relaxes_from_where_it_stands():
    flight = fly(LOPSIDED, FlatRoad(), v=0, tfinal=0.02, w0=[-0.005, 1, 0, 0], wheel="relaxes")
    assert flight.events == () and flight.legs == ((0, 0.02, (False, False)),)
    x = np.exp(-np.outer([800 / 20, 500 / 5], flight.T)) * 0.005
    height = flight.W[0]  # theta stays 0
    assert height[-1] > 0.01
    np.testing.assert_allclose(flight.gaps, x + height, atol=1e-12)


def test_two_wheels_that_land_one_after_the_other_land_at_their_own_times():
    drop, tilt = 0.02, 1e-5
    flight = fly(ROBOT, FlatRoad(), v=0, tfinal=0.1, w0=[drop, 0, tilt, 0])
    heights = np.array([drop - tilt * ROBOT.L1, drop + tilt * ROBOT.L2])
    landings = flight.events[:2]
    assert [(e.wheel, e.kind) for e in landings] == [(1, "landing"), (2, "landing")]
    np.testing.assert_allclose([e.t for e in landings], np.sqrt(2 * heights / ROBOT.g), atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("centre", [0.3, 0.305, 0.31, 0.315])
def test_a_narrow_bump_is_not_stepped_over(centre):
    bump = GaussianBump(height=1e-4, sigma=0.001, centre=centre)
    truth = simulate(ROBOT, bump, v=10, dt=1e-6, tfinal=0.045).W[:, -1]
    assert np.abs(truth - ROBOT.equilibrium).max() > 1e-5
    for road in (bump, lambda x: bump(x)):  # the second does not tell its size
        flight = fly(ROBOT, road, v=10, tfinal=0.045)
        np.testing.assert_allclose(flight.W[:, -1], truth, atol=1e-9)


@pytest.mark.slow
def test_no_switch_is_made_of_roundoff():
    """Without weight a wheel far from the bump feels a force of 1e-200 N, and then nothing."""
    flight = fly(Robot(800, 800, g=0), GaussianBump(centre=0.9), v=1.2, tfinal=1.3)
    assert [(e.wheel, e.kind) for e in flight.events] == [
        (2, "lift-off"),
        (1, "lift-off"),
        (1, "landing"),
        (1, "lift-off"),
    ]
    hill = fly(
        ROBOT,
        lambda x: (BUMP(x)[0] + 100, BUMP(x)[1]),
        v=1.2,
        tfinal=0.68,
        w0=np.add(ROBOT.equilibrium, [100, 0, 0, 0]),
    )
    level = run(ROBOT, 1.2, 0.68, "follows")
    for event, other in zip(hill.events, level.events, strict=True):
        assert event[:2] == other[:2] and abs(event.t - other.t) < 1e-8


@pytest.mark.slow
def test_settled():
    quiet = run(ROBOT, 0.25, 5, "follows")
    t = quiet.settled(ROBOT)
    rest = ROBOT.m * ROBOT.g / 2
    after = quiet.T >= t
    assert (np.abs(quiet.N[:, after] / rest - 1) <= 0.05).all()
    assert (np.abs(quiet.N[:, np.argmax(after) - 1] / rest - 1) > 0.05).any()
    assert quiet.settled(ROBOT, fraction=0.01) > t and quiet.settled(ROBOT, fraction=2) == 0
    assert np.isnan(run(ROBOT, 1.2, 0.68, "follows").settled(ROBOT))


def test_settled_is_the_first_sample_from_which_no_force_is_away_any_more():
    rest = ROBOT.m * ROBOT.g / 2
    N = rest * np.array([[1.2, 1, 1.06, 1.04, 1, 1], [1, 1, 1, 0.96, 1, 1.04]])
    legs = ((0.0, 5.0, (True, True)),)
    flight = Flight(np.arange(6.0), np.zeros((4, 6)), N, 0 * N, (), legs, 1.0)
    assert flight.settled(ROBOT) == 3
    assert flight.settled(ROBOT, 0.07) == 1 and flight.settled(ROBOT, 0.3) == 0
    assert np.isnan(flight.settled(ROBOT, 0.03))


def test_settled_refuses_what_is_no_robot_by_name():
    flight = run(ROBOT, 5, 0.4, "follows")
    with pytest.raises(TypeError, match="^robot must be a Robot, got None"):
        flight.settled(None)
    with pytest.raises(ValueError, match="^fraction must be a finite number >= 0, got -1"):
        flight.settled(ROBOT, -1)


@pytest.mark.parametrize("wheel", MODELS)
def test_flights_and_heights_of_each_wheel(wheel):
    flight = run(ROBOT, 1.2, 0.68, wheel)
    lift_offs = [e.wheel for e in flight.events if e.kind == "lift-off"]
    assert flight.flights.tolist() == [lift_offs.count(1), lift_offs.count(2)]
    assert flight.flights.min() > 0
    np.testing.assert_array_equal(flight.highest, [max(gap) for gap in flight.gaps])
    falls = fly(ROBOT, FlatRoad(), v=0, tfinal=0.1, w0=[0.01, 0, 0.05, 0], wheel=wheel)
    np.testing.assert_allclose(falls.highest, [0.01 - 0.05 * 0.107, 0.01 + 0.05 * 0.107])
    assert falls.flights.tolist() == [1, 1]
    quiet = run(ROBOT, 0.25, 5, wheel)
    assert not quiet.flights.any() and not quiet.highest.any()


def test_a_frame_has_what_the_flight_has_with_units():
    flight = run(ROBOT, 5, 0.4, "follows")
    frame = flight.to_frame()
    assert all(re.fullmatch(r".+ \((s|m|m/s|rad|rad/s|N)\)", name) for name in frame.columns)
    values = np.vstack([flight.T, 5 * flight.T, flight.W, flight.N, flight.gaps])
    np.testing.assert_array_equal(frame.to_numpy().T, values)


@pytest.mark.slow
def test_rk4_has_its_order_from_switch_to_switch_and_not_across():
    v, tfinal = 5, 0.4
    flight = run(ROBOT, v, tfinal, "follows")
    across, located = [], []
    for J in (100, 200, 400, 800):
        W, _ = RK4(make_flight_gfunc(ROBOT, BUMP), ROBOT.equilibrium, tfinal / J, tfinal, v)
        across.append(np.linalg.norm(W[:, -1] - flight.W[:, -1]))
        w = ROBOT.equilibrium
        for start, end, pressing in flight.legs:
            dt = (end - start) / np.ceil((end - start) * J / tfinal)
            W, _ = RK4(make_flight_gfunc(ROBOT, BUMP, pressing, start), w, dt, end - start, v)
            w = W[:, -1]
        located.append(np.linalg.norm(w - flight.W[:, -1]))
    order = {
        name: -np.polyfit(range(4), np.log2(e), 1)[0]
        for name, e in [("across", across), ("located", located)]
    }
    assert order["located"] == pytest.approx(4, abs=0.2) and order["across"] < 2
    assert located[-1] < 1e-5 * across[-1]


def test_rk4_has_its_order_from_kink_to_kink():
    v, tfinal, road = 5, 0.15, half_sine().road
    flight, errors = fly(ROBOT, road, v=v, tfinal=tfinal), []
    assert len(flight.events) == 6 and len(flight.legs) > 8
    for J in (50, 100, 200):
        w = ROBOT.equilibrium
        for start, end, pressing in flight.legs:
            gfunc = make_flight_gfunc(ROBOT, road, pressing, start, end)
            dt = (end - start) / np.ceil((end - start) * J / tfinal)
            w = RK4(gfunc, w, dt, end - start, v)[0][:, -1]
        errors.append(np.linalg.norm(w - flight.W[:, -1]))
    assert np.log2(errors[0] / errors[2]) / 2 == pytest.approx(4, abs=0.4)


def test_gfunc_makes_nan_of_a_state_that_is_none():
    """An unstable run overflows: a force of zero would look like a flight."""
    for pressing in (None, (True, True)):
        wdot, *N = make_flight_gfunc(ROBOT, BUMP, pressing)(np.full(4, np.nan), 0.1, 1.2)
        assert np.isnan(N).all() and np.isnan(wdot).all()


def test_edges_lie_within_their_interval():
    assert _edges(lambda t: np.array([t - 1.2]), 0, 1) == []
    assert _edges(lambda t: np.array([t - 0.3]), 0, 1) == pytest.approx([0.3])


def test_gfunc_gives_the_forces_it_uses():
    gfunc, w = make_flight_gfunc(ROBOT, BUMP), np.array([0, 0.1, 0.05, 0])
    wdot, N1, N2 = gfunc(w, 0.1, 1.2)
    assert N1 > 0 and N2 == 0
    np.testing.assert_allclose(wdot, [0.1, N1 / ROBOT.m - ROBOT.g, 0, -N1 * ROBOT.L1 / ROBOT.Izz])
    falls = gfunc(np.array([0.001, -1, 0, 0]), 0, 0)  # the damper would push, were it on the ground
    np.testing.assert_allclose(falls[0], [-1, -ROBOT.g, 0, 0])
    pulled = gfunc(np.array([-0.001, 1, 0, 0]), 0, 0)  # on the ground, its damper pulls
    np.testing.assert_allclose(pulled[0], [1, -ROBOT.g, 0, 0])
    assert pulled[1:] == (0, 0)
    light = gfunc(np.array([-0.5 / 800, 0, 0, 0]), 0, 0)  # half a newton is a force as well
    np.testing.assert_allclose(light[1:], [0.5, 0.5])
    linear = make_flight_gfunc(ROBOT, BUMP, (True, True), start=0.04)
    u = road_input(ROBOT, BUMP, 1.2, 0.1)
    np.testing.assert_allclose(linear(w, 0.06, 1.2)[0], ROBOT.A @ w + ROBOT.B @ u + ROBOT.e)


@pytest.mark.slow
@settings(max_examples=30, deadline=None, derandomize=True)
@given(
    k=st.tuples(*[st.floats(100, 3000)] * 2),
    c=st.tuples(*[st.sampled_from([0, 1e-6, 0.1, 1.5, 30])] * 2),
    L=st.tuples(*[st.floats(0.05, 0.3)] * 2),
    m=st.floats(0.5, 10),
    radius=st.floats(0.03, 0.2),
    v=st.floats(0.1, 10),
    waves=st.lists(st.tuples(st.floats(-0.01, 0.01), st.floats(1, 60)), min_size=1, max_size=3),
    wheel=st.sampled_from(MODELS),
)
def test_any_robot_on_any_road(k, c, L, m, radius, v, waves, wheel):
    a, q = np.array(waves).T

    def road(x):
        angle = np.multiply.outer(x, q)
        return np.sin(angle) @ a, np.cos(angle) @ (a * q)

    robot = Robot(*k, c1=c[0], c2=c[1], L1=L[0], L2=L[1], m=m, Izz=m * radius**2)
    flight = fly(robot, road, v=v, tfinal=0.4, wheel=wheel, resolution=0.02)
    assert np.isfinite(flight.W).all() and flight.T[-1] == 0.4
    assert (flight.N >= 0).all() and (flight.gaps >= 0).all()
    assert not (flight.N * flight.gaps).any()
    assert (np.diff(flight.T) >= 0).all()
    for wheel in (1, 2):
        kinds = [e.kind for e in flight.events if e.wheel == wheel]
        assert all(one != next for one, next in pairwise(kinds))
    # Velocities are the integrals of the forces, whoever switched them.
    dt = np.diff(flight.T)
    gained = ((flight.N[:, 1:] + flight.N[:, :-1]) / 2 @ dt).sum() / m
    change = flight.W[1, -1] - flight.W[1, 0]
    assert change == pytest.approx(gained - robot.g * 0.4, abs=1e-3 * (gained + robot.g * 0.4))


@pytest.mark.slow
@pytest.mark.parametrize("ripple", [1e3, 3e3, 1e5])
def test_a_robot_that_chatters_is_told_when(ripple):
    def road(x):
        return 1e-3 * np.sin(ripple * x), 1e-3 * ripple * np.cos(ripple * x)

    with pytest.raises(
        RuntimeError, match=r"chatters: 100 switches just before t = \S+ s"
    ) as error:
        fly(ROBOT, road, v=10, tfinal=1)
    time = float(re.search(r"t = (\S+) s", str(error.value))[1])
    assert 0 < time < 0.1


@pytest.mark.slow
def test_a_road_of_noise_is_told_where():
    def road(x):
        return 1e-3 * np.sin(1e9 * np.sin(1e7 * x)), np.sin(1e9 * x)

    with pytest.raises(RuntimeError, match="too rough to integrate at t = "):
        fly(ROBOT, road, v=1, tfinal=1)


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("part", [0, 1])
def test_a_hole_in_a_road_is_told_where(value, part):
    def road(x):
        answer = list(BUMP(x))
        answer[part] = np.where(np.abs(x - 0.3) < 0.005, value, answer[part])
        return answer

    with pytest.raises(
        ValueError, match=rf"got {('H', 'dHdx')[part]} not finite at x = 0\.(29|30)"
    ):
        fly(ROBOT, road, v=1.2, tfinal=0.5)


@pytest.mark.parametrize("answer", [lambda x: (x[:1], x[:1]), lambda x: (0.0, 0.0), lambda x: None])
@pytest.mark.parametrize("call", [make_flight_gfunc, lambda *on: fly(*on, v=1, tfinal=0.5)])
def test_a_road_of_another_shape_is_refused(call, answer):
    with pytest.raises(ValueError, match="road must return"):
        call(ROBOT, answer)


def test_a_kerb_is_driven_over():
    def kerb(x):
        return np.where(x > 0.2, 0.01, 0.0), np.zeros_like(x)

    flight = fly(ROBOT, kerb, v=1.2, tfinal=0.5, resolution=0.05)
    up = np.flatnonzero(np.diff(flight.N[1]) > 0.9 * 0.01 * ROBOT.k2)
    assert flight.T[up[0]] == pytest.approx((0.2 - ROBOT.L2) / 1.2, abs=5e-4)


@pytest.mark.parametrize(
    "name, value, allowed",
    [
        ("v", np.nan, "a finite number"),
        ("tfinal", 0, "> 0"),
        ("tfinal", 1e9, "at most 10000 steps"),
        ("w0", [0, 0, 0], r"shape \(4\)"),
        ("w0", [0, 0, np.inf, 0], "finite"),
        ("wheel", "flies", "'follows', 'relaxes'"),
        ("resolution", -1, "> 0"),
        ("samples", 1, ">= 2"),
        ("samples", 2.5, ">= 2"),
    ],
)
def test_bad_input_is_refused_by_name(name, value, allowed):
    with pytest.raises(ValueError, match=rf"^{name} must .*{allowed}"):
        fly(ROBOT, BUMP, **({"v": 1.2, "tfinal": 1} | {name: value}))


@pytest.mark.parametrize(
    "robot, tfinal, remedy",
    [
        (
            ROBOT,
            3,
            r"resolution=0\.001: 1\.5e\+04 steps; shorten tfinal, or give resolution=, larger",
        ),
        (Robot(8e9, 8e9), 3, "shorten tfinal$"),
    ],
)
def test_too_long_a_run_is_refused_with_the_remedy(robot, tfinal, remedy):
    with pytest.raises(ValueError, match=remedy):
        fly(robot, lambda x: BUMP(x), v=10, tfinal=tfinal)


def test_a_long_run_over_a_road_that_knows_its_size_is_not_refused():
    road = RoughRoad(ISO_8608["A"], shortest=1)
    assert fly(ROBOT, road, v=10, tfinal=1.5).T[-1] == 1.5
    assert fly(ROBOT, FlatRoad(), v=100, tfinal=30).T[-1] == 30


def test_too_many_kinks_are_refused_with_the_remedy():
    road = RoadProfile(np.linspace(0, 10, 20_001), np.zeros(20_001))
    with pytest.raises(ValueError, match="at most 10000 kinks .*: 20214 kinks; shorten tfinal, or"):
        fly(ROBOT, road, v=1, tfinal=20)


@pytest.mark.parametrize("kinks", ["here", [[0.1]], [np.nan], lambda: [0.1]])
def test_kinks_that_are_none_are_refused(kinks):
    road = half_sine().silent()
    road.kinks = kinks
    with pytest.raises(ValueError, match="^road's kinks must"):
        fly(ROBOT, road, v=1, tfinal=0.1)


def test_a_road_that_returns_nan_is_refused():
    with pytest.raises(ValueError, match="road must return finite values"):
        fly(ROBOT, lambda x: (x * np.nan, x), v=1.2, tfinal=1)
