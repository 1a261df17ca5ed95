// The readings as text for an address, and back.

import { whyNot } from "./readings.js";

export const PREFIX = "#chain:";
const LARGEST = 1e6; // of a number that an address may bring

/** How many readings there is room for. */
export const mostReadings = ({ quantiles }) => quantiles.t.length + 3;

/** "#chain:r=0.05_0.9;0.1_1.8": places over the largest and forces, all of them; those as they came are none. */
export function writeLink(readings, { start }) {
  const isAsTheyCame = JSON.stringify(readings) === JSON.stringify(start),
    text = readings.map((reading) => reading.join("_")).join(";");
  return PREFIX + (isAsTheyCame ? "" : `r=${text}`);
}

/** The readings that an address tells, or null if it is none of them, or they cannot be fitted. */
export function readLink(hash, facts) {
  if (!hash.startsWith(PREFIX)) return null;
  const text = hash.slice(PREFIX.length);
  if (text === "") return facts.start;
  if (!/^r=[\d.e+;_-]+$/.test(text)) return null;
  const readings = text
    .slice(2)
    .split(";")
    .map((pair) => pair.split("_").map((part) => (part === "" ? Number.NaN : Number(part))));
  const isReading = (pair) => pair.length === 2 && pair.every((number) => Math.abs(number) < LARGEST);
  if (!readings.every(isReading) || whyNot(readings, mostReadings(facts))) return null;
  return readings.sort(([x], [y]) => x - y);
}
