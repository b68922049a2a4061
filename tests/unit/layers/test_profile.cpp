// The profile layer tells a sink of every call and step, as long as they took, and changes none.
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "calls.hpp"
#include "every_call.hpp"
#include "plumb/profile.hpp"
#include "profile_clock.hpp"

namespace plumb::test {
namespace {

/// Keeps what it is told, in order: "+step", "-step", "=step".
class KeepingSink final : public layers::ProfileSink {
 public:
  void begin(const layers::ProfileZone& zone) noexcept override { keep('+', zone); }
  void end(const layers::ProfileZone& zone) noexcept override { keep('-', zone); }
  void stepped(const layers::ProfiledStep& step) noexcept override {
    keep('=', step.zone);
    steps.push_back(step);
  }

  std::vector<std::string> told;
  std::vector<layers::ProfileZone> zones;  ///< of told
  std::vector<layers::ProfiledStep> steps;

 private:
  void keep(char sign, const layers::ProfileZone& zone) {
    const std::lock_guard lock(mutex_);
    told.push_back(sign + std::string(zone.name));
    zones.push_back(zone);
  }
  std::mutex mutex_;
};

/// The complete backend, of which steps report these phases, take 3 ms and have contacts.
class Reporting {
 public:
  explicit Reporting(std::array<double, PLUMB_PHASE_COUNT> seconds) {
    ill() = good();
    phase_seconds = seconds;
    ill().core.wait = [](PlumbWorld* world, PlumbStepReport* report) {
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
      const PlumbResult result = good().core.wait(world, report);
      report->contacts = 7;
      std::copy(phase_seconds.begin(), phase_seconds.end(), report->phase_seconds);
      return result;
    };
  }
  inline static std::array<double, PLUMB_PHASE_COUNT> phase_seconds;
};

/// These phases in s, and none else.
std::array<double, PLUMB_PHASE_COUNT> told(const std::map<PlumbPhase, double>& seconds) {
  std::array<double, PLUMB_PHASE_COUNT> all;
  all.fill(std::numeric_limits<double>::quiet_NaN());
  for (const auto& [phase, s] : seconds) all[phase] = s;
  return all;
}

/// A world behind a sink.
class Profile : public ::testing::Test {
 protected:
  ~Profile() override {
    world.reset();
    if (table != nullptr) layers::end_profile(table);
  }
  void open(const PlumbBackendTable* next) {
    table = layers::profile(next, sink);
    world = Backend(table).create_world(world_desc(PLUMB_NEED_ALL & ~PLUMB_NEED_CCD));
    sink.told.clear();
    sink.zones.clear();
  }
  PlumbStepReport step() {
    PlumbStepReport report{};
    EXPECT_EQ(world->step(0.1), PLUMB_OK);
    EXPECT_EQ(world->wait(report), PLUMB_OK);
    return report;
  }

