"""Sentences of Part V and the landing page, for springs and robots of every kind."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from cases import DELTA_MAX, STIFFNESSES, faults, fitted

from suspension.branches import End
from suspension.contact import critical_speeds, margin
from suspension.report import regimes as part
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.travel import Balance, balance, overtravel
from suspension.uncertainty import CriticalSpeed

BUMP = GaussianBump()
LOW, HIGH = 0.1, 30
ROBOTS = {f"k = {k}": Robot(k, k) for k in STIFFNESSES} | {
    "undamped": Robot(793, 793, c1=0, c2=0),
    "unsymmetric": Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
}
each_robot = pytest.mark.parametrize("name", ROBOTS)


def plain(text):
    """A text without its no-break spaces."""
    return text.replace("\xa0", " ")


@cache
def regimes(name):
    """Edges, verdicts between them, and where the springs go too far."""
    robot = ROBOTS[name]
    edges = np.array([LOW, *critical_speeds(robot, BUMP, LOW, HIGH), HIGH])
    lost = [margin(robot, BUMP, v) < 0 for v in np.sqrt(edges[1:] * edges[:-1])]
    return edges, lost, overtravel(robot, BUMP, DELTA_MAX, LOW, HIGH)


@pytest.mark.slow
@each_robot
def test_the_verdict_tells_every_range(name):
    edges, lost, beyond = regimes(name)
    text = part.verdict(edges, lost, beyond)
    assert not faults(text)
    told = text.split(".", 1)[0] if len(lost) == 1 else text
    assert told.count("kept") + told.count("lost") >= len(lost)
    assert ("if the spring stays linear" in plain(text)) == bool(len(beyond))


@pytest.mark.slow
@each_robot
def test_captions_tables_and_doubts_are_sound(name):
    robot = ROBOTS[name]
    edges, lost, beyond = regimes(name)
    balances = [balance(robot, BUMP, v) for v in edges[1:-1]]
    at_rest = robot.m * robot.g / 2 / robot.k1 / DELTA_MAX
    texts = [
        *part.margin_caption(edges, lost, beyond, (0.25, 1.2)),
        *part.travel_caption(edges, beyond, DELTA_MAX),
        *part.sensitivity_caption(edges[1:-1]),
        part.balance_table(edges[1:-1], balances),
        part.landing_opening(lost),
        part.doubt(edges, beyond, {1.2: 1.39}, at_rest, DELTA_MAX, 0.15),
        part.lesson(lost, balances),
    ]
    for text in texts:
        assert not faults(text)
        assert text


def test_neighbouring_speeds_can_be_told_apart():
    text = part.verdict([0.1, 0.40178, 0.444945, 0.445960, 30], [False, True, False, True])
    assert "kept from 0.4449 to 0.4460 m/s" in plain(text)
    assert "by a hair" in plain(text)
    assert "*safer*" not in plain(text)


def test_faster_is_safer_only_where_a_range_can_be_driven_in():
    wide = part.verdict([0.1, 0.436, 7.85, 20.3, 30], [False, True, False, True])
    assert wide.count("*safer*") == 1 and "faster than 7.85 m/s" in plain(wide)
    assert "*safer*" not in plain(part.verdict([0.1, 0.5, 30], [False, True]))


@pytest.mark.parametrize(
    ("lost", "words"),
    [
        ([False], "they do not"),
        ([True], "at every speed"),
        ([False, True], "that is the answer"),
        ([True, False], "the other way round"),
        ([False, True, False, True], "stranger"),
    ],
)
def test_the_landing_page_promises_what_comes(lost, words):
    assert words in part.landing_opening(np.array(lost))


def test_one_verdict_for_all_speeds():
    assert "kept at every speed from 0.1 to 30 m/s" in plain(part.verdict([0.1, 30], [False]))
    assert "No sign" not in plain(part.lesson([False], []))
    assert part.balance_table([], []).startswith("There is no critical speed")
    assert part.strongest([], {"$k$": []})
    assert "$k$ at 7.85 m/s (1.38 % per 1 %)" in plain(part.strongest([7.85], {"$k$": [1.38]}))
    assert not faults(part.sensitivity_caption([]).text)


def test_the_damper_is_blamed_only_where_the_spring_still_pushes():
    thrown, pulled = Balance(2, 0.02, -0.02), Balance(1, 13.8, -13.8)
    assert "the damper pulls" not in plain(part.balance_table([0.436], [thrown]))
    assert "the body is thrown" not in plain(part.balance_table([20.3], [pulled]))
    assert "highest speeds" not in plain(part.lesson([False, True, False], [thrown]))
    assert "highest speeds" in plain(
        part.lesson([False, True, False, True], [thrown, thrown, pulled])
    )


@pytest.mark.parametrize(
    ("beyond", "words"),
    [
        ([], ""),
        ([(0.1, 30)], "at every speed from 0.1 to 30 m/s"),
        ([(0.38, 0.436), (0.72, 30)], "from 0.380 to 0.436 m/s and above 0.720 m/s"),
        ([(0.1, 0.5)], "below 0.500 m/s"),
        ([(0.381, 0.407), (0.410, 0.436)], "from 0.381 to 0.436 m/s"),
        ([(0.381, 0.407), (0.412, 0.436)], "from 0.381 to 0.407 m/s and from 0.412 to 0.436 m/s"),
        ([(0.05, 0.08), (0.5, 0.6)], "from 0.500 to 0.600 m/s"),
    ],
)
def test_where_the_spring_goes_too_far(beyond, words):
    assert plain(part.beyond_words(0.1, 30, beyond)) == words


def test_ranges_told_as_one_have_the_larger_excess_of_the_two():
    beyond = [(0.381, 0.407), (0.410, 0.436), (0.72, 30)]
    words = "0.381 to 0.436 m/s (by up to 9.6 %) and above 0.720 m/s (up to 2.1 times as far)"
    for most in ([1.096, 1.02, 2.14], [1.02, 1.096, 2.14]):
        text = plain(part.beyond_words(0.1, 30, beyond, most))
        assert text == f"from {words}"
        assert f"{words} it is compressed" in plain(part.verdict([0.1, 30], [0], beyond, most))


def test_a_spring_too_weak_to_carry_the_robot_is_called_so():
    heavy = part.doubt([0.1, 30], [(0.1, 30)], {1.2: 3.04}, 1.73, DELTA_MAX, 0.2)
    assert "Even at rest" in plain(heavy) and "1.73" in plain(heavy)
    light = part.doubt([0.1, 30], [], {1.2: 0.9}, 0.5, DELTA_MAX, 0.2)
    assert "No spring is compressed beyond" in plain(light)


def test_the_bound_of_the_pitch_is_rounded_up():
    text = part.doubt([0.1, 30], [], {1.2: 0.9}, 0.5, DELTA_MAX, np.radians(9.12))
    assert "below 9.2 degrees" in plain(text)


def test_a_critical_speed_that_ends_is_told_so():
    whole = CriticalSpeed(7.85, 7.35, 8.36, None, None)
    ends = CriticalSpeed(0.4449, 0.4423, 0.4461, None, End(990.4, 0.446, "pair"))
    elsewhere = CriticalSpeed(None, 0.407, 0.440, None, End(385.2, 0.44, "pair"))
    table = part.critical_table([whole])
    assert "note" not in plain(table) and "6.4" in plain(table)
    table = part.critical_table([whole, ends, elsewhere])
    assert "exists only for k < 990.4" in plain(table)
    assert "no confidence level" in plain(table)
    assert not faults(table)
    assert "no critical speed" in plain(part.critical_table([]))


def by_stiffness(*speeds):
    """As if each of the readings of some data had these critical speeds, m/s."""
    stiffnesses = fitted(793).stiffnesses(7.14)
    known = [[CriticalSpeed(v, 0.97 * v, 1.03 * v, None, None) for v in each] for each in speeds]
    return list(zip(stiffnesses, known, strict=True))


def test_what_the_other_readings_make_of_the_critical_speeds():
    text = plain(part.other_readings(by_stiffness([0.436, 7.85], [0.437, 7.94], [0.437, 8.00])))
    assert "By the line through the origin or the tangent at the static load, 0.436 becomes" in text
    assert "7.85 becomes 7.94 or 8.00 m/s, each of them inside" in text and not faults(text)
    text = plain(part.other_readings(by_stiffness([0.436, 7.85], [0.437, 7.94], [0.437, 9])))
    assert "what becomes of 7.85 lies **outside**" in text and "each" not in text
    assert not faults(text)
    pair = part.other_readings(by_stiffness([0.436, 7.85], [0.437], [0.437, 8.00]))
    assert "do not even agree" in pair
    assert "By none of the readings" in part.other_readings(by_stiffness([], [], []))


def test_what_rests_on_a_spring_beyond_its_range_is_marked():
    ratios = {0.25: 0.6, 5: 2.0}
    table = part.confidence_table(
        {0.25: 5.59, 5: -4.84},
        ratios,
        {0.25: [], 5: [572.83]},
        {"slope at zero": {0.25: 0.0, 5: 1.0}},
    )
    slow, fast = table.splitlines()[2:]
    assert "*" not in plain(slow) and fast.count("*") == 2
    assert "none" in plain(slow) and "572.8" in plain(fast)
    note = part.confidence_note(ratios, 792.9, ["slope at zero", "line through the origin"])
    assert "at 5 m/s: **if the spring stays linear**" in plain(note)
    calm = part.confidence_note({0.25: 0.6}, 792.9, ["slope at zero"])
    assert "asterisk" not in plain(calm)
    assert not faults(table) and not faults(note)


def test_what_happens_after_the_course():
    speeds = np.geomspace(0.1, 30, 100)
    assert "no verdict changes" in plain(part.afterwards([], speeds, 2.0))
    changed = part.afterwards([1.2, 5.0], speeds, 2.0)
    assert "**Yes:**" in plain(changed) and "1.2 and 5 m/s" in plain(changed)
    assert "12 speeds between" in plain(part.afterwards(list(range(1, 13)), speeds, 2.0))


def test_the_map_names_its_stiffness():
    caption = part.map_caption(fitted(2300).slope, [460, 4370], (0.25, 1.2), False)
    assert "slope at zero" in plain(caption.text) and "Hatched" not in plain(caption.text)
    assert not faults(caption.alt)
    assert "Hatched" in plain(part.map_caption(fitted(250).slope, [50, 475], (1.2,), True).text)


def test_real_data_are_not_called_synthetic():
    assert "not the synthetic one" in plain(part.landing_data(""))
    assert part.landing_data("They are synthetic.") == "They are synthetic."


def test_each_critical_speed_has_its_strongest_parameter():
    text = part.strongest([0.436, 7.85], {"$k$": [0.1, 1.38], "$c$": [-0.5, 0.3]})
    assert "$c$ at 0.436 m/s" in plain(text) and "$k$ at 7.85 m/s" in plain(text)
    assert not faults(text)


@pytest.mark.slow
@each_robot
def test_the_crossings_are_those_of_the_margin(name):
    edges, lost, _ = regimes(name)
    text = plain(part.crossings(edges, lost))
    assert not faults(text)
    upwards = sum(before and not after for before, after in pairwise(lost))
    assert ("upwards at" in text) == bool(upwards)
    if upwards:
        assert text.split("upwards at ")[1].split(" m/s")[0].count(".") == upwards


@pytest.mark.parametrize(
    ("edges", "lost", "words"),
    [
        ([0.1, 30], [False], "does not cross zero at all from 0.1 to 30 m/s: it stays above"),
        ([0.1, 30], [True], "it stays below"),
        ([0.1, 2, 30], [False, True], "crosses zero once from 0.1 to 30 m/s, and only down"),
        ([0.1, 2, 8, 30], [False, True, False], "twice from 0.1 to 30 m/s, and upwards at 8"),
    ],
)
def test_every_way_to_cross_zero_has_its_words(edges, lost, words):
    text = part.crossings(np.array(edges), lost)
    assert words in plain(text)
    assert not faults(text)
