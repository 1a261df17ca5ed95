"""Files with readings: what means the same is read as the same, all else is refused in one line."""

import hashlib
import runpy
import struct
import subprocess
import sys
import warnings
from io import BytesIO
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from cases import readings
from scipy import io

from suspension import _readings
from suspension.springs import is_synthetic, load_spring_data

GENERATOR = Path(__file__).parents[2] / "data" / "make_spring_data.py"

# --- files ------------------------------------------------------------------------------------

HEADER = "delta_over_delta_max,force\n"
ROWS = ["0,0.1", "0.25,3.2", "0.5,6.7", "0.75,9.8", "1,13.3"]
GOOD = pd.DataFrame(
    {"delta_over_delta_max": np.linspace(0, 1, 5), "force": [0.1, 3.2, 6.7, 9.8, 13.3]}
)


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
    data = readings(800)
    data.attrs.clear()
    data.assign(note="any other column").to_csv(tmp_path / "own.csv", index=False)
    columns = {name: column.to_numpy().reshape(shape) for name, column in data.items()}
    io.savemat(tmp_path / "own.mat", columns | {"note": "any other field"})
    for name in ("own.csv", "own.mat"):
        loaded = load_spring_data(tmp_path / name)
        pd.testing.assert_frame_equal(loaded, data, rtol=1e-15)
        assert loaded.attrs["source"] == name
        assert "not used: note" in loaded.attrs["notes"][0]


def mat(fields):
    """The bytes of a MATLAB file."""
    file = BytesIO()
    io.savemat(file, {name: np.asarray(value) for name, value in fields.items()})
    return file.getvalue()


def opaque(name, newer_class):
    """The bytes of a variable of a newer class, which refers to data that stand elsewhere."""

    def element(kind, payload):
        return struct.pack("<II", kind, len(payload)) + payload + bytes(-len(payload) % 8)

    def matrix(number, *parts):  # 6: flags, of which the lowest byte is the number of the class
        return element(14, element(6, struct.pack("<II", number, 0)) + b"".join(parts))

    reference = struct.pack("<6I", 0xDD000000, 2, 1, 1, 1, 1)
    shape, no_name = element(5, struct.pack("<ii", 6, 1)), element(1, b"")
    inner = matrix(13, shape, no_name, element(6, reference))
    names = [element(1, text.encode()) for text in (name, "MCOS", newer_class)]
    return matrix(17, *names, inner)


OCTAVE = b"""# Created by Octave 8.4.0, Sat May 02 10:00:00 2026 UTC <user@host>
# name: force
# type: matrix
# rows: 1
# columns: 5
 0.1 3.2 6.7 9.8 13.3
"""


def test_variables_of_newer_classes_may_stand_beside_the_two_vectors(tmp_path):
    path = tmp_path / "own.mat"
    newer = opaque("when", "datetime") + opaque("who", "string") + opaque("all", "table")
    path.write_bytes(mat(GOOD) + newer * 9)
    with pytest.raises(TypeError):
        io.whosmat(path)  # so that this test is about what it says
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        loaded = load_spring_data(path)
    pd.testing.assert_frame_equal(loaded, GOOD)
    assert loaded.attrs["notes"] == ("fields not used: variables of newer classes",)


