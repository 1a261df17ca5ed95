"""Sentences, tables and captions of Part VII: the measured spring with its stop.

In all of them a law is called by its name; `runs` and `drawn` hold a `suspension.measured.Drive`
for each law, at the asked speeds and, in `drawn`, for all draws of the coefficients (draw, speed).
The first law is the line.
"""

import numpy as np

from suspension.measured import REACH
from suspension.report.rows import table
from suspension.report.words import (
    SPACE,
    Caption,
    count,
    fixed,
    interval,
    join,
    number,
    percent,
    quantity,
    speed_list,
)
from suspension.schemes import RK4
from suspension.spring_law import linearised, rest

__all__ = [
    "angle_sentence",
    "asked_table",
    "conclusions",
    "cost_sentence",
    "cost_table",
    "critical_table",
    "draws_sentence",
    "law_caption",
    "limit_sentence",
    "limit_table",
    "margins_caption",
    "order_caption",
    "order_sentence",
    "reach_table",
    "regions_caption",
    "run_caption",
    "sign_table",
    "statics_sentence",
    "statics_table",
    "stiffness_caption",
    "stiffness_sentence",
    "survival_sentence",
    "tilted_sentence",
    "verdict_sentence",
    "verdict_table",
]

SAME = 0.1  # critical speeds of two laws nearer than this (relative) are called the same
ROUNDOFF = 1e-9  # N
ALIKE = 0.05  # laws nearer than this part of the largest force hardly differ
KINK = 2.6  # an order below this is that of a kink, with its scatter
SURE = 0.025  # a verdict with a smaller share of doubt is signed


# --- the law, at rest -----------------------------------------------------------------------------


def law_caption(fit, at_rest, farthest):
    """Caption of the laws; displacements at rest and farthest of the line, over delta_max."""
    x = np.linspace(0, 1, 101)
    apart = np.abs(fit.beta[0] + fit.beta[2] * x**2).max() / fit.beta.sum()
    if apart < ALIKE:
        words = "Where it was measured they hardly differ."
    else:
        words = (
            "The line has the parabola's slope at zero and leaves the readings; the others follow "
            "them."
        )
    if farthest > 1:
        words += r" Beyond $\delta_{\max}$ (grey) each is an assumption."
    else:
        words += (
            r" Beyond $\delta_{\max}$ (grey) each is an assumption; the line does not go there."
        )
    text = f"Four laws for one spring. {words}"
    alt = (
        "Force against displacement over delta_max: the readings, a line, the fitted parabola with "
        "its end tangents, and the parabola with a rubber and with a metal stop, which turn up "
        f"steeply at 1, where the parabola is at {number(fit.beta.sum())}{SPACE}N. Marked are the "
        f"displacement at rest, {fixed(at_rest, 2)}, and the farthest that the line is driven to, "
        f"{fixed(farthest, 2)}."
    )
    return Caption(text, alt)


def statics_table(laws, robot):
    """Where the robot rests on each law, what it feels there, and how it swings."""
    rows = []
    for name, law in laws.items():
        tangent = linearised(robot, law)
        heave = np.sqrt(2 * tangent.k1 / robot.m) / (2 * np.pi)
        rows.append(
            {
                "law": name,
                r"at rest, of $\delta_{\max}$": fixed(-rest(robot, law)[0] / law.delta_max, 4),
                "tangent there (N/m)": number(tangent.k1, 4),
                "heave (Hz)": fixed(heave, 3),
            }
        )
    return table(rows)


def statics_sentence(line, law, robot):
    """What preload and curvature do to the rest; `law` is the parabola without a stop."""
    before, after = (-rest(robot, one)[0] / one.delta_max for one in (line, law))
    slopes = [linearised(robot, one).k1 for one in (line, law)]
    change = slopes[1] / slopes[0] - 1
    words = (
        rf"Preload and curvature move the rest from {fixed(before, 4)} to {fixed(after, 4)} of "
        rf"$\delta_{{\max}}$, and the stiffness that small swings feel from "
        f"{number(slopes[0], 4)} to {quantity(slopes[1], 'N/m', 4)}, "
    )
    if abs(change) < 1e-12:
        words += "that is, not at all."
    else:
        words += f"{percent(abs(change))} {'more' if change > 0 else 'less'}."
    if after > 1:
        words += (
            r" **The robot rests beyond $\delta_{\max}$**: with a stop it stands on it, before it "
            "has driven a step."
        )
    return words


