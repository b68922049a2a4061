// A world: shapes, bodies, joints, and steps. Handles are bigints; 0n is none.
import { bodyChangeOf, bodyOf, contactChangeOf, filterOf, jointChangeOf, jointOf, manifoldOf, poseOf, shapeOf } from './descriptors.mjs';
import { INVALID, PlumbError } from './error.mjs';
import { LAYOUT } from './layouts.mjs';
import { bitsOf, EVENT, FIELD, JOINT_FIELD, NEED, numberOf } from './words.mjs';

const kAll = 1, kClosest = 0;

export class World {
  #engine;
  #wasm;
  #memory;
  #at;
  #userData = new Map();

  constructor(engine, { needs = ['rotation', 'collision', 'friction', 'kinematic'], gravity = [0, -9.81, 0],
    settings = {}, threads = engine.info.threads }) {
    this.#engine = engine;
    this.#wasm = engine.wasm;
    this.#memory = engine.memory;
    this.#at = this.#memory.scope(() => {
      const given = Object.entries(settings).map(([name, value]) => engine.settingOf(name, value));
      const desc = this.#memory.putStructs(LAYOUT.world, [{ threads, needs: bitsOf(NEED, needs, 'need'), gravity,
        settingCount: given.length, settings: this.#memory.putStructs(LAYOUT.setting, given) }]);
      const world = this.#memory.take(4);
      engine.check(this.#wasm.plumb_create_world(desc, world));
      return this.#memory.word(world);
    });
  }
  /** Its shapes, bodies and joints go with it. */
  destroy() {
    if (this.#engine.isAlive) this.#wasm.plumb_destroy_world(this.#at);
    this.#at = 0;
    this.#userData.clear();
  }

  // One, and many: all or none.

  createShape(options) {
    return this.createShapes([options])[0];
  }
  createShapes(list) {
    return this.#created('plumb_create_shapes', LAYOUT.shape, list, (options) => shapeOf(this.#memory, options));
  }
  createCooked(list) {
    return this.#created('plumb_create_cooked', LAYOUT.cooked, list,
      (bytes) => ({ data: this.#memory.putArray(Uint8Array, bytes), size: bytes.length }));
  }
  destroyShape(...shapes) {
    this.#call('plumb_destroy_shapes', this.#ids(shapes), shapes.length);
  }
  createBody(options) {
    return this.createBodies([options])[0];
  }
  createBodies(list) {
    const ids = this.#created('plumb_create_bodies', LAYOUT.body, list, bodyOf);
    ids.forEach((id, i) => list[i].userData !== undefined && this.#userData.set(id, list[i].userData));
    return ids;
  }
  destroyBody(...bodies) {
    this.#call('plumb_destroy_bodies', this.#ids(bodies), bodies.length);
    for (const body of bodies) this.#userData.delete(body);
  }
  createJoint(options) {
    return this.createJoints([options])[0];
  }
  createJoints(list) {
    const ids = this.#created('plumb_create_joints', LAYOUT.joint, list, jointOf);
    ids.forEach((id, i) => list[i].userData !== undefined && this.#userData.set(`joint ${id}`, list[i].userData));
    return ids;
  }
  destroyJoint(...joints) {
    this.#call('plumb_destroy_joints', this.#ids(joints), joints.length);
    for (const joint of joints) this.#userData.delete(`joint ${joint}`);
  }
  /** What was given when it was made: any value. */
  userData(body) {
    return this.#userData.get(body);
  }
  jointUserData(joint) {
    return this.#userData.get(`joint ${joint}`);
  }

  /** A living body with another motion, shape, mass, flags or locks: only what is given changes. */
  modifyBody(body, options) {
    this.#call('plumb_modify_bodies', () => this.#memory.putStructs(LAYOUT.bodyChange, [bodyChangeOf(body, options)]), 1);
  }
  /** Likewise a joint. Frames change together, and so do the six axes of limits, motors or springs. */
  modifyJoint(joint, options) {
    this.#call('plumb_modify_joints',
      () => this.#memory.putStructs(LAYOUT.jointChange, [jointChangeOf(joint, options)]), 1);
  }
  /** A mesh or height field with other vertices or heights, whole as when it was made, for all bodies that have it. */
  modifyShape(shape, options) {
    this.#call('plumb_modify_shapes', this.#ids([shape]),
      () => this.#memory.putStructs(LAYOUT.shape, [shapeOf(this.#memory, options)]), 1);
  }
  /** Whether two bodies touch, whatever their filters say; true gives the filters their say back. */
  setPairTouches(a, b, touch) {
    this.#call('plumb_set_exceptions', () => this.#memory.putStructs(LAYOUT.pair, [{ a, b }]), 1, touch ? 1 : 0);
  }

  setGravity(gravity) {
    this.#call('plumb_set_gravity', () => this.#memory.putArray(Float64Array, gravity));
  }
  /**
   * What the step did. modify(manifolds): contacts of bodies with the flag modifyContacts before they are solved; gives
   * back a list of what is to be otherwise in this step, or nothing.
   */
  step(dt, modify = null) {
    return this.#memory.scope(() => {
      const report = this.#memory.putStructs(LAYOUT.report, [{}]);
      if (modify === null) this.#call('plumb_step', dt, report);
      else this.#stepModified(dt, modify, report);
      return this.#memory.structs(LAYOUT.report, report, 1)[0];
    });
  }
  /** Whatever fails, the step comes to its end. */
  #stepModified(dt, modify, report) {
    this.#call('plumb_begin_step', dt);
    try {
      for (;;) {
        const found = this.#lent('plumb_read_manifolds', (at, count) => this.#memory.structs(LAYOUT.manifold, at, count));
        if (found.length === 0) break;
        const changes = (modify(found.map(manifoldOf)) ?? []).map(contactChangeOf);
        this.#call('plumb_modify_manifolds', () => this.#memory.putStructs(LAYOUT.manifoldChange, changes), changes.length);
      }
    } finally {
      this.#call('plumb_wait', report);
    }
  }
  /** Of the last step. */
  contacts() {
    return this.#lent('plumb_contacts', (at, count) => this.#memory.structs(LAYOUT.contact, at, count));
  }
  events() {
    return this.#lent('plumb_events', (at, count) => this.#memory.structs(LAYOUT.event, at, count))
      .map((event) => ({ ...event, type: EVENT[event.type] }));
  }

  /** In order of creation. */
  get bodies() {
    return this.#lent('plumb_bodies', (at, count) => [...this.#memory.array(BigUint64Array, at, count)]);
  }
  get bodyCount() {
    return this.#lent('plumb_bodies', (_at, count) => count);
  }
  /** Rows of a field of those bodies, or of all in order of creation. */
  read(field, bodies = null) {
    const number = numberOf(FIELD, field, 'field');
    const count = bodies === null ? this.bodyCount : bodies.length;
    const size = count * this.#wasm.plumb_columns(number);
    return this.#memory.scope(() => {
      const ids = bodies === null ? 0 : this.#memory.putArray(BigUint64Array, bodies);
      const rows = this.#memory.take(8 * size);
      this.#call('plumb_read', number, ids, count, rows);
      return this.#memory.array(Float64Array, rows, size);
    });
  }
  /** bodies: one, or a list with as many rows. */
  write(field, bodies, rows) {
    const number = numberOf(FIELD, field, 'field');
    this.#write('plumb_write', number, field, this.#wasm.plumb_columns(number), bodies, rows);
  }
  readJoints(field, joints) {
    const number = numberOf(JOINT_FIELD, field, 'field of joints');
    const size = joints.length * this.#wasm.plumb_joint_columns(number);
    return this.#memory.scope(() => {
      const rows = this.#memory.take(8 * size);
      this.#call('plumb_read_joints', number, this.#memory.putArray(BigUint64Array, joints), joints.length, rows);
      return this.#memory.array(Float64Array, rows, size);
    });
  }
  writeJoints(field, joints, rows) {
    const number = numberOf(JOINT_FIELD, field, 'field of joints');
    this.#write('plumb_write_joints', number, field, this.#wasm.plumb_joint_columns(number), joints, rows);
  }

  /** The first body that the ray hits, or null. */
  castRay(origin, translation, filter) {
    return this.castRays([{ origin, translation, filter }])[0];
  }
  /** One answer a ray, null where nothing was hit; with all: what each ray hits, nearest first. */
  castRays(rays, { all = false } = {}) {
    return this.#ask('plumb_cast_rays', LAYOUT.ray, all,
      rays.map(({ origin, translation, filter }) => ({ origin, translation, filter: filterOf(filter) })));
  }
  castShape(shape, frame, translation, filter) {
    return this.castShapes([{ shape, ...frame, translation, filter }])[0];
  }
  /** A cast with a rotation turns on its way; those of one call either all turn or none. */
  castShapes(casts, { all = false } = {}) {
    const turning = casts.some(({ rotation }) => rotation !== undefined);
    const rows = casts.map(({ shape, translation = [0, 0, 0], rotation = [0, 0, 0], filter, ...frame }) =>
      ({ shape, pose: poseOf(frame), translation, rotation, filter: filterOf(filter) }));
    return turning ? this.#ask('plumb_turning_casts', LAYOUT.turningCast, all, rows)
      : this.#ask('plumb_cast_shapes', LAYOUT.cast, all, rows);
  }
  /** The bodies that a shape overlaps, were it there. */
  overlap(shape, frame, filter) {
    return this.#hits('plumb_overlap_shapes', LAYOUT.overlap, [],
      [{ shape, pose: poseOf(frame), filter: filterOf(filter) }]).map(({ body, child }) => ({ body, child }));
  }
  /** How deep a shape overlaps bodies, were it there, the deepest first, and for each the way out. */
  penetrations(shape, frame, filter) {
    return this.#hits('plumb_penetrations', LAYOUT.overlap, [],
      [{ shape, pose: poseOf(frame), filter: filterOf(filter) }], LAYOUT.penetration).map(({ query: _, ...row }) => row);
  }
  /** Two shapes without a step: how far apart (below 0: depth; NaN: the engine does not tell), and where they touch. */
  collide({ shapeA, frameA, shapeB, frameB }) {
    return this.#memory.scope(() => {
      const pair = this.#memory.putStructs(LAYOUT.posedPair,
        [{ shapeA, shapeB, poseA: poseOf(frameA), poseB: poseOf(frameB) }]);
      const result = this.#memory.take(LAYOUT.pairResult.size), points = this.#memory.take(4);
      this.#call('plumb_collide_pairs', pair, 1, result, points);
      const [{ distance, firstPoint, pointCount }] = this.#memory.structs(LAYOUT.pairResult, result, 1);
      const at = this.#memory.word(points) + firstPoint * LAYOUT.point.size;
      return { distance, points: this.#memory.structs(LAYOUT.point, at, pointCount) };
    });
  }

  getSetting(name) {
    return this.#memory.scope(() => {
      const setting = this.#memory.putStructs(LAYOUT.setting, [this.#engine.settingOf(name)]);
      this.#call('plumb_get_setting', setting);
      const [{ value }] = this.#memory.structs(LAYOUT.setting, setting, 1);
      return this.#engine.valueOf(value);
    });
  }
  /** Takes effect in the next step. */
  setSetting(name, value) {
    this.#call('plumb_set_setting', () => this.#memory.putStructs(LAYOUT.setting, [this.#engine.settingOf(name, value)]));
  }

  /** What moves, as bytes; needs 'snapshot'. Restored while the same bodies and joints live. */
  save() {
    return this.#save(0);
  }
  /** The whole world, as bytes: who came is gone again after restore, who is gone lives, under the same handles; but userData. */
  saveWorld() {
    return this.#save(1);
  }
  #save(whole) {
    return this.#memory.scope(() => {
      const data = this.#memory.take(4), size = this.#memory.take(4);
      this.#call('plumb_save', whole, data, size);
      return this.#memory.array(Uint8Array, this.#memory.word(data), this.#memory.word(size));
    });
  }
  /** What save or saveWorld gave. */
  restore(bytes) {
    this.#call('plumb_restore', () => this.#memory.putArray(Uint8Array, bytes), bytes.length);
  }
  /** 64 bits over all poses and velocities: the same on every machine. */
  hash() {
    return this.#memory.scope(() => {
      const at = this.#memory.take(8);
      this.#call('plumb_hash', at);
      return this.#memory.view().getBigUint64(at, true);
    });
  }

  #world() {
    this.#engine.checkAlive();
    if (this.#at === 0) throw new PlumbError(INVALID, 'this world was destroyed; make another one');
    return this.#at;
  }
  /** Arguments that are functions put something into memory first. */
  #call(name, ...rest) {
    const world = this.#world();
    return this.#memory.scope(() => this.#engine.check(
      this.#wasm[name](world, ...rest.map((given) => typeof given === 'function' ? given() : given))));
  }
  #ids(handles) {
    return () => this.#memory.putArray(BigUint64Array, handles);
  }
  #created(name, layout, list, make) {
    const world = this.#world();
    return this.#memory.scope(() => {
      const descs = this.#memory.putStructs(layout, list.map(make)), ids = this.#memory.take(8 * list.length);
      this.#engine.check(this.#wasm[name](world, descs, list.length, ids));
      return [...this.#memory.array(BigUint64Array, ids, list.length)];
    });
  }
  #lent(name, read) {
    return this.#memory.scope(() => {
      const at = this.#memory.take(4), count = this.#engine.check(this.#wasm[name](this.#world(), at));
      return read(this.#memory.word(at), count);
    });
  }
  #write(name, number, field, columns, given, rows) {
    const ids = Array.isArray(given) ? given : [given];
    if (rows.length !== columns * ids.length)
      throw new PlumbError(INVALID, `${Array.isArray(given) ? `${ids.length} rows` : 'a row'} of ${field} ` +
        `${Array.isArray(given) ? 'have' : 'has'} ${columns * ids.length} numbers, not ${rows.length}`);
    this.#call(name, number, this.#ids(ids), ids.length, () => this.#memory.putArray(Float64Array, rows));
  }
  #hits(name, layout, mode, queries, row = LAYOUT.hit) {
    return this.#memory.scope(() => {
      const asked = this.#memory.putStructs(layout, queries);
      const hits = this.#memory.take(4), count = this.#memory.take(4);
      this.#call(name, ...mode, asked, queries.length, hits, count);
      return this.#memory.structs(row, this.#memory.word(hits), this.#memory.word(count));
    });
  }
  #ask(name, layout, all, queries) {
    const rows = this.#hits(name, layout, [all ? kAll : kClosest], queries);
    const told = ({ query: _, ...hit }) => hit;
    return all ? queries.map((_, i) => rows.filter((row) => row.query === i).map(told))
      : rows.map((row) => row.body === 0n ? null : told(row));
  }
}
