"""The robot as a filter: what it makes of a sine wave in the road, and of a sum of them.

Over ``H(x) = Re a exp(2 pi i n x)`` both wheels meet the same wave, the rear one later: the input
is ``u = [e_1, e_2, i omega e_1, i omega e_2] a exp(i omega t)`` with ``omega = 2 pi v n`` and
``e_i = exp(2 pi i n arms_i)``. After all transients the state is ``w_eq`` plus the real part of
``(i omega - A)^-1 B u``.
"""

from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.road import N0, RoughRoad
from suspension.robot import Robot

__all__ = ["Response", "Spread", "response", "rms", "spectral_rms", "speed_in_step", "steady_start"]

MAX_WAVES = 10**6  # solved for at once: a second


class Response(NamedTuple):
    """Complex amplitudes per metre of the road's, one for each of n waves.

    Attributes
    ----------
    state : ndarray, shape (4, n)
        ``[Y, Y', theta, theta']``.
    force, compression : ndarray, shape (2, n)
        Of the rear and the front wheel, N/m and m/m.
    acceleration : ndarray, shape (n,)
        ``Y''``, 1/s^2.
    """

    state: np.ndarray
    force: np.ndarray
    compression: np.ndarray
    acceleration: np.ndarray


class Spread(NamedTuple):
    """Root mean squares about the mean: forces and compressions, shape (2,), N and m, pitch, rad,
    and acceleration of the centre of mass, m/s^2."""

    force: np.ndarray
    compression: np.ndarray
    pitch: float
    acceleration: float


def response(robot, v, wavenumber):
    """The robot's periodic motion over a sine wave in the road.

    Parameters
    ----------
    robot : Robot
    v : float
        Speed, m/s.
    wavenumber : array_like, shape (n,)
        Waves to a metre, 1/m.

    Returns
    -------
    Response
        The phase is counted from the wave at the centre of mass.

    Raises
    ------
    ValueError
        If an argument is out of its range, there are more than 10^6 waves, or one of them swings
        at the very frequency of an undamped mode.

    Examples
    --------
    >>> from suspension.robot import Robot
    >>> np.abs(response(Robot(800, 800), 1.2, [0.01, 100]).state[0]).round(3)
    array([1.   , 0.001])
    """
    _checks.instance("robot", robot, Robot)
    v = _checks.number("v", v)
    n = _checks.array("wavenumber", wavenumber, (None,))
    if n.size > MAX_WAVES:
        raise ValueError(f"wavenumber must hold at most {MAX_WAVES} waves, got {n.size}")
    iw = 2j * np.pi * v * n
    e = np.exp(2j * np.pi * np.outer(robot.arms, n))
    u = np.concatenate([e, iw * e])
    try:
        w = np.linalg.solve(iw[:, None, None] * np.eye(4) - robot.A, (robot.B @ u).T[..., None])
    except np.linalg.LinAlgError:
        raise ValueError(
            f"v and wavenumber must keep off the frequencies of undamped modes, got v={v:g}"
        ) from None
    w = w[..., 0].T
    ends = w[0] + np.outer(robot.arms, w[2])
    return Response(w, robot.C @ w + robot.D @ u, e - ends, iw**2 * w[0])


def steady_start(robot, road, v):
    """The state at t = 0 of a robot that has driven on a rough road for ever, shape (4,).

    From it a linear run is periodic from the first moment on: there is no transient to wait for.

    Parameters
    ----------
    robot : Robot
    road : RoughRoad
    v : float
        Speed, m/s.
    """
    _checks.instance("road", road, RoughRoad)
    W = response(robot, v, road.wavenumbers).state
    return robot.equilibrium + (W @ road.amplitudes).real


def rms(robot, road, v):
    """Root mean squares of the linear motion on a rough road, over its period: exact.

    The waves of the road have different frequencies, so their squares add up (Parseval).

    Parameters
    ----------
    robot : Robot
    road : RoughRoad
    v : float
        Speed, m/s.

    Returns
    -------
    Spread
    """
    _checks.instance("road", road, RoughRoad)
    return _spread(response(robot, v, road.wavenumbers), np.abs(road.amplitudes) ** 2 / 2)


def spectral_rms(robot, v, roughness, longest, shortest, points=20001):
    """The same of all roads of a class at once, ``sigma^2 = integral of |G(n)|^2 Gd(n) dn``.

    Parameters
    ----------
    robot : Robot
    v : float
        Speed, m/s.
    roughness : float
        ``Gd(n0)``, m^3, >= 0, of ``Gd(n) = roughness (n / n0)^-2``.
    longest, shortest : float
        The ends of the band of wavelengths, m.
    points : int
        Of the trapezoidal rule in ln n, 2 to 10^6.

    Returns
    -------
    Spread
    """
    roughness = _checks.nonnegative("roughness", roughness)
    shortest, longest = _checks.ends("shortest", shortest, "longest", longest)
    points = _checks.whole("points", points, 2)
    if points > MAX_WAVES:
        raise ValueError(f"points must be at most {MAX_WAVES}, got {points}")
    x = np.linspace(-np.log(longest), -np.log(shortest), points)
    n = np.exp(x)
    weights = np.full(len(x), x[1] - x[0])
    weights[[0, -1]] /= 2
    return _spread(response(robot, v, n), weights * n * roughness * (N0 / n) ** 2)


def _spread(G, power):
    """Root mean squares of outputs `G` per metre, for waves of a given mean square, m^2."""

    def root(amplitude):
        return np.sqrt(np.abs(amplitude) ** 2 @ power)

    return Spread(
        root(G.force), root(G.compression), float(root(G.state[2])), float(root(G.acceleration))
    )


def speed_in_step(robot):
    """The speed at which one heave period passes between the wheels, m/s; None without a swing.

    There the rear wheel meets what the front wheel met in step with the heave that it left behind.

    Examples
    --------
    >>> round(speed_in_step(Robot(800, 800)), 3)
    1.129
    """
    _checks.instance("robot", robot, Robot)
    heave = robot.eigenvalues[robot.heave_share.argmax()]
    if heave.imag == 0:
        return None
    return float((robot.L1 + robot.L2) * abs(heave.imag) / (2 * np.pi))
