// What is shown: the scene at the model's settings, computed when somebody asks, and what a reader
// has added to it: a pinned run, the map in place of the curve, a thing that is held.

import { makeMap } from "./map.js";
import { judge } from "./model.js";
import { makeScenes, momentOf } from "./scene.js";
import { numbersOf, SETTINGS } from "./state.js";
import { describePinned } from "./words.js";

export function makeShown(data, model) {
  const sceneAt = makeScenes(data);
  let scene = null,
    stale = true,
    map = null;
  const currentMap = () => {
    const { c, height, sigma } = scene.settings,
      of = [c, height, sigma].join();
    if (map?.of !== of) map = { of, picture: makeMap(data, scene.settings) };
    return map.picture;
  };
  const shown = {
    pinned: null,
    mapped: false,
    held: null,
    looks: 0, // counts changes of what is drawn that are no changes of the settings
    isComputed: () => scene !== null,
    scene() {
      if (stale) scene = sceneAt(numbersOf(model, SETTINGS));
      stale = false;
      return scene;
    },
    /** The settings have changed. */
    forget() {
      stale = true;
    },
    options: () => ({
      scene,
      now: momentOf(scene, model.get("time")),
      motion: model.get("motion"),
      pinned: shown.pinned,
      held: shown.held,
      map: shown.mapped && currentMap(),
    }),
    /** What is kept of the run to compare others with. */
    snapshot(headline) {
      const { run, flight, v, curve, robot, dt, scheme, settings } = shown.scene(),
        motion = run ? model.get("motion") : "flying",
        kept = motion === "flying" ? flight : run;
      return {
        v,
        dt: kept.dt,
        verdict: judge(kept),
        words: describePinned(settings, scheme, motion, headline),
        N: kept.N.map((N) => N.slice(0, kept.J + 1)),
        least: curve.least.map((N) => N.slice()),
        z: robot.modes.map(([re, im]) => [re * dt, im * dt]),
      };
    },
  };
  return shown;
}
