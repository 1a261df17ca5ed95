// Run by Node's test runner: a model's numbers stay numbers, and words fit what is known.

import assert from "node:assert/strict";
import { test } from "node:test";
import { changesOf, guarded } from "../page/state.js";

const FACTS = {
  ranges: { v: [0.1, 25, true], c: [0, 6, false] },
  schemes: [{ name: "RK4" }, { name: "Euler" }],
};

function makeModel(values) {
  return {
    values,
    get: (name) => values[name],
    set: (name, value) => (values[name] = value),
  };
}

test("what is no number changes nothing, what is out of range goes to its end", () => {
  const inner = makeModel({ facts: FACTS, v: 1.2, c: 0, time: 0.5, scheme_index: 1, motion: "linear" });
  const model = guarded(inner);
  for (const bad of [Number.NaN, Number.POSITIVE_INFINITY, "3", null, undefined]) {
    for (const name of ["v", "time", "scheme_index"]) {
      const before = inner.values[name];
      model.set(name, bad);
      assert.equal(inner.values[name], before);
    }
  }
  model.set("v", 99);
  model.set("time", -1);
  assert.deepEqual([inner.values.v, inner.values.time], [25, 0]);
  model.set("motion", "flying");
  assert.equal(inner.values.motion, "flying");
});

test("where somebody else has put no number, the last good one stands", () => {
  const inner = makeModel({ facts: FACTS, v: 1.2, scheme_index: 1 });
  const model = guarded(inner);
  assert.equal(model.get("v"), 1.2);
  inner.values.v = Number.NaN;
  inner.values.scheme_index = 7;
  assert.equal(model.get("v"), 1.2);
  assert.equal(model.get("scheme_index"), 0);
  assert.equal(guarded(makeModel({ facts: FACTS, v: Number.NaN })).get("v"), 0.1);
});

test("settings become changes, unknown ones none", () => {
  const found = changesOf({ v: 99, k: 3, c: "x", scheme: "euler", motion: "walking" }, FACTS);
  assert.deepEqual(found, { v: 25, scheme_index: 1 });
});
