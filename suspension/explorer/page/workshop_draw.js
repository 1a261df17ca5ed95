// The pictures of the workshop: the region with the modes, the imaginary axis, forces, error and work.

import { clamp, show, ticks, trace } from "./pen.js";
import { growthAt, reach } from "./tableau.js";

const GRIP = 5; // half a handle of the border, pixels
const CELLS = 80; // of the region's picture, across
export const IN = 1e-12; // roundoff of |R| = 1 counts as stable
const TALL = 4.5; // of the region's window, from its middle, at least
export const PHASES = 3; // of the imaginary axis, rad

/** Half the height of a window that shows the modes: the usual one doubled until they are in. */
export function windowOf(points) {
  let half = TALL;
  while (points.some(([re, im]) => Math.abs(im) > 0.95 * half || -re > 1.2 * half)) half *= 2;
  return half;
}

/** |P|² - |Q|² over their sum, without arrays: negative where the method is stable. */
export function slackAt(P, Q, re, im) {
  const above = sizeAt(P, re, im),
    below = sizeAt(Q, re, im);
  return above + below > 0 ? (above - below) / (above + below) : 0;
}

/** |p|² of a real polynomial. */
function sizeAt(p, re, im) {
  let x = 0,
    y = 0;
  for (let j = p.length - 1; j >= 0; j--) {
    const kept = x * re - y * im + p[j];
    y = x * im + y * re;
    x = kept;
  }
  return x * x + y * y;
}

/** The region in a frame, as a path to fill, and its border, by cells and straight lines in them; points of it. */
function regionPath({ P, Q }, { left, right, top, bottom, zx, zy }) {
  const nx = CELLS,
    ny = Math.max(8, Math.round((CELLS * (bottom - top)) / (right - left)));
  const xs = Array.from({ length: nx + 1 }, (_, i) => left + ((right - left) * i) / nx),
    ys = Array.from({ length: ny + 1 }, (_, j) => top + ((bottom - top) * j) / ny);
  const values = ys.map((y) => Float64Array.from(xs, (x) => slackAt(P, Q, zx(x), zy(y))));
  const area = new Path2D(),
    border = new Path2D(),
    points = [];
  for (let j = 0; j < ny; j++) {
    let from = -1; // where a row of whole cells began
    const close = (i) => {
      if (from >= 0) area.rect(xs[from], ys[j], xs[i] - xs[from], ys[j + 1] - ys[j]);
      from = -1;
    };
    for (let i = 0; i < nx; i++) {
      const [low, high] = [values[j], values[j + 1]];
      const inside = (low[i] <= IN) + (low[i + 1] <= IN) + (high[i + 1] <= IN) + (high[i] <= IN);
      if (inside === 4) {
        if (from < 0) from = i;
        continue;
      }
      close(i);
      if (!inside) continue;
      const corners = [
        [xs[i], ys[j], values[j][i]],
        [xs[i + 1], ys[j], values[j][i + 1]],
        [xs[i + 1], ys[j + 1], values[j + 1][i + 1]],
        [xs[i], ys[j + 1], values[j + 1][i]],
      ];
      const polygon = [],
        crossings = [];
      corners.forEach(([x, y, f], k) => {
        const [u, w, g] = corners[(k + 1) % 4];
        if (f <= IN) polygon.push([x, y]);
        if (f <= IN !== g <= IN) {
          const share = clamp(f / (f - g), 0, 1),
            crossing = [x + share * (u - x), y + share * (w - y)];
          polygon.push(crossing);
          crossings.push(crossing);
        }
      });
      polygon.forEach(([x, y], k) => (k ? area.lineTo(x, y) : area.moveTo(x, y)));
      area.closePath();
      for (let k = 0; k + 1 < crossings.length; k += 2) {
        border.moveTo(...crossings[k]);
        border.lineTo(...crossings[k + 1]);
        points.push(crossings[k]);
      }
    }
    close(nx);
  }
  return { area, border, points };
}

/**
 * The region, dashed the border of the one to compare with, the modes at the present step, and handles
 * in some directions, where one takes hold of the border. Gives the frame and points of the border.
 */
