// The panels. Each has a `still` part, drawn when what was computed changes, and a `live` part,
// drawn over it at every moment; `grab` says what a pointer at x, y takes hold of. The still part is
// drawn again only when the panel's `key` is another one.

import { chartPanel } from "./chart.js";
import { drawMap } from "./map.js";
import { judge } from "./model.js";
import { clamp, powers, show, ticks, trace } from "./pen.js";
import { compression, drawRobot } from "./robot.js";
import { extremes } from "./scene.js";
import { drawStrip } from "./strip.js";
import { FURTHER, ghostWords, WHEEL } from "./words.js";

const NAMES = ["N₁", "N₂"];
const FAR = 5000; // pixels
const DASH = [[], [7, 4]]; // rear solid, front dashed
const REACH = 24; // pixels around a thing that one can take hold of

/** The robot on the road, one scale for both directions; the picture moves along with it. */
const robotPanel = {
  name: "robot",
  title: "The robot on its road",
  live(pen, scene, { now, motion, ghost, pinned }) {
    const { g, w, h, stroke, fill, line, text } = pen,
      { data, road, robot } = scene;
    const [rear, front] = data.wheels,
      length = front - rear;
    const scale = Math.min(w / (length * clamp(w / 260, 1.7, 2.3)), (h - 50) / (0.62 * length));
    this.scale = scale;
    const { X } = now,
      u = new Float64Array(4),
      spot = new Float64Array(4);
    [rear, front].forEach((offset, i) => road(X + offset, u, i, 0));
    const level = (u[0] + u[1]) / 2,
      room = 0.14 * length,
      climb = level - clamp(level, -room, room); // up and down hills
    const px = (x) => w / 2 + (x - X) * scale,
      py = (y) => h - 42 - (y - climb) * scale;

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
    for (const x of ticks(X - (w / 2 - 26) / scale, X + (w / 2 - 26) / scale, w / 100)) {
      line(px(x), h - 18, px(x), h - 13);
      text(`${show(x)} m`, px(x), h - 3, { align: "center" });
    }
    const place = { X, px, py, u, r: 0.055 * length, ride: 0.28 * length, scale };
    drawStrip(pen, scene, X);
    if (ghost) {
      const theirs = new Float64Array(4);
      [rear, front].forEach((offset, i) => ghost.scene.road(X + offset, theirs, i, 0));
      drawRobot(pen, ghost.scene, { ...place, u: theirs }, ghost.state, true);
      ghostWords(motion, pinned).some((words) => text(words, 0, 13));
    }
    const shown = now[motion],
      wild = drawRobot(pen, scene, place, shown, false);
    [0, 1].forEach((i) => {
      const lost = !(shown.N[i] > 0),
        spring = compression(robot, shown.W, u, i);
      const words = `${NAMES[i]} ${lost ? (motion === "flying" ? "in the air" : "lost") : `= ${show(shown.N[i])} N`}`;
      text(words, px(X + data.wheels[i]), h - 24, {
        align: "center",
        colour: lost ? "alarm" : "ink",
        bold: lost,
        halo: true,
      });
      if (data.springEnd !== null && spring > data.springEnd) {
        text(FURTHER, i ? w : 0, 36, {
          align: i ? "right" : "left",
          colour: "doubt",
          bold: true,
          halo: true,
        }); // in a narrow picture once, for both
      }
    });
    if (wild)
      text("computed far outside this picture", w / 2, 46, { align: "center", colour: "doubt", bold: true });
  },
  grab(x, _y, { now, scene }) {
    const { scale } = this,
      { X } = now;
    return {
      cursor: "grabbing",
      to: (x2) => ({ time: clamp((X + (x2 - x) / scale) / scene.data.distance, 0, 1) }),
    };
  },
};

/** Round numbers with lines along one axis. */
function levels({ stroke, line, text }, values, py, left, right) {
  for (const value of values) {
    stroke("line", 1);
    line(left, py(value), right, py(value));
    text(show(value), left - 6, py(value) + 4, { align: "right" });
  }
}

