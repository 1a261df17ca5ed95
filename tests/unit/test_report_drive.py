"""The experiments beside the sliders fit the robot that the sliders move."""

import re

import pytest
from cases import STIFFNESSES, faults

from suspension.explorer import explore
from suspension.explorer.settings import DTS
from suspension.report.drive import experiments, presets
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import RK4

ROBOTS = {f"k = {k}": Robot(k, k) for k in STIFFNESSES} | {
    "undamped": Robot(793, 793, c1=0, c2=0),
    "unsymmetric": Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
}


def plain(text):
    """A text without its no-break spaces and its links."""
    return re.sub(r"\[([^]]*)\]\(#[^)]*\)", r"\1", text).replace("\xa0", " ")


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("critical, flips", [([], []), ([0.436, 7.85], [572.8])])
def test_every_robot_has_five_sound_experiments(name, critical, flips):
    robot = ROBOTS[name]
    limit = RK4.max_stable_dt(robot.eigenvalues)
    text = experiments(robot, critical, flips, limit, DTS)
    assert not faults(text)
    assert [line[:2] for line in text.splitlines()] == ["1.", "2.", "3.", "4.", "5."]


def told(**changes):
    usual = {"critical": [0.436], "flips": [572.8], "limit": 0.0744, "slider": DTS}
    return experiments(Robot(793, 793), **usual | changes)


def test_the_step_is_lengthened_past_the_limit():
    assert "from 70 to 80 ms: the largest stable one is 74.4 ms" in plain(told())
    assert "from 100 to 200 ms" in plain(told(limit=0.1325))
    assert "nothing blows up. Soften" in plain(told(limit=0.5))
    assert "step to 1 ms" in plain(told(limit=1e-4, slider=(0.001, 0.002)))


def test_no_speed_and_no_stiffness_may_turn_the_verdict():
    calm = told(critical=[], flips=[])
    assert "does not turn anywhere" in plain(calm) and "The verdict stays" in plain(calm)
    assert "turns at 573 N/m" in plain(told())


def test_a_heave_without_a_swing_is_left_out():
    stiff = Robot(100, 100, c1=40, c2=40)
    assert "5." not in plain(experiments(stiff, [], [], 0.01, DTS))


def test_phrases_set_the_picture():
    links = re.findall(r"\]\(#explore:([^)]*)\)", told())
    assert {"v=0.25", "v=1.2&scheme=RK4", "v=1.2&scheme=RK4&dt=0.08", "v=5&k=572.8"} <= set(links)


def test_every_experiment_has_a_button_that_an_explorer_takes():
    robot = Robot(793, 793)
    buttons = presets(robot, [572.8], 0.0744, DTS)
    labels = ["Faster, safer?", "Blow it up", "Stable, wrong", "The spring"]
    assert [label for label, _ in buttons] == [*labels, "In step", "Out of step"]
    settings = dict(buttons)
    assert settings["Blow it up"]["dt"] == 0.08 and settings["The spring"]["k"] == 572.8
    assert settings["Out of step"]["v"] == 2 * settings["In step"]["v"]
    links = told()
    for name in ("In step", "Out of step"):
        assert f"#explore:v={settings[name]['v']:.10g})" in links
    taken = explore(robot, GaussianBump(), presets=buttons).explorer.facts["presets"]
    assert [label for label, _ in taken] == [label for label, _ in buttons]


def test_a_button_promises_nothing_that_does_not_happen():
    calm = dict(presets(Robot(100, 100, c1=40, c2=40), [], 0.5, DTS))
    assert "Blow it up" not in calm and calm["The longest step"]["dt"] == DTS[-1]
    assert calm["The spring"] == {"v": 5.0} and "In step" not in calm
