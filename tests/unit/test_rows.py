"""Rows of the report's tables."""

from dataclasses import replace

import numpy as np
import pytest
from cases import faults

from suspension.report import rows
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import CRANK_NICOLSON, RK4
from suspension.simulation import simulate

BUMP = GaussianBump()
ROBOT = Robot(793, 793)


def drive(robot, v, dt=0.001):
    return simulate(robot, BUMP, v=v, dt=dt, tfinal=1.25 / v)


def test_columns_of_numbers_are_set_to_the_right():
    text = rows.table([{"a": "−1", "b": "kept", "c": "–"}, {"a": "2", "b": "3", "c": "> 5"}])
    assert text.splitlines()[1] == "|--:|:--|--:|"


def test_a_kept_verdict_has_no_loss():
    row = rows.verdict(drive(ROBOT, 10), 2.1)
    assert row["contact"] == "kept"
    assert [row[name] for name in ("wheel", "at t (s)", "at X (m)")] == ["–"] * 3
    assert row["least $N_1$ (N)"] == "1.75"
    assert row["least $N_2$ (N)"] == "2.71"


def test_a_lost_verdict_tells_forces_before_the_loss_from_those_after():
    row = rows.verdict(drive(ROBOT, 1.2), 1.39)
    assert (row["contact"], row["wheel"], row["at t (s)"]) == ("lost", "front", "0.177")
    assert row["least $N_1$ (N)"] == row["least $N_2$ (N)"] == "< 0 (after)"
    run = drive(ROBOT, 1.2)
    at_loss = run.N[1, : round(run.loss.t / run.dt) + 1]
    short = replace(run, T=run.T[: at_loss.size], N=run.N[:, : at_loss.size])
    assert rows.verdict(short, 1)["least $N_2$ (N)"] == "< 0 (at the loss)"
    before = short.N[0].min()
    assert before > 0 and short.N[0].argmin() < short.T.size - 1
    assert rows.verdict(short, 1)["least $N_1$ (N)"] == f"{before:.2f} (before)"


def test_after_a_loss_a_least_force_is_a_sign_and_a_place():
    run = drive(ROBOT, 1.2)
    at = round(run.loss.t / run.dt)
    assert at == np.flatnonzero((run.N <= 0).any(axis=0))[0]
    for lowest, sign in ((-3.21, "< 0"), (0.0, "0"), (1.23, "> 0")):
        N = np.full_like(run.N, 7.0)
        N[1, at], N[0, at + 5] = (
            -4.56,
            lowest,
        )  # the front wheel is lost, the rear one's least after
        row = rows.verdict(replace(run, N=N))
        assert row["least $N_1$ (N)"] == f"{sign} (after)"
        assert row["least $N_2$ (N)"] == "< 0 (at the loss)"


@pytest.mark.parametrize(("dt", "decimals"), [(0.001, 3), (0.0005, 4)])
def test_a_time_has_the_resolution_of_the_samples(dt, decimals):
    row = rows.verdict(drive(Robot(1000, 1000), 1.2, dt), 1.2)
    assert len(row["at t (s)"].partition(".")[2]) == decimals


def test_a_place_is_no_finer_than_the_samples():
    samples = [(1.2, 0.001, 3), (5, 0.001, 3), (10, 0.001, 2)]  # 1.2, 5 and 10 mm apart
    for v, dt, decimals in samples:
        place = rows.verdict(drive(Robot(1000, 1000), v, dt), 1.2)["at X (m)"]
        assert len(place.partition(".")[2]) == decimals


def test_growth_has_four_digits_unless_they_hide_the_verdict():
    class Method:
        def __init__(self, growth):
            self.growth = growth

        def stability_function(self, z):
            return self.growth + 0 * z

        def is_stable(self, eigenvalues, dt):
            return self.growth <= 1

    def shown(growth):
        row = rows.stability_rows(Method(growth), np.ones(2), [0.1])[0]
        return row[r"$\max_k \lvert R(\lambda_k\Delta t)\rvert$"]

    assert [shown(r) for r in (139.41, 6.3125, 0.99897, 1)] == ["139.4", "6.312", "0.9990", "1.000"]
    assert shown(1.00004) == "1.00004" and shown(0.9999996) == "0.999999600"


def test_matrix_entries_are_plain_numbers():
    text = rows.table(rows.matrix_rows(ROBOT.A))
    assert not faults(text)
    assert "−1089.29" in text


@pytest.mark.parametrize(
    "robot",
    [ROBOT, Robot(793, 793, c1=0, c2=0), Robot(300, 2300, L1=0.05, c2=9), Robot(1, 1, c1=9, c2=9)],
)
def test_modes_of_any_robot(robot):
    modes = rows.mode_rows(robot)
    assert len(modes) == 4
    assert not faults(rows.table(modes))


def test_heave_and_pitch_are_told_apart():
    assert [row["mode"] for row in rows.mode_rows(ROBOT)] == ["heave", "heave", "pitch", "pitch"]


def test_growth_of_every_size_is_a_plain_number():
    eigenvalues = Robot(2300, 2300).eigenvalues
    text = rows.table(rows.stability_rows(RK4, eigenvalues, [0.2, 0.1, 0.001]))
    assert not faults(text)
    assert "1." in text


def test_errors_of_bounded_unstable_and_overflowing_runs():
    def run(scheme, dt, tfinal):
        return simulate(ROBOT, BUMP, v=0, dt=dt, tfinal=tfinal, scheme=scheme, w0=[0, 0, 0.1, 0])

    runs = [run(CRANK_NICOLSON, 0.001, 2), run(RK4, 0.2, 2)]
    with np.errstate(all="ignore"):
        runs.append(run(RK4, 0.2, 200))
    assert not np.isfinite(runs[2].W).all()
    text = rows.table(rows.error_rows(runs, 0.003))
    assert not faults(text)
    assert "× 10²⁰" in text.replace("\u00a0", " ")
    assert "> 10³⁰⁸" in text
