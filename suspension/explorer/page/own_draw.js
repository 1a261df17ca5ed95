// The pictures of one's own robot and road: its place on the chart of the highest bump, the road, and the
// forces along the way.

import { drawAxes, drawLine, drawScales, linearFrame } from "./axes.js";
import { heightAt } from "./own_run.js";
import { limitOf } from "./own_scene.js";
import { UNITS } from "./own_state.js";
import { clamp, powers, show } from "./pen.js";

export const INSET = { left: 44, right: 12, top: 24, bottom: 33 }; // of the road and the forces
const CHART = { left: 44, right: 50, top: 56, bottom: 33 }, // room for a second scale
  NUS = [0.1, 26],
  ETAS = [0.1, 100],
  DASH = [[], [7, 4]], // rear solid, front dashed
  COLOURS = ["rear", "front"],
  BODY = 34; // pixels above the wheels

// ---- the chart

/** The chart's frame, in nu and eta; its ends in eta go by tens, so that the vehicle is seen. */
export function chartFrame(w, h, { twin, isLevel }) {
  const eta = isLevel ? 1 : Math.abs(twin.eta),
    low = Math.min(ETAS[0], 10 ** Math.floor(Math.log10(eta))),
    high = Math.max(ETAS[1], 10 ** Math.ceil(Math.log10(eta))),
    [left, right, top, bottom] = [CHART.left, w - CHART.right, CHART.top, h - CHART.bottom];
  return {
    ...{ left, right, top, bottom, ends: [...NUS, low, high] },
    px: (nu) => left + ((right - left) * Math.log(nu / NUS[0])) / Math.log(NUS[1] / NUS[0]),
    py: (eta) => bottom - ((bottom - top) * Math.log(eta / low)) / Math.log(high / low),
    nuAt: (x) => NUS[0] * (NUS[1] / NUS[0]) ** clamp((x - left) / (right - left), 0, 1),
    etaAt: (y) => low * (high / low) ** clamp((bottom - y) / (bottom - top), 0, 1),
  };
}

/** Where the vehicle stands in the frame; at its edge if it is outside. */
export function placeOf({ twin }, { px, py, left, right, top, bottom }) {
  return [clamp(px(twin.nu), left, right), clamp(py(Math.abs(twin.eta)), top, bottom)];
}

export function drawChart(p, scene, facts) {
  const { state, groups, unit, isLevel, curve, standIn, twin, shape, multiple } = scene,
    frame = chartFrame(p.w, p.h, scene),
    { left, right, top, bottom, px, py, ends } = frame,
    { speed, length } = UNITS[state.units],
    size = shape.height < 0 ? "depth" : "height",
    [v1, h1] = [speed[0] * unit.v, length[0] * unit.sag]; // of nu = 1 and eta = 1, as one reads them
  const inUnits = { ...frame, ends: [v1 * ends[0], v1 * ends[1], h1 * ends[2], h1 * ends[3]] };
  inUnits.px = (v) => px(v / v1);
  inUnits.py = (height) => py(height / h1);
  if (groups) {
    drawAxes(p, frame, ["speed ν", `${size} η`]);
    drawSecond(p, inUnits, `speed (${speed[1]})`, `${size} (${length[1]})`);
  } else drawAxes(p, inUnits, [`speed (${speed[1]})`, `${size} (${length[1]})`]);
  p.legend(left + 70, 13, right, [
    { words: "highest with contact", colour: "ink", width: 3, ink: "ink" },
    ...(standIn ? [{ words: "of the bump alike", colour: "region", width: 1.5, dash: [2, 3] }] : []),
    ...(groups && shape.height > 0 ? [{ words: "by hand", colour: "soft", width: 1.2, dash: [6, 4] }] : []),
  ]);
  if (isLevel) return;
  let names = [];
  const trace = ({ v, multiple }) => {
    const path = new Path2D();
    v.forEach((speed, i) => {
      const y = multiple[i] === Infinity ? -p.h : py(Math.abs(twin.eta) * multiple[i]);
      path.lineTo(px(speed / unit.v), clamp(y, -p.h, 2 * p.h));
    });
    return path;
  };
  const [x, y] = placeOf(scene, frame);
  p.inside(left, top, right - left, bottom - top, () => {
    if (curve) {
      const above = trace(curve);
      above.lineTo(px(curve.v.at(-1) / unit.v), -p.h);
      above.lineTo(px(curve.v[0] / unit.v), -p.h);
      p.fill("alarm", 0.1, above);
    }
    if (groups && shape.height > 0)
      names = facts.byHand.map((limit) => {
        const heights = NUS.map((nu) => py(limitOf(limit, { ...groups, nu })));
        return heights.every(Number.isFinite) ? drawLine(p, limit.name, heights, frame, y) : () => {};
      });
    if (standIn) p.stroke("region", 1.5, [2, 3], trace(standIn));
    if (curve) p.stroke("ink", 3, [], trace(curve));
    p.stroke("soft", 1, [2, 3]);
    p.line(left, y, right, y);
    p.line(x, top, x, bottom);
  });
  const isKept = multiple > 1;
  p.dot(x, y, 9, "paper", isKept ? "region" : "alarm", 3);
  p.dot(x, y, 4, isKept ? "region" : "alarm");
  const words = isKept ? "kept" : "lost",
    isLeft = x > right - 60;
  p.text(words, x + (isLeft ? -14 : 14), y - 10, {
    align: isLeft ? "right" : "left",
    colour: isKept ? "region" : "alarm",
    bold: true,
    halo: true,
  });
  for (const name of names) name();
}

