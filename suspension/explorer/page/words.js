// What the pictures say, in words: never more certain than the numbers.

import { airborne } from "./model.js";
import { show } from "./pen.js";

export const WHEEL = ["rear", "front"];
export const FURTHER = "squeezed past its readings"; // a spring

export const unit = (x, name, digits) => `${show(x, digits)}\u00a0${name}`;
const equals = (name, ...value) => `${name}\u00a0=\u00a0${unit(...value)}`; // on one line
const capital = (text) => text[0].toUpperCase() + text.slice(1);

/**
 * `tone` is "kept", "lost", "edge" (too close to tell), "doubt" (where the run and the exact answer
 * differ, or there is no verdict) or "open" (not told yet); `headline` comes before anything else,
 * `details` after it.
 */
export function describe(scene, motion, now) {
  if (scene.data.chart) return describeChart(scene);
  if (scene.lanes) return describeRace(scene, motion, now);
  return motion === "flying" ? describeFlight(scene) : describeRun(scene);
}

const place = ({ v }, t, digits) => `${equals("t", t, "s", digits)}, ${equals("X", v * t, "m", digits)}`;
const wheel = (scene, { wheel, t }) => `${WHEEL[wheel]} wheel, ${place(scene, t)}`;
const least = (scene, verdict) => `least force ${unit(verdict.least, "N")} (${wheel(scene, verdict)})`;
const method = ({ scheme, dt }) => `${scheme.name} at ${equals("Δt", 1000 * dt, "ms")}`;

/** Whether the exact least force is so close to zero that its sign says nothing. */
const isEdge = ({ truth, data }) => Math.abs(truth.verdict.least) < data.edge;

function outcome(scene, verdict) {
  if (verdict === scene.truth.verdict && isEdge(scene)) return `on the edge, ${least(scene, verdict)}`;
  if (verdict.lost) return `contact lost (${wheel(scene, verdict.lost)})`;
  return `contact kept, ${least(scene, verdict)}`;
}

/** Whether two first losses, or lift-offs, are not the same one. */
const differ = (a, b, dt) =>
  !a !== !b || (Boolean(a) && (a.wheel !== b.wheel || Math.abs(a.t - b.t) > 2 * dt));

/** Whether a run tells another story than the exact motion. */
export function disagrees(scene) {
  const { run, truth, dt, data } = scene;
  if (isEdge(scene) && Math.abs(run.verdict.least) < 2 * data.edge) return false;
  return differ(run.verdict.lost, truth.verdict.lost, dt);
}

/** How much the fastest growing mode grows in a step. */
function growing({ growths }) {
  const most = Math.max(...growths);
  return `|R|\u00a0=\u00a0${most < 10 ? most.toFixed(5) : show(most, 4)}`;
}

/** What is to be said first of a scheme that fails, `exact` in few words; undefined if it does not. */
function failure(scene, exact) {
  if (!scene.run) return `${method(scene)} cannot take this step. Exactly: ${exact}.`;
  if (!scene.stable)
    return `Unstable: ${method(scene)} makes a mode grow by ${growing(scene)} every step. Exactly: ${exact}.`;
}

/** The exact answer without its numbers, which the details have. */
function inBrief(scene) {
  const { lost } = scene.truth.verdict;
  if (isEdge(scene)) return "on the edge";
  return lost ? `contact lost (${WHEEL[lost.wheel]} wheel)` : "contact kept";
}

const onEdge = (scene) => ({
  tone: "edge",
  headline: `On the edge: ${least(scene, scene.truth.verdict)}. The wheel just touches the ground.`,
});

