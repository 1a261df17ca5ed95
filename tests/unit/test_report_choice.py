"""Sentences of Parts IX to XI, for springs and robots of every kind."""

from dataclasses import replace

import numpy as np
import pytest
from cases import STIFFNESSES, faults, fitted

from suspension.choice import Candidate, Choice, Demands, Exclusion, Findings, Ride, fitted_with
from suspension.contact import Regimes
from suspension.explorer.family import Family
from suspension.report import choice as part
from suspension.road import GaussianBump
from suspension.robot import Robot

ASKED = (0.25, 1.2, 5.0, 10.0)
ROBOT = Robot(793, 793)
SOFT = fitted_with(ROBOT, 277, 1.57)
LEAST, RESERVED = Choice(SOFT, 1.05, 0.0), Choice(fitted_with(ROBOT, 256, 1.58), 1.13, 0.71)
WIDE = Choice(fitted_with(ROBOT, 161, 1.6), 1.6, 0.71)
OWN = Choice(ROBOT, 0.0, 1.2)
K, C = np.geomspace(100, 3200, 5), np.geomspace(0.3, 15, 4)
MARGIN = np.maximum(7 - K / 100 - C[:, None], 0)
MAPS = Demands(
    MARGIN,
    K / 50 + C[:, None],
    0.1 / np.log(K) / (1 + C[:, None]),
    np.where(MARGIN > 0, 0, K / 1e4 + C[:, None] / 100),
)


def row(name, v, flights=0, counted=0.0):
    return Ride(name, v, 3.1, 2.2, 0.02, counted / 2 + 1e-9, counted, flights, 1.5 * counted)


ROWS = (row("as it is", 1.2, 4, 0.02), row("as it is", 5, 8, 0.1), row("at every speed", 1.2))


def look(robot, critical=(), lost=(False,), margin=-2.5, asked=ASKED):
    """A Candidate."""
    worst = Demands(*np.array([max(margin, 0), 16.0, 0.036, 0.44]).reshape(4, 1, 1))
    regimes = Regimes([asked[0], *critical, asked[-1]], lost)
    return Candidate(robot, dict.fromkeys(asked, margin), worst, regimes)


CANDIDATES = {
    "as it is": look(ROBOT, [0.44, 7.9], [False, True, False]),
    "contact": look(SOFT, margin=0.3),
    "at every speed": look(WIDE.robot, margin=0.7),
}


def plain(text):
    """A text without its no-break spaces."""
    return text.replace("\xa0", " ")


def conclude(**changed):
    found = Findings(LEAST, RESERVED, WIDE, 0.71, Exclusion(-4.9, 433, 3, 2.2, 425), CANDIDATES)
    return plain(part.conclusions(found._replace(**changed)))


@pytest.mark.parametrize("k", STIFFNESSES)
def test_sentences_about_any_spring_are_sound(k):
    robot = Robot(k, k)
    candidates = CANDIDATES | {"as it is": look(robot, [0.44, 7.9], [False, True, False])}
    least = {
        "as thought": {"as it is": -2, "contact": 0.3},
        "k less": {"as it is": 1, "contact": 2},
    }
    found = Exclusion(-4.9, 433, 3, 2.2, 425)
    texts = [
        part.filter_table(robot, ASKED),
        *part.gains_caption(ASKED, 0.214),
        *part.ripples_caption([0.3, 6]),
        part.cost(5184, 0.0002),
        part.best_table(MAPS, K, C, 0.0165),
        *part.demands_caption(candidates, MAPS, K, C),
        *part.front_caption(110, 270),
        part.beaten(robot, []),
        part.beaten(robot, [(700, 3)]),
        part.choice_table(candidates, 0.0165),
        part.rest_note(fitted(k, preload=1.5, curvature=2.0), robot),
        part.needed(robot, LEAST, ASKED),
        part.needed(robot, OWN, ASKED, 0.71),
        part.exclusion_words(found, 433, 3200, ASKED, k),
        *part.margins_caption(candidates),
        part.between(candidates),
        part.robust_table(least),
        part.robust_words(least, "as it is"),
        part.drive_links(candidates, Family(robot, GaussianBump()).ranges, 1.2),
        *part.rough_caption("C", 5, (0.1, 0.0)),
        part.rough_table(ROWS),
        part.rough_words(ROWS, "C", 6),
        part.short_waves({1.2: 0.997, 5: 0.01}, 0.353),
        *part.rms_caption(list(candidates), list("ABCD")),
        part.conclusions(Findings(LEAST, RESERVED, WIDE, 0.71, found, candidates)),
        part.rough_conclusion(ROWS),
    ]
    for text in texts:
        assert not faults(text)


