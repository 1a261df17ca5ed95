// For a built page: brings the readings on it to life; the address says those of the first instrument.

import { followAddress } from "./address.js";
import { renderChain } from "./chain.js";
import { PREFIX, readLink, writeLink } from "./chain_link.js";
import { startAll } from "./near.js";
import { makeModel } from "./values.js";

startAll("se-chain", (box, index) => {
  const values = JSON.parse(box.querySelector(".se-state").textContent),
    model = makeModel(values),
    { facts } = values;
  if (index === 0)
    followAddress(model, box, {
      prefix: PREFIX,
      names: ["readings"],
      read(hash) {
        const readings = readLink(hash, facts);
        return readings && { readings };
      },
      write: (model) => writeLink(model.get("readings"), facts),
    });
  renderChain(model, box.querySelector(".se-place"));
});
