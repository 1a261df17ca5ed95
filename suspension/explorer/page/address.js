// The address of a built page says what an instrument holds, and sets it.

const PAUSE = 400; // ms after the last change, until the address says it

/**
 * Let the address and a model follow each other. `prefix` begins an instrument's own hashes, `read` tells
 * what of the model one sets, { name: value } or null, `write` the hash of what it holds, and `names` are
 * what it depends on. What the address says of it when the page opens is set at once; what comes back
 * tells whether it said anything.
 */
export function followAddress(model, box, { prefix, names, read, write }) {
  let timer = 0;
  const initial = write(model);
  const follow = () => {
    clearTimeout(timer);
    const found = read(location.hash);
    for (const [name, value] of Object.entries(found ?? {})) model.set(name, value);
    return found !== null;
  };
  const isSaid = follow();
  if (isSaid) addEventListener("load", () => box.scrollIntoView({ block: "nearest" }), { once: true });
  addEventListener("popstate", follow);
  for (const name of names)
    model.on(`change:${name}`, () => {
      clearTimeout(timer);
      timer = setTimeout(() => {
        const link = write(model),
          bare = location.pathname + location.search,
          isOthers = location.hash && !location.hash.startsWith(prefix);
        if (link === initial && isOthers) return;
        history.replaceState(history.state, "", link === initial ? bare : link);
      }, PAUSE);
    });
  return isSaid;
}
