// A child that dies, hangs or talks nonsense costs its world and nothing else, and the text says what happened.
#include <gtest/gtest.h>

#include <chrono>

#include "world.hpp"

namespace plumb::wire {
namespace {

const std::string kFake = PLUMB_FAKE_CHILD;
std::vector<std::string> fake(const std::string& how) { return {"python3", kFake, how}; }

std::string describe(const std::string& how) {
  Child child(fake(how));
  return child.call(Call::kDescribe, "", {}, std::chrono::seconds(30)).text;
}

/// A world of a fake with one body.
struct FakeWorld {
  explicit FakeWorld(const std::string& how, double deadline = 30, PlumbNeeds needs = 0)
      : manifest(describe(how == "takes" ? how : "well"), "fake"), world(init(deadline, needs), manifest, fake(how)) {
    PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
    desc.rolling_friction = (needs & PLUMB_NEED_ROLLING_FRICTION) != 0 ? 0.25 : 0;
    world.create_bodies({&desc, 1}, {&body, 1});
  }
  WorldInit init(double deadline, PlumbNeeds needs) {
    WorldInit all{world_desc(needs), nullptr, manifest.settings(), {}};
    for (const PlumbSettingInfo& setting : manifest.settings()) all.values.push_back(setting.default_value);
    all.values.back().number = deadline;
    return all;
  }
  Manifest manifest;
  World world;
  PlumbBody body = (PlumbBody{1} << 32);
};

/// What a step of such a child fails with.
Error failure(FakeWorld& fake_world) {
  try {
    fake_world.world.step(1.0 / 60);
  } catch (const Error& error) {
    return error;
  }
  return Error(PLUMB_OK, "it did not fail");
}

void expect_lost(const std::string& how, const std::string& words) {
  FakeWorld lost(how);
  const Error error = failure(lost);
  EXPECT_EQ(error.code(), PLUMB_E_WORLD_LOST) << how << ": " << error.what();
  EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << how << ": " << error.what();
  EXPECT_EQ(failure(lost).code(), PLUMB_E_WORLD_LOST) << how << ": once lost, lost for ever";
}

TEST(WireChild, DeathIsAWorldLostAndTheTextHoldsItsLastWords) {
  expect_lost("raises", "the engine of the fake broke");
  expect_lost("raises", "ended with status 1");
  expect_lost("aborts", "Aborted");
  expect_lost("half", "ended with status 7");
}

TEST(WireChild, NonsenseIsAWorldLost) {
  expect_lost("garbage", "no frame of plumb.wire/1");
  expect_lost("huge", "no frame of plumb.wire/1");
  expect_lost("other", "answered another call");
  expect_lost("short", "not of its form");
}

TEST(WireChild, ABodyThatIsNobodysIsAWorldLost) {
  FakeWorld stranger("stranger", 30, PLUMB_NEED_EVENTS);
  EXPECT_EQ(failure(stranger).code(), PLUMB_E_WORLD_LOST);
}

TEST(WireChild, AHangEndsAtTheDeadline) {
  FakeWorld hangs("hangs");
  PlumbSettingValue soon{PLUMB_SETTING_FLOAT, 0, 0.2, nullptr};
  hangs.world.set_setting(kDeadlineSetting, soon);
  const auto start = std::chrono::steady_clock::now();
  const Error error = failure(hangs);
  EXPECT_EQ(error.code(), PLUMB_E_WORLD_LOST);
  EXPECT_NE(std::string(error.what()).find("call_deadline"), std::string::npos) << error.what();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(WireChild, ARefusalIsAResultAndTheWorldLivesOn) {
  FakeWorld refuses("refuses");
  EXPECT_EQ(failure(refuses).code(), PLUMB_E_UNSUPPORTED);
  PlumbPose pose;
  refuses.world.read(PLUMB_FIELD_POSE, {&refuses.body, 1}, rows_over<PlumbPose>({&pose, 1}));
  EXPECT_EQ(pose.position.y, 2);
}

TEST(WireChild, WhatItPrintsNeitherStopsItNorIsTakenForAnAnswer) {
  FakeWorld talks("talks");
  talks.world.step(1.0 / 60);
  PlumbStepReport report{};
  talks.world.wait(report);
  EXPECT_EQ(report.phase_seconds[PLUMB_PHASE_SOLVE], 0.25);
}

/// The fake that takes them answers a read with its last write: field, slot, and what was written.
std::array<double, 7> last_write(FakeWorld& takes) {
  std::array<double, 7> row{};
  takes.world.read(PLUMB_FIELD_POSE, {&takes.body, 1}, rows_over(std::span(&row, 1)));
  return row;
}

TEST(WireChild, TakesImpulsesItselfWhereItsManifestSaysSo) {
  FakeWorld takes("takes");
  const std::array<double, 3> push = {1, 2, 3};
  takes.world.write(PLUMB_FIELD_IMPULSE, {&takes.body, 1}, const_rows_over(std::span(&push, 1)));
  EXPECT_EQ(last_write(takes), (std::array<double, 7>{PLUMB_FIELD_IMPULSE, 0, 1, 2, 3, 0, 0}));
  EXPECT_EQ(takes.manifest.capability(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_IMPULSE, 0).degree, PLUMB_NATIVE);
  EXPECT_EQ(takes.manifest.capability(PLUMB_CAP_FIELD_WRITE, PLUMB_FIELD_TORQUE, 0).degree, PLUMB_EMULATED);
}

TEST(WireChild, IsToldOfRollingFrictionAfterABodyIsMade) {
  FakeWorld takes("takes", 30, PLUMB_NEED_ROLLING_FRICTION);
  EXPECT_EQ(last_write(takes), (std::array<double, 7>{PLUMB_FIELD_ROLLING_FRICTION, 0, 0.25, 0, 0, 0, 0}));
  std::array<double, 2> row{};
  takes.world.read(PLUMB_FIELD_ROLLING_FRICTION, {&takes.body, 1}, rows_over(std::span(&row, 1)));
  EXPECT_EQ(row[0], 0.25) << "what was written is read, not asked";
}

TEST(WireChild, AProgramThatIsNotThereIsUnsupported) {
  try {
    Child child({"plumb-no-such-program"});
    FAIL() << "it started";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), PLUMB_E_UNSUPPORTED);
    EXPECT_NE(std::string(error.what()).find("plumb-no-such-program"), std::string::npos);
  }
}

std::string manifest_error(const std::string& how, PlumbResult code) {
  try {
    const Manifest manifest(describe(how), "fake");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "it was taken";
}

TEST(WireManifest, WhatIsWrongWithItIsNamed) {
  EXPECT_NE(manifest_error("version", PLUMB_E_VERSION).find("plumb.wire/2"), std::string::npos);
  EXPECT_NE(manifest_error("misspelt", PLUMB_E_CORRUPT).find("spere"), std::string::npos);
  manifest_error("torn", PLUMB_E_CORRUPT);
  EXPECT_THROW(describe("mute"), Error);
}

TEST(WireManifest, TellsWhatIsMissing) {
  EXPECT_EQ(Manifest(describe("unmet"), "fake").unmet(), "run ./dev deps field");
}

TEST(WireManifest, LaterRulesWinAndPairsHaveNoOrder) {
  const Manifest manifest(
      R"({"wire": "plumb.wire/1", "version": "1", "build": "b", "description": "d", "precision": "f32",
    "settings": [{"name": "mode", "type": "choice", "role": "behaviour", "choices": ["a", "b"], "default": "b", "doc": "d"}],
    "capabilities": [["pair", "*", "*", "native"], ["pair", "box|hull", "mesh", "approximate", "so so"],
                     ["need", "ccd", "*", "native"], ["shape", "plane", "*", "native"],
                     ["joint", "gear", "*", "none", "not here"]]})",
      "x");
  EXPECT_EQ(manifest.capability(PLUMB_CAP_PAIR, PLUMB_BOX, PLUMB_SPHERE).degree, PLUMB_NATIVE);
  EXPECT_EQ(manifest.capability(PLUMB_CAP_PAIR, PLUMB_TRIANGLE_MESH, PLUMB_BOX).degree, PLUMB_APPROXIMATE);
  EXPECT_STREQ(manifest.capability(PLUMB_CAP_PAIR, PLUMB_BOX, PLUMB_TRIANGLE_MESH).note, "so so");
  EXPECT_EQ(manifest.capability(PLUMB_CAP_NEED, 5, 0).degree, PLUMB_NATIVE);
  EXPECT_EQ(manifest.capability(PLUMB_CAP_NEED, 6, 0).degree, PLUMB_NONE) << "what is not named is not there";
  EXPECT_EQ(manifest.capability(PLUMB_CAP_SHAPE, PLUMB_PLANE, PLUMB_DYNAMIC).degree, PLUMB_NONE) << "no plane moves";
  EXPECT_STREQ(manifest.capability(PLUMB_CAP_JOINT, PLUMB_JOINT_GEAR, 0).note, "not here") << "the child's own reason";
  EXPECT_STREQ(manifest.settings()[0].default_value.choice, "b");
  EXPECT_STREQ(manifest.settings().back().name, kDeadlineSetting);
}

}  // namespace
}  // namespace plumb::wire
