"""Sentences, tables and captions of Part VIII: the measured spring with its stop.

In all of them a law is called by its name, and the first is the line. `runs` holds a
`suspension.sweep.Drive` for each law at the asked speeds, on a ground that only pushes; `study` is
a `suspension.measured.Study`. After a loss of contact no margin is told: it is a sign and a place.
"""

import numpy as np

from suspension.forces import WHEEL
from suspension.measured import REACH, SURE, Share, surviving
from suspension.report.rows import table
from suspension.report.words import (
    SPACE,
    Caption,
    confidence,
    count,
    fixed,
    interval,
    join,
    number,
    percent,
    quantity,
    speed_list,
    spelled,
)
from suspension.schemes import RK4
from suspension.spring_law import linearised, rest

__all__ = [
    "conclusions",
    "critical_table",
    "draws_sentence",
    "geometry_sentence",
    "how_it_grows",
    "how_many_signed",
    "law_caption",
    "limit_table",
    "margins_caption",
    "order_caption",
    "power_table",
    "run_caption",
    "sign_table",
    "statics_table",
    "stiffness_caption",
    "stiffness_sentence",
    "survival_sentence",
    "verdict_sentence",
    "verdict_table",
    "which_stay",
    "which_turn",
]

ALIKE = 0.05  # laws nearer than this part of the largest force hardly differ
CLOSE = 1e-3  # critical speeds of different runs agree within this part
POWERS = {"Up to a ceiling": 0.0, "Like its root": 0.5, "In proportion to it": 1.0}
NEAR = 0.1  # a power within this of another is called that one
OPEN, SIGNED = "open", {True: "lost", False: "kept"}


def _on(names):
    """The laws that a wheel drives on, in words."""
    return join(f"the {name}" for name in names)


# --- the law, at rest -----------------------------------------------------------------------------


def law_caption(fit, laws, at_rest, farthest):
    """Caption of the laws; displacements at rest and farthest of the line, over delta_max."""
    x = np.linspace(0, 1, 101)
    apart = np.abs(fit.beta[0] + fit.beta[2] * x**2).max() / fit.beta.sum()
    where = "they hardly differ." if apart < ALIKE else "only the line leaves the readings."
    goes = "." if farthest > 1 else "; the line does not go there."
    alt = (
        "Force against displacement over delta_max: the readings, a line, the fitted parabola with "
        "its end tangents, and the parabola with a rubber and with a metal stop, which turn up "
        f"steeply at 1, where the parabola is at {number(fit.beta.sum())}{SPACE}N. Marked are the "
        f"displacement at rest, {fixed(at_rest, 2)}, and the farthest that the line is driven to, "
        f"{fixed(farthest, 2)}."
    )
    text = (
        f"{count(len(laws), 'law').capitalize()} for one spring. Where it was measured {where} "
        rf"Beyond $\delta_{{\max{{}}}}$ (grey) each is an assumption{goes}"
    )
    return Caption(text, alt)


def statics_table(laws, robot):
    """Where the robot rests on each law, what it feels there, and how it swings."""
    head = "law", r"at rest, of $\delta_{\max{}}$", "tangent there (N/m)", "heave (Hz)"
    names, beyond = {}, []  # laws of the same values share a row
    for name, law in laws.items():
        tangent, at_rest = linearised(robot, law), -rest(robot, law)[0] / law.delta_max
        heave = np.sqrt(2 * tangent.k1 / robot.m) / (2 * np.pi)
        cells = fixed(at_rest, 4), number(tangent.k1, 4), fixed(heave, 3)
        names.setdefault(cells, []).append(name)
        if at_rest > 1:
            beyond.append(name)
    rows = [dict(zip(head, (join(alike), *cells))) for cells, alike in names.items()]
    note = (
        rf"**The robot rests beyond $\delta_{{\max{{}}}}$** on {_on(beyond)}. With a stop it "
        "stands on it before it has driven a step."
    )
    return f"{table(rows)}\n\n{note}" if beyond else table(rows)


