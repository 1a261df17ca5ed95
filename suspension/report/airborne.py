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
    small_angle,
    speed_list,
)

__all__ = [
    "contact_states_caption",
    "film_caption",
    "first_flights",
    "flight_caption",
    "flight_table",
    "geometry_sentence",
    "geometry_table",
    "models",
    "order_caption",
    "order_sentence",
    "who_flies",
]

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
    return "\n\n".join([table([_row(flight, robot) for flight in flights]), note])


def _row(flight, robot):
    hardest = max(_landings(flight), key=lambda event: event.force, default=None)
    settled = flight.settled(robot)
    if hardest is None:
        touch_down = "–"
    elif hardest.force < NO_JUMP:
        touch_down = "no jump"
    else:
        touch_down = f"{number(hardest.force, 2)} ({WHEEL[hardest.wheel]})"
    return {
        "v (m/s)": f"{flight.v:g}",
        "flights": str(sum(event.kind == "lift-off" for event in flight.events)),
        "in the air: rear, front (s)": ", ".join(fixed(t, 3) for t in flight.airtime),
        "highest: rear, front (mm)": ", ".join(fixed(1000 * h, 1) for h in _highest(flight)),
        "hardest touch-down (N)": touch_down,
        "largest force (N)": fixed(flight.N.max(), 1),
        "settled after (s)": fixed(settled, 2) if np.isfinite(settled) else f"> {flight.T[-1]:g}",
    }


def _landings(flight):
    return [event for event in flight.events if event.kind == "landing"]


def _highest(flight):
    return flight.gaps.max(axis=1)


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
        least = min(flights, key=lambda v: flights[v].N.min())
        return (
            f"With this spring no wheel leaves the ground at any of the "
            f"{count(len(flights), 'speed')}: each run *is* the linear solution, from beginning to "
            f"end. The least force, {number(flights[least].N.min(), 2)}{SPACE}N, is that at "
            f"{speed_list([least])}."
        )
    claims = join(f"{fixed(linear[v].N.min(), 1)}{SPACE}N at {v:g}{SPACE}m/s" for v in fliers)
    every = "each" if len(fliers) == len(flights) else speed_list(fliers)
    return (
        f"Of the {count(len(flights), 'speed')} the robot flies at {every}. Up to the first "
        "lift-off the flight *is* the linear solution. After it, the linear model pulls the body "
        f"down where nothing holds it: it claims forces down to {claims}, which do not exist."
        f"\n\n{_hardness([flights[v] for v in fliers])}"
    )


def _hardness(flights):
    """How hard the landings are, beside the largest force of the same runs."""
    hard = max((event.force for flight in flights for event in _landings(flight)), default=None)
    largest = max(flight.N.max() for flight in flights)
    if hard is None:
        return "No wheel lands in the time of the run."
    if hard < NO_JUMP:
        return "Every landing is smooth: the force comes back from zero, without a jump."
    words = (
        f"The hardest touch-down gives {number(hard, 2)}{SPACE}N at once; the largest force in the "
        f"same runs is {number(largest, 3)}{SPACE}N."
    )
    if hard < 0.3 * largest:
        words += (
            " So the jump is small, because the damper is weak; what the body feels is the "
            "spring's force after it."
        )
    return words


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
                    fixed(1e3 * t, 1) for t in run.airtime[:, i]
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
        f"{fixed(np.degrees(full.pitch[i]), 1)} degrees, where {small_angle(full.pitch[i])}. "
        f"The largest acceleration is wrong most at {speed_list([asked[worst]])}, by "
        f"{percent(wrong[worst])}."
    )


def models(flights, relaxed, robot):
    """What the other model of the free wheel changes at the asked speeds.

    Parameters
    ----------
    flights, relaxed : dict of float to Flight
        For each speed, m/s: the wheel follows, the wheel relaxes.
    robot : Robot
    """
    speeds = [v for v in flights if flights[v].events]
    if not speeds:
        return "No wheel flies at these speeds, so the two models of a free wheel are one."
    if not robot.c.any():
        return "Without dampers a free wheel has nothing to relax against: the models are one."
    apart, harder, same = 0.0, 0.0, True
    for v in speeds:
        one, other = flights[v].events, relaxed[v].events
        same = same and [e[:2] for e in one] == [e[:2] for e in other]
        for a, b in zip(one, other):
            if a[:2] != b[:2]:
                break
            apart = max(apart, abs(a.t - b.t))
            harder = max(harder, abs(a.force - b.force))
    constant = 1000 * (robot.c / robot.k).max()
    words = (
        f"At {speed_list(speeds)} a wheel that relaxes instead moves "
        f"{'no switch' if same else 'the common switches'} by {'more' if same else 'up to'}"
        f"{' than' if same else ''} {_time(apart)} and changes a landing force by at most "
        f"{_force(harder)}"
    )
    if not same:
        return f"{words}; some switches exist in one model only."
    if apart < 1e-5:
        return (
            f"{words}, for a plain reason: its time constant c/k is "
            f"{number(constant, 2)}{SPACE}ms, and it has found its place long before it lands."
        )
    return (
        f"{words}: its time constant c/k is {number(constant, 2)}{SPACE}ms, and not every flight "
        "is long against it."
    )


def _time(t):
    return f"{number(1e6 * t, 2)}{SPACE}µs" if t < 1e-3 else f"{number(1e3 * t, 2)}{SPACE}ms"


