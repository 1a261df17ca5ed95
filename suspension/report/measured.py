"""Sentences, tables and captions of Part VIII: the measured spring with its stop.

In all of them a law is called by its name, and the first is the line. `runs` holds a
`suspension.sweep.Drive` for each law at the asked speeds, on a ground that only pushes; `study` is
a `suspension.measured.Study`. After a loss of contact no margin is told: it is a sign and a place.
"""

import numpy as np

from suspension.forces import WHEEL
from suspension.measured import REACH, same_speed
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
    "aftermath_table",
    "aftermath_words",
    "conclusions",
    "cost_sentence",
    "cost_table",
    "critical_table",
    "draws_sentence",
    "geometry_sentence",
    "law_caption",
    "limit_table",
    "margins_caption",
    "order_caption",
    "order_sentence",
    "reach_table",
    "regions_caption",
    "run_caption",
    "sign_table",
    "statics_table",
    "stiffness_caption",
    "stiffness_sentence",
    "survival_sentence",
    "verdict_sentence",
    "verdict_table",
]

ROUNDOFF = 1e-9  # N
ALIKE = 0.05  # laws nearer than this part of the largest force hardly differ
KINK = 2.6  # an order below this is that of a kink, with its scatter


# --- the law, at rest -----------------------------------------------------------------------------


def law_caption(fit, at_rest, farthest):
    """Caption of the laws; displacements at rest and farthest of the line, over delta_max."""
    x = np.linspace(0, 1, 101)
    apart = np.abs(fit.beta[0] + fit.beta[2] * x**2).max() / fit.beta.sum()
    where = "they hardly differ." if apart < ALIKE else "only the line leaves the readings."
    beyond = "." if farthest > 1 else "; the line does not go there."
    alt = (
        "Force against displacement over delta_max: the readings, a line, the fitted parabola with "
        "its end tangents, and the parabola with a rubber and with a metal stop, which turn up "
        f"steeply at 1, where the parabola is at {number(fit.beta.sum())}{SPACE}N. Marked are the "
        f"displacement at rest, {fixed(at_rest, 2)}, and the farthest that the line is driven to, "
        f"{fixed(farthest, 2)}."
    )
    text = (
        f"Four laws for one spring. Where it was measured {where} Beyond "
        rf"$\delta_{{\max{{}}}}$ (grey) each is an assumption{beyond}"
    )
    return Caption(text, alt)


def statics_table(laws, robot):
    """Where the robot rests on each law, what it feels there, and how it swings."""
    rows, beyond = [], []
    for name, law in laws.items():
        tangent, at_rest = linearised(robot, law), -rest(robot, law)[0] / law.delta_max
        rows.append(
            {
                "law": name,
                r"at rest, of $\delta_{\max{}}$": fixed(at_rest, 4),
                "tangent there (N/m)": number(tangent.k1, 4),
                "heave (Hz)": fixed(np.sqrt(2 * tangent.k1 / robot.m) / (2 * np.pi), 3),
            }
        )
        if at_rest > 1:
            beyond.append(name)
    if not beyond:
        return table(rows)
    note = (
        rf"**The robot rests beyond $\delta_{{\max{{}}}}$** on: {join(beyond)}. With a stop it "
        "stands on it before it has driven a step."
    )
    return f"{table(rows)}\n\n{note}"


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
            error = one.margin[i] - other.margin[i]
            if one.kept[i] and other.kept[i]:
                cell = number(error, 2) if abs(error) > ROUNDOFF else "0"
            elif one.kept[i] == other.kept[i]:
                cell = "lost on both"
            else:
                cell = "**another verdict**"
            cells[f"{v:g} m/s"] = cell + ("\\*" if other.compression[i] > delta_max else "")
        rows.append({"bump (mm)": fixed(1000 * height, 1), **cells})
    note = (
        "Margin of the linear robot (the tangent at rest) minus that of the law, in N. An "
        "asterisk: a spring is on its stop at some moment."
    )
    return f"{table(rows)}\n\n{note}"


# --- verdicts and critical speeds -----------------------------------------------------------------


def verdict_table(asked, runs):
    """Kept, with the least force, or lost, by which wheel and where: a row for each speed."""
    rows = [
        {"v (m/s)": f"{v:g}", **{name: _cell(run, i) for name, run in runs.items()}}
        for i, v in enumerate(asked)
    ]
    note = (
        "*Kept* with the least force of both wheels; *lost* with the wheel that leaves the ground "
        "first and the place $X$ of the body then."
    )
    return f"{table(rows)}\n\n{note}"


