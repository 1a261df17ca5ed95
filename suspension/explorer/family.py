"""The robots and roads that the sliders reach, and their matrices as the page is handed them.

A slider's parameter enters the matrices C and D of Eq. 5 linearly, so that a constant and one
matrix for each parameter say everything: ``C(k, c) = C_1 + k C_k + c C_c``. They are read off
from robots, not typed, and a robot whose matrices were not affine would be refused.
"""

from dataclasses import dataclass, replace

import numpy as np

from suspension.explorer.settings import DTS
from suspension.problem import BUMP
from suspension.road import GaussianBump, profile

__all__ = ["Family", "Range", "affine", "before_the_bump", "round_up"]

# What fits the problem's robot and bump, in units of their own; another family gets as much.
SPEEDS = (0.1, 25.0)  # m/s, while width times frequency is near UNIT
UNIT = 0.95  # m/s
WAY = 28.5  # widths of the bump, beyond the place where the rear wheel meets its middle
WAYS = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8)
WIDTHS = 0.135  # of a feature in wheelbases, of a road that does not say how wide its own are
SHORTEST = 0.0156  # of the shortest time constant, the longest step of a flight


@dataclass(frozen=True)
class Range:
    """Where a slider begins and ends, and whether its scale is logarithmic."""

    low: float
    high: float
    logarithmic: bool = False

    def __contains__(self, value):
        return self.low <= value <= self.high


@dataclass(frozen=True)
class Family:
    """A robot and a road, and how the sliders' parameters change them.

    The springs keep the ratio k2 / k1 and the dampers c2 / c1; `k` and `c` are those of the rear
    wheel (of the front one if the rear has no damper). Only a `GaussianBump` has a height and a
    width to change.

    Parameters
    ----------
    robot : Robot
    road : callable
        ``road(x) -> (H, dHdx)``.
    """

    robot: object
    road: object

    @property
    def has_bump(self):
        """Whether the road's height and width can be changed."""
        return isinstance(self.road, GaussianBump)

    @property
    def ratios(self):
        """For each of the robot's parameters that a slider moves: the slider, and the ratio."""
        robot = self.robot
        base = robot.c1 or robot.c2
        rear, front = (robot.c1 / base, robot.c2 / base) if base else (1.0, 1.0)
        return {
            "k1": ("k", 1.0),
            "k2": ("k", robot.k2 / robot.k1),
            "c1": ("c", rear),
            "c2": ("c", front),
        }

    @property
    def own(self):
        """The parameters of the given robot and road themselves."""
        road = self.road if self.has_bump else GaussianBump(height=1.0, sigma=1.0, centre=0.0)
        robot = self.robot
        c = robot.c1 or robot.c2
        return {"k": robot.k1, "c": c, "height": road.height, "sigma": road.sigma}

    @property
    def feature(self):
        """The size of the road's smallest feature, m: a bump's width."""
        robot = self.robot
        return getattr(self.road, "sigma", None) or WIDTHS * (robot.L1 + robot.L2)

    @property
    def scale(self):
        """How fast this robot lives on its road, beside the problem's: 1, 2 or 5 times a power of
        ten. A speed means the same as the problem's when it crosses a feature's width in as many
        periods of the heave."""
        robot = self.robot
        unit = self.feature * np.sqrt((robot.k1 + robot.k2) / robot.m) / UNIT
        steps = np.multiply.outer(10.0 ** np.arange(-9, 10), [1, 2, 5]).ravel()
        return float(steps[np.abs(np.log(steps / unit)).argmin()])

    @property
    def speeds(self):
        """Speeds worth looking at, lowest and highest, m/s."""
        return tuple(float(f"{v * self.scale:.3g}") for v in SPEEDS)

    @property
    def way(self):
        """How far the robot drives until both wheels have long passed a bump, m."""
        centre = getattr(self.road, "centre", BUMP.centre / BUMP.sigma * self.feature)
        return round_up(max(centre, 0.0) + self.robot.L1 + WAY * self.feature, WAYS)

    @property
    def longest_step(self):
        """Of a flight, s."""
        return SHORTEST / max(np.abs(self.robot.eigenvalues).max(), 1e-9)

    @property
    def ranges(self):
        """The range of every slider by name, but for the speed's, which the explorer is told."""
        own = self.own
        k, height, sigma = own["k"], own["height"], own["sigma"]
        damping = 0.12 * np.sqrt(2 * k * self.robot.m)  # an eighth of the critical one
        far = round_up(2 * abs(height) or sigma)
        return {
            "dt": Range(DTS[0], DTS[-1], True),
            "k": Range(max(min(150.0, 0.4 * k), 0.1 * k), min(max(2500.0, 2 * k), 10 * k), True),
            "c": Range(0.0, max(round_up(damping), 2 * own["c"])),
            "height": Range(-far, 0.0) if height < 0 else Range(0.0, far),
            "sigma": Range(_round_down(0.4 * sigma), round_up(3.3 * sigma), True),
        }

    def robot_at(self, k, c):
        """The robot with other springs and dampers; itself at its own."""
        values = {"k": k, "c": c}
        if all(values[name] == self.own[name] for name in values):
            return self.robot
        changed = {name: values[on] * ratio for name, (on, ratio) in self.ratios.items()}
        return replace(self.robot, **changed)

    def road_at(self, height, sigma):
        """The road with another height and width of its bump."""
        return replace(self.road, height=height, sigma=sigma) if self.has_bump else self.road

    def model(self):
        """The matrices as the page is handed them, in nested lists.

        Returns
        -------
        model : dict
            ``C`` and ``D`` are dicts of a constant, "1", and a matrix for each parameter; ``S``,
            ``P`` and ``e`` do not depend on them, nor do ``Cp`` and ``Dp``, which give the
            springs' compressions ``p = Cp w + Dp u``. ``contact`` says when a wheel presses:
            while each of its conditions, `of` a pair of these matrices, is positive, or zero
            where it need not be `strict`; `force` and `length` name the pairs that give the
            force of a wheel that presses, and minus the height of one that does not.
        """
        robot = self.robot
        still, one = np.zeros(2), np.ones(2)
        return {
            "C": affine(lambda k, c: self.robot_at(k, c).C, robot.k1),
            "D": affine(lambda k, c: self.robot_at(k, c).D, robot.k1),
            "S": robot.S.tolist(),
            "P": robot.P.tolist(),
            "e": robot.e.tolist(),
            "Cp": (-np.column_stack([one, still, robot.arms, still])).tolist(),
            "Dp": np.eye(2, 4).tolist(),
            "contact": {
                "conditions": [
                    {"of": ["Cp", "Dp"], "strict": False},
                    {"of": ["C", "D"], "strict": True},
                ],
                "force": 1,
                "length": 0,
            },
        }


