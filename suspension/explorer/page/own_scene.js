// All that follows from what is set: the verdict at once, what needs every speed little by little.

import {
  bumpPieces,
  falls,
  firstLoss,
  isTooLong,
  leastForces,
  makeVehicle,
  makeWay,
  marginOf,
  multipleOf,
  piecesOf,
  search,
  shapeOf,
  trackOf,
  zero,
} from "./own_run.js";
import { bumpOf, isSymmetric, PAIRS, pointsOf, usualWay } from "./own_state.js";

const SPEEDS = 72, // of the curve at first
  FINE = 240, // and later
  MOST_RIPPLES = 40, // of the margin in a factor e of speeds, as in Python
  ENDS = [0.1, 26]; // of the speeds, in widths passed in a swing's 1/omega0

/** A product of powers that Python handed over. */
export const productOf = ({ amplitude, powers }, values) =>
  Object.entries(powers).reduce((product, [name, power]) => product * values[name] ** power, amplitude);

/** The numbers of the symmetric robot with the means of both axles, by the names of the groups' formulas. */
function twinOf(robot) {
  const [L, k, c] = PAIRS.map(([rear, front]) => (robot[rear] + robot[front]) / 2);
  return { m: robot.m, Izz: robot.Izz, L, k, c };
}

/** The five groups, by name; nu is that of a speed. */
export const groupsOf = (facts, values) =>
  Object.fromEntries(
    Object.entries(facts.groups).map(([name, product]) => [name, productOf(product, values)]),
  );

/** The height of a limit by hand, in sags, at a speed nu. */
export const limitOf = (limit, { nu, zeta, j }) => productOf(limit, { nu, zeta, "1 + j": 1 + j });

const round = (x) => Number(x.toPrecision(2));

/** The verdict of a state, and what it needs; `isTooLong` says that there is none, the way takes too long. */
export function makeScene(facts, state) {
  const { v } = state,
    vehicle = makeVehicle(facts.parts, state.robot),
    isBump = state.ground.kind === "bump";
  let pieces, end, shape;
  if (isBump) {
    const bump = bumpOf(state, facts);
    [pieces, end] = [bumpPieces(facts.bump, bump), bump.centre + facts.clear * bump.sigma];
    shape = { ...bump, from: bump.centre - facts.clear * bump.sigma, to: end };
  } else {
    const points = pointsOf(state, facts);
    [pieces, end] = [piecesOf(points), points.x.at(-1)];
    shape = { ...shapeOf(points), from: points.x[0], to: end, points };
  }
  const isLevel = shape.height === 0,
    // A level road has no width of its own.
    sigma = isLevel ? (shape.to - shape.from) / 10 : shape.sigma,
    usual = usualWay(end, state.robot.L1, sigma, facts),
    distance = state.distance ?? usual,
    values = { ...twinOf(state.robot), v, height: shape.height, sigma };
  // What an unsymmetric robot has of its twin is no more than the scale of the chart.
  const sag = productOf(facts.sag, values),
    twin = { ...groupsOf(facts, values), eta: shape.height / sag },
    unit = { v: v / twin.nu, sag };
  const slowest = (vehicle.fastest * distance) / facts.longest,
    first = round(Math.max(ENDS[0] * unit.v, slowest)),
    speeds = [first, Math.max(round(ENDS[1] * unit.v), 2 * first)],
    needed = end + state.robot.L1;
  const scene = {
    ...{ state, vehicle, pieces, shape, isBump, isLevel, usual, distance, needed, twin, unit, speeds },
    groups: isSymmetric(state) ? twin : null,
    legs: makeWay(vehicle, pieces, distance),
    isTooLong: isTooLong(vehicle, distance, v),
    curve: null, // { v, multiple } of the speeds that are known, from the fastest on
    standIn: null, // the same of the bump that is as high and as steep as a drawn road
    critical: null, // [speeds] of a first look, then of a thorough one
    isSure: false, // whether it was thorough
  };
  if (scene.isTooLong) return scene;
  scene.least = leastForces(vehicle, scene.legs, v);
  scene.lost = firstLoss(vehicle, scene.legs, v);
  scene.until = scene.lost && leastForces(vehicle, scene.legs, v, scene.lost.X);
  scene.multiple = multipleOf(vehicle, falls(vehicle, scene.legs, v));
  scene.track = trackOf(vehicle, scene.legs, v);
  return scene;
}

/** How many speeds a thorough search begins with: enough for every ripple, as in Python. */
function countOf({ state: { robot }, shape, isBump, isLevel, speeds: [low, high] }) {
  const apart = robot.L1 + robot.L2 + (isBump ? 0 : shape.to - shape.from),
    ripples = Math.min(1 + (isLevel ? 0 : apart / shape.sigma), MOST_RIPPLES);
  return 2 + Math.floor((20 + 10 * ripples) * Math.log(high / low));
}

/** A generator that fills in what needs every speed; it rests after each of them. */
export function* everySpeed(scene, facts) {
  const { vehicle, legs, speeds, shape, isBump, isLevel, distance } = scene,
    [low, high] = speeds,
    spread = (count) =>
      Array.from({ length: count }, (_, i) =>
        i === count - 1 ? high : low * (high / low) ** (i / (count - 1)),
      ),
    v = spread(SPEEDS),
    marginAt = (v) => marginOf(vehicle, falls(vehicle, legs, v));
  /** From fast to slow, for the slow ones take longest: what is known of a curve is drawn. */
  const curveOver = function* (legs, curve, v) {
    const margins = [];
    for (const speed of [...v].reverse()) {
      const fallen = falls(vehicle, legs, speed);
      curve.v.unshift(speed);
      curve.multiple.unshift(multipleOf(vehicle, fallen));
      margins.unshift(marginOf(vehicle, fallen));
      yield;
    }
    return margins;
  };
  scene.curve = { v: [], multiple: [] };
  const margins = yield* curveOver(legs, scene.curve, v);
  const critical = [];
  for (let i = 0; i + 1 < SPEEDS; i++)
    if (margins[i] > 0 !== margins[i + 1] > 0) {
      critical.push(zero(marginAt, v[i], v[i + 1], margins[i], margins[i + 1]));
      yield;
    }
  scene.kept = margins[0] > 0;
  scene.critical = critical;
  yield "curve";
  if (!isBump && !isLevel && shape.height > 0) {
    const standIn = { v: [], multiple: [] };
    yield* curveOver(makeWay(vehicle, bumpPieces(facts.bump, standInOf(scene, facts)), distance), standIn, v);
    scene.standIn = standIn;
    yield "stand-in";
  }
  const fine = { v: [], multiple: [] };
  yield* curveOver(legs, fine, spread(FINE));
  scene.curve = fine;
  yield "fine";
  if (!isLevel) scene.critical = yield* search(marginAt, low, high, countOf(scene));
  scene.isSure = true;
}

/** The bump that is as high and as steep as the road, where the road begins. */
export const standInOf = ({ shape, state: { robot } }, { lead }) => ({
  height: shape.height,
  sigma: shape.sigma,
  centre: robot.L2 + lead * shape.sigma,
});
