// The margin over speed and stiffness: a picture that is computed in small portions, row by row.

import { makeLeast, makeRoad, makeRobot } from "./model.js";
import { clamp, powers, show } from "./pen.js";

const ROWS = 28; // stiffnesses
const COLUMNS = 64; // speeds
const PORTION = 8; // ms of computing between two frames

const between = ([low, high], part) => low * (high / low) ** part;

/** A map for a damping and a bump that is filled by `work`, which tells whether there is more to do. */
export function makeMap(data, settings) {
  const { c, height, sigma } = settings,
    road = makeRoad(data.shape, settings);
  const speeds = Array.from({ length: COLUMNS }, (_, j) => between(data.ranges.v, j / (COLUMNS - 1)));
  const stiffnesses = Array.from({ length: ROWS }, (_, i) => between(data.ranges.k, i / (ROWS - 1)));
  const map = { speeds, stiffnesses, margins: [], key: ["map", c, height, sigma, 0], work };
  function work() {
    if (map.margins.length === ROWS) return false;
    const start = performance.now();
    while (map.margins.length < ROWS && performance.now() - start < PORTION) {
      const k = stiffnesses[map.margins.length];
      const leastAt = makeLeast(data, makeRobot(data, { ...settings, k }), road);
      map.margins.push(speeds.map((v) => Math.min(...leastAt(v))));
    }
    map.key = ["map", c, height, sigma, map.margins.length];
    return true; // also to draw the last portion
  }
  return map;
}

/** Draw a map as far as it is known; where things are in it. */
export function drawMap({ w, h, shade, stroke, line, text, legend, inside, dot }, { data, robot }, map) {
  const [left, right, top, bottom] = [44, w - 12, 26, h - 33];
  const [speeds, stiffnesses] = [data.ranges.v, data.ranges.k].map((ends) => ends.slice(0, 2));
  const ratio = Math.log(speeds[1] / speeds[0]),
    rise = Math.log(stiffnesses[1] / stiffnesses[0]);
  const px = (v) => left + ((right - left) * Math.log(v / speeds[0])) / ratio;
  const py = (k) => bottom - ((bottom - top) * Math.log(k / stiffnesses[0])) / rise;
  const stiffness = (y) =>
    stiffnesses[0] * Math.exp((rise * clamp(bottom - y, 0, bottom - top)) / (bottom - top));
  text("At every v and k", 0, 13, { colour: "ink", bold: true });
  legend(right - 114, 13, right, [
    { words: "kept", colour: "region", width: 8, alpha: 0.5 },
    { words: "lost", colour: "alarm", width: 8, alpha: 0.5 },
  ]);
  const rest = Math.max(...robot.weight),
    [cw, ch] = [(right - left) / (COLUMNS - 1), (bottom - top) / (ROWS - 1)];
  inside(left, top, right - left, bottom - top, () => {
    // Neighbours share an edge on a whole pixel, or seams would show.
    const x = (j) => Math.round(left + (j - 0.5) * cw),
      y = (i) => Math.round(bottom - (i - 0.5) * ch);
    map.margins.forEach((row, i) => {
      row.forEach((margin, j) => {
        const depth = margin > 0 ? margin / rest : clamp(-margin / (3 * rest), 0, 1),
          colour = margin > 0 ? "region" : "alarm";
        shade(colour, 0.12 + 0.55 * depth, x(j), y(i + 1), x(j + 1) - x(j), y(i) - y(i + 1));
      });
    });
    stroke("ink", 1.8);
    for (const [a, b] of zeroLine(map)) line(px(a[0]), py(a[1]), px(b[0]), py(b[1]));
    for (const v of data.asked) dot(px(v), py(data.own.k), 3.5, "paper", "ink", 1.5);
  });
  stroke("soft", 1);
  for (const v of powers(...speeds)) {
    line(px(v), bottom, px(v), bottom + 4);
    text(show(v), px(v), bottom + 15, { align: "center" });
  }
  for (const k of powers(...stiffnesses)) {
    line(left - 4, py(k), left, py(k));
    text(show(k, 4), left - 6, py(k) + 4, { align: "right" });
  }
  text("speed v (m/s)", right, h - 4, { align: "right" });
  text("k (N/m)", left, h - 4);
  return { left, right, top, bottom, px, py, lowest: speeds[0], ratio, stiffness };
}

/** Where the margin is zero: short straight lines through the squares of the map. */
export function zeroLine({ margins, speeds, stiffnesses }) {
  const lines = [];
  for (let i = 1; i < margins.length; i++) {
    for (let j = 1; j < speeds.length; j++) {
      const corners = [
        [i - 1, j - 1],
        [i - 1, j],
        [i, j],
        [i, j - 1],
      ];
      const points = [];
      corners.forEach(([p, q], n) => {
        const [r, s] = corners[(n + 1) % 4],
          [a, b] = [margins[p][q], margins[r][s]];
        if (a > 0 === b > 0) return;
        const part = a / (a - b);
        points.push([
          speeds[q] + part * (speeds[s] - speeds[q]),
          stiffnesses[p] + part * (stiffnesses[r] - stiffnesses[p]),
        ]);
      });
      for (let n = 1; n < points.length; n += 2) lines.push([points[n - 1], points[n]]);
    }
  }
  return lines;
}
