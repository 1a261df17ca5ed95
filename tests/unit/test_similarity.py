"""One chart for every robot: exact where it says so, and its limits reached as derived."""

from dataclasses import replace

import numpy as np
import pytest
from helpers import near

from suspension.contact import margin, regimes
from suspension.exact import over_bump
from suspension.least_force import minima
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.similarity import (
    Groups,
    Window,
    closing,
    closing_limit,
    comb,
    follow,
    groups,
    highest_bump,
    natural_units,
    skim,
    still,
    throw,
    way,
    window,
    window_limit,
)

ROBOT, BUMP = Robot(793, 793), GaussianBump()
OTHERS = [(0.72, 3.7), (1.0, 6.0), (1.6, 3.0)]  # j and lam


def random_robots(n, symmetric=False):
    """Robots and bumps of all sizes, ten orders of magnitude, with a speed and a distance."""
    rng = np.random.default_rng(19)
    for _ in range(n):
        m, length, omega = 10 ** rng.uniform(-3, 3, 3)
        k = m * omega**2 / 2 * (1 if symmetric else 10 ** rng.uniform(-0.4, 0.4, 2))
        L = length * (1 if symmetric else rng.uniform(0.5, 1.5, 2))
        c = 2 ** rng.uniform(-6, 1) * m * omega * (1 if symmetric else rng.uniform(0.3, 2, 2))
        (k1, k2), (L1, L2), (c1, c2) = (np.broadcast_to(x, 2) for x in (k, L, c))
        Izz = rng.uniform(0.4, 2) * m * L1 * L2
        g = 10 ** rng.uniform(-1, 1)
        robot = Robot(k1, k2, g=g, m=m, Izz=Izz, L1=L1, L2=L2, c1=c1, c2=c2)
        sigma = length * 10 ** rng.uniform(-1.5, 0.3)
        bump = GaussianBump(1.0, sigma, L2 + rng.uniform(5, 9) * sigma)
        v = sigma * omega * 10 ** rng.uniform(-1.3, 2)
        yield robot, bump, v, way(robot, bump, v, rng.uniform(0.2, 5))


def exact(nu, zeta, j, lam, swings=8):
    """The chart: highest bumps over the sag, of the robot of these groups."""
    robot, bump, _ = natural_units(Groups(1, zeta, 1, j, lam))
    return highest_bump(robot, bump, nu, distance=way(robot, bump, nu, swings))


# --- the groups -------------------------------------------------------------------------------


def test_groups_are_the_same_in_all_units():
    """Multiply the units of mass, length and time: gravity too is then another number."""
    kg, metre, second = 3.0, 0.2, 0.5
    scaled = Robot(
        *(793 * kg / second**2,) * 2,
        g=9.81 * metre / second**2,
        m=ROBOT.m * kg,
        Izz=ROBOT.Izz * kg * metre**2,
        **dict.fromkeys(("L1", "L2"), ROBOT.L1 * metre),
        **dict.fromkeys(("c1", "c2"), ROBOT.c1 * kg / second),
    )
    bump = GaussianBump(BUMP.height * metre, BUMP.sigma * metre, BUMP.centre * metre)
    near(groups(scaled, bump, 5 * metre / second), groups(ROBOT, BUMP, 5), 1e-14)


def test_natural_units_have_the_groups_they_were_made_of():
    G = Groups(0.7, 0.2, 3.0, 0.8, 4.0)
    near(groups(*natural_units(G)), G, 1e-14)
    robot, bump, v = natural_units(G)
    assert (robot.m, robot.g, bump.sigma, v) == (1, 1, 1, 0.7)
    near(robot.equilibrium[0], -1, 1e-15)
    assert np.isclose(robot.eigenvalues, -0.2 + 1j * np.sqrt(1 - 0.2**2)).any()  # the heave


@pytest.mark.parametrize("seed", range(6))
def test_two_robots_of_equal_groups_are_one(seed):
    """The margin over the load, and the highest bump over the sag: equal to 1e-8."""
    (robot, bump, v, length), *_ = list(random_robots(seed + 1, symmetric=True))[seed:]
    bump = replace(bump, height=robot.m * robot.g / robot.k1)
    other, its_bump, nu = natural_units(groups(robot, bump, v))
    its_bump = replace(its_bump, centre=bump.centre / bump.sigma)
    its_length = length / bump.sigma
    load, its_load = robot.m * robot.g / 2, 0.5
    near(
        margin(robot, bump, v, distance=length) / load,
        margin(other, its_bump, nu, distance=its_length) / its_load,
        1e-8,
    )
    sag = robot.m * robot.g / (2 * robot.k1)
    height = highest_bump(robot, bump, v, distance=length) / sag
    near(height, highest_bump(other, its_bump, nu, distance=its_length), 1e-8)


