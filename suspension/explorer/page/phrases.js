// Phrases in a text that set a picture: links that end in #explore: and settings.

import { readHash } from "./state.js";

export const PREFIX = "#explore:";
// Every view loads these modules anew; the window keeps what they share.
const LIVE = "suspensionExplorers";
const PENDING = "suspensionPending";
const TEXT = ".jp-Notebook, body"; // what phrases and explorers belong to

/** The address of the link that an event is a plain click on, or undefined. */
export function linkOf(event) {
  if (event.ctrlKey || event.metaKey || event.shiftKey || event.button) return undefined;
  return event.target.closest?.("a[href]")?.getAttribute("href");
}

/** Let the phrases of a notebook set this view, the first there unless they say which. */
export function followPhrases(view) {
  window[LIVE] ??= listen();
  const live = { ...view, text: null },
    { views } = window[LIVE];
  views.add(live);
  // A phrase of another notebook has waited for this one to be run.
  const begin = () => {
    const { node, anchor } = window[PENDING] ?? {};
    if (!node?.contains(view.box) || !window[LIVE].follow(node, anchor)) return;
    delete window[PENDING];
    view.restart();
  };
  view.box.addEventListener("painted", begin, { once: true });
  return () => views.delete(live);
}

/** The views that are alive, and what lets a phrase set one of those in an element. */
function listen() {
  const views = new Set();
  const follow = (text, anchor) => {
    // What JupyterLab has scrolled out of sight may be out of the document: it keeps its place.
    for (const view of views) if (view.box.isConnected) view.text = view.box.closest(TEXT);
    const inText = (view) => view.text && (text === view.text || text.contains(view.text)),
      [index, settings] = readHash(anchor.slice(PREFIX.length - 1)),
      view = inOrder([...views].filter(inText))[index];
    if (!view) return false; // of another notebook, or not run yet
    view.apply({ ...view.run, time: null, ...settings });
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    view.box.scrollIntoView({ block: "nearest", behavior: calm ? "auto" : "smooth" });
    return true;
  };
  const click = (event) => {
    const hash = linkOf(event);
    if (!hash?.startsWith(PREFIX) || !follow(event.target.closest(TEXT), hash.slice(1))) return;
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  document.addEventListener("click", click, { capture: true });
  return { views, follow };
}

const inOrder = (views) =>
  views.sort((a, b) => (a.box.compareDocumentPosition(b.box) & Node.DOCUMENT_POSITION_FOLLOWING ? -1 : 1));
