"""Checks of the workbook's Runge-Kutta: one step, the loop, an observed order."""

import numpy as np

from suspension.practice import _loops
from suspension.practice._order import (
    order_of_run,
    order_of_step,
    patient,
    problem,
    said,
    without_time,
)
from suspension.practice.feedback import (
    Wrong,
    check,
    compare,
    must_have_shape,
    name_mistake,
    near,
    numbers,
)

__all__ = ["check_observed_order", "check_rk4", "check_rk4_step"]

HALF, WEIGHTS = 1 / 2, (1 / 6, 1 / 3, 1 / 3, 1 / 6)
ENOUGH = 3.6  # what four tenths short of order 4 may still be called


def stages(
    chain=((1, HALF), (2, HALF), (3, 1)), times=(HALF, HALF, 1), weights=WEIGHTS, scaled=True
):
    """A step of four slopes, of which each is taken along one earlier slope.

    Slopes 2, 3, 4 are g(w + part dt slope[along], t + times dt), (along, part) from `chain`.
    """

    def step(g, w, t, dt):
        slopes = [None, g(w, t)]
        for (along, part), time in zip(chain, times):
            slopes.append(g(w + part * dt * slopes[along], t + time * dt))
        return w + (dt if scaled else 1) * sum(b * s for b, s in zip(weights, slopes[1:]))

    return step


rk4_step = stages()


def _twice_scaled(g, w, t, dt):
    """Where the slopes are multiplied by dt already, and once more."""
    return stages(
        chain=((1, HALF * dt), (2, HALF * dt), (3, dt)), weights=np.multiply(WEIGHTS, dt)
    )(g, w, t, dt)


def _scaled_once_too_often(g, w, t, dt):
    return stages(weights=np.multiply(WEIGHTS, dt))(g, w, t, dt)


STEPS = {
    "g2 seems to go a full step. It should go half a step.": stages(((1, 1), (2, HALF), (3, 1))),
    "g3 seems to use g1. It should use g2.": stages(((1, HALF), (1, HALF), (3, 1))),
    "g4 seems to use g2. It should use g3.": stages(((1, HALF), (2, HALF), (2, 1))),
    "g4 seems to use g1. It should use g3.": stages(((1, HALF), (2, HALF), (1, 1))),
    "g4 seems to go half a step. It should go a full step.": (
        stages(((1, HALF), (2, HALF), (3, HALF))),
        stages(((1, HALF), (2, HALF), (3, HALF)), (HALF, HALF, HALF)),
    ),
    "g3 seems to go a full step. It should go half a step.": (
        stages(((1, HALF), (2, 1), (3, 1))),
        stages(((1, HALF), (2, 1), (3, 1)), (HALF, 1, 1)),
    ),
    "Are all slopes taken at the time t? Those in the middle belong to t + dt/2, the last to t "
    "+ dt.": (stages(times=(0, 0, 0))),
    "Are g2 and g3 taken at the time t? They belong to t + dt/2.": stages(times=(0, 0, 1)),
    "Is g2 taken at the time t? It belongs to t + dt/2.": stages(times=(0, HALF, 1)),
    "Is g3 taken at the time t? It belongs to t + dt/2.": stages(times=(HALF, 0, 1)),
    "Is g4 taken at the time t + dt/2, or t? It belongs to the end, t + dt.": (
        stages(times=(HALF, HALF, HALF)),
        stages(times=(HALF, HALF, 0)),
    ),
    "Are g2 and g3 taken at the time t + dt? They belong to t + dt/2.": stages(times=(1, 1, 1)),
    "Are all four weights 1/4? The two slopes in the middle count twice: 1, 2, 2, "
    "1 over 6.": stages(weights=(1 / 4,) * 4),
    "Do the weights sum to 1? A mean of 1, 2, 2, 1 is divided by 6.": (
        stages(weights=np.multiply(WEIGHTS, 6)),
        stages(weights=np.multiply(WEIGHTS, 6 / 4)),
        stages(weights=np.multiply(WEIGHTS, 6 / 8)),
        stages(weights=(1 / 6,) * 4),
    ),
    "Do the weights of the middle and of the ends stand the wrong way round? They are 1, 2, 2, "
    "1.": (stages(weights=(1 / 3, 1 / 6, 1 / 6, 1 / 3))),
    "Are the slopes not multiplied by dt at the end?": stages(scaled=False),
    "Is dt there once too often? Either the slopes carry it, or the sum does.": (
        _twice_scaled,
        _scaled_once_too_often,
    ),
    "This is the explicit Euler method: is the step taken along g1 alone?": stages(
        weights=(1, 0, 0, 0)
    ),
    "This is the midpoint rule, the step is taken along g2 alone: where are g3 and g4?": stages(
        weights=(0, 1, 0, 0)
    ),
    "Does the sum start from something other than w? It adds to the state at the start of the "
    "step.": (
        lambda g, w, t, dt: rk4_step(g, w, t, dt) - w,
        lambda g, w, t, dt: rk4_step(g, w, t, dt) + dt * g(w + dt / 2 * g(w, t), t + dt / 2),
    ),
}


