#include "queries/query_batch.hpp"

#include <limits>

#include "plumb/assert.hpp"
#include "plumb/backend/hit_collector.hpp"
#include "queries/hit_order.hpp"
#include "queries/sweep_search.hpp"
#include "queries/turning_probe.hpp"

namespace plumb::impulse {

namespace {

PLUMB_HD PlumbHit hit_of(const QueryScene& scene, const Target& target, std::uint32_t query, const QueryWay& course,
                         const Meeting& meeting) {
  return {
      scene.ids[target.body],       query, meeting.child, course.fraction(meeting.at), to_plumb_vec3(meeting.position),
      to_plumb_vec3(meeting.normal)};
}
PLUMB_HD PlumbHit no_hit(std::uint32_t query) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return {0, query, 0, kUnknown, {kUnknown, kUnknown, kUnknown}, {kUnknown, kUnknown, kUnknown}};
}

template <class Probe>
PLUMB_HD SweptBox sweep_of(const QueryScene& scene, const Probe& probe) {
  return {probe.start - scene.origin, probe.course.along, probe.course.length, probe.carried(scene)};
}

/// Meets the proxies that a search finds, as far as the query's filter lets it see them.
template <class Probe>
struct Meet {
  const QueryScene& scene;
  const Probe& probe;

  PLUMB_HD bool operator()(std::uint32_t proxy, double most, Meeting& meeting) const {
    return PairFilter::may_touch(probe.filter, scene.filters[proxy]) &&
           probe.meets(scene, scene.targets[proxy], most, meeting);
  }
};

template <class Probe>
struct KeepNearest {
  Meet<Probe> meet;
  SweptBox& sweep;
  std::uint32_t query;
  double most;
  PlumbHit best;

  PLUMB_HD void operator()(std::uint32_t proxy) {
    Meeting meeting{};
    if (!meet(proxy, most, meeting)) return;
    PlumbHit hit = hit_of(meet.scene, meet.scene.targets[proxy], query, meet.probe.course, meeting);
    if (best.body != 0 && !NearerHit{}(hit, best)) return;
    if (meeting.at_start) mark_overlap(proxy, hit);
    best = hit;
    most = meeting.at;
    sweep.last = sweep.place_of(most);
  }
};

template <class Probe>
struct FindClosest {
  QueryScene scene;
  const typename Probe::Row* rows;
  PlumbHit* hits;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const Probe probe(scene, rows[i]);
    SweptBox sweep = sweep_of(scene, probe);
    KeepNearest<Probe> keep{{scene, probe}, sweep, i, probe.course.length, no_hit(i)};
    visit_planes(scene, keep);
    visit_nearest_first(scene.statics, sweep, keep);
    visit_nearest_first(scene.movers, sweep, keep);
    hits[i] = keep.best;
  }
};

template <class Probe>
struct CountMet {
  Meet<Probe> meet;
  std::uint32_t count;
  PLUMB_HD void operator()(std::uint32_t proxy) {
    Meeting meeting{};
    if (meet(proxy, meet.probe.course.length, meeting)) ++count;
  }
};

template <class Probe>
struct CountHits {
  QueryScene scene;
  const typename Probe::Row* rows;
  std::uint32_t* counts;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const Probe probe(scene, rows[i]);
    const SweptBox sweep = sweep_of(scene, probe);
    CountMet<Probe> met{{scene, probe}, 0};
    visit_planes(scene, met);
    visit_all(scene.statics, sweep, met);
    visit_all(scene.movers, sweep, met);
    counts[i] = met.count;
  }
};

template <class Probe>
struct WriteMet {
  Meet<Probe> meet;
  std::uint32_t query;
  bool marks;  ///< hits hold their proxies
  PlumbHit* to;
  PLUMB_HD void operator()(std::uint32_t proxy) {
    Meeting meeting{};
    if (!meet(proxy, meet.probe.course.length, meeting)) return;
    *to = hit_of(meet.scene, meet.scene.targets[proxy], query, meet.probe.course, meeting);
    if (marks || meeting.at_start) mark_overlap(proxy, *to);
    ++to;
  }
};

/// Writes and sorts the hits of a query; counts are then those of bodies.
template <class Probe>
struct ListHits {
  QueryScene scene;
  const typename Probe::Row* rows;
  const std::uint32_t* offsets;
  std::uint32_t* counts;
  PlumbHit* hits;
  bool marks;
  PLUMB_HD void operator()(std::uint32_t i) const {
    if (counts[i] == 0) return;
    const Probe probe(scene, rows[i]);
    const SweptBox sweep = sweep_of(scene, probe);
    PlumbHit* const first = hits + offsets[i];
    WriteMet<Probe> write{{scene, probe}, i, marks, first};
    visit_planes(scene, write);
    visit_all(scene.statics, sweep, write);
    visit_all(scene.movers, sweep, write);
    if (scene.several) {
      sort_hits(first, counts[i], SameBodyHit{});
      counts[i] = keep_first_of_bodies(first, counts[i]);
    }
    sort_hits(first, counts[i], NearerHit{});
  }
};

}  // namespace

