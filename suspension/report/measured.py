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
    "conclusions",
    "critical_table",
    "draws_sentence",
    "geometry_sentence",
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
]

ALIKE = 0.05  # laws nearer than this part of the largest force hardly differ
CLOSE = 1e-3  # critical speeds of different runs agree within this part
OPEN, SIGNED = "open", {True: "lost", False: "kept"}


# --- the law, at rest -----------------------------------------------------------------------------


def law_caption(fit, at_rest, farthest):
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
        f"Four laws for one spring. Where it was measured {where} Beyond "
        rf"$\delta_{{\max{{}}}}$ (grey) each is an assumption{goes}"
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
    note = (
        rf"**The robot rests beyond $\delta_{{\max{{}}}}$** on: {join(beyond)}. With a stop it "
        "stands on it before it has driven a step."
    )
    return f"{table(rows)}\n\n{note}" if beyond else table(rows)


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


def aftermath_table(asked, runs, delta_max):
    """What a ground that only pushes does to the robot where some law loses contact."""
    rows = [
        {"v (m/s)": f"{v:g}", **{name: _felt(run, i, delta_max) for name, run in runs.items()}}
        for i, v in enumerate(asked)
        if not all(run.kept[i] for run in runs.values())
    ]
    if not rows:
        return "No law loses contact at an asked speed."
    note = (
        "The largest acceleration of the body; the largest compression of a spring, in units of "
        r"$\delta_{\max{}}$; and how long rear and front wheel are in the air, in ms."
    )
    return f"{table(rows)}\n\n{note}"


def _felt(run, i, delta_max):
    acceleration = f"{number(run.acceleration[i])}{SPACE}m/s²"
    air = " and ".join(fixed(1000 * t, 1) if t else "0" for t in run.airtime[:, i])
    return f"{acceleration}; {fixed(run.compression[i] / delta_max, 2)}; {air}"


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
    """Which critical speeds of the line are there on every law; `critical` by law, m/s."""
    line = next(iter(critical.values()))
    kept = surviving(critical.values())
    gone = [v for v in line if v not in kept]
    if not len(line):
        found = [name for name, speeds in critical.items() if len(speeds)]
        others = f"; there are some on: {join(found)}." if found else ", and no other law has one."
        return f"The line has no critical speed in the range{others}"
    if not gone:
        return "Every critical speed of the line is there on all laws."
    stay = f"only {speed_list(kept)} {_verb('stay', kept)}" if kept else "none stays"
    return (
        f"Of the line's critical speeds {stay} on all laws; {speed_list(gone)} "
        f"{_verb('belong', gone)} to a spring that nobody has measured."
    )


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
    """At which stop over spring stiffness the verdict turns, if at all; `turns` by speed."""
    steady = [v for v, ratios in turns.items() if not len(ratios)]
    words = []
    if steady:
        words = [f"At {speed_list(steady)} the verdict is the same with every stop that was tried."]
    words += [
        f"At {speed_list([v])} it turns at {join(number(r) for r in ratios)} times the stiffness "
        "of the spring."
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


def draws_sentence(kept, drawn, linear):
    """How many draws are those of a spring; `linear`: the readings do not contradict a line."""
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


def critical_table(study):
    """Critical speeds of every law with their intervals."""
    rows = [
        _critical_row(name, v, followed)
        for name, law in study.laws.items()
        for v, followed in zip(law.critical, law.followed)
    ]
    if not rows:
        return "No law has a critical speed in the range."
    note = (
        "*Found*: in how many of the draws the margin changes its sign within a factor "
        f"{REACH:g}. Where that is not in all of them the interval is that of those in which it "
        "is, and has no confidence level of its own. A dash: another critical speed is too near "
        "for them to be told apart."
    )
    return f"{table(rows)}\n\n{note}"


def _critical_row(name, v, followed):
    there = followed[np.isfinite(followed)]
    low, high = np.quantile(there, [0.025, 0.975]) if there.size else (np.nan, np.nan)
    around = low * (1 - CLOSE) <= v <= high * (1 + CLOSE)
    return {
        "law": name,
        "critical speed (m/s)": number(v, 4),
        "95 % interval (m/s)": f"{number(low, 4)} to {number(high, 4)}" if around else "–",
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
        "In a row: what is not known about the model. In a cell: what is not known about its "
        "parameters. *Kept*: in all draws, with the 95 % interval of the margin; *lost*: in all "
        "draws; else the share of draws in which contact is lost. "
        f"{n} draws that agree leave up to {percent(Share(0, n).high)} of doubt, "
        "the 95 % bound for as many independent ones. Signed is what every law says with less than "
        f"{percent(SURE)} of doubt."
    )
    return f"{table(rows)}\n\n{note}"


def _drawn(law, i):
    """What the draws say of the i-th speed on one law."""
    share, margins = law.share(i), law.margins(i)
    if margins is not None:
        return f"kept, {interval(*margins, decimals=2)}{SPACE}N"
    return "lost" if share.found == share.n else f"{percent(share.value)} lost"


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
        "among the four laws changes that."
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
    return " ".join(words) or "None of the asked verdicts is left open by these four laws."


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
    if not beyond.size:
        return (
            r"At none of the asked speeds does the spring go beyond $\delta_{\max{}}$: the stop "
            "does not matter there."
        )
    return (
        f"Before anyone relies on a run at {speed_list(beyond)}, press the spring on to its stop "
        "and measure where that is and how stiff: no reading below it can tell."
    )
