// MuJoCo by Google DeepMind: its own package @mujoco/mujoco, double precision, one thread.
import { USUAL } from '../base.mjs';
import { load, missing, versionOf } from '../packages.mjs';
import { SETTINGS } from './mujoco/settings.mjs';
import { MujocoWorld } from './mujoco/world.mjs';

const PACKAGE = '@mujoco/mujoco';
const TREE = 'of a tree, without error';

export function manifest() {
  return {
    version: versionOf(PACKAGE), unmet: missing(PACKAGE), description: 'MuJoCo, WebAssembly: reduced coordinates and soft constraints, for robots',
    precision: 'f64', deterministic: true, takes: ['impulse', 'angular_impulse', 'impulse_at_point'], settings: SETTINGS,
    capabilities: [
      ...USUAL,
      ['shape', 'mesh', '*', 'none', 'MuJoCo takes the hull of a mesh; use hulls or a compound of them'],
      ['shape', 'height_field', 'static', 'native'],
      ['shape', 'plane', 'static', 'native'],
      ['shape', 'compound', '*', 'native', 'several geoms of one body'],
      ['pair', 'cylinder|hull', '*', 'approximate', 'points of contact of flat faces by multiccd, which may leave some out'],
      ['pair', 'cylinder|hull', 'plane|sphere', 'native'],
      ['pair', 'height_field', '*', 'approximate', "prisms below the field's triangles, each with contacts of its own"],
      ['pair', 'mesh', '*', 'none', 'MuJoCo takes the hull of a mesh; use hulls or a compound of them'],
      ['joint', 'ball|hinge|fixed', '*', 'native', `${TREE}; those that close a loop are soft, without limits, motors and springs`],
      ['joint', 'slider|universal|generic', '*', 'native', `${TREE}; it cannot close a loop`],
      ['joint', 'distance', '*', 'native', 'a tendon between two points, a soft constraint'],
      ['joint_feature', 'ball|hinge|slider|distance|universal|generic', 'limits', 'native', 'soft by joint_time and impedance'],
      ['joint_feature', 'ball|hinge|slider|universal|generic', 'motors', 'emulated', 'dry friction against a speed'],
      ['joint_feature', 'distance', 'motors', 'none', 'rods have none'],
      ['joint_feature', 'ball|hinge|slider|distance|universal|generic', 'springs|stiffness', 'native'],
      ['joint_feature', 'ball|hinge|slider|distance|fixed|universal|generic', 'reaction', 'native', 'of a fixed joint that closes a loop the force alone'],
      ['joint_feature', 'ball|hinge|slider|distance|fixed|universal|generic', 'breaks', 'emulated', 'by the mean of the reaction over a step'],
      ['query', 'ray', '*', 'native', 'every geom is asked'],
      ['query', 'cast|overlap', '*', 'none', 'MuJoCo has neither shape casts nor overlaps'],
      ['write', 'damping|filter|surface_velocity|gravity_scale', '*', 'emulated', 'by the adapter, in each sub-step'],
      ['write', 'rolling_friction', '*', 'native'],
      ['write', 'awake', '*', 'none', 'nobody sleeps: what puts bodies to sleep is inside of a step that the adapter takes apart'],
      ['need', 'sleeping', '*', 'none', 'what puts bodies to sleep is inside of a step that the adapter takes apart'],
      ['need', 'ccd', '*', 'none', 'MuJoCo looks at where bodies are alone'],
      ['need', 'friction', '*', 'approximate', 'soft: what should stick creeps, less with impratio or noslip_iterations'],
      ['need', 'rolling_friction', '*', 'approximate', 'soft: what should stay creeps'],
      ['need', 'restitution', '*', 'approximate', 'a spring for bounce_substeps sub-steps, in which bodies overlap; a rebound of a twentieth where there should be none'],
      ['need', 'gyroscopic', '*', 'native', "with the integrator euler that of a sub-step's beginning, and none beyond half a radian in one, where bodies would gain"],
      ['need', 'surface_velocity', '*', 'emulated', "as the sliding speed that a contact's friction wants"],
      ['need', 'damping', '*', 'emulated', 'a force of the adapter in each sub-step'],
      ['need', 'axis_locks', '*', 'emulated', 'bodies weigh 1e10 kg along locked axes; where one or two turns are locked, they are taken out after each sub-step'],
      ['need', 'kinematic', '*', 'emulated', 'bodies of 1e10 kg that are put where they should be'],
      ['need', 'filters', '*', 'emulated', 'by the adapter, after contacts were found'],
      ['need', 'events|sensors', '*', 'emulated', 'by comparing who touches in one step with who does in the next'],
      ['need', 'joints|contacts|contact_impulses|queries|joint_reactions', '*', 'native'],
      ['event', '*', '*', 'emulated', 'by comparing one step with the next'],
      ['event', 'wake|sleep', '*', 'none', 'nobody sleeps'],
      ['child_material', '*', '*', 'native'],
    ],
  };
}

export async function createWorld(init) {
  const { default: loadMujoco } = await load(PACKAGE, 'mujoco.js');
  return new MujocoWorld(await loadMujoco(), init);
}
