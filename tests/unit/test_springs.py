"""The fit and its intervals: files, certified results, and a count of how often they are right."""

import hashlib
import pickle
import runpy
from pathlib import Path

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
GENERATOR = Path(__file__).parents[2] / "data" / "make_spring_data.py"
LOAD = 1.456 * 9.81 / 2  # half of the robot's weight, N


def spring_data(force, x=X):
    return pd.DataFrame({"delta_over_delta_max": x, "force": force})


def noisy(seed=1, beta=(0, 13.2, 0), sigma=0.12):
    noise = np.random.default_rng(seed).normal(0, sigma, X.size)
    return spring_data(np.polynomial.Polynomial(beta)(X) + noise)


# --- files ------------------------------------------------------------------------------------

HEADER = "delta_over_delta_max,force\n"
ROWS = ["0,0.1", "0.25,3.2", "0.5,6.7", "0.75,9.8", "1,13.3"]
GOOD = spring_data([0.1, 3.2, 6.7, 9.8, 13.3], np.linspace(0, 1, 5))


def csv(*rows, header=HEADER):
    return header + "\n".join(rows) + "\n"


def replaced(i, row):
    """The good file with one row replaced; row i is line i + 2."""
    return csv(*ROWS[:i], row, *ROWS[i + 1 :])


def scaled(x=1.0, force=1.0):
    """The good file in other units."""
    pairs = [map(float, row.split(",")) for row in ROWS]
    return csv(*(f"{x * a:.6g},{force * b:.6g}" for a, b in pairs))


def error_of(path):
    """The message of a refusal: one short line."""
    with pytest.raises(ValueError) as caught:
        load_spring_data(path)
    message = str(caught.value)
    assert "\n" not in message and len(message) < 200
    return message


def test_shipped_data_are_two_columns_of_numbers_and_know_their_source():
    data = load_spring_data()
    assert list(data.columns) == ["delta_over_delta_max", "force"]
    assert set(map(str, data.dtypes)) == {"float64"}
    assert data.attrs["source"].startswith("spring_data.") and data.attrs["notes"] == ()


@pytest.mark.parametrize("shape", [(21, 1), (1, 21)])
def test_a_mat_file_and_a_csv_file_of_the_same_data_are_the_same(tmp_path, shape):
    data = noisy()
    data.assign(note="any other column").to_csv(tmp_path / "own.csv", index=False)
    columns = {name: column.to_numpy().reshape(shape) for name, column in data.items()}
    io.savemat(tmp_path / "own.mat", columns | {"note": "any other field"})
    for name in ("own.csv", "own.mat"):
        loaded = load_spring_data(tmp_path / name)
        pd.testing.assert_frame_equal(loaded, data, rtol=1e-15)
        assert loaded.attrs["source"] == name
        assert "not used: note" in loaded.attrs["notes"][0]


def test_a_mat_file_takes_precedence_and_the_package_holds_what_the_checkout_lacks(
    tmp_path, monkeypatch
):
    outside, inside = tmp_path / "data", tmp_path / "package"
    outside.mkdir()
    inside.mkdir()
    monkeypatch.setattr(springs, "FOLDERS", (outside, inside))
    with pytest.raises(ValueError, match="^path must be given, because "):
        load_spring_data()
    noisy(seed=3).to_csv(inside / "spring_data.csv", index=False)
    pd.testing.assert_frame_equal(load_spring_data(), noisy(seed=3))
    noisy(seed=1).to_csv(outside / "spring_data.csv", index=False)
    pd.testing.assert_frame_equal(load_spring_data(), noisy(seed=1))
    columns = {name: column.to_numpy() for name, column in noisy(seed=2).items()}
    io.savemat(outside / "spring_data.mat", columns)
    assert load_spring_data().attrs["source"] == "spring_data.mat"
    pd.testing.assert_frame_equal(load_spring_data(), noisy(seed=2))


