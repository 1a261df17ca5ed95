"""Sentences, tables and captions of Part V and the landing page: at which speeds contact is lost.

In all of them `edges` are the critical speeds between the ends of the range looked at, m/s, shape
(n + 1,), `lost` says for each of the n ranges between them whether contact is lost, and `beyond`
holds the ranges of speed in which a spring is compressed further than it was measured, m/s,
shape (m, 2). Words tell ranges of it that nearly touch, to a hundredth, as one.
"""

import numpy as np

from suspension.forces import WHEEL
from suspension.report.data import existence, speed_digits
from suspension.report.rows import table
from suspension.report.words import (
    SPACE,
    Caption,
    confidence,
    count,
    fixed,
    join,
    number,
    percent,
    quantity,
    speed_list,
)

__all__ = [
    "afterwards",
    "balance_table",
    "beyond_words",
    "confidence_note",
    "confidence_table",
    "critical_table",
    "crossings",
    "doubt",
    "landing_data",
    "landing_opening",
    "lesson",
    "map_caption",
    "margin_caption",
    "other_readings",
    "sensitivity_caption",
    "strongest",
    "travel_caption",
    "verdict",
]

WIDE = 1.1  # a range of speeds from v to 1.1 v can be driven in; a narrower one is a curiosity
APART = 1.01  # two ranges, one to v, the other from 1.01 v on, are told as two


def landing_opening(lost):
    """What the first lines of the book promise: whether the answer is what one expects."""
    expected = "One would expect: above some speed."
    lost = list(map(bool, lost))
    if lost == [False, True]:
        return f"{expected} With this spring that is the answer."
    if lost == [False]:
        return f"{expected} With this spring they do not, at any speed that was looked at."
    if lost == [True]:
        return f"{expected} With this spring they do at every speed that was looked at."
    if lost == [True, False]:
        return f"{expected} With this spring it is the other way round."
    return f"{expected} The answer is stranger."


def landing_data(note):
    """On which spring the numbers rest; `note` says that the data are synthetic, or is empty."""
    return note or "The spring is one that was measured, not the synthetic one of this project."


def verdict(edges, lost, beyond=(), most=None):
    """Where contact is kept and lost, and where going faster is safer.

    Parameters
    ----------
    most : sequence of float, length m, optional
        The largest compression in each range of `beyond`, over that at which it was measured.
    """
    words = [f"Contact is {_ranges(edges, lost)}."]
    names = _names(edges)
    wide = [edges[i + 1] > WIDE * edges[i] for i in range(len(lost))]
    for i in range(1, len(lost)):
        if not lost[i] and wide[i]:
            words.append(
                f"Going faster than {names[i]}{SPACE}m/s is *safer* than going a little slower."
            )
        elif not lost[i] and i < len(lost) - 1:
            words.append(
                f"From {names[i]} to {names[i + 1]}{SPACE}m/s it is kept by a hair, in a range too "
                "narrow to drive in."
            )
    where = beyond_words(edges[0], edges[-1], beyond, most)
    if where:
        words.append(
            f"All this holds **if the spring stays linear**: {where} it is compressed further "
            "than it was measured."
        )
    return " ".join(words)


def crossings(edges, lost):
    """How often the margin crosses zero, and whether going faster ever makes a robot safer."""
    low, high = (f"{v:g}" for v in (edges[0], edges[-1]))
    crossed = len(lost) - 1
    times = {1: "once", 2: "twice"}.get(crossed) or count(crossed, "time")
    if len(lost) == 1:
        side = "below" if lost[0] else "above"
        return (
            f"With this spring the margin does not cross zero at all from {low} to "
            f"{high}{SPACE}m/s: it stays {side}."
        )
    names = _names(edges)
    upward = [names[i] for i in range(1, len(lost)) if not lost[i]]
    if not upward:
        return (
            f"With this spring the margin crosses zero {times} from {low} to {high}{SPACE}m/s, "
            "and only downwards."
        )
    return (
        f"With this spring the margin crosses zero {times} from {low} to {high}{SPACE}m/s, and "
        f"upwards at {join(upward)}{SPACE}m/s: a little above, the robot is safer than a little "
        "below."
    )


