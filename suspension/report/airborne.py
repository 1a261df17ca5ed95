"""Sentences, tables and captions of Part VII: flights, in two models of the free wheel."""

import numpy as np

from suspension.forces import WHEEL
from suspension.problem import DISTANCE
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
    speed_list,
)

__all__ = [
    "air",
    "contact_states_caption",
    "film_caption",
    "first_flights",
    "flight_caption",
    "flight_table",
    "geometry_sentence",
    "geometry_table",
    "models",
    "order_caption",
    "rules_apart",
    "who_flies",
]

SHORT = 1e-6  # s; switches that are less apart agree to the microsecond that the sentence names
NO_JUMP = 1e-3  # N; a force that returns with less comes back smoothly


def contact_states_caption():
    """Caption of the state diagram."""
    text = (
        "The robot as a hybrid system. Boxes: the four contact states, and the forces in each. "
        "Arrows: the switches of a wheel (blue: rear, orange: front), away from the ground "
        "(full) and back to it (dotted). "
        r"$f_i$ is Eq. 5, $p_i$ the compression that a wheel on the ground would give its spring, "
        r"$p_i^\circ$ the one above the free wheel: 0 if it follows; if it relaxes, $p_i$ at "
        "lift-off, and falling from there."
    )
    alt = (
        "State diagram with four boxes: both wheels press; the rear wheel in the air, so that N1 "
        "is zero; the front wheel in the air, so that N2 is zero; both in the air. Arrows lead "
        "from each box to the two that differ from it in one wheel, and back. A wheel lifts off "
        "when its f falls to zero and lands when p is at least p-circle and f is positive."
    )
    return Caption(text, alt)


def flight_table(flights, robot):
    """How often, how long, how high and how hard: a row for each flight.

    Parameters
    ----------
    flights : sequence of Flight
    robot : Robot
    """
    flights = list(flights)
    duration = flights[0].T[-1]
    ways = join(f"{flight.v * duration:.3g}" for flight in flights)
    note = (
        f"Counted over {quantity(duration, 's')}, a way of {ways}{SPACE}m; the asked runs end at "
        f"{DISTANCE:g}{SPACE}m. A run has settled when both forces stay within 5{SPACE}% of those "
        "at rest."
    )
    return f"{table([_row(flight, robot) for flight in flights])}\n\n{note}"


def _row(flight, robot):
    hardest = max((e.force for e in flight.events if e.kind == "landing"), default=None)
    settled = flight.settled(robot)
    return {
        "v (m/s)": f"{flight.v:g}",
        "flights": str(sum(event.kind == "lift-off" for event in flight.events)),
        **air(flight, 1),
        "hardest touch-down (N)": "–" if hardest is None else _force(hardest),
        "largest force (N)": fixed(flight.N.max(), 1),
        "largest pitch (degrees)": fixed(np.degrees(np.abs(flight.W[2]).max()), 1),
        "settled after (s)": fixed(settled, 2) if np.isfinite(settled) else f"> {flight.T[-1]:g}",
    }


def air(run, decimals=2):
    """How long and how high the wheels of a Flight or a Rolling are in the air, for a row."""
    airtime, highest = (
        ", ".join(fixed(1e3 * x, decimals) for x in both)
        for both in (run.airtime, run.gaps.max(axis=1))
    )
    return {"in the air: rear, front (ms)": airtime, "highest: rear, front (mm)": highest}


def _force(force):
    """With how much a force comes back, N; nothing if it comes back smoothly."""
    return "no jump" if force < NO_JUMP else number(force, 2)


def who_flies(flights, linear):
    """At which speeds a wheel flies, and what the linear model claims there.

    Parameters
    ----------
    flights : dict of float to Flight
        For each speed, m/s.
    linear : dict of float to Trajectory
        The same runs with a ground that may pull.
    """
    fliers = [v for v, flight in flights.items() if flight.events]
    if not fliers:
        return (
            f"With this spring no wheel leaves the ground at any of the "
            f"{count(len(flights), 'speed')}: each run *is* the linear solution, from beginning to "
            "end."
        )
    claims = join(f"{fixed(linear[v].N.min(), 1)}{SPACE}N at {v:g}{SPACE}m/s" for v in fliers)
    every = "each" if len(fliers) == len(flights) else speed_list(fliers)
    return (
        f"Of the {count(len(flights), 'speed')} the robot flies at {every}. Up to the first "
        "lift-off the run *is* the linear solution. After it, the linear model pulls the body "
        f"down where nothing holds it: it claims forces down to {claims}, which do not exist."
    )


