"""Sentences of the chart, for springs and bumps of every kind."""

from dataclasses import replace

import numpy as np
import pytest
from cases import STIFFNESSES, faults
from helpers import plain

from suspension.contact import Regimes, regimes
from suspension.problem import SPEEDS
from suspension.report import similarity as part
from suspension.report.regimes import WIDE
from suspension.report.rows import table
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.similarity import groups
from suspension.vehicles import Passage

BUMP = GaussianBump()
CAR = Passage(
    vehicle="car",
    obstacle="hump",
    cited_as="Somebody",
    source="x",
    frequency=1.26,
    zeta=0.377,
    sag=0.155,
    height=0.1,
    contact=Regimes([5, 80], [False], "km/h"),
    rises=False,
    heavy=np.nan,
)
LOSING = CAR._replace(contact=Regimes([5, 47, 80], [False, True], "km/h"))
CASES = {  # edges, lost, and what the sentences must say
    "slow or in the window": ([0.1, 0.4, 7, 20, 60], [0, 1, 0, 1], "two ways"),
    "slow or fast": ([0.1, 0.4, 7, 60], [0, 1, 0], "above 7.00 m/s"),
    "slow alone": ([0.1, 0.4, 60], [0, 1], "one way"),
    "three": ([0.1, 0.4, 1, 2, 3, 9, 60], [0, 1, 0, 1, 0, 1], "three ways"),
    "a hair": ([0.1, 0.4, 7, 7.2, 60], [0, 1, 0, 1], "too narrow"),
    "fast alone": ([0.1, 5, 60], [1, 0], "above 5.00 m/s"),
    "a hair alone": ([0.1, 7, 7.2, 60], [1, 0, 1], "one way** to be safe: from 7.00 to 7.20 m/s."),
    "two hairs": (
        [0.1, 7, 7.2, 9, 9.3, 60],
        [1, 0, 1, 0, 1],
        "from 7.00 to 7.20 m/s and from 9.00 to 9.30 m/s are too narrow",
    ),
    "always": ([0.1, 60], [0], "Every speed"),
    "never": ([0.1, 60], [1], "No speed"),
}


def sound(*texts):
    """No text of these breaks a rule of the report."""
    for text in texts:
        assert not faults(text), text


@pytest.mark.parametrize("name", CASES)
def test_every_kind_of_regimes_has_its_words(name):
    edges, lost, words = CASES[name]
    found = Regimes(edges, lost)
    text = part.two_ways(found)
    assert words in plain(text)
    sound(text, *part.chart_figure([0, 0.03, 0.4], 0.03, found, SPEEDS))


def test_only_a_window_is_called_narrow():
    assert "narrow" not in part.two_ways(Regimes([0.1, 0.105, 7, 20, 60], [0, 1, 0, 1]))
    assert "narrow" not in part.two_ways(Regimes([0.1, 0.4, 58, 60], [0, 1, 0]))  # it may go on


@pytest.mark.parametrize("factor, narrow", [(0.999, True), (1.001, False)])
def test_a_narrow_range_is_told_without_a_cause(factor, narrow):
    text = part.two_ways(Regimes([0.1, 0.4, 7, 7 * WIDE * factor, 60], [0, 1, 0, 1]))
    assert ("too narrow" in text) == narrow and ("damper pulls" in text) != narrow


def test_each_speed_has_its_highest_bump_and_the_verdict_on_ours():
    text = plain(part.heights_table([0.25, 1.2], [0.117, 0.00572], 0.0254, [False, True]))
    assert "| the bump, 25.4 mm |" in text
    assert "| 0.25 | 117 | kept |" in text and "| 1.2 | 5.72 | lost |" in text
    sound(text)
    assert "| 3 | any | kept |" in plain(part.heights_table([3], [np.inf], 0.0254, [False]))


@pytest.mark.slow
@pytest.mark.parametrize("k", STIFFNESSES)
def test_every_spring_has_a_true_sentence_about_its_window(k):
    robot = Robot(k, k)
    G = groups(robot, BUMP, 1.2)
    found = regimes(robot, BUMP, 0.1, 100)
    opened = bool((found.lost[:-1] & ~found.lost[1:]).any())
    exact = G.zeta * (2 if opened else 0.5)  # `closing` itself is tested with the core
    lines = np.sqrt(np.e) / (2 * np.sqrt(2 * np.pi) * G.eta**2)
    text = plain(part.window(G.zeta, G.eta, lines, exact))
    assert ("The window is open" in text) == opened
    sound(text, part.groups_table(G, 1.2), part.two_ways(found))
    sound(*part.window_figure(G.zeta, G.eta, exact), *part.limits_figure(G.zeta))
    sound(*part.comb_figure(G.j, G.lam))


def test_a_closed_window_is_called_closed():
    text = plain(part.window(0.2, 2.8, 0.04, 0.066))
    assert "window is closed" in text and "3.0 times" in text
    assert "to the right, where the window is closed" in part.window_figure(0.2, 2.8, 0.066).alt


