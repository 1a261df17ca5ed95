// What one sets: the robot's numbers, its road, its speed, and in which units one reads them. Here it is
// checked, changed, written into an address and into lines of Python, and read from either.

import { heightAt, shapeOf } from "./own_run.js";
import { clamp } from "./pen.js";
import { readNumber } from "./state.js";

export const PREFIX = "#own:";
export const PAIRS = [
  ["L1", "L2"],
  ["k1", "k2"],
  ["c1", "c2"],
];
export const NUMBERS = ["m", "Izz", ...PAIRS.flat()];
const JOINS = ["pchip", "linear"];
const NEAR = 12; // digits of a place that is computed, so that it is written as one would

// ---- units: how many of them are one of the SI, and their name

const ALWAYS = {
  mass: [1, "kg"],
  inertia: [1, "kg m²"],
  stiffness: [1, "N/m"],
  damping: [1, "N s/m"],
  far: [1, "m"],
};
export const UNITS = {
  mm: { ...ALWAYS, speed: [1, "m/s"], length: [1000, "mm"] },
  cm: { ...ALWAYS, speed: [3.6, "km/h"], length: [100, "cm"] },
};
export const KINDS = {
  ...{ m: "mass", Izz: "inertia", L1: "length", L2: "length", k1: "stiffness", k2: "stiffness" },
  ...{ c1: "damping", c2: "damping", v: "speed", height: "length", sigma: "length", distance: "far" },
  ...{ tall: "length", long: "length" },
};
/** A number's units in one of the SI, and their name. */
export const unitOf = (name, { units }) => UNITS[units][KINDS[name]];

// ---- the road

/** The bump that a state holds; it begins as far ahead of the robot as the first one, in its widths. */
export const bumpOf = ({ ground: { height, sigma }, robot }, { lead }) => ({
  height,
  sigma,
  centre: Number((robot.L2 + lead * sigma).toPrecision(NEAR)),
});

/** Where a road of points begins: at height 0, a part of the wheelbase ahead of the front wheel. */
const beginOf = ({ robot: { L1, L2 } }, { ahead }) => Number((L2 + ahead * (L1 + L2)).toPrecision(NEAR));

/** The points of the road that a state holds. */
export function pointsOf(state, facts) {
  const { x, h, tall, long, join } = state.ground,
    begin = beginOf(state, facts);
  return {
    x: x.map((place) => begin + long * (place - x[0])),
    h: h.map((height) => tall * (height - h[0])),
    join,
  };
}

const highest = (h) => h.reduce((most, height) => Math.max(most, Math.abs(height - h[0])), 0);

/** How far a drive goes that nobody has asked to go further, m: some widths beyond the end of the road. */
export function usualWay(end, L1, sigma, { beyond, ways }) {
  const far = end + L1 + beyond * sigma,
    ten = 10 ** Math.floor(Math.log10(far));
  return Number(([...ways, 10].find((step) => step * ten >= far * (1 - 1e-9)) * ten).toPrecision(NEAR));
}

// ---- what may be set

const isNumber = (value) => typeof value === "number" && Number.isFinite(value);
const isWithin = (value, [low, high]) => isNumber(value) && value >= low && value <= high;

/** Why points are no road, in the words of one who pasted them; "" if they are one. `lines` tell where. */
export function whyNoRoad({ x, h, join }, { limits, points: [fewest, most], steepest }, lines = null) {
  const where = (i) => (lines ? `line ${lines[i]}` : `point ${i + 1}`);
  if (x.length < fewest)
    return `Too few points: ${x.length || "none"}, and at least ${fewest} are needed, an x and an h on each line.`;
  if (x.length > most)
    return `Too many points: ${x.length}, and at most ${most} can be drawn. Keep one of each ${Math.ceil(x.length / most)}.`;
  for (let i = 1; i < x.length; i++) {
    if (x[i] === x[i - 1])
      return `x must increase: ${where(i)} is where ${where(i - 1)} is. Keep one point for each place.`;
    if (x[i] < x[i - 1])
      return `x must increase: ${where(i)} lies behind ${where(i - 1)}. Sort the points by x.`;
  }
  const length = x.at(-1) - x[0],
    high = highest(h);
  if (!isWithin(length, limits.long))
    return `The road is ${length} m long, and may be from ${limits.long[0]} to ${limits.long[1]} m. Are these the units?`;
  if (!(high <= limits.tall[1]))
    return `The road is ${high} m high, and may be at most ${limits.tall[1]} m. Are these the units?`;
  for (let i = 1; i < x.length; i++) {
    const slope = Math.abs((h[i] - h[i - 1]) / (x[i] - x[i - 1]));
    if (!(slope <= steepest))
      return `Too steep: a slope of ${Number(slope.toPrecision(3))} between ${where(i - 1)} and ${where(i)}, and at most ${steepest} can be driven. Are these the units? Else spread the points, or lower them.`;
  }
  // Between the points a curve is steeper than their mean.
  const most2 = shapeOf({ x, h, join }).steepest;
  if (!(most2 <= steepest))
    return `Too steep between two points: a slope of ${Number(most2.toPrecision(3))}, and at most ${steepest} can be driven. Join the points by straight lines, or lower them.`;
  return "";
}

