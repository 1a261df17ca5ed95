"""Sentences of Part VII, one branch after another; and nothing that no sentence may contain."""

from functools import cache

import numpy as np
import pytest
from cases import DELTA_MAX, faults, fitted

from suspension.measured import Drive, SpringLaw, drive, follow_speed, joint_draws, zero_speeds
from suspension.report import measured as part
from suspension.report.words import Caption
from suspension.road import GaussianBump
from suspension.robot import Robot

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


def plain(text):
    """A text without its no-break spaces."""
    return text.replace("\xa0", " ")


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
    runs = {law: drive(robot, laws[law], BUMP, ASKED) for law in laws}
    beta = joint_draws(fit, 4)
    drawn = {
        law: drive(robot, many[:, None], BUMP, ASKED)
        for law, many in laws_of(beta, fit.stiffness).items()
    }
    return fit, robot, laws, runs, drawn


def run(*margins, compression=0.01):
    """A Drive with such margins."""
    margins = np.array(margins, dtype=float)
    lost = np.where(margins > 0, np.inf, 0.2)
    some = np.full_like(margins, compression)
    return Drive(margins, lost, some, 0 * some, 0 * some)


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
    few = {law: laws_of(joint_draws(fit, 2), fit.stiffness)[law] for law in critical}
    followed = {
        law: [follow_speed(robot, few[law], BUMP, v) for v in critical[law]] for law in critical
    }
    texts = [
        *part.law_caption(fit, 0.54, 2.1),
        part.statics_table(laws, robot),
        part.statics_sentence(laws["line"], laws["parabola"], robot),
        part.verdict_table(ASKED, runs),
        part.verdict_sentence(ASKED, runs),
        part.angle_sentence(ASKED, runs, runs),
        *part.margins_caption(critical),
        part.survival_sentence(critical),
        part.tilted_sentence(critical["line"], 1.001 * critical["line"]),
        part.reach_table(ASKED, [0.01], [runs["line"]], [runs["metal stop"]], DELTA_MAX),
        *part.run_caption(10, {"line": (np.arange(3), np.arange(3) / 99, np.arange(3))}, 0.0165),
        part.limit_table(eigenvalues, 0.001),
        part.limit_sentence(eigenvalues, 0.001),
        *part.regions_caption(eigenvalues, (0.001, 0.004)),
        part.draws_sentence(4, 4, True),
        part.asked_table(ASKED, runs, drawn),
        part.critical_table(critical, followed),
        part.sign_table(ASKED, runs, drawn),
        part.conclusions(
            ASKED, runs, drawn, {law: critical.get(law, []) for law in LAWS}, DELTA_MAX
        ),
    ]
    for text in texts:
        assert text and not faults(text)


# --- the law and the rest -------------------------------------------------------------------------


def test_the_caption_says_whether_the_line_follows_the_readings():
    assert "hardly differ" in part.law_caption(FITS["linear"], 0.5, 2).text
    assert "leaves the readings" in part.law_caption(FITS["curved"], 0.5, 2).text
    assert "does not go there" in part.law_caption(FITS["linear"], 0.5, 0.9).text
    assert isinstance(part.law_caption(FITS["linear"], 0.5, 0.9), Caption)


def test_rest_beyond_the_readings_is_told():
    for name, beyond in (("linear", False), ("soft", True)):
        _, robot, laws, _, _ = everything(name)
        text = part.statics_sentence(laws["line"], laws["parabola"], robot)
        assert ("rests beyond" in text) == beyond


@pytest.mark.parametrize(("curvature", "word"), [(0, "not at all"), (4, "more"), (-3, "less")])
def test_the_tangent_is_compared(curvature, word):
    line = SpringLaw(0, 13.0, 0, DELTA_MAX)
    law = SpringLaw(0, 13.0, curvature, DELTA_MAX)
    assert word in part.statics_sentence(line, law, Robot(800, 800))


# --- verdicts -------------------------------------------------------------------------------------


def test_the_verdicts_are_compared_with_those_of_the_line():
    same = {"line": run(5, -1), "stop": run(4, -9)}
    assert "the same on every law" in part.verdict_sentence(ASKED, same)
    assert "  " not in part.verdict_sentence(ASKED, same)
    turned = part.verdict_sentence(ASKED, {"line": run(5, 1), "stop": run(4, -9)})
    assert "At 0.25 m/s every law" in plain(turned)
    assert "At 10 m/s contact is kept on the line and **lost** on: stop" in plain(turned)
    back = part.verdict_sentence(ASKED, {"line": run(-5, -1), "stop": run(4, 9)})
    assert "At 0.25 and 10 m/s contact is lost on the line and **kept** on: stop" in plain(back)
    assert "every law" not in back


