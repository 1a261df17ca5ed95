"""Tables in Markdown and two figures from the results, for the terminal and for the book."""

import re
from pathlib import Path

import matplotlib.pyplot as plt

from suspension.figures.layout import narrow
from suspension.report import table
from suspension.report.words import number, percent, quantity

ROOT = Path(__file__).parents[1]
TABLES = Path(__file__).with_name("results.md")
FIGURES = ROOT / "book/figures"
OURS = {"simulate", "closed form", "sweep", "drive"}


def write(results):
    """Write the tables and the figures; return the tables, which say it all."""
    sections = {
        "machine": _machine(results["machine"]),
        "work-a": _work_a(results["a"]),
        "work-b": _work_b(results["b"]),
        "work-c": _work_c(results["c"]),
        "work-d": _work_d(results["d"]),
        "work-e": _work_e(results["e"]),
        "parts": _parts(results),
        "book": _book(results.get("book")),
    }
    text = "\n\n".join(
        f"<!-- {name} -->\n\n{text}\n\n<!-- end {name} -->" for name, text in sections.items()
    )
    TABLES.write_text(text + "\n", encoding="utf-8")
    plt.style.use("suspension.figures.report")
    plt.rcParams.update({"svg.hashsalt": "speed", "svg.fonttype": "path"})
    for name, draw in (("speed-work", _draw_work), ("speed-steps", _draw_steps)):
        figure = draw(results)
        figure.savefig(FIGURES / f"{name}.svg", metadata={"Date": None})
        narrow(figure).savefig(FIGURES / f"{name}.narrow.svg", metadata={"Date": None})
        plt.close(figure)
    return re.sub(r"<!-- .* -->\n*", "", text)


def _time(seconds):
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size or unit == "µs":
            return quantity(seconds / size, unit)


def _ratio(x):
    return f"{float(f'{x:.2g}'):,g}"


def _error(x):
    return number(x, 2) if x else "reference"


def _name(name):
    return f"**{name}**" if name in OURS else name


def _machine(machine):
    versions = ", ".join(f"{name} {version}" for name, version in machine["versions"].items())
    return (
        f"Measured on {machine['date']} on one core of a machine with {machine['cores']} "
        f"({machine['processor']}, {machine['system']}), with Python {machine['python']}, "
        f"{versions}."
    )


def _work_a(rows):
    unit = next(row["seconds"] for row in rows if row["name"] == "simulate")
    return table(
        [
            {
                "what computes it": _name(row["name"]),
                "time": _time(row["seconds"]),
                "in units of `simulate`": _ratio(row["seconds"] / unit),
                "first call": _time(row["first"]),
                "error (N)": _error(row["error"]),
            }
            for row in sorted(rows, key=lambda row: row["seconds"])
        ]
    )


def _work_b(work):
    seconds = work["seconds"]
    rows = []
    for name, times in seconds.items():
        row = {"ns per step": _name(name)}
        for J in seconds["simulate"]:
            row[f"{int(J):,} steps"] = f"{1e9 * times[J] / int(J):,.0f}" if J in times else "–"
        rows.append(row)
    return (
        f"{table(rows)}\n\nAt its peak `simulate` holds {work['memory']:.2f} times the memory of "
        "the arrays that it returns."
    )


def _work_c(work):
    return table(
        [
            {"what computes it": _name(name), "per step and case": quantity(ns, "ns")}
            for name, ns in work.items()
        ]
    )


def _work_d(rows):
    return table(
        [
            {
                "what computes it": _name(row["name"]),
                "with": re.sub(r"1e-0?(\d+)", r"$10^{-\1}$", row["setting"]),
                "time": _time(row["seconds"]) if row["seconds"] else "not reached",
                "error (N)": _error(row["error"]),
            }
            for row in sorted(rows, key=lambda row: row["seconds"] or float("inf"))
        ]
    )


def _work_e(rows):
    return table(
        [
            {
                "what computes it": _name(row["name"]),
                "per run": _time(row["seconds"]),
                "largest deviation": percent(row["error"]) if row["error"] else "reference",
            }
            for row in rows
        ]
    )


def _parts(results):
    ns = results["parts"]
    if "solve" not in ns:  # measured before the time loop was a banded solve
        return "Not measured here."
    known = ns["road"] + ns["solve"] + ns["memory"]
    floor = ns["exponential"] + ns["solve"] + ns["memory"]
    loop = next(row["seconds"] for row in results["a"] if row["name"] == "textbook RK4")
    parts = {
        "exponentials, four a step": ns["exponential"],
        "the rest of the road: from positions to slopes": ns["road"] - ns["exponential"],
        "the banded solve, which is the time loop": ns["solve"],
        "writing times, states and forces": ns["memory"],
        "inputs of the steps, forces, checks, and Python's share": ns["whole"] - known,
        "**all of `simulate`**": ns["whole"],
    }
    rows = [{"part": part, "ns per step": f"{time:.1f}"} for part, time in parts.items()]
    return (
        f"{table(rows)}\n\nThe floor for this formulation, exponentials, solve and writing and "
        f"nothing else, is {floor:.0f} ns a step: `simulate` takes {ns['whole'] / floor:.1f} "
        f"times that. The textbook loop spends {1e6 * loop / 5000:.0f} µs a step."
    )


def _book(book):
    if not book:
        return "Not measured here."
    waited = {
        "building the book, from nothing": book["cold"],
        "building it again": book["warm"],
        "`make test`, which builds it too": book["tests"],
    }
    rows = [{"what is waited for": what, "time": _time(s)} for what, s in waited.items()]
    lines = [line.replace("<=", "≤") for line in book["explorer"]]
    explorer = ["The explorer in headless Chromium:", "", "```text", *lines, "```"]
    return "\n".join([table(rows), "", *explorer])


def _draw_work(results):
    rows = sorted(results["a"], key=lambda row: -row["seconds"])
    figure, ax = plt.subplots(figsize=(7.2, 4.2))
    ms = [1e3 * row["seconds"] for row in rows]
    colors = ["C0" if row["name"] in OURS else "#999999" for row in rows]
    ax.barh([row["name"] for row in rows], ms, color=colors, height=0.7)
    for i, (row, x) in enumerate(zip(rows, ms)):
        ax.text(x * 1.15, i, _time(row["seconds"]), va="center", fontsize=8)
    ax.set(xscale="log", xlim=(min(ms) / 2, max(ms) * 4), xlabel="time (ms)")
    ax.grid(axis="y", visible=False)
    ax.minorticks_off()
    ax.tick_params(axis="y", length=0)
    return figure


def _draw_steps(results):
    figure, ax = plt.subplots()
    styles = zip(("o-", "s--", "^-.", "v:"), ("C0", "C1", "C2", "C6"))
    below = {"Numba, the recurrence", "textbook RK4"}
    for (name, times), (style, color) in zip(results["b"]["seconds"].items(), styles):
        steps = [int(J) for J in times]
        ns = [1e9 * times[str(J)] / J for J in steps]
        ax.plot(steps, ns, style, color=color)
        ax.annotate(
            name,
            (steps[-1], ns[-1]),
            xytext=(4, -14 if name in below else 14),
            ha="right",
            va="center",
            textcoords="offset points",
            color=color,
        )
    ax.set(xscale="log", yscale="log", xlim=(70, 2e6), xlabel="steps", ylabel="time per step (ns)")
    ax.set(ylim=(20, None))
    ax.minorticks_off()
    return figure
