"""Figures as SVG: the same every time, and laid out anew for a phone."""

import matplotlib.pyplot as plt
import pytest

from suspension.figures.layout import PHONE_WIDTH, narrow, svg


@pytest.fixture(autouse=True)
def style():
    with plt.style.context("suspension.figures.report"):
        yield
    plt.close("all")


def drawn(columns=1):
    figure, axes = plt.subplots(1, columns, squeeze=False)
    for ax in axes.flat:
        ax.plot([1, 2], label="a curve")
        ax.set(xlabel="time (s)")
    axes[0, 0].set(ylabel="force (N)")
    return figure, axes[0]


def test_an_svg_is_the_same_every_time():
    assert svg(drawn()[0]) == svg(drawn()[0])
    assert "<dc:date>" not in svg(drawn()[0])


def test_a_narrow_figure_has_the_width_of_a_phone():
    figure, _ = drawn()
    assert narrow(figure).get_figwidth() == PHONE_WIDTH


def test_panels_side_by_side_come_to_stand_below_each_other():
    figure, (left, right) = drawn(2)
    narrow(figure).draw_without_rendering()
    assert left.get_position().y0 > right.get_position().y1
    assert left.get_position().x0 == pytest.approx(right.get_position().x0, abs=0.02)
    assert right.get_ylabel() == "force (N)"


@pytest.mark.parametrize("place", [(1.02, 0.5), (0.5, -0.4)])
def test_a_legend_outside_a_panel_goes_to_the_foot(place):
    figure, (ax,) = drawn()
    ax.legend(loc="center left" if place[0] > 1 else "upper center", bbox_to_anchor=place)
    narrow(figure).draw_without_rendering()
    assert ax.get_legend() is None
    (legend,) = figure.legends
    assert legend.get_window_extent().y1 <= ax.get_window_extent().y0
    assert [text.get_text() for text in legend.get_texts()] == ["a curve"]


@pytest.mark.filterwarnings("ignore:constrained_layout not applied")  # so wide is the legend first
def test_a_wide_legend_takes_fewer_columns():
    figure, (ax,) = drawn()
    for i in range(5):
        ax.plot([i], label=f"a rather long name of a curve, {i}")
    ax.legend(ncols=5, loc="upper center", bbox_to_anchor=(0.5, -0.2))
    narrow(figure).draw_without_rendering()
    box = figure.legends[0].get_window_extent()
    assert box.x0 >= 0 and box.x1 <= figure.bbox.width


def test_type_keeps_its_size():
    figure, (ax,) = drawn()
    size = ax.xaxis.label.get_size()
    narrow(figure)
    assert ax.xaxis.label.get_size() == size
