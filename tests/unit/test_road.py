"""Roads: heights, slopes, and what reaches the wheels."""

import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension.road import (
    ISO_8608,
    FlatRoad,
    GaussianBump,
    RoadProfile,
    RoughRoad,
    road_input,
)
from suspension.robot import Robot

ROBOT = Robot(800, 600, L1=0.107, L2=0.09)
BUMP = GaussianBump()
ROUGH = RoughRoad(ISO_8608["C"], length=4, shortest=0.1, seed=7)
X = np.array([-0.3, 0.1, 0.25, 0.3, 0.5])
HEIGHTS = np.array([0.01, 0.02, 0.02, -0.005, 0.0])
CURVES, LINES = RoadProfile(X, HEIGHTS), RoadProfile(X, HEIGHTS, "linear")
PROFILES = st.lists(
    st.tuples(st.floats(0.01, 1), st.floats(-0.1, 0.1)), min_size=2, max_size=8
).map(lambda points: RoadProfile(np.cumsum([x for x, _ in points]), [h for _, h in points]))
BUMPS = st.builds(
    GaussianBump, height=st.floats(-0.1, 0.1), sigma=st.floats(0.01, 1), centre=st.floats(-2, 2)
)


def central_difference(f, x, h):
    return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h)


def test_bump_is_the_problems_hgauss():
    x = np.linspace(-1, 2, 301)
    H = 0.0254 * np.exp(-((x - 0.3) ** 2) / (2 * 0.0288**2))
    np.testing.assert_allclose(BUMP(x)[0], H, rtol=1e-12, atol=1e-300)
    np.testing.assert_allclose(BUMP(x)[1], -(x - 0.3) / 0.0288**2 * H, rtol=1e-12, atol=1e-300)


@settings(derandomize=True, deadline=None, max_examples=50)
@given(bump=BUMPS)
def test_slope_is_the_derivative_of_height(bump):
    x = bump.centre + bump.sigma * np.linspace(-6, 6, 49)
    slope = central_difference(lambda x: bump(x)[0], x, 1e-3 * bump.sigma)
    scale = abs(bump.height) / bump.sigma
    np.testing.assert_allclose(bump(x)[1], slope, rtol=0, atol=1e-10 * scale)


@pytest.mark.parametrize(
    "road",
    [BUMP, FlatRoad(), ROUGH, CURVES, LINES],
    ids=["bump", "flat", "rough", "curves", "lines"],
)
@pytest.mark.parametrize("x", [0.3, np.zeros(0), np.ones(5), np.ones((2, 3)), [0, 1]])
def test_road_returns_the_shape_it_is_given(road, x):
    H, dHdx = road(x)
    assert np.shape(H) == np.shape(dHdx) == np.shape(x)


def test_flat_road_is_level_and_far_from_the_bump_all_roads_are():
    x = np.array([-1e6, -10.0, 10.0, 1e6])
    assert not np.any(FlatRoad()(x)) and not np.any(BUMP(x))


def test_input_is_what_equations_1_to_4_say():
    v, t = 1.2, np.linspace(0, 0.6, 25)
    h1, h2, rate1, rate2 = road_input(ROBOT, BUMP, v, t)
    np.testing.assert_array_equal(h1, BUMP(v * t - ROBOT.L1)[0])
    np.testing.assert_array_equal(h2, BUMP(v * t + ROBOT.L2)[0])
    for i, rate in ((0, rate1), (1, rate2)):
        slope = central_difference(lambda t, i=i: road_input(ROBOT, BUMP, v, t)[i], t, 1e-5)
        np.testing.assert_allclose(rate, slope, rtol=0, atol=1e-9)


def test_rear_wheel_feels_what_the_front_wheel_felt_a_wheelbase_earlier():
    v, t = 0.7, np.linspace(0, 1, 101)
    u, earlier = (road_input(ROBOT, BUMP, v, s) for s in (t, t - (ROBOT.L1 + ROBOT.L2) / v))
    np.testing.assert_allclose(u[[0, 2]], earlier[[1, 3]], rtol=1e-11, atol=1e-15)


def test_input_at_one_time_has_shape_four():
    assert road_input(ROBOT, BUMP, 1, 0.3).shape == (4,)


