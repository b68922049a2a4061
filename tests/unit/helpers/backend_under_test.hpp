// A world of the backend that the program was started with, and what tests put into it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <vector>

#include "plumb/loader.hpp"

namespace plumb::helpers::test {

/// Named on the command line; see main.cpp.
const Backend& backend_under_test();

/// Whether the backend has every need; skips by capability and never by name.
[[nodiscard]] inline bool offers(PlumbNeeds needs) { return backend_under_test().offered(needs) == needs; }

struct TestWorld {
  static constexpr PlumbNeeds usual = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                      PLUMB_NEED_FORCES | PLUMB_NEED_KINEMATIC | PLUMB_NEED_QUERIES |
                                      PLUMB_NEED_JOINTS | PLUMB_NEED_CONTACTS | PLUMB_NEED_FILTERS;
  explicit TestWorld(PlumbVec3 gravity = {0, -9.81, 0}, PlumbNeeds needs = usual) {
    PlumbWorldDesc desc = world_desc(needs);
    desc.gravity = gravity;
    world = backend_under_test().create_world(desc);
  }

  PlumbShape shape(const PlumbShapeDesc& desc) {
    PlumbShape id = 0;
    check(*world, world->create_shapes({&desc, 1}, {&id, 1}));
    return id;
  }
  PlumbBody add(const PlumbBodyDesc& desc) {
    PlumbBody id = 0;
    check(*world, world->create_bodies({&desc, 1}, {&id, 1}));
    return id;
  }
  PlumbBody box(PlumbMotion motion, PlumbVec3 half, PlumbVec3 at, double mass = 1, PlumbQuat turn = {0, 0, 0, 1}) {
    PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
    desc.half_extents = half;
    return body(motion, shape(desc), at, mass, turn);
  }
  PlumbBody sphere(double radius, PlumbVec3 at, double mass) {
    PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
    desc.radius = radius;
    return body(PLUMB_DYNAMIC, shape(desc), at, mass, {0, 0, 0, 1});
  }
  PlumbBody body(PlumbMotion motion, PlumbShape of, PlumbVec3 at, double mass, PlumbQuat turn) {
    PlumbBodyDesc desc = body_desc(motion);
    desc.shape = of;
    desc.pose = {at, turn};
    desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
    desc.mass = mass;
    desc.flags = motion == PLUMB_DYNAMIC ? static_cast<std::uint32_t>(PLUMB_BODY_NEVER_SLEEPS) : 0u;
    return add(desc);
  }
  void step(double dt) {
    PlumbStepReport report{};
    report.struct_size = sizeof(report);
    check(*world, world->step(dt));
    check(*world, world->wait(report));
  }
  PlumbPose pose(PlumbBody id) {
    PlumbPose row{};
    check(*world, world->read(PLUMB_FIELD_POSE, {&id, 1}, rows_over(std::span(&row, 1))));
    return row;
  }
  struct Velocity {
    PlumbVec3 linear, angular;
  };
  Velocity velocity(PlumbBody id) {
    Velocity row{};
    check(*world, world->read(PLUMB_FIELD_VELOCITY, {&id, 1}, rows_over(std::span(&row, 1))));
    return row;
  }
  void set_velocity(PlumbBody id, const Velocity& row) {
    check(*world, world->write(PLUMB_FIELD_VELOCITY, {&id, 1}, const_rows_over(std::span<const Velocity>(&row, 1))));
  }

  std::unique_ptr<IPhysicsWorld> world;
};

}  // namespace plumb::helpers::test
