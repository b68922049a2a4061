// Queries and stepless collision against brute force by the referee's geometry.
#include <cmath>
#include <optional>
#include <random>

#include "conform/probe.hpp"
#include "plumb/backend/names.hpp"
#include "referee/penetration.hpp"

namespace plumb::harness::conform {
namespace {

/// A cloud of spheres and turned boxes, known to the referee too.
struct Cloud {
  struct Item {
    PlumbBody body;
    referee::ShapePtr shape;
    referee::Pose pose;
    PlumbFilter filter;
  };
  Probe probe;
  std::vector<Item> items;

  Cloud(Conformance& c, PlumbNeeds more, int count) : probe(c, kQueryNeeds | more, Vec::Zero()) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < count; ++i) {
      PlumbShapeDesc shape = shape_desc(i % 2 == 0 ? PLUMB_SPHERE : PLUMB_BOX);
      shape.radius = 0.4 + 0.2 * unit(random);
      shape.half_extents = {0.4 + 0.2 * unit(random), 0.4 + 0.2 * unit(random), 0.4 + 0.2 * unit(random)};
      PlumbBodyDesc desc = body_desc(i % 3 == 0 ? PLUMB_STATIC : PLUMB_DYNAMIC);
      desc.material.friction = 0;
      desc.pose.position = {6 * unit(random), 6 * unit(random), 6 * unit(random)};
      const Eigen::Quaterniond q =
          Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
      desc.pose.orientation = {q.x(), q.y(), q.z(), q.w()};
      if ((more & PLUMB_NEED_FILTERS) != 0) desc.filter.category = 1u << (i % 3);
      desc.shape = probe.shape(shape);
      items.push_back({probe.body(desc), referee::Shape::make(shape), referee::pose(desc.pose), desc.filter});
    }
  }
};

/// Fraction at which a ray enters a sphere or a box that is `grown` larger on all sides, by their equations.
std::optional<double> ray_enters(const Cloud::Item& item, const Vec& origin, const Vec& translation, double grown = 0) {
  const Vec o = item.pose.inverse() * origin;
  const Vec d = item.pose.rotation.transpose() * translation;
  if (item.shape->type() == PLUMB_SPHERE) {
    const double a = d.squaredNorm(), b = o.dot(d),
                 root = b * b - a * (o.squaredNorm() - std::pow(item.shape->radius() + grown, 2));
    if (root < 0) return {};
    const double t = (-b - std::sqrt(root)) / a;
    return t >= 0 && t <= 1 ? std::optional(t) : std::nullopt;
  }
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = item.shape->half_extents()[axis] + grown;
    if (std::abs(d[axis]) < 1e-12) {
      if (std::abs(o[axis]) > h) return {};
      continue;
    }
    const double t0 = (-h - o[axis]) / d[axis], t1 = (h - o[axis]) / d[axis];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return enter <= leave ? std::optional(enter) : std::nullopt;
}

bool inside(const Cloud::Item& item, const Vec& point) {
  const Vec p = item.pose.inverse() * point;
  return item.shape->type() == PLUMB_SPHERE ? p.norm() < item.shape->radius()
                                            : (p.cwiseAbs() - item.shape->half_extents()).maxCoeff() < 0;
}

/// Random rays; those that start inside a body are left out, since engines differ on what they should see.
std::vector<PlumbRay> random_rays(const Cloud& cloud, int count, PlumbFilter filter) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<PlumbRay> rays;
  while (static_cast<int>(rays.size()) < count) {
    const Vec origin(9 * unit(random), 9 * unit(random), 9 * unit(random)),
        target(6 * unit(random), 6 * unit(random), 6 * unit(random));
    bool starts_inside = false;
    for (const Cloud::Item& item : cloud.items) starts_inside = starts_inside || inside(item, origin);
    if (!starts_inside) rays.push_back({vec3(origin), vec3(2 * (target - origin)), filter});
  }
  return rays;
}

