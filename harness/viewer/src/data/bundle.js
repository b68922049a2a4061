// Opens a replay bundle: base64 in a script element, zlib, then "PLRP", a version, a JSON header and typed sections,
// which from version 2 on are mostly coded (harness/replay/container.hpp).
import { decodeColumn, matchRows } from './columns.js';
import { decodeOrientations, decodePositions } from './motion.js';

const kMagic = 0x50524c50; // "PLRP", little endian
const kVersion = 2;
const kTypes = {
  f32: Float32Array,
  f64: Float64Array,
  u8: Uint8Array,
  u16: Uint16Array,
  i16: Int16Array,
  u32: Uint32Array,
  i32: Int32Array,
};

export function bytesOfBase64(text) {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

export async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** A section as a typed array over the bundle's own bytes; copied only where it is not aligned. */
function sectionOf(bytes, base, name, { offset, type, shape }) {
  const Type = kTypes[type];
  if (!Type) throw new Error(`section "${name}" has the type "${type}"; known are ${Object.keys(kTypes).join(', ')}`);
  const count = shape.reduce((product, extent) => product * extent, 1);
  const begin = bytes.byteOffset + base + offset,
    size = count * Type.BYTES_PER_ELEMENT;
  if (base + offset + size > bytes.length)
    throw new Error(`section "${name}" ends at byte ${base + offset + size} of ${bytes.length}: the bundle is cut off`);
  if (begin % Type.BYTES_PER_ELEMENT === 0) return new Type(bytes.buffer, begin, count);
  return new Type(bytes.slice(base + offset, base + offset + size).buffer);
}

function codedSection(bytes, base, name, entry, before) {
  const begin = base + entry.offset,
    coded = bytes.subarray(begin, begin + entry.length);
  if (coded.length < entry.length)
    throw new Error(`section "${name}" ends at byte ${begin + entry.length} of ${bytes.length}: the bundle is cut off`);
  const { kind } = entry.coding;
  if (kind === 'motion') return decodePositions(coded, entry);
  if (kind === 'turns') return decodeOrientations(coded, entry);
  if (kind === 'differences') return decodeColumn(coded, entry, kTypes[entry.type], before);
  throw new Error(`section "${name}" is coded as "${kind}", which this viewer does not know`);
}

/** {header, sections: {name: typed array}} of inflated bytes. Throws an Error that says what is wrong. */
export function parseBundle(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 12 || view.getUint32(0, true) !== kMagic)
    throw new Error('this is no replay bundle: it does not begin with PLRP');
  const version = view.getUint32(4, true);
  if (version < 1 || version > kVersion)
    throw new Error(`the bundle has version ${version}, this viewer reads versions 1 to ${kVersion}`);
  const length = view.getUint32(8, true);
  if (12 + length > bytes.length)
    throw new Error(`the header ends at byte ${12 + length} of ${bytes.length}: the bundle is cut off`);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(12, 12 + length)));
  const sections = {},
    matched = [];
  for (const [name, entry] of Object.entries(header.sections)) {
    if (!entry.coding) sections[name] = sectionOf(bytes, 12 + length, name, entry);
    else if (Array.isArray(entry.coding.before)) matched.push([name, entry]);
    else sections[name] = codedSection(bytes, 12 + length, name, entry, null);
  }
  const lists = new Map(); // those of one list share what their rows were before
  for (const [name, entry] of matched) {
    const list = name.split('/')[0];
    if (!lists.has(list)) {
      const keys = entry.coding.before.map((key) => sections[`${list}/${key}`]);
      lists.set(list, matchRows(sections[`${list}/start`], keys));
    }
    sections[name] = codedSection(bytes, 12 + length, name, entry, lists.get(list));
  }
  return { header, sections };
}

export async function decodeBundle(base64) {
  return parseBundle(await inflate(bytesOfBase64(base64)));
}
