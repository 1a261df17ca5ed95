"""The chart of the highest bumps, as the page is handed it and as a still picture."""

from math import prod

import matplotlib.pyplot as plt
import numpy as np

from suspension.contact import Regimes
from suspension.figures import plot_chart
from suspension.report.words import quantity, ranges
from suspension.similarity import follow, groups, highest_bump, skim, throw

__all__ = ["chart_facts", "check", "describe_chart", "draw_chart", "limit_at", "limits"]

SPEEDS = 160
MM = 1000
# By name, which of the groups a limit depends on.
LIMITS = {
    "follow": lambda G: follow(G.nu, G.j),
    "throw": lambda G: throw(G.nu),
    "skim": lambda G: skim(G.nu, G.zeta),
}


def check(family):
    """Raise ValueError unless there is a highest bump: of one that is no hole, under a load."""
    robot, road = family.robot, family.road
    if not (family.has_bump and road.height > 0 and robot.g > 0):
        raise ValueError(
            "compact must not be 'chart' unless road is a GaussianBump with a height > 0 and "
            f"robot has a weight (g > 0), got {road!r} and g={robot.g}"
        )


def chart_facts(family, speeds, distance):
    """What the page cannot compute: the ends of the chart's heights, m, and its three limits."""
    v = np.geomspace(*speeds, SPEEDS)
    highest = highest_bump(family.robot, family.road, v, distance=distance)
    lowest = min(highest.min(), family.road.height)
    ends = [0.3 * lowest, 5 * family.ranges["height"].high]
    return {"heights": ends, "limits": limits(family)}


def limits(family):
    """The limits by hand as products of powers of the sliders' traits; none if not symmetric.

    Parameters
    ----------
    family : suspension.explorer.family.Family

    Returns
    -------
    limits : list of dict
        ``name``; ``amplitude``, the highest bump in m where v, k, c and sigma are 1 in SI units;
        ``powers``, a dict of those on which it depends.
    """
    own = {"v": 1.0} | family.own
    at = {name: own[name] or 1.0 for name in ("v", "k", "c", "sigma")}  # no damper has no zeta
    try:
        _groups(family, at)
    except ValueError:
        return []
    return [{"name": name} | _powers(family, limit, at) for name, limit in LIMITS.items()]


def limit_at(limit, at):
    """The height of one of the `limits` at some settings, m."""
    return prod(
        (at[name] ** power for name, power in limit["powers"].items()), start=limit["amplitude"]
    )


def _groups(family, at):
    """The groups at some settings, and the sag by which they measure a height, m."""
    robot = family.robot_at(at["k"], at["c"])
    bump = family.road_at(family.road.height, at["sigma"])
    found = groups(robot, bump, at["v"])
    return found, bump.height / found.eta


def _powers(family, limit, at):
    """A height that is a product of powers, taken apart at some settings."""

    def height(at):
        found, sag = _groups(family, at)
        return float(sag * limit(found))

    powers, amplitude = {}, height(at)
    for name, value in at.items():
        power = np.log2(height(at | {name: 2 * value}) / height(at))
        power = round(2 * power) / 2  # all are whole or half
        if power:
            powers[name] = power
            amplitude /= value**power
    return {"amplitude": amplitude, "powers": powers}


def _found(explorer):
    """Where contact is kept and lost at the present settings, for the speeds of the slider."""
    reach = explorer.ranges["v"]
    critical = np.asarray(explorer.facts["exact"]["critical"])
    inside = critical[(reach.low < critical) & (critical < reach.high)]
    edges = np.array([reach.low, *inside, reach.high])
    middles = np.sqrt(edges[:-1] * edges[1:])
    return Regimes(edges, _highest(explorer, middles) < explorer.height)


def _highest(explorer, v):
    return highest_bump(explorer.robot, explorer.road, v, distance=explorer.distance)


def draw_chart(explorer):
    """The chart at the present settings, in m/s and mm, as a figure."""
    reach, found = explorer.ranges["v"], _found(explorer)
    v = np.geomspace(reach.low, reach.high, SPEEDS)
    at = {"v": v} | {name: getattr(explorer, name) for name in ("k", "c", "sigma")}
    lines = {
        limit["name"]: MM * limit_at(limit, at)
        for limit in explorer.facts["chart"]["limits"]
        if explorer.c > 0 or "c" not in limit["powers"]  # no damper, no such limit
    }
    asked = np.array(explorer.asked)
    lost = found(asked) if len(asked) else asked
    bump = (MM * explorer.height, asked, lost, found.critical, found.spans(lost=False))
    with plt.style.context("suspension.figures.report"):
        figure, ax = plt.subplots(figsize=(7.2, 4.4))
        plot_chart(
            v,
            {explorer.c: MM * _highest(explorer, v)},
            lines,
            bump=bump if explorer.height > 0 else None,
            own=explorer.c,
            heights=MM * np.array(explorer.facts["chart"]["heights"]),
            ax=ax,
        )
        ax.set(xlabel="speed $v$ (m/s)", ylabel="height of the bump (mm)")
    return figure


def describe_chart(explorer):
    """What the chart says, in words."""
    return (
        "The highest bump that is crossed with contact, at every speed, both on logarithmic axes. "
        f"Over a bump of {quantity(MM * explorer.height, 'millimetres')}, contact is "
        f"{ranges(_found(explorer))}."
    )
