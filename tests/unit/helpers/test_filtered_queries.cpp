#include "plumb/helpers/filtered_queries.hpp"

#include <string>

#include "backend_under_test.hpp"

namespace plumb::helpers::test {
namespace {

bool casts_spheres() {
  return backend_under_test().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_SPHERE) != PLUMB_NONE;
}
bool overlaps_spheres() {
  return backend_under_test().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_OVERLAP, PLUMB_SPHERE) != PLUMB_NONE;
}
#define NEEDS_QUERIES() \
  if (!offers(PLUMB_NEED_QUERIES)) GTEST_SKIP() << "the backend has no queries"

constexpr PlumbFilter kAll{1, 0xffffffffu, 0, 0};

/// Ten cubes in a row along x, 2 m apart, and a clear row beside them.
struct Row : TestWorld {
  Row() : TestWorld({0, 0, 0}) {
    for (int i = 0; i < 10; ++i) cubes.push_back(box(PLUMB_DYNAMIC, {0.5, 0.5, 0.5}, {2.0 * i, 0, 0}));
    step(1.0 / 60);
  }
  std::vector<PlumbBody> cubes;
};

TEST(FilteredQueries, RaysPassThroughWhoIsLeftOut) {
  NEEDS_QUERIES();
  Row row;
  const std::vector<PlumbRay> rays{
      {{-3, 0, 0}, {30, 0, 0}, kAll}, {{-3, 5, 0}, {30, 0, 0}, kAll}, {{30, 0.1, 0}, {-60, 0, 0}, kAll}};
  for (std::size_t out = 0; out <= row.cubes.size(); ++out) {
    const auto hits = closest_hits(*row.world, rays, all_but(std::span(row.cubes).first(out)));
    ASSERT_EQ(hits.size(), 3u);
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(hits[i].query, i);
    EXPECT_EQ(hits[0].body, out < 10 ? row.cubes[out] : 0u);
    EXPECT_EQ(hits[1].body, 0u);
    EXPECT_EQ(hits[2].body, out < 10 ? row.cubes[9] : 0u);
    if (out < 10) {
      EXPECT_NEAR(hits[0].fraction, (2.5 + 2.0 * static_cast<double>(out)) / 30, 1e-4);
      EXPECT_NEAR(hits[0].normal.x, -1, 1e-4);
    }
  }
}

TEST(FilteredQueries, CastsEndAtTheNearestThatCounts) {
  NEEDS_QUERIES();
  if (!casts_spheres()) GTEST_SKIP() << "the backend casts no spheres";
  Row row;
  PlumbShapeDesc sphere = shape_desc(PLUMB_SPHERE);
  sphere.radius = 0.25;
  const PlumbCast cast{row.shape(sphere), {{-3, 0.2, 0}, {0, 0, 0, 1}}, {30, 0, 0}, kAll};
  const auto behind = [](const PlumbHit& hit) { return hit.position.x > 7; };
  const auto hits = closest_hits(*row.world, std::span(&cast, 1), behind);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].body, row.cubes[4]);
  EXPECT_NEAR(hits[0].fraction * 30, 3 + 7.5 - 0.25, 1e-2);
}

TEST(FilteredQueries, OverlapsLeaveOutWhoAsks) {
  NEEDS_QUERIES();
  if (!overlaps_spheres()) GTEST_SKIP() << "the backend overlaps no spheres";
  Row row;
  PlumbShapeDesc sphere = shape_desc(PLUMB_SPHERE);
  sphere.radius = 3;
  const PlumbOverlap all{row.shape(sphere), {{4, 0, 0}, {0, 0, 0, 1}}, kAll};
  const auto found = overlaps(*row.world, std::span(&all, 1), all_but(std::span(row.cubes).subspan(2, 1)));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].body, row.cubes[1]);
  EXPECT_EQ(found[1].body, row.cubes[3]);
}

TEST(FilteredQueries, DepthsLeaveOutWhoAsks) {
  NEEDS_QUERIES();
  if (backend_under_test().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_PENETRATION, PLUMB_SPHERE) == PLUMB_NONE)
    GTEST_SKIP() << "the backend does not tell how deep spheres overlap";
  Row row;
  PlumbShapeDesc sphere = shape_desc(PLUMB_SPHERE);
  sphere.radius = 1;
  const PlumbOverlap all{row.shape(sphere), {{4.75, 0, 0}, {0, 0, 0, 1}}, kAll};
  const auto found = penetrations(*row.world, std::span(&all, 1), all_but({}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].body, row.cubes[2]) << "the deepest is not first";
  EXPECT_NEAR(found[0].depth, 0.75, 1e-3);
  EXPECT_NEAR(found[0].normal.x, 1, 1e-3);
  const auto others = penetrations(*row.world, std::span(&all, 1), all_but(std::span(row.cubes).subspan(2, 1)));
  ASSERT_EQ(others.size(), 1u);
  EXPECT_EQ(others[0].body, row.cubes[3]);
  EXPECT_NEAR(others[0].depth, 0.25, 1e-3);
  EXPECT_NEAR(others[0].normal.x, -1, 1e-3);
}

TEST(FilteredQueries, AWorldWithoutQueriesIsSaid) {
  TestWorld t({0, 0, 0}, PLUMB_NEED_COLLISION);
  const PlumbRay ray{{0, 0, 0}, {1, 0, 0}, kAll};
  try {
    (void)closest_hits(*t.world, std::span(&ray, 1), all_but({}));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("PLUMB_NEED_QUERIES"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace plumb::helpers::test
