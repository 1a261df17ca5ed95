// Run by Node's test runner: what is said of readings and of what follows from them, case by case.

import assert from "node:assert/strict";
import { test } from "node:test";
import { follow, makeBranch, whyNot } from "../page/readings.js";
import {
  coefficientRows,
  confidence,
  range,
  speedRows,
  tellLine,
  tellReading,
  tellSpeeds,
  tellStiffness,
  tellVerdicts,
  verdictRows,
} from "../page/verdict.js";

// One degree of freedom for four readings, two for five; the numbers need not be right for the words.
const FACTS = {
  delta_max: 0.01,
  level: 0.95,
  quantiles: { t: [12.7, 4.3], tail: [3e8, 2e4], joint: [25, 7.6], region: [400, 38] },
  roundoff: [1e-12, 1e-9],
  widest: 20,
  k: [100, 1000],
  v: [0.1, 30],
  error: 1e-5,
  branches: [],
  asked: [
    { v: 1.2, flips: [], lost: [true] },
    { v: 5, flips: [501], lost: [false, true] },
    { v: 10, flips: [900], lost: [false, true] },
  ],
};
const X = [0, 0.25, 0.5, 0.75, 1];
const LOGS = (...numbers) => numbers.map(Math.log);
const through = { k: LOGS(100, 400, 1000), v: LOGS(1, 2, 4), born: null, dies: null };
const partial = { k: LOGS(480, 520, 560), v: LOGS(8, 9, 11), born: "pair", dies: "range" };

/** What follows from b0 + b1 x + b2 x² with a scatter that alternates. */
function from({ b0 = 0, b1 = 5, b2 = 0, scatter = 0.01, branches = [], facts = FACTS }) {
  const readings = X.map((x, i) => [x, b0 + b1 * x + b2 * x * x + scatter * (-1) ** i]);
  return follow(readings, facts, branches.map(makeBranch));
}

test("a stiffness is told with its interval, and when there is none", () => {
  assert.match(
    tellStiffness(from({}), FACTS),
    /^k = 495\u00a0N\/m, with 95\u00a0% confidence 469 to 521\u00a0N\/m\.$/,
  );
  assert.match(tellStiffness(from({ scatter: 0 }), FACTS), /every interval is a point/);
  assert.match(tellStiffness(from({ b1: -5 }), FACTS), /^The slope at zero is −[\d.]+\u00a0N\/m: no spring/);
  assert.match(tellStiffness(from({ scatter: 1 }), FACTS), /Even the sign is open\.$/);
  assert.match(
    tellStiffness(follow([[0, 0]], FACTS, []), FACTS),
    /tell no stiffness: a parabola needs readings at three/,
  );
});

test("a line is contradicted or not, by the test and by the intervals", () => {
  const told = (how) => tellLine(from(how), FACTS);
  assert.match(told({}), /inside the ellipse: F = .*, not contradicted/);
  assert.match(told({ b0: 0.5 }), /outside the ellipse.*contradicted at 5\u00a0%, and zero outside a joint/);
  assert.match(told({ b0: 9 }), /p\u00a0<\u00a00\.001/);
  assert.equal(told({ scatter: 0 }), "The readings lie on a line through the origin.");
  assert.match(told({ scatter: 0, b0: 1 }), /no line through the origin/);
  assert.equal(tellLine({ why: "none" }, FACTS), "");
  const both = from({});
  both.fit.test = { F: 4, p: 0.04, inside: false, joint: true };
  assert.match(tellLine(both, FACTS), /though zero lies in both joint intervals/);
});

test("critical speeds are there, come or go, or are not told", () => {
  const told = (how) => tellSpeeds(from(how), FACTS);
  assert.match(told({}), /^There is no critical speed from 0\.1 to 30\u00a0m\/s\.$/);
  assert.match(
    told({ branches: [through] }),
    /^The one critical speed exists for every stiffness .* 0\.001\u00a0%\.$/,
  );
  assert.match(
    told({ branches: [through, { ...through, v: LOGS(3, 4, 5) }] }),
    /^Both critical speeds exist/,
  );
  const three = [1, 2, 3].map((times) => ({ ...through, v: LOGS(times, 2 * times, 4 * times) }));
  assert.match(told({ branches: three }), /^All three critical speeds exist/);
  const open = told({ branches: [through, partial], scatter: 0.05 });
  assert.match(
    open,
    /^One of two critical speeds comes or goes within the interval of k: whether it exists cannot be told/,
  );
  assert.match(told({ branches: [partial, partial], scatter: 0.05 }), /^Both critical speeds come or go/);
  assert.match(
    told({ scatter: 0.3, branches: [through] }),
    /reaches beyond the table, 100 to 1000\u00a0N\/m; what/,
  );
  assert.match(told({ b1: 15 }), /This stiffness is beyond it, and nothing is extrapolated/);
  assert.equal(told({ b1: -1 }), "");
});

