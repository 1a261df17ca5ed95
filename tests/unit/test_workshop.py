"""The workshop of schemes: what its page computes from a table is what the package computes."""

import json
from fractions import Fraction
from math import factorial

import numpy as np
import pytest
from helpers import PARITY, near
from node import run_in_node
from scipy.integrate import solve_ivp

from suspension import RK4, GaussianBump, Robot, Scheme, course, over_bump, simulate
from suspension.contact import normal_forces
from suspension.explorer import Workshop
from suspension.explorer.tables import shape_of
from suspension.explorer.workshop import KNOWN, longest_of_order_two

ROBOT, BUMP = Robot(800, 800), GaussianBump()

# Reads given.json: facts and many tables, as numbers or as texts, and what is asked of each.
ASK = """
import { readFileSync } from "node:fs";
import { growthAt, orderOf, readEntry, rowSums } from "./page/tableau.js";
import { alongAxis } from "./page/workshop_draw.js";
import { makeBench } from "./page/workshop_run.js";
import { examine, puzzles } from "./page/workshop_words.js";

const { facts, modes, tables, z, runs } = JSON.parse(readFileSync("given.json"));
const bench = facts && makeBench(facts);
for (const { a, b } of tables) {
  const texts = typeof b[0] === "string";
  const numbers = texts ? { a: a.map((row) => row.map(readEntry)), b: b.map(readEntry) } : { a, b };
  numbers.c = rowSums(numbers.a);
  const found = examine(numbers, modes);
  const answer = { ...found, limit: String(found.limit) };
  answer.values = z.map((point) => growthAt(found.R, point));
  answer.axis = alongAxis(found.R);
  answer.puzzles = puzzles(found, facts?.traded ?? 1);
  answer.runs = (runs ?? []).map(([v, dt]) => {
    const { run, exact, error, J, work } = bench.try(numbers, v, dt);
    const rows = (of, each) =>
      of.N.map((N) => Array.from({ length: J + 1 }, (_, n) => N[n * each]));
    return { N: run && rows(run, 1), exact: rows(exact.run, exact.each), error, work };
  });
  answer.curve = runs && bench.workCurve(numbers, runs[0][0]);
  console.log(JSON.stringify(answer));
}
"""


def ask(folder, tables, modes, z=(), **given):
    """What the page finds for each of the tables (a, b)."""
    tables = [{"a": np.asarray(a).tolist(), "b": np.asarray(b).tolist()} for a, b in tables]
    pairs = [[[w.real, w.imag] for w in np.asarray(points)] for points in (modes, z)]
    whole = {"tables": tables, "modes": pairs[0], "z": pairs[1], **given}
    (folder / "given.json").write_text(json.dumps(whole), encoding="utf-8")
    return [json.loads(line) for line in run_in_node(folder, ASK).splitlines()]


@pytest.fixture(scope="module")
def workshop():
    return Workshop(ROBOT, BUMP)


@pytest.fixture(scope="module")
def known(workshop, tmp_path_factory):
    """The page's findings for the methods one can start from, by name."""
    schemes = workshop.facts["schemes"]
    tables = [(scheme["a"], scheme["b"]) for scheme in schemes]
    folder = tmp_path_factory.mktemp("known")
    found = ask(folder, tables, ROBOT.eigenvalues, facts=workshop.facts)
    return {scheme["name"]: answer for scheme, answer in zip(schemes, found, strict=True)}


def collocation(c):
    """The method that collocates at the nodes c: order at least their number."""
    powers = np.arange(len(c))
    V = np.asarray(c)[:, None] ** powers  # of the monomials at the nodes
    a = (np.asarray(c)[:, None] ** (powers + 1) / (powers + 1)) @ np.linalg.inv(V)
    return a, (1 / (powers + 1)) @ np.linalg.inv(V)


