// The three panels. Each draws one scene: what was computed, and the moment shown.

import { clamp, show, ticks } from "./pen.js";

export const WHEEL = ["rear", "front"];
const NAMES = ["N₁", "N₂"];
const FAR = 5000; // pixels
const DASH = [[], [7, 4]]; // rear solid, front dashed

/** The robot on the road, one scale for both directions; the picture moves along with it. */
export function drawRobot({ g, w, h, stroke, fill, line, dot, text }, { data, run, now }) {
  const { road, wheels } = data, length = wheels[1] - wheels[0];
  const scale = w / (length * clamp(w / 230, 2, 2.9)); // pixels a metre
  const X = run.v * now.t, u = new Float64Array(4), spot = new Float64Array(4);
  wheels.forEach((offset, i) => road(X + offset, u, i, 0));
  const level = (u[0] + u[1]) / 2, climb = level - clamp(level, -0.03, 0.03); // up and down hills
  const px = (x) => w / 2 + (x - X) * scale, py = (y) => h - 44 - (y - climb) * scale;

  g.beginPath();
  for (let x = 0; x <= w + 2; x += 2) {
    road(X + (x - w / 2) / scale, spot, 0, 0);
    g.lineTo(x, py(spot[0]));
  }
  stroke("soft", 1.2);
  g.stroke();
  g.lineTo(w + 2, h - 18);
  g.lineTo(0, h - 18);
  fill("ground");
  g.fill();
  for (const x of ticks(X - (w / 2 - 20) / scale, X + (w / 2 - 20) / scale, w / 100)) {
    line(px(x), h - 18, px(x), h - 13);
    text(`${show(x)} m`, px(x), h - 2, { align: "center" });
  }

  // How high the body rides and how large a wheel is drawn; the model knows neither.
  const ride = 0.28 * length, r = 0.055 * length;
  const Y = clamp(now.W[0], -0.3, 0.3) || 0, tilt = clamp(now.W[2], -1.5, 1.5) || 0;
  const ends = wheels.map((offset) => Y + offset * tilt); // Y_i, where the unstretched springs end
  const body = wheels.map((offset, i) => [px(X + offset), py(ends[i] + ride)]);
  body.forEach(([x, top], i) => {
    const hub = py(Math.max(u[i], ends[i]) + r); // on the ground where Y_i <= h_i, else hanging
    stroke(WHEEL[i], 1.8);
    const coils = Array.from({ length: 13 }, (_, k) => [
      x - 6 + (k < 2 || k > 10 ? 0 : k % 2 ? 6 : -6), hub + ((top - hub) * k) / 12,
    ]);
    line(...coils.flat());
    const middle = (hub + top) / 2; // the damper: a rod in a cup
    line(x + 9, top, x + 9, middle - 2);
    line(x + 5, middle - 2, x + 13, middle - 2);
    line(x + 4, middle - 9, x + 4, middle + 6, x + 14, middle + 6, x + 14, middle - 9);
    line(x + 9, middle + 6, x + 9, hub);
    line(x - 6, hub, x + 9, hub);
    dot(x, hub, r * scale, "paper", WHEEL[i], 3);

    const N = now.N[i], foot = py(u[i]), at = x + (i ? 1 : -1) * (r * scale + 16);
    const arrow = clamp((34 * N) / run.N[i][0], 0, 110); // 34 pixels for the force at equilibrium
    stroke(WHEEL[i], 2.5);
    line(at, foot, at, foot - arrow);
    if (arrow > 7) line(at - 4, foot - arrow + 6, at, foot - arrow, at + 4, foot - arrow + 6);
    const lost = !(N > 0), words = `${NAMES[i]} ${lost ? "lost" : `= ${show(N)} N`}`;
    text(words, x, h - 26, { align: "center", colour: lost ? "alarm" : "ink", bold: lost });
  });
  g.lineCap = "round";
  stroke("ink", 8);
  line(...body.flat());
  g.lineCap = "butt";
  dot(px(X), py(Y + ride), 5, "paper", "ink", 2);
  if (Y !== now.W[0] || tilt !== now.W[2]) {
    const style = { align: "center", colour: "alarm", bold: true };
    text("computed far outside this picture", w / 2, 14, style);
  }
}

/** A curve through samples; where they are dense, the first of each few and those that stand out. */
function trace(values, x, y, width) {
  const path = new Path2D(), every = Math.max(1, Math.floor((2 * values.length) / width));
  for (let n = 0; n < values.length; n += every) {
    const end = Math.min(n + every, values.length) - 1, points = [n];
    let low = n, high = n;
    for (let m = n + 1; m <= end; m++) {
      if (values[m] < values[low]) low = m;
      if (values[m] > values[high]) high = m;
    }
    for (const m of low < high ? [low, high] : [high, low]) if (n < m && m < end) points.push(m);
    if (end === values.length - 1 && end > n) points.push(end);
    for (const m of points) {
      const height = clamp(y(values[m]), -FAR, FAR);
      if (!Number.isNaN(height)) path.lineTo(x(m), height);
      if (!(Math.abs(height) < FAR)) return path; // an unstable run has left for good
    }
  }
  return path;
}