def _varied(rng, count=4):
    """Right-hand sides, states, times and steps."""
    found = [problem(rng) for _ in range(count)]
    return [(p.g, p.w0, rng.uniform(0.1, 2), rng.uniform(0.1, 0.4)) for p in found]


@check("rk4_step(g, w, t, dt)", "of order 4, for right-hand sides that bend and depend on time.")
def check_rk4_step(step, rng):
    """Whether ``rk4_step(g, w, t, dt)`` is a step of order 4 for ``w' = g(w, t)``."""
    cases = _varied(rng)
    answers = [numbers(step(patient(g, step.name), *rest), step.name) for g, *rest in cases]
    for answer, (_, w, *_) in zip(answers, cases):
        if answer.shape != w.shape:
            must_have_shape(answer, w.shape, step.name, "the state after the step")
    order = order_of_step(step, rng)
    if order >= ENOUGH:
        return
    shown = f"This step {said(order, 4)}."
    name_mistake(answers, cases, {f"{shown} {words}": wrong for words, wrong in STEPS.items()})
    raise Wrong(f"{shown} {_where(step, rng)}")


def _where(step, rng):
    """Which kind of right-hand side shows it."""
    if order_of_step(step, rng, without_time) >= ENOUGH:
        return (
            "Without time in g it is of order 4: at which times does it ask for its slopes? Those "
            "in the middle belong to t + dt/2, the last to t + dt."
        )
    w, t, dt = np.array([1.3, -0.4]), 0.2, 0.1
    constant = np.asarray(step(lambda w, t: np.array([2.0, 5.0]), w, t, dt), float)
    if not near(constant, w + dt * np.array([2.0, 5.0])):
        return (
            "Where the slope is constant it does not go dt times that slope: do the weights "
            "sum to 1?"
        )
    return (
        "Where the slope is constant it is right, so the weights sum to 1. Does each slope "
        "probe along the one before it, over dt/2, dt/2 and dt, and do the weights go 1, 2, 2, 1?"
    )


