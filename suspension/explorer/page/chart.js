// The chart: the highest bump crossed with contact against speed, the limits that one finds by hand,
// and the bump itself as a line across, which one can take hold of.

import { clamp, powers, show, trace } from "./pen.js";
import { distinct } from "./words.js";

const REACH = 24; // pixels around the line that one can take hold of
const MM = 1000;

export const chartPanel = {
  name: "chart",
  title: "The highest bump crossed with contact, at every speed",
  key: ({ settings: { k, c, height, sigma } }) => [k, c, height, sigma],
  still(pen, scene) {
    const { w, h, stroke, fill, line, text, inside } = pen,
      { curve, data, settings, highestBumps } = scene;
    const [left, right, top, bottom] = [46, w - 12, 24, h - 33],
      [slow, fast] = data.ranges.v,
      [low, high] = data.chart.heights;
    const px = (v) => left + ((right - left) * Math.log(v / slow)) / Math.log(fast / slow);
    const py = (height) => bottom - ((bottom - top) * Math.log(height / low)) / Math.log(high / low);
    const y = clamp(py(settings.height), top, bottom); // of the bump
    this.frame = { left, right, top, bottom, px, py, y, low, high };
    text("Bump height (mm)", 0, 13, { colour: "ink", bold: true });
    pen.legend(138, 13, right, [
      { words: "highest with contact", colour: "ink", width: 3, ink: "ink" },
      ...(data.chart.limits.length
        ? [{ words: "limits by hand", colour: "soft", width: 1.2, dash: [6, 4] }]
        : []),
    ]);
    text("speed v (m/s)", right, h - 4, { align: "right" });
    text(show(MM * settings.height, settings.height < 1e-4 ? 2 : 3), left - 6, y + 4, {
      align: "right",
      colour: "ink",
      bold: true,
      halo: true,
    }); // first, so that a number of the axis gives way
    for (const v of powers(slow, fast)) {
      stroke("soft", 1);
      line(px(v), bottom, px(v), bottom + 4);
      text(show(v), px(v), bottom + 15, { align: "center" });
    }
    for (const mm of powers(MM * low, MM * high)) {
      stroke("line", 1);
      line(left, py(mm / MM), right, py(mm / MM));
      text(show(mm), left - 6, py(mm / MM) + 4, { align: "right" });
    }
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
      for (const limit of data.chart.limits) drawLimit(pen, limit, settings, this.frame, slow, fast);
      stroke("ink", 3, [], own);
    });
    drawBump(pen, scene, this.frame);
    for (const limit of data.chart.limits) nameLimit(pen, limit, settings, this.frame, slow, fast);
  },
  grab(_x, y) {
    const { top, bottom, low, high } = this.frame;
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

/** Where a limit begins and ends in the picture, or null: without a damper there is no skim. */
function endsOf(limit, settings, { px, py }, slow, fast) {
  const ends = [slow, fast].map((v) => [px(v), py(limitAt(limit, settings, v))]);
  return ends.every(([, y]) => Number.isFinite(y)) ? ends : null;
}

/** A limit as a thin line. */
function drawLimit({ stroke, line }, limit, settings, frame, slow, fast) {
  const ends = endsOf(limit, settings, frame, slow, fast);
  stroke("soft", 1.2, [6, 4]);
  if (ends) line(...ends.flat());
}

/** Its name along it, where it is seen and there is room. */
function nameLimit({ g, text }, limit, settings, frame, slow, fast) {
  const line = endsOf(limit, settings, frame, slow, fast);
  if (!line) return;
  const { left, right, top, bottom } = frame,
    [from, to] = line,
    slope = (to[1] - from[1]) / (to[0] - from[0]),
    ends = [top + 16, bottom - 6].map((y) => clamp(from[0] + (y - from[1]) / slope, left, right));
  if (Math.abs(ends[1] - ends[0]) < 40) return;
  const places = [0.3, 0.15, 0.6, 0.45, 0.75].map((share) => {
    const x = ends[0] + share * (ends[1] - ends[0]);
    return [x, from[1] + slope * (x - from[0])];
  });
  const write = (place) => {
    g.save();
    g.translate(...place);
    g.rotate(Math.atan(slope));
    const written = text(limit.name, 0, -5, { align: "center", halo: true });
    g.restore();
    return written;
  };
  const isAway = ([, y]) => Math.abs(y - frame.y) > 20; // from the bump
  places.filter(isAway).some(write) || places.some(write);
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