def geometry_table(asked, small, full):
    """The asked runs with a small pitch and with the full geometry, in both of which wheels fly.

    Parameters
    ----------
    asked : sequence of float
        Speeds, m/s.
    small, full : suspension.sweep.Drive
        On a ground that only pushes.
    """

    def cells(i):
        for run in (small, full):
            yield {
                "contact lost at X (m)": "–" if run.kept[i] else fixed(run.lost[i], 4),
                "largest pitch (degrees)": fixed(np.degrees(run.pitch[i]), 1),
                "in the air, rear and front (ms)": " and ".join(
                    fixed(1e3 * t, 0) for t in run.airtime[:, i]
                ),
                "acceleration (m/s²)": number(run.acceleration[i]),
            }

    rows = []
    for i, v in enumerate(asked):
        one, other = cells(i)
        rows.append({"v (m/s)": f"{v:g}", **{name: f"{one[name]}, {other[name]}" for name in one}})
    return f"{table(rows)}\n\nIn each cell: with a small pitch, with the full geometry."


def geometry_sentence(asked, small, full):
    """What the full geometry changes; arguments as in `geometry_table`."""
    turned = np.extract(small.kept != full.kept, asked)
    verdict = f"The verdict turns at {speed_list(turned)}." if turned.size else "No verdict turns."
    i = int(np.argmax(full.pitch))
    wrong = np.abs(small.acceleration / full.acceleration - 1)
    worst = int(np.argmax(wrong))
    return (
        f"{verdict} The pitch is largest at {speed_list([asked[i]])}, "
        f"{fixed(np.degrees(full.pitch[i]), 1)} degrees, whose cosine is not 1 but "
        f"{fixed(np.cos(full.pitch[i]), 3)}. "
        f"The largest acceleration is wrong most at {speed_list([asked[worst]])}, by "
        f"{percent(wrong[worst])}."
    )


def models(flights, relaxed, robot):
    """What the other model of the free wheel changes at the asked speeds, a row for each.

    Parameters
    ----------
    flights, relaxed : dict of float to Flight
        For each speed, m/s: the wheel follows, the wheel relaxes.
    robot : Robot
    """
    rows = []
    for v, flight in flights.items():
        pairs = list(zip(flight.events, relaxed[v].events))
        common = [(a, b) for a, b in pairs if a[:2] == b[:2]]
        if not common:
            continue
        alike = len(common) == len(flight.events) == len(relaxed[v].events)
        moved, harder = np.abs([(a.t - b.t, a.force - b.force) for a, b in common]).max(axis=0)
        rows.append(
            {
                "v (m/s)": f"{v:g}",
                "switches": f"{len(common)}, the same" if alike else "not the same",
                "moved by up to (ms)": _bound(1e3 * moved),
                "landing force changed by up to (N)": _bound(harder),
                "$c/k$ (ms)": number(1e3 * (robot.c / robot.k).max(), 2),
            }
        )
    return table(rows) if rows else "No wheel flies at these speeds, so the two rules are one."


def rules_apart(flights, relaxed):
    """How far the two models differ at the asked speeds, a sentence; arguments as in `models`."""
    moved = []
    for v, flight in flights.items():
        pairs = list(zip(flight.events, relaxed[v].events))
        if len(flight.events) != len(relaxed[v].events) or any(a[:2] != b[:2] for a, b in pairs):
            return f"At {v:g}{SPACE}m/s they do not even have the same switches."
        moved += [abs(a.t - b.t) for a, b in pairs]
    if not moved:
        return "At the asked speeds no wheel flies, so the two rules are one."
    within = "a microsecond" if max(moved) < SHORT else quantity(1e3 * max(moved), "ms", 2)
    return f"At the asked speeds their switches agree to {within}."


def _bound(x):
    return "< 0.001" if x < 1e-3 else number(x, 2)


