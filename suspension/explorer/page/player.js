// The moment shown: a slider for it, and a button that lets it run.

import { button, make, write } from "./dom.js";
import { clamp } from "./pen.js";
import { describeMoment, unit } from "./words.js";

const SECONDS = 8; // one crossing, played
const STRIDE = 0.005; // of the run, for an arrow key
const WAYS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 };

export function makePlayer({ root, bar }, model, set, schedule) {
  const play = button(bar, "", { class: "se-play" });
  const moment = make(bar, "input", "se-moment", {
    type: "range",
    min: 0,
    max: 1,
    step: "any",
    "aria-label": "Moment",
  });
  const clock = make(bar, "span", "se-clock");
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  let playing = null;

  const stop = () => {
    playing = null;
    write(play, calm.matches ? "Step" : "▶\uFE0E Play");
    schedule();
  };
  const advance = (now) => {
    if (!playing || !root.isConnected) return;
    playing.start ??= now - 1000 * SECONDS * playing.time;
    playing.time = Math.min((now - playing.start) / 1000 / SECONDS, 1);
    set({ time: playing.time });
    if (playing.time < 1) requestAnimationFrame(advance);
    else stop();
  };
  play.addEventListener("click", () => {
    const time = model.get("time") < 1 ? model.get("time") : 0; // from the end it starts again
    if (playing) return stop();
    if (calm.matches) return set({ time: Math.min(time + 10 * STRIDE, 1) });
    playing = { time };
    write(play, "❚❚ Pause");
    requestAnimationFrame(advance);
  });
  moment.addEventListener("input", () => set({ time: Number(moment.value) }));
  moment.addEventListener("keydown", (event) => {
    const way = WAYS[event.key];
    if (!way) return;
    event.preventDefault();
    set({ time: clamp(model.get("time") + way * STRIDE, 0, 1) });
  });
  calm.addEventListener("change", stop);
  stop();
  return {
    isPlaying: () => playing !== null,
    stop: () => playing && stop(),
    /** Somebody else has set the moment. */
    giveWay: () => playing && model.get("time") !== playing.time && stop(),
    show({ now, motion }) {
      write(clock, describeMoment(now, motion));
      moment.value = model.get("time");
      moment.setAttribute("aria-valuetext", `t = ${unit(now.t, "s")}`);
    },
    destroy() {
      playing = null;
      calm.removeEventListener("change", stop);
    },
  };
}
