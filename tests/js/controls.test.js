// Run by Node's test runner: places on a slider, its keys.

import assert from "node:assert/strict";
import { test } from "node:test";
import { makeScale, nextValue, round } from "../page/controls.js";

const SPEED = [0.1, 25, true],
  DAMPING = [0, 6, false],
  STEPS = [0.001, 0.002, 0.005];

test("place and value are inverse to each other", () => {
  for (const range of [SPEED, DAMPING]) {
    const scale = makeScale(range);
    for (const value of [0.1, 1.2, 5.9])
      assert.ok(Math.abs(scale.toValue(scale.toPlace(value)) - value) < 1e-12);
    assert.equal(scale.toPlace(range[0]), 0);
  }
});

test("a dragged value has three digits, and snaps to the robot's own", () => {
  const scale = makeScale(SPEED);
  assert.equal(round(1.23456, SPEED, undefined, scale), 1.23);
  assert.equal(round(1.19, SPEED, 1.2034, scale), 1.2034);
  assert.equal(round(99, SPEED, undefined, scale), 25);
});

test("arrow keys go all the way, page keys not at once", () => {
  for (const range of [SPEED, DAMPING]) {
    for (const [key, start, end] of [
      ["ArrowRight", 0, 1],
      ["ArrowLeft", 1, 0],
    ]) {
      let value = range[start],
        presses = 0;
      for (; value !== range[end]; presses++) {
        const next = nextValue(key, value, range);
        assert.ok(next !== value && presses < 300);
        value = next;
      }
      assert.ok(presses > 80);
      assert.equal(nextValue(key, value, range), value);
    }
  }
  const page = nextValue("PageDown", 25, SPEED);
  assert.ok(page > 10 && page < 20);
  assert.deepEqual(
    ["Home", "End", "a"].map((key) => nextValue(key, 1, SPEED)),
    [0.1, 25, null],
  );
});

test("page keys go from one round step to the next, arrow keys in small steps", () => {
  const range = [0.001, 0.005, true],
    next = (key, dt) => nextValue(key, dt, range, STEPS);
  assert.equal(next("PageUp", 0.0015), 0.002);
  assert.equal(next("PageUp", 0.005), 0.005);
  assert.equal(next("PageDown", 0.002), 0.001);
  assert.equal(next("PageDown", 0.001), 0.001);
});