def _names(edges):
    """Speeds with so many digits, three or more, that neighbours can be told apart."""
    edges = np.asarray(edges, dtype=float)
    gaps = np.diff(edges) / edges[1:]
    nearest = np.minimum(np.append(gaps, 1), np.insert(gaps, 0, 1))
    digits = np.maximum(3, 1 + np.ceil(-np.log10(nearest)).astype(int))
    return [number(v, d) for v, d in zip(edges, digits)]


def _ranges(edges, lost):
    names = _names(edges)
    if len(lost) == 1:
        low, high = (f"{v:g}" for v in edges)
        return f"{'lost' if lost[0] else 'kept'} at every speed from {low} to {high}{SPACE}m/s"
    words = []
    for i, gone in enumerate(lost):
        if i == 0:
            where = f"up to {names[1]}{SPACE}m/s"
        elif i == len(lost) - 1:
            where = "from there on"
        else:
            where = f"from {names[i]} to {names[i + 1]}{SPACE}m/s"
        words.append(f"{'lost' if gone else 'kept'} {where}")
    return join(words)


def beyond_words(low, high, beyond, most=None):
    """Where in [low, high], m/s, a spring is compressed further than measured, or "".

    With `most`, as in `verdict`, also by how much.
    """
    most = [None] * len(beyond) if most is None else most
    told = []
    for (a, b), size in zip(beyond, most, strict=True):
        if b <= low or a >= high:
            continue
        if told and a < APART * told[-1][1]:
            start, _, before = told.pop()
            told.append((start, b, size and max(before, size)))
        else:
            told.append((a, b, size))
    return join([_where(low, high, a, b) + _further(size) for a, b, size in told], none="")


def _where(low, high, a, b):
    """The part of [low, high] that lies between a and b, in words."""
    if a <= low and b >= high:
        return f"at every speed from {low:g} to {high:g}{SPACE}m/s"
    if a <= low:
        return f"below {number(b)}{SPACE}m/s"
    if b >= high:
        return f"above {number(a)}{SPACE}m/s"
    return f"from {number(a)} to {number(b)}{SPACE}m/s"


def _further(size):
    """By how much a compression exceeds the measured ones, from their ratio."""
    if size is None:
        return ""
    if size < 1.5:
        return f" (by up to {percent(size - 1)})"
    return f" (up to {number(size, 2)} times as far)"


def margin_caption(edges, lost, beyond, asked=()):
    """Caption of the least forces against speed."""
    critical = edges[1:-1]
    text = "The exact least force of each wheel against speed."
    if any(lost):
        text += " Where either is negative (marked *lost*) a wheel leaves the ground."
    if len(critical):
        text += " Diamonds: the critical speeds."
    if len(asked):
        text += f" Circles: the {count(len(asked), 'speed')} of the problem set."
    if len(beyond):
        text += (
            r" Hatched: a spring is compressed beyond $\delta_{\max}$, the largest displacement at "
            "which it was measured."
        )
    alt = (
        "Least normal force of the rear and the front wheel against speed on a logarithmic axis. "
        f"Contact is {_ranges(edges, lost)}."
    )
    where = beyond_words(edges[0], edges[-1], beyond)
    if where:
        alt += f" Hatched {where}, where a spring is compressed further than it was measured."
    return Caption(text, alt)


def balance_table(critical, balances):
    """What the least force is the sum of, at each critical speed, and what that means.

    Parameters
    ----------
    critical : sequence of float
        Critical speeds, m/s.
    balances : sequence of suspension.travel.Balance
    """
    if not len(critical):
        return "There is no critical speed in the range, and so no balance of this kind."
    rows = []
    for speed, name in zip(balances, _names(critical)):
        rows.append(
            {
                "critical speed (m/s)": name,
                "wheel": WHEEL[speed.wheel],
                "spring (N)": fixed(speed.spring, 2),
                "damper (N)": fixed(speed.damper, 2),
                "what happens": "the damper pulls" if _pulls(speed) else "the body is thrown",
            }
        )
    pulled = [v for v, parts in zip(critical, balances) if _pulls(parts)]
    thrown = [v for v, parts in zip(critical, balances) if not _pulls(parts)]
    words = []
    if thrown:
        words.append(
            f"At {speed_list(thrown)} the spring has all but reached its full length when the "
            "force vanishes: the body has risen away from the wheel."
        )
    if pulled:
        words.append(
            f"At {speed_list(pulled)} the spring is still compressed, and pushes; it is the "
            "damper that takes away what the spring gives."
        )
    return "\n\n".join([table(rows), " ".join(words)])