def _cell(run, i):
    if run.kept[i]:
        return f"kept, {fixed(run.margin[i], 2)}{SPACE}N"
    return f"lost, {WHEEL[run.wheel[i]]}, {fixed(run.lost[i], 4)}{SPACE}m"


def verdict_sentence(asked, runs):
    """Which of the asked verdicts do not depend on the law."""
    (line, own), *others = runs.items()
    same, turned = [], {}
    for i, v in enumerate(asked):
        differ = tuple(name for name, run in others if run.kept[i] != own.kept[i])
        if differ:
            turned.setdefault((bool(own.kept[i]), differ), []).append(v)
        else:
            same.append(v)
    if not turned:
        return f"At {speed_list(same)} the verdict is the same on every law."
    words = [f"At {speed_list(same)} every law gives the verdict of the {line}."] if same else []
    for (kept, names), speeds in turned.items():
        was, now = ("kept", "lost") if kept else ("lost", "kept")
        words.append(
            f"At {speed_list(speeds)} contact is {was} on the {line} and **{now}** on: "
            f"{join(names)}."
        )
    return " ".join(words)


def aftermath_table(asked, runs, delta_max):
    """What a ground that only pushes does to the robot: largest values of the whole way."""
    rows = []
    for i, v in enumerate(asked):
        for name, run in runs.items():
            rows.append(
                {
                    "v (m/s)": f"{v:g}",
                    "law": name,
                    "acceleration (m/s²)": number(run.acceleration[i]),
                    r"compression, of $\delta_{\max{}}$": fixed(run.compression[i] / delta_max, 2),
                    "in the air, rear (ms)": _air(run.airtime[0, i]),
                    "front (ms)": _air(run.airtime[1, i]),
                    "flights": str(run.flights[:, i].sum()),
                }
            )
    return table(rows)


def _air(seconds):
    return fixed(1000 * seconds, 1) if seconds else "–"


def aftermath_words(asked, runs):
    """Where the law matters most to what the robot feels."""
    felt = np.array([run.acceleration for run in runs.values()])
    i = int(np.argmax(felt.max(axis=0) / felt.min(axis=0)))
    ratio = felt[:, i].max() / felt[:, i].min()
    if ratio < 1 + ALIKE:
        return "What the body feels hardly depends on the law at any asked speed."
    hardest, softest = (list(runs)[f(felt[:, i])] for f in (np.argmax, np.argmin))
    return (
        f"What the body feels depends on the law most at {speed_list([asked[i]])}: the largest "
        f"acceleration on the {hardest} is {number(ratio, 2)} times that on the {softest}."
    )


def geometry_sentence(asked, runs, full, critical, tilted):
    """What the full geometry changes.

    Parameters
    ----------
    full : dict of str to Drive
        As `runs`, with the full geometry.
    critical, tilted : array_like
        Critical speeds of the parabola, m/s, with a small pitch and with the full geometry.
    """
    turned, moved = [], []
    for name, run in runs.items():
        other = full[name]
        turned += [f"{v:g}{SPACE}m/s ({name})" for v in np.extract(run.kept != other.kept, asked)]
        moved += list(np.abs(other.margin - run.margin)[run.kept & other.kept])
    words = r"With $\sin\theta$ and $\cos\theta$ in place of $\theta$ and 1, "
    words += f"the verdict turns at {join(turned)}." if turned else "no verdict turns."
    if moved:
        words += (
            f" Where contact is kept the margin moves by at most {quantity(max(moved), 'N', 2)}."
        )
    if len(critical) != len(tilted):
        words += (
            f" The parabola then has {count(len(tilted), 'critical speed')} instead of "
            f"{count(len(critical), 'one').split()[0]}."
        )
    elif len(critical):
        moved = np.abs(np.asarray(tilted) / critical - 1).max()
        words += f" The critical speeds of the parabola move by at most {percent(moved)}."
    return words


