"""Checks of the workbook's stability: R from a tableau, a verdict, the largest step."""

import numpy as np

from suspension.practice.crank_nicolson import some_robot
from suspension.practice.feedback import Wrong, check, compare, fits, name_mistake, near, numbers
from suspension.schemes import CRANK_NICOLSON, EULER, RK4

__all__ = ["check_is_stable", "check_largest_step", "check_stability_function"]


def _tableau(rng):
    s = int(rng.integers(2, 5))
    z = complex(*rng.normal(0, 1.2, 2))
    return rng.uniform(-0.3, 0.6, (s, s)), rng.dirichlet(np.ones(s)), z


def _R(a, b, z, sign=-1, before=None, one=1, unit=None):
    unit = np.eye(len(b)) if unit is None else unit
    return one + (z if before is None else before) * b @ np.linalg.solve(
        unit + sign * z * a, np.ones(len(b))
    )


@check("stability_function(a, b, z)", "it is the growth of one step of w' = λw, z = λ dt.")
def check_stability_function(stability_function, rng):
    """Whether ``stability_function(a, b, z)`` is R(z) of a tableau, z complex."""

    def fails(answer, a, b, z):
        def R(z):
            return complex(numbers(stability_function(a, b, z), "R", real=False).squeeze())

        at_zero = R(0j)
        if not near(at_zero, 1):
            return (
                f"R(0) is {at_zero:.4g}; a step without a slope must keep the state: R(0) = 1. "
                "Is the 1 in front missing?"
            )
        h = 1e-6
        rate = (R(h + 0j) - at_zero).real / h
        if not np.isclose(rate, 1, atol=1e-3):
            return f"Near z = 0, R should be 1 + z, and it is 1 + {rate:.3g} z: what multiplies z?"
        return (
            "Its first two terms, 1 + z, are right, the others are not: is a the matrix in (I "
            "− z a), and are the values at the stages its solution for a column of ones?"
        )

    mistakes = {
        "The z before bᵀ is missing: the step is z bᵀs.": lambda a, b, z: _R(a, b, z, before=1),
        "The sign in the bracket is turned round: s = 1 + z a s makes (I − z a) s = 1.": (
            lambda a, b, z: _R(a, b, z, sign=1)
        ),
        "The 1 in front is missing: the step starts from w = 1.": lambda a, b, z: _R(
            a, b, z, one=0
        ),
        "a is transposed: row i of a says along which slopes stage i probes.": (
            lambda a, b, z: _R(a.T, b, z)
        ),
        "The bracket is multiplied, not solved with: s is (I − z a)⁻¹ times ones.": (
            lambda a, b, z: 1 + z * b @ (np.eye(len(b)) - z * a) @ np.ones(len(b))
        ),
        "`1 - z * a` subtracts from a 1 in every entry: the unit matrix is `np.eye(s)`.": (
            lambda a, b, z: _R(a, b, z, unit=np.ones_like(a))
        ),
        "This is e^z, by which the motion itself grows; R is what the method makes of it.": (
            lambda a, b, z: np.exp(z)
        ),
        "This is |R|: R itself is asked for, a complex number.": lambda *case: abs(_R(*case)),
        "The imaginary part is lost: is z, or R, put into a real array?": (
            lambda *case: _R(*case).real,
            lambda a, b, z: _R(a, b, z.real),
        ),
    }
    cases = [_tableau(rng) for _ in range(4)]
    answers = [
        np.squeeze(numbers(stability_function(*case), stability_function.name, real=False))
        for case in cases
    ]
    if fits(answers, cases, _R):
        return
    name_mistake(answers, cases, mistakes)
    for answer, case in zip(answers, cases):
        if answer.shape != ():
            raise Wrong(
                f"`stability_function` returns an array of shape {answer.shape}; R is one "
                "number. Does bᵀ multiply the stages as a row, b @ s?"
            )
        if not near(answer, _R(*case)):
            raise Wrong(fails(answer, *case))


def _verdicts(rng):
    """Methods, eigenvalues and steps: stable and not, on the edge, and each for its own reason."""
    methods = [m.stability_function for m in (EULER, RK4, CRANK_NICOLSON)]
    cases = [
        (rng.choice(methods), some_robot(rng).eigenvalues, rng.uniform(1e-4, 0.2))
        for _ in range(40)
    ]
    cases += [
        (methods[0], np.array([-2.0, -1.0]), 1.0),  # |R| = 1 exactly, R = -1
        (methods[0], np.array([-1.0, -0.5]), 1.0),
        (methods[1], np.array([0.0, -1.0]), 0.5),  # R = 1 exactly
        (methods[0], np.array([-0.5, -3.0]), 1.0),  # one of two, R < -1
        (methods[0], np.array([-3.0, -0.5]), 1.0),
        (methods[0], np.array([2j, -2j]), 0.1),  # neither grows, and both do in Euler's run
        (methods[1], np.array([2j, -2j]), 1.0),
        (methods[1], np.array([0.1 + 1j, 0.1 - 1j]), 0.1),
        (methods[2], np.array([-1e3, -1.0]), 1.0),
    ]
    return cases


