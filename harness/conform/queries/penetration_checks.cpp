// How deep shapes overlap bodies and which way is out: against closed forms, against the referee, and by going that
// way.
#include <algorithm>
#include <cmath>

#include "conform/queries/query_target.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

using Rows = std::vector<PlumbPenetration>;

PlumbDegree depth_claim(Conformance& c, PlumbShapeType type) {
  return c.backend().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_PENETRATION, type);
}
void require_depths(Conformance& c) {
  c.require_needs(kQueryNeeds);
  if (std::none_of(std::begin(kConvex), std::end(kConvex),
                   [&](PlumbShapeType type) { return depth_claim(c, type) != PLUMB_NONE; }))
    c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_PENETRATION, PLUMB_SPHERE, "depth of overlap");
}
/// What a depth may be off, m: by rounding, or by what an engine adds to its shapes.
double depth_slack(Conformance& c, PlumbShapeType type) {
  if (depth_claim(c, type) == PLUMB_APPROXIMATE) return 0.09;
  return c.backend().info().precision == PLUMB_F64 ? 5e-6 : 1e-4;
}

Rows penetrations(Probe& in, std::span<const PlumbOverlap> overlaps) {
  const Penetrations found = in.world().queries()->penetrations(overlaps);
  check(in.world(), found.result);
  return {found.rows.begin(), found.rows.end()};
}

