// A scene that is written as glTF and read again has the same bodies, shapes, masses and joints.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "convert/upright.hpp"
#include "convert/write/gltf/write_gltf.hpp"
#include "machine_files.hpp"

namespace plumb::harness::testing {
namespace {

using referee::Vec3;

Imported through_gltf(const Scene& scene, Remarks& remarks, const std::string& name = "w.gltf") {
  return read_text(name, write_gltf(scene, name.ends_with(".glb"), remarks));
}

Imported through_gltf(const Scene& scene) {
  Remarks remarks;
  return through_gltf(scene, remarks);
}

void expect_same_axes(const PlumbJointDesc& a, const PlumbJointDesc& b, const std::string& name) {
  for (std::size_t axis = 0; axis < 6; ++axis) {
    EXPECT_EQ(a.limits[axis].enabled, b.limits[axis].enabled) << name;
    EXPECT_EQ(a.limits[axis].lower, b.limits[axis].lower) << name;
    EXPECT_EQ(a.limits[axis].upper, b.limits[axis].upper) << name;
    const PlumbMotor &motor = a.motors[axis], &other = b.motors[axis];
    if (motor.max_force > 0) {
      EXPECT_EQ(std::tie(motor.target_velocity, motor.max_force, motor.enabled),
                std::tie(other.target_velocity, other.max_force, other.enabled))
          << name;
    }
    const PlumbSpring &spring = a.springs[axis], &its = b.springs[axis];
    if (spring.enabled == 0 || spring.mode == PLUMB_SPRING_FREQUENCY) continue;
    EXPECT_EQ(std::tie(spring.rest, spring.frequency, spring.damping_ratio, spring.mode),
              std::tie(its.rest, its.frequency, its.damping_ratio, its.mode))
        << name;
  }
}

void expect_same_joints(const Scene& before, const Scene& after) {
  ASSERT_EQ(before.joints.size(), after.joints.size());
  for (const SceneJoint& joint : before.joints) {
    const SceneJoint& other = after.joints[after.joint(joint.name)];
    EXPECT_EQ(joint.desc.type, other.desc.type) << joint.name;
    EXPECT_EQ(joint.desc.rest_length, other.desc.rest_length) << joint.name;
    EXPECT_EQ(joint.desc.collide_connected, other.desc.collide_connected) << joint.name;
    EXPECT_EQ(before.bodies[joint.body_b].name, after.bodies[other.body_b].name) << joint.name;
    expect_same(place_of(before, joint), place_of(after, other), 1e-9, joint.name);
    const auto on_a = [](const Scene& scene, const SceneJoint& of) {
      const referee::Pose frame = referee::pose(of.desc.frame_a);
      return of.body_a ? referee::pose(scene.bodies[*of.body_a].desc.pose) * frame : frame;
    };
    expect_same(on_a(before, joint), on_a(after, other), 1e-9, joint.name);
    expect_same_axes(joint.desc, other.desc, joint.name);
  }
}

class WrittenNodes : public ::testing::TestWithParam<const char*> {};

TEST_P(WrittenNodes, AreTheSameMachine) {
  Scene before = scene_of(GetParam());
  if (!before.joints.empty()) before.joints[0].desc.collide_connected = 1;
  for (const char* name : {"w.gltf", "w.glb"}) {
    Remarks remarks;
    const Scene after = through_gltf(before, remarks, name).scene;
    for (std::size_t i = 0; i < before.bodies.size(); ++i) {
      const SceneBody& body = before.bodies[i];
      const bool stands = body.desc.motion == PLUMB_STATIC;
      if (stands && (!body.shape || before.shapes[*body.shape].desc.type == PLUMB_COMPOUND)) continue;
      const SceneBody& other = after.bodies[after.body(body.name)];
      EXPECT_EQ(body.desc.motion, other.desc.motion) << body.name;
      expect_same(referee::pose(body.desc.pose), referee::pose(other.desc.pose), 1e-12, body.name);
      if (body.desc.motion == PLUMB_DYNAMIC)
        expect_same(mass_of_body(before, i), mass_of_body(after, after.body(body.name)), 1e-9, body.name);
      for (const auto member : {&PlumbBodyDesc::linear_velocity, &PlumbBodyDesc::angular_velocity})
        EXPECT_LT((referee::vec(body.desc.*member) - referee::vec(other.desc.*member)).norm(), 1e-12) << body.name;
      EXPECT_EQ(body.desc.gravity_scale, other.desc.gravity_scale) << body.name;
      ASSERT_EQ(body.shape.has_value(), other.shape.has_value()) << body.name;
      if (!body.shape) continue;
      EXPECT_EQ(body.desc.material.friction, other.desc.material.friction) << body.name;
      EXPECT_EQ(body.desc.material.restitution, other.desc.material.restitution) << body.name;
      EXPECT_EQ(before.shapes[*body.shape].desc.type, after.shapes[*other.shape].desc.type) << body.name;
      const referee::Aabb one = shape_of(before, *body.shape)->bounds(referee::pose(body.desc.pose));
      const referee::Aabb two = shape_of(after, *other.shape)->bounds(referee::pose(other.desc.pose));
      if (!one.low.allFinite() || !one.high.allFinite()) continue;
      EXPECT_LT((one.low - two.low).norm() + (one.high - two.high).norm(), 1e-5) << body.name;
    }
    expect_same_joints(before, after);
  }
}

// Towers, hulls, a spinning body, a chain, a four-bar, universal joints, a slider with a motor, damped hinges, a car,
// one on a mesh, balls on strings, ragdolls with limits, a servo, thin things.
INSTANTIATE_TEST_SUITE_P(Scenes, WrittenNodes,
                         ::testing::Values("D1", "D14", "A3", "E1", "E10", "E12", "E5", "E15", "I1", "I10", "I14",
                                           "I15", "I18", "I23", "I25", "I36", "H2"));

/// Every scene of the catalogue can be written, and what was written can be read.
TEST(WriteGltf, WritesEveryScene) {
  int read = 0;
  for (const SceneFile& file : find_scenes("all")) {
    const Scene scene = file.instantiate(file.variants.front());
    if (scene.bodies.size() > 300) continue;
    EXPECT_NO_THROW(EXPECT_GT(through_gltf(scene).scene.bodies.size(), 0U)) << scene.id;
    ++read;
  }
  EXPECT_GT(read, 80);
}

/// A dynamic body of the shape, alone.
Scene scene_with(const SceneShape& shape, PlumbMotion motion = PLUMB_DYNAMIC) {
  Scene scene;
  scene.shapes.push_back(shape);
  SceneBody body;
  body.name = "body";
  body.shape = 0;
  body.desc = body_desc(motion);
  scene.bodies.push_back(body);
  return scene;
}

SceneShape shape_of_type(PlumbShapeType type) {
  SceneShape shape;
  shape.name = "shape";
  shape.desc = shape_desc(type);
  return shape;
}

TEST(WriteGltf, MeshesThatStandKeepTheirTriangles) {
  SceneShape field = shape_of_type(PLUMB_HEIGHT_FIELD);
  field.heights = {0, 1, 0, 0, 2, 0};
  field.desc.rows = 2;
  field.desc.columns = 3;
  field.desc.spacing = {1, 0, 1};
  const Scene before = scene_with(field, PLUMB_STATIC), after = through_gltf(before).scene;
  const SceneShape& read = after.shapes[*after.bodies.at(0).shape];
  EXPECT_EQ(read.desc.type, static_cast<PlumbShapeType>(PLUMB_TRIANGLE_MESH));
  EXPECT_EQ(read.vertices.size(), 3 * 6U) << "corners of neighbours are one";
  const referee::ShapePtr cut = shape_of(before, 0), mesh = shape_of(after, *after.bodies[0].shape);
  const auto one = cut->triangles(), two = mesh->triangles();
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t corner = 0; corner < 3; ++corner) EXPECT_EQ(one[i][corner], two[i][corner]);
}

TEST(WriteGltf, PartsOfACompoundHaveTheirPlacesAndMaterials) {
  SceneShape ball = shape_of_type(PLUMB_SPHERE), capsule = shape_of_type(PLUMB_CAPSULE),
             both = shape_of_type(PLUMB_COMPOUND);
  ball.desc.radius = 0.5;
  capsule.desc.radius = 0.25;
  capsule.desc.half_height = 1;
  both.children = {{0, {{1, 0, 0}, {0, 0, 0, 1}}, PlumbMaterial{0.1, 0.7, {}}},
                   {1, {{0, 2, 0}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}, {}}};
  Scene before = scene_with(ball);
  before.shapes.push_back(capsule);
  before.shapes.push_back(both);
  before.bodies[0].shape = 2;
  before.bodies[0].desc.pose = {{3, 4, 5}, {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}};
  const Scene after = through_gltf(before).scene;
  ASSERT_EQ(after.bodies.size(), 1U);
  const SceneShape& read = after.shapes[*after.bodies[0].shape];
  ASSERT_EQ(read.children.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    expect_same(referee::pose(both.children[i].pose), referee::pose(read.children[i].pose), 1e-12, "a part");
  EXPECT_EQ(after.shapes[read.children[1].shape].desc.type, static_cast<PlumbShapeType>(PLUMB_CAPSULE));
  EXPECT_DOUBLE_EQ(after.shapes[read.children[1].shape].desc.half_height, 1);
  ASSERT_TRUE(read.children[0].material && read.children[1].material);
  EXPECT_EQ(read.children[0].material->restitution, 0.7);
  EXPECT_EQ(read.children[1].material->friction, before.bodies[0].desc.material.friction);
}

TEST(WriteGltf, WhatMayTouchMayTouchAgain) {
  Scene before = scene_with([] {
    SceneShape ball = shape_of_type(PLUMB_SPHERE);
    ball.desc.radius = 1;
    return ball;
  }());
  const PlumbFilter filters[] = {body_desc(PLUMB_DYNAMIC).filter,
                                 {6, 5, 0, 0},
                                 {1, 2, -3, 0},
                                 {2, 1, -3, 0},
                                 {8, 8, 7, 0},
                                 {16, 0, 7, 0},
                                 {0, ~0U, 0, 0}};
  for (const PlumbFilter& filter : filters) {
    before.bodies.push_back(before.bodies[0]);
    before.bodies.back().name = "body" + std::to_string(before.bodies.size());
    before.bodies.back().desc.filter = filter;
  }
  const Scene after = through_gltf(before).scene;
  ASSERT_EQ(before.bodies.size(), after.bodies.size());
  for (std::size_t i = 0; i < before.bodies.size(); ++i)
    for (std::size_t j = 0; j < before.bodies.size(); ++j)
      EXPECT_EQ(may_touch(before.bodies[i].desc.filter, before.bodies[j].desc.filter),
                may_touch(after.bodies[i].desc.filter, after.bodies[j].desc.filter))
          << i << " and " << j;
}

TEST(WriteGltf, DistancesAreRodsStringsAndSprings) {
  const auto back = [](const PlumbLimit& limit, const PlumbSpring& spring) {
    Scene scene = scene_of("I10");
    PlumbJointDesc& desc = scene.joints.at(0).desc;
    EXPECT_EQ(desc.type, static_cast<PlumbJointType>(PLUMB_JOINT_DISTANCE));
    desc.rest_length = 1.5;
    desc.limits[0] = limit;
    desc.springs[0] = spring;
    return through_gltf(scene).scene.joints.at(0).desc;
  };
  const PlumbJointDesc rod = back({}, {}), string = back({0, 2, 1, 0}, {}),
                       spring = back({}, {0, 20, 3, 1, PLUMB_SPRING_STIFFNESS});
  for (const PlumbJointDesc& desc : {rod, string, spring})
    EXPECT_EQ(desc.type, static_cast<PlumbJointType>(PLUMB_JOINT_DISTANCE));
  EXPECT_EQ(rod.rest_length, 1.5);
  EXPECT_EQ(rod.limits[0].enabled, 0U);
  EXPECT_EQ(std::tie(string.limits[0].lower, string.limits[0].upper), std::make_tuple(0.0, 2.0));
  EXPECT_EQ(string.limits[0].enabled, 1U);
  EXPECT_EQ(std::tie(spring.rest_length, spring.springs[0].frequency, spring.springs[0].damping_ratio),
            std::make_tuple(1.5, 20.0, 3.0));
  EXPECT_EQ(spring.limits[0].enabled, 0U);
}

TEST(WriteGltf, WhatDoesNotTurnAndWhatOnlySensesAreSaid) {
  SceneShape ball = shape_of_type(PLUMB_SPHERE);
  ball.desc.radius = 1;
  Scene before = scene_with(ball);
  before.bodies[0].desc.flags = PLUMB_BODY_NO_ROTATION;
  before.bodies.push_back(before.bodies[0]);
  before.bodies[1].name = "gate";
  before.bodies[1].desc = body_desc(PLUMB_STATIC);
  before.bodies[1].desc.flags = PLUMB_BODY_SENSOR;
  const Imported back = through_gltf(before);
  ASSERT_EQ(back.scene.bodies.size(), 1U);
  EXPECT_EQ(back.scene.bodies[0].desc.flags, static_cast<std::uint32_t>(PLUMB_BODY_NO_ROTATION));
  EXPECT_TRUE(has_line(back.remarks, "triggers are left out: gate"));
}

TEST(WriteGltf, ASwingTwistJointIsABallAndItIsSaid) {
  const Scene before = scene_of("E16");
  Remarks remarks;
  const Imported back = through_gltf(before, remarks);
  ASSERT_EQ(back.scene.joints.size(), 1U);
  EXPECT_EQ(back.scene.joints[0].desc.type, PLUMB_JOINT_BALL);
  EXPECT_TRUE(has_line(remarks, "its cone, stops, motors and springs are left out: socket"));
}

TEST(WriteGltf, SaysWhatGltfLacks) {
  Scene scene = scene_of("I23");
  scene.gravity = {0, -1.62, 0};
  scene.bodies[0].desc.flags = PLUMB_BODY_CCD;
  scene.joints[0].desc.break_force = 5;
  scene.joints[0].desc.springs[3] = {0, 2, 0.5, 1, PLUMB_SPRING_FREQUENCY};
  Remarks remarks;
  (void)write_gltf(scene, false, remarks);
  for (const char* words :
       {"what the host does is left out: shoulder", "gravity is left out, and readers take 9.81 m/s2: 0 -1.62 0",
        "flags and locks are left out", "that joints break is left out", "springs by frequency are left out"})
    EXPECT_TRUE(has_line(remarks, words)) << words;
  EXPECT_FALSE(has_line(remarks, "motors that drive"));
}

}  // namespace
}  // namespace plumb::harness::testing
