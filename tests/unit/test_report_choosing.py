"""Sentences of Part X, for springs and robots of every kind."""

from dataclasses import replace

import numpy as np
import pytest
from cases import STIFFNESSES, faults, fitted
from helpers import plain

from suspension.choice import Candidate, Choice, Choices, Demands, fitted_with
from suspension.contact import Regimes
from suspension.explorer.family import Family
from suspension.report import choosing as part
from suspension.road import GaussianBump
from suspension.robot import Robot

ASKED = (0.25, 1.2, 5.0, 10.0)
ROBOT = Robot(793, 793)
SOFT = fitted_with(ROBOT, 277, 1.57)
LEAST, RESERVED = Choice(SOFT, 1.05, 0.0), Choice(fitted_with(ROBOT, 256, 1.58), 1.13, 0.71)
WIDE = Choice(fitted_with(ROBOT, 161, 1.6), 1.6, 0.71)
OWN = Choice(ROBOT, 0.0, 1.2)
STIFFEST = Choice(fitted_with(ROBOT, 280, 1.97), 1.1, 0.0)
MAP = (100, 3200), (0.3, 15)  # N/m, N s/m
HARD = Choice(fitted_with(ROBOT, 900, 3), 1, 0)
LIMIT = 0.0165  # m


def look(robot, critical=(), lost=(False,), margin=-2.5, asked=ASKED, felt=16.0, room=0.036):
    """A Candidate."""
    worst = Demands(*np.array([max(margin, 0), felt, room, 0.44]).reshape(4, 1, 1))
    regimes = Regimes([asked[0], *critical, asked[-1]], lost)
    return Candidate(robot, dict.fromkeys(asked, margin), worst, regimes)


CHOICES = {"contact": LEAST, "with a reserve": None, "at every speed": WIDE}
CANDIDATES = {
    "as it is": look(ROBOT, [0.44, 7.9], [False, True, False]),
    "contact": look(SOFT, margin=0.3, felt=9.0, room=0.051),
    "at every speed": look(WIDE.robot, margin=0.7),
}


def conclude(**changed):
    found = Choices(LEAST, RESERVED, WIDE, STIFFEST, LIMIT, CANDIDATES)
    return plain(part.conclusions(found._replace(**changed)))


@pytest.mark.parametrize("k", STIFFNESSES)
def test_sentences_about_any_spring_are_sound(k):
    robot = Robot(k, k)
    candidates = CANDIDATES | {"as it is": look(robot, [0.44, 7.9], [False, True, False])}
    least = {
        "as thought": {"as it is": -2, "contact": 0.3},
        "k less": {"as it is": 1, "contact": 2},
    }
    texts = [
        part.farthest(STIFFEST, STIFFEST, ASKED, MAP),
        part.beaten(robot, []),
        part.beaten(robot, [(700, 3)]),
        part.choice_table(CHOICES, candidates, LIMIT),
        part.rest_note(fitted(k, preload=1.5, curvature=2.0), robot),
        part.game_note(replace(robot, k2=1.2 * k), fitted(k, preload=1.5, curvature=2.0)),
        part.measured_length(STIFFEST, LIMIT),
        part.between(candidates),
        part.robust_table(least),
        part.drive_links(candidates, Family(robot, GaussianBump()).ranges, 1.2),
        part.conclusions(Choices(LEAST, RESERVED, WIDE, STIFFEST, LIMIT, candidates)),
    ]
    for text in texts:
        assert not faults(text)


@pytest.mark.parametrize(
    ("ends", "words"),
    [
        ((3200, 15), "**Where springs are soft and dampers weak**: up to 280 N/m and 1.57 N s/m."),
        ((3200, 15), "No stiffer spring and no stronger damper of this map"),
        ((280, 15), "**Where dampers are weak**: up to 1.57 N s/m. No stronger damper of this map"),
        ((3200, 1.57), "**Where springs are soft**: up to 280 N/m. No stiffer spring of this map"),
        ((280, 1.57), "with the stiffest springs of this map, and with its strongest dampers"),
    ],
)
def test_the_farthest_springs_and_dampers(ends, words):
    ends = [(low, high) for (low, _), high in zip(MAP, ends)]
    text = plain(part.farthest(STIFFEST, Choice(SOFT, 1, 0), ASKED, ends))
    assert words in text and "at 0.25, 1.2, 5 and 10 m/s" in text and not faults(text)


