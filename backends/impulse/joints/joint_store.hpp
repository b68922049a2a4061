// The joints of a world: made and gone on the host, and what kernels work on.
#pragma once

#include <vector>

#include "exec/archive.hpp"
#include "joints/joint_colouring.hpp"
#include "joints/joint_order.hpp"
#include "joints/joint_system_memory.hpp"
#include "joints/mechanism_memory.hpp"

namespace plumb::impulse {

/// A joint as the last step took it.
struct SolvedJoint {
  std::uint32_t slot;
  std::uint32_t colour;  ///< kJointColours: it went by itself
};

class JointStore {
 public:
  /// joint.slot numbers it among the living. axes: of the rows beyond those of its type.
  void add(const Joint& joint, const JointAxes& axes, const JointTraits& traits);
  void remove(std::uint32_t slot);
  [[nodiscard]] std::uint32_t slots() const { return static_cast<std::uint32_t>(records_.size()); }
  /// Slots as many as these; those behind are nobody's.
  void resize(std::size_t slots) {
    changed_ = changed_ || slots != records_.size();
    records_.resize(slots);
    drives.grow(slots);
  }
  /// What the next step remembers of the last one, to or from a snapshot of so many bodies.
  void exchange(Archive& archive, std::size_t bodies);
  /// Room for so many bodies.
  void reserve_bodies(std::size_t bodies) {
    mechanisms_.reserve_bodies(bodies);
    least_moment_.grow(bodies);
    arrivals_.grow(bodies);
    if constexpr (!Executor::kWarps) kept_swings_.grow(bodies);
  }
  /// Bodies can be pushed, or cannot any more, who may have joints.
  void bodies_changed() { changed_ = changed_ || !records_.empty(); }
  /// f(body_a, body_b) for every joint there is; body_a may be kWorld.
  template <class F>
  void for_joined(const F& f) const {
    for (const StoredJoint& record : records_)
      if (record.used) f(record.joint.body_a, record.joint.body_b);
  }
  /// What motors do and where springs rest, by slot; may be edited between steps.
  Table<JointDrive> drives;
  /// Whether all are solved one by one; else mechanisms are solved each as a whole where their matrix stays sparse.
  void solve_one_by_one(bool all) {
    changed_ = changed_ || (all != one_by_one_ && !records_.empty());
    one_by_one_ = all;
  }
  /// Reactions are summed up for all joints from the next step on.
  void want_reactions() { wants_reactions_ = true; }
  /// Of the last step, by slot; of joints that it had, and where reactions are wanted or a joint breaks.
  [[nodiscard]] std::vector<JointReaction> reactions() const { return axes_.reactions.to_host(axes_.reactions.size()); }
  /// Whether upload() is due.
  [[nodiscard]] bool changed() const { return changed_; }

  /// Puts the joints in order and copies them to where kernels run. masses tell which bodies can be pushed.
  void upload(const Table<BodyMass>& masses);

  /// As of the last upload.
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(slot_of_.size()); }
  /// By body, what tension asks of its moments: JointView::least_moment.
  [[nodiscard]] const Real* least_moments() const { return least_moment_.data(); }
  [[nodiscard]] const Joint* device() { return joints_.data(); }
  /// Copied to the host.
  [[nodiscard]] std::vector<SolvedJoint> solved() const;
  /// What the joints ask of a step's code.
  [[nodiscard]] JointCode code() const { return code_; }
  [[nodiscard]] JointSet set(const Bodies& bodies, const SolverBodies& solver);
  /// That contacts move as a whole.
  [[nodiscard]] Mechanisms mechanisms() { return mechanisms_.view(); }
  [[nodiscard]] Real* mobility_scratch() { return mechanisms_.scratch(); }
  /// body_pair_key of bodies that do not collide: those that are joined, and those of one rigid group; in any order,
  /// and some more than once.
  [[nodiscard]] std::vector<std::uint64_t> excluded() const;

 private:
  [[nodiscard]] JointCode needed_code() const;

  bool changed_ = false, wants_reactions_ = false, one_by_one_ = false;
  JointCode code_ = JointCode::kContacts;
  std::vector<StoredJoint> records_;  // by slot
  JointEliminator eliminator_;
  std::vector<std::uint32_t> slot_of_;  // as OrderedJoints, and so
  Buffer<Joint> joints_;
  Buffer<JointWork> work_;
  Buffer<JointImpulse> impulses_;  // by slot
  Buffer<Real> least_moment_;      // by body
  Buffer<JointEnd> arrivals_;      // by body
  Buffer<KeptSwing> kept_swings_;  // by body
  JointColouring colours_;
  JointSystemMemory system_;
  MechanismMemory mechanisms_;
  /// Where the code is JointCode::kAll.
  struct Axes {
    Buffer<JointAxes> axes;  // as OrderedJoints, and so
    Buffer<AxisWork> work;
    Buffer<JointReaction> reactions;  // by slot
    bool any_couples = false;
  } axes_;
};

}  // namespace plumb::impulse
