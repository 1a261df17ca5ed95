// The chart: the highest bump crossed with contact against speed, the limits that one finds by hand,
// and the bump itself as a line across, which one can take hold of.

import { drawAxes, drawLine, logFrame } from "./axes.js";
import { clamp, show, trace } from "./pen.js";
import { distinct } from "./words.js";

const REACH = 24; // pixels around the line that one can take hold of
const MM = 1000;

export const chartPanel = {
  name: "chart",
  title: "The highest bump crossed with contact, at every speed",
  key: ({ settings: { k, c, height, sigma } }) => [k, c, height, sigma],
  still(pen, scene) {
    const { w, h, stroke, fill, text, inside } = pen,
      { curve, data, settings, highestBumps } = scene;
    const frame = logFrame(w, h, data.ranges.v, data.chart.heights, 46),
      { left, right, top, bottom, px, py } = frame;
    const y = clamp(py(settings.height), top, bottom); // of the bump
    this.frame = { ...frame, y };
    text(show(MM * settings.height, settings.height < 1e-4 ? 2 : 3), left - 6, y + 4, {
      align: "right",
      colour: "ink",
      bold: true,
      halo: true,
    }); // first, so that a number of the axis gives way
    drawAxes(pen, frame, ["speed v (m/s)", "Bump height (mm)"], MM);
    pen.legend(138, 13, right, [
      { words: "highest with contact", colour: "ink", width: 3, ink: "ink" },
      ...(data.chart.limits.length
        ? [{ words: "limits by hand", colour: "soft", width: 1.2, dash: [6, 4] }]
        : []),
    ]);
    let nameLimits = [];
    inside(left, top, right - left, bottom - top, () => {
      const own = trace(
        highestBumps,
        (n) => px(curve.speeds[n]),
        (height) => clamp(py(height), -h, 2 * h),
        Infinity,
      );
      const above = new Path2D(own);
      for (const x of [right, left]) above.lineTo(x, -h);
      fill("alarm", 0.1, above);
      nameLimits = data.chart.limits.map((limit) => drawLimit(pen, limit, settings, this.frame));
      stroke("ink", 3, [], own);
    });
    drawBump(pen, scene, this.frame);
    for (const name of nameLimits) if (name) name();
  },
  grab(_x, y) {
    const { top, bottom, ends } = this.frame,
      [low, high] = ends.slice(2);
    if (Math.abs(y - this.frame.y) > REACH) return null;
    const to = (_x2, y2) => {
      const share = clamp((bottom - y2) / (bottom - top), 0, 1);
      return { height: Number((low * (high / low) ** share).toPrecision(3)) };
    };
    return { cursor: "ns-resize", to };
  },
};

/** The height of a limit at a speed: a product of powers that Python handed over. */
export const limitAt = ({ amplitude, powers: of }, settings, v) =>
  Object.entries(of).reduce(
    (height, [name, power]) => height * (name === "v" ? v : settings[name]) ** power,
    amplitude,
  );

/**
 * A limit as a thin line; there is none that a damper makes where there is no damper. What comes back
 * writes its name.
 */
function drawLimit(pen, limit, settings, frame) {
  const heights = frame.ends.slice(0, 2).map((v) => frame.py(limitAt(limit, settings, v)));
  return heights.every(Number.isFinite) && drawLine(pen, limit.name, heights, frame, frame.y);
}

/** The bump across: thick where contact is kept, with the critical speeds and those asked for. */
function drawBump({ stroke, line, dot, text }, { curve: { critical, kept }, data }, frame) {
  const { px, y, left, right, bottom } = frame,
    edges = [data.ranges.v[0], ...critical, data.ranges.v[1]].map(px);
  edges.slice(1).forEach((b, i) => {
    const a = edges[i],
      good = kept === (i % 2 === 0);
    stroke(good ? "region" : "alarm", good ? 5 : 2, good ? [] : [3, 3]);
    line(a, y, b, y);
    if (b - a > 34)
      text(good ? "kept" : "lost", (a + b) / 2, y - 10, {
        align: "center",
        colour: good ? "region" : "alarm",
        bold: true,
        halo: true,
      });
  });
  for (const v of data.asked) dot(px(v), y, 4.5, "paper", "ink", 1.5);
  const names = distinct(critical),
    rows = y + 36 < bottom ? [20, 34] : [-22, -36]; // where there is room for the numbers
  critical.forEach((v, i) => {
    dot(px(v), y, 4.5, "ink");
    const x = clamp(px(v), left + 14, right - 14); // if there is none, the words above have them all
    rows.some((row) =>
      text(names[i], x, y + row, { align: "center", colour: "ink", bold: true, halo: true }),
    );
  });
}
