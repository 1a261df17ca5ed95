"""The exact margin over a road in pieces: one that was measured, or drawn.

Between two of its points a `RoadProfile` is a polynomial of degree 3 at most. So on a leg, from the
moment at which a wheel meets a point to the next such moment, the road's forces are polynomials of
the time, and a mode with eigenvalue lam that is driven by ``g t^j`` answers with

    q(t) = exp(lam t) q(0) + g j! t^(j+1) phi_(j+1)(lam t),

where ``phi_0 = exp`` and ``phi_k(z) = (phi_(k-1)(z) - 1/(k-1)!) / z``. Nothing is stepped; each
least force between two samples is solved for, as over a bump. Where the slope of the road jumps
the force of a damper does, and both sides of the jump count.
"""

from math import factorial

import numpy as np
from scipy.optimize import brentq

from suspension import _checks
from suspension.contact import regimes_between
from suspension.critical import zeros
from suspension.exact import modes
from suspension.forces import Loss, first_loss
from suspension.least_force import DIGITS_LOST, EPS, Minimum, bottom
from suspension.problem import DISTANCE
from suspension.road import GaussianBump, RoadProfile
from suspension.robot import Robot

__all__ = [
    "Passage",
    "highest_multiple",
    "profile_loss",
    "profile_margin",
    "profile_minima",
    "profile_regimes",
    "stand_in",
]

MAX_SAMPLES = 2 * 10**6  # of the forces on one way: some seconds
MAX_SEARCH = 4 * 10**7  # on all ways of a first search for critical speeds: a minute
MOST_RIPPLES = 40  # of the margin in a factor e of speeds; ten samples show one
BLOCK = 10**5  # samples worked on together
SERIES = 20  # terms of phi_k where |z| < 1
DENSE = 3.0  # samples for each time constant, or radian, of the fastest mode
FEWEST = 5  # samples of a leg