@pytest.mark.parametrize(
    ("k", "c", "words"),
    [
        (
            100,
            1.57,
            "its softest springs alone, 100 N/m, and with dampers up to 1.57 N s/m. Softer",
        ),
        (100, 15, "alone, 100 N/m, and with dampers up to its strongest. Softer springs were not"),
        (280, 0.3, "with springs up to 280 N/m, and with its weakest dampers alone, 0.300 N s/m."),
        (3200, 0.3, "with springs up to its stiffest, and with its weakest dampers alone"),
        (100, 0.3, "dampers alone, 0.300 N s/m. Softer springs and weaker dampers were not looked"),
    ],
)
def test_contact_at_the_lower_end_of_the_map_alone(k, c, words):
    stiffest, strongest = (Choice(fitted_with(ROBOT, k, c), 1, 0) for _ in "kc")
    text = plain(part.farthest(stiffest, strongest, ASKED, MAP))
    assert text.startswith("**Only at the edge of this map**: at 0.25, 1.2, 5 and 10 m/s contact")
    assert words in text and not faults(text)


def test_an_end_of_the_map_is_reached_within_a_thousandth():
    found = {0.9985 * 3200: "Where springs are soft", 0.9995 * 3200: "Not only where"}
    found |= {100 * 1.0015: "Where springs are soft", 100 * 1.0005: "Only at the edge"}
    for k, words in found.items():
        stiffest, strongest = (Choice(fitted_with(ROBOT, k, c), 1, 0) for c in (1, 15))
        assert words in part.farthest(stiffest, strongest, ASKED, MAP)


def test_where_no_suspension_keeps_contact_none_is_named():
    assert "**Nowhere**" in part.farthest(None, None, ASKED, MAP)


def test_the_room_after_a_lift_off_is_told_apart_from_that_before():
    pressed = [0.01, 0.02, 0.03, 0.0347]
    text = plain(part.room_note(ASKED, [0.01, 0.0365, 0.03, 0.0347], pressed, LIMIT))
    assert "reaches 2.21 at 1.2 m/s" in text and "both wheels press it is 2.10" in text
    assert not faults(text)
    assert part.room_note(ASKED, pressed, pressed, LIMIT) == ""


@pytest.mark.parametrize(
    ("kept", "words", "alt"),
    [
        ([True, False], "White line: where the least margin is zero.", "A white line parts"),
        ([True, True], "kept at all four speeds by every suspension", "contact is kept everywhere"),
        ([False], "No suspension of the map keeps contact", "contact is lost everywhere"),
    ],
)
def test_captions_of_maps_name_a_line_only_where_there_is_one(kept, words, alt):
    for caption in (part.contact_map(kept, ASKED, ["now", "then"]), part.price_map(kept, ASKED)):
        assert words in caption.text and alt in caption.alt
        assert ("White line" in caption.text) == (len(set(kept)) == 2)
        assert not faults(caption.text) and not faults(caption.alt)
    assert "more below: now and then." in part.contact_map(kept, ASKED, ["now", "then"]).text


@pytest.mark.parametrize(
    ("lost", "words"),
    [
        ([[0, 1, 1, 0], [0, 0, 0, 0]], "at these speeds, filled where contact is lost; curves"),
        ([[0, 0, 0, 0]], "at these speeds, none of which loses contact; curves"),
        ([[1, 1, 1, 1]], "at these speeds, all of which lose contact; curves"),
    ],
)
def test_the_caption_of_the_paths_says_what_circles_are(lost, words):
    names = ["as it is", "at every speed"][: len(lost)]
    caption = part.paths(names, ASKED, [np.array(one, bool) for one in lost])
    assert words in caption.text and f"Here {' and '.join(names)}." in caption.text
    assert ("softer suspension" in caption.alt) == (len(lost) == 2)
    assert "the four speeds" in caption.text
    assert not faults(caption.text) and not faults(caption.alt)


@pytest.mark.parametrize(
    ("better", "words"),
    [
        ([], "**Not one.** No suspension of the map is better than the present one, 793 N/m and"),
        (
            [(700, 2.4)],
            "**One suspension.** 700 N/m and 2.40 N s/m are better than the present one, 793 N/m",
        ),
        ([(700, 2.4)] * 2, "**Two suspensions.** 700 N/m and 2.40 N s/m, for example, are better"),
        ([(700, 2.4)] * 12, "**12 suspensions.**"),
    ],
)
def test_whether_the_present_suspension_is_beaten(better, words):
    assert words in plain(part.beaten(ROBOT, better))


