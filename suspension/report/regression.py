"""Sentences of Part I: the fit, what is known of its coefficients, and the springs they make."""

import math

import numpy as np

from suspension.report.data import caution
from suspension.report.rows import table
from suspension.report.words import (
    SPACE,
    Caption,
    count,
    fixed,
    interval,
    number,
    percent,
    pvalue,
    quantity,
)

__all__ = [
    "both_right",
    "coefficients",
    "coverage",
    "ellipse_figure",
    "experiments_figure",
    "fit_figure",
    "intervals",
    "joint_intervals",
    "linearity",
    "residuals",
    "residuals_figure",
    "stiffness",
    "summary",
]

KINDS = (
    (f"joint, p{SPACE}={SPACE}3 (the course's)", "scheffe", 3),
    (f"joint, p{SPACE}={SPACE}2", "scheffe", 2),
    ("Bonferroni, two at once", "bonferroni", 2),
    ("one at a time", "individual", 1),
)
FEELS = "../notebooks/01-regression.ipynb#which-stiffness-does-the-robot-feel"
NAMES = {0: r"the preload $\beta_0$", 2: r"the curvature $\beta_2$"}


def coefficients(fit):
    """The estimates with their standard errors, and the scatter of the readings."""
    rows = [
        {
            "coefficient": rf"$\beta_{j}$",
            "estimate (N)": fixed(fit.beta[j], 4),
            "standard error (N)": fixed(fit.errors[j], 4),
        }
        for j in range(3)
    ]
    return (
        f"{table(rows)}\n\nThe residual standard deviation is "
        f"{quantity(fit.scatter, 'N', 2)}, with "
        f"{count(fit.free, 'degree of freedom', 'degrees of freedom')}."
    )


def fit_figure(fit):
    """Caption of the fit."""
    bend = fit.beta[2] / abs(fit.beta[1])
    shape = "a nearly straight line" if abs(bend) < 0.05 else "a parabola that bends "
    if abs(bend) >= 0.05:
        shape += "upwards" if bend > 0 else "downwards"
    caption = (
        "**Question 1(i).** Force against relative displacement: data, least-squares fit and the "
        f"95{SPACE}% confidence band of the mean force."
    )
    alt = (
        f"Spring force against relative displacement: {count(len(fit.x), 'reading')} "
        f"and the fitted curve, {shape}, with the confidence band of the mean force."
    )
    return Caption(caption, alt)


def stiffness(fit):
    """Answer 1(ii)."""
    return (
        rf"$k_1 = \hat\beta_1/\delta_{{\max}} = {_plain(fit.stiffness, 1)}\ \text{{N/m}}$, with a "
        f"95{SPACE}% confidence interval of {_stiffness_interval(fit)} for this coefficient alone."
        f"{_and(caution(fit))}"
    )


def _and(sentence):
    """One more sentence, if there is one."""
    return f" {sentence}" if sentence else ""


def _plain(x, decimals):
    """A number for use in mathematics, where a minus is a hyphen."""
    return fixed(x, decimals).replace("−", "-")


def _stiffness_interval(fit):
    low, high = fit.stiffness_interval()
    decimals = 0 if high - low > 10 else 1
    return interval(low, high, "N/m", decimals)


def intervals(fit):
    """The four kinds of interval for the coefficients that a linear spring does not have."""
    rows = []
    for name, method, p in KINDS:
        ends = fit.intervals(method=method, p=p)
        rows.append(
            {
                "interval": name,
                "standard errors": fixed(fit.width(method=method, p=p), 3),
                r"$\beta_0$ (N)": _unbroken(ends[0]),
                r"$\beta_2$ (N)": _unbroken(ends[2]),
            }
        )
    return table(rows)


def _unbroken(ends):
    """An interval for a cell of a table."""
    return interval(*ends).replace(" ", SPACE)


