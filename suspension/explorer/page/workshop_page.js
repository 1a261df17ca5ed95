// For a built page: brings its workshops to life; the address says what the first one holds.

import { followAddress } from "./address.js";
import { startAll } from "./near.js";
import { makeModel } from "./values.js";
import { renderWorkshop } from "./workshop.js";
import { PREFIX, readLink, writeLink } from "./workshop_link.js";

startAll("se-workshop", (box, index) => {
  const model = makeModel(JSON.parse(box.querySelector(".se-state").textContent));
  if (index === 0)
    followAddress(model, box, {
      prefix: PREFIX,
      names: ["tableau", "kept", "v", "dt"],
      read: readLink,
      write: writeLink,
    });
  renderWorkshop(model, box.querySelector(".se-place"));
});
