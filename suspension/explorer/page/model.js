// The numbers behind the picture. Python made every matrix and the road; this only iterates them.

/** A table that Python packed as little-endian doubles. */
const unpack = (view) =>
  new Float64Array(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength));

/** Row n of a table by its fields, whose names and lengths Python gives in their order. */
function readRow(table, fields, n) {
  const found = {};
  let start = n * fields.reduce((sum, [, length]) => sum + length, 0);
  for (const [name, length] of fields) {
    found[name] = table.subarray(start, start + length);
    start += length;
  }
  return found;
}

/** All tables and facts, with functions that look up what belongs to a choice of the sliders. */
export function readTables(facts, tables) {
  const table = Object.fromEntries(Object.entries(tables).map(([key, t]) => [key, unpack(t)]));
  return {
    ...facts,
    road: makeRoad(facts.road, table.road),
    robot(k) {
      return readRow(table.robots, facts.robotFields, k);
    },
    step(scheme, k, dt) {
      const { name, c, fields } = facts.schemes[scheme];
      const { M, growth, stable } = readRow(table[name], fields, k * facts.dts.length + dt);
      return { M, c, growth, stable: stable[0] === 1 };
    },
  };
}

/** road(x, out, i, v): height to out[i], rate of change v dH/dx to out[i + 2]. */
function makeRoad([start, cell, size], table) {
  const last = table.length / size - 1;
  const flat = Array.from({ length: last + 1 }, (_, n) =>
    table.subarray(size * n, size * (n + 1)).every((c) => c === 0));
  return (x, out, i, v) => {
    const at = (x - start) / cell;
    const n = Math.min(Math.max(Math.floor(at), 0), last);
    if (flat[n]) {
      out[i] = out[i + 2] = 0;
      return;
    }
    const s = Math.min(Math.max(2 * (at - n) - 1, -1), 1);
    let H = 0, slope = 0; // Horner's rule for both
    for (let j = size * (n + 1) - 1; j >= size * n; j--) {
      slope = slope * s + H;
      H = H * s + table[j];
    }
    out[i] = H;
    out[i + 2] = (v * slope * 2) / cell;
  };
}

/** Number of steps to cover a time: rounded up, but forgiving roundoff, as in Python. */
export function countSteps(tfinal, dt) {
  const J = tfinal / dt, whole = Math.round(J);
  return Math.max(Math.abs(J - whole) <= 1e-12 * J ? whole : Math.ceil(J), 1);
}

/** What the road does to both wheels at t_n + shift, n = 0 .. J, four numbers a time. */
function feel({ road, wheels }, v, dt, shift, u) {
  for (let n = 0; 4 * n < u.length; n++) {
    const X = v * (n * dt + shift);
    road(X + wheels[0], u, 4 * n, v);
    road(X + wheels[1], u, 4 * n + 1, v);
  }
  return u;
}

/** A row of a matrix that is stored by columns of `size` numbers, times a vector. */
const row = (M, i, size, a, b, c, d) =>
  M[i] * a + M[i + size] * b + M[i + 2 * size] * c + M[i + 3 * size] * d;

/** The force that the road adds at wheel i, from the four numbers at u[j]. */
const felt = (D, i, u, j) => row(D, i, 2, u[j], u[j + 1], u[j + 2], u[j + 3]);

/**
 * A function that runs J steps from equilibrium: states W (4 arrays) and normal forces N (2 arrays) at
 * t = 0, dt, .., J dt. The next run overwrites the arrays: that is much faster than new ones.
 */
export function makeRunner(data) {
  let memory = new Float64Array(0), last = null, stages, u;
  return ({ CD, equilibrium }, { M, c }, v, dt, J) => {
    const size = J + 1, between = c.filter((c) => c !== 0 && c !== 1);
    const key = [v, dt, J, ...c].join();
    if (key !== last) {
      const parts = 6 + 4 * (1 + between.length);
      if (memory.length < parts * size) memory = new Float64Array(2 * parts * size);
      const room = (i) => memory.subarray(6 * size + 4 * i * size, 6 * size + 4 * (i + 1) * size);
      u = feel(data, v, dt, 0, room(0));
      const own = between.map((c, i) => feel(data, v, dt, c * dt, room(i + 1)));
      stages = c.map((c) => (c === 0 ? u : c === 1 ? u.subarray(4) : own[between.indexOf(c)]));
      last = key;
    }
    const rows = Array.from({ length: 6 }, (_, i) => memory.subarray(i * size, (i + 1) * size));
    const W = rows.slice(0, 4), N = rows.slice(4);
    const [W0, W1, W2, W3] = W, [N1, N2] = N, D = CD.subarray(8);
    let [d0, d1, d2, d3] = [0, 0, 0, 0]; // deviation from equilibrium
    for (let n = 0; ; n++) {
      const w0 = (W0[n] = equilibrium[0] + d0), w1 = (W1[n] = equilibrium[1] + d1);
      const w2 = (W2[n] = equilibrium[2] + d2), w3 = (W3[n] = equilibrium[3] + d3);
      N1[n] = row(CD, 0, 2, w0, w1, w2, w3) + felt(D, 0, u, 4 * n);
      N2[n] = row(CD, 1, 2, w0, w1, w2, w3) + felt(D, 1, u, 4 * n);
      if (n === J) break;
      let x0 = row(M, 0, 4, d0, d1, d2, d3), x1 = row(M, 1, 4, d0, d1, d2, d3);
      let x2 = row(M, 2, 4, d0, d1, d2, d3), x3 = row(M, 3, 4, d0, d1, d2, d3);
      for (let q = 0, m = 16; q < stages.length; q++, m += 8) {
        const f1 = felt(D, 0, stages[q], 4 * n), f2 = felt(D, 1, stages[q], 4 * n);
        x0 += M[m] * f1 + M[m + 4] * f2;
        x1 += M[m + 1] * f1 + M[m + 5] * f2;
        x2 += M[m + 2] * f1 + M[m + 6] * f2;
        x3 += M[m + 3] * f1 + M[m + 7] * f2;
      }
      d0 = x0, d1 = x1, d2 = x2, d3 = x3;
    }
    return { W, N, J, dt, v };
  };
}

/**
 * First sample without contact; least and largest force, the least with its wheel (0 rear,
 * 1 front) and its time.
 */
export function judge({ N, dt }, J) {
  let least = Infinity, most = -Infinity, worst = 0, wheel = 0, lost = null;
  for (let n = 0; n <= J; n++) {
    const low = N[1][n] < N[0][n] ? 1 : 0;
    if (N[low][n] < least) [least, worst, wheel] = [N[low][n], n, low];
    if (N[1 - low][n] > most) most = N[1 - low][n];
    if (lost === null && N[low][n] <= 0) lost = { wheel: low, t: n * dt };
  }
  return { least, most, wheel, t: worst * dt, lost };
}

/** Largest difference in force from a run with steps `every` times shorter. */
export function difference(a, b, every) {
  let most = 0;
  for (const i of [0, 1]) {
    for (let n = 0; n <= a.J; n++) most = Math.max(most, Math.abs(a.N[i][n] - b.N[i][n * every]));
  }
  return most; // NaN once the run is past the largest number
}

/** The moment `at` steps after the start; between two samples on the straight line that is drawn. */
export function lookUp({ W, N, J, dt }, at) {
  const place = Math.min(at, J), n = Math.min(Math.floor(place), J - 1), part = place - n;
  const mix = (x) => (part === 0 ? x[n] : part === 1 ? x[n + 1] : x[n] + part * (x[n + 1] - x[n]));
  return { t: place * dt, W: W.map(mix), N: N.map(mix) };
}
