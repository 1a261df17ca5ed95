// For a built page: brings your own robot and road to life; the address says what it holds, and what was
// set last is there on the next visit.

import { followAddress } from "./address.js";
import { startAll } from "./near.js";
import { renderOwn } from "./own.js";
import { PREFIX, readLink, readState, writeLink } from "./own_state.js";
import { makeModel } from "./values.js";

function start(box, index) {
  const values = JSON.parse(box.querySelector(".se-state").textContent),
    model = makeModel(values),
    key = `suspension-own ${location.pathname} ${index}`,
    { facts } = values;
  const recalled = recall(key, facts);
  const isSaid =
    index === 0 &&
    followAddress(model, box, {
      prefix: PREFIX,
      names: ["state"],
      read(hash) {
        const state = readLink(hash, facts);
        return state && { state };
      },
      write: (model) => writeLink(model.get("state")),
    });
  if (recalled && !isSaid) model.set("state", recalled);
  model.on("change:state", () => {
    try {
      localStorage.setItem(key, JSON.stringify(model.get("state")));
    } catch {} // no room, or not allowed: then it is forgotten
  });
  renderOwn(model, box.querySelector(".se-place"));
}

/** The state of the last visit, if it can be read. */
function recall(key, facts) {
  try {
    return readState(JSON.parse(localStorage.getItem(key)), facts);
  } catch {
    return null;
  }
}

startAll("se-own", start);
