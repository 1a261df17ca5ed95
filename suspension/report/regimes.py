"""Sentences, tables and captions of Parts V and VI and the landing page: when contact is lost.

`regimes` is a `suspension.contact.Regimes` over the speeds looked at, `beyond` what
`suspension.travel.overtravel` finds there: the ranges in which a spring is compressed further than
it was measured. Words tell two of these that nearly touch, to a hundredth, as one.
"""

from typing import NamedTuple

import numpy as np

from suspension.contact import is_lost
from suspension.forces import WHEEL
from suspension.report.data import SPEED_ROW, consequence_rows, speed_digits, speed_row
from suspension.report.rows import table
from suspension.report.words import (
    SPACE,
    Caption,
    confidence,
    count,
    distinct,
    fixed,
    join,
    number,
    percent,
    quantity,
    ranges,
    speed_list,
    spelled,
)

__all__ = [
    "Asked",
    "balance_table",
    "beyond_words",
    "confidence_note",
    "confidence_table",
    "consequence_table",
    "critical_table",
    "doubt",
    "full_geometry",
    "landing_opening",
    "last_speed",
    "lesson",
    "map_caption",
    "margin_caption",
    "other_readings",
    "sensitivity_caption",
    "stays_inside",
    "stronger_dampers",
    "travel_caption",
    "verdict",
]

WIDE = 1.1  # a range of speeds from v to 1.1 v can be driven in; a narrower one is a curiosity
FURTHER = 1.5  # compressions up to this many times the measured one are told in per cent
APART = 1.01  # two ranges, one to v, the other from 1.01 v on, are told as two
SMALL_ANGLE = "../notebooks/06-how-sure.ipynb#and-the-small-angle"
HALVED = 0.05  # a factor so near to two, relative, is called two
ORDINALS = "first second third fourth fifth sixth".split()


class Asked(NamedTuple):
    """What there is to say about an asked speed.

    Attributes
    ----------
    v : float
        m/s.
    margin : float
        By the asked stiffness, N.
    stretch : float
        The largest compression of a spring before a loss over that at which it was measured.
    flips : sequence of float
        Stiffnesses at which the verdict turns, N/m.
    lost : dict of str to float
        For each reading of the data by name the confidence that contact is lost, 0 to 1.
    """

    v: float
    margin: float
    stretch: float
    flips: tuple
    lost: dict


def landing_opening(regimes):
    """What the first lines of the book promise: whether the answer is what one expects."""
    answers = {
        (False, True): "With this spring that is the answer.",
        (False,): "With this spring they do not, at any speed that was looked at.",
        (True,): "With this spring they do at every speed that was looked at.",
        (True, False): "With this spring it is the other way round.",
    }
    answer = answers.get(tuple(regimes.lost.tolist()), "The answer is stranger.")
    return f"One would expect: above some speed. {answer}"


def verdict(regimes, beyond=()):
    """Where contact is kept and lost, and where going faster is safer."""
    words = [f"Contact is {ranges(regimes)}."]
    name = dict(zip(regimes.edges, distinct(regimes.edges)))
    for start, end in regimes.regained:
        if end > WIDE * start:
            words.append(
                f"Going faster than {name[start]}{SPACE}m/s is *safer* than going a little slower."
            )
        elif end < regimes.edges[-1]:
            words.append(
                f"From {name[start]} to {name[end]}{SPACE}m/s it is kept by a hair, in a range "
                "too narrow to drive in."
            )
    where = beyond_words(regimes, beyond)
    if where:
        words.append(
            f"All this holds **if the spring stays linear** further than it was measured: {where}."
        )
    return " ".join(words)


def beyond_words(regimes, beyond):
    """Where in the range looked at a spring is compressed further than measured, and by how much.

    Empty if nowhere.
    """
    low, high = regimes.edges[[0, -1]]
    told = []
    for found in beyond:
        if found.high <= low or found.low >= high:
            continue
        if told and found.low < APART * told[-1].high:
            before = told.pop()
            times = max(before.times, found.times)
            found = found._replace(low=before.low, times=times)
        told.append(found)
    return join([_where(found, low, high) + _further(found.times) for found in told], none="")


def _where(found, low, high):
    """The part of [low, high], m/s, that lies in a range, in words."""
    if found.low <= low and found.high >= high:
        return f"at every speed from {low:g} to {high:g}{SPACE}m/s"
    if found.low <= low:
        return f"below {number(found.high)}{SPACE}m/s"
    if found.high >= high:
        return f"above {number(found.low)}{SPACE}m/s"
    return f"from {number(found.low)} to {number(found.high)}{SPACE}m/s"


