// A Butcher tableau (a, b, c) and what follows from it alone: order conditions, stability function,
// A- and L-stability, the longest stable step. As `suspension.schemes` does it, with the same tolerances.

import { characteristic, divide, evaluate, roots, solve } from "./linear.js";

const ROUNDOFF = 64 * 2 ** -52;
const TOLERANCE = 1e-12; // of coefficients that cancel
const NEAR = 1e-10; // so close a condition holds, and a row sum is its abscissa
export const HIGHEST = 5; // order up to which conditions are listed

// ---- what one types

/**
 * The number that a text means: decimals with a point or a comma, fractions, roots, + - * / and
 * brackets, like "1/6", "-0,5" or "(3-√3)/6". Nothing typed is 0. Null if it is no number.
 */
export function readEntry(text) {
  const plain = text
    .replace(/\s/g, "")
    .replace(/[−–]/g, "-")
    .replace(/[·×]/g, "*")
    .replace(/,/g, ".")
    .replace(/sqrt/gi, "√");
  if (plain === "") return 0;
  const parts = plain.match(/\d+\.?\d*(?:e[+-]?\d+)?|\.\d+(?:e[+-]?\d+)?|[-+*/()√]|./gi);
  let at = 0;
  const takes = (sign) => parts[at] === sign && ++at > 0;
  function sum() {
    let value = product();
    while (at < parts.length) {
      if (takes("+")) value += product();
      else if (takes("-")) value -= product();
      else break;
    }
    return value;
  }
  function product() {
    let value = factor();
    while (at < parts.length) {
      if (takes("*")) value *= factor();
      else if (takes("/")) value /= factor();
      else if (parts[at] === "√" || parts[at] === "(") value *= factor();
      else break;
    }
    return value;
  }
  function factor() {
    if (takes("-")) return -factor();
    if (takes("+")) return factor();
    if (takes("√")) return Math.sqrt(factor());
    if (takes("(")) {
      const value = sum();
      return takes(")") ? value : Number.NaN;
    }
    const part = parts[at++] ?? "";
    return /^[\d.]/.test(part) ? Number(part) : Number.NaN;
  }
  const value = sum();
  return at === parts.length && Number.isFinite(value) ? value : null;
}

/** A number as one would type it: a fraction of small numbers if it is one, else all its digits. */
export function writeEntry(value, near = 1e-14) {
  for (let q = 1; q <= 400; q++) {
    const p = Math.round(value * q);
    if (Math.abs(value - p / q) < near * Math.max(1, Math.abs(value))) return q === 1 ? `${p}` : `${p}/${q}`;
  }
  return String(value);
}

export const rowSums = (a) => a.map((row) => row.reduce((sum, x) => sum + x, 0));

/** Stages whose abscissa is not the sum of their row. */
export const strayStages = ({ a, c }) =>
  rowSums(a).flatMap((sum, i) => (Math.abs(sum - c[i]) > NEAR ? [i] : []));

/** "explicit", "diagonally implicit" or "implicit", by where the numbers stand. */
export function kindOf({ a }) {
  const above = a.some((row, i) => row.some((x, j) => j > i && x !== 0));
  if (above) return "implicit";
  return a.some((row, i) => row[i] !== 0) ? "diagonally implicit" : "explicit";
}

// ---- order conditions

const sizeOf = (tree) => 1 + tree.reduce((sum, branch) => sum + sizeOf(branch), 0);

/** All rooted trees with n vertices, each the list of its branches, which are trees. */
export function treesOf(n) {
  /** Lists of trees with n vertices together, none before the first-th of all smaller trees. */
  const all = Array.from({ length: n - 1 }, (_, i) => treesOf(i + 1)).flat();
  const lists = (n, first) =>
    n === 0
      ? [[]]
      : all.flatMap((tree, i) =>
          i >= first && sizeOf(tree) <= n
            ? lists(n - sizeOf(tree), i).map((others) => [tree, ...others])
            : [],
        );
  return lists(n - 1, 0);
}

/** The density: the product of the sizes of all its subtrees. The condition's sum is 1 / density. */
export const densityOf = (tree) =>
  sizeOf(tree) * tree.reduce((product, branch) => product * densityOf(branch), 1);

const RAISED = "⁰¹²³⁴⁵";

/** The sum that a tree stands for, as "b·c A c²" names it: products by component, A by rows. */
function nameOf(tree) {
  const names = tree.map((branch) => (branch.length ? `A${bracketed(branch)}` : "c"));
  const leaves = names.filter((name) => name === "c").length,
    others = names.filter((name) => name !== "c");
  const power = leaves > 1 ? `c${RAISED[leaves]}` : leaves ? "c" : "";
  const twice = others.length === 2 && others[0] === others[1];
  return (
    power +
    (twice
      ? `(${others[0]})²`
      : others.length > 1 || (power && others.length)
        ? others.map((o) => `(${o})`).join("")
        : others.join(""))
  );
}
function bracketed(tree) {
  const name = nameOf(tree);
  return /[()]/.test(name) ? `(${name})` : name;
}

