// The joints of a world in the order in which they are solved, worked out on the host when joints change.
#pragma once

#include <cstdint>
#include <vector>

#include "exec/table.hpp"
#include "joints/joint.hpp"
#include "joints/joint_axes.hpp"
#include "joints/joint_elimination.hpp"

namespace plumb::impulse {

/// Whether forces move the body.
[[nodiscard]] inline bool is_pushed(std::uint32_t body, const Table<BodyMass>& masses) {
  return body != kWorld && (masses[body].flags & kBodyDynamic) != 0;
}

struct JointTraits {
  bool lets_bodies_touch;
  bool locks_turns;
  bool breaks;
  bool couples;  ///< gear or rack: it holds a ratio of what its bodies do on other joints
};

/// A joint as the host made it.
struct StoredJoint {
  Joint joint;
  JointAxes axes;  ///< of the rows beyond those of its type
  JointTraits traits;
  bool used = false;  ///< false: it is gone
};

/// Those of which a body is pushed. From `base` on they are the system, in the order of its elimination; before it
/// those that are solved one by one, by slot.
struct OrderedJoints {
  std::vector<Joint> joints;
  std::vector<JointAxes> axes;
  std::vector<std::uint32_t> mechanism;  ///< a number
  std::uint32_t base = 0;
  JointElimination elimination;

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(joints.size()); }
};

/// records: by slot. masses tell which bodies are pushed. What the eliminator knows of mechanisms serves again.
/// one_by_one: all are solved so.
[[nodiscard]] OrderedJoints order_joints(const std::vector<StoredJoint>& records, const Table<BodyMass>& masses,
                                         JointEliminator& eliminator, bool one_by_one);

}  // namespace plumb::impulse
