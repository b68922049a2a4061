#include "constraints/joint_store.hpp"

#include <algorithm>

#include "broadphase/pair_filter.hpp"

namespace plumb::impulse {

void JointStore::add(const Joint& joint, bool lets_them_touch) {
  if (joint.slot >= by_slot_.size()) {
    by_slot_.resize(joint.slot + 1);
    used_.resize(joint.slot + 1);
    lets_touch_.resize(joint.slot + 1);
  }
  by_slot_[joint.slot] = joint;
  used_[joint.slot] = true;
  lets_touch_[joint.slot] = lets_them_touch;
  changed_ = true;
}

void JointStore::remove(std::uint32_t slot) {
  used_[slot] = false;
  changed_ = true;
}

/// Greedily in the order of slots, which is that of creation as long as none was taken away: deterministic, and two
/// colours for a chain. What finds no colour goes last.
void JointStore::order_by_colour(const Mirror<BodyMass>& masses) {
  constexpr std::uint32_t kNoColour = kJointColours - 1;
  std::vector<std::uint32_t> taken(masses.size());
  std::vector<std::vector<std::uint32_t>> colours(kJointColours);
  count_ = colours_ = 0;
  for (std::uint32_t slot = 0; slot < by_slot_.size(); ++slot) {
    if (!used_[slot]) continue;
    const Joint& joint = by_slot_[slot];
    const auto pushes = [&](std::uint32_t body) { return body != kWorld && (masses[body].flags & kBodyDynamic) != 0; };
    const bool a = pushes(joint.body_a), b = pushes(joint.body_b);
    const std::uint32_t mask = (a ? taken[joint.body_a] : 0) | (b ? taken[joint.body_b] : 0);
    std::uint32_t colour = 0;
    while (colour < kNoColour && (mask >> colour & 1U) != 0) ++colour;
    if (a) taken[joint.body_a] |= 1U << colour;
    if (b) taken[joint.body_b] |= 1U << colour;
    colours[colour].push_back(slot);
    colours_ = std::max(colours_, colour + 1);
    ++count_;
  }
  overflow_ = !colours[kNoColour].empty();
  joints_.grow(count_);
  first_.grow(kJointColours + 1);
  std::uint32_t row = 0;
  for (std::uint32_t colour = 0; colour < kJointColours; ++colour) {
    first_[colour] = row;
    for (const std::uint32_t slot : colours[colour]) joints_[row++] = by_slot_[slot];
  }
  first_[kJointColours] = row;
}

void JointStore::list_excluded() {
  std::vector<std::uint64_t> keys;
  for (std::uint32_t slot = 0; slot < by_slot_.size(); ++slot)
    if (used_[slot] && !lets_touch_[slot] && by_slot_[slot].body_a != kWorld)
      keys.push_back(body_pair_key(by_slot_[slot].body_a, by_slot_[slot].body_b));
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  excluded_count_ = static_cast<std::uint32_t>(keys.size());
  excluded_.grow(excluded_count_);
  std::copy(keys.begin(), keys.end(), excluded_.host());
}

void JointStore::upload(Executor& executor, const Mirror<BodyMass>& masses) {
  order_by_colour(masses);
  list_excluded();
  work_.grow(count_);
  impulses_.grow(by_slot_.size());
  executor.to_device(joints_, count_);
  executor.to_device(first_, kJointColours + 1);
  executor.to_device(excluded_, excluded_count_);
  changed_ = false;
}

JointSet JointStore::set(const Bodies& bodies, const SolverBodies& solver, bool gyroscopic) {
  const JointView view = {bodies, solver, joints_.device(), work_.data(), impulses_.data(), gyroscopic};
  return {view, first_.device(), count_, colours_, overflow_};
}

}  // namespace plumb::impulse
