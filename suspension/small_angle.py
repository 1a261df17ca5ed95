"""What the small pitch of Eqs. 1 to 6 costs a critical speed: the same speed in the full geometry.

With ``sin theta`` and ``cos theta`` in place there is no closed form; the margins are those of runs
on a ground that pulls, `suspension.sweep.drive`, which go through zero smoothly. `margin_with`
takes the terms one at a time.
"""

from collections.abc import Collection

import numpy as np
from scipy.integrate import solve_ivp

from suspension import _checks
from suspension.least_force import distance_over, margin, sample_count
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.sweep import drive

__all__ = ["TERMS", "full_geometry", "margin_with"]

TERMS = ("heights", "places", "levers")  # what a small pitch simplifies
SPACING = 100  # samples of a run for each sigma of the bump
MAX_SAMPLES = 10**5
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


def margin_with(
    robot: Robot,
    bump: GaussianBump,
    v: float,
    terms: Collection[str],
    *,
    distance: float | None = None,
) -> float:
    """The margin when only some of the terms that a small pitch simplifies are put right.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.
    terms : collection of str
        Which of `TERMS`: the ``"heights"`` of the body's ends, ``L sin theta``, and their rates;
        the ``"places"`` of the wheels along the road, ``L cos theta``, and their speeds along it;
        the ``"levers"`` of the forces, ``L cos theta``.
    distance : float, optional
        How far the run goes, m: 1.25 m if the whole bump lies within (`distance_over`).

    Returns
    -------
    margin : float
        The least sample of both normal forces on a ground that pulls, N, good to a millinewton
        for the robots of this book. Without any term it is that of `suspension.margin`.

    Raises
    ------
    ValueError
        If an argument is out of its range, a term has another name, or the run would take more than
        10^5 samples.

    Examples
    --------
    >>> robot, bump = Robot(800, 800), GaussianBump()
    >>> [round(margin_with(robot, bump, 0.43, terms), 2) for terms in ((), TERMS)]
    [0.27, 0.58]
    """
    distance = distance_over(robot, bump, distance)
    v = _checks.positive("v", v)
    for term in terms:
        _checks.one_of("terms", term, TERMS)
    n = 2 * sample_count(robot, v, distance) + SPACING * distance / bump.sigma
    if not n <= MAX_SAMPLES:
        raise ValueError(
            f"v must be so high, and distance so short, that at most {MAX_SAMPLES} samples are "
            f"needed, got v={v:g} over {distance:g} m: {n:.2g}"
        )
    arms, k, c = (values[:, None] for values in (robot.arms, robot.k, robot.c))

    def wheels(X, w):
        """Forces, N, and their levers, m, shape (2, n), in states w, shape (4, n)."""
        Y, rise, theta, turn = w
        sine, cosine = np.sin(theta), np.cos(theta)
        up, up_rate = (sine, cosine * turn) if "heights" in terms else (theta, turn)
        ahead, back = (cosine, sine * turn) if "places" in terms else (1.0, 0.0)
        h, slope = bump(X + arms * ahead)
        N = k * (h - Y - arms * up) + c * (slope * (v - arms * back) - rise - arms * up_rate)
        return N, arms * (cosine if "levers" in terms else np.ones_like(theta))

    def motion(X, w):
        N, levers = wheels(X, w[:, None])
        lift, turn = N.sum() / robot.m - robot.g, (N * levers).sum() / robot.Izz
        return np.array([w[1], lift, w[3], turn]) / v

    X = np.linspace(0, distance, 2 + int(n))
    how = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-12, "max_step": bump.sigma}
    run = solve_ivp(motion, (0, distance), robot.equilibrium, t_eval=X, **how)
    return float(wheels(X, run.y)[0].min())
