// Closed forms at tight tolerances: rays, casts, overlaps and stepless collision of spheres and boxes. Asked of what is
// claimed as native or emulated.
#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace exact {
namespace {

constexpr double kHair = 1e-3;  ///< metres that an engine's margin or iteration may cost

void expect_hit(Conformance& c, const char* what, const PlumbHit& hit, double fraction, const Vec& point,
                const Vec& normal, double length) {
  c.expect(hit.body != 0, "{} sees nothing", what);
  if (hit.body == 0) return;
  c.expect(std::abs(hit.fraction - fraction) * length < kHair, "{} ends at fraction {:.6f} instead of {:.6f}", what,
           hit.fraction, fraction);
  c.expect((vec(hit.position) - point).norm() < 2 * kHair, "{} is answered a point {:.6f} m off", what,
           (vec(hit.position) - point).norm());
  c.expect((vec(hit.normal) - normal).norm() < 5e-3, "{} is answered a normal that leans by {:.6f}", what,
           (vec(hit.normal) - normal).norm());
}

/// Rays aimed at points of a sphere's and a turned box's surface, from outside along that point's normal and askew.
void rays(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require_exact(PLUMB_CAP_QUERY, PLUMB_QUERY_RAY, 0, "rays");
  Probe probe(c, kQueryNeeds, Vec::Zero());
  const Vec ball_at(1, 2, 3), box_at(-6, 1, 0), half(0.5, 0.8, 1.1);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.8, Vec(1, 2, -1).normalized()));
  probe.dynamic(probe.sphere(0.7), ball_at);
  PlumbBodyDesc box = dynamic_desc(probe.box(half), box_at);
  box.pose.orientation = {turn.x(), turn.y(), turn.z(), turn.w()};
  probe.body(box);
  for (int i = 0; i < 24; ++i) {
    const double height = (i + 0.5) / 12 - 1, ring = std::sqrt(1 - height * height), angle = 2.4 * i;
    const Vec normal(ring * std::cos(angle), height, ring * std::sin(angle));
    const int axis = i % 3;
    const double side = i % 2 == 0 ? 1 : -1;
    Vec on_face = 0.6 * half.cwiseProduct(normal);
    on_face[axis] = side * half[axis];
    const Vec targets[] = {ball_at + 0.7 * normal, box_at + turn * on_face},
              normals[] = {normal, turn * Vec(side * Vec::Unit(axis))};
    for (int k = 0; k < 2; ++k) {
      const Vec askew = (normals[k] + 0.5 * normals[k].cross(Vec(0.3, 1, -0.4)).normalized()).normalized();
      const Vec origin = targets[k] + 2.5 * askew;
      const PlumbRay ray = {vec3(origin), vec3(-4 * askew), kSeesAll};
      const Hits hits = probe.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
      expect_hit(c, k == 0 ? "a ray at a sphere" : "a ray at a box", hits.hits[0], 2.5 / 4, targets[k], normals[k], 4);
    }
  }
}

struct KnownCast {
  PlumbCast cast;
  double way;  ///< to the hit, m
};

/// Five metres, of which each cast does its way.
void expect_casts(Conformance& c, Probe& probe, std::span<const KnownCast> known) {
  for (const KnownCast& one : known) {
    const Hits hits = probe.world().queries()->cast_shapes(PLUMB_HIT_CLOSEST, {&one.cast, 1});
    c.expect(hits.hits[0].body != 0 && std::abs(5 * hits.hits[0].fraction - one.way) < 5 * kHair,
             "a cast goes {:.5f} m instead of {:.5f}", 5 * hits.hits[0].fraction, one.way);
  }
}

void sphere_casts(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require_exact(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_SPHERE, "sphere casts");
  Probe probe(c, kQueryNeeds, Vec::Zero());
  probe.fixed(probe.box({2, 0.5, 2}), {0, -0.5, 0});
  probe.fixed(probe.sphere(1), {20, 0, 0});
  const PlumbShape ball = probe.sphere(0.3);
  const KnownCast known[] = {{{ball, {{0.5, 3, 0.5}, {0, 0, 0, 1}}, {0, -5, 0}, kSeesAll}, 2.7},
                             {{ball, {{25, 0, 0}, {0, 0, 0, 1}}, {-5, 0, 0}, kSeesAll}, 3.7}};
  expect_casts(c, probe, known);
}

