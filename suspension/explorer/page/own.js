// Your own robot and road: all its numbers as fields and sliders, a road that one draws or pastes, and what
// follows from them: the verdict, the place on the chart of the highest bump, the forces along the way.

import { makeHold, round } from "./controls.js";
import { button, make, write } from "./dom.js";
import { lay, strokeAt } from "./drawing.js";
import { makeHistory } from "./history.js";
import { chartFrame, drawChart, drawForces, drawRoad, placeOf, roadFrame, roadView } from "./own_draw.js";
import { everySpeed, makeScene } from "./own_scene.js";
import {
  columnsOf,
  drawnGround,
  makeAlike,
  NUMBERS,
  pointsOf,
  pythonOf,
  readRoad,
  readState,
  scaleOf,
  smooth,
  startFrom,
  unitOf,
  numberOf,
  whyNoRoad,
  whyNoValue,
  withValue,
} from "./own_state.js";
import {
  groupRows,
  tellChart,
  tellModes,
  tellSpeeds,
  tellStandIn,
  tellVerdict,
  tellWay,
  wheelRows,
} from "./own_words.js";
import { begin, clamp, plain, show } from "./pen.js";
import { readNumber } from "./state.js";
import { addCopy } from "./take.js";
import { coloursOf, onTheme } from "./theme.js";
import { isPull, tameSliders } from "./touch.js";

const AT_ONCE = 3, // ms of the curve over all speeds that are computed with a change
  PORTION = 6, // ms of each portion of what comes later
  BREATH = 25, // ms before the next portion of the curve, for a pull to come between
  BETWEEN = 4, // ms before the next portion later
  REST = 150, // ms without a change, before what takes long begins
  NEAR = 26, // pixels from the vehicle on the chart at which one takes hold of it
  STRIDE = 0.01, // of a slider, for an arrow key
  STOPS = 24, // of the road, for the keys
  SOFT = 3; // times a stroke is smoothed
const FIELDS = {
  m: "Mass m",
  Izz: "Inertia Izz",
  L1: "Rear arm L₁",
  L2: "Front arm L₂",
  k1: "Rear spring k₁",
  k2: "Front spring k₂",
  c1: "Rear damper c₁",
  c2: "Front damper c₂",
  v: "Speed v",
  distance: "Way to drive",
  height: "Bump height h₀",
  sigma: "Bump width σ",
  tall: "Road height",
  long: "Road length",
};
const WAYS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 8, PageDown: -8 }; // of a slider
const PASTED = { m: 1, cm: 100, mm: 1000 };

let count = 0; // of these instruments, for names that elements refer to each other by

/** A list to choose from, with its name before it. */
function choiceIn(parent, name, options) {
  const select = make(make(parent, "label", "", {}, `${name} `), "select", "", { "aria-label": name });
  for (const [value, text] of options) make(select, "option", "", { value }, text);
  return select;
}

