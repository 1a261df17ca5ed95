"""Figures over speed: the margin, what it depends on, and how far springs and body move."""

import numpy as np
from matplotlib.colors import TwoSlopeNorm
from matplotlib.ticker import NullFormatter, NullLocator

from suspension.figures.style import COLOURS, FIELDS, LINES, axes_or_new
from suspension.forces import WHEEL

__all__ = [
    "plot_branches",
    "plot_margin",
    "plot_margin_map",
    "plot_sampled_margin",
    "plot_sensitivities",
    "plot_travel",
    "speed_axis",
]


def speed_axis(ax, v):
    """A logarithmic axis of speeds from v[0] to v[-1], m/s, with round numbers."""
    ticks = [x for x in (0.1, 0.25, 0.5, 1.2, 2.5, 5, 10, 20, 30) if v[0] <= x <= v[-1]]
    ax.set_xscale("log")
    ax.set_xticks(ticks, [f"{x:g}" for x in ticks])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set(xlim=(v[0], v[-1]), xlabel="speed $v$ (m/s)")


def _labels_apart(ax, speeds, labels, **style):
    """Write labels above the axes, those of neighbouring speeds in rows below each other."""
    left, right = np.log(ax.get_xlim())
    ends = []  # of each row, as a part of the axes' width
    for speed, label in zip(speeds, labels):
        middle = (np.log(speed) - left) / (right - left)
        row = next((i for i, end in enumerate(ends) if end < middle - 0.04), len(ends))
        ends[row : row + 1] = [middle + 0.04]
        height = 0.96 - 0.07 * row
        ax.text(speed, height, label, transform=ax.get_xaxis_transform(), **style)


def _hatch(ax, ranges, label):
    """Hatch ranges of speed over the whole height."""
    style = {"facecolor": "none", "edgecolor": "0.7", "hatch": "//", "lw": 0, "zorder": 0.5}
    for i, found in enumerate(ranges):
        ax.axvspan(found.low, found.high, label=label if i == 0 else None, **style)


def plot_margin(v, N, regimes, asked=(), beyond=(), ax=None):
    """Least force of each wheel against speed, with the speeds at which contact is lost shaded.

    Parameters
    ----------
    v : array_like, shape (n,)
        Speeds, m/s, in order.
    N : array_like, shape (2, n)
        Least normal force of the rear and the front wheel, N.
    regimes : suspension.contact.Regimes
        Where contact is kept and lost, what is shaded.
    asked : sequence of float
        Speeds to mark on the curve of the margin.
    beyond : sequence of suspension.travel.Overtravel
        Ranges of speed to hatch: a spring is compressed further than it was measured.
    """
    ax = axes_or_new(ax)
    margin = np.min(N, axis=0)
    speed_axis(ax, v)
    critical = regimes.critical
    for left, right in regimes.spans(lost=True):
        ax.axvspan(left, right, color=FIELDS["lost"], lw=0, zorder=0)
    above = {"transform": ax.get_xaxis_transform(), "ha": "center", "color": "0.3"}
    for lost, word in ((False, "kept"), (True, "lost")):
        for left, right in regimes.spans(lost):
            if right > left * (v[-1] / v[0]) ** 0.06:  # else there is no room for a word
                ax.text(np.sqrt(left * right), 1.01, word, **above)
    _hatch(ax, beyond, r"spring beyond $\delta_{\max}$")
    ax.axhline(0, color="0.2", lw=0.9)
    ax.plot(v, N[0], color=COLOURS[0], ls=LINES[0], label=f"{WHEEL[1]} wheel")
    ax.plot(v, N[1], color=COLOURS[1], ls=LINES[1], label=f"{WHEEL[2]} wheel")
    if len(critical):
        label = "critical speed" if len(critical) == 1 else "critical speeds"
        ax.plot(critical, np.zeros(len(critical)), "kD", ms=5, label=label, zorder=4)
    if len(asked):
        at = np.interp(asked, v, margin)
        marks = {"color": "k", "mfc": "white", "ms": 6, "zorder": 4}
        ax.plot(asked, at, "o", label="asked in the problem", **marks)
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.16 * (high - low))  # room for the labels
    box = {"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1}
    style = {"ha": "center", "va": "top", "weight": "bold", "bbox": box, "zorder": 5}
    _labels_apart(ax, critical, [f"{speed:.3g}" for speed in critical], **style)
    ax.set(ylabel="least normal force (N)")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=5, columnspacing=1.2)
    return ax


def plot_sampled_margin(v, sampled, exact, ax=None):
    """The margin against speed, exact and as the least of samples.

    Parameters
    ----------
    v : array_like, shape (n,)
        Speeds, m/s, in order.
    sampled : dict of float to array_like, shape (n,)
        For each time between two samples, s, the least of them, N.
    exact : array_like, shape (n,)
        N.
    """
    ax = axes_or_new(ax)
    ax.axhline(0, color="0.3", lw=0.8)
    for i, (dt, least) in enumerate(sampled.items()):
        ax.plot(v, least, ls=LINES[i % len(LINES)], label=f"a sample every {1000 * dt:g} ms")
    ax.plot(v, exact, color="black", lw=2, label="exact")
    ax.set(xlabel="speed $v$ (m/s)", ylabel="margin (N)", xlim=(v[0], v[-1]))
    ax.legend()
    return ax


