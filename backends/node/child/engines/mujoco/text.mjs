// A world as MuJoCo's own text (MJCF), of which it makes a model.
import { BOX, CAPSULE, CYLINDER, DISTANCE, DYNAMIC, HEIGHT_FIELD, HULL, KINEMATIC, PLANE, SPHERE, STATIC } from '../../rows.mjs';
import { compose, inverse, rotate, scale, sub } from '../../algebra.mjs';
import { effectiveMass } from './mass.mjs';
import { ABOUT_X, isLimited, isPlainBall, openAxes } from './tree.mjs';

export const HEAVY = 1e10;  // kg, kg m2: of what forces must not move
const LEAST = 1e-9;  // what MuJoCo would refuse without a length or a range
const STRAIGHT = { position: [0, 0, 0], orientation: [0, 0, 0, 1] };
/** MuJoCo's planes and height fields look along z, ours along y; its capsules and cylinders stand along z. */
const Z_TO_Y = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];

const list = (numbers) => Array.from(numbers).join(' ');
const turn = ([x, y, z, w]) => {
  const n = Math.hypot(x, y, z, w);
  return list([w / n, x / n, y / n, z / n]);
};
const at = ({ position, orientation }) => `pos="${list(position)}" quat="${turn(orientation)}"`;
const bodyName = (body) => (body === null ? 'world' : `b${body.slot}`);
/** A frame of a body's in MuJoCo's of the same body. */
export const shifted = (body, { position, orientation }) => ({ position: sub(position, body.shift), orientation });

// --- shapes ----------------------------------------------------------------------------------------------------------

/** Of a height field: its lowest point, and how far above it the highest is. */
export function rangeOf({ heights }) {
  const lowest = heights.reduce((a, b) => Math.min(a, b)), highest = heights.reduce((a, b) => Math.max(a, b));
  return { lowest, span: Math.max(highest - lowest, 1e-3) };
}
/** As MuJoCo holds them: the last row first, its y being our -z, 0 the lowest and 1 the highest. */
export function heightsOf(desc) {
  const { lowest, span } = rangeOf(desc), rows = [];
  for (let r = desc.rows; r-- > 0;) for (let c = 0; c < desc.columns; ++c) rows.push((desc.heights[r * desc.columns + c] - lowest) / span);
  return rows;
}
function assetOf({ slot, desc }) {
  if (desc.type === HULL) return `<mesh name="s${slot}" inertia="convex" vertex="${list(desc.vertices)}"/>`;
  const { rows, columns, dx, dz } = desc;
  return `<hfield name="s${slot}" nrow="${rows}" ncol="${columns}" size="${list([(columns - 1) * dx / 2, (rows - 1) * dz / 2, rangeOf(desc).span, 1])}"/>`;
}
/** From a shape's frame to that of MuJoCo's geom. */
function geomFrame(desc) {
  if (desc.type === HEIGHT_FIELD) return { position: [0, rangeOf(desc).lowest, 0], orientation: Z_TO_Y };
  return [CAPSULE, CYLINDER, PLANE].includes(desc.type) ? { ...STRAIGHT, orientation: Z_TO_Y } : STRAIGHT;
}
function geom({ slot, desc }, pose) {
  const place = at(compose(pose, geomFrame(desc)));
  switch (desc.type) {
    case SPHERE: return `<geom ${place} type="sphere" size="${desc.radius}"/>`;
    case BOX: return `<geom ${place} type="box" size="${list(desc.halfExtents)}"/>`;
    case CAPSULE: return `<geom ${place} type="capsule" size="${list([desc.radius, Math.max(desc.halfHeight, LEAST)])}"/>`;
    case CYLINDER: return `<geom ${place} type="cylinder" size="${list([desc.radius, desc.halfHeight])}"/>`;
    case PLANE: return `<geom ${place} type="plane" size="0 0 1"/>`;
    case HULL: return `<geom ${place} type="mesh" mesh="s${slot}"/>`;
    default: return `<geom ${place} type="hfield" hfield="s${slot}"/>`;
  }
}

// --- bodies ----------------------------------------------------------------------------------------------------------

/** The moments are put into the model afterwards: in a text MuJoCo refuses those that no solid body has. */
function inertial(body) {
  const { motion, mass, centre, inertiaOrientation } = body.desc;
  if (motion === STATIC) return '';
  if (motion === KINEMATIC) return `<inertial pos="0 0 0" mass="${HEAVY}" diaginertia="${list([HEAVY, HEAVY, HEAVY])}"/>`;
  return `<inertial ${at(shifted(body, { position: centre, orientation: inertiaOrientation }))} mass="${mass}" diaginertia="${list([mass, mass, mass])}"/>`;
}

function springOf(joint, axis) {
  const { byStiffness, frequency, ratio } = joint.desc.axes[axis].spring;
  if (byStiffness) return `stiffness="${frequency}" damping="${ratio}"`;
  const mass = effectiveMass(joint, axis), rate = 2 * Math.PI * frequency;
  return `stiffness="${mass * rate * rate}" damping="${2 * ratio * mass * rate}"`;
}
const rangeText = ({ lower, upper }) => `limited="true" range="${lower} ${Math.max(upper, lower + LEAST)}"`;

