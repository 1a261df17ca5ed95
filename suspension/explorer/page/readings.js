// From readings to verdicts, as numbers: the fit, its intervals and test, the stiffness, the critical
// speeds, the confidence. Quantiles and tables come from Python; here is least squares and look-up.

const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);

/** Q and R of the columns of a matrix, by Gram and Schmidt; what is left of the forces is orthogonal to Q. */
function factor(columns, forces) {
  const Q = [],
    R = [],
    left = [...forces],
    seen = [0, 0, 0];
  columns.forEach((column, j) => {
    const q = [...column];
    R.push([0, 0, 0]);
    for (
      let pass = 0;
      pass < 2;
      pass++ // the second takes what roundoff has left
    )
      for (let i = 0; i < j; i++) {
        const part = dot(Q[i], q);
        R[i][j] += part;
        q.forEach((_, n) => (q[n] -= part * Q[i][n]));
      }
    R[j][j] = Math.sqrt(dot(q, q));
    Q.push(q.map((x) => x / R[j][j]));
  });
  for (let pass = 0; pass < 2; pass++)
    Q.forEach((q, j) => {
      const part = dot(q, left);
      seen[j] += part;
      left.forEach((_, n) => (left[n] -= part * q[n]));
    });
  return { R, seen, left };
}

/** The inverse of an upper triangle of three rows. */
function invert([[a, b, c], [, d, e], [, , f]]) {
  return [
    [1 / a, -b / (a * d), (b * e - c * d) / (a * d * f)],
    [0, 1 / d, -e / (d * f)],
    [0, 0, 1 / f],
  ];
}

/** Why readings cannot be fitted and judged, "" if they can. */
export function whyNot(readings, most) {
  if (new Set(readings.map(([x]) => x)).size < 3)
    return "a parabola needs readings at three different displacements";
  if (readings.length < 4) return "with three readings nothing is left to tell the scatter by";
  if (readings.length > most) return `there is room for ${most} readings`;
  return "";
}

/** The regression, F = b0 + b1 x + b2 x², with all that Part I tells of it. */
export function fitReadings(readings, facts) {
  const x = readings.map(([at]) => at),
    forces = readings.map(([, force]) => force),
    { R, seen, left } = factor([x.map(() => 1), x, x.map((at) => at * at)], forces),
    inverse = invert(R),
    free = x.length - 3,
    largest = Math.max(...forces.map(Math.abs)),
    beta = inverse.map((row) => dot(row, seen)),
    scatter = Math.sqrt(dot(left, left) / free),
    V = inverse.map((row) => inverse.map((other) => scatter ** 2 * dot(row, other))),
    errors = V.map((row, j) => Math.sqrt(row[j])),
    quantile = (name) => facts.quantiles[name][free - 1],
    intervals = (name) =>
      beta.map((b, j) => [b - quantile(name) * errors[j], b + quantile(name) * errors[j]]);
  const isExact = Math.max(...left.map(Math.abs)) <= facts.roundoff[0] * largest;
  const fit = {
    ...{ beta, errors, scatter, free, V, isExact, region: quantile("region"), alone: intervals("t") },
    joint: intervals("joint"),
    k: beta[1] / facts.delta_max,
    error: errors[1] / facts.delta_max,
    force: (at) => beta[0] + at * (beta[1] + at * beta[2]),
    band(at) {
      const row = [1, at, at * at];
      return (
        quantile("t") *
        scatter *
        Math.hypot(
          ...[0, 1, 2].map((j) =>
            dot(
              inverse.map((r) => r[j]),
              row,
            ),
          ),
        )
      );
    },
  };
  fit.interval = fit.alone[1].map((b) => b / facts.delta_max);
  fit.test = testLine(fit, largest, facts);
  return fit;
}

/** The F test of b0 = b2 = 0, and whether zero lies in both joint intervals. */
function testLine({ beta: [b0, , b2], V, free, isExact, joint }, largest, { level, roundoff }) {
  if (isExact) {
    const isLine = Math.max(Math.abs(b0), Math.abs(b2)) <= 1e3 * roundoff[0] * largest;
    return { F: isLine ? 0 : Infinity, p: isLine ? 1 : 0, inside: isLine, joint: isLine };
  }
  const [a, b, c] = [V[0][0], V[0][2], V[2][2]],
    F = (c * b0 * b0 - 2 * b * b0 * b2 + a * b2 * b2) / (a * c - b * b) / 2,
    p = (1 + (2 * F) / free) ** (-free / 2), // with two coefficients the tail of F is a power
    isIn = ([low, high]) => low <= 0 && high >= 0;
  return { F, p, inside: p >= 1 - level, joint: isIn(joint[0]) && isIn(joint[2]) };
}

