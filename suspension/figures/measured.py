"""Figures of the measured spring: its law, its runs, and what a stop does to them."""

import numpy as np

from suspension.figures.speeds import speed_axis
from suspension.figures.style import LINES, MARKERS, axes_or_new

__all__ = [
    "plot_measured_margins",
    "plot_measured_run",
    "plot_spring_laws",
    "plot_stop_stiffness",
]


def _style(i):
    return {"color": f"C{i}", "ls": LINES[i % len(LINES)]}


def plot_spring_laws(x, forces, data, at_rest, farthest, ax=None):
    """Force of several laws against displacement, with the readings and the limit of both.

    Parameters
    ----------
    x : array_like, shape (n,)
        Displacement over delta_max.
    forces : dict of str to array_like, shape (n,)
        N, for each law.
    data : DataFrame
        Columns `delta_over_delta_max` and `force`.
    at_rest, farthest : float
        Displacements to mark, over delta_max: at rest, and the largest of the line.
    """
    ax = axes_or_new(ax)
    top = 1.25 * np.max(next(iter(forces.values())))
    ax.axvspan(1, x[-1], color="0.93", lw=0, zorder=0, label="never measured")
    for i, (name, force) in enumerate(forces.items()):
        ax.plot(x, force, label=name, **_style(i))
    ax.plot(data["delta_over_delta_max"], data["force"], "o", color="k", mfc="none", label="data")
    for place, label in ((at_rest, "at rest"), (farthest, "farthest, line")):
        ax.axvline(place, color="0.35", lw=0.9, ls=":")
        right = place > 0.8 * x[-1]
        ax.text(place, top, f"{label} " if right else f" {label}", color="0.3", va="top",
                ha="right" if right else "left")  # fmt: skip
    ax.set(xlabel=r"$\delta/\delta_{\max}$", ylabel="force $F$ (N)")
    ax.set(xlim=(x[0], x[-1]), ylim=(min(0, data["force"].min()) - 0.5, top))
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    return ax


def plot_measured_margins(v, margins, critical, asked=(), ax=None):
    """Least force on the way against speed for several laws; zero where contact is lost.

    Parameters
    ----------
    v : array_like, shape (n,)
        Speeds, m/s, in order.
    margins : dict of str to array_like, shape (n,)
        N, for each law; what is negative is drawn as zero.
    critical : dict of str to array_like
        Critical speeds, m/s, for each law.
    asked : sequence of float
        Speeds to mark.
    """
    ax = axes_or_new(ax)
    speed_axis(ax, v)
    ax.axhline(0, color="0.2", lw=0.9)
    for speed in asked:
        ax.axvline(speed, color="0.6", lw=0.8, ls=":")
    for i, (name, margin) in enumerate(margins.items()):
        # The zeros belong to the curve, so that it ends where they are.
        places = np.concatenate([v, critical[name]])
        forces = np.concatenate([np.maximum(margin, 0), np.zeros(len(critical[name]))])
        order = np.argsort(places)
        ax.plot(places[order], forces[order], label=name, **_style(i))
        marks = {"mfc": "white", "ms": 6, "zorder": 4, "color": f"C{i}"}
        ax.plot(critical[name], np.zeros(len(critical[name])), MARKERS[i], **marks)
    ax.set(ylabel="least normal force (N)", ylim=(-0.3, None))
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=4, columnspacing=1.2)
    return ax


def plot_measured_run(runs, delta_max, axes):
    """Compression of the front spring and normal force of the front wheel on the way.

    Parameters
    ----------
    runs : dict of str to tuple of three array_like, shape (n,)
        For each law the place of the centre of mass, m, compression, m, and force, N; up to the
        loss of contact.
    delta_max : float
        Place of the stop, m.
    axes : two Axes
    """
    for i, (name, (X, compression, force)) in enumerate(runs.items()):
        axes[0].plot(X, np.asarray(compression) / delta_max, label=name, **_style(i))
        axes[1].plot(X, force, **_style(i))
        axes[1].plot(X[-1], force[-1], MARKERS[i], color=f"C{i}", mfc="white", ms=6)
    axes[0].axhline(1, color="0.3", lw=0.8)
    axes[1].axhline(0, color="0.3", lw=0.8)
    axes[0].set(ylabel=r"$\delta/\delta_{\max}$")
    axes[1].set(ylabel="normal force (N)")
    axes[1].set_yscale("symlog", linthresh=10)
    axes[1].set_ylim(bottom=-2)  # each curve ends where its force vanishes
    for ax in axes:
        ax.set(xlabel="position $X$ (m)")
    axes[0].legend()
    return axes


def plot_stop_stiffness(ratio, felt, kept, marked, ax=None):
    """Largest acceleration at several speeds against the stiffness of the stop.

    Parameters
    ----------
    ratio : array_like, shape (n,)
        Stiffness of the stop over that of the spring.
    felt, kept : dict of float to array_like, shape (n,)
        For each speed in m/s: acceleration, m/s^2, and whether contact is kept.
    marked : dict of str to float
        Stops to mark, by name: their ratio.
    """
    ax = axes_or_new(ax)
    for i, (v, values) in enumerate(felt.items()):
        ax.loglog(ratio, values, label=f"{v:g} m/s", **_style(i))
        for keeps, fill in ((True, f"C{i}"), (False, "white")):
            these = np.flatnonzero(np.asarray(kept[v]) == keeps)
            style = {"color": f"C{i}", "mfc": fill, "ms": 5, "ls": ""}
            ax.plot(np.asarray(ratio)[these], np.asarray(values)[these], MARKERS[i], **style)
    for name, place in marked.items():
        ax.axvline(place, color="0.5", lw=0.9, ls=":")
        ax.text(place, 0.94, f" {name}", transform=ax.get_xaxis_transform(), color="0.3")
    ax.set(xlabel=r"stop / spring stiffness $k_\mathrm{s}/k$")
    ax.set(ylabel="largest acceleration (m/s²)")
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    return ax
