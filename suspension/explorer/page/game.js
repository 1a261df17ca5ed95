// Keep it down: springs and dampers to choose, a drive at all asked speeds that one sees and hears, the
// verdict, the next try. The state is the road, what is chosen, the attempts and the uncovered maps.

import { button, make, write } from "./dom.js";
import { drawLanes, drawMap, lanesLabel, makeRegion, makeRegionPicture, mapFrame } from "./game_draw.js";
import { makeTrack } from "./game_run.js";
import {
  attemptRow,
  changeWords,
  isBest,
  KEY,
  laneRow,
  mapWords,
  RULES,
  scoreWords,
  roadName,
  roadWords,
  taskWords,
  times,
  verdict,
} from "./game_words.js";
import { begin, clamp, plain } from "./pen.js";
import { LEGEND, makeSound, SECONDS, score } from "./sound.js";
import { coloursOf, onTheme } from "./theme.js";
import { unit } from "./words.js";

const STOPS = 1000, // of a slider
  DIGITS = 4,
  NEAR = 24, // pixels from the ring on the map at which a finger takes hold of it
  PORTION = 6, // ms of a map between two frames
  STEP = 0.02, // of a logarithm, for an arrow key on the map
  MOST = 60; // attempts that are kept
const KNOBS = [
  ["k", "Stiffness k", "N/m"],
  ["c", "Damping c", "N\u00a0s/m"],
];

let count = 0; // of games, for names that elements refer to each other by

