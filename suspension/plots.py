"""Figures of Parts I to III: each function draws what it is given and returns its axes."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Ellipse, Rectangle
from scipy import stats

from suspension.report import WHEEL

__all__ = [
    "plot_confidence_region",
    "plot_fit",
    "plot_forces",
    "plot_growth",
    "plot_residuals",
    "plot_stability",
]

MARKERS = "o^sDvPX*"


def _axes(ax):
    return plt.subplots()[1] if ax is None else ax


def plot_fit(fit, data, level=0.95, ax=None):
    """Data, best fit and the pointwise confidence band of the mean force.

    Parameters
    ----------
    fit : SpringFit
    data : DataFrame
        Columns `delta_over_delta_max` and `force`.
    level : float
        Confidence level of the band.
    """
    ax = _axes(ax)
    x = np.linspace(0, data["delta_over_delta_max"].max(), 201)
    mean = fit.results.get_prediction(np.vander(x, 3, increasing=True))
    low, high = mean.conf_int(alpha=1 - level).T
    ax.fill_between(
        x, low, high, color="C5", alpha=0.5, lw=0, label=f"{level:.0%} band of the mean"
    )
    ax.plot(x, mean.predicted, color="C0", label="least-squares fit")
    ax.plot(data["delta_over_delta_max"], data["force"], "o", color="C1", mfc="none", label="data")
    ax.set(xlabel=r"$\delta/\delta_{\max}$", ylabel="force $F$ (N)")
    ax.legend()
    return ax


def plot_residuals(fit, data, axes):
    """Residuals against displacement, and their normal quantile plot; `axes` are two."""
    residuals = np.asarray(fit.results.resid)
    axes[0].axhline(0, color="0.5", lw=0.8)
    axes[0].vlines(data["delta_over_delta_max"], 0, residuals, color="C0", lw=1)
    axes[0].plot(data["delta_over_delta_max"], residuals, "o", color="C0")
    axes[0].set(xlabel=r"$\delta/\delta_{\max}$", ylabel="residual (N)")
    (theory, ordered), (slope, intercept, _) = stats.probplot(residuals)
    axes[1].plot(theory, intercept + slope * theory, color="0.5", lw=0.8)
    axes[1].plot(theory, ordered, "o", color="C0")
    axes[1].set(xlabel="normal quantile", ylabel="ordered residual (N)")
    return axes


def plot_confidence_region(fit, i=0, j=2, level=0.95, ax=None):
    """Joint confidence ellipse of two coefficients, with the boxes that joint intervals make.

    The ellipse is the set ``(b - beta)^T V^-1 (b - beta) <= 2 F^-1(level; 2, m - 3)``, V the
    estimated covariance; the p = 2 box is its bounding box.
    """
    ax = _axes(ax)
    V = np.asarray(fit.results.cov_params())[np.ix_([i, j], [i, j])]
    sizes, axes = np.linalg.eigh(V)
    width, height = 2 * fit.width(level, "scheffe", 2) * np.sqrt(sizes)
    angle = np.degrees(np.arctan2(axes[1, 0], axes[0, 0]))
    centre = fit.beta[[i, j]]
    ax.add_patch(Ellipse(centre, width, height, angle=angle, fc="C5", alpha=0.35))
    ax.add_patch(
        Ellipse(centre, width, height, angle=angle, fc="none", ec="C0", lw=1.6, label="ellipse")
    )
    boxes = [
        ("joint, $p = 3$", "scheffe", 3, "-"),
        ("joint, $p = 2$", "scheffe", 2, "--"),
        ("Bonferroni", "bonferroni", 2, "-."),
        ("one at a time", "individual", 1, ":"),
    ]
    for k, (label, method, p, style) in enumerate(boxes):
        (x0, x1), (y0, y1) = fit.intervals(level, method, p)[[i, j]]
        ax.add_patch(
            Rectangle((x0, y0), x1 - x0, y1 - y0, fc="none", ec=f"C{k + 1}", ls=style, label=label)
        )
    ax.plot(*centre, "+", color="C0", ms=9)
    ax.plot(0, 0, "ko", label="linear spring, (0, 0)")
    ax.set(xlabel=rf"$\beta_{i}$ (N)", ylabel=rf"$\beta_{j}$ (N)")
    ax.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    ax.autoscale_view()
    return ax


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
    ax = _axes(ax)
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


def plot_forces(trajectory, ax=None):
    """Normal forces against time; what comes after a loss of contact is greyed out."""
    ax = _axes(ax)
    T, N, loss = trajectory.T, trajectory.N, trajectory.loss
    ax.axhline(0, color="0.3", lw=0.8)
    ax.plot(T, N[0], color="C0", label="$N_1$, rear")
    ax.plot(T, N[1], "--", color="C1", label="$N_2$, front")
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


def plot_growth(amplitude, growth, ax=None):
    """Amplitude of each mode step by step, beside the growth ``|R(lambda dt)|^n`` predicted.

    Parameters
    ----------
    amplitude : array_like, shape (n, J+1)
        Modulus of the modal coordinates of a run.
    growth : array_like, shape (n,)
        Predicted growth per step.
    """
    ax = _axes(ax)
    n = np.arange(np.shape(amplitude)[1])
    for k, (a, r) in enumerate(zip(amplitude, growth)):
        ax.semilogy(n, a, MARKERS[k], color=f"C{k}", mfc="none", label=f"mode {k + 1}, computed")
        ax.semilogy(n, a[0] * r**n, color=f"C{k}", lw=1, label=rf"$|R|^n$, $|R|$ = {r:.3g}")
    ax.set(xlabel="step $n$", ylabel="amplitude of the mode")
    ax.legend()
    return ax
