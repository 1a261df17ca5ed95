"""The ground: a road is any callable ``road(x) -> (H, dHdx)``, arrays in, arrays out.

A road may have two attributes, which `suspension.flight.fly` reads. `kinks` are the places, m, at
which its slope or curvature jumps: a run stops there and starts anew. `resolution` is the size of
its smallest feature between them, m: no step is longer than twice that.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from reprlib import repr as short
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator, PPoly

from suspension import _checks
from suspension.robot import Robot

__all__ = [
    "ISO_8608",
    "FlatRoad",
    "GaussianBump",
    "RoadProfile",
    "RoughRoad",
    "checked_input",
    "profile",
    "road_input",
    "under_wheels",
]

# Roughness Gd(n0) of the road classes of ISO 8608, the geometric means, m^3, at n0 = 0.1 1/m.
ISO_8608 = {name: 16e-6 * 4**i for i, name in enumerate("ABCDEFGH")}
N0 = 0.1  # cycles/m
MAX_WAVES = 10**4
STEEPEST = 1e6  # slope of a measured profile; what is steeper is a mistake in the units
LONGEST = 1e9  # m, the same
BLOCK = 10**6  # sines computed at a time, to bound the memory


Road = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class GaussianBump:
    """A bump ``H(x) = height exp(-(x - centre)^2 / (2 sigma^2))``, the problem's ``Hgauss``.

    Parameters
    ----------
    height : float
        Height of the top, m; negative for a dip.
    sigma : float
        Half-width from the centre to the steepest point, m, > 0.
    centre : float
        Position of the top, m.

    Raises
    ------
    ValueError
        If a parameter is out of its range.
    """

    height: float = 0.0254
    sigma: float = 0.0288
    centre: float = 0.3

    def __post_init__(self):
        for name, check in [
            ("height", _checks.number),
            ("sigma", _checks.positive),
            ("centre", _checks.number),
        ]:
            object.__setattr__(self, name, check(name, getattr(self, name)))

    @property
    def resolution(self) -> float:
        """Size of the smallest feature, `sigma`, m."""
        return self.sigma

    def __call__(self, x: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Return height H in m and slope dH/dx at positions `x` in m, each of the shape of `x`."""
        s = (_checks.array("x", x, finite=False) - self.centre) / self.sigma
        with np.errstate(over="ignore"):  # so far away that the height is zero
            H = self.height * np.exp(-(s**2) / 2)
        return H, -s * H / self.sigma


