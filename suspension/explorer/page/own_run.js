// A robot of one's own on a road of one's own: the exact run, and what follows from it at every speed.
//
// The road is a polynomial on each piece, so on each leg, from where a wheel meets the end of a piece to
// where one meets the next, the motion is a power series whose terms follow from one another:
// (j + 1) d[j+1] = A d[j] + P f[j]. Its sum is exact to roundoff, and so are the least forces, which are
// those of polynomials. Nothing here is physics: the matrices are put together as Python says.

import { apply, characteristic, combine, multiply, roots, solve } from "./linear.js";

const MOST_TERMS = 60,
  REACH = 2, // radians of the fastest mode that one series goes
  NOTHING = 1e-18, // of the load, a term that is left out
  MOST_STEPS = 2e5, // series of one run
  LOOKS = 8; // places at which a force is looked at between two ends

// ---- the robot

/** A sum of matrices, each times a product of powers of the robot's numbers. */
function assemble(terms, values) {
  return combine(
    ...terms.map(({ powers, matrix }) => [
      Object.entries(powers).reduce((product, [name, power]) => product * values[name] ** power, 1),
      matrix,
    ]),
  );
}

/** The matrices of a robot, its rest and its modes, [re, im] in 1/s. */
export function makeVehicle(parts, values) {
  const [C, D, P, S, e, arms] = ["C", "D", "P", "S", "e", "arms"].map((name) =>
    assemble(parts[name], values),
  );
  const A = combine([1, S], [1, multiply(P, C)]);
  const equilibrium = solve(
    A,
    e.map(([value]) => -value),
  );
  const modes = roots(characteristic(A)).sort(
    ([a, b], [c, d]) => Math.hypot(a, b) - Math.hypot(c, d) || b - d,
  );
  return {
    ...{ values, A, C, D, P, equilibrium, modes },
    arms: arms.map(([arm]) => arm),
    load: apply(C, equilibrium),
    fastest: Math.max(...modes.map(([re, im]) => Math.hypot(re, im))),
  };
}

// ---- the road: pieces { x, a }, heights sum a[j] (place - x)^j from x to the next piece's x

/** Slopes at points so that nothing between them is higher or lower than they (Fritsch and Butland). */
function gentleSlopes(x, h) {
  const n = x.length,
    width = (i) => x[i + 1] - x[i],
    slope = (i) => (h[i + 1] - h[i]) / width(i);
  const slopes = [0];
  for (let i = 1; i < n - 1; i++) {
    const [before, after, left, right] = [slope(i - 1), slope(i), width(i - 1), width(i)];
    if (!(before * after > 0)) {
      slopes.push(0);
      continue;
    }
    const [w1, w2] = [2 * right + left, right + 2 * left];
    slopes.push(1 / ((w1 / before + w2 / after) / (w1 + w2)));
  }
  return [...slopes, 0];
}

/** A road through points, joined by curves ("pchip") or straight lines ("linear"), level before and after. */
export function piecesOf({ x, h, join }) {
  const slopes = join === "linear" ? null : gentleSlopes(x, h),
    pieces = [{ x: x[0], a: [h[0]], before: true }];
  for (let i = 0; i + 1 < x.length; i++) {
    const width = x[i + 1] - x[i],
      mean = (h[i + 1] - h[i]) / width;
    if (!slopes) pieces.push({ x: x[i], a: [h[i], mean] });
    else {
      const [s0, s1] = [slopes[i], slopes[i + 1]],
        t = (s0 + s1 - 2 * mean) / width;
      pieces.push({ x: x[i], a: [h[i], s0, (mean - s0) / width - t, t / width] });
    }
  }
  pieces.push({ x: x.at(-1), a: [h.at(-1)] });
  return pieces;
}