/// Sizes are sums of powers of 2, which every engine can hold.
PlumbShapeDesc solid(PlumbShapeType type) {
  static constexpr double kTetrahedron[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                          kHeights[9] = {.5, .5, .5, .5, .5, .5, .5, .5, .5},
                          kSquare[] = {-2, 0, -2, -2, 0, 2, 2, 0, 2, 2, 0, -2};
  static constexpr std::uint32_t kTriangles[] = {0, 1, 2, 0, 2, 3};
  PlumbShapeDesc desc = shape_desc(type);
  desc.radius = type == PLUMB_CAPSULE ? 0.25 : 0.5;
  desc.half_height = 1;
  desc.half_extents = {0.5, 0.75, 1};
  desc.vertices = type == PLUMB_TRIANGLE_MESH ? kSquare : kTetrahedron;
  desc.vertex_count = 4;
  desc.indices = kTriangles;
  desc.triangle_count = 2;
  desc.heights = kHeights;
  desc.rows = desc.columns = 3;
  desc.spacing = {2, 0, 2};
  return desc;
}

struct Sunk {
  const char* name;
  PlumbShapeType body, probe;  ///< a ball's radius is 0.25
  PlumbPose pose;
  double depth;
  Vec normal;  ///< the way out
};

std::vector<Sunk> sunk() {
  const Vec x(1, 0, 0), y(0, 1, 0), slope = Vec(1, 1, 1).normalized(), over = Vec(1, 1, 1) / 3 + slope / 8;
  const PlumbQuat level = {0, 0, 0, 1}, eighth = {0, 0, std::sin(M_PI / 8), std::cos(M_PI / 8)};
  const double low = std::cos(M_PI / 4) * (0.5 + 0.75);  // the edge of the box below its middle, so turned
  const PlumbShapeType ball = PLUMB_SPHERE;
  return {
      {"a ball in a ball", PLUMB_SPHERE, ball, {{0.5, 0, 0}, level}, 0.25, x},
      {"a ball deep in a box", PLUMB_BOX, ball, {{0.375, 0.125, 0.25}, level}, 0.375, x},
      {"a box on a box", PLUMB_BOX, PLUMB_BOX, {{0, 1.375, 0.25}, level}, 0.125, y},
      {"a ball in a capsule", PLUMB_CAPSULE, ball, {{0.375, 0.5, 0}, level}, 0.125, x},
      {"a ball in a cylinder", PLUMB_CYLINDER, ball, {{0.625, 0.25, 0}, level}, 0.125, x},
      {"a ball on the slope of a hull", PLUMB_CONVEX_HULL, ball, {vec3(over), level}, 0.125, slope},
      {"a ball far below a plane", PLUMB_PLANE, ball, {{5, -3, 7}, level}, 3.25, y},
      {"an edge of a box in a plane", PLUMB_PLANE, PLUMB_BOX, {{5, low - 0.125, 7}, eighth}, 0.125, y},
      {"a capsule upright in a plane", PLUMB_PLANE, PLUMB_CAPSULE, {{5, 1.125, 7}, level}, 0.125, y},
      {"a ball in a mesh", PLUMB_TRIANGLE_MESH, ball, {{0.5, 0.125, 0.25}, level}, 0.125, y},
      {"a ball in a height field", PLUMB_HEIGHT_FIELD, ball, {{0.5, 0.625, 0.25}, level}, 0.125, y},
  };
}

void depth_forms(Conformance& c) {
  require_depths(c);
  for (const Sunk& one : sunk()) {
    if (depth_claim(c, one.probe) == PLUMB_NONE) continue;
    if (c.backend().capability(PLUMB_CAP_SHAPE, one.body, PLUMB_STATIC) == PLUMB_NONE) continue;
    Probe world(c, kQueryNeeds, Vec::Zero());
    const PlumbBody body = world.fixed(world.shape(solid(one.body)), Vec::Zero());
    PlumbShapeDesc shape = solid(one.probe);
    if (one.probe == PLUMB_SPHERE) shape.radius = 0.25;
    const PlumbOverlap asked = {world.shape(shape), one.pose, kSeesAll};
    const Rows rows = penetrations(world, {&asked, 1});
    c.expect(rows.size() == 1 && rows[0].body == body, "{}: {} rows instead of one of its body", one.name, rows.size());
    if (rows.empty()) continue;
    const double slack = depth_slack(c, one.probe);
    c.expect(std::abs(rows[0].depth - one.depth) < slack, "{}: {:.6f} m deep instead of {:.6f}", one.name,
             rows[0].depth, one.depth);
    c.expect((vec(rows[0].normal) - one.normal).norm() < 10 * slack, "{}: the way out is {:.4f} {:.4f} {:.4f}",
             one.name, rows[0].normal.x, rows[0].normal.y, rows[0].normal.z);
    const double off = (vec(rows[0].position) - vec(one.pose.position)).norm();
    c.expect(off < vec(shape.half_extents).norm() + one.depth + 1 + slack, "{}: its deepest point is {:.3f} m away",
             one.name, off);
  }
}

/// Overlaps of more than an engine's margin are told, none is less deep than the shortest way out, and those of convex
/// bodies end where a shape has gone its depth along its normal.
void compare_ways_out(Conformance& c, PlumbShapeType type, PlumbShapeType at) {
  Target target(c, at);
  const PlumbShape shape = target.probe.shape(convex_desc(type));
  const referee::ShapePtr known = referee::Shape::make(convex_desc(type));
  std::mt19937 random(12);
  std::vector<PlumbOverlap> asked;
  for (int i = 0; i < 120; ++i)
    asked.push_back({shape, {vec3(target.place_about(random, 1.2)), any_turn(random)}, kSeesAll});
  const Rows rows = penetrations(target.probe, asked);
  const double slack = depth_slack(c, type), margin = std::max(slack, 0.01);
  const bool one_piece = !target.is_surface() && at != PLUMB_COMPOUND;
  int unlike = 0, shallow = 0, stuck = 0, deep = 0, compared = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const bool told = next < rows.size() && rows[next].query == i;
    const PlumbPenetration row = told ? rows[next++] : PlumbPenetration{};
    referee::Pose pose = referee::pose(asked[i].pose);
    const double depth = -target.distance(*known, pose);
    if (!target.is_fit(vec(asked[i].pose.position)) || std::abs(depth) < margin) continue;
    if (told != (depth > 0)) ++unlike;
    if (!told || depth < 0) continue;
    ++compared;
    if (one_piece && row.depth < depth - slack - 1e-3 * depth) ++shallow;
    if (row.depth > 1.5 * depth + margin) ++deep;
    pose.position += row.depth * vec(row.normal);
    if (one_piece && target.distance(*known, pose) < -slack - 0.01 * row.depth) ++stuck;
  }
  const char *name = backend::shape_name(type), *of = backend::shape_name(at);
  const int allowed = depth_claim(c, type) == PLUMB_APPROXIMATE ? compared / 5 : 0;
  c.expect(next == rows.size(), "{} rows for one body and {} queries, sorted", rows.size(), asked.size());
  c.expect(unlike <= allowed, "{} overlaps of a {} and a {} are told wrongly", unlike, name, of);
  c.expect(shallow <= allowed, "{} of {} depths of a {} in a {} are less than the way out", shallow, compared, name,
           of);
  c.expect(stuck <= allowed, "{} of {} {}s that went the way out are still in the {}", stuck, compared, name, of);
  c.expect(deep <= compared / 5, "{} of {} depths of a {} in a {} are far more than the way out", deep, compared, name,
           of);
  c.expect(compared > 5, "only {} overlaps of a {} and a {}", compared, name, of);
}

void ways_out(Conformance& c) {
  require_depths(c);
  for (const PlumbShapeType type : kConvex)
    for (const PlumbShapeType at : kTargets)
      if (depth_claim(c, type) != PLUMB_NONE && c.backend().capability(PLUMB_CAP_SHAPE, at, PLUMB_STATIC) != PLUMB_NONE)
        compare_ways_out(c, type, at);
}

