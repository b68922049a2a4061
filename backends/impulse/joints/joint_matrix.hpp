// The matrix of all joints of mechanisms that are solved exactly, in memory (joints/joint_elimination.hpp).
#pragma once

#include "joints/joint_axis_solve.hpp"
#include "joints/joint_block.hpp"
#include "joints/joint_elimination.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

/// One end of a joint, as its body sees it.
struct JointOnBody {
  std::uint32_t joint;
  bool is_b;
};

/// Joint `column` of the elimination is row base + column of the joints.
struct JointSystem {
  JointView view;
  std::uint32_t base, levels;
  const std::uint32_t* level_first;
  const JointEntry* entries;
  const std::uint32_t* column_first;
  const std::uint32_t* row_entries;
  const std::uint32_t* row_first;
  const JointProduct* products;
  const std::uint32_t* product_first;
  JointBlock* scaled;  ///< L
  JointBlock* whole;   ///< L D
  JointBlock* turned;  ///< L by rows, on a CPU
  std::uint32_t body_count;
  const std::uint32_t* bodies;  ///< that these joints push, by place: mechanism after mechanism
  const std::uint32_t* body_first;
  const JointOnBody* on_body;
  std::uint32_t* changes;  ///< three, in turn: how many changed in a round what the next one begins with

  PLUMB_HD int rows(std::uint32_t column) const {
    const int count = row_count(view.joints[base + column]);
    PLUMB_ASSERT(count >= 0 && count <= kJointRows);
    return count;
  }
  PLUMB_HD JointWork& work(std::uint32_t column) const { return view.work[base + column]; }
};

}  // namespace plumb::impulse
