// Lies about bodies and joints that change.
#include "honest.hpp"

namespace plumb::lying {
namespace {

/// Every change without these of its members; one that has no other is said to be done.
template <std::uint32_t bits>
void keep_of_bodies() {
  liar.modify.bodies = [](PlumbWorld* world, const PlumbBodyChange* changes, std::size_t stride, std::uint32_t count) {
    std::vector<PlumbBodyChange> some = copied(changes, stride, count);
    for (PlumbBodyChange& change : some) change.what &= ~bits;
    std::erase_if(some, [](const PlumbBodyChange& change) { return change.what == 0; });
    return honest.modify.bodies(world, some.data(), sizeof some[0], static_cast<std::uint32_t>(some.size()));
  };
}
template <std::uint32_t bit>
void keep_of_joints() {
  liar.modify.joints = [](PlumbWorld* world, const PlumbJointChange* changes, std::size_t stride,
                          std::uint32_t count) -> PlumbResult {
    for (const PlumbJointChange& change : copied(changes, stride, count))
      if (change.what != bit) honest.modify.joints(world, &change, sizeof change, 1);
    return PLUMB_OK;
  };
}

void put_all_to_sleep(PlumbWorld* world) {
  std::vector<PlumbBody> all(100);
  std::uint32_t live = 0;
  honest.core.list_bodies(world, all.data(), 100, &live);
  const double asleep = 0;
  for (std::uint32_t i = 0; i < live; ++i)
    honest.core.write(world, PLUMB_FIELD_AWAKE, PLUMB_F64, &all[i], 1, &asleep, sizeof asleep);
}

}  // namespace

void motions_stay() { keep_of_bodies<PLUMB_MODIFY_MOTION>(); }
void shapes_stay() { keep_of_bodies<PLUMB_MODIFY_SHAPE>(); }
void flags_stay() { keep_of_bodies<PLUMB_MODIFY_FLAGS>(); }
void locks_stay() { keep_of_bodies<PLUMB_MODIFY_LOCKS>(); }
void frames_stay() { keep_of_joints<PLUMB_MODIFY_FRAMES>(); }
void limits_stay() { keep_of_joints<PLUMB_MODIFY_LIMITS>(); }
void motors_stay() { keep_of_joints<PLUMB_MODIFY_MOTORS>(); }
void strength_stays() { keep_of_joints<PLUMB_MODIFY_STRENGTH>(); }
void joined_bodies_go_on_to_touch() { keep_of_joints<PLUMB_MODIFY_COLLIDE_CONNECTED>(); }
void joints_hold_always() { keep_of_joints<PLUMB_MODIFY_ENABLED>(); }
void ends_by_change_are_not_told() { hide_events<PLUMB_EVENT_CONTACT_END>(); }

void first_masses_doubled() {
  liar.modify.bodies = [](PlumbWorld* world, const PlumbBodyChange* changes, std::size_t stride, std::uint32_t count) {
    std::vector<PlumbBodyChange> heavy = copied(changes, stride, count);
    for (PlumbBodyChange& change : heavy) change.mass *= 2;
    return honest.modify.bodies(world, heavy.data(), sizeof heavy[0], count);
  };
}

void velocity_stays_with_the_old_centre() {
  liar.modify.bodies = [](PlumbWorld* world, const PlumbBodyChange* changes, std::size_t stride, std::uint32_t count) {
    double row[6];
    const PlumbBody body = changes->body;
    honest.core.read(world, PLUMB_FIELD_VELOCITY, PLUMB_F64, &body, 1, row, sizeof row);
    const PlumbResult result = honest.modify.bodies(world, changes, stride, count);
    honest.core.write(world, PLUMB_FIELD_VELOCITY, PLUMB_F64, &body, 1, row, sizeof row);
    return result;
  };
}

void changed_bodies_sleep_on() {
  liar.modify.bodies = [](PlumbWorld* world, const PlumbBodyChange* changes, std::size_t stride, std::uint32_t count) {
    const PlumbResult result = honest.modify.bodies(world, changes, stride, count);
    put_all_to_sleep(world);
    return result;
  };
}

void first_of_a_bad_call_is_done() {
  liar.modify.bodies = [](PlumbWorld* world, const PlumbBodyChange* changes, std::size_t stride, std::uint32_t count) {
    const PlumbResult result = honest.modify.bodies(world, changes, stride, count);
    if (result < 0) honest.modify.bodies(world, changes, stride, 1);
    return result;
  };
}

void any_snapshot_is_restored() {
  liar.snapshot.restore = [](PlumbWorld* world, const void* data, std::size_t size) {
    const PlumbResult result = honest.snapshot.restore(world, data, size);
    return result == PLUMB_E_CORRUPT ? PLUMB_OK : result;
  };
}

void grounds_stay() {
  liar.modify.shapes = [](PlumbWorld*, const PlumbShape*, const PlumbShapeDesc*, std::size_t,
                          std::uint32_t) -> PlumbResult { return PLUMB_OK; };
}
void vertices_stay() {
  liar.modify.shapes = [](PlumbWorld* world, const PlumbShape* shapes, const PlumbShapeDesc* descs, std::size_t stride,
                          std::uint32_t count) -> PlumbResult {
    return descs->type == PLUMB_TRIANGLE_MESH ? PLUMB_OK : honest.modify.shapes(world, shapes, descs, stride, count);
  };
}
void meshes_keep_their_triangles() {
  liar.modify.shapes = [](PlumbWorld* world, const PlumbShape* shapes, const PlumbShapeDesc* descs, std::size_t stride,
                          std::uint32_t count) -> PlumbResult {
    return descs->triangle_count == 2 ? PLUMB_OK : honest.modify.shapes(world, shapes, descs, stride, count);
  };
}
void sleepers_hang_over_pits() {
  liar.modify.shapes = [](PlumbWorld* world, const PlumbShape* shapes, const PlumbShapeDesc* descs, std::size_t stride,
                          std::uint32_t count) {
    const PlumbResult result = honest.modify.shapes(world, shapes, descs, stride, count);
    put_all_to_sleep(world);
    return result;
  };
}
void first_of_bad_grounds_is_another() {
  liar.modify.shapes = [](PlumbWorld* world, const PlumbShape* shapes, const PlumbShapeDesc* descs, std::size_t stride,
                          std::uint32_t count) {
    const PlumbResult result = honest.modify.shapes(world, shapes, descs, stride, count);
    if (result < 0 && count == 2) honest.modify.shapes(world, shapes, descs, stride, 1);
    return result;
  };
}
void snapshots_know_no_ground() { any_snapshot_is_restored(); }

void springs_are_those_of_one_hertz() {
  liar.modify.joints = [](PlumbWorld* world, const PlumbJointChange* changes, std::size_t stride, std::uint32_t count) {
    std::vector<PlumbJointChange> soft = copied(changes, stride, count);
    for (PlumbJointChange& change : soft)
      for (PlumbSpring& spring : change.springs)
        if (spring.enabled != 0) spring.frequency = 1;
    return honest.modify.joints(world, soft.data(), sizeof soft[0], count);
  };
}

void joints_are_lost_where_nothing_moves() {
  liar.modify.bodies = [](PlumbWorld* world, const PlumbBodyChange* changes, std::size_t stride, std::uint32_t count) {
    const PlumbResult result = honest.modify.bodies(world, changes, stride, count);
    PlumbJointChange lost = joint_change(std::uint64_t{1} << 32);  // the first there was
    lost.what = PLUMB_MODIFY_ENABLED;
    honest.modify.joints(world, &lost, sizeof lost, 1);
    return result;
  };
}

}  // namespace plumb::lying
