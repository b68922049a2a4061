// Meshes and height fields that become others while bodies have them (plumb.modify/1).
#include <limits>

#include "conform/probe.hpp"
#include "plumb/backend/modify.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::harness::conform {
namespace {

constexpr std::uint32_t kPoints = 17;  // points of a ground, 1 m apart, about the origin
constexpr double kHalf = (kPoints - 1) / 2.0;

/// A square ground as a height field, or as a mesh of the same triangles.
struct Ground {
  explicit Ground(PlumbShapeType of) : type(of), heights(std::size_t{kPoints} * kPoints, 0.0) {}

  /// Within `reach` of a place, m.
  void raise(double x, double z, double reach, double height) {
    for (std::uint32_t i = 0; i < heights.size(); ++i)
      if (std::abs(i % kPoints - kHalf - x) <= reach && std::abs(i / kPoints - kHalf - z) <= reach) heights[i] = height;
  }
  [[nodiscard]] PlumbShapeDesc desc() {
    PlumbShapeDesc desc = shape_desc(type);
    if (type == PLUMB_HEIGHT_FIELD) {
      desc.heights = heights.data();
      desc.rows = desc.columns = kPoints;
      desc.spacing = {1, 0, 1};
      return desc;
    }
    vertices.clear();
    indices.clear();
    for (std::uint32_t i = 0; i < heights.size(); ++i)
      vertices.insert(vertices.end(), {i % kPoints - kHalf, heights[i], i / kPoints - kHalf});
    for (std::uint32_t row = 0; row + 1 < kPoints; ++row)
      for (std::uint32_t column = 0; column + 1 < kPoints; ++column) {
        const std::uint32_t a = row * kPoints + column, b = a + kPoints;
        indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
      }
    desc.vertices = vertices.data();
    desc.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
    desc.indices = indices.data();
    desc.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
    return desc;
  }

