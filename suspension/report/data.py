"""Sentences and rows about the data: what was read, whether it was invented, how stiff it is."""

import numpy as np

from suspension._readings import NOISE, RESOLUTION, SEED, TRUE_STIFFNESS
from suspension.report.words import (
    ROUNDOFF,
    SPACE,
    count,
    fixed,
    interval,
    join,
    number,
    percent,
    quantity,
)
from suspension.springs import is_synthetic
from suspension.uncertainty import EXACT

__all__ = [
    "caution",
    "consequence_rows",
    "data_rows",
    "existence",
    "hindsight",
    "made_sentence",
    "question_rows",
    "read_sentence",
    "slope_sentence",
    "source_sentence",
    "speed_digits",
    "speed_row",
    "stiffness_rows",
    "stiffness_sentence",
    "synthetic_note",
]

SPEED_ROW = "critical speed (m/s)", f"95{SPACE}% interval (m/s)", "note"
BETRAYED = "../notebooks/01-regression.ipynb#what-would-betray-a-wrong-model"


# --- what was read ----------------------------------------------------------------------------


def source_sentence(data):
    """Which file, how many readings, and whether they are invented."""
    origin = f"The file `{data.attrs['source']}` holds {count(len(data), 'reading')}. "
    if is_synthetic(data):
        return origin + (
            "**These data are synthetic:** they stand in for measurements that are not public. "
            "Every number that follows from them is about an invented spring."
        )
    return origin + "These are not the synthetic data this book ships with."


def read_sentence(data, fit):
    """What was read: ranges, units, and what the reader noticed."""
    x, force = data["delta_over_delta_max"], data["force"]
    sentence = (
        f"The displacements $\\delta/\\delta_{{\\max}}$ go from {_end(x.min())} to {_end(x.max())} "
        f"with $\\delta_{{\\max}}$ = {quantity(1000 * fit.delta_max, 'mm')}, the forces from "
        f"{_end(force.min())} to {_end(force.max())}{SPACE}N for the pair of springs."
    )
    notes = data.attrs.get("notes", ())
    return sentence + (f" The reader noticed: {join(notes)}." if notes else "")


def slope_sentence(fit):
    """The stiffness that follows from the readings."""
    return f"The fitted slope at zero is {quantity(fit.stiffness, 'N/m', 4)}."


def _end(x):
    """A reading in at most four digits, without zeros behind."""
    text = f"{round(float(x), 4) + 0.0:.4g}"
    return text.replace("-", "−")


def data_rows(data):
    """The readings, each column with the decimals it needs, four at most."""
    columns = {
        r"$\delta/\delta_{\max}$": data["delta_over_delta_max"].to_numpy(),
        "force (N)": data["force"].to_numpy(),
    }
    texts = {name: [fixed(x, _decimals(xs)) for x in xs] for name, xs in columns.items()}
    return [dict(zip(texts, row)) for row in zip(*texts.values())]


def _decimals(values):
    for decimals in range(4):
        if np.allclose(values, np.round(values, decimals), rtol=0, atol=ROUNDOFF):
            return decimals
    return 4


# --- what this copy of the book is about ------------------------------------------------------


def question_rows(speeds, steps, halved_steps, duration, distance):
    """The numbers of the questions: speeds in m/s, steps and duration in s, distance in m."""
    asked = [
        ("speeds over the bump", speeds, "m/s", "2, 3, 6 and 10"),
        ("steps that may be unstable", steps, "s", "4, 7 and 9"),
        ("steps that are compared", halved_steps, "s", "5 and 6"),
        ("length of a free motion", [duration], "s", "5 and 9"),
        ("way of a run", [distance], "m", "6 and 10"),
    ]
    return [
        {"what": what, "value": join(f"{x:g}" for x in values) + SPACE + unit, "questions": where}
        for what, values, unit, where in asked
    ]


