"""Words of Parts IX to XI: the robot as a filter, a choice of suspension, a rough road.

A suspension is a robot, of which stiffness and damping, alike on both axles, are told. `candidates`
holds a `suspension.choice.Candidate` for each by name, the present one first; `maps` is a
`suspension.choice.Demands`, `rides` a list of `Ride` and `findings` the `Findings` from there.
After a loss of contact no margin is told.
"""

import numpy as np

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
    "rest_note",
    "ripples_caption",
    "rms_caption",
    "robust_table",
    "robust_words",
    "rough_caption",
    "rough_conclusion",
    "rough_table",
    "rough_words",
    "short_waves",
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


def cost(cases, error):
    """What the maps took; `error` is how far their margins are from exact ones at most, N."""
    return (
        f"The maps are {cases} runs on a ground that only pushes, all in one loop. On every fifth "
        "suspension each way the verdicts are those of the exact margins, which they miss by at "
        f"most {quantity(error, 'N', 2)}."
    )


def best_table(maps, k, c, limit):
    """The best suspension of a map in each criterion, and what it is in the others.

    Parameters
    ----------
    maps : Demands
    k, c : array_like, shapes (n,) and (m,)
        N/m, N s/m.
    limit : float
        Largest displacement at which the spring was measured, m.
    """
    rows = []
    names = ("the most contact", "the least acceleration", "the least travel")
    for name, costs in zip(names, maps.costs):
        i, j = np.unravel_index(costs.argmin(), costs.shape)
        rows.append(
            {
                "best in": name,
                "k (N/m)": number(k[j]),
                "c (N s/m)": number(c[i], 2),
                "contact": _contact(maps.margin[i, j], maps.air[i, j]),
                "acceleration (m/s²)": fixed(maps.acceleration[i, j], 1),
                "compression (mm)": fixed(1000 * maps.compression[i, j], 1),
                r"of $\delta_{\max{}}$": fixed(maps.compression[i, j] / limit, 1),
            }
        )
    return table(rows)


def _contact(margin, air):
    """The margin, or, where contact is lost, how much of the way a wheel is in the air."""
    if margin > 0:
        return f"kept, {fixed(margin, 1)}{SPACE}N"
    return f"lost, {_part(air)} in the air"


def demands_caption(names, maps, k, c):
    """Caption of the maps; `names` are those of the marked suspensions."""
    kept = maps.margin > 0
    where = "Contact is kept nowhere."
    if kept.any():
        row, column = np.nonzero(kept)
        up_to = _named(k[column.max()], c[row.max()])
        where = f"Contact is kept on {percent(kept.mean())} of the map, up to {up_to}."
    return Caption(
        "The worst over the asked speeds, for every stiffness and damping: least margin, the part "
        "of the way that a wheel spends in the air, largest acceleration of the body, largest "
        f"compression of a spring. White line: beyond it contact is lost. Marks: {join(names)}.",
        f"Four maps over stiffness and damping on logarithmic axes. {where} Acceleration goes from "
        f"{number(maps.acceleration.min(), 2)} to {number(maps.acceleration.max(), 2)}{SPACE}m/s², "
        f"compression from {number(1000 * maps.compression.min(), 2)} to "
        f"{number(1000 * maps.compression.max(), 2)}{SPACE}mm. Marked: {join(names)}.",
    )


def front_caption(kept, total):
    """Caption of the front; `kept` of `total` best compromises keep contact."""
    many = f"{kept} of these {total}" if kept else "None of them"
    keep = "keeps" if kept == 1 else "keep"
    return Caption(
        "The best compromises: no other suspension of the map is better in one criterion and as "
        f"good in the others. {many} {keep} contact at all asked speeds (filled); rings: contact "
        "is lost.",
        f"Scatter of {total} suspensions, acceleration against compression. {many} {keep} contact "
        "and are coloured by their margin.",
    )


