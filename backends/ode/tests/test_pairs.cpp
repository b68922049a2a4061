// The declared matrix of shape pairs against the fact: every shape is dropped on every other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plumb/backend/names.hpp"
#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

/// A shape of about size `half`, and how far its top (or bottom) is from its origin when it stands.
struct Sample {
  PlumbShape shape;
  double reach;
};

Sample make(const TestWorld& world, PlumbShapeType type, double half) {
  PlumbShapeDesc desc = shape_desc(type);
  desc.radius = desc.half_height = half;
  desc.half_extents = {half, half, half};
  double corners[24];
  for (int i = 0; i < 24; ++i) corners[i] = ((i / 3) >> (i % 3) & 1) != 0 ? half : -half;
  const std::uint32_t triangles[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  const double heights[25] = {};
  PlumbCompoundChild children[2]{};
  desc.vertices = corners;
  desc.vertex_count = 8;
  desc.indices = triangles;
  desc.triangle_count = 12;
  desc.heights = heights;
  desc.rows = desc.columns = 5;
  desc.spacing = {half * .9, 0, half * .9};
  if (type == PLUMB_COMPOUND) {
    const PlumbShape part = world.box(half / 2, half, half);
    for (int i = 0; i < 2; ++i) children[i] = {part, {{(i - .5) * half, 0, 0}, {0, 0, 0, 1}}, 0, 0, {}};
    desc.children = children;
    desc.child_count = 2;
  }
  const bool flat = type == PLUMB_HEIGHT_FIELD || type == PLUMB_PLANE;
  return {world.shape(desc), flat ? 0 : type == PLUMB_CAPSULE ? 2 * half : half};
}

struct Rest {
  bool touched = false;
  double sink = 0, tilt = 0;
  double wander = 0;  ///< m, in the last second
};

/// 5 s of a small `upper` let go a centimetre above a large `lower`; lying: on its side where it has one.
Rest drop(PlumbShapeType upper, PlumbShapeType lower, bool lying) {
  const TestWorld world(usual_needs | PLUMB_NEED_CONTACTS);
  const Sample base = make(world, lower, 2), load = make(world, upper, .5);
  world.fixed(base.shape);
  PlumbBodyDesc desc = body_desc();
  desc.shape = load.shape;
  const double reach = lying ? .5 : load.reach;
  desc.pose.position.y = base.reach + reach + .01;
  const double half_turn = lying ? std::sqrt(.5) : 0;
  desc.pose.orientation = {0, 0, half_turn, lying ? half_turn : 1};
  const PlumbBody body = world.body(desc);
  Rest rest;
  PlumbVec3 settled{};
  for (int i = 0; i < 300; ++i) {
    world.step();
    rest.touched = rest.touched || !world->contacts().empty();
    const PlumbVec3 at = world.position(body);
    if (i == 240) settled = at;
    if (i > 240) rest.wander = std::max(rest.wander, std::hypot(at.x - settled.x, at.y - settled.y, at.z - settled.z));
  }
  const auto pose = world.row(body, PLUMB_FIELD_POSE);
  const PlumbQuat& q = desc.pose.orientation;
  const double cosine = std::abs(q.x * pose[3] + q.y * pose[4] + q.z * pose[5] + q.w * pose[6]);
  rest.sink = base.reach + reach - pose[1];
  rest.tilt = 2 * std::acos(std::min(1.0, cosine));
  return rest;
}

bool has_side(PlumbShapeType type) { return type == PLUMB_CAPSULE || type == PLUMB_CYLINDER; }

/// Stands where it was put. ODE has no slop: a contact that is just closed opens for a step now and then, in which the
/// body falls by g dt^2, 2.7 mm. So no more than one and a half times that is a rest, and speed says nothing.
bool rests(const Rest& rest) {
  constexpr double hop = 1.5 * 9.81 * dt * dt;
  return rest.touched && std::abs(rest.sink) < hop && rest.tilt < .005 && rest.wander < hop;
}

class Pairs : public testing::TestWithParam<std::tuple<PlumbShapeType, PlumbShapeType>> {};

TEST_P(Pairs, AreAsDeclared) {
  const auto [upper, lower] = GetParam();
  if (ode().capability(PLUMB_CAP_SHAPE, upper, PLUMB_DYNAMIC) == PLUMB_NONE) GTEST_SKIP() << "never dynamic";
  const PlumbDegree declared = ode().capability(PLUMB_CAP_PAIR, upper, lower);
  EXPECT_EQ(declared, ode().capability(PLUMB_CAP_PAIR, lower, upper));
  // A mesh is given a mass of its own by its closed surface; a compound is made of boxes here.
  const Rest standing = drop(upper, lower, false);
  EXPECT_EQ(standing.touched, declared != PLUMB_NONE);
  if (declared < PLUMB_EMULATED) return;
  EXPECT_TRUE(rests(standing)) << "sink " << standing.sink << " tilt " << standing.tilt << " wander "
                               << standing.wander;
  // On a rounded base a shape that lies rolls off; what it does then is no matter of contacts.
  if (!has_side(upper) || has_side(lower) || lower == PLUMB_SPHERE) return;
  const Rest lying = drop(upper, lower, true);
  EXPECT_TRUE(rests(lying)) << "lying: sink " << lying.sink << " tilt " << lying.tilt << " wander " << lying.wander;
}

std::string pair_name(const testing::TestParamInfo<std::tuple<PlumbShapeType, PlumbShapeType>>& info) {
  std::string name =
      std::string(backend::shape_name(std::get<0>(info.param))) + "_on_" + backend::shape_name(std::get<1>(info.param));
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Every, Pairs,
                         testing::Combine(testing::Range<PlumbShapeType>(0, PLUMB_SHAPE_TYPE_COUNT),
                                          testing::Range<PlumbShapeType>(0, PLUMB_SHAPE_TYPE_COUNT)),
                         pair_name);

}  // namespace
}  // namespace plumb::ode_test
