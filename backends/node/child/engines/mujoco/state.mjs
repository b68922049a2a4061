// What moves, between bodies and MuJoCo's coordinates: of free bodies as they are, of those in trees along the free axes
// of their joints.
import { DYNAMIC, NO_ROTATION, STATIC } from '../../rows.mjs';
import { add, compose, conjugate, cross, dot, inverse, multiply, rotate, scale, sub, unrotate } from '../../algebra.mjs';
import { centreOf, frameA, frameB } from './mass.mjs';
import { three, wxyz } from './model.mjs';
import { isPlainBall } from './tree.mjs';

/** What was written since is put into MuJoCo's data. */
export function writeState(model) {
  const touched = new Set(model.bodies.filter((body) => body?.written).map(({ root }) => root));
  if (touched.size === 0) return;
  const some = model.bodies.filter((body) => body !== null && touched.has(body.root));
  for (const body of some) {
    if (body.desc.motion === STATIC) {
      model.m('body_pos').set(body.pose.position, 3 * body.id);
      model.m('body_quat').set(wxyz(body.pose.orientation), 4 * body.id);
    } else if (body.link === null) writeFree(model, body);
    else writeCoordinates(model, body);
  }
  place(model);
  for (const body of some) {
    writeRates(model, body);
    body.written = false;
  }
}
/** Works out where everything is, and the axes of joints. */
function place({ M, model, data }) {
  M.mj_kinematics(model, data);
  M.mj_comPos(model, data);
}

/** Linear and angular, of what is not locked. */
export function freeVelocity({ desc, velocity, spin }) {
  const kept = (v, shift) => v.map((x, k) => (desc.locks & (1 << (shift + k)) ? 0 : x));
  return [kept(velocity, 0), (desc.flags & NO_ROTATION) !== 0 ? [0, 0, 0] : kept(spin, 3)];
}
export function writeFree(model, body) {
  const [velocity, spin] = freeVelocity(body), { position, orientation } = body.pose;
  const at = model.m('jnt_qposadr')[body.firstJoint], dof = model.firstDof(body);
  model.d('qpos').set([...add(position, rotate(orientation, body.shift)), ...wxyz(orientation)], at);
  model.d('qvel').set([...velocity, ...unrotate(orientation, spin)], dof);
}

/** Of b's frame in a's: a translation, and the angles of R = Rx(q3) Ry(q4) Rz(q5). */
function coordinates(a, b) {
  const seen = compose(inverse(a), b), [x, y, z] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => rotate(seen.orientation, axis));
  return [...seen.position, Math.atan2(-z[1], z[2]), Math.asin(Math.max(-1, Math.min(1, z[0]))), Math.atan2(-y[0], x[0])];
}
function writeCoordinates(model, body) {
  const { link, reversed } = body, a = frameA(link), b = frameB(link), q = model.d('qpos'), start = model.m('jnt_qposadr');
  coordinates(a, b).forEach((value, axis) => {
    if (link.axisJoint[axis] >= 0) q[start[link.axisJoint[axis]]] = value;
  });
  if (!isPlainBall(link.desc)) return;
  // In the child's own axes: its turn from where it is when the frames lie on each other.
  const ball = body.firstJoint + (reversed ? 0 : body.jointCount - 1), seen = multiply(conjugate(a.orientation), b.orientation);
  const own = (reversed ? link.desc.frameA : link.desc.frameB).orientation, turn = reversed ? conjugate(seen) : seen;
  q.set(wxyz(multiply(multiply(own, turn), conjugate(own))), start[ball]);
}

/** What each of a body's own joints moves its centre of mass and turns it by, a unit of speed. */
function columnsOf(model, body) {
  const dofs = model.d('cdof'), arm = sub(three(model.d('xipos'), 3 * body.id), three(model.d('subtree_com'), 3 * body.root));
  const first = model.firstDof(body), columns = [];
  for (let k = 0; k < model.m('body_dofnum')[body.id]; ++k) {
    const turn = three(dofs, 6 * (first + k)), move = three(dofs, 6 * (first + k) + 3);
    columns.push([...add(move, cross(turn, arm)), ...turn]);
  }
  return columns;
}
/**
 * Parents come first: what of the body's velocity is not theirs is that of its own joints. `carries` is the body's
 * velocity as its children have it: at the centre of mass of the whole tree.
 */