# --- verdicts and critical speeds -----------------------------------------------------------------


def verdict_table(asked, runs):
    """Kept, with the least force, or lost, and where: a row for each speed, a column for a law."""
    rows = []
    for i, v in enumerate(asked):
        cells = {name: _cell(run, i) for name, run in runs.items()}
        rows.append({"v (m/s)": f"{v:g}", **cells})
    note = (
        "*Kept* with the least force of both wheels; *lost* with the place $X$ of the body when it "
        "happens."
    )
    return f"{table(rows)}\n\n{note}"


def _cell(run, i):
    if run.margin[i] > 0:
        return f"kept, {fixed(run.margin[i], 2)}{SPACE}N"
    return f"lost, {fixed(run.lost[i], 3)}{SPACE}m"


def _lost(runs):
    """For each law by name whether contact is lost, bool (m,)."""
    return {name: np.asarray(run.margin) <= 0 for name, run in runs.items()}


def verdict_sentence(asked, runs):
    """Which of the asked verdicts do not depend on the law; the first law is the line."""
    lost = _lost(runs)
    line = next(iter(lost))
    same, turned = [], {}
    for i, v in enumerate(asked):
        others = tuple(name for name in lost if lost[name][i] != lost[line][i])
        if others:
            turned.setdefault((bool(lost[line][i]), others), []).append(v)
        else:
            same.append(v)
    words = []
    for (gone, others), speeds in turned.items():
        was, now = ("lost", "kept") if gone else ("kept", "lost")
        words.append(
            f"At {speed_list(speeds)} contact is {was} on the line and **{now}** on: "
            f"{join(others)}."
        )
    if not words:
        return (
            f"At {'all' if len(asked) > 1 else ''} {count(len(asked), 'asked speed')} the verdict "
            "is the same on every law."
        ).replace("  ", " ")
    if same:
        words.insert(0, f"At {speed_list(same)} every law gives the verdict of the line.")
    return " ".join(words)


def angle_sentence(asked, runs, angles):
    """What the true geometry changes; `angles` are the runs without the small angle."""
    lost, tilted = _lost(runs), _lost(angles)
    other = [(v, name) for name in runs for i, v in enumerate(asked)
             if lost[name][i] != tilted[name][i]]  # fmt: skip
    kept = [
        abs(angles[name].margin[i] - runs[name].margin[i])
        for name in runs
        for i in range(len(asked))
        if not lost[name][i] and not tilted[name][i]
    ]
    words = r"With $\sin\theta$ and $\cos\theta$ in place of $\theta$ and 1, "
    if other:
        where = join(f"{v:g}{SPACE}m/s ({name})" for v, name in other)
        words += f"the verdict turns at {where}."
    else:
        words += "no verdict turns."
    if kept:
        words += (
            f" Where contact is kept the margin moves by at most {quantity(max(kept), 'N', 2)}."
        )
    return words


def tilted_sentence(critical, tilted):
    """What the true geometry does to the critical speeds of the parabola, m/s."""
    if len(critical) != len(tilted):
        return (
            rf"With $\sin\theta$ the parabola has {count(len(tilted), 'critical speed')} "
            f"instead of {len(critical)}."
        )
    if not len(critical):
        return r"With $\sin\theta$ the parabola has no critical speed either."
    moved = np.abs(np.asarray(tilted) / critical - 1).max()
    return rf"$\sin\theta$ moves the critical speeds of the parabola by at most {percent(moved)}."


