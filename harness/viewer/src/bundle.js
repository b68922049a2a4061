// Opens a replay bundle: base64 in a script element, zlib, then "PLRP", a version, a JSON header and typed sections.

const kMagic = 0x50524c50; // "PLRP", little endian
const kVersion = 1;
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

/** {header, sections: {name: typed array}} of inflated bytes. Throws an Error that says what is wrong. */
export function parseBundle(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 12 || view.getUint32(0, true) !== kMagic)
    throw new Error('this is no replay bundle: it does not begin with PLRP');
  const version = view.getUint32(4, true);
  if (version !== kVersion) throw new Error(`the bundle has version ${version}, this viewer reads version ${kVersion}`);
  const length = view.getUint32(8, true);
  if (12 + length > bytes.length)
    throw new Error(`the header ends at byte ${12 + length} of ${bytes.length}: the bundle is cut off`);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(12, 12 + length)));
  const sections = {};
  for (const [name, entry] of Object.entries(header.sections))
    sections[name] = sectionOf(bytes, 12 + length, name, entry);
  return { header, sections };
}

export async function decodeBundle(base64) {
  return parseBundle(await inflate(bytesOfBase64(base64)));
}