def margins_caption(critical):
    """Caption of the margins; `critical` holds the critical speeds for each law, m/s."""
    each = "; ".join(f"{name}: {speed_list(v, none='none')}" for name, v in critical.items())
    text = (
        "The margin against speed on four laws. Symbols: critical speeds; dotted: the asked "
        "speeds. Where a curve lies on zero, contact is lost."
    )
    alt = (
        "Least normal force against speed on a logarithmic axis, a curve for each of the laws, "
        f"zero where contact is lost. Critical speeds: {each}."
    )
    return Caption(text, alt)


def survival_sentence(critical):
    """Which critical speeds of the line are there on the other laws, and how far they move."""
    (_, line), *others = critical.items()
    if not len(line):
        found = [name for name, speeds in others if len(speeds)]
        if not found:
            return "The line has no critical speed in the range, and neither has any other law."
        return (
            f"The line has no critical speed in the range, but other laws have some: {join(found)}."
        )
    words = [f"The line has {count(len(line), 'critical speed')}."]
    words += [f"*{name.capitalize()}*: {_survivors(line, speeds)}." for name, speeds in others]
    return " ".join(words)


def _survivors(line, speeds):
    pairs = {v: same_speed(speeds, v) for v in line}
    stay = [v for v, w in pairs.items() if w is not None]
    gone = [v for v, w in pairs.items() if w is None]
    new = [w for w in speeds if w not in pairs.values()]
    parts = []
    if stay:
        moved = max(abs(pairs[v] / v - 1) for v in stay)
        which = "all stay" if not gone else f"{speed_list(stay)} {_verb('stay', stay)}"
        if len(line) == 1:
            which = "it stays"
        parts.append(which + (f", moved by at most {percent(moved)}" if moved > ROUNDOFF else ""))
    if gone:
        parts.append(f"there is none at {speed_list(gone)}" if stay else "none of them stays")
    if new:
        parts.append(
            f"there {'is another' if len(new) == 1 else 'are others'}, at {speed_list(new)}"
        )
    return "; ".join(parts)


def _verb(verb, things):
    return verb if len(things) > 1 else verb + "s"


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


def stiffness_caption(ratio, felt):
    """Caption of the acceleration over the stiffness of the stop; `felt` in m/s^2 by speed."""
    text = (
        "The largest acceleration at the asked speeds, on a ground that only pushes, against the "
        "stiffness of the stop. Filled symbols: contact is kept; open ones: it is lost. Dotted: "
        "the two stops of this part."
    )
    each = join(
        f"from {number(a[0], 2)} to {number(a[-1], 2)}{SPACE}m/s² at {v:g}{SPACE}m/s"
        for v, a in felt.items()
    )
    alt = (
        f"Largest acceleration against stop stiffness, {number(ratio[0], 2)} to "
        f"{number(ratio[-1], 2)} times that of the spring, both on logarithmic axes: {each}."
    )
    return Caption(text, alt)


def stiffness_sentence(turns):
    """Whether the verdict depends on how stiff the stop is; `turns`: where it turns, by speed.

    Where is the stiffness of the stop over that of the spring.
    """
    steady = [v for v, ratios in turns.items() if not len(ratios)]
    words = []
    if steady:
        words.append(
            f"At {speed_list(steady)} the verdict is the same for every stop of this range: its "
            "stiffness need not be known."
        )
    for v, ratios in turns.items():
        if len(ratios):
            words.append(
                f"At {speed_list([v])} it turns at {join(number(r) for r in ratios)} times the "
                "stiffness of the spring."
            )
    return " ".join(words)


# --- what a stop costs ----------------------------------------------------------------------------


def limit_table(eigenvalues, dt):
    """Fastest eigenvalue on each law, the longest stable step of RK4, and whether `dt` is one."""
    return table(
        [
            {
                "law": name,
                r"$\max\lvert\lambda\rvert$ (1/s)": number(np.abs(values).max(), 3),
                r"longest stable $\Delta t$ of RK4 (ms)": number(
                    1000 * RK4.max_stable_dt(values), 3
                ),
                rf"$\Delta t$ = {dt:g}{SPACE}s": _stable(values, dt, mark="**"),
            }
            for name, values in eigenvalues.items()
        ]
    )


def _stable(eigenvalues, dt, mark=""):
    return f"{mark}{'stable' if RK4.is_stable(eigenvalues, dt) else 'unstable'}{mark}"


