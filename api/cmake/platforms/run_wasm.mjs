// Runs a program that is a .wasm: node run_wasm.mjs FILE [ARGUMENT]...
import { readFile } from 'node:fs/promises';
import { WASI } from 'node:wasi';

const [file, ...words] = process.argv.slice(2);
const wasi = new WASI({ version: 'preview1', args: [file, ...words] });
const module = await WebAssembly.compile(await readFile(file));
const imports = { wasi_snapshot_preview1: wasi.wasiImport, env: { emscripten_notify_memory_growth() {} } };
const kNoSuchCall = 52; // ENOSYS
for (const { module: from, name } of WebAssembly.Module.imports(module))
  (imports[from] ??= {})[name] ??= () => kNoSuchCall;
process.exitCode = wasi.start(await WebAssembly.instantiate(module, imports));
