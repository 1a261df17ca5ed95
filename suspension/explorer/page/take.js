// What one can take away: the pictures, the numbers, and the settings as lines of Python.

import { button, write } from "./dom.js";

const COPY = "Copy the Python lines";

/** A button that copies lines, or at least selects them; what comes back makes it offer that again. */
export function addCopy(parent, code) {
  const copy = button(parent, COPY);
  copy.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(code.textContent);
      write(copy, "Copied");
    } catch {
      getSelection().selectAllChildren(code);
      write(copy, "Selected: copy it with your keys");
    }
  });
  return () => write(copy, COPY);
}

function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** All panels with the words above them, as one PNG. */
export function savePicture(canvases, words, colours) {
  const ratio = window.devicePixelRatio || 1,
    edge = 16 * ratio,
    line = 20 * ratio;
  const boxes = canvases.map((canvas) => canvas.getBoundingClientRect());
  const left = Math.min(...boxes.map((box) => box.left)),
    top = Math.min(...boxes.map((box) => box.top));
  const width = Math.max(...boxes.map((box) => box.right)) - left,
    height = Math.max(...boxes.map((box) => box.bottom)) - top;
  const picture = document.createElement("canvas"),
    g = picture.getContext("2d");
  picture.width = width * ratio + 2 * edge;
  g.font = `${13 * ratio}px ${colours.font}`;
  const lines = wrap(words, (text) => g.measureText(text).width, width * ratio);
  picture.height = height * ratio + 2 * edge + (lines.length + 1) * line;
  g.fillStyle = colours.paper;
  g.fillRect(0, 0, picture.width, picture.height);
  g.fillStyle = colours.ink;
  g.font = `${13 * ratio}px ${colours.font}`;
  lines.forEach((text, i) => g.fillText(text, edge, edge + (i + 0.7) * line));
  const below = edge + (lines.length + 0.5) * line;
  canvases.forEach((canvas, i) => {
    if (canvas.width)
      g.drawImage(canvas, edge + (boxes[i].left - left) * ratio, below + (boxes[i].top - top) * ratio);
  });
  picture.toBlob((blob) => save("suspension.png", blob));
}

function wrap(text, measure, width) {
  const lines = [""];
  for (const word of text.split(" ")) {
    const longer = `${lines.at(-1)} ${word}`.trim();
    if (measure(longer) > width) lines.push(word);
    else lines[lines.length - 1] = longer;
  }
  return lines;
}

/** The run that is drawn in front, one line for each sample. */
export function tableOf({ run, flight, v }, motion) {
  const { W, N, J, dt } = motion === "flying" ? flight : run;
  const lines = ["t (s),X (m),Y (m),Y' (m/s),theta (rad),theta' (rad/s),N1 (N),N2 (N)"];
  for (let n = 0; n <= J; n++) {
    lines.push([n * dt, v * n * dt, ...W.map((w) => w[n]), ...N.map((N) => N[n])].join(","));
  }
  return `${lines.join("\n")}\n`;
}

export const saveTable = (scene, motion) =>
  save("suspension.csv", new Blob([tableOf(scene, motion)], { type: "text/csv" }));

/** The settings as Python: the lines that it handed over, with their gaps filled. */
export function pythonOf({ python }, settings, schemeIndex, motion) {
  const values = { v: settings.v, dt: settings.dt, scheme: python.schemes[schemeIndex] };
  for (const [name, [slider, ratio]] of Object.entries(python.gaps)) values[name] = settings[slider] * ratio;
  const text = motion === "flying" ? `${python.text}\n${python.flight}` : python.text;
  return text.replace(/\{(\w+)\}/g, (_gap, name) => String(values[name]));
}
