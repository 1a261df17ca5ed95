"""Sentences of Part VII, for springs and robots of every kind."""

from functools import cache

import numpy as np
import pytest
from cases import STIFFNESSES, faults
from helpers import plain

from suspension.flight import fly
from suspension.report import airborne as part
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.simulation import simulate
from suspension.sweep import drive
from suspension.travel import Moment, moments

BUMP = GaussianBump()
ROBOTS = {f"k = {k}": Robot(k, k) for k in STIFFNESSES} | {
    "undamped": Robot(793, 793, c1=0, c2=0),
    "unsymmetric": Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
}
SPEEDS = (0.5, 1.2, 5)
each_robot = pytest.mark.parametrize("name", ROBOTS)


@cache
def flights(name, wheel="follows"):
    return {v: fly(ROBOTS[name], BUMP, v=v, tfinal=1, wheel=wheel) for v in SPEEDS}


@pytest.mark.slow
@each_robot
def test_sentences_about_flights_are_sound(name):
    robot, runs = ROBOTS[name], flights(name)
    linear = {v: simulate(robot, BUMP, v=v, dt=1e-3, tfinal=1) for v in SPEEDS}
    ways = [drive(robot, BUMP, SPEEDS, geometry=geometry) for geometry in ("small", "full")]
    told = moments(runs[1.2], robot, BUMP)
    times = [moment.t for moment in told]
    assert times == sorted(times) and len(told) >= 3
    texts = [
        part.flight_table(runs.values(), robot),
        part.geometry_table(SPEEDS, *ways),
        part.geometry_sentence(SPEEDS, *ways),
        part.who_flies(runs, linear),
        part.models(runs, flights(name, "relaxes"), robot),
        *part.flight_caption(list(runs.values())),
        *part.film_caption(1.2, told),
    ]
    for text in texts:
        assert not faults(text)


@pytest.mark.parametrize(
    ("moment", "words"),
    [
        (Moment("foot", 2, 0.1), "the front wheel reaches the bump (0.100 s)."),
        (Moment("top", 1, 0.1), "the rear wheel is on its top (0.100 s)."),
        (Moment("top", None, 0.1), "the body is over it (0.100 s)."),
        (Moment("past", None, 0.1), "both have passed (0.100 s)."),
        (Moment("lift-off", 1, 0.1), "the rear wheel lifts off (0.100 s). A wheel in the air"),
        (Moment("apex", 1, 0.1), "it is at the top of this flight (0.100 s)."),
        (Moment("landing", 1, 0.1), "it lands (0.100 s)."),
        (Moment("highest", 2, 0.1), "the front wheel is at its highest (0.100 s)."),
    ],
)
def test_every_moment_has_its_words(moment, words):
    caption = part.film_caption(1.2, [moment])
    assert f"in true proportions: {words}" in plain(caption.text)
    assert ("in the air" in caption.text) == (moment.kind == "lift-off")
    assert plain(caption.alt).startswith("One frame of the robot at 1.2 m/s")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("k", "words"),
    [
        (793, "the robot flies at each."),
        (405, "the robot flies at 1.2 m/s."),
        (250, "no wheel leaves the ground"),
    ],
)
def test_who_flies_follows_the_spring(k, words):
    runs = {v: flights(f"k = {k}")[v] for v in (1.2, 5)}
    linear = {v: simulate(Robot(k, k), BUMP, v=v, dt=1e-3, tfinal=1) for v in runs}
    assert words in plain(part.who_flies(runs, linear))


@pytest.mark.slow
def test_a_run_that_does_not_settle_is_told_so():
    table = part.flight_table([fly(ROBOTS["undamped"], BUMP, v=5, tfinal=1)], ROBOTS["undamped"])
    assert "> 1 |" in plain(table) and "a way of 5 m; the asked runs end at 1.25 m" in plain(table)


@pytest.mark.slow
def test_the_caption_says_which_of_the_shown_fly():
    runs = flights("k = 405")
    assert "At 5 m/s no wheel" in plain(part.flight_caption([runs[1.2], runs[5]]).text)
    assert "leaves the ground" not in plain(part.flight_caption([runs[1.2]]).text)


