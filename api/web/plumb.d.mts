export type Vec3 = readonly [x: number, y: number, z: number];
/** Unit length. */
export type Quat = readonly [x: number, y: number, z: number, w: number];
export interface Frame {
  position?: Vec3;
  orientation?: Quat;
}

/** Handles; 0n is none. */
export type Shape = bigint;
export type Body = bigint;
export type Joint = bigint;

export type Need =
  | 'rotation' | 'collision' | 'friction' | 'restitution' | 'joints' | 'ccd' | 'sleeping' | 'events' | 'contacts'
  | 'contactImpulses' | 'sensors' | 'kinematic' | 'gyroscopic' | 'damping' | 'forces' | 'axisLocks' | 'filters'
  | 'queries' | 'surfaceVelocity' | 'jointReactions' | 'snapshot' | 'contactModification'
  | 'rollingFriction';

/** Columns: pose 7, velocity 6, forceAtPoint and impulseAtPoint 6, kinematicTarget 7, mass 11, material and damping 2,
 * awake and gravityScale 1, the others 3. */
export type Field =
  | 'pose' | 'velocity' | 'force' | 'torque' | 'impulse' | 'angularImpulse' | 'forceAtPoint' | 'impulseAtPoint'
  | 'awake' | 'kinematicTarget' | 'mass' | 'material' | 'gravityScale' | 'damping' | 'surfaceVelocity' | 'filter'
  | 'rollingFriction';

/** Columns: coordinates 6, reaction 6, motor 12 (target velocity, max force, of each of the six axes in turn), springRest
 *  6 (where the springs of the six axes rest; of a distance joint first its restLength). */
export type JointField = 'coordinates' | 'reaction' | 'motor' | 'springRest';

/** A failed call. code: PlumbResult, below 0. */
export class PlumbError extends Error {
  constructor(code: number, text: string);
  readonly code: number;
}

export interface WorldOptions {
  /** What the scene needs; the engine leaves out all the rest. Rotation, collision, friction and kinematic bodies. */
  needs?: readonly Need[];
  /** m/s2; 0 -9.81 0. */
  gravity?: Vec3;
  /** By name: numbers, or words of a choice. */
  settings?: Readonly<Record<string, number | string | boolean>>;
  /** How many work on a step, of those that the engine has; all. The bits of results do not depend on it. */
  threads?: number;
}

export interface Material {
  /** Coulomb; 0.5. A pair's is the geometric mean. */
  friction?: number;
  /** 0..1; 0. A pair's is the larger. */
  restitution?: number;
  /** m/s in the body's frame, for conveyors; needs surfaceVelocity. */
  surfaceVelocity?: Vec3;
}

/** A sphere, box, capsule, cylinder or hull, placed in a compound. */
export interface Child extends Frame {
  shape: Shape;
  /** Left out: the body's. */
  material?: Material;
}

/** For each triangle the number of its material, or -1: the body's. A height field has two a cell, cell by cell along x,
 * row by row. A triangle's material has no surfaceVelocity. */
export interface TriangleMaterials {
  materials?: readonly Material[];
  triangleMaterials?: ArrayLike<number>;
}

/** Metres. Capsules and cylinders stand along y. */
export type ShapeOptions =
  | { type: 'sphere'; radius: number }
  | { type: 'box'; halfExtents: Vec3 }
  | { type: 'capsule' | 'cylinder'; radius: number; halfHeight: number }
  | { type: 'hull'; vertices: ArrayLike<number> }
  | ({ type: 'mesh'; vertices: ArrayLike<number>; indices: ArrayLike<number> } & TriangleMaterials)
  /** rows (along z) times columns (along x) heights; spacing along x and z. The origin is the middle. */
  | ({ type: 'heightField'; rows: number; columns: number; heights: ArrayLike<number>; spacing: readonly [number, number] }
    & TriangleMaterials)
  | { type: 'plane' }
  | { type: 'compound'; children: readonly Child[] };