def constructed(rng):
    """Forty methods of six families, consistent by construction."""
    for _ in range(6):  # any consistent ones
        s = int(rng.integers(1, 5))
        a, b = rng.uniform(-0.5, 0.7, (s, s)), rng.uniform(0.1, 1, s)
        yield np.tril(a, -1) if rng.random() < 0.5 else a, b / b.sum()
    for x in rng.uniform(0.3, 1, 8):  # two stages, order 2
        yield [[0, 0], [x, 0]], [1 - 1 / (2 * x), 1 / (2 * x)]
    for _ in range(8):  # three stages, order 3
        c2, c3 = rng.uniform(0.25, 0.55), rng.uniform(0.7, 1)
        b2 = (3 * c3 - 2) / (6 * c2 * (c3 - c2))
        b3 = (2 - 3 * c2) / (6 * c3 * (c3 - c2))
        a32 = 1 / (6 * b3 * c2)
        yield [[0, 0, 0], [c2, 0, 0], [c3 - a32, a32, 0]], [1 - b2 - b3, b2, b3]
    for x in rng.uniform(0.2, 0.9, 6):  # diagonally implicit with one free number, order 2
        yield [[x, 0], [1 - 2 * x, x]], [1 / 2, 1 / 2]
    for s in (1, 2, 3, 3, 4, 4):  # implicit, order s
        yield collocation(np.sort(rng.uniform(0, 1, s)) + 0.05 * np.arange(s))
    yield collocation([1 / 2 - np.sqrt(3) / 6, 1 / 2 + np.sqrt(3) / 6])
    yield collocation([1 / 3, 1])
    yield collocation([0, 1])
    yield collocation([0, 1 / 2, 1])
    yield RK4.a, RK4.b
    yield (
        [[0] * 4, [1 / 3, 0, 0, 0], [-1 / 3, 1, 0, 0], [1, -1, 1, 0]],
        [1 / 8, 3 / 8, 3 / 8, 1 / 8],
    )


def fitted(a, b, steps=(64, 128)):
    """The observed order for a nonlinear equation, y' = f(y) with two unknowns, from two steps."""
    a, b = np.asarray(a, float), np.asarray(b, float)

    def f(y):
        return np.array([y[1] * y[0] - y[0] + 0.4, np.sin(y[0]) - y[1] ** 2])

    def end(n):
        y, dt = np.array([1.0, 0.3]), 1 / n
        for _ in range(n):
            k = np.tile(f(y)[:, None], len(b))
            for _ in range(100):  # by iteration: the steps are short
                new = np.stack([f(y + dt * k @ row) for row in a], axis=1)
                done = np.abs(new - k).max() < 1e-16
                k = new
                if done:
                    break
            y = y + dt * k @ b
        return y

    found = solve_ivp(lambda t, y: f(y), (0, 1), [1, 0.3], method="DOP853", rtol=3e-14, atol=1e-15)
    exact = found.y[:, -1]
    errors = [np.abs(end(n) - exact).max() for n in steps]
    return np.log2(errors[0] / errors[1])


@pytest.mark.slow
def test_conditions_tell_the_order_that_a_run_shows(tmp_path):
    methods = list(constructed(np.random.default_rng(22)))
    assert len(methods) == 40
    found = ask(tmp_path, methods, ROBOT.eigenvalues)
    steps = {1: (256, 512), 2: (64, 128), 3: (32, 64), 4: (8, 16), 5: (4, 8)}
    for (a, b), answer in zip(methods, found, strict=True):
        assert answer["order"] == pytest.approx(fitted(a, b, steps[answer["order"]]), abs=0.3)
    assert {answer["order"] for answer in found} == {1, 2, 3, 4}


def test_known_methods_have_their_order_and_stability(known):
    orders = {
        "Euler": 1,
        "Midpoint": 2,
        "Heun": 2,
        "Kutta, order 3": 3,
        "RK4": 4,
        "3/8 rule": 4,
        "Butcher, order 5": 5,
        "Backward Euler": 1,
        "Implicit midpoint": 2,
        "Crank-Nicolson": 2,
        "SDIRK, order 2": 2,
        "Gauss-Legendre, order 4": 4,
        "Radau IIA, order 3": 3,
        "Lobatto IIIA, order 4": 4,
    }
    assert {name: answer["order"] for name, answer in known.items()} == orders
    stable = [name for name, answer in known.items() if answer["isAStable"]]
    damping = [name for name, answer in known.items() if answer["isLStable"]]
    assert stable == list(orders)[7:]
    assert damping == ["Backward Euler", "SDIRK, order 2", "Radau IIA, order 3"]
    for answer in list(known.values())[:7]:
        assert (answer["kind"], answer["because"]) == ("explicit", "polynomial")


