// Rows of joints beyond those that always hold (joint.hpp): one for each axis that a joint leaves free and that has
// limits, a motor or a spring, and the locks of universal and generic joints.
//
// Turns are counted about a's x, then the turned y, then the turned z: R = Rx Ry Rz. Where one or two of the three are
// locked, the free ones are measured and pushed along axes of the bodies that are square to each other, which knows no
// singular place; of three free ones the first and the last lose their meaning where the second is a right angle.
#pragma once

#include "joints/joint.hpp"
#include "math/angle.hpp"
#include "math/swing_twist.hpp"

namespace plumb::impulse {

enum class RowKind : std::uint8_t {
  kPoint,     ///< the origins' gap along an axis of the world
  kAlong,     ///< along an axis of frame a
  kDistance,  ///< of the origins
  kTurn,      ///< one of the three numbers of turn_error
  kAlign,     ///< one of the two of an Alignment of an axis
  kSquare,    ///< an axis of a against one of b that should be square to it
  kAngle,     ///< a turn that is free
  kTwist,     ///< the twist of a turn that is all free
  kCone,      ///< its swing, as the half angle about y of the cone through it
  kSwing,     ///< one of the two numbers of that swing
  kGear,      ///< what a has turned about its x and, times ratio, b about its own, since the joint was made
  kRack       ///< how far the toothed line along b's x has slipped on the wheel about a's x since then
};

/// Whether the row's number is an angle that goes round.
PLUMB_HD constexpr bool goes_round(RowKind kind) { return kind == RowKind::kAngle || kind == RowKind::kTwist; }

/// Whether it is of a swing. Such rows are the last of their joint.
PLUMB_HD constexpr bool is_of_swing(RowKind kind) { return kind == RowKind::kCone || kind == RowKind::kSwing; }

/// Whether the row's number is the way that it has gone: no place tells how often a wheel has gone round.
PLUMB_HD constexpr bool is_of_way(RowKind kind) { return kind == RowKind::kGear || kind == RowKind::kRack; }

/// What a row holds or drives.
struct RowSpec {
  RowKind kind;
  std::uint8_t axis;        ///< 0..2: x y z
  std::uint8_t other;       ///< kAlign: which of the two; kSquare: b's axis; kAngle: bits of the turns that are free
  std::uint8_t coordinate;  ///< 0..5: the joint's axis that the row drives, or kLocked
};
constexpr std::uint8_t kLocked = 6;

/// The rows of a joint beyond rows_of(type), as the first of these. Numbers are of the row: m or rad.
struct JointAxes {
  RowSpec row[kJointRows];
  Real lower[kJointRows], upper[kJointRows];  ///< beyond kHuge / 2: none
  /// Of the spring: N/m and N s/m, N m/rad and N m s/rad; of one that is given by its frequency, per mass that it works
  /// against: 1/s2 and 1/s.
  Real stiffness[kJointRows], damping[kJointRows];
  Real narrow;                    ///< of kCone: the half angle about y by that about z
  Real ratio;                     ///< of kGear: turns of a for one of b; of kRack: of a for b's way, rad/m
  std::uint32_t springs_by_mass;  ///< bits: rows whose spring is given by its frequency
  std::uint32_t masses_alone;     ///< whether no turn is free: then springs along axes work against the masses