/// Of a compound its deepest child, of bodies the deepest first.
void deepest_first(Conformance& c) {
  require_depths(c);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_PENETRATION, PLUMB_SPHERE, "depth of overlap of a sphere");
  c.require(PLUMB_CAP_SHAPE, PLUMB_COMPOUND, PLUMB_STATIC, "compounds");
  Probe world(c, kQueryNeeds, Vec::Zero());
  PlumbCompoundChild parts[3] = {};
  for (int i = 0; i < 3; ++i) {
    parts[i].shape = world.sphere(0.5);
    parts[i].pose = {{0.5 * i, 0, 0}, {0, 0, 0, 1}};
  }
  PlumbShapeDesc compound = shape_desc(PLUMB_COMPOUND);
  compound.children = parts;
  compound.child_count = 3;
  const PlumbBody row = world.fixed(world.shape(compound), Vec::Zero());
  const PlumbBody above = world.fixed(world.sphere(0.5), {0, 1, 0}), aside = world.fixed(world.sphere(0.5), {-1, 0, 0});
  const PlumbShape ball = world.sphere(0.5);
  const PlumbOverlap asked[] = {{ball, {{0.125, 0.75, 0}, {0, 0, 0, 1}}, kSeesAll},
                                {ball, {{50, 0, 0}, {0, 0, 0, 1}}, kSeesAll},
                                {ball, {{1.125, 0.5, 0}, {0, 0, 0, 1}}, kSeesAll},
                                {ball, {{-0.75, 0.375, 0}, {0, 0, 0, 1}}, kSeesAll}};
  const Rows rows = penetrations(world, asked);
  const struct {
    std::uint32_t query;
    PlumbBody body;
    std::uint32_t child;
    Vec from, to;  ///< of the two balls, at a distance of 1 less the depth
  } wanted[] = {{0, above, 0, {0, 1, 0}, {0.125, 0.75, 0}}, {0, row, 0, {0, 0, 0}, {0.125, 0.75, 0}},
                {2, row, 2, {1, 0, 0}, {1.125, 0.5, 0}},    {3, aside, 0, {-1, 0, 0}, {-0.75, 0.375, 0}},
                {3, row, 0, {0, 0, 0}, {-0.75, 0.375, 0}},  {3, above, 0, {0, 1, 0}, {-0.75, 0.375, 0}}};
  c.expect(rows.size() == std::size(wanted), "{} rows instead of {}", rows.size(), std::size(wanted));
  for (std::size_t i = 0; i < std::min(rows.size(), std::size(wanted)); ++i) {
    const double depth = 1 - (wanted[i].to - wanted[i].from).norm();
    c.expect(rows[i].query == wanted[i].query && rows[i].body == wanted[i].body && rows[i].child == wanted[i].child,
             "row {} is of query {}, body {}, child {}", i, rows[i].query, slot_of(rows[i].body), rows[i].child);
    c.expect(std::abs(rows[i].depth - depth) < depth_slack(c, PLUMB_SPHERE),
             "row {} is {:.5f} m deep instead of {:.5f}", i, rows[i].depth, depth);
  }
}

void unseen_depths(Conformance& c) {
  require_depths(c);
  c.require(PLUMB_CAP_QUERY, PLUMB_QUERY_PENETRATION, PLUMB_SPHERE, "depth of overlap of a sphere");
  c.require(PLUMB_CAP_NEED, need_index(PLUMB_NEED_FILTERS), 0, "filters");
  c.require(PLUMB_CAP_NEED, need_index(PLUMB_NEED_SENSORS), 0, "sensors");
  Probe world(c, kQueryNeeds | PLUMB_NEED_FILTERS | PLUMB_NEED_SENSORS, Vec::Zero());
  const PlumbShape ball = world.sphere(0.5);
  PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
  desc.shape = ball;
  desc.filter = {2, ~0U, 0, 0};
  const PlumbBody wall = world.body(desc);
  desc.flags = PLUMB_BODY_SENSOR;
  world.body(desc);
  for (const std::uint32_t mask : {1U, 2U}) {
    const PlumbOverlap asked = {ball, {{0.25, 0, 0}, {0, 0, 0, 1}}, {1, mask, 0, 0}};
    const Rows rows = penetrations(world, {&asked, 1});
    c.expect(rows.size() == mask - 1 && (rows.empty() || rows[0].body == wall),
             "of a wall in category 2 and a sensor, a shape that looks for {} sees {}", mask, rows.size());
  }
}

}  // namespace

std::span<const Check> penetration_checks() {
  static constexpr Check kChecks[] = {
      {"depths.forms", "depths of overlap and ways out against closed forms", &depth_forms},
      {"depths.ways_out", "every shape in every shape against the referee, and out by the way that is told", &ways_out},
      {"depths.deepest", "of a compound its deepest child, of bodies the deepest first", &deepest_first},
      {"depths.unseen", "filters and sensors", &unseen_depths},
  };
  return kChecks;
}

}  // namespace plumb::harness::conform
