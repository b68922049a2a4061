// Steps that open a joint are taken back and gone in parts: what is light and short holds when a blow turns it round.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/rigs/drawers.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                              PLUMB_NEED_RESTITUTION | PLUMB_NEED_JOINTS | PLUMB_NEED_GYROSCOPIC;

struct Opened {
  double gap = 0, angle = 0;  ///< the largest of any joint, m, rad
  int repeated = 0;           ///< steps
};

/// A rod that a hinge holds beside a block of a third of its mass, above ground that throws back.
class Flail {
 public:
  explicit Flail(double speed) : scene_(engine(), kNeeds, kDown, 1) {
    scene_.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene_.add_static(scene_.make(shape_desc(PLUMB_PLANE)), {0, -2, 0});
    scene_.body.linear_velocity = {0, -speed, 0};
    scene_.body.mass = 1;
    scene_.body.material.restitution = 0.8;
    hinge_.body_a = scene_.add(scene_.box({0.05, 0.08, 0.1}), {0, 0.87, -0.03});
    scene_.body.mass = 2.7;
    scene_.body.material.restitution = 0;
    hinge_.body_b = scene_.add(scene_.box({0.015, 0.12, 0.015}), {0.08, 1.08, 0.05});
    hinge_.frame_a.position = {0, 0.13, 0.03};
    hinge_.frame_b.position = {-0.08, -0.08, -0.05};
    make(scene_, hinge_);
  }

  Opened run(int steps, double dt) {
    Opened opened;
    for (int i = 0; i < steps; ++i) {
      PlumbStepReport report{};
      check(scene_.world(), scene_.world().step(dt));
      check(scene_.world(), scene_.world().wait(report));
      opened.repeated += (report.remarks & PLUMB_REMARK_STEP_REPEATED) != 0 ? 1 : 0;
      const Frame a = frame(1, hinge_.frame_a), b = frame(2, hinge_.frame_b);
      opened.gap = std::max(opened.gap, (a.at - b.at).norm());
      const Eigen::Vector3d across = (a.turn * Eigen::Vector3d::UnitX()).cross(b.turn * Eigen::Vector3d::UnitX());
      opened.angle = std::max(opened.angle, std::asin(std::min(1.0, across.norm())));
    }
    return opened;
  }

 private:
  struct Frame {
    Eigen::Vector3d at;
    Eigen::Quaterniond turn;
  };
  Frame frame(std::size_t body, const PlumbPose& in_body) {
    const PlumbPose pose = scene_.poses()[body];
    const PlumbQuat& q = pose.orientation;
    const Eigen::Quaterniond turn(q.w, q.x, q.y, q.z);
    const PlumbVec3 &at = pose.position, &in = in_body.position;
    return {Eigen::Vector3d(at.x, at.y, at.z) + turn * Eigen::Vector3d(in.x, in.y, in.z), turn};
  }

  Scene scene_;
  PlumbJointDesc hinge_ = joint_desc(PLUMB_JOINT_HINGE);
};

TEST(OpenedJoints, HoldUnderABlow) {
  int repeated = 0;
  for (const int hertz : {30, 60, 240})
    for (double speed = 0; speed < 12.1; speed += 0.25) {
      SCOPED_TRACE(std::to_string(speed) + " m/s, " + std::to_string(hertz) + " Hz");
      const Opened opened = Flail(speed).run(2 * hertz, 1.0 / hertz);
      // A step may open a joint by 5 mm or .02 rad, and a blow can last for two.
      EXPECT_LT(opened.gap, 0.01);
      EXPECT_LT(opened.angle, 0.04);
      EXPECT_LT(opened.repeated, 8) << "those of blows";
      repeated += opened.repeated;
    }
  EXPECT_GT(repeated, 0);
}

/// A joint that is made open is drawn together; that is no reason to go over a step again.
TEST(OpenedJoints, AreNotThoseThatWereOpen) {
  Scene scene(engine(), kNeeds, kDown, 1);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
  desc.body_b = scene.add(scene.box({0.1, 0.1, 0.1}), {0, 0, 0});
  desc.frame_a.position = {0, 0.5, 0};
  make(scene, desc);
  for (int i = 0; i < 60; ++i) {
    PlumbStepReport report{};
    check(scene.world(), scene.world().step(1.0 / 60));
    check(scene.world(), scene.world().wait(report));
    EXPECT_EQ(report.remarks & PLUMB_REMARK_STEP_REPEATED, 0U) << i;
  }
}

}  // namespace
}  // namespace plumb::impulse::test
