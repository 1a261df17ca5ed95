// The view: one scene, its panels, the words above them and what one can do with them. What one
// moves is a model with get, set, on and save_changes: anywidget's, or that of a built page.

import { makeScale } from "./controls.js";
import { makeMap } from "./map.js";
import { judge, readModel } from "./model.js";
import { PANELS } from "./panels.js";
import { begin, clamp, plain, show } from "./pen.js";
import { makeScenes, momentOf, momentToShow } from "./scene.js";
import { settingsOf } from "./state.js";
import { pythonOf, savePicture, saveTable } from "./take.js";
import { CLOSE, describe, describeMoment, describePinned, unit } from "./words.js";

const SECONDS = 8; // one crossing, played
const PAUSE = 700; // ms after the last change, until a screen reader is told
const COLOURS = ["ink", "soft", "line", "ground", "rear", "front", "region", "alarm", "doubt", "paper"];
const NUMBERS = ["v", "dt", "k", "c", "height", "sigma"];
const SETTINGS = [...NUMBERS, "scheme_index"];

function make(parent, tag, name, attributes = {}, text = "") {
  const child = document.createElement(tag);
  if (name) child.className = name;
  for (const [key, value] of Object.entries(attributes)) child.setAttribute(key, value);
  if (text) child.textContent = text;
  return parent.appendChild(child);
}

const button = (parent, text, attributes = {}) =>
  make(parent, "button", "", { type: "button", ...attributes }, text);

/** Change a text without making the page look for new elements. */
function write(element, text) {
  const node = element.firstChild ?? element.appendChild(document.createTextNode(""));
  if (node.data !== text) node.data = text;
}

