// What follows from one's own robot and road, in words: a function for each thing that is told, a branch
// for each case.

import { limitOf } from "./own_scene.js";
import { UNITS } from "./own_state.js";
import { show } from "./pen.js";

const SPACE = "\u00a0",
  WHEEL = ["rear", "front"],
  NEAR = 0.5; // of a limit, within which it says what happens

const GROUPS = [
  ["ν", "v / σω₀", "nu", "speed: widths passed in a swing's 1/ω₀"],
  ["ζ", "c / √(2km)", "zeta", "damping, as a part of the critical"],
  ["η", "h₀ / (mg/2k)", "eta", "height, in sags of the springs"],
  ["j", "Izz / mL²", "j", "inertia: 1 if the mass sits over the wheels"],
  ["λ", "L / σ", "lam", "half of the wheelbase, in widths"],
];

/** A quantity of a kind in the units that are read. */
export function say(x, kind, { units }, digits = 3) {
  const [factor, unit] = UNITS[units][kind];
  return `${show(factor * x, digits)}${SPACE}${unit}`;
}
const of = (x, unit, digits = 3) => `${show(x, digits)}${SPACE}${unit}`;
const percent = (part) => of(100 * part, "%", 2);
const join = (words, last = "and") =>
  words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} ${last} ${words.at(-1)}`;

/** The verdict at the speed that is set; "tone" is kept, lost or doubt. */
export function tellVerdict(scene) {
  const { state, vehicle, distance, least, lost, until, isLevel } = scene,
    at = `at ${say(state.v, "speed", state)}`;
  if (scene.isTooLong)
    return {
      tone: "doubt",
      words: `No verdict ${at}: on ${say(distance, "far", state)} the robot would swing too often to be followed. Drive faster, shorten the way, or take softer dampers.`,
    };
  if (!lost) {
    const wheel = least[0].force <= least[1].force ? 0 : 1,
      { force, X } = least[wheel];
    if (isLevel)
      return { tone: "kept", words: `The road is level: contact is kept ${at}, and at any speed.` };
    return {
      tone: "kept",
      words: `Contact is kept ${at}. The least force is ${of(force, "N")}, ${percent(force / vehicle.load[wheel])} of its load, on the ${WHEEL[wheel]} wheel at X = ${say(X, "far", state)}.`,
    };
  }
  const { wheel, X } = lost,
    other = 1 - wheel;
  return {
    tone: "lost",
    words: `Contact is lost ${at}: first the ${WHEEL[wheel]} wheel lifts, at X = ${say(X, "far", state)}, after ${of(X / state.v, "s")}. Until then the ${WHEEL[other]} wheel presses with ${of(until[other].force, "N")} or more.`,
  };
}

/** The wheels one by one: load at rest, least force, where. After a loss the linear model says no more. */
export function wheelRows({ state, vehicle, least, lost, until, isTooLong }) {
  if (isTooLong) return [];
  return [0, 1].map((i) => {
    const name = WHEEL[i],
      load = of(vehicle.load[i], "N");
    if (!lost) return [name, load, of(least[i].force, "N"), say(least[i].X, "far", state)];
    if (lost.wheel === i) return [name, load, "lifts", say(lost.X, "far", state)];
    return [name, load, `${of(until[i].force, "N")} until then`, say(until[i].X, "far", state)];
  });
}

/** In which ranges of speed contact is kept, and which of the speeds are critical. */
export function tellSpeeds({ state, speeds, critical, kept, isSure, isLevel }) {
  if (isLevel) return "";
  const [low, high] = speeds,
    ends = `From ${show(UNITS[state.units].speed[0] * low)} to ${say(high, "speed", state)}`;
  if (!critical) return `${ends}: looking …`;
  const edges = [low, ...critical, high];
  const spans = edges
    .slice(1)
    .map((to, i) => [edges[i], to, kept === (i % 2 === 0)])
    .filter(([, , isKept]) => isKept)
    .map(([from, to]) => {
      if (from === low) return `below ${say(to, "speed", state, 4)}`;
      if (to === high) return `above ${say(from, "speed", state, 4)}`;
      return `from ${show(UNITS[state.units].speed[0] * from, 4)} to ${say(to, "speed", state, 4)}`;
    });
  const sure = isSure ? "" : " Looking closer …";
  if (!critical.length) return `${ends} contact is ${kept ? "kept" : "lost"} at every speed.${sure}`;
  if (!spans.length) return `${ends} contact is lost at every speed.${sure}`;
  return `${ends} contact is kept ${join(spans)}, and lost elsewhere.${sure}`;
}

/** What is read from the chart: where the vehicle stands, and which limit by hand is near. */
export function tellChart(scene, facts) {
  const { state, groups, shape, isLevel, isTooLong, multiple, isBump } = scene;
  if (isLevel) return "A level road has no highest bump: draw one, paste one, or start from one.";
  if (isTooLong) return "";
  const what = isBump ? "the bump" : shape.height < 0 ? "the hole" : "the road",
    size = shape.height < 0 ? "deep" : "high",
    allowed = Math.abs(shape.height) * multiple;
  const may =
    multiple === Infinity
      ? `Here no height of ${what} lifts a wheel.`
      : `Here ${what} may be ${say(allowed, "length", state)} ${size}, ${show(multiple)} times what it is.`;
  if (!groups)
    return `${may} This robot is not symmetric: it has no groups, and the chart is in its own units. “Both axles alike” makes the symmetric robot with the means of both.`;
  const { nu, eta } = groups,
    place = `The vehicle stands at ν${SPACE}=${SPACE}${show(nu)}, η${SPACE}=${SPACE}${show(eta)}: ${multiple > 1 ? "below" : "above"} its curve.`;
  const own = isBump ? nearestLimit(scene, facts) : "";
  return [place, may, own].filter(Boolean).join(" ");
}

/** The limit by hand that says what happens to a bump, if one does. */
function nearestLimit({ groups, multiple }, { byHand }) {
  const exact = groups.eta * multiple,
    [nearest] = byHand
      .map((limit) => ({ name: limit.name, height: limitOf(limit, groups) }))
      .filter(({ height }) => Number.isFinite(height))
      .map((limit) => ({ ...limit, off: Math.abs(Math.log(limit.height / exact)) }))
      .sort((a, b) => a.off - b.off);
  if (!(nearest?.off < Math.log(1 + NEAR))) return "No limit by hand is near.";
  const by = Math.abs(nearest.height / exact - 1),
    side = nearest.height > exact ? "above" : "below";
  return `The nearest limit by hand is “${nearest.name}”, ${by < 5e-4 ? "right on it" : `${percent(by)} ${side} it`}.`;
}

/** What the chart has besides, where the road is no bump. */
export function tellStandIn({ shape, isBump, isLevel, groups, state }) {
  if (isBump || isLevel)
    return "Draw on the road: with the mouse, with a finger that pulls sideways, or with the arrow keys.";
  const isHole = shape.height < 0,
    alike = `${isHole ? "a hole" : "a bump"} ${say(Math.abs(shape.height), "length", state)} ${isHole ? "deep" : "high"} and as steep as the road, σ${SPACE}=${SPACE}${say(shape.sigma, "length", state)}`,
    whose = groups ? `ν and λ are those of ${alike}.` : `Alike is ${alike}.`;
  return isHole
    ? `${whose} The limits by hand are for bumps; a hole has none.`
    : `${whose} Its curve is dotted: what else the road's shape does lies between the two.`;
}

