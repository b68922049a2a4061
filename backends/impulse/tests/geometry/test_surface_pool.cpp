// The trees of meshes and the cells of height fields against brute force: a box finds all triangles that it touches.
#include <gtest/gtest.h>

#include <set>

#include "geometry/surface_pool.hpp"
#include "tests/rigs/narrow_reference.hpp"
#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse {
namespace {

using reference::Dice;

Box bounds(const Triangle& t) { return {min(t.at[0], min(t.at[1], t.at[2])), max(t.at[0], max(t.at[1], t.at[2]))}; }

template <class Surface>
void expect_all_found(const Surface& surface, std::uint32_t triangles, Real size, Dice& dice,
                      const std::set<std::uint32_t>& flat = {}) {
  std::size_t sum = 0;
  for (int i = 0; i < 300; ++i) {
    const auto x = [&](Real most) { return static_cast<Real>(dice.uniform(-1, 1)) * most; };
    const Vec at = {x(1.2F * size), x(0.3F * size), x(1.2F * size)};
    const Vec half = static_cast<Real>(dice.log_uniform(1e-3, 0.5)) * abs(Vec{x(size), x(size), x(size)});
    const Box box = {at - half, at + half};
    std::multiset<std::uint32_t> found, expected;
    const auto note = [&](std::uint32_t t) { found.insert(t); };
    surface.overlaps(box, note);
    for (std::uint32_t t = 0; t < triangles; ++t)
      if (flat.count(t) == 0 && overlap(box, bounds(surface.triangle(t)))) expected.insert(t);
    ASSERT_EQ(found, expected);
    sum += found.size();
  }
  EXPECT_GT(sum, 300U);
}

double hills(double x, double z) { return 0.3 * x * z - 0.1 * x * x; }

TEST(SurfacePool, MeshesAreSearchedAsByBruteForce) {
  Executor executor(nullptr, 2);
  SurfacePool pool;
  test::TriangleSet set = test::grid(20, 0.1, hills);
  set.triangle(3, 3, 7);  // of no area
  const AddedSurface first = pool.add_mesh(executor, test::cube(1, 1).desc());
  const AddedSurface added = pool.add_mesh(executor, set.desc());
  EXPECT_NE(first.row, added.row);
  pool.upload(executor);
  Dice dice(1);
  expect_all_found(pool.device().meshes[added.row], 801, 1, dice, {800});
  pool.remove_mesh(first.row);
  EXPECT_EQ(pool.add_mesh(executor, test::cube(1, 2).desc()).row, first.row) << "rows are used again";
}

TEST(SurfacePool, OneTriangleIsATreeToo) {
  Executor executor(nullptr, 1);
  SurfacePool pool;
  test::TriangleSet set;
  set.triangle(set.add(0, 0, 0), set.add(1, 0, 0), set.add(0, 0, 1));
  const AddedSurface added = pool.add_mesh(executor, set.desc());
  pool.upload(executor);
  EXPECT_NEAR(added.centre.x, 0.5, 1e-12);
  int found = 0;
  const auto note = [&](std::uint32_t) { ++found; };
  pool.device().meshes[added.row].overlaps({{-1, -1, -1}, {1, 1, 1}}, note);
  EXPECT_EQ(found, 1);
}

TEST(SurfacePool, HeightFieldsAreSearchedAsByBruteForce) {
  SurfacePool pool;
  Executor executor(nullptr, 1);
  std::vector<double> heights;
  for (int r = 0; r < 12; ++r)
    for (int c = 0; c < 9; ++c) heights.push_back(hills(0.2 * (c - 4), 0.2 * (r - 5.5)));
  const AddedSurface added = pool.add_field(test::field_desc(heights, 12, 9, 0.2));
  pool.upload(executor);
  Dice dice(2);
  expect_all_found(pool.device().fields[added.row], 2 * 11 * 8, 1, dice);
}

}  // namespace
}  // namespace plumb::impulse
