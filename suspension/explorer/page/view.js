// The view: one scene, its panels, the words above them and what one can do with them. What one
// moves is a model with get, set, on, off and save_changes: anywidget's, or that of a built page.

import { bindControls } from "./controls.js";
import { makeFrame } from "./dom.js";
import { makeGrab } from "./grab.js";
import { readModel } from "./model.js";
import { makePainter } from "./painter.js";
import { makePlayer } from "./player.js";
import { addProbes } from "./probe.js";
import { momentToShow } from "./scene.js";
import { makeShown } from "./shown.js";
import { makeSpeaker } from "./speaker.js";
import { changesOf, guarded, runOf, SETTINGS, settingsOf } from "./state.js";
import { makeTools } from "./tools.js";

/**
 * Draw the explorer into `el` and join the controls of its box; what comes back are handles for
 * those who show it.
 */
export function render(anyModel, el) {
  const model = guarded(anyModel),
    facts = model.get("facts"),
    data = readModel(facts, model.get("tables")),
    initial = settingsOf(model);
  const frame = makeFrame(el, facts, model.get("view")),
    shown = makeShown(data, model);

  const set = (changes) => {
    for (const [name, value] of Object.entries(changes)) model.set(name, value);
    model.save_changes();
  };
  /** Set many things at once; a time of null means: where it is worth looking. */
  const apply = ({ time, pin, ...others }) => {
    set(changesOf({ ...others, pin: pin && { ...initial, ...pin } }, data));
    if (pin === null) set({ pin: {} });
    if (time === undefined) return;
    if (time === null || time === initial.time) player.refresh();
    set({ time: time ?? momentToShow(shown.scene(), model.get("motion")) });
  };
  const painter = makePainter(frame, facts.panels, shown, (options, isNew) => {
    if (isNew || facts.lanes) speaker.speak(options, painter.panels);
    player.show(options);
  });
  const speaker = makeSpeaker(frame, data, shown),
    player = makePlayer(frame, facts, model, shown, {
      set,
      schedule: painter.schedule,
      settled: () => speaker.announceLater(player.isPlaying),
    });
  const announceLater = () => speaker.announceLater(player.isPlaying);
  const change = () => {
    shown.looks++;
    painter.change();
  };
  makeGrab(painter, shown, ({ time, ...others }) => {
    player.stop();
    if (Object.keys(others).length) apply({ ...others, time });
    else set({ time });
  });
  const run = runOf(initial);
  const tools = makeTools(frame, data, model, shown, speaker, painter, {
    set,
    apply,
    initial,
    run,
    stop: player.stop,
  });

  const listeners = {
    time() {
      player.giveWay();
      painter.schedule();
      if (!player.isPlaying()) announceLater();
    },
    view() {
      tools.view();
      announceLater();
    },
    pace() {
      painter.schedule();
      announceLater();
    },
  };
  for (const name of ["motion", "mapped", "pin"]) {
    listeners[name] = () => {
      tools[name]();
      change();
      announceLater();
    };
  }
  for (const name of SETTINGS) {
    listeners[name] = () => {
      shown.forget();
      painter.change();
      announceLater();
    };
  }
  for (const [name, listener] of Object.entries(listeners)) model.on(`change:${name}`, listener);
  const unbind = bindControls(frame.box, model);
  addProbes(frame.root, shown, painter);
  return {
    apply,
    initial,
    run,
    box: frame.box,
    settings: () => settingsOf(model),
    restart: tools.restart,
    onSettled: speaker.onSettled,
    destroy() {
      for (const [name, listener] of Object.entries(listeners)) model.off(`change:${name}`, listener);
      for (const part of [tools, painter, speaker, player]) part.destroy();
      unbind();
    },
  };
}