function describeRun(scene) {
  const { run, truth, stable, data } = scene,
    exact = truth.verdict,
    failed = failure(scene, inBrief(scene)),
    details = [];
  let tone, headline;
  if (failed) {
    [tone, headline] = ["doubt", failed];
    details.push(`Exactly: ${outcome(scene, exact)}.`);
  } else if (disagrees(scene)) {
    tone = "doubt";
    const fault = !run.verdict.lost
      ? "misses a loss of contact"
      : exact.lost
        ? "finds another loss of contact"
        : "finds a loss of contact that is none";
    headline = `This run ${fault}. Exactly: ${outcome(scene, exact)}.`;
    details.push(`The run says: ${outcome(scene, run.verdict)}.`);
  } else if (isEdge(scene)) {
    ({ tone, headline } = onEdge(scene));
  } else {
    tone = run.verdict.lost ? "lost" : "kept";
    headline = `${capital(outcome(scene, run.verdict))}.`;
  }
  if (stable) {
    if (run.verdict.lost && tone === "lost")
      details.push(`${capital(least(scene, run.verdict))}, in a model whose ground can pull.`);
    details.push(`${method(scene)} is stable: the largest ${growing(scene)}.`);
    details.push(
      run.error < data.close
        ? `Its forces are exact to ${unit(data.close, "N", 1)}.`
        : `Its forces differ by up to ${unit(run.error, "N", 2)} from the exact ones.`,
    );
  }
  return { tone, headline, details: details.concat(remarks(scene, truth)) };
}

/** What else there is to know: a spring beyond its readings, a start that is none. */
function remarks({ data, settings }, { beyond }) {
  const found = [],
    away = (wheel) => Math.abs(wheel - data.shape.centre) / settings.sigma;
  const standing =
    data.hasBump && settings.height ? [0, 1].filter((i) => away(data.wheels[i]) < data.widths) : [];
  if (standing.length) {
    const wheels = standing.map((i) => WHEEL[i]).join(" and the ");
    found.push(
      `At the start the ${wheels} wheel already ${standing.length > 1 ? "stand" : "stands"} on the bump.`,
    );
  }
  if (!beyond.length) return found;
  return [
    ...found,
    `From ${equals("t", beyond[0][0], "s")} a spring is compressed further than it was measured (${unit(1000 * data.springEnd, "mm")}).`,
  ];
}

function describeFlight(scene) {
  const { flight, exactFlight, dt } = scene,
    [first] = flight.events,
    [exactly] = exactFlight.events;
  const lifts = ({ events }) =>
      events.length ? `wheels lift ${times(events)}` : "no wheel leaves the ground",
    story = (of) => (of.events.length ? `${lifts(of)}, first the ${wheel(scene, of.events[0])}` : lifts(of));
  const failed = failure(scene, isEdge(scene) ? inBrief(scene) : lifts(exactFlight)),
    details = first ? airOf(scene) : [];
  let tone, headline;
  if (failed) {
    [tone, headline] = ["doubt", failed];
    details.unshift(`Exactly: ${isEdge(scene) ? outcome(scene, scene.truth.verdict) : story(exactFlight)}.`);
  } else if (isEdge(scene) && !(first && exactly && differ(first, exactly, dt))) {
    ({ tone, headline } = onEdge(scene));
  } else if (differ(first, exactly, dt) || times(flight.events) !== times(exactFlight.events)) {
    tone = "doubt";
    const fault = !first
      ? "misses a lift-off"
      : exactly
        ? "leaves the ground otherwise"
        : "finds a lift-off that is none";
    headline = `This flight ${fault}. Exactly: ${story(exactFlight)}.`;
    details.unshift(`The flight says: ${story(flight)}.`);
  } else if (!first) {
    [tone, headline] = ["kept", "No wheel leaves the ground: flying and linear are the same."];
  } else {
    [tone, headline] = ["lost", `Off the ground: ${story(flight)}.`];
  }
  return { tone, headline, details: details.concat(remarks(scene, flight)) };
}

/** How often wheels lift. */
function times(events) {
  const count = events.filter(({ kind }) => kind === "lift-off").length;
  return ["once", "twice"][count - 1] ?? `${count} times`;
}

