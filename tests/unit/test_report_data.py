"""Sentences and rows about the data, for springs of every kind."""

import re
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from suspension import problem
from suspension.branches import End
from suspension.report import data as words
from suspension.report import table
from suspension.report.rows import facts
from suspension.springs import Stiffness, fit_spring, load_spring_data
from suspension.uncertainty import CriticalSpeed

LOAD = 1.456 * 9.81 / 2  # half of the robot's weight, N
SHIPPED = Path(__file__).parents[2] / "data" / "spring_data.csv"


def readings(k, beta0=0.0, beta2=0.0, sigma=0.05, n=21, notes=()):
    x = np.linspace(0, 1, n)
    noise = np.random.default_rng(1).normal(0, sigma, n)
    force = beta0 + k * 0.0165 * x + beta2 * x**2 + noise
    data = pd.DataFrame({"delta_over_delta_max": x, "force": force})
    data.attrs.update(source="spring_data.mat", notes=notes)
    return data


@pytest.fixture(scope="module")
def synthetic():
    """The shipped readings, unless somebody has put others in their place."""
    data = load_spring_data(SHIPPED)
    if not words.is_synthetic(data):
        pytest.skip("data/spring_data.csv is not the synthetic file")
    return data


SPRINGS = {
    **{f"k = {k}": readings(k) for k in (250, 405, 500, 793, 987, 1000, 2300)},
    "preload and curvature": readings(500, 0.5, 2.5),
    "softening": readings(800, 0, -6),
    "never carries the load": readings(480, 0, -4),
    "more preload than load": readings(800, 9),
    "no noise": readings(800, sigma=0),
    "four readings": readings(800, n=4),
    "rough": readings(800, sigma=2),
}


@pytest.mark.parametrize("name", SPRINGS)
def test_no_sentence_about_any_spring_is_broken(name):
    data = SPRINGS[name]
    fit = fit_spring(data)
    sentences = [
        words.source_sentence(data),
        words.read_sentence(data, fit),
        words.slope_sentence(fit),
        words.made_sentence(data),
        words.stiffness_sentence(fit, LOAD),
        table(words.data_rows(data)),
        table(words.stiffness_rows(fit, LOAD)),
    ]
    for text in sentences:
        assert text and not re.search(r"nan|None|\binf|e[+-]\d\d|\d\.\d{6}|  |-\d", text), text
    for text in sentences[:5]:
        assert text.endswith(".") and ".." not in text
    assert "synthetic:" not in " ".join(sentences)
    assert (
        "not the synthetic one" in words.synthetic_note(data) and words.hindsight(data, fit) == ""
    )


def test_synthetic_data_are_called_so_and_explained(synthetic):
    fit = fit_spring(synthetic)
    assert "**These data are synthetic:**" in words.source_sentence(synthetic)
    assert words.synthetic_note(synthetic).startswith("The spring data are synthetic")
    made = words.made_sentence(synthetic)
    assert "21 displacements" in made and "800\u00a0N/m" in made and "2086" in made
    assert "is inside the interval" in words.hindsight(synthetic, fit)
    read = words.read_sentence(synthetic, fit)
    assert "`spring_data.csv` holds 21 readings" in words.source_sentence(synthetic)
    assert "from 0 to 1" in read and "16.5\u00a0mm" in read
    assert "−0.12 to 13.28\u00a0N" in read
    assert "792.9\u00a0N/m" in words.slope_sentence(fit) and "slope" not in read
    assert words.data_rows(synthetic)[:2] == [
        {r"$\delta/\delta_{\max}$": "0.00", "force (N)": "−0.12"},
        {r"$\delta/\delta_{\max}$": "0.05", "force (N)": "0.58"},
    ]


def test_the_truth_can_lie_outside_the_interval(synthetic):
    assert "is outside the interval" in words.hindsight(synthetic, fit_spring(readings(500)))


def test_other_data_are_not_explained():
    data = readings(793)
    assert "not the synthetic data" in words.source_sentence(data)
    assert not re.search(r"\d", words.made_sentence(data))


def test_what_the_reader_noticed_is_told():
    data = readings(793, notes=("decimal commas", "semicolons between the fields"))
    read = words.read_sentence(data, fit_spring(data))
    assert read.endswith("The reader noticed: decimal commas and semicolons between the fields.")


@pytest.mark.parametrize("values, decimals", [
    ([0, 1], "0 1"), ([0.5, 1], "0.5 1.0"), ([0, 0.25], "0.00 0.25"),
    ([1 / 22, 1], "0.0455 1.0000"), ([-0.00001, 0.1 + 0.2], "0.0000 0.3000"),
])  # fmt: skip
def test_a_column_has_the_decimals_it_needs(values, decimals):
    rows = words.data_rows(pd.DataFrame({"delta_over_delta_max": values, "force": values}))
    assert " ".join(row["force (N)"] for row in rows) == decimals