/** The groups: symbol, formula, value, what it says. An unsymmetric robot has none. */
export const groupRows = ({ groups }) =>
  groups ? GROUPS.map(([symbol, formula, name, says]) => [symbol, formula, show(groups[name], 4), says]) : [];

/** How the robot swings, mode by mode, and how it stands at rest. */
export function tellModes({ vehicle: { modes, equilibrium }, state }) {
  const swings = modes
      .filter(([, im]) => im > 0)
      .map(([re, im]) => {
        const size = Math.hypot(re, im),
          damping = re === 0 ? "no damping" : `${show(-re / size)} of the critical damping`;
        return `${of(size / (2 * Math.PI), "Hz")} (${damping})`;
      }),
    decays = modes.filter(([, im]) => im === 0).map(([re]) => of(-1 / re, "s")),
    does = [
      swings.length ? `swings at ${join(swings)}` : "",
      decays.length ? `comes back without a swing in ${join(decays)}` : "",
    ];
  const tilt =
    Math.abs(equilibrium[2]) < 1e-12 ? "" : `, and tilts by ${of((180 * equilibrium[2]) / Math.PI, "°", 2)}`;
  return `It ${join(does.filter(Boolean))}. At rest it sags by ${say(-equilibrium[0], "length", state)}${tilt}.`;
}

/** Whether the way is long enough to see all. */
export function tellWay({ state, distance, needed, usual }) {
  if (distance < needed)
    return `The way ends before both wheels have left the road: drive ${say(needed, "far", state)} or more to see all of it.`;
  return state.distance === null
    ? `Usual for this road: ${say(usual, "far", state)}.`
    : `Usual for this road would be ${say(usual, "far", state)}.`;
}
