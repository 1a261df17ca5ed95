// What is shown: the scene at the model's settings, computed when somebody asks, and what a reader
// has added to it: a pinned run, the map in place of the curve, a thing that is held.

import { makeMap } from "./map.js";
import { judge } from "./model.js";
import { extremes, makeRaces, makeScenes, momentAt, momentOf } from "./scene.js";
import { numbersOf, SETTINGS } from "./state.js";
import { describe, describePinned } from "./words.js";

export function makeShown(data, model) {
  const sceneAt = (data.lanes ? makeRaces : makeScenes)(data);
  let scene = null,
    stale = true,
    map = null,
    pinned = null;
  const currentPin = () => {
    const pin = model.get("pin"),
      of = JSON.stringify(pin);
    if (!pin?.v) return null;
    if (pinned?.of !== of) pinned = { of, ...pinOf(makeScenes(data)(pin), pin.motion) };
    return pinned;
  };
  const currentMap = () => {
    const { c, height, sigma } = scene.settings,
      of = [c, height, sigma].join();
    if (map?.of !== of) map = { of, picture: makeMap(data, scene.settings) };
    return map.picture;
  };
  const shown = {
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
    options() {
      const now = momentOf(scene, model.get("time")),
        motion = model.get("motion"),
        pinned = currentPin();
      const apart = scene.flight.events.length > 0,
        other = motion === "flying" ? now.linear : now.flying;
      return {
        scene,
        now,
        motion,
        pinned,
        // The robot that is drawn faintly behind: of the pinned run, or of the other motion.
        ghost: pinned
          ? { scene: pinned.scene, state: pinned.stateAt(now.X) }
          : apart && { scene, state: other },
        held: shown.held,
        map: model.get("mapped") ? currentMap() : null,
      };
    },
  };
  return shown;
}

/** What is shown of a pinned run: it is computed once, for its arrays are its own. */
function pinOf(scene, wanted) {
  const { run, flight, v, curve, robot, dt } = scene,
    motion = run ? wanted : "flying",
    kept = motion === "flying" ? flight : run;
  return {
    scene,
    v,
    dt: kept.dt,
    verdict: judge(kept),
    exact: extremes(scene, motion === "flying"),
    words: describePinned(scene, motion, describe(scene, motion).headline),
    N: kept.N.map((N) => N.slice(0, kept.J + 1)),
    least: curve.least,
    z: robot.modes.map(([re, im]) => [re * dt, im * dt]),
    /** Its state where the centre of mass is at X. */
    stateAt: (X) => momentAt(scene, Math.min(X / v, scene.end))[motion],
  };
}