def test_the_17_conditions_are_those_of_the_rooted_trees(tmp_path):
    script = """import { CONDITIONS } from "./page/tableau.js";
    console.log(JSON.stringify(CONDITIONS.map(({ order, density }) => [order, density])));"""
    conditions = json.loads(run_in_node(tmp_path, script))
    assert [sum(order == p for order, _ in conditions) for p in range(1, 6)] == [1, 1, 2, 4, 9]
    densities = sorted(density for order, density in conditions if order == 5)
    assert densities == [5, 10, 15, 20, 20, 30, 40, 60, 120]
    assert len({tuple(pair) for pair in conditions}) == 16  # two of order 5 have the same density


def random_schemes(rng, count=60):
    """Any tables of up to six stages, explicit, diagonally implicit and implicit."""
    for n in range(count):
        s = 1 + n % 6
        a, b = rng.normal(0, 0.5, (s, s)), rng.uniform(-0.2, 1, s)
        a = (np.tril(a, -1), np.tril(a), a)[n % 3]
        b = b / b.sum()
        yield Scheme("random", 1, a, b, a.sum(axis=1))


def test_random_tables_have_the_stability_function_and_limit_of_their_scheme(tmp_path):
    rng = np.random.default_rng(5)
    schemes = list(random_schemes(rng))
    z = rng.normal(0, 3, 40) + 1j * rng.normal(0, 3, 40)
    found = ask(tmp_path, [(s.a, s.b) for s in schemes], ROBOT.eigenvalues, z)
    limits = []
    for scheme, answer in zip(schemes, found, strict=True):
        values = [re + 1j * im for re, im in answer["values"]]
        expected = scheme.stability_function(z)
        np.testing.assert_allclose(values, expected, rtol=PARITY, atol=PARITY)
        limits.append(scheme.max_stable_dt(ROBOT.eigenvalues))
        assert float(answer["limit"]) == pytest.approx(limits[-1], rel=PARITY)
    assert {0.0, np.inf} & set(limits) and sum(0 < limit < np.inf for limit in limits) > 10


def test_limits_without_any_damping_are_those_of_the_schemes(workshop, tmp_path):
    modes = 1j * np.array([-38, -33, 33, 38])
    schemes = workshop.facts["schemes"]
    found = ask(tmp_path, [(scheme["a"], scheme["b"]) for scheme in schemes], modes)
    limits = []
    for answer in found:
        numbers = (np.array(answer["numbers"][name]) for name in "abc")
        limits.append(Scheme("", 1, *numbers).max_stable_dt(modes))
        assert float(answer["limit"]) == pytest.approx(limits[-1], rel=PARITY)
    assert {0.0, np.inf} <= set(limits) and min(np.abs(np.array(limits) - np.sqrt(8) / 38)) < 1e-12


def test_damping_and_phase_along_the_imaginary_axis_are_those_of_r(known):
    for answer in known.values():
        a, b, c = (np.array(answer["numbers"][name]) for name in "abc")
        y = np.array(answer["axis"]["ys"])
        R = Scheme("", 1, a, b, c).stability_function(1j * y)
        np.testing.assert_allclose(answer["axis"]["sizes"], np.abs(R), rtol=PARITY)
        phase = np.unwrap(np.angle(R))[1:] / y[1:]
        np.testing.assert_allclose(answer["axis"]["phases"][1:], phase, rtol=PARITY)
        assert phase[0] == pytest.approx(1, abs=1e-3)


def test_a_stable_means_that_nothing_grows_in_the_left_half_plane(tmp_path):
    rng = np.random.default_rng(8)
    schemes = list(random_schemes(rng, 120))
    for x in np.linspace(0.1, 1.2, 23):  # around the gamma where it begins
        schemes.append(Scheme("", 2, [[x, 0], [1 - 2 * x, x]], [0.5, 0.5], [x, 1 - x]))
    found = ask(tmp_path, [(s.a, s.b) for s in schemes], ROBOT.eigenvalues)
    y = np.concatenate([np.linspace(-50, 50, 4001), np.geomspace(50, 1e6, 200)])
    radius, angle = np.meshgrid(
        np.geomspace(1e-2, 1e6, 300), np.linspace(np.pi / 2, 3 * np.pi / 2, 161)
    )
    left = np.concatenate([1j * y, (radius * np.exp(1j * angle)).ravel()])
    verdicts = []
    for scheme, answer in zip(schemes, found, strict=True):
        most = np.abs(scheme.stability_function(left)).max()
        assert answer["isAStable"] == (most <= 1 + 1e-9), (scheme.a, scheme.b, most)
        verdicts.append(answer["isAStable"])
    assert 10 < sum(verdicts) < len(verdicts) - 10


