// A backend of Plumb in a page, a worker or Node: load() gives an engine, whose worlds hold shapes, bodies and joints.
// What the words mean is said in plumb.h; types are in plumb.d.mts. The rest of the module is in engine/ beside it.
import { Engine } from './engine/engine.mjs';
import { INVALID, PlumbError } from './engine/error.mjs';
import { sharedMemory, Threads, threadsOf, wantsSharedMemory, whyNotShared } from './engine/threads.mjs';
import { imports } from './engine/wasi.mjs';

export { PlumbError };

/**
 * @param source where the .wasm is (a URL or its text), its bytes, or a compiled WebAssembly.Module; left out: the one
 *     beside this module, of one thread or of more
 * @param threads how many may work on a step: 1, a number, or 'auto'. Engine.info tells how many there are, and where
 *     these are fewer the reason
 */
export async function load(source = null, { threads = 1 } = {}) {
  if (source?.constructor === Object) return load(null, source);
  const wanted = await threadsOf(threads);
  if (source !== null) return loaded(await compiled(source), wanted);
  let remark = wanted > 1 ? whyNotShared() : '';
  if (wanted > 1 && remark === '')
    try {
      return await loaded(await compiled(new URL('plumb-impulse-threads.wasm', import.meta.url)), wanted);
    } catch (error) {
      remark = error.message;
    }
  return loaded(await compiled(new URL('plumb-impulse.wasm', import.meta.url)), 1, remark);
}

async function compiled(source) {
  return source instanceof WebAssembly.Module ? source : WebAssembly.compile(await bytesOf(source));
}

async function loaded(module, wanted, remark = '') {
  const shares = wantsSharedMemory(module);
  if (shares && whyNotShared() !== '') throw new PlumbError(INVALID, whyNotShared());
  if (!shares && wanted > 1) remark = 'the .wasm that was given has one thread; plumb-impulse-threads.wasm has more';
  const memory = shares ? sharedMemory() : null;
  let wasm, engine;
  wasm = (await WebAssembly.instantiate(module,
    imports(module, () => memory ?? wasm.memory, (text) => engine?.end(text)))).exports;
  wasm._initialize?.();
  const threads = shares ? await Threads.start(module, wasm, wanted - 1) : null;
  return engine = new Engine(wasm, threads, remark);
}

async function bytesOf(source) {
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return source;
  const url = new URL(source, import.meta.url);
  if (url.protocol === 'file:') return (await import('node:fs/promises')).readFile(url);
  const answer = await fetch(url);
  if (!answer.ok) throw new PlumbError(INVALID, `${url} cannot be loaded: ${answer.status} ${answer.statusText}`);
  return answer.arrayBuffer();
}