@pytest.mark.parametrize("kind, values", [
    ("logical", GOOD["force"] > 5), ("complex", GOOD["force"] + 1j),
])  # fmt: skip
def test_numbers_of_a_wrong_kind_are_refused_beside_newer_classes_too(tmp_path, kind, values):
    path = tmp_path / "own.mat"
    fields = {"delta_over_delta_max": GOOD["delta_over_delta_max"], "force": values}
    path.write_bytes(mat(fields) + opaque("when", "datetime"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        message = error_of(path)
    assert message.endswith(f"expected force to be a vector of numbers, got one of kind {kind}")


def test_a_mat_file_takes_precedence_and_the_package_holds_what_the_checkout_lacks(
    tmp_path, monkeypatch
):
    outside, inside = tmp_path / "data", tmp_path / "package"
    outside.mkdir()
    inside.mkdir()
    monkeypatch.setattr(_readings, "FOLDERS", (outside, inside))
    with pytest.raises(ValueError, match="^path must be given, because "):
        load_spring_data()
    readings(900).to_csv(inside / "spring_data.csv", index=False)
    pd.testing.assert_frame_equal(load_spring_data(), readings(900))
    readings(700).to_csv(outside / "spring_data.csv", index=False)
    pd.testing.assert_frame_equal(load_spring_data(), readings(700))
    columns = {name: column.to_numpy() for name, column in readings(800).items()}
    io.savemat(outside / "spring_data.mat", columns)
    assert load_spring_data().attrs["source"] == "spring_data.mat"
    pd.testing.assert_frame_equal(load_spring_data(), readings(800))


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
    (csv(*ROWS).replace(",", "\t").encode("utf-16"),
     ("text in UTF-16", "tabs between the fields")),
    (b"\xfe\xff" + csv(*ROWS).encode("utf-16-be"), ("text in UTF-16",)),
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
    (csv("0,7", "0.2,7", "0.6,7", "1,7"), ": expected a force that grows with the displacement, "
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
    ("own.csv", b"PK\x03\x04\x14\x00" * 20,
     "own.csv: expected text in UTF-8 (or a .mat file), got binary data: save it as CSV in UTF-8"),
    ("own.csv", csv(*ROWS).encode("utf-16-le"),
     "own.csv: expected text in UTF-8 (or a .mat file), got binary data: save it as CSV in UTF-8"),
    ("own.csv", csv(*ROWS).encode("utf-16") + b"?",
     "own.csv: expected text in UTF-8 (or a .mat file), got binary data: save it as CSV in UTF-8"),
    *((name, raw, f"{name}: expected a MATLAB file or CSV, got Octave's own format: "
       "save it by save -v7")
      for name in ("own.mat", "own.csv") for raw in (OCTAVE, b"Octave-1-L" + bytes(99))),
    ("own.mat", mat({"delta_over_delta_max": GOOD.index}) + opaque("force", "table"),
     "own.mat: expected the fields delta_over_delta_max and force, got "
     "delta_over_delta_max and variables of newer classes: save them as vectors, not in a table"),
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
    assert hashlib.sha256(text.encode()).hexdigest() == _readings.SYNTHETIC
    for name in ("TRUE_STIFFNESS", "NOISE", "RESOLUTION", "SEED"):
        assert generator[name] == getattr(_readings, name)
    copy = tmp_path / GENERATOR.name
    copy.write_text(GENERATOR.read_text(encoding="utf-8"), encoding="utf-8")
    runpy.run_path(str(copy), run_name="__main__")
    assert (tmp_path / "spring_data.csv").read_bytes() == text.encode()


def test_only_those_very_numbers_are_synthetic(tmp_path):
    text = runpy.run_path(str(GENERATOR))["table"]()
    (tmp_path / "other_name.txt").write_text(text.replace("\n", "\r\n"), encoding="utf-8")
    data = load_spring_data(tmp_path / "other_name.txt")
    assert is_synthetic(data)
    io.savemat(tmp_path / "own.mat", {name: column.to_numpy() for name, column in data.items()})
    assert is_synthetic(load_spring_data(tmp_path / "own.mat"))
    changed = data.copy()
    changed.loc[20, "force"] += 0.02
    assert not is_synthetic(changed)
    assert not is_synthetic(data.iloc[:-1])
    assert not is_synthetic(readings(800))


# --- as a command -----------------------------------------------------------------------------


def test_the_command_says_what_was_read(tmp_path, capsys):
    path = tmp_path / "own.csv"
    path.write_text(csv(*ROWS).replace(",", ";").replace(".", ","), encoding="utf-8")
    assert _readings.main([str(path)]) == 0
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
    assert _readings.main([str(path)]) == 1
    out, err = capsys.readouterr()
    assert out == "" and err == f"own.csv, line 6: {RANGE} 100: per cent? divide by 100\n"


@pytest.mark.slow  # a process that loads all of it
def test_the_command_is_that_of_the_module_of_the_fit(tmp_path):
    path = tmp_path / "own.csv"
    path.write_text(csv(*ROWS), encoding="utf-8")
    command = [sys.executable, "-m", "suspension.springs", path]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0 and "slope   772.3 N/m" in done.stdout and not done.stderr