def test_a_pole_that_cancels_is_none(tmp_path):
    # Backward Euler beside a stage that nothing uses: Q has a zero on the left, and so has P.
    [answer] = ask(tmp_path, [([[1, 0], [0, -1]], [1, 0])], ROBOT.eigenvalues)
    assert answer["isLStable"] and answer["because"] == ""
    [answer] = ask(tmp_path, [([[1, 0], [0, -1]], [0.5, 0.5])], ROBOT.eigenvalues)
    assert not answer["isAStable"]


@pytest.mark.parametrize("v, dt", [(0.25, 0.1), (1.2, 0.02), (10, 0.001)])
def test_runs_are_those_of_simulate_and_the_closed_form(workshop, tmp_path, v, dt):
    tables = [(s["a"], s["b"]) for s in workshop.facts["schemes"]]
    found = ask(tmp_path, tables, ROBOT.eigenvalues, facts=workshop.facts, runs=[(v, dt)])
    tfinal = workshop.facts["distance"] / v
    for answer in found:
        a, b, c = (np.array(answer["numbers"][name]) for name in "abc")
        run = simulate(ROBOT, BUMP, v=v, dt=dt, tfinal=tfinal, scheme=Scheme("", 1, a, b, c))
        W = over_bump(ROBOT, BUMP, v, run.T)
        exact = normal_forces(ROBOT, BUMP, v, run.T, W)
        [page] = answer["runs"]
        near(np.array(page["N"], float), run.N, PARITY)  # large ones are written as integers
        near(page["exact"], exact, PARITY)
        error = np.abs(run.N - exact).max()
        assert page["error"] == pytest.approx(error, rel=1e-6, abs=PARITY * np.abs(exact).max())
        assert page["work"] == len(b) * (len(run.T) - 1)
        J = answer["curve"][5][0] / len(b)
        run = simulate(ROBOT, BUMP, v=v, dt=tfinal / J, tfinal=tfinal, scheme=run.scheme)
        exact = normal_forces(ROBOT, BUMP, v, run.T, over_bump(ROBOT, BUMP, v, run.T))
        error = np.abs(run.N - exact).max()
        assert answer["curve"][5][1] == pytest.approx(error, rel=1e-6, abs=1e-8)


def test_entries_are_read_as_one_writes_them(tmp_path):
    script = """import { readEntry, writeEntry } from "./page/tableau.js";
    for (const text of %s) {
      const value = readEntry(text);
      console.log(JSON.stringify([value, writeEntry(value ?? 0)]));
    }"""
    good = {
        "1/6": 1 / 6,
        "1,5": 1.5,
        "−1/2": -0.5,
        "": 0,
        "(3-√3)/6": (3 - 3**0.5) / 6,
        "2e-3": 0.002,
    }
    good |= {".5": 0.5, "1 - sqrt(2)/2": 1 - 2**0.5 / 2, "2√2": 8**0.5, "2·3": 6, "-3/7": -3 / 7}
    bad = ["x", "1/", "1..2", "1/0", "(1", "1)", "√-1", "1 2/", "**", "1e999", "NaN", "__proto__"]
    lines = run_in_node(tmp_path, script % json.dumps([*good, *bad])).splitlines()
    pairs = [json.loads(line) for line in lines]
    assert [value for value, _ in pairs[: len(good)]] == pytest.approx(list(good.values()), abs=0)
    assert [value for value, _ in pairs[len(good) :]] == [None] * len(bad)
    written = dict(zip(good, (text for _, text in pairs)))
    assert written["1/6"] == "1/6" and written["-3/7"] == "-3/7" and written["1,5"] == "3/2"


