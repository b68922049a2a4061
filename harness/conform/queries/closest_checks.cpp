// plumb.closest/1 against closed forms, against the referee, and against what a distance must be whatever the shapes:
// points on both surfaces that are so far apart, and the same wherever the world is.
#include <algorithm>
#include <cmath>
#include <limits>

#include "conform/queries/query_target.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

/// What rounding may do to a distance of some metres, m.
double allowed(Conformance& c) { return c.backend().info().precision == PLUMB_F64 ? 5e-6 : 1e-4; }
double allowed(Conformance& c, PlumbShapeType probe) {
  return c.backend().capability(PLUMB_CAP_CLOSEST, probe) == PLUMB_APPROXIMATE ? 2e-3 : allowed(c);
}

bool looks_around(Conformance& c, PlumbShapeType type) {
  return c.backend().capability(PLUMB_CAP_CLOSEST, type) != PLUMB_NONE;
}
void require_any(Conformance& c) {
  c.require_needs(kQueryNeeds);
  if (std::none_of(std::begin(kConvex), std::end(kConvex), [&](PlumbShapeType type) { return looks_around(c, type); }))
    c.require(PLUMB_CAP_CLOSEST, PLUMB_SPHERE, 0, "closest bodies");
}

std::vector<PlumbClosest> closest(Probe& in, PlumbHitMode mode, std::span<const PlumbProbe> probes) {
  const ClosestBodies found = in.world().closest()->closest_bodies(mode, probes);
  check(in.world(), found.result);
  return {found.rows.begin(), found.rows.end()};
}
PlumbClosest nearest(Probe& in, const PlumbProbe& probe) { return closest(in, PLUMB_HIT_CLOSEST, {&probe, 1}).at(0); }

PlumbQuat about(const Vec& axis, double degrees) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()));
  return {q.x(), q.y(), q.z(), q.w()};
}

// --- closed forms ----------------------------------------------------------------------------------------------------

