// Settings as text: for an address, and to read what somebody typed.

export const NUMBERS = ["v", "dt", "k", "c", "height", "sigma", "time"];

/** Everything of a model that can be set, the scheme by its name. */
export function settingsOf(model) {
  const settings = Object.fromEntries(NUMBERS.map((name) => [name, model.get(name)]));
  settings.scheme = model.get("facts").schemes[model.get("scheme_index")].name;
  settings.motion = model.get("motion");
  return settings;
}

/** "v=5&scheme=RK4": what differs from the beginning. The index-th explorer of a page says so. */
export function writeHash(settings, initial, index = 0) {
  const parts = new URLSearchParams();
  if (index) parts.set("on", index + 1);
  for (const [name, value] of Object.entries(settings)) {
    if (value === initial[name]) continue;
    parts.set(name, name === "time" ? String(Math.round(value * 1e4) / 1e4) : String(value));
  }
  const changed = [...parts.keys()].some((name) => name !== "on");
  return changed ? parts.toString() : "";
}

/** [index, settings] of a text that `writeHash`, or an author, wrote; unknown names are left out. */
export function readHash(text) {
  const parts = new URLSearchParams(text),
    settings = {};
  for (const [name, value] of parts) {
    if (NUMBERS.includes(name)) {
      const number = readNumber(value);
      if (number !== null) settings[name] = number;
    } else if (name === "scheme" || name === "motion") settings[name] = value;
  }
  return [Math.max(0, (Number(parts.get("on")) || 1) - 1), settings];
}

/** A number with a decimal point or comma, a true or a typed minus; null if it is none. */
export function readNumber(text) {
  const plain = text.trim().replace(/\s/g, "").replace("−", "-").replace(",", ".");
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain)) return null;
  const number = Number(plain);
  return Number.isFinite(number) ? number : null;
}