/** Both forces against time and place. */
const forcesPanel = {
  name: "forces",
  title: "Normal forces",
  key: ({ settings }, { motion }) => [...Object.values(settings), motion],
  still(pen, scene, { motion, pinned }) {
    const { w, h, g, stroke, shade, line, dot, text, inside } = pen,
      { run, truth, flight, v, end, data } = scene;
    const flying = motion === "flying",
      exact = truth.verdict,
      verdict = flying || !run ? exact : run.verdict,
      beyond = (flying ? flight : truth).beyond;
    const [left, right, top, bottom] = [38, w - 16, 46, h - 33];
    const [low, high] = forceRange(scene, flying, verdict, pinned);
    const px = (t) => left + ((right - left) * t) / end,
      py = (N) => bottom - ((bottom - top) * (N - low)) / (high - low);
    this.frame = { left, right, top, bottom, px, py, end };

    text(right > 300 ? "Normal forces (N)" : "Forces (N)", 0, 13, { colour: "ink", bold: true });
    const isWide = right > 250; // for the wheels' names
    pen.legend(
      right - (isWide ? 164 : 96),
      13,
      right + (isWide ? 0 : 16),
      WHEEL.map((wheel, i) => ({
        words: isWide ? `${NAMES[i]} ${wheel}` : NAMES[i],
        colour: wheel,
        width: 2,
        dash: DASH[i],
        ink: "ink",
      })),
    );
    pen.legend(left, h - 4, right - 34, [
      { words: flying ? "linear" : "exact", colour: "soft", width: 6, alpha: 0.3 },
      ...(pinned ? [{ words: "pinned", colour: "pinned", width: 1.5 }] : []),
      ...(beyond.length
        ? [{ words: `spring > ${show(1000 * data.springEnd)} mm`, colour: "doubt", width: 4, alpha: 0.6 }]
        : []),
    ]);
    text("t (s)", right, h - 4, { align: "right" });
    text("X (m)", left, top - 7);
    levels(pen, ticks(low, high, (bottom - top) / 34), py, left, right);
    stroke("soft", 1);
    for (const t of ticks(0, end, (right - left) / 70)) {
      line(px(t), bottom, px(t), bottom + 4);
      text(show(t), px(t), bottom + 15, { align: "center" });
    }
    for (const X of ticks(0, data.distance, (right - left) / 70).slice(1)) {
      line(px(X / v), top, px(X / v), top - 4);
      text(show(X), px(X / v), top - 7, { align: "center" });
    }

    inside(left, top, right - left, bottom - top, () => {
      for (const [a, b] of beyond) shade("doubt", 0.6, px(a), top, Math.max(px(b) - px(a), 2), 4);
      const lost = verdict.lost && px(verdict.lost.t);
      if (flying) {
        shadeAirborne(pen, flight, px, top, bottom);
      } else if (verdict.lost) {
        shade("alarm", 0.07, lost, top, right - lost, bottom - top);
      }
      stroke("ink", 1.2);
      line(left, py(0), right, py(0));
      const curve = (found, i, width, dash) =>
        stroke(
          WHEEL[i],
          width,
          dash,
          trace(found.N[i].subarray(0, found.J + 1), (m) => px(m * found.dt), py, right - left),
        );
      g.globalAlpha = 0.25;
      for (const i of [0, 1]) curve(truth, i, 6, []);
      g.globalAlpha = 1;
      if (pinned) {
        for (const i of [0, 1]) {
          stroke(
            "pinned",
            1.5,
            DASH[i],
            trace(pinned.N[i], (m) => px((m * pinned.dt * pinned.v) / v), py, right - left),
          );
        }
      }
      if (flying) for (const i of [0, 1]) curve(flight, i, 2, DASH[i]);
      else if (run) {
        for (const i of [0, 1]) {
          curve(run, i, 1.8, DASH[i]);
          if (run.J < (right - left) / 8) {
            // few enough to see the samples
            run.N[i].forEach((N, m) => dot(px(m * run.dt), py(N), 2.5, WHEEL[i]));
          }
        }
      }
      if (flying) {
        for (const { wheel, kind, t, force } of flight.events.slice(0, 40)) {
          dot(
            px(t),
            py(force),
            kind === "landing" ? 4.5 : 3.5,
            kind === "landing" ? WHEEL[wheel] : "paper",
            WHEEL[wheel],
            2,
          );
        }
      } else {
        if (run?.verdict.lost && scene.stable)
          mark(pen, this.frame, run.verdict.lost.t, 0, "contact lost", "alarm");
        if (run && scene.stable && !run.verdict.lost && exact.lost) {
          mark(pen, this.frame, exact.t, exact.least, "missed", "doubt");
        }
        if (run && (verdict.least < low || verdict.most > high)) {
          text("grows out of this picture", right - 8, top + 18, {
            align: "right",
            colour: "doubt",
            bold: true,
            halo: true,
          });
        }
      }
    });
  },
  live(pen, _scene, { now, motion }) {
    const { stroke, line, dot } = pen,
      { px, py, top, bottom } = this.frame;
    stroke("soft", 1);
    line(px(now.t), top, px(now.t), bottom);
    for (const i of [0, 1]) dot(px(now.t), clamp(py(now[motion].N[i]), top, bottom), 5, WHEEL[i], "paper");
  },
  grab(x) {
    const { left, right } = this.frame;
    const to = (x2) => ({ time: clamp((x2 - left) / (right - left), 0, 1) });
    return { cursor: "ew-resize", to, at: to(x) };
  },
};

