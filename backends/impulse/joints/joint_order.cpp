#include "joints/joint_order.hpp"

#include <unordered_set>

#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

/// Of so many joints in a row that lock turns the mobility of one end differs from the other's by more than float can
/// tell apart, and a whip of them turns too far in a sub-step for the rows at its start: they yield as those whose rows
/// repeat others.
constexpr std::uint32_t kLongBeam = 4;

/// Errors of so many joints in a row that have no limits are taken back by degrees.
constexpr std::uint32_t kLongChain = 8;

/// Whether a row may come to hold, or let go, from one sub-step to the next.
bool has_limits(const Joint& joint, const JointAxes& axes) {
  for (int i = 0; i < row_count(joint) - rows_of(joint.type); ++i)
    if (axes.row[i].coordinate != kLocked && (axes.lower[i] > -kHuge / 2 || axes.upper[i] < kHuge / 2)) return true;
  return false;
}

bool both_turn(const Joint& joint, const Table<BodyMass>& masses) {
  const auto turns = [&](std::uint32_t body) {
    return !is_pushed(body, masses) || (masses[body].flags & kBodyTurns) != 0;
  };
  return turns(joint.body_a) && turns(joint.body_b);
}

}  // namespace

OrderedJoints order_joints(const std::vector<StoredJoint>& records, const Table<BodyMass>& masses,
                           JointEliminator& eliminator, bool one_by_one) {
  std::vector<std::uint32_t> slots;
  std::vector<Join> joins;
  const auto moving = [&](std::uint32_t body) { return is_pushed(body, masses) ? body : kWorld; };
  for (std::uint32_t slot = 0; slot < records.size(); ++slot) {
    const StoredJoint& record = records[slot];
    if (!record.used || !(is_pushed(record.joint.body_a, masses) || is_pushed(record.joint.body_b, masses))) continue;
    slots.push_back(slot);
    joins.emplace_back(moving(record.joint.body_a), moving(record.joint.body_b));
  }

  OrderedJoints ordered;
  ordered.elimination = eliminator.eliminate(joins, kWorld);
  const JointElimination& found = ordered.elimination;
  ordered.joints.reserve(slots.size());
  std::unordered_set<std::uint32_t> no_chains;
  const auto put = [&](std::uint32_t j) {
    const StoredJoint& record = records[slots[j]];
    Joint& joint = ordered.joints.emplace_back(record.joint);
    const bool is_stiff = record.traits.locks_turns, is_long = found.length[j] >= kLongBeam;
    joint.in_chain = found.length[j] >= kLongChain;
    joint.in_ring = found.in_loop[j];
    joint.in_loop = found.in_loop[j] || (is_stiff && (is_long || !both_turn(record.joint, masses)));
    ordered.axes.push_back(record.axes);
    ordered.mechanism.push_back(found.mechanism[j]);
    if (found.is_closed[j] || has_limits(record.joint, record.axes)) no_chains.insert(found.mechanism[j]);
  };
  for (const std::uint32_t j : found.one_by_one) put(j);
  ordered.base = ordered.count();
  for (const std::uint32_t j : found.order) put(j);
  PLUMB_ASSERT(ordered.count() == slots.size());  // each joint is solved, and once
  for (std::uint32_t j = 0; j < ordered.count(); ++j)
    if (no_chains.contains(ordered.mechanism[j])) ordered.joints[j].in_chain = false;
  if (one_by_one) {
    ordered.base = ordered.count();
    ordered.elimination = JointEliminator().eliminate({}, kWorld);
  }
  return ordered;
}

}  // namespace plumb::impulse
