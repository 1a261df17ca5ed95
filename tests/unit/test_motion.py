"""The motion of many robots side by side: Newton's laws, case by case, and a ground that pushes."""

from dataclasses import replace

import numpy as np
import pytest
from cases import DELTA_MAX

from suspension.motion import Cases, Full, Small, step
from suspension.robot import Robot
from suspension.spring_law import SpringLaw

ROBOTS = np.array([
    Robot(800, 800),
    Robot(900, 500, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
    Robot(60e3, 55e3, m=1800, Izz=2500, L1=1.4, L2=1.2, c1=4000, c2=3500),
])  # fmt: skip
V = np.array([0.25, 1.2, 20.0])
LAW = SpringLaw([1.5, 0.0, -200.0], [11.0, 13.2, 900.0], [4.0, 0.0, 100.0], DELTA_MAX, [0, 8e3, 0])
DX = 1e-3
laws = pytest.mark.parametrize("law", [None, LAW], ids=["straight", "measured"])


def anywhere(motion, rng):
    """Compressions and their rates of every sign, in the motion's own clock, shape (2, n)."""
    scale = motion.loads / motion.k
    return scale * rng.normal(size=(2, 3)), scale * rng.normal(size=(2, 3)) * motion.time


@laws
def test_a_ground_only_pushes_and_only_on_a_compressed_spring(law):
    motion, rng, seen = Small(Cases(ROBOTS, V, law), DX), np.random.default_rng(0), set()
    for _ in range(200):
        p, r = anywhere(motion, rng)
        spring = motion.k * p if law is None else law.force(p)
        f, N = motion.forces(p, r)
        np.testing.assert_allclose(f, spring + motion.c * r, rtol=1e-12, atol=1e-12)
        pressed = (spring > 0) & (f > 0)
        np.testing.assert_array_equal(N[~pressed], 0)
        np.testing.assert_array_equal(N[pressed], f[pressed])
        seen |= {*zip((spring > 0).ravel(), (f > 0).ravel())}
    assert len(seen) == 4


@laws
def test_a_ground_that_pulls_gives_the_force_of_spring_and_damper(law):
    motion = Small(Cases(ROBOTS, V, law), DX, pulls=True)
    f, N = motion.forces(*anywhere(motion, np.random.default_rng(1)))
    assert (f < 0).any()
    np.testing.assert_array_equal(N, f)


@laws
def test_forces_of_some_cases_are_theirs(law):
    motion, rng = Small(Cases(ROBOTS, V, law), DX), np.random.default_rng(2)
    p, r = anywhere(motion, rng)
    case = np.array([2, 0, 2])
    some = motion.forces(p[:, case, None], r[:, case, None], case)
    for values, all_of_them in zip(some, motion.forces(p, r)):
        np.testing.assert_array_equal(values[..., 0], all_of_them[:, case])


@pytest.mark.parametrize("pulls", [False, True])
@pytest.mark.parametrize("kind", [Small, Full])
@laws
def test_accelerations_are_newtons(law, kind, pulls):
    motion, rng = kind(Cases(ROBOTS, V, law), DX, pulls), np.random.default_rng(3)
    y, u = motion.start + 0.1 * rng.normal(size=(2, 3)) * motion.arms[1], rng.normal(size=(2, 3))
    u *= motion.time
    H, rise = 0.1 * motion.arms[1] * rng.random((2, 3)), motion.half * rng.normal(size=(2, 3))
    a, p, r, _, N = motion.rates(y, u, H, rise)
    for n, robot in enumerate(ROBOTS):
        seconds = motion.time[n]  # of a unit of the clock
        arms = np.array([-robot.L1, robot.L2])
        if kind is Small:  # from the ends of the body to its centre
            turn = np.array([robot.L2, robot.L1]) / (robot.L1 + robot.L2)
            tilt = np.array([-1, 1]) / (robot.L1 + robot.L2)
            Y, theta, dY, dtheta = turn @ y[:, n], tilt @ y[:, n], turn @ u[:, n], tilt @ u[:, n]
            acceleration = [turn @ a[:, n], tilt @ a[:, n]]
            height, sink = arms * theta, arms * dtheta
            climb, lever = rise[:, n], arms
        else:
            (Y, theta), (dY, dtheta), acceleration = y[:, n], u[:, n], a[:, n]
            height, sink = arms * np.sin(theta), arms * np.cos(theta) * dtheta
            # The wheel is below the end of the body, which a turn moves along the road.
            along = V[n] * seconds - arms * np.sin(theta) * dtheta
            climb, lever = rise[:, n] / motion.half * along, arms * np.cos(theta)
        np.testing.assert_allclose(p[:, n], H[:, n] - Y - height, rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(r[:, n], climb - dY - sink, rtol=1e-9, atol=1e-15)
        force = N[:, n]
        expected = [force.sum() / robot.m - robot.g, lever @ force / robot.Izz]
        np.testing.assert_allclose(np.array(acceleration) / seconds**2, expected, rtol=1e-8)
    assert pulls or (N >= 0).all()


@laws
@pytest.mark.parametrize("kind", [Small, Full])
def test_it_starts_at_rest(law, kind):
    motion = kind(Cases(ROBOTS, V, law), DX)
    nothing = np.zeros((2, 3))
    a, _, _, _, N = motion.rates(motion.start, nothing, nothing, nothing)
    assert np.abs(a / motion.time**2).max() < 1e-10
    for robot, force in zip(ROBOTS, N.T):
        load = robot.m * robot.g / (robot.L1 + robot.L2)
        np.testing.assert_allclose(force, [load * robot.L2, load * robot.L1], rtol=1e-12)
    if law is None:
        rest = [robot.equilibrium[2] for robot in ROBOTS]
        np.testing.assert_allclose(np.tan(motion.pitch(motion.start)), np.tan(rest), atol=1e-3)


def undamped(robot, k1, k2):
    """Angular frequency of the fastest swing without dampers, 1/s."""
    return np.abs(np.linalg.eigvals(replace(robot, k1=k1, k2=k2, c1=0, c2=0).A).imag).max()


def test_swings_and_decays_are_those_of_the_fastest_modes():
    cases = Cases(ROBOTS, V, None)
    swings = [undamped(robot, robot.k1, robot.k2) / (2 * np.pi) for robot in ROBOTS]
    np.testing.assert_allclose(cases.swings(), swings)
    decays = [undamped(robot, robot.c1, robot.c2) ** 2 for robot in ROBOTS]
    np.testing.assert_allclose(cases.decays(), decays)
    steep = [(max(11, 19) / DELTA_MAX), 13.2 / DELTA_MAX + 8e3, 1100 / DELTA_MAX]
    swings = [undamped(robot, k, k) / (2 * np.pi) for robot, k in zip(ROBOTS, steep)]
    np.testing.assert_allclose(Cases(ROBOTS, V, LAW).swings(), swings)


def test_a_step_is_of_order_four():
    def rate(y, u, place):
        return -(y**3) - 0.3 * u + np.sin(place)

    def ends(n):
        h = 2.0 / n  # units of the clock are half a step: rates scale with h / 2
        y, u = np.ones((2, 1)), np.zeros((2, 1))
        half = h / 2

        def scaled(y, u, place):
            return half**2 * rate(y, u / half, half * place)

        for j in range(n):
            y, u = step(scaled, y, u, scaled(y, u, 2 * j), 2 * j)
        return np.array([y[0, 0], u[0, 0] / half])

    fine = ends(2048)
    errors = [np.abs(ends(n) - fine).max() for n in (16, 32, 64)]
    np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 4, atol=0.3)
