// The robot as it is drawn everywhere.

import { clamp } from "./pen.js";
import { WHEEL } from "./words.js";

/** How far a spring is compressed. */
export const compression = ({ Cp, Dp }, W, u, i) =>
  Cp[i].reduce((sum, value, j) => sum + value * W[j], 0) +
  Dp[i].reduce((sum, value, j) => sum + value * u[j], 0);

/** The body, springs, dampers and wheels in one state; true if it is far outside the picture. */
export function drawRobot(
  { g, stroke, line, dot },
  { data, robot },
  { X, px, py, u, r, ride, scale, arrows = true },
  { W, N },
  faint,
) {
  const far = 1.4 * (data.wheels[1] - data.wheels[0]),
    Y = clamp(W[0], -far, far) || 0,
    tilt = clamp(W[2], -1.5, 1.5) || 0;
  const state = [Y, 0, tilt, 0];
  const p = [0, 1].map((i) => compression(robot, state, u, i));
  const hubs = p.map((value, i) => u[i] + Math.max(-value, 0) + r); // on the ground, else hanging
  // How high the body rides and how large a wheel is drawn, the model does not know.
  const ends = p.map((value, i) => Math.max(u[i] - value + ride, hubs[i] + 1.7 * r));
  const at = data.wheels.map((offset) => px(X + offset)),
    z = clamp((at[1] - at[0]) / 120, 0.4, 1); // springs and dampers of a small robot are small
  const body = ends.map((end, i) => [at[i], py(end)]);
  g.save();
  if (faint) g.globalAlpha = 0.3;
  body.forEach(([x, top], i) => {
    const hub = py(hubs[i]);
    stroke(WHEEL[i], 1.8 * z);
    const coils = Array.from({ length: 13 }, (_, k) => [
      x + z * (k < 2 || k > 10 ? -6 : k % 2 ? 0 : -12),
      hub + ((top - hub) * k) / 12,
    ]);
    line(...coils.flat());
    const middle = (hub + top) / 2; // the damper: a rod in a cup
    line(x + 9 * z, top, x + 9 * z, middle - 2 * z);
    line(x + 5 * z, middle - 2 * z, x + 13 * z, middle - 2 * z);
    const [edge, low, other, high] = [x + 4 * z, middle + 6 * z, x + 14 * z, middle - 9 * z];
    line(edge, high, edge, low, other, low, other, high);
    line(x + 9 * z, low, x + 9 * z, hub);
    line(x - 6 * z, hub, x + 9 * z, hub);
    g.save();
    dot(x, hub, r * scale, faint ? null : "paper", faint || N[i] > 0 ? WHEEL[i] : "alarm", 3 * z);
    g.restore();
    if (faint || !arrows) return;
    const foot = py(u[i]),
      beside = x + (i ? 1 : -1) * (r * scale + 16);
    const rest = clamp(0.2 * foot, 14, 34); // pixels for the force at rest
    const arrow = clamp((rest * N[i]) / robot.weight[i], 0, foot - 4);
    stroke(WHEEL[i], 2.5);
    if (arrow > 2) line(beside, foot, beside, foot - arrow);
    if (arrow > 7) line(beside - 4, foot - arrow + 6, beside, foot - arrow, beside + 4, foot - arrow + 6);
  });
  if (faint) g.globalAlpha = 0.3;
  g.lineCap = "round";
  stroke("ink", 8 * z);
  const slope = (body[1][1] - body[0][1]) / (body[1][0] - body[0][0]),
    over = (15 * z) / Math.hypot(1, slope); // springs and dampers stand under it
  line(
    body[0][0] - over,
    body[0][1] - over * slope,
    ...body.flat(),
    body[1][0] + over,
    body[1][1] + over * slope,
  );
  g.lineCap = "butt";
  if (!faint) {
    const share = (0 - data.wheels[0]) / (data.wheels[1] - data.wheels[0]); // the centre of mass
    dot(
      body[0][0] + share * (body[1][0] - body[0][0]),
      body[0][1] + share * (body[1][1] - body[0][1]),
      5 * z,
      "paper",
      "ink",
      2 * z,
    );
  }
  g.restore();
  return Y !== W[0] || tilt !== W[2];
}
