// Measure of the narrow phase alone: what an engine says of boxes in each other, against closed forms and the referee.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/collision/collision.hpp"
#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "referee/penetration.hpp"
#include "scene/generators.hpp"

namespace plumb::harness {
namespace {

constexpr double shape_side = 1;  // m, that depths are relative to

/// What the engine says of one pair.
struct Answer {
  bool touch = false;
  PlumbPairPoint deepest{};
  std::size_t points = 0;
};

Answer answer_of(const PlumbPairResult& result, std::span<const PlumbPairPoint> points) {
  Answer answer;
  for (const PlumbPairPoint& point : points.subspan(result.first_point, result.point_count)) {
    if (point.depth >= 0) ++answer.points;
    if (answer.touch && point.depth <= answer.deepest.depth) continue;
    answer.deepest = point;
    answer.touch = true;
  }
  answer.touch = answer.touch && answer.deepest.depth > 0;
  return answer;
}

/// One box of the random pairs: sides of 0.4 m to 2 m, turned anyhow (Shoemake 1992).
struct RandomBox {
  PlumbShape handle = 0;
  referee::ShapePtr shape;
};

PlumbPose random_pose(SplitMix64& random, double reach) {
  const double a = random.uniform(), b = random.uniform() * 2 * std::numbers::pi,
               c = random.uniform() * 2 * std::numbers::pi;
  const auto coordinate = [&] { return reach * (2 * random.uniform() - 1); };
  const PlumbVec3 position{coordinate(), coordinate(), coordinate()};
  return {position,
          {std::sqrt(1 - a) * std::sin(b), std::sqrt(1 - a) * std::cos(b), std::sqrt(a) * std::sin(c),
           std::sqrt(a) * std::cos(c)}};
}

void random_pairs(MeasureContext& context, Simulation& simulation, std::size_t count) {
  constexpr std::size_t kinds = 32, batch = 1000;
  constexpr double sure = 1e-5;  // m: closer calls are not scored
  IPhysicsWorld& world = simulation.world();
  SplitMix64 random(9);
  std::vector<RandomBox> boxes(kinds);
  for (RandomBox& box : boxes) {
    PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
    desc.half_extents = {0.2 + 0.8 * random.uniform(), 0.2 + 0.8 * random.uniform(), 0.2 + 0.8 * random.uniform()};
    check(world, world.create_shapes({&desc, 1}, {&box.handle, 1}));
    box.shape = referee::Shape::make(desc);
  }
  double wrong_signs = 0, still_in = 0;
  std::vector<double> depth_errors;
  for (std::size_t done = 0; done < count; done += batch) {
    std::vector<PlumbPosedPair> pairs;
    std::vector<std::pair<std::size_t, std::size_t>> which;
    for (std::size_t i = 0; i < std::min(batch, count - done); ++i) {
      const std::size_t a = random.next() % kinds, b = random.next() % kinds;
      which.emplace_back(a, b);
      const PlumbPose pose_a = random_pose(random, 0.75), pose_b = random_pose(random, 0.75);
      pairs.push_back({boxes[a].handle, boxes[b].handle, pose_a, pose_b});
    }
    std::vector<PlumbPairResult> results(pairs.size());
    std::span<const PlumbPairPoint> points;
    check(world, world.collide()->collide_pairs(pairs, results, points));
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const referee::Shape &a = *boxes[which[i].first].shape, &b = *boxes[which[i].second].shape;
      const referee::Pose pose_a = referee::pose(pairs[i].pose_a), pose_b = referee::pose(pairs[i].pose_b);
      const double depth = referee::penetration(a, pose_a, b, pose_b, referee::Apart::lower_bound).depth;
      const Answer answer = answer_of(results[i], points);
      if (std::abs(depth) > sure && answer.touch != (depth > 0)) ++wrong_signs;
      if (!answer.touch || depth <= 0) continue;
      depth_errors.push_back(std::abs(answer.deepest.depth - depth));
      referee::Pose moved = pose_b;
      moved.position += answer.deepest.depth * referee::vec(answer.deepest.normal);
      still_in = largest(still_in, std::max(0.0, referee::penetration(a, pose_a, b, moved).depth));
    }
  }
  std::sort(depth_errors.begin(), depth_errors.end());
  const std::size_t errors = depth_errors.size();
  context.deviation("depth", errors == 0 ? not_measured : depth_errors.back() / shape_side);
  context.deviation("depth_p99", errors == 0 ? not_measured : depth_errors[(errors - 1) * 99 / 100] / shape_side);
  context.deviation("wrong_signs", wrong_signs);
  context.deviation("still_in", still_in / shape_side);
}

}  // namespace

void measure_static_answers(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::string& which = arg_text(scene, "case");
  Simulation simulation = context.simulate(scene);
  IPhysicsWorld& world = simulation.world();
  if (world.collide() == nullptr) throw Error(PLUMB_E_UNSUPPORTED, "collision without a step");
  if (which == "random") {
    random_pairs(context, simulation, static_cast<std::size_t>(arg_number(scene, "pairs")));
    return;
  }
  const PlumbShapeDesc desc = scene.shapes.front().descriptor();
  PlumbShape shape = 0;
  check(world, world.create_shapes({&desc, 1}, {&shape, 1}));
  const PlumbPosedPair pair{shape, shape, scene.bodies[0].desc.pose, scene.bodies[1].desc.pose};
  PlumbPairResult result{};
  std::span<const PlumbPairPoint> points;
  check(world, world.collide()->collide_pairs({&pair, 1}, {&result, 1}, points));
  const Answer answer = answer_of(result, points);
  const double depth = arg_number(scene, "depth");
  context.compare("depth", answer.touch ? answer.deepest.depth : not_measured, depth, shape_side);
  if (which == "parallel") return;
  const double up = answer.touch ? answer.deepest.normal.y : not_measured;
  const referee::Vec3 normal = referee::vec(answer.deepest.normal);
  context.deviation("normal", answer.touch ? std::atan2(std::hypot(normal.x(), normal.z()), up) * degrees : up);
  if (which == "faces") {
    context.deviation("few_points", std::max(0.0, 4 - static_cast<double>(answer.points)));
    return;
  }
  const referee::Vec3 expected(0, arg_number(scene, "height"), 0);
  const double off = (referee::vec(answer.deepest.position) - expected).norm();
  context.deviation("point", answer.touch ? off : not_measured);
}

}  // namespace plumb::harness