void QueryBatch::closest_rays(Executor& executor, const QueryScene& scene, const PlumbRay* rays, std::uint32_t n,
                              PlumbHit* hits) {
  if (has_few_types(scene))
    executor.run(n, FindClosest<RayProbe<Kinds::kFew>>{scene, rays, hits});
  else
    executor.run(n, FindClosest<RayProbe<Kinds::kAll>>{scene, rays, hits});
}

template <class Probe>
std::uint32_t QueryBatch::find_all(Executor& executor, const QueryScene& scene, const typename Probe::Row* rows,
                                   std::uint32_t n, bool marks) {
  PLUMB_ASSERT(n == 0 || rows != nullptr);
  return hits_.find(
      executor, n, scene.several,
      [&](std::uint32_t* counts) {
        executor.run(n, CountHits<Probe>{scene, rows, counts});
      },
      [&](const std::uint32_t* offsets, std::uint32_t* counts, PlumbHit* hits) {
        executor.run(n, ListHits<Probe>{scene, rows, offsets, counts, hits, marks});
      });
}

template <class Probe>
std::uint32_t QueryBatch::find_of(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                  const typename Probe::Row* rows, std::uint32_t n) {
  if (mode == PLUMB_HIT_ALL) return find_all<Probe>(executor, scene, rows, n);
  executor.run(n, FindClosest<Probe>{scene, rows, hits_.room(n)});
  return n;
}

template <template <Kinds> class Probe, class Row>
std::uint32_t QueryBatch::find(Executor& executor, const QueryScene& scene, PlumbHitMode mode, const Row* rows,
                               std::uint32_t n) {
  return has_few_types(scene) ? find_of<Probe<Kinds::kFew>>(executor, scene, mode, rows, n)
                              : find_of<Probe<Kinds::kAll>>(executor, scene, mode, rows, n);
}

std::span<const PlumbHit> QueryBatch::rays(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                           std::span<const PlumbRay> rays) {
  const auto n = static_cast<std::uint32_t>(rays.size());
  return hits_.hand_out(executor, find<RayProbe>(executor, scene, mode, rays_.bring(rays), n));
}

template <template <Kinds> class Probe, class Row>
std::span<const PlumbHit> QueryBatch::find_casts(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                                 const Row* rows, std::uint32_t n) {
  const std::uint32_t count = find<Probe>(executor, scene, mode, rows, n);
  depth_.describe(executor, scene, rows, hits_.device(), count);
  return hits_.hand_out(executor, count);
}

std::span<const PlumbHit> QueryBatch::casts(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                            std::span<const PlumbCast> casts) {
  const auto n = static_cast<std::uint32_t>(casts.size());
  return find_casts<CastProbe>(executor, scene, mode, casts_.bring(casts), n);
}

std::span<const PlumbHit> QueryBatch::turning_casts(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                                    std::span<const PlumbTurningCast> casts) {
  const auto n = static_cast<std::uint32_t>(casts.size());
  return find_casts<TurningProbe>(executor, scene, mode, turning_casts_.bring(casts), n);
}

std::uint32_t QueryBatch::find_overlaps(Executor& executor, const QueryScene& scene, const PlumbOverlap* rows,
                                        std::uint32_t n, bool marks) {
  return has_few_types(scene) ? find_all<OverlapProbe<Kinds::kFew>>(executor, scene, rows, n, marks)
                              : find_all<OverlapProbe<Kinds::kAll>>(executor, scene, rows, n, marks);
}

std::span<const PlumbHit> QueryBatch::overlaps(Executor& executor, const QueryScene& scene,
                                               std::span<const PlumbOverlap> overlaps) {
  const auto n = static_cast<std::uint32_t>(overlaps.size());
  return hits_.hand_out(executor, find_overlaps(executor, scene, overlaps_.bring(overlaps), n, false));
}

std::span<const PlumbPenetration> QueryBatch::penetrations(Executor& executor, const QueryScene& scene,
                                                           std::span<const PlumbOverlap> overlaps) {
  const auto n = static_cast<std::uint32_t>(overlaps.size());
  const PlumbOverlap* rows = overlaps_.bring(overlaps);
  QueryScene pieces = scene;
  pieces.several = false;  // which of a body's pieces is deepest is not known yet
  const std::uint32_t count = find_overlaps(executor, pieces, rows, n, true);
  return backend::deepest_of_bodies(depth_.tell(executor, scene, rows, hits_.device(), count));
}

}  // namespace plumb::impulse
