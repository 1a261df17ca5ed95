// For JupyterLab: the view of an anywidget, with the same controls as in a built page.

import { make } from "./dom.js";
import { followPhrases } from "./phrases.js";
import { render } from "./view.js";

export default {
  render({ model, el }) {
    const { compact, chart, lanes } = model.get("facts"),
      kind =
        (compact ? " se-compact" : "") + (chart ? " se-chart-only" : "") + (lanes ? " se-race-only" : "");
    const box = make(el, "div", `suspension-explorer-box se-page${kind}`);
    const layout = make(box, "div", "se-layout");
    make(layout, "div", "se-controls").innerHTML = model.get("controls");
    const view = render(model, make(layout, "div", "se-place"));
    box.classList.add("se-live");
    const leave = followPhrases(view);
    return () => {
      leave();
      view.destroy();
    };
  },
};