/** For each stage the product over a tree's branches: the vector that b, or a row of a, is multiplied with. */
function weightsOf(tree, a) {
  const product = Array(a.length).fill(1);
  for (const branch of tree) {
    const weights = weightsOf(branch, a);
    a.forEach((row, i) => (product[i] *= row.reduce((sum, x, j) => sum + x * weights[j], 0)));
  }
  return product;
}

/** The 17 conditions up to order 5, lowest order first: tree, order, name, and what the sum should be. */
export const CONDITIONS = Array.from({ length: HIGHEST }, (_, i) => treesOf(i + 1)).flatMap((trees, i) =>
  trees.map((tree) => ({
    tree,
    order: i + 1,
    name: `b·${nameOf(tree) || "1"}`,
    density: densityOf(tree),
  })),
);

/** The sums of all conditions, whether they hold, and the order: HIGHEST if all do. */
export function orderOf({ a, b }) {
  const sums = CONDITIONS.map(({ tree }) =>
      weightsOf(tree, a).reduce((sum, weight, i) => sum + b[i] * weight, 0),
    ),
    holds = CONDITIONS.map(({ density }, i) => Math.abs(sums[i] - 1 / density) < NEAR);
  const failed = CONDITIONS.findIndex((_, i) => !holds[i]);
  return { sums, holds, order: failed < 0 ? HIGHEST : CONDITIONS[failed].order - 1 };
}

// ---- stability

/** Coefficients of det(I - z M), the lowest power first, without those that only roundoff left. */
function determinant(M) {
  const coefficients = Array.from(characteristic(M))
    .reverse()
    .map((x) => (Math.abs(x) < ROUNDOFF ? 0 : x));
  return trim(coefficients);
}

function trim(coefficients) {
  let n = coefficients.length;
  while (n > 1 && coefficients[n - 1] === 0) n--;
  return coefficients.slice(0, n);
}

/** R = P / Q from the tableau. */
export function stabilityOf({ a, b }) {
  return { P: determinant(a.map((row) => row.map((x, j) => x - b[j]))), Q: determinant(a) };
}

// ---- a polynomial that one bends

export const isPolynomial = ({ Q }) => Q.length === 1;

/**
 * What the weights are multiplied with, A^(j-1) 1 for j = 1, 2, ..: if R is a polynomial, b times the
 * j-th is its coefficient of z^j. They end at 0, and are as many as R may have powers.
 */
function weighed(a) {
  const vectors = [];
  let next = a.map(() => 1);
  while (vectors.length < a.length && next.some((x) => Math.abs(x) > NEAR)) {
    vectors.push(next);
    next = a.map((row) => inner(row, vectors.at(-1)));
  }
  return vectors;
}
const inner = (x, y) => x.reduce((sum, value, i) => sum + value * y[i], 0);

/** The coefficients of R, a polynomial, lowest power first: those that weights can change, and 1. */
export const coefficientsOf = ({ a, b }) => [1, ...weighed(a).map((vector) => inner(vector, b))];

/** Whether no other weights give the same polynomial with the same a. */
export const isAlone = ({ a }) => weighed(a).length === a.length;

/** The weights, as near as possible to b, with which R has this coefficient of z^j and keeps its others. */
export function bend({ a, b }, j, value) {
  const vectors = weighed(a),
    change = vectors.map((vector, i) => (i === j - 1 ? value - inner(vector, b) : 0));
  if (vectors.length === a.length) return add(b, solve(vectors, change));
  const shares = solve(
    vectors.map((x) => vectors.map((y) => inner(x, y))),
    change,
  );
  return add(
    b,
    b.map((_, i) => shares.reduce((sum, share, n) => sum + share * vectors[n][i], 0)),
  );
}
const add = (x, y) => x.map((value, i) => value + y[i]);

/**
 * The coefficient of z^j, nearest to what it is, with which |R(z)| is 1, and so the border goes through z;
 * if none does it, that with which |R(z)| is least.
 */
export function coefficientAt(coefficients, j, z) {
  const others = coefficients.map((x, i) => (i === j ? 0 : x)),
    [p, q] = evaluate(others, z),
    [u, w] = evaluate([...Array(j).fill(0), 1], z),
    size = Math.hypot(u, w);
  const along = (p * u + q * w) / size, // of the other terms, as seen from the one that changes
    across = Math.abs(q * u - p * w) / size,
    middle = -along / size;
  if (across >= 1) return middle;
  const off = Math.sqrt((1 - across) * (1 + across)) / size;
  return coefficients[j] < middle ? middle - off : middle + off;
}

