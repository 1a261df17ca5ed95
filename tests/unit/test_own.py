"""Your own robot and road: what its page computes is what the package computes."""

import json
from functools import cache

import numpy as np
import pytest
from node import run_in_node

import suspension
from suspension import GaussianBump, Robot, highest_bump, margin, profiles, regimes
from suspension.contact import exact_loss, minima
from suspension.explorer.own import Own
from suspension.profiles import (
    _least,
    highest_multiple,
    profile_loss,
    profile_minima,
    profile_regimes,
    stand_in,
)
from suspension.similarity import Groups, groups

ROBOT, BUMP = Robot(800, 800), GaussianBump()
CASES = 60
PARITY = 1e-9

ASK = """
import { readFileSync } from "node:fs";
import { everySpeed, makeScene } from "./page/own_scene.js";
import { pythonOf, readLink, readState, writeLink } from "./page/own_state.js";

const { facts, states } = JSON.parse(readFileSync("given.json"));
const answers = states.map(({ thorough, ...raw }) => {
  const state = readState(raw, facts);
  if (!state) return { refused: true };
  const scene = makeScene(facts, state),
    told = ["least", "lost", "until", "groups", "shape", "distance", "speeds", "usual", "unit"],
    answer = Object.fromEntries(told.map((name) => [name, scene[name]]));
  answer.multiple = String(scene.multiple);
  answer.modes = scene.vehicle.modes;
  answer.load = scene.vehicle.load;
  answer.equilibrium = scene.vehicle.equilibrium;
  answer.python = pythonOf(state, facts, scene);
  answer.linked = JSON.stringify(readLink(writeLink(state), facts)) === JSON.stringify(state);
  if (thorough) {
    const start = performance.now();
    for (const _ of everySpeed(scene, facts));
    answer.seconds = (performance.now() - start) / 1000;
    answer.critical = scene.critical;
    answer.kept = scene.kept;
    answer.curve = { v: scene.curve.v, multiple: scene.curve.multiple.map(String) };
  }
  return answer;
});
console.log(JSON.stringify(answers));
"""


@cache
def own():
    return Own(ROBOT, BUMP)


def ask(folder, states, facts=None):
    """What the page finds for each of the states."""
    given = {"facts": facts or own().facts, "states": states}
    (folder / "given.json").write_text(json.dumps(given), encoding="utf-8")
    return json.loads(run_in_node(folder, ASK))


def random_states(rng, count=CASES, most=60):
    """Robots and roads of many kinds: alike and not, without dampers and with strong ones."""

    def log(low, high):
        return float(f"{low * (high / low) ** rng.uniform():.4g}")

    for n in range(count):
        robot = {"m": log(0.4, 6), "Izz": log(0.004, 0.05)}
        robot |= {name: log(0.05, 0.2) for name in ("L1", "L2")}
        robot |= {name: log(200, 3000) for name in ("k1", "k2")}
        robot |= {name: log(0.2, 60) if n % 9 else 0.0 for name in ("c1", "c2")}
        if n % 2:
            robot |= {
                pair[1]: robot[pair[0]] for pair in (("L1", "L2"), ("k1", "k2"), ("c1", "c2"))
            }
        if n % 3 == 0:
            ground = {"kind": "bump", "height": log(0.003, 0.06), "sigma": log(0.01, 0.1)}
        else:
            points = int(rng.integers(2, most))
            x = np.cumsum(rng.uniform(0.01, 0.05, points)) - 0.3
            h = rng.normal(0, 0.004, points) + 0.02
            ground = {"kind": "points", "x": x.round(5).tolist(), "h": h.round(6).tolist()}
            ground |= {
                "join": ("pchip", "linear")[n % 3 - 1],
                "tall": log(0.3, 1),
                "long": log(1, 2),
            }
        distance = None if n % 4 else log(1, 3)
        yield {"robot": robot, "ground": ground, "v": log(0.15, 20), "distance": distance}


