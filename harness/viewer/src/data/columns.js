// Columns of coded bundles (harness/replay/lists.hpp has the format): numbers told from those in their place before.
import { unplaned } from './motion.js';

const kMantissa = 23; // bits of a float32

/** For each row of a list the one of the frame before with the same keys, the n-th of equal ones for the n-th, or -1. */
export function matchRows(start, keys) {
  const before = new Int32Array(start[start.length - 1]).fill(-1);
  const compare = (a, b) => {
    for (const key of keys) if (key[a] !== key[b]) return key[a] >>> 0 < key[b] >>> 0 ? -1 : 1;
    return 0;
  };
  for (let frame = 1; frame + 1 < start.length; ++frame) {
    let old = start[frame - 1];
    for (let row = start[frame]; row < start[frame + 1]; ++row) {
      while (old < start[frame] && compare(old, row) < 0) ++old;
      if (old < start[frame] && compare(old, row) === 0) before[row] = old++;
    }
  }
  return before;
}

/** Typed array of the section; before: what matchRows says, or null where the section names a distance. */
export function decodeColumn(bytes, { type, shape, coding }, Type, before) {
  const count = shape.reduce((product, extent) => product * extent, 1),
    rows = before ? before.length : count,
    width = rows ? count / rows : 1,
    numbers = unplaned(bytes, 0, coding.planes, count);
  for (let column = 0; column < width; ++column) {
    const base = column * rows;
    for (let row = 0; row < rows; ++row) {
      const old = before ? before[row] : row - coding.before;
      if (old >= 0) numbers[base + row] = (numbers[base + row] + numbers[base + old]) | 0;
    }
  }
  const out = new Type(count),
    asBits = type === 'f32' && coding.step === undefined ? new Uint32Array(out.buffer) : null;
  for (let column = 0, i = 0; column < width; ++column) {
    for (let row = 0; row < rows; ++row, ++i) {
      const number = numbers[i],
        at = row * width + column;
      if (asBits) asBits[at] = ((Math.abs(number) << (kMantissa - coding.bits)) | (number < 0 ? 0x80000000 : 0)) >>> 0;
      else out[at] = coding.step === undefined ? number : number * coding.step;
    }
  }
  return out;
}
