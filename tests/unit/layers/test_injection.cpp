// The fault injection layer fails the call it was told to, once, and nothing else.
#include "ill_table.hpp"

namespace plumb::test {
namespace {

TEST(Injection, TheNthCallFailsAndIsNotForwarded) {
  const PlumbBackendTable* table = layers::inject(&good().core, {"step", 2, PLUMB_E_DEVICE_LOST});
  const auto world = Backend(table).create_world(world_desc(0));
  PlumbStepReport report{};
  EXPECT_EQ(world->step(0.1), PLUMB_OK);
  EXPECT_EQ(world->wait(report), PLUMB_OK);
  const int before = FakeWorld::last->calls;
  EXPECT_EQ(world->step(0.1), PLUMB_E_DEVICE_LOST);
  EXPECT_EQ(FakeWorld::last->calls, before);
  EXPECT_EQ(world->error_text(), "injected failure of call 2 of step");
  EXPECT_EQ(world->step(0.1), PLUMB_OK);
  EXPECT_EQ(world->wait(report), PLUMB_OK);
}

TEST(Injection, StacksUnderValidation) {
  const PlumbBackendTable* table = layers::validate(layers::inject(&good().core, {"wait", 1, PLUMB_E_WORLD_LOST}));
  {
    const auto world = Backend(table).create_world(world_desc(0));
    PlumbStepReport report{};
    EXPECT_EQ(world->step(0.1), PLUMB_OK);
    EXPECT_EQ(world->wait(report), PLUMB_E_WORLD_LOST);
    EXPECT_EQ(world->step(0.1), PLUMB_E_WORLD_LOST) << "a lost world stays lost";
  }
  EXPECT_EQ(layers::findings(table).size(), 1u);
}

TEST(Injection, WorldsThatCannotBeMadeSayWhy) {
  const PlumbBackendTable* table = layers::inject(&good().core, {"create_world", 1, PLUMB_E_OUT_OF_MEMORY});
  try {
    static_cast<void>(Backend(table).create_world(world_desc(0)));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), PLUMB_E_OUT_OF_MEMORY);
    EXPECT_NE(std::string(error.what()).find("injected failure"), std::string::npos);
  }
  EXPECT_NE(Backend(table).create_world(world_desc(0)), nullptr);
}

TEST(Injection, WrongWishesAreRefused) {
  try {
    static_cast<void>(layers::inject(&good().core, {"stepp", 1, PLUMB_E_INTERNAL}));
    ADD_FAILURE() << "a call that is none was made to fail";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"step\"?"), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(layers::inject(&good().core, {"step", 1, PLUMB_OK})), Error);
}

}  // namespace
}  // namespace plumb::test