def plot_margin_map(v, k, margin, fitted, interval, asked=(), beyond=None, ax=None):
    """The margin over speed and stiffness, with the line on which the verdict turns.

    Parameters
    ----------
    v, k : array_like, shapes (n,) and (m,)
        Speeds, m/s, and stiffnesses, N/m.
    margin : array_like, shape (m, n)
        N.
    fitted, interval : float and pair of float
        Stiffness of Part I and its confidence interval, N/m.
    asked : sequence of float
        Speeds to mark.
    beyond : tuple of three array_like, shapes (i,), (j,) and (j, i), optional
        Speeds, stiffnesses, and the largest compression of a spring over that at which it was
        measured; hatched where above 1.
    """
    ax = axes_or_new(ax)
    levels = [-30, -20, -10, -5, 0, 1, 2, 4, 7]
    filled = ax.contourf(
        v, k, margin, levels, cmap="RdBu", norm=TwoSlopeNorm(0, -30, 7), extend="both"
    )
    if beyond is not None:
        hatched = ax.contourf(*beyond, [1, np.inf], colors="none", hatches=["//"])
        hatched.set(edgecolor="0.45", linewidth=0)
    ax.contour(v, k, margin, [0], colors="k", linewidths=1.6)
    ax.axhspan(*interval, color="0.2", alpha=0.18, lw=0)
    ax.axhline(fitted, color="0.2", lw=1, ls="--")
    ax.plot(asked, [fitted] * len(asked), "o", color="k", mfc="white", ms=6)
    speed_axis(ax, v)
    ax.grid(False)
    ax.set(ylabel="stiffness $k$ (N/m)", ylim=(k[0], k[-1]))
    ax.figure.colorbar(filled, ax=ax, label="margin (N)")
    return ax


def plot_branches(branches, fitted, interval=None, asked=(), ax=None):
    """The critical speeds as curves over the stiffness.

    Parameters
    ----------
    branches : sequence of Branch
        As `suspension.branches.branches` finds them.
    fitted : float
        The estimate of the stiffness, N/m.
    interval : pair of float, optional
        Its confidence interval, N/m.
    asked : sequence of float
        Speeds to mark, m/s.
    """
    ax = axes_or_new(ax)
    for branch in branches:
        ax.plot(np.exp(branch.points.imag), np.exp(branch.points.real), color="0.2", lw=1.4)
    if interval is not None:
        ax.axvspan(*interval, color="C2", alpha=0.3, lw=0)
    ax.axvline(fitted, color="C2", lw=1.4)
    for v in asked:
        ax.axhline(v, color="C1", lw=1, ls="--")
    ax.set(xscale="log", yscale="log", xlabel="stiffness $k$ (N/m)", ylabel="speed $v$ (m/s)")
    if branches:
        ax.set_xlim(*(np.exp(f([f(b.points.imag) for b in branches])) for f in (np.min, np.max)))
    ax.xaxis.set_minor_formatter(NullFormatter())
    return ax


def plot_sensitivities(speeds, percent, ax=None):
    """By how many per cent each critical speed moves for one per cent more of a parameter.

    Parameters
    ----------
    speeds : array_like, shape (n,)
        Critical speeds, m/s.
    percent : dict of str to array_like, shape (n,)
        For each parameter.
    """
    ax = axes_or_new(ax)
    place = np.arange(len(percent))
    width = 0.8 / max(len(speeds), 1)
    hatches = ("", "//", "..", "xx", "--")
    for i, speed in enumerate(speeds):
        height = [values[i] for values in percent.values()]
        offset = (i - (len(speeds) - 1) / 2) * width
        style = {"hatch": hatches[i % len(hatches)], "ec": "white"}
        ax.bar(place + offset, height, 0.93 * width, label=f"at {speed:.3g} m/s", **style)
    ax.axhline(0, color="0.2", lw=0.8)
    ax.set_xticks(place, list(percent), fontsize=12)
    ax.set(ylabel="change of critical speed (%)\nfor 1 % more")
    ax.grid(axis="x")
    if len(speeds):
        ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return ax


def plot_travel(v, compression, pitch, delta_max, axes):
    """Largest spring compression and pitch against speed, while both wheels press.

    Parameters
    ----------
    v, compression, pitch : array_like, shape (n,)
        Speeds, m/s, compressions, m, pitch angles, rad.
    delta_max : float
        Largest displacement at which the spring was measured, m.
    axes : two Axes
    """
    axes[0].semilogx(v, 1000 * np.asarray(compression))
    axes[0].axhline(
        1000 * delta_max, color="C1", ls="--", label=r"$\delta_{\max}$, largest measured"
    )
    axes[0].set(ylabel="spring compression (mm)", ylim=(0, None))
    axes[0].legend(loc="lower right")
    axes[1].semilogx(v, np.degrees(pitch))
    axes[1].set(ylabel="pitch (degrees)", ylim=(0, None))
    for ax in axes:
        speed_axis(ax, v)
    return axes
