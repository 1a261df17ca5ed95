// Runs between require.js and the widget manager and tells where the local modules are.
(() => {
  const base = new URL(".", document.currentScript.src).href;
  require.config({
    paths: {
      "@jupyter-widgets/html-manager/dist": base.slice(0, -1),
      anywidget: base + "index",
    },
    waitSeconds: 0,
  });
  // The widgets' labels call MathJax 2, which this book does not have; they hold no formulas.
  window.MathJax = window.MathJax || {};
  window.MathJax.Hub = { Queue() {} };
})();
