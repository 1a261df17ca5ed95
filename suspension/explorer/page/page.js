// For a built page: brings its explorers to life without a kernel or a widget manager, and lets the
// address and the phrases in the text set their pictures.

import { linkOf, PREFIX } from "./phrases.js";
import { readHash, writeHash } from "./state.js";
import { makeModel } from "./values.js";
import { render } from "./view.js";

const PAUSE = 400; // ms after the last change, until the address says it

const bytes = (text) => new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);

function start(box) {
  const values = JSON.parse(box.querySelector(".se-state").textContent);
  for (const [name, text] of Object.entries(values.tables)) values.tables[name] = bytes(text);
  const view = render(makeModel(values), box.querySelector(".se-place"));
  box.classList.add("se-live");
  return view;
}

function begin() {
  const explorers = [...document.querySelectorAll(".suspension-explorer-box.se-page")].map(start);
  if (!explorers.length) return;
  let timer = 0,
    quiet = false;

  /**
   * Set the picture that a hash names, the others to where they began. A phrase says a run, and
   * leaves alone how one looks at it and what one compares it with; an address says all.
   */
  const follow = (hash, isPhrase = false) => {
    const [index, settings] = hash.startsWith(PREFIX) ? readHash(hash.slice(PREFIX.length)) : [0, null];
    quiet = true;
    explorers.forEach((view, i) => {
      if (i === index && settings)
        view.apply({ ...(isPhrase ? view.run : view.initial), time: null, ...settings });
      else if (!settings) view.apply(view.initial);
    });
    quiet = false;
    return settings ? explorers[index] : null;
  };
  const show = (explorer) => {
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    explorer?.box.scrollIntoView({ block: "nearest", behavior: calm ? "auto" : "smooth" });
  };

  explorers.forEach((view, index) => {
    view.onSettled(() => {
      if (quiet) return;
      clearTimeout(timer);
      timer = setTimeout(() => {
        const text = writeHash(view.settings(), view.initial, index);
        const others = location.hash && !location.hash.startsWith(PREFIX);
        if (!text && others) return;
        const bare = location.pathname + location.search;
        history.replaceState(history.state, "", text ? PREFIX + text : bare);
      }, PAUSE);
    });
  });
  document.addEventListener("click", (event) => {
    const hash = linkOf(event);
    if (!hash?.startsWith(PREFIX)) return;
    event.preventDefault();
    if (location.hash !== hash) history.pushState(null, "", hash);
    show(follow(hash, true));
  });
  addEventListener("popstate", () => {
    clearTimeout(timer);
    if (!location.hash || location.hash.startsWith(PREFIX)) follow(location.hash);
  });
  if (location.hash.startsWith(PREFIX)) {
    const found = follow(location.hash);
    found?.restart();
    if (document.readyState === "complete") show(found);
    else addEventListener("load", () => show(found), { once: true });
  }
}

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", begin);
else begin();