/** From where to where forces are drawn: the exact ones, and of others as much as leaves these legible. */
function forceRange(scene, flying, verdict, pinned) {
  const exact = [extremes(scene, flying), ...(pinned ? [pinned.exact] : [])],
    most = Math.max(...exact.map((other) => other.most)),
    least = Math.min(0, ...exact.map((other) => other.least));
  const span = most - least || 1,
    others = [flying ? judge(scene.flight) : verdict, ...(pinned ? [pinned.verdict] : [])];
  const low = Math.min(least, ...others.map((other) => other.least)),
    high = Math.max(most, ...others.map((other) => other.most));
  return [Math.max(low, least - 0.7 * span) - 0.06 * span, Math.min(high, most + 0.7 * span) + 0.06 * span];
}

/** When a wheel is in the air: the rear wheel in the upper half, the front wheel in the lower. */
function shadeAirborne({ shade }, { events, dt, J }, px, top, bottom) {
  const half = (bottom - top) / 2;
  for (const i of [0, 1]) {
    const own = events.filter(({ wheel }) => wheel === i);
    own.forEach(({ kind, t }, n) => {
      const end = own[n + 1]?.t ?? dt * J;
      if (kind === "lift-off") shade(WHEEL[i], 0.12, px(t), top + i * half, px(end) - px(t), half);
    });
  }
}

/** A ring with words beside it. */
function mark({ dot, text }, { px, py, left, right, top, bottom }, t, N, words, colour) {
  const x = px(t),
    y = clamp(py(N), top + 8, bottom - 8),
    align = x > (left + right) / 2 ? "right" : "left";
  const below = y + 22 < bottom ? 18 : -10;
  dot(x, y, 6, null, colour, 2.5);
  text(words, x + (align === "left" ? 10 : -10), y + below, { align, colour, bold: true, halo: true });
}

