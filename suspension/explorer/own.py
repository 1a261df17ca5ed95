"""Your own robot and road: all its numbers, a road that one draws or pastes, and what follows.

Python hands over the robot's matrices as sums over products of its numbers, the groups and their
limits as products of powers, a bump in polynomial pieces, and the lines of Python that give the
same numbers. The page does linear algebra and sums power series, which are exact to roundoff.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import traitlets

from suspension import _checks
from suspension.contact import exact_loss
from suspension.explorer.bundle import PAGE, bundle, style
from suspension.explorer.instrument import LABORATORY, Instrument
from suspension.explorer.own_facts import AHEAD, NUMBERS, facts_of, usual_way, within
from suspension.explorer.still import svg
from suspension.figures import plot_chart
from suspension.forces import WHEEL
from suspension.least_force import distance_over
from suspension.report.words import quantity
from suspension.road import GaussianBump, RoadProfile
from suspension.robot import Robot
from suspension.similarity import follow, groups, highest_bump, skim, throw

__all__ = ["Own"]

NUS, ETAS = (0.1, 26.0), (0.1, 100.0)  # of the still picture
MM = 1000


class Own(Instrument):
    """All numbers of a robot, a road that one draws or pastes, and what follows from them.

    In JupyterLab and in a built page the same module draws it. What is set there is here as
    `robot`, `road`, `v` and `distance`.

    Parameters
    ----------
    robot : Robot
        To start with. Gravity stays its own, and must not be 0.
    bump : GaussianBump
        To start with: of a height > 0, ahead of the robot.
    v : float
        Speed to start with, m/s, 0.001 to 1000.

    Attributes
    ----------
    state : dict
        What is set: ``robot``, a dict of its numbers; ``ground``, a dict of ``kind`` "bump" with
        ``height`` and ``sigma``, or of kind "points" with ``x``, ``h`` and, if not 1 and "pchip",
        the factors ``long`` and ``tall`` and what joins the points, ``join``; ``v``;
        ``distance``, or None for the usual one; ``alike``, whether both axles change together;
        ``units``, "mm" (and m/s) or "cm" (and km/h); ``from``, the vehicle that one started from.

    Raises
    ------
    ValueError
        If a number is out of the range in which it can be typed, the robot has no weight, or a
        wheel stands on the bump at X = 0.
    """

    _esm = bundle(PAGE, "own_widget")
    _css = style("explorer", "own")

    state = traitlets.Dict().tag(sync=True)
    kind = f"{LABORATORY} se-own"
    to = "change its numbers and draw its road"

    def __init__(self, robot, bump, v=1.2):
        self._given = _checks.instance("robot", robot, Robot)
        _checks.instance("bump", bump, GaussianBump)
        distance_over(robot, bump, 1.0)
        if robot.g == 0:
            raise ValueError("robot must have a weight (g > 0), got g=0.0")
        facts = facts_of(robot, bump, v)
        self._lead = facts["lead"]
        first = facts["vehicles"][0]
        self._start = {
            "robot": first["robot"],
            "ground": {"kind": "bump", **first["bump"]},
            "v": first["v"],
            "distance": None,
            "alike": robot == robot.twin,
            "units": "mm",
            "from": 0,
        }
        super().__init__(facts=facts, state=self._start)

    @traitlets.validate("state")
    def _check_state(self, proposal):
        """Refuse what is no robot, no road or no speed, by name."""
        state = proposal["value"]
        for name in ("robot", "ground", "v"):
            if name not in state:
                raise ValueError(f"state must have {name!r}, got {sorted(state)}")
        self._road_of(state, self._robot_of(state))
        within("v", state["v"])
        if state.get("distance") is not None:
            within("distance", state["distance"])
        return state

    def _robot_of(self, state):
        numbers = {name: within(name, state["robot"].get(name)) for name in NUMBERS}
        return replace(self._given, **numbers)

    def _road_of(self, state, robot):
        ground = state["ground"]
        if _checks.one_of("kind of ground", ground.get("kind"), ("bump", "points")) == "bump":
            height, sigma = (within(name, ground.get(name)) for name in ("height", "sigma"))
            centre = float(f"{robot.L2 + self._lead * sigma:.12g}")
            return GaussianBump(height, sigma, centre)
        tall, long = (_checks.positive(name, ground.get(name, 1.0)) for name in ("tall", "long"))
        x, h = (_checks.array(name, ground.get(name), (None,)) for name in ("x", "h"))
        begin = float(f"{robot.L2 + AHEAD * (robot.L1 + robot.L2):.12g}")
        if len(x) and len(h):  # else the road says what is missing
            x, h = begin + long * (x - x[0]), tall * (h - h[0])
        return RoadProfile(x, h, ground.get("join", "pchip"))

    @property
    def robot(self):
        """The robot that is set."""
        return self._robot_of(self.state)

    @property
    def road(self):
        """The road that is set, a `GaussianBump` or a `RoadProfile`."""
        return self._road_of(self.state, self.robot)

    @property
    def v(self):
        """The speed that is set, m/s."""
        return float(self.state["v"])

    @property
    def distance(self):
        """How far the robot drives, m: what was asked for, or far enough beyond the road."""
        asked = self.state.get("distance")
        return usual_way(self.robot, self.road) if asked is None else float(asked)

    @property
    def _first(self):
        """The robot, the bump and the speed to start with, and how far it drives."""
        robot = self._robot_of(self._start)
        bump = self._road_of(self._start, robot)
        return robot, bump, self._start["v"], usual_way(robot, bump)

    @property
    def alt(self):
        """What the still picture shows."""
        robot, bump, v, distance = self._first
        loss = exact_loss(robot, bump, v, distance=distance)
        verdict = f"the {WHEEL[loss.wheel]} wheel leaves the ground" if loss else "contact is kept"
        return (
            "The highest bump that is crossed with contact at every speed, both on logarithmic "
            f"axes, and a vehicle as a point: at {quantity(v, 'metres per second')} over a bump of "
            f"{quantity(MM * bump.height, 'millimetres')} {verdict}."
        )

    def _state(self):
        return super()._state() | {"state": self._start}

    def _draw(self):
        """The chart to start with, as SVG: of groups if the robot has them, else in m/s and mm."""
        robot, bump, v, distance = self._first
        G = groups(robot.twin, bump, v)
        sag, nu = bump.height / G.eta, np.geomspace(*NUS, 160)
        speeds = nu * v / G.nu
        heights = highest_bump(robot, bump, speeds, distance=distance)
        lines = {}
        x, y = v / G.nu, MM * sag  # of one nu and of one eta
        if robot == robot.twin:
            x = y = 1.0
            lines = {"follow": follow(nu, G.j), "throw": throw(nu)}
            if G.zeta > 0:
                lines["skim"] = skim(nu, G.zeta)
        lost = exact_loss(robot, bump, v, distance=distance) is not None
        point = (y * G.eta, [x * G.nu], [lost], [], [])
        with plt.style.context("suspension.figures.report"):
            figure, ax = plt.subplots(figsize=(7.2, 4.2))
            curve = {G.zeta: y * heights / sag}
            ends = tuple(y * np.array(ETAS))
            plot_chart(x * nu, curve, lines, bump=point, own=G.zeta, heights=ends, ax=ax)
            ax.legend().remove()
            at = {"xytext": (9, 9), "textcoords": "offset points", "weight": "bold"}
            ax.annotate("the vehicle", (x * G.nu, y * G.eta), **at)
            if robot != robot.twin:
                ax.set(xlabel="speed $v$ (m/s)", ylabel="height of the bump (mm)")
        return svg(figure)
