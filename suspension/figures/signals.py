"""Figures of signals in time: what the road does, a computed pitch, the slopes of one step."""

import numpy as np

from suspension.figures.style import LINES, MARKERS, axes_or_new

__all__ = ["plot_pitch", "plot_road_signal", "plot_slopes"]


def plot_road_signal(signals, axes):
    """The height under a wheel and its rate of change, against time.

    Parameters
    ----------
    signals : dict of float to tuple
        For each speed in m/s the times in s, the heights in m and the rates in m/s.
    axes : two Axes
    """
    for k, (v, (t, h, rate)) in enumerate(signals.items()):
        style = {"color": f"C{k}", "ls": LINES[k], "label": f"{v:g} m/s"}
        axes[0].plot(1000 * t, 1000 * h, **style)
        axes[1].plot(1000 * t, rate, **style)
    axes[0].set(ylabel="height $h$ (mm)")
    axes[1].set(ylabel=r"rate $\dot h$ (m/s)")
    for ax in axes:
        ax.set(xlabel="time from the top (ms)")
        ax.legend()
    return axes


def plot_pitch(run, t, exact, ax=None):
    """The computed pitch of a run, a symbol for every step, beside the exact one.

    Parameters
    ----------
    run : Trajectory
    t, exact : array_like, shape (n,)
        Times, s, and the exact pitch, rad.
    """
    ax = axes_or_new(ax)
    ax.plot(t, exact, color="0.35", lw=1, label="exact")
    style = {"color": "C1", "ms": 4, "lw": 0.8, "ls": ":"}
    label = rf"{run.scheme.name}, $\Delta t$ = {run.dt:g} s"
    ax.plot(run.T, run.W[2], MARKERS[0], label=label, **style)
    ax.set(xlabel="time $t$ (s)", ylabel=r"pitch $\theta$ (rad)")
    ax.legend(loc="upper right")
    return ax


def plot_slopes(times, values, slopes, end, curve, ax=None):
    """The slopes that one step of a Runge-Kutta method looks at, and where it ends.

    Parameters
    ----------
    times, values, slopes : array_like, shape (s,)
        Where each stage evaluates the right-hand side, and the slope it finds there.
    end : tuple of float
        Time and value at the end of the step.
    curve : tuple of array_like
        Times and values of the exact solution.
    """
    ax = axes_or_new(ax)
    ax.plot(*curve, color="0.35", lw=1, label="exact")
    half = 0.12 * (end[0] - times[0])
    for i, (t, w, slope) in enumerate(zip(times, values, slopes)):
        run = np.array([-half, half])
        ax.plot(t + run, w + slope * run, color=f"C{i}", lw=2)
        ax.plot(t, w, MARKERS[i], color=f"C{i}", label=f"$g_{i + 1}$")
    ax.plot([times[0], end[0]], [values[0], end[1]], "k--", lw=0.9, label="their mean: the step")
    ax.plot(*end, "k*", ms=9)
    ax.set(xlabel="time $t$", ylabel="$w$")
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return ax