@pytest.mark.parametrize(
    "value, words",
    [
        (0.066, "right"),
        (1.004 * 0.066, "right"),
        (1.006 * 0.066, "0.60 % too high"),
        (0.994 * 0.066, "0.60 % too low"),
        (0.1, "52 % too high"),
        (0.041, "38 % too low"),
    ],
)
def test_a_formula_is_told_by_how_much_it_is_off(value, words):
    assert f"the lines are {words}." in plain(part.window(0.03, 2.8, value, 0.066))


@pytest.mark.parametrize(
    "lines, words",
    [
        ([1, 1, 1], "the truth lies between. What"),
        ([1, 1, 2.5], "the truth lies between, but for dampings from 0.10 on. What"),
        ([5, 1, 1], "the truth lies between, but for dampings up to 0.010. What"),
        ([5, 1, 2.5], "the truth lies between, but not at every damping. What"),
        ([5, 5, 5], "The truth does not lie between the two estimates here. What"),
    ],
)
def test_the_summit_lies_between_two_estimates_where_it_does(lines, words):
    found = [0.01, 0.03, 0.1, 0.3], [4, 3, 2, np.nan], [6, 6, 6, 6], [*lines, 1]
    text = plain(part.spring_summit(*found, 0.066, 0.098))
    assert words in text and "closes at $\\zeta$ = 0.098, 48 % too high" in text
    sound(text)


@pytest.mark.parametrize(
    "tops, words",
    [
        ([9, 3.3, 1], "hardly changes along the summit: over dampings that grow 10 times it stays"),
        ([9, 3.3, 0.3], "goes from 0.090 to 0.030 along the summit"),
        ([np.nan, 3.3, 1], "over dampings that grow 3.0 times"),
        ([np.nan, np.nan, 1], "there is no summit"),
    ],
)
def test_damping_times_height_is_called_constant_only_where_it_is(tops, words):
    text = plain(part.weight(np.array([0.01, 0.0333, 0.1]), tops))
    assert words in text
    sound(text)


def test_the_end_of_the_way_is_told_only_where_it_matters():
    v = [1.0, 5.0, 20.0]
    assert "does not matter" in part.course(v, [1, 1.009, 1])
    assert "matters most at 5.00" in part.course(v, [1, 1.011, 1])
    text = plain(part.course(v, [1, 1.001, 1.5]))
    assert "most at 20.0 m/s" in text and "1.5 times lower" in text
    sound(text, part.course(v, [1, 1, 1]))


@pytest.mark.parametrize(
    "edges, lost, words",
    [
        ([5, 47, 80], [0, 1], "above 47"),
        ([5, 18, 80], [1, 0], "below 18"),
        ([5, 22, 36, 80], [0, 1, 0], "22 to 36"),
        ([5, 22, 36, 80], [1, 0, 1], "below 22 and above 36"),
        ([5, 80], [1], "at all speeds"),
        ([5, 80], [0], "–"),
    ],
)
def test_a_vehicle_that_loses_contact_is_told_with_its_speeds(edges, lost, words):
    passage = CAR._replace(contact=Regimes(edges, lost, "km/h"))
    text = part.vehicle_table([passage, passage._replace(heavy=44.2)])
    assert f"| {words} | – | [Somebody]" in text and f"| {words} | 44 |" in text
    alt = part.vehicles_figure([passage]).alt
    assert ("lost for: car" in alt) == any(lost) and ("kept by all" in alt) != any(lost)
    sound(text, *part.vehicles_figure([passage]))


@pytest.mark.parametrize(
    "rises, words",
    [
        ([0, 0], "For each of these vehicles the highest bump falls"),
        ([1, 0], "Only for the car is there a range in which faster is safer. The dampers of the"),
        ([1, 1], "For the car and the car there is a range in which faster is safer."),
    ],
)
def test_faster_is_safer_only_for_a_vehicle_whose_highest_bump_rises(rises, words):
    text = part.falls([CAR._replace(rises=bool(one)) for one in rises])
    assert text.startswith(words) and ("slower is safer" in text) == (not all(rises))
    sound(text)


def test_a_heavy_wheel_is_told_where_it_decides_and_where_it_is_known():
    heavy = CAR._replace(vehicle="bus", heavy=32.0)
    assert "For the bus the mass" in part.heavy_first([CAR, heavy])
    assert "For the bus the mass" in part.heavy_first(
        [LOSING, heavy._replace(contact=LOSING.contact)]
    )
    for passage in (CAR, LOSING._replace(heavy=50.0), CAR._replace(heavy=90.0)):
        assert "none of them" in part.heavy_first([passage])


def test_the_groups_are_those_of_the_robot():
    robot = replace(Robot(793, 793), c1=3, c2=3)
    G = groups(robot, BUMP, 1.2)
    text = part.groups_table(G, 1.2)
    assert all(f"| {x} |" in text for x in ("1.26", "0.0624", "2.82", "0.720", "3.72"))
    assert text.count("\n") == table([{"a": 1}] * 5).count("\n")


def test_a_robot_that_is_not_symmetric_is_told_its_twin():
    assert part.twin_note(Robot(800, 800)) == ""
    note = part.twin_note(Robot(700, 900, c2=2.5))
    assert "**symmetric twin**" in note and "$k$ = 800.0" in note and "$c$ = 2.00" in note
