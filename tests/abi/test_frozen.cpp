// A backend that was built against the frozen headers runs under today's host, and as today's own does.
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

TEST(Frozen, RunsUnderTodaysHostWithoutAFinding) {
  const PlumbBackendTable* old = layers::validate(&open_backend(FROZEN_BACKEND).table());
  EXPECT_EQ(fly(old), fly(&open_backend(SAMPLE_BACKEND).table()));
  EXPECT_TRUE(layers::findings(old).empty());
}

TEST(Frozen, IsRefusedInWordsToo) {
  const Backend old = open_backend(FROZEN_BACKEND);
  PlumbWorldDesc desc = world_desc(PLUMB_NEED_JOINTS);
  try {
    static_cast<void>(old.create_world(desc));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), PLUMB_E_UNSUPPORTED);
  }
}

}  // namespace
}  // namespace plumb::test
