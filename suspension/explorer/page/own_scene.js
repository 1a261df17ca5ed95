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

/** What does not depend on the speed: the robot, its road and its way, and what `everySpeed` fills in. */
function makeCourse(facts, key, state) {
  const { robot, ground } = state,
    vehicle = makeVehicle(facts.parts, robot),
    isBump = ground.kind === "bump";
  let pieces, shape;
  if (isBump) {
    const bump = bumpOf(state, facts),
      reach = facts.clear * bump.sigma;
    pieces = bumpPieces(facts.bump, bump);
    shape = { ...bump, from: bump.centre - reach, to: bump.centre + reach };
  } else {
    const points = pointsOf(state, facts);
    pieces = piecesOf(points);
    shape = { ...shapeOf(points), from: points.x[0], to: points.x.at(-1), points };
  }
  const { from, to, height } = shape,
    isLevel = height === 0,
    sigma = isLevel ? (to - from) / 10 : shape.sigma, // a level road has no width of its own
    usual = usualWay(to, robot.L1, sigma, facts),
    distance = state.distance ?? usual,
    // What an unsymmetric robot has of its twin is no more than the scale of the chart.
    values = { ...twinOf(robot), v: 1, height, sigma },
    unit = { v: 1 / groupsOf(facts, values).nu, sag: productOf(facts.sag, values) };
  const slowest = (vehicle.fastest * distance) / facts.longest,
    first = round(Math.max(ENDS[0] * unit.v, slowest));
  return {
    ...{ key, vehicle, pieces, shape, isBump, isLevel, usual, distance, unit, values },
    needed: to + robot.L1,
    speeds: [first, Math.max(round(ENDS[1] * unit.v), 2 * first)],
    legs: makeWay(vehicle, pieces, distance),
    curve: null, // { v, multiple } of the speeds that are known, from the fastest on
    standIn: null, // the same of the bump that is as high and as steep as a drawn road
    critical: null, // speeds of a first look, then of a thorough one
    isSure: false, // whether it was thorough
  };
}

/**
 * The verdict of a state, on a course that stands behind it; where only the speed has changed, it is that
 * of the scene before. `isTooLong` says that there is no verdict, for the way takes too long.
 */
export function makeScene(facts, state, before = null) {
  const key = JSON.stringify([state.robot, state.ground, state.distance]),
    course = before?.course.key === key ? before.course : makeCourse(facts, key, state),
    { vehicle, legs, distance, values, unit } = course,
    { v } = state,
    twin = { ...groupsOf(facts, { ...values, v }), eta: values.height / unit.sag };
  const scene = Object.assign(Object.create(course), {
    ...{ state, course, twin },
    groups: isSymmetric(state) ? twin : null,
    isTooLong: isTooLong(vehicle, distance, v),
  });
  if (scene.isTooLong) return scene;
  scene.least = leastForces(vehicle, legs, v);
  const isLost = scene.least.some(({ force }) => force <= 0);
  scene.lost = isLost ? firstLoss(vehicle, legs, v) : null;
  scene.until = scene.lost && leastForces(vehicle, legs, v, scene.lost.X);
  scene.multiple = multipleOf(
    vehicle,
    scene.least.map(({ force }, i) => vehicle.load[i] - force),
  );
  scene.track = trackOf(vehicle, legs, v);
  return scene;
}

/** How many speeds a thorough search begins with: enough for every ripple, as in Python. */
function countOf({ vehicle: { values }, shape, isBump, isLevel, speeds: [low, high] }) {
  const apart = values.L1 + values.L2 + (isBump ? 0 : shape.to - shape.from),
    ripples = Math.min(1 + (isLevel ? 0 : apart / shape.sigma), MOST_RIPPLES);
  return 2 + Math.floor((20 + 10 * ripples) * Math.log(high / low));
}

/** A generator that fills in what a course has at every speed; it rests after each of them. */
export function* everySpeed(course, facts) {
  const { vehicle, legs, speeds, shape, isBump, isLevel, distance } = course,
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
  course.curve = { v: [], multiple: [] };
  const margins = yield* curveOver(legs, course.curve, v);
  const critical = [];
  for (let i = 0; i + 1 < SPEEDS; i++)
    if (margins[i] > 0 !== margins[i + 1] > 0) {
      critical.push(zero(marginAt, v[i], v[i + 1], margins[i], margins[i + 1]));
      yield;
    }
  course.kept = margins[0] > 0;
  course.critical = critical;
  yield "curve";
  if (!isBump && !isLevel && shape.height > 0) {
    const standIn = { v: [], multiple: [] };
    yield* curveOver(
      makeWay(vehicle, bumpPieces(facts.bump, standInOf(course, facts)), distance),
      standIn,
      v,
    );
    course.standIn = standIn;
    yield "stand-in";
  }
  const fine = { v: [], multiple: [] };
  yield* curveOver(legs, fine, spread(FINE));
  course.curve = fine;
  yield "fine";
  if (!isLevel) course.critical = yield* search(marginAt, low, high, countOf(course));
  course.isSure = true;
}

/** The bump that is as high and as steep as the road, where the road begins. */
export const standInOf = ({ shape, vehicle: { values } }, { lead }) => ({
  height: shape.height,
  sigma: shape.sigma,
  centre: values.L2 + lead * shape.sigma,
});