def _force(force):
    return f"{number(1e3 * force, 2)}{SPACE}mN" if force < 0.1 else quantity(force, "N", 2)


def first_flights(pairs):
    """The first flight at each speed in both models, a table and what it shows.

    Parameters
    ----------
    pairs : sequence of (Flight, Flight)
        The wheel follows, the wheel relaxes; at the same speed.
    """
    pairs = [pair for pair in pairs if all(_first(flight) for flight in pair)]
    if not pairs:
        return "At none of these speeds is there a flight that ends, in either model."
    rows = []
    apart = {}
    smooth = []
    for follows, relaxes in pairs:
        (up, down), (_, late) = _first(follows), _first(relaxes)
        apart[follows.v] = late.t - down.t, late.force - down.force
        if down.force < NO_JUMP:
            smooth.append(follows.v)
        rows.append(
            {
                "v (m/s)": number(follows.v, 4),
                "wheel": WHEEL[up.wheel],
                "follows: in the air (ms)": fixed(1000 * (down.t - up.t), 2),
                "back with (N)": fixed(max(down.force, 0), 3),
                "relaxes: in the air (ms)": fixed(1000 * (late.t - up.t), 2),
                "then back with (N)": fixed(max(late.force, 0), 3),
            }
        )
    words = [_smooth_words(smooth, len(pairs))]
    v = max(apart, key=lambda v: apart[v][1])
    later, force = apart[v]
    latest = max(apart, key=lambda v: apart[v][0])
    if abs(later) > 1e-5:
        words.append(
            f"In force the two models part most at {speed_list([v])}: the wheel that relaxes comes "
            f"back with {number(force, 2)}{SPACE}N more at once, "
            f"{number(1000 * later, 2)}{SPACE}ms later."
        )
        if latest != v:
            words.append(
                f"In time they part most at {speed_list([latest])}, by "
                f"{number(1000 * apart[latest][0], 2)}{SPACE}ms."
            )
    else:
        words.append("Between the two models there is hardly a difference at these speeds.")
    return "\n\n".join([table(rows), " ".join(words)])


def _first(flight):
    """The first lift-off and the landing of the same wheel, or None."""
    for event in flight.events[1:]:
        if event.wheel == flight.events[0].wheel:
            return flight.events[0], event
    return None


def _smooth_words(smooth, of):
    if not smooth:
        return "Every one of these flights ends with a jump of the force."
    where = "all of these speeds" if len(smooth) == of else speed_list(smooth)
    return (
        f"At {where} the footnote's wheel never rises: Eq. 5 turns positive again while the spring "
        "is still compressed, and the force comes back as it went, **without a jump**."
    )


def flight_caption(flights):
    """Caption of forces and heights, a column for each Flight."""
    speeds = join(f"{flight.v:g}" for flight in flights)
    kept = [flight.v for flight in flights if not flight.events]
    if not kept:
        note = ""
    elif len(kept) == len(flights):
        note = " No wheel leaves the ground here; these speeds are the nearest to it."
    else:
        note = f" At {speed_list(kept)} no wheel leaves the ground; it is the nearest to it."
    text = (
        f"Runs at {speeds}{SPACE}m/s, wheels following the spring: normal forces (dotted: the "
        "linear "
        f"model, whose ground may pull) and heights of the wheels above the ground.{note}"
    )
    columns = " ".join(f"At {flight.v:g}{SPACE}m/s {_story(flight)}." for flight in flights)
    alt = (
        f"{count(len(flights), 'column').capitalize()}, one for each speed: normal forces of both "
        f"wheels, and below the heights of the wheels above the ground. {columns}"
    )
    return Caption(text, alt)


def _story(flight):
    if not flight.events:
        return "both forces stay positive and both heights at zero"
    first = flight.events[0]
    rear, front = (fixed(1000 * h, 1) for h in _highest(flight))
    return (
        f"the {WHEEL[first.wheel]} wheel is the first to lift off, at "
        f"{fixed(first.t, 3)}{SPACE}s; the "
        f"rear wheel rises up to {rear}{SPACE}mm, the front wheel up to {front}{SPACE}mm"
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
    text = (
        f"RK4 through a flight at {v:g}{SPACE}m/s: error at $t$ = {fixed(end, 3)}{SPACE}s when "
        "the steps "
        "ignore the switches, and when they are fitted between them."
    )
    alt = (
        "Error against time step on logarithmic axes: RK4 that ignores the switches falls with "
        f"slope {fixed(orders[0], 1)}, RK4 that stops at each switch with slope "
        f"{fixed(orders[1], 1)}."
    )
    return Caption(text, alt)


def order_sentence(v, orders):
    """The orders observed at `v` in m/s, None if nothing lands; `orders` as in `order_caption`."""
    if v is None:
        return (
            "With this spring no wheel lands at the asked speeds, so there is no switch to study "
            "there. [Part VI](../notebooks/06-how-sure.ipynb) says where one does."
        )
    blind, located = orders
    words = (
        f"Observed orders: {fixed(blind, 1)} when the switches are ignored, {fixed(located, 1)} "
        "when they are located."
    )
    if blind < 2 and abs(located - 4) < 0.5:
        return f"{words} The fourth order is lost at one switch, and found again by stopping there."
    if located > blind + 0.5:
        return f"{words} Stopping at each switch pays, though the full order does not show here."
    return f"{words} With these steps the difference is not to be seen."
