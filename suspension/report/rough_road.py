"""Words of Part XI: rides on rough roads.

`found` is a `suspension.rides.Rides` with the axes roads, suspensions and speeds, `longer` the same
without the waves that are too short for the classes.
"""

import numpy as np

from suspension.measured import Share
from suspension.report.rows import table
from suspension.report.words import SPACE, fixed, percent, share, speed_list

__all__ = ["flights", "rides_table"]


def rides_table(names, speeds, linear, short, found, longer):
    """Means over the roads, and their standard deviations.

    Parameters
    ----------
    names : sequence of str
        Of s suspensions.
    speeds : sequence of float
        m/s.
    linear, short : array_like, shape (s, speeds)
        Root mean square of the rear wheel's force of the linear robot on the whole class, N, and
        the part of its square that the short waves make.
    found, longer : Rides
    """
    rows = []
    for i, name in enumerate(names):
        for j, v in enumerate(speeds):
            flown, left = (each.flights[..., i, j].sum(axis=0) for each in (found, longer))
            rows.append(
                {
                    "suspension": name,
                    "v (m/s)": f"{v:g}",
                    "scatter of the force, linear (N)": fixed(linear[i][j], 2),
                    "share of short waves": percent(short[i][j], 3),
                    "scatter of the force (N)": _spread(found.force[0, :, i, j], 2),
                    "acceleration (m/s²)": _spread(found.acceleration[:, i, j], 2),
                    "rear wheel in the air": share(found.air[0, :, i, j].mean()),
                    "flights": _spread(flown, 1),
                    "flights, long waves only": _spread(left, 1),
                }
            )
    return table(rows)


def _spread(values, decimals):
    """Mean and standard deviation over the roads."""
    if not np.any(values):
        return "0"
    mean = fixed(np.mean(values), decimals)
    scatter = fixed(np.std(values, ddof=1), decimals)
    return mean if float(scatter) == 0 else f"{mean} ± {scatter}"


def flights(names, speeds, linear, found, longer):
    """Who flies where, what that does to the force, and what short waves have to do with it.

    Parameters
    ----------
    names, speeds, linear, found, longer
        As for `rides_table`.
    """
    lines, linear = [], np.asarray(linear)
    for i, name in enumerate(names):
        flown, left = (each.flights.sum(axis=0)[:, i] > 0 for each in (found, longer))
        if not flown.any():
            below = percent(Share(0, len(flown)).high)
            lines.append(
                f"**{_subject(name)} flew on none of {len(flown)} roads.** With 95{SPACE}% "
                f"confidence it flies on less than {below} of such roads; that many roads can tell "
                "no more."
            )
            continue
        flies, every = flown.any(axis=0), flown.all(axis=0)
        where = [
            f"on {which} at {_speeds(speeds, some)}"
            for which, some in (("every road", every), ("some roads", flies & ~every))
            if some.any()
        ]
        line = f"**{_subject(name)} flies {' and '.join(where)}.**"
        ratio = found.force[0, :, i].mean(axis=0)[flies] / linear[i][flies]
        if (ratio < 1).all():
            line += " The force on its rear wheel then scatters less than the linear robot's."
        left = left.any(axis=0)
        if not left.any():
            line += " Without the short waves it never flies."
        elif (flies & ~left).any():
            line += f" Without the short waves it flies only at {_speeds(speeds, left)}."
        lines.append(line)
    return "\n\n".join(lines)


def _subject(name):
    return "As it is, the robot" if name == "as it is" else f"With the suspension “{name}” it"


def _speeds(speeds, some):
    return speed_list([v for v, one in zip(speeds, some) if one])