def _pulls(balance):
    """Whether a compressed spring is overcome by the damper: a newton is a seventh of the load."""
    return balance.spring > 1.0


def afterwards(changed, speeds, extra):
    """What happens after X = 1.25 m.

    Parameters
    ----------
    changed : sequence of float
        Speeds, m/s, of those looked at, at which the verdict is another one in a longer run.
    speeds : array_like
        All that were looked at.
    extra : float
        How much longer the runs were, s.
    """
    looked = (
        f"continued by {extra:g}{SPACE}s, at {count(len(speeds), 'speed')} from "
        f"{speeds[0]:.3g} to {speeds[-1]:.3g}{SPACE}m/s"
    )
    if not len(changed):
        return (
            f"Does it matter that the runs end at X = 1.25 m? No: {looked}, no verdict changes. "
            "What is going to happen happens on the way."
        )
    return (
        f"Does it matter that the runs end at X = 1.25 m? **Yes:** {looked}, the verdict turns "
        f"from kept to lost at {_few(changed)}. There contact is lost in the swing "
        "that the bump leaves behind, beyond the end of the asked runs."
    )


def _few(speeds):
    if len(speeds) <= 3:
        return speed_list(speeds)
    ends = f"{number(min(speeds))} and {number(max(speeds))}{SPACE}m/s"
    return f"{count(len(speeds), 'speed')} between {ends}"


def critical_table(intervals):
    """Critical speeds with their intervals, and where they do not exist.

    Parameters
    ----------
    intervals : sequence of suspension.uncertainty.CriticalSpeed
    """
    if not intervals:
        return "There is no critical speed in the range, whatever the stiffness in its interval."
    rows = [_critical_row(c) for c in intervals]
    if all(c.everywhere for c in intervals):
        return table([{name: row[name] for name in row if name != "note"} for row in rows])
    note = (
        "Where a critical speed does not exist for every stiffness in the interval of $k$, what is "
        "given is the range it covers as long as it exists; that range has no confidence level of "
        "its own."
    )
    return f"{table(rows)}\n\n{note}"


def _critical_row(critical):
    speed, low, high = critical.speed, critical.low, critical.high
    relative = (high - low) / high
    digits = int(np.clip(1 + np.ceil(-np.log10(relative)), 3, 6)) if relative > 0 else 4
    half = "–"
    if speed is not None and critical.everywhere:
        half = percent((high - low) / 2 / speed) if high > low else "0"
    return {
        "critical speed (m/s)": "–" if speed is None else number(speed, digits),
        "95 % interval (m/s)": f"{number(low, digits)} to {number(high, digits)}",
        "relative half-width": half,
        "note": existence(critical) or "–",
    }


def other_readings(by_stiffness):
    """What becomes of each critical speed of the asked stiffness by the other readings of the data.

    Parameters
    ----------
    by_stiffness : sequence of (Stiffness, sequence of CriticalSpeed)
        From `suspension.uncertainty.critical_speeds_by_stiffness`, the asked stiffness first.
    """
    found = [[c for c in speeds if c.speed is not None] for _, speeds in by_stiffness]
    asked, *others = found
    names = join([f"the {stiffness.name}" for stiffness, _ in by_stiffness[1:]], "or")
    if len({len(speeds) for speeds in found}) > 1:
        return "The readings do not even agree on how many critical speeds there are."
    if not asked:
        return "By none of the readings is there a critical speed in the range."
    words, outside = [], []
    for own, *moved in zip(asked, *others):
        digits = speed_digits(own.low, own.high)
        name = number(own.speed, digits)
        words.append(f"{name} becomes {join([number(c.speed, digits) for c in moved], 'or')}")
        if not all(own.low <= c.speed <= own.high for c in moved):
            outside.append(name)
    where = "each of them inside the interval that belongs to the asked stiffness"
    if outside:
        where = (
            f"and what becomes of {join(outside)} lies **outside** the asked stiffness's interval"
        )
    return f"By {names}, {join(words)}{SPACE}m/s, {where}."