@pytest.mark.parametrize(
    "road, why",
    [
        (lambda x: (np.where(x > 0.5, np.nan, 0), x), r"H not finite at x = 0\.59 m"),
        (lambda x: (x, np.where(x > 0.5, np.inf, 0)), r"dHdx not finite at x = 0\.59 m"),
        (lambda x: None, "two arrays, H and dHdx, got None"),
        (lambda x: (x,), "two arrays"),
        (lambda x: (0.0, 0.0), r"H of the shape of x, \(6,\), got \(\)"),
        (lambda x: (x, x[:-1]), r"dHdx of the shape of x, \(6,\), got \(5,\)"),
    ],
)
def test_road_that_returns_nonsense_is_refused_with_the_place(road, why):
    with pytest.raises(ValueError, match=f"^road must return .*{why}"):
        road_input(ROBOT, road, 1, [0, 0.25, 0.5])


def test_road_with_complex_heights_is_refused():
    with pytest.raises(ValueError, match="road"):
        road_input(ROBOT, lambda x: (x + 0.1j, x), 1, [0, 0.25, 0.5])


@pytest.mark.parametrize(
    "name, value",
    [
        ("height", np.nan),
        ("height", np.inf),
        ("sigma", 0),
        ("sigma", -0.1),
        ("sigma", np.nan),
        ("centre", np.inf),
        ("centre", None),
    ],
)
def test_bump_that_cannot_be_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=f"^{name} must be .*, got {value!r}$"):
        GaussianBump(**{name: value})


def test_slope_of_a_rough_road_is_the_derivative_of_its_height():
    x = np.linspace(-3, 9, 331)
    slope = central_difference(lambda x: ROUGH(x)[0], x, 1e-3)
    np.testing.assert_allclose(ROUGH(x)[1], slope, rtol=0, atol=1e-5 * np.abs(slope).max())


def test_a_rough_road_repeats_itself_and_another_seed_is_another_road():
    x = np.linspace(0, 4, 101)
    np.testing.assert_allclose(ROUGH(x + 4)[0], ROUGH(x)[0], atol=1e-13)
    same, other = (RoughRoad(ISO_8608["C"], 4, 0.1, seed)(x)[0] for seed in (7, 8))
    np.testing.assert_array_equal(same, ROUGH(x)[0])
    assert np.corrcoef(same, other)[0, 1] < 0.9


def test_a_rough_road_has_the_spectrum_of_its_class():
    """The periodogram of its samples, over one period, is the density of ISO 8608."""
    J = 256
    H = ROUGH(np.arange(J) * ROUGH.length / J)[0]
    periodogram = 2 * np.abs(np.fft.rfft(H)) ** 2 * ROUGH.length / J**2
    n = np.fft.rfftfreq(J, ROUGH.length / J)
    inside = (n > 0) & (n <= 10 + 1e-9)
    density = 256e-6 * (n[inside] / 0.1) ** -2.0
    np.testing.assert_allclose(periodogram[inside], density, rtol=1e-9)
    assert periodogram[~inside].max() < 1e-20 and inside.sum() == 40


def test_classes_of_roughness_are_those_of_the_standard():
    assert list(ISO_8608) == list("ABCDEFGH")
    expected = [16, 64, 256, 1024, 4096, 16384, 65536, 262144]
    np.testing.assert_allclose(list(ISO_8608.values()), np.array(expected) * 1e-6)


def test_a_long_table_of_a_rough_road_is_computed_in_parts():
    x = np.linspace(0, 4, 60001)
    np.testing.assert_allclose(ROUGH(x)[0][::5000], ROUGH(x[::5000])[0], atol=1e-15)


@pytest.mark.parametrize("road", [CURVES, LINES])
def test_a_profile_goes_through_its_points_and_is_level_beyond(road):
    np.testing.assert_allclose(road(X)[0], HEIGHTS, rtol=0, atol=1e-17)
    H, dHdx = road([-np.inf, -1, X[0] - 1e-9, X[-1], X[-1] + 1e-9, 7, np.inf])
    np.testing.assert_array_equal(H, [0.01] * 3 + [0.0] * 4)
    assert not dHdx.any()


def test_lines_are_straight_between_their_points():
    x = np.linspace(-0.6, 0.8, 1001)
    H, dHdx = LINES(x)
    np.testing.assert_allclose(H, np.interp(x, X, HEIGHTS), atol=1e-16)
    slopes = np.diff(HEIGHTS) / np.diff(X)
    middles = (X[1:] + X[:-1]) / 2
    np.testing.assert_allclose(LINES(middles)[1], slopes)
    assert set(dHdx.round(9)) == {0.0, *slopes.round(9)}
    np.testing.assert_allclose(LINES(X)[1], [*slopes, 0])  # at a point the piece after it


