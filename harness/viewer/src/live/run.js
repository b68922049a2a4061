// A scene that runs: a world of the engine, stepped as the harness steps it, with what the reader changes. Knows no page.
import { accountsOf } from './accounts.js';
import { Host } from './host.js';
import { jointError } from './joint_error.js';

const kNeeds = ['contacts', 'contactImpulses', 'forces', 'queries', 'snapshot']; // beyond the scene's: for what is shown, and pulling
const kPointed = new Set(['mesh', 'heightField']);

/** Shapes with the points that stand in the header alone. */
function shapesOf({ shapes, header }) {
  return shapes.map((shape, i) => {
    if (!kPointed.has(shape.type)) return shape;
    const { vertices, triangles, heights } = header.shapes[i];
    return shape.type === 'mesh'
      ? { ...shape, vertices: vertices.flat(), indices: triangles.flat() }
      : { ...shape, heights };
  });
}

export class LiveRun {
  /** form: the world as the harness wrote it (replay/live_world.hpp). */
  constructor(engine, form) {
    this.engine = engine;
    this.form = form;
    this.shapes = shapesOf(form);
    this.host = new Host(form);
    this.dt = form.header.dt;
    this.gravity = [...form.gravity];
    /** Numbers that stand for those of all materials; null: as the scene has them. */
    this.material = { friction: null, restitution: null };
    this.settings = { ...form.settings };
    /** Called before each step. */
    this.pull = null;
    this.needs = [...new Set([...form.needs, ...kNeeds])];
    this.reset();
  }

  /** As at the start, with what was changed. */
  reset() {
    this.world?.destroy();
    const { engine, form, gravity, settings, needs } = this;
    this.world = engine.createWorld({ needs, gravity, settings, threads: 1 });
    this.host.reset();
    this.steps = 0;
    this.since = { time: 0, steps: 0 };
    this.report = null;
    this.createShapes();
    this.bodies = form.bodies.length
      ? this.world.createBodies(
          form.bodies.map((body) =>
            this.with({ ...body, shape: body.shape === undefined ? 0n : this.handles[body.shape] }),
          ),
        )
      : [];
    this.joints = form.joints.length
      ? this.world.createJoints(
          form.joints.map((joint) => ({
            ...joint,
            a: joint.a === undefined ? 0n : this.bodies[joint.a],
            b: this.bodies[joint.b],
          })),
        )
      : [];
    this.read();
  }

  with(material) {
    const { friction, restitution } = this.material;
    return {
      ...material,
      friction: friction ?? material.friction,
      restitution: restitution ?? material.restitution,
    };
  }

  /** Compounds name their children, so the others come first, in one batch. */
  createShapes() {
    const { shapes, world } = this,
      simple = shapes.flatMap(({ type }, i) => (type === 'compound' ? [] : [i])),
      made = (shape) => ({ ...shape, materials: shape.materials?.map((part) => this.with(part)) });
    this.handles = [];
    if (simple.length)
      world.createShapes(simple.map((i) => made(shapes[i]))).forEach((handle, k) => {
        this.handles[simple[k]] = handle;
      });
    shapes.forEach((shape, i) => {
      if (shape.type !== 'compound') return;
      const children = shape.children.map((child) => ({
        ...child,
        shape: this.handles[child.shape],
        material: child.material && this.with(child.material),
      }));
      this.handles[i] = world.createShape({ ...shape, children });
    });
  }

  get time() {
    return this.since.time + (this.steps - this.since.steps) * this.dt;
  }

  setDt(dt) {
    this.since = { time: this.time, steps: this.steps };
    this.dt = dt;
  }
  setGravity(gravity) {
    this.world.setGravity(gravity);
    this.gravity = gravity;
  }
  /** Of bodies at once, of parts of shapes from the next reset on. */
  setMaterial(name, value) {
    const before = this.material;
    this.material = { ...before, [name]: value };
    const rows = this.form.bodies.flatMap((body) => {
      const { friction, restitution } = this.with(body);
      return [friction, restitution];
    });
    try {
      if (this.bodies.length) this.world.write('material', this.bodies, rows);
    } catch (error) {
      this.material = before;
      throw error;
    }
  }
  /** One that is for the creation of a world alone begins the scene anew. */
  setSetting(name, value) {
    if (this.engine.settings.find((setting) => setting.name === name).creationOnly) {
      const before = { ...this.settings };
      this.settings[name] = value;
      try {
        this.reset();
      } catch (error) {
        this.settings = before;
        this.reset();
        throw error;
      }
      return;
    }
    this.world.setSetting(name, value);
    this.settings[name] = value;
  }
  getSetting(name) {
    return this.world.getSetting(name);
  }

  /** Milliseconds that the engine took. */
  step() {
    this.host.beforeStep(this);
    this.pull?.(this);
    const begin = performance.now();
    this.report = this.world.step(this.dt);
    const took = performance.now() - begin;
    ++this.steps;
    this.read();
    return took;
  }

  read() {
    this.poses = this.world.read('pose');
    this.velocities = this.world.read('velocity');
  }

  get hash() {
    return this.world.hash().toString(16).padStart(16, '0');
  }

  accounts() {
    return accountsOf(this.form.masses, this.poses, this.velocities, this.gravity);
  }

  /** [{joint, gap, angle}] of the joints that there are. */
  jointErrors() {
    return this.form.joints.flatMap((joint, number) =>
      this.has(number) ? [{ joint: number, ...jointError(joint, this.poses) }] : [],
    );
  }

  /** A handle tells whether its joint is there; only those that may break are asked. */
  has(number) {
    if (this.host.gone.has(number)) return false;
    const { breakForce, breakTorque } = this.form.joints[number];
    if (!(breakForce > 0 || breakTorque > 0)) return true;
    try {
      this.world.readJoints('coordinates', [this.joints[number]]);
      return true;
    } catch {
      return false;
    }
  }
}
