// A backend of Plumb in a page, a worker or Node: load() gives an engine, whose worlds hold shapes, bodies and joints.
// What the words mean is said in plumb.h; types are in plumb.d.mts. The rest of the module is in engine/ beside it.
import { Engine } from './engine/engine.mjs';
import { INVALID, PlumbError } from './engine/error.mjs';
import { imports } from './engine/wasi.mjs';

export { PlumbError };

/**
 * @param source where the .wasm is (a URL or its text), its bytes, or a compiled WebAssembly.Module
 */
export async function load(source = new URL('plumb-impulse.wasm', import.meta.url)) {
  const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(await bytesOf(source));
  let wasm;
  wasm = (await WebAssembly.instantiate(module, imports(module, () => wasm.memory))).exports;
  wasm._initialize?.();
  return new Engine(wasm);
}

async function bytesOf(source) {
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return source;
  const url = new URL(source, import.meta.url);
  if (url.protocol === 'file:') return (await import('node:fs/promises')).readFile(url);
  const answer = await fetch(url);
  if (!answer.ok) throw new PlumbError(INVALID, `${url} cannot be loaded: ${answer.status} ${answer.statusText}`);
  return answer.arrayBuffer();
}
