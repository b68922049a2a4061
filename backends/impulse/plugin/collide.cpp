// plumb.collide/1: pairs of shapes that need no bodies, by the pair functions of the step.
#include <string>

#include "exec/floating_point.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

PosedPair to_posed_pair(const Table<Shape>& shapes, const PlumbPosedPair& pair) {
  return {shapes[slot_of(pair.shape_a)],
          shapes[slot_of(pair.shape_b)],
          to_position(pair.pose_a.position),
          to_position(pair.pose_b.position),
          normalized(to_double(pair.pose_a.orientation)),
          normalized(to_double(pair.pose_b.orientation))};
}

PlumbPairResult add_points(const PlumbPosedPair& pair, const PairAnswer& answer, std::vector<PlumbPairPoint>& points) {
  const auto first = static_cast<std::uint32_t>(points.size());
  const Manifold& manifold = answer.manifold;
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& point = manifold.points[i];
    const Position at = moved(to_position(pair.pose_a.position), point.position);
    points.push_back({{at.x, at.y, at.z},
                      to_plumb(manifold.normal),
                      -static_cast<double>(point.separation),
                      point.feature + std::uint64_t{1}});
  }
  return {answer.distance, first, manifold.count};
}

}  // namespace

PlumbResult World::collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                                 std::span<const PlumbPairPoint>& points) {
  const FloatingPointScope scope;
  const auto require_convex = [this](PlumbShape id, std::size_t i, const char* which) {
    const std::uint32_t slot = slot_of(id);
    const bool has_parts = slot < compounds_.size() && !compounds_[slot].empty();
    if (has_parts || static_cast<std::uint32_t>(simulation_.shapes[slot].type) >= kConvexTypes)
      throw Error(PLUMB_E_UNSUPPORTED, "pairs[" + std::to_string(i) + "]." + which +
                                           " is no single convex shape; ask for the children of a compound one by one");
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    require_convex(pairs[i].shape_a, i, "shape_a");
    require_convex(pairs[i].shape_b, i, "shape_b");
  }
  std::unique_lock lock(query_mutex_);
  const QueryScene scene = simulation_.shape_scene();
  PairBatch& batch = pair_batches_.take();
  if (kOneMemory) lock.unlock();

  Executor& executor = simulation_.executor();
  const auto n = static_cast<std::uint32_t>(pairs.size());
  batch.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) batch.pairs[i] = to_posed_pair(simulation_.shapes, pairs[i]);
  executor.to_device(batch.pairs, n);
  answer_pairs(executor, batch.pairs.device(), n, scene.hulls, batch.answers.device());
  executor.to_host(batch.answers, n);
  executor.wait();
  batch.points.clear();
  for (std::uint32_t i = 0; i < n; ++i) results[i] = add_points(pairs[i], batch.answers[i], batch.points);
  points = batch.points;
  return PLUMB_OK;
}

}  // namespace plumb::impulse