class Passage:
    """The drive of a robot over a road in pieces, at several speeds side by side.

    It starts at X = 0 in the equilibrium of level ground and ends at X = `distance`.

    Parameters
    ----------
    robot : Robot
    road : RoadProfile
        Its first point lies ahead of the robot at X = 0, at height 0.
    v : array_like, shape (n,)
        Speeds, m/s, > 0.
    distance : float, optional
        m, as in `profile_margin`.

    Attributes
    ----------
    start : ndarray, shape (legs + 1,)
        Where each leg begins, and where the last one ends, X in m.
    samples : ndarray of int, shape (n, legs)
        How many samples of the forces show all their minima on each leg.

    Raises
    ------
    ValueError
        If an argument is out of its range, or a wheel stands on the road at the start.
    """

    def __init__(self, robot, road, v, distance=None):
        self.robot, self.v = robot, _checks.positives("v", v, (None,))
        self.distance = _way(robot, road, distance)
        points = np.subtract.outer(road.x, robot.arms).ravel()
        points = points[(points > 0) & (points < self.distance)]
        start = np.unique(np.concatenate([[0.0], points, [self.distance]]))
        # Where both wheels meet points at once, but for roundoff, one leg begins.
        apart = np.diff(start) > 1e-12 * self.distance
        self.start = np.append(start[:-1][apart], self.distance)
        begin, middle = self.start[:-1], (self.start[1:] + self.start[:-1]) / 2
        # Heights under both wheels in powers of the distance since the leg began: (4, 2, legs).
        self._heights = np.stack(
            [road.powers(middle + arm, begin + arm) for arm in robot.arms], axis=1
        )
        self._lam, self._right, self._left = modes(robot)
        self._length = np.diff(self.start) / self.v[:, None]  # of the legs, s
        swings = DENSE * self._length * np.abs(self._lam).max()
        too_many = ~(swings.sum(axis=1) <= MAX_SAMPLES)
        if too_many.any():
            raise ValueError(
                "v must be so high, or distance so short, that the swings of the modes can be "
                f"followed with {MAX_SAMPLES} samples, got v={self.v[too_many][0]:g}, "
                f"distance={self.distance:g}: {swings[too_many][0].sum():.3g}"
            )
        self.samples = FEWEST + swings.astype(int)

    def solve(self):
        """Find the state in which each leg begins; `forces` can be asked then."""
        # Forces of the road, D u, in powers of the time since the leg began: (4, 2, n, legs).
        power = np.arange(4)[:, None, None, None]
        heights = self._heights[:, :, None] * self.v[:, None] ** power
        self._road = self.robot.k[:, None, None] * heights
        self._road[:3] += self.robot.c[:, None, None] * power[1:] * heights[1:]
        self._push = np.einsum("mi,jisl->jmsl", self._left @ self.robot.P, self._road)
        z = self._lam[:, None, None] * self._length
        gained, kept = _driven(z, self._length, self._push), np.exp(z)
        self._modes = np.zeros(z.shape, dtype=complex)
        for n in range(z.shape[2] - 1):
            self._modes[:, :, n + 1] = kept[:, :, n] * self._modes[:, :, n] + gained[:, :, n]
        return self

    def forces(self, case, leg, t, order=0):
        """Normal forces and their time derivatives on the legs.

        Parameters
        ----------
        case, leg : ndarray of int, shape (m,)
            Which of the speeds, and which leg.
        t : ndarray, shape (m,)
            Time since the leg began, s.
        order : int
            The highest derivative wanted.

        Returns
        -------
        N : ndarray, shape (order + 1, 2, m)
            In N, N/s, ...
        """
        robot, z = self.robot, self._lam[:, None] * t
        push, road = self._push[:, :, case, leg], self._road[:, :, case, leg]
        q = np.exp(z) * self._modes[:, case, leg] + _driven(z, t, push)
        y, N = (self._right @ q).real, []  # the state, from equilibrium
        for _ in range(order + 1):
            now = sum(part * t**j for j, part in enumerate(road))
            N.append(robot.C @ y + now)
            y = robot.A @ y + robot.P @ now
            road = [(j + 1) * part for j, part in enumerate(road[1:])]
        N[0] += (robot.C @ robot.equilibrium)[:, None]
        return np.array(N)

    def extremes(self):
        """Samples of both forces at each speed that contain every minimum of either.

        Returns
        -------
        list of (t, leg, N)
            Times, s, shape (m,), in order; the leg of each; normal forces, N, shape (2, m). Where
            one leg ends and the next begins there are two samples.

        Raises
        ------
        ValueError
            If the forces overflow or lose digits: their rounding error must stay below a millionth
            of the force at rest, or of the margin if that is larger.
        """
        case, leg = (
            np.repeat(i.ravel(), self.samples.ravel()) for i in np.indices(self.samples.shape)
        )
        first = np.cumsum(self.samples) - self.samples.ravel()
        number = np.arange(len(leg)) - np.repeat(first, self.samples.ravel())
        t = self._length[case, leg] * number / (self.samples[case, leg] - 1)
        N, slope = self.forces(case, leg, t, 1)
        dt = np.diff(t)
        inside = dt > 0  # not from one leg to the next
        with np.errstate(all="ignore"):
            s = bottom(np.where(inside, dt, 1), np.diff(N), slope[:, :-1], slope[:, 1:])
        wheel, j = np.nonzero(inside & (s > 0) & (s < 1))
        at, each = t[j] + s[wheel, j] * dt[j], np.arange(len(j))
        for _ in range(3):  # Newton's method
            _, slope, bend = self.forces(case[j], leg[j], at, 2)[:, wheel, each]
            step = np.divide(slope, bend, out=np.zeros_like(at), where=bend > 0)
            at = np.clip(at - step, t[j], t[j + 1])
        N = np.concatenate([N, self.forces(case[j], leg[j], at)[0]], axis=1)
        case, leg, t = (np.append(x, y) for x, y in ((case, case[j]), (leg, leg[j]), (t, at)))
        self._refuse_lost_digits(case, N)
        order = np.lexsort((t, leg, case))
        case, leg, t, N = case[order], leg[order], t[order], N[:, order]
        t += self.start[leg] / self.v[case]
        cuts = np.flatnonzero(np.diff(case)) + 1
        return list(zip(np.split(t, cuts), np.split(leg, cuts), np.split(N, cuts, axis=1)))

    def _refuse_lost_digits(self, case, N):
        """Raise ValueError where the rounding error may be too large; it is estimated as for a bump
        (`suspension.least_force.roundoff`)."""
        T = self.distance / self.v
        with np.errstate(all="ignore"):
            alive = np.minimum(T, 1 / np.maximum(-self._lam.real[:, None], 1e-300))
            units = 8 + np.abs(self._lam).max() * alive
            state = np.abs(self._right) @ (units * np.abs(self._modes).max(axis=2))
            error = 4 * EPS * (np.abs(self.robot.C) @ state).max(axis=0)
            least = np.full(len(self.v), np.inf)
            np.minimum.at(least, case, N.min(axis=0))
            load = np.abs(self.robot.C @ self.robot.equilibrium).max()
            bad = ~(np.isfinite(least) & (error <= DIGITS_LOST * np.maximum(load, -least)))
        if bad.any():
            raise ValueError(
                "robot and road must be so moderate that double precision can tell the forces, "
                f"got {self.robot} at v = {self.v[bad][0]:g} m/s, whose forces may be off by "
                f"{error[bad][0]:.2g} N"
            )