@pytest.mark.parametrize("raw, notes", [
    (csv(*ROWS).encode("utf-8-sig"), ()),
    (csv(*ROWS).replace("\n", "\r\n").encode(), ()),
    (csv(*ROWS).replace("\n", "\r").encode(), ()),
    (csv(*ROWS).rstrip().encode(), ()),
    (("# on 2 May\n\n% by hand\n" + csv(*ROWS)).replace("0.5", "\n  # middle\n0.5").encode(), ()),
    ((csv(*ROWS) + ",\n,\n").encode(), ()),
    (csv(*(f" {row.replace(',', ' , ')} " for row in ROWS)).encode(), ()),
    (csv(*(f"{row},Jörg" for row in ROWS), header=HEADER.strip() + ",who\n").encode("latin-1"),
     ("columns not used: who",)),
    (csv(*(f'{i},"a, b",{row}' for i, row in enumerate(ROWS)), header=f"i,who,{HEADER}").encode(),
     ("columns not used: i, who",)),
    (csv(*ROWS).replace(",", ";").encode(), ("semicolons between the fields",)),
    (csv(*ROWS).replace(",", ";").replace(".", ",").encode(),
     ("decimal commas", "semicolons between the fields")),
    (csv(*ROWS).replace(",", "\t").encode(), ("tabs between the fields",)),
    (csv(*('"' + row.replace(",", '","').replace(".", ",") + '"' for row in ROWS)).encode(),
     ("decimal commas",)),
])  # fmt: skip
def test_what_means_the_same_is_read_as_the_same_and_told(tmp_path, raw, notes):
    (tmp_path / "own.csv").write_bytes(raw)
    loaded = load_spring_data(tmp_path / "own.csv")
    pd.testing.assert_frame_equal(loaded, GOOD)
    assert loaded.attrs["notes"] == notes


NAMES = "expected the names delta_over_delta_max and force, got"
RANGE = "expected delta_over_delta_max from 0 to 1, got"

NO_UNIT = " (not per cent, millimetres, centimetres, metres)"


@pytest.mark.parametrize("content, message", [
    ("", f", line 1: {NAMES} no text"),
    ("# only a comment\n", f", line 1: {NAMES} no text"),
    (csv(*ROWS, header="x,force\n"), f", line 1: {NAMES} 'x,force'"),
    (csv(*ROWS, header="\n"), f", line 2: {NAMES} '0,0.1'"),
    (csv(*ROWS, header="force,force,delta_over_delta_max\n"),
     ", line 1: expected a different name for each column, got 'force,force,delta_over_delta_max'"),
    (csv(*(f"{row}," for row in ROWS), header=HEADER.strip() + ",\n"),
     ", line 1: expected a different name for each column, got 'delta_over_delta_max,force,'"),
    (csv(*(f"{row},1" for row in ROWS)),
     ", line 2: expected 2 fields, as in the header, got 3: '0,0.1,1'"),
    (replaced(2, "0.5"), ", line 4: expected 2 fields, as in the header, got 1: '0.5'"),
    ("# why\n\n" + replaced(2, "0.5,6,7"),
     ", line 6: expected 2 fields, as in the header, got 3: '0.5,6,7'"),
    (csv("0,0,0,1", "0,5,6,7"), ", line 2: expected 2 fields, as in the header, got 4: '0,0,0,1' "
     "(decimal commas need semicolons between the fields)"),
    (replaced(1, ",3.2"), ", line 3: expected a number for delta_over_delta_max, got nothing"),
    (replaced(1, "0.25,"), ", line 3: expected a number for force, got nothing"),
    (replaced(1, "0.25,heavy"), ", line 3: expected a number for force, got 'heavy'"),
    (replaced(1, "0.25,nan"), ", line 3: expected a number for force, got 'nan'"),
    (replaced(1, "0.25,inf"), ", line 3: expected a number for force, got 'inf'"),
    (replaced(1, "0.25,1e999"), ", line 3: expected a number for force, got '1e999'"),
    (replaced(1, "0.25,1_0"), ", line 3: expected a number for force, got '1_0'"),
    (replaced(1, "True,3.2"), ", line 3: expected a number for delta_over_delta_max, got 'True'"),
    (replaced(1, '0.25,"3.2'), ", line 3: expected closed quotes, got unexpected end of data"),
    (replaced(1, "0.25,3.2").replace(",", ";").replace("3.2", "3,2"),
     ", line 2: expected a number with a decimal comma for force, got '0.1'"),
    (csv(), ": expected at least four readings, got 0"),
    (csv(*ROWS[::2]), ": expected at least four readings, got 3 "
     "(three fit a parabola and leave nothing to tell its error by)"),
    (scaled(100), f", line 6: {RANGE} 100: per cent? divide by 100"),
    (scaled(16.5), f", line 6: {RANGE} 16.5: millimetres? divide by 16.5"),
    (scaled(1.65), f", line 6: {RANGE} 1.65: centimetres? divide by 1.65"),
    (scaled(0.0165), f": {RANGE} at most 0.0165: metres? divide by 0.0165"),
    (scaled(1.00001), f", line 6: {RANGE} 1.00001{NO_UNIT}"),
    (scaled(5), f", line 6: {RANGE} 5{NO_UNIT}"),
    (replaced(0, "-0.05,-0.6"), f", line 2: {RANGE} -0.05"),
    (scaled(force=1000 / 9.81),
     ", line 6: expected force in newtons, at most 200, got 1355.76: grams? multiply by 0.00981"),
    (scaled(force=-1), ": expected a force that grows with the displacement, "
     "got a slope at zero of -772.3 N/m"),
    (csv(*(f"{x},7" for x in X)), ": expected a force that grows with the displacement, "
     "got a slope at zero of 0 N/m"),
    (csv(*(f"{0.5 + i * 1e-13},{i}" for i in range(5))), ": data must have displacements far "
     "enough apart to tell three coefficients, got 0.5 to 0.5, 4e-13 apart"),
    (csv("0,0", "0,0", "1,13", "1,13"), ": data must have at least three points at three different "
     "displacements to fit three coefficients, got 4 points at 2"),
])  # fmt: skip
def test_a_text_file_that_cannot_be_used_is_refused_in_one_line(tmp_path, content, message):
    path = tmp_path / "own.csv"
    path.write_text(content, encoding="utf-8")
    assert error_of(path) == f"own.csv{message}"


