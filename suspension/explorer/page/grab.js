// Things in the pictures that one can take hold of: each panel says what is where, and what a move does.
// A mouse holds at once; a finger when it taps, or pulls sideways, for else it scrolls the page.

import { isPull } from "./touch.js";

export function makeGrab(painter, shown, move) {
  for (const panel of painter.panels) {
    const { canvas } = panel,
      at = ({ clientX, clientY }) => {
        const { left, top } = canvas.getBoundingClientRect();
        return [clientX - left, clientY - top].map((way) => way / painter.zoom);
      };
    let hold = null,
      touched = null; // what a finger is on, and where it came down
    const take = (found, { pointerId }) => {
      hold = found;
      canvas.setPointerCapture(pointerId);
      canvas.style.cursor = hold.cursor;
      if (hold.holds) shown.held = panel.name;
    };
    canvas.addEventListener("pointerdown", (event) => {
      touched = null;
      if (!event.isPrimary) return release(); // two fingers enlarge the page
      if (event.button || !shown.isComputed()) return;
      const found = panel.grab(...at(event), shown.options());
      if (!found) return;
      if (event.pointerType === "touch") {
        touched = { found, x: event.clientX, y: event.clientY };
        return;
      }
      take(found, event);
      if (hold.at) move(hold.at);
    });
    canvas.addEventListener("click", () => {
      if (touched?.found.at) move(touched.found.at);
      touched = null;
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!event.isPrimary) return;
      if (touched && isPull(event.clientX - touched.x, event.clientY - touched.y)) {
        take(touched.found, event);
        touched = null;
      }
      if (hold) return move(hold.to(...at(event)));
      if (shown.isComputed() && event.pointerType === "mouse")
        canvas.style.cursor =
          panel.grab(...at(event), shown.options())?.cursor.replace("grabbing", "grab") ?? "";
    });
    function release() {
      if (!hold) return;
      hold = null;
      canvas.style.cursor = "";
      if (shown.held) {
        shown.held = null;
        painter.change();
      } else painter.schedule();
    }
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
      canvas.addEventListener(name, release);
    canvas.addEventListener("pointercancel", () => (touched = null));
  }
}
