// How time runs: what happens when, how fast the clock goes, and where it goes slower by itself.

import { fractionAt, timeAt, toldVerdict } from "./scene.js";
import { unit, WHEEL } from "./words.js";

export const SECONDS = 8; // one crossing, played, where nothing slows it
const SLOWER = 3; // times, around a lift-off and a landing
const AROUND = 0.01; // of the crossing, before and after
const MOST = 12; // events of a wheel that are told one by one

const kept = new WeakMap();

/**
 * What happens on the way, in order: { at, words, turns }, a fraction of the crossing; `turns` where
 * a wheel leaves the ground or lands and the clock goes slower: that of a race is slow enough.
 */
export function eventsOf(scene, motion) {
  const known = kept.get(scene);
  if (known?.motion === motion) return known.events;
  const lanes = scene.lanes ?? [scene],
    events = [];
  for (const lane of lanes) {
    const name = scene.lanes ? `${unit(lane.v, "m/s")}: ` : "";
    for (const { t, words, turns } of happenings(lane, motion))
      if (t >= 0 && t <= lane.end)
        events.push({ at: fractionAt(scene, t), words: name + words, turns: turns && !scene.lanes });
  }
  events.push({ at: 0, words: "the start" }, { at: 1, words: "the end" });
  events.sort((a, b) => a.at - b.at);
  kept.set(scene, { motion, events });
  return events;
}

function happenings(scene, motion) {
  const { data, settings, v, run, flight } = scene,
    found = [];
  if (data.hasBump && settings.height)
    data.wheels.forEach((offset, i) =>
      found.push({ t: (data.shape.centre - offset) / v, words: `${WHEEL[i]} wheel on top of the bump` }),
    );
  if (motion === "flying" || !run) {
    const ways = { "lift-off": "leaves the ground", landing: "lands" };
    for (const { wheel, kind, t } of flight.events.slice(0, 2 * MOST))
      found.push({ t, words: `${WHEEL[wheel]} wheel ${ways[kind]}`, turns: true });
    if (flight.events.length) return found;
  } else if (run.verdict.lost) {
    for (const i of [0, 1]) found.push(...changes(run, i));
    return found;
  }
  const { wheel, t } = toldVerdict(scene);
  found.push({ t, words: `least force, ${WHEEL[wheel]} wheel` });
  return found;
}

/** Where the sign of a force changes. */
function changes({ N, J, dt }, i) {
  const found = [];
  for (let n = 1; n <= J && found.length < MOST; n++) {
    const [a, b] = [N[i][n - 1], N[i][n]];
    if (a > 0 === b > 0) continue;
    const words = `${WHEEL[i]} wheel: ${b > 0 ? "the road pushes again" : "contact lost"}`;
    found.push({ t: n * dt, words, turns: true });
  }
  return found;
}

/** The event at a fraction of the crossing, or undefined; the one before it; the one after it. */
export function eventAt(events, at) {
  return events.find((event) => Math.abs(event.at - at) < 1e-6);
}
export function eventBeside(events, at, way) {
  return way > 0
    ? events.find((event) => event.at > at + 2e-6)
    : events.findLast((event) => event.at < at - 2e-6);
}

/** Seconds that the clock takes for a crossing that is played, by the choice of the reader. */
export const secondsFor = (scene, choice) =>
  choice === "same" ? scene.data.pace * scene.end : SECONDS * (scene.lanes ? 1.5 : 1);

/** How many times slower it goes at a fraction of the crossing. */
export const slowing = (events, at) =>
  events.some((event) => event.turns && Math.abs(event.at - at) < AROUND) ? SLOWER : 1;

/** How many times slower than real time the clock goes. */
export function paceOf(scene, events, choice, at) {
  const [a, b] = [Math.max(at - 1e-4, 0), Math.min(at + 1e-4, 1)],
    rate = (timeAt(scene, b) - timeAt(scene, a)) / (b - a);
  return (secondsFor(scene, choice) * slowing(events, at)) / rate;
}