def regions_caption(eigenvalues, dts):
    """Caption of the stability diagram with the eigenvalues on and off the stop."""
    each = "; ".join(
        f"{name} at {dt:g} s {_stable(values, dt)}"
        for dt in dts
        for name, values in eigenvalues.items()
    )
    return Caption(
        r"The diagram of Question 7 once more: the same method, other eigenvalues. On the stop "
        r"$\lambda\Delta t$ grows along the imaginary axis.",
        f"Region of absolute stability of RK4 with the points lambda dt of each law: {each}.",
    )


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
    first, *others = orders.values()
    if max(orders.values()) < KINK:
        what = "On the stop the order is [that of a kink](07-flight.ipynb#one-bad-step), two."
    elif first > KINK > max(others, default=first):
        what = (
            "A stop is a kink of the force, and a kink costs RK4 its order: "
            "[two is what is left](07-flight.ipynb#one-bad-step)."
        )
    else:
        what = "With these steps the kink does not show everywhere."
    return f"Observed orders: {each}. {what}"


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
    if row["stable"]:
        return number(row["error"], 2)
    return f"{number(row['error'], 1) if np.isfinite(row['error']) else 'overflow'} (unstable)"


def cost_sentence(rows):
    """Whether the implicit step is worth its price; the methods stand in pairs, RK4 first."""
    pairs = list(zip(rows[::2], rows[1::2]))
    stable = [(explicit, other) for explicit, other in pairs if explicit["stable"]]
    better = sum(explicit["error"] <= other["error"] for explicit, other in stable)
    words = f"RK4 is stable in {len(stable)} of {len(pairs)} cases"
    if stable:
        price = np.mean([other["solves"] / other["steps"] for _, other in stable])
        words += (
            f", and in {better} of these the more accurate of the two; there Crank-Nicolson solves "
            f"{fixed(price, 1)} linear systems a step"
        )
    if len(stable) < len(pairs):
        worst = max(other["error"] for explicit, other in pairs if not explicit["stable"])
        words += (
            ". Where RK4 is unstable Crank-Nicolson stays finite and is wrong by up to "
            f"{percent(worst)}"
        )
    return words + "."


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
            r"$\delta_{\max{}}$, which no spring does: the intervals leave this doubt aside."
        )
    if not linear:
        words += (
            " The readings contradict the line, which is kept here because the problem set asks "
            "for its slope: where it stands alone against the other three, believe those."
        )
    return words


def _share(share):
    """A share of draws, with its bound where there is none or nothing else."""
    if share.found == 0:
        return f"<{SPACE}{percent(share.high)}"
    if share.found == share.n:
        return f">{SPACE}{percent(share.low, 3)}"
    return percent(share.value)


def sign_table(study):
    """The verdicts as an engineer may sign them: parameters, model, both, and the outcome."""
    line, rows = study.laws[0], []
    for i, v in enumerate(study.asked):
        margins = study.margins(i, line)
        rows.append(
            {
                "v (m/s)": f"{v:g}",
                "verdict of the line": "lost" if study.verdicts(line)[i] else "kept",
                "its margin, 95 % interval (N)": (
                    "–" if margins is None else interval(*margins, decimals=2)
                ),
                "parameters alone": f"{_share(study.share(i, line))} lost",
                "model alone": f"{study.agreeing(i)} of {len(study.laws)} laws agree",
                "both": f"{_share(study.share(i))} lost",
                "signed": f"**{_outcome(study.signed(i))}**",
            }
        )
    note = (
        "*Parameters alone*: the share of the draws in which contact is lost on the line; where "
        f"it is lost in none or in all of the {study.share(0).n}, the 95 % bound that so many "
        "independent draws give. *Model alone*: at the estimates. *Both*: all laws with the same "
        "weight; as all have the same draws, these count once. The weights are a judgement, not "
        "a measurement. Signed is what leaves less than 2.5 % of doubt."
    )
    return f"{table(rows)}\n\n{note}"


def _outcome(verdict):
    return {True: "lost", False: "kept", None: "open"}[verdict]


def critical_table(study):
    """Critical speeds of every law with their intervals, then each speed over all laws."""
    rows = [
        _critical_row(name, v, followed)
        for name in study.laws
        for v, followed in zip(study.critical[name], study.followed[name])
    ]
    for family in study.families:
        row = _critical_row("**all, with equal weights**", family.speed, family.followed.ravel())
        rows.append(row | {"found": f"on {len(family.laws)} of {len(study.laws)} laws"})
    if not rows:
        return "No law has a critical speed in the range."
    note = (
        "*Found*: in how many of the draws the margin changes its sign within a factor "
        f"{REACH:g}. Where that is not in all of them, or not on all laws, the interval is that "
        "of those in which it is, and has no confidence level of its own."
    )
    return f"{table(rows)}\n\n{note}"


