"""Checks of the workbook's Crank-Nicolson: the matrix, one step, the loop."""

import numpy as np

from suspension.practice import _loops
from suspension.practice.feedback import (
    Wrong,
    check,
    compare,
    must_have_shape,
    name_mistake,
    near,
    off,
    told,
)
from suspension.robot import Robot

__all__ = ["check_cn_step", "check_crank_nicolson", "check_state_matrix"]

STATE = ["Y", "Y'", "θ", "θ'"]


def some_robot(rng):
    """A robot with nothing equal in front and behind."""
    k1, k2 = rng.uniform(400, 1500, 2)
    return Robot(
        k1,
        k2,
        m=rng.uniform(1, 3),
        Izz=rng.uniform(0.01, 0.03),
        L1=rng.uniform(0.05, 0.15),
        L2=rng.uniform(0.16, 0.25),
        c1=rng.uniform(0.5, 2),
        c2=rng.uniform(2.5, 5),
    )


def _matrix(r, power=2, coupling=(1, 1), heave=None, pitch=None):
    """Of a robot, or with something in it changed."""
    heave, pitch = heave or r.m, pitch or r.Izz
    kL, cL = r.k1 * r.L1 - r.k2 * r.L2, r.c1 * r.L1 - r.c2 * r.L2
    kLL, cLL = (s1 * r.L1**power + s2 * r.L2**power for s1, s2 in ((r.k1, r.k2), (r.c1, r.c2)))
    s, q = coupling
    A = np.zeros((4, 4))
    A[0, 1] = A[2, 3] = 1
    A[1] = np.array([-(r.k1 + r.k2), -(r.c1 + r.c2), s * kL, s * cL]) / heave
    A[3] = np.array([q * kL, q * cL, -kLL, -cLL]) / pitch
    return A


def _times_rows(*factors):
    return lambda r: _matrix(r) * np.array(factors)[:, None]


def _summed(r):
    """Where the moments of both axles are given one sign."""
    A = _matrix(r)
    kL, cL = r.k1 * r.L1 + r.k2 * r.L2, r.c1 * r.L1 + r.c2 * r.L2
    A[1, 2:], A[3, :2] = np.array([-kL, -cL]) / r.m, np.array([-kL, -cL]) / r.Izz
    return A


@check("state_matrix(robot)", "forces and moments of both axles are where they belong.")
def check_state_matrix(state_matrix, rng):
    """Whether ``state_matrix(robot)`` is A of ``w' = A w + F`` for any robot."""

    def fails(A, r):
        wanted = _matrix(r)
        i, j = np.argwhere(off(A, wanted))[0]
        rate = [r"Y'", "the acceleration Y''", "θ'", "the angular acceleration θ''"][i]
        return (
            f"Row {i + 1}, column {j + 1}, which says what {STATE[j]} does to {rate}, is "
            f"{told(A[i, j], wanted[i, j])} for one of the robots tried."
        )

    mistakes = {
        "The signs of rows 2 and 4 are turned round: a robot that is lifted is pulled down, so "
        "A[1, 0] is negative.": _times_rows(1, -1, 1, -1),
        "The dampers have the wrong sign: they would feed the motion, trace A must be negative.": (
            lambda r: np.where([[0, 0, 0, 0], [0, 1, 0, 1]] * 2, -_matrix(r), _matrix(r))
        ),
        "Front and rear have changed places in the coupling of Y and θ: θ > 0 lifts the front, "
        "which wheel is 1?": lambda r: _matrix(r, coupling=(-1, -1)),
        "The coupling in row 2 has the wrong sign; that in row 4 is right, and both are the same "
        "k1 L1 − k2 L2.": lambda r: _matrix(r, coupling=(-1, 1)),
        "The coupling in row 4 has the wrong sign; that in row 2 is right, and both are the same "
        "k1 L1 − k2 L2.": lambda r: _matrix(r, coupling=(1, -1)),
        "In the coupling of Y and θ both axles have one sign. The front one rises with θ, the "
        "rear one sinks: k1 L1 − k2 L2.": _summed,
        "Y and θ do not feel each other: that holds for a symmetric robot only.": (
            lambda r: _matrix(r, coupling=(0, 0))
        ),
        "Rows 1 and 3 are empty: that Y' and θ' are the rates of Y and θ must be said, too.": (
            _times_rows(0, 1, 0, 1)
        ),
        "In row 4 the lever stands once: force is L times the pitch, its moment L times the force, "
        "which makes L².": lambda r: _matrix(r, power=1),
        "Row 4 is divided by m: moments are divided by the moment of inertia Izz.": (
            lambda r: _matrix(r, pitch=r.m)
        ),
        "Row 2 is not divided by m: it is an acceleration, not a force.": lambda r: _matrix(
            r, heave=1
        ),
        "Row 4 is not divided by Izz: it is an angular acceleration, not a moment.": (
            lambda r: _matrix(r, pitch=1)
        ),
        "The state is ordered [Y, θ, Y', θ'] here; the workbook's is [Y, Y', θ, θ'].": (
            lambda r: _matrix(r)[np.ix_([0, 2, 1, 3], [0, 2, 1, 3])]
        ),
        "A is transposed: row i says what changes component i of w.": lambda r: _matrix(r).T,
    }
    cases = [(some_robot(rng),) for _ in range(4)]
    compare(state_matrix, cases, lambda r: r.A, mistakes, "a row and a column for each of w", fails)


