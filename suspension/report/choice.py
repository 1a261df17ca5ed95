"""Sentences, tables and captions of Part VIII: the robot as a filter, a choice of suspension.

A suspension is a robot, of which stiffness and damping, alike on both axles, are told.
"""

import numpy as np

from suspension.contact import Regimes
from suspension.report.rows import mode_name, table
from suspension.report.words import (
    SPACE,
    Caption,
    count,
    fixed,
    join,
    number,
    percent,
    quantity,
    ranges,
    speed_list,
)

__all__ = [
    "beaten",
    "best_table",
    "between",
    "choice_table",
    "conclusions",
    "cost",
    "demands_caption",
    "drive_links",
    "exclusion_words",
    "filter_table",
    "front_caption",
    "gains_caption",
    "margins_caption",
    "needed",
    "ripples_caption",
    "rms_caption",
    "robust_table",
    "robust_words",
    "rough_caption",
    "rough_table",
    "rough_words",
]

ALMOST = 0.2  # of a logarithm: a fifth more or less
SHOWN = 0.005  # N; a margin closer to zero is shown as zero
SURE = 1.5  # times as steep as the steepest chord: below that a grid says little


def filter_table(robot, asked):
    """Which wavelengths set heave and pitch swinging at each speed, and what the comb says.

    Parameters
    ----------
    robot : Robot
        Symmetric.
    asked : sequence of float
        Speeds, m/s.
    """
    swinging = {mode_name(robot, i): abs(z.imag) for i, z in enumerate(robot.eigenvalues)}
    combs = {"heave": np.cos, "pitch": np.sin}
    rows = []
    for v in asked:
        row = {"v (m/s)": f"{v:g}"}
        for name, comb in combs.items():
            if not swinging.get(name):
                continue
            omega = swinging[name]
            row[f"{name} swings over waves of (m)"] = number(2 * np.pi * v / omega)
            row[f"comb, {name}"] = fixed(abs(comb(omega * robot.L1 / v)), 2)
        rows.append(row)
    return table(rows)


def gains_caption(speeds, base):
    """Caption of the gains; `speeds` are drawn, m/s, and `base` is the wheelbase, m."""
    which = speed_list(speeds)
    return Caption(
        f"The robot as a filter at {which}: heave (left) and pitch (right) over the height of a "
        "sine wave in the road. Each speed has its resonance. Dotted, at the same wavelengths for "
        "all: what the wheelbase does not let through.",
        f"Two panels over wavelength: gain of heave and of pitch at {which}. Each curve has a peak "
        "that moves to longer waves as the speed grows, and falls to zero at the same wavelengths: "
        f"heave at twice the wheelbase, {number(2 * base)}{SPACE}m, and odd fractions of that, "
        f"pitch at the wheelbase, {number(base)}{SPACE}m, and its whole fractions.",
    )


def ripples_caption(v):
    """Caption of the margin above the swings left behind, over speeds `v`, m/s."""
    return Caption(
        "Above: the margin of Part V. Below: the swings that the bump leaves behind in heave and "
        "pitch, from its spectrum (lines), from the closed form (symbols), and without the comb "
        "(dotted).",
        f"Two panels over speed from {number(v[0])} to {number(v[-1])}{SPACE}m/s. Above the "
        "margin, wavy at low speed. Below the swings in heave and pitch: each ripples below a "
        "smooth dotted curve; where one mode is quiet the other tends to be loud.",
    )


def cost(cases, steps, error):
    """What the maps took; `error` is how far their margins are from exact ones at most, N."""
    return (
        f"The maps are {cases} runs of {steps} steps each, all in one loop. Their margins are "
        f"sampled; on every fifth suspension each way they are off the exact ones by at most "
        f"{number(error, 2)}{SPACE}N."
    )


