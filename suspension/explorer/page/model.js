// From what Python handed over to what is shown: the matrices at the sliders' settings, runs, the
// curve over all speeds. Everything is linear algebra with given numbers; nothing here is physics.

import {
  apply,
  characteristic,
  combine,
  divide,
  eliminate,
  evaluate,
  multiply,
  roots,
  solve,
  zeros,
} from "./linear.js";

const TOLERANCE = 1e-12; // of |R| <= 1 and of whole numbers of steps, as in Python
const SPEEDS = 128;
const MOST = 5; // changes within one step
const REFINED = 30, // looks into a step for the moment of a change
  CLOSE = 1e-5; // of the step, from the last secant to the next: that one is right to the last digits

/** A table that Python packed as little-endian doubles. */
const unpack = (view) =>
  new Float64Array(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength));

export function readModel(facts, tables) {
  return { ...facts, shape: { ...facts.road, table: unpack(tables.road) } };
}

/**
 * The road with a bump of a given height and width: road(x, out, i, v) writes the height to out[i]
 * and v dH/dx to out[i + 2].
 */
export function makeRoad({ centre, start, cell, table }, { height, sigma }) {
  const size = 10,
    last = table.length / size - 1;
  const flat = new Uint8Array(last + 1);
  for (let n = 0; n <= last; n++) {
    flat[n] = table.subarray(size * n, size * (n + 1)).every((c) => c === 0) ? 1 : 0;
  }
  return (x, out, i, v) => {
    const at = ((x - centre) / sigma - start) / cell;
    const n = at < 0 ? 0 : at > last ? last : Math.floor(at);
    if (flat[n]) {
      out[i] = out[i + 2] = 0;
      return;
    }
    const s = Math.min(Math.max(2 * (at - n) - 1, -1), 1);
    let H = 0,
      slope = 0; // Horner's rule for both
    for (let j = size * (n + 1) - 1; j >= size * n; j--) {
      slope = slope * s + H;
      H = H * s + table[j];
    }
    out[i] = height * H;
    out[i + 2] = (height * v * slope * 2) / (cell * sigma);
  };
}

/** The matrices of the robot at a stiffness and a damping, and its modes. */
export function makeRobot({ model }, { k, c }) {
  const at = (parts) => combine([1, parts["1"]], [k, parts.k], [c, parts.c]);
  const C = at(model.C),
    D = at(model.D),
    { S, P, e, Cp, Dp, contact } = model;
  const A = combine([1, S], [1, multiply(P, C)]);
  const equilibrium = solve(
    A,
    e.map((value) => -value),
  ).map((value) => value + 0);
  const modes = roots(characteristic(A));
  return { A, C, D, S, P, e, Cp, Dp, contact, equilibrium, weight: apply(C, equilibrium), modes };
}

/**
 * The matrices of one step of w' = A w + F(t), from a tableau: w_{n+1} = R w_n + sum_i G_i F(t_n +
 * c_i dt). R and, for the different abscissae, [c, the sum of their G_i]. Null if the step cannot be
 * solved for.
 */
function oneStep({ a, b, c }, A, dt) {
  const s = b.length,
    n = A.length,
    m = s * n;
  // All stages at once, transposed: (I - dt a kron A)^T G^T = dt (b^T kron I)^T, the right-hand
  // side in the columns behind the matrix.
  const M = new Float64Array(m * (m + n)),
    width = m + n;
  for (let i = 0; i < s; i++) {
    for (let p = 0; p < n; p++) {
      const row = (i * n + p) * width;
      for (let j = 0; j < s; j++) {
        for (let q = 0; q < n; q++) M[row + j * n + q] = -dt * a[j][i] * A[q][p];
      }
      M[row + i * n + p] += 1;
      M[row + m + p] = dt * b[i];
    }
  }
  if (!eliminate(M, m, width)) return null;
  const found = new Map(),
    total = zeros(n, n);
  for (let i = 0; i < s; i++) {
    if (!found.has(c[i])) found.set(c[i], zeros(n, n));
    const gain = found.get(c[i]);
    for (let p = 0; p < n; p++) {
      for (let q = 0; q < n; q++) {
        const value = M[(i * n + q) * width + m + p];
        gain[p][q] += value;
        total[p][q] += value;
      }
    }
  }
  const R = multiply(total, A);
  for (let p = 0; p < n; p++) R[p][p] += 1;
  return { R, gains: [...found].sort(([x], [y]) => x - y) };
}

