"""Keep it down: pass all asked speeds with contact kept, changing the suspension least.

The game is Part X with a trail. Its score is the distance of `suspension.choice`, and the answer
to beat comes from there. The first road is the bump, the others are unknown: bumps and dips like
it, drawn by lot until robot and road ask for something that can be done.
"""

from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
import traitlets

from suspension import _checks
from suspension.choice import cheapest, demands, fitted_with
from suspension.contact import is_lost
from suspension.explorer.bundle import PAGE, bundle, style
from suspension.explorer.family import Family
from suspension.explorer.instrument import LABORATORY, Instrument
from suspension.explorer.settings import REFERENCE
from suspension.explorer.still import svg
from suspension.explorer.tables import unit_bump
from suspension.figures import plot_all_forces
from suspension.flight import fly
from suspension.least_force import CLEAR, distance_over, margin
from suspension.report.words import speed_list
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.simulation import simulate

__all__ = ["Attempt", "Game", "Goal", "goal_on", "unknown_roads"]

ROADS = 3  # unknown ones
TRIES = 40  # shapes that are drawn for them, at most
HEIGHTS = (0.3, 1.5)  # times the bump's, up or down
WIDTHS = (0.4, 2.0)
FAR, APART = 0.25, 0.25  # how far a change must go, and how far apart two answers are
SAME = 1e-9  # parts of the way in the air that are the same
TENTHS = 10  # of the load at rest that may be asked for as a reserve


class Goal(NamedTuple):
    """What is asked on a road, and the answer to beat.

    Attributes
    ----------
    kind : {"contact", "reserve", "air"}
        Contact at all asked speeds; more than that, because the robot keeps contact as it is; or,
        where no suspension keeps it, as little of the way in the air as possible.
    reserve : float
        What the margin must be at every asked speed, N.
    best : Robot
        With the suspension to beat.
    distance : float
        How far that is from the given one, as in `suspension.choice`.
    air : float
        The part of the way in which a wheel is in the air, at the worst of the asked speeds.
    """

    kind: str
    reserve: float
    best: Robot
    distance: float
    air: float


class Attempt(NamedTuple):
    """What Python finds of a suspension: `distance` from the given one, `margins` at the asked
    speeds, N (after a loss only their sign means something), `air` as in `Goal`; `reached`: whether
    it does what is asked for."""

    distance: float
    margins: dict
    air: float
    reached: bool


def goal_on(robot, road, v, k, c, *, distance=None):
    """What can be asked of a robot on a road.

    Contact at all speeds with the least change of the suspension. A robot that keeps it as it is
    has to have a reserve, too: the first tenth of its load at rest that it lacks. Where no
    suspension keeps contact, what is left is the first demand of `suspension.choice.Demands`.

    Parameters
    ----------
    robot : Robot
        Both axles alike.
    road : GaussianBump
    v : array_like, shape (speeds,)
        m/s, > 0.
    k, c : array_like, shapes (n,) and (m,)
        The grid of `suspension.choice.cheapest`.
    distance : float, optional
        How far each run goes, m, as in `suspension.least_force.distance_over`.

    Returns
    -------
    Goal

    Raises
    ------
    ValueError
        As `suspension.choice.cheapest` does.
    """
    found, reserve = None, 0.0
    for tenths in range(TENTHS):
        asked = tenths * robot.m * robot.g / 2 / TENTHS
        choice = cheapest(robot, road, v, k, c, asked, distance=distance)
        if choice is None:
            break
        found, reserve = choice, asked
        if choice.distance:
            break
    if found:
        kind = "reserve" if reserve else "contact"
        return Goal(kind, reserve, found.robot, found.distance, 0.0)
    costs = demands(robot, road, v, k, c, distance=distance).costs[0]
    i, j = np.unravel_index(costs.argmin(), costs.shape)
    best = fitted_with(robot, k[j], c[i])
    return Goal("air", 0.0, best, change(robot, best), air(best, road, v, distance))


def change(robot, other):
    """How far apart two suspensions are: the distance of `suspension.choice`."""
    return float(np.hypot(np.log(other.k1 / robot.k1), np.log(other.c1 / robot.c1)))


