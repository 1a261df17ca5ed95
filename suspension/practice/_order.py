"""Problems whose solutions are known, and the order that an integrator shows on them."""

from typing import NamedTuple

import numpy as np

from suspension.practice.feedback import PATIENCE, Wrong

STEPS = (80, 160)  # so fine that the first term of an error rules


class Problem(NamedTuple):
    """``w' = g(w, t)`` from w0 at t = 0, not linear and with time in it, and its solution."""

    g: object
    w0: np.ndarray
    exact: object


def problem(rng):
    """``x' = -x² (1 + p cos(q t))`` and ``y' = y cos(t + r)``, with random numbers."""
    p, q, r = rng.uniform(0.3, 0.9), rng.uniform(1, 3), rng.uniform(0, 6)
    x0, y0 = rng.uniform(0.8, 1.5), rng.uniform(0.5, 2)

    def g(w, t):
        w = np.asarray(w, float)
        return np.array([-(w[0] ** 2) * (1 + p * np.cos(q * t)), w[1] * np.cos(t + r)])

    def exact(t):
        x = 1 / (1 / x0 + t + p / q * np.sin(q * t))
        return np.array([x, y0 * np.exp(np.sin(t + r) - np.sin(r))])

    return Problem(g, np.array([x0, y0]), exact)


def without_time(rng):
    """``x' = -x²`` and ``y' = -x y``, a `Problem` without time in it."""
    x0, y0 = rng.uniform(0.8, 1.5), rng.uniform(0.5, 2)

    def g(w, t):
        return np.array([-(w[0] ** 2), -w[1] * w[0]])

    def exact(t):
        return np.array([x0 / (1 + x0 * t), y0 / (1 + x0 * t)])

    return Problem(g, np.array([x0, y0]), exact)


def patient(function, name, allowed=PATIENCE):
    """A function that may be called so many times."""
    count = 0

    def counted(*arguments):
        nonlocal count
        count += 1
        if count > allowed:
            raise Wrong(
                f"`{name}` has asked for {allowed} values and has not come to an end: does it "
                "always get nearer to its end?"
            )
        return function(*arguments)

    return counted


def slope(dts, errors):
    """The order, from the two finest steps; infinite where there is no error."""
    if not np.isfinite(errors).all():
        return -np.inf
    if errors[-1] < 1e-14:
        return np.inf
    return float(np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1]))


def order_of_run(run, rng, make=problem):
    """The order that ``run(g, w0, dt, tfinal) -> W`` shows on three problems of a kind.

    The errors of all problems, times and components are taken together: one alone may pass
    through zero, and make a method look better or worse than it is.
    """
    found, errors = [make(rng) for _ in range(3)], []
    for n in STEPS:
        t, squares = np.arange(n + 1) / n, 0.0
        for each in found:
            W = np.asarray(run(each.g, each.w0, 1 / n, 1.0), float)
            if W.shape != (2, n + 1):
                return -np.inf
            with np.errstate(all="ignore"):
                squares += np.mean((W - each.exact(t)) ** 2)
        errors.append(np.sqrt(squares))
    return slope(1 / np.array(STEPS), np.array(errors))


def order_of_step(step, rng, make=problem):
    """The order that ``step(g, w, t, dt) -> w`` shows."""

    def run(g, w0, dt, tfinal):
        columns = [w0]
        for j in range(round(tfinal / dt)):
            columns.append(np.asarray(step(g, columns[-1], j * dt, dt), float))
        return np.transpose(columns)

    return order_of_run(run, rng, make)


def said(order, wanted):
    """The order that is shown, and the one that is wanted, in words."""
    if not np.isfinite(order) or order < 0.5:
        return "does not come nearer to the solution as the step shrinks"
    return f"is of order {round(order)}, not {wanted}"
