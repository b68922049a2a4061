// The engine's memory as calls need it: what is put there lives as long as the call.
import { PlumbError } from './error.mjs';
import { get, put } from './layouts.mjs';

const kOutOfMemory = -5;

export class Memory {
  #wasm;
  #taken = [];

  constructor(wasm) {
    this.#wasm = wasm;
  }
  view() {
    return new DataView(this.#wasm.memory.buffer);
  }
  text(at) {
    const bytes = new Uint8Array(this.#wasm.memory.buffer);
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  }
  /** Runs call; what it takes is given back after it. */
  scope(call) {
    const before = this.#taken.length;
    try {
      return call();
    } finally {
      while (this.#taken.length > before) this.#wasm.plumb_release(this.#taken.pop());
    }
  }
  /** Zeros, for as long as the scope. */
  take(bytes) {
    const size = Math.max(bytes, 8), at = this.#wasm.plumb_allocate(size);
    if (at === 0) throw new PlumbError(kOutOfMemory, `no ${bytes} bytes of memory are left`);
    this.#taken.push(at);
    new Uint8Array(this.#wasm.memory.buffer, at, size).fill(0);
    return at;
  }
  /** Type: Float64Array, Uint32Array, BigUint64Array, Uint8Array. */
  putArray(Type, values) {
    const at = this.take(values.length * Type.BYTES_PER_ELEMENT);
    new Type(this.#wasm.memory.buffer, at, values.length).set(values);
    return at;
  }
  /** A copy. */
  array(Type, at, length) {
    return new Type(this.#wasm.memory.buffer, at, length).slice();
  }
  putText(text) {
    return this.putArray(Uint8Array, new TextEncoder().encode(`${text}\0`));
  }
  putStructs(layout, values) {
    const at = this.take(layout.size * values.length);
    const view = this.view();
    values.forEach((value, i) => put(view, at + i * layout.size, layout, { structSize: layout.size, ...value }));
    return at;
  }
  structs(layout, at, count) {
    const view = this.view();
    return Array.from({ length: count }, (_, i) => get(view, at + i * layout.size, layout));
  }
  word(at) {
    return this.view().getUint32(at, true);
  }
}