function readGround(ground, facts) {
  const { limits } = facts;
  if (ground?.kind === "bump") {
    const { height, sigma } = ground;
    if (!isWithin(height, limits.height) || !isWithin(sigma, limits.sigma)) return null;
    return { kind: "bump", height, sigma };
  }
  if (ground?.kind !== "points") return null;
  const { x, h, tall = 1, long = 1, join = "pchip" } = ground;
  const areNumbers = [x, h].every((list) => Array.isArray(list) && list.every(isNumber));
  if (!areNumbers || x.length !== h.length || !JOINS.includes(join)) return null;
  if (!(isNumber(tall) && tall > 0 && isNumber(long) && long > 0)) return null;
  const read = { kind: "points", x, h, tall, long, join };
  return whyNoRoad(pointsOf({ ground: read, robot: { L1: 0, L2: 0 } }, facts), facts) ? null : read;
}

/** A state as it was set by whomever, checked; null if it is none. */
export function readState(raw, facts) {
  if (typeof raw !== "object" || raw === null) return null;
  const { limits, vehicles } = facts,
    robot = {};
  for (const name of NUMBERS) {
    if (!isWithin(raw.robot?.[name], limits[name])) return null;
    robot[name] = raw.robot[name];
  }
  const ground = readGround(raw.ground, facts);
  if (!ground || !isWithin(raw.v, limits.v)) return null;
  const distance = raw.distance ?? null;
  if (distance !== null && !isWithin(distance, limits.distance)) return null;
  const alike = raw.alike === true && PAIRS.every(([rear, front]) => robot[rear] === robot[front]);
  return {
    ...{ robot, ground, v: raw.v, distance, alike },
    units: Object.hasOwn(UNITS, raw.units) ? raw.units : "mm",
    from: Number.isInteger(raw.from) && raw.from >= 0 && raw.from < vehicles.length ? raw.from : 0,
  };
}

/** The state of a vehicle one starts from; the units stay. */
export const startFrom = (index, { vehicles }, units) => {
  const { robot, bump, v } = vehicles[index];
  return {
    ...{ robot: { ...robot }, ground: { kind: "bump", ...bump }, v, distance: null },
    alike: PAIRS.every(([rear, front]) => robot[rear] === robot[front]),
    ...{ units, from: index },
  };
};

export const numberOf = (name, { robot, ground, v, distance }, usual) => {
  if (NUMBERS.includes(name)) return robot[name];
  if (name === "v") return v;
  if (name === "distance") return distance ?? usual;
  if (name === "tall") return ground.tall * highest(ground.h);
  if (name === "long") return ground.long * (ground.x.at(-1) - ground.x[0]);
  return ground[name];
};

/** A state with another value of one of its numbers; with axles alike, both wheels get it. */
export function withValue(state, name, value) {
  const { robot, ground, alike } = state;
  if (NUMBERS.includes(name)) {
    const both = (alike && PAIRS.find((pair) => pair.includes(name))) || [name];
    return { ...state, robot: { ...robot, ...Object.fromEntries(both.map((one) => [one, value])) } };
  }
  if (name === "v" || name === "distance") return { ...state, [name]: value };
  if (name === "tall") return { ...state, ground: { ...ground, tall: value / highest(ground.h) } };
  if (name === "long")
    return { ...state, ground: { ...ground, long: value / (ground.x.at(-1) - ground.x[0]) } };
  return { ...state, ground: { ...ground, [name]: value } };
}

