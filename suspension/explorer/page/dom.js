// Elements: making them, and changing what they say.

export function make(parent, tag, name, attributes = {}, text = "") {
  const child = document.createElement(tag);
  if (name) child.className = name;
  for (const [key, value] of Object.entries(attributes)) child.setAttribute(key, value);
  if (text) child.textContent = text;
  return parent.appendChild(child);
}

export const button = (parent, text, attributes = {}) =>
  make(parent, "button", "", { type: "button", ...attributes }, text);

/** Change a text without making the page look for new elements. */
export function write(element, text) {
  const node = element.firstChild ?? element.appendChild(document.createTextNode(""));
  if (node.data !== text) node.data = text;
}

/**
 * The frame of a view: where its words, pictures and tools go. What stays in sight on a phone, while
 * one scrolls through the sliders, has a box of its own; the bar stands between the two rows of panels.
 */
export function makeFrame(el, facts, view) {
  const root = make(el, "div", facts.compact ? "suspension-explorer se-small" : "suspension-explorer"),
    sight = make(root, "div", "se-sight"),
    status = make(sight, "div", "se-status"),
    stage = make(sight, "div", "se-panels", { "data-view": view });
  const frame = {
    root,
    box: root.closest(".suspension-explorer-box") ?? root,
    status,
    headline: make(status, "strong", "se-headline"),
    stage,
    bar: make(stage, "div", "se-bar"),
    tabs: make(sight, "div", "se-tabs", { role: "group", "aria-label": "Panel beside the robot" }),
    spoken: make(root, "div", "se-spoken", { role: "status" }),
    tools: make(root, "div", "se-tools"),
    details: make(root, "p", "se-details"),
    key: make(root, "p", "se-key"),
  };
  frame.canvases = facts.panels.map((name) => make(stage, "canvas", `se-${name}`, { role: "img" }));
  return frame;
}
