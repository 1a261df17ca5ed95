// Linear algebra with small dense matrices: arrays of rows. Nothing here knows what they mean.

export function zeros(rows, columns) {
  const M = [];
  for (let i = 0; i < rows; i++) M.push(new Float64Array(columns));
  return M;
}

export function identity(n) {
  const M = zeros(n, n);
  for (let i = 0; i < n; i++) M[i][i] = 1;
  return M;
}

/** sum of factor * matrix over the pairs. */
export function combine(...pairs) {
  const sum = zeros(pairs[0][1].length, pairs[0][1][0].length);
  for (const [factor, M] of pairs) {
    M.forEach((row, i) => row.forEach((value, j) => (sum[i][j] += factor * value)));
  }
  return sum;
}

export function multiply(A, B) {
  const columns = B[0].length,
    product = zeros(A.length, columns);
  for (let i = 0; i < A.length; i++) {
    for (let k = 0; k < B.length; k++) {
      const a = A[i][k];
      if (a !== 0) for (let j = 0; j < columns; j++) product[i][j] += a * B[k][j];
    }
  }
  return product;
}

export const apply = (A, x) => A.map((row) => row.reduce((sum, a, j) => sum + a * x[j], 0));

/**
 * Solve A X = B in place: rows of A with those of B behind them, one after another in M, where X
 * takes the place of B. False if A is singular.
 */
export function eliminate(M, n, width) {
  for (let j = 0; j < n; j++) {
    let pivot = j;
    for (let i = j + 1; i < n; i++) {
      if (Math.abs(M[i * width + j]) > Math.abs(M[pivot * width + j])) pivot = i;
    }
    if (M[pivot * width + j] === 0) return false;
    if (pivot !== j) {
      for (let k = j; k < width; k++) {
        const kept = M[j * width + k];
        M[j * width + k] = M[pivot * width + k];
        M[pivot * width + k] = kept;
      }
    }
    for (let i = j + 1; i < n; i++) {
      const factor = M[i * width + j] / M[j * width + j];
      if (factor === 0) continue;
      for (let k = j + 1; k < width; k++) M[i * width + k] -= factor * M[j * width + k];
    }
  }
  for (let j = n - 1; j >= 0; j--) {
    for (let k = n; k < width; k++) {
      let sum = M[j * width + k];
      for (let i = j + 1; i < n; i++) sum -= M[j * width + i] * M[i * width + k];
      M[j * width + k] = sum / M[j * width + j];
    }
  }
  return true;
}

/** Solve A x = b; null if A is singular. */
export function solve(A, b) {
  const n = A.length,
    M = new Float64Array(n * (n + 1));
  A.forEach((row, i) => {
    M.set(row, i * (n + 1));
    M[i * (n + 1) + n] = b[i];
  });
  return eliminate(M, n, n + 1) ? Array.from(A, (_, i) => M[i * (n + 1) + n]) : null;
}

/** Coefficients of det(z I - A), the lowest power first (Faddeev and LeVerrier). */
export function characteristic(A) {
  const n = A.length,
    coefficients = new Float64Array(n + 1);
  coefficients[n] = 1;
  let X = identity(n);
  for (let j = 1; j <= n; j++) {
    X = multiply(A, X);
    let trace = 0;
    for (let i = 0; i < n; i++) trace += X[i][i];
    coefficients[n - j] = -trace / j;
    for (let i = 0; i < n; i++) X[i][i] += coefficients[n - j];
  }
  return coefficients;
}

/** A polynomial, lowest power first, at a complex point [re, im]. */
export function evaluate(coefficients, [re, im]) {
  let x = 0,
    y = 0;
  for (let j = coefficients.length - 1; j >= 0; j--) {
    [x, y] = [x * re - y * im + coefficients[j], x * im + y * re];
  }
  return [x, y];
}

const times = ([a, b], [c, d]) => [a * c - b * d, a * d + b * c];

export function divide([a, b], [c, d]) {
  const size = c * c + d * d;
  return [(a * c + b * d) / size, (b * c - a * d) / size];
}

/** All roots of a real polynomial of leading coefficient 1: Aberth's iteration, all at once. */
export function roots(coefficients) {
  const n = coefficients.length - 1;
  let radius = 0;
  for (let j = 0; j < n; j++) radius = Math.max(radius, Math.abs(coefficients[j]) ** (1 / (n - j)));
  if (radius === 0) return Array.from({ length: n }, () => [0, 0]);
  // Scaled, so that the roots are of size one.
  const scaled = Array.from(coefficients, (a, j) => a / radius ** (n - j));
  const slope = scaled.slice(1).map((a, j) => (j + 1) * a);
  const z = Array.from({ length: n }, (_, j) => {
    const angle = (2 * Math.PI * j) / n + 0.4;
    return [0.8 * Math.cos(angle), 0.8 * Math.sin(angle)];
  });
  for (let iteration = 0; iteration < 100; iteration++) {
    let change = 0;
    for (let j = 0; j < n; j++) {
      const value = evaluate(scaled, z[j]);
      if (value[0] === 0 && value[1] === 0) continue;
      const newton = divide(value, evaluate(slope, z[j]));
      let others = [0, 0];
      for (let i = 0; i < n; i++) {
        if (i === j) continue;
        const away = divide([1, 0], [z[j][0] - z[i][0], z[j][1] - z[i][1]]);
        others = [others[0] + away[0], others[1] + away[1]];
      }
      const product = times(newton, others);
      const step = divide(newton, [1 - product[0], -product[1]]);
      if (!Number.isFinite(step[0] + step[1])) continue;
      z[j] = [z[j][0] - step[0], z[j][1] - step[1]];
      change = Math.max(change, Math.hypot(...step));
    }
    if (change < 1e-15) break;
  }
  return z.map(([re, im]) => [radius * re, radius * (Math.abs(im) < 1e-13 ? 0 : im)]);
}
