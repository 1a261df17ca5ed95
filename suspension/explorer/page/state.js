// Settings as text: for an address, and to read what somebody typed.

import { clamp } from "./pen.js";

const SLIDERS = ["v", "dt", "k", "c", "height", "sigma"];
const NUMBERS = [...SLIDERS, "time"];
export const SETTINGS = [...SLIDERS, "scheme_index"]; // what a run depends on

export const numbersOf = (model, names) => Object.fromEntries(names.map((name) => [name, model.get(name)]));

/**
 * A model whose numbers are numbers within their ranges, whatever it is given: what is none changes
 * nothing, and where somebody else has put one the last good one stands.
 */
export function guarded(model) {
  const { ranges, schemes } = model.get("facts"),
    good = new Map();
  const ends = (name) => (name === "time" ? [0, 1] : ranges[name]);
  const check = (name, value) => {
    if (name === "scheme_index") return schemes[value] ? value : undefined;
    if (!NUMBERS.includes(name)) return value;
    return typeof value === "number" && Number.isFinite(value)
      ? clamp(value, ...ends(name).slice(0, 2))
      : undefined;
  };
  return {
    get(name) {
      const value = check(name, model.get(name));
      if (value === undefined)
        return good.has(name) ? good.get(name) : name === "scheme_index" ? 0 : ends(name)[0];
      good.set(name, value);
      return value;
    },
    set(name, value) {
      const checked = check(name, value);
      if (checked !== undefined) model.set(name, checked);
    },
    on: (event, listener) => model.on(event, listener),
    off: (event, listener) => model.off(event, listener),
    save_changes: () => model.save_changes(),
  };
}

/** What of some settings, the scheme by its name, can be set: pairs of a model's names and values. */
export function changesOf({ scheme, motion, ...numbers }, { ranges, schemes }) {
  const changes = {};
  for (const name of SLIDERS) {
    const value = numbers[name];
    if (typeof value === "number" && Number.isFinite(value) && ranges[name])
      changes[name] = clamp(value, ...ranges[name].slice(0, 2));
  }
  const index = schemes.findIndex(({ name }) => name.toLowerCase() === String(scheme).toLowerCase());
  if (index >= 0) changes.scheme_index = index;
  if (motion === "linear" || motion === "flying") changes.motion = motion;
  return changes;
}

/** Everything of a model that can be set, the scheme by its name. */
export function settingsOf(model) {
  const settings = numbersOf(model, NUMBERS);
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
