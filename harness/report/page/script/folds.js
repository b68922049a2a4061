// What is folded: sections, which the address says, and long lists, which are drawn when one opens them.
import { changeAddress, readAddress } from './address.js';

const folds = () => [...document.querySelectorAll('section > details.fold')];

export function readFolds() {
  const folded = readAddress().folded.split(',');
  for (const fold of folds()) fold.open = !folded.includes(fold.parentElement.id);
}

/** Long lists stand in templates, which cost nothing to lay out. */
export function unfoldLists() {
  const unfold = ({ target }) => {
    const list = target.open && target.querySelector(':scope > template');
    if (list) list.replaceWith(list.content);
  };
  document.addEventListener('toggle', unfold, true); // it does not bubble
}

/** From now on the address follows what the reader folds. */
export function watchFolds() {
  const write = () => {
    const folded = folds().filter((fold) => !fold.open).map((fold) => fold.parentElement.id);
    changeAddress({ folded: folded.join(',') });
  };
  for (const fold of folds()) fold.addEventListener('toggle', write);
}