  KeepingSink sink;
  const PlumbBackendTable* table = nullptr;
  std::unique_ptr<IPhysicsWorld> world;
};

TEST_F(Profile, TellsBeforeAndAfterTheCallIsMade) {
  open(&good().core);
  std::vector<std::string> before;
  FakeWorld::last->on_step = [&] { before = sink.told; };
  step();
  EXPECT_EQ(before, std::vector<std::string>{"+step"});
  EXPECT_EQ(sink.told, (std::vector<std::string>{"+step", "-step", "+wait", "-wait", "=step"}));
}

TEST_F(Profile, EveryCallOfTheListIsTold) {
  open(&complete());
  { const Everything everything(table); }
  const std::set<std::string> names(sink.told.begin(), sink.told.end());
  layers::for_each_call([&]<layers::Call call>() {
    const std::string name(layers::name_of(call));
    EXPECT_TRUE(names.contains("+" + name) && names.contains("-" + name)) << name << " was not told";
  });
}

TEST_F(Profile, TimesAreThoseOfTheCalls) {
  const Reporting backend(told({}));
  open(&ill().core);
  const auto before = layers::profile_now();
  step();
  const auto after = layers::profile_now();
  const layers::ProfileZone &began = sink.zones[0], &stepping = sink.zones[1], &waited = sink.zones[3],
                            &whole = sink.zones[4];
  EXPECT_EQ(began.duration, 0);
  EXPECT_GE(began.start, before);
  EXPECT_EQ(stepping.start, began.start);
  EXPECT_GE(waited.start, stepping.start + stepping.duration);
  EXPECT_GE(waited.duration, 3'000'000);
  EXPECT_EQ(whole.start, stepping.start);
  EXPECT_EQ(whole.start + whole.duration, waited.start + waited.duration);
  EXPECT_LE(whole.start + whole.duration, after);
}

TEST_F(Profile, PhasesAreWithinTheStepAndSumToWhatWasTold) {
  const Reporting backend(told({{PLUMB_PHASE_BROAD, 0.0001},
                                {PLUMB_PHASE_NARROW, 0.0002},
                                {PLUMB_PHASE_SOLVE, 0.0015},
                                {PLUMB_PHASE_OUTPUT, 0}}));
  open(&ill().core);
  step();
  ASSERT_EQ(sink.steps.size(), 1u);
  const layers::ProfiledStep& step = sink.steps[0];
  EXPECT_EQ(step.report.contacts, 7u);
  std::int64_t sum = 0, at = step.zone.start;
  for (std::size_t phase = 0; phase < PLUMB_PHASE_COUNT; ++phase) {
    const layers::ProfileZone& zone = step.phases[phase];
    ASSERT_EQ(zone.name == nullptr, std::isnan(Reporting::phase_seconds[phase])) << phase;
    if (zone.name == nullptr) continue;
    EXPECT_EQ(zone.start, at) << zone.name;
    EXPECT_NEAR(static_cast<double>(zone.duration), 1e9 * Reporting::phase_seconds[phase], 1) << zone.name;
    EXPECT_EQ(zone.world, step.zone.world);
    at += zone.duration;
    sum += zone.duration;
  }
  EXPECT_NEAR(static_cast<double>(sum), 0.0018e9, 1);
  EXPECT_STREQ(step.phases[PLUMB_PHASE_SOLVE].name, "solve");
}

TEST_F(Profile, PhasesOfManyThreadsEndWithTheStep) {
  const Reporting backend(told({{PLUMB_PHASE_BROAD, 10}, {PLUMB_PHASE_NARROW, 30}}));
  open(&ill().core);
  step();
  const layers::ProfiledStep& step = sink.steps.at(0);
  const layers::ProfileZone &broad = step.phases[0], &narrow = step.phases[1];
  EXPECT_EQ(narrow.start + narrow.duration, step.zone.start + step.zone.duration);
  EXPECT_NEAR(static_cast<double>(narrow.duration) / static_cast<double>(broad.duration), 3, 0.01);
  EXPECT_EQ(step.report.phase_seconds[1], 30) << "the report is as it was told";
}

TEST_F(Profile, HostsWithoutAReportHaveTheirStepsToldWhole) {
  const Reporting backend(told({{PLUMB_PHASE_BROAD, 0.001}}));
  open(&ill().core);
  PlumbWorld* bare = nullptr;
  const PlumbWorldDesc desc = world_desc(0);
  const PlumbStepDesc dt = {sizeof dt, 0, 0.1};
  ASSERT_EQ(table->create_world(&desc, &bare), PLUMB_OK);
  ASSERT_EQ(table->step(bare, &dt), PLUMB_OK);
  ASSERT_EQ(table->wait(bare, nullptr), PLUMB_OK);
  table->destroy_world(bare);
  ASSERT_EQ(sink.steps.size(), 1u);
  EXPECT_EQ(sink.steps[0].report.contacts, 7u);
  EXPECT_STREQ(sink.steps[0].phases[0].name, "broad");
}

TEST_F(Profile, ShortReportsAreReadAsFarAsTheyGo) {
  open(&good().core);
  PlumbWorld* bare = nullptr;
  const PlumbWorldDesc desc = world_desc(0);
  const PlumbStepDesc dt = {sizeof dt, 0, 0.1};
  ASSERT_EQ(table->create_world(&desc, &bare), PLUMB_OK);
  ASSERT_EQ(table->step(bare, &dt), PLUMB_OK);
  PlumbStepReport report{};
  report.struct_size = offsetof(PlumbStepReport, bodies);
  std::fill(std::begin(report.phase_seconds), std::end(report.phase_seconds), 0.25);  // another's memory
  ASSERT_EQ(table->wait(bare, &report), PLUMB_OK);
  table->destroy_world(bare);
  ASSERT_EQ(sink.steps.size(), 1u);
  EXPECT_EQ(sink.steps[0].report.step, 1u);
  EXPECT_EQ(sink.steps[0].report.pairs, UINT32_MAX);
  EXPECT_EQ(sink.steps[0].phases[0].name, nullptr);
}

TEST_F(Profile, WorldsAreNumberedAsTheyAreMade) {
  open(&good().core);
  const auto second = Backend(table).create_world(world_desc(0));
  EXPECT_EQ(sink.zones.back().world, 2u);
  PlumbStepReport report{};
  check(*second, second->step(0.1));
  EXPECT_EQ(sink.zones.back().world, 2u);
  step();
  EXPECT_EQ(sink.steps.back().zone.world, 1u);
  check(*second, second->wait(report));
  EXPECT_EQ(sink.steps.back().zone.world, 2u);
}

TEST_F(Profile, ThreadsAreToldApartAndTheirZonesNest) {
  ill() = good();
  ill().queries.rays = [](PlumbWorld*, PlumbHitMode, const PlumbRay*, std::size_t, std::uint32_t, PlumbHit*,
                          std::uint32_t, std::uint32_t*) -> PlumbResult { return PLUMB_OK; };
  ill().core.extension = [](const char* name) -> const void* {
    return std::string_view(name) == PLUMB_EXT_QUERIES ? &ill().queries : nullptr;
  };
  open(&ill().core);
  PlumbWorld* bare = nullptr;
  const PlumbWorldDesc desc = world_desc(0);
  ASSERT_EQ(table->create_world(&desc, &bare), PLUMB_OK);
  sink.told.clear();
  sink.zones.clear();
  const auto* queries = static_cast<const PlumbQueriesTable*>(table->extension(PLUMB_EXT_QUERIES));
  const auto query = [&] {
    for (int i = 0; i < 50; ++i)
      queries->rays(bare, PLUMB_HIT_CLOSEST, nullptr, sizeof(PlumbRay), 0, nullptr, 0, nullptr);
  };
  std::thread one(query), other(query);
  one.join();
  other.join();
  table->destroy_world(bare);
  std::map<std::uint32_t, std::vector<std::string>> begun, ended;
  for (std::size_t i = 0; i < 200; ++i) {
    std::vector<std::string>& inside = begun[sink.zones[i].thread];
    const std::string name = sink.told[i].substr(1);
    if (sink.told[i][0] == '+') {
      inside.push_back(name);
    } else {
      ASSERT_FALSE(inside.empty());
      EXPECT_EQ(inside.back(), name);
      inside.pop_back();
      ended[sink.zones[i].thread].push_back(name);
    }
  }
  ASSERT_EQ(ended.size(), 2u);
  for (const auto& [thread, names] : ended) EXPECT_EQ(names, std::vector<std::string>(50, "queries.rays")) << thread;
}

TEST_F(Profile, StepsThatFailAreNotTold) {
  open(layers::inject(&good().core, {"wait", 1, PLUMB_E_INTERNAL}));
  PlumbStepReport report{};
  EXPECT_EQ(world->step(0.1), PLUMB_OK);
  EXPECT_EQ(world->wait(report), PLUMB_E_INTERNAL);
  EXPECT_TRUE(sink.steps.empty());
  EXPECT_EQ(sink.told.back(), "-wait");
}

TEST_F(Profile, StacksWithValidationAndTrace) {
  const std::filesystem::path trace = std::filesystem::temp_directory_path() / "plumb-profiled.trace";
  for (const bool profile_below : {true, false}) {
    KeepingSink told;
    const PlumbBackendTable* profiled = nullptr;
    const PlumbBackendTable* next = &good().core;
    if (profile_below) next = profiled = layers::profile(next, told);
    const PlumbBackendTable* traced = layers::trace(next, trace);
    next = layers::validate(traced);
    const PlumbBackendTable* validated = next;
    if (!profile_below) next = profiled = layers::profile(next, told);
    {
      const auto stacked = Backend(next).create_world(world_desc(0));
      PlumbStepReport report{};
      check(*stacked, stacked->step(0.1));
      check(*stacked, stacked->wait(report));
    }
    EXPECT_EQ(told.steps.size(), 1u);
    EXPECT_TRUE(layers::findings(validated).empty());
    layers::end_profile(profiled);
    layers::end_trace(traced);
    EXPECT_TRUE(layers::replay(trace, &good().core).same());
  }
  std::filesystem::remove(trace);
}

TEST_F(Profile, UnknownExtensionsPass) {
  ill() = good();
  ill().core.extension = [](const char* name) -> const void* {
    return std::string_view(name) == "test.unknown/1" ? &unknown_table : nullptr;
  };
  open(&ill().core);
  EXPECT_EQ(table->extension("test.unknown/1"), &unknown_table);
  EXPECT_EQ(table->extension("test.nothing/1"), nullptr);
}

TEST(Profiles, SixteenAtATime) {
  KeepingSink sink;
  std::vector<const PlumbBackendTable*> tables;
  for (int i = 0; i < 16; ++i) tables.push_back(layers::profile(&good().core, sink));
  try {
    static_cast<void>(layers::profile(&good().core, sink));
    ADD_FAILURE() << "a seventeenth profile layer";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("all 16 profile layers"), std::string::npos) << error.what();
  }
  layers::end_profile(tables.back());
  tables.back() = layers::profile(&good().core, sink);
  for (const PlumbBackendTable* table : tables) layers::end_profile(table);
  EXPECT_THROW(layers::end_profile(tables[0]), Error);
}

}  // namespace
}  // namespace plumb::test
