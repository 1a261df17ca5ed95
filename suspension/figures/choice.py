"""Figures of Parts IX to XI: the robot as a filter, maps for a choice, a rough road."""

import numpy as np
from matplotlib.ticker import FuncFormatter

from suspension.figures.speeds import speed_axis
from suspension.figures.style import COLOURS, FIELDS, LINES, MARKERS, axes_or_new
from suspension.forces import WHEEL

__all__ = [
    "plot_demand_map",
    "plot_front",
    "plot_gains",
    "plot_margins",
    "plot_rides",
    "plot_ripples",
    "plot_rough_ride",
]


def plot_gains(wavelength, heave, pitch, blind, axes):
    """How strongly a sine wave in the road excites heave and pitch, against its length.

    Parameters
    ----------
    wavelength : array_like, shape (n,)
        m.
    heave, pitch : dict of float to array_like, shape (n,)
        For each speed in m/s, ``|Y|`` and ``L |theta|`` over the amplitude of the road.
    blind : pair of sequence of float
        Wavelengths at which the comb lets nothing through to the heave, and to the pitch, m.
    axes : two Axes
    """
    names = (r"heave $\vert Y\vert/a$", r"pitch $L\vert\theta\vert/a$")
    for ax, gains, lines, name in zip(axes, (heave, pitch), blind, names):
        for place in lines:
            ax.axvline(place, color="0.6", lw=0.8, ls=":")
        for i, (v, gain) in enumerate(gains.items()):
            ax.plot(wavelength, gain, color=f"C{i}", ls=LINES[i], label=f"{v:g} m/s")
        high = max(np.max(gain) for gain in gains.values())
        ax.set(xscale="log", yscale="log", ylim=(high / 1000, 2 * high))
        ax.set(xlabel="wavelength (m)", ylabel=name, xlim=(wavelength[0], wavelength[-1]))
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes[0].legend()
    return axes


def plot_ripples(v, margin, swings, single, exact, axes):
    """The margin against speed, and below it the swings that the bump leaves behind.

    Parameters
    ----------
    v, margin : array_like, shape (n,)
        Speeds, m/s, and margins, N.
    swings, single : dict of str to array_like, shape (n,)
        For each mode by name the swing behind the bump, m, and what it would be if both wheels
        met the bump at once (the comb left out).
    exact : tuple of array_like and dict of str to array_like
        Some speeds, and the swings there from the closed form.
    axes : two Axes
    """
    axes[0].plot(v, margin, color="k")
    axes[0].axhline(0, color="0.2", lw=0.8)
    axes[0].set(ylabel="margin (N)")
    few, found = exact
    for i, name in enumerate(swings):
        style = {"color": f"C{i}"}
        axes[1].plot(v, 1000 * np.asarray(single[name]), ls=":", lw=1, **style)
        axes[1].plot(v, 1000 * np.asarray(swings[name]), ls=LINES[i], label=name, **style)
        axes[1].plot(few, 1000 * np.asarray(found[name]), MARKERS[i], ms=3.5, **style)
    axes[1].set(ylabel="swing left behind (mm)", ylim=(0, None))
    axes[1].legend()
    for ax in axes:
        speed_axis(ax, v)
    return axes


def plot_demand_map(k, c, values, levels, marks, label, contact=None, blank=None, ax=None):
    """What suspensions give or ask for, over stiffness and damping, both on logarithmic axes.

    Parameters
    ----------
    k, c : array_like, shapes (n,) and (m,)
        Stiffness, N/m, and damping, N s/m.
    values : array_like, shape (m, n)
    levels : sequence of float
        Where colours change, in order.
    marks : dict of str to (float, float)
        Suspensions by name: k and c.
    label : str
        What the values are, with their unit.
    contact : array_like, shape (m, n), optional
        Positive where contact is kept, negative where it is lost, and continuous where it is zero:
        a white line is drawn there.
    blank : {"kept", "lost"}, optional
        The side of this line of which the values say nothing: it is painted in one tone.
    """
    ax = axes_or_new(ax)
    extend = "both" if levels[0] else "max"
    filled = ax.contourf(k, c, values, levels, cmap="cividis", extend=extend)
    if blank is not None:
        side = np.asarray(contact) if blank == "kept" else -np.asarray(contact)
        if side.max() > 0:
            ax.contourf(k, c, side, [0, side.max()], colors=[FIELDS[blank]])
    if contact is not None and np.min(contact) < 0 < np.max(contact):
        ax.contour(k, c, contact, [0], colors="w", linewidths=2)
    for marker, (name, place) in zip(MARKERS, marks.items()):
        ax.plot(*place, marker, color="k", mfc="white", ms=6, ls="", label=name)
    if blank is not None:
        ax.fill([], [], color=FIELDS[blank], label=f"contact {blank}")
    ax.set(xscale="log", yscale="log", xlabel="stiffness $k$ (N/m)", ylabel="damping $c$ (N s/m)")
    ticks = [x for x in (100, 200, 500, 1000, 2000, 5000) if k[0] <= x <= k[-1]]
    ax.set_xticks(ticks, [str(x) for x in ticks])
    ax.set_xticks([], minor=True)
    ticks = [x for x in (0.2, 0.5, 1, 2, 5, 10, 20) if c[0] <= x <= c[-1]]
    ax.set_yticks(ticks, [f"{x:g}" for x in ticks])
    ax.set_yticks([], minor=True)
    ax.grid(False)
    ax.set_title(label, fontsize=9)
    bar = ax.figure.colorbar(filled, ax=ax, orientation="horizontal", aspect=15)
    bar.set_ticks(levels[::2])
    return ax


