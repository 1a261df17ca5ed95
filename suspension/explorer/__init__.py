"""Live sliders: the robot, its forces, every speed, the stability region; with or without Python.

Python hands over the model, the methods and the road as numbers; the browser does linear algebra
with them and draws. So the built page needs no kernel and holds no physics: any `Robot` and any
road work in it, and what it shows is what `suspension.simulation.simulate` computes.
"""

import base64
import json
from dataclasses import fields

import anywidget
import ipywidgets
import numpy as np
import traitlets
from IPython.display import display

from suspension import _checks
from suspension.explorer.bundle import PAGE, bundle, script, style
from suspension.explorer.chain import Chain
from suspension.explorer.chart import chart_facts, check
from suspension.explorer.controls import CONTROLS, native
from suspension.explorer.family import Family, Range, before_the_bump
from suspension.explorer.game import Game
from suspension.explorer.own import Own
from suspension.explorer.predict import Prediction
from suspension.explorer.settings import (
    CLOSE,
    CURVE,
    DTS,
    EDGE,
    MOTIONS,
    PACES,
    REFERENCE,
    SCHEMES,
    SECONDS,
    VIEWS,
)
from suspension.explorer.sliders import row
from suspension.explorer.still import RUN_NOTEBOOK, critical, draw, knows_all_speeds, picture, still
from suspension.explorer.tables import scheme_facts, shape_of
from suspension.explorer.workshop import Workshop
from suspension.flight import fly
from suspension.problem import SPEEDS
from suspension.road import FlatRoad
from suspension.robot import Robot
from suspension.schemes import RK4, Scheme
from suspension.simulation import simulate

__all__ = [
    "DTS",
    "SCHEMES",
    "Chain",
    "Explorer",
    "ExplorerBox",
    "Game",
    "Own",
    "Prediction",
    "Workshop",
    "explore",
    "page_script",
    "page_style",
    "prediction_script",
]

NUMBERS = tuple(control.trait for control in CONTROLS)
# What an explorer shows and has sliders for: a whole one, a compact one, the chart, the race.
PANELS = {
    False: ("robot", "speeds", "forces", "stability"),
    True: ("robot", "speeds"),
    "chart": ("chart",),
    "race": ("race",),
}
SLIDERS = {False: NUMBERS, True: ("v",), "chart": ("c", "height"), "race": ()}
TRAITS = (*NUMBERS, "scheme_index", "time", "motion", "view", "pace", "mapped", "pin")
WIDTHS = 4.0  # of a bump to either side of its middle: further away there is nothing of it
CELLS = (512, 8192)  # steps of the curve over all speeds, at least and at most
START = SPEEDS[1]  # m/s, for a robot and a road like the problem's