/** Draw the explorer into `el`; what comes back are handles for a page and for tests. */
export function render(model, el) {
  const facts = model.get("facts"),
    data = readModel(facts, model.get("tables"));
  const sceneAt = makeScenes(data),
    initial = settingsOf(model);
  const root = make(el, "div", facts.compact ? "suspension-explorer se-small" : "suspension-explorer");
  const box = root.closest(".suspension-explorer-box") ?? root;
  const status = make(root, "div", "se-status"),
    headline = make(status, "strong", "se-headline");
  const spoken = make(root, "div", "se-spoken", { role: "status" });
  const stage = make(root, "div", "se-panels", { "data-view": model.get("view") });
  const panels = facts.panels.map((name) => {
    const canvas = make(stage, "canvas", `se-${name}`, { role: "img" });
    return { ...PANELS[name], canvas, cache: document.createElement("canvas"), size: [0, 0] };
  });
  const tabs = make(root, "div", "se-tabs", { role: "group", "aria-label": "Below the robot" });
  const bar = make(root, "div", "se-bar"),
    play = button(bar, "", { class: "se-play" });
  const moment = make(bar, "input", "se-moment", {
    type: "range",
    min: 0,
    max: 1,
    step: "any",
    "aria-label": "Moment",
  });
  const clock = make(bar, "span", "se-clock"),
    tools = make(root, "div", "se-tools");
  const details = make(root, "p", "se-details");
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  let scene = null,
    pinned = null,
    mapped = false,
    map = null,
    held = null,
    frame = 0,
    timer = 0,
    playing = null,
    colours = null;
  let stale = true,
    redraw = true,
    looks = 0; // counts changes of colours and pins
  const settled = [],
    undo = [],
    numbers = () => Object.fromEntries(SETTINGS.map((name) => [name, model.get(name)]));

  const compute = () => {
    if (stale) scene = sceneAt(numbers());
    stale = false;
    return scene;
  };
  const currentMap = () => {
    const { c, height, sigma } = scene.settings,
      of = [c, height, sigma].join();
    if (map?.of !== of) map = { of, picture: makeMap(data, scene.settings) };
    return map.picture;
  };
  const options = () => ({
    now: momentOf(scene, model.get("time")),
    motion: model.get("motion"),
    pinned,
    held,
    scene,
    map: mapped && currentMap(),
  });

  // ---- drawing

  const readColours = () => {
    const style = getComputedStyle(root);
    colours = { font: style.fontFamily };
    for (const name of COLOURS) colours[name] = style.getPropertyValue(`--se-${name}`).trim();
    looks++;
    redraw = true;
  };
  const paint = () => {
    frame = 0;
    compute();
    if (panels.every(({ size }) => !size[0])) return; // not on the page yet; its first size will bring us back
    if (!colours) readColours();
    const shown = options(),
      { now, motion } = shown;
    const apart = scene.flight.events.length > 0 || (motion === "flying" && !(scene.run?.error < CLOSE));
    shown.ghost = apart ? (motion === "flying" ? now.linear : now.flying) : null;
    for (const panel of panels) {
      const [w, h] = panel.size;
      if (!w || !h) continue; // not shown on a phone
      if (redraw && panel.still) {
        const key = [...panel.key(scene, shown), w, h, devicePixelRatio, looks].join();
        if (key !== panel.drawn) panel.still(begin(panel.cache, w, h, colours), scene, shown);
        panel.drawn = key;
      }
      const pen = begin(panel.canvas, w, h, colours);
      if (panel.still) pen.g.drawImage(panel.cache, 0, 0, w, h);
      panel.live?.(pen, scene, shown);
    }
    if (redraw) speak();
    redraw = Boolean(shown.map) && shown.map.work(); // a map grows over several frames
    if (redraw) schedule();
    write(clock, describeMoment(now, motion));
    moment.value = model.get("time");
    moment.setAttribute("aria-valuetext", `t = ${unit(now.t, "s")}`);
    root.dispatchEvent(new Event("painted", { bubbles: true })); // for those who measure
  };
  const schedule = () => (frame ||= requestAnimationFrame(paint));
  const change = () => {
    stale = redraw = true;
    schedule();
    announceLater();
  };

  // ---- words

  const speak = () => {
    const { tone, headline: text, details: more } = describe(scene, model.get("motion"));
    write(headline, text);
    write(details, [...more, ...(pinned ? [pinned.words] : [])].join(" "));
    status.dataset.tone = tone;
    for (const { name, title, canvas } of panels) {
      const label = name === "speeds" && mapped ? "Kept or lost at every speed and stiffness" : title;
      canvas.setAttribute("aria-label", `${label}. ${name === "speeds" ? describeSpeeds() : text}`);
    }
    const onTrack = onSpeedTrack(scene.curve, data);
    if (onTrack.join() === box.dataset.track) return;
    box.dataset.track = onTrack.join();
    box.style.setProperty("--se-bands", onTrack[0]);
    box.style.setProperty("--se-ticks", onTrack[1]);
  };
  const describeSpeeds = () => {
    const { critical, kept } = scene.curve,
      speeds = critical.map((v) => show(v)).join(", ");
    return (
      `Contact is ${kept ? "kept" : "lost"} at the lowest speed` +
      (speeds ? `, and the verdict turns at ${speeds} m/s.` : " and at every other.")
    );
  };
  const announceLater = () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      write(spoken, headline.textContent);
      if (!playing) for (const listener of settled) listener();
    }, PAUSE);
  };

  // ---- what moves the picture

  const set = (changes) => {
    for (const [name, value] of Object.entries(changes)) model.set(name, value);
    model.save_changes();
  };
  /** Set many things at once; a time of null means: where it is worth looking. */
  const apply = ({ scheme, motion, time, ...others }) => {
    const changes = {};
    for (const name of NUMBERS) {
      const value = others[name];
      if (typeof value === "number" && Number.isFinite(value))
        changes[name] = clamp(value, ...data.ranges[name].slice(0, 2));
    }
    const index = data.schemes.findIndex(({ name }) => name.toLowerCase() === String(scheme).toLowerCase());
    if (index >= 0) changes.scheme_index = index;
    if (motion === "linear" || motion === "flying") changes.motion = motion;
    set(changes);
    if (time === null) set({ time: momentToShow(compute(), model.get("motion")) });
    else if (time !== undefined) set({ time: clamp(time, 0, 1) });
  };
  const stop = () => {
    playing = null;
    write(play, calm.matches ? "Step" : "▶\uFE0E Play");
    schedule();
  };
  const advance = (now) => {
    if (!playing || !root.isConnected) return;
    playing.start ??= now - 1000 * SECONDS * playing.time;
    playing.time = Math.min((now - playing.start) / 1000 / SECONDS, 1);
    set({ time: playing.time });
    if (playing.time < 1) requestAnimationFrame(advance);
    else stop();
  };
  play.addEventListener("click", () => {
    const time = model.get("time") < 1 ? model.get("time") : 0; // from the end it starts again
    if (playing) return stop();
    if (calm.matches) return set({ time: Math.min(time + 0.05, 1) });
    playing = { time };
    write(play, "❚❚ Pause");
    requestAnimationFrame(advance);
  });
  moment.addEventListener("input", () => set({ time: Number(moment.value) }));
  moment.addEventListener("keydown", (event) => {
    const way = {
      ArrowRight: 0.005,
      ArrowUp: 0.005,
      ArrowLeft: -0.005,
      ArrowDown: -0.005,
      PageUp: 0.05,
      PageDown: -0.05,
    }[event.key];
    if (!way) return;
    event.preventDefault();
    set({ time: clamp(model.get("time") + way, 0, 1) });
  });

  // ---- grabbing things in the pictures

  for (const panel of panels) {
    const { canvas } = panel,
      at = ({ clientX, clientY }) => {
        const { left, top } = canvas.getBoundingClientRect();
        return [clientX - left, clientY - top];
      };
    let hold = null;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button || !scene) return;
      hold = panel.grab(...at(event), options());
      if (!hold) return;
      canvas.setPointerCapture(event.pointerId);
      canvas.style.cursor = hold.cursor;
      if (hold.holds) held = panel.name;
      if (hold.at) move(hold.at);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (hold) return move(hold.to(...at(event)));
      if (scene && event.pointerType === "mouse")
        canvas.style.cursor = panel.grab(...at(event), options())?.cursor.replace("grabbing", "grab") ?? "";
    });
    const move = ({ time, ...others }) => {
      stopPlaying();
      if (Object.keys(others).length) apply({ ...others, time });
      else set({ time });
    };
    const release = () => {
      if (!hold) return;
      if (held) [held, redraw] = [null, true];
      hold = null;
      canvas.style.cursor = "";
      schedule();
    };
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
      canvas.addEventListener(name, release);
  }
  const stopPlaying = () => playing && stop();

  // ---- tools

  function addTools() {
    if (facts.compact) return;
    for (const [view, text] of [
      ["speeds", "Speeds"],
      ["forces", "Forces"],
      ["stability", "Stability"],
    ]) {
      button(tabs, text, { "data-view": view }).addEventListener("click", () => set({ view }));
    }
    listeners.view();
    const motions = make(tools, "div", "se-choice", { role: "group", "aria-label": "After lift-off" });
    for (const [motion, text] of [
      ["linear", "Linear"],
      ["flying", "Flying"],
    ]) {
      const choice = button(motions, text, {
        "data-motion": motion,
        "aria-pressed": String(model.get("motion") === motion),
      });
      choice.addEventListener("click", () => set({ motion }));
    }
    const presets = make(tools, "div", "se-presets", {
      role: "group",
      "aria-label": "Speeds of the problem set",
    });
    for (const v of data.asked)
      button(presets, `${plain(v)} m/s`).addEventListener("click", () => apply({ v, time: null }));
    const written = box.querySelectorAll("[data-preset]"); // in a built page
    data.presets.forEach(([text, settings], i) => {
      const choice = written[i] ?? button(presets, text);
      choice.addEventListener("click", () => apply({ ...initial, time: null, ...settings }));
    });
    const more = make(tools, "div", "se-more", { role: "group", "aria-label": "This picture" });
    const pin = button(more, "Pin to compare", { "aria-pressed": "false" });
    pin.addEventListener("click", () => {
      pinned = pinned ? null : snapshot();
      pin.setAttribute("aria-pressed", String(Boolean(pinned)));
      write(pin, pinned ? `Unpin ${plain(pinned.v, 3)} m/s` : "Pin to compare");
      looks++;
      redraw = true;
      schedule();
    });
    button(more, "Reset").addEventListener("click", () => {
      if (pinned) pin.click();
      if (mapped) over.click();
      stopPlaying();
      apply(initial);
    });
    const over = button(more, "Map over v and k", { "aria-pressed": "false" });
    over.addEventListener("click", () => {
      mapped = !mapped;
      over.setAttribute("aria-pressed", String(mapped));
      looks++;
      redraw = true;
      schedule();
    });
    const menu = make(more, "details", "se-menu");
    make(menu, "summary", "", {}, "Take away");
    const list = make(menu, "div", "se-list"),
      code = make(list, "pre", "se-python", { tabindex: 0, "aria-label": "These settings in Python" });
    button(list, "Picture (PNG)").addEventListener("click", () =>
      savePicture(
        panels.map(({ canvas }) => canvas),
        headline.textContent,
        colours,
      ),
    );
    button(list, "Numbers (CSV)").addEventListener("click", () => saveTable(scene, model.get("motion")));
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
    const fill = () =>
      menu.open && write(code, pythonOf(data, numbers(), model.get("scheme_index"), model.get("motion")));
    menu.addEventListener("toggle", fill);
    menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !menu.open) return;
      menu.open = false;
      menu.querySelector("summary").focus();
    });
    const leave = ({ target }) => menu.contains(target) || (menu.open = false);
    document.addEventListener("pointerdown", leave);
    undo.push(() => document.removeEventListener("pointerdown", leave));
    settled.push(fill, () => write(copy, "Copy the Python lines"));
    if (document.fullscreenEnabled) {
      const full = button(more, "Full screen");
      full.addEventListener("click", () =>
        document.fullscreenElement ? document.exitFullscreen() : box.requestFullscreen(),
      );
    }
  }
  /** What is kept of a run to compare others with. */
  function snapshot() {
    const { run, flight, v, curve, robot, dt, scheme, settings } = scene,
      motion = run ? model.get("motion") : "flying",
      kept = motion === "flying" ? flight : run;
    return {
      v,
      dt: kept.dt,
      verdict: judge(kept),
      words: describePinned(settings, scheme, motion, headline.textContent),
      N: kept.N.map((N) => N.slice(0, kept.J + 1)),
      least: curve.least.map((N) => N.slice()),
      z: robot.modes.map(([re, im]) => [re * dt, im * dt]),
    };
  }

  // ---- following the model, the theme and the size

  const listeners = {
    time() {
      if (playing && model.get("time") !== playing.time) stop(); // somebody took the slider
      schedule();
      if (!playing) announceLater();
    },
    view() {
      const view = model.get("view");
      stage.dataset.view = view;
      for (const tab of tabs.children) {
        tab.setAttribute(
          "aria-pressed",
          String(tab.dataset.view === view || (view === "robot" && tab.dataset.view === "forces")),
        );
      }
    },
    motion() {
      redraw = true;
      for (const choice of tools.querySelectorAll("[data-motion]")) {
        choice.setAttribute("aria-pressed", String(choice.dataset.motion === model.get("motion")));
      }
      schedule();
      announceLater();
    },
  };
  addTools();
  for (const name of SETTINGS) listeners[name] = change;
  for (const [name, listener] of Object.entries(listeners)) model.on(`change:${name}`, listener);
  const recolour = () => {
    readColours();
    paint(); // at once, or paper would get the dark picture
  };
  const themes = new MutationObserver(recolour);
  themes.observe(document.documentElement, { attributeFilter: ["data-theme"] });
  themes.observe(document.body, { attributeFilter: ["data-jp-theme-light"] });
  const contrasts = matchMedia("(forced-colors: active)");
  contrasts.addEventListener("change", recolour);
  const sizes = new ResizeObserver((entries) => {
    for (const { target, contentRect } of entries) {
      const panel = panels.find(({ canvas }) => canvas === target);
      panel.size = [Math.round(contentRect.width), Math.round(contentRect.height)];
    }
    redraw = true;
    // What is below the window when the page opens lets the others go first.
    if (!scene && root.getBoundingClientRect().top > innerHeight) setTimeout(schedule, 100);
    else schedule();
  });
  for (const { canvas } of panels) sizes.observe(canvas);
  calm.addEventListener("change", stop);
  stop();
  root.trajectory = () => {
    // for those who compare: everything shown, in plain arrays
    const { run, flight, curve, truth, settings } = compute(),
      copy = (rows, J) => rows.map((row) => [...row.subarray(0, J + 1)]);
    return {
      ...settings,
      W: run && copy(run.W, run.J),
      N: run && copy(run.N, run.J),
      verdict: run?.verdict,
      exact: truth.verdict,
      speeds: [...curve.speeds],
      least: curve.least.map((N) => [...N]),
      critical: curve.critical,
      events: flight.events,
      highest: flight.gaps.map((gap) => gap.subarray(0, flight.J + 1).reduce((a, b) => Math.max(a, b), 0)),
      flightStep: flight.dt,
    };
  };
  root.modesAt = () => {
    // where the modes are drawn, in fractions of the panel, for tests that drag
    const {
      frame,
      size: [w, h],
    } = panels.find(({ name }) => name === "stability");
    return compute().robot.modes.map(([re, im]) => [
      frame.px(re * scene.dt) / w,
      frame.py(im * scene.dt) / h,
    ]);
  };
  const destroy = () => {
    for (const [name, listener] of Object.entries(listeners)) model.off(`change:${name}`, listener);
    for (const step of undo) step();
    themes.disconnect();
    sizes.disconnect();
    calm.removeEventListener("change", stop);
    contrasts.removeEventListener("change", recolour);
    clearTimeout(timer);
    cancelAnimationFrame(frame);
    playing = null;
  };
  return {
    apply,
    destroy,
    settings: () => settingsOf(model),
    onSettled: (listener) => settled.push(listener),
  };
}

