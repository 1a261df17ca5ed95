"""Checks of the workbook's choice of a step: a pair of methods, step control, an event located."""

import numpy as np

from suspension.practice._order import order_of_step, patient, problem, said
from suspension.practice.feedback import (
    PATIENCE,
    Wrong,
    check,
    compare,
    fits,
    must_have_shape,
    name_mistake,
    near,
    numbers,
    several,
)

__all__ = [
    "check_between",
    "check_integrate",
    "check_locate",
    "check_next_step",
    "check_pair_step",
]

SAFETY, LEAST, MOST = 0.9, 0.2, 5.0


def _next_step(dt, error, tolerance, order, power=1, safety=SAFETY, least=LEAST, most=MOST):
    with np.errstate(divide="ignore"):
        factor = safety * np.power(np.divide(tolerance, error), 1 / (order + power))
    return dt * np.clip(factor, least, most)


@check(
    "next_step(dt, error, tolerance, order)",
    "the error of one step goes with dt to the power order + 1.",
)
def check_next_step(next_step, rng):
    """Whether ``next_step(dt, error, tolerance, order)`` proposes the next step."""

    def with_(**changes):
        return lambda *case: _next_step(*case, **changes)

    def fails(answer, dt, error, tolerance, order):
        same = float(np.ravel(next_step(dt, tolerance, tolerance, order))[0]) / dt
        if not np.isclose(same, SAFETY):
            return (
                f"Where the error is just what is allowed, the step becomes {same:.4g} times "
                "as long, and should shrink to 0.9 of it."
            )
        half = (
            float(np.ravel(next_step(dt, tolerance / 2 ** (order + 1), tolerance, order))[0]) / dt
        )
        if not np.isclose(half, 2 * SAFETY):
            return (
                f"For an error that is 2^(order + 1) times too small, the step becomes "
                f"{half:.4g} times as long, and should become 1.8 times: twice, for the power "
                "of the error of one step is order + 1, times 0.9."
            )
        return (
            f"For an error of {error:.3g} with {tolerance:.3g} allowed the step becomes "
            f"{answer / dt:.4g} times as long. Is the factor kept between 0.2 and 5?"
        )

    def inverse(dt, error, tolerance, order):
        factor = SAFETY * (error / tolerance) ** (1 / (order + 1))
        return dt * np.clip(factor, LEAST, MOST)

    def power_itself(dt, error, tolerance, order):
        with np.errstate(divide="ignore"):
            factor = SAFETY * np.power(np.divide(tolerance, error), order + 1)
        return dt * np.clip(factor, LEAST, MOST)

    def safety_within(dt, error, tolerance, order):
        return _next_step(dt, error, SAFETY * tolerance, order, safety=1)

    def safety_after(dt, error, tolerance, order):
        return SAFETY * _next_step(dt, error, tolerance, order, safety=1)

    mistakes = {
        "The power is 1/order, which is for the error of a whole run: that of one step goes with "
        "dt^(order + 1).": with_(power=0),
        "The power is 1/(order + 2), one too many: the error of one step goes with dt^(order + "
        "1).": with_(power=2),
        "The power is order + 1, where its inverse is needed: error ∝ dt^(order + 1) is solved "
        "for dt.": (power_itself),
        "The quotient stands the wrong way round: an error that is too large must shorten the "
        "step.": inverse,
        "The safety factor 0.9 is missing: without it many a step would be rejected.": with_(
            safety=1
        ),
        "The safety factor stands within the root, where it does little: 0.9 times "
        "the root.": safety_within,
        "The safety factor multiplies after the limits are applied: limit 0.9 times the root "
        "to 0.2 ... 5.": (safety_after),
        "The factor has no upper limit: where the error happens to be tiny the step must not "
        "grow more than five times.": with_(most=np.inf),
        "The factor has no lower limit: a step must not shrink to less than a "
        "fifth at once.": with_(least=0),
        "The factor is not limited: keep it between 0.2 and 5.": with_(least=0, most=np.inf),
        "This is the factor: the step itself is asked for, dt times that.": (
            lambda dt, *case: _next_step(dt, *case) / dt
        ),
    }
    cases = []
    for order in (1, 2, 3, 4):
        for ratio in (1e-12, 1e9, rng.uniform(0.3, 0.9), rng.uniform(1.5, 4)):
            tolerance = 10 ** rng.uniform(-8, -3)
            cases.append((rng.uniform(0.01, 0.2), ratio * tolerance, tolerance, order))
    compare(next_step, cases, _next_step, mistakes, "one number, in s", fails)
    try:
        at_zero = float(np.ravel(next_step(0.1, 0.0, 1e-6, 2))[0])
    except Wrong as wrong:
        raise Wrong(
            f"For an error of exactly 0, which level ground makes, {wrong} There the step may "
            "grow five times."
        ) from None
    if not np.isclose(at_zero, 0.5):
        raise Wrong(
            "For an error of exactly 0, which level ground makes, the step should become five "
            "times as long, "
            f"and it becomes {at_zero / 0.1:.3g} times."
        )


