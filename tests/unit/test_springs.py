"""The fit and its intervals: files, certified results, and a count of how often they are right."""

import numpy as np
import pandas as pd
import pytest
import statsmodels.api as sm
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import io, stats

from suspension import springs
from suspension.springs import fit_spring, load_spring_data

X = np.linspace(0, 1, 21)


def spring_data(force, x=X):
    return pd.DataFrame({"delta_over_delta_max": x, "force": force})


def noisy(seed=1, beta=(0, 13.2, 0), sigma=0.12):
    noise = np.random.default_rng(seed).normal(0, sigma, X.size)
    return spring_data(np.polynomial.Polynomial(beta)(X) + noise)


# --- files ------------------------------------------------------------------------------------


def test_shipped_data_are_two_columns_of_numbers_and_know_their_source():
    data = load_spring_data()
    assert list(data.columns) == ["delta_over_delta_max", "force"]
    assert set(map(str, data.dtypes)) == {"float64"} and data.attrs["source"].startswith(
        "spring_data."
    )


@pytest.mark.parametrize("shape", [(21, 1), (1, 21)])
def test_a_mat_file_and_a_csv_file_of_the_same_data_are_the_same(tmp_path, shape):
    data = noisy()
    data.assign(note="any other column").to_csv(tmp_path / "own.csv", index=False)
    columns = {name: column.to_numpy().reshape(shape) for name, column in data.items()}
    io.savemat(tmp_path / "own.mat", columns)
    for name in ("own.csv", "own.mat"):
        loaded = load_spring_data(tmp_path / name)
        pd.testing.assert_frame_equal(loaded, data, rtol=1e-15)
        assert loaded.attrs["source"] == name


def test_a_mat_file_in_the_data_folder_takes_precedence(tmp_path, monkeypatch):
    monkeypatch.setattr(springs, "DATA", tmp_path)
    noisy(seed=1).to_csv(tmp_path / "spring_data.csv", index=False)
    assert load_spring_data().attrs["source"] == "spring_data.csv"
    io.savemat(tmp_path / "spring_data.mat", {n: x.to_numpy() for n, x in noisy(seed=2).items()})
    assert load_spring_data().attrs["source"] == "spring_data.mat"
    pd.testing.assert_frame_equal(load_spring_data(), noisy(seed=2))


@pytest.mark.parametrize("name, content, why", [
    ("missing.csv", None, "^path must be a readable .csv or .mat file, got .*missing.csv"),
    ("empty.csv", "", "^path must be a readable"),
    ("broken.mat", "not a MATLAB file at all" * 20, "^path must be a readable"),
    ("names.csv", "x,force\n1,2\n", "^names.csv must have the columns .*, got .*'x', 'force'"),
    ("text.csv", "delta_over_delta_max,force\n0,1\n1,heavy\n", "^force must be an array"),
    ("gap.csv", "delta_over_delta_max,force\n0,1\n,2\n", "^delta_over_delta_max must be finite"),
    ("inf.csv", "delta_over_delta_max,force\n0,1\n1,inf\n", "^force must be finite"),
])  # fmt: skip
def test_a_file_that_cannot_be_used_is_refused(tmp_path, name, content, why):
    if content is not None:
        (tmp_path / name).write_text(content)
    with pytest.raises(ValueError, match=why):
        load_spring_data(tmp_path / name)


@pytest.mark.parametrize("path", [3, ["spring_data.csv"]])
def test_a_path_that_is_none_is_refused(path):
    with pytest.raises(ValueError, match="^path must be a readable .csv or .mat file, got "):
        load_spring_data(path)


def test_columns_of_different_lengths_are_refused(tmp_path):
    io.savemat(tmp_path / "own.mat", {"delta_over_delta_max": X, "force": X[:-1]})
    with pytest.raises(ValueError, match="one length"):
        load_spring_data(tmp_path / "own.mat")


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
    np.testing.assert_allclose(fit.results.bse, deviation, rtol=1e-9)
    half = np.ptp(fit.intervals(0.95, "individual"), axis=1) / 2
    np.testing.assert_allclose(half, stats.t.ppf(0.975, 37) * np.array(deviation), rtol=1e-7)
    assert np.sqrt(fit.results.mse_resid) == pytest.approx(0.205177424076185e-03, rel=1e-9)
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
            half = fit.width(0.9, method, p) * fit.results.bse
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
    np.testing.assert_allclose(fit.results.bse, se * sigma[0], rtol=1e-10)

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


# --- refusals ---------------------------------------------------------------------------------


@pytest.mark.parametrize("data, why", [
    (noisy().drop(columns="force"), r"^data must have the columns .*\['delta_over_delta_max'\]$"),
    (noisy().rename(columns={"force": "Force"}), "^data must have the columns"),
    (noisy().iloc[:2], "^data must have at least three .* got 2 points at 2"),
    (spring_data(np.ones(21), np.repeat([0.0, 0.5, 1.0], 7).round()), "got 21 points at 2"),
    (noisy().mask(noisy() > 5), "^force must be finite everywhere, got nan"),
])  # fmt: skip
def test_data_that_cannot_be_fitted_are_refused(data, why):
    with pytest.raises(ValueError, match=why):
        fit_spring(data)


def test_three_points_fit_but_say_nothing_about_the_error():
    fit = fit_spring(spring_data([0.0, 1.0, 4.0], np.array([0.0, 0.5, 1.0])), delta_max=1)
    np.testing.assert_allclose(fit.beta, [0, 0, 4], atol=1e-13)
    with pytest.raises(
        ValueError, match=r"^data must have more points than the three coefficients"
    ):
        fit.intervals()


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
