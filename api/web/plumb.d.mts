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
  | 'queries' | 'surfaceVelocity' | 'jointReactions' | 'snapshot';

/** Columns: pose 7, velocity 6, forceAtPoint and impulseAtPoint 6, kinematicTarget 7, mass 11, material and damping 2,
 * awake and gravityScale 1, the others 3. */
export type Field =
  | 'pose' | 'velocity' | 'force' | 'torque' | 'impulse' | 'angularImpulse' | 'forceAtPoint' | 'impulseAtPoint'
  | 'awake' | 'kinematicTarget' | 'mass' | 'material' | 'gravityScale' | 'damping';

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
  settings?: Readonly<Record<string, number | string>>;
}

export type ShapeOptions =
  | { type: 'sphere'; radius: number }
  | { type: 'box'; halfExtents: Vec3 }
  | { type: 'capsule' | 'cylinder'; radius: number; halfHeight: number }
  | { type: 'hull'; vertices: ArrayLike<number> }
  | { type: 'mesh'; vertices: ArrayLike<number>; indices: ArrayLike<number> }
  | { type: 'plane' };

export interface BodyOptions extends Frame {
  shape?: Shape;
  motion?: 'static' | 'kinematic' | 'dynamic';
  linearVelocity?: Vec3;
  angularVelocity?: Vec3;
  /** kg/m3; 1000. */
  density?: number;
  /** kg, instead of the density. */
  mass?: number;
  friction?: number;
  restitution?: number;
  gravityScale?: number;
  linearDamping?: number;
  angularDamping?: number;
  flags?: readonly ('sensor' | 'ccd' | 'noRotation' | 'asleep' | 'neverSleeps')[];
}

export interface JointOptions {
  type: 'ball' | 'hinge' | 'slider' | 'distance' | 'fixed' | 'universal';
  /** Left out: the world. */
  a?: Body;
  b: Body;
  frameA?: Frame;
  frameB?: Frame;
  restLength?: number;
}

export interface Hit {
  body: Body;
  fraction: number;
  position: number[];
  normal: number[];
}

/** Calls throw PlumbError and change nothing then. */
export interface World {
  createShape(options: ShapeOptions): Shape;
  destroyShape(shape: Shape): void;
  createBody(options: BodyOptions): Body;
  destroyBody(body: Body): void;
  createJoint(options: JointOptions): Joint;
  destroyJoint(joint: Joint): void;
  setGravity(gravity: Vec3): void;
  /** s */
  step(dt: number): void;
  readonly bodyCount: number;
  /** Rows one after another: of those bodies, or of all in order of creation. */
  read(field: Field, bodies?: readonly Body[] | null): Float64Array;
  write(field: Field, body: Body, row: ArrayLike<number>): void;
  castRay(origin: Vec3, translation: Vec3): Hit | null;
  /** 64 bits over all poses and velocities: the same on every machine. */
  hash(): bigint;
  /** Its shapes, bodies and joints go with it. */
  destroy(): void;
}

export interface Engine {
  readonly info: Readonly<{ name: string; version: string; build: string }>;
  createWorld(options?: WorldOptions): World;
}

/** source: where the .wasm is, its bytes, or what was compiled of it. */
export function load(source: string | URL | BufferSource | WebAssembly.Module): Promise<Engine>;
