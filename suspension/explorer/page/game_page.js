// For a built page: brings its games to life; the address says an attempt on the first one.

import { renderGame } from "./game.js";
import { PREFIX, readLink, writeLink } from "./game_link.js";
import { startAll } from "./near.js";
import { makeModel } from "./values.js";

function start(box, index) {
  const model = makeModel(JSON.parse(box.querySelector(".se-state").textContent));
  const game = renderGame(model, box.querySelector(".se-place"), index === 0 ? address : undefined);
  if (index === 0) follow(model, game, box);
}

/** The address of an attempt, which becomes that of the page. */
const address = (attempt) => {
  const isOthers = location.hash && !location.hash.startsWith(PREFIX);
  if (!isOthers) history.replaceState(history.state, "", writeLink(attempt));
  return new URL(writeLink(attempt), location.href).href;
};

function follow(model, game, box) {
  const go = () => {
    const attempt = readLink(location.hash, model.get("facts"));
    if (attempt) game.show(attempt);
    return attempt;
  };
  if (go()) addEventListener("load", () => box.scrollIntoView({ block: "nearest" }), { once: true });
  addEventListener("popstate", go);
}

startAll("se-game", start);
