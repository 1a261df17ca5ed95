"""Sentences of Part VIII, one branch after another; and nothing that no sentence may contain."""

from functools import cache

import numpy as np
import pytest
from cases import DELTA_MAX, faults, fitted
from helpers import plain

from suspension.measured import Findings, Study, follow_speed, joint_draws, zero_speeds
from suspension.report import measured as part
from suspension.report.words import Caption
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.spring_law import SpringLaw
from suspension.sweep import Drive, drive

BUMP = GaussianBump()
ASKED = (0.25, 10)
LAWS = ("line", "parabola", "rubber stop", "metal stop")
FITS = {
    "linear": fitted(793),
    "soft": fitted(250),
    "stiff": fitted(2300),
    "curved": fitted(667, preload=1.5, curvature=4.0),
    "bent": fitted(1000, preload=-0.5, curvature=-3.0),
}
each_fit = pytest.mark.parametrize("name", FITS)


def laws_of(beta, k):
    line = SpringLaw(0 * beta[0], beta[1], 0 * beta[2], DELTA_MAX)
    curved = [SpringLaw(*beta, DELTA_MAX, stop) for stop in (0, 10 * k, 1000 * k)]
    return dict(zip(LAWS, [line, *curved]))


@cache
def everything(name):
    """Robot, laws, runs and draws of a fit."""
    fit = FITS[name]
    robot = Robot(fit.stiffness, fit.stiffness)
    laws = laws_of(fit.beta, fit.stiffness)
    runs = {law: drive(robot, BUMP, ASKED, law=laws[law]) for law in laws}
    beta = joint_draws(fit, 4)
    drawn = {
        law: drive(robot, BUMP, ASKED, law=many[:, None])
        for law, many in laws_of(beta, fit.stiffness).items()
    }
    return fit, robot, laws, runs, drawn


def run(*margins, compression=0.01):
    """A Drive with such margins; what is not positive is a loss of the front wheel at 0.2 m."""
    margins = np.maximum(np.array(margins, dtype=float), 0)
    lost = np.where(margins > 0, np.inf, 0.2)
    wheel, some = np.where(margins > 0, 0, 2), np.full_like(margins, compression)
    air = np.array([0 * some, np.where(margins > 0, 0, 0.05)])
    felt = np.where(margins > 0, 2.0, 20.0)
    return Drive(margins, lost, wheel, felt, some, 0 * some, 0 * some, air, (air > 0).astype(int))


def draws(*columns, compression=0.01):
    """A Drive of draws, a column for each speed."""
    return run(*np.transpose(columns), compression=compression)


# --- nothing that no sentence may contain ---------------------------------------------------------


@pytest.mark.slow
@each_fit
def test_all_texts_are_sound(name):
    fit, robot, laws, runs, drawn = everything(name)
    eigenvalues = {"no stop": robot.eigenvalues, "stop": 30 * robot.eigenvalues}
    speeds = np.geomspace(0.3, 25, 25)
    critical = {law: zero_speeds(robot, laws[law], BUMP, speeds)[0] for law in LAWS[:3:2]}
    few = laws_of(joint_draws(fit, 2), fit.stiffness)
    findings = {}
    for law in LAWS:
        at = critical.get(law, [])
        followed = [follow_speed(robot, few[law], BUMP, v) for v in at]
        findings[law] = Findings(runs[law], drawn[law], at, followed)
    study = Study(ASKED, DELTA_MAX, findings)
    texts = [
        *part.law_caption(fit, laws, 0.54, 2.1),
        part.statics_table(laws, robot),
        part.verdict_table(ASKED, runs),
        part.verdict_sentence(ASKED, runs),
        part.which_turn(ASKED, runs),
        part.which_stay(critical),
        part.how_it_grows([1, 10, 100], [np.array([2.0, 5.0, 15.0])]),
        part.geometry_sentence(ASKED, runs, runs),
        *part.margins_caption(critical),
        part.survival_sentence(critical),
        *part.run_caption(10, {"line": (np.arange(3), np.arange(3) / 99, np.arange(3))}, 0.0165),
        part.limit_table(eigenvalues, 0.001),
        part.power_table([0.1, 0.5], fit.power(0, [0.1, 0.5]), [1.0, 5.0]),
        part.draws_sentence(4, 4, 2, True),
        part.critical_table(study),
        part.sign_table(study),
        part.how_many_signed(study),
        part.conclusions(study),
    ]
    for text in texts:
        assert text and not faults(text)


