"""Figures of Part I: the fit, its residuals, and what is known of its coefficients."""

import numpy as np
from matplotlib.patches import Ellipse, Rectangle
from scipy import stats

from suspension.figures.style import axes_or_new

__all__ = ["plot_confidence_region", "plot_experiments", "plot_fit", "plot_residuals"]


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
    ax = axes_or_new(ax)
    x = np.linspace(0, data["delta_over_delta_max"].max(), 201)
    low, high = fit.band(x, level)
    ax.fill_between(
        x, low, high, color="C5", alpha=0.5, lw=0, label=f"{100 * level:g} % band of the mean"
    )
    ax.plot(x, fit.force(x), color="C0", label="least-squares fit")
    ax.plot(data["delta_over_delta_max"], data["force"], "o", color="C1", mfc="none", label="data")
    ax.set(xlabel=r"$\delta/\delta_{\max}$", ylabel="force $F$ (N)")
    ax.legend()
    return ax


def plot_residuals(fit, data, axes):
    """Residuals against displacement, and their normal quantile plot; `axes` are two."""
    residuals = fit.residuals
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
    ax = axes_or_new(ax)
    V = fit.covariance[np.ix_([i, j], [i, j])]
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


def plot_experiments(centres, halves, truth, ax=None):
    """The boxes that repeated experiments draw around their estimates of two coefficients.

    Parameters
    ----------
    centres, halves : array_like, shape (n, 2)
        Estimates of beta0 and beta2, and half-widths of their intervals, N.
    truth : array_like, shape (2,)
        What they estimate; boxes without it are drawn thick.
    """
    ax = axes_or_new(ax)
    for centre, half in zip(centres, halves):
        caught = np.all(np.abs(centre - truth) <= half)
        style = {"ec": "C0", "lw": 0.6, "alpha": 0.35} if caught else {"ec": "C1", "lw": 1.8}
        ax.add_patch(Rectangle(centre - half, *(2 * half), fc="none", **style))
    ax.plot(*truth, "k+", ms=12, mew=2)
    ax.set(xlabel=r"$\beta_0$ (N)", ylabel=r"$\beta_2$ (N)")
    ax.autoscale_view()
    return ax