@pytest.fixture(scope="module")
def asked(tmp_path_factory):
    states = list(random_states(np.random.default_rng(22)))
    return states, ask(tmp_path_factory.mktemp("node"), states)


def close(got, expected, size=None):
    """Whether numbers agree to a part in 10^9 of a size, their own if none is given."""
    got, expected = np.asarray(got, float), np.asarray(expected, float)
    assert got.shape == expected.shape
    size = np.abs(expected) if size is None else size
    assert np.all(np.abs(got - expected) <= PARITY * size), (got, expected)


def set_to(state):
    """What Python makes of a state."""
    fresh = Own(ROBOT, BUMP)
    fresh.state = state
    return fresh


def package(own):
    """Least forces, first loss and highest multiple, as the package tells them."""
    robot, road, v, way = own.robot, own.road, own.v, {"distance": own.distance}
    if isinstance(road, GaussianBump):
        multiple = highest_bump(robot, road, v, **way) / road.height
        return minima(robot, road, v, **way), exact_loss(robot, road, v, **way), multiple
    multiple = highest_multiple(robot, road, v, **way)
    return profile_minima(robot, road, v, **way), profile_loss(robot, road, v, **way), multiple


def until(own, loss):
    """The least force of each wheel up to the first loss."""
    if isinstance(own.road, GaussianBump):
        found = minima(own.robot, own.road, own.v, loss.t)
    else:
        found = profile_minima(own.robot, own.road, own.v, distance=own.v * loss.t)
    return [minimum.force for minimum in found]


def test_margins_losses_and_heights_are_the_package_s(asked):
    lost = 0
    for state, answer in zip(*asked, strict=True):
        own = set_to(state)
        assert answer["distance"] == own.distance
        least, loss, multiple = package(own)
        load = (own.robot.C @ own.robot.equilibrium).max()
        for mine, exact in zip(answer["least"], least, strict=True):
            close(mine["force"], exact.force, max(load, abs(exact.force)))
        assert (answer["lost"] is None) == (loss is None)
        if loss:
            lost += 1
            assert answer["lost"]["wheel"] + 1 == loss.wheel
            close(answer["lost"]["X"], own.v * loss.t)
            forces = [wheel["force"] for wheel in answer["until"]]
            close(forces, until(own, loss), load)
        close(float(answer["multiple"].replace("Infinity", "inf")), multiple)
    assert 0.2 * CASES < lost < 0.9 * CASES


def test_rest_and_modes_are_the_robot_s(asked):
    for state, answer in zip(*asked, strict=True):
        robot = set_to(state).robot
        close(answer["load"], robot.C @ robot.equilibrium)
        close(answer["equilibrium"], robot.equilibrium, np.abs(robot.equilibrium).max())
        mine = np.array([complex(*mode) for mode in answer["modes"]])
        for mode in robot.eigenvalues:
            assert np.abs(mine - mode).min() <= PARITY * np.abs(mode)


def test_groups_and_scales_are_those_of_similarity(asked):
    symmetric = 0
    for state, answer in zip(*asked, strict=True):
        own = set_to(state)
        bump = own.road if isinstance(own.road, GaussianBump) else stand_in(own.road)
        close([answer["shape"]["height"], answer["shape"]["sigma"]], [bump.height, bump.sigma])
        twin = groups(own.robot.twin, bump, own.v)
        close(
            [answer["unit"]["v"], answer["unit"]["sag"]], [own.v / twin.nu, bump.height / twin.eta]
        )
        assert (answer["groups"] is not None) == (own.robot == own.robot.twin)
        if answer["groups"]:
            symmetric += 1
            close([answer["groups"][name] for name in Groups._fields], twin)
    assert 0.3 * CASES < symmetric < 0.7 * CASES


def test_an_address_brings_back_the_very_state(asked):
    assert all(answer["linked"] for answer in asked[1])


@pytest.fixture(scope="module")
def searched(tmp_path_factory):
    """States whose critical speeds the page has looked for thoroughly."""
    states = list(random_states(np.random.default_rng(7), 44, 12))
    answers = ask(tmp_path_factory.mktemp("search"), [{**one, "thorough": True} for one in states])
    print(f"slowest search {max(answer['seconds'] for answer in answers):.2f} s")
    return states, answers


