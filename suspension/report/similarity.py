"""Sentences, tables and captions of the chart: one curve for every speed, bump and robot."""

import numpy as np

from suspension.problem import DISTANCE
from suspension.report.regimes import WIDE
from suspension.report.rows import table
from suspension.report.words import SPACE, Caption, count, fixed, join, number, percent, ranges

__all__ = [
    "chart_figure",
    "comb_figure",
    "course",
    "falls",
    "groups_table",
    "heavy_first",
    "heights_table",
    "limits_figure",
    "spring_summit",
    "twin_note",
    "two_ways",
    "vehicle_table",
    "vehicles_figure",
    "weight",
    "window",
    "window_figure",
]

NEARLY_CONSTANT = 1.5  # the largest over the least
MATTERS = 1.01  # a curve that is higher by less than this factor is the same to a per cent
RIGHT = 0.005  # a formula that is off by less is right: in two digits it would be off by 0 %


def heights_table(speeds, heights, bump, lost):
    """The highest bump that is crossed with contact at each speed, beside the one there is.

    Parameters
    ----------
    speeds, heights : sequence of float
        m/s and m; inf where a bump of any height is crossed with contact.
    bump : float
        Height of the problem's, m.
    lost : sequence of bool
        Whether contact is lost over it at each speed, as `suspension.contact.is_lost` says.
    """
    this = f"the bump, {1000 * bump:.1f}{SPACE}mm"
    return table(
        [
            {
                "v (m/s)": f"{v:g}",
                "highest bump (mm)": number(1000 * height) if np.isfinite(height) else "any",
                this: "lost" if gone else "kept",
            }
            for v, height, gone in zip(speeds, heights, lost, strict=True)
        ]
    )


def groups_table(groups, v):
    """The five groups of the robot on its bump at speed v, m/s, and what each says."""
    rows = [
        (r"$\nu = v/\sigma\omega_0$", groups.nu, f"speed: here that of {v:g}{SPACE}m/s"),
        (r"$\zeta = c/\sqrt{2km}$", groups.zeta, "damping, as a part of the critical"),
        (r"$\eta = h_0\big/\tfrac{mg}{2k}$", groups.eta, "height of the bump in sags"),
        (r"$j = I_{zz}/mL^2$", groups.j, "where the mass is: 1 if it sits over the wheels"),
        (r"$\lambda = L/\sigma$", groups.lam, "half of the wheelbase in bump widths"),
    ]
    return table([{"group": name, "value": number(x), "meaning": says} for name, x, says in rows])


def two_ways(found):
    """In how many ways one can drive over the bump and keep contact."""
    kept = found.spans(lost=False)
    low, high = found.edges[[0, -1]]
    if not len(kept):
        return "No speed that was looked at is safe."
    if len(kept) == 1 and kept[0, 0] == low and kept[0, 1] == high:
        return "Every speed that was looked at is safe."
    words, narrow = [], []
    for start, end in kept:
        if start == low:
            words.append(f"so slowly that the body follows the bump, below {number(end)}{SPACE}m/s")
            continue
        if end == high:
            words.append(f"so fast that the kick is small, above {number(start)}{SPACE}m/s")
            continue
        between = f"from {number(start)} to {number(end)}{SPACE}m/s"
        if end < WIDE * start:
            narrow.append(between)
            words.append(between)
        else:
            words.append(
                f"so fast that the kick is small and not so fast that the damper pulls, {between}"
            )
    if len(words) == 1:
        text = f"There is **one way** to be safe: {words[0]}."
    else:
        numbers = {2: "two", 3: "three", 4: "four"}
        text = f"There are **{numbers.get(len(words), len(words))} ways** to be safe: "
        text += "; ".join(words[:-1]) + f"; or {words[-1]}."
    if len(narrow) == 1:
        text += f" The range {narrow[0]} is too narrow to drive in."
    elif narrow:
        text += f" The ranges {join(narrow)} are too narrow to drive in."
    return text


def course(v, ratios):
    """What it matters that the problem's runs end: the course's highest bumps over those of all.

    Parameters
    ----------
    v, ratios : array_like, shape (n,)
        Speeds, m/s, and at each the highest bump on the way of the problem over that of a run that
        goes on.
    """
    v, ratios = np.asarray(v), np.asarray(ratios)
    worst = int(np.argmax(ratios))
    if ratios[worst] < MATTERS:
        return (
            f"For this robot the end of the way at {DISTANCE:g} m does not matter: its dampers see "
            "to it that the worst comes on the way, and the curve is the same to a per cent at "
            "every speed."
        )
    return (
        f"For this robot the end of the way at {DISTANCE:g} m matters most at {number(v[worst])}"
        f"{SPACE}m/s: there the highest bump would be {number(ratios[worst], 2)} times lower if "
        "the run went on, for the swing takes longer than the way lasts."
    )


