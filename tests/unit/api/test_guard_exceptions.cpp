// The guard of pair exceptions: what it refuses, what the backend's class hears, and what becomes of the list.
#include <gtest/gtest.h>

#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

using Calls = std::vector<FakeWorld::ExceptionCall>;
using Pairs = std::vector<std::pair<PlumbBody, PlumbBody>>;

class GuardedExceptions : public ::testing::Test {
 protected:
  explicit GuardedExceptions(PlumbNeeds needs = PLUMB_NEED_ALL & ~PLUMB_NEED_CCD)
      : world(Backend(negotiate(&backend::open<FakeWorld>, "fake")).create_world(world_desc(needs))) {
    for (PlumbBody& id : bodies) id = add();
  }

  PlumbBody add() {
    PlumbBodyDesc desc = body_desc();
    desc.mass_mode = PLUMB_MASS_EXPLICIT;
    desc.mass = 1;
    desc.inertia = {1, 1, 1};
    PlumbBody id = 0;
    EXPECT_EQ(world->create_bodies({&desc, 1}, {&id, 1}), PLUMB_OK) << world->error_text();
    return id;
  }
  PlumbResult set(const std::vector<PlumbBodyPair>& pairs, bool touch) {
    return world->exceptions()->set_exceptions(pairs, touch);
  }
  Pairs list() {
    std::span<const PlumbBodyPair> found;
    EXPECT_EQ(world->exceptions()->list_exceptions(found), PLUMB_OK);
    Pairs pairs;
    for (const PlumbBodyPair& pair : found) pairs.emplace_back(pair.body_a, pair.body_b);
    return pairs;
  }
  void refused(PlumbResult code, const std::string& named, const std::vector<PlumbBodyPair>& pairs) {
    const Pairs before = list();
    EXPECT_EQ(set(pairs, false), code);
    EXPECT_NE(world->error_text().find(named), std::string::npos)
        << "\"" << world->error_text() << "\" does not name " << named;
    EXPECT_EQ(list(), before);
    EXPECT_TRUE(told().empty());
  }
  static Calls told() { return std::exchange(FakeWorld::last->exception_calls, {}); }

  std::unique_ptr<IPhysicsWorld> world;
  PlumbBody bodies[4] = {};
};

TEST_F(GuardedExceptions, TheClassHearsOfChangesAlone) {
  const auto [a, b, c, d] = bodies;
  EXPECT_EQ(set({{c, a}, {a, b}, {a, c}}, false), PLUMB_OK) << world->error_text();
  EXPECT_EQ(told(), (Calls{{a, b, false}, {a, c, false}})) << "the lower slot first, each once";
  EXPECT_EQ(list(), (Pairs{{a, b}, {a, c}}));
  EXPECT_EQ(set({{b, a}, {d, c}}, false), PLUMB_OK);
  EXPECT_EQ(told(), (Calls{{c, d, false}}));
  EXPECT_EQ(set({{b, d}, {a, c}}, true), PLUMB_OK);
  EXPECT_EQ(told(), (Calls{{a, c, true}}));
  EXPECT_EQ(list(), (Pairs{{a, b}, {c, d}}));
  EXPECT_EQ(set({}, false), PLUMB_OK);
  EXPECT_TRUE(told().empty());
}

TEST_F(GuardedExceptions, WrongPairsAreRefusedAllTogether) {
  const auto [a, b, c, d] = bodies;
  refused(PLUMB_E_STALE_HANDLE, "pairs[1].body_b is handle 99", {{a, b}, {a, 99}});
  refused(PLUMB_E_STALE_HANDLE, "pairs[0].body_a is handle 0", {{0, b}});
  refused(PLUMB_E_INVALID_ARGUMENT, "pairs[1].body_b is body_a", {{a, b}, {c, c}});
  ASSERT_EQ(world->destroy_bodies({&d, 1}), PLUMB_OK);
  refused(PLUMB_E_STALE_HANDLE, "pairs[0].body_a", {{d, a}});
}

