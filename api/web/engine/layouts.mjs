// The structs of plumb.h as they lie in the engine's memory: each member's type, in order. Offsets follow from C's rule
// of alignment; the engine is asked for the sizes when it is loaded.

const kSizes = { u32: 4, i32: 4, pointer: 4, u64: 8, f64: 8 };

function laidOut(members) {
  const fields = [];
  let size = 0, alignment = 4;
  for (const [name, type] of Object.entries(members)) {
    const [kind, count = 1] = Array.isArray(type) ? type : [type];
    const each = kSizes[kind] ?? kind.size;
    const needed = kSizes[kind] ?? kind.alignment;
    size = Math.ceil(size / needed) * needed;
    fields.push({ name, kind, count, at: size, each });
    size += count * each;
    alignment = Math.max(alignment, needed);
  }
  return { fields, size: Math.ceil(size / alignment) * alignment, alignment };
}

const vec3 = ['f64', 3], quat = ['f64', 4], pose = ['f64', 7];
const material = laidOut({ friction: 'f64', restitution: 'f64', surfaceVelocity: vec3 });
const filter = laidOut({ category: 'u32', mask: 'u32', group: 'i32', reserved: 'u32' });
const limit = laidOut({ lower: 'f64', upper: 'f64', enabled: 'u32', reserved: 'u32' });
const motor = laidOut({ targetVelocity: 'f64', maxForce: 'f64', enabled: 'u32', reserved: 'u32' });
const spring = laidOut({ rest: 'f64', frequency: 'f64', dampingRatio: 'f64', enabled: 'u32', mode: 'u32' });
const settingValue = laidOut({ type: 'u32', reserved: 'u32', number: 'f64', choice: 'pointer' });
const mass = { centreOfMass: vec3, inertia: vec3, inertiaOrientation: quat };
const axes = { axisModes: ['u32', 6], limits: [limit, 6], motors: [motor, 6], springs: [spring, 6], restLength: 'f64',
  breakForce: 'f64', breakTorque: 'f64' };