/** The scales above and on the right: what nu and eta are for this vehicle. */
function drawSecond({ stroke, line, text }, { left, right, top, bottom, ends, px, py }, ofX, ofY) {
  const [x0, x1, y0, y1] = ends;
  stroke("soft", 1);
  line(left, top, right, top, right, bottom);
  text(ofX, left, top - 22);
  text(ofY, right + 48, top - 22, { align: "right" });
  for (const x of powers(x0, x1)) {
    line(px(x), top, px(x), top - 4);
    text(show(x), px(x), top - 7, { align: "center" });
  }
  for (const y of powers(y0, y1)) {
    if (!/^[15]/.test(y.toExponential())) continue;
    line(right, py(y), right + 4, py(y));
    text(show(y), right + 7, py(y) + 4);
  }
}

// ---- the road

/** What of the road is seen: places in m, and heights, in m, up to round ones. */
export function roadView({ shape, pieces, unit, isBump, state: { robot } }) {
  const { from, to } = shape,
    margin = Math.max(0.05 * (to - from), 0.6 * (robot.L1 + robot.L2));
  let [low, high] = [0, 0];
  if (isBump) high = shape.height;
  else for (const h of shape.points.h) [low, high] = [Math.min(low, h), Math.max(high, h)];
  const reach = Math.max(high, -low) || unit.sag;
  return {
    x: [from - margin, to + margin],
    y: [1.4 * Math.min(low, -0.3 * reach), 2.1 * Math.max(high, 0.35 * reach)],
    begin: heightAt(pieces, from),
  };
}

export const roadFrame = (w, h, { x, y }) => linearFrame(w, h, x, y, INSET);

export function drawRoad(p, scene, view, pen) {
  const { state, shape, pieces, lost, least, vehicle, isLevel, isTooLong } = scene,
    frame = roadFrame(p.w, p.h, view),
    { left, right, top, bottom, px, py, x: ends } = frame,
    [factor, unit] = UNITS[state.units].length;
  drawScales(p, frame, ["along the road x (m)", `height of the road (${unit})`], factor);
  p.inside(left, top, right - left, bottom - top, () => {
    const line = new Path2D(),
      places = Array.from({ length: 301 }, (_, i) => ends[0] + ((ends[1] - ends[0]) * i) / 300);
    for (const { x } of pieces) if (shape.points && x > ends[0] && x < ends[1]) places.push(x);
    places.sort((a, b) => a - b);
    for (const x of places) line.lineTo(px(x), py(heightAt(pieces, x)));
    const ground = new Path2D(line);
    ground.lineTo(right, bottom + 20);
    ground.lineTo(left, bottom + 20);
    p.fill("ground", 1, ground);
    p.stroke("ink", 2, [], line);
    if (shape.points && shape.points.x.length <= 60)
      shape.points.x.forEach((x, i) => p.dot(px(x), py(shape.points.h[i]), 2, "ink"));
    if (!isTooLong && !isLevel) {
      const wheel = lost ? lost.wheel : least[0].force <= least[1].force ? 0 : 1;
      drawRobot(p, scene, frame, lost ? lost.X : least[wheel].X, wheel);
    }
  });
  if (pen) p.dot(px(pen.x), clamp(py(pen.h), top, bottom), 6, "paper", "ink", 2);
  return vehicle;
}

