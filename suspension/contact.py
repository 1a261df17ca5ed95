"""Does a wheel leave the ground? All that answers it: forces, margins, critical values, losses."""

import numpy as np
from scipy.optimize import brentq

from suspension import _checks
from suspension.critical import critical_speeds, critical_stiffness, sensitivity
from suspension.exact import Crossing
from suspension.forces import WHEEL, Loss, first_loss, normal_forces
from suspension.least_force import Minimum, exact_forces, margin, minima, turning_points

__all__ = [
    "WHEEL",
    "Loss",
    "Minimum",
    "critical_speeds",
    "critical_stiffness",
    "exact_loss",
    "first_loss",
    "margin",
    "minima",
    "normal_forces",
    "sensitivity",
]


def exact_loss(robot, bump, v, tfinal=None):
    """The very moment at which a wheel first leaves the ground on the way over the bump.

    Parameters are those of `margin`, and so is the start, at rest.

    Returns
    -------
    loss : Loss or None
        None if both wheels keep contact all the way.

    Examples
    --------
    >>> from suspension.road import GaussianBump
    >>> from suspension.robot import Robot
    >>> loss = exact_loss(Robot(800, 800), GaussianBump(), v=5)
    >>> loss.wheel, round(loss.t, 6)
    (2, 0.056455)
    """
    crossing = Crossing(robot, bump, _checks.positive("v", v))
    t, N = turning_points(crossing, tfinal)
    loss = first_loss(t, N)
    if loss is None or loss.t == 0:
        return loss
    # Every minimum is among the samples, so before the loss each force falls through zero once.
    j = np.searchsorted(t, loss.t)
    losses = []
    for i in np.flatnonzero(N[:, j] <= 0):
        # The ends' forces are not computed anew: even the sign of a roundoff must stay.
        ends = {t[j - 1]: N[i, j - 1], t[j]: N[i, j]}

        def force(s, i=i, ends=ends):
            return ends[s] if s in ends else exact_forces(crossing, np.array([s]))[0, i, 0]

        losses.append(Loss(int(i) + 1, brentq(force, *ends, xtol=1e-15)))
    return min(losses, key=lambda loss: loss.t)