def synthetic_note(data):
    """A short sentence for any page: on which spring its numbers rest."""
    if is_synthetic(data):
        return "The spring data are synthetic: they stand in for measurements that are not public."
    return "The spring is one that was measured, not the synthetic one of this project."


def made_sentence(data):
    """How the synthetic data were made; of others this book knows nothing."""
    if not is_synthetic(data):
        return (
            "The synthetic stand-in that this book ships with was not used, and nothing is known "
            "here of the spring behind these data but the readings."
        )
    return (
        "How the stand-in was made, once, without tuning: "
        f"{count(len(data), 'displacement')} from 0 to 1; a linear spring of "
        f"{quantity(TRUE_STIFFNESS, 'N/m')} without preload; Gaussian noise with a standard "
        f"deviation of {NOISE:g}{SPACE}N; readings rounded to {RESOLUTION:g}{SPACE}N, which is a "
        "scale that reads to one gram, doubled. The generator is `data/make_spring_data.py` and "
        f"its seed is {SEED}. Knowing the truth is a luxury that real data never grant, and "
        "[Part I](../notebooks/01-regression.ipynb) makes use of it only in hindsight."
    )


def hindsight(data, fit):
    """Whether the interval of the stiffness holds the truth, which only synthetic data have."""
    if not is_synthetic(data):
        return ""
    low, high = fit.stiffness_interval()
    where = "inside" if low <= TRUE_STIFFNESS <= high else "outside"
    return (
        "Only synthetic data allow a last test, in hindsight: the true stiffness, "
        f"{quantity(TRUE_STIFFNESS, 'N/m')}, is {where} the interval of Answer 1(ii)."
    )


# --- which stiffness does the robot feel? -----------------------------------------------------


def stiffness_rows(fit, load):
    """Each stiffness with its interval and what it rests on.

    Parameters
    ----------
    fit : SpringFit
    load : float
        The force that one pair of springs carries at rest, N.
    """
    linear = fit.linearity().linear
    remarks = {
        fit.slope.name: "asked for in Question 1",
        fit.line.name: "compatible with the data" if linear else "contradicted by the data",
    }
    tangent = fit.tangent(load)
    if tangent is not None:
        remarks[tangent.name] = f"at $\\delta/\\delta_{{\\max}}$ = {_static(fit, load)}"
    return [
        {
            "stiffness": stiffness.name,
            "estimate (N/m)": _stiffness(stiffness.value, stiffness.error),
            f"95{SPACE}% interval (N/m)": _interval(stiffness),
            "standard error (N/m)": "0" if _exact(stiffness) else number(stiffness.error, 2),
            "remark": remarks[stiffness.name],
        }
        for stiffness in fit.stiffnesses(load)
    ]


def _exact(stiffness):
    """Whether the readings lie on the curve, so that roundoff is all the error there is."""
    return stiffness.error <= EXACT * stiffness.value


def _decimals_for(error):
    return 0 if error > 10 else 1


def _stiffness(value, error):
    return fixed(value, _decimals_for(error))


def _interval(stiffness):
    ends = interval(*stiffness.interval(), decimals=_decimals_for(stiffness.error))
    return ends.replace(" ", SPACE)


def _static(fit, load):
    """The displacement at rest, and whether anybody has measured there."""
    x = fit.displacement(load)
    outside = x > fit.x.max() or x < fit.x.min()
    return fixed(x, 3) + (", outside the measured range" if outside else "")


def stiffness_sentence(fit, load):
    """Which stiffness the robot feels: the line's if the data allow it, else the tangent's.

    Parameters
    ----------
    fit : SpringFit
    load : float
        The force that one pair of springs carries at rest, N.
    """
    parts = [
        "The data do not contradict a line through the origin; one may take its slope."
        if fit.linearity().linear
        else "The data contradict a line through the origin, so the slope of the best such line is "
        "no more than a mean over the measured range.",
        _at_rest(fit, load),
        caution(fit, "The intervals"),
    ]
    return " ".join(filter(None, parts))