# --- the law and the rest -------------------------------------------------------------------------


def test_the_caption_says_whether_the_line_follows_the_readings():
    assert "hardly differ" in part.law_caption(FITS["linear"], LAWS, 0.5, 2).text
    assert "only the line leaves" in part.law_caption(FITS["curved"], LAWS, 0.5, 2).text
    assert "does not go there" in part.law_caption(FITS["linear"], LAWS, 0.5, 0.9).text
    assert isinstance(part.law_caption(FITS["linear"], LAWS, 0.5, 0.9), Caption)


def test_laws_are_counted():
    for n, words in ((2, "two laws"), (3, "three laws"), (4, "four laws")):
        names = LAWS[:n]
        caption = part.law_caption(FITS["linear"], names, 0.5, 2).text
        assert caption.startswith(f"{words.capitalize()} for one spring.")
        critical = dict.fromkeys(names, (0.4,))
        assert f"against speed on {words}." in part.margins_caption(critical).text
        laws = {name: Findings(run(5.0), draws(np.full(128, 5.0)), [], []) for name in names}
        text = part.conclusions(Study((1,), DELTA_MAX, laws))
        assert f"the choice among the {words} changes" in text
        assert f"left open by these {words}." in text


def test_rest_beyond_the_readings_is_told():
    for name, beyond in (("linear", False), ("soft", True)):
        fit = FITS[name]
        robot, laws = Robot(fit.stiffness, fit.stiffness), laws_of(fit.beta, fit.stiffness)
        text = part.statics_table(laws, robot)
        assert ("rests beyond" in text) == beyond == ("the metal stop. With a stop" in text)


def test_laws_that_are_alike_at_rest_share_a_row():
    fit = FITS["curved"]
    rows = part.statics_table(laws_of(fit.beta, fit.stiffness), Robot(667, 667)).splitlines()[2:]
    names = [row.split("|")[1].strip() for row in rows]
    assert names == ["line", "parabola, rubber stop and metal stop"]


# --- verdicts -------------------------------------------------------------------------------------


def test_the_verdicts_are_compared_with_those_of_the_line():
    same = {"line": run(5, -1), "stop": run(4, -9)}
    assert "the same on every law" in part.verdict_sentence(ASKED, same)
    assert "  " not in part.verdict_sentence(ASKED, same)
    turned = part.verdict_sentence(ASKED, {"line": run(5, 1), "stop": run(4, -9)})
    assert "At 0.25 m/s every law" in plain(turned)
    assert "At 10 m/s contact is kept on the line and **lost** on the stop." in plain(turned)
    back = part.verdict_sentence(ASKED, {"line": run(-5, -1), "stop": run(4, 9)})
    assert "At 0.25 and 10 m/s contact is lost on the line and **kept** on the stop." in plain(back)
    assert "every law" not in back


@pytest.mark.parametrize(
    ("line", "stop", "words"),
    [
        ((5, -1), (4, -9), "**At none.**"),
        ((5, 1), (4, -9), "**At the fast ones, to lost:** 10 m/s."),
        ((5, 1), (-4, 9), "**At the slow ones, to lost:** 0.25 m/s."),
        ((5, -1), (4, 9), "**At the fast ones, to kept:** 10 m/s."),
        ((5, 1), (-4, -9), "**At the slow and the fast ones, to lost:** 0.25 and 10 m/s."),
        (
            (5, -1),
            (-4, 9),
            "**At the slow ones, to lost:** 0.25 m/s. **At the fast ones, to kept:** 10 m/s.",
        ),
    ],
)
def test_which_verdicts_turn_is_answered(line, stop, words):
    assert plain(part.which_turn(ASKED, {"line": run(*line), "stop": run(*stop)})) == words


