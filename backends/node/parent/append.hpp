// Values of the wall as numbers of a frame.
#pragma once

#include <cstdint>
#include <vector>

#include "plumb/plumb.h"

namespace plumb::wire {

inline void append(std::vector<double>& row, const PlumbVec3& v) { row.insert(row.end(), {v.x, v.y, v.z}); }
inline void append(std::vector<double>& row, const PlumbQuat& q) { row.insert(row.end(), {q.x, q.y, q.z, q.w}); }
inline void append(std::vector<double>& row, const PlumbPose& pose) {
  append(row, pose.position);
  append(row, pose.orientation);
}
inline void append(std::vector<double>& row, const PlumbFilter& filter) {
  row.insert(row.end(), {double(filter.category), double(filter.mask), double(filter.group)});
}
[[nodiscard]] inline PlumbVec3 vec3_at(const double* row) { return {row[0], row[1], row[2]}; }
[[nodiscard]] inline PlumbQuat quat_at(const double* row) { return {row[0], row[1], row[2], row[3]}; }
[[nodiscard]] inline PlumbPose pose_at(const double* row) { return {vec3_at(row), quat_at(row + 3)}; }

/// locks: a bit for each axis along or about which nothing moves.
[[nodiscard]] inline PlumbVec3 without_locked(const PlumbVec3& v, std::uint32_t locks) {
  return {(locks & 1) != 0 ? 0 : v.x, (locks & 2) != 0 ? 0 : v.y, (locks & 4) != 0 ? 0 : v.z};
}

}  // namespace plumb::wire
