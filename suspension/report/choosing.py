"""Words of Part X: a choice of suspension.

A suspension is a robot, of which stiffness and damping, alike on both axles, are told. `candidates`
holds a `suspension.choice.Candidate` for each by name, the present one first. After a loss of
contact no margin is told.
"""

import numpy as np

from suspension.contact import is_lost
from suspension.report.rows import table
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
    share,
    speed_list,
)

__all__ = [
    "beaten",
    "between",
    "choice_table",
    "conclusions",
    "contact_map",
    "drive_links",
    "farthest",
    "game_note",
    "measured_length",
    "paths",
    "price_map",
    "rest_note",
    "robust_table",
    "room_note",
]

ALMOST = 0.2  # of a logarithm: a fifth more or less
SHOWN = 0.005  # of delta_max: what two decimals of a compression do not show
AT_END = 0.999  # of an end of the map: a search that stops at a bound may end a hair before it


def farthest(stiffest, strongest, asked, ends):
    """Up to which springs and dampers contact can be kept.

    Parameters
    ----------
    stiffest, strongest : suspension.choice.Choice or None
    asked : sequence of float
        Speeds, m/s.
    ends : array_like, shape (2, 2)
        Of the map: the softest and the stiffest springs, N/m; the weakest and the strongest
        dampers, N s/m.
    """
    if stiffest is None:
        return f"**Nowhere** on this map is contact kept at {speed_list(asked)}."
    k, c = stiffest.robot.k1, strongest.robot.c1
    reached = [_reached(x, *pair) for x, pair in zip((k, c), ends, strict=True)]
    if "least" in reached:
        return _at_the_edge(k, c, reached, asked)
    soft, weak = (far == "inside" for far in reached)
    where = [word for word, so in (("springs are soft", soft), ("dampers weak", weak)) if so]
    limits = [quantity(*x) for x, so in (((k, "N/m"), soft), ((c, "N s/m"), weak)) if so]
    if not where:
        return (
            "**Not only where springs are soft and dampers weak**: at "
            f"{speed_list(asked)} contact can be kept with the stiffest springs of this map, and "
            "with its strongest dampers."
        )
    one = where[0].replace("dampers weak", "dampers are weak")
    none = {(True, True): "stiffer spring and no stronger damper", (True, False): "stiffer spring"}
    return (
        f"**Where {join(where) if len(where) > 1 else one}**: up to {join(limits)}. No "
        f"{none.get((soft, weak), 'stronger damper')} of this map keeps contact at "
        f"{speed_list(asked)}."
    )


def _reached(x, low, high):
    """Where the farthest suspension with contact lies between two ends of the map."""
    if x >= AT_END * high:
        return "most"
    return "inside" if AT_END * x > low else "least"


def _at_the_edge(k, c, reached, asked):
    """Contact is kept at the lower end of the map alone, of its stiffness, its damping or both."""
    least = (
        (f"its softest springs alone, {quantity(k, 'N/m')}", "softer springs"),
        (f"its weakest dampers alone, {quantity(c, 'N s/m')}", "weaker dampers"),
    )
    more = (
        {"inside": f"springs up to {quantity(k, 'N/m')}", "most": "springs up to its stiffest"},
        {"inside": f"dampers up to {quantity(c, 'N s/m')}", "most": "dampers up to its strongest"},
    )
    words, beyond = [], []
    for far, (one, other), further in zip(reached, least, more, strict=True):
        words.append(f"with {one if far == 'least' else further[far]}")
        if far == "least":
            beyond.append(other)
    return (
        f"**Only at the edge of this map**: at {speed_list(asked)} contact is kept "
        f"{', and '.join(words)}. {join(beyond).capitalize()} were not looked at."
    )


def contact_map(kept, asked, names):
    """Caption of the two maps of contact.

    Parameters
    ----------
    kept : array_like of bool
        Which suspensions of the map keep contact at all asked speeds.
    asked : sequence of float
        m/s.
    names : sequence of str
        Of the suspensions that are marked.
    """
    return Caption(
        "The worst over the asked speeds, for every stiffness and damping: the least margin, and "
        "the part of the way that a wheel spends in the air. "
        f"{_line(kept, asked)} Marks, of which more below: {join(list(names))}.",
        f"Two maps over stiffness and damping on logarithmic axes. {_parted(kept)}",
    )


def price_map(kept, asked):
    """Caption of the two maps of what a suspension costs; arguments as in `contact_map`."""
    return Caption(
        "The same suspensions: largest acceleration of the body, and largest compression of a "
        f"spring. {_line(kept, asked)}",
        "Two maps over stiffness and damping on logarithmic axes. Acceleration is least where "
        "springs are soft and dampers weak, compression where springs are stiff and dampers "
        f"strong. {_parted(kept)}",
    )