def best_table(maps, k, c, limit):
    """The best suspension of a map in each criterion, and what it is in the two others.

    Parameters
    ----------
    maps : suspension.choice.Demands
    k, c : array_like, shapes (n,) and (m,)
        N/m, N s/m.
    limit : float
        Largest displacement at which the spring was measured, m.
    """
    best = {
        "the most contact": maps.margin.argmax(),
        "the least acceleration": maps.acceleration.argmin(),
        "the least travel": maps.compression.argmin(),
    }
    rows = []
    for name, place in best.items():
        i, j = np.unravel_index(place, maps.margin.shape)
        rows.append(
            {
                "best in": name,
                "k (N/m)": number(k[j]),
                "c (N s/m)": number(c[i], 2),
                "margin (N)": fixed(maps.margin[i, j], 1),
                "acceleration (m/s²)": fixed(maps.acceleration[i, j], 1),
                "compression (mm)": fixed(1000 * maps.compression[i, j], 1),
                r"of $\delta_{\max}$": fixed(maps.compression[i, j] / limit, 1),
            }
        )
    return table(rows)


def demands_caption(names):
    """Caption of the three maps; `names` are those of the marked suspensions."""
    return Caption(
        "The worst over the four asked speeds, for every stiffness and damping: least margin, "
        "largest acceleration of the body, largest compression of a spring. White line: margin "
        f"zero. Marks: {join(names)}.",
        "Three maps over stiffness and damping on logarithmic axes. The margin is positive only "
        "for soft springs with weak dampers; acceleration is small there and grows towards stiff "
        "springs and strong dampers; compression is largest for the softest springs and smallest "
        f"for strong dampers. Marked: {join(names)}.",
    )


def front_caption(kept, total):
    """Caption of the front; `kept` of `total` best compromises keep contact."""
    return Caption(
        f"The best compromises: no other suspension of the map is better in one criterion and as "
        f"good in the others. {count(kept, 'of them keeps', 'of them keep').capitalize()} contact "
        f"at all four speeds. Where contact is lost, the numbers are those of a ground that pulls.",
        f"Scatter of {total} suspensions, margin against compression, coloured by acceleration. "
        "The margin is positive only at the largest compressions, where acceleration is smallest.",
    )


def beaten(robot, better):
    """Whether the present suspension is among the best compromises.

    Parameters
    ----------
    robot : Robot
    better : (float, float) or None
        A suspension that is better in all three criteria, k and c, N/m and N s/m.
    """
    if better is None:
        return (
            f"The present suspension, {quantity(robot.k1, 'N/m')} and "
            f"{quantity(robot.c1, 'N s/m')}, is a best compromise itself: none of the map is "
            "better in all three."
        )
    k, c = better
    present = f"{quantity(robot.k1, 'N/m')} and {quantity(robot.c1, 'N s/m')}"
    other = f"{quantity(k, 'N/m')} and {quantity(c, 'N s/m')}"
    return (
        f"The present suspension, {present}, is none of them: with {other}, for example, *all* "
        "three would be better."
    )


def choice_table(choices, margins, peaks, limit):
    """The suspensions beside each other: their margins, then what they ask for.

    Parameters
    ----------
    choices : dict of str to Robot
    margins : dict of str to dict of float to float
        For each the margins at the asked speeds, N.
    peaks : dict of str to tuple
        For each the largest acceleration, m/s^2, and compression, m, over the asked speeds.
    limit : float
        Largest displacement at which the spring was measured, m.
    """
    first, second = [], []
    for name, other in choices.items():
        acceleration, compression = peaks[name]
        first.append(
            {
                "suspension": name,
                "k (N/m)": number(other.k1),
                "c (N s/m)": number(other.c1),
                **{f"{v:g}{SPACE}m/s": fixed(m, 2) for v, m in margins[name].items()},
            }
        )
        second.append(
            {
                "suspension": name,
                "largest acceleration (m/s²)": fixed(acceleration, 1),
                r"at rest, of $\delta_{\max}$": fixed(-other.equilibrium[0] / limit, 2),
                r"at most, of $\delta_{\max}$": fixed(compression / limit, 2),
            }
        )
    return "\n\n".join(
        [
            "Margins in N at the asked speeds:",
            table(first),
            "and what the suspensions ask for, acceleration and compression of the springs:",
            table(second),
        ]
    )


