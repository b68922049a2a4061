// Which joints are links of MuJoCo's trees, and who is whose child. Most are: a body is the child of the other and moves
// along the joint's free axes. What would close a loop, and rods, are constraints between bodies that both move by
// themselves.
import { BALL, DISTANCE, DYNAMIC, FIXED, GENERIC, HINGE, KINEMATIC, LIMITED, LOCKED, SLIDER, STATIC, UNIVERSAL } from '../../rows.mjs';
import { scale } from '../../algebra.mjs';
import { refuse } from '../../base.mjs';

const AXES = { [BALL]: 0b111000, [HINGE]: 0b001000, [SLIDER]: 0b000001, [DISTANCE]: 0, [FIXED]: 0, [UNIVERSAL]: 0b011000 };
const NAMES = { [BALL]: 'ball', [HINGE]: 'hinge', [SLIDER]: 'slider', [DISTANCE]: 'distance', [FIXED]: 'fixed', [UNIVERSAL]: 'universal', [GENERIC]: 'generic' };
export const TURNS = 0b111000, ABOUT_X = 0b001000;

/** Bits: the axes that a joint leaves free or limits. A rod has none. */
export function openAxes({ type, axes }) {
  if (type !== GENERIC) return AXES[type];
  return axes.reduce((open, { mode }, axis) => (mode === LOCKED ? open : open | (1 << axis)), 0);
}
export const isLimited = ({ type, axes }, axis) => (type === GENERIC ? axes[axis].mode === LIMITED : axes[axis].limit.enabled);

/** Whether none of these axes that are open has a limit, a motor or a spring. */
function asksNothing(desc, axes) {
  const open = openAxes(desc) & axes;
  return desc.axes.every(({ motor, spring }, axis) => !(open & (1 << axis)) || !(isLimited(desc, axis) || motor.enabled || spring.enabled));
}
/** Whether all three turns are MuJoCo's ball, which knows no single axes: nothing is asked of any of them. */
export const isPlainBall = (desc) => (openAxes(desc) & TURNS) === TURNS && asksNothing(desc, TURNS);

/** Whether it can be held where it closes a loop. */
function canCloseALoop(desc) {
  if (desc.type === DISTANCE) return true;
  const open = openAxes(desc);
  return asksNothing(desc, open) && [0, TURNS, ABOUT_X].includes(open);
}

const moves = (body) => body?.desc.motion === DYNAMIC;
const WORLD = -1;
/** All that stands still is one. */
const numberOf = (body) => (body === null || body.desc.motion === STATIC ? WORLD : body.slot);

/** Disjoint sets (Tarjan 1975) of bodies that hang together; of some nothing moves the root. */
class BodySets {
  constructor(rooted) {
    this.parent = new Map();
    this.rooted = new Set(rooted);
  }
  find(i) {
    while ((this.parent.get(i) ?? i) !== i) i = this.parent.get(i);
    return i;
  }
  /** False where they hang together already, or both have such a root. */
  join(i, k) {
    i = this.find(i);
    k = this.find(k);
    if (i === k || (this.rooted.has(i) && this.rooted.has(k))) return false;
    if (this.rooted.has(k)) this.parent.set(i, k);
    else this.parent.set(k, i);
    return true;
  }
}

/** Joints that could not close a loop become links first, else those that were made first. Refuses where one had to. */
function chooseLinks(bodies, joints) {
  const sets = new BodySets([WORLD, ...[...bodies.values()].filter(({ desc }) => desc.motion === KINEMATIC).map(({ slot }) => slot)]);
  const turns = [...joints.values()].filter(({ desc, a, b }) => desc.type !== DISTANCE && (moves(a) || moves(b)));
  const inTurn = [false, true].flatMap((closes) => turns.filter(({ desc }) => canCloseALoop(desc) === closes));
  return inTurn.filter(({ desc, a, b }) => {
    if (sets.join(numberOf(a), numberOf(b))) return true;
    if (!canCloseALoop(desc))
      refuse(`a ${NAMES[desc.type]} joint would close a loop, which MuJoCo has for ball, hinge, fixed and distance joints without limits, motors and springs`);
    return false;
  });
}

/**
 * Sets the links of bodies and joints. Gives the bodies in the order in which MuJoCo numbers them, each before its
 * children and these right after it, and those of them that are children of the world.
 */
export function growTree(bodies, joints) {
  const links = chooseLinks(bodies, joints), linksOf = new Map(), seen = new Set(), roots = [], order = [];
  for (const joint of joints.values()) joint.isLink = false;
  for (const body of bodies.values()) Object.assign(body, { parent: null, link: null, reversed: false, shift: [0, 0, 0], children: [] });
  for (const link of links) {
    link.isLink = true;
    for (const end of [link.a, link.b]) if (end !== null) linksOf.set(end, [...(linksOf.get(end) ?? []), link]);
  }
  const plant = (root) => {
    seen.add(root);
    roots.push(root);
    for (const reached = [root]; reached.length > 0;) {
      const parent = reached.shift();
      for (const link of linksOf.get(parent) ?? []) {
        const child = link.a === parent ? link.b : link.a;
        if (!moves(child) || seen.has(child)) continue;
        seen.add(child);
        Object.assign(child, { parent, link, reversed: child === link.a });
        parent.children.push(child);
        reached.push(child);
      }
    }
  };
  for (const body of bodies.values()) if (!moves(body)) plant(body);
  for (const link of links)  // with the world itself
    if (link.a === null && !seen.has(link.b)) {
      link.b.link = link;
      plant(link.b);
    }
  for (const body of bodies.values()) if (!seen.has(body)) plant(body);
  const list = (body) => {
    order.push(body);
    body.children.forEach(list);
  };
  for (const root of roots) {
    if (root.link === null && moves(root)) root.shift = scale(1, root.desc.centre);  // a free body's frame stands in the centre of mass, about which it turns
    list(root);
  }
  return { order, roots };
}