def joint_intervals(fit):
    """Answer 1(iii)."""
    ends = fit.intervals()
    return (
        f"The 95{SPACE}% joint confidence intervals are {interval(*ends[0], 'N')} for "
        rf"$\beta_0^\text{{true}}$ and {interval(*ends[2], 'N')} for $\beta_2^\text{{true}}$."
        f"{_and(caution(fit, 'The intervals'))}"
    )


def ellipse_figure(fit):
    """Caption of the confidence ellipse."""
    accepted = fit.linearity().pvalue >= 0.05
    place = "inside" if accepted else "outside"
    caption = (
        rf"The 95{SPACE}% confidence ellipse for $(\beta_0, \beta_2)$ and the boxes that the four "
        "kinds of interval draw around the estimate (+). The joint box with $p = 2$ encloses the "
        f"ellipse exactly. The dot is a linear spring; it lies {place} the ellipse."
    )
    alt = (
        "Confidence ellipse for beta 0 and beta 2, tilted, inside the boxes of the joint "
        f"intervals. The point of a linear spring, the origin, lies {place} it."
    )
    return Caption(caption, alt)


def linearity(fit):
    """Answer 1(iv): whether the data justify a linear spring, by the intervals and the F test."""
    test = fit.linearity()
    ends = fit.intervals()
    away = [name for j, name in NAMES.items() if not ends[j, 0] <= 0 <= ends[j, 1]]
    if not away:
        where = "Zero lies in both joint intervals"
    elif len(away) == 2:
        where = "Zero lies in neither of the joint intervals"
    else:
        where = f"Zero does **not** lie in the joint interval of {away[0]}"
    tested = (
        rf"the F test of $\beta_0 = \beta_2 = 0$ gives F{SPACE}={SPACE}{_statistic(test)}, "
        f"{pvalue(test.pvalue)}"
    )
    if test.linear:
        return (
            f"{where}, and {tested}. The data give no reason to keep a preload or a curvature: a "
            r"standard linear spring, $F = k\delta$, is justified."
            f"{_and(caution(fit, 'The F test'))}"
        )
    but = "but" if not away else "and"
    return (
        f"{where}, {but} {tested}. At the 95{SPACE}% level the data contradict a standard linear "
        "spring without preload. What follows uses the slope at zero all the same, as the problem "
        f"asks; [which stiffness the robot feels]({FEELS}) is another question."
        f"{_and(caution(fit, 'The F test'))}"
    )


def _statistic(test):
    return number(test.statistic) if math.isfinite(test.statistic) else "∞"


def residuals_figure(fit):
    """Caption of the residuals."""
    largest = quantity(np.abs(fit.residuals).max(), "N", 2)
    return Caption(
        "Residuals against displacement, and ordered against what normal errors would give.",
        f"Left: residuals against displacement, with a zero line; the largest is {largest}. Right: "
        "ordered residuals against normal quantiles with a straight reference line.",
    )


def residuals(fit):
    """What a cubic term and the neighbouring residuals say about the model."""
    points, places = len(fit.x), len(np.unique(fit.x))
    if points < 5:
        return f"With {count(points, 'reading')} there is nothing left to test the model with."
    if fit.exact:
        return "The parabola goes through every reading: the residuals say nothing."
    p = fit.cubic_pvalue
    if p is None:
        cubic = (
            f"The readings stand at {count(places, 'displacement')}, and through as many points "
            "there is always a parabola: a cubic term cannot be tried."
            if places < 4
            else "The readings stand too near to each other for a cubic term to be tried."
        )
    else:
        verdict = "insignificant" if p > 0.05 else "**significant**"
        cubic = f"A cubic term would be {verdict} ({pvalue(p)})."
    return f"{cubic} {_neighbours(fit.neighbours)}"


