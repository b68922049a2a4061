// A backend of Plumb in a page, a worker or Node: load() gives an engine, whose worlds hold shapes, bodies and joints.
// What the words mean is said in plumb.h; types are in plumb.d.mts.

const NEED = Object.fromEntries(
  ['rotation', 'collision', 'friction', 'restitution', 'joints', 'ccd', 'sleeping', 'events', 'contacts',
    'contactImpulses', 'sensors', 'kinematic', 'gyroscopic', 'damping', 'forces', 'axisLocks', 'filters', 'queries',
    'surfaceVelocity', 'jointReactions', 'snapshot'].map((name, bit) => [name, 2 ** bit]),
);
const MOTION = { static: 0, kinematic: 1, dynamic: 2 };
const FLAG = { sensor: 1, ccd: 2, noRotation: 4, asleep: 8, neverSleeps: 16 };
const SHAPE = { sphere: 0, box: 1, capsule: 2, cylinder: 3, hull: 4, mesh: 5, plane: 7 };
const JOINT = { ball: 0, hinge: 1, slider: 2, distance: 3, fixed: 4, universal: 5 };
const FIELD = {
  pose: 0, velocity: 1, force: 2, torque: 3, impulse: 4, angularImpulse: 5, forceAtPoint: 6, impulseAtPoint: 7,
  awake: 8, kinematicTarget: 9, mass: 10, material: 11, gravityScale: 12, damping: 13,
};
const HERE = { position: [0, 0, 0], orientation: [0, 0, 0, 1] };

export class PlumbError extends Error {
  constructor(code, text) {
    super(text);
    this.name = 'PlumbError';
    this.code = code;
  }
}

const INVALID = -1;
/** The number of a word, or a sentence that lists the words. */
function numberOf(words, word, what) {
  if (!Object.hasOwn(words, word))
    throw new PlumbError(INVALID, `there is no ${what} "${word}"; there are ${Object.keys(words).join(', ')}`);
  return words[word];
}

/**
 * @param source where the .wasm is (a URL or its text), its bytes, or a compiled WebAssembly.Module
 */
export async function load(source) {
  const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(await bytesOf(source));
  const engine = new Engine();
  const instance = await WebAssembly.instantiate(module, engine.imports(module));
  engine.start(instance.exports);
  return engine;
}

async function bytesOf(source) {
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return source;
  const url = new URL(source, import.meta.url);
  if (url.protocol === 'file:') return (await import('node:fs/promises')).readFile(url);
  const answer = await fetch(url);
  if (!answer.ok) throw new PlumbError(INVALID, `${url} cannot be loaded: ${answer.status} ${answer.statusText}`);
  return answer.arrayBuffer();
}

class Engine {
  #wasm;

  /** The few calls to a system that a C++ library makes. */
  imports(module) {
    const kNoSuchCall = 52; // ENOSYS
    const offered = {
      clock_time_get: (_clock, _precision, at) => {
        this.#view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
        return 0;
      },
      environ_sizes_get: (count, size) => {
        this.#view().setUint32(count, 0, true);
        this.#view().setUint32(size, 0, true);
        return 0;
      },
      environ_get: () => 0,
      fd_write: (_file, pieces, count, written) => {
        const view = this.#view();
        let text = '', total = 0;
        for (let i = 0; i < count; ++i) {
          const at = view.getUint32(pieces + 8 * i, true), size = view.getUint32(pieces + 8 * i + 4, true);
          text += new TextDecoder().decode(new Uint8Array(this.#wasm.memory.buffer, at, size).slice());
          total += size;
        }
        console.error(text);
        view.setUint32(written, total, true);
        return 0;
      },
      proc_exit: (status) => {
        throw new PlumbError(-12, `the engine ended itself with ${status}`);
      },
      emscripten_notify_memory_growth: () => {},
    };
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module))
      (imports[from] ??= {})[name] = offered[name] ?? (() => kNoSuchCall);
    return imports;
  }
  start(exports) {
    this.#wasm = exports;
    exports._initialize?.();
    this.info = Object.freeze({ name: this.text(exports.plumb_info(0)), version: this.text(exports.plumb_info(1)),
      build: this.text(exports.plumb_info(2)) });
  }
  createWorld(options = {}) {
    return new World(this, options);
  }

