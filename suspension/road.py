"""The ground: a road is any callable ``road(x) -> (H, dHdx)``, arrays in, arrays out."""

from dataclasses import dataclass
from reprlib import repr as short

import numpy as np

from suspension import _checks

__all__ = ["FlatRoad", "GaussianBump", "profile", "road_input", "under_wheels"]


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