/** Up to which power of z a polynomial is the exponential's series. */
export function agreement(coefficients) {
  let taylor = 1;
  const differs = coefficients.findIndex((x, j) => {
    taylor /= Math.max(j, 1);
    return Math.abs(x - taylor) >= NEAR;
  });
  return (differs < 0 ? coefficients.length : differs) - 1;
}

/** R at a complex z; [NaN, NaN] or infinities at a pole. */
export const growthAt = ({ P, Q }, z) => divide(evaluate(P, z), evaluate(Q, z));

/** Zeros of a real polynomial, whatever its leading coefficient. */
function zerosOf(coefficients) {
  const trimmed = trim(coefficients),
    last = trimmed.at(-1);
  return trimmed.length > 1 ? roots(trimmed.map((x) => x / last)) : [];
}

/** The first sign change from >= 0 to < 0 of a real polynomial on x > 0; Infinity if there is none. */
function firstDrop(slack, terms) {
  let kept = slack.map((x, i) => (Math.abs(x) < TOLERANCE * terms[i] ? 0 : x));
  const first = kept.findIndex((x) => x !== 0); // the multiple root at 0 says nothing
  if (first < 0) return Infinity;
  kept = kept.slice(first);
  const edges = zerosOf(kept)
    .filter(([re, im]) => re > 0 && Math.abs(im) < 1e-9 * Math.hypot(re, im))
    .map(([re]) => re)
    .sort((x, y) => x - y);
  edges.unshift(0);
  for (let i = 0; i < edges.length; i++) {
    const inside = i + 1 < edges.length ? (edges[i] + edges[i + 1]) / 2 : edges[i] + 1;
    if (evaluate(kept, [inside, 0])[0] < 0) return edges[i];
  }
  return Infinity;
}

/** Coefficients in r of |p(direction r)|², the lowest power first, and the sizes of what they sum. */
function squared(p, [re, im]) {
  let power = [1, 0];
  const along = p.map((x) => {
    const term = [x * power[0], x * power[1]];
    power = [power[0] * re - power[1] * im, power[0] * im + power[1] * re];
    return term;
  });
  const square = Array(2 * p.length - 1).fill(0),
    sizes = square.slice();
  along.forEach(([x, y], i) =>
    along.forEach(([u, v], j) => {
      square[i + j] += x * u + y * v;
      sizes[i + j] += Math.hypot(x, y) * Math.hypot(u, v);
    }),
  );
  return { square, sizes };
}

/** How far along a ray from 0 the method stays stable, in units of |z|. */
export function reach({ P, Q }, direction) {
  const [p, q] = [P, Q].map((polynomial) => squared(polynomial, direction)),
    size = Math.max(p.square.length, q.square.length),
    at = (list, i) => list[i] ?? 0;
  const slack = Array.from({ length: size }, (_, i) => at(q.square, i) - at(p.square, i)),
    terms = Array.from({ length: size }, (_, i) => at(q.sizes, i) + at(p.sizes, i));
  return firstDrop(slack, terms);
}

/** The largest step up to which every smaller one is stable too; Infinity if all are. */
export function longestStep(R, modes) {
  return Math.min(
    Infinity,
    ...modes.map(([re, im]) => {
      const modulus = Math.hypot(re, im);
      return modulus === 0 ? Infinity : reach(R, [re / modulus, im / modulus]) / modulus;
    }),
  );
}

/** Poles of R: zeros of Q that no zero of P takes away. */
export function polesOf({ P, Q }) {
  const others = zerosOf(P);
  return zerosOf(Q).filter(([re, im]) => {
    const near = others.findIndex(([x, y]) => Math.hypot(x - re, y - im) < 1e-5 * (1 + Math.hypot(re, im)));
    if (near >= 0) others.splice(near, 1);
    return near < 0;
  });
}

/**
 * A-stable: |R| <= 1 on the imaginary axis, where E(y) = |Q|² - |P|² >= 0 says so, and no pole in the
 * left half-plane. L-stable: R vanishes far out as well. `because`: "axis", "pole", "polynomial" or "".
 */
export function verdictOf(R) {
  const { P, Q } = R;
  const atInfinity = P.length > Q.length ? Infinity : P.length < Q.length ? 0 : Math.abs(P.at(-1) / Q.at(-1));
  let because = "";
  if (Q.length === 1 && P.length > 1) because = "polynomial";
  else if (reach(R, [0, 1]) < Infinity) because = "axis";
  else if (polesOf(R).some(([re]) => re < 0)) because = "pole";
  const isAStable = because === "";
  return { isAStable, isLStable: isAStable && atInfinity < 1e-9, because, atInfinity };
}