# --- the highest bump -------------------------------------------------------------------------


@pytest.mark.slow
def test_the_margin_vanishes_at_the_highest_bump():
    for robot, bump, v, length in random_robots(200):
        height = highest_bump(robot, bump, v, distance=length)
        loads = robot.C @ robot.equilibrium
        left = margin(robot, replace(bump, height=height), v, distance=length)
        assert abs(left) < 1e-6 * loads.min(), (robot, bump, v)


@pytest.mark.parametrize("v", [0.25, 1.2, 5, 10, 25])
def test_a_lower_bump_is_crossed_with_contact_and_a_higher_one_is_not(v):
    height = highest_bump(ROBOT, BUMP, v)
    for part, sign in ((0.999, 1), (1.001, -1)):
        assert np.sign(margin(ROBOT, replace(BUMP, height=part * height), v)) == sign


@pytest.mark.parametrize("v", [0.25, 1.2, 5, 10])
def test_heights_superpose(v):
    """The margin of a symmetric robot falls along a straight line, from its load, to any depth."""
    load, height = ROBOT.m * ROBOT.g / 2, highest_bump(ROBOT, BUMP, v)
    for part in (0, 0.3, 2, 50):
        left = margin(ROBOT, replace(BUMP, height=part * height), v)
        assert abs(left / load - (1 - part)) < 1e-9 * (1 + part)


def test_every_wheel_has_its_own_load():
    """A robot whose weight stands on the front: both of its wheels are asked."""
    robot = Robot(700, 900, L1=0.19, L2=0.03)
    for v in (0.3, 1.0, 4.0):
        height = highest_bump(robot, BUMP, v)
        by_hand = []
        loads = robot.C @ robot.equilibrium
        for load, low, high in zip(
            loads,
            minima(robot, replace(BUMP, height=1e-4), v),
            minima(robot, replace(BUMP, height=2e-4), v),
            strict=True,
        ):
            slope = (high.force - low.force) / 1e-4 if low.force < load else 0.0
            by_hand.append(load / -slope if slope < 0 else np.inf)
        near(height, min(by_hand), 1e-6)


@pytest.fixture(scope="module")
def chart():
    """The chart of the problem's robot, which no height of the bump changes: speeds, heights."""
    v = np.geomspace(0.1, 30, 150)
    return v, highest_bump(ROBOT, BUMP, v)


others = [pytest.param(height, marks=pytest.mark.slow) for height in (0.001, 0.0056, 0.045, 0.2)]


@pytest.mark.parametrize("height", [0.0254, *others])
def test_regimes_of_any_height_are_the_chart_cut_at_that_height(height, chart):
    v, highest = chart
    bump = replace(BUMP, height=height)
    found = regimes(ROBOT, bump, 0.1, 30)
    np.testing.assert_array_equal(found(v), highest <= height)
    at_the_edges = highest_bump(ROBOT, bump, found.critical)
    np.testing.assert_allclose(at_the_edges, height, rtol=1e-8)


def test_only_width_and_place_of_the_bump_count():
    for height in (-0.3, 0.0, 7.0):
        bump = replace(BUMP, height=height)
        assert highest_bump(ROBOT, bump, 1.2) == highest_bump(ROBOT, BUMP, 1.2)


def test_shapes_are_kept_and_distances_broadcast():
    v = np.array([[0.3, 1.2, 5.0]])
    lengths = np.array([[0.9], [1.25]])
    table = highest_bump(ROBOT, BUMP, v, distance=lengths)
    assert table.shape == (2, 3)
    np.testing.assert_array_equal(table[1], highest_bump(ROBOT, BUMP, v)[0])
    assert table[0, 1] == highest_bump(ROBOT, BUMP, 1.2, distance=0.9)
    assert np.ndim(highest_bump(ROBOT, BUMP, 1.2)) == 0
    assert highest_bump(ROBOT, BUMP, []).shape == (0,)


def test_no_height_lifts_a_wheel_while_both_climb():
    robot = replace(ROBOT, Izz=0.7 * ROBOT.m * ROBOT.L1**2)
    front_on_the_slope = BUMP.centre - robot.L2 - 1.5 * BUMP.sigma
    assert highest_bump(robot, BUMP, 1.2, distance=front_on_the_slope) == np.inf
    assert highest_bump(robot, BUMP, 1.2, distance=[front_on_the_slope, 1.25])[1] < 0.1


