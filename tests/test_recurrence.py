"""Blocks of steps against the plain loop, for systems of any size and any number of cases."""

import numpy as np
import pytest

from suspension.recurrence import Discrete, Recurrence, abscissae
from suspension.schemes import CRANK_NICOLSON, EULER, RK4, Scheme

KUTTA38 = Scheme(
    "Kutta 3/8", 4, b=[1 / 8, 3 / 8, 3 / 8, 1 / 8], c=[0, 1 / 3, 2 / 3, 1],
    a=[[0, 0, 0, 0], [1 / 3, 0, 0, 0], [-1 / 3, 1, 0, 0], [1, -1, 1, 0]],
)  # fmt: skip
RIGHT = Scheme("right rectangle", 1, a=[[1]], b=[1], c=[1])  # asks at the end of a step only


def plain(A, B, C, D, x, u):
    """One step at a time, for one case."""
    y = []
    for un in u.T:
        y.append(C @ x + D @ un)
        x = A @ x + B @ un
    return np.array(y).T, x


def system(cases, n, p, o, seed=0):
    """Matrices of stable systems, a first state and inputs."""
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(*cases, n, n))
    A /= 1.1 * np.abs(np.linalg.eigvals(A)).max(axis=-1)[..., None, None]
    B, C, D = (rng.normal(size=(*cases, *shape)) for shape in ((n, p), (o, n), (o, p)))
    return A, B, C, D, rng.normal(size=(*cases, n)), lambda m: rng.normal(size=(*cases, p, m))


@pytest.mark.parametrize("block", [4, 16, 32])
@pytest.mark.parametrize("n, p, o", [(4, 4, 6), (1, 1, 1), (3, 5, 2)])
def test_blocks_are_the_plain_loop_at_every_length(n, p, o, block):
    *matrices, x, inputs = system((), n, p, o)
    recurrence = Recurrence(*matrices, block)
    for m in [*range(1, 2 * block + 2), 63 * block, 64 * block + 1, 65 * block, 5000]:
        u = inputs(m)
        y, end = recurrence(x, u)
        expected, last = plain(*matrices, x, u)
        scale = np.abs(expected).max()
        np.testing.assert_allclose(y, expected, rtol=0, atol=1e-12 * scale)
        if m % block == 0:
            np.testing.assert_allclose(end, last, rtol=0, atol=1e-12 * scale)


def test_every_case_runs_as_if_alone():
    *matrices, x, inputs = system((2, 3), 4, 2, 2)
    u = inputs(2000)
    y, end = Recurrence(*matrices)(x, u)
    for case in np.ndindex(2, 3):
        expected, last = plain(*(M[case] for M in matrices), x[case], u[case])
        np.testing.assert_allclose(y[case], expected, rtol=0, atol=1e-12 * np.abs(expected).max())
        np.testing.assert_allclose(end[case], last, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_cases_may_share_their_inputs():
    *matrices, x, inputs = system((3,), 4, 2, 2)
    recurrence, u = Recurrence(*matrices), inputs(1500)[0]
    shared = recurrence(x, u)
    for one, copied in zip(shared, recurrence(x, np.stack([u] * 3))):
        np.testing.assert_allclose(one, copied, rtol=0, atol=1e-12 * np.abs(copied).max())


def test_a_run_can_be_interrupted_after_a_block():
    *matrices, x, inputs = system((), 4, 2, 3)
    recurrence, u = Recurrence(*matrices), inputs(1000)
    whole, _ = recurrence(x, u)
    first, x = recurrence(x, u[:, :320])
    np.testing.assert_allclose(np.hstack([first, recurrence(x, u[:, 320:])[0]]), whole, atol=1e-12)


def test_no_output_depends_on_a_later_input():
    *matrices, x, inputs = system((), 4, 2, 3)
    recurrence, u = Recurrence(*matrices), inputs(200)
    before, _ = recurrence(x, u)
    u[:, 137] += 1
    after, _ = recurrence(x, u)
    np.testing.assert_array_equal(after[:, :137], before[:, :137])
    assert (after[:, 137:150] != before[:, 137:150]).all()


@pytest.mark.parametrize("scheme", [EULER, RIGHT, CRANK_NICOLSON, RK4, KUTTA38],
                         ids=lambda scheme: scheme.name)  # fmt: skip
def test_a_discrete_system_takes_the_steps_of_its_scheme(scheme):
    A, B, C, D, z, _ = system((), 4, 2, 3)
    dt, m = 0.3, 100
    t = dt * np.arange(m)

    def f(t):
        return np.array([np.cos(t), np.sin(2 * t)])

    R, G = scheme.one_step(A, dt)
    expected, state = [], z
    for s in t:
        expected.append(C @ state + D @ f(s))
        state = R @ state + sum(Gi @ B @ f(s + c * dt) for Gi, c in zip(G, scheme.c))
    run = Discrete(scheme, A, B, C, D, dt)
    forcing = np.concatenate([f(t + c * dt) for c in run.abscissae])
    start = run.start(z, forcing)
    for y, _ in (run(start, forcing), run._by_steps(start, forcing)):
        np.testing.assert_allclose(y, np.transpose(expected), rtol=1e-11, atol=1e-11)


def test_overflowing_powers_do_not_reach_finite_outputs():
    A = np.diag([1e30, 0.5])  # A^16 overflows, and the first state is never excited
    run = Discrete(RIGHT, A, np.array([[0.0], [1.0]]), np.eye(2), np.zeros((2, 1)), 1.0)
    run.R[...] = A
    run.recurrence = Recurrence(A, run.H + A @ run.H1, np.eye(2), run.H1)
    f = np.ones((1, 100))
    assert not np.isfinite(run.recurrence(run.start(np.zeros(2), f), f)[0]).all()
    y, _ = run(run.start(np.zeros(2), f), f)
    assert np.isfinite(y).all() and not y[0].any() and (y[1, 1:] > 0).all()


@pytest.mark.parametrize("scheme, expected", [
    (EULER, [0]), (RIGHT, [0]), (CRANK_NICOLSON, [0]), (RK4, [0, 1 / 2]),
    (KUTTA38, [0, 1 / 3, 2 / 3]),
])  # fmt: skip
def test_forcing_is_asked_for_once_at_each_place(scheme, expected):
    np.testing.assert_allclose(abscissae(scheme), expected)