def pair(
    slopes=((0, 1 / 2, 1 / 2), (1, 3 / 4, 3 / 4)),
    high=(2 / 9, 1 / 3, 4 / 9),
    low=(7 / 24, 1 / 4, 1 / 3, 1 / 8),
    advance="high",
    times=1,
    end=1,
    last="new",
):
    """The pair of Bogacki and Shampine, or with something in it changed: step -> w, error."""

    def step(g, w, t, dt):
        k = [g(w, t)]
        for along, part, time in slopes:
            k.append(g(w + part * dt * k[along], t + times * time * dt))
        new = w + dt * sum(b * each for b, each in zip(high, k))
        k.append(g(new if last == "new" else w + dt * k[2], t + end * times * dt))
        lower = w + dt * sum(b * each for b, each in zip(low, k))
        return (new if advance == "high" else lower), new - lower

    return step


def _changed(result):
    """The right pair, with its results changed."""
    return lambda g, w, t, dt: result(*pair()(g, w, t, dt), w, dt)


PAIRS = {
    "The step goes on with the second-order result: once both are there, take the better one.": (
        pair(advance="low")
    ),
    "g4 is taken at w + dt g3: it is the slope at the new w, which the next "
    "step begins with.": pair(last="old"),
    "g4 is taken at the time t: the new w belongs to t + dt.": pair(end=0),
    "All slopes are taken at the time t: g2 belongs to t + dt/2, g3 to t + 3/4 dt, g4 to t + "
    "dt.": pair(times=0),
    "g3 seems to use g1. It should use g2, over 3/4 dt.": pair(
        slopes=((0, 1 / 2, 1 / 2), (0, 3 / 4, 3 / 4))
    ),
    "g3 seems to go half a step. It should go 3/4 dt.": (
        pair(slopes=((0, 1 / 2, 1 / 2), (1, 1 / 2, 1 / 2))),
        pair(slopes=((0, 1 / 2, 1 / 2), (1, 1 / 2, 3 / 4))),
    ),
    "The weights of the step are 2/9, 3/9, 4/9: are they in another order?": (
        pair(high=(4 / 9, 1 / 3, 2 / 9))
    ),
    "The error is not multiplied by dt: it is a difference of two states, not "
    "of two slopes.": _changed(lambda new, error, w, dt: (new, error / dt)),
    "The error is the change of the state: it should be the difference of both results.": _changed(
        lambda new, error, w, dt: (new, new - w)
    ),
    "The second thing is the second-order result: the difference of both is asked for.": _changed(
        lambda new, error, w, dt: (new, new - error)
    ),
    "State and error have changed places.": _changed(lambda new, error, w, dt: (error, new)),
    "g4 does not count in the error: the second-order result takes 1/8 of it.": pair(
        low=(7 / 24, 1 / 4, 1 / 3, 0)
    ),
}