def _neighbours(neighbours):
    """How residuals go together in the order of the file, and what follows for the intervals."""
    correlation, low, high, widening = neighbours
    found = (
        f"The correlation of neighbouring residuals is {fixed(correlation, 2)}, "
        f"{'**outside**' if neighbours.suspicious else 'inside'} the range {fixed(low, 2)} to "
        f"{fixed(high, 2)} of 95 in 100 experiments with independent errors."
    )
    if not neighbours.suspicious:
        return found
    found += " The intervals and the F test assume such errors, so they cannot be relied on."
    if correlation < low:
        return (
            f"{found} Signs take turns, as they do where readings of two kinds alternate, on "
            "loading and on unloading say: fit each kind by itself."
        )
    wander = ""
    if widening > 1.05:
        wander = (
            " If the errors wander, so that the correlation fades to this part from each reading "
            f"to the next, the interval of the stiffness must be {number(widening, 2)} times as "
            "wide."
        )
    return (
        f"{found} Residuals of one sign stand together.{wander} If the spring was first loaded and "
        "then unloaded, the difference between the two ways is no chance: fit each by itself. If "
        "the force follows another curve than a parabola, no interval tells by how much."
    )


def experiments_figure(shown, missed):
    """Caption of the boxes of repeated experiments, `missed` of which do not hold the truth."""
    text = (
        f"The joint boxes (p{SPACE}={SPACE}2) of {shown} invented experiments with the same truth "
        f"(cross). {count(missed, 'box misses', 'boxes miss').capitalize()} it (thick, orange)."
    )
    alt = (
        f"{shown} overlapping rectangles in the plane of preload and curvature around a cross; "
        f"{count(missed, 'rectangle does', 'rectangles do')} not contain it."
    )
    return Caption(text, alt)


def both_right(share, experiments, level=0.95):
    """How often two one-at-a-time intervals were both right, beside what one might have guessed.

    Parameters
    ----------
    share : float
        Part of the experiments in which both were.
    experiments : int
        How many there were.
    level : float
        What each interval promises by itself.
    """
    independent = level**2
    counted = f"in {percent(share, 3)} of the {experiments:,} experiments"
    if share < independent + _uncertain(independent, experiments):
        return f"**In about {percent(independent, 4)}:** {counted}."
    if share > level - _uncertain(level, experiments):
        return f"**In about {percent(level)}:** {counted}."
    return f"**Between the two:** {counted}."


def _uncertain(share, experiments):
    """Three standard errors of the count, as a part of the experiments; `share` in truth."""
    return 3 * math.sqrt(share * (1 - share) / experiments)


def coverage(shares, experiments, level=0.95):
    """How often each kind of box held both true coefficients, and which keep the promise.

    Parameters
    ----------
    shares : dict of str to float
        Part of the experiments in which both intervals held the truth, by kind.
    experiments : int
        How many there were.
    """
    doubt = _uncertain(level, experiments)
    promise = f"promise of {percent(level)}"
    rows = [
        {
            "intervals": name.replace(" = ", f"{SPACE}={SPACE}"),
            "both right in": percent(share, 3),
            promise: "kept" if share >= level - doubt else "broken",
        }
        for name, share in shares.items()
    ]
    counted = (
        f"Of {experiments:,} experiments; standard error of the count: {percent(doubt / 3, 1)}."
    )
    return f"{table(rows)}\n\n{counted}"


def summary(fit):
    """What to remember of Part I."""
    linear = "compatible" if fit.linearity().linear else "**not** compatible"
    points = [
        f"The stiffness is {quantity(fit.stiffness, 'N/m')}{_known(fit)}",
        f"A linear spring is {linear} with the data.",
        "This uncertainty travels on: it decides how well "
        "[the critical speeds](../notebooks/06-how-sure.ipynb) are known.",
    ]
    return "\n".join(f"- {point}" for point in points)


def _known(fit):
    """How well the stiffness is known, and whether the residuals let one believe it."""
    if fit.exact:
        return ". The readings lie on a curve, so they do not say how well it is known."
    low, high = fit.stiffness_interval()
    part = f"±{percent((high - low) / 2 / fit.stiffness)}"
    if fit.neighbours.suspicious:
        return f", with an interval of {part}. {caution(fit)}"
    return f", known to about {part}."