def beaten(robot, better):
    """Whether the present suspension is among the best compromises.

    Parameters
    ----------
    robot : Robot
    better : sequence of (float, float)
        Suspensions that are better in all three criteria, k and c, N/m and N s/m, best first.
    """
    present = f"The present suspension, {_named(robot.k1, robot.c1)},"
    if not len(better):
        return f"{present} is not beaten: none of the map is better in all three."
    return (
        f"{present} is beaten by {count(len(better), 'suspension')} of the map in *all* three, "
        f"for example by {_named(*better[0])}."
    )


def _named(k, c):
    return f"{quantity(k, 'N/m')} and {quantity(c, 'N s/m')}"


def choice_table(candidates, limit):
    """The suspensions beside each other: their margins, then what they ask for.

    `limit` is the largest displacement at which the spring was measured, m.
    """
    first, second = [], []
    for name, one in candidates.items():
        first.append(
            {
                "suspension": name,
                "k (N/m)": number(one.robot.k1),
                "c (N s/m)": number(one.robot.c1),
                **{f"{v:g}{SPACE}m/s": _margin(m) for v, m in one.margins.items()},
            }
        )
        second.append(
            {
                "suspension": name,
                "largest acceleration (m/s²)": fixed(one.worst.acceleration[0, 0], 1),
                r"at rest, of $\delta_{\max{}}$": fixed(-one.robot.equilibrium[0] / limit, 2),
                r"at most, of $\delta_{\max{}}$": fixed(one.worst.compression[0, 0] / limit, 2),
                "in the air": _part(one.worst.air[0, 0]),
            }
        )
    return "\n\n".join(
        [
            "Margins in N at the asked speeds:",
            table(first),
            "and what the suspensions ask for, on a ground that only pushes:",
            table(second),
        ]
    )


def _margin(margin):
    """A margin in N; after a loss it is none."""
    return "lost" if margin < -SHOWN else fixed(margin, 2)


def rest_note(fit, robot):
    """What the linear spring of this part leaves out, if the readings contradict it."""
    if fit.linearity().linear:
        return ""
    load = robot.m * robot.g / 2
    line, parabola = load / fit.stiffness, fit.displacement(load) * fit.delta_max
    return (
        "The readings contradict a spring without preload and curvature. All of this part is "
        f"reckoned with the line, on which the robot rests at {fixed(1000 * line, 1)}{SPACE}mm; on "
        f"the fitted parabola it rests at {fixed(1000 * parabola, 1)}{SPACE}mm, and [Part VIII]"
        "(08-measured-spring.ipynb) says what else that changes."
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
    words = (
        "Is there a spring on which the robot rests within the measured displacements (k from "
        f"{number(low)} to {number(high)}{SPACE}N/m) that keeps contact at {speed_list(asked)}? "
    )
    if found.best >= 0:
        return (
            f"{words}**Yes,** with {_named(found.k, found.c)} and a margin of "
            f"{quantity(found.best, 'N')}, for example."
        )
    words += f"Of {found.points} suspensions none does. "
    if found.steepness > SURE:
        words += (
            "**No:** to reach zero between the points the margin would have to be "
            f"{fixed(found.steepness, 1)} times as steep, at least, as it is anywhere beside them."
        )
    else:
        words += "The grid is too coarse to say more."
    if own < low:
        words += " The robot's own spring is not one of these: it rests beyond them."
    return words


def margins_caption(candidates):
    """Caption of the margins of several suspensions against speed."""
    low, high = next(iter(candidates.values())).regimes.edges[[0, -1]]
    each = "; ".join(f"{name}: {ranges(one.regimes)}" for name, one in candidates.items())
    return Caption(
        f"The margin at every speed from {low:g} to {high:g}{SPACE}m/s, for each suspension; "
        "symbols: the asked speeds. Below zero (shaded) contact is lost. What is right at the "
        "asked speeds need not be right between them.",
        f"Margin against speed. {each}.",
    )


def between(candidates):
    """Where each suspension keeps contact in the range of the asked speeds."""
    lines = [f"- **{name}**: contact is {ranges(one.regimes)}." for name, one in candidates.items()]
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
            {"if": case, **{name: _margin(m) for name, m in margins.items()}}
            for case, margins in least.items()
        ]
    )