def margins_caption(critical):
    """Caption of the margins; `critical` holds the critical speeds for each law, m/s."""
    each = "; ".join(f"{name}: {speed_list(v, none='none')}" for name, v in critical.items())
    text = (
        "The margin against speed on four laws, cut off where it is far below zero. Symbols: "
        "critical speeds; dotted: the asked speeds. Below zero (shaded) contact is lost."
    )
    alt = (
        "Least normal force against speed on a logarithmic axis, a curve for each of the laws. "
        f"They cross zero at: {each}."
    )
    return Caption(text, alt)


def survival_sentence(critical):
    """Which critical speeds of the line are there on the other laws, and how far they move."""
    names = list(critical)
    line = critical[names[0]]
    if not len(line):
        others = [name for name in names[1:] if len(critical[name])]
        if not others:
            return "The line has no critical speed in the range, and neither has any other law."
        return (
            "The line has no critical speed in the range, but there are some on other laws: "
            f"{join(others)}."
        )
    words = [f"The line has {count(len(line), 'critical speed')}."]
    for name in names[1:]:
        pairs = [(v, _nearest(critical[name], v)) for v in line]
        there = [(v, w) for v, w in pairs if w is not None]
        gone = [v for v, w in pairs if w is None]
        matched = {w for _, w in there}
        new = [w for w in critical[name] if w not in matched]
        parts = []
        if there:
            moved = max(abs(w / v - 1) for v, w in there)
            which = "all of them stay" if not gone else f"{speed_list([v for v, _ in there])} stays"
            which = which.replace("stays", "stay") if len(there) > 1 else which
            shift = f", moved by at most {percent(moved)}" if moved > 1e-9 else ""
            parts.append(which + shift)
        if gone:
            parts.append(f"there is none at {speed_list(gone)}" if there else "none of them stays")
        if new:
            parts.append(f"there are others, at {speed_list(new)}")
        words.append(f"*{name.capitalize()}*: {'; '.join(parts)}.")
    return " ".join(words)


def _nearest(speeds, v):
    """The one nearest to `v`, None if it is not the same within `SAME`."""
    near = [w for w in speeds if abs(np.log(w / v)) < SAME]
    return min(near, key=lambda w: abs(np.log(w / v)), default=None)


def reach_table(asked, heights, linear, runs, delta_max):
    """What the linearisation is wrong by when the bump grows.

    Parameters
    ----------
    heights : sequence of float
        Of the bump, m.
    linear, runs : sequence of Drive
        For each height, of the tangent at rest and of the law itself.
    """
    rows = []
    for height, one, other in zip(heights, linear, runs):
        cells = {}
        for i, v in enumerate(asked):
            mark = "*" if other.compression[i] > delta_max else ""
            wrong = (one.margin[i] > 0) != (other.margin[i] > 0)
            error = one.margin[i] - other.margin[i]
            error = number(error, 2) if abs(error) > ROUNDOFF else "0"
            cells[f"{v:g} m/s"] = error + mark + (" (**another verdict**)" if wrong else "")
        rows.append({"bump (mm)": fixed(1000 * height, 1), **cells})
    note = (
        "Margin of the linear robot (the tangent at rest) minus that of the law, in N. An "
        "asterisk: a spring is on its stop at some moment before any loss of contact."
    )
    return f"{table(rows)}\n\n{note}"


def run_caption(v, shown, delta_max):
    """Caption of the runs at `v` in m/s; `shown` as `plot_measured_run` takes it."""
    each = "; ".join(
        f"{name}: up to {fixed(np.max(p) / delta_max, 2)}, drawn to X = {fixed(X[-1], 3)}{SPACE}m"
        for name, (X, p, _) in shown.items()
    )
    text = (
        f"Front spring and front wheel at {v:g}{SPACE}m/s. The stop begins at the line at 1. Each "
        "curve ends where a wheel leaves the ground, or at the end of the figure. The force is "
        f"drawn linearly up to 10{SPACE}N, logarithmically beyond."
    )
    alt = (
        "Two panels against position: compression of the front spring over delta_max, and normal "
        f"force of the front wheel. {each}."
    )
    return Caption(text, alt)


