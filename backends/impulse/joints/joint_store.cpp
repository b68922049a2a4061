#include "joints/joint_store.hpp"

#include <algorithm>

#include "broadphase/pair_filter.hpp"
#include "joints/rigid_groups.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

void JointStore::add(const Joint& joint, const JointAxes& axes, const JointTraits& traits) {
  if (joint.slot >= records_.size()) resize(joint.slot + std::size_t{1});
  PLUMB_ASSERT(!records_[joint.slot].used);
  PLUMB_ASSERT(row_count(joint) >= 1 && row_count(joint) <= kJointRows);
  PLUMB_ASSERT(joint.body_b != kWorld && joint.body_a != joint.body_b);
  records_[joint.slot] = {joint, axes, traits, true};
  changed_ = true;
}

void JointStore::remove(std::uint32_t slot) {
  PLUMB_ASSERT(slot < records_.size() && records_[slot].used);
  records_[slot].used = false;
  changed_ = true;
}

void JointStore::exchange(Archive& archive, std::size_t bodies) {
  const std::size_t slots = records_.size();
  if (changed_) impulses_.grow(slots);
  for (StoredJoint& record : records_) archive.value(record.joint.first_step);
  archive.rows_of_all(impulses_, slots);
  std::uint64_t borne = std::min(axes_.reactions.size(), slots);  // which only some scenes have
  archive.value(borne);
  archive.rows_of_all(axes_.reactions, static_cast<std::size_t>(borne));
  archive.rows_of_all(least_moment_, slots == 0 ? 0 : bodies);
  changed_ = changed_ || archive.reads();
}

JointCode JointStore::needed_code() const {
  JointCode code = JointCode::kContacts;
  for (const StoredJoint& record : records_) {
    if (!record.used) continue;
    code = JointCode::kPlain;
    if (wants_reactions_ || record.traits.breaks || !is_plain(record.joint)) return JointCode::kAll;
  }
  return code;
}

std::vector<std::uint64_t> JointStore::excluded() const {
  std::vector<std::uint64_t> keys;
  RigidGroups groups;
  for (const StoredJoint& record : records_) {
    if (!record.used || record.traits.lets_bodies_touch || record.joint.body_a == kWorld) continue;
    keys.push_back(body_pair_key(record.joint.body_a, record.joint.body_b));
    // What may break bears less where contacts bear some of it.
    if (record.joint.type == JointType::kFixed && !record.traits.breaks)
      groups.weld(record.joint.body_a, record.joint.body_b);
  }
  const std::vector<std::uint64_t> within = groups.pairs();
  keys.insert(keys.end(), within.begin(), within.end());
  return keys;
}

void JointStore::upload(const Table<BodyMass>& masses) {
  code_ = needed_code();
  axes_.any_couples = std::any_of(records_.begin(), records_.end(),
                                  [](const StoredJoint& record) { return record.used && record.traits.couples; });
  const OrderedJoints ordered = order_joints(records_, masses, eliminator_, one_by_one_);
  slot_of_.clear();
  for (const Joint& joint : ordered.joints) slot_of_.push_back(joint.slot);
  colours_.colour(ordered, masses);
  const auto [mechanisms, pushed] = system_.put(ordered, masses);
  mechanisms_.put(mechanisms, pushed, masses.size());
  PLUMB_ASSERT(ordered.base <= ordered.count());
  joints_.assign(ordered.joints);
  work_.grow(ordered.count());
  impulses_.grow(records_.size());
  if (code_ == JointCode::kAll) {
    axes_.axes.assign(ordered.axes);
    axes_.work.grow(ordered.count());
    axes_.reactions.grow(records_.size());
  }
  changed_ = false;
}

std::vector<SolvedJoint> JointStore::solved() const {
  std::vector<SolvedJoint> joints;
  if (count() != 0)
    colours_.for_joints(count(), [&](std::uint32_t j, std::uint32_t colour) {
      joints.push_back({slot_of_[j], colour});
    });
  return joints;
}

JointSet JointStore::set(const Bodies& bodies, const SolverBodies& solver) {
  const JointView view = {bodies,           solver,
                          joints_.data(),   work_.data(),
                          impulses_.data(), least_moment_.data(),
                          arrivals_.data(), kept_swings_.data()};
  const AxisParts axes = {axes_.axes.data(), drives.device(), axes_.work.data(), axes_.reactions.data()};
  return {view, count(), colours_.view(), system_.view(view), axes, axes_.any_couples};
}

}  // namespace plumb::impulse
