"""Sentences of Part VIII, for springs and robots of every kind."""

from dataclasses import replace

import numpy as np
import pytest
from cases import STIFFNESSES, faults

from suspension.choice import Choice, Demands, Exclusion, fitted_with
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
MAPS = Demands(7 - K / 100 - C[:, None], K / 50 + C[:, None], 0.1 / np.log(K) / (1 + C[:, None]))


def row(name, v, flights=0, counted=0.0):
    return {
        "name": name,
        "v": v,
        "force": 3.1,
        "acceleration": 2.2,
        "pitch": 0.02,
        "expected": counted / 2 + 1e-9,
        "counted": counted,
        "flights": flights,
        "air": 1.5 * counted,
    }


ROWS = [row("as it is", 1.2, 4, 0.02), row("as it is", 5, 8, 0.1), row("at every speed", 1.2)]


def plain(text):
    """A text without its no-break spaces."""
    return text.replace("\xa0", " ")


def conclude(**changed):
    usual = {"least": LEAST, "reserved": RESERVED, "excluded": Exclusion(-4.9, 433, 3, 2.2, 425)}
    usual |= {"wide": WIDE, "holds": True, "rows": ROWS}
    return plain(part.conclusions(ROBOT, **usual | changed, reserve=0.71, asked=ASKED))


@pytest.mark.parametrize("k", STIFFNESSES)
def test_sentences_about_any_spring_are_sound(k):
    robot = Robot(k, k)
    choices = {"as it is": robot, "contact": SOFT}
    margins = {name: dict.fromkeys(ASKED, -2.5) for name in choices}
    peaks = {name: (33.3, 0.047) for name in choices}
    critical = {"as it is": [0.44, 7.9], "contact": []}
    kept = {"as it is": [True, False, True], "contact": [True]}
    least = {
        "as thought": {"as it is": -2, "contact": 0.3},
        "k less": {"as it is": 1, "contact": 2},
    }
    texts = [
        part.filter_table(robot, ASKED),
        *part.gains_caption(ASKED, 0.214),
        *part.ripples_caption([0.3, 6]),
        part.cost(5184, 1000, 0.044),
        part.best_table(MAPS, K, C, 0.0165),
        *part.demands_caption(choices),
        *part.front_caption(110, 270),
        part.beaten(robot, None),
        part.beaten(robot, (700, 3)),
        part.choice_table(choices, margins, peaks, 0.0165),
        part.needed(robot, LEAST, ASKED),
        part.needed(robot, OWN, ASKED, 0.71),
        part.exclusion_words(Exclusion(-4.9, 433, 3, 2.2, 425), 433, 3200, ASKED, k),
        *part.margins_caption(critical, 0.25, 10),
        part.between(critical, kept, 0.25, 10),
        part.robust_table(least),
        part.robust_words(least, "as it is"),
        part.drive_links(choices, Family(robot, GaussianBump()).ranges, 1.2),
        *part.rough_caption("C", 5, (0.1, 0.0)),
        part.rough_table(ROWS),
        part.rough_words(ROWS, "C", 6),
        *part.rms_caption(list(choices), list("ABCD")),
        part.conclusions(
            robot, LEAST, RESERVED, Exclusion(-4.9, 433, 3, 2.2, 425), WIDE, True, ROWS, 0.71, ASKED
        ),
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
    [(None, "is a best compromise itself"), ((700, 2.4), "with 700 N/m and 2.40 N s/m")],
)
def test_whether_the_present_suspension_is_beaten(better, words):
    assert words in plain(part.beaten(ROBOT, better))


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
        (Exclusion(0.4, 433, 3, -1, 425), 793, "**Yes.**"),
        (Exclusion(-4.9, 433, 3, 2.2, 425), 250, "it rests beyond them"),
    ],
)
def test_what_a_spring_of_the_measured_length_can_do(found, own, words):
    text = plain(part.exclusion_words(found, 433, 3200, ASKED, own))
    assert words in text and ("rests beyond" in text) == (own < 433)


def test_margins_without_and_with_critical_speeds():
    alt = plain(part.margins_caption({"a": [0.44], "b": []}, 0.25, 10).alt)
    assert "a: zero at 0.44 m/s; b: never zero" in alt
    words = plain(
        part.between({"a": [0.44], "b": []}, {"a": [True, False], "b": [False]}, 0.25, 10)
    )
    assert "kept up to 0.440 m/s and lost from there on" in words
    assert "lost at every speed" in words


@pytest.mark.parametrize(
    ("margins", "words"),
    [
        ((1, 2), "keeps contact at the four speeds in every case"),
        ((-1, -2), "loses contact at one of the four speeds in every case"),
        ((-1, 2), "in one case of 2: first"),
        ((-1e-12, 2), "keeps contact at the four speeds in every case"),
    ],
)
def test_what_a_suspension_survives(margins, words):
    least = {case: {"it": m} for case, m in zip(("first", "second"), margins)}
    assert words in plain(part.robust_words(least, "it"))


def test_links_lead_to_what_the_sliders_reach():
    reach = Family(ROBOT, GaussianBump()).ranges
    text = part.drive_links({"this": SOFT, "that": WIDE.robot}, reach, 1.2)
    assert "[this](../notebooks/09-drive.ipynb#explore:v=1.2&k=277&c=1.57&motion=flying)" in text
    assert "That: beyond the end" in text and "[that]" not in text
    alone = part.drive_links({"that": WIDE.robot}, reach, 1.2)
    assert alone.startswith("That: beyond")


def test_a_ride_without_flights_is_told_as_such():
    caption = part.rough_caption("C", 5, (0, 0))
    assert "never reach zero" in caption.alt and "Shaded" not in caption.text
    assert "zero in shaded" in part.rough_caption("C", 5, (0, 0.1)).alt
    words = plain(part.rough_words(ROWS, "C", 6))
    assert "“as it is” flies at 1.2 and 5 m/s, 12 times in all" in words
    assert "“at every speed” never flies" in words


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
        ({}, "all lose contact, by 4.9 N and more"),
        (
            {"excluded": Exclusion(0.3, 433, 3, -1, 425)},
            "within the measured displacements can do it",
        ),
        ({}, "256 N/m buys a reserve of 9.9 % of the load at rest, hence a bump that may be 11 %"),
        ({"reserved": OWN}, "The robot's margin, 1.20 N, is a reserve"),
        ({"reserved": None}, "A reserve is not to be had"),
        ({}, "from 0.25 to 10 m/s it takes 161 N/m."),
        ({"holds": False}, "even that loses contact between the speeds"),
        ({"wide": None}, "no suspension of those tried keeps contact with that reserve"),
        ({}, "“as it is” flies 12 times and “at every speed” never"),
        ({"rows": [*ROWS, row("at every speed", 5, 1)]}, "“at every speed” one time"),
        ({"rows": ROWS[2:]}, "makes no difference"),
    ],
)
def test_an_engineers_five_sentences(changed, words):
    text = conclude(**changed)
    assert words in text and not faults(text)
    assert [line[0] for line in text.splitlines()] == list("12345")


def test_parts_of_the_time_are_never_rounded_to_nothing():
    table = plain(part.rough_table([row("it", 1.2, 0, 0.0), row("it", 5, 1, 0.5)]))
    assert "< 0.01 %" in table and "50 %" in table and "–" in table


def test_the_robot_may_have_any_base():
    assert not faults(part.filter_table(replace(ROBOT, L1=0.2, L2=0.2), ASKED))