@check("rk4(g, w0, dt, tfinal)", "of order 4, every column a step from the one before.")
def check_rk4(rk4, rng):
    """Whether ``rk4(g, w0, dt, tfinal)`` returns W and T of a run by `rk4_step`."""
    runs, cases = [], []
    for whole in (False, True, False):
        found = problem(rng)
        w0 = np.array([1, 2]) if whole else found.w0
        dt = rng.uniform(0.1, 0.2)
        case = (w0, dt, dt * int(rng.integers(5, 9)))
        cases.append((found.g, *case))
        step = _of(found.g)
        runs.append((*_loops.check_history(rk4, (patient(found.g, "rk4"),), step, *case), dt))
    if not all(near(W, wanted) for W, _, wanted, *_ in runs):
        mistakes = {
            words: lambda g, *case, mistake=mistake: mistake(_of(g), *case)
            for words, mistake in _loops.LOOPS.items()
        }
        name_mistake([W for W, *_ in runs], cases, mistakes)
    for W, T, wanted_W, wanted_T, dt in runs:
        _loops.check_times("rk4", T, wanted_T, dt)
        must_have_shape(W, wanted_W.shape, "rk4", _loops.SHAPE)
        if not near(W[:, 0], wanted_W[:, 0]):
            raise Wrong("The first column is not w0.")
    order = order_of_run(lambda *case: rk4(*case)[0], rng)
    if order < ENOUGH:
        raise Wrong(
            f"This run {said(order, 4)}. Does `check_rk4_step` find your step right? If so: "
            "does step j start from W[:, j], at T[j]?"
        )


def _of(g):
    return lambda w, t, dt: rk4_step(g, w, t, dt)


def _power_law(rng):
    """Errors that fall with some order, not always a whole one, and steps that are not halved."""
    p, ratio = rng.uniform(0.7, 4.4), rng.uniform(1.4, 3.5)
    dts = 0.1 / ratio ** np.arange(rng.integers(3, 6))
    return dts, rng.uniform(0.1, 10) * dts**p


def _observed(dts, errors):
    return np.polyfit(np.log(dts), np.log(errors), 1)[0]


@check(
    "observed_order(dts, errors)",
    "it is the slope on logarithmic axes, for any ratio of the steps.",
)
def check_observed_order(observed_order, rng):
    """Whether ``observed_order(dts, errors)`` is the slope of the errors on logarithmic axes."""

    def fails(answer, dts, errors):
        return (
            f"Errors that fall like dt to the power {_observed(dts, errors):.3g} give "
            f"{answer:.3g}. Is it the change of log(error) over the change of log(dt)?"
        )

    mistakes = {
        "The sign is turned round: an error that falls with dt has a positive order.": (
            lambda *case: -_observed(*case)
        ),
        "It is the inverse of the order: have the axes changed places? log(error) over log(dt).": (
            lambda dts, errors: 1 / _observed(dts, errors)
        ),
        "This is how many times the error shrinks from one step to the next: the order is the "
        "logarithm of that, over the logarithm of the ratio of the steps.": (
            lambda dts, errors: errors[0] / errors[1],
            lambda dts, errors: errors[-2] / errors[-1],
        ),
        "This is right for steps that are halved, log2(error ratio); these are not. Divide by "
        "the logarithm of the ratio of the steps.": (
            lambda dts, errors: np.log2(errors[0] / errors[1]),
            lambda dts, errors: np.log2(errors[-2] / errors[-1]),
        ),
        "This is the logarithm of the ratio of two errors alone: divide by that of the steps.": (
            lambda dts, errors: np.log(errors[0] / errors[1]),
            lambda dts, errors: np.log(errors[-2] / errors[-1]),
            lambda dts, errors: np.log10(errors[0] / errors[1]),
            lambda dts, errors: np.log10(errors[-2] / errors[-1]),
        ),
        "This is a slope without logarithms: are they missing on both axes?": (
            lambda dts, errors: np.polyfit(dts, errors, 1)[0],
            lambda dts, errors: (errors[0] - errors[1]) / (dts[0] - dts[1]),
            lambda dts, errors: (errors[0] - errors[-1]) / (dts[0] - dts[-1]),
        ),
        "This is log(error)/log(dt) of one point, which the constant in front of the power "
        "spoils: take the change between two.": (
            lambda dts, errors: np.log(errors[-1]) / np.log(dts[-1]),
            lambda dts, errors: np.log(errors[0]) / np.log(dts[0]),
        ),
        "The order is rounded; what is observed need not be a whole number.": (
            lambda *case: np.round(_observed(*case))
        ),
    }
    cases = [_power_law(rng) for _ in range(4)]
    compare(observed_order, cases, _observed, mistakes, "one number", fails, 1e-5)
