// Convex shapes against the triangles of a surface: together they touch as the solid does that the surface bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/mesh_topology.hpp"
#include "narrowphase/collide.hpp"
#include "tests/rigs/shape_scenes.hpp"
#include "tests/rigs/support_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;
using enum ShapeType;

struct Mesh {
  Executor executor{nullptr, 1};
  MeshTopology topology;
  explicit Mesh(const test::TriangleSet& set)
      : topology(executor, {reinterpret_cast<const PlumbVec3*>(set.vertices.data()), set.vertices.size() / 3},
                 set.indices) {}
  [[nodiscard]] MeshView view() const {
    return {topology.places.corners.data(),
            topology.triangles.data(),
            topology.first_neighbour.data(),
            topology.neighbours.data(),
            {nullptr, 0},
            topology.closed ? 1U : 0U,
            {}};
  }
  [[nodiscard]] Shape shape() const { return {kMesh, 0, topology.places.half, topology.places.reach}; }
};

/// The least separation over all triangles, and the normal there; separation kHuge where nothing touches.
struct Nearest {
  double separation = 1e30;
  V normal{0, 0, 0};
};
Nearest over_all(const Mesh& mesh, const Shape& a, const Quat& qa, const Quat& qb, const Vec& d, Real margin,
                 const Hulls& hulls) {
  const MeshView view = mesh.view();
  const Proxies proxies{nullptr, nullptr, hulls, {&view, nullptr, 0}};
  Nearest nearest;
  for (std::uint32_t t = 0; t < mesh.topology.triangles.size(); ++t) {
    Manifold m{};
    if (!collide_with_piece({a, mesh.shape(), qa, qb, d, margin}, proxies, t, m)) continue;
    EXPECT_GT(m.count, 0U);
    for (std::uint32_t i = 0; i < m.count; ++i) {
      const double s = static_cast<double>(m.points[i].separation);
      EXPECT_LE(s, static_cast<double>(margin));
      if (s < nearest.separation) nearest = {s, to_double(m.normal)};
    }
  }
  return nearest;
}

Shape some_shape(Dice& dice, ShapeType type, HullPool& pool) {
  const auto length = [&] { return static_cast<Real>(dice.uniform(0.2, 0.8)); };
  const Real r = length(), h = length();
  switch (type) {
    case kSphere: return {type, 0, {r, 0, 0}, r};
    case kCapsule: return {type, 0, {r, h, 0}, r + h};
    case kCylinder: return {type, 0, {r, h, 0}, sqrt(r * r + h * h)};
    case kBox: return make_box(dice.uniform(0.2, 0.8), dice.uniform(0.2, 0.8), dice.uniform(0.2, 0.8));
    default: return random_hull(dice, pool, 0.8, 14);
  }
}

class Triangles : public ::testing::TestWithParam<ShapeType> {};

