// What follows from readings, in words: one function for each thing that is told, a branch for each case.

import { show } from "./pen.js";

const SPACE = "\u00a0";
const OPEN = "cannot be told";
const SEEN = 5e-5; // what lies beyond the table is told from here on: a confidence has two decimals

/** A number with its unit. */
const of = (x, unit, digits = 3) => `${show(x, digits)}${SPACE}${unit}`;

/** Two given numbers. */
const span = ([low, high], unit) => `${show(low)} to ${of(high, unit)}`;

/** Two ends, with the decimals that their distance deserves, and more if the nearer to zero needs them. */
export function range([low, high], unit = "") {
  const [near, far] = [low, high].map(Math.abs).sort((a, b) => a - b),
    digit = (x) => 1 - Math.ceil(Math.log10(x)),
    wide = high > low ? 1 - Math.floor(Math.log10(high - low)) : 2 + digit(far || 1),
    decimals = Math.max(wide, near > 0 ? Math.min(digit(near), wide + 2) : wide);
  const written = (x) =>
    Math.abs(decimals) > 9
      ? show(x)
      : (Math.round(x * 10 ** decimals) / 10 ** decimals).toFixed(Math.max(decimals, 0));
  const [from, to] = [low, high].map((x) =>
    written(x)
      .replace(/^-(?=[0.]*$)/, "")
      .replace("-", "−"),
  );
  return `${from === to ? from : `${from} to ${to}`}${unit && SPACE + unit}`;
}

/** A probability as a percentage that never claims certainty. */
export function confidence(p) {
  if (p < 1e-4) return `<${SPACE}0.01${SPACE}%`;
  if (p > 0.9999) return `>${SPACE}99.99${SPACE}%`;
  return `${(100 * p).toFixed(2)}${SPACE}%`;
}

const count = (n) =>
  ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"][n] ?? `${n}`;
const capital = (words) => words[0].toUpperCase() + words.slice(1);
const percent = (part) => `${show(100 * part, 2)}${SPACE}%`;

/** The stiffness, and how well it is known. */
export function tellStiffness({ why, fit }, { level }) {
  if (why) return `These readings tell no stiffness: ${why}.`;
  if (!(fit.k > 0))
    return `The slope at zero is ${of(fit.k, "N/m")}: no spring pushes less when it is pressed more. Nothing follows for the robot.`;
  if (fit.isExact)
    return `k = ${of(fit.k, "N/m")}. The readings lie on the parabola: every interval is a point.`;
  const beyond = fit.interval[0] > 0 ? "" : " Even the sign is open.";
  return `k = ${of(fit.k, "N/m")}, with ${percent(level)} confidence ${range(fit.interval, "N/m")}.${beyond}`;
}

/** Whether the readings contradict a linear spring without preload, b0 = b2 = 0. */
export function tellLine({ fit }, { level }) {
  if (!fit) return "";
  const { isExact, test } = fit;
  if (isExact)
    return test.inside
      ? "The readings lie on a line through the origin."
      : "The readings lie on a parabola that is no line through the origin: a linear spring without preload is ruled out.";
  const p = test.p < 0.001 ? `p${SPACE}<${SPACE}0.001` : `p${SPACE}=${SPACE}${show(test.p, 2)}`,
    numbers = `F = ${show(test.F, 3)}, ${p}`,
    alpha = percent(1 - level);
  if (test.inside)
    return `A linear spring without preload, (0, 0), lies inside the ellipse: ${numbers}, not contradicted.`;
  const also = test.joint
    ? "though zero lies in both joint intervals: the test sees both coefficients at once"
    : "and zero outside a joint interval";
  return `A linear spring without preload, (0, 0), lies outside the ellipse: ${numbers}, contradicted at ${alpha}, ${also}.`;
}

