"""Sentences, tables and captions of Part V and the appendix: runs beside the closed form."""

import numpy as np

from suspension import accuracy
from suspension.contact import is_lost
from suspension.report.rows import table
from suspension.report.words import SPACE, Caption, count, fixed, join, number, quantity, speed_list

__all__ = [
    "READINGS",
    "coarse_mode",
    "convergence_caption",
    "dip_caption",
    "half_turn",
    "heave_caption",
    "missed_table",
    "observed_orders",
    "panels",
    "power",
    "sampled_caption",
    "sampled_verdicts",
    "seen_mode_caption",
    "witness",
    "work_account",
    "work_caption",
    "work_verdict",
]


def power(x):
    """A power of ten, as mathematics.

    >>> power(1e-12)
    '$10^{-12}$'
    """
    return f"$10^{{{round(np.log10(x))}}}$"


GOAL = 0.01  # N, an error of a force that is small beside the weight on a wheel
READINGS = ("state (relative)", "normal force (N)", "time of loss (s)")


def heave_caption(heave, bump):
    """Caption of the exact heave; `heave` is a dict of speed, m/s, to rise above rest, m."""
    rises = join(f"{fixed(1000 * max(y), 1)}{SPACE}mm at {v:g}{SPACE}m/s" for v, y in heave.items())
    text = (
        "The exact height of the centre of mass above its rest, against position. It rises by at "
        f"most {rises}; the bump is {fixed(1000 * bump.height, 1)}{SPACE}mm high. A body that "
        "follows "
        "the ground climbs it twice, half the height each time; one that is thrown swings on; one "
        "that is too fast has hardly begun to move when the bump is behind it."
    )
    alt = (
        "Height of the centre of mass relative to rest against position, one curve for each of "
        f"{count(len(heave), 'speed')}. The largest rises are {rises}."
    )
    return Caption(text, alt)


def sampled_caption(speeds, sampled):
    """Caption of margins that were read from samples; arguments as in `sampled_verdicts`."""
    steps = join(f"{number(1000 * dt, 2)}{SPACE}ms" for dt in sampled)
    looked = f"from {number(speeds[0])} to {number(speeds[-1])}{SPACE}m/s"
    return Caption(
        f"The margin {looked}: the least of the samples of one and the same run, taken every "
        f"{steps}, and the exact margin (black).",
        f"Margin against speed, {looked}. The exact margin is one smooth curve. The curves read "
        f"from samples every {steps} lie on it or above it.",
    )


def sampled_verdicts(speeds, sampled, exact):
    """How many verdicts are wrong when the margin is read from samples.

    Parameters
    ----------
    speeds : array_like, shape (n,)
        m/s, in order.
    sampled : dict of float to array_like, shape (n,)
        For each time between two samples, s, the least of them, N.
    exact : array_like, shape (n,)
        The least force at any time, N.
    """
    lost = is_lost(exact)
    wrong = {dt: int((is_lost(least) != lost).sum()) for dt, least in sampled.items()}
    looked = (
        f"{count(len(speeds), 'speed')} from {number(speeds[0])} to {number(speeds[-1])}{SPACE}m/s"
    )
    if not any(wrong.values()):
        return (
            f"At {looked} no verdict is wrong. That is luck, not method: with this spring no dip "
            "at these speeds is shorter than the time between two samples."
        )
    each = join(
        f"{n} with a sample every {number(1000 * dt, 2)}{SPACE}ms" for dt, n in wrong.items()
    )
    return (
        f"Of the verdicts at {looked} so many are wrong: {each}. The samples say "
        "kept where a wheel leaves the ground."
    )


def witness(differences, tolerance):
    """Whether an independent integrator agrees with the closed form.

    Parameters
    ----------
    differences : sequence of float
        Largest difference for each speed, SI units.
    tolerance : float
        That of the integrator.
    """
    worst = max(differences)
    bound = 10.0 ** np.ceil(np.log10(max(worst, 1e-10)))
    agree = "They agree" if worst < 1e-9 else "**They do not agree**"
    than = "less" if worst <= bound else "more"
    return (
        f"{agree}: at {count(len(differences), 'speed')} the states differ by {than} than "
        f"{power(bound)} in SI units, with the integrator's tolerance at "
        f"{power(tolerance)}."
    )


