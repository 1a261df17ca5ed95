// The colours of the theme, as the style sheet has them, and when they change.

const COLOURS = [
  "ink",
  "soft",
  "line",
  "ground",
  "rear",
  "front",
  "region",
  "alarm",
  "doubt",
  "pinned",
  "paper",
];

export function coloursOf(root) {
  const style = getComputedStyle(root),
    colours = { font: style.fontFamily };
  for (const name of COLOURS) colours[name] = style.getPropertyValue(`--se-${name}`).trim();
  return colours;
}

/** Call back when the page's or JupyterLab's theme or the contrast changes, until told to leave. */
export function onTheme(changed) {
  const themes = new MutationObserver(changed);
  themes.observe(document.documentElement, { attributeFilter: ["data-theme"] });
  themes.observe(document.body, { attributeFilter: ["data-jp-theme-light"] });
  const contrasts = matchMedia("(forced-colors: active)");
  contrasts.addEventListener("change", changed);
  return () => {
    themes.disconnect();
    contrasts.removeEventListener("change", changed);
  };
}
