// Run by Node's test runner: what a game says, case by case, and the address of an attempt.

import assert from "node:assert/strict";
import { test } from "node:test";
import { readLink, writeLink } from "../page/game_link.js";
import { firstZero, leastOf } from "../page/game_run.js";
import {
  attemptRow,
  changeWords,
  isBest,
  laneRow,
  laneWords,
  mapWords,
  outcome,
  roadName,
  roadWords,
  scoreWords,
  taskWords,
  verdict,
} from "../page/game_words.js";

const plain = (words) => words.replaceAll("\u00a0", " ");
const ASKED = [0.25, 1.2, 5];
const GOAL = { kind: "contact", reserve: 0, distance: 1.05, air: 0, best: { k: 277.139, c: 1.5731 } };
const kept = (v, margin = 2) => ({ v, end: 1, state: "kept", margin, wheel: 0, X: 0.3, lost: null, air: 0 });
const short = (v) => ({ ...kept(v, 0.4), state: "short" });
const lost = (v, air = 0.04) => ({
  ...{ v, end: 1, state: "lost", margin: -9, wheel: 0, X: 0.5, air },
  lost: { wheel: 1, t: 0.2, X: 0.21 },
});
const drive = (lanes, distance, isReached, air = 0) => ({ k: 300, c: 1.5, lanes, distance, isReached, air });
const all = ASKED.map((v) => kept(v));

test("a task says what is asked for and what is to be beaten", () => {
  const told = (goal) => plain(taskWords({ ...GOAL, ...goal }, ASKED));
  assert.match(told({}), /^Keep both .* at 0\.25, 1\.2 and 5 m\/s, and change .*To beat: d = 1\.05\.$/);
  assert.match(told({ distance: 0 }), /as it is: nothing has to be changed\.$/);
  assert.match(
    told({ kind: "reserve", reserve: 0.7142 }),
    /more is asked: at least 0\.714 N .* To beat: d = 1\.05\.$/,
  );
  assert.match(told({ kind: "reserve", reserve: 0.7142, distance: 0 }), /nothing has to be changed\.$/);
  assert.match(told({ kind: "air", air: 0.0432 }), /^No suspension .* To beat: 4\.32 % of the way\.$/);
  assert.match(plain(taskWords(GOAL, [5])), /on the ground at 5 m\/s, and/);
});

test("a road is told no sooner than it is known", () => {
  const dip = { bump: { height: -0.0123, sigma: 0.0235 } },
    bump = { bump: { height: 0.0254, sigma: 0.0288 } };
  assert.match(roadWords(dip, false, true), /^An unknown road/);
  assert.equal(roadWords(dip, true, false), "A dip.");
  assert.equal(plain(roadWords(dip, true, true)), "A dip, 12.3 mm deep, with σ = 23.5 mm.");
  assert.equal(plain(roadWords(bump, true, true)), "A bump, 25.4 mm high, with σ = 28.8 mm.");
  assert.deepEqual([0, 1, 3].map(roadName), ["The bump", "Road A", "Road C"]);
});

test("a lane says how it went, and no force after a loss", () => {
  assert.equal(plain(laneWords(kept(1, 2.3456))), "kept, 2.35 N to spare");
  assert.equal(plain(laneWords(kept(1, -3e-8))), "kept, 0 N to spare");
  assert.equal(plain(laneWords(short(1))), "kept, but only 0.4 N left (rear)");
  assert.equal(plain(laneWords(lost(1))), "lost: front, 40 ms in the air");
  assert.equal(laneWords(lost(1, 0)), "lost: front, for an instant");
  assert.deepEqual(laneRow(lost(1)).map(plain), ["1 m/s", "lost", "–", "front, X = 0.21 m", "4 %"]);
  assert.deepEqual(laneRow(kept(1)).map(plain), ["1 m/s", "kept", "2 N", "rear, X = 0.3 m", "0"]);
  assert.equal(laneRow(short(1))[1], "too little left");
});

test("what is chosen is told by how far it is from what is there", () => {
  const facts = { own: { k: 800, c: 1.5 } };
  assert.equal(plain(changeWords(facts, 800, 1.5)), "d = 0: the suspension as it is.");
  assert.equal(plain(changeWords(facts, 400, 1.5)), "d = 0.693: k 0.5 times as it is, c as it is.");
  assert.equal(plain(changeWords(facts, 400, 3)), "d = 0.98: k 0.5 times as it is, c 2 times as it is.");
});

test("a verdict has a branch for every way an attempt can go", () => {
  const told = (...args) => {
    const { tone, words } = verdict(drive(...args), GOAL);
    return `${tone}: ${plain(words)}`;
  };
  const one = [kept(0.25), lost(1.2), lost(5)];
  assert.equal(told(one, 1.2, false), "lost: Contact is lost at 1.2 and 5 m/s. With d = 1.2.");
  assert.match(told(one, 0.7, false), /With d = 0\.7\. So near to what it was, nothing does it\.$/);
  assert.match(
    told([short(0.25), kept(1.2), lost(5)], 2, false),
    /^lost: Contact is lost at 5 m\/s and too little is left at 0\.25 m\/s\./,
  );
  assert.match(
    told([short(0.25), kept(1.2), kept(5)], 2, false),
    /^lost: Too little is left at 0\.25 m\/s\./,
  );
  assert.equal(
    told(all, 1.3, true),
    "kept: Contact kept at every speed, with d = 1.3. It can be done with 1.05.",
  );
  assert.match(told(all, 1.055, true), /^kept: .* Solved: to a hundredth, nothing nearer does it\.$/);
  assert.match(told(all, 1.02, true), /nearer than the answer to beat, 1\.05\.$/);
  assert.equal(told(all, 0, true), "kept: Contact kept at every speed, and nothing is changed.");
  const reserve = verdict(drive(all, 1.3, true), { ...GOAL, kind: "reserve", reserve: 0.7 });
  assert.match(reserve.words, /^Contact with enough to spare at every speed, with/);
});

