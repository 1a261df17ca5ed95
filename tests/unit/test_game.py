"""Keep it down: what its page says of an attempt and lets one hear is what Python computes."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from cases import STIFFNESSES
from helpers import PARITY, near
from node import run_in_node

from suspension import GaussianBump, Robot, fly, margin
from suspension.choice import cheapest, fitted_with
from suspension.contact import exact_loss
from suspension.explorer import Game
from suspension.explorer.game import air, goal_on, unknown_roads
from suspension.problem import DISTANCE, SPEEDS

pytestmark = pytest.mark.slow  # Node runs beside the package

ROBOT, BUMP = Robot(800, 800), GaussianBump()
K, C = np.geomspace(100, 3200, 13), np.geomspace(0.3, 15, 13)
LOAD = ROBOT.m * ROBOT.g / 2
RNG = np.random.default_rng

# Reads given.json: the facts, and of many attempts [level, k, c] what the page finds.
ASK = """
import { readFileSync } from "node:fs";
import { makeTrack } from "./page/game_run.js";
import { score } from "./page/sound.js";

const { facts, attempts, heard } = JSON.parse(readFileSync("given.json"));
const track = makeTrack(facts);
for (const [level, k, c] of attempts) {
  const { lanes, ...found } = track.drive(level, k, c);
  const scores = heard && lanes.map((lane) => score(lane));
  const events = heard && lanes.map((lane) => lane.flight.events);
  const told = lanes.map(({ v, margin, wheel, X, lost, air, state }) =>
    ({ v, margin, wheel, X, lost, air, state }));
  const sketch = track.sketch(level, k, c);
  console.log(JSON.stringify({ ...found, lanes: told, sketch, scores, events }));
}
"""


@cache
def game():
    return Game(ROBOT, BUMP, SPEEDS, K, C)


@cache
def small():
    """Two speeds, and a coarse grid."""
    return Game(ROBOT, BUMP, [1.2, 5], K[::4], C[::4])


def ask(folder, facts, attempts, heard=False):
    """What the page finds of attempts: level, stiffness, damping."""
    given = {"facts": facts, "attempts": attempts, "heard": heard}
    (folder / "given.json").write_text(json.dumps(given), encoding="utf-8")
    return [json.loads(line) for line in run_in_node(folder, ASK).splitlines()]


def anywhere(rng, count):
    """Suspensions all over the map."""
    logs = (rng.uniform(*np.log(ends[[0, -1]]), count) for ends in (K, C))
    return np.exp(np.transpose(list(logs))).tolist()


@pytest.fixture(scope="module")
def drives(tmp_path_factory):
    """Sixty suspensions over each road: what was asked, and the page's answers."""
    attempts = [
        [level, *place] for level in range(len(game().levels)) for place in anywhere(RNG(level), 60)
    ]
    return list(zip(attempts, ask(tmp_path_factory.mktemp("drives"), game().facts, attempts)))


def test_margins_are_those_of_the_package(drives):
    assert len(drives) == 240
    states = []
    for (level, k, c), page in drives:
        road, robot = game().levels[level][0], fitted_with(ROBOT, k, c)
        exact = [margin(robot, road, v) for v in SPEEDS]
        near([lane["margin"] for lane in page["lanes"]], exact, PARITY)
        assert [lane["v"] for lane in page["lanes"]] == list(SPEEDS)
        states += [lane["state"] for lane in page["lanes"]]
        assert states[-len(SPEEDS) :] == ["kept" if m > 0 else "lost" for m in exact]
    assert min(map(states.count, ("kept", "lost"))) > 200


def test_first_losses_are_those_of_the_package(drives):
    for (level, k, c), page in drives:
        road, robot = game().levels[level][0], fitted_with(ROBOT, k, c)
        for lane in page["lanes"]:
            exact = exact_loss(robot, road, lane["v"])
            assert (exact is None) == (lane["lost"] is None)
            if exact:
                assert lane["lost"]["wheel"] + 1 == exact.wheel
                assert lane["lost"]["t"] == pytest.approx(exact.t, abs=PARITY)
                assert lane["lost"]["X"] == pytest.approx(exact.t * lane["v"], abs=PARITY)


def test_margins_and_verdicts_of_a_small_game_are_those_of_the_package(tmp_path):
    attempts = [[level, *place] for level in (0, 1) for place in anywhere(RNG(9), 5)]
    for page, (level, k, c) in zip(ask(tmp_path, small().facts, attempts), attempts):
        found = small().judge(k, c, level)
        near([lane["margin"] for lane in page["lanes"]], list(found.margins.values()), PARITY)
        assert page["distance"] == pytest.approx(found.distance, rel=PARITY)
        assert page["air"] == pytest.approx(found.air, abs=PARITY)
        assert page["isReached"] == found.reached


