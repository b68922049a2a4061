// The guard of plumb.closest/1: a probe that makes no sense is refused by its name, its value and the remedy, and
// writes nothing.
#include <gtest/gtest.h>

#include <limits>

#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

constexpr PlumbFilter kAll = {1, ~0U, 0, 0};

class GuardClosest : public ::testing::Test {
 protected:
  explicit GuardClosest(PlumbNeeds needs = PLUMB_NEED_QUERIES)
      : table(backend.table()), closest(*static_cast<const PlumbClosestTable*>(table.extension(PLUMB_EXT_CLOSEST))) {
    const PlumbWorldDesc desc = world_desc(needs);
    EXPECT_EQ(table.create_world(&desc, &world), PLUMB_OK) << table.error_text(nullptr);
    PlumbShapeDesc descs[2] = {shape_desc(PLUMB_SPHERE), shape_desc(PLUMB_PLANE)};
    descs[0].radius = 0.5;
    PlumbShape ids[2];
    EXPECT_EQ(table.create_shapes(world, descs, sizeof descs[0], 2, ids), PLUMB_OK) << table.error_text(world);
    probe = {ids[0], identity_pose(), 2, kAll};
    plane = ids[1];
  }
  ~GuardClosest() override { table.destroy_world(world); }

  PlumbResult ask(PlumbHitMode mode = PLUMB_HIT_ALL) {
    const PlumbProbe both[2] = {good, probe};
    return closest.bodies(world, mode, both, sizeof probe, 2, rows, 2, &count);
  }
  /// The second of two probes is spoilt.
  void refused(PlumbResult code, const std::string& words, PlumbHitMode mode = PLUMB_HIT_ALL) {
    const int calls = FakeWorld::last->calls;
    rows[0].probe = 77;
    count = 99;
    EXPECT_EQ(ask(mode), code);
    const std::string text = table.error_text(world);
    EXPECT_NE(text.find(words), std::string::npos) << "\"" << text << "\" does not say \"" << words << "\"";
    EXPECT_EQ(FakeWorld::last->calls, calls) << "the class was called";
    EXPECT_EQ(rows[0].probe, 77U) << "an output was written although the call failed";
    EXPECT_EQ(count, 99U) << "an output was written although the call failed";
  }
  template <class Spoil>
  void refused_when(PlumbResult code, const std::string& words, Spoil&& spoil) {
    good = probe;
    const PlumbProbe kept = probe;
    spoil(probe);
    refused(code, words);
    probe = kept;
  }

  Backend backend{negotiate(&backend::open<FakeWorld>, "fake")};
  const PlumbBackendTable& table;
  const PlumbClosestTable& closest;
  PlumbWorld* world = nullptr;
  PlumbProbe probe{}, good{};
  PlumbShape plane = 0;
  PlumbClosest rows[2] = {};
  std::uint32_t count = 0;
};

TEST_F(GuardClosest, WhatMakesSenseReachesTheClass) {
  good = probe;
  EXPECT_EQ(ask(PLUMB_HIT_CLOSEST), PLUMB_OK) << table.error_text(world);
  EXPECT_EQ(count, 2U);
  EXPECT_EQ(closest.bodies(world, PLUMB_HIT_ALL, &probe, sizeof probe, 1, nullptr, 0, &count), PLUMB_TRUNCATED);
  EXPECT_EQ(count, 1U);
  EXPECT_EQ(closest.bodies(world, PLUMB_HIT_ALL, nullptr, sizeof probe, 0, nullptr, 0, &count), PLUMB_OK);
  EXPECT_EQ(count, 0U);
}