/// Sizes are sums of powers of 2, which every engine can hold.
PlumbShapeDesc form(PlumbShapeType type) {
  static constexpr double kTetrahedron[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                          kHeights[9] = {.5, .5, .5, .5, .5, .5, .5, .5, .5};
  static constexpr std::uint32_t kTriangle[] = {0, 3, 1};  // the one in y = 0, seen from above
  PlumbShapeDesc desc = shape_desc(type);
  desc.radius = type == PLUMB_SPHERE || type == PLUMB_CYLINDER ? 0.5 : 0.25;
  desc.half_height = 1;
  desc.half_extents = {0.5, 0.75, 1};
  desc.vertices = kTetrahedron;
  desc.vertex_count = 4;
  desc.indices = kTriangle;
  desc.triangle_count = 1;
  desc.heights = kHeights;
  desc.rows = desc.columns = 3;
  desc.spacing = {1, 0, 1};
  return desc;
}

struct Form {
  const char* name;
  PlumbShapeType body;
  PlumbQuat body_turn;
  PlumbShapeType probe;  ///< a sphere's radius is 0.25
  PlumbPose pose;
  double distance;
  Vec normal;  ///< from the probe to the body
};

std::vector<Form> forms() {
  const double root2 = std::sqrt(2), root3 = std::sqrt(3);
  const Vec x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const PlumbShapeType ball = PLUMB_SPHERE;
  // Half diagonals of the box's sections across z (0.5 by 0.75) turned so that a corner is below: its support.
  const double low = std::cos(M_PI / 4) * (0.5 + 0.75);
  return {
      {"two spheres", ball, kLevel, ball, {{3, 0, 0}, kLevel}, 2.25, -x},
      {"a face of a box", PLUMB_BOX, kLevel, ball, {{0.25, 2, -0.5}, kLevel}, 1, -y},
      {"an edge of a box", PLUMB_BOX, kLevel, ball, {{1.5, 1.75, 0.5}, kLevel}, root2 - 0.25, -(x + y) / root2},
      {"a corner of a box", PLUMB_BOX, kLevel, ball, {{1.5, 1.75, 2}, kLevel}, root3 - 0.25, -(x + y + z) / root3},
      {"two capsules that cross", PLUMB_CAPSULE, kLevel, PLUMB_CAPSULE, {{2, 0.25, 0}, about(x, 90)}, 1.5, -x},
      {"ends of two capsules", PLUMB_CAPSULE, kLevel, PLUMB_CAPSULE, {{0, 4, 0}, kLevel}, 1.5, -y},
      {"two edges of boxes that cross",
       PLUMB_BOX,
       about(z, 45),
       PLUMB_BOX,
       {{0, 5, 0}, about(x, 45)},
       5 - low - std::cos(M_PI / 4) * (0.75 + 1),
       -y},
      {"a rim of a cylinder", PLUMB_CYLINDER, kLevel, ball, {{1.5, 2, 0}, kLevel}, root2 - 0.25, -(x + y) / root2},
      {"a side of a cylinder", PLUMB_CYLINDER, kLevel, ball, {{0, 0.25, 2}, kLevel}, 1.25, -z},
      {"a face of a hull",
       PLUMB_CONVEX_HULL,
       kLevel,
       ball,
       {{1, 1, 1}, kLevel},
       2 / root3 - 0.25,
       -(x + y + z) / root3},
      {"a sphere over a plane", PLUMB_PLANE, kLevel, ball, {{5, 2, 7}, kLevel}, 1.75, -y},
      {"an edge over a plane", PLUMB_PLANE, kLevel, PLUMB_BOX, {{5, 2, 7}, about(z, 45)}, 2 - low, -y},
      {"a capsule over a plane", PLUMB_PLANE, kLevel, PLUMB_CAPSULE, {{5, 3, 7}, kLevel}, 1.75, -y},
      {"a triangle from above", PLUMB_TRIANGLE_MESH, kLevel, ball, {{0.25, 1, 0.25}, kLevel}, 0.75, -y},
      {"a triangle from below", PLUMB_TRIANGLE_MESH, kLevel, ball, {{0.25, -1, 0.25}, kLevel}, 0.75, y},
      {"an edge of a triangle", PLUMB_TRIANGLE_MESH, kLevel, ball, {{-1, 0, 0.25}, kLevel}, 0.75, x},
      {"a corner of a triangle", PLUMB_TRIANGLE_MESH, kLevel, ball, {{2, 0, 0}, kLevel}, 0.75, -x},
      {"a height field from above", PLUMB_HEIGHT_FIELD, kLevel, ball, {{0.25, 2, 0.125}, kLevel}, 1.25, -y},
      {"the border of a height field", PLUMB_HEIGHT_FIELD, kLevel, ball, {{3, 0.5, 0.125}, kLevel}, 1.75, -x},
      {"two spheres that overlap", ball, kLevel, ball, {{0.5, 0, 0}, kLevel}, 0, x},
      {"a box in a box", PLUMB_BOX, kLevel, PLUMB_BOX, {{0.25, 0.25, 0}, kLevel}, 0, x},
      {"a sphere below a plane", PLUMB_PLANE, kLevel, ball, {{0, -5, 0}, kLevel}, 0, x},
      {"a box that a triangle cuts", PLUMB_TRIANGLE_MESH, kLevel, PLUMB_BOX, {{0, 0.25, 0}, kLevel}, 0, x},
  };
}

void closed_forms(Conformance& c) {
  require_any(c);
  for (const Form& one : forms()) {
    const double near = allowed(c, one.probe);
    if (!looks_around(c, one.probe)) continue;
    if (c.backend().capability(PLUMB_CAP_SHAPE, one.body, PLUMB_STATIC) == PLUMB_NONE) continue;
    Probe world(c, kQueryNeeds, Vec::Zero());
    PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
    desc.shape = world.shape(form(one.body));
    desc.pose.orientation = one.body_turn;
    const PlumbBody body = world.body(desc);
    PlumbShapeDesc shape = form(one.probe);
    if (one.probe == PLUMB_SPHERE) shape.radius = 0.25;
    const PlumbClosest row = nearest(world, {world.shape(shape), one.pose, 100, kSeesAll});
    c.expect(row.body == body, "{}: another body than the one there is", one.name);
    c.expect(std::abs(row.distance - one.distance) < near, "{}: {:.7f} m apart instead of {:.7f}", one.name,
             row.distance, one.distance);
    const bool untold = std::isnan(row.normal.x) && std::isnan(row.on_probe.x) && std::isnan(row.on_body.x);
    c.expect(untold == (one.distance == 0), "{}: points and normal are NaN where they touch, and nowhere else",
             one.name);
    if (one.distance == 0 || untold) continue;
    c.expect((vec(row.normal) - one.normal).norm() < 10 * near, "{}: the normal is {:.4f} {:.4f} {:.4f}", one.name,
             row.normal.x, row.normal.y, row.normal.z);
  }
}

void children(Conformance& c) {
  require_any(c);
  c.require(PLUMB_CAP_CLOSEST, PLUMB_SPHERE, 0, "closest bodies of a sphere");
  c.require(PLUMB_CAP_SHAPE, PLUMB_COMPOUND, PLUMB_STATIC, "compounds");
  Probe world(c, kQueryNeeds, Vec::Zero());
  PlumbCompoundChild parts[3] = {};
  for (int i = 0; i < 3; ++i) {
    parts[i].shape = world.sphere(0.5);
    parts[i].pose = {{3.0 * i, 0, 0}, kLevel};
  }
  PlumbShapeDesc compound = shape_desc(PLUMB_COMPOUND);
  compound.children = parts;
  compound.child_count = 3;
  PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
  desc.shape = world.shape(compound);
  const PlumbBody body = world.body(desc);
  const PlumbShape ball = world.sphere(0.25);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const PlumbProbe probe = {ball, {{3.0 * i + 0.25, 2, 0}, kLevel}, 20, kSeesAll};
    const PlumbClosest row = nearest(world, probe);
    c.expect(row.body == body && row.child == i, "near child {} child {} is told", i, row.child);
    const std::vector<PlumbClosest> all = closest(world, PLUMB_HIT_ALL, {&probe, 1});
    c.expect(all.size() == 1, "a body of three children has {} rows instead of one", all.size());
  }
  const PlumbClosest between = nearest(world, {ball, {{1.5, 0, 0}, kLevel}, 20, kSeesAll});
  c.expect(between.child == 0, "between two children that are equally near child {} is told", between.child);
}

