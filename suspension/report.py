"""Sentences and tables made from numbers, as Markdown for a notebook and for the book."""

import ast
import inspect

import numpy as np
from IPython.display import Markdown, display

__all__ = [
    "WHEEL",
    "answer",
    "confidence",
    "error_rows",
    "flight_row",
    "join",
    "lost_speeds",
    "matrix_rows",
    "mode_rows",
    "ranges",
    "say",
    "source",
    "stability_rows",
    "table",
    "verdict",
]

WHEEL = {1: "rear", 2: "front"}


def say(*parts, name=None):
    """Show Markdown paragraphs that a computation has filled in.

    With a `name`, other pages of the book can quote them: the metadata is what MyST-NB's
    ``glue()`` writes.
    """
    metadata = {"scrapbook": {"name": name, "mime_prefix": ""}} if name else {}
    display(Markdown("\n\n".join(parts)), metadata=metadata)


def answer(item, *parts):
    """Show the answer to one asked item; other pages quote ``1(ii)`` as ``answer-1-ii``.

    Parameters
    ----------
    item : str
        The problem's own number, ``"1(ii)"``.
    *parts : str
        Markdown paragraphs; the first follows the item's number.
    """
    name = "answer-" + item.replace("(", "-").replace(")", "")
    say(f"**Answer {item}.** {parts[0]}", *parts[1:], name=name)


def source(function):
    """The code of a function as a Markdown block, without its docstring."""
    code = inspect.getsource(function)
    doc = ast.parse(code).body[0].body[0]
    lines = code.splitlines()
    if ast.get_docstring(ast.parse(code).body[0]):
        del lines[doc.lineno - 1 : doc.end_lineno]
    return "\n".join(["```python", *lines, "```"])


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


def join(items, last="and", none="none"):
    """Words in a row: ``a, b and c``.

    >>> join(["1.2", "5", "10"], "or")
    '1.2, 5 or 10'
    """
    items = list(map(str, items))
    if len(items) < 2:
        return items[0] if items else none
    return ", ".join(items[:-1]) + f" {last} " + items[-1]


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


def ranges(edges, lost):
    """Ranges of speed in words, from their edges in m/s and whether contact is lost in each.

    >>> ranges([0.1, 0.4, 30], [False, True])
    'kept up to 0.4 m/s and lost from there on'
    """
    words = []
    for i, gone in enumerate(lost):
        where = f"from {edges[i]:.3g} to {edges[i + 1]:.3g} m/s"
        if len(lost) == 1:
            where = f"at every speed {where}"
        elif i == 0:
            where = f"up to {edges[1]:.3g} m/s"
        elif i == len(lost) - 1:
            where = "from there on"
        words.append(f"{'lost' if gone else 'kept'} {where}")
    return join(words)


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


def confidence(p):
    """A probability as a percentage that never claims certainty.

    >>> confidence(0.5), confidence(1.0)
    ('50.00 %', '> 99.99 %')
    """
    if p < 1e-4:
        return "< 0.01 %"
    return "> 99.99 %" if p > 0.9999 else f"{100 * p:.2f} %"