/// Outside of a cube and up to a little within: as far apart as from the box, along the same normal where it is one.
TEST_P(Triangles, OfACubeAreTheCube) {
  Dice dice(7 + static_cast<std::uint32_t>(GetParam()));
  int touching = 0, apart = 0, wrong = 0, missed = 0;
  for (int i = 0; i < 1200 && !HasFailure(); ++i) {
    const Mesh mesh(test::cube(1, 1 + dice.below(3)));
    ASSERT_TRUE(mesh.topology.closed);
    HullPool pool;
    const Shape a = some_shape(dice, GetParam(), pool), box = make_box(1, 1, 1);
    const Hulls hulls = pool.host();
    const Quat qa = Dice::to_real(dice.orientation()), qb = Dice::to_real(dice.orientation());
    const Solid solid = {a, &hulls, unit(qa), {0, 0, 0}};
    Solid cube = {box, &hulls, unit(qb), {0, 0, 0}};
    const V way = dice.below(2) == 0 ? dice.direction() : rotate(unit(qb), V{0, dice.below(2) == 0 ? 1.0 : -1.0, 0});
    const double wanted = (dice.below(2) == 0 ? -0.3 : 1) * dice.log_uniform(1e-3, 0.1);
    const V aside = dice.uniform(0, 1) * dice.direction();
    const V d = (solid.high(way) + cube.high(-way) + wanted) * way + (aside - dot(aside, way) * way);
    const Vec rd = {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)};
    cube.at = to_double(rd);
    const Real margin = Real(0.15);
    Manifold m{};
    const bool as_box = collide({a, box, qa, qb, rd, margin}, hulls, m);
    const Nearest nearest = over_all(mesh, a, qa, qb, rd, margin, hulls);
    if (!as_box) {
      EXPECT_GT(nearest.separation, 0.0) << "trial " << i;
      continue;
    }
    double least = 1e30;
    for (std::uint32_t k = 0; k < m.count; ++k) least = std::min(least, static_cast<double>(m.points[k].separation));
    if (least > 0.14 || least < -0.05) continue;
    least > 0 ? ++apart : ++touching;
    SCOPED_TRACE("trial " + std::to_string(i) + " gap " + std::to_string(least));
    // What is apart may be told as a little less far, by a normal of a plane; what overlaps, as a little deeper.
    if (nearest.separation > 1) {
      ++missed;
      EXPECT_GT(least, 0) << "it touches nothing";
      continue;
    }
    if (std::abs(nearest.separation - least) > 0.01) ++wrong;
    EXPECT_LE(nearest.separation, least + 0.02);
    EXPECT_GE(nearest.separation, least - 0.05);
    EXPECT_GE(gap(solid, cube, nearest.normal), least - 0.1) << "no way through the cube";
  }
  EXPECT_GT(touching, 60);
  EXPECT_GT(apart, 80);
  EXPECT_LT(missed, apart / 20) << "near, but not foreseen";
  EXPECT_LT(wrong, (touching + apart) / 10);
}
INSTANTIATE_TEST_SUITE_P(All, Triangles, ::testing::Values(kSphere, kBox, kCapsule, kHull, kCylinder));

/// In the plane of a triangulated square all normals are the plane's, whatever the way over its inner edges.
TEST_P(Triangles, OfAPlaneHaveItsNormal) {
  Dice dice(19);
  const Mesh mesh(test::flat_grid(8, 0.5));
  EXPECT_FALSE(mesh.topology.closed);
  int touching = 0;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    HullPool pool;
    const Shape a = some_shape(dice, GetParam(), pool);
    const Hulls hulls = pool.host();
    const Quat qa = Dice::to_real(dice.orientation());
    const Solid solid = {a, &hulls, unit(qa), {0, 0, 0}};
    const double depth = dice.uniform(-0.05, 0.05);
    const V d = {dice.uniform(-0.8, 0.8), -(solid.high({0, -1, 0})) + depth, dice.uniform(-0.8, 0.8)};
    const Vec rd = {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)};
    const Nearest nearest = over_all(mesh, a, qa, {0, 0, 0, 1}, rd, Real(0.1), hulls);
    SCOPED_TRACE("trial " + std::to_string(i) + " depth " + std::to_string(depth));
    EXPECT_NEAR(nearest.separation, -depth, 2e-3);
    EXPECT_NEAR(nearest.normal.y, -1, 1e-6);
    ++touching;
  }
  EXPECT_EQ(touching, 300);
}

TEST(Topology, FindsNeighboursAndTheCornersAround) {
  const test::TriangleSet set = test::flat_grid(3, 1);
  const Mesh mesh(set);
  const MeshView view = mesh.view();
  EXPECT_EQ(mesh.topology.places.corners.size(), 16U);
  int borders = 0;
  for (std::uint32_t t = 0; t < mesh.topology.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t far = view.across(t, k);
      if (far == kNoCorner) {
        ++borders;
        continue;
      }
      const Triangle triangle = view.triangle(t);
      const Vec p = triangle.at[k], q = triangle.at[(k + 1) % 3], r = triangle.at[(k + 2) % 3], s = view.corner(far);
      EXPECT_LT(dot(cross(q - p, r - p), cross(q - p, s - p)), 0) << "on the other side";
      EXPECT_LT(length(s - Real(0.5) * (p + q)), 1.2) << "and next to it";
    }
  EXPECT_EQ(borders, 12);
}

