// A profile's file is JSON that trace viewers know, whole at every moment.
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "every_call.hpp"
#include "plumb/profile.hpp"

namespace plumb::test {
namespace {

/// A profile in a file of the test's own.
class ProfileFiles : public ::testing::Test {
 protected:
  ~ProfileFiles() override { std::filesystem::remove(file); }

  /// Throws for what is no JSON.
  [[nodiscard]] nlohmann::json events() const { return nlohmann::json::parse(std::ifstream(file)).at("traceEvents"); }
  /// Of a kind ("X", "C", "M") and name.
  [[nodiscard]] std::vector<nlohmann::json> events(const std::string& kind, const std::string& name) const {
    std::vector<nlohmann::json> found;
    for (const nlohmann::json& event : events())
      if (event.at("ph") == kind && event.at("name") == name) found.push_back(event);
    return found;
  }

  std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      ("plumb-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".profile.json");
};

/// The complete backend, whose steps have this many contacts, pairs that it does not know, and phases.
const PlumbBackendTable& counting_backend() {
  ill() = good();
  ill().core.wait = [](PlumbWorld* world, PlumbStepReport* report) {
    static std::uint32_t contacts = 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const PlumbResult result = good().core.wait(world, report);
    report->contacts = contacts++ / 2;
    report->pairs = UINT32_MAX;
    report->residual = 0.5;
    report->phase_seconds[PLUMB_PHASE_NARROW] = 0.0005;
    report->phase_seconds[PLUMB_PHASE_SOLVE] = 0.001;
    return result;
  };
  return ill().core;
}

void step_times(const PlumbBackendTable* table, int times) {
  const auto world = Backend(table).create_world(world_desc(0));
  PlumbStepReport report{};
  for (int i = 0; i < times; ++i) {
    check(*world, world->step(0.1));
    check(*world, world->wait(report));
  }
}

double end_of(const nlohmann::json& zone) { return zone.at("ts").get<double>() + zone.at("dur").get<double>(); }

TEST_F(ProfileFiles, HoldCallsStepsPhasesAndCounts) {
  const PlumbBackendTable* table = layers::profile(&counting_backend(), file);
  step_times(table, 4);
  layers::end_profile(table);
  const nlohmann::json whole = nlohmann::json::parse(std::ifstream(file));
  EXPECT_EQ(whole.at("otherData").at("backend"), "fake");

  EXPECT_EQ(events("X", "create_world").size(), 1u);
  EXPECT_EQ(events("X", "destroy_world").size(), 1u);
  EXPECT_EQ(events("X", "wait").size(), 4u);
  std::vector<nlohmann::json> calls, steps;  // each by its row
  for (const nlohmann::json& event : events("X", "step")) (event.at("pid") == 1 ? calls : steps).push_back(event);
  ASSERT_EQ(calls.size(), 4u);
  ASSERT_EQ(steps.size(), 4u);
  const std::vector<nlohmann::json> solves = events("X", "solve"), narrows = events("X", "narrow");
  ASSERT_EQ(solves.size(), 4u);
  ASSERT_EQ(narrows.size(), 4u);
  EXPECT_TRUE(events("X", "broad").empty()) << "its time was not told";
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(steps[i].at("args").at("step"), i + 1);
    EXPECT_EQ(steps[i].at("args").at("residual"), 0.5);
    EXPECT_GE(steps[i].at("dur"), 2000) << "us";
    EXPECT_NEAR(solves[i].at("dur").get<double>() + narrows[i].at("dur").get<double>(), 1500, 0.01) << "us";
    EXPECT_NEAR(narrows[i].at("ts").get<double>(), steps[i].at("ts").get<double>(), 0.01);
    EXPECT_NEAR(solves[i].at("ts").get<double>(), end_of(narrows[i]), 0.01);
    EXPECT_LE(end_of(solves[i]), end_of(steps[i]));
    EXPECT_EQ(solves[i].at("pid"), steps[i].at("pid"));
    EXPECT_EQ(solves[i].at("tid"), steps[i].at("tid"));
  }
  EXPECT_EQ(events("C", "world 1 contacts").size(), 2u) << "where it changed";
  EXPECT_EQ(events("C", "world 1 contacts")[1].at("args").at("count"), 1);
  EXPECT_TRUE(events("C", "world 1 pairs").empty()) << "not known";
}

TEST_F(ProfileFiles, ThreadsHaveRowsOfTheirOwnInWhichZonesNest) {
  const PlumbBackendTable* table = layers::profile(&complete(), file);
  std::thread one([&] { const Everything everything(table); });
  one.join();
  std::thread other([&] { const Everything everything(table); });
  other.join();
  layers::end_profile(table);
  std::map<int, std::vector<std::pair<double, double>>> rows;
  for (const nlohmann::json& event : events()) {
    if (event.at("ph") == "X" && event.at("pid") == 1)
      rows[event.at("tid")].emplace_back(event.at("ts"), end_of(event));
  }
  EXPECT_EQ(rows.size(), 2u);
  EXPECT_EQ(events("M", "thread_name").size(), 4u) << "of two threads and two worlds";
  for (auto& [row, zones] : rows) {
    std::sort(zones.begin(), zones.end());
    for (std::size_t i = 1; i < zones.size(); ++i)
      EXPECT_LE(zones[i - 1].second, zones[i].first + 0.0005) << "calls of one layer follow each other";
  }
}

TEST_F(ProfileFiles, LoseNothingOfThreadsAtOnce) {
  ill() = good();
  ill().queries.rays = [](PlumbWorld*, PlumbHitMode, const PlumbRay*, std::size_t, std::uint32_t, PlumbHit*,
                          std::uint32_t, std::uint32_t*) -> PlumbResult { return PLUMB_OK; };
  ill().core.extension = [](const char* name) -> const void* {
    return std::string_view(name) == PLUMB_EXT_QUERIES ? &ill().queries : nullptr;
  };
  const PlumbBackendTable* table = layers::profile(&ill().core, file);
  PlumbWorld* world = nullptr;
  const PlumbWorldDesc desc = world_desc(0);
  ASSERT_EQ(table->create_world(&desc, &world), PLUMB_OK);
  const auto* queries = static_cast<const PlumbQueriesTable*>(table->extension(PLUMB_EXT_QUERIES));
  const auto query = [&] {
    for (int i = 0; i < 10000; ++i)  // so many that they are written meanwhile
      queries->rays(world, PLUMB_HIT_CLOSEST, nullptr, sizeof(PlumbRay), 0, nullptr, 0, nullptr);
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back(query);
  for (std::thread& thread : threads) thread.join();
  table->destroy_world(world);
  layers::end_profile(table);
  std::map<int, int> count;  // by row
  for (const nlohmann::json& event : events("X", "queries.rays")) ++count[event.at("tid")];
  EXPECT_EQ(count.size(), 4u);
  for (const auto& [row, zones] : count) EXPECT_EQ(zones, 10000) << row;
}

TEST_F(ProfileFiles, AreWholeWhenNobodyEndsThem) {
  const PlumbBackendTable* table = layers::profile(&counting_backend(), file);
  EXPECT_NO_THROW(static_cast<void>(events())) << "from the beginning";
  const auto world = Backend(table).create_world(world_desc(0));
  PlumbStepReport report{};
  std::size_t written = 0;
  for (int i = 0; i < 100; ++i) {
    check(*world, world->step(0.1));
    check(*world, world->wait(report));
    written = events("X", "wait").size();
  }
  EXPECT_GT(written, 40u) << "of 100 in 0.2 s; the last 0.05 s may be missing";
}

TEST_F(ProfileFiles, AreWholeWhenTheProcessDies) {
  const pid_t child = fork();
  if (child == 0) {
    const PlumbBackendTable* table = layers::profile(&counting_backend(), file);
    const auto world = Backend(table).create_world(world_desc(0));
    PlumbStepReport report{};
    FakeWorld::last->on_step = [steps = 0]() mutable {
      if (++steps == 100) raise(SIGKILL);
    };
    while (world->step(0.1) >= 0) static_cast<void>(world->wait(report));
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_GT(events("X", "wait").size(), 40u);
}

TEST_F(ProfileFiles, TwoAtOnceKeepApart) {
  const std::filesystem::path second = file.string() + ".second";
  const PlumbBackendTable* below = layers::profile(&counting_backend(), second);
  const PlumbBackendTable* above = layers::profile(below, file);
  step_times(above, 3);
  layers::end_profile(above);
  layers::end_profile(below);
  EXPECT_EQ(events("X", "wait").size(), 3u);
  std::filesystem::rename(second, file);
  EXPECT_EQ(events("X", "wait").size(), 3u);
}

TEST_F(ProfileFiles, ThatCannotBeWrittenAreTold) {
  try {
    static_cast<void>(layers::profile(&good().core, "/nowhere/profile.json"));
    ADD_FAILURE() << "a profile in a folder that is not there";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/profile.json"), std::string::npos) << error.what();
  }
}

TEST_F(ProfileFiles, ThatBecomeTooLargeAreTold) {
  const PlumbBackendTable* table = layers::profile(&complete(), file);
  { const Everything everything(table); }
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  rlimit small = usual;
  small.rlim_cur = 1000;  // bytes
  const auto signal_before = signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(layers::end_profile(table), Error);
  setrlimit(RLIMIT_FSIZE, &usual);
  signal(SIGXFSZ, signal_before);
}

}  // namespace
}  // namespace plumb::test