/** `address(attempt)`, where there is one: writes the address of an attempt, and tells it. */
export function renderGame(model, el, address) {
  const facts = model.get("facts"),
    { levels, asked, ranges, own } = facts,
    track = makeTrack(facts), // of the drive that is shown
    judge = makeTrack(facts), // of all others
    sound = makeSound(),
    id = `se-game-${count++}`,
    calm = matchMedia("(prefers-reduced-motion: reduce)");
  const known = new Map(), // verdicts on attempts
    regions = new Map(),
    picture = makeRegionPicture();
  let shown = null, // the drive in the lanes
    isDone = false, // and whether it is over
    playing = null, // { start, attempt }
    hold = null, // the ring is in hand
    [colours, scheduled, cost] = [null, 0, 0];

  // ---- the state

  const read = (name) => model.get(name);
  const level = () => (levels[read("level")] ? read("level") : 0);
  const chosen = () => ({ level: level(), k: inRange("k", read("k")), c: inRange("c", read("c")) });
  const inRange = (name, value) => clamp(Number(value) || own[name], ...ranges[name]);
  const isAttempt = (one) => Array.isArray(one) && levels[one[0]] && one[1] > 0 && one[2] > 0;
  const attempts = () => (read("attempts") ?? []).filter(isAttempt);
  const here = () => attempts().filter(([on]) => on === level());
  const isUncovered = () => (read("uncovered") ?? []).includes(level());
  const goal = () => levels[level()];
  function set(changes) {
    for (const [name, value] of Object.entries(changes)) model.set(name, value);
    model.save_changes();
  }
  /** The verdict on an attempt; it is not driven again. */
  function judged([on, k, c]) {
    const key = [on, k, c].join();
    if (!known.has(key)) {
      const { lanes, ...found } = judge.drive(on, k, c);
      known.set(key, {
        ...found,
        lanes: lanes.map(({ flight, ...words }) => words), // without its long arrays
      });
    }
    return known.get(key);
  }

  // ---- what it is made of

  const root = make(el, "div", "suspension-explorer se-match"),
    roads = make(root, "div", "se-tools", { role: "group", "aria-label": "Roads" }),
    roadButtons = levels.map((_, i) => {
      const made = button(roads, "");
      made.addEventListener("click", () => {
        finish();
        set({ level: i });
      });
      return made;
    }),
    task = make(root, "p", "se-task"),
    body = make(root, "div", "se-body"),
    left = make(body, "div", "se-side"),
    knobs = make(left, "div", "se-knobs"),
    far = make(left, "p", "se-far"),
    moves = make(left, "div", "se-tools", { role: "group", "aria-label": "Drive" }),
    drive = button(moves, "Drive", { class: "se-drive" }),
    reset = button(moves, "As it is"),
    stage = make(body, "div", "se-stage se-stage-lanes"),
    lanesCanvas = make(stage, "canvas", "", { role: "img" }),
    said = make(root, "p", "se-said", { role: "status" }),
    key = make(root, "p", "se-key"),
    ear = make(root, "div", "se-tools se-ear", { role: "group", "aria-label": "Sound" }),
    speaker = button(ear, "Sound", { "aria-pressed": "false" }),
    heardLabel = make(ear, "label", "", {}, "Hear "),
    heardChoice = make(heardLabel, "select"),
    legend = make(root, "p", "se-words se-legend", { hidden: "" }, LEGEND),
    caption = make(root, "p", "se-caption", { hidden: "" }),
    log = make(root, "details", "se-log", { hidden: "" }),
    lower = make(root, "div", "se-body se-lower"),
    plan = make(lower, "div", "se-plan"),
    planStage = make(plan, "div", "se-stage se-stage-map"),
    planCanvas = make(planStage, "canvas", "", { role: "img" }),
    pad = make(planStage, "div", "se-pad", {
      role: "application",
      tabindex: "0",
      "aria-label":
        "The map. The arrow keys left and right change the stiffness, up and down the damping, with Shift five times as much; Enter drives.",
    }),
    planTools = make(plan, "div", "se-tools"),
    uncover = button(planTools, "Uncover the map"),
    forget = button(planTools, "Forget these attempts"),
    share = address ? button(planTools, "Copy a link to this attempt") : null,
    planWords = make(plan, "p", "se-words"),
    tables = make(lower, "div", "se-texts"),
    rules = make(tables, "p", "se-words"),
    speedTable = table("At each speed", ["speed", "contact", "least force", "where", "in the air"]),
    trailTable = table("Your attempts", ["try", "k (N/m)", "c (N s/m)", "d", "what came of it"]);
  write(key, KEY);
  write(rules, RULES);
  make(log, "summary", "", {}, "What was heard");
  const logList = make(log, "ol");
  make(heardChoice, "option", "", { value: "" }, "the hardest speed");
  asked.forEach((v, i) => make(heardChoice, "option", "", { value: String(i) }, unit(v, "m/s")));
  if (!sound.isPossible) {
    speaker.disabled = true;
    speaker.title = "This browser makes no sound";
  }

  function table(caption, heads) {
    const made = make(tables, "table", "");
    make(made, "caption", "", {}, caption);
    const head = make(make(made, "thead", ""), "tr", "");
    for (const name of heads) make(head, "th", "", { scope: "col" }, name);
    return make(made, "tbody", "");
  }
  /** Rows of words, the first of each with a button if there is something to do with it. */
  function fill(body, rows, act) {
    body.parentNode.hidden = !rows.length;
    while (body.rows.length > rows.length) body.deleteRow(-1);
    rows.forEach((cells, i) => {
      const row = body.rows[i] ?? make(body, "tr", "");
      cells.forEach((words, j) => {
        const cell = row.cells[j] ?? make(row, j ? "td" : "th", "", j ? {} : { scope: "row" });
        if (j || !act) return write(cell, words);
        const made = cell.firstChild ?? button(cell, words);
        made.setAttribute("aria-label", `Take attempt ${words} again`);
        made.onclick = () => act(i);
      });
    });
  }

  const controls = KNOBS.map(([name, label, unitName]) => {
    const [low, high] = ranges[name],
      box = make(knobs, "div", "se-knob"),
      at = (place) => Number((low * (high / low) ** (place / STOPS)).toPrecision(DIGITS));
    make(box, "label", "", { for: `${id}-${name}` }, label);
    const number = make(make(box, "span", "se-number"), "input", "", {
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      "aria-label": `${label} (${unitName}), typed`,
      "aria-describedby": `${id}-${name}-error`,
    });
    number.after(` ${unitName}`);
    const range = make(box, "input", "", { type: "range", id: `${id}-${name}`, min: 0, max: STOPS, step: 1 }),
      error = make(box, "p", "se-error", { id: `${id}-${name}-error`, role: "alert" });
    range.addEventListener("input", () => choose({ [name]: clamp(at(range.value), low, high) }));
    const take = () => {
      const value = Number(number.value.trim().replace(",", ".")),
        isGood = number.value.trim() !== "" && value >= low && value <= high;
      if (isGood) number.removeAttribute("aria-invalid");
      else number.setAttribute("aria-invalid", "true");
      write(error, isGood ? "" : `A number from ${plain(low)} to ${plain(high)} is expected.`);
      if (isGood) choose({ [name]: value });
      return isGood;
    };
    number.addEventListener("change", take);
    number.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && take()) go();
    });
    return {
      show(value) {
        range.value = Math.round((STOPS * Math.log(value / low)) / Math.log(high / low));
        range.setAttribute("aria-valuetext", `${unit(value, unitName, DIGITS)}, ${times(value / own[name])}`);
        if (number !== document.activeElement || !number.hasAttribute("aria-invalid")) {
          number.value = plain(value, DIGITS);
          number.removeAttribute("aria-invalid");
          write(error, "");
        }
      },
    };
  });

  // ---- what one does

  /** Another suspension; a drive that goes on is over. */
  function choose(values) {
    const now = chosen();
    if (Object.entries(values).every(([name, value]) => now[name] === value)) return;
    finish();
    set(values);
  }
  /** Drive with what is chosen: seen and heard, then judged. */
  function go() {
    finish();
    const { level: on, k, c } = chosen();
    shown = track.drive(on, k, c);
    isDone = false;
    playing = { start: null, attempt: [on, k, c, isUncovered() ? "map" : ""] };
    tellSound(score(shown.lanes[heard()]));
    sound.start(written);
    if (calm.matches) finish(false);
    else schedule();
    update();
  }
  /** The drive is over: it is an attempt, unless it was one already. */
  function finish(silence = true) {
    if (silence) sound.stop();
    if (!playing) return;
    const { attempt } = playing;
    playing = null;
    isDone = true;
    tellCaption(1);
    record(attempt);
    const [on, k, c] = attempt;
    address?.({ level: on, k, c });
  }
  function record(attempt) {
    const [on, k, c, how] = attempt,
      isNew = !attempts().some((one) => one[0] === on && one[1] === k && one[2] === c),
      isSolved =
        how !== "link" && isBest(judged(attempt), levels[on]) && !(read("uncovered") ?? []).includes(on);
    set({
      ...(isNew ? { attempts: [...attempts(), attempt].slice(-MOST) } : {}),
      ...(isSolved ? { uncovered: [...(read("uncovered") ?? []), on] } : {}),
    });
    update();
  }
  /** Somebody's attempt: driven over already. */
  function open(attempt) {
    finish();
    set(attempt);
    const { level: on, k, c } = chosen();
    shown = track.drive(on, k, c);
    isDone = true;
    record([on, k, c, "link"]);
  }
  drive.addEventListener("click", () => (playing ? finish() : go()));
  reset.addEventListener("click", () => choose({ ...own }));
  uncover.addEventListener("click", () => {
    finish();
    set({ uncovered: [...(read("uncovered") ?? []), level()] });
  });
  forget.addEventListener("click", () => {
    finish();
    shown = null;
    set({ attempts: attempts().filter(([on]) => on !== level()) });
  });
  share?.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(address(chosen()));
      write(share, "Copied");
    } catch {
      write(share, "It is in the address line");
    }
    setTimeout(() => write(share, "Copy a link to this attempt"), 2000);
  });

  // ---- what one hears

  const heard = () => {
    const { value } = heardChoice;
    if (value !== "") return Number(value);
    const { lanes } = shown,
      bad = (lane) => (lane.state === "lost" ? -lane.air : lane.margin);
    return lanes.reduce((best, lane, i) => {
      const [a, b] = [lane, lanes[best]];
      if ((a.state === "lost") !== (b.state === "lost")) return a.state === "lost" ? i : best;
      return bad(a) < bad(b) ? i : best;
    }, 0);
  };
  let written = null;
  function tellSound(now) {
    written = now;
    logList.textContent = "";
    for (const { words } of now.captions) make(logList, "li", "", {}, words);
    write(caption, now.captions[0].words);
  }
  speaker.addEventListener("click", () => {
    sound.turn(!sound.isOn());
    for (const part of [legend, caption, log]) part.hidden = !sound.isOn();
    speaker.setAttribute("aria-pressed", String(sound.isOn()));
    if (sound.isOn()) hear();
  });
  /** The same drive again, seen and heard, if one was driven with what is chosen. */
  function hear() {
    if (!isShown()) return;
    finish();
    tellSound(score(shown.lanes[heard()]));
    sound.start(written);
    if (calm.matches) return;
    playing = { start: null, attempt: [shown.level, shown.k, shown.c, isUncovered() ? "map" : ""] };
    isDone = false;
    update();
  }
  heardChoice.addEventListener("change", () => sound.isOn() && hear());

  // ---- the map in hand

  const frame = () => mapFrame(...panels.plan.size, facts);
  const spot = ({ clientX, clientY }) => {
    const { left, top } = planCanvas.getBoundingClientRect();
    return [clientX - left, clientY - top];
  };
  const round = (value, name) => clamp(Number(value.toPrecision(DIGITS)), ...ranges[name]);
  const place = (event) => {
    const [x, y] = spot(event),
      { kAt, cAt } = frame();
    choose({ k: round(kAt(x), "k"), c: round(cAt(y), "c") });
  };
  const isNear = (event) => {
    const [x, y] = spot(event),
      { px, py } = frame(),
      { k, c } = chosen();
    return Math.hypot(px(k) - x, py(c) - y) < NEAR;
  };
  // A finger on the ring moves it; elsewhere it scrolls, or sets it by a tap.
  pad.addEventListener(
    "touchstart",
    (event) => {
      if (event.touches.length === 1 && isNear(event.touches[0])) event.preventDefault();
    },
    { passive: false },
  );
  pad.addEventListener("pointerdown", (event) => {
    if (event.button || hold || (event.pointerType === "touch" && !isNear(event))) return;
    hold = event.pointerId;
    pad.setPointerCapture(event.pointerId);
    pad.focus({ preventScroll: true });
    if (event.pointerType !== "touch") place(event);
  });
  pad.addEventListener("pointermove", (event) => hold === event.pointerId && place(event));
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"])
    pad.addEventListener(name, () => (hold = null));
  pad.addEventListener("click", (event) => event.detail && place(event));
  pad.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const way = { ArrowRight: ["k", 1], ArrowLeft: ["k", -1], ArrowUp: ["c", 1], ArrowDown: ["c", -1] }[
      event.key
    ];
    if (event.key === "Enter") go();
    else if (way) {
      const [name, sign] = way,
        value = chosen()[name] * Math.exp(sign * STEP * (event.shiftKey ? 5 : 1));
      choose({ [name]: round(value, name) });
    } else return;
    event.preventDefault();
  });

  // ---- what one sees

  const panels = {
    lanes: { canvas: lanesCanvas, size: [0, 0] },
    plan: { canvas: planCanvas, size: [0, 0] },
  };
  stage.style.setProperty("--se-lanes", asked.length);
  /** The lanes to draw: of the drive, or of robots that wait at the start. */
  let waiting = null;
  function lanes() {
    const now = chosen();
    if (shown && shown.level === now.level && shown.k === now.k && shown.c === now.c) return shown.lanes;
    const key = [now.level, now.k, now.c].join();
    if (waiting?.key !== key) waiting = { key, lanes: track.wait(now.level, now.k, now.c) };
    return waiting.lanes;
  }
  const isShown = () => shown !== null && lanes() === shown.lanes;

  function schedule() {
    scheduled ||= requestAnimationFrame(paint);
  }
  function paint(now) {
    const begun = performance.now();
    scheduled = 0;
    if (!root.isConnected) return;
    colours ??= coloursOf(root);
    const part = partAt(now);
    if (playing && part >= 1) finish(false);
    const [w, h] = panels.lanes.size;
    if (w && h)
      drawLanes(begin(lanesCanvas, w, h, colours), {
        lanes: lanes(),
        part: isShown() ? part : 0,
        isSeen: isSeen(),
        heard: sound.isOn() && isShown() ? heard() : -1,
        isDone: isShown() && isDone,
      });
    const region = isUncovered() ? regionOf(level()) : null;
    if (!playing) paintMap(region);
    const isGrowing = region?.work(playing ? PORTION / 3 : PORTION);
    if (playing) tellCaption(part);
    if (playing || isGrowing) schedule();
    root.dispatchEvent(
      new CustomEvent("painted", { bubbles: true, detail: cost + performance.now() - begun }),
    );
    cost = 0;
  }
  function paintMap(region) {
    const [w, h] = panels.plan.size;
    if (!w || !h) return;
    drawMap(begin(planCanvas, w, h, colours), facts, {
      goal: goal(),
      attempts: here().map(judged),
      chosen: chosen(),
      region,
      picture,
    });
  }
  function partAt(now) {
    if (!playing) return 1;
    playing.start ??= now;
    return clamp((now - playing.start) / 1000 / SECONDS, 0, 1);
  }
  const isSeen = () => level() === 0 || here().length > 0;
  function tellCaption(part) {
    const last = written.captions.findLast(({ at }) => at <= part * SECONDS);
    if (last) write(caption, last.words);
  }
  function regionOf(on) {
    if (!regions.has(on)) regions.set(on, makeRegion(on, facts, judge.sketch));
    return regions.get(on);
  }

  function update() {
    const begun = performance.now(),
      { level: on, k, c } = chosen(),
      rows = here().map(judged),
      current = isShown() && isDone ? judged([on, k, c]) : null;
    roadButtons.forEach((made, i) => {
      const mine = attempts().filter((one) => one[0] === i && one[3] !== "link");
      write(made, `${roadName(i)}${scoreWords(mine.map(judged), levels[i])}`);
      made.setAttribute("aria-pressed", String(i === on));
    });
    write(task, `${on ? `${roadWords(goal(), isSeen(), isUncovered())} ` : ""}${taskWords(goal(), asked)}`);
    controls.forEach((control, i) => control.show([k, c][i]));
    write(far, changeWords(facts, k, c));
    const told = current && verdict(current, goal());
    root.dataset.tone = told?.tone ?? "open";
    write(said, playing ? "Driving …" : (told?.words ?? "Choose stiffness and damping, then drive."));
    write(drive, playing ? "Skip to the end" : current ? "Drive again" : "Drive");
    drive.classList.toggle("se-again", Boolean(current));
    reset.disabled = k === own.k && c === own.c;
    uncover.disabled = isUncovered();
    uncover.title = isUncovered() ? "It is uncovered" : "";
    forget.disabled = !rows.length;
    if (share) share.disabled = !current;
    fill(speedTable, current ? current.lanes.map(laneRow) : []);
    fill(
      trailTable,
      here().map((one, i) => [String(i + 1), ...attemptRow(rows[i], goal(), one[3] ?? "")]),
      (i) => {
        const [, k2, c2] = here()[i];
        choose({ k: k2, c: c2 });
        shown = track.drive(level(), k2, c2);
        isDone = true;
        update();
      },
    );
    write(planWords, mapWords(goal(), isUncovered(), rows.length));
    lanesCanvas.setAttribute("aria-label", lanesLabel(lanes(), Boolean(current)));
    planCanvas.setAttribute(
      "aria-label",
      `Map of stiffness and damping. ${mapWords(goal(), isUncovered(), rows.length)}`,
    );
    cost += performance.now() - begun;
    schedule();
  }

  const sizes = new ResizeObserver((entries) => {
    for (const { target, contentRect } of entries) {
      const panel = Object.values(panels).find(({ canvas }) => canvas === target);
      panel.size = [contentRect.width, contentRect.height].map(Math.round);
    }
    schedule();
  });
  for (const { canvas } of Object.values(panels)) sizes.observe(canvas);
  const leaveTheme = onTheme(() => {
    colours = null;
    paint(performance.now()); // at once, or paper would get the dark picture
  });
  // Out of sight, nothing sounds.
  const sight = new IntersectionObserver((entries) => {
    if (!entries.at(-1).isIntersecting) sound.stop();
  });
  sight.observe(root);
  root.score = () => written; // for those who compare
  const watched = ["level", "k", "c", "attempts", "uncovered"].map((name) => `change:${name}`);
  for (const name of watched) model.on(name, update);
  update();
  return {
    show: open,
    destroy() {
      for (const name of watched) model.off(name, update);
      sound.destroy();
      sizes.disconnect();
      sight.disconnect();
      leaveTheme();
      cancelAnimationFrame(scheduled);
      root.remove();
    },
  };
}
