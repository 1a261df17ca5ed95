"""The still picture that stands in the page until its scripts run, or where they do not."""

import io
import re
from urllib.parse import quote

import matplotlib.pyplot as plt
import numpy as np

from suspension.explorer.settings import MOMENTS
from suspension.figures import RobotDrawing, plot_forces, plot_stability
from suspension.forces import WHEEL
from suspension.report.words import quantity

__all__ = ["still"]

PATH = re.compile(r'(?<= d=")[^"]*')  # the points of a line; a digit of a scale is dear
BEYOND_A_HUNDREDTH = re.compile(r"(\.\d\d)\d+")


def still(explorer):
    """The same picture as an HTML image, with a text for those who cannot see it."""
    run = explorer.trajectory()
    # A hundredth of a point is enough, and text that is not base64 is easily compressed.
    picture = PATH.sub(lambda path: BEYOND_A_HUNDREDTH.sub(r"\1", path[0]), _svg(explorer, run))
    source = f"data:image/svg+xml,{quote(picture, safe=' /:;,=()')}"
    text = _describe(explorer.robot, run)
    return f'<img class="suspension-explorer-still" alt="{text}" src="{source}">'


def _svg(explorer, run):
    """The three panels at the moment shown."""
    robot = explorer.robot
    t = explorer.time / MOMENTS * explorer.distance / run.v
    n = min(round(t / run.dt), len(run.T) - 1)
    with plt.style.context("suspension.figures.report"):
        figure, axes = plt.subplot_mosaic(
            [["robot", "robot"], ["forces", "stability"]],
            figsize=(7.2, 4.8),
            height_ratios=[1, 1.6],
            width_ratios=[1.7, 1],
        )
        drawing = RobotDrawing(axes["robot"], robot, explorer.road)
        drawing.ground(run.X[n] - 3 * robot.L1, run.X[n] + 3 * robot.L2)
        drawing.update(run.W[:, n], run.X[n])
        plot_forces(run, axes["forces"])
        plot_stability(run.scheme, robot.eigenvalues, [run.dt], ax=axes["stability"])
        axes["stability"].legend().remove()
        picture = io.StringIO()
        figure.savefig(picture, format="svg", metadata={"Date": None})
        plt.close(figure)
    return picture.getvalue()


def _describe(robot, run):
    """What the picture says, in words."""
    lifts = f"the {WHEEL[run.loss.wheel]} wheel leaves the ground" if run.loss else "no wheel lifts"
    least = run.N.min()
    force = "has no limit"
    if np.isfinite(least):
        force = f"is {quantity(least, 'newtons')}"
    stable = "stable" if run.scheme.is_stable(robot.eigenvalues, run.dt) else "unstable"
    return (
        f"The robot on the road, both normal forces and the stability region of {run.scheme.name}: "
        f"at {run.v:g} metres per second {lifts}, the smallest force {force}, "
        f"and a step of {1000 * run.dt:g} ms is {stable}."
    )