def paths(shown, asked, lost):
    """Caption of suspensions on the chart.

    Parameters
    ----------
    shown : sequence of str
        Names of the suspensions, the given one first.
    asked : sequence of float
        m/s.
    lost : sequence of ndarray of bool, shape (n, speeds)
        Whether each of them loses contact at each speed.
    """
    filled = np.concatenate(lost)
    circles = "none of which loses contact"
    if filled.any():
        circles = "all of which lose contact" if filled.all() else "filled where contact is lost"
    ways = ""
    if len(shown) > 1:
        ways = " A softer suspension's circles lie further down and to the right on them."
    return Caption(
        f"The choice on the chart. Grey: the {count(len(asked), 'speed')}, each a line along which "
        "a softer spring slides down to the right. Circles: the suspensions at these speeds, "
        f"{circles}; curves: their highest bumps. Here {join(list(shown))}.",
        "Highest bump against speed on logarithmic axes, a curve for each suspension, and grey "
        f"lines of slope minus two, parallel to the line named follow.{ways}",
    )


def _line(kept, asked):
    """What the white line of a map says."""
    kept, speeds = np.asarray(kept), count(len(asked), "speed")
    if kept.all():
        return f"Contact is kept at all {speeds} by every suspension of the map."
    if not kept.any():
        return f"No suspension of the map keeps contact at all {speeds}."
    return (
        "White line: where the least margin is zero. To its left and below it, both wheels keep "
        f"contact at all {speeds}."
    )


def _parted(kept):
    kept = np.asarray(kept)
    if kept.all() or not kept.any():
        return f"No line is drawn: contact is {'kept' if kept.all() else 'lost'} everywhere."
    return (
        "A white line parts the suspensions that keep contact, with soft springs and weak dampers, "
        "from those that lose it."
    )


def beaten(robot, better):
    """Whether any suspension of the map is better than the present one in everything.

    Parameters
    ----------
    robot : Robot
    better : sequence of (float, float)
        Suspensions that are better in all three criteria, k and c, N/m and N s/m, best first.
    """
    present = f"the present one, {_named(robot.k1, robot.c1)},"
    if not len(better):
        return f"**Not one.** No suspension of the map is better than {present} in all three."
    example = ", for example," if len(better) > 1 else ""
    return (
        f"**{count(len(better), 'suspension').capitalize()}.** {_named(*better[0])}{example} are "
        f"better than {present} in all three."
    )


def _named(k, c):
    return f"{quantity(k, 'N/m')} and {quantity(c, 'N s/m')}"


def choice_table(choices, candidates, limit):
    """The suspensions beside each other: their margins, then what they ask for.

    Parameters
    ----------
    choices : dict of str to suspension.choice.Choice or None
        What was found for each demand, by the name of the suspension.
    candidates : dict of str to suspension.choice.Candidate
    limit : float
        Largest displacement at which the spring was measured, m.
    """
    first, second = [], []
    for name, one in candidates.items():
        choice = choices.get(name)
        first.append(
            {
                "suspension": name,
                "k (N/m)": number(one.robot.k1),
                "c (N s/m)": number(one.robot.c1),
                "d": fixed(choice.distance, 2) if choice else "–",
                **{f"{v:g}{SPACE}m/s": _margin(m) for v, m in one.margins.items()},
            }
        )
        second.append(
            {
                "suspension": name,
                "largest acceleration (m/s²)": fixed(one.worst.acceleration[0, 0], 1),
                r"at rest, of $\delta_{\max{}}$": fixed(-one.robot.equilibrium[0] / limit, 2),
                r"at most, of $\delta_{\max{}}$": fixed(one.worst.compression[0, 0] / limit, 2),
                "in the air": share(one.worst.air[0, 0]),
            }
        )
    words = ["Changes $d$, and margins in N at the asked speeds:", table(first)]
    for name, choice in choices.items():
        if choice is None:
            words.append(f"“{name}”: **no suspension of the map** does it.")
        elif not choice.distance:
            words.append(f"“{name}”: **no change is needed**, the robot does it as it is.")
    words += ["What they ask for, on a ground that only pushes:", table(second)]
    return "\n\n".join(words)


def _margin(margin):
    """A margin in N; after a loss it is none."""
    return "lost" if is_lost(margin) else fixed(margin, 2)


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


