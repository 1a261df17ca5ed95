"""Two columns of numbers from text or from a MATLAB file, or one line that says what is wrong.

Everything that a reader of numbers tends to guess (an index, a missing value, a decimal comma, a
matrix in place of a vector) is either told in a note or refused with the line and what was expected
there. What the numbers mean is `_readings`'s business.
"""

import codecs
import csv
import re
import warnings
from reprlib import Repr
from typing import NamedTuple

import numpy as np
from scipy import io

__all__ = ["COLUMNS", "Columns", "read_mat", "read_text"]

COLUMNS = ("delta_over_delta_max", "force")
DELIMITERS = {",": "commas", ";": "semicolons", "\t": "tabs"}
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
OCTAVE = (b"# Created by Octave", b"Octave-1-")  # how its text and its binary format begin
NEWER = "variables of newer classes"  # string, table, datetime
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)  # "Unicode text" of a spreadsheet

_SHORT = Repr()
_SHORT.maxstring = 40
short = _SHORT.repr


class Columns(NamedTuple):
    """The numbers under the names `COLUMNS`, where each row stands, and what was noticed."""

    displacement: np.ndarray
    force: np.ndarray
    places: list
    notes: tuple


def refuse_octave(raw):
    """Octave's own formats, which `save` writes by default under any name."""
    if raw.startswith(OCTAVE):
        raise ValueError(
            ": expected a MATLAB file or CSV, got Octave's own format: save it by save -v7"
        )


# --- text -------------------------------------------------------------------------------------


def read_text(raw):
    """Read the bytes of a text file.

    Parameters
    ----------
    raw : bytes

    Returns
    -------
    Columns

    Raises
    ------
    ValueError
        What follows the file's name: the line and what was expected there.
    """
    refuse_octave(raw)
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
    notes = ["text in UTF-16"] if raw.startswith(UTF_16) else []
    if decimal_commas:
        notes.append("decimal commas")
    if delimiter != ",":
        notes.append(f"{DELIMITERS[delimiter]} between the fields")
    surplus = [name for name in names if name not in COLUMNS]
    if surplus:
        notes.append(f"columns not used: {', '.join(surplus)}")
    return Columns(x, force, lines, tuple(notes))


def _lines(raw):
    """Numbered lines without a byte order mark, comments and blank lines."""
    try:
        text = raw.decode("utf-16" if raw.startswith(UTF_16) else "utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")  # only names and comments may hold such letters
    if "\0" in text:
        raise ValueError(
            ": expected text in UTF-8 (or a .mat file), got binary data: save it as CSV in UTF-8"
        )
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


def read_mat(path, raw):
    """Read a MATLAB file of version 7 or older.

    Variables of newer classes (string, table, datetime) may stand beside the two vectors.

    Parameters
    ----------
    path : Path
    raw : bytes
        What the file holds.

    Returns
    -------
    Columns

    Raises
    ------
    ValueError
        What follows the file's name: the element and what was expected there.
    """
    refuse_octave(raw)
    try:
        table = io.loadmat(path, variable_names=COLUMNS)
        names = _names(path, table)
        logical = _logical(path)
    except NotImplementedError:  # how SciPy refuses version 7.3, which is HDF5
        raise ValueError(": expected a MATLAB file of version 7 or older (save -v7)") from None
    except Exception:  # the reader fails in many ways on what is no MATLAB file
        raise ValueError(": expected a MATLAB file, got something else") from None
    if not set(COLUMNS) <= set(names):
        got = short(", ".join(names))
        if NEWER in names:
            got = f"{' and '.join(names)}: save them as vectors, not in a table"
        raise ValueError(f": expected the fields {' and '.join(COLUMNS)}, got {got}")
    x, force = (
        _vector(name, table[name], "logical" if name in logical else _kind(table[name]))
        for name in COLUMNS
    )
    if len(x) != len(force):
        raise ValueError(
            f": expected as many forces as displacements, got {len(force)} and {len(x)}"
        )
    places = [f"element {i}" for i in range(1, len(x) + 1)]
    others = [name for name in names if name not in COLUMNS]
    notes = (f"fields not used: {', '.join(others)}",) if others else ()
    return Columns(x, force, places, notes)


def _names(path, table):
    """What the file holds; `whosmat` stumbles over newer classes, `loadmat` does not."""
    try:
        names = [name for name, *_ in io.whosmat(path)]
    except TypeError:
        return [*(name for name in COLUMNS if name in table), NEWER]
    return [name for name in names if not name.startswith("__")]


def _logical(path):
    """Which of the two are logical: only with MATLAB's own types are these no small integers."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # complex numbers lose a part, but only here
        typed = io.loadmat(path, variable_names=COLUMNS, mat_dtype=True)
    return {name for name, value in typed.items() if getattr(value, "dtype", "") == "bool"}


def _vector(name, value, kind):
    if kind != "numbers":
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


def _kind(value):
    """What MATLAB calls a variable that is not an array of real numbers."""
    if type(value) is not np.ndarray:
        return "sparse, function or object"
    if value.dtype.names:
        return "struct"
    kinds = {"c": "complex", "U": "text", "O": "cell"}
    return kinds.get(value.dtype.kind, "numbers")