@pytest.mark.slow
def test_where_the_damper_lets_go_the_force_returns_without_a_jump_and_the_models_part():
    robot = ROBOTS["k = 793"]

    def pair(v):
        return [
            fly(robot, BUMP, v=v, tfinal=1.25 / v + 0.1, wheel=wheel)
            for wheel in ("follows", "relaxes")
        ]

    text = part.first_flights([pair(v) for v in (0.25, 7.84, 25, 1.2)])
    slow, fast, hard = text.splitlines()[2:]
    assert slow.startswith("| 7.840 | rear |") and "| no jump | 4.02 | 0.017 |" in slow
    assert "| no jump | 1.83 | 3.9 |" in fast
    assert "no jump" not in hard and not faults(text)
    assert "none of these speeds" in plain(part.first_flights([pair(0.25)]))


@pytest.mark.slow
def test_the_models_agree_or_not_as_the_numbers_say():
    runs, robot = flights("k = 793"), ROBOTS["k = 793"]
    close = part.models(runs, flights("k = 793", "relaxes"), robot)
    assert "the same | < 0.001 | < 0.001 | 1.9 |" in plain(close).splitlines()[-1]
    nobody = {0.25: fly(ROBOTS["k = 250"], BUMP, v=5, tfinal=1)}
    assert "are one" in part.models(nobody, nobody, ROBOTS["k = 250"])
    fast = [{25: fly(robot, BUMP, v=25, tfinal=0.1, wheel=w)} for w in ("follows", "relaxes")]
    assert "| 3.9 | 1.9 |" in part.models(*fast, robot)
    cut = {1.2: fly(robot, BUMP, v=1.2, tfinal=0.25)}
    assert "not the same" in part.models(runs, cut | {v: runs[v] for v in (0.5, 5)}, robot)
    agree = part.rules_apart(runs, flights("k = 793", "relaxes"))
    assert agree.endswith("agree to a microsecond.") and not faults(agree)
    assert "are one" in part.rules_apart(nobody, nobody)
    assert part.rules_apart(*fast).endswith("agree to 0.65\xa0ms.")
    assert "At 1.2\xa0m/s they do not even" in part.rules_apart({1.2: runs[1.2]}, cut)


@pytest.mark.slow
def test_the_small_angle_is_compared_with_runs_that_fly_in_the_full_geometry():
    robot = ROBOTS["k = 793"]
    small, full = (drive(robot, BUMP, [0.25, 1.2], geometry=g, fine=4) for g in ("small", "full"))
    rows = plain(part.geometry_table([0.25, 1.2], small, full)).splitlines()
    assert rows[2].startswith("| 0.25 | –, – | 7.2, 7.3 | 0 and 0, 0 and 0 | 1.30, 1.55 |")
    air = "362 and 455, 360 and 463"
    assert rows[3] == f"| 1.2 | 0.2123, 0.2129 | 17.8, 17.9 | {air} | 14.1, 13.1 |"
    text = plain(part.geometry_sentence([0.25, 1.2], small, full))
    assert text.startswith("No verdict turns. The pitch is largest at 1.2 m/s, 17.9 degrees,")
    assert "acceleration is wrong most at 0.25 m/s, by 16 %." in text and not faults(text)
    turned = full._replace(margin=np.array([0.0, 1.0]))
    assert "turns at 0.25 and 1.2 m/s" in plain(part.geometry_sentence([0.25, 1.2], small, turned))


def test_the_orders_are_told():
    caption = part.order_caption(5, 0.139, (1.1, 3.96))
    assert "(observed order 1.1)" in caption.text and "(4.0)" in caption.text
    assert not faults(caption.text) and not faults(caption.alt)


def test_the_state_diagram_has_words_for_all_it_shows():
    text, alt = part.contact_states_caption()
    assert not faults(text) and not faults(alt)
    assert "four contact states" in text and "four boxes" in alt and r"p_i^\circ" in text
