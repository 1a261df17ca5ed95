"""Your own robot and road: what its page computes is what the package computes."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from node import run_in_node
from scipy.optimize import minimize_scalar

import suspension
from suspension import GaussianBump, Robot, highest_bump, margin, profiles, regimes
from suspension.contact import exact_loss, minima
from suspension.explorer.own import Own
from suspension.explorer.own_facts import (
    WHEELBASES,
    as_product,
    bump_in_pieces,
    limit_products,
    parts_of,
    usual_way,
)
from suspension.problem import DISTANCE
from suspension.profiles import (
    _least,
    highest_multiple,
    profile_loss,
    profile_minima,
    profile_regimes,
    stand_in,
)
from suspension.road import RoadProfile
from suspension.similarity import Groups, follow, groups, skim, throw
from suspension.springs import load_vehicles

pytestmark = pytest.mark.slow  # Node runs beside the package

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
    for (const part of everySpeed(scene.course, facts))
      if (part === "curve") answer.first = scene.critical;
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


def test_a_thorough_search_finds_two_critical_speeds_that_nearly_meet(tmp_path):
    """A bump a little lower than a summit of the curve is lost on either side of it."""
    v = np.geomspace(0.3, 0.7, 400)
    heights = highest_bump(ROBOT, BUMP, v)
    [top] = np.flatnonzero((heights[1:-1] > heights[:-2]) & (heights[1:-1] > heights[2:]))[:1] + 1
    found = minimize_scalar(
        lambda v: -highest_bump(ROBOT, BUMP, v),
        bounds=(v[top - 1], v[top + 1]),
        method="bounded",
        options={"xatol": 1e-9},
    )
    height = -found.fun * (1 - 3e-4)
    state = own().state | {"ground": {"kind": "bump", "height": height, "sigma": BUMP.sigma}}
    [answer] = ask(tmp_path, [state | {"thorough": True}])
    beside = [x for x in answer["critical"] if abs(x / found.x - 1) < 1e-2]
    assert len(beside) == 2 and beside[0] < found.x < beside[1] and np.ptp(beside) < 2e-3
    exact = regimes(ROBOT, GaussianBump(height=height), 0.3, 0.7).critical
    close(beside, exact[np.abs(exact / found.x - 1) < 1e-2])


def test_a_first_look_finds_those_that_are_apart(searched):
    same = 0
    for _, answer in zip(*searched, strict=True):
        first, critical = np.array(answer["first"]), np.array(answer["critical"])
        same += len(first) == len(critical)
        if len(first):
            off = np.abs(first[:, None] / critical - 1).min(axis=1)
            assert off.max() <= PARITY
    assert same > 30


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


def test_the_lines_run_as_they_stand(searched, capsys):
    for n in (0, 1):
        exec(searched[1][n]["python"], {})
        assert "Minimum(wheel=1" in capsys.readouterr().out


# ---- what may be set

PASTE = """
import { readFileSync } from "node:fs";
import { readRoad } from "./page/own_state.js";
const { facts, texts } = JSON.parse(readFileSync("given.json"));
console.log(JSON.stringify(texts.map(([text, units]) => readRoad(text, units, facts))));
"""

GOOD_ROADS = {
    "0, 0\n0.2, 0.02\n0.4, 0": ([0, 0.2, 0.4], [0, 0.02, 0]),
    "x (m), h (m)\n0,0\n1,0.01": ([0, 1], [0, 0.01]),
    "0;0\n0,2;0,02\n": ([0, 0.2], [0, 0.02]),
    "0\t0\r\n1\t1e-2\r\n": ([0, 1], [0, 0.01]),
    "0 0\n0,5 0,01\n1.5   −0.02": ([0, 0.5, 1.5], [0, 0.01, -0.02]),
    "# measured\n\n-1 , 3\n  1, 3.5  \n": ([-1, 1], [3, 3.5]),
}
BAD_ROADS = {
    "": "Too few points: none, and at least 2",
    "x, h": "Too few points: none",
    "0, 0": "Too few points: 1,",
    "0, 0\n1, abc": "Line 2: h must be a number, got “1, abc”",
    "0, 0\nnan, 1": "Line 2: x must be a number",
    "0, 0\n1, NaN": "Line 2: h must be a number",
    "0, 0\n1, inf": "Line 2: h must be a number",
    "0, 0\n1, 1e999": "Line 2: h must be a number",
    "0, 0\n1": "Line 2: two numbers are asked for",
    "0,1,2,5": "Line 1: two numbers are asked for",
    "0, 0\n1, 0\n1, 0.1": "x must increase: line 3 is where line 2 is. Keep one point",
    "0, 0\n\n1, 0\n0.5, 0.1": "x must increase: line 4 lies behind line 3. Sort the points",
    "0, 0\n0.1, 1": "Too steep: a slope of 10 between line 1 and line 2, and at most 3",
    "0, 0\n1e9, 1": "The road is 1000000000 m long, and may be from 0.001 to 10000 m",
    "0, 0\n1000, 20": "The road is 20 m high, and may be at most 10 m",
    "0, 0\n1e-9, 0": "The road is 1e-9 m long",
    "\n".join(f"{n}, 0" for n in range(401)): "Too many points: 401, and at most 400",
    # A mean slope of 2.9, and a steeper curve through the points.
    "0, 0\n1, 0\n2, 2.9\n3, 2.9": "Too steep between two points: a slope of 4.35",
}


def pasted(folder, texts):
    given = {"facts": own().facts, "texts": texts}
    (folder / "given.json").write_text(json.dumps(given), encoding="utf-8")
    return json.loads(run_in_node(folder, PASTE))


def test_a_pasted_road_is_read_as_one_writes_it(tmp_path):
    found = pasted(tmp_path, [(text, [1, 1]) for text in GOOD_ROADS])
    for (x, h), road in zip(GOOD_ROADS.values(), found, strict=True):
        assert (road["x"], road["h"]) == (x, h)
        fresh = Own(ROBOT, BUMP)
        fresh.state = fresh.state | {"ground": {"kind": "points", **road}}
        assert np.allclose(fresh.road.h, np.array(h) - h[0])
    [road] = pasted(tmp_path, [("0, 0\n20, 3", [100, 1000])])
    assert road == {"x": [0, 0.2], "h": [0, 0.003]}


def test_what_is_no_road_is_refused_with_the_reason(tmp_path):
    found = pasted(tmp_path, [(text, [1, 1]) for text in BAD_ROADS])
    for (text, words), answer in zip(BAD_ROADS.items(), found, strict=True):
        assert answer.get("error", "").startswith(words), (text, answer)


@pytest.mark.parametrize("x, h", [([0, 1, 1], [0, 0, 0]), ([0, 1, 0.5], [0, 0, 0]), ([0], [0])])
def test_python_refuses_those_roads_too(x, h):
    with pytest.raises(ValueError, match=r"x must (increase|have two points)"):
        set_to(own().state | {"ground": {"kind": "points", "x": x, "h": h}})


SPOILED = [
    {"robot": {"m": 0}},
    {"robot": {"m": None}},
    {"robot": {"m": "1"}},
    {"robot": {"c1": -1}},
    {"robot": {"L1": 1e3}},
    {"v": 0},
    {"v": "fast"},
    {"v": 1e9},
    {"distance": -1},
    {"ground": {"kind": "bump", "height": -0.01, "sigma": 0.03}},
    {"ground": {"kind": "bump", "height": 0.01}},
    {"ground": {"kind": "hole"}},
    {"ground": {"kind": "points", "x": [0, 1], "h": [0]}},
    {"ground": {"kind": "points", "x": [], "h": []}},
    {"ground": {"kind": "points", "x": [0, "1"], "h": [0, 1]}},
    {"ground": {"kind": "points", "x": [0, 1], "h": [0, 0], "join": "spline"}},
    {"ground": {"kind": "points", "x": [0, 1], "h": [0, 0], "tall": 0}},
]


def spoil(state, change):
    robot = state["robot"] | change.get("robot", {})
    return state | {**change, "robot": robot}


def test_a_spoiled_state_is_none_on_either_side(tmp_path):
    states = [spoil(own().state, change) for change in SPOILED]
    assert all(answer.get("refused") for answer in ask(tmp_path, states))
    for state in states:
        with pytest.raises(ValueError, match="must"):
            set_to(state)
    with pytest.raises(ValueError, match="state must have 'v'"):
        set_to({"robot": {}, "ground": {}})


def test_a_spoiled_address_is_none(tmp_path):
    script = """import { readFileSync } from "node:fs";
    import { readLink, startFrom, writeLink } from "./page/own_state.js";
    const { facts } = JSON.parse(readFileSync("given.json"));
    const good = writeLink(startFrom(0, facts, "mm"));
    const spoiled = ["", "#own:", "#own:m=1", "#workshop:a=1&b=1", good.replace("m=", "m=x"),
      good.replace(/road=[^&]*/, "x=0_1&h=0_<b>"), good.replace("v=1.2", "v=1e99")];
    console.log(JSON.stringify([good, ...spoiled].map((hash) => readLink(hash, facts))));"""
    (tmp_path / "given.json").write_text(json.dumps({"facts": own().facts}), encoding="utf-8")
    good, *spoiled = json.loads(run_in_node(tmp_path, script))
    assert good == own().state and spoiled == [None] * 7


def test_values_change_as_they_are_asked_to(tmp_path):
    script = """import { readFileSync } from "node:fs";
    import * as own from "./page/own_state.js";
    const { facts } = JSON.parse(readFileSync("given.json")), start = own.startFrom(0, facts, "mm"),
      apart = own.withValue({ ...start, alike: false }, "k2", 400),
      points = { kind: "points", x: [1, 2, 4], h: [3, 3.5, 2], tall: 1, long: 1, join: "pchip" },
      drawn = { ...start, ground: points };
    console.log(JSON.stringify({
      both: own.withValue(start, "k2", 400).robot, one: apart.robot, alike: own.makeAlike(apart),
      symmetric: [start, apart].map(own.isSymmetric),
      tall: own.withValue(drawn, "tall", 0.5).ground.tall,
      long: own.withValue(drawn, "long", 6).ground.long,
      numbers: ["tall", "long", "distance"].map((name) => own.numberOf(name, drawn, 7)),
      why: [["m", null], ["m", 0], ["v", 2e3], ["m", 1], ["tall", 9]].map(([name, value]) =>
        own.whyNoValue(name === "tall" ? drawn : { ...start, units: "cm" }, name, value, facts)),
      places: ["m", "c1", "v", "height", "distance"].map((name) => {
        const scale = own.scaleOf(name, start, facts, { usual: 1.25, speeds: [0.1, 25] });
        return [0, 0.3, 1].map((place) => scale.toPlace(scale.toValue(place)));
      }),
      smooth: own.smooth([0, 0, 4, 0, 0]), some: own.smooth([0, 4, 0, 4, 0], [3, 3]),
      ground: own.drawnGround([0.1, 0.12345678, 0.2], 0.3),
    }));"""
    (tmp_path / "given.json").write_text(json.dumps({"facts": own().facts}), encoding="utf-8")
    told = json.loads(run_in_node(tmp_path, script))
    assert (told["both"]["k1"], told["both"]["k2"]) == (400, 400)
    assert (told["one"]["k1"], told["one"]["k2"]) == (800, 400)
    twin = set_to(own().state | {"robot": told["one"]}).robot.twin
    assert told["alike"]["robot"] == {name: getattr(twin, name) for name in told["one"]}
    assert told["symmetric"] == [True, False]
    assert (told["tall"], told["long"]) == (0.5, 2) and told["numbers"] == [1, 3, 7]
    assert told["why"][:4] == [
        "A number, please: 0.001 to 1000000 kg",
        "Out of range: 0.001 to 1000000 kg",
        "Out of range: 0.0036 to 3600 km/h",
        "",
    ]
    assert told["why"][4].startswith("Too steep")
    for places in told["places"]:
        assert places == pytest.approx([0, 0.3, 1])
    assert told["smooth"] == [0, 1, 2, 1, 0] and told["some"] == [0, 4, 0, 2, 0]
    assert told["ground"]["x"] == [0, 0.15, 0.3] and told["ground"]["h"] == [0, 0.123457, 0.2]


# ---- what is handed over


def test_a_bump_in_pieces_is_a_bump():
    bump = bump_in_pieces()
    x = np.linspace(bump["start"], -bump["start"], 20001)[:-1]
    piece = ((x - bump["start"]) / bump["cell"]).astype(int)
    s = x - bump["start"] - piece * bump["cell"]
    rows = np.array(bump["table"])[piece]
    power = np.arange(rows.shape[1])
    height = (rows * s[:, None] ** power).sum(axis=1)
    slope = (rows[:, 1:] * power[1:] * s[:, None] ** power[:-1]).sum(axis=1)
    exact = np.exp(-(x**2) / 2)
    np.testing.assert_allclose(height, exact, rtol=0, atol=1e-14)
    np.testing.assert_allclose(slope, -x * exact, rtol=0, atol=1e-11)


def test_the_robot_s_matrices_are_whole_numbers_times_products():
    parts = parts_of(ROBOT)
    for name, terms in parts.items():
        if name != "e":
            assert {value for term in terms for row in term["matrix"] for value in row} <= {
                -1,
                0,
                1,
            }
    assert parts_of(replace(ROBOT, g=1.62))["e"][0]["matrix"][1] == [-1.62]


def test_what_is_no_product_of_powers_is_refused():
    found = as_product(lambda a, b: 3 * a**2 / np.sqrt(b), ("a", "b"))
    assert found == {"amplitude": pytest.approx(3), "powers": {"a": 2, "b": -0.5}}
    with pytest.raises(ValueError, match="product of powers of a"):
        as_product(lambda a: a + 1, ("a",))


def test_the_limits_are_those_of_similarity():
    G = groups(ROBOT, BUMP, 1.2)
    values = {"nu": G.nu, "zeta": G.zeta, "1 + j": 1 + G.j}
    exact = {"follow": follow(G.nu, G.j), "throw": throw(G.nu), "skim": skim(G.nu, G.zeta)}
    for limit in limit_products():
        told = limit["amplitude"]
        for name, power in limit["powers"].items():
            told *= values[name] ** power
        assert told == pytest.approx(exact[limit["name"]], rel=1e-12)


def test_vehicles_are_published_ones_and_can_be_driven(tmp_path):
    vehicles = own().facts["vehicles"]
    assert [vehicle["name"].split(",")[0] for vehicle in vehicles[1:]] == list(WHEELBASES)
    published = load_vehicles().set_index("vehicle")
    for vehicle in vehicles[1:]:
        car = published.loc[vehicle["name"].split(",")[0]]
        assert vehicle["robot"]["k1"] == car.stiffness and car.cited_as in vehicle["note"]
        assert vehicle["robot"]["m"] == 2 * car.mass
    states = [
        {"robot": one["robot"], "ground": {"kind": "bump", **one["bump"]}, "v": one["v"]}
        for one in vehicles
    ]
    for state, answer in zip(states, ask(tmp_path, states), strict=True):
        least, _, _ = package(set_to(state))
        close([one["force"] for one in answer["least"]], [one.force for one in least], 1e4)
        if state is not states[0]:
            assert answer["groups"]["j"] == pytest.approx(1, rel=1e-3)


def test_the_problem_s_robot_goes_as_far_as_the_problem_says(asked):
    assert usual_way(ROBOT, BUMP) == DISTANCE
    level = RoadProfile([0.2, 0.7], [0, 0])
    assert usual_way(ROBOT, level) > 0.7 + ROBOT.L1


def test_a_page_gets_a_still_picture_and_all_that_its_script_needs():
    html = own().html()
    assert html.startswith('<div class="suspension-laboratory se-own">')
    assert 'alt="The highest bump that is crossed with contact at every speed' in html
    assert "the front wheel leaves the ground" in html
    assert "contact is kept" in Own(ROBOT, BUMP, v=10).alt
    state = json.loads(html.split('class="se-state">')[1].split("</script>")[0])
    assert state["state"] == own().state and len(html) < 120_000


def test_an_unsymmetric_robot_has_a_still_picture_in_its_own_units():
    lopsided = Own(Robot(700, 900), BUMP)
    assert not lopsided.state["alike"]
    drawn = lopsided._draw()
    assert drawn != own()._draw() and "<svg" in drawn


@pytest.mark.parametrize(
    "arguments, words",
    [
        ((1, BUMP), "robot must"),
        ((ROBOT, 1), "bump must"),
        ((ROBOT, BUMP, 0), "v must be a number from 0.001 to 1000"),
        ((ROBOT, GaussianBump(centre=0.1)), "bump must begin ahead"),
        ((ROBOT, GaussianBump(height=-0.01)), "height must be a number from 1e-05 to 10"),
        ((replace(ROBOT, g=0), BUMP), "robot must have a weight"),
        ((replace(ROBOT, m=1e-9), BUMP), "m must be a number from 0.001"),
    ],
)
def test_what_cannot_be_is_refused_by_name(arguments, words):
    with pytest.raises((TypeError, ValueError), match=words):
        Own(*arguments)


# ---- in words

WORDS = """
import { readFileSync } from "node:fs";
import { everySpeed, makeScene } from "./page/own_scene.js";
import { readState } from "./page/own_state.js";
import * as words from "./page/own_words.js";

