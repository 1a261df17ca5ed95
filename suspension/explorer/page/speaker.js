// The words around the pictures: verdict and details, the clock, what a screen reader is told, and
// the bands of kept and lost speeds under the slider of the speed.

import { makeScale } from "./controls.js";
import { write } from "./dom.js";
import { show } from "./pen.js";
import { describe, keyOf } from "./words.js";

const PAUSE = 700; // ms after the last change, until a screen reader is told

export function makeSpeaker({ box, status, headline, details, key, spoken }, data, shown) {
  const settled = []; // called when nothing has changed for a while
  let timer = 0;
  return {
    headline: () => headline.textContent,
    onSettled: (listener) => settled.push(listener),
    speak({ scene, motion, pinned, map, now }, panels) {
      const { tone, headline: text, details: more } = describe(scene, motion, now);
      write(headline, text);
      write(details, [...more, ...(pinned ? [pinned.words] : [])].join(" "));
      write(key, keyOf(scene, motion, pinned).join("\n"));
      status.dataset.tone = tone;
      for (const { name, title, canvas } of panels) {
        const label = name === "speeds" && map ? "Kept or lost at every speed and stiffness" : title;
        const said =
          name === "speeds" ? describeSpeeds(scene) : scene.lanes ? describe(scene, motion).headline : text;
        canvas.setAttribute("aria-label", `${label}. ${said}`);
      }
      if (scene.lanes) return; // no slider of the speed
      const onTrack = onSpeedTrack(scene.curve, data);
      if (onTrack.join() === box.dataset.track) return;
      box.dataset.track = onTrack.join();
      box.style.setProperty("--se-bands", onTrack[0]);
      box.style.setProperty("--se-ticks", onTrack[1]);
    },
    announceLater(isPlaying) {
      clearTimeout(timer);
      timer = setTimeout(() => {
        if (!shown.isComputed()) return;
        write(spoken, headline.textContent);
        if (!isPlaying()) for (const listener of settled) listener();
      }, PAUSE);
    },
    destroy: () => clearTimeout(timer),
  };
}

function describeSpeeds({ curve: { critical, kept } }) {
  const speeds = critical.map((v) => show(v)).join(", ");
  return (
    `Contact is ${kept ? "kept" : "lost"} at the lowest speed` +
    (speeds ? `, and the verdict turns at ${speeds} m/s.` : " and at every other.")
  );
}

/**
 * For the slider of the speed, as backgrounds: kept and lost speeds, and ticks at the critical speeds
 * (above) and the asked ones (below). The handle's middle goes from 10 pixels to 10 before the end.
 */
function onSpeedTrack({ critical, kept }, { ranges, asked }) {
  const { toPlace } = makeScale(ranges.v);
  const along = (v) => `calc(${(100 * toPlace(v)).toFixed(3)}% + ${(10 - 20 * toPlace(v)).toFixed(2)}px)`;
  const edges = ["0%", ...critical.map(along), "100%"];
  const bands = edges
    .slice(1)
    .map((edge, i) => `var(--se-${kept === (i % 2 === 0) ? "region" : "alarm"}) ${edges[i]} ${edge}`);
  // A background's percentages leave out its own width, 2 pixels.
  const tick = (v, end) =>
    `linear-gradient(var(--se-soft) 0 0) calc(${(100 * toPlace(v)).toFixed(3)}% + ${(9 - 18 * toPlace(v)).toFixed(2)}px) ${end} / 2px 7px no-repeat`;
  const ticks = [...critical.map((v) => tick(v, "top")), ...asked.map((v) => tick(v, "bottom"))];
  return [`linear-gradient(to right, ${bands.join(", ")})`, ticks.join(", ") || "none"];
}