export function drawRegion(p, R, other, points, directions = []) {
  const { w, h } = p,
    half = windowOf(points),
    [left, right, top, bottom] = [4, w - 4, 22, h - 20];
  const unit = (bottom - top) / (2 * half),
    zero = [left + 0.66 * (right - left), (top + bottom) / 2];
  const frame = {
    ...{ left, right, top, bottom },
    px: (x) => zero[0] + unit * x,
    py: (y) => zero[1] - unit * y,
    zx: (x) => (x - zero[0]) / unit,
    zy: (y) => (zero[1] - y) / unit,
  };
  const { px, py } = frame,
    seen = regionPath(R, frame);
  p.text("Stable where |R(z)| ≤ 1", 0, 13, { colour: "ink", bold: true });
  p.inside(left, top, right - left, bottom - top, () => {
    p.fill("region", 0.25, seen.area);
    p.stroke("region", 1.5, [], seen.border);
    if (other) p.stroke("ink", 1.2, [4, 4], regionPath(other, frame).border);
    p.stroke("soft", 1);
    p.line(left, py(0), right, py(0));
    p.line(px(0), top, px(0), bottom);
  });
  for (const x of ticks(frame.zx(left), frame.zx(right), 6))
    p.text(show(x), px(x), bottom + 15, { align: "center" });
  for (const y of ticks(-half, half, 5)) if (y) p.text(show(y), px(0) + 4, py(y) + 4);
  for (const z of points) {
    const grows = !(slackAt(R.P, R.Q, ...z) <= IN),
      [x, y] = [clamp(px(z[0]), left, right), clamp(py(z[1]), top, bottom)];
    p.dot(x, y, 5, grows ? "alarm" : "paper", grows ? "alarm" : "ink", 2);
  }
  for (const direction of directions) {
    const far = reach(R, direction),
      [x, y] = [px(far * direction[0]), py(far * direction[1])];
    if (!(far > 0 && x > left && x < right && y > top && y < bottom)) continue;
    const grip = new Path2D();
    grip.rect(x - GRIP, y - GRIP, 2 * GRIP, 2 * GRIP);
    p.fill("paper", 1, grip);
    p.stroke("region", 2.5, [], grip);
  }
  return { frame, border: seen.points };
}

/** |R(iy)| and its phase over y, unwrapped, on [0, PHASES]: pairs of lists. */
export function alongAxis(R, count = 121) {
  const ys = Array.from({ length: count }, (_, i) => (PHASES * i) / (count - 1));
  const sizes = [],
    phases = [];
  let angle = 0;
  for (const y of ys) {
    const [re, im] = growthAt(R, [0, y]),
      turn = Math.atan2(im, re);
    angle = turn + 2 * Math.PI * Math.round((angle - turn) / (2 * Math.PI));
    sizes.push(Math.hypot(re, im));
    phases.push(y ? angle / y : 1);
  }
  return { ys, sizes, phases };
}

export function drawAxis(p, R, other, mark) {
  const { w, h } = p,
    [left, right, top, bottom] = [30, w - 8, 40, h - 33],
    most = 1.6;
  const px = (y) => left + ((right - left) * y) / PHASES,
    py = (x) => bottom - ((bottom - top) * x) / most;
  p.text("Undamped swings, z = iy", 0, 13, { colour: "ink", bold: true });
  p.legend(left, 31, right, [
    { words: "|R|", colour: "rear", width: 2 },
    { words: "phase of R, over y", colour: "front", width: 2, dash: [6, 3] },
  ]);
  for (const x of [0, 0.5, 1, 1.5]) {
    p.stroke(x === 1 ? "soft" : "line", 1);
    p.line(left, py(x), right, py(x));
    p.text(show(x), left - 5, py(x) + 4, { align: "right" });
  }
  for (const y of ticks(0, PHASES, 3)) p.text(show(y), px(y), bottom + 15, { align: "center" });
  p.text("y", right, bottom + 29, { align: "right" });
  p.inside(left, top, right - left, bottom - top, () => {
    for (const [R_, pale] of other
      ? [
          [other, true],
          [R, false],
        ]
      : [[R, false]]) {
      const { sizes, phases } = alongAxis(R_),
        at = (i) => px((PHASES * i) / (sizes.length - 1));
      p.g.globalAlpha = pale ? 0.4 : 1;
      p.stroke("rear", 2, [], trace(sizes, at, py, w));
      p.stroke("front", 2, [6, 3], trace(phases, at, py, w));
      p.g.globalAlpha = 1;
    }
    p.stroke("ink", 1, [2, 3]);
    p.line(px(mark), top, px(mark), bottom);
  });
  if (mark < PHASES) p.text("the robot", px(mark) + 4, bottom - 5, { colour: "ink", halo: true });
}

