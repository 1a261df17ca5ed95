"""The fit and its intervals: certified results, and a count of how often they are right."""

import pickle
import re
import runpy
import warnings
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import statsmodels.api as sm
from cases import loading_and_unloading
from helpers import ROOT
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from suspension import springs
from suspension.springs import fit_spring

X = np.linspace(0, 1, 21)
GENERATOR = Path(__file__).parents[2] / "data" / "make_spring_data.py"
LOAD = 1.456 * 9.81 / 2  # half of the robot's weight, N


def spring_data(force, x=X):
    return pd.DataFrame({"delta_over_delta_max": x, "force": force})


def noisy(seed=1, beta=(0, 13.2, 0), sigma=0.12):
    noise = np.random.default_rng(seed).normal(0, sigma, X.size)
    return spring_data(np.polynomial.Polynomial(beta)(X) + noise)


# --- the fit ----------------------------------------------------------------------------------


@settings(derandomize=True, deadline=None, max_examples=30)
@given(beta=st.tuples(*[st.floats(-100, 100)] * 3), delta_max=st.floats(1e-3, 1))
def test_data_on_a_parabola_give_its_coefficients_and_the_stiffness(beta, delta_max):
    fit = fit_spring(spring_data(np.polynomial.Polynomial(beta)(X)), delta_max)
    size = np.abs(beta).max()
    np.testing.assert_allclose(fit.beta, beta, rtol=0, atol=1e-12 * size)
    assert fit.stiffness == pytest.approx(beta[1] / delta_max, abs=1e-12 * size / delta_max)


def test_fit_is_the_minimum_of_the_sum_of_squares():
    data = noisy(beta=(0.1, 13.2, 0.4))
    fit = fit_spring(data)
    residual = data["force"] - np.polynomial.Polynomial(fit.beta)(X)
    np.testing.assert_allclose(np.vander(X, 3).T @ residual, 0, atol=1e-12)


# Data and certified values: NIST Statistical Reference Datasets, linear least squares,
# https://www.itl.nist.gov/div898/strd/lls/data/Pontius.shtml and Longley.shtml
PONTIUS = """
    .11019 .21956 .32949 .43899 .54803 .65694 .76562 .87487 .98292 1.09146
    1.20001 1.30822 1.41599 1.52399 1.63194 1.73947 1.84646 1.95392 2.06128 2.16844
    .11052 .22018 .32939 .43886 .54798 .65739 .76596 .87474 .98300 1.09150
    1.20004 1.30818 1.41613 1.52408 1.63159 1.73965 1.84696 1.95445 2.06177 2.16829
"""


def test_pontius_certified_by_nist_to_nine_digits():
    load = np.tile(150_000.0 * np.arange(1, 21), 2)
    fit = fit_spring(spring_data(np.array(PONTIUS.split(), dtype=float), load), delta_max=1)
    beta = [0.673565789473684e-03, 0.732059160401003e-06, -0.316081871345029e-14]
    deviation = [0.107938612033077e-03, 0.157817399981659e-09, 0.486652849992036e-16]
    np.testing.assert_allclose(fit.beta, beta, rtol=1e-9)
    assert fit.stiffness == pytest.approx(beta[1], rel=1e-9)
    np.testing.assert_allclose(fit.errors, deviation, rtol=1e-9)
    half = np.ptp(fit.intervals(0.95, "individual"), axis=1) / 2
    np.testing.assert_allclose(half, stats.t.ppf(0.975, 37) * np.array(deviation), rtol=1e-7)
    assert fit.scatter == pytest.approx(0.205177424076185e-03, rel=1e-9)
    assert fit.results.rsquared == pytest.approx(0.999999900178537, rel=1e-13)