def test_displacements_outside_the_range_by_roundoff_are_allowed(tmp_path):
    path = tmp_path / "own.csv"
    path.write_text(csv("-1e-10,0", *ROWS[1:-1], "1.0000000001,13.3"), encoding="utf-8")
    assert load_spring_data(path)["delta_over_delta_max"].iloc[0] == -1e-10


x, force = GOOD.to_numpy().T
FIELDS = "expected the fields delta_over_delta_max and force, got"


@pytest.mark.parametrize("fields, message", [
    ({"x": x, "force": force}, f": {FIELDS} 'x, force'"),
    ({"data": {"delta_over_delta_max": x, "force": force}}, f": {FIELDS} 'data'"),
    ({"delta_over_delta_max": x, "force": np.outer(force, [1, 1, 1])},
     ": expected force to be a vector, got an array of 5 x 3"),
    ({"delta_over_delta_max": x.reshape(1, 1, 5), "force": np.ones((2, 2, 2))},
     ": expected force to be a vector, got an array of 2 x 2 x 2"),
    ({"delta_over_delta_max": x > 0.5, "force": force},
     ": expected delta_over_delta_max to be a vector of numbers, got one of kind logical"),
    ({"delta_over_delta_max": x, "force": force + 1j},
     ": expected force to be a vector of numbers, got one of kind complex"),
    ({"delta_over_delta_max": x, "force": "heavy"},
     ": expected force to be a vector of numbers, got one of kind text"),
    ({"delta_over_delta_max": x, "force": {"rear": force}},
     ": expected force to be a vector of numbers, got one of kind struct"),
    ({"delta_over_delta_max": x, "force": np.where(x == 0.5, np.nan, force)},
     ", element 3: expected a number for force, got nan"),
    ({"delta_over_delta_max": x, "force": force[:-1]},
     ": expected as many forces as displacements, got 4 and 5"),
    ({"delta_over_delta_max": x[:3], "force": force[:3]},
     ": expected at least four readings, got 3 "
     "(three fit a parabola and leave nothing to tell its error by)"),
    ({"delta_over_delta_max": [], "force": []}, ": expected at least four readings, got 0"),
    ({"delta_over_delta_max": 100 * x, "force": force},
     f", element 5: {RANGE} 100: per cent? divide by 100"),
])  # fmt: skip
def test_a_matlab_file_that_cannot_be_used_is_refused_in_one_line(tmp_path, fields, message):
    io.savemat(tmp_path / "own.mat", fields)
    assert error_of(tmp_path / "own.mat") == f"own.mat{message}"


