#include "tests/hashes/shape_scenes.hpp"

namespace plumb::impulse::test {

PlumbShape make_cylinder(Scene& scene, double radius, double half_height) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
  desc.radius = radius;
  desc.half_height = half_height;
  return scene.make(desc);
}

std::vector<PlumbShape> convex_shapes(Scene& scene) {
  return {scene.sphere(0.25), scene.box({0.2, 0.25, 0.3}), scene.capsule(0.15, 0.2), make_cylinder(scene, 0.25, 0.2),
          scene.hull({{0.3, -0.2, 0}, {-0.2, -0.2, 0.25}, {-0.2, -0.2, -0.25}, {0, 0.3, 0}, {0.1, 0.1, 0.2}})};
}

namespace {

PlumbShape make_compound(Scene& scene, const std::vector<PlumbCompoundChild>& children) {
  PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
  desc.children = children.data();
  desc.child_count = static_cast<std::uint32_t>(children.size());
  return scene.make(desc);
}
PlumbCompoundChild child(PlumbShape shape, const PlumbVec3& position) {
  return {shape, {position, {0, 0, 0, 1}}, 0, 0, {}};
}

constexpr std::uint32_t kCells = 24;
constexpr double kSide = 0.4;
/// Hills of numbers that every machine computes alike.
double hill(std::uint32_t column, std::uint32_t row) {
  const double x = static_cast<double>(column % 8) - 4, z = static_cast<double>(row % 6) - 3;
  return 0.03 * (x * x - 8) + 0.02 * z * z;
}
std::vector<double> hills() {
  std::vector<double> heights;
  for (std::uint32_t row = 0; row <= kCells; ++row)
    for (std::uint32_t column = 0; column <= kCells; ++column) heights.push_back(hill(column, row));
  return heights;
}

/// A material a cell, of those of ice, sand, rubber and the body in turn.
struct Chequers {
  PlumbMaterial materials[3] = {{0.01, 0, {}}, {1.5, 0.1, {}}, {0.7, 0.9, {}}};
  std::vector<std::uint32_t> of;

  Chequers() {
    for (std::uint32_t row = 0; row < kCells; ++row)
      for (std::uint32_t column = 0; column < kCells; ++column) {
        const std::uint32_t which = (row + 3 * column) % 4;
        of.insert(of.end(), 2, which < 3 ? which : PLUMB_BODY_MATERIAL);
      }
  }
  void cover(PlumbShapeDesc& desc) const {
    desc.materials = materials;
    desc.material_count = 3;
    desc.triangle_materials = of.data();
  }
};

PlumbShape make_mesh(Scene& scene, const std::vector<double>& heights, const Chequers* chequers = nullptr,
                     double side = kSide) {
  std::vector<double> vertices;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t row = 0; row <= kCells; ++row)
    for (std::uint32_t column = 0; column <= kCells; ++column) {
      const std::uint32_t near = row * (kCells + 1) + column, far = near + kCells + 1;
      vertices.insert(vertices.end(), {(column - kCells / 2.0) * side, heights[near], (row - kCells / 2.0) * side});
      if (row < kCells && column < kCells) indices.insert(indices.end(), {near, far, near + 1, near + 1, far, far + 1});
    }
  PlumbShapeDesc desc = shape_desc(PLUMB_TRIANGLE_MESH);
  desc.vertices = vertices.data();
  desc.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
  desc.indices = indices.data();
  desc.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
  if (chequers != nullptr) chequers->cover(desc);
  return scene.make(desc);
}
PlumbShape make_field(Scene& scene, const std::vector<double>& heights, const Chequers* chequers = nullptr,
                      double side = kSide) {
  PlumbShapeDesc desc = shape_desc(PLUMB_HEIGHT_FIELD);
  desc.heights = heights.data();
  desc.rows = desc.columns = kCells + 1;
  desc.spacing = {side, 0, side};
  if (chequers != nullptr) chequers->cover(desc);
  return scene.make(desc);
}

}  // namespace

void pile_of_cylinders(Scene& scene) {
  scene.container(3, 20);
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  const PlumbShape drum = make_cylinder(scene, 0.3, 0.25);
  for (int i = 0; i < 5; ++i) scene.add(drum, {-2, 0.25 + 0.5 * i, -2});
  Random random(41);
  for (int i = 0; i < 120; ++i)
    scene.add(i % 2 == 0 ? shapes[3] : shapes[static_cast<std::size_t>(i / 2 % 5)],
              {0.7 * (i % 5) - 1.4, 1 + 0.7 * (i / 25), 0.7 * (i / 5 % 5) - 1.4}, random.turn());
}

void pile_of_compounds(Scene& scene) {
  scene.add_static(scene.make(shape_desc(PLUMB_PLANE)), {0, 0, 0});
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  const PlumbShape dumbbell = make_compound(
      scene, {child(shapes[0], {-0.4, 0, 0}), child(shapes[0], {0.4, 0, 0}), child(shapes[3], {0, 0, 0})});
  std::vector<PlumbCompoundChild> parts = {child(shapes[1], {0, -0.3, 0}), child(shapes[2], {0, 0.2, 0})};
  parts[0].has_material = 1;
  parts[0].material.friction = 0.1;
  const PlumbShape hammer = make_compound(scene, parts);
  Random random(42);
  for (int i = 0; i < 80; ++i)
    scene.add(i % 3 == 0   ? dumbbell
              : i % 3 == 1 ? hammer
                           : shapes[static_cast<std::size_t>(i % 5)],
              {1.1 * (i % 4) - 1.6, 1 + 1.1 * (i / 16), 1.1 * (i / 4 % 4) - 1.6}, random.turn());
}

