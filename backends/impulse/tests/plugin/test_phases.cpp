// Time by phase, as the report of a step has it.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "exec/phase_clock.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

bool is_told(PlumbPhase phase) { return phase <= PLUMB_PHASE_SOLVE || phase == PLUMB_PHASE_OUTPUT; }

struct TimedStep {
  PlumbStepReport report;
  double seconds;  // of step and wait together
};
TimedStep timed_step(Scene& scene) {
  TimedStep timed{};
  const auto start = std::chrono::steady_clock::now();
  check(scene.world(), scene.world().step(1.0 / 60));
  check(scene.world(), scene.world().wait(timed.report));
  timed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return timed;
}

class Phases : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string unmet = Executor::unmet_requirement(); !unmet.empty()) GTEST_SKIP() << unmet;
  }
};

TEST_F(Phases, AreToldAndAddUpToLessThanTheStep) {
  Scene scene(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION, kDown, 1);
  scene.container(4, 40);
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < 300; ++i) scene.add(cube, {1.3 * (i % 5) - 2.6, 1 + 1.01 * (i / 25), 1.3 * (i / 5 % 5) - 2.6});
  std::uint32_t measured = 0;
  for (std::uint32_t i = 0; i < 2 * PhaseClock::kEvery + 2; ++i) {
    const TimedStep timed = timed_step(scene);
    double sum = 0;
    for (PlumbPhase phase = 0; phase < PLUMB_PHASE_COUNT; ++phase) {
      const double seconds = timed.report.phase_seconds[phase];
      if (std::isnan(seconds)) continue;
      EXPECT_TRUE(is_told(phase)) << "phase " << phase << " is not known apart";
      EXPECT_GT(seconds, 0) << "phase " << phase;
      sum += seconds;
      ++measured;
    }
    EXPECT_LE(sum, timed.seconds) << "step " << i;
    EXPECT_TRUE(PhaseClock::kEvery > 1 || sum > timed.seconds / 2) << sum << " of " << timed.seconds;
  }
  EXPECT_EQ(measured, PhaseClock::kEvery == 1 ? 4U * 5 : 2U * 5) << "five phases of every measured step";
}

TEST_F(Phases, ThatAreLeftOutTakeNoTime) {
  Scene scene(engine(), PLUMB_NEED_ROTATION, {0, 0, 0}, 1);
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 1;
  scene.body.flags = PLUMB_BODY_NO_ROTATION;
  scene.body.material.friction = 0;
  scene.add(0, {0, 0, 0});
  TimedStep timed{};
  for (std::uint32_t i = 0; i < PhaseClock::kEvery; ++i) timed = timed_step(scene);
  for (const PlumbPhase phase : {PLUMB_PHASE_BROAD, PLUMB_PHASE_NARROW, PLUMB_PHASE_ISLANDS})
    EXPECT_EQ(timed.report.phase_seconds[phase], 0) << "phase " << phase;
  EXPECT_GT(timed.report.phase_seconds[PLUMB_PHASE_SOLVE], 0);
}

TEST_F(Phases, AreThoseThatAreClaimed) {
  const Backend backend = engine();
  for (PlumbPhase phase = 0; phase < PLUMB_PHASE_COUNT; ++phase)
    EXPECT_EQ(backend.capability(PLUMB_CAP_PHASE_TIME, phase) != PLUMB_NONE, is_told(phase)) << "phase " << phase;
}

}  // namespace
}  // namespace plumb::impulse::test
