#include "queries/closest_batch.hpp"

#include "queries/closest_probe.hpp"
#include "queries/hit_order.hpp"

namespace plumb::impulse {

namespace {

/// The order in which rows of a probe are handed out.
struct NearerRow {
  PLUMB_HD bool operator()(const PlumbClosest& a, const PlumbClosest& b) const {
    if (a.distance != b.distance) return a.distance < b.distance;
    if (a.body != b.body) return row_of(a.body) < row_of(b.body);
    return a.child < b.child;
  }
};
/// The rows of a body side by side, its nearest first.
struct SameBodyRow {
  PLUMB_HD bool operator()(const PlumbClosest& a, const PlumbClosest& b) const {
    return a.body != b.body ? row_of(a.body) < row_of(b.body) : NearerRow{}(a, b);
  }
};

/// Looks at the proxies that a search finds, as far as the probe's filter lets it see them.
template <class Probe>
struct Look {
  const QueryScene& scene;
  const Probe& probe;

  PLUMB_HD bool operator()(std::uint32_t proxy, double enough, PlumbClosest& row) const {
    return PairFilter::may_touch(probe.filter, scene.filters[proxy]) &&
           probe.finds(scene, scene.targets[proxy], enough, row);
  }
};

template <class Probe>
struct KeepClosest {
  Look<Probe> look;
  BoxAround& around;
  PlumbClosest best;
  double most;

  PLUMB_HD void operator()(std::uint32_t proxy) {
    PlumbClosest row = best;
    if (!look(proxy, most, row) || (best.body != 0 && !NearerRow{}(row, best))) return;
    best = row;
    most = row.distance;
    around.last = around.place_of(most);
  }
};

template <class Probe>
struct FindClosestBody {
  QueryScene scene;
  const PlumbProbe* probes;
  PlumbClosest* rows;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const Probe probe(scene, probes[i]);
    BoxAround around = probe.around(scene);
    KeepClosest<Probe> keep{
        {scene, probe}, around, {0, i, 0, nowhere().x, nowhere(), nowhere(), nowhere()}, probe.most};
    visit_planes(scene, keep);
    visit_nearest_first(scene.statics, around, keep);
    visit_nearest_first(scene.movers, around, keep);
    rows[i] = keep.best;
  }
};

template <class Probe>
struct CountNear {
  Look<Probe> look;
  std::uint32_t count;
  PLUMB_HD void operator()(std::uint32_t proxy) {
    PlumbClosest row;
    if (look(proxy, look.probe.most, row)) ++count;
  }
};

template <class Probe>
struct CountBodiesNear {
  QueryScene scene;
  const PlumbProbe* probes;
  std::uint32_t* counts;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const Probe probe(scene, probes[i]);
    const BoxAround around = probe.around(scene);
    CountNear<Probe> near{{scene, probe}, 0};
    visit_planes(scene, near);
    visit_all(scene.statics, around, near);
    visit_all(scene.movers, around, near);
    counts[i] = near.count;
  }
};

template <class Probe>
struct WriteNear {
  Look<Probe> look;
  std::uint32_t number;
  PlumbClosest* to;
  PLUMB_HD void operator()(std::uint32_t proxy) {
    PlumbClosest row;
    if (!look(proxy, look.probe.most, row)) return;
    row.probe = number;
    *to++ = row;
  }
};

/// Writes and sorts the rows of a probe; counts are then those of bodies.
template <class Probe>
struct ListBodiesNear {
  QueryScene scene;
  const PlumbProbe* probes;
  const std::uint32_t* offsets;
  std::uint32_t* counts;
  PlumbClosest* rows;
  PLUMB_HD void operator()(std::uint32_t i) const {
    if (counts[i] == 0) return;
    const Probe probe(scene, probes[i]);
    const BoxAround around = probe.around(scene);
    PlumbClosest* const first = rows + offsets[i];
    WriteNear<Probe> write{{scene, probe}, i, first};
    visit_planes(scene, write);
    visit_all(scene.statics, around, write);
    visit_all(scene.movers, around, write);
    if (scene.several) {
      sort_hits(first, counts[i], SameBodyRow{});
      counts[i] = keep_first_of_bodies(first, counts[i]);
    }
    sort_hits(first, counts[i], NearerRow{});
  }
};

}  // namespace

template <class Probe>
std::uint32_t ClosestBatch::find_of(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                    const PlumbProbe* probes, std::uint32_t n) {
  if (mode == PLUMB_HIT_CLOSEST) {
    executor.run(n, FindClosestBody<Probe>{scene, probes, rows_.room(n)});
    return n;
  }
  return rows_.find(
      executor, n, scene.several,
      [&](std::uint32_t* counts) {
        executor.run(n, CountBodiesNear<Probe>{scene, probes, counts});
      },
      [&](const std::uint32_t* offsets, std::uint32_t* counts, PlumbClosest* rows) {
        executor.run(n, ListBodiesNear<Probe>{scene, probes, offsets, counts, rows});
      });
}

std::span<const PlumbClosest> ClosestBatch::find(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                                 std::span<const PlumbProbe> probes) {
  const auto n = static_cast<std::uint32_t>(probes.size());
  const PlumbProbe* rows = probes_.bring(probes);
  return rows_.hand_out(executor, has_few_types(scene)
                                      ? find_of<ClosestProbe<Kinds::kFew>>(executor, scene, mode, rows, n)
                                      : find_of<ClosestProbe<Kinds::kAll>>(executor, scene, mode, rows, n));
}

}  // namespace plumb::impulse
