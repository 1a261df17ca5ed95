// Pictures one can hear. A score says when which tone sounds, from the forces and the events of a run;
// it is written without any sound, and a player gives it to the browser.

import { clamp } from "./pen.js";
import { unit, WHEEL } from "./words.js";

export const SECONDS = 3, // a crossing takes to hear, whatever its speed
  BASES = [220, 330], // Hz, a wheel that bears its load at rest: a fifth apart
  PANS = [-0.8, 0.8]; // rear left, front right
const POINTS = 240, // of a tone
  LOUD = 0.25, // of a tone; the least force that is heard at full strength is a quarter of the load
  KNOCK = 0.9,
  ALL = 0.7, // of everything together
  CHIME = 0.18,
  NOTE = 0.07; // seconds
const [LOWEST, HIGHEST] = [0.25, 6]; // times the load: beyond, the pitch stays
const SIDES = ["left", "right"];
// Notes in Hz, one after another.
const CHIMES = {
  "lift-off": [880, 1175],
  landing: [1175, 880],
  kept: [523, 659, 784],
  short: [523, 523],
  lost: [262, 196],
};

/** Twice the force, an octave up. */
export const pitch = (N, rest, base) => base * clamp(N / rest, LOWEST, HIGHEST);

/** No force, no tone. */
export const loudness = (N, rest) => LOUD * clamp((4 * N) / rest, 0, 1);

/**
 * What one hears of a lane: a tone for each wheel, knocks, chimes, and captions for all of it; times in
 * seconds from the start.
 */
export function score(lane, seconds = SECONDS) {
  const { flight, robot, end, state } = lane,
    { events } = flight,
    when = (t) => (seconds * t) / end;
  return {
    seconds,
    voices: [0, 1].map((wheel) => voice(lane, wheel, when)),
    knocks: events
      .filter(({ kind }) => kind === "landing")
      .map(({ t, wheel, force }) => ({
        at: when(t),
        pan: PANS[wheel],
        gain: KNOCK * clamp(force / robot.weight[wheel], 0.2, 1),
      })),
    chimes: [
      ...events.map(({ kind, t, wheel }) => ({ kind, at: when(t), pan: PANS[wheel] })),
      { kind: state, at: seconds, pan: 0 },
    ].map((chime) => ({ ...chime, gain: CHIME, note: NOTE, frequencies: CHIMES[chime.kind] })),
    captions: captions(lane, when, seconds),
  };
}

/** One wheel's tone: points between which pitch and loudness go on straight lines. */
function voice({ flight, robot }, wheel, when) {
  const { N, J, dt, events } = flight,
    [rest, base, forces] = [robot.weight[wheel], BASES[wheel], N[wheel]];
  const point = (t, force, isSilent) => ({
    at: when(t),
    frequency: pitch(force, rest, base),
    gain: isSilent ? 0 : loudness(force, rest),
  });
  const points = [],
    turns = events.filter((event) => event.wheel === wheel);
  let [next, isSilent, before] = [0, forces[0] <= 0, -1];
  for (let i = 0; i <= POINTS; i++) {
    const n = Math.round((i * J) / POINTS);
    if (n === before) continue;
    before = n;
    for (; next < turns.length && turns[next].t <= n * dt; next++) {
      const { t, kind, force } = turns[next];
      points.push(point(t, 0, true)); // silent up to a landing, and from a lift-off on
      isSilent = kind === "lift-off";
      if (!isSilent) points.push(point(t, force, false));
    }
    points.push(point(n * dt, forces[n], isSilent));
  }
  return { wheel, pan: PANS[wheel], points };
}

/** Where a force goes: its largest and smallest pitch, Hz. */
const span = ({ points }) => {
  const heard = points.filter(({ gain }) => gain > 0).map(({ frequency }) => frequency);
  return [Math.min(...heard), Math.max(...heard)];
};

