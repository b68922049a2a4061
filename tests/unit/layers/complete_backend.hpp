// A well-behaved backend that has every call of the wall: the fake world, and what it lacks.
#pragma once

#include <algorithm>

#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {

inline const PlumbBackendTable& fake_core() {
  static const PlumbBackendTable* table = negotiate(&backend::open<FakeWorld>, "fake");
  return *table;
}
template <class Table>
const Table& fake_table(const char* name) {
  return *static_cast<const Table*>(fake_core().extension(name));
}

// What the fake world lacks. The answers hold what was asked, so that a wrong input is a different output.
inline PlumbResult fake_collide(PlumbWorld*, const PlumbPosedPair* pairs, std::size_t stride, std::uint32_t count,
                                PlumbPairResult* results, PlumbPairPoint* points, std::uint32_t capacity,
                                std::uint32_t* point_count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto& pair = *reinterpret_cast<const PlumbPosedPair*>(reinterpret_cast<const std::byte*>(pairs) + i * stride);
    results[i] = {0, i, 1};
    if (i < capacity) points[i] = {pair.pose_a.position, pair.pose_b.position, 0, pair.shape_a * 1000 + pair.shape_b};
  }
  *point_count = count;
  return count > capacity ? PLUMB_TRUNCATED : PLUMB_OK;
}
template <class Row>
PlumbResult fake_row(PlumbWorld* world, Row* out, std::uint32_t capacity, std::uint32_t* count) {
  PlumbBody body = 0;
  std::uint32_t bodies = 0;
  fake_core().list_bodies(world, &body, 1, &bodies);
  *count = 1;
  if (capacity == 0) return PLUMB_TRUNCATED;
  out[0] = Row{};
  if constexpr (requires { out->body; }) out->body = body;
  if constexpr (requires { out->body_a; }) out->body_a = out->body_b = body;
  return PLUMB_OK;
}
template <class Cast>
PlumbResult fake_cast(PlumbWorld*, PlumbHitMode, const Cast* casts, std::size_t, std::uint32_t count, PlumbHit* hits,
                      std::uint32_t, std::uint32_t* found) {
  for (std::uint32_t i = 0; i < count; ++i) hits[i] = {0, i, 0, 0, casts[i].translation, casts[i].pose.position};
  *found = count;
  return PLUMB_OK;
}

inline PlumbResult fake_closest(PlumbWorld*, PlumbHitMode, const PlumbProbe* probes, std::size_t, std::uint32_t count,
                                PlumbClosest* out, std::uint32_t, std::uint32_t* found) {
  for (std::uint32_t i = 0; i < count; ++i)
    out[i] = {0, i, 0, probes[i].most_distance, probes[i].pose.position, {}, {1, 0, 0}};
  *found = count;
  return PLUMB_OK;
}

/// The fake world with every extension.
inline const PlumbBackendTable& complete() {
  static const PlumbCollideTable collide_table = {sizeof(PlumbCollideTable), 0, &fake_collide};
  static const PlumbClosestTable closest_table = {sizeof(PlumbClosestTable), 0, &fake_closest};
  static const PlumbDebugTable debug_table = {sizeof(PlumbDebugTable),        0,
                                              &fake_row<PlumbDebugPair>,      &fake_row<PlumbDebugBox>,
                                              &fake_row<PlumbDebugAxis>,      &fake_row<PlumbDebugBody>,
                                              &fake_row<PlumbDebugConstraint>};
  static const PlumbQueriesTable queries_table = [] {
    PlumbQueriesTable queries = fake_table<PlumbQueriesTable>(PLUMB_EXT_QUERIES);
    queries.casts = &fake_cast<PlumbCast>;
    queries.turning_casts = &fake_cast<PlumbTurningCast>;
    return queries;
  }();
  static const PlumbJointsTable joints_table = [] {
    PlumbJointsTable joints = fake_table<PlumbJointsTable>(PLUMB_EXT_JOINTS);
    joints.read = [](PlumbWorld*, PlumbJointField field, PlumbDataType, const PlumbJoint*, std::uint32_t, void* rows,
                     std::size_t) -> PlumbResult {
      std::fill_n(static_cast<double*>(rows), joint_columns_of(field), 3.5);
      return PLUMB_OK;
    };
    return joints;
  }();
  static const PlumbBackendTable table = [] {
    PlumbBackendTable core = fake_core();
    core.extension = [](const char* name) -> const void* {
      const std::string_view wanted = name;
      if (wanted == PLUMB_EXT_COLLIDE) return &collide_table;
      if (wanted == PLUMB_EXT_CLOSEST) return &closest_table;
      if (wanted == PLUMB_EXT_DEBUG) return &debug_table;
      if (wanted == PLUMB_EXT_QUERIES) return &queries_table;
      if (wanted == PLUMB_EXT_JOINTS) return &joints_table;
      return fake_core().extension(name);
    };
    return core;
  }();
  return table;
}

}  // namespace plumb::test