class Explorer(anywidget.AnyWidget):
    """The linked pictures at the current settings.

    Attributes
    ----------
    v, dt : float
        Speed, m/s, and time step, s.
    k, c : float
        Stiffness, N/m, and damping coefficient, N s/m, of the rear wheel; those of the front wheel
        keep their ratio to it.
    height, sigma : float
        The bump's height and width, m; of a road that is no `GaussianBump` they say nothing.
    scheme_index : int
        Place in `schemes`.
    time : float
        The moment shown, a fraction of the run.
    motion : {"linear", "flying"}
        What is drawn in front: the model of the problem, or wheels that leave the ground.
    view : str
        The panel drawn largest.
    pace : {"fit", "same"}
        Whether each crossing is played in the same time, or all are slowed alike.
    mapped : bool
        Whether the map over speed and stiffness stands in place of the curve over all speeds.
    pin : dict
        The settings of a run to compare with, by the names above; empty if there is none.
    """

    _esm = bundle(PAGE, "widget")
    _css = style("explorer")

    v = traitlets.Float(1.0).tag(sync=True)
    dt = traitlets.Float(0.001).tag(sync=True)
    k = traitlets.Float(1.0).tag(sync=True)
    c = traitlets.Float(1.0).tag(sync=True)
    height = traitlets.Float(1.0).tag(sync=True)
    sigma = traitlets.Float(1.0).tag(sync=True)
    scheme_index = traitlets.Int(0).tag(sync=True)
    time = traitlets.Float(0.0).tag(sync=True)
    motion = traitlets.Unicode("linear").tag(sync=True)
    view = traitlets.Enum(VIEWS, "forces").tag(sync=True)
    pace = traitlets.Enum(PACES, "fit").tag(sync=True)
    mapped = traitlets.Bool(False).tag(sync=True)
    pin = traitlets.Dict().tag(sync=True)
    controls = traitlets.Unicode().tag(sync=True)
    facts = traitlets.Dict().tag(sync=True)
    tables = traitlets.Dict().tag(sync=True)

    def __init__(
        self,
        family,
        schemes,
        distance,
        speeds,
        *,
        asked=(),
        spring_end=None,
        compact=False,
        wide=False,
        presets=(),
        **settings,
    ):
        self.family, self.schemes, self.distance = family, tuple(schemes), distance
        self.asked, self.compact, self.wide = tuple(asked), compact, wide
        self.sliders = SLIDERS[compact]
        self.ranges = {"v": Range(*speeds, True)} | family.ranges
        robot = family.robot
        load = robot.m * (robot.g or 1) / 2
        # A run may end one step past `distance`, and the front wheel is further ahead.
        start, stop = -robot.L1, distance + speeds[1] * DTS[-1] + robot.L2
        frame, table = shape_of(family.road, start, stop)
        fewest, most = CELLS
        super().__init__(
            facts={
                "distance": distance,
                "wheels": robot.arms.tolist(),
                "model": family.model(),
                "road": frame,
                # The size of the road's smallest feature, in units of its width.
                "feature": 1.0 if family.has_bump else family.feature,
                "cells": int(min(max(8 * distance / family.feature, fewest), most)),
                "longestStep": family.longest_step,
                "ranges": {
                    name: [reach.low, reach.high, reach.logarithmic]
                    for name, reach in self.ranges.items()
                },
                "own": family.own,
                "hasBump": family.has_bump,
                "widths": WIDTHS,
                "dts": DTS,
                "asked": self.asked,
                "springEnd": spring_end,
                "schemes": [scheme_facts(scheme) for scheme in self.schemes],
                "reference": scheme_facts(REFERENCE),
                "curveScheme": scheme_facts(CURVE),
                "panels": PANELS[compact],
                "sliders": list(self.sliders),
                "compact": bool(compact),
                "chart": chart_facts(family, speeds, distance) if compact == "chart" else None,
                "lanes": self.asked if compact == "race" else None,
                "close": CLOSE * load,
                "edge": EDGE * load,
                "pace": float(f"{SECONDS * family.scale * START / distance:.1g}"),
                "wide": wide,
                "presets": presets,
                "python": _python(family, self.schemes, distance),
            },
            tables={"road": table.astype("<f8").tobytes()},
            **settings,
        )
        self.controls = native(self)

    @traitlets.validate(*NUMBERS)
    def _check_number(self, proposal):
        """Refuse what its slider does not offer, and above all what is no number."""
        name = proposal["trait"].name
        return _in_range(name, proposal["value"], self.ranges)

    @traitlets.validate("pin")
    def _check_pin(self, proposal):
        """Refuse what is no run, and fill what is missing with the robot's and the road's own."""
        pin = proposal["value"]
        if not pin:
            return {}
        usual = {name: getattr(self, name) for name in (*NUMBERS, "scheme_index", "motion")}
        for name in pin:
            _checks.one_of("pin", name, usual)
        pin = usual | pin
        checked = {
            name: _in_range(name, pin[name], self.ranges, f"{name} of pin") for name in NUMBERS
        }
        index = _checks.one_of("scheme_index of pin", pin["scheme_index"], range(len(self.schemes)))
        motion = _checks.one_of("motion of pin", pin["motion"], MOTIONS)
        return checked | {"scheme_index": index, "motion": motion}

    @traitlets.validate("time")
    def _check_time(self, proposal):
        return _fraction("time", proposal["value"])

    @traitlets.validate("scheme_index")
    def _check_scheme(self, proposal):
        return _checks.one_of("scheme_index", proposal["value"], range(len(self.schemes)))

    def know_critical_speeds(self):
        """Hand the page the exact critical speeds at the current settings, for a `GaussianBump`.

        It computes them at any settings to five digits; these are the ones that a text beside it
        names, and they take a moment, so they wait until the explorer is shown.
        """
        if self.compact != "race" and (knows_all_speeds(self) or self.compact == "chart"):
            at = {name: getattr(self, name) for name in ("k", "c", "height", "sigma")}
            if self.facts.get("exact", {}).get("at") != at:
                exact = {"at": at, "critical": critical(self).tolist()}
                self.facts = self.facts | {"exact": exact}

    @property
    def robot(self):
        """The robot with the current springs and dampers."""
        return self.family.robot_at(self.k, self.c)

    @property
    def road(self):
        """The road with the current bump."""
        return self.family.road_at(self.height, self.sigma)

    @property
    def scheme(self):
        """The current scheme."""
        return self.schemes[self.scheme_index]

    def trajectory(self):
        """The run at the current settings, as Python computes it.

        Returns
        -------
        suspension.simulation.Trajectory
        """
        return simulate(
            self.robot,
            self.road,
            v=self.v,
            dt=self.dt,
            tfinal=self.distance / self.v,
            scheme=self.scheme,
        )

    def flight(self):
        """The same drive with wheels that leave the ground.

        Returns
        -------
        suspension.flight.Flight
        """
        return fly(self.robot, self.road, v=self.v, tfinal=self.distance / self.v)