/** In words, for those who use the sound to see: what each event sounds like. */
function captions(lane, when, seconds) {
  const { flight, v } = lane,
    found = [
      {
        at: 0,
        words: `At ${unit(v, "m/s")}. At rest: ${BASES.map((base, i) => `${WHEEL[i]} wheel ${SIDES[i]}, ${unit(base, "Hz")}`).join("; ")}.`,
      },
    ];
  for (const { wheel, kind, t, force } of flight.events) {
    const time = `t = ${unit(t, "s")}`,
      side = SIDES[wheel];
    const words =
      kind === "lift-off"
        ? `${WHEEL[wheel]} wheel leaves the ground: two rising notes, then silence on the ${side}.`
        : `${WHEEL[wheel]} wheel lands with ${unit(force, "N")}: a knock and two falling notes on the ${side}, then its tone again.`;
    found.push({ at: when(t), words: `${time}: ${words}` });
  }
  const silent = flight.events.length > 0,
    tones = [0, 1].map((wheel) => {
      const [low, high] = span(voice(lane, wheel, when));
      return `${SIDES[wheel]} ${unit(low, "Hz")} to ${unit(high, "Hz")}`;
    });
  const ends = {
    kept: "three rising notes: kept",
    short: "twice the same note: kept, but with too little to spare",
    lost: "two low notes: lost",
  };
  const stays = silent ? "" : "No silence: both wheels stay on the ground. ";
  found.push({ at: seconds, words: `${stays}Tones: ${tones.join(", ")}. At the end ${ends[lane.state]}.` });
  return found;
}

/** What the sounds mean, once for all. */
export const LEGEND = `The rear wheel sounds left, the front wheel right. Pitch follows the force: ${BASES[0]} and ${BASES[1]} Hz at rest, an octave higher for twice the force. Silence: the wheel is in the air. Two rising notes: it leaves the ground; a knock and two falling notes: it lands. At the end three rising notes: kept; two low ones: lost.`;

/** Give a score to an audio context, to begin at a time of it; what comes back ends it. */
export function play(context, { seconds, voices, knocks, chimes }, start) {
  const master = context.createGain(),
    sources = [];
  master.gain.setValueAtTime(0, start);
  master.gain.linearRampToValueAtTime(ALL, start + 0.02);
  master.connect(context.destination);
  const tone = (type, pan, from, to) => {
    const source = context.createOscillator(),
      gain = context.createGain(),
      panner = context.createStereoPanner();
    source.type = type;
    panner.pan.value = pan;
    gain.gain.setValueAtTime(0, start);
    source.connect(gain).connect(panner).connect(master);
    source.start(start + from);
    source.stop(start + to);
    sources.push(source);
    return { frequency: source.frequency, gain: gain.gain };
  };
  for (const { pan, points } of voices) {
    const { frequency, gain } = tone("triangle", pan, 0, seconds + 0.03);
    frequency.setValueAtTime(points[0].frequency, start);
    gain.setValueAtTime(points[0].gain, start);
    for (const point of points) {
      frequency.linearRampToValueAtTime(point.frequency, start + point.at);
      gain.linearRampToValueAtTime(point.gain, start + point.at);
    }
    gain.linearRampToValueAtTime(0, start + seconds + 0.03);
  }
  for (const knock of knocks) {
    const { frequency, gain } = tone("sine", knock.pan, knock.at, knock.at + 0.15);
    frequency.setValueAtTime(120, start + knock.at);
    frequency.exponentialRampToValueAtTime(45, start + knock.at + 0.1);
    gain.setValueAtTime(knock.gain, start + knock.at);
    gain.exponentialRampToValueAtTime(0.001, start + knock.at + 0.15);
  }
  for (const chime of chimes) {
    const { note, frequencies, at } = chime,
      { frequency, gain } = tone("sine", chime.pan, at, at + note * frequencies.length + 0.05);
    frequencies.forEach((hertz, i) => {
      const from = start + at + note * i;
      frequency.setValueAtTime(hertz, from);
      gain.setValueAtTime(0, from);
      gain.linearRampToValueAtTime(chime.gain, from + 0.008);
      gain.linearRampToValueAtTime(0, from + note);
    });
  }
  return () => {
    for (const source of sources) source.stop();
    master.disconnect();
  };
}

/**
 * The switch behind a button: silent until it is turned on by hand, and again as soon as the window, or
 * what it belongs to, is out of sight.
 */
export function makeSound() {
  let context = null,
    end = null;
  const stop = () => {
    end?.();
    end = null;
  };
  const hide = () => document.hidden && stop();
  document.addEventListener("visibilitychange", hide);
  return {
    isPossible: typeof AudioContext === "function",
    isOn: () => context !== null,
    /** On: by a click alone, or the browser would refuse. */
    turn(on) {
      stop();
      if (on === (context !== null)) return;
      if (on) context = new AudioContext();
      else {
        context.close();
        context = null;
      }
    },
    start(written) {
      stop();
      if (!context || document.hidden) return;
      context.resume();
      end = play(context, written, context.currentTime + 0.03);
    },
    stop,
    destroy() {
      stop();
      context?.close();
      document.removeEventListener("visibilitychange", hide);
    },
  };
}