def _driven(z, t, g):
    """What modes have gathered after a time t that are driven by ``sum_j g[j] t^j``; z = lam t."""
    total = 0
    for j, (part, phi) in enumerate(zip(g, _phi(z, len(g)))):
        total = total + part * (factorial(j) * t ** (j + 1)) * phi
    return total


def _phi(z, count):
    """``phi_1 .. phi_count`` of complex numbers, each of the shape of z."""
    near = np.abs(z) < 1
    small, large = np.where(near, z, 0), np.where(near, 1, z)
    series = np.zeros_like(z)  # of the last one; the others follow without loss of digits
    for n in reversed(range(SERIES)):
        series = series * small + 1 / factorial(n + count)
    inside = [series]
    for k in reversed(range(1, count)):
        inside.insert(0, small * inside[0] + 1 / factorial(k))
    outside = [np.exp(large)]
    for k in range(count):
        outside.append((outside[k] - 1 / factorial(k)) / large)
    return [np.where(near, a, b) for a, b in zip(inside, outside[1:], strict=True)]


def _way(robot, road, distance=None):
    """How far a drive over a road in pieces goes, m, if the road begins ahead of the robot."""
    _checks.instance("robot", robot, Robot)
    _checks.instance("road", road, RoadProfile)
    if road.x[0] < robot.L2 * (1 - 4 * EPS) or road.h[0] != 0:
        raise ValueError(
            "road must begin ahead of the robot, which starts at X = 0 on level ground: its first "
            f"point must be at x = {robot.L2:g} m (L2) or more and at height 0, got "
            f"x[0]={road.x[0]:g}, h[0]={road.h[0]:g}"
        )
    if distance is not None:
        return _checks.positive("distance", distance)
    last = road.x[-1] + robot.L1
    if last > DISTANCE * (1 + EPS):
        raise ValueError(
            f"distance must be given, {last:.4g} m or more, for both wheels to pass the whole "
            f"road: it reaches beyond the {DISTANCE:g} m of the problem set, got distance=None"
        )
    return DISTANCE


def profile_minima(robot, road, v, *, distance=None):
    """The least normal force of each wheel on the way over a road in pieces, rear before front.

    Parameters and errors are those of `profile_margin`.

    Returns
    -------
    minima : tuple of two suspension.least_force.Minimum
    """
    passage = Passage(robot, road, [_checks.positive("v", v)], distance).solve()
    [(t, _, N)] = passage.extremes()
    return tuple(
        Minimum(wheel, float(N[i, j]), float(t[j]), float(v * t[j]))
        for wheel, i, j in zip((1, 2), (0, 1), N.argmin(axis=1), strict=True)
    )


