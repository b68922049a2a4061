// Contacts: who may push whom, with which material, and what came of it. MuJoCo takes the larger friction of two and knows
// no restitution, so every contact gets the pair's own between its detection and its solution. The package hands out
// copies of contacts; those that it solves are where its arena begins.
import { DYNAMIC } from '../../rows.mjs';
import { add, dot, pairKey, rotate, scale, sub } from '../../algebra.mjs';
import { three } from './model.mjs';
import { impedanceOf } from './settings.mjs';

const NUMBERS = 73, WORDS = 2 * NUMBERS;  // of mjContact: 64 bits, 32 bits
const DIST = 0, POS = 1, FRAME = 4, FRICTION = 14, SOLREF = 19, SOLIMP = 23;
const DIM = 132, GEOM1 = 133, GEOM2 = 134, EXCLUDE = 143, ADDRESS = 144;
const NOT_SOLVED = 1;  // as MuJoCo marks contacts in a gap
const LEAST_FRICTION = 1e-5, MOST_IMPEDANCE = 0.9999;
/** Of critical damping: with less what should not bounce does, at 1 with e^-2 of its speed, as nothing holds it back. */
const NO_REBOUND = 3;

/** Those of a step, as the numbers that MuJoCo solves. */
export class Contacts {
  constructor({ model, data, d }) {
    this.count = data.ncon;
    this.elliptic = model.opt.cone === 1;
    const { buffer, byteOffset } = this.count > 0 ? d('arena') : new Uint8Array();
    this.numbers = new Float64Array(buffer, byteOffset, NUMBERS * this.count);
    this.words = new Int32Array(buffer, byteOffset, WORDS * this.count);
  }
  number(i, what) { return this.numbers[NUMBERS * i + what]; }
  word(i, what) { return this.words[WORDS * i + what]; }
  geoms(i) { return [this.word(i, GEOM1), this.word(i, GEOM2)]; }
  address(i) { return this.word(i, ADDRESS); }
  dist(i) { return this.number(i, DIST); }
  dimensions(i) { return this.word(i, DIM); }
  friction(i, k) { return this.number(i, FRICTION + k); }
  position(i) { return three(this.numbers, NUMBERS * i + POS); }
  axis(i, k) { return three(this.numbers, NUMBERS * i + FRAME + 3 * k); }
  exclude(i) { this.words[WORDS * i + EXCLUDE] = NOT_SOLVED; }
  set(i, { dimensions, friction, solref, solimp }) {
    this.words[WORDS * i + DIM] = dimensions;
    this.numbers.set(friction, NUMBERS * i + FRICTION);
    this.numbers.set(solref, NUMBERS * i + SOLREF);
    this.numbers.set(solimp, NUMBERS * i + SOLIMP);
  }
}

/** Whether contacts lie in memory as this file has it: two of a box on a plane, beside the copies that the package gives. */
export function knowsContacts(M) {
  const model = M.MjModel.from_xml_string('<mujoco><worldbody><geom type="plane" size="0 0 1"/><body pos="0 0 .4"><freejoint/><geom type="box" size=".5 .5 .5" friction=".3 .2 .1"/></body></worldbody></mujoco>');
  const data = new M.MjData(model);
  M.mj_forward(model, data);
  const mine = new Contacts({ model, data, d: (name) => data[name] });
  const told = data.contact, one = told.get(1), same = (a, b) => Array.from(a).every((x, k) => x === b[k]);
  const fits = mine.count === 4 && mine.dist(1) === one.dist && same(mine.position(1), one.pos) && same(mine.axis(1, 2), one.frame.slice(6)) &&
    same([0, 1, 2, 3, 4].map((k) => mine.friction(1, k)), one.friction) && same([0, 1], [one.geom1, one.geom2]) && same(mine.geoms(1), [0, 1]) &&
    mine.dimensions(1) === one.dim && mine.address(1) === one.efc_address && mine.number(1, SOLREF) === one.solref[0] &&
    same(mine.numbers.slice(NUMBERS + SOLIMP, NUMBERS + SOLIMP + 5), one.solimp) && mine.word(1, EXCLUDE) === one.exclude;
  for (const object of [one, told, data, model]) object.delete();
  return fits;
}

/** Of a damped spring that keeps the share e of the speed. */
function dampingRatioOf(e) {
  const log = Math.log(Math.max(e, 1e-3));
  return -log / Math.hypot(Math.PI, log);
}
/** Negative numbers are stiffness and damping themselves: of a spring that throws back within the given time. */
function bouncy(restitution, time) {
  const rate = Math.PI / time;
  return { solref: [-rate * rate, -2 * dampingRatioOf(restitution) * rate], solimp: [MOST_IMPEDANCE, MOST_IMPEDANCE, 0.001, 0.5, 2] };
}

const materialOf = ({ body, own }) => own ?? body.desc.material;

