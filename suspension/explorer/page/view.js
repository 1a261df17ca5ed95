// The view: it follows the sliders, puts the run into words, and plays it. It computes no physics.

import { countSteps, difference, judge, lookUp, makeRunner, readTables } from "./model.js";
import { WHEEL, drawForces, drawRobot, drawStability } from "./panels.js";
import { begin, show } from "./pen.js";

const SECONDS = 8; // one crossing, played
const PAUSE = 250; // ms between two changes of the words, so that a screen reader can follow
const STRIDE = 0.02; // an arrow key changes the speed by a factor of 10^0.02, 5 %
const PANELS = { robot: drawRobot, forces: drawForces, stability: drawStability };
const COLOURS = ["ink", "soft", "line", "ground", "rear", "front", "region", "alarm", "paper"];
const SETTINGS = ["v", "k_index", "scheme_index", "dt_index"];

function make(parent, tag, name, attributes = {}) {
  const child = document.createElement(tag);
  child.className = name;
  for (const [key, value] of Object.entries(attributes)) child.setAttribute(key, value);
  return parent.appendChild(child);
}

/** Change a text without making the page look for new elements. */
function write(element, text) {
  const node = element.firstChild ?? element.appendChild(document.createTextNode(""));
  if (node.data !== text) node.data = text;
}

/** All that the panels and the words show at the sliders' present places. */
function makeScene(model, data, runs, last) {
  const [v, k, scheme, i] = SETTINGS.map((name) => model.get(name));
  const { dts, distance } = data, dt = dts[i], fine = dts.length - 1, end = distance / v;
  const robot = data.robot(k), step = data.step(scheme, k, i), J = countSteps(end, dt);
  let { finest, truth } = last ?? {};
  if (last?.v !== v || last?.k !== k) {
    const reach = countSteps(end, dts[fine]), spare = Math.round(dts[0] / dts[fine]);
    finest = runs.finest(robot, data.step(data.finest, k, fine), v, dts[fine], reach + spare);
    truth = judge(finest, reach);
  }
  const run = runs.shown(robot, step, v, dt, J), verdict = judge(run, J);
  const error = difference(run, finest, Math.round(dt / dts[fine]));
  const same = i === fine && scheme === data.finest;
  return { data, v, k, scheme, dt, end, robot, step, run, verdict, finest, truth, error, same };
}

/** Kept or lost; stable or not; how exact; what is shown at the moment. */
function describe({ data, v, scheme, dt, step, verdict, truth, error, same, now }) {
  const unit = (x, name, digits) => `${show(x, digits)}\u00a0${name}`;
  const equals = (name, ...value) => `${name}\u00a0=\u00a0${unit(...value)}`; // on one line
  const method = (i, dt) => `${data.schemes[i].name} at ${equals("Δt", 1000 * dt, "ms")}`;
  const moment = (t, digits) => `${equals("t", t, "s", digits)}, ${equals("X", v * t, "m", digits)}`;
  const place = ({ wheel, t }) => `${WHEEL[wheel]} wheel, ${moment(t)}`;
  const contact = ({ lost }) => `contact ${lost ? "lost" : "kept"}`;
  const most = Math.max(...step.growth), R = `|R| = ${most < 10 ? most.toFixed(5) : show(most, 4)}`;
  const least = `smallest force ${unit(verdict.least, "N")}`;
  const finest = `the finest step (${method(data.finest, data.dts.at(-1))})`;
  const doubt = contact(truth) === contact(verdict) ? "" : `, which says: ${contact(truth)}`;
  const where = verdict.lost ? `${place(verdict.lost)}; ${least}` : `${least}, ${place(verdict)}`;
  return {
    verdict: step.stable ? contact(verdict).replace("c", "C") : "Unstable run, so no verdict",
    place: step.stable ? `: ${where}.` : ` (it says: ${contact(verdict)}, ${where}).`,
    stability: `${method(scheme, dt)} is ` + (step.stable
      ? `stable: no mode grows, the largest ${R}.`
      : `unstable: a mode grows by ${R} every step.`),
    error: same
      ? "No step here is finer."
      : `Forces differ by up to ${unit(error, "N", 2)} from ${finest}${doubt}.`,
    moment: `Shown: ${moment(now.t, 4)}, ` +
      `${equals("N₁", now.N[0], "N")}, ${equals("N₂", now.N[1], "N")}.`,
  };
}

