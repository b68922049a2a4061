// Meshes and hulls in bytes: the rows that their pools would have, and nothing that was forged leads a kernel astray.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "geometry/hull_pool.hpp"
#include "geometry/surface_pool.hpp"
#include "queries/surface_search.hpp"
#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse {
namespace {

using backend::CookedReader;
using backend::CookedWriter;
using Bytes = std::vector<std::byte>;

/// Some corners twice in a place, a triangle without area, two that lie apart, and a vertex that none has.
test::TriangleSet odd_mesh() {
  test::TriangleSet set = test::grid(6, 0.5, [](double x, double z) { return 0.3 * x * z; });
  set.triangle(3, 3, 7);
  set.triangle(set.add(9, 0, 0), set.add(10, 0, 0), set.add(9, 0, 1));
  set.triangle(set.add(10, 0, 0), set.add(10, 0, 1), set.add(9, 0, 1));
  set.add(20, 0, 0);
  return set;
}

template <class T>
bool same(const T* a, const T* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof(T)) == 0;
}

TEST(CookedMeshes, AreTheRowsOfThePool) {
  Executor executor(nullptr, 2), cook(nullptr, 1);
  SurfacePool pool;
  const test::TriangleSet set = odd_mesh();
  const AddedSurface made = pool.add_mesh(executor, set.desc());
  const Bytes bytes = SurfacePool::cook_mesh(cook, set.desc());
  EXPECT_EQ(bytes, SurfacePool::cook_mesh(executor, set.desc())) << "whatever number of threads";
  CookedReader in(bytes);
  const AddedSurface cooked = pool.add_cooked_mesh(in);
  pool.upload(executor);
  EXPECT_TRUE(same(&made.centre, &cooked.centre, 1));
  EXPECT_TRUE(same(&made.half, &cooked.half, 1));
  EXPECT_EQ(made.reach, cooked.reach);
  const MeshView &a = pool.device().meshes[made.row], &b = pool.device().meshes[cooked.row];
  EXPECT_EQ(a.closed, b.closed);
  ASSERT_EQ(a.tree.leaves, b.tree.leaves);
  const std::uint32_t triangles = a.tree.leaves, corners = 7 * 7 + 5;
  EXPECT_TRUE(same(a.triangles, b.triangles, triangles));
  EXPECT_TRUE(same(a.corners, b.corners, corners));
  ASSERT_TRUE(same(a.first_neighbour, b.first_neighbour, corners + 1));
  EXPECT_TRUE(same(a.neighbours, b.neighbours, a.first_neighbour[corners]));
  for (std::uint32_t i = 0; i < 2 * triangles - 1; ++i) {
    const TreeNode &x = a.tree.nodes[i], &y = b.tree.nodes[i];
    EXPECT_TRUE(same(&x.low, &y.low, 1) && same(&x.high, &y.high, 1) && x.child == y.child && x.next == y.next) << i;
  }
}

/// For a way that ends nowhere.
template <class Note>
struct Steep {
  Note& note;
  double most = 1e6;
  void operator()(std::uint32_t triangle) { note(triangle); }
};

/// Changes of a mesh that was cooked are those of one that was made.
TEST(CookedMeshes, MoveAsOthersDo) {
  Executor executor(nullptr, 1);
  SurfacePool pool;
  test::TriangleSet set = odd_mesh();
  const Bytes bytes = SurfacePool::cook_mesh(executor, set.desc());
  const AddedSurface made = pool.add_mesh(executor, set.desc());
  CookedReader in(bytes);
  const AddedSurface cooked = pool.add_cooked_mesh(in);
  set.vertices[3 * 5 + 1] += 0.25;
  const ChangedSurface one = pool.change_mesh(executor, made.row, set.desc()),
                       other = pool.change_mesh(executor, cooked.row, set.desc());
  EXPECT_FALSE(one.where.is_empty());
  EXPECT_TRUE(same(&one.where, &other.where, 1));
  EXPECT_TRUE(same(&one.now.centre, &other.now.centre, 1));
}

TEST(CookedHulls, AreTheRowsOfThePool) {
  const std::vector<PlumbVec3> points = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},   {-1, -1, 1},
                                         {1, -1, 1},   {-1, 1, 1},  {1, 1, 2},   {0, 0, 0.25}, {0.5, 1, 0}};
  CookedWriter out;
  HullRows(points).cook(out);
  const Bytes bytes = out.take();
  HullPool pool;
  const std::uint32_t made = pool.add(points);
  CookedReader in(bytes);
  const std::uint32_t cooked = pool.add(HullRows(in));
  const Hulls hulls = pool.host();
  const HullRange &a = hulls.ranges[made], &b = hulls.ranges[cooked];
  EXPECT_TRUE(same(&a.centre, &b.centre, 1));
  EXPECT_EQ(a.inner_radius, b.inner_radius);
  ASSERT_TRUE(a.vertex_count == b.vertex_count && a.face_count == b.face_count && a.edge_count == b.edge_count);
  EXPECT_TRUE(same(hulls.vertices + a.first_vertex, hulls.vertices + b.first_vertex, a.vertex_count));
  EXPECT_TRUE(same(hulls.faces + a.first_face, hulls.faces + b.first_face, a.face_count));
  EXPECT_TRUE(same(hulls.edges + a.first_edge, hulls.edges + b.first_edge, a.edge_count));
  const HullFace& last = hulls.faces[a.first_face + a.face_count - 1];
  EXPECT_TRUE(same(hulls.loops + a.first_loop, hulls.loops + b.first_loop, last.first + last.count));
}