/**
 * For the slider of the speed, as backgrounds: kept and lost speeds, and ticks at the critical speeds
 * (above) and the asked ones (below). The handle's middle goes from 10 pixels to 10 before the end.
 */
function onSpeedTrack({ critical, kept }, { ranges, asked }) {
  const { toPlace } = makeScale(ranges.v);
  const along = (v) => `calc(${(100 * toPlace(v)).toFixed(3)}% + ${(10 - 20 * toPlace(v)).toFixed(2)}px)`;
  const edges = ["0%", ...critical.map(along), "100%"];
  const bands = edges
    .slice(1)
    .map((edge, i) => `var(--se-${kept === (i % 2 === 0) ? "region" : "alarm"}) ${edges[i]} ${edge}`);
  // A background's percentages leave out its own width, 2 pixels.
  const tick = (v, end) =>
    `linear-gradient(var(--se-soft) 0 0) calc(${(100 * toPlace(v)).toFixed(3)}% + ${(9 - 18 * toPlace(v)).toFixed(2)}px) ${end} / 2px 7px no-repeat`;
  const ticks = [...critical.map((v) => tick(v, "top")), ...asked.map((v) => tick(v, "bottom"))];
  return [`linear-gradient(to right, ${bands.join(", ")})`, ticks.join(", ")];
}
