// Poses of coded bundles (harness/replay/motion.hpp has the format): whole steps, each told from where the two frames
// before it lead. All predictions are in whole numbers, so that they are those of the program that wrote them.

const kUnit = 8192; // steps of a quaternion's component
const kUnitOut = 32767; // of the orientations that come out

/** count numbers of a coded section's planes at offset, as Int32Array. */
export function unplaned(bytes, offset, planes, count) {
  const numbers = new Int32Array(count);
  for (let plane = 0; plane < planes; ++plane) {
    const begin = offset + plane * count,
      shift = 8 * plane;
    for (let i = 0; i < count; ++i) numbers[i] |= bytes[begin + i] << shift;
  }
  for (let i = 0; i < count; ++i) numbers[i] = (numbers[i] >>> 1) ^ -(numbers[i] & 1);
  return numbers;
}

/** Float32Array [frames, bodies, 3], m. */
export function decodePositions(bytes, { shape: [frames, bodies], coding: { step, planes, raw } }) {
  const out = new Float32Array(frames * bodies * 3),
    isRaw = new Uint8Array(bodies);
  for (const body of raw) isRaw[body] = 1;
  const count = 3 * frames * (bodies - raw.length),
    numbers = unplaned(bytes, bodies, planes, count);
  let at = 0;
  for (let axis = 0; axis < 3; ++axis) {
    for (let body = 0; body < bodies; ++body) {
      if (isRaw[body]) continue;
      const order = bytes[body];
      let last = 0,
        before = 0;
      for (let frame = 0; frame < frames; ++frame) {
        const guess = frame < 2 || order === 1 ? last : 2 * last - before;
        before = last;
        last = guess + numbers[at++];
        out[(frame * bodies + body) * 3 + axis] = last * step;
      }
    }
  }
  const rest = new DataView(bytes.buffer, bytes.byteOffset + bodies + planes * count);
  for (let frame = 0, i = 0; frame < frames; ++frame) {
    for (const body of raw) {
      for (let axis = 0; axis < 3; ++axis, i += 4) out[(frame * bodies + body) * 3 + axis] = rest.getFloat32(i, true);
    }
  }
  return out;
}

/** Int16Array [frames, bodies, 4] of unit quaternions in 1/32767. */
export function decodeOrientations(bytes, { shape: [frames, bodies], coding: { planes } }) {
  const out = new Int16Array(frames * bodies * 4),
    leftOut = bodies,
    numbers = unplaned(bytes, bodies + frames * bodies, planes, 3 * frames * bodies);
  const last = new Int32Array(4),
    before = new Int32Array(4),
    now = new Int32Array(4);
  for (let body = 0; body < bodies; ++body) {
    const order = bytes[body];
    let left = 0;
    last.set([0, 0, 0, kUnit]);
    before.set(last);
    for (let frame = 0; frame < frames; ++frame) {
      left ^= bytes[leftOut + body * frames + frame];
      const onwards = frame >= 2 && order !== 1;
      for (let i = 0; i < 4; ++i) now[i] = onwards ? 2 * last[i] - before[i] : last[i];
      const sign = now[left] < 0 ? -1 : 1;
      let rest = kUnit * kUnit,
        dot = 0;
      for (let i = 0, k = 0; i < 4; ++i) {
        if (i === left) continue;
        now[i] = sign * now[i] + numbers[(body * 3 + k++) * frames + frame];
        rest -= now[i] * now[i];
      }
      const exact = Math.sqrt(Math.max(rest, 0)),
        at = (frame * bodies + body) * 4;
      now[left] = Math.floor(exact + 0.5);
      for (let i = 0; i < 4; ++i) {
        out[at + i] = Math.round(((i === left ? exact : now[i]) * kUnitOut) / kUnit);
        dot += now[i] * last[i];
      }
      before.set(last);
      for (let i = 0; i < 4; ++i) last[i] = dot < 0 ? -now[i] : now[i];
    }
  }
  return out;
}