class ExplorerBox(ipywidgets.VBox):
    """A frame around an `Explorer` and the sliders of ipywidgets for speed and step above it.

    ``box.explorer`` is the former, ``box.sliders`` are the latter, by name: "v" and "dt".

    It is displayed twice: as a still picture, which is also the explorer of a built page and what
    a notebook shows before anything runs, and as the widget, which hides the still picture as
    long as it lives.
    """

    def __init__(self, explorer):
        self.explorer = explorer
        above, self.sliders = row(explorer)
        super().__init__([above, explorer])
        self.add_class("suspension-explorer-frame")

    def _repr_mimebundle_(self, **kwargs):
        return super()._repr_mimebundle_(**kwargs) | {"text/html": self.html()}

    def _ipython_display_(self):
        self._display({})

    def _display(self, metadata):
        drawn = self._draw()
        html = self._html(drawn, " hidden", RUN_NOTEBOOK)  # a page takes both out
        page = {"text/html": html, "image/svg+xml": picture(drawn)}
        display(page, raw=True, metadata=metadata)
        # Nothing as HTML: a page, or a notebook that is not trusted, has the first display.
        widget = super()._repr_mimebundle_() | {"text/html": ""}
        display(widget, raw=True)

    def show(self, name):
        """Display the explorer under a name; ``{explorer} name`` shows it on another page."""
        self._display({"scrapbook": {"name": name, "mime_prefix": ""}})

    def html(self):
        """The explorer as HTML; `page_script` brings it to life."""
        return self._html(self._draw())

    def _draw(self):
        self.explorer.know_critical_speeds()
        return draw(self.explorer)

    def _html(self, drawn, hidden="", below=""):
        explorer = self.explorer
        state = {name: getattr(explorer, name) for name in (*TRAITS, "facts")}
        state["tables"] = {
            name: base64.b64encode(table).decode() for name, table in explorer.tables.items()
        }
        text = json.dumps(state, separators=(",", ":")).replace("<", "\\u003c")
        kind = " se-compact" if explorer.compact else " se-wide" if explorer.wide else ""
        kind += f" se-{explorer.compact}-only" if explorer.compact in ("chart", "race") else ""
        return (
            f'<div class="suspension-explorer-box se-page{kind}"><div class="se-layout">'
            f'<div class="se-controls"{hidden}>{explorer.controls}</div>'
            f'<div class="se-place">{still(explorer, drawn)}{below}</div></div>'
            f'<script type="application/json" class="se-state">{text}</script></div>'
        )


def page_script():
    """The script, a classic one, that brings every explorer of a page to life."""
    return script("page")


def prediction_script():
    """The script, a classic one, that brings every prediction of a page to life."""
    return script("predict_page")


def page_style():
    """The style sheet of a page with explorers or predictions."""
    return Explorer._css