def _further(times):
    """By how much a compression exceeds the measured ones, from their ratio."""
    if times < FURTHER:
        return f" (by up to {percent(times - 1)})"
    return f" (up to {number(times, 2)} times as far)"


def margin_caption(regimes, beyond, asked=()):
    """Caption of the least forces against speed."""
    marks = [
        ("shaded and marked *lost*: a wheel leaves the ground", regimes.lost.any()),
        ("diamonds: critical speeds", len(regimes.critical)),
        ("circles: speeds of the problem set", len(asked)),
        (r"hatched: a spring is compressed further than measured, $\delta_{\max}$", len(beyond)),
    ]
    drawn = "; ".join(mark for mark, there in marks if there)
    text = "The exact least force of each wheel against speed"
    alt = (
        "Least normal force of the rear and the front wheel against speed on a logarithmic axis. "
        f"Contact is {ranges(regimes)}."
    )
    where = beyond_words(regimes, beyond)
    if where:
        alt += f" Hatched {where}: there a spring is compressed further than it was measured."
    return Caption(f"{text} ({drawn})." if drawn else f"{text}.", alt)


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
    return table(
        [
            {
                "critical speed (m/s)": name,
                "wheel": WHEEL[parts.wheel],
                "spring (N)": fixed(parts.spring, 2),
                "damper (N)": fixed(parts.damper, 2),
                "what happens": "the damper pulls" if parts.pulled else "the body is thrown",
            }
            for parts, name in zip(balances, distinct(critical), strict=True)
        ]
    )


def stronger_dampers(before, after, still):
    """What dampers twice as strong do to the verdicts, and to a wheel under a body that is still.

    Parameters
    ----------
    before, after : Regimes
        With the robot's own dampers, and with twice as strong ones.
    still : pair of float
        Speeds, m/s, at which a wheel is pulled off under a body that does not move, before, after.
    """
    names = "the robot's own", "twice as strong"
    return table(
        [
            {
                "dampers": name,
                "contact is": ranges(found),
                "under a still body, lost from (m/s)": number(v),
            }
            for name, found, v in zip(names, (before, after), still, strict=True)
        ]
    )


def last_speed(before, after):
    """What dampers twice as strong do to the last critical speed, as the answer to a prediction.

    Parameters
    ----------
    before, after : Regimes
        With the robot's own dampers, and with twice as strong ones.
    """
    if not (len(before.critical) and len(after.critical)):
        return "**There is none to compare:** one verdict holds in the whole range."
    old, new = before.critical[-1], after.critical[-1]
    told = f"from {number(old)} to {number(new)}{SPACE}m/s"
    factor = old / new
    if factor <= 1:
        answer = f"**It does not fall:** it goes {told}."
    elif abs(factor / 2 - 1) < HALVED:
        answer = f"**It is halved, too,** {told}."
    else:
        much = "more" if factor > 2 else "less"
        answer = f"**It falls by {much},** {told}: by a factor of {number(factor, 2)}."
    if len(before.regained) and not len(after.regained):
        answer += " The window before it has closed."
    return answer


def critical_table(intervals, full):
    """Critical speeds with their intervals, and where they do not exist.

    Parameters
    ----------
    intervals : sequence of suspension.uncertainty.CriticalSpeed
    full : sequence of float or None
        Each of them in the full geometry, m/s, as `suspension.small_angle.full_geometry` finds it;
        None where there is none.
    """
    if not intervals:
        return "There is no critical speed in the range, whatever the stiffness in its interval."
    rows = [_critical_row(c, v) for c, v in zip(intervals, full, strict=True)]
    if all(c.everywhere for c in intervals):
        return table([{name: row[name] for name in row if name != "note"} for row in rows])
    note = (
        "Where a critical speed does not exist for every stiffness in the interval of $k$, what is "
        "given is the range it covers as long as it exists; that range has no confidence level of "
        "its own."
    )
    return f"{table(rows)}\n\n{note}"


def _critical_row(critical, full):
    speed, low, high = critical.speed, critical.low, critical.high
    half = "–"
    if speed is not None and critical.everywhere:
        half = percent((high - low) / 2 / speed) if high > low else "0"
    moved = "–" if full is None else number(full, speed_digits(low, high))
    row = speed_row(critical)
    note = row.pop("note")
    return row | {"relative half-width": half, "in the full geometry (m/s)": moved, "note": note}


