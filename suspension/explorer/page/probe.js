// For those who compare: everything shown, in plain arrays, and where the modes are drawn.

export function addProbes(root, shown, painter) {
  root.trajectory = () => {
    const { run, flight, curve, truth, settings } = shown.scene(),
      copy = (rows, J) => rows.map((row) => [...row.subarray(0, J + 1)]);
    return {
      ...settings,
      W: run && copy(run.W, run.J),
      N: run && copy(run.N, run.J),
      verdict: run?.verdict,
      exact: truth.verdict,
      speeds: [...curve.speeds],
      least: curve.least.map((N) => [...N]),
      critical: curve.critical,
      events: flight.events,
      highest: flight.gaps.map((gap) => gap.subarray(0, flight.J + 1).reduce((a, b) => Math.max(a, b), 0)),
      flightStep: flight.dt,
    };
  };
  root.modesAt = () => {
    // in fractions of the panel
    const {
      frame,
      size: [w, h],
    } = painter.panels.find(({ name }) => name === "stability");
    const { robot, dt } = shown.scene();
    return robot.modes.map(([re, im]) => [frame.px(re * dt) / w, frame.py(im * dt) / h]);
  };
}
