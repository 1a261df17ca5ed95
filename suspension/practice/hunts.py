"""Bug hunts: integrators with one wrong line each, to be found by the order that they show."""

import inspect
import math
import textwrap

import numpy as np

from suspension import _checks
from suspension.practice._order import problem, slope
from suspension.practice.feedback import Feedback, Wrong, Yours, fill

__all__ = ["check_hunt", "errors_of", "listing_of"]


def trapezoid(A, F, w0, dt, tfinal):
    T = dt * np.arange(round(tfinal / dt) + 1)
    W = np.empty((len(w0), len(T)))
    W[:, 0] = w0
    left = np.eye(len(w0)) - dt / 2 * A
    right = np.eye(len(w0)) + dt / 2 * A
    for j in range(len(T) - 1):
        b = right @ W[:, j] + dt / 2 * (F(T[j]) + F(T[j]))
        W[:, j + 1] = np.linalg.solve(left, b)
    return W, T


def slopes(g, w0, dt, tfinal):
    T = dt * np.arange(round(tfinal / dt) + 1)
    W = np.empty((len(w0), len(T)))
    W[:, 0] = w0
    for j in range(len(T) - 1):
        w, t = W[:, j], T[j]
        g1 = g(w, t)
        g2 = g(w + dt / 2 * g1, t + dt / 2)
        g3 = g(w + dt / 2 * g1, t + dt / 2)
        g4 = g(w + dt * g3, t + dt)
        W[:, j + 1] = w + dt / 6 * (g1 + 2 * g2 + 2 * g3 + g4)
    return W, T


def clock(g, w0, dt, tfinal):
    T = dt * np.arange(round(tfinal / dt) + 1)
    W = np.empty((len(w0), len(T)))
    W[:, 0] = w0
    for j in range(len(T) - 1):
        w, t = W[:, j], T[j]
        g1 = g(w, t)
        g2 = g(w + dt / 2 * g1, t + dt / 2)
        g3 = g(w + dt / 2 * g2, t + dt / 2)
        g4 = g(w + dt * g3, t)
        W[:, j + 1] = w + dt / 6 * (g1 + 2 * g2 + 2 * g3 + g4)
    return W, T


def calendar(g, w0, dt, tfinal):
    T = np.linspace(0, tfinal, round(tfinal / dt))
    W = np.empty((len(w0), len(T)))
    W[:, 0] = w0
    for j in range(len(T) - 1):
        w, t = W[:, j], T[j]
        g1 = g(w, t)
        g2 = g(w + dt / 2 * g1, t + dt / 2)
        g3 = g(w + dt / 2 * g2, t + dt / 2)
        g4 = g(w + dt * g3, t + dt)
        W[:, j + 1] = w + dt / 6 * (g1 + 2 * g2 + 2 * g3 + g4)
    return W, T


def embedded(g, w0, dt, tfinal):
    T = dt * np.arange(round(tfinal / dt) + 1)
    W = np.empty((len(w0), len(T)))
    W[:, 0] = w0
    for j in range(len(T) - 1):
        w, t = W[:, j], T[j]
        g1 = g(w, t)
        g2 = g(w + dt / 2 * g1, t + dt / 2)
        g3 = g(w + 3 / 4 * dt * g2, t + 3 / 4 * dt)
        new = w + dt / 9 * (2 * g1 + 3 * g2 + 4 * g3)
        g4 = g(new, t + dt)
        error = dt / 72 * (-5 * g1 + 6 * g2 + 8 * g3 - 9 * g4)
        W[:, j + 1] = new - error
    return W, T


# The integrator, the order it should have, and what its wrong line has in it.
_HUNTS = {
    "trapezoid": (trapezoid, 2, "F(T[j]) + F(T[j])"),
    "slopes": (slopes, 4, "g3 = g(w + dt / 2 * g1"),
    "clock": (clock, 4, "g4 = g(w + dt * g3, t)"),
    "calendar": (calendar, 4, "np.linspace"),
    "embedded": (embedded, 3, "new - error"),
}
STEPS = np.array([20, 40, 80, 160])
MAX_STEPS = 10**5  # some seconds


def _source(name):
    """Its lines."""
    return textwrap.dedent(inspect.getsource(_hunt(name)[0])).splitlines()


def _hunt(name):
    return _HUNTS[_checks.one_of("name", name, tuple(_HUNTS))]


def listing_of(name):
    """The source of an integrator with a planted error, its lines numbered from 1.

    Parameters
    ----------
    name : str
        "trapezoid", "slopes", "clock", "calendar" or "embedded".

    Returns
    -------
    listing : str
    """
    return "\n".join(f"{i:2d}  {line}" for i, line in enumerate(_source(name), 1))


def _errors(run, name, dts):
    found = problem(np.random.default_rng(2086))
    if name == "trapezoid":  # w' = A w + F, with the solution (cos 2t, sin 3t)
        A = np.array([[-1.0, 2.0], [-2.0, -0.5]])

        def exact(t):
            return np.array([np.cos(2 * t), np.sin(3 * t)])

        def F(t):
            return np.array([-2 * np.sin(2 * t), 3 * np.cos(3 * t)]) - A @ exact(t)

        arguments, w0 = (A, F), exact(0.0)
    else:
        arguments, w0, exact = (found.g,), found.w0, found.exact
    return np.array(
        [
            np.abs(np.asarray(run(*arguments, w0, dt, 1.0)[0])[:, -1] - exact(1.0)).max()
            for dt in dts
        ]
    )


