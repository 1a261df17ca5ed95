"""What the small pitch of Eqs. 1 to 6 costs a critical speed: the same speed in the full geometry.

With ``sin theta`` and ``cos theta`` in place there is no closed form; the margins are those of runs
on a ground that pulls, `suspension.sweep.drive`, which go through zero smoothly.
"""

import numpy as np

from suspension import _checks
from suspension.least_force import distance_over, margin
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.sweep import drive

__all__ = ["full_geometry"]

SPEEDS = 41  # at a time; odd, so that the one that is asked about is among them
SLIGHTLY = 1e-6  # how far to either side one sees which way the verdict turns, relative


def full_geometry(
    robot: Robot,
    bump: GaussianBump,
    critical: float,
    *,
    within: float = 0.1,
    distance: float | None = None,
) -> float | None:
    """The critical speed of the full geometry that belongs to one of the small pitch.

    Of all zeros of the margin nearby in which the verdict turns the same way, the nearest.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    critical : float
        A critical speed of `suspension.contact.critical_speeds`, m/s.
    within : float
        How far to look to either side, relative, > 0 and at most 1. A fortieth of it is the
        resolution: two zeros closer to each other may be missed.
    distance : float, optional
        How far each run goes, m: 1.25 m if the whole bump lies within (`distance_over`).

    Returns
    -------
    v : float or None
        m/s, good to a part in 10^5; None if there is no such speed in the range.

    Raises
    ------
    ValueError
        If an argument is out of its range; if the verdict does not turn at `critical`; or if
        `suspension.sweep.drive` refuses.

    Examples
    --------
    >>> from suspension.contact import critical_speeds
    >>> robot, bump = Robot(800, 800), GaussianBump()
    >>> first, *_ = critical_speeds(robot, bump, 0.1, 30)
    >>> round(float(first), 4), round(full_geometry(robot, bump, first), 4)
    (0.4367, 0.4442)
    """
    distance = distance_over(robot, bump, distance)
    critical = _checks.positive("critical", critical)
    within = _checks.positive("within", within)
    if within > 1:
        raise ValueError(f"within must be at most 1, got {within:g}")

    def margins(v):
        run = drive(robot, bump, v, ground="pulls", geometry="full", distance=distance)
        return run.margin

    before, after = (
        margin(robot, bump, critical * (1 + sign * SLIGHTLY), distance=distance) for sign in (-1, 1)
    )
    if before * after > 0:
        raise ValueError(
            "critical must be a speed at which the verdict turns, as critical_speeds finds them, "
            f"got {critical:g}: the margin is {before:.3g} N a little below it and {after:.3g} N "
            "a little above"
        )
    v = critical * np.geomspace(1 / (1 + within), 1 + within, SPEEDS)
    turns = _turns(v, margins(v), after > before)
    if not len(turns):
        return None
    nearest = np.abs(np.log(turns / critical)).max(axis=1).argmin()
    v = np.linspace(*turns[nearest], SPEEDS)
    N = margins(v)
    low, high = _turns(v, N, after > before)[0]
    a, b = N[v == low][0], N[v == high][0]
    return float(low + (high - low) * a / (a - b))


def _turns(v, margin, upward):
    """Neighbouring speeds between which the margin comes up, or goes down, to zero: (n, 2)."""
    side = margin > 0
    turns = np.flatnonzero((side[1:] != side[:-1]) & (side[1:] == upward))
    return np.column_stack([v[turns], v[turns + 1]])
