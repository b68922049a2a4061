// Things that are drawn when they come into sight, and may be taken away when they have left it.

const kMargin = '700px 0px'; // drawn so far ahead that one does not see it happen
const jobs = new WeakMap();
const observer = new IntersectionObserver(
  (entries) => {
    for (const { target, isIntersecting } of entries) jobs.get(target)?.(isIntersecting);
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

/** draw() fills the element whenever it comes into sight; out of sight it is emptied and keeps its height. */
export function whileInSight(element, draw) {
  let drawn = false;
  const job = (visible) => {
    if (visible === drawn) return;
    if (!visible && (element.contains(document.activeElement) || element.querySelector('details[open]'))) return;
    drawn = visible;
    if (visible) {
      draw();
      element.style.minHeight = '';
    } else {
      element.style.minHeight = `${element.offsetHeight}px`;
      element.replaceChildren();
    }
  };
  jobs.set(element, job);
  observer.observe(element);
  /** Draws anew what is in sight. */
  return () => drawn && draw();
}
