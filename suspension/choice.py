"""Which springs and dampers? What a suspension must do, and the least change that does it.

A change of stiffness and damping is measured by ``sqrt(ln(k / k0)^2 + ln(c / c0)^2)``: half and
twice are equally far, and stiffness and damping count alike.
"""

from dataclasses import replace
from itertools import islice
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize

from suspension import _checks
from suspension.contact import Regimes, is_lost, regimes
from suspension.least_force import distance_over, margin
from suspension.problem import DISTANCE
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.sweep import drive

__all__ = [
    "Candidate",
    "Choice",
    "Choices",
    "Demands",
    "candidate",
    "cheapest",
    "demands",
    "efficient",
    "farthest",
    "fitted_with",
]

MAX_MARGINS = 10**4  # exact ones: some ten seconds
MAX_RUNS = 10**5  # all at once: as long
MAX_CANDIDATES = 5000  # for the best compromises: a second or two, if none beats another
STARTS = 2  # points of the grid from which the search begins
EDGE = 1e-7  # N; the search, which may miss its constraint by less, is asked for so much more


class Demands(NamedTuple):
    """The worst over several speeds, for each suspension of a map, on a ground that only pushes.

    Attributes
    ----------
    margin : ndarray, shape (m, n)
        Least margin, N; 0 where contact is lost.
    acceleration, compression : ndarray, shape (m, n)
        Largest acceleration of the body, m/s^2, and compression of a spring, m.
    air : ndarray, shape (m, n)
        The part of the way in which a wheel is in the air, at most.
    """

    margin: np.ndarray
    acceleration: np.ndarray
    compression: np.ndarray
    air: np.ndarray

    @property
    def costs(self):
        """What should be small, shape (3, m, n): want of contact, acceleration, compression.

        Who keeps contact is the better the larger the margin; who loses it is worse than all of
        these, and the worse the more of the way a wheel is in the air.
        """
        contact = np.where(is_lost(self.margin), self.air, -self.margin)
        return np.array([contact, self.acceleration, self.compression])


class Choice(NamedTuple):
    """A suspension: `robot` has it; how far it is from the given one, and the least margin, N."""

    robot: Robot
    distance: float
    margin: float


class Candidate(NamedTuple):
    """A suspension that is looked at closely: see `candidate`.

    Attributes
    ----------
    robot : Robot
    margins : dict of float to float
        Exact margins at the asked speeds, N; after a loss only their sign means something.
    worst : Demands
        Of the asked speeds, shape (1, 1).
    regimes : Regimes
        Where contact is kept and lost from the lowest to the highest of them.
    """

    robot: Robot
    margins: dict
    worst: Demands
    regimes: Regimes


class Choices(NamedTuple):
    """Choices for several demands, and a close look at each suspension.

    Attributes
    ----------
    least, reserved, wide : Choice or None
        The cheapest for contact at the asked speeds, with a reserve, and in their whole range.
    stiffest : Choice or None
        The stiffest with which contact is kept at the asked speeds.
    limit : float
        Largest displacement at which the spring was measured, m.
    candidates : dict of str to Candidate
        The present suspension, and those of the choices that are others.
    """

    least: Choice | None
    reserved: Choice | None
    wide: Choice | None
    stiffest: Choice | None
    limit: float
    candidates: dict


def fitted_with(robot, k, c):
    """The robot with stiffness `k`, N/m, and damping `c`, N s/m, on both axles.

    Parameters
    ----------
    robot : Robot
    k, c : float
        k > 0 and c >= 0.

    Returns
    -------
    robot : Robot

    Raises
    ------
    ValueError
        If `k` or `c` is out of its range.
    """
    _checks.instance("robot", robot, Robot)
    k, c = _checks.positive("k", k), _checks.nonnegative("c", c)
    return replace(robot, k1=k, k2=k, c1=c, c2=c)


def demands(robot, road, v, k, c, *, distance=None):
    """What suspensions give and ask for, the worst over several speeds: maps for a choice.

    Parameters
    ----------
    robot : Robot
        All but its springs and dampers.
    road : callable
        ``road(x) -> (H, dHdx)``.
    v : array_like, shape (speeds,)
        m/s, > 0.
    k, c : array_like, shapes (n,) and (m,)
        Stiffness, N/m, and damping, N s/m, of both axles, > 0 and in order.
    distance : float, optional
        How far each run goes, m, as in `suspension.sweep.drive`.

    Returns
    -------
    Demands
        From runs on a ground that only pushes, all at once (`suspension.sweep.drive`).

    Raises
    ------
    ValueError
        If an argument is out of its range, all together are more than 10^5 runs, or `drive` refuses
        the runs.
    """
    _checks.instance("robot", robot, Robot)
    v, k, c = _grid(v, k, c, MAX_RUNS)
    robots = np.array(
        [[fitted_with(robot, stiffness, damping) for stiffness in k] for damping in c]
    )
    found = drive(robots[:, :, None], road, v, distance=distance)
    part = found.airtime.max(axis=0) * v / (DISTANCE if distance is None else distance)
    return Demands(
        found.margin.min(axis=-1),
        found.acceleration.max(axis=-1),
        found.compression.max(axis=-1),
        part.max(axis=-1),
    )