@pytest.mark.parametrize("name, raw, message", [
    ("own.mat", b"not a MATLAB file at all" * 20,
     "own.mat: expected a MATLAB file, got something else"),
    ("own.mat", b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + b"\x89HDF" * 9,
     "own.mat: expected a MATLAB file of version 7 or older (save -v7)"),
    ("own.csv", csv(*ROWS).encode("utf-16"),
     "own.csv: expected text in UTF-8 (or a .mat file), got binary data"),
])  # fmt: skip
def test_a_file_of_another_kind_is_refused_in_one_line(tmp_path, name, raw, message):
    (tmp_path / name).write_bytes(raw)
    assert error_of(tmp_path / name) == message


@pytest.mark.parametrize("path, why", [
    (3, "not a path"),
    (["spring_data.csv"], "not a path"),
    ("missing.csv", "no such file or directory"),
    (".", "is a directory"),
])  # fmt: skip
def test_a_path_that_is_none_is_refused(path, why):
    message = error_of(path)
    assert message == f"path must be a readable .csv or .mat file, got {path}: {why}"


# --- the synthetic stand-in -------------------------------------------------------------------


def test_the_generator_writes_the_shipped_file_byte_by_byte_and_the_digest_knows_it(tmp_path):
    generator = runpy.run_path(str(GENERATOR))
    text = generator["table"]()
    assert hashlib.sha256(text.encode()).hexdigest() == springs.SYNTHETIC
    assert generator["TRUE_STIFFNESS"] == springs.TRUE_STIFFNESS
    copy = tmp_path / GENERATOR.name
    copy.write_text(GENERATOR.read_text(encoding="utf-8"), encoding="utf-8")
    runpy.run_path(str(copy), run_name="__main__")
    assert (tmp_path / "spring_data.csv").read_bytes() == text.encode()


def test_only_those_very_numbers_are_synthetic(tmp_path):
    text = runpy.run_path(str(GENERATOR))["table"]()
    (tmp_path / "other_name.txt").write_text(text.replace("\n", "\r\n"), encoding="utf-8")
    data = load_spring_data(tmp_path / "other_name.txt")
    assert springs.is_synthetic(data)
    io.savemat(tmp_path / "own.mat", {name: column.to_numpy() for name, column in data.items()})
    assert springs.is_synthetic(load_spring_data(tmp_path / "own.mat"))
    changed = data.copy()
    changed.loc[20, "force"] += 0.02
    assert not springs.is_synthetic(changed)
    assert not springs.is_synthetic(data.iloc[:-1])
    assert not springs.is_synthetic(noisy())


# --- as a command -----------------------------------------------------------------------------


def test_the_command_says_what_was_read(tmp_path, capsys):
    path = tmp_path / "own.csv"
    path.write_text(csv(*ROWS).replace(",", ";").replace(".", ","), encoding="utf-8")
    assert springs.main([str(path)]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "file    own.csv",
        "points  5",
        "range   delta/delta_max from 0 to 1",
        "        force from 0.1 to 13.3 N, of the spring pair",
        "slope   772.3 N/m at zero, with delta_max = 0.0165 m",
        "note    decimal commas",
        "note    semicolons between the fields",
    ]


def test_the_command_ends_with_the_error_and_the_code_1(tmp_path, capsys):
    path = tmp_path / "own.csv"
    path.write_text(scaled(100), encoding="utf-8")
    assert springs.main([str(path)]) == 1
    out, err = capsys.readouterr()
    assert out == "" and err == f"own.csv, line 6: {RANGE} 100: per cent? divide by 100\n"


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
    shifted = spring_data(fit.results.model.endog, X - x)
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
    F = (straight - fit.results.ssr) / 2 / (fit.results.ssr / 18)
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
    for refused in (fit.linearity, fit.slope.interval, lambda: fit.slope.distribution):
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