/** What there is to know of a flight: airtimes, beside the exact ones if they differ, and landings. */
function airOf(scene) {
  const { flight, exactFlight, data } = scene;
  const list = (airtime) =>
    [0, 1]
      .filter((i) => airtime[i] > 0)
      .map((i) => `${WHEEL[i]} ${unit(1000 * airtime[i], "ms")}`)
      .join(", ");
  const own = list(flight.airtime),
    exact = list(exactFlight.airtime);
  const details = [
    `In the air: ${own}${own === exact ? "" : ` (exactly: ${exact || "no wheel"})`} of ${unit(1000 * scene.end, "ms")}.`,
  ];
  const landings = flight.events.filter(({ kind }) => kind === "landing"),
    hardest = landings.reduce((most, event) => (event.force > most.force ? event : most), { force: 0 });
  if (hardest.force > data.close)
    details.push(`Hardest landing: ${wheel(scene, hardest)}, with ${unit(hardest.force, "N")} at once.`);
  details.push(`By ${method(scene)}; a step in which a wheel leaves or lands is taken in two.`);
  return details;
}

/** One robot of a race, up to a time: its name, what has become of it, and in which tone. */
export function laneWords(lane, motion, t) {
  const name = `${unit(lane.v, "m/s")}`,
    off = [0, 1].filter((i) => airborne(lane, motion, t).some(([wheel]) => wheel === i)),
    which = off.length > 1 ? "both wheels" : `${WHEEL[off[0]]} wheel`;
  if (off.length)
    return {
      name,
      words: `${which} ${motion === "flying" ? "left the ground" : "lost contact"}`,
      tone: "alarm",
    };
  if (t < lane.end * (1 - 1e-9)) return { name, words: "" };
  return { name, words: "both wheels stayed on the ground", tone: "region" };
}

/** Which robots kept their wheels down: as far as they have come, at the moment shown. */
function describeRace({ lanes }, motion, now) {
  const arrived = lanes.filter((lane) => !now || now.t >= lane.end * (1 - 1e-9)),
    lost = arrived.filter((lane) => airborne(lane, motion, lane.end).length),
    kept = arrived.filter((lane) => !lost.includes(lane));
  const speeds = (some) => {
    const names = some.map(({ v }) => show(v));
    return `${names.length > 1 ? `${names.slice(0, -1).join(", ")} and ` : ""}${names.at(-1)}\u00a0m/s`;
  };
  const parts = [];
  if (kept.length) parts.push(`At ${speeds(kept)} both wheels stay on the ground`);
  if (lost.length) parts.push(`${parts.length ? "at" : "At"} ${speeds(lost)} a wheel leaves it`);
  if (!kept.length && lost.length) parts[0] = `At ${speeds(lost)} a wheel leaves the ground`;
  if (arrived.length < lanes.length)
    return {
      tone: "open",
      headline: parts.length
        ? `${parts.join("; ")}.`
        : "At which of these speeds does a wheel leave the ground?",
      details: [],
    };
  return {
    tone: !lost.length ? "kept" : kept.length ? "open" : "lost",
    headline: `${parts.join("; ")}.`,
    details: [],
  };
}

/** What the faint robot is, in a few words and in fewer, for a narrow picture. */
export const ghostWords = (motion, pinned) =>
  pinned
    ? ["faint: the pinned run", "faint: pinned"]
    : motion === "flying"
      ? ["faint: wheels held down (linear)", "faint: held down"]
      : ["faint: wheels free to lift", "faint: free to lift"];

