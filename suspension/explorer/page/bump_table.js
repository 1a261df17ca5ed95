// The table of a bump of height and width 1, as `suspension.explorer.tables` makes it of any road: a page
// need not load what it can compute.

import { eliminate } from "./linear.js";

const NODES = Array.from({ length: 5 }, (_, i) => -Math.cos((Math.PI * i) / 4)); // where a cell meets the road
const SIZE = 2 * NODES.length; // coefficients of a cell
const NOTHING = 1e-25;

/** What coefficients times this are: heights at the nodes, then slopes times the half-width. Its inverse. */
function inverse() {
  const width = 2 * SIZE,
    M = new Float64Array(SIZE * width);
  NODES.forEach((s, i) => {
    const [height, slope] = [i, i + NODES.length].map((row) => row * width);
    for (let j = 0; j < SIZE; j++) {
      M[height + j] = s ** j;
      M[slope + j] = j && j * s ** (j - 1);
    }
  });
  for (let i = 0; i < SIZE; i++) M[i * width + SIZE + i] = 1;
  eliminate(M, SIZE, width);
  return Array.from({ length: SIZE }, (_, i) => M.slice(i * width + SIZE, (i + 1) * width));
}

/** H = sum of table[10 i + j] s^j, with s from -1 to 1 across cell i. */
export function bumpTable({ start, cell, cells }) {
  const solved = inverse(),
    half = cell / 2,
    table = new Float64Array(SIZE * cells);
  for (let n = 0; n < cells; n++) {
    const places = NODES.map((s) => start + half * (2 * n + 1 + s)),
      heights = places.map((x) => Math.exp((-x * x) / 2)),
      slopes = places.map((x, i) => -half * x * heights[i]),
      coefficients = solved.map((row) =>
        [...heights, ...slopes].reduce((sum, value, i) => sum + row[i] * value, 0),
      );
    if (coefficients.some((x) => Math.abs(x) >= NOTHING)) table.set(coefficients, SIZE * n);
  }
  return table;
}