def needed(robot, least, asked, reserve=0.0):
    """The cheapest change that keeps contact, in words.

    Parameters
    ----------
    robot : Robot
    least : suspension.choice.Choice or None
    asked : sequence of float
        Speeds, m/s.
    reserve : float
        N.
    """
    what = f"contact at {speed_list(asked)}"
    if reserve:
        what += f" with {quantity(reserve, 'N', 2)} to spare"
    if least is None:
        return f"**No suspension of the grid** keeps {what}."
    if least.distance == 0:
        return (
            f"**No change is needed** for {what}: the robot as it is keeps it, with a margin of "
            f"{quantity(least.margin, 'N')}."
        )
    new = least.robot
    softer = "softer" if new.k1 < robot.k1 else "stiffer"
    weaker = "weaker" if new.c1 < robot.c1 else "stronger"
    return (
        f"The cheapest change for {what}: springs of {quantity(new.k1, 'N/m')} in place of "
        f"{quantity(robot.k1, 'N/m')}, {softer}, and dampers of {quantity(new.c1, 'N s/m')} in "
        f"place of {quantity(robot.c1, 'N s/m')}, {weaker}; distance {fixed(least.distance, 2)}."
    )


def exclusion_words(found, low, high, asked, own):
    """Whether a spring that carries the robot within its measured range can keep contact.

    Parameters
    ----------
    found : suspension.choice.Exclusion
    low, high : float
        Stiffnesses that were tried, N/m; at `low` the robot rests at the largest measured
        displacement.
    asked : sequence of float
        Speeds, m/s.
    own : float
        Stiffness of the robot as it is, N/m.
    """
    what = (
        f"a spring on which the robot rests within the measured displacements (k from "
        f"{number(low)} to {number(high)}{SPACE}N/m)"
    )
    best = f"{quantity(found.k, 'N/m')} and {quantity(found.c, 'N s/m')}"
    words = (
        f"Is there {what} that keeps contact at {speed_list(asked)}? Of {found.points} suspensions "
        f"the best, at {best}, has a worst margin of {quantity(found.best, 'N')}. "
    )
    if found.best >= 0:
        return words + "**Yes.**"
    if found.steepness > SURE:
        words += (
            "**No:** to reach zero between the points the margin would have to be "
            f"{fixed(found.steepness, 1)} times as steep, at least, as it is anywhere beside them."
        )
    else:
        words += "None of them does; the grid is too coarse to say more."
    if own < low:
        words += " The robot's own spring is not one of these: it rests beyond them."
    return words


def margins_caption(critical, low, high):
    """Caption of the margins of several suspensions against speed.

    Parameters
    ----------
    critical : dict of str to array_like
        For each the critical speeds from `low` to `high`, m/s.
    """
    each = [
        f"{name}: zero at {speed_list(speeds)}" if len(speeds) else f"{name}: never zero"
        for name, speeds in critical.items()
    ]
    return Caption(
        f"The margin at every speed from {number(low)} to {number(high)}{SPACE}m/s, for each "
        "suspension; symbols: the asked speeds. What is right at four speeds need not be right "
        "between them.",
        f"Margin against speed. {'; '.join(each)}.",
    )


def between(critical, kept, low, high):
    """Where each suspension keeps contact from `low` to `high`, m/s.

    Parameters
    ----------
    critical : dict of str to array_like
        For each the critical speeds there, m/s.
    kept : dict of str to sequence of bool
        For each whether contact is kept in each of the ranges between them.
    """
    lines = []
    for name, speeds in critical.items():
        found = Regimes([low, *speeds, high], [not keeps for keeps in kept[name]])
        lines.append(f"- **{name}**: contact is {ranges(found)}.")
    return "\n".join(lines)


def robust_table(least):
    """The least margin at the asked speeds when something is not as it was thought.

    Parameters
    ----------
    least : dict of str to dict of str to float
        For each case by name, and each suspension, N.
    """
    return table(
        [
            {"if": case, **{name: fixed(m, 2) for name, m in margins.items()}}
            for case, margins in least.items()
        ]
    )


