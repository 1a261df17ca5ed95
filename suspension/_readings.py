"""Read a load against displacement test from a file, or say in one line what is wrong with it.

Everything that a reader of numbers tends to guess (an index, a missing value, a decimal comma, a
matrix in place of a vector) is either told in a note or refused with the file, the line and what
was expected there.
"""

import csv
import re
from pathlib import Path
from reprlib import Repr
from typing import NamedTuple

import numpy as np
from scipy import io

from suspension.problem import DELTA_MAX

__all__ = ["COLUMNS", "Readings", "read"]

COLUMNS = ("delta_over_delta_max", "force")
DELIMITERS = {",": "commas", ";": "semicolons", "\t": "tabs"}
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
ROUNDOFF = 1e-9  # how far a displacement may lie outside [0, 1]
UNITS = {  # what a displacement of delta_max reads in units other than delta_max
    "per cent": 100,
    "millimetres": 1000 * DELTA_MAX,
    "centimetres": 100 * DELTA_MAX,
    "metres": DELTA_MAX,
}
LARGEST_FORCE = 200.0  # N, fourteen times the robot's weight

_SHORT = Repr()
_SHORT.maxstring = 40
short = _SHORT.repr


class Readings(NamedTuple):
    """Displacements over the largest, forces in N, where each stands, and what was noticed."""

    displacement: np.ndarray
    force: np.ndarray
    places: list
    notes: tuple


def read(path):
    """Read a CSV or MATLAB file.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Readings

    Raises
    ------
    ValueError
        In one line: the file, the line (or element) and what was expected.
    """
    try:
        path = Path(path)
        raw = path.read_bytes()
    except (TypeError, ValueError, OSError) as error:
        why = getattr(error, "strerror", None) or "not a path"
        raise ValueError(
            f"path must be a readable .csv or .mat file, got {path}: {why.lower()}"
        ) from None
    try:
        readings = _read_mat(path) if path.suffix.lower() == ".mat" else _read_text(raw)
        _check_displacements(readings.displacement, readings.places)
        _check_forces(readings.force, readings.places)
    except ValueError as error:
        raise ValueError(f"{path.name}{error}") from None
    return readings


# --- text -------------------------------------------------------------------------------------


def _read_text(raw):
    lines = _lines(raw)
    if not lines:
        raise ValueError(f", line 1: expected the names {' and '.join(COLUMNS)}, got no text")
    (number, header), *rows = lines
    delimiter, names = _header(number, header)
    rows = [(number, *_split(number, line, delimiter)) for number, line in rows]
    rows = [row for row in rows if any(row[1:])]
    for number, *fields in rows:
        if len(fields) != len(names):
            raise ValueError(_wrong_count(number, fields, names, delimiter))
    where = [names.index(name) for name in COLUMNS]
    used = [[fields[i] for i in where] for _, *fields in rows]
    decimal_commas = any("," in text for row in used for text in row)
    lines = [f"line {number}" for number, *_ in rows]
    values = [
        [_number(name, text, line, decimal_commas) for name, text in zip(COLUMNS, row)]
        for line, row in zip(lines, used)
    ]
    x, force = np.array(values, dtype=float).reshape(-1, 2).T
    notes = []
    if decimal_commas:
        notes.append("decimal commas")
    if delimiter != ",":
        notes.append(f"{DELIMITERS[delimiter]} between the fields")
    surplus = [name for name in names if name not in COLUMNS]
    if surplus:
        notes.append(f"columns not used: {', '.join(surplus)}")
    return Readings(x, force, lines, tuple(notes))


def _lines(raw):
    """Numbered lines without a byte order mark, comments and blank lines."""
    if b"\0" in raw:
        raise ValueError(": expected text in UTF-8 (or a .mat file), got binary data")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")  # only names and comments may hold such letters
    numbered = enumerate(re.split("\r\n|\n|\r", text), 1)
    return [(n, line) for n, line in numbered if line.strip() and line.lstrip()[0] not in "#%"]


def _header(number, line):
    for delimiter in DELIMITERS:
        names = _split(number, line, delimiter)
        if set(COLUMNS) <= set(names):
            break
    else:
        raise ValueError(
            f", line {number}: expected the names {' and '.join(COLUMNS)}, got {short(line)}"
        )
    for name in names:
        if names.count(name) > 1 or not name:
            raise ValueError(
                f", line {number}: expected a different name for each column, got {short(line)}"
            )
    return delimiter, names


