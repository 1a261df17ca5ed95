"""The explorer's Python half: what it hands to the page, checks and writes."""

import base64
import gzip
import json
import re
import warnings
from dataclasses import replace
from urllib.parse import unquote
from xml.etree import ElementTree

import numpy as np
import pytest
import traitlets
from ipywidgets import SelectionSlider
from matplotlib.path import Path as Polygon
from node import ASK, run_in_node

from suspension import problem
from suspension.contact import margin, regimes
from suspension.explorer import DTS, SCHEMES, explore, page_script, page_style, tables
from suspension.explorer.bundle import bundle
from suspension.explorer.controls import native
from suspension.explorer.family import Family, Range, affine
from suspension.explorer.sliders import stops
from suspension.explorer.still import draw, picture
from suspension.flight import fly
from suspension.report.words import quantity, ranges
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.schemes import EULER, Scheme
from suspension.similarity import highest_bump
from suspension.simulation import simulate

BUMP = GaussianBump()
ROBOT = Robot(793.2, 793.2)
LOPSIDED = Robot(700, 1000, L1=0.12, L2=0.09, c1=2.0, c2=0.5)
HEUN = Scheme("Heun", 2, a=[[0, 0], [1, 0]], b=[1 / 2, 1 / 2], c=[0, 1])


def two_bumps(x):
    (H1, d1), (H2, d2) = BUMP(x), GaussianBump(height=0.018, sigma=0.02, centre=0.85)(x)
    return H1 + H2, d1 + d2


def roof(x):
    """From 0.4 to 0.6 m, with three kinks."""
    d = np.asarray(x, dtype=float) - 0.5
    inside = np.abs(d) < 0.1
    return np.where(inside, 0.1 - np.abs(d), 0) / 5, np.where(inside, -np.sign(d), 0) / 5


def write_modules(folder, **texts):
    for name, text in texts.items():
        (folder / f"{name}.js").write_text(text, encoding="utf-8")


def test_a_bundle_keeps_private_names_apart_and_loads_each_module_once(tmp_path):
    write_modules(
        tmp_path,
        base='const own = 1;\nconsole.log("once");\nexport const both = () => own;\n',
        left='import { both } from "./base.js";\nconst own = 2;\n'
        "export function left() {\n  return [own, both()];\n}\n",
        entry='import {\n  both,\n} from "./base.js";\nimport { left } from "./left.js";\n'
        "const own = 3;\nexport default { all: [own, ...left(), both()] };\n",
    )
    (tmp_path / "bundle.js").write_text(bundle(tmp_path, "entry"), encoding="utf-8")
    for module in ("entry", "bundle"):
        script = f'import it from "./{module}.js";\nconsole.log(it.all.join());'
        assert run_in_node(tmp_path, script).split() == ["once", "3,2,1,1"]


def test_the_page_exports_what_the_slow_tests_ask_it(tmp_path):
    imports = re.findall(r'^import .+ from "\./page/.+$', ASK, re.MULTILINE)
    assert imports
    run_in_node(tmp_path, "\n".join(imports))


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ('import { a } from "./entry.js";\n', "imports itself: entry > other > entry"),
        ('import { missing } from "./leaf.js";\n', r"imports \['missing'\], not in leaf.js"),
        ('import { a as b } from "./leaf.js";\n', "form that is not known"),
        ('import * as leaf from "./leaf.js";\n', "form that is not known"),
        ('import "./leaf.js";\n', "form that is not known"),
        ('const leaf = await import("./leaf.js");\n', "form that is not known"),
        ("const here = import.meta.url;\n", "form that is not known"),
        ("export let a = 1;\n", "form that is not known"),
        ("export const [a, b] = [1, 2];\n", "form that is not known"),
        ("const a = 1;\nexport { a };\n", "form that is not known"),
        ("export default 1;\n", "form that is not known"),
    ],
)
def test_a_bundle_refuses_what_it_does_not_know(tmp_path, text, complaint):
    leaf = "export const a = 1;\n"
    entry = 'import { own } from "./other.js";\n'
    write_modules(tmp_path, leaf=leaf, entry=entry, other=text + "export const own = 1;\n")
    with pytest.raises(ValueError, match=complaint):
        bundle(tmp_path, "entry")


