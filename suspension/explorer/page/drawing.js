// A curve that a reader draws, one height for each column of the axes, and how it compares with another.
// Heights are decimal logarithms; null where nothing is drawn.

import { show } from "./pen.js";

export const ENOUGH = 0.6; // of the columns, before anything is laid beside it
const LEAST = Math.log10(1.5); // a rise or a fall by less is the hand's, or a ripple

/** The heights after a stroke [[column, height], ...], which replaces what it passes over. */
export function lay(heights, stroke) {
  const after = [...heights];
  const put = (column, height) => {
    if (column >= 0 && column < after.length) after[column] = height;
  };
  stroke.forEach(([column, height], n) => {
    put(Math.round(column), height);
    if (!n) return;
    const [[a, from], [b, to]] = [stroke[n - 1], [column, height]].sort(([x], [y]) => x - y);
    for (let i = Math.ceil(a); i <= b; i++) if (b > a) put(i, from + ((to - from) * (i - a)) / (b - a));
  });
  return after;
}

export const drawn = (strokes, columns) => strokes.reduce(lay, Array(columns).fill(null));

export const share = (heights) => heights.filter((height) => height !== null).length / heights.length;

/** The stroke that sets the height in one column and joins it to the curve `step` columns away. */
export const strokeAt = (heights, column, height, step) =>
  [-step, 0, step]
    .map((off) => [column + off, off ? (heights[column + off] ?? null) : height])
    .filter(([, to]) => to !== null);

/** The rises and falls of a curve: { rises, from, to } in columns, without what is no more than a ripple. */
export function pieces(heights, least = LEAST) {
  const columns = [...heights.keys()].filter((i) => heights[i] !== null),
    found = [];
  let [start, low, high] = Array(3).fill(columns[0]),
    rises = null;
  const end = (to) => {
    found.push({ rises, from: start, to });
    [start, rises] = [to, !rises];
  };
  for (const i of columns) {
    if (heights[i] > heights[high]) high = i;
    if (heights[i] < heights[low]) low = i;
    if (rises !== false && heights[high] - heights[i] > least) {
      if (rises) end(high);
      rises = false;
      low = i;
    } else if (rises !== true && heights[i] - heights[low] > least) {
      if (rises === false) end(low);
      rises = true;
      high = i;
    } else continue;
    if (rises) low = start;
    else high = start;
  }
  if (rises !== null) found.push({ rises, from: start, to: columns.at(-1) });
  return found;
}

/** The slope of a curve between two columns, by least squares; `width` decades wide in all. */
export function slopeOf(heights, [from, to], width) {
  const at = [...heights.keys()].filter((i) => from <= i && i <= to && heights[i] !== null);
  if (at.length < 3) return null;
  const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const [i0, h0] = [mean(at), mean(at.map((i) => heights[i]))];
  const along = mean(at.map((i) => (i - i0) * (heights[i] - h0))) / mean(at.map((i) => (i - i0) ** 2));
  return (along * (heights.length - 1)) / width;
}

// ---- in words

const join = (words, last = "and") =>
  words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} ${last} ${words.at(-1)}`;

/** What a curve does from left to right, "falls, rises and falls". */
export const does = (found) =>
  found.length ? join(found.map(({ rises }) => (rises ? "rises" : "falls"))) : "stays at about one height";

/** How far a curve lies from another, both where the first is drawn: how high over it, in decades. */
function apart(heights, others) {
  const over = [...heights.keys()]
    .filter((i) => heights[i] !== null)
    .map((i) => ({ i, by: heights[i] - others[i] }))
    .sort((a, b) => Math.abs(a.by) - Math.abs(b.by));
  return { half: Math.abs(over[Math.floor(over.length / 2)].by), worst: over.at(-1) };
}

const factor = (by) => show(Math.max(10 ** Math.abs(by), 1), Math.abs(by) < 1 ? 2 : 1);

/** How the reader's curve compares with the exact one, of a picture with the given facts. */
export function compareCurve(heights, { curve, exact, x, symbol }) {
  const at = (i) => show(x[0] * (x[1] / x[0]) ** (i / (exact.length - 1)), 2);
  const own = pieces(heights),
    other = pieces(exact.map((height, i) => (heights[i] === null ? null : height)));
  const { half, worst } = apart(heights, exact);
  const alike = does(own) === does(other);
  const turns = other
    .slice(1)
    .map(({ from }, n) => `at ${symbol} = ${at(from)} (yours: ${at(own[n + 1]?.from)})`);
  const words = [
    `Where you drew, ${curve} ${does(other)}. ${alike ? "So does yours." : `Yours ${does(own)}.`}`,
    alike && turns.length ? `It turns ${join(turns)}.` : "",
    `Half of your curve lies within a factor of ${factor(half)} of it.`,
    Math.abs(worst.by) > LEAST
      ? `The farthest part, at ${symbol} = ${at(worst.i)}, is ${factor(worst.by)} times too ${worst.by > 0 ? "high" : "low"}.`
      : "",
  ];
  return words.filter(Boolean).join(" ");
}

/** How the reader's curve compares with a line, on the stretch where the line says what happens. */
export function compareLine(heights, { name, slope, stretch }, { x, symbol, curve }) {
  if (!stretch) return `${name}: ${curve} comes nowhere near this line.`;
  const width = Math.log10(x[1] / x[0]),
    [from, to] = stretch.map((i) => show(x[0] * (x[1] / x[0]) ** (i / (heights.length - 1)), 2));
  const where = `${name} holds from ${symbol} = ${from} to ${to}, with slope ${show(slope, 2)}.`;
  const own = slopeOf(heights, stretch, width);
  if (own === null) return `${where} You drew nothing there.`;
  const same = Math.abs(own - slope) < 0.25 * Math.abs(slope);
  return `${where} Yours has slope ${show(own, 2)} there${same ? ": well seen" : ""}.`;
}

/** What there is to do or to see as long as nothing is laid beside the curve. */
export function describeDrawn(heights) {
  const part = share(heights);
  if (!part) return "Nothing is drawn yet. Draw with mouse, pen or finger, or with the arrow keys.";
  if (part < ENOUGH)
    return `You have drawn ${Math.round(100 * part)} % of the way. Go on: nearly all of it is asked for.`;
  return `Your curve ${does(pieces(heights))}. It is kept, and laid beside the answer further down.`;
}
