// A worker that lends its thread to an engine (threads.mjs). It answers 'ready', or why it cannot.
import { imports } from './wasi.mjs';

async function serve({ module, memory, thread, stack }, port) {
  try {
    const wasm = (await WebAssembly.instantiate(module, imports(module, () => memory))).exports;
    wasm.__stack_pointer.value = stack;
    wasm.plumb_enter_thread(thread);
    port.postMessage('ready');
    lend(wasm);
  } catch (error) {
    port.postMessage(error.message);
  }
  if (port === globalThis) close();
}

function lend(wasm) {
  try {
    wasm.plumb_serve();
  } catch (error) {
    wasm.plumb_lose_thread();
    throw error;
  }
}

if (typeof WorkerGlobalScope === 'undefined')
  import('node:worker_threads').then(({ workerData, parentPort }) => serve(workerData, parentPort));
else
  addEventListener('message', ({ data }) => serve(data, globalThis), { once: true });