test("where nothing keeps contact the part in the air is judged", () => {
  const goal = { ...GOAL, kind: "air", air: 0.05 },
    lanes = [lost(5, 0.06)];
  const told = (air, isReached) => plain(verdict(drive(lanes, 0.7, isReached, air), goal).words);
  assert.match(told(0.06, false), /^In the air for 6 % .* The best of the map has 5 %\.$/);
  assert.match(told(0.05, true), /That is the best of the map\.$/);
  assert.match(told(0.04, true), /That is less than the best of the map had\.$/);
  assert.equal(plain(outcome(drive(lanes, 0.7, false, 0.06), goal)), "6 % in the air");
  assert.equal(isBest(drive(lanes, 0.7, true, 0.05), goal), true);
});

test("a road's button shows the best of what was done there", () => {
  const attempts = [drive(all, 1.3, true), drive(all, 1.1, true), drive([lost(5)], 0.2, false)];
  assert.equal(plain(scoreWords(attempts, GOAL)), " ✓ 1.1");
  assert.equal(scoreWords(attempts.slice(2), GOAL), "");
  assert.equal(plain(scoreWords([drive([lost(5)], 2, true, 0.03)], { kind: "air" })), " ✓ 3 %");
});

test("an attempt is told in a row, with how it came about", () => {
  const row = (lanes, distance, isReached, how) =>
    attemptRow(drive(lanes, distance, isReached), GOAL, how).map(plain);
  assert.deepEqual(row(all, 1.3, true, ""), ["300", "1.5", "1.3", "kept"]);
  assert.equal(row(all, 1.051, true, "map")[3], "kept, solved (with the map)");
  assert.equal(row([kept(1), lost(5)], 1, false, "link")[3], "lost at 5 m/s (from the link)");
  assert.equal(row([short(1), kept(5)], 1, false, "")[3], "too little left at 1 m/s");
});

test("the map says what it shows, and the answer only when it is uncovered", () => {
  assert.match(mapWords(GOAL, false, 0), /^No attempt yet\. .* covered\.$/);
  assert.match(mapWords(GOAL, false, 1), /^Your attempt: filled/);
  assert.ok(!mapWords(GOAL, false, 3).includes("277"));
  assert.match(
    plain(mapWords(GOAL, true, 3)),
    /^Your 3 attempts: .* 277\.1 N\/m and 1\.573 N s\/m, the diamond\.$/,
  );
  assert.match(mapWords({ ...GOAL, kind: "air" }, true, 3), /Nowhere on this map/);
});

test("an address tells an attempt, and only one that can be made", () => {
  const facts = { levels: [1, 2], ranges: { k: [100, 3200], c: [0.3, 15] } },
    attempt = { level: 1, k: 277.1, c: 1.573 };
  assert.equal(writeLink(attempt), "#game:road=1&k=277.1&c=1.573");
  assert.deepEqual(readLink(writeLink(attempt), facts), attempt);
  for (const wrong of [
    "",
    "#game:",
    "#game:road=2&k=300&c=1",
    "#game:road=0&k=99&c=1",
    "#game:road=0&k=x&c=1",
  ])
    assert.equal(readLink(wrong, facts), null);
  for (const wrong of ["#game:road=-1&k=300&c=1", "#game:road=0.5&k=300&c=1", "#game:road=0&k=300&c=16"])
    assert.equal(readLink(wrong, facts), null);
  assert.equal(readLink("#workshop:road=0&k=300&c=1", facts), null);
});

test("the least value and the first zero of a curve lie between its samples", () => {
  const J = 200,
    at = (f) => Float64Array.from({ length: J + 1 }, (_, n) => f(n / 20));
  const [place, value] = leastOf(
    at((t) => 2 + Math.cos(t)),
    J,
  );
  assert.ok(Math.abs(place / 20 - Math.PI) < 1e-7 || Math.abs(place / 20 - 3 * Math.PI) < 1e-7);
  assert.ok(Math.abs(value - 1) < 1e-12);
  assert.ok(Math.abs(firstZero(at(Math.cos), J) / 20 - Math.PI / 2) < 1e-12);
  const dip = at((t) => (t - 3.0125) ** 2 - 1e-5); // below zero between two samples alone
  assert.ok(dip.every((x) => x > 0));
  assert.ok(Math.abs(firstZero(dip, J) / 20 - (3.0125 - Math.sqrt(1e-5))) < 1e-10);
  assert.equal(
    firstZero(
      at((t) => 1 + t),
      J,
    ),
    null,
  );
  assert.equal(
    firstZero(
      at((t) => t - 1),
      J,
    ),
    0,
  );
  assert.deepEqual(
    leastOf(
      at((t) => -t),
      J,
    ),
    [J, -10],
  );
});
