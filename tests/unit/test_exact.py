"""Closed forms, held against solvers that know nothing of them."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import integrate, linalg

from suspension import exact
from suspension.exact import Crossing, bump_memory, flat_ground, over_bump
from suspension.road import FlatRoad, GaussianBump, road_input
from suspension.robot import Robot

BUMP = GaussianBump()
K, M, L = 800.0, 1.456, 0.107
HEAVE = np.sqrt(2 * K * M)  # damping at which the heave mode is critical
PITCH = np.sqrt(2 * K * 0.012) / L  # and the pitch mode
W0 = np.array([0.01, -0.3, 0.05, 2.0])

ROBOTS = {
    "of the problem": Robot(K, K),
    "undamped": Robot(K, K, c1=0, c2=0),
    "unsymmetric": Robot(500, 1100, L1=0.09, L2=0.13, c1=1, c2=4),
    "damped behind only": Robot(K, 300, c1=6, c2=0),
    "overdamped": Robot(K, K, c1=100, c2=100),
    "heave critical": Robot(K, K, c1=HEAVE, c2=HEAVE),
    "pitch critical": Robot(K, K, c1=PITCH, c2=PITCH),
    "one part in a billion from critical": Robot(K, K, c1=HEAVE * (1 + 1e-9), c2=HEAVE),
    "one in a thousand from critical": Robot(K, K, c1=HEAVE, c2=HEAVE * (1 - 1e-3)),
    "four equal eigenvalues": Robot(K, K, c1=HEAVE, c2=HEAVE, Izz=M * L**2),
    "four nearly equal eigenvalues": Robot(K, K * (1 + 1e-6), c1=HEAVE, c2=HEAVE, Izz=M * L**2),
    "one wheel critical, one undamped": Robot(K, K, c1=HEAVE, c2=0, Izz=M * L**2),
    "two equal frequencies, undamped": Robot(K, K, c1=0, c2=0, Izz=M * L**2),
    "two equal frequencies, damped": Robot(K, K, c1=1, c2=2, Izz=M * L**2),
}
CONFLUENT = [name for name in ROBOTS if "critical" in name or "four" in name]

any_robot = pytest.mark.parametrize("robot", ROBOTS.values(), ids=ROBOTS)
quick = settings(derandomize=True, deadline=None, max_examples=60)


def dop853(robots, bump, v, t, w0=None):
    """States of all robots at times t by SciPy's DOP853, each a run's end: no interpolation."""
    A, B, e = (np.array([getattr(robot, name) for robot in robots]) for name in "ABe")
    lengths = [(robot.L1, robot.L2) for robot in robots]
    tracks = [robots[lengths.index(pair)] for pair in sorted(set(lengths))]
    track = [sorted(set(lengths)).index(pair) for pair in lengths]

    def rate(s, w):
        u = np.array([road_input(robot, bump, v, s) for robot in tracks])[track]
        return (A @ w.reshape(-1, 4, 1) + B @ u[:, :, None])[:, :, 0].ravel() + e.ravel()

    w = np.ravel([robot.equilibrium if w0 is None else w0 for robot in robots])
    W, at_most = [w], bump.sigma / max(abs(v), 0.1)  # or the bump is stepped over
    for span in pairwise(t):
        run = integrate.solve_ivp(
            rate, span, W[-1], method="DOP853", rtol=1e-13, atol=1e-15, max_step=at_most
        )
        W.append(run.y[:, -1])
    return np.transpose(W).reshape(len(robots), 4, -1)


def quadrature(robot, bump, v, tfinal, w0=None):
    """Variation of constants, panel by panel: matrix exponentials and Gauss-Legendre nodes."""
    fastest = max(np.abs(robot.eigenvalues).max(), 2 * abs(v) / bump.sigma, 5 / tfinal)
    J = int(np.ceil(fastest * tfinal))
    dt = tfinal / J
    x, weight = np.polynomial.legendre.leggauss(24)
    s = (x + 1) / 2 * dt
    kernel = linalg.expm((dt - s)[:, None, None] * robot.A) @ robot.B
    t = dt * np.arange(J + 1)
    u = road_input(robot, bump, v, np.add.outer(t[:-1], s).ravel()).reshape(4, J, -1)
    forcing = np.einsum("qab,bjq->ja", kernel, u * (weight * dt / 2))
    step, y = linalg.expm(dt * robot.A), np.zeros((J + 1, 4))
    y[0] = 0 if w0 is None else w0 - robot.equilibrium
    for j in range(J):
        y[j + 1] = step @ y[j] + forcing[j]
    return t, (y + robot.equilibrium).T


# --- flat ground ------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("c", [0.0, 1.5, PITCH, HEAVE, HEAVE * (1 + 1e-9), HEAVE * 0.9999, 100.0])
@pytest.mark.parametrize("Izz", [0.012, M * L**2, 0.3])
def test_flat_ground_is_the_matrix_exponential(c, Izz):
    robot, t = Robot(K, K, c1=c, c2=c, Izz=Izz), np.linspace(0, 2, 41)
    y0 = W0 - robot.equilibrium
    expected = np.transpose([linalg.expm(robot.A * s) @ y0 + robot.equilibrium for s in t])
    np.testing.assert_allclose(flat_ground(robot, W0, t), expected, rtol=0, atol=2e-12)


def test_flat_ground_of_one_time_is_one_state():
    robot = Robot(K, K)
    assert flat_ground(robot, W0, 0.5).shape == (4,)
    np.testing.assert_array_equal(flat_ground(robot, W0, 0.5), flat_ground(robot, W0, [0.5])[:, 0])
    np.testing.assert_allclose(flat_ground(robot, W0, 0), W0, rtol=1e-15)


@pytest.mark.parametrize("change", [{"k2": 801}, {"c1": 1.4}, {"L1": 0.1}])
def test_flat_ground_refuses_an_unsymmetric_robot(change):
    with pytest.raises(ValueError, match="robot must be symmetric"):
        flat_ground(replace(Robot(K, K), **change), W0, 1.0)


# --- the bump ---------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("v", [0.1, 0.25, 0.6, 1.2, 2.5, 5, 10, 30, 100])
def test_every_robot_at_every_speed_agrees_with_dop853(v):
    start, t = None if v < 1 else W0, np.array([0, 0.15, 0.2, 0.3, 0.45, 0.7]) / v
    expected = dop853(list(ROBOTS.values()), BUMP, v, t, start)
    for (name, robot), W in zip(ROBOTS.items(), expected, strict=True):
        error = np.abs(over_bump(robot, BUMP, v, t, start) - W).max()
        assert error < 1e-11, f"{name}: {error:.1e}"


@pytest.mark.slow
@pytest.mark.parametrize("v", [0.01, -0.01, 1e-6])
def test_a_crawl_that_starts_on_the_bump_agrees_with_dop853(v):
    bump, t = replace(BUMP, centre=0.12 if v > 0 else -0.12), np.array([0.0, 0.5, 3.0])
    expected = dop853(list(ROBOTS.values()), bump, v, t)
    for (name, robot), W in zip(ROBOTS.items(), expected, strict=True):
        error = np.abs(over_bump(robot, bump, v, t) - W).max()
        assert error < 1e-11, f"{name}: {error:.1e}"


@any_robot
@pytest.mark.parametrize("v", [0.02, 0.4, 1.5, 8, 100])
def test_every_robot_agrees_with_quadrature_to_roundoff(robot, v):
    t, expected = quadrature(robot, BUMP, v, min(1.25 / v, 20))
    keep = np.linspace(0, len(t) - 1, 500).astype(int)
    np.testing.assert_allclose(
        over_bump(robot, BUMP, v, t[keep]), expected[:, keep], rtol=0, atol=1e-12
    )


@pytest.mark.parametrize("critical", [HEAVE, PITCH])
@pytest.mark.parametrize("off", [0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1])
def test_no_digit_is_lost_on_the_way_to_critical_damping(critical, off):
    for c1, c2 in [(1 + off, 1 + off), (1 - off, 1 - off), (1 + off, 1 - off)]:
        robot = Robot(K, K, c1=critical * c1, c2=critical * c2)
        t, expected = quadrature(robot, BUMP, 1.2, 1.0, W0)
        error = np.abs(over_bump(robot, BUMP, 1.2, t, W0) - expected).max()
        assert error < 1e-12


@any_robot
def test_the_mean_over_complex_stiffnesses_is_the_sum_over_modes(robot, monkeypatch):
    t = np.linspace(0, 2, 200)
    plain = Crossing(robot, BUMP, 1.2, W0)
    monkeypatch.setattr(exact, "ILL_CONDITIONED", 0.0)
    monkeypatch.setattr(exact, "modes", exact.modes.__wrapped__)  # not the ones just computed
    mean = Crossing(robot, BUMP, 1.2, W0)
    assert len(mean.lam) == 16
    np.testing.assert_allclose(mean(t), plain(t), rtol=0, atol=5e-11)


def test_only_confluent_modes_are_averaged():
    averaged = [name for name, robot in ROBOTS.items() if len(Crossing(robot, BUMP, 1).lam) == 16]
    assert averaged == CONFLUENT


def test_eigenvectors_that_coincide_in_every_bit_are_averaged_too():
    robot = Robot(2, 2, m=1, Izz=1, L1=1, L2=1, c1=2, c2=2)  # twice (lam + 2)^2 = 0, no roundoff
    t, expected = quadrature(robot, BUMP, 1, 3, W0)
    np.testing.assert_allclose(over_bump(robot, BUMP, 1, t, W0), expected, rtol=0, atol=1e-12)
    assert exact._condition(np.ones((4, 4))) == np.inf


@any_robot
def test_standing_still_is_a_constant_road(robot):
    bump, t = replace(BUMP, centre=0.1), np.array([0.0, 0.03, 0.4, 2.0])
    rest = robot.equilibrium - np.linalg.solve(robot.A, robot.B @ road_input(robot, bump, 0, 0))
    expected = [rest + linalg.expm(robot.A * s) @ (W0 - rest) for s in t]
    for v in (0, 1e-300, 1e-13):
        np.testing.assert_allclose(
            over_bump(robot, bump, v, t, W0), np.transpose(expected), rtol=0, atol=1e-11
        )


@any_robot
def test_driving_backwards_is_the_mirror_image(robot):
    mirror = replace(
        robot, k1=robot.k2, k2=robot.k1, c1=robot.c2, c2=robot.c1, L1=robot.L2, L2=robot.L1
    )
    there, flip = replace(BUMP, centre=-0.3), np.array([1, 1, -1, -1])
    t = np.linspace(0, 1.2, 100)
    np.testing.assert_allclose(
        over_bump(robot, there, -1.0, t, W0),
        flip[:, None] * over_bump(mirror, BUMP, 1.0, t, flip * W0),
        rtol=0,
        atol=2e-12,
    )


@pytest.mark.parametrize("road", ["no height", "far ahead", "far behind"])
def test_without_a_bump_the_ground_is_flat(road):
    bump = {
        "no height": replace(BUMP, height=0),
        "far ahead": replace(BUMP, centre=1e3),
        "far behind": replace(BUMP, centre=-1e3),
    }[road]
    robot, t = Robot(K, K), np.linspace(0, 2, 50)
    np.testing.assert_allclose(
        over_bump(robot, bump, 3, t, W0), flat_ground(robot, W0, t), rtol=0, atol=1e-13
    )


def test_at_rest_before_the_bump_and_long_after_it():
    robot = Robot(K, K)
    np.testing.assert_allclose(over_bump(robot, BUMP, 1, 0), robot.equilibrium, rtol=0, atol=1e-12)
    np.testing.assert_allclose(over_bump(robot, BUMP, 1, 50), robot.equilibrium, rtol=0, atol=1e-13)


def test_one_time_is_one_state():
    W = over_bump(Robot(K, K), BUMP, 1.2, 0.25)
    assert W.shape == (4,)
    np.testing.assert_allclose(W, over_bump(Robot(K, K), BUMP, 1.2, [0, 0.25])[:, 1], rtol=1e-14)
    assert over_bump(Robot(K, K), BUMP, 1.2, []).shape == (4, 0)


def test_the_road_under_the_wheels_is_the_road_and_its_derivatives():
    robot, t, step = ROBOTS["unsymmetric"], np.linspace(0, 0.4, 60), 1e-6
    crossing = Crossing(robot, replace(BUMP, centre=-0.3), -2.0)
    h, before, after = (crossing.road(s, 3) for s in (t, t - step, t + step))
    u = road_input(robot, crossing.bump, -2.0, t)
    np.testing.assert_allclose(np.concatenate(h[:2]), u, rtol=1e-12, atol=1e-15)
    for n in (0, 1, 2):
        slope = (after[n] - before[n]) / (2 * step)
        np.testing.assert_allclose(h[n + 1], slope, rtol=0, atol=1e-7 * np.abs(slope).max())


# --- the memory function ----------------------------------------------------------------------


@pytest.mark.parametrize("kappa", [0, -0.3 + 2j, -4 + 0.1j, -3, 5j, -1 + 9j])
def test_E_is_an_integral_over_the_past(kappa):
    for u in (-6.5, -2.0, -0.4, 0.0, 0.3, 1.7, 5.0):
        expected, _ = integrate.quad(
            lambda s, u=u: np.exp(kappa * (u - s) - s * s),
            -9,
            u,
            complex_func=True,
            epsabs=1e-14,
            epsrel=1e-13,
            limit=500,
        )
        assert abs(bump_memory(u, kappa) - 2 / np.sqrt(np.pi) * expected) < 1e-13


@quick
@given(u=st.floats(-1e3, 1e3), damping=st.floats(0, 1e8), swing=st.floats(-1e8, 1e8))
def test_E_is_bounded_for_every_damped_mode(u, damping, swing):
    assert abs(bump_memory(u, complex(-damping, swing))) <= 2 * (1 + 1e-12)


# --- properties of the solution ---------------------------------------------------------------


def near(centre, spread):
    return st.floats(centre / spread, centre * spread)


damping = st.one_of(st.just(0.0), near(3, 30), st.sampled_from([HEAVE, PITCH]))
robots = st.builds(
    Robot,
    k1=near(K, 4),
    k2=near(K, 4),
    c1=damping,
    c2=damping,
    m=near(M, 3),
    Izz=near(0.012, 4),
    L1=near(L, 2),
    L2=near(L, 2),
)
bumps = st.builds(
    GaussianBump, height=st.floats(-0.05, 0.05), sigma=near(0.03, 4), centre=st.floats(-0.3, 0.6)
)
speeds = near(1.0, 50)
states = st.tuples(*[st.floats(-a, a) for a in (0.02, 0.5, 0.1, 3.0)]).map(np.array)


@quick
@given(robot=robots, bump=bumps, v=speeds, w0=states, s=st.floats(0, 1))
def test_a_stop_on_the_way_changes_nothing(robot, bump, v, w0, s):
    t = np.linspace(0, 1.25 / v, 30)
    first = s * t[-1]
    middle = over_bump(robot, bump, v, first, w0)
    rest = over_bump(robot, replace(bump, centre=bump.centre - v * first), v, t, middle)
    whole = over_bump(robot, bump, v, first + t, w0)
    np.testing.assert_allclose(rest, whole, rtol=0, atol=3e-11 * np.abs(whole).max())


@quick
@given(robot=robots, bump=bumps, v=speeds, w0=states, a=st.floats(-3, 3))
def test_heights_and_starts_superpose(robot, bump, v, w0, a):
    t, rest = np.linspace(0, 1.25 / v, 30), robot.equilibrium
    whole = over_bump(robot, replace(bump, height=a * bump.height), v, t, rest + a * (w0 - rest))
    part = over_bump(robot, bump, v, t, w0) - rest[:, None]
    assert np.isfinite(whole).all()
    scale = np.abs(whole).max() + np.abs(part).max()
    np.testing.assert_allclose(whole - rest[:, None], a * part, rtol=0, atol=1e-12 * scale)


@pytest.mark.slow
@settings(quick, max_examples=40)
@given(robot=robots, bump=bumps, v=near(3, 10), w0=states)
def test_any_robot_agrees_with_quadrature(robot, bump, v, w0):
    t, expected = quadrature(robot, bump, v, 1.25 / v, w0)
    error = np.abs(over_bump(robot, bump, v, t, w0) - expected).max()
    assert error < 1e-11 * np.abs(expected).max()


# --- refusals ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bump": FlatRoad()}, "bump must be a GaussianBump, got FlatRoad"),
        ({"v": np.nan}, "v must be a finite number, got nan"),
        ({"t": -0.1}, r"t must be >= 0, got -0\.1"),
        ({"t": [0, np.inf]}, "t must be finite everywhere, got inf"),
        ({"w0": [0, 0, 0]}, r"w0 must have shape \(4\), got \(3,\)"),
        ({"w0": [0, np.nan, 0, 0]}, "w0 must be finite everywhere, got nan"),
    ],
)
def test_what_cannot_be_is_refused(change, message):
    arguments = {"robot": Robot(K, K), "bump": BUMP, "v": 1.0, "t": [0.0, 1.0]}
    with pytest.raises((ValueError, TypeError), match=message):
        over_bump(**arguments | change)