void pile_on_surfaces(Scene& scene) {
  const std::vector<double> heights = hills();
  const PlumbShape mesh = make_mesh(scene, heights);
  scene.add_static(mesh, {0, 0, 0});
  scene.add_static(make_field(scene, heights), {kCells * kSide, 0, 0});
  const PlumbBody lift = scene.add_kinematic(mesh, {0, 0, -kCells * kSide});
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  Random random(43);
  for (int i = 0; i < 150; ++i) {
    const PlumbQuat turn = random.turn();
    scene.add(shapes[static_cast<std::size_t>(i % 5)], {random.between(-3, 12), 1 + 0.05 * i, random.between(-8, 3)},
              turn);
  }
  scene.before_step = [lift](Scene& moved, int step) {
    moved.target(lift, {0, 0.004 * (step + 1), -kCells * kSide + 0.002 * (step + 1)});
  };
}

void chequers(Scene& scene) {
  const Chequers chequers;
  const std::vector<double> level(std::size_t{kCells + 1} * (kCells + 1), 0.0);
  scene.add_static(make_mesh(scene, level, &chequers), {0, 0, 0});
  scene.add_static(make_field(scene, hills(), &chequers), {kCells * kSide, 0, 0});
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  Random random(53);
  for (int i = 0; i < 120; ++i) {
    scene.body.flags = 0;
    if (i % 7 == 0)
      scene.body.flags = PLUMB_BODY_CCD;
    else if (i % 11 == 0)
      scene.body.flags = PLUMB_BODY_ASLEEP;
    scene.body.linear_velocity = {random.between(-6, 6), i % 7 == 0 ? -60.0 : 0.0, random.between(-6, 6)};
    const PlumbQuat turn = random.turn();
    scene.add(shapes[static_cast<std::size_t>(i % 5)], {random.between(-3, 12), 1 + 0.05 * i, random.between(-3, 3)},
              turn);
  }
}

void bumps(Scene& scene) {
  constexpr double kFine = 0.12;
  std::vector<double> heights = hills();
  for (double& height : heights) height *= 0.05;
  scene.add_static(make_mesh(scene, heights, nullptr, kFine), {0, 0, 0});
  const PlumbBody tray = scene.add_kinematic(make_field(scene, heights, nullptr, kFine), {kCells * kFine, 0, 0});
  const PlumbShape shapes[] = {scene.box({0.5, 0.1, 0.4}), make_cylinder(scene, 0.4, 0.15), scene.box({0.3, 0.3, 0.3}),
                               scene.hull({{0.5, -0.2, 0}, {-0.2, -0.2, 0.5}, {-0.2, -0.2, -0.5}, {0, 0.3, 0}})};
  Random random(59);
  for (int i = 0; i < 60; ++i) {
    scene.body.material.friction = i % 5 == 0 ? 0 : 0.6;
    const PlumbVec3 at = {random.between(-1, 4), 0.4 + 0.08 * i, random.between(-1, 1)};
    scene.add(shapes[i % 4], at, i % 3 == 0 ? random.turn() : PlumbQuat{0, 0, 0, 1});
  }
  scene.before_step = [tray](Scene& moved, int step) {
    moved.target(tray, {kCells * kFine, 0.001 * (step + 1), 0.002 * (step + 1)});
  };
}

void sheets(Scene& scene) {
  const std::vector<double> heights = hills();
  const PlumbShape mesh = make_mesh(scene, heights);
  constexpr double kHalf = 0.70710678118654752;
  scene.add_static(mesh, {0, 0, 0});
  scene.add_static(mesh, {6, 3, 0}, {0, 0, kHalf, kHalf});  // upright
  scene.add_static(make_field(scene, heights), {0, -4, 0});
  scene.add_static(scene.make(shape_desc(PLUMB_PLANE)), {0, -6, 0});
  const PlumbBody door = scene.add_kinematic(mesh, {0, 3, -9});
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  scene.body.flags = PLUMB_BODY_CCD;
  Random random(47);
  for (int i = 0; i < 60; ++i) {
    const double speed = random.between(30, 250);
    scene.body.linear_velocity = {i % 3 == 0 ? speed : 0, i % 3 == 1 ? -speed : 0, i % 3 == 2 ? -speed : 0};
    scene.body.angular_velocity = {random.between(-40, 40), random.between(-40, 40), random.between(-40, 40)};
    const PlumbQuat turn = random.turn();
    scene.add(shapes[static_cast<std::size_t>(i % 5)],
              {random.between(-3, 3), random.between(1.5, 5), random.between(-3, 3)}, turn);
  }
  scene.before_step = [door](Scene& moved, int step) {
    moved.target(door, {0, 3 - 0.02 * step, -9 + 0.05 * step}, {kHalf, 0, 0, kHalf});
  };
}

void boulders(Scene& scene) {
  scene.add_static(make_field(scene, hills()), {0, 0, 0});
  std::vector<PlumbVec3> corners;
  Random random(44);
  for (int i = 0; i < 200; ++i) {
    const PlumbQuat q = random.turn();  // its z axis is uniform over the sphere
    corners.push_back({0.8 * (q.x * q.z + q.w * q.y), 0.6 * (q.y * q.z - q.w * q.x),
                       0.35 * (q.w * q.w - q.x * q.x - q.y * q.y + q.z * q.z)});
  }
  const PlumbShape stone = scene.hull(corners);
  const std::vector<PlumbShape> shapes = convex_shapes(scene);
  for (int i = 0; i < 32; ++i)
    scene.add(i % 3 == 0 ? shapes[static_cast<std::size_t>(i / 3 % 5)] : stone,
              {1.1 * (i % 3) - 1.1, 1 + 1.1 * (i / 9), 1.1 * (i / 3 % 3) - 1.1}, random.turn());
}

}  // namespace plumb::impulse::test
