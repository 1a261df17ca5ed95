"""The validators: what passes comes back as a float or an array, what does not is named."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from helpers import Quantity, UnitArray

from suspension import _checks

NOT_A_NUMBER = [np.nan, np.inf, -np.inf, None, "3", "three", 1j, np.complex128(3), [], 10**400]


@pytest.mark.parametrize(
    "value", [3, 3.0, True, np.float32(3), np.int64(3), np.array(3.0), Fraction(3), Decimal(3)]
)
def test_a_number_of_any_type_comes_back_as_float(value):
    x = _checks.number("x", value)
    assert type(x) is float and x == float(value)


@pytest.mark.parametrize("value", NOT_A_NUMBER, ids=lambda value: repr(value)[:12])
@pytest.mark.parametrize("check", [_checks.number, _checks.positive, _checks.nonnegative])
def test_what_is_not_a_finite_number_is_refused_by_name_and_value(check, value):
    with pytest.raises(ValueError, match=r"^mass must be a finite number") as error:
        check("mass", value)
    assert str(error.value).endswith(f"got {value!r}")


@pytest.mark.parametrize("value", [Quantity(3), UnitArray(3), [Quantity(3)], Quantity([3, 4])])
@pytest.mark.parametrize("check", [_checks.number, _checks.positive, _checks.nonnegative])
def test_a_number_with_units_is_refused_as_such(check, value):
    with pytest.raises(ValueError, match=r"^m must be a number in SI units, without units of its"):
        check("m", value)


@pytest.mark.parametrize(
    "check, edge, inside",
    [
        (_checks.positive, 0, 5e-324),
        (_checks.nonnegative, -5e-324, 0),
        (lambda name, x: _checks.interval(name, x, 0, 1), 1, 1 - 1e-16),
        (lambda name, x: _checks.interval(name, x, 0, 1), 0, 1e-300),
        (lambda name, x: _checks.whole(name, x, 4), 3, 4),
        (lambda name, x: _checks.whole(name, x, 4), 4.5, 5),
        (lambda name, x: _checks.one_of(name, x, (1, 2)), 3, 2),
    ],
)
def test_ranges_end_where_they_say(check, edge, inside):
    assert check("x", inside) == inside
    with pytest.raises(ValueError, match=f"^x must be .*, got {edge}$"):
        check("x", edge)


def test_an_array_comes_back_as_floats_and_none_stands_for_any_length():
    x = _checks.array("x", [[1, 2, 3], [4, 5, 6]], (2, None))
    assert x.dtype == float and x.shape == (2, 3)
    assert _checks.array("z", [1j], dtype=complex).dtype == complex
    assert np.isnan(_checks.array("x", [np.nan], finite=False)).all()


@pytest.mark.parametrize(
    "value, why",
    [
        ([1, 2, 3], r"shape \(4, n\), got \(3,\)"),
        (np.ones(4), r"shape \(4, n\), got \(4,\)"),
        (np.ones((4, 1, 1)), r"shape \(4, n\), got \(4, 1, 1\)"),
        (np.ones((5, 4)), r"shape \(4, n\), got \(5, 4\)"),
        (np.full((4, 1), np.nan), "finite everywhere, got nan"),
        (np.full((4, 1), -np.inf), "finite everywhere, got -inf"),
        ([[1], [2], [3], [4, 5]], "an array of numbers"),
        ([["1"], ["2"], ["3"], ["4"]], "an array of numbers"),
        (np.full((4, 1), 1j), "an array of numbers"),
        ([[10**400]] * 4, "an array of numbers"),
        (None, "an array of numbers"),
        (Quantity(np.ones((4, 1))), "an array in SI units, without units"),
        (UnitArray(np.ones((4, 1))), "an array in SI units, without units"),
        ([[Quantity(1.0)]] * 4, "an array in SI units, without units"),
    ],
)
def test_an_array_of_another_kind_is_refused_by_name(value, why):
    with pytest.raises(ValueError, match=f"^W must (be|have) {why}"):
        _checks.array("W", value, (4, None))
