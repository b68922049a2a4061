#include "joints/joint_order.hpp"

#include <algorithm>
#include <optional>
#include <unordered_set>

#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

/// A whip of so many joints in a row that lock turns turns too far in a sub-step for the rows at its start: they yield.
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

/// What loops, chains and beams a mechanism has, by joint. Those that couple two others keep no body in place, and are
/// in none: their rows say what no other does, and a train of wheels is no whip.
class Build {
 public:
  Build(const JointElimination& all, const std::vector<Join>& joins, const std::vector<bool>& couples)
      : all_(&all), number_(joins.size(), kNone) {
    if (std::find(couples.begin(), couples.end(), true) == couples.end()) return;
    std::vector<Join> others;
    for (std::size_t j = 0; j < joins.size(); ++j) {
      if (couples[j]) continue;
      number_[j] = static_cast<std::uint32_t>(others.size());
      others.push_back(joins[j]);
    }
    others_ = JointEliminator().eliminate(others, kWorld);
  }
  [[nodiscard]] bool in_loop(std::uint32_t j) const { return others_ ? of(j, others_->in_loop) : all_->in_loop[j]; }
  [[nodiscard]] bool is_closed(std::uint32_t j) const {
    return others_ ? of(j, others_->is_closed) : all_->is_closed[j];
  }
  [[nodiscard]] std::uint32_t length(std::uint32_t j) const {
    return others_ ? of(j, others_->length) : all_->length[j];
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  template <class T>
  [[nodiscard]] T of(std::uint32_t j, const std::vector<T>& by_number) const {
    return number_[j] == kNone ? T{} : by_number[number_[j]];
  }

  const JointElimination* all_;
  std::vector<std::uint32_t> number_;  // among those that couple nothing
  std::optional<JointElimination> others_;
};

}  // namespace

OrderedJoints order_joints(const std::vector<StoredJoint>& records, const Table<BodyMass>& masses,
                           JointEliminator& eliminator, bool one_by_one) {
  std::vector<std::uint32_t> slots;
  std::vector<Join> joins;
  std::vector<bool> couples;
  const auto moving = [&](std::uint32_t body) { return is_pushed(body, masses) ? body : kWorld; };
  for (std::uint32_t slot = 0; slot < records.size(); ++slot) {
    const StoredJoint& record = records[slot];
    if (!record.used || !(is_pushed(record.joint.body_a, masses) || is_pushed(record.joint.body_b, masses))) continue;
    slots.push_back(slot);
    joins.emplace_back(moving(record.joint.body_a), moving(record.joint.body_b));
    couples.push_back(record.traits.couples);
  }

  OrderedJoints ordered;
  ordered.elimination = eliminator.eliminate(joins, kWorld);
  const JointElimination& found = ordered.elimination;
  const Build build(found, joins, couples);
  ordered.joints.reserve(slots.size());
  std::unordered_set<std::uint32_t> no_chains;
  const auto put = [&](std::uint32_t j) {
    const StoredJoint& record = records[slots[j]];
    Joint& joint = ordered.joints.emplace_back(record.joint);
    const bool is_stiff = record.traits.locks_turns, is_long = build.length(j) >= kLongBeam;
    joint.in_chain = build.length(j) >= kLongChain;
    joint.in_ring = build.in_loop(j);
    joint.yields_turning = joint.in_ring || (is_stiff && (is_long || !both_turn(record.joint, masses)));
    ordered.axes.push_back(record.axes);
    ordered.mechanism.push_back(found.mechanism[j]);
    if (build.is_closed(j) || has_limits(record.joint, record.axes)) no_chains.insert(found.mechanism[j]);
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
