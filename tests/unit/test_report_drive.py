"""The experiments beside the sliders fit the robot that the sliders move."""

import re

import helpers
import pytest
from cases import STIFFNESSES, faults

from suspension.contact import Regimes
from suspension.explorer import explore
from suspension.explorer.settings import DTS
from suspension.report.drive import answers, experiments, presets
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import RK4

ROBOTS = {f"k = {k}": Robot(k, k) for k in STIFFNESSES} | {
    "undamped": Robot(793, 793, c1=0, c2=0),
    "unsymmetric": Robot(700, 900, m=1.3, Izz=0.02, L1=0.09, L2=0.13, c1=1.2, c2=1.9),
}


def plain(text):
    """A text without its no-break spaces and its links."""
    return helpers.plain(re.sub(r"\[([^]]*)\]\(#[^)]*\)", r"\1", text))


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("critical, flips", [([], []), ([0.436, 7.85], [572.8])])
def test_every_robot_has_five_sound_experiments(name, critical, flips):
    robot = ROBOTS[name]
    limit = RK4.max_stable_dt(robot.eigenvalues)
    text = experiments(robot, critical, flips, limit, DTS)
    assert not faults(text)
    assert [line[:2] for line in text.splitlines()] == ["1.", "2.", "3.", "4.", "5."]


@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("flips", [[], [572.8], [300, 900]])
def test_every_experiment_has_its_answer(name, flips):
    robot = ROBOTS[name]
    limit = RK4.max_stable_dt(robot.eigenvalues)
    found = Regimes([0.1, 0.436, 7.85, 20.3, 30], [0, 1, 0, 1])
    asked = experiments(robot, found.critical, flips, limit, DTS).splitlines()
    text = answers(robot, found, flips, False, limit, DTS)
    assert len(text.splitlines()) == len(asked) and not faults(text)
    assert all(line[3:5] == "**" for line in text.splitlines())


def answered(**changes):
    usual = {"regimes": Regimes([0.1, 0.4, 7.9, 30], [0, 1, 0]), "flips": [572.8]}
    usual |= {"soft_lost": False, "limit": 0.0744, "slider": DTS, "robot": Robot(793, 793)}
    return plain(answers(**usual | changes))


def test_answers_follow_the_robot():
    text = answered()
    assert "**Sometimes.** Contact is kept up to 0.400 m/s" in text
    assert "**The two of the pitch**, which swings at 6.19 Hz" in text
    assert "swings at 6.19 Hz, in the run at 2.10 Hz; it decays with 1.43 per second" in text
    assert "**Softer.** Contact is kept with springs up to 573 N/m." in text
    assert "**1.12 m/s builds it up**" in text
    other = answered(
        regimes=Regimes([0.1, 0.4, 30], [0, 1]),
        soft_lost=True,
        limit=0.5,
        robot=Robot(100, 100, c1=40, c2=40),
    )
    assert "**No.**" in other and "**None**" in other and "**The decay is another" in other
    assert "**Stiffer.** Contact is kept with springs from 573 N/m on." in other
    assert "5." not in other
    assert "**One of the pitch**" in answered(robot=Robot(100, 100, c1=40, c2=40))
    assert "contact is kept with every spring" in answered(flips=[])
    assert "contact is lost with every spring" in answered(flips=[], soft_lost=True)
    assert "the verdict turns 2 times" in answered(flips=[300, 900])


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