def test_without_weight_no_bump_is_crossed():
    assert highest_bump(replace(ROBOT, g=0), BUMP, 1.2) == 0


def test_moving_the_start_along_changes_nothing():
    far = replace(BUMP, centre=BUMP.centre + 2)
    v = np.array([0.5, 2, 9])
    near(highest_bump(ROBOT, far, v, distance=3.25), highest_bump(ROBOT, BUMP, v), 1e-9)


@pytest.mark.parametrize("distance", [0, -1, np.nan, [1, 2, 3], "far"])
def test_a_distance_that_is_none_is_refused(distance):
    with pytest.raises(ValueError, match="distance"):
        highest_bump(ROBOT, BUMP, [1.0, 2.0], distance=distance)


def test_without_a_distance_the_whole_bump_must_lie_in_the_problems_course():
    with pytest.raises(ValueError, match="distance must be given"):
        highest_bump(ROBOT, replace(BUMP, centre=1.2), 1.2)
    assert highest_bump(ROBOT, replace(BUMP, centre=1.2), 1.2, distance=3) > 0


def test_too_many_samples_are_refused_before_they_are_taken():
    with pytest.raises(ValueError, match="samples"):
        highest_bump(ROBOT, BUMP, np.full(10**5, 0.05))


# --- the limits, each at its own end ----------------------------------------------------------


@pytest.mark.parametrize("j, lam", OTHERS)
@pytest.mark.parametrize("zeta", [0, 0.05, 0.4])
def test_follow_is_too_high_by_a_part_that_falls_like_the_square_of_the_speed(j, lam, zeta):
    nu = np.array([0.08, 0.04, 0.02])
    off = (follow(nu, j) / exact(nu, zeta, j, lam, 2) - 1) / nu**2
    rate = 3 * (1 + j**2) / (1 + j)
    assert (np.abs(off - rate)[1:] < 0.5 * np.abs(off - rate)[:-1]).all()
    near(off[-1], rate, 0.01)


@pytest.mark.parametrize("j, lam", [OTHERS[0], OTHERS[2]])
def test_throw_is_too_high_by_a_part_that_falls_like_the_speed(j, lam):
    """After so many swings heave and pitch have once unloaded a wheel together."""
    nu = np.array([200.0, 800.0])
    off = (throw(nu) / exact(nu, 0, j, lam, 40) - 1) * nu
    near(off[-1], lam / j, 0.05)


@pytest.mark.parametrize("lam", [2.0, 6.0, 40.0])
def test_with_half_the_mass_on_each_wheel_the_wheelbase_does_not_count(lam):
    nu = np.array([0.3, 2.0, 10.0, 40.0])
    near(exact(nu, 0.1, 1, lam), exact(nu, 0.1, 1, 3.0), 1e-9)
    fast = np.array([10.0, 40.0])
    off = (throw(fast) / exact(fast, 0, 1, lam) - 1) * fast**2
    near(off, [-0.5, -0.5], 0.01)


def test_damping_raises_the_throw_by_half_a_pi_of_itself():
    zeta = np.array([0.004, 0.002])
    nu = 25.0
    raised = [exact(nu, z, 1, 3.0) / exact(nu, 0, 1, 3.0) - 1 for z in zeta]
    near(raised / zeta, [np.pi / 2] * 2, 0.05)


@pytest.mark.parametrize("j, lam", OTHERS)
@pytest.mark.parametrize("zeta", [0.03, 0.3, 1.5])
def test_skim_is_off_by_a_part_that_falls_like_the_speed(j, lam, zeta):
    nu = np.array([1e3, 1e4]) / min(zeta, 1)
    off = (skim(nu, zeta) / exact(nu, zeta, j, lam, 0.01) - 1) * nu
    near(off[-1], -1 / (2 * zeta) + (1 + 1 / j) * zeta, 0.01)


def test_still_is_the_least_force_under_a_body_that_does_not_move():
    s = np.linspace(0, 9, 900001)
    for nu, zeta in ((3, 0.1), (40, 0.3), (2, 2.0)):
        least = (np.exp(-(s**2) / 2) * (1 - 2 * zeta * nu * s)).min()
        near(still(nu, zeta), -1 / least, 1e-9)


def test_still_becomes_skim_and_is_nearer_to_the_truth():
    nu, zeta, j, lam = np.array([25.0, 50.0, 100.0]), 0.1, 0.72, 3.7
    true = exact(nu, zeta, j, lam)
    assert (np.abs(still(nu, zeta) / true - 1) < 0.3 * np.abs(skim(nu, zeta) / true - 1)).all()
    near(still(1e6, 1), skim(1e6, 1), 1e-6)


