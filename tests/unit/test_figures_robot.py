"""The robot drawn: body, springs and wheels where the model has them, and a GIF that moves."""

from itertools import pairwise

import matplotlib
import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.animation import FuncAnimation
from PIL import Image, ImageChops, ImageSequence

from suspension.animation import animate_robot
from suspension.course import the_robot
from suspension.figures.layout import narrow
from suspension.figures.robot import RobotDrawing, plot_contact_states
from suspension.figures.style import COLOURS
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.simulation import simulate

matplotlib.use("Agg")
ROBOT = Robot(800, 600, L1=0.09, L2=0.12)
BUMP = GaussianBump()


@pytest.fixture(autouse=True)
def no_figure_is_left_open():
    yield
    plt.close("all")


@pytest.fixture
def drawing():
    return RobotDrawing(plt.subplots()[1], ROBOT, BUMP)


def wheels(drawing):
    return np.array([np.ravel(wheel.get_data()) for wheel in drawing.wheels])


@pytest.mark.parametrize(
    "Y, theta, on_ground",
    [
        (-0.01, 0.0, [True, True]),
        (0.0, 0.0, [True, True]),
        (0.01, 0.05, [False, True]),
        (-0.02, 0.4, [True, False]),
        (0.2, 0.0, [False, False]),
    ],
)
def test_a_wheel_stands_on_the_ground_or_hangs_from_its_spring(drawing, Y, theta, on_ground):
    X = 0.2  # the front wheel is near the top of the bump
    drawing.update(np.array([Y, 0, theta, 0]), X)
    x = X + np.array([-ROBOT.L1, ROBOT.L2])
    hanging, ground = Y + theta * (x - X), BUMP(x)[0]
    np.testing.assert_array_equal(hanging <= ground, on_ground)
    y = np.where(on_ground, ground, hanging)
    np.testing.assert_allclose(wheels(drawing), np.column_stack([x, y]))


def test_the_body_is_a_line_through_the_centre_with_the_slope_theta(drawing):
    drawing.update(np.array([0.01, 0, 0.2, 0]), 0.5)
    (x1, x2), (y1, y2) = drawing.line.get_data()
    assert (x1, x2) == pytest.approx((0.5 - ROBOT.L1, 0.5 + ROBOT.L2))
    assert (y2 - y1) / (x2 - x1) == pytest.approx(0.2)
    for spring, (x, y), top in zip(drawing.springs, wheels(drawing), (y1, y2), strict=True):
        xs, ys = spring.get_data()
        assert (xs[0], ys[0], ys[-1]) == pytest.approx((x, y, top))


def test_a_flying_wheel_is_drawn_as_high_as_it_is_said_to_be(drawing):
    drawing.update(np.zeros(4), 0.2, gaps=np.array([0.01, 0.02]))
    np.testing.assert_allclose(wheels(drawing)[:, 1] - BUMP(wheels(drawing)[:, 0])[0], [0.01, 0.02])


def test_the_whole_way_and_the_bump_are_in_the_picture(drawing):
    drawing.ground(-0.2, 1.4)
    assert drawing.ax.get_xlim() == (-0.2, 1.4)
    low, high = drawing.ax.get_ylim()
    assert low < 0 and high > BUMP.height + drawing.body
    assert drawing.ax.get_aspect() == 1


