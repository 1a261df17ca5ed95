// Phrases in a text that set a picture: links that end in #explore: and settings.

import { readHash } from "./state.js";

export const PREFIX = "#explore:";
const LIVE = "suspensionExplorers"; // every view loads these modules anew; the window keeps what they share
const CELLS = ".jp-Notebook, .notebook-container, main, body"; // what the explorers of a text stand in

/** The address of the link that an event is a plain click on, or undefined. */
export function linkOf(event) {
  if (event.ctrlKey || event.metaKey || event.shiftKey || event.button) return undefined;
  return event.target.closest?.("a[href]")?.getAttribute("href");
}

/** Let the phrases of a notebook set this view, the first there unless they say which. */
export function followPhrases(view) {
  window[LIVE] ??= listen();
  const live = { ...view, text: null };
  window[LIVE].add(live);
  return () => window[LIVE].delete(live);
}

/** The views that are alive, once there is somebody who listens to clicks for all of them. */
function listen() {
  const views = new Set();
  const follow = (event) => {
    const href = linkOf(event),
      at = href?.indexOf(PREFIX) ?? -1;
    if (at < 0) return;
    // What JupyterLab has scrolled out of sight may be out of the document: it keeps its place.
    for (const view of views) if (view.box.isConnected) view.text = view.box.closest(CELLS);
    const text = event.target.closest(CELLS),
      here = inOrder([...views].filter((view) => view.text === text));
    const [index, settings] = readHash(href.slice(at + PREFIX.length)),
      view = here[index];
    if (!view) return; // of another notebook, or not run yet
    event.preventDefault();
    event.stopImmediatePropagation();
    view.apply({ ...view.initial, time: null, ...settings });
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    view.box.scrollIntoView({ block: "nearest", behavior: calm ? "auto" : "smooth" });
  };
  document.addEventListener("click", follow, { capture: true });
  return views;
}

const inOrder = (views) =>
  views.sort((a, b) => (a.box.compareDocumentPosition(b.box) & Node.DOCUMENT_POSITION_FOLLOWING ? -1 : 1));
