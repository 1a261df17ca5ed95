// From a reading to a verdict: readings that one drags, and beside them the ellipse of the two
// coefficients that a linear spring has not, and the critical speeds over the stiffness.

import { drawAxes, drawScales, linearFrame, logFrame } from "./axes.js";
import { mostReadings } from "./chain_link.js";
import { button, make, write } from "./dom.js";
import { makeHistory } from "./history.js";
import { begin, clamp, enlargement, ratioOf, show } from "./pen.js";
import { fitReadings, follow, makeBranch, whyNot } from "./readings.js";
import { coloursOf, onTheme } from "./theme.js";
import {
  coefficientRows,
  speedRows,
  tellLine,
  tellReading,
  tellSpeeds,
  tellStiffness,
  tellVerdicts,
  verdictRows,
} from "./verdict.js";

const NEAR = 24, // pixels from a reading at which one takes hold of it
  PULL = 8, // pixels that a finger goes before it moves one
  INSET = { left: 44, right: 12, top: 24, bottom: 33 }, // as the style sheet has it
  EDGE = 8; // pixels beside the first and the last reading
const round = (force) => Math.round(1e4 * force) / 1e4;

export function renderChain(model, el) {
  const facts = model.get("facts"),
    branches = facts.branches.map(makeBranch),
    { start } = facts,
    first = fitReadings(start, facts),
    largest = Math.max(...start.map(([, force]) => Math.abs(force))),
    most = mostReadings(facts),
    key = Number((largest / 600).toPrecision(1)),
    preload = Number((largest / 20).toPrecision(1));
  const root = make(el, "div", "suspension-explorer se-from-readings"),
    headline = make(root, "p", "se-result", { role: "status" }),
    chosen = make(root, "p", "se-words", { role: "status" }),
    tools = make(root, "div", "se-tools", { role: "group", "aria-label": "Readings" }),
    stage = make(root, "div", "se-stages"),
    frames = ["readings", "ellipse", "map"].map((name) => make(stage, "div", `se-stage se-stage-${name}`)),
    panels = frames.map((frame) => ({ canvas: make(frame, "canvas", "", { role: "img" }), size: [0, 0] })),
    pad = make(frames[0], "div", "se-pad", {
      role: "application",
      tabindex: "0",
      "aria-label":
        "The readings. The arrow keys left and right choose one, up and down move it, with Shift ten times as far; Delete takes it out, Ctrl+Z takes a step back.",
    }),
    legend = make(root, "p", "se-key"),
    texts = make(root, "div", "se-texts"),
    tables = makeTables();
  let zoom = 1, // of the pictures
    at = null, // the chosen reading
    now = follow(model.get("readings"), facts, branches),
    isLarge = false,
    view = null, // the forces in sight
    hold = null, // a reading in hand: where it and the pointer were
    [colours, scheduled] = [null, 0];

  const readings = () => model.get("readings");
  function set(value, isDone = true) {
    model.set("readings", value);
    if (!isDone) return;
    model.save_changes();
    history.note();
  }
  const history = makeHistory(
    readings,
    (value) => {
      at = null;
      model.set("readings", value);
      model.save_changes();
    },
    JSON.stringify,
    hinder,
  );

  // ---- what one can do

  const move = (force, isDone = true) =>
    set(
      readings().map((reading, i) => (i === at ? [reading[0], round(force)] : reading)),
      isDone,
    );
  const choose = (i) => {
    at = i;
    update();
  };
  function remove() {
    if (at === null || without()) return;
    const rest = readings().filter((_, i) => i !== at);
    at = Math.min(at, rest.length - 1);
    set(rest);
  }
  const without = () =>
    whyNot(
      readings().filter((_, i) => i !== at),
      most,
    );
  /** A reading far from the fit, in the widest gap that is nearest to the middle. */
  function add() {
    const x = [...new Set(readings().map(([place]) => place))].sort((a, b) => a - b),
      gaps = x.slice(1).map((to, i) => ({ width: to - x[i], middle: (to + x[i]) / 2 })),
      widest = Math.max(...gaps.map(({ width }) => width)),
      centre = (x[0] + x.at(-1)) / 2;
    const { middle } = gaps
      .filter(({ width }) => width > 0.99 * widest)
      .sort((a, b) => Math.abs(a.middle - centre) - Math.abs(b.middle - centre))[0];
    const force = now.fit.force(middle) + Math.max(8 * now.fit.scatter, 0.15 * largest),
      place = readings().filter(([other]) => other < middle).length;
    at = place;
    set([...readings().slice(0, place), [middle, round(force)], ...readings().slice(place)]);
  }
  const shift = (by) => set(readings().map(([x, force]) => [x, round(force + by)]));

  const actions = [
    ["Undo", history.undo, () => (history.canUndo() ? "" : "Nothing is changed yet")],
    ["Redo", history.redo, () => (history.canRedo() ? "" : "Nothing was taken back")],
    [
      "Delete",
      remove,
      () => (at === null ? "Choose a reading first" : without() && `It stays: ${without()}`),
    ],
    ["Add an outlier", add, () => whyNot([...readings(), [0, 0]], most)],
    [`Preload −${show(preload)} N`, () => shift(-preload), () => ""],
    [`Preload +${show(preload)} N`, () => shift(preload), () => ""],
    ["Reset", reset, () => (JSON.stringify(readings()) === JSON.stringify(start) ? "They are" : "")],
  ].map(([name, act, hindered]) => {
    const tool = button(tools, name);
    tool.addEventListener("click", act);
    return { tool, hindered };
  });
  function reset() {
    at = null;
    set(start);
  }
  const lens = button(tools, "Magnify", { "aria-pressed": "false" });
  lens.addEventListener("click", () => {
    isLarge = !isLarge;
    lens.setAttribute("aria-pressed", isLarge);
    update();
  });
  /** What cannot be done now is disabled, and says why. */
  function hinder() {
    for (const { tool, hindered } of actions) {
      const why = hindered();
      if (why && tool === document.activeElement) pad.focus({ preventScroll: true });
      tool.disabled = Boolean(why);
      tool.title = why;
    }
  }

  // ---- by mouse and finger

  /** What is taken off every force in the magnified picture: the line of the readings as measured. */
  const line = (x) => (isLarge ? first.beta[0] + first.beta[1] * x : 0);
  const spot = ({ clientX, clientY }) => {
    const { left, top } = panels[0].canvas.getBoundingClientRect();
    return [(clientX - left) / zoom, (clientY - top) / zoom];
  };
  const near = (event) => {
    const { px, py } = linearFrame(...panels[0].size, ...view, INSET, EDGE),
      [x, y] = spot(event);
    const away = readings()
      .map(([place, force], i) => ({ i, by: Math.hypot(px(place) - x, py(force - line(place)) - y) }))
      .sort((a, b) => a.by - b.by)[0];
    return away.by < NEAR ? away.i : null;
  };
  // A finger that begins on a reading does not scroll; elsewhere it does.
  pad.addEventListener(
    "touchstart",
    (event) => {
      if (event.touches.length === 1 && near(event.touches[0]) !== null) event.preventDefault();
    },
    { passive: false },
  );
  pad.addEventListener("pointerdown", (event) => {
    if (event.button || hold) return;
    const i = near(event);
    if (i === null) return;
    pad.setPointerCapture(event.pointerId);
    hold = { y: event.clientY, force: readings()[i][1], pulls: event.pointerType !== "touch" };
    pad.focus({ preventScroll: true });
    choose(i);
  });
  pad.addEventListener("pointermove", (event) => {
    if (!hold) {
      if (event.pointerType === "mouse") pad.style.cursor = near(event) === null ? "" : "ns-resize";
      return;
    }
    const down = event.clientY - hold.y;
    hold.pulls ||= Math.abs(down) > PULL;
    if (!hold.pulls) return;
    const { top, bottom } = linearFrame(...panels[0].size, ...view, INSET, EDGE),
      [low, high] = view[1],
      off = line(readings()[at][0]);
    move(clamp(hold.force - (down * (high - low)) / (bottom - top), low + off, high + off), false);
  });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
    pad.addEventListener(name, () => {
      if (!hold) return;
      hold = null;
      set(readings());
      update();
    });

  // ---- by keys

  pad.addEventListener("keydown", (event) => {
    const isUndo = (event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z";
    if (isUndo) (event.shiftKey ? history.redo : history.undo)();
    else if (event.ctrlKey || event.altKey || event.metaKey) return;
    else if (event.key === "Delete" || event.key === "Backspace") remove();
    else if (event.key === "ArrowRight" || event.key === "ArrowLeft")
      choose(at === null ? 0 : clamp(at + (event.key === "ArrowRight" ? 1 : -1), 0, readings().length - 1));
    else if (event.key === "ArrowUp" || event.key === "ArrowDown") {
      if (at === null) choose(0);
      move(readings()[at][1] + (event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? 10 : 1) * key);
    } else return;
    event.preventDefault();
  });
  pad.addEventListener("focus", () => at === null && !hold && pad.matches(":focus-visible") && choose(0));

  // ---- what one sees

  function paint() {
    scheduled = 0;
    colours ??= coloursOf(root);
    const draw = [drawReadings, drawEllipse, drawMap];
    panels.forEach(({ canvas, size: [w, h] }, i) => {
      if (w && h) draw[i](begin(canvas, w, h, colours, ratioOf(zoom)), w, h);
    });
    root.dispatchEvent(new Event("painted", { bubbles: true })); // for those who measure
  }

  /** The stretch of forces in sight; it rests while a reading is in hand. */
  function look() {
    const x = readings().map(([place]) => place),
      seen = readings().map(([place, force]) => force - line(place));
    const [low, high] = [Math.min(0, ...seen), Math.max(0, ...seen)],
      least = isLarge ? 4 * first.scatter || 0.01 * largest : 0,
      reach = Math.max(isLarge ? 1.5 * Math.max(-low, high) : 0.2 * (high - low), least);
    view = [[Math.min(0, ...x), Math.max(...x)], isLarge ? [-reach, reach] : [low - reach, high + reach]];
  }

  function drawReadings(p, w, h) {
    const frame = linearFrame(w, h, ...view, INSET, EDGE),
      { left, right, top, bottom, px, py } = frame,
      places = Array.from({ length: 61 }, (_, i) => view[0][0] + ((view[0][1] - view[0][0]) * i) / 60);
    drawScales(p, frame, ["δ/δmax", isLarge ? "force beside the first line (N)" : "force (N)"]);
    const curve = (force) => {
      const path = new Path2D();
      for (const x of places) path.lineTo(px(x), py(force(x) - line(x)));
      return path;
    };
    p.inside(left, top, right - left, bottom - top, () => {
      p.stroke("soft", 1.2, [5, 4], curve(first.force));
      const { fit } = now;
      if (fit) {
        const band = curve((x) => fit.force(x) + fit.band(x));
        for (const x of [...places].reverse()) band.lineTo(px(x), py(fit.force(x) - fit.band(x) - line(x)));
        p.fill("region", 0.3, band);
        p.stroke("region", 2, [], curve(fit.force));
      }
    });
    readings().forEach(([x, force], i) => {
      const [right, up] = [px(x), clamp(py(force - line(x)), top, bottom)];
      p.dot(right, up, i === at ? 7 : 4, i === at ? "front" : "paper", "ink", i === at ? 2 : 1.5);
    });
  }

  function drawEllipse(p, w, h) {
    const { fit } = now,
      shown = [first, fit].filter(Boolean),
      reach = [0, 2].map((j) => {
        const need = Math.max(...shown.flatMap(({ joint }) => joint[j].map(Math.abs)), 1e-6 * largest),
          base = Math.max(...first.joint[j].map(Math.abs), 1e-6 * largest);
        return base * 2 ** Math.max(0, Math.ceil(Math.log2(need / base))) * 1.05;
      }),
      frame = linearFrame(w, h, [-reach[0], reach[0]], [-reach[1], reach[1]], INSET, EDGE),
      { left, right, top, bottom, px, py } = frame;
    drawScales(p, frame, ["β₀ (N)", "β₂ (N)"]);
    p.inside(left, top, right - left, bottom - top, () => {
      p.stroke("soft", 1.2, [5, 4], ellipse(first, px, py));
      if (!fit) return;
      const box = ([x0, x1], [y0, y1]) => {
        const path = new Path2D();
        path.rect(px(x0), py(y1), px(x1) - px(x0), py(y0) - py(y1));
        return path;
      };
      p.fill("region", 0.3, ellipse(fit, px, py));
      p.stroke("region", 2, [], ellipse(fit, px, py));
      p.stroke("rear", 1.5, [7, 3], box(fit.joint[0], fit.joint[2]));
      p.stroke("rear", 1.2, [2, 3], box(fit.alone[0], fit.alone[2]));
      p.dot(px(fit.beta[0]), py(fit.beta[2]), 3, "region");
    });
    p.dot(px(0), py(0), 5, fit?.test.inside ? "ink" : "paper", fit?.test.inside ? "ink" : "alarm", 2.5);
    p.legend(left + 60, 13, right, [
      { words: "joint", colour: "rear", width: 1.5, dash: [7, 3] },
      { words: "alone", colour: "rear", width: 1.2, dash: [2, 3] },
    ]);
  }

  function drawMap(p, w, h) {
    const frame = logFrame(w, h, facts.k, facts.v, INSET.left),
      { left, right, top, bottom, px, py } = frame,
      { fit, critical } = now;
    drawAxes(p, frame, ["stiffness k (N/m)", "speed (m/s)"]);
    p.legend(left + 60, 13, right, [
      { words: "critical", colour: "ink", width: 2 },
      { words: "lost", colour: "alarm", width: 4, alpha: 0.7 },
    ]);
    const [low, high] = facts.k;
    p.inside(left, top, right - left, bottom - top, () => {
      for (const { v, flips, lost } of facts.asked) {
        const edges = [low, ...flips, high].map(px);
        p.stroke("soft", 1, [2, 3]);
        p.line(left, py(v), right, py(v));
        p.stroke("alarm", 4);
        p.g.globalAlpha = 0.7;
        lost.forEach((isSo, i) => isSo && p.line(edges[i], py(v), edges[i + 1], py(v)));
        p.g.globalAlpha = 1;
      }
      p.stroke("ink", 2);
      for (const { nodes } of branches) p.line(...nodes.flatMap(([k, v]) => [px(k), py(v)]));
      if (!critical) return;
      const ends = fit.interval.map((k) => px(clamp(k, low / 2, high * 2)));
      p.shade("region", 0.25, ends[0], top, Math.max(ends[1] - ends[0], 1), bottom - top);
      p.stroke("region", 2);
      p.line(px(fit.k), top, px(fit.k), bottom);
    });
    for (const { v } of facts.asked)
      p.text(`${show(v)} m/s`, right - 4, py(v) - 5, { align: "right", halo: true });
  }

  // ---- what one reads

  function makeTables() {
    const tableIn = (parent, caption, heads) => {
      const table = make(parent, "table", "");
      make(table, "caption", "", {}, caption);
      const head = make(make(table, "thead", ""), "tr", "");
      for (const name of heads) make(head, "th", "", { scope: "col" }, name);
      return make(table, "tbody", "");
    };
    const percent = `${show(100 * facts.level, 2)} %`,
      verdicts = tableIn(make(stage, "div", "se-verdicts"), "Asked speeds", [
        "speed",
        "contact",
        "lost with confidence",
      ]),
      line = make(texts, "p", ""),
      coefficients = tableIn(texts, "Coefficients", [
        "name",
        "estimate",
        `alone, ${percent}`,
        `jointly, ${percent}`,
      ]),
      speed = make(texts, "p", ""),
      speeds = tableIn(texts, "Critical speeds", ["at k", "in the interval of k", "exists"]);
    return { verdicts, line, coefficients, speed, speeds };
  }
  /** Rows of words; what stays is not touched. */
  function fill(body, rows) {
    body.parentNode.hidden = !rows.length;
    while (body.rows.length > rows.length) body.deleteRow(-1);
    rows.forEach((cells, i) => {
      const row = body.rows[i] ?? make(body, "tr", "");
      cells.forEach((words, j) => {
        write(row.cells[j] ?? make(row, j ? "td" : "th", "", j ? {} : { scope: "row" }), words);
      });
    });
  }

  write(
    legend,
    `${facts.synthetic ? "The readings are synthetic, made for this book. " : ""}Green: the fit with its band, the ellipse, the stiffness with its interval. Dashed grey: the same with the readings as they came. The dot in the ellipse's picture is (0, 0), filled if it lies inside; the boxes are the joint intervals and those of one coefficient alone.`,
  );

  function update() {
    now = follow(readings(), facts, branches);
    if (at !== null && at >= readings().length) at = null;
    if (!hold || !view) look();
    const [stiffness, line, speeds] = [tellStiffness, tellLine, tellSpeeds].map((tell) => tell(now, facts)),
      rows = verdictRows(now, facts);
    write(headline, `${stiffness} ${tellVerdicts(now, facts)}`.trim());
    write(chosen, tellReading(readings(), at, now));
    write(tables.line, line);
    write(tables.speed, speeds);
    fill(tables.coefficients, coefficientRows(now));
    fill(tables.speeds, speedRows(now));
    fill(tables.verdicts, rows);
    const names = [
      `Force against displacement: ${readings().length} readings, the fitted parabola and its band. ${stiffness}`,
      `The confidence ellipse of β₀ and β₂, with the box of the joint intervals and that of the single ones. ${line}`,
      `Critical speeds over the stiffness, with the interval of k. ${speeds} ${rows.map(([v, verdict]) => `${v}: ${verdict}.`).join(" ")}`,
    ];
    panels.forEach(({ canvas }, i) => canvas.setAttribute("aria-label", names[i]));
    hinder();
    scheduled ||= requestAnimationFrame(paint);
  }

  const sizes = new ResizeObserver((entries) => {
    zoom = enlargement();
    for (const { target, contentRect } of entries) {
      const panel = panels.find(({ canvas }) => canvas === target);
      panel.size = [contentRect.width, contentRect.height].map((size) => Math.round(size / zoom));
    }
    scheduled ||= requestAnimationFrame(paint);
  });
  for (const { canvas } of panels) sizes.observe(canvas);
  const leaveTheme = onTheme(() => {
    colours = null;
    paint(); // at once, or paper would get the dark picture
  });
  model.on("change:readings", update);
  update();
  return () => {
    model.off("change:readings", update);
    sizes.disconnect();
    leaveTheme();
    cancelAnimationFrame(scheduled);
    root.remove();
  };
}

/** The region of the two coefficients, as a path. */
function ellipse({ beta, V, region }, px, py) {
  const path = new Path2D(),
    a = Math.sqrt(V[0][0]),
    c = a && V[0][2] / a,
    d = Math.sqrt(Math.max(V[2][2] - c * c, 0)),
    size = Math.sqrt(region);
  for (let i = 0; i <= 72; i++) {
    const [cos, sin] = [Math.cos((Math.PI * i) / 36), Math.sin((Math.PI * i) / 36)];
    path.lineTo(px(beta[0] + size * a * cos), py(beta[2] + size * (c * cos + d * sin)));
  }
  return path;
}
