"""What a prediction hands to its page: axes, and later the answer."""

import json
import re

import numpy as np
import pytest

from suspension.explorer import Prediction
from suspension.similarity import Groups, follow, highest_bump, natural_units, skim, throw, way

NU = np.geomspace(0.05, 100, 200)


@pytest.fixture(scope="module")
def asked():
    return Prediction("highest", (0.05, 100), (0.1, 100), "speed ν", "height η*")


def answer(asked, zeta=0.1, j=1.0, lam=4.0):
    robot, bump, _ = natural_units(Groups(1, zeta, 1, j, lam))
    exact = highest_bump(robot, bump, NU, distance=way(robot, bump, NU))
    skimmed = skim(NU, zeta) if zeta else np.full(NU.shape, np.inf)
    lines = {"follow": follow(NU, j), "throw": throw(NU), "skim": skimmed}
    return asked.answer(NU, lines, exact), exact


def test_the_answer_is_the_curve_and_its_lines(asked):
    answered, exact = answer(asked)
    facts = answered.facts
    told = facts["answer"]
    places = np.geomspace(*facts["x"], facts["columns"])
    truth = np.clip(np.exp(np.interp(np.log(places), np.log(NU), np.log(exact))), 0.01, 1000)
    np.testing.assert_allclose(10 ** np.array(told["exact"]), truth, rtol=0.01)
    assert [line["slope"] for line in told["lines"]] == [-2, 1, -1]
    for line, law in zip(told["lines"], (lambda v: follow(v, 1.0), throw, lambda v: skim(v, 0.1))):
        ends = [law(v) for v in facts["x"]]
        np.testing.assert_allclose(10 ** np.array(line["ends"]), ends, rtol=1e-3)
        start, stop = line["stretch"]
        assert 0 <= start < stop < facts["columns"]
        middle = places[(start + stop) // 2]
        assert law(middle) == pytest.approx(np.interp(middle, NU, exact), rel=0.55)
    order = [line["stretch"] for line in told["lines"]]
    assert order == sorted(order)  # slow, then thrown, then skimmed


def test_a_line_that_is_nowhere_near_is_said_to_be(asked):
    lines = {"far": 1000 * throw(NU), "near": 1.4 * throw(NU), "touching": NU[100] ** 3 / NU**2}
    told = asked.answer(NU, lines, throw(NU)).facts["answer"]["lines"]
    stretches = {line["name"]: line["stretch"] for line in told}
    assert stretches["far"] is None and stretches["touching"]
    seen = np.geomspace(0.05, 100, asked.facts["columns"]) / np.sqrt(2 * np.pi) >= 0.1
    assert stretches["near"] == [np.flatnonzero(seen)[0], asked.facts["columns"] - 1]


def test_without_a_damper_there_is_no_line_that_it_makes(asked):
    answered, _ = answer(asked, zeta=0)
    assert [line["name"] for line in answered.facts["answer"]["lines"]] == ["follow", "throw"]


def test_no_height_is_no_number_that_a_page_could_not_read(asked):
    answered = asked.answer(NU, {"throw": throw(NU)}, np.where(NU < 1, np.inf, NU))
    state = re.search(r'class="se-state">(.*)</script>', answered.html())[1]
    assert np.isfinite(json.loads(state)["facts"]["answer"]["exact"]).all()


def test_a_page_gets_empty_axes_and_nothing_of_the_answer(asked):
    html = asked.html()
    assert "se-asked" in html and "exact" not in html.split("se-state")[1]
    assert 'alt="Empty logarithmic axes: height η* against speed ν."' in html
    assert "se-answered" in answer(asked)[0].html() and "<img" not in answer(asked)[0].html()


@pytest.mark.parametrize("x, y", [((0, 1), (1, 2)), ((1, 2), (2, 1)), ((1, 2), (np.nan, 2))])
def test_axes_that_cannot_be_are_refused(x, y):
    with pytest.raises(ValueError, match=r"^[xy]\[[01]\] must"):
        Prediction("p", x, y, "speed ν", "height η")
