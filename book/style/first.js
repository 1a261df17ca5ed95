// Runs before the page is drawn: the theme that the reader has chosen, or the system's.
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
})();
