// A prediction: empty axes on which a reader draws a curve, and the same axes further down, where what
// was drawn stays while lines by hand and the exact curve are laid beside it. All views of a prediction
// share `strokes`, and each has its facts; a view whose facts hold an answer lays on, the other draws.

import { drawAxes, drawLine, logFrame } from "./axes.js";
import { button, make, write } from "./dom.js";
import { compareCurve, compareLine, describeDrawn, drawn, ENOUGH, share, strokeAt } from "./drawing.js";
import { begin, clamp, enlargement, ratioOf, show } from "./pen.js";
import { coloursOf, onTheme } from "./theme.js";

const STOPS = 24; // the keys move by such parts of the axes

export function renderPrediction(model, el) {
  const facts = model.get("facts"),
    { columns, x, y, names, symbol, answer } = facts,
    [floor, ceiling] = y.map(Math.log10),
    step = (columns - 1) / STOPS;
  const root = make(el, "div", "suspension-explorer se-predict"),
    stage = make(root, "div", "se-axes"),
    canvas = make(stage, "canvas", "", { role: "img" });
  let [w, h, zoom, frame, colours] = [0, 0, 1, null, null],
    scheduled = 0,
    pen = null; // where the keys are, while they draw

  const strokes = () => model.get("strokes");
  const heights = () => drawn(strokes(), columns);
  const set = (value, isDone = true) => {
    model.set("strokes", value);
    if (isDone) model.save_changes();
  };

  // ---- what one can do

  const tools = make(root, "div", "se-tools", {
      role: "group",
      "aria-label": answer ? "Lay on" : "Your curve",
    }),
    words = make(root, "p", "se-words", { role: "status" });
  const laid = new Set();
  if (answer) {
    make(tools, "span", "", {}, "Lay on:");
    for (const name of [...answer.lines.map((line) => line.name), answer.curve]) {
      const toggle = button(tools, name, { "aria-pressed": "false" });
      toggle.addEventListener("click", () => {
        if (!laid.delete(name)) laid.add(name);
        toggle.setAttribute("aria-pressed", laid.has(name));
        update();
      });
    }
  } else makePad();

  function makePad() {
    const undo = button(tools, "Undo"),
      clear = button(tools, "Clear");
    undo.addEventListener("click", () => set(strokes().slice(0, -1)));
    clear.addEventListener("click", () => set([]));
    update.tools = (isEmpty) => {
      for (const tool of [undo, clear]) {
        tool.disabled = isEmpty;
        tool.title = isEmpty ? "Nothing is drawn yet" : "";
      }
    };
    const pad = make(stage, "div", "se-pad", {
      role: "application",
      tabindex: "0",
      "aria-label": `Axes to draw on: ${names[1]} against ${names[0]}, both logarithmic. The arrow keys up and down move the curve, left and right go along it, Enter keeps a height, Backspace takes the last step back.`,
    });
    let stroke = null,
      before = [];
    const at = ({ clientX, clientY }) => {
      const box = pad.getBoundingClientRect(),
        [right, up] = [(clientX - box.left) / box.width, (box.bottom - clientY) / box.height];
      return [clamp(right, 0, 1) * (columns - 1), floor + clamp(up, 0, 1) * (ceiling - floor)].map(
        (part) => Math.round(1000 * part) / 1000,
      );
    };
    pad.addEventListener("pointerdown", (event) => {
      if (event.button || stroke) return;
      pad.setPointerCapture(event.pointerId);
      [before, stroke, pen] = [strokes(), [at(event)], null];
      set([...before, stroke], false);
    });
    pad.addEventListener("pointermove", (event) => {
      if (!stroke) return;
      stroke = [...stroke, at(event)];
      set([...before, stroke], false);
    });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
      pad.addEventListener(name, () => {
        if (stroke) model.save_changes();
        stroke = null;
      });
    pad.addEventListener("keydown", (event) => {
      const moves = {
        ArrowUp: [0, 1],
        ArrowDown: [0, -1],
        ArrowLeft: [-1, 0],
        ArrowRight: [1, 0],
        Enter: [0, 0],
      };
      if (event.key === "Backspace") undo.click();
      else if (moves[event.key] && !event.ctrlKey && !event.altKey && !event.metaKey)
        movePen(...moves[event.key]);
      else return;
      event.preventDefault();
    });
    pad.addEventListener("blur", () => {
      pen = null;
      update();
    });
  }

  /** Move the keys' pen by so many stops; up, down and Enter set the height of the curve. */
  function movePen(along, up) {
    const now = heights();
    if (!pen) pen = { stop: 0, height: now[0] ?? (floor + ceiling) / 2, own: null };
    else if (along) {
      const stop = clamp(pen.stop + along, 0, STOPS);
      pen = { stop, height: now[Math.round(stop * step)] ?? pen.height, own: null };
    }
    if (along) return update();
    const height = clamp(pen.height + (up * (ceiling - floor)) / STOPS, floor, ceiling),
      others = strokes().at(-1) === pen.own ? strokes().slice(0, -1) : strokes(),
      own = strokeAt(drawn(others, columns), Math.round(pen.stop * step), height, step);
    pen = { stop: pen.stop, height, own }; // one step back takes all that was done at this stop
    set([...others, own]);
  }

  // ---- what one sees and hears

  function paint() {
    scheduled = 0;
    if (!w || !h) return;
    colours ??= coloursOf(root);
    const p = begin(canvas, w, h, colours, ratioOf(zoom));
    frame = logFrame(w, h, x, y);
    const { left, right, top, bottom, px, py } = frame;
    drawAxes(p, frame, names);
    const isDrawn = share(heights()) > 0,
      isExact = answer && laid.has(answer.curve);
    p.legend(138, 13, right, [
      ...(isDrawn ? [{ words: "yours", colour: "front", width: 4, ink: "ink" }] : []),
      ...(isExact ? [{ words: "exact", colour: "ink", width: 2, ink: "ink" }] : []),
    ]);
    p.stroke("soft", 1);
    p.line(left, top, left, bottom, right, bottom);
    const place = (column) => left + ((right - left) * column) / (columns - 1),
      trace = (values) => {
        const path = new Path2D();
        values.forEach((height, i) => {
          if (height === null) return;
          const to = [place(i), py(10 ** height)];
          if (i && values[i - 1] !== null) path.lineTo(...to);
          else path.moveTo(...to);
        });
        return path;
      };
    p.inside(left, top, right - left, bottom - top, () => {
      p.stroke("front", 4, [], trace(heights()));
      if (!answer) return;
      for (const line of answer.lines)
        if (laid.has(line.name))
          drawLine(
            p,
            line.name,
            line.ends.map((end) => py(10 ** end)),
            frame,
          )();
      if (isExact) p.stroke("ink", 2, [], trace(answer.exact));
    });
    if (pen) p.dot(px(atStop()), py(10 ** pen.height), 6, "paper", "ink", 2);
    root.dispatchEvent(new Event("painted", { bubbles: true })); // for those who measure
  }
  const atStop = () => x[0] * (x[1] / x[0]) ** (pen.stop / STOPS);

  function describe() {
    const now = heights();
    if (pen) return `At ${symbol} = ${show(atStop(), 2)}: ${show(10 ** pen.height, 2)}.`;
    if (!laid.size || share(now) < ENOUGH)
      return answer ? "Your curve. Lay on it what you have derived." : describeDrawn(now);
    const told = answer.lines
      .filter(({ name }) => laid.has(name))
      .map((line) => compareLine(now, line, { ...facts, ...answer }));
    if (laid.has(answer.curve)) told.push(compareCurve(now, { ...facts, ...answer }));
    return told.join("\n");
  }

  function update() {
    const now = heights();
    root.closest(".suspension-prediction").classList.toggle("se-drawn", share(now) >= ENOUGH);
    update.tools?.(!strokes().length);
    write(words, describe());
    canvas.setAttribute(
      "aria-label",
      `${names[1]} against ${names[0]}. ${pen ? "" : words.textContent}`.trim(),
    );
    scheduled ||= requestAnimationFrame(paint);
  }

  const sizes = new ResizeObserver(([{ contentRect }]) => {
    zoom = enlargement();
    [w, h] = [contentRect.width, contentRect.height].map((size) => Math.round(size / zoom));
    scheduled ||= requestAnimationFrame(paint);
  });
  sizes.observe(canvas);
  const leaveTheme = onTheme(() => {
    colours = null;
    paint(); // at once, or paper would get the dark picture
  });
  model.on("change:strokes", update);
  update();
  return () => {
    model.off("change:strokes", update);
    sizes.disconnect();
    leaveTheme();
    cancelAnimationFrame(scheduled);
    root.remove();
  };
}