/** The robot on the road, where the wheel that matters lifts, or presses least. */
function drawRobot(p, { vehicle, pieces, track, lost }, { px, py, top }, X, wheel) {
  const n = Math.max(
      0,
      track.ends.findIndex((end) => end >= X),
    ),
    [Y, , theta] = track.states[n],
    wheels = vehicle.arms.map((arm) => ({ x: px(X + arm), road: py(heightAt(pieces, X + arm)) })),
    // So far above the ground at rest, and moved by what the body moves; but not out of sight.
    moved = vehicle.arms.map((arm) => py(Y + arm * theta) - BODY),
    back = Math.max(0, top + 8 - Math.min(...moved)),
    body = moved.map((y) => y + back);
  wheels.forEach(({ x, road }, i) => {
    p.stroke(COLOURS[i], 2.5);
    p.line(x, road - 5, x, body[i]);
    const lifts = lost && i === wheel;
    p.dot(x, road - (lifts ? 9 : 5), 5, "paper", lifts ? "alarm" : COLOURS[i], 2.5);
  });
  p.stroke("ink", 4, []);
  p.line(wheels[0].x, body[0], wheels[1].x, body[1]);
  const { x, road } = wheels[wheel];
  p.text(lost ? "lifts here" : "least force", x, Math.max(road + 16, 16), {
    align: "center",
    colour: lost ? "alarm" : "ink",
    bold: true,
    halo: true,
  });
}

// ---- the forces

export function drawForces(p, scene) {
  const { vehicle, track, distance, lost, isTooLong } = scene;
  if (isTooLong) return;
  const end = lost ? lost.X : distance;
  let [low, high] = [0, Math.max(...vehicle.load)];
  track.X.forEach((X, n) => {
    if (X <= end) for (const N of track.N) [low, high] = [Math.min(low, N[n]), Math.max(high, N[n])];
  });
  const frame = linearFrame(
      p.w,
      p.h,
      [0, distance],
      [low - 0.08 * (high - low), high + 0.05 * (high - low)],
      INSET,
    ),
    { left, right, top, bottom, px, py } = frame;
  drawScales(p, frame, ["place of the robot X (m)", "normal force (N)"]);
  p.legend(left + 90, 13, right, [
    { words: "rear", colour: "rear", width: 2, ink: "ink" },
    { words: "front", colour: "front", width: 2, dash: DASH[1], ink: "ink" },
    ...(lost ? [{ words: "the model ends", colour: "alarm", width: 2, dash: [2, 3] }] : []),
  ]);
  p.inside(left, top, right - left, bottom - top, () => {
    p.stroke("ink", 1, []);
    p.line(left, py(0), right, py(0));
    for (const i of [0, 1]) {
      const path = new Path2D();
      track.X.forEach((X, n) => {
        if (X <= end) path.lineTo(px(X), clamp(py(track.N[i][n]), -p.h, 2 * p.h));
      });
      p.stroke(COLOURS[i], 2, DASH[i], path);
    }
    if (!lost) return;
    p.stroke("alarm", 2, [2, 3]);
    p.line(px(lost.X), top, px(lost.X), bottom);
    p.shade("alarm", 0.08, px(lost.X), top, right - px(lost.X), bottom - top);
    p.dot(px(lost.X), py(0), 5, "paper", "alarm", 2.5);
  });
  if (lost)
    p.text("contact lost", Math.min(px(lost.X) + 8, right - 78), top + 14, {
      colour: "alarm",
      bold: true,
      halo: true,
    });
}