/** In the order of plumb_struct_size. */
export const LAYOUT = {
  shape: laidOut({ structSize: 'u32', type: 'u32', radius: 'f64', halfHeight: 'f64', halfExtents: vec3,
    vertices: 'pointer', vertexCount: 'u32', triangleCount: 'u32', indices: 'pointer', heights: 'pointer', rows: 'u32',
    columns: 'u32', spacing: vec3, children: 'pointer', childCount: 'u32', materialCount: 'u32', userData: 'u64',
    materials: 'pointer', triangleMaterials: 'pointer' }),
  material,
  child: laidOut({ shape: 'u64', pose, hasMaterial: 'u32', reserved: 'u32', material }),
  body: laidOut({ structSize: 'u32', motion: 'u32', flags: 'u32', locks: 'u32', shape: 'u64', pose,
    linearVelocity: vec3, angularVelocity: vec3, massMode: 'u32', reserved: 'u32', density: 'f64', mass: 'f64', ...mass,
    material, gravityScale: 'f64', linearDamping: 'f64', angularDamping: 'f64', filter, userData: 'u64',
    rollingFriction: 'f64', spinningFriction: 'f64' }),
  joint: laidOut({ structSize: 'u32', type: 'u32', a: 'u64', b: 'u64', frameA: pose, frameB: pose,
    collideConnected: 'u32', reserved: 'u32', ...axes, userData: 'u64', ratio: 'f64' }),
  world: laidOut({ structSize: 'u32', threads: 'u32', needs: 'u64', gravity: vec3, bodyCapacity: 'u32',
    contactCapacity: 'u32', jointCapacity: 'u32', settingCount: 'u32', settings: 'pointer' }),
  setting: laidOut({ name: 'pointer', value: settingValue }),
  settingInfo: laidOut({ name: 'pointer', unit: 'pointer', doc: 'pointer', type: 'u32', role: 'u32', flags: 'u32',
    choiceCount: 'u32', choices: 'pointer', minimum: 'f64', maximum: 'f64', default: settingValue }),
  report: laidOut({ structSize: 'u32', threads: 'u32', step: 'u64', bodies: 'u32', awake: 'u32', pairs: 'u32',
    contacts: 'u32', joints: 'u32', dropped: 'u32', nonfinite: 'u32', remarks: 'u32', residual: 'f64',
    phaseSeconds: ['f64', 8] }),
  contact: laidOut({ a: 'u64', b: 'u64', childA: 'u32', childB: 'u32', position: vec3, normal: vec3, depth: 'f64',
    normalImpulse: 'f64', tangentImpulse: vec3, feature: 'u64' }),
  event: laidOut({ type: 'u32', reserved: 'u32', a: 'u64', b: 'u64', joint: 'u64' }),
  ray: laidOut({ origin: vec3, translation: vec3, filter }),
  cast: laidOut({ shape: 'u64', pose, translation: vec3, filter }),
  overlap: laidOut({ shape: 'u64', pose, filter }),
  hit: laidOut({ body: 'u64', query: 'u32', child: 'u32', fraction: 'f64', position: vec3, normal: vec3 }),
  pair: laidOut({ a: 'u64', b: 'u64' }),
  bodyChange: laidOut({ body: 'u64', what: 'u32', motion: 'u32', flags: 'u32', locks: 'u32', shape: 'u64',
    massMode: 'u32', reserved: 'u32', density: 'f64', mass: 'f64', ...mass }),
  jointChange: laidOut({ joint: 'u64', what: 'u32', enabled: 'u32', collideConnected: 'u32', reserved: 'u32',
    frameA: pose, frameB: pose, ...axes }),
  posedPair: laidOut({ shapeA: 'u64', shapeB: 'u64', poseA: pose, poseB: pose }),
  pairResult: laidOut({ distance: 'f64', firstPoint: 'u32', pointCount: 'u32' }),
  point: laidOut({ position: vec3, normal: vec3, depth: 'f64', feature: 'u64' }),
  manifold: laidOut({ a: 'u64', b: 'u64', childA: 'u32', childB: 'u32', pointCount: 'u32', reserved: 'u32', normal: vec3,
    velocity: vec3, positions: ['f64', 12], depths: ['f64', 4], friction: 'f64', restitution: 'f64',
    surfaceVelocity: vec3 }),
  manifoldChange: laidOut({ manifold: 'u32', what: 'u32', friction: 'f64', restitution: 'f64', surfaceVelocity: vec3 }),
  penetration: laidOut({ body: 'u64', query: 'u32', child: 'u32', depth: 'f64', position: vec3, normal: vec3 }),
  cooked: laidOut({ structSize: 'u32', reserved: 'u32', data: 'pointer', size: 'u64' }),
  turningCast: laidOut({ shape: 'u64', pose, translation: vec3, rotation: vec3, filter }),
};

const kSet = { u32: 'setUint32', i32: 'setInt32', pointer: 'setUint32', u64: 'setBigUint64', f64: 'setFloat64' };
const kGet = { u32: 'getUint32', i32: 'getInt32', pointer: 'getUint32', u64: 'getBigUint64', f64: 'getFloat64' };

/** Members that value lacks stay as they are. */
export function put(view, at, layout, value) {
  for (const { name, kind, count, at: offset, each } of layout.fields) {
    const given = value[name];
    if (given === undefined) continue;
    for (let i = 0; i < count; ++i) {
      const one = count === 1 ? given : given[i], place = at + offset + i * each;
      if (typeof kind === 'object') put(view, place, kind, one);
      else view[kSet[kind]](place, kind === 'u64' ? BigInt(one) : Number(one), true);
    }
  }
}

export function get(view, at, layout) {
  const value = {};
  for (const { name, kind, count, at: offset, each } of layout.fields) {
    if (name === 'reserved' || name === 'structSize') continue;
    const one = (i) => typeof kind === 'object' ? get(view, at + offset + i * each, kind)
      : view[kGet[kind]](at + offset + i * each, true);
    value[name] = count === 1 ? one(0) : Array.from({ length: count }, (_, i) => one(i));
  }
  return value;
}
