// What the workshop says of a table: sentences, each with a branch for every case.

import { show } from "./pen.js";
import {
  agreement,
  CONDITIONS,
  coefficientsOf,
  growthAt,
  HIGHEST,
  isAlone,
  isPolynomial,
  kindOf,
  longestStep,
  orderOf,
  stabilityOf,
  strayStages,
  verdictOf,
  writeEntry,
} from "./tableau.js";

const CLOSE = 0.99; // of the best possible step is as good as the best
const FAR = -10; // where a polynomial is shown to have grown

export const ms = (t) => `${show(1000 * t)} ms`;
const evaluations = (work) => `${work} ${work === 1 ? "evaluation" : "evaluations"}`;

/** Everything that follows from the numbers a, b, c for a robot with these modes. */
export function examine(numbers, modes) {
  const R = stabilityOf(numbers);
  return {
    ...{ numbers, R, stages: numbers.b.length, kind: kindOf(numbers), strays: strayStages(numbers) },
    ...orderOf(numbers),
    ...verdictOf(R),
    limit: longestStep(R, modes),
  };
}

const RAISED = "⁰¹²³⁴⁵⁶";

/** A power of z. */
export const power = (j) => (j ? (j > 1 ? `z${RAISED[j]}` : "z") : "");

/** A coefficient: a fraction of small numbers, or a few digits. */
export function coefficient(x) {
  const exact = writeEntry(x);
  return exact.length > 8 ? show(x, 4) : exact;
}

/** One that somebody has moved: beside 1/6 one reads 0.187 faster than 14/75. */
export function moved(x) {
  const exact = writeEntry(x);
  return /^-?(\d+|\d\/\d+)$/.test(exact) ? exact.replace("-", "−") : show(x, 3);
}

/** A polynomial in z, "1 + z + 1/2 z²". */
export function polynomial(coefficients) {
  const terms = [];
  coefficients.forEach((x, j) => {
    if (x === 0) return;
    const size = coefficient(Math.abs(x)),
      term = j && size === "1" ? power(j) : [size, power(j)].filter(Boolean).join(" ");
    terms.push(terms.length ? (x < 0 ? ` − ${term}` : ` + ${term}`) : x < 0 ? `−${term}` : term);
  });
  return terms.join("") || "0";
}

export function orderWords({ order, numbers, strays }) {
  const sum = numbers.b.reduce((sum, x) => sum + x, 0);
  if (order === 0) return `0: the weights b sum to ${show(sum, 6)}, not to 1, and no step is short enough`;
  const found = order === HIGHEST ? `${HIGHEST} or more` : String(order);
  if (!strays.length) return found;
  const names = strays.map((i) => `c${i + 1}`).join(", ");
  return `${found} where nothing depends on time; ${names} ${strays.length > 1 ? "are not the sums of their rows" : "is not the sum of its row"}, so the road is felt at the wrong moments`;
}

export function stabilityWords({ isAStable, isLStable, because, atInfinity }) {
  if (isLStable) return "A-stable, and L-stable: far out R vanishes";
  if (isAStable) return `A-stable, not L-stable: far out |R| is ${show(atInfinity)}`;
  if (because === "polynomial") return "not A-stable: R is a polynomial, and no polynomial stays below 1";
  if (because === "axis") return "not A-stable: |R| passes 1 on the imaginary axis";
  return "not A-stable: R has a pole left of the imaginary axis";
}

export function limitWords({ limit }) {
  if (limit === Infinity) return "every step is stable";
  return limit === 0 ? "no step is stable" : ms(limit);
}

export const headline = (name, facts) =>
  `${name}: ${facts.kind}, ${facts.stages} ${facts.stages === 1 ? "stage" : "stages"}, order ${
    facts.order === HIGHEST ? `${HIGHEST} or more` : facts.order
  }. ${facts.isAStable ? "A-stable" : "Not A-stable"}; for this robot ${
    facts.limit === Infinity
      ? "every step is stable"
      : facts.limit === 0
        ? "no step is stable"
        : `steps up to ${ms(facts.limit)} are stable`
  }.`;

/** What one step does to the robot's fastest swing, were it undamped. */
export function swingWords(R, y) {
  const [re, im] = growthAt(R, [0, y]),
    size = Math.hypot(re, im);
  if (y >= Math.PI) return `Δt takes more than half a swing, and no phase is left to compare.`;
  const phase = Math.atan2(im, re) / y;
  return `A swing as fast as the robot's fastest, y = ${show(y)}: amplitude × ${show(size, 5)} per step, phase ${show(100 * phase, 4)} % of what it should be.`;
}

export function workWords({ kind, stages }, { run, J, work, error }, load) {
  if (!run) return "With this Δt the stages' equations have no solution: no run.";
  const said = `${J} steps × ${stages} ${stages === 1 ? "stage" : "stages"} = ${evaluations(work)}. `,
    missed = Number.isFinite(error)
      ? `Largest error of a force: ${show(error)} N, ${show((100 * error) / load, 2)} % of the load at rest.`
      : "The run grows past all numbers.";
  const solved = {
    explicit: "",
    "diagonally implicit": ` Each step also solves for 4 unknowns, stage after stage; that is not counted.`,
    implicit: ` Each step also solves for ${4 * stages} unknowns at once; that is not counted.`,
  }[kind];
  return said + missed + solved;
}

