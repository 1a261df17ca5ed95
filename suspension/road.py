"""The ground: a road is any callable ``road(x) -> (H, dHdx)``, arrays in, arrays out."""

from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from reprlib import repr as short

import numpy as np

from suspension import _checks

__all__ = [
    "ISO_8608",
    "FlatRoad",
    "GaussianBump",
    "RoughRoad",
    "profile",
    "road_input",
    "under_wheels",
]

# Roughness Gd(n0) of the road classes of ISO 8608, the geometric means, m^3, at n0 = 0.1 1/m.
ISO_8608 = {name: 16e-6 * 4**i for i, name in enumerate("ABCDEFGH")}
N0 = 0.1  # cycles/m
MAX_WAVES = 10**4
BLOCK = 10**6  # sines computed at a time, to bound the memory


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

    def __call__(self, x):
        """Return height H in m and slope dH/dx at positions `x` in m, each of the shape of `x`."""
        s = (_checks.array("x", x, finite=False) - self.centre) / self.sigma
        with np.errstate(over="ignore"):  # so far away that the height is zero
            H = self.height * np.exp(-(s**2) / 2)
        return H, -s * H / self.sigma


@dataclass(frozen=True)
class FlatRoad:
    """Level ground, ``H = 0``."""

    def __call__(self, x):
        """Return height 0 and slope 0 at positions `x`, each of the shape of `x`."""
        x = _checks.array("x", x, finite=False)
        return np.zeros_like(x), np.zeros_like(x)


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

    @cached_property
    def wavenumbers(self):
        """``n_j`` in cycles/m, shape (waves,)."""
        n = np.arange(1, int(self.length / self.shortest * (1 + 1e-12)) + 1) / self.length
        n.setflags(write=False)
        return n

    @cached_property
    def amplitudes(self):
        """``a_j`` in m, complex, shape (waves,)."""
        n = self.wavenumbers
        phases = np.random.default_rng(self.seed).uniform(0, 2 * np.pi, len(n))
        a = np.sqrt(2 * self.roughness * (N0 / n) ** 2 / self.length) * np.exp(1j * phases)
        a.setflags(write=False)
        return a

    def __call__(self, x):
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
        If the road returns another shape than it was given, or a value that is not finite.
    """
    X = _checks.number("v", v) * _checks.array("t", t)
    H, dHdx = under_wheels(robot, road, X)
    return np.concatenate([H, v * dHdx])


def under_wheels(robot, road, X):
    """The road under both wheels for the centre of mass at `X`, m.

    Parameters
    ----------
    robot : Robot
        Gives L1 and L2.
    road : callable
        ``road(x) -> (H, dHdx)``.
    X : ndarray, shape (n,) or ()

    Returns
    -------
    H, dHdx : ndarray, shape (2, n) or (2,)
        Height in m and slope, rear wheel before front.
    """
    x = np.add.outer(robot.arms, X)
    H, dHdx = profile(road, x.ravel())
    return H.reshape(x.shape), dHdx.reshape(x.shape)


def profile(road, x):
    """Height and slope of a road at `x`, checked: finite, and of the shape of `x`."""
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