@check(
    "pair_step(g, w, t, dt)",
    "of order 3, and the error is that of the second-order result beside it.",
)
def check_pair_step(pair_step, rng):
    """Whether ``pair_step(g, w, t, dt)`` gives a step of order 3 and its error estimate."""

    def ask(g, *rest):
        parts = several(pair_step(patient(g, "pair_step"), *rest), ["w", "error"], "pair_step", 2)
        return [parts[0], np.abs(parts[1])]

    cases = []
    for found in (problem(rng) for _ in range(4)):
        cases.append((found.g, found.w0, rng.uniform(0.1, 2), rng.uniform(0.1, 0.4)))
    answers = [ask(*case) for case in cases]
    for answer, (_, w, *_) in zip(answers, cases):
        must_have_shape(
            answer[0], w.shape, pair_step.name, "the state after the step, before its error"
        )
        if answer[1].shape != w.shape:
            raise Wrong(
                f"The error has shape {answer[1].shape}; one number for each component of w is "
                "asked for, the norm is taken later."
            )
    if fits(answers, cases, _absolute(pair())):
        return
    order = order_of_step(lambda *case: ask(*case)[0], rng)
    mistakes = {
        words: tuple(map(_absolute, steps if isinstance(steps, tuple) else (steps,)))
        for words, steps in PAIRS.items()
    }
    begin = f"This step {said(order, 3)}. " if order < 2.7 else ""
    name_mistake(answers, cases, {begin + words: steps for words, steps in mistakes.items()})
    if begin:
        raise Wrong(
            f"{begin}Are the slopes taken at t, t + dt/2 and t + 3/4 dt, each along the one "
            "before, with the weights 2/9, 3/9, 4/9?"
        )
    raise Wrong(
        "The step is of order 3, but its error is not the one of the second-order result: is "
        "it dt times the difference of both rows of weights, g4 included?"
    )


def _absolute(step):
    """State and error as one array, the error without its sign: either difference will do."""

    def both(*case):
        new, error = step(*case)
        return np.array([new, np.abs(error)])

    return both


@check(
    "integrate(step, g, w0, dt, tfinal, tolerance)",
    "no step with too large an error is kept, steps grow and shrink, and the last ends at tfinal.",
)
def check_integrate(integrate, rng):
    """Whether ``integrate(step, g, w0, dt, tfinal, tolerance)`` controls its steps."""
    for dt, sign in ((1e-3, 0), (1.3, 1), (1.3, -1)):
        found, tolerance = problem(rng), 10 ** rng.uniform(-6, -5)
        while sign and not _first_error_has(sign, found, dt, tolerance):
            found = problem(rng)
        _check_run(integrate, found, dt, rng.uniform(3, 5), tolerance)


def _first_error_has(sign, found, dt, tolerance):
    """Whether the first step is too coarse by an error of this sign alone."""
    error = sign * pair()(found.g, found.w0, 0.0, dt)[1]
    return error.max() > tolerance > -error.min()


def _check_run(integrate, found, dt, tfinal, tolerance):
    g, taken = patient(found.g, integrate.name), []

    def step(g, w, t, dt):
        taken.append((float(t), float(dt)))
        _must_go_on(taken)
        return pair()(g, w, t, dt)

    W, T = several(integrate(step, g, found.w0, dt, tfinal, tolerance), ["W", "T"], integrate.name)
    if T.ndim != 1 or W.shape != (len(found.w0), len(T)):
        turned = ": is a `.T` missing?" if W.shape == (T.size, len(found.w0)) else "."
        raise Wrong(
            f"W has shape {W.shape} and T {T.shape}; a column of W belongs to each time{turned}"
        )
    if not (np.isfinite(W).all() and np.isfinite(T).all()):
        raise Wrong("The run ends in nan or inf.")
    if T[0] != 0 or not near(W[:, 0], found.w0):
        raise Wrong(
            "The run should begin with w0 at t = 0: are both put into the lists before the loop?"
        )
    steps = np.diff(T)
    if (steps <= 0).any():
        raise Wrong(
            "A time comes twice, or later than the next: are rejected steps stored, too? Only "
            "what is kept belongs in W and T."
        )
    _check_steps(found.g, W, T, dt, tolerance)
    if T[-1] > tfinal * (1 + 1e-9):
        raise Wrong(
            f"The run ends at {T[-1]:.5g} s, after tfinal = {tfinal:.5g} s: shorten the last step, "
            "min(dt, tfinal − t)."
        )
    if T[-1] < tfinal * (1 - 1e-9):
        raise Wrong(f"The run ends at {T[-1]:.5g} s, before tfinal = {tfinal:.5g} s.")
    if len(steps) > 2 and np.ptp(steps[:-1]) < 1e-9 * tfinal:
        raise Wrong(
            "All steps are equally long: is the proposal of `next_step` put into dt after a step "
            "that is kept, too?"
        )
    needed = _fewest_steps(found, tfinal, tolerance)
    if len(steps) > 3 * needed:
        raise Wrong(
            f"The run takes {len(steps)} steps where some {needed} would do. Do its steps grow "
            "again where they may, and is the tolerance the one that was given?"
        )


