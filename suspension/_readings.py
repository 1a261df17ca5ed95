"""The readings of the spring: which file, refused if it could mislead, and what it holds.

Everything about a file up to the regression, which is `springs`; how its text or its MATLAB format
is read is `_formats`.
"""

import hashlib
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np

from suspension._formats import COLUMNS, read_mat, read_text
from suspension.problem import DELTA_MAX

__all__ = [
    "COLUMNS",
    "TRUE_STIFFNESS",
    "Readings",
    "are_synthetic",
    "design",
    "main",
    "read",
    "shipped",
]

# Beside the package in a checkout; inside it when it is installed.
FOLDERS = (
    Path(__file__).resolve().parents[1] / "data",
    Path(__file__).resolve().parent / "data",
)
SHIPPED = FOLDERS  # of what is not read anew for each copy
FILES = ("spring_data.mat", "spring_data.csv")

# The synthetic stand-in, data/make_spring_data.py: its digest, so that another file under the same
# name is not taken for it, and how it was made.
SYNTHETIC = "4443053ab6a814e209f91ab03635f51ed49172dc75c624a1e632790b21e09b11"
TRUE_STIFFNESS = 800.0  # N/m
NOISE = 0.12  # N, standard deviation
RESOLUTION = 0.02  # N
SEED = 2086

ROUNDOFF = 1e-9  # how far a displacement may lie outside [0, 1]
UNITS = {
    "per cent": 100,
    "millimetres": 1e3 * DELTA_MAX,
    "centimetres": 1e2 * DELTA_MAX,
    "metres": DELTA_MAX,
}
LARGEST_FORCE = 200.0  # N, fourteen times the robot's weight


class Readings(NamedTuple):
    """Displacements over the largest, forces in N, the file's name, and what was noticed."""

    displacement: np.ndarray
    force: np.ndarray
    source: str
    notes: tuple

    @property
    def slope(self):
        """Slope at zero of the parabola through them, N."""
        return np.linalg.lstsq(design(self.displacement), self.force)[0][1]


def read(path=None):
    """Read a CSV or MATLAB file.

    Parameters
    ----------
    path : str or Path, optional
        If not given, the first of `FILES` that one of `FOLDERS` holds.

    Returns
    -------
    Readings

    Raises
    ------
    ValueError
        In one line: the file, the line (or element) and what was expected.
    """
    if path is None:
        path = _default_file()
    try:
        path = Path(path)
        raw = path.read_bytes()
    except (TypeError, ValueError, OSError) as error:
        why = getattr(error, "strerror", None) or "not a path"
        raise ValueError(
            f"path must be a readable .csv or .mat file, got {path}: {why.lower()}"
        ) from None
    try:
        columns = read_mat(path, raw) if path.suffix.lower() == ".mat" else read_text(raw)
        _check_displacements(columns.displacement, columns.places)
        _check_forces(columns.force, columns.places)
        readings = Readings(columns.displacement, columns.force, path.name, columns.notes)
        _check_spring(readings)
    except ValueError as error:
        raise ValueError(f"{path.name}{error}") from None
    return readings


def _default_file():
    for folder in FOLDERS:
        for name in FILES:
            if (folder / name).exists():
                return folder / name
    raise ValueError(f"path must be given, because {FOLDERS[0]} holds no {' or '.join(FILES)}")


def shipped(name):
    """The path of a file that comes with the book and does not change: ``data/name``."""
    for folder in SHIPPED:
        if (folder / name).is_file():
            return folder / name
    raise ValueError(f"name must be a file in {' or '.join(map(str, SHIPPED))}, got {name!r}")


def are_synthetic(displacement, force):
    """Whether readings are the synthetic stand-in."""
    rows = [f"{float(x)},{float(y)}\n" for x, y in zip(displacement, force)]
    text = "".join([",".join(COLUMNS) + "\n", *rows])
    return hashlib.sha256(text.encode()).hexdigest() == SYNTHETIC


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


def _check_spring(readings):
    """Refuse displacements without a parabola, and a force that falls."""
    try:
        slope = readings.slope
    except ValueError as error:
        raise ValueError(f": {error}") from None
    if not slope > 1e-6 * readings.force.max():
        raise ValueError(
            ": expected a force that grows with the displacement, got a slope at zero of "
            f"{round(slope / DELTA_MAX, 6) + 0.0:.4g} N/m"
        )


def design(x, terms=3):
    """The matrix whose columns are 1, x, x^2, ..., shape (len(x), terms).

    Raises
    ------
    ValueError
        If the displacements `x` cannot tell so many coefficients apart.
    """
    count = {3: "three", 4: "four"}[terms]
    different = len(np.unique(x))
    if different < terms:
        raise ValueError(
            f"data must have at least {count} points at {count} different displacements to fit "
            f"{count} coefficients, got {len(x)} points at {different}"
        )
    matrix = np.vander(x, terms, increasing=True)
    if not np.linalg.cond(matrix / np.linalg.norm(matrix, axis=0)) < 1e8:
        raise ValueError(
            f"data must have displacements far enough apart to tell {count} coefficients, "
            f"got {np.min(x):g} to {np.max(x):g}, {np.ptp(x):.2g} apart"
        )
    return matrix


# --- as a command -----------------------------------------------------------------------------


def main(arguments):
    """Say what a file of readings holds; the exit code is 1 if it cannot be used."""
    try:
        readings = read(*arguments[:1])
    except ValueError as error:
        print(error, file=sys.stderr)
        return 1
    x, force, source, notes = readings
    print(f"file    {source}{' (synthetic)' if are_synthetic(x, force) else ''}")
    print(f"points  {len(x)}")
    print(f"range   delta/delta_max from {x.min():g} to {x.max():g}")
    print(f"        force from {force.min():g} to {force.max():g} N, of the spring pair")
    stiffness = readings.slope / DELTA_MAX
    print(f"slope   {stiffness:.1f} N/m at zero, with delta_max = {DELTA_MAX:g} m")
    for note in notes:
        print(f"note    {note}")
    return 0
