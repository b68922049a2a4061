// Queries against every shape that can stand still, one at a time: rays, casts and overlaps held against the referee's
// distances.
#include <cmath>
#include <random>

#include "conform/queries/query_target.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

constexpr double kNear = 0.05;

/// By sphere tracing (Hart 1996, "Sphere tracing"): no step is longer than the way to the nearest surface. outside: m
/// that the surface is moved outwards.
struct Traced {
  bool hits, grazes;
  double fraction;
};
Traced trace(const Target& target, const Vec& origin, const Vec& translation, double outside = 0) {
  const double length = translation.norm();
  double along = 0, least = 1e9;
  for (int i = 0; i < 2000 && along <= length; ++i) {
    const double distance = target.distance(origin + along / length * translation) - outside;
    if (distance < 1e-7) return {true, false, along / length};
    least = std::min(least, distance);
    along += distance;
  }
  return {false, least < 2e-3, 1};
}

void rays_at(Conformance& c, PlumbShapeType type) {
  Target target(c, type);
  const bool exact = c.is_exact(PLUMB_CAP_SHAPE, type, PLUMB_STATIC);  // else its surface may be a little inside
  const double inside = exact ? 0 : 0.02, along = exact ? 0.99 : 0.97;
  const char* name = backend::shape_name(type);
  std::mt19937 random(21);
  std::vector<PlumbRay> rays;
  while (rays.size() < 150) {
    const Vec origin = target.place_about(random, 5), aim = target.place_about(random, 1.5);
    if (target.is_outside(origin)) rays.push_back({vec3(origin), vec3(2 * (aim - origin)), kSeesAll});
  }
  const Hits closest = target.probe.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, rays);
  const std::vector<PlumbHit> hits(closest.hits.begin(), closest.hits.end());
  const Hits all = target.probe.world().queries()->cast_rays(PLUMB_HIT_ALL, rays);
  c.expect(hits.size() == rays.size(), "{} closest hits for {} rays", hits.size(), rays.size());
  int wrong = 0, found = 0, bent = 0, elsewhere = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Vec origin = vec(rays[i].origin), translation = vec(rays[i].translation);
    const Traced truth = trace(target, origin, translation);
    if (truth.grazes) continue;
    const PlumbHit& hit = hits[i];
    const auto listed =
        std::count_if(all.hits.begin(), all.hits.end(), [&](const PlumbHit& h) { return h.query == i; });
    if (!exact && truth.hits && !trace(target, origin, translation, -inside).hits) continue;
    const bool right = (hit.body == target.body) == truth.hits && listed == (truth.hits ? 1 : 0) &&
                       (!truth.hits || std::abs(hit.fraction - truth.fraction) < 2e-3 ||
                        (hit.fraction > truth.fraction && target.distance(vec(hit.position)) > -inside));
    if (!right) ++wrong;
    if (!right || !truth.hits) continue;
    ++found;
    const Vec normal = vec(hit.normal),
              before = origin + (truth.fraction * translation - 1e-3 * translation.normalized());
    c.expect(std::abs(normal.norm() - 1) < 1e-3, "ray at a {}: the normal's length is {:.4f}", name, normal.norm());
    if (normal.dot(translation) > 0 || normal.dot(target.normal_at(before)) < along) ++bent;
    if (target.has_triangles() && target.distance_to_triangle(hit.child, vec(hit.position)) > 5e-3) ++elsewhere;
  }
  c.expect(wrong <= 3, "{} of {} rays at a {} differ from the referee", wrong, rays.size(), name);
  c.expect(found > 30, "only {} rays hit the {}", found, name);
  c.expect(bent <= found / 6, "{} of {} normals of a {} are not those of its surface", bent, found, name);
  c.expect(elsewhere == 0, "{} of {} hits are not on the triangle that they tell", elsewhere, found);
}

/// A shape that is thrown about a target.
struct Mover {
  referee::ShapePtr known;
  PlumbShape shape;
  std::mt19937 random{33};

  Mover(Target& target, PlumbShapeType type)
      : known(referee::Shape::make(convex_desc(type))), shape(target.probe.shape(convex_desc(type))) {}
  PlumbPose pose_about(const Target& target, double spread) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
    return {vec3(target.place_about(random, spread)), {q.x(), q.y(), q.z(), q.w()}};
  }
};

/// Nearer than kNear engines may go either way. What is deep in a surface touches it with parts of which engines that
/// look for contacts may find none.
bool is_telling(const Target& target, double distance) {
  return std::abs(distance) > kNear && (!target.is_surface() || distance > -3 * kNear);
}

