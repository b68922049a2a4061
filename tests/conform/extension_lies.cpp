// Lies about joints, queries, settings, snapshots and threads.
#include <functional>
#include <thread>

#include "changes.hpp"

namespace plumb::lying {
namespace {

const std::thread::id first_thread = std::this_thread::get_id();

template <auto change>
void change_hashes() {
  liar.snapshot.hash = [](PlumbWorld* world, std::uint64_t* hash) {
    const PlumbResult result = honest.snapshot.hash(world, hash);
    if (result >= 0) change(*hash);
    return result;
  };
}

thread_local std::uint32_t worlds_made = 0, threads_asked = 0;

void count_worlds() {
  liar.core.create_world = [](const PlumbWorldDesc* desc, PlumbWorld** world) {
    ++worlds_made;
    threads_asked = desc->threads;
    return honest.core.create_world(desc, world);
  };
}

}  // namespace

void fixed_joints_turn() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type == PLUMB_JOINT_FIXED) desc.type = PLUMB_JOINT_BALL;
  }>();
}
void ball_joints_are_stiff() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type == PLUMB_JOINT_BALL) desc.type = PLUMB_JOINT_FIXED;
  }>();
}
void generic_axes_locked() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbAxisMode& mode : desc.axis_modes) mode = PLUMB_AXIS_LOCKED;
  }>();
}
void limits_ignored() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbLimit& limit : desc.limits) limit.enabled = 0;
  }>();
}
void motors_too_fast() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbMotor& motor : desc.motors) motor.target_velocity *= 2;
  }>();
}
void motors_too_strong() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbMotor& motor : desc.motors) motor.max_force *= 100;
  }>();
}
void springs_ignored() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbSpring& spring : desc.springs) spring.enabled = 0;
  }>();
}
void joints_never_break() {
  change_joints<[](PlumbJointDesc& desc) { desc.break_force = 0; }>();
}
void joined_bodies_never_touch() {
  change_joints<[](PlumbJointDesc& desc) { desc.collide_connected = 0; }>();
}
void no_reactions() {
  change_joint_reads<[](double* row) { std::fill_n(row, 6, 0.0); }>();
}
void no_torques() {
  change_joint_reads<[](double* row) { std::fill_n(row + 3, 3, 0.0); }>();
}
void limits_moved() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbLimit& limit : desc.limits) limit.upper += limit.enabled != 0 ? 0.1 : 0;
  }>();
}
void springs_too_stiff() {
  change_joints<[](PlumbJointDesc& desc) {
    for (PlumbSpring& spring : desc.springs) spring.frequency *= 1.1;
  }>();
}
void springs_by_stiffness_fall_short_beside_limits() {
  change_joints<[](PlumbJointDesc& desc) {
    for (std::size_t axis = 0; axis < 6; ++axis)
      if (desc.limits[axis].enabled != 0) desc.springs[axis].frequency *= 0.9;
  }>();
}
void swings_are_told_too_small() {
  change_joint_reads<[](double* row) {
    row[4] *= 0.999;
    row[5] *= 0.999;
  },
                     PLUMB_JOINT_COORDINATES>();
}
void twists_stop_early() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type != PLUMB_JOINT_SWING_TWIST) return;
    desc.limits[3].lower /= 2;
    desc.limits[3].upper /= 2;
  }>();
}
void cones_are_open() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type == PLUMB_JOINT_SWING_TWIST) desc.limits[4].enabled = desc.limits[5].enabled = 0;
  }>();
}
void cones_are_round() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type == PLUMB_JOINT_SWING_TWIST) desc.limits[5] = desc.limits[4];
  }>();
}
void gears_have_other_teeth() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type == PLUMB_JOINT_GEAR) desc.ratio *= 1.01;
  }>();
}
void racks_have_other_teeth() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type == PLUMB_JOINT_RACK_AND_PINION) desc.ratio *= 1.01;
  }>();
}
void targets_are_not_written() {
  liar.joints.write = [](PlumbWorld* world, PlumbJointField field, PlumbDataType type, const PlumbJoint* ids,
                         std::uint32_t count, const void* rows, std::size_t stride) -> PlumbResult {
    return field == PLUMB_JOINT_SPRING_REST ? PLUMB_OK
                                            : honest.joints.write(world, field, type, ids, count, rows, stride);
  };
}
void a_swing_is_not_driven() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type == PLUMB_JOINT_SWING_TWIST) desc.springs[5].rest = 0;
  }>();
}
void swings_give_way_too_much() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type == PLUMB_JOINT_SWING_TWIST) desc.springs[4].frequency *= 0.9;
  }>();
}
void swings_turn_too_fast() {
  change_joints<[](PlumbJointDesc& desc) {
    if (desc.type == PLUMB_JOINT_SWING_TWIST) desc.motors[5].target_velocity *= 1.1;
  }>();
}
void joints_stay() {
  liar.joints.destroy = [](PlumbWorld*, const PlumbJoint*, std::uint32_t) -> PlumbResult { return PLUMB_OK; };
}

