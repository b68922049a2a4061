// Comes to rest at a place of a page whose parts are drawn, and grow, as they come into sight.

const kStill = 8, // frames without a move
  kPatience = 4000; // ms

let landing = new AbortController(); // one at a time

/** bring() scrolls to where find() is or will be, again and again until nothing above it grows any more, or the reader takes over. */
export async function landOn(find, bring) {
  landing.abort();
  const over = new AbortController();
  landing = over;
  for (const name of ['wheel', 'touchmove', 'keydown', 'pointerdown'])
    addEventListener(name, () => over.abort(), { passive: true, signal: over.signal });
  const end = performance.now() + kPatience;
  for (let still = 0, last = NaN; still < kStill && performance.now() < end && !over.signal.aborted; ) {
    bring();
    await new Promise(requestAnimationFrame);
    const top = find()?.getBoundingClientRect().top ?? NaN;
    still = Math.abs(top - last) < 1 ? still + 1 : 0;
    last = top;
  }
  over.abort();
}
