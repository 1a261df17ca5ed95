"""Published vehicles on the obstacles of their roads, each moving along the one chart."""

from typing import NamedTuple

import numpy as np

from suspension import _checks
from suspension.contact import Regimes, regimes
from suspension.road import GaussianBump
from suspension.similarity import Groups, highest_bump, natural_units, way

__all__ = ["Passage", "as_bump", "passage"]

GRAVITY = 9.81  # m/s^2
KMH = 3.6  # km/h in a metre a second
BASE = 4.0  # half the wheelbase over sigma: so far apart the wheels meet the obstacle one by one


class Passage(NamedTuple):
    """A vehicle on an obstacle, over a range of speeds.

    vehicle, obstacle, cited_as, source : str
        Names of both, and where their numbers are from: in words, and in the book's references.
    frequency, zeta, sag : float
        Of the body on its spring: Hz, 1 and m.
    height : float
        Of the obstacle, m.
    contact : Regimes
        Where contact is kept and lost, by the vehicle's own damping, km/h.
    rises : bool
        Whether its highest bump grows with the speed anywhere in the range.
    heavy : float
        Speed above which a rigid wheel's own mass lifts it off the obstacle, km/h; nan if its mass
        is not known.
    """

    vehicle: str
    obstacle: str
    cited_as: str
    source: str
    frequency: float
    zeta: float
    sag: float
    height: float
    contact: Regimes
    rises: bool
    heavy: float


def as_bump(height, length):
    """The Gaussian bump that has the height, m, and the area of an obstacle of that length, m.

    The obstacle is taken for a parabola from foot to foot: 2/3 of height times length in area.

    Raises
    ------
    ValueError
        If `length` is not > 0, or `height` no finite number.

    Examples
    --------
    >>> round(as_bump(0.1, 3.7).sigma, 3)
    0.984
    """
    length = _checks.positive("length", length)
    return GaussianBump(height, 2 / 3 * length / np.sqrt(2 * np.pi))


def passage(vehicle):
    """What the chart says of a vehicle, by `suspension.similarity.natural_units`.

    Only what one wheel carries is published: both axles are taken as alike, the mass over them
    (j = 1), and so far apart that the obstacle is met by one wheel after the other.

    Parameters
    ----------
    vehicle : namedtuple
        A row of `suspension.springs.load_vehicles`.

    Returns
    -------
    Passage
    """
    omega = np.sqrt(vehicle.stiffness / vehicle.mass)  # 1/s
    zeta = vehicle.damping / (2 * vehicle.mass * omega)
    sag = GRAVITY / omega**2  # m
    unit = KMH * as_bump(vehicle.height, vehicle.length).sigma * omega  # km/h, for each nu
    ends = vehicle.slow / unit, vehicle.fast / unit
    robot, bump, _ = natural_units(Groups(1, zeta, vehicle.height / sag, j=1, lam=BASE))
    distance = way(robot, bump, ends[1])
    found = regimes(robot, bump, *ends, distance=distance)
    highest = highest_bump(robot, bump, np.geomspace(*ends, 40), distance=distance)
    wheel = vehicle.unsprung / vehicle.mass
    return Passage(
        vehicle.vehicle,
        vehicle.obstacle,
        vehicle.cited_as,
        vehicle.source,
        omega / (2 * np.pi),
        zeta,
        sag,
        vehicle.height,
        Regimes(unit * found.edges, found.lost, "km/h"),
        bool((np.diff(highest) > 0).any()),
        unit * np.sqrt((1 + wheel) / wheel * sag / vehicle.height + 1 / wheel),
    )
