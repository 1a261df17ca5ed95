"""A prediction: the reader draws a curve on empty axes, and later lays the answer beside it."""

import ipywidgets
import matplotlib.pyplot as plt
import numpy as np
import traitlets

from suspension import _checks
from suspension.explorer.bundle import PAGE, bundle, style
from suspension.explorer.instrument import Instrument
from suspension.explorer.still import svg
from suspension.figures.similarity import empty_axes

__all__ = ["Prediction"]

COLUMNS = 241
NEAR = np.log10(1.5)  # so close to the exact curve that a line says what happens
BEYOND = 1.0  # decades that are kept of a curve outside the axes


class Prediction(Instrument):
    """Empty logarithmic axes to draw on, by mouse, pen, finger or keys.

    Displayed, it asks for a curve; `answer` gives the widget that lays lines and the exact curve
    beside what was drawn. In JupyterLab and in a built page the same module draws them.

    Parameters
    ----------
    name : str
        One for each prediction of a page.
    x, y : (float, float)
        Ends of the axes, > 0.
    x_name, y_name : str
        What they count; `x_name` ends in its symbol.
    **facts
        What `answer` hands to the page.

    Attributes
    ----------
    strokes : list
        What was drawn: for each stroke a list of [column, decimal logarithm of the height].
    """

    _esm = bundle(PAGE, "predict_widget")
    _css = style("explorer")

    strokes = traitlets.List().tag(sync=True)
    to = "draw on it"

    def __init__(self, name, x, y, x_name, y_name, **facts):
        self.name = name
        x, y = (list(_checks.pair(axis, ends)) for axis, ends in (("x", x), ("y", y)))
        for axis, text in (("x_name", x_name), ("y_name", y_name)):
            if not _checks.instance(axis, text, str).strip():
                raise ValueError(f"{axis} must say what the axis counts, got {text!r}")
        own = {"columns": COLUMNS, "x": x, "y": y, "names": [x_name, y_name]}
        super().__init__(facts=own | {"symbol": x_name.split()[-1]} | facts)

    def answer(self, x, lines, exact, curve="the exact curve"):
        """The widget that lays the answer beside what is drawn here.

        Parameters
        ----------
        x : ndarray, shape (n,)
            In order, > 0.
        lines : dict of str to ndarray, shape (n,)
            By name, powers of x: straight lines on these axes. One that is inf is left out.
        exact : ndarray, shape (n,)
            The curve, > 0; inf where there is no height.
        curve : str
            What it is called, a noun with its article.

        Returns
        -------
        Prediction
        """
        x = _checks.positives("x", x, (None,))
        lines = {name: _on("lines", line, x) for name, line in lines.items()}
        exact = _on("exact", exact, x)
        facts = self.facts
        ends = np.log10(facts["x"])
        places = np.linspace(*ends, COLUMNS)
        low, high = np.log10(facts["y"])

        def heights(values):
            with np.errstate(divide="ignore"):
                logs = np.interp(places, np.log10(x), np.log10(np.minimum(values, 1e300)))
            return np.clip(logs, low - BEYOND, high + BEYOND)

        truth = heights(exact)
        seen = (low <= truth) & (truth <= high)
        told = [
            _line(name, np.log10(x), values, ends, truth, seen)
            for name, values in lines.items()
            if np.isfinite(values).all()  # no damper, no limit that one makes
        ]
        answered = Prediction(
            self.name,
            facts["x"],
            facts["y"],
            *facts["names"],
            answer={"curve": curve, "exact": truth.round(4).tolist(), "lines": told},
        )
        ipywidgets.jslink((self, "strokes"), (answered, "strokes"))
        return answered

    @property
    def kind(self):
        """Its box; one that answers waits in a page until something is drawn."""
        return f"suspension-prediction se-{'answered' if 'answer' in self.facts else 'asked'}"

    @property
    def alt(self):
        """What is seen before anything is drawn."""
        x_name, y_name = self.facts["names"]
        return f"Empty logarithmic axes: {y_name} against {x_name}."

    def _state(self):
        return {"name": self.name, "facts": self.facts}

    def _draw(self):
        """Empty axes as SVG; nothing of an answer, which stands beside a figure."""
        if "answer" in self.facts:
            return ""
        with plt.style.context("suspension.figures.report"):
            figure, ax = plt.subplots(figsize=(7.2, 3.8))
            empty_axes(self.facts["x"], self.facts["y"], self.facts["names"], ax)
        return svg(figure)


def _on(name, values, x):
    """Heights at places x, > 0, of which some may be inf."""
    values = _checks.array(name, values, x.shape, finite=False)
    if not (values > 0).all():
        raise ValueError(f"{name} must be > 0 everywhere, got {values[~(values > 0)][0]}")
    return values


def _line(name, x, values, ends, truth, seen):
    """A line for the page: heights at its ends, slope, and where it lies close to the truth."""
    slope, at_one = np.polyfit(x, np.log10(values), 1)
    heights = at_one + slope * np.linspace(*ends, COLUMNS)
    close = np.flatnonzero(seen & (np.abs(heights - truth) < NEAR))
    stretch = None
    if len(close):
        longest = max(np.split(close, np.flatnonzero(np.diff(close) > 1) + 1), key=len)
        stretch = [int(longest[0]), int(longest[-1])] if len(longest) > 2 else None
    two = (at_one + slope * ends).round(4).tolist()
    return {"name": name, "slope": round(float(slope), 3), "ends": two, "stretch": stretch}
