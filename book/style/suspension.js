// What the theme leaves open for readers with a keyboard, a screen reader, or the book as files.
(() => {
  // A page that was opened as a file may not read the others to show extracts of them.
  if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;

  // Paper is white.
  let theme;
  addEventListener("beforeprint", () => {
    theme = document.documentElement.dataset.theme;
    document.documentElement.dataset.theme = "light";
  });
  addEventListener("afterprint", () => {
    document.documentElement.dataset.theme = theme;
  });

  const WIDE = "article .katex-display, .pst-scrollable-table-container";
  const reach = () => {
    // What scrolls sideways can be reached by keyboard. All is measured before any is altered.
    const boxes = [...document.querySelectorAll(WIDE)],
      wide = boxes.map((box) => box.scrollWidth > box.clientWidth + 1);
    boxes.forEach((box, i) => {
      if (wide[i]) box.tabIndex = 0;
      else box.removeAttribute("tabindex");
    });
    // A table header that is a formula only has a name for checkers and older readers.
    for (const formula of document.querySelectorAll("article th math:not([aria-label])")) {
      formula.setAttribute("aria-label", formula.textContent);
    }
  };
  const sizes = new ResizeObserver(reach); // of the window, and when a font comes late
  addEventListener("load", () => {
    for (const box of document.querySelectorAll(WIDE)) {
      for (const each of [box, ...box.children]) sizes.observe(each); // tells of each at once, too
    }
    // The widgets add to the text later. A widget at work changes nothing of this.
    const added = new MutationObserver((changes) => {
      if (changes.some(({ target }) => !target.closest(".jupyter-widgets"))) reach();
    });
    const article = document.querySelector("article");
    if (article) added.observe(article, { childList: true, subtree: true });
  });
})();

// The theme's buttons, without inline handlers.
addEventListener("click", (event) => {
  const button = event.target.closest?.("[data-click]");
  if (button?.dataset.click === "window.print()") print();
  if (button?.dataset.click === "toggleFullScreen()") toggleFullScreen();
});

// An address that leads to a fold, or into one, opens it: from the contents or from another page.
(() => {
  const unfold = () => {
    const target = document.getElementById(location.hash.slice(1)),
      closed = [];
    for (let at = target; at; at = at.parentElement) if (at.matches("details:not([open])")) closed.push(at);
    for (const fold of closed) fold.open = true;
    if (closed.length) target.scrollIntoView();
  };
  addEventListener("DOMContentLoaded", unfold);
  addEventListener("hashchange", unfold);
  addEventListener("click", ({ target }) => {
    if (target.closest?.('a[href^="#"]')) setTimeout(unfold); // the same address once more
  });
})();

// The choices of a prediction: the one that is tapped stays marked, and opens the answer below.
addEventListener("DOMContentLoaded", () => {
  for (const list of document.querySelectorAll("article ul.choices")) {
    const buttons = [...list.children].map((item) => {
      const button = document.createElement("button"),
        words = item.querySelector("p") ?? item;
      button.type = "button";
      button.setAttribute("aria-pressed", "false");
      button.append(...words.childNodes);
      item.replaceChildren(button);
      return button;
    });
    for (const button of buttons) {
      button.addEventListener("click", () => {
        for (const other of buttons) other.setAttribute("aria-pressed", other === button);
        list.nextElementSibling.open = true;
      });
    }
  }
});
