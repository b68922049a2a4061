// The guard of plumb.manifolds/1: what reaches a backend's class, and what does not.
#include <gtest/gtest.h>

#include <limits>

#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

class GuardManifolds : public ::testing::Test {
 protected:
  GuardManifolds() : world(world_of(PLUMB_NEED_ALL & ~PLUMB_NEED_CCD & ~PLUMB_NEED_RESTITUTION)) {
    FakeWorld::last->shown.resize(2);
    for (PlumbManifold& row : FakeWorld::last->shown) row.point_count = 1;
  }
  static std::unique_ptr<IPhysicsWorld> world_of(PlumbNeeds needs) {
    return Backend(negotiate(&backend::open<FakeWorld>, "fake")).create_world(world_desc(needs));
  }
  void step() { ASSERT_EQ(world->step(0.01), PLUMB_OK); }
  std::size_t read() {
    std::span<const PlumbManifold> rows;
    EXPECT_EQ(world->manifolds()->read_manifolds(rows), PLUMB_OK) << world->error_text();
    return rows.size();
  }
  PlumbResult modify(std::vector<PlumbManifoldChange> changes) { return world->manifolds()->modify_manifolds(changes); }
  static PlumbManifoldChange change(std::uint32_t row, std::uint32_t what) {
    PlumbManifoldChange made = manifold_change(row);
    made.what = what;
    return made;
  }
  void refused(PlumbResult code, const std::string& text, const std::vector<PlumbManifoldChange>& changes) {
    const int before = FakeWorld::last->calls;
    EXPECT_EQ(modify(changes), code);
    EXPECT_NE(world->error_text().find(text), std::string::npos) << world->error_text();
    EXPECT_EQ(FakeWorld::last->calls, before) << "the class was called";
  }

  std::unique_ptr<IPhysicsWorld> world;
};

TEST_F(GuardManifolds, ChangesOfWhatWasReadReachTheClass) {
  step();
  EXPECT_EQ(read(), 2u);
  EXPECT_EQ(read(), 2u);
  ASSERT_EQ(modify({change(1, PLUMB_MANIFOLD_DISABLED)}), PLUMB_OK) << world->error_text();
  ASSERT_EQ(FakeWorld::last->manifold_changes.size(), 1u);
  EXPECT_EQ(FakeWorld::last->manifold_changes[0].manifold, 1u);
}

TEST_F(GuardManifolds, EachBatchIsChangedOnce) {
  refused(PLUMB_E_WRONG_PHASE, "outside of a step", {});
  step();
  refused(PLUMB_E_WRONG_PHASE, "before they are read", {});
  read();
  ASSERT_EQ(modify({}), PLUMB_OK);
  refused(PLUMB_E_WRONG_PHASE, "before they are read", {});
  PlumbStepReport report;
  ASSERT_EQ(world->wait(report), PLUMB_OK);
  step();
  refused(PLUMB_E_WRONG_PHASE, "before they are read", {});
  FakeWorld::last->shown.clear();
  read();
  const int before = FakeWorld::last->calls;
  EXPECT_EQ(modify({}), PLUMB_OK);
  EXPECT_EQ(FakeWorld::last->calls, before) << "there is nothing to go on with";
}

TEST_F(GuardManifolds, NamesWhatIsWrong) {
  step();
  read();
  const PlumbManifoldChange good = change(0, PLUMB_MANIFOLD_DISABLED);
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[1].manifold is 2; it must be below 2, which is how many were read",
          {good, change(2, PLUMB_MANIFOLD_DISABLED)});
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[1].manifold is 0 again; change it once", {good, good});
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[0].what is 16; it must be PLUMB_MANIFOLD_ bits", {change(0, 16)});
  refused(PLUMB_E_NOT_DECLARED, "PLUMB_NEED_RESTITUTION", {change(0, PLUMB_MANIFOLD_RESTITUTION)});
  PlumbManifoldChange rubs = change(0, PLUMB_MANIFOLD_FRICTION);
  rubs.friction = -0.5;
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[0].friction is -0.5", {rubs});
  PlumbManifoldChange runs = change(0, PLUMB_MANIFOLD_SURFACE_VELOCITY);
  runs.surface_velocity.z = std::numeric_limits<double>::infinity();
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[0].surface_velocity.z", {runs});
  runs.surface_velocity.z = 1;
  rubs.friction = 2;
  rubs.manifold = 1;
  EXPECT_EQ(modify({runs, rubs}), PLUMB_OK) << "a refused call is as if it had not been: " << world->error_text();
}

TEST_F(GuardManifolds, NeedTheirNeed) {
  world = world_of(PLUMB_NEED_COLLISION);
  step();
  std::span<const PlumbManifold> rows;
  EXPECT_EQ(world->manifolds()->read_manifolds(rows), PLUMB_E_NOT_DECLARED);
  EXPECT_NE(world->error_text().find("PLUMB_NEED_CONTACT_MODIFICATION"), std::string::npos) << world->error_text();
}

}  // namespace
}  // namespace plumb::test
