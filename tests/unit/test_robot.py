"""The robot's matrices against the problem's equations, written out by hand."""

from dataclasses import FrozenInstanceError, fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension.robot import Robot

quick = settings(derandomize=True, deadline=None, max_examples=60)
lengths, damping = st.floats(0.02, 2), st.floats(0, 100)
ROBOTS = st.builds(
    Robot,
    k1=st.floats(10, 1e5),
    k2=st.floats(10, 1e5),
    m=st.floats(0.1, 100),
    Izz=st.floats(1e-3, 10),
    L1=lengths,
    L2=lengths,
    c1=damping,
    c2=damping,
)
SYMMETRIC = st.builds(
    lambda k, L, c, **rest: Robot(k, k, L1=L, L2=L, c1=c, c2=c, **rest),
    k=st.floats(10, 1e5),
    L=lengths,
    c=damping,
    m=st.floats(0.1, 100),
    Izz=st.floats(1e-3, 10),
)
VECTORS = st.lists(st.floats(-1, 1), min_size=4, max_size=4).map(np.array)
TABLE_1 = Robot(800, 800)


def mirrored(robot):
    """The robot seen from the other side: its rear wheel is the front wheel."""
    return replace(
        robot, k1=robot.k2, k2=robot.k1, c1=robot.c2, c2=robot.c1, L1=robot.L2, L2=robot.L1
    )


def test_defaults_are_table_1():
    parameters = {
        "g": 9.81,
        "m": 1.456,
        "Izz": 0.012,
        "L1": 0.107,
        "L2": 0.107,
        "c1": 1.5,
        "c2": 1.5,
    }
    assert {name: getattr(TABLE_1, name) for name in parameters} == parameters


@quick
@given(robot=ROBOTS)
def test_entries_of_A_and_B_are_the_symbols_of_question_2(robot):
    k1, k2, m, Izz = robot.k1, robot.k2, robot.m, robot.Izz
    c1, c2, L1, L2 = robot.c1, robot.c2, robot.L1, robot.L2
    A = [
        [0, 1, 0, 0],
        [-(k1 + k2) / m, -(c1 + c2) / m, (k1 * L1 - k2 * L2) / m, (c1 * L1 - c2 * L2) / m],
        [0, 0, 0, 1],
        [
            (k1 * L1 - k2 * L2) / Izz,
            (c1 * L1 - c2 * L2) / Izz,
            -(k1 * L1**2 + k2 * L2**2) / Izz,
            -(c1 * L1**2 + c2 * L2**2) / Izz,
        ],
    ]
    B = [
        [0, 0, 0, 0],
        [k1 / m, k2 / m, c1 / m, c2 / m],
        [0, 0, 0, 0],
        [-k1 * L1 / Izz, k2 * L2 / Izz, -c1 * L1 / Izz, c2 * L2 / Izz],
    ]
    # Differences such as k1 L1 - k2 L2 may cancel: roundoff is measured against their terms.
    atol = 1e-14 * np.abs(robot.A).max()
    np.testing.assert_allclose(robot.A, A, rtol=1e-13, atol=atol)
    np.testing.assert_allclose(robot.B, B, rtol=1e-13, atol=0)


@quick
@given(robot=ROBOTS, w=VECTORS, u=VECTORS)
def test_matrices_say_what_equations_2_5_and_6_say(robot, w, u):
    (Y, Yt, theta, thetat), (h1, h2, h1t, h2t) = w, u
    Y1, Y1t = Y - robot.L1 * theta, Yt - robot.L1 * thetat
    Y2, Y2t = Y + robot.L2 * theta, Yt + robot.L2 * thetat
    N1 = robot.k1 * (h1 - Y1) + robot.c1 * (h1t - Y1t)
    N2 = robot.k2 * (h2 - Y2) + robot.c2 * (h2t - Y2t)
    Ytt = -robot.g + (N1 + N2) / robot.m
    thetatt = (N2 * robot.L2 - N1 * robot.L1) / robot.Izz
    big = max(robot.k1, robot.k2) * (1 + max(robot.L1, robot.L2)) ** 2
    np.testing.assert_allclose(robot.C @ w + robot.D @ u, [N1, N2], atol=1e-14 * big)
    wt = robot.A @ w + robot.B @ u + robot.e
    np.testing.assert_allclose(
        wt, [Yt, Ytt, thetat, thetatt], atol=1e-14 * big * (1 / robot.m + 1 / robot.Izz)
    )


@quick
@given(robot=SYMMETRIC)
def test_heave_and_pitch_of_a_symmetric_robot_do_not_feel_each_other(robot):
    assert not robot.A[:2, 2:].any() and not robot.A[2:, :2].any()


@quick
@given(robot=SYMMETRIC)
def test_eigenvalues_of_a_symmetric_robot_are_those_of_equation_7(robot):
    k, c, m, L, Izz = robot.k1, robot.c1, robot.m, robot.L1, robot.Izz
    expected = []
    for beta, omega0_squared in ((c / m, 2 * k / m), (c * L**2 / Izz, 2 * k * L**2 / Izz)):
        omega_d = np.sqrt(complex(omega0_squared - beta**2))
        expected += [-beta + 1j * omega_d, -beta - 1j * omega_d]
    # As sets: each one is found. Near critical damping the error is a square root of roundoff.
    distance = np.abs(np.subtract.outer(expected, robot.eigenvalues)) / np.abs(expected).max()
    assert max(distance.min(axis=0).max(), distance.min(axis=1).max()) < 1e-7