// --- against the referee ---------------------------------------------------------------------------------------------

/// Points on both surfaces that far apart say that the distance is no larger, the referee that it is no smaller.
void compare_rows(Conformance& c, PlumbShapeType type, PlumbShapeType at) {
  Target target(c, at);
  const PlumbShape shape = target.probe.shape(convex_desc(type));
  const referee::ShapePtr known = referee::Shape::make(convex_desc(type));
  PlumbShapeDesc grain = shape_desc(PLUMB_SPHERE);
  grain.radius = 1e-9;
  const referee::ShapePtr point = referee::Shape::make(grain);
  const double near = allowed(c, type);
  std::mt19937 random(45);
  std::vector<PlumbProbe> probes;
  for (int i = 0; i < 60; ++i) {
    const Vec place = target.place_about(random, i % 2 == 0 ? 4 : 1.8);
    probes.push_back({shape, {vec3(place), any_turn(random)}, 20, kSeesAll});
  }
  const std::vector<PlumbClosest> rows = closest(target.probe, PLUMB_HIT_CLOSEST, probes);
  int wrong = 0, off = 0, bent = 0, elsewhere = 0, apart = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const PlumbClosest& row = rows[i];
    const referee::Pose pose = referee::pose(probes[i].pose);
    const double truth = std::max(target.distance(*known, pose), 0.0);
    if (row.body != target.body || !(std::abs(row.distance - truth) < near)) {
      ++wrong;
      continue;
    }
    if (row.distance == 0) continue;
    ++apart;
    const Vec on_probe = vec(row.on_probe), on_body = vec(row.on_body), normal = vec(row.normal);
    const double beside = referee::penetration(*point, {referee::Mat3::Identity(), on_probe}, *known, pose).depth;
    if (!(std::abs(beside) < near && std::abs(target.distance(on_body)) < near)) ++off;
    if (!(std::abs(normal.norm() - 1) < near && (on_body - on_probe - row.distance * normal).norm() < near)) ++bent;
    if (target.has_triangles() && target.distance_to_triangle(row.child, on_body) > near) ++elsewhere;
  }
  const char *name = backend::shape_name(type), *of = backend::shape_name(at);
  c.expect(rows.size() == probes.size(), "{} rows for {} probes", rows.size(), probes.size());
  c.expect(wrong == 0, "{} of {} distances of a {} and a {} differ from the referee's", wrong, rows.size(), name, of);
  c.expect(off == 0, "{} of {} points of a {} and a {} are not on the surfaces", off, apart, name, of);
  c.expect(bent == 0, "{} of {} normals of a {} and a {} do not lead from one point to the other", bent, apart, name,
           of);
  c.expect(elsewhere == 0, "{} of {} points are not on the triangle that they tell", elsewhere, apart);
  c.expect(apart > 15, "only {} of {} probes are apart from the {}", apart, rows.size(), of);
}

