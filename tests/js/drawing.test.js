// Run by Node's test runner: a curve that a reader draws, and what is said of it.

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  compareCurve,
  compareLine,
  describeDrawn,
  does,
  drawn,
  lay,
  pieces,
  share,
  slopeOf,
  strokeAt,
} from "../page/drawing.js";

const COLUMNS = 61,
  EMPTY = Array(COLUMNS).fill(null);
const FACTS = { x: [0.01, 10000], symbol: "ν", curve: "the exact curve" }; // ten columns a decade
/** A curve through [column, height] with straight lines between. */
const through = (...points) => lay(EMPTY, points);
const VALLEY = through([0, 2], [20, -2], [60, 2]);

test("a stroke fills every column that it passes, in either direction, and nothing else", () => {
  for (const stroke of [
    [
      [10.4, 1],
      [20.2, 2],
    ],
    [
      [20.2, 2],
      [10.4, 1],
    ],
  ]) {
    const heights = lay(EMPTY, stroke);
    assert.deepEqual(
      [...heights.keys()].filter((i) => heights[i] !== null),
      [10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20],
    );
    assert.ok(Math.abs(heights[15] - (1 + 4.6 / 9.8)) < 1e-12);
  }
  assert.equal(share(lay(EMPTY, [[30, 1]])), 1 / COLUMNS);
  assert.deepEqual(
    lay(EMPTY, [
      [30, 1],
      [30, 2],
    ])[30],
    2,
  );
});

test("what is drawn later replaces what it passes over, and one step back brings it again", () => {
  const strokes = [
    [
      [0, 1],
      [60, 1],
    ],
    [
      [20, 3],
      [40, 3],
    ],
  ];
  const both = drawn(strokes, COLUMNS);
  assert.deepEqual([both[10], both[30], both[50]], [1, 3, 1]);
  assert.deepEqual(drawn(strokes.slice(0, -1), COLUMNS), Array(COLUMNS).fill(1));
  assert.deepEqual(drawn([], COLUMNS), EMPTY);
});

test("a key's step joins its column to what is drawn a step to either side", () => {
  assert.deepEqual(strokeAt(EMPTY, 10, 1, 5), [[10, 1]]);
  const one = lay(EMPTY, strokeAt(EMPTY, 10, 1, 5));
  const two = lay(one, strokeAt(one, 15, 2, 5));
  assert.ok(Math.abs(two[12] - 1.4) < 1e-12);
  const moved = lay(two, strokeAt(two, 10, 3, 5));
  assert.deepEqual([moved[10], moved[15]], [3, 2]);
});

test("rises and falls are found, ripples are not", () => {
  assert.deepEqual(pieces(VALLEY), [
    { rises: false, from: 0, to: 20 },
    { rises: true, from: 20, to: 60 },
  ]);
  const rippled = VALLEY.map((height, i) => height + 0.05 * (-1) ** i);
  assert.equal(does(pieces(rippled)), "falls and rises");
  assert.equal(does(pieces(through([0, 0], [20, 1], [40, -1], [60, 1]))), "rises, falls and rises");
  assert.equal(does(pieces(through([5, 0], [50, 0.1]))), "stays at about one height");
  assert.equal(does(pieces(EMPTY)), "stays at about one height");
  assert.deepEqual(pieces(through([5, 0], [50, 3])), [{ rises: true, from: 5, to: 50 }]);
});

test("a slope is that of the line, whatever part of it is drawn", () => {
  assert.ok(Math.abs(slopeOf(through([0, 2], [20, -2]), [0, 60], 6) + 2) < 1e-12);
  assert.ok(Math.abs(slopeOf(VALLEY, [25, 55], 6) - 1) < 1e-12);
  assert.equal(slopeOf(VALLEY, [3, 4], 6), null);
});

test("a curve of the same shape is told so, with its turns and its distance", () => {
  const words = compareCurve(VALLEY, { ...FACTS, exact: VALLEY.map((height) => height - 0.5) });
  assert.match(words, /the exact curve falls and rises\. So does yours\./);
  assert.match(words, /It turns at ν = 1 \(yours: 1\)\./);
  assert.match(words, /within a factor of 3\.2 of it/);
  assert.match(words, /3\.2 times too high/);
  assert.match(compareCurve(VALLEY, { ...FACTS, exact: VALLEY }), /within a factor of 1 of it\.$/);
});

test("a curve of another shape is told both, and only where it is drawn", () => {
  const falls = through([0, 2], [60, -2]);
  assert.match(compareCurve(falls, { ...FACTS, exact: VALLEY }), /falls and rises\. Yours falls\. Half/);
  assert.match(compareCurve(falls, { ...FACTS, exact: VALLEY }), /10000 times too low|10⁴ times too low/);
  const left = through([0, 2], [18, -2]);
  assert.match(
    compareCurve(left, { ...FACTS, exact: VALLEY }),
    /the exact curve falls\. So does yours\. Half/,
  );
});

test("a line is compared where it holds, and said to hold nowhere, or where nothing is drawn", () => {
  const line = { name: "follow", slope: -2, stretch: [0, 15] };
  assert.match(
    compareLine(VALLEY, line, FACTS),
    /from ν = 0\.01 to 0\.32, with slope −2\. Yours has slope −2 there: well seen\./,
  );
  assert.match(compareLine(through([0, 1], [60, -5]), line, FACTS), /Yours has slope −1 there\.$/);
  assert.match(compareLine(through([30, 1], [60, 2]), line, FACTS), /You drew nothing there\./);
  assert.match(compareLine(VALLEY, { ...line, stretch: null }, FACTS), /nowhere near/);
});

test("what is still to do is said", () => {
  assert.match(describeDrawn(EMPTY), /Nothing is drawn yet/);
  assert.match(describeDrawn(through([0, 1], [11, 2])), /20 %/);
  assert.match(describeDrawn(VALLEY), /^Your curve falls and rises\. It is kept/);
});
