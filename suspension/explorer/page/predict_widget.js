// For JupyterLab: a prediction as the view of an anywidget.

import { make } from "./dom.js";
import { renderPrediction } from "./predict.js";

export default {
  render({ model, el }) {
    const kind = model.get("facts").answer ? "se-answered" : "se-asked";
    const box = make(el, "div", `suspension-prediction ${kind} se-live`);
    return renderPrediction(model, make(box, "div", "se-place"));
  },
};
