"""The robots and roads that the sliders reach, and their matrices as the page is handed them.

A slider's parameter enters the matrices C and D of Eq. 5 linearly, so that a constant and one
matrix for each parameter say everything: ``C(k, c) = C_1 + k C_k + c C_c``. They are read off
from robots, not typed, and a robot whose matrices were not affine would be refused.
"""

from dataclasses import dataclass, replace

import numpy as np

from suspension.explorer.settings import DTS, VMAX, VMIN
from suspension.road import GaussianBump

__all__ = ["Family", "Range", "affine"]


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
    def ranges(self):
        """The range of every slider by name."""
        own = self.own
        far = {name: 2 * value for name, value in own.items()}
        softer = min(1.0, own["k"] / 500)
        return {
            "v": Range(VMIN, VMAX, True),
            "dt": Range(DTS[0], DTS[-1], True),
            "k": Range(200 * softer, max(2500.0, far["k"]), True),
            "c": Range(0.0, max(6.0, far["c"])),
            "height": Range(min(0.0, far["height"]), max(0.06, far["height"])),
            "sigma": Range(min(0.01, own["sigma"] / 2), max(0.1, far["sigma"]), True),
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
            springs' compressions ``p = Cp w + Dp u``.
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
        }


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
