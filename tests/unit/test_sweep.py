"""Many runs at once: each is the run that `simulate` makes, and memory stays bounded."""

import tracemalloc

import numpy as np
import pytest

from suspension import sweep as module
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import BACKWARD_EULER, CRANK_NICOLSON, EULER, RK4
from suspension.simulation import simulate
from suspension.sweep import MAX_STEPS, sweep

BUMP = GaussianBump()
ROBOTS = [
    Robot(800, 800),
    Robot(900, 500, c1=1, c2=3, L1=0.09, L2=0.12),
    Robot(300, 2000, c1=0, c2=0, m=2, Izz=0.02),
]


def alone(robot, road, v, steps, distance=1.25, scheme=RK4):
    """Smallest forces of one run, and the largest force in it."""
    dt = distance / (v * steps)
    N = simulate(robot, road, v=v, dt=dt, tfinal=steps * dt, scheme=scheme).N
    assert N.shape == (2, steps + 1)
    return N.min(axis=1), np.abs(N).max()


@pytest.mark.parametrize(
    "scheme", [EULER, BACKWARD_EULER, CRANK_NICOLSON, RK4], ids=lambda scheme: scheme.name
)
@pytest.mark.parametrize("steps", [1, 7, 16, 500, 2000])
def test_every_case_is_a_run_of_simulate(scheme, steps):
    v = np.array([0.25, 1.2, 10])
    N = sweep(np.array(ROBOTS)[:, None], BUMP, v, steps=steps, scheme=scheme)
    assert N.shape == (3, 3, 2)
    for i, j in np.ndindex(3, 3):
        expected, scale = alone(ROBOTS[i], BUMP, v[j], steps, scheme=scheme)
        stable = scheme.is_stable(ROBOTS[i].eigenvalues, 1.25 / (v[j] * steps))
        atol = (1e-12 if stable else 1e-10) * scale  # what grows takes the roundoff along
        np.testing.assert_allclose(N[i, j], expected, rtol=0, atol=atol)


def test_the_batches_do_not_matter(monkeypatch):
    v = np.geomspace(0.1, 10, 23)
    whole = sweep(ROBOTS[1], BUMP, v, steps=300, distance=0.8)
    monkeypatch.setattr(module, "BATCH", 5)
    np.testing.assert_allclose(sweep(ROBOTS[1], BUMP, v, steps=300, distance=0.8), whole, 1e-12)
    expected, _ = alone(ROBOTS[1], BUMP, v[-1], 300, 0.8)
    np.testing.assert_allclose(whole[-1], expected, rtol=1e-12)


def test_robots_and_speeds_broadcast():
    assert sweep(ROBOTS[0], BUMP, 1.2, steps=50).shape == (2,)
    assert sweep(ROBOTS, BUMP, 1.2, steps=50).shape == (3, 2)
    assert sweep(ROBOTS, BUMP, [1, 2, 3], steps=50).shape == (3, 2)
    assert sweep([ROBOTS] * 4, BUMP, [1, 2, 3], steps=50).shape == (4, 3, 2)
    assert sweep(ROBOTS[0], BUMP, [], steps=50).shape == (0, 2)
    pair = sweep(ROBOTS, BUMP, [1, 2, 3], steps=50)
    np.testing.assert_array_equal(pair[2], sweep(ROBOTS[2], BUMP, [3, 3], steps=50)[0])


def test_the_road_is_evaluated_once_per_wheelbase_and_on_the_way_only():
    asked = []

    def road(x):
        asked.append(x)
        return BUMP(x)

    sweep(np.array(ROBOTS)[:, None], road, np.linspace(1, 2, 40), steps=100)
    assert len(asked) == len({(robot.L1, robot.L2) for robot in ROBOTS}) == 2
    x = np.concatenate(asked)
    assert x.min() >= -0.107 - 1e-12 and x.max() <= 1.25 + 0.12 + 1e-12


def test_the_work_space_does_not_grow_with_the_number_of_cases():
    def peak(cases):
        v = np.geomspace(0.1, 10, cases)
        tracemalloc.start()
        sweep(ROBOTS[0], BUMP, v, steps=100)
        high = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return high

    assert peak(4000) < 1.1 * peak(1500)


def test_too_much_work_is_refused_before_it_starts():
    with pytest.raises(ValueError, match="^steps must be at most 100000000 in all cases"):
        sweep(ROBOTS[0], BUMP, np.linspace(1, 2, 1001), steps=MAX_STEPS)


def test_one_unstable_case_does_not_spoil_the_others():
    v = np.array([1e-3, 1.2])  # at 1 mm/s a step takes 6 s
    with np.errstate(all="ignore"):
        N = sweep(ROBOTS[0], BUMP, v, steps=200, scheme=EULER)
    assert not (N[0] > 0).all()
    expected, scale = alone(ROBOTS[0], BUMP, 1.2, 200, scheme=EULER)
    np.testing.assert_allclose(N[1], expected, rtol=0, atol=1e-12 * scale)


@pytest.mark.parametrize(
    "name, value",
    [
        *[("v", value) for value in (0, -1, np.nan, np.inf, "fast", [1, 0], None)],
        *[("steps", value) for value in (0, -1, 1.5, np.nan, None, MAX_STEPS + 1)],
        *[("distance", value) for value in (0, -1, np.nan, np.inf, None)],
        *[("robots", value) for value in (None, 800, [ROBOTS[0], None], ROBOTS * 5)],
        ("road", lambda x: (x, np.full_like(x, np.nan))),
        ("road", lambda x: (0.0, 0.0)),
        ("road", 0),
        ("scheme", "RK4"),
        ("scheme", None),
    ],
)
def test_a_bad_argument_is_refused_by_name(name, value):
    good = {"robots": ROBOTS[0], "road": BUMP, "v": [1, 2, 3, 4], "steps": 10, "distance": 1}
    arguments = good | {name: value}
    robots, road, v = (arguments.pop(key) for key in ("robots", "road", "v"))
    with pytest.raises((ValueError, TypeError), match=f"^{name} must "):
        sweep(robots, road, v, **arguments)
