// Run by Node's test runner: a finger on a slider, with what browsers tell of it.

import assert from "node:assert/strict";
import { test } from "node:test";
import { HANDLE, tameSliders } from "../page/touch.js";

const LONG = 200; // pixels that a handle can go

/** A slider from −5 to 5, at a place from 0 to 1 of its way, under fingers that one moves. */
function makeSlider(place) {
  const listeners = {},
    heard = [];
  const slider = {
    value: String(10 * place - 5),
    min: "-5",
    max: "5",
    matches: () => true,
    getBoundingClientRect: () => ({ left: 0, width: LONG + HANDLE }),
    dispatchEvent: () => heard.push(at()),
  };
  const at = () => (Number(slider.value) + 5) / 10;
  const box = {
    addEventListener: (name, listener) => (listeners[name] = listener),
    removeEventListener() {},
  };
  tameSliders(box);
  const prevented = [];
  const tell = (name, more = {}) =>
    listeners[name]({
      target: slider,
      pointerType: "touch",
      isPrimary: true,
      isTrusted: true,
      preventDefault: () => prevented.push(name),
      stopImmediatePropagation() {},
      ...more,
    });
  /** What the browser itself makes of the finger: it jumps to it. */
  const jump = (x) => {
    slider.value = String((10 * x) / LONG - 5);
    tell("input");
  };
  return { at, heard, prevented, tell, jump };
}

const later = () => new Promise((done) => setTimeout(done, 5));

test("a slider goes the finger's way, and stays where it was left", async () => {
  const { at, heard, prevented, tell, jump } = makeSlider(0.2);
  tell("pointerdown", { clientX: 150, clientY: 0 });
  jump(150);
  for (const x of [160, 180, 190]) {
    tell("pointermove", { clientX: x, clientY: 2 });
    jump(x);
  }
  tell("touchend");
  jump(190); // as Firefox does, after all
  assert.ok(Math.abs(at() - 0.4) < 1e-9, at());
  assert.ok(heard.every((place) => place < 0.41) && heard.length === 2);
  assert.deepEqual(prevented, ["touchend"]);
  await later();
  jump(100); // no finger any more: a key, or a mouse
  assert.equal(at(), 0.5);
});

test("a finger that goes up or down, taps, or is joined by another sets nothing", () => {
  for (const moves of [[[153, 40]], [], [[150, 0, false]]]) {
    const { at, heard, tell, jump } = makeSlider(0.2);
    tell("pointerdown", { clientX: 150, clientY: 0 });
    jump(150);
    for (const [clientX, clientY, isPrimary = true] of moves) {
      if (!isPrimary) tell("pointerdown", { clientX: 60, clientY: 0, isPrimary });
      tell("pointermove", { clientX: clientX + (isPrimary ? 0 : 60), clientY });
      jump(clientX);
    }
    tell("touchend");
    jump(150);
    assert.deepEqual([at(), heard], [0.2, []]);
  }
});
