// Threads: worlds are apart, queries run side by side, and more threads give what is promised.
#include <thread>

#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

std::uint64_t tumble(Conformance& c, std::uint32_t threads) {
  Probe probe(c, c.available(kPlainNeeds), {0, -9.81, 0}, {}, threads);
  probe.ground();
  const PlumbShape cube = probe.lump(0.4);
  for (int i = 0; i < 20; ++i) probe.dynamic(cube, {0.3 * (i % 3), 1 + 0.9 * i, 0.2 * (i % 2)});
  probe.step(150);
  return probe.hash();
}

/// Two worlds in two threads end as they do alone.
void worlds_apart(Conformance& c) {
  const std::uint64_t alone = tumble(c, 1);
  std::uint64_t together[2] = {0, 0};
  std::string failures[2];
  std::thread threads[2];
  for (std::size_t i = 0; i < 2; ++i)
    threads[i] = std::thread([&, i] {
      try {
        together[i] = tumble(c, 1);
      } catch (const std::exception& error) {
        failures[i] = error.what();
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < 2; ++i) c.expect(failures[i].empty(), "in thread {}: {}", i, failures[i]);
  if (c.backend().info().determinism == PLUMB_DETERMINISM_NONE) return;
  for (std::size_t i = 0; i < 2; ++i)
    c.expect(together[i] == alone, "a world beside another ends in other bits than alone");
}

void more_threads(Conformance& c) {
  const std::uint64_t one = tumble(c, 1), four = tumble(c, 4);
  if (c.backend().info().determinism >= PLUMB_DETERMINISM_THREADS)
    c.expect(one == four, "four threads end in other bits than one");
}

void queries_together(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_QUERIES;
  c.require_needs(needs);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_RAY, 0, "rays");
  Probe probe(c, needs);
  const PlumbBody floor = probe.ground();
  probe.step();
  bool right[4] = {};
  std::vector<std::thread> threads;
  for (bool& all_right : right)
    threads.emplace_back([&probe, &all_right, floor] {
      all_right = true;
      for (int i = 0; i < 200; ++i) {
        const PlumbRay ray = {{0.1 * i - 10, 5, 0}, {0, -10, 0}, {1, ~0u, 0, 0}};
        const Hits hits = probe.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
        all_right = all_right && hits.result == PLUMB_OK && hits.hits.size() == 1 && hits.hits[0].body == floor;
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const bool all_right : right) c.expect(all_right, "queries from several threads at once go wrong");
}

}  // namespace

std::span<const Check> thread_checks() {
  static constexpr Check checks[] = {
      {"threads.worlds", "two worlds in two threads", &worlds_apart},
      {"threads.more", "a world with more threads", &more_threads},
      {"threads.queries", "queries from several threads at once", &queries_together},
  };
  return checks;
}

}  // namespace plumb::harness::conform