void every_shape(Conformance& c) {
  require_any(c);
  for (const PlumbShapeType type : kConvex)
    for (const PlumbShapeType at : kTargets)
      if (looks_around(c, type) && c.backend().capability(PLUMB_CAP_SHAPE, at, PLUMB_STATIC) != PLUMB_NONE)
        compare_rows(c, type, at);
}

// --- which bodies, and in which order --------------------------------------------------------------------------------

/// Balls thrown about: the distance to each is a closed form.
struct Balls {
  struct Ball {
    PlumbBody body;
    Vec place;
    double radius;
    PlumbFilter filter;
  };
  Probe probe;
  std::vector<Ball> balls;
  std::mt19937 random{7};

  Balls(Conformance& c, PlumbNeeds more, int count, double spread) : probe(c, kQueryNeeds | more, Vec::Zero()) {
    const PlumbShape shapes[3] = {probe.sphere(0.25), probe.sphere(0.375), probe.sphere(0.5)};
    for (int i = 0; i < count; ++i) {
      PlumbBodyDesc desc = body_desc(i % 3 == 0 ? PLUMB_STATIC : PLUMB_DYNAMIC);
      desc.material.friction = 0;
      const Vec place = somewhere(spread);
      desc.pose.position = vec3(place);
      desc.shape = shapes[i % 3];
      if ((more & PLUMB_NEED_FILTERS) != 0) desc.filter.category = 1U << (i % 4);
      balls.push_back({probe.body(desc), place, 0.25 + 0.125 * (i % 3), desc.filter});
    }
  }
  /// At multiples of 1/64 m, which single precision holds as far as 1e5 m out.
  Vec somewhere(double spread) {
    std::uniform_real_distribution<double> unit(-spread, spread);
    Vec place(unit(random), unit(random), unit(random));
    for (double& at : place) at = std::round(64 * at) / 64;
    return place;
  }
  static double distance(const Ball& ball, const PlumbProbe& probe, double radius) {
    return std::max((ball.place - vec(probe.pose.position)).norm() - ball.radius - radius, 0.0);
  }
  std::vector<PlumbProbe> probes(int count, double spread, double radius) {
    const PlumbShape shape = probe.sphere(radius);
    std::uniform_real_distribution<double> most(0.5, 6);
    std::vector<PlumbProbe> all;
    for (int i = 0; i < count; ++i) all.push_back({shape, {vec3(somewhere(spread)), kLevel}, most(random), kSeesAll});
    return all;
  }
  /// The rows of both modes are those of brute force.
  void compare(Conformance& c, const std::vector<PlumbProbe>& asked, double radius) {
    const double near = allowed(c);
    const std::vector<PlumbClosest> nearest = closest(probe, PLUMB_HIT_CLOSEST, asked),
                                    all = closest(probe, PLUMB_HIT_ALL, asked);
    c.expect(nearest.size() == asked.size(), "{} nearest bodies for {} probes", nearest.size(), asked.size());
    std::size_t next = 0;
    int wrong = 0, missed = 0, unseen = 0, unlike = 0;
    for (std::size_t i = 0; i < asked.size() && i < nearest.size(); ++i) {
      const std::size_t first = next;
      while (next < all.size() && all[next].probe == i) ++next;
      const std::span<const PlumbClosest> rows(all.data() + first, next - first);
      for (const Ball& ball : balls) {
        const auto row =
            std::find_if(rows.begin(), rows.end(), [&](const PlumbClosest& r) { return r.body == ball.body; });
        const double truth = distance(ball, asked[i], radius);
        if (row != rows.end() && !may_touch(asked[i].filter, ball.filter)) ++unseen;
        if (!may_touch(asked[i].filter, ball.filter) || std::abs(truth - asked[i].most_distance) < near) continue;
        if ((row != rows.end()) != (truth < asked[i].most_distance)) ++missed;
        if (row != rows.end() && !(std::abs(row->distance - truth) < near)) ++wrong;
      }
      const PlumbClosest& one = nearest[i];
      if (rows.empty() ? one.body != 0 || !std::isnan(one.distance)
                       : !(std::abs(one.distance - rows[0].distance) < near) || one.probe != i)
        ++unlike;
    }
    c.expect(next == all.size(), "rows are not sorted by probe");
    c.expect(missed == 0, "{} bodies within the distance are not told, or others are", missed);
    c.expect(unseen == 0, "{} bodies are told that the filter hides", unseen);
    c.expect(wrong == 0, "{} of {} distances differ from brute force", wrong, all.size());
    c.expect(unlike == 0, "{} of {} nearest bodies are not the first of all", unlike, asked.size());
  }
};

