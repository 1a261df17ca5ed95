"""Sentences, tables and captions of Part V and the appendix: runs beside the closed form."""

import numpy as np

from suspension import accuracy
from suspension.contact import is_lost
from suspension.report.rows import table
from suspension.report.words import (
    SPACE,
    Caption,
    count,
    fixed,
    join,
    number,
    quantity,
    speed_list,
)

__all__ = [
    "READINGS",
    "coarse_mode",
    "convergence_caption",
    "dip_caption",
    "heave_caption",
    "missed_sentence",
    "missed_table",
    "observed_orders",
    "panels",
    "power",
    "sampled_caption",
    "sampled_direction",
    "sampled_verdicts",
    "seen_mode_caption",
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
EXACT = 1e-6  # N, a sample of a fine run is the force as far as that
LATE = 0.25  # an observed order further from the promised one is not yet that: a fit scatters less
READINGS = ("state (relative)", "normal force (N)", "time of loss (s)")


def heave_caption(heave, bump):
    """Caption of the exact heave; `heave` is a dict of speed, m/s, to rise above rest, m."""
    rises = join(f"{fixed(1000 * max(y), 1)}{SPACE}mm at {v:g}{SPACE}m/s" for v, y in heave.items())
    return Caption(
        "The exact height of the centre of mass above its rest, against position. A body that "
        f"follows the ground climbs the bump, {fixed(1000 * bump.height, 1)}{SPACE}mm high, twice, "
        "half of it each time; one that is thrown swings on; one that is too fast has hardly begun "
        "to move when the bump is behind it.",
        "Height of the centre of mass relative to rest against position, one curve for each of "
        f"{count(len(heave), 'speed')}. It rises by at most {rises}.",
    )


def sampled_caption(speeds, sampled):
    """Caption of margins read from samples; speeds in m/s, `sampled` as in `sampled_verdicts`."""
    steps = join(f"{number(1000 * dt, 2)}{SPACE}ms" for dt in sampled)
    looked = f"from {number(speeds[0])} to {number(speeds[-1])}{SPACE}m/s"
    return Caption(
        f"The margin {looked}: the least of the samples of one and the same run, taken every "
        f"{steps}, and the exact margin (black).",
        f"Margin against speed, {looked}. The exact margin is one smooth curve. The curves read "
        f"from samples every {steps} lie on it or above it.",
    )


def sampled_direction(sampled, exact):
    """Which way samples are wrong, as the answer to a prediction; arguments of `sampled_verdicts`.

    A sample of the run is the force to a millionth of a newton, or the samples are blamed for it.
    """
    off = np.array(list(sampled.values())) - exact
    high, low = (quantity(most, "N", 2) for most in (max(off.max(), 0), max(-off.min(), 0)))
    looked = f"Of {off.size} least values that were read from samples"
    if off.min() < -EXACT:
        return (
            f"**Either way, here.** {looked} some lie below the exact one, by up to {low}: the run "
            "itself is wrong by that much."
        )
    if off.max() <= EXACT:
        return f"**Too high only.** {looked} none lies below the exact one, and here none above."
    return (
        f"**Too high only.** {looked} none lies below the exact one, and the worst lies {high} "
        "above it."
    )


def sampled_verdicts(sampled, exact):
    """How many verdicts are wrong when the margin is read from samples, and in which way.

    Parameters
    ----------
    sampled : dict of float to array_like, shape (n,)
        For each time between two samples, s, the least of them at n speeds, N.
    exact : array_like, shape (n,)
        The least force at any time, N.
    """
    lost = is_lost(exact)
    wrong = {dt: is_lost(least) != lost for dt, least in sampled.items()}
    told = join(
        f"{flags.sum()} with a sample every {number(1000 * dt, 2)}{SPACE}ms"
        for dt, flags in wrong.items()
    )
    words = f"Wrong verdicts out of {len(lost)}: {told}."
    blamed = np.concatenate([lost[flags] for flags in wrong.values()])
    if not blamed.size:
        return f"{words} That is luck, or these speeds are far from a critical one."
    if blamed.all():
        return f"{words} Every wrong one says *kept* where a wheel leaves the ground."
    return words


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
    readings = join(READINGS[j] for j in shown)
    kept = "" if 2 in shown else " Contact is kept at this speed: there is no time of a loss."
    falls = join(f"with slope about {number(_order(e[:, 0]), 2)} for {s}" for s, e in worst.items())
    return Caption(
        f"Largest error over the run at $v$ = {v:g}{SPACE}m/s against the time step: {readings}, "
        f"the state relative to the largest value of each component.{kept}",
        f"{count(len(shown), 'panel').capitalize()} of error against time step on logarithmic "
        f"axes: {readings}. Over the longest steps the error of the state falls {falls}.",
    )


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
    """Observed orders beside the promised ones, a table.

    Parameters
    ----------
    worst : dict of str to ndarray, shape (n, 3)
        As in `convergence_caption`; each step is half of the one before.
    promised : dict of str to int
        The order of each scheme.
    """
    orders = {name: [_order(errors[:, j]) for j in _shown(worst)] for name, errors in worst.items()}
    rows = [
        {
            "scheme": name,
            "promised": str(promised[name]),
            **{READINGS[j]: fixed(p, 2) for j, p in zip(_shown(worst), ps)},
        }
        for name, ps in orders.items()
    ]
    late = [
        name for name, ps in orders.items() if np.abs(np.array(ps) - promised[name]).max() > LATE
    ]
    note = (
        f"The orders observed for {join(late)} are not yet the promised ones: the longest steps "
        "are too long against the swings of this robot for the first term of the error to rule."
    )
    return table(rows) + (f"\n\n{note}" if late else "")


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
    growing = [name for name, z in seen.items() if z.real[-1] > 0]
    grows = f"the mode grows with {join(growing)}" if growing else "no mode grows"
    alt = (
        "Two panels against the time step: relative frequency and damping ratio of the computed "
        f"mode. At the longest step {grows}."
    )
    return Caption(text, alt)


def coarse_mode(scheme, lam, dt):
    """What a run with a long step shows in the place of a mode, a table.

    Parameters
    ----------
    scheme : Scheme
    lam : complex
        Eigenvalue of the mode, 1/s.
    dt : float
        Time step, s.
    """
    seen = accuracy.seen_mode(scheme, lam, dt * np.geomspace(1e-3, 1, 200))[-1]
    stable = "stable" if scheme.is_stable(np.array([lam]), dt) else "**unstable**"
    shown = {"the robot": lam, f"{scheme.name} at {dt:g}{SPACE}s, {stable}": seen}
    return table(
        [
            {
                "its fastest mode": name,
                "frequency (Hz)": number(z.imag / 2 / np.pi),
                "decay (1/s)": fixed(-z.real, 3),
            }
            for name, z in shown.items()
        ]
    )


def work_account(schemes):
    """What a step of each scheme costs, a table."""
    return table(
        [
            {
                "scheme": scheme.name,
                "evaluations a step": str(
                    accuracy.evaluations(scheme, 2) - accuracy.evaluations(scheme, 1)
                ),
                "a linear system to solve": "yes" if np.triu(scheme.a).any() else "no",
            }
            for scheme in schemes
        ]
    )


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
    never = join(_needed(cost, force, list(cost))[1], "or")
    return Caption(
        text,
        "Error of the normal force against evaluations of the right-hand side, both logarithmic, a "
        f"falling line for each method. Not down to {GOAL:g}{SPACE}N: {never}.",
    )


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
    """The fewest evaluations among the runs tried that are good enough, a table.

    Parameters
    ----------
    cost, force
        As in `work_caption`.
    names : sequence of str
        The methods to compare, with a fixed step.
    """
    ordered, never = _needed(cost, force, names)
    told = {name: str(n) for n, name in ordered}
    told |= {name: f"> {max(cost[name])}" for name in never}
    to_goal = f"evaluations to {GOAL:g}{SPACE}N"
    return table([{"scheme": name, to_goal: n} for name, n in told.items()])


def missed_table(speeds, missed):
    """At how many speeds the watchers overlook a loss of contact.

    Parameters
    ----------
    speeds : array_like
        Speeds, m/s, at which contact is lost for a short time.
    missed : dict of str to list of float
        For each way to run the integrator, the speeds at which it saw no loss.
    """
    if not len(speeds):
        return (
            "With this spring there is no critical speed in the range, so there is no short loss "
            "of contact to be overlooked."
        )
    rows = table([{"integrator": name, "unnoticed": str(len(vs))} for name, vs in missed.items()])
    return (
        f"Of {count(len(speeds), 'speed')} from {number(speeds[0])} to {number(speeds[-1])}{SPACE}"
        f"m/s, beside a critical one, the loss of contact goes unnoticed at\n\n{rows}"
    )


def missed_sentence(coarse, sharp):
    """What a sharper tolerance is worth to an event.

    Parameters
    ----------
    coarse, sharp : sequence of float
        The speeds at which an integrator saw no loss, by itself and by a method of higher order
        with a sharp tolerance.
    """
    promise = (
        "A tolerance bounds the error at the ends of the steps and promises nothing between them."
    )
    if not len(coarse) and not len(sharp):
        return promise
    more = np.sign(len(sharp) - len(coarse))
    return f"The better method misses {('as many', 'more', 'fewer')[more]}. {promise}"


def dip_caption(v, was_missed):
    """Caption of the dip, overlooked or not, at `v` in m/s."""
    how = "does not see" if was_missed else "sees"
    where = "with no step inside the dip" if was_missed else "with a step that ends in the dip"
    return Caption(
        f"A loss of contact at {speed_list([v])} that `solve_ivp` {how} (DOP853, a relative "
        f"tolerance of $10^{{-8}}$), {where}: left the run, right the dip.",
        f"Normal force against time near its minimum: the exact curve dips below zero, {where}.",
    )