export type Motion = 'static' | 'kinematic' | 'dynamic';
export type Flag = 'sensor' | 'ccd' | 'noRotation' | 'asleep' | 'neverSleeps' | 'modifyContacts';
export type Lock = 'linearX' | 'linearY' | 'linearZ' | 'angularX' | 'angularY' | 'angularZ';

/** Two may touch if equal groups other than 0 say so (above 0), or each one's category is in the other's mask. */
export interface Filter {
  category?: number;
  mask?: number;
  group?: number;
}

export interface MassOptions {
  /** kg/m3; 1000. */
  density?: number;
  /** kg, instead of the density. */
  mass?: number;
  /** Principal moments, kg m2: then the mass, the centre and the orientation of the moments are as given, too. */
  inertia?: Vec3;
  centreOfMass?: Vec3;
  inertiaOrientation?: Quat;
}

export interface BodyOptions extends Frame, MassOptions, Material {
  shape?: Shape;
  motion?: Motion;
  linearVelocity?: Vec3;
  angularVelocity?: Vec3;
  gravityScale?: number;
  /** m, the greatest moment along a contact relative to its normal force; needs rollingFriction. */
  rollingFriction?: number;
  /** Likewise about its normal. */
  spinningFriction?: number;
  /** 1/s */
  linearDamping?: number;
  angularDamping?: number;
  flags?: readonly Flag[];
  locks?: readonly Lock[];
  filter?: Filter;
  /** Any value: World.userData gives it back. */
  userData?: unknown;
}

/** What is given changes; velocities, poses and materials are fields. */
export interface BodyChange extends MassOptions {
  motion?: Motion;
  shape?: Shape;
  flags?: readonly Flag[];
  locks?: readonly Lock[];
}

export type Axis = 'x' | 'y' | 'z' | 'angularX' | 'angularY' | 'angularZ';
type OfAxes<Value> = Partial<Record<Axis, Value>>;

/** About rest, m or rad: by frequency, Hz, and damping ratio, of which 1 is critical; or by stiffness, N/m or N m/rad, and
 *  damping, N s/m or N m s/rad. */
export type Spring = { rest?: number } &
  ({ frequency: number; dampingRatio?: number } | { stiffness?: number; damping?: number });

export interface JointRow {
  frameA?: Frame;
  frameB?: Frame;
  /** Of a generic joint; axes that are not named are free. */
  axes?: OfAxes<'free' | 'locked' | 'limited'>;
  /** Lower and upper, m or rad. */
  limits?: OfAxes<readonly [lower: number, upper: number]>;
  /** m/s or rad/s; N or N m. */
  motors?: OfAxes<{ targetVelocity?: number; maxForce: number }>;
  springs?: OfAxes<Spring>;
  restLength?: number;
  /** N and N m; 0: never breaks. */
  breakForce?: number;
  breakTorque?: number;
  collideConnected?: boolean;
}

export interface JointOptions extends JointRow {
  type: 'ball' | 'hinge' | 'slider' | 'distance' | 'fixed' | 'universal' | 'generic' | 'swing_twist' | 'gear' |
    'rack_and_pinion';
  /** Left out: the world. */
  a?: Body;
  b: Body;
  /** Of a gear: turn of a + ratio * turn of b stays; of a rack_and_pinion: of a's turn by b's way, rad/m. Not 0. */
  ratio?: number;
  userData?: unknown;
}

/** What is given changes, together with what is beside it: both frames; limits, axes and rest length; both strengths. */
export interface JointChange extends JointRow {
  enabled?: boolean;
}

export interface Hit {
  body: Body;
  /** Of a compound, or triangle of a mesh. */
  child: number;
  fraction: number;
  position: number[];
  normal: number[];
}

export interface Contact {
  a: Body;
  b: Body;
  childA: number;
  childB: number;
  position: number[];
  /** From a to b. */
  normal: number[];
  /** m; below 0: a gap. */
  depth: number;
  /** N s on b; NaN where the engine does not tell. */
  normalImpulse: number;
  tangentImpulse: number[];
  feature: bigint;
}