  // For worlds.

  get wasm() {
    return this.#wasm;
  }
  #view() {
    return new DataView(this.#wasm.memory.buffer);
  }
  text(at) {
    const bytes = new Uint8Array(this.#wasm.memory.buffer);
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  }
  check(result) {
    if (result < 0) throw new PlumbError(result, this.text(this.#wasm.plumb_error()));
    return result;
  }
  /** Memory of the engine, for as long as call(address) runs. */
  with(bytes, call) {
    const at = this.#wasm.plumb_allocate(Math.max(bytes, 8));
    if (at === 0) throw new PlumbError(-5, `no ${bytes} bytes of memory are left`);
    try {
      return call(at);
    } finally {
      this.#wasm.plumb_release(at);
    }
  }
  withNumbers(numbers, call) {
    return this.with(8 * numbers.length, (at) => {
      new Float64Array(this.#wasm.memory.buffer, at, numbers.length).set(numbers);
      return call(at);
    });
  }
  withText(text, call) {
    const bytes = new TextEncoder().encode(`${text}\0`);
    return this.with(bytes.length, (at) => {
      new Uint8Array(this.#wasm.memory.buffer, at, bytes.length).set(bytes);
      return call(at);
    });
  }
  /** What a function writes as a handle. */
  handle(call) {
    return this.with(8, (at) => {
      this.check(call(at));
      return this.#view().getBigUint64(at, true);
    });
  }
  address(call) {
    return this.with(4, (at) => {
      this.check(call(at));
      return this.#view().getUint32(at, true);
    });
  }
}

class World {
  #engine;
  #wasm;
  #at;

  constructor(engine, { needs = ['rotation', 'collision', 'friction', 'kinematic'], gravity = [0, -9.81, 0],
    settings = {} }) {
    this.#engine = engine;
    this.#wasm = engine.wasm;
    const bits = BigInt(needs.reduce((all, need) => all + numberOf(NEED, need, 'need'), 0));
    const given = Object.entries(settings);
    const fill = (list, i) => {
      if (i === given.length)
        return engine.withNumbers(gravity, (g) =>
          engine.address((world) => this.#wasm.plumb_create_world(bits, g, list, given.length, world)));
      const [name, value] = given[i];
      const put = (choice) => (nameAt) => {
        engine.check(this.#wasm.plumb_setting(list, i, nameAt, choice === 0 ? Number(value) : 0, choice));
        return fill(list, i + 1);
      };
      return typeof value === 'string' ? engine.withText(value, (choice) => engine.withText(name, put(choice)))
        : engine.withText(name, put(0));
    };
    this.#at = engine.with(given.length * this.#wasm.plumb_setting_size(), (list) => fill(list, 0));
  }
  /** Its shapes, bodies and joints go with it. */
  destroy() {
    this.#wasm.plumb_destroy_world(this.#at);
    this.#at = 0;
  }

  createShape({ type, radius = 0, halfHeight = 0, halfExtents = [0, 0, 0], vertices = [], indices = [] }) {
    const kind = numberOf(SHAPE, type, 'shape');
    const numbers = [radius, halfHeight, ...halfExtents];
    return this.#engine.withNumbers(numbers, (n) => this.#engine.withNumbers(vertices, (v) =>
      this.#engine.with(4 * indices.length, (list) => {
        new Uint32Array(this.#wasm.memory.buffer, list, indices.length).set(indices);
        return this.#engine.handle((id) => this.#wasm.plumb_create_shape(this.#world(), kind, n, v,
          vertices.length / 3, list, indices.length / 3, id));
      })));
  }
  destroyShape(shape) {
    this.#engine.check(this.#wasm.plumb_destroy_shape(this.#world(), shape));
  }

  createBody({ shape = 0n, motion = 'dynamic', position = [0, 0, 0], orientation = [0, 0, 0, 1],
    linearVelocity = [0, 0, 0], angularVelocity = [0, 0, 0], density = 1000, mass = 0, friction = 0.5,
    restitution = 0, gravityScale = 1, linearDamping = 0, angularDamping = 0, flags = [] }) {
    const numbers = [...position, ...orientation, ...linearVelocity, ...angularVelocity, density, mass, friction,
      restitution, gravityScale, linearDamping, angularDamping];
    const bits = flags.reduce((all, flag) => all + numberOf(FLAG, flag, 'flag'), 0);
    return this.#engine.withNumbers(numbers, (n) => this.#engine.handle((id) =>
      this.#wasm.plumb_create_body(this.#world(), numberOf(MOTION, motion, 'motion'), bits, shape, n, id)));
  }
  destroyBody(body) {
    this.#engine.check(this.#wasm.plumb_destroy_body(this.#world(), body));
  }

  createJoint({ type, a = 0n, b, frameA = HERE, frameB = HERE, restLength = 0 }) {
    const whole = (frame) => [...(frame.position ?? HERE.position), ...(frame.orientation ?? HERE.orientation)];
    return this.#engine.withNumbers([...whole(frameA), ...whole(frameB), restLength], (n) => this.#engine.handle((id) =>
      this.#wasm.plumb_create_joint(this.#world(), numberOf(JOINT, type, 'joint'), a, b, n, id)));
  }
  destroyJoint(joint) {
    this.#engine.check(this.#wasm.plumb_destroy_joint(this.#world(), joint));
  }

  setGravity(gravity) {
    this.#engine.withNumbers(gravity, (g) => this.#engine.check(this.#wasm.plumb_set_gravity(this.#world(), g)));
  }
  step(dt) {
    this.#engine.check(this.#wasm.plumb_step(this.#world(), dt));
  }

  get bodyCount() {
    return this.#wasm.plumb_body_count(this.#world());
  }
  /** Rows of a field of those bodies, or of all in order of creation. */
  read(field, bodies = null) {
    const number = numberOf(FIELD, field, 'field');
    const count = bodies === null ? this.bodyCount : bodies.length;
    const size = count * this.#wasm.plumb_columns(number);
    return this.#engine.with(8 * count, (ids) => this.#engine.with(8 * size, (rows) => {
      if (bodies !== null) new BigUint64Array(this.#wasm.memory.buffer, ids, count).set(bodies);
      this.#engine.check(this.#wasm.plumb_read(this.#world(), number, bodies === null ? 0 : ids, count, rows));
      return new Float64Array(this.#wasm.memory.buffer, rows, size).slice();
    }));
  }
  write(field, body, row) {
    const number = numberOf(FIELD, field, 'field');
    const columns = this.#wasm.plumb_columns(number);
    if (row.length !== columns)
      throw new PlumbError(INVALID, `a row of ${field} has ${columns} numbers, not ${row.length}`);
    this.#engine.withNumbers(row, (at) =>
      this.#engine.check(this.#wasm.plumb_write(this.#world(), number, body, at)));
  }
  /** The first body that the ray hits, or null. */
  castRay(origin, translation) {
    return this.#engine.withNumbers([...origin, ...translation, 0], (at) => {
      const body = this.#engine.handle((id) => this.#wasm.plumb_cast_ray(this.#world(), at, id));
      const [fraction, ...rest] = new Float64Array(this.#wasm.memory.buffer, at, 7);
      return body === 0n ? null : { body, fraction, position: rest.slice(0, 3), normal: rest.slice(3) };
    });
  }
  /** 64 bits over all poses and velocities: the same on every machine. */
  hash() {
    return this.#engine.handle((at) => this.#wasm.plumb_hash(this.#world(), at));
  }

  #world() {
    if (this.#at === 0) throw new PlumbError(INVALID, 'this world was destroyed; make another one');
    return this.#at;
  }
}