def first_flights(pairs):
    """The first flight at each speed in both models, a row for each.

    Parameters
    ----------
    pairs : sequence of (Flight, Flight)
        The wheel follows, the wheel relaxes; at the same speed.
    """
    rows = []
    for follows, relaxes in pairs:
        one, other = _first(follows), _first(relaxes)
        if one and other:
            (up, down), (_, late) = one, other
            rows.append(
                {
                    "v (m/s)": number(follows.v, 4),
                    "wheel": WHEEL[up.wheel],
                    "follows: in the air (ms)": fixed(1000 * (down.t - up.t), 2),
                    "back with (N)": _force(down.force),
                    "relaxes: in the air (ms)": fixed(1000 * (late.t - up.t), 2),
                    "then back with (N)": _force(late.force),
                }
            )
    if not rows:
        return "At none of these speeds is there a flight that ends, in either model."
    return table(rows)


def _first(flight):
    """The first lift-off and the landing of the same wheel, or None."""
    for event in flight.events[1:]:
        if event.wheel == flight.events[0].wheel:
            return flight.events[0], event
    return None


def flight_caption(flights):
    """Caption of forces and heights, a column for each Flight."""
    speeds = join(f"{flight.v:g}" for flight in flights)
    kept = [flight.v for flight in flights if not flight.events]
    note = f" At {speed_list(kept)} no wheel leaves the ground." if kept else ""
    text = (
        f"Runs at {speeds}{SPACE}m/s, wheels following the spring: normal forces (dotted: the "
        "linear model, whose ground may pull) and heights of the wheels above the ground."
    )
    columns = " ".join(f"At {flight.v:g}{SPACE}m/s {_story(flight)}." for flight in flights)
    alt = (
        f"{count(len(flights), 'column').capitalize()}, one for each speed: normal forces of both "
        f"wheels, and below the heights of the wheels above the ground. {columns}"
    )
    return Caption(text + note, alt)


def _story(flight):
    if not flight.events:
        return "both forces stay positive and both heights at zero"
    first = flight.events[0]
    rear, front = (fixed(1000 * h, 1) for h in flight.highest)
    return (
        f"the {WHEEL[first.wheel]} wheel is the first to lift off, at {fixed(first.t, 3)}{SPACE}s; "
        f"the rear wheel rises up to {rear}{SPACE}mm, the front wheel up to {front}{SPACE}mm"
    )


def film_caption(v, told):
    """Caption of the film at `v` in m/s; `told` as `suspension.travel.moments` returns it."""
    words = join(f"{_what(moment)} ({fixed(moment.t, 3)}{SPACE}s)" for moment in told)
    flies = any(moment.kind == "lift-off" for moment in told)
    hangs = " A wheel in the air hangs from its extended spring." if flies else ""
    text = f"The robot at {v:g}{SPACE}m/s in true proportions: {words}.{hangs}"
    alt = f"{count(len(told), 'frame').capitalize()} of the robot at {v:g}{SPACE}m/s: {words}."
    return Caption(text, alt)


def _what(moment):
    """What happens at a moment of a drive, in words."""
    if moment.wheel is None:
        return {"top": "the body is over it", "past": "both have passed"}[moment.kind]
    return {
        "foot": "the {} wheel reaches the bump",
        "top": "the {} wheel is on its top",
        "lift-off": "the {} wheel lifts off",
        "apex": "it is at the top of this flight",
        "landing": "it lands",
        "highest": "the {} wheel is at its highest",
    }[moment.kind].format(WHEEL[moment.wheel])


def order_caption(v, end, orders):
    """Caption of RK4 through a flight.

    Parameters
    ----------
    v, end : float
        Speed, m/s, and final time, s.
    orders : tuple of float
        Observed when the switches are ignored, and when they are located.
    """
    blind, located = (fixed(order, 1) for order in orders)
    return Caption(
        f"RK4 through a flight at {v:g}{SPACE}m/s: error at $t$ = {fixed(end, 3)}{SPACE}s when the "
        f"steps ignore the switches (observed order {blind}), and when they are fitted between "
        f"them ({located}).",
        "Error against time step on logarithmic axes: RK4 that ignores the switches falls with "
        f"slope {blind}, RK4 that stops at each switch with slope {located}.",
    )