def margins(own, v):
    """The package's margin at many speeds."""
    way = {"distance": own.distance}
    if isinstance(own.road, GaussianBump):
        return np.array([margin(own.robot, own.road, one, **way) for one in v])
    return _least(own.robot, own.road, v, own.distance).min(axis=0)


@pytest.mark.slow
def test_critical_speeds_are_where_the_package_s_margin_changes_its_sign(searched):
    """Each is found to 1e-9, and between 300 others there is none."""
    count = 0
    for state, answer in zip(*searched, strict=True):
        own, critical = set_to(state), np.array(answer["critical"])
        count += len(critical)
        beside = np.concatenate([critical * (1 - PARITY), critical * (1 + PARITY)])
        if len(critical):
            before, after = np.split(margins(own, beside), 2)
            assert np.all(before * after < 0)
        v = np.geomspace(*answer["speeds"], 300)
        kept = (np.searchsorted(critical, v) % 2 == 0) == answer["kept"]
        assert np.array_equal(kept, margins(own, v) > 0)
    assert count > 44


@pytest.mark.slow
def test_a_thorough_search_finds_what_the_package_s_does(searched):
    for kind, most in (("bump", 4), ("points", 3)):
        found = [pair for pair in zip(*searched, strict=True) if pair[0]["ground"]["kind"] == kind]
        for state, answer in found[:most]:
            own = set_to(state)
            search = regimes if kind == "bump" else profile_regimes
            exact = search(own.robot, own.road, *answer["speeds"], distance=own.distance)
            close(answer["critical"], exact.critical)
            assert answer["kept"] == (not exact.lost[0])


def test_the_curve_is_that_of_the_highest_bump_or_multiple(searched):
    for state, answer in zip(*searched, strict=True):
        own, curve = set_to(state), answer["curve"]
        v = np.array(curve["v"])[::9]
        mine = np.array([float(x.replace("Infinity", "inf")) for x in curve["multiple"]])[::9]
        if isinstance(own.road, GaussianBump):
            exact = highest_bump(own.robot, own.road, v, distance=own.distance) / own.road.height
        else:
            exact = highest_multiple(own.robot, own.road, v, distance=own.distance)
        finite = np.isfinite(exact)
        assert np.array_equal(np.isfinite(mine), finite)
        close(mine[finite], exact[finite])


def test_the_lines_one_takes_away_give_the_same_numbers(asked, monkeypatch):
    """Every line runs; but for the search, whose answer two other tests compare."""
    asked_for = []
    for module in (suspension, profiles):
        name = "regimes" if module is suspension else "profile_regimes"
        monkeypatch.setattr(module, name, lambda *x, **way: asked_for.append((x[2:], way)))
    for state, answer in zip(*asked, strict=True):
        own, names = set_to(state), {}
        exec(answer["python"], names)
        assert names["robot"] == own.robot and names["road"] == own.road
        assert asked_for.pop() == (tuple(answer["speeds"]), {"distance": own.distance})
        load = max(answer["load"])
        for mine, exact in zip(answer["least"], names["least"], strict=True):
            close(mine["force"], exact.force, max(load, abs(exact.force)))
        assert (answer["lost"] is None) == (names["loss"] is None)
        if names["loss"]:
            close(answer["lost"]["X"], own.v * names["loss"].t)
        is_bump = isinstance(own.road, GaussianBump)
        highest = names["highest"] / (own.road.height if is_bump else 1)
        close(float(answer["multiple"].replace("Infinity", "inf")), highest)
        if answer["groups"]:
            close([answer["groups"][name] for name in Groups._fields], names["numbers"])


@pytest.mark.slow
def test_the_lines_run_as_they_stand(searched, capsys):
    for n in (0, 1):
        exec(searched[1][n]["python"], {})
        assert "Minimum(wheel=1" in capsys.readouterr().out