def window(zeta, eta, lines, exact):
    """When the window closes for the bump: exactly, and by the two straight lines.

    Parameters
    ----------
    zeta, eta : float
        Damping of the robot, height of the bump.
    lines, exact : float
        Dampings at which the window closes.
    """
    now = (
        f"open: the robot's damping is {number(zeta, 2)}, and it would take "
        f"{number(exact / zeta, 2)} times as much to close it"
        if zeta < exact
        else f"closed: the robot's damping is {number(zeta, 2)}, {number(zeta / exact, 2)} times "
        "as much as would be allowed"
    )
    return (
        f"For this bump, {number(eta)} sags high, the two lines close the window at $\\zeta$ = "
        f"{number(lines, 2)}. Computed exactly it closes at {number(exact, 2)}, so the lines are "
        f"{_off(lines / exact)}. The window is {now}."
    )


def spring_summit(zeta, exact, limit, lines, closes, closing_limit):
    """What it brings to keep the spring where throw and skim meet.

    Parameters
    ----------
    zeta, exact, limit, lines : array_like, shape (n,)
        Dampings in order, and the summits there: exact (nan where there is none), by throw and skim
        with the spring, and by the two straight lines.
    closes, closing_limit : float
        Damping at which the window closes for the bump, exactly and with the spring.
    """
    zeta, exact, limit, lines = map(np.asarray, (zeta, exact, limit, lines))
    between = (lines <= exact) & (exact <= limit)
    told = ~np.isnan(exact)
    where = "The lines give a lower estimate and the spring a higher one; the truth lies between"
    if not between[told].any():
        where = "The truth does not lie between the two estimates here"
    elif not between[told].all():
        inside, beyond = zeta[told & between], zeta[told & ~between]
        if beyond.max() < inside.min():
            where += f", but for dampings up to {number(beyond.max(), 2)}"
        elif beyond.min() > inside.max():
            where += f", but for dampings from {number(beyond.min(), 2)} on"
        else:
            where += ", but not at every damping"
    return (
        f"With the spring the window closes at $\\zeta$ = {number(closing_limit, 2)}, "
        f"{_off(closing_limit / closes)}. {where}. What is still missing are the comb, and that a "
        "strongly damped body moves while its wheels are on the bump."
    )


def weight(zeta, tops):
    """How the product of damping and height goes along the summit.

    Parameters
    ----------
    zeta, tops : array_like, shape (n,)
        Dampings in order, and the heights of the summit there; nan where there is none.
    """
    zeta, tops = np.asarray(zeta), np.asarray(tops)
    there = ~np.isnan(tops)
    if there.sum() < 2:
        return "At these dampings there is no summit."
    product = (zeta * tops)[there]
    low, high = product.min(), product.max()
    times = number(zeta[there][-1] / zeta[there][0], 2)
    if high < NEARLY_CONSTANT * low:
        return (
            f"Computed exactly, $\\zeta\\eta$ hardly changes along the summit: over dampings that "
            f"grow {times} times it stays between {number(low, 2)} and {number(high, 2)}."
        )
    return (
        f"Computed exactly, $\\zeta\\eta$ goes from {number(product[0], 2)} to "
        f"{number(product[-1], 2)} along the summit, over dampings that grow {times} times."
    )


def _off(ratio):
    if abs(ratio - 1) < RIGHT:
        return "right"
    return f"{percent(abs(ratio - 1), 2)} too {'high' if ratio > 1 else 'low'}"


def limits_figure(zeta):
    """Caption of the three limits laid on the exact curve."""
    return Caption(
        f"Three limits (dashed) and the exact highest bump of the robot ($\\zeta$ = "
        f"{number(zeta, 2)}). A bump above the curve, shaded, lifts a wheel.",
        "Highest bump against speed on logarithmic axes. The exact curve comes down along the "
        "line named follow, is wavy around speed one, rises along the line named throw, and turns "
        "down towards the line named skim.",
    )


def comb_figure(j, lam):
    """Caption of the comb of the wheelbase."""
    return Caption(
        f"An undamped robot with the inertia $j$ = {number(j, 2)} and the wheelbase $\\lambda$ = "
        f"{number(lam, 2)} of ours: exact, and by the formula. Without a comb: the same robot with "
        "$j = 1$.",
        "Highest bump of an undamped robot against speed. The exact curve and the formula of the "
        "comb hang in arcs below a smooth curve for j = 1 and approach the line of throw from "
        "below.",
    )


