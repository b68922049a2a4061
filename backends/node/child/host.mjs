// The child's side of plumb.wire/1 for engines in JavaScript and WebAssembly: node host.mjs ENGINE
//
// engines/ENGINE.mjs exports `manifest()`, and `createWorld({needs, gravity, settings})` (both may be async), whose result
// has those of the methods called below that the manifest claims. One with readField and writeField takes whole rows. A method that throws has changed nothing. base.mjs has what
// adapters share.
import { performance } from 'node:perf_hooks';
import { Failure } from './failure.mjs';
import { readFrame, reply } from './frames.mjs';
import { FIELD, FIELD_COLUMNS, Row, needsOf, readBody, readJoint, readShape } from './rows.mjs';

const UNSUPPORTED = -3, INTERNAL = -12;
let engine, world;

/** createBody for each, or createBodies where the world takes many at once; what was made is unmade when one fails. */
function allOrNone(numbers, read, kind, plural) {
  const row = new Row(numbers), descs = Array.from({ length: row.number() }, () => read(row)), made = [];
  if (world[`create${plural}`]) return world[`create${plural}`](descs);
  for (const desc of descs) {
    try {
      world[`create${kind}`](desc);
    } catch (error) {
      for (const slot of made.reverse()) world[`destroy${kind}`](slot);
      throw error;
    }
    made.push(desc.slot);
  }
}

const rowsOf = (numbers, columns) => {
  const rows = [];
  for (let at = 0; at + columns <= numbers.length; at += columns) rows.push(numbers.subarray(at, at + columns));
  return rows;
};

const READERS = { [FIELD.POSE]: 'pose', [FIELD.VELOCITY]: 'velocity', [FIELD.AWAKE]: 'awake' };
const WRITERS = {
  [FIELD.POSE]: (slot, v) => world.setPose(slot, v.slice(0, 3), v.slice(3, 7)),
  [FIELD.VELOCITY]: (slot, v) => world.setVelocity(slot, v.slice(0, 3), v.slice(3, 6)),
  [FIELD.AWAKE]: (slot, v) => world.setAwake(slot, v[0] !== 0),
  [FIELD.MATERIAL]: (slot, v) => world.setMaterial(slot, v[0], v[1]),
  [FIELD.GRAVITY_SCALE]: (slot, v) => world.setGravityScale(slot, v[0]),
  [FIELD.DAMPING]: (slot, v) => world.setDamping(slot, v[0], v[1]),
  [FIELD.SURFACE_VELOCITY]: (slot, v) => world.setSurfaceVelocity(slot, v),
  [FIELD.FILTER]: (slot, v) => world.setFilter(slot, { category: v[0] >>> 0, mask: v[1] >>> 0, group: v[2] }),
  [FIELD.ROLLING_FRICTION]: (slot, v) => world.setRollingFriction(slot, v[0], v[1]),
  // Of engines whose manifest takes them.
  [FIELD.IMPULSE]: (slot, v) => world.addImpulse(slot, v),
  [FIELD.ANGULAR_IMPULSE]: (slot, v) => world.addAngularImpulse(slot, v),
  [FIELD.IMPULSE_AT_POINT]: (slot, v) => world.addImpulseAt(slot, v.slice(0, 3), v.slice(3, 6)),
};

function step(row) {
  const dt = row.number();
  for (let count = row.number(); count > 0; --count) world.addForce(row.number(), row.many(3), row.many(3), dt);
  const before = performance.now();
  world.step(dt);
  const seconds = (performance.now() - before) / 1000;
  const { contacts = NaN, pairs = NaN, touching = [] } = world.afterStep();
  return [seconds, contacts, pairs, ...touching];
}

function queries(row, columns, read, ask) {
  const hits = [];
  for (let query = 0; row.left >= columns; ++query)
    for (const hit of world[ask](read(row)))
      hits.push(query, hit.body, hit.child || (hit.position ? world.triangleAt(hit.body, hit.position) : 0), hit.fraction ?? 0, ...(hit.position ?? [NaN, NaN, NaN]), ...(hit.normal ?? [NaN, NaN, NaN]));
  return hits;
}