def convergence_caption(worst, v):
    """Caption of the convergence plots.

    Parameters
    ----------
    worst : dict of str to ndarray, shape (n, 3)
        For each scheme the errors in the `READINGS`, nan where there is none.
    v : float
        Speed, m/s.
    """
    shown = _shown(worst)
    names = {
        0: "the state (each component relative to its largest value)",
        1: "the normal forces",
        2: "the time at which contact is lost",
    }
    panels = join(names[j] for j in shown)
    kept = "" if 2 in shown else " Contact is kept at this speed: there is no time of a loss."
    text = (
        f"Largest error over the run at $v$ = {v:g}{SPACE}m/s against the time step, for "
        f"{panels}.{kept}"
    )
    falls = join(f"with slope about {number(_order(e[:, 0]), 2)} for {s}" for s, e in worst.items())
    alt = (
        f"{count(len(shown), 'panel').capitalize()} of error against time step on logarithmic "
        f"axes, for {panels}. Over the longest steps the error of the state falls {falls}."
    )
    return Caption(text, alt)


def panels(worst):
    """The errors by reading, those that exist; `worst` as in `convergence_caption`.

    Returns
    -------
    panels : dict of str to dict of str to ndarray, shape (n,)
        For each of the `READINGS` the errors of each scheme.
    """
    return {READINGS[j]: {name: e[:, j] for name, e in worst.items()} for j in _shown(worst)}


def _shown(worst):
    """The readings that exist: without a loss of contact there is no time of one."""
    errors = np.array(list(worst.values()))
    return [j for j in range(errors.shape[2]) if np.isfinite(errors[:, :, j]).sum(axis=1).min() > 1]


def _order(errors):
    """Observed order when each step is half of the one before, over the five longest."""
    return accuracy.fitted_order(0.5 ** np.arange(5), errors[:5])


def observed_orders(worst, promised):
    """Table of observed orders and what they mean.

    Parameters
    ----------
    worst : dict of str to ndarray, shape (n, 3)
        As in `convergence_caption`; each step is half of the one before.
    promised : dict of str to int
        The order of each scheme.
    """
    shown = _shown(worst)
    orders = {name: [_order(errors[:, j]) for j in shown] for name, errors in worst.items()}
    rows = [
        {
            "scheme": name,
            "promised": str(promised[name]),
            **{READINGS[j]: fixed(p, 2) for j, p in zip(shown, ps)},
        }
        for name, ps in orders.items()
    ]
    off = {name: max(abs(p - promised[name]) for p in ps) for name, ps in orders.items()}
    late = [name for name in off if off[name] > 0.25]
    if late:
        meaning = (
            f"The orders observed for {join(late)} are not yet the promised ones: the longest "
            "steps are too long against the swings of this robot for the first term of the error "
            "to rule."
        )
    else:
        meaning = (
            "The order of a method is not a promise about the state only: everything read from it "
            "inherits it, as long as the reading itself (here: a spline through the samples) is "
            "as good."
        )
    return "\n\n".join(
        [
            "Observed orders, fitted over the five longest steps:",
            table(rows),
            meaning + " Halving a step divides the error by two to the power of the order, until "
            "it meets the rounding of the method's own additions, below which shorter steps only "
            "add more of them.",
        ]
    )


