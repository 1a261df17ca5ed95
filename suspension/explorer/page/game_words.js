// What a game says: the task, a lane, the verdict on an attempt. One function for each thing that is
// told, a branch for each case.

import { change } from "./game_run.js";
import { show } from "./pen.js";
import { unit, WHEEL } from "./words.js";

const NEAR = 0.01, // of the best distance, that counts as having reached it
  SAME = 1e-6; // of a distance, or a part of the way
const percent = (part) => `${show(100 * part)}\u00a0%`;
const capital = (words) => words[0].toUpperCase() + words.slice(1);

/** A force to a tenth of a millinewton; within roundoff of nothing it is nothing. */
const force = (N) => unit(Math.max(Math.round(1e4 * N) / 1e4, 0), "N");
const list = (words) =>
  words.length > 1 ? `${words.slice(0, -1).join(", ")} and ${words.at(-1)}` : words[0];
const speeds = (some) => `${list(some.map((v) => show(v)))}\u00a0m/s`;

/** What the lanes and the score are, once for all. */
export const KEY =
  "Each robot has a clock of its own, so that all are at the same place. Thick lines under the road: where a wheel was in the air, rear wheel below, front wheel above.";
export const RULES =
  "The score is how far the suspension is from the present one, d = √(ln²(k/k₀) + ln²(c/c₀)): half and twice are equally far, and stiffness and damping count alike. On the map, click or tap a place to choose it, or use the arrow keys.";

/** "Road A", of a level. */
export const roadName = (level) => (level ? `Road ${String.fromCharCode(64 + level)}` : "The bump");

/** What is known of a road: nothing, what one has driven over, or all. */
export function roadWords({ bump: { height, sigma } }, isSeen, isTold) {
  if (!isSeen) return "An unknown road: it shows as you drive over it.";
  const kind = height < 0 ? "dip" : "bump";
  if (!isTold) return `A ${kind}.`;
  return `A ${kind}, ${unit(1000 * Math.abs(height), "mm")} ${height < 0 ? "deep" : "high"}, with σ = ${unit(1000 * sigma, "mm")}.`;
}

/** What is asked for on a road, and the answer to beat. */
export function taskWords({ kind, reserve, distance, air }, asked) {
  const at = `at ${speeds(asked)}`,
    beat = `To beat: d = ${show(distance)}.`;
  if (kind === "air")
    return `No suspension of the map keeps both wheels on the ground ${at}. So keep them in the air as little as you can, at the worst of these speeds. To beat: ${percent(air)} of the way.`;
  if (kind === "contact")
    return distance
      ? `Keep both wheels on the ground ${at}, and change the suspension as little as you can. ${beat}`
      : `Both wheels stay on the ground ${at} with the suspension as it is: nothing has to be changed.`;
  const more = `Both wheels stay on the ground ${at} as it is, so here more is asked: at least ${unit(reserve, "N")} on each wheel`;
  return distance
    ? `${more}, with as little change as you can. ${beat}`
    : `${more}. That it has, too, and no suspension of the map has a tenth of the load more: nothing has to be changed.`;
}

/** A ratio to the present suspension. */
export const times = (ratio) =>
  Math.abs(ratio - 1) < SAME ? "as it is" : `${show(ratio)}\u00a0times as it is`;

/** How far what is chosen is from the present suspension. */
export function changeWords(facts, k, c) {
  const { own } = facts,
    d = change(facts, k, c);
  if (d < SAME) return "d\u00a0=\u00a00: the suspension as it is.";
  return `d\u00a0=\u00a0${show(d)}: k ${times(k / own.k)}, c ${times(c / own.c)}.`;
}

/** How a speed went, short. */
export function laneWords({ state, wheel, margin, lost, air, end }) {
  if (state === "kept") return `kept, ${force(margin)} to spare`;
  if (state === "short") return `kept, but only ${force(margin)} left (${WHEEL[wheel]})`;
  return `lost: ${WHEEL[lost.wheel]}, ${air > 0 ? `${unit(1000 * air * end, "ms")} in the air` : "for an instant"}`;
}

const place = ({ wheel, X }) => `${WHEEL[wheel]}, X\u00a0=\u00a0${unit(X, "m")}`;

/** A row of the table of speeds: speed, contact, least force, where. */
export function laneRow(lane) {
  const { v, state, margin, lost, air } = lane,
    name = unit(v, "m/s");
  if (state === "lost") return [name, "lost", "–", place(lost), air > 0 ? percent(air) : "–"];
  return [name, state === "kept" ? "kept" : "too little left", force(margin), place(lane), "0"];
}

