"""Bad input is refused by name, at once, at every public door: one table for all of them.

A row is a function, arguments that it takes, and for each argument what it must refuse: with
TypeError a thing of the wrong kind (a robot that is no robot), with ValueError any other, and
always with a message that names the argument.
"""

import re
import resource
import signal
import sys
from contextlib import contextmanager
from decimal import Decimal
from fractions import Fraction
from typing import NamedTuple

import matplotlib
import numpy as np
import pandas as pd
import pytest
from helpers import ROOT, Quantity, UnitArray
from matplotlib import pyplot as plt

import suspension
from suspension import (
    accuracy,
    choice,
    contact,
    course,
    critical,
    exact,
    flight,
    frequency,
    least_force,
    measured,
    similarity,
    spring_law,
    springs,
    travel,
    uncertainty,
)
from suspension.animation import animate_robot
from suspension.branches import branches
from suspension.energy import energy, landings
from suspension.explorer import Prediction, explore
from suspension.explorer.workshop import Workshop
from suspension.least_force import distance_over
from suspension.practice import errors_of
from suspension.rides import rides
from suspension.road import RoadProfile, RoughRoad, profile, road_input, under_wheels
from suspension.small_angle import full_geometry, margin_with
from suspension.sweep import drive, sweep
from suspension.tyre import Tyre, heaviest_wheel, roll
from suspension.uncertainty import loss_probability

matplotlib.use("Agg")

SECONDS = 2  # of computing, to refuse
GIGABYTES = 1.5  # of addresses, not of memory
ENOUGH = 30  # bad values for every function
ROBOT = suspension.Robot(800, 800)
BUMP = suspension.GaussianBump()
CRITICAL_SPEED = float(suspension.critical_speeds(ROBOT, BUMP, 0.3, 1)[0])  # m/s
RK4 = suspension.RK4
ROUGH = RoughRoad(1e-5, length=1, shortest=0.2)
DATA = springs.load_spring_data(ROOT / "data" / "spring_data.csv")
FIT = springs.fit_spring(DATA)
T = np.linspace(0, 1, 11)
W = np.tile(ROBOT.equilibrium[:, None], 11)
FORCES = np.ones((2, 11))
TYRE = Tyre(0.01, 1e5, 3.0)
FLIGHT = suspension.fly(ROBOT, BUMP, v=5, tfinal=0.1)
WEIGHTLESS = suspension.Robot(800, 800, g=0)
LAW = spring_law.SpringLaw(0.0, 13.2, 0.5, 0.0165, stop=8000.0)
TWO_LAWS = spring_law.SpringLaw([0.0, 0.1], 13.2, 0.5, 0.0165)


class Thing:
    """Nothing that any function could use."""


NOT_A_NUMBER = [
    *(np.nan, np.inf, -np.inf, np.float64("nan"), Decimal("NaN"), 10**400),
    *(None, "1.5", "three", "", b"1", np.array("1.5"), np.array(None)),
    *(1j, complex(1, 0), np.complex128(1)),
    *(np.ma.masked, np.ma.array(1.0, mask=True)),
    *([], [1.0], [1.0, 2.0], (1.0, 2.0), np.array([1.0]), np.array([1.0, 2.0]), np.eye(2)),
    *(np.datetime64("2026-01-01"), np.timedelta64(1, "s")),
    *(Quantity(1.0), Quantity(np.ones(2)), [Quantity(1.0)], UnitArray(1.0), UnitArray([1.0])),
    *({}, {1.0}, Thing(), Thing, len, slice(3)),
]
NEGATIVE = [-1, -1.5, -1e-300, np.float32(-2), Fraction(-1, 3), -np.finfo(float).max]
ZERO = [0, 0.0, -0.0, False]
NOT_NONNEGATIVE = NOT_A_NUMBER + NEGATIVE
NOT_POSITIVE = NOT_NONNEGATIVE + ZERO
OUTSIDE = [np.nan, np.inf, -np.inf, [np.nan, 1.0], [1.0, np.inf]]
NOT_A_DISTANCE = [*(value for value in NOT_POSITIVE if value is not None), 1e9, 1e300]
UNDER_A_WHEEL = [suspension.GaussianBump(centre=x) for x in (0.107, -0.107, 0.0, 0.2, -0.2)]
NOT_WHOLE = [*NOT_POSITIVE, 0.5, 1.5, 1 + 1e-9, Fraction(3, 2)]
NOT_AN_OBJECT = [
    *(None, 3, 2.5, True, np.nan, 1j, Decimal(1), "robot", b"robot"),
    *([], {}, (1, 2), range(3), np.zeros(4), np.eye(4), np.ma.masked, pd.Series([1.0])),
    *(Thing(), object()),
]
NOT_A_ROBOT = [*NOT_AN_OBJECT, Thing, suspension.Robot, BUMP, RK4, len]
NOT_A_BUMP = [*NOT_AN_OBJECT, Thing, suspension.GaussianBump, ROBOT, suspension.FlatRoad(), len]
NOT_A_SCHEME = [*NOT_AN_OBJECT, Thing, suspension.Scheme, "RK4", ROBOT, len]
NOT_A_TABLE = [*NOT_AN_OBJECT, Thing, ROBOT, DATA["force"], np.ones((5, 2)), len]
NOT_A_LAW = [*NOT_AN_OBJECT, Thing, spring_law.SpringLaw, FIT, ROBOT, len]
NOT_A_FIT = [*NOT_AN_OBJECT, Thing, springs.SpringFit, FIT.results, DATA, LAW, len]
SEVERAL_ROBOTS = [[ROBOT], [ROBOT, ROBOT], [ROBOT] * 3, [[ROBOT], [ROBOT]], []]
NOT_A_STIFFNESS = [
    *(springs.Stiffness("k", value, 1.0, 5) for value in NOT_POSITIVE),
    *(springs.Stiffness("k", 800.0, error, 5) for error in NOT_NONNEGATIVE),
]
NO_ROADS = [
    lambda x: None,
    lambda x: 0.0,
    lambda x: x,
    lambda x: (x, x, x),
    lambda x: (x,),
    lambda x: (0.0, 0.0),
    lambda x: (x[:0], x[:0]),
    lambda x: (x, np.append(x, 0)),
    lambda x: (x * np.nan, x),
    lambda x: (x, np.full_like(x, np.inf)),
    lambda x: (x + 1j, x),
    lambda x: (x, x.astype(str)),
    lambda x: (x, np.full(x.shape, None)),
    lambda x: "HH",
    lambda x: (Quantity(x), x),
    lambda x: (x, UnitArray(x)),
    lambda x: (np.ma.array(x, mask=True), x),
    len,
]


def but(values, *allowed):
    """The list of values without those that this argument may be (the very objects)."""
    return [value for value in values if not any(value is other for other in allowed)]


def not_an_array(good, complex_too=False):
    """What cannot be `good` with all its shapes and sizes, because it does not hold numbers."""
    good = np.asarray(good)
    values = [
        *(None, "1.5", "", b"1", {}, {1.0}, Thing(), Thing, len, slice(3), object()),
        *(np.datetime64("2026-01-01"), np.timedelta64(1, "s"), Decimal(1), [Decimal(1)] * 4),
        *(good.astype(str), good.astype(bytes), good.astype(object), good.astype("M8[s]")),
        *(np.full(good.shape, None), pd.Series(["1.5"]), [None], ["1", "2"], [[1], [2, 3]]),
        *(np.ma.masked, np.ma.array(good, mask=True), np.ma.masked_equal(good, good.flat[0])),
        *(Quantity(good), UnitArray(good), [Quantity(good)], [UnitArray(1.0)] * 4, UnitArray(1.0)),
        *([10**400] * 4, np.zeros(4, dtype=[("x", float)]), (x for x in "1234"), iter([1.0])),
    ]
    return values if complex_too else [*values, 1j, good.astype(complex), good + 1j]