/// A soup of triangles with corners of their own, of which some zeros are negative.
TEST(Topology, VerticesAtOnePlaceAreOneCorner) {
  const test::TriangleSet shared = test::flat_grid(6, 0.5);
  test::TriangleSet soup;
  for (std::size_t i = 0; i < shared.indices.size(); i += 3) {
    std::uint32_t corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const double* v = &shared.vertices[3 * shared.indices[i + k]];
      const double sign = (i + k) % 2 == 0 ? 1 : -1;
      corner[k] = soup.add(v[0] == 0 ? sign * 0.0 : v[0], v[1] == 0 ? sign * 0.0 : v[1], v[2]);
    }
    soup.triangle(corner[0], corner[1], corner[2]);
  }
  const Mesh one(shared), other(soup);
  ASSERT_EQ(other.topology.places.corners.size(), one.topology.places.corners.size());
  for (std::uint32_t t = 0; t < one.topology.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = one.view().across(t, k), b = other.view().across(t, k);
      ASSERT_EQ(a == kNoCorner, b == kNoCorner) << t << " " << k;
      if (a != kNoCorner) {
        EXPECT_EQ(length(one.view().corner(a) - other.view().corner(b)), 0);
      }
    }
}

/// The view of a height field tells what a mesh of the same triangles does.
TEST(Topology, OfAHeightFieldIsThatOfItsTriangles) {
  constexpr std::uint32_t cells = 4;
  Dice dice(3);
  std::vector<Real> heights;
  test::TriangleSet set = test::grid(cells, 0.5, [&](double, double) {
    heights.push_back(static_cast<Real>(dice.uniform(-0.2, 0.2)));
    return static_cast<double>(heights.back());
  });
  const Mesh mesh(set);
  const MeshView view = mesh.view();
  const HeightView field = {heights.data(), cells + 1, cells + 1, Real(0.5), Real(0.5), Real(-1), Real(-1), {}};
  const Real middle = static_cast<Real>(mesh.topology.places.centre.y);
  const auto same = [&](const Vec& on_mesh, const Vec& on_field) {
    return length(on_mesh + Vec{0, middle, 0} - on_field) < Real(1e-5);
  };
  for (std::uint32_t t = 0; t < 2 * cells * cells; ++t) {
    const Triangle a = view.triangle(t), b = field.triangle(t);
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(same(a.at[k], b.at[k]));
      const std::uint32_t far_a = view.across(t, k), far_b = field.across(t, k);
      ASSERT_EQ(far_a == kNoCorner, far_b == kNoCorner) << t << " " << k;
      if (far_a != kNoCorner) {
        EXPECT_TRUE(same(view.corner(far_a), field.corner(far_b)));
      }
      const auto sum_around = [&](const auto& on, std::uint32_t corner) {
        Vec sum = {0, 0, 0};
        Real count = 0;
        const auto add = [&](std::uint32_t v) {
          sum += on.corner(v);
          count += 1;
          return true;
        };
        on.around(corner, add);
        return std::pair{sum, count};
      };
      const auto [sum_a, count_a] = sum_around(view, a.corner[k]);
      const auto [sum_b, count_b] = sum_around(field, b.corner[k]);
      EXPECT_EQ(count_a, count_b);
      EXPECT_LT(length(sum_a + count_a * Vec{0, middle, 0} - sum_b), 1e-4);
    }
  }
}

}  // namespace
}  // namespace plumb::impulse
