// The workshop of schemes: a Butcher tableau to type into, and with every key all that follows from it.
// The state is what is typed: texts; while some of them are no numbers, the last good table is shown.

import { button, make, write } from "./dom.js";
import { begin, clamp, enlargement, plain, ratioOf, show } from "./pen.js";
import {
  bend,
  CONDITIONS,
  coefficientAt,
  coefficientsOf,
  isPolynomial,
  readEntry,
  rowSums,
  writeEntry,
} from "./tableau.js";
import { coloursOf, onTheme } from "./theme.js";
import { isPull, tameSliders } from "./touch.js";
import { drawAxis, drawForces, drawRegion, drawWork, IN, slackAt } from "./workshop_draw.js";
import { makeBench } from "./workshop_run.js";
import {
  bentWords,
  examine,
  headline,
  limitWords,
  moved,
  ms,
  orderWords,
  polynomial,
  power,
  puzzles,
  raceWords,
  stabilityWords,
  swingWords,
  workWords,
  wrongEntry,
} from "./workshop_words.js";

const MOST_STAGES = 6,
  STOPS = 1000, // of a slider
  FINE = 100, // stops of a coefficient's slider for each of the exponential's
  NEAR = { mouse: 10, touch: 24 }, // pixels from the border at which one takes hold of it
  HANDLES = [
    [-1, 0],
    [-0.5, Math.sqrt(0.75)],
    [-0.5, -Math.sqrt(0.75)],
  ],
  BACK = 200; // tables that Undo knows
const SVG = "http://www.w3.org/2000/svg";

const factorial = (j) => (j > 1 ? j * factorial(j - 1) : 1);

let count = 0; // of workshops, for names that elements refer to each other by

/** A tree as a little picture: the root below, branches upward. */
function drawTree(parent, tree) {
  const unit = 9,
    dots = [],
    lines = [];
  let column = 0;
  const place = (tree, level) => {
    const above = tree.map((branch) => place(branch, level + 1)),
      x = above.length ? (above[0][0] + above.at(-1)[0]) / 2 : column++,
      here = [x, level];
    for (const [u, l] of above) lines.push([x, level, u, l]);
    dots.push(here);
    return here;
  };
  place(tree, 0);
  const height = Math.max(...dots.map(([, level]) => level)),
    add = (name, attributes) => {
      const element = document.createElementNS(SVG, name);
      for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
      return element;
    },
    at = (x, level) => [5 + unit * x, 5 + unit * (height - level)];
  const [w, h] = [10 + unit * (column - 1), 10 + unit * height],
    svg = add("svg", { viewBox: `0 0 ${w} ${h}`, width: w, height: h, "aria-hidden": "true" });
  for (const [x, l, u, m] of lines) {
    const [[x1, y1], [x2, y2]] = [at(x, l), at(u, m)];
    svg.append(add("line", { x1, y1, x2, y2, stroke: "currentColor", "stroke-width": 1.5 }));
  }
  for (const [x, l] of dots) {
    const [cx, cy] = at(x, l);
    svg.append(add("circle", { cx, cy, r: 2.8, fill: "currentColor" }));
  }
  parent.append(svg);
}

