// For a built page: brings the readings on it to life.

import { renderChain } from "./chain.js";
import { makeModel } from "./values.js";

function start() {
  for (const box of document.querySelectorAll(".suspension-laboratory.se-chain")) {
    const values = JSON.parse(box.querySelector(".se-state").textContent);
    renderChain(makeModel(values), box.querySelector(".se-place"));
    box.classList.add("se-live");
  }
}

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
else start();
