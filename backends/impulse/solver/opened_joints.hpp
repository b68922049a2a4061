// How far a joint is from where it holds its bodies, in parts of what it may be open by.
//
// A blow can turn what is light and short by a radian in a sub-step, and rows that are straight in the sub-step do not
// follow it round. In shorter ones they do: the error falls by eight and more for each halving. So a step that opens a
// joint beyond this, and by a quarter of it or more, is taken back, and its island has more sub-steps
// (energy_bound.hpp). Contacts, which a step has of its start, then press where the body no longer is: what opens the
// joint all the same is gone in parts.
#pragma once

#include "joints/joint_axes.hpp"

namespace plumb::impulse {

/// How far a joint may be open: m, rad.
inline constexpr Real kMostOpening = Real(5e-3), kMostTurning = Real(0.02);
/// Parts of that by which a step opens one: what was open before and is hardly more so now, more sub-steps do not
/// close.
inline constexpr Real kOpensBy = Real(0.25);

/// So many times the sub-steps that it had an island asks for then, a little more than the level below.
inline constexpr Real kMoreForOpened = Real(2.01);
/// What has asked for so many times what it has got does not get more.
inline constexpr Real kDenied = Real(1.001);

/// The largest error of any row that is locked, or beyond its limit. axes: null for a joint that has no such rows.
PLUMB_HD inline Real openness(const Joint& joint, const JointAxes* axes, const JointPlace& place) {
  RowNumbers errors;
  if (axes == nullptr)
    joint_errors(joint, place, errors);
  else
    all_errors(joint, *axes, place, errors);
  const int first = rows_of(joint.type);
  Real pulled = 0, turned = 0;
  for (int i = 0; i < row_count(joint); ++i) {
    Real error = errors[i];
    if (i >= first && axes->row[i - first].coordinate != kLocked) error = beyond_limits(*axes, i - first, error);
    Real& sum = (joint.pulls >> i & 1U) != 0 ? pulled : turned;
    sum = sum + error * error;
  }
  return max(sqrt(pulled) / kMostOpening, sqrt(turned) / kMostTurning);
}

}  // namespace plumb::impulse