def before_the_bump(family, distance, little=0.01):
    """Where the robot is just before its front wheel meets the road's first bump, m.

    That is where the road is `little` of its highest place above, or below, where it starts.
    """
    front = family.robot.L2
    x = np.linspace(front, front + distance, 2001)
    H = np.abs(profile(family.road, x)[0] - profile(family.road, x[:1])[0])
    if not H.max() > 0:
        return 0.0
    return float(x[np.flatnonzero(H >= little * H.max())[0]] - front)


def round_up(x, steps=range(1, 10)):
    """The next number above x that is one of some steps times a power of ten."""
    ten = 10.0 ** np.floor(np.log10(x))
    steps = [*steps, 10]
    found = next(step for step in steps if step * ten >= x * (1 - 1e-9))
    return float(f"{found * ten:.12g}")


def _round_down(x):
    """The next number below x with one digit."""
    ten = 10.0 ** np.floor(np.log10(x))
    return float(f"{np.floor(x / ten * (1 + 1e-9)) * ten:.12g}")


def affine(matrix, k, c=1.0):
    """Take ``matrix(k, c)`` apart into ``M_1 + k M_k + c M_c``.

    Parameters
    ----------
    matrix : callable
        ``matrix(k, c) -> ndarray``.
    k, c : float
        Values to take it apart at, > 0.

    Returns
    -------
    parts : dict of "1", "k" and "c", each a matrix in nested lists

    Raises
    ------
    ValueError
        If the matrix is not affine in k and c.
    """
    at_k = (matrix(2 * k, 0) - matrix(k, 0)) / k
    at_c = (matrix(k, 2 * c) - matrix(k, c)) / c
    constant = matrix(k, 0) - k * at_k
    expected = matrix(3 * k, 5 * c)
    error = np.abs(constant + 3 * k * at_k + 5 * c * at_c - expected).max()
    if error > 1e-9 * np.abs(expected).max():
        raise ValueError(f"matrix must be affine in k and c, is off by {error:.2g}")
    constant[np.abs(constant) < 1e-12 * np.abs(expected).max()] = 0.0
    return {"1": constant.tolist(), "k": at_k.tolist(), "c": at_c.tolist()}
