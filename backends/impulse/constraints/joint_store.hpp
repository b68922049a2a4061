// The joints of a world on the host: made and gone, ordered by colour, and the pairs of bodies that they keep apart.
#pragma once

#include <vector>

#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "solver/joint_loops.hpp"

namespace plumb::impulse {

class JointStore {
 public:
  /// `slot` numbers the joint among the living. Bodies of a joint that lets them touch may collide.
  void add(const Joint& joint, bool lets_them_touch);
  void remove(std::uint32_t slot);
  [[nodiscard]] const Joint& joint(std::uint32_t slot) const { return by_slot_[slot]; }
  [[nodiscard]] bool changed() const { return changed_; }

  /// Orders what changed and copies it to the device. masses tell who can be pushed.
  void upload(Executor& executor, const Mirror<BodyMass>& masses);

  [[nodiscard]] JointSet set(const Bodies& bodies, const SolverBodies& solver, bool gyroscopic);
  /// body_pair_key of bodies that do not collide, ascending.
  [[nodiscard]] const std::uint64_t* excluded() { return excluded_.device(); }
  [[nodiscard]] std::uint32_t excluded_count() const { return excluded_count_; }

 private:
  void order_by_colour(const Mirror<BodyMass>& masses);
  void list_excluded();

  bool changed_ = false, overflow_ = false;
  std::vector<Joint> by_slot_;
  std::vector<bool> used_, lets_touch_;
  std::uint32_t count_ = 0, colours_ = 0, excluded_count_ = 0;
  Mirror<Joint> joints_;  // by colour, and by slot within it
  Mirror<std::uint32_t> first_;
  Mirror<std::uint64_t> excluded_;
  Buffer<JointWork> work_;
  Buffer<JointImpulse> impulses_;  // by slot
};

}  // namespace plumb::impulse
