// What SDF and URDF say is what the scene has: poses, masses, shapes, joints, in a world whose y is up.
#include <cmath>

#include "machine_files.hpp"

namespace plumb::harness::testing {
namespace {

using referee::Vec3;

std::string world(const std::string& content) {
  return R"(<?xml version="1.0"?><!-- a world --><sdf version="1.7"><world name="w"><gravity>0 0 -3.7</gravity>
<physics name="p" type="ode"><max_step_size>0.004</max_step_size><real_time_factor>1</real_time_factor></physics>)" +
         content + "</world></sdf>";
}

std::string link(const std::string& name, const std::string& content, const std::string& mass = "2") {
  return "<link name='" + name + "'><inertial><mass>" + mass +
         "</mass><inertia><ixx>0.2</ixx><iyy>0.3</iyy><izz>0.4</izz></inertia></inertial>" + content + "</link>";
}

std::string collision(const std::string& geometry, const std::string& more = "") {
  return "<collision name='c'>" + more + "<geometry>" + geometry + "</geometry></collision>";
}

TEST(ReadSdf, TurnsTheWorldSoThatYIsUp) {
  const Imported read = read_text(
      "a.sdf",
      world("<model name='m'><pose>1 2 3 0 0 0.5</pose>" +
            link("l", "<pose>0 0 1 0 0 0</pose>" + collision("<sphere><radius>0.5</radius></sphere>")) + "</model>"));
  const Scene& scene = read.scene;
  EXPECT_NEAR(scene.gravity.y, -3.7, 1e-12);
  EXPECT_NEAR(scene.gravity.z, 0, 1e-12);
  EXPECT_EQ(scene.dt, 0.004);
  const referee::Pose pose = pose_of(scene, "m::l");
  EXPECT_LT((pose.position - Vec3(1, 4, -2)).norm(), 1e-12);
  EXPECT_LT((pose.rotation * Vec3::UnitZ() - Vec3::UnitY()).norm(), 1e-12) << "the link's z is up";
  EXPECT_LT((pose.rotation * Vec3::UnitX() - Vec3(std::cos(0.5), 0, -std::sin(0.5))).norm(), 1e-12);
}

TEST(ReadSdf, TakesShapesAsTheyLie) {
  const auto shape = [](const std::string& geometry, const std::string& pose) {
    const Imported read =
        read_text("a.sdf", world("<model name='m'>" + link("l", collision(geometry, pose)) + "</model>"));
    const SceneBody& body = read.scene.bodies.at(0);
    return shape_of(read.scene, *body.shape)->bounds(referee::pose(body.desc.pose));
  };
  const auto expect = [&](const std::string& geometry, const Vec3& low, const Vec3& high,
                          const std::string& pose = "") {
    const referee::Aabb bounds = shape(geometry, pose);
    EXPECT_LT((bounds.low - low).norm(), 1e-9) << geometry << bounds.low.transpose();
    EXPECT_LT((bounds.high - high).norm(), 1e-9) << geometry << bounds.high.transpose();
  };
  expect("<box><size>2 4 6</size></box>", {-1, -3, -2}, {1, 3, 2});
  expect("<box><size>2 4 6</size></box>", {9, -1, -2}, {11, 5, 2}, "<pose>10 0 2 0 0 0</pose>");
  expect("<cylinder><radius>1</radius><length>6</length></cylinder>", {-1, -3, -1}, {1, 3, 1});
  expect("<cylinder><radius>1</radius><length>6</length></cylinder>", {-3, -1, -1}, {3, 1, 1},
         "<pose>0 0 0 0 1.5707963267948966 0</pose>");
  expect("<capsule><radius>1</radius><length>6</length></capsule>", {-1, -4, -1}, {1, 4, 1});
  const referee::Aabb ellipsoid = shape("<ellipsoid><radii>1 2 3</radii></ellipsoid>", "");
  EXPECT_NEAR(ellipsoid.high.x(), 1, 0.03);
  EXPECT_NEAR(ellipsoid.high.y(), 3, 0.1);
  EXPECT_NEAR(ellipsoid.high.z(), 2, 0.06);
}

TEST(ReadSdf, TakesMassesWithTheirAxes) {
  const Imported read =
      read_text("a.sdf", world(R"(<model name='m'><link name='l'><pose>0 0 0 0.3 0.2 0.1</pose><inertial>
    <pose>0.1 0.2 0.3 0.4 0 0</pose><mass>5</mass><inertia><ixx>1</ixx><ixy>0.1</ixy><ixz>-0.05</ixz><iyy>1.2</iyy>
    <iyz>0.02</iyz><izz>0.9</izz></inertia></inertial></link></model>)"));
  const referee::Mass mass = mass_of_body(read.scene, 0);
  const referee::Mat3 turn = Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix();
  const referee::Mat3 given = (referee::Mat3() << 1, 0.1, -0.05, 0.1, 1.2, 0.02, -0.05, 0.02, 0.9).finished();
  expect_same(mass, referee::Mass{5, {0.1, 0.2, 0.3}, turn * given * turn.transpose()}, 1e-12, "mass");
}

/// Two links, the second on a joint at its origin, 1 m above.
std::string jointed(const std::string& joint) {
  return world("<model name='m'><pose>0 0 5 0 0 0</pose>" + link("a", "") + link("b", "<pose>0 0 1 0 0 0</pose>") +
               joint + "</model>");
}

TEST(ReadSdf, TakesJointsWithAxesLimitsAndFriction) {
  const Imported read = read_text("a.sdf", jointed(R"(<joint name='j' type='revolute'><parent>a</parent><child>b</child>
    <pose>0 0.5 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>2</upper><effort>7</effort></limit>
    <dynamics><friction>0.3</friction><damping>0.1</damping><spring_stiffness>5</spring_stiffness>
    <spring_reference>0.2</spring_reference></dynamics></axis></joint>)"));
  const SceneJoint& joint = read.scene.joints.at(0);
  EXPECT_EQ(joint.desc.type, static_cast<PlumbJointType>(PLUMB_JOINT_HINGE));
  EXPECT_EQ(joint.body_a, read.scene.body("m::a"));
  EXPECT_EQ(joint.body_b, read.scene.body("m::b"));
  const referee::Pose place = place_of(read.scene, joint);
  EXPECT_LT((place.position - Vec3(0, 6, -0.5)).norm(), 1e-12);
  EXPECT_LT((place.rotation * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-12);
  expect_same(pose_of(read.scene, "m::a") * referee::pose(joint.desc.frame_a), place, 1e-12, "both frames");
  EXPECT_EQ(joint.desc.limits[3].lower, -1);
  EXPECT_EQ(joint.desc.limits[3].upper, 2);
  EXPECT_EQ(joint.desc.motors[3].max_force, 0.3);
  EXPECT_EQ(read.efforts.at(0)[3], 7);
  const PlumbSpring& spring = joint.desc.springs[3];
  EXPECT_EQ(spring.mode, static_cast<PlumbSpringMode>(PLUMB_SPRING_STIFFNESS));
  EXPECT_EQ(spring.enabled, 1U);
  EXPECT_EQ(spring.frequency, 5);
  EXPECT_EQ(spring.damping_ratio, 0.1);
  EXPECT_EQ(spring.rest, 0.2);
}

TEST(ReadSdf, TakesEveryKindOfJoint) {
  const auto type = [](const std::string& kind, const std::string& axes) {
    const Imported read = read_text(
        "a.sdf", jointed("<joint name='j' type='" + kind + "'><parent>a</parent><child>b</child>" + axes + "</joint>"));
    return read.scene.joints.at(0).desc;
  };
  const std::string axis = "<axis><xyz>1 0 0</xyz></axis>", axis2 = "<axis2><xyz>0 1 0</xyz></axis2>";
  EXPECT_EQ(type("continuous", axis).type, static_cast<PlumbJointType>(PLUMB_JOINT_HINGE));
  EXPECT_EQ(type("continuous", axis).limits[3].enabled, 0u);
  EXPECT_EQ(type("prismatic", axis).type, static_cast<PlumbJointType>(PLUMB_JOINT_SLIDER));
  EXPECT_EQ(type("ball", "").type, static_cast<PlumbJointType>(PLUMB_JOINT_BALL));
  EXPECT_EQ(type("fixed", "").type, static_cast<PlumbJointType>(PLUMB_JOINT_FIXED));
  EXPECT_EQ(type("universal", axis + axis2).type, static_cast<PlumbJointType>(PLUMB_JOINT_UNIVERSAL));
  const PlumbJointDesc desc =
      type("prismatic", "<axis><xyz>1 0 0</xyz><limit><lower>0</lower><upper>0.5</upper></limit></axis>");
  EXPECT_EQ(desc.limits[0].upper, 0.5);
}

TEST(ReadSdf, TheWorldHolds) {
  const Imported read =
      read_text("a.sdf", jointed("<joint name='j' type='ball'><parent>world</parent><child>b</child></joint>"));
  const SceneJoint& joint = read.scene.joints.at(0);
  EXPECT_FALSE(joint.body_a.has_value());
  EXPECT_LT((place_of(read.scene, joint).position - Vec3(0, 6, 0)).norm(), 1e-12);
  expect_same(referee::pose(joint.desc.frame_a), place_of(read.scene, joint), 1e-12, "both frames");
}

TEST(ReadSdf, LinksOfAModelTouchEachOtherOnlyWhereItSaysSo) {
  const std::string ball = collision("<sphere><radius>1</radius></sphere>");
  const std::string two = link("a", ball) + link("b", ball);
  const Imported read =
      read_text("a.sdf", world("<model name='m'>" + two + "</model><model name='n'>" + two +
                               "</model><model name='s'><self_collide>true</self_collide>" + two + "</model>"));
  const auto group = [&](const std::string& body) {
    return read.scene.bodies[read.scene.body(body)].desc.filter.group;
  };
  EXPECT_LT(group("m::a"), 0);
  EXPECT_EQ(group("m::a"), group("m::b"));
  EXPECT_NE(group("m::a"), group("n::a"));
  EXPECT_EQ(group("s::a"), 0);
}

TEST(ReadSdf, TheGroundThatMostWorldsIncludeIsThere) {
  const Imported read = read_text(
      "a.sdf", world("<include><uri>model://ground_plane</uri></include><include><uri>model://sun</uri></include>"));
  ASSERT_EQ(read.scene.bodies.size(), 1u);
  const SceneBody& ground = read.scene.bodies[0];
  EXPECT_EQ(read.scene.shapes[*ground.shape].desc.type, static_cast<PlumbShapeType>(PLUMB_PLANE));
  EXPECT_LT((referee::pose(ground.desc.pose).rotation.col(1) - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_TRUE(has_line(read.remarks, "lights and actors are left out"));
}

TEST(ReadSdf, ModelsWithinModelsHaveTheirNamesAndPlaces) {
  const Imported read =
      read_text("a.sdf", world("<model name='m'><pose>1 0 0 0 0 0</pose>" + link("a", "") +
                               "<model name='n'><pose>0 0 2 0 0 0</pose>" + link("b", "") +
                               "</model>"
                               "<joint name='j' type='fixed'><parent>a</parent><child>n::b</child></joint></model>"));
  EXPECT_LT((pose_of(read.scene, "m::n::b").position - Vec3(1, 2, 0)).norm(), 1e-12);
  EXPECT_EQ(read.scene.joints.at(0).body_b, read.scene.body("m::n::b"));
}

constexpr const char* tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(ReadSdf, MeshesAreFoundBesideTheFileAndInPackages) {
  const auto folder = own_folder();
  std::filesystem::create_directories(folder / "robot/meshes");
  std::ofstream(folder / "robot/meshes/t.obj") << tetrahedron;
  for (const std::string uri : {"meshes/t.obj", "model://robot/meshes/t.obj", "package://robot/meshes/t.obj"}) {
    std::ofstream(folder / "robot/r.sdf")
        << world("<model name='m'>" + link("l", collision("<mesh><uri>" + uri + "</uri><scale>2 2 2</scale></mesh>")) +
                 "</model><model name='s'><static>true</static>" +
                 link("l", collision("<mesh><uri>" + uri + "</uri><scale>-1 1 1</scale></mesh>")) + "</model>");
    const Imported read = read_machine({folder / "robot/r.sdf", {}});
    const referee::ShapePtr hull = shape_of(read.scene, *read.scene.bodies[read.scene.body("m::l")].shape);
    EXPECT_EQ(hull->type(), static_cast<PlumbShapeType>(PLUMB_CONVEX_HULL));
    EXPECT_NEAR(referee::mass_of(*hull, 1).mass, 8.0 / 6, 1e-6) << uri;
    const referee::ShapePtr mesh = shape_of(read.scene, *read.scene.bodies[read.scene.body("s::l")].shape);
    ASSERT_EQ(mesh->triangles().size(), 4u);
    EXPECT_NEAR(referee::mass_of(*mesh, 1).mass, 1.0 / 6, 1e-6) << "turned inside out by its mirror";
  }
}

TEST(ReadSdf, MeshesAreFoundInAPackageWhoseFolderHasAnotherName) {
  const auto folder = own_folder();
  std::filesystem::create_directories(folder / "arm/meshes");
  std::ofstream(folder / "arm/meshes/t.obj") << tetrahedron;
  std::ofstream(folder / "arm/a.sdf") << world(
      "<model name='m'>" + link("l", collision("<mesh><uri>package://robot/meshes/t.obj</uri></mesh>")) + "</model>");
  EXPECT_EQ(read_machine({folder / "arm/a.sdf", {}}).scene.shapes.at(0).vertices.size(), 12U);
}

TEST(ReadSdf, ReadsWhatIsPacked) {
  const auto file = write_file("a.sdf", world("<model name='m'>" + link("l", "") + "</model>"));
  pack(file);
  EXPECT_EQ(read_machine({file.string() + ".gz", {}}).scene.bodies.at(0).name, "m::l");
}

TEST(ReadSdf, MeshesAreFoundInFoldersThatTheUserNames) {
  const auto folder = own_folder();
  std::filesystem::create_directories(folder / "far/robot/meshes");
  std::filesystem::create_directories(folder / "here");
  std::ofstream(folder / "far/robot/meshes/t.obj") << tetrahedron;
  std::ofstream(folder / "here/r.sdf") << world(
      "<model name='m'>" + link("l", collision("<mesh><uri>model://robot/meshes/t.obj</uri></mesh>")) + "</model>");
  EXPECT_THROW((void)read_machine({folder / "here/r.sdf", {}}), UsageError);
  for (const char* named : {"far", "far/robot"})
    EXPECT_EQ(read_machine({folder / "here/r.sdf", {folder / named}}).scene.bodies.size(), 1u) << named;
}

TEST(ReadSdf, UrdfIsTheSameMachineAsItsSdf) {
  const Imported urdf = read_text("a.urdf", R"(<robot name="r">
    <link name="base"><inertial><mass value="4"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
    <link name="arm"><inertial><origin xyz="0 0 -0.5"/><mass value="2"/><inertia ixx="0.2" ixy="0" ixz="0" iyy="0.3" iyz="0" izz="0.4"/></inertial>
      <collision><origin xyz="0 0 -0.5"/><geometry><cylinder radius="0.1" length="1"/></geometry></collision></link>
    <joint name="hinge" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0.5 0 0" rpy="0 0 1.5707963267948966"/>
      <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="5"/></joint></robot>)");
  const Scene& scene = urdf.scene;
  const referee::Pose place = place_of(scene, scene.joints.at(0));
  EXPECT_LT((place.position - Vec3(0.5, 0, 0)).norm(), 1e-9);
  EXPECT_LT((place.rotation.col(0) - Vec3(-1, 0, 0)).norm(), 1e-9) << place.rotation.col(0).transpose();
  EXPECT_EQ(scene.joints[0].desc.limits[3].upper, 1);
  EXPECT_EQ(urdf.efforts[0][3], 10);
  const referee::Mass arm = mass_of_body(scene, scene.body("arm"));
  EXPECT_LT((arm.centre - Vec3(0, 0, -0.5)).norm(), 1e-9);
  const SceneBody& body = scene.bodies[scene.body("arm")];
  const referee::Aabb bounds = shape_of(scene, *body.shape)->bounds(referee::pose(body.desc.pose));
  EXPECT_NEAR(bounds.low.y(), -1, 1e-9);
  EXPECT_NEAR(bounds.high.y(), 0, 1e-9);
}

TEST(ReadSdf, SaysWhatIsWrong) {
  const auto expect = [](const std::string& content, const std::string& words) {
    const std::string failure = failure_of("a.sdf", content);
    EXPECT_NE(failure.find(words), std::string::npos) << failure;
  };
  expect("", "this is no XML");
  expect("<html/>", "it begins with <html>");
  expect("<sdf version='1.7'><world name='w'>", "a.sdf");
  expect(world("<include><uri>model://nowhere</uri></include>"), "model://nowhere");
  expect(
      jointed("<joint name='j' type='screw'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>"),
      "\"m::j\" is a screw");
  expect(jointed(
             "<joint name='j' type='revolute'><parent>a</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint>"),
         "c");
  expect(world("<model name='m'>" + link("l", "", "0") + "</model>"), "mass");
  expect(world("<model name='m'><link "
               "name='l'><inertial><mass>5</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>3</izz></inertia>"
               "</inertial></link></model>"),
         "invalid inertia");
  expect(world("<model name='m'>" + link("l", collision("<mesh><uri>gone.stl</uri></mesh>")) + "</model>"),
         "gone.stl, and there is no");
  expect(
      world("<model name='m'>" + link("l", collision("<mesh><uri>model://robot/gone.stl</uri></mesh>")) + "</model>"),
      "name the folder that holds robot by --folder");
  expect(world("<model name='m'>" + link("l", collision("<plane><normal>0 0 1</normal></plane>")) + "</model>"),
         "a plane or a surface cannot");
}

}  // namespace
}  // namespace plumb::harness::testing