@pytest.mark.parametrize("road", [BUMP, two_bumps, FlatRoad()])
def test_the_road_table_is_the_road(road):
    start, stop = -0.107, 6.4
    table = tables.road_table(road, start, stop)
    x = np.random.default_rng(0).uniform(start, stop, 20_000)
    cell = (stop - start) / len(table)
    n = ((x - start) / cell).astype(int)
    s = 2 * ((x - start) / cell - n) - 1
    powers = np.arange(table.shape[1])
    H = (table[n] * s[:, None] ** powers).sum(axis=1)
    dHdx = (table[n] * powers * s[:, None] ** np.maximum(powers - 1, 0)).sum(axis=1) * 2 / cell
    assert np.abs(H - road(x)[0]).max() < 1e-14
    assert np.abs(dHdx - road(x)[1]).max() < 1e-12


def test_a_road_with_kinks_is_told_of_and_still_shown():
    with pytest.warns(UserWarning, match="road is rough: the page knows its height to .* m"):
        box = explore(ROBOT, roof)
    assert np.isfinite(np.frombuffer(box.explorer.tables["road"])).all()


def test_a_smooth_road_is_not_complained_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        explore(LOPSIDED, two_bumps)


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_the_region_is_where_no_mode_grows(scheme):
    rng = np.random.default_rng(1)
    z = rng.uniform(-5, 3, 4000) + 1j * rng.uniform(-5, 5, 4000)
    growth = np.abs(scheme.stability_function(z))
    clear = np.abs(growth - 1) > 0.02  # a polygon cuts corners
    points = np.column_stack([z.real, z.imag])
    polygons = [Polygon(corners) for corners in tables.region(scheme)]
    inside = np.sum([polygon.contains_points(points) for polygon in polygons], axis=0) % 2 == 1
    assert (inside == (growth < 1))[clear].all()
    assert 0.01 < inside.mean() < 0.99


@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED, Robot(40, 60), Robot(9000, 9000, c1=0, c2=9)])
def test_every_slider_holds_the_robots_own_value(robot):
    family = Family(robot, GaussianBump(height=-0.03, sigma=0.2))
    for name, value in family.own.items():
        assert value in family.ranges[name], name
        assert family.ranges[name].low < family.ranges[name].high
    assert family.robot_at(**{name: family.own[name] for name in ("k", "c")}) is robot
    assert family.road_at(0.01, 0.05) == GaussianBump(height=0.01, sigma=0.05)


def test_springs_and_dampers_keep_their_ratios():
    other = Family(LOPSIDED, BUMP).robot_at(1400, 1.0)
    assert (other.k2, other.c2) == (pytest.approx(2000), pytest.approx(0.25))
    undamped = Family(Robot(700, 700, c1=0, c2=0), BUMP)
    assert undamped.own["c"] == 0 and undamped.robot_at(700, 2.0).c2 == 2.0
    front_only = Family(Robot(700, 700, c1=0, c2=3.0), BUMP)
    assert front_only.own["c"] == 3.0
    assert (front_only.robot_at(700, 2.0).c1, front_only.robot_at(700, 2.0).c2) == (0, 2.0)


@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED, Robot(700, 700, c1=0, c2=0)])
def test_the_matrices_are_taken_apart_exactly(robot):
    family = Family(robot, BUMP)
    for k, c in ((250.0, 0.0), (1234.5, 4.2)):
        other = family.robot_at(k, c)
        for name in ("C", "D"):
            parts = {key: np.array(part) for key, part in family.model()[name].items()}
            found = parts["1"] + k * parts["k"] + c * parts["c"]
            np.testing.assert_allclose(found, getattr(other, name), rtol=1e-12, atol=1e-9)


def test_a_model_that_is_not_affine_is_refused():
    with pytest.raises(ValueError, match="must be affine in k and c, is off by"):
        affine(lambda k, c: np.array([[k * c]]), 700.0)


