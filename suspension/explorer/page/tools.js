// The buttons below the pictures: what is drawn, at which speed, beside what; and what one takes away.

import { button, make, write } from "./dom.js";
import { makeHistory } from "./history.js";
import { plain } from "./pen.js";
import { numbersOf, runOf, SETTINGS, settingsOf, writeHash } from "./state.js";
import { addCopy, pythonOf, savePicture, saveTable } from "./take.js";

const KEYS = { undo: "Control+Z", redo: "Control+Shift+Z" };
const press = (button, pressed) => button.setAttribute("aria-pressed", String(pressed));

/** `act` holds what a button may do: set, apply, stop; what comes back follows the model. */
export function makeTools(frame, data, model, shown, speaker, painter, act) {
  const { tabs, tools, stage, box } = frame,
    undo = [];
  const follow = {
    /** Undo leads back to what is set now, and no further. */
    restart: () => history.restart(),
    view() {
      const view = model.get("view");
      stage.dataset.view = view;
      for (const tab of tabs.children) {
        const own = tab.dataset.view;
        tab.setAttribute("aria-pressed", String(own === view || (view === "robot" && own === "forces")));
      }
    },
    mapped: () => over && press(over, model.get("mapped")),
    pin() {
      if (!pin) return;
      const { v } = model.get("pin");
      press(pin, Boolean(v));
      write(pin, v ? `Unpin ${plain(v, 3)} m/s` : "Pin to compare");
    },
    motion() {
      for (const choice of tools.querySelectorAll("[data-motion]"))
        choice.setAttribute("aria-pressed", String(choice.dataset.motion === model.get("motion")));
    },
    destroy() {
      for (const step of undo) step();
    },
  };
  let pin, over;
  const history = addHistory();
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
  pin = button(more, "Pin to compare");
  pin.addEventListener("click", () => {
    act.apply({ pin: model.get("pin").v ? null : runOf(settingsOf(model)) });
  });
  for (const [name, text] of [
    ["undo", "Undo"],
    ["redo", "Redo"],
  ])
    history[`${name}Button`] = button(more, text, { "aria-keyshortcuts": KEYS[name] });
  history.undoButton.addEventListener("click", history.undo);
  history.redoButton.addEventListener("click", history.redo);
  button(more, "Reset").addEventListener("click", () => {
    act.stop();
    act.apply({ ...act.initial, pin: undefined }); // what one compares with stays
  });
  over = button(more, "Map over v and k");
  over.addEventListener("click", () => act.set({ mapped: !model.get("mapped") }));
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
  for (const name of ["view", "motion", "mapped", "pin"]) follow[name]();
  history.note();
  return follow;

  function addPresets() {
    const written = box.querySelectorAll("[data-preset]"); // beside the sliders
    if (data.asked.length) {
      const asked = make(tools, "div", "se-presets", { role: "group", "aria-label": "Speeds asked for" });
      for (const v of data.asked)
        button(asked, `${plain(v)} m/s`).addEventListener("click", () => act.apply({ v, time: null }));
    }
    data.presets.forEach(([, settings], i) => {
      written[i].addEventListener("click", () => act.apply({ ...act.run, time: null, ...settings }));
    });
  }

  /** What a reader does, one thing after another: a gesture begins a new one, or a pause. */
  function addHistory() {
    const made = makeHistory(
      () => settingsOf(model),
      act.apply,
      ({ time, ...others }) => writeHash(others, {}),
      () => {
        made.undoButton?.setAttribute("aria-disabled", String(!made.canUndo()));
        made.redoButton?.setAttribute("aria-disabled", String(!made.canRedo()));
      },
    );
    let typing = null;
    const type = ({ type, target }) => (typing = type === "input" ? target : null);
    const key = (event) => {
      const { target } = event;
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
      if (target === typing) return; // what is typed has its own
      if (target.matches?.("input[type=text]")) frame.stage.focus({ preventScroll: true }); // shows what is set
      event.preventDefault();
      event.stopPropagation();
      if (event.shiftKey) made.redo();
      else made.undo();
    };
    const heard = { keydown: key, pointerdown: made.note, input: type, change: type };
    for (const [name, listener] of Object.entries(heard))
      box.addEventListener(name, listener, { capture: true });
    frame.stage.tabIndex = -1; // so that keys go on coming here from one who has touched a picture
    speaker.onSettled(made.note);
    undo.push(() => {
      for (const [name, listener] of Object.entries(heard))
        box.removeEventListener(name, listener, { capture: true });
    });
    return made;
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
    const offer = addCopy(list, code);
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
    speaker.onSettled(offer);
  }
}
