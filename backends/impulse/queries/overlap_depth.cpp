#include "queries/overlap_depth.hpp"

#include "queries/probes.hpp"

namespace plumb::impulse {

namespace {

struct FindMarked {
  const PlumbHit* hits;
  std::uint32_t* marked;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const PlumbHit& hit = hits[i];
    marked[i] = hit.body != 0 && hit.fraction == 0 && hit.position.y != hit.position.y ? 1 : 0;
  }
};

PLUMB_HD const Target& target_of(const QueryScene& scene, const PlumbHit& marked) {
  return scene.targets[static_cast<std::uint32_t>(marked.position.x)];
}
PLUMB_HD std::uint32_t child_of(const PlumbHit& marked, const Target& target, const PairAnswer& answer) {
  return is_surface(target.shape.type) ? child_at(target, answer.triangle) : marked.child;
}

/// query: a cast or an overlap.
template <class Query>
PLUMB_HD PosedPair pair_of(const QueryScene& scene, const PlumbHit& marked, const Query& query) {
  const Target& target = target_of(scene, marked);
  return {target.shape, scene.shapes[row_of(query.shape)], target.place, to_vec64(query.pose.position),
          target.turn,  to_quat64(query.pose.orientation)};
}

template <class Cast>
struct MakePairs {
  QueryScene scene;
  const Cast* casts;
  const PlumbHit* hits;
  const std::uint32_t *marked, *rows;
  PosedPair* pairs;
  PLUMB_HD void operator()(std::uint32_t i) const {
    if (marked[i] != 0) pairs[rows[i]] = pair_of(scene, hits[i], casts[hits[i].query]);
  }
};

struct Describe {
  QueryScene scene;
  const std::uint32_t *marked, *rows;
  const PosedPair* pairs;
  const PairAnswer* answers;
  PlumbHit* hits;
  PLUMB_HD void operator()(std::uint32_t i) const {
    if (marked[i] == 0) return;
    const PairAnswer& answer = answers[rows[i]];
    hits[i].child = child_of(hits[i], target_of(scene, hits[i]), answer);
    hits[i].position = to_plumb_vec3(pairs[rows[i]].place_a + answer.at);
    hits[i].normal = to_plumb_vec3(answer.normal);
  }
};

struct PairOverlaps {
  QueryScene scene;
  const PlumbOverlap* overlaps;
  const PlumbHit* hits;
  PosedPair* pairs;
  PLUMB_HD void operator()(std::uint32_t i) const { pairs[i] = pair_of(scene, hits[i], overlaps[hits[i].query]); }
};

struct Tell {
  QueryScene scene;
  const PosedPair* pairs;
  const PairAnswer* answers;
  const PlumbHit* hits;
  PlumbPenetration* told;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const PlumbHit& hit = hits[i];
    told[i] = {hit.body,
               hit.query,
               child_of(hit, target_of(scene, hit), answers[i]),
               max(-answers[i].distance, 0.0),
               to_plumb_vec3(pairs[i].place_a + answers[i].at),
               to_plumb_vec3(answers[i].normal)};
  }
};

}  // namespace

template <class Cast>
void OverlapDepth::describe(Executor& executor, const QueryScene& scene, const Cast* casts, PlumbHit* hits,
                            std::uint32_t n) {
  if (n == 0) return;
  marked_.grow(n);
  rows_.grow(n);
  total_.grow(1);
  scan_.reserve(n);
  executor.run(n, FindMarked{hits, marked_.data()});
  scan_.run(executor, n, marked_.data(), rows_.data(), total_.data());
  executor.wait();
  const std::uint32_t count = total_.to_host(1)[0];
  if (count == 0) return;
  pairs_.grow(count);
  answers_.grow(count);
  executor.run(n, MakePairs<Cast>{scene, casts, hits, marked_.data(), rows_.data(), pairs_.data()});
  answer_pairs(executor, pairs_.data(), count, scene, (scene.types & kMidphaseTypes) != 0, answers_.data());
  executor.run(n, Describe{scene, marked_.data(), rows_.data(), pairs_.data(), answers_.data(), hits});
}

template void OverlapDepth::describe(Executor&, const QueryScene&, const PlumbCast*, PlumbHit*, std::uint32_t);
template void OverlapDepth::describe(Executor&, const QueryScene&, const PlumbTurningCast*, PlumbHit*, std::uint32_t);

std::span<PlumbPenetration> OverlapDepth::tell(Executor& executor, const QueryScene& scene,
                                               const PlumbOverlap* overlaps, const PlumbHit* hits, std::uint32_t n) {
  if (n == 0) return {};
  pairs_.grow(n);
  answers_.grow(n);
  told_.grow(n);
  executor.run(n, PairOverlaps{scene, overlaps, hits, pairs_.data()});
  answer_pairs(executor, pairs_.data(), n, scene, (scene.types & kMidphaseTypes) != 0, answers_.data());
  executor.run(n, Tell{scene, pairs_.data(), answers_.data(), hits, told_.device()});
  executor.to_host(told_, n);
  executor.wait();
  return {told_.host(), n};
}

}  // namespace plumb::impulse