def not_finite(good):
    """What cannot be `good` because it does not hold finite numbers, or has other dimensions."""
    good = np.asarray(good)
    last = np.arange(good.size).reshape(good.shape) == good.size - 1
    return [
        *not_an_array(good),
        *(np.where(last, bad, good) for bad in (np.nan, np.inf, -np.inf)),
        *(1.5, good[..., None], good[None], np.stack([good, good])),
    ]


def not_like(good):
    """What cannot be `good`, an array of finite numbers and of this shape."""
    good = np.asarray(good)
    return [*not_finite(good), [], good[..., :-1], np.concatenate([good, good], axis=-1)]


class Row(NamedTuple):
    """A function by its name, arguments that it takes, and what each must refuse, and how."""

    name: str
    function: callable
    good: dict
    values: dict = {}  # noqa: RUF012
    kinds: dict = {}  # noqa: RUF012
    also: tuple = ()  # what a message may name instead: a column, a file


DRIVE = {"robot": ROBOT, "road": BUMP, "v": 1.2}
CROSS = {"robot": ROBOT, "bump": BUMP, "v": 1.2}
NO_DRIVE = {"robot": NOT_A_ROBOT, "road": NOT_AN_OBJECT}
NO_CROSSING = {"robot": NOT_A_ROBOT, "bump": NOT_A_BUMP}
TOO_MANY_STEPS = 1e-12
TABLE = [
    Row(
        "Robot",
        suspension.Robot,
        {"k1": 8, "k2": 8, "g": 9.8, "m": 1, "Izz": 1, "L1": 1, "L2": 1, "c1": 1, "c2": 1},
        dict.fromkeys(["k1", "k2", "m", "Izz", "L1", "L2"], NOT_POSITIVE)
        | dict.fromkeys(["g", "c1", "c2"], NOT_NONNEGATIVE),
    ),
    Row(
        "GaussianBump",
        suspension.GaussianBump,
        {"height": -0.02, "sigma": 0.03, "centre": 0.3},
        {"height": NOT_A_NUMBER, "sigma": NOT_POSITIVE, "centre": NOT_A_NUMBER},
    ),
    Row("GaussianBump()", BUMP, {"x": T}, {"x": not_an_array(T)}),
    Row("FlatRoad()", suspension.FlatRoad(), {"x": T}, {"x": not_an_array(T)}),
    Row(
        "Scheme",
        suspension.Scheme,
        {"name": "Heun", "order": 2, "a": [[0, 0], [1, 0]], "b": [0.5, 0.5], "c": [0, 1]},
        {
            "order": NOT_WHOLE,
            "a": not_like([[0.0, 0.0], [1.0, 0.0]]),
            "b": [*not_finite([0.5, 0.5]), [0.5, 0.6], [1, 1]],
            "c": [*not_like([0.0, 1.0]), [0, 0.5], [1, 1]],
        },
        {"name": [None, 3, b"Heun", [], Thing()]},
    ),
    Row(
        "stability_function",
        RK4.stability_function,
        {"z": [-1 + 1j, 0]},
        {"z": not_an_array([-1.0, 0.0], complex_too=True)},
    ),
    Row(
        "one_step",
        RK4.one_step,
        {"A": ROBOT.A, "dt": 0.01},
        {
            "A": [*not_an_array(ROBOT.A), ROBOT.A * np.nan, 1.5, [], [1.0], ROBOT.A[1:]],
            "dt": NOT_POSITIVE,
        },
    ),
    Row(
        "is_stable",
        RK4.is_stable,
        {"eigenvalues": ROBOT.eigenvalues, "dt": 0.01},
        {
            "eigenvalues": [*not_an_array([1.0], complex_too=True), [np.nan], [-np.inf, -1]],
            "dt": NOT_POSITIVE,
        },
    ),
    Row(
        "max_stable_dt",
        RK4.max_stable_dt,
        {"eigenvalues": ROBOT.eigenvalues},
        {"eigenvalues": [*not_an_array([1.0], complex_too=True), [np.nan], [-np.inf, -1]]},
    ),
    Row("boundary", RK4.boundary, {"n": 16}, {"n": [*NOT_WHOLE, 1, 2, 3, 10**12]}),
    Row(
        "simulate",
        suspension.simulate,
        DRIVE | {"dt": 0.01, "tfinal": 0.1, "scheme": RK4, "w0": np.zeros(4)},
        {
            "road": NO_ROADS,
            "v": NOT_A_NUMBER,
            "dt": [*NOT_POSITIVE, TOO_MANY_STEPS, 5e-324],
            "tfinal": [*NOT_POSITIVE, 1e300],
            "w0": but(not_like(np.zeros(4)), None),
        },
        NO_DRIVE | {"scheme": NOT_A_SCHEME},
    ),
    Row(
        "fly",
        suspension.fly,
        DRIVE
        | {"tfinal": 0.1, "w0": np.zeros(4), "wheel": "relaxes", "resolution": 0.01}
        | {"samples": 11},
        {
            "road": NO_ROADS,
            "v": [*NOT_A_NUMBER, 1e12, -1e300],
            "tfinal": [*NOT_POSITIVE, 1e12, 1e300],
            "w0": but(not_like(np.zeros(4)), None),
            "wheel": [*NOT_A_NUMBER, "", "follow", "Follows", b"follows", ["follows"]],
            "resolution": [*but(NOT_POSITIVE, None), TOO_MANY_STEPS],
            "samples": [*NOT_WHOLE, 1, 10**12],
        },
        NO_DRIVE,
    ),
    Row(
        "Tyre",
        Tyre,
        {"mass": 0.01, "stiffness": 1e5, "damping": 3.0},
        {"mass": NOT_POSITIVE, "stiffness": NOT_POSITIVE, "damping": NOT_NONNEGATIVE},
    ),
    Row(
        "roll",
        roll,
        DRIVE | {"tyre": TYRE, "tfinal": 0.01, "samples": 3, "resolution": 0.01, "rtol": 1e-5},
        {
            "road": NO_ROADS,
            "v": [*NOT_POSITIVE, 1e300],
            "tfinal": [*NOT_POSITIVE, 1e12, 1e300],
            "samples": [*NOT_WHOLE, 1, 10**12],
            "resolution": [*but(NOT_POSITIVE, None), TOO_MANY_STEPS],
            "rtol": [*NOT_POSITIVE, 1],
        },
        NO_DRIVE | {"tyre": [*NOT_AN_OBJECT, Tyre, ROBOT, len]},
    ),
    Row(
        "heaviest_wheel",
        heaviest_wheel,
        CROSS | {"distance": 1.25},
        {"v": NOT_POSITIVE, "distance": NOT_A_DISTANCE},
        NO_CROSSING,
    ),
    Row(
        "energy",
        energy,
        {"flight": FLIGHT, "robot": ROBOT, "road": BUMP},
        {"road": NO_ROADS},
        {"flight": NOT_AN_OBJECT, "robot": NOT_A_ROBOT, "road": NOT_AN_OBJECT},
    ),
    Row(
        "landings",
        landings,
        {"flight": FLIGHT, "robot": ROBOT, "road": BUMP},
        {"road": NO_ROADS},
        {"flight": NOT_AN_OBJECT, "robot": NOT_A_ROBOT, "road": NOT_AN_OBJECT},
    ),
    Row(
        "flat_ground",
        exact.flat_ground,
        {"robot": ROBOT, "w0": np.zeros(4), "t": T},
        {"w0": not_like(np.zeros(4)), "t": [*not_an_array(T), -T - 1, [np.nan], [np.inf]]},
        {"robot": NOT_A_ROBOT},
    ),
    Row(
        "over_bump",
        suspension.over_bump,
        CROSS | {"t": T, "w0": np.zeros(4)},
        {
            "v": NOT_A_NUMBER,
            "t": [*not_an_array(T), -T - 1, [np.nan], [np.inf]],
            "w0": but(not_like(np.zeros(4)), None),
        },
        NO_CROSSING,
    ),
    Row(
        "normal_forces",
        contact.normal_forces,
        DRIVE | {"T": T, "W": W},
        {
            "road": NO_ROADS,
            "v": NOT_A_NUMBER,
            "T": not_finite(T),
            "W": [*not_an_array(W), W[:3], T, W[:, 1:]],
        },
        NO_DRIVE,
    ),
    Row(
        "first_loss",
        contact.first_loss,
        {"T": T, "N": FORCES},
        {
            "T": not_finite(T),
            "N": [*not_an_array(FORCES), FORCES * np.nan, FORCES[:1], FORCES.T, 1, []],
        },
    ),
    *(
        Row(
            function.__name__,
            function,
            CROSS | {"tfinal": 1.0},
            {"v": NOT_POSITIVE, "tfinal": [*but(NOT_POSITIVE, None), 1e12, 1e300]},
            NO_CROSSING,
        )
        for function in (suspension.margin, contact.minima, contact.exact_loss)
    ),
    *(
        Row(
            f"{function.__name__} over a distance",
            function,
            CROSS | {"distance": 1.0},
            {"distance": NOT_A_DISTANCE},
            {"bump": NOT_A_BUMP},
        )
        for function in (
            suspension.margin,
            contact.minima,
            contact.exact_loss,
            travel.travel,
            travel.balance,
            accuracy.disagreement,
        )
    ),
    Row(
        "duration over a distance",
        least_force.duration,
        CROSS | {"distance": 1.0},
        {"v": NOT_POSITIVE, "distance": but(NOT_POSITIVE, None), "bump": UNDER_A_WHEEL},
        NO_CROSSING,
    ),
    Row(
        "duration until a time",
        least_force.duration,
        CROSS | {"v": -1, "tfinal": 1.0},
        {"v": NOT_A_NUMBER, "tfinal": but(NOT_POSITIVE, None), "distance": [1.0]},
    ),
    Row(
        "turning_points",
        least_force.turning_points,
        {"crossing": exact.Crossing(ROBOT, BUMP, 1.2), "distance": 1.0},
        {
            "crossing": [exact.Crossing(ROBOT, BUMP, v) for v in (0, -1.2)],
            "distance": NOT_A_DISTANCE,
        },
        {"crossing": [*NOT_A_ROBOT, exact.Crossing, ROBOT]},
        also=("v",),
    ),
    Row(
        "sample_count",
        least_force.sample_count,
        {"robot": ROBOT, "v": [1.0, 2.0], "distance": 1.0},
        {name: [*not_an_array(1.0), *OUTSIDE, 0, -1, [1, 0]] for name in ("v", "distance")},
        {"robot": NOT_A_ROBOT},
    ),
    Row(
        "zeros",
        critical.zeros,
        {"f": lambda x: x - 0.3, "x": [0.0, 1.0]},
        {
            "f": [
                *((lambda x, bad=bad: bad) for bad in NOT_A_NUMBER),
                *(lambda x, end=end: np.nan if x == end else x + 3 for end in (0, 1)),
                lambda x: x - 0.3 if x in (0, 1) else np.nan,
            ],
            "x": [*not_finite([0.0, 1.0]), [1, 0], [0, 0], [0, 2, 1], [0], []],
        },
        {"f": NOT_AN_OBJECT},
    ),
    Row(
        "distance_over",
        distance_over,
        {"robot": ROBOT, "bump": BUMP, "distance": 1.0},
        {"distance": but(NOT_POSITIVE, None), "bump": UNDER_A_WHEEL},
        NO_CROSSING,
    ),
    *(
        Row(
            function.__name__,
            function,
            {"robot": ROBOT, "bump": BUMP, "vmin": 7.0, "vmax": 9.0, "distance": 1.0},
            {
                "vmin": [*NOT_POSITIVE, 9, 10, 1e-300],
                "vmax": [*NOT_POSITIVE, 7, 6, 1e300],
                "distance": NOT_A_DISTANCE,
                "bump": UNDER_A_WHEEL,
            },
            NO_CROSSING,
        )
        for function in (suspension.critical_speeds, suspension.regimes)
    ),
    Row(
        "Regimes",
        contact.Regimes,
        {"edges": [1.0, 2.0, 3.0], "lost": [True, False]},
        {
            "edges": [
                *not_finite([1.0, 2.0, 3.0]),
                [1],
                [],
                [0, 1, 2],
                [1, 3, 2],
                [1, 1, 2],
            ],
            "lost": [*not_finite([1.0, 0.0]), [True], [True] * 3, [2, 0], [0.5, 1]],
        },
    ),
    Row(
        "Regimes()",
        contact.Regimes([1.0, 2.0, 3.0], [True, False]),
        {"v": [1.0, 3.0]},
        {"v": [*not_an_array(1.0), *OUTSIDE, 0.5, [1, 3.1], [[1], [4]]]},
    ),
    Row(
        "regimes_between",
        contact.regimes_between,
        {"margin_at": lambda v: 2.5 - v, "edges": [1.0, 2.5, 3.0]},
        {"edges": [*not_finite([1.0, 2.0]), [1], [], [0, 1], [2, 1], [1, 1]]},
        {"margin_at": NOT_AN_OBJECT},
    ),
    Row(
        "is_lost",
        contact.is_lost,
        {"margin": [1.0, -2.0]},
        {"margin": [*not_an_array(1.0), *OUTSIDE]},
    ),
    Row(
        "branches",
        branches,
        {"robot": ROBOT, "bump": BUMP, "vmin": 7.5, "vmax": 8.0, "kmin": 780.0, "kmax": 800.0}
        | {"check": 790.0, "distance": 1.0},
        {
            "vmin": [*NOT_POSITIVE, 8, 10],
            "vmax": [*NOT_POSITIVE, 7.5, 6],
            "kmin": [*NOT_POSITIVE, 800, 900],
            "kmax": [*NOT_POSITIVE, 780, 1],
            "check": [*but(NOT_POSITIVE, None), 779, 801],
            "distance": NOT_A_DISTANCE,
        },
        NO_CROSSING,
    ),
    Row(
        "loss_probability",
        loss_probability,
        {"stiffness": FIT, **CROSS, "distance": 1.0},
        {"v": NOT_POSITIVE, "distance": NOT_A_DISTANCE, "stiffness": NOT_A_STIFFNESS},
        {"stiffness": but(NOT_A_FIT, FIT.slope), **NO_CROSSING},
    ),
    Row(
        "critical_speed_intervals",
        uncertainty.critical_speed_intervals,
        {"stiffness": springs.Stiffness("k", 800.0, 0.0, 5), "robot": ROBOT, "bump": BUMP}
        | {"vmin": 7.0, "vmax": 9.0, "level": 0.9},
        {"stiffness": NOT_A_STIFFNESS, "level": [*NOT_POSITIVE, 1, 95]},
        {"stiffness": NOT_A_FIT, **NO_CROSSING},
    ),
    Row(
        "Stiffness.interval",
        lambda value, error, free: springs.Stiffness("k", value, error, free).interval(),
        {"value": 800.0, "error": 1.0, "free": 5},
        {"value": NOT_A_NUMBER, "error": NOT_NONNEGATIVE, "free": but(NOT_WHOLE, *ZERO)},
    ),
    Row(
        "evaluations",
        accuracy.evaluations,
        {"scheme": RK4, "J": 5},
        {"J": but(NOT_WHOLE, *ZERO)},
    ),
    Row(
        "fitted_order",
        accuracy.fitted_order,
        {"dts": [0.1, 0.2], "errors": [0.01, 0.04]},
        {
            "dts": [*not_finite([0.1, 0.2]), [0.1, 0.0], [-0.1, 0.2]],
            "errors": [*not_an_array([1.0, 2.0]), [1.0], [1.0, 2.0, 3.0], 1.0],
        },
    ),
    Row(
        "flight_errors",
        accuracy.flight_errors,
        {"robot": WEIGHTLESS, "road": BUMP, "v": 5.0, "tfinal": 0.1, "steps": [20]},
        {
            "steps": [10, "20", None, len, *([J] for J in NOT_WHOLE)],
            "road": [suspension.FlatRoad()],  # nothing moves
        },
    ),
    Row(
        "just_lost",
        accuracy.just_lost,
        {"robot": ROBOT, "bump": BUMP, "critical": [7.9457], "n": 2},
        {"n": NOT_WHOLE},
        NO_CROSSING,
    ),
    Row(
        "critical_stiffness",
        contact.critical_stiffness,
        CROSS | {"kmin": 500, "kmax": 600},
        {
            "v": NOT_POSITIVE,
            "kmin": [*NOT_POSITIVE, 600, 700, 1e-300],
            "kmax": [*NOT_POSITIVE, 500, 400, 1e30],
        },
        NO_CROSSING,
    ),
    Row(
        "sensitivity",
        lambda robot, bump, v, names: contact.sensitivity(robot, bump, v, names),
        CROSS | {"names": "k1"},
        {"v": NOT_POSITIVE, "names": [*NOT_A_NUMBER, "k", "V", "height", ["k1"]]},
        NO_CROSSING,
    ),
    Row(
        "sweep",
        sweep,
        {"robots": [ROBOT, ROBOT], "road": BUMP, "v": [1.0, 2.0], "steps": 10}
        | {"distance": 1.0, "scheme": RK4},
        {
            "robots": [[ROBOT] * 3],
            "road": NO_ROADS,
            "v": [*not_an_array([1.0, 2.0]), 0, [1, -1], [1, np.nan], [np.inf, 1], [1, 2, 3]],
            "steps": [*NOT_WHOLE, 10**12, 10**9],
            "distance": NOT_POSITIVE,
        },
        {"robots": but(NOT_A_ROBOT, NOT_AN_OBJECT[9]), "road": NOT_AN_OBJECT}
        | {"scheme": NOT_A_SCHEME},
    ),
    Row(
        "drive",
        drive,
        {"robots": [ROBOT, ROBOT], "road": BUMP, "v": [20.0, 10.0], "law": TWO_LAWS}
        | {"ground": "pulls", "geometry": "full", "distance": 1.25, "fine": 0.1},
        {
            "robots": [[ROBOT] * 3],
            "road": NO_ROADS,
            "v": [*not_an_array([1.0, 2.0]), 0, [1, -1], [1, np.nan], [1, 2, 3], [1e-3, 1e-6]],
            "ground": [*NOT_A_NUMBER, "pulled", "Pushes"],
            "geometry": [*NOT_A_NUMBER, "large", True],
            "distance": [*but(NOT_POSITIVE, None), 1e9],
            "fine": [*NOT_POSITIVE, 1e9, 1e300],
        },
        {"robots": but(NOT_A_ROBOT, NOT_AN_OBJECT[9]), "road": NOT_AN_OBJECT}
        | {"law": but(NOT_A_LAW, None)},
    ),
    Row(
        "full_geometry",
        full_geometry,
        {"robot": ROBOT, "bump": BUMP, "critical": CRITICAL_SPEED}
        | {"within": 0.01, "distance": 1.25},
        {
            "critical": [*NOT_POSITIVE, 1.2, 10],
            "within": [*NOT_POSITIVE, 1.5],
            "distance": [*but(NOT_POSITIVE, None), 1e9],
        },
        {"robot": NOT_A_ROBOT, "bump": NOT_A_BUMP},
    ),
    Row(
        "margin_with",
        margin_with,
        {"robot": ROBOT, "bump": BUMP, "v": 10, "terms": ("places",), "distance": 1.25},
        {
            "v": [*NOT_POSITIVE, 1e-6],
            "terms": [("heights", "sines"), "places", (1,)],
            "distance": [*but(NOT_POSITIVE, None), 1e9],
        },
        {"robot": NOT_A_ROBOT, "bump": NOT_A_BUMP},
    ),
    Row(
        "RoughRoad",
        RoughRoad,
        {"roughness": 1e-5, "length": 1.0, "shortest": 0.1, "seed": 1},
        {
            "roughness": [*NOT_NONNEGATIVE, 1e308],
            "length": [*NOT_POSITIVE, 0.01, 1e5],
            "shortest": [*NOT_POSITIVE, 2, 1e-6],
            "seed": but([*NOT_WHOLE, 10**400], *ZERO),
        },
    ),
    Row("RoughRoad()", ROUGH, {"x": T}, {"x": not_an_array(T)}),
    Row(
        "RoadProfile",
        RoadProfile,
        {"x": T, "h": np.zeros(11), "kind": "linear"},
        {
            "x": [*not_like(T), -T, np.zeros(11), 1e300 * T],
            "h": [*not_like(T), 1e300 * T],
            "kind": [*NOT_A_NUMBER, "", "lines", "Linear", b"linear", ["linear"]],
        },
    ),
    Row("RoadProfile()", RoadProfile([0, 1], [0, 0.1]), {"x": T}, {"x": not_an_array(T)}),
    Row(
        "RoadProfile.powers",
        RoadProfile([0, 1], [0, 0.1]).powers,
        {"x": [0.5, 0.6], "start": [0.5, 0.5]},
        {"x": not_finite([0.5, 0.6]), "start": [*not_like([0.5, 0.5]), [0.5]]},
    ),
    Row(
        "profile",
        profile,
        {"road": BUMP, "x": T},
        {"road": NO_ROADS, "x": [*not_an_array(T), [np.nan]]},
        {"road": NOT_AN_OBJECT},
    ),
    Row(
        "under_wheels",
        under_wheels,
        {"robot": ROBOT, "road": BUMP, "X": T},
        {"road": NO_ROADS, "X": not_an_array(T)},
        NO_DRIVE,
    ),
    Row(
        "road_input",
        road_input,
        DRIVE | {"t": T},
        {"road": NO_ROADS, "v": NOT_A_NUMBER, "t": [*not_an_array(T), *OUTSIDE]},
        NO_DRIVE,
    ),
    Row(
        "response",
        frequency.response,
        {"robot": ROBOT, "v": 1.2, "wavenumber": T},
        {"v": NOT_A_NUMBER, "wavenumber": [*not_finite(T), np.zeros(10**6 + 1)]},
        {"robot": NOT_A_ROBOT},
    ),
    *(
        Row(
            function.__name__,
            function,
            {"robot": ROBOT, "road": ROUGH, "v": 1.2},
            {"v": NOT_A_NUMBER},
            {"robot": NOT_A_ROBOT, "road": [*NOT_AN_OBJECT, BUMP, len]},
        )
        for function in (frequency.steady_start, frequency.rms)
    ),
    Row(
        "rides",
        rides,
        {"robots": [ROBOT, ROBOT], "roads": RoughRoad(1e-5, length=1), "v": [2.0, 1.0]}
        | {"ground": "pulls"},
        {
            "robots": [[ROBOT] * 3],
            "roads": [[RoughRoad(1e-5), RoughRoad(1e-5, length=1)]],
            "v": [*not_an_array([1.0, 2.0]), 0, [1, -1], [1, np.nan], [1, 2, 3], [1e-3, 1e-6]],
            "ground": [*NOT_A_NUMBER, "pulled", "Pushes"],
        },
        {"robots": but(NOT_A_ROBOT, NOT_AN_OBJECT[9]), "roads": [3, BUMP, len, "road"]},
    ),
    Row(
        "accuracy.errors",
        accuracy.errors,
        CROSS | {"dt": 0.01, "scheme": RK4},
        {"v": NOT_POSITIVE, "dt": NOT_POSITIVE},
        NO_CROSSING | {"scheme": NOT_A_SCHEME},
    ),
    Row(
        "evaluations",
        accuracy.evaluations,
        {"scheme": RK4, "J": 7},
        {"J": but(NOT_WHOLE, *ZERO)},
        {"scheme": NOT_A_SCHEME},
    ),
    Row(
        "seen_mode",
        accuracy.seen_mode,
        {"scheme": RK4, "lam": -1 + 2j, "dts": [0.1, 0.2]},
        {
            "lam": [*not_an_array(1.0, complex_too=True), *OUTSIDE, complex(0, np.nan), [1j, 2j]],
            "dts": [*not_finite([0.1, 0.2]), [0.1, 0], [-0.1, 0.2], [0.2, 0.1], [0.1, 0.1]],
        },
        {"scheme": NOT_A_SCHEME},
    ),
    Row(
        "half_turn",
        accuracy.half_turn,
        {"seen": [50j, 50j], "dts": [0.1, 0.2]},
        {
            "seen": [
                *not_an_array([1.0, 2.0], complex_too=True),
                *(1j, [], [1j], [1j, 2j, 3j], [[1j, 2j]], [1j, np.nan], [np.inf, 1j]),
            ],
            "dts": [*not_finite([0.1, 0.2]), [0.1, 0], [-0.1, 0.2], [0.2, 0.1], [0.1, 0.1], []],
        },
    ),
    Row(
        "fitted_order",
        accuracy.fitted_order,
        {"dts": [0.1, 0.2], "errors": [1e-3, 4e-3]},
        {
            "dts": [*not_finite([0.1, 0.2]), [0.1, 0], [-0.1, 0.2], [0.1, 0.1], [1, 1]],
            "errors": [*not_an_array([1e-3, 4e-3]), [1.0, 2.0, 3.0], []],
        },
    ),
    Row(
        "just_lost",
        accuracy.just_lost,
        {"robot": ROBOT, "bump": BUMP, "critical": [0.437], "n": 1},
        {
            "critical": [*not_finite([0.437]), [8, 7], [7, 7], [7, 9, 8], [-1, 7], [0, 7], [-1]],
            "n": [*NOT_WHOLE],
        },
        {"robot": NOT_A_ROBOT, "bump": NOT_A_BUMP},
    ),
    *(
        Row(function.__name__, function, CROSS | more, {"v": NOT_POSITIVE})
        for function, more in (
            (accuracy.solve_ivp_errors, {"method": "RK45", "tolerances": [1e-3]}),
            (accuracy.disagreement, {}),
            (accuracy.event_run, {}),
            (accuracy.missed_dip, {}),
        )
    ),
    Row(
        "solve_ivp_errors at tolerances",
        accuracy.solve_ivp_errors,
        CROSS | {"method": "RK45", "tolerances": [1e-3]},
        {"tolerances": [*not_finite([1e-3]), [0.0], [-1.0], [1e-3, np.nan], [1e-3, -1e-3]]},
    ),
    Row(
        "make_flight_gfunc",
        flight.make_flight_gfunc,
        {"robot": ROBOT, "road": BUMP, "pressing": [True, False], "start": 0.1, "end": 0.2},
        {
            "road": NO_ROADS,
            "pressing": [*but(not_like([1.0, 0.0]), None), [2.5, 3], [0.5, 1], [2, 0], [-1, 1]],
            "start": [*NOT_A_NUMBER, 0.2, 0.3],
            "end": [*but(NOT_A_NUMBER, None), 0.1, 0.0],
        },
        NO_DRIVE,
    ),
    Row(
        "make_flight_gfunc()",
        flight.make_flight_gfunc(ROBOT, BUMP),
        {"w": np.zeros(4), "t": 0.1, "v": 1.2},
        {
            "w": [*not_an_array(np.zeros(4)), 0.0, [], np.zeros(3), np.zeros(8), np.zeros((4, 1))],
            "t": NOT_A_NUMBER,
            "v": NOT_A_NUMBER,
        },
    ),
    Row(
        "flight_errors",
        accuracy.flight_errors,
        DRIVE | {"tfinal": 0.1, "steps": [10]},
        {
            "v": NOT_A_NUMBER,
            "tfinal": NOT_POSITIVE,
            "steps": [[10, bad] for bad in NOT_WHOLE],
        },
        NO_DRIVE,
    ),
    Row(
        "spectral_rms",
        frequency.spectral_rms,
        {"robot": ROBOT, "v": 1.2, "roughness": 1e-5, "longest": 2, "shortest": 1, "points": 9},
        {
            "v": NOT_A_NUMBER,
            "roughness": NOT_NONNEGATIVE,
            "longest": [*NOT_POSITIVE, 1, 0.5],
            "shortest": [*NOT_POSITIVE, 2, 3],
            "points": [*NOT_WHOLE, 1, 10**7],
        },
        {"robot": NOT_A_ROBOT},
    ),
    Row(
        "demands",
        choice.demands,
        {"robot": ROBOT, "road": BUMP, "v": [1.0, 2.0], "k": [500.0, 800.0], "c": [1.0, 2.0]},
        {
            "road": NO_ROADS,
            "v": [*not_finite([1.0, 2.0]), [0, 1], [-1, 1]],
            "k": [*not_finite([1.0, 2.0]), [0, 1], [1, -1]],
            "c": [*not_finite([1.0, 2.0]), [0, -1]],
        },
        NO_DRIVE,
    ),
    Row(
        "candidate",
        choice.candidate,
        {"robot": ROBOT, "bump": BUMP, "v": [9.0, 10.0]},
        {"v": [*not_finite([1.0, 2.0]), [0, 1], [-1, 1], [], [1], [1, 1]]},
        NO_CROSSING,
    ),
    Row(
        "fitted_with",
        choice.fitted_with,
        {"robot": ROBOT, "k": 700.0, "c": 1.0},
        {"k": NOT_POSITIVE, "c": NOT_NONNEGATIVE},
        {"robot": NOT_A_ROBOT},
    ),
    Row(
        "efficient",
        choice.efficient,
        {"costs": np.ones((3, 2))},
        {"costs": [*not_finite(np.ones((3, 2))), np.ones((5001, 2))]},
    ),
    *(
        Row(
            function.__name__,
            function,
            {"robot": ROBOT, "bump": BUMP, "v": [5.0, 10.0], "k": [500.0, 800.0], "c": [1.0, 2.0]}
            | more,
            {
                "v": [*not_finite([1.0, 2.0]), [0, 1], [-1, 1], []],
                "k": [*not_finite([1.0, 2.0]), [0, 1], [-1, 1], [2, 1], [], np.arange(1, 9999)],
                "c": [*not_finite([1.0, 2.0]), [0, 1], [-1, 1], [2, 1], [], np.arange(1, 9999)],
            }
            | bad,
            NO_CROSSING,
        )
        for function, more, bad in (
            (choice.cheapest, {"reserve": 0.1}, {"reserve": NOT_NONNEGATIVE}),
            (choice.farthest, {"name": "k"}, {"name": ["K", None, 1]}),
        )
    ),
    Row(
        "groups",
        similarity.groups,
        CROSS,
        {"v": NOT_POSITIVE, "robot": [suspension.Robot(1, 2), suspension.Robot(1, 1, g=0)]},
        NO_CROSSING,
    ),
    Row(
        "highest_bump",
        suspension.highest_bump,
        CROSS | {"v": [1.0, 2.0], "distance": [1.0, 2.0]},
        {
            "v": [*not_an_array([1.0, 2.0]), 0, [1, -1], [1, np.nan], [np.inf, 1], [1, 2, 3], 1e-9],
            "distance": [
                *but(not_an_array([1.0, 2.0]), None),
                *(0, [1, -1], [1, np.nan], [np.inf, 1], [1, 2, 3], 1e12),
            ],
        },
        NO_CROSSING,
    ),
    Row(
        "way",
        similarity.way,
        CROSS | {"swings": 2.0},
        {
            "v": [*not_an_array(1.0), 0, [1, -1], np.nan],
            "swings": NOT_NONNEGATIVE,
            "bump": [suspension.GaussianBump(centre=x) for x in (-10, -1)],
        },
        NO_CROSSING,
    ),
    *(
        Row(
            "natural_units",
            lambda name, value: similarity.natural_units(
                similarity.Groups(1.0, 0.1, 3.0, 1.0, 4.0)._replace(**{name: value})
            ),
            {"name": name, "value": 2.0},
            {"value": bad},
            also=(name, "height"),
        )
        for name, bad in [
            ("nu", NOT_POSITIVE),
            ("j", [*NOT_POSITIVE, 1e308]),
            ("lam", [*NOT_POSITIVE, 1e200, 1e-200]),
            ("zeta", NOT_NONNEGATIVE),
            ("eta", NOT_A_NUMBER),
        ]
    ),
    Row("follow", similarity.follow, {"nu": 1.0, "j": 1.0}, {"nu": [0, "1"], "j": NOT_POSITIVE}),
    Row("throw", similarity.throw, {"nu": 1.0}, {"nu": [*not_an_array(1.0), 0, -1, np.inf]}),
    *(
        Row(
            function.__name__,
            function,
            {"nu": 1.0, "zeta": 0.1},
            {"nu": [0, "1", *high], "zeta": [*NOT_POSITIVE, *high]},
        )
        for function, high in ((similarity.skim, []), (similarity.still, [1e200, 1e300]))
    ),
    Row(
        "comb",
        similarity.comb,
        {"nu": 1.0, "j": 1.0, "lam": 3.0},
        {"nu": [0, "1"], "j": NOT_POSITIVE, "lam": NOT_POSITIVE},
    ),
    *(
        Row(
            function.__name__,
            function,
            {name: 0.1},
            {name: [*NOT_POSITIVE, 1e-300, 1e-150, 1e150, 1e300]},
        )
        for function, name in (
            (similarity.window_limit, "zeta"),
            (similarity.closing_limit, "eta"),
        )
    ),
    *(
        Row(
            function.__name__,
            function,
            {"robot": ROBOT, "bump": BUMP, "vmin": 6.0, "vmax": 20.0, "distance": 1.0},
            {
                "vmin": [*NOT_POSITIVE, 20, 21],
                "vmax": [*NOT_POSITIVE, 6, 0.1],
                "distance": but(NOT_POSITIVE, None, Thing, len),
            },
            NO_CROSSING,
        )
        for function in (similarity.window, similarity.closing)
    ),
    Row(
        "travel",
        travel.travel,
        CROSS | {"samples": 11},
        {"v": NOT_POSITIVE, "samples": [*NOT_WHOLE, 10**12]},
        NO_CROSSING,
    ),
    Row(
        "moments",
        travel.moments,
        {"flight": FLIGHT, "robot": ROBOT, "bump": BUMP, "distance": 1.0},
        {"bump": UNDER_A_WHEEL, "distance": but(NOT_POSITIVE, None)},
        {"flight": [*NOT_AN_OBJECT, flight.Flight, ROBOT, len], **NO_CROSSING},
    ),
    Row(
        "load_spring_data",
        springs.load_spring_data,
        {"path": ROOT / "data" / "spring_data.csv"},
        {
            "path": [
                *but(NOT_A_NUMBER, None),
                *("nowhere.csv", "nowhere.mat", "nowhere", "\0", "x" * 300, 0, -1, True),
                *(ROOT, ROOT / "data", ROOT / "README.md", ROOT / "pyproject.toml"),
            ]
        },
        also=("README.md", "pyproject.toml"),
    ),
    Row(
        "SpringFit.power",
        FIT.power,
        {"beta0": 0.1, "beta2": 0.5, "level": 0.95},
        {
            "beta0": [*not_an_array(0.1), np.nan, np.inf],
            "beta2": [*not_an_array(0.5), np.nan, -np.inf],
            "level": [*NOT_A_NUMBER, 0, 1, 95, -0.5],
        },
    ),
    Row(
        "SpringFit.band",
        FIT.band,
        {"x": np.array([0.0, 0.5]), "level": 0.95},
        {
            "x": [*not_an_array(np.zeros(2)), 0.5, np.eye(2), [np.nan]],
            "level": [*NOT_A_NUMBER, 0, 1, 95],
        },
    ),
    Row(
        "spring_law.SpringLaw",
        spring_law.SpringLaw,
        {"beta0": 0.1, "beta1": 13.0, "beta2": -0.5, "delta_max": 0.0165, "stop": 8000.0},
        {
            "beta0": [*not_an_array(0.1), np.nan, np.inf, [np.nan, 0.0]],
            "beta1": [*not_an_array(13.0), np.nan, np.inf, 0.0, -1.0, [13.0, 0.0]],
            "beta2": [*not_an_array(-0.5), np.nan, -np.inf, -6.5, -10.0, [0.0, -7.0]],
            "delta_max": NOT_POSITIVE,
            "stop": [*not_an_array(8000.0), np.nan, np.inf, -1.0, [1.0, -1.0]],
        },
    ),
    Row(
        "SpringLaw.of",
        spring_law.SpringLaw.of,
        {"fit": FIT, "stop": 8000.0},
        {"stop": [*not_an_array(8000.0), np.nan, np.inf, -1.0]},
        {"fit": NOT_A_FIT},
    ),
    Row(
        "spring_law.rest",
        spring_law.rest,
        {"robot": ROBOT, "law": LAW},
        {},
        {"robot": NOT_A_ROBOT, "law": NOT_A_LAW},
    ),
    Row(
        "linearised",
        spring_law.linearised,
        {"robot": ROBOT, "law": LAW, "w": np.zeros(4)},
        {"law": [TWO_LAWS], "w": but(not_like(np.zeros(4)), None)},
        {"robot": NOT_A_ROBOT, "law": NOT_A_LAW},
    ),
    Row(
        "make_measured_gfunc",
        lambda robot, law, road: spring_law.make_measured_gfunc(robot, law, road)(T[:4], 0.1, 1.0),
        {"robot": ROBOT, "law": LAW, "road": BUMP},
        {"law": [TWO_LAWS], "road": NO_ROADS},
        {"robot": NOT_A_ROBOT, "law": NOT_A_LAW, "road": NOT_AN_OBJECT},
    ),
    Row(
        "zero_speeds",
        measured.zero_speeds,
        {"robot": ROBOT, "law": LAW, "road": BUMP, "v": [20.0, 25.0], "zooms": 0},
        {
            "law": [TWO_LAWS],
            "v": [*not_an_array([1.0, 2.0]), 1.0, [1.0], [2, 1], [0, 1], [1, np.nan]],
            "zooms": [*NOT_NONNEGATIVE, 0.5, 18, 10**6],
            "robot": SEVERAL_ROBOTS,
        },
        {"robot": but(NOT_A_ROBOT, NOT_AN_OBJECT[9]), "law": NOT_A_LAW},
    ),
    Row(
        "zero_stops",
        measured.zero_stops,
        {"robot": ROBOT, "law": LAW, "road": BUMP, "v": 20.0, "stops": [5e2, 1e3], "zooms": 0},
        {
            "law": [TWO_LAWS],
            "v": [*NOT_POSITIVE, 1e-300],
            "stops": [*not_an_array([1.0, 2.0]), 1.0, [1.0], [2, 1], [0, 1], [1, np.nan]],
            "zooms": [*NOT_NONNEGATIVE, 0.5],
            "robot": SEVERAL_ROBOTS,
        },
        {"robot": but(NOT_A_ROBOT, NOT_AN_OBJECT[9]), "law": NOT_A_LAW},
    ),
    Row(
        "follow_speed",
        measured.follow_speed,
        {"robot": ROBOT, "law": TWO_LAWS, "road": BUMP, "v": 20.0},
        {"law": [LAW], "v": [*NOT_POSITIVE, 1e-300], "robot": SEVERAL_ROBOTS},
        {"law": NOT_A_LAW, "road": NOT_AN_OBJECT},
    ),
    Row(
        "follow_speeds",
        measured.follow_speeds,
        {"robot": ROBOT, "law": TWO_LAWS, "road": BUMP, "v": [20.0]},
        {
            "law": [LAW],
            "v": [*not_an_array([1.0, 2.0]), 1.0, [[1.0]], [0, 1], [1e-300]],
            "robot": SEVERAL_ROBOTS,
        },
        {"law": NOT_A_LAW, "road": NOT_AN_OBJECT},
    ),
    Row(
        "surviving",
        measured.surviving,
        {"critical": [[1.0, 2.0], [1.1]]},
        {
            "critical": [
                [bad, [1.0]] for bad in (*not_an_array([1.0, 2.0]), [0.0], [-1.0, 1.0], [np.nan])
            ]
        },
    ),
    Row(
        "joint_draws",
        measured.joint_draws,
        {"fit": FIT, "n": 4, "seed": 1},
        {"n": [*NOT_WHOLE, 1, 3, 100, 2**17, 2**60], "seed": [*NOT_NONNEGATIVE, 0.5]},
        {"fit": NOT_A_FIT},
    ),
    Row(
        "fit_spring",
        springs.fit_spring,
        {"data": DATA, "delta_max": 0.0165},
        {
            "data": [DATA[:0], DATA[:2], DATA * np.nan, DATA.iloc[:, :1], DATA.astype(str)],
            "delta_max": NOT_POSITIVE,
        },
        {"data": NOT_A_TABLE},
        also=springs.COLUMNS,
    ),
    Row(
        "SpringFit.intervals",
        FIT.intervals,
        {"level": 0.9, "method": "bonferroni", "p": 2},
        {
            "level": [*NOT_POSITIVE, 1, 1.0, 2, 95],
            "method": [*NOT_A_NUMBER, "Scheffe", "t", b"scheffe", ["scheffe"]],
            "p": [*NOT_WHOLE, 4, "3", [3]],
        },
    ),
    Row(
        "SpringFit.stiffness_interval",
        FIT.stiffness_interval,
        {"level": 0.9},
        {"level": [*NOT_POSITIVE, 1, 1.0, 2, 95]},
    ),
    Row("Hgauss", course.Hgauss, {"x": T}, {"x": not_an_array(T)}),
    Row(
        "gfunc_linear",
        course.gfunc_linear,
        {"w": np.zeros(4), "t": 0.1, "v": 1.2},
        {"w": not_like(np.zeros(4)), "t": NOT_A_NUMBER, "v": NOT_A_NUMBER},
    ),
    Row(
        "make_gfunc",
        lambda robot, road: course.make_gfunc(robot, road)(np.zeros(4), 0.1, 1.2),
        {"robot": ROBOT, "road": BUMP},
        {"road": NO_ROADS},
        NO_DRIVE,
    ),
    Row(
        "make_forcing",
        lambda robot, road, v: course.make_forcing(robot, road, v)(0.1),
        DRIVE,
        {"road": NO_ROADS, "v": NOT_A_NUMBER},
        NO_DRIVE,
    ),
    Row(
        "course.RK4",
        course.RK4,
        {"gfunc_handle": lambda w, t, v: -w, "w0": [1.0, 2.0], "deltat": 0.1, "tfinal": 1}
        | {"v": None},
        {
            "gfunc_handle": [
                lambda w, t, v: None,
                lambda w, t, v: "ab",
                lambda w, t, v: (np.append(w, 0), 0, 0),
                lambda w, t, v: w * 1j,
                lambda w, t, v: [None, None],
            ],
            "w0": not_finite(np.zeros(2)),
            "deltat": [*NOT_POSITIVE, TOO_MANY_STEPS],
            "tfinal": [*NOT_POSITIVE, 1e300],
        },
        {"gfunc_handle": NOT_AN_OBJECT},
    ),
    Row(
        "course.crank_nicolson",
        course.crank_nicolson,
        {"A": -np.eye(2), "F": lambda t: np.zeros(2), "w0": [1.0, 2.0], "deltat": 0.1}
        | {"tfinal": 1},
        {
            "A": [*not_like(np.eye(2)), np.eye(3), [1.0, 2.0]],
            "F": [
                lambda t: None,
                lambda t: "ab",
                lambda t: np.zeros(3),
                lambda t: np.array([1j, 1j]),
                lambda t: [None, None],
                lambda t: np.array([np.nan, 1]),
            ],
            "w0": not_finite(np.zeros(2)),
            "deltat": [*NOT_POSITIVE, TOO_MANY_STEPS],
            "tfinal": [*NOT_POSITIVE, 1e300],
        },
        {"F": NOT_AN_OBJECT},
    ),
    Row(
        "animate_robot",
        animate_robot,
        {"W": W, "T": T, "v": 1.2, "steps_per_frame": 2, "robot": ROBOT, "road": BUMP},
        {
            "W": not_like(W),
            "T": not_finite(T),
            "v": NOT_A_NUMBER,
            "steps_per_frame": NOT_WHOLE,
            "road": NO_ROADS,
        },
        {"robot": but(NOT_A_ROBOT, None), "road": but(NOT_AN_OBJECT, None)},
    ),
    Row(
        "explore",
        explore,
        DRIVE
        | {
            "dt": 0.01,
            "k": 800,
            "scheme": RK4,
            "time": 0.5,
            "presets": [("slow", {"v": 1})],
            "view": "robot",
            "compact": True,
            "distance": 2,
            "speeds": (0.2, 20),
            "asked": (1, 2),
            "spring_end": 0.01,
        },
        {
            "road": NO_ROADS,
            "v": [*but(NOT_POSITIVE, None), 0.01, 100],
            "distance": but(NOT_POSITIVE, None),
            "spring_end": but(NOT_POSITIVE, None),
            "speeds": [5, "fast", (1, 2, 3), (2, 1), (0, 1), (1, np.nan), [None, 3]],
            "asked": [5, None, "fast", [0], [np.nan], [1, "2"]],
            "dt": [*NOT_POSITIVE, 0.3],
            "k": but(NOT_POSITIVE, None),
            "time": [*but(NOT_NONNEGATIVE, None), 1.1, 100],
            "view": [*NOT_A_NUMBER, "Forces", "all", ["robot"]],
            "compact": [None, "Chart", "yes", 2, ["chart"]],
            "presets": [
                3,
                "slow",
                [3],
                ["slow"],
                [("slow", 3)],
                [("slow", {"v": np.nan})],
                [("a", {}, 1)],
            ],
        },
        NO_DRIVE,
    ),
    Row(
        "Prediction",
        Prediction,
        {"name": "one", "x": (1, 2), "y": (1, 2), "x_name": "speed v", "y_name": "height"},
        {
            axis: [*NEGATIVE, *ZERO, None, "ab", (1,), (1, 2, 3), (2, 1), (0, 1), (1, np.nan)]
            for axis in "xy"
        }
        | {"x_name": ["", " "], "y_name": [""]},
        {"x_name": [None, 3], "y_name": [None]},
    ),
    Row(
        "Workshop",
        Workshop,
        {"robot": ROBOT, "bump": BUMP, "v": 1.2, "dt": 0.02},
        {"v": [*NOT_POSITIVE, 0.1, 11], "dt": [*NOT_POSITIVE, 0.3]},
        {"robot": NOT_A_ROBOT, "bump": NOT_AN_OBJECT},
    ),
    Row(
        "Prediction.answer",
        Prediction("two", (1, 2), (1, 2), "speed v", "height").answer,
        {"x": [1.0, 2.0], "lines": {"follow": [1.0, 2.0]}, "exact": [1.0, np.inf]},
        {
            "x": [*not_finite([1.0, 2.0]), [0, 1], [-1, 1]],
            "lines": [{"follow": line} for line in ([1.0], [-1.0, 1.0], [np.nan, 1.0], "line")],
            "exact": [*not_an_array([1.0, 2.0]), [1.0], [0.0, 1.0], [np.nan, 1.0]],
        },
    ),
    Row(
        "errors_of",
        errors_of,
        {"name": "slopes", "dts": [0.1, 0.05]},
        {
            "name": [*NOT_A_NUMBER, "Slopes"],
            "dts": [
                *not_an_array([0.1, 0.05]),
                0.1,
                [0.0],
                [-0.1],
                [np.nan],
                [0.03],
                [2.0],
                [1e-6],
            ],
        },
    ),
]
# Arguments that are fine one by one, and together would take for ever, or lose all digits.
STIFF, UNEQUAL = suspension.Robot(1e6, 1e6), suspension.Robot(1e-3, 1e6)
EXTREMES = [
    (suspension.margin, CROSS | {"tfinal": 1e5}),
    (suspension.margin, CROSS | {"robot": STIFF, "v": 0.001}),
    (suspension.margin, CROSS | {"robot": UNEQUAL, "v": 0.001}),
    (suspension.margin, CROSS | {"v": 5e-324}),
    (suspension.fly, DRIVE | {"robot": UNEQUAL, "v": 0.001, "tfinal": 1250}),
    (suspension.fly, DRIVE | {"v": 1e12, "tfinal": 1e-12}),
    *(
        (suspension.critical_speeds, {"robot": ROBOT, "bump": bump, "vmin": low, "vmax": high})
        for bump, low, high in [
            (suspension.GaussianBump(sigma=1e-3), 0.1, 30),
            (suspension.GaussianBump(sigma=1e-4), 0.1, 30),
            (suspension.GaussianBump(sigma=1e-9), 0.1, 30),
            (BUMP, 1e-3, 1e3),
        ]
    ),
    *(
        (function, CROSS | {"robot": suspension.Robot(800, 800, **extreme)} | more)
        for function, more in [(suspension.margin, {}), (suspension.over_bump, {"t": T})]
        for extreme in [{"c1": 1e200}, {"c1": 1e10, "c2": 1e10}, {"m": 1e-300}]
    ),
    (suspension.margin, CROSS | {"bump": suspension.GaussianBump(sigma=1e-300)}),
    (suspension.over_bump, CROSS | {"bump": suspension.GaussianBump(sigma=1e-300), "t": T}),
]
CASES = [
    pytest.param(
        row,
        argument,
        TypeError if argument_is_thing else ValueError,
        values,
        id=f"{row.name}-{argument}{'-kind' if argument_is_thing else ''}",
    )
    for row in TABLE
    for argument_is_thing, table in ((False, row.values), (True, row.kinds))
    for argument, values in table.items()
]