export function raceWords(name, mine, other) {
  const said = `At equal work ${name} takes ${other.J} ${other.J === 1 ? "step" : "steps"} (${evaluations(other.work)}): `;
  if (!Number.isFinite(other.error))
    return `${said}${Number.isFinite(mine.error) ? "it blows up, yours does not." : "both blow up."}`;
  if (!Number.isFinite(mine.error)) return `${said}error ${show(other.error)} N; yours blows up.`;
  const [less, more] = [mine.error, other.error].sort((x, y) => x - y);
  if (more <= 1.01 * less) return `${said}error ${show(other.error)} N, like yours.`;
  return `${said}error ${show(other.error)} N. ${mine.error < other.error ? "Yours" : "It"} wins by a factor of ${show(more / less, 2)}.`;
}

/** The puzzles: what is asked, whether it is won, and what is in the way. */
export function puzzles(facts, traded) {
  const { stages, order, kind, limit, R, holds, isAStable } = facts;
  const needs = (n, p) => {
    if (stages !== n) return `Your table has ${stages} ${stages === 1 ? "stage" : "stages"}.`;
    if (order < p)
      return `Order ${order} so far: ${CONDITIONS[holds.indexOf(false)].name} is not what it should be.`;
    return facts.strays.length ? "c must be the row sums." : "";
  };
  const first = () => {
    const missing = needs(3, 3);
    if (missing) return [false, missing];
    if (limit === Infinity)
      return [true, "Won: no step is too long. A stage that uses itself makes R a fraction."];
    if (kind === "explicit")
      return [
        false,
        `Every explicit method with three stages and order 3 has R = 1 + z + z²/2 + z³/6, and all end at ${ms(limit)}. What must change?`,
      ];
    return [false, `Steps up to ${ms(limit)}. Some methods have no limit.`];
  };
  const second = () => {
    const missing = needs(3, 2);
    if (missing) return [false, missing];
    if (kind !== "explicit") return [false, `Explicit, please: yours is ${kind}.`];
    if (limit >= CLOSE * traded)
      return [true, `Won: ${ms(limit)} of ${ms(traded)}, the longest possible. Order 3 would cost this.`];
    return [
      false,
      `${ms(limit)} so far; the longest possible is ${ms(traded)}. Only the factor of z³ in R is free.`,
    ];
  };
  const third = () => {
    if (kind !== "explicit")
      return [false, isAStable ? `A-stable, but ${kind}.` : `Neither: yours is ${kind} and not A-stable.`];
    if (R.P.length === 1) return [false, "R is constant: such a method stands still, its order is 0."];
    const size = Math.hypot(...growthAt(R, [FAR, 0]));
    return [
      false,
      `Cannot be won. Without a stage that uses itself R is a polynomial, and a polynomial has no bound: yours is ${show(size)} in size at z = −${-FAR}.`,
    ];
  };
  return [
    ["Three stages, order 3, the longest step for this robot", first()],
    ["Explicit, three stages, order 2, a longer step than order 3 allows", second()],
    ["Explicit and A-stable", third()],
  ].map(([task, [isWon, words]]) => ({ task, isWon, words }));
}

/**
 * What became of R: beside `base`, the method with the same a whose R it was; null if it is that method.
 * `pulls` names the coefficient that the border changes.
 */
export function bentWords(facts, base, pulls) {
  if (!isPolynomial(facts.R))
    return "R is a fraction here: as a power series it never ends, and no table moves one of its numbers alone. Start from an explicit method to bend its R.";
  const now = coefficientsOf(facts.numbers);
  if (!base)
    return `Move a number, or pull the border in the picture, which changes the one at ${power(pulls)}: the weights b follow, a stays.`;
  const before = coefficientsOf(base.numbers),
    changed = now.flatMap((x, j) => (Math.abs(x - before[j]) > 1e-9 ? [j] : []));
  if (!changed.length) return `The R(z) of ${base.name}, by other weights.`;
  const parts = changed.map((j) => `${moved(now[j])} at ${power(j)} in place of ${moved(before[j])}`),
    said = `The R(z) of ${base.name} with ${parts.join(", ")}. `;
  const p = agreement(now),
    series = p ? `It is the series of the exponential up to ${power(p)}` : "It is no longer near 1 + z",
    number = ({ order }) => (order === HIGHEST ? `${HIGHEST} or more` : order);
  const fall =
    facts.order === base.order
      ? `the order stays ${number(facts)}`
      : `the order ${facts.order < base.order ? "falls" : "rises"} from ${number(base)} to ${number(facts)}`;
  const trees =
    facts.order < Math.min(p, HIGHEST)
      ? `. For a swing alone it would be ${p}: other trees do not fit these weights`
      : "";
  return `${said}${series}; ${fall}${trees}. ${limitChange(facts.limit, base.limit)} ${
    isAlone(facts.numbers)
      ? "With this a no other weights b have it; other tables do."
      : "Other weights b have it too; these are the nearest."
  }`;
}

function limitChange(now, before) {
  if (before === 0 && now === 0) return "No step is stable, as before.";
  if (now === 0) return `No step is stable any more; it was ${ms(before)}.`;
  if (before === 0) return `Steps up to ${ms(now)} are stable, where none was.`;
  if (Math.abs(now - before) <= 5e-4 * before) return `The longest stable step stays ${ms(now)}.`;
  return `The longest stable step ${now < before ? "shrinks" : "grows"} from ${ms(before)} to ${ms(now)}.`;
}

/** What cannot be read, in words. */
export const wrongEntry = (name, text) =>
  `${name}: a number or a fraction is expected, like 1/6, 0.5 or (3-√3)/6, not “${text.slice(0, 20)}”.`;
