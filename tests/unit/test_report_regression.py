"""Sentences of Part I, for springs of every kind."""

import re

import numpy as np
import pandas as pd
import pytest
from cases import STIFFNESSES, faults, fitted, loading_and_unloading, prose

from suspension.report import regression
from suspension.report.data import caution
from suspension.springs import fit_spring

FITS = {f"k = {k}": {"stiffness": k} for k in STIFFNESSES} | {
    "preload": {"stiffness": 800, "preload": 1.5},
    "curved": {"stiffness": 800, "curvature": 4.0},
    "bent down": {"stiffness": 800, "curvature": -4.0},
    "preload and curved": {"stiffness": 800, "preload": -1.5, "curvature": 4.0},
    "exact": {"stiffness": 800, "noise": 0.0},
    "exactly curved": {"stiffness": 800, "curvature": 4.0, "noise": 0.0},
    "noisy": {"stiffness": 800, "noise": 2.0},
    "four readings": {"stiffness": 800, "points": 4},
    "five readings": {"stiffness": 800, "points": 5},
}


def fit_of(force, x):
    return fit_spring(pd.DataFrame({"delta_over_delta_max": x, "force": force}))


def both_ways(sort=False):
    """Loading, then unloading; or the same readings in the order of their displacements."""
    force, x = loading_and_unloading()
    order = np.argsort(x, kind="stable") if sort else slice(None)
    return fit_of(force[order], x[order])


def three_places():
    x = np.repeat([0, 0.5, 1], 5)
    return fit_of(13.2 * x + np.random.default_rng(4).normal(0, 0.1, x.size), x)


UNUSUAL = {
    "both ways": both_ways(),
    "taking turns": both_ways(sort=True),
    "three displacements": three_places(),
}
SENTENCES = (
    regression.coefficients,
    regression.intervals,
    regression.joint_intervals,
    regression.linearity,
    regression.residuals,
    regression.stiffness,
    regression.summary,
)
CAPTIONS = (regression.fit_figure, regression.ellipse_figure, regression.residuals_figure)


@pytest.fixture(scope="module", params=[*FITS, *UNUSUAL])
def fit(request):
    if request.param in UNUSUAL:
        return UNUSUAL[request.param]
    return fitted(**FITS[request.param])


@pytest.mark.parametrize("sentence", SENTENCES)
def test_every_sentence_is_sound(sentence, fit):
    assert not faults(sentence(fit))


@pytest.mark.parametrize("caption", CAPTIONS)
def test_every_caption_is_sound(caption, fit):
    text, alt = caption(fit)
    assert not faults(text) and not faults(alt)
    assert "\n" not in text
    assert len(alt.split()) >= 3 and "$" not in alt and "*" not in alt


@pytest.mark.parametrize("stiffness", STIFFNESSES)
def test_a_straight_spring_is_justified(stiffness):
    fit = fitted(stiffness)
    assert "is justified" in regression.linearity(fit)
    assert "lies inside" in regression.ellipse_figure(fit).text
    assert "compatible" in regression.summary(fit)
    assert "**not**" not in regression.summary(fit)


@pytest.mark.parametrize(
    ("how", "away"),
    [
        ({"preload": 1.5}, r"does **not** lie in the joint interval of the preload $\beta_0$"),
        ({"curvature": 4}, r"does **not** lie in the joint interval of the curvature $\beta_2$"),
        ({"preload": -1.5, "curvature": 4}, "lies in neither of the joint intervals"),
    ],
)
def test_another_spring_is_contradicted_and_by_what(how, away):
    fit = fitted(800, **how)
    text = regression.linearity(fit)
    assert away in text
    assert "contradict" in text and "justified" not in text
    assert "p\u00a0<\u00a00.001" in text
    assert "outside" in regression.ellipse_figure(fit).text
    assert "**not** compatible" in regression.summary(fit)


def test_intervals_that_hold_zero_are_not_enough():
    """The point (0, 0) can lie in the box and yet outside the ellipse."""
    fit = fitted(800, preload=0.02, curvature=-0.2)
    assert fit.linearity().joint and fit.linearity().pvalue < 0.05
    text = regression.linearity(fit)
    assert text.startswith("Zero lies in both joint intervals, but the F test")
    assert "contradict" in text


def test_the_answers_hold_the_fit():
    fit = fitted(987)
    assert f"{fit.stiffness:.1f}" in regression.stiffness(fit)
    for j in (0, 2):
        for end in fit.intervals()[j]:
            assert f"{abs(end):.3f}" in regression.joint_intervals(fit)


