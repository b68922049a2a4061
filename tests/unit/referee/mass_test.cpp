// Mass properties: closed forms, and the backend side's against the referee's, which are worked out by different means.
#include "referee/mass.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "plumb/backend/convex_hull.hpp"
#include "plumb/backend/mass_properties.hpp"
#include "shapes.hpp"

namespace plumb::referee::testing {
namespace {

using backend::MassProperties;
using backend::unit_mass_properties;

Mass of_backend(const MassProperties& unit, double density) {
  const MassProperties p = backend::with_density(unit, density);
  const Mat3 turn = quat(p.inertia_orientation).toRotationMatrix();
  return {p.mass, vec(p.centre_of_mass), turn * vec(p.inertia).asDiagonal() * turn.transpose()};
}

void expect_equal(const Mass& a, const Mass& b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.mass / b.mass, 1, tolerance);
  EXPECT_LE((a.centre - b.centre).norm(), tolerance * (1 + b.centre.norm()));
  EXPECT_LE((a.inertia - b.inertia).norm(), tolerance * b.inertia.norm()) << a.inertia << "\n\n" << b.inertia;
}

PlumbShapeDesc desc_of(PlumbShapeType type, double radius, double half_height, const PlumbVec3& half_extents) {
  PlumbShapeDesc desc = shape_desc(type);
  desc.radius = radius;
  desc.half_height = half_height;
  desc.half_extents = half_extents;
  return desc;
}

TEST(Mass, BoxOfTheCatalogue) {  // A3: half (.5, .25, .1), 100 kg
  const PlumbShapeDesc desc = desc_of(PLUMB_BOX, 0, 0, {0.5, 0.25, 0.1});
  const MassProperties p = backend::with_mass(unit_mass_properties(desc), 100);
  EXPECT_NEAR(p.inertia.x, 2.41666667, 1e-8);
  EXPECT_NEAR(p.inertia.y, 8.66666667, 1e-8);
  EXPECT_NEAR(p.inertia.z, 10.41666667, 1e-8);
  EXPECT_EQ(p.inertia_orientation.w, 1);
  EXPECT_EQ(p.volume, 0.1);
  EXPECT_NEAR(mass_of(*Shape::make(desc), 1000).inertia(2, 2), 10.41666667, 1e-8);
}

// The eight corners of that box, as A3 repeats it: the same numbers in the same order, and the identity exactly.
TEST(Mass, HullOfABoxKeepsTheBoxAxes) {
  const auto corners = box_corners(0.5, 0.25, 0.1);
  const MassProperties p = unit_mass_properties(hull_desc(corners));
  EXPECT_EQ(p.inertia_orientation.x, 0);
  EXPECT_EQ(p.inertia_orientation.y, 0);
  EXPECT_EQ(p.inertia_orientation.z, 0);
  EXPECT_EQ(p.inertia_orientation.w, 1);
  EXPECT_NEAR(p.inertia.x * 1000, 2.41666667, 1e-8);
  EXPECT_NEAR(p.inertia.y * 1000, 8.66666667, 1e-8);
  EXPECT_NEAR(p.inertia.z * 1000, 10.41666667, 1e-8);
}

TEST(Mass, CylinderOfTheCatalogue) {  // A4: r .5, height .2, 1 kg
  const MassProperties p = backend::with_mass(unit_mass_properties(desc_of(PLUMB_CYLINDER, 0.5, 0.1, {})), 1);
  EXPECT_NEAR(p.inertia.x, 0.06583333, 1e-8);
  EXPECT_NEAR(p.inertia.y, 0.125, 1e-15);
}

TEST(Mass, ClosedFormsAgree) {
  for (const PlumbShapeType type : {PLUMB_SPHERE, PLUMB_BOX, PLUMB_CAPSULE, PLUMB_CYLINDER}) {
    const PlumbShapeDesc desc = desc_of(type, 0.3, 0.7, {0.2, 0.5, 0.9});
    expect_equal(of_backend(unit_mass_properties(desc), 700), mass_of(*Shape::make(desc), 700));
  }
  const PlumbShapeDesc ball = desc_of(PLUMB_CAPSULE, 0.5, 0, {});  // no bar: a sphere
  EXPECT_NEAR(unit_mass_properties(ball).inertia.x, 0.4 * std::numbers::pi / 6 * 0.25, 1e-15);
}

// A round shape as a fine hull: the closed forms are those of the round shape, whatever both sides took them from.
TEST(Mass, ClosedFormsAreThoseOfTheShape) {
  for (const PlumbShapeType type : {PLUMB_SPHERE, PLUMB_CAPSULE, PLUMB_CYLINDER}) {
    const ShapePtr shape = Shape::make(desc_of(type, 0.3, 0.7, {}));
    std::vector<double> points;
    for (int i = 0; i < 60; ++i)
      for (int j = 0; j <= 30; ++j) {
        const double around = i * std::numbers::pi / 30, up = (j - 15) * std::numbers::pi / 30;
        const Vec3 d(std::cos(around) * std::cos(up), std::sin(up), std::sin(around) * std::cos(up));
        const Vec3 p = shape->support(d + Vec3(0, (j < 15 ? -1e-9 : 1e-9), 0));
        points.insert(points.end(), {p.x(), p.y(), p.z()});
      }
    const Mass exact = mass_of(*shape, 1), fine = mass_of(*hull(points), 1);
    EXPECT_NEAR(fine.mass / exact.mass, 1, 0.01);
    EXPECT_NEAR(fine.inertia(0, 0) / exact.inertia(0, 0), 1, 0.015);
    EXPECT_NEAR(fine.inertia(1, 1) / exact.inertia(1, 1), 1, 0.015);
  }
}

TEST(Mass, RandomHullsAgree) {
  Random random(31);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> points;
    const Vec3 away = random.vector(i % 2 == 0 ? 0 : 1e4);  // half of them far from their frame's origin
    for (int k = 0; k < 20; ++k) {
      const Vec3 p = away + random.vector(1);
      points.insert(points.end(), {p.x(), p.y(), p.z()});
    }
    const PlumbShapeDesc desc = hull_desc(points);
    expect_equal(of_backend(unit_mass_properties(desc), 3), mass_of(*Shape::make(desc), 3), 1e-10);
  }
}