void all_and_nearest(Conformance& c) {
  require_any(c);
  c.require(PLUMB_CAP_CLOSEST, PLUMB_SPHERE, 0, "closest bodies of a sphere");
  Balls none(c, 0, 0, 1);
  none.compare(c, none.probes(5, 5, 0.25), 0.25);
  Balls some(c, 0, 80, 6);
  const std::vector<PlumbProbe> asked = some.probes(120, 8, 0.25);
  some.compare(c, asked, 0.25);
  // Bodies that were moved, and then one that is gone.
  for (std::size_t i = 0; i < 40; ++i) {
    some.balls[i].place = some.somewhere(6);
    some.probe.write_pose(PLUMB_FIELD_POSE, some.balls[i].body, some.balls[i].place);
  }
  some.compare(c, asked, 0.25);
  some.probe.destroy(some.balls.back().body);
  some.balls.pop_back();
  some.compare(c, asked, 0.25);
}

void filtered(Conformance& c) {
  require_any(c);
  c.require(PLUMB_CAP_CLOSEST, PLUMB_SPHERE, 0, "closest bodies of a sphere");
  Balls some(c, PLUMB_NEED_FILTERS, 60, 5);
  std::vector<PlumbProbe> asked = some.probes(80, 6, 0.25);
  for (std::size_t i = 0; i < asked.size(); ++i) asked[i].filter = {1, 1U << (i % 4) | 1U << (i % 3), 0, 0};
  some.compare(c, asked, 0.25);
}

void unseen_sensors(Conformance& c) {
  require_any(c);
  c.require(PLUMB_CAP_CLOSEST, PLUMB_SPHERE, 0, "closest bodies of a sphere");
  Probe world(c, kQueryNeeds | PLUMB_NEED_SENSORS, Vec::Zero());
  const PlumbShape ball = world.sphere(0.5);
  PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
  desc.shape = ball;
  desc.flags = PLUMB_BODY_SENSOR;
  desc.pose.position = {2, 0, 0};
  world.body(desc);
  const PlumbProbe probe = {ball, {{0, 0, 0}, kLevel}, 10, kSeesAll};
  c.expect(nearest(world, probe).body == 0, "a sensor is seen");
  const PlumbBody solid = world.fixed(ball, {0, 4, 0});
  c.expect(nearest(world, probe).body == solid, "beside a sensor the solid body is not the nearest");
  c.expect(closest(world, PLUMB_HIT_ALL, {&probe, 1}).size() == 1, "a sensor is among all that are near");
}

/// The same world elsewhere, and turned: the same distances.
void other_frames(Conformance& c) {
  require_any(c);
  double near = 0;
  for (const PlumbShapeType type : kConvex) near = std::max(near, allowed(c, type));
  std::vector<double> first;
  for (const Vec& shift : {Vec(0, 0, 0), Vec(1e5, 0, 0), Vec(-5e4, 1e5, 7e4), Vec(0.25, -1000.5, 3)})
    for (const int quarter : {0, 1, 2}) {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(quarter * M_PI / 2, Vec::UnitY()));
      Probe world(c, kQueryNeeds, Vec::Zero());
      std::mt19937 random(17);
      std::uniform_real_distribution<double> unit(-256, 256);
      const auto placed = [&](PlumbQuat q) {
        Vec at(unit(random), unit(random), unit(random));
        for (double& x : at) x = std::round(x) / 64;
        const Eigen::Quaterniond turned = turn * Eigen::Quaterniond(q.w, q.x, q.y, q.z);
        Vec place = turn * at + shift;
        for (double& x : place) x = std::round(64 * x) / 64;
        return PlumbPose{vec3(place), {turned.x(), turned.y(), turned.z(), turned.w()}};
      };
      for (int i = 0; i < 30; ++i) {
        PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
        desc.shape = world.lump(0.5);
        desc.pose = placed(any_turn(random));
        world.body(desc);
      }
      std::vector<PlumbProbe> probes;
      for (const PlumbShapeType type : kConvex)
        for (int i = 0; i < 20 && looks_around(c, type); ++i)
          probes.push_back({world.shape(convex_desc(type)), placed(any_turn(random)), 20, kSeesAll});
      const std::vector<PlumbClosest> rows = closest(world, PLUMB_HIT_CLOSEST, probes);
      int other = 0;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (first.size() < rows.size()) first.push_back(rows[i].distance);
        if (!(std::abs(rows[i].distance - first[i]) < near)) ++other;
        if (rows[i].distance > 0 && !((vec(rows[i].on_body) - vec(probes[i].pose.position)).norm() < 25)) ++other;
      }
      c.expect(other == 0, "{} of {} distances are others at {} {} {}, turned by {} degrees", other, rows.size(),
               shift.x(), shift.y(), shift.z(), 90 * quarter);
    }
}

