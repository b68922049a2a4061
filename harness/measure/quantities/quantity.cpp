#include "measure/quantities/quantity.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/reactions.hpp"
#include "measure/instruments/referee_view.hpp"
#include "referee/joints.hpp"
#include "referee/penetration.hpp"

namespace plumb::harness {
namespace {

using referee::Vec3;

referee::Pose pose_of(const PoseRow& row) { return referee::pose(row.position, row.orientation); }

referee::BodyState state(const Observation& o, std::size_t body) {
  return state_of(o.now, body, o.scene.view().masses()[body]);
}

/// Of one body, whose weight may be scaled.
referee::Energy energy_of(const Observation& o, std::size_t body) {
  const Scene& scene = o.scene.scene();
  const referee::BodyState its = state(o, body);
  return referee::energy({&its, 1}, scene.bodies[body].desc.gravity_scale * referee::vec(scene.gravity));
}
referee::Energy energy_of_all(const Observation& o) {
  referee::Energy sum;
  for (std::size_t body = 0; body < o.scene.scene().bodies.size(); ++body) {
    const referee::Energy one = energy_of(o, body);
    sum.linear += one.linear;
    sum.rotational += one.rotational;
    sum.potential += one.potential;
  }
  return sum;
}

// Bodies.
Vec3 body_position(const Observation& o) { return referee::vec(o.now.poses()[o.first].position); }
Vec3 body_centre(const Observation& o) { return state(o, o.first).centre(); }
Vec3 body_velocity(const Observation& o) { return referee::vec(o.now.velocities()[o.first].linear); }
Vec3 body_angular_velocity(const Observation& o) { return referee::vec(o.now.velocities()[o.first].angular); }
Vec3 body_momentum(const Observation& o) { return state(o, o.first).momentum(); }
Vec3 body_angular_momentum(const Observation& o) {
  const referee::BodyState its = state(o, o.first);
  return referee::angular_momentum({&its, 1});
}
double body_kinetic_energy(const Observation& o) { return energy_of(o, o.first).kinetic(); }
double body_potential_energy(const Observation& o) { return energy_of(o, o.first).potential; }
double body_energy(const Observation& o) { return energy_of(o, o.first).total(); }

referee::Quat turn_since_start(const Observation& o) {
  const referee::Quat start = referee::quat(o.scene.scene().bodies[o.first].desc.pose.orientation);
  return referee::quat(o.now.poses()[o.first].orientation) * start.conjugate();
}
double body_angle(const Observation& o) {
  const referee::Quat turn = turn_since_start(o);
  if (!o.along) return 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
  return 2 * std::atan2(turn.vec().dot(*o.along), turn.w());
}
double body_tilt(const Observation& o) {
  const Vec3 gravity = referee::vec(o.scene.scene().gravity);
  const Vec3 up = gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3(Vec3::UnitY());
  const Vec3 leaned = turn_since_start(o) * up;
  return std::atan2(up.cross(leaned).norm(), up.dot(leaned));
}

// Joints.
struct JointPoses {
  const PlumbJointDesc& desc;
  referee::Pose a, b;
};
JointPoses joint_poses(const Observation& o) {
  const SceneJoint& joint = o.scene.scene().joints[o.first];
  const auto poses = o.now.poses();
  return {joint.desc, joint.body_a ? pose_of(poses[*joint.body_a]) : referee::Pose{}, pose_of(poses[joint.body_b])};
}
referee::JointError joint_error(const Observation& o) {
  const auto [desc, a, b] = joint_poses(o);
  return referee::joint_error(desc, a, b);
}
double joint_gap(const Observation& o) { return joint_error(o).position; }
double joint_misalignment(const Observation& o) { return joint_error(o).angle; }
double joint_limit_position(const Observation& o) { return joint_error(o).limit_position; }
double joint_limit_angle(const Observation& o) { return joint_error(o).limit_angle; }
Vec3 joint_position(const Observation& o) {
  const auto [desc, a, b] = joint_poses(o);
  const auto at = referee::joint_coordinates(desc, a, b);
  return {at[0], at[1], at[2]};
}
/// The swing-twist angle about a direction of frame a; about x the same as a hinge's own.
double joint_angle(const Observation& o) {
  const auto [desc, a, b] = joint_poses(o);
  const referee::Pose relative = (b * referee::pose(desc.frame_b)).seen_from(a * referee::pose(desc.frame_a));
  const referee::Quat turn(relative.rotation);
  return 2 * std::atan2(turn.vec().dot(o.along.value_or(Vec3::UnitX())), turn.w());
}
ReactionAccount reaction(const Observation& o) {
  ReactionAccount last(o.first);
  try {
    last.add(o.now);
  } catch (const Error& error) {
    if (error.code() != PLUMB_E_STALE_HANDLE) throw;
    throw Error(error.code(), "joint " + o.scene.scene().joints[o.first].name + " broke before " +
                                  std::to_string(o.now.time()) + " s, and has no force from then on");
  }
  return last;
}
Vec3 joint_force(const Observation& o) { return reaction(o).force(); }
Vec3 joint_torque(const Observation& o) { return reaction(o).torque(); }

// Pairs.
double pair_depth(const Observation& o) {
  const auto poses = o.now.poses();
  return referee::penetration(o.scene.shape_of_body(o.first), pose_of(poses[o.first]), o.scene.shape_of_body(o.second),
                              pose_of(poses[o.second]))
      .depth;
}
double pair_distance(const Observation& o) { return std::max(0.0, -pair_depth(o)); }
double pair_overlap(const Observation& o) { return std::max(0.0, pair_depth(o)); }
Vec3 pair_position(const Observation& o) { return state(o, o.second).centre() - state(o, o.first).centre(); }
Vec3 pair_velocity(const Observation& o) {
  const auto velocities = o.now.velocities();
  return referee::vec(velocities[o.second].linear) - referee::vec(velocities[o.first].linear);
}
ImpulseAccount::PairForce pair_force(const Observation& o) {
  ImpulseAccount step(o.now);
  step.add(o.now);
  return step.between(o.first, o.second);
}
double pair_normal_force(const Observation& o) { return pair_force(o).normal; }
double pair_friction_force(const Observation& o) { return pair_force(o).tangent; }

// All bodies.
double all_kinetic_energy(const Observation& o) { return energy_of_all(o).kinetic(); }
double all_potential_energy(const Observation& o) { return energy_of_all(o).potential; }
double all_energy(const Observation& o) { return energy_of_all(o).total(); }
Vec3 all_momentum(const Observation& o) { return referee::linear_momentum(o.scene.view().states(o.now)); }
Vec3 all_angular_momentum(const Observation& o) { return referee::angular_momentum(o.scene.view().states(o.now)); }
Vec3 all_centre(const Observation& o) {
  Vec3 sum = Vec3::Zero();
  for (const referee::BodyState& its : o.scene.view().states(o.now)) sum += its.mass.mass * its.centre();
  return sum / o.scene.view().total_mass();
}
double all_overlap(const Observation& o) { return std::max(0.0, o.scene.view().penetration(o.now.poses()).max); }
/// The largest of what the moving bodies give.
double largest_of_moving(const Observation& o, double (*of_body)(const Observation&, std::size_t body)) {
  const std::vector<SceneBody>& bodies = o.scene.scene().bodies;
  double most = 0;
  for (std::size_t body = 0; body < bodies.size(); ++body)
    if (bodies[body].desc.motion == PLUMB_DYNAMIC) most = largest(most, of_body(o, body));
  return most;
}
double all_speed(const Observation& o) {
  return largest_of_moving(
      o, [](const Observation& of, std::size_t body) { return referee::vec(of.now.velocities()[body].linear).norm(); });
}
double all_spin(const Observation& o) {
  return largest_of_moving(o, [](const Observation& of, std::size_t body) {
    return referee::vec(of.now.velocities()[body].angular).norm();
  });
}
double all_way(const Observation& o) {
  return largest_of_moving(o, [](const Observation& of, std::size_t body) {
    const PlumbVec3& start = of.scene.scene().bodies[body].desc.pose.position;
    return (referee::vec(of.now.poses()[body].position) - referee::vec(start)).norm();
  });
}
/// Of bodies that do not move on those that do.
Vec3 all_ground_force(const Observation& o) {
  ImpulseAccount step(o.now);
  step.add(o.now);
  return step.from_ground();
}
referee::JointError all_joint_errors(const Observation& o) {
  return o.scene.view().joint_error(o.now.poses(), o.now.time());
}
double all_gap(const Observation& o) { return all_joint_errors(o).position; }
double all_misalignment(const Observation& o) { return all_joint_errors(o).angle; }
double all_limit_position(const Observation& o) { return all_joint_errors(o).limit_position; }
double all_limit_angle(const Observation& o) { return all_joint_errors(o).limit_angle; }

}  // namespace

const char* word_of(Observed observed) {
  static constexpr const char* words[] = {"body", "joint", "pair", "all"};
  return words[static_cast<std::size_t>(observed)];
}

const referee::Shape& ObservedScene::shape_of_body(std::size_t body) {
  referee::ShapePtr& shape = shapes_[body];
  if (!shape) shape = shape_of(*scene_, scene_->bodies[body].shape.value());
  return *shape;
}

std::span<const QuantitySpec> quantity_specs() {
  using enum Observed;
  using enum QuantitySpec::Trait;
  static constexpr QuantitySpec specs[] = {
      {body, "position", "m", "of the body's frame in the world", body_position},
      {body, "centre", "m", "of its mass, in the world", body_centre},
      {body, "velocity", "m/s", "of its centre of mass; without a direction its speed", body_velocity},
      {body, "angular_velocity", "rad/s", "about the world's axes", body_angular_velocity},
      {body, "angle", "rad",
       "by which it has turned since the start about a direction, whole turns counted; without "
       "one the whole angle from 0 to pi",
       nullptr, body_angle, directed | turns},
      {body, "tilt", "rad", "between what pointed up at the start and up", nullptr, body_tilt},
      {body, "kinetic_energy", "J", "of motion and rotation", nullptr, body_kinetic_energy},
      {body, "potential_energy", "J", "of its weight, 0 at the origin", nullptr, body_potential_energy},
      {body, "energy", "J", "the sum of both", nullptr, body_energy},
      {body, "momentum", "kg m/s", "mass times velocity", body_momentum},
      {body, "angular_momentum", "kg m2/s", "about the origin, with its spin", body_angular_momentum},
      {body, "force", "N", "of all that acts on it: the change of its momentum in a step, over dt", body_momentum,
       nullptr, of_step | difference},
      {joint, "gap", "m", "how far the joint's frames are from where it allows them", nullptr, joint_gap},
      {joint, "misalignment", "rad", "how far they are turned in ways that it locks", nullptr, joint_misalignment},
      {joint, "limit_position", "m", "how far it has slid beyond a limit", nullptr, joint_limit_position},
      {joint, "limit_angle", "rad", "how far it has turned beyond a limit", nullptr, joint_limit_angle},
      {joint, "position", "m", "of its frame on body b, as that on body a sees it", joint_position},
      {joint, "angle", "rad",
       "of its frame on body b about a direction of that on body a, left out: x, a hinge's "
       "axis; whole turns counted",
       nullptr, joint_angle, directed | turns},
      {joint, "force", "N", "on body b, as the engine tells it", joint_force, nullptr, of_step,
       PLUMB_NEED_JOINT_REACTIONS},
      {joint, "torque", "N m", "on body b at its frame, as the engine tells it", joint_torque, nullptr, of_step,
       PLUMB_NEED_JOINT_REACTIONS},
      {pair, "distance", "m", "of their surfaces; 0 when they touch", nullptr, pair_distance},
      {pair, "overlap", "m", "of their shapes; 0 when they are apart", nullptr, pair_overlap},
      {pair, "position", "m", "of the second centre of mass from the first", pair_position},
      {pair, "velocity", "m/s", "of the second centre of mass as the first sees it", pair_velocity},
      {pair, "normal_force", "N", "of their contacts, as the engine tells it; 0 when they are apart", nullptr,
       pair_normal_force, of_step, PLUMB_NEED_CONTACT_IMPULSES},
      {pair, "friction_force", "N", "of their contacts, as the engine tells it", nullptr, pair_friction_force, of_step,
       PLUMB_NEED_CONTACT_IMPULSES},
      {all, "centre", "m", "of all mass", all_centre},
      {all, "kinetic_energy", "J", "of all bodies", nullptr, all_kinetic_energy},
      {all, "potential_energy", "J", "of their weight, 0 at the origin", nullptr, all_potential_energy},
      {all, "energy", "J", "the sum of both; springs are left out", nullptr, all_energy},
      {all, "momentum", "kg m/s", "of all bodies", all_momentum},
      {all, "angular_momentum", "kg m2/s", "of all bodies, about the origin", all_angular_momentum},
      {all, "overlap", "m", "the deepest of any two that may touch", nullptr, all_overlap},
      {all, "gap", "m", "the widest of any joint", nullptr, all_gap},
      {all, "misalignment", "rad", "the largest of any joint", nullptr, all_misalignment},
      {all, "limit_position", "m", "of the joint that has slid farthest beyond a limit", nullptr, all_limit_position},
      {all, "limit_angle", "rad", "of the joint that has turned farthest beyond a limit", nullptr, all_limit_angle},
      {all, "ground_force", "N", "of static and kinematic bodies on the others, as the engine tells its contacts",
       all_ground_force, nullptr, of_step, PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES},
      {all, "speed", "m/s", "of the fastest body: 0 at rest", nullptr, all_speed},
      {all, "spin", "rad/s", "of the body that turns fastest", nullptr, all_spin},
      {all, "way", "m", "of the body that is farthest from where it was at the start", nullptr, all_way},
  };
  return specs;
}

bool QuantityWatch::has_memory() const {
  const QuantitySpec& spec = *target_.spec;
  return spec.has(QuantitySpec::difference) || spec.has(QuantitySpec::turns);
}

double QuantityWatch::scalar(const Observation& observation) {
  double value = target_.spec->scalar(observation);
  const bool turns = target_.spec->has(QuantitySpec::turns) && (target_.along || target_.spec->of == Observed::joint);
  if (turns) value = unwrap_(value);
  if (!start_) start_ = value;
  return target_.since_start ? value - *start_ : value;
}

std::optional<double> QuantityWatch::value(ObservedScene& scene, Simulation& now) {
  const QuantitySpec& spec = *target_.spec;
  const bool at_start = now.steps() == 0;
  if (at_start && spec.has(QuantitySpec::of_step) && !spec.has(QuantitySpec::difference)) return std::nullopt;
  const Observation observation{scene, now, target_.first, target_.second, target_.along};
  if (spec.scalar != nullptr) return scalar(observation);
  referee::Vec3 vector = spec.vector(observation);
  if (spec.has(QuantitySpec::difference)) {
    const std::optional<referee::Vec3> before = std::exchange(last_vector_, vector);
    if (!before) return std::nullopt;
    vector = (vector - *before) / now.scene().dt;
  }
  if (!start_vector_) start_vector_ = vector;
  if (target_.since_start) vector -= *start_vector_;
  return target_.along ? vector.dot(*target_.along) : vector.norm();
}

}  // namespace plumb::harness