def test_distance_and_verdict_are_those_of_the_package(drives):
    for (level, k, c), page in drives:
        distance = np.hypot(np.log(k / 800), np.log(c / 1.5))  # the definition of Part X
        assert page["distance"] == pytest.approx(distance, rel=PARITY)
        kept = min(margin(fitted_with(ROBOT, k, c), game().levels[level][0], v) for v in SPEEDS) > 0
        assert page["isReached"] == kept
    for (level, k, c), page in drives[::24]:
        found = game().judge(k, c, level)
        assert page["distance"] == pytest.approx(found.distance, rel=PARITY)
        assert page["isReached"] == found.reached
        assert page["air"] == pytest.approx(found.air, abs=PARITY)


def test_the_part_in_the_air_is_that_of_fly(drives):
    flown = 0
    for (level, k, c), page in drives[::6]:
        road, robot = game().levels[level][0], fitted_with(ROBOT, k, c)
        for lane in page["lanes"]:
            if lane["state"] == "lost":
                flight = fly(robot, road, v=lane["v"], tfinal=DISTANCE / lane["v"])
                part = flight.airtime.max() * lane["v"] / DISTANCE
                assert lane["air"] == pytest.approx(part, abs=PARITY)
                flown += 1
            else:
                assert lane["air"] == 0
    assert flown > 40


def test_the_map_is_right_to_a_thousandth_of_the_load(drives):
    for (level, k, c), page in drives:
        exact = [lane["margin"] for lane in page["lanes"]]
        scale = np.maximum(np.abs(exact), LOAD)
        assert (np.abs(np.subtract(page["sketch"], exact)) < 2e-3 * scale).all(), (level, k, c)


def test_the_answers_to_beat_are_those_of_part_ten(tmp_path):
    attempts = []
    for level, (road, goal) in enumerate(game().levels):
        choice = cheapest(ROBOT, road, SPEEDS, K, C)
        assert goal == ("contact", 0.0, choice.robot, choice.distance, 0.0)
        told = game().facts["levels"][level]
        assert told["best"] == {"k": choice.robot.k1, "c": choice.robot.c1}
        attempts.append([level, choice.robot.k1, choice.robot.c1])
    nearer = [[n, *(800 * (k / 800) ** 0.98, 1.5 * (c / 1.5) ** 0.98)] for n, k, c in attempts]
    for page, (_, goal) in zip(ask(tmp_path, game().facts, attempts), game().levels):
        assert page["isReached"] and page["distance"] == pytest.approx(goal.distance, rel=PARITY)
        assert min(lane["margin"] for lane in page["lanes"]) == pytest.approx(0, abs=1e-6)
    assert not any(page["isReached"] for page in ask(tmp_path, game().facts, nearer))


def test_unknown_roads_are_the_same_each_time_and_worth_playing():
    roads = [road for road, _ in game().levels[1:]]
    again = unknown_roads(ROBOT, BUMP, SPEEDS, K, C, distance=DISTANCE)
    assert [road for road, _ in again] == roads and len(roads) == 3
    assert {np.sign(road.height) for road in roads} == {-1, 1}
    other = unknown_roads(ROBOT, BUMP, SPEEDS, K, C, seed=1, distance=DISTANCE)
    assert [road for road, _ in other] != roads
    for road, goal in [*again, *other]:
        assert min(margin(ROBOT, road, v) for v in SPEEDS) < 0 < goal.distance
    distances = [goal.distance for _, goal in again]
    assert distances == sorted(distances)


@pytest.mark.parametrize("stiffness", STIFFNESSES[::3])
def test_every_spring_has_a_game(stiffness, tmp_path):
    robot = Robot(stiffness, stiffness)
    own = Game(robot, BUMP, SPEEDS, K, C)
    kept = min(margin(robot, BUMP, v) for v in SPEEDS) > 0
    first = own.levels[0][1]
    assert first.kind == ("reserve" if kept else "contact") and len(own.levels) == 4
    attempts = [[n, goal.best.k1, goal.best.c1] for n, (_, goal) in enumerate(own.levels)]
    for page, (level, k, c) in zip(ask(tmp_path, own.facts, attempts), attempts):
        found = own.judge(k, c, level)
        assert page["isReached"] and found.reached
        near([lane["margin"] for lane in page["lanes"]], list(found.margins.values()), PARITY)
    if kept:
        least = own.judge(first.best.k1, first.best.c1).margins
        assert min(least.values()) == pytest.approx(first.reserve, abs=1e-6)
        assert "Contact is lost at no speed" in own.alt