void overlaps_with(Conformance& c, PlumbShapeType type, PlumbShapeType with, int forgiven) {
  Target target(c, with);
  Mover mover(target, type);
  std::vector<PlumbOverlap> batch;
  while (batch.size() < 120) {
    const PlumbPose pose = mover.pose_about(target, batch.size() % 3 == 0 ? 2 : 1.2);
    if (target.is_fit(vec(pose.position))) batch.push_back({mover.shape, pose, kSeesAll});
  }
  const Hits hits = target.probe.world().queries()->overlap_shapes(batch);
  int overlapping = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const double distance = target.distance(*mover.known, referee::pose(batch[i].pose));
    if (!is_telling(target, distance)) continue;
    overlapping += distance < 0 ? 1 : 0;
    const bool found = std::any_of(hits.hits.begin(), hits.hits.end(), [&](const PlumbHit& h) { return h.query == i; });
    if (found != (distance < 0) && forgiven-- > 0) continue;
    c.expect(found == (distance < 0), "a {} and a {} that are {:.4f} m apart {} found", backend::shape_name(type),
             backend::shape_name(with), distance, found ? "are" : "are not");
  }
  c.expect(overlapping > 5, "only {} overlaps of a {} and a {}", overlapping, backend::shape_name(type),
           backend::shape_name(with));
}

/// Until its end a cast overlaps nothing, and there it touches.
void casts_at(Conformance& c, PlumbShapeType type, PlumbShapeType at, int forgiven) {
  Target target(c, at);
  Mover mover(target, type);
  std::vector<PlumbCast> batch, from_within;
  while (batch.size() < 80 || from_within.size() < 5) {
    const PlumbPose pose = mover.pose_about(target, batch.size() < 80 ? 4 : 1.5);
    const Vec from = vec(pose.position);
    if (!target.is_before(from)) continue;
    const Vec to = target.place_about(mover.random, 1.5);
    const double distance = target.distance(*mover.known, referee::pose(pose));
    const PlumbCast cast = {mover.shape, pose, vec3(2 * (to - from)), kSeesAll};
    if (distance > 0.01 && batch.size() < 80) batch.push_back(cast);
    if (distance < -kNear) from_within.push_back(cast);
  }
  const Hits hits = target.probe.world().queries()->cast_shapes(PLUMB_HIT_CLOSEST, batch);
  int wrong = 0, found = 0;
  for (std::size_t i = 0; i < hits.hits.size(); ++i) {
    const PlumbHit& hit = hits.hits[i];
    const double end = hit.body == 0 ? 1 : hit.fraction;
    const auto distance = [&](double fraction) {
      PlumbPose pose = batch[i].pose;
      pose.position = vec3(vec(pose.position) + fraction * vec(batch[i].translation));
      return target.distance(*mover.known, referee::pose(pose));
    };
    double least = 1e9;
    for (int k = 0; k < 20; ++k) least = std::min(least, distance(end * k / 20));
    bool right = least > -kNear;
    if (hit.body != 0) {
      ++found;
      const double before = std::max(end - 2e-3 / vec(batch[i].translation).norm(), 0.0);
      right = right && std::abs(distance(before)) < kNear && vec(hit.normal).dot(vec(batch[i].translation)) < 0;
    }
    if (!right) ++wrong;
  }
  const char *name = backend::shape_name(type), *what = backend::shape_name(at);
  c.expect(wrong <= forgiven, "{} of {} casts of a {} at a {} end too late or too early", wrong, batch.size(), name,
           what);
  c.expect(found > 20, "only {} casts of a {} hit the {}", found, name, what);
  const Hits at_start = target.probe.world().queries()->cast_shapes(PLUMB_HIT_CLOSEST, from_within);
  for (const PlumbHit& hit : at_start.hits)
    c.expect(hit.body != 0 && hit.fraction == 0, "a {} that overlaps a {} at the start hits at fraction {:.4f}", name,
             what, hit.fraction);
}

