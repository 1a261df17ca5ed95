"""Where the model itself is in doubt: how far the springs travel and how far the body tilts."""

from typing import NamedTuple

import numpy as np

from suspension.contact import exact_loss
from suspension.exact import over_bump
from suspension.road import road_input

__all__ = ["Travel", "travel"]


class Travel(NamedTuple):
    """Largest compression and extension of a spring, m, and largest pitch, rad, of a run."""

    compression: float
    extension: float
    pitch: float


def travel(robot, bump, v, samples=2001):
    """How far springs and body move while both wheels press on the ground.

    Parameters
    ----------
    robot : Robot
    bump : GaussianBump
    v : float
        Speed, m/s, > 0.
    samples : int
        Equally spaced times from 0 to the first loss of contact, or to 1.25 m / v.

    Returns
    -------
    Travel
        The compression is ``h_i - Y_i``, counted from the unstretched spring.
    """
    loss = exact_loss(robot, bump, v)
    t = np.linspace(0, loss.t if loss else 1.25 / v, samples)
    W, u = over_bump(robot, bump, v, t), road_input(robot, bump, v, t)
    ends = np.array([W[0] - robot.L1 * W[2], W[0] + robot.L2 * W[2]])
    compression = u[:2] - ends
    return Travel(compression.max(), max(-compression.min(), 0.0), np.abs(W[2]).max())