# --- verdicts and critical speeds -----------------------------------------------------------------


def verdict_table(asked, runs):
    """Kept, with the least force, or lost, by which wheel and where: a row for each speed."""
    first = {WHEEL[wheel] for run in runs.values() for wheel in run.wheel[~run.kept]}
    rows = [
        {"v (m/s)": f"{v:g}", **{name: _cell(run, i, len(first) > 1) for name, run in runs.items()}}
        for i, v in enumerate(asked)
    ]
    note = []
    if any(run.kept.any() for run in runs.values()):
        note.append("Beside *kept* stands the least force on either wheel.")
    if first:
        note.append("Beside *lost* stands the place $X$ of the body at the loss.")
    if len(first) == 1:
        note.append(f"It is always the {first.pop()} wheel that leaves the ground first.")
    return f"{table(rows)}\n\n{' '.join(note)}"


def _cell(run, i, tell_wheel):
    if run.kept[i]:
        return f"kept, {fixed(run.margin[i], 2)}{SPACE}N"
    wheel = f"{WHEEL[run.wheel[i]]}, " if tell_wheel else ""
    return f"lost, {wheel}{fixed(run.lost[i], 4)}{SPACE}m"


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
        alike = [line, *(name for name, _ in others if name not in names)]
        words.append(
            f"At {speed_list(speeds)} contact is {was} on {_on(alike)} and **{now}** on "
            f"{_on(names)}."
        )
    return " ".join(words)


def which_turn(asked, runs):
    """At which speeds a verdict turns, and to which side, as the answer to a prediction."""
    own, *others = (run.kept for run in runs.values())
    slow = asked <= np.median(asked)
    told = []
    for side, kept in (("lost", True), ("kept", False)):
        turned = (own == kept) & np.any([other != own for other in others], axis=0)
        if turned.any():
            where = {(True, False): "slow", (False, True): "fast"}.get(
                ((turned & slow).any(), (turned & ~slow).any()), "slow and the fast"
            )
            speeds = speed_list(np.extract(turned, asked))
            told.append(f"**At the {where} ones, to {side}:** {speeds}.")
    return " ".join(told) or "**At none.**"


def geometry_sentence(asked, runs, full):
    """What the full geometry changes; `full` as `runs`."""
    turned, moved = [], []
    for name, run in runs.items():
        other = full[name]
        turned += [f"{v:g}{SPACE}m/s ({name})" for v in np.extract(run.kept != other.kept, asked)]
        moved += list(np.abs(other.margin - run.margin)[run.kept & other.kept])
    words = f"the verdict turns at {join(turned)}." if turned else "no verdict turns."
    if moved:
        words += (
            f" Where contact is kept the margin moves by at most {quantity(max(moved), 'N', 2)}."
        )
    return rf"With $\sin\theta$ and $\cos\theta$ in place of $\theta$ and 1, {words}"


def margins_caption(critical):
    """Caption of the margins; `critical` holds the critical speeds for each law, m/s."""
    each = "; ".join(f"{name}: {speed_list(v, none='none')}" for name, v in critical.items())
    text = (
        f"The margin against speed on {count(len(critical), 'law')}. Symbols: critical speeds; "
        "dotted: the asked speeds. Where a curve lies on zero, contact is lost."
    )
    alt = (
        "Least normal force against speed on a logarithmic axis, a curve for each of the laws, "
        f"zero where contact is lost. Critical speeds: {each}."
    )
    return Caption(text, alt)


def survival_sentence(critical):
    """Which critical speeds of the line are there on every law; `critical` by law, m/s."""
    line = next(iter(critical.values()))
    kept = surviving(critical.values())
    gone = [v for v in line if v not in kept]
    if not len(line):
        found = [name for name, speeds in critical.items() if len(speeds)]
        others = f"; there are some on {_on(found)}." if found else ", and no other law has one."
        return f"The line has no critical speed in the range{others}"
    if not gone:
        return "Every critical speed of the line is there on all laws."
    stay = f"only {speed_list(kept)} {_verb('stay', kept)}" if kept else "none stays"
    return (
        f"Of the line's critical speeds {stay} on all laws; {speed_list(gone)} "
        f"{_verb('belong', gone)} to a spring that nobody has measured."
    )


