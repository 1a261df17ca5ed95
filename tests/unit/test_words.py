"""How the report writes numbers and lists."""

import numpy as np
import pytest
from cases import faults
from hypothesis import given
from hypothesis import strategies as st

from suspension.contact import Regimes
from suspension.report import words

numbers = st.floats(-1e300, 1e300, allow_subnormal=False)


@given(numbers, st.integers(1, 9))
def test_a_number_reads_back_to_its_digits(x, digits):
    text = words.number(x, digits).replace("−", "-").replace("\u00a0", "")
    if "×10" in text:
        mantissa, power = text.split("×10")
        power = power.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
        text = f"{mantissa}e{power}"
    assert float(text) == pytest.approx(x, rel=0.5001 * 10 ** (1 - digits), abs=0)


@given(numbers)
def test_a_number_has_no_exponent_and_no_hyphen(x):
    assert not set(words.number(x)) & set("e-+")


@pytest.mark.parametrize("write", [words.number, lambda x: words.fixed(x, 2)])
@pytest.mark.parametrize("x", [np.nan, np.inf, -np.inf])
def test_what_is_no_number_is_not_written(write, x):
    with pytest.raises(ValueError, match="finite"):
        write(x)


def test_a_rounded_zero_has_no_sign():
    assert words.fixed(-0.001, 2) == "0.00"
    assert words.number(-0.0) == "0"


@pytest.mark.parametrize(("dt", "decimals"), [(0.2, 1), (0.1, 1), (0.001, 3), (0.0005, 4), (2, 0)])
def test_a_sampled_time_has_the_decimals_of_its_step(dt, decimals):
    text = words.seconds(0.17400000000000002, dt)
    assert len(text.partition(".")[2]) == decimals


def test_small_values_are_not_rounded_to_nothing():
    assert words.percent(1e-5) == "0.0010\u00a0%"
    assert words.pvalue(1e-9) == "p\u00a0<\u00a00.001"
    assert words.pvalue(0.0012) == "p\u00a0=\u00a00.0012"
    assert words.confidence(0.999999) == ">\u00a099.99\u00a0%"
    assert words.confidence(0.0) == "<\u00a00.01\u00a0%"


def test_lists_of_every_length():
    assert [words.join(range(n)) for n in range(4)] == ["none", "0", "0 and 1", "0, 1 and 2"]
    assert words.speed_list([]) == "no speed"
    assert words.speed_list([0.25, 10]) == "0.25 and 10\u00a0m/s"


@pytest.mark.parametrize(
    ("edges", "lost", "expected"),
    [
        ([0.1, 30], [False], "kept at every speed from 0.1 to 30 m/s"),
        ([0.1, 30], [True], "lost at every speed from 0.1 to 30 m/s"),
        ([0.1, 1, 30], [True, True], "lost at every speed from 0.1 to 30 m/s"),
        ([0.1, 1, 30], [False, True], "kept up to 1.00 m/s and lost from there on"),
        (
            [0.1, 0.40178, 0.444945, 0.445960, 30],
            [False, True, False, True],
            "kept up to 0.402 m/s, lost from 0.402 to 0.4449 m/s, kept from 0.4449 to 0.4460 m/s "
            "and lost from there on",
        ),
    ],
)
def test_ranges(edges, lost, expected):
    assert words.ranges(Regimes(edges, lost)).replace("\u00a0", " ") == expected


@pytest.mark.parametrize(
    "text",
    [
        "settled at nan",
        "flies at none m/s",
        "7.3e+02 µs",
        "changes by 0.0 %",
        "p = 0.00",
        "0.045454545454545456 of it",
        "| -2.5 |",
        "the  gap",
        "ends . here",
    ],
)
def test_the_check_of_the_report_finds_what_it_is_for(text):
    assert faults(text)


@pytest.mark.parametrize(
    "text",
    ["−2.5 N, 10.0 %", "p = 0.05", "$e^{-2}$ and `x-1`", "[a link](02-part.ipynb#a)", "|:-|--:|"],
)
def test_the_check_of_the_report_lets_the_rest_pass(text):
    assert not faults(text)
