// Run by Node's test runner: undo and redo, and what happens when on the clock.

import assert from "node:assert/strict";
import { test } from "node:test";
import { makeHistory } from "../page/history.js";
import { eventAt, eventBeside, eventsOf, paceOf, slowing } from "../page/pace.js";
import { fractionAt, timeAt } from "../page/scene.js";

function makeWorld() {
  const world = { state: { v: 1 }, told: 0 };
  world.history = makeHistory(
    () => ({ ...world.state }),
    (state) => (world.state = { ...state }),
    ({ v }) => String(v),
    () => world.told++,
  );
  return world;
}

test("undo goes back one thing after another, redo comes again", () => {
  const world = makeWorld(),
    { history } = world;
  for (const v of [2, 2, 3]) {
    world.state.v = v;
    history.note();
  }
  assert.deepEqual([history.canUndo(), history.canRedo()], [true, false]);
  history.undo();
  assert.equal(world.state.v, 2);
  history.undo();
  history.undo();
  assert.equal(world.state.v, 1);
  history.redo();
  history.redo();
  history.redo();
  assert.equal(world.state.v, 3);
});

test("what was not noted yet is undone too, and something new has no redo", () => {
  const world = makeWorld(),
    { history } = world;
  world.state.v = 5;
  history.undo();
  assert.equal(world.state.v, 1);
  world.state.v = 7;
  history.note();
  assert.equal(history.canRedo(), false);
  history.redo();
  assert.equal(world.state.v, 7);
});

test("what is no change of the key is no entry, and comes back with one", () => {
  const world = makeWorld(),
    { history } = world;
  world.state.time = 0.5;
  history.note();
  assert.equal(history.canUndo(), false);
  world.state = { v: 2, time: 0.9 };
  history.note();
  history.undo();
  assert.deepEqual(world.state, { v: 1, time: 0.5 });
});

/** One crossing with a flight of the front wheel. */
const crossing = (v, events = []) => ({
  v,
  end: 1.25 / v,
  data: { hasBump: true, shape: { centre: 0.3 }, wheels: [-0.1, 0.1], pace: 8 },
  settings: { height: 0.02 },
  run: { verdict: { lost: null } },
  truth: { verdict: { wheel: 0, t: 0.4 / v } },
  flight: { events },
});

test("one goes from event to event, both ways, to the start and to the end", () => {
  const scene = crossing(1, [
    { wheel: 1, kind: "lift-off", t: 0.25 },
    { wheel: 1, kind: "landing", t: 0.3 },
  ]);
  const events = eventsOf(scene, "flying"),
    seen = [];
  for (let at = 0; ; at = seen.at(-1).at) {
    const next = eventBeside(events, at, 1);
    if (!next) break;
    seen.push(next);
  }
  assert.deepEqual(
    seen.map(({ words }) => words),
    [
      "front wheel on top of the bump",
      "front wheel leaves the ground",
      "front wheel lands",
      "rear wheel on top of the bump",
      "the end",
    ],
  );
  assert.equal(eventBeside(events, 0.21, -1).words, "front wheel leaves the ground");
  assert.equal(eventAt(events, seen[1].at).words, "front wheel leaves the ground");
  assert.equal(eventBeside(events, 0, -1), undefined);
});

test("the clock says how slow it goes, slower around a lift-off", () => {
  const scene = crossing(10, [{ wheel: 1, kind: "lift-off", t: 0.05 }]),
    events = eventsOf(scene, "flying");
  assert.equal(slowing(events, 0.4), 3);
  assert.ok(Math.abs(paceOf(scene, events, "fit", 0.1) - 64) < 1e-9); // 8 s for an eighth of a second
  assert.ok(Math.abs(paceOf(scene, events, "fit", 0.4) - 192) < 1e-9);
  assert.ok(Math.abs(paceOf(scene, events, "same", 0.1) - 8) < 1e-9);
  const slow = crossing(0.25);
  assert.ok(Math.abs(paceOf(slow, eventsOf(slow, "flying"), "same", 0.1) - 8) < 1e-9);
});

test("a race gives each robot its time, by one clock", () => {
  const lanes = [0.25, 1.25, 5, 10].map((v) => crossing(v)),
    scene = Object.assign(lanes[0], { lanes });
  assert.deepEqual(
    [0, 0.25, 0.5, 0.75, 1].map((fraction) => timeAt(scene, fraction)),
    [0, 0.125, 0.25, 1, 5],
  );
  for (const t of [0, 0.06, 0.125, 0.3, 4, 5])
    assert.ok(Math.abs(timeAt(scene, fractionAt(scene, t)) - t) < 1e-12);
  const events = eventsOf(scene, "flying"),
    paces = [0.1, 0.4, 0.6, 0.9].map((at) => paceOf(scene, events, undefined, at));
  assert.deepEqual(
    paces.map((pace) => pace.toPrecision(3)),
    ["24.0", "24.0", "4.00", "0.750"],
  );
});

test("a state can be where one begins", () => {
  const world = makeWorld(),
    { history } = world;
  for (const v of [2, 3]) {
    world.state.v = v;
    history.note();
  }
  history.undo();
  world.state.v = 7;
  history.restart();
  assert.deepEqual([history.canUndo(), history.canRedo()], [false, false]);
  history.undo();
  assert.equal(world.state.v, 7);
});

test("a robot of a race is named by its speed as one writes it", () => {
  const lanes = [0.25, 0.1 + 0.2].map((v) => crossing(v)),
    scene = Object.assign(lanes[0], { lanes }),
    names = new Set(eventsOf(scene, "flying").map(({ words }) => words.split(": ")[0]));
  assert.ok(names.has("0.3\u00a0m/s") && names.has("0.25\u00a0m/s"), [...names].join());
});