void compare_rays(Conformance& c, Cloud& cloud, PlumbFilter filter) {
  const std::vector<PlumbRay> rays = random_rays(cloud, 300, filter);
  const Hits closest = cloud.probe.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, rays);
  c.expect(closest.result >= 0 && closest.hits.size() == rays.size(), "{} closest hits for {} rays",
           closest.hits.size(), rays.size());
  const std::vector<PlumbHit> nearest(closest.hits.begin(), closest.hits.end());
  const Hits all = cloud.probe.world().queries()->cast_rays(PLUMB_HIT_ALL, rays);
  std::size_t next = 0;
  int wrong = 0, grazing = 0;
  for (std::size_t i = 0; i < rays.size() && i < nearest.size(); ++i) {
    std::vector<std::pair<double, PlumbBody>> truth;
    bool grazes = false;  // by less than 2 mm: it may go either way
    for (const Cloud::Item& item : cloud.items)
      if (may_touch(filter, item.filter)) {
        const Vec origin = vec(rays[i].origin), translation = vec(rays[i].translation);
        if (const auto t = ray_enters(item, origin, translation)) truth.emplace_back(*t, item.body);
        grazes = grazes || ray_enters(item, origin, translation, 2e-3).has_value() !=
                               ray_enters(item, origin, translation, -2e-3).has_value();
      }
    std::sort(truth.begin(), truth.end());
    const PlumbHit& hit = nearest[i];
    if (grazes) ++grazing;
    const bool right =
        (hit.body == 0) == truth.empty() &&
        (hit.body == 0 || (hit.body == truth[0].second && std::abs(hit.fraction - truth[0].first) < 2e-3));
    if (!grazes && !right) ++wrong;
    std::vector<PlumbBody> got, wanted;
    double last = -1;
    for (; next < all.hits.size() && all.hits[next].query == i; ++next) {
      got.push_back(all.hits[next].body);
      c.expect(all.hits[next].fraction >= last, "ray {}: hits are not sorted by fraction", i);
      last = all.hits[next].fraction;
    }
    for (const auto& [t, body] : truth) wanted.push_back(body);
    std::sort(got.begin(), got.end());
    std::sort(wanted.begin(), wanted.end());
    if (!grazes && got != wanted) ++wrong;
  }
  c.expect(next == all.hits.size(), "hits of all rays are not sorted by query");
  c.expect(wrong == 0, "{} of {} answers to rays differ from brute force", wrong, 2 * rays.size());
  c.expect(grazing < 40, "{} of {} rays graze: too few are compared", grazing, rays.size());
}

void rays(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_RAY, 0, "rays");
  Cloud cloud(c, 0, 60);
  compare_rays(c, cloud, kSeesAll);
}

void filtered_rays(Conformance& c) {
  c.require_needs(kQueryNeeds | PLUMB_NEED_FILTERS);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_RAY, 0, "rays");
  Cloud cloud(c, PLUMB_NEED_FILTERS, 60);
  compare_rays(c, cloud, {1, 0b101, 0, 0});
}

/// The ray of a moved body must see it where it is now.
void rays_after_motion(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_RAY, 0, "rays");
  Probe probe(c, kQueryNeeds, Vec::Zero());
  PlumbBodyDesc desc = dynamic_desc(probe.sphere(0.5), {0, 0, 0}, {10, 0, 0});
  desc.material.friction = 0;
  const PlumbBody ball = probe.body(desc);
  probe.step(60);
  const PlumbRay hits_it = {{10, 5, 0}, {0, -10, 0}, kSeesAll}, where_it_was = {{0, 5, 0}, {0, -10, 0}, kSeesAll};
  const PlumbRay both[2] = {hits_it, where_it_was};
  const Hits hits = probe.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, both);
  c.expect(hits.hits.size() == 2 && hits.hits[0].body == ball && hits.hits[1].body == 0,
           "rays see a moved ball where it is not");
  if (hits.hits.size() == 2 && hits.hits[0].body == ball) {
    c.expect(std::abs(hits.hits[0].fraction - 0.45) < 0.01, "the ball's top is at fraction {:.4f} instead of .45",
             hits.hits[0].fraction);
    c.expect((vec(hits.hits[0].normal) - Vec::UnitY()).norm() < 0.05, "the normal on top of a ball is not up");
  }
  probe.destroy(ball);
  c.expect(probe.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, both).hits[0].body == 0,
           "a destroyed ball is still seen");
}