@pytest.mark.parametrize(
    ("curvature", "shape"), [(0, "straight line"), (4, "bends upwards"), (-4, "bends downwards")]
)
def test_the_alt_text_describes_the_curve(curvature, shape):
    assert shape in regression.fit_figure(fitted(800, curvature=curvature)).alt


def test_three_displacements_cannot_be_tried_for_a_cubic_term():
    text = regression.residuals(UNUSUAL["three displacements"])
    assert "The readings stand at three displacements" in text
    assert "a cubic term cannot be tried" in text and "would be" not in text
    near = np.array([0, 0.5, 0.5 + 1e-12, 1, 1])
    text = regression.residuals(fit_of(13 * near + [0.1, -0.1, 0, 0.05, -0.02], near))
    assert "too near to each other for a cubic term" in text


def test_readings_on_a_curve_say_nothing_of_the_error():
    for how in ({}, {"curvature": 4.0}):
        fit = fitted(800, noise=0.0, **how)
        assert "goes through every reading" in regression.residuals(fit)
        assert "cubic" not in regression.residuals(fit)
        assert "they do not say how well it is known" in regression.summary(fit)
        assert "±" not in regression.summary(fit)


def believed(fit):
    """What rests on independent errors, and says so where the residuals contradict them."""
    sentences = regression.stiffness, regression.joint_intervals, regression.linearity
    return {
        f.__name__: "cannot be relied on" not in f(fit) for f in (*sentences, regression.summary)
    }


@pytest.mark.parametrize("kind", ["both ways", "taking turns"])
def test_what_the_residuals_contradict_is_not_told_as_known(kind):
    fit = UNUSUAL[kind]
    assert not any(believed(fit).values())
    assert "known to about" not in regression.summary(fit)
    assert f"with {fit.neighbours.correlation:.2f}".replace("-", "−") in caution(fit)
    text = regression.residuals(fit)
    assert "**outside**" in text and "cannot be relied on" in text
    assert ("stand together" in text, "take turns" in text) == (
        (True, False) if kind == "both ways" else (False, True)
    )


def test_how_much_wider_is_told_where_errors_may_wander():
    fit = UNUSUAL["both ways"]
    times = float(re.search(r"must be ([\d.]+) times as wide", regression.residuals(fit))[1])
    assert times == pytest.approx(fit.neighbours.widening, rel=0.05)
    assert "times as wide" not in regression.residuals(UNUSUAL["taking turns"])


@pytest.mark.parametrize("how", [{}, {"curvature": 4.0}, {"noise": 0.0}, {"points": 4}])
def test_nothing_is_doubted_without_a_reason(how):
    fit = fitted(800, **how)
    assert all(believed(fit).values()) and caution(fit) == ""
    assert "cannot be relied on" not in regression.residuals(fit)


def test_the_caution_names_its_subject():
    fit = UNUSUAL["both ways"]
    assert caution(fit).startswith("The interval assumes independent errors")
    assert "they cannot be relied on" in caution(fit, "The intervals")
    assert "it cannot be relied on" in caution(fit, "The F test")


def test_residuals_of_too_few_readings_say_so():
    assert "nothing left to test" in regression.residuals(fitted(800, points=4))
    assert "cubic term would be" in regression.residuals(fitted(800, points=6))


def test_precise_data_are_not_known_to_zero_per_cent():
    assert "±0.0" in prose(regression.summary(fitted(800, noise=1e-4)))
    assert not faults(regression.summary(fitted(800, noise=1e-4)))


def test_who_kept_the_promise_is_counted():
    text = regression.coverage({"p = 3": 0.97, "just": 0.944, "one at a time": 0.943}, 10_000)
    assert not faults(text) and "standard error of the count: 0.2\u00a0%" in text
    told = [row.split(" | ")[-1] for row in text.splitlines()[2:5]]
    assert told == ["kept |", "kept |", "broken |"]
    assert "| p\u00a0=\u00a03 | 97.0\u00a0% |" in text


def test_the_share_of_the_single_intervals_is_told_beside_both_guesses():
    told = {0.9025: "In about 90.25\u00a0%", 0.95: "In about 95\u00a0%", 0.92: "Between the two"}
    for share, head in told.items():
        text = regression.both_right(share, 10_000)
        assert text.startswith(f"**{head}:**") and "of the 10,000 experiments" in text
        assert not faults(text)
    assert "91.8\u00a0%" in regression.both_right(0.918, 10_000)
    assert regression.both_right(0.92, 100).startswith("**In about 90.25")  # too few to tell


def test_boxes_that_miss_are_counted_in_the_caption():
    assert "Three boxes miss" in regression.experiments_figure(100, 3).text
    assert "One box misses" in regression.experiments_figure(100, 1).text
    assert "No boxes miss" in regression.experiments_figure(100, 0).text
