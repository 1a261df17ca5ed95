"""Numbers, ranges and lists as words: the one place where the report decides how they look.

A minus is a true minus sign, powers of ten are written as such, units stand beside their numbers
(with a space that does not break), and nothing claims more digits than it is given.
"""

import math
from decimal import Decimal
from typing import NamedTuple

import numpy as np

__all__ = [
    "Caption",
    "confidence",
    "count",
    "distinct",
    "fixed",
    "interval",
    "join",
    "number",
    "percent",
    "pvalue",
    "quantity",
    "ranges",
    "seconds",
    "share",
    "speed_list",
    "spelled",
]

SPACE = "\u00a0"  # does not break a line
ROUNDOFF = 1e-9  # so far is a number with a few decimals from the one that is meant, at most
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Caption(NamedTuple):
    """What stands under a figure, Markdown, and the plain text for those who cannot see it."""

    text: str
    alt: str


def number(x, digits=3):
    """A number in significant digits, with powers of ten where it is very large or small.

    >>> number(-24.567), number(3.736e-05), number(1200), number(0.0), number(2.345e20, 2)
    ('−24.6', '3.74\\xa0×\\xa010⁻⁵', '1200', '0', '2.3\\xa0×\\xa010²⁰')
    """
    x = float(x)
    if not math.isfinite(x):
        raise ValueError(f"x must be finite to be written, got {x}")
    mantissa, power = f"{x:.{digits - 1}e}".split("e")
    power = int(power)
    if x == 0:
        return "0"
    if -4 < power < max(digits, 5):
        text = f"{float(f'{mantissa}e{power}'):.{max(digits - 1 - power, 0)}f}"
    else:
        text = f"{mantissa}{SPACE}×{SPACE}10" + str(power).translate(RAISED)
    return text.replace("-", "−")


def fixed(x, decimals):
    """A number with so many decimals, and never a negative zero.

    >>> fixed(-24.567, 2), fixed(-0.0001, 2)
    ('−24.57', '0.00')
    """
    x = float(x)
    if not math.isfinite(x):
        raise ValueError(f"x must be finite to be written, got {x}")
    return f"{round(x, decimals) + 0.0:.{decimals}f}".replace("-", "−")


def quantity(x, unit, digits=3):
    """A number with its unit.

    >>> quantity(0.0165, "m")
    '0.0165\\xa0m'
    """
    return number(x, digits) + SPACE + unit


def seconds(t, dt):
    """A time read from samples `dt` apart, with the decimals of the step; lengths alike.

    >>> seconds(0.17400000000000002, 0.001), seconds(0.00075, 0.00025), seconds(0.7, 0.2)
    ('0.174', '0.00075', '0.7')
    """
    decimals = -Decimal(f"{dt:.3g}").normalize().as_tuple().exponent
    return fixed(t, max(0, decimals))


def percent(fraction, digits=2):
    """A fraction as a percentage, in significant digits.

    >>> percent(0.95), percent(0.00213)
    ('95\\xa0%', '0.21\\xa0%')
    """
    return quantity(100 * fraction, "%", digits)


def pvalue(p):
    """A p-value, never rounded to nothing.

    >>> pvalue(0.567), pvalue(0.00001)
    ('p\\xa0=\\xa00.57', 'p\\xa0<\\xa00.001')
    """
    if p < 0.001:
        return f"p{SPACE}<{SPACE}0.001"
    return f"p{SPACE}={SPACE}{number(p, 2)}"


def confidence(p):
    """A probability as a percentage that never claims certainty.

    >>> confidence(0.5), confidence(1.0)
    ('50.00\\xa0%', '>\\xa099.99\\xa0%')
    """
    if p < 1e-4:
        return f"<{SPACE}0.01{SPACE}%"
    if p > 0.9999:
        return f">{SPACE}99.99{SPACE}%"
    return fixed(100 * p, 2) + SPACE + "%"


def share(fraction):
    """A part of the time as a percentage, or that it is less than any that was counted.

    >>> share(0), share(3e-5), share(0.0213)
    ('–', '<\\xa00.01\\xa0%', '2.1\\xa0%')
    """
    if fraction == 0:
        return "–"
    return f"<{SPACE}0.01{SPACE}%" if fraction < 1e-4 else percent(fraction, 2)


def interval(low, high, unit="", decimals=3):
    """Two ends and their unit, with so many decimals.

    >>> interval(-0.2081, 0.1794, "N")
    '−0.208 to 0.179\\xa0N'
    """
    return f"{fixed(low, decimals)} to {fixed(high, decimals)}" + (SPACE + unit if unit else "")


def spelled(n):
    """A whole number, in words up to nine.

    >>> spelled(0), spelled(4), spelled(12)
    ('none', 'four', '12')
    """
    words = "none one two three four five six seven eight nine".split()
    return words[n] if n < len(words) else str(n)


def count(n, noun, plural=None):
    """How many of a thing, in words up to nine.

    >>> count(0, "flight"), count(1, "flight"), count(4, "speed"), count(12, "point")
    ('no flights', 'one flight', 'four speeds', '12 points')
    """
    return f"{spelled(n) if n else 'no'} {noun if n == 1 else plural or noun + 's'}"


def join(items, last="and", none="none"):
    """Words in a row: ``a, b and c``.

    >>> join(["1.2", "5", "10"], "or")
    '1.2, 5 or 10'
    """
    items = list(map(str, items))
    if len(items) < 2:
        return items[0] if items else none
    return ", ".join(items[:-1]) + f" {last} " + items[-1]


def speed_list(speeds, last="and", none="no speed"):
    """Speeds in m/s in a row.

    >>> speed_list([1.2, 5]), speed_list([])
    ('1.2 and 5\\xa0m/s', 'no speed')
    """
    words = join([number(v) if v != float(f"{v:g}") else f"{v:g}" for v in speeds], last, none)
    return words + SPACE + "m/s" if len(speeds) else words


def distinct(values):
    """Numbers in order with so many digits, three or more, that neighbours can be told apart.

    >>> distinct([0.44494, 0.44596, 7.9457])
    ['0.4449', '0.4460', '7.95']
    """
    values = np.asarray(values, dtype=float)
    gaps = np.diff(values) / values[1:]
    nearest = np.minimum(np.append(gaps, 1), np.insert(gaps, 0, 1))
    digits = np.maximum(3, 1 + np.ceil(-np.log10(nearest)).astype(int))
    return [number(v, d) for v, d in zip(values, digits)]


def ranges(regimes):
    """The ranges of speed of a `suspension.contact.Regimes` in words.

    >>> from suspension.contact import Regimes
    >>> ranges(Regimes([0.1, 0.4, 30], [False, True]))
    'kept up to 0.400\\xa0m/s and lost from there on'
    """
    spans = [(*ends, gone) for gone in (False, True) for ends in regimes.spans(lost=gone)]
    low, high = regimes.edges[[0, -1]]
    names = distinct(regimes.edges)
    name = dict(zip(regimes.edges, names))
    words = []
    for start, end, gone in sorted(spans):
        if (start, end) == (low, high):
            where = f"at every speed from {low:g} to {high:g}{SPACE}m/s"
        elif start == low:
            where = f"up to {name[end]}{SPACE}m/s"
        elif end == high:
            where = "from there on"
        else:
            where = f"from {name[start]} to {name[end]}{SPACE}m/s"
        words.append(f"{'lost' if gone else 'kept'} {where}")
    return join(words)
