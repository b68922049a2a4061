// What MuJoCo makes of an MJCF file is what the scene has: where bodies are, whatever the coordinates of the joints.
#include <mujoco/mujoco.h>

#include <cmath>
#include <random>

#include "convert/mjcf/mjcf_types.hpp"
#include "convert/mjcf/read_mjcf.hpp"
#include "convert/upright.hpp"
#include "machine_files.hpp"

namespace plumb::harness::testing {
namespace {

using referee::Mat3;
using referee::Pose;
using referee::Vec3;

constexpr const char* machine =
    R"(<mujoco model="m"><compiler angle="radian"/><option timestep="0.004" gravity="0 0 -3.7"/>
<worldbody>
  <geom name="floor" type="plane" size="5 5 0.1" friction="0.7"/>
  <body name="trunk" pos="0 0 2" euler="0.2 0.1 0.4"><freejoint/><geom type="box" size="0.2 0.1 0.3" mass="3"/>
    <body name="head" pos="0 0 0.5"><geom type="sphere" size="0.1" mass="1"/></body>
    <body name="upper" pos="0.3 0 0" euler="0 0.3 0"><joint name="shoulder_y" type="hinge" axis="0 1 0" pos="0 0 0.1" range="-0.5 1" limited="true"/>
      <joint name="shoulder_x" type="hinge" axis="1 0 0" pos="0 0 0.1"/>
      <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.05" mass="1"/>
      <body name="lower" pos="0 0 -0.5" quat="0.9 0.1 0.2 0.3"><joint name="elbow" type="hinge" axis="0 1 1" ref="0.2" range="-0.3 1.2" limited="true" frictionloss="0.4" damping="0.3" stiffness="6" springref="0.5"/>
        <geom type="cylinder" size="0.05 0.2" pos="0 0 -0.2" mass="0.5"/>
        <body name="hand" pos="0 0 -0.45"><joint name="wrist" type="ball"/><geom type="ellipsoid" size="0.1 0.05 0.02" mass="0.2"/></body>
      </body>
    </body>
    <body name="drawer" pos="0 0.3 0"><joint name="slide" type="slide" axis="0 -1 0.5" range="-0.1 0.4" limited="true"/><geom type="box" size="0.1 0.1 0.05" mass="0.7"/></body>
  </body>
  <body name="cart" pos="3 0 1"><joint name="cart_x" type="slide" axis="1 0 0"/><joint name="cart_z" type="slide" axis="0 0 -1" range="-1 2" limited="true"/>
    <joint name="cart_turn" type="hinge" axis="0 1 0"/><geom type="box" size="0.2 0.2 0.2" mass="2"/></body>
</worldbody>
<actuator><motor joint="elbow" gear="10" ctrllimited="true" ctrlrange="-2 3"/></actuator>
</mujoco>)";

/// How a joint moves frame b in frame a for these coordinates of MuJoCo's, from its start on.
Pose motion_of(const PlumbJointDesc& desc, const std::vector<double>& q) {
  const auto turn = [](double angle, const Vec3& axis) {
    return Pose{Eigen::AngleAxisd(angle, axis).toRotationMatrix(), Vec3::Zero()};
  };
  if (desc.type == PLUMB_JOINT_HINGE) return turn(q[0], Vec3::UnitX());
  if (desc.type == PLUMB_JOINT_SLIDER) return {Mat3::Identity(), q[0] * Vec3::UnitX()};
  return turn(q[0], Vec3::UnitX()) * turn(q[1], Vec3::UnitY());  // universal
}

TEST(ReadMjcf, BodiesAreWhereMujocoHasThemAtAnyCoordinates) {
  const auto file = write_file("m.xml", machine);
  const Imported read = read_machine({file, {}});
  const Scene& scene = read.scene;
  std::array<char, 1000> error{};
  const ModelPtr model(mj_loadXML(file.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  ASSERT_TRUE(model) << error.data();
  const DataPtr data(mj_makeData(model.get()));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-0.4, 0.4);
  const auto place = [&](const std::string& body) {
    const int id = mj_name2id(model.get(), mjOBJ_BODY, body.c_str());
    return upright() * Pose{rotation_at(data->xquat, id), vec_at(data->xpos, id)};
  };
  for (int round = 0; round < 20; ++round) {
    const auto set = [&](const std::string& joint) {
      const int id = mj_name2id(model.get(), mjOBJ_JOINT, joint.c_str());
      const double q = round == 0 ? 0 : number(random);
      data->qpos[model->jnt_qposadr[id]] = model->qpos0[model->jnt_qposadr[id]] + q;
      return q;
    };
    const std::map<std::string, std::vector<double>> coordinates{
        {"shoulder_y", {set("shoulder_y"), set("shoulder_x")}}, {"elbow", {set("elbow")}}, {"slide", {set("slide")}}};
    mj_kinematics(model.get(), data.get());
    for (const auto& [name, q] : coordinates) {
      const SceneJoint& joint = scene.joints[scene.joint(name)];
      const Pose expected = place(scene.bodies[*joint.body_a].name) * referee::pose(joint.desc.frame_a) *
                            motion_of(joint.desc, q) * referee::pose(joint.desc.frame_b).inverse();
      expect_same(place(scene.bodies[joint.body_b].name), expected, 1e-9, name);
    }
  }
}

TEST(ReadMjcf, MassesAreMujocos) {
  const auto file = write_file("m.xml", machine);
  const Scene scene = read_machine({file, {}}).scene;
  std::array<char, 1000> error{};
  const ModelPtr model(mj_loadXML(file.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  ASSERT_TRUE(model) << error.data();
  const DataPtr data(mj_makeData(model.get()));
  mj_kinematics(model.get(), data.get());
  mj_comPos(model.get(), data.get());
  double mass = 0;
  Vec3 centre = Vec3::Zero();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const referee::Mass one = mass_of_body(scene, i);
    mass += one.mass;
    centre += one.mass * (referee::pose(scene.bodies[i].desc.pose) * one.centre);
  }
  EXPECT_NEAR(mass, model->body_subtreemass[0], 1e-9);
  EXPECT_LT((centre / mass - upright() * Vec3(vec_at(data->subtree_com, 0))).norm(), 1e-9);
  // The head is fixed to the trunk and part of it: 3 kg and 1 kg half a metre apart.
  const referee::Mass trunk = mass_of_body(scene, scene.body("trunk"));
  EXPECT_NEAR(trunk.mass, 4, 1e-12);
  EXPECT_LT((trunk.centre - Vec3(0, 0, 0.125)).norm(), 1e-12);
  const referee::Aabb bounds = shape_of(scene, *scene.bodies[scene.body("trunk")].shape)->bounds({});
  EXPECT_NEAR(bounds.high.z(), 0.6, 1e-9) << "the head's sphere is where the head is";
  EXPECT_NEAR(trunk.inertia(0, 0), 3 * (0.01 + 0.09) / 3 + 0.4 * 1 * 0.01 + 0.75 * 0.25, 1e-9);
}

/// Masses, their moments and their inertia about the world's origin.
struct Whole {
  double mass = 0;
  Vec3 moment = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
  /// at: of the centre of mass, with the axes in which the inertia is given.
  void add(double more, const Pose& at, const Mat3& about_centre) {
    const Vec3& r = at.position;
    mass += more;
    moment += more * r;
    inertia += at.rotation * about_centre * at.rotation.transpose() +
               more * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
};

Whole whole_of(const Scene& scene) {
  Whole all;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].desc.motion != PLUMB_DYNAMIC) continue;
    const referee::Mass one = mass_of_body(scene, i);
    const Pose pose = referee::pose(scene.bodies[i].desc.pose);
    all.add(one.mass, {pose.rotation, pose * one.centre}, one.inertia);
  }
  return all;
}

Whole whole_of(const mjModel& model, const mjData& data) {
  Whole all;
  for (int body = 1; body < model.nbody; ++body) {
    if (model.body_weldid[body] == 0) continue;
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> axes(data.ximat + std::ptrdiff_t{9} * body);
    all.add(model.body_mass[body], upright() * Pose{axes, vec_at(data.xipos, body)},
            vec_at(model.body_inertia, body).asDiagonal());
  }
  return all;
}

class ReadPackagedMjcf : public ::testing::TestWithParam<const char*> {};

/// All masses, where they are and how they turn, and each joint's place and first axis.
TEST_P(ReadPackagedMjcf, IsTheMachineThatMujocoMakesOfIt) {
  if (!std::filesystem::exists(GetParam()))
    GTEST_SKIP() << "there is no " << GetParam() << ": apt-get install dart-doc libmujoco-samples";
  const Scene scene = read_machine({GetParam(), {}}).scene;
  std::array<char, 1000> error{};
  const ModelPtr model(mj_loadXML(GetParam(), nullptr, error.data(), static_cast<int>(error.size())));
  ASSERT_TRUE(model) << error.data();
  const DataPtr data(mj_makeData(model.get()));
  mj_kinematics(model.get(), data.get());
  const Whole ours = whole_of(scene), theirs = whole_of(*model, *data);
  EXPECT_NEAR(ours.mass, theirs.mass, 1e-9 * theirs.mass);
  EXPECT_LT((ours.moment - theirs.moment).norm(), 1e-9 * theirs.mass);
  EXPECT_LT((ours.inertia - theirs.inertia).norm(), 1e-9 * theirs.inertia.norm());
  for (const SceneJoint& joint : scene.joints) {
    const int id = mj_name2id(model.get(), mjOBJ_JOINT, joint.name.c_str());
    if (id < 0) continue;  // it has no name there
    const Pose place = place_of(scene, joint);
    EXPECT_LT((place.position - upright() * vec_at(data->xanchor, id)).norm(), 1e-9) << joint.name;
    if (model->jnt_type[id] == mjJNT_BALL) continue;
    EXPECT_LT((place.rotation.col(0) - upright().rotation * vec_at(data->xaxis, id)).norm(), 1e-9) << joint.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Debian, ReadPackagedMjcf,
                         ::testing::Values("/usr/share/doc/dart/data/mjcf/openai/hopper.xml",
                                           "/usr/share/doc/dart/data/mjcf/openai/reacher.xml",
                                           "/usr/share/doc/dart/data/mjcf/openai/inverted_double_pendulum.xml",
                                           "/usr/share/mujoco/model/humanoid/humanoid.xml",
                                           "/usr/share/mujoco/model/humanoid100/humanoid100.xml"));

TEST(ReadMjcf, LimitsCountFromTheStart) {
  const Imported read = read_text("m.xml", machine);
  const auto desc = [&](const std::string& name) { return read.scene.joints[read.scene.joint(name)].desc; };
  EXPECT_NEAR(desc("elbow").limits[3].lower, -0.5, 1e-12);
  EXPECT_NEAR(desc("elbow").limits[3].upper, 1.0, 1e-12);
  EXPECT_EQ(desc("elbow").motors[3].max_force, 0.4);
  EXPECT_EQ(read.efforts[read.scene.joint("elbow")][3], 30);
  const PlumbSpring& spring = desc("elbow").springs[3];
  EXPECT_EQ(spring.mode, static_cast<PlumbSpringMode>(PLUMB_SPRING_STIFFNESS));
  EXPECT_EQ(spring.frequency, 6);
  EXPECT_EQ(spring.damping_ratio, 0.3);
  EXPECT_NEAR(spring.rest, 0.3, 1e-12);  // .5 where the start is called .2
  EXPECT_EQ(desc("shoulder_y").limits[3].upper, 1);
  EXPECT_EQ(desc("shoulder_y").limits[4].enabled, 0u);
  EXPECT_EQ(read.scene.dt, 0.004);
  EXPECT_NEAR(read.scene.gravity.y, -3.7, 1e-12);
}

TEST(ReadMjcf, SlidesAndHingesOfOneBodyAreOneJoint) {
  const Imported read = read_text("m.xml", machine);
  const SceneJoint& joint = read.scene.joints[read.scene.joint("cart_x")];
  EXPECT_FALSE(joint.body_a.has_value());
  const Pose place = place_of(read.scene, joint);
  EXPECT_LT((place.rotation.col(0) - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((place.rotation.col(1) - Vec3(0, -1, 0)).norm(), 1e-12);
  const auto mode = [&](std::size_t axis) { return joint.desc.axis_modes[axis]; };
  EXPECT_EQ(mode(0), static_cast<PlumbAxisMode>(PLUMB_AXIS_FREE));
  EXPECT_EQ(mode(1), static_cast<PlumbAxisMode>(PLUMB_AXIS_LIMITED));
  EXPECT_EQ(mode(2), static_cast<PlumbAxisMode>(PLUMB_AXIS_LOCKED));
  EXPECT_EQ(mode(3), static_cast<PlumbAxisMode>(PLUMB_AXIS_LOCKED));
  EXPECT_EQ(mode(5), static_cast<PlumbAxisMode>(PLUMB_AXIS_FREE));
  EXPECT_EQ(joint.desc.limits[1].upper, 2);
}

TEST(ReadMjcf, WhatCollidesIsWhatMujocoLetsCollide) {
  const Imported read = read_text("m.xml", R"(<mujoco><worldbody><geom name="floor" type="plane" size="1 1 1"/>
    <body name="a"><freejoint/><geom size="0.1" contype="1" conaffinity="0"/></body>
    <body name="b"><freejoint/><geom size="0.1" contype="1" conaffinity="0"/></body>
    <body name="c"><freejoint/><geom size="0.1" contype="2" conaffinity="1"/></body>
    <body name="d"><freejoint/><geom size="0.1" contype="0" conaffinity="0"/></body></worldbody></mujoco>)");
  const auto collide = [&](const std::string& one, const std::string& other) {
    const PlumbFilter &a = read.scene.bodies[read.scene.body(one)].desc.filter,
                      &b = read.scene.bodies[read.scene.body(other)].desc.filter;
    return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
  };
  EXPECT_TRUE(collide("worldbody", "a"));
  EXPECT_FALSE(collide("a", "b"));
  EXPECT_TRUE(collide("a", "c"));
  EXPECT_FALSE(collide("c", "c"));
  EXPECT_FALSE(read.scene.bodies[read.scene.body("d")].shape.has_value());
}

/// libsdformat and MuJoCo read the same URDF file, each by its own parser.
TEST(ReadMjcf, ReadsAUrdfFileAsLibsdformatDoes) {
  const auto file =
      write_file("r.urdf", R"(<robot name="r"><mujoco><compiler fusestatic="false" discardvisual="false"/></mujoco>
    <link name="base"><inertial><origin xyz="0.1 0 0"/><mass value="4"/><inertia ixx="1" ixy="0.1" ixz="0" iyy="1.5" iyz="0" izz="1.2"/></inertial>
      <collision><origin xyz="0 0.1 0" rpy="0.3 0 0.2"/><geometry><box size="0.4 0.2 0.6"/></geometry></collision></link>
    <link name="arm"><inertial><origin xyz="0 0 -0.5" rpy="0.1 0.2 0.3"/><mass value="2"/><inertia ixx="0.2" ixy="0" ixz="0" iyy="0.3" iyz="0" izz="0.4"/></inertial>
      <collision><origin xyz="0 0 -0.5" rpy="0 0.5 0"/><geometry><cylinder radius="0.1" length="1"/></geometry></collision></link>
    <link name="rod"><inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
    <joint name="root" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint><link name="world"/>
    <joint name="hinge" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0.5 0.1 0" rpy="0.2 0.4 1.5"/>
      <axis xyz="0 0.6 0.8"/><limit lower="-1" upper="1.5" effort="10" velocity="5"/></joint>
    <joint name="slide" type="prismatic"><parent link="arm"/><child link="rod"/><origin xyz="0 0 -1" rpy="0 1 0"/>
      <axis xyz="1 0 0"/><limit lower="-0.1" upper="0.2" effort="10" velocity="5"/></joint></robot>)");
  const Scene one = read_machine({file, {}}).scene, other = read_mjcf({file, {}}).scene;
  for (const std::string body : {"arm", "rod"}) {
    expect_same(pose_of(one, body), pose_of(other, body), 1e-9, body);
    expect_same(mass_of_body(one, one.body(body)), mass_of_body(other, other.body(body)), 1e-9, body);
  }
  for (const std::string name : {"hinge", "slide"}) {
    const SceneJoint &a = one.joints[one.joint(name)], &b = other.joints[other.joint(name)];
    EXPECT_EQ(a.desc.type, b.desc.type) << name;
    EXPECT_LT((place_of(one, a).position - place_of(other, b).position).norm(), 1e-9) << name;
    EXPECT_LT((place_of(one, a).rotation.col(0) - place_of(other, b).rotation.col(0)).norm(), 1e-9) << name;
    const std::size_t axis = name == "hinge" ? 3 : 0;
    EXPECT_EQ(a.desc.limits[axis].upper, b.desc.limits[axis].upper) << name;
  }
  const auto bounds = [](const Scene& scene) {
    const SceneBody& arm = scene.bodies[scene.body("arm")];
    return shape_of(scene, *arm.shape)->bounds(referee::pose(arm.desc.pose));
  };
  EXPECT_LT((bounds(one).low - bounds(other).low).norm() + (bounds(one).high - bounds(other).high).norm(), 1e-9);
}

/// A knee that would begin straight, where it cannot be.
constexpr const char* bent = R"(<mujoco><compiler angle="radian"/><worldbody>
  <body name="thigh" pos="0 0 2"><freejoint/><geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.05"/>
    <body name="shin" pos="0 0 -0.5"><joint name="knee" axis="0 1 0" limited="true" range="0.5 2" stiffness="3"/>
      <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.05"/>
      <body name="foot" pos="0 0 -0.5"><joint name="ankle" axis="1 0 0" limited="true" range="-1 1"/><geom size="0.1"/></body>
    </body></body></worldbody></mujoco>)";

TEST(ReadMjcf, WhatWouldBeginBeyondALimitBeginsAtIt) {
  const Imported read = read_text("m.xml", bent);
  const SceneJoint& knee = read.scene.joints[read.scene.joint("knee")];
  EXPECT_NEAR(knee.desc.limits[3].lower, 0, 1e-12);
  EXPECT_NEAR(knee.desc.limits[3].upper, 1.5, 1e-12);
  EXPECT_NEAR(knee.desc.springs[3].rest, -0.5, 1e-12) << "its spring pulls it straight";
  EXPECT_LT((place_of(read.scene, knee).position - Vec3(0, 1.5, 0)).norm(), 1e-12);
  const Vec3 foot(-0.5 * std::sin(0.5), 1.5 - 0.5 * std::cos(0.5), 0);
  EXPECT_LT((pose_of(read.scene, "foot").position - foot).norm(), 1e-12) << "what hangs on it comes along";
  const Vec3 ankle = place_of(read.scene, read.scene.joints[read.scene.joint("ankle")]).rotation.col(0);
  EXPECT_LT((ankle - Vec3(std::cos(0.5), -std::sin(0.5), 0)).norm(), 1e-12);
  EXPECT_TRUE(has_line(read.remarks, "begin at it: knee"));
}

TEST(ReadMjcf, ReadsWhatOtherVersionsOfMujocoTake) {
  const auto file = write_file("m.xml", R"(<mujoco><compiler angle="radian"/><include file="eyes.xml"/><worldbody>
    <include file="legs.xml"/></worldbody></mujoco>)");
  std::ofstream(file.parent_path() / "eyes.xml")
      << R"(<mujoco><asset><texture name="t" type="2d" file="gone.png"/><material name="m" texture="t"/></asset></mujoco>)";
  std::ofstream(file.parent_path() / "legs.xml")
      << R"(<mujoco><include file="leg.xml"/><include file="leg.xml"/></mujoco>)";
  std::ofstream(file.parent_path() / "leg.xml")
      << R"(<mujoco><body><joint axis="0 1 0" range="-0.5 1"/><geom size="0.1" material="m"/></body></mujoco>)";
  const Scene scene = read_machine({file, {}}).scene;
  ASSERT_EQ(scene.joints.size(), 2U);
  for (const SceneJoint& joint : scene.joints) EXPECT_NEAR(joint.desc.limits[3].upper, 1, 1e-12);
  std::ofstream(file.parent_path() / "leg.xml") << R"(<mujoco><include file="leg.xml"/></mujoco>)";
  EXPECT_THROW((void)read_machine({file, {}}), UsageError) << "a file that includes itself";
}

TEST(ReadMjcf, ReadsWhatIsPacked) {
  const auto file = write_file("m.xml", R"(<mujoco><worldbody><include file="leg.xml"/></worldbody></mujoco>)");
  pack(file);
  std::ofstream(file.parent_path() / "leg.xml")
      << "<mujoco><body name='leg'><freejoint/><geom size='0.1'/></body></mujoco>";
  pack(file.parent_path() / "leg.xml");
  EXPECT_EQ(read_machine({file.string() + ".gz", {}}).scene.bodies.at(0).name, "leg");
}

TEST(ReadMjcf, WhatTheModelSwitchesOffIsOff) {
  const auto with = [](const std::string& option) {
    return read_text("m.xml", "<mujoco><option " + option +
                                  "</option><worldbody><body name='b'><freejoint/><geom size='1'/></body></worldbody>"
                                  "<contact><exclude body1='b' body2='world'/></contact></mujoco>");
  };
  EXPECT_TRUE(with(">").scene.bodies.at(0).shape.has_value());
  EXPECT_FALSE(with("collision='predefined'>").scene.bodies.at(0).shape.has_value());
  EXPECT_FALSE(with("><flag contact='disable'/>").scene.bodies.at(0).shape.has_value());
  EXPECT_NE(with(">").scene.gravity.y, 0);
  EXPECT_EQ(with("><flag gravity='disable'/>").scene.gravity.y, 0);
  EXPECT_TRUE(has_line(with("density='1000'>").remarks, "drag of a medium is left out"));
}

TEST(ReadMjcf, SaysWhatIsWrongAndWhatIsLeftOut) {
  const auto expect = [](const std::string& content, const std::string& words) {
    const std::string failure = failure_of("m.xml", content);
    EXPECT_NE(failure.find(words), std::string::npos) << failure;
  };
  expect("<mujoco><worldbody><body><joint type='hinge'/></body></worldbody></mujoco>", "m.xml");
  expect("<mujoco><wordlbody/></mujoco>", "wordlbody");
  expect(
      "<mujoco><worldbody><body name='b'><joint type='ball'/><joint type='hinge'/><geom "
      "size='1'/></body></worldbody></mujoco>",
      "b");
  expect(
      "<mujoco><worldbody><body name='b'><joint type='slide' axis='1 0 0'/><joint type='slide' axis='1 1 0'/><geom "
      "size='1'/></body>"
      "</worldbody></mujoco>",
      "directions that are neither square");
  const Imported read = read_text("m.xml", machine);
  EXPECT_TRUE(has_line(read.remarks, "actuators are left out: actuator0"));
  EXPECT_TRUE(has_line(read.remarks, "ellipsoids are hulls of 64 corners"));
}

}  // namespace
}  // namespace plumb::harness::testing