def game_note(robot, fit):
    """With which robot the game of the laboratory is played, if it is not quite the one at hand.

    Parameters
    ----------
    robot : Robot
    fit : suspension.springs.SpringFit
        Of its springs.
    """
    words = []
    if robot.twin != robot:
        words.append(
            "The robot is not symmetric. The game is played with its **symmetric twin**, which has "
            "the means of both axles."
        )
    if not fit.linearity().linear:
        words.append(
            "The readings contradict a spring without preload and curvature. The game is played "
            f"with a straight spring of its stiffness at zero, {quantity(fit.stiffness, 'N/m')}."
        )
    return " ".join(words)


def room_note(asked, flown, pressed, limit):
    """Where the largest compression comes from, if not from a run in which both wheels press.

    Parameters
    ----------
    asked : sequence of float
        Speeds, m/s.
    flown, pressed : array_like, shape (speeds,)
        Largest compression of a spring on a ground that only pushes, m, and that up to the first
        loss of contact.
    limit : float
        Largest displacement at which the spring was measured, m.
    """
    flown, pressed = np.asarray(flown) / limit, np.asarray(pressed) / limit
    most = int(np.argmax(flown))
    if flown[most] < pressed.max() + SHOWN:
        return ""
    return (
        f"As it is, the robot reaches {fixed(flown[most], 2)} at {asked[most]:g}{SPACE}m/s, after "
        f"a wheel has left the ground; while both wheels press it is {fixed(pressed.max(), 2)} at "
        "most."
    )


def measured_length(stiffest, limit):
    """Whether a spring that carries the robot within its measured range can keep contact.

    Parameters
    ----------
    stiffest : suspension.choice.Choice or None
        Found among springs that do carry it so, too.
    limit : float
        Largest displacement at which the spring was measured, m.
    """
    if stiffest is None:
        return "No suspension that was tried keeps contact, so there is nothing to ask."
    robot = stiffest.robot
    rest = -robot.equilibrium[0] / limit
    words = (
        f"On the stiffest springs with contact, {quantity(robot.k1, 'N/m')}, the robot rests at "
        rf"{fixed(rest, 2)} $\delta_{{\max{{}}}}$: "
    )
    if rest <= 1:
        return words + "**yes,** within the displacements that were measured."
    return words + "**no,** the spring must be longer than what was measured."


def between(candidates):
    """Where each suspension keeps contact in the range of the asked speeds."""
    lines = [f"- **{name}**: contact is {ranges(one.regimes)}." for name, one in candidates.items()]
    return "\n".join(lines)


def robust_table(least):
    """The least margins when something is not as it was thought, and who keeps contact.

    Parameters
    ----------
    least : dict of str to dict of str to float
        For each case by name, and each suspension, N.
    """
    rows = [
        {"if": case, **{name: _margin(m) for name, m in margins.items()}}
        for case, margins in least.items()
    ]
    names = next(iter(least.values()))
    safe = [name for name in names if not any(is_lost(m[name]) for m in least.values())]
    note = f"In every case contact is kept by: **{join(safe, none='none of them')}**."
    return f"{table(rows)}\n\n{note}"


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


def conclusions(findings):
    """What an engineer should take away: four sentences."""
    sentences = [f(findings) for f in (_springs, _price, _reserve, _range)]
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


def _price(findings):
    least = findings.least
    if least is None or least.distance == 0:
        return "Where nothing is changed, nothing is paid."
    now, then = (
        next(one.worst for one in findings.candidates.values() if one.robot == robot)
        for robot in (_present(findings).robot, least.robot)
    )
    room = [x.compression[0, 0] / findings.limit for x in (now, then)]
    felt = [x.acceleration[0, 0] for x in (now, then)]
    pays = "The price is room" if room[1] > room[0] else "It saves room"
    does = "falls" if felt[1] < felt[0] else "rises"
    return (
        rf"{pays}: the largest compression goes from {fixed(room[0], 2)} to {fixed(room[1], 2)} "
        rf"$\delta_{{\max{{}}}}$, while the largest acceleration {does} from {fixed(felt[0], 1)} "
        f"to {fixed(felt[1], 1)}{SPACE}m/s²."
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
    share = reserved.margin / (robot.m * robot.g / 2)
    return (
        f"Do not stop where the margin is zero: {quantity(reserved.robot.k1, 'N/m')} buys a "
        f"reserve of {percent(share)} of the load at rest, hence a bump that may be "
        f"{percent(share / (1 - share))} higher."
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


def _times(ratio):
    if ratio < 1:
        return f"{fixed(1 / ratio, 1)} times softer"
    return f"{fixed(ratio, 1)} times stiffer"
