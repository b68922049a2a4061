// Boxes and hulls against libccd (Fiser), which shares no idea with the engine: GJK with EPA, and portals (MPR).
#include <ccd/ccd.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;
using enum ShapeType;

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const auto& p = *static_cast<const Polyhedron*>(object);
  const V n = {direction->v[0], direction->v[1], direction->v[2]};
  const V* best = &p.vertices[0];
  for (const V& v : p.vertices)
    if (dot(n, v) > dot(n, *best)) best = &v;
  ccdVec3Set(out, best->x, best->y, best->z);
}
void centre(const void* object, ccd_vec3_t* out) {
  const auto& p = *static_cast<const Polyhedron*>(object);
  V sum = {0, 0, 0};
  for (const V& v : p.vertices) sum += v;
  sum = (1 / static_cast<double>(p.vertices.size())) * sum;
  ccdVec3Set(out, sum.x, sum.y, sum.z);
}

TEST(AgainstLibccd, OverlapAndDepthAgree) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.center1 = ccd.center2 = centre;
  ccd.max_iterations = 200;
  ccd.epa_tolerance = 1e-6;
  ccd.mpr_tolerance = 1e-6;

  Dice dice(11);
  int overlapping = 0, same_depth = 0, answers = 0;
  for (int batch = 0; batch < 100; ++batch) {
    HullPool pool;
    Shape shapes[6];
    for (int k = 0; k < 6; ++k)
      shapes[k] = k < 3 ? make_box(dice.uniform(0.2, 1), dice.uniform(0.2, 1), dice.uniform(0.2, 1))
                        : random_hull(dice, pool, 1, 16);
    for (int i = 0; i < 100; ++i) {
      RandomPair p = {shapes[dice.below(6)],
                      shapes[dice.below(6)],
                      Dice::to_real(dice.orientation()),
                      Dice::to_real(dice.orientation()),
                      {}};
      const V d = dice.uniform(0.2, 2) * dice.direction();
      p.d = {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)};
      Manifold m{};
      const bool touch = collide({p.a, p.b, p.qa, p.qb, p.d, 0}, pool.host(), m);
      const Polyhedron a = polyhedron(p.a, pool.host(), p.qa, {0, 0, 0}), b = polyhedron(p.b, pool.host(), p.qb, p.d);
      double depth = 0;
      for (std::uint32_t k = 0; k < m.count; ++k) depth = std::max(depth, -static_cast<double>(m.points[k].separation));

      const double edge = 1e-4;  // shallower than this libccd may go either way
      const bool mpr = ccdMPRIntersect(&a, &b, &ccd) != 0;
      EXPECT_TRUE(touch == mpr || depth < edge) << "MPR, depth " << depth;
      if (!touch || depth < edge) continue;
      ++overlapping;
      ccd_real_t their_depth;
      ccd_vec3_t direction, position;
      if (ccdMPRPenetration(&a, &b, &ccd, &their_depth, &direction, &position) == 0) {
        EXPECT_LE(depth, their_depth + edge) << "MPR finds a way out along its portal, none shorter than the shortest";
      }
      if (ccdGJKPenetration(&a, &b, &ccd, &their_depth, &direction, &position) == 0) {
        ++answers;
        EXPECT_LE(their_depth, depth + edge) << "EPA grows towards the least depth from within";
        same_depth += std::abs(depth - their_depth) < edge ? 1 : 0;
      }
    }
  }
  EXPECT_GT(overlapping, 2000);
  // EPA gives up early at times.
  EXPECT_GT(answers, 0.9 * overlapping);
  EXPECT_GT(same_depth, 0.95 * answers);
}

}  // namespace
}  // namespace plumb::impulse
