// The pictures of a game: a lane for each speed, and the map of stiffness and damping with the trail.

import { drawAxes, logFrame } from "./axes.js";
import { laneWords } from "./game_words.js";
import { zeroLine } from "./map.js";
import { airborne, lookUp } from "./model.js";
import { begin, show } from "./pen.js";
import { drawRobot } from "./robot.js";
import { unit } from "./words.js";

const COLUMNS = 32, // of the map
  ROWS = 26,
  PARTS = 4; // of a cell, across and up, that are shaded each for itself
const LEFT = 46; // pixels to the map's frame

/**
 * The robots, each by a clock of its own, so that all are at the same place: `part` of the way. An
 * unknown road is drawn as far as a wheel has come.
 */
export function drawLanes(pen, { lanes, part, isSeen, heard, isDone }) {
  const { w, h, g, stroke, fill, line, text, inside } = pen,
    height = h / lanes.length;
  lanes.forEach((lane, i) => {
    const { data, road, flight, end, v } = lane,
      [rear, front] = data.wheels,
      length = front - rear,
      [first, last] = [1.5 * rear, data.distance + 1.5 * front],
      scale = w / (last - first),
      t = part * end,
      { W, N } = lookUp(flight, t / flight.dt),
      X = v * t,
      base = (i + 1) * height - 0.24 * height, // of the road
      px = (x) => (x - first) * scale,
      py = (y) => base - y * scale,
      u = new Float64Array(4),
      spot = new Float64Array(4),
      known = isSeen ? last : X + 1.3 * front;
    inside(0, i * height, w, height, () => {
      g.beginPath();
      for (let x = 0; x <= w + 2; x += 2) {
        if (first + x / scale > known) break;
        road(first + x / scale, spot, 0, 0);
        g.lineTo(x, py(spot[0]));
      }
      stroke("soft", 1.2);
      g.stroke();
      const edge = Math.min(px(known), w + 2);
      g.lineTo(edge, (i + 1) * height);
      g.lineTo(0, (i + 1) * height);
      fill("ground");
      g.fill();
      stroke("alarm", 4);
      for (const [wheel, from, to] of airborne(lane, "flying", t)) {
        const x = (time) => px(v * time + data.wheels[wheel]),
          y = base + 0.09 * height + 5 * (1 - wheel);
        line(x(from), y, Math.max(x(to), x(from) + 2), y);
      }
      data.wheels.forEach((offset, wheel) => road(X + offset, u, wheel, 0));
      const place = { X, px, py, u, r: 0.06 * length, ride: 0.3 * length, scale, arrows: false };
      drawRobot(pen, lane, place, { W, N }, false);
    });
    if (px(known) < w - 30)
      text("?", (px(known) + w) / 2, base - 4, { align: "center", colour: "ink", bold: true });
    if (i) {
      stroke("line", 1);
      line(0, i * height, w, i * height);
    }
    const y = i * height + 14;
    text(unit(v, "m/s"), 0, y, { colour: "ink", bold: true, halo: true });
    const inAir = N.flatMap((force, wheel) => (force > 0 ? [] : [["rear", "front"][wheel]])),
      now = inAir.length ? `${inAir.length > 1 ? "both wheels" : `${inAir[0]} wheel`} in the air` : "",
      words = isDone ? laneWords(lane) : now;
    const colour = isDone ? (lane.state === "kept" ? "region" : "alarm") : "alarm";
    text(words, 64, y, { colour, bold: true, halo: true });
    if (heard === i) text("♪", w - 4, y, { align: "right", colour: "ink", bold: true });
  });
}

/** The map's frame: where a k and a c lie, and what lies at a place. */
export function mapFrame(w, h, { ranges: { k, c } }) {
  const frame = logFrame(w, h, k, c, LEFT),
    { left, right, top, bottom } = frame,
    at = ([low, high], part) => low * (high / low) ** Math.min(Math.max(part, 0), 1);
  return {
    ...frame,
    kAt: (x) => at(k, (x - left) / (right - left)),
    cAt: (y) => at(c, (bottom - y) / (bottom - top)),
  };
}

/** A map of the margins at each speed that is filled in small portions. */
export function makeRegion(level, { ranges, asked }, sketch) {
  const grid = ([low, high], count) =>
    Array.from({ length: count }, (_, i) => low * (high / low) ** (i / (count - 1)));
  const region = {
    ks: grid(ranges.k, COLUMNS),
    cs: grid(ranges.c, ROWS),
    margins: asked.map(() => []), // of each speed, a row for each damping
    /** Rows that are filled. */
    rows: () => region.margins[0].filter((row) => row.length === COLUMNS).length,
    /** Whether there was something to do: the last portion has to be drawn, too. */
    work(portion) {
      if (region.rows() === ROWS) return false;
      const start = performance.now();
      while (region.rows() < ROWS && performance.now() - start < portion) {
        const rows = region.margins[0];
        if (!rows.length || rows.at(-1).length === COLUMNS) for (const own of region.margins) own.push([]);
        const row = rows.length - 1,
          found = sketch(level, region.ks[rows[row].length], region.cs[row]);
        found.forEach((margin, i) => region.margins[i][row].push(margin));
      }
      return true;
    },
  };
  return region;
}

/** For each speed the short straight lines that part where it fails from where it does not, once all is known. */
function bordersOf(region, { reserve }) {
  if (region.rows() < ROWS) return [];
  region.borders ??= region.margins.map((rows) => {
    const margins = rows.map((row) => row.map((margin) => margin - reserve));
    return zeroLine({ margins, speeds: region.ks, stiffnesses: region.cs });
  });
  return region.borders;
}