/** What is wrong, or nothing. */
function failed({ lanes }) {
  const lost = lanes.filter(({ state }) => state === "lost").map(({ v }) => v),
    short = lanes.filter(({ state }) => state === "short").map(({ v }) => v);
  const parts = [
    ...(lost.length ? [`contact is lost at ${speeds(lost)}`] : []),
    ...(short.length ? [`too little is left at ${speeds(short)}`] : []),
  ];
  return parts.length ? `${capital(list(parts))}.` : "";
}

/** The best of some attempts that do what is asked for, for a button: " ✓ 1.09", or nothing. */
export function scoreWords(attempts, { kind }) {
  const scores = attempts
    .filter(({ isReached }) => isReached)
    .map(({ distance, air }) => (kind === "air" ? air : distance));
  if (!scores.length) return "";
  const best = Math.min(...scores);
  return `\u00a0✓ ${kind === "air" ? percent(best) : show(best)}`;
}

/** Whether an attempt is as good as the answer to beat. */
export function isBest({ isReached, distance, air }, goal) {
  if (goal.kind === "air") return isReached && air <= goal.air + SAME;
  return isReached && distance <= goal.distance * (1 + NEAR) + SAME;
}

/** The verdict on an attempt: `tone` is "kept" or "lost", `words` what is said. */
export function verdict(drive, goal) {
  const { distance, air, isReached } = drive,
    d = `d = ${show(distance)}`;
  if (goal.kind === "air") {
    const words = `In the air for ${percent(air)} of the way at the worst speed, with ${d}.`;
    if (!isReached) return { tone: "lost", words: `${words} The best of the map has ${percent(goal.air)}.` };
    const beaten =
      air < goal.air - SAME ? "That is less than the best of the map had." : "That is the best of the map.";
    return { tone: "kept", words: `${words} ${beaten}` };
  }
  const done =
    goal.kind === "reserve" ? "Contact with enough to spare at every speed" : "Contact kept at every speed";
  if (!isReached) {
    const near = distance < goal.distance - SAME ? " So near to what it was, nothing does it." : "";
    return { tone: "lost", words: `${failed(drive)} With ${d}.${near}` };
  }
  if (distance <= SAME) return { tone: "kept", words: `${done}, and nothing is changed.` };
  if (distance < goal.distance - SAME)
    return {
      tone: "kept",
      words: `${done}, with ${d}: nearer than the answer to beat, ${show(goal.distance, 4)}.`,
    };
  if (isBest(drive, goal))
    return { tone: "kept", words: `${done}, with ${d}. Solved: to a hundredth, nothing nearer does it.` };
  return { tone: "kept", words: `${done}, with ${d}. It can be done with ${show(goal.distance)}.` };
}

/** An attempt in a few words: "kept", "lost at 1.2 and 5 m/s". */
export function outcome(drive, goal) {
  const lost = drive.lanes.filter(({ state }) => state !== "kept").map(({ v }) => v);
  if (goal.kind === "air") return `${percent(drive.air)} in the air`;
  if (!lost.length) return isBest(drive, goal) ? "kept, solved" : "kept";
  const isShort = drive.lanes.every(({ state }) => state !== "lost");
  return `${isShort ? "too little left" : "lost"} at ${speeds(lost)}`;
}

const HOW = { "": "", map: " (with the map)", link: " (from the link)" };

/** A row of the table of attempts. */
export const attemptRow = (drive, goal, how) => [
  show(drive.k, 4),
  show(drive.c, 4),
  show(drive.distance),
  outcome(drive, goal) + HOW[how],
];

/** What the map shows. */
export function mapWords(level, isUncovered, count) {
  const trail = count
    ? `Your ${count > 1 ? `${count} attempts` : "attempt"}: filled where all is kept.`
    : "No attempt yet.";
  if (!isUncovered) return `${trail} Where all is kept is covered.`;
  const { kind, best } = level,
    where = `${unit(best.k, "N/m", 4)} and ${unit(best.c, "N\u00a0s/m", 4)}`;
  if (kind === "air")
    return `${trail} Nowhere on this map is contact kept at all asked speeds; the darker, the more of them are lost. The diamond: the answer to beat, ${where}.`;
  return `${trail} Green: all is kept; the darker beside it, the more speeds fail. A line for each speed: on one side of it that speed fails. Dashed: all suspensions as far away as the answer to beat, ${where}, the diamond.`;
}