def robust_words(least, name):
    """Which cases one suspension does not survive."""
    fails = [case for case, margins in least.items() if margins[name] < -SHOWN]
    each = "in every case of the table"
    if not fails:
        return f"The suspension “{name}” keeps contact at the four speeds {each}."
    if len(fails) == len(least):
        return f"The suspension “{name}” loses contact at one of the four speeds {each}."
    return (
        f"The suspension “{name}” loses contact at one of the four speeds in "
        f"{count(len(fails), 'case')} of {len(least)}: {join(fails)}."
    )


def drive_links(choices, reach, v):
    """Phrases that open the explorer with each suspension at `v` m/s.

    Parameters
    ----------
    choices : dict of str to Robot
    reach : dict of str to Range
        The explorer's sliders.
    """
    phrases, outside = [], []
    for name, robot in choices.items():
        if robot.k1 in reach["k"] and robot.c1 in reach["c"]:
            settings = f"v={v:g}&k={robot.k1:.6g}&c={robot.c1:.6g}&motion=flying"
            phrases.append(f"[{name}](../notebooks/09-drive.ipynb#explore:{settings})")
        else:
            outside.append(name)
    words = f"Drive them over the bump at {v:g}{SPACE}m/s: {join(phrases)}." if phrases else ""
    if outside:
        words += f" {join(outside).capitalize()}: beyond the end of the explorer's sliders."
    return words.strip()


def rough_caption(name, v, airtime):
    """Caption of a ride on a road of class `name` at `v`, m/s; `airtime` of both wheels, s."""
    flies = max(airtime) > 0
    text = f"A road of class {name}, and the forces of the wheels on it at {v:g}{SPACE}m/s."
    if flies:
        text += " Shaded: a wheel is in the air."
    alt = (
        f"Above, heights of a random road along some metres. Below, both normal forces at {v:g}"
        f"{SPACE}m/s, which scatter about the force at rest"
    )
    alt += " and are zero in shaded stretches." if flies else " and never reach zero."
    return Caption(text, alt)


def rough_table(rows):
    """Rides on a rough road.

    Parameters
    ----------
    rows : list of dict
        With the keys `name`, `v` (m/s), `force` (N), `acceleration` (m/s^2) and `pitch` (rad),
        root mean squares of the linear motion, `expected` and `counted`, the part of the time in
        which a rear wheel would have to be pulled, and `flights` and `air`, their number and the
        part of the time in which it is in the air.
    """
    return table(
        [
            {
                "suspension": row["name"],
                "v (m/s)": f"{row['v']:g}",
                "force (N)": fixed(row["force"], 2),
                "acceleration (m/s²)": fixed(row["acceleration"], 2),
                "pitch (degrees)": fixed(np.degrees(row["pitch"]), 2),
                "pulled: expected": _part(row["expected"]),
                "counted": _part(row["counted"]),
                "flights": str(row["flights"]),
                "in the air": _part(row["air"]),
            }
            for row in rows
        ]
    )


def _part(fraction):
    """A part of the time as a percentage, or that it is less than any that was counted."""
    if fraction == 0:
        return "–"
    return f"<{SPACE}0.01{SPACE}%" if fraction < 1e-4 else percent(fraction, 2)


def rough_words(rows, name, distance):
    """What the rough road says about each suspension."""
    words = []
    for each in dict.fromkeys(row["name"] for row in rows):
        flying = [row["v"] for row in rows if row["name"] == each and row["flights"]]
        many = sum(row["flights"] for row in rows if row["name"] == each)
        if flying:
            words.append(f"“{each}” flies at {speed_list(flying)}, {count(many, 'time')} in all")
        else:
            words.append(f"“{each}” never flies")
    return f"On {distance:g}{SPACE}m of a road of class {name}, {join(words)}."


