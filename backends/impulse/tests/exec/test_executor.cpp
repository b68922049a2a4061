// Threads: each loop visits everything once, whoever runs it, under the same rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "exec/executor.hpp"
#include "exec/floating_point.hpp"
#include "tests/rigs/host_modes.hpp"
#include "tests/rigs/job_host.hpp"

namespace plumb::impulse {
namespace {

using test::JobHost;

using test::modes::kFlush;

void visits_all_once(ThreadPool& pool) {
  for (const std::uint32_t n : {0U, 1U, 7U, 64U, 65U, 100U, 1000U, 12345U}) {
    std::vector<std::atomic<std::uint32_t>> visits(n);
    pool.each(n, [&](std::uint32_t i) { ++visits[i]; });
    for (std::uint32_t i = 0; i < n; ++i) ASSERT_EQ(visits[i], 1U) << i << " of " << n;
  }
}

TEST(ThreadPools, VisitEverythingOnce) {
  for (const std::uint32_t threads : {0U, 1U, 2U, 5U}) {
    ThreadPool pool(nullptr, threads);
    EXPECT_GE(pool.threads(), 1U);
    visits_all_once(pool);
  }
}

/// Loops of all lengths follow each other faster than threads come and go; more threads than processors, too.
TEST(ThreadPools, VisitEverythingOnceWhileTheyStayTogether) {
  for (const std::uint32_t threads : {1U, 2U, 3U, 8U}) {
    ThreadPool pool(nullptr, threads);
    std::vector<std::uint32_t> visits(1000, 0);
    std::uint64_t expected = 0, found = 0;
    for (int step = 0; step < 20; ++step)
      pool.together([&] {
        for (std::uint32_t loop = 0; loop < 300; ++loop) {
          const std::uint32_t n = loop * 7919 % 1001;
          const LoopBody body = loop % 3 == 0 ? LoopBody::kSmall : LoopBody::kLarge;
          pool.each(
              n, [&](std::uint32_t i) { ++visits[i]; }, body);
          expected += n;
        }
      });
    for (const std::uint32_t count : visits) found += count;
    EXPECT_EQ(found, expected) << threads;
  }
}

TEST(ThreadPools, ComeApartWhereAStepThrows) {
  ThreadPool pool(nullptr, 2);
  std::vector<int> visits(1000, 0);
  const auto visit = [&] { pool.each(1000, [&](std::uint32_t i) { ++visits[i]; }); };
  EXPECT_THROW(pool.together([&] {
    visit();
    throw std::runtime_error("no more memory");
  }),
               std::runtime_error);
  visit();
  pool.together(visit);
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 3), 1000);
}

TEST(ThreadPools, RunOnTheHostsJobs) {
  JobHost jobs(5);
  ThreadPool pool(&jobs.host, 5);
  EXPECT_EQ(pool.threads(), 5U);
  visits_all_once(pool);
  EXPECT_GT(jobs.runs, 0U);
  EXPECT_EQ(ThreadPool(&jobs.host, 9).threads(), 5U) << "no more than the host has";
}

TEST(ThreadPools, WorkWithoutTheHostsJobs) {
  PlumbHost host{};
  host.struct_size = sizeof host;
  ThreadPool pool(&host, 2);
  visits_all_once(pool);
}

TEST(FloatingPoint, TheScopePutsTheCallersWordBack) {
  const std::uint64_t before = simd::control_word();
  simd::set_control_word(before | kFlush);
  {
    const FloatingPointScope scope;
    EXPECT_EQ(simd::control_word() & kFlush, 0U);
  }
  EXPECT_EQ(simd::control_word() & kFlush, kFlush);
  simd::set_control_word(before);
}

TEST(FloatingPoint, TasksOfTheHostRunUnderOurRounding) {
  JobHost jobs(3);
  jobs.control_word = simd::control_word() | kFlush;
  ThreadPool pool(&jobs.host, 3);
  std::atomic<std::uint32_t> wrong = 0;
  pool.each(1000, [&](std::uint32_t) { wrong += (simd::control_word() & kFlush) != 0; });
  EXPECT_EQ(wrong, 0U);
}

TEST(Executors, StopAtTheCapacityOfACount) {
  Executor executor(nullptr, 1);
  std::uint32_t number = 10, visits = 0;
  executor.run(Count{&number, 4}, [&](std::uint32_t) { ++visits; });
  EXPECT_EQ(visits, 4U);
  number = 3;
  executor.run(Count{&number, 4}, [&](std::uint32_t) { ++visits; });
  EXPECT_EQ(visits, 7U);
}

}  // namespace
}  // namespace plumb::impulse