/** The least force of each wheel at every speed, with the speeds at which contact is lost shaded. */
const speedsPanel = {
  name: "speeds",
  title: "Least force at every speed",
  key: ({ settings: { k, c, height, sigma } }, { map }) => (map ? map.key : [k, c, height, sigma]),
  still(pen, scene, { pinned, map }) {
    if (map) {
      this.frame = drawMap(pen, scene, map);
      return;
    }
    const { w, h, stroke, shade, line, dot, text, inside } = pen,
      { curve, data, robot } = scene;
    const { speeds, least, critical } = curve,
      [lowest, highestSpeed] = data.ranges.v;
    const [left, right, top, bottom] = [38, w - 12, h < 150 ? 35 : 49, h - 33], // numbers in one row, or two
      rest = Math.max(...robot.weight);
    const bottomForce = Math.min(...[...least, ...(pinned?.least ?? [])].map((N) => Math.min(...N)));
    const low = Math.max(1.1 * Math.min(bottomForce, -0.4 * rest), -7 * rest),
      high = 1.9 * rest;
    const ratio = Math.log(highestSpeed / lowest);
    const px = (v) => left + ((right - left) * Math.log(v / lowest)) / ratio;
    const py = (N) => bottom - ((bottom - top) * (N - low)) / (high - low);
    this.frame = { left, right, top, bottom, px, py, lowest, ratio };
    text(`Least force (N)${w > 310 ? " at every speed" : ""}, linear model`, 0, 13, {
      colour: "ink",
      bold: true,
    });
    levels(pen, ticks(low, high, (bottom - top) / 34), py, left, right);
    const edges = [lowest, ...critical, highestSpeed];
    edges.slice(1).forEach((edge, i) => {
      const kept = curve.kept === (i % 2 === 0),
        a = px(edges[i]),
        b = px(edge);
      shade(kept ? "region" : "alarm", 0.1, a, top, b - a, bottom - top);
      if (b - a > 40)
        // where no curve is: a least force is above zero, or below
        text(kept ? "kept" : "lost", (a + b) / 2, kept ? bottom - 8 : top + 14, {
          align: "center",
          colour: kept ? "region" : "alarm",
          bold: true,
          halo: true,
        });
    });
    for (const v of powers(lowest, highestSpeed)) {
      stroke("soft", 1);
      line(px(v), bottom, px(v), bottom + 4);
      text(show(v), px(v), bottom + 15, { align: "center" });
    }
    text("speed v (m/s)", right, h - 4, { align: "right" });
    inside(left, top, right - left, bottom - top, () => {
      stroke("ink", 1.2);
      line(left, py(0), right, py(0));
      if (pinned)
        for (const i of [0, 1])
          stroke(
            "pinned",
            1.5,
            DASH[i],
            trace(pinned.least[i], (m) => px(speeds[m]), py, FAR),
          );
      for (const i of [0, 1])
        stroke(
          WHEEL[i],
          2,
          DASH[i],
          trace(least[i], (m) => px(speeds[m]), py, FAR),
        );
      for (const v of data.asked) dot(px(v), py(Math.min(...curve.leastAt(v))), 3.5, "paper", "ink", 1.5);
    });
    for (const v of critical) {
      dot(px(v), py(0), 4, "ink");
      const x = clamp(px(v), left + 14, right - 14);
      [top - 8, top - 22].some((y) => text(show(v), x, y, { align: "center", colour: "ink" }));
    }
  },
  live({ stroke, line, dot }, scene, { map }) {
    const { px, py, top, bottom } = this.frame,
      x = px(scene.v);
    if (map) {
      dot(x, py(scene.settings.k), 6, "ink", "paper", 2);
      return;
    }
    stroke("ink", 1.5);
    const { least } = scene.truth.verdict,
      margin = clamp(py(least), top, bottom);
    line(x, least > 0 ? top : top + 18, x, least > 0 ? bottom - 22 : bottom); // not through the words
    dot(x, margin, 6, "ink", "paper", 2);
  },
  grab(x, y, { map }) {
    const { left, right, lowest, ratio, stiffness } = this.frame;
    const to = (x2, y2) => {
      const k = map && { k: Number(stiffness(y2).toPrecision(3)) };
      const v = lowest * Math.exp((ratio * clamp(x2 - left, 0, right - left)) / (right - left));
      return { v: Number(v.toPrecision(3)), ...k, time: null };
    };
    return { cursor: map ? "crosshair" : "ew-resize", to, at: to(x, y) };
  },
};

