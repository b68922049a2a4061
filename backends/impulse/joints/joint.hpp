// The joint constraints that always hold: ball, hinge, slider, distance and fixed, as up to six scalar rows each.
//
// A row is a number C that should be 0, its rate J V for the velocities V of the two bodies, and the impulse along J^T.
// All rows of a joint are solved at once by the inverse of their matrix K = J M^-1 J^T (Catto, "Modeling and Solving
// Constraints", GDC 2009, on point and hinge constraints). Two passes belong to a sub-step. The first finds impulses
// along the rows at its start with which the rows hold at its end, where the bodies really arrive, turns included; the
// second takes back what speed then is left along the rows at the end. That is RATTLE (Andersen, J. Comput. Phys. 52,
// 1983): it neither drifts nor gains or loses energy, and momentum is kept to rounding.
#pragma once

#include "bodies/body.hpp"
#include "math/mat33.hpp"
#include "math/wide.hpp"

namespace plumb::impulse {

constexpr int kJointRows = 6;
/// A number of each row. A CPU has room for a whole vector: what is in lanes beyond the rows does not count.
constexpr int kRowRoom = kLanes == 1 ? kJointRows : static_cast<int>(kLaneGroup);
using RowNumbers = Real[kRowRoom];
constexpr std::uint32_t kWorld = 0xffffffffu;  // stands for a body that is not there: the world

/// kOther: what only joint_axes.hpp can describe, as it can all others.
enum class JointType : std::uint32_t { kBall, kHinge, kSlider, kDistance, kFixed, kOther };

PLUMB_HD constexpr int rows_of(JointType type) {
  switch (type) {
    case JointType::kBall: return 3;
    case JointType::kHinge:
    case JointType::kSlider: return 5;
    case JointType::kDistance: return 1;
    case JointType::kFixed: return 6;
    case JointType::kOther: return 0;
  }
  return 0;
}

/// Of these the rows whose impulse is one of force, not of torque, as bits.
PLUMB_HD constexpr std::uint32_t pulls_of(JointType type) {
  switch (type) {
    case JointType::kBall:
    case JointType::kHinge:
    case JointType::kFixed: return 0b111;
    case JointType::kSlider: return 0b11;
    case JointType::kDistance: return 0b1;
    case JointType::kOther: return 0;
  }
  return 0;
}

/// What is given once for a joint. Frames are in the bodies' principal frames, from their centres of mass.
struct Joint {
  JointType type;
  std::uint32_t body_a;  ///< or kWorld
  std::uint32_t body_b;
  std::uint32_t slot;        ///< of its impulses, which outlive the order of the joints
  std::uint32_t first_step;  ///< the step before which it was made: older impulses of the slot are another's
  int rows;
  std::uint32_t pulls;  ///< a bit for each row whose impulse is one of force, not of torque
  Real rest_length;     ///< m
  bool in_loop;         ///< of its mechanism some rows may repeat others; found when joints are put in order
  bool in_ring;         ///< its mechanism closes on itself, through what stands still, too; likewise
  bool in_chain;        ///< of so many joints that errors are taken back by degrees; likewise
  Frame frame_a, frame_b;
  Position world_anchor;  ///< of frame a where body_a is kWorld
};

/// How many numbers of n rows a loop goes through: a CPU does a whole vector at once.
PLUMB_HD constexpr int whole_rows(int n) { return kLanes == 1 ? n : kRowRoom; }

/// Of a joint, in words that let a compiler see how few there are.
PLUMB_HD inline int row_count(const Joint& joint) {
  const int rows = joint.rows;
  if (rows < 0 || rows > kJointRows) __builtin_unreachable();
  return rows;
}

/// A joint's frames as they stand.
struct JointPlace {
  Vec gap;           ///< from the origin of frame a to that of frame b, m
  Vec arm_a, arm_b;  ///< from the centres of mass to the origins
  Quat frame_a, frame_b;
};

/// A body as a joint sees it: where it is in the step that runs.
struct JointEnd {
  Vec moved;
  Quat orientation;
};

/// base: from a's place to b's at the start of the step.
PLUMB_HD inline JointPlace place_joint(const Joint& joint, const Vec& base, const JointEnd& a, const JointEnd& b) {
  JointPlace place;
  place.arm_a = rotate(a.orientation, joint.frame_a.position);
  place.arm_b = rotate(b.orientation, joint.frame_b.position);
  place.frame_a = a.orientation * joint.frame_a.orientation;
  place.frame_b = b.orientation * joint.frame_b.orientation;
  place.gap = base + ((b.moved - a.moved) + (place.arm_b - place.arm_a));
  return place;
}

PLUMB_HD inline Vec distance_direction(const JointPlace& place) {
  return normalized_or(place.gap, rotate(place.frame_a, {1, 0, 0}));
}

/// Two numbers that are 0 where an axis of frame a coincides with b's of the same name, and grow up to a right angle;
/// beyond it they stay. b_next and b_last are the other axes of frame b.
PLUMB_HD inline void hinge_errors(const Vec& axis, const Vec& b_axis, const Vec& b_next, const Vec& b_last,
                                  Real* error) {
  const Real y = dot(b_next, axis), z = dot(b_last, axis);
  const bool beyond = dot(b_axis, axis) < 0;
  const Real size = sqrt(y * y + z * z);
  error[0] = beyond ? (size > 0 ? y / size : Real(1)) : y;
  error[1] = beyond && size > 0 ? z / size : z;
}

/// The turn of frame b seen from frame a, as a vector in frame a: its direction times twice the sine of half the angle.
PLUMB_HD inline Vec turn_error(const JointPlace& place) {
  const Quat turn = conjugate(place.frame_a) * place.frame_b;
  return (turn.w < 0 ? Real(-2) : Real(2)) * vector_part(turn);
}

/// C of each row.
PLUMB_HD inline void joint_errors(const Joint& joint, const JointPlace& place, RowNumbers& error) {
  const auto put = [&error](int row, const Vec& v) {
    error[row] = v.x;
    error[row + 1] = v.y;
    error[row + 2] = v.z;
  };
  switch (joint.type) {
    case JointType::kDistance: error[0] = length(place.gap) - joint.rest_length; return;
    case JointType::kSlider: {
      const Vec gap = rotate_back(place.frame_a, place.gap);
      error[0] = gap.y;
      error[1] = gap.z;
      put(2, turn_error(place));
      return;
    }
    case JointType::kBall: put(0, place.gap); return;
    case JointType::kHinge: {
      put(0, place.gap);
      const Mat b = to_matrix(place.frame_b);
      hinge_errors(rotate(place.frame_a, {1, 0, 0}), b.x, b.y, b.z, error + 3);
      return;
    }
    case JointType::kFixed:
      put(0, place.gap);
      put(3, turn_error(place));
      return;
    case JointType::kOther: return;
  }
}

/// J of a row: the rate of C is direction . (v_b - v_a) + on_a . w_a + on_b . w_b.
struct JointRow {
  Vec direction, on_a, on_b;
};

PLUMB_HD inline JointRow point_row(const Vec& direction, const Vec& arm_a, const Vec& arm_b) {
  return {direction, cross(direction, arm_a), cross(arm_b, direction)};
}
PLUMB_HD inline JointRow turn_row(const Vec& axis) { return {{0, 0, 0}, -axis, axis}; }

PLUMB_HD inline void joint_rows(const Joint& joint, const JointPlace& place, JointRow (&rows)[kJointRows]) {
  const auto put_turns = [&](int first) {
    const Mat axes = to_matrix(place.frame_a);
    for (int i = 0; i < 3; ++i) rows[first + i] = turn_row(axes[i]);
  };
  const auto put_point = [&] {
    rows[0] = point_row({1, 0, 0}, place.arm_a, place.arm_b);
    rows[1] = point_row({0, 1, 0}, place.arm_a, place.arm_b);
    rows[2] = point_row({0, 0, 1}, place.arm_a, place.arm_b);
  };
  switch (joint.type) {
    case JointType::kDistance: rows[0] = point_row(distance_direction(place), place.arm_a, place.arm_b); return;
    case JointType::kSlider: {
      const Mat axes = to_matrix(place.frame_a);
      const Vec arm_a = place.arm_a + place.gap;  // the axis turns with a about a's centre of mass
      rows[0] = point_row(axes.y, arm_a, place.arm_b);
      rows[1] = point_row(axes.z, arm_a, place.arm_b);
      put_turns(2);
      return;
    }
    case JointType::kBall: put_point(); return;
    case JointType::kHinge: {
      put_point();
      const Vec axis = rotate(place.frame_a, {1, 0, 0});
      const Mat b = to_matrix(place.frame_b);
      rows[3] = turn_row(cross(b.y, axis));
      rows[4] = turn_row(cross(b.z, axis));
      return;
    }
    case JointType::kFixed:
      put_point();
      put_turns(3);
      return;
    case JointType::kOther: return;
  }
}

}  // namespace plumb::impulse
