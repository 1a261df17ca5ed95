"""Figures of absolute stability: a method's region with the modes in it, and how they grow."""

import numpy as np

from suspension.figures.style import FIELDS, MARKERS, axes_or_new

__all__ = ["plot_growth", "plot_near_zero", "plot_stability"]


def plot_stability(scheme, eigenvalues, dts, window=(-6, 6, -9, 9), ax=None):
    """The region of absolute stability with the points ``lambda dt``, a symbol for every step.

    Parameters
    ----------
    scheme : Scheme
    eigenvalues : array_like, shape (n,)
        1/s.
    dts : sequence of float
        Time steps, s.
    window : tuple
        Left, right, bottom and top of the picture.
    """
    ax = axes_or_new(ax)
    points = [np.asarray(eigenvalues) * dt for dt in dts]
    draw_region(ax, scheme, window)
    for k, (z, dt) in enumerate(zip(points, dts)):
        verdict = "stable" if scheme.is_stable(eigenvalues, dt) else "unstable"
        label = rf"$\lambda_k\Delta t$, $\Delta t = {dt:g}$ s: {verdict}"
        _draw_points(ax, z, k, label)
    ax.set(aspect="equal", title=scheme.name, xlabel=r"Re $z$", ylabel=r"Im $z$")
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    return ax


def plot_near_zero(scheme, eigenvalues, dts, ax):
    """Enlarge the points of the smallest step in an inset beside a diagram of `plot_stability`.

    Parameters
    ----------
    scheme, eigenvalues, dts
        As in `plot_stability`.
    ax : Axes
        That of the diagram.
    """
    smallest = int(np.argmin(dts))
    z = np.asarray(eigenvalues) * dts[smallest]
    height = 1.4 * max(np.abs(z.imag).max(), 0.1 * np.abs(z.real).max())  # all may be real
    width = 3 * max(np.abs(z.real).max(), 0.01 * height)  # wider, to tell points from the axis
    right, bottom, top = ax.get_xlim()[1], *ax.get_ylim()
    place = [right + 5, bottom, 0.55 * (top - bottom), 0.6 * (top - bottom)]
    inset = ax.inset_axes(place, transform=ax.transData)
    draw_region(inset, scheme, (-width, width, -height, height))
    _draw_points(inset, z, smallest, None)
    inset.set_title(rf"near zero: $\Delta t = {dts[smallest]:g}$ s", weight="normal", size=8.5)
    inset.locator_params(axis="y", nbins=4)
    tick = float(f"{0.6 * width:.1g}")
    inset.set_xticks([-tick, tick])  # two, which do not run into each other on a phone
    inset.tick_params(labelsize=7.5)
    ax.indicate_inset_zoom(inset, edgecolor="0.4")
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1))
    return inset


def draw_region(ax, scheme, window):
    """Shade where ``|R(z)| <= 1`` in a window (left, right, bottom, top) and draw its border."""
    x, y = np.linspace(*window[:2], 481), np.linspace(*window[2:], 481)
    growth = np.abs(scheme.stability_function(x + 1j * y[:, None]))
    ax.contourf(x, y, growth, levels=[0, 1], colors=[FIELDS["kept"]])
    ax.plot(*scheme.boundary(4000).T, color="C0", lw=1.4, label=r"$|R(z)| = 1$")
    ax.axhline(0, color="0.6", lw=0.6)
    ax.axvline(0, color="0.6", lw=0.6)
    ax.set(xlim=window[:2], ylim=window[2:])


def _draw_points(ax, z, k, label):
    """The points of the k-th step as open symbols of their own."""
    style = {"color": f"C{k + 1}", "mfc": "none", "mew": 1.5, "ms": 7}
    ax.plot(z.real, z.imag, MARKERS[k], label=label, **style)


def plot_growth(amplitude, growth, names, ax=None):
    """Amplitude of each mode step by step, beside the growth ``|R(lambda dt)|^j`` predicted.

    Parameters
    ----------
    amplitude : array_like, shape (n, J+1)
        Modulus of the modal coordinates of a run.
    growth : array_like, shape (n,)
        Predicted growth per step.
    names : sequence of str
        What the modes are called.
    """
    ax = axes_or_new(ax)
    j = np.arange(np.shape(amplitude)[1])
    for k, (a, r, name) in enumerate(zip(amplitude, growth, names)):
        ax.semilogy(j, a, MARKERS[k], color=f"C{k}", mfc="none", label=f"{name}, computed")
        factor = f"{r:.0f}" if r >= 100 else f"{r:.3g}"
        ax.semilogy(j, a[0] * r**j, color=f"C{k}", lw=1, label=rf"$|R|^j$, $|R|$ = {factor}")
    ax.set(xlabel="step $j$", ylabel="amplitude of the mode")
    ax.legend()
    return ax