def test_a_table_tells_where_contact_is_lost():
    table = plain(part.verdict_table(ASKED, {"line": run(5, -1)}))
    assert "kept, 5.00 N" in table and "lost, 0.200 m" in table


def test_true_angles_turn_a_verdict_or_do_not():
    runs = {"line": run(5, -1)}
    assert "no verdict turns. Where contact is kept" in part.angle_sentence(ASKED, runs, runs)
    turned = part.angle_sentence(ASKED, runs, {"line": run(5, 1)})
    assert "turns at 10 m/s (line)" in plain(turned)
    lost = {"line": run(-5, -1)}
    assert part.angle_sentence(ASKED, lost, lost).endswith("no verdict turns.")


@pytest.mark.parametrize(
    ("line", "other", "words"),
    [
        ([], [], "neither has any other"),
        ([], [3.0], "on other laws: stop"),
        ([0.4, 8.0], [0.41, 8.1], "all of them stay, moved by at most 2.5"),
        ([0.4, 8.0, 20.0], [0.41, 8.1], "0.4 and 8 m/s stay, moved by at most 2.5"),
        ([0.4, 8.0], [0.4], "0.4 m/s stays; there is none at 8 m/s"),
        ([0.4], [], "none of them stays"),
        ([0.4], [0.4, 9.0], "there are others, at 9 m/s"),
    ],
)
def test_critical_speeds_stay_go_and_come(line, other, words):
    text = plain(part.survival_sentence({"line": np.array(line), "stop": np.array(other)}))
    assert words in text
    assert not faults(text)


def test_tilted_critical_speeds_are_compared():
    one = np.array([0.4, 8.0])
    assert "at most 1.2 %" in plain(part.tilted_sentence(one, one * [1.0, 1.0125]))
    assert "one critical speed instead of 2" in plain(part.tilted_sentence(one, one[:1]))
    assert "no critical speed either" in part.tilted_sentence(one[:0], one[:0])


def test_the_linearisation_is_marked_where_it_fails():
    linear, real = run(5, 1), run(4, -9, compression=0.02)
    text = part.reach_table(ASKED, [0.0254], [linear], [real], DELTA_MAX)
    assert "10* (**another verdict**)" in text and "| 25.4 |" in text
    assert "| 0 |" in part.reach_table((1,), [0.01], [run(1)], [run(1 + 1e-15)], DELTA_MAX)


def test_the_stiffness_of_the_stop_matters_or_does_not():
    ratio = [0.1, 1, 10]
    assert "need not be known" in part.stiffness_sentence(ratio, {1.2: [-1, -2, -3]})
    turn = plain(part.stiffness_sentence(ratio, {1.2: [-1, -2, -3], 10: [2, 1, -3]}))
    assert "At 10 m/s it turns near 10 times" in turn and "At 1.2 m/s" in turn
    assert "need not" not in part.stiffness_sentence(ratio, {10: [2, 1, -3]})
    assert not faults(part.stiffness_caption(ratio, {10: [2, 1, -3]}).alt)


# --- what it costs --------------------------------------------------------------------------------


def test_the_problems_step_is_stable_on_the_stop_or_is_not():
    slow, fast = np.array([-2 + 30j, -2 - 30j]), np.array([-2 + 9000j, -2 - 9000j])
    assert "stable on all" in part.limit_sentence({"none": slow, "stop": 9 * slow}, 0.001)
    assert "no longer stable on: stop" in part.limit_sentence({"none": slow, "stop": fast}, 0.001)
    assert "**unstable**" in part.limit_table({"none": slow, "stop": fast}, 0.001)


@pytest.mark.parametrize(
    ("orders", "words"),
    [
        ({"parabola": 3.9, "stop": 2.0}, "costs RK4 its order"),
        ({"rubber": 2.1, "metal": 1.9}, "that of a kink"),
        ({"parabola": 3.0, "stop": 3.9}, "does not show everywhere"),
        ({"parabola": 3.0}, "does not show everywhere"),
        ({}, "too small"),
    ],
)
def test_the_order_is_lost_or_not(orders, words):
    assert words in part.order_sentence(orders)
    assert not faults(part.order_sentence(orders))
    assert not faults(part.order_caption(10, orders).alt)


def cost(method, stop, error, stable=True):
    return {
        "method": method,
        "stop": stop,
        "steps": 64,
        "evaluations": 256,
        "solves": 160 if method == "Crank-Nicolson" else 0,
        "stable": stable,
        "error": error,
    }


