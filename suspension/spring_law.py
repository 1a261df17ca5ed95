"""The spring as it was measured: preload, curvature, and an end stop beyond the readings.

The force of a spring pair is the fitted parabola of Part I where it was measured, ``0 <= delta <=
delta_max``, and its tangents at the two ends outside. A stop of stiffness ``stop`` adds its force
beyond delta_max: a unilateral contact. The equations of motion are those of the linear robot with
this force in place of ``k delta``, so they are no longer linear.
"""

from dataclasses import dataclass, replace

import numpy as np

from suspension import _checks
from suspension.road import road_input
from suspension.robot import Robot
from suspension.springs import SpringFit

__all__ = ["SpringLaw", "linearised", "make_measured_gfunc", "one_law", "rest"]


@dataclass(frozen=True, eq=False)
class SpringLaw:
    """The force of a spring pair, ``F(delta)``, for one law or for many side by side.

    With ``x = delta / delta_max`` and x' the nearest point to x in [0, 1],

    ``F = beta0 + beta1 x + beta2 x' (2 x - x') + stop max(0, delta - delta_max)``:

    the parabola of Eq. 9 inside, its end tangents outside, and the stop on top.

    Parameters
    ----------
    beta0, beta1, beta2 : array_like, shape () or (n,)
        Coefficients of Eq. 9, N. The force must grow: ``beta1 > 0``, ``beta1 + 2 beta2 > 0``.
    delta_max : float
        Largest displacement that was measured, m, > 0: the place of the stop.
    stop : array_like, shape () or (n,)
        Stiffness of the stop, N/m, >= 0; 0 is none.

    Raises
    ------
    ValueError
        If an argument is out of its range.

    Examples
    --------
    >>> law = SpringLaw(0.0, 13.2, 0.0, 0.0165, stop=8000)
    >>> law.force([0, 0.0165, 0.0175]).round(2)
    array([ 0. , 13.2, 22. ])
    """

    beta0: np.ndarray
    beta1: np.ndarray
    beta2: np.ndarray
    delta_max: float
    stop: np.ndarray = 0.0

    def __post_init__(self):
        names = ("beta0", "beta1", "beta2", "stop")
        values = [_checks.array(name, getattr(self, name)) for name in names]
        if not (values[1] > 0).all():
            raise ValueError(f"beta1 must be > 0, got {values[1].min():g}: the force must grow")
        if not (values[3] >= 0).all():
            raise ValueError(f"stop must be >= 0, got {values[3].min():g}")
        try:
            values = np.broadcast_arrays(*values)
        except ValueError:
            shapes = [value.shape for value in values]
            raise ValueError(f"beta0, beta1, beta2 and stop must fit, got {shapes}") from None
        end = values[1] + 2 * values[2]
        if not (end > 0).all():
            raise ValueError(
                f"beta2 must be > -beta1 / 2, so that the force grows up to delta_max, got a slope "
                f"of {end.min():g} N there"
            )
        for name, value in zip(names, values):
            object.__setattr__(self, name, value)
        object.__setattr__(self, "delta_max", _checks.positive("delta_max", self.delta_max))
        # A loop would ask for these at every step.
        steep = self.stop * self.delta_max if self.stop.any() else None
        object.__setattr__(self, "_bent", bool(self.beta2.any()))
        object.__setattr__(self, "_stopping", steep)

    @classmethod
    def of(cls, fit, stop=0.0):
        """The law of a fit: its parabola, with a stop of so many N/m.

        Parameters
        ----------
        fit : SpringFit
        stop : array_like, shape () or (n,)
            Stiffness of the stop, N/m, >= 0; 0 is none.

        Raises
        ------
        ValueError
            If a stop is not finite or < 0, or the fitted force does not grow up to `delta_max`.
        TypeError
            If `fit` is not a SpringFit.
        """
        _checks.instance("fit", fit, SpringFit)
        return cls(*fit.beta, fit.delta_max, stop)

    @property
    def free(self):
        """The same law without its stop."""
        return SpringLaw(self.beta0, self.beta1, self.beta2, self.delta_max)

    @property
    def stiffest(self):
        """The steepest slope of each law, on its stop if it has one, N/m, of the laws' shape."""
        end = self.beta1 + 2 * self.beta2
        return np.maximum(self.beta1, end + self.stop * self.delta_max) / self.delta_max

    @property
    def shape(self):
        """() for one law, (n,) for n of them."""
        return self.stop.shape

    def __getitem__(self, index):
        """Some of the laws, indexed like an array."""
        try:
            stop = self.stop[index]
        except IndexError:
            if self.shape:
                raise
            raise ValueError(f"law must be several laws to have an index, got {self}") from None
        beta = (coefficient[index] for coefficient in (self.beta0, self.beta1, self.beta2))
        return SpringLaw(*beta, self.delta_max, stop)

    def force(self, delta):
        """Force in N at compressions `delta` in m; shapes broadcast."""
        x = np.asarray(delta) / self.delta_max
        force = self.beta0 + self.beta1 * x
        if self._bent:
            nearest = np.minimum(np.maximum(x, 0), 1)
            force = force + self.beta2 * nearest * (2 * x - nearest)
        if self._stopping is not None:
            force = force + self._stopping * np.maximum(x - 1, 0)
        return force

    def tangent(self, delta):
        """Slope dF/ddelta in N/m; at the stop, where it jumps, that beyond it."""
        x = np.asarray(delta) / self.delta_max
        slope = (self.beta1 + 2 * self.beta2 * np.clip(x, 0, 1)) / self.delta_max
        return slope + self.stop * (x >= 1)

    def displacement(self, load):
        """The compression in m at which the spring carries `load` in N: the root of F = load."""
        load = np.asarray(load)
        end = self.beta1 + 2 * self.beta2
        at_end = self.beta0 + self.beta1 + self.beta2
        inside = np.minimum(np.maximum(load, self.beta0), at_end)
        root = np.sqrt(self.beta1**2 - 4 * self.beta2 * (self.beta0 - inside))
        x = 2 * (inside - self.beta0) / (self.beta1 + root)
        below = np.minimum(load - self.beta0, 0) / self.beta1
        above = np.maximum(load - at_end, 0) / (end + self.stop * self.delta_max)
        return self.delta_max * (x + below + above)