def test_where_no_suspension_keeps_contact_the_air_is_what_counts(tmp_path):
    high = replace(BUMP, height=0.25)
    grid = np.geomspace(100, 3200, 4), np.geomspace(0.3, 15, 4)
    goal = goal_on(ROBOT, high, SPEEDS, *grid)
    assert cheapest(ROBOT, high, SPEEDS, *grid) is None
    assert goal.kind == "air" and 0 < goal.air < air(ROBOT, high, SPEEDS)
    others = [air(fitted_with(ROBOT, k, c), high, SPEEDS) for k in grid[0] for c in grid[1]]
    assert goal.air == pytest.approx(min(others), rel=0.01)  # a map of runs by RK4 chose it
    own = Game(ROBOT, high, SPEEDS, *grid)
    attempts = [[0, goal.best.k1, goal.best.c1], [0, 800, 1.5]]
    best, present = ask(tmp_path, own.facts, attempts)
    assert best["isReached"] and not present["isReached"]
    assert best["air"] == pytest.approx(goal.air, abs=PARITY)
    assert own.judge(*attempts[0][1:]).reached and not own.judge(800, 1.5).reached
    assert own.judge(800, 1.5).air == pytest.approx(present["air"], abs=PARITY)


def test_a_robot_that_nothing_betters_is_told_so():
    best = goal_on(ROBOT, BUMP, SPEEDS, K, C).best
    flat = replace(BUMP, height=1e-6)
    goal = goal_on(best, flat, SPEEDS, K, C)
    assert goal.distance == 0 and goal.kind == "reserve" and goal.best == best


# --- what one hears -----------------------------------------------------------------------------

BASES, PANS, SECONDS = (220, 330), (-0.8, 0.8), 3


@pytest.fixture(scope="module")
def heard(tmp_path_factory):
    """The robot as it is and three others, each road and speed: robot, road, page's lane, score."""
    attempts = [
        [level, *place]
        for level in range(len(game().levels))
        for place in [[800, 1.5], [300, 0.5], [2500, 6], [300, 12]]
    ]
    answers = ask(tmp_path_factory.mktemp("heard"), game().facts, attempts, heard=True)
    return [
        (fitted_with(ROBOT, k, c), game().levels[level][0], lane, score, events)
        for (level, k, c), page in zip(attempts, answers)
        for lane, score, events in zip(page["lanes"], page["scores"], page["events"])
    ]


def forces_at(flight, t):
    """Normal forces of a flight with very many samples."""
    return np.array([np.interp(t, flight.T, N) for N in flight.N])


def test_tones_follow_the_forces_and_are_silent_in_flight(heard):
    silent = 0
    for robot, road, lane, score, _ in heard:
        end = DISTANCE / lane["v"]
        flight = fly(robot, road, v=lane["v"], tfinal=end, samples=40_001)
        for i, voice in enumerate(score["voices"]):
            assert voice["pan"] == PANS[i] and score["seconds"] == SECONDS
            t = np.array([point["at"] for point in voice["points"]]) * end / SECONDS
            assert (np.diff(t) >= 0).all() and t[0] == 0 and t[-1] == pytest.approx(end)
            gain = np.array([point["gain"] for point in voice["points"]])
            pitch = np.array([point["frequency"] for point in voice["points"]])
            own = [event.t for event in flight.events if event.wheel == i + 1]
            away = np.array([min([abs(s - x) for x in own], default=1.0) for s in t])
            clear = away > 1e-6 * end  # at an event itself the tone begins or ends
            N = forces_at(flight, t)[i]
            expected = BASES[i] * np.clip(N / LOAD, 0.25, 6)
            np.testing.assert_allclose(pitch[clear], expected[clear], rtol=1e-4)
            loud = 0.25 * np.clip(4 * N / LOAD, 0, 1)
            np.testing.assert_allclose(gain[clear], loud[clear], atol=1e-4)
            for start, stop, pressing in flight.legs:
                inside = (t > start + PARITY) & (t < stop - PARITY)
                if not pressing[i]:
                    assert (gain[inside] == 0).all()
                    silent += inside.sum()
    assert silent > 500


def test_pitch_and_loudness_of_a_force_are_exact(tmp_path):
    script = """import { loudness, pitch } from "./page/sound.js";
    for (const N of [-1, 0, 0.5, 2, 7, 14, 21, 60])
      console.log(JSON.stringify([pitch(N, 7, 220), loudness(N, 7)]));"""
    found = np.array([json.loads(line) for line in run_in_node(tmp_path, script).splitlines()])
    np.testing.assert_allclose(found[:, 0], [55, 55, 55, 440 / 7, 220, 440, 660, 1320], rtol=1e-12)
    np.testing.assert_allclose(
        found[:, 1], [0, 0, 1 / 14, 0.25, 0.25, 0.25, 0.25, 0.25], rtol=1e-12
    )


