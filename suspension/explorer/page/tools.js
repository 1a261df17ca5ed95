// The buttons below the pictures: what is drawn, at which speed, beside what; and what one takes away.

import { button, make, write } from "./dom.js";
import { plain } from "./pen.js";
import { numbersOf, SETTINGS } from "./state.js";
import { pythonOf, savePicture, saveTable } from "./take.js";

/** `act` holds what a button may do: set, apply, stop, change; what comes back follows the model. */
export function makeTools(frame, data, model, shown, speaker, painter, act) {
  const { tabs, tools, stage, box } = frame,
    undo = [];
  const follow = {
    view() {
      const view = model.get("view");
      stage.dataset.view = view;
      for (const tab of tabs.children) {
        const own = tab.dataset.view;
        tab.setAttribute("aria-pressed", String(own === view || (view === "robot" && own === "forces")));
      }
    },
    motion() {
      for (const choice of tools.querySelectorAll("[data-motion]"))
        choice.setAttribute("aria-pressed", String(choice.dataset.motion === model.get("motion")));
    },
    destroy() {
      for (const step of undo) step();
    },
  };
  if (data.compact) return follow;
  for (const [view, text] of [
    ["speeds", "Speeds"],
    ["forces", "Forces"],
    ["stability", "Stability"],
  ])
    button(tabs, text, { "data-view": view }).addEventListener("click", () => act.set({ view }));
  const motions = make(tools, "div", "se-choice", { role: "group", "aria-label": "After lift-off" });
  for (const [motion, text] of [
    ["linear", "Linear"],
    ["flying", "Flying"],
  ])
    button(motions, text, { "data-motion": motion }).addEventListener("click", () => act.set({ motion }));
  addPresets();
  const more = make(tools, "div", "se-more", { role: "group", "aria-label": "This picture" });
  const pin = button(more, "Pin to compare", { "aria-pressed": "false" });
  pin.addEventListener("click", () => {
    shown.pinned = shown.pinned ? null : shown.snapshot(speaker.headline());
    pin.setAttribute("aria-pressed", String(Boolean(shown.pinned)));
    write(pin, shown.pinned ? `Unpin ${plain(shown.pinned.v, 3)} m/s` : "Pin to compare");
    act.change();
  });
  const initial = act.initial;
  button(more, "Reset").addEventListener("click", () => {
    if (shown.pinned) pin.click();
    if (shown.mapped) over.click();
    act.stop();
    act.apply(initial);
  });
  const over = button(more, "Map over v and k", { "aria-pressed": "false" });
  over.addEventListener("click", () => {
    shown.mapped = !shown.mapped;
    over.setAttribute("aria-pressed", String(shown.mapped));
    act.change();
  });
  addMenu();
  if (document.fullscreenEnabled) {
    const full = button(more, "Full screen"),
      tell = () => write(full, document.fullscreenElement === box ? "Exit full screen" : "Full screen");
    full.addEventListener("click", () =>
      document.fullscreenElement ? document.exitFullscreen() : box.requestFullscreen(),
    );
    document.addEventListener("fullscreenchange", tell);
    undo.push(() => document.removeEventListener("fullscreenchange", tell));
  }
  follow.view();
  follow.motion();
  return follow;

  function addPresets() {
    const written = box.querySelectorAll("[data-preset]"); // beside the sliders
    if (data.asked.length) {
      const asked = make(tools, "div", "se-presets", { role: "group", "aria-label": "Speeds asked for" });
      for (const v of data.asked)
        button(asked, `${plain(v)} m/s`).addEventListener("click", () => act.apply({ v, time: null }));
    }
    data.presets.forEach(([, settings], i) => {
      written[i].addEventListener("click", () => act.apply({ ...act.initial, time: null, ...settings }));
    });
  }

  function addMenu() {
    const menu = make(more, "details", "se-menu");
    make(menu, "summary", "", {}, "Take away");
    const list = make(menu, "div", "se-list"),
      code = make(list, "pre", "se-python", { tabindex: 0, "aria-label": "These settings in Python" });
    button(list, "Picture (PNG)").addEventListener("click", () =>
      savePicture(frame.canvases, speaker.headline(), painter.colours),
    );
    button(list, "Numbers (CSV)").addEventListener("click", () =>
      saveTable(shown.scene(), model.get("motion")),
    );
    const copy = button(list, "Copy the Python lines");
    copy.addEventListener("click", async () => {
      try {
        await navigator.clipboard.writeText(code.textContent);
        write(copy, "Copied");
      } catch {
        getSelection().selectAllChildren(code);
        write(copy, "Selected: copy it with your keys");
      }
    });
    const fill = () => {
      if (!menu.open) return;
      const settings = numbersOf(model, SETTINGS);
      write(code, pythonOf(data, settings, settings.scheme_index, model.get("motion")));
    };
    menu.addEventListener("toggle", fill);
    menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !menu.open) return;
      menu.open = false;
      menu.querySelector("summary").focus();
    });
    const leave = ({ target }) => menu.contains(target) || (menu.open = false);
    document.addEventListener("pointerdown", leave);
    undo.push(() => document.removeEventListener("pointerdown", leave));
    speaker.onSettled(fill);
    speaker.onSettled(() => write(copy, "Copy the Python lines"));
  }
}