def plot_front(compression, acceleration, margin, marks, ax=None):
    """The best compromises of three criteria: two as axes, the third as colour.

    Parameters
    ----------
    compression, acceleration, margin : array_like, shape (n,)
        m, m/s^2 and N of each; the margin is 0 where contact is lost.
    marks : dict of str to (float, float)
        Suspensions by name: compression, m, and acceleration, m/s^2.
    """
    ax = axes_or_new(ax)
    travel, acceleration = 1000 * np.asarray(compression), np.asarray(acceleration)
    kept = np.asarray(margin) > 0
    ax.plot(travel[~kept], acceleration[~kept], "o", color="0.5", mfc="none", ms=4, ls="")
    style = {"cmap": "cividis", "s": 16, "vmin": 0}
    dots = ax.scatter(travel[kept], acceleration[kept], c=np.asarray(margin)[kept], **style)
    for marker, (name, (travel, felt)) in zip(MARKERS, marks.items()):
        style = {"mfc": "white", "mec": "k", "ms": 8, "ls": "", "zorder": 4}
        ax.plot(1000 * travel, felt, marker, label=name, **style)
    ax.set(xlabel="largest compression (mm)", ylabel="largest acceleration (m/s²)", ylim=(0, None))
    ax.legend(loc="upper right")
    ax.figure.colorbar(dots, ax=ax, label="least margin (N)")
    return ax


def plot_margins(v, margins, asked=(), ax=None):
    """The margin against speed, for several suspensions.

    Parameters
    ----------
    v : array_like, shape (n,)
        Speeds, m/s.
    margins : dict of str to array_like, shape (n,)
        N.
    asked : sequence of float
        Speeds to mark on the curves.
    """
    ax = axes_or_new(ax)
    # Of the curves only the sign counts there.
    ax.axhspan(-1e3, 0, color=FIELDS["lost"], lw=0, zorder=0)
    for i, (name, margin) in enumerate(margins.items()):
        style = {"color": f"C{i}"}
        ax.plot(v, margin, ls=LINES[i], label=name, **style)
        ax.plot(asked, np.interp(asked, v, margin), MARKERS[i], mfc="white", ms=5, **style)
    high = max(np.max(margin) for margin in margins.values())
    ax.set(ylabel="margin (N)", ylim=(-0.25 * high, 1.2 * high))
    speed_axis(ax, v)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=4)
    return ax


def plot_rough_ride(x, H, places, N, axes):
    """A rough road, and the forces of the wheels on it.

    Parameters
    ----------
    x, H : array_like, shape (n,)
        Places and heights, m.
    places : array_like, shape (j,)
        Of the centre of mass, m.
    N : array_like, shape (2, j)
        Normal forces, N; where one is zero the wheel is in the air.
    axes : two Axes
    """
    axes[0].fill_between(x, 1000 * np.asarray(H), 1000 * np.min(H) - 5, color="0.8", lw=0)
    axes[0].plot(x, 1000 * np.asarray(H), color="0.3", lw=1)
    axes[0].set(ylabel="height (mm)")
    for i, force in enumerate(N):
        style = {"color": COLOURS[i], "ls": LINES[i], "lw": 1.2}
        axes[1].plot(places, force, label=f"{WHEEL[i + 1]} wheel", **style)
    in_the_air = (np.min(N, axis=0) <= 0).astype(float)
    inside = axes[1].get_xaxis_transform()
    axes[1].fill_between(
        places, 0, in_the_air, transform=inside, color=FIELDS["lost"], lw=0, zorder=0, step="mid"
    )
    axes[1].set(ylabel="normal force (N)", ylim=(0, 1.25 * np.max(N)))
    axes[1].legend(loc="upper right", ncols=2)
    for ax in axes:
        ax.set(xlim=(places[0], places[-1]))
    axes[1].set(xlabel="place $X$ (m)")
    return axes


def plot_rides(v, curves, asked, force, air, load, axes):
    """Rides on many roads: how a wheel's force scatters, and how long it is in the air.

    Parameters
    ----------
    v : array_like, shape (n,)
        Speeds, m/s.
    curves : dict of str to array_like, shape (n,)
        For each suspension by name the root mean square of the linear robot's force, N.
    asked : sequence of float
        Speeds of the rides, m/s.
    force, air : array_like, shape (roads, suspensions, speeds)
        Root mean squares, N, and parts of the time.
    load : float
        The force at rest, N.
    axes : two Axes
    """
    for i, (name, curve) in enumerate(curves.items()):
        places = np.asarray(asked) * (0.96 if i % 2 == 0 else 1.04)  # side by side
        style = {"color": f"C{i}", "ms": 3.5, "alpha": 0.6, "mew": 0}
        axes[0].plot(v, curve, color=f"C{i}", ls=LINES[i], label=f"{name}: linear")
        for ax, values in zip(axes, (force, 100 * np.asarray(air))):
            dots = ax.plot(places, np.asarray(values)[:, i].T, MARKERS[i], ls="", **style)
            dots[0].set_label(f"{name}: rides")
    axes[0].axhline(load, color="0.3", lw=1)
    for ax in axes:
        speed_axis(ax, v)
        ax.set_xlim(0.9 * v[0], 1.1 * v[-1])
    axes[0].set(yscale="log", ylabel="force, root mean square (N)")
    axes[1].set(ylabel="rear wheel in the air (%)", ylim=(-2, None))
    return axes