def candidate(robot, bump, v, *, distance=None):
    """What a suspension gives and asks for at several speeds, and where it keeps contact.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : array_like, shape (speeds,)
        m/s, > 0, two or more.
    distance : float, optional
        How far each run goes, m, as in `suspension.contact.margin`.

    Returns
    -------
    Candidate

    Raises
    ------
    ValueError
        If an argument is out of its range, the axles of the robot differ or have no dampers, or
        `suspension.contact.regimes` refuses.
    """
    _own(robot, bump)
    k, c = [robot.k1], [robot.c1]
    v, _, _ = _grid(v, k, c)
    if v.min() == v.max():
        raise ValueError(f"v must hold two speeds or more, got {v}")
    return Candidate(
        robot,
        {float(u): margin(robot, bump, u, distance=distance) for u in v},
        demands(robot, bump, v, k, c, distance=distance),
        regimes(robot, bump, v.min(), v.max(), distance=distance),
    )


def efficient(costs):
    """Which of many candidates are best compromises: no other is as good in all and better in one.

    Parameters
    ----------
    costs : array_like, shape (n, criteria)
        Less is better; n is at most 5000.

    Returns
    -------
    efficient : ndarray of bool, shape (n,)

    Raises
    ------
    ValueError
        If the costs are not finite, have another shape, or are of more candidates.

    Examples
    --------
    >>> efficient([[1, 3], [2, 2], [3, 1], [3, 3]])
    array([ True,  True,  True, False])
    """
    costs = _checks.array("costs", costs, (None, None))
    if len(costs) > MAX_CANDIDATES:
        raise ValueError(f"costs must be of at most {MAX_CANDIDATES} candidates, got {len(costs)}")
    best, front, size = np.zeros(len(costs), dtype=bool), np.empty_like(costs), 0
    # In this order no later candidate beats an earlier one, and who is beaten at all is beaten by
    # one of the front.
    for i in np.lexsort(costs.T[::-1]) if costs.size else range(len(costs)):
        so_far, cost = front[:size], costs[i]
        best[i] = not ((so_far <= cost).all(axis=1) & (so_far < cost).any(axis=1)).any()
        if best[i]:
            front[size] = cost
            size += 1
    return best


def cheapest(robot, bump, v, k, c, reserve=0.0, *, distance=None):
    """The least change of stiffness and damping that keeps contact at all of several speeds.

    The suspensions of the grid are tried by exact margins, those near the robot's first. From the
    first two that keep contact SciPy's SLSQP (Kraft 1988) goes to the nearest point where every
    margin is at least `reserve`.

    Parameters
    ----------
    robot : Robot
        Both axles alike.
    bump : GaussianBump
    v : array_like, shape (speeds,)
        m/s, > 0.
    k, c : array_like, shapes (n,) and (m,)
        Stiffness, N/m, and damping, N s/m, > 0, of the grid, each in order.
    reserve : float
        What the margin must be at every speed, N, >= 0.
    distance : float, optional
        How far each run goes, m: 1.25 m if the whole bump lies within
        (`suspension.least_force.distance_over`).

    Returns
    -------
    Choice or None
        The robot itself, at distance 0, if it has the reserve already; None if no point of the
        grid has.

    Raises
    ------
    ValueError
        If an argument is out of its range, or the axles of the robot differ or have no dampers.

    Examples
    --------
    >>> k, c = np.geomspace(150, 1200, 13), np.geomspace(0.4, 4, 9)
    >>> choice = cheapest(Robot(800, 800), GaussianBump(), [0.25, 1.2, 5, 10], k, c)
    >>> round(choice.robot.k1, 1), round(choice.robot.c1, 3), round(choice.distance, 3)
    (277.1, 1.574, 1.061)
    """
    start = _own(robot, bump)
    search = _Search(robot, bump, v, k, c, _checks.nonnegative("reserve", reserve), distance)
    if search.keeps(start):
        return search.choice(start)
    return search.best(lambda x: np.sum((x - start) ** 2), lambda x: 2 * (x - start))


