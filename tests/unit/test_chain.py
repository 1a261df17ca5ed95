"""From a reading to a verdict: the page's numbers are those of statsmodels and of the package."""

import json
from functools import cache

import numpy as np
import pandas as pd
import pytest
from cases import readings
from node import run_in_node
from scipy import stats

from suspension import GaussianBump, Robot
from suspension.explorer.chain import LEVEL, REACH, Chain, along, interpolate
from suspension.problem import DELTA_MAX, SPEEDS
from suspension.springs import fit_spring
from suspension.uncertainty import _within, critical_speed_intervals, loss_probability

pytestmark = pytest.mark.slow  # Node runs beside the package

VMIN, VMAX = 0.25, 12.0  # m/s: all that is asked for
SETS = 60
ROBOT, BUMP = Robot(800, 800), GaussianBump()

ASK = """
import { readFileSync } from "node:fs";
import { follow, makeBranch, student } from "./page/readings.js";

const { facts, sets, students } = JSON.parse(readFileSync("given.json"));
const branches = facts.branches.map(makeBranch);
const plain = (key, value) => (typeof value === "function" ? undefined : value);
const told = sets.map((readings) => {
  const found = follow(readings, facts, branches);
  if (found.fit) found.bands = [0, 0.3, 1].map(found.fit.band);
  return found;
});
const cdf = students.map(([t, free]) => student(t, free));
console.log(JSON.stringify({ told, cdf }, plain));
"""


def table(pairs):
    return pd.DataFrame(pairs, columns=["delta_over_delta_max", "force"])


@cache
def chain():
    return Chain(readings(800, noise=0.12), ROBOT, BUMP, asked=SPEEDS, vmin=VMIN, vmax=VMAX)


def random_sets():
    """Readings of many kinds: few and many, tight and scattered, with outliers and preloads."""
    rng = np.random.default_rng(22)
    for n in range(SETS):
        points = int(rng.integers(4, 33))
        x = np.sort(rng.uniform(0, 1, points))
        k = 800 * np.exp(rng.uniform(-0.6, 0.6))
        force = rng.uniform(-2, 2) + k * DELTA_MAX * x + rng.uniform(-2, 2) * x**2
        force += rng.normal(0, 10 ** rng.uniform(-3, -0.5), points)
        if n % 3 == 0:
            force[rng.integers(points)] += 3
        yield np.column_stack([x, force]).round(4).tolist()


@pytest.fixture(scope="module")
def asked(tmp_path_factory):
    """What the page tells of all sets, from one process."""
    folder = tmp_path_factory.mktemp("node")
    sets = list(random_sets())
    students = [(t, free) for free in (1, 2, 3, 4, 18, 29) for t in (-40.0, -2.1, -0.3, 0, 1, 6)]
    given = {"facts": chain().facts, "sets": sets, "students": students}
    (folder / "given.json").write_text(json.dumps(given), encoding="utf-8")
    answer = json.loads(run_in_node(folder, ASK))
    return sets, students, answer


def close(got, expected, size=None, part=1e-9):
    """Whether numbers agree to this part of their size, or of a given one."""
    expected = np.asarray(expected, dtype=float)
    size = np.abs(expected) if size is None else size
    assert np.all(np.abs(np.asarray(got, dtype=float) - expected) <= part * size), (got, expected)


def test_the_page_fits_as_statsmodels_does(asked):
    sets, _, answer = asked
    for pairs, told in zip(sets, answer["told"], strict=True):
        fit, mine = fit_spring(table(pairs)), told["fit"]
        size = np.abs(fit.beta).max()
        close(mine["beta"], fit.beta, size)
        close(mine["errors"], fit.errors)
        close(mine["k"], fit.stiffness)
        close(mine["alone"], fit.intervals(LEVEL, "individual"), size)
        close(mine["joint"], fit.intervals(LEVEL), size)
        close(mine["interval"], fit.stiffness_interval(LEVEL), size / DELTA_MAX)
        close(told["bands"], np.diff(fit.band([0, 0.3, 1], LEVEL), axis=0)[0] / 2)


def test_the_page_tests_the_line_as_statsmodels_does(asked):
    sets, _, answer = asked
    verdicts = set()
    for pairs, told in zip(sets, answer["told"], strict=True):
        fit, test = fit_spring(table(pairs)), told["fit"]["test"]
        exact = fit.linearity(LEVEL)
        close(test["F"], exact.statistic, max(exact.statistic, 1))
        close(test["p"], exact.pvalue, 1)
        assert test["joint"] == exact.joint and test["inside"] == (exact.pvalue >= 1 - LEVEL)
        assert exact.linear == (test["joint"] and test["inside"])
        V, b = fit.covariance[np.ix_([0, 2], [0, 2])], fit.beta[[0, 2]]
        assert test["inside"] == (b @ np.linalg.solve(V, b) <= told["fit"]["region"])
        verdicts.add(test["inside"])
    assert verdicts == {True, False}