/** Each contact's own material; what may not be solved is left out. Gives the pairs of bodies that overlap a sensor. */
export function judge(world, contacts, h) {
  const { settings: s, needs } = world, seen = [];
  const soft = { solref: [s.contact_time, needs.has('restitution') ? Math.max(s.contact_damping_ratio, NO_REBOUND) : s.contact_damping_ratio], solimp: impedanceOf(s) };
  for (let i = 0; i < contacts.count; ++i) {
    const [one, two] = contacts.geoms(i).map((geom) => world.model.geoms[geom]), a = one.body, b = two.body;
    const allowed = a !== b && world.collides(a.slot, b.slot), sensors = [a, b].filter(({ slot }) => world.isSensor(slot)).length;
    if (allowed && sensors === 1 && contacts.dist(i) <= 0) seen.push(a.slot, b.slot);
    if (!allowed || sensors > 0 || !needs.has('collision') || !(a.desc.motion === DYNAMIC || b.desc.motion === DYNAMIC)) {
      contacts.exclude(i);
      continue;
    }
    const m = materialOf(one), n = materialOf(two), friction = Math.sqrt(m.friction * n.friction), restitution = Math.max(m.restitution, n.restitution);
    const rolling = Math.max(a.rolling, b.rolling), spinning = Math.max(a.spinning, b.spinning), least = (x) => Math.max(x, LEAST_FRICTION);
    contacts.set(i, {
      dimensions: rolling > 0 ? 6 : spinning > 0 ? 4 : friction > 0 ? 3 : 1,
      friction: [friction, friction, spinning, rolling, rolling].map(least),
      ...(restitution > 0 ? bouncy(restitution, s.bounce_substeps * h) : soft),
    });
  }
  return seen;
}

/** Surfaces that move are contacts of which the wanted sliding speed is not 0. */
export function driveSurfaces(world, contacts) {
  const { model } = world, aims = model.data.efc_aref, rates = model.data.efc_KBIP;
  const surface = (geom) => rotate(geom.body.pose.orientation, materialOf(geom).surfaceVelocity);
  for (let i = 0; i < contacts.count; ++i) {
    const start = contacts.address(i);
    if (start < 0 || contacts.dimensions(i) === 1) continue;
    const [one, two] = contacts.geoms(i).map((geom) => surface(model.geoms[geom])), slide = sub(one, two);
    const drive = (row, speed) => { aims[start + row] += rates[4 * (start + row) + 1] * speed; };
    for (let k = 0; k < 2; ++k) {
      const wanted = dot(slide, contacts.axis(i, 1 + k));
      if (contacts.elliptic) drive(1 + k, wanted);
      else {  // edges of the pyramid: the normal and a share of a tangent, either way
        drive(2 * k, contacts.friction(i, k) * wanted);
        drive(2 * k + 1, -contacts.friction(i, k) * wanted);
      }
    }
  }
}

/** N along the contact's axes: of a pyramid its edges' sum, and the share of each tangent. */
function forceOf(contacts, i, efc) {
  const start = contacts.address(i), dimensions = contacts.dimensions(i), slides = Math.min(dimensions - 1, 2);
  if (contacts.elliptic || dimensions === 1) return [0, 1, 2].map((k) => (k <= slides ? efc[start + k] : 0));
  const force = [0, 0, 0];
  for (let edge = 0; edge < 2 * (dimensions - 1); ++edge) force[0] += efc[start + edge];
  for (let k = 0; k < slides; ++k) force[1 + k] = contacts.friction(i, k) * (efc[start + 2 * k] - efc[start + 2 * k + 1]);
  return force;
}

/** What geoms had with each other in a step: points of the first sub-step in which they touched, impulses of all. */
export class Impulses {
  constructor() {
    this.pairs = new Map();
    this.touching = new Map();
    this.solved = 0;
  }
  gather(world, contacts, h, subStep) {
    const { model } = world, efc = contacts.count > 0 ? model.data.efc_force : [];
    this.solved = 0;
    for (let i = 0; i < contacts.count; ++i) {
      if (contacts.address(i) < 0) continue;
      ++this.solved;
      const geoms = contacts.geoms(i), [one, two] = geoms.map((geom) => model.geoms[geom]), force = forceOf(contacts, i, efc), key = pairKey(...geoms);
      let pair = this.pairs.get(key);
      if (!pair) this.pairs.set(key, (pair = { one, two, points: [], sum: [0, 0, 0], subStep }));
      for (let k = 0; k < 3; ++k) pair.sum = add(pair.sum, scale(h * force[k], contacts.axis(i, k)));
      if (pair.subStep === subStep) pair.points.push({ position: contacts.position(i), normal: contacts.axis(i, 0), depth: -contacts.dist(i), impulse: h * force[0] });
      if (contacts.dist(i) <= 0 || force[0] > 0) this.touch(one.body.slot, two.body.slot);
    }
  }
  touch(a, b) { this.touching.set(pairKey(a, b), [a, b]); }

  /** As rows of WIRE.md. What a pair has pushed with over the step is shared out by what each point pushed with at first. */
  rows() {
    const rows = [];
    for (const { one, two, points, sum } of this.pairs.values()) {
      const all = points.reduce((total, { impulse }) => total + impulse, 0);
      for (const { position, normal, depth, impulse } of points) {
        const share = all > 0 ? impulse / all : 1 / points.length, along = dot(sum, normal);
        rows.push(one.body.slot, two.body.slot, one.child, two.child, ...position, ...normal, depth,
          share * along, ...scale(share, sub(sum, scale(along, normal))), 0);
      }
    }
    return rows;
  }
}
