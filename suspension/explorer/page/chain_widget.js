// For JupyterLab: the readings as the view of an anywidget.

import { renderChain } from "./chain.js";
import { make } from "./dom.js";

export default {
  render({ model, el }) {
    const box = make(el, "div", "suspension-laboratory se-chain se-live");
    return renderChain(model, make(box, "div", "se-place"));
  },
};