def test_longley_certified_by_nist_to_nine_digits():
    data = sm.datasets.longley.load_pandas()
    results = springs.least_squares(data.endog, sm.add_constant(data.exog))
    beta = [-3482258.63459582, 15.0618722713733, -0.358191792925910e-01, -2.02022980381683,
            -1.03322686717359, -0.511041056535807e-01, 1829.15146461355]  # fmt: skip
    deviation = [890420.383607373, 84.9149257747669, 0.334910077722432e-01, 0.488399681651699,
                 0.214274163161675, 0.226073200069370, 455.478499142212]  # fmt: skip
    np.testing.assert_allclose(results.params, beta, rtol=1e-9)
    np.testing.assert_allclose(results.bse, deviation, rtol=1e-9)
    assert np.sqrt(results.mse_resid) == pytest.approx(304.854073561965, rel=1e-9)
    assert results.rsquared == pytest.approx(0.995479004577296, rel=1e-13)
    assert results.fvalue == pytest.approx(330.285339234588, rel=1e-9)


# --- intervals --------------------------------------------------------------------------------


def test_intervals_lie_around_the_estimates_in_standard_errors():
    fit = fit_spring(noisy())
    for method in ("scheffe", "bonferroni", "individual"):
        for p in (1, 2, 3):
            low, high = fit.intervals(0.9, method, p).T
            np.testing.assert_allclose((low + high) / 2, fit.beta, atol=1e-13)
            half = fit.width(0.9, method, p) * fit.errors
            np.testing.assert_allclose((high - low) / 2, half, rtol=1e-12)
    np.testing.assert_array_equal(fit.intervals(), fit.intervals(0.95, "scheffe", 3))
    alone = fit.intervals(0.9, "individual")[1] / fit.delta_max
    np.testing.assert_allclose(fit.stiffness_interval(0.9), alone, rtol=1e-15)


@pytest.mark.parametrize("level", [0.5, 0.95, 0.999])
def test_for_one_coefficient_all_methods_are_the_same_and_for_more_they_are_wider(level):
    fit = fit_spring(noisy())
    alone = fit.width(level, "individual")
    assert alone == pytest.approx(stats.t.ppf((1 + level) / 2, 18), rel=1e-12)
    for method in ("scheffe", "bonferroni"):
        widths = [fit.width(level, method, p) for p in (1, 2, 3)]
        assert widths[0] == pytest.approx(alone, rel=1e-9)
        assert widths == sorted(widths)
    for p in (2, 3):
        assert alone == fit.width(level, "individual", p) < fit.width(level, "scheffe", p)


def test_intervals_cover_the_truth_as_often_as_they_say():
    # 20,000 experiments like ours, each fitted; deviations in units of the estimated sigma.
    rng, m, repeats = np.random.default_rng(2086), X.size, 20_000
    design = np.vander(X, 3, increasing=True)
    truth = np.array([0.0, 13.2, 0.0])
    force = design @ truth[:, None] + rng.normal(0, 0.12, (m, repeats))
    beta, rss, *_ = np.linalg.lstsq(design, force)
    sigma = np.sqrt(rss / (m - 3))
    fit = fit_spring(spring_data(force[:, 0]))
    np.testing.assert_allclose(fit.beta, beta[:, 0], atol=1e-12)
    se = np.sqrt(np.diag(np.linalg.inv(design.T @ design)))
    np.testing.assert_allclose(fit.errors, se * sigma[0], rtol=1e-10)

    off = (beta - truth[:, None]) / sigma
    tolerance = 4 * np.sqrt(0.05 * 0.95 / repeats)  # four standard deviations of the count

    def in_ellipsoid(chosen):
        V = np.linalg.inv(design.T @ design)[np.ix_(chosen, chosen)]
        distance = np.einsum("in,ij,jn->n", off[chosen], np.linalg.inv(V), off[chosen])
        return np.mean(np.sqrt(distance) <= fit.width(0.95, "scheffe", len(chosen)))

    def in_box(chosen, method):
        s = fit.width(0.95, method, len(chosen))
        return np.mean((np.abs(off[chosen]) <= s * se[chosen, None]).all(axis=0))

    for chosen in ([0, 1, 2], [0, 2], [1]):
        assert in_ellipsoid(chosen) == pytest.approx(0.95, abs=tolerance)
        assert min(in_box(chosen, "scheffe"), in_box(chosen, "bonferroni")) >= 0.95 - tolerance
    for j in range(3):
        assert in_box([j], "individual") == pytest.approx(0.95, abs=tolerance)
    assert in_box([0, 1, 2], "individual") < 0.95 - tolerance  # why joint intervals are asked for


