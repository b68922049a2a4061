// plumb.wire/1 on descriptor 3, as ../WIRE.md describes it: frames in, frames out, one at a time.
import { readSync, writeSync } from 'node:fs';

const WIRE = 3;
const MAGIC = 0x31574c50;
const HEADER = 24;

/** Fills all of `bytes`; false where the host has closed its end before the first byte. */
function readAll(bytes) {
  let at = 0;
  while (at < bytes.length) {
    const got = readSync(WIRE, bytes, at, bytes.length - at, null);
    if (got === 0) return false;
    at += got;
  }
  return true;
}

function writeAll(bytes) {
  for (let at = 0; at < bytes.length;) at += writeSync(WIRE, bytes, at, bytes.length - at);
}

const padded = (count) => Math.ceil(count / 8) * 8;

/** The next request as { call, sequence, text, numbers }, or null when the host is gone. */
export function readFrame() {
  const header = Buffer.alloc(HEADER);
  if (!readAll(header)) return null;
  if (header.readUInt32LE(0) !== MAGIC) throw new Error('the host sent something that is no frame of plumb.wire/1');
  const textBytes = header.readUInt32LE(16);
  const count = header.readUInt32LE(20);
  const body = new Uint8Array(padded(textBytes) + 8 * count);
  if (body.length !== 0 && !readAll(body)) return null;
  return {
    call: header.readUInt32LE(4),
    sequence: header.readUInt32LE(8),
    text: Buffer.from(body.buffer, 0, textBytes).toString('utf8'),
    numbers: new Float64Array(body.buffer, padded(textBytes), count),
  };
}

/** @param {{call: number, sequence: number}} request @param {ArrayLike<number>} numbers @param {number} result */
export function reply(request, text, numbers, result = 0) {
  const words = Buffer.from(text, 'utf8');
  const bytes = Buffer.alloc(HEADER + padded(words.length) + 8 * numbers.length);
  bytes.writeUInt32LE(MAGIC, 0);
  bytes.writeUInt32LE(request.call, 4);
  bytes.writeUInt32LE(request.sequence, 8);
  bytes.writeInt32LE(result, 12);
  bytes.writeUInt32LE(words.length, 16);
  bytes.writeUInt32LE(numbers.length, 20);
  words.copy(bytes, HEADER);
  const values = numbers instanceof Float64Array ? numbers : Float64Array.from(numbers);
  Buffer.from(values.buffer, values.byteOffset, values.byteLength).copy(bytes, HEADER + padded(words.length));
  writeAll(bytes);
}
