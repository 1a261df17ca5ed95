// A drive at all asked speeds over a road, exact, and what it says of a suspension: margins, first
// losses, the part of the way in the air, how far it is from the given one; and the map of them all.

import { bumpTable } from "./bump_table.js";
import { countSteps, fly, makeMemory, makeRoad, makeRobot, simulate } from "./model.js";

const FINE = { road: 24, swing: 0.1 }, // steps for each sigma, and the longest for the fastest mode
  COARSE = { road: 7, swing: 0.4 }, // for a picture
  CLOSE = 1e-9, // parts of the way in the air that are the same
  AROUND = 4; // samples on either side from which one tells what lies between two
const NODES = 2 * AROUND + 1;
const WEIGHTS = Array.from({ length: NODES }, (_, i) => {
  let product = 1; // barycentric, of whole numbers in a row
  for (let j = 0; j < NODES; j++) if (j !== i) product *= i - j;
  return 1 / product;
});

/** A function of the place among samples 0 .. J: the polynomial through those around n. */
function near(N, n, J) {
  const first = Math.min(Math.max(n - AROUND, 0), J + 1 - NODES);
  return (place) => {
    let [above, below] = [0, 0];
    for (let i = 0; i < NODES; i++) {
      const away = place - first - i;
      if (away === 0) return N[first + i];
      const part = WEIGHTS[i] / away;
      above += part * N[first + i];
      below += part;
    }
    return above / below;
  };
}

/** Where between its neighbours a sample that is no larger than these has the least value: [place, value]. */
function bottom(N, n, J) {
  if (n === 0 || n === J) return [n, N[n]];
  const p = near(N, n, J),
    h = 1e-3;
  let place = n;
  for (let i = 0; i < 6; i++) {
    const [a, b, c] = [p(place - h), p(place), p(place + h)],
      bend = (a - 2 * b + c) / h;
    if (!(bend > 0)) break;
    place = Math.min(Math.max(place - (c - a) / 2 / bend, n - 1), n + 1);
  }
  const value = p(place);
  return value < N[n] ? [place, value] : [n, N[n]];
}

const isLow = (N, n, J) => (n === 0 || N[n] <= N[n - 1]) && (n === J || N[n] <= N[n + 1]);

/** The least of samples 0 .. J and of the curve through them: [place, value]. */
export function leastOf(N, J) {
  let low = Infinity,
    high = -Infinity;
  for (let n = 0; n <= J; n++) {
    if (N[n] < low) low = N[n];
    if (N[n] > high) high = N[n];
  }
  let best = [0, Infinity];
  for (let n = 0; n <= J; n++) {
    if (N[n] > low + 0.1 * (high - low) || !isLow(N, n, J)) continue;
    const found = bottom(N, n, J);
    if (found[1] < best[1]) best = found;
  }
  return best;
}

/** The first place at which the curve through the samples is zero; null if there is none. */
export function firstZero(N, J) {
  for (let n = 0; n <= J; n++) {
    const [place, value] = N[n] > 0 ? (isLow(N, n, J) ? bottom(N, n, J) : [n, N[n]]) : [n, N[n]];
    if (value > 0) continue;
    if (n === 0) return 0;
    const p = near(N, n, J);
    let [a, b] = [n - 1, place];
    if (place < n - 1 || !(p(a) > 0)) return a;
    for (let i = 0; i < 60 && b - a > 1e-13 * n; i++) {
      const middle = (a + b) / 2;
      if (p(middle) > 0) a = middle;
      else b = middle;
    }
    return (a + b) / 2;
  }
  return null;
}

/** How far a suspension is from the given one, as Part X measures it. */
export const change = ({ own }, k, c) => Math.hypot(Math.log(k / own.k), Math.log(c / own.c));

/** What is asked for, and what drives over it. */
export function makeTrack(facts) {
  const { asked, distance, levels, wheels } = facts,
    shape = { ...facts.shape, table: bumpTable(facts.shape) },
    roads = levels.map(({ bump, centre }) => makeRoad({ ...shape, centre }, bump)),
    spaces = asked.map(() => ({ linear: makeMemory(), flying: makeMemory() })),
    scratch = makeMemory();

  /** The linear run at a speed: its steps are short enough for the road and for the modes. */
  function run(level, robot, v, { road, swing }, memory) {
    const fastest = Math.max(...robot.modes.map(([re, im]) => Math.hypot(re, im)), 1e-9),
      T = distance / v,
      J = countSteps(T, Math.min(levels[level].bump.sigma / v / road, swing / fastest, T / NODES));
    return simulate({ wheels }, robot, roads[level], facts.reference, v, T / J, J, memory);
  }

  /** The least force of both wheels, N; of which, where, and when. */
  function least({ N, J, dt, v }) {
    const [rear, front] = N.map((forces) => leastOf(forces, J)),
      wheel = front[1] < rear[1] ? 1 : 0,
      [place, margin] = wheel ? front : rear;
    return { margin, wheel, t: place * dt, X: v * place * dt };
  }

  /** The first loss of contact. */
  function loss({ N, J, dt, v }) {
    const found = N.map((forces, wheel) => ({ wheel, place: firstZero(forces, J) }))
      .filter(({ place }) => place !== null)
      .sort((a, b) => a.place - b.place)[0];
    return found ? { wheel: found.wheel, t: found.place * dt, X: v * found.place * dt } : null;
  }

  /** One lane: how contact fares at a speed, and the motion with wheels that leave the ground. */
  function lane(level, robot, v, { linear, flying }) {
    const { reserve } = levels[level],
      straight = run(level, robot, v, FINE, linear),
      found = least(straight),
      isLost = found.margin <= 0,
      method = { scheme: facts.reference, dt: straight.dt };
    const flight = isLost
      ? fly(facts, robot, roads[level], { v }, flying, method)
      : { ...straight, events: [], airtime: [0, 0] };
    return {
      ...found,
      v,
      end: distance / v,
      state: isLost ? "lost" : found.margin >= reserve ? "kept" : "short",
      lost: isLost ? loss(straight) : null,
      air: (Math.max(...flight.airtime) * v) / distance,
      flight,
      robot,
      road: roads[level],
      data: facts,
    };
  }

  return {
    /** What a suspension does on a road. The next drive overwrites the long arrays of its lanes. */
    drive(level, k, c) {
      const robot = makeRobot(facts, { k, c }),
        lanes = asked.map((v, i) => lane(level, robot, v, spaces[i]));
      const { kind, air: most } = levels[level],
        air = Math.max(...lanes.map((one) => one.air)),
        isKept = lanes.every(({ state }) => state === "kept");
      const isReached = kind === "air" ? air <= most + CLOSE : isKept;
      return { k, c, level, lanes, air, distance: change(facts, k, c), isReached };
    },
    /** Lanes of robots that wait at the start. */
    wait(level, k, c) {
      const robot = makeRobot(facts, { k, c }),
        still = (values) => Array.from(values, (value) => Float64Array.of(value, value)),
        [W, N] = [still(robot.equilibrium), still(robot.weight)];
      return asked.map((v) => {
        const end = distance / v,
          flight = { W, N, J: 1, dt: end, v, events: [], airtime: [0, 0] };
        return { v, end, flight, robot, road: roads[level], data: facts };
      });
    },
    /** The margins at the asked speeds, good enough for a picture, N. */
    sketch(level, k, c) {
      const robot = makeRobot(facts, { k, c });
      return asked.map((v) => least(run(level, robot, v, COARSE, scratch)).margin);
    },
  };
}
