"""Words on wheels that weigh something: each branch by runs that lead to it."""

from functools import cache
from types import SimpleNamespace

import numpy as np

from suspension.contact import Regimes
from suspension.energy import energy, landings
from suspension.flight import fly
from suspension.report import wheels as part
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.tyre import Tyre, roll

ROBOT, BUMP = Robot(800, 800), GaussianBump()


@cache
def flight(v, wheel="relaxes", samples=2001):
    return fly(ROBOT, BUMP, v=v, tfinal=0.7 / v, wheel=wheel, samples=samples)


def run(*airtime):
    return SimpleNamespace(airtime=np.array(airtime), gaps=np.zeros((2, 3)))


RULES = {"follows": run(1.0, 1.0), "relaxes": run(2.0, 2.0)}


def test_the_rules_are_compared_with_the_lightest_wheels():
    text = part.surviving_rule(RULES, [run(2.02, 2.0), run(2.0, 1.98)])
    assert "| follows | 50\xa0% too short |" in text and "| relaxes | 1.0\xa0% too long |" in text
    none = {"follows": run(0.0, 0.0), "relaxes": run(1.0, 1.0)}
    for rules, wheel in ((none, run(1.0, 1.0)), (RULES, run(0.0, 1.0))):
        assert "nothing is decided" in part.surviving_rule(rules, [wheel])


V = np.geomspace(0.1, 30, 200)
WINDOW = Regimes([0.1, 0.4, 8, 20, 30], [False, True, False, True])


def test_faster_is_safer_up_to_the_heaviest_wheel_of_the_window():
    mass = np.where(WINDOW(V), 0, np.where(V < 1, np.inf, 0.1 / V))
    words = part.heaviest_sentence(WINDOW, V, mass, 1.5)
    assert "may weigh 12\xa0g at best, 0.8\xa0% of the mass of the body, and less than" in words
    assert words.endswith("above 16\xa0m/s.")
    level = part.heaviest_sentence(WINDOW, V, np.where(WINDOW(V), 0, 0.01), 1.5)
    assert level.endswith("of the mass of the body.")
    assert "from 8.00 to 20.0\xa0m/s" in words


def test_without_a_window_there_is_no_claim_about_it():
    mass = np.where(V < 1, np.inf, 0.0)
    words = part.heaviest_sentence(Regimes([0.1, 0.4, 30], [False, True]), V, mass, 1)
    assert "not found again" in words and "Faster" not in words
    free = part.heaviest_sentence(WINDOW, V, np.full(V.shape, np.inf), 1)
    assert "what it likes" in free and "Faster" not in free


def test_tables_have_a_row_for_every_run():
    tyre = Tyre.with_ratio(0.01, 1e5, 0.3)
    rolling = roll(ROBOT, BUMP, tyre, v=10, tfinal=0.05, rtol=1e-5)
    rows = part.limit_table(10, {"relaxes": flight(10)}, [(tyre, rolling)]).splitlines()
    assert len(rows) == 4 and rows[2].startswith("| 10 | 1.0\xa0×\xa010⁵ | 0.30 |")
    masses = part.mass_table([10], [0.01], {(10, 0.01): rolling}, {10: flight(10)}).splitlines()
    assert "kept" in masses[2] and "| front, 0.187 |" in masses[3]


def test_energy_is_told_with_its_landings():
    long = flight(1.2, samples=20001)
    found = landings(long, ROBOT, BUMP)
    words = part.energy_sentence(energy(long, ROBOT, BUMP), found)
    assert "The road puts in 64" in words and "arises on the ground" in words
    assert words.endswith("landings.")
    assert len(part.landing_table(found).splitlines()) == 2 + len(found)
    kept = flight(10)
    assert "No wheel lands" in part.energy_sentence(energy(kept, ROBOT, BUMP), ())


def test_captions_name_what_is_drawn():
    assert "1.0\xa0g and 0.10\xa0g" in part.free_wheels_caption(40, [1e-3, 1e-4]).text
    assert "0.25 and 10\xa0m/s" in part.heaviest_caption([0.25, 10]).alt
    assert "1.2\xa0m/s" in part.energy_caption(1.2).text
