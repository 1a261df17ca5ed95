"""What is typically wrong in a loop over the steps, whatever the step."""

import numpy as np

from suspension.practice.feedback import Wrong, near, several

SHAPE = "a column for each time, the first of them w0"


def history(step, w0, dt, tfinal):
    """The loop as it should be, of ``step(w, t, dt)``: W, T."""
    T = dt * np.arange(round(tfinal / dt) + 1)
    W = np.empty((len(w0), len(T)))
    W[:, 0] = w0
    for j in range(len(T) - 1):
        W[:, j + 1] = step(W[:, j], T[j], dt)
    return W, T


def _truncated(step, w0, dt, tfinal):
    W, T = history(step, w0, dt, tfinal)
    if np.asarray(w0).dtype.kind == "i":  # into an array of integers
        W = np.zeros(W.shape, int)
        W[:, 0] = w0
        for j in range(len(T) - 1):
            W[:, j + 1] = step(W[:, j].astype(float), T[j], dt)
    return W


def _last_everywhere(step, w0, dt, tfinal):
    W, _ = history(step, w0, dt, tfinal)
    return np.repeat(W[:, -1:], W.shape[1], axis=1)


def _from_w0(step, w0, dt, tfinal):
    W, T = history(step, w0, dt, tfinal)
    W[:, 1:] = np.transpose([step(W[:, 0], t, dt) for t in T[:-1]])
    return W


def _time_stands(step, w0, dt, tfinal):
    return history(lambda w, t, dt: step(w, 0.0, dt), w0, dt, tfinal)[0]


def _time_at_the_end(step, w0, dt, tfinal):
    return history(lambda w, t, dt: step(w, t + dt, dt), w0, dt, tfinal)[0]


def _changed_in_place(step, w0, dt, tfinal):
    W, _ = history(step, w0, dt, tfinal)
    return np.hstack([W[:, 1:], W[:, -1:]])


def _without_start(step, w0, dt, tfinal):
    W, _ = history(lambda w, t, dt: step(w, t, dt), np.zeros(len(w0)), dt, tfinal)
    return W


LOOPS = {
    "W has its times in the rows: a column for each time is asked for. Is a `.T` missing?": (
        lambda *case: history(*case)[0].T
    ),
    "This is the last state alone: all of them are asked for, w0 included.": (
        lambda *case: history(*case)[0][:, -1]
    ),
    "The last step is missing: J steps make J + 1 columns.": lambda *case: history(*case)[0][
        :, :-1
    ],
    "The first column, w0 itself, is missing.": lambda *case: history(*case)[0][:, 1:],
    "There is one step too many: does T go beyond tfinal?": (
        lambda step, w0, dt, tfinal: history(step, w0, dt, tfinal + dt)[0]
    ),
    "All columns are the last state: do they share one array that is changed in place? Store a "
    "copy.": (_last_everywhere),
    "Column j holds the state of column j + 1: is w changed in place before it is stored?": (
        _changed_in_place
    ),
    "Every step starts at w0: take the column before, W[:, j].": _from_w0,
    "Every step is taken at t = 0: hand on T[j].": _time_stands,
    "Every step is taken at the time of its end: step j starts at T[j].": _time_at_the_end,
    "With w0 in whole numbers the states are whole numbers, too: does W take the kind of w0? "
    "`np.empty` makes floats.": _truncated,
    "The run starts at zero: is w0 put into the first column?": _without_start,
}


def check_history(yours, arguments, step, w0, dt, tfinal):
    """W of one run; `Wrong` if it or its times tell of a mistake in the loop."""
    W, T = several(yours(*arguments, w0, dt, tfinal), ["W", "T"], yours.name)
    wanted_W, wanted_T = history(step, w0, dt, tfinal)
    if T.ndim == 2 and W.ndim == 1:
        raise Wrong(f"`{yours.name}` returns T before W: the order is W, T.")
    if T.ndim != 1:
        raise Wrong(f"`{yours.name}` returns T of shape {T.shape}; all times are asked for.")
    if T.shape == wanted_T.shape:
        check_times(yours.name, T, wanted_T, dt)
    return W, T, wanted_W, wanted_T


def check_times(name, T, wanted, dt):
    """Times are 0, dt, 2 dt, ... and tfinal."""
    if near(T, wanted):
        return
    if near(T - dt, wanted):
        raise Wrong("T starts at dt: the first time is that of w0, 0.")
    if len(T) > 1 and not np.isclose(T[1] - T[0], dt):
        raise Wrong(
            f"The times are {T[1] - T[0]:.6g} s apart, and dt is {dt:.6g} s: with `np.linspace`, "
            "J steps need J + 1 points."
        )
    raise Wrong(
        f"`{name}` returns {len(T)} times; 0, dt, 2 dt, ... up to tfinal are {len(wanted)}."
    )
