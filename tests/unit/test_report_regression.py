"""Sentences of Part I, for springs of every kind."""

import pytest
from cases import STIFFNESSES, faults, fitted, prose

from suspension.report import regression

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


@pytest.fixture(scope="module", params=FITS.values(), ids=FITS)
def fit(request):
    return fitted(**request.param)


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


def test_residuals_of_too_few_readings_say_so():
    assert "nothing left to test" in regression.residuals(fitted(800, points=4))
    assert "cubic term would be" in regression.residuals(fitted(800, points=6))


def test_precise_data_are_not_known_to_zero_per_cent():
    assert "±0.0" in prose(regression.summary(fitted(800, noise=1e-4)))
    assert not faults(regression.summary(fitted(800, noise=1e-4)))


@pytest.mark.parametrize(
    ("shares", "says"),
    [
        ({"joint": 0.97, "alone": 0.91}, "the joint boxes kept the promise of 95\u00a0%"),
        ({"joint": 0.97, "one at a time": 0.91}, "; the one-at-a-time boxes did not."),
        (
            {"p = 3": 0.97, "p = 2": 0.97, "alone": 0.9},
            "the p\u00a0=\u00a03 and p\u00a0=\u00a02 boxes kept",
        ),
        ({"joint": 0.97, "alone": 0.96}, "every kind of box kept the promise"),
        ({"joint": 0.90, "alone": 0.91}, "no kind of box kept the promise"),
    ],
)
def test_who_kept_the_promise_is_counted(shares, says):
    text = regression.coverage(shares, 10_000)
    assert not faults(text) and says in text
    assert "standard error of the count: 0.2\u00a0%" in text


def test_boxes_that_miss_are_counted_in_the_caption():
    assert "Three boxes miss" in regression.experiments_figure(100, 3).text
    assert "One box misses" in regression.experiments_figure(100, 1).text
    assert "No boxes miss" in regression.experiments_figure(100, 0).text