def _split(number, line, delimiter):
    try:
        [fields] = csv.reader([line], delimiter=delimiter, skipinitialspace=True, strict=True)
    except csv.Error as error:
        raise ValueError(f", line {number}: expected closed quotes, got {error}") from None
    return [field.strip() for field in fields]


def _wrong_count(number, fields, names, delimiter):
    hint = ""
    if delimiter == "," and len(fields) == 2 * len(names):
        hint = " (decimal commas need semicolons between the fields)"
    return (
        f", line {number}: expected {len(names)} fields, as in the header, "
        f"got {len(fields)}: {short(delimiter.join(fields))}{hint}"
    )


def _number(name, text, line, decimal_commas):
    point, other = (",", ".") if decimal_commas else (".", ",")
    plain = text.replace(point, ".")
    if other in text or not NUMBER.fullmatch(plain) or not np.isfinite(float(plain)):
        kind = "a number with a decimal comma" if decimal_commas else "a number"
        raise ValueError(
            f", {line}: expected {kind} for {name}, got {short(text) if text else 'nothing'}"
        )
    return float(plain)


# --- MATLAB -----------------------------------------------------------------------------------


def _read_mat(path):
    try:
        table = io.loadmat(path)
        kinds = {name: kind for name, _, kind in io.whosmat(path)}
    except NotImplementedError:
        raise ValueError(": expected a MATLAB file of version 7 or older (save -v7)") from None
    except Exception:  # the reader fails in many ways on what is no MATLAB file
        raise ValueError(": expected a MATLAB file, got something else") from None
    names = [name for name in table if not name.startswith("__")]
    if not set(COLUMNS) <= set(names):
        raise ValueError(
            f": expected the fields {' and '.join(COLUMNS)}, got {short(', '.join(names))}"
        )
    x, force = (_vector(name, table[name], kinds[name]) for name in COLUMNS)
    if len(x) != len(force):
        raise ValueError(
            f": expected as many forces as displacements, got {len(force)} and {len(x)}"
        )
    places = [f"element {i}" for i in range(1, len(x) + 1)]
    surplus = [name for name in names if name not in COLUMNS]
    notes = (f"fields not used: {', '.join(surplus)}",) if surplus else ()
    return Readings(x, force, places, notes)


def _vector(name, value, kind):
    if np.iscomplexobj(value):
        kind = "complex"
    elif kind == "char":
        kind = "text"
    numeric = isinstance(value, np.ndarray) and value.dtype.kind in "iuf" and kind != "logical"
    if not numeric:
        raise ValueError(f": expected {name} to be a vector of numbers, got one of kind {kind}")
    if value.size != max(value.shape):
        shape = " x ".join(map(str, value.shape))
        raise ValueError(f": expected {name} to be a vector, got an array of {shape}")
    vector = value.ravel().astype(float)
    wrong = np.flatnonzero(~np.isfinite(vector))
    if wrong.size:
        raise ValueError(
            f", element {wrong[0] + 1}: expected a number for {name}, got {vector[wrong[0]]}"
        )
    return vector


# --- what the numbers must be -----------------------------------------------------------------


def _check_displacements(x, places):
    """Refuse displacements that are too few or not in units of the largest one."""
    if len(x) < 4:
        three = " (three fit a parabola and leave nothing to tell its error by)"
        raise ValueError(
            f": expected at least four readings, got {len(x)}{three if len(x) == 3 else ''}"
        )
    allowed = "expected delta_over_delta_max from 0 to 1"
    largest = x.argmax()
    if x[largest] > 1 + ROUNDOFF:
        raise ValueError(f", {places[largest]}: {allowed}, got {x[largest]:g}{_slip(x[largest])}")
    if x.min() < -ROUNDOFF:
        raise ValueError(f", {places[x.argmin()]}: {allowed}, got {x.min():g}")
    if x[largest] < 0.02:
        raise ValueError(f": {allowed}, got at most {x[largest]:g}{_slip(x[largest])}")


def _slip(largest):
    """Which unit the displacements are in by mistake, judged by the largest of them."""
    for unit, full in UNITS.items():
        if 0.75 < largest / full < 1.02:
            return f": {unit}? divide by {full:g}"
    return f" (not {', '.join(UNITS)})"


def _check_forces(force, places):
    """Refuse forces that are not in newtons."""
    largest = np.abs(force).argmax()
    if abs(force[largest]) > LARGEST_FORCE:
        raise ValueError(
            f", {places[largest]}: expected force in newtons, at most {LARGEST_FORCE:g}, "
            f"got {force[largest]:g}: grams? multiply by 0.00981"
        )
