// Hosts that were compiled when descriptors were shorter: the guard takes them, and what they lack is 0.
#include <gtest/gtest.h>

#include <cstring>

#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

constexpr PlumbNeeds kAllButCcd = PLUMB_NEED_ALL & ~PLUMB_NEED_CCD;

Backend backend_of_today() { return Backend(negotiate(&backend::open<FakeWorld>, "fake")); }

/// A caller that was compiled when the descriptor ended before materials by triangle.
TEST(OlderCallers, GiveTheirShapes) {
  constexpr std::size_t kOlder = offsetof(PlumbShapeDesc, materials);
  PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
  desc.struct_size = kOlder;
  std::vector<std::byte> rows(3 * kOlder);
  for (std::size_t i = 0; i < 3; ++i) {
    desc.radius = static_cast<double>(i + 1);
    std::memcpy(rows.data() + i * kOlder, &desc, kOlder);
  }
  const Backend backend = backend_of_today();
  const PlumbBackendTable& table = backend.table();
  const PlumbWorldDesc world_of = world_desc(kAllButCcd);
  PlumbWorld* older = nullptr;
  ASSERT_EQ(table.create_world(&world_of, &older), PLUMB_OK);
  PlumbShape ids[3];
  const auto* descs = reinterpret_cast<const PlumbShapeDesc*>(rows.data());
  EXPECT_EQ(table.create_shapes(older, descs, kOlder, 3, ids), PLUMB_OK) << table.error_text(older);
  ASSERT_EQ(FakeWorld::last->shapes.size(), 3U);
  EXPECT_EQ(FakeWorld::last->shapes[2].radius, 3);
  EXPECT_EQ(FakeWorld::last->shapes[2].struct_size, sizeof(PlumbShapeDesc));
  EXPECT_EQ(FakeWorld::last->shapes[2].triangle_materials, nullptr);
  EXPECT_EQ(table.create_shapes(older, descs, kOlder - 8, 1, ids), PLUMB_E_INVALID_ARGUMENT) << "of none";
  table.destroy_world(older);
}

/// Likewise before rolling friction.
TEST(OlderCallers, GiveTheirBodies) {
  constexpr std::size_t kOlder = offsetof(PlumbBodyDesc, rolling_friction);
  PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
  desc.struct_size = kOlder;
  std::vector<std::byte> rows(2 * kOlder);
  for (std::size_t i = 0; i < 2; ++i) {
    desc.user_data = i + 1;
    std::memcpy(rows.data() + i * kOlder, &desc, kOlder);
  }
  const Backend backend = backend_of_today();
  const PlumbBackendTable& table = backend.table();
  const PlumbWorldDesc world_of = world_desc(kAllButCcd);
  PlumbWorld* older = nullptr;
  ASSERT_EQ(table.create_world(&world_of, &older), PLUMB_OK);
  PlumbBody ids[2];
  const auto* descs = reinterpret_cast<const PlumbBodyDesc*>(rows.data());
  EXPECT_EQ(table.create_bodies(older, descs, kOlder, 2, ids), PLUMB_OK) << table.error_text(older);
  ASSERT_EQ(FakeWorld::last->made.size(), 2U);
  EXPECT_EQ(FakeWorld::last->made[1].user_data, 2U);
  EXPECT_EQ(FakeWorld::last->made[1].struct_size, sizeof(PlumbBodyDesc));
  EXPECT_EQ(FakeWorld::last->made[1].rolling_friction, 0);
  EXPECT_EQ(table.create_bodies(older, descs, kOlder - 8, 1, ids), PLUMB_E_INVALID_ARGUMENT) << "of none";
  table.destroy_world(older);
}

/// A host of before gears has a descriptor that ends before their ratio.
TEST(OlderCallers, GiveTheirJoints) {
  constexpr std::size_t kOlder = offsetof(PlumbJointDesc, ratio);
  const Backend backend = backend_of_today();
  const PlumbBackendTable& table = backend.table();
  const PlumbWorldDesc world_of = world_desc(kAllButCcd);
  PlumbWorld* older = nullptr;
  ASSERT_EQ(table.create_world(&world_of, &older), PLUMB_OK);
  PlumbBodyDesc described = body_desc();
  described.mass_mode = PLUMB_MASS_EXPLICIT;
  described.mass = 1;
  described.inertia = {1, 1, 1};
  PlumbBody bodies[2];
  for (PlumbBody& id : bodies) ASSERT_EQ(table.create_bodies(older, &described, sizeof described, 1, &id), PLUMB_OK);
  const auto& joints = *static_cast<const PlumbJointsTable*>(table.extension(PLUMB_EXT_JOINTS));
  const auto create = [&](PlumbJointType type, std::size_t size) {
    PlumbJointDesc desc = joint_desc(type);
    desc.body_a = bodies[0];
    desc.body_b = bodies[1];
    desc.ratio = 2;  // beyond what an older caller has
    desc.struct_size = static_cast<std::uint32_t>(size);
    PlumbJoint id = 0;
    return joints.create(older, &desc, size, 1, &id);
  };
  EXPECT_EQ(create(PLUMB_JOINT_HINGE, kOlder), PLUMB_OK) << table.error_text(older);
  EXPECT_EQ(create(PLUMB_JOINT_GEAR, kOlder), PLUMB_E_INVALID_ARGUMENT) << "its ratio was not given";
  EXPECT_EQ(create(PLUMB_JOINT_GEAR, sizeof(PlumbJointDesc)), PLUMB_OK) << table.error_text(older);
  EXPECT_EQ(create(PLUMB_JOINT_HINGE, kOlder - 8), PLUMB_E_INVALID_ARGUMENT) << "of none";
  table.destroy_world(older);
}

}  // namespace
}  // namespace plumb::test