/** What ipywidgets' controls lack: names, values and states for screen readers, a key's stride. */
function helpControls(box, clock) {
  const set = (element, attributes) => {
    for (const [name, value] of Object.entries(attributes)) {
      if (element && element.getAttribute(name) !== value) element.setAttribute(name, value);
    }
  };
  for (const control of box.querySelectorAll(".widget-inline-hbox, .widget-toggle-buttons")) {
    const label = control.querySelector(".widget-label").textContent;
    const readout = control.querySelector(".widget-readout");
    const value = readout?.style.display === "none" ? clock : readout?.textContent;
    const typed = control.classList.contains("se-typed"); // the others' values cannot be edited
    set(control.querySelector("[role=slider]"), { "aria-label": label, "aria-valuetext": value });
    set(readout, typed ? { role: "textbox", "aria-label": label } : { contenteditable: "false" });
    for (const choice of control.querySelectorAll("button")) {
      set(choice.parentElement, { role: "group", "aria-label": label });
      set(choice, { "aria-pressed": String(choice.classList.contains("mod-active")) });
    }
    if (!typed || control.dataset.keys) continue;
    control.dataset.keys = "helped"; // this slider has no steps, so that a typed value is exact
    control.addEventListener("keydown", (event) => {
      const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (!way || event.target === readout) return;
      event.preventDefault();
      event.stopPropagation();
      const slider = control.querySelector(".slider").noUiSlider;
      slider.set(slider.get() + way * STRIDE);
    }, true);
  }
}

/** Take away the still picture that stood here: the nearest one above the view. */
function hideStill(root) {
  for (let node = root.parentElement; node; node = node.parentElement) {
    const picture = node.querySelector(":scope > .suspension-explorer-still");
    if (picture) return void (picture.style.display = "none");
  }
}

