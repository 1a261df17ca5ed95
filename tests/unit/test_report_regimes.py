"""Sentences of Parts V and VI and the landing page, for springs and robots of every kind."""

import re

import numpy as np
import pytest
from cases import DELTA_MAX, faults, fitted
from helpers import plain, shaded
from matplotlib import pyplot as plt

from suspension import contact
from suspension.branches import End
from suspension.contact import Regimes
from suspension.figures import plot_margin
from suspension.report import regimes as part
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.travel import Balance, Overtravel
from suspension.uncertainty import CriticalSpeed

LOW, HIGH = 0.1, 30
KEPT, LOST = Regimes([LOW, HIGH], [False]), Regimes([LOW, HIGH], [True])
RISES = Regimes([LOW, 0.5, HIGH], [False, True])
FALLS = Regimes([LOW, 0.5, HIGH], [True, False])
WINDOW = Regimes([LOW, 0.436, 7.85, 20.3, HIGH], [False, True, False, True])
HAIR = Regimes([LOW, 0.40178, 0.444945, 0.445960, HIGH], [False, True, False, True])
KINDS = {"kept": KEPT, "lost": LOST, "rises": RISES, "falls": FALLS}
KINDS |= {"window": WINDOW, "hair": HAIR}
each_kind = pytest.mark.parametrize("regimes", KINDS.values(), ids=KINDS)
FAR = (
    Overtravel(0.381, 0.407, 1.096),
    Overtravel(0.410, 0.436, 1.02),
    Overtravel(0.72, HIGH, 2.14),
)
each_travel = pytest.mark.parametrize("beyond", [(), FAR[:1], FAR, [Overtravel(LOW, HIGH, 1.3)]])


def asked(*stretches):
    """Asked speeds at which a spring is compressed so far, in units of delta_max."""
    return [
        part.Asked(0.25 * 2**i, 5.59 - 10 * i, stretch, [572.83][:i], {"slope at zero": i / 10})
        for i, stretch in enumerate(stretches)
    ]


def balances(regimes):
    """One for each critical speed: thrown, pulled, thrown, ..."""
    kinds = (Balance(2, 0.02, -0.02, 7.1), Balance(1, 13.8, -13.8, 7.1))
    return [kinds[i % 2] for i in range(len(regimes.critical))]


def told_ranges(text, regimes):
    """The ranges that a text calls kept and lost, in its order: (from, to, lost), as told."""
    low, high = (f"{v:g}" for v in regimes.edges[[0, -1]])
    told, number = [], r"(\d+(?:\.\d+)?)"
    pattern = rf"(kept|lost) (?:at every speed from|(up)|from (there on)|from) ?(?:to )?{number}?"
    for word, first, last, a, b in re.findall(rf"{pattern}(?: to {number})?", text):
        start, end = (low, a) if first else (told[-1][1], high) if last else (a, b)
        told.append((start, end, word == "lost"))
    return told


@pytest.mark.slow
@pytest.mark.parametrize("k", [975, *np.geomspace(150, 4000, 39).round()])
def test_picture_caption_and_sentence_name_the_same_ranges(k):
    regimes = contact.regimes(Robot(k, k), GaussianBump(), 0.3, HIGH)
    v = np.geomspace(0.3, HIGH, 200)  # too few to see a narrow range
    ax = plot_margin(v, np.ones((2, len(v))), regimes)
    np.testing.assert_allclose(np.reshape(shaded(ax), (-1, 2)), regimes.spans(lost=True), rtol=1e-9)
    plt.close(ax.figure)
    sentence = plain(part.verdict(regimes)).split(". ")[0] + "."
    alt = plain(part.margin_caption(regimes, ()).alt)
    said = told_ranges(sentence, regimes)
    assert told_ranges(alt, regimes) == said and len(said) == len(regimes.lost)
    assert [lost for *_, lost in said] == regimes.lost.tolist()
    ends = [float(said[0][0]), *(float(end) for _, end, _ in said)]
    np.testing.assert_allclose(ends, regimes.edges, rtol=5e-3)
    assert all(start == before for (start, *_), (_, before, _) in zip(said[1:], said))
    assert (np.diff(ends) > 0).all()  # neighbours can be told apart


@each_kind
@each_travel
def test_the_verdict_tells_every_range(regimes, beyond):
    text = part.verdict(regimes, beyond)
    assert not faults(text)
    assert [lost for *_, lost in told_ranges(plain(text).split(". ")[0], regimes)] == list(
        regimes.lost
    )
    assert ("if the spring stays linear" in plain(text)) == bool(len(beyond))


