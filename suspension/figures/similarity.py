"""The chart of the highest bumps: dimensionless speed against height, for every robot."""

from itertools import cycle

import numpy as np
from matplotlib.ticker import FuncFormatter, NullLocator

from suspension.figures.style import COLOURS, FIELDS, LINES, axes_or_new

__all__ = ["empty_axes", "plot_chart", "plot_comb", "plot_paths", "plot_vehicles", "plot_window"]

SPEED = r"speed $\nu = v/\sigma\omega_0$"
HEIGHT = r"height $\eta = h_0/(mg/2k)$"
# From weak to strong damping, of one lightness: they are read on a light and on a dark page.
SHADES = ("#857a00", "#2e8b45", "#1a8a8a", "#3b82c4", "#8a70d6", "#c0549e")


def _chart_axes(ax, nu, heights):
    """Logarithmic axes with plain numbers, over the given speeds and heights."""
    ax.set(xscale="log", yscale="log", xlim=(nu[0], nu[-1]), ylim=heights)
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
        axis.set_minor_locator(NullLocator())
    ax.set(xlabel=SPEED, ylabel=HEIGHT)
    return ax


def _along(ax, x, y, text, **style):
    """Write along a curve, at the middle of what is seen of it."""
    low, high = ax.get_ylim()
    left, right = ax.get_xlim()
    seen = np.flatnonzero((low < y) & (y < high) & (left < x) & (x < right))
    if len(seen) < 3:
        return
    i = seen[len(seen) // 2]
    angle = np.degrees(np.arctan2(y[i + 1] - y[i - 1], x[i + 1] - x[i - 1]))
    upright = {"rotation_mode": "anchor", "transform_rotates_text": True}
    ax.text(x[i], y[i], text, rotation=angle, ha="center", va="bottom", **upright, **style)


def _at_the_end(ax, x, y, text, **style):
    """Write beside the right end of a curve, or where it leaves the axes above or below."""
    low, high = ax.get_ylim()
    seen = np.flatnonzero((low < y) & (y < high))
    if not len(seen):
        return
    if seen[-1] == len(x) - 1:
        ax.text(x[-1], y[-1], f" {text}", va="center", **style)
    elif y[-1] >= high:
        ax.text(x[seen[-1]], high, text, ha="center", va="bottom", **style)
    else:
        ax.text(0.75 * x[seen[-1]], low * 1.1, text, ha="right", va="bottom", **style)


def plot_chart(nu, curves, limits=(), bump=None, own=None, heights=(0.03, 300), ax=None):
    """The highest bump that is crossed with contact against speed, for several dampings.

    Parameters
    ----------
    nu : ndarray, shape (n,)
        Dimensionless speeds, in order.
    curves : dict of float to ndarray, shape (n,)
        For each damping ratio the highest bump over the sag.
    limits : dict of str to ndarray, shape (n,)
        By name, drawn dashed.
    bump : tuple, optional
        Height of a bump over the sag; speeds asked for and whether contact is lost at each;
        critical speeds; and the ranges in which contact is kept, shape (m, 2). Drawn as a line
        across, with marks, and thick where kept.
    own : float, optional
        The damping to stress: above its curve contact is lost.
    heights : pair of float
        Ends of the vertical axis.
    """
    ax = _chart_axes(axes_or_new(ax), nu, heights)
    for shade, (zeta, eta) in zip(cycle(SHADES), curves.items()):
        stressed = zeta == own
        style = {"color": "k", "lw": 2.6} if stressed else {"color": shade, "lw": 1.5}
        ax.plot(nu, eta, zorder=3 if stressed else 2.5, **style)
        if len(curves) > 1:
            label = "undamped" if zeta == 0 else rf"$\zeta$ = {zeta:.2g}"
            weight = "bold" if stressed else "normal"
            _at_the_end(ax, nu, eta, label, color=style["color"], fontsize=8.5, weight=weight)
    if own is not None:
        ax.fill_between(
            nu,
            np.minimum(curves[own], heights[1]),
            heights[1],
            color=FIELDS["lost"],
            lw=0,
            zorder=0,
        )
        words = {"transform": ax.transAxes, "color": "0.3", "fontsize": 10, "style": "italic"}
        ax.text(0.42, 0.93, "contact lost", ha="center", **words)
        ax.text(0.03, 0.05, "kept", **words)
    for name, eta in dict(limits).items():
        ax.plot(nu, eta, color="0.35", lw=1, ls="--", zorder=2)
        _along(ax, nu, eta, name, color="0.25", fontsize=9.5, style="italic")
    if bump is not None:
        _bump_across(ax, *bump)
    return ax


def _bump_across(ax, eta, asked, lost, critical, kept):
    ax.axhline(eta, color=COLOURS[1], lw=1.4, ls="--", zorder=3.5)
    for span in kept:
        ax.plot(span, [eta, eta], color=COLOURS[0], lw=3.2, solid_capstyle="butt", zorder=3.6)
    ax.text(ax.get_xlim()[1], eta, " the bump", color=COLOURS[1], va="center", weight="bold")
    ax.plot(critical, np.full(len(critical), eta), "D", color="k", ms=5, zorder=5)
    marks = {"ls": "", "mec": "k", "ms": 8, "zorder": 4}
    for gone, face, label in ((False, "white", "asked, kept"), (True, COLOURS[1], "asked, lost")):
        places = np.asarray(asked)[np.asarray(lost) == gone]
        if len(places):
            ax.plot(places, np.full(len(places), eta), "o", mfc=face, label=label, **marks)
    if len(critical):
        ax.plot([], [], "D", color="k", ms=5, label="critical speed")
    ax.legend(loc="lower left", bbox_to_anchor=(0.02, 0.1), frameon=True, edgecolor="none")


def empty_axes(x, y, names, ax=None):
    """Empty logarithmic axes, with a grid, to draw on.

    Parameters
    ----------
    x, y : pair of float
        Their ends.
    names : (str, str)
        What they count.
    """
    ax = _chart_axes(axes_or_new(ax), x, y)
    ax.set(xlabel=names[0], ylabel=names[1])
    ax.grid(color="0.85", lw=0.6)
    return ax


def plot_comb(nu, exact, comb, alone, throw, ax=None):
    """What the wheelbase does to an undamped robot.

    Parameters
    ----------
    nu : ndarray, shape (n,)
    exact, comb, alone, throw : ndarray, shape (n,)
        Highest bumps over the sag: exact; by the formula for its free swing; of the robot with
        half of its mass on each wheel; and by the line of both kicks in one.
    """
    heights = (0.7 * np.min(exact), 3 * np.max(throw))
    ax = _chart_axes(axes_or_new(ax), nu, heights)
    ax.plot(nu, throw, color="0.35", lw=1, ls="--", label="throw")
    ax.plot(nu, alone, color="C2", ls="-.", label="no comb: $j = 1$")
    ax.plot(nu, exact, color="C0", lw=3.2, alpha=0.6, label="exact")
    ax.plot(nu, comb, color="k", ls=":", lw=1.6, label="comb, by formula")
    ax.legend(loc="upper left")
    return ax


def plot_paths(limits, curves, points, asked, heights=(0.03, 30), ax=None):
    """A choice on the chart: at each speed, springs are the places on a line of slope -2.

    Parameters
    ----------
    limits : dict of str to (ndarray, ndarray), shapes (n,)
        By name, dimensionless speeds and the highest bump over the sag, drawn dashed.
    curves : dict of str to (ndarray, ndarray), shapes (n,)
        For each suspension by name the same, exact.
    points : dict of str to (ndarray, float, ndarray)
        For each suspension its dimensionless speeds, shape (m,), the height of the bump over its
        sag, and whether contact is lost at each.
    asked : sequence of float
        The m speeds, m/s.
    """
    nu = np.concatenate([speeds for speeds, _ in curves.values()])
    ax = _chart_axes(axes_or_new(ax), (nu.min(), nu.max()), heights)
    ends = np.array(ax.get_xlim())
    first, eta, _ = next(iter(points.values()))
    for v, speed in zip(asked, first):
        ax.plot(ends, eta * (speed / ends) ** 2, color="0.75", lw=1, zorder=1)
        top = speed * np.sqrt(eta / heights[1])
        ax.text(max(top, ends[0]), heights[1], f"{v:g} m/s", fontsize=8, va="bottom", ha="center")
    for name, (speeds, height) in limits.items():
        ax.plot(speeds, height, color="0.35", lw=1, ls="--", zorder=2)
        _along(ax, speeds, height, name, color="0.25", fontsize=9.5, style="italic")
    for i, (name, (speeds, height)) in enumerate(curves.items()):
        ax.plot(speeds, height, color=f"C{i}", ls=LINES[i], lw=2, label=name, zorder=3)
        speeds, eta, lost = points[name]
        for gone, face in ((False, "white"), (True, f"C{i}")):
            marks = {"mec": f"C{i}", "mfc": face, "mew": 1.8, "ms": 7, "zorder": 4}
            ax.plot(speeds[lost == gone], np.full(np.sum(lost == gone), eta), "o", ls="", **marks)
    ax.plot([], [], "o", mfc="0.4", mec="0.4", ls="", label="lost")
    ax.plot([], [], "o", mfc="white", mec="0.4", ls="", label="kept")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=4)
    return ax