def test_a_table_tells_where_contact_is_lost():
    table = plain(part.verdict_table(ASKED, {"line": run(5, -1)}))
    assert "kept, 5.00 N" in table and "lost, 0.2000 m" in table
    assert "always the front wheel" in table and "*kept*" in table and "*lost*" in table
    both = run(-5, -1)
    both.wheel[:] = 1, 2
    table = plain(part.verdict_table(ASKED, {"line": both}))
    assert "lost, rear, 0.2000 m" in table and "lost, front, 0.2000 m" in table
    assert "always" not in table and "*kept*" not in table
    assert "*lost*" not in part.verdict_table(ASKED, {"line": run(5, 1)})


def test_the_full_geometry_turns_a_verdict_or_does_not():
    runs = {"line": run(5, -1)}
    same = plain(part.geometry_sentence(ASKED, runs, {"line": run(5.5, -1)}))
    assert "no verdict turns. Where contact is kept the margin moves by at most 0.50 N." in same
    turned = part.geometry_sentence(ASKED, runs, {"line": run(5, 1)})
    assert "turns at 10 m/s (line)" in plain(turned)
    lost = {"line": run(-5, -1)}
    assert part.geometry_sentence(ASKED, lost, lost).endswith("no verdict turns.")


@pytest.mark.parametrize(
    ("line", "other", "words"),
    [
        ([], [], "in the range, and no other law has one."),
        ([], [3.0], "in the range; there are some on the stop."),
        ([0.4, 8.0], [0.41, 8.1], "Every critical speed of the line is there"),
        ([0.4, 8.0, 20.0], [0.41, 8.1], "only 0.4 and 8 m/s stay on all laws; 20 m/s belongs to"),
        ([0.4, 8.0], [9.0], "none stays on all laws; 0.4 and 8 m/s belong to"),
        ([0.4, 8.0], [0.4], "only 0.4 m/s stays on all laws; 8 m/s belongs to"),
    ],
)
def test_critical_speeds_stay_or_go(line, other, words):
    text = plain(part.survival_sentence({"line": np.array(line), "stop": np.array(other)}))
    assert words in text
    assert not faults(text)


@pytest.mark.parametrize(
    ("line", "other", "words"),
    [
        ([], [3.0], "**The line has none in the range.**"),
        ([0.4, 8.0], [0.41, 8.1], "**All of them.**"),
        ([0.4, 8.0], [3.0], "**Not one.**"),
        ([0.4, 8.0, 20.0], [0.41], "**The slow ones:** 0.4 m/s, one of three."),
        ([0.4, 8.0, 20.0], [8.1, 20.1], "**The fast ones:** 8 and 20 m/s, two of three."),
        ([0.4, 8.0, 20.0], [8.1], "**Some of them:** 8 m/s, one of three."),
    ],
)
def test_which_critical_speeds_stay_is_answered(line, other, words):
    critical = {"line": np.array(line), "stop": np.array(other)}
    assert plain(part.which_stay(critical)) == words


@pytest.mark.parametrize(
    ("powers", "words"),
    [
        ([], "**No stop is met at these speeds.**"),
        (
            [0.5, 0.48],
            "**Like its root:** over the last factor of ten the acceleration goes",
        ),
        ([0.5, 0.48], "to the power 0.48 to 0.50."),
        ([1.0], "**In proportion to it:**"),
        ([0.02], "**Up to a ceiling:**"),
        ([0.5, 0.2], "**In none of these ways yet:**"),
        ([0.4, -0.25], "to the power −0.25 to 0.40."),
    ],
)
def test_how_the_acceleration_grows_is_answered(powers, words):
    ratio = np.geomspace(0.1, 1e4, 26)
    felt = [np.where(ratio < 10, 3.0, 3.0 * (ratio / 10) ** p) for p in powers]
    text = part.how_it_grows(ratio, felt)
    assert words in text and not faults(text)