function writeRates(model, body) {
  const centre = three(model.d('subtree_com'), 3 * body.root), arm = sub(three(model.d('xipos'), 3 * body.id), centre);
  const moved = ({ move, turn }, by) => ({ move: add(move, cross(turn, by)), turn });
  if (body.link === null) {
    const [velocity, spin] = body.desc.motion === STATIC ? [[0, 0, 0], [0, 0, 0]] : freeVelocity(body);
    body.carries = moved({ move: velocity, turn: spin }, scale(-1, arm));
    return;
  }
  const from = body.parent?.carries ?? { move: [0, 0, 0], turn: [0, 0, 0] }, carried = moved(from, arm), columns = columnsOf(model, body);
  const left = [...sub(body.velocity, carried.move), ...sub(body.spin, carried.turn)], rates = leastSquares(columns, left);
  if (columns.length > 0) model.d('qvel').set(rates, model.firstDof(body));
  const own = { move: [0, 0, 0], turn: [0, 0, 0] };
  columns.forEach((column, k) => {
    own.move = add(own.move, scale(rates[k], column.slice(0, 3)));
    own.turn = add(own.turn, scale(rates[k], column.slice(3)));
  });
  const back = moved(own, scale(-1, arm));
  body.carries = { move: add(from.move, back.move), turn: add(from.turn, back.turn) };
}

/** x that brings J x nearest to r. By the normal equations, of which the diagonal is raised a little where columns coincide. */
function leastSquares(columns, r) {
  const product = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0), n = columns.length;
  const rows = columns.map((a, i) => [...columns.map((b, k) => product(a, b) * (i === k ? 1 + 1e-12 : 1)), product(a, r)]);
  for (let i = 0; i < n; ++i)
    for (let k = 0; k < n; ++k) {
      if (k === i || rows[i][i] === 0) continue;
      const share = rows[k][i] / rows[i][i];
      for (let c = i; c <= n; ++c) rows[k][c] -= share * rows[i][c];
    }
  return rows.map((row, i) => (row[i] === 0 ? 0 : row[n] / row[i]));
}

/** Of MuJoCo to bodies. */
export function readState(model) {
  place(model);
  model.M.mj_comVel(model.model, model.data);
  const told = model.d('cvel');
  for (const body of model.bodies) {
    if (body?.desc.motion !== DYNAMIC) continue;
    body.pose = model.poseOf(body);
    body.spin = three(told, 6 * body.id);
    body.velocity = velocityOfCentre(model, body);
  }
}
/** m/s, of a body's centre of mass. */
export function velocityOfCentre(model, body) {
  const told = model.d('cvel'), spin = three(told, 6 * body.id);
  const arm = sub(three(model.d('xipos'), 3 * body.id), three(model.d('subtree_com'), 3 * body.root));
  return add(three(told, 6 * body.id + 3), cross(spin, arm));
}

/** J^T p = M dv, of the tree as it stands. */
export function pushTree(model, body, impulse, twist) {
  const { M, model: m, data } = model, asked = new Array(m.nv).fill(0);
  place(model);
  M.mj_makeM(m, data);
  M.mj_factorM(m, data);
  const at = centreOf(body);
  for (let link = body; link !== null; link = link.parent) {
    // Of a parent's joints too, at the pushed body's centre.
    const arm = sub(at, three(model.d('xipos'), 3 * link.id)), first = model.firstDof(link);
    columnsOf(model, link).forEach((column, k) => {
      const turn = column.slice(3);
      asked[first + k] += dot(add(column.slice(0, 3), cross(turn, arm)), impulse) + dot(turn, twist);
    });
  }
  const change = new M.DoubleBuffer(m.nv), q = model.d('qvel');
  M.mj_solveM(m, data, change, asked);
  change.GetView().forEach((dv, i) => { q[i] += dv; });
  change.delete();
  readState(model);
}
