// The matrix of all joints of mechanisms that are solved exactly, in memory (joints/joint_elimination.hpp).
#pragma once

#include "joints/joint_block.hpp"
#include "joints/joint_elimination.hpp"
#include "joints/joint_solve.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

/// One end of a joint, as its body sees it.
struct JointOnBody {
  std::uint32_t joint;
  bool is_b;
};

/// A mechanism of the system, solved by itself: what it does depends on no other.
struct SystemMechanism {
  std::uint32_t number;                  ///< among all
  std::uint32_t first_level, level_end;  ///< of its columns
  std::uint32_t first_column, column_end;
  std::uint32_t first_place, place_end;  ///< of its bodies
  bool is_plain;                         ///< as all its joints are

  [[nodiscard]] PLUMB_HD std::uint32_t column_count() const { return column_end - first_column; }
  [[nodiscard]] PLUMB_HD std::uint32_t place_count() const { return place_end - first_place; }
};

/// Mechanisms of more joints are solved by all threads together.
constexpr std::uint32_t kMostSolvedAlone = 256;

/// Joint `column` of the elimination is row base + column of the joints.
struct JointSystem {
  JointView view;
  std::uint32_t base;
  std::uint32_t small_count, mechanism_count;  ///< the first are those that are solved alone
  const SystemMechanism* mechanisms;
  const std::uint32_t* level_first;
  const JointEntry* entries;
  const std::uint32_t* column_first;
  const std::uint32_t* row_entries;
  const std::uint32_t* row_first;
  const JointProduct* products;
  const std::uint32_t* product_first;
  JointBlock* scaled;  ///< L
  JointBlock* whole;   ///< L D
  JointBlock* turned;  ///< L by rows
  std::uint32_t body_count;
  const std::uint32_t* bodies;  ///< that these joints push, by place: mechanism after mechanism
  const std::uint32_t* body_first;
  const JointOnBody* on_body;
  std::uint32_t* changes;  ///< three of each mechanism, in turn: how many changed in a round what the next begins with

  PLUMB_HD int rows(std::uint32_t column) const {
    const int count = row_count(view.joints[base + column]);
    PLUMB_ASSERT(count >= 0 && count <= kJointRows);
    return count;
  }
  PLUMB_HD JointWork& work(std::uint32_t column) const { return view.work[base + column]; }
  /// Whether contacts push the mechanism as a whole in this step (bodies/mechanism.hpp).
  [[nodiscard]] PLUMB_HD bool is_touched(const SystemMechanism& mechanism) const {
    return view.solver.mechanisms.touch_mechanism(bodies[mechanism.first_place]);
  }
  /// Of sub-steps.
  [[nodiscard]] PLUMB_HD std::uint32_t level(const SystemMechanism& mechanism) const {
    return view.solver.levels(bodies[mechanism.first_place]);
  }
};

}  // namespace plumb::impulse
