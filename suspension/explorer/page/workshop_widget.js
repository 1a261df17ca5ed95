// For JupyterLab: a workshop as the view of an anywidget.

import { make } from "./dom.js";
import { renderWorkshop } from "./workshop.js";

export default {
  render({ model, el }) {
    const box = make(el, "div", "suspension-laboratory se-workshop se-live");
    return renderWorkshop(model, make(box, "div", "se-place"));
  },
};
