// Workers that lend an engine their threads (exec/cpu/arena_web.cpp). Each has an instance of the same module over the
// same memory; between steps it sleeps. None must come: what no worker does the caller does.
import { INVALID, PlumbError } from './error.mjs';

const kMost = 64;

/** How many are meant: a number, or 'auto'. */
export async function threadsOf(wanted) {
  if (wanted === 'auto') return Math.min(await processors(), 8);
  if (!Number.isInteger(wanted) || wanted < 1 || wanted > kMost)
    throw new PlumbError(INVALID, `threads is a whole number from 1 to ${kMost} or 'auto', not ${wanted}`);
  return wanted;
}
async function processors() {
  return globalThis.navigator?.hardwareConcurrency ?? (await import('node:os')).availableParallelism();
}

/** Why memory cannot be shared here, or ''. */
export function whyNotShared() {
  return typeof SharedArrayBuffer === 'undefined' || globalThis.crossOriginIsolated === false
    ? 'this page may not share memory: it has to be served with Cross-Origin-Opener-Policy: same-origin and ' +
      'Cross-Origin-Embedder-Policy: require-corp' : '';
}

/** Memory as the module asks for it (cmake/engine_in_wasm.cmake). */
export const sharedMemory = () => new WebAssembly.Memory({ initial: 256, maximum: 32768, shared: true });
export const wantsSharedMemory = (module) =>
  WebAssembly.Module.imports(module).some(({ kind }) => kind === 'memory');

export class Threads {
  #wasm;
  #workers = [];
  /** The caller is one of them. */
  get count() {
    return this.#workers.length + 1;
  }
  /** Why there are fewer than were asked for, or ''. */
  remark = '';

  /** Those that come to be: a worker that cannot start is left out. */
  static async start(module, wasm, others) {
    const threads = new Threads();
    threads.#wasm = wasm;
    if (maySleep()) wasm.plumb_may_sleep();
    const starts = Array.from({ length: others }, () => threads.#add(module));
    for (const { reason } of (await Promise.allSettled(starts)).filter(({ status }) => status === 'rejected'))
      threads.remark = `a worker could not be started: ${reason?.message ?? reason}`;
    return threads;
  }
  /** They end by themselves, and so does a program of Node that has nothing else to do. */
  close() {
    this.#wasm.plumb_close_threads();
    this.#workers.length = 0;
  }
  /** At once, amid whatever they do. */
  terminate() {
    for (const worker of this.#workers) worker.terminate();
    this.#workers.length = 0;
  }

  async #add(module) {
    const thread = this.#wasm.plumb_new_thread();
    const order = { module, memory: this.#wasm.memory, thread, stack: this.#wasm.plumb_stack_of(thread) };
    this.#workers.push(await (typeof Worker === 'undefined' ? nodeWorker : pageWorker)(order));
  }
}

const answer = (text, ready, failed) => text === 'ready' ? ready() : failed(new Error(text));

/** One that is ready. */
function pageWorker(order) {
  const worker = new Worker(new URL('worker.mjs', import.meta.url), { type: 'module' });
  return new Promise((ready, failed) => {
    worker.onmessage = ({ data }) => answer(data, () => ready(worker), failed);
    worker.onerror = ({ message }) => failed(new Error(message || 'its script cannot be loaded'));
    worker.postMessage(order);
  });
}
async function nodeWorker(order) {
  const { Worker } = await import('node:worker_threads');
  const worker = new Worker(new URL('worker.mjs', import.meta.url), { workerData: order, execArgv: [] });
  await new Promise((ready, failed) => {
    worker.on('message', (text) => answer(text, ready, failed));
    worker.on('error', failed);
    worker.on('exit', () => failed(new Error('it ended')));
  });
  worker.unref(); // so that a program which forgets the engine ends, too
  return worker;
}

/** A page's own thread may not. */
function maySleep() {
  try {
    Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 1);
    return true;
  } catch {
    return false;
  }
}
