// Pages of plumb live, as tests make them, and what is in them.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { inflateSync } from 'node:zlib';

const { PLUMB_SOURCE: root, PLUMB_PROGRAM: program, PLUMB_WASM: wasm } = process.env;

/** Tests of pages that run scenes end here where no .wasm was built. */
export function needWasm() {
  if (existsSync(wasm)) return;
  console.log(`skipped: there is no ${wasm}; ./dev platforms wasm builds it`);
  process.exit(0);
}

export const plumb = (...given) =>
  execFileSync(program, given, {
    encoding: 'utf8',
    maxBuffer: 1 << 30,
    env: { ...process.env, PLUMB_SCENES: join(root, 'scenes') },
    stdio: ['ignore', 'pipe', 'pipe'],
  });

export const livePage = (file, ...given) => plumb('live', ...given, '--wasm', wasm, '--html', file);

const unpacked = (base64) => inflateSync(Buffer.from(base64, 'base64'));

/** {engine: bytes, worlds: {scene: form}} of a page. */
export function partsOf(file) {
  const text = readFileSync(file, 'utf8');
  const [, engine] = /class="plumb-engine">([^<]*)</.exec(text);
  const worlds = [...text.matchAll(/class="plumb-world" data-scene="([^"]*)">([^<]*)</g)];
  return {
    engine: unpacked(engine),
    worlds: Object.fromEntries(worlds.map(([, scene, form]) => [scene, JSON.parse(unpacked(form).toString())])),
  };
}
