// Runs before the page is drawn: its fonts, and the theme that the reader has chosen, or the system's.
(() => {
  const root = document.documentElement;
  let mode = "auto";
  let theme = null;
  try {
    mode = localStorage.getItem("mode") || mode;
    theme = localStorage.getItem("theme");
  } catch {
    // A browser may refuse to remember.
  }
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.mode = mode;
  root.dataset.theme = mode === "auto" || !theme ? (dark ? "dark" : "light") : theme;

  // From a style sheet they would come after the text has been set with others. The build puts
  // names, files and styles here.
  const fonts = FONTS;
  for (const [family, data, style] of fonts) {
    const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
    document.fonts.add(new FontFace(family, bytes.buffer, style));
  }
})();
