// A scene that is written as a model is the same machine to MuJoCo.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "convert/mjcf/mjcf_types.hpp"
#include "convert/mjcf/read_mjcf.hpp"
#include "convert/upright.hpp"
#include "convert/write/write_mjcf.hpp"
#include "machine_files.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness::testing {
namespace {

Imported through_mjcf(const Scene& scene) {
  Remarks remarks;
  return read_mjcf({write_file("m.xml", write_mjcf(scene, "m", remarks)), {}});
}

const SceneJoint* find_joint(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.joints.begin(), scene.joints.end(),
                                  [&](const SceneJoint& joint) { return joint.name == name; });
  return found == scene.joints.end() ? nullptr : &*found;
}

class WrittenModel : public ::testing::TestWithParam<const char*> {};

TEST_P(WrittenModel, IsTheSameMachine) {
  const Scene before = scene_of(GetParam());
  const Scene after = through_mjcf(before).scene;
  EXPECT_LT((referee::vec(before.gravity) - referee::vec(after.gravity)).norm(), 1e-12);
  EXPECT_EQ(before.dt, after.dt);
  for (std::size_t i = 0; i < before.bodies.size(); ++i) {
    const SceneBody& body = before.bodies[i];
    if (body.desc.motion != PLUMB_DYNAMIC) continue;  // what stands is one body to the reader
    const std::size_t other = after.body(body.name);
    expect_same(referee::pose(body.desc.pose), referee::pose(after.bodies[other].desc.pose), 1e-9, body.name);
    expect_same(mass_of_body(before, i), mass_of_body(after, other), 1e-8, body.name);
    if (!body.shape) continue;
    EXPECT_EQ(body.desc.material.friction, after.bodies[other].desc.material.friction) << body.name;
    const referee::Aabb one = shape_of(before, *body.shape)->bounds(referee::pose(body.desc.pose));
    const referee::Aabb two =
        shape_of(after, *after.bodies[other].shape)->bounds(referee::pose(after.bodies[other].desc.pose));
    EXPECT_LT((one.low - two.low).norm() + (one.high - two.high).norm(), 1e-5) << body.name;
  }
  std::size_t same = 0;
  for (const SceneJoint& joint : before.joints) {
    const SceneJoint* const other = find_joint(after, joint.name);
    if (other == nullptr) continue;  // of several axes, or one that closes a loop
    ++same;
    EXPECT_EQ(joint.desc.type, other->desc.type) << joint.name;
    const referee::Pose one = place_of(before, joint), two = place_of(after, *other);
    EXPECT_LT((one.position - two.position).norm(), 1e-9) << joint.name;
    const bool forward = after.bodies[other->body_b].name == before.bodies[joint.body_b].name;
    if (joint.desc.type == PLUMB_JOINT_BALL) continue;
    EXPECT_LT(((forward ? 1.0 : -1.0) * one.rotation.col(0) - two.rotation.col(0)).norm(), 1e-9) << joint.name;
    const std::size_t axis = joint.desc.type == PLUMB_JOINT_SLIDER ? 0 : 3;
    EXPECT_EQ(joint.desc.limits[axis].enabled, other->desc.limits[axis].enabled) << joint.name;
    EXPECT_NEAR(joint.desc.limits[axis].lower, other->desc.limits[axis].lower, 1e-9) << joint.name;
    EXPECT_NEAR(joint.desc.limits[axis].upper, other->desc.limits[axis].upper, 1e-9) << joint.name;
  }
  EXPECT_EQ(same == 0, before.joints.empty());
}

// Towers, hulls, a chain, a four-bar, a car, a ragdoll with limits, thin things.
INSTANTIATE_TEST_SUITE_P(Scenes, WrittenModel,
                         ::testing::Values("D1", "D14", "E1", "E10", "I1", "I14", "I18", "I25", "H2"));

/// A joint that is written from its body b to its body a has the coordinates of the scene's.
TEST(WriteMjcf, CountsBackwardsWhereTheTreeGoesTheOtherWay) {
  Scene scene = scene_of("E1");
  SceneJoint& joint = scene.joints.at(1);
  ASSERT_TRUE(joint.body_a);
  std::swap(*joint.body_a, joint.body_b);
  std::swap(joint.desc.frame_a, joint.desc.frame_b);
  joint.desc.type = PLUMB_JOINT_HINGE;
  joint.desc.limits[3] = {-0.25, 0.75, 1, 0};
  Remarks remarks;
  const ModelPtr model([&] {
    char error[1000] = "";
    mjModel* made =
        mj_loadXML(write_file("m.xml", write_mjcf(scene, "m", remarks)).c_str(), nullptr, error, sizeof error);
    EXPECT_STREQ(error, "");
    return made;
  }());
  ASSERT_TRUE(model);
  const DataPtr data(mj_makeData(model.get()));
  const int id = mj_name2id(model.get(), mjOBJ_JOINT, joint.name.c_str());
  ASSERT_GE(id, 0);
  EXPECT_DOUBLE_EQ(model->jnt_range[2 * id], -0.25);
  EXPECT_DOUBLE_EQ(model->jnt_range[2 * id + 1], 0.75);
  data->qpos[model->jnt_qposadr[id]] = 0.3;
  mj_kinematics(model.get(), data.get());
  const auto turn_of = [&](std::size_t body, const PlumbPose& frame) {
    const int of = mj_name2id(model.get(), mjOBJ_BODY, scene.bodies[body].name.c_str());
    const referee::Pose pose = upright() * referee::Pose{rotation_at(data->xquat, of), vec_at(data->xpos, of)};
    return referee::Mat3((pose * referee::pose(frame)).rotation);
  };
  const referee::Mat3 relative =
      turn_of(*joint.body_a, joint.desc.frame_a).transpose() * turn_of(joint.body_b, joint.desc.frame_b);
  EXPECT_NEAR(std::atan2(relative(2, 1) - relative(1, 2), relative(1, 1) + relative(2, 2)), 0.3, 1e-9);
}

/// Each scene of the catalogue is a model that MuJoCo takes, or it is said which joint or shape is none.
TEST(WriteMjcf, WritesWhatMujocoReads) {
  int taken = 0, refused = 0;
  for (const SceneFile& file : find_scenes("all")) {
    const Scene scene = file.instantiate(file.variants.front());
    if (scene.bodies.size() > 120) continue;
    Remarks remarks;
    std::string text;
    try {
      text = write_mjcf(scene, "m", remarks);
    } catch (const UsageError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("joint \"") ||
                  std::string(error.what()).starts_with("shape \""))
          << scene.id << ": " << error.what();
      ++refused;
      continue;
    }
    char error[1000] = "";
    const ModelPtr model(mj_loadXML(write_file("m.xml", text).c_str(), nullptr, error, sizeof error));
    EXPECT_TRUE(model) << scene.id << ": " << error;
    ++taken;
  }
  EXPECT_GT(taken, 60);
  EXPECT_LT(refused, 20);
}

TEST(WriteMjcf, SaysWhatMjcfLacks) {
  Scene scene = scene_of("I23");
  Remarks remarks;
  (void)write_mjcf(scene, "m", remarks);
  EXPECT_TRUE(has_line(remarks, "what the host does is left out: shoulder"));
  scene.joints[0].desc.type = PLUMB_JOINT_DISTANCE;
  EXPECT_THROW((void)write_mjcf(scene, "m", remarks), UsageError);
}

}  // namespace
}  // namespace plumb::harness::testing
