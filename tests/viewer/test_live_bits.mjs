// Scenes that pages run: the same bits as `plumb run` has of the native engine, and the numbers that recordings have.
import assert from 'node:assert/strict';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { load } from '../../api/web/plumb.mjs';
import { decodeBundle } from '../../harness/viewer/src/data/bundle.js';
import { expression } from '../../harness/viewer/src/live/expressions.js';
import { LiveReplay } from '../../harness/viewer/src/live/live_replay.js';
import { LiveRun } from '../../harness/viewer/src/live/run.js';
import { livePage, needWasm, partsOf, plumb } from './live_page.mjs';

needWasm();

// Cubes; a chain; a mesh of two materials; a hull; compounds; all that machines have of joints, limits, motors and springs,
// and a host that moves, pushes, drives and cuts.
const kScenes = ['D1', 'E1', 'C12', 'H1', 'P11', 'I18', 'I19', 'I27', 'I38', 'E18'];
const kHave = {
  'H=10': ['D1'],
  'L=10': ['E1'],
  'load=1000': ['I18', 'I19'],
  'model=horse': ['H1'],
  'N=3': ['P11'],
};

let scratch, engine, worlds;

before(async () => {
  scratch = mkdtempSync(join(tmpdir(), 'plumb-live-'));
  const page = join(scratch, 'live.html');
  livePage(page, ...kScenes, ...parametersOf(...kScenes));
  const parts = partsOf(page);
  worlds = parts.worlds;
  engine = await load(parts.engine);
});

after(() => rmSync(scratch, { recursive: true }));

/** So that a scene has few variants. */
function parametersOf(...scenes) {
  const given = Object.keys(kHave).filter((one) => kHave[one].some((scene) => scenes.includes(scene)));
  return given.flatMap((one) => ['--param', one]);
}

const titleOf = ({ scene, params }) =>
  [scene, ...Object.entries(params).map(([name, value]) => `${name}=${value}`)].join(' ');
const stepsOf = ({ seconds, dt }) => Math.ceil(seconds / dt - 1e-6);

/** Of each scene the first variant. */
function firstRows(scenes, ...more) {
  const lines = plumb('run', ...scenes, ...parametersOf(...scenes), ...more, '--backend', 'impulse', '--json')
      .trim()
      .split('\n'),
    rows = new Map();
  for (const row of lines.map((line) => JSON.parse(line))) if (!rows.has(row.scene)) rows.set(row.scene, row);
  return [...rows.values()];
}

test('a scene that runs in a page comes to the bits of the native engine', () => {
  const physics = /physics \d+/.exec(JSON.parse(plumb('backends', 'impulse', '--json')).build)[0];
  assert.match(engine.info.build, new RegExp(`${physics}$`), 'the .wasm is of other sources: ./dev platforms wasm');
  for (const row of firstRows(kScenes)) {
    const run = new LiveRun(engine, worlds[titleOf(row)]);
    for (let i = stepsOf(row); i > 0; --i) run.step();
    assert.equal(run.hash, row.hash, titleOf(row));
    run.world.destroy();
  }
});

