"""The explorer's Python half: what it hands to the page, checks and writes."""

import base64
import gzip
import inspect
import json
import re
import warnings
from urllib.parse import unquote

import numpy as np
import pytest
from matplotlib.path import Path as Polygon
from node import run_in_node

from suspension.explorer import DTS, SCHEMES, explore, page_script, page_style, tables
from suspension.explorer.bundle import bundle
from suspension.explorer.controls import native
from suspension.explorer.family import Family, affine
from suspension.explorer.settings import SPRING_END
from suspension.explorer.still import still
from suspension.report.words import quantity
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.schemes import EULER, Scheme
from suspension.simulation import simulate
from suspension.springs import fit_spring

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


def test_the_measured_spring_ends_where_the_fit_says():
    assert inspect.signature(fit_spring).parameters["delta_max"].default == SPRING_END


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


@pytest.mark.slow
def test_it_starts_where_contact_is_lost_or_nearly():
    lost = explore(ROBOT, BUMP, v=1.2).explorer
    assert lost.time * 1.25 / 1.2 == pytest.approx(lost.trajectory().loss.t, abs=1e-3)
    kept = explore(ROBOT, BUMP, v=0.25).explorer
    run = kept.trajectory()
    assert kept.time * 5 == pytest.approx(run.T[run.N.min(axis=0).argmin()], abs=5e-3)
    assert explore(ROBOT, BUMP, time=0.25).explorer.time == 0.25


def test_sliders_show_the_settings():
    box = explore(LOPSIDED, BUMP, v=0.8, dt=0.002, scheme="Crank-Nicolson", view="robot")
    *sliders, scheme = box.children[0].children
    explorer = box.explorer
    assert explorer in box.children and explorer.view == "robot"
    values = [slider.value for slider in sliders]
    assert values == pytest.approx([0.8, 0.002, 700, 2, 0.0254, 0.0288])
    assert scheme.index == explorer.scheme_index and scheme.label == "Crank-Nicolson"
    assert all(control.description for control in box.children[0].children)


@pytest.mark.slow
def test_a_road_that_is_no_bump_has_no_sliders_for_one():
    box = explore(ROBOT, two_bumps)
    assert len(box.children[0].children) == 5
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
        ("scheme", "RK5"),
        ("view", "top"),
    ],
)
def test_a_bad_argument_is_refused_by_name(name, value):
    with pytest.raises(ValueError, match=f"^{name} must "):
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
def test_flying_it_starts_where_a_wheel_is_highest_and_so_is_drawn():
    box = explore(ROBOT, BUMP, v=5, motion="flying", compact=True)
    flight, linear = box.explorer.flight(), explore(ROBOT, BUMP, v=5, compact=True)
    t = box.explorer.time * 1.25 / 5
    assert t == pytest.approx(flight.T[flight.gaps.max(axis=0).argmax()], abs=1e-9)
    linear.explorer.time = box.explorer.time
    assert still(box.explorer) != still(linear.explorer)


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
    assert len(gzip.compress(scripts.encode())) < 38_000
    assert not re.search(r"^\s*(import|export)\b", page_script(), re.MULTILINE)
