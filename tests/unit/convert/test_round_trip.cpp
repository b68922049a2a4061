// A scene that is written as a world and read again is the same machine.
#include <algorithm>
#include <limits>

#include "convert/scene_text.hpp"
#include "convert/set_up.hpp"
#include "convert/upright.hpp"
#include "convert/write/write_sdf.hpp"
#include "machine_files.hpp"

namespace plumb::harness::testing {
namespace {

Imported there_and_back(const Scene& scene, Remarks& remarks) {
  const auto folder = own_folder();
  const SdfFiles files = write_sdf(scene, "w", remarks);
  for (const auto& [name, text] : files.meshes) std::ofstream(folder / name) << text;
  std::ofstream(folder / "w.sdf") << files.world;
  return read_machine({folder / "w.sdf", {}});
}

/// A name without the model's that stands before it; "/" stands for what SDF parts names with.
std::size_t find_body(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].name.ends_with("::" + name)) return i;
  ADD_FAILURE() << "no body " << name;
  return 0;
}

void expect_same_bodies(const Scene& before, const Scene& after) {
  ASSERT_EQ(before.bodies.size(), after.bodies.size());
  for (std::size_t i = 0; i < before.bodies.size(); ++i) {
    const std::size_t other = find_body(after, before.bodies[i].name);
    const std::string& name = before.bodies[i].name;
    const PlumbBodyDesc &a = before.bodies[i].desc, &b = after.bodies[other].desc;
    EXPECT_EQ(a.motion, b.motion) << name;
    if (a.motion == PLUMB_DYNAMIC) expect_same(mass_of_body(before, i), mass_of_body(after, other), 1e-9, name);
    ASSERT_EQ(before.bodies[i].shape.has_value(), after.bodies[other].shape.has_value()) << name;
    if (!before.bodies[i].shape) continue;
    EXPECT_EQ(a.material.friction, b.material.friction) << name;
    const referee::Aabb one = shape_of(before, *before.bodies[i].shape)->bounds(referee::pose(a.pose));
    const referee::Aabb two = shape_of(after, *after.bodies[other].shape)->bounds(referee::pose(b.pose));
    if (!one.low.allFinite() || !one.high.allFinite()) continue;
    EXPECT_LT((one.low - two.low).norm() + (one.high - two.high).norm(), 1e-6) << name;
  }
}

void expect_same_joints(const Scene& before, const Scene& after) {
  ASSERT_EQ(before.joints.size(), after.joints.size());
  for (const SceneJoint& joint : before.joints) {
    const auto same = std::find_if(after.joints.begin(), after.joints.end(),
                                   [&](const SceneJoint& other) { return other.name.ends_with("::" + joint.name); });
    ASSERT_NE(same, after.joints.end()) << joint.name;
    EXPECT_EQ(joint.desc.type, same->desc.type) << joint.name;
    const referee::Pose one = place_of(before, joint), two = place_of(after, *same);
    EXPECT_LT((one.position - two.position).norm(), 1e-9) << joint.name;
    const bool one_axis = joint.desc.type == PLUMB_JOINT_HINGE || joint.desc.type == PLUMB_JOINT_SLIDER;
    EXPECT_LT(one_axis ? (one.rotation.col(0) - two.rotation.col(0)).norm() : 0, 1e-9) << joint.name;
    for (const std::size_t axis : {0U, 3U, 4U}) {
      EXPECT_EQ(joint.desc.limits[axis].enabled, same->desc.limits[axis].enabled) << joint.name;
      EXPECT_NEAR(joint.desc.limits[axis].lower, same->desc.limits[axis].lower, 1e-9) << joint.name;
      EXPECT_NEAR(joint.desc.limits[axis].upper, same->desc.limits[axis].upper, 1e-9) << joint.name;
      const PlumbSpring &one_spring = joint.desc.springs[axis], &other = same->desc.springs[axis];
      if (one_spring.enabled == 0 || one_spring.mode == PLUMB_SPRING_FREQUENCY) continue;
      EXPECT_EQ(other.mode, static_cast<PlumbSpringMode>(PLUMB_SPRING_STIFFNESS)) << joint.name;
      EXPECT_EQ(one_spring.frequency, other.frequency) << joint.name;
      EXPECT_EQ(one_spring.damping_ratio, other.damping_ratio) << joint.name;
      EXPECT_NEAR(one_spring.rest, other.rest, 1e-9) << joint.name;
    }
  }
}