def _system(rng):
    """A, w, F at both ends and dt, not so short that two methods are alike."""
    n = int(rng.integers(2, 5))
    A = rng.normal(0, 1, (n, n)) - 1.5 * np.eye(n)
    return A, *rng.normal(0, 1, (3, n)), rng.uniform(0.3, 0.7)


def _step(A, w, F0, F1, dt, left=0.5, right=0.5, forcing=(0.5, 0.5)):
    """``(I - left dt A) w1 = (I + right dt A) w + dt (forcing @ [F0, F1])``."""
    identity = np.eye(len(w))
    b = (identity + right * dt * A) @ w + dt * (forcing[0] * F0 + forcing[1] * F1)
    return np.linalg.solve(identity - left * dt * A, b)


def _with(**changes):
    return lambda *case: _step(*case, **changes)


def _outside(A, w, F0, F1, dt):
    return _step(A, w, F0, F1, dt, forcing=(0, 0)) + dt / 2 * (F0 + F1)


def _ones(A, w, F0, F1, dt):
    b = (1 + dt / 2 * A) @ w + dt / 2 * (F0 + F1)
    return np.linalg.solve(1 - dt / 2 * A, b)


def _ones_left(A, w, F0, F1, dt):
    b = w + dt / 2 * (A @ w + F0 + F1)
    return np.linalg.solve(1 - dt / 2 * A, b)


def _heun(A, w, F0, F1, dt):
    guess = w + dt * (A @ w + F0)
    return w + dt / 2 * (A @ w + F0 + A @ guess + F1)


@check(
    "cn_step(A, w, F0, F1, dt)",
    "equilibria stay, modes grow by (1 + z/2)/(1 − z/2), and a step back undoes a step.",
)
def check_cn_step(cn_step, rng):
    """Whether ``cn_step(A, w, F0, F1, dt)`` is one step of Crank-Nicolson."""

    def fails(answer, A, w, F0, F1, dt):
        F = -A @ w
        if not near(np.asarray(cn_step(A, w, F, F, dt), float), w, 1e-6):
            return (
                "An equilibrium does not stay: with F = −A w at both ends nothing may move. Do "
                "w and F have the same matrix in front of them, and the same dt/2?"
            )
        zero = np.zeros(len(w))
        forward = np.asarray(cn_step(A, w, zero, zero, dt), float)
        if not near(np.asarray(cn_step(A, forward, zero, zero, -dt), float), w, 1e-6):
            return (
                "A step of −dt does not undo a step of dt. The trapezoid treats both ends alike: "
                "(I − dt/2 A) on the left, (I + dt/2 A) on the right?"
            )
        if not near(forward, _step(A, w, zero, zero, dt), 1e-6):
            return (
                "The growth of a mode is not (1 + z/2)/(1 − z/2), z = λ dt: is it dt/2 on both "
                "sides?"
            )
        return (
            "Without F the step is right, with F it is not. Do both ends of the forcing count, "
            "with dt/2 each?"
        )

    mistakes = {
        "This is the explicit Euler method: A w is taken at the start alone. The trapezoid "
        "takes the mean of both ends.": _with(left=0, right=1, forcing=(1, 0)),
        "This is backward Euler: A w is taken at the end alone. The trapezoid takes the mean "
        "of both ends.": _with(left=1, right=0, forcing=(0, 1)),
        "This is Heun's method: the end is predicted by Euler, not solved for. The unknown "
        "stands on both sides; collect it on the left.": _heun,
        "Nothing is solved: this is the right-hand side b alone. (I − dt/2 A) w1 = b is the "
        "equation.": (_with(left=0)),
        "F is taken at the start alone: the trapezoid needs F1, too.": _with(forcing=(1, 0)),
        "F is taken at the end alone: the trapezoid needs F0, too.": _with(forcing=(0, 1)),
        "F counts twice: dt/2 (F0 + F1) is dt times the mean.": _with(forcing=(1, 1)),
        "F counts half: dt/2 (F0 + F1) is dt times the mean.": _with(forcing=(0.25, 0.25)),
        "Both matrices have dt in them where dt/2 belongs.": (
            _with(left=1, right=1),
            _with(left=1, right=1, forcing=(1, 1)),
        ),
        "The signs of the two matrices have changed places: minus belongs to the unknown, on "
        "the left.": (_with(left=-0.5, right=-0.5)),
        "Both matrices are (I − dt/2 A): what goes from the end to the right changes its sign.": (
            _with(right=-0.5)
        ),
        "F is added after the solving: it belongs to b, so it is multiplied by the inverse as "
        "well.": (_outside),
        "Here the matrices act on rows, w @ M: A is transposed by that. They belong to the "
        "left of w.": (lambda A, *rest: _step(A.T, *rest)),
        "`1 - dt/2 * A` subtracts from a 1 in every entry: the unit matrix is `np.eye(n)`.": (
            _ones,
            _ones_left,
        ),
    }
    cases = [_system(rng) for _ in range(4)]
    compare(cn_step, cases, _step, mistakes, "the state after the step", fails)