def seen_mode_caption(seen, dts, true):
    """Caption of the mode as the methods see it; arguments as in `figures.plot_seen_mode`."""
    over = {name: accuracy.half_turn(z, dts) for name, z in seen.items()}
    passed = join(f"{name} at {number(1000 * dt)}{SPACE}ms" for name, dt in over.items() if dt)
    crossing = (
        "No method's frequency passes Nyquist's."
        if passed == "none"
        else f"The frequency passes Nyquist's for {passed}."
    )
    text = (
        f"The fastest mode ({quantity(true.imag / 2 / np.pi, 'Hz')}) as "
        f"{count(len(seen), 'method')} see it: frequency relative to the true one (left; thin "
        "line: the highest that samples so far apart can show, Nyquist's) and damping ratio "
        f"(right; thin line: the true one). Below zero the run grows. {crossing}"
    )
    ends = join(f"{number(z.imag[-1] / true.imag, 2)} with {name}" for name, z in seen.items())
    growing = [name for name, z in seen.items() if z.real[-1] > 0]
    grows = f"the mode grows with {join(growing)}" if growing else "no mode grows"
    alt = (
        "Two panels against the time step: relative frequency and damping ratio of the computed "
        f"mode. At the longest step the relative frequency is {ends}, and {grows}."
    )
    return Caption(text, alt)


def half_turn(seen, dts, true):
    """Where RK4 turns a mode over in every step, with its damping and without.

    Parameters
    ----------
    seen, dts, true
        As in `figures.plot_seen_mode`, of RK4 alone.
    """
    dt = accuracy.half_turn(seen, dts)
    if dt is None:
        return "In [the figure](#fig-damping) RK4 does not reach that line."
    undamped = np.sqrt(6) / true.imag
    return (
        f"For the fastest mode $\\sqrt6/\\omega$ is {number(1000 * undamped)}{SPACE}ms; in [the "
        f"figure](#fig-damping), where it is damped, RK4 crosses the line at "
        f"{number(1000 * dt)}{SPACE}ms."
    )


def coarse_mode(scheme, lam, dt):
    """What a run with a stable but long step shows in the place of a mode.

    Parameters
    ----------
    scheme : Scheme
    lam : complex
        Eigenvalue of the mode, 1/s.
    dt : float
        Time step, s.
    """
    seen = accuracy.seen_mode(scheme, lam, dt * np.geomspace(1e-3, 1, 200))[-1]
    stable = scheme.is_stable(np.array([lam]), dt)
    how = "absolutely stable as it is" if stable else "where it is not even stable"
    here = f"At $\\Delta t$ = {dt:g}{SPACE}s, {how}, {scheme.name}"
    if lam.imag <= 0:
        shown = f"{here} gives a mode that does not swing"
    else:
        shown = (
            f"{here} shows a mode of {number(seen.imag / 2 / np.pi)}{SPACE}Hz where the robot has "
            f"{number(lam.imag / 2 / np.pi)}{SPACE}Hz"
        )
    if abs(lam.real) < 1e-9 * abs(lam):
        decay = ", and like the robot's it does not decay"
        if abs(seen.real) > 1e-9 * abs(lam):
            decay = ", and changes its size, which the robot's does not"
    elif seen.real >= 0:
        decay = ", and does not let it decay at all"
    elif seen.real > lam.real:
        decay = f", and lets it decay {number(lam.real / seen.real)} times too slowly"
    else:
        decay = f", and lets it decay {number(seen.real / lam.real)} times too fast"
    tame = " It returns a tame answer to another question." if stable else ""
    return f"{shown}{decay}.{tame}"


def work_account(schemes):
    """What a step of each scheme costs, a table and the rule of counting."""
    rows = [
        {
            "scheme": scheme.name,
            "evaluations a step": str(
                accuracy.evaluations(scheme, 2) - accuracy.evaluations(scheme, 1)
            ),
            "a linear system to solve": "no" if _explicit(scheme) else "yes",
        }
        for scheme in schemes
    ]
    return "\n\n".join(
        [
            "A stage that begins where the last step ended has been evaluated already and is not "
            "counted again. So a step of Crank-Nicolson costs one new evaluation, not two:",
            table(rows),
        ]
    )


def _explicit(scheme):
    return not np.triu(scheme.a).any()


