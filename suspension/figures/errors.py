"""Figures of errors: against step and cost, in the modes, and in a dip that was missed."""

import numpy as np

from suspension.figures.style import LINES, MARKERS, axes_or_new

__all__ = ["plot_errors", "plot_heave", "plot_missed_dip", "plot_seen_mode"]


def plot_errors(x, errors, ax=None):
    """Errors against step size or cost, on logarithmic axes.

    Parameters
    ----------
    x : array_like, shape (n,), or dict of them
        Step sizes or costs, for all curves or for each.
    errors : dict of str to array_like, shape (n,)
        A curve for each name.
    """
    ax = axes_or_new(ax)
    for i, (name, error) in enumerate(errors.items()):
        at = x[name] if isinstance(x, dict) else x
        style = {"ls": LINES[i % len(LINES)], "marker": MARKERS[i % len(MARKERS)], "mfc": "none"}
        ax.loglog(at, error, **style, label=name)
    ax.legend(loc="upper left")
    return ax


def plot_heave(X, heave, ax=None):
    """Heave against position for several speeds; `heave` is a dict of speed, m/s, to m."""
    ax = axes_or_new(ax)
    for (v, y), style in zip(heave.items(), LINES):
        ax.plot(X, 1000 * y, ls=style, label=f"v = {v:g} m/s")
    ax.set(xlabel="position $X$ (m)", ylabel=r"$Y - Y_\mathrm{eq}$ (mm)")
    ax.legend()
    return ax


def plot_seen_mode(dts, seen, true, figure):
    """Frequency and damping that methods give a mode, against the step; two panels.

    Parameters
    ----------
    dts : array_like, shape (n,)
        Time steps, s.
    seen : dict of str to array_like of complex, shape (n,)
        Eigenvalue that each method's runs show, 1/s (`suspension.accuracy.seen_mode`).
    true : complex
        Eigenvalue of the mode, 1/s, with a positive imaginary part.
    """
    left, right = figure.subplots(1, 2, gridspec_kw={"wspace": 0.08})
    for (name, value), style in zip(seen.items(), LINES):
        left.semilogx(dts, value.imag / true.imag, ls=style, label=name)
        right.semilogx(dts, -value.real / np.abs(value), ls=style)
    nyquist = np.pi / (np.asarray(dts) * true.imag)
    left.semilogx(dts, nyquist, color="k", lw=0.8, label="Nyquist")
    right.axhline(-true.real / abs(true), color="k", lw=0.6)
    left.set(ylabel="frequency, computed / true", ylim=(0, 2))
    right.set(ylabel="damping ratio", ylim=(-0.3, 0.6))
    for ax in (left, right):
        ax.set(xlabel=r"$\Delta t$ (s)", xlim=(dts[0], dts[-1]))
    figure.legend(loc="outside upper center", ncols=3)
    return left, right


def plot_missed_dip(T, N, steps, forces, axes):
    """A dip below zero between two steps of an adaptive integrator: overview and close-up.

    Parameters
    ----------
    T, N : array_like, shape (n,)
        Exact force of one wheel.
    steps, forces : array_like, shape (m,)
        Where the integrator stopped, and the force there.
    axes : two Axes
    """
    dip = np.argmin(N)
    after = min(np.searchsorted(steps, T[dip]), len(steps) - 1)
    for ax in axes:
        ax.axhline(0, color="0.3", lw=0.8)
        ax.plot(T, N, label="exact force")
        ax.plot(steps, forces, "o", color="C1", label="steps of the integrator")
        ax.set(xlabel="time $t$ (s)", ylabel="normal force (N)")
    axes[1].set(xlim=(steps[after - 1] - 0.002, steps[after] + 0.002))
    near = np.abs(T - T[dip]) < steps[after] - steps[after - 1]
    axes[1].set(ylim=(1.5 * N[dip] - 0.02, N[near].max()))
    axes[0].legend()
    return axes