def robust_words(least, name):
    """Which cases one suspension does not survive."""
    fails = [case for case, margins in least.items() if margins[name] < -SHOWN]
    if not fails:
        return f"“{name}” keeps contact at the asked speeds in every case of the table."
    if len(fails) == len(least):
        return f"“{name}” loses contact at an asked speed in every case of the table."
    all_of_them = count(len(least), "case")
    return (
        f"“{name}” loses contact at an asked speed in {count(len(fails), 'of').split()[0]} of the "
        f"{all_of_them}: {join(fails)}."
    )


def drive_links(candidates, reach, v):
    """Phrases that open the explorer with each suspension at `v` m/s; `reach`: its sliders."""
    phrases, outside = [], []
    for name, (robot, *_) in candidates.items():
        if robot.k1 in reach["k"] and robot.c1 in reach["c"]:
            settings = f"v={v:g}&k={robot.k1:.6g}&c={robot.c1:.6g}&motion=flying"
            phrases.append(f"[{name}](../notebooks/12-drive.ipynb#explore:{settings})")
        else:
            outside.append(name)
    words = [f"Drive them over the bump at {v:g}{SPACE}m/s: {join(phrases)}."] if phrases else []
    if outside:
        words.append(f"{join(outside).capitalize()}: beyond the end of the explorer's sliders.")
    return " ".join(words)


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


def rough_table(rides):
    """Rides on a rough road."""
    return table(
        [
            {
                "suspension": ride.name,
                "v (m/s)": f"{ride.v:g}",
                "force (N)": fixed(ride.force, 2),
                "acceleration (m/s²)": fixed(ride.acceleration, 2),
                "pitch (degrees)": fixed(np.degrees(ride.pitch), 2),
                "pulled: expected": _part(ride.expected),
                "counted": _part(ride.counted),
                "flights": str(ride.flights),
                "in the air": _part(ride.air),
            }
            for ride in rides
        ]
    )


def _part(fraction):
    """A part of the time as a percentage, or that it is less than any that was counted."""
    if fraction == 0:
        return "–"
    return f"<{SPACE}0.01{SPACE}%" if fraction < 1e-4 else percent(fraction, 2)


def rough_words(rides, name, distance):
    """What the rough road says about each suspension."""
    words = []
    for each, flights in _flights(rides).items():
        where = [ride.v for ride in rides if ride.name == each and ride.flights]
        many = f", {count(flights, 'time')} in all" if len(where) > 1 else ""
        flies = f"flies at {speed_list(where)}{many}" if where else "never flies"
        words.append(f"“{each}” {flies}")
    return f"On {distance:g}{SPACE}m of a road of class {name}: {'; '.join(words)}."


def _flights(rides):
    """How often each suspension flies in all its rides, by name."""
    names = dict.fromkeys(ride.name for ride in rides)
    return {name: sum(ride.flights for ride in rides if ride.name == name) for name in names}


def short_waves(parts, shortest):
    """How much of the force comes from waves shorter than the classes were made for.

    Parameters
    ----------
    parts : dict of float to float
        For each speed, m/s, their part of the mean square.
    shortest : float
        The shortest wave of the classes, m.
    """
    each = join(f"{percent(part, 3)} at {v:g}{SPACE}m/s" for v, part in parts.items())
    return (
        f"The classes are meant for waves down to {fixed(shortest, 2)}{SPACE}m. Shorter ones only "
        f"continue their law, and of the mean square of the rear wheel's force they are {each}."
    )