def stays_inside(intervals, full):
    """Do critical speeds stay inside their intervals in the full geometry? Answers a prediction.

    Parameters
    ----------
    intervals, full
        As in `critical_table`.
    """
    inside = [
        moved is not None and critical.low <= moved <= critical.high
        for critical, moved in zip(intervals, full, strict=True)
        if critical.speed is not None
    ]
    if not inside:
        return "**There is none to ask.**"
    if all(inside):
        return "**Each does.**"
    if not any(inside):
        return "**All leave it.**"
    return f"**Some leave it:** {spelled(inside.count(False))} of {spelled(len(inside))}."


def full_geometry(intervals, full):
    """Whether the small pitch costs a critical speed more than its interval allows.

    Parameters
    ----------
    intervals, full
        As in `critical_table`.
    """
    pairs = [(c, v) for c, v in zip(intervals, full, strict=True) if c.speed is not None]
    if not pairs:
        return "There is no critical speed that another geometry could move."
    words = []
    for critical, moved in pairs:
        digits = speed_digits(critical.low, critical.high)
        name = f"{number(critical.speed, digits)}{SPACE}m/s"
        if moved is None:
            words.append(f"{name} has no counterpart nearby")
        elif not critical.low <= moved <= critical.high:
            change = percent(abs(moved / critical.speed - 1))
            way = "up" if moved > critical.speed else "down"
            words.append(f"{name} moves {way} by {change}, **out of** its interval")
    if words:
        return (
            f"In the full geometry {join(words)}: there the small angle costs more than the "
            "readings leave open."
        )
    return (
        "In the full geometry every critical speed stays inside its interval: here the small angle "
        "costs less than the readings leave open."
    )


def consequence_table(by_stiffness):
    """The critical speeds of each stiffness, with their intervals.

    A row for each stiffness if all have as many critical speeds, and these are there for every
    stiffness in its interval; else a row for each critical speed.

    Parameters
    ----------
    by_stiffness : sequence of (Stiffness, sequence of CriticalSpeed)
        From `suspension.uncertainty.critical_speeds_by_stiffness`.
    """
    rows = consequence_rows(by_stiffness)
    speed, interval, note = SPEED_ROW
    n = {len(speeds) for _, speeds in by_stiffness}
    unlike = len(n) > 1 or not 0 < max(n) <= len(ORDINALS)
    if unlike or any(row[note] != "–" or row[speed] == "–" for row in rows):
        return table(rows)
    wide = {}
    for row in rows:
        found = wide.setdefault(row["stiffness"], {"stiffness": row["stiffness"]})
        ends = row[interval].replace(" ", SPACE)  # a line ends before the bracket
        found[f"{ORDINALS[len(found) - 1]} (m/s)"] = f"{row[speed]} ({ends})"
    return table(list(wide.values()))


def other_readings(by_stiffness):
    """Whether another stiffness of the data moves a critical speed out of the first one's interval.

    Parameters
    ----------
    by_stiffness : sequence of (Stiffness, sequence of CriticalSpeed)
        From `suspension.uncertainty.critical_speeds_by_stiffness`, the asked stiffness first.
    """
    asked, *others = [[c for c in speeds if c.speed is not None] for _, speeds in by_stiffness]
    name = by_stiffness[0][0].name
    if any(len(speeds) != len(asked) for speeds in others):
        return "The stiffnesses do not even agree on how many critical speeds there are."
    if not asked:
        return "With none of the stiffnesses is there a critical speed in the range."
    outside = [
        number(own.speed, speed_digits(own.low, own.high))
        for own, *moved in zip(asked, *others, strict=True)
        if not all(own.low <= c.speed <= own.high for c in moved)
    ]
    if outside:
        return (
            f"Another stiffness moves {join(outside)}{SPACE}m/s **out of** the interval of the "
            f"{name}."
        )
    return (
        "With either of the other stiffnesses each critical speed stays inside the interval of the "
        f"{name}."
    )


def confidence_table(asked):
    """For each `Asked` speed: margin, use of the spring, where the verdict flips, confidence.

    After a loss the ground of the linear model pulls: such a margin is a sign and no quantity.
    """
    rows = []
    for speed in asked:
        mark = "*" if speed.stretch > 1 else ""
        rows.append(
            {
                "v (m/s)": f"{speed.v:g}",
                "margin (N)": ("lost" if is_lost(speed.margin) else fixed(speed.margin, 2)) + mark,
                r"spring, of $\delta_{\max}$": fixed(speed.stretch, 2),
                "verdict flips at k (N/m)": join([number(k, 4) for k in speed.flips]),
                **{
                    f"confidence that contact is lost, with $k$ = the {name}": confidence(p) + mark
                    for name, p in speed.lost.items()
                },
            }
        )
    return table(rows)


