// For a built page: brings its predictions to life, and keeps what was drawn.

import { renderPrediction } from "./predict.js";
import { makeModel } from "./values.js";

/** The predictions of the page; all views of one have the same strokes, and so has the next visit. */
function start() {
  const together = new Map();
  for (const box of document.querySelectorAll(".suspension-prediction")) {
    const values = JSON.parse(box.querySelector(".se-state").textContent),
      key = `suspension-prediction ${location.pathname} ${values.name}`;
    const model = makeModel({ strokes: recall(key), ...values });
    const all = together.get(key) ?? together.set(key, []).get(key);
    all.push(model);
    model.on("change:strokes", () => {
      for (const other of all) other.set("strokes", model.get("strokes"));
      try {
        localStorage.setItem(key, JSON.stringify(model.get("strokes")));
      } catch {} // no room, or not allowed: then it is forgotten
    });
    renderPrediction(model, box.querySelector(".se-place"));
    box.classList.add("se-live");
  }
}

/** The strokes of the last visit, if they can be read. */
function recall(key) {
  try {
    const strokes = JSON.parse(localStorage.getItem(key)) ?? [];
    return strokes.every((stroke) => stroke.flat().every(Number.isFinite)) ? strokes : [];
  } catch {
    return [];
  }
}

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
else start();