def test_puzzles_are_won_by_what_they_ask_for_alone(workshop, known, tmp_path):
    won = {name: [task["isWon"] for task in answer["puzzles"]] for name, answer in known.items()}
    assert won["Lobatto IIIA, order 4"] == [True, False, False]
    assert not any(won["Kutta, order 3"]) and not any(won["RK4"])
    assert "all end at" in known["Kutta, order 3"]["puzzles"][0]["words"]
    assert not any(third for _, _, third in won.values())
    alpha = 0.4524
    table = ([[0, 0, 0], [alpha, 0, 0], [0, 0.5, 0]], [0, 0, 1])
    still = ([[0]], [0])
    found = ask(tmp_path, [table, still], ROBOT.eigenvalues, facts=workshop.facts)
    assert [task["isWon"] for task in found[0]["puzzles"]] == [False, True, False]
    assert "stands still" in found[1]["puzzles"][2]["words"]


@pytest.mark.slow
@pytest.mark.parametrize("k", [250, 800, 2300])
def test_no_method_of_the_kind_has_a_longer_step(k):
    eigenvalues = Robot(k, k).eigenvalues
    best = longest_of_order_two(eigenvalues)
    rng = np.random.default_rng(k)
    for _ in range(300):
        a = np.tril(rng.uniform(-1, 1, (3, 3)), -1)
        c = a.sum(axis=1)
        if abs(c[2]) < 0.05:
            continue
        b2 = rng.uniform(-1, 1)
        b3 = (1 / 2 - b2 * c[1]) / c[2]
        scheme = Scheme("", 2, a, [1 - b2 - b3, b2, b3], c)
        assert scheme.max_stable_dt(eigenvalues) <= best * (1 + 1e-6)


def test_python_gets_the_scheme_that_was_typed(workshop):
    fresh = Workshop(ROBOT, BUMP)
    with pytest.raises(ValueError, match="numbers"):
        _ = fresh.scheme
    numbers = {name: getattr(RK4, name).tolist() for name in "abc"}
    fresh.numbers = {"name": "RK4", "order": 4, **numbers}
    assert fresh.scheme == RK4


def test_a_page_gets_a_still_picture_and_says_what_it_shows(workshop):
    html = workshop.html()
    assert html.startswith('<div class="suspension-laboratory se-workshop">')
    assert (
        'alt="The region of absolute stability of RK4' in html and "20 ms, which is stable" in html
    )
    assert "which is unstable" in Workshop(ROBOT, BUMP, dt=0.2).alt


def test_the_course_s_robot_can_be_tried_too():
    assert Workshop(course.the_robot(), course.Hgauss).facts["traded"] > 0


@pytest.mark.parametrize(
    "arguments, words",
    [
        ((1, BUMP), "robot must"),
        ((ROBOT, 1), "bump must"),
        ((ROBOT, BUMP, 11), "v must be from 0.25 to 10"),
        ((ROBOT, BUMP, 1, 0), "dt must be from 0.001 to 0.2"),
        ((ROBOT, BUMP, 1, np.nan), "dt must"),
    ],
)
def test_what_cannot_be_is_refused_by_name(arguments, words):
    with pytest.raises((TypeError, ValueError), match=words):
        Workshop(*arguments)


def test_the_page_computes_the_table_of_a_bump_that_python_has(workshop, tmp_path):
    script = """import { bumpTable } from "./page/bump_table.js";
    console.log(JSON.stringify([...bumpTable(%s)]));"""
    page = json.loads(run_in_node(tmp_path, script % json.dumps(workshop.facts["road"])))
    _, table = shape_of(BUMP, 0, 0)
    np.testing.assert_allclose(np.reshape(page, table.shape), table, atol=1e-13)