@each_kind
@each_travel
def test_captions_tables_and_doubts_are_sound(regimes, beyond):
    parts = balances(regimes)
    texts = [
        *part.margin_caption(regimes, beyond, (0.25, 1.2)),
        *part.margin_caption(regimes, beyond, (1.2,)),
        *part.travel_caption(regimes, beyond, DELTA_MAX),
        *part.sensitivity_caption(regimes.critical),
        part.balance_table(regimes.critical, parts),
        part.landing_opening(regimes),
        part.doubt(regimes, beyond, DELTA_MAX, 0.15),
        part.lesson(regimes, parts),
    ]
    for text in texts:
        assert not faults(text)
        assert text


def test_the_caption_names_the_marks_that_are_drawn():
    assert part.margin_caption(KEPT, ()).text.endswith("wheel against speed.")
    one, all_of_them = part.margin_caption(RISES, ()), part.margin_caption(WINDOW, FAR, (1, 5))
    assert "*lost*: a wheel leaves" in one.text and "diamonds" in one.text
    assert "circles" not in one.text and "hatched" not in one.text
    assert all(word in all_of_them.text for word in ("*lost*", "diamonds", "circles", "hatched"))


def test_neighbouring_speeds_can_be_told_apart():
    text = part.verdict(HAIR)
    assert "kept from 0.4449 to 0.4460 m/s" in plain(text)
    assert "by a hair" in plain(text)
    assert "*safer*" not in plain(text)


def test_faster_is_safer_only_where_a_range_can_be_driven_in():
    wide = part.verdict(WINDOW)
    assert wide.count("*safer*") == 1 and "faster than 7.85 m/s" in plain(wide)
    assert "*safer*" not in plain(part.verdict(RISES))


@pytest.mark.parametrize(
    ("regimes", "words"),
    [
        (KEPT, "they do not"),
        (LOST, "at every speed"),
        (RISES, "that is the answer"),
        (FALLS, "the other way round"),
        (WINDOW, "stranger"),
    ],
)
def test_the_landing_page_promises_what_comes(regimes, words):
    assert words in part.landing_opening(regimes)


def test_one_verdict_for_all_speeds():
    assert "kept at every speed from 0.1 to 30 m/s" in plain(part.verdict(KEPT))
    for regimes in (KEPT, LOST):
        assert "one verdict holds at all speeds" in part.lesson(regimes, [])
    assert "one verdict" not in part.lesson(WINDOW, balances(WINDOW))
    assert part.balance_table([], []).startswith("There is no critical speed")
    assert not faults(part.sensitivity_caption([]).text)


def test_the_damper_is_blamed_only_where_the_spring_still_pushes():
    thrown, pulled = balances(WINDOW)[:2]
    assert "the damper pulls" not in plain(part.balance_table([0.436], [thrown]))
    assert "the body is thrown" not in plain(part.balance_table([20.3], [pulled]))
    assert "damper" not in plain(part.lesson(WINDOW, [thrown] * 3))
    assert "damper" in plain(part.lesson(WINDOW, [thrown, thrown, pulled]))


def test_what_dampers_twice_as_strong_do_is_told_of_the_robot_itself():
    text = part.stronger_dampers(WINDOW, RISES, (21.1, 10.55))
    own, twice = plain(text).splitlines()[2:]
    assert "20.3 m/s and lost from there on | 21.1 |" in own and not faults(text)
    assert twice.endswith("kept up to 0.500 m/s and lost from there on | 10.6 |")


@pytest.mark.parametrize(
    ("beyond", "words"),
    [
        ([], ""),
        ([(0.1, 30, 1.2)], "at every speed from 0.1 to 30 m/s (by up to 20 %)"),
        (
            [(0.38, 0.436, 1.1), (0.72, 30, 2)],
            "from 0.380 to 0.436 m/s (by up to 10 %) and above 0.720 m/s (up to 2.0 times as far)",
        ),
        ([(0.1, 0.5, 1.2)], "below 0.500 m/s (by up to 20 %)"),
        ([(0.1, 0.5, 1.49)], "below 0.500 m/s (by up to 49 %)"),
        ([(0.1, 0.5, 1.51)], "below 0.500 m/s (up to 1.5 times as far)"),
        (
            [(0.381, 0.407, 1.2), (0.410, 0.436, 1.1)],
            "from 0.381 to 0.436 m/s (by up to 20 %)",
        ),
        (
            [(0.381, 0.407, 1.2), (0.412, 0.436, 1.1)],
            "from 0.381 to 0.407 m/s (by up to 20 %) and from 0.412 to 0.436 m/s (by up to 10 %)",
        ),
        ([(0.05, 0.08, 1.2), (0.5, 0.6, 1.2)], "from 0.500 to 0.600 m/s (by up to 20 %)"),
    ],
)
def test_where_the_spring_goes_too_far(beyond, words):
    found = [Overtravel(*range_) for range_ in beyond]
    assert plain(part.beyond_words(KEPT, found)) == words


