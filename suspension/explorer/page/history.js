// Undo and redo: what was set, one entry for each thing that a reader did.

/** `read` tells all that is set, `write` sets it; entries with the same `key` are one. */
export function makeHistory(read, write, key, told) {
  const past = [],
    future = [];
  let now = read();
  const go = (from, to) => {
    history.note();
    if (!from.length) return;
    to.push(now);
    now = from.pop();
    write(now);
    told();
  };
  const history = {
    canUndo: () => past.length > 0,
    canRedo: () => future.length > 0,
    /** Something may have changed. */
    note() {
      const next = read();
      if (key(next) !== key(now)) {
        past.push(now);
        future.length = 0;
      }
      now = next;
      told();
    },
    /** What is set now is where a reader begins. */
    restart() {
      past.length = 0;
      future.length = 0;
      now = read();
      told();
    },
    undo: () => go(past, future),
    redo: () => go(future, past),
  };
  return history;
}