TEST(Mass, PrincipalAxesAreEigenvectors) {
  Random random(32);
  for (int i = 0; i < 500; ++i) {
    const Mat3 half = (Mat3() << random.vector(1), random.vector(1), random.vector(1)).finished();
    const Mat3 tensor = half * half.transpose();
    backend::Matrix3 plain_tensor;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) plain_tensor.m[r][c] = tensor(r, c);
    const backend::Principal found = backend::principal_axes(plain_tensor);
    const Mat3 turn = quat(found.orientation).toRotationMatrix();
    EXPECT_LE((turn * vec(found.moments).asDiagonal() * turn.transpose() - tensor).norm(), 1e-13 * tensor.norm());
    Vec3 sorted = vec(found.moments);
    std::sort(sorted.begin(), sorted.end());
    EXPECT_LE((sorted - Eigen::SelfAdjointEigenSolver<Mat3>(tensor).eigenvalues()).norm(), 1e-13 * tensor.norm());
  }
}

TEST(Mass, MeshAgreesWithTheBoxItDraws) {
  const auto corners = box_corners(0.5, 0.25, 0.1);
  std::vector<std::uint32_t> faces;
  for (const auto& t : backend::convex_hull(hull_desc(corners)).triangles)
    faces.insert(faces.end(), t.begin(), t.end());
  const PlumbShapeDesc mesh = mesh_desc(corners, faces);
  const Mass box_mass = mass_of(*box(0.5, 0.25, 0.1), 10);
  expect_equal(of_backend(unit_mass_properties(mesh), 10), box_mass);
  expect_equal(mass_of(*Shape::make(mesh), 10), box_mass);

  std::vector<std::uint32_t> open(faces.begin(), faces.end() - 3), inside_out;
  for (std::size_t i = 0; i < faces.size(); i += 3)
    inside_out.insert(inside_out.end(), {faces[i], faces[i + 2], faces[i + 1]});
  EXPECT_THROW((void)unit_mass_properties(mesh_desc(corners, open)), Error);
  EXPECT_THROW((void)unit_mass_properties(mesh_desc(corners, inside_out)), Error);
  EXPECT_THROW((void)mass_of(*Shape::make(mesh_desc(corners, inside_out)), 1), Error);
}