def test_the_stiffness_of_the_stop_matters_or_does_not():
    assert "every stop that was tried" in part.stiffness_sentence({1.2: []})
    turn = plain(part.stiffness_sentence({1.2: [], 10: [0.5793]}))
    assert (
        "At 10 m/s it turns where the stop is 0.579 times as stiff" in turn and "At 1.2 m/s" in turn
    )
    assert "the same" not in part.stiffness_sentence({10: [2.0, 30.0]})
    assert not faults(part.stiffness_caption([0.1, 1, 10], {10: [2, 1, 3]}).alt)


# --- what it costs --------------------------------------------------------------------------------


def test_the_problems_step_is_stable_on_the_stop_or_is_not():
    slow, fast = np.array([-2 + 30j, -2 - 30j]), np.array([-2 + 9000j, -2 - 9000j])
    assert "**unstable**" not in part.limit_table({"none": slow, "stop": 9 * slow}, 0.001)
    assert "**unstable**" in part.limit_table({"none": slow, "stop": fast}, 0.001)


def test_the_caption_tells_the_observed_orders():
    caption = part.order_caption(10, {"rubber stop": 2.1, "metal stop": 1.9})
    for text in caption:
        assert "2.1 (rubber stop) and 1.9 (metal stop)" in text and not faults(text)
        assert "no order" not in text
    unread = part.order_caption(10, {"rubber stop": 2.1}, ["no stop"]).text
    assert "With no stop the error is near" in unread and "no order can be read" in unread
    assert not faults(unread) and not faults(part.order_caption(10, {}, ["metal stop"]).text)


# --- how well it is known -------------------------------------------------------------------------


def test_draws_that_are_no_springs_are_told():
    assert "every one" in part.draws_sentence(8, 8, 4, True)
    assert "followed for the first 4 of them" in part.draws_sentence(8, 8, 4, True)
    assert "3 are left out" in part.draws_sentence(5, 8, 6, True)
    assert "the first 5 of them" in part.draws_sentence(5, 8, 6, True)
    assert "contradict the line" in part.draws_sentence(8, 8, 4, False)
    assert "contradict" not in part.draws_sentence(8, 8, 4, True)


def test_a_curvature_is_noticed_or_not():
    rows = plain(part.power_table([0.26, 1.1], [0.1776, 0.99999], [2.5, 9.87])).splitlines()
    assert rows[2:] == ["| 0.26 | 17.76 % | 2.5 |", "| 1.1 | > 99.99 % | 9.9 |"]
    assert "no scatter" in part.power_table([0, 0], [0.05, 0.05], [0, 0])


def study_of(line, stop, critical=None, compression=0.02, spread=0.05, n=128, asked=ASKED):
    """Two laws with such margins at the asked speeds, with n draws that scatter."""
    scatter = np.linspace(-spread, spread, n)
    laws = {}
    for name, margins in (("line", line), ("stop", stop)):
        at = (critical or {}).get(name, [])
        laws[name] = Findings(
            run(*margins, compression=compression),
            draws(*(m + scatter for m in margins)),
            at,
            [np.full(n, v) for v in at],
        )
    return Study(asked, DELTA_MAX, laws)


def test_shares_claim_no_more_than_the_draws_can_tell():
    table = plain(part.sign_table(study_of((5, 0.03), (5, -9))))
    assert "| 0.25 | kept, 4.95 to 5.05 N | kept, 4.95 to 5.05 N | **kept** |" in table
    assert "| 10 | 20 % lost | lost | **open** |" in table
    assert "If 128 draws agree, up to 2.3 % of doubt is left" in table
    few = plain(part.sign_table(study_of((5,), (5,), asked=(1,), n=64)))
    assert "If 64 draws agree, up to 4.6 % of doubt is left" in few and "**open**" in few