def test_round_steps_are_on_the_slider_fine_to_coarse():
    assert list(DTS) == sorted(DTS)
    assert {0.2, 0.1, 0.001, 0.0005, 0.00025} <= set(DTS)


def test_trajectory_is_simulate_at_the_settings():
    box = explore(ROBOT, BUMP, v=5, dt=0.0021, k=1000, c=2, height=0.01, sigma=0.04, scheme=HEUN)
    expected = simulate(
        Robot(1000, 1000, c1=2, c2=2),
        GaussianBump(height=0.01, sigma=0.04),
        v=5,
        dt=0.0021,
        tfinal=1.25 / 5,
        scheme=HEUN,
    )
    np.testing.assert_array_equal(box.explorer.trajectory().N, expected.N)
    assert box.explorer.schemes == (*SCHEMES, HEUN)


@pytest.mark.parametrize("v", [0.25, 1.2, 10])
@pytest.mark.parametrize(
    "robot, road", [(ROBOT, BUMP), (LOPSIDED, two_bumps), (ROBOT, GaussianBump(-0.02))]
)
def test_it_opens_just_before_the_front_wheel_meets_the_bump(robot, road, v):
    explorer = explore(robot, road, v=v).explorer
    X = explorer.time * explorer.distance
    ahead = X + robot.L2 - 0.3  # of the front wheel, beside the first bump's middle
    assert -4 * BUMP.sigma < ahead < -2.5 * BUMP.sigma
    assert abs(road(np.array([X + robot.L2]))[0][0]) < 0.02 * BUMP.height
    wild = explore(robot, road, v=v, motion="flying").explorer
    assert wild.time == explorer.time


def test_a_level_road_is_opened_at_its_start():
    assert explore(ROBOT, FlatRoad()).explorer.time == 0


def test_what_python_has_set_stays_as_it_is():
    given = {"v": 0.8123456789, "dt": 0.00212345, "k": 703.123456, "c": 2.0123456}
    box = explore(LOPSIDED, BUMP, **given, scheme="Crank-Nicolson", view="robot")
    explorer = box.explorer
    assert explorer.view == "robot"
    assert {name: getattr(explorer, name) for name in given} == given
    assert (explorer.height, explorer.sigma) == (BUMP.height, BUMP.sigma)
    assert explorer.scheme.name == "Crank-Nicolson"


def test_speed_and_step_have_sliders_of_ipywidgets():
    box = explore(ROBOT, BUMP, asked=(0.77,))
    assert all(type(made) is SelectionSlider for made in box.sliders.values())
    above, below = box.children
    assert below is box.explorer and above.children == tuple(box.sliders.values())
    assert [made.description for made in above.children] == ["Speed v (m/s)", "Step Δt (ms)"]
    for name, made in box.sliders.items():
        reach, values = box.explorer.ranges[name], [value for _, value in made.options]
        assert (values[0], values[-1]) == (reach.low, reach.high) and values == sorted(values)
        ways = np.diff(np.log(values)) / np.log(reach.high / reach.low)
        assert 0 < ways.min() and ways.max() < 0.02  # an arrow key
    assert 0.77 in dict(box.sliders["v"].options).values()
    assert set(DTS) <= set(dict(box.sliders["dt"].options).values())
    compact = explore(ROBOT, BUMP, compact=True)
    assert list(compact.sliders) == ["v"]
    assert compact.children == (compact.children[0], compact.explorer)


@pytest.mark.parametrize("ends", [(1.0, 1.1), (1.0, 1.0001), (0.1, 25), (3.14159, 2718.28)])
def test_a_slider_has_all_its_stops_in_any_range(ends):
    values = stops(Range(*ends, True), 120)
    assert len(values) == 120 and (values[0], values[-1]) == ends
    ways = np.diff(np.log(values)) / np.log(ends[1] / ends[0])
    assert 0 < ways.min() and ways.max() < 0.02