def test_the_page_knows_students_distribution(asked):
    _, students, answer = asked
    t, free = np.transpose(students)
    np.testing.assert_allclose(answer["cdf"], stats.t.cdf(t, free), rtol=0, atol=1e-14)


def test_critical_speeds_are_the_packages_within_the_tables_error(asked):
    """The branches are followed once for all sets; what is in an interval is the package's word."""
    sets, _, answer = asked
    error, ends = chain().facts["error"], chain().facts["k"]
    assert error <= 1e-4
    partial = 0
    for pairs, told in zip(sets, answer["told"], strict=True):
        fit = fit_spring(table(pairs))
        if not ends[0] <= fit.stiffness <= ends[1]:
            assert told["critical"] is None
            continue
        bounds = fit.stiffness_interval(LEVEL)
        whole = bool(ends[0] <= bounds[0] and bounds[1] <= ends[1])
        assert told["critical"]["isWhole"] == whole
        mine, exact = (
            told["critical"]["speeds"],
            _within(chain().branches, fit.stiffness, *np.clip(bounds, *ends)),
        )
        assert len(mine) == len(exact)
        for one, other in zip(mine, exact):
            close([one["low"], one["high"]], [other.low, other.high], part=3 * error)
            assert (one["speed"] is None) == (other.speed is None)
            if other.speed:
                close(one["speed"], other.speed, part=3 * error)
            for end in ("born", "dies"):
                there = getattr(other, end)
                assert (one[end] is None) == (there is None)
                if there:
                    close(one[end]["k"], there.k, part=1e-8)
                    assert one[end]["why"] == there.why
                    partial += 1
    assert partial  # some come or go within an interval


def test_critical_speeds_are_those_of_uncertainty(asked):
    """The whole way of the package, for a few of the sets."""
    sets, _, answer = asked
    error, done = chain().facts["error"], 0
    for pairs, told in zip(sets, answer["told"], strict=True):
        if done == 3 or not (told["critical"] and told["critical"]["isWhole"]):
            continue
        exact = critical_speed_intervals(fit_spring(table(pairs)), ROBOT, BUMP, VMIN, VMAX, LEVEL)
        mine = told["critical"]["speeds"]
        assert len(mine) == len(exact)
        for one, other in zip(mine, exact):
            close([one["low"], one["high"]], [other.low, other.high], part=3 * error)
        done += 1
    assert done == 3


def test_the_confidence_of_a_verdict_is_that_of_uncertainty(asked):
    sets, _, answer = asked
    low, high = chain().facts["k"]
    compared = []
    for n, (pairs, told) in enumerate(zip(sets, answer["told"], strict=True)):
        if told["verdicts"] is None:
            continue
        fit = fit_spring(table(pairs))
        v, verdict = SPEEDS[n % len(SPEEDS)], told["verdicts"][n % len(SPEEDS)]
        assert verdict["v"] == v
        beyond, k = verdict["beyond"], fit.slope.distribution
        assert beyond <= k.cdf(low) + k.sf(high) + 1e-12
        exact = loss_probability(fit, ROBOT, BUMP, v)
        assert verdict["lost"] - 1e-9 <= exact <= verdict["lost"] + beyond + 1e-9
        if beyond == 0:
            compared.append(exact)
    assert len(compared) >= SETS / 4
    assert any(0.02 < p < 0.98 for p in compared)


def test_readings_that_cannot_be_judged_are_refused_by_the_page(tmp_path):
    facts = chain().facts
    x = np.linspace(0, 1, len(facts["quantiles"]["t"]) + 4)
    sets = [
        [[0, 0], [0.5, 6], [1, 13]],
        [[0, 0], [0, 0.1], [1, 13], [1, 13.1]],
        np.column_stack([x, 13 * x]).tolist(),
    ]
    given = {"facts": facts, "sets": sets, "students": []}
    (tmp_path / "given.json").write_text(json.dumps(given), encoding="utf-8")
    told = json.loads(run_in_node(tmp_path, ASK))["told"]
    assert all(set(one) == {"why"} for one in told)
    assert [one["why"].split()[0] for one in told] == ["with", "a", "there"]