/** The speed beside each border, where there is room for it. */
function nameBorders({ text }, { px, py }, region, goal, asked) {
  bordersOf(region, goal).forEach((border, n) => {
    const words = unit(asked[n], "m/s"),
      places = [0.5, 0.3, 0.7, 0.15, 0.85, 0.95].map((part) => border[Math.floor(part * border.length)]);
    places.some((at) => at && text(words, px(at[0][0]) + 5, py(at[0][1]) - 5, { colour: "ink", halo: true }));
  });
}

/** How many speeds fail at a place between the nodes of the map: [column, row]. */
function failing({ margins }, [x, y], reserve) {
  const [j, i] = [Math.min(Math.floor(x), COLUMNS - 2), Math.min(Math.floor(y), ROWS - 2)],
    [right, up] = [x - j, y - i];
  const at = (M) =>
    (1 - up) * ((1 - right) * M[i][j] + right * M[i][j + 1]) +
    up * ((1 - right) * M[i + 1][j] + right * M[i + 1][j + 1]);
  return margins.filter((M) => at(M) < reserve).length;
}

/** The region where all is kept, a border for each speed, and how far away the answer to beat is. */
function drawRegion(pen, frame, region, goal, { asked, own }) {
  const { shade, stroke, line } = pen,
    { left, right, top, bottom, px, py } = frame,
    rows = region.rows();
  const [nx, ny] = [PARTS * (COLUMNS - 1), PARTS * (ROWS - 1)],
    x = (j) => Math.round(left + ((right - left) * j) / nx),
    y = (i) => Math.round(bottom - ((bottom - top) * i) / ny);
  for (let i = 0; i < PARTS * (rows - 1); i++) {
    for (let j = 0; j < nx; j++) {
      const failed = failing(region, [(j + 0.5) / PARTS, (i + 0.5) / PARTS], goal.reserve),
        [colour, alpha] = failed ? ["alarm", 0.08 + (0.4 * failed) / asked.length] : ["region", 0.4];
      shade(colour, alpha, x(j), y(i + 1), x(j + 1) - x(j), y(i) - y(i + 1));
    }
  }
  stroke("ink", 1.3);
  for (const border of bordersOf(region, goal))
    for (const [a, b] of border) line(px(a[0]), py(a[1]), px(b[0]), py(b[1]));
  if (goal.kind === "air" || !goal.distance) return;
  stroke("soft", 1.4, [5, 4]);
  const points = Array.from({ length: 73 }, (_, i) => {
    const angle = (Math.PI * i) / 36;
    return [
      px(own.k * Math.exp(goal.distance * Math.cos(angle))),
      py(own.c * Math.exp(goal.distance * Math.sin(angle))),
    ];
  });
  line(...points.flat());
}

function diamond({ stroke, fill }, x, y) {
  const path = new Path2D();
  for (const [dx, dy] of [
    [0, -8],
    [8, 0],
    [0, 8],
    [-8, 0],
  ])
    path.lineTo(x + dx, y + dy);
  path.closePath();
  fill("paper", 1, path);
  stroke("ink", 2, [], path);
}

/** What draws a region once, and from then on copies it. */
export function makeRegionPicture() {
  const canvas = document.createElement("canvas");
  let drawn = "";
  return (pen, frame, region, goal, facts) => {
    const { w, h, colours } = pen,
      key = [
        w,
        h,
        devicePixelRatio,
        JSON.stringify(colours),
        facts.levels.indexOf(goal),
        region.rows(),
      ].join();
    if (key !== drawn) drawRegion(begin(canvas, w, h, colours), frame, region, goal, facts);
    drawn = key;
    pen.g.drawImage(canvas, 0, 0, w, h);
  };
}

/** The trail on the map: attempts one after another, filled where they do what is asked for. */
export function drawMap(pen, facts, { goal, attempts, chosen, region, picture }) {
  const { w, h, stroke, line, text, inside, dot } = pen,
    frame = mapFrame(w, h, facts),
    { left, right, top, bottom, px, py } = frame;
  drawAxes(pen, frame, ["stiffness k (N/m)", "damping c (N s/m)"]);
  inside(left, top, right - left, bottom - top, () => {
    if (region) picture(pen, frame, region, goal, facts);
    const places = attempts.map(({ k, c }) => [px(k), py(c)]);
    stroke("soft", 1.5);
    if (places.length > 1) line(...places.flat());
    const [x, y] = [px(facts.own.k), py(facts.own.c)];
    stroke("ink", 2);
    line(x - 6, y - 6, x + 6, y + 6);
    line(x - 6, y + 6, x + 6, y - 6);
    text("as it is", x + 9, y - 6, { halo: true, colour: "ink" });
    if (region) diamond(pen, px(goal.best.k), py(goal.best.c));
    attempts.forEach(({ isReached }, n) => {
      const [u, v] = places[n];
      dot(u, v, 5.5, isReached ? "region" : "paper", isReached ? "ink" : "alarm", 2);
      text(String(n + 1), u + 8, v + 12, { halo: true, colour: "ink", bold: true });
    });
    dot(px(chosen.k), py(chosen.c), 10, null, "front", 2.5);
    if (region) nameBorders(pen, frame, region, goal, facts.asked);
  });
  stroke("soft", 1);
  line(left, top, left, bottom, right, bottom);
  if (!region)
    text("where all is kept is covered", (left + right) / 2, bottom - 8, { align: "center", halo: true });
  return frame;
}

/** What the lanes show, for those who do not see them. */
export const lanesLabel = (lanes, isDone) =>
  `${lanes.length > 1 ? "Robots" : "A robot"} on the road at ${lanes.map(({ v }) => show(v)).join(", ")} m/s. ${
    isDone
      ? lanes.map((lane) => `${unit(lane.v, "m/s")}: ${laneWords(lane)}.`).join(" ")
      : "Before the drive."
  }`;
