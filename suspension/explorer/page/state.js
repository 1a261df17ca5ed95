// Settings as text: for an address, and to read what somebody typed.

import { clamp } from "./pen.js";

const SLIDERS = ["v", "dt", "k", "c", "height", "sigma"];
const NUMBERS = [...SLIDERS, "time"];
const CHOICES = {
  motion: ["linear", "flying"],
  view: ["forces", "stability", "robot", "speeds"],
  pace: ["fit", "same"],
  mapped: [false, true],
};
const GRAIN = 1e6; // moments in a crossing: few enough that an address says which
const PIN = "pin."; // before the names of a pinned run's settings
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
    if (CHOICES[name]) return CHOICES[name].includes(value) ? value : undefined;
    if (!NUMBERS.includes(name)) return value;
    return typeof value === "number" && Number.isFinite(value)
      ? clamp(value, ...ends(name).slice(0, 2))
      : undefined;
  };
  return {
    get(name) {
      const value = check(name, model.get(name));
      if (value === undefined)
        return good.get(name) ?? (name === "scheme_index" ? 0 : (CHOICES[name] ?? ends(name))[0]);
      good.set(name, value);
      return value;
    },
    set(name, value) {
      const checked = check(name, value);
      if (checked === undefined) return;
      model.set(name, name === "time" ? Math.round(GRAIN * checked) / GRAIN : checked);
    },
    on: (event, listener) => model.on(event, listener),
    off: (event, listener) => model.off(event, listener),
    save_changes: () => model.save_changes(),
  };
}

/** What of some settings, the scheme by its name, can be set: pairs of a model's names and values. */
export function changesOf({ scheme, pin, ...others }, facts) {
  const changes = {};
  for (const name of SLIDERS) {
    const value = others[name],
      range = facts.ranges[name];
    if (typeof value === "number" && Number.isFinite(value) && range)
      changes[name] = clamp(value, ...range.slice(0, 2));
  }
  const index = facts.schemes.findIndex(({ name }) => name.toLowerCase() === String(scheme).toLowerCase());
  if (index >= 0) changes.scheme_index = index;
  for (const [name, allowed] of Object.entries(CHOICES)) {
    if (allowed.includes(others[name])) changes[name] = others[name];
  }
  if (pin !== undefined) changes.pin = pin ? changesOf(runOf(pin), facts) : {};
  return changes;
}

/** Everything of a model that can be set, schemes by their names; `pin` is null or a run's settings. */
export function settingsOf(model) {
  const { schemes } = model.get("facts"),
    pin = model.get("pin");
  const settings = numbersOf(model, [...NUMBERS, ...Object.keys(CHOICES)]);
  settings.scheme = schemes[model.get("scheme_index")].name;
  settings.pin = pin?.v ? runOf({ ...pin, scheme: schemes[pin.scheme_index].name }) : null;
  return settings;
}

/** What of some settings makes a run: not how one looks at it. */
export const runOf = (settings) =>
  Object.fromEntries([...SLIDERS, "scheme", "motion"].map((name) => [name, settings[name]]));

/** "v=5&scheme=RK4": what differs from the beginning. The index-th explorer of a page says so. */
export function writeHash({ pin, ...settings }, initial, index = 0) {
  const parts = new URLSearchParams();
  if (index) parts.set("on", index + 1);
  for (const [name, value] of Object.entries(settings)) {
    if (value !== initial[name]) parts.set(name, String(value));
  }
  for (const [name, value] of Object.entries(pin ?? {})) {
    if (name === "v" || value !== initial[name]) parts.set(PIN + name, value);
  }
  const changed = [...parts.keys()].some((name) => name !== "on");
  return changed ? parts.toString() : "";
}

/** [index, settings] of a text that `writeHash`, or an author, wrote; unknown names are left out. */
export function readHash(text) {
  const parts = new URLSearchParams(text),
    settings = {};
  for (const [full, value] of parts) {
    const ofPin = full.startsWith(PIN),
      name = ofPin ? full.slice(PIN.length) : full,
      read = readSetting(name, value);
    if (read === undefined) continue;
    if (ofPin) settings.pin = { ...settings.pin, [name]: read };
    else settings[name] = read;
  }
  return [Math.max(0, (Number(parts.get("on")) || 1) - 1), settings];
}

function readSetting(name, text) {
  if (NUMBERS.includes(name)) return readNumber(text) ?? undefined;
  if (name === "scheme") return text;
  if (!Object.hasOwn(CHOICES, name)) return undefined;
  return CHOICES[name].find((choice) => String(choice) === text);
}

/** A number with a decimal point or comma, a true or a typed minus; null if it is none. */
export function readNumber(text) {
  const plain = text.trim().replace(/\s/g, "").replace("−", "-").replace(",", ".");
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain)) return null;
  const number = Number(plain);
  return Number.isFinite(number) ? number : null;
}