/** The symmetric robot with the means of both axles. */
export const makeAlike = (state) => {
  const robot = { ...state.robot };
  for (const [rear, front] of PAIRS) robot[rear] = robot[front] = (robot[rear] + robot[front]) / 2;
  return { ...state, robot, alike: true };
};
export const isSymmetric = ({ robot }) => PAIRS.every(([rear, front]) => robot[rear] === robot[front]);

/** Why a value of a number cannot be, or ""; a road that gets steeper by it may be none. */
export function whyNoValue(state, name, value, facts) {
  const [factor, unit] = unitOf(name, state),
    [low, high] = facts.limits[name],
    write = (x) => `${Number((factor * x).toPrecision(6))}`;
  if (!isNumber(value)) return `A number, please: ${write(low)} to ${write(high)} ${unit}`;
  if (value < low * (1 - 1e-12) || value > high * (1 + 1e-12))
    return `Out of range: ${write(low)} to ${write(high)} ${unit}`;
  const next = withValue(state, name, clamp(value, low, high));
  if (name === "tall" || name === "long") return whyNoRoad(pointsOf(next, facts), facts);
  return "";
}

// ---- the scale of a slider

const logarithmic = (low, high) => ({
  toPlace: (value) => clamp(Math.log(value / low) / Math.log(high / low), 0, 1),
  toValue: (place) => low * (high / low) ** place,
});
const squared = (high) => ({
  toPlace: (value) => clamp(Math.sqrt(value / high), 0, 1),
  toValue: (place) => high * place * place, // from 0 on, and fine where it is small
});

/** The scale of a number's slider: around what one started from, or around the value if that is far. */
export function scaleOf(name, state, facts, { usual, speeds }) {
  const value = numberOf(name, state, usual),
    { robot, bump } = facts.vehicles[state.from],
    [low, high] = facts.limits[name];
  if (name === "c1" || name === "c2") {
    const top = facts.strong * Math.sqrt((robot.k1 + robot.k2) * robot.m);
    return squared(Math.max(top, robot.c1, robot.c2, value > top ? 2 * value : 0));
  }
  if (name === "v") return logarithmic(Math.min(speeds[0], value), Math.max(speeds[1], value));
  const base = { ...robot, ...bump, distance: usual }[name] ?? numberOf(name, withOnes(state), usual),
    middle = value < base / 10 || value > base * 10 ? value : base;
  return logarithmic(Math.max(low, middle / 10), Math.min(high, middle * 10));
}
const withOnes = (state) => ({ ...state, ground: { ...state.ground, tall: 1, long: 1 } });

// ---- drawing

/** The road as heights of equally spaced columns between two places, relative to the start. */
export function columnsOf(pieces, [from, to], columns) {
  const start = heightAt(pieces, from);
  return Array.from(
    { length: columns },
    (_, i) => heightAt(pieces, from + ((to - from) * i) / (columns - 1)) - start,
  );
}

const tidy = (value, size) => Number(value.toFixed(Math.max(0, 5 - Math.floor(Math.log10(size)))));

/** Points of a drawn road: heights of equally spaced columns over a length, level at the start. */
export function drawnGround(heights, length) {
  const n = heights.length - 1;
  return {
    kind: "points",
    x: heights.map((_, i) => tidy((length * i) / n, length)),
    h: heights.map((height, i) => (i ? tidy(height, length) : 0)),
    ...{ tall: 1, long: 1, join: "pchip" },
  };
}

/** Heights with each of some columns drawn towards the mean of its neighbours; the ends stay. */
export function smooth(heights, [from, to] = [1, heights.length - 2], times = 1) {
  let now = heights;
  for (let n = 0; n < times; n++)
    now = now.map((height, i) =>
      i > 0 && i < now.length - 1 && i >= from && i <= to
        ? (now[i - 1] + 2 * height + now[i + 1]) / 4
        : height,
    );
  return now;
}

// ---- a road that is pasted

/** The two numbers of a line, each null if it is none; null if there are not two. */
function readLine(line) {
  const hard = /[;\t]/.test(line),
    parts = hard
      ? line.split(/[;\t]/)
      : /\S\s+\S/.test(line.trim())
        ? line.trim().split(/\s*,\s+|\s+,?\s*/)
        : line.split(",");
  const words = parts.map((part) => part.trim()).filter(Boolean);
  return words.length === 2 ? words.map(readNumber) : null;
}