def explore(
    robot,
    road,
    *,
    v=None,
    dt=0.001,
    k=None,
    c=None,
    height=None,
    sigma=None,
    scheme=RK4,
    time=None,
    motion="linear",
    view="forces",
    distance=None,
    speeds=None,
    asked=(),
    spring_end=None,
    schemes=SCHEMES,
    presets=(),
    compact=False,
    wide=False,
):
    """Sliders for speed, step, spring, damper, bump and scheme, and pictures that follow them.

    Where the sliders begin and end follows from the robot and the road.

    Parameters
    ----------
    robot : Robot
        Its own springs and dampers are marked; others keep the ratios k2 / k1 and c2 / c1.
    road : callable
        ``road(x) -> (H, dHdx)``; the bump of a `GaussianBump` can be changed.
    v : float, optional
        Speed to start with, m/s; 1.2 for a robot and a road like the problem's.
    dt : float
        Time step to start with, s, 0.25 to 200 ms.
    k, c : float, optional
        Rear stiffness, N/m, and damping, N s/m, to start with; the robot's own if None.
    height, sigma : float, optional
        Height and width of the bump to start with, m; its own if None.
    scheme : Scheme
        What to start with: any scheme, or the name of one of `schemes`.
    time : float, optional
        The moment to show first, a fraction of the run; if None, the one before the front wheel
        meets the bump, and of a race the start.
    motion : {"linear", "flying"}
        What is drawn in front: the linear model, or wheels that leave the ground.
    view : {"forces", "stability", "robot", "speeds"}
        The panel drawn largest.
    distance : float, optional
        How far the robot drives, m; far enough for both wheels to pass the bump, and to come to
        rest: 1.25 for the problem's robot and bump.
    speeds : (float, float), optional
        Where the slider of the speed begins and ends, m/s; from a tenth to 25 times what the
        problem's robot takes for slow or fast, if None.
    asked : sequence of float
        Speeds to mark in the pictures and to have buttons, m/s.
    spring_end : float, optional
        The largest compression at which the springs were measured, m; what goes further is said.
        If None, nothing is known of it, and nothing said.
    schemes : sequence of Scheme
        What can be chosen; `scheme` is added if it is not among them.
    presets : sequence of (label, settings)
        More buttons that set the picture: settings is a dict of v, dt, k, c, height, sigma, scheme,
        time and motion, or of some of them; the others are those to start with.
    compact : bool, "chart" or "race"
        Only the robot, the curve over all speeds, and the slider for the speed; or only the chart
        of the highest bumps, and the sliders for damping and height; or robots at the speeds asked
        for, side by side on one road and by one clock. The first and the last play once by
        themselves when they are seen, unless a reader wants little motion.
    wide : bool
        In a built page, use the window's whole width.

    Returns
    -------
    ExplorerBox
        ``box.explorer.trajectory()`` is the run at the sliders' current settings.

    Raises
    ------
    TypeError
        If `robot` is not a Robot, `road` cannot be called, or a scheme is not a Scheme.
    ValueError
        If an argument is not in its range.
    """
    _checks.instance("robot", robot, Robot)
    _checks.function("road", road, "road(x) -> (H, dHdx)")
    family = Family(robot, road)
    if _checks.one_of("compact", compact, tuple(PANELS)) == "chart":
        check(family)
    schemes = [
        _checks.instance("schemes", known, Scheme)
        for known in _sequence("schemes", schemes, "schemes")
    ]
    if isinstance(scheme, Scheme) and scheme not in schemes:
        schemes.append(scheme)
    names = [known.name for known in schemes]
    chosen = getattr(scheme, "name", scheme)
    distance = family.way if distance is None else _checks.positive("distance", distance)
    if spring_end is not None:
        spring_end = _checks.positive("spring_end", spring_end)
    asked = _speeds("asked", asked)
    if compact == "race" and len(asked) < 2:
        raise ValueError(f"asked must be two speeds or more for a race, got {asked!r}")
    low, high = family.speeds if speeds is None else _checks.pair("speeds", speeds)
    if speeds is None:  # what is asked for by name can be reached
        low, high = min([low, *asked]), max([high, *asked])
    ranges = {"v": Range(low, high, True)} | family.ranges
    v = min(max(float(f"{START * family.scale:.3g}"), low), high) if v is None else v
    settings = {"v": v, "dt": dt, "k": k, "c": c, "height": height, "sigma": sigma}
    for name, value in settings.items():
        own = family.own.get(name, value)  # a speed and a step there must be
        settings[name] = _in_range(name, own if value is None else value, ranges)
    for speed in asked:
        _in_range("v", speed, ranges, "asked")
    if not family.has_bump and not (height is None and sigma is None):
        raise ValueError("height and sigma must be left out, for the road is no GaussianBump")
    if time is not None:
        time = _fraction("time", time)
    explorer = Explorer(
        family,
        schemes,
        distance,
        (low, high),
        asked=asked,
        spring_end=spring_end,
        scheme_index=names.index(_checks.one_of("scheme", chosen, names)),
        motion=_checks.one_of("motion", motion, MOTIONS),
        view=_checks.one_of("view", view, VIEWS),
        presets=[
            _preset(preset, names, ranges) for preset in _sequence("presets", presets, "pairs")
        ],
        compact=compact,
        wide=bool(wide),
        **settings,
    )
    if time is None:
        time = 0 if compact == "race" else min(before_the_bump(family, distance) / distance, 1)
    explorer.time = float(time)
    return ExplorerBox(explorer)