# --- which stiffness? -------------------------------------------------------------------------


def test_the_three_stiffnesses_of_the_shipped_numbers():
    text = runpy.run_path(str(GENERATOR))["table"]().split()[1:]
    x, force = np.array([row.split(",") for row in text], dtype=float).T
    fit = fit_spring(spring_data(force, x))
    slope, line, tangent = fit.stiffnesses(LOAD)
    assert slope == fit.slope and line == fit.line and tangent == fit.tangent(LOAD)
    assert (slope.value, slope.free) == (fit.stiffness, 18)
    np.testing.assert_allclose(slope.interval(), fit.stiffness_interval(), rtol=1e-12)
    assert slope.value == pytest.approx(792.9, abs=0.05)
    np.testing.assert_allclose(slope.interval(), [755.8, 830.0], atol=0.05)
    assert (line.value, line.free) == (pytest.approx(799.2, abs=0.05), 20)
    np.testing.assert_allclose(line.interval(), [794.4, 804.1], atol=0.05)
    assert fit.displacement(LOAD) == pytest.approx(0.5433, abs=1e-4)
    assert tangent.value == pytest.approx(803.6, abs=0.05)
    assert tangent.error == pytest.approx(4.83, abs=0.01)
    assert fit.linearity().linear


def test_the_line_is_that_of_statsmodels_without_a_constant():
    data = noisy(beta=(0.1, 13.2, 0.4))
    line = fit_spring(data).line
    expected = sm.OLS(data["force"], data["delta_over_delta_max"]).fit()
    assert line.value == pytest.approx(expected.params.iloc[0] / 0.0165, rel=1e-12)
    assert line.error == pytest.approx(expected.bse.iloc[0] / 0.0165, rel=1e-10)
    low, high = expected.conf_int(0.1).iloc[0] / 0.0165
    np.testing.assert_allclose(line.interval(0.9), [low, high], rtol=1e-10)
    np.testing.assert_allclose(line.distribution.interval(0.9), [low, high], rtol=1e-10)


@pytest.mark.parametrize("beta", [(0.5, 8, 2.5), (0, 13, -3), (0, 13, 0), (9, 13, 1)])
def test_the_tangent_touches_the_fit_where_it_carries_the_load(beta):
    fit = fit_spring(noisy(beta=beta, sigma=0.02), delta_max=0.02)
    curve = np.polynomial.Polynomial(fit.beta)
    x = fit.displacement(LOAD)
    assert curve(x) == pytest.approx(LOAD, rel=1e-12)
    tangent = fit.tangent(LOAD)
    assert tangent.value == pytest.approx(curve.deriv()(x) / 0.02, rel=1e-12) and tangent.value > 0
    # The same parabola written about x has the slope there as a coefficient of its own.
    shifted = spring_data(fit.F, X - x)
    assert tangent.error == pytest.approx(fit_spring(shifted, 0.02).slope.error, rel=1e-9)


def test_a_parabola_that_never_carries_the_load_has_no_tangent():
    fit = fit_spring(noisy(beta=(0, 8, -4), sigma=0.02))
    assert fit.displacement(LOAD) is None and fit.tangent(LOAD) is None
    assert [s.name for s in fit.stiffnesses(LOAD)] == ["slope at zero", "line through the origin"]


def test_the_f_test_is_that_of_the_two_nested_models():
    data = noisy(beta=(0.05, 13.2, 0.2))
    fit = fit_spring(data)
    x, force = data.to_numpy().T
    straight = np.sum((force - x @ force / (x @ x) * x) ** 2)
    F = (straight - np.sum(fit.residuals**2)) / 2 / (fit.scatter**2)
    test = fit.linearity()
    assert test.statistic == pytest.approx(F, rel=1e-9)
    assert test.pvalue == pytest.approx(stats.f.sf(F, 2, 18), rel=1e-9)