void rays_too_long() {
  change_ray_hits<[](PlumbHit& hit) { hit.fraction = std::min(1.0, hit.fraction + 0.01); }>();
}
void ray_normals_turned_round() {
  change_ray_hits<[](PlumbHit& hit) { hit.normal = {-hit.normal.x, -hit.normal.y, -hit.normal.z}; }>();
}
void other_triangles_are_told() {
  change_ray_hits<[](PlumbHit& hit) { hit.child += 1000; }>();
}
void other_threads_see_nothing() {
  change_ray_hits<[](PlumbHit& hit) {
    if (std::this_thread::get_id() != first_thread) hit.body = 0;
  }>();
}
void rays_see_all() {
  liar.queries.rays = [](PlumbWorld* world, PlumbHitMode mode, const PlumbRay* rays, std::size_t stride,
                         std::uint32_t count, PlumbHit* hits, std::uint32_t capacity, std::uint32_t* hit_count) {
    std::vector<PlumbRay> changed = copied(rays, stride, count);
    for (PlumbRay& ray : changed) ray.filter = {~0u, ~0u, 0, 0};
    return honest.queries.rays(world, mode, changed.data(), sizeof(PlumbRay), count, hits, capacity, hit_count);
  };
}
void casts_end_early() {
  liar.queries.casts = [](PlumbWorld* world, PlumbHitMode mode, const PlumbCast* casts, std::size_t stride,
                          std::uint32_t count, PlumbHit* hits, std::uint32_t capacity, std::uint32_t* hit_count) {
    const PlumbResult result = honest.queries.casts(world, mode, casts, stride, count, hits, capacity, hit_count);
    for (std::uint32_t i = 0; result >= 0 && i < std::min(capacity, *hit_count); ++i) hits[i].fraction /= 2;
    return result;
  };
}
void casts_end_late() {
  liar.queries.casts = [](PlumbWorld* world, PlumbHitMode mode, const PlumbCast* casts, std::size_t stride,
                          std::uint32_t count, PlumbHit* hits, std::uint32_t capacity, std::uint32_t* hit_count) {
    const PlumbResult result = honest.queries.casts(world, mode, casts, stride, count, hits, capacity, hit_count);
    for (std::uint32_t i = 0; result >= 0 && i < std::min(capacity, *hit_count); ++i)
      if (hits[i].fraction > 0) hits[i].fraction = std::min(1.0, hits[i].fraction + 0.2);
    return result;
  };
}
void overlaps_beside() {
  liar.queries.overlaps = [](PlumbWorld* world, const PlumbOverlap* overlaps, std::size_t stride, std::uint32_t count,
                             PlumbHit* hits, std::uint32_t capacity, std::uint32_t* hit_count) {
    std::vector<PlumbOverlap> changed = copied(overlaps, stride, count);
    for (PlumbOverlap& overlap : changed) overlap.pose.position.x += 0.5;
    return honest.queries.overlaps(world, changed.data(), sizeof(PlumbOverlap), count, hits, capacity, hit_count);
  };
}
void pairs_posed_beside() {
  liar.collide.pairs = [](PlumbWorld* world, const PlumbPosedPair* pairs, std::size_t stride, std::uint32_t count,
                          PlumbPairResult* results, PlumbPairPoint* points, std::uint32_t capacity,
                          std::uint32_t* point_count) {
    std::vector<PlumbPosedPair> changed = copied(pairs, stride, count);
    for (PlumbPosedPair& pair : changed) pair.pose_b.position.x += 0.5;
    return honest.collide.pairs(world, changed.data(), sizeof(PlumbPosedPair), count, results, points, capacity,
                                point_count);
  };
}
void no_overlaps() {
  liar.queries.overlaps = [](PlumbWorld*, const PlumbOverlap*, std::size_t, std::uint32_t, PlumbHit*, std::uint32_t,
                             std::uint32_t* hit_count) -> PlumbResult { return *hit_count = 0, PLUMB_OK; };
}
void no_pair_points() {
  liar.collide.pairs = [](PlumbWorld*, const PlumbPosedPair*, std::size_t, std::uint32_t count,
                          PlumbPairResult* results, PlumbPairPoint*, std::uint32_t,
                          std::uint32_t* point_count) -> PlumbResult {
    std::fill_n(results, count, PlumbPairResult{1, 0, 0});
    return *point_count = 0, PLUMB_OK;
  };
}
void no_candidate_pairs() {
  liar.debug.pairs = [](PlumbWorld* world, PlumbDebugPair* out, std::uint32_t capacity, std::uint32_t* count) {
    const PlumbResult result = honest.debug.pairs(world, out, capacity, count);
    if (result < 0) return result;
    return *count = 0, PlumbResult{PLUMB_OK};
  };
}