def test_readings_on_a_line_have_intervals_without_a_width(tmp_path):
    x = np.linspace(0, 1, 11).round(1)
    line = np.column_stack([x, (13.2 * x).round(2)]).tolist()
    bent = np.column_stack([x, (13.2 * x + x**2).round(2)]).tolist()
    given = {"facts": chain().facts, "sets": [line, bent], "students": []}
    (tmp_path / "given.json").write_text(json.dumps(given), encoding="utf-8")
    told = json.loads(run_in_node(tmp_path, ASK))["told"]
    for pairs, one in zip((line, bent), told):
        fit = fit_spring(table(pairs))
        assert fit.exact and one["fit"]["isExact"]
        assert one["fit"]["test"]["inside"] == fit.linearity().linear
        for v, verdict in zip(SPEEDS, one["verdicts"]):
            assert verdict["lost"] == loss_probability(fit, ROBOT, BUMP, v)


def test_the_table_is_as_good_as_it_says_at_other_places():
    facts = chain().facts
    rng = np.random.default_rng(3)
    off = []
    for told, branch in zip(facts["branches"], chain().branches, strict=True):
        y, x = np.array(told["k"]), np.array(told["v"])
        u = along(y, y[0], y[-1])
        assert (np.diff(u) > 0).all()
        for place in rng.uniform(y[0], y[-1], 12):
            got = interpolate(u, x, along(np.array([place]), y[0], y[-1]))[0]
            off.append(abs(got - np.log(branch.speed(np.exp(place)))))
    assert max(off) <= 3 * facts["error"]


def test_a_page_gets_a_still_picture_and_all_that_its_script_needs():
    html = chain().html()
    assert 'class="suspension-laboratory se-chain"' in html
    assert 'alt="Three pictures. The 21 readings' in html
    state = json.loads(html.split('class="se-state">')[1].split("</script>")[0])
    assert state["readings"] == state["facts"]["start"]
    assert [one["v"] for one in state["facts"]["asked"]] == list(SPEEDS)
    k = chain().fit.stiffness
    assert state["facts"]["k"] == [k / REACH, k * REACH]
    assert len(html) < 250_000


def test_the_readings_as_they_stand_are_there_in_python():
    own = chain()
    before = own.readings
    own.readings = [*before[:-1], [1.0, 20.0]]
    assert fit_spring(own.data).stiffness != own.fit.stiffness
    own.readings = before
    np.testing.assert_allclose(fit_spring(own.data).beta, own.fit.beta, rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize(
    "pairs", [[[0, 0], [0.5, 6], [1, 13]], [[0, 3], [0.4, 2], [0.7, 1], [1, -1]]]
)
def test_readings_without_scatter_or_spring_are_refused(pairs):
    with pytest.raises(ValueError, match=r"^data must have four readings or more and a slope"):
        Chain(table(pairs), ROBOT, BUMP, asked=SPEEDS)


def test_a_link_brings_back_the_readings(tmp_path):
    facts = chain().facts
    start = facts["start"]
    moved = [[x, round(force + 0.1234, 4)] for x, force in start[1:]]
    script = """import { readLink, writeLink } from "./page/chain_link.js";
    import { readFileSync } from "node:fs";
    const { facts, sets, hashes } = JSON.parse(readFileSync("given.json"));
    console.log(JSON.stringify({
      links: sets.map((readings) => writeLink(readings, facts)),
      back: sets.map((readings) => readLink(writeLink(readings, facts), facts)),
      read: hashes.map((hash) => readLink(hash, facts)),
    }));"""
    many = ";".join(f"{n / 100}_1" for n in range(99))
    spoiled = ["#workshop:r=1_2", "#chain:x", "#chain:r=0_1;1_2;0.5_1", "#chain:r=0_1;0_2;1_1;1_3"]
    spoiled += ["#chain:r=0_1;0.5_;1_2;0.2_1", "#chain:r=0_1;1;0.5_1;0.2_1", f"#chain:r={many}"]
    spoiled += ["#chain:r=0_1;0.5_1e999;1_2;0.2_1", "#chain:r=-_1;0.5_1;1_2;0.2_1"]
    given = {"facts": facts, "sets": [start, moved, start[:4]], "hashes": spoiled}
    (tmp_path / "given.json").write_text(json.dumps(given), encoding="utf-8")
    found = json.loads(run_in_node(tmp_path, script))
    assert found["back"] == [start, moved, start[:4]]
    assert found["links"][0] == "#chain:" and found["links"][1].startswith("#chain:r=")
    assert found["read"] == [None] * len(spoiled)