/** |R(z)| of a scheme at a complex z. */
export function growth({ P, Q }, z) {
  const size = Math.hypot(...divide(evaluate(P, z), evaluate(Q, z)));
  return Number.isFinite(size) ? size : Infinity;
}

/** Number of steps to cover a time: rounded up, but forgiving roundoff, as in Python. */
export function countSteps(tfinal, dt) {
  const J = tfinal / dt,
    whole = Math.round(J);
  return Math.max(Math.abs(J - whole) <= TOLERANCE * J ? whole : Math.ceil(J), 1);
}

/** Space that is used again: arrays of the same name overwrite one another. */
export function makeMemory() {
  const kept = new Map();
  return (name, size) => {
    let array = kept.get(name);
    if (!array || array.length < size) kept.set(name, (array = new Float64Array(Math.ceil(1.5 * size))));
    return array.subarray(0, size);
  };
}

function flatten(M) {
  const flat = new Float64Array(M.length * M[0].length);
  M.forEach((row, i) => flat.set(row, i * row.length));
  return flat;
}

/** D u for a row i of a flattened 2 by 4 matrix, u from place j. */
const force = (D, i, u, j) =>
  D[4 * i] * u[j] + D[4 * i + 1] * u[j + 1] + D[4 * i + 2] * u[j + 2] + D[4 * i + 3] * u[j + 3];

/** The road's part of both forces at times (n + shift) dt, n = 0 .. J. */
function roadForce(data, road, D, v, dt, shift, J, f) {
  const [rear, front] = data.wheels,
    u = new Float64Array(4);
  for (let n = 0; n <= J; n++) {
    const X = v * (n * dt + shift * dt);
    road(X + rear, u, 0, v);
    road(X + front, u, 1, v);
    f[2 * n] = force(D, 0, u, 0);
    f[2 * n + 1] = force(D, 1, u, 0);
  }
  return f;
}

/**
 * Run J steps from equilibrium: states W (4 arrays) and normal forces N (2 arrays) at t = 0, dt,
 * .., J dt. For the deviation d from equilibrium the weight cancels: d' = A d + P D u. Null if the
 * scheme cannot take such a step.
 */
export function simulate(data, robot, road, scheme, v, dt, J, memory) {
  const step = oneStep(scheme, robot.A, dt);
  if (!step) return null;
  const size = J + 1,
    D = flatten(robot.D),
    C = flatten(robot.C),
    R = flatten(step.R);
  const ends = roadForce(data, road, D, v, dt, 0, J, memory("ends", 2 * size));
  const stages = step.gains.map(([c, G]) => ({
    M: flatten(multiply(G, robot.P)), // 4 by 2
    f: c === 0 || c === 1 ? ends : roadForce(data, road, D, v, dt, c, J, memory(`at ${c}`, 2 * size)),
    ahead: c === 1 ? 2 : 0,
  }));
  const W = [0, 1, 2, 3].map((i) => memory(`W${i}`, size)),
    N = [0, 1].map((i) => memory(`N${i}`, size));
  const [W0, W1, W2, W3] = W,
    [N0, N1] = N,
    [r0, r1] = robot.weight,
    [q0, q1, q2, q3] = robot.equilibrium;
  let d0 = 0,
    d1 = 0,
    d2 = 0,
    d3 = 0;
  for (let n = 0; ; n++) {
    W0[n] = q0 + d0;
    W1[n] = q1 + d1;
    W2[n] = q2 + d2;
    W3[n] = q3 + d3;
    N0[n] = r0 + C[0] * d0 + C[1] * d1 + C[2] * d2 + C[3] * d3 + ends[2 * n];
    N1[n] = r1 + C[4] * d0 + C[5] * d1 + C[6] * d2 + C[7] * d3 + ends[2 * n + 1];
    if (!(n < J)) break; // also if there is no number of steps
    let x0 = R[0] * d0 + R[1] * d1 + R[2] * d2 + R[3] * d3;
    let x1 = R[4] * d0 + R[5] * d1 + R[6] * d2 + R[7] * d3;
    let x2 = R[8] * d0 + R[9] * d1 + R[10] * d2 + R[11] * d3;
    let x3 = R[12] * d0 + R[13] * d1 + R[14] * d2 + R[15] * d3;
    for (let q = 0; q < stages.length; q++) {
      const { M, f, ahead } = stages[q],
        f0 = f[2 * n + ahead],
        f1 = f[2 * n + ahead + 1];
      if (f0 === 0 && f1 === 0) continue;
      x0 += M[0] * f0 + M[1] * f1;
      x1 += M[2] * f0 + M[3] * f1;
      x2 += M[4] * f0 + M[5] * f1;
      x3 += M[6] * f0 + M[7] * f1;
    }
    d0 = x0;
    d1 = x1;
    d2 = x2;
    d3 = x3;
  }
  return { W, N, J, dt, v };
}