/// Along the way of a cast up to its hit nothing may be overlapped by more than a hair, and at it something must be
/// touched; what overlaps at the start is hit there.
void compare_casts(Conformance& c, PlumbShapeType type) {
  Cloud cloud(c, 0, 40);
  PlumbShapeDesc desc = shape_desc(type);
  desc.radius = 0.3;
  desc.half_height = 0.25;
  desc.half_extents = {0.3, 0.2, 0.4};
  const PlumbShape shape = cloud.probe.shape(desc);
  const referee::ShapePtr moved = referee::Shape::make(desc);
  const auto depth_of = [&](const PlumbPose& pose, const Cloud::Item& item) {
    return referee::penetration(*moved, referee::pose(pose), *item.shape, item.pose).depth;
  };
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<PlumbCast> batch, from_within;
  for (const PlumbRay& ray : random_rays(cloud, 160, kSeesAll)) {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
    const PlumbCast cast = {shape, {ray.origin, {q.x(), q.y(), q.z(), q.w()}}, ray.translation, kSeesAll};
    double depth = -1;
    for (const Cloud::Item& item : cloud.items) depth = std::max(depth, depth_of(cast.pose, item));
    if (depth < -0.01) batch.push_back(cast);
    if (depth > 0.05) from_within.push_back(cast);  // beyond an engine's margin
  }
  const Hits found = cloud.probe.world().queries()->cast_shapes(PLUMB_HIT_CLOSEST, batch);
  const char* name = backend::shape_name(type);
  c.expect(found.hits.size() == batch.size(), "{} closest hits for {} casts of a {}", found.hits.size(), batch.size(),
           name);
  int wrong = 0;
  for (std::size_t i = 0; i < found.hits.size(); ++i) {
    const double fraction = found.hits[i].body == 0 ? 1 : found.hits[i].fraction;
    double deepest = -1, at_end = -1;
    for (const double part : {0.25, 0.5, 0.75, 0.98, 1.0})
      for (const Cloud::Item& item : cloud.items) {
        PlumbPose pose = batch[i].pose;
        pose.position = vec3(vec(pose.position) + part * fraction * vec(batch[i].translation));
        const double depth = depth_of(pose, item);
        deepest = std::max(deepest, depth);
        if (part == 1.0 && item.body == found.hits[i].body) at_end = depth;
      }
    if (deepest > 0.05 || (found.hits[i].body != 0 && std::abs(at_end) > 0.05)) ++wrong;
  }
  c.expect(wrong <= 2, "{} of {} casts of a {} end too late or too early", wrong, batch.size(), name);
  const Hits at_start = cloud.probe.world().queries()->cast_shapes(PLUMB_HIT_CLOSEST, from_within);
  for (const PlumbHit& hit : at_start.hits)
    c.expect(hit.body != 0 && hit.fraction == 0, "a {} that overlaps at the start hits at fraction {:.4f}", name,
             hit.fraction);
  c.expect(!from_within.empty(), "no cast of a {} overlaps at the start", name);
}

void casts(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_SPHERE, "sphere casts");
  for (const PlumbShapeType type : {PLUMB_SPHERE, PLUMB_BOX, PLUMB_CAPSULE})
    if (c.backend().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, type) != PLUMB_NONE) compare_casts(c, type);
}

void overlaps(Conformance& c) {
  c.require_needs(kQueryNeeds);
  int asked = 0;
  for (const PlumbShapeType type : {PLUMB_SPHERE, PLUMB_BOX, PLUMB_CAPSULE}) {
    const PlumbDegree claim = c.backend().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_OVERLAP, type);
    if (claim == PLUMB_NONE) continue;
    int forgiven = claim == PLUMB_APPROXIMATE ? 3 : 0;  // of 3600
    Cloud cloud(c, 0, 60);
    PlumbShapeDesc desc = shape_desc(type);
    desc.radius = 0.8;
    desc.half_height = 0.5;
    desc.half_extents = {1, 0.7, 0.5};
    const PlumbShape shape = cloud.probe.shape(desc);
    const referee::ShapePtr probe_shape = referee::Shape::make(desc);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<PlumbOverlap> batch;
    for (int i = 0; i < 60; ++i) {
      const Eigen::Quaterniond q =
          Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
      batch.push_back(
          {shape, {{6 * unit(random), 6 * unit(random), 6 * unit(random)}, {q.x(), q.y(), q.z(), q.w()}}, kSeesAll});
    }
    const Hits hits = cloud.probe.world().queries()->overlap_shapes(batch);
    for (std::size_t i = 0; i < batch.size(); ++i)
      for (const Cloud::Item& item : cloud.items) {
        const double depth =
            referee::penetration(*probe_shape, referee::pose(batch[i].pose), *item.shape, item.pose).depth;
        if (std::abs(depth) < 0.05) continue;  // within an engine's margin
        const bool found = std::any_of(hits.hits.begin(), hits.hits.end(),
                                       [&](const PlumbHit& hit) { return hit.query == i && hit.body == item.body; });
        ++asked;
        if (found != (depth > 0) && forgiven-- > 0) continue;
        c.expect(found == (depth > 0), "a {} and a {} that overlap by {:.4f} m {} found", backend::shape_name(type),
                 backend::shape_name(item.shape->type()), depth, found ? "are" : "are not");
      }
  }
  if (asked == 0) c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_OVERLAP, PLUMB_SPHERE, "overlaps");
}