def plot_window(zeta, exact, limit, lines, bump, now, closes, ax=None):
    """The height of the window in which faster is safer, against damping.

    Parameters
    ----------
    zeta : ndarray, shape (n,)
    exact, limit, lines : ndarray, shape (n,)
        Highest bump over the sag that is crossed there: exact, by two limits, by two straight
        lines.
    bump, now, closes : float
        Height of the bump, damping of the robot, and the damping at which the window closes.
    """
    heights = (0.3 * np.min(lines), 1.3 * np.max(limit))
    ax = _chart_axes(axes_or_new(ax), zeta, heights)
    ax.set(xlabel=r"damping $\zeta = c/\sqrt{2km}$")
    ax.fill_between(zeta, exact, heights[0], color=FIELDS["kept"], lw=0, zorder=0)
    ax.plot(zeta, lines, color="0.35", lw=1, ls="--", label="two straight lines")
    ax.plot(zeta, limit, color="C0", ls="-.", label="with the spring")
    ax.plot(zeta, exact, color="k", lw=2.4, label="exact")
    ax.axhline(bump, color=COLOURS[1], lw=1.4, label="the bump")
    ax.plot(closes, bump, "kD", ms=5, zorder=4, label="the window closes")
    ax.plot(now, bump, "o", mec="k", mfc="white", ms=8, ls="", zorder=4, label="the robot")
    words = {"transform": ax.transAxes, "color": "0.3", "style": "italic", "fontsize": 10}
    ax.text(0.04, 0.06, "open", **words)
    ax.text(0.96, 0.93, "closed", ha="right", **words)
    ticks = [x for x in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5) if zeta[0] <= x <= zeta[-1]]
    ax.set_xticks(ticks, [f"{x:g}" for x in ticks])
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=3)
    return ax


