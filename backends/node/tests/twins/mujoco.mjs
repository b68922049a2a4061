// MuJoCo without Plumb: a model in its own text, with joints as the tree's, and mj_step.
import { load, scene, tell } from './scene.mjs';

const { default: loadMujoco } = await load('@mujoco/mujoco', 'mujoco.js'), M = await loadMujoco();
const SUBSTEPS = 8, { items, joints, friction } = scene, text = (v) => v.join(' ');

/** In a tree a child's place is seen from its parent; hinges and balls are open where the scene begins. */
function bodyText(i) {
  const { sphere, half, position, orientation: [x, y, z, w], mass, inertia } = items[i], link = joints.find(({ b }) => b === i);
  const from = link && link.a >= 0 ? items[link.a].position : [0, 0, 0], place = text(position.map((p, k) => p - from[k]));
  const joint = !link ? '<freejoint/>' : link.hinge ? `<joint type="hinge" pos="${text(link.inB)}" axis="0 0 1"/>` : `<joint type="ball" pos="${text(link.inB)}"/>`;
  const shape = sphere ? `type="sphere" size="${half[0]}"` : `type="box" size="${text(half)}"`;
  const below = joints.filter(({ a }) => a === i).map(({ b }) => bodyText(b)).join('');
  return `<body name="b${i}" pos="${place}" quat="${text([w, x, y, z])}"><inertial pos="0 0 0" mass="${mass}" diaginertia="${text(inertia)}"/>${joint}
    <geom ${shape}/>${below}</body>`;
}
const roots = items.flatMap((item, i) => {
  if (item.still) return [`<geom type="box" size="${text(item.half)}" pos="${text(item.position)}"/>`];
  return joints.some(({ a, b }) => b === i && a >= 0) ? [] : [bodyText(i)];
});
// The solver stops at a tolerance that MuJoCo scales by the mean inertia: the adapter takes the mean of the masses.
const masses = items.filter(({ still }) => !still).map(({ mass }) => mass), mean = masses.reduce((a, b) => a + b) / masses.length;
const model = M.MjModel.from_xml_string(`<mujoco><compiler angle="radian" inertiafromgeom="false"/><statistic meaninertia="${mean}"/>
  <option timestep="${scene.dt / SUBSTEPS}" gravity="${text(scene.gravity)}"/>
  <default><geom friction="${friction} 1e-5 1e-5"/></default><worldbody>${roots.join('')}</worldbody></mujoco>`);
const data = new M.MjData(model);

const moving = items.flatMap((item, i) => (item.still ? [] : [{ ...item, id: M.mj_name2id(model, 1, `b${i}`), linked: joints.some(({ b }) => b === i) }]));
for (const { id, linked, velocity, spin } of moving) if (!linked) data.qvel.set([...velocity, ...spin], model.body_dofadr[id]);  // upright at first: its own axes are the world's
for (let i = 0; i < SUBSTEPS * scene.steps; ++i) M.mj_step(model, data);

M.mj_kinematics(model, data);
M.mj_comPos(model, data);
M.mj_comVel(model, data);
const told = new M.DoubleBuffer(6);
tell(moving.map(({ id }) => {
  const [w, x, y, z] = data.xquat.slice(4 * id, 4 * id + 4);
  M.mj_objectVelocity(model, data, 1, id, told, 0);
  const [wx, wy, wz, vx, vy, vz] = told.GetView();
  return [...data.xpos.slice(3 * id, 3 * id + 3), x, y, z, w, vx, vy, vz, wx, wy, wz];
}));