# Reads given.json: tables as numbers, and for each a coefficient to bend and points of the plane.
BEND = """
import { readFileSync } from "node:fs";
import * as t from "./page/tableau.js";
import { bentWords, examine } from "./page/workshop_words.js";

const { tables, modes, z } = JSON.parse(readFileSync("given.json"));
for (const { a, b, bends, name } of tables) {
  const c = t.rowSums(a), base = { name, ...examine({ a, b, c }, modes) };
  const before = t.coefficientsOf({ a, b });
  const bent = bends.map(([j, value]) => {
    const weights = t.bend({ a, b }, j, value), now = examine({ a, b: weights, c }, modes);
    const coefficients = t.coefficientsOf({ a, b: weights });
    return { j, value, b: weights, coefficients, order: now.order, limit: String(now.limit),
      values: z.map((point) => t.growthAt(now.R, point)), agrees: t.agreement(coefficients),
      words: bentWords(now, base, j) };
  });
  const pulls = z.map((point, n) => {
    const j = 1 + (n % (before.length - 1)), value = t.coefficientAt(before, j, point);
    return { j, value, b: t.bend({ a, b }, j, value) };
  });
  console.log(JSON.stringify({ before, bent, pulls, isAlone: t.isAlone({ a }), order: base.order,
    limit: base.limit, words: bentWords(base, null, 1), R: t.isPolynomial(base.R) }));
}
"""


def bend(folder, tables, modes, z):
    """What the page makes of tables (name, a, b, bends), bends being pairs (j, coefficient)."""
    given = {
        "tables": [
            {"name": name, "a": np.asarray(a).tolist(), "b": np.asarray(b).tolist(), "bends": bends}
            for name, a, b, bends in tables
        ],
        "modes": [[w.real, w.imag] for w in modes],
        "z": [[w.real, w.imag] for w in z],
    }
    (folder / "given.json").write_text(json.dumps(given), encoding="utf-8")
    return [json.loads(line) for line in run_in_node(folder, BEND).splitlines()]


def explicit_tables(rng):
    """The known explicit methods, and any others whose last stage feels the first."""
    for name, (a, b) in list(KNOWN.items())[:7]:
        numbers = [[Fraction(x) for x in row.split()] for row in a.split(";")]
        yield name, np.array(numbers, float), np.array([Fraction(x) for x in b.split()], float)
    for s in (1, 2, 3, 4, 5, 6) * 3:
        a = np.tril(rng.uniform(0.2, 1, (s, s)), -1)
        b = rng.uniform(0.1, 1, s)
        yield f"any of {s}", a, b / b.sum()


def polynomial_of(a, b):
    """1 and b A^(j-1) 1: R of an explicit method."""
    power, found = np.ones(len(b)), [1.0]
    for _ in b:
        found.append(b @ power)
        power = a @ power
    return np.array(found)


def test_a_bent_polynomial_is_that_of_the_scheme_with_the_weights_that_follow(tmp_path):
    rng = np.random.default_rng(41)
    z = rng.normal(0, 2, 30) + 1j * rng.normal(0, 2, 30)
    tables = [
        (name, a, b, [(j, rng.uniform(0, 2) / factorial(j)) for j in range(1, len(b) + 1)])
        for name, a, b in explicit_tables(rng)
    ]
    limits = []
    for (_, a, b, _), answer in zip(tables, bend(tmp_path, tables, ROBOT.eigenvalues, z)):
        assert answer["isAlone"] and answer["R"]
        near(answer["before"], polynomial_of(a, b), PARITY)
        for bent in answer["bent"]:
            expected = polynomial_of(a, b)
            expected[bent["j"]] = bent["value"]
            near(bent["coefficients"], expected, PARITY)
            R = np.polynomial.Polynomial(expected)
            values = [re + 1j * im for re, im in bent["values"]]
            np.testing.assert_allclose(values, R(z), rtol=PARITY, atol=PARITY)
            assert bent["agrees"] <= bent["j"] - 1
            if bent["j"] == 1:  # the weights do not sum to 1: no scheme of the package
                assert bent["order"] == 0
                continue
            scheme = Scheme("", 1, a, np.array(bent["b"]), a.sum(axis=1))
            np.testing.assert_allclose(scheme.stability_function(z), R(z), rtol=PARITY, atol=PARITY)
            limits.append(scheme.max_stable_dt(ROBOT.eigenvalues))
            assert float(bent["limit"]) == pytest.approx(limits[-1], rel=PARITY)
    assert sum(limit > 0 for limit in limits) > 10