/// Collision without a step: sign and depth of random pairs.
void stepless(Conformance& c) {
  Probe probe(c, kPlainNeeds, Vec::Zero());
  if (probe.world().collide() == nullptr) throw Skipped{"no " PLUMB_EXT_COLLIDE};
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  int compared = 0, wrong_sign = 0, wrong_depth = 0;
  for (const PlumbShapeType a : {PLUMB_SPHERE, PLUMB_BOX, PLUMB_CAPSULE})
    for (const PlumbShapeType b : {PLUMB_SPHERE, PLUMB_BOX, PLUMB_CAPSULE}) {
      if (c.backend().capability(PLUMB_CAP_PAIR, a, b) == PLUMB_NONE) continue;
      PlumbShapeDesc descs[2] = {shape_desc(a), shape_desc(b)};
      for (PlumbShapeDesc& desc : descs) {
        desc.radius = 0.4;
        desc.half_height = 0.5;
        desc.half_extents = {0.5, 0.6, 0.7};
      }
      const PlumbShape shapes[2] = {probe.shape(descs[0]), probe.shape(descs[1])};
      const referee::ShapePtr known[2] = {referee::Shape::make(descs[0]), referee::Shape::make(descs[1])};
      for (int i = 0; i < 50; ++i) {
        PlumbPosedPair pair{shapes[0], shapes[1], identity_pose(), identity_pose()};
        for (PlumbPose* pose : {&pair.pose_a, &pair.pose_b}) {
          const Eigen::Quaterniond q =
              Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized();
          *pose = {{0.8 * unit(random), 0.8 * unit(random), 0.8 * unit(random)}, {q.x(), q.y(), q.z(), q.w()}};
        }
        PlumbPairResult result{};
        std::span<const PlumbPairPoint> points;
        check(probe.world(), probe.world().collide()->collide_pairs({&pair, 1}, {&result, 1}, points));
        const double depth =
            referee::penetration(*known[0], referee::pose(pair.pose_a), *known[1], referee::pose(pair.pose_b)).depth;
        if (std::abs(depth) < 0.05) continue;
        ++compared;
        double deepest = -1;
        for (const PlumbPairPoint& point : points) deepest = std::max(deepest, point.depth);
        if ((deepest > 0) != (depth > 0)) ++wrong_sign;
        // Engines may measure a deep overlap along another axis, so only what is far too small is wrong.
        if (depth > 0 && deepest > 0 && deepest < 0.5 * depth - 0.05) ++wrong_depth;
      }
    }
  c.expect(wrong_sign == 0, "{} of {} pairs: touching or not differs from the referee", wrong_sign, compared);
  c.expect(wrong_depth <= compared / 20, "{} of {} pairs: the depth is less than half the referee's", wrong_depth,
           compared);
}

/// Candidate pairs must hold every pair that overlaps.
void candidates(Conformance& c) {
  Cloud cloud(c, 0, 60);
  if (cloud.probe.world().debug() == nullptr) throw Skipped{"no " PLUMB_EXT_DEBUG};
  cloud.probe.step(1, 1e-6);
  std::span<const PlumbDebugPair> pairs;
  if (cloud.probe.world().debug()->candidate_pairs(pairs) == PLUMB_E_UNSUPPORTED)
    throw Skipped{"no candidate pairs in " PLUMB_EXT_DEBUG};
  for (std::size_t i = 0; i < cloud.items.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto &a = cloud.items[i], &b = cloud.items[k];
      if (i % 3 == 0 && k % 3 == 0) continue;  // two statics
      if (referee::penetration(*a.shape, a.pose, *b.shape, b.pose).depth < 0.01) continue;
      const bool listed = std::any_of(pairs.begin(), pairs.end(), [&](const PlumbDebugPair& pair) {
        return (pair.body_a == a.body && pair.body_b == b.body) || (pair.body_a == b.body && pair.body_b == a.body);
      });
      c.expect(listed, "bodies {} and {} overlap, but are no candidate pair", k, i);
    }
}

}  // namespace

std::span<const Check> query_checks() {
  static constexpr Check checks[] = {
      {"queries.rays", "closest and all hits of rays against brute force", &rays},
      {"queries.filtered", "rays see by the filters' rule", &filtered_rays},
      {"queries.moved", "rays see bodies where they are now", &rays_after_motion},
      {"queries.casts", "casts end where they touch, or start", &casts},
      {"queries.overlaps", "overlaps against the referee", &overlaps},
      {"collide.pairs", "collision without a step against the referee", &stepless},
      {"debug.pairs", "candidate pairs hold every overlap", &candidates},
  };
  return checks;
}

}  // namespace plumb::harness::conform