/** How long a step may be that misses nothing of the motion or of the road, s. */
function shortestScale(data, robot, settings) {
  const fastest = Math.max(...robot.modes.map(([re, im]) => Math.hypot(re, im)), 1e-9);
  return { road: (data.feature * settings.sigma) / settings.v, modes: 1 / fastest };
}

/**
 * What a run is judged by: the reference method with its own short steps, H. They are a whole
 * number of the run's, or the other way round, so that every `every`-th sample of the one meets
 * every `each`-th of the other.
 */
export function reference(data, robot, road, settings, memory) {
  const { v, dt } = settings,
    scale = shortestScale(data, robot, settings);
  const wanted = Math.min(scale.road / 16, 0.1 * scale.modes);
  const each = Math.max(1, Math.ceil(dt / wanted - 1e-9)),
    every = Math.max(1, Math.floor(wanted / dt));
  const H = each > 1 ? dt / each : dt * every,
    J = countSteps(data.distance / v, H);
  return { ...simulate(data, robot, road, data.reference, v, H, J, memory), each, every };
}

/** Largest difference of a run's forces from the reference's, where their samples meet. */
export function difference(run, truth) {
  let most = 0;
  for (const i of [0, 1]) {
    const a = run.N[i],
      b = truth.N[i];
    for (let n = 0, m = 0; n <= run.J && m <= truth.J; n += truth.every, m += truth.each) {
      most = Math.max(most, Math.abs(a[n] - b[m]));
    }
  }
  return most; // NaN once the run is past the largest number
}

/** First loss, least and largest force of a run as it is sampled, up to a time. */
export function judge({ N, dt, J }, end = Infinity) {
  let least = Infinity,
    most = -Infinity,
    worst = 0,
    wheel = 0,
    lost = null;
  const last = Math.min(J, Math.floor(end / dt + 1e-9));
  for (let n = 0; n <= last; n++) {
    const low = N[1][n] < N[0][n] ? 1 : 0;
    if (N[low][n] < least) [least, worst, wheel] = [N[low][n], n, low];
    if (N[1 - low][n] > most) most = N[1 - low][n];
    if (lost === null && N[low][n] <= 0) lost = { wheel: low, t: n * dt };
  }
  return { least, most, wheel, t: worst * dt, lost };
}

/** The bottom of the parabola through three samples: how far from the middle one, and its value. */
function bottom(a, b, c) {
  const curvature = a - 2 * b + c;
  if (!(curvature > 0)) return [0, b];
  const shift = Math.min(Math.max((a - c) / (2 * curvature), -1), 1);
  return [shift, b - (curvature * shift * shift) / 2];
}

/** As `judge`, between the samples too: for the reference, whose samples lie close. */
export function judgeExactly(run) {
  const { N, dt, J } = run,
    found = judge(run);
  for (const i of [0, 1]) {
    for (let n = 1; n < J; n++) {
      const x = N[i][n];
      if (x > N[i][n - 1] || x > N[i][n + 1] || x > found.least + 1) continue;
      const [shift, value] = bottom(N[i][n - 1], x, N[i][n + 1]);
      if (value < found.least) Object.assign(found, { least: value, wheel: i, t: (n + shift) * dt });
      const t = (n + shift) * dt;
      if (value <= 0 && x > 0 && !(found.lost?.t <= t)) found.lost = { wheel: i, t };
    }
  }
  if (found.lost) {
    // where the straight line between two samples is zero
    const { wheel, t } = found.lost,
      n = Math.round(t / dt);
    const [before, after] = [N[wheel][n - 1], N[wheel][n]];
    if (after <= 0 && before > 0) found.lost = { wheel, t: (n - 1 + before / (before - after)) * dt };
  }
  return found;
}

