// For JupyterLab: your own robot and road as the view of an anywidget.

import { make } from "./dom.js";
import { renderOwn } from "./own.js";

export default {
  render({ model, el }) {
    const box = make(el, "div", "suspension-laboratory se-own se-live");
    return renderOwn(model, make(box, "div", "se-place"));
  },
};