def test_still_is_out_of_reach_where_the_damper_does_nothing():
    assert still(1e-3, 1e-3) == np.inf
    assert np.isfinite(still(np.geomspace(0.2, 1e9, 50), 0.1)).all()


@pytest.mark.parametrize("j, lam", OTHERS)
@pytest.mark.parametrize("nu", [0.9, 2.0, 5.0, 13.0])
def test_the_comb_is_what_the_free_swing_of_an_undamped_robot_can_take(j, lam, nu):
    """Against the amplitudes that the closed form leaves behind the bump."""
    robot, bump, v = natural_units(Groups(nu, 0, 1, j, lam))
    y, dy, phi, dphi = over_bump(robot, bump, v, (2 * lam + 20) / v) - robot.equilibrium
    heave, pitch = np.hypot(y, dy), np.hypot(phi, np.sqrt(j) * dphi) * lam
    near(1 / (heave + pitch), comb(nu, j, lam), 1e-9)


@pytest.mark.parametrize("nu", [1.5, 4.0, 11.0])
def test_after_a_long_look_the_comb_is_exact(nu):
    j, lam = 0.72, 3.7
    true, ideal = exact(nu, 0, j, lam, 60), comb(nu, j, lam)
    assert ideal * (1 - 1e-9) < true < 1.01 * ideal
    assert exact(nu, 0, j, lam, 0.3) > true


# --- the window -------------------------------------------------------------------------------


def test_the_limits_of_the_window_meet_and_undo_each_other():
    for zeta in (1e-5, 0.01, 0.1, 1, 30):
        nu, eta = window_limit(zeta)
        near([still(nu, zeta), throw(nu)], [eta, eta], 1e-9)
        near(closing_limit(eta), zeta, 1e-9)


@pytest.mark.slow
def test_the_limit_of_the_window_is_nearer_the_less_damping():
    j, lam = 0.72, 3.7
    off = []
    for zeta in (0.08, 0.02, 0.005):
        robot, bump, _ = natural_units(Groups(1, zeta, 1, j, lam))
        nu, eta = window_limit(zeta)
        top = window(robot, bump, 1, 3 * nu, distance=lambda v, r=robot, b=bump: way(r, b, v, 20))
        off.append(eta / top.height - 1)
    assert off[0] > off[1] > off[2] > 0
    assert off[2] < 0.1


def test_the_window_is_the_highest_bump_beyond_the_first_loss():
    top = window(ROBOT, BUMP, 0.1, 30)
    everywhere, close_by = np.geomspace(1, 30, 250), top.v * np.linspace(0.98, 1.02, 101)
    heights = highest_bump(ROBOT, BUMP, np.concatenate([everywhere, close_by]))
    assert heights.max() <= top.height * (1 + 1e-9)
    near(top.height, heights.max(), 1e-3)
    near(highest_bump(ROBOT, BUMP, top.v), top.height, 1e-12)


@pytest.mark.parametrize(
    "height, opened",
    [pytest.param(0.01, True, marks=pytest.mark.slow), (0.048, True), (0.051, False)],
)
def test_the_window_is_open_where_regimes_go_from_lost_to_kept(height, opened):
    bump = replace(BUMP, height=height)
    found = regimes(ROBOT, bump, 1.5, 30)
    top = window(ROBOT, bump, 1.5, 30)
    assert (top.height > height) == opened
    assert (found.lost[:-1] & ~found.lost[1:]).any() == opened


def test_there_is_no_window_without_a_loss_nor_with_strong_dampers():
    assert window(ROBOT, replace(BUMP, height=1e-4), 0.1, 10) is None
    assert window(replace(ROBOT, c1=25, c2=25), BUMP, 0.2, 30) is None


def test_without_damping_the_window_is_open_to_the_end():
    free = replace(ROBOT, c1=0, c2=0)
    top = window(free, BUMP, 0.2, 60)
    assert top.v == pytest.approx(60)
    assert isinstance(top, Window)


@pytest.mark.slow
def test_the_window_closes_where_the_regimes_say_so():
    zeta = closing(ROBOT, BUMP, 0.1, 30)
    for part, kept in ((0.99, 2), (1.01, 1)):
        c = part * zeta * np.sqrt(2 * ROBOT.k1 * ROBOT.m)
        found = regimes(replace(ROBOT, c1=c, c2=c), BUMP, 0.1, 30)
        assert np.sum(~found.lost) == kept


def test_a_bump_without_a_window_at_any_damping_is_refused():
    with pytest.raises(ValueError, match="bump must be"):
        closing(ROBOT, replace(BUMP, height=1e-4), 0.3, 3)
