"""The experiments of the page with the sliders, in words that fit the spring."""

import numpy as np

from suspension.frequency import speed_in_step
from suspension.problem import SPEEDS
from suspension.report.words import (
    ROUNDOFF,
    SPACE,
    fixed,
    join,
    number,
    quantity,
    ranges,
    speed_list,
)
from suspension.schemes import CRANK_NICOLSON, RK4

__all__ = ["answers", "experiments", "presets"]

SLOW, MIDDLE, FAST, _ = SPEEDS


def experiments(robot, critical, flips, limit, slider):
    """Five experiments, a numbered list.

    Parameters
    ----------
    robot : Robot
    critical : sequence of float
        Critical speeds within the slider's range, m/s.
    flips : sequence of float
        Stiffnesses at which the verdict turns at the third asked speed, within the slider's range,
        N/m.
    limit : float
        Largest stable step of RK4, s.
    slider : sequence of float
        Time steps that can be chosen, s.
    """
    texts = [_faster(critical), _blow_up(limit, slider), _wrong(slider), _spring(flips)]
    swing = _in_step(robot)
    if swing:
        texts.append(swing)
    return "\n".join(f"{i}. {text}" for i, text in enumerate(texts, 1))


def answers(robot, regimes, flips, soft_lost, limit, slider):
    """What the experiments show, a numbered list.

    Parameters
    ----------
    robot, flips, limit, slider
        As for `experiments`.
    regimes : suspension.contact.Regimes
        Where contact is kept and lost within the slider's range of speeds.
    soft_lost : bool
        Whether contact is lost at the third asked speed with the softest spring of the slider.
    """
    texts = [
        _safer(regimes),
        _leaves_first(robot, limit, slider),
        _another_answer(robot, max(slider)),
        _stiffness(flips, soft_lost),
    ]
    speed = speed_in_step(robot)
    if speed is not None:
        texts.append(
            f"**{quantity(speed, 'm/s')} builds it up**: kicks a whole period apart add, kicks "
            "half a period apart cancel. That is [the comb of Part IX](09-filter.ipynb)."
        )
    return "\n".join(f"{i}. {text}" for i, text in enumerate(texts, 1))


def _safer(regimes):
    return f"**{'Sometimes' if len(regimes.regained) else 'No'}.** Contact is {ranges(regimes)}."


def _leaves_first(robot, limit, slider):
    if not any(dt > limit for dt in slider):
        return "**None**: every step of the slider is stable."
    own = [RK4.max_stable_dt(np.array([lam, lam.conj()])) for lam in robot.eigenvalues]
    first = int(np.argmin(own))
    lam = robot.eigenvalues[first]
    name = "heave" if robot.heave_share[first] > 0.5 else "pitch"
    if lam.imag == 0:
        return f"**One of the {name}**, on the real axis: it decays fastest."
    return (
        f"**The two of the {name}**, which swings at {number(abs(lam.imag) / 2 / np.pi)}{SPACE}Hz: "
        "they are conjugate, and leave it together."
    )


def _another_answer(robot, dt):
    lam = max(robot.eigenvalues, key=lambda lam: abs(lam))
    seen = np.log(CRANK_NICOLSON.stability_function(lam * dt)) / dt
    decays = f"decays with {number(-lam.real + 0.0)} per second, in the run with "
    decays += f"{number(-seen.real + 0.0)}"
    if lam.imag == 0:
        return f"**The decay is another one.** The fastest mode {decays}."
    return (
        "**Frequency and damping are others.** The fastest mode swings at "
        f"{number(abs(lam.imag) / 2 / np.pi)}{SPACE}Hz, in the run at "
        f"{number(abs(seen.imag) / 2 / np.pi)}{SPACE}Hz; it {decays}."
    )


def _stiffness(flips, soft_lost):
    if not len(flips):
        return (
            f"**Neither does it**: contact is {'lost' if soft_lost else 'kept'} with every spring "
            "of the slider."
        )
    if len(flips) > 1:
        return f"**Both do it**: the verdict turns {len(flips)} times."
    side, where = ("Stiffer", "from {} on") if soft_lost else ("Softer", "up to {}")
    return f"**{side}.** Contact is kept with springs {where.format(quantity(flips[0], 'N/m'))}."