def profile_margin(robot, road, v, *, distance=None):
    """The least normal force of both wheels on the way over a road in pieces, exact.

    Parameters
    ----------
    robot : Robot
    road : RoadProfile
        Its first point lies ahead of the robot, which starts at X = 0 in the equilibrium of level
        ground: at x = L2 or more, and at height 0.
    v : float
        Speed, m/s, > 0.
    distance : float, optional
        How far the run goes, m, > 0; if not given, the 1.25 m of the problem set, provided that
        both wheels pass the last point within it.

    Returns
    -------
    margin : float
        N. Where the slope jumps, so does the force of a damper, and the lower value counts.

    Raises
    ------
    ValueError
        If an argument is out of its range; if the modes swing so often on the way that more than 2
        million samples were needed; or if the forces overflow or lose digits, as
        `suspension.margin` says.

    Examples
    --------
    >>> ramp = RoadProfile([0.2, 0.4], [0, 0.02])
    >>> [round(profile_margin(Robot(800, 800), ramp, v), 3) for v in (0.25, 5)]
    [6.999, -10.971]
    """
    return min(minimum.force for minimum in profile_minima(robot, road, v, distance=distance))


def profile_loss(robot, road, v, *, distance=None):
    """The very moment at which a wheel first leaves a road in pieces.

    Parameters and errors are those of `profile_margin`.

    Returns
    -------
    loss : suspension.forces.Loss or None
        None if both wheels keep contact all the way.
    """
    passage = Passage(robot, road, [_checks.positive("v", v)], distance).solve()
    [(t, leg, N)] = passage.extremes()
    loss = first_loss(t, N)
    if loss is None:
        return None
    j = int(np.flatnonzero((N <= 0).any(axis=0))[0])
    begin, losses = passage.start[leg[j]] / passage.v[0], []
    for i in np.flatnonzero(N[:, j] <= 0):

        def force(s, i=i):
            case = np.zeros(1, dtype=int)
            return passage.forces(case, case + leg[j], np.array([s - begin]))[0, i, 0]

        ends = t[j - 1], t[j]  # in a jump one and the same
        at = brentq(force, *ends, xtol=1e-15) if force(ends[0]) > 0 > force(ends[1]) else ends[1]
        losses.append(Loss(int(i) + 1, float(at)))
    return min(losses, key=lambda loss: loss.t)


def highest_multiple(robot, road, v, *, distance=None):
    """How many times as high a road in pieces may be: a higher one lifts a wheel.

    Forces are linear in the heights, as for `suspension.highest_bump`.

    Parameters
    ----------
    robot, road, distance
        As for `profile_margin`.
    v : array_like
        Speeds, m/s, > 0.

    Returns
    -------
    multiple : float or ndarray of the shape of `v`
        At most 1 where contact is lost; inf where no height lifts a wheel.

    Raises
    ------
    ValueError
        As for `profile_margin`.
    """
    v = _checks.positives("v", v)
    load = (robot.C @ robot.equilibrium)[:, None]
    taken = load - _least(robot, road, v.ravel(), distance)
    few = 1e-12 * load  # roundoff
    multiple = np.divide(load, taken, out=np.full_like(taken, np.inf), where=taken > few)
    return multiple.min(axis=0).reshape(v.shape)[()]


def _least(robot, road, v, distance):
    """The least force of each wheel at many speeds, N, shape (2, n)."""
    found, rest = [np.empty((2, 0))], v
    while len(rest):
        one = Passage(robot, road, rest[:1], distance).samples.sum()
        some, rest = np.split(rest, [max(int(BLOCK / one), 1)])
        extremes = Passage(robot, road, some, distance).solve().extremes()
        found.append(np.transpose([N.min(axis=1) for _, _, N in extremes]))
    return np.concatenate(found, axis=1)


