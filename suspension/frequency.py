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
# Closer to a mode's own frequency, relative to it, roundoff decides how far the robot swings.
NO_DAMPING = 1e-12
ORDER = 8  # of the Gauss-Legendre rule between two nodes


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
        If an argument is out of its range, so large that the motion is no number, there are more
        than 10^6 waves, or one of them swings at the very frequency of an undamped mode.

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
    with np.errstate(over="ignore", invalid="ignore"):  # told below, by name
        iw = 2j * np.pi * v * n
        off = np.abs(iw[:, None] - robot.eigenvalues) <= NO_DAMPING * np.abs(robot.eigenvalues)
        if off.any():
            at = n[off.any(axis=1)][0]
            raise ValueError(
                "v and wavenumber must keep off the frequencies of undamped modes, "
                f"got v={v:g}, wavenumber={at:g}"
            )
        e = np.exp(2j * np.pi * np.outer(robot.arms, n))
        u = np.concatenate([e, iw * e])
        w = np.linalg.solve(iw[:, None, None] * np.eye(4) - robot.A, (robot.B @ u).T[..., None])
        w = w[..., 0].T
        ends = w[0] + np.outer(robot.arms, w[2])
        found = Response(w, robot.C @ w + robot.D @ u, e - ends, iw**2 * w[0])
    if not all(np.isfinite(part).all() for part in found):
        raise ValueError(
            "v and wavenumber must be so small that the motion is finite, "
            f"got v={v:g}, wavenumber to {np.abs(n).max():g}"
        )
    return found


def steady_start(robot, road, v):
    """The state at t = 0 of a robot that has driven on a rough road for ever, shape (4,).

    From it a linear run is periodic from the first moment on: there is no transient to wait for.

    Parameters
    ----------
    robot : Robot
    road : RoughRoad
    v : float
        Speed, m/s.

    Raises
    ------
    ValueError
        As `response` does.
    TypeError
        If `road` is not a RoughRoad.
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

    Raises
    ------
    ValueError
        As `response` does, or if the road is so rough that a mean square is no number.
    TypeError
        If `road` is not a RoughRoad.
    """
    _checks.instance("road", road, RoughRoad)
    with np.errstate(over="ignore"):  # told by name
        power = np.abs(road.amplitudes) ** 2 / 2
    return _spread(response(robot, v, road.wavenumbers), power, "road")


def spectral_rms(robot, v, roughness, longest, shortest, points=20000):
    """The same of all roads of a class at once, ``sigma^2 = integral of |G(n)|^2 Gd(n) dn``.

    The less a mode is damped, the narrower is its resonance; the nodes of the rule close in on it
    as much.

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
        Of the Gauss-Legendre rule in ln n, 2 to 10^6, beside those at the resonances.

    Returns
    -------
    Spread

    Raises
    ------
    ValueError
        If an argument is out of its range, the waves are so long or short that a mean square is no
        number, or the band holds the frequency of an undamped mode, where it is infinite.
    """
    _checks.instance("robot", robot, Robot)
    v = _checks.number("v", v)
    roughness = _checks.nonnegative("roughness", roughness)
    shortest, longest = _checks.ends("shortest", shortest, "longest", longest)
    points = _checks.whole("points", points, 2)
    if points > MAX_WAVES:
        raise ValueError(f"points must be at most {MAX_WAVES}, got {points}")
    low, high = -np.log(longest), -np.log(shortest)
    edges = [np.linspace(low, high, 1 + max(1, points // ORDER))]
    for place, width in _resonances(robot, v):
        if width <= NO_DAMPING and low <= place <= high:
            raise ValueError(
                "robot must have damping, or longest and shortest leave out its undamped mode at a "
                f"wavelength of {np.exp(-place):.4g} m: the mean square is infinite, got "
                f"c1={robot.c1:g}, c2={robot.c2:g}, longest={longest:g}, shortest={shortest:g}"
            )
        edges.append(_closing_in(place, max(width, NO_DAMPING), low, high))
    x, weights = _gauss_legendre(np.unique(np.concatenate(edges)))
    with np.errstate(over="ignore", invalid="ignore"):  # told by name
        n = np.exp(x)
        power = weights * n * roughness * (N0 / n) ** 2
    return _spread(response(robot, v, n), power, "roughness, longest and shortest")


def _resonances(robot, v):
    """Where in ln n the response has its poles, and how far off the real axis: pairs."""
    for eigenvalue in robot.eigenvalues if v else []:
        if eigenvalue.imag >= 0:
            place = np.log(np.abs(eigenvalue / (2 * np.pi * v)))
            yield place, max(float(np.angle(eigenvalue / 1j)), 0.0)


def _closing_in(place, width, low, high):
    """Nodes from `low` to `high` whose distances near `place` shrink to a fifth of a width."""
    ends = np.arcsinh((np.array([low, high]) - place) / width)
    s = np.linspace(*ends, 2 + int(5 * (ends[1] - ends[0])))
    return np.clip(place + width * np.sinh(s), low, high)


def _gauss_legendre(edges):
    """Points and weights of a rule between every two edges."""
    points, weights = np.polynomial.legendre.leggauss(ORDER)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (1 + points)).ravel(), (half * weights).ravel()


def _spread(G, power, names):
    """Root mean squares of outputs `G` per metre, for waves of a given mean square, m^2."""

    def root(amplitude):
        return np.sqrt(np.abs(amplitude) ** 2 @ power)

    with np.errstate(over="ignore", invalid="ignore"):
        parts = map(root, (G.force, G.compression, G.state[2], G.acceleration))
        force, compression, pitch, acceleration = parts
    if not np.isfinite([*force, *compression, pitch, acceleration]).all():
        raise ValueError(f"{names} must give finite mean squares, got {force} N")
    return Spread(force, compression, float(pitch), float(acceleration))


def speed_in_step(robot):
    """The speed at which one heave period passes between the wheels, m/s; None without a swing.

    There the rear wheel meets what the front wheel met in step with the heave that it left behind.

    Raises
    ------
    TypeError
        If `robot` is not a Robot.

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
