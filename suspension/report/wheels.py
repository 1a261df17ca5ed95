"""Sentences, tables and captions on wheels that weigh something, and on energy in the air."""

import numpy as np

from suspension.forces import WHEEL
from suspension.report.airborne import air
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
    "energy_caption",
    "energy_sentence",
    "free_wheels_caption",
    "grams",
    "heaviest_caption",
    "heaviest_sentence",
    "landing_table",
    "limit_table",
    "mass_table",
    "surviving_rule",
]


def grams(mass):
    """A mass in kg as grams.

    >>> grams(0.00817)
    '8.2\\xa0g'
    """
    return quantity(1e3 * mass, "g", 2)


def limit_table(v, rules, runs):
    """Airtime and height of the first wheel to fly, by both rules and by wheels with mass.

    Parameters
    ----------
    v : float
        Speed, m/s.
    rules : dict of str to Flight
        Of a wheel without mass.
    runs : sequence of (Tyre, Rolling)
        Heavy wheels first.
    """
    rows = [
        {
            "wheel pair (g)": number(1e3 * tyre.mass, 2),
            "tyre (N/m)": number(tyre.stiffness, 2),
            "its damping ratio": number(tyre.damping / 2 / np.sqrt(tyre.mass * tyre.stiffness), 2),
            **air(run),
        }
        for tyre, run in runs
    ]
    rows += [
        {"wheel pair (g)": "0", "tyre (N/m)": "rigid", "its damping ratio": name, **air(flight)}
        for name, flight in rules.items()
    ]
    return table(rows)


def surviving_rule(rules, lightest):
    """The airtime by each rule, beside that of the lightest wheels, a table.

    Parameters
    ----------
    rules : dict of str to Flight
        ``"follows"`` and ``"relaxes"``.
    lightest : sequence of Rolling
        The lightest wheel of each way to the limit.
    """
    if not all((run.airtime > 0).all() for run in (*rules.values(), *lightest)):
        return "With this spring not every wheel flies here: nothing is decided."
    rows = []
    for name, flight in rules.items():
        off = np.concatenate([flight.airtime / run.airtime - 1 for run in lightest])
        worst = off[np.argmax(np.abs(off))]
        rows.append(
            {
                "a wheel without mass": name,
                "airtime, beside that of the lightest wheels": f"{percent(abs(worst), 2)} too "
                + ("long" if worst > 0 else "short"),
            }
        )
    return table(rows)


def free_wheels_caption(v, masses):
    """Caption of the heights of free wheels at `v` in m/s; `masses` of wheel pairs in kg."""
    text = (
        f"The front wheel at {v:g}{SPACE}m/s: its height above the ground by the two rules for a "
        f"wheel without mass, and for wheel pairs of {join(grams(m) for m in masses)} on ever "
        "stiffer tyres (grey, the lighter the darker)."
    )
    alt = (
        f"Height of the front wheel against time at {v:g}{SPACE}m/s for wheel pairs of "
        f"{join(grams(m) for m in masses)} and for two rules of a wheel without mass. The curves "
        "of ever lighter wheels approach a limit."
    )
    return Caption(text, alt)


def mass_table(speeds, masses, runs, flights):
    """What wheels that weigh something do at each speed: the first loss, airtime and height.

    Parameters
    ----------
    speeds, masses : sequence of float
        m/s and kg.
    runs : dict of (float, float) to Rolling
        For each speed and mass.
    flights : dict of float to Flight
        Of wheels without mass, for each speed.
    """
    rows = []
    for v in speeds:
        for mass in (0.0, *masses):
            run = runs[v, mass] if mass else flights[v]
            if mass:
                first = run.loss and (run.loss[0], v * run.loss[1])
            else:
                event = run.events[0] if run.events else None
                first = event and (event.wheel, event.X)
            rows.append(
                {
                    "v (m/s)": f"{v:g}",
                    "wheel pair (g)": f"{1e3 * mass:g}",
                    "contact": f"{WHEEL[first[0]]}, {fixed(first[1], 3)}" if first else "kept",
                    **air(run),
                    "largest force (N)": fixed(run.N.max(), 1),
                }
            )
    return f"{table(rows)}\n\n*Contact*: kept, or the wheel that loses it first and the place X, m."


