// A finger that begins on something scrolls the page, unless it pulls clearly sideways.

export const HANDLE = 20; // pixels, as the style sheet draws a slider's
const CLEAR = 10; // pixels sideways, and at least twice as many as up or down

/** Whether a way in pixels is a pull, and no scrolling, no tremor. */
export const isPull = (dx, dy, held = false) =>
  held
    ? Math.abs(dx) > 4 && Math.abs(dx) > Math.abs(dy)
    : Math.abs(dx) > CLEAR && Math.abs(dx) > 2 * Math.abs(dy);

/**
 * Let fingers move the sliders of a box so: their `input` events are held back until a pull, and then
 * tell a place that follows the finger without a jump.
 */
export function tameSliders(box) {
  let touch = null; // the slider under a finger, and where it was

  const start = ({ target, pointerType, isPrimary, clientX, clientY }) => {
    if (!isPrimary) return scroll(); // two fingers enlarge the page
    touch = null;
    if (pointerType !== "touch" || !target.matches("input[type=range]")) return;
    const { left, width } = target.getBoundingClientRect(),
      travel = width - HANDLE,
      shown = target.value,
      ends = [Number(target.min), Number(target.max)],
      place = (shown - ends[0]) / (ends[1] - ends[0]),
      held = Math.abs(clientX - left - HANDLE / 2 - place * travel) < HANDLE;
    touch = {
      slider: target,
      x: clientX,
      y: clientY,
      travel,
      place,
      ends,
      held,
      shown,
      state: "waits",
    };
  };
  const move = ({ pointerType, isPrimary, clientX, clientY }) => {
    if (!touch || pointerType !== "touch" || !isPrimary || touch.state === "scrolls") return;
    const dx = clientX - touch.x;
    if (touch.state === "waits" && !isPull(dx, clientY - touch.y, touch.held)) return;
    touch.state = "pulls";
    const [low, high] = touch.ends,
      place = Math.min(Math.max(touch.place + dx / touch.travel, 0), 1);
    touch.slider.value = low + place * (high - low);
    touch.slider.dispatchEvent(new Event("input", { bubbles: true }));
    touch.shown = touch.slider.value;
  };
  const scroll = () => {
    if (touch) touch.state = "scrolls"; // but the slider hears of the finger until it is lifted
  };
  /** What the browser itself makes of the finger. */
  const undo = (event) => {
    if (event.target !== touch?.slider || !event.isTrusted) return;
    event.stopImmediatePropagation();
    touch.slider.value = touch.shown;
  };
  const end = (event) => {
    const left = touch;
    if (!left) return;
    if (left.state !== "scrolls") event.preventDefault(); // no tap, which a browser would take for a mouse's
    setTimeout(() => touch === left && (touch = null)); // Firefox tells of the finger once more
  };
  const listeners = Object.entries({
    pointerdown: start,
    pointermove: move,
    pointercancel: scroll,
    input: undo,
    touchend: end,
    touchcancel: end,
  });
  const first = (name) => name === "input"; // before the slider's own listeners, the others after them
  for (const [name, listener] of listeners) box.addEventListener(name, listener, first(name));
  return () => {
    for (const [name, listener] of listeners) box.removeEventListener(name, listener, first(name));
  };
}