def test_the_implicit_step_is_compared():
    rows = [cost("RK4", 1e3, 0.001), cost("Crank-Nicolson", 1e3, 0.01)]
    assert "more accurate with 64 steps" in plain(part.cost_sentence(rows))
    rows[0]["error"] = 0.1
    assert "in no stable case" in part.cost_sentence(rows)
    rows[0] |= {"stable": False, "error": np.inf}
    text = plain(part.cost_sentence(rows))
    assert "unstable with 64 steps" in text and "wrong by up to 1.0 %" in text
    assert "overflow (unstable)" in part.cost_table(rows)
    rows[0]["error"] = 5.0
    assert "5 (unstable)" in part.cost_table(rows)
    assert not faults(text)


# --- how well it is known -------------------------------------------------------------------------


def test_draws_that_are_no_springs_are_told():
    assert "every one" in part.draws_sentence(8, 8, True)
    assert "3 are left out" in part.draws_sentence(5, 8, True)
    assert "contradict the line" in part.draws_sentence(8, 8, False)
    assert "contradict" not in part.draws_sentence(8, 8, True)


def test_shares_claim_no_more_than_the_draws_can_tell():
    runs = {"line": run(1.0), "stop": run(-1.0)}
    drawn = {"line": draws([1.0] * 8), "stop": draws([-1.0] * 8)}
    text = plain(part.asked_table((10,), runs, drawn))
    assert "< 10 %" in text and "> 87.5 %" in text and "**50 %**" in text


@pytest.mark.parametrize(
    ("stop", "word"), [(1.0, "**kept**"), (-1.0, "**open**"), (None, "**lost**")]
)
def test_a_verdict_is_signed_or_open(stop, word):
    line = 1.0 if stop else -1.0
    runs = {"line": run(line), "stop": run(stop or line)}
    drawn = {"line": draws([line] * 8), "stop": draws([stop or line] * 8)}
    assert word in part.sign_table((10,), runs, drawn).splitlines()[2]


def test_critical_speeds_of_several_laws_are_put_together():
    critical = {"line": np.array([0.4, 8.0]), "stop": np.array([0.41])}
    there, none = np.array([0.39, 0.41]), np.array([8.0, np.nan])
    text = part.critical_table(critical, {"line": [there, none], "stop": [there]})
    rows = [row for row in text.splitlines() if row.startswith("| **all")]
    assert [row.split("|")[4].strip() for row in rows] == ["4 of 4", "1 of 4"]
    assert "1 of 2" in text
    assert part.critical_table({"line": []}, {"line": []}).startswith("No law")
    gone = part.critical_table({"line": [8.0]}, {"line": [np.full(2, np.nan)]})
    assert "0 of 2" in gone and not faults(gone)


def conclude(line, stop, critical, compression=0.02, asked=ASKED):
    """Conclusions from margins of two laws, with eight draws that scatter by 0.1 N."""
    scatter = np.linspace(-0.05, 0.05, 8)
    runs = {"line": run(*line), "stop": run(*stop, compression=compression)}
    drawn = {
        "line": draws(*(m + scatter for m in line)),
        "stop": draws(*(m + scatter for m in stop)),
    }
    text = plain(part.conclusions(asked, runs, drawn, critical, DELTA_MAX))
    assert len(text.splitlines()) == 5 and not faults(text)
    return text


def test_the_conclusions_follow_from_the_tables():
    critical = {"line": np.array([0.4, 8.0]), "stop": np.array([0.41])}
    text = conclude((5, 1), (5, -30), critical)
    assert "Contact is kept at 0.25 m/s" in text
    assert "At 10 m/s the verdict is **open**: it is decided by" in text
    assert "only 0.4 m/s stays" in text and "8 m/s belong" in text
    assert "law weighs more" in text and "press the spring" in text
    text = conclude((5, -1), (5, -1), {"line": [0.4], "stop": [0.4]}, compression=0.01)
    assert "kept at 0.25 m/s and lost at 10 m/s" in text
    assert "left open" in text and "Every critical speed" in text
    assert "readings weighs more" in text and "does not matter there" in text
    text = conclude((0.01, 0.01), (0.0, 0.0), {"line": [], "stop": []}, compression=0.01)
    assert "None of the asked verdicts can be signed" in text
    assert "too near to zero" in text and "no critical speed in the range" in text
    assert "none stays" in conclude((5, 1), (5, 1), {"line": [8.0], "stop": []})
    two = {"line": np.array([0.4, 8.0, 20.0]), "stop": np.array([0.4, 8.0])}
    assert "only 0.4 and 8 m/s stay on" in conclude((5, 1), (5, 1), two)