def test_sliders_follow_and_lead_and_write_nothing_back():
    """Whoever sets it, by whatever way: both have exactly what was set last."""
    rng = np.random.default_rng(5)
    box = explore(ROBOT, BUMP, v=1.23456789, dt=0.00123456789)
    explorer = box.explorer
    set_by_now = []
    explorer.observe(lambda change: set_by_now.append((change["name"], change["new"])), "v")
    explorer.observe(lambda change: set_by_now.append((change["name"], change["new"])), "dt")
    expected = []
    for _ in range(300):
        name = ("v", "dt")[rng.integers(2)]
        made, reach = box.sliders[name], explorer.ranges[name]
        before = getattr(explorer, name)
        way = rng.integers(5)
        exact = float(reach.low * (reach.high / reach.low) ** rng.uniform())
        if way == 0:
            value = exact
            setattr(explorer, name, value)
        elif way == 1:  # as the browser sends a number that was typed
            value = exact
            explorer.set_state({name: value})
        elif way == 2:  # as the browser sends a slider that was moved
            index = int(rng.integers(len(made.options)))
            value = made.options[index][1]
            made.set_state({"index": index})
        elif way == 3:
            value = made.options[rng.integers(len(made.options))][1]
            made.value = value
        else:
            value = (reach.low, reach.high)[rng.integers(2)]
            setattr(explorer, name, value)
        if value != before:
            expected.append((name, value))
        assert getattr(explorer, name) == made.value == value
        scale = {"v": 1, "dt": 1000}[name]
        assert float(made.label) == pytest.approx(value * scale, rel=1e-11)
    assert set_by_now == expected


def test_a_refused_speed_moves_no_slider():
    box = explore(ROBOT, BUMP, v=1.23456789)
    for bad in (np.nan, 1e9):
        with pytest.raises(ValueError, match="^v must be"):
            box.explorer.v = bad
        assert box.explorer.v == box.sliders["v"].value == 1.23456789


@pytest.mark.parametrize("name", ["v", "dt", "k", "c", "height", "sigma", "time"])
def test_no_number_becomes_one_that_is_none(name):
    explorer = explore(ROBOT, BUMP).explorer
    before = getattr(explorer, name)
    for bad in (np.nan, np.inf, -np.inf, 1e9, -1e9):
        with pytest.raises(ValueError, match=f"^{name} must be .*, got {bad!r}"):
            setattr(explorer, name, bad)
        assert getattr(explorer, name) == before
    with pytest.raises(ValueError, match="^scheme_index must be one of"):
        explorer.scheme_index = 4


CAR = Robot(20000, 22000, m=1200, Izz=1800, L1=1.3, L2=1.3, c1=1500, c2=1500)
SPEED_BUMP = GaussianBump(height=0.05, sigma=0.3, centre=3.0)


def test_the_problems_robot_keeps_its_way_and_its_speeds():
    for robot in (ROBOT, Robot(793.2, 793.2, c1=0, c2=0), LOPSIDED):
        for road in (BUMP, two_bumps, FlatRoad()):
            explorer = explore(robot, road).explorer
            speeds = explorer.ranges["v"]
            assert (speeds.low, speeds.high) == (0.1, 25.0)
            assert (explorer.distance, explorer.v) == (problem.DISTANCE, 1.2)


@pytest.mark.parametrize("length", [0.01, 0.3, 1, 7, 1000])
@pytest.mark.parametrize("frequency", [0.2, 1, 5])
def test_a_scaled_robot_has_scaled_speeds_and_a_scaled_way(length, frequency):
    """Lengths times `length`, rates times `frequency`: only to the next round number, of course."""
    k = ROBOT.k1 * frequency**2
    arms = {"L1": ROBOT.L1 * length, "L2": ROBOT.L2 * length, "Izz": ROBOT.Izz * length**2}
    c = ROBOT.c1 * frequency
    robot = Robot(k, k, **arms, c1=c, c2=c)
    bump = GaussianBump(BUMP.height * length, BUMP.sigma * length, BUMP.centre * length)
    family = Family(robot, bump)
    low, high = family.speeds
    assert high / low == pytest.approx(250)
    assert 1 / 1.6 < low / (0.1 * length * frequency) < 1.6
    assert 1 <= family.way / (1.2278 * length) * (1 + 1e-9) < 1.4
    for name, value in family.own.items():
        reach = family.ranges[name]
        assert reach.low <= value <= reach.high
        assert 1.5 * value <= reach.high <= 10.1 * value


