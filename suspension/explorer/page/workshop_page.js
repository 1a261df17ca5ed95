// For a built page: brings its workshops to life; the address says what the first one holds.

import { makeModel } from "./values.js";
import { renderWorkshop } from "./workshop.js";
import { PREFIX, readLink, writeLink } from "./workshop_link.js";

const PAUSE = 400; // ms after the last change, until the address says it

function start() {
  document.querySelectorAll(".suspension-laboratory.se-workshop").forEach((box, index) => {
    const model = makeModel(JSON.parse(box.querySelector(".se-state").textContent));
    renderWorkshop(model, box.querySelector(".se-place"));
    box.classList.add("se-live");
    if (index === 0) followAddress(model, box);
  });
}

function followAddress(model, box) {
  let timer = 0;
  const initial = writeLink(model);
  const follow = () => {
    clearTimeout(timer);
    const found = readLink(location.hash);
    for (const [name, value] of Object.entries(found ?? {})) model.set(name, value);
    return found;
  };
  if (follow()) addEventListener("load", () => box.scrollIntoView({ block: "nearest" }), { once: true });
  addEventListener("popstate", follow);
  for (const name of ["tableau", "v", "dt"])
    model.on(`change:${name}`, () => {
      clearTimeout(timer);
      timer = setTimeout(() => {
        const link = writeLink(model),
          bare = location.pathname + location.search,
          isOthers = location.hash && !location.hash.startsWith(PREFIX);
        if (link === initial && isOthers) return;
        history.replaceState(history.state, "", link === initial ? bare : link);
      }, PAUSE);
    });
}

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
else start();
