"""The still picture that stands in the page until its scripts run, or where they do not."""

import io
import re
from html import escape
from urllib.parse import quote

import matplotlib.pyplot as plt
import numpy as np

from suspension.contact import margin, regimes_between
from suspension.critical import zeros
from suspension.explorer.chart import describe_chart, draw_chart
from suspension.figures import RobotDrawing, plot_forces, plot_margin, plot_stability
from suspension.flight import fly
from suspension.forces import WHEEL
from suspension.least_force import minima
from suspension.report.words import join, quantity

__all__ = [
    "RUN_NOTEBOOK",
    "critical",
    "draw",
    "knows_all_speeds",
    "picture",
    "still",
    "still_image",
    "svg",
]

DEFINITIONS = re.compile(r"<defs>.*?</defs>", re.DOTALL)  # the letters' shapes
PATH = re.compile(r'(?<= d=")[^"]*')
NUMBER = re.compile(r"-?\d+\.\d+(?:e[-+]?\d+)?")
SIZE = re.compile(r'viewBox="0 0 ([\d.]+) ([\d.]+)"')
SPEEDS = 90
FAR = 4  # times the usual way
RUN = "A still picture: run the notebook (Run &gt; Run All Cells) to {}."
# What a notebook says below it, and hides if it has no kernel: that there is no widget.
RUN_NOTEBOOK = (
    f'<p class="se-run"><strong>{RUN.format("drive it")}</strong></p>'
    "<style>.jp-OutputArea-child:has(.suspension-explorer-still) + .jp-OutputArea-child > "
    ".jupyter-widgets:not(:has(*)) { display: none; }</style>"
)


def draw(explorer):
    """The panels as SVG, once the explorer knows its critical speeds."""
    if explorer.compact == "chart":
        return svg(draw_chart(explorer))
    if explorer.compact == "race":
        return svg(_race(explorer))
    run = explorer.trajectory()
    return svg(_compact(explorer, run) if explorer.compact else _panels(explorer, run))


def still(explorer, drawn):
    """What was drawn as an HTML image, with a text for those who cannot see it."""
    if explorer.compact == "chart":
        text = describe_chart(explorer)
    elif explorer.compact == "race":
        text = _describe_race(explorer)
    else:
        text = _describe(explorer, explorer.trajectory())
    return still_image(drawn, text)


def still_image(drawn, text):
    """An SVG as an HTML image that stands in a page until its scripts run."""
    source = f"data:image/svg+xml,{quote(drawn, safe=' /:;,=()')}"
    return f'<img class="suspension-explorer-still" alt="{escape(text)}" src="{source}">'


def picture(drawn, to="drive it"):
    """What was drawn, with what to do to drive it written below."""
    width, height = map(float, SIZE.search(drawn).groups())
    words = (
        f'<text x="{width / 2:g}" y="{height + 15:g}" text-anchor="middle" '
        f'font-family="sans-serif" font-size="12" font-weight="bold">{RUN.format(to)}</text>'
    )
    svg = drawn.replace(
        f'viewBox="0 0 {width:g} {height:g}"', f'viewBox="0 0 {width:g} {height + 24:g}"'
    )
    svg = svg.replace(f'height="{height:g}pt"', f'height="{height + 24:g}pt"', 1)
    return svg.replace("</svg>", f"{words}</svg>")


def knows_all_speeds(explorer):
    """Whether the exact least forces are at hand: of one bump, on a way that is not endless."""
    return explorer.family.has_bump and explorer.distance <= FAR * explorer.family.way


def critical(explorer):
    """The speeds on the slider at which the exact margin is zero, for a `GaussianBump`."""
    robot, road = explorer.robot, explorer.road

    def least(x):
        v = np.exp(x)
        return margin(robot, road, v, explorer.distance / v)

    return np.exp(zeros(least, np.log(_speeds(explorer))))


def _speeds(explorer):
    reach = explorer.ranges["v"]
    return np.geomspace(reach.low, reach.high, SPEEDS)


def svg(figure):
    """A figure as SVG; lines are exact to a hundredth of a point, the letters as they are."""
    picture = io.StringIO()
    with plt.style.context("suspension.figures.report"):
        figure.savefig(picture, format="svg", metadata={"Date": None})
    plt.close(figure)
    parts, start = [], 0
    text = picture.getvalue()
    for letters in DEFINITIONS.finditer(text):
        parts += [_shorten(text[start : letters.start()]), letters[0]]
        start = letters.end()
    return "".join([*parts, _shorten(text[start:])])


def _shorten(text):
    """Round the numbers of paths to a hundredth."""
    return PATH.sub(lambda path: NUMBER.sub(lambda x: f"{float(x[0]):.2f}", path[0]), text)