@pytest.mark.parametrize("centre", [0.3, 3.0, 40.0])
@pytest.mark.parametrize("robot", [ROBOT, LOPSIDED, CAR])
def test_the_way_passes_the_whole_bump_and_more(robot, centre):
    bump = GaussianBump(height=0.05, sigma=0.3, centre=centre)
    assert Family(robot, bump).way > centre + robot.L1 + 4 * bump.sigma + 6


@pytest.mark.slow
@pytest.mark.parametrize("bump", [SPEED_BUMP, replace(SPEED_BUMP, height=0.001)])
def test_a_car_has_sensible_ranges_and_true_words(bump):
    box = explore(CAR, bump)
    explorer = box.explorer
    speeds = explorer.ranges["v"]
    assert speeds.low < 1 and 40 < speeds.high < 100
    exact = critical_by_hand(CAR, bump, speeds, explorer.distance)
    html = box.html()
    np.testing.assert_allclose(explorer.facts["exact"]["critical"], exact, rtol=1e-3)
    lost = "wheel leaves the ground" in re.search(r'alt="([^"]+)"', html)[1]
    assert lost == (margin(CAR, bump, explorer.v, explorer.distance / explorer.v) < 0)
    assert state_of(html)["facts"]["springEnd"] is None


def critical_by_hand(robot, bump, speeds, distance):
    """Where the sign of the margin turns, on a fine grid."""
    v = np.geomspace(speeds.low, speeds.high, 300)
    kept = np.array([margin(robot, bump, x, distance / x) > 0 for x in v])
    turns = np.flatnonzero(kept[1:] != kept[:-1])
    found = []
    for i in turns:
        low, high = v[i], v[i + 1]
        while high / low > 1 + 1e-4:
            middle = np.sqrt(low * high)
            same = (margin(robot, bump, middle, distance / middle) > 0) == kept[i]
            low, high = (middle, high) if same else (low, middle)
        found.append(low)
    return found


def test_speeds_asked_for_are_in_reach_and_marked():
    explorer = explore(ROBOT, BUMP, asked=(0.05, 40)).explorer
    assert (explorer.ranges["v"].low, explorer.ranges["v"].high) == (0.05, 40)
    assert explorer.facts["asked"] == (0.05, 40) and explore(ROBOT, BUMP).explorer.asked == ()
    own = explore(ROBOT, BUMP, speeds=(2, 5), v=3).explorer.ranges["v"]
    assert (own.low, own.high) == (2, 5)


@pytest.mark.slow
def test_a_road_that_is_no_bump_has_no_sliders_for_one():
    box = explore(ROBOT, two_bumps)
    assert "height" not in re.findall(r'data-trait="(\w+)"', box.html())
    with pytest.raises(ValueError, match="height and sigma must be left out"):
        explore(ROBOT, two_bumps, height=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("road", [BUMP, FlatRoad()])
@pytest.mark.parametrize("scheme", [EULER, HEUN], ids=lambda scheme: scheme.name)
def test_the_lines_of_python_reproduce_the_run(road, scheme):
    explorer = explore(LOPSIDED, road, v=7.5, dt=0.0015, k=900, c=1.1, scheme=scheme).explorer
    given = explorer.facts["python"]
    values = {"v": 7.5, "dt": 0.0015, "scheme": given["schemes"][explorer.scheme_index]}
    for name, (slider, ratio) in given["gaps"].items():
        values[name] = getattr(explorer, slider) * ratio
    text = f"{given['text']}\n{given['flight']}"
    namespace = {}
    exec(re.sub(r"\{(\w+)\}", lambda gap: str(values[gap[1]]), text), namespace)
    run = explorer.trajectory()
    np.testing.assert_allclose(namespace["run"].N, run.N, rtol=1e-9, atol=1e-9)
    assert namespace["flight"].v == 7.5


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *[("v", value) for value in (0, 0.09, 26, np.nan, "fast")],
        *[("dt", value) for value in (0, 0.3, np.nan)],
        *[("k", value) for value in (0, -1, np.inf)],
        *[("c", value) for value in (-1, 100)],
        *[("height", value) for value in (-0.1, 1)],
        *[("sigma", value) for value in (0, 1)],
        ("motion", "walking"),
        *[("time", value) for value in (-0.1, 1.1, np.nan)],
        *[("distance", value) for value in (0, np.inf)],
        *[("speeds", value) for value in ((1, 2, 3), 5, (5, 1), (0, 1), (1, np.nan))],
        *[("asked", value) for value in ([0], [np.nan], ["fast"])],
        *[("spring_end", value) for value in (0, -1, np.nan)],
        ("scheme", "RK5"),
        ("view", "top"),
    ],
)
def test_a_bad_argument_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=rf"^{name}(\[[01]\])? must "):
        explore(ROBOT, BUMP, **{name: value})


