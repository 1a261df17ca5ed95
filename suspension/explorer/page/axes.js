// Axes: logarithmic ones and straight lines on them, for the chart and for a curve that a reader draws,
// and plain ones.

import { clamp, powers, show, ticks } from "./pen.js";

/** A frame of logarithmic axes: where an x and a y lie in it, and what lies at a place. */
export function logFrame(w, h, [x0, x1], [y0, y1], left = 38) {
  const [right, top, bottom] = [w - 12, 24, h - 33];
  return {
    ...{ left, right, top, bottom, ends: [x0, x1, y0, y1] },
    px: (x) => left + ((right - left) * Math.log(x / x0)) / Math.log(x1 / x0),
    py: (y) => bottom - ((bottom - top) * Math.log(y / y0)) / Math.log(y1 / y0),
  };
}

/** Round numbers along both axes, those of y `scale` times as large, and what they count. */
export function drawAxes({ stroke, line, text }, { left, right, bottom, ends, px, py }, names, scale = 1) {
  const [x0, x1, y0, y1] = ends;
  text(names[1], 0, 13, { colour: "ink", bold: true });
  text(names[0], right, bottom + 29, { align: "right" });
  for (const x of powers(x0, x1)) {
    stroke("soft", 1);
    line(px(x), bottom, px(x), bottom + 4);
    text(show(x), px(x), bottom + 15, { align: "center" });
  }
  for (const y of powers(scale * y0, scale * y1)) {
    stroke("line", 1);
    line(left, py(y / scale), right, py(y / scale));
    text(show(y), left - 6, py(y / scale) + 4, { align: "right" });
  }
}

/**
 * A dashed line from edge to edge. What comes back writes its name along it, where it is seen, there is
 * room and no line across at `avoid`.
 */
export function drawLine({ g, stroke, line, text }, name, [from, to], { left, right, top, bottom }, avoid) {
  stroke("soft", 1.2, [6, 4]);
  line(left, from, right, to);
  const slope = (to - from) / (right - left),
    ends = [top + 16, bottom - 6].map((y) => clamp(left + (y - from) / slope, left, right));
  if (Math.abs(ends[1] - ends[0]) < 40) return () => {};
  const places = [0.3, 0.15, 0.6, 0.45, 0.75].map((share) => {
    const x = ends[0] + share * (ends[1] - ends[0]);
    return [x, from + slope * (x - left)];
  });
  const write = (place) => {
    g.save();
    g.translate(...place);
    g.rotate(Math.atan(slope));
    const written = text(name, 0, -5, { align: "center", halo: true });
    g.restore();
    return written;
  };
  const isAway = ([, y]) => !(Math.abs(y - avoid) <= 20);
  return () => places.filter(isAway).some(write) || places.some(write);
}

/** A frame of plain axes, so many pixels from the edges of a picture: where an x and a y lie in it. */
export function linearFrame(w, h, [x0, x1], [y0, y1], inset, edge = 0) {
  const [left, right, top, bottom] = [inset.left, w - inset.right, inset.top, h - inset.bottom];
  return {
    ...{ left, right, top, bottom, x: [x0, x1], y: [y0, y1] },
    px: (x) => left + edge + ((right - left - 2 * edge) * (x - x0)) / (x1 - x0),
    py: (y) => bottom - ((bottom - top) * (y - y0)) / (y1 - y0),
  };
}

/** Round numbers along plain axes, those of y `scale` times as large, and what they count. */
export function drawScales({ stroke, line, text }, frame, names, scale = 1) {
  const { left, right, bottom, top, x, y, px, py } = frame;
  text(names[1], 0, 13, { colour: "ink", bold: true });
  text(names[0], right, bottom + 29, { align: "right" });
  stroke("line", 1);
  for (const at of ticks(...y.map((end) => scale * end), 5)) {
    line(left, py(at / scale), right, py(at / scale));
    text(show(at), left - 6, py(at / scale) + 4, { align: "right" });
  }
  for (const at of ticks(...x, 4)) {
    line(px(at), bottom, px(at), bottom + 4);
    text(show(at), px(at), bottom + 15, { align: "center" });
  }
  stroke("soft", 1);
  line(left, top, left, bottom, right, bottom);
}
