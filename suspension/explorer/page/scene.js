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
    spaces = { run: makeMemory(), truth: makeMemory(), flight: makeMemory() };
  return (settings) => {
    const { v, dt, k, c, height, sigma, scheme_index } = settings,
      scheme = data.schemes[scheme_index];
    const end = data.distance / v,
      J = countSteps(end, dt);
    const robot = once("robot", [k, c], () => makeRobot(data, settings));
    const road = once("road", [height, sigma], () => makeRoad(data.shape, settings));
    const here = [k, c, height, sigma],
      there = [...here, v];
    const curve = once("curve", here, () => makeCurve(data, robot, road, settings));
    const highestBumps = data.chart && once("chart", here, () => makeHighest(data, robot, curve, settings));
    const truth = once("truth", [...there, dt], () => {
      const found = reference(data, robot, road, settings, spaces.truth);
      return { ...found, verdict: judgeExactly(found), beyond: beyond(data, robot, road, found) };
    });
    const flight = once("flight", [...there, truth.verdict.lost ? "" : truth.J], () => {
      if (!truth.verdict.lost) return grounded(truth);
      const found = fly(data, robot, road, settings, spaces.flight);
      return { ...found, beyond: beyond(data, robot, road, found) };
    });
    const run = once("run", [...there, dt, scheme_index], () => {
      const found = simulate(data, robot, road, scheme, v, dt, J, spaces.run);
      return found && { ...found, verdict: judge(found), error: difference(found, truth) };
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
      curve,
      highestBumps,
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

/** What is shown at a fraction of the run: of the linear run and of the flight. */
export function momentOf(scene, fraction) {
  const t = fraction * scene.end;
  const linear = scene.run ? lookUp(scene.run, t / scene.dt) : { t, W: [0, 0, 0, 0], N: [NaN, NaN] };
  return { t, X: scene.v * t, linear, flying: lookUp(scene.flight, t / scene.flight.dt) };
}

/**
 * Where to look first, a fraction of the run: at the loss of contact or the least force, of the exact
 * motion if the run tells another story; flying, where a wheel is highest above the ground.
 */
export function momentToShow(scene, motion) {
  const { run, truth, flight, end, stable } = scene;
  if (motion === "flying" && flight.events.length) return Math.min(highest(flight) / end, 1);
  const { lost, t } = (stable && !disagrees(scene) ? run : truth).verdict;
  return Math.min((lost ? lost.t : t) / end, 1);
}

/** When a wheel is highest above the ground. */
function highest({ gaps, J, dt }) {
  let at = 0,
    most = 0;
  for (const gap of gaps) for (let n = 0; n <= J; n++) if (gap[n] > most) [at, most] = [n, gap[n]];
  return at * dt;
}
