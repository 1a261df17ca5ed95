// What every panel needs: numbers as text, round numbers for an axis, a pen for a canvas.

const FAR = 5000; // pixels
const SIZE = 12; // of letters in a picture, pixels

/** How much larger than usual a reader wants letters: pictures grow with them, see `makePainter`. */
export const enlargement = () =>
  Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / 16 || 1;

/** Pixels of the screen for one of a picture. */
export const ratioOf = (zoom) => (window.devicePixelRatio || 1) * zoom;

export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** A number in few digits, with a true minus sign and powers of ten. */
export function show(x, digits = 3) {
  if (!Number.isFinite(x)) return "more than 10³⁰⁰";
  const [mantissa, power] = x
    .toExponential(digits - 1)
    .split("e")
    .map(Number);
  const raised = String(power).replace(/./g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
  const plain = x === 0 || (power > -4 && power < 5);
  const text = plain ? String(Number(x.toPrecision(digits))) : `${mantissa}\u00a0×\u00a010${raised}`;
  return text.replace("-", "−");
}

/** A number as one writes it: at most so many digits, no power of ten, no trailing zeros. */
export const plain = (x, digits = 6) => String(Number(x.toPrecision(digits)));

/** Round numbers from low to high, at most `count` steps of 1, 2 or 5 times a power of ten. */
export function ticks(low, high, count) {
  const raw = (high - low) / count,
    ten = 10 ** Math.floor(Math.log10(raw));
  const step = ten * [1, 2, 5, 10].find((m) => m * ten >= raw);
  const first = Math.ceil(low / step - 1e-9),
    last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

/** Round numbers for a logarithmic axis: 1, 2 and 5 times the powers of ten from low to high. */
export function powers(low, high) {
  const found = [];
  for (let ten = 10 ** Math.floor(Math.log10(low)); ten <= high; ten *= 10) {
    for (const m of [1, 2, 5]) {
      const value = Number((m * ten).toPrecision(1));
      if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) found.push(value);
    }
  }
  return found;
}

/** A curve through samples; where they are dense, the first of each few and those that stand out. */
export function trace(values, x, y, width) {
  const path = new Path2D(),
    every = Math.max(1, Math.floor((2 * values.length) / width));
  for (let n = 0; n < values.length; n += every) {
    const end = Math.min(n + every, values.length) - 1,
      points = [n];
    let low = n,
      high = n;
    for (let m = n + 1; m <= end; m++) {
      if (values[m] < values[low]) low = m;
      if (values[m] > values[high]) high = m;
    }
    for (const m of low < high ? [low, high] : [high, low]) if (n < m && m < end) points.push(m);
    if (end === values.length - 1 && end > n) points.push(end);
    for (const m of points) {
      const height = clamp(y(values[m]), -FAR, FAR);
      if (!Number.isNaN(height)) path.lineTo(x(m), height);
      if (!(Math.abs(height) < FAR)) return path; // an unstable run has left for good
    }
  }
  return path;
}

/** Where a text from x to x + length on a base line at y stands in its canvas, however it is turned. */
function boxOf({ a, b, c, d, e, f }, x, y, length, size) {
  const corners = [x, x + length].flatMap((x) => [y - 0.75 * size, y + 0.1 * size].map((y) => [x, y])),
    xs = corners.map(([x, y]) => a * x + c * y + e),
    ys = corners.map(([x, y]) => b * x + d * y + f);
  return [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
}

/**
 * A cleared canvas of w by h at the screen's resolution, and a pen with the theme's colours. It never
 * writes over what it has written, nor what would be cut: of two words for one place the first stays.
 */
export function begin(canvas, w, h, colours, ratio = ratioOf(1)) {
  const g = canvas.getContext("2d");
  const [width, height] = [Math.round(w * ratio), Math.round(h * ratio)];
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, w, h);
  g.lineJoin = "round";
  const taken = []; // boxes: left, right, top, bottom in the canvas
  const isFree = ([left, right, top, bottom]) =>
    left >= -ratio &&
    right <= width + ratio &&
    taken.every(([l, r, t, b]) => left >= r || right <= l || top >= b || bottom <= t);
  const pen = {
    g,
    w,
    h,
    colours,
    stroke(colour, lineWidth, dash = [], path) {
      Object.assign(g, { strokeStyle: colours[colour], lineWidth });
      g.setLineDash(dash);
      if (path) g.stroke(path);
    },
    fill(colour, alpha = 1, path) {
      const before = g.globalAlpha;
      Object.assign(g, { fillStyle: colours[colour], globalAlpha: before * alpha });
      if (path) g.fill(path, "evenodd");
      g.globalAlpha = before;
    },
    shade(colour, alpha, x, y, width, height) {
      g.save();
      Object.assign(g, { fillStyle: colours[colour], globalAlpha: alpha });
      g.fillRect(x, y, width, height);
      g.restore();
    },
    line(...xy) {
      g.beginPath();
      for (let i = 0; i < xy.length; i += 2) g.lineTo(xy[i], xy[i + 1]);
      g.stroke();
    },
    dot(x, y, radius, colour, edge, lineWidth = 1.5) {
      const path = new Path2D();
      path.arc(x, y, radius, 0, 2 * Math.PI);
      if (colour) pen.fill(colour, 1, path);
      if (edge) pen.stroke(edge, lineWidth, [], path);
    },
    /** Keep words out of a rectangle. */
    reserve(left, top, right, bottom) {
      taken.push(boxOf(g.getTransform(), left, bottom, right - left, (bottom - top) / 0.85));
    },
    /** Write, where there is room for it; whether there was. `over`: whatever stands there. */
    text(words, x, y, { align = "left", colour = "soft", bold = false, halo = false, over = false } = {}) {
      g.save();
      g.font = `${bold ? "600 " : ""}${SIZE}px ${colours.font}`;
      g.textAlign = align;
      const length = g.measureText(words).width,
        left = x - { left: 0, center: length / 2, right: length }[align],
        box = boxOf(g.getTransform(), left, y, length, SIZE),
        free = over || isFree(box);
      if (free) {
        taken.push(box);
        pen.stroke("paper", 3); // so that it stays readable across a curve
        if (halo) g.strokeText(words, x, y);
        pen.fill(colour);
        g.fillText(words, x, y);
      }
      g.restore();
      return free;
    },
    /** Swatches, each with a word for it, one after another as long as there is room; whether there was. */
    legend(x, y, end, entries) {
      g.save();
      g.font = `${SIZE}px ${colours.font}`;
      let all = true;
      for (const { words, colour, width, alpha = 1, dash = [], ink = "soft" } of entries) {
        const next = x + 26 + g.measureText(words).width;
        all = next <= end + 1 && pen.text(words, x + 26, y, { colour: ink });
        if (!all) break;
        pen.stroke(colour, width, dash);
        g.globalAlpha = alpha;
        pen.line(x, y - 4, x + 22, y - 4);
        g.globalAlpha = 1;
        pen.reserve(x, y - 9, x + 22, y + 1);
        x = next + 12;
      }
      g.restore();
      return all;
    },
    inside(x, y, width, height, draw) {
      g.save();
      g.beginPath();
      g.rect(x, y, width, height);
      g.clip();
      draw();
      g.restore();
    },
  };
  return pen;
}
