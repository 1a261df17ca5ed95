// For JupyterLab, loaded by `make lab`: the links of the book's notebooks lead where they lead in the
// book. A page of prose opens as it was built, if it was, else its text; a heading, a figure or a
// table of a notebook is scrolled to; a phrase on another notebook's picture sets it.
//
// JupyterLab takes extensions as containers of modules, which a bundler usually writes. This one
// shares nothing and holds one module, so it stands here as it is.

const EXPLORE = "explore:";
const INSTRUMENT = /^(workshop|chain|own|game):/; // the laboratory's: named like the variable that holds it
const WAIT = 100; // ms between two looks whether a notebook is there
const TRIES = 100;

/** A heading's anchor, as the book makes it. */
const anchorOf = (heading) =>
  heading
    .replace(/[*_`$]|\]\([^)]*\)/g, "")
    .trim()
    .toLowerCase()
    .replace(/[^\p{L}\p{N}\s_-]/gu, "")
    .replace(/\s/g, "-");

/** Whether a cell holds what an anchor names: a heading, a figure, a table, an equation. */
function holds(cell, anchor) {
  const { sharedModel: shared, type } = cell.model;
  const instrument = INSTRUMENT.exec(anchor)?.[1];
  if (instrument) return type === "code" && shared.getSource().includes(`\n${instrument} = `);
  if (shared.getMetadata("mystnb")?.figure?.name === anchor) return true;
  const source = shared.getSource();
  if (type !== "markdown") return source.includes(`"${anchor}"`);
  const headings = [...source.matchAll(/^#{1,6}\s+(.*)$/gm)].map(([, heading]) => anchorOf(heading));
  return headings.includes(anchor) || source.includes(`(${anchor})=`) || source.includes(`{#${anchor}}`);
}

async function activate(app) {
  const { baseUrl } = app.serviceManager.serverSettings;
  const files = new URL("files/", baseUrl).href;
  const until = async (test) => {
    for (let i = 0; i < TRIES; i++) {
      const found = test();
      if (found) return found;
      await new Promise((done) => setTimeout(done, WAIT));
    }
    return null;
  };
  const panelOf = (path) =>
    [...app.shell.widgets("main")].find((widget) => widget.context?.path === path && widget.content?.widgets);

  const open = (path) => app.commands.execute("docmanager:open", { path });

  const scrollTo = async (panel, anchor) => {
    await panel.context.ready;
    const notebook = panel.content,
      index = notebook.widgets.findIndex((cell) => holds(cell, anchor));
    if (index < 0) return;
    notebook.activeCellIndex = index;
    await notebook.scrollToItem(index, "start");
  };

  /** The built page of a text, or null. */
  const builtPage = async (path) => {
    const url = new URL(`static/${path.replace(/\.md$/, ".html")}`, baseUrl).href;
    const answer = await fetch(url, { method: "HEAD" }).catch(() => null);
    return answer?.ok ? url : null;
  };

  const followText = async (path, anchor) => {
    const page = await builtPage(path);
    if (page) {
      window.open(anchor ? `${page}#${anchor}` : page, "_blank");
      return;
    }
    const shown = await app.commands.execute("docmanager:open", { path, factory: "Markdown Preview" });
    await shown?.content?.ready;
    const headings = () => [...(shown?.node.querySelectorAll("h1, h2, h3, h4, h5, h6") ?? [])];
    await until(() => headings().length);
    headings()
      .find((heading) => anchorOf(heading.textContent.replace("¶", "")) === anchor)
      ?.scrollIntoView();
  };

  const followNotebook = async (path, anchor) => {
    await open(path);
    const panel = await until(() => panelOf(path));
    if (!panel || !anchor) return;
    if (!anchor.startsWith(EXPLORE)) return scrollTo(panel, anchor);
    if (!window.suspensionExplorers?.follow(panel.node, anchor))
      window.suspensionPending = { node: panel.node, anchor }; // set when it has been run
  };

  document.addEventListener(
    "click",
    (event) => {
      if (event.ctrlKey || event.metaKey || event.shiftKey || event.button) return;
      const link = event.target.closest?.(".jp-RenderedMarkdown a[href], .jp-RenderedHTMLCommon a[href]");
      if (!link) return;
      const [href, anchor = ""] = [link.href.split("#")[0], decodeURIComponent(link.hash.slice(1))];
      const own = app.shell.currentWidget?.context?.path;
      const path = href.startsWith(files) ? decodeURIComponent(href.slice(files.length).split("?")[0]) : null;
      const isHere = link.getAttribute("href").startsWith("#") && own?.endsWith(".ipynb");
      if (isHere && anchor.startsWith(EXPLORE)) return; // the explorers' own
      const follow =
        isHere || path === own
          ? () => followNotebook(own, anchor)
          : path?.endsWith(".ipynb")
            ? () => followNotebook(path, anchor)
            : path?.startsWith("book/") && path.endsWith(".md")
              ? () => followText(path, anchor)
              : null;
      if (!follow) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      follow();
    },
    { capture: true },
  );
}

const plugin = { id: "suspension-links:plugin", autoStart: true, activate };

window._JUPYTERLAB ??= {};
window._JUPYTERLAB["suspension-links"] = {
  init() {},
  get: async () => () => ({ default: plugin, __esModule: true }),
};
