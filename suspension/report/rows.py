"""Rows of the report's tables, a dict each, and a Markdown table made from them."""

import math

import numpy as np

from suspension.forces import WHEEL
from suspension.report.words import ROUNDOFF, SPACE, fixed, number, seconds

__all__ = [
    "SYMBOLS",
    "error_rows",
    "facts",
    "matrix_rows",
    "mode_name",
    "mode_rows",
    "stability_rows",
    "table",
    "verdict",
]

SYMBOLS = {
    "g": ("$g$", "m/s²", "gravity"),
    "m": ("$m$", "kg", "mass of the half-robot"),
    "Izz": ("$I_{zz}$", "kg m²", "its moment of inertia about the centre of mass"),
    "L1": ("$L_1$", "m", "centre of mass to rear wheel"),
    "L2": ("$L_2$", "m", "centre of mass to front wheel"),
    "c1": ("$c_1$", "N s/m", "rear pair of dampers"),
    "c2": ("$c_2$", "N s/m", "front pair of dampers"),
    "k1": ("$k_1$", "N/m", "rear pair of springs"),
    "k2": ("$k_2$", "N/m", "front pair of springs"),
    "height": ("$h_0$", "m", "height of the bump"),
    "sigma": (r"$\sigma$", "m", "its width"),
    "centre": ("$x_0$", "m", "place of its top"),
}
NUMERIC_START = set("0123456789-−+–<>")  # how a number begins; a dash stands for none


def table(rows):
    """A Markdown table from a list of dicts; columns of numbers are set to the right.

    >>> print(table([{"scheme": "Euler", "error": "−0.2"}]))
    | scheme | error |
    |:--|--:|
    | Euler | −0.2 |
    """
    names = list(rows[0])
    cells = [[str(row[name]) for name in names] for row in rows]
    numeric = [all(cell[:1] in NUMERIC_START for cell in column) for column in zip(*cells)]
    rule = "|" + "|".join("--:" if right else ":--" for right in numeric) + "|"
    head, *body = ["| " + " | ".join(line) + " |" for line in [names, *cells]]
    return "\n".join([head, rule, *body])


def verdict(run, compression=None):
    """One row of a verdict table: kept or lost, where, each wheel's least force, and the spring.

    Parameters
    ----------
    run : Trajectory
    compression : float, optional
        Largest compression of a spring while both wheels press, over delta_max.
    """
    loss = run.loss
    row = {
        "v (m/s)": f"{run.v:g}",
        "contact": "lost" if loss else "kept",
        "wheel": WHEEL[loss.wheel] if loss else "–",
        "at t (s)": seconds(loss.t, run.dt) if loss else "–",
        "at X (m)": _place(run.v * loss.t, run.v * run.dt) if loss else "–",
        "least $N_1$ (N)": _least(run, 0),
        "least $N_2$ (N)": _least(run, 1),
    }
    if compression is None:
        return row
    return row | {r"largest $\delta/\delta_{\max}$": fixed(compression, 2)}


def _place(x, spacing):
    """A place read from samples, no finer than they are: 1.2 mm apart, in whole millimetres."""
    return fixed(x, max(0, math.ceil(-math.log10(spacing) - ROUNDOFF)))


def _least(run, wheel):
    """The least force of a wheel, and whether it comes before or after the first loss.

    After it, the ground of the linear model pulls: what is left of the number is its sign.
    """
    N = run.N[wheel]
    least, loss = N.min(), run.loss
    if loss is None:
        return fixed(least, 2)
    t = run.T[N.argmin()]
    if t < loss.t:
        return f"{fixed(least, 2)} (before)"
    sign = "< 0" if least < 0 else "> 0" if least > 0 else "0"
    return f"{sign} ({'at the loss' if t == loss.t else 'after'})"


def facts(values):
    """What a robot or a bump is made of, a row for each parameter; `values` by name, SI units."""
    return [
        {"symbol": symbol, "value": f"{_given(values[name])}{SPACE}{unit}", "meaning": meaning}
        for name, (symbol, unit, meaning) in SYMBOLS.items()
        if name in values
    ]


def _given(x):
    """A number as it was given, or in four digits if that would need more than six."""
    if x == float(f"{x:.6g}") and (x == 0 or 1e-4 <= abs(x) < 1e6):
        return f"{x:.6g}".replace("-", "−")
    return number(x, 4)


def matrix_rows(A):
    """The entries of a matrix, each under its row and column."""
    return [
        {"$A_{ij}$": f"${{i = {i}}}$", **{f"$j = {j}$": _entry(a) for j, a in enumerate(row, 1)}}
        for i, row in enumerate(np.asarray(A), 1)
    ]


def _entry(a):
    return f"{a:.0f}" if a in (0, 1) else number(a, 6)


def mode_name(robot, k):
    """Whether mode `k`, counted from 0, is more of a heave or of a pitch."""
    return "heave" if robot.heave_share[k] > 0.5 else "pitch"


def mode_rows(robot):
    """Eigenvalues with what they mean: heave or pitch, natural frequency, damping ratio.

    Frequency and damping ratio belong to a conjugate pair; a real eigenvalue, of an overdamped
    mode, has neither by itself.
    """
    return [
        {
            "$k$": k + 1,
            r"$\lambda_k$ (1/s)": _complex(z),
            "mode": mode_name(robot, k),
            "natural frequency (Hz)": fixed(abs(z) / (2 * np.pi), 3) if z.imag else "–",
            "damping ratio": fixed(-z.real / abs(z), 4) if z.imag else "–",
        }
        for k, z in enumerate(robot.eigenvalues)
    ]


def _complex(z):
    sign = "−" if z.imag < 0 else "+"
    return f"{fixed(z.real, 4)}{SPACE}{sign}{SPACE}{fixed(abs(z.imag), 4)}i"


def stability_rows(scheme, eigenvalues, dts):
    """Growth of the fastest-growing mode per step, and whether the step is absolutely stable."""
    growth = [np.abs(scheme.stability_function(eigenvalues * dt)).max() for dt in dts]
    return [
        {
            r"$\Delta t$ (s)": f"{dt:g}",
            r"$\max_k \lvert R(\lambda_k\Delta t)\rvert$": _growth(r),
            "absolutely": "**stable**" if scheme.is_stable(eigenvalues, dt) else "**unstable**",
        }
        for dt, r in zip(dts, growth)
    ]


def _growth(r):
    """Growth per step in four digits, or in more if these hide on which side of 1 it is."""
    digits = next((n for n in (4, 6, 9) if float(f"{r:.{n - 1}e}") != 1), 4)
    return number(r, digits)


def error_rows(runs, theta):
    """Final pitch of each run beside the exact one, `theta` in rad."""
    return [
        {
            r"$\Delta t$ (s)": f"{run.dt:g}",
            r"exact $\theta(t_\text{final})$": fixed(theta, 10),
            r"computed $\tilde\theta(t_\text{final})$": _pitch(run.W[2, -1]),
            r"$\lvert\theta - \tilde\theta\rvert$": _error(run.W[2, -1] - theta),
        }
        for run in runs
    ]


def _pitch(theta):
    if not math.isfinite(theta):
        return "–"
    return fixed(theta, 10) if abs(theta) < 10 else number(theta, 4)


def _error(difference):
    return number(abs(difference), 3) if math.isfinite(difference) else "> 10³⁰⁸"