def errors_of(name, dts):
    """Errors at t = 1 s of an integrator with a planted error, where the solution is known.

    Parameters
    ----------
    name : str
        "trapezoid", "slopes", "clock", "calendar" or "embedded".
    dts : array_like, shape (n,)
        Steps of which 1 s is a whole number, s.

    Returns
    -------
    errors : ndarray, shape (n,)

    Raises
    ------
    ValueError
        If a name is unknown, a step is out of its range, or all runs take more than 10^5 steps.
    """
    run, dts = _hunt(name)[0], _checks.positives("dts", dts, (None,))
    count = 1 / dts
    if (np.abs(count - np.maximum(np.round(count), 1)) > 1e-6 * count).any():
        raise ValueError(f"dts must be steps of which 1 s is a whole number, got {dts}")
    if not count.sum() <= MAX_STEPS:
        raise ValueError(f"dts must take at most {MAX_STEPS} steps, got {count.sum():.2g}")
    return _errors(run, name, dts)


def check_hunt(name, order=..., line=..., repaired=...):
    """Whether a planted error is found: the order it leaves, its line, and the line repaired.

    Parameters
    ----------
    name : str
        "trapezoid", "slopes", "clock", "calendar" or "embedded".
    order : int
        The order that the integrator shows.
    line : int
        The number of the wrong line in `listing_of`.
    repaired : str
        What this line should say; the integrator is run with it.

    Returns
    -------
    Feedback
    """
    try:
        return Feedback(f"Right: {_judge(name, order, line, repaired)}", True)
    except Wrong as wrong:
        return Feedback(str(wrong), False)


def _judge(name, order, line, repaired):
    _, full, planted = _hunt(name)
    dts, lines = 1 / STEPS, _source(name)
    shown = round(slope(dts, errors_of(name, dts)))
    for each, what in ((order, "order"), (line, "line"), (repaired, "repaired")):
        if each is Ellipsis or each is None:
            raise fill(what)
    ratio = 2**shown
    real = isinstance(order, int | float | np.integer | np.floating)
    if isinstance(order, bool) or not real or not abs(order) < math.inf:
        raise Wrong("The order is a number, such as 2.")
    if round(order) != shown:
        own = " That is the order it should have; measure it." if round(order) == full else ""
        raise Wrong(
            f"Halve the step: the error becomes {ratio} times smaller, and 2^p = {ratio} is "
            f"not p = {_short(order)}.{own}"
        )
    if (
        isinstance(line, bool)
        or not isinstance(line, int | np.integer)
        or not 1 <= line <= len(lines)
    ):
        raise Wrong(f"The line is one of the numbers 1 to {len(lines)}.")
    if not isinstance(repaired, str):
        raise Wrong("`repaired` is the text of the line, in quotation marks.")
    text = lines[line - 1]
    indent = text[: len(text) - len(text.lstrip())]
    if repaired.strip() == text.strip():
        raise Wrong(f"Line {line} is as it was. What should it say?")
    mended = [*lines[: line - 1], indent + repaired.strip(), *lines[line:]]
    right_line = planted in text
    begin = f"The order is {shown}, as you say. "
    found = _slope_of(name, "\n".join(mended), begin, line)
    if found >= full - 0.4:
        return f"with line {line} repaired it is of order {full}, where it was of order {shown}."
    if not right_line:
        raise Wrong(
            f"{begin}With your line {line} it is of order {max(round(found), 0)}, not "
            f"{full}: is another line the wrong one? Read what each takes from the one before, "
            "and when."
        )
    raise Wrong(
        f"{begin}Line {line} is the wrong one, but with yours it is of order "
        f"{max(round(found), 0)}, and {full} is possible."
    )


def _short(order):
    """A number that may have very many digits."""
    return f"{order:g}" if abs(order) < 1e15 else "such a large number"


def _slope_of(name, source, begin, line):
    """The order of an integrator that is made of its source."""
    space = {"np": np}
    try:
        exec(compile(source, "repaired", "exec"), space)
    except SyntaxError as error:
        raise Wrong(f"{begin}Your line {line} is not Python: {error.msg}.") from None
    except Exception as error:
        raise Wrong(f"{begin}With your line {line} the definition fails: {error}.") from None
    if name not in space:
        raise Wrong(f"{begin}With your line {line} there is no `{name}` any more.")
    run = Yours(space[name], name + str(inspect.signature(_hunt(name)[0])))
    try:
        errors = _errors(run, name, 1 / STEPS)
    except (ValueError, TypeError, IndexError) as error:
        raise Wrong(f"{begin}With your line {line} the run fails: {error}.") from None
    except Wrong as wrong:
        raise Wrong(f"{begin}With your line {line} {wrong}") from None
    return slope(1 / STEPS, errors) if np.isfinite(errors).all() else -np.inf