/**
 * A function of the speed: the least force of each wheel on the way, [rear, front]. Its steps are of
 * equal length, so that all speeds feel the same road, at v times the slope.
 */
export function makeLeast(data, robot, road) {
  const CELLS = data.cells, // steps of equal length
    h = data.distance / CELLS,
    { curveScheme: scheme } = data,
    [c0, c1] = scheme.c;
  // D u = (its part by heights) + v (its part by slopes), at the cells' beginnings and two stages.
  const D = flatten(robot.D),
    [byHeight, bySlope] = [0, 1].map((part) => D.map((x, i) => (i % 4 < 2 === (part === 0) ? x : 0)));
  const sample = (D, c) =>
    roadForce(data, (x, u, i) => road(x, u, i, 1), D, 1, h, c, CELLS, new Float64Array(2 * CELLS + 2));
  const [H, H0, H1] = [0, c0, c1].map((c) => sample(byHeight, c));
  const [S, S0, S1] = [0, c0, c1].map((c) => sample(bySlope, c));
  let begin = CELLS,
    end = 0; // outside, the road is level
  for (const part of [H, H0, H1, S, S0, S1]) {
    for (let i = 0; i < part.length; i++) {
      if (part[i] !== 0) [begin, end] = [Math.min(begin, i >> 1), Math.max(end, i >> 1)];
    }
  }
  const C = flatten(robot.C),
    [r0, r1] = robot.weight,
    N0 = new Float64Array(CELLS + 1),
    N1 = N0.slice();

  return (v) => {
    const { R: rows, gains } = oneStep(scheme, robot.A, h / v);
    const [R00, R01, R02, R03, R10, R11, R12, R13, R20, R21, R22, R23, R30, R31, R32, R33] = flatten(rows);
    const [A00, A01, A10, A11, A20, A21, A30, A31] = flatten(multiply(gains[0][1], robot.P));
    const [B00, B01, B10, B11, B20, B21, B30, B31] = flatten(multiply(gains[1][1], robot.P));
    const [C0, C1, C2, C3, C4, C5, C6, C7] = C;
    let d0 = 0,
      d1 = 0,
      d2 = 0,
      d3 = 0;
    for (let n = begin; n <= CELLS; n++) {
      const m = 2 * n;
      let rear = r0 + C0 * d0 + C1 * d1 + C2 * d2 + C3 * d3;
      let front = r1 + C4 * d0 + C5 * d1 + C6 * d2 + C7 * d3;
      let x0 = R00 * d0 + R01 * d1 + R02 * d2 + R03 * d3;
      let x1 = R10 * d0 + R11 * d1 + R12 * d2 + R13 * d3;
      let x2 = R20 * d0 + R21 * d1 + R22 * d2 + R23 * d3;
      let x3 = R30 * d0 + R31 * d1 + R32 * d2 + R33 * d3;
      if (n <= end) {
        rear += H[m] + v * S[m];
        front += H[m + 1] + v * S[m + 1];
        const f0 = H0[m] + v * S0[m],
          f1 = H0[m + 1] + v * S0[m + 1];
        const g0 = H1[m] + v * S1[m],
          g1 = H1[m + 1] + v * S1[m + 1];
        x0 += A00 * f0 + A01 * f1 + B00 * g0 + B01 * g1;
        x1 += A10 * f0 + A11 * f1 + B10 * g0 + B11 * g1;
        x2 += A20 * f0 + A21 * f1 + B20 * g0 + B21 * g1;
        x3 += A30 * f0 + A31 * f1 + B30 * g0 + B31 * g1;
      }
      N0[n] = rear;
      N1[n] = front;
      d0 = x0;
      d1 = x1;
      d2 = x2;
      d3 = x3;
    }
    return [lowest(N0, begin, CELLS), lowest(N1, begin, CELLS)];
  };
}

