// The guard of plumb.worlds/1: which worlds may be grouped.
#include <gtest/gtest.h>

#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

class GuardWorlds : public ::testing::Test {
 protected:
  GuardWorlds() {
    for (int i = 0; i < 3; ++i) {
      worlds.push_back(backend.create_world(world_desc(0)));
      classes.push_back(FakeWorld::last);
    }
  }
  PlumbResult group(const std::vector<IPhysicsWorld*>& others) { return worlds[0]->worlds()->group(others); }
  void refused(PlumbResult code, const std::string& text, const std::vector<IPhysicsWorld*>& others) {
    const int before = classes[0]->calls;
    EXPECT_EQ(group(others), code);
    EXPECT_NE(worlds[0]->error_text().find(text), std::string::npos) << worlds[0]->error_text();
    EXPECT_EQ(classes[0]->calls, before) << "the class was called";
  }

  Backend backend{negotiate(&backend::open<FakeWorld>, "fake")};
  std::vector<std::unique_ptr<IPhysicsWorld>> worlds;
  std::vector<FakeWorld*> classes;
};

TEST_F(GuardWorlds, TheClassGetsWorldsOfItsOwn) {
  ASSERT_EQ(group({worlds[2].get(), worlds[1].get()}), PLUMB_OK) << worlds[0]->error_text();
  EXPECT_EQ(classes[0]->grouped_with, (std::vector<IPhysicsWorld*>{classes[2], classes[1]}));
  ASSERT_EQ(group({}), PLUMB_OK);
  EXPECT_TRUE(classes[0]->grouped_with.empty());
}

TEST_F(GuardWorlds, EachIsNamedOnce) {
  refused(PLUMB_E_INVALID_ARGUMENT, "a world twice", {worlds[1].get(), worlds[2].get(), worlds[1].get()});
  refused(PLUMB_E_INVALID_ARGUMENT, "a world twice", {worlds[0].get()});
}

TEST_F(GuardWorlds, NoneIsWithinAStep) {
  PlumbStepReport report;
  ASSERT_EQ(worlds[2]->step(0.01), PLUMB_OK);
  refused(PLUMB_E_WRONG_PHASE, "others[1] is within a step", {worlds[1].get(), worlds[2].get()});
  ASSERT_EQ(worlds[2]->wait(report), PLUMB_OK);
  ASSERT_EQ(worlds[0]->step(0.01), PLUMB_OK);
  refused(PLUMB_E_WRONG_PHASE, "within a step", {worlds[1].get()});
  ASSERT_EQ(worlds[0]->wait(report), PLUMB_OK);
  EXPECT_EQ(group({worlds[1].get(), worlds[2].get()}), PLUMB_OK);
}

TEST_F(GuardWorlds, AllAreOfOneBackend) {
  // A world that is no backend's, and pointers that only C can give.
  FakeWorld* const bare = classes[1];
  EXPECT_THROW((void)group({bare}), Error);
  const PlumbBackendTable& table = backend.table();
  const auto* extension = static_cast<const PlumbWorldsTable*>(table.extension(PLUMB_EXT_WORLDS));
  ASSERT_NE(extension, nullptr);
  const PlumbWorldDesc desc = world_desc(0);
  PlumbWorld* world = nullptr;
  ASSERT_EQ(table.create_world(&desc, &world), PLUMB_OK);
  PlumbWorld* const none[] = {nullptr};
  EXPECT_EQ(extension->group(world, none, 1), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(std::string(table.error_text(world)).find("others[0] is null"), std::string::npos);
  EXPECT_EQ(extension->group(world, nullptr, 1), PLUMB_E_INVALID_ARGUMENT);
  table.destroy_world(world);
}

}  // namespace
}  // namespace plumb::test