def _must_go_on(taken):
    """Stop a loop in which dt becomes tiny, or is tried again and again."""
    if len(taken) < PATIENCE // 8:
        return
    last = taken[-1000:]
    if not max(dt for _, dt in last) > 1e-4:
        raise Wrong(
            "dt becomes tiny, and the run does not come to an end: is the error that is handed to "
            "`next_step` the largest absolute value? And does the loop end at tfinal?"
        )
    if len(set(last)) == 1:
        raise Wrong(
            "The same dt is tried again and again, and the run does not come to an end: is dt "
            "shortened where a step is rejected, and t moved on where one is kept?"
        )


def _check_steps(g, W, T, dt, tolerance):
    """Each column is the step from the one before, with an error that is allowed."""
    coarse = []
    for j, taken in enumerate(np.diff(T)):
        new, error = pair()(g, W[:, j], T[j], taken)
        if not near(W[:, j + 1], new, 1e-6):
            raise Wrong(_told_apart(g, W, T, j, dt))
        if np.abs(error).max() > tolerance * (1 + 1e-9):
            coarse.append((T[j], error))
    if not coarse:
        return
    t, error = max(coarse, key=lambda each: np.abs(each[1]).max())
    if all(error.max() <= tolerance for _, error in coarse):
        cause = "It is negative: has the absolute value been forgotten?"
    elif all(np.abs(error).mean() <= tolerance for _, error in coarse):
        cause = "The mean of its components is allowed: is the largest asked?"
    else:
        cause = "Is a step that is too coarse rejected?"
    raise Wrong(
        f"The step from t = {t:.4g} s is kept with an error of {np.abs(error).max():.2g}, and "
        f"{tolerance:.2g} is allowed. {cause}"
    )


def _told_apart(g, W, T, j, dt):
    """Why column j + 1 is not the step from column j."""
    lower = np.subtract(*pair()(g, W[:, j], T[j], T[j + 1] - T[j]))
    if near(W[:, j + 1], lower, 1e-6):
        return "The run goes on with the second-order result, w − error: take w."
    if near(W[:, j + 1], W[:, j]):
        return (
            f"The state does not change from t = {T[j]:.4g} s to the next time: is the new one put "
            "in its place?"
        )
    if j == 0 and near(W[:, 1], pair()(g, W[:, 0], 0.0, dt)[0], 1e-6):
        return (
            f"The first step was taken with dt = {dt:g} s, and t has moved on by {T[1]:.4g} s: is "
            "t moved on before a new dt is proposed?"
        )
    return (
        f"The state at T[{j + 1}] is not the step from T[{j}] over the time between: are w and t "
        "both left as they are where a step is rejected, and both moved on where one is kept?"
    )


def _fewest_steps(found, tfinal, tolerance):
    """How many steps a controller takes that begins with a good one."""
    w, t, dt, count = found.w0, 0.0, 0.1, 0
    while tfinal - t > 1e-12:
        dt = min(dt, tfinal - t)
        new, error = pair()(found.g, w, t, dt)
        largest = np.abs(error).max()
        if largest <= tolerance:
            w, t, count = new, t + dt, count + 1
        dt = _next_step(dt, largest, tolerance, 2)
    return count


