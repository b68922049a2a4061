// Scales that all engines of a scene share, so that one colour means one number everywhere.
import { valueRange } from './curves.js';

const kMost = 20000; // values looked at, of each section
const kQuantile = 0.995; // what lies above takes the last colour

/** The value that nearly all of the positive ones do not exceed; `least` where there are none. */
export function upperRange(arrays, least) {
  const values = [];
  for (const array of arrays) {
    if (!array) continue;
    const stride = Math.max(1, Math.floor(array.length / kMost));
    for (let i = 0; i < array.length; i += stride) if (Number.isFinite(array[i]) && array[i] > 0) values.push(array[i]);
  }
  if (!values.length) return least;
  values.sort((a, b) => a - b);
  return Math.max(values[Math.floor(kQuantile * (values.length - 1))], least);
}

export function colourRanges(replays) {
  let deepestBox = 0;
  for (const { sections } of replays) {
    for (const depth of sections['boxes/depth'] ?? []) deepestBox = Math.max(deepestBox, depth);
  }
  return {
    penetrationRange: upperRange(
      replays.map(({ sections }) => sections.penetration),
      1e-9,
    ),
    forceRange: upperRange(
      replays.map(({ sections }) => sections['contacts/force']),
      1e-9,
    ),
    gapRange: upperRange(
      replays.map(({ sections }) => sections['joints/gap']),
      1e-9,
    ),
    hasSprings: replays.some(({ header }) => header.joints?.some(({ spring }) => spring)),
    deepestBox,
  };
}

/** {series: {low, high}} over all replays. */
export function seriesRanges(replays, names) {
  return Object.fromEntries(
    names.map((name) => {
      const each = replays
        .map(({ sections }) => sections[`series/${name}`])
        .filter(Boolean)
        .map((values) => valueRange(values));
      return [name, { low: Math.min(...each.map(({ low }) => low)), high: Math.max(...each.map(({ high }) => high)) }];
    }),
  );
}
