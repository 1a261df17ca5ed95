"""The robot drawn in true proportions, still or moving (the problem's ``animate_robot``)."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation

from suspension import _checks
from suspension.course import Hgauss, the_robot
from suspension.figures.style import COLOURS
from suspension.forces import WHEEL
from suspension.road import profile
from suspension.robot import Robot

__all__ = ["RobotDrawing", "animate_robot", "film", "plot_contact_states"]


class RobotDrawing:
    """A body on two springs over a road, in an axes; `update` moves it.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    robot : Robot
        Gives the distances L1 and L2 to the wheels.
    road : callable
        ``road(x) -> (H, dHdx)``.

    Attributes
    ----------
    body : float
        How far above the unstretched springs' ends the body is drawn, m, in proportion to the
        wheelbase; the model needs no such height.
    """

    def __init__(self, ax, robot, road):
        self.ax, self.robot, self.road = ax, robot, road
        self.body = 0.28 * (robot.L1 + robot.L2)
        (self.line,) = ax.plot([], [], "-", color="0.2", lw=4, solid_capstyle="round")
        (self.centre,) = ax.plot([], [], "o", color="white", mec="0.2", ms=5, zorder=3)
        self.springs = [ax.plot([], [], "-", color=c, lw=1.2)[0] for c in COLOURS]
        self.wheels = [ax.plot([], [], "o", color=c, ms=8, mec="white")[0] for c in COLOURS]

    def update(self, w, X, gaps=None):
        """Draw state `w`, shape (4,), with the centre of mass at `X` in m.

        A wheel stands on the ground where ``Y_i <= h_i`` and otherwise hangs from its unstretched
        spring. `gaps`, shape (2,), in m, says instead how far each wheel is above the ground.
        """
        x = X + np.array([-self.robot.L1, self.robot.L2])
        y = w[0] + w[2] * (x - X)
        h = profile(self.road, x)[0]
        foot = np.maximum(y, h) if gaps is None else h + gaps
        top = y + self.body
        self.line.set_data(x, top)
        self.centre.set_data([X], [w[0] + self.body])
        for i, (spring, wheel) in enumerate(zip(self.springs, self.wheels)):
            wheel.set_data([x[i]], [foot[i]])
            spring.set_data(_zigzag(x[i], foot[i], top[i], 0.12 * self.body))
        return [self.line, self.centre, *self.springs, *self.wheels]

    def ground(self, left, right):
        """Draw the road from `left` to `right`, m, and fit the view to it in true proportions."""
        x = np.linspace(left, right, 501)
        H = profile(self.road, x)[0]
        self.ax.fill_between(x, H, H.min() - self.body / 2, color="0.88", lw=0)
        self.ax.plot(x, H, color="0.45", lw=1)
        self.ax.set(xlim=(left, right), ylim=(H.min() - self.body / 2, H.max() + 2.2 * self.body))
        self.ax.set(aspect="equal", xlabel="x (m)", ylabel="y (m)")
        self.ax.grid(False)


def _zigzag(x, bottom, top, width, coils=5):
    t = np.linspace(0, 1, 2 * coils + 3)
    side = np.zeros_like(t)
    side[2:-2] = width * np.where(np.arange(len(t) - 4) % 2, 1, -1)
    return x + side, bottom + t * (top - bottom)


def animate_robot(W, T, v, steps_per_frame=1, *, robot=None, road=None):
    """Animate a computed run.

    Parameters
    ----------
    W : array_like, shape (4, J+1)
        States.
    T : array_like, shape (J+1,)
        Times, s.
    v : float
        Speed, m/s.
    steps_per_frame : int
        How many integration steps one frame advances, >= 1.
    robot : Robot, optional
        The problem's robot with the fitted springs if not given.
    road : callable, optional
        The problem's bump if not given.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Keep a reference to it; ``.save("run.gif", writer="pillow")`` writes a file.

    Raises
    ------
    ValueError
        If the shapes do not fit, or `steps_per_frame` is not a whole number >= 1.
    """
    T = _checks.array("T", T, (None,))
    W = _checks.array("W", W, (4, len(T)))
    X = _checks.number("v", v) * T
    stride = _checks.whole("steps_per_frame", steps_per_frame, 1)
    robot = the_robot() if robot is None else _checks.instance("robot", robot, Robot)
    figure, ax = plt.subplots(figsize=(7.2, 2.2), layout="constrained")
    drawing = RobotDrawing(ax, robot, Hgauss if road is None else road)
    drawing.ground(min(X.min(), 0) - 2 * robot.L1, max(X.max(), 0.5) + 2 * robot.L2)
    clock = ax.text(0.01, 0.93, "", transform=ax.transAxes, va="top")

    def draw(j):
        clock.set_text(f"t = {T[j]:.3f} s,  v = {v:g} m/s")
        return [*drawing.update(W[:, j], X[j]), clock]

    frames = range(0, len(T), stride)
    interval = max(1000 * stride * np.diff(T).mean(), 20) if len(T) > 1 else 20  # ms
    return FuncAnimation(figure, draw, frames=frames, interval=interval, blit=True)


def film(history, robot, road, times):
    """A strip of frames, one below the other, of a Trajectory or a Flight at the given times, s."""
    figure, axes = plt.subplots(len(times), sharex=True, figsize=(7.2, 1.35 * len(times)))
    gaps = getattr(history, "gaps", None)
    X = history.v * np.asarray(times)
    for ax, t, x in zip(np.atleast_1d(axes), times, X, strict=True):
        j = np.abs(history.T - t).argmin()
        drawing = RobotDrawing(ax, robot, road)
        drawing.ground(X.min() - 2 * robot.L1, X.max() + 2 * robot.L2)
        drawing.update(history.W[:, j], x, None if gaps is None else gaps[:, j])
        ax.text(0.01, 0.93, f"t = {t:.3f} s", transform=ax.transAxes, va="top")
        ax.label_outer()
    return figure


STATES = {  # centre of each box, and what holds in it
    "both press": ((0.5, 0.87), "$N_1 = f_1,\\quad N_2 = f_2$"),
    "rear wheel in the air": ((0.23, 0.5), "$N_1 = 0,\\quad N_2 = f_2$"),
    "front wheel in the air": ((0.77, 0.5), "$N_1 = f_1,\\quad N_2 = 0$"),
    "both in the air": ((0.5, 0.13), "$N_1 = 0,\\quad N_2 = 0$"),
}
SWITCHES = (  # of a wheel, with the state in which it presses first
    (1, "both press", "rear wheel in the air"),
    (2, "both press", "front wheel in the air"),
    (2, "rear wheel in the air", "both in the air"),
    (1, "front wheel in the air", "both in the air"),
)


def plot_contact_states(ax=None):
    """The robot as a hybrid system: its four contact states, and what leads from one to another.

    In the notation of `suspension.flight`: ``f`` is Eq. 5, ``p`` the compression of a spring over a
    wheel on the ground, ``p°`` that over the free wheel.
    """
    ax = plt.subplots(figsize=(6.6, 4.2))[1] if ax is None else ax
    ax.set(xlim=(0, 1), ylim=(0, 1))
    ax.axis("off")
    middle = {"ha": "center", "va": "center", "linespacing": 1.7, "size": 11}
    box = {"boxstyle": "round,pad=0.4", "fc": "0.96", "ec": "0.3", "lw": 1.2}
    for name, ((x, y), forces) in STATES.items():
        ax.text(x, y, f"{name}\n{forces}", bbox=box, **middle)
    for wheel, pressing, free in SWITCHES:
        start, end = np.array(STATES[pressing][0]), np.array(STATES[free][0])
        beside = np.array([0.03 * np.sign(end[0] - start[0]), 0.0])  # of there and back
        for a, b, shift, line in ((start, end, beside, "-"), (end, start, -beside, ":")):
            tail, head = a + 0.31 * (b - a) + shift, a + 0.69 * (b - a) + shift
            arrow = {"arrowstyle": "-|>", "color": COLOURS[wheel - 1], "lw": 1.6, "ls": line}
            ax.annotate("", head, tail, arrowprops=arrow | {"shrinkA": 0, "shrinkB": 0})
    for i, colour in enumerate(COLOURS, start=1):
        off = f"{WHEEL[i]} lifts off: $f_{i}$ falls to 0, set $p_{i}^\\circ$"
        on = f"{WHEEL[i]} lands: $p_{i} \\geq p_{i}^\\circ$, $f_{i} > 0$"
        ax.plot([], [], "-", color=colour, label=off)
        ax.plot([], [], ":", color=colour, label=on)
    always = "always $\\dot w = S w + P N + e$; a switch leaves $w$ as it is"
    place = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0)}
    ax.legend(**place, ncols=2, title=always, fontsize=10, title_fontsize=10)
    return ax
