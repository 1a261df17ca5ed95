// What a workshop holds as text for an address, and back.

export const PREFIX = "#workshop:";
const MOST = 6; // stages
const LETTERS = 40; // of an entry

/**
 * "#workshop:a=0_1/2&b=1/2_1/2&c=…&v=1.2&dt=0.02": entries by "_", rows by ";"; c only if it does not
 * follow a. The table kept to compare with is told by ka, kb and kc.
 */
export function writeLink(model) {
  const parts = new URLSearchParams(),
    row = (entries) => entries.join("_");
  const tell = ({ a, b, c, follows }, kept = "") => {
    parts.set(`${kept}a`, a.map(row).join(";"));
    parts.set(`${kept}b`, row(b));
    if (!follows) parts.set(`${kept}c`, row(c));
  };
  tell(model.get("tableau"));
  if (model.get("kept")?.b) tell(model.get("kept"), "k");
  for (const name of ["v", "dt"]) parts.set(name, String(Number(model.get(name).toPrecision(6))));
  return PREFIX + parts.toString();
}

/** What of a model an address sets, or null if it is none of a workshop or no table. */
export function readLink(hash) {
  if (!hash.startsWith(PREFIX)) return null;
  const parts = new URLSearchParams(hash.slice(PREFIX.length)),
    tableau = readTable(parts);
  if (!tableau) return null;
  const found = { tableau, kept: readTable(parts, "k") ?? {} };
  for (const name of ["v", "dt"]) {
    const value = Number.parseFloat(parts.get(name));
    if (Number.isFinite(value)) found[name] = value;
  }
  return found;
}

/** A table of texts out of an address, or null if its rows do not fit. */
function readTable(parts, kept = "") {
  const row = (text) => text.split("_").map((entry) => entry.slice(0, LETTERS)),
    told = (name) => parts.get(kept + name);
  const b = row(told("b") ?? ""),
    a = (told("a") ?? "").split(";").map(row),
    follows = told("c") === null,
    c = follows ? b.map(() => "") : row(told("c"));
  const s = b.length;
  if (s > MOST || a.length !== s || c.length !== s || a.some((row) => row.length !== s)) return null;
  return { a, b, c, follows };
}