def _panels(explorer, run):
    """The panels at the moment shown."""
    has_speeds = knows_all_speeds(explorer)
    top = ["robot", "speeds"] if has_speeds else ["robot", "robot"]
    with plt.style.context("suspension.figures.report"):
        figure, axes = plt.subplot_mosaic(
            [top, ["forces", "stability"]], figsize=(9, 6), width_ratios=[1.5, 1]
        )
        _draw_robot(explorer, run, axes["robot"])
        if has_speeds:
            _draw_speeds(explorer, axes["speeds"])
        plot_forces(run, axes["forces"])
        plot_stability(run.scheme, explorer.robot.eigenvalues, [run.dt], ax=axes["stability"])
        axes["stability"].legend().remove()
    return figure


def _compact(explorer, run):
    """The robot, and the curve over all speeds if it is known."""
    names = [["robot"], ["speeds"]] if knows_all_speeds(explorer) else [["robot"]]
    with plt.style.context("suspension.figures.report"):
        figure, axes = plt.subplot_mosaic(names, figsize=(7.2, 5))
        _draw_robot(explorer, run, axes["robot"])
        if "speeds" in axes:
            _draw_speeds(explorer, axes["speeds"])
    return figure


def _draw_robot(explorer, run, ax):
    robot = explorer.robot
    t = explorer.time * explorer.distance / run.v
    flight = explorer.flight() if explorer.motion == "flying" else None
    shown = flight or run
    n = np.abs(shown.T - t).argmin()
    X = run.v * shown.T[n]
    drawing = RobotDrawing(ax, robot, explorer.road)
    drawing.ground(X - 3 * robot.L1, X + 3 * robot.L2)
    drawing.update(shown.W[:, n], X, gaps=flight.gaps[:, n] if flight else None)


def _race(explorer):
    """The robots at the speeds asked for, each where a wheel is highest or a force is least."""
    robot, flights = explorer.robot, _flights(explorer)
    with plt.style.context("suspension.figures.report"):
        figure, axes = plt.subplots(len(flights), sharex=True, figsize=(7.2, 1.5 * len(flights)))
        for ax, flight in zip(axes, flights, strict=True):
            n = flight.gaps.max(axis=0).argmax() if flight.events else flight.N.min(axis=0).argmin()
            drawing = RobotDrawing(ax, robot, explorer.road)
            drawing.ground(-1.3 * robot.L1, explorer.distance + 1.3 * robot.L2)
            drawing.update(flight.W[:, n], flight.v * flight.T[n], gaps=flight.gaps[:, n])
            for start, end, pressing in flight.legs:
                for arm in robot.arms[~np.array(pressing)]:
                    ends = flight.v * np.array([start, end]) + arm
                    ax.plot(ends, [-0.006, -0.006], "-", lw=3, color="C3", solid_capstyle="butt")
            ax.set_title(f"{flight.v:g} m/s: {_verdict(flight)}", loc="left", fontsize=10)
            ax.set(xlabel="", ylabel="", yticks=[])
        axes[-1].set_xlabel("x (m)")
    return figure


def _flights(explorer):
    """How the robots of a race drive."""
    return [
        fly(explorer.robot, explorer.road, v=v, tfinal=explorer.distance / v)
        for v in explorer.asked
    ]


def _verdict(flight):
    off = {event.wheel for event in flight.events}
    if not off:
        return "both wheels stay on the ground"
    if len(off) == 2:
        return "both wheels leave the ground"
    return f"the {WHEEL[off.pop()]} wheel leaves the ground"


def _describe_race(explorer):
    """What the race shows, in words."""
    flights = _flights(explorer)
    parts = [f"at {flight.v:g} metres per second {_verdict(flight)}" for flight in flights]
    return f"{len(parts)} robots on one road over one bump, side by side: {'; '.join(parts)}."


def _draw_speeds(explorer, ax):
    robot, road = explorer.robot, explorer.road
    v, way = _speeds(explorer), explorer.distance

    def margin_at(speed):
        return margin(robot, road, speed, way / speed)

    least = np.transpose(
        [[dip.force for dip in minima(robot, road, speed, way / speed)] for speed in v]
    )
    critical = np.asarray(explorer.facts["exact"]["critical"])
    inside = critical[(v[0] < critical) & (critical < v[-1])]
    found = regimes_between(margin_at, [v[0], *inside, v[-1]])
    plot_margin(v, least, found, explorer.asked, ax=ax)
    ax.legend().remove()


def _describe(explorer, run):
    """What the picture says, in words."""
    panels = ["the robot on the road"]
    if knows_all_speeds(explorer):
        panels.append("the least force of each wheel at every speed")
    if not explorer.compact:
        panels += ["both normal forces", f"the stability region of {run.scheme.name}"]
    lifts = f"the {WHEEL[run.loss.wheel]} wheel leaves the ground" if run.loss else "no wheel lifts"
    least = run.N.min()
    force = "has no limit"
    if np.isfinite(least):
        force = f"is {quantity(least, 'newtons')}"
    stable = run.scheme.is_stable(explorer.robot.eigenvalues, run.dt)
    pictures = join(panels)
    return (
        f"{pictures[0].upper()}{pictures[1:]}: "
        f"at {run.v:g} metres per second {lifts}, the smallest force {force}, "
        f"and a step of {1000 * run.dt:g} ms is {'stable' if stable else 'unstable'}."
    )
