// What KHR_physics_rigid_bodies says is what the scene has: bodies of nodes, colliders where they lie, joints of
// limits.
#include <cmath>

#include "machine_files.hpp"

namespace plumb::harness::testing {
namespace {

using referee::Vec3;

constexpr const char* shapes = R"({"type":"box","box":{"size":[2,4,6]}},{"type":"sphere","sphere":{"radius":0.5}},
  {"type":"cylinder","cylinder":{"height":2,"radiusTop":1,"radiusBottom":1}},{"type":"plane","plane":{}},
  {"type":"capsule","capsule":{"height":2,"radiusTop":0.2,"radiusBottom":0.4}})";

/// A file with these nodes, of which the first `roots` stand in its scene, and this content of the extension.
std::string file_of(const std::string& nodes, int roots, const std::string& extension = "",
                    const std::string& more = "") {
  std::string scene;
  for (int i = 0; i < roots; ++i) scene += (i == 0 ? "" : ",") + std::to_string(i);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + scene + R"(]}],"nodes":[)" + nodes + "]" +
         more + R"(,"extensions":{"KHR_implicit_shapes":{"shapes":[)" + shapes + R"(]},"KHR_physics_rigid_bodies":{)" +
         extension + "}}}";
}

std::string node(const std::string& name, const std::string& physics, const std::string& more = "") {
  return R"({"name":")" + name + R"(",)" + more + R"("extensions":{"KHR_physics_rigid_bodies":{)" + physics + "}}}";
}

std::string collider(int shape, const std::string& more = "") {
  return R"("collider":{"geometry":{"shape":)" + std::to_string(shape) + "}" + more + "}";
}

Imported read(const std::string& text) { return read_text("a.gltf", text); }

referee::Aabb bounds_of(const Scene& scene, const std::string& name) {
  const SceneBody& body = scene.bodies[scene.body(name)];
  return shape_of(scene, *body.shape)->bounds(referee::pose(body.desc.pose));
}

TEST(ReadGltf, BodiesHaveTheCollidersOfTheirNodesAndOfThoseBelow) {
  const Imported imported = read(file_of(
      node("trunk", R"("motion":{"mass":3},)" + collider(1),
           R"("translation":[1,2,3],"scale":[2,2,2],"children":[2],)") +
          "," + node("wall", collider(0), R"("translation":[0,0,-9],"rotation":[0,0,0.70710678118,0.70710678118],)") +
          "," + node("arm", collider(0), R"("translation":[0,3,0],)"),
      2));
  const Scene& scene = imported.scene;
  ASSERT_EQ(scene.bodies.size(), 2u);
  const referee::Aabb trunk = bounds_of(scene, "trunk");
  EXPECT_LT((trunk.low - Vec3(-1, 1, -3)).norm(), 1e-9) << trunk.low.transpose();
  EXPECT_LT((trunk.high - Vec3(3, 12, 9)).norm(), 1e-9) << trunk.high.transpose();
  EXPECT_NEAR(mass_of_body(scene, scene.body("trunk")).mass, 3, 1e-12);
  const SceneBody& wall = scene.bodies[scene.body("wall")];
  EXPECT_EQ(wall.desc.motion, static_cast<PlumbMotion>(PLUMB_STATIC));
  EXPECT_LT((bounds_of(scene, "wall").high - Vec3(2, 1, -6)).norm(), 1e-9);
  EXPECT_EQ(wall.desc.material.friction, 0.6) << "what glTF says where a file says nothing";
}

TEST(ReadGltf, TakesMotionsAsTheySay) {
  const Imported imported = read(file_of(
      node(
          "a",
          R"("motion":{"mass":2,"centerOfMass":[0,1,0],"inertiaDiagonal":[1,2,2.5],"inertiaOrientation":[0,0,0.70710678118,0.70710678118],
        "linearVelocity":[1,0,0],"angularVelocity":[0,3,0],"gravityFactor":0.5},)" +
              collider(1),
          R"("rotation":[0,0.70710678118,0,0.70710678118],)") +
          "," + node("b", R"("motion":{"isKinematic":true,"linearVelocity":[0,1,0]},)" + collider(1)) + "," +
          node("c", R"("motion":{"mass":1,"inertiaDiagonal":[0,0,0]},)" + collider(1)),
      3));
  const PlumbBodyDesc& a = imported.scene.bodies[0].desc;
  EXPECT_LT((referee::vec(a.linear_velocity) - Vec3(0, 0, -1)).norm(), 1e-9) << "in the node's axes";
  EXPECT_LT((referee::vec(a.angular_velocity) - Vec3(0, 3, 0)).norm(), 1e-9);
  EXPECT_EQ(a.gravity_scale, 0.5);
  const referee::Mass mass = mass_of_body(imported.scene, 0);
  EXPECT_LT((mass.centre - Vec3(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((mass.inertia.diagonal() - Vec3(2, 1, 2.5)).norm(), 1e-8) << "turned by a quarter about z";
  EXPECT_EQ(imported.scene.bodies[1].desc.motion, static_cast<PlumbMotion>(PLUMB_KINEMATIC));
  EXPECT_EQ(imported.scene.bodies[1].desc.linear_velocity.y, 1);
  EXPECT_NE(imported.scene.bodies[2].desc.flags & PLUMB_BODY_NO_ROTATION, 0u);
}

/// Node a and node b of one place, b joined to a by limits; what node b is.
Imported jointed(const std::string& limits, const std::string& b, const std::string& drives = "") {
  return read(
      file_of(node("a", R"("motion":{},"joint":{"connectedNode":1,"joint":0},)" + collider(1)) + "," + node("b", b), 2,
              R"("physicsJoints":[{"limits":[)" + limits + R"(],"drives":[)" + drives + "]}]"));
}

constexpr const char* in_place = R"({"linearAxes":[0,1,2],"min":0,"max":0})";

TEST(ReadGltf, LimitsMakeTheJointThatTheyAre) {
  const auto desc = [](const std::string& limits) {
    return jointed(limits, R"("motion":{},)" + collider(1)).scene.joints.at(0).desc;
  };
  const std::string placed = in_place;
  EXPECT_EQ(desc(placed).type, static_cast<PlumbJointType>(PLUMB_JOINT_BALL));
  EXPECT_EQ(desc(placed + R"(,{"angularAxes":[0,1,2],"max":0})").type, static_cast<PlumbJointType>(PLUMB_JOINT_FIXED));
  const PlumbJointDesc hinge =
      desc(placed + R"(,{"angularAxes":[0,1],"max":0},{"angularAxes":[2],"min":-0.5,"max":1})");
  EXPECT_EQ(hinge.type, static_cast<PlumbJointType>(PLUMB_JOINT_HINGE));
  EXPECT_LT((referee::pose(hinge.frame_a).rotation.col(0) - Vec3::UnitZ()).norm(), 1e-12) << "its x is the file's z";
  EXPECT_EQ(hinge.limits[3].lower, -0.5);
  EXPECT_EQ(hinge.limits[3].upper, 1);
  const PlumbJointDesc slider =
      desc(R"({"linearAxes":[0,2],"max":0},{"linearAxes":[1],"min":0,"max":2},{"angularAxes":[0,1,2],"max":0})");
  EXPECT_EQ(slider.type, static_cast<PlumbJointType>(PLUMB_JOINT_SLIDER));
  EXPECT_LT((referee::pose(slider.frame_b).rotation.col(0) - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_EQ(slider.limits[0].upper, 2);
  EXPECT_EQ(desc(placed + R"(,{"angularAxes":[2],"min":0,"max":0})").type,
            static_cast<PlumbJointType>(PLUMB_JOINT_UNIVERSAL));
  const PlumbJointDesc string = desc(R"({"linearAxes":[0,1,2],"max":2})");
  EXPECT_EQ(string.type, static_cast<PlumbJointType>(PLUMB_JOINT_DISTANCE));
  EXPECT_EQ(string.limits[0].upper, 2);
  const PlumbJointDesc generic = desc(R"({"linearAxes":[0],"min":-1,"max":1},{"linearAxes":[1],"max":0,"min":0})");
  EXPECT_EQ(generic.type, static_cast<PlumbJointType>(PLUMB_JOINT_GENERIC));
  EXPECT_EQ(generic.axis_modes[0], static_cast<PlumbAxisMode>(PLUMB_AXIS_LIMITED));
  EXPECT_EQ(generic.axis_modes[1], static_cast<PlumbAxisMode>(PLUMB_AXIS_LOCKED));
  EXPECT_EQ(generic.axis_modes[2], static_cast<PlumbAxisMode>(PLUMB_AXIS_FREE));
}

TEST(ReadGltf, FromTheWorldAJointGoesTheOtherWay) {
  const std::string limits =
      std::string(in_place) + R"(,{"angularAxes":[1,2],"max":0},{"angularAxes":[0],"min":-0.5,"max":1})";
  const std::string drive =
      R"({"type":"angular","mode":"force","axis":0,"velocityTarget":2,"damping":100,"maxForce":7})";
  const PlumbJointDesc both = jointed(limits, R"("motion":{},)" + collider(1), drive).scene.joints.at(0).desc;
  EXPECT_EQ(both.limits[3].upper, 1);
  EXPECT_EQ(both.motors[3].target_velocity, 2);
  EXPECT_EQ(both.motors[3].max_force, 7);
  const Imported world = jointed(limits, collider(1), drive);
  EXPECT_FALSE(world.scene.joints.at(0).body_a.has_value());
  EXPECT_EQ(world.scene.joints[0].desc.limits[3].upper, 0.5);
  EXPECT_EQ(world.scene.joints[0].desc.limits[3].lower, -1);
  EXPECT_EQ(world.scene.joints[0].desc.motors[3].target_velocity, -2);
}

TEST(ReadGltf, DrivesToAPlaceAreSprings) {
  const std::string limits =
      std::string(in_place) + R"(,{"angularAxes":[1,2],"max":0},{"angularAxes":[0],"min":-0.5,"max":1})";
  const std::string drive =
      R"({"type":"angular","mode":"force","axis":0,"positionTarget":0.4,"stiffness":50,"damping":7)";
  const auto spring = [&](const std::string& b, const std::string& more) {
    return jointed(limits, b, drive + more + "}").scene.joints.at(0).desc.springs[3];
  };
  const std::string moves = R"("motion":{},)" + collider(1);
  const PlumbSpring both = spring(moves, "");
  EXPECT_EQ(std::tie(both.rest, both.frequency, both.damping_ratio), std::make_tuple(0.4, 50.0, 7.0));
  EXPECT_EQ(both.mode, static_cast<PlumbSpringMode>(PLUMB_SPRING_STIFFNESS));
  EXPECT_EQ(spring(collider(1), "").rest, -0.4) << "from the world it goes the other way";
  EXPECT_EQ(spring(moves, R"(,"maxForce":9)").enabled, 0U) << "no spring has a strongest force";
  EXPECT_EQ(spring(moves, R"(,"velocityTarget":1)").enabled, 0U);
}

TEST(ReadGltf, NodesOfOneNameAreBodiesOfSeveral) {
  const std::string ball = R"("motion":{},)" + collider(1);
  const Scene scene = read(file_of(node("a", ball) + "," + node("a", ball) + "," + node("world", ball), 3)).scene;
  EXPECT_EQ(scene.bodies[0].name, "a");
  EXPECT_EQ(scene.bodies[1].name, "a.2");
  EXPECT_EQ(scene.bodies[2].name, "world_");
}

TEST(ReadGltf, SystemsSayWhatCollides) {
  const auto ball = [](const std::string& name, int filter) {
    return node(name,
                R"("motion":{},)" + collider(1, filter < 0 ? "" : R"(,"collisionFilter":)" + std::to_string(filter)));
  };
  const Scene scene =
      read(
          file_of(
              ball("red", 0) + "," + ball("blue", 1) + "," + ball("ghost", 2) + "," + ball("any", -1), 4,
              R"("collisionFilters":[{"collisionSystems":["red"]},{"collisionSystems":["blue"],"notCollideWithSystems":["red"]},
                                      {"collisionSystems":["ghost"],"collideWithSystems":["blue"]}])"))
          .scene;
  const auto collide = [&](const std::string& one, const std::string& other) {
    const PlumbFilter &a = scene.bodies[scene.body(one)].desc.filter, &b = scene.bodies[scene.body(other)].desc.filter;
    return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
  };
  EXPECT_TRUE(collide("red", "any"));
  EXPECT_TRUE(collide("blue", "any"));
  EXPECT_FALSE(collide("red", "blue"));
  EXPECT_TRUE(collide("ghost", "blue"));
  EXPECT_FALSE(collide("ghost", "red"));
  EXPECT_FALSE(collide("ghost", "any"));
}

/// A tetrahedron of volume 1/6: four positions, twelve indices of two bytes.
constexpr const char* mesh_of_accessors = R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
  "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
    {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
  "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
  "buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAACAAEAAAABAAMAAAADAAIAAQACAAMA"}])";

TEST(ReadGltf, MeshesAreHullsWhereTheyMove) {
  const std::string geometry = R"("collider":{"geometry":{"node":0}})";
  const Scene scene = read(file_of(node("still", geometry, R"("mesh":0,"scale":[-2,1,1],)") + "," +
                                       node("moving", R"("motion":{},)" + geometry, R"("scale":[2,2,2],)"),
                                   2, "", mesh_of_accessors))
                          .scene;
  const auto volume = [&](const std::string& name) {
    return referee::mass_of(*shape_of(scene, *scene.bodies[scene.body(name)].shape), 1).mass;
  };
  EXPECT_EQ(shape_of(scene, *scene.bodies[0].shape)->type(), static_cast<PlumbShapeType>(PLUMB_TRIANGLE_MESH));
  EXPECT_NEAR(volume("still"), 2.0 / 6, 1e-6);
  EXPECT_LT((bounds_of(scene, "still").low - Vec3(-2, 0, 0)).norm(), 1e-6) << "mirrored";
  EXPECT_EQ(shape_of(scene, *scene.bodies[1].shape)->type(), static_cast<PlumbShapeType>(PLUMB_CONVEX_HULL));
  EXPECT_NEAR(volume("moving"), 8.0 / 6, 1e-6);
}

TEST(ReadGltf, TaperedShapesAreHulls) {
  const Scene scene = read(file_of(node("a", R"("motion":{},)" + collider(4)), 1)).scene;
  const referee::Aabb bounds = bounds_of(scene, "a");
  EXPECT_NEAR(bounds.low.y(), -1.4, 0.02);
  EXPECT_NEAR(bounds.high.y(), 1.2, 0.01);
  EXPECT_NEAR(bounds.high.x(), 0.4, 0.02);
}

TEST(ReadGltf, SaysWhatIsWrong) {
  const auto expect = [](const std::string& text, const std::string& words) {
    const std::string failure = failure_of("a.gltf", text);
    EXPECT_NE(failure.find(words), std::string::npos) << failure;
    EXPECT_NE(failure.find("a.gltf"), std::string::npos) << failure;
  };
  expect("", "a.gltf");
  expect("{", "a.gltf");
  expect(R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[]}]})", "it says nothing of physics");
  expect(file_of(node("a", R"("motion":{},)" + collider(9)), 1), "array index 9 is out of range");
  expect(file_of(node("a", R"("motion":{},)" + collider(3)), 1), "a plane or a surface cannot");
  expect(file_of(node("a", R"("motion":{},"joint":{"connectedNode":7,"joint":0},)" + collider(1)), 1,
                 R"("physicsJoints":[{}])"),
         "node 7, which is not there");
  expect(file_of(node("a", R"("motion":{"mass":"heavy"},)" + collider(1)), 1), "type must be number");
  expect(file_of(node("a", collider(1), R"("children":[0],)"), 1), "a.gltf");
}

}  // namespace
}  // namespace plumb::harness::testing
