"""Figures over speed: the margin, what it depends on, and how far springs and body move."""

from itertools import pairwise

import numpy as np
from matplotlib.colors import TwoSlopeNorm
from matplotlib.ticker import NullLocator

from suspension.figures.style import COLOURS, LINES, axes_or_new
from suspension.forces import WHEEL

__all__ = ["plot_margin", "plot_margin_map", "plot_sensitivities", "plot_travel"]


def _speed_axis(ax, v):
    ticks = [x for x in (0.1, 0.25, 0.5, 1.2, 2.5, 5, 10, 20, 30) if v[0] <= x <= v[-1]]
    ax.set_xscale("log")
    ax.set_xticks(ticks, [f"{x:g}" for x in ticks])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set(xlim=(v[0], v[-1]), xlabel="speed $v$ (m/s)")


def plot_margin(v, N, critical, asked=(), ax=None):
    """Least force of each wheel against speed, with the speeds at which contact is lost shaded.

    Parameters
    ----------
    v : array_like, shape (n,)
        Speeds, m/s, in order.
    N : array_like, shape (2, n)
        Least normal force of the rear and the front wheel, N.
    critical : array_like
        Critical speeds, m/s.
    asked : sequence of float
        Speeds to mark on the curve of the margin.
    """
    ax = axes_or_new(ax)
    margin = np.min(N, axis=0)
    edges = [v[0], *critical, v[-1]]
    for left, right in pairwise(edges):
        lost = np.interp(np.sqrt(left * right), v, margin) < 0
        if lost:
            ax.axvspan(left, right, color="#fbe3d6", lw=0, zorder=0)
        place = {"transform": ax.get_xaxis_transform(), "ha": "center", "color": "0.3"}
        ax.text(np.sqrt(left * right), 1.01, "lost" if lost else "kept", **place)
    ax.axhline(0, color="0.2", lw=0.9)
    ax.semilogx(v, N[0], color="C0", label="rear wheel")
    ax.semilogx(v, N[1], "--", color="C1", label="front wheel")
    ax.plot(critical, np.zeros(len(critical)), "kD", ms=5, label="critical speeds", zorder=4)
    for speed in critical:
        label = {"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1}
        ax.text(speed, 5.2, f"{speed:.3g}", ha="center", weight="bold", bbox=label, zorder=5)
    at = np.interp(asked, v, margin)
    ax.plot(asked, at, "o", color="k", mfc="white", ms=6, label="asked in the problem", zorder=4)
    _speed_axis(ax, v)
    ax.set(ylabel="least normal force (N)")
    ax.legend(loc="lower right")
    return ax


def plot_margin_map(v, k, margin, fitted, interval, asked=(), ax=None):
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
    """
    ax = axes_or_new(ax)
    levels = [-30, -20, -10, -5, 0, 1, 2, 4, 7]
    filled = ax.contourf(
        v, k, margin, levels, cmap="RdBu", norm=TwoSlopeNorm(0, -30, 7), extend="min"
    )
    ax.contour(v, k, margin, [0], colors="k", linewidths=1.6)
    ax.axhspan(*interval, color="0.2", alpha=0.18, lw=0)
    ax.axhline(fitted, color="0.2", lw=1, ls="--")
    ax.plot(asked, [fitted] * len(asked), "o", color="k", mfc="white", ms=6)
    _speed_axis(ax, v)
    ax.grid(False)
    ax.set(ylabel="stiffness $k$ (N/m)")
    ax.figure.colorbar(filled, ax=ax, label="margin (N)")
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
    for i, (speed, hatch) in enumerate(zip(speeds, ("", "//", "..", "xx", "--"))):
        height = [values[i] for values in percent.values()]
        offset = (i - (len(speeds) - 1) / 2) * 0.27
        ax.bar(place + offset, height, 0.25, hatch=hatch, ec="white", label=f"at {speed:.3g} m/s")
    ax.axhline(0, color="0.2", lw=0.8)
    ax.set_xticks(place, list(percent), fontsize=12)
    ax.set(ylabel="change of critical speed (%)\nfor 1 % more")
    ax.grid(axis="x")
    ax.legend(ncols=3)
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
        _speed_axis(ax, v)
    return axes
