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

constexpr int kJointRows = 7;
/// A number of each row, with room for a whole vector: what is in lanes beyond the rows does not count.
using RowNumbers = Real[kLaneGroup];
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
  bool in_ring;  ///< its mechanism closes on itself, through what stands still, too; found when joints are put in
                 ///< order
  bool yields_turning;  ///< its rows yield where its bodies turn far in a sub-step; likewise
  bool in_chain;        ///< of so many joints that errors are taken back by degrees; likewise
  Frame frame_a, frame_b;
  Position world_anchor;  ///< of frame a where body_a is kWorld
};

/// Of a joint, in words that let a compiler see how few there are.
PLUMB_HD inline int row_count(const Joint& joint) {
  const int rows = joint.rows;
  if (rows < 0 || rows > kJointRows) __builtin_unreachable();
  return rows;
}

/// Whether its type alone says what it holds: it has no limit, motor, spring or locked axis beside.
PLUMB_HD inline bool is_plain(const Joint& joint) {
  return joint.type != JointType::kOther && joint.rows == rows_of(joint.type);
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

/// How far an axis of frame a is from b's of the same name, as two numbers along the next axes of frame b, and their
/// rows: b's axis seen from a's by stereographic projection, twice the tangent of half the angle. Seen so it goes
/// equally fast whichever way it turns, where its sine, the usual measure, has two rows that are one at a right angle.
/// Beyond that numbers and rows are no longer than there (is_far_off).
class Alignment {
 public:
  PLUMB_HD Alignment(const Vec& axis, const Mat& b, int which)
      : axis_(axis), b_axis_(b[which]), other_{b[(which + 1) % 3], b[(which + 2) % 3]}, cosine_(dot(b_axis_, axis)) {}

  PLUMB_HD Real error(int i) const { return is_beyond() ? 2 * way_there(i) : scale() * dot(other_[i], axis_); }
  /// On b.
  PLUMB_HD Vec row(int i) const {
    if (!is_beyond())
      return scale() * cross(other_[i] - (dot(other_[i], axis_) / (Real(1) + cosine_)) * b_axis_, axis_);
    const Vec about = normalized_or(cross(b_axis_, axis_), other_[1]);
    return Real(2) * (cross(other_[i], axis_) - (way_there(i) * (Real(1) - cosine_)) * about);
  }

 private:
  PLUMB_HD bool is_beyond() const { return cosine_ < 0; }
  PLUMB_HD Real scale() const { return 2 / (Real(1) + cosine_); }
  /// Which way a's axis leans, of length one. Where it is opposite to b's each would do.
  PLUMB_HD Real way_there(int i) const {
    const Real y = dot(other_[0], axis_), z = dot(other_[1], axis_), size = sqrt(y * y + z * z);
    if (size > 0) return (i == 0 ? y : z) / size;
    return i == 0 ? Real(1) : Real(0);
  }

  Vec axis_, b_axis_, other_[2];
  Real cosine_;
};

/// Of frame b seen from frame a.
PLUMB_HD inline Quat turn_of(const JointPlace& place) { return conjugate(place.frame_a) * place.frame_b; }

/// The turn of frame b seen from frame a, as a vector in frame a: its direction times twice the sine of half the angle.
PLUMB_HD inline Vec turn_error(const JointPlace& place) {
  const Quat turn = turn_of(place);
  return (turn.w < 0 ? Real(-2) : Real(2)) * vector_part(turn);
}

/// Whether the frames are turned more than a right angle from where turn_error is 0.
PLUMB_HD inline bool is_turned_far(const JointPlace& place) {
  const Quat turn = turn_of(place);
  return turn.w * turn.w < Real(0.5);
}

/// Whether turns that a joint holds are so far off that their numbers, a little further on, say nothing of the way
/// there: beyond half a turn the way back is another. As for a joint that was made or changed with bodies elsewhere.
PLUMB_HD inline bool is_far_off(const Joint& joint, const JointPlace& place) {
  switch (joint.type) {
    case JointType::kHinge: return dot(rotate(place.frame_a, {1, 0, 0}), rotate(place.frame_b, {1, 0, 0})) < 0;
    case JointType::kSlider:
    case JointType::kFixed: return is_turned_far(place);
    default: return false;
  }
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
      const Alignment alignment(rotate(place.frame_a, {1, 0, 0}), to_matrix(place.frame_b), 0);
      error[3] = alignment.error(0);
      error[4] = alignment.error(1);
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
      const Alignment alignment(rotate(place.frame_a, {1, 0, 0}), to_matrix(place.frame_b), 0);
      rows[3] = turn_row(alignment.row(0));
      rows[4] = turn_row(alignment.row(1));
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
