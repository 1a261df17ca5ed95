"""One-step methods: order, stability and the matrices of a step, for tableaux of every kind."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import integrate
from scipy.linalg import block_diag

from suspension.exact import flat_ground
from suspension.road import FlatRoad, GaussianBump, road_input
from suspension.robot import Robot
from suspension.schemes import BACKWARD_EULER, CRANK_NICOLSON, EULER, RK4, Scheme
from suspension.simulation import simulate

HEUN = Scheme("Heun", 2, a=[[0, 0], [1, 0]], b=[1 / 2, 1 / 2], c=[0, 1])
KUTTA3 = Scheme(
    "Kutta 3", 3, a=[[0, 0, 0], [1 / 2, 0, 0], [-1, 2, 0]], b=[1 / 6, 2 / 3, 1 / 6], c=[0, 1 / 2, 1]
)
RADAU2 = Scheme(
    "Radau IIA", 3, a=[[5 / 12, -1 / 12], [3 / 4, 1 / 4]], b=[3 / 4, 1 / 4], c=[1 / 3, 1]
)
q = np.sqrt(3) / 6
GAUSS2 = Scheme(
    "Gauss-Legendre",
    4,
    a=[[1 / 4, 1 / 4 - q], [1 / 4 + q, 1 / 4]],
    b=[1 / 2, 1 / 2],
    c=[1 / 2 - q, 1 / 2 + q],
)
DORMAND_PRINCE = Scheme(
    "Dormand-Prince 5",
    5,
    np.pad(integrate.RK45.A, ((0, 0), (0, 1))),
    integrate.RK45.B,
    integrate.RK45.C,
)
DOP853 = Scheme("Dormand-Prince 8", 8, integrate.DOP853.A, integrate.DOP853.B, integrate.DOP853.C)

SMALL = [EULER, HEUN, KUTTA3, RK4, BACKWARD_EULER, CRANK_NICOLSON, RADAU2, GAUSS2]
EXPLICIT = [EULER, HEUN, KUTTA3, RK4]
A_STABLE = [BACKWARD_EULER, CRANK_NICOLSON, RADAU2, GAUSS2]
SYMMETRIC = Robot(800, 800)
LOPSIDED = Robot(900, 500, c1=1, c2=3, L1=0.09, L2=0.12)

quick = settings(derandomize=True, deadline=None, max_examples=60)
# On the imaginary axis or clearly left of it: in between, the limit itself is roundoff.
EIGENVALUES = st.lists(
    st.builds(
        lambda modulus, angle: modulus * np.exp(1j * angle),
        st.floats(0.1, 10),
        st.just(np.pi / 2) | st.floats(np.pi / 2 + 0.1, np.pi),
    ),
    min_size=1,
    max_size=4,
)


def named(schemes):
    return pytest.mark.parametrize("scheme", schemes, ids=lambda scheme: scheme.name)


def growth(scheme, z):
    return np.abs(scheme.stability_function(z))


def released_on_flat_ground(tfinal):
    w0 = [0, 0, 0.1, 0]
    return dict(robot=SYMMETRIC, road=FlatRoad(), v=0, w0=w0), flat_ground(SYMMETRIC, w0, tfinal)


def driven_over_the_bump(tfinal):
    robot, road, v = LOPSIDED, GaussianBump(), 1.2
    truth = integrate.solve_ivp(
        lambda t, w: robot.A @ w + robot.B @ road_input(robot, road, v, t) + robot.e,
        (0, tfinal),
        robot.equilibrium,
        method="DOP853",
        rtol=1e-13,
        atol=1e-16,
    ).y[:, -1]
    return dict(robot=robot, road=road, v=v), truth


@named([*SMALL, DORMAND_PRINCE])
@pytest.mark.parametrize("problem", [released_on_flat_ground, driven_over_the_bump])
def test_error_falls_with_the_order_of_the_scheme(scheme, problem):
    run, truth = problem(0.5)
    J = 32_000 // 2**scheme.order // np.array([4, 2, 1])
    errors = [
        np.linalg.norm(simulate(dt=0.5 / n, tfinal=0.5, scheme=scheme, **run).W[:, -1] - truth)
        for n in J
    ]
    assert -np.polyfit(np.log(J), np.log(errors), 1)[0] == pytest.approx(scheme.order, abs=0.1)


@named([*SMALL, DORMAND_PRINCE, DOP853])
def test_stability_function_is_the_exponential_up_to_the_order(scheme):
    # The mean over a circle of z^-k (R(z) - e^z) is the k-th Taylor coefficient of the difference.
    z = 0.5 * np.exp(2j * np.pi * np.arange(64) / 64)
    difference = scheme.stability_function(z) - np.exp(z)
    taylor = np.array([np.mean(difference / z**k) for k in range(scheme.order + 2)])
    assert np.abs(taylor[:-1]).max() < 1e-12
    assert np.abs(taylor[-1]) > 1e-8


@named([*SMALL, DORMAND_PRINCE, DOP853])
def test_stability_function_is_the_formula_of_the_tableau(scheme):
    rng = np.random.default_rng(1)
    z = rng.normal(size=(3, 4)) + 1j * rng.normal(size=(3, 4)) - 2
    s = len(scheme.b)
    stages = np.eye(s) - z[..., None, None] * scheme.a
    R = 1 + z * (np.linalg.solve(stages, np.ones((3, 4, s, 1)))[..., 0] @ scheme.b)
    np.testing.assert_allclose(scheme.stability_function(z), R, rtol=0, atol=1e-10)


def test_stability_function_keeps_shapes_and_is_infinite_at_a_pole():
    assert RK4.stability_function(-1).shape == ()
    assert RK4.stability_function(np.zeros((2, 0))).shape == (2, 0)
    assert BACKWARD_EULER.stability_function(1) == np.inf
    assert RK4.stability_function(1e200) == np.inf


@named([CRANK_NICOLSON, GAUSS2])
@quick
@given(y=st.floats(-1e6, 1e6))
def test_growth_is_one_on_the_imaginary_axis(scheme, y):
    assert growth(scheme, 1j * y) == pytest.approx(1, abs=4e-15)


@pytest.mark.parametrize("eigenvalue, limit", [(1j, 2 * np.sqrt(2)), (-1, 2.785293563405282)])
def test_limits_of_rk4_on_the_axes(eigenvalue, limit):
    assert RK4.max_stable_dt([eigenvalue]) == pytest.approx(limit, rel=1e-14)
    assert RK4.is_stable([eigenvalue], limit * (1 - 1e-12))
    assert not RK4.is_stable([eigenvalue], limit * (1 + 1e-12))


@pytest.mark.parametrize(
    "scheme, eigenvalue, limit",
    [
        (EULER, -4, 0.5),
        (EULER, 1j, 0),
        (EULER, -1 + 1j, 1),
        (HEUN, -4, 0.5),
        (HEUN, 1j, 0),
        (KUTTA3, 1j, np.sqrt(3)),
        (BACKWARD_EULER, 1j, np.inf),
        (CRANK_NICOLSON, -1, np.inf),
        (CRANK_NICOLSON, 1j, np.inf),
        (CRANK_NICOLSON, 0.1 + 1j, 0),
        (RK4, 0, np.inf),
    ],
)
def test_limits_known_by_hand(scheme, eigenvalue, limit):
    dt = scheme.max_stable_dt([eigenvalue])
    assert type(dt) is float and dt == pytest.approx(limit, rel=1e-14)


@pytest.mark.slow
@named(SMALL)
@quick
@given(eigenvalues=EIGENVALUES)
def test_is_stable_agrees_with_max_stable_dt(scheme, eigenvalues):
    limit = scheme.max_stable_dt(eigenvalues)
    if limit > 0:
        for part in (1e-3, 0.1, 0.5, 0.99, 1 - 1e-9):
            assert scheme.is_stable(eigenvalues, part * min(limit, 1e3))
    if limit < np.inf:
        too_long = limit * (1 + 1e-6) if limit > 0 else 1 / np.abs(eigenvalues).min()
        assert not scheme.is_stable(eigenvalues, too_long)


@named([*SMALL, DORMAND_PRINCE, DOP853])
@pytest.mark.parametrize("angle", np.pi * np.array([0.5, 0.55, 0.6, 0.75, 0.9, 1]))
def test_max_stable_dt_is_where_a_brute_force_scan_first_sees_growth(scheme, angle):
    r, step = np.linspace(0.05, 20, 20_000, retstep=True)
    grows = growth(scheme, r * np.exp(1j * angle)) > 1 + 1e-10
    limit = scheme.max_stable_dt([np.exp(1j * angle)])
    if not grows.any():
        assert limit == np.inf
    elif grows[0]:
        assert limit <= r[0]
    else:
        assert abs(limit - r[grows.argmax()]) < 10 * step


@quick
@given(
    k=st.tuples(st.floats(10, 1e5), st.floats(10, 1e5)),
    m=st.floats(0.1, 1000),
    Izz=st.floats(1e-3, 10),
    L=st.tuples(st.floats(0.02, 2), st.floats(0.02, 2)),
)
def test_limit_of_any_undamped_robot_is_set_by_its_fastest_mode(k, m, Izz, L):
    robot = Robot(*k, m=m, Izz=Izz, L1=L[0], L2=L[1], c1=0, c2=0)
    limit = 2 * np.sqrt(2) / np.abs(robot.eigenvalues).max()
    assert RK4.max_stable_dt(robot.eigenvalues) == pytest.approx(limit, rel=1e-9)
    assert CRANK_NICOLSON.max_stable_dt(robot.eigenvalues) == np.inf


@named(A_STABLE)
def test_a_stable_schemes_are_stable_for_any_step(scheme):
    assert scheme.max_stable_dt(LOPSIDED.eigenvalues) == np.inf
    assert all(scheme.is_stable(LOPSIDED.eigenvalues, dt) for dt in np.logspace(-6, 3, 46))


def test_verdicts_of_questions_4_and_7():
    steps = (0.2, 0.1, 0.001)
    assert [CRANK_NICOLSON.is_stable(SYMMETRIC.eigenvalues, dt) for dt in steps] == [True] * 3
    assert [RK4.is_stable(SYMMETRIC.eigenvalues, dt) for dt in steps] == [False, False, True]


@named([*SMALL, DORMAND_PRINCE])
@pytest.mark.parametrize("n", [40, 41, 400])
def test_boundary_has_growth_one_and_is_symmetric(scheme, n):
    points = scheme.boundary(n)
    assert points.shape == (n, 2)
    z = points @ [1, 1j]
    np.testing.assert_allclose(growth(scheme, z), 1, rtol=0, atol=1e-9)
    np.testing.assert_allclose(z[::-1], z.conj(), rtol=0, atol=1e-12)
    # One way round: the upper half of the curve never enters the lower half-plane.
    assert z[n // 2 + n % 2 :].imag.min() > -1e-12


@named([*EXPLICIT, BACKWARD_EULER])
def test_boundary_encloses_the_region_counted_on_a_grid(scheme):
    x, y = scheme.boundary(1000).T
    enclosed = abs(x @ np.roll(y, 1) - y @ np.roll(x, 1)) / 2
    grid, cell = np.linspace(-4, 4, 801, retstep=True)
    inside = growth(scheme, grid + 1j * grid[:, None]) <= 1
    counted = (~inside if scheme is BACKWARD_EULER else inside).sum() * cell**2
    assert enclosed == pytest.approx(counted, rel=5e-3)


@named([*SMALL, DOP853])
def test_one_step_solves_the_stage_equations(scheme):
    rng, n, s, dt = np.random.default_rng(2), 3, len(scheme.b), 0.1
    A, w, F = rng.normal(size=(n, n)), rng.normal(size=n), rng.normal(size=(s, n))
    # k_i = A (w + dt sum_j a_ij k_j) + F_i, all stages at once, entry by entry.
    M = block_diag(*[np.eye(n)] * s)
    for i in range(s):
        for j in range(s):
            M[i * n : (i + 1) * n, j * n : (j + 1) * n] -= dt * scheme.a[i, j] * A
    k = np.linalg.solve(M, (A @ w + F).ravel()).reshape(s, n)
    R, G = scheme.one_step(A, dt)
    assert R.shape == (n, n) and G.shape == (s, n, n)
    step = R @ w + sum(Gi @ Fi for Gi, Fi in zip(G, F, strict=True))
    np.testing.assert_allclose(step, w + dt * scheme.b @ k, rtol=0, atol=1e-13)


@named(SMALL)
@pytest.mark.parametrize("dt", [1e-3, 0.1])
def test_one_step_grows_as_the_stability_function_says(scheme, dt):
    R, _ = scheme.one_step(LOPSIDED.A, dt)
    expected = scheme.stability_function(LOPSIDED.eigenvalues * dt)
    distance = np.abs(np.subtract.outer(np.linalg.eigvals(R), expected))
    assert max(distance.min(axis=0).max(), distance.min(axis=1).max()) < 1e-11 * np.linalg.norm(R)


def test_one_step_takes_a_stack_of_systems():
    A = np.stack([SYMMETRIC.A, LOPSIDED.A, LOPSIDED.A / 2])[:, None]
    R, G = GAUSS2.one_step(A, 0.01)
    assert R.shape == (3, 1, 4, 4) and G.shape == (2, 3, 1, 4, 4)
    for i in range(3):
        R_i, G_i = GAUSS2.one_step(A[i, 0], 0.01)
        np.testing.assert_allclose(R[i, 0], R_i, rtol=0, atol=1e-14 * np.abs(R_i).max())
        np.testing.assert_allclose(G[:, i, 0], G_i, rtol=0, atol=1e-14 * np.abs(G_i).max())


def test_a_tableau_is_copied_and_cannot_be_changed():
    a = np.zeros((1, 1))
    scheme = Scheme("Euler", 1, a, [1], [0])
    a[0, 0] = 1.0
    assert scheme.a[0, 0] == 0
    with pytest.raises(ValueError, match="read-only"):
        scheme.b[0] = 2.0


@pytest.mark.parametrize(
    "change, why",
    [
        ({"a": [[0, 0], [1, 0], [0, 0]]}, r"^a must have shape \(2, 2\), got \(3, 2\)"),
        ({"c": [0]}, r"^c must have shape \(2\), got \(1,\)"),
        ({"b": [[1 / 2, 1 / 2]]}, r"^b must have shape \(n\)"),
        ({"b": [1 / 2, 1 / 3]}, r"^b must sum to 1, got 0\.83"),
        ({"c": [0, 1 / 2]}, "^c must be the row sums of a"),
        ({"a": [[0, 0], [np.nan, 0]]}, "^a must be finite everywhere, got nan"),
        ({"order": 0}, "^order must be a whole number >= 1, got 0"),
        ({"order": 1.5}, "^order must be a whole number >= 1, got 1.5"),
    ],
)
def test_an_inconsistent_tableau_is_refused_by_name(change, why):
    heun = {"name": "Heun", "order": 2, "a": HEUN.a, "b": HEUN.b, "c": HEUN.c}
    with pytest.raises(ValueError, match=why):
        Scheme(**(heun | change))


@pytest.mark.parametrize(
    "call, name",
    [
        (lambda: RK4.one_step(np.ones((3, 4)), 0.1), "A"),
        (lambda: RK4.one_step(np.ones(4), 0.1), "A"),
        (lambda: RK4.one_step([[np.nan]], 0.1), "A"),
        (lambda: RK4.one_step([[1, 2], [3]], 0.1), "A"),
        (lambda: RK4.one_step([[1j]], 0.1), "A"),
        (lambda: RK4.one_step(np.eye(4), 0), "dt"),
        (lambda: RK4.one_step(np.eye(4), np.nan), "dt"),
        (lambda: RK4.is_stable([-1], -0.1), "dt"),
        (lambda: RK4.is_stable([np.nan], 0.1), "eigenvalues"),
        (lambda: RK4.max_stable_dt([np.inf]), "eigenvalues"),
        (lambda: RK4.boundary(3), "n"),
        (lambda: RK4.boundary(10.5), "n"),
    ],
)
def test_a_bad_argument_is_refused_by_name(call, name):
    with pytest.raises(ValueError, match=f"^{name} must be"):
        call()


def test_a_matrix_that_is_not_square_is_refused():
    with pytest.raises(ValueError, match="A must be square"):
        RK4.one_step(np.zeros((3, 4)), 0.1)


@pytest.mark.parametrize("n", [4, 5, 6, 400, 401])
def test_a_boundary_has_as_many_different_points_as_asked_for(n):
    points = RK4.boundary(n)
    assert len(np.unique(points.round(9), axis=0)) == n


def test_a_boundary_of_too_many_points_is_refused():
    with pytest.raises(ValueError, match="n must be at most"):
        RK4.boundary(10**5 + 1)