  PlumbShapeType type;
  std::vector<double> heights, vertices;
  std::vector<std::uint32_t> indices;
};

PlumbResult try_change(Probe& probe, PlumbShape shape, const PlumbShapeDesc& desc) {
  IModify* modify = probe.world().modify();
  if (modify == nullptr) throw Skipped{"no " PLUMB_EXT_MODIFY};
  return modify->modify_shapes({&shape, 1}, {&desc, 1});
}
void change(Probe& probe, PlumbShape shape, const PlumbShapeDesc& desc) {
  check(probe.world(), try_change(probe, shape, desc));
}
void require_changeable(Conformance& c, PlumbShapeType type) {
  c.require(PLUMB_CAP_MODIFY, 2, type, (std::string("changes of a ") + backend::shape_name(type)).c_str());
}
bool can_change(Conformance& c, PlumbShapeType type) {
  return c.backend().capability(PLUMB_CAP_MODIFY, 2, type) != PLUMB_NONE;
}
/// Whichever the backend can change.
PlumbShapeType changeable(Conformance& c) {
  if (can_change(c, PLUMB_HEIGHT_FIELD)) return PLUMB_HEIGHT_FIELD;
  require_changeable(c, PLUMB_TRIANGLE_MESH);
  return PLUMB_TRIANGLE_MESH;
}

/// A pit opens under one ball, another stays where it lies; then the pit is filled up, and a third ball lies there.
void digs(Conformance& c, PlumbShapeType type) {
  c.require_needs(kPlainNeeds);
  require_changeable(c, type);
  Probe probe(c, kPlainNeeds);
  Ground ground(type);
  const PlumbShape shape = probe.shape(ground.desc());
  probe.fixed(shape, {0, 0, 0});
  const PlumbShape ball = probe.sphere(0.5);
  const PlumbBody falls = probe.dynamic(ball, {0, 0.5, 0}), stays = probe.dynamic(ball, {6, 0.5, 6});
  probe.seconds(1);
  const Vec there = probe.position(stays);
  ground.raise(0, 0, 2, -3);
  change(probe, shape, ground.desc());
  probe.seconds(2);
  c.expect(std::abs(probe.position(falls).y() + 2.5) < 0.05, "the ball over a pit of 3 m lies at {:.3f} m",
           probe.position(falls).y());
  c.expect((probe.position(stays) - there).norm() < 0.01, "a ball beside the pit has moved by {:.4f} m",
           (probe.position(stays) - there).norm());
  probe.destroy(falls);
  ground.raise(0, 0, 2, 0);
  change(probe, shape, ground.desc());
  const PlumbBody later = probe.dynamic(ball, {0, 1, 0});
  probe.seconds(2);
  c.expect(std::abs(probe.position(later).y() - 0.5) < 0.05, "a ball on what was filled up lies at {:.3f} m",
           probe.position(later).y());
}
void digs_in_heights(Conformance& c) { digs(c, PLUMB_HEIGHT_FIELD); }
void digs_in_vertices(Conformance& c) { digs(c, PLUMB_TRIANGLE_MESH); }

/// All bodies that have the shape have what it becomes; a mesh may have other triangles.
void changes_all(Conformance& c) {
  c.require_needs(kPlainNeeds);
  require_changeable(c, PLUMB_TRIANGLE_MESH);
  Probe probe(c, kPlainNeeds);
  Ground ground(PLUMB_TRIANGLE_MESH);
  const PlumbShape shape = probe.shape(ground.desc()), ball = probe.sphere(0.5);
  probe.fixed(shape, {0, 0, 0});
  probe.fixed(shape, {50, 10, 0});
  const PlumbBody one = probe.dynamic(ball, {0, 0.5, 0}), other = probe.dynamic(ball, {50, 10.5, 0});
  probe.seconds(0.5);
  const double corners[] = {-5, -1, -5, -5, -1, 5, 5, -1, -5, 5, -1, 5};
  const std::uint32_t triangles[] = {0, 1, 2, 2, 1, 3};
  PlumbShapeDesc plate = shape_desc(PLUMB_TRIANGLE_MESH);
  plate.vertices = corners;
  plate.vertex_count = 4;
  plate.indices = triangles;
  plate.triangle_count = 2;
  change(probe, shape, plate);
  probe.seconds(2);
  c.expect(std::abs(probe.position(one).y() + 0.5) < 0.05,
           "a ball on a mesh that became two triangles lies at {:.3f} m", probe.position(one).y());
  c.expect(std::abs(probe.position(other).y() - 9.5) < 0.05, "on the second body of the mesh a ball lies at {:.3f} m",
           probe.position(other).y());
}

void wakes_on_ground(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SLEEPING;
  c.require_needs(needs);
  Probe probe(c, needs);
  Ground ground(changeable(c));
  const PlumbShape shape = probe.shape(ground.desc());
  probe.fixed(shape, {0, 0, 0});
  const PlumbBody cube = probe.dynamic(probe.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  const auto awake = [&] { return probe.read(PLUMB_FIELD_AWAKE, cube)[0] != 0; };
  for (int second = 0; second < 20 && awake(); ++second) probe.seconds(1);
  c.expect(!awake(), "a cube at rest did not fall asleep in 20 s");
  ground.raise(0, 0, 2, -1);
  change(probe, shape, ground.desc());
  probe.seconds(1);
  c.expect(probe.position(cube).y() < 0, "a cube that slept where the ground was dug lies at {:.3f} m",
           probe.position(cube).y());
}

void refuses_grounds(Conformance& c) {
  c.require_needs(kPlainNeeds);
  Probe probe(c, kPlainNeeds);
  Ground ground(changeable(c)), dug(ground.type), broken(ground.type);
  const PlumbShape shape = probe.shape(ground.desc()), box = probe.box({1, 1, 1});
  probe.fixed(shape, {0, 0, 0});
  const PlumbBody ball = probe.dynamic(probe.sphere(0.5), {0, 0.5, 0});
  dug.raise(0, 0, 8, -5);
  broken.raise(0, 0, 1, std::numeric_limits<double>::infinity());
  PlumbShapeDesc cube = shape_desc(PLUMB_BOX);
  cube.half_extents = {1, 1, 1};
  c.expect(try_change(probe, shape, cube) == PLUMB_E_INVALID_ARGUMENT, "a ground becomes a box");
  c.expect(try_change(probe, box, cube) == PLUMB_E_UNSUPPORTED, "a box changes");
  c.expect(try_change(probe, 12345, dug.desc()) == PLUMB_E_STALE_HANDLE, "a shape changes that there is not");
  const PlumbShape twice[] = {shape, shape};
  const PlumbShapeDesc descs[] = {dug.desc(), broken.desc()};
  IModify& modify = *probe.world().modify();
  c.expect(modify.modify_shapes(twice, descs) == PLUMB_E_INVALID_ARGUMENT, "a shape changes twice in a call");
  const PlumbShape other = probe.shape(ground.desc());
  const PlumbShape both[] = {shape, other};
  c.expect(modify.modify_shapes(both, descs) == PLUMB_E_INVALID_ARGUMENT, "a ground is infinite");
  probe.seconds(1);
  c.expect(std::abs(probe.position(ball).y() - 0.5) < 0.05, "a call that failed has changed the first shape");
}

void knows_grounds(Conformance& c) {
  const PlumbNeeds needs = kPlainNeeds | PLUMB_NEED_SNAPSHOT;
  c.require_needs(needs);
  c.require(PLUMB_CAP_SNAPSHOT, 0, 0, "snapshots");
  Probe probe(c, needs);
  Ground ground(changeable(c)), dug(ground.type);
  const PlumbShape shape = probe.shape(ground.desc());
  probe.fixed(shape, {0, 0, 0});
  const PlumbBody ball = probe.dynamic(probe.sphere(0.5), {0, 0.5, 0});
  probe.seconds(0.5);
  std::span<const std::byte> saved;
  check(probe.world(), probe.world().snapshot()->save(saved));
  const std::vector<std::byte> before(saved.begin(), saved.end());
  dug.raise(0, 0, 2, -2);
  change(probe, shape, dug.desc());
  c.expect(probe.world().snapshot()->restore(before) == PLUMB_E_CORRUPT,
           "a snapshot is restored over a ground that is another");
  probe.seconds(2);
  change(probe, shape, ground.desc());
  check(probe.world(), probe.world().snapshot()->restore(before));
  probe.seconds(1);
  c.expect(std::abs(probe.position(ball).y() - 0.5) < 0.05,
           "on a ground that is as it was again a ball lies at {:.3f} m", probe.position(ball).y());
}

}  // namespace

std::span<const Check> modify_shape_checks() {
  static constexpr Check checks[] = {
      {"modify.heights", "a pit opens in a height field, and is filled up", &digs_in_heights},
      {"modify.vertices", "a pit opens in a mesh, and is filled up", &digs_in_vertices},
      {"modify.triangles", "a mesh becomes one of other triangles, for all its bodies", &changes_all},
      {"modify.ground_sleep", "what sleeps where the ground changes wakes", &wakes_on_ground},
      {"modify.ground_bad", "what no shape can become is refused, and nothing has changed", &refuses_grounds},
      {"modify.ground_snapshot", "a snapshot over another ground is refused until it is as it was", &knows_grounds},
  };
  return checks;
}

}  // namespace plumb::harness::conform