def air(robot, road, v, distance=None):
    """The part of the way in which a wheel is in the air, at the worst of some speeds."""
    distance = distance_over(robot, road, distance)
    flights = [fly(robot, road, v=u, tfinal=distance / u, samples=2) for u in v]
    return float(max(flight.airtime.max() * flight.v / distance for flight in flights))


def unknown_roads(robot, bump, v, k, c, *, seed=2086, distance=None):
    """Roads like the bump: higher or lower, wider or narrower, bumps and dips, drawn by lot.

    A road is kept if the robot loses contact on it and a suspension keeps it, neither too near nor
    like that of another road. Parameters are those of `goal_on`, and the seed of the lots.

    Returns
    -------
    list of (GaussianBump, Goal)
        Three, or as many as 40 drawn shapes give, the smallest change first.
    """
    rng = np.random.default_rng(_checks.whole("seed", seed, 0))
    found, answers = [], []
    for _ in range(TRIES):
        if len(found) == ROADS:
            break
        height, width = (np.exp(rng.uniform(*np.log(ends))) for ends in (HEIGHTS, WIDTHS))
        up = rng.choice([-1, 1])
        road = _like(robot, bump, up * height * bump.height, width * bump.sigma)
        fits = road.centre + CLEAR * road.sigma + robot.L1 <= distance
        if not fits or not any(is_lost(margin(robot, road, u, distance=distance)) for u in v):
            continue
        choice = cheapest(robot, road, v, k, c, distance=distance)
        if choice is None or choice.distance < FAR:
            continue
        answer = np.log([choice.robot.k1, choice.robot.c1])
        if all(np.linalg.norm(answer - other) > APART for other in answers):
            found.append((road, Goal("contact", 0.0, choice.robot, choice.distance, 0.0)))
            answers.append(answer)
    return sorted(found, key=lambda pair: pair[1].distance)


def _like(robot, bump, height, sigma):
    """A bump of that size in three digits, ahead of the robot."""
    height, sigma = float(f"{height:.3g}"), float(f"{sigma:.3g}")
    ahead = max(bump.centre, robot.L2 + (CLEAR + 0.5) * sigma)
    return GaussianBump(height=height, sigma=sigma, centre=float(f"{ahead:.3g}"))


