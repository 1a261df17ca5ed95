"""Sentences and captions about absolute stability, for any scheme: Questions 4 and 7."""

import numpy as np

from suspension.report.rows import stability_rows, table
from suspension.report.words import SPACE, Caption, count, join

__all__ = ["diagram_caption", "diagram_link", "dt_list", "stability_table"]

NUMBERS = "no one two three four five six seven eight nine ten eleven twelve".split()


def dt_list(dts, last="and"):
    """Time steps in words.

    >>> dt_list([0.2, 0.1])
    '0.2 and 0.1\\xa0s'
    """
    return join([f"{dt:g}" for dt in dts], last) + SPACE + "s"


def diagram_caption(question, scheme, eigenvalues, dts):
    """Caption of a stability diagram: what the region is, and where the points lie.

    Parameters
    ----------
    question : str
        ``"4(i)"``.
    scheme : Scheme
    eigenvalues : array_like, shape (n,)
        1/s.
    dts : sequence of float
        Time steps, s; the points of the smallest are enlarged.
    """
    places = _places(scheme, eigenvalues, dts)
    n = NUMBERS[len(eigenvalues)]
    region, border = "left half-plane", ""
    if np.isfinite(scheme.max_stable_dt([-1, 1j])):
        region = "region"
        border = r" The border was found by following $R(z) = e^{i\varphi}$ from $z = 0$."
    text = (
        f"**Question {question}.** {scheme.name} is absolutely stable in the shaded {region}. Of "
        rf"the {n} points $\lambda_k\Delta t$ of each step, {places}. The inset enlarges the "
        f"surroundings of $z = 0$, where the {n} points of {min(dts):g}{SPACE}s lie; it is "
        f"stretched horizontally.{border}"
    )
    alt = (
        f"Stability diagram of {scheme.name} with a shaded {region}. Of the {n} points lambda "
        f"times dt of each step, {places}. An inset enlarges those of {min(dts):g}{SPACE}s, next "
        "to the origin."
    )
    return Caption(text, alt)


def _places(scheme, eigenvalues, dts):
    """Where the points of each step lie, steps of a kind together."""
    steps = {}
    for dt in dts:
        steps.setdefault(_place(scheme, eigenvalues, dt), []).append(dt)
    return join(f"{place} at {dt_list(dts)}" for place, dts in steps.items())


def _place(scheme, eigenvalues, dt):
    """How many points lie inside the region, on its border and outside."""
    growth = np.abs(scheme.stability_function(np.asarray(eigenvalues) * dt))
    inside = int((growth < 1 - 1e-12).sum())
    outside = int((growth > 1 + 1e-12).sum())
    places = {"inside": inside, "on its border": len(growth) - inside - outside, "outside": outside}
    filled = {place: n for place, n in places.items() if n}
    if len(filled) == 1:
        return f"all lie {next(iter(filled))}"
    return join(f"{NUMBERS[n]} lie {place}" for place, n in filled.items())


def diagram_link(eigenvalues, dts, page, name):
    """Where the stability diagram is: a page of ``notebooks/`` and a figure's label."""
    points = count(len(eigenvalues) * len(dts), "point")
    if len(eigenvalues) * len(dts) < len(NUMBERS):
        points = f"{NUMBERS[len(eigenvalues) * len(dts)]} points"
    return f"All {points} are in [the stability diagram](../notebooks/{page}.ipynb#{name})."


def stability_table(scheme, eigenvalues, dts):
    """Which steps are absolutely stable: a sentence and a table."""
    stable = [dt for dt in dts if scheme.is_stable(eigenvalues, dt)]
    unstable = [dt for dt in dts if dt not in stable]
    if not unstable:
        sentence = f"For {scheme.name} every one of the steps is absolutely stable:"
    elif not stable:
        sentence = f"For {scheme.name} none of the steps is absolutely stable:"
    else:
        sentence = (
            f"{scheme.name} is absolutely stable at {dt_list(stable)}, "
            f"and unstable at {dt_list(unstable)}:"
        )
    return sentence + "\n\n" + table(stability_rows(scheme, np.asarray(eigenvalues), dts))