/** Which critical speeds there are, and whether the readings can tell. */
export function tellSpeeds({ fit, critical }, { k, v, error }) {
  if (!(fit?.k > 0)) return "";
  const table = span(k, "N/m");
  if (!critical)
    return `The table of critical speeds goes from ${table}. This stiffness is beyond it, and nothing is extrapolated.`;
  const { speeds, isWhole } = critical,
    open = speeds.filter(({ born, dies }) => born || dies).length,
    told = [];
  const all =
      ["", "The one critical speed", "Both critical speeds"][speeds.length] ??
      `All ${count(speeds.length)} critical speeds`,
    some = open < speeds.length ? `${capital(count(open))} of ${count(speeds.length)} critical speeds` : all;
  if (!speeds.length) told.push(`There is no critical speed from ${span(v, "m/s")}.`);
  else if (open)
    told.push(
      `${some} ${open > 1 ? "come or go" : "comes or goes"} within the interval of k: whether ${open > 1 ? "they exist" : "it exists"} cannot be told from these readings.`,
    );
  else told.push(`${all} ${speeds.length > 1 ? "exist" : "exists"} for every stiffness of the interval.`);
  if (!isWhole)
    told.push(`The interval of k reaches beyond the table, ${table}; what happens there is not told.`);
  if (speeds.length)
    told.push(`Speeds are read from a table; no place tried was off by more than ${percent(error)}.`);
  return told.join(" ");
}

/** A verdict for each asked speed: how sure is which. */
export function verdictRows({ verdicts }, { level }) {
  return (verdicts ?? []).map(({ v, lost, beyond }) => {
    const kept = Math.max(1 - lost - beyond, 0),
      verdict = lost >= level ? "lost" : kept >= level ? "kept" : OPEN;
    const sure = beyond < SEEN ? confidence(lost) : `${confidence(lost)} to ${confidence(lost + beyond)}`;
    return [of(v, "m/s"), verdict, sure];
  });
}

/** The verdicts in one sentence, those that cannot be told too. */
export function tellVerdicts(found, facts) {
  const rows = verdictRows(found, facts);
  const at = (verdict) =>
    rows
      .filter((row) => row[1] === verdict)
      .map(([v]) => v.split(SPACE)[0])
      .join(", ")
      .replace(/, (?=[^,]*$)/, " and ");
  const told = [
    ["kept", "contact kept at"],
    ["lost", "lost at"],
    [OPEN, "cannot be told at"],
  ].flatMap(([verdict, words]) => (at(verdict) ? `${words} ${at(verdict)}${SPACE}m/s` : []));
  return told.length ? `${capital(told.join("; "))}.` : "";
}

/** The critical speeds, each with its interval and where it exists. */
export function speedRows({ critical }) {
  return (critical?.speeds ?? []).map(({ speed, low, high, born, dies }) => {
    const start = born && `above k = ${of(born.k, "N/m")}, where ${begins[born.why]}`,
      stop = dies && `below k = ${of(dies.k, "N/m")}, where ${ends[dies.why]}`;
    const where = [start, stop].filter(Boolean).join(", and ");
    return [
      speed === null ? "none at this k" : of(speed, "m/s"),
      range([low, high], "m/s"),
      where ? `only ${where}` : "in the whole interval",
    ];
  });
}
const begins = { pair: "it appears with another", range: "it enters the range of speeds" };
const ends = { pair: "it meets another and both vanish", range: "it leaves the range of speeds" };

/** The coefficients with their intervals. */
export const coefficientRows = ({ fit }) =>
  (fit?.beta ?? []).map((b, j) => [
    `β${"₀₁₂"[j]}`,
    of(b, "N"),
    range(fit.alone[j], "N"),
    range(fit.joint[j], "N"),
  ]);

/** The reading that is chosen. */
export function tellReading(readings, at, { fit }) {
  if (at === null) return "Choose a reading: drag it, tap it, or use the arrow keys.";
  const [x, force] = readings[at];
  return `Reading ${at + 1} of ${readings.length}, at ${show(x)}: ${of(force, "N", 4)}${fit ? `, fit ${of(fit.force(x), "N", 4)}` : ""}.`;
}
