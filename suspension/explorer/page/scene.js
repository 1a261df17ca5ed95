// Everything that is shown at the present settings, computed anew only where something changed.

import {
  countSteps,
  difference,
  fly,
  growth,
  judge,
  judgeExactly,
  lookUp,
  makeCurve,
  makeHighest,
  makeMemory,
  makeRoad,
  makeRobot,
  reference,
  simulate,
} from "./model.js";
import { disagrees } from "./words.js";

const STABLE = 1 + 1e-12; // as in Python

/** Computed by `make`, again only if the values of `key` are others than the last time. */
function remember() {
  const kept = new Map();
  return (name, key, make) => {
    const text = key.join();
    if (kept.get(name)?.text !== text) kept.set(name, { text, value: make() });
    return kept.get(name).value;
  };
}

/** A function of the settings that returns the scene. The next call overwrites its long arrays. */
export function makeScenes(data) {
  const once = remember(),
    spaces = Object.fromEntries(
      ["run", "truth", "flight", "exactFlight"].map((name) => [name, makeMemory()]),
    );
  return (settings) => {
    const { v, dt, k, c, height, sigma, scheme_index } = settings,
      scheme = data.schemes[scheme_index];
    const end = data.distance / v,
      J = countSteps(end, dt);
    const robot = once("robot", [k, c], () => makeRobot(data, settings));
    const road = once("road", [height, sigma], () => makeRoad(data.shape, settings));
    const here = [k, c, height, sigma],
      there = [...here, v];
    const curve = () => once("curve", here, () => makeCurve(data, robot, road, settings));
    const highestBumps = () => once("chart", here, () => makeHighest(data, robot, curve(), settings));
    const truth = once("truth", [...there, dt], () => {
      const found = reference(data, robot, road, settings, spaces.truth);
      return { ...found, verdict: judgeExactly(found), beyond: beyond(data, robot, road, found) };
    });
    const run = once("run", [...there, dt, scheme_index], () => {
      const found = simulate(data, robot, road, scheme, v, dt, J, spaces.run);
      return found && { ...found, verdict: judge(found), error: difference(found, truth) };
    });
    const exactFlight = () =>
      once("exact flight", [...there, truth.verdict.lost ? "" : truth.J], () =>
        truth.verdict.lost ? fly(data, robot, road, settings, spaces.exactFlight) : grounded(truth),
      );
    // By the same scheme and step as the run; the exact one if it cannot take the step.
    const flight = once("flight", [...there, dt, scheme_index], () => {
      const isFine = truth.each === 1, // then a wheel that lifts is not missed between two samples
        found =
          run?.verdict.lost === null && isFine
            ? grounded(run)
            : (fly(data, robot, road, settings, spaces.flight, { scheme, dt }) ?? exactFlight());
      return { ...found, beyond: beyond(data, robot, road, found) };
    });
    const growths = robot.modes.map(([re, im]) => growth(scheme, [re * dt, im * dt]));
    const stable = run !== null && growths.every((size) => size <= STABLE);
    return {
      data,
      settings,
      v,
      dt,
      end,
      J,
      scheme,
      robot,
      road,
      // Only some pictures need these.
      get curve() {
        return curve();
      },
      get highestBumps() {
        return highestBumps();
      },
      get exactFlight() {
        return exactFlight();
      },
      flight,
      truth,
      run,
      growths,
      stable,
    };
  };
}

/** A flight that never leaves the ground: the exact run. */
function grounded(truth) {
  return { ...truth, gaps: [0, 1].map(() => new Float64Array(truth.J + 1)), events: [], airtime: [0, 0] };
}

