// impulse_hashes with threads: PLUMB_WEB=FOLDER node run_hashes.mjs FILE THREADS[,THREADS]... [SCENE]...
import { pathToFileURL } from 'node:url';
import { load } from './worlds.mjs';

const [file, counts, ...scenes] = process.argv.slice(2);
const threads = counts.split(',').map(Number);
const engine = await load(pathToFileURL(file), { threads: Math.max(...threads) });
if (engine.info.threads !== Math.max(...threads)) throw new Error(engine.info.remark);
for (const count of threads) {
  const words = [file, file, '--check', '--threads', `${count}`, ...scenes];
  const failed = engine.memory.scope(() => engine.wasm.__main_argc_argv(words.length,
    engine.memory.putArray(Uint32Array, words.map((word) => engine.memory.putText(word)))));
  console.log(`${count} threads: ${failed ? 'wrong' : 'the recorded bits'}`);
  process.exitCode ||= failed;
}
engine.dispose();
