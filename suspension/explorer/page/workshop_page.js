// For a built page: brings its workshops to life; the address says what the first one holds.

import { followAddress } from "./address.js";
import { makeModel } from "./values.js";
import { renderWorkshop } from "./workshop.js";
import { PREFIX, readLink, writeLink } from "./workshop_link.js";

function start() {
  document.querySelectorAll(".suspension-laboratory.se-workshop").forEach((box, index) => {
    const model = makeModel(JSON.parse(box.querySelector(".se-state").textContent));
    renderWorkshop(model, box.querySelector(".se-place"));
    box.classList.add("se-live");
    if (index) return;
    followAddress(model, box, {
      prefix: PREFIX,
      names: ["tableau", "v", "dt"],
      read: readLink,
      write: writeLink,
    });
  });
}

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
else start();
