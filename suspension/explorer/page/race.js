// Robots at several speeds, each in a lane of its own, on one road and by one clock.

import { airborne } from "./model.js";
import { clamp } from "./pen.js";
import { drawRobot } from "./robot.js";
import { fractionAt } from "./scene.js";
import { laneWords } from "./words.js";

export const racePanel = {
  name: "race",
  title: "Robots at several speeds, on one road and by one clock",
  live(pen, scene, { now, motion }) {
    const { w, h, g, stroke, fill, line, text } = pen,
      { data, lanes } = scene,
      [rear, front] = data.wheels,
      length = front - rear;
    const [start, end] = [1.4 * rear, data.distance + 1.4 * front],
      height = h / lanes.length,
      scale = Math.min(w / (end - start), (height - 18) / (0.5 * length));
    this.scale = scale;
    const px = (x) => (x - start) * scale;
    lanes.forEach((lane, i) => {
      const at = now.lanes[i],
        base = (i + 1) * height - 16, // of the road
        py = (y) => base - y * scale,
        u = new Float64Array(4),
        spot = new Float64Array(4);
      g.beginPath();
      for (let x = 0; x <= w + 2; x += 2) {
        lane.road(start + x / scale, spot, 0, 0);
        g.lineTo(x, py(spot[0]));
      }
      stroke("soft", 1.2);
      g.stroke();
      g.lineTo(w + 2, base + 8);
      g.lineTo(0, base + 8);
      fill("ground");
      g.fill();
      stroke("alarm", 4);
      for (const [wheel, a, b] of airborne(lane, motion, at.t)) {
        const x = (t) => px(lane.v * t + data.wheels[wheel]);
        line(x(a), base + 3 + 5 * (1 - wheel), Math.max(x(b), x(a) + 2), base + 3 + 5 * (1 - wheel));
      }
      [rear, front].forEach((offset, wheel) => lane.road(at.X + offset, u, wheel, 0));
      const place = { X: at.X, px, py, u, r: 0.055 * length, ride: 0.28 * length, scale, arrows: false };
      drawRobot(pen, lane, place, at[motion], false);
      const { name, words, tone } = laneWords(lane, motion, at.t);
      text(name, 0, i * height + 14, { colour: "ink", bold: true, halo: true });
      text(words, 72, i * height + 14, { colour: tone ?? "soft", bold: Boolean(tone), halo: true });
    });
  },
  grab(x, _y, { scene, now }) {
    // The robot that is nearest to the pointer is taken along.
    const { scale } = this,
      { lanes, data } = scene,
      start = 1.4 * data.wheels[0];
    const nearest = lanes.reduce(
      (best, lane, i) =>
        Math.abs((now.lanes[i].X - start) * scale - x) < Math.abs((best.X - start) * scale - x)
          ? { lane, X: now.lanes[i].X }
          : best,
      { lane: lanes[0], X: now.lanes[0].X },
    );
    const to = (x2) => {
      const X = clamp(nearest.X + (x2 - x) / scale, 0, data.distance);
      return { time: fractionAt(scene, X / nearest.lane.v) };
    };
    return { cursor: "grabbing", to };
  },
};
