"""Figures of normal forces against time, with contact and in flight."""

import matplotlib.pyplot as plt
import numpy as np

from suspension.figures.style import COLOURS, LINES, axes_or_new
from suspension.forces import WHEEL

__all__ = ["plot_all_forces", "plot_flight", "plot_forces"]


def plot_forces(trajectory, ax=None):
    """Normal forces against time; what comes after a loss of contact is greyed out."""
    ax = axes_or_new(ax)
    T, N, loss = trajectory.T, trajectory.N, trajectory.loss
    ax.axhline(0, color="0.3", lw=0.8)
    ax.plot(T, N[0], color=COLOURS[0], ls=LINES[0], label="$N_1$, rear")
    ax.plot(T, N[1], color=COLOURS[1], ls=LINES[1], label="$N_2$, front")
    verdict = "contact kept"
    if loss:
        verdict = f"{WHEEL[loss.wheel]} wheel lost at {loss.t:.3f} s"
        ax.axvspan(loss.t, T[-1], color="0.9", lw=0, zorder=0)
        ax.plot(loss.t, 0, "kx", ms=7, mew=1.8, zorder=4)
    ax.set(xlim=(0, T[-1]), xlabel="time $t$ (s)", ylabel="normal force (N)")
    ax.set_title(f"$v$ = {trajectory.v:g} m/s: {verdict}")
    ax.set_ylim(top=ax.get_ylim()[1] + 0.18 * np.ptp(ax.get_ylim()))
    ax.legend(loc="upper right", ncols=2)
    return ax


def plot_all_forces(trajectories):
    """Normal forces of several runs, a panel for each, two in a row; returns the figure."""
    rows = (len(trajectories) + 1) // 2
    figure, axes = plt.subplots(rows, 2, figsize=(7.2, 2.6 * rows), squeeze=False)
    for ax in axes.flat[len(trajectories) :]:
        ax.remove()
    for trajectory, ax in zip(trajectories, axes.flat):
        plot_forces(trajectory, ax)
    return figure


def plot_flight(flight, linear, axes):
    """Forces and heights of the wheels in flight, beside the forces of the linear model.

    Parameters
    ----------
    flight : Flight
    linear : Trajectory
        The same run with a ground that may pull.
    axes : two Axes
    """
    axes[0].axhline(0, color="0.3", lw=0.8)
    for i, name in enumerate(("rear", "front")):
        axes[0].plot(linear.T, linear.N[i], color=COLOURS[i], ls=":", lw=1, alpha=0.8)
        style = {"color": COLOURS[i], "ls": LINES[i]}
        axes[0].plot(flight.T, flight.N[i], **style, label=f"{name} wheel")
        axes[1].plot(flight.T, 1000 * flight.gaps[i], **style)
    axes[0].set(ylabel="normal force (N)", title=f"$v$ = {flight.v:g} m/s")
    axes[1].set(ylabel="wheel above\nground (mm)", xlabel="time $t$ (s)")
    axes[0].set_ylim(top=axes[0].get_ylim()[1] + 0.18 * np.ptp(axes[0].get_ylim()))
    axes[0].legend(loc="upper right", ncols=2)
    return axes