@quick
@given(robot=ROBOTS)
def test_eigenvalues_are_sorted_roots_of_the_characteristic_polynomial(robot):
    lam, scale = robot.eigenvalues, np.linalg.norm(robot.A)
    assert lam.shape == (4,) and lam.dtype == complex
    assert (np.diff(np.abs(lam)) >= -1e-9).all()
    np.testing.assert_allclose(lam.sum(), np.trace(robot.A), atol=1e-12 * scale)
    np.testing.assert_allclose(lam.prod(), np.linalg.det(robot.A), rtol=1e-8)
    for z in lam:
        smallest = np.linalg.svd(robot.A - z * np.eye(4), compute_uv=False)[-1]
        assert smallest < 1e-12 * scale


@quick
@given(robot=ROBOTS)
def test_a_passive_robot_has_no_growing_mode_and_an_undamped_one_no_decaying_mode(robot):
    scale = 1e-12 * np.linalg.norm(robot.A)
    assert robot.eigenvalues.real.max() <= scale
    undamped = replace(robot, c1=0, c2=0)
    assert np.abs(undamped.eigenvalues.real).max() <= 1e-12 * np.linalg.norm(undamped.A)


@quick
@given(robot=ROBOTS)
def test_at_rest_nothing_moves_and_the_forces_carry_the_weight(robot):
    w = robot.equilibrium
    assert w[1] == w[3] == 0
    terms = np.abs(robot.A) @ np.abs(w)
    assert (np.abs(robot.A @ w + robot.e) <= 1e-13 * terms).all()
    N1, N2 = robot.C @ w
    weight = robot.m * robot.g
    small = 1e-12 * (np.abs(robot.C) @ np.abs(w)).max()
    assert abs(N1 + N2 - weight) <= small
    assert abs(N1 * robot.L1 - N2 * robot.L2) <= small * (robot.L1 + robot.L2)


@quick
@given(robot=SYMMETRIC)
def test_equilibrium_of_a_symmetric_robot_is_equation_8(robot):
    expected = [-robot.m * robot.g / (2 * robot.k1), 0, 0, 0]
    np.testing.assert_allclose(robot.equilibrium, expected, rtol=1e-14, atol=0)


@quick
@given(robot=ROBOTS)
def test_the_mirror_image_pitches_the_other_way(robot):
    image, flip = mirrored(robot), np.diag([1.0, 1, -1, -1])
    np.testing.assert_array_equal(image.A, flip @ robot.A @ flip)
    np.testing.assert_array_equal(image.C, robot.C[::-1] @ flip)
    np.testing.assert_allclose(image.equilibrium, flip @ robot.equilibrium, rtol=1e-9)
    assert mirrored(image) == robot


def test_gravity_may_be_absent():
    assert not Robot(800, 600, g=0).equilibrium.any()


def test_a_robot_and_its_matrices_cannot_be_changed_by_accident():
    with pytest.raises(FrozenInstanceError):
        TABLE_1.m = 2.0
    for name in ("A", "B", "C", "D", "e", "equilibrium", "eigenvalues"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(TABLE_1, name)[...] = 0
    assert replace(TABLE_1, m=2.0).A[1, 0] == -800.0


@pytest.mark.parametrize("name", [field.name for field in fields(Robot)])
@pytest.mark.parametrize("value", [np.nan, np.inf, -1, None, "stiff"])
def test_a_parameter_out_of_range_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=f"^{name} must be a finite number >=? 0, got {value!r}$"):
        Robot(**({"k1": 800, "k2": 800} | {name: value}))


@pytest.mark.parametrize("name", ["k1", "k2", "m", "Izz", "L1", "L2"])
def test_what_must_be_positive_may_not_be_zero(name):
    with pytest.raises(ValueError, match=f"^{name} must be a finite number > 0, got 0$"):
        Robot(**({"k1": 800, "k2": 800} | {name: 0}))


def test_eigenvectors_stand_in_the_order_of_the_eigenvalues():
    robot = Robot(900, 500, c1=1, c2=3, L1=0.09, L2=0.12)
    assert robot.eigenvectors.shape == (4, 4)
    product = robot.A @ robot.eigenvectors
    np.testing.assert_allclose(product, robot.eigenvectors * robot.eigenvalues, atol=1e-10)
    assert np.linalg.matrix_rank(robot.eigenvectors) == 4


@pytest.mark.parametrize("k, m", [(800, 1.456), (30, 7.0)])
def test_modes_of_a_symmetric_robot_are_all_heave_or_all_pitch(k, m):
    robot = Robot(k, k, m=m)
    heave = np.isclose(np.abs(robot.eigenvalues) ** 2, 2 * k / m)
    assert heave.sum() == 2
    assert robot.heave_share == pytest.approx(heave.astype(float))


@quick
@given(robot=ROBOTS)
def test_the_share_of_heave_is_a_share_from_either_side(robot):
    assert ((robot.heave_share >= 0) & (robot.heave_share <= 1)).all()
    if np.min(np.abs(np.subtract.outer(robot.eigenvalues, robot.eigenvalues) + np.eye(4))) > 1e-3:
        assert np.allclose(mirrored(robot).heave_share, robot.heave_share, atol=1e-6)


def test_a_twin_is_symmetric_and_nothing_else_changes():
    robot = Robot(700, 900, m=2.0, L1=0.08, L2=0.12, c1=1.0, c2=2.0)
    twin = robot.twin
    assert twin == Robot(800, 800, m=2.0, L1=0.1, L2=0.1, c1=1.5, c2=1.5)
    assert twin.twin is twin