def test_the_facts_of_the_book_are_those_that_are_computed_with():
    fit = fit_spring(SPRINGS["k = 793"])
    table_1 = problem.TABLE_1 | {"m": 2.5, "c2": 0.75}
    given = table_1 | {"k1": fit.stiffness, "k2": 900.0}
    rows = {row["symbol"]: row["value"] for row in facts(given)}
    assert rows["$m$"] == "2.5\u00a0kg" and rows["$c_2$"] == "0.75\u00a0N s/m"
    assert float(rows["$k_1$"].split("\u00a0")[0]) == pytest.approx(fit.stiffness, abs=0.05)
    assert rows["$k_2$"] == "900\u00a0N/m" and len(rows) == len(given)
    bump = replace(problem.BUMP, height=0.01, centre=-0.2)
    rows = {row["symbol"]: row["value"] for row in facts(asdict(bump))}
    assert rows == {
        "$h_0$": "0.01\u00a0m",
        r"$\sigma$": f"{problem.BUMP.sigma}\u00a0m",
        "$x_0$": "−0.2\u00a0m",
    }
    rows = words.question_rows((0.5, 20), (0.1,), (0.2, 0.1), 3.0, 2.0)
    told = ["0.5 and 20\u00a0m/s", "0.1\u00a0s", "0.2 and 0.1\u00a0s", "3\u00a0s", "2\u00a0m"]
    assert [row["value"] for row in rows] == told


# --- which stiffness --------------------------------------------------------------------------


def sentence(name):
    return words.stiffness_sentence(fit_spring(SPRINGS[name]), LOAD)


def test_a_linear_spring_is_advised_its_line():
    text = sentence("k = 793")
    assert "do not contradict a line" in text and "outside" not in text


def test_a_curved_spring_is_advised_its_tangent():
    text = sentence("preload and curvature")
    assert "The data contradict a line" in text
    assert "41\u00a0% more than the slope at zero and **outside** its interval" in text
    assert "% less than" in sentence("softening")


@pytest.mark.parametrize("name, measured", [
    ("k = 250", False), ("k = 405", False), ("k = 793", True), ("more preload than load", False),
])  # fmt: skip
def test_a_rest_outside_the_measured_range_is_called_an_extrapolation(name, measured):
    assert ("extrapolation" in sentence(name)) is not measured
    tangent = words.stiffness_rows(fit_spring(SPRINGS[name]), LOAD)[-1]
    assert ("outside the measured range" in tangent["remark"]) is not measured


def test_a_spring_that_never_carries_the_load_has_two_rows():
    assert "bends down before it carries" in sentence("never carries the load")
    assert len(words.stiffness_rows(fit_spring(SPRINGS["never carries the load"]), LOAD)) == 2


def test_readings_without_noise_are_known_exactly():
    text = sentence("no noise")
    assert "the same as the slope at zero" in text
    rows = words.stiffness_rows(fit_spring(SPRINGS["no noise"]), LOAD)
    assert [row["standard error (N/m)"] for row in rows] == ["0"] * 3


def test_the_table_says_whether_the_line_is_allowed():
    remarks = [
        words.stiffness_rows(fit_spring(SPRINGS[name]), LOAD)[1]["remark"]
        for name in ("k = 793", "preload and curvature")
    ]
    assert remarks == ["compatible with the data", "contradicted by the data"]


# --- critical speeds --------------------------------------------------------------------------

PAIR, RANGE = End(990.54, 0.4461, "pair"), End(655.2, 5.2, "range")
BIRTH = End(906.05, 0.4065, "pair")


@pytest.mark.parametrize("born, dies, text", [
    (None, None, ""),
    (None, PAIR, "exists only for k < 990.5\u00a0N/m"),
    (BIRTH, None, "exists only for k > 906.0\u00a0N/m"),
    (BIRTH, PAIR, "exists only for k from 906.0 to 990.5\u00a0N/m"),
    (RANGE, None, "enters the range of speeds at k = 655.2\u00a0N/m"),
    (None, RANGE, "leaves the range of speeds at k = 655.2\u00a0N/m"),
    (RANGE, PAIR,
     "exists only for k < 990.5\u00a0N/m and enters the range of speeds at k = 655.2\u00a0N/m"),
])  # fmt: skip
def test_existence_is_told_in_words(born, dies, text):
    assert words.existence(CriticalSpeed(0.44, 0.43, 0.45, born, dies)) == text


def test_each_stiffness_has_its_rows_or_says_that_there_are_none():
    slope = Stiffness("slope at zero", 986.7, 18.0, 18)
    line = Stiffness("line through the origin", 990.1, 2.0, 20)
    speeds = (
        CriticalSpeed(0.444843, 0.431460, 0.446141, None, PAIR),
        CriticalSpeed(None, 0.44403, 0.44611, None, PAIR),
        CriticalSpeed(10.6137, 10.0676, 11.1683, None, None),
    )
    rows = words.consequence_rows([(slope, speeds), (line, ())])
    first, second = "slope at zero, 987\u00a0N/m", "line through the origin, 990.1\u00a0N/m"
    note = "exists only for k < 990.5\u00a0N/m"
    assert [list(row.values()) for row in rows] == [
        [first, "0.445", "0.431 to 0.446", note],
        [first, "–", "0.4440 to 0.4461", note],
        [first, "10.6", "10.1 to 11.2", "–"],
        [second, "–", "–", "–"],
    ]
