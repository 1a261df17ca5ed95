// Reads given.json, an explorer's facts and tables and many settings, each of all that can be set.
// Tells what words, pictures, clock and link say: of a view that goes from one to the next, and of
// one that is opened at the link.

import { readFileSync } from "node:fs";
import { readModel } from "../page/model.js";
import { eventsOf } from "../page/pace.js";
import { PANELS } from "../page/panels.js";
import { begin } from "../page/pen.js";
import { makeShown } from "../page/shown.js";
import { changesOf, guarded, readHash, settingsOf, writeHash } from "../page/state.js";
import { describe, describeMoment, keyOf } from "../page/words.js";

const { facts, tables, settings } = JSON.parse(readFileSync("given.json"));
const { buffer, byteOffset, length } = Buffer.from(tables.road, "base64");
const data = readModel(facts, { road: new DataView(buffer, byteOffset, length) });
globalThis.window = {};
globalThis.Path2D = class {
  constructor(other) {
    this.points = [...(other?.points ?? [])];
  }
  moveTo(...to) {
    this.points.push(to);
  }
  lineTo(...to) {
    this.points.push(to);
  }
  arc(...of) {
    this.points.push(of);
  }
  closePath() {}
};

/** A canvas that keeps what is drawn on it. */
function makeCanvas() {
  const drawn = [],
    texts = [];
  const g = new Proxy(
    {},
    {
      get(kept, name) {
        if (name === "measureText") return (text) => ({ width: 6.5 * text.length });
        if (name === "getTransform") return () => ({ a: 1, b: 0, c: 0, d: 1, e: 0, f: 0 });
        if (name in kept) return kept[name];
        return (...given) => {
          if (name === "fillText") texts.push(given[0]);
          drawn.push([name, ...given.map((value) => value?.points ?? value)]);
        };
      },
      set(kept, name, value) {
        kept[name] = value;
        drawn.push([name, value]);
        return true;
      },
    },
  );
  return { drawn, texts, getContext: () => g, width: 0, height: 0 };
}

const COLOURS = { font: "sans-serif" };
const start = { facts, tables: {}, view: "forces", pace: "fit", mapped: false, pin: {}, time: 0.1 };
const beginning = { ...start, ...settings[0], pin: {} };
const makeModel = (values) => ({
  values,
  get: (name) => values[name],
  set: (name, value) => (values[name] = value),
});
const initial = settingsOf(makeModel(beginning));

function tell(model, shown) {
  const scene = shown.scene(),
    options = shown.options(),
    { now, motion, pinned, map } = options;
  while (map?.work());
  const pictures = {};
  for (const name of facts.panels) {
    const canvas = makeCanvas(),
      panel = { ...PANELS[name] };
    const pen = begin(canvas, 420, 260, COLOURS, 1);
    panel.still?.(pen, scene, options);
    panel.live?.(pen, scene, options);
    pictures[name] = canvas;
  }
  const state = settingsOf(model);
  return {
    state,
    words: describe(scene, motion, now),
    key: keyOf(scene, motion, pinned),
    pinned: pinned?.words,
    texts: Object.fromEntries(Object.entries(pictures).map(([name, { texts }]) => [name, texts])),
    drawn: JSON.stringify(Object.values(pictures).map(({ drawn }) => drawn)),
    clock: describeMoment(now, motion),
    link: writeHash(state, initial),
    events: eventsOf(scene, motion).map(({ at }) => at),
    moment: { t: now.t, N: now[motion].N, v: scene.v },
  };
}

const walker = guarded(makeModel({ ...beginning })),
  walked = makeShown(data, walker);
for (const { asked, ...s } of settings) {
  for (const [name, value] of Object.entries(s)) walker.set(name, value);
  walked.forget();
  const { drawn, ...found } = tell(walker, walked);
  const opened = guarded(makeModel({ ...beginning })),
    view = makeShown(data, opened);
  const [, read] = readHash(found.link),
    { time, pin, ...others } = { ...initial, ...read };
  const changes = changesOf({ ...others, pin: pin && { ...initial, ...pin } }, data);
  for (const [name, value] of Object.entries({ ...changes, time })) opened.set(name, value);
  const { drawn: again, ...other } = tell(opened, view);
  const parts = Object.keys(found).filter(
    (name) => JSON.stringify(found[name]) !== JSON.stringify(other[name]),
  );
  console.log(JSON.stringify({ ...found, differs: drawn === again ? parts : [...parts, "drawn"] }));
}