/** Student's distribution function for a whole number of degrees of freedom: a finite sum. */
export function student(t, free) {
  const cos2 = free / (free + t * t),
    sin = t / Math.hypot(t, Math.sqrt(free));
  let sum = free > 1 ? 1 : 0;
  for (let n = free - 2; n > 1; n -= 2) sum = 1 + ((n - 1) / n) * cos2 * sum;
  if (free % 2 === 0) return (1 + sin * sum) / 2;
  return 0.5 + (Math.atan(t / Math.sqrt(free)) + sin * Math.sqrt(cos2) * sum) / Math.PI;
}

// ---- the consequence of a stiffness

/** Where y = ln k lies between the ends of a branch, 0 to 1: smooth where the branch turns. */
const along = (y, low, high) =>
  Math.acos(Math.min(Math.max(1 - (2 * (y - low)) / (high - low), -1), 1)) / Math.PI;

/** A branch of critical speeds, of a table of ln k and ln v: `speed` is null where it is not. */
export function makeBranch({ k, v, born, dies }) {
  const [low, high] = [k[0], k.at(-1)],
    places = k.map((y) => along(y, low, high));
  const speed = (stiffness) => {
    const y = Math.log(stiffness);
    if (!(low <= y && y <= high)) return null;
    const at = along(y, low, high),
      count = Math.min(4, k.length);
    let [from, to] = [0, k.length]; // the first node beyond the place lies between
    while (from < to) {
      const middle = (from + to) >> 1;
      if (places[middle] > at) to = middle;
      else from = middle + 1;
    }
    const first = Math.min(Math.max(from - 2, 0), k.length - count);
    let total = 0;
    for (let i = first; i < first + count; i++) {
      let weight = v[i];
      for (let j = first; j < first + count; j++)
        if (j !== i) weight *= (at - places[j]) / (places[i] - places[j]);
      total += weight;
    }
    return Math.exp(total);
  };
  const ends = [k[0], k.at(-1)].map(Math.exp);
  return { ends, born, dies, speed, nodes: k.map((y, i) => [Math.exp(y), Math.exp(v[i])]) };
}

/** What of a stiffness's interval the table reaches: its ends, and whether it leaves out any. */
function withinTable({ k, interval }, { k: [least, most], widest }) {
  const bounds = [Math.max(interval[0], k / widest), Math.min(interval[1], k * widest)];
  const ends = [Math.max(bounds[0], least), Math.min(bounds[1], most)];
  return { ends, isWhole: interval[0] >= least && interval[1] <= most };
}

/** Every critical speed while the stiffness goes through its interval, in order of speed. */
export function criticalSpeeds(fit, branches, facts) {
  if (!(fit.k >= facts.k[0] && fit.k <= facts.k[1])) return null;
  const {
      ends: [low, high],
      isWhole,
    } = withinTable(fit, facts),
    found = [];
  for (const {
    ends: [first, last],
    born,
    dies,
    speed,
    nodes,
  } of branches) {
    if (high < first || low > last) continue;
    const inside = nodes.filter(([k]) => low <= k && k <= high).map(([, v]) => v),
      met = [...inside, speed(low), speed(high)].filter((v) => v !== null);
    found.push({
      speed: speed(fit.k),
      low: Math.min(...met),
      high: Math.max(...met),
      born: born && first > low ? { k: first, why: born } : null,
      dies: dies && last < high ? { k: last, why: dies } : null,
    });
  }
  found.sort((a, b) => a.low * a.high - b.low * b.high);
  return { speeds: found, isWhole };
}

/**
 * How much of the confidence distribution of the stiffness loses contact at each asked speed, and how
 * much lies beyond the table, which may do either. `isLost` is the verdict at the estimate.
 */
export function confidences(fit, { asked, k: [least, most], quantiles, widest, roundoff }) {
  if (!(fit.k >= least && fit.k <= most)) return null;
  const { k, error, free } = fit,
    isKnown = error <= roundoff[1] * k,
    below = (at) => student((at - k) / error, free),
    reach = quantiles.tail[free - 1] * error,
    low = Math.max(k - reach, k / widest),
    high = Math.min(k + reach, k * widest);
  return asked.map(({ v, flips, lost }) => {
    const isLost = lost[flips.filter((flip) => flip < k).length];
    if (isKnown) return { v, isLost, lost: isLost ? 1 : 0, beyond: 0 };
    const edges = [low < least ? least : -Infinity, ...flips, high > most ? most : Infinity],
      shares = edges.map((edge) => (edge > low && edge < high ? below(edge) : edge <= low ? 0 : 1));
    const parts = lost.map((isSo, i) => (isSo ? shares[i + 1] - shares[i] : 0));
    return {
      ...{ v, isLost, beyond: shares[0] + 1 - shares.at(-1) },
      lost: parts.reduce((sum, part) => sum + part, 0),
    };
  });
}

/** All that follows from the readings. */
export function follow(readings, facts, branches) {
  const why = whyNot(readings, facts.quantiles.t.length + 3);
  if (why) return { why };
  const fit = fitReadings(readings, facts);
  return { fit, critical: criticalSpeeds(fit, branches, facts), verdicts: confidences(fit, facts) };
}