function render({ model, el }) {
  const data = readTables(model.get("facts"), model.get("tables"));
  const runs = { finest: makeRunner(data), shown: makeRunner(data) };
  const root = make(el, "div", "suspension-explorer");
  const bar = make(root, "div", "se-bar");
  const button = make(bar, "button", "se-play", { type: "button" });
  const clock = make(bar, "span", "se-clock");
  const words = make(root, "p", "se-words", { role: "status", "aria-live": "polite" });
  const parts = ["verdict", "place", "stability", "error", "moment"].map((name) => {
    if (name !== "place") words.append(" ");
    return [name, make(words, "span", `se-${name}`)];
  });
  const panels = make(root, "div", "se-panels", { "data-view": model.get("view") });
  const canvases = Object.entries(PANELS).map(([name, draw]) =>
    [make(panels, "canvas", `se-${name}`, { role: "img" }), draw]);
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  let scene = null, stale = true, frame = 0, timer = 0, playing = null, drawn = "";

  const update = () => {
    if (stale) scene = makeScene(model, data, runs, scene);
    stale = false;
    scene.now = lookUp(scene.run, ((model.get("time") / data.moments) * scene.end) / scene.dt);
    const pace = SECONDS / scene.end;
    write(clock, `t = ${show(scene.now.t)} s, played ` +
      (pace < 1 ? `${show(1 / pace, 2)} × faster` : `${show(pace, 2)} × slower`) + " than real");
  };
  const speak = () => {
    timer = 0;
    const text = describe(scene);
    if (playing) delete text.moment; // it would never stop talking
    for (const [name, part] of parts) {
      if (name in text) write(part, text[name]);
    }
    words.classList.toggle("se-alarm", Boolean(scene.verdict.lost) || !scene.step.stable);
    [`The robot on the road. ${text.moment ?? "It is moving."}`,
      `Normal forces against time. ${text.verdict}${text.place}`,
      `Stability region and the four modes. ${text.stability}`,
    ].forEach((label, i) => canvases[i][0].setAttribute("aria-label", label));
    const box = root.closest(".suspension-explorer-box");
    if (box) helpControls(box, clock.textContent);
  };
  const paint = () => {
    frame = 0;
    update(); // before the layout is asked for, so that once is enough
    if (!root.clientWidth) return; // not on the page yet; its first size will bring us back
    const style = getComputedStyle(root), colours = { font: style.fontFamily };
    for (const name of COLOURS) colours[name] = style.getPropertyValue(`--se-${name}`);
    const { k, scheme, dt } = scene, { clientWidth, clientHeight } = canvases[2][0];
    const modes = [k, scheme, dt, clientWidth, clientHeight, devicePixelRatio, colours.ink].join();
    for (const [canvas, draw] of canvases) {
      if (draw !== drawStability || modes !== drawn) draw(begin(canvas, colours), scene);
    }
    if (!drawn) speak();
    drawn = modes; // the region does not change with the speed or the moment
    timer ||= setTimeout(speak, PAUSE);
    root.dispatchEvent(new Event("painted")); // for those who measure
  };
  const schedule = () => {
    frame ||= requestAnimationFrame(paint);
  };

  const setTime = (time) => {
    model.set("time", time);
    model.save_changes();
  };
  const stopPlaying = () => {
    playing = null;
    write(button, calm.matches ? "Step" : "▶\uFE0E Play");
    schedule();
  };
  const advance = (now) => {
    if (!playing) return;
    playing.start ??= now - (1000 * SECONDS * playing.time) / data.moments;
    const time = Math.round(((now - playing.start) / 1000 / SECONDS) * data.moments);
    playing.time = Math.min(time, data.moments);
    setTime(playing.time);
    if (playing.time < data.moments) requestAnimationFrame(advance);
    else stopPlaying();
  };
  button.addEventListener("click", () => {
    const time = model.get("time") % data.moments; // from the end it starts again
    if (playing) return stopPlaying();
    if (calm.matches) return setTime(Math.min(time + data.moments / 20, data.moments));
    playing = { time };
    write(button, "❚❚ Pause");
    requestAnimationFrame(advance);
  });

  const changes = {
    time() {
      if (playing && model.get("time") !== playing.time) stopPlaying(); // somebody took the slider
      schedule();
    },
    view() {
      panels.dataset.view = model.get("view");
    },
  };
  for (const name of SETTINGS) {
    changes[name] = () => {
      stale = true;
      if (scene && !frame) update(); // the wait for the next frame is put to use
      schedule();
    };
  }
  for (const [name, change] of Object.entries(changes)) model.on(`change:${name}`, change);
  const themes = new MutationObserver(paint); // at once, or paper would get the dark picture
  themes.observe(document.documentElement, { attributeFilter: ["data-theme"] });
  themes.observe(document.body, { attributeFilter: ["data-jp-theme-light"] });
  const sizes = new ResizeObserver(() => {
    hideStill(root);
    schedule();
  });
  for (const [canvas] of canvases) sizes.observe(canvas);
  calm.addEventListener("change", stopPlaying);
  stopPlaying();
  root.trajectory = () => { // for those who compare: the run as it is shown, in plain arrays
    update();
    const { v, dt, k, scheme, run } = scene;
    return { v, dt, k, scheme, W: run.W.map((w) => [...w]), N: run.N.map((N) => [...N]) };
  };
  return () => {
    for (const [name, change] of Object.entries(changes)) model.off(`change:${name}`, change);
    themes.disconnect();
    sizes.disconnect();
    calm.removeEventListener("change", stopPlaying);
    clearTimeout(timer);
    cancelAnimationFrame(frame);
    playing = null;
  };
}

export default { render };