def _critical_row(name, v, followed):
    there = followed[np.isfinite(followed)]
    ends = np.quantile(there, [0.025, 0.975]) if there.size else ()
    return {
        "law": name,
        "critical speed (m/s)": number(v, 4),
        "95 % interval (m/s)": " to ".join(number(x, 4) for x in ends) or "–",
        "found": f"{there.size} of {followed.size}",
    }


def conclusions(study):
    """What an engineer should conclude, in five sentences."""
    sentences = [f(study) for f in (_stands, _open, _critical, _readings_or_law, _measure)]
    return "\n".join(f"{i}. {sentence}" for i, sentence in enumerate(sentences, 1))


def _signed(study, verdict):
    return [v for i, v in enumerate(study.asked) if study.signed(i) is verdict]


def _stands(study):
    stands = [
        f"{word} at {speed_list(_signed(study, verdict))}"
        for word, verdict in (("kept", False), ("lost", True))
        if _signed(study, verdict)
    ]
    if not stands:
        return "None of the asked verdicts can be signed whatever the law is."
    return (
        f"Contact is {join(stands)}: neither the scatter of the readings nor the choice among "
        "the four laws changes that."
    )


def _open(study):
    beyond = [v for v, on in zip(study.asked, study.touched) if on]
    unsure = _signed(study, None)
    decided = [v for v in unsure if v in beyond]
    if decided:
        where = rf"$\delta_{{\max{{}}}}$ = {fixed(1000 * study.delta_max, 1)}{SPACE}mm"
        return (
            f"At {speed_list(decided)} the verdict is **open**: it is decided by what the spring "
            f"does beyond {where}, and of that there is not one reading."
        )
    if unsure:
        return (
            f"At {speed_list(unsure)} the verdict is **open**: the margin is too near to zero for "
            "these readings."
        )
    return "None of the asked verdicts is left open by these four laws."


def _critical(study):
    line = study.critical[study.laws[0]]
    kept = [v for v in line if all(same_speed(w, v) is not None for w in study.critical.values())]
    gone = [v for v in line if v not in kept]
    if not len(line):
        return "The line has no critical speed in the range, so none can be lost."
    if not gone:
        return "Every critical speed of the line is there on all four laws."
    stay = f"only {speed_list(kept)} {_verb('stay', kept)}" if kept else "none stays"
    return (
        f"Of the line's critical speeds {stay} on all four laws; {speed_list(gone)} "
        f"{_verb('belong', gone)} to a spring that nobody has measured."
    )


def _readings_or_law(study):
    """Whether the choice of the law or the scatter of the readings decides more verdicts."""
    laws = len(study.laws)
    turned = [v for i, v in enumerate(study.asked) if study.agreeing(i) < laws]
    unsure = [
        v
        for i, v in enumerate(study.asked)
        if any(study.share(i, name).verdict is None for name in study.laws)
    ]
    if turned and not unsure:
        return (
            f"The law decides and the readings do not: at {speed_list(turned)} the laws disagree, "
            "while on each of them the scatter of the readings leaves no verdict open."
        )
    if turned:
        return (
            f"Law and readings both decide: at {speed_list(turned)} the laws disagree, and at "
            f"{speed_list(unsure)} the scatter of the readings leaves the verdict on some law open."
        )
    if unsure:
        return (
            f"The readings decide and the law does not: at {speed_list(unsure)} their scatter "
            "leaves the verdict on some law open. Take more readings."
        )
    return "Neither the law nor the scatter of the readings turns one of the asked verdicts."


def _measure(study):
    beyond = [v for v, on in zip(study.asked, study.touched) if on]
    if not beyond:
        return (
            r"At none of the asked speeds does the spring go beyond $\delta_{\max{}}$: the stop "
            "does not matter there."
        )
    return (
        f"Before anyone relies on a run at {speed_list(beyond)}, press the spring on to its stop "
        "and measure where that is and how stiff: a few readings there are worth more than a "
        "hundred below."
    )