test('energies, gaps of joints and contacts are those of a recording', async () => {
  for (const scene of ['E1', 'I19', 'D1']) {
    const out = join(scratch, scene),
      page = join(scratch, `${scene}.html`);
    const [row] = firstRows([scene], '--record', '--out', out);
    plumb('export', join(out, 'trajectories', readdirSync(join(out, 'trajectories'))[0]), '--page', page);
    const [, bundle] = /class="plumb-replay"[^>]*>([^<]*)</.exec(readFileSync(page, 'utf8'));
    const { header, sections } = await decodeBundle(bundle),
      title = titleOf({ scene, params: header.params });
    assert.ok(worlds[title], `${title} is among the recordings of ${row.scene}`);
    const run = new LiveRun(engine, worlds[title]),
      replay = new LiveReplay(run);
    const near = (is, should, scale, what) =>
      assert.ok(Math.abs(is - should) <= 2e-3 * Math.abs(should) + scale, `${title}, ${what}: ${is} for ${should}`);
    const span = Math.max(...sections['series/energy']) - Math.min(...sections['series/energy']);
    for (let frame = 0; frame < sections.times.length; ++frame) {
      for (; run.time < sections.times[frame] - 1e-6; replay.stepped(run.step()));
      const energy = replay.sections['series/energy'].at(-1),
        recorded = sections['series/energy'][frame];
      assert.ok(
        Math.abs(energy - recorded) <= 1e-6 * (Math.abs(recorded) + span),
        `${title}: ${energy} J for ${recorded} J`,
      );
      assert.equal(replay.sections['series/contacts']?.at(-1) ?? 0, sections['series/contacts'][frame]);
      const gaps = new Map();
      for (let i = 0; i < (replay.sections['joints/joint']?.length ?? 0); ++i)
        gaps.set(replay.sections['joints/joint'][i], replay.sections['joints/gap'][i]);
      const [begin = 0, end = 0] = sections['joints/start']?.slice(frame, frame + 2) ?? [];
      assert.equal(gaps.size, end - begin);
      for (let i = begin; i < end; ++i)
        near(
          gaps.get(sections['joints/joint'][i]),
          sections['joints/gap'][i],
          2e-9,
          `gap of joint ${sections['joints/joint'][i]}`,
        );
    }
    assert.ok(run.steps > 100);
    run.world.destroy();
  }
});

test('what is changed counts, and a new beginning keeps it', () => {
  const run = new LiveRun(engine, worlds['D1 H=10']),
    height = () => run.poses[10 * 7 + 1],
    start = height();
  run.setGravity([0, 0, 0]);
  for (let i = 0; i < 30; ++i) run.step();
  assert.equal(height(), start, 'without gravity nothing sinks');
  run.setDt(1 / 240);
  run.setMaterial('friction', 0);
  run.setSetting('substeps', 2);
  run.step();
  assert.ok(Math.abs(run.time - (0.5 + 1 / 240)) < 1e-12);
  run.reset();
  assert.deepEqual([run.steps, run.dt, run.gravity[1], run.getSetting('substeps')], [0, 1 / 240, 0, 2]);
  assert.deepEqual([...run.world.read('material', run.bodies.slice(0, 1))], [0, 0]);
  assert.throws(() => run.setSetting('substeps', -1), /substeps/);
  run.world.destroy();
});

test('what is asked wrongly is said', () => {
  const said = (...given) => {
    try {
      plumb('live', 'D1', '--html', join(scratch, 'wrong.html'), ...given);
    } catch ({ stderr }) {
      return stderr;
    }
    return '';
  };
  assert.match(said('--wasm', join(scratch, 'none.wasm')), /cannot read .*none.wasm/);
  assert.match(said('--wasm', join(scratch, 'live.html')), /live.html is no WebAssembly/);
  assert.match(said('--set', 'substep=3'), /did you mean "substeps"/);
  assert.match(said('--param', 'h=3'), /no parameter "h"/);
});

test('expressions mean what they mean in scene files', () => {
  const at = (text, t, names = {}) => expression(text, names)(t);
  assert.equal(at('t < 2 ? t^2 / 4 : t < 20 ? t - 1 : 0', 1), 0.25);
  assert.equal(at('t < 2 ? t^2 / 4 : t < 20 ? t - 1 : 0', 4), 3);
  assert.equal(at('-2^2 + mod(-1, 3) * deg(180) / pi', 0), -2);
  assert.equal(at('2^3^2', 0), 512);
  assert.equal(at('2 - 3 - 4', 0), -5);
  assert.equal(at('t < 1 || t > 6 && h == 2', 7, { h: 2 }), 1);
  assert.equal(at('min(3, 1e-1, .5) + round(-2.5)', 0), -2.9);
  assert.throws(() => at('sin(t', 0), /lacks a "\)"/);
  assert.throws(() => at('t + height', 0), /"height", which a page does not know/);
});