const { facts, states } = JSON.parse(readFileSync("given.json"));
console.log(JSON.stringify(states.map((raw) => {
  const scene = makeScene(facts, readState(raw, facts)), looking = words.tellSpeeds(scene);
  for (const _ of everySpeed(scene.course, facts));
  return {
    verdict: words.tellVerdict(scene), wheels: words.wheelRows(scene), looking,
    speeds: words.tellSpeeds(scene), chart: words.tellChart(scene, facts),
    alike: words.tellStandIn(scene), groups: words.groupRows(scene),
    modes: words.tellModes(scene), way: words.tellWay(scene),
  };
})));
"""


def points(x, h, **more):
    return {"kind": "points", "x": x, "h": h, **more}


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    """What the page says of typical states, by name."""
    start, folder = own().state, tmp_path_factory.mktemp("words")

    def robot(**changes):
        return {"robot": start["robot"] | changes}

    hump = points([0, 0.1, 0.2, 0.3], [0, 0.02, 0.02, 0])
    changes = {
        "lost": {},
        "kept": {"v": 10},
        "km/h": {"v": 10, "units": "cm"},
        "everywhere": {"ground": {"kind": "bump", "height": 1e-4, "sigma": 0.1}},
        "nowhere": {"ground": points([0, 0.1, 0.2], [0, 0.3, 0], join="linear")},
        "level": {"ground": points([0, 0.3], [0.01, 0.01])},
        "slow": {"v": 1e-3, "distance": 3e4},
        "short": {"distance": 0.3},
        "far": {"distance": 2.0},
        "hump": {"ground": hump},
        "hole": {"ground": points(hump["x"], [-h for h in hump["h"]])},
        "apart": robot(k2=500),
        "apart on a hump": robot(k2=500) | {"ground": hump},
        "undamped": robot(c1=0, c2=0),
        "overdamped": robot(c1=90, c2=90),
        "climbing": {"v": 200, "distance": 0.1},
    }
    states = [{"distance": None} | start | change for change in changes.values()]
    (folder / "given.json").write_text(
        json.dumps({"facts": own().facts, "states": states}), encoding="utf-8"
    )
    answers = json.loads(run_in_node(folder, WORDS).replace("\\u00a0", " ").replace("\u00a0", " "))
    return dict(zip(changes, answers, strict=True))


def test_the_verdict_says_wheel_and_place_and_no_tenths_after_a_loss(told):
    assert told["lost"]["verdict"] == {
        "tone": "lost",
        "words": "Contact is lost at 1.2 m/s: first the front wheel lifts, at X = 0.212 m, after "
        "0.177 s. Until then the rear wheel presses with 7.14 N or more.",
    }
    kept = told["kept"]["verdict"]
    assert kept["tone"] == "kept"
    assert kept["words"].startswith("Contact is kept at 10 m/s. The least force is 1.67 N, 23 %")
    assert told["km/h"]["verdict"]["words"].startswith("Contact is kept at 36 km/h.")
    assert told["level"]["verdict"]["words"].startswith("The road is level: contact is kept")
    slow = told["slow"]
    assert (
        slow["verdict"]["tone"] == "doubt" and "Drive faster, shorten" in slow["verdict"]["words"]
    )
    assert slow["wheels"] == [] and slow["chart"] == ""
    assert not any("−" in cell for row in told["lost"]["wheels"] for cell in row)
    assert told["lost"]["wheels"][1] == ["front", "7.14 N", "lifts", "0.212 m"]
    assert told["kept"]["wheels"][0][2] in ("1.67 N", kept["words"].split("is ")[2][:6])


def test_the_ranges_of_speed_are_told_for_each_case(told):
    assert told["lost"]["looking"] == "From 0.095 to 25 m/s: looking …"
    assert told["lost"]["speeds"] == (
        "From 0.095 to 25 m/s contact is kept below 0.4367 m/s and from 7.946 to 20.42 m/s, and "
        "lost elsewhere."
    )
    assert "below 1.572 km/h and from 28.6 to 73.52 km/h" in told["km/h"]["speeds"]
    assert told["everywhere"]["speeds"].endswith("contact is kept at every speed.")
    assert told["nowhere"]["speeds"].endswith("contact is lost at every speed.")
    assert told["level"]["speeds"] == ""


def test_the_chart_is_read_for_each_case(told):
    assert told["lost"]["chart"] == (
        "The vehicle stands at ν = 1.26, η = 2.85: above its curve. Here the bump may be 5.6 mm "
        "high, 0.221 times what it is. The nearest limit by hand is “follow”, 17 % above it."
    )
    assert ": below its curve." in told["kept"]["chart"]
    assert "the road may be" in told["hump"]["chart"]
    assert "the hole may be" in told["hole"]["chart"] and "deep" in told["hole"]["chart"]
    assert "draw one, paste one" in told["level"]["chart"]
    assert "“Both axles alike” makes the symmetric robot" in told["apart"]["chart"]
    assert "Here no height of the bump lifts a wheel." in told["climbing"]["chart"]


def test_what_stands_in_for_a_road_is_told(told):
    assert told["lost"]["alike"].startswith("Draw on the road")
    assert told["hump"]["alike"].startswith("ν and λ are those of a bump 20 mm high and as steep")
    assert "a hole 20 mm deep" in told["hole"]["alike"] and "has none" in told["hole"]["alike"]
    assert told["apart on a hump"]["alike"].startswith("Alike is a bump 20 mm high")


def test_groups_modes_and_way_are_told(told):
    assert [row[0] for row in told["lost"]["groups"]] == ["ν", "ζ", "η", "j", "λ"]
    assert told["apart"]["groups"] == []
    assert told["lost"]["modes"].startswith("It swings at 5.28 Hz (0.0311 of the critical damping)")
    assert "(no damping)" in told["undamped"]["modes"]
    assert "comes back without a swing in" in told["overdamped"]["modes"]
    assert "and tilts by" in told["apart"]["modes"] and "tilts" not in told["lost"]["modes"]
    assert told["lost"]["way"] == "Usual for this road: 1.25 m."
    assert told["far"]["way"] == "Usual for this road would be 1.25 m."
    assert told["short"]["way"].startswith("The way ends before both wheels have left the road")
