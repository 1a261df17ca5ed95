"""What the page of one's own robot is handed: matrices, groups, limits, vehicles, Python lines."""

from dataclasses import replace
from math import prod

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial

from suspension import _checks
from suspension.explorer.family import WAY, WAYS, round_up
from suspension.least_force import CLEAR
from suspension.profiles import stand_in
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.similarity import follow, groups, skim, throw
from suspension.springs import load_vehicles
from suspension.vehicles import as_bump

__all__ = [
    "LIMITS",
    "NUMBERS",
    "as_product",
    "bump_in_pieces",
    "facts_of",
    "group_products",
    "limit_products",
    "parts_of",
    "python_lines",
    "sag_product",
    "usual_way",
    "vehicles_of",
    "within",
]

NUMBERS = ("m", "Izz", "L1", "L2", "k1", "k2", "c1", "c2")  # of a robot that one can change
# What may be typed, SI.
LIMITS = {
    "m": (1e-3, 1e6),
    "Izz": (1e-8, 1e8),
    **dict.fromkeys(("L1", "L2"), (1e-3, 1e2)),
    **dict.fromkeys(("k1", "k2"), (1e-1, 1e9)),
    **dict.fromkeys(("c1", "c2"), (0.0, 1e7)),
    "v": (1e-3, 1e3),
    "height": (1e-5, 1e1),
    "sigma": (1e-4, 1e2),
    "tall": (1e-5, 1e1),
    "long": (1e-3, 1e4),
    "distance": (1e-3, 1e5),
}
POINTS = (2, 400)  # of a road that is pasted
STEEPEST = 3.0  # slope of a road: a point that climbs a wall is no wheel
COLUMNS = 49  # of a road that is drawn
STRONG = 0.7  # of the critical damping, where a damper's slider ends
LONGEST = 2e4  # radians of the fastest mode that the slowest speed of the chart may take
AHEAD = 0.25  # wheelbases between the front wheel and a road of points
BEYOND = WAY - CLEAR  # widths that a drive goes on beyond the end of the road
CELL, FAR, DEGREE = 0.5, 9.0, 13  # of a bump in pieces, in units of its width
# Half of the wheelbase of the vehicles that are offered, m; nobody is quoted. With the mass over
# the wheels, Izz = m L^2, neither wheel feels the other.
WHEELBASES = {"car": 1.3, "motorcycle fork": 0.7, "empty truck": 1.9, "service robot": 0.2}
# Roads to start from, in widths and heights of the bump that is there.
STAMPS = {
    "kerb": ([0, 2], [0, 1]),
    "pothole": ([0, 2, 4, 6], [0, -1, -1, 0]),
    "two bumps": ([0, 2, 4, 7, 9, 11], [0, 1, 0, 0, 1, 0]),
    "washboard": (list(range(0, 26, 2)), [0] + 6 * [1, 0]),
}
# Of which products of the robot's numbers each of its matrices is a sum.
PRODUCTS = {
    "C": ("k1", "k2", "c1", "c2", "k1 L1", "k2 L2", "c1 L1", "c2 L2"),
    "D": ("k1", "k2", "c1", "c2"),
    "P": ("1/m", "L1/Izz", "L2/Izz"),
    "S": ("1",),
    "e": ("1",),
    "arms": ("L1", "L2"),
}
SYMMETRIC = ("m", "Izz", "L", "k", "c", "v", "height", "sigma")  # what groups depend on


def facts_of(robot, bump, v):
    """All of it, for a robot, a bump and a speed to start from, as a dict for JSON."""
    return {
        "parts": parts_of(robot),
        "bump": bump_in_pieces(),
        "lead": (bump.centre - robot.L2) / bump.sigma,
        "clear": CLEAR,
        "ahead": AHEAD,
        "beyond": BEYOND,
        "ways": WAYS,
        "groups": group_products(),
        "sag": sag_product(robot),
        "byHand": limit_products(),
        "limits": LIMITS,
        "vehicles": vehicles_of(robot, bump, v),
        "stamps": [{"name": name, "x": x, "h": h} for name, (x, h) in STAMPS.items()],
        "points": POINTS,
        "steepest": STEEPEST,
        "columns": COLUMNS,
        "strong": STRONG,
        "longest": LONGEST,
        "python": python_lines(robot.g),
    }


def within(name, value):
    """A number as it may be typed, else ValueError naming it."""
    low, high = LIMITS[name]
    return _checks.number(
        name, value, f"a number from {low:g} to {high:g}", lambda x: low <= x <= high
    )