  [[nodiscard]] PLUMB_HD bool has_spring(int i) const { return stiffness[i] > 0 || damping[i] > 0; }
  [[nodiscard]] PLUMB_HD bool is_by_mass(int i) const { return (springs_by_mass >> i & 1U) != 0; }
  /// By which stiffness and damping are to be multiplied. mass: what the spring works against.
  [[nodiscard]] PLUMB_HD Real spring_unit(int i, Real mass) const { return is_by_mass(i) ? mass : Real(1); }
};

/// What the host may write between steps, by the joint's axis.
struct JointDrive {
  Real velocity[6];   ///< m/s, rad/s
  Real max_force[6];  ///< N, N m; 0: no motor
  Real rest[6];       ///< of springs, m or rad
};

/// From a coordinate to the limits of its row, m or rad: beyond the lower one where that is above 0, beyond the upper
/// one where that is below.
struct WaysToLimits {
  bool has_lower, has_upper;
  Real lower, upper;
};
PLUMB_HD inline WaysToLimits ways_to_limits(const JointAxes& axes, int row, Real x) {
  const Real lower = axes.lower[row], upper = axes.upper[row];
  const bool has_lower = lower > -kHuge / 2, has_upper = upper < kHuge / 2;
  if (!has_lower && !has_upper) return {false, false, 0, 0};
  // Angles are counted from the middle between the limits, so that they jump where the joint never is.
  const bool turns = goes_round(axes.row[row].kind);
  const Real middle = turns && has_lower && has_upper && upper - lower < 2 * kPi ? (lower + upper) / 2 : Real(0);
  const Real from_middle = turns ? wrapped(x - middle) : x;
  return {has_lower, has_upper, (lower - middle) - from_middle, (upper - middle) - from_middle};
}

/// How far a coordinate is beyond the limits of its row, m or rad.
PLUMB_HD inline Real beyond_limits(const JointAxes& axes, int row, Real x) {
  const WaysToLimits to = ways_to_limits(axes, row, x);
  return max(to.has_lower ? to.lower : Real(0), max(to.has_upper ? -to.upper : Real(0), Real(0)));
}

/// Both frames as matrices: cosine(i, j) of axis i of a and axis j of b.
struct JointAxesPlace {
  Mat a, b;
  Swing swing;  ///< where a row is of it
  PLUMB_HD Real cosine(int i, int j) const { return dot(a[i], b[j]); }
};
/// Of a joint with rows beyond those of its type; of others nothing is asked for.
PLUMB_HD inline JointAxesPlace axes_of(const Joint& joint, const JointAxes& axes, const JointPlace& place) {
  const int rows = row_count(joint) - rows_of(joint.type);
  if (rows == 0) return JointAxesPlace();
  const Mat a = to_matrix(place.frame_a), b = to_matrix(place.frame_b);
  return {a, b, is_of_swing(axes.row[rows - 1].kind) ? Swing(a, b.x) : Swing()};
}

/// A free turn: its angle and the direction along which it turns, all others that are free kept.
struct FreeTurn {
  Real angle;
  Vec direction;
};
PLUMB_HD inline FreeTurn free_turn(const JointAxesPlace& at, int axis, std::uint32_t free) {
  const auto cosine = [&](int i, int j) { return at.cosine(i, j); };
  switch (free) {
    case 1:
    case 2:
    case 4: {
      const int i = (axis + 1) % 3, j = (axis + 2) % 3;
      return {angle_of(cosine(j, i) - cosine(i, j), cosine(i, i) + cosine(j, j)), at.a[axis]};
    }
    case 3:  // Rx Ry
      if (axis == 0) return {angle_of(cosine(2, 1), cosine(1, 1)), at.a.x};
      return {angle_of(cosine(0, 2), cosine(0, 0)), at.b.y};
    case 5:  // Rx Rz
      if (axis == 0) return {angle_of(-cosine(1, 2), cosine(2, 2)), at.a.x};
      return {angle_of(-cosine(0, 1), cosine(0, 0)), at.b.z};
    case 6:  // Ry Rz
      if (axis == 1) return {angle_of(cosine(0, 2), cosine(2, 2)), at.a.y};
      return {angle_of(cosine(1, 0), cosine(1, 1)), at.b.z};
    default: break;
  }
  const Real sine = cosine(0, 2), level = max(Real(1) - sine * sine, Real(1e-4));  // the cosine's square
  if (axis == 1) {
    const Real across = sqrt(cosine(1, 2) * cosine(1, 2) + cosine(2, 2) * cosine(2, 2));
    return {angle_of(sine, across), normalized_or(cross(at.b.z, at.a.x), at.a.y)};
  }
  const Real share = Real(1) / level;
  if (axis == 0) return {angle_of(-cosine(1, 2), cosine(2, 2)), share * (at.a.x - sine * at.b.z)};
  return {angle_of(-cosine(0, 1), cosine(0, 0)), share * (at.b.z - sine * at.a.x)};
}

/// How far two axes are from square, twice the tangent of half that angle, and its row on b: where they are parallel,
/// which their cosine as the measure would not come back from, it turns about another axis of a.
struct OffSquare {
  Real error;
  Vec row;
};
PLUMB_HD inline OffSquare off_square(const JointAxesPlace& at, int of_a, int of_b) {
  const Vec across = cross(at.b[of_b], at.a[of_a]);
  const Real scale = 2 / (Real(1) + length(across));
  return {scale * at.cosine(of_a, of_b), scale * normalized_or(across, at.a[(of_a + 1) % 3])};
}

/// Of a wheel and a toothed line that meet where the wheel goes as fast as the line: of the two bodies, there.
PLUMB_HD inline JointRow rack_row(Real ratio, const JointPlace& place, const JointAxesPlace& at) {
  const Vec from_axis = (Real(1) / ratio) * cross(at.b.x, at.a.x);
  return point_row(at.b.x, place.arm_a + from_axis, place.arm_b - place.gap + from_axis);
}

/// Of a row that is locked what should be 0, else the coordinate; 0 of one whose number is its way.
PLUMB_HD inline Real axis_error(const RowSpec& row, Real narrow, const JointPlace& place, const JointAxesPlace& at) {
  const int k = row.axis;
  switch (row.kind) {
    case RowKind::kPoint: return place.gap[k];
    case RowKind::kAlong: return dot(place.gap, at.a[k]);
    case RowKind::kDistance: return length(place.gap);
    case RowKind::kTurn: return turn_error(place)[k];
    case RowKind::kAlign: return Alignment(at.a[k], at.b, k).error(row.other);
    case RowKind::kSquare: return off_square(at, k, row.other).error;
    case RowKind::kAngle: return free_turn(at, k, row.other).angle;
    case RowKind::kTwist: return twist_of(turn_of(place), at.a.x, at.b.x).value;
    case RowKind::kCone: return at.swing.in_cone(narrow).value;
    case RowKind::kSwing: return at.swing.about(k).value;
    case RowKind::kGear:
    case RowKind::kRack: return 0;
  }
  return 0;
}

PLUMB_HD inline JointRow axis_row(const RowSpec& row, const JointAxes& axes, const JointPlace& place,
                                  const JointAxesPlace& at) {
  const int k = row.axis;
  switch (row.kind) {
    case RowKind::kPoint: {
      Vec direction = {0, 0, 0};
      direction[k] = 1;
      return point_row(direction, place.arm_a, place.arm_b);
    }
    case RowKind::kAlong: return point_row(at.a[k], place.arm_a + place.gap, place.arm_b);
    case RowKind::kDistance: return point_row(distance_direction(place), place.arm_a, place.arm_b);
    case RowKind::kTurn: return turn_row(at.a[k]);
    case RowKind::kAlign: return turn_row(Alignment(at.a[k], at.b, k).row(row.other));
    case RowKind::kSquare: return turn_row(off_square(at, k, row.other).row);
    case RowKind::kAngle: return turn_row(free_turn(at, k, row.other).direction);
    case RowKind::kTwist: return turn_row(twist_of(turn_of(place), at.a.x, at.b.x).direction);
    case RowKind::kCone: return turn_row(at.swing.in_cone(axes.narrow).direction);
    case RowKind::kSwing: return turn_row(at.swing.about(k).direction);
    case RowKind::kGear: return {{0, 0, 0}, at.a.x, axes.ratio * at.b.x};
    case RowKind::kRack: return rack_row(axes.ratio, place, at);
  }
  return turn_row({0, 0, 0});
}

/// As is_far_off, of a row; of axes that should be square beyond half a right angle.
PLUMB_HD inline bool is_far_off(const RowSpec& row, const JointPlace& place, const JointAxesPlace& at) {
  switch (row.kind) {
    case RowKind::kTurn: return is_turned_far(place);
    case RowKind::kAlign: return at.cosine(row.axis, row.axis) < 0;
    case RowKind::kSquare: return abs(at.cosine(row.axis, row.other)) > Real(0.7);
    default: return false;
  }
}

/// All rows of a joint: C, or the coordinate. at: axes_of it.
PLUMB_HD inline void all_errors(const Joint& joint, const JointAxes& axes, const JointPlace& place,
                                const JointAxesPlace& at, RowNumbers& error) {
  joint_errors(joint, place, error);
  const int first = rows_of(joint.type);
  for (int i = first; i < row_count(joint); ++i) error[i] = axis_error(axes.row[i - first], axes.narrow, place, at);
}
PLUMB_HD inline void all_errors(const Joint& joint, const JointAxes& axes, const JointPlace& place, RowNumbers& error) {
  all_errors(joint, axes, place, axes_of(joint, axes, place), error);
}
PLUMB_HD inline bool is_any_far_off(const Joint& joint, const JointAxes& axes, const JointPlace& place,
                                    const JointAxesPlace& at) {
  bool far = is_far_off(joint, place);
  const int first = rows_of(joint.type);
  for (int i = first; i < row_count(joint); ++i) far = far || is_far_off(axes.row[i - first], place, at);
  return far;
}
PLUMB_HD inline void all_rows(const Joint& joint, const JointAxes& axes, const JointPlace& place,
                              const JointAxesPlace& at, JointRow (&rows)[kJointRows]) {
  joint_rows(joint, place, rows);
  const int first = rows_of(joint.type);
  for (int i = first; i < row_count(joint); ++i) rows[i] = axis_row(axes.row[i - first], axes, place, at);
}

}  // namespace plumb::impulse