/** The least force of each wheel at many speeds, and the speeds where it is zero. */
export function makeCurve(data, robot, road, settings) {
  const leastAt = makeLeast(data, robot, road);
  const [low, high] = data.ranges.v,
    ratio = Math.log(high / low) / (SPEEDS - 1);
  const speeds = Float64Array.from({ length: SPEEDS }, (_, i) => low * Math.exp(ratio * i));
  const least = [new Float64Array(SPEEDS), new Float64Array(SPEEDS)];
  speeds.forEach((v, i) => ([least[0][i], least[1][i]] = leastAt(v)));
  const margin = (v) => Math.min(...leastAt(v));
  let critical = [];
  for (let i = 1; i < SPEEDS; i++) {
    const [before, after] = [i - 1, i].map((j) => Math.min(least[0][j], least[1][j]));
    if (before > 0 !== after > 0) critical.push(zero(margin, speeds[i - 1], speeds[i], before, after));
  }
  const { at, critical: exact } = data.exact ?? {};
  if (at && exact.length === critical.length && Object.keys(at).every((name) => at[name] === settings[name]))
    critical = exact;
  return { speeds, least, critical, kept: margin(low) > 0, leastAt, settings };
}

/**
 * The highest bump that is crossed with contact at each of the curve's speeds, m: forces are linear
 * in the height, so each wheel's is the height times its load over what the bump takes from it.
 */
export function makeHighest(data, robot, curve, settings) {
  const height = settings.height || data.own.height; // a level road takes nothing from a wheel
  const { least } = settings.height
    ? curve
    : makeCurve(data, robot, makeRoad(data.shape, { ...settings, height }), { ...settings, height });
  const over = (load, force) => (force < load ? (height * load) / (load - force) : Infinity);
  return curve.speeds.map((_v, n) => Math.min(...[0, 1].map((i) => over(robot.weight[i], least[i][n]))));
}

/** The least of samples first .. last, and of the curve through five of them around it. */
function lowest(N, first, last) {
  let at = first;
  for (let n = first + 1; n <= last; n++) if (N[n] < N[at]) at = n;
  if (at < first + 2 || at > last - 2) return N[at];
  // Newton's step to the bottom, with differences of fourth order.
  const [a, b, x, c, d] = [N[at - 2], N[at - 1], N[at], N[at + 1], N[at + 2]];
  const slope = (a - 8 * b + 8 * c - d) / 12,
    curvature = (-a + 16 * b - 30 * x + 16 * c - d) / 12;
  return curvature > 0 ? x - Math.min((slope * slope) / (2 * curvature), Math.abs(slope)) : x;
}

/** A zero of f between a and b, where it has the values fa and fb of different signs. */
function zero(f, a, b, fa, fb) {
  for (let i = 0; i < 8 && b - a > 1e-6 * b; i++) {
    const straight = a + ((b - a) * fa) / (fa - fb),
      x = i % 3 === 2 ? (a + b) / 2 : straight;
    const fx = f(x);
    if (fx > 0 === fa > 0) [a, fa] = [x, fx];
    else [b, fb] = [x, fx];
  }
  return a + ((b - a) * fa) / (fa - fb);
}

/**
 * The robot with forces that switch off and on: for each set of wheels that press, the same linear
 * model with the others' forces left out, w' = (S + P s C) w + P s D u + e. The set follows from
 * the conditions that Python handed over: each is a quantity of either wheel that must be positive,
 * or zero. Where the set changes, the step is parted. Null if the scheme cannot take such a step.
 */
export function fly(data, robot, road, settings, memory, method = finest(data, robot, settings)) {
  const { v } = settings,
    { scheme, dt } = method,
    end = data.distance / v,
    J = countSteps(end, dt);
  const motion = makeMotion(data, robot, road, v, scheme),
    { w, feel, press, advance, count, force, length } = motion;
  const full = [0, 1, 2, 3].map((set) => motion.prepare(set, dt));
  if (full.includes(null)) return null;
  const W = [0, 1, 2, 3].map((i) => memory(`flying W${i}`, J + 1));
  const N = [0, 1].map((i) => memory(`flying N${i}`, J + 1));
  const gaps = [0, 1].map((i) => memory(`flying gap${i}`, J + 1)),
    events = [];
  const [W0, W1, W2, W3] = W,
    [N0, N1] = N,
    [gap0, gap1] = gaps;
  let before = new Float64Array(count),
    after = new Float64Array(count);
  const saved = new Float64Array(4);
  feel(0, before);
  let set = press(before);
  for (let n = 0; ; n++) {
    W0[n] = w[0];
    W1[n] = w[1];
    W2[n] = w[2];
    W3[n] = w[3];
    N0[n] = set & 1 ? before[force] : 0;
    N1[n] = set & 2 ? before[force + 1] : 0;
    gap0[n] = set & 1 || before[length] > 0 ? 0 : -before[length];
    gap1[n] = set & 2 || before[length + 1] > 0 ? 0 : -before[length + 1];
    if (!(n < J)) break; // also if there is no number of steps
    saved.set(w);
    advance(full[set], n * dt);
    feel((n + 1) * dt, after);
    if (press(after) === set || !Number.isFinite(after[0] + after[1])) {
      [before, after] = [after, before];
    } else {
      w.set(saved);
      set = part(motion, n * dt, dt, set, before, after, events);
      feel((n + 1) * dt, before);
    }
  }
  return { W, N, gaps, J, dt, v, events, airtime: airtime(events, end) };
}

