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

struct MakePairs {
  QueryScene scene;
  const PlumbCast* casts;
  const PlumbHit* hits;
  const std::uint32_t *marked, *rows;
  PosedPair* pairs;
  PLUMB_HD void operator()(std::uint32_t i) const {
    if (marked[i] == 0) return;
    const Target& target = scene.targets[static_cast<std::uint32_t>(hits[i].position.x)];
    const PlumbCast& cast = casts[hits[i].query];
    pairs[rows[i]] = {target.shape, scene.shapes[row_of(cast.shape)], target.place, to_vec64(cast.pose.position),
                      target.turn,  to_quat64(cast.pose.orientation)};
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
    const Target& target = scene.targets[static_cast<std::uint32_t>(hits[i].position.x)];
    if (is_surface(target.shape.type)) hits[i].child = child_at(target, answer.triangle);
    hits[i].position = to_plumb_vec3(pairs[rows[i]].place_a + answer.at);
    hits[i].normal = to_plumb_vec3(answer.normal);
  }
};

}  // namespace

void OverlapDepth::describe(Executor& executor, const QueryScene& scene, const PlumbCast* casts, PlumbHit* hits,
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
  executor.run(n, MakePairs{scene, casts, hits, marked_.data(), rows_.data(), pairs_.data()});
  answer_pairs(executor, pairs_.data(), count, scene, (scene.types & kMidphaseTypes) != 0, answers_.data());
  executor.run(n, Describe{scene, marked_.data(), rows_.data(), pairs_.data(), answers_.data(), hits});
}

}  // namespace plumb::impulse
