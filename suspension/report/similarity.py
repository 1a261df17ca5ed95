"""Sentences, tables and captions of the chart: one curve for every speed, bump and robot."""

from typing import NamedTuple

import numpy as np

from suspension.problem import DISTANCE
from suspension.report.regimes import WIDE
from suspension.report.rows import table
from suspension.report.words import SPACE, Caption, count, fixed, join, number, percent, ranges

__all__ = [
    "Ride",
    "asked",
    "chart_figure",
    "comb_figure",
    "course",
    "cut",
    "groups_table",
    "heavy_wheels",
    "limits_figure",
    "losses",
    "twin_note",
    "two_ways",
    "vehicle_table",
    "vehicles_figure",
    "window",
    "window_figure",
]


class Ride(NamedTuple):
    """A vehicle on an obstacle, over a range of speeds.

    vehicle, obstacle, source : str
        Names, and a link to where its numbers are from.
    frequency, zeta, sag : float
        Of the body on its spring: Hz, 1 and m.
    height : float
        Of the obstacle, m.
    speeds, lost : ndarray, shape (n,)
        m/s, in order; whether contact is lost at each.
    heavy : float
        Speed above which a rigid wheel's own mass lifts it off the obstacle, m/s; nan if its mass
        is not known.
    """

    vehicle: str
    obstacle: str
    source: str
    frequency: float
    zeta: float
    sag: float
    height: float
    speeds: np.ndarray
    lost: np.ndarray
    heavy: float


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


def asked(found, speeds):
    """Which of the speeds that the problem asks for lie below the curve.

    Parameters
    ----------
    found : suspension.contact.Regimes
    speeds : sequence of float
        m/s.
    """
    lost = found(speeds)
    below, above = (
        [f"{v:g}" for v, gone in zip(speeds, lost, strict=True) if gone == side]
        for side in (False, True)
    )
    if not above:
        return f"All {count(len(speeds), 'speed')} that are asked for lie below the curve: kept."
    if not below:
        return f"All {count(len(speeds), 'speed')} that are asked for lie above the curve: lost."
    return (
        f"Of the speeds that are asked for, {join(below)}{SPACE}m/s "
        f"{'lies' if len(below) == 1 else 'lie'} below the curve: contact is kept. "
        f"{join(above)}{SPACE}m/s {'lies' if len(above) == 1 else 'lie'} above: lost."
    )


def cut(found):
    """Where the line of the bump crosses the curve."""
    low, high = (f"{v:g}" for v in found.edges[[0, -1]])
    crossings = len(found.critical)
    if not crossings:
        side = "above" if found.lost[0] else "below"
        return (
            f"From {low} to {high}{SPACE}m/s the bump's line does not meet the curve: it lies "
            f"{side} it, and contact is {'lost' if found.lost[0] else 'kept'} at every speed."
        )
    times = {1: "once", 2: "twice"}.get(crossings) or count(crossings, "time")
    speeds = join([number(v) for v in found.critical])
    what = "the critical speed" if crossings == 1 else "every critical speed there is"
    return (
        f"From {low} to {high}{SPACE}m/s the bump's line crosses the curve {times}, at "
        f"{speeds}{SPACE}m/s: {what}."
    )


def two_ways(found):
    """In how many ways one can drive over the bump and keep contact."""
    kept = found.spans(lost=False)
    low, high = found.edges[[0, -1]]
    if not len(kept):
        return "No speed that was looked at is safe."
    if len(kept) == 1 and kept[0, 0] == low and kept[0, 1] == high:
        return "Every speed that was looked at is safe."
    words = []
    for start, end in kept:
        if start == low:
            words.append(f"so slowly that the body follows the bump, below {number(end)}{SPACE}m/s")
        elif end == high:
            words.append(f"so fast that the kick is small, above {number(start)}{SPACE}m/s")
        else:
            words.append(
                f"so fast that the kick is small and not so fast that the damper pulls, from "
                f"{number(start)} to {number(end)}{SPACE}m/s"
            )
    if len(words) == 1:
        return f"There is **one way** to be safe: {words[0]}."
    numbers = {2: "two", 3: "three", 4: "four"}
    narrow = [
        f"{number(start)} to {number(end)}{SPACE}m/s"
        for start, end in kept
        if low < start and end < WIDE * start
    ]
    text = f"There are **{numbers.get(len(words), len(words))} ways** to be safe: "
    text += "; ".join(words[:-1]) + f"; or {words[-1]}."
    if narrow:
        text += f" The range from {join(narrow)} is too narrow to drive in."
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
    if ratios[worst] < 1.01:
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