@dataclass(frozen=True)
class FlatRoad:
    """Level ground, ``H = 0``."""

    resolution = 1e9  # m: there is nothing to step over

    def __call__(self, x: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Return height 0 and slope 0 at positions `x`, each of the shape of `x`."""
        x = _checks.array("x", x, finite=False)
        return np.zeros_like(x), np.zeros_like(x)


@dataclass(frozen=True, eq=False)
class RoadProfile:
    """A measured road: heights at given places, joined by curves or by straight lines.

    Before the first point and after the last the ground is level, at their heights.

    Parameters
    ----------
    x : array_like, shape (n,)
        Positions, m, at least two, each larger than the one before.
    h : array_like, shape (n,)
        Heights there, m.
    kind : {"pchip", "linear"}
        What lies between two points. ``"pchip"``, for samples of a smooth road: cubic pieces whose
        slope has no jump and which keep between the heights at their ends, so that no measured top
        is overshot (Fritsch and Butland 1984); the slope is zero at every top, dip and end.
        ``"linear"``, for corners of a trapezoid or a ramp: straight lines, whose slope jumps at the
        points, and with it the force of a damper.

    Raises
    ------
    ValueError
        If a number is not finite, there are fewer than two points or not a height for each, or the
        positions do not increase; if they span 10^9 m or a slope reaches 10^6, as with mistaken
        units; or if `kind` is none of these.

    Examples
    --------
    >>> ramp = RoadProfile([0, 0.1], [0, 0.01], kind="linear")
    >>> [value.round(3).tolist() for value in ramp([-1, 0.05, 1])]
    [[0.0, 0.005, 0.01], [0.0, 0.1, 0.0]]
    """

    x: np.ndarray
    h: np.ndarray
    kind: Literal["pchip", "linear"] = "pchip"

    if TYPE_CHECKING:  # what one may give is more than what one gets

        def __init__(
            self, x: ArrayLike, h: ArrayLike, kind: Literal["pchip", "linear"] = "pchip"
        ) -> None: ...

    def __post_init__(self):
        x = _checks.array("x", self.x, (None,))
        h = _checks.array("h", self.h, (None,))
        if len(x) < 2:
            raise ValueError(f"x must have two points at least, got {len(x)}")
        if len(h) != len(x):
            raise ValueError(f"h must have a height for each x, {len(x)}, got {len(h)}")
        back = np.flatnonzero(x[1:] <= x[:-1])
        if back.size:
            i = back[0]
            remedy = "keep one point for each place" if x[i] == x[i + 1] else "sort the points"
            raise ValueError(
                f"x must increase from point to point, got x[{i + 1}] = {x[i + 1]:g} m after "
                f"x[{i}] = {x[i]:g} m: {remedy}"
            )
        _checks.one_of("kind", self.kind, ("pchip", "linear"))
        with np.errstate(over="ignore"):
            length, slopes = x[-1] - x[0], np.diff(h) / np.diff(x)
        if not length < LONGEST:
            raise ValueError(f"x must span less than {LONGEST:g} m, got {length:g} m")
        if not np.abs(slopes).max() < STEEPEST:
            i = np.abs(slopes).argmax()
            raise ValueError(
                f"h must have slopes below {STEEPEST:g}, got {slopes[i]:g} at x = {x[i]:g} m"
            )
        for name, value in (("x", x), ("h", h)):
            value = value.copy()
            value.setflags(write=False)
            object.__setattr__(self, name, value)

    @property
    def _content(self):
        return self.kind, tuple(self.x.tolist()), tuple(self.h.tolist())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, RoadProfile) and self._content == other._content

    def __hash__(self) -> int:
        return hash(self._content)

    @property
    def kinks(self) -> np.ndarray:
        """Where one piece ends and the next begins, m: the points, shape (n,)."""
        return self.x

    @property
    def resolution(self) -> float:
        """Size of its smallest feature, m: between two kinks it has none."""
        return float(self.x[-1] - self.x[0])

    @cached_property
    def _pieces(self):
        """Height and slope between the points, two of SciPy's piecewise polynomials."""
        x, h = self.x, self.h
        if self.kind == "linear":
            height = PPoly(np.array([np.diff(h) / np.diff(x), h[:-1]]), x)
        else:
            # A level piece on either side, so that the slope has no jump at the ends either.
            around = [x[0] - (x[1] - x[0]), *x, x[-1] + (x[-1] - x[-2])]
            with np.errstate(over="ignore"):  # the reciprocal of a slope of next to nothing
                height = PchipInterpolator(around, [h[0], *h, h[-1]])
        return height, height.derivative()

    def powers(self, x: ArrayLike, start: ArrayLike) -> np.ndarray:
        """The polynomial that holds at each `x`, in powers of the distance from `start`.

        Parameters
        ----------
        x, start : array_like, shape (n,)
            Positions, m.

        Returns
        -------
        a : ndarray, shape (4, n)
            ``H = a[0] + a[1] s + a[2] s^2 + a[3] s^3`` with s the distance from `start`, m.

        Raises
        ------
        ValueError
            If a position is not finite, or `x` and `start` have not the same shape (n,).
        """
        x = _checks.array("x", x, (None,))
        start = _checks.array("start", start, x.shape)
        height, _ = self._pieces
        piece = np.clip(np.searchsorted(height.x, x, side="right") - 1, 0, len(height.x) - 2)
        c3, c2, c1, c0 = np.vstack([np.zeros((4 - len(height.c), len(x))), height.c[:, piece]])
        s = start - height.x[piece]
        a = np.array(
            [((c3 * s + c2) * s + c1) * s + c0, (3 * c3 * s + 2 * c2) * s + c1, 3 * c3 * s + c2, c3]
        )
        for level, h in ((x < self.x[0], self.h[0]), (x >= self.x[-1], self.h[-1])):
            a[:, level] = [[h], [0], [0], [0]]
        return a

    def __call__(self, x: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Return height H in m and slope dH/dx at positions `x` in m, each of the shape of `x`.

        At a point where the slope jumps it is that of the piece after it.
        """
        x = _checks.array("x", x, finite=False)
        height, slope = self._pieces
        on = (x >= self.x[0]) & (x < self.x[-1])
        return height(np.clip(x, self.x[0], self.x[-1])), np.where(on, slope(x), 0.0)


@dataclass(frozen=True)
class RoughRoad:
    """A random profile with the spectrum of ISO 8608, periodic: a sum of sines.

    ``H(x) = Re sum_j a_j exp(2 pi i n_j x)`` with wavenumbers ``n_j = j / length`` up to ``1 /
    shortest``, amplitudes ``|a_j| = sqrt(2 Gd(n_j) / length)`` for the power spectral density
    ``Gd(n) = roughness (n / n0)^-2``, ``n0 = 0.1 / m``, and random phases
    (Shinozuka and Deodatis 1991).

    Parameters
    ----------
    roughness : float
        ``Gd(n0)``, m^3, >= 0; `ISO_8608` has that of the classes "A" (smooth) to "H".
    length : float
        Period of the road and its longest wave, m, > 0.
    shortest : float
        Its shortest wave, m, > 0, at most `length`, of which it may be a 10^4th.
    seed : int
        Which of all such roads, >= 0.

    Raises
    ------
    ValueError
        If a parameter is out of its range, or so large that heights are not finite.

    Examples
    --------
    >>> road = RoughRoad(ISO_8608["B"])
    >>> H, _ = road(np.linspace(0, road.length, 1001))
    >>> bool(np.isclose(H[0], H[-1])), len(road.wavenumbers)
    (True, 200)
    """

    roughness: float
    length: float = 20.0
    shortest: float = 0.1
    seed: int = 0

    def __post_init__(self):
        for name, value in [
            ("roughness", _checks.nonnegative("roughness", self.roughness)),
            ("length", _checks.positive("length", self.length)),
            ("shortest", _checks.positive("shortest", self.shortest)),
            ("seed", _checks.whole("seed", self.seed, 0)),
        ]:
            object.__setattr__(self, name, value)
        if not self.length / MAX_WAVES <= self.shortest <= self.length:
            raise ValueError(
                f"shortest must be from length / {MAX_WAVES} to length, got "
                f"shortest={self.shortest:g}, length={self.length:g}"
            )
        if not isfinite(2 * self.roughness * (N0 * self.length) * N0 + 2 * self.roughness):
            raise ValueError(
                "roughness must be so small that heights are finite, got "
                f"roughness={self.roughness:g}, length={self.length:g}"
            )

    @property
    def resolution(self) -> float:
        """Size of the smallest feature, m: an eighth of the shortest wave."""
        return self.shortest / 8

    @cached_property
    def wavenumbers(self) -> np.ndarray:
        """``n_j`` in cycles/m, shape (waves,)."""
        n = np.arange(1, int(self.length / self.shortest * (1 + 1e-12)) + 1) / self.length
        n.setflags(write=False)
        return n

    @cached_property
    def amplitudes(self) -> np.ndarray:
        """``a_j`` in m, complex, shape (waves,)."""
        n = self.wavenumbers
        phases = np.random.default_rng(self.seed).uniform(0, 2 * np.pi, len(n))
        a = np.sqrt(2 * self.roughness * (N0 / n) ** 2 / self.length) * np.exp(1j * phases)
        a.setflags(write=False)
        return a

    def __call__(self, x: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Return height H in m and slope dH/dx at positions `x` in m, each of the shape of `x`."""
        x = _checks.array("x", x, finite=False)
        rate = 2j * np.pi * self.wavenumbers
        both = np.column_stack([self.amplitudes, rate * self.amplitudes])
        H, flat = np.empty((x.size, 2)), x.ravel()
        step = 1 + BLOCK // len(rate)
        for i in range(0, x.size, step):
            waves = np.exp(np.multiply.outer(flat[i : i + step], rate))
            H[i : i + step] = (waves @ both).real
        return H[:, 0].reshape(x.shape), H[:, 1].reshape(x.shape)


def road_input(robot, road, v, t):
    """What the wheels feel at times `t`: ``u = [h1, h2, h1', h2']``, Eqs. 1 to 4.

    Parameters
    ----------
    robot : Robot
        Gives L1 and L2.
    road : callable
        ``road(x) -> (H, dHdx)``.
    v : float
        Speed, m/s; the centre of mass is at ``X = v t``.
    t : array_like, shape (n,) or ()
        Times, s.

    Returns
    -------
    u : ndarray, shape (4, n) or (4,)
        Heights in m, then rates of change in m/s, rear before front.

    Raises
    ------
    ValueError
        If `v` or a time is no finite number, or the road returns another shape than it was given,
        or a value that is not finite.
    TypeError
        If `robot` is not a Robot, or `road` not a function.
    """
    X = _checks.number("v", v) * _checks.array("t", t)
    H, dHdx = under_wheels(robot, road, X)
    return np.concatenate([H, v * dHdx])


def checked_input(robot, road, v, t):
    """What `road_input` gives, of a road whose answer was checked once: for an integrator's loop.

    All its checks take as long as a bump itself, so the answer only has to be finite and as many
    numbers as it was asked for.
    """
    x = np.add.outer(robot.arms, v * t)
    H, dHdx = road(x.ravel())
    u = np.concatenate([H, np.multiply(v, dHdx)])
    if u.size != 2 * x.size or not np.isfinite(u).all():
        return road_input(robot, road, v, t)  # says what is wrong, and where
    return u.reshape(4, *x.shape[1:])


def under_wheels(robot, road, X):
    """The road under both wheels for the centre of mass at `X`, m.

    Parameters
    ----------
    robot : Robot
        Gives L1 and L2.
    road : callable
        ``road(x) -> (H, dHdx)``.
    X : array_like, shape (n,) or ()

    Returns
    -------
    H, dHdx : ndarray, shape (2, n) or (2,)
        Height in m and slope, rear wheel before front.

    Raises
    ------
    ValueError
        As `profile` does, or if `X` does not hold numbers.
    TypeError
        If `robot` is not a Robot, or `road` not a function.
    """
    _checks.instance("robot", robot, Robot)
    x = np.add.outer(robot.arms, _checks.array("X", X, finite=False))
    H, dHdx = profile(road, x.ravel())
    return H.reshape(x.shape), dHdx.reshape(x.shape)


def profile(road, x):
    """Height and slope of a road at `x`, checked: finite, and of the shape of `x`.

    Parameters
    ----------
    road : callable
        ``road(x) -> (H, dHdx)``.
    x : array_like
        Positions, m, any shape.

    Returns
    -------
    H, dHdx : ndarray, of the shape of `x`
        Height in m and slope.

    Raises
    ------
    ValueError
        If `x` does not hold numbers, or the road returns no pair of arrays of numbers, another
        shape than it was given, or a value that is not finite: the place is told.
    TypeError
        If `road` is not a function.
    """
    x = _checks.array("x", x, finite=False)
    value = _checks.function("road", road, "road(x) -> (H, dHdx)")(x)
    try:
        H, dHdx = value
    except (TypeError, ValueError):
        raise ValueError(f"road must return two arrays, H and dHdx, got {short(value)}") from None
    return _on_grid("H", H, x), _on_grid("dHdx", dHdx, x)


def _on_grid(name, value, x):
    value = _checks.array(f"road's {name}", value, finite=False)
    if value.shape != x.shape:
        raise ValueError(f"road must return {name} of the shape of x, {x.shape}, got {value.shape}")
    if not np.isfinite(value).all():
        at = x[~np.isfinite(value)].flat[0]
        raise ValueError(f"road must return finite values, got {name} not finite at x = {at:g} m")
    return value
