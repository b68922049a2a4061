// The engine whose kernels have a memory of their own (exec/cpu/memory_apart.cpp), as a GPU has: everything that they
// read must have travelled, and no more than that.
#include <gtest/gtest.h>

#include <cmath>

#include "plugin/world.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kApartNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                   PLUMB_NEED_RESTITUTION | PLUMB_NEED_KINEMATIC | PLUMB_NEED_FORCES |
                                   PLUMB_NEED_DAMPING;

class SameBits : public ::testing::TestWithParam<const char*> {};
TEST_P(SameBits, AsWhereTheMemoryIsOne) {
  const Backend one = open_backend(IMPULSE_LIBRARY), apart = engine();
  for (const NamedScene& scene : named_scenes()) {
    if (std::string_view(scene.name) != GetParam()) continue;
    const auto a = build(one, scene, 1), b = build(apart, scene, 1);
    for (int second = 0; second < 5; ++second) {
      a->run(60);
      b->run(60);
      ASSERT_EQ(b->hash(), a->hash()) << "after " << 60 * (second + 1) << " steps";
    }
    return;
  }
  FAIL() << "there is no scene " << GetParam();
}
INSTANTIATE_TEST_SUITE_P(Memory, SameBits,
                         ::testing::Values("meddling", "sheets", "belts", "paddle", "chain", "bounces", "rotors"),
                         [](const auto& scene) { return std::string(scene.param); });

/// 2000 bodies, and what the next step uploads.
class Travel : public ::testing::Test {
 protected:
  Travel() : world_(world_init()) {
    PlumbShapeDesc cube = shape_desc(PLUMB_BOX);
    cube.half_extents = {0.4, 0.4, 0.4};
    PlumbShape shape = 1;
    (void)world_.create_shapes({&cube, 1}, {&shape, 1});
    std::vector<PlumbBodyDesc> descs;
    std::vector<PlumbBody> ids;
    for (std::uint64_t i = 0; i < kBodies; ++i) {
      PlumbBodyDesc desc = body_desc(i == 0 ? PLUMB_KINEMATIC : PLUMB_DYNAMIC);
      desc.shape = shape;
      desc.mass_mode = PLUMB_MASS_EXPLICIT;
      desc.mass = 1;
      desc.inertia = {1, 1, 1};
      desc.pose.position = {static_cast<double>(i), 0, 0};
      descs.push_back(desc);
      ids.push_back(i);
    }
    (void)world_.create_bodies(descs, ids);
    EXPECT_GT(uploaded(), kBodies * 100) << "all that there is";
  }

  static WorldInit world_init() {
    static const std::vector<PlumbSettingInfo> infos(World::setting_infos().begin(), World::setting_infos().end());
    WorldInit init{world_desc(kApartNeeds), nullptr, infos, {}};
    for (const PlumbSettingInfo& info : infos) init.values.push_back(info.default_value);
    return init;
  }
  std::uint64_t uploaded() {
    const std::uint64_t before = world_.uploaded_bytes();
    PlumbStepReport report{};
    (void)world_.step(1.0 / 60);
    (void)world_.wait(report);
    return world_.uploaded_bytes() - before;
  }
  void write(PlumbField field, PlumbBody body, const std::vector<double>& row) {
    const ConstRows rows(reinterpret_cast<const std::byte*>(row.data()), 1, row.size() * sizeof(double), PLUMB_F64);
    (void)world_.write(field, {&body, 1}, rows);
  }

  static constexpr std::uint64_t kBodies = 2000;
  static constexpr std::uint64_t kIdle = sizeof(StepParameters) + sizeof(SubstepLevels);
  World world_;
};

TEST_F(Travel, OfAStepThatNobodyMeddledWithIsItsParameters) { EXPECT_EQ(uploaded(), kIdle); }

TEST_F(Travel, OfAKinematicBodyIsItsRows) {
  for (int i = 1; i < 10; ++i) {
    write(PLUMB_FIELD_KINEMATIC_TARGET, 0, {0, 0.1 * i, 0, 0, 0, 0, 1});
    EXPECT_LE(uploaded(), kIdle + 2 * sizeof(StateEntry)) << "step " << i;
  }
}

TEST_F(Travel, OfAWriteIsTheRowsThatItTouches) {
  write(PLUMB_FIELD_POSE, 1000, {0, 50, 0, 0, 0, 0, 1});
  EXPECT_EQ(uploaded(), kIdle + sizeof(StateEntry));
  write(PLUMB_FIELD_VELOCITY, 7, {0, 50, 0, 0, 0, 1});
  write(PLUMB_FIELD_POSE, 7, {0, 60, 0, 0, 0, 0, 1});
  EXPECT_EQ(uploaded(), kIdle + sizeof(StateEntry));
  write(PLUMB_FIELD_IMPULSE, 1999, {0, 1, 0});
  EXPECT_LE(uploaded(), kIdle + 2 * sizeof(StateEntry));
  write(PLUMB_FIELD_FORCE, 300, {0, 1, 0});
  EXPECT_EQ(uploaded(), kIdle + sizeof(BodyForce));
  EXPECT_EQ(uploaded(), kIdle + sizeof(BodyForce)) << "the force is taken off again";
  write(PLUMB_FIELD_MATERIAL, 300, {0.1, 0.2});
  EXPECT_EQ(uploaded(), kIdle + sizeof(Proxy) + sizeof(BodyMass) + sizeof(ProxyFilter));
  EXPECT_EQ(uploaded(), kIdle);
}

}  // namespace
}  // namespace plumb::impulse::test