def rms_caption(names, classes):
    """Caption of the forces' root mean squares."""
    return Caption(
        "Root mean square of the rear wheel's force about its mean, from the transfer function and "
        f"the spectrum, on roads of class {join(classes)}, from below. Circles: long runs. The "
        "line is the force at rest, dotted a third of it, below which a loss is rare.",
        f"Force against speed on logarithmic axes, {len(classes)} parallel curves each for "
        f"{join(names)}: each class doubles the one before. Long runs lie on the curves.",
    )


def conclusions(findings):
    """What an engineer should take away: four sentences."""
    sentences = [f(findings) for f in (_springs, _longer, _reserve, _range)]
    return "\n".join(f"{i}. {sentence}" for i, sentence in enumerate(sentences, 1))


def _present(findings):
    """The suspension as it is."""
    return next(iter(findings.candidates.values()))


def _springs(findings):
    least, robot = findings.least, _present(findings).robot
    asked = speed_list(_present(findings).margins)
    if least is None:
        return f"No suspension of those tried keeps contact at {asked}."
    if least.distance == 0:
        return f"As it is the robot keeps contact at {asked}: for these its suspension may stay."
    dampers = f"dampers of {quantity(least.robot.c1, 'N s/m')}"
    if abs(np.log(least.robot.c1 / robot.c1)) < ALMOST:
        dampers = f"almost the same dampers, {quantity(least.robot.c1, 'N s/m')}"
    return (
        f"For contact at {asked} take springs of {quantity(least.robot.k1, 'N/m')}, "
        f"{_times(least.robot.k1 / robot.k1)}, and {dampers}."
    )


def _longer(findings):
    if findings.excluded.best >= 0:
        return "A spring on which the robot rests within the measured displacements can do it."
    sure = "all lose contact" if findings.excluded.steepness > SURE else "lose it, as far as tried"
    return (
        "A spring that does it must be longer than the measured one: those on which the robot "
        f"rests within the measured displacements {sure}."
    )


def _reserve(findings):
    reserved, robot = findings.reserved, _present(findings).robot
    if reserved is None:
        return "A reserve is not to be had in the range that was tried."
    if reserved.distance == 0:
        return (
            f"The robot's margin, {quantity(reserved.margin, 'N')}, is a reserve against a bump "
            "that is higher than thought."
        )
    part = findings.reserve / (robot.m * robot.g / 2)
    return (
        f"Do not stop where the margin is zero: {quantity(reserved.robot.k1, 'N/m')} buys a "
        f"reserve of {percent(part)} of the load at rest, hence a bump that may be "
        f"{percent(part / (1 - part))} higher."
    )


def _range(findings):
    low, high = _present(findings).regimes.edges[[0, -1]]
    where = f"from {low:g} to {high:g}{SPACE}m/s"
    few = count(len(_present(findings).margins), "").split()[0]
    ask = f"Ask for a range of speeds, not for {few}"
    wide = findings.wide
    if wide is None:
        return f"{ask}; {where} no suspension of those tried keeps contact with that reserve."
    held = next(one for one in findings.candidates.values() if one.robot == wide.robot)
    lost = held.regimes.lost.any()
    but = ", and even that loses contact between the speeds it is made for" if lost else ""
    return f"{ask}: {where} it takes {quantity(wide.robot.k1, 'N/m')}{but}."


def rough_conclusion(rides):
    """What the choice changes on the rough road."""
    flights = _flights(rides)
    most, fewest = max(flights, key=flights.get), min(flights, key=flights.get)
    if flights[most] == flights[fewest]:
        return "On the rough road the choice makes no difference in the number of flights."
    seldom = count(flights[fewest], "time") if flights[fewest] else "never"
    return (
        f"On the rough road “{most}” flies {count(flights[most], 'time')} and “{fewest}” {seldom}: "
        "what is chosen for one bump is felt there too."
    )


def _times(ratio):
    if ratio < 1:
        return f"{fixed(1 / ratio, 1)} times softer"
    return f"{fixed(ratio, 1)} times stiffer"