class RoundTrip : public ::testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, IsTheSameMachine) {
  const Scene scene = scene_of(GetParam());
  Remarks remarks;
  const Imported back = there_and_back(scene, remarks);
  EXPECT_LT((referee::vec(scene.gravity) - referee::vec(back.scene.gravity)).norm(), 1e-12);
  EXPECT_EQ(scene.dt, back.scene.dt);
  expect_same_bodies(scene, back.scene);
  expect_same_joints(scene, back.scene);
}

// Towers, hulls, a chain, a four-bar, cars, one of them on a mesh, a ragdoll with limits, a robot's arm, a piston, thin
// things.
INSTANTIATE_TEST_SUITE_P(Scenes, RoundTrip,
                         ::testing::Values("D1", "D14", "E1", "E10", "I1", "I14", "I15", "I18", "I22", "I23", "I25",
                                           "H2"));

TEST(SceneText, IsASceneFileThatIsReadAsWhatItWas) {
  Imported imported;
  imported.scene = scene_of("I14");
  imported.scene.joints[0].desc.springs[3] = {0.1, 20, 3, 1, PLUMB_SPRING_STIFFNESS};
  imported.scene.joints[1].desc.springs[3] = {0.2, 2, 0.5, 1, PLUMB_SPRING_FREQUENCY};
  imported.efforts.resize(imported.scene.joints.size());
  for (auto& efforts : imported.efforts) efforts.fill(std::numeric_limits<double>::infinity());
  const Scene before = imported.scene;
  set_up(imported, {});
  Json json = scene_json(imported.scene, {"X1", "ragdoll", "A ragdoll", "As it was."});
  add_metrics(json, imported.scene);
  const auto file = write_file("X1-ragdoll.json", scene_text(json));
  const Scene after = SceneFile::load(file).instantiate({});
  ASSERT_EQ(before.bodies.size(), after.bodies.size());
  for (std::size_t i = 0; i < before.bodies.size(); ++i) {
    EXPECT_EQ(before.bodies[i].name, after.bodies[i].name);
    expect_same(referee::pose(before.bodies[i].desc.pose), referee::pose(after.bodies[i].desc.pose), 1e-15,
                before.bodies[i].name);
    if (before.bodies[i].desc.motion == PLUMB_DYNAMIC)
      expect_same(mass_of_body(before, i), mass_of_body(after, i), 1e-15, before.bodies[i].name);
  }
  ASSERT_EQ(before.joints.size(), after.joints.size());
  for (std::size_t i = 0; i < before.joints.size(); ++i) {
    expect_same(place_of(before, before.joints[i]), place_of(after, after.joints[i]), 1e-15, before.joints[i].name);
    EXPECT_EQ(before.joints[i].desc.limits[3].upper, after.joints[i].desc.limits[3].upper);
    const PlumbSpring &one = before.joints[i].desc.springs[3], &other = after.joints[i].desc.springs[3];
    EXPECT_EQ(std::tie(one.rest, one.frequency, one.damping_ratio, one.enabled, one.mode),
              std::tie(other.rest, other.frequency, other.damping_ratio, other.enabled, other.mode));
  }
  EXPECT_EQ(after.measure, "quantities");
}