def usual_way(robot, road):
    """How far a drive goes that nobody has asked to go further, m.

    As far beyond the road as the explorer goes beyond a bump: in widths of the bump, or of the one
    that stands in for the road, and rounded up.

    Parameters
    ----------
    robot : Robot
    road : GaussianBump or RoadProfile

    Returns
    -------
    distance : float
    """
    if isinstance(road, GaussianBump):
        end, sigma = road.centre + CLEAR * road.sigma, road.sigma
    else:
        end, is_level = road.x[-1], not np.any(road.h != road.h[0])
        sigma = (end - road.x[0]) / 10 if is_level else stand_in(road).sigma
    return round_up(end + robot.L1 + BEYOND * sigma, WAYS)


def vehicles_of(robot, bump, v):
    """Vehicles to start from, the given one first: robot, bump, speed, and where they are from.

    On both axles of the published ones rests what one wheel of them carries.
    """
    found = [_vehicle("the robot", robot, bump, v)]
    for car in load_vehicles().itertuples():
        if car.vehicle not in WHEELBASES:
            continue
        L, m = WHEELBASES[car.vehicle], 2 * car.mass
        springs = dict.fromkeys(("k1", "k2"), float(car.stiffness))
        dampers = dict.fromkeys(("c1", "c2"), float(car.damping))
        inertia = float(f"{m * L**2:.4g}")
        own = replace(robot, m=m, Izz=inertia, L1=L, L2=L, **springs, **dampers)
        # A Gaussian of the same height and area, as in Part IV.
        sigma = float(f"{as_bump(car.height, car.length).sigma:.3g}")
        found.append(
            _vehicle(
                f"{car.vehicle}, {car.obstacle}",
                own,
                GaussianBump(car.height, sigma),
                float(f"{np.sqrt(car.slow * car.fast) / 3.6:.2g}"),
                f"Spring, damper and load of one wheel, as published by {car.cited_as}, on both "
                "axles. The wheelbase is assumed, and the mass sits over the wheels.",
            )
        )
    return found


def _vehicle(name, robot, bump, v, note=""):
    """A vehicle for the page, checked: all of it can be typed."""
    return {
        "name": name,
        "robot": {of: within(of, getattr(robot, of)) for of in NUMBERS},
        "bump": {of: within(of, getattr(bump, of)) for of in ("height", "sigma")},
        "v": within("v", v),
        "note": note,
    }


# --- what the page computes with ----------------------------------------------------------------


def parts_of(robot):
    """The robot's matrices as sums over products of its numbers, read off from robots.

    Parameters
    ----------
    robot : Robot
        Whose gravity it is.

    Returns
    -------
    parts : dict
        By the name of a matrix, or of a vector as a column, a list of
        ``{"powers": {name: power}, "matrix": nested list}``.

    Raises
    ------
    ValueError
        If a matrix is no such sum.
    """
    rng = np.random.default_rng(0)
    robots = [replace(robot, **dict(zip(NUMBERS, x))) for x in rng.uniform(0.5, 2, (24, 8))]
    found = {}
    for name, products in PRODUCTS.items():
        powers = [_powers(product) for product in products]
        factors = np.array([[_value(one, each) for each in powers] for one in robots])
        values = np.array([getattr(one, name) for one in robots])
        values = values.reshape(*values.shape[:2], -1)
        flat = values.reshape(len(robots), -1)
        matrices = np.linalg.lstsq(factors, flat, rcond=None)[0].round(9) + 0.0  # no -0.0
        if not np.allclose(factors @ matrices, flat, rtol=1e-12, atol=1e-12):
            raise ValueError(f"{name} must be a sum over {', '.join(products)}, is not")
        found[name] = [
            {"powers": each, "matrix": matrix.reshape(values.shape[1:]).tolist()}
            for each, matrix in zip(powers, matrices, strict=True)
        ]
    return found


def _powers(product):
    """``"k1 L1"`` as ``{"k1": 1, "L1": 1}``, ``"L1/Izz"`` as ``{"L1": 1, "Izz": -1}``."""
    above, _, below = product.partition("/")
    found = {name: 1 for name in above.split() if name != "1"}
    return found | {name: -1 for name in below.split()}


def _value(robot, powers):
    return prod((getattr(robot, name) ** power for name, power in powers.items()), start=1.0)


def bump_in_pieces():
    """A bump of height and width 1 in polynomials, each in powers of the distance since it began.

    Returns
    -------
    bump : dict
        ``start``, where the first piece begins; ``cell``, how long each is; ``table``, the
        coefficients of each. Right to 1e-14 in the height, 1e-11 in the slope.
    """
    table = [
        Chebyshev.interpolate(lambda s, x=x: np.exp(-((x + s) ** 2) / 2), DEGREE, [0, CELL])
        .convert(kind=Polynomial)
        .coef.tolist()
        for x in np.arange(-FAR, FAR, CELL)
    ]
    return {"start": -FAR, "cell": CELL, "table": table}