def test_a_pulled_border_goes_through_the_place_or_as_near_as_it_can(tmp_path):
    rng = np.random.default_rng(43)
    z = rng.normal(-1, 1.5, 60) + 1j * rng.normal(0, 2, 60)
    z = z[abs(z) > 0.4]  # at 0 any R is 1
    tables = [(name, a, b, []) for name, a, b in explicit_tables(rng)]
    through = 0
    for (_, a, b, _), answer in zip(tables, bend(tmp_path, tables, ROBOT.eigenvalues, z)):
        for point, pull in zip(z, answer["pulls"]):
            if abs(pull["value"] * factorial(pull["j"])) > 3:
                continue  # beyond the slider
            weights = np.array(pull["b"])
            R = np.polynomial.Polynomial(polynomial_of(a, weights))
            if pull["j"] > 1:
                R = Scheme("", 1, a, weights, a.sum(axis=1)).stability_function
            size = abs(R(point))
            if abs(size - 1) < PARITY:
                through += 1
                continue
            # No coefficient makes it 1: this one makes it least.
            assert size > 1
            for off in (-1e-3, 1e-3):
                expected = polynomial_of(a, b)
                expected[pull["j"]] = pull["value"] + off
                assert abs(np.polynomial.Polynomial(expected)(point)) > size
    assert through > 300


def test_it_is_told_what_became_of_the_polynomial(workshop, tmp_path):
    heun = ("Heun", [[0, 0], [1, 0]], [1 / 2, 1 / 2], [(1, 0.9), (2, 0.4), (2, 0.5)])
    rk4 = ("RK4", RK4.a, RK4.b, [(3, 0.2), (4, 0.05), (4, 0), (3, 1 / 6)])
    # A stage that nothing else uses: the weights are not the only ones.
    idle = ("idle", [[0, 0, 0], [0.5, 0, 0], [0.5, 0, 0]], [0, 1, 0], [(2, 0.4)])
    gauss = ("Gauss", *collocation([1 / 2 - np.sqrt(3) / 6, 1 / 2 + np.sqrt(3) / 6]), [])
    heun, rk4, idle, gauss = bend(tmp_path, [heun, rk4, idle, gauss], ROBOT.eigenvalues, [])
    words = [bent["words"] for bent in heun["bent"]]
    assert "9/10 at z in place of 1" in words[0] and "no longer near 1 + z" in words[0]
    assert "falls from 2 to 0" in words[0]
    assert "2/5 at z² in place of 1/2" in words[1] and "up to z;" in words[1]
    assert "falls from 2 to 1" in words[1] and "no other weights" in words[1]
    assert words[2] == "The R(z) of Heun, by other weights."
    third, fourth, none, _ = rk4["bent"]
    assert "1/5 at z³ in place of 1/6" in third["words"] and third["order"] == 2
    assert "falls from 4 to 2" in third["words"]
    assert third["agrees"] == 2 and fourth["agrees"] == 3
    assert "For a swing alone it would be 3" in fourth["words"]
    assert "stable step" in none["words"] and none["coefficients"][4] == pytest.approx(0, abs=1e-15)
    assert not idle["isAlone"] and "the nearest" in idle["bent"][0]["words"]
    assert len(idle["before"]) == 3
    assert not gauss["R"] and gauss["words"].startswith("R is a fraction here")
    assert "pull the border" in heun["words"]


def test_a_link_brings_back_the_table_and_the_one_kept(tmp_path):
    script = """import { readLink, writeLink } from "./page/workshop_link.js";
    const values = %s, model = { get: (name) => values[name] };
    console.log(JSON.stringify([readLink(writeLink(model)), readLink("#chain:r=1_2"),
      readLink("#workshop:a=0&b=1&ka=0_1&kb=1")]));"""
    table = {"a": [["", "0"], ["√2/2", "0"]], "b": ["1/2", "0,5"], "c": ["", ""], "follows": True}
    kept = {"a": [["1"]], "b": ["1"], "c": ["0.4"], "follows": False}
    values = {"tableau": table, "kept": kept | {"name": "Your method"}, "v": 2.5, "dt": 0.01}
    back, other, broken = json.loads(run_in_node(tmp_path, script % json.dumps(values)))
    assert back == {"tableau": table, "kept": kept, "v": 2.5, "dt": 0.01}
    assert other is None and broken["kept"] == {} and broken["tableau"]["b"] == ["1"]