TEST_F(GuardedExceptions, TouchAndStrideAreChecked) {
  const PlumbBackendTable* table = negotiate(&backend::open<FakeWorld>, "fake");
  const auto& exceptions = *static_cast<const PlumbExceptionsTable*>(table->extension(PLUMB_EXT_EXCEPTIONS));
  const PlumbWorldDesc desc = world_desc(0);
  PlumbWorld* bare = nullptr;
  ASSERT_EQ(table->create_world(&desc, &bare), PLUMB_OK);
  const PlumbBodyPair pair = {1, 2};
  EXPECT_EQ(exceptions.set(bare, &pair, sizeof pair, 1, 2), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(std::string(table->error_text(bare)).find("touch is 2; it must be 0"), std::string::npos);
  EXPECT_EQ(exceptions.set(bare, &pair, 8, 1, 0), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(std::string(table->error_text(bare)).find("stride of pairs is 8"), std::string::npos);
  EXPECT_EQ(exceptions.set(bare, nullptr, sizeof pair, 1, 0), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_EQ(exceptions.list(bare, nullptr, 0, nullptr), PLUMB_E_INVALID_ARGUMENT);
  table->destroy_world(bare);
}

TEST_F(GuardedExceptions, ARefusalOfTheClassChangesNothing) {
  const auto [a, b, c, d] = bodies;
  ASSERT_EQ(set({{a, b}}, false), PLUMB_OK);
  FakeWorld::last->answer = PLUMB_E_OUT_OF_MEMORY;
  EXPECT_EQ(set({{c, d}}, false), PLUMB_E_OUT_OF_MEMORY);
  EXPECT_EQ(set({{a, b}}, true), PLUMB_E_OUT_OF_MEMORY);
  FakeWorld::last->answer = PLUMB_OK;
  EXPECT_EQ(list(), (Pairs{{a, b}}));
}

TEST_F(GuardedExceptions, SleepersWake) {
  const auto [a, b, c, d] = bodies;  // FakeWorld says that the body in slot 0 sleeps
  ASSERT_EQ(set({{b, c}}, false), PLUMB_OK);
  EXPECT_FALSE(FakeWorld::last->written.contains(PLUMB_FIELD_AWAKE)) << "nobody slept";
  ASSERT_EQ(set({{d, a}}, false), PLUMB_OK);
  EXPECT_EQ(FakeWorld::last->written[PLUMB_FIELD_AWAKE], std::vector<double>{1});
  FakeWorld::last->written.clear();
  ASSERT_EQ(set({{d, a}}, false), PLUMB_OK);
  EXPECT_FALSE(FakeWorld::last->written.contains(PLUMB_FIELD_AWAKE)) << "nothing changed";
}

TEST_F(GuardedExceptions, TheyDieWithTheirBodies) {
  const auto [a, b, c, d] = bodies;
  ASSERT_EQ(set({{a, b}, {b, c}, {c, d}}, false), PLUMB_OK);
  told();
  FakeWorld::last->fails_to_destroy = true;
  EXPECT_LT(world->destroy_bodies({&b, 1}), 0);
  EXPECT_EQ(told(), (Calls{{a, b, true}, {b, c, true}, {a, b, false}, {b, c, false}})) << "a failure is undone";
  EXPECT_EQ(list(), (Pairs{{a, b}, {b, c}, {c, d}}));
  FakeWorld::last->fails_to_destroy = false;
  ASSERT_EQ(world->destroy_bodies({&b, 1}), PLUMB_OK);
  EXPECT_EQ(told(), (Calls{{a, b, true}, {b, c, true}}));
  EXPECT_EQ(list(), (Pairs{{c, d}}));
  const PlumbBody heir = add();
  EXPECT_EQ(slot_of(heir), slot_of(b));
  EXPECT_EQ(list(), (Pairs{{c, d}}));
}

TEST_F(GuardedExceptions, SnapshotsHoldThem) {
  const auto [a, b, c, d] = bodies;
  ASSERT_EQ(set({{a, b}, {c, d}}, false), PLUMB_OK);
  std::span<const std::byte> saved;
  ASSERT_EQ(world->snapshot()->save(saved), PLUMB_OK);
  const std::vector<std::byte> bytes(saved.begin(), saved.end());
  ASSERT_EQ(set({{a, b}}, true), PLUMB_OK);
  ASSERT_EQ(set({{b, c}}, false), PLUMB_OK);
  told();
  FakeWorld::last->written.clear();
  ASSERT_EQ(world->snapshot()->restore(bytes), PLUMB_OK) << world->error_text();
  EXPECT_EQ(told(), (Calls{{b, c, true}, {a, b, false}}));
  EXPECT_EQ(list(), (Pairs{{a, b}, {c, d}}));
  EXPECT_EQ(FakeWorld::last->restored, 5u) << "the class gets what it saved";
  EXPECT_FALSE(FakeWorld::last->written.contains(PLUMB_FIELD_AWAKE)) << "who sleeps is the snapshot's to say";
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::byte> torn = bytes;
    torn[i] ^= std::byte{1};
    EXPECT_EQ(world->snapshot()->restore(torn), PLUMB_E_CORRUPT) << "byte " << i;
  }
}

TEST_F(GuardedExceptions, WorldsWithoutThemSayNothing) {
  std::span<const std::byte> saved;
  ASSERT_EQ(world->snapshot()->save(saved), PLUMB_OK);
  ASSERT_EQ(world->snapshot()->restore(std::vector<std::byte>(saved.begin(), saved.end())), PLUMB_OK);
  ASSERT_EQ(world->destroy_bodies({bodies, 2}), PLUMB_OK);
  EXPECT_TRUE(told().empty());
  EXPECT_TRUE(list().empty());
}

}  // namespace
}  // namespace plumb::test