def test_the_table_of_the_filter_says_what_the_comb_leaves():
    table = plain(part.filter_table(ROBOT, [0.214 * np.sqrt(2 * 793 / 1.456) / np.pi]))
    heave = table.splitlines()[2].split("|")[3]
    assert float(heave) == pytest.approx(abs(np.cos(np.pi / 2)), abs=0.02)


def test_an_overdamped_mode_has_no_wavelength_to_swing_over():
    table = part.filter_table(fitted_with(ROBOT, 793, 60), [1.2])
    assert "swings" not in table


def test_the_best_in_each_criterion_are_the_best_of_the_map():
    lines = plain(part.best_table(MAPS, K, C, 0.0165)).splitlines()[2:]
    most, least, short = (line.split("|") for line in lines)
    assert float(most[2]) == 100 and float(most[3]) == 0.3
    assert float(least[2]) == 100 and float(short[2].replace(" ", "")) == 3200


@pytest.mark.parametrize(
    ("better", "words"),
    [
        ([], "is not beaten: none of the map"),
        ([(700, 2.4)], "by one suspension of the map in *all* three, for example by 700 N/m"),
        ([(700, 2.4)] * 12, "by 12 suspensions"),
    ],
)
def test_whether_the_present_suspension_is_beaten(better, words):
    assert words in plain(part.beaten(ROBOT, better))


def test_after_a_loss_no_margin_is_told():
    table = plain(part.choice_table(CANDIDATES, 0.0165))
    assert "| as it is | 793 | 1.50 | lost | lost | lost | lost |" in table and "2.5" not in table
    assert "| contact | 277 | 1.57 | 0.30 |" in table and "16.0" in table and "44 %" in table
    lost = plain(part.robust_table({"thought": {"it": -24.58, "other": -0.001}}))
    assert "| thought | lost | 0.00 |" in lost


def test_maps_say_where_contact_is_kept():
    alt = plain(part.demands_caption(["now"], MAPS, K, C).alt)
    kept = MARGIN > 0
    assert (
        f"kept on {100 * kept.mean():.0f} % of the map, up to {K[kept.any(axis=0)][-1]:.0f}" in alt
    )
    none = MAPS._replace(margin=0 * MARGIN)
    assert "Contact is kept nowhere" in part.demands_caption(["now"], none, K, C).alt
    assert "lost, " in part.best_table(none, K, C, 0.0165)
    assert "None of them keep" in part.front_caption(0, 9).text


def test_a_preload_that_the_readings_prove_is_told():
    assert part.rest_note(fitted(793), ROBOT) == ""
    note = plain(part.rest_note(fitted(793, preload=1.5), ROBOT))
    load = ROBOT.m * ROBOT.g / 2
    assert f"rests at {1000 * (load - 1.5) / 793:.1f} mm" in note


@pytest.mark.parametrize(
    ("least", "reserve", "words"),
    [
        (LEAST, 0, "springs of 277 N/m in place of 793 N/m, softer"),
        (LEAST, 0, "1.57 N s/m in place of 1.50 N s/m, stronger; distance 1.05"),
        (Choice(fitted_with(ROBOT, 900, 1.2), 0.2, 0), 0, "in place of 793 N/m, stiffer"),
        (Choice(fitted_with(ROBOT, 900, 1.2), 0.2, 0), 0, "in place of 1.50 N s/m, weaker"),
        (RESERVED, 0.714, "with 0.71 N to spare"),
        (OWN, 0, "No change is needed"),
        (None, 0, "No suspension of the grid"),
    ],
)
def test_the_change_that_is_needed(least, reserve, words):
    assert words in plain(part.needed(ROBOT, least, ASKED, reserve))


@pytest.mark.parametrize(
    ("found", "own", "words"),
    [
        (Exclusion(-4.9, 433, 3, 2.2, 425), 793, "**No:** to reach zero"),
        (Exclusion(-4.9, 433, 3, 1.1, 425), 793, "too coarse to say more"),
        (Exclusion(0.4, 433, 3, -1, 425), 793, "**Yes,** with 433 N/m and 3.00 N s/m"),
        (Exclusion(-4.9, 433, 3, 2.2, 425), 250, "it rests beyond them"),
    ],
)
def test_what_a_spring_of_the_measured_length_can_do(found, own, words):
    text = plain(part.exclusion_words(found, 433, 3200, ASKED, own))
    assert words in text and ("rests beyond" in text) == (own < 433)