def stiffness_caption(ratio, margins):
    """Caption of the margin over the stiffness of the stop."""
    text = (
        "The margin at the asked speeds against the stiffness of the stop, from a tenth of the "
        "spring's to ten thousand times as stiff. Dotted: the two stops of this part. The axis "
        "of the force is linear up to 10 N, logarithmic beyond."
    )
    each = join(
        f"from {number(m[0], 2)} to {number(m[-1], 2)}{SPACE}N at {v:g}{SPACE}m/s"
        for v, m in margins.items()
    )
    alt = (
        f"Least normal force against stop stiffness, {number(ratio[0], 2)} to "
        f"{number(ratio[-1], 2)} times that of the spring: {each}."
    )
    return Caption(text, alt)


def stiffness_sentence(ratio, margins):
    """Whether the verdict depends on how stiff the stop is."""
    ratio = np.asarray(ratio)
    turns, steady = [], []
    for v, margin in margins.items():
        flips = ratio[1:][np.diff(np.sign(margin)) != 0]
        if len(flips):
            turns.append((v, flips))
        else:
            steady.append(v)
    words = []
    if steady:
        words.append(
            f"At {speed_list(steady)} the verdict is the same for every stop of this range: its "
            "stiffness need not be known."
        )
    for v, flips in turns:
        words.append(
            f"At {speed_list([v])} it turns near {join(number(r, 2) for r in flips)} times the "
            "stiffness of the spring."
        )
    return " ".join(words)


# --- what a stop costs ----------------------------------------------------------------------------


def limit_table(eigenvalues, dt):
    """Fastest eigenvalue on each law, the longest stable step of RK4, and whether `dt` is one."""
    rows = []
    for name, values in eigenvalues.items():
        rows.append(
            {
                "law": name,
                r"$\max\lvert\lambda\rvert$ (1/s)": number(np.abs(values).max(), 3),
                r"longest stable $\Delta t$ of RK4 (ms)": number(
                    1000 * RK4.max_stable_dt(values), 3
                ),
                rf"$\Delta t$ = {dt:g}{SPACE}s": "**stable**"
                if RK4.is_stable(values, dt)
                else "**unstable**",
            }
        )
    return table(rows)


def limit_sentence(eigenvalues, dt):
    """How the stop shortens the step; the first law has none, the last has the stiffest."""
    names = list(eigenvalues)
    longest = {name: RK4.max_stable_dt(values) for name, values in eigenvalues.items()}
    factor = longest[names[0]] / longest[names[-1]]
    words = (
        f"The stiffest of these stops shortens the longest stable step {number(factor, 2)} times, "
        r"like $\sqrt{k_\mathrm{s}/k}$."
    )
    bad = [name for name in names if longest[name] < dt]
    if not bad:
        return f"{words} The problem's {dt:g}{SPACE}s is stable on all of them."
    return f"{words} The problem's {dt:g}{SPACE}s is no longer stable on: {join(bad)}."


def regions_caption(eigenvalues, dts):
    """Caption of the stability diagram with the eigenvalues on and off the stop."""
    each = "; ".join(
        f"{name} at {dt:g} s {'stable' if RK4.is_stable(values, dt) else 'unstable'}"
        for dt in dts
        for name, values in eigenvalues.items()
    )
    text = (
        r"The diagram of Question 7 once more: the same method, other eigenvalues. On the stop "
        r"$\lambda\Delta t$ grows along the imaginary axis."
    )
    alt = f"Region of absolute stability of RK4 with the points lambda dt of each law: {each}."
    return Caption(text, alt)


def order_caption(v, orders):
    """Caption of the error of RK4 on each law, with the observed orders."""
    each = join(f"{name} {fixed(order, 1)}" for name, order in orders.items())
    return Caption(
        f"RK4 at {v:g}{SPACE}m/s until the body is over the bump: error beside Radau, which stops "
        "at every switch.",
        f"Error against time step on logarithmic axes; observed slopes: {each}.",
    )


