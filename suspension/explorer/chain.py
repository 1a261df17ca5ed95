"""From a reading to a verdict: readings one drags, and at once all that the book makes of them.

The page fits the readings by least squares. What it cannot compute comes from Python: the
quantiles for every number of readings, the critical speeds over the stiffness as a table whose
error was measured, and the stiffnesses at which the verdict of an asked speed flips.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import traitlets
from scipy import stats

from suspension import _checks, springs
from suspension._readings import COLUMNS
from suspension.branches import branches
from suspension.contact import critical_stiffness, margin, regimes_between
from suspension.explorer.bundle import PAGE, bundle, style
from suspension.explorer.instrument import LABORATORY, Instrument
from suspension.explorer.still import svg
from suspension.figures.regression import plot_confidence_region, plot_fit
from suspension.figures.speeds import plot_branches
from suspension.least_force import distance_over
from suspension.problem import DELTA_MAX
from suspension.report.words import quantity
from suspension.uncertainty import EXACT, TAIL, WIDEST

__all__ = ["Chain"]

LEVEL = 0.95
MORE = 12  # so many readings can be added
REACH = 3.0  # the table of critical speeds goes from k / REACH to k REACH
GOAL = 5e-5  # relative error that the table is refined for
ROUNDS = 14  # of refining: each halves what is not good enough
PARTS = (0.25, 0.75)  # of the way between two nodes, where the error is measured


class Chain(Instrument):
    """The readings of a spring, to be moved by mouse, finger or keys, and what follows from them.

    In JupyterLab and in a built page the same module draws fit, joint intervals, ellipse,
    stiffness, critical speeds and verdicts.

    Parameters
    ----------
    data : DataFrame
        As `suspension.springs.fit_spring` takes it.
    robot : Robot
        Its stiffnesses are replaced.
    bump : GaussianBump
    asked : sequence of float
        Speeds whose verdicts are told, m/s.
    vmin, vmax : float
        Range of the critical speeds, m/s.
    delta_max : float
        Largest displacement, m.
    distance : float, optional
        How far each run goes, m, as in `suspension.critical_speeds`.

    Attributes
    ----------
    readings : list of [float, float]
        The readings as they stand: displacement over the largest, force in N.

    Raises
    ------
    ValueError
        If the readings leave no degree of freedom, their slope at zero is not positive, or an
        argument is out of its range.
    """

    _esm = bundle(PAGE, "chain_widget")
    _css = style("explorer", "chain")

    readings = traitlets.List().tag(sync=True)
    kind = f"{LABORATORY} se-chain"
    to = "drag its readings"

    def __init__(
        self,
        data,
        robot,
        bump,
        *,
        asked,
        vmin=0.1,
        vmax=30.0,
        delta_max=DELTA_MAX,
        distance=None,
    ):
        fit = springs.fit_spring(data, delta_max)
        if fit.free < 1 or not fit.stiffness > 0:
            raise ValueError(
                f"data must have four readings or more and a slope at zero > 0, got {fit}"
            )
        asked = _checks.positives("asked", asked, (None,)).tolist()
        distance = distance_over(robot, bump, distance)
        self.fit, self._data = fit, data
        ends = fit.stiffness / REACH, fit.stiffness * REACH
        self.branches = branches(
            robot, bump, vmin, vmax, *ends, check=fit.stiffness, distance=distance
        )
        tables, error = _tables(self.branches)
        start = sorted(np.column_stack([fit.x, fit.F]).tolist())
        facts = {
            "start": start,
            "delta_max": delta_max,
            "synthetic": springs.is_synthetic(data),
            "level": LEVEL,
            "quantiles": _quantiles(len(start) + MORE - 3),
            "roundoff": [springs.EXACT, EXACT],
            "widest": WIDEST,
            "k": list(ends),
            "v": [vmin, vmax],
            "error": error,
            "branches": tables,
            "asked": [_verdicts(robot, bump, v, ends, distance) for v in asked],
        }
        super().__init__(facts=facts, readings=start)

    @traitlets.validate("readings")
    def _validate(self, proposal):
        return _checks.array("readings", proposal["value"], (None, 2)).tolist()

    @property
    def data(self):
        """The readings as they stand, for `suspension.springs.fit_spring`: a DataFrame."""
        return type(self._data)(self.readings, columns=list(COLUMNS))

    @property
    def alt(self):
        """What the still picture shows."""
        k = quantity(self.fit.stiffness, "N/m")
        return (
            f"Three pictures. The {len(self.fit.x)} readings with their parabola, whose slope at "
            f"zero is a stiffness of {k}; the confidence ellipse of its two other coefficients; "
            "the critical speeds over the stiffness, with the asked speeds."
        )

    def _state(self):
        return {"facts": self.facts, "readings": self.facts["start"]}

    def _draw(self):
        """The three pictures of the data as they were read, as SVG."""
        fit = self.fit
        band = None if fit.exact else fit.stiffness_interval(LEVEL)
        with plt.style.context("suspension.figures.report"):
            figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.2))
            plot_fit(fit, self._data, LEVEL, axes[0])
            plot_confidence_region(fit, level=LEVEL, ax=axes[1])
            axes[1].get_legend().remove()
            speeds = [a["v"] for a in self.facts["asked"]]
            plot_branches(self.branches, fit.stiffness, band, speeds, axes[2])
        return svg(figure)


def _quantiles(most):
    """What each number of degrees of freedom, from 1 on, needs of t and F, as lists."""
    free = np.arange(1, most + 1)
    return {
        "t": stats.t.ppf((1 + LEVEL) / 2, free).tolist(),
        "tail": stats.t.ppf(1 - TAIL, free).tolist(),
        "joint": np.sqrt(3 * stats.f.ppf(LEVEL, 3, free)).tolist(),
        "region": (2 * stats.f.ppf(LEVEL, 2, free)).tolist(),
    }


def _verdicts(robot, bump, v, ends, distance):
    """At one speed: the stiffnesses between which contact is kept and lost."""

    def margin_at(k):
        return margin(replace(robot, k1=k, k2=k), bump, v, distance=distance)

    nominal = replace(robot, k1=ends[0], k2=ends[0])
    flips = critical_stiffness(nominal, bump, v, *ends, distance=distance)
    found = regimes_between(margin_at, [ends[0], *flips, ends[1]], unit="N/m")
    return {"v": v, "flips": found.critical.tolist(), "lost": found.lost.tolist()}


# --- the critical speeds as a table -------------------------------------------------------------


def along(y, low, high):
    """Where ln k = y lies between the ends of a branch, 0 to 1: smooth where the branch turns.

    Near the end of a pair the speed changes like the root of the distance to it; this has the
    same root.
    """
    return np.arccos(np.clip(1 - 2 * (y - low) / (high - low), -1, 1)) / np.pi


def interpolate(u, x, at):
    """The cubic through the four nodes around each place (two to its left, two to its right)."""
    count = min(4, len(u))
    first = np.clip(np.searchsorted(u, at, side="right") - 2, 0, len(u) - count)
    nodes = first + np.arange(count)[:, None]
    total = np.zeros(np.shape(at))
    for i in range(count):
        weight = np.ones_like(total)
        for j in range(count):
            if j != i:
                weight *= (at - u[nodes[j]]) / (u[nodes[i]] - u[nodes[j]])
        total += weight * x[nodes[i]]
    return total


def _tables(found):
    """The branches as tables, and the largest relative error that was met between their nodes."""
    tables, errors = [], [0.0]
    for branch in found:
        if branch.points[-1].imag - branch.points[0].imag < 1e-9:
            continue
        y, x, error = _refine(branch)
        errors.append(error)
        tables.append(
            {
                "k": np.round(y, 9).tolist(),
                "v": np.round(x, 9).tolist(),
                "born": branch.first and branch.first.why,
                "dies": branch.last and branch.last.why,
            }
        )
    return tables, float(max(errors))


def _refine(branch):
    """Nodes ``ln k`` and ``ln v`` of a branch, and the largest error that was met between them.

    The nodes are the points at which the branch was followed. Where the cubic leaves the straight
    line, as it does at a kink, the speed itself is asked for at two places between two nodes; if
    the cubic is far off, a node comes between.
    """
    apart = np.append(np.diff(branch.points.imag) > 1e-9, True)
    y, x = branch.points.imag[apart], branch.points.real[apart]
    low, high = y[0], y[-1]

    def place(at):
        return low + (high - low) * (1 - np.cos(np.pi * at)) / 2

    def exact(at):
        return np.log(branch.speed(np.exp(np.clip(place(at), low, high))))

    asked = {}
    for _ in range(ROUNDS):
        u = along(y, low, high)
        far, worst = set(), GOAL / 2
        for part in PARTS:
            at = u[:-1] + part * np.diff(u)
            told = interpolate(u, x, at)
            bent = np.abs(told - x[:-1] - part * np.diff(x)) > GOAL / 2
            for i in np.flatnonzero(bent):
                if at[i] not in asked:
                    asked[at[i]] = exact(at[i])
                off = abs(asked[at[i]] - told[i])
                worst = max(worst, off)
                if off > GOAL:
                    far.add((u[i] + u[i + 1]) / 2)
        if not far:
            break
        added = sorted(far)
        order = np.argsort([*u, *added])
        y = np.append(y, [place(at) for at in added])[order]
        x = np.append(x, [exact(at) for at in added])[order]
    return y, x, worst