class Game(Instrument):
    """Stiffness and damping to choose, a drive at all asked speeds, a verdict, the next try.

    In JupyterLab and in a built page the same module draws it, and sounds it.

    Parameters
    ----------
    robot : Robot
        Both axles alike, with dampers.
    bump : GaussianBump
        The first road.
    asked : sequence of float
        Speeds, m/s.
    k, c : array_like, shapes (n,) and (m,)
        Stiffness, N/m, and damping, N s/m, of the grid from which `suspension.choice.cheapest`
        searches, in order; one can choose all between their ends, and the robot's own.
    seed : int
        Of the unknown roads.
    distance : float, optional
        How far each run goes, m, as in `suspension.choice.cheapest`.

    Attributes
    ----------
    levels : list of (GaussianBump, Goal)
        The roads, and what is asked there.
    level : int
        Which of them is played.
    k, c : float
        What is chosen, N/m and N s/m.
    attempts : list of [level, k, c, how]
        What was driven; `how`: "map" if the map was uncovered before, "link" if it came as a link.
    uncovered : list of int
        Levels whose map was uncovered.

    Raises
    ------
    ValueError
        As `suspension.choice.cheapest` does.
    """

    _esm = bundle(PAGE, "game_widget")
    _css = style("explorer", "game")

    kind = f"{LABORATORY} se-game"
    to = "play it"

    level = traitlets.Int(0).tag(sync=True)
    k = traitlets.Float().tag(sync=True)
    c = traitlets.Float().tag(sync=True)
    attempts = traitlets.List().tag(sync=True)
    uncovered = traitlets.List().tag(sync=True)

    def __init__(self, robot, bump, asked, k, c, *, seed=2086, distance=None):
        asked = tuple(map(float, _checks.positives("asked", asked, (None,))))
        distance = distance_over(robot, bump, distance)
        first = goal_on(robot, bump, asked, k, c, distance=distance)
        others = unknown_roads(robot, bump, asked, k, c, seed=seed, distance=distance)
        self.given, self.asked, self.distance = robot, asked, distance
        self.levels = [(bump, first), *others]
        self.ranges = {
            name: [float(min(ends[0], own)), float(max(ends[-1], own))]
            for name, ends, own in (("k", k, robot.k1), ("c", c, robot.c1))
        }
        super().__init__(
            facts={
                "own": {"k": robot.k1, "c": robot.c1},
                "ranges": self.ranges,
                "asked": asked,
                "distance": distance,
                "model": Family(robot, bump).model(),
                "wheels": robot.arms.tolist(),
                "reference": {name: getattr(REFERENCE, name).tolist() for name in "abc"},
                "shape": unit_bump(bump),
                "levels": [self._told(*level) for level in self.levels],
            },
            k=robot.k1,
            c=robot.c1,
        )

    @traitlets.validate("level")
    def _check_level(self, proposal):
        return self._level(proposal["value"])

    @traitlets.validate("k", "c")
    def _check_choice(self, proposal):
        return self._within(proposal["trait"].name, proposal["value"])

    @traitlets.validate("attempts")
    def _check_attempts(self, proposal):
        try:
            rows = [(level, k, c, how) for level, k, c, how in proposal["value"]]
        except (TypeError, ValueError):
            raise ValueError(
                f"attempts must be lists of level, k, c and how, got {proposal['value']!r}"
            ) from None
        return [
            [self._level(level), self._within("k", k), self._within("c", c), str(how)]
            for level, k, c, how in rows
        ]

    @traitlets.validate("uncovered")
    def _check_uncovered(self, proposal):
        return [self._level(level) for level in proposal["value"]]

    def _level(self, value):
        return _checks.one_of("level", value, range(len(self.levels)))

    def _within(self, name, value):
        low, high = self.ranges[name]
        return _checks.number(name, value, f"{low:g} to {high:g}", lambda x: low <= x <= high)

    def _told(self, road, goal):
        """A level as the page is handed it."""
        return {
            "bump": {"height": road.height, "sigma": road.sigma},
            "centre": road.centre,
            "kind": goal.kind,
            "reserve": goal.reserve,
            "best": {"k": goal.best.k1, "c": goal.best.c1},
            "distance": goal.distance,
            "air": goal.air,
        }

    @property
    def chosen(self):
        """The robot with the springs and dampers that are chosen."""
        return fitted_with(self.given, self.k, self.c)

    def judge(self, k, c, level=0):
        """What Python says of an attempt.

        Parameters
        ----------
        k, c : float
            Stiffness, N/m, and damping, N s/m.
        level : int
            Place in `levels`.

        Returns
        -------
        Attempt
        """
        road, goal = self.levels[self._level(level)]
        robot = fitted_with(self.given, k, c)
        margins = {v: margin(robot, road, v, distance=self.distance) for v in self.asked}
        lost = [v for v, least in margins.items() if is_lost(least)]
        part = air(robot, road, lost, self.distance) if lost else 0.0
        reached = not lost and min(margins.values()) >= goal.reserve
        if goal.kind == "air":
            reached = part <= goal.air + SAME
        return Attempt(change(self.given, robot), margins, part, reached)

    @property
    def alt(self):
        """What the still picture shows."""
        margins = self.judge(self.given.k1, self.given.c1).margins
        lost = [v for v, least in margins.items() if is_lost(least)]
        return (
            f"Normal forces on the way over the bump at {speed_list(self.asked)}, with the "
            f"suspension as it is. Contact is lost at {speed_list(lost)}."
        )

    def _state(self):
        own = {name: getattr(self, name) for name in ("level", "k", "c", "attempts", "uncovered")}
        return super()._state() | own

    def _draw(self):
        """The forces at the asked speeds, of the robot as it is."""
        steps = 500  # of each run
        runs = [
            simulate(
                self.given,
                self.levels[0][0],
                v=v,
                dt=self.distance / v / steps,
                tfinal=self.distance / v,
                scheme=REFERENCE,
            )
            for v in self.asked
        ]
        with plt.style.context("suspension.figures.report"):
            return svg(plot_all_forces(runs))
