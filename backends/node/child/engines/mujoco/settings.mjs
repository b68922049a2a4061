// MuJoCo's knobs. Every default is MuJoCo's own, but for the cone of worlds with rolling friction; the sub-steps come
// near to its time step of 2 ms at 60 Hz.
import { boolSetting, choiceSetting, floatSetting, intSetting } from '../../base.mjs';

const SOLVERS = ['pgs', 'cg', 'newton'];  // as mjtSolver counts
const INTEGRATORS = { euler: 0, implicit: 2, implicitfast: 3 };  // as mjtIntegrator does
const CONES = { pyramidal: 0, elliptic: 1 };
const WARM_START = 512, FILTER_PARENT = 1024, ISLANDS = 262144, MULTI_CCD = 524288;  // as mjtDisableBit does

export const SETTINGS = [
  intSetting('substeps', 'quality', [1, 1024], 8, 'MuJoCo steps of dt / substeps in a step', { unit: '1' }),
  choiceSetting('solver', 'behaviour', ['newton', 'cg', 'pgs'], "Newton's method, conjugate gradients, or projected Gauss-Seidel"),
  intSetting('iterations', 'quality', [1, 10000], 100, 'at most, of the solver', { unit: '1' }),
  floatSetting('tolerance', 'quality', [0, 1], 1e-8, 'at which the solver stops early', { unit: '1' }),
  intSetting('noslip_iterations', 'quality', [0, 10000], 0, 'of a second solver that takes the creep out of friction', { unit: '1' }),
  choiceSetting('integrator', 'behaviour', Object.keys(INTEGRATORS), "semi-implicit Euler; implicit in all forces that depend on velocities; or without those of the links' turning"),
  choiceSetting('cone', 'behaviour', ['by_need', 'pyramidal', 'elliptic'], 'of friction; by need elliptic where the world has rolling friction, for in a pyramid sliding takes from it, else pyramidal'),
  floatSetting('impratio', 'behaviour', [1e-3, 1e6], 1, 'how much stiffer friction is than the normal constraint of a contact', { unit: '1' }),
  floatSetting('contact_time', 'behaviour', [1e-5, 10], 0.02, "in which a contact's overlap goes back; no less than two sub-steps", { unit: 's' }),
  floatSetting('contact_damping_ratio', 'behaviour', [1e-3, 1e3], 1, 'of contacts; 1 is critical', { unit: '1' }),
  floatSetting('joint_time', 'behaviour', [1e-5, 10], 0.02, 'in which limits, rods and joints that close a loop are mended', { unit: 's' }),
  floatSetting('joint_damping_ratio', 'behaviour', [1e-3, 1e3], 1, 'likewise', { unit: '1' }),
  floatSetting('impedance_least', 'behaviour', [1e-4, 0.9999], 0.9, 'hardness of a constraint where it begins', { unit: '1' }),
  floatSetting('impedance_most', 'behaviour', [1e-4, 0.9999], 0.95, 'hardness of one that is far violated', { unit: '1' }),
  floatSetting('impedance_width', 'behaviour', [0, 10], 0.001, 'violation over which hardness goes from the one to the other', { unit: 'm' }),
  intSetting('bounce_substeps', 'quality', [4, 1000], 10, 'sub-steps that an impact with restitution lasts; fewer are harder', { unit: '1' }),
  boolSetting('warm_starting', 'quality', true, 'the accelerations of the step before are the first guess'),
  boolSetting('multiccd', 'quality', true, 'several points of contact for pairs of hulls and cylinders, where their faces are flat on each other'),
];

export const impedanceOf = (s) => [s.impedance_least, s.impedance_most, s.impedance_width, 0.5, 2];
export const isEuler = (s) => s.integrator === 'euler';

/**
 * To a model's options, and to all of its constraints but contacts. rolls: the world has rolling friction; heavy: it has
 * what forces must not move. An island's solver scales its tolerance by the island's own inertia, with which it would stop
 * before it began; the solver of the whole takes the model's.
 */
export function applyToModel(s, { rolls, heavy }, model) {
  const option = model.opt, solref = [s.joint_time, s.joint_damping_ratio], solimp = impedanceOf(s);
  option.solver = SOLVERS.indexOf(s.solver);
  option.iterations = s.iterations;
  option.tolerance = s.tolerance;
  option.noslip_iterations = s.noslip_iterations;
  option.integrator = INTEGRATORS[s.integrator];
  option.cone = CONES[s.cone] ?? (rolls ? CONES.elliptic : CONES.pyramidal);
  option.impratio = s.impratio;
  option.disableflags = FILTER_PARENT | (s.warm_starting ? 0 : WARM_START) | (s.multiccd ? 0 : MULTI_CCD) | (heavy ? ISLANDS : 0);
  for (const kind of ['jnt', 'dof', 'eq']) {
    fill(model[`${kind}_solref`], solref);
    fill(model[`${kind}_solimp`], solimp);
  }
  fill(model.tendon_solref_lim, solref);
  fill(model.tendon_solimp_lim, solimp);
}
function fill(numbers, row) {
  for (let at = 0; at < numbers.length; at += row.length) numbers.set(row, at);
}