def which_stay(critical):
    """Which of the line's critical speeds every law has, as the answer to a prediction."""
    line = list(next(iter(critical.values())))
    kept = surviving(critical.values())
    n = len(kept)
    if not line:
        return "**The line has none in the range.**"
    if n in (0, len(line)):
        return "**All of them.**" if n else "**Not one.**"
    which = {n: "The slow ones", -n: "The fast ones"}
    where = n if kept == line[:n] else -n if kept == line[-n:] else 0
    share = f"{spelled(n)} of {spelled(len(line))}"
    return f"**{which.get(where, 'Some of them')}:** {speed_list(kept)}, {share}."


def _verb(verb, things):
    return verb if len(things) > 1 else verb + "s"


def run_caption(v, shown, delta_max):
    """Caption of the runs at `v` in m/s; `shown` as `plot_measured_run` takes it."""
    each = "; ".join(
        f"{name}: up to {fixed(np.max(p) / delta_max, 2)}, drawn to X = {fixed(X[-1], 3)}{SPACE}m"
        for name, (X, p, _) in shown.items()
    )
    text = (
        f"Front spring and front wheel at {v:g}{SPACE}m/s. The stop begins at 1. Each curve ends "
        "where a wheel leaves the ground, or with the figure. The axis of the force is linear up "
        f"to 10{SPACE}N and logarithmic beyond."
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


def how_it_grows(ratio, felt):
    """How the acceleration grows with the stop's stiffness, as the answer to a prediction.

    Parameters
    ----------
    ratio : array_like, shape (n,)
        Stiffness of the stop over that of the spring, in order.
    felt : sequence of array_like, shape (n,)
        Largest acceleration at each speed at which a stop is met, m/s^2.
    """
    if not len(felt):
        return "**No stop is met at these speeds.**"
    last = np.asarray(ratio) >= ratio[-1] / 10
    logs = np.log(np.asarray(ratio)[last])
    powers = [np.polyfit(logs, np.log(np.asarray(values)[last]), 1)[0] for values in felt]
    ends = dict.fromkeys(fixed(power, 2) for power in (min(powers), max(powers)))
    power_law = f"goes like the stiffness to the power {join(ends, 'to')}"
    said = f"over the last factor of ten the acceleration {power_law}"
    for answer, power in POWERS.items():
        if np.abs(np.array(powers) - power).max() < NEAR:
            return f"**{answer}:** {said}."
    return f"**In none of these ways yet:** {said}."


def stiffness_sentence(turns):
    """At which stop over spring stiffness the verdict turns, if at all; `turns` by speed."""
    steady = [v for v, ratios in turns.items() if not len(ratios)]
    words = []
    if steady:
        words = [f"At {speed_list(steady)} the verdict is the same with every stop that was tried."]
    words += [
        f"At {speed_list([v])} it turns where the stop is {join(number(r) for r in ratios)} times "
        "as stiff as the spring."
        for v, ratios in turns.items()
        if len(ratios)
    ]
    return " ".join(words)


# --- what a stop costs: the appendix --------------------------------------------------------------


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
                rf"$\Delta t$ = {dt:g}{SPACE}s": (
                    f"**{'stable' if RK4.is_stable(values, dt) else 'unstable'}**"
                ),
            }
            for name, values in eigenvalues.items()
        ]
    )