/** Both forces against time; broad and pale behind them those of the finest step. */
export function drawForces({ w, h, g, stroke, fill, line, dot, text, inside }, scene) {
  const { data, run, finest, verdict, truth, now } = scene, end = data.distance / run.v;
  const [left, right, top, bottom] = [40, w - 10, 50, h - 34];
  const floor = Math.min(0, truth.least), span = truth.most - floor || 1; // of the finest step
  const low = Math.max(Math.min(floor, verdict.least), floor - 0.7 * span) - 0.05 * span;
  const high = Math.min(Math.max(truth.most, verdict.most), truth.most + 0.7 * span) + 0.05 * span;
  const px = (t) => left + ((right - left) * t) / end;
  const py = (N) => bottom - ((bottom - top) * (N - low)) / (high - low);

  text("Normal forces (N)", 0, 14, { colour: "ink", bold: true });
  WHEEL.forEach((wheel, i) => {
    const x = right - [126, 46][i];
    stroke(wheel, 2, DASH[i]);
    line(x - 28, 10, x - 4, 10);
    text(`${NAMES[i]} ${wheel}`, x, 14, { colour: "ink" });
  });
  if (w > 400) {
    stroke("soft", 6);
    g.globalAlpha = 0.3;
    line(right - 256, 10, right - 232, 10);
    g.globalAlpha = 1;
    text("finest step", right - 228, 14);
  }
  for (const N of ticks(low, high, (bottom - top) / 36)) {
    stroke("line", 1);
    line(left, py(N), right, py(N));
    text(show(N), left - 6, py(N) + 4, { align: "right" });
  }
  stroke("soft", 1);
  for (const t of ticks(0, end, (right - left) / 70)) {
    line(px(t), bottom, px(t), bottom + 4);
    text(show(t), px(t), bottom + 16, { align: "center" });
  }
  for (const X of ticks(0, data.distance, (right - left) / 70).slice(1)) {
    line(px(X / run.v), top, px(X / run.v), top - 4);
    text(show(X), px(X / run.v), top - 7, { align: "center" });
  }
  text("time t (s)", right, h - 3, { align: "right" });
  text("X (m)", left, top - 7);

  inside(left, top, right - left, bottom - top, () => {
    const lost = verdict.lost && px(verdict.lost.t);
    if (verdict.lost) {
      fill("alarm", 0.07);
      g.globalAlpha = 0.07;
      g.fillRect(lost, top, right - lost, bottom - top);
      g.globalAlpha = 1;
    }
    stroke("ink", 1.2);
    line(left, py(0), right, py(0));
    g.globalAlpha = 0.25;
    for (const i of [0, 1]) {
      stroke(WHEEL[i], 6, [], trace(finest.N[i], (m) => px(m * finest.dt), py, right - left));
    }
    g.globalAlpha = 1;
    for (const i of [0, 1]) {
      stroke(WHEEL[i], 1.8, DASH[i], trace(run.N[i], (m) => px(m * run.dt), py, right - left));
      if (run.J < (right - left) / 8) { // few enough to see the samples
        run.N[i].forEach((N, m) => dot(px(m * run.dt), py(N), 2.5, WHEEL[i]));
      }
    }
    stroke("soft", 1);
    line(px(now.t), top, px(now.t), bottom);
    for (const i of [0, 1]) dot(px(now.t), py(now.N[i]), 5, WHEEL[i], "paper");
    if (verdict.lost) {
      dot(lost, py(0), 6, null, "alarm", 2.5);
      const align = lost > (left + right) / 2 ? "right" : "left";
      const style = { align, colour: "alarm", bold: true, halo: true };
      text("contact lost", lost + (align === "left" ? 9 : -9), py(0) + 18, style);
    }
    if (verdict.least < low || verdict.most > high) {
      const style = { align: "right", colour: "alarm", bold: true, halo: true };
      text("grows out of this picture", right - 8, top + 16, style);
    }
  });
}

/** The region where no mode grows, the modes' lambda dt in it, and where other steps put them. */
export function drawStability({ w, h, stroke, fill, line, dot, text, inside }, scene) {
  const { data, robot, step, scheme, dt } = scene;
  const z = Array.from(robot.re, (re, i) => [re, robot.im[i]]);
  const [left, right, top, bottom] = [26, w - 4, 26, h - 34];
  const half = Math.max(3.4, 1.15 * dt * Math.max(...z.map(([re, im]) => Math.hypot(re, im))));
  const scale = (bottom - top) / 2 / half, zero = left + 0.64 * (right - left);
  const px = (re) => zero + re * scale, py = (im) => (top + bottom) / 2 - im * scale;

  text(`Stability of ${data.schemes[scheme].name}`, 0, 14, { colour: "ink", bold: true });
  for (const im of ticks(-half, half, (bottom - top) / 40)) {
    text(show(im), left - 5, py(im) + 4, { align: "right" });
  }
  for (const re of ticks((left - zero) / scale, (right - zero) / scale, (right - left) / 40)) {
    text(show(re), px(re), bottom + 16, { align: "center" });
  }
  text("Re λΔt", right, h - 3, { align: "right" });
  text("Im", left + 4, top + 12);

  inside(left, top, right - left, bottom - top, () => {
    const region = new Path2D();
    for (const [re, im] of data.schemes[scheme].region) region.lineTo(px(re), py(im));
    region.closePath();
    fill("region", 0.15, region);
    stroke("line", 1);
    line(left, py(0), right, py(0));
    line(px(0), top, px(0), bottom);
    stroke("region", 1.6, [], region);
    text("stable", px(-1.15 * half / 3.4), py(0) - 6, { align: "center", colour: "region" });
    const others = new Path2D();
    for (const [x, y] of z.flatMap(([re, im]) => data.dts.map((t) => [px(re * t), py(im * t)]))) {
      others.moveTo(x, y);
      others.arc(x, y, 1.5, 0, 2 * Math.PI);
    }
    fill("soft", 1, others);
    z.forEach(([re, im], i) => {
      const grows = !step.stable && step.growth[i] > 1;
      dot(px(re * dt), py(im * dt), 5.5, grows ? "alarm" : "ink", "paper");
    });
  });
}