def window(zeta, eta, lines, limit, exact):
    """When the window closes for the bump: by straight lines, with the spring, and exactly.

    Parameters
    ----------
    zeta, eta : float
        Damping of the robot, height of the bump.
    lines, limit, exact : float
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
        f"For this bump, {number(eta)} sags high, the window closes at $\\zeta$ = "
        f"{number(exact, 2)} exactly. Throw and skim with the spring put it at "
        f"{number(limit, 2)} ({_off(limit / exact)}), the two straight lines at "
        f"{number(lines, 2)} ({_off(lines / exact)}). So the window is {now}."
    )


def _off(ratio):
    if abs(ratio - 1) < 0.005:
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
        f"{number(lam, 2)} of ours: exact, and by the formula, which lies on it. Without a comb: "
        "the same robot with $j = 1$.",
        "Highest bump of an undamped robot against speed. The exact curve and the formula of the "
        "comb coincide; they hang in arcs below a smooth curve for j = 1 and approach the line of "
        "throw from below.",
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
        f"The chart. Each curve is the highest bump that a robot crosses with contact; "
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


def vehicle_table(rides):
    """Vehicles, what their suspension is, and where its numbers are from."""
    return table(
        [
            {
                "vehicle": ride.vehicle,
                "frequency (Hz)": fixed(ride.frequency, 1),
                r"$\zeta$": fixed(ride.zeta, 2),
                "sag (mm)": number(1000 * ride.sag, 2),
                "obstacle": f"{ride.obstacle}, {1000 * ride.height:g}{SPACE}mm",
                r"$\eta$": number(ride.height / ride.sag, 2),
                "source": ride.source,
            }
            for ride in rides
        ]
    )


def losses(rides):
    """Which vehicles lose contact, and at which speeds."""
    lost = [f"the {ride.vehicle} {_where(ride)}" for ride in rides if ride.lost.any()]
    kept = [f"the {ride.vehicle}" for ride in rides if not ride.lost.any()]
    if not lost:
        return "By the chart none of them loses contact at the speeds drawn."
    text = "By the chart " + join(lost) + f" {'loses' if len(lost) == 1 else 'lose'} contact."
    if kept:
        text += f" {_capital(join(kept))} {'keeps' if len(kept) == 1 else 'keep'} it."
    return text


def _capital(text):
    return text[0].upper() + text[1:]


def _where(ride):
    """At which speeds contact is lost, in km/h."""
    kmh = 3.6 * ride.speeds
    first, last = np.flatnonzero(ride.lost)[[0, -1]]
    start, end = number(kmh[first], 2), number(kmh[last], 2)
    if ride.lost.all():
        return f"at all speeds from {start} to {end}{SPACE}km/h"
    if last == len(kmh) - 1:
        return f"above {start}{SPACE}km/h"
    if first == 0:
        return f"below {end}{SPACE}km/h"
    return f"from {start} to {end}{SPACE}km/h"


def heavy_wheels(rides):
    """For which vehicles the mass of the wheel alone would lift it, and above which speed."""
    told = [
        f"the {ride.vehicle} above {number(3.6 * ride.heavy, 2)}{SPACE}km/h"
        for ride in rides
        if ride.heavy < ride.speeds[-1]
    ]
    if not told:
        return "At the speeds drawn no wheel would be lifted by its own mass alone."
    return "A rigid wheel would be lifted by its own mass alone: " + join(told) + "."


def vehicles_figure(rides):
    """Caption of the vehicles on the chart."""
    lost = [ride.vehicle for ride in rides if ride.lost.any()]
    words = f"lost for: {join(lost)}" if lost else "kept by all of them"
    return Caption(
        f"{_capital(count(len(rides), 'vehicle'))} on the chart of a single wheel ($j = 1$). Each "
        "bar is a range of speeds over one obstacle; its verdict is that of the vehicle's own "
        "damping.",
        "Bars of speed for vehicles over curves of the highest bump for several dampings. Contact "
        f"is {words}.",
    )


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