def work_caption(cost, force, v, tolerances):
    """Caption of error against work.

    Parameters
    ----------
    cost, force : dict of str to array_like, shape (n,)
        Evaluations, and the largest error of the normal force, N, for each method.
    v : float
        Speed, m/s.
    tolerances : sequence of float
        Of the adaptive methods, the loosest first.
    """
    text = (
        f"Largest error of the normal force at $v$ = {v:g}{SPACE}m/s against evaluations of the "
        "right-hand side: methods with a fixed step, and adaptive ones from SciPy at tolerances "
        f"from {power(tolerances[0])} to {power(tolerances[-1])}."
    )
    ordered, never = _needed(cost, force, list(cost))
    alt = "Error of the normal force against evaluations of the right-hand side, both logarithmic."
    if len(ordered) > 1:
        alt += (
            f" The fewest evaluations to an error of {GOAL:g}{SPACE}N are those of "
            f"{ordered[0][1]}, the "
            f"most those of {ordered[-1][1]}."
        )
    if never:
        alt += f" It is not reached by {join(never)}."
    return Caption(text, alt)


def _needed(cost, force, names):
    """The fewest evaluations to an error of `GOAL`, (number, name) in order, and who never does."""
    ordered, never = [], []
    for name in names:
        good = np.asarray(cost[name])[np.asarray(force[name]) <= GOAL]
        if good.size:
            ordered.append((int(good.min()), name))
        else:
            never.append(name)
    return sorted(ordered), never


def work_verdict(cost, force, names):
    """Which of the tried runs are good enough, and what the cheapest of them costs.

    Parameters
    ----------
    cost, force
        As in `work_caption`.
    names : sequence of str
        The methods to compare, with a fixed step.
    """
    ordered, never = _needed(cost, force, names)
    if not ordered:
        return f"No run that was tried comes within {GOAL:g}{SPACE}N of the truth."
    costs = join(f"{n} evaluations with {name}" for n, name in ordered)
    words = (
        f"To come within {GOAL:g}{SPACE}N of the truth, the number of steps doubled until it is "
        "reached, "
        f"takes {costs}"
    )
    if never:
        most = max(max(cost[name]) for name in never)
        words += f". With {join(never, 'or')} it is not reached in {most}"
    return f"{words}."


def missed_table(speeds, missed, shown=None, force=None):
    """At how many speeds the watchers overlook a loss of contact.

    Parameters
    ----------
    speeds : array_like
        Speeds, m/s, at which contact is lost for a short time.
    missed : dict of str to list of float
        For each way to run the integrator, the speeds at which it saw no loss.
    shown, force : float, optional
        The speed in the figure, m/s, and its margin, N.
    """
    if not len(speeds):
        return (
            "With this spring there is no critical speed in the range, so there is no short loss "
            "of contact to be overlooked."
        )
    parts = [
        f"Of {count(len(speeds), 'speed')} from {number(speeds[0])} to "
        f"{number(speeds[-1])}{SPACE}m/s, "
        "beside a critical one, the loss of contact goes unnoticed at",
        table([{"integrator": name, "unnoticed": str(len(vs))} for name, vs in missed.items()]),
    ]
    if not any(missed.values()):
        parts.append(
            "With this spring the dips at these speeds last longer than a step, and every one is "
            "seen. That is luck, not method: nothing in the integrator looks between its steps."
        )
    if shown is not None:
        parts.append(
            f"The figure shows {speed_list([shown])}, where the force falls to "
            f"{number(force, 2)}{SPACE}N. [The exact margin]"
            "(../notebooks/05-how-we-know.ipynb#the-exact-margin) does not depend on where a "
            "method happens to stop."
        )
    return "\n\n".join(parts)


def dip_caption(v, was_missed):
    """Caption of the dip, overlooked or not, at `v` in m/s."""
    if was_missed:
        text = (
            "A loss of contact that `solve_ivp` does not see (DOP853, a relative tolerance of "
            f"$10^{{-8}}$) at {speed_list([v])}: left the run, right the dip. Every step is right; "
            "the force goes below zero between two of them."
        )
        where = "dips below zero between two neighbouring steps of the integrator, both above zero"
    else:
        text = (
            f"A short loss of contact at {speed_list([v])}, seen by `solve_ivp` (DOP853, a "
            "relative tolerance of $10^{-8}$) because one of its steps ends in the dip: "
            "left the run, right the dip."
        )
        where = "dips below zero, and a step of the integrator ends within the dip"
    return Caption(text, f"Normal force against time near its minimum: the exact curve {where}.")