def _at_rest(fit, load):
    tangent = fit.tangent(load)
    half = f"half of the weight ({quantity(load, 'N')})"
    if tangent is None:
        return f"The fitted parabola bends down before it carries {half}: it has no tangent there."
    extrapolated = ", an extrapolation," if "outside" in _static(fit, load) else ""
    compared = _compared(tangent, fit.slope)
    return f"The tangent at {half}{extrapolated} is {compared}."


def _compared(tangent, slope):
    change = tangent.value / slope.value - 1
    if abs(change) < 0.0005:
        return "the same as the slope at zero"
    more = "more" if change > 0 else "less"
    low, high = slope.interval()
    inside = "inside" if low <= tangent.value <= high else "**outside**"
    return f"{percent(abs(change))} {more} than the slope at zero and {inside} its interval"


def caution(fit, subject="The interval"):
    """A warning beside what rests on independent errors, empty if the residuals allow them.

    Parameters
    ----------
    fit : SpringFit
    subject : {"The interval", "The intervals", "The confidence", "The F test"}
    """
    neighbours = fit.neighbours
    if not neighbours.suspicious:
        return ""
    assume, they = ("assume", "they") if subject.endswith("s") else ("assumes", "it")
    return (
        f"{subject} {assume} independent errors, but "
        f"[neighbouring residuals correlate]({BETRAYED}) with "
        f"{fixed(neighbours.correlation, 2)}: {they} cannot be relied on."
    )


# --- what they do to the critical speeds ------------------------------------------------------


def existence(critical):
    """Where in the interval of the stiffness a critical speed exists, empty if everywhere.

    Parameters
    ----------
    critical : suspension.uncertainty.CriticalSpeed
    """
    born, dies = critical.born, critical.dies
    pair_from = born.k if born and born.why == "pair" else None
    pair_to = dies.k if dies and dies.why == "pair" else None
    words = []
    if pair_from and pair_to:
        words.append(f"exists only for k from {number(pair_from, 4)} to {_k(pair_to)}")
    elif pair_from:
        words.append(f"exists only for k > {_k(pair_from)}")
    elif pair_to:
        words.append(f"exists only for k < {_k(pair_to)}")
    if born and born.why == "range":
        words.append(f"enters the range of speeds at k = {_k(born.k)}")
    if dies and dies.why == "range":
        words.append(f"leaves the range of speeds at k = {_k(dies.k)}")
    return join(words, none="")


def _k(k):
    return quantity(k, "N/m", 4)


def consequence_rows(by_stiffness):
    """Each stiffness, and each critical speed that follows from it.

    Parameters
    ----------
    by_stiffness : sequence of (Stiffness, sequence of CriticalSpeed)
        From `suspension.uncertainty.critical_speeds_by_stiffness`.
    """
    rows = []
    for stiffness, speeds in by_stiffness:
        name = f"{stiffness.name}, {_stiffness(stiffness.value, stiffness.error)}{SPACE}N/m"
        told = [speed_row(critical) for critical in speeds] or [dict.fromkeys(SPEED_ROW, "–")]
        rows += [{"stiffness": name, **row} for row in told]
    return rows


def speed_row(critical):
    """A critical speed, its interval, and where in that of the stiffness it exists.

    Parameters
    ----------
    critical : suspension.uncertainty.CriticalSpeed
    """
    low, high = critical.low, critical.high
    digits = speed_digits(low, high)
    speed = "–" if critical.speed is None else number(critical.speed, digits)
    ends = f"{number(low, digits)} to {number(high, digits)}"
    return dict(zip(SPEED_ROW, (speed, ends, existence(critical) or "–")))


def speed_digits(low, high):
    """Three digits, or more where they are needed to tell the two ends apart, six at most."""
    for digits in (3, 4, 5):
        if high - low > 5 * 10.0 ** (np.floor(np.log10(high)) + 1 - digits):
            return digits
    return 6 if high > low else 4