void setting_without_doc() {
  liar.settings.describe = [](std::uint32_t index) -> const PlumbSettingInfo* {
    static PlumbSettingInfo changed;
    if (index != 0) return honest.settings.describe(index);
    changed = *honest.settings.describe(0);
    changed.doc = "";
    return &changed;
  };
}
void settings_not_taken() {
  liar.settings.set = [](PlumbWorld*, const char*, const PlumbSettingValue*) -> PlumbResult { return PLUMB_OK; };
}
void nothing_restored() {
  liar.snapshot.restore = [](PlumbWorld*, const void*, std::size_t) -> PlumbResult { return PLUMB_OK; };
}

void who_is_gone_stays_gone() {
  liar.snapshot.save_world = honest.snapshot.save;
  liar.snapshot.restore = [](PlumbWorld* world, const void* data, std::size_t size) -> PlumbResult {
    (void)honest.snapshot.restore(world, data, size);
    return PLUMB_OK;
  };
}

void any_world_is_restored() {
  liar.snapshot.restore = [](PlumbWorld* world, const void* data, std::size_t size) {
    const PlumbResult result = honest.snapshot.restore(world, data, size);
    return result == PLUMB_E_CORRUPT ? PLUMB_OK : result;
  };
}

void hash_is_constant() {
  change_hashes<[](std::uint64_t& hash) { hash = 7; }>();
}
void hash_of_the_day() {
  count_worlds();
  change_hashes<[](std::uint64_t& hash) { hash += worlds_made; }>();
}
void hash_of_the_thread() {
  change_hashes<[](std::uint64_t& hash) { hash += std::this_thread::get_id() == first_thread ? 0 : 1; }>();
}
void hash_of_worlds_made_meanwhile() {
  count_worlds();
  change_hashes<[](std::uint64_t& hash) { hash += std::this_thread::get_id() == first_thread ? 0 : worlds_made; }>();
}
void hash_of_the_thread_count() {
  count_worlds();
  liar.info.determinism = PLUMB_DETERMINISM_THREADS;
  change_hashes<[](std::uint64_t& hash) { hash += threads_asked; }>();
}

}  // namespace plumb::lying