/** A bump of a height and a width: pieces of the table that Python made of one of height and width 1. */
export function bumpPieces({ start, cell, table }, { height, sigma, centre }) {
  const pieces = table.map((row, i) => ({
    x: centre + sigma * (start + i * cell),
    a: row.map((a, j) => (height * a) / sigma ** j),
  }));
  pieces.unshift({ x: pieces[0].x, a: [0], before: true });
  pieces.push({ x: centre + sigma * (start + table.length * cell), a: [0] });
  return pieces;
}

/** Which piece a place is on. */
function pieceAt(pieces, place) {
  let [low, high] = [0, pieces.length - 1];
  if (place < pieces[1].x) return 0;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (pieces[middle].x <= place) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** A polynomial in powers of (s + by) as one of s: Horner's shift. */
function shift(a, by) {
  const moved = Float64Array.from(a);
  if (by === 0) return moved;
  for (let i = 0; i < moved.length - 1; i++)
    for (let j = moved.length - 2; j >= i; j--) moved[j] += by * moved[j + 1];
  return moved;
}

export function heightAt(pieces, place) {
  const { x, a } = pieces[pieceAt(pieces, place)];
  return a.reduceRight((sum, part) => sum * (place - x) + part, 0);
}

/** Of a road: its highest place above the start, or lowest below it if that is further, and its steepest slope. */
export function shapeOf({ x, h, join }) {
  let [top, steepest] = [0, 0];
  for (const height of h) if (Math.abs(height - h[0]) > Math.abs(top)) top = height - h[0];
  for (const [i, { a }] of piecesOf({ x, h, join }).slice(1, -1).entries()) {
    const width = x[i + 1] - x[i],
      [, s0, bend = 0, twist = 0] = a,
      turn = twist ? Math.min(Math.max(-bend / (3 * twist), 0), width) : 0;
    for (const s of [0, turn, width])
      steepest = Math.max(steepest, Math.abs(s0 + s * (2 * bend + 3 * twist * s)));
  }
  return { height: top, steepest, sigma: Math.abs(top) / (Math.sqrt(Math.E) * steepest) };
}

// ---- the way, and runs on it

/**
 * The way of a robot from X = 0 to `distance` over the pieces of a road, in legs: where each begins and
 * how long it is, and the road's part of both forces in powers of the distance since: by heights, and
 * by slopes, which count as often as the speed says.
 */
export function makeWay({ arms, D }, pieces, distance) {
  const cuts = [0, distance];
  for (const { x } of pieces)
    for (const arm of arms) if (x - arm > 0 && x - arm < distance) cuts.push(x - arm);
  cuts.sort((a, b) => a - b);
  const legs = [];
  for (let i = 0; i + 1 < cuts.length; i++) {
    const [X, length] = [cuts[i], cuts[i + 1] - cuts[i]];
    if (length <= 1e-12 * distance) continue;
    const heights = arms.map((arm) => {
      const { x, a, before } = pieces[pieceAt(pieces, X + length / 2 + arm)];
      return before ? Float64Array.from(a) : shift(a, X + arm - x);
    });
    const count = Math.max(...heights.map((a) => a.length)),
      parts = [0, 1].map(() => new Float64Array(2 * count));
    for (const i of [0, 1])
      for (const wheel of [0, 1]) {
        const a = heights[wheel];
        for (let j = 0; j < a.length; j++) {
          parts[0][2 * j + i] += D[i][wheel] * a[j];
          if (j) parts[1][2 * (j - 1) + i] += D[i][2 + wheel] * j * a[j];
        }
      }
    const isLevel = heights.every((a) => a.every((value) => value === 0));
    legs.push({ X, length, count: isLevel ? 0 : count, byHeight: parts[0], bySlope: parts[1] });
  }
  return legs;
}

export const isTooLong = ({ fastest }, distance, v) => (fastest * distance) / v > REACH * MOST_STEPS;

/**
 * Drive over a way at a speed, from rest. `meet({ X, length, n }, rear, front, state)` gets one stretch
 * after the other: what a wheel's force is beside its load is sum force[j] s^j, j < n, with s from 0 to
 * 1 on it, and the state at its end differs from rest by `state`. What it returns, if anything, ends the run.
 */
function drive({ A, C, P, fastest, load }, legs, v, meet) {
  const [A0, A1, A2, A3] = A,
    [P0, P1, P2, P3] = P,
    [C0, C1] = C,
    weight = Math.max(...load.map(Math.abs)) || 1,
    [k0, k1, k2, k3] = C0.map((x, i) => Math.max(Math.abs(x), Math.abs(C1[i])));
  const rear = new Float64Array(MOST_TERMS + 1),
    front = rear.slice(),
    f = new Float64Array(2 * MOST_TERMS + 2),
    stretch = { X: 0, length: 0, n: 1 },
    state = [0, 0, 0, 0];
  let [d0, d1, d2, d3] = state;
  for (const { X, length, count, byHeight, bySlope } of legs) {
    const isStill = !count && d0 === 0 && d1 === 0 && d2 === 0 && d3 === 0,
      steps = isStill ? 1 : Math.max(1, Math.ceil((fastest * length) / v / REACH)),
      part = length / steps,
      dt = part / v;
    for (let step = 0; step < steps; step++) {
      for (let j = 0; j < 2 * count; j++) f[j] = byHeight[j] + v * bySlope[j];
      for (let i = 0; step && i < count - 1; i++)
        for (let j = 2 * count - 3; j >= 2 * i; j--) f[j] += step * part * f[j + 2];
      let power = 1, // of the length of the stretch
        quiet = 0,
        n = 0,
        [x0, x1, x2, x3] = [d0, d1, d2, d3];
      d0 = d1 = d2 = d3 = 0;
      for (; n < MOST_TERMS && quiet < 2; n++) {
        d0 += x0;
        d1 += x1;
        d2 += x2;
        d3 += x3;
        let f0 = 0,
          f1 = 0;
        if (n < count) {
          f0 = power * f[2 * n];
          f1 = power * f[2 * n + 1];
          power *= part;
        }
        const F0 = C0[0] * x0 + C0[1] * x1 + C0[2] * x2 + C0[3] * x3 + f0,
          F1 = C1[0] * x0 + C1[1] * x1 + C1[2] * x2 + C1[3] * x3 + f1,
          h = dt / (n + 1),
          size = k0 * Math.abs(x0) + k1 * Math.abs(x1) + k2 * Math.abs(x2) + k3 * Math.abs(x3);
        rear[n] = F0;
        front[n] = F1;
        quiet = n >= count && size <= NOTHING * weight ? quiet + 1 : 0;
        const y0 = A0[0] * x0 + A0[1] * x1 + A0[2] * x2 + A0[3] * x3 + P0[0] * f0 + P0[1] * f1,
          y1 = A1[0] * x0 + A1[1] * x1 + A1[2] * x2 + A1[3] * x3 + P1[0] * f0 + P1[1] * f1,
          y2 = A2[0] * x0 + A2[1] * x1 + A2[2] * x2 + A2[3] * x3 + P2[0] * f0 + P2[1] * f1,
          y3 = A3[0] * x0 + A3[1] * x1 + A3[2] * x2 + A3[3] * x3 + P3[0] * f0 + P3[1] * f1;
        x0 = h * y0;
        x1 = h * y1;
        x2 = h * y2;
        x3 = h * y3;
      }
      stretch.X = X + step * part;
      stretch.length = part;
      stretch.n = n;
      state[0] = d0;
      state[1] = d1;
      state[2] = d2;
      state[3] = d3;
      const ended = meet(stretch, rear, front, state);
      if (ended !== undefined) return ended;
    }
  }
  return undefined;
}

const at = (a, n, s) => {
  let sum = 0;
  for (let j = n - 1; j >= 0; j--) sum = sum * s + a[j];
  return sum;
};
const slopeAt = (a, n, s) => {
  let sum = 0;
  for (let j = n - 1; j > 0; j--) sum = sum * s + j * a[j];
  return sum;
};

/** Where between a and b, where f has different signs, it is zero: halving, and straight lines. */
export function zero(f, a, b, fa = f(a), fb = f(b)) {
  for (let i = 0; i < 200 && Math.abs(b - a) > 4e-16 * Math.max(Math.abs(a), Math.abs(b)); i++) {
    if (fb === 0) return b;
    let x = i % 3 === 2 ? (a + b) / 2 : b - (fb * (b - a)) / (fb - fa);
    if (!(x > Math.min(a, b) && x < Math.max(a, b))) x = (a + b) / 2;
    if (x === a || x === b) break;
    const fx = f(x);
    if (fx > 0 === fb > 0) {
      [b, fb] = [x, fx];
      fa /= 2; // Illinois: the other end moves too
    } else [a, fa, b, fb] = [b, fb, x, fx];
  }
  return Math.abs(fa) < Math.abs(fb) ? a : b;
}

/**
 * The least of a polynomial on 0 to 1 if it is below a bound, and where: it may be lower only where the
 * sum of its falling terms allows.
 */
function dip(a, n, bound) {
  let lowest = a[0],
    sum = 0;
  for (let j = n - 1; j > 0; j--) {
    if (a[j] < 0) lowest += a[j];
    sum += a[j];
  }
  if (!(lowest < bound)) return null;
  let [least, place] = a[0] <= a[0] + sum ? [a[0], 0] : [a[0] + sum, 1],
    before = slopeAt(a, n, 0);
  for (let i = 1; i <= LOOKS; i++) {
    const after = slopeAt(a, n, i / LOOKS);
    if (before < 0 && after > 0) {
      const s = zero((s) => slopeAt(a, n, s), (i - 1) / LOOKS, i / LOOKS, before, after),
        value = at(a, n, s);
      if (value < least) [least, place] = [value, s];
    }
    before = after;
  }
  return least < bound ? [least, place] : null;
}

/** The least force of each wheel on the way, rear before front: { force, X }. */
export function leastForces(vehicle, legs, v, end = Infinity) {
  const found = vehicle.load.map((load) => ({ force: load, X: 0 })),
    below = [Infinity, Infinity];
  drive(vehicle, legs, v, (stretch, rear, front) => {
    const { X, length, n } = stretch;
    if (X >= end) return true;
    const share = X + length > end ? (end - X) / length : 1;
    for (const i of [0, 1]) {
      const a = i ? front : rear;
      if (share < 1) for (let j = 0, power = 1; j < n; j++, power *= share) a[j] *= power;
      const lower = dip(a, n, below[i]);
      if (lower) {
        below[i] = lower[0];
        found[i] = { force: vehicle.load[i] + lower[0], X: X + lower[1] * share * length };
      }
    }
  });
  return found;
}

/** What each wheel's force falls below its load on the way, N, [rear, front]: quickly, for many speeds. */
export function falls(vehicle, legs, v) {
  let [below0, below1] = [0, 0];
  drive(vehicle, legs, v, ({ n }, rear, front) => {
    const [low0, low1] = [dip(rear, n, below0), dip(front, n, below1)];
    if (low0) below0 = low0[0];
    if (low1) below1 = low1[0];
  });
  return [-below0, -below1];
}

/** The first loss of contact, { wheel, X }, or null. */
export function firstLoss(vehicle, legs, v) {
  return (
    drive(vehicle, legs, v, ({ X, length, n }, rear, front) => {
      let first = null;
      for (const wheel of [0, 1]) {
        const a = wheel ? front : rear,
          load = vehicle.load[wheel];
        if (!dip(a, n, -load + 1e-300)) continue;
        const force = (s) => load + at(a, n, s);
        let s = 0;
        if (force(0) > 0) {
          // The first of the places at which it has fallen so far, by looking closer and closer.
          let end = 1;
          for (let i = 1; i <= LOOKS; i++) {
            const [low, high] = [(i - 1) / LOOKS, i / LOOKS];
            if (force(high) <= 0) {
              end = high;
              break;
            }
            const [before, after] = [slopeAt(a, n, low), slopeAt(a, n, high)];
            if (before < 0 && after > 0) {
              const bottom = zero((s) => slopeAt(a, n, s), low, high, before, after);
              if (force(bottom) <= 0) {
                end = bottom;
                break;
              }
            }
          }
          let begin = 0;
          for (let i = 0; i < LOOKS; i++) if (i / LOOKS < end && force(i / LOOKS) > 0) begin = i / LOOKS;
          s = zero(force, begin, end);
        }
        if (!first || X + s * length < first.X) first = { wheel, X: X + s * length };
      }
      return first ?? undefined;
    }) ?? null
  );
}

/** Both forces along the way as one draws them: places X, forces [rear, front] and states beside rest. */
export function trackOf(vehicle, legs, v) {
  const track = { X: [], N: [[], []], ends: [], states: [] };
  drive(vehicle, legs, v, ({ X, length, n }, rear, front, state) => {
    const looks = Math.min(Math.max(2, Math.ceil(n / 3)), LOOKS);
    for (let i = 0; i <= looks; i++) {
      const s = i / looks;
      track.X.push(X + s * length);
      track.N[0].push(vehicle.load[0] + at(rear, n, s));
      track.N[1].push(vehicle.load[1] + at(front, n, s));
    }
    track.ends.push(X + length);
    track.states.push([...state]);
  });
  return track;
}

/** How many times as high the road may be for both wheels to stay on it, from what the forces fall. */
export const multipleOf = ({ load }, fallen) =>
  Math.min(...load.map((weight, i) => (fallen[i] > 1e-12 * weight ? weight / fallen[i] : Infinity)));

export const marginOf = ({ load }, fallen) => Math.min(...load.map((weight, i) => weight - fallen[i]));

/**
 * All zeros of a margin between two speeds, as Python looks for them: wherever twice the slope found
 * nearby would be enough for one, it looks again, down to a hundred-thousandth. A generator: it rests
 * after each look, and returns the speeds.
 */
export function* search(marginAt, low, high, count) {
  const RESOLUTION = 1e-5,
    f = (x) => marginAt(Math.exp(x)),
    [from, to] = [Math.log(low), Math.log(high)];
  let points = [];
  for (let i = 0; i < count; i++) {
    const x = i === count - 1 ? to : from + ((to - from) * i) / (count - 1);
    points.push([x, f(x)]);
    yield;
  }
  for (;;) {
    const slopes = points.slice(1).map(([x, y], i) => Math.abs(y - points[i][1]) / (x - points[i][0])),
      nearby = (i) => {
        let most = 0;
        for (let j = Math.max(i - 2, 0); j <= Math.min(i + 2, slopes.length - 1); j++)
          most = Math.max(most, slopes[j]);
        return most;
      };
    const next = [points[0]];
    for (let i = 0; i < slopes.length; i++) {
      const [[a, fa], [b, fb]] = [points[i], points[i + 1]];
      if (b - a > RESOLUTION && Math.abs(fa) + Math.abs(fb) < 2 * nearby(i) * (b - a)) {
        next.push([(a + b) / 2, f((a + b) / 2)]);
        yield;
      }
      next.push(points[i + 1]);
    }
    if (next.length === points.length) break;
    points = next;
  }
  const found = [];
  for (let i = 0; i + 1 < points.length; i++) {
    const [[a, fa], [b, fb]] = [points[i], points[i + 1]];
    if (fa === 0) found.push(a);
    else if (fa * fb < 0) {
      found.push(zero(f, a, b, fa, fb));
      yield;
    }
  }
  return found.map(Math.exp);
}
