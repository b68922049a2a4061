// The few calls to a system that a C++ library makes.
import { PlumbError } from './error.mjs';

const kNoSuchCall = 52; // ENOSYS
const kInternal = -12;
const kThreadLost = 86; // exec/cpu/arena_web.cpp

/** memory(): the instance's memory. ended(text): the engine ends itself, and why. */
export function imports(module, memory, ended = () => {}) {
  const view = () => new DataView(memory().buffer);
  const offered = {
    clock_time_get: (_clock, _precision, at) => {
      view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    environ_sizes_get: (count, size) => {
      view().setUint32(count, 0, true);
      view().setUint32(size, 0, true);
      return 0;
    },
    environ_get: () => 0,
    fd_write: (_file, pieces, count, written) => {
      let text = '', total = 0;
      for (let i = 0; i < count; ++i) {
        const at = view().getUint32(pieces + 8 * i, true), size = view().getUint32(pieces + 8 * i + 4, true);
        text += new TextDecoder().decode(new Uint8Array(memory().buffer, at, size).slice());
        total += size;
      }
      console.error(text);
      view().setUint32(written, total, true);
      return 0;
    },
    proc_exit: (status) => {
      const text = status === kThreadLost ? 'a thread of the engine died amid its work; load the engine anew'
        : `the engine ended itself with ${status}`;
      ended(text);
      throw new PlumbError(kInternal, text);
    },
    emscripten_notify_memory_growth: () => {},
  };
  const wanted = {};
  for (const { module: from, name, kind } of WebAssembly.Module.imports(module))
    (wanted[from] ??= {})[name] = kind === 'memory' ? memory() : offered[name] ?? (() => kNoSuchCall);
  return wanted;
}