TEST_F(GuardClosest, DepthsOfOverlapAreOfConvexShapesThatAreThere) {
  const auto& queries = *static_cast<const PlumbQueriesTable*>(table.extension(PLUMB_EXT_QUERIES));
  PlumbOverlap overlap = {probe.shape, identity_pose(), kAll};
  PlumbPenetration row{};
  const auto ask = [&] { return queries.penetrations(world, &overlap, sizeof overlap, 1, &row, 1, &count); };
  EXPECT_EQ(ask(), PLUMB_OK) << table.error_text(world);
  EXPECT_EQ(count, 1U);
  const int calls = FakeWorld::last->calls;
  const auto spoilt = [&](PlumbResult code, const std::string& words) {
    EXPECT_EQ(ask(), code);
    EXPECT_NE(std::string(table.error_text(world)).find(words), std::string::npos) << table.error_text(world);
    overlap = {probe.shape, identity_pose(), kAll};
  };
  overlap.shape = plane;
  spoilt(PLUMB_E_INVALID_ARGUMENT, "convex");
  overlap.shape = 99;
  spoilt(PLUMB_E_STALE_HANDLE, "overlaps[0].shape");
  overlap.pose.orientation.w = 3;
  spoilt(PLUMB_E_INVALID_ARGUMENT, "orientation");
  EXPECT_EQ(FakeWorld::last->calls, calls) << "the class was called";
}

TEST_F(GuardClosest, CastsThatTurnHaveAWayAndAtMostAWholeTurn) {
  const auto& queries = *static_cast<const PlumbQueriesTable*>(table.extension(PLUMB_EXT_QUERIES));
  const PlumbTurningCast right = {probe.shape, identity_pose(), {1, 0, 0}, {0, 3, 4}, kAll};
  PlumbTurningCast cast = right;
  PlumbHit hit{};
  const auto ask = [&](PlumbHitMode mode) {
    return queries.turning_casts(world, mode, &cast, sizeof cast, 1, &hit, 1, &count);
  };
  EXPECT_EQ(ask(PLUMB_HIT_CLOSEST), PLUMB_OK) << table.error_text(world);
  EXPECT_EQ(count, 1U);
  cast.translation = {0, 0, 0};
  EXPECT_EQ(ask(PLUMB_HIT_CLOSEST), PLUMB_OK) << table.error_text(world);
  cast = right;
  cast.rotation = {0, 0, 0};
  EXPECT_EQ(ask(PLUMB_HIT_CLOSEST), PLUMB_OK) << table.error_text(world);
  const int calls = FakeWorld::last->calls;
  const auto spoilt = [&](PlumbResult code, const std::string& words, PlumbHitMode mode = PLUMB_HIT_ALL) {
    EXPECT_EQ(ask(mode), code);
    EXPECT_NE(std::string(table.error_text(world)).find(words), std::string::npos) << table.error_text(world);
    cast = right;
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  cast.translation = cast.rotation = {0, 0, 0};
  spoilt(PLUMB_E_INVALID_ARGUMENT, "casts[0].translation and rotation are 0; one must have a length");
  cast.rotation = {0, 6, 8};
  spoilt(PLUMB_E_INVALID_ARGUMENT, "casts[0].rotation is 10 rad long; it must be at most 2 pi, a whole turn");
  cast.rotation.z = nan;
  spoilt(PLUMB_E_INVALID_ARGUMENT, "casts[0].rotation.z is nan; it must be finite");
  cast.translation.x = nan;
  spoilt(PLUMB_E_INVALID_ARGUMENT, "casts[0].translation.x is nan; it must be finite");
  cast.shape = plane;
  spoilt(PLUMB_E_INVALID_ARGUMENT, "convex");
  spoilt(PLUMB_E_INVALID_ARGUMENT, "mode is 5", 5);
  EXPECT_EQ(FakeWorld::last->calls, calls) << "the class was called";
}

TEST_F(GuardClosest, IsThereForHostsInCxx) {
  const std::unique_ptr<IPhysicsWorld> host = backend.create_world(world_desc(PLUMB_NEED_QUERIES));
  ASSERT_NE(host->closest(), nullptr);
  PlumbShapeDesc ball = shape_desc(PLUMB_SPHERE);
  ball.radius = 1;
  ASSERT_EQ(host->create_shapes({&ball, 1}, {&probe.shape, 1}), PLUMB_OK);
  const std::vector<PlumbProbe> probes(3, probe);
  const ClosestBodies found = host->closest()->closest_bodies(PLUMB_HIT_CLOSEST, probes);
  EXPECT_EQ(found.result, PLUMB_OK) << host->error_text();
  EXPECT_EQ(found.rows.size(), 3U);
}

TEST_F(GuardClosest, NumbersThatMakeNone) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto distance = [&](double value, const std::string& text) {
    refused_when(PLUMB_E_INVALID_ARGUMENT, "probes[1].most_distance is " + text,
                 [&](PlumbProbe& p) { p.most_distance = value; });
  };
  distance(0, "0; it must be finite and above 0");
  distance(-1, "-1; it must be finite and above 0");
  distance(nan, "nan; it must be finite and above 0");
  distance(infinity, "inf; it must be finite and above 0");
  refused_when(PLUMB_E_INVALID_ARGUMENT, "probes[1].pose.position.y is nan; it must be finite",
               [&](PlumbProbe& p) { p.pose.position.y = nan; });
  refused_when(PLUMB_E_INVALID_ARGUMENT, "probes[1].pose.orientation (its length) is 2; it must be 1",
               [&](PlumbProbe& p) { p.pose.orientation.w = 2; });
}