// Each takes a frame and gives numbers, or nothing.
const CALLS = {
  1: ['describe', () => []],
  2: ['create_world', async ({ numbers, text }) => {
    const row = new Row(numbers), needs = needsOf(row.number()), gravity = row.many(3);
    world = await engine.createWorld({ needs, gravity, settings: JSON.parse(text) });
  }],
  3: ['set_gravity', ({ numbers }) => world.setGravity(Array.from(numbers))],
  4: ['set_setting', ({ text }) => world.applySettings(JSON.parse(text))],
  5: ['create_shapes', ({ numbers }) => allOrNone(numbers, readShape, 'Shape', 'Shapes')],
  6: ['destroy_shapes', ({ numbers }) => numbers.forEach((slot) => world.destroyShape(slot))],
  7: ['create_bodies', ({ numbers }) => allOrNone(numbers, readBody, 'Body', 'Bodies')],
  8: ['destroy_bodies', ({ numbers }) => numbers.forEach((slot) => world.destroyBody(slot))],
  9: ['read', ({ numbers }) => {
    if (world.readField) return world.readField(numbers[0], Array.from(numbers.subarray(1)));
    const columns = FIELD_COLUMNS[numbers[0]], rows = new Float64Array(columns * (numbers.length - 1));
    for (let i = 1; i < numbers.length; ++i) rows.set(world[READERS[numbers[0]]](numbers[i]), columns * (i - 1));
    return rows;
  }],
  10: ['write', ({ numbers }) => {
    const rows = rowsOf(numbers.subarray(1), 1 + FIELD_COLUMNS[numbers[0]]), write = WRITERS[numbers[0]];
    if (world.writeField) return world.writeField(numbers[0], rows.map(([slot]) => slot), rows.flatMap((row) => Array.from(row.subarray(1))));
    for (const row of rows) write(row[0], Array.from(row.subarray(1)));
  }],
  11: ['step', ({ numbers }) => step(new Row(numbers))],
  12: ['contacts', () => world.contacts()],
  13: ['create_joints', ({ numbers }) => allOrNone(numbers, readJoint, 'Joint', 'Joints')],
  14: ['destroy_joints', ({ numbers }) => numbers.forEach((slot) => world.destroyJoint(slot))],
  15: ['write_motors', ({ numbers }) => {
    for (const row of rowsOf(numbers, 13)) {
      const motors = [];
      for (let axis = 0; axis < 6; ++axis) motors.push({ target: row[1 + 2 * axis], most: row[2 + 2 * axis], enabled: row[2 + 2 * axis] !== 0 });
      world.setMotors(row[0], motors);
    }
  }],
  16: ['reactions', ({ numbers }) => Array.from(numbers).flatMap((slot) => world.reaction(slot))],
  17: ['rays', ({ numbers }) => queries(new Row(numbers, 1), 9, (row) => ({ origin: row.many(3), translation: row.many(3), filter: row.filter() }), 'castRay')],
  18: ['casts', ({ numbers }) => queries(new Row(numbers, 1), 14, (row) => ({ shape: row.number(), pose: row.pose(), translation: row.many(3), filter: row.filter() }), 'castShape')],
  19: ['overlaps', ({ numbers }) => queries(new Row(numbers), 11, (row) => ({ shape: row.number(), pose: row.pose(), filter: row.filter() }), 'overlapShape')],
  20: ['exceptions', ({ numbers }) => {
    for (const [a, b] of rowsOf(numbers.subarray(1), 2)) world.setException(a, b, numbers[0] !== 0);
  }],
};

async function answer(request) {
  if (request.call === 1) return reply(request, JSON.stringify({ wire: 'plumb.wire/1', device: 'wasm', build: `node ${process.version}`, ...(await engine.manifest()) }), []);
  const [, run] = CALLS[request.call] ?? [];
  if (run === undefined) throw new Failure(UNSUPPORTED, `call ${request.call} is not of plumb.wire/1 as this child knows it`);
  reply(request, '', (await run(request)) ?? []);
}

const [name] = process.argv.slice(2);
engine = await import(`./engines/${name}.mjs`);
for (let request = readFrame(); request !== null; request = readFrame()) {
  try {
    await answer(request);
  } catch (error) {
    reply(request, `${name}: ${error?.message ?? error}`, [], error?.result ?? INTERNAL);
  }
}
process.exit(0);