def confidence_table(margins, ratios, flips, lose):
    """For each asked speed: margin, use of the spring, where the verdict flips, confidence.

    Parameters
    ----------
    margins, ratios : dict of float to float
        For each speed, m/s: the margin, N, and the largest compression of a spring before a loss
        over that at which it was measured.
    flips : dict of float to sequence of float
        Stiffnesses at which the verdict turns, N/m.
    lose : dict of str to dict of float to float
        For each stiffness by name the confidence that contact is lost, 0 to 1.
    """
    rows = []
    for v in margins:
        mark = "*" if ratios[v] > 1 else ""
        rows.append(
            {
                "v (m/s)": f"{v:g}",
                "margin (N)": fixed(margins[v], 2) + mark,
                r"spring, of $\delta_{\max}$": fixed(ratios[v], 2),
                "verdict flips at k (N/m)": join([number(k, 4) for k in flips[v]]),
                **{f"lost, by the {name}": confidence(p[v]) + mark for name, p in lose.items()},
            }
        )
    return table(rows)


def confidence_note(ratios, asked_stiffness, names):
    """On which stiffness, and on which spring, the table rests."""
    words = (
        "The margins, and where the verdict flips, are those of the asked stiffness, the "
        f"parabola's slope at zero, {quantity(asked_stiffness, 'N/m', 4)}. The confidence that "
        f"contact is lost is given for each reading of the data by itself: the {join(names)}."
    )
    beyond = [v for v, ratio in ratios.items() if ratio > 1]
    if beyond:
        words += (
            f" An asterisk, at {speed_list(beyond)}: **if the spring stays linear** beyond "
            r"$\delta_{\max}$; the regression knows nothing about it there, and no confidence "
            "level includes that doubt."
        )
    return words


def map_caption(stiffness, k, asked, hatched):
    """Caption of the map of the margin.

    Parameters
    ----------
    stiffness : suspension.springs.Stiffness
        The asked one, which is marked.
    k : array_like
        Stiffnesses of the map, N/m.
    asked : sequence of float
        Speeds that are marked, m/s.
    hatched : bool
        Whether there is a hatched region.
    """
    low, high = stiffness.interval()
    text = (
        "The margin over speed and stiffness. On the black line the verdict turns. Dashed, with "
        f"band: the fitted stiffness (the {stiffness.name}) and its 95 % interval; circles: the "
        f"{count(len(asked), 'asked speed')}."
    )
    alt = (
        f"Map of the margin over speed and stiffness, from {number(k[0])} to "
        f"{number(k[-1])}{SPACE}N/m: "
        "red where contact is lost, blue where it is kept, a black line between. A horizontal "
        f"band marks {number(low)} to {number(high)}{SPACE}N/m around the fitted "
        f"{number(stiffness.value)}{SPACE}N/m."
    )
    if hatched:
        text += r" Hatched: a spring is compressed beyond $\delta_{\max}$."
        alt += " A hatched region marks springs compressed further than measured."
    return Caption(text, alt)


def sensitivity_caption(critical):
    """Caption of the sensitivities of the critical speeds."""
    if not len(critical):
        text = "There is no critical speed in the range: nothing to move, the axes stay empty."
        return Caption(text, "Empty axes, because there is no critical speed in the range.")
    return Caption(
        "By how many per cent each critical speed moves when a parameter grows by one per cent.",
        "Bar chart: per cent change of each critical speed for one per cent more stiffness, "
        f"damping, mass, moment of inertia and wheel distance, at {speed_list(critical)}.",
    )


