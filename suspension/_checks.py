"""Arguments that cannot mean anything are refused, by name, before any computing starts."""

from math import isfinite, isnan, nan
from numbers import Number, Real
from reprlib import repr as short

import numpy as np

__all__ = [
    "array",
    "ends",
    "function",
    "in_order",
    "instance",
    "instances",
    "interval",
    "nonnegative",
    "number",
    "one_of",
    "pair",
    "positive",
    "positives",
    "whole",
]

PLAIN = "{} in SI units, without units of its own"


def number(name, value, allowed="a finite number", test=lambda x: True):
    """Return `value` as a finite float that passes `test`, else raise ValueError naming it."""
    x = value if isinstance(value, float) else _as_float(value)
    if isnan(x) and _has_units(value):
        raise ValueError(f"{name} must be {PLAIN.format('a number')}, got {short(value)}")
    if not (isfinite(x) and test(x)):
        raise ValueError(f"{name} must be {allowed}, got {value!r}")
    return float(x)


def _as_float(value):
    """A real number as a float; anything else as nan."""
    if _has_units(value):
        return nan
    scalar = np.ndim(value) == 0 and not _is_masked(value)
    real = scalar and (isinstance(value, Number) or np.asarray(value).dtype.kind in "biuf")
    try:
        return float(value) if real and not np.iscomplexobj(value) else nan
    except (TypeError, ValueError, OverflowError):
        return nan


def _is_masked(value):
    # The first condition is quick, and false for nearly everything.
    return isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value)


def _has_units(value):
    """Whether a number, an array, or a part of a list has units of its own.

    Those of pint, unyt and astropy would all be dropped, with a warning at best.
    """
    if isinstance(value, list | tuple):
        return any(map(_has_units, value))
    return hasattr(value, "units") or hasattr(value, "unit")


def positive(name, value):
    """Return `value` as a finite float > 0."""
    return number(name, value, "a finite number > 0", lambda x: x > 0)


def nonnegative(name, value):
    """Return `value` as a finite float >= 0."""
    return number(name, value, "a finite number >= 0", lambda x: x >= 0)


def interval(name, value, low, high):
    """Return `value` as a float with low < value < high."""
    return number(name, value, f"a number between {low} and {high}", lambda x: low < x < high)


def ends(low_name, low, high_name, high):
    """Return both ends of a range as floats, 0 < low < high."""
    low = positive(low_name, low)
    return low, number(high_name, high, f"> {low_name} = {low:g}", lambda x: x > low)


def pair(name, value):
    """Return both ends of a range that is one argument, ``(low, high)``, as floats > 0."""
    try:
        low, high = value
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be a pair (low, high), got {short(value)}") from None
    return ends(f"{name}[0]", low, f"{name}[1]", high)


def whole(name, value, low):
    """Return `value` as an int >= low."""

    def test(x):
        return x >= low and x == int(x)

    return int(number(name, value, f"a whole number >= {low}", test))


def one_of(name, value, choices):
    """Return `value` if it is among `choices`."""
    comparable = isinstance(value, str | Real) and not isinstance(value, np.timedelta64)
    if not (comparable and any(value == choice for choice in choices)):
        raise ValueError(f"{name} must be one of {', '.join(map(repr, choices))}, got {value!r}")
    return value


def instance(name, value, kind):
    """Return `value` if it is a `kind`, else raise TypeError naming it."""
    if not isinstance(value, kind):
        raise TypeError(f"{name} must be a {kind.__name__}, got {value!r}")
    return value


def instances(name, values, kind):
    """Return one or an array of `kind` as an array of objects, else raise TypeError naming it."""
    values = np.asarray(values, dtype=object)
    for value in values.flat:
        if not isinstance(value, kind):
            allowed = f"a {kind.__name__} or an array of them"
            raise TypeError(f"{name} must be {allowed}, got {value!r}")
    return values


def function(name, value, signature):
    """Return `value` if it can be called, else raise TypeError naming it."""
    if not callable(value) or isinstance(value, type):
        raise TypeError(f"{name} must be a function, {signature}, got {short(value)}")
    return value


def array(name, value, shape=None, dtype=float, finite=True):
    """Return `value` as an array of the given shape; None in `shape` stands for any length."""
    if type(value) is not np.ndarray and _has_units(value):
        raise ValueError(f"{name} must be {PLAIN.format('an array')}, got {short(value)}")
    if _is_masked(value):
        raise ValueError(f"{name} must have no masked elements, got {short(value)}")
    try:
        x = np.asarray(value)
        if x.dtype.kind not in ("biufc" if dtype is complex else "biuf"):  # text, objects
            raise TypeError
        x = x.astype(dtype, copy=False)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be an array of numbers, got {short(value)}") from None
    if shape is not None and (
        x.ndim != len(shape) or any(n not in (None, m) for n, m in zip(shape, x.shape))
    ):
        wanted = "(" + ", ".join("n" if n is None else str(n) for n in shape) + ")"
        raise ValueError(f"{name} must have shape {wanted}, got {x.shape}")
    if finite and not np.isfinite(x).all():
        raise ValueError(f"{name} must be finite everywhere, got {x[~np.isfinite(x)].flat[0]}")
    return x


def in_order(name, values, least=0):
    """Return `values` as a row of finite numbers, each larger than the one before."""
    x = array(name, values, (None,))
    if len(x) < least:
        raise ValueError(f"{name} must hold numbers, {least} or more, got {len(x)}")
    back = np.flatnonzero(x[1:] <= x[:-1])
    if back.size:
        before, after = x[back[0]], x[back[0] + 1]
        raise ValueError(f"{name} must be in order, got {after:.6g} after {before:.6g}")
    return x


def positives(name, values, shape=None):
    """Return `values` as an array of finite numbers > 0; `shape` as in `array`."""
    x = array(name, values, shape)
    if not (x > 0).all():
        raise ValueError(f"{name} must be > 0 everywhere, got {x[~(x > 0)].flat[0]}")
    return x
