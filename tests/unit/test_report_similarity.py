"""Sentences of the chart, for springs and bumps of every kind."""

from dataclasses import replace

import numpy as np
import pytest
from cases import STIFFNESSES, faults

from suspension.contact import Regimes, regimes
from suspension.problem import SPEEDS
from suspension.report import similarity as part
from suspension.report.rows import table
from suspension.report.similarity import Ride
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.similarity import closing_limit, groups

BUMP = GaussianBump()
RIDE = Ride(
    vehicle="car",
    obstacle="hump",
    source="[Somebody](../book/references.md#x)",
    frequency=1.26,
    zeta=0.377,
    sag=0.155,
    height=0.1,
    speeds=np.linspace(1, 20, 20),
    lost=np.zeros(20, dtype=bool),
    heavy=np.nan,
)
CASES = {  # edges, lost, and what the sentences must say
    "slow or in the window": ([0.1, 0.4, 7, 20, 60], [0, 1, 0, 1], "two ways"),
    "slow or fast": ([0.1, 0.4, 7, 60], [0, 1, 0], "above 7.00 m/s"),
    "slow alone": ([0.1, 0.4, 60], [0, 1], "one way"),
    "three": ([0.1, 0.4, 1, 2, 3, 9, 60], [0, 1, 0, 1, 0, 1], "three ways"),
    "a hair": ([0.1, 0.4, 7, 7.2, 60], [0, 1, 0, 1], "too narrow"),
    "fast alone": ([0.1, 5, 60], [1, 0], "above 5.00 m/s"),
    "always": ([0.1, 60], [0], "Every speed"),
    "never": ([0.1, 60], [1], "No speed"),
}


def plain(text):
    """A text without its no-break spaces."""
    return text.replace("\xa0", " ")


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
    cut = plain(part.cut(found))
    assert all(f"{edge:.3g}" in cut.replace("0.400", "0.4").replace(".00", "") for edge in edges)
    assert (("once" in cut) + ("twice" in cut) + ("times" in cut)) == bool(len(found.critical))
    caption = part.chart_figure([0, 0.03, 0.4], 0.03, found, SPEEDS)
    sound(text, cut, part.asked(found, SPEEDS), *caption)


def test_only_a_window_is_called_narrow():
    assert "narrow" not in part.two_ways(Regimes([0.1, 0.105, 7, 20, 60], [0, 1, 0, 1]))


@pytest.mark.parametrize(
    "lost, words",
    [
        ([0, 1], ["0.25 m/s lies below", "1.2, 5 and 10 m/s lie above"]),
        ([0, 0], ["All four speeds", "kept"]),
        ([1, 1], ["All four speeds", "lost"]),
        ([1, 0], ["1.2, 5 and 10 m/s lie below", "0.25 m/s lies above"]),
    ],
)
def test_the_asked_speeds_are_told_by_side(lost, words):
    text = plain(part.asked(Regimes([0.1, 1, 60], lost), SPEEDS))
    assert all(word in text for word in words)


@pytest.mark.slow
@pytest.mark.parametrize("k", STIFFNESSES)
def test_every_spring_has_a_true_sentence_about_its_window(k):
    robot = Robot(k, k)
    G = groups(robot, BUMP, 1.2)
    found = regimes(robot, BUMP, 0.1, 100)
    opened = bool((found.lost[:-1] & ~found.lost[1:]).any())
    exact = G.zeta * (2 if opened else 0.5)  # `closing` itself is tested with the core
    limit = closing_limit(G.eta)
    lines = np.sqrt(np.e) / (2 * np.sqrt(2 * np.pi) * G.eta**2)
    text = plain(part.window(G.zeta, G.eta, lines, limit, exact))
    assert ("window is open" in text) == opened
    sound(text, part.groups_table(G, 1.2), part.cut(found), part.two_ways(found))
    sound(*part.window_figure(G.zeta, G.eta, exact), *part.limits_figure(G.zeta))
    sound(*part.comb_figure(G.j, G.lam))


def test_a_closed_window_is_called_closed():
    text = plain(part.window(0.2, 2.8, 0.04, 0.1, 0.066))
    assert "window is closed" in text and "3.0 times" in text
    assert "to the right, where the window is closed" in part.window_figure(0.2, 2.8, 0.066).alt


@pytest.mark.parametrize(
    "value, words", [(0.066, "right"), (0.1, "52 % too high"), (0.041, "38 % too low")]
)
def test_a_formula_is_told_by_how_much_it_is_off(value, words):
    assert f"({words})" in plain(part.window(0.03, 2.8, 0.05, value, 0.066))


def test_the_end_of_the_way_is_told_only_where_it_matters():
    v = [1.0, 5.0, 20.0]
    assert "does not matter" in part.course(v, [1, 1.001, 1])
    text = plain(part.course(v, [1, 1.001, 1.5]))
    assert "most at 20.0 m/s" in text and "1.5 times lower" in text
    sound(text, part.course(v, [1, 1, 1]))


@pytest.mark.parametrize(
    "lost, words",
    [
        (range(12, 20), "above 47 km/h"),
        (range(5), "below 18 km/h"),
        (range(5, 10), "from 22 to 36 km/h"),
        (range(20), "at all speeds from 3.6 to 72 km/h"),
    ],
)
def test_a_vehicle_that_loses_contact_is_told_with_its_speeds(lost, words):
    gone = np.isin(np.arange(20), list(lost))
    losing = RIDE._replace(lost=gone)
    text = plain(part.losses([losing, RIDE._replace(vehicle="bus")]))
    assert f"the car {words} loses contact" in text and "The bus keeps it" in text
    assert "car" in part.vehicles_figure([losing]).alt
    sound(text, part.vehicle_table([losing]), *part.vehicles_figure([losing]))


def test_vehicles_that_keep_contact_are_told_as_such():
    assert "none of them" in part.losses([RIDE, RIDE])
    assert "keep it" in part.losses([RIDE._replace(lost=~RIDE.lost), RIDE, RIDE])
    assert "kept by all" in part.vehicles_figure([RIDE, RIDE]).alt


def test_a_heavy_wheel_is_told_where_it_matters_and_where_it_is_known():
    text = plain(part.heavy_wheels([RIDE, RIDE._replace(vehicle="bus", heavy=9.0)]))
    assert "the bus above 32 km/h" in text and "car" not in text
    for heavy in (np.nan, 90.0):
        assert "no wheel" in part.heavy_wheels([RIDE._replace(heavy=heavy)])


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