@check(
    "is_stable(R, eigenvalues, dt)", "every |R(λ dt)| is held against 1, and 1 itself is stable."
)
def check_is_stable(is_stable, rng):
    """Whether ``is_stable(R, eigenvalues, dt)`` is True exactly where every ``|R(λ dt)| <= 1``."""
    cases = _verdicts(rng)
    answers = [numbers(is_stable(*case), is_stable.name) for case in cases]
    for answer, (_, eigenvalues, _) in zip(answers, cases):
        if answer.shape == eigenvalues.shape:
            raise Wrong(
                "This is an answer for each eigenvalue: one for the whole run is asked for, "
                "and a run is bounded if all its modes are."
            )
        if answer.size != 1 or answer.ravel()[0] not in (0, 1):
            raise Wrong("`is_stable` should return True or False.")
    answers = [answer.reshape(()) for answer in answers]

    def right(R, eigenvalues, dt):
        return float(np.all(np.abs(R(eigenvalues * dt)) <= 1 + 1e-12))

    mistakes = {
        "It says stable as soon as one mode is: all of them must be.": lambda R, z, dt: float(
            np.any(np.abs(R(z * dt)) <= 1 + 1e-12)
        ),
        "R is asked at the eigenvalues themselves: the step belongs in, z = λ dt.": (
            lambda R, z, dt: right(R, z, 1.0)
        ),
        "The edge counts as unstable here: |R| = 1 neither grows nor decays, and is stable.": (
            lambda R, z, dt: float(np.all(np.abs(R(z * dt)) < 1))
        ),
        "The real part of R is held against 1: R is complex, and may be negative. What grows "
        "is |R|.": (
            lambda R, z, dt: float(np.all(R(z * dt).real <= 1)),
            lambda R, z, dt: float(np.all(np.abs(R(z * dt).real) <= 1)),
        ),
        "This asks whether the motion decays, Re λ <= 0; whether the run does is decided by "
        "|R(λ dt)|.": (
            lambda R, z, dt: float(np.all(z.real <= 0)),
            lambda R, z, dt: float(np.all(z.real < 0)),
        ),
        "This asks whether |λ dt| <= 1, whatever the method: its region is |R(z)| <= 1.": (
            lambda R, z, dt: float(np.all(np.abs(z * dt) <= 1)),
        ),
        "It looks at the first eigenvalue alone: all of them count.": (
            lambda R, z, dt: float(np.abs(R(z[:1] * dt))[0] <= 1 + 1e-12)
        ),
        "It says stable where it is not, and the other way round.": (
            lambda *case: 1 - right(*case)
        ),
        "It always says stable.": lambda *case: 1.0,
        "It never says stable.": lambda *case: 0.0,
    }
    if fits(answers, cases, right):
        return
    name_mistake(answers, cases, mistakes)
    for answer, (R, eigenvalues, dt) in zip(answers, cases):
        if answer != right(R, eigenvalues, dt):
            growth = np.abs(R(eigenvalues * dt)).max()
            raise Wrong(
                f"For the eigenvalues {np.round(eigenvalues, 3)} and dt = {dt:.3g} the largest "
                "|R| is "
                f"{growth:.4g}, and you say {'stable' if answer else 'unstable'}."
            )


IMAGINARY, REAL = 2 * np.sqrt(2), 2.785293563405289  # where RK4's region ends on both axes


@check("largest_step(eigenvalues)", "up to it every |R| is at most 1, and beyond it one is more.")
def check_largest_step(largest_step, rng):
    """Whether ``largest_step(eigenvalues)`` is RK4's largest stable step, to 1 in 1000."""

    def fails(answer, eigenvalues):
        growth = np.abs(RK4.stability_function(eigenvalues * answer)).max()
        if growth > 1:
            return (
                f"At your step, {answer:.4g} s, a mode is multiplied by |R| = {growth:.4g} in "
                "every step: it is too long. Does every eigenvalue leave at its own step, and "
                "is the smallest taken?"
            )
        return (
            f"At your step, {answer:.4g} s, the largest |R| is {growth:.4g}: there is room for "
            "a longer one. Is the limit where |R(λ dt)| = 1, along each eigenvalue's own ray?"
        )

    def each(eigenvalues, scheme=RK4):
        return [scheme.max_stable_dt([x]) for x in eigenvalues]

    mistakes = {
        "This is the limit of the slowest mode to leave: the first to leave decides, take the "
        "least.": (lambda z: max(each(z))),
        "This is 2√2/|λ|, the limit of undamped modes: damping tilts the rays away from the "
        "imaginary axis.": lambda z: IMAGINARY / np.abs(z).max(),
        "This is 2.785/|λ|, as if the eigenvalues were real: theirs are other rays, with other "
        "limits.": (lambda z: REAL / np.abs(z).max()),
        "This looks at the real parts alone, 2.785/|Re λ|: the imaginary parts take part in "
        "|R(λ dt)|.": (
            lambda z: REAL / np.abs(z.real).max(),
            lambda z: REAL / np.abs(z.real).min(),
        ),
        "This looks at the imaginary parts alone, 2√2/|Im λ|: the real parts take part in |R(λ "
        "dt)|.": (lambda z: IMAGINARY / np.abs(z.imag).max()),
        "This is Euler's limit: R here is 1 + z + z²/2 + z³/6 + z⁴/24.": (
            lambda z: min(each(z, EULER)),
        ),
        "This is the limit of the first eigenvalue alone: others may leave earlier.": (
            lambda z: each(z)[0]
        ),
        "It is λ dt, not dt: divide by the eigenvalue.": (
            lambda z: (np.abs(z) * RK4.max_stable_dt(z)).max()
        ),
    }
    cases = []
    for damping in (0.25, 0.4, 0.55):
        omega = np.array([rng.uniform(15, 25), rng.uniform(5, 10), rng.uniform(30, 60)])
        swing = omega * ([0.1, damping, 0.15] + 1j * np.ones(3))
        z = -swing.conj()
        cases.append((np.concatenate([z, z.conj()]),))
    compare(largest_step, cases, RK4.max_stable_dt, mistakes, "one number, in s", fails, close=1e-3)