/// Words of good bytes are changed at random: by one, or to anything. What is taken for a mesh all the same can be
/// searched, and what it names is there.
TEST(CookedMeshes, ForgedOnesStayInBounds) {
  Executor executor(nullptr, 1);
  const Bytes good = SurfacePool::cook_mesh(executor, odd_mesh().desc());
  std::mt19937 random(1);
  const auto some = [&] { return static_cast<std::uint32_t>(random()); };
  int taken = 0, refused = 0;
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes = good;
    for (std::uint32_t k = 0; k <= some() % 2; ++k) {
      std::uint32_t word = 0;
      std::byte* at = bytes.data() + random() % (bytes.size() / 4) * 4;
      std::memcpy(&word, at, 4);
      const std::uint32_t others[] = {word + 1, word - 1, word ^ 1U, some(), 0, ~0U, 0x7f800000U};
      std::memcpy(at, &others[random() % 7], 4);
    }
    if (random() % 20 == 0) bytes.resize(random() % bytes.size());
    SurfacePool pool;
    try {
      CookedReader in(bytes);
      const AddedSurface added = pool.add_cooked_mesh(in);
      pool.upload(executor);
      const MeshView& mesh = pool.device().meshes[added.row];
      std::size_t found = 0;
      bool finite = true;
      const auto look = [&](std::uint32_t corner) { return finite = finite && is_finite(mesh.corner(corner).y), true; };
      const auto note = [&](std::uint32_t t) {
        ++found;
        const Triangle triangle = mesh.triangle(t);
        for (int k = 0; k < 3; ++k) {
          if (const std::uint32_t across = mesh.across(t, k); across != kNoCorner) look(across);
          mesh.around(triangle.corner[k], look);
        }
      };
      mesh.overlaps({{-100, -100, -100}, {100, 100, 100}}, note);
      EXPECT_LE(found, mesh.tree.leaves);
      std::uint32_t steps = 0;  // of searches that meet some nodes and miss others
      for (int search = 0; search < 20; ++search)
        for (std::uint32_t id = mesh.tree.root(); id != TreeView::kEnd; ++steps) {
          ASSERT_LT(id, 2 * mesh.tree.leaves - 1);
          ASSERT_LT(steps, 40 * mesh.tree.leaves) << "the search never ends";
          id = TreeView::is_inner(id) && some() % 4 != 0 ? mesh.tree.nodes[id].child : mesh.tree.nodes[id].next;
        }
      for (const double x : {-1.0, 0.3, 9.2}) {
        Steep<decltype(note)> steep{note};
        visit_way(mesh, {{x, 50, 0.2}, {0, -1, 0}, {{0, 0, 0}, {0, 0, 0}}}, steep);
      }
      EXPECT_TRUE(finite);
      static_cast<void>(pool.change_mesh(executor, added.row, odd_mesh().desc()));
      ++taken;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), PLUMB_E_CORRUPT);
      ++refused;
    }
  }
  EXPECT_GT(taken, 100) << "other boxes or corners elsewhere are still a mesh";
  EXPECT_GT(refused, 100);
}

TEST(CookedHulls, ForgedOnesStayInBounds) {
  const std::vector<PlumbVec3> points = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, 1, 1}};
  CookedWriter out;
  HullRows(points).cook(out);
  const Bytes good = out.take();
  std::mt19937 random(1);
  const auto some = [&] { return static_cast<std::uint32_t>(random()); };
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes = good;
    const std::uint32_t words[] = {0, 1, 5, 6, 7, 9, ~0U, some(), 0x7f800000U};
    std::memcpy(bytes.data() + random() % (bytes.size() / 4) * 4, &words[random() % 9], 4);
    try {
      CookedReader in(bytes);
      const HullRows hull(in);
      for (const HullFace& face : hull.faces)
        for (std::uint32_t k = 0; k < face.count; ++k) EXPECT_LT(hull.loops.at(face.first + k), hull.vertices.size());
      for (const HullEdge& edge : hull.edges) {
        EXPECT_LT(std::max(edge.from, edge.to), hull.vertices.size());
        EXPECT_LT(std::max(edge.left, edge.right), hull.faces.size());
      }
      HullPool pool;
      EXPECT_GE(pool.reach(pool.add(hull)), 0);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), PLUMB_E_CORRUPT);
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace plumb::impulse
