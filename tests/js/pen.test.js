// Run by Node's test runner: what the pen writes, and what it leaves out.

import assert from "node:assert/strict";
import { test } from "node:test";
import { begin } from "../page/pen.js";

/** A canvas that tells where lines and words were put. */
function makeCanvas() {
  const drawn = [];
  const g = {
    measureText: (text) => ({ width: 6 * text.length }),
    getTransform: () => ({ a: 1, b: 0, c: 0, d: 1, e: 0, f: 0 }),
    fillText: (text, x) => drawn.push([text, x]),
    lineTo: (x) => drawn.push(["line", x]),
  };
  for (const name of ["setTransform", "clearRect", "save", "restore", "beginPath", "stroke", "setLineDash"])
    g[name] = () => {};
  return { drawn, getContext: () => g, width: 0, height: 0 };
}

const ENTRIES = ["rear", "front"].map((words) => ({ words, colour: words, width: 2 }));

test("a legend has a swatch for each word and none without", () => {
  const canvas = makeCanvas(),
    pen = begin(canvas, 300, 100, {}, 1);
  assert.equal(pen.legend(10, 13, 300, ENTRIES), true);
  assert.deepEqual(
    canvas.drawn.map(([what]) => what),
    ["rear", "line", "line", "front", "line", "line"],
  );
  const narrow = makeCanvas(),
    other = begin(narrow, 100, 100, {}, 1);
  other.text("Forces (N)", 0, 13); // 60 pixels of it
  narrow.drawn.length = 0;
  assert.equal(other.legend(30, 13, 100, ENTRIES), false);
  assert.deepEqual(narrow.drawn, []);
});

test("a word gives way to a swatch", () => {
  const canvas = makeCanvas(),
    pen = begin(canvas, 300, 100, {}, 1);
  pen.legend(100, 13, 300, ENTRIES);
  assert.equal(pen.text("here", 90, 13), false);
  assert.equal(pen.text("here", 90, 40), true);
});