@check(
    "crank_nicolson(A, F, w0, dt, tfinal)",
    "each column is one step of Crank-Nicolson from the one before, at the right times.",
)
def check_crank_nicolson(crank_nicolson, rng):
    """Whether ``crank_nicolson(A, F, w0, dt, tfinal)`` returns W and T of a run."""
    runs, cases = [], []
    for whole in (False, True, False):
        A, w0, cosine, sine, dt = _system(rng)
        w0 = np.array([3, -2, 5, 1])[: len(w0)] if whole else w0

        def F(t, cosine=cosine, sine=sine):
            return cosine * np.cos(2 * t) + sine * np.sin(3 * t)

        case = (w0, dt, dt * int(rng.integers(5, 9)))
        cases.append((A, F, *case))
        W, T, wanted_W, wanted_T = _loops.check_history(crank_nicolson, (A, F), _of(A, F), *case)
        runs.append((W, T, wanted_W, wanted_T, dt))
    answers = [W for W, *_ in runs]

    def loop(mistake, **changes):
        return lambda A, F, *case: mistake(_of(A, F, **changes), *case)

    mistakes = {words: loop(mistake) for words, mistake in _loops.LOOPS.items()} | {
        "Of order 1: F is taken at T[j] alone. The trapezoid needs F(T[j + 1]), too.": loop(
            lambda *case: _loops.history(*case)[0], ends=(0, 0)
        ),
        "Of order 1: F is taken at T[j + 1] alone. The trapezoid needs F(T[j]), too.": loop(
            lambda *case: _loops.history(*case)[0], ends=(1, 1)
        ),
        "F is taken in the middle of the step, which is of order 2 as well, but is the "
        "midpoint rule's: the trapezoid takes the mean of both ends.": loop(
            lambda *case: _loops.history(*case)[0], ends=(0.5, 0.5)
        ),
    }
    if not all(near(W, wanted) for W, _, wanted, *_ in runs):
        name_mistake(answers, cases, mistakes)
    for W, T, wanted_W, wanted_T, dt in runs:
        _loops.check_times(crank_nicolson.name, T, wanted_T, dt)
        must_have_shape(W, wanted_W.shape, crank_nicolson.name, _loops.SHAPE)
        if not near(W, wanted_W):
            j = int(np.argmax(np.abs(W - wanted_W).max(axis=0) > 1e-9))
            raise Wrong(
                f"Column {j} is the first that is not right: is it `cn_step` of the column "
                "before, with F at T[j] and T[j + 1]?"
                if j
                else "The first column is not w0."
            )


def _of(A, F, ends=(0, 1)):
    """The step as a function of state, time and dt, with F taken at these parts of it."""
    return lambda w, t, dt: _step(A, w, F(t + ends[0] * dt), F(t + ends[1] * dt), dt)
