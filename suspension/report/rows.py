"""Rows of the report's tables, a dict each, and a Markdown table made from them."""

import numpy as np

from suspension.forces import WHEEL
from suspension.report.words import join

__all__ = [
    "error_rows",
    "flight_row",
    "lost_speeds",
    "matrix_rows",
    "mode_rows",
    "stability_rows",
    "table",
    "verdict",
]


def table(rows):
    """A Markdown table from a list of dicts; columns of numbers are set to the right.

    >>> print(table([{"scheme": "Euler", "error": "-0.2"}]))
    | scheme | error |
    |:--|--:|
    | Euler | -0.2 |
    """
    names = list(rows[0])
    cells = [[str(row[name]) for name in names] for row in rows]
    numeric = [all(cell[:1] in set("0123456789-+–") for cell in column) for column in zip(*cells)]
    rule = "|" + "|".join("--:" if right else ":--" for right in numeric) + "|"
    head, *body = ["| " + " | ".join(line) + " |" for line in [names, *cells]]
    return "\n".join([head, rule, *body])


def verdict(trajectory):
    """One row of a verdict table: speed, kept or lost, which wheel, when, where, and the margin.

    The margin is the smallest sampled normal force.
    """
    loss = trajectory.loss
    return {
        "v (m/s)": f"{trajectory.v:g}",
        "contact": "lost" if loss else "kept",
        "wheel": WHEEL[loss.wheel] if loss else "–",
        "at t (s)": f"{loss.t:.4f}" if loss else "–",
        "at X (m)": f"{trajectory.v * loss.t:.3f}" if loss else "–",
        "smallest force (N)": f"{trajectory.N.min():.2f}",
    }


def lost_speeds(trajectories):
    """The speeds at which contact was lost, in words."""
    speeds = join(f"{run.v:g}" for run in trajectories if run.loss)
    return speeds if speeds == "none" else f"{speeds} m/s"


def matrix_rows(A):
    """The entries of a matrix, each under its row and column."""
    return [
        {"$A_{ij}$": f"$i = {i}$", **{f"$j = {j}$": f"{a:.6g}" for j, a in enumerate(row, 1)}}
        for i, row in enumerate(np.asarray(A) + 0.0, 1)
    ]


def mode_rows(robot):
    """Eigenvalues with what they mean: natural frequency, damping ratio, heave or pitch."""
    rows = []
    for k, (z, w) in enumerate(zip(robot.eigenvalues, robot.eigenvectors.T), 1):
        rows.append(
            {
                "$k$": k,
                r"$\lambda_k$ (1/s)": f"{z:.4f}".replace("j", "i"),
                "mode": "heave" if abs(w[0]) > robot.L2 * abs(w[2]) else "pitch",
                "natural frequency (Hz)": f"{abs(z) / (2 * np.pi):.3f}",
                "damping ratio": f"{-z.real / abs(z):.4f}",
            }
        )
    return rows


def stability_rows(scheme, eigenvalues, dts):
    """Growth of the fastest-growing mode per step, and whether the step is absolutely stable."""
    growth = [np.abs(scheme.stability_function(eigenvalues * dt)).max() for dt in dts]
    return [
        {
            r"$\Delta t$ (s)": f"{dt:g}",
            r"$\max_k \lvert R(\lambda_k\Delta t)\rvert$": f"{r:.6f}",
            "absolutely": "**stable**" if scheme.is_stable(eigenvalues, dt) else "**unstable**",
        }
        for dt, r in zip(dts, growth)
    ]


def error_rows(trajectories, theta):
    """Final pitch of each run beside the exact one, `theta` in rad."""
    return [
        {
            r"$\Delta t$ (s)": f"{run.dt:g}",
            r"exact $\theta(t_\text{final})$": f"{theta:.9f}",
            r"computed $\tilde\theta(t_\text{final})$": f"{run.W[2, -1]:.9g}",
            r"$\lvert\theta - \tilde\theta\rvert$": f"{abs(run.W[2, -1] - theta):.3e}",
        }
        for run in trajectories
    ]


def flight_row(flight, robot):
    """One row of a table of flights: how many, how long, how high, how hard, and settled when."""
    landings = [event for event in flight.events if event.kind == "landing"]
    hardest = max(landings, key=lambda event: event.force, default=None)
    touch_down = f"{hardest.force:.1f} ({WHEEL[hardest.wheel]})" if hardest else "–"
    return {
        "v (m/s)": f"{flight.v:g}",
        "flights": sum(event.kind == "lift-off" for event in flight.events),
        "in the air: rear, front (s)": "{:.3f}, {:.3f}".format(*flight.airtime),
        "highest: rear, front (mm)": "{:.1f}, {:.1f}".format(*1000 * flight.gaps.max(axis=1)),
        "hardest touch-down (N)": touch_down,
        "largest force (N)": f"{flight.N.max():.1f}",
        "settled at (s)": f"{flight.settled(robot):.2f}",
    }