@pytest.mark.parametrize(
    ("robot", "road", "name"),
    [(None, BUMP, "robot"), (793.2, BUMP, "robot"), (ROBOT, None, "road"), (ROBOT, "bump", "road")],
)
def test_a_thing_of_the_wrong_kind_is_refused(robot, road, name):
    with pytest.raises(TypeError, match=f"^{name} must be a "):
        explore(robot, road)


@pytest.mark.parametrize(
    "road",
    [
        lambda x: (x, np.full_like(x, np.nan)),
        lambda x: (0.0, 0.0),
        lambda x: (x[:-1], x[:-1]),
    ],
)
def test_a_bad_road_is_refused(road):
    with pytest.raises(ValueError, match="^road must "):
        explore(ROBOT, road)


def state_of(html):
    """What a page's script finds in the HTML."""
    return json.loads(re.search(r'class="se-state">(.*?)</script>', html, re.DOTALL)[1])


@pytest.mark.slow
def test_a_page_gets_controls_state_and_a_still_picture_with_a_text():
    box = explore(ROBOT, BUMP, v=1.2)
    html = box._repr_mimebundle_()["text/html"]
    state = state_of(html)
    assert '<div class="se-controls">' in html and "Run All" not in html
    assert state["v"] == 1.2 and state["facts"]["own"]["k"] == 793.2
    assert base64.b64decode(state["tables"]["road"]) == box.explorer.tables["road"]
    traits = re.findall(r'data-trait="(\w+)"', html)
    assert traits == ["v", "dt", "k", "c", "height", "sigma", "scheme_index"]
    alt, source = re.search(r'<img class="[\w-]+" alt="([^"]+)" src="([^"]+)">', html).groups()
    run = box.explorer.trajectory()
    assert "at 1.2 metres per second the front wheel leaves the ground" in alt
    assert f"the smallest force is {quantity(run.N.min(), 'newtons')}" in alt and "−" in alt
    assert unquote(source).startswith("data:image/svg+xml,<?xml")
    assert unquote(source).rstrip().endswith("</svg>")
    assert len(gzip.compress(html.encode())) < 110_000


@pytest.mark.slow
def test_a_notebook_gets_a_still_picture_that_says_what_to_run_and_then_the_widget():
    shown = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("suspension.explorer.display", lambda data, **how: shown.append((data, how)))
        explore(ROBOT, BUMP, compact=True).show("name")
    (page, how), (widget, _) = shown
    assert how["metadata"]["scrapbook"]["name"] == "name"
    assert set(page) == {"text/html", "image/svg+xml"}
    for text in page.values():
        assert "run the notebook (Run &gt; Run All Cells)" in text
    ElementTree.fromstring(page["image/svg+xml"])  # well-formed
    assert '<div class="se-controls" hidden>' in page["text/html"]  # dead, they are not shown
    view = "application/vnd.jupyter.widget-view+json"
    assert widget[view]["model_id"] and widget["text/html"] == ""