TEST_F(GuardClosest, ShapesThatCannotBeProbes) {
  refused_when(PLUMB_E_STALE_HANDLE, "probes[1].shape names no living shape", [](PlumbProbe& p) { p.shape = 99; });
  refused_when(PLUMB_E_INVALID_ARGUMENT, "probes[1].shape is a plane; it must be convex",
               [&](PlumbProbe& p) { p.shape = plane; });
}

TEST_F(GuardClosest, ModesAndMemory) {
  good = probe;
  refused(PLUMB_E_INVALID_ARGUMENT, "mode is 5; it must be PLUMB_HIT_CLOSEST or PLUMB_HIT_ALL", 5);
  EXPECT_EQ(closest.bodies(world, PLUMB_HIT_ALL, nullptr, sizeof probe, 1, rows, 2, &count), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_EQ(closest.bodies(world, PLUMB_HIT_ALL, &probe, 8, 1, rows, 2, &count), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_EQ(closest.bodies(world, PLUMB_HIT_ALL, &probe, sizeof probe, 1, nullptr, 2, &count),
            PLUMB_E_INVALID_ARGUMENT);
  EXPECT_EQ(closest.bodies(nullptr, PLUMB_HIT_ALL, &probe, sizeof probe, 1, rows, 2, &count), PLUMB_E_INVALID_ARGUMENT);
}

class GuardClosestWithoutNeed : public GuardClosest {
 protected:
  GuardClosestWithoutNeed() : GuardClosest(0) {}
};
TEST_F(GuardClosestWithoutNeed, NeedsQueries) {
  good = probe;
  refused(PLUMB_E_NOT_DECLARED, "PLUMB_NEED_QUERIES");
}

TEST_F(GuardClosest, OfAClassWithoutItNothingIsClaimed) {
  const backend::BackendFacts facts = [] {
    backend::BackendFacts lacking = backend::Tables<FakeWorld>::facts();
    lacking.has_closest = false;
    lacking.capability = [](PlumbCapability, std::uint32_t a, std::uint32_t, const char*& note) -> PlumbDegree {
      note = a == PLUMB_BOX ? "why not" : "how";
      return a == PLUMB_BOX ? PLUMB_NONE : PLUMB_NATIVE;
    };
    return lacking;
  }();
  const char* note = nullptr;
  EXPECT_EQ(backend::answer_capability(facts, PLUMB_CAP_CLOSEST, PLUMB_SPHERE, 0, &note), PLUMB_NONE);
  EXPECT_STREQ(note, "");
  EXPECT_EQ(backend::answer_capability(facts, PLUMB_CAP_CLOSEST, PLUMB_BOX, 0, &note), PLUMB_NONE);
  EXPECT_STREQ(note, "why not");
  EXPECT_EQ(backend::answer_capability(facts, PLUMB_CAP_COUNT, 0, 0, &note), PLUMB_NONE);
  EXPECT_STREQ(note, "");
}

}  // namespace
}  // namespace plumb::test