def _speeds(name, values):
    """Speeds as floats; each must be positive."""
    return tuple(float(_checks.positive(name, v)) for v in _sequence(name, values, "speeds in m/s"))


def _sequence(name, values, what):
    """What can be gone through, and is no text."""
    if isinstance(values, str) or not np.iterable(values):
        raise ValueError(f"{name} must be a sequence of {what}, got {values!r}")
    return values


def _preset(preset, names, ranges):
    """A button's label and its settings, as the page reads them."""
    try:
        label, settings = preset
        settings, checked = dict(settings), {}
    except (TypeError, ValueError):
        raise ValueError(f"presets must be pairs of a label and a dict, got {preset!r}") from None
    for name, value in settings.items():
        if name == "scheme":
            value = _checks.one_of("scheme of presets", getattr(value, "name", value), names)
        elif name == "motion":
            value = _checks.one_of("motion of presets", value, MOTIONS)
        elif name == "time":
            value = _fraction("time of presets", value)
        elif name in ranges:
            value = _in_range(name, value, ranges, f"{name} of presets")
        else:
            raise ValueError(f"presets must not set {name!r}")
        checked[name] = value
    return [str(label), checked]


def _fraction(name, value):
    return _checks.number(name, value, "a fraction from 0 to 1", lambda time: 0 <= time <= 1)


def _in_range(name, value, ranges, called=None):
    """A setting as a float, checked against what its slider offers."""
    reach = ranges[name]
    allowed = f"{reach.low:g} to {reach.high:g}"
    return _checks.number(called or name, value, allowed, lambda number: number in reach)


def _python(family, schemes, distance):
    """What the page needs to write its settings as lines of Python: text with gaps to fill.

    Each gap has its slider and the factor on it; only `suspension`'s front door is used.
    """
    gaps = {name: [on, ratio] for name, (on, ratio) in family.ratios.items()}
    others = ", ".join(
        f"{field.name}={getattr(family.robot, field.name)!r}"
        for field in fields(Robot)
        if field.init and field.name not in gaps
    )
    lines = ["import suspension", ""]
    lines += [
        "robot = suspension.Robot(",
        "    k1={k1}, k2={k2},",
        f"    c1={{c1}}, c2={{c2}}, {others},",
        ")",
    ]
    if family.has_bump:
        gaps |= {"height": ["height", 1.0], "sigma": ["sigma", 1.0]}
        road = "suspension.GaussianBump(height={height}, sigma={sigma}, "
        lines.append(f"road = {road}centre={family.road.centre!r})")
    elif isinstance(family.road, FlatRoad):
        lines.append("road = suspension.FlatRoad()")
    else:
        lines.append("# road: the function of x that this page defines")
    lines += [
        "run = suspension.simulate(",
        f"    robot, road, v={{v}}, dt={{dt}}, tfinal={distance!r} / {{v}},",
        "    scheme={scheme},",
        ")",
    ]
    flight = "# exactly; the page's own flight is by the scheme and the step above\n"
    flight += f"flight = suspension.fly(robot, road, v={{v}}, tfinal={distance!r} / {{v}})"
    return {
        "text": "\n".join(lines),
        "flight": flight,
        "gaps": gaps,
        "schemes": [_constructor(scheme) for scheme in schemes],
    }


def _constructor(scheme):
    """A scheme as Python writes it."""
    constant = scheme.name.upper().replace("-", "_").replace(" ", "_")
    if scheme in SCHEMES:
        return f"suspension.{constant}"
    return (
        f"suspension.Scheme({scheme.name!r}, {scheme.order}, a={scheme.a.tolist()}, "
        f"b={scheme.b.tolist()}, c={scheme.c.tolist()})"
    )
