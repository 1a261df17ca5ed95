// When the instruments of a built page begin: what one sees first at once, the others once that has been
// painted, one at a time, or as soon as one comes near them.

const MARGIN = "600px"; // beside the window: so near an instrument begins
const BOXES = ".suspension-laboratory";

/** What an address leads to: an instrument, by the word that its hashes begin with, or an element. */
function targetOf(hash) {
  const word = hash.match(/^#([a-z]+):/)?.[1];
  return word ? document.querySelector(`${BOXES}.se-${word}`) : document.getElementById(hash.slice(1));
}

/** The first instrument, that which the address leads to, and all above it: their heights must stand. */
function isAtOnce(box, hash) {
  const target = targetOf(hash);
  return (
    box === document.querySelector(BOXES) ||
    box === target ||
    Boolean(target && box.compareDocumentPosition(target) & Node.DOCUMENT_POSITION_FOLLOWING)
  );
}

/** Call `start(box, index)` once for each instrument of a kind, as soon as it is its turn. */
export function startAll(kind, start) {
  const all = () =>
    document.querySelectorAll(`${BOXES}.${kind}`).forEach((box, index) => {
      let isBegun = false;
      const begin = () => {
        if (isBegun) return;
        isBegun = true;
        watch.disconnect();
        start(box, index);
        box.classList.add("se-live");
      };
      const watch = new IntersectionObserver(
        (seen) => seen.some(({ isIntersecting }) => isIntersecting) && begin(),
        { rootMargin: MARGIN },
      );
      if (isAtOnce(box, location.hash)) return begin();
      watch.observe(box);
      // A task of its own after the first picture, so that what one does comes between.
      requestAnimationFrame(() => setTimeout(begin));
    });
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", all);
  else all();
}