def test_ranges_told_as_one_have_the_larger_excess_of_the_two():
    words = "0.381 to 0.436 m/s (by up to 9.6 %) and above 0.720 m/s (up to 2.1 times as far)"
    swapped = FAR[0]._replace(times=FAR[1].times), FAR[1]._replace(times=FAR[0].times), FAR[2]
    for beyond in (FAR, swapped):
        assert plain(part.beyond_words(KEPT, beyond)) == f"from {words}"
        assert plain(part.verdict(KEPT, beyond)).endswith(
            f"further than it was measured: from {words}."
        )


def test_where_the_spring_was_not_measured_is_doubted():
    everywhere = [Overtravel(LOW, HIGH, 3.1)]
    assert "at every speed" in plain(part.doubt(LOST, everywhere, DELTA_MAX, 0.2))
    assert "No spring is compressed beyond" in plain(part.doubt(KEPT, [], DELTA_MAX, 0.2))


def test_the_bound_of_the_pitch_is_rounded_up():
    text = part.doubt(KEPT, [], DELTA_MAX, np.radians(9.12))
    assert "below 9.2 degrees" in plain(text)
    assert "differ by 0.42 %" in plain(text) and "and 1 by 1.3 %" in plain(text)


def test_a_critical_speed_that_ends_is_told_so():
    whole = CriticalSpeed(7.85, 7.35, 8.36, None, None)
    ends = CriticalSpeed(0.4449, 0.4423, 0.4461, None, End(990.4, 0.446, "pair"))
    elsewhere = CriticalSpeed(None, 0.407, 0.440, None, End(385.2, 0.44, "pair"))
    table = part.critical_table([whole], [7.846])
    assert "note" not in plain(table) and "6.4" in plain(table)
    table = part.critical_table([whole, ends, elsewhere], [7.846, 0.4521, None])
    assert "exists only for k < 990.4" in plain(table)
    assert "no confidence level" in plain(table)
    assert not faults(table)
    assert "no critical speed" in plain(part.critical_table([], []))


FIRST = CriticalSpeed(0.4363, 0.4346, 0.4381, None, None)
SECOND = CriticalSpeed(7.85, 7.35, 8.36, None, None)
GONE = CriticalSpeed(None, 0.407, 0.440, None, None)


@pytest.mark.parametrize(
    ("intervals", "full", "words"),
    [
        ([FIRST, SECOND], [0.44383, 7.8465], "geometry 0.4363 m/s moves up by 1.7 %, **out of**"),
        ([FIRST, SECOND], [0.4379, 7.9], "stays inside"),
        ([FIRST, GONE], [0.4379, None], "stays inside"),
        ([FIRST, SECOND], [None, 7], "no counterpart nearby and 7.85 m/s moves down by 11 %"),
        ([GONE], [None], "no critical speed"),
        ([], [], "no critical speed"),
    ],
)
def test_the_full_geometry_is_told_inside_and_outside_the_interval(intervals, full, words):
    text = plain(part.full_geometry(intervals, full))
    assert words in text and not faults(text)
    assert ("costs more" in text) == ("out of" in text)


@pytest.mark.parametrize(
    ("intervals", "full", "answer"),
    [
        ([FIRST, SECOND], [0.4379, 7.9], "**Each does.**"),
        ([FIRST, GONE], [0.4379, None], "**Each does.**"),
        ([FIRST, SECOND], [0.44383, 7.8465], "**Some leave it:** one of two."),
        ([FIRST, SECOND], [None, 9], "**All leave it.**"),
        ([GONE], [None], "**There is none to ask.**"),
        ([], [], "**There is none to ask.**"),
    ],
)
def test_whether_a_critical_speed_stays_inside_is_answered(intervals, full, answer):
    assert plain(part.stays_inside(intervals, full)) == answer


