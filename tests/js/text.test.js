// Run by Node's test runner: typed numbers, addresses, numbers as text, lines of Python.

import assert from "node:assert/strict";
import { test } from "node:test";
import { plain, show, ticks } from "../page/pen.js";
import { readHash, readNumber, writeHash } from "../page/state.js";
import { pythonOf, tableOf } from "../page/take.js";

const NUMBERS = {
  7.5: 7.5,
  "0,5": 0.5,
  " 1 200 ": 1200,
  "−3": -3,
  "1e-3": 1e-3,
  ".25": 0.25,
  "5.": 5,
  "": null,
  a: null,
  "1,2,3": null,
  "1e999": null,
  "--1": null,
  "0x10": null,
};

test("a number is read with a point or a comma, and nothing else is one", () => {
  for (const [text, value] of Object.entries(NUMBERS)) assert.equal(readNumber(text), value, text);
});

test("an address holds what differs from the beginning, and gives it back", () => {
  const initial = { v: 1.2, dt: 0.001, scheme: "RK4", motion: "linear", time: 0.17 };
  assert.equal(writeHash(initial, initial), "");
  const changed = { ...initial, v: 7.5, scheme: "Crank-Nicolson" };
  assert.equal(writeHash(changed, initial), "v=7.5&scheme=Crank-Nicolson");
  const [index, settings] = readHash(writeHash(changed, initial, 1));
  assert.deepEqual([index, settings], [1, { v: 7.5, scheme: "Crank-Nicolson" }]);
});

test("what an address says wrongly is left out", () => {
  assert.deepEqual(readHash("v=x&__proto__=1&k=800&on=-2&facts=1"), [0, { k: 800 }]);
  assert.deepEqual(readHash(""), [0, {}]);
});

test("numbers have a true minus, few digits and powers of ten", () => {
  assert.equal(show(-0.0816), "−0.0816");
  assert.equal(show(1.5e-5, 2), "1.5\u00a0×\u00a010⁻⁵");
  assert.equal(show(NaN), "more than 10³⁰⁰");
  assert.equal(plain(7.5), "7.5");
});

test("an axis has round numbers", () => {
  assert.deepEqual(
    ticks(0, 1, 5).map((x) => plain(x)),
    ["0", "0.2", "0.4", "0.6", "0.8", "1"],
  );
});

test("gaps in the lines of Python are filled exactly", () => {
  const python = {
    text: "f({k2}, {v}, {scheme})",
    flight: "fly({v})",
    schemes: ["RK4"],
    gaps: { k2: ["k", 1.5] },
  };
  assert.equal(pythonOf({ python }, { k: 700, v: 7.5 }, 0, "linear"), "f(1050, 7.5, RK4)");
  assert.equal(pythonOf({ python }, { k: 700, v: 7.5 }, 0, "flying"), "f(1050, 7.5, RK4)\nfly(7.5)");
});

test("the table has a line for each sample", () => {
  const run = {
    W: [
      [1, 2],
      [0, 0],
      [0, 0],
      [0, 0],
    ],
    N: [
      [7, 7],
      [6, 6],
    ],
    J: 1,
    dt: 0.5,
  };
  const lines = tableOf({ run, v: 2 }, "linear").trim().split("\n");
  assert.deepEqual(lines.slice(1), ["0,0,1,0,0,0,7,6", "0.5,1,2,0,0,0,7,6"]);
  assert.equal(lines[0].split(",").length, 8);
});

test("an address tells of a pinned run what differs from the beginning, and always its speed", () => {
  const initial = {
    v: 1.2,
    dt: 0.001,
    k: 793.2,
    scheme: "RK4",
    motion: "linear",
    view: "forces",
    mapped: false,
  };
  const pin = { v: 1.2, dt: 0.001, k: 300, scheme: "Euler", motion: "flying" };
  const text = writeHash({ ...initial, view: "speeds", mapped: true, pin }, { ...initial, pin: null });
  assert.equal(text, "view=speeds&mapped=true&pin.v=1.2&pin.k=300&pin.scheme=Euler&pin.motion=flying");
  const [, settings] = readHash(text);
  assert.deepEqual(settings, {
    view: "speeds",
    mapped: true,
    pin: { v: 1.2, k: 300, scheme: "Euler", motion: "flying" },
  });
  assert.deepEqual(readHash("view=top&mapped=maybe&pace=fast&pin.facts=1")[1], {});
});