def as_product(quantity, names):
    """A quantity as an amplitude times powers, whole or half, of what it depends on.

    Parameters
    ----------
    quantity : callable
        ``quantity(*values) -> float``, for values > 1.
    names : sequence of str
        Of the values.

    Returns
    -------
    product : dict
        ``amplitude``, and ``powers`` by name.

    Raises
    ------
    ValueError
        If it is no such product.
    """
    base = np.full(len(names), 2.0)
    at_base = quantity(*base)
    each = [np.log2(quantity(*np.where(np.arange(len(names)) == i, 4.0, base)) / at_base)
            for i in range(len(names))]  # fmt: skip
    powers = np.round(2 * np.array(each)) / 2
    amplitude = at_base / np.prod(base**powers)
    tried = np.linspace(1.3, 3.1, len(names))
    if not np.isclose(amplitude * np.prod(tried**powers), quantity(*tried), rtol=1e-12, atol=0):
        raise ValueError(f"quantity must be a product of powers of {', '.join(names)}, is not")
    found = {name: float(power) for name, power in zip(names, powers, strict=True) if power}
    return {"amplitude": float(amplitude), "powers": found}


def _symmetric(m, Izz, L, k, c, v, height, sigma, g=1.0):
    """What `suspension.similarity.groups` takes, from the numbers of a symmetric robot."""
    robot = Robot(k, k, m=m, Izz=Izz, L1=L, L2=L, c1=c, c2=c, g=g)
    return robot, GaussianBump(height, sigma), v


def group_products():
    """The groups as products of powers; eta is the height over the sag (`sag_product`)."""
    return {
        name: as_product(lambda *x, name=name: getattr(groups(*_symmetric(*x)), name), SYMMETRIC)
        for name in ("nu", "zeta", "j", "lam")
    }


def sag_product(robot):
    """How far the springs of a symmetric robot sag under its weight, m, as a product of powers."""

    def sag(*values):
        own, bump, v = _symmetric(*values, g=robot.g)
        return bump.height / groups(own, bump, v).eta

    return as_product(sag, SYMMETRIC)


def limit_products():
    """The limits of the chart in sags, as products of powers of ``nu``, ``zeta``, ``1 + j``."""
    names = ("nu", "zeta", "1 + j")
    limits = {
        "follow": lambda nu, zeta, i: follow(nu, i - 1),
        "throw": lambda nu, zeta, i: throw(nu),
        "skim": lambda nu, zeta, i: skim(nu, zeta),
    }
    return [{"name": name} | as_product(limit, names) for name, limit in limits.items()]


def python_lines(g):
    """Lines of Python that give the page's numbers, with gaps to fill: for each kind of road.

    ``groups`` or ``twin`` comes below, for a robot that is symmetric or not.
    """
    robot = f"""robot = Robot(
    k1={{k1}}, k2={{k2}}, c1={{c1}}, c2={{c2}},
    m={{m}}, Izz={{Izz}}, L1={{L1}}, L2={{L2}}, g={g!r},
)
"""
    drive = """v, distance = {v}, {distance}  # m/s, m

"""
    return {
        "bump": f"""from suspension import GaussianBump, Robot, highest_bump, regimes
from suspension.contact import exact_loss, minima
from suspension.similarity import groups

{robot}road = bump = GaussianBump(height={{height}}, sigma={{sigma}}, centre={{centre}})
{drive}least = minima(robot, road, v, distance=distance)  # below 0: the wheel is lost
loss = exact_loss(robot, road, v, distance=distance)  # the first, or None
ranges = regimes(robot, road, {{vmin}}, {{vmax}}, distance=distance)  # a moment
highest = highest_bump(robot, road, v, distance=distance)  # m
""",
        "points": f"""import numpy as np

from suspension import Robot
from suspension.profiles import (
    highest_multiple, profile_loss, profile_minima, profile_regimes, stand_in,
)
from suspension.road import RoadProfile
from suspension.similarity import groups

{robot}x = np.array({{x}})
h = np.array({{h}})
road = RoadProfile({{begin}} + {{long}} * (x - x[0]), {{tall}} * (h - h[0]), kind="{{join}}")
{drive}least = profile_minima(robot, road, v, distance=distance)  # below 0: lost
loss = profile_loss(robot, road, v, distance=distance)  # the first, or None
ranges = profile_regimes(robot, road, {{vmin}}, {{vmax}}, distance=distance)  # a moment
highest = highest_multiple(robot, road, v, distance=distance)  # times as high
bump = stand_in(road)  # as high and as steep; a level road has none
""",
        "groups": "numbers = groups(robot, bump, v)\n",
        "twin": "numbers = groups(robot.twin, bump, v)  # with the means of both axles\n",
        "end": 'print(*least, loss, ranges, highest, robot.eigenvalues, numbers, sep="\\n")\n',
    }