/** Two lines that tell what solid, faint, dots, ticks and bands are. */
export function keyOf({ data, lanes, flight, run }, motion, pinned) {
  if (data.chart) return [];
  if (lanes)
    return [
      "One road, one clock: it goes slower while the fast ones cross, and says how much.",
      "Thick lines under the road: where a wheel was off the ground, rear wheel below, front wheel above.",
    ];
  const flying = motion === "flying" || !run,
    solid = flying
      ? "Solid: wheels are free to leave the ground"
      : "Solid: the linear model, whose ground also pulls a wheel down";
  const faint = pinned
    ? "faint and grey: the pinned run, at the same place"
    : flight.events.length
      ? flying
        ? "faint: the linear model, whose ground also pulls a wheel down"
        : "faint: the same robot, its wheels free to leave the ground"
      : "no wheel lifts, so that flying is the same";
  const pale = data.compact
    ? ""
    : ` Broad and pale: the ${flying ? "linear forces, exact" : "exact forces"}.`;
  const dots =
    "Full dots, ticks above the slider: speeds where the verdict turns; open dots, ticks below: the speeds asked for; bands: contact kept or lost, by the linear model.";
  const air =
    flying && !data.compact
      ? " Among the forces: open dots where a wheel lifts, full ones where it lands; bands of half the height while it is in the air, rear wheel above, front below."
      : "";
  return [`${solid}; ${faint}.${pale}`, dots + air];
}

/** Numbers in three digits, or in as many as tell each from the next. */
export function distinct(values) {
  for (let digits = 3; ; digits++) {
    const names = values.map((value) => show(value, digits));
    if (digits > 9 || new Set(names).size === names.length) return names;
  }
}

/** Where a bump of this height is crossed with contact, and whether more speed ever restores it. */
function describeChart({ data, curve: { critical, kept }, settings: { height } }) {
  const bump = height > 0 ? `a bump of ${unit(1000 * height, "mm")}` : "a level road",
    names = distinct(critical),
    [low, high] = data.ranges.v;
  if (!critical.length) {
    const everywhere = `at every speed from ${show(low)} to ${unit(high, "m/s")}`;
    return {
      tone: kept ? "kept" : "lost",
      headline: `Over ${bump} contact is ${kept ? "kept" : "lost"} ${everywhere}.`,
      details: [],
    };
  }
  const verdicts = Array.from({ length: critical.length + 1 }, (_, i) => kept === (i % 2 === 0));
  const parts = verdicts.map((good, i) => {
    const where =
      i === 0
        ? `up to ${names[0]}\u00a0m/s`
        : i === critical.length
          ? "from there on"
          : `from ${names[i - 1]} to ${names[i]}\u00a0m/s`;
    return `${good ? "kept" : "lost"} ${where}`;
  });
  const open = verdicts.some((good, i) => good && i > 0);
  // A range that is kept beyond one that is lost; the curve may rise without one.
  const window = open
    ? "The window is open: more speed restores contact."
    : `The window is closed: more speed, up to ${unit(high, "m/s")}, does not restore contact.`;
  return {
    tone: open ? "kept" : "lost",
    headline: `${window} Over ${bump} contact is ${parts.slice(0, -1).join(", ")} and ${parts.at(-1)}.`,
    details: [],
  };
}

/** What a run is, and what was said of it: for one that is kept to compare others with. */
export function describePinned({ settings: { v, k, c }, scheme, dt }, motion, headline) {
  const how = `${motion === "flying" ? "flying, " : ""}${method({ scheme, dt })}`;
  const robot = `${equals("k", k, "N/m")}, ${equals("c", c, "N\u00a0s/m")}`;
  return `Pinned, in grey at the same X: ${equals("v", v, "m/s")}, ${robot}, ${how}. ${headline}`;
}

/** "slowed 64 ×": how a clock goes. */
export function paceWords(slower) {
  if (slower > 1.05) return `slowed ${show(slower, 2)}\u00a0×`;
  return slower < 0.95 ? `${show(1 / slower, 2)}\u00a0× faster` : "in real time";
}

/** The moment shown, for the clock; `more` is how fast the clock goes, or what happens there. */
export function describeMoment(now, motion, more = "") {
  const { t, X, lanes } = now,
    N = now[motion].N,
    time = `t\u00a0=\u00a0${show(t)}\u00a0s`;
  if (lanes) return `${time}   ${more}`;
  return `${time}   X\u00a0=\u00a0${show(X)}\u00a0m   N₁\u00a0=\u00a0${show(N[0])}\u00a0N   N₂\u00a0=\u00a0${show(N[1])}\u00a0N${more && `   ${more}`}`;
}
