// Draws the panels, once a frame at most, in the colours of the theme and at the size that they have.

import { PANELS } from "./panels.js";
import { begin, enlargement, ratioOf } from "./pen.js";
import { racePanel } from "./race.js";
import { coloursOf, onTheme } from "./theme.js";

const ALL = { ...PANELS, race: racePanel };

/** `told` is called after a picture was drawn: with the options, and whether more than the moment changed. */
export function makePainter({ root, canvases }, names, shown, told) {
  const panels = names.map((name, i) => ({
    ...ALL[name],
    canvas: canvases[i],
    cache: document.createElement("canvas"),
    size: [0, 0],
  }));
  let frame = 0,
    redraw = true;
  // A panel's size is what it has divided by `zoom`; it is drawn at that size and enlarged.
  const painter = { panels, colours: null, zoom: 1, schedule, change, destroy };

  function schedule() {
    frame ||= requestAnimationFrame(paint);
  }
  /** More than the moment has changed. */
  function change() {
    redraw = true;
    schedule();
  }
  function paint() {
    frame = 0;
    const scene = shown.scene();
    if (panels.every(({ size }) => !size[0])) return; // not on the page yet; its first size will bring us back
    if (!painter.colours) readColours();
    const options = shown.options();
    for (const panel of panels) paintPanel(panel, scene, options);
    told(options, redraw);
    redraw = Boolean(options.map) && options.map.work(); // a map grows over several frames
    if (redraw) schedule();
    root.dispatchEvent(new Event("painted", { bubbles: true })); // for those who measure
  }
  function paintPanel(panel, scene, options) {
    const [w, h] = panel.size;
    if (!w || !h) return; // not shown on a phone
    const ratio = ratioOf(painter.zoom);
    if (redraw && panel.still) {
      const key = [...panel.key(scene, options), w, h, ratio, shown.looks].join();
      if (key !== panel.drawn) panel.still(begin(panel.cache, w, h, painter.colours, ratio), scene, options);
      panel.drawn = key;
    }
    const pen = begin(panel.canvas, w, h, painter.colours, ratio);
    if (panel.still) pen.g.drawImage(panel.cache, 0, 0, w, h);
    panel.live?.(pen, scene, options);
  }

  // ---- the theme's colours

  function readColours() {
    painter.colours = coloursOf(root);
    shown.looks++;
    redraw = true;
  }
  const leaveTheme = onTheme(() => {
    readColours();
    paint(); // at once, or paper would get the dark picture
  });

  // ---- their sizes

  const sizes = new ResizeObserver((entries) => {
    painter.zoom = enlargement();
    for (const { target, contentRect } of entries) {
      const panel = panels.find(({ canvas }) => canvas === target);
      panel.size = [contentRect.width, contentRect.height].map((size) => Math.round(size / painter.zoom));
    }
    redraw = true;
    // What is below the window when the page opens lets the others go first.
    const waits = !shown.isComputed() && root.getBoundingClientRect().top > innerHeight;
    if (waits) setTimeout(schedule, 100);
    else schedule();
  });
  for (const { canvas } of panels) sizes.observe(canvas);

  function destroy() {
    leaveTheme();
    sizes.disconnect();
    cancelAnimationFrame(frame);
  }
  return painter;
}