class TooLong(BaseException):
    """The function went on for longer than anybody would wait to be told of a mistake."""


@contextmanager
def limits(seconds, gigabytes):
    """Stop what computes longer; let fail what asks for more memory (where the system can)."""

    def stop(*_):
        raise TooLong

    before = signal.signal(signal.SIGPROF, stop)
    memory = resource.getrlimit(resource.RLIMIT_AS)
    if sys.platform == "linux":
        pages = int(open("/proc/self/statm", encoding="utf-8").read().split()[0])
        most = pages * resource.getpagesize() + int(gigabytes * 2**30)
        resource.setrlimit(resource.RLIMIT_AS, (most, memory[1]))
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
        resource.setrlimit(resource.RLIMIT_AS, memory)


def complaint(row, argument, value, expected):
    """What is wrong with how the function takes the bad value, or None."""
    try:
        with limits(SECONDS, GIGABYTES):
            result = row.function(**row.good | {argument: value})
    except expected as error:
        if type(error) is not expected:
            return f"{type(error).__name__}: {str(error)[:100]}"
        if not re.search("|".join(rf"\b{name}\b" for name in (argument, *row.also)), str(error)):
            return f"not named: {str(error)[:120]}"
        if len(str(error)) > 1000:
            return f"a message of {len(str(error))} characters"
        return None
    except TooLong:
        return f"takes more than {SECONDS} s"
    except Exception as error:
        return f"{type(error).__name__}: {str(error)[:100]}"
    return f"accepted: {str(result)[:60]!r}"


