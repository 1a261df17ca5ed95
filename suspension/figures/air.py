"""Figures of what happens in the air: free wheels, how heavy they may be, and where energy goes."""

import numpy as np

from suspension.figures.speeds import speed_axis
from suspension.figures.style import FIELDS, LINES, axes_or_new

__all__ = ["plot_energy", "plot_free_wheels", "plot_heaviest_wheel"]

BANDS = {"heat": "#f3c9b5", "kinetic": "#9cc3de", "potential": "#a9d8c7"}


def plot_free_wheels(rules, wheels, ax=None):
    """The height of a wheel above the ground: rules of a wheel without mass, and wheels with mass.

    Parameters
    ----------
    rules, wheels : dict of str to tuple of two array_like, shape (n,)
        Times, s, and heights, m; for each rule, and for each wheel, light ones last.
    """
    ax = axes_or_new(ax)
    for i, (name, (t, gap)) in enumerate(wheels.items()):
        grey = f"{0.75 - 0.55 * (i + 1) / len(wheels):.2f}"
        ax.plot(1e3 * np.asarray(t), 1e3 * np.asarray(gap), color=grey, lw=1.1, label=name)
    for i, (name, (t, gap)) in enumerate(rules.items()):
        style = {"color": f"C{i}", "ls": LINES[i], "lw": 2, "zorder": 3}
        ax.plot(1e3 * np.asarray(t), 1e3 * np.asarray(gap), label=name, **style)
    ax.set(xlabel="time $t$ (ms)", ylabel="height of the wheel (mm)", ylim=(0, None))
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    return ax


def plot_heaviest_wheel(v, mass, marked=(), asked=(), ax=None):
    """How heavy a wheel pair may be at each speed, on a rigid tyre, with contact kept below.

    Parameters
    ----------
    v : array_like, shape (n,)
        Speeds, m/s, in order.
    mass : array_like, shape (n,)
        kg; 0 where even wheels without mass leave the ground, inf where all may stay.
    marked : sequence of float
        Masses to mark by a line, kg.
    asked : sequence of float
        Speeds to mark, m/s.
    """
    ax = axes_or_new(ax)
    grams = 1e3 * np.asarray(mass, dtype=float)
    drawn = np.isfinite(grams) & (grams > 0)
    marks = [1e3 * m for m in marked]
    low = min([*(grams[drawn]), *marks, 1.0]) / 2
    high = 3 * max([*(grams[drawn]), *marks, 10.0])
    speed_axis(ax, v)
    top = np.where(np.isinf(grams), high, np.clip(grams, low, high))
    kept = {"where": grams > 0, "color": FIELDS["kept"], "label": "contact kept"}
    ax.fill_between(v, low, top, lw=0, **kept)
    ax.axhspan(low, high, color=FIELDS["lost"], lw=0, zorder=0, label="contact lost")
    ax.plot(v, np.where(drawn, grams, np.nan), color="C0", lw=2, label="heaviest wheel pair")
    for m in marks:
        ax.axhline(m, color="0.35", lw=0.9, ls=":")
        ax.text(v[0], m, f" {m:g} g", color="0.3", va="bottom", ha="left")
    for speed in asked:
        ax.axvline(speed, color="0.5", lw=0.9, ls="--")
    ax.set(yscale="log", ylim=(low, high), ylabel="mass of a wheel pair (g)")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=3)
    return ax


def plot_energy(X, energy, free=(), ax=None):
    """A ribbon of energy: its width is what the road has put in, its bands where that is.

    Parameters
    ----------
    X : array_like, shape (n,)
        Place of the centre of mass, m.
    energy : suspension.energy.Energy
        J, each of shape (n,).
    free : sequence of (start, end)
        Places between which a wheel is in the air, m.
    """
    ax = axes_or_new(ax)
    base = np.zeros(len(X))
    names = {
        "heat": "heat of the dampers",
        "kinetic": "motion of the body",
        "potential": "weight and springs",
    }
    for name, label in names.items():
        top = base + 1e3 * getattr(energy, name)
        ax.fill_between(X, base, top, color=BANDS[name], lw=0, label=label)
        base = top
    ax.plot(X, 1e3 * energy.work, color="0.15", lw=1.4, label="work of the road")
    for i, (start, end) in enumerate(free):
        label = "a wheel in the air" if i == 0 else None
        ax.axvspan(start, end, ymax=0.03, color="C1", lw=0, label=label)
    ax.set(xlabel="position $X$ (m)", ylabel="energy (mJ)", xlim=(X[0], X[-1]), ylim=(0, None))
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    return ax
