"""The exact first loss of contact, and one place for all that answers for contact."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from suspension import contact, critical, least_force
from suspension.contact import (
    Loss,
    Regimes,
    exact_loss,
    is_lost,
    margin,
    minima,
    regimes,
    regimes_between,
)
from suspension.exact import Crossing
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import RK4
from suspension.simulation import simulate

BUMP = GaussianBump()
ROBOT = Robot(800, 800)
UNSYMMETRIC = Robot(500, 1100, L1=0.09, L2=0.13, c1=1, c2=4)
SHORT = Robot(800, 800, L1=1e-4, L2=1e-4)  # both wheels lift nearly at once


@pytest.mark.parametrize("v", [0.44, 0.7, 1.2, 5, 7.9, 20.5, 30])
@pytest.mark.parametrize("robot", [ROBOT, UNSYMMETRIC])
def test_a_finely_sampled_run_loses_contact_just_after_the_exact_moment(robot, v):
    run = simulate(robot, BUMP, v=v, dt=1.25 / v / 20_000, tfinal=1.25 / v, scheme=RK4)
    loss = exact_loss(robot, BUMP, v)
    if margin(robot, BUMP, v) > 0:
        assert loss is None and run.loss is None
    else:
        assert loss.wheel == run.loss.wheel
        assert -1e-9 <= run.loss.t - loss.t <= run.dt * (1 + 1e-6)


@pytest.mark.parametrize(
    ("robot", "v"),
    [(ROBOT, 0.45), (ROBOT, 1.2), (ROBOT, 25), (UNSYMMETRIC, 3), (SHORT, 0.8), (SHORT, 30)],
)
def test_the_force_is_zero_at_the_exact_loss_and_positive_before(robot, v):
    loss, crossing = exact_loss(robot, BUMP, v), Crossing(robot, BUMP, v)
    before = loss.t * np.concatenate([np.linspace(0, 1, 5000)[:-1], 1 - np.geomspace(1e-9, 1e-2)])
    assert (least_force.exact_forces(crossing, before)[0] > 0).all()
    assert abs(least_force.exact_forces(crossing, np.array([loss.t]))[0, loss.wheel - 1, 0]) < 1e-11


def test_a_dip_too_short_for_the_samples_is_not_missed():
    """Just inside a critical speed the force is negative for a moment only."""
    v = critical.critical_speeds(ROBOT, BUMP, 5, 10)[0] * (1 - 1e-10)
    loss, least = exact_loss(ROBOT, BUMP, v), min(minima(ROBOT, BUMP, v), key=lambda m: m.force)
    assert -1e-8 < least.force < 0
    assert loss.wheel == least.wheel and 0 < least.t - loss.t < 1e-5
    assert simulate(ROBOT, BUMP, v=v, dt=1e-4, tfinal=1.25 / v).loss is None


def test_no_loss_where_contact_is_kept_nor_before_the_end_of_a_short_run():
    assert exact_loss(ROBOT, BUMP, 0.25) is None
    lost = exact_loss(ROBOT, BUMP, 1.2)
    assert exact_loss(ROBOT, BUMP, 1.2, tfinal=0.99 * lost.t) is None
    assert exact_loss(ROBOT, BUMP, 1.2, tfinal=1.01 * lost.t).t == pytest.approx(lost.t, rel=1e-12)


def test_a_robot_that_starts_on_a_falling_slope_loses_contact_at_once():
    steep = GaussianBump(height=0.05, sigma=0.01, centre=0.097)
    assert exact_loss(ROBOT, steep, 30.0, tfinal=0.04) == Loss(2, 0.0)


def test_a_loss_needs_a_moving_robot():
    with pytest.raises(ValueError, match="v must be a finite number > 0, got 0"):
        exact_loss(ROBOT, BUMP, 0)


# --- verdicts over a range --------------------------------------------------------------------


quick = settings(derandomize=True, deadline=None)
ranges = st.lists(st.floats(0.01, 100), min_size=2, max_size=8, unique=True).map(sorted)


@pytest.mark.slow
@pytest.mark.parametrize("robot", [ROBOT, UNSYMMETRIC], ids=["symmetric", "unsymmetric"])
def test_regimes_are_the_verdicts_of_the_margin_at_any_speed(robot):
    found = regimes(robot, BUMP, 0.1, 30)
    speeds = np.random.default_rng(1).uniform(np.log(0.1), np.log(30), (4, 25))
    speeds = np.exp(speeds)
    verdicts = [[margin(robot, BUMP, v) <= 0 for v in row] for row in speeds]
    np.testing.assert_array_equal(found(speeds), verdicts)
    np.testing.assert_array_equal(found.critical, critical.critical_speeds(robot, BUMP, 0.1, 30))
    assert found.edges[[0, -1]].tolist() == [0.1, 30]
    assert (found.lost[1:] != found.lost[:-1]).all()  # kept and lost take turns


@quick
@given(edges=ranges, seed=st.integers(0, 255), part=st.floats(0.01, 0.99))
def test_a_value_has_the_verdict_of_its_range_and_an_edge_that_of_a_zero_margin(edges, seed, part):
    lost = [bool(seed >> i & 1) for i in range(len(edges) - 1)]
    found = Regimes(edges, lost)
    inside = [low + part * (high - low) for low, high in pairwise(edges)]
    apart = [low < v < high for (low, high), v in zip(pairwise(edges), inside, strict=True)]
    verdicts = found(inside)
    assert all(a == b for a, b, clear in zip(verdicts, lost, apart, strict=True) if clear)
    at_edges = [a or b for a, b in zip([lost[0], *lost], [*lost, lost[-1]], strict=True)]
    np.testing.assert_array_equal(found(edges), at_edges)


@quick
@given(edges=ranges, seed=st.integers(0, 255))
def test_spans_of_kept_and_lost_make_up_the_whole(edges, seed):
    lost = [bool(seed >> i & 1) for i in range(len(edges) - 1)]
    found = Regimes(edges, lost)
    for verdict in (True, False):
        spans = found.spans(lost=verdict)
        assert (spans[:-1, 1] < spans[1:, 0]).all()  # neighbours are one
        own = sum(
            b - a for (a, b), gone in zip(pairwise(edges), lost, strict=True) if gone == verdict
        )
        assert np.diff(spans).sum() == pytest.approx(own)
        middles = np.sqrt(spans[:, 0] * spans[:, 1])
        assert (found(middles) == verdict).all()


@pytest.mark.parametrize(
    ("lost", "regained"),
    [
        ([0], []),
        ([1], []),
        ([0, 1], []),
        ([1, 0], [[1, 2]]),
        ([0, 1, 0], [[2, 3]]),
        ([1, 1, 0], [[2, 3]]),
        ([0, 0, 1, 0, 1, 0, 0], [[3, 4], [5, 7]]),
    ],
)
def test_contact_is_regained_where_it_is_kept_above_a_loss(lost, regained):
    found = Regimes(np.arange(len(lost) + 1) + 1e-9, lost)
    assert found.regained.shape == (len(regained), 2)
    assert found.regained == pytest.approx(np.reshape(regained, (-1, 2)))


@quick
@given(zeros=ranges, touched=st.floats(0.01, 100))
def test_regimes_between_known_edges_are_the_signs_there(zeros, touched):
    """A polynomial in ln v that changes its sign at each of `zeros`, and at `touched` does not."""
    assume(min(np.diff(np.log([0.001, *sorted([*zeros, touched]), 1000]))) > 1e-6)

    def margin_at(v):
        x = np.log(v)
        return np.prod(x - np.log(zeros)) * (x - np.log(touched)) ** 2

    found = regimes_between(margin_at, [0.001, *sorted([*zeros, touched]), 1000.0])
    np.testing.assert_array_equal(found.critical, zeros)
    assert (found.lost[1:] != found.lost[:-1]).all() and not found.lost[-1]


def test_one_value_has_one_verdict_and_an_array_keeps_its_shape():
    found = Regimes([1, 2, 3], [False, True])
    assert found(1.5).shape == () and not found(1.5) and found(2.5)
    assert found(np.full((2, 0, 3), 1.5)).shape == (2, 0, 3)


def test_regimes_cannot_be_written_to_from_outside():
    edges, lost = np.array([1.0, 2.0, 3.0]), np.array([False, True])
    found = Regimes(edges, lost)
    edges[1], lost[:] = 2.5, True
    assert found.critical.tolist() == [2.0] and found.lost.tolist() == [False, True]
    with pytest.raises(ValueError, match="read-only"):
        found.edges[0] = 0.5
    with pytest.raises(ValueError, match="read-only"):
        found.lost[0] = True


def test_regimes_read_as_an_answer():
    lines = str(regimes(ROBOT, BUMP, 7, 9)).splitlines()
    (v,) = critical.critical_speeds(ROBOT, BUMP, 7, 9)
    assert lines == [
        "Regimes(",
        f"  lost from 7 to {v:.6g} m/s",
        f"  kept from {v:.6g} to 9 m/s",
        ")",
    ]
    assert "kept from 300 to 400 N/m" in repr(Regimes([300, 400], [False], "N/m"))


def test_zero_is_lost():
    np.testing.assert_array_equal(is_lost([-1, 0, 5e-324]), [True, True, False])


def test_contact_is_where_every_verdict_is_found():
    for name in ("margin", "minima", "Minimum"):
        assert getattr(contact, name) is getattr(least_force, name)
    for name in ("critical_speeds", "critical_stiffness", "sensitivity"):
        assert getattr(contact, name) is getattr(critical, name)
