"""Published vehicles on the chart, held against the same vehicles in metres and newtons."""

import numpy as np
import pytest
from scipy.integrate import quad

from suspension.contact import regimes
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.similarity import highest_bump
from suspension.springs import load_vehicles
from suspension.vehicles import BASE, as_bump, passage

VEHICLES = [pytest.param(one, id=one.vehicle) for one in load_vehicles().itertuples()]


def in_metres(vehicle):
    """Both axles loaded alike, and the bump far enough ahead; the way a run needs."""
    bump = as_bump(vehicle.height, vehicle.length)
    L, m = BASE * bump.sigma, 2 * vehicle.mass
    robot = Robot(
        *[vehicle.stiffness] * 2,
        **{"m": m, "Izz": m * L**2, "L1": L, "L2": L, "c1": vehicle.damping, "c2": vehicle.damping},
    )
    swing = 2 * np.pi * np.sqrt(vehicle.mass / vehicle.stiffness)
    far = 25 * bump.sigma + 10 * swing * vehicle.fast / 3.6
    return robot, GaussianBump(bump.height, bump.sigma, L + 8 * bump.sigma), far


@pytest.mark.slow
@pytest.mark.parametrize("vehicle", VEHICLES)
def test_contact_is_that_of_the_vehicle_in_metres(vehicle):
    robot, bump, far = in_metres(vehicle)
    found = passage(vehicle).contact
    ours = regimes(robot, bump, vehicle.slow / 3.6, vehicle.fast / 3.6, distance=far)
    assert found.edges == pytest.approx(3.6 * ours.edges, rel=1e-6)
    assert list(found.lost) == list(ours.lost) and found.unit == "km/h"


@pytest.mark.slow
@pytest.mark.parametrize("vehicle", VEHICLES)
def test_its_numbers_are_those_of_a_mass_on_a_spring(vehicle):
    robot, bump, far = in_metres(vehicle)
    found = passage(vehicle)
    assert found.sag == pytest.approx(-robot.equilibrium[0], rel=1e-12)
    heave = min(robot.eigenvalues, key=abs)
    assert 2 * np.pi * found.frequency == pytest.approx(abs(heave), rel=1e-9)
    assert found.zeta == pytest.approx(-heave.real / abs(heave), rel=1e-9)
    v = np.geomspace(vehicle.slow, vehicle.fast, 12) / 3.6
    if not found.rises:
        assert (np.diff(highest_bump(robot, bump, v, distance=far)) < 0).all()


@pytest.mark.slow
def test_a_heavy_wheel_is_lifted_where_its_own_weight_and_spring_cannot_hold_it():
    for vehicle in load_vehicles().itertuples():
        bump, found = as_bump(vehicle.height, vehicle.length), passage(vehicle)
        if np.isnan(vehicle.unsprung):
            assert np.isnan(found.heavy)
            continue
        v = found.heavy / 3.6
        down = (vehicle.mass + vehicle.unsprung) * 9.81 + vehicle.stiffness * bump.height
        # On the top of the bump the road falls away with v^2 height / sigma^2.
        assert vehicle.unsprung * v**2 * bump.height / bump.sigma**2 == pytest.approx(
            down, rel=1e-9
        )


def test_the_bump_has_height_and_area_of_a_parabola():
    bump = as_bump(0.1, 3.7)
    area = quad(lambda x: bump(np.array([x]))[0][0], bump.centre - 9, bump.centre + 9)[0]
    parabola = quad(lambda x: 0.1 * (1 - (2 * x / 3.7) ** 2), -3.7 / 2, 3.7 / 2)[0]
    assert bump.height == 0.1 and area == pytest.approx(parabola, rel=1e-9)


def test_a_length_that_cannot_be_is_refused_by_name():
    with pytest.raises(ValueError, match="^length must be"):
        as_bump(0.1, 0)