def strongest(critical, percent):
    """To which parameter each critical speed answers most.

    Parameters
    ----------
    critical : sequence of float
        Critical speeds, m/s.
    percent : dict of str to sequence of float
        For each parameter, the per cent by which each moves for one per cent of it.
    """
    if not len(critical):
        return "Without a critical speed there is nothing that could answer."
    most = [max(percent, key=lambda name: abs(percent[name][i])) for i in range(len(critical))]
    names = _names(critical)
    which = "The critical speed answers" if len(critical) == 1 else "The critical speeds answer"
    words = join(
        f"{name} at {v}{SPACE}m/s ({fixed(percent[name][i], 2)}{SPACE}% per 1{SPACE}%)"
        for i, (v, name) in enumerate(zip(names, most))
    )
    return f"{which} most strongly to {words}."


def travel_caption(edges, beyond, delta_max):
    """Caption of the largest compression and pitch, over speeds in [edges[0], edges[-1]]."""
    text = (
        "Largest compression of a spring (left) and largest pitch (right) while both wheels press "
        "on the ground. Dashed: the largest displacement at which the spring was measured."
    )
    where = beyond_words(edges[0], edges[-1], beyond)
    above = f"It lies above the line {where}." if where else "It stays below the line."
    alt = (
        "Left: largest spring compression against speed with a dashed line at "
        f"{fixed(1000 * delta_max, 1)}{SPACE}mm, the largest measured displacement. {above} Right: "
        "largest pitch angle against speed."
    )
    return Caption(text, alt)


def doubt(edges, beyond, ratios, at_rest, delta_max, tilt):
    """Where the verdicts rest on a spring that was never measured, and how far the body tilts.

    Parameters
    ----------
    ratios : dict of float to float
        Largest compression at some speeds, m/s, over `delta_max`.
    at_rest : float
        The same of the robot that stands still.
    delta_max : float
        Largest displacement at which the spring was measured, m.
    tilt : float
        Largest pitch while both wheels press, rad.
    """
    limit = rf"$\delta_{{\max}}$ = {fixed(1000 * delta_max, 1)}{SPACE}mm"
    where = beyond_words(edges[0], edges[-1], beyond)
    words = []
    if at_rest > 1:
        words.append(
            f"**Even at rest** the robot compresses its springs to {fixed(at_rest, 2)} times "
            f"{limit}: it is too heavy for this spring as far as it was measured, and every "
            "number about the drive is an extrapolation."
        )
    elif where:
        words.append(
            f"A spring is compressed beyond {limit}, before or without a loss of contact, {where}. "
            "There the verdicts are those of a spring that stays linear further than anyone has "
            "measured."
        )
    else:
        words.append(f"No spring is compressed beyond {limit}, as far as it was measured.")
    each = join(f"{fixed(r, 2)} at {v:g}{SPACE}m/s" for v, r in ratios.items())
    words.append(rf"In units of $\delta_{{\max}}$ the largest compressions are {each}.")
    words.append(
        f"As long as both wheels press, the pitch stays below {_up(np.degrees(tilt))} degrees, "
        rf"where $\sin\theta$ and $\theta$ differ by {percent(tilt**2 / 6, 1)}; "
        "[in the air](../notebooks/06-flight.ipynb) it is another matter."
    )
    return " ".join(words)


def _up(x):
    """One decimal, rounded up: a bound must stay one."""
    return fixed(np.ceil(10 * x) / 10, 1)


def lesson(lost, balances):
    """What the ranges teach, in one line; `balances` as in `balance_table`."""
    pulls = any(map(_pulls, balances))
    if list(map(bool, lost)) == [False, True]:
        return (
            "With this spring the wheels do fly above some speed. That they do was not to be "
            "known beforehand: resonance throws the body, a short bump spares it, a fast damper "
            "pulls at it, and only the numbers tell what comes of the three."
        )
    if len(lost) == 1:
        return "With this spring one verdict holds at all speeds. Only the numbers could tell."
    words = (
        "The wheels do not simply fly above some speed. Resonance throws the body, a short bump "
        "spares it"
    )
    if pulls:
        return (
            f"{words}, and the damper, meant to hold the robot down, is what loses the ground at "
            "the highest speeds."
        )
    return f"{words}."