TEST(SceneText, KeepsMaterialsByTriangle) {
  Imported imported;
  imported.scene = scene_of("C12");
  const Scene before = imported.scene;
  set_up(imported, {});
  Json json = scene_json(imported.scene, {"X2", "land", "Land", "As it was."});
  add_metrics(json, imported.scene);
  const Scene after = SceneFile::load(write_file("X2-land.json", scene_text(json))).instantiate({});
  const auto mesh = [](const Scene& scene) {
    return std::find_if(scene.shapes.begin(), scene.shapes.end(),
                        [](const SceneShape& shape) { return shape.desc.type == PLUMB_TRIANGLE_MESH; });
  };
  ASSERT_NE(mesh(after), after.shapes.end());
  EXPECT_EQ(mesh(after)->triangle_materials, mesh(before)->triangle_materials);
  ASSERT_EQ(mesh(after)->materials.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_DOUBLE_EQ(mesh(after)->materials[i].friction, mesh(before)->materials[i].friction);
}

/// SDF calls 0 where a joint is at the start.
TEST(WriteSdf, LimitsCountFromTheStart) {
  Scene scene = scene_of("I23");
  PlumbJointDesc& joint = scene.joints[1].desc;
  const referee::Pose turned{Eigen::AngleAxisd(0.3, referee::Vec3::UnitX()).toRotationMatrix(), referee::Vec3::Zero()};
  joint.frame_b = plain(referee::pose(joint.frame_b) * turned);
  joint.limits[3] = {-0.5, 1, 1, 0};
  joint.springs[3] = {0.5, 20, 3, 1, PLUMB_SPRING_STIFFNESS};
  Remarks remarks;
  const Imported back = there_and_back(scene, remarks);
  const auto same = std::find_if(back.scene.joints.begin(), back.scene.joints.end(), [&](const SceneJoint& other) {
    return other.name.ends_with("::" + scene.joints[1].name);
  });
  ASSERT_NE(same, back.scene.joints.end());
  EXPECT_NEAR(same->desc.limits[3].lower, -0.8, 1e-9);
  EXPECT_NEAR(same->desc.limits[3].upper, 0.7, 1e-9);
  EXPECT_NEAR(same->desc.springs[3].rest, 0.2, 1e-9);
  EXPECT_EQ(same->desc.springs[3].frequency, 20);
  EXPECT_EQ(same->desc.springs[3].damping_ratio, 3);
}

TEST(WriteSdf, ASwingTwistJointIsABallAndItIsSaid) {
  Remarks remarks;
  const Imported back = there_and_back(scene_of("E16"), remarks);
  ASSERT_EQ(back.scene.joints.size(), 1U);
  EXPECT_EQ(back.scene.joints[0].desc.type, PLUMB_JOINT_BALL);
  EXPECT_TRUE(has_line(remarks, "its cone, stops, motors and springs are left out: socket"));
}

TEST(WriteSdf, SaysWhatSdfLacks) {
  Scene scene = scene_of("I23");
  Remarks remarks;
  (void)write_sdf(scene, "w", remarks);
  EXPECT_TRUE(has_line(remarks, "what the host does is left out: shoulder"));
  scene.joints[0].desc.type = PLUMB_JOINT_DISTANCE;
  EXPECT_THROW((void)write_sdf(scene, "w", remarks), UsageError);
}

/// What a scene that was made of a machine is scored by.
Json metrics_of(const std::string& axis) {
  Imported imported = read_text(
      "a.sdf", R"(<sdf version="1.7"><model name="m"><link name="a"/><link name="b"/><joint name="j" type=")" + axis +
                   R"("><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz>
    <limit><lower>-1</lower><upper>1</upper></limit></axis></joint></model></sdf>)");
  set_up(imported, {});
  Json json = scene_json(imported.scene, {"X1", "m", "m", "m"});
  add_metrics(json, imported.scene);
  add_joint_metrics(json, imported.scene);
  return json.at("metrics");
}

TEST(Metrics, AJointMayNotGoBeyondItsLimits) {
  const Json hinge = metrics_of("revolute"), slider = metrics_of("prismatic"), free = metrics_of("continuous");
  EXPECT_TRUE(hinge.contains("turned_beyond"));
  EXPECT_FALSE(hinge.contains("slid_beyond"));
  EXPECT_TRUE(slider.contains("slid_beyond"));
  EXPECT_FALSE(slider.contains("turned_beyond"));
  EXPECT_FALSE(free.contains("turned_beyond"));
  EXPECT_TRUE(free.contains("bent"));
}

}  // namespace
}  // namespace plumb::harness::testing