def test_what_to_run_stands_below_the_picture():
    svg = '<svg width="10pt" height="20pt" viewBox="0 0 10 20"><g/></svg>'
    grown = ElementTree.fromstring(picture(svg))
    assert grown.get("height") == "44pt" and grown.get("viewBox") == "0 0 10 44"
    assert 20 < float(grown[-1].get("y")) < 44 and "Run All Cells" in grown[-1].text


@pytest.mark.slow
def test_the_still_picture_keeps_its_letters_and_rounds_its_lines():
    picture = unquote(explore(ROBOT, BUMP).html())
    letters = "".join(re.findall(r"<defs>.*?</defs>", picture, re.DOTALL))
    assert re.search(r"\.\d{3}", letters)
    lines = re.sub(r"<defs>.*?</defs>", "", picture, flags=re.DOTALL)
    found = re.findall(r' d="([^"]*)"', lines)
    assert sum(map(len, found)) > 10_000
    assert not re.search(r"\.\d{3}", "".join(found))


@pytest.mark.slow
def test_a_compact_one_has_one_slider():
    html = explore(ROBOT, BUMP, compact=True).html()
    assert re.findall(r'data-trait="(\w+)"', html) == ["v"]
    assert "se-compact" in html and state_of(html)["facts"]["panels"] == ["robot", "speeds"]
    alt = re.search(r'alt="([^"]+)"', html)[1]
    assert "least force of each wheel at every speed" in alt and "stability region" not in alt


@pytest.mark.slow
def test_the_chart_has_two_sliders_and_a_still_picture_that_says_where_contact_is_kept():
    html = explore(ROBOT, BUMP, compact="chart", asked=(0.25, 5)).html()
    assert re.findall(r'data-trait="(\w+)"', html) == ["c", "height"]
    facts = state_of(html)["facts"]
    assert facts["panels"] == ["chart"] and facts["compact"] is True
    low, high = facts["chart"]["heights"]
    v = np.geomspace(0.1, 25, 50)
    assert 2 * low < highest_bump(ROBOT, BUMP, v).min() < BUMP.height < high / 2
    alt, source = re.search(r'<img class="[\w-]+" alt="([^"]+)" src="([^"]+)">', html).groups()
    found = regimes(ROBOT, BUMP, 0.1, 25)
    assert ranges(found) in alt and "25.4\xa0millimetres" in alt
    assert "speed" in unquote(source) and unquote(source).rstrip().endswith("</svg>")


@pytest.mark.slow
@pytest.mark.parametrize(
    "settings",
    [{"height": 0}, {"c": 0}, {"robot": Robot(700, 1000, L1=0.12, L2=0.09, c1=2, c2=0.5)}],
)
def test_the_chart_is_drawn_at_the_ends_of_its_sliders_and_for_other_robots(settings):
    robot = settings.pop("robot", ROBOT)
    html = explore(robot, BUMP, compact="chart", **settings).html()
    assert "se-chart-only" in html and "contact is kept" in html


@pytest.mark.parametrize(
    "robot, road",
    [
        (Robot(793.2, 793.2, g=0), BUMP),
        (ROBOT, lambda x: (0 * x, 0 * x)),
        (ROBOT, GaussianBump(height=-0.01)),
    ],
)
def test_no_chart_without_a_load_or_a_bump(robot, road):
    with pytest.raises(ValueError, match="^compact must not be 'chart' unless road is a Gauss"):
        explore(robot, road, compact="chart")


@pytest.mark.slow
def test_flying_it_is_drawn_with_its_wheels_in_the_air():
    flying = explore(ROBOT, BUMP, v=5, motion="flying", compact=True).explorer
    linear = explore(ROBOT, BUMP, v=5, compact=True).explorer
    flight = flying.flight()
    for explorer in (flying, linear):
        explorer.time = flight.T[flight.gaps.max(axis=0).argmax()] * 5 / 1.25
        explorer.know_critical_speeds()
    assert draw(flying) != draw(linear)