/** When a spring is compressed further than it was measured, if that is known: pairs of times. */
function beyond(data, robot, road, { W, J, dt, v }) {
  if (data.springEnd === null) return [];
  const { Cp, Dp } = robot,
    u = new Float64Array(4),
    ranges = [];
  let since = null;
  for (let n = 0; n <= J; n++) {
    data.wheels.forEach((offset, i) => road(v * n * dt + offset, u, i, v));
    const far = [0, 1].some((i) => {
      let p = 0;
      for (let j = 0; j < 4; j++) p += Cp[i][j] * W[j][n] + Dp[i][j] * u[j];
      return p > data.springEnd;
    });
    if (far && since === null) since = n * dt;
    if (!far && since !== null) [since] = [null, ranges.push([since, n * dt])];
  }
  if (since !== null) ranges.push([since, J * dt]);
  return ranges;
}

/** Robots at several speeds, for a race: the scene of the slowest, with those of all as its `lanes`. */
export function makeRaces(data) {
  const makers = data.lanes.map(() => makeScenes(data));
  return (settings) => {
    const lanes = makers.map((sceneAt, i) => sceneAt({ ...settings, v: data.lanes[i] }));
    const slowest = lanes.reduce((a, b) => (b.v < a.v ? b : a));
    return Object.assign(slowest, { lanes });
  };
}

/**
 * The time at a fraction of what is played: of one crossing; or of a race, where each robot gets as
 * much of it as the next faster one, for the way that is left to it.
 */
export function timeAt(scene, fraction) {
  const stops = stagesOf(scene),
    stage = Math.min(Math.floor(fraction * (stops.length - 1)), stops.length - 2),
    part = fraction * (stops.length - 1) - stage;
  return part === 1 ? stops[stage + 1] : stops[stage] + part * (stops[stage + 1] - stops[stage]);
}

/** The fraction at a time. */
export function fractionAt(scene, t) {
  const stops = stagesOf(scene),
    found = stops.findIndex((stop) => t <= stop),
    stage = found < 0 ? stops.length - 1 : Math.max(found, 1);
  return Math.min(
    (stage - 1 + (t - stops[stage - 1]) / (stops[stage] - stops[stage - 1])) / (stops.length - 1),
    1,
  );
}

const stagesOf = ({ lanes, end }) => [
  0,
  ...new Set(lanes ? lanes.map((lane) => lane.end).sort((a, b) => a - b) : [end]),
];

/** What is shown at a time: of the linear run and of the flight. */
export function momentAt(scene, t) {
  const linear = scene.run ? lookUp(scene.run, t / scene.dt) : { t, W: [0, 0, 0, 0], N: [NaN, NaN] };
  return { t, X: scene.v * t, linear, flying: lookUp(scene.flight, t / scene.flight.dt) };
}

/** What is shown at a fraction of the run. */
export function momentOf(scene, fraction) {
  const t = timeAt(scene, fraction),
    { lanes } = scene;
  return { ...momentAt(scene, t), lanes: lanes?.map((lane) => momentAt(lane, Math.min(t, lane.end))) };
}

/** The verdict that the words give: that of the run, or the exact one if the run tells another story. */
export const toldVerdict = (scene) => (scene.stable && !disagrees(scene) ? scene.run : scene.truth).verdict;

/**
 * Where to look first, a fraction of the run: at the loss of contact or the least force, of the exact
 * motion if the run tells another story; flying, where a wheel is highest above the ground.
 */
export function momentToShow(scene, motion) {
  const { exactFlight, end } = scene;
  if (motion === "flying" && exactFlight.events.length) return Math.min(highest(exactFlight) / end, 1);
  const { lost, t } = toldVerdict(scene);
  return Math.min((lost ? lost.t : t) / end, 1);
}

/** Least and largest force of the exact motion. */
export const extremes = (scene, flying) => (flying ? judge(scene.exactFlight) : scene.truth.verdict);

/** When a wheel is highest above the ground. */
function highest({ gaps, J, dt }) {
  let at = 0,
    most = 0;
  for (const gap of gaps) for (let n = 0; n <= J; n++) if (gap[n] > most) [at, most] = [n, gap[n]];
  return at * dt;
}
