"""Tables in Markdown and two figures from the results, for the terminal and for the book."""

import re
from pathlib import Path

import matplotlib.pyplot as plt

ROOT = Path(__file__).parents[1]
TABLES = Path(__file__).with_name("results.md")
FIGURES = ROOT / "book/figures"
OURS = {"simulate", "closed form", "sweep"}


def write(results):
    """Write the tables and the figures; return the tables, which say it all."""
    sections = {
        "machine": _machine(results["machine"]),
        "work-a": _work_a(results["a"]),
        "work-b": _work_b(results["b"]),
        "work-c": _work_c(results["c"]),
        "work-d": _work_d(results["d"]),
        "parts": _parts(results),
        "book": _book(results.get("book")),
    }
    text = "\n\n".join(f"<!-- {name} -->\n\n{text}\n\n<!-- end {name} -->"
                       for name, text in sections.items())  # fmt: skip
    TABLES.write_text(text + "\n")
    plt.style.use(ROOT / "suspension/report.mplstyle")
    plt.rcParams.update({"svg.hashsalt": "speed", "svg.fonttype": "path"})
    for name, draw in (("speed-work", _draw_work), ("speed-steps", _draw_steps)):
        figure = draw(results)
        figure.savefig(FIGURES / f"{name}.svg", metadata={"Date": None})
        plt.close(figure)
    return re.sub(r"<!-- .* -->\n*", "", text)


def _time(seconds):
    for unit, size in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size or unit == "µs":
            return f"{seconds / size:.3g}\N{NO-BREAK SPACE}{unit}"


def _ratio(x):
    return f"{float(f'{x:.2g}'):,g}"


def _power(x):
    mantissa, exponent = f"{x:.1e}".split("e")
    return rf"${mantissa}\cdot10^{{{int(exponent)}}}$"


def _table(head, rows, align):
    rule = "|" + "|".join({"l": ":--", "r": "--:"}[a] for a in align) + "|"
    lines = ["| " + " | ".join(cells) + " |" for cells in [head, *rows]]
    return "\n".join([lines[0], rule, *lines[1:]])


def _name(name):
    return f"**{name}**" if name in OURS else name


def _machine(machine):
    versions = ", ".join(f"{name} {version}" for name, version in machine["versions"].items())
    return (f"Measured on {machine['date']} on one core of a machine with {machine['cores']} "
            f"({machine['processor']}, {machine['system']}), with Python {machine['python']}, "
            f"{versions}.")  # fmt: skip


def _work_a(rows):
    unit = next(row["seconds"] for row in rows if row["name"] == "simulate")
    return _table(
        ["what computes it", "time", "in units of `simulate`", "first call", "error (N)"],
        [[_name(row["name"]), _time(row["seconds"]), _ratio(row["seconds"] / unit),
          _time(row["first"]), _power(row["error"]) if row["error"] else "reference"]
         for row in sorted(rows, key=lambda row: row["seconds"])],
        "lrrrr",
    )  # fmt: skip


def _work_b(work):
    seconds = work["seconds"]
    steps = list(seconds["simulate"])
    rows = [
        [_name(name), *(f"{1e9 * times[J] / int(J):.0f}" if J in times else "–" for J in steps)]
        for name, times in seconds.items()
    ]
    table = _table(["ns per step", *(f"{int(J):,} steps" for J in steps)], rows, "lrrrrr")
    return (f"{table}\n\nAt its peak `simulate` holds {work['memory']:.2f} times the memory of the "
            "arrays that it returns.")  # fmt: skip


def _work_c(work):
    rows = [[_name(name), f"{ns:,.3g} ns"] for name, ns in work.items()]
    return _table(["what computes it", "per step and case"], rows, "lr")


def _work_d(rows):
    rows = sorted(rows, key=lambda row: row["seconds"] or float("inf"))
    return _table(
        ["what computes it", "with", "time", "error (N)"],
        [[_name(row["name"]), re.sub(r"1e-0?(\d+)", r"$10^{-\1}$", row["setting"]),
          _time(row["seconds"]) if row["seconds"] else "not reached",
          _power(row["error"]) if row["error"] else "reference"] for row in rows],
        "llrr",
    )  # fmt: skip


def _parts(results):
    ns = results["parts"]
    glue = ns["recurrence"] - ns["product"]
    rest = ns["whole"] - ns["road"] - ns["recurrence"] - ns["memory"]
    floor = ns["exponential"] + ns["product"] + ns["memory"]
    loop = next(row["seconds"] for row in results["a"] if row["name"] == "textbook RK4")
    rows = [
        ["exponentials, four a step", ns["exponential"]],
        [
            "the rest of the road: positions to slopes, array by array",
            ns["road"] - ns["exponential"],
        ],
        ["one product per block of steps: states and forces", ns["product"]],
        ["joining the blocks, and laying out their inputs", glue],
        ["writing times, states and forces", ns["memory"]],
        ["the road's forces, checks, and Python's share of a run this short", rest],
        ["**all of `simulate`**", ns["whole"]],
    ]
    table = _table(["part", "ns per step"], [[name, f"{x:.1f}"] for name, x in rows], "lr")
    return (f"{table}\n\nThe floor for this formulation, exponentials, product and writing and "
            f"nothing else, is {floor:.0f} ns a step: `simulate` takes {ns['whole'] / floor:.1f} "
            f"times that. Preparing the matrices of a robot, a scheme and a step costs "
            f"{5 * ns['setup']:.0f} µs once. The textbook loop spends {1e6 * loop / 5000:.0f} µs "
            "a step.")  # fmt: skip


def _book(book):
    if not book:
        return "Not measured here."
    seconds = [["building the book, from nothing", book["cold"]],
               ["building it again", book["warm"]],
               ["`make test`, which builds it too", book["tests"]]]  # fmt: skip
    table = _table(["what is waited for", "time"], [[x, _time(s)] for x, s in seconds], "lr")
    return "\n".join([table, "", "The explorer in headless Chromium:", "", "```text",
                      *book["explorer"], "```"])  # fmt: skip


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
    place = {"simulate": 7, "Numba, the recurrence": -7}  # they end close to each other
    for (name, times), (style, color) in zip(results["b"]["seconds"].items(), styles):
        steps = [int(J) for J in times]
        ns = [1e9 * times[str(J)] / J for J in steps]
        ax.plot(steps, ns, style, color=color)
        ax.annotate(name, (steps[-1], ns[-1]), xytext=(8, place.get(name, 0)), va="center",
                    textcoords="offset points", color=color)  # fmt: skip
    ax.set(xscale="log", yscale="log", xlim=(70, 6e7), xlabel="steps", ylabel="time per step (ns)")
    ax.minorticks_off()
    return figure