export function renderWorkshop(model, el) {
  const facts = model.get("facts"),
    { ranges, robot } = facts,
    bench = makeBench(facts),
    load = Math.max(...robot.weight.map(Math.abs)),
    known = facts.schemes.map((scheme) => ({ ...scheme, values: valuesOf(typed(scheme)) })),
    id = `se-workshop-${count++}`;
  const start = known.find(({ name }) => name === "RK4") ?? known[0];

  function typed({ a, b }) {
    return { a, b, c: b.map(() => ""), follows: true };
  }

  /** The numbers of a table of texts, and by name those texts that are none. */
  function valuesOf(tableau) {
    const wrong = new Map();
    const read = (name, text) => {
      const value = readEntry(text);
      if (value === null) wrong.set(name, text);
      return value;
    };
    const a = tableau.a.map((row, i) => row.map((text, j) => read(`a${i + 1}${j + 1}`, text))),
      b = tableau.b.map((text, j) => read(`b${j + 1}`, text)),
      c = tableau.follows ? rowSums(a) : tableau.c.map((text, i) => read(`c${i + 1}`, text));
    return { a, b, c, wrong };
  }

  /** What is typed, if it is a table at all. */
  function current() {
    const { a, b, c, follows } = model.get("tableau") ?? {},
      isRow = (row) =>
        Array.isArray(row) && row.length === b.length && row.every((x) => typeof x === "string");
    if (!Array.isArray(b) || !b.length || b.length > MOST_STAGES) return typed(start);
    if (![b, c, ...(a ?? [])].every(isRow) || a?.length !== b.length) return typed(start);
    return { a, b, c, follows: follows !== false };
  }
  const setting = (name) => clamp(Number(model.get(name)) || ranges[name][0], ...ranges[name]);
  const nameOf = (numbers) =>
    known.find(({ values }) =>
      ["a", "b", "c"].every((part) => {
        const [x, y] = [values[part].flat(), numbers[part].flat()];
        return x.length === y.length && x.every((value, i) => Math.abs(value - y[i]) < 1e-12);
      }),
    )?.name ?? "Your method";

  const root = make(el, "div", "suspension-explorer se-bench"),
    said = make(root, "p", "se-said", { role: "status" });
  const body = make(root, "div", "se-body"),
    sheet = make(body, "div", "se-sheet"),
    views = make(body, "div", "se-views");

  // ---- the table

  const past = [];
  let touched = ""; // what was changed last: one step back undoes all of it
  let origin = null; // the table whose R one bends
  function set(tableau, by) {
    if (!by.startsWith("R")) origin = null;
    if (by !== touched || by === "") past.push(current());
    if (past.length > BACK) past.shift();
    touched = by;
    model.set("tableau", tableau);
    model.save_changes();
  }

  const tools = make(sheet, "div", "se-tools", { role: "group", "aria-label": "Table" }),
    choice = make(make(tools, "label", "", {}, "Start from "), "select");
  make(choice, "option", "", { value: "" }, "…");
  known.forEach(({ name }, i) => make(choice, "option", "", { value: i }, name));
  choice.addEventListener("change", () => {
    if (choice.value !== "") set(typed(known[choice.value]), "");
  });
  const stages = make(make(tools, "label", "", {}, "Stages "), "select");
  for (let s = 1; s <= MOST_STAGES; s++) make(stages, "option", "", { value: s }, String(s));
  stages.addEventListener("change", () => {
    const { a, b, c, follows } = current(),
      s = Number(stages.value),
      fit = (row) => Array.from({ length: s }, (_, i) => row[i] ?? "0");
    set({ a: fit(a).map((row) => fit(row === "0" ? [] : row)), b: fit(b), c: fit(c), follows }, "");
  });
  const undo = button(tools, "Undo");
  undo.addEventListener("click", () => {
    touched = "";
    model.set("tableau", past.pop());
    model.save_changes();
  });

  const scroll = make(sheet, "div", "se-table"),
    table = make(scroll, "table", "", { "aria-label": "Butcher tableau" }),
    inputs = new Map(), // by name, in the order of the table
    errors = make(sheet, "p", "se-error", { id: `${id}-error`, role: "alert" });
  let chosen = "b1"; // the entry that the slider turns

  function build(s) {
    table.textContent = "";
    inputs.clear();
    const cell = (row, name) => {
      const input = make(make(row, "td"), "input", "", {
        "aria-label": name,
        inputmode: "text",
        autocomplete: "off",
        autocapitalize: "off",
        spellcheck: "false",
        placeholder: "0",
      });
      input.addEventListener("input", () => change(name, input.value));
      input.addEventListener("focus", () => choose(name));
      inputs.set(name, input);
    };
    for (let i = 1; i <= s; i++) {
      const row = make(table, "tr");
      cell(row, `c${i}`);
      for (let j = 1; j <= s; j++) cell(row, `a${i}${j}`);
    }
    const last = make(table, "tr", "se-weights");
    make(last, "td");
    for (let j = 1; j <= s; j++) cell(last, `b${j}`);
    if (!inputs.has(chosen)) chosen = "b1";
  }

  /** The table with another text in one place; who types an abscissa has it follow a no longer. */
  function change(name, text, by = name) {
    const { a, b, c, follows } = current(),
      [i, j] = [Number(name[1]) - 1, Number(name[2]) - 1],
      swap = (row, at) => row.map((kept, n) => (n === at ? text : kept));
    if (name[0] === "a") set({ a: a.map((row, n) => (n === i ? swap(row, j) : row)), b, c, follows }, by);
    else if (name[0] === "b") set({ a, b: swap(b, i), c, follows }, by);
    else set({ a, b, c: swap(follows ? sumsAsText() : c, i), follows: false }, by);
  }
  const sumsAsText = () => good.numbers.c.map((sum) => writeEntry(sum));

  const turn = make(sheet, "div", "se-turn"),
    turnName = make(turn, "label", "", { for: `${id}-turn` }),
    slider = make(turn, "input", "", { type: "range", id: `${id}-turn`, min: -1, max: 1, step: 0.005 }),
    follow = button(make(sheet, "div", "se-tools"), "c = row sums of a", { "aria-pressed": "true" });
  let middle = null; // of the slider; while one drags it stays where it is
  function choose(name) {
    if (name !== chosen) middle = null;
    chosen = name;
    update();
  }
  slider.addEventListener("input", () =>
    change(chosen, plain(middle + Number(slider.value), 4), `turn ${chosen}`),
  );
  slider.addEventListener("change", () => {
    middle = null;
    touched = "";
    update();
  });
  follow.addEventListener("click", () => {
    const { a, b, c, follows } = current();
    set({ a, b, c: follows ? sumsAsText() : c, follows: !follows }, "");
  });

  // ---- R that one bends: another coefficient by other weights

  const bow = make(sheet, "section", "se-bend", { "aria-labelledby": `${id}-bend` });
  make(bow, "p", "se-title", { id: `${id}-bend` }, "Bend R(z)");
  const bows = make(bow, "div", "se-bows"),
    bent = make(bow, "p", "se-words"),
    back = button(make(bow, "div", "se-tools"), "Back");
  const levers = []; // one for each coefficient that weights can change
  let pulled = 3; // the one that the border changes

  function addLever() {
    const j = levers.length + 1,
      box = make(bows, "div", "se-knob");
    make(box, "label", "", { for: `${id}-R${j}` }, `at ${power(j)}`);
    const output = make(box, "output", "", { for: `${id}-R${j}` }),
      range = make(box, "input", "", {
        ...{ type: "range", id: `${id}-R${j}`, min: -FINE, max: 3 * FINE, step: 1 },
      });
    const pick = () => {
      if (pulled === j) return;
      pulled = j;
      update();
    };
    range.addEventListener("focus", pick);
    range.addEventListener("input", () => {
      pulled = j;
      bendTo(j, Number(range.value) / FINE / factorial(j));
    });
    // One pull, or what one does by keys until one goes elsewhere, is one step back.
    for (const name of ["pointerdown", "blur"]) range.addEventListener(name, () => (touched = ""));
    levers.push({ box, range, output });
  }

  function bendTo(j, value) {
    const { a, b, c, follows } = current(),
      { wrong, ...numbers } = valuesOf({ a, b, c, follows });
    if (wrong.size) return;
    const base = baseOf(numbers) ?? { tableau: { a, b, c, follows }, name: nameOf(numbers) };
    const weights = bend(numbers, j, value).map((x) => writeEntry(Number(x.toPrecision(15)), 1e-13));
    set({ a, b: weights, c, follows }, `R${j}`);
    origin = base;
    update();
  }

  /** The table with the same a and c whose R was bent, or null: the one begun with, or one that is known. */
  function baseOf(numbers) {
    const isSame = (one, other) =>
      one.length === other.length && one.every((x, i) => Math.abs(x - other[i]) < 1e-12);
    const isBase = (values) =>
      !values.wrong.size &&
      isSame(values.a.flat(), numbers.a.flat()) &&
      isSame(values.c, numbers.c) &&
      !isSame(values.b, numbers.b);
    if (origin) return isBase(valuesOf(origin.tableau)) ? origin : null;
    if (known.some(({ values }) => isSame(values.a.flat(), numbers.a.flat()) && isSame(values.b, numbers.b)))
      return null;
    const found = known.find(({ values }) => isBase(values));
    return found ? { tableau: typed(found), name: found.name } : null;
  }
  back.addEventListener("click", () => {
    const base = baseOf(good.numbers);
    if (base) set(base.tableau, "");
  });

  function tellBend() {
    const isBent = isPolynomial(good.R),
      coefficients = isBent ? coefficientsOf(good.numbers) : [],
      base = isBent ? baseOf(good.numbers) : null;
    while (levers.length < coefficients.length - 1) addLever();
    if (isBent) pulled = clamp(pulled, 1, coefficients.length - 1);
    levers.forEach(({ box, range, output }, i) => {
      const j = i + 1,
        value = coefficients[j];
      box.hidden = value === undefined;
      if (box.hidden) return;
      const words = moved(value);
      write(output, words);
      box.classList.toggle("se-pulled", j === pulled);
      range.value = Math.round(FINE * factorial(j) * value);
      range.setAttribute("aria-valuetext", `${words}, the exponential has ${moved(1 / factorial(j))}`);
    });
    const facts = base && { ...examine(valuesOf(base.tableau), robot.modes), name: base.name };
    write(bent, bentWords(good, facts, pulled));
    back.disabled = !base;
    write(back, base ? `Back to ${base.name === "Your method" ? "where it was" : base.name}` : "Back");
  }

  // ---- what follows from it

  const list = make(sheet, "dl", "se-facts"),
    rows = {};
  for (const [key, name] of [
    ["order", "Order"],
    ["R", "R(z)"],
    ["stability", "Stability"],
    ["limit", "Longest stable step for this robot"],
  ]) {
    make(list, "dt", "", {}, name);
    rows[key] = make(list, "dd");
  }
  sheet.append(bow); // below what it changes

  const trees = make(root, "details", "se-trees", { open: "" });
  make(trees, "summary", "", {}, "Order conditions: a rooted tree each");
  const marks = [];
  for (let order = 1; order <= CONDITIONS.at(-1).order; order++) {
    const group = make(trees, "section"),
      title = make(group, "p", "se-title", { id: `${id}-order-${order}` }, `Order ${order}`),
      items = make(group, "ul", "", { "aria-labelledby": title.id });
    CONDITIONS.forEach((condition, i) => {
      if (condition.order !== order) return;
      const item = make(items, "li");
      drawTree(item, condition.tree);
      make(
        item,
        "span",
        "se-sum",
        {},
        `${condition.name} = 1${condition.density > 1 ? `/${condition.density}` : ""}`,
      );
      marks[i] = { item, words: make(item, "span", "se-mark") };
    });
  }

  // ---- the run

  const controls = make(sheet, "div", "se-run-controls");
  const knobs = {};
  for (const [name, label, unit] of [
    ["v", "Speed v", "m/s"],
    ["dt", "Step Δt", "ms"],
  ]) {
    const [low, high] = ranges[name],
      box = make(controls, "div", "se-knob");
    make(box, "label", "", { for: `${id}-${name}` }, label);
    const output = make(box, "output", "", { for: `${id}-${name}` }),
      range = make(box, "input", "", { type: "range", id: `${id}-${name}`, min: 0, max: STOPS, step: 1 });
    range.addEventListener("input", () => {
      model.set(name, Number((low * (high / low) ** (range.value / STOPS)).toPrecision(3)));
      model.save_changes();
    });
    knobs[name] = {
      show(value) {
        const words = `${show((unit === "ms" ? 1000 : 1) * value)} ${unit}`;
        range.value = Math.round((STOPS * Math.log(value / low)) / Math.log(high / low));
        range.setAttribute("aria-valuetext", words);
        write(output, words);
      },
    };
  }
  const moves = make(controls, "div", "se-tools"),
    toLimit = button(moves, "Δt to the limit"),
    keep = button(moves, "Keep to compare"),
    forget = button(moves, "Forget it");
  toLimit.addEventListener("click", () => {
    model.set("dt", clamp(good.limit, ...ranges.dt));
    model.save_changes();
  });
  keep.addEventListener("click", () => {
    model.set("kept", { ...current(), name: nameOf(good.numbers) });
    model.save_changes();
  });
  forget.addEventListener("click", () => {
    model.set("kept", {});
    model.save_changes();
  });

  const picture = (name) => {
    const figure = make(views, "div", `se-view se-view-${name}`);
    const canvas = make(figure, "canvas", "", { role: "img" }),
      words = make(figure, "p", "se-words");
    return { canvas, words, w: 0, h: 0 };
  };
  const pictures = Object.fromEntries(
    ["region", "axis", "forces", "work"].map((name) => [name, picture(name)]),
  );

  const game = make(root, "section", "se-puzzles");
  make(game, "p", "se-title", { id: `${id}-puzzles` }, "Puzzles");
  const tasks = make(game, "ol", "", { "aria-labelledby": `${id}-puzzles` });
  const riddles = puzzles(examine(start.values, robot.modes), facts.traded).map(({ task }) => {
    const item = make(tasks, "li");
    make(item, "strong", "", {}, task);
    return { item, words: make(item, "span", "se-verdict") };
  });

  // ---- from the state to what one sees

  let zoom = 1, // of the pictures
    good = null, // what was examined last
    other = null, // the table to compare with, examined
    key = "",
    otherKey = "",
    tried = null,
    rival = null,
    curves = [],
    tryKey = "",
    colours = null,
    scheduled = 0,
    cost = 0;

  function update() {
    const begun = performance.now();
    const tableau = current(),
      { wrong, ...numbers } = valuesOf(tableau);
    if (inputs.size !== tableau.b.length * (tableau.b.length + 2)) build(tableau.b.length);
    const isBad = wrong.size > 0,
      now = JSON.stringify(numbers);
    if (!isBad && now !== key) {
      key = now;
      good = examine(numbers, robot.modes);
      model.set("numbers", { name: nameOf(numbers), order: Math.max(good.order, 1), ...numbers });
      model.save_changes();
    }
    good ??= examine(start.values, robot.modes);
    const kept = model.get("kept"),
      keptNow = kept?.b ? JSON.stringify(kept) : "";
    if (keptNow !== otherKey) {
      otherKey = keptNow;
      const values = keptNow ? valuesOf(kept) : null;
      other =
        values && !values.wrong.size
          ? { name: kept.name ?? nameOf(values), ...examine(values, robot.modes) }
          : null;
    }
    fill(tableau, wrong);
    tell(isBad);
    tellBend();
    measure();
    cost += performance.now() - begun;
    scheduled ||= requestAnimationFrame(paint);
  }

  /** Texts into the table, but not where somebody is typing; what is wrong beside it. */
  function fill({ a, b, c, follows }, wrong) {
    const sums = follows && !wrong.size ? sumsAsText() : null;
    for (const [name, input] of inputs) {
      const [i, j] = [Number(name[1]) - 1, Number(name[2]) - 1];
      let text = name[0] === "a" ? a[i][j] : name[0] === "b" ? b[i] : c[i];
      if (name[0] === "c" && follows) {
        text = sums ? sums[i] : input.value;
        if (sums && text.length > 8) text = plain(good.numbers.c[i], 6);
      }
      if (input.value !== text) input.value = text;
      const isWrong = wrong.has(name),
        isStray = !isWrong && !wrong.size && name[0] === "c" && good.strays.includes(i);
      if (isWrong) {
        input.setAttribute("aria-invalid", "true");
        input.setAttribute("aria-describedby", errors.id);
      } else if (input.hasAttribute("aria-invalid")) {
        input.removeAttribute("aria-invalid");
        input.removeAttribute("aria-describedby");
      }
      input.classList.toggle("se-stray", isStray);
      input.classList.toggle("se-chosen", name === chosen);
      input.classList.toggle("se-upper", name[0] === "a" && j >= i);
    }
    write(errors, [...wrong].map(([name, text]) => wrongEntry(name, text)).join("\n"));
    if (follow.getAttribute("aria-pressed") !== String(follows)) follow.setAttribute("aria-pressed", follows);
    if (stages.value !== String(b.length)) stages.value = b.length;
    undo.disabled = !past.length;
    write(turnName, `Turn ${chosen}`);
    const value = readEntry(inputs.get(chosen).value);
    slider.disabled = value === null;
    if (value !== null) {
      if (middle === null) {
        middle = value;
        slider.value = 0;
      }
      // Typed anew, or undone: the slider begins there.
      if (Math.abs(middle + Number(slider.value) - value) > 5e-3) {
        middle = value;
        slider.value = 0;
      }
      slider.setAttribute("aria-valuetext", `${chosen} = ${show(value, 4)}`);
    }
  }

  function tell(isBad) {
    const name = nameOf(good.numbers);
    const riddlesNow = puzzles(good, facts.traded),
      solved = riddlesNow.flatMap(({ isWon }, i) => (isWon ? [` Puzzle ${i + 1} is solved.`] : []));
    write(
      said,
      (isBad ? "The last table that could be read: " : "") + headline(name, good) + solved.join(""),
    );
    write(rows.order, orderWords(good));
    const P = polynomial(good.R.P),
      Q = polynomial(good.R.Q);
    write(rows.R, Q === "1" ? P : `(${P}) / (${Q})`);
    write(rows.stability, stabilityWords(good));
    write(rows.limit, limitWords(good));
    CONDITIONS.forEach((_, i) => {
      const { item, words } = marks[i],
        holds = good.holds[i];
      item.classList.toggle("se-holds", holds);
      write(words, holds ? "holds" : `is ${show(good.sums[i], 4)}`);
    });
    riddlesNow.forEach(({ isWon, words }, i) => {
      riddles[i].item.classList.toggle("se-won", isWon);
      write(riddles[i].words, words);
    });
    for (const [name, knob] of Object.entries(knobs)) knob.show(setting(name));
    const [low, high] = ranges.dt;
    toLimit.disabled = !(good.limit >= low && good.limit <= high);
    toLimit.title = toLimit.disabled ? "There is no limit on the slider" : "";
    forget.disabled = !other;
    const index = known.findIndex((scheme) => scheme.name === name);
    choice.value = index < 0 ? "" : String(index);
  }

  const points = () => {
    const dt = setting("dt");
    return robot.modes.map(([re, im]) => [re * dt, im * dt]);
  };
  const fastestTurn = () => Math.max(...points().map(([, im]) => Math.abs(im)));

  /** The runs, if anything that they depend on has changed. */
  function measure() {
    const [v, dt] = [setting("v"), setting("dt")],
      now = [key, otherKey, v, dt].join();
    if (now !== tryKey) {
      tryKey = now;
      tried = bench.try(good.numbers, v, dt);
      rival = other && bench.try(other.numbers, v, (dt * other.stages) / good.stages, "other run");
      curves = [good, ...(other ? [other] : [])].map(({ numbers }) => bench.workCurve(numbers, v));
    }
    const grows = tried.run && good.limit < dt;
    const words = {
      region: `λΔt at Δt = ${ms(dt)}: ${points().filter((z) => !isStable(z)).length || "none"} of ${robot.modes.length} modes ${grows ? "outside, where swings grow" : "outside"}.`,
      axis: swingWords(good.R, fastestTurn()),
      forces: workWords(good, tried, load),
      work: rival
        ? raceWords(other.name, tried, rival)
        : "Keep a method to compare, and two race at equal work.",
    };
    for (const [name, text] of Object.entries(words)) write(pictures[name].words, text);
    const labels = {
      region: `Region of absolute stability with the robot's modes. ${stabilityWords(good)}.`,
      axis: "Modulus and phase of R along the imaginary axis.",
      forces: `Normal forces over the bump at ${show(v)} m/s, the exact ones behind.`,
      work: `Largest error of a force against work; now ${show(tried.error, 2)} newtons for ${tried.work}.`,
    };
    for (const [name, text] of Object.entries(labels)) pictures[name].canvas.setAttribute("aria-label", text);
  }
  const isStable = ([re, im]) => slackAt(good.R.P, good.R.Q, re, im) <= IN;

  function paint() {
    const begun = performance.now();
    scheduled = 0;
    colours ??= coloursOf(root);
    const draw = {
      region: (p) => {
        sight = drawRegion(p, good.R, other?.R, points(), isPolynomial(good.R) ? HANDLES : []);
      },
      axis: (p) => drawAxis(p, good.R, other?.R, fastestTurn()),
      forces: (p) => drawForces(p, tried, rival, facts),
      work: (p) => drawWork(p, curves, tried),
    };
    for (const [name, { canvas, w, h }] of Object.entries(pictures)) {
      if (w && h) draw[name](begin(canvas, w, h, colours, ratioOf(zoom)));
    }
    root.dispatchEvent(
      new CustomEvent("painted", { bubbles: true, detail: cost + performance.now() - begun }),
    );
    cost = 0;
  }

  // ---- the border, pulled by mouse or finger; the sliders do it by keys

  const { canvas: sky } = pictures.region;
  let sight = null, // the frame of the region and points of its border, as drawn
    grip = null, // what is held: how far beside the border, and R as it was
    finger = null; // where one came down near the border
  const spot = ({ clientX, clientY }) => {
    const { left, top } = sky.getBoundingClientRect();
    return [(clientX - left) / zoom, (clientY - top) / zoom];
  };
  /** The nearest point of the border, if it is near. */
  function borderAt(event) {
    if (!sight || !isPolynomial(good.R) || valuesOf(current()).wrong.size) return null;
    const [x, y] = spot(event),
      away = ([u, w]) => Math.hypot(u - x, w - y);
    const found = sight.border.reduce((best, one) => (!best || away(one) < away(best) ? one : best), null);
    return found && away(found) <= NEAR[event.pointerType === "touch" ? "touch" : "mouse"] ? found : null;
  }
  function take(point, event) {
    grip = { point, x: event.clientX, y: event.clientY, frame: sight.frame };
    touched = "";
    sky.setPointerCapture(event.pointerId);
    pull(event);
  }
  function pull(event) {
    const { point, x, y, frame } = grip, // by the way it went: words above may push the picture down
      z = [frame.zx(point[0] + (event.clientX - x) / zoom), frame.zy(point[1] + (event.clientY - y) / zoom)];
    if (Math.hypot(...z) < 0.2) return; // |R(0)| is 1 whatever one does
    const scale = factorial(pulled),
      found = scale * coefficientAt(coefficientsOf(good.numbers), pulled, z),
      value = Math.abs(found - 1) < 0.012 ? 1 : Math.round(1e3 * clamp(found, -1, 3)) / 1e3;
    bendTo(pulled, value / scale);
  }
  function letGo() {
    grip = null;
    finger = null;
    touched = "";
    sky.style.cursor = "";
  }
  sky.addEventListener("pointerdown", (event) => {
    if (!event.isPrimary) return letGo(); // two fingers enlarge the page
    const point = event.button ? null : borderAt(event);
    if (!point) return;
    if (event.pointerType === "touch") finger = { point, x: event.clientX, y: event.clientY };
    else take(point, event);
  });
  sky.addEventListener("pointermove", (event) => {
    if (!event.isPrimary) return;
    if (finger && isPull(event.clientX - finger.x, event.clientY - finger.y)) {
      take(finger.point, event);
      finger = null;
    } else if (grip) pull(event);
    if (!grip && event.pointerType === "mouse") sky.style.cursor = borderAt(event) ? "grab" : "";
  });
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) sky.addEventListener(name, letGo);

  const sizes = new ResizeObserver((entries) => {
    zoom = enlargement();
    for (const { target, contentRect } of entries) {
      const found = Object.values(pictures).find(({ canvas }) => canvas === target);
      [found.w, found.h] = [contentRect.width, contentRect.height].map((size) => Math.round(size / zoom));
    }
    scheduled ||= requestAnimationFrame(paint);
  });
  for (const { canvas } of Object.values(pictures)) sizes.observe(canvas);
  const leaveTheme = onTheme(() => {
    colours = null;
    scheduled ||= requestAnimationFrame(paint);
  });
  const watched = ["tableau", "kept", "v", "dt"].map((name) => `change:${name}`);
  for (const name of watched) model.on(name, update);
  update();
  const release = tameSliders(root);
  return () => {
    release();
    for (const name of watched) model.off(name, update);
    sizes.disconnect();
    leaveTheme();
    cancelAnimationFrame(scheduled);
    root.remove();
  };
}