/// Collision without a step, in both orders. Engines that look for contacts miss a few.
void pairs_with(Conformance& c, PlumbShapeType type, PlumbShapeType with, int forgiven) {
  Target target(c, with);
  Mover mover(target, type);
  int overlapping = 0, compared = 0, wrong_sign = 0, wrong_distance = 0;
  double told = 0, truth = 0;
  for (int i = 0; i < 100; ++i) {
    const PlumbPose pose = mover.pose_about(target, i % 3 == 0 ? 2 : 1.2);
    if (!target.is_fit(vec(pose.position))) continue;
    const double distance = target.distance(*mover.known, referee::pose(pose));
    if (!is_telling(target, distance)) continue;
    PlumbPosedPair pair = {mover.shape, target.shape, pose, target.pose};
    if (i % 2 == 1) pair = {target.shape, mover.shape, target.pose, pose};
    PlumbPairResult result{};
    std::span<const PlumbPairPoint> points;
    check(target.probe.world(), target.probe.world().collide()->collide_pairs({&pair, 1}, {&result, 1}, points));
    ++compared;
    overlapping += distance < 0 ? 1 : 0;
    double deepest = -1;
    for (const PlumbPairPoint& point : points) deepest = std::max(deepest, point.depth);
    if ((deepest > 0) != (distance < 0)) ++wrong_sign;
    if (distance > 0 && !std::isnan(result.distance) && std::abs(result.distance - distance) > 2 * kNear) {
      ++wrong_distance;
      told = result.distance;
      truth = distance;
    }
  }
  const char *name = backend::shape_name(type), *what = backend::shape_name(with);
  c.expect(wrong_sign <= forgiven, "{} of {} pairs of a {} and a {}: touching or not differs from the referee",
           wrong_sign, compared, name, what);
  c.expect(wrong_distance == 0,
           "{} of {} pairs of a {} and a {}: the distance is not the referee's, {:.4f} instead of {:.4f} m",
           wrong_distance, compared, name, what, told, truth);
  c.expect(overlapping > 2, "only {} overlaps of a {} and a {}", overlapping, name, what);
}

bool stands_still(Conformance& c, PlumbShapeType type) {
  return c.backend().capability(PLUMB_CAP_SHAPE, type, PLUMB_STATIC) != PLUMB_NONE;
}
/// What the engine says of a query with a shape, as far as it knows the pair at all.
PlumbDegree claim_of(Conformance& c, PlumbQueryKind kind, PlumbShapeType type, PlumbShapeType at) {
  const PlumbDegree query = c.backend().capability(PLUMB_CAP_QUERY, kind, type),
                    pair = c.backend().capability(PLUMB_CAP_PAIR, type, at);
  if (query == PLUMB_NONE || pair == PLUMB_NONE) return PLUMB_NONE;
  return query == PLUMB_APPROXIMATE || pair == PLUMB_APPROXIMATE ? PLUMB_APPROXIMATE : PLUMB_NATIVE;
}

void rays_at_shapes(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_RAY, 0, "rays");
  for (const PlumbShapeType type : kTargets)
    if (stands_still(c, type)) rays_at(c, type);
}

void casts_at_shapes(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_SPHERE, "sphere casts");
  for (const PlumbShapeType type : kConvex)
    for (const PlumbShapeType at : kTargets)
      if (const PlumbDegree claim = claim_of(c, PLUMB_QUERY_CAST, type, at); stands_still(c, at) && claim != PLUMB_NONE)
        casts_at(c, type, at, claim == PLUMB_APPROXIMATE ? 8 : 1);
}

void overlaps_with_shapes(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_OVERLAP, PLUMB_SPHERE, "sphere overlaps");
  for (const PlumbShapeType type : kConvex)
    for (const PlumbShapeType with : kTargets) {
      const PlumbDegree claim = claim_of(c, PLUMB_QUERY_OVERLAP, type, with);
      if (stands_still(c, with) && claim != PLUMB_NONE)
        overlaps_with(c, type, with, claim == PLUMB_APPROXIMATE ? 12 : 0);
    }
}

void collided_shapes(Conformance& c) {
  c.require_needs(kQueryNeeds);
  if (Probe(c, kQueryNeeds, Vec::Zero()).world().collide() == nullptr) throw Skipped{"no " PLUMB_EXT_COLLIDE};
  for (const PlumbShapeType type : kConvex)
    for (const PlumbShapeType with : kTargets) {
      const PlumbDegree claim = c.backend().capability(PLUMB_CAP_PAIR, type, with);
      if (claim != PLUMB_NONE) pairs_with(c, type, with, claim == PLUMB_APPROXIMATE ? 12 : 3);
    }
}

}  // namespace

std::span<const Check> query_target_checks() {
  static constexpr Check checks[] = {
      {"queries.rays_at_shapes", "rays at every shape against the referee's distances", &rays_at_shapes},
      {"queries.casts_at_shapes", "casts of every shape at every other", &casts_at_shapes},
      {"queries.overlaps_with_shapes", "overlaps of every shape with every other", &overlaps_with_shapes},
      {"collide.shapes", "collision without a step of every shape with every other", &collided_shapes},
  };
  return checks;
}

}  // namespace plumb::harness::conform