def rest(robot, law):
    """The state at rest on flat ground: each spring carries its wheel's share of the weight.

    Parameters
    ----------
    robot : Robot
        Its stiffnesses are not used.
    law : SpringLaw
        Of both springs.

    Returns
    -------
    w : ndarray, shape (4,) or (4, n)

    Raises
    ------
    TypeError
        If `robot` is not a Robot, or `law` not a SpringLaw.
    """
    _checks.instance("robot", robot, Robot)
    _checks.instance("law", law, SpringLaw)
    span = robot.L1 + robot.L2
    # The rear wheel carries L2 / span of the weight, the front wheel L1 / span.
    rear, front = (-law.displacement(robot.m * robot.g * L / span) for L in (robot.L2, robot.L1))
    w = np.zeros((4, *np.shape(rear)))
    w[0] = (robot.L2 * rear + robot.L1 * front) / span
    w[2] = (front - rear) / span
    return w


def linearised(robot, law, w=None):
    """The linear robot that the springs' tangents make: what small swings about a state feel.

    Parameters
    ----------
    robot : Robot
        Its stiffnesses are replaced.
    law : SpringLaw
        One law.
    w : array_like, shape (4,), optional
        A state on flat ground; at rest if not given.

    Returns
    -------
    Robot
        Its `A` is the Jacobian of ``w' = g(w)`` at `w`.

    Raises
    ------
    ValueError
        If `law` is several laws, or `w` is not finite or has another shape.
    """
    _checks.instance("robot", robot, Robot)
    one_law(law)
    w = rest(robot, law) if w is None else _checks.array("w", w, (4,))
    k1, k2 = law.tangent(-(w[0] + robot.arms * w[2]))
    return replace(robot, k1=k1, k2=k2)


def make_measured_gfunc(robot, law, road):
    """Return ``gfunc(w, t, v) -> (wdot, N1, N2)``, as `suspension.course.make_gfunc` does.

    Parameters
    ----------
    robot : Robot
        Its stiffnesses are not used.
    law : SpringLaw
        One law, of both springs.
    road : callable
        ``road(x) -> (H, dHdx)``.

    Returns
    -------
    gfunc : callable
        For the problem's own `suspension.course.RK4`; state of shape (4,), t in s, v in m/s.

    Raises
    ------
    ValueError
        If `law` is several laws; from the returned function, if w has another shape, t or v is no
        finite number, or the road returns another shape than it was given, or what is not finite.
    """
    _checks.instance("robot", robot, Robot)
    _checks.function("road", road, "road(x) -> (H, dHdx)")
    one_law(law)

    def gfunc(w, t, v):
        w = _checks.array("w", w, (4,), finite=False)
        h, hdot = np.split(road_input(robot, road, v, t), 2)
        p, pdot = h - w[0] - robot.arms * w[2], hdot - w[1] - robot.arms * w[3]
        N = law.force(p) + robot.c * pdot
        return robot.S @ w + robot.P @ N + robot.e, *N

    return gfunc


def one_law(law):
    """Return `law` if it is one SpringLaw, else raise an error that names it.

    Raises
    ------
    ValueError
        If it is several laws: their shape is told.
    TypeError
        If it is not a SpringLaw.
    """
    _checks.instance("law", law, SpringLaw)
    if law.shape:
        raise ValueError(f"law must be one law, got laws of shape {law.shape}")
    return law