export interface Event {
  type: 'contactBegin' | 'contactEnd' | 'sensorEnter' | 'sensorLeave' | 'wake' | 'sleep' | 'jointBroken';
  /** The sensor, or who sleeps or wakes. */
  a: Body;
  b: Body;
  joint: Joint;
}

export interface StepReport {
  threads: number;
  step: bigint;
  bodies: number;
  awake: number;
  pairs: number;
  contacts: number;
  joints: number;
  dropped: number;
  nonfinite: number;
  remarks: number;
  residual: number;
  phaseSeconds: number[];
}

export interface Ray {
  origin: Vec3;
  translation: Vec3;
  filter?: Filter;
}
export interface Cast extends Frame {
  shape: Shape;
  translation: Vec3;
  /** rad, world axes, at most 2 pi long: turned by it on the way, about the frame's position; one of both may be 0. */
  rotation?: Vec3;
  filter?: Filter;
}

/** Where two shapes touch or are about to, before the solver sees it. */
export interface Manifold {
  a: Body;
  b: Body;
  childA: number;
  childB: number;
  /** Unit, from a to b. */
  normal: number[];
  /** Of b against a where they touch, m/s. */
  velocity: number[];
  /** Up to four; depth above 0: overlap, m. */
  points: { position: number[]; depth: number }[];
  friction: number;
  restitution: number;
  surfaceVelocity: number[];
}
/** Of manifolds[manifold]; what is left out stays. */
export interface ContactChange {
  manifold: number;
  /** true: in this step the two do not touch there. */
  disabled?: boolean;
  friction?: number;
  restitution?: number;
  /** Of b's surface over a's, m/s. */
  surfaceVelocity?: Vec3;
}

/** Calls throw PlumbError and change nothing then. */
export interface World {
  createShape(options: ShapeOptions): Shape;
  createShapes(list: readonly ShapeOptions[]): Shape[];
  /** What Engine.cook gave, here or wherever else this engine runs. */
  createCooked(list: readonly Uint8Array[]): Shape[];
  destroyShape(...shapes: Shape[]): void;
  createBody(options: BodyOptions): Body;
  createBodies(list: readonly BodyOptions[]): Body[];
  destroyBody(...bodies: Body[]): void;
  createJoint(options: JointOptions): Joint;
  createJoints(list: readonly JointOptions[]): Joint[];
  destroyJoint(...joints: Joint[]): void;
  userData(body: Body): unknown;
  jointUserData(joint: Joint): unknown;
  modifyBody(body: Body, change: BodyChange): void;
  modifyJoint(joint: Joint, change: JointChange): void;
  /** Of meshes and height fields: whole, and of the type that the shape has. */
  modifyShape(shape: Shape, options: ShapeOptions): void;
  /** false: the two never touch; true: their filters decide again. */
  setPairTouches(a: Body, b: Body, touch: boolean): void;

  setGravity(gravity: Vec3): void;
  /**
   * s. modify: sees contacts of bodies with the flag modifyContacts before they are solved, and gives back what is to be
   * otherwise in this step; once for each part of a step that finds some. Needs contactModification.
   */
  step(dt: number, modify?: ((manifolds: Manifold[]) => readonly ContactChange[] | void) | null): StepReport;
  /** Of the last step; needs contacts, and contactImpulses for impulses. */
  contacts(): Contact[];
  /** Of the last step; needs events or sensors. */
  events(): Event[];

  readonly bodyCount: number;
  /** In order of creation. */
  readonly bodies: Body[];
  /** Rows one after another: of those bodies, or of all in order of creation. */
  read(field: Field, bodies?: readonly Body[] | null): Float64Array;
  /** Of one body, or of a list with as many rows. */
  write(field: Field, bodies: Body | readonly Body[], rows: ArrayLike<number>): void;
  readJoints(field: JointField, joints: readonly Joint[]): Float64Array;
  writeJoints(field: 'motor' | 'springRest', joints: Joint | readonly Joint[], rows: ArrayLike<number>): void;

