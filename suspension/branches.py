"""Follow the critical speeds as the stiffness changes.

In the plane of speed and stiffness the critical speeds are curves, the zeros of the margin. A curve
that turns back in stiffness is a pair of critical speeds that appear or vanish together; so each
curve is followed along its own length and cut into branches afterwards.

A point of the plane is a complex number, ``ln v + i ln k``.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from suspension import _checks
from suspension.critical import critical_speeds, critical_stiffness
from suspension.least_force import distance_over, margin

__all__ = ["Branch", "End", "branches"]

STEP, FINEST = 0.02, 1e-5  # longest and shortest step along a curve, relative
AHEAD = np.pi / 6  # a step turns by no more than this, unless it is the shortest
RIGHT, UP = 1.0, 1j


class End(NamedTuple):
    """Where a branch ends: stiffness in N/m, speed in m/s, and why.

    `why` is ``"pair"`` if two critical speeds meet and vanish there, and ``"range"`` if the
    critical speed leaves the range of speeds.
    """

    k: float
    v: float
    why: str


@dataclass(frozen=True, eq=False)
class Branch:
    """One critical speed as a function of the stiffness.

    Attributes
    ----------
    points : ndarray, shape (n,), complex
        ``ln v + i ln k`` in order of the stiffness.
    first, last : End or None
        None where the branch goes on beyond the range of stiffnesses.
    margin_at : callable
        The margin in N at a point of the plane.
    """

    points: np.ndarray
    first: End | None
    last: End | None
    margin_at: object

    def speed(self, k):
        """The critical speed in m/s at a stiffness in N/m, None where the branch is not."""
        y, place = np.log(k), self.points.imag
        if not place[0] <= y <= place[-1]:
            return None
        i = min(max(np.searchsorted(place, y), 1), len(place) - 1)
        below, above = self.points[[i - 1, i]]
        low, high = sorted([below.real, above.real])
        for part in (0, 1e-6, 1e-4, 1e-2, 0.1, 1):  # between the two points, or nearly so
            wider = part * abs(above - below)
            ends = low - wider, high + wider
            if self.margin_at(ends[0] + 1j * y) * self.margin_at(ends[1] + 1j * y) <= 0:
                x = brentq(lambda x: self.margin_at(x + 1j * y), *ends, xtol=1e-14)
                return float(np.exp(x))
        # So near to the end of a pair that the two cannot be told apart.
        return float(np.exp(np.interp(y, place, self.points.real)))

    def extent(self, kmin, kmax):
        """Least and largest speed in m/s between two stiffnesses, None if the branch is not there.

        A greatest or least speed between the ends of the branch counts.
        """
        low, high, place = np.log(kmin), np.log(kmax), self.points.imag
        if high < place[0] or low > place[-1]:
            return None
        speeds = list(np.exp(self.points.real[(place >= low) & (place <= high)]))
        speeds += [self.speed(k) for k in (kmin, kmax) if place[0] <= np.log(k) <= place[-1]]
        return float(min(speeds)), float(max(speeds))


def branches(robot, bump, vmin, vmax, kmin, kmax, check=None, *, distance=None):
    """Every branch of ``margin(v, k) = 0``, k1 = k2 = k, in a range of speeds and stiffnesses.

    Every curve that reaches an edge of the ranges is found there. A closed curve is found if it
    exists at the stiffness `check`. A curve that leaves the ranges for less than a step (2 per
    cent) and less than a part in ten thousand may count as one that stays.

    Parameters
    ----------
    robot : Robot
        Its stiffnesses are replaced.
    bump : GaussianBump
    vmin, vmax : float
        Range of speeds, m/s.
    kmin, kmax : float
        Range of stiffnesses, N/m.
    check : float, optional
        A stiffness in between, N/m.
    distance : float, optional
        How far each run goes, m: 1.25 m if the whole bump lies within (`distance_over`).

    Returns
    -------
    branches : list of Branch

    Raises
    ------
    ValueError
        If an argument is out of its range, or `critical_speeds` or `critical_stiffness` refuse.
    """
    distance = distance_over(robot, bump, distance)
    vmin, vmax = _checks.ends("vmin", vmin, "vmax", vmax)
    kmin, kmax = _checks.ends("kmin", kmin, "kmax", kmax)
    if check is not None:
        check = _checks.number(
            "check", check, f"from kmin = {kmin:g} to kmax = {kmax:g}", lambda k: kmin <= k <= kmax
        )

    def with_stiffness(k):
        return replace(robot, k1=k, k2=k)

    @lru_cache(maxsize=64)  # who looks for a zero asks for both ends of the interval again
    def margin_at(point):
        k, v = np.exp(point.imag), np.exp(point.real)
        return margin(with_stiffness(k), bump, v, distance=distance)

    corners = np.log(vmin) + 1j * np.log(kmin), np.log(vmax) + 1j * np.log(kmax)
    step = min(STEP, (corners[1] - corners[0]).imag / 6)
    seeds = []  # where a curve enters, and which way is in
    for corner, k, heading in zip(corners, (kmin, kmax), (UP, -UP)):
        speeds = critical_speeds(with_stiffness(k), bump, vmin, vmax, distance=distance)
        seeds += [(complex(np.log(v), corner.imag), heading) for v in speeds]
    for corner, v, heading in zip(corners, (vmin, vmax), (RIGHT, -RIGHT)):
        softest = with_stiffness(kmin)
        stiffnesses = critical_stiffness(softest, bump, v, kmin, kmax, distance=distance)
        seeds += [(complex(corner.real, np.log(k)), heading) for k in stiffnesses]

    exits = np.array([start for start, _ in seeds])
    found, used = [], set()
    for i, (start, heading) in enumerate(seeds):
        if i in used:
            continue
        used.add(i)
        curve, j = _follow(margin_at, start, heading, corners, step, exits)
        if j in used:
            continue  # already walked from the other side
        used.add(i if j is None else j)
        found += _cut(margin_at, curve, corners)
    if check is not None:
        for v in critical_speeds(with_stiffness(check), bump, vmin, vmax, distance=distance):
            near = [speed for b in found if (speed := b.speed(check)) is not None]
            if not any(abs(speed / v - 1) < 1e-7 for speed in near):
                start = complex(np.log(v), np.log(check))
                curve, _ = _follow(margin_at, start, UP, corners, step, exits)
                if curve[-1] != start:
                    back, _ = _follow(margin_at, start, -UP, corners, step, exits)
                    curve = back[::-1] + curve[1:]
                found += _cut(margin_at, curve, corners)
    return found


def _follow(margin_at, start, heading, corners, step, exits):
    """Points along a curve from `start` to an edge, or round to the start again.

    `exits` are all points at which a curve crosses an edge. Also returned is which of them it is,
    None if none.
    """
    points, radius = [start], step
    heading = _along(margin_at, start, heading)
    while True:
        last = points[-1]
        point, radius = _next(margin_at, last, heading, min(step, 2 * radius))
        way_out = _way_out(last, point, corners)
        while way_out is not None:
            away = np.abs(exits - way_out) if len(exits) else np.array([np.inf])
            if away.min() < radius / 10:
                return [*points, exits[away.argmin()]], int(away.argmin())
            if radius < FINEST:
                return [*points, way_out], None
            point, radius = _next(margin_at, last, heading, radius / 2)
            way_out = _way_out(last, point, corners)
        points.append(point)
        heading = (point - last) / abs(point - last)
        if len(points) > 4 and abs(point - start) < radius:
            return [*points[:-1], start], None


def _along(margin_at, point, heading):
    """The direction of the curve through a zero, the one of the two that is nearer to `heading`."""
    small = 1e-6
    slopes = [
        margin_at(point + small * way) - margin_at(point - small * way) for way in (RIGHT, UP)
    ]
    tangent = 1j * complex(*slopes)
    tangent /= abs(tangent)
    return tangent if (tangent * np.conj(heading)).real > 0 else -tangent


def _next(margin_at, point, heading, radius):
    """The next zero, on a circle around `point`, and the circle's radius.

    The margin has opposite signs on the two sides of a curve. If it has not, or the zero is not
    ahead, the circle reaches across another part of the curve or a corner of it, and one of half
    the radius is tried. A sharp tip is thus approached until the finest circle reaches around it.
    """

    def around(angle):
        return margin_at(point + radius * heading * np.exp(1j * angle))

    while around(-AHEAD) * around(AHEAD) >= 0:
        if radius < FINEST:
            return _around_a_tip(margin_at, point, heading, radius), radius
        radius /= 2
    angle = brentq(around, -AHEAD, AHEAD, xtol=1e-9)
    return point + radius * heading * np.exp(1j * angle), radius


def _around_a_tip(margin_at, point, heading, radius):
    """The zero nearest to straight ahead on nearly the whole circle."""

    def around(angle):
        return margin_at(point + radius * heading * np.exp(1j * angle))

    angles = 0.97 * np.pi * np.linspace(-1, 1, 48)
    signs = np.sign([around(angle) for angle in angles])
    changes = np.flatnonzero(signs[:-1] != signs[1:])
    if not len(changes):
        raise RuntimeError(f"a critical speed is lost near {np.exp(point.real):g} m/s")
    ahead = changes[np.abs(angles[changes]).argmin()]
    angle = brentq(around, angles[ahead], angles[ahead + 1], xtol=1e-12)
    return point + radius * heading * np.exp(1j * angle)


def _way_out(inside, point, corners):
    """Where the line from a point in the rectangle to another leaves it, None if it does not."""
    low, high = corners
    way, parts = point - inside, []
    for in_speed, at, change, least, most in (
        (True, inside.real, way.real, low.real, high.real),
        (False, inside.imag, way.imag, low.imag, high.imag),
    ):
        for edge in (least, most):
            outward = change if edge == most else -change
            beyond = (at + change - edge) * (1 if edge == most else -1)
            if outward > 0 and beyond > 0:
                parts.append(((edge - at) / change, edge, in_speed))
    if not parts:
        return None
    part, edge, in_speed = min(parts)
    where = inside + part * way
    return complex(edge, where.imag) if in_speed else complex(where.real, edge)


# --- from curves to branches ------------------------------------------------------------------


def _cut(margin_at, curve, corners):
    """The branches of a curve: the pieces on which the stiffness only grows or only falls."""
    points = np.array(curve)
    if len(points) > 2 and points[0] == points[-1]:  # a closed curve starts at its softest point
        points = np.roll(points[:-1], -points[:-1].imag.argmin())
        softest = _turn(margin_at, points[-1], points[0], points[1])
        points = np.array([softest, *points[1:], softest])
    pieces, begin = [], points[:1]
    turns = _turning(points.imag)
    for start, i in zip([0, *turns], turns):
        turn = _turn(margin_at, *points[i - 1 : i + 2])
        pieces.append(np.array([*begin, *points[start + 1 : i], turn]))
        begin = np.array([turn])
    last = turns[-1] if turns else 0
    pieces.append(np.array([*begin, *points[last + 1 :]]))
    return [_branch(margin_at, piece, corners) for piece in pieces]


def _branch(margin_at, points, corners):
    if points[0].imag > points[-1].imag:
        points = points[::-1]
    points = points.copy()
    for i in _turning(points.real):  # the largest and the least speed on the way
        turned = _turn(lambda p: margin_at(_swap(p)), *_swap(points[i - 1 : i + 2]))
        points[i] = _swap(turned)
    order = np.argsort(points.imag, kind="stable")
    return Branch(points[order], *(_end(point, corners) for point in points[[0, -1]]), margin_at)


def _turning(coordinate):
    """Indices of the inner points at which a coordinate turns back."""
    steps = np.diff(coordinate)
    return [i for i in range(1, len(steps)) if steps[i - 1] * steps[i] < 0]


def _turn(margin_at, before, point, after):
    """Where between two neighbours of `point` the curve goes furthest in its imaginary part."""
    chord = after - before
    if abs(chord) < 10 * FINEST:
        return point
    across = 1j * chord / abs(chord)
    if (across * np.conj(point - before)).real < 0:
        across = -across
    reach = 2 * max(abs(point - before), abs(after - point))
    outward = 1 if point.imag > before.imag else -1

    def on_curve(part):
        foot = before + part * chord
        return foot + across * brentq(lambda s: margin_at(foot + s * across), 0, reach, xtol=1e-12)

    try:
        part = minimize_scalar(
            lambda part: -outward * on_curve(part).imag,
            bounds=(0.01, 0.99),
            method="bounded",
            options={"xatol": 1e-6},
        ).x
    except ValueError:  # not a curve above its chord: the steps were small around a sharp tip
        return point
    turned = on_curve(part)
    return turned if outward * turned.imag > outward * point.imag else point


def _swap(point):
    """The point with its two coordinates exchanged."""
    return 1j * np.conj(point)


def _end(point, corners):
    low, high = corners
    if point.imag in (low.imag, high.imag):
        return None
    why = "range" if point.real in (low.real, high.real) else "pair"
    return End(float(np.exp(point.imag)), float(np.exp(point.real)), why)