@pytest.mark.parametrize("beta, linear, joint", [
    ((0, 13.2, 0), True, True),
    ((1, 13.2, 0), False, False),
    ((0, 13.2, 2), False, False),
    ((0.25, 13.2, 0), False, True),  # inside both intervals, outside the ellipse
])  # fmt: skip
def test_a_spring_is_linear_if_neither_the_intervals_nor_the_test_object(beta, linear, joint):
    test = fit_spring(noisy(beta=beta, sigma=0.12, seed=4)).linearity()
    assert (test.linear, test.joint) == (linear, joint)
    assert test.linear == (test.joint and test.pvalue >= 0.05)


@pytest.mark.parametrize("beta, linear", [((0, 13.2, 0), True), ((0.5, 13.2, 0), False),
                                          ((0, 13.2, 1e-6), False)])  # fmt: skip
def test_readings_without_any_noise_are_linear_or_not(beta, linear):
    fit = fit_spring(spring_data(np.polynomial.Polynomial(beta)(X)))
    assert fit.linearity().linear is linear
    assert fit.slope.interval() == pytest.approx([800, 800], rel=1e-9)


def test_a_fit_shows_itself_in_one_line_and_survives_pickling():
    fit = fit_spring(noisy())
    assert repr(fit).startswith("SpringFit(beta=[") and len(repr(fit)) < 100
    assert repr(pickle.loads(pickle.dumps(fit))) == repr(fit)


# --- what the fit gives to others -------------------------------------------------------------


def test_nobody_else_reads_what_statsmodels_returns():
    """A fit answers by its own names; `results` is for those outside the project."""
    sources = [*ROOT.glob("suspension/**/*.py"), *ROOT.glob("notebooks/*.ipynb")]
    sources += [*ROOT.glob("book/**/*.py"), *ROOT.glob("benchmarks/*.py")]
    assert len(sources) > 50
    reads = re.compile(r"\b(fit|spring)\w*\.results\b")
    found = [path.name for path in sources if reads.search(path.read_text(encoding="utf-8"))]
    assert found == []


def test_the_fits_own_names_are_those_of_statsmodels():
    data = noisy(beta=(0.3, 12, 2))
    x, force = data.to_numpy().T
    M = np.vander(x, 3, increasing=True)
    expected = sm.OLS(force, M).fit()
    fit = fit_spring(data)
    np.testing.assert_array_equal([fit.x, fit.F], [x, force])
    np.testing.assert_allclose(fit.residuals, expected.resid, atol=1e-12)
    np.testing.assert_allclose(fit.covariance, expected.cov_params(), rtol=1e-10)
    np.testing.assert_allclose(fit.errors, expected.bse, rtol=1e-10)
    assert fit.free == 18
    assert fit.scatter == pytest.approx(np.sqrt(expected.mse_resid), rel=1e-12)
    np.testing.assert_allclose(fit.force(x), expected.fittedvalues, atol=1e-12)
    at = np.array([0, 0.3, 1.2])
    prediction = expected.get_prediction(np.vander(at, 3, increasing=True))
    np.testing.assert_allclose(fit.band(at, 0.9).T, prediction.conf_int(alpha=0.1), rtol=1e-9)


@pytest.mark.parametrize("places, kinds", [
    (np.repeat([0, 0.5, 1], 5), "three"), (np.linspace(0, 1, 4), "four readings"),
    (np.array([0, 0.5, 1, 1, 1 - 1e-12]), "four that are three"),
])  # fmt: skip
def test_three_displacements_say_nothing_of_a_cubic_term(places, kinds):
    noise = np.random.default_rng(1).normal(0, 0.05, places.size)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert fit_spring(spring_data(13 * places + noise, places)).cubic_pvalue is None, kinds