@pytest.mark.parametrize(
    ("line", "stop", "word"),
    [(1, 1, "**kept**"), (1, -1, "**open**"), (-1, -1, "**lost**"), (0.03, 1, "**open**")],
)
def test_a_verdict_is_signed_or_open(line, stop, word):
    assert word in part.sign_table(study_of((line,), (stop,), asked=(10,))).splitlines()[2]


def test_critical_speeds_have_the_interval_of_the_draws_in_which_they_are():
    critical = {"line": np.array([0.4, 8.0]), "stop": np.array([0.41])}
    text = plain(part.critical_table(study_of((1, 1), (1, 1), critical)))
    assert "| stop | 0.410 | 0.410 to 0.410 |" in text.replace("0.4100", "0.410")
    assert "found" not in text  # in all draws
    alike = {"line": np.array([0.4]), "stop": np.array([0.4])}
    assert "| line and stop | 0.4000 |" in part.critical_table(study_of((1, 1), (1, 1), alike))
    assert part.critical_table(study_of((1, 1), (1, 1))).startswith("No law")
    study = study_of((1, 1), (1, 1), {"line": [8.0]})
    study.line.followed[0][:] = np.nan
    assert "| – | 0 of 128" in part.critical_table(study)
    assert not faults(part.critical_table(study))
    study.line.followed[0][:] = 7.8  # what was followed is another critical speed
    assert "| 8.000 | – | 128 of 128" in part.critical_table(study)


def conclude(*margins, **how):
    text = plain(part.conclusions(study_of(*margins, **how)))
    assert [line[0] for line in text.splitlines()] == list("12345") and not faults(text)
    return text


def test_the_conclusions_follow_from_the_tables():
    critical = {"line": np.array([0.4, 8.0]), "stop": np.array([0.41])}
    text = conclude((5, 1), (5, -30), critical)
    assert "Contact is kept at 0.25 m/s" in text
    assert "At 10 m/s the verdict is **open**: it is decided by" in text
    assert "only 0.4 m/s stays" in text and "8 m/s belongs" in text
    assert "The law decides and the readings do not: at 10 m/s" in text
    assert "a run at 10 m/s, press the spring" in text and "no reading below it" in text
    alike = conclude((5, -1), (5, -1), critical)
    assert "No verdict hangs on what it meets there" in alike and "press the spring" not in alike
    text = conclude((5, -1), (5, -1), {"line": [0.4], "stop": [0.4]}, compression=0.01)
    assert "no reading below it" not in text
    assert "kept at 0.25 m/s and lost at 10 m/s" in text
    assert "left open" in text and "Every critical speed" in text
    assert "Neither the law nor the scatter" in text and "does not matter there" in text
    text = conclude((0.01, 0.01), (0.02, 0.02), compression=0.01)
    assert "None of the asked verdicts can be signed" in text
    assert "too near to zero" in text and "no critical speed in the range" in text
    assert "The readings decide and the law does not" in text
    assert "Law and readings both decide" in conclude((0.01, 5), (-0.01, 5))
    # Both laws lose contact in a part of the draws: not the stop, but the scatter leaves it open.
    assert "too near to zero" in conclude((5, 0.01), (5, 0.01), compression=0.02)
    both = conclude((0.01, 5), (0.01, -5))
    assert "At 10 m/s the verdict is **open**: it is decided by" in both
    assert "At 0.25 m/s the verdict is **open**: the margin" in both


@pytest.mark.parametrize(
    ("line", "stop", "words"),
    [
        ((5, 1), (5, 1), "**At all two.**"),
        ((5, 1), (5, -30), "**At one of them:** 0.25 m/s."),
        ((0.01, 1), (0.01, -30), "**At fewer:** none."),
    ],
)
def test_how_many_verdicts_are_signed_is_answered(line, stop, words):
    assert plain(part.how_many_signed(study_of(line, stop))) == words


def test_one_of_three_is_fewer():
    study = study_of((5, 1, 1), (5, -30, -30), asked=(0.25, 5, 10))
    assert plain(part.how_many_signed(study)) == "**At fewer:** 0.25 m/s."