def order_caption(v, orders, unread=()):
    """Caption of the error of RK4 on each law.

    Parameters
    ----------
    v : float
        Speed, m/s.
    orders : dict of str to float
        Observed, for each law of which one can be read.
    unread : sequence of str
        The other laws.
    """
    each = join((f"{fixed(order, 1)} ({name})" for name, order in orders.items()), none="none")
    text = (
        f"RK4 at {v:g}{SPACE}m/s until the body is over the bump: error beside a run of DOP853 "
        f"with steps that are short at every kink. Observed orders: {each}."
    )
    if unread:
        text += (
            f" With {join(unread)} the error is near what that run can tell, and no order can be "
            "read."
        )
    return Caption(text, f"Error against time step on logarithmic axes; observed slopes: {each}.")


# --- how well it is known -------------------------------------------------------------------------


def power_table(curvature, noticed, moved):
    """What the F test notices of a curvature, and what that does to the slope of the line.

    Parameters
    ----------
    curvature : array_like, shape (n,)
        True coefficients, N; all zero if the readings have no scatter.
    noticed, moved : array_like, shape (n,)
        Power of the test; by how many half-widths of its own interval the slope is off.
    """
    if not np.any(curvature):
        return "These readings have no scatter, and the test notices the smallest curvature."
    return table(
        [
            {
                r"true curvature $\beta_2$ (N)": number(size, 2),
                "the F test notices it in": confidence(power),
                "the slope of the line is off by (half-widths)": number(off, 2),
            }
            for size, power, off in zip(curvature, noticed, moved)
        ]
    )


def draws_sentence(kept, drawn, followed, linear):
    """What was drawn and what of it is left out, and for how many draws the critical speeds follow.

    `kept` of the `drawn` ones are those of a spring; `linear`: the readings contradict no line.
    """
    words = f"{drawn} draws of the three coefficients at once"
    if kept == drawn:
        words += "; in every one the force grows up to the stop."
    else:
        words += (
            f"; {drawn - kept} are left out because their parabola bends down before "
            r"$\delta_{\max{}}$, which no spring does: the intervals leave this doubt aside."
        )
    words += f" The critical speeds are followed for the first {min(followed, kept)} of them."
    if not linear:
        words += (
            " The readings contradict the line, which is kept here because the problem set asks "
            "for its slope: where it stands alone against all the others, believe those."
        )
    return words


def critical_table(study):
    """Critical speeds of every law with their intervals; laws with the same ones share a row."""
    names = {}
    for name, law in study.laws.items():
        for v, followed in zip(law.critical, law.followed):
            names.setdefault(tuple(_critical_row(v, followed).items()), []).append(name)
    if not names:
        return "No law has a critical speed in the range."
    rows = [{"law": join(alike), **dict(cells)} for cells, alike in names.items()]
    followed = [speeds for law in study.laws.values() for speeds in law.followed]
    if np.isfinite(np.concatenate(followed)).all() and all(row[INTERVAL] != "–" for row in rows):
        return table([{name: row[name] for name in row if name != "found"} for row in rows])
    note = (
        "*Found*: in how many of the draws the margin changes its sign within a factor "
        f"{REACH:g}. Where that is not in all of them the interval is that of those in which it "
        "is, and has no confidence level of its own. A dash: another critical speed is too near "
        "for them to be told apart."
    )
    return f"{table(rows)}\n\n{note}"


INTERVAL = "95 % interval (m/s)"


def _critical_row(v, followed):
    there = followed[np.isfinite(followed)]
    low, high = np.quantile(there, [0.025, 0.975]) if there.size else (np.nan, np.nan)
    around = low * (1 - CLOSE) <= v <= high * (1 + CLOSE)
    return {
        "critical speed (m/s)": number(v, 4),
        INTERVAL: f"{number(low, 4)} to {number(high, 4)}" if around else "–",
        "found": f"{there.size} of {followed.size}",
    }


