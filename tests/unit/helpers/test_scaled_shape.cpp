#include "plumb/helpers/scaled_shape.hpp"

#include <array>
#include <cmath>

#include "backend_under_test.hpp"

namespace plumb::helpers::test {
namespace {

const PlumbVec3 kScale = {2, 0.5, 3};

/// A pyramid of base 2 x 2 m in y = 0, 1 m high; seen from outside.
const std::vector<double> kPyramid = {-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1, 0, 1, 0};
const std::vector<std::uint32_t> kFaces = {0, 1, 2, 0, 2, 3, 0, 4, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0};

PlumbShapeDesc pyramid(PlumbShapeType type) {
  PlumbShapeDesc desc = shape_desc(type);
  desc.vertices = kPyramid.data();
  desc.vertex_count = 5;
  desc.indices = kFaces.data();
  desc.triangle_count = 6;
  return desc;
}
/// The body at which a ray from far above ends, and where.
struct Down {
  PlumbBody body;
  double y;
  PlumbVec3 normal;
};
Down look_down(TestWorld& s, double x, double z) {
  const PlumbRay ray = {{x, 20, z}, {0, -40, 0}, {1, ~0U, 0, 0}};
  const PlumbHit hit = s.world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0];
  return {hit.body, 20 - 40 * hit.fraction, hit.normal};
}

TEST(ScaledShape, IsLongerAlongEachAxis) {
  if (!offers(TestWorld::usual | PLUMB_NEED_QUERIES)) GTEST_SKIP() << "the backend has no queries";
  for (const PlumbShapeType type : {PLUMB_CONVEX_HULL, PLUMB_TRIANGLE_MESH}) {
    if (backend_under_test().capability(PLUMB_CAP_SHAPE, type, PLUMB_STATIC) == PLUMB_NONE) continue;
    for (const double mirror : {1.0, -1.0}) {
      TestWorld s({0, 0, 0}, TestWorld::usual | PLUMB_NEED_QUERIES);
      const ScaledShape scaled(pyramid(type), {mirror * kScale.x, kScale.y, kScale.z});
      PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
      desc.shape = s.shape(scaled.desc());
      const PlumbBody body = s.add(desc);
      s.step(1);
      // Half way down the side that looks along x: at x = 1 of 2, the height is half of .5.
      const Down side = look_down(s, 1, 0.1);
      EXPECT_EQ(side.body, body);
      EXPECT_NEAR(side.y, 0.25, 1e-3);
      const double length = std::hypot(0.5, 2);  // of the normal (height, base)
      EXPECT_NEAR(side.normal.x, 0.5 / length, 1e-3) << "outwards, mirrored by " << mirror;
      EXPECT_NEAR(side.normal.y, 2 / length, 1e-3);
      EXPECT_EQ(look_down(s, 0.1, 3.2).body, 0U) << "beyond its end along z";
      EXPECT_EQ(look_down(s, 0.1, 2.8).body, body);
    }
  }
}

TEST(ScaledShape, WeighsByItsVolume) {
  if (backend_under_test().capability(PLUMB_CAP_SHAPE, PLUMB_CONVEX_HULL, PLUMB_DYNAMIC) == PLUMB_NONE)
    GTEST_SKIP() << "the backend has no hulls";
  TestWorld s;
  double masses[2];
  for (int k = 0; k < 2; ++k) {
    const ScaledShape scaled(pyramid(PLUMB_CONVEX_HULL), k == 0 ? PlumbVec3{1, 1, 1} : PlumbVec3{-2, 0.5, 3});
    PlumbBodyDesc desc = body_desc(PLUMB_DYNAMIC);
    desc.shape = s.shape(scaled.desc());
    desc.mass_mode = PLUMB_MASS_FROM_DENSITY;
    desc.density = 100;
    desc.pose.position = {10.0 * k, 0, 0};
    const PlumbBody body = s.add(desc);
    std::array<double, 11> row{};
    check(*s.world, s.world->read(PLUMB_FIELD_MASS, {&body, 1}, rows_over(std::span(&row, 1))));
    masses[k] = row[0];
  }
  EXPECT_NEAR(masses[0], 100 * 4.0 / 3, 1e-3);
  EXPECT_NEAR(masses[1], 3 * masses[0], 1e-3);
}

TEST(ScaledShape, OfMirroredMeshesTrianglesGoRoundTheOtherWay) {
  const ScaledShape mirrored(pyramid(PLUMB_TRIANGLE_MESH), {-1, 2, 1}),
      turned(pyramid(PLUMB_TRIANGLE_MESH), {-1, 2, -1});
  const std::vector<std::uint32_t> indices(mirrored.desc().indices, mirrored.desc().indices + kFaces.size());
  for (std::size_t i = 0; i < kFaces.size(); i += 3) {
    EXPECT_EQ(indices[i], kFaces[i]);
    EXPECT_EQ(indices[i + 1], kFaces[i + 2]);
    EXPECT_EQ(indices[i + 2], kFaces[i + 1]);
  }
  EXPECT_EQ(turned.desc().indices, kFaces.data()) << "twice mirrored is turned";
}

TEST(ScaledShape, OfFieldsAndRoundShapes) {
  const std::vector<double> heights = {0, 1, 2, 3};
  PlumbShapeDesc field = shape_desc(PLUMB_HEIGHT_FIELD);
  field.heights = heights.data();
  field.rows = field.columns = 2;
  field.spacing = {1, 0, 0.5};
  const ScaledShape hills(field, {2, -3, 4});
  EXPECT_EQ(hills.desc().spacing.x, 2);
  EXPECT_EQ(hills.desc().spacing.z, 2);
  EXPECT_EQ(hills.desc().heights[3], -9);
  PlumbShapeDesc round = shape_desc(PLUMB_CYLINDER);
  round.radius = 0.5;
  round.half_height = 2;
  const ScaledShape log(round, {3, 0.25, -3});
  EXPECT_EQ(log.desc().radius, 1.5);
  EXPECT_EQ(log.desc().half_height, 0.5);
  round.type = PLUMB_CAPSULE;
  EXPECT_EQ(ScaledShape(round, {2, 2, 2}).desc().half_height, 4);
  PlumbShapeDesc box = shape_desc(PLUMB_BOX);
  box.half_extents = {1, 2, 3};
  EXPECT_EQ(ScaledShape(box, {-2, 1, 0.5}).desc().half_extents.x, 2);
}

TEST(ScaledShape, RefusesWhatCannotBe) {
  const auto refused = [](PlumbShapeType type, const PlumbVec3& scale, const std::string& words) {
    PlumbShapeDesc desc = pyramid(type);
    desc.radius = 1;
    try {
      const ScaledShape scaled(desc, scale);
      ADD_FAILURE() << "no error: " << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), PLUMB_E_INVALID_ARGUMENT);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused(PLUMB_BOX, {1, 0, 1}, "0 along no axis");
  refused(PLUMB_BOX, {1, std::nan(""), 1}, "finite");
  refused(PLUMB_SPHERE, {1, 2, 1}, "the scale is (1.000000, 2.000000, 1.000000); spheres and capsules stay round");
  refused(PLUMB_CYLINDER, {1, 2, 3}, "a cylinder stays round");
  refused(PLUMB_HEIGHT_FIELD, {-1, 1, 1}, "a height field wants");
  refused(PLUMB_PLANE, {1, -1, 1}, "a plane wants");
  refused(PLUMB_COMPOUND, {1, 1, 1}, "children");
}

}  // namespace
}  // namespace plumb::helpers::test
