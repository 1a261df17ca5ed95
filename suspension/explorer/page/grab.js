// Things in the pictures that one can take hold of: each panel says what is where, and what a move does.

export function makeGrab({ panels, schedule, change }, shown, move) {
  for (const panel of panels) {
    const { canvas } = panel,
      at = ({ clientX, clientY }) => {
        const { left, top } = canvas.getBoundingClientRect();
        return [clientX - left, clientY - top];
      };
    let hold = null;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button || !shown.isComputed()) return;
      hold = panel.grab(...at(event), shown.options());
      if (!hold) return;
      canvas.setPointerCapture(event.pointerId);
      canvas.style.cursor = hold.cursor;
      if (hold.holds) shown.held = panel.name;
      if (hold.at) move(hold.at);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (hold) return move(hold.to(...at(event)));
      if (shown.isComputed() && event.pointerType === "mouse")
        canvas.style.cursor =
          panel.grab(...at(event), shown.options())?.cursor.replace("grabbing", "grab") ?? "";
    });
    const release = () => {
      if (!hold) return;
      hold = null;
      canvas.style.cursor = "";
      if (shown.held) {
        shown.held = null;
        change();
      } else schedule();
    };
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
      canvas.addEventListener(name, release);
  }
}