def test_a_cubic_term_is_judged_as_by_statsmodels():
    data = noisy(beta=(0, 13.2, 0))
    x, force = data.to_numpy().T
    expected = sm.OLS(force, np.vander(x, 4, increasing=True)).fit().pvalues[-1]
    assert fit_spring(data).cubic_pvalue == pytest.approx(expected, rel=1e-9)
    bent = spring_data(force + 3 * x**3)
    assert fit_spring(bent).cubic_pvalue < 0.01


@pytest.mark.parametrize("beta", [(0, 13.2, 0), (0.4, 12, 3)])
def test_readings_on_a_parabola_leave_nothing_to_judge(beta):
    fit = fit_spring(spring_data(np.polynomial.Polynomial(beta)(X)))
    assert fit.exact and fit.cubic_pvalue is None
    assert np.isnan(fit.neighbours.correlation) and not fit.neighbours.suspicious
    assert not fit_spring(noisy(beta=beta, sigma=1e-6)).exact


def residuals_of(places, errors):
    """Of as many experiments as `errors` has columns."""
    M = np.vander(places, 3, increasing=True)
    return errors - M @ np.linalg.lstsq(M, errors)[0]


@pytest.mark.parametrize("places", [X, np.linspace(0, 1, 9), np.repeat([0, 0.5, 1], 5),
                                    np.r_[X, X[::-1]]])  # fmt: skip
def test_independent_errors_are_suspicious_in_five_of_a_hundred(places):
    errors = np.random.default_rng(2086).normal(size=(places.size, 20_000))
    r = residuals_of(places, errors)
    correlation = np.sum(r[:-1] * r[1:], axis=0) / np.sum(r**2, axis=0)
    found = fit_spring(spring_data(errors[:, 0], places)).neighbours
    assert found.correlation == pytest.approx(correlation[0], rel=1e-9)
    assert (found.low + found.high) / 2 == pytest.approx(correlation.mean(), abs=0.01)
    assert (found.high - found.low) / 3.92 == pytest.approx(correlation.std(), rel=0.03)
    outside = np.mean((correlation < found.low) | (correlation > found.high))
    assert 0.03 < outside < 0.06
    assert found.suspicious == (not found.low <= correlation[0] <= found.high)


def test_the_widening_is_the_true_scatter_of_the_slope_over_the_one_that_is_claimed():
    rng = np.random.default_rng(2086)
    fit = fit_spring(spring_data(13.2 * X + 0.1 * np.cumsum(rng.normal(size=X.size))))
    found = fit.neighbours
    assert found.correlation > 0.1
    fade = found.correlation ** np.abs(np.subtract.outer(range(21), range(21)))
    errors = np.linalg.cholesky(fade) @ rng.normal(size=(21, 50_000))
    M = np.vander(X, 3, increasing=True)
    beta, squares, *_ = np.linalg.lstsq(M, errors)
    claimed = np.sqrt(squares.mean() / 18 * np.linalg.inv(M.T @ M)[1, 1])
    assert found.widening == pytest.approx(beta[1].std() / claimed, rel=0.02)


def test_loading_and_unloading_is_suspicious_and_its_readings_sorted_the_other_way():
    loop = spring_data(*loading_and_unloading())
    together = fit_spring(loop).neighbours
    assert together.suspicious and together.correlation > together.high
    turns = fit_spring(loop.sort_values("delta_over_delta_max", kind="stable")).neighbours
    assert turns.suspicious and turns.correlation < turns.low


@pytest.mark.parametrize("truth", [(0, 0), (0, 0.5), (0.2, 0), (-0.2, 0.5), (0.1, -0.6)])
def test_the_power_of_the_f_test_is_how_often_it_objects(truth):
    rng, repeats = np.random.default_rng(2086), 20_000
    fit = fit_spring(noisy())
    M = np.vander(X, 3, increasing=True)
    force = M @ [[truth[0]], [13.2], [truth[1]]] + rng.normal(0, fit.scatter, (21, repeats))
    squares = np.linalg.lstsq(M, force)[1]
    line = X @ force / (X @ X)
    growth = np.sum((force - np.outer(X, line)) ** 2, axis=0) - squares
    objects = stats.f.sf(growth / 2 / (squares / 18), 2, 18) < 0.05
    expected = fit.power(*truth)
    assert 0.05 - 1e-12 <= expected < 1
    spread = np.sqrt(expected * (1 - expected) / repeats)
    assert np.mean(objects) == pytest.approx(expected, abs=4 * spread)


