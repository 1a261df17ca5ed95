// Native sliders, numbers and buttons, joined to a model. Python wrote them into the page.

import { clamp, plain } from "./pen.js";
import { readNumber } from "./state.js";
import { HANDLE, tameSliders } from "./touch.js";

export const UNITS = { dt: 1000, height: 1000, sigma: 1000 }; // a number's units in one of the model's
const SNAP = 0.008; // of a slider, within which it takes the robot's own value
const STRIDE = 0.01; // of a slider, for an arrow key

/** From a value to a place on the slider, 0 to 1, and back. */
export function makeScale([low, high, logarithmic]) {
  const ratio = Math.log(high / low);
  return logarithmic
    ? { toPlace: (value) => Math.log(value / low) / ratio, toValue: (place) => low * Math.exp(place * ratio) }
    : { toPlace: (value) => (value - low) / (high - low), toValue: (place) => low + place * (high - low) };
}

/** A value in three digits, its slider's ends at most; the robot's own if it is close. */
export function round(value, [low, high], own, scale) {
  if (own !== undefined && Math.abs(scale.toPlace(value) - scale.toPlace(own)) < SNAP) return own;
  return clamp(Number(value.toPrecision(3)), low, high);
}

/** The next value up or down for a key, or null; where there are round steps, page keys go to the next. */
export function nextValue(key, value, range, steps) {
  const scale = makeScale(range),
    [low, high] = range;
  const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 8, PageDown: -8 }[key];
  if (key === "Home") return low;
  if (key === "End") return high;
  if (!way) return null;
  if (steps && Math.abs(way) > 1) {
    const found =
      way > 0
        ? steps.find((step) => step > value * (1 + 1e-9))
        : steps.findLast((step) => step < value * (1 - 1e-9));
    return found ?? (way > 0 ? high : low);
  }
  const place = scale.toPlace(value) + way * STRIDE;
  if (place <= 0) return low;
  if (place >= 1) return high;
  const next = scale.toValue(place);
  const digits = clamp(Number(next.toPrecision(3)), low, high);
  return digits === value ? clamp(next, low, high) : digits;
}

/** Join every control of a box to the model; what comes back parts them. */
export function bindControls(box, model) {
  const facts = model.get("facts"),
    updates = [];
  const release = tameSliders(box);
  const follow = (trait, update) => {
    model.on(`change:${trait}`, update);
    updates.push([`change:${trait}`, update]);
    update();
  };
  for (const control of box.querySelectorAll(".se-control")) bindSlider(control, model, facts, follow);
  for (const choice of box.querySelectorAll(".se-choice[data-trait]")) {
    const { trait } = choice.dataset,
      buttons = [...choice.querySelectorAll("button")];
    const update = () => {
      for (const button of buttons)
        button.setAttribute("aria-pressed", String(Number(button.dataset.index) === model.get(trait)));
    };
    for (const button of buttons)
      button.addEventListener("click", () => set(model, trait, Number(button.dataset.index)));
    follow(trait, update);
  }
  return () => {
    release();
    for (const [event, update] of updates) model.off(event, update);
  };
}

/**
 * What a pointer that has taken the handle does with it: the place follows the pointer without a
 * jump, and comes back to the very value with it. On the bare track the slider's own place counts.
 */
export function makeHold(slider, scale, model, trait) {
  let start = null,
    x = 0;
  const travel = () => slider.getBoundingClientRect().width - HANDLE;
  slider.addEventListener("pointerdown", ({ clientX }) => {
    const value = model.get(trait),
      place = scale.toPlace(value),
      middle = slider.getBoundingClientRect().left + HANDLE / 2 + place * travel();
    start = Math.abs(clientX - middle) <= HANDLE / 2 + 2 ? { x: clientX, value, place } : null;
    x = clientX;
  });
  slider.addEventListener("pointermove", ({ clientX }) => (x = clientX));
  for (const name of ["pointerup", "pointercancel", "keydown"])
    slider.addEventListener(name, () => setTimeout(() => (start = null)));
  /** The value as it was at the start, or null; and the place, 0 to 1. */
  return () => {
    const width = travel();
    if (!start || !(width > 0)) return { place: clamp(Number(slider.value), 0, 1), value: null };
    if (Math.abs(x - start.x) < 1) return start;
    return { place: clamp(start.place + (x - start.x) / width, 0, 1), value: null };
  };
}

function set(model, trait, value) {
  model.set(trait, value);
  model.save_changes();
}

function bindSlider(control, model, facts, follow) {
  const { trait } = control.dataset,
    range = facts.ranges[trait],
    scale = makeScale(range);
  const slider = control.querySelector("input[type=range]"),
    number = control.querySelector("input[type=text]");
  const units = UNITS[trait] ?? 1,
    own = facts.own[trait],
    unit = number.parentElement.textContent.trim();
  const error = control.appendChild(document.createElement("span"));
  error.className = "se-error";
  error.setAttribute("role", "alert");

  const complain = (text) => {
    error.textContent = text;
    number.toggleAttribute("aria-invalid", Boolean(text));
  };
  const update = () => {
    const value = model.get(trait),
      shown = plain(value * units, 12);
    slider.value = scale.toPlace(value);
    control.style.setProperty("--se-at", scale.toPlace(value)); // where only a strip shows it
    slider.setAttribute("aria-valuetext", `${shown} ${unit}${value === own ? ", the robot's own" : ""}`);
    if (document.activeElement !== number) {
      number.value = plain(value * units, 5);
      complain("");
    }
  };
  const held = makeHold(slider, scale, model, trait);
  slider.addEventListener("input", () => {
    const { place, value } = held();
    set(model, trait, value ?? round(scale.toValue(place), range, own, scale));
  });
  slider.addEventListener("keydown", (event) => {
    const next = nextValue(event.key, model.get(trait), range, trait === "dt" ? facts.dts : null);
    if (next === null) return;
    event.preventDefault();
    set(model, trait, next);
  });
  const take = () => {
    const typed = readNumber(number.value),
      [low, high] = range;
    if (typed === null) complain(`A number, please: ${plain(low * units)} to ${plain(high * units)} ${unit}`);
    else if (typed / units < low * (1 - 1e-12) || typed / units > high * (1 + 1e-12)) {
      complain(`Out of range: ${plain(low * units)} to ${plain(high * units)} ${unit}`);
    } else {
      complain("");
      set(model, trait, clamp(typed / units, low, high));
    }
  };
  number.addEventListener("change", take);
  number.addEventListener("keydown", (event) => {
    if (event.key === "Enter") take();
    if (event.key === "Escape") number.blur();
  });
  number.addEventListener("blur", update);
  number.addEventListener("focus", () => number.select());
  if (own !== undefined) control.style.setProperty("--se-own", scale.toPlace(own));
  follow(trait, update);
}
