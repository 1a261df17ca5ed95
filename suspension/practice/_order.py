"""Problems whose solutions are known, and the order that an integrator shows on them."""

from typing import NamedTuple

import numpy as np

from suspension.practice._feedback import PATIENCE, Wrong

STEPS = (10, 20, 40, 80)  # of which the finest decide


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


def patient(function, name, allowed=PATIENCE):
    """A function that may be called so many times."""
    count = 0

    def counted(*arguments):
        nonlocal count
        count += 1
        if count > allowed:
            raise Wrong(
                f"`{name}` has asked for {allowed} values and has not come to an end: does "
                f"it always "
                "get nearer to its end?"
            )
        return function(*arguments)

    return counted


def slope(dts, errors):
    """The order, from the two finest steps; infinite where there is no error."""
    errors = np.maximum(errors, 1e-300)
    if errors[-1] < 1e-14:
        return np.inf
    return float(np.log(errors[-2] / errors[-1]) / np.log(dts[-2] / dts[-1]))


def order_of_step(step, found):
    """The order that a step ``step(g, w, t, dt)`` shows on a `Problem`."""
    tfinal, errors = 1.0, []
    for n in STEPS:
        w, dt = found.w0.copy(), tfinal / n
        for j in range(n):
            w = np.asarray(step(found.g, w, j * dt, dt), float)
        with np.errstate(all="ignore"):
            errors.append(np.abs(w - found.exact(tfinal)).max())
    if not np.isfinite(errors).all():
        return -np.inf
    return slope(tfinal / np.array(STEPS), np.array(errors))


def said(order):
    """The order in words."""
    if not np.isfinite(order) or order < 0.5:
        return "does not come nearer to the solution as the step shrinks"
    return f"is of order {round(order)}"
