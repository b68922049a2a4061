// Things that are drawn when they come into sight, and may be taken away when they have left it.

const kMargin = '700px 0px'; // drawn so far ahead that one does not see it happen
const jobs = new WeakMap();
const sizeOf = (element) => ({ inner: element.clientWidth, height: element.offsetHeight });
const observer = new IntersectionObserver(
  (entries) => {
    // All is measured before anything is drawn: in turns with drawing, each measure would lay out the whole page anew.
    const sizes = entries.map(({ target }) => sizeOf(target));
    entries.forEach(({ target, isIntersecting }, i) => jobs.get(target)?.(isIntersecting, sizes[i]));
  },
  { rootMargin: kMargin },
);

/** draw() once, when the element first comes into sight. */
export function onceInSight(element, draw) {
  jobs.set(element, (visible) => {
    if (!visible) return;
    observer.unobserve(element);
    jobs.delete(element);
    draw();
  });
  observer.observe(element);
}

/** draw(its inner width) fills the element whenever it comes into sight; out of sight it is emptied and keeps its height. */
export function whileInSight(element, draw) {
  let drawn = false;
  const job = (visible, { inner, height }) => {
    if (visible === drawn) return;
    if (!visible && (element.contains(document.activeElement) || element.querySelector('details[open]'))) return;
    drawn = visible;
    if (visible) {
      draw(inner);
      element.style.minHeight = '';
    } else {
      element.style.minHeight = `${height}px`;
      element.replaceChildren();
    }
  };
  jobs.set(element, job);
  observer.observe(element);
  /** Draws anew what is in sight. */
  return () => drawn && draw(element.clientWidth);
}
