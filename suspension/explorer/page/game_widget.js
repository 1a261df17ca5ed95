// For JupyterLab: a game as the view of an anywidget.

import { make } from "./dom.js";
import { renderGame } from "./game.js";

export default {
  render({ model, el }) {
    const box = make(el, "div", "suspension-laboratory se-game se-live");
    return renderGame(model, make(box, "div", "se-place")).destroy;
  },
};