/** Pasted text as points, x and h in the units given: { x, h } in m, or { error }. */
export function readRoad(text, [ofX, ofH], facts, join = "pchip") {
  const [x, h, lines] = [[], [], []];
  for (const [i, line] of text.split(/\r\n|\r|\n/).entries()) {
    if (!line.trim() || line.trim().startsWith("#")) continue;
    const read = readLine(line);
    if (!x.length && !lines.length && !/\d/.test(line)) continue; // what the columns are called
    if (!read)
      return {
        error: `Line ${i + 1}: two numbers are asked for, x and h, got “${line.trim().slice(0, 40)}”.`,
      };
    if (read.includes(null))
      return {
        error: `Line ${i + 1}: ${read[0] === null ? "x" : "h"} must be a number, got “${line.trim().slice(0, 40)}”.`,
      };
    x.push(read[0] / ofX);
    h.push(read[1] / ofH);
    lines.push(i + 1);
  }
  const error = whyNoRoad({ x, h, join }, facts, lines);
  return error ? { error } : { x, h };
}

// ---- an address

const short = (x) => String(x);

/** "#own:m=1.456&…&road=0.0254_0.0288": everything that is set. */
export function writeLink({ robot, ground, v, distance, alike, units, from }) {
  const parts = new URLSearchParams();
  for (const name of NUMBERS) parts.set(name, short(robot[name]));
  parts.set("v", short(v));
  if (ground.kind === "bump") parts.set("road", [ground.height, ground.sigma].map(short).join("_"));
  else {
    for (const name of ["x", "h"]) parts.set(name, ground[name].map(short).join("_"));
    for (const name of ["tall", "long"]) if (ground[name] !== 1) parts.set(name, short(ground[name]));
    if (ground.join !== "pchip") parts.set("join", ground.join);
  }
  if (distance !== null) parts.set("distance", short(distance));
  if (alike) parts.set("alike", "1");
  if (units !== "mm") parts.set("units", units);
  if (from) parts.set("from", short(from));
  return PREFIX + parts.toString();
}

/** The state that an address holds, or null. */
export function readLink(hash, facts) {
  if (!hash.startsWith(PREFIX)) return null;
  const parts = new URLSearchParams(hash.slice(PREFIX.length)),
    number = (name, usual) => (parts.has(name) ? readNumber(parts.get(name)) : usual),
    list = (name) => (parts.get(name) ?? "").split("_").map(readNumber);
  const [height, sigma] = list("road");
  return readState(
    {
      robot: Object.fromEntries(NUMBERS.map((name) => [name, number(name)])),
      ground: parts.has("road")
        ? { kind: "bump", height, sigma }
        : {
            ...{ kind: "points", x: list("x"), h: list("h"), join: parts.get("join") ?? "pchip" },
            ...{ tall: number("tall", 1), long: number("long", 1) },
          },
      v: number("v"),
      distance: number("distance", null),
      alike: parts.has("alike"),
      units: parts.get("units"),
      from: number("from", 0),
    },
    facts,
  );
}

// ---- lines of Python

const WIDTH = 80;

/** A list of numbers as Python writes it, in lines that fit. */
function listOf(numbers) {
  const lines = [""];
  for (const number of numbers) {
    const word = `${String(number)}, `;
    if (lines.at(-1).length + word.length > WIDTH - 4) lines.push("");
    lines[lines.length - 1] += word;
  }
  return `[\n${lines.map((line) => `    ${line.trim()}\n`).join("")}]`;
}

/** The lines that give the same numbers, filled into what Python handed over. */
export function pythonOf(state, facts, { distance, speeds }) {
  const { robot, ground, v } = state,
    { python } = facts,
    points = () => ({ ...ground, begin: beginOf(state, facts), x: listOf(ground.x), h: listOf(ground.h) }),
    own = ground.kind === "bump" ? bumpOf(state, facts) : points();
  const values = { ...robot, ...own, v, distance, vmin: speeds[0], vmax: speeds[1] },
    text = python[ground.kind] + (isSymmetric(state) ? python.groups : python.twin) + python.end;
  return text.replace(/\{(\w+)\}/g, (_gap, name) => String(values[name]));
}