export function renderOwn(model, el) {
  const facts = model.get("facts"),
    id = `se-own-${count++}`,
    first = startFrom(0, facts, "mm");
  let good = first, // the state, checked
    raw = null, // what it was read from
    scene = null,
    view = null, // of the road, held while one draws
    job = null,
    timer = 0,
    pen = null, // where the keys are on the road
    [colours, scheduled, cost] = [null, 0, 0];

  function now() {
    if (model.get("state") !== raw) {
      raw = model.get("state");
      good = readState(raw, facts) ?? good;
    }
    return good;
  }
  function set(state, isDone = true) {
    model.set("state", state);
    if (!isDone) return;
    model.save_changes();
    history.note();
  }

  const root = make(el, "div", "suspension-explorer se-owner"),
    tools = make(root, "div", "se-tools", { role: "group", "aria-label": "This robot" }),
    note = make(root, "p", "se-key"),
    body = make(root, "div", "se-body"),
    sight = make(body, "div", "se-sight"),
    said = make(sight, "p", "se-result", { role: "status" }),
    reading = make(body, "p", "se-words se-reading"),
    roadBox = make(body, "div", "se-view se-view-road"),
    sheet = make(body, "div", "se-sheet"),
    forcesBox = make(body, "div", "se-view se-view-forces"),
    texts = make(body, "div", "se-texts");
  const picture = (parent, draw) => {
    const frame = make(parent, "div", "se-frame");
    return { frame, canvas: make(frame, "canvas", "", { role: "img" }), size: [0, 0], draw };
  };
  const chart = picture(sight, (p) => drawChart(p, scene, facts)),
    road = picture(roadBox, (p) => drawRoad(p, scene, view, pen)),
    forces = picture(forcesBox, (p) => drawForces(p, scene)),
    pictures = [chart, road, forces];

  // ---- the row of tools

  const history = makeHistory(
    now,
    (state) => {
      model.set("state", state);
      model.save_changes();
    },
    JSON.stringify,
    hinder,
  );
  const vehicle = choiceIn(
    tools,
    "Vehicle",
    facts.vehicles.map(({ name }, i) => [i, name]),
  );
  vehicle.addEventListener("change", () => set(startFrom(Number(vehicle.value), facts, now().units)));
  const alike = button(tools, "Both axles alike", { "aria-pressed": "false" });
  alike.addEventListener("click", () => set(now().alike ? { ...now(), alike: false } : makeAlike(now())));
  const units = make(tools, "div", "se-units", { role: "group", "aria-label": "Units" }),
    unitButtons = [
      ["mm", "m/s, mm"],
      ["cm", "km/h, cm"],
    ].map(([name, text]) => {
      const choice = button(units, text, { "data-units": name });
      choice.addEventListener("click", () => set({ ...now(), units: name }));
      return choice;
    });
  const [undo, redo, reset] = ["Undo", "Redo", "Reset"].map((text) => button(tools, text));
  undo.addEventListener("click", history.undo);
  redo.addEventListener("click", history.redo);
  reset.addEventListener("click", () => set(startFrom(now().from, facts, now().units)));
  /** What cannot be done now is disabled, and says why. */
  function hinder() {
    const { from, units, ground } = now(),
      isFirst = JSON.stringify(startFrom(from, facts, units)) === JSON.stringify(now());
    for (const [tool, why] of [
      [undo, history.canUndo() ? "" : "Nothing is changed yet"],
      [redo, history.canRedo() ? "" : "Nothing was taken back"],
      [reset, isFirst ? "Nothing is changed" : ""],
      [softer, ground.kind === "bump" ? "A bump is smooth" : ""],
      [joined, ground.kind === "bump" ? "A bump has no points" : ""],
    ]) {
      if (why && tool === document.activeElement) pad.focus({ preventScroll: true });
      tool.disabled = Boolean(why);
      tool.title = why;
    }
  }

  // ---- the fields

  const fields = {};
  function addField(parent, name) {
    const box = make(parent, "div", "se-field", { "data-name": name }),
      own = `${id}-${name}`;
    make(box, "label", "", { for: own }, FIELDS[name]);
    const number = make(box, "span", "se-number"),
      input = make(number, "input", "", { type: "text", inputmode: "decimal", autocomplete: "off", id: own }),
      unit = make(number, "span", "se-unit"),
      slider = make(box, "input", "", { type: "range", min: 0, max: 1, step: "any" }),
      error = make(box, "span", "se-error", { role: "alert", id: `${own}-error` });
    slider.setAttribute("aria-label", `${FIELDS[name]}, slider`);
    let held = null; // the scale while one drags: its ends must not run away
    const scale = () => held ?? scaleOf(name, now(), facts, scene);
    const value = () => numberOf(name, now(), scene.usual);
    const complain = (words) => {
      write(error, words);
      if (words) {
        input.setAttribute("aria-invalid", "true");
        input.setAttribute("aria-describedby", error.id);
      } else {
        input.removeAttribute("aria-invalid");
        input.removeAttribute("aria-describedby");
      }
    };
    const put = (x, isDone) => {
      const why = whyNoValue(now(), name, x, facts);
      complain(why);
      if (why) return false;
      const [low, high] = facts.limits[name];
      set(withValue(now(), name, clamp(x, low, high)), isDone);
      return true;
    };
    const hold = makeHold(
      slider,
      { toPlace: (x) => scale().toPlace(x), toValue: (x) => scale().toValue(x) },
      { get: value },
      name,
    );
    slider.addEventListener("pointerdown", () => (held = scaleOf(name, now(), facts, scene)));
    slider.addEventListener("input", () => {
      const { place, value: same } = hold(),
        [low, high] = facts.limits[name];
      put(same ?? round(scale().toValue(place), [low, high], ownOf(name), scale()), false);
    });
    const end = () => {
      held = null;
      complain("");
      set(now());
      update();
    };
    for (const event of ["change", "pointercancel"]) slider.addEventListener(event, end);
    slider.addEventListener("keydown", (event) => {
      const to =
        { Home: 0, End: 1 }[event.key] ?? scale().toPlace(value()) + STRIDE * (WAYS[event.key] ?? Number.NaN);
      if (!Number.isFinite(to)) return;
      event.preventDefault();
      const next = scale().toValue(clamp(to, 0, 1)),
        [low, high] = facts.limits[name];
      put(clamp(Number(next.toPrecision(3)), low, high), true);
    });
    const take = () => {
      const [factor] = unitOf(name, now()),
        typed = readNumber(input.value);
      if (typed !== null && plain(factor * value()) === input.value.trim()) return complain(""); // as it was
      put(typed === null ? null : typed / factor, true);
    };
    input.addEventListener("change", take);
    input.addEventListener("keydown", (event) => {
      if (event.key === "Enter") take();
      if (event.key === "Escape") input.blur();
    });
    input.addEventListener("focus", () => input.select());
    input.addEventListener("blur", () => {
      complain("");
      fields[name].show();
    });
    fields[name] = {
      box,
      /** What is set, into the field and the slider; who types there is left alone. */
      show() {
        const [factor, own] = unitOf(name, now()),
          text = plain(factor * value());
        write(unit, own);
        if (document.activeElement !== input && !error.textContent) input.value = text;
        slider.value = scale().toPlace(value());
        slider.setAttribute("aria-valuetext", `${text} ${own}`);
      },
    };
  }
  const ownOf = (name) => {
    const { robot, bump } = facts.vehicles[now().from];
    return { ...robot, ...bump }[name];
  };
  const group = (title, className = "") => {
    const box = make(sheet, "fieldset", className);
    make(box, "legend", "", {}, title);
    return box;
  };
  const drive = group("Drive"),
    numbers = group("Robot", "se-pairs");
  for (const name of ["v", "distance"]) addField(drive, name);
  for (const name of NUMBERS) addField(numbers, name);
  const ground = group("Road");
  for (const name of ["height", "sigma", "tall", "long"]) addField(ground, name);
  const wayWords = make(drive, "p", "se-key");
  const leaveTouch = tameSliders(sheet);

  // ---- the road: to start from, to smooth, to paste

  const roadTools = make(roadBox, "div", "se-tools", { role: "group", "aria-label": "Road" }),
    start = choiceIn(roadTools, "Take", [
      ["", "another road …"],
      ["bump", "the bump"],
      ...facts.stamps.map(({ name }) => [name, name]),
      ["level", "level, to draw on"],
    ]);
  start.addEventListener("change", () => {
    const state = now(),
      { bump } = facts.vehicles[state.from],
      stamp = facts.stamps.find(({ name }) => name === start.value);
    if (start.value === "bump") set({ ...state, ground: { kind: "bump", ...bump } });
    else if (stamp)
      set({
        ...state,
        ground: {
          ...{ kind: "points", x: stamp.x, h: stamp.h, join: "pchip" },
          ...{ tall: bump.height, long: bump.sigma },
        },
      });
    else if (start.value === "level") {
      const { from, to } = scene.shape;
      set({ ...state, ground: drawnGround(Array(facts.columns).fill(0), to - from) });
    }
    start.value = "";
  });
  const armed = button(roadTools, "Draw with a finger", { "aria-pressed": "false", class: "se-arm" });
  armed.addEventListener("click", () => {
    const isArmed = armed.getAttribute("aria-pressed") !== "true";
    armed.setAttribute("aria-pressed", isArmed);
    pad.classList.toggle("se-armed", isArmed);
  });
  const softer = button(roadTools, "Smooth");
  softer.addEventListener("click", () => redraw((heights) => smooth(heights)));
  const joined = choiceIn(roadTools, "Joined by", [
    ["pchip", "curves"],
    ["linear", "straight lines"],
  ]);
  joined.addEventListener("change", () => {
    const next = { ...now(), ground: { ...now().ground, join: joined.value } },
      why = whyNoRoad(pointsOf(next, facts), facts);
    write(roadError, why);
    if (!why) set(next);
    else joined.value = now().ground.join;
  });
  const roadError = make(roadBox, "p", "se-error", { role: "alert" }),
    roadWords = make(roadBox, "p", "se-words");

  /** The road anew, from the heights of its columns. */
  function redraw(change, isDone = true) {
    const { from, to } = scene.shape,
      next = drawnGround(change(columnsOf(scene.pieces, [from, to], facts.columns)), to - from),
      why = whyNoRoad(next, facts);
    write(roadError, why);
    if (!why) set({ ...now(), ground: next }, isDone);
  }

  const pad = make(road.frame, "div", "se-pad", {
    role: "application",
    tabindex: "0",
    "aria-label":
      "The road, to draw on. The arrow keys left and right go along it, up and down lift and lower it there, with Shift by less; Control+Z takes a step back.",
  });
  let stroke = null; // { points, heights, from, to }: what is drawn, over what was there
  const columnAt = ({ clientX, clientY }) => {
    const { left, top } = road.canvas.getBoundingClientRect(),
      frame = roadFrame(...road.size, view),
      across = (clientX - left - frame.left) / (frame.right - frame.left),
      up = (frame.bottom - (clientY - top)) / (frame.bottom - frame.top),
      x = view.x[0] + across * (view.x[1] - view.x[0]),
      h = view.y[0] + clamp(up, 0, 1) * (view.y[1] - view.y[0]);
    return [((x - stroke.from) / (stroke.to - stroke.from)) * (facts.columns - 1), h];
  };
  function startStroke(event) {
    const { from, to } = scene.shape;
    pad.setPointerCapture(event.pointerId);
    stroke = { points: [], heights: columnsOf(scene.pieces, [from, to], facts.columns), from, to };
    pen = null;
    goOn(event);
  }
  function goOn(event) {
    stroke.points.push(columnAt(event));
    const { points, heights, from, to } = stroke,
      columns = points.map(([column]) => column),
      ends = [Math.floor(Math.min(...columns)) - 1, Math.ceil(Math.max(...columns)) + 1],
      laid = lay(heights, points);
    laid[0] = 0; // the road begins where the robot stands
    const next = drawnGround(smooth(laid, ends, SOFT), to - from),
      why = whyNoRoad(next, facts);
    write(roadError, why);
    if (!why) set({ ...now(), ground: next }, false);
  }
  let touched = null; // where a finger came down that may still scroll
  pad.addEventListener("pointerdown", (event) => {
    if (event.button || stroke) return;
    pad.focus({ preventScroll: true });
    if (event.pointerType === "touch" && armed.getAttribute("aria-pressed") !== "true") touched = event;
    else startStroke(event);
  });
  pad.addEventListener("pointermove", (event) => {
    if (touched && isPull(event.clientX - touched.clientX, event.clientY - touched.clientY)) {
      startStroke(touched);
      touched = null;
    }
    if (stroke) goOn(event);
  });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
    pad.addEventListener(name, () => {
      touched = null;
      if (!stroke) return;
      stroke = null;
      set(now());
      update();
    });

  /** The keys' pen goes along the road, and lifts or lowers it. */
  function movePen(along, up) {
    const { from, to } = scene.shape,
      step = (facts.columns - 1) / STOPS,
      heights = columnsOf(scene.pieces, [from, to], facts.columns),
      stop = clamp((pen?.stop ?? 1) + along, 1, STOPS),
      column = Math.round(stop * step),
      height = heights[column] + (up * (view.y[1] - view.y[0])) / STOPS;
    pen = { stop, x: from + ((to - from) * column) / (facts.columns - 1), h: height };
    if (!up) return update();
    const own = strokeAt(heights, column, height, step);
    redraw((heights) => {
      const laid = lay(heights, own);
      laid[0] = 0;
      return laid;
    });
    pen.h = columnsOf(scene.pieces, [from, to], facts.columns)[column];
    update();
  }
  pad.addEventListener("keydown", (event) => {
    const moves = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] }[event.key];
    if (event.key === "Backspace") history.undo();
    else if (moves && !event.ctrlKey && !event.altKey && !event.metaKey)
      movePen(moves[0], event.shiftKey ? moves[1] / 5 : moves[1]);
    else return;
    event.preventDefault();
  });
  pad.addEventListener("blur", () => {
    pen = null;
    update();
  });
  root.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
    if (event.target.matches("input[type=text], textarea")) return; // what is typed has its own
    event.preventDefault();
    (event.shiftKey ? history.redo : history.undo)();
  });

  const paste = make(roadBox, "details", "se-paste");
  make(paste, "summary", "", {}, "Paste a road");
  const pasteRow = make(paste, "div", "se-tools"),
    chosen = ["x", "h"].map((name) =>
      choiceIn(
        pasteRow,
        `${name} in`,
        Object.keys(PASTED).map((unit) => [unit, unit]),
      ),
    );
  const area = make(make(paste, "label", "", {}, "A place and a height on each line"), "textarea", "", {
    rows: 6,
    spellcheck: "false",
    autocomplete: "off",
    placeholder: "0, 0\n0.2, 0.02\n0.4, 0",
  });
  const pasteError = make(paste, "p", "se-error", { role: "alert", id: `${id}-paste` }),
    pasteTools = make(paste, "div", "se-tools"),
    take = button(pasteTools, "Drive over it"),
    asText = button(pasteTools, "This road as text");
  take.addEventListener("click", () => {
    const factors = chosen.map(({ value }) => PASTED[value]),
      found = readRoad(area.value, factors, facts);
    write(pasteError, found.error ?? "");
    area.toggleAttribute("aria-invalid", Boolean(found.error));
    if (found.error) {
      area.setAttribute("aria-describedby", pasteError.id);
      area.focus();
      return;
    }
    area.removeAttribute("aria-describedby");
    const { x, h } = found;
    set({ ...now(), ground: { ...{ kind: "points", x, h, tall: 1, long: 1 }, join: "pchip" } });
  });
  asText.addEventListener("click", () => {
    const { from, to, points } = scene.shape,
      { columns } = facts,
      x = points?.x ?? Array.from({ length: columns }, (_, i) => from + ((to - from) * i) / (columns - 1)),
      h = points?.h ?? columnsOf(scene.pieces, [from, to], columns),
      [ofX, ofH] = chosen.map(({ value }) => PASTED[value]);
    area.value = x.map((place, i) => `${plain(ofX * (place - x[0]), 7)}, ${plain(ofH * h[i], 7)}`).join("\n");
    write(pasteError, "");
    area.removeAttribute("aria-invalid");
  });

  // ---- the vehicle on the chart: take hold of it, and it changes speed and height

  const spot = ({ clientX, clientY }) => {
    const { left, top } = chart.canvas.getBoundingClientRect();
    return [clientX - left, clientY - top];
  };
  const isNear = (event) => {
    if (!scene || scene.isLevel) return false;
    const [x, y] = spot(event),
      [px, py] = placeOf(scene, chartFrame(...chart.size, scene));
    return Math.hypot(x - px, y - py) < NEAR;
  };
  let grip = null; // where the pointer is beside the vehicle's middle
  // A finger that begins on the vehicle does not scroll; elsewhere it does.
  chart.canvas.addEventListener(
    "touchstart",
    (event) => {
      if (event.touches.length === 1 && isNear(event.touches[0])) event.preventDefault();
    },
    { passive: false },
  );
  chart.canvas.addEventListener("pointerdown", (event) => {
    if (event.button || !isNear(event)) return;
    chart.canvas.setPointerCapture(event.pointerId);
    const [x, y] = spot(event),
      [px, py] = placeOf(scene, chartFrame(...chart.size, scene));
    grip = [x - px, y - py];
  });
  chart.canvas.addEventListener("pointermove", (event) => {
    if (!grip) {
      if (event.pointerType === "mouse") chart.canvas.style.cursor = isNear(event) ? "grab" : "";
      return;
    }
    const frame = chartFrame(...chart.size, scene),
      [x, y] = spot(event),
      digits = (value) => Number(value.toPrecision(3)),
      v = digits(frame.nuAt(x - grip[0]) * scene.unit.v),
      height = digits(frame.etaAt(y - grip[1]) * scene.unit.sag),
      name = scene.isBump ? "height" : "tall";
    let next = now();
    if (!whyNoValue(next, "v", v, facts)) next = withValue(next, "v", v);
    if (!whyNoValue(next, name, height, facts)) next = withValue(next, name, height);
    set(next, false);
  });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
    chart.canvas.addEventListener(name, () => {
      if (!grip) return;
      grip = null;
      chart.canvas.style.cursor = "";
      set(now());
    });

  // ---- what one reads

  const words = {
    speeds: make(texts, "p", ""),
    modes: make(texts, "p", ""),
  };
  const tables = make(texts, "div", "se-tables"),
    tableOf = (caption, heads) => {
      const table = make(tables, "table", "");
      make(table, "caption", "", {}, caption);
      const head = make(make(table, "thead", ""), "tr", "");
      for (const name of heads) make(head, "th", "", { scope: "col" }, name);
      return make(table, "tbody", "");
    },
    wheels = tableOf("Wheels", ["wheel", "load at rest", "least force", "at X"]),
    groups = tableOf("Groups", ["group", "is", "here", "says"]);
  function fill(bodyOf, rows) {
    bodyOf.parentNode.hidden = !rows.length;
    while (bodyOf.rows.length > rows.length) bodyOf.deleteRow(-1);
    rows.forEach((cells, i) => {
      const row = bodyOf.rows[i] ?? make(bodyOf, "tr", "");
      cells.forEach((text, j) => {
        write(row.cells[j] ?? make(row, j ? "td" : "th", "", j ? {} : { scope: "row" }), text);
      });
    });
  }

  const away = make(root, "details", "se-away");
  make(away, "summary", "", {}, "Take away as Python");
  const code = make(away, "pre", "se-python", { tabindex: 0, "aria-label": "All of this in Python" }),
    offer = addCopy(make(away, "div", "se-tools"), code);
  away.addEventListener("toggle", () => tellPython());
  function tellPython() {
    if (!away.open || scene.isTooLong) return;
    code.tabIndex = 0; // whatever the page's theme made of a box that did not scroll
    write(code, pythonOf(now(), facts, scene));
    offer();
  }

  // ---- from the state to what one sees

  function update() {
    const begun = performance.now(),
      state = now();
    if (scene?.state !== state) {
      const before = scene;
      scene = makeScene(facts, state, before);
      if (!stroke || !view) view = roadView(scene);
      if (scene.course !== before?.course) {
        delete root.dataset.settled;
        clearTimeout(timer);
        job = everySpeed(scene.course, facts);
        work(AT_ONCE);
      }
    } else if (!stroke) view = roadView(scene);
    showState(state);
    tell();
    tellPython();
    hinder();
    cost += performance.now() - begun;
    scheduled ||= requestAnimationFrame(paint);
  }

  /** A portion of what needs every speed; the curve first, what takes long when nothing has changed for a while. */
  function work(most) {
    const begun = performance.now();
    while (job && performance.now() - begun < most) {
      const { done, value } = job.next();
      if (done) job = null;
      if (value === "curve") return later(REST);
    }
    later(scene.critical ? BETWEEN : BREATH);
  }
  function later(pause) {
    clearTimeout(timer);
    if (job)
      timer = setTimeout(() => {
        const begun = performance.now();
        work(PORTION);
        after();
        cost += performance.now() - begun;
      }, pause);
    else root.dataset.settled = "";
  }
  function after() {
    tell();
    scheduled ||= requestAnimationFrame(paint);
  }

  function showState(state) {
    const { ground, alike: isAlike, from, units: read } = state,
      isBump = ground.kind === "bump",
      isLevel = scene.isLevel;
    for (const [name, field] of Object.entries(fields)) {
      const isShown =
        { height: isBump, sigma: isBump, tall: !isBump && !isLevel, long: !isBump }[name] ?? true;
      field.box.hidden = !isShown;
      if (isShown) field.show();
    }
    alike.setAttribute("aria-pressed", isAlike);
    for (const choice of unitButtons) choice.setAttribute("aria-pressed", choice.dataset.units === read);
    vehicle.value = String(from);
    joined.value = isBump ? "pchip" : ground.join;
    write(note, facts.vehicles[from].note);
  }

  function tell() {
    const { tone, words: verdict } = tellVerdict(scene);
    sight.dataset.tone = tone;
    write(said, verdict);
    write(reading, tellChart(scene, facts));
    write(words.speeds, tellSpeeds(scene));
    write(words.modes, tellModes(scene));
    write(roadWords, tellStandIn(scene));
    write(wayWords, tellWay(scene));
    fill(wheels, wheelRows(scene));
    fill(groups, groupRows(scene));
    const names = [
      `The highest ${scene.isBump ? "bump" : "multiple of the road"} crossed with contact at every speed, and the vehicle on it. ${tellChart(scene, facts)} ${tellSpeeds(scene)}`,
      `The road, ${show(1000 * Math.abs(scene.shape.height))} mm ${scene.shape.height < 0 ? "deep" : "high"}, and the robot on it. ${verdict}`,
      `The normal forces of both wheels along the way. ${verdict}`,
    ];
    pictures.forEach(({ canvas }, i) => canvas.setAttribute("aria-label", names[i].trim()));
  }

  function paint() {
    const begun = performance.now();
    scheduled = 0;
    colours ??= coloursOf(root);
    for (const { canvas, size, draw } of pictures)
      if (size[0] && size[1]) draw(begin(canvas, ...size, colours));
    root.dispatchEvent(
      new CustomEvent("painted", { bubbles: true, detail: cost + performance.now() - begun }),
    );
    cost = 0;
  }

  const sizes = new ResizeObserver((entries) => {
    for (const { target, contentRect } of entries) {
      const found = pictures.find(({ canvas }) => canvas === target);
      found.size = [contentRect.width, contentRect.height].map(Math.round);
    }
    scheduled ||= requestAnimationFrame(paint);
  });
  for (const { canvas } of pictures) sizes.observe(canvas);
  const leaveTheme = onTheme(() => {
    colours = null;
    paint(); // at once, or paper would get the dark picture
  });
  model.on("change:state", update);
  update();
  history.note();
  return () => {
    model.off("change:state", update);
    clearTimeout(timer);
    sizes.disconnect();
    leaveTheme();
    leaveTouch();
    cancelAnimationFrame(scheduled);
    root.remove();
  };
}