@pytest.mark.parametrize(
    ("after", "words"),
    [
        ([LOW, 0.446, 7.55, 8.48, HIGH], "**It falls by more,** from 20.3 to 8.48 m/s: by a f"),
        ([LOW, 0.446, 7.55, 8.48, HIGH], "factor of 2.4."),
        ([LOW, 0.446, 7.55, 10.1, HIGH], "**It is halved, too,** from 20.3 to 10.1 m/s."),
        ([LOW, 0.446, 7.55, 15, HIGH], "**It falls by less,** from 20.3 to 15.0 m/s: by a factor"),
        ([LOW, 0.446, 7.55, 25, HIGH], "**It does not fall:** it goes from 20.3 to 25.0 m/s."),
        ([LOW, 0.5, HIGH], "by a factor of 41. The window before it has closed."),
        ([LOW, HIGH], "**There is none to compare:**"),
    ],
)
def test_what_becomes_of_the_last_critical_speed_is_answered(after, words):
    verdicts = [i % 2 == 1 for i in range(len(after) - 1)]
    text = plain(part.last_speed(WINDOW, Regimes(after, verdicts)))
    assert words in text and not faults(text)
    assert ("has closed" in text) == (len(after) == 3)
    assert "has closed" not in part.last_speed(RISES, RISES)  # there was none


def by_stiffness(*speeds):
    """As if each of the readings of some data had these critical speeds, m/s."""
    stiffnesses = fitted(793).stiffnesses(7.14)
    known = [[CriticalSpeed(v, 0.97 * v, 1.03 * v, None, None) for v in each] for each in speeds]
    return list(zip(stiffnesses, known, strict=True))


@pytest.mark.parametrize(
    ("speeds", "words"),
    [
        (([0.436, 7.85], [0.437, 7.94], [0.437, 8.00]), "stays inside the interval of the slope"),
        (([0.436, 7.85], [0.437, 7.94], [0.437, 9]), "moves 7.85 m/s **out of** the interval"),
        (([0.436, 7.85], [0.437], [0.437, 8.00]), "do not even agree"),
        (([], [], []), "With none of the stiffnesses"),
    ],
)
def test_what_the_other_readings_make_of_the_critical_speeds(speeds, words):
    text = plain(part.other_readings(by_stiffness(*speeds)))
    assert words in text and not faults(text)


def test_what_rests_on_a_spring_beyond_its_range_is_marked():
    speeds = asked(0.6, 2.0)
    slow, fast = part.confidence_table(speeds).splitlines()[2:]
    assert "*" not in plain(slow) and fast.count("*") == 2
    assert "none" in plain(slow) and "572.8" in plain(fast)
    assert "| 5.59 |" in plain(slow) and "| lost* |" in plain(fast)  # after a loss only a sign
    note = part.confidence_note(speeds, 792.9)
    assert "The asterisk, at 0.5 m/s, marks what holds only **if the spring" in plain(note)
    assert "| confidence that contact is lost, with $k$ = the" in part.confidence_table(speeds)
    assert "asterisk" not in plain(part.confidence_note(asked(0.6), 792.9))
    assert not faults(slow + fast) and not faults(note)


def test_the_map_names_its_stiffness():
    caption = part.map_caption(fitted(2300).slope, [460, 4370], (0.25, 1.2), False)
    assert "slope at zero" in plain(caption.text) and "Hatched" not in plain(caption.text)
    assert not faults(caption.alt)
    assert "Hatched" in plain(part.map_caption(fitted(250).slope, [50, 475], (1.2,), True).text)


def test_the_stiffnesses_stand_side_by_side_if_their_critical_speeds_do():
    side_by_side = plain(part.consequence_table(by_stiffness([0.4, 8], [0.41, 8.1], [0.42, 8.2])))
    head, _, *rows = side_by_side.splitlines()
    assert head == "| stiffness | first (m/s) | second (m/s) |" and len(rows) == 3
    assert rows[2].endswith("| 0.420 (0.407 to 0.433) | 8.20 (7.95 to 8.45) |")
    for speeds in (([0.4, 8], [0.41], [0.42, 8.2]), ([], [], [])):
        text = plain(part.consequence_table(by_stiffness(*speeds)))
        assert "| critical speed (m/s) |" in text and not faults(text)
    pairs = by_stiffness([0.4], [0.41], [0.42])
    pairs[1][1][0] = pairs[1][1][0]._replace(dies=End(990.4, 0.446, "pair"))
    assert "exists only for k" in plain(part.consequence_table(pairs))