def _swing(rng, kind):
    """A smooth f of time and samples of it: falls through zero ... or not."""
    q, phase, T = rng.uniform(3, 5), rng.uniform(0.2, 1.2), np.linspace(0, 3, 40)
    if kind == "never":
        return lambda t: 1.5 + np.cos(q * t), T
    if kind == "rises first":
        return lambda t: np.sin(q * t - phase) + 0.2 * np.cos(1.7 * t), T
    if kind == "on a sample":
        zero = T[7]
        return lambda t: (zero - t) * (1 + 0.5 * np.cos(q * t)), T
    return lambda t: np.cos(q * t) + 0.3 * np.exp(-t), T


def _brackets(f, T):
    values = np.array([f(t) for t in T])
    return np.flatnonzero((values[:-1] > 0) & (values[1:] <= 0))


def _bisect(f, low, high):
    """Where a function that is positive at `low` and not at `high` vanishes."""
    positive = f(low) > 0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if (f(middle) > 0) == positive else (low, middle)
    return high


@check("locate(f, T)", "where f first falls through zero, to roundoff, or None where it does not.")
def check_locate(locate, rng):
    """Whether ``locate(f, T)`` finds where f first falls from above zero to zero or below."""
    kinds = ("falls", "rises first", "falls", "never", "on a sample")
    cases = [_swing(rng, kind) for kind in kinds]
    answers = []
    for f, T in cases:
        result = locate(patient(f, "locate"), T)
        answers.append(np.array(()) if result is None else numbers(result, "locate").squeeze())

    def where(choose, pick=0):
        def found(f, T):
            j = _brackets(f, T)
            return np.array(choose(f, T[j[pick]], T[j[pick] + 1])) if len(j) else np.array(())

        return found

    def linear(f, low, high):
        return low + (high - low) * f(low) / (f(low) - f(high))

    def any_change(f, T):
        signs = np.sign([f(t) for t in T])
        j = np.flatnonzero(signs[:-1] * signs[1:] < 0)
        falls = _brackets(f, T)
        if not len(j):
            return right(f, T)
        first = min(j[0], falls[0])
        return np.array(_bisect(f, T[first], T[first + 1]))

    def rising(f, T):
        values = np.array([f(t) for t in T])
        j = np.flatnonzero((values[:-1] < 0) & (values[1:] >= 0))
        return np.array(_bisect(f, T[j[0]], T[j[0] + 1])) if len(j) else np.array(())

    def strictly(f, T):
        values = np.array([f(t) for t in T])
        if (values == 0).any():
            return np.array(())
        return right(f, T)

    def nearest(f, T):
        return np.array(T[np.argmin(np.abs([f(t) for t in T]))])

    def not_none(f, T):
        return right(f, T) if len(_brackets(f, T)) else np.array(float(T[0]))

    def last_time(f, T):
        return right(f, T) if len(_brackets(f, T)) else np.array(float(T[-1]))

    right = where(_bisect)
    mistakes = {
        "This is the end of the step in which f falls through zero: it is known no better than "
        "the step is long. Halve that interval until it is short enough.": where(
            lambda f, low, high: high
        ),
        "This is the beginning of the step in which f falls through zero: halve that interval "
        "until it is short enough.": where(lambda f, low, high: low),
        "This is the middle of the step in which f falls through zero: halve again, until it "
        "is short enough.": where(lambda f, low, high: (low + high) / 2),
        "This is where the straight line between two samples vanishes: a good first guess, "
        "wrong where f bends. Ask f there, and go on.": where(linear),
        "This is the last time that f falls through zero: the first is asked for.": where(
            _bisect, -1
        ),
        "This is any change of sign: where f rises through zero a wheel lands. Only where it "
        "falls, please.": (any_change),
        "This is where f rises through zero: it should fall.": rising,
        "Where a sample is exactly zero the event is missed: a product of two values is not "
        "negative there. Ask f(low) > 0 >= f(high).": strictly,
        "This is the sample with the least |f|: the event lies between samples.": nearest,
        "Where f never falls through zero the answer should be None.": (not_none, last_time),
    }
    close = 1e-8
    if fits(answers, cases, right, close):
        return
    name_mistake(answers, cases, mistakes, close)
    for answer, (f, T) in zip(answers, cases):
        wanted = right(f, T)
        if near(answer, wanted, close):
            continue
        if not answer.size:
            raise Wrong(f"f falls through zero near t = {wanted:.3g}, and you return None.")
        if answer.shape != ():
            raise Wrong(
                f"`locate` returns an array of shape {answer.shape}: one time is asked for."
            )
        if not wanted.size:
            raise Wrong(f"Here f never falls through zero, and you return {answer:.4g}, not None.")
        raise Wrong(
            f"At your time, {answer:.6g}, f is {f(float(answer)):.2g}; it first falls through "
            "zero near "
            f"{wanted:.4g}. Is the interval halved until it is shorter than roundoff?"
        )


