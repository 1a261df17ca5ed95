// For JupyterLab: the view of an anywidget, whose sliders are ipywidgets.

import { render } from "./view.js";

export default { render: ({ model, el }) => render(model, el).destroy };
