// Sections that are folded, which the address says.
import { changeAddress, readAddress } from './address.js';

const folds = () => [...document.querySelectorAll('section > details.fold')];

export function readFolds() {
  const folded = readAddress().folded.split(',');
  for (const fold of folds()) fold.open = !folded.includes(fold.parentElement.id);
}

/** From now on the address follows what the reader folds. */
export function watchFolds() {
  const write = () => {
    const folded = folds().filter((fold) => !fold.open).map((fold) => fold.parentElement.id);
    changeAddress({ folded: folded.join(',') });
  };
  for (const fold of folds()) fold.addEventListener('toggle', write);
}