def heaviest_caption(asked):
    """Caption of the mass that a wheel pair may have; `asked` speeds in m/s."""
    text = (
        "How heavy a wheel pair on a rigid tyre may be without leaving the ground. Below the curve "
        "contact is kept; where the field is blue up to the top, at any mass. Dashed: "
        f"{speed_list(asked)}."
    )
    alt = (
        "Mass of a wheel pair against speed, both on logarithmic axes: blue where contact is kept, "
        f"red where it is lost. Dashed lines at {speed_list(asked)}."
    )
    return Caption(text, alt)


def heaviest_sentence(regimes, v, mass, body):
    """For which wheels faster is safer.

    Parameters
    ----------
    regimes : Regimes
        Of wheels without mass.
    v, mass : array_like, shape (n,)
        Speeds, m/s, dense and within the regimes, and the heaviest wheel pairs there, kg.
    body : float
        Mass of the body, kg.
    """
    v, mass = np.asarray(v), np.asarray(mass)
    if not len(regimes.regained):
        return "Contact, once lost, is not found again at a higher speed."
    low, high = regimes.regained[-1]
    inside = (low < v) & (v < high)
    most = mass[inside].max() if inside.any() else 0.0
    where = f"the window from {number(low)} to {number(high)}{SPACE}m/s"
    if np.isinf(most):
        return f"In a part of {where} a wheel may weigh what it likes."
    words = (
        f"**Faster is safer for light wheels only.** In {where}, where wheels without mass keep "
        f"contact, a pair may weigh {grams(most)} at best, {percent(most / body, 1)} of the mass "
        "of the body"
    )
    half = v[inside & (mass >= most / 2)].max(initial=low)
    if (inside & (v > half)).any():
        words += f", and less than half of that above {number(half, 2)}{SPACE}m/s"
    return f"{words}."


def energy_caption(v):
    """Caption of the ribbon of energy at `v` in m/s."""
    text = (
        f"Where the energy goes at {v:g}{SPACE}m/s: the ribbon is as wide as the work of the road "
        "up to there. Each ascent of the bump puts some in; what is left is handed to and fro "
        "between motion, weight and springs, and ends as heat of the dampers. Orange at the foot: "
        "a wheel is in the air."
    )
    alt = (
        f"Stacked bands of energy against position at {v:g}{SPACE}m/s: heat of the dampers, motion "
        "of the body, energy of weight and springs; their sum is the work of the road, which is "
        "constant behind the bump."
    )
    return Caption(text, alt)


def energy_sentence(energy, landings):
    """How much the road puts in, what is heat at the end, and what landings have to do with it.

    Parameters
    ----------
    energy : Energy
    landings : sequence of Landing
    """
    work, heat = energy.work[-1], energy.heat[-1]
    words = (
        f"The road puts in {quantity(1e3 * work, 'mJ')}; at the end of the run "
        f"{percent(heat / work)} of it is heat."
    )
    if not landings:
        return f"{words} No wheel lands on the way."
    return (
        f"{words} Of this heat {percent(sum(landing.heat for landing in landings) / heat)} arises "
        f"on the ground after the {count(len(landings), 'landing')}."
    )


def landing_table(landings):
    """A row for each landing: when, how fast, force at once, and what follows on the ground."""
    return table(
        [
            {
                "t (s)": fixed(landing.t, 3),
                "wheel": WHEEL[landing.wheel],
                "meets at (m/s)": fixed(landing.speed, 2),
                "force at once (N)": fixed(landing.force, 2),
                "on the ground (s)": fixed(landing.end - landing.t, 3),
                "impulse (N s)": fixed(landing.impulse, 2),
                "heat (mJ)": fixed(1e3 * landing.heat, 1),
            }
            for landing in landings
        ]
    )