test("a speed has a row with its interval and where it exists", () => {
  const [first, second] = speedRows(from({ branches: [through, partial], scatter: 0.05 }));
  assert.deepEqual([first[0].slice(0, 2), first[2]], ["2.", "in the whole interval"]);
  assert.match(
    second[2],
    /^only above k = 480\u00a0N\/m, where it appears with another, and below k = 560\u00a0N\/m, where it leaves/,
  );
  const away = speedRows(from({ b1: 4.7, branches: [partial], scatter: 0.02 }));
  assert.equal(away[0][0], "none at this k");
  assert.deepEqual(speedRows({ why: "none" }), []);
});

test("a branch of critical speeds goes through its nodes and is nowhere beside its ends", () => {
  const { speed, ends } = makeBranch(partial);
  for (const [k, v] of [
    [480.0000001, 8],
    [520, 9],
    [559.9999999, 11],
  ])
    assert.ok(Math.abs(speed(k) / v - 1) < 1e-3, `${k}`);
  assert.equal(speed(479), null);
  assert.equal(speed(561), null);
  assert.deepEqual(ends.map(Math.round), [480, 560]);
});

test("a verdict is kept, lost, or cannot be told, and never certain", () => {
  const found = from({ scatter: 0.002 });
  const rows = verdictRows(found, FACTS);
  assert.deepEqual(
    rows.map(([v, verdict]) => [v, verdict]),
    [
      ["1.2\u00a0m/s", "lost"],
      ["5\u00a0m/s", "cannot be told"],
      ["10\u00a0m/s", "kept"],
    ],
  );
  assert.deepEqual([rows[0][2], rows[2][2]], [">\u00a099.99\u00a0%", "<\u00a00.01\u00a0%"]);
  assert.equal(
    tellVerdicts(found, FACTS),
    "Contact kept at 10\u00a0m/s; lost at 1.2\u00a0m/s; cannot be told at 5\u00a0m/s.",
  );
  const wide = verdictRows(from({ scatter: 0.3 }), FACTS);
  assert.match(wide[0][2], /^82\.\d\d\u00a0% to >/);
  assert.equal(tellVerdicts({ verdicts: null }, FACTS), "");
  assert.deepEqual(
    verdictRows(from({ scatter: 0 }), FACTS).map(([, verdict]) => verdict),
    ["lost", "kept", "kept"],
  );
});

test("coefficients stand with both intervals, the joint one the wider", () => {
  const rows = coefficientRows(from({}));
  assert.deepEqual(
    rows.map(([name]) => name),
    ["β₀", "β₁", "β₂"],
  );
  assert.ok(rows.every((row) => row.length === 4 && row[2] !== row[3]));
  assert.deepEqual(coefficientRows({ why: "none" }), []);
});

test("a reading is named, and how to choose one", () => {
  const readings = X.map((x) => [x, 5 * x]);
  assert.match(tellReading(readings, null, {}), /^Choose a reading/);
  assert.equal(tellReading(readings, 1, {}), "Reading 2 of 5, at 0.25: 1.25\u00a0N.");
  assert.match(tellReading(readings, 1, follow(readings, FACTS, [])), /, fit 1\.25\u00a0N\.$/);
});

test("it is said why readings cannot be fitted", () => {
  assert.equal(
    whyNot(
      X.map((x) => [x, x]),
      9,
    ),
    "",
  );
  assert.match(
    whyNot(
      X.slice(0, 3).map((x) => [x, x]),
      9,
    ),
    /nothing is left/,
  );
  assert.match(
    whyNot(
      X.map(() => [1, 1]),
      9,
    ),
    /three different displacements/,
  );
  assert.match(
    whyNot(
      X.map((x) => [x, x]),
      4,
    ),
    /room for 4/,
  );
});

test("numbers have the decimals that an interval deserves, and true minus signs", () => {
  assert.equal(range([-0.2081, 0.1794], "N"), "−0.21 to 0.18\u00a0N");
  assert.equal(range([766.3, 836.1]), "766 to 836");
  assert.equal(range([0.3, 20], "m/s"), "0.3 to 20.0\u00a0m/s");
  assert.equal(range([2, 2], "N"), "2.00\u00a0N");
  assert.equal(range([-0.00001, 0.9]), "0.0000 to 0.9000");
  assert.equal(range([0, 0], "N"), "0.000\u00a0N");
  assert.equal(confidence(0.5), "50.00\u00a0%");
  assert.equal(confidence(0), "<\u00a00.01\u00a0%");
});