def order_sentence(orders):
    """What the stop does to the order; `orders` by law, without a stop first."""
    if not orders:
        return "The errors are too small, beside those of Radau, to show an order."
    each = join(f"{fixed(order, 1)} ({name})" for name, order in orders.items())
    words = f"Observed orders: {each}."
    if max(orders.values()) < KINK:
        return (
            f"{words} On the stop the order is [that of a kink](06-flight.ipynb#one-bad-step), two."
        )
    first, *others = orders.values()
    if first > KINK > max(others, default=first):
        return (
            f"{words} A stop is a kink of the force, and a kink costs RK4 its order: "
            "[two is what is left](06-flight.ipynb#one-bad-step)."
        )
    return f"{words} With these steps the kink does not show everywhere."


def cost_table(rows):
    """Rows of method, stop, steps, error, evaluations and solves as a table."""
    return table(
        [
            {
                "method": row["method"],
                "stop, of $k$": _times(row["stop"]),
                "steps": row["steps"],
                "evaluations": row["evaluations"],
                "linear systems": row["solves"],
                "relative error": _error(row),
            }
            for row in rows
        ]
    )


def _times(ratio):
    """A power of ten as a factor."""
    return number(ratio, 1 if ratio > 1e4 else 4)


def _error(row):
    if not row["stable"]:
        size = number(row["error"], 1) if np.isfinite(row["error"]) else "overflow"
        return f"{size} (unstable)"
    return number(row["error"], 2)


def cost_sentence(rows):
    """Whether the implicit step is worth its price, stop by stop."""
    words = []
    for stop in dict.fromkeys(row["stop"] for row in rows):
        pairs = {}
        for row in rows:
            if row["stop"] == stop:
                pairs.setdefault(row["steps"], {})[row["method"]] = row
        name = f"With a stop of {_times(stop)} times the spring"
        broken = [J for J, pair in pairs.items() if not pair["RK4"]["stable"]]
        both = [J for J in pairs if J not in broken]
        parts = []
        if broken:
            worst = max(pairs[J]["Crank-Nicolson"]["error"] for J in broken)
            parts.append(
                f"RK4 is unstable with {join(broken)} steps, where Crank-Nicolson stays finite and "
                f"is wrong by up to {percent(worst)}"
            )
        if both:
            better = [
                J for J in both
                if pairs[J]["RK4"]["error"] <= pairs[J]["Crank-Nicolson"]["error"]
            ]  # fmt: skip
            price = np.mean([pairs[J]["Crank-Nicolson"]["solves"] / J for J in both])
            which = f"with {join(better)} steps" if better else "in no stable case"
            parts.append(
                f"RK4 is the more accurate {which}, and Crank-Nicolson solves "
                f"{fixed(price, 1)} linear systems a step"
            )
        words.append(f"{name} {'; '.join(parts)}.")
    return " ".join(words)


# --- how well it is known -------------------------------------------------------------------------


def draws_sentence(kept, drawn, linear):
    """How many coefficients were drawn, and how many of them are those of a spring.

    `linear` says whether the readings do not contradict a line without preload.
    """
    words = f"{drawn} draws of the three coefficients at once"
    if kept == drawn:
        words += "; in every one of them the force grows up to the stop."
    else:
        words += (
            f"; {drawn - kept} are left out because their parabola bends down before "
            r"$\delta_{\max}$, which no spring does: the intervals leave this doubt aside."
        )
    if not linear:
        words += (
            " The readings contradict the line, which is kept here because the problem set asks "
            "for its slope: where it stands alone against the other three, believe those."
        )
    return words


def _share(lost):
    """A share of draws as words that claim no more than so many draws can tell."""
    lost = np.asarray(lost)
    n, found = lost.size, int(lost.sum())
    if found == 0:
        return f"<{SPACE}{number(100 / n, 1)}{SPACE}%"
    if found == n:
        return f">{SPACE}{fixed(100 - 100 / n, 1)}{SPACE}%"
    return percent(found / n)


def _range(values, decimals=2):
    low, high = np.quantile(values, [0.025, 0.975])
    return interval(low, high, decimals=decimals)