/// Ten thousand bodies, and thousands of probes in one batch.
void crowd(Conformance& c) {
  require_any(c);
  c.require(PLUMB_CAP_CLOSEST, PLUMB_SPHERE, 0, "closest bodies of a sphere");
  Balls some(c, 0, 10000, 50);
  std::vector<PlumbProbe> asked = some.probes(4000, 55, 0.25);
  const std::vector<PlumbClosest> rows = closest(some.probe, PLUMB_HIT_CLOSEST, asked);
  c.expect(rows.size() == asked.size(), "{} rows for {} probes", rows.size(), asked.size());
  int wrong = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (const Balls::Ball& ball : some.balls) least = std::min(least, Balls::distance(ball, asked[i], 0.25));
    if (std::abs(least - asked[i].most_distance) < allowed(c)) continue;
    const bool found = least < asked[i].most_distance;
    if ((rows[i].body != 0) != found || (found && !(std::abs(rows[i].distance - least) < allowed(c)))) ++wrong;
  }
  c.expect(wrong == 0, "{} of {} nearest of 10000 bodies differ from brute force", wrong, rows.size());
}

// --- refusals --------------------------------------------------------------------------------------------------------

void refusals(Conformance& c) {
  require_any(c);
  const PlumbShapeType type =
      *std::find_if(std::begin(kConvex), std::end(kConvex), [&](PlumbShapeType t) { return looks_around(c, t); });
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  Probe world(c, kQueryNeeds, Vec::Zero());
  const PlumbProbe good = {world.shape(convex_desc(type)), {{0, 0, 0}, kLevel}, 5, kSeesAll};
  const auto refused = [&](const PlumbProbe& bad, const char* words) {
    const PlumbProbe both[2] = {good, bad};
    const ClosestBodies found = world.world().closest()->closest_bodies(PLUMB_HIT_CLOSEST, both);
    const std::string text = world.world().error_text();
    c.expect(found.result < 0 && found.rows.empty(), "a probe whose {} is bad is answered", words);
    c.expect(found.result >= 0 || text.find(words) != std::string::npos, "\"{}\" does not name {}", text, words);
  };
  for (const double most : {0.0, -1.0, kNan, kInfinity}) {
    PlumbProbe bad = good;
    bad.most_distance = most;
    refused(bad, "most_distance");
  }
  PlumbProbe bad = good;
  bad.pose.position.z = kNan;
  refused(bad, "position");
  bad = good;
  bad.pose.orientation.w = 3;
  refused(bad, "orientation");
  bad = good;
  bad.shape = 0;
  refused(bad, "shape");
  for (const PlumbShapeType surface : {PLUMB_PLANE, PLUMB_TRIANGLE_MESH}) {
    if (c.backend().capability(PLUMB_CAP_SHAPE, surface, PLUMB_STATIC) == PLUMB_NONE) continue;
    bad.shape = world.shape(form(surface));
    refused(bad, "convex");
  }
  c.expect(world.world().closest()->closest_bodies(9, {&good, 1}).result < 0, "a mode that is none is answered");
  c.expect(world.world().closest()->closest_bodies(PLUMB_HIT_ALL, {}).result == PLUMB_OK, "no probes are refused");
}

}  // namespace

std::span<const Check> closest_checks() {
  static constexpr Check checks[] = {
      {"closest.forms", "distances and normals against closed forms", &closed_forms},
      {"closest.children", "which child of a compound is nearest", &children},
      {"closest.shapes", "every probe at every shape against the referee", &every_shape},
      {"closest.all", "all bodies near, and the nearest, against brute force", &all_and_nearest},
      {"closest.filtered", "probes see by the filters' rule", &filtered},
      {"closest.sensors", "probes do not see sensors", &unseen_sensors},
      {"closest.frames", "the same distances wherever the world is", &other_frames},
      {"closest.crowd", "ten thousand bodies, four thousand probes", &crowd},
      {"closest.refusals", "probes that make no sense are refused by name", &refusals},
  };
  return checks;
}

}  // namespace plumb::harness::conform
