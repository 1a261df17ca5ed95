"""The robot as a filter: its transfer functions, and the scatter on a rough road."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import signal

from suspension.frequency import response, rms, spectral_rms, speed_in_step, steady_start
from suspension.road import ISO_8608, RoughRoad
from suspension.robot import Robot
from suspension.schemes import Scheme
from suspension.simulation import simulate

ROBOTS = {
    "symmetric": Robot(800, 800),
    "unsymmetric": Robot(900, 500, c1=1, c2=3, L1=0.09, L2=0.12),
    "overdamped": Robot(300, 400, c1=60, c2=40),
}
ROAD = RoughRoad(ISO_8608["B"], length=5, shortest=0.2, seed=3)
root = np.sqrt(3) / 6
GAUSS = Scheme(
    "Gauss-Legendre",
    4,
    a=[[1 / 4, 1 / 4 - root], [1 / 4 + root, 1 / 4]],
    b=[1 / 2, 1 / 2],
    c=[1 / 2 - root, 1 / 2 + root],
)
each_robot = pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
each_speed = pytest.mark.parametrize("v", [0.5, 3, -2])


@each_robot
def test_transfer_functions_are_those_of_scipy(robot):
    v, n = 1.7, np.array([0.01, 0.5, 3, 40])
    omega = 2 * np.pi * v * n
    e = np.exp(2j * np.pi * np.outer(robot.arms, n))
    u = np.concatenate([e, 1j * omega * e])
    state, force = np.zeros((4, 4), complex), np.zeros((2, 4), complex)
    for j in range(4):
        C, D = np.vstack([np.eye(4), robot.C]), np.vstack([np.zeros((4, 4)), robot.D])
        top, bottom = signal.ss2tf(robot.A, robot.B, C, D, input=j)
        G = np.array([signal.freqs(row, bottom, omega)[1] for row in top])
        state += G[:4] * u[j]
        force += G[4:] * u[j]
    G = response(robot, v, n)
    np.testing.assert_allclose(G.state, state, rtol=0, atol=1e-11 * np.abs(state).max())
    np.testing.assert_allclose(G.force, force, rtol=0, atol=1e-11 * np.abs(force).max())


@each_robot
def test_the_outputs_belong_together(robot):
    v, n = 2.3, np.geomspace(0.1, 30, 40)
    G = response(robot, v, n)
    iw = 2j * np.pi * v * n
    np.testing.assert_allclose(G.state[1], iw * G.state[0], rtol=1e-9)
    np.testing.assert_allclose(G.acceleration, G.force.sum(axis=0) / robot.m, rtol=1e-7)
    by_parts = robot.k[:, None] * G.compression + robot.c[:, None] * iw * G.compression
    np.testing.assert_allclose(G.force, by_parts, rtol=1e-8)


def test_the_wheelbase_is_a_comb():
    robot = ROBOTS["symmetric"]
    base = robot.L1 + robot.L2
    for v in (0.3, 4):
        heave, _, pitch, _ = np.abs(response(robot, v, [1 / (2 * base), 1 / base]).state)
        assert heave[0] < 1e-12 < heave[1] and pitch[1] < 1e-11 < pitch[0]


@each_robot
def test_the_body_follows_long_waves_and_stays_over_short_ones(robot):
    G = response(robot, 1.0, [1e-5, 1e4])
    assert abs(G.state[0, 0] - 1) < 1e-4 and abs(G.state[0, 1]) < 1e-2
    np.testing.assert_allclose(np.abs(G.compression[:, 1]), 1, rtol=1e-2)


def test_an_undamped_robot_has_no_answer_at_its_own_frequency():
    robot = Robot(800, 800, c1=0, c2=0, m=2, Izz=0.02)
    omega = np.sqrt(2 * robot.k1 / robot.m)
    assert np.abs(response(robot, 1, [0.99 * omega / (2 * np.pi)]).state[0]) > 10
    with pytest.raises(ValueError, match="undamped"):
        response(replace(robot, k1=8, k2=8, m=4, L1=1, L2=1, Izz=4), 1 / (2 * np.pi), [2.0])


@pytest.mark.parametrize("robot", [Robot(800, 800), Robot(900, 500, L1=0.09, L2=0.12)])
@pytest.mark.parametrize("v", [0.3, 1.2, -7])
def test_nor_within_roundoff_of_it(robot, v):
    robot = replace(robot, c1=0, c2=0)
    for omega in np.unique(np.abs(robot.eigenvalues.imag).round(9)):
        (exact,) = {abs(x.imag) for x in robot.eigenvalues if abs(x.imag - omega) < 1e-8}
        n = exact / (2 * np.pi * v)
        for beside in (n, n * (1 + 1e-15), n * (1 - 1e-13)):
            with pytest.raises(ValueError, match="^v and wavenumber .* undamped modes, got v="):
                response(robot, v, [1.0, beside])
        assert np.isfinite(response(robot, v, [n * (1 + 1e-9)]).state).all()
        band = 1.01 / abs(n), 0.99 / abs(n)
        with pytest.raises(ValueError, match="^robot must have damping, or longest and shortest"):
            spectral_rms(robot, v, 1e-5, *band)
        damped = replace(robot, c1=1e-3, c2=1e-3)
        assert spectral_rms(damped, v, 1e-5, *band).force.max() > 1


def test_an_undamped_robot_has_a_spread_off_its_own_frequencies():
    robot = Robot(800, 800, c1=0, c2=0)
    nearly = replace(robot, c1=1e-9, c2=1e-9)
    found, expected = (spectral_rms(x, 1.2, 1e-5, 0.15, 0.1) for x in (robot, nearly))
    np.testing.assert_allclose(found.force, expected.force, rtol=1e-6)


@pytest.mark.parametrize("c", [5e-3, 0.05, 1.5, 200])
def test_the_integral_holds_however_sharp_the_resonance(c):
    robot, v, band = Robot(800, 700, c1=c, c2=2 * c), 1.2, (0.3, 0.15)
    # Steps of less than half the sharpest resonance, for which a trapezoidal rule is exact.
    x, step = np.linspace(*-np.log(band), 20001, retstep=True)
    n = np.exp(x)
    density = np.abs(response(robot, v, n).force[0]) ** 2 * 1e-5 * (0.1 / n) ** 2 * n
    exact = step * (density.sum() - density[[0, -1]].sum() / 2)
    for points in (2, 200, 20000):
        found = spectral_rms(robot, v, 1e-5, *band, points=points).force[0]
        assert found == pytest.approx(np.sqrt(exact), rel=1e-7)


@pytest.mark.parametrize(
    "function, arguments, names",
    [
        (response, (1e308, [1]), "v and wavenumber"),
        (response, (1, [1e300]), "v and wavenumber"),
        (spectral_rms, (1, 1e-5, 1e300, 1e-300), "longest|wavenumber"),
        (spectral_rms, (1, 1e308, 20, 0.1), "roughness"),
        (rms, (RoughRoad(1e305), 1), "road"),
        (rms, (ROAD, 1e200), "v"),
    ],
)
def test_an_overflow_is_refused_by_name_and_without_a_warning(function, arguments, names):
    with pytest.raises(ValueError, match=names):
        function(ROBOTS["symmetric"], *arguments)


@each_robot
@each_speed
def test_a_ride_from_the_steady_start_is_periodic(robot, v):
    w0, T = steady_start(robot, ROAD, v), ROAD.length / abs(v)
    run = simulate(robot, ROAD, v=v, dt=T / 2000, tfinal=T, scheme=GAUSS, w0=w0)
    scale = np.abs(run.W - robot.equilibrium[:, None]).max()
    np.testing.assert_allclose(run.W[:, -1], w0, rtol=0, atol=2e-5 * scale)


@each_robot
@each_speed
def test_root_mean_squares_are_those_of_a_ride(robot, v):
    T, found = ROAD.length / abs(v), rms(robot, ROAD, v)
    w0 = steady_start(robot, ROAD, v)
    run = simulate(robot, ROAD, v=v, dt=T / 2000, tfinal=T, scheme=GAUSS, w0=w0)
    N, W = run.N[:, :-1], run.W[:, :-1]
    x = np.outer([1, 1], v * run.T[:-1]) + robot.arms[:, None]
    compression = ROAD(x)[0] - W[0] - robot.arms[:, None] * W[2]
    np.testing.assert_allclose(N.std(axis=1), found.force, rtol=1e-4)
    np.testing.assert_allclose(compression.std(axis=1), found.compression, rtol=1e-4)
    np.testing.assert_allclose(W[2].std(), found.pitch, rtol=1e-4)
    np.testing.assert_allclose((N.sum(axis=0) / robot.m).std(), found.acceleration, rtol=1e-4)


def test_many_waves_come_near_the_integral():
    robot, v = ROBOTS["unsymmetric"], 4
    apart = []
    for length in (5, 20, 80):
        road = RoughRoad(1e-5, length=length, shortest=0.2)
        one, all_of_them = rms(robot, road, v), spectral_rms(robot, v, 1e-5, length, 0.2)
        apart.append(abs(one.force[0] / all_of_them.force[0] - 1))
    assert apart[2] < 0.01 < apart[0]


def test_white_slopes_make_an_acceleration_that_grows_with_the_shortest_wave():
    robot, v, Gd = ROBOTS["symmetric"], 10, 1e-5
    parts = [spectral_rms(robot, v, Gd, 10, short).acceleration ** 2 for short in (1e-2, 1e-3)]
    slope = 8 * (np.pi * robot.c1 * v / robot.m) ** 2 * Gd * 0.01
    np.testing.assert_allclose(parts[1] - parts[0], slope * (1e3 - 1e2), rtol=0.01)


def test_roughness_scales_everything():
    one, four = (rms(ROBOTS["symmetric"], replace(ROAD, roughness=r), 2) for r in (1e-5, 4e-5))
    np.testing.assert_allclose(four.force, 2 * one.force)
    np.testing.assert_allclose(four.pitch, 2 * one.pitch)


def test_at_the_speed_in_step_the_wheels_are_one_heave_period_apart():
    robot = Robot(800, 800, c1=0, c2=0)
    period = 2 * np.pi / np.sqrt(2 * robot.k1 / robot.m)
    assert speed_in_step(robot) == pytest.approx((robot.L1 + robot.L2) / period)
    assert speed_in_step(replace(robot, Izz=0.1)) == pytest.approx(speed_in_step(robot))
    assert speed_in_step(ROBOTS["overdamped"]) is None
    with pytest.raises(TypeError, match="robot"):
        speed_in_step(800)