/// On its edge, and flat.
void box_casts(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require_exact(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_BOX, "box casts");
  Probe probe(c, kQueryNeeds, Vec::Zero());
  probe.fixed(probe.box({2, 0.5, 2}), {0, -0.5, 0});
  const PlumbShape box = probe.box({0.4, 0.4, 0.4});
  const double eighth = M_PI / 8;
  const KnownCast known[] = {
      {{box, {{-0.5, 3, 0.2}, {0, 0, std::sin(eighth), std::cos(eighth)}}, {0, -5, 0}, kSeesAll}, 3 - 0.4 * M_SQRT2},
      {{box, {{-0.5, 3, 0.2}, {0, 0, 0, 1}}, {0, -5, 0}, kSeesAll}, 2.6}};
  expect_casts(c, probe, known);
}

void overlaps(Conformance& c) {
  c.require_needs(kQueryNeeds);
  c.require_exact(PLUMB_CAP_QUERY, PLUMB_QUERY_OVERLAP, PLUMB_SPHERE, "overlaps of spheres");
  Probe probe(c, kQueryNeeds, Vec::Zero());
  probe.dynamic(probe.sphere(0.5), {0, 0, 0});
  probe.dynamic(probe.box({0.5, 0.5, 0.5}), {10, 0, 0});
  const PlumbShape ball = probe.sphere(0.25);
  for (const double gap : {-5 * kHair, 5 * kHair})
    for (const double x : {0.0, 10.0}) {
      const PlumbOverlap asked = {ball, {{x, 0.75 + gap, 0}, {0, 0, 0, 1}}, kSeesAll};
      const std::size_t found = probe.world().queries()->overlap_shapes({&asked, 1}).hits.size();
      c.expect(found == (gap < 0 ? 1U : 0U), "a ball and a {} with {:+.0f} mm between them: {} found",
               x == 0 ? "ball" : "box", gap * 1000, found);
    }
}

/// Depths and gaps of posed pairs, and the normals from the first to the second.
void pairs(Conformance& c) {
  c.require_needs(kPlainNeeds);
  Probe probe(c, kPlainNeeds, Vec::Zero());
  if (probe.world().collide() == nullptr) throw Skipped{"no " PLUMB_EXT_COLLIDE};
  c.require_exact(PLUMB_CAP_PAIR, PLUMB_SPHERE, PLUMB_SPHERE, "spheres on spheres");
  c.require_exact(PLUMB_CAP_PAIR, PLUMB_SPHERE, PLUMB_BOX, "spheres on boxes");
  const PlumbShape ball = probe.sphere(0.5), box = probe.box({0.6, 0.7, 0.8});
  const Vec way = Vec(2, -1, 0.5).normalized();
  for (const bool first : {true, false}) {
    const PlumbShape other = first ? ball : box;
    const Vec offset = first ? Vec(0.97 * way) : Vec(0.1, 1.17, -0.2), normal = first ? way : Vec::UnitY();
    const PlumbPosedPair pair = {other, ball, {{1, 2, 3}, {0, 0, 0, 1}}, {vec3(Vec(1, 2, 3) + offset), {0, 0, 0, 1}}};
    PlumbPairResult result{};
    std::span<const PlumbPairPoint> points;
    check(probe.world(), probe.world().collide()->collide_pairs({&pair, 1}, {&result, 1}, points));
    const char* name = first ? "two balls" : "a box and a ball";
    c.expect(std::abs(result.distance + 0.03) < kHair, "{} that are 3 cm deep in each other: distance {:.6f}", name,
             result.distance);
    c.expect(points.size() == 1, "{}: {} points", name, points.size());
    for (const PlumbPairPoint& point : points)
      c.expect(std::abs(point.depth - 0.03) < kHair && (vec(point.normal) - normal).norm() < 5e-3,
               "{} that are 3 cm deep in each other: depth {:.6f}, normal off by {:.5f}", name, point.depth,
               (vec(point.normal) - normal).norm());
  }
}

}  // namespace
}  // namespace exact

std::span<const Check> exact_query_checks() {
  static constexpr Check checks[] = {
      {"exact.rays", "rays at a sphere and a turned box: fraction, point and normal within 1 mm", &exact::rays},
      {"exact.casts", "casts of spheres, within 5 mm", &exact::sphere_casts},
      {"exact.box_casts", "a box on its edge and flat, within 5 mm", &exact::box_casts},
      {"exact.overlaps", "5 mm apart or 5 mm deep", &exact::overlaps},
      {"exact.pairs", "stepless depths and normals within 1 mm", &exact::pairs},
  };
  return checks;
}

}  // namespace plumb::harness::conform
