"""The motion of many robots side by side, on a ground that only pushes or one that pulls as well.

The case is every array's last axis. `suspension.sweep` and `suspension.rides` drive with it.
"""

from typing import NamedTuple

import numpy as np

from suspension.spring_law import SpringLaw

__all__ = ["Cases", "Full", "Small", "step"]

HUGE = 1e30


class Cases(NamedTuple):
    """Robots, speeds and laws of n cases, each an array of shape (n,); `law` may be None."""

    robots: np.ndarray
    v: np.ndarray
    law: SpringLaw | None

    def some(self, index):
        """Some of the cases."""
        law = None if self.law is None else self.law[index]
        return Cases(self.robots[index], self.v[index], law)

    def values(self, names):
        """Parameters of the robots by name, each of shape (n,)."""
        return np.array([[getattr(robot, name) for robot in self.robots] for name in names.split()])

    def swings(self):
        """Swings a second of the stiffest springs, shape (n,)."""
        k = self.values("k1 k2") if self.law is None else self.law.stiffest
        return np.sqrt(self._fastest(*np.broadcast_to(k, (2, self.v.size)))) / (2 * np.pi)

    def decays(self):
        """One over the shortest time constant of the dampers, 1/s, shape (n,)."""
        return self._fastest(*self.values("c1 c2"))

    def _fastest(self, k1, k2):
        """Largest eigenvalue of what forces k1 p1, k2 p2 do to the compressions p."""
        m, inertia, L1, L2 = self.values("m Izz L1 L2")
        rear, front = k1 * (1 / m + L1**2 / inertia), k2 * (1 / m + L2**2 / inertia)
        across = k1 * k2 * (1 / m - L1 * L2 / inertia) ** 2
        return (rear + front) / 2 + np.sqrt((rear - front) ** 2 / 4 + across)


class Small:
    """The motion of n cases with a small pitch, each in its own clock, whose unit is half a step.

    So all go equally fast over the road, and a Runge-Kutta step has no factors that differ. The
    state is where the ends of the body are above the wheels, ``y``, and ``u = y'``, shape (2, n).
    With ``p = h - y`` for the compression of a spring and ``F(p)`` for its force, ``f = F(p) + c
    p'`` (Eq. 5), a ground that only pushes has the normal force ``N = max(0, f)`` where the spring
    is compressed, ``F(p) >= 0``, and 0 elsewhere; one that pulls has ``N = f``.
    """

    def __init__(self, cases, dX, pulls=False):
        self.pulls, self.law, self.half = pulls, cases.law, dX / 2
        self.m, self.g, self.inertia, L1, L2 = cases.values("m g Izz L1 L2")
        self.arms, self.time = np.array([-L1, L2]), self.half / cases.v  # s, of half a step
        self.span, self.fall = L1 + L2, self.time**2 * self.g
        self.k, self.c = cases.values("k1 k2"), cases.values("c1 c2") / self.time
        # A normal force moves its own end, and the other one.
        self.own = self.time**2 * (1 / self.m + self.arms**2 / self.inertia)
        self.other = self.time**2 * (1 / self.m - L1 * L2 / self.inertia)
        self.loads = self.m * self.g * np.array([L2, L1]) / self.span  # at rest
        law, loads = self.law, self.loads
        self.start = -loads / self.k if law is None else -law.displacement(loads)

    def forces(self, p, r, case=None):
        """Eq. 5 and the normal forces, N, from compressions and their rates.

        Arrays are of shape (2, n), or (2, S, cells) with the index of S cases.
        """
        c, k, law = self.c, self.k, self.law
        if case is not None:
            c, k = c[:, case, None], k[:, case, None]
            law = law and law[case, None]
        F = k * p if law is None else law.force(p)
        f = c * r
        f += F
        if self.pulls:
            return f, f
        # Where F > 0 this bound is out of reach, and where F < 0 it lies below zero.
        N = np.minimum(f, HUGE * F)
        return f, np.maximum(N, 0.0, out=N)

    def rates(self, y, u, H, rise):
        """Accelerations, m, compressions, m, their rates, Eq. 5 and normal forces, N: (2, n)."""
        p, r = H - y, rise - u
        f, N = self.forces(p, r)
        a = self.own * N
        a += self.other * N[::-1]
        a -= self.fall
        return a, p, r, f, N

    def pitch(self, y):
        """Pitch, rad, from the state, or its rate from that of the state, shape (n,)."""
        return (y[1] - y[0]) / self.span


class Full(Small):
    """The motion of a rigid body, whose state is ``y = [Y, theta]`` and ``u = y'``."""

    def __init__(self, cases, dX, pulls=False):
        super().__init__(cases, dX, pulls)
        tilt = super().pitch(self.start)
        if (np.abs(tilt) > 1).any():
            raise ValueError(
                "robots and law must leave the springs at rest no further apart than the "
                f"wheelbase, got {np.abs(tilt).max():g} times as far"
            )
        self.start = np.array([self.start[1] - self.arms[1] * tilt, np.arcsin(tilt)])

    def rates(self, y, u, H, rise):
        """As with a small pitch, with sin theta and cos theta."""
        sine, cosine = np.sin(y[1]), np.cos(y[1])
        p = H - y[0] - self.arms * sine
        along = 1 - self.arms * sine * u[1] / self.half  # how fast a wheel goes, of the body's v
        r = rise * along - u[0] - self.arms * cosine * u[1]
        f, N = self.forces(p, r)
        lift = self.time**2 / self.m * (N[0] + N[1]) - self.fall
        moment = (self.arms * cosine * N).sum(axis=0)
        return np.array([lift, self.time**2 / self.inertia * moment]), p, r, f, N

    def pitch(self, y):
        """As with a small pitch."""
        return y[1]


def step(rate, y, u, a1, place):
    """One Runge-Kutta step, of two units of the clock, of ``y'' = rate(y, y', place)``.

    `a1` is the rate at its beginning; returned are the next `y` and `u`, shape (2, n).
    """
    u2 = u + a1
    a2 = rate(y + u, u2, place + 1)
    u3 = u + a2
    a3 = rate(y + u2, u3, place + 1)
    u4 = u + 2 * a3
    a4 = rate(y + 2 * u3, u4, place + 2)
    a2 += a3
    return y + 2 * (u + (a1 + a2) / 3), u + (a1 + 2 * a2 + a4) / 3