@pytest.mark.slow
def test_a_race_has_a_lane_for_each_speed_and_a_still_picture_that_tells_who_lifts():
    html = explore(ROBOT, BUMP, compact="race", motion="flying", asked=(0.25, 1.2, 5, 10)).html()
    assert "se-race-only" in html and not re.findall(r'data-trait="(\w+)"', html)
    state = state_of(html)
    assert state["facts"]["lanes"] == [0.25, 1.2, 5, 10] and state["time"] == 0
    alt, source = re.search(r'<img class="[\w-]+" alt="([^"]+)" src="([^"]+)">', html).groups()
    for v in (0.25, 1.2, 5, 10):
        said = re.search(rf"at {v:g} metres per second ([^;.]+)", alt)[1]
        wheels = {event.wheel for event in fly(ROBOT, BUMP, v=v, tfinal=1.25 / v).events}
        words = {0: "both wheels stay", 1: "wheel leaves", 2: "both wheels leave"}[len(wheels)]
        assert words in said and (not wheels) == (margin(ROBOT, BUMP, v) > 0)
    assert unquote(source).rstrip().endswith("</svg>")
    with pytest.raises(ValueError, match="^asked must be two speeds or more for a race"):
        explore(ROBOT, BUMP, compact="race", asked=(1,))


def test_a_pin_is_a_run_or_refused():
    explorer = explore(ROBOT, BUMP, v=1.2).explorer
    explorer.pin = {"v": 5.0, "k": 300.0}
    own = explorer.family.own
    assert explorer.pin == own | {
        "v": 5.0,
        "k": 300.0,
        "dt": 0.001,
        "scheme_index": 3,
        "motion": "linear",
    }
    for bad in ({"v": np.nan}, {"k": 1e9}, {"facts": 1}, {"motion": "walking"}):
        with pytest.raises(ValueError, match="pin must be"):
            explorer.pin = bad
    explorer.pin = {}
    assert explorer.pin == {}
    for name, bad in (("pace", "fast"), ("view", "top"), ("mapped", "yes")):
        with pytest.raises(traitlets.TraitError):
            setattr(explorer, name, bad)


def test_presets_become_buttons_that_the_page_can_set():
    presets = [
        ("Long <step>", {"dt": 0.1, "scheme": HEUN}),
        ("Up", {"motion": "flying", "time": 1}),
    ]
    box = explore(ROBOT, BUMP, schemes=(*SCHEMES, HEUN), presets=presets)
    assert box.explorer.facts["presets"] == [
        ["Long <step>", {"dt": 0.1, "scheme": "Heun"}],
        ["Up", {"motion": "flying", "time": 1.0}],
    ]
    assert '<button type="button" data-preset="0">Long &lt;step&gt;</button>' in native(
        box.explorer
    )


@pytest.mark.parametrize(
    ("settings", "complaint"),
    [
        ({"v": 26}, "v of presets must be 0.1 to 25"),
        ({"scheme": "RK5"}, "scheme of presets must be one of"),
        ({"motion": "walking"}, "motion of presets must be one of"),
        ({"time": 2}, "time of presets must be a fraction"),
        ({"view": "robot"}, "presets must not set 'view'"),
    ],
)
def test_a_bad_preset_is_refused(settings, complaint):
    with pytest.raises(ValueError, match=f"^{complaint}"):
        explore(ROBOT, BUMP, presets=[("Wrong", settings)])


@pytest.mark.slow
def test_the_still_picture_of_a_run_past_the_largest_number_has_words():
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        html = explore(ROBOT, BUMP, dt=0.2, v=0.1, distance=200).html()
    alt = re.search(r'alt="([^"]+)"', html)[1]
    assert "the smallest force has no limit" in alt and "unstable" in alt
    assert not re.search(r"\b(nan|inf)\b", alt)


def test_what_a_page_has_to_load_is_small():
    scripts = page_script() + page_style()
    assert len(gzip.compress(scripts.encode())) < 50_000
    assert not re.search(r"^\s*(import|export)\b", page_script(), re.MULTILINE)