def chart_figure(zetas, own, found, speeds):
    """Caption of the chart for several dampings, with the bump as a line across.

    Parameters
    ----------
    zetas : sequence of float
    own : float
        The robot's.
    found : suspension.contact.Regimes
    speeds : sequence of float
        Asked for, m/s.
    """
    crossed = len(found.critical)
    return Caption(
        "The chart: one picture for every speed and height, for all robots of these proportions. "
        "Each curve is the highest bump that a robot crosses with contact; "
        f"{count(len(zetas), 'damping')} with $\\zeta$ up to {number(max(zetas), 2)}, ours "
        f"({number(own, 2)}) drawn thick. The bump of the problem is the line across, "
        f"thick where contact is kept, with the {count(len(speeds), 'speed')} asked for and "
        f"{count(crossed, 'critical speed')}.",
        "Highest bump against speed on logarithmic axes, a curve for each damping. All come down "
        "together from the left; to the right they rise, and the more damping there is, the "
        f"sooner they turn down. Over the problem's bump contact is "
        f"{ranges(found)}.".replace(SPACE, " "),
    )


def window_figure(zeta, eta, closes):
    """Caption of the height of the window against damping."""
    side = "left" if zeta < closes else "right"
    inside = "open" if zeta < closes else "closed"
    return Caption(
        "The top of the window, the highest bump for which faster is safer, against damping: "
        "exact, by throw and skim with the spring, and by the two straight lines.",
        "Three falling curves of the window's height against damping. The line of the bump, "
        f"{number(eta)} sags, meets the exact one at a damping of {number(closes, 2)}; the robot, "
        f"at {number(zeta, 2)}, lies to the {side}, where the window is {inside}.",
    )


def vehicle_table(passages):
    """Vehicles, what their suspension is, when they lose contact, and where that is from."""
    return table(
        [
            {
                "vehicle": passage.vehicle,
                "frequency (Hz)": fixed(passage.frequency, 1),
                r"$\zeta$": fixed(passage.zeta, 2),
                "sag (mm)": number(1000 * passage.sag, 2),
                "obstacle": f"{passage.obstacle}, {1000 * passage.height:g}{SPACE}mm",
                r"$\eta$": number(passage.height / passage.sag, 2),
                "loses contact (km/h)": _lost(passage.contact),
                "wheel too heavy above (km/h)": _speed(passage.heavy),
                "source": f"[{passage.cited_as}](../book/references.md#{passage.source})",
            }
            for passage in passages
        ]
    )


def _lost(contact):
    """At which speeds contact is lost."""
    low, high = contact.edges[[0, -1]]
    words = []
    for start, end in contact.spans(lost=True):
        if (start, end) == (low, high):
            return "at all speeds"
        if end == high:
            words.append(f"above {number(start, 2)}")
        elif start == low:
            words.append(f"below {number(end, 2)}")
        else:
            words.append(f"{number(start, 2)} to {number(end, 2)}")
    return join(words, none="–")


def _speed(kmh):
    return "–" if np.isnan(kmh) else number(kmh, 2)


def falls(passages):
    """Whether going faster is safer for any of the vehicles."""
    rising = [f"the {passage.vehicle}" for passage in passages if passage.rises]
    if not rising:
        return (
            "For each of these vehicles the highest bump falls with the speed: its dampers are too "
            "strong for a rising branch, and slower is safer."
        )
    return (
        f"Only for {join(rising)} is there a range in which faster is safer. The dampers of the "
        "others are too strong for a rising branch: slower is safer."
        if len(rising) < len(passages)
        else f"For {join(rising)} there is a range in which faster is safer."
    )


def heavy_first(passages):
    """For which vehicles the mass of the wheel decides before the chart does."""
    told = []
    for passage in passages:
        lost = passage.contact.spans(lost=True)
        first = lost[0, 0] if len(lost) else np.inf
        if passage.heavy < min(first, passage.contact.edges[-1]):
            told.append(f"the {passage.vehicle}")
    if not told:
        return "For none of them does the mass of the wheel decide first."
    return f"For {join(told)} the mass of the wheel decides first."


def vehicles_figure(passages):
    """Caption of the vehicles, a row for each."""
    lost = [passage.vehicle for passage in passages if passage.contact.lost.any()]
    words = f"lost for: {join(lost)}" if lost else "kept by all of them"
    return Caption(
        f"{_capital(count(len(passages), 'vehicle'))}, each over one obstacle, by the chart of a "
        "single wheel ($j = 1$) with its own damping. Diamonds: critical speeds. Crosses: above "
        "these a rigid wheel would be lifted by its own mass.",
        "A row for each vehicle, a bar over the speeds at which it meets its obstacle, in two "
        f"colours where contact is kept and lost. Contact is {words}.",
    )


def _capital(text):
    return text[0].upper() + text[1:]


def twin_note(robot):
    """Which robot a part is about whose formulas need a symmetric one; empty for such a robot.

    Parameters
    ----------
    robot : Robot
    """
    twin = robot.twin
    if twin == robot:
        return ""
    return (
        "The robot is not symmetric, and the formulas of this part ask for one that is. So it is "
        f"about the **symmetric twin**, with the means of both axles: $k$ = {number(twin.k1, 4)}"
        f"{SPACE}N/m, $c$ = {number(twin.c1)}{SPACE}N{SPACE}s/m, $L$ = {number(twin.L1)}{SPACE}m."
    )
