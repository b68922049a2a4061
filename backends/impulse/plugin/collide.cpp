// plumb.collide/1: pairs of shapes that need no bodies, by the pair functions of the step. Compounds are taken apart,
// and each of their children is held against all of the other shape.
#include "plugin/world.hpp"

namespace plumb::impulse {

namespace {

/// Part k of a pair touches with a triangle, or with 0; different places have different features, the first of the
/// only part those of the step.
std::uint64_t feature_of(std::uint32_t feature, std::size_t k, std::uint32_t triangle) {
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15U;  // an odd factor keeps different numbers different
  const std::uint64_t mixed = feature + std::uint64_t{1} + kOdd * (std::uint64_t{k} << 32 | triangle);
  return mixed != 0 ? mixed : 1;
}

void add_points(const PosedPair& pair, const Manifold& manifold, std::size_t k, std::uint32_t triangle,
                std::vector<PlumbPairPoint>& points) {
  for (std::uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& point = manifold.points[i];
    const Position at = moved(pair.place_a, point.position);
    points.push_back({{at.x, at.y, at.z},
                      to_plumb(manifold.normal),
                      -static_cast<double>(point.separation),
                      feature_of(point.feature, k, triangle)});
  }
}

}  // namespace

/// A shape at a pose, or the children that it consists of.
void World::pose_parts(PlumbShape id, const PlumbPose& pose, std::vector<PosedShape>& parts) const {
  const std::uint32_t row = slot_of(id);
  const Position at = to_position(pose.position);
  const QuatD turn = normalized(to_double(pose.orientation));
  parts.clear();
  if (row >= compounds_.size() || compounds_[row].empty()) {
    parts.push_back({simulation_.colliders.shapes[row], at, turn});
    return;
  }
  for (const CompoundPart& part : compounds_[row])
    parts.push_back({simulation_.colliders.shapes[part.shape], at + rotate(turn, to_position(part.pose.position)),
                     normalized(turn * to_double(part.pose.orientation))});
}

PlumbResult World::collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                                 std::span<const PlumbPairPoint>& points) {
  std::vector<PosedPair> posed;
  std::vector<PosedShape> parts_a, parts_b;
  std::vector<std::uint32_t> first(1, 0U);
  bool pieces = false;
  for (const PlumbPosedPair& pair : pairs) {
    pose_parts(pair.shape_a, pair.pose_a, parts_a);
    pose_parts(pair.shape_b, pair.pose_b, parts_b);
    for (const PosedShape& a : parts_a)
      for (const PosedShape& b : parts_b) {
        posed.push_back({a.shape, b.shape, a.place, b.place, a.turn, b.turn});
        pieces = pieces || uses_midphase(posed.back());
      }
    first.push_back(static_cast<std::uint32_t>(posed.size()));
  }

  std::unique_lock lock(queries_.mutex);
  const QueryScene scene = simulation_.shape_scene();
  PairBatch& batch = queries_.pair_batches.take();
  if (kOneMemory) lock.unlock();

  Executor& executor = simulation_.executor();
  const auto n = static_cast<std::uint32_t>(posed.size());
  batch.reserve(n);
  std::copy(posed.begin(), posed.end(), batch.pairs.host());
  executor.to_device(batch.pairs, n);
  answer_pairs(executor, batch.pairs.device(), n, scene, pieces, batch.answers.device());
  executor.to_host(batch.answers, n);
  executor.wait();
  if (pieces) batch.touches.find(executor, batch.pairs.device(), batch.answers.device(), n, scene);

  batch.points.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto first_point = static_cast<std::uint32_t>(batch.points.size());
    double distance = batch.answers[first[i]].distance;
    for (std::uint32_t p = first[i]; p < first[i + 1]; ++p) {
      distance = std::min(distance, batch.answers[p].distance);
      if (batch.answers[p].touches == 0) {
        add_points(posed[p], batch.answers[p].manifold, p - first[i], batch.answers[p].triangle, batch.points);
        continue;
      }
      for (std::uint32_t t = batch.touches.offsets()[p]; t < batch.touches.offsets()[p + 1]; ++t)
        add_points(posed[p], batch.touches.rows()[t].manifold, p - first[i], batch.touches.rows()[t].triangle,
                   batch.points);
    }
    results[i] = {distance, first_point, static_cast<std::uint32_t>(batch.points.size()) - first_point};
  }
  points = batch.points;
  return PLUMB_OK;
}

}  // namespace plumb::impulse