@settings(derandomize=True, deadline=None, max_examples=50)
@given(road=PROFILES)
def test_curves_have_a_slope_without_jumps_and_keep_between_their_points(road):
    x, near = road.x, 1e-9 * np.diff(road.x).min()
    steepest = np.abs(np.diff(road.h) / np.diff(x)).max()
    np.testing.assert_allclose(road(x - near)[1], road(x + near)[1], atol=1e-6 * (1 + steepest))
    assert np.abs(road(x[[0, -1]])[1]).max() == 0
    for i in range(len(x) - 1):
        s = np.linspace(x[i], x[i + 1], 101)
        H, dHdx = road(s)
        low, high = np.sort(road.h[i : i + 2])
        assert low - 1e-15 <= H.min() and H.max() <= high + 1e-15
        slope = central_difference(lambda s: road(s)[0], s[3:-3], 1e-3 * (x[i + 1] - x[i]))
        np.testing.assert_allclose(dHdx[3:-3], slope, atol=1e-9 * (1 + steepest))


def test_samples_of_a_smooth_road_give_that_road_as_they_become_many():
    s = np.linspace(0, 0.6, 2001)
    errors = {"pchip": [], "linear": []}
    for kind, error in errors.items():
        for n in (31, 61, 121):
            x = np.linspace(0, 0.6, n)
            H = RoadProfile(x, BUMP(x)[0], kind)(s)[0]
            error.append(np.abs(H - BUMP(s)[0]).max())
    rates = {kind: np.log2(error[0] / error[2]) / 2 for kind, error in errors.items()}
    assert rates["pchip"] > 1.9 and rates["linear"] == pytest.approx(2, abs=0.2)
    assert errors["pchip"][2] < errors["linear"][2] / 3


def test_a_profile_tells_where_its_pieces_meet_and_keeps_its_points():
    x, h = X.copy(), HEIGHTS.copy()
    road = RoadProfile(x, h)
    x[0] = h[0] = 9
    np.testing.assert_array_equal(road.kinks, X)
    np.testing.assert_array_equal(road.h, HEIGHTS)
    assert road == CURVES == pickle.loads(pickle.dumps(CURVES)) != LINES
    assert hash(road) == hash(CURVES) != hash(LINES)
    assert road != RoadProfile(X, 2 * HEIGHTS) and road != RoadProfile(2 * X, HEIGHTS)
    with pytest.raises(ValueError, match="read-only"):
        road.x[0] = 1


@pytest.mark.parametrize(
    "x, h, kind, why",
    [
        ([0], [0], "pchip", "^x must have two points at least, got 1"),
        ([0, 1, 2], [0, 1], "pchip", "^h must have a height for each x, 3, got 2"),
        (
            [0, 2, 1],
            [0, 0, 0],
            "pchip",
            r"^x must increase .* x\[2\] = 1 m after x\[1\] = 2 m: sort",
        ),
        (
            [0, 1, 1],
            [0, 0, 1],
            "linear",
            r"^x must increase .* x\[2\] = 1 m .*: keep one point for",
        ),
        ([0, 1], [0, np.nan], "pchip", "^h must be finite"),
        ([0, np.inf], [0, 0], "pchip", "^x must be finite"),
        ([-1e308, 1e308], [0, 0], "pchip", r"^x must span less than 1e\+09 m, got inf m"),
        ([0, 1e-9], [0, 1], "pchip", r"^h must have slopes below 1e\+06, got 1e\+09 at x = 0 m"),
        ([[0, 1]], [[0, 1]], "pchip", r"^x must have shape \(n\)"),
        ([0, 1], [0, 1], "spline", "^kind must be one of 'pchip', 'linear', got 'spline'"),
    ],
)
def test_a_profile_that_cannot_be_is_refused_by_name(x, h, kind, why):
    with pytest.raises(ValueError, match=why):
        RoadProfile(x, h, kind)


def test_roads_tell_their_smallest_feature():
    assert BUMP.resolution == BUMP.sigma
    assert CURVES.resolution == pytest.approx(0.8)
    assert ROUGH.resolution == pytest.approx(0.1 / 8)
    assert FlatRoad().resolution > 1e6