@pytest.mark.parametrize("row", TABLE, ids=lambda row: row.name)
def test_the_good_arguments_are_taken(row):
    row.function(**row.good)
    plt.close("all")


@pytest.mark.parametrize("row, argument, expected, values", CASES)
def test_a_bad_value_is_refused_by_name(row, argument, expected, values):
    found = [(value, complaint(row, argument, value, expected)) for value in values]
    plt.close("all")
    wrong = [f"{argument}={short(value)}: {what}" for value, what in found if what]
    assert not wrong, "\n".join([row.name, *wrong])


@pytest.mark.filterwarnings("ignore:overflow")
@pytest.mark.parametrize("function, arguments", EXTREMES)
def test_an_extreme_is_refused_by_name_or_gives_finite_numbers_soon(function, arguments):
    with limits(SECONDS, GIGABYTES):
        try:
            assert np.isfinite(function(**arguments)).all()
        except ValueError as error:
            assert any(re.search(rf"\b{name}\b", str(error)) for name in arguments)


def short(value):
    """A value in a few characters."""
    text = " ".join(repr(value).split())
    return text if len(text) < 60 else text[:57] + "..."


def test_every_function_is_offered_enough():
    for row in TABLE:
        offered = [*row.values.values(), *row.kinds.values()]
        assert sum(map(len, offered)) >= ENOUGH, row.name


def test_every_name_at_the_front_door_is_in_the_table():
    schemes = {"EULER", "BACKWARD_EULER", "CRANK_NICOLSON", "RK4"}
    assert set(suspension.__all__) - schemes - {"__version__"} <= names() | {"FlatRoad"}
    assert set(contact.__all__) - {"WHEEL", "Loss", "Minimum"} <= names()
    assert set(course.__all__) - {"the_robot"} <= names()


def names():
    """The names in the table, without the module before them."""
    return {row.name.rsplit(".")[-1] for row in TABLE}
