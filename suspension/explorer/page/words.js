// What the pictures say, in words: never more certain than the numbers.

import { show } from "./pen.js";

export const WHEEL = ["rear", "front"];
export const CLOSE = 1e-5; // N; forces that differ by less are called equal

export const unit = (x, name, digits) => `${show(x, digits)}\u00a0${name}`;
const equals = (name, ...value) => `${name}\u00a0=\u00a0${unit(...value)}`; // on one line
const capital = (text) => text[0].toUpperCase() + text.slice(1);

/**
 * `tone` is "kept", "lost" or "doubt" (where the run and the exact answer differ, or there is no
 * verdict); `headline` comes before anything else, `details` after it.
 */
export function describe(scene, motion) {
  if (scene.data.chart) return describeChart(scene);
  return motion === "flying" ? describeFlight(scene) : describeRun(scene);
}

const place = ({ v }, t, digits) => `${equals("t", t, "s", digits)}, ${equals("X", v * t, "m", digits)}`;
const wheel = (scene, { wheel, t }) => `${WHEEL[wheel]} wheel, ${place(scene, t)}`;
const least = (scene, verdict) => `least force ${unit(verdict.least, "N")} (${wheel(scene, verdict)})`;

function outcome(scene, verdict) {
  if (verdict.lost) return `contact lost (${wheel(scene, verdict.lost)})`;
  return `contact kept, ${least(scene, verdict)}`;
}

/** Whether a run tells another story than the exact motion. */
export function disagrees({ run, truth, dt }) {
  const [a, b] = [run.verdict.lost, truth.verdict.lost];
  if (!a !== !b) return true;
  return Boolean(a) && (a.wheel !== b.wheel || Math.abs(a.t - b.t) > 2 * dt);
}

function describeRun(scene) {
  const { run, truth, stable, scheme, dt, growths } = scene,
    exact = truth.verdict;
  const method = `${scheme.name} at ${equals("Δt", 1000 * dt, "ms")}`,
    details = [];
  const most = Math.max(...growths),
    R = `|R|\u00a0=\u00a0${most < 10 ? most.toFixed(5) : show(most, 4)}`;
  let tone, headline;
  if (!run) {
    [tone, headline] = ["doubt", `${method} cannot take this step. Exactly: ${outcome(scene, exact)}.`];
    return { tone, headline, details: details.concat(remarks(scene, truth)) };
  }
  if (!stable) {
    tone = "doubt";
    headline = `Unstable: ${method} makes a mode grow by ${R} every step. Exactly: ${outcome(scene, exact)}.`;
  } else if (disagrees(scene)) {
    tone = "doubt";
    const [a, b] = [run.verdict.lost, exact.lost];
    const fault = !a
      ? "misses a loss of contact"
      : b
        ? "finds another loss of contact"
        : "finds a loss of contact that is none";
    headline = `This run ${fault}. Exactly: ${outcome(scene, exact)}.`;
    details.push(`The run says: ${outcome(scene, run.verdict)}.`);
  } else {
    tone = run.verdict.lost ? "lost" : "kept";
    headline = `${capital(outcome(scene, run.verdict))}.`;
  }
  if (stable) {
    if (run.verdict.lost && tone === "lost")
      details.push(`${capital(least(scene, run.verdict))}, in a model whose ground can pull.`);
    details.push(`${method} is stable: the largest ${R}.`);
    details.push(
      run.error < CLOSE
        ? `Its forces are exact to ${unit(CLOSE, "N", 1)}.`
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
  const { flight } = scene,
    { events, airtime } = flight;
  if (!events.length) {
    return {
      tone: "kept",
      headline: "No wheel leaves the ground: flying and linear are the same.",
      details: remarks(scene, flight),
    };
  }
  const first = events[0],
    landings = events.filter(({ kind }) => kind === "landing");
  const times = [0, 1]
    .filter((i) => airtime[i] > 0)
    .map((i) => `${WHEEL[i]} ${unit(1000 * airtime[i], "ms")}`);
  const hardest = landings.reduce((most, event) => (event.force > most.force ? event : most), { force: 0 });
  const details = [`In the air: ${times.join(", ")} of ${unit(1000 * scene.end, "ms")}.`];
  if (hardest.force > CLOSE)
    details.push(`Hardest landing: ${wheel(scene, hardest)}, with ${unit(hardest.force, "N")} at once.`);
  details.push(`Steps of ${unit(1000 * flight.dt, "ms")}, parted where a wheel leaves or lands.`);
  const count = events.filter(({ kind }) => kind === "lift-off").length;
  const how = ["once", "twice"][count - 1] ?? `${count} times`;
  return {
    tone: "lost",
    headline: `Off the ground ${how}, first the ${wheel(scene, first)}.`,
    details: details.concat(remarks(scene, flight)),
  };
}

/** Numbers in three digits, or in as many as tell each from the next. */
export function distinct(values) {
  for (let digits = 3; ; digits++) {
    const names = values.map((value) => show(value, digits));
    if (digits > 9 || new Set(names).size === names.length) return names;
  }
}

/** Where a bump of this height is crossed with contact, and whether more speed ever restores it. */
export function describeChart({ data, curve: { critical, kept }, settings: { height } }) {
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
export function describePinned({ v, k, c, dt }, scheme, motion, headline) {
  const how = motion === "flying" ? "flying" : `${scheme.name}, ${equals("Δt", 1000 * dt, "ms")}`;
  const robot = `${equals("k", k, "N/m")}, ${equals("c", c, "N\u00a0s/m")}`;
  return `Pinned, in grey at the same X: ${equals("v", v, "m/s")}, ${robot}, ${how}. ${headline}`;
}

/** The moment shown, for the clock. */
export function describeMoment(now, motion) {
  const { t, X } = now,
    N = now[motion].N;
  return `t\u00a0=\u00a0${show(t)}\u00a0s   X\u00a0=\u00a0${show(X)}\u00a0m   N₁\u00a0=\u00a0${show(N[0])}\u00a0N   N₂\u00a0=\u00a0${show(N[1])}\u00a0N`;
}
