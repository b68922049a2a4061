// Bodies and joints of a world that become others while they live.
#include "plumb/backend/modify.hpp"

#include <algorithm>
#include <cstring>

#include "plugin/ranges.hpp"
#include "plugin/rows/joint_rows.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

PlumbResult World::modify_bodies(std::span<const PlumbBodyChange> changes) {
  std::vector<PlumbBody> ids;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    require_range(backend::described(changes[i]), i);
    ids.push_back(changes[i].body);
  }
  if (init_.needs(PLUMB_NEED_CONTACTS)) contacts();  // while the bodies are what the step left them
  wake_for_write(PLUMB_FIELD_POSE, ids);
  Simulation::Slots slots(ids.size());
  std::transform(ids.begin(), ids.end(), slots.begin(), [](PlumbBody id) { return slot_of(id); });
  simulation_.bodies.state.fetch(slots, kPosePart | kVelocityPart);
  for (const PlumbBodyChange& change : changes) remake_body(change);
  put_joints_of(changes);
  simulation_.joints.bodies_changed();
  simulation_.bodies_changed();
  pacing_.lets_go = true;
  return PLUMB_OK;
}

/// Velocities are kept as the engine's numbers, so that what a change does not name keeps its bits.
void World::remake_body(const PlumbBodyChange& change) {
  const std::uint32_t slot = slot_of(change.body);
  BodyRecord& body = bodies_[slot];
  PlumbBodyDesc desc = backend::described(change);
  desc.pose = pose(slot);
  const Velocity moving = simulation_.bodies.state.velocity[slot];
  const Position at = simulation_.bodies.state.position[slot];
  if (body.motion == PLUMB_DYNAMIC) --dynamic_count_;
  if (body.motion == PLUMB_STATIC) simulation_.statics_changed();
  if (body.motion != PLUMB_DYNAMIC || change.motion != PLUMB_DYNAMIC) simulation_.bodies.force.edit(slot) = {};
  body.to_target = body.arrived = false;
  if (body.senses) sensors_.remove_if([&](std::uint32_t other) { return other == slot; });
  detach(slot);
  embody(slot, desc);
  if (change.motion != PLUMB_DYNAMIC) return;
  Velocity& velocity = simulation_.bodies.state.velocity[slot];
  const bool turns = (simulation_.bodies.mass[slot].flags & kBodyTurns) != 0;
  velocity.linear = moving.linear + cross(moving.angular, between(at, simulation_.bodies.state.position[slot]));
  velocity.angular = turns ? moving.angular : Vec{0, 0, 0};
  hold_locked(slot);
  stop_infinite(slot);
}

/// Their frames lie on the bodies' principal axes about the centres of mass.
void World::put_joints_of(std::span<const PlumbBodyChange> changes) {
  const backend::ChangedBodies changed(changes);
  for (std::uint32_t slot = 0; slot < joints_.records.size(); ++slot) {
    const JointRecord& joint = joints_.records[slot];
    if (joint.id == 0 || !joint.enabled || !changed.joined_by(joint.desc)) continue;
    simulation_.joints.remove(slot);
    put_joint(slot);
    wake_for_joint(joint.desc);
  }
}

PlumbResult World::modify_joints(std::span<const PlumbJointChange> changes) {
  std::vector<PlumbJointDesc> descs;
  for (const PlumbJointChange& change : changes) {
    descs.push_back(joints_.records[slot_of(change.joint)].desc);
    backend::apply(change, descs.back());
    (void)rows_of_joint(descs.back());
  }
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const std::uint32_t slot = slot_of(changes[i].joint);
    const bool enabled =
        (changes[i].what & PLUMB_MODIFY_ENABLED) != 0 ? changes[i].enabled != 0 : joints_.records[slot].enabled;
    change_joint(slot, descs[i], enabled);
  }
  return PLUMB_OK;
}

/// Where no row is other than it was, a motor's numbers and where a spring rests at most, the joints' order and factors
/// stand.
void World::change_joint(std::uint32_t slot, const PlumbJointDesc& desc, bool enabled) {
  JointRecord& joint = joints_.records[slot];
  PlumbJointDesc driven = joint.desc;
  bool same_motors = true;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    same_motors = same_motors && (driven.motors[axis].enabled != 0) == (desc.motors[axis].enabled != 0);
    driven.motors[axis] = desc.motors[axis];
    driven.springs[axis].rest = desc.springs[axis].rest;
  }
  if (desc.springs[0].enabled != 0) driven.rest_length = desc.rest_length;
  const bool same_rows = same_motors && enabled == joint.enabled && std::memcmp(&driven, &desc, sizeof desc) == 0;
  if (same_rows) {
    joint.desc = desc;
    if (enabled) simulation_.joints.drives.edit(slot) = rows_of_joint(desc).drive;
    return wake_for_joint(desc);
  }
  if (joint.enabled) simulation_.joints.remove(slot);
  pacing_.lets_go = true;
  if (joint.breaks()) --joints_.breakable;
  joint.desc = desc;
  if (enabled && !joint.enabled) joint.made_after = simulation_.steps();  // what it bore before is no reaction of now
  joint.enabled = enabled;
  if (joint.breaks()) ++joints_.breakable;
  put_joint(slot);
  wake_for_joint(desc);
}

}  // namespace plumb::impulse
