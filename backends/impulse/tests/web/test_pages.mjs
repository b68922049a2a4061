// Threads in pages of a browser, by the headers that these are served with:
// PLUMB_WEB=FOLDER PLUMB_WEB_HASHES=FILE node --test test_pages.mjs
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { kArguments, kBrowser } from '../../../../harness/viewer/chromium.mjs';

if (!existsSync(kBrowser)) {
  console.log(`skipped: there is no browser at ${kBrowser}; install the package chromium or name one in PLUMB_CHROMIUM`);
  process.exit(0);
}
const kPatience = 60_000; // ms, on a machine that has other work
const recorded = BigInt(readFileSync(new URL('../hashes/recorded.inc', import.meta.url), 'utf8')
  .match(/RECORDED\("tower-20", (0x[0-9a-f]+)/)[1]);
const isolation = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };
const kinds = { '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };

/** A page, or a worker of it, builds a tower and tells what came of it. */
const script = `
import { load } from '/plumb/plumb.mjs';
try {
  const engine = await load({ threads: 3 });
  const world = engine.createWorld({ needs: ['rotation', 'collision', 'friction'] });
  const ground = world.createShape({ type: 'box', halfExtents: [50, 0.5, 50] });
  world.createBody({ shape: ground, motion: 'static', position: [0, -0.5, 0] });
  const cube = world.createShape({ type: 'box', halfExtents: [0.5, 0.5, 0.5] });
  for (let i = 0; i < 20; ++i) world.createBody({ shape: cube, position: [0, 0.5 + i, 0] });
  for (let i = 0; i < 300; ++i) world.step(1 / 60);
  await tell({ ...engine.info, hash: String(world.hash()), waits: engine.info.threads === 1 || await waits() });
  engine.dispose();
} catch (error) {
  await tell({ failed: String(error) });
}
async function waits() { // for others, whoever may not sleep
  const { wasm } = await load('/checks.wasm', { threads: 3 });
  return wasm.test_meet(3) && wasm.test_allocate(3);
}
async function tell(what) {
  await fetch('/told', { method: 'POST', body: JSON.stringify(what) });
}`;
const page = (code) => `<!doctype html><link rel="icon" href="data:,"><script type="module">${code}</script>`;
const visits = {
  isolated: { headers: isolation, text: page(script) },
  worker: { headers: isolation, text: page("new Worker('/visit.mjs', { type: 'module' });") },
  open: { headers: {}, text: page(script) },
  forbidding: { headers: { ...isolation, 'Content-Security-Policy': "worker-src 'none'" }, text: page(script) },
};

let server, told;
before(() => new Promise((ready) => {
  server = createServer((request, answer) => {
    const { pathname } = new URL(request.url, 'http://localhost');
    if (pathname === '/told') {
      let text = '';
      request.on('data', (part) => text += part).on('end', () => {
        answer.end();
        told(JSON.parse(text));
      });
      return;
    }
    const visit = visits[pathname.slice(1)], file = pathname === '/checks.wasm' ? process.env.PLUMB_WEB_HASHES
      : join(process.env.PLUMB_WEB, pathname.replace('/plumb/', ''));
    const text = pathname === '/visit.mjs' ? script : visit?.text ?? (existsSync(file) ? readFileSync(file) : null);
    answer.writeHead(text === null ? 404 : 200,
      { 'Content-Type': kinds[pathname.match(/\.\w+$/)?.[0] ?? '.html'], ...(visit?.headers ?? isolation) });
    answer.end(text ?? '');
  }).listen(0, '127.0.0.1', ready);
}));
after(() => server.close());

async function visited(name) {
  const profile = mkdtempSync(join(tmpdir(), 'plumb-page-'));
  const browser = spawn(kBrowser, [...kArguments, `--user-data-dir=${profile}`,
    `http://127.0.0.1:${server.address().port}/${name}`], { stdio: 'ignore', detached: true });
  const gone = new Promise((ended) => browser.once('exit', ended));
  let late;
  try {
    return await new Promise((ready, failed) => {
      told = ready;
      gone.then((code) => failed(new Error(`the browser ended with ${code}`)));
      late = setTimeout(() => failed(new Error('the page told nothing')), kPatience);
    });
  } finally {
    clearTimeout(late);
    try {
      process.kill(-browser.pid, 'SIGKILL'); // with its own processes, which write to the profile
    } catch { /* they ended by themselves */ }
    await gone;
    rmSync(profile, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 });
  }
}

const cases = {
  isolated: { what: 'an isolated page has threads', threads: 3, remark: /^$/ },
  worker: { what: 'so has a worker of it', threads: 3, remark: /^$/ },
  open: { what: 'another page has one, and is told why', threads: 1, remark: /Cross-Origin-Opener-Policy/ },
  forbidding: { what: 'so has one that forbids workers', threads: 1, remark: /a worker could not be started/ },
};
for (const [name, { what, threads, remark }] of Object.entries(cases))
  test(what, async () => {
    const result = await visited(name);
    assert.equal(result.failed, undefined);
    assert.equal(result.threads, threads);
    assert.match(result.remark, remark);
    assert.equal(BigInt(result.hash), recorded);
    assert.ok(result.waits);
  });
