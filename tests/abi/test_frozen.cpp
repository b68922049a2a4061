// Backends that were built against the frozen headers run under today's host, and as today's own does.
#include <gtest/gtest.h>

#include "plumb/layers.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

std::vector<PlumbBodyDesc> particles() {
  std::vector<PlumbBodyDesc> descs(3, body_desc());
  for (std::size_t i = 0; i < descs.size(); ++i) {
    descs[i].flags = PLUMB_BODY_NO_ROTATION;
    descs[i].mass_mode = PLUMB_MASS_FROM_TOTAL;
    descs[i].mass = 1;
    descs[i].material = {};
    descs[i].linear_velocity = {static_cast<double>(i), 10, 0};
  }
  return descs;
}

/// The particles' state hash after a second.
std::uint64_t fly(const PlumbBackendTable* table) {
  const auto world = Backend(table).create_world(world_desc(0));
  const std::vector<PlumbBodyDesc> descs = particles();
  std::vector<PlumbBody> ids(descs.size());
  check(*world, world->create_bodies(descs, ids));
  PlumbStepReport report{};
  for (int step = 0; step < 100; ++step) {
    check(*world, world->step(0.01));
    check(*world, world->wait(report));
  }
  EXPECT_EQ(report.step, 100u);
  std::vector<PlumbPose> poses(descs.size());
  check(*world, world->read(PLUMB_FIELD_POSE, {}, rows_over<PlumbPose>(poses)));
  EXPECT_NEAR(poses[2].position.x, 2, 1e-12);
  EXPECT_NEAR(poses[2].position.y, 10 - 9.81 * 0.01 * 0.01 * 100 * 101 / 2, 1e-9) << "the sum of semi-implicit Euler";
  std::uint64_t hash = 0;
  check(*world, world->hash(hash));
  return hash;
}

struct FrozenBackend {
  const char* file;
  std::uint32_t version;
};
class Frozen : public ::testing::TestWithParam<FrozenBackend> {};

TEST_P(Frozen, RunsUnderTodaysHostWithoutAFinding) {
  const Backend backend = open_backend(GetParam().file);
  EXPECT_EQ(backend.table().version, GetParam().version);
  const PlumbBackendTable* old = layers::validate(&backend.table());
  EXPECT_EQ(fly(old), fly(&open_backend(SAMPLE_BACKEND).table()));
  EXPECT_TRUE(layers::findings(old).empty());
}

TEST_P(Frozen, IsRefusedInWordsToo) {
  const Backend old = open_backend(GetParam().file);
  PlumbWorldDesc desc = world_desc(PLUMB_NEED_JOINTS);
  try {
    static_cast<void>(old.create_world(desc));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), PLUMB_E_UNSUPPORTED);
  }
}

/// A host of today that lends memory, and asks for what came later.
TEST_P(Frozen, IsNotAskedForWhatItDoesNotKnow) {
  PlumbHost host{};
  host.struct_size = sizeof host;
  host.allocate = [](void*, std::size_t, std::size_t) -> void* { return nullptr; };
  host.release = [](void*, void*) {};
  const Backend old = open_backend(GetParam().file, &host);
  EXPECT_EQ(old.capability(PLUMB_CAP_HOST_MEMORY), PLUMB_NONE);
  EXPECT_EQ(old.capability(PLUMB_CAP_COOKING, PLUMB_TRIANGLE_MESH), PLUMB_NONE);
  const auto world = old.create_world(world_desc(0));
  EXPECT_EQ(world->modify(), nullptr);
  EXPECT_EQ(world->cooking(), nullptr);
  const std::vector<PlumbBodyDesc> descs = particles();
  std::vector<PlumbBody> ids(descs.size());
  EXPECT_EQ(world->create_bodies(descs, ids), PLUMB_OK) << world->error_text();
}

INSTANTIATE_TEST_SUITE_P(Of, Frozen,
                         ::testing::Values(FrozenBackend{FROZEN_1_0, PLUMB_MAKE_VERSION(1, 0)},
                                           FrozenBackend{FROZEN_1_1, PLUMB_MAKE_VERSION(1, 1)}),
                         [](const auto& of) { return of.index == 0 ? "OneZero" : "OneOne"; });

}  // namespace
}  // namespace plumb::test