def test_after_a_loss_no_margin_is_told():
    table = plain(part.choice_table(CHOICES, CANDIDATES, LIMIT))
    assert "| as it is | 793 | 1.50 | – | lost | lost | lost | lost |" in table
    assert "2.5" not in table
    assert "| contact | 277 | 1.57 | 1.05 | 0.30 |" in table and "16.0" in table and "44 %" in table
    margins = {"it": -24.58, "other": -0.001, "edge": 0.0, "kept": 1e-7}
    lost = plain(part.robust_table({"thought": margins}))
    assert "| thought | lost | lost | lost | 0.00 |" in lost
    assert lost.endswith("contact is kept by: **kept**.")


def test_who_keeps_contact_in_every_case_is_told():
    cases = {"as thought": {"one": 1.0, "other": 0.2}, "k less": {"one": 0.5, "other": -0.2}}
    assert plain(part.robust_table(cases)).endswith("contact is kept by: **one**.")
    cases["k more"] = {"one": -0.5, "other": 0.2}
    assert plain(part.robust_table(cases)).endswith("contact is kept by: **none of them**.")


def test_a_preload_that_the_readings_prove_is_told():
    assert part.rest_note(fitted(793), ROBOT) == ""
    note = plain(part.rest_note(fitted(793, preload=1.5), ROBOT))
    load = ROBOT.m * ROBOT.g / 2
    assert f"rests at {1000 * (load - 1.5) / 793:.1f} mm" in note


def test_a_game_with_another_robot_than_the_measured_one_says_so():
    straight, curved = fitted(793), fitted(793, preload=1.5)
    assert part.game_note(ROBOT, straight) == ""
    assert "**symmetric twin**" in part.game_note(replace(ROBOT, c1=2.0), straight)
    note = plain(part.game_note(ROBOT, curved))
    assert note.startswith("The readings contradict") and f"{curved.stiffness:.3g} N/m" in note
    assert part.game_note(replace(ROBOT, c1=2.0), curved).endswith(part.game_note(ROBOT, curved))


def test_a_demand_that_is_met_or_cannot_be_is_told():
    table = plain(part.choice_table(CHOICES | {"contact": OWN}, CANDIDATES, LIMIT))
    assert "“contact”: **no change is needed**" in table
    assert "“with a reserve”: **no suspension of the map** does it" in table
    assert "“at every speed”:" not in table


def test_what_a_spring_of_the_measured_length_can_do():
    assert "**no,** the spring must be longer" in part.measured_length(STIFFEST, LIMIT)
    assert "280 N/m, the robot rests at 0.51" in plain(part.measured_length(STIFFEST, 0.05))
    assert "**yes,**" in part.measured_length(STIFFEST, 0.05)
    assert "nothing to ask" in part.measured_length(None, LIMIT)


def test_margins_without_and_with_critical_speeds():
    both = {"a": look(ROBOT, [0.44], [False, True]), "b": look(SOFT, lost=[True])}
    words = plain(part.between(both))
    assert "kept up to 0.440 m/s and lost from there on" in words
    assert "lost at every speed" in words


def test_links_lead_to_what_the_sliders_reach():
    reach = Family(ROBOT, GaussianBump()).ranges
    soft = look(fitted_with(ROBOT, 100, 1))
    text = part.drive_links({"this": look(SOFT), "that": soft}, reach, 1.2)
    assert "[this](../notebooks/12-drive.ipynb#explore:v=1.2&k=277&c=1.57&motion=flying)" in text
    assert "That: beyond the end" in text and "[that]" not in text
    alone = part.drive_links({"that": soft}, reach, 1.2)
    assert alone.startswith("That: beyond")


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({}, "springs of 277 N/m, 2.9 times softer, and almost the same dampers, 1.57 N s/m"),
        (
            {"least": HARD, "candidates": CANDIDATES | {"contact": look(HARD.robot)}},
            "1.1 times stiffer, and dampers of 3",
        ),
        ({"least": OWN}, "for these its suspension may stay"),
        ({"least": None}, "No suspension of those tried keeps contact"),
        ({}, "The price is room: the largest compression goes from 2.18 to 3.09"),
        ({}, "acceleration falls from 16.0 to 9.0 m/s²"),
        (
            {"candidates": CANDIDATES | {"contact": look(SOFT, felt=17.0, room=0.03)}},
            "It saves room",
        ),
        (
            {"candidates": CANDIDATES | {"contact": look(SOFT, felt=17.0, room=0.03)}},
            "acceleration rises from 16.0 to 17.0",
        ),
        ({"least": OWN}, "Where nothing is changed, nothing is paid."),
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
