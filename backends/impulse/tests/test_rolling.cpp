// Round bodies that roll: each turns by several degrees within a step, and none may rise or be let fall for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr double kRadius = 0.5, kSpeed = 3, kGravity = 9.81, kStep = 1.0 / 60;

PlumbShape cylinder(Scene& scene) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
  desc.radius = kRadius;
  desc.half_height = 1;
  return scene.make(desc);
}

PlumbShape plane(Scene& scene) {
  PlumbShapeDesc desc = shape_desc(PLUMB_PLANE);
  return scene.make(desc);
}

/// The ground: a box, or a plane whose shape has the ground's side as its own y.
enum class Ground { kBox, kPlane };

struct Case {
  const char* name;
  PlumbShapeType type;
  const char* solver;
  Ground ground;
};

class Rolling : public ::testing::TestWithParam<Case> {
 protected:
  Rolling()
      : scene_(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION, {0, -kGravity, 0}, 1,
               {"solver", GetParam().solver}) {}

  PlumbShape roller() {
    if (GetParam().type == PLUMB_SPHERE) return scene_.sphere(kRadius);
    return GetParam().type == PLUMB_CAPSULE ? scene_.capsule(kRadius, 1) : cylinder(scene_);
  }
  void lay_ground() {
    if (GetParam().ground == Ground::kBox)
      scene_.ground();
    else
      scene_.add_static(plane(scene_), {0, 0, 0});
  }

  Scene scene_;
};

TEST_P(Rolling, NeitherRisesNorFallsNorSlows) {
  lay_ground();
  scene_.body.linear_velocity = {kSpeed, 0, 0};
  scene_.body.angular_velocity = {0, 0, -kSpeed / kRadius};
  const double half = std::sqrt(0.5);
  const PlumbBody body = scene_.add(roller(), {0, kRadius, 0}, {half, 0, 0, half});  // its axis along z
  double fall = 0;
  for (int i = 0; i < 120; ++i) {
    scene_.run(1);
    fall = std::max(fall, std::abs(scene_.velocity(body)[1]));
  }
  EXPECT_LT(fall, 0.01 * kGravity * kStep);
  EXPECT_NEAR(scene_.velocity(body)[0], kSpeed, 1e-3 * kSpeed);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* solver : {"tgs_soft", "si", "jacobi", "xpbd"})
    for (const auto& [name, type] :
         {std::pair{"ball", PLUMB_SPHERE}, {"capsule", PLUMB_CAPSULE}, {"cylinder", PLUMB_CYLINDER}})
      for (const Ground ground : {Ground::kBox, Ground::kPlane}) all.push_back({name, type, solver, ground});
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Rolling, ::testing::ValuesIn(cases()), [](const auto& a_case) {
  return std::string(a_case.param.solver) + "_" + a_case.param.name +
         (a_case.param.ground == Ground::kBox ? "_on_box" : "_on_plane");
});

}  // namespace
}  // namespace plumb::impulse::test
