"""The ground: a road is any callable ``road(x) -> (H, dHdx)``, arrays in, arrays out."""

from dataclasses import dataclass

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
        s = np.asarray(x, dtype=float) - self.centre
        s *= 1 / self.sigma  # in place: passes over memory cost more than the exponential
        H = s * s
        H *= -0.5
        H = np.exp(H)
        H *= self.height
        s *= H
        s *= -1 / self.sigma
        return H, s


@dataclass(frozen=True)
class FlatRoad:
    """Level ground, ``H = 0``."""

    def __call__(self, x):
        """Return height 0 and slope 0 at positions `x`, each of the shape of `x`."""
        x = np.asarray(x, dtype=float)
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
    X = v * np.asarray(t, dtype=float)
    H, dHdx = under_wheels(robot, road, X.reshape(1, -1))
    return np.concatenate([H[0], v * dHdx[0]]).reshape(4, *X.shape)


def under_wheels(robot, road, X):
    """The road under both wheels for the centre of mass at `X`, m.

    Parameters
    ----------
    robot : Robot
        Gives L1 and L2.
    road : callable
        ``road(x) -> (H, dHdx)``.
    X : ndarray, shape (s, n)

    Returns
    -------
    H, dHdx : ndarray, shape (s, 2, n)
        Height in m and slope, rear wheel before front.
    """
    x = X[:, None, :] + np.array([[-robot.L1], [robot.L2]])
    H, dHdx = profile(road, x.ravel())
    return H.reshape(x.shape), dHdx.reshape(x.shape)


def profile(road, x):
    """Height and slope of a road at `x`, checked: finite, and of the shape of `x`."""
    value = road(x)
    try:
        H, dHdx = value
    except (TypeError, ValueError):
        raise ValueError(f"road must return two arrays, H and dHdx, got {value!r}") from None
    return _on_grid("H", H, x), _on_grid("dHdx", dHdx, x)


def _on_grid(name, value, x):
    value = _checks.array(f"road's {name}", value, finite=False)
    if value.shape != x.shape:
        raise ValueError(f"road must return {name} of the shape of x, {x.shape}, got {value.shape}")
    if not np.isfinite(value).all():
        at = x[~np.isfinite(value)].flat[0]
        raise ValueError(f"road must return finite values, got {name} not finite at x = {at:g} m")
    return value