/** Both forces on the way: the exact ones broad and pale, the run's thin, dashed the one to compare. */
export function drawForces(p, tried, other, { distance }) {
  const { w, h } = p,
    [left, right, top, bottom] = [34, w - 8, 40, h - 33],
    { run, exact } = tried;
  let [low, high] = [0, 0];
  for (const N of exact.run.N)
    for (const x of N.subarray(0, exact.run.J + 1)) [low, high] = [Math.min(low, x), Math.max(high, x)];
  const room = 0.15 * (high - low);
  [low, high] = [low - room, high + room];
  const px = (X) => left + ((right - left) * X) / distance,
    py = (N) => bottom - ((bottom - top) * (N - low)) / (high - low);
  p.text("Normal forces (N)", 0, 13, { colour: "ink", bold: true });
  p.legend(left, 31, right, [
    { words: "rear", colour: "rear", width: 2 },
    { words: "front", colour: "front", width: 2 },
    { words: "exact", colour: "soft", width: 6, alpha: 0.4 },
    ...(other ? [{ words: "compared", colour: "ink", width: 1.5, dash: [4, 3] }] : []),
  ]);
  for (const N of ticks(low, high, 7)) {
    p.stroke(N === 0 ? "soft" : "line", 1);
    p.line(left, py(N), right, py(N));
    p.text(show(N), left - 5, py(N) + 4, { align: "right" });
  }
  for (const X of ticks(0, distance, 5)) p.text(show(X), px(X), bottom + 15, { align: "center" });
  p.text("X (m)", right, bottom + 29, { align: "right" });
  const curve = ({ N, dt, v, J }, i) => trace(N[i].subarray(0, J + 1), (n) => px(v * dt * n), py, 2 * w);
  p.inside(left, top, right - left, bottom - top, () => {
    for (const [i, colour] of ["rear", "front"].entries()) {
      p.g.globalAlpha = 0.35;
      p.stroke(colour, 6, [], curve(exact.run, i));
      p.g.globalAlpha = 1;
      if (other?.run) p.stroke("ink", 1.5, [4, 3], curve(other.run, i));
      if (run) p.stroke(colour, 2, [], curve(run, i));
    }
  });
}

const LEAST = 1e-10,
  MOST = 1e3; // N, ends of the picture of the error

/** The largest error of a force against stages times steps, both logarithmic; a dot for the run. */
export function drawWork(p, curves, dot) {
  const { w, h } = p,
    [left, right, top, bottom] = [38, w - 8, 40, h - 33],
    [x0, x1] = [8, 12288];
  const px = (x) => left + ((right - left) * Math.log(x / x0)) / Math.log(x1 / x0),
    py = (y) =>
      bottom - ((bottom - top) * Math.log(clamp(y, LEAST / 10, 10 * MOST) / LEAST)) / Math.log(MOST / LEAST);
  p.text("Largest error of a force (N)", 0, 13, { colour: "ink", bold: true });
  p.legend(left, 31, right, [
    { words: "yours", colour: "rear", width: 2 },
    ...(curves.length > 1 ? [{ words: "compared", colour: "ink", width: 1.5, dash: [4, 3] }] : []),
  ]);
  for (let y = LEAST; y <= 1.01 * MOST; y *= 100) {
    p.stroke("line", 1);
    p.line(left, py(y), right, py(y));
    p.text(show(Number(y.toPrecision(1)), 1).replace(/^1\s×\s/, ""), left - 5, py(y) + 4, { align: "right" });
  }
  for (const x of [10, 100, 1000, 10000]) {
    p.stroke("line", 1);
    p.line(px(x), top, px(x), bottom);
    p.text(show(x), px(x), bottom + 15, { align: "center" });
  }
  p.text("work: stages × steps", right, bottom + 29, { align: "right" });
  p.inside(left, top, right - left, bottom - top, () => {
    curves.forEach((pairs, k) => {
      const path = new Path2D();
      for (const [work, error] of pairs) path.lineTo(px(work), py(error));
      p.stroke(k ? "ink" : "rear", k ? 1.5 : 2, k ? [4, 3] : [], path);
      if (!k) for (const [work, error] of pairs) p.dot(px(work), py(error), 3, "rear");
    });
    p.dot(px(clamp(dot.work, x0, x1)), py(dot.error), 6, "paper", "ink", 2);
  });
}