def confidence_note(asked, stiffness):
    """On which stiffness, N/m, and on which spring, the table of the `Asked` speeds rests."""
    words = (
        "The margins, and where the verdict flips, are those of the stiffness asked for, "
        f"{quantity(stiffness, 'N/m', 4)}; the confidence is given for each way to read the "
        "stiffness from the data."
    )
    beyond = [speed.v for speed in asked if speed.stretch > 1]
    if beyond:
        words += (
            f" The asterisk, at {speed_list(beyond)}, marks what holds only **if the spring stays "
            r"linear** beyond $\delta_{\max}$; no confidence level includes that doubt."
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
    beyond = r" Hatched: a spring is compressed beyond $\delta_{\max}$." if hatched else ""
    return Caption(
        "The margin over speed and stiffness. On the black line the verdict turns. Dashed, with "
        f"band: the fitted stiffness (the {stiffness.name}) and its 95 % interval; marked there: "
        f"the {count(len(asked), 'asked speed')}.{beyond}",
        f"Map of the margin over speed and stiffness, from {number(k[0])} to {number(k[-1])}{SPACE}"
        "N/m: red where contact is lost, blue where it is kept, a black line between. A band marks "
        f"{number(low)} to {number(high)}{SPACE}N/m around the fitted stiffness."
        + (" A hatched region marks springs compressed further than measured." if hatched else ""),
    )


def sensitivity_caption(critical):
    """Caption of the sensitivities of the critical speeds."""
    text = "By how many per cent each critical speed moves when a parameter grows by one per cent."
    if not len(critical):
        return Caption(
            "There is no critical speed in the range: the axes stay empty.", "Empty axes."
        )
    return Caption(
        text,
        "Bar chart: per cent change of each critical speed for one per cent more stiffness, "
        f"damping, mass, moment of inertia and wheel distance, at {speed_list(critical)}.",
    )


def travel_caption(regimes, beyond, delta_max):
    """Caption of the largest compression and pitch over the speeds looked at."""
    where = beyond_words(regimes, beyond)
    return Caption(
        "Largest compression of a spring (left) and largest pitch (right) while both wheels press "
        "on the ground. Dashed: the largest displacement at which the spring was measured.",
        "Left: largest spring compression against speed with a dashed line at "
        f"{fixed(1000 * delta_max, 1)}{SPACE}mm, the largest measured displacement. It lies "
        f"{f'above the line {where}' if where else 'below the line'}. Right: largest pitch.",
    )


def doubt(regimes, beyond, delta_max, tilt):
    """Where the verdicts rest on a spring that was never measured, and how far the body tilts.

    Parameters
    ----------
    delta_max : float
        Largest displacement at which the spring was measured, m.
    tilt : float
        Largest pitch while both wheels press, rad.
    """
    limit = rf"$\delta_{{\max}}$ = {fixed(1000 * delta_max, 1)}{SPACE}mm"
    where = beyond_words(regimes, beyond)
    spring = f"No spring is compressed beyond {limit}, where its measurement ends."
    if where:
        spring = (
            f"While both wheels still press, a spring is compressed beyond {limit} {where}. "
            "There the verdicts are those of a spring that stays linear further than anyone has "
            "measured."
        )
    sine, cosine = percent(1 - np.sinc(tilt / np.pi)), percent(1 - np.cos(tilt))
    return (
        f"{spring} As long as both wheels press, the pitch stays below {_up(np.degrees(tilt))} "
        rf"degrees, where $\sin\theta$ and $\theta$ differ by {sine}, $\cos\theta$ and 1 by "
        f"{cosine} ([what that does to the critical speeds]({SMALL_ANGLE})). "
        "[In the air](../notebooks/07-flight.ipynb) it is another matter."
    )


def _up(x):
    """One decimal, rounded up: a bound must stay one."""
    return fixed(np.ceil(10 * x) / 10, 1)


def lesson(regimes, balances):
    """What the ranges teach, in one line; `balances` as in `balance_table`."""
    if not len(regimes.critical):
        return "With this spring one verdict holds at all speeds. Only the numbers could tell."
    flies = "do fly" if regimes.lost.tolist() == [False, True] else "do not simply fly"
    words = (
        f"With this spring the wheels {flies} above some speed. Resonance throws the body, a short "
        "bump spares it"
    )
    if any(balance.pulled for balance in balances):
        words += ", and the damper, meant to hold the robot down, pulls a wheel off the ground"
    return f"{words}. Only the numbers tell which of these decides at a speed."