def rms_caption(names, classes):
    """Caption of the forces' root mean squares."""
    return Caption(
        "Root mean square of the rear wheel's force about its mean, from the transfer function and "
        f"the spectrum, on roads of class {join(classes)}, from below. Circles: long runs. The "
        "line is the force at rest, dotted a third of it, below which a loss is rare.",
        f"Force against speed on logarithmic axes, {len(classes)} parallel curves each for "
        f"{join(names)}: each class doubles the one before. Long runs lie on the curves.",
    )


def conclusions(robot, least, reserved, excluded, wide, holds, rows, reserve, asked):
    """What an engineer should take away: five sentences.

    Parameters
    ----------
    robot : Robot
    least, reserved, wide : suspension.choice.Choice or None
        The cheapest for contact at the asked speeds, with a reserve, and in their whole range.
    excluded : suspension.choice.Exclusion
        Of the springs on which the robot rests within the measured displacements.
    holds : bool
        Whether `wide` keeps contact at every speed of the range, not only at those it was made for.
    rows : list of dict
        As in `rough_table`.
    reserve : float
        N.
    asked : sequence of float
        Speeds, m/s.
    """
    low, high = min(asked), max(asked)
    if least is None:
        first = "No suspension of those tried keeps contact at the four speeds."
    elif least.distance == 0:
        first = (
            "As it is the robot keeps contact at the four speeds: for these its suspension may "
            "stay."
        )
    else:
        springs = f"springs of {quantity(least.robot.k1, 'N/m')}"
        times = _times(least.robot.k1 / robot.k1)
        dampers = f"dampers of {quantity(least.robot.c1, 'N s/m')}"
        if abs(np.log(least.robot.c1 / robot.c1)) < ALMOST:
            dampers = f"almost the same dampers, {quantity(least.robot.c1, 'N s/m')}"
        first = f"For contact at the four speeds take {springs}, {times}, and {dampers}."
    if excluded.best < 0:
        second = (
            "A spring that does it must be longer than the measured one: those on which the robot "
            "rests within the measured displacements all lose contact, by "
            f"{quantity(-excluded.best, 'N', 2)} and more."
        )
    else:
        second = "A spring on which the robot rests within the measured displacements can do it."
    if reserved is None:
        third = "A reserve is not to be had in the range that was tried."
    elif reserved.distance == 0:
        third = (
            f"The robot's margin, {quantity(reserved.margin, 'N')}, is a reserve against a bump "
            "that is higher than thought."
        )
    else:
        part = reserve / (robot.m * robot.g / 2)
        third = (
            f"Do not stop where the margin is zero: {quantity(reserved.robot.k1, 'N/m')} buys a "
            f"reserve of {percent(part)} of the load at rest, hence a bump that may be "
            f"{percent(part / (1 - part))} higher."
        )
    if wide is None:
        fourth = (
            f"Ask for a range of speeds, not for four; from {low:g} to {high:g}{SPACE}m/s no "
            "suspension of those tried keeps contact with that reserve."
        )
    else:
        fourth = (
            f"Ask for a range of speeds, not for four: from {low:g} to {high:g}{SPACE}m/s it takes "
            f"{quantity(wide.robot.k1, 'N/m')}"
        )
        fourth += (
            "." if holds else ", and even that loses contact between the speeds it is made for."
        )
    names = list(dict.fromkeys(row["name"] for row in rows))
    flights = {name: sum(row["flights"] for row in rows if row["name"] == name) for name in names}
    most, fewest = max(names, key=flights.get), min(names, key=flights.get)
    if flights[most] == flights[fewest]:
        fifth = "On the rough road a softer spring makes no difference in the number of flights."
    else:
        seldom = count(flights[fewest], "time") if flights[fewest] else "never"
        fifth = (
            f"On the rough road “{most}” flies {count(flights[most], 'time')} and “{fewest}” "
            f"{seldom}: what is chosen for one bump is felt there too."
        )
    sentences = [first, second, third, fourth, fifth]
    return "\n".join(f"{i}. {sentence}" for i, sentence in enumerate(sentences, 1))


def _times(ratio):
    if ratio < 1:
        return f"{fixed(1 / ratio, 1)} times softer"
    return f"{fixed(ratio, 1)} times stiffer"