  castRay(origin: Vec3, translation: Vec3, filter?: Filter): Hit | null;
  castRays(rays: readonly Ray[], options?: { all?: false }): (Hit | null)[];
  castRays(rays: readonly Ray[], options: { all: true }): Hit[][];
  castShape(shape: Shape, frame: Frame, translation: Vec3, filter?: Filter): Hit | null;
  castShapes(casts: readonly Cast[], options?: { all?: false }): (Hit | null)[];
  castShapes(casts: readonly Cast[], options: { all: true }): Hit[][];
  overlap(shape: Shape, frame: Frame, filter?: Filter): { body: Body; child: number }[];
  /** The deepest first; normal points from the body to the shape: the way out, by depth, m. */
  penetrations(shape: Shape, frame: Frame, filter?: Filter): {
    body: Body;
    child: number;
    depth: number;
    position: number[];
    normal: number[];
  }[];
  /** How far apart (below 0: depth; NaN: the engine does not tell), and where they touch; normals from A to B. */
  collide(pair: { shapeA: Shape; frameA?: Frame; shapeB: Shape; frameB?: Frame }): {
    distance: number;
    points: { position: number[]; normal: number[]; depth: number; feature: bigint }[];
  };

  getSetting(name: string): number | string | boolean;
  setSetting(name: string, value: number | string | boolean): void;
  /** What moves, as bytes; needs snapshot. Restored while the same bodies and joints live. */
  save(): Uint8Array;
  /** The whole world, as bytes: who came is gone again after restore, who is gone lives, under the same handles; but userData. */
  saveWorld(): Uint8Array;
  /** What save or saveWorld gave. */
  restore(bytes: Uint8Array): void;
  /** 64 bits over all poses and velocities: the same on every machine. */
  hash(): bigint;
  /** Its shapes, bodies and joints go with it. */
  destroy(): void;
}

export interface Setting {
  readonly name: string;
  readonly unit: string;
  readonly doc: string;
  readonly type: 'bool' | 'int' | 'float' | 'choice';
  readonly role: 'quality' | 'speed' | 'behaviour';
  readonly creationOnly: boolean;
  readonly choices: readonly string[];
  readonly minimum: number;
  readonly maximum: number;
  readonly default: number | string | boolean;
}

export interface Engine {
  /** threads: how many its worlds may have; remark: where these are fewer than were asked for, why, else ''. */
  readonly info: Readonly<{ name: string; version: string; build: string; threads: number; remark: string }>;
  readonly settings: readonly Setting[];
  createWorld(options?: WorldOptions): World;
  /** Its worlds are no more, and its threads end. */
  dispose(): void;
  /** The bytes of a shape that was worked out ahead, for World.createCooked; not of a compound. */
  cook(options: ShapeOptions): Uint8Array;
  /** How truly it has a thing: capability('shape', 'mesh'), capability('joint', 'generic'). */
  capability(kind: 'shape' | 'pair' | 'joint' | 'jointFeature' | 'query' | 'fieldRead' | 'fieldWrite' | 'need' | 'event'
    | 'phaseTime' | 'residual' | 'snapshot' | 'hostJobs' | 'childMaterial' | 'modify' | 'manifold' | 'closest'
    | 'triangleMaterial' | 'cooking' | 'hostMemory',
    of?: string | number, with_?: string | number): 'none' | 'approximate' | 'emulated' | 'native';
}

export type Source = string | URL | BufferSource | WebAssembly.Module;
export interface LoadOptions {
  /** How many threads may work on a step: 1 to 64, or 'auto', one for each processor but no more than 8; 1. More than one
   *  takes memory that may be shared: any Node, and pages that are cross-origin isolated. Elsewhere there is one. */
  threads?: number | 'auto';
}
/** source: where the .wasm is, its bytes, or what was compiled of it; left out: beside the module, the one that suits. */
export function load(source?: Source | null, options?: LoadOptions): Promise<Engine>;
export function load(options: LoadOptions): Promise<Engine>;
