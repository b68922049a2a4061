// The joints of a world on the host: made and gone, put in the order in which they are solved, and the pairs of bodies
// that they keep apart.
#pragma once

#include <vector>

#include "bodies/mechanism.hpp"
#include "exec/archive.hpp"
#include "exec/memory.hpp"
#include "exec/table.hpp"
#include "joints/joint_elimination.hpp"
#include "joints/joint_loops.hpp"

namespace plumb::impulse {

/// A joint as the last step took it.
struct SolvedJoint {
  std::uint32_t slot;
  std::uint32_t colour;  ///< kJointColours: it went by itself
};

struct JointTraits {
  bool lets_bodies_touch;
  bool locks_turns;
  bool breaks;
};

class JointStore {
 public:
  /// joint.slot numbers it among the living. axes: of the rows beyond those of its type.
  void add(const Joint& joint, const JointAxes& axes, const JointTraits& traits);
  void remove(std::uint32_t slot);
  [[nodiscard]] std::uint32_t slots() const { return static_cast<std::uint32_t>(rows_.size()); }
  /// What the next step remembers of the last one, of the first slots, to or from a snapshot.
  void exchange(Archive& archive, std::size_t slots) {
    if (changed_) impulses_.grow(rows_.size());
    archive.rows(impulses_, slots);
    std::uint64_t borne = reactions_.size();  // which only some scenes have
    archive.value(borne);
    archive.rows(reactions_, borne);
    std::uint64_t bodies = rows_.empty() ? 0 : least_moment_.size();
    archive.value(bodies);
    archive.rows(least_moment_, bodies);
    changed_ = changed_ || archive.reads();
  }
  /// Room for so many bodies.
  void reserve_bodies(std::size_t bodies) {
    place_of_.grow(bodies);
    least_moment_.grow(bodies);
  }
  /// Bodies can be pushed, or cannot any more, who may have joints.
  void bodies_changed() { changed_ = changed_ || !rows_.empty(); }
  /// f(body_a, body_b) for every joint there is; body_a may be kWorld.
  template <class F>
  void for_joined(const F& f) const {
    for (const Row& row : rows_)
      if (row.used) f(row.joint.body_a, row.joint.body_b);
  }
  /// What motors do, by slot; may be edited between steps.
  Table<JointDrive> drives;
  /// Reactions are summed up for all joints from the next step on.
  void want_reactions() { wants_reactions_ = true; }
  /// Of the last step, by slot; of joints that it had, and where reactions are wanted or a joint breaks.
  [[nodiscard]] std::vector<JointReaction> reactions() const { return reactions_.to_host(reactions_.size()); }
  /// Whether upload() is due.
  [[nodiscard]] bool changed() const { return changed_; }

  /// Puts the joints in order and copies them to where kernels run. masses tell which bodies can be pushed.
  void upload(const Table<BodyMass>& masses);

  /// As of the last upload.
  [[nodiscard]] std::uint32_t count() const { return count_; }
  [[nodiscard]] const Joint* device() { return joints_.data(); }
  /// Copied to the host.
  [[nodiscard]] std::vector<SolvedJoint> solved() const;
  /// What the joints ask of a step's code.
  [[nodiscard]] JointCode code() const { return code_; }
  [[nodiscard]] JointSet set(const Bodies& bodies, const SolverBodies& solver, bool gyroscopic);
  /// That contacts move as a whole.
  [[nodiscard]] Mechanisms mechanisms() {
    return {held_ == 0 ? nullptr : place_of_.data(), mechanism_bodies_.data(), loads_.data(), mobility_.data(), held_};
  }
  [[nodiscard]] MechanismColumns mechanism_columns() { return {columns_.data(), number_of_.data(), scratch_.data()}; }
  /// body_pair_key of bodies that do not collide: those that are joined, and those of one rigid group; in any order,
  /// and some more than once.
  [[nodiscard]] std::vector<std::uint64_t> excluded() const;

 private:
  struct Row {
    Joint joint;
    JointAxes axes;
    JointTraits traits;
    bool used;
  };
  [[nodiscard]] JointCode needed_code() const;
  void colour(const Table<BodyMass>& masses);
  void list_pushed_bodies(const Table<BodyMass>& masses);
  void list_mechanisms(std::size_t bodies);

  bool changed_ = false, overflow_ = false, wants_reactions_ = false;
  JointCode code_ = JointCode::kContacts;
  std::vector<Row> rows_;  // by slot
  JointEliminator eliminator_;
  std::vector<Joint> ordered_;               // those that are solved one by one, by slot; then the system, in its order
  std::vector<std::uint32_t> mechanism_of_;  // as ordered_: a number
  std::vector<std::uint32_t> pushed_list_;   // bodies by place: mechanism after mechanism
  std::uint32_t count_ = 0, colours_ = 0;
  Buffer<Joint> joints_;  // as ordered_
  Buffer<std::uint32_t> by_colour_, first_, system_first_;
  Buffer<JointWork> work_;
  Buffer<JointImpulse> impulses_;  // by slot
  // Where the code is JointCode::kAll:
  Buffer<JointAxes> axes_;  // as ordered_
  Buffer<AxisWork> axis_work_;
  Buffer<JointReaction> reactions_;  // by slot
  Buffer<std::uint32_t> changes_;

  std::uint32_t base_ = 0, levels_ = 0, pushed_count_ = 0;  // of the system
  Buffer<std::uint32_t> level_first_, column_first_, row_entries_, row_first_, product_first_, pushed_, pushed_first_;
  Buffer<JointEntry> entries_;
  Buffer<JointProduct> products_;
  Buffer<JointOnBody> on_body_;
  Buffer<JointBlock> scaled_, whole_;

  Buffer<Real> least_moment_;  // by body

  std::uint32_t held_ = 0;  // places, or 0 where contacts see all bodies alone
  Buffer<std::uint32_t> place_of_, columns_, number_of_;
  Buffer<MechanismBody> mechanism_bodies_;
  Buffer<ContactLoad> loads_;
  Buffer<Real> mobility_, scratch_;
};

}  // namespace plumb::impulse