/** What flights are judged by: the reference method, with steps that miss nothing. */
function finest(data, robot, settings) {
  const scale = shortestScale(data, robot, settings);
  return { scheme: data.reference, dt: Math.min(data.longestStep, scale.road / 16, 0.1 * scale.modes) };
}

/**
 * One step in which the set changes: up to each change with the old set, then on with the new one.
 * The changes are appended to the events; the set at the end comes back.
 */
function part(motion, start, dt, set, before, after, events) {
  const { w, feel, press, advance, prepare, v } = motion;
  const saved = w.slice();
  let t = start,
    left = dt,
    [first, last] = [before.slice(), after.slice()];
  for (let tries = 0; tries < MOST && left > 0; tries++) {
    const next = press(last);
    if (next === set) return set;
    const feelAt = (share, found) => {
      w.set(saved); // back to the last change
      advance(prepare(set, share * left), t);
      feel(t + share * left, found);
    };
    const parts = [0, 1].map((i) => ((set ^ next) & (1 << i) ? turn(first, last, i, feelAt) : Infinity));
    const share = Math.min(Math.max(Math.min(...parts), 1e-6), 1);
    feelAt(share, first);
    t += share * left;
    left = share < 1 ? (1 - share) * left : 0;
    for (const i of [0, 1]) {
      if (parts[i] > share + 1e-9) continue;
      set ^= 1 << i;
      const lands = Boolean(set & (1 << i)),
        force = lands ? Math.max(first[motion.force + i], 0) : 0;
      events.push({ wheel: i, kind: lands ? "landing" : "lift-off", t, X: v * t, force });
    }
    saved.set(w);
    if (left > 0) {
      advance(prepare(set, left), t);
      feel(t + left, last);
    }
  }
  return left > 0 ? press(last) : set;
}

/** The motion of a robot at a speed: its state w, and how a scheme goes on with each set of wheels. */
function makeMotion(data, robot, road, v, scheme) {
  const { C, D, P, S, e, equilibrium, contact } = robot,
    w = Float64Array.from(equilibrium),
    u = new Float64Array(4),
    [rear, front] = data.wheels;
  const systems = [0, 1, 2, 3].map((set) => {
    const pressing = P.map((row) => row.map((value, i) => (set & (1 << i) ? value : 0)));
    return { A: combine([1, S], [1, multiply(pressing, C)]), B: multiply(pressing, D) };
  });
  // What the conditions are about, of the rear and the front wheel, one condition after another.
  const { conditions } = contact,
    count = 2 * conditions.length;
  const M = flatten(conditions.flatMap(({ of: [ofState] }) => robot[ofState])),
    L = flatten(conditions.flatMap(({ of: [, ofRoad] }) => robot[ofRoad]));
  const strict = conditions.map((condition) => condition.strict);
  const meetRoad = (t) => {
    road(v * t + rear, u, 0, v);
    road(v * t + front, u, 1, v);
    return u[0] !== 0 || u[1] !== 0 || u[2] !== 0 || u[3] !== 0;
  };
  return {
    w,
    v,
    count,
    force: 2 * contact.force,
    length: 2 * contact.length,
    prepare(set, h) {
      const step = oneStep(scheme, systems[set].A, h);
      if (!step) return null;
      const { R, gains } = step;
      const total = combine(...gains.map(([, G]) => [1, G]));
      const forcing = gains.map(([, G]) => flatten(multiply(G, systems[set].B)));
      return { R: flatten(R), weight: apply(total, e), places: gains.map(([c]) => c * h), forcing };
    },
    advance(step, t) {
      if (!step) return; // of the length of a part, the chance is nil
      const { R, weight, places, forcing } = step,
        w0 = w[0],
        w1 = w[1],
        w2 = w[2],
        w3 = w[3];
      let x0 = weight[0] + R[0] * w0 + R[1] * w1 + R[2] * w2 + R[3] * w3;
      let x1 = weight[1] + R[4] * w0 + R[5] * w1 + R[6] * w2 + R[7] * w3;
      let x2 = weight[2] + R[8] * w0 + R[9] * w1 + R[10] * w2 + R[11] * w3;
      let x3 = weight[3] + R[12] * w0 + R[13] * w1 + R[14] * w2 + R[15] * w3;
      for (let q = 0; q < places.length; q++) {
        if (!meetRoad(t + places[q])) continue;
        const G = forcing[q];
        x0 += force(G, 0, u, 0);
        x1 += force(G, 1, u, 0);
        x2 += force(G, 2, u, 0);
        x3 += force(G, 3, u, 0);
      }
      w[0] = x0;
      w[1] = x1;
      w[2] = x2;
      w[3] = x3;
    },
    /** The quantities of both wheels, rear before front, one condition after another. */
    feel(t, found) {
      const level = !meetRoad(t);
      for (let i = 0; i < count; i++) {
        found[i] = force(M, i, w, 0) + (level ? 0 : force(L, i, u, 0));
      }
    },
    /** The set of wheels that press. */
    press(found) {
      let set = 3;
      for (let j = 0; j < count; j++) {
        const holds = strict[j >> 1] ? found[j] > 0 : found[j] >= 0;
        if (!holds) set &= ~(1 << (j & 1));
      }
      return set;
    },
  };
}

