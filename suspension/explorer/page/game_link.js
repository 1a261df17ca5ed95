// What an attempt is as text for an address, and back.

export const PREFIX = "#game:";

/** "#game:road=1&k=280&c=1.57" */
export const writeLink = ({ level, k, c }) =>
  `${PREFIX}${new URLSearchParams({ road: String(level), k: String(k), c: String(c) })}`;

/** The attempt that an address tells, or null if it is none, or of a road that is not there. */
export function readLink(hash, { levels, ranges }) {
  if (!hash.startsWith(PREFIX)) return null;
  const parts = new URLSearchParams(hash.slice(PREFIX.length)),
    level = Number(parts.get("road") ?? Number.NaN),
    [k, c] = ["k", "c"].map((name) => Number.parseFloat(parts.get(name)));
  const isIn = (value, [low, high]) => value >= low && value <= high;
  if (!levels[level] || !isIn(k, ranges.k) || !isIn(c, ranges.c)) return null;
  return { level, k, c };
}