def presets(robot, flips, limit, slider):
    """The same experiments as buttons of an explorer.

    Parameters
    ----------
    robot, flips, limit, slider
        As for `experiments`.

    Returns
    -------
    presets : list of (label, settings)
    """
    long = float(min((dt for dt in slider if dt > limit), default=max(slider)))
    wrong = {"v": MIDDLE, "dt": float(max(slider)), "scheme": "Crank-Nicolson"}
    found = [
        ("Faster, safer?", {"v": SLOW}),
        ("Blow it up" if long > limit else "The longest step", {"v": MIDDLE, "dt": long}),
        ("Stable, wrong", wrong),
        ("The spring", {"v": FAST} | ({"k": float(flips[0])} if len(flips) else {})),
    ]
    speed = speed_in_step(robot)
    if speed is not None:
        found += [("In step", {"v": speed}), ("Out of step", {"v": 2 * speed})]
    return found


def _set(text, **settings):
    """A phrase that sets the page's picture: a link that the explorer follows.

    >>> _set("at 1.2 m/s", v=1.2, scheme="RK4")
    '[at 1.2 m/s](#explore:v=1.2&scheme=RK4)'
    """
    parts = [
        f"{name}={value:.10g}" if isinstance(value, float) else f"{name}={value}"
        for name, value in settings.items()
    ]
    return f"[{text}](#explore:{'&'.join(parts)})"


def _faster(critical):
    start = (
        f"**Faster, and safer?** Step 1 ms, stiffness as fitted. Push v "
        f"{_set(f'from {SLOW:g} m/s', v=SLOW)} to the end and watch the least force: its sign "
    )
    if not len(critical):
        return start + "does not turn anywhere on the slider."
    return start + f"turns at {speed_list(critical)}."


def _blow_up(limit, slider):
    start = f"**Blow it up.** {_set(f'RK4 at v = {MIDDLE:g} m/s', v=MIDDLE, scheme='RK4')}. "
    longer = [dt for dt in slider if dt > limit]
    if not longer:
        return start + (
            "Lengthen the step to the end of the slider: every step there is shorter than the "
            f"largest stable one, {_ms(limit)}, and nothing blows up. Soften or stiffen the spring "
            "and watch the four points move."
        )
    first = min(longer)
    long = _set(_ms(first), v=MIDDLE, scheme="RK4", dt=float(first))
    last = max((dt for dt in slider if dt <= limit), default=None)
    if last is None:
        step = f"to {long}"
    else:
        step = f"from {1000 * last:g} to {long}"
    return start + (
        f"Lengthen the step {step}: the largest stable one is {_ms(limit)}. Which of the four "
        "points leaves the region first?"
    )


def _wrong(slider):
    same = _set("with Crank-Nicolson", v=MIDDLE, dt=float(max(slider)), scheme="Crank-Nicolson")
    return (
        f"**Stable, and wrong.** The same {same}, up to {_ms(max(slider))}. Nothing blows up. "
        "Compare with the broad pale curve, the exact force."
    )


def _spring(flips):
    start = (
        f"**Choose the spring.** {_set(f'At v = {FAST:g} m/s', v=FAST)}, step 1 ms, soften and "
        "stiffen the spring. "
    )
    if not len(flips):
        return start + "The verdict stays, but the margin does not: how close does it come to zero?"
    places = join(_set(number(k), v=FAST, k=float(k)) for k in flips)
    return start + f"The verdict turns at {places}{SPACE}N/m."


def _in_step(robot):
    """The speeds at which the rear wheel meets the bump in or out of step with the heave."""
    one = speed_in_step(robot)
    if one is None:
        return ""
    return (
        f"**In step, out of step.** Compare {_set(f'v = {number(one)}', v=one)} with "
        f"{_set(f'{number(2 * one)}{SPACE}m/s', v=2 * one)}: the rear "
        "wheel meets the bump one heave period, or half of one, after the front wheel. One builds "
        "the heave up, the other takes it away."
    )


def _ms(t):
    """A time in milliseconds, with as many decimals as it needs.

    >>> _ms(0.05), _ms(0.0743633)
    ('50\\xa0ms', '74.4\\xa0ms')
    """
    is_whole = abs(1000 * t - round(1000 * t)) < ROUNDOFF
    return f"{fixed(1000 * t, 0 if is_whole else 1)}{SPACE}ms"