def test_each_event_has_its_sounds_at_its_time_on_its_side(heard):
    knocks = 0
    for robot, road, lane, score, events in heard:
        end = DISTANCE / lane["v"]
        flight = fly(robot, road, v=lane["v"], tfinal=end)
        if lane["state"] == "kept":
            assert not flight.events and not events
        assert [(e["wheel"] + 1, e["kind"]) for e in events] == [e[:2] for e in flight.events]
        *chimes, last = score["chimes"]
        assert (last["kind"], last["at"], last["pan"]) == (lane["state"], SECONDS, 0)
        for chime, event in zip(chimes, flight.events, strict=True):
            assert chime["kind"] == event.kind
            assert chime["at"] == pytest.approx(SECONDS * event.t / end, abs=1e-8)
            assert chime["pan"] == PANS[event.wheel - 1]
            first, second = chime["frequencies"]
            assert (second > first) == (event.kind == "lift-off")
        landings = [event for event in flight.events if event.kind == "landing"]
        for knock, event in zip(score["knocks"], landings, strict=True):
            assert knock["at"] == pytest.approx(SECONDS * event.t / end, abs=1e-8)
            assert knock["pan"] == PANS[event.wheel - 1]
            assert knock["gain"] == pytest.approx(0.9 * np.clip(event.force / LOAD, 0.2, 1))
            knocks += 1
    assert knocks > 60


def test_all_that_is_heard_is_said(heard):
    for _, _, lane, score, events in heard:
        first, *told, last = score["captions"]
        assert first["at"] == 0 and "220 Hz" in first["words"].replace("\u00a0", " ")
        assert len(told) == len(events)
        for caption, event in zip(told, events):
            side, wheel = ("left", "right")[event["wheel"]], ("rear", "front")[event["wheel"]]
            assert f"{wheel} wheel" in caption["words"] and side in caption["words"]
            assert ("knock" in caption["words"]) == (event["kind"] == "landing")
        assert last["words"].endswith(f": {lane['state']}.")
        assert ("No silence" in last["words"]) == (not events)


# --- the instrument -------------------------------------------------------------------------------


def test_a_page_gets_a_still_picture_and_all_that_its_script_needs():
    html = game().html()
    assert 'class="suspension-laboratory se-game"' in html
    assert "Contact is lost at 1.2 and 5" in html
    state = json.loads(html.split('class="se-state">')[1].split("</script>")[0])
    assert (state["level"], state["k"], state["c"]) == (0, 800, 1.5)
    assert state["attempts"] == state["uncovered"] == []
    assert [level["kind"] for level in state["facts"]["levels"]] == ["contact"] * 4
    assert len(html) < 250_000


def test_what_is_chosen_is_there_in_python():
    own = small()
    own.k, own.c = 280.0, 1.6
    assert own.chosen == Robot(280, 280, c1=1.6, c2=1.6)
    found = own.judge(own.k, own.c)
    assert found.distance == pytest.approx(np.hypot(np.log(280 / 800), np.log(1.6 / 1.5)))
    assert list(found.margins) == [1.2, 5] and not found.reached and found.air > 0


@pytest.mark.parametrize(
    "bad, named",
    [
        ({"robot": Robot(700, 900)}, "robot"),
        ({"robot": Robot(800, 800, c1=0, c2=0)}, "robot"),
        ({"asked": [0.0, 1]}, "asked"),
        ({"asked": []}, "v"),
        ({"k": [300, 200]}, "k"),
        ({"c": [0, 1]}, "c"),
        ({"bump": replace(BUMP, centre=0.1)}, "bump"),
        ({"distance": -1}, "distance"),
        ({"seed": 0.5}, "seed"),
    ],
)
def test_bad_input_is_refused_by_name(bad, named):
    good = {"robot": ROBOT, "bump": BUMP, "asked": [1.2], "k": [100, 3200], "c": [0.3, 15]}
    with pytest.raises(ValueError, match=rf"^{named} "):
        Game(**good | bad)


def test_a_level_that_is_not_there_is_refused():
    with pytest.raises(ValueError, match=r"^level "):
        small().judge(800, 1.5, 7)


@pytest.mark.parametrize(
    "name, value",
    [
        ("level", 7),
        ("k", 99.0),
        ("c", np.nan),
        ("attempts", [[0, 800]]),
        ("attempts", [[0, 1e9, 1.5, ""]]),
        ("uncovered", [9]),
    ],
)
def test_what_cannot_be_played_is_refused(name, value):
    with pytest.raises(ValueError, match="level|k must|c must|attempts must"):
        setattr(small(), name, value)