function scalarJoint(body, axis, frame) {
  const { link, reversed } = body, { limit, spring } = link.desc.axes[axis];
  const along = scale(reversed ? -1 : 1, rotate(frame.orientation, [0, 1, 2].map((k) => (k === axis % 3 ? 1 : 0))));
  const range = isLimited(link.desc, axis) ? rangeText(limit) : '';
  const pull = spring.enabled ? `${springOf(link, axis)} springref="${spring.rest}"` : '';
  return `<joint type="${axis < 3 ? 'slide' : 'hinge'}" pos="${list(frame.position)}" axis="${list(along)}" ${range} ${pull}/>`;
}
/** Translations first, seen from the joint's frame a; from b to a everything goes the other way round. */
export const axesInOrder = (body) => [0, 1, 2, 3, 4, 5].map((i) => (body.reversed ? 5 - i : i)).filter((axis) => openAxes(body.link.desc) & (1 << axis));

function joints(body) {
  if (body.desc.motion === STATIC) return '';
  if (body.link === null) return '<freejoint/>';
  const { desc } = body.link, frame = body.reversed ? desc.frameA : desc.frameB, ball = isPlainBall(desc);
  return axesInOrder(body).map((axis) => {
    if (axis < 3 || !ball) return scalarJoint(body, axis, frame);
    return axis === 3 ? `<joint type="ball" pos="${list(frame.position)}"/>` : '';
  }).join('');
}
/** Where a child is when all of its joint's coordinates are 0. */
function place(body) {
  if (body.link === null) return compose(body.pose, { ...STRAIGHT, position: body.shift });
  const { frameA, frameB } = body.link.desc, local = body.reversed ? compose(frameB, inverse(frameA)) : compose(frameA, inverse(frameB));
  return body.parent === null ? local : shifted(body.parent, local);
}
function sites(body, all) {
  const site = (name, frame) => `<site name="${name}" pos="${list((body === null ? frame : shifted(body, frame)).position)}"/>`;
  return all.filter(({ desc }) => desc.type === DISTANCE).map(({ slot, desc, a, b }) =>
    (a === body ? site(`p${slot}`, desc.frameA) : '') + (b === body ? site(`q${slot}`, desc.frameB) : '')).join('');
}
function bodyText(body, partsOf, all) {
  const geoms = partsOf(body).map((part) => geom(part, shifted(body, part.pose)));
  const children = body.children.map((child) => bodyText(child, partsOf, all));
  return `<body name="${bodyName(body)}" ${at(place(body))}>\n${[inertial(body), joints(body), ...geoms, sites(body, all), ...children].join('\n')}\n</body>`;
}

// --- constraints -----------------------------------------------------------------------------------------------------

/** Whether a joint is one of the model's equalities, or two: a stiff rod, or what closes a loop. */
export function needsEquality({ desc, isLink, a, b }) {
  if (desc.type === DISTANCE) return !desc.axes[0].limit.enabled && !desc.axes[0].spring.enabled;
  return !isLink && [a, b].some((body) => body?.desc.motion === DYNAMIC);
}
/** How many they are of a joint that closes a loop: a hinge is held in two points. */
export const equalitiesOf = (desc) => (openAxes(desc) === ABOUT_X ? 2 : 1);

function rod(joint) {
  const { slot, desc } = joint, { limit, spring } = desc.axes[0];
  const pull = spring.enabled ? `${springOf(joint, 0)} springlength="${desc.restLength}"` : '';
  return `<spatial name="t${slot}" ${limit.enabled ? rangeText(limit) : ''} ${pull}><site site="p${slot}"/><site site="q${slot}"/></spatial>`;
}
/** What they hold is written into the model afterwards. */
function equality({ slot, desc, a, b }) {
  const ends = `body1="${bodyName(a)}" body2="${bodyName(b)}"`;
  if (desc.type === DISTANCE) return `<tendon tendon1="t${slot}"/>`;
  if (openAxes(desc) === 0) return `<weld ${ends}/>`;
  return `<connect ${ends} anchor="0 0 0"/>`.repeat(equalitiesOf(desc));
}

/** kB that MuJoCo begins with for contacts and constraints: of large worlds it would take more than there is. */
const roomFor = (bodies) => 16384 + 32 * bodies;

/** partsOf: the shapes of a body, each with its place in the body's frame. */
export function modelText({ order, roots }, all, partsOf, collides) {
  const assets = new Map();
  for (const body of order) for (const part of partsOf(body)) if ([HULL, HEIGHT_FIELD].includes(part.desc.type)) assets.set(part.slot, assetOf(part));
  return `<mujoco><compiler angle="radian" inertiafromgeom="false"/><size memory="${roomFor(order.length)}K"/>
<asset>${[...assets.values()].join('\n')}</asset>
${collides ? '' : '<default><geom contype="0" conaffinity="0"/></default>'}
<worldbody>${sites(null, all)}${roots.map((root) => bodyText(root, partsOf, all)).join('\n')}</worldbody>
<tendon>${all.filter(({ desc }) => desc.type === DISTANCE).map(rod).join('\n')}</tendon>
<equality>${all.filter(needsEquality).map(equality).join('\n')}</equality></mujoco>`;
}
