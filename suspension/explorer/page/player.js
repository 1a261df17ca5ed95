// The moment shown: a slider for it, a button that lets it run, and two that go from one thing that
// happens to the next.

import { button, make, write } from "./dom.js";
import { eventAt, eventBeside, eventsOf, paceOf, SECONDS, secondsFor, slowing } from "./pace.js";
import { clamp } from "./pen.js";
import { describeMoment, paceWords, unit } from "./words.js";

const STRIDE = 0.005; // of the run, for an arrow key
const LONGEST = 100; // ms between two frames: a window that was out of sight goes on where it was
const WAYS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 };
const BESIDE = { ".": 1, ",": -1 };

/** `settled` is called when a reader's play is over. */
export function makePlayer({ root, box, stage, bar }, facts, model, shown, { set, schedule, settled }) {
  const play = button(bar, "", { class: "se-play" });
  const [back, on] = [
    ["\u2039\u00a0event", "Previous event", -1],
    ["event\u00a0\u203a", "Next event", 1],
  ].map(([text, label, way]) => {
    const made = button(bar, text, { class: "se-step", "aria-label": label, title: label });
    made.addEventListener("click", () => stepBeside(way));
    return made;
  });
  const moment = make(bar, "input", "se-moment", {
    type: "range",
    min: 0,
    max: 1,
    step: "any",
    "aria-label": "Moment",
  });
  const scale = makeScale();
  const clock = make(bar, "span", "se-clock");
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const opening = model.get("time");
  let playing = null,
    fresh = true; // nobody has chosen the moment: what is played begins at the start

  const events = () => eventsOf(shown.scene(), model.get("motion"));
  const stop = () => {
    playing = null;
    write(play, calm.matches ? "Step" : "▶\uFE0E Play");
    schedule();
  };
  /** What a reader stops, or has watched, is the moment that he has chosen. */
  const leave = () => {
    if (!playing?.self) settled();
    stop();
  };
  const advance = (now) => {
    if (!playing || !root.isConnected) return;
    const scene = shown.scene(),
      passed = Math.min(now - (playing.now ?? now), LONGEST) / 1000;
    playing.now = now;
    const rate = secondsFor(scene, model.get("pace")) * slowing(events(), playing.time);
    playing.time = Math.min(playing.time + passed / rate, 1);
    set({ time: playing.time });
    if (playing.time < 1) return requestAnimationFrame(advance);
    if (playing.self && !scene.lanes) {
      playing.time = opening;
      set({ time: opening });
    }
    leave();
  };
  const start = (time, self) => {
    playing = { time, self };
    write(play, "❚❚ Pause");
    requestAnimationFrame(advance);
  };
  const choose = (time) => {
    fresh = false;
    set({ time });
  };
  function stepBeside(way) {
    if (playing) stop();
    const event = eventBeside(events(), model.get("time"), way);
    if (event) choose(event.at);
  }
  play.addEventListener("click", () => {
    const time = model.get("time");
    if (playing) {
      fresh = false;
      return leave();
    }
    if (calm.matches) return choose(Math.min((time < 1 ? time : 0) + 10 * STRIDE, 1));
    start(fresh || time >= 1 ? 0 : time, false); // from the end it starts again
    fresh = false;
  });
  moment.addEventListener("input", () => choose(Number(moment.value)));
  bar.addEventListener("keydown", (event) => {
    if (event.target === scale || event.ctrlKey || event.metaKey || event.altKey) return;
    if (BESIDE[event.key]) {
      event.preventDefault();
      return stepBeside(BESIDE[event.key]);
    }
    const way = WAYS[event.key];
    if (!way || event.target !== moment) return;
    event.preventDefault();
    choose(clamp(model.get("time") + way * STRIDE, 0, 1));
  });
  calm.addEventListener("change", stop);
  stop();

  /** Two ways in which the clock may go; a race has its own. */
  function makeScale() {
    if (facts.lanes) return null;
    const made = make(bar, "select", "se-pace", { "aria-label": "Scale of time" });
    made.title = `How fast the clock goes: so that every run takes ${SECONDS} s, or slowed alike in every run`;
    for (const value of ["fit", "same"]) make(made, "option", "", { value });
    made.addEventListener("change", () => set({ pace: made.value }));
    return made;
  }

  // A small picture plays once by itself as soon as it is seen, unless somebody was there before.
  const watch = new IntersectionObserver(
    (entries) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      watch.disconnect();
      if (!calm.matches && !playing && fresh) start(0, true);
    },
    { threshold: 0.6 },
  );
  const touched = () => watch.disconnect();
  if (facts.compact && !facts.chart) watch.observe(stage);
  for (const name of ["pointerdown", "keydown"]) box.addEventListener(name, touched);

  return {
    isPlaying: () => playing !== null,
    stop() {
      fresh = false;
      if (playing) stop();
    },
    /** Somebody else has set the moment. */
    giveWay: () => playing && Math.abs(model.get("time") - playing.time) > 1e-6 && stop(),
    /** The picture is another one, at a moment worth looking at: what is played begins at the start. */
    refresh() {
      touched();
      fresh = true;
    },
    show({ scene, now, motion }) {
      const time = model.get("time"),
        found = eventsOf(scene, motion),
        event = playing ? undefined : eventAt(found, time),
        pace = (choice) => paceWords(paceOf(scene, found, choice, time));
      write(clock, describeMoment(now, motion, event?.words ?? (scale ? "" : pace())));
      moment.value = time;
      moment.setAttribute("aria-valuetext", `t = ${unit(now.t, "s")}${event ? `, ${event.words}` : ""}`);
      if (scale) {
        const [fit, same] = scale.options;
        write(fit, `${SECONDS}\u00a0s: ${pace("fit")}`);
        write(same, `always ${pace("same")}`);
        scale.value = model.get("pace");
        scale.disabled = calm.matches; // nothing plays
      }
      for (const [made, way] of [
        [back, -1],
        [on, 1],
      ])
        made.setAttribute("aria-disabled", String(!eventBeside(found, time, way)));
    },
    destroy() {
      playing = null;
      watch.disconnect();
      calm.removeEventListener("change", stop);
      for (const name of ["pointerdown", "keydown"]) box.removeEventListener(name, touched);
    },
  };
}