def test_margins_without_and_with_critical_speeds():
    both = {"a": look(ROBOT, [0.44], [False, True]), "b": look(SOFT, lost=[True])}
    alt = plain(part.margins_caption(both).alt)
    words = plain(part.between(both))
    for text in (alt, words):
        assert "kept up to 0.440 m/s and lost from there on" in text
        assert "lost at every speed" in text


@pytest.mark.parametrize(
    ("margins", "words"),
    [
        ((1, 2), "keeps contact at the asked speeds in every case"),
        ((-1, -2), "loses contact at an asked speed in every case"),
        ((-1, 2), "in one of the two cases: first"),
        ((-1e-12, 2), "keeps contact at the asked speeds in every case"),
    ],
)
def test_what_a_suspension_survives(margins, words):
    least = {case: {"it": m} for case, m in zip(("first", "second"), margins)}
    assert words in plain(part.robust_words(least, "it"))


def test_links_lead_to_what_the_sliders_reach():
    reach = Family(ROBOT, GaussianBump()).ranges
    text = part.drive_links({"this": look(SOFT), "that": look(WIDE.robot)}, reach, 1.2)
    assert "[this](../notebooks/12-drive.ipynb#explore:v=1.2&k=277&c=1.57&motion=flying)" in text
    assert "That: beyond the end" in text and "[that]" not in text
    alone = part.drive_links({"that": look(WIDE.robot)}, reach, 1.2)
    assert alone.startswith("That: beyond")


def test_a_ride_without_flights_is_told_as_such():
    caption = part.rough_caption("C", 5, (0, 0))
    assert "never reach zero" in caption.alt and "Shaded" not in caption.text
    assert "zero in shaded" in part.rough_caption("C", 5, (0, 0.1)).alt
    words = plain(part.rough_words(ROWS, "C", 6))
    assert "“as it is” flies at 1.2 and 5 m/s, 12 times in all; “at every speed” never" in words
    once = plain(part.rough_words([row("it", 1.2, 4)], "C", 6))
    assert "“it” flies at 1.2 m/s." in once


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({}, "springs of 277 N/m, 2.9 times softer, and almost the same dampers, 1.57 N s/m"),
        (
            {"least": Choice(fitted_with(ROBOT, 900, 3), 1, 0)},
            "1.1 times stiffer, and dampers of 3",
        ),
        ({"least": OWN}, "for these its suspension may stay"),
        ({"least": None}, "No suspension of those tried keeps contact"),
        ({}, "rests within the measured displacements all lose contact."),
        (
            {"excluded": Exclusion(0.3, 433, 3, -1, 425)},
            "within the measured displacements can do it",
        ),
        ({}, "256 N/m buys a reserve of 9.9 % of the load at rest, hence a bump that may be 11 %"),
        ({"reserved": OWN}, "The robot's margin, 1.20 N, is a reserve"),
        ({"reserved": None}, "A reserve is not to be had"),
        ({}, "from 0.25 to 10 m/s it takes 161 N/m."),
        (
            {"candidates": CANDIDATES | {"at every speed": look(WIDE.robot, [2, 3], [0, 1, 0])}},
            "even that loses contact between the speeds",
        ),
        ({}, "Ask for a range of speeds, not for four: from"),
        ({"wide": None}, "no suspension of those tried keeps contact with that reserve"),
    ],
)
def test_an_engineers_sentences(changed, words):
    text = conclude(**changed)
    assert words in text and not faults(text)
    assert [line[0] for line in text.splitlines()] == list("1234")


@pytest.mark.parametrize(
    ("rides", "words"),
    [
        (ROWS, "“as it is” flies 12 times and “at every speed” never"),
        ([*ROWS, row("at every speed", 5, 1)], "“at every speed” one time"),
        (ROWS[2:], "makes no difference"),
    ],
)
def test_what_the_choice_changes_on_a_rough_road(rides, words):
    assert words in plain(part.rough_conclusion(rides))


def test_parts_of_the_time_are_never_rounded_to_nothing():
    table = plain(part.rough_table([row("it", 1.2, 0, 0.0), row("it", 5, 1, 0.5)]))
    assert "< 0.01 %" in table and "50 %" in table and "–" in table


def test_the_robot_may_have_any_base():
    assert not faults(part.filter_table(replace(ROBOT, L1=0.2, L2=0.2), ASKED))
