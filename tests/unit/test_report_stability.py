"""Sentences about absolute stability, for any scheme, robot and steps."""

import numpy as np
import pytest
from cases import STIFFNESSES, faults

from suspension.problem import STEPS
from suspension.report import stability as part
from suspension.robot import Robot
from suspension.schemes import BACKWARD_EULER, CRANK_NICOLSON, EULER, RK4

ROBOTS = [Robot(k, k) for k in STIFFNESSES] + [
    Robot(793, 793, c1=0, c2=0),
    Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
    Robot(5, 5, c1=20, c2=20),
]


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("scheme", [EULER, BACKWARD_EULER, CRANK_NICOLSON, RK4])
def test_sentences_are_sound(robot, scheme):
    z = robot.eigenvalues
    texts = [part.stability_table(scheme, z, STEPS), part.diagram_link(z, STEPS, "page", "fig")]
    texts += part.diagram_caption("4(i)", scheme, z, STEPS)
    assert not [fault for text in texts for fault in faults(text)]


def test_the_steps_are_sorted_by_their_verdict():
    stiff, soft = Robot(793, 793).eigenvalues, Robot(405, 405).eigenvalues
    text = part.stability_table(RK4, stiff, STEPS)
    assert "stable at 0.001\u00a0s, and unstable at 0.2 and 0.1\u00a0s" in text
    text = part.stability_table(RK4, soft, STEPS)
    assert "stable at 0.1 and 0.001\u00a0s, and unstable at 0.2\u00a0s" in text
    assert "none of the steps" in part.stability_table(RK4, soft, [0.3, 0.2])
    assert "every one of the steps" in part.stability_table(RK4, soft, [0.1])


def test_the_caption_says_where_the_points_lie():
    damped, undamped = Robot(793, 793).eigenvalues, 30j * np.array([1, -1, 1.2, -1.2])
    caption = part.diagram_caption("4(i)", CRANK_NICOLSON, damped, STEPS)
    for text, name in zip(caption, (r"$\lambda_k\Delta t$", "lambda times dt")):
        assert f" At 0.2, 0.1 and 0.001\u00a0s all four points {name} lie inside. " in text
    caption = part.diagram_caption("4(i)", CRANK_NICOLSON, undamped, STEPS)
    assert "s all four points lambda times dt lie on its border. An" in caption.alt
    caption = part.diagram_caption("7(i)", RK4, damped, STEPS)
    places = "At 0.2 and 0.1\u00a0s all four points lambda times dt lie outside; at 0.001\u00a0s "
    assert places + "all four lie inside. An" in caption.alt
    caption = part.diagram_caption("7(i)", RK4, Robot(405, 405).eigenvalues, STEPS)
    assert "; at 0.1 and 0.001\u00a0s all four lie inside. An" in caption.alt
    caption = part.diagram_caption("7(i)", RK4, Robot(500, 500).eigenvalues, STEPS)
    assert "; at 0.1\u00a0s two of the four lie inside and two outside; at 0.001" in caption.text
    caption = part.diagram_caption("7(i)", RK4, Robot(500, 500).eigenvalues, [0.1])
    places = "At 0.1\u00a0s two of the four points lambda times dt lie inside and two outside. An"
    assert places in caption.alt
    three = part.diagram_caption("7(i)", CRANK_NICOLSON, [-10, -5, 9j, 9], [0.1])
    assert (
        "two of the four points lambda times dt lie inside, one on its border and one o"
        in three.alt
    )


@pytest.mark.parametrize(
    ("scheme", "size", "place"),
    [
        (RK4, 0.015, "on its border"),
        (RK4, 0.03, "inside"),
        (EULER, 1e-6, "on its border"),
        (EULER, 3e-6, "outside"),
    ],
)
def test_the_border_is_as_wide_as_roundoff(scheme, size, place):
    """On the imaginary axis |R| is 1 - z^6/144 for RK4 and 1 + z^2/2 for Euler's method."""
    caption = part.diagram_caption("7(i)", scheme, size * np.array([1j, -1j]), [1])
    assert f"all two points lambda times dt lie {place}." in caption.alt
    assert scheme.is_stable([1j * size], 1) == (place != "outside")


def test_what_is_shaded_follows_from_the_scheme():
    z = Robot(793, 793).eigenvalues
    half = part.diagram_caption("4(i)", CRANK_NICOLSON, z, STEPS)
    assert "shaded left half-plane" in half.text and "border was" not in half.text
    bounded = part.diagram_caption("7(i)", RK4, z, STEPS)
    assert "shaded region" in bounded.text and "border was found" in bounded.text


def test_many_points_are_counted_too():
    z = Robot(793, 793).eigenvalues
    assert part.diagram_link(z, STEPS, "page", "fig").startswith("All twelve points")
    assert part.diagram_link(z, [0.1] * 5, "page", "fig").startswith("All 20 points")
