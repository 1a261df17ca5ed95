// What a workshop holds as text for an address, and back.

export const PREFIX = "#workshop:";
const MOST = 6; // stages
const LETTERS = 40; // of an entry

/** "#workshop:a=0_1/2&b=1/2_1/2&c=…&v=1.2&dt=0.02": entries by "_", rows by ";". */
export function writeLink(model) {
  const { a, b, c, follows } = model.get("tableau"),
    row = (entries) => entries.join("_");
  const parts = new URLSearchParams({ a: a.map(row).join(";"), b: row(b) });
  if (!follows) parts.set("c", row(c));
  for (const name of ["v", "dt"]) parts.set(name, String(Number(model.get(name).toPrecision(6))));
  return PREFIX + parts.toString();
}

/** What of a model an address sets, or null if it is none of a workshop or no table. */
export function readLink(hash) {
  if (!hash.startsWith(PREFIX)) return null;
  const parts = new URLSearchParams(hash.slice(PREFIX.length)),
    row = (text) => text.split("_").map((entry) => entry.slice(0, LETTERS));
  const b = row(parts.get("b") ?? ""),
    a = (parts.get("a") ?? "").split(";").map(row),
    c = parts.has("c") ? row(parts.get("c")) : b.map(() => "");
  const s = b.length;
  if (s > MOST || a.length !== s || c.length !== s || a.some((row) => row.length !== s)) return null;
  const found = { tableau: { a, b, c, follows: !parts.has("c") } };
  for (const name of ["v", "dt"]) {
    const value = Number.parseFloat(parts.get(name));
    if (Number.isFinite(value)) found[name] = value;
  }
  return found;
}
