// Threads: worlds are apart, queries run side by side, and more threads give what is promised.
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

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

/// What each of several threads says that do the same at once.
std::vector<std::uint64_t> in_threads(Conformance& c, std::size_t count, const std::function<std::uint64_t()>& act) {
  std::vector<std::uint64_t> said(count);
  std::vector<std::string> failures(count);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i)
    threads.emplace_back([&, i] {
      try {
        said[i] = act();
      } catch (const std::exception& error) {
        failures[i] = error.what();
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < count; ++i) c.expect(failures[i].empty(), "in thread {}: {}", i, failures[i]);
  return said;
}

/// Two worlds in two threads end as they do alone.
void worlds_apart(Conformance& c) {
  const std::uint64_t alone = tumble(c, 1);
  const std::vector<std::uint64_t> together = in_threads(c, 2, [&] { return tumble(c, 1); });
  if (c.backend().info().determinism == PLUMB_DETERMINISM_NONE) return;
  for (const std::uint64_t hash : together)
    c.expect(hash == alone, "a world beside another ends in other bits than alone");
}

/// Makes small worlds, steps each a few times and lets it go; the sum of how they ended.
std::uint64_t come_and_go(Conformance& c) {
  std::uint64_t ends = 0;
  for (int i = 0; i < 40; ++i) {
    Probe probe(c, c.available(kPlainNeeds));
    probe.ground();
    const PlumbShape cube = probe.lump(0.4);
    for (int k = 0; k < 4; ++k) probe.dynamic(cube, {0.03 * i * k, 0.5 + 0.9 * k, 0});
    probe.step(4);
    ends += probe.hash();
  }
  return ends;
}

/// What an engine keeps for all worlds of a process is touched as worlds come and go.
void worlds_come_and_go(Conformance& c) {
  const std::uint64_t alone = come_and_go(c);
  const std::vector<std::uint64_t> together = in_threads(c, 4, [&] { return come_and_go(c); });
  if (c.backend().info().determinism == PLUMB_DETERMINISM_NONE) return;
  for (const std::uint64_t hash : together)
    c.expect(hash == alone, "worlds that come and go beside others end in other bits than alone");
}

/// Rows of all worlds of a group, as each world reads its own.
void expect_rows_of_all(Conformance& c, const std::vector<std::unique_ptr<Probe>>& grouped) {
  IPhysicsWorld& first = grouped[0]->world();
  const PlumbStateRequest request = {sizeof request, PLUMB_FIELD_POSE, 1, 1};
  PlumbDLManagedTensor* lent = nullptr;
  check(first, first.worlds()->borrow_all(request, lent, nullptr));
  const PlumbDLTensor& rows = lent->dl_tensor;
  const auto count = static_cast<std::int64_t>(grouped.size());
  c.expect(rows.ndim == 3 && rows.shape[0] == count && rows.shape[2] == 7, "the rows of {} worlds have another shape",
           count);
  const auto number = [&](std::size_t world, std::size_t row, std::size_t column) {
    const auto place = static_cast<std::int64_t>(world) * rows.strides[0] +
                       static_cast<std::int64_t>(row) * rows.strides[1] +
                       static_cast<std::int64_t>(column) * rows.strides[2];
    const auto* bytes = static_cast<const std::byte*>(rows.data) + rows.byte_offset;
    return rows.dtype.bits == 64 ? reinterpret_cast<const double*>(bytes)[place]
                                 : static_cast<double>(reinterpret_cast<const float*>(bytes)[place]);
  };
  for (std::size_t world = 0; world < grouped.size(); ++world) {
    std::span<const PlumbBody> ids;
    std::uint64_t generation = 0;
    check(grouped[world]->world(), grouped[world]->world().state()->row_map(ids, generation));
    for (std::size_t row = 0; row < ids.size(); ++row) {
      if (ids[row] == 0) continue;
      const std::vector<double> own = grouped[world]->read(PLUMB_FIELD_POSE, ids[row]);
      for (std::size_t k = 0; k < own.size(); ++k)
        c.expect(std::abs(number(world, row, k) - own[k]) < 1e-5, "row {} of world {} of a group is another", row,
                 world);
    }
  }
  lent->deleter(lent);
}

/// Worlds of one group: stepped together, one left out at times, one that goes, and the rest by itself again.
void worlds_grouped(Conformance& c) {
  std::vector<std::unique_ptr<Probe>> alone, grouped;
  for (int i = 0; i < 4; ++i)
    for (auto* of : {&alone, &grouped}) {
      of->push_back(std::make_unique<Probe>(c, c.available(kPlainNeeds)));
      Probe& probe = *of->back();
      probe.ground();
      const PlumbShape cube = probe.lump(0.4);
      for (int k = 0; k < 6; ++k) probe.dynamic(cube, {0.05 * i * k, 0.5 + 0.9 * k, 0.1 * (k % 2)});
    }
  IPhysicsWorld& first = grouped[0]->world();
  if (first.worlds() == nullptr) throw Skipped{"no plumb.worlds/1"};
  const auto others = [&] {
    std::vector<IPhysicsWorld*> worlds;
    for (std::size_t i = 1; i < grouped.size(); ++i) worlds.push_back(&grouped[i]->world());
    return worlds;
  };
  check(first, first.worlds()->group(others()));
  for (int step = 0; step < 120; ++step) {
    const auto takes_part = [&](std::size_t i) { return i != 2 || step % 3 != 0; };
    for (std::size_t i = 0; i < grouped.size(); ++i)
      if (takes_part(i)) check(grouped[i]->world(), grouped[i]->world().step(1.0 / 60));
    for (std::size_t i = 0; i < grouped.size(); ++i) {
      if (!takes_part(i)) continue;
      PlumbStepReport report;
      check(grouped[i]->world(), grouped[i]->world().wait(report));
      alone[i]->step();
    }
    if (step == 40) {
      grouped.pop_back();
      alone.pop_back();
      check(first, first.worlds()->group(others()));
    }
    if (step == 60) expect_rows_of_all(c, grouped);
    if (step == 30) expect_rows_of_all(c, grouped);
    if (step == 80) check(first, first.worlds()->group({}));
  }
  if (c.backend().info().determinism == PLUMB_DETERMINISM_NONE) return;
  for (std::size_t i = 0; i < grouped.size(); ++i)
    c.expect(grouped[i]->hash() == alone[i]->hash(), "world {} of a group ends in other bits than alone", i);
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
      {"threads.come_and_go", "worlds made and let go in four threads", &worlds_come_and_go},
      {"threads.group", "worlds whose steps are taken together", &worlds_grouped},
      {"threads.more", "a world with more threads", &more_threads},
      {"threads.queries", "queries from several threads at once", &queries_together},
  };
  return checks;
}

}  // namespace plumb::harness::conform