def profile_regimes(robot, road, vmin, vmax, *, distance=None):
    """At which speeds contact is kept on the way over a road in pieces, and at which it is lost.

    Parameters
    ----------
    robot, road, distance
        As for `profile_margin`.
    vmin, vmax : float
        Range of speeds, m/s, 0 < vmin < vmax.

    Returns
    -------
    suspension.contact.Regimes
        Its edges to roundoff. Two that differ by less than 1e-5 of their size may be missed, on a
        road of more than 40 features two that differ by 0.5 %.

    Raises
    ------
    ValueError
        As for `profile_margin`; or if the search would need more than 40 million samples of the
        forces: the number is told.
    """
    vmin, vmax = _checks.ends("vmin", vmin, "vmax", vmax)
    distance = _way(robot, road, distance)
    x = _grid(robot, road, np.log(vmin), np.log(vmax), distance)
    known = dict(zip(x, _least(robot, road, np.exp(x), distance).min(axis=0)))

    def margin(x):
        if x not in known:
            known[x] = profile_margin(robot, road, np.exp(x), distance=distance)
        return known[x]

    critical = np.exp(zeros(margin, x))
    inside = critical[(vmin < critical) & (critical < vmax)]
    return regimes_between(lambda v: margin(np.log(v)), [vmin, *inside, vmax])


def _grid(robot, road, low, high, distance):
    """Logarithms of speeds, dense enough for every ripple of the margin.

    As for a bump (`suspension.critical.critical_speeds`) it ripples with the phase that a mode
    gains between two kicks; here these may be as far apart as the ends of the road. On a road of
    many features the ripples are as many and shallow, and no more than `MOST_RIPPLES` are looked
    for.
    """
    level = not np.any(road.h != 0)
    size = np.inf if level else stand_in(road).sigma
    ripples = min(1 + (robot.L1 + robot.L2 + road.x[-1] - road.x[0]) / size, MOST_RIPPLES)
    count = (20 + 10 * ripples) * (high - low)
    tried = np.exp(np.linspace(low, high, 20))
    needed = count * Passage(robot, road, tried, distance).samples.sum(axis=1).mean()
    if not needed <= MAX_SEARCH:
        raise ValueError(
            f"vmin and vmax must be so close to each other, vmin so far from zero, or road so "
            f"short, that at most {MAX_SEARCH:.0e} samples of the forces are needed, "
            f"got {np.exp(low):g} and {np.exp(high):g}: {needed:.2g}"
        )
    return np.linspace(low, high, 2 + int(count))


def stand_in(road):
    """The Gaussian bump that is as high and as steep as a road in pieces.

    A Gaussian bump is steepest sigma from its top, with a slope of ``height / (sqrt(e) sigma)``;
    so ``sigma = |height| / (sqrt(e) slope)``. Where the damper pulls at the steepest place (*skim*)
    it stands for the road; of what else there is in the road's shape it knows nothing.

    Parameters
    ----------
    road : RoadProfile

    Returns
    -------
    bump : GaussianBump
        Its height is that of the place which is furthest above the road's first point, or below
        it, and there is its centre.

    Raises
    ------
    ValueError
        If the road is level.
    """
    x, h = _checks.instance("road", road, RoadProfile).x, road.h - road.h[0]
    top = np.abs(h).argmax()
    if h[top] == 0:
        raise ValueError("road must not be level, got one height at all points")
    _, slope, bend, twist = road.powers(x[:-1], x[:-1])
    length = np.diff(x)
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = np.nan_to_num(-bend / (3 * twist), posinf=0.0, neginf=0.0)  # of the slope
    places = np.array([0 * length, np.clip(turn, 0, length), length])
    steepest = np.abs(slope + places * (2 * bend + 3 * twist * places)).max()
    sigma = abs(h[top]) / (np.sqrt(np.e) * steepest)
    return GaussianBump(float(h[top]), float(sigma), float(x[top]))