TEST(Mass, CompoundsAgree) {
  Random random(33);
  for (int i = 0; i < 50; ++i) {
    PlumbShapeDesc parts[2] = {desc_of(PLUMB_BOX, 0, 0, {0.2, 0.5, 0.9}), desc_of(PLUMB_CAPSULE, 0.3, 0.7, {})};
    PlumbCompoundChild children[2] = {};
    for (PlumbCompoundChild& child : children) {
      const Pose pose = random.pose(2);
      const Quat q(pose.rotation);
      child.pose = {plain(pose.position), {q.x(), q.y(), q.z(), q.w()}};
    }
    PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
    desc.children = children;
    desc.child_count = 2;
    const MassProperties properties[2] = {unit_mass_properties(parts[0]), unit_mass_properties(parts[1])};
    const ShapePtr shapes[2] = {Shape::make(parts[0]), Shape::make(parts[1])};
    expect_equal(of_backend(unit_mass_properties(desc, properties), 5), mass_of(*Shape::make(desc, shapes), 5));
    EXPECT_THROW((void)unit_mass_properties(desc, std::span(properties, 1)), Error);
  }
}

TEST(Mass, TwoHalvesMakeTheWhole) {
  const PlumbShapeDesc half = desc_of(PLUMB_BOX, 0, 0, {0.5, 0.5, 0.25});
  PlumbCompoundChild children[2] = {};
  children[0].pose = {{0, 0, 0.25}, {0, 0, 0, 1}};
  children[1].pose = {{0, 0, -0.25}, {0, 0, 0, 1}};
  PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
  desc.children = children;
  desc.child_count = 2;
  const MassProperties properties[2] = {unit_mass_properties(half), unit_mass_properties(half)};
  const MassProperties whole = unit_mass_properties(desc, properties);
  EXPECT_NEAR(whole.inertia.x, 1.0 / 6, 1e-15);
  EXPECT_NEAR(whole.inertia.z, 1.0 / 6, 1e-15);
  EXPECT_EQ(whole.inertia_orientation.w, 1);
}

TEST(Mass, NoVolumeNoMass) {
  for (const PlumbShapeType type : {PLUMB_PLANE, PLUMB_HEIGHT_FIELD, PLUMB_SHAPE_TYPE_COUNT})
    EXPECT_THROW((void)unit_mass_properties(shape_desc(type)), Error);
  EXPECT_THROW((void)mass_of(*plane(), 1), Error);
}

TEST(Mass, OfBodies) {
  const ShapePtr cube = box(0.5, 0.5, 0.5);
  PlumbBodyDesc body = body_desc();
  EXPECT_NEAR(mass_of(body, cube.get()).mass, 1000, 1e-12);
  body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  body.mass = 6;
  EXPECT_NEAR(mass_of(body, cube.get()).inertia(0, 0), 1, 1e-15);
  EXPECT_EQ(mass_of(body, nullptr).inertia.norm(), 0);
  body.mass_mode = PLUMB_MASS_EXPLICIT;
  body.inertia = {1, 2, 3};
  body.inertia_orientation = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // a quarter turn about x exchanges y and z
  EXPECT_NEAR(mass_of(body, nullptr).inertia(1, 1), 3, 1e-14);
  const double row[11] = {6, 0, 0, 0, 1, 2, 3, std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  EXPECT_NEAR(mass_of_row(row).inertia(2, 2), 2, 1e-14);
  EXPECT_EQ(mass_of(body_desc(PLUMB_STATIC), cube.get()).mass, 0);
}

}  // namespace
}  // namespace plumb::referee::testing