def farthest(robot, bump, v, k, c, name, *, distance=None):
    """The stiffest springs, or the strongest dampers, with contact at all of several speeds.

    Parameters
    ----------
    robot, bump, v, k, c, distance
        As in `cheapest`, whose way of searching it is.
    name : {"k", "c"}
        Which of the two is to be as large as the grid allows; the other one is free.

    Returns
    -------
    Choice or None
        None if no point of the grid keeps contact.

    Raises
    ------
    ValueError
        As `cheapest` does.

    Examples
    --------
    >>> k, c = np.geomspace(150, 1200, 13), np.geomspace(0.4, 4, 9)
    >>> choice = farthest(Robot(800, 800), GaussianBump(), [0.25, 1.2, 5, 10], k, c, "k")
    >>> round(choice.robot.k1, 1), round(choice.robot.c1, 3)
    (280.0, 1.971)
    """
    _own(robot, bump)
    way = -np.eye(2)[("k", "c").index(_checks.one_of("name", name, ("k", "c")))]
    search = _Search(robot, bump, v, k, c, 0.0, distance)
    return search.best(lambda x: way @ x, lambda x: way)


class _Search:
    """Where in ln k and ln c contact is kept at all speeds, with a reserve, and what is best."""

    def __init__(self, robot, bump, v, k, c, reserve, distance):
        self.robot, self.bump, self.reserve = robot, bump, reserve
        v, self.k, self.c = _grid(v, k, c)
        self.distance = distance_over(robot, bump, distance)
        # The speed with the least margin comes first: most suspensions fail there.
        self.v = sorted(v, key=lambda speed: self.margin(robot, speed))

    def margin(self, robot, speed):
        return margin(robot, self.bump, speed, distance=self.distance)

    def spare(self, x):
        changed = fitted_with(self.robot, *np.exp(x))
        return np.array([self.margin(changed, speed) for speed in self.v]) - self.reserve

    def keeps(self, x):
        changed, reserve = fitted_with(self.robot, *np.exp(x)), self.reserve
        margins = (self.margin(changed, speed) for speed in self.v)
        return all(not is_lost(least) and least >= reserve for least in margins)

    def choice(self, x):
        """The suspension at x; the robot itself where nothing is changed."""
        away = np.linalg.norm(x - np.log([self.robot.k1, self.robot.c1]))
        changed = fitted_with(self.robot, *np.exp(x)) if away else self.robot
        return Choice(changed, float(away), float(self.spare(x).min() + self.reserve))

    def best(self, goal, slope):
        """The point with the least `goal`; None if no point of the grid keeps contact."""
        points = np.array([[x, y] for x in np.log(self.k) for y in np.log(self.c)])
        starts = list(islice(filter(self.keeps, sorted(points, key=goal)), STARTS))
        if not starts:
            return None
        found = [
            minimize(
                goal,
                first,
                jac=slope,
                method="SLSQP",
                bounds=np.log([self.k[[0, -1]], self.c[[0, -1]]]),
                constraints={"type": "ineq", "fun": lambda x: self.spare(x) - EDGE},
                options={"ftol": 1e-12},
            ).x
            for first in starts
        ]
        reached = [x for x in found if self.keeps(x)]
        return self.choice(min([*reached, starts[0]], key=goal))


def _own(robot, bump):
    """ln k and ln c of a robot whose axles are alike."""
    _checks.instance("robot", robot, Robot)
    _checks.instance("bump", bump, GaussianBump)
    if robot.k1 != robot.k2 or robot.c1 != robot.c2 or robot.c1 == 0:
        raise ValueError(
            "robot must have k1 = k2 and c1 = c2 > 0, got "
            f"k1={robot.k1:g}, k2={robot.k2:g}, c1={robot.c1:g}, c2={robot.c2:g}"
        )
    return np.log([robot.k1, robot.c1])


def _grid(v, k, c, most=MAX_MARGINS):
    """Speeds, stiffnesses and dampings as arrays, not too many together."""
    v, k, c = (_checks.array(*pair, (None,)) for pair in (("v", v), ("k", k), ("c", c)))
    for name, values in (("v", v), ("k", k), ("c", c)):
        if not (values.size and (values > 0).all()):
            raise ValueError(f"{name} must hold one number or more, all > 0, got {values}")
        if name != "v" and not (np.diff(values) > 0).all():
            raise ValueError(f"{name} must be in order, got {values}")
    cost = v.size * k.size * c.size
    if cost > most:
        raise ValueError(f"k, c and v must ask for at most {most} runs, got {cost}")
    return v, k, c