def asked_table(asked, runs, drawn):
    """For each asked speed and law the margin, its interval, and the share of draws that lose."""
    rows = []
    for i, v in enumerate(asked):
        together = np.concatenate([drawn[name].margin[:, i] for name in drawn])
        for name in drawn:
            rows.append(
                {
                    "v (m/s)": f"{v:g}",
                    "law": name,
                    "margin (N)": fixed(runs[name].margin[i], 2),
                    "95 % interval (N)": _range(drawn[name].margin[:, i]),
                    "contact lost": _share(drawn[name].margin[:, i] <= 0),
                }
            )
        rows.append(
            {
                "v (m/s)": f"{v:g}",
                "law": "**all, with equal weights**",
                "margin (N)": "–",
                "95 % interval (N)": _range(together),
                "contact lost": f"**{_share(together <= 0)}**",
            }
        )
    return table(rows)


def _share_lost(drawn, i):
    """Share of all draws of all laws that lose contact at the i-th speed, 0 to 1."""
    return float(np.mean([drive.margin[:, i] <= 0 for drive in drawn.values()]))


def sign_table(asked, runs, drawn):
    """The verdicts as an engineer may sign them: parameters, model, both, and the outcome."""
    lost = _lost({name: runs[name] for name in drawn})
    line = next(iter(drawn))
    rows = []
    for i, v in enumerate(asked):
        both = _share_lost(drawn, i)
        alike = sum(lost[name][i] == lost[line][i] for name in drawn)
        rows.append(
            {
                "v (m/s)": f"{v:g}",
                "verdict of the line": "lost" if lost[line][i] else "kept",
                "parameters alone": _share(drawn[line].margin[:, i] <= 0) + " lost",
                "model alone": f"{alike} of {len(drawn)} laws agree",
                "both": _share(np.concatenate([d.margin[:, i] for d in drawn.values()]) <= 0)
                + " lost",
                "signed": _signed(both),
            }
        )
    note = (
        "*Parameters alone*: the share of the draws in which contact is lost on the line. *Model "
        "alone*: at the estimates. *Both*: all draws of all laws, each law with the same weight. "
        "The weights are a judgement, not a measurement. Signed is what at least "
        f"{percent(1 - SURE, 3)} of them say."
    )
    return f"{table(rows)}\n\n{note}"


def _signed(share):
    if share >= 1 - SURE:
        return "**lost**"
    return "**kept**" if share <= SURE else "**open**"


def critical_table(critical, followed):
    """Critical speeds of every law with their intervals, then each speed over all laws.

    Parameters
    ----------
    critical : dict of str to array_like, shape (n,)
        m/s, for each law.
    followed : dict of str to list of ndarray, shape (draws,)
        Where each goes with the coefficients; nan where it was not found again.
    """
    rows = []
    for name, speeds in critical.items():
        for i, v in enumerate(speeds):
            rows.append(_critical_row(name, v, followed[name][i]))
    for v, found in _families(critical, followed):
        rows.append(_critical_row("**all, with equal weights**", v, found))
    if not rows:
        return "No law has a critical speed in the range."
    rows.sort(key=lambda row: row.pop("order"))
    note = (
        "*Found*: in how many of the draws (of all laws, in the last rows) the margin changes its "
        f"sign within a factor {REACH:g}. Where that is not in all of them, the interval is that "
        "of those in which it is, and has no confidence level of its own."
    )
    return f"{table(rows)}\n\n{note}"


def _critical_row(name, v, found):
    there = found[np.isfinite(found)]
    place = (1, v) if name.startswith("**") else (0, 0)
    return {
        "law": name,
        "critical speed (m/s)": number(v, 4),
        "95 % interval (m/s)": (
            " to ".join(number(x, 4) for x in np.quantile(there, [0.025, 0.975]))
            if there.size
            else "–"
        ),
        "found": f"{there.size} of {found.size}",
        "order": place,
    }