@pytest.mark.slow
@pytest.mark.parametrize("stride, frames", [(1, 13), (5, 3)])
def test_an_animation_is_saved_as_a_gif_that_moves(tmp_path, stride, frames):
    run = simulate(ROBOT, BUMP, v=1.2, dt=0.05, tfinal=0.6)
    animation = animate_robot(run.W, run.T, 1.2, stride, robot=ROBOT, road=BUMP)
    assert isinstance(animation, FuncAnimation)
    animation.save(tmp_path / "run.gif", writer="pillow", dpi=50)
    with Image.open(tmp_path / "run.gif") as gif:
        below_the_clock = (0, gif.height // 2, gif.width, gif.height)
        pictures = [
            picture.convert("RGB").crop(below_the_clock) for picture in ImageSequence.Iterator(gif)
        ]
    assert len(pictures) == frames
    # Far more than the palette of a GIF changes: the dark body has gone somewhere else.
    assert all(np.max(ImageChops.difference(*pair)) > 100 for pair in pairwise(pictures))


@pytest.mark.slow
def test_the_problems_robot_and_bump_are_drawn_unless_others_are_given(tmp_path):
    run = simulate(the_robot(), BUMP, v=1, dt=0.2, tfinal=0.2)

    def picture(**given):
        animate_robot(run.W, run.T, 1, **given).save(tmp_path / "a.gif", writer="pillow", dpi=50)
        with Image.open(tmp_path / "a.gif") as gif:
            return gif.convert("RGB")

    ours = picture()
    assert not ImageChops.difference(ours, picture(robot=the_robot(), road=BUMP)).getbbox()
    assert ImageChops.difference(ours, picture(road=FlatRoad())).getbbox()


@pytest.mark.parametrize(
    "name, value",
    [
        ("W", np.zeros((3, 5))),
        ("W", np.zeros((4, 4))),
        ("W", np.full((4, 5), np.nan)),
        ("T", np.zeros((5, 1))),
        ("T", [0, 1, np.inf, 3, 4]),
        ("v", np.nan),
        ("steps_per_frame", 0),
        ("steps_per_frame", 1.5),
        ("steps_per_frame", None),
    ],
)
def test_a_bad_argument_is_refused_by_name(name, value):
    arguments = {"W": np.zeros((4, 5)), "T": np.arange(5.0), "v": 1} | {name: value}
    with pytest.raises(ValueError, match=f"^{name} must "):
        animate_robot(**arguments)


def test_there_are_four_states_of_two_wheels_with_arrows_both_ways():
    ax = plt.subplots()[1]
    assert plot_contact_states(ax) is ax and len(plt.get_fignums()) == 1
    words = [text.get_text() for text in ax.texts]
    forces = {
        tuple(f"$N_{i} = 0" in text or f"quad N_{i} = 0" in text for i in (1, 2))
        for text in words
        if "N_1 =" in text
    }
    assert forces == {(False, False), (True, False), (False, True), (True, True)}
    arrows = [text for text in ax.texts if getattr(text, "arrow_patch", None)]
    ways = [(*np.sign(np.subtract(a.xy, a.xyann)), a.arrow_patch.get_ec()) for a in arrows]
    assert len(ways) == 8  # each wheel switches off and on, in two places
    assert [ways.count(way) for way in set(ways)] == [2, 2, 2, 2]
    rules = {line.get_label(): line for line in ax.get_lines()}
    for wheel, name in ((1, "rear"), (2, "front")):
        (off,) = (rules[text] for text in rules if f"{name} lifts off: $f_{wheel}$ falls" in text)
        (on,) = (
            rules[text] for text in rules if rf"{name} lands: $p_{wheel} \geq p_{wheel}^" in text
        )
        assert off.get_color() == on.get_color() == COLOURS[wheel - 1]
        assert off.get_ls() != on.get_ls()


@pytest.mark.parametrize("layout", [lambda figure: figure, narrow])
def test_no_word_of_the_states_is_cut_off_or_covered(layout):
    with plt.style.context("suspension.figures.report"):
        ax = plot_contact_states()
        layout(ax.figure).canvas.draw()
    words = [text for text in ax.texts if text.get_text()]
    (legend,) = [*ax.figure.legends, *filter(None, [ax.get_legend()])]
    boxes = [text.get_bbox_patch().get_window_extent() for text in words]
    boxes.append(legend.get_window_extent())
    arrows = [text.arrow_patch.get_window_extent() for text in ax.texts if not text.get_text()]
    assert len(boxes) == 5 and len(arrows) == 8
    crossed = [(box, arrow) for box in boxes for arrow in arrows if box.overlaps(arrow)]
    assert not crossed
    assert not [1 for i, one in enumerate(boxes) for other in boxes[:i] if one.overlaps(other)]
    width = ax.figure.bbox
    assert all(width.containsx(box.x0) and width.containsx(box.x1) for box in boxes)


@pytest.mark.parametrize("size", [1, 12])
def test_a_robot_of_any_size_is_seen_whole(size):
    """A car that is twelve times as long is drawn like the robot, twelve times as large."""
    robot = Robot(800, 800, L1=0.1 * size, L2=0.1 * size)
    drawing = RobotDrawing(plt.subplots()[1], robot, FlatRoad())
    drawing.ground(-0.3 * size, 0.3 * size)
    drawing.update(np.zeros(4), 0.0)
    bottom, top = drawing.ax.get_ylim()
    assert drawing.line.get_ydata() == pytest.approx(0.056 * size)
    assert bottom < 0 < 0.056 * size < 0.9 * top
    spring = np.asarray(drawing.springs[0].get_xdata())
    assert np.ptp(spring) == pytest.approx(2 * 0.12 * 0.056 * size)
