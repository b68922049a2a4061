// A scene that is written as a robot and read again is the same machine; what is no robot is refused by name.
#include <algorithm>

#include "convert/upright.hpp"
#include "convert/write/urdf/write_urdf.hpp"
#include "machine_files.hpp"

namespace plumb::harness::testing {
namespace {

using referee::Vec3;

Imported imported_of(const Scene& scene) {
  Imported imported;
  imported.scene = scene;
  return imported;
}

Imported there_and_back(Imported imported) {
  const auto folder = own_folder();
  const UrdfFiles files = write_urdf(imported, "w");
  for (const auto& [name, text] : files.meshes) std::ofstream(folder / name) << text;
  std::ofstream(folder / "w.urdf") << files.robot;
  return read_machine({folder / "w.urdf", {}});
}

Scene there_and_back(const Scene& scene) { return there_and_back(imported_of(scene)).scene; }

/// What writing it fails with.
std::string refusal_of(const Scene& scene) {
  Imported imported = imported_of(scene);
  try {
    (void)write_urdf(imported, "w");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no failure";
}

const SceneJoint& joint_of(const Scene& scene, const std::string& name) { return scene.joints.at(scene.joint(name)); }

/// Bodies' frames are others in URDF: mass and shape are compared in the world.
void expect_same_body(const Scene& before, const Scene& after, const std::string& name) {
  const std::size_t i = before.body(name), j = after.body(name);
  const referee::Pose one = referee::pose(before.bodies[i].desc.pose), two = referee::pose(after.bodies[j].desc.pose);
  if (before.bodies[i].desc.motion == PLUMB_DYNAMIC) {
    const referee::Mass a = mass_of_body(before, i), b = mass_of_body(after, j);
    const auto in_world = [](const referee::Pose& pose, const referee::Mass& mass) {
      return referee::Mass{mass.mass, pose * mass.centre, pose.rotation * mass.inertia * pose.rotation.transpose()};
    };
    expect_same(in_world(one, a), in_world(two, b), 1e-6, name);
  }
  ASSERT_EQ(before.bodies[i].shape.has_value(), after.bodies[j].shape.has_value()) << name;
  if (!before.bodies[i].shape) return;
  const referee::Aabb box = shape_of(before, *before.bodies[i].shape)->bounds(one);
  const referee::Aabb other = shape_of(after, *after.bodies[j].shape)->bounds(two);
  EXPECT_LT((box.low - other.low).norm() + (box.high - other.high).norm(), 1e-5) << name;
}

void expect_same_joint(const Scene& before, const Scene& after, const std::string& name) {
  const SceneJoint &joint = joint_of(before, name), &other = joint_of(after, name);
  EXPECT_EQ(joint.desc.type, other.desc.type) << name;
  const referee::Pose one = place_of(before, joint), two = place_of(after, other);
  EXPECT_LT((one.position - two.position).norm(), 1e-6) << name;
  if (joint.desc.type != PLUMB_JOINT_HINGE && joint.desc.type != PLUMB_JOINT_SLIDER) return;
  EXPECT_LT((one.rotation.col(0) - two.rotation.col(0)).norm(), 1e-6) << name;
  const std::size_t axis = joint.desc.type == PLUMB_JOINT_SLIDER ? 0 : 3;
  EXPECT_EQ(joint.desc.limits[axis].enabled, other.desc.limits[axis].enabled) << name;
  EXPECT_NEAR(joint.desc.limits[axis].lower, other.desc.limits[axis].lower, 1e-6) << name;
  EXPECT_NEAR(joint.desc.limits[axis].upper, other.desc.limits[axis].upper, 1e-6) << name;
}

class WrittenRobot : public ::testing::TestWithParam<const char*> {};

TEST_P(WrittenRobot, IsTheSameMachine) {
  const Scene before = scene_of(GetParam()), after = there_and_back(before);
  for (const SceneBody& body : before.bodies)
    if (body.desc.motion == PLUMB_DYNAMIC) expect_same_body(before, after, body.name);
  for (const SceneJoint& joint : before.joints) expect_same_joint(before, after, joint.name);
}

// Chains, hinges with motors and dampers, sliders, cars, one of them on a mesh, robots' arms, a suspension.
INSTANTIATE_TEST_SUITE_P(Scenes, WrittenRobot,
                         ::testing::Values("E2", "E4", "E5", "E6", "E7", "E11", "E15", "I1", "I2", "I13", "I15", "I23",
                                           "I26", "I31", "I32", "I36"));

SceneShape shape_of_type(PlumbShapeType type) {
  SceneShape shape;
  shape.name = "shape" + std::to_string(type);
  shape.desc = shape_desc(type);
  shape.desc.radius = 0.25;
  shape.desc.half_height = 0.5;
  shape.desc.half_extents = {0.1, 0.2, 0.3};
  return shape;
}

/// A base and an arm of boxes, and what holds the arm: its frames meet at the start, turned against both bodies.
Scene arm(PlumbJointType type) {
  Scene scene;
  scene.shapes.push_back(shape_of_type(PLUMB_BOX));
  for (const char* name : {"base", "arm"}) {
    SceneBody body;
    body.name = name;
    body.shape = 0;
    body.desc = body_desc(PLUMB_DYNAMIC);
    body.desc.pose = {{1, 2, 3}, {0.5, 0.5, 0.5, 0.5}};
    scene.bodies.push_back(body);
  }
  scene.bodies[1].desc.pose = {{2, 2, 3}, {0, 0.6, 0, 0.8}};
  SceneJoint joint;
  joint.name = "elbow";
  joint.body_a = 0;
  joint.body_b = 1;
  joint.desc = joint_desc(type);
  const referee::Pose place{Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(), {1.5, 2, 3}};
  joint.desc.frame_a = plain(place.seen_from(referee::pose(scene.bodies[0].desc.pose)));
  joint.desc.frame_b = plain(place.seen_from(referee::pose(scene.bodies[1].desc.pose)));
  scene.joints.push_back(joint);
  return scene;
}

TEST(WriteUrdf, JointsKeepLimitsDampingFrictionAndEfforts) {
  Imported before = imported_of(arm(PLUMB_JOINT_HINGE));
  PlumbJointDesc& desc = before.scene.joints[0].desc;
  desc.limits[3] = {-0.5, 1, 1, 0};
  desc.motors[3] = {0, 0.25, 1, 0};
  desc.springs[3] = {0, 0, 3, 1, PLUMB_SPRING_STIFFNESS};
  before.efforts.emplace_back().fill(7);
  const Imported after = there_and_back(before);
  expect_same_joint(before.scene, after.scene, "elbow");
  const PlumbJointDesc& read = joint_of(after.scene, "elbow").desc;
  EXPECT_EQ(read.motors[3].max_force, 0.25);
  EXPECT_EQ(read.springs[3].damping_ratio, 3);
  EXPECT_EQ(after.efforts.at(0)[3], 7);
  desc.motors[3] = {2, 11, 1, 0};
  before.efforts.clear();
  EXPECT_EQ(there_and_back(before).efforts.at(0)[3], 11) << "of a motor that drives";
}

/// URDF calls 0 where a joint is at the start.
TEST(WriteUrdf, LimitsCountFromTheStart) {
  for (const auto& [type, axis] : {std::pair(PLUMB_JOINT_HINGE, 3U), {PLUMB_JOINT_SLIDER, 0U}}) {
    Scene scene = arm(type);
    PlumbJointDesc& desc = scene.joints[0].desc;
    const referee::Pose moved =
        axis == 3 ? referee::Pose{Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix(), Vec3::Zero()}
                  : referee::Pose{referee::Mat3::Identity(), {0.3, 0, 0}};
    desc.frame_b = plain(referee::pose(desc.frame_b) * moved);
    desc.limits[axis] = {-0.5, 1, 1, 0};
    const PlumbLimit read = joint_of(there_and_back(scene), "elbow").desc.limits[axis];
    EXPECT_NEAR(read.lower, -0.8, 1e-9);
    EXPECT_NEAR(read.upper, 0.7, 1e-9);
  }
}

/// A joint whose body b is nearer to the root has the coordinates of the scene's: what rises there rises here.
TEST(WriteUrdf, CountsBackwardsWhereTheTreeGoesTheOtherWay) {
  Scene scene = arm(PLUMB_JOINT_HINGE);
  SceneJoint& joint = scene.joints[0];
  std::swap(*joint.body_a, joint.body_b);
  std::swap(joint.desc.frame_a, joint.desc.frame_b);
  joint.desc.limits[3] = {-0.25, 0.75, 1, 0};
  scene.bodies[0].desc = body_desc(PLUMB_STATIC);  // which makes it the root
  scene.bodies[0].desc.pose = {{1, 2, 3}, {0.5, 0.5, 0.5, 0.5}};
  const Scene after = there_and_back(scene);
  const SceneJoint& read = joint_of(after, "elbow");
  EXPECT_EQ(after.bodies[read.body_b].name, "arm");
  EXPECT_LT((place_of(scene, joint).rotation.col(0) + place_of(after, read).rotation.col(0)).norm(), 1e-9)
      << "about the same axis backwards";
  EXPECT_NEAR(read.desc.limits[3].lower, -0.25, 1e-9);
  EXPECT_NEAR(read.desc.limits[3].upper, 0.75, 1e-9);
}

TEST(WriteUrdf, WhatStandsHangsOnTheWorldWhereItHoldsSomething) {
  Scene scene = arm(PLUMB_JOINT_HINGE);
  for (const char* name : {"base", "floor"}) {
    SceneBody still;
    still.name = name;
    still.shape = 0;
    still.desc = body_desc(PLUMB_STATIC);
    still.desc.pose = scene.bodies[0].desc.pose;
    if (name == scene.bodies[0].name)
      scene.bodies[0] = still;
    else
      scene.bodies.push_back(still);
  }
  Imported imported = imported_of(scene);
  const Imported back = there_and_back(imported);
  (void)write_urdf(imported, "w");
  EXPECT_TRUE(has_line(imported.remarks, "what stands beside the robot is left out: floor"));
  EXPECT_EQ(back.scene.bodies.size(), 2U);
  expect_same_body(scene, back.scene, "base");
  expect_same_joint(scene, back.scene, "elbow");
  const SceneJoint& fixed = joint_of(back.scene, "base/fixed");
  EXPECT_FALSE(fixed.body_a.has_value());
  EXPECT_EQ(fixed.desc.type, static_cast<PlumbJointType>(PLUMB_JOINT_FIXED));
}

TEST(WriteUrdf, FixedJointsStayAndOneAxisOfAGenericOneIsAHinge) {
  EXPECT_EQ(joint_of(there_and_back(arm(PLUMB_JOINT_FIXED)), "elbow").desc.type,
            static_cast<PlumbJointType>(PLUMB_JOINT_FIXED));
  Scene scene = arm(PLUMB_JOINT_GENERIC);
  PlumbJointDesc& desc = scene.joints[0].desc;
  for (PlumbAxisMode& mode : desc.axis_modes) mode = PLUMB_AXIS_LOCKED;
  desc.axis_modes[5] = PLUMB_AXIS_LIMITED;
  desc.limits[5] = {-1, 2, 1, 0};
  const Scene after = there_and_back(scene);
  const SceneJoint& read = joint_of(after, "elbow");
  EXPECT_EQ(read.desc.type, static_cast<PlumbJointType>(PLUMB_JOINT_HINGE));
  EXPECT_LT((place_of(after, read).rotation.col(0) - place_of(scene, scene.joints[0]).rotation.col(2)).norm(), 1e-9);
  EXPECT_EQ(read.desc.limits[3].upper, 2);
}

TEST(WriteUrdf, ShapesAreWhereTheyWere) {
  Scene scene = arm(PLUMB_JOINT_HINGE);
  for (const PlumbShapeType type : {PLUMB_SPHERE, PLUMB_CAPSULE, PLUMB_CYLINDER, PLUMB_CONVEX_HULL})
    scene.shapes.push_back(shape_of_type(type));
  scene.shapes.back().vertices = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3};
  scene.shapes.back().desc.vertex_count = 4;
  SceneShape all = shape_of_type(PLUMB_COMPOUND);
  for (std::size_t i = 0; i < 5; ++i)
    all.children.push_back({i, {{static_cast<double>(i), 1, 0}, {0, 0, 0.6, 0.8}}, {}});
  scene.shapes.push_back(all);
  for (std::size_t shape = 0; shape < scene.shapes.size(); ++shape) {
    scene.bodies[1].shape = shape;
    expect_same_body(scene, there_and_back(scene), "arm");
  }
  Imported imported = imported_of(scene);
  const UrdfFiles files = write_urdf(imported, "w");
  EXPECT_EQ(files.meshes.count("w-4.obj"), 1U);
  EXPECT_TRUE(has_line(imported.remarks, "capsules are cylinders between two spheres: arm"));
}

TEST(WriteUrdf, SaysWhatUrdfLacks) {
  Imported imported = imported_of(scene_of("I23"));
  imported.scene.gravity = {0, 0, 0};
  imported.scene.bodies[imported.scene.joints[1].body_b].desc.linear_velocity = {1, 0, 0};
  imported.scene.joints[1].desc.springs[3] = {0, 5, 0.5, 1, PLUMB_SPRING_STIFFNESS};
  (void)write_urdf(imported, "w");
  for (const char* words :
       {"what the host does is left out: shoulder", "gravity is left out", "velocities at the start",
        "springs by stiffness are left out", "friction and restitution are left out"})
    EXPECT_TRUE(has_line(imported.remarks, words)) << words;
}

TEST(WriteUrdf, RefusesByName) {
  const auto expect = [](const Scene& scene, const std::string& words) {
    const std::string refusal = refusal_of(scene);
    EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
  };
  expect(arm(PLUMB_JOINT_BALL), "joint \"elbow\" is a ball one");
  expect(arm(PLUMB_JOINT_UNIVERSAL), "joint \"elbow\" is a universal one");
  expect(arm(PLUMB_JOINT_DISTANCE), "joint \"elbow\" is a distance one");
  expect(arm(PLUMB_JOINT_GENERIC), "joint \"elbow\" is a generic one with 6 free axes");
  Scene loop = arm(PLUMB_JOINT_HINGE);
  loop.joints.push_back(loop.joints[0]);
  loop.joints[1].name = "wrist";
  expect(loop, "joint \"wrist\" closes a loop");
  Scene loose = arm(PLUMB_JOINT_HINGE);
  loose.bodies.push_back(loose.bodies[0]);
  loose.bodies[2].name = "ball";
  expect(loose, "one body is not joined to \"base\": \"ball\"");
  Scene driven = arm(PLUMB_JOINT_HINGE);
  driven.bodies[0].desc.motion = PLUMB_KINEMATIC;
  expect(driven, "joint \"elbow\" holds a kinematic body");
  Scene still = arm(PLUMB_JOINT_HINGE);
  for (SceneBody& body : still.bodies) body.desc.motion = PLUMB_STATIC;
  expect(still, "nothing in the scene moves");
}

/// Each scene of the catalogue is a robot that can be read, or it is said what in it is none.
TEST(WriteUrdf, WritesRobotsAndRefusesTheRest) {
  int robots = 0;
  for (const SceneFile& file : find_scenes("all")) {
    const Scene scene = file.instantiate(file.variants.front());
    if (scene.bodies.size() > 300) continue;
    const std::string refusal = refusal_of(scene);
    if (refusal == "no failure") {
      EXPECT_NO_THROW(EXPECT_GT(there_and_back(scene).bodies.size(), 0U)) << scene.id;
      ++robots;
      continue;
    }
    const bool named =
        refusal.find('"') != std::string::npos || refusal.find("nothing in the scene moves") != std::string::npos;
    EXPECT_TRUE(named) << scene.id << ": " << refusal;
  }
  EXPECT_GT(robots, 30);
}

}  // namespace
}  // namespace plumb::harness::testing
