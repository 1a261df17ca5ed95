// Runs over the bump by a typed tableau, the exact one beside them, and the error against the work.

import { bumpTable } from "./bump_table.js";
import { countSteps, makeMemory, makeRoad, simulate } from "./model.js";

const COARSEST = 3, // powers of two: steps of the curve of error against work
  FINEST = 10;

/** The largest difference of both forces from the exact ones, where the run has samples, N. */
function differ(run, exact, each) {
  if (!run) return Infinity;
  let most = 0;
  for (const i of [0, 1]) {
    const [N, truth] = [run.N[i], exact.N[i]];
    for (let n = 0; n <= run.J; n++) {
      const error = Math.abs(N[n] - truth[n * each]);
      if (!(error < 1e300)) return Infinity;
      if (error > most) most = error;
    }
  }
  return most;
}

/** What of a robot and a bump every tableau is tried on. */
export function makeBench(facts) {
  const { robot, wheels, distance, bump } = facts,
    road = makeRoad({ ...facts.road, table: bumpTable(facts.road) }, bump),
    fastest = Math.max(...robot.modes.map(([re, im]) => Math.hypot(re, im)), 1e-9);
  const memories = new Map(), // of runs that are looked at at the same time
    known = new Map();
  const go = (scheme, v, dt, J, where) => {
    if (!memories.has(where)) memories.set(where, makeMemory());
    return simulate({ wheels }, robot, road, scheme, v, dt, J, memories.get(where));
  };

  /** The exact run with a sample at each of J steps dt: Gauss's, in `each` short steps to one of these. */
  function exactAt(v, dt, J, where) {
    const kept = known.get(where);
    if (kept?.v !== v || kept.dt !== dt) {
      const longest = Math.min(bump.sigma / v / 16, 0.1 / fastest),
        each = Math.max(1, Math.ceil(dt / longest - 1e-9));
      const run = go(facts.reference, v, dt / each, J * each, where);
      known.set(where, { v, dt, each, run });
    }
    return known.get(where);
  }

  return {
    /** A run with steps dt, the exact one, and the largest error of a force; `run` is null if no step can be solved. */
    try(scheme, v, dt, name = "run") {
      const J = countSteps(distance / v, dt),
        exact = exactAt(v, dt, J, `exact beside ${name}`),
        run = go(scheme, v, dt, J, name);
      return { run, J, work: J * scheme.b.length, exact, error: differ(run, exact.run, exact.each) };
    },
    /** Pairs of work, stages times steps, and the largest error of a force, from coarse to fine. */
    workCurve(scheme, v) {
      const T = distance / v,
        most = 2 ** FINEST,
        exact = exactAt(v, T / most, most, "exact for all"),
        pairs = [];
      for (let power = COARSEST; power <= FINEST; power++) {
        const J = 2 ** power,
          run = go(scheme, v, T / J, J, "one of many");
        pairs.push([J * scheme.b.length, differ(run, exact.run, exact.each * (most / J))]);
      }
      return pairs;
    },
  };
}