/** The region where no mode grows, the modes' lambda dt in it, their rays, and a closer look. */
const stabilityPanel = {
  name: "stability",
  title: "Region of absolute stability",
  key: ({ settings: { k, c, dt, scheme_index } }, { held }) => [k, c, dt, scheme_index, held],
  still(pen, scene, { pinned, held }) {
    const { w, h, text } = pen,
      { scheme, robot, dt } = scene;
    const [left, right, top, bottom] = [26, w - 4, 24, h - 33],
      size = robot.modes.map(([re, im]) => Math.hypot(re, im));
    const half = held ? this.frame.half : Math.max(3.4, 1.15 * dt * Math.max(...size));
    this.frame = { half, ...plane(left, right, top, bottom, half, 0.74) };
    text(`Stability of ${scheme.name}`, 0, 13, { colour: "ink", bold: true });
    const { px, py, scale } = this.frame,
      { zero } = this.frame;
    for (const im of ticks(-half, half, (bottom - top) / 40))
      text(show(im), left - 5, py(im) + 4, { align: "right" });
    for (const re of ticks((left - zero) / scale, (right - zero) / scale, (right - left) / 40)) {
      text(show(re), px(re), bottom + 15, { align: "center" });
    }
    text("Re λΔt", right, h - 4, { align: "right" });
    text("Im λΔt", left + 4, top + 12);
    // When the modes crowd near zero: the same, enlarged. What one holds on to does not move away.
    const reach = dt * Math.max(...size);
    if (!held) {
      const side = Math.min(0.44 * (bottom - top), 0.45 * (right - left)),
        [x, y] = [left + 6, bottom - 6];
      const crowded = reach * scale < 30 && side > 60;
      this.inset = crowded ? plane(x, x + side, y - side, y, 1.3 * reach, 0.72) : null;
    }
    if (this.inset) pen.reserve(this.inset.left, this.inset.top, this.inset.right, this.inset.bottom);
    this.draw(pen, scene, this.frame, pinned, true);
    if (this.inset) {
      const { left: x, top: y, right: x2, bottom: y2 } = this.inset;
      pen.shade("paper", 1, x, y, x2 - x, y2 - y);
      this.draw(pen, scene, this.inset, pinned, false);
      pen.stroke("soft", 1);
      pen.line(x, y, x2, y, x2, y2, x, y2, x, y);
      text(`${show(this.inset.scale / scale, 2)} ×`, x + 4, y + 13, { halo: true, over: true });
    }
  },
  draw({ stroke, fill, line, dot, text, inside }, { scheme, robot, dt, growths, data }, frame, pinned, main) {
    const { left, right, top, bottom, px, py, half } = frame;
    inside(left, top, right - left, bottom - top, () => {
      const region = new Path2D();
      for (const corners of scheme.region) {
        corners.forEach(([re, im], i) => region[i ? "lineTo" : "moveTo"](px(re), py(im)));
        region.closePath();
      }
      fill("region", 0.15, region);
      stroke("line", 1);
      line(left, py(0), right, py(0));
      line(px(0), top, px(0), bottom);
      stroke("region", 1.6, [], region);
      if (main)
        [0.12, 0.3].some((share) =>
          text("stable", px((-1.15 * half) / 3.4), py(share * half), { align: "center", colour: "region" }),
        );
      const others = new Path2D();
      stroke("soft", 0.6);
      for (const [re, im] of robot.modes) {
        line(px(0), py(0), px(re * data.ranges.dt[1]), py(im * data.ranges.dt[1]));
        for (const t of data.dts) {
          others.moveTo(px(re * t), py(im * t));
          others.arc(px(re * t), py(im * t), 1.5, 0, 2 * Math.PI);
        }
      }
      fill("soft", 1, others);
      if (pinned) pinned.z.forEach(([re, im]) => dot(px(re), py(im), 4, null, "pinned", 1.5));
      robot.modes.forEach(([re, im], i) =>
        dot(px(re * dt), py(im * dt), main ? 5.5 : 4.5, growths[i] > 1 + 1e-12 ? "alarm" : "ink", "paper"),
      );
    });
  },
  grab(x, y, { scene }) {
    const { modes } = scene.robot,
      { dt, data } = scene;
    const { inset } = this,
      inInset = inset && x >= inset.left && x <= inset.right && y >= inset.top && y <= inset.bottom;
    const frame = inInset ? inset : this.frame;
    const away = ([re, im]) => Math.hypot(x - frame.px(re * dt), y - frame.py(im * dt));
    const nearest = modes.reduce((a, b) => (away(b) < away(a) ? b : a)),
      [re, im] = nearest;
    if (away(nearest) > REACH) return null;
    const to = (x2, y2) => {
      const along = ((x2 - frame.px(0)) * re - (y2 - frame.py(0)) * im) / frame.scale;
      const step = clamp(along / (re * re + im * im), data.ranges.dt[0], data.ranges.dt[1]);
      return { dt: Number(step.toPrecision(3)) };
    };
    return { cursor: "grabbing", to, holds: true };
  },
};

/** The complex plane in a rectangle, one scale for both directions. */
function plane(left, right, top, bottom, half, share) {
  const scale = (bottom - top) / 2 / half,
    zero = left + share * (right - left),
    middle = (top + bottom) / 2;
  return {
    left,
    right,
    top,
    bottom,
    half,
    scale,
    zero,
    px: (re) => zero + re * scale,
    py: (im) => middle - im * scale,
  };
}

export const PANELS = {
  robot: robotPanel,
  speeds: speedsPanel,
  forces: forcesPanel,
  stability: stabilityPanel,
  chart: chartPanel,
};