/**
 * Where, from 0 to 1, wheel i changes in a step: where the least of its conditions is zero, each in units
 * of its own change. `feelAt(share, found)` feels them there; secants, in brackets, lead to the zero.
 */
function turn(before, after, i, feelAt) {
  const found = before.slice(),
    sizes = before.map((value, j) => Math.abs(value - after[j]) || 1);
  const least = (values) =>
    values.reduce((low, value, j) => ((j & 1) === i ? Math.min(low, value / sizes[j]) : low), Infinity);
  let [a, b, x] = [0, 1, 0],
    [last, fLast] = [1, least(after)],
    fx = least(before);
  const isUp = fLast > 0;
  if (fx > 0 === isUp) return 1; // it begins at a zero
  for (let n = 0; n < REFINED; n++) {
    const secant = x - (fx * (x - last)) / (fx - fLast),
      next = secant >= a && secant <= b ? secant : (a + b) / 2;
    if (Math.abs(next - x) < CLOSE) return next;
    [last, fLast, x] = [x, fx, next];
    feelAt(x, found);
    fx = least(found);
    if (fx > 0 === isUp) b = x;
    else a = x;
  }
  return x;
}

/** How long each wheel bears no force, s. */
function airtime(events, end) {
  return [0, 1].map((i) => {
    let total = 0,
      since = null;
    for (const { wheel, kind, t } of events) {
      if (wheel !== i) continue;
      if (kind === "lift-off") since = t;
      else if (since !== null) [total, since] = [total + t - since, null];
    }
    return since === null ? total : total + Math.max(end - since, 0);
  });
}

/** When wheels were off the ground up to a time: [wheel, from, to]. */
export function airborne({ run, flight }, motion, t) {
  const found = [];
  for (const i of [0, 1]) {
    if (motion === "flying") {
      const own = flight.events.filter(({ wheel }) => wheel === i);
      own.forEach((event, n) => {
        if (event.kind === "lift-off" && event.t <= t)
          found.push([i, event.t, Math.min(own[n + 1]?.t ?? t, t)]);
      });
      continue;
    }
    let since = null;
    for (let n = 0; n <= (run?.J ?? -1) && n * run.dt <= t; n++) {
      const lost = !(run.N[i][n] > 0);
      if (lost && since === null) since = n * run.dt;
      if (!lost && since !== null) [since] = [null, found.push([i, since, n * run.dt])];
    }
    if (since !== null) found.push([i, since, t]);
  }
  return found;
}

/** The moment `at` steps after the start; between two samples on the straight line that is drawn. */
export function lookUp({ W, N, J, dt }, at) {
  const place = Math.min(at, J),
    n = Math.min(Math.floor(place), J - 1),
    part = place - n;
  const mix = (x) => (part === 0 ? x[n] : part === 1 ? x[n + 1] : x[n] + part * (x[n + 1] - x[n]));
  return { t: place * dt, W: W.map(mix), N: N.map(mix) };
}