def sign_table(study):
    """The verdicts as an engineer may sign them: what the draws say on every law."""
    rows = [
        {
            "v (m/s)": f"{v:g}",
            **{name: _drawn(law, i) for name, law in study.laws.items()},
            "signed": f"**{SIGNED.get(study.signed(i), OPEN)}**",
        }
        for i, v in enumerate(study.asked)
    ]
    n = study.line.share(0).n
    note = (
        "*Kept* and *lost* stand where all draws agree, *kept* with the 95 % interval of the "
        "margin; elsewhere stands the share of draws that lose contact. If "
        f"{n} draws agree, up to {percent(Share(0, n).high)} of doubt is left (the 95 % bound for "
        "as many independent ones). A verdict is signed if every law gives it with less than "
        f"{percent(SURE)} of doubt."
    )
    return f"{table(rows)}\n\n{note}"


def _drawn(law, i):
    """What the draws say of the i-th speed on one law."""
    share, margins = law.share(i), law.margins(i)
    if margins is not None:
        return f"kept, {interval(*margins, decimals=2)}{SPACE}N"
    return "lost" if share.found == share.n else f"{percent(share.value)} lost"


def how_many_signed(study):
    """At how many speeds the verdict of the line is signed, as the answer to a prediction."""
    signed = [v for i, v in enumerate(study.asked) if study.signed(i) is not None]
    n, asked = len(signed), len(study.asked)
    if n == asked:
        return f"**At all {spelled(asked)}.**"
    if n == asked - 1 and n:
        return f"**At {spelled(n)} of them:** {speed_list(signed)}."
    return f"**At fewer:** {speed_list(signed, none='none')}."


def conclusions(study):
    """What an engineer should conclude, in five sentences."""
    critical = survival_sentence({name: law.critical for name, law in study.laws.items()})
    sentences = [_stands(study), _open(study), critical, _readings_or_law(study), _measure(study)]
    return "\n".join(f"{i}. {sentence}" for i, sentence in enumerate(sentences, 1))


def _signed(study, verdict):
    return [v for i, v in enumerate(study.asked) if study.signed(i) is verdict]


def _stands(study):
    stands = [
        f"{word} at {speed_list(_signed(study, verdict))}"
        for verdict, word in SIGNED.items()
        if _signed(study, verdict)
    ]
    if not stands:
        return "None of the asked verdicts can be signed whatever the law is."
    return (
        f"Contact is {join(sorted(stands))}: neither the scatter of the readings nor the choice "
        f"among the {count(len(study.laws), 'law')} changes that."
    )


def _open(study):
    unsure = _signed(study, None)
    beyond = np.extract(study.turned & study.touched, study.asked)
    decided = [v for v in unsure if v in beyond]
    near = [v for v in unsure if v not in decided]
    where = rf"$\delta_{{\max{{}}}}$ = {fixed(1000 * study.delta_max, 1)}{SPACE}mm"
    words = []
    if decided:
        words.append(
            f"At {speed_list(decided)} the verdict is **open**: it is decided by what the spring "
            f"does beyond {where}, and of that there is not one reading."
        )
    if near:
        words.append(
            f"At {speed_list(near)} the verdict is **open**: the margin is too near to zero for "
            "these readings."
        )
    laws = count(len(study.laws), "law")
    return " ".join(words) or f"None of the asked verdicts is left open by these {laws}."


def _readings_or_law(study):
    """Whether the choice of the law or the scatter of the readings decides more verdicts."""
    turned, unsure = (list(np.extract(x, study.asked)) for x in (study.turned, study.unsure))
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
    beyond = np.extract(study.touched, study.asked)
    hangs = np.extract(study.touched & study.turned, study.asked)
    if beyond.size and not hangs.size:
        return (
            f"At {speed_list(beyond)} the spring goes beyond $\\delta_{{\\max{{}}}}$. No verdict "
            "hangs on what it meets there. The forces do: measure where the stop is and how stiff."
        )
    if not beyond.size:
        return (
            r"At none of the asked speeds does the spring go beyond $\delta_{\max{}}$: the stop "
            "does not matter there."
        )
    return (
        f"Before anyone relies on a run at {speed_list(hangs)}, press the spring on to its stop. "
        "Measure where the stop is and how stiff: no reading below it can tell."
    )
