// The words of a manifest, in the order in which plumb.h numbers what they stand for (../parent/words.hpp).
export const SHAPES = ['sphere', 'box', 'capsule', 'cylinder', 'hull', 'mesh', 'height_field', 'plane', 'compound'];
export const MOTIONS = ['static', 'kinematic', 'dynamic'];
export const JOINTS = ['ball', 'hinge', 'slider', 'distance', 'fixed', 'universal', 'generic', 'swing_twist', 'gear', 'rack_and_pinion'];
export const AXIS_MODES = ['free', 'locked', 'limited'];
export const FEATURES = ['limits', 'motors', 'springs', 'breaks', 'reaction', 'stiffness', 'targets'];
export const QUERIES = ['ray', 'cast', 'overlap', 'penetration', 'turning_cast'];
export const BODY_FIELDS = ['pose', 'velocity', 'force', 'torque', 'impulse', 'angular_impulse', 'force_at_point', 'impulse_at_point', 'awake',
  'kinematic_target', 'mass', 'material', 'gravity_scale', 'damping', 'surface_velocity', 'filter', 'rolling_friction'];
export const NEEDS = ['rotation', 'collision', 'friction', 'restitution', 'joints', 'ccd', 'sleeping', 'events', 'contacts',
  'contact_impulses', 'sensors', 'kinematic', 'gyroscopic', 'damping', 'forces', 'axis_locks', 'filters', 'queries',
  'surface_velocity', 'joint_reactions', 'snapshot', 'contact_modification', 'rolling_friction'];
export const EVENTS = ['contact_begin', 'contact_end', 'sensor_enter', 'sensor_leave', 'wake', 'sleep', 'joint_broken'];
