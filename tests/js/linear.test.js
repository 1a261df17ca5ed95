// Run by Node's test runner: small matrices and polynomials.

import assert from "node:assert/strict";
import { test } from "node:test";
import { characteristic, combine, divide, evaluate, multiply, roots, solve } from "../page/linear.js";

const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-12, `${a} is not ${b}`);

test("solve solves, and refuses a singular matrix", () => {
  const A = [
    [0, 1, 0, 2],
    [3, -1, 4, 0.5],
    [1e-3, 0, 7, 1],
    [2, 2, 2, -9],
  ];
  const x = solve(A, [1, 2, 3, 4]);
  multiply(
    A,
    x.map((value) => [value]),
  ).forEach(([value], i) => near(value, i + 1));
  assert.equal(
    solve(
      [
        [1, 2],
        [2, 4],
      ],
      [1, 1],
    ),
    null,
  );
});

test("combine adds multiples", () => {
  assert.deepEqual([...combine([2, [[1, 0]]], [3, [[0, 1]]])[0]], [2, 3]);
});

test("the characteristic polynomial has the eigenvalues as roots", () => {
  // (z - 1) (z - 2) (z^2 + 9)
  const A = [
    [1, 0, 0, 0],
    [0, 2, 0, 0],
    [0, 0, 0, -9],
    [0, 0, 1, 0],
  ];
  const polynomial = characteristic(A);
  assert.deepEqual([...polynomial], [18, -27, 11, -3, 1]);
  const found = roots(polynomial).sort((a, b) => a[1] - b[1] || a[0] - b[0]);
  [
    [0, -3],
    [1, 0],
    [2, 0],
    [0, 3],
  ].forEach((z, i) => z.forEach((part, j) => near(part, found[i][j])));
});

test("roots of every size are found", () => {
  assert.deepEqual(roots([0, 0, 1]), [
    [0, 0],
    [0, 0],
  ]);
  const [small, large] = roots([1e6, -(1e6 + 1), 1])
    .map(([re]) => re)
    .sort((a, b) => a - b);
  near(small, 1);
  near(large / 1e6, 1);
});

test("complex numbers are divided and put into polynomials", () => {
  assert.deepEqual(divide([1, 2], [3, -4]), [-0.2, 0.4]);
  assert.deepEqual(evaluate([1, 0, 1], [0, 1]), [0, 0]);
});
