"""Figures of absolute stability: a method's region with the modes in it, and how they grow."""

import numpy as np

from suspension.figures.style import MARKERS, axes_or_new

__all__ = ["plot_growth", "plot_stability"]


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
    x, y = np.linspace(*window[:2], 481), np.linspace(*window[2:], 481)
    growth = np.abs(scheme.stability_function(x + 1j * y[:, None]))
    ax.contourf(x, y, growth, levels=[0, 1], colors=["#cfe6f5"])
    curve = scheme.boundary(4000)
    ax.plot(*curve.T, color="C0", lw=1.4, label=r"$|R(z)| = 1$")
    ax.axhline(0, color="0.6", lw=0.6)
    ax.axvline(0, color="0.6", lw=0.6)
    for k, dt in enumerate(dts):
        z = np.asarray(eigenvalues) * dt
        verdict = "stable" if scheme.is_stable(eigenvalues, dt) else "unstable"
        ax.plot(z.real, z.imag, MARKERS[k], color=f"C{k + 1}", mfc="none", mew=1.5, ms=7,
                label=rf"$\lambda_k\Delta t$, $\Delta t = {dt:g}$ s: {verdict}")  # fmt: skip
    ax.set(xlim=window[:2], ylim=window[2:], aspect="equal", title=scheme.name)
    ax.set(xlabel=r"Re $z$", ylabel=r"Im $z$")
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    return ax


def plot_growth(amplitude, growth, ax=None):
    """Amplitude of each mode step by step, beside the growth ``|R(lambda dt)|^n`` predicted.

    Parameters
    ----------
    amplitude : array_like, shape (n, J+1)
        Modulus of the modal coordinates of a run.
    growth : array_like, shape (n,)
        Predicted growth per step.
    """
    ax = axes_or_new(ax)
    n = np.arange(np.shape(amplitude)[1])
    for k, (a, r) in enumerate(zip(amplitude, growth)):
        ax.semilogy(n, a, MARKERS[k], color=f"C{k}", mfc="none", label=f"mode {k + 1}, computed")
        ax.semilogy(n, a[0] * r**n, color=f"C{k}", lw=1, label=rf"$|R|^n$, $|R|$ = {r:.3g}")
    ax.set(xlabel="step $n$", ylabel="amplitude of the mode")
    ax.legend()
    return ax