def plot_vehicles(rides, ax=None):
    """Vehicles that cross an obstacle each, a row for each over the speed.

    Parameters
    ----------
    rides : dict of str to (Regimes, float)
        For each vehicle by name where contact is kept and lost, km/h, and the speed above which a
        rigid wheel's own mass lifts it, nan if its mass is not known.
    """
    ax = axes_or_new(ax)
    bar = {"lw": 7, "solid_capstyle": "butt", "zorder": 2}
    for row, (contact, heavy) in enumerate(rides.values()):
        for start, end in contact.spans(lost=False):
            ax.plot([start, end], [row, row], color=COLOURS[0], **bar)
        for start, end in contact.spans(lost=True):
            ax.plot([start, end], [row, row], color=COLOURS[1], **bar)
        ax.plot(contact.critical, np.full(len(contact.critical), row), "kD", ms=6, zorder=4)
        for v in contact.critical:
            ax.annotate(
                f"{v:.2g}", (v, row), (0, 7), textcoords="offset points", ha="center", fontsize=8
            )
        if heavy <= contact.edges[-1]:
            ax.plot(heavy, row, "kx", ms=7, mew=2, zorder=5)
    for colour, name in zip(COLOURS, ("kept", "lost")):
        ax.plot([], [], color=colour, lw=7, label=name)
    ax.plot([], [], "kD", ms=6, ls="", label="critical speed")
    ax.plot([], [], "kx", ms=7, mew=2, ls="", label="wheel too heavy from here on")
    ax.set(xscale="log", xlabel="speed (km/h)", ylim=(len(rides) - 0.4, -0.7))
    ax.set_yticks(range(len(rides)), list(rides), fontsize=8)
    ax.tick_params(axis="y", length=0)
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    ax.grid(axis="y", visible=False)
    ax.legend(loc="upper center", bbox_to_anchor=(0.4, -0.2), ncols=4)
    return ax