def _between(t, T, W, S, index=None, scaled=1, second=-1, turned=False, slopes=1, column=0):
    """The cubic through both ends of the step that holds t, or with something in it changed."""
    T, last = np.asarray(T), len(T) - 2
    j = int(np.searchsorted(T, t, side="right")) - 1 + column
    j = min(max(j, 0), last) if index is None else index
    dt = T[j + 1] - T[j]
    u = (t - T[j]) / dt
    u = 1 - u if turned else u
    bend = (1 - u) * S[:, j] + second * u * S[:, j + 1]
    ends = (1 - u) ** 2 * (1 + 2 * u) * W[:, j] + u**2 * (3 - 2 * u) * W[:, j + 1]
    return ends + slopes * dt**scaled * u * (1 - u) * bend


def _straight(t, T, W, S):
    return np.array([np.interp(t, T, row) for row in W])


def _beginning(t, T, W, S):
    return W[:, max(int(np.searchsorted(T, t, side="right")) - 1, 0)]


def _nearest(t, T, W, S):
    return W[:, int(np.argmin(np.abs(np.asarray(T) - t)))]


def _along_slope(t, T, W, S):
    j = min(int(np.searchsorted(T, t, side="right")) - 1, len(T) - 2)
    return W[:, j] + (t - T[j]) * S[:, j]


BETWEENS = {
    "This is a straight line between both ends: the slopes say how the state bends.": _straight,
    "This is the state at the beginning of the step.": (
        _beginning,
        lambda t, T, *W_S: _beginning(min(t, T[-2]), T, *W_S),
    ),
    "This is the state at the nearest time: between two times it is another one.": _nearest,
    "This goes on along the slope at the beginning, and misses the state at the end.": _along_slope,
    "The slopes are not multiplied by the length of the step.": (
        lambda *case: _between(*case, scaled=0)
    ),
    "The slope at the end counts with the wrong sign.": (lambda *case: _between(*case, second=1)),
    "The slopes are left out: the cubic begins and ends without one.": (
        lambda *case: _between(*case, slopes=0)
    ),
    "Beginning and end have changed places: u is 0 at the beginning.": (
        lambda *case: _between(*case, turned=True)
    ),
    "This is the cubic of the step after the one that holds t.": (
        lambda *case: _between(*case, column=1)
    ),
    "This is the cubic of the step before the one that holds t.": (
        lambda *case: _between(*case, column=-1)
    ),
    "This is the cubic of the first step, wherever t is.": (lambda *case: _between(*case, index=0)),
}


@check(
    "between(t, T, W, S)",
    "the cubic has the states and the slopes of both ends of its step.",
)
def check_between(between, rng):
    """Whether ``between(t, T, W, S)`` is the state at a time between two columns of W."""
    T = np.cumsum(np.append(0, rng.uniform(0.1, 0.4, 6)))
    found = problem(rng)
    W = np.transpose([found.exact(t) for t in T])
    S = np.transpose([found.g(w, t) for w, t in zip(W.T, T)])
    inside = T[:-1] + rng.uniform(0.1, 0.9, 6) * np.diff(T)
    cases = [(t, T, W, S) for t in (*inside, T[0], T[2], T[-1])]

    def fails(answer, t, T, W, S):
        at = [j for j, time in enumerate(T) if time == t]
        if at:
            return f"At T[{at[0]}] itself the state should be W[:, {at[0]}], and it is another one."
        return (
            "Where T, W and S belong to a cubic in t, the state should be that of the cubic. Does "
            "yours have the states W and the slopes S at both ends of the step?"
        )

    means = "the state, one number for each row of W"
    compare(between, cases, _between, BETWEENS, means, fails)
