"""Sentences and captions about absolute stability, for any scheme: Questions 4 and 7."""

import numpy as np

from suspension.report.rows import stability_rows, table
from suspension.report.words import SPACE, Caption, count, join
from suspension.schemes import TOLERANCE

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
    n = NUMBERS[len(eigenvalues)]
    region, border = "left half-plane", ""
    if np.isfinite(scheme.max_stable_dt([-1, 1j])):
        region = "region"
        border = r" The border was found by following $R(z) = e^{i\varphi}$ from $z = 0$."
    told = [
        _places(scheme, eigenvalues, dts, name)
        for name in (r"$\lambda_k\Delta t$", "lambda times dt")
    ]
    text = (
        f"**Question {question}.** {scheme.name} is absolutely stable in the shaded {region}. "
        f"{told[0]} The inset enlarges the "
        f"surroundings of $z = 0$, where the {n} points of {min(dts):g}{SPACE}s lie; it is "
        f"stretched horizontally.{border}"
    )
    alt = (
        f"Stability diagram of {scheme.name} with a shaded {region}. "
        f"{told[1]} An inset enlarges those of "
        f"{min(dts):g}{SPACE}s, next to the origin."
    )
    return Caption(text, alt)


def _places(scheme, eigenvalues, dts, name):
    """A sentence on where the points, of such a name, lie; steps with the same places together."""
    steps = {}
    for dt in dts:
        steps.setdefault(_place(scheme, eigenvalues, dt), []).append(dt)
    n = NUMBERS[len(eigenvalues)]
    words = []
    for place, alike in steps.items():
        points = "" if words else f" points {name}"  # named once
        if len(place) == 1:
            lie = f"all {n}{points} lie {place[0][0]}"
        else:
            (first, m), *rest = place
            lie = f"{NUMBERS[m]} of the {n}{points} lie "
            lie += join([first, *(f"{NUMBERS[m]} {where}" for where, m in rest)])
        words.append(f"at {dt_list(alike)} {lie}")
    return f"A{'; '.join(words)[1:]}."


def _place(scheme, eigenvalues, dt):
    """Where the points of a step lie, and how many there: inside, on the border, outside.

    The border is as wide as where `Scheme.is_stable` leaves room for roundoff.
    """
    growth = np.abs(scheme.stability_function(np.asarray(eigenvalues) * dt))
    inside = int((growth < 1 - TOLERANCE).sum())
    outside = int((growth > 1 + TOLERANCE).sum())
    border = len(growth) - inside - outside
    places = (("inside", inside), ("on its border", border), ("outside", outside))
    return tuple((where, n) for where, n in places if n)


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
