// Ways to lie: what goes into the honest backend is changed, or what comes out of it.
#pragma once

#include "honest.hpp"

namespace plumb::lying {

template <auto change>
void change_bodies() {
  liar.core.create_bodies = [](PlumbWorld* world, const PlumbBodyDesc* descs, std::size_t stride, std::uint32_t count,
                               PlumbBody* ids) {
    std::vector<PlumbBodyDesc> changed = copied(descs, stride, count);
    for (PlumbBodyDesc& desc : changed) change(desc);
    return honest.core.create_bodies(world, changed.data(), sizeof(PlumbBodyDesc), count, ids);
  };
}

template <auto change>
void change_shapes() {
  liar.core.create_shapes = [](PlumbWorld* world, const PlumbShapeDesc* descs, std::size_t stride, std::uint32_t count,
                               PlumbShape* ids) {
    std::vector<PlumbShapeDesc> changed = copied(descs, stride, count);
    for (PlumbShapeDesc& desc : changed) change(desc);
    return honest.core.create_shapes(world, changed.data(), sizeof(PlumbShapeDesc), count, ids);
  };
}

/// change(desc) for every world that is made.
template <auto change>
void change_worlds() {
  liar.core.create_world = [](const PlumbWorldDesc* desc, PlumbWorld** world) {
    PlumbWorldDesc changed = *desc;
    change(changed);
    return honest.core.create_world(&changed, world);
  };
}

template <PlumbField field, auto change>
void change_writes() {
  liar.core.write = [](PlumbWorld* world, PlumbField asked, PlumbDataType type, const PlumbBody* ids,
                       std::uint32_t count, const void* rows, std::size_t stride) {
    if (asked != field || type != PLUMB_F64) return honest.core.write(world, asked, type, ids, count, rows, stride);
    std::vector<std::byte> changed(static_cast<const std::byte*>(rows),
                                   static_cast<const std::byte*>(rows) + count * stride);
    change_rows(type, changed.data(), stride, count, change);
    return honest.core.write(world, asked, type, ids, count, changed.data(), stride);
  };
}

template <PlumbField field>
void lose_writes() {
  liar.core.write = [](PlumbWorld* world, PlumbField asked, PlumbDataType type, const PlumbBody* ids,
                       std::uint32_t count, const void* rows, std::size_t stride) -> PlumbResult {
    return asked == field ? PLUMB_OK : honest.core.write(world, asked, type, ids, count, rows, stride);
  };
}

template <PlumbField field, auto change>
void change_reads() {
  liar.core.read = [](PlumbWorld* world, PlumbField asked, PlumbDataType type, const PlumbBody* ids,
                      std::uint32_t count, void* rows, std::size_t stride) {
    const PlumbResult result = honest.core.read(world, asked, type, ids, count, rows, stride);
    if (result >= 0 && asked == field) change_rows(type, rows, stride, count, change);
    return result;
  };
}

template <auto change>
void change_contacts() {
  liar.core.contacts = [](PlumbWorld* world, PlumbContact* out, std::size_t stride, std::uint32_t capacity,
                          std::uint32_t* count) {
    const PlumbResult result = honest.core.contacts(world, out, stride, capacity, count);
    for (std::uint32_t i = 0; result >= 0 && i < std::min(capacity, *count); ++i)
      change(*reinterpret_cast<PlumbContact*>(reinterpret_cast<std::byte*>(out) + i * stride));
    return result;
  };
}

template <auto change>
void change_reports() {
  liar.core.wait = [](PlumbWorld* world, PlumbStepReport* report) {
    const PlumbResult result = honest.core.wait(world, report);
    if (result >= 0 && report != nullptr) change(*report);
    return result;
  };
}

template <PlumbCapability kind, std::uint32_t a, std::uint32_t b, PlumbDegree claim>
void change_capability() {
  liar.core.capability = [](PlumbCapability asked, std::uint32_t x, std::uint32_t y, const char** note) -> PlumbDegree {
    const PlumbDegree truth = honest.core.capability(asked, x, y, note);
    return asked == kind && x == a && y == b ? claim : truth;
  };
}

template <auto change>
void change_joints() {
  liar.joints.create = [](PlumbWorld* world, const PlumbJointDesc* descs, std::size_t stride, std::uint32_t count,
                          PlumbJoint* ids) {
    std::vector<PlumbJointDesc> changed = copied(descs, stride, count);
    for (PlumbJointDesc& desc : changed) change(desc);
    return honest.joints.create(world, changed.data(), sizeof(PlumbJointDesc), count, ids);
  };
}

template <auto change>
void change_ray_hits() {
  liar.queries.rays = [](PlumbWorld* world, PlumbHitMode mode, const PlumbRay* rays, std::size_t stride,
                         std::uint32_t count, PlumbHit* hits, std::uint32_t capacity, std::uint32_t* hit_count) {
    const PlumbResult result = honest.queries.rays(world, mode, rays, stride, count, hits, capacity, hit_count);
    for (std::uint32_t i = 0; result >= 0 && i < std::min(capacity, *hit_count); ++i) change(hits[i]);
    return result;
  };
}

template <auto change>
void change_casts() {
  liar.queries.casts = [](PlumbWorld* world, PlumbHitMode mode, const PlumbCast* casts, std::size_t stride,
                          std::uint32_t count, PlumbHit* hits, std::uint32_t capacity, std::uint32_t* hit_count) {
    std::vector<PlumbCast> changed = copied(casts, stride, count);
    for (PlumbCast& cast : changed) change(cast);
    return honest.queries.casts(world, mode, changed.data(), sizeof(PlumbCast), count, hits, capacity, hit_count);
  };
}

template <auto change, PlumbJointField changed = PLUMB_JOINT_REACTION>
void change_joint_reads() {
  liar.joints.read = [](PlumbWorld* world, PlumbJointField field, PlumbDataType type, const PlumbJoint* ids,
                        std::uint32_t count, void* rows, std::size_t stride) {
    const PlumbResult result = honest.joints.read(world, field, type, ids, count, rows, stride);
    if (result >= 0 && field == changed) change_rows(type, rows, stride, count, change);
    return result;
  };
}

/// For stepless collision: change(result, points of it).
template <auto change>
void change_pairs() {
  liar.collide.pairs = [](PlumbWorld* world, const PlumbPosedPair* pairs, std::size_t stride, std::uint32_t count,
                          PlumbPairResult* results, PlumbPairPoint* points, std::uint32_t capacity,
                          std::uint32_t* point_count) {
    const PlumbResult result =
        honest.collide.pairs(world, pairs, stride, count, results, points, capacity, point_count);
    for (std::uint32_t i = 0; result == PLUMB_OK && i < count; ++i) change(results[i], points + results[i].first_point);
    return result;
  };
}

}  // namespace plumb::lying
