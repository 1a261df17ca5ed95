// Native sliders, numbers and buttons, joined to a model. Python wrote them into the page.

import { clamp, plain } from "./pen.js";
import { readNumber } from "./state.js";

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

/** The next value up or down for a key, or null: steps go from one round one to the next. */
export function nextValue(key, value, range, steps) {
  const scale = makeScale(range),
    [low, high] = range;
  const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 8, PageDown: -8 }[key];
  if (key === "Home") return low;
  if (key === "End") return high;
  if (!way) return null;
  if (steps) {
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

/** Join every control of a box to the model. */
export function bindControls(box, model) {
  const facts = model.get("facts");
  for (const control of box.querySelectorAll(".se-control")) bindSlider(control, model, facts);
  for (const choice of box.querySelectorAll(".se-choice[data-trait]")) {
    const { trait } = choice.dataset,
      buttons = [...choice.querySelectorAll("button")];
    const update = () => {
      for (const button of buttons)
        button.setAttribute("aria-pressed", String(Number(button.dataset.index) === model.get(trait)));
    };
    for (const button of buttons)
      button.addEventListener("click", () => set(model, trait, Number(button.dataset.index)));
    model.on(`change:${trait}`, update);
    update();
  }
}

function set(model, trait, value) {
  model.set(trait, value);
  model.save_changes();
}

function bindSlider(control, model, facts) {
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
    slider.setAttribute("aria-valuetext", `${shown} ${unit}${value === own ? ", the robot's own" : ""}`);
    if (document.activeElement !== number) {
      number.value = plain(value * units, 5);
      complain("");
    }
  };
  slider.addEventListener("input", () =>
    set(model, trait, round(scale.toValue(Number(slider.value)), range, own, scale)),
  );
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
  model.on(`change:${trait}`, update);
  if (own !== undefined) control.style.setProperty("--se-own", scale.toPlace(own));
  update();
}