def test_power_broadcasts_grows_and_ends_at_certainty():
    fit = fit_spring(noisy())
    assert fit.power(0, 0, level=0.9) == pytest.approx(0.1, rel=1e-9)
    power = fit.power(0, np.linspace(0, 1.5, 30))
    assert power.shape == (30,) and (np.diff(power) > 0).all()
    assert fit.power([[0], [1]], [0, 1e200]).shape == (2, 2) and fit.power(1e200, 0) == 1
    np.testing.assert_allclose(fit.power(0, -np.linspace(0, 1.5, 30)), power, rtol=1e-12)
    perfect = fit_spring(spring_data(13.2 * X))
    assert perfect.power(0, 0) == pytest.approx(0.05, rel=1e-9) and perfect.power(0, 0.1) == 1


# --- refusals ---------------------------------------------------------------------------------


@pytest.mark.parametrize("data, why", [
    (noisy().drop(columns="force"), r"^data must have the columns .*\['delta_over_delta_max'\]$"),
    (noisy().rename(columns={"force": "Force"}), "^data must have the columns"),
    (noisy().iloc[:2], "^data must have at least three .* got 2 points at 2"),
    (spring_data(np.ones(21), np.repeat([0.0, 0.5, 1.0], 7).round()), "got 21 points at 2"),
    (noisy().mask(noisy() > 5), "^force must be finite everywhere, got nan"),
    (noisy().assign(force=True), "^force must be an array of numbers, got booleans"),
    (noisy().assign(force="heavy"), "^force must be an array of numbers, got "),
    (spring_data(X, 0.5 + 1e-13 * X), "^data must have displacements far enough apart"),
])  # fmt: skip
def test_data_that_cannot_be_fitted_are_refused(data, why):
    with pytest.raises(ValueError, match=why) as caught:
        fit_spring(data)
    assert len(str(caught.value)) < 160 and "\n" not in str(caught.value)


def test_three_points_fit_but_say_nothing_about_the_error():
    fit = fit_spring(spring_data([0.0, 1.0, 4.0], np.array([0.0, 0.5, 1.0])), delta_max=1)
    np.testing.assert_allclose(fit.beta, [0, 0, 4], atol=1e-13)
    with pytest.raises(
        ValueError, match=r"^data must have more points than the three coefficients"
    ):
        fit.intervals()
    asked = lambda: fit.power(0, 1), lambda: fit.slope.distribution
    for refused in (fit.linearity, fit.slope.interval, *asked):
        with pytest.raises(ValueError, match="^data must have more points than the three"):
            refused()


@pytest.mark.parametrize("name, value", [
    ("level", 0), ("level", 1), ("level", 95), ("level", np.nan), ("method", "tukey"), ("p", 0),
    ("p", 4),
])  # fmt: skip
def test_an_interval_that_cannot_be_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=f"^{name} must be .*, got {value!r}$"):
        fit_spring(noisy()).intervals(**{name: value})


@pytest.mark.parametrize("delta_max", [0, -0.0165, np.nan, None])
def test_a_largest_displacement_that_cannot_be_is_refused(delta_max):
    with pytest.raises(ValueError, match=r"^delta_max must be a finite number > 0"):
        fit_spring(noisy(), delta_max)


def test_vehicles_are_numbers_with_their_sources():
    vehicles = springs.load_vehicles()
    assert len(vehicles) >= 6 and vehicles["source"].str.len().min() > 3
    assert not (vehicles.select_dtypes("number") <= 0).any(axis=None)