def _families(critical, followed):
    """Critical speeds that are the same on several laws: one of them, and all of their draws.

    A law that does not have one brings draws without it, nan.
    """
    draws = max((len(one) for values in followed.values() for one in values), default=0)
    families = []
    for name, speeds in critical.items():
        for i, v in enumerate(speeds):
            for family in families:
                if name not in family[1] and abs(np.log(v / family[0])) < SAME:
                    family[1][name] = followed[name][i]
                    break
            else:
                families.append((v, {name: followed[name][i]}))
    none = np.full(draws, np.nan)
    return [
        (v, np.concatenate([members.get(name, none) for name in critical]))
        for v, members in sorted(families, key=lambda family: family[0])
    ]


def conclusions(asked, runs, drawn, critical, delta_max):
    """What an engineer should conclude, in five sentences."""
    outcome = {v: _signed(_share_lost(drawn, i)).strip("*") for i, v in enumerate(asked)}
    signed = {word: [v for v in asked if outcome[v] == word] for word in ("kept", "lost", "open")}
    line = next(iter(drawn))
    stands = [f"{word} at {speed_list(signed[word])}" for word in ("kept", "lost") if signed[word]]
    sentences = []
    if stands:
        sentences.append(
            f"Contact is {join(stands)}: neither the scatter of the readings nor the choice among "
            "the four laws changes that."
        )
    else:
        sentences.append("None of the asked verdicts can be signed whatever the law is.")
    touched = [
        v
        for i, v in enumerate(asked)
        if max(runs[name].compression[i] for name in drawn) > delta_max
    ]
    where = rf"$\delta_{{\max}}$ = {fixed(1000 * delta_max, 1)}{SPACE}mm"
    beyond = [v for v in signed["open"] if v in touched]
    within = [v for v in signed["open"] if v not in touched]
    if beyond:
        sentences.append(
            f"At {speed_list(beyond)} the verdict is **open**: it is decided by what the spring "
            f"does beyond {where}, and of that there is not one reading."
        )
    elif within:
        sentences.append(
            f"At {speed_list(within)} the verdict is **open**: the margin is too near to zero for "
            "these readings."
        )
    else:
        sentences.append("None of the asked verdicts is left open by these four laws.")
    kept = [
        v
        for v in critical[line]
        if all(_nearest(speeds, v) is not None for speeds in critical.values())
    ]
    gone = [v for v in critical[line] if v not in kept]
    if not len(critical[line]):
        sentences.append("The line has no critical speed in the range, so none can be lost.")
    elif not gone:
        sentences.append("Every critical speed of the line is there on all four laws.")
    else:
        stay = f"only {speed_list(kept)} stays" if kept else "none stays"
        stay = stay.replace("stays", "stay") if len(kept) > 1 else stay
        sentences.append(
            f"Of the line's critical speeds {stay} on all four laws; {speed_list(gone)} belong to "
            "a spring that nobody has measured."
        )
    spread = [np.ptp([runs[name].margin[i] for name in drawn]) for i in range(len(asked))]
    width = [
        np.ptp(np.quantile(drawn[line].margin[:, i], [0.025, 0.975])) for i in range(len(asked))
    ]
    worst = int(np.argmax(spread))
    if spread[worst] > width[worst]:
        sentences.append(
            f"The choice of the law weighs more than the readings: at {speed_list([asked[worst]])} "
            f"it moves the margin by {quantity(spread[worst], 'N', 2)}, the readings move it by "
            f"{quantity(width[worst], 'N', 2)}."
        )
    else:
        sentences.append(
            "The scatter of the readings weighs more than the choice of the law at every asked "
            "speed: take more readings."
        )
    if touched:
        sentences.append(
            f"Before anyone relies on a run at {speed_list(touched)}, press the spring on to its "
            "stop and measure where that is and how stiff: a few readings there are worth more "
            "than a hundred below."
        )
    else:
        sentences.append(
            r"At none of the asked speeds does the spring go beyond $\delta_{\max}$: the stop does "
            "not matter there."
        )
    return "\n".join(f"{i}. {sentence}" for i, sentence in enumerate(sentences, 1))
