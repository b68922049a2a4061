// The guard between the table and a backend's class: what it refuses, and that nothing refused gets through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "fake_world.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

constexpr PlumbNeeds kEverything = PLUMB_NEED_ALL & ~PLUMB_NEED_CCD;
const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

Backend fake_backend() { return Backend(negotiate(&backend::open<FakeWorld>, "fake")); }

class Guard : public ::testing::Test {
 protected:
  explicit Guard(PlumbNeeds needs = kEverything) : world(fake_backend().create_world(world_desc(needs))) {
    PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
    desc.half_extents = {0.5, 1, 1.5};
    EXPECT_EQ(world->create_shapes({&desc, 1}, {&box, 1}), PLUMB_OK);
  }

  PlumbBodyDesc body() const {
    PlumbBodyDesc desc = body_desc();
    desc.shape = box;
    return desc;
  }
  PlumbBody add(const PlumbBodyDesc& desc) {
    PlumbBody id = 0;
    EXPECT_EQ(world->create_bodies({&desc, 1}, {&id, 1}), PLUMB_OK) << world->error_text();
    return id;
  }
  /// The call is refused with this code, names this in its text, and never reaches the backend's class.
  template <class Call>
  void refused(PlumbResult code, const std::string& named, Call&& call) {
    const int calls = FakeWorld::last->calls;
    EXPECT_EQ(call(), code) << world->error_text();
    EXPECT_NE(world->error_text().find(named), std::string::npos)
        << "\"" << world->error_text() << "\" does not name " << named;
    EXPECT_EQ(FakeWorld::last->calls, calls);
  }
  void body_refused(PlumbResult code, const std::string& named, const std::function<void(PlumbBodyDesc&)>& spoil) {
    PlumbBodyDesc good = body(), bad = body();
    spoil(bad);
    const PlumbBodyDesc both[2] = {good, bad};
    PlumbBody ids[2] = {7, 7};
    const std::size_t alive = world->bodies().size();
    refused(code, named, [&] { return world->create_bodies(both, ids); });
    EXPECT_EQ(ids[0], 7u) << "an output was written although the call failed";
    EXPECT_EQ(world->bodies().size(), alive);
  }
  void shape_refused(PlumbResult code, const std::string& named, const PlumbShapeDesc& desc) {
    PlumbShape id = 0;
    refused(code, named, [&] { return world->create_shapes({&desc, 1}, {&id, 1}); });
  }

  std::unique_ptr<IPhysicsWorld> world;
  PlumbShape box = 0;
};

TEST_F(Guard, RefusesBadNumbersOfBodiesByName) {
  body_refused(PLUMB_E_INVALID_ARGUMENT, "bodies[1].pose.position.y", [](auto& d) { d.pose.position.y = kNan; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "bodies[1].pose.orientation", [](auto& d) {
    d.pose.orientation = {0, 0, 0, 0};
  });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "linear_velocity.z", [](auto& d) { d.linear_velocity.z = kInfinity; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "density is 0", [](auto& d) { d.density = 0; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "mass is -1",
               [](auto& d) { d.mass_mode = PLUMB_MASS_FROM_TOTAL, d.mass = -1; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "inertia.x is 0",
               [](auto& d) { d.mass_mode = PLUMB_MASS_EXPLICIT, d.mass = 1; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "friction", [](auto& d) { d.material.friction = -0.1; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "restitution", [](auto& d) { d.material.restitution = 1.1; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "linear_damping", [](auto& d) { d.linear_damping = -1; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "rolling_friction is -1", [](auto& d) { d.rolling_friction = -1; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "spinning_friction", [](auto& d) { d.spinning_friction = kInfinity; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "motion is 9", [](auto& d) { d.motion = 9; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "flags", [](auto& d) { d.flags = 1u << 30; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "struct_size", [](auto& d) { d.struct_size = 0; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "struct_size is 324", [](auto& d) { d.struct_size = 324; });  // of no version
  body_refused(PLUMB_E_STALE_HANDLE, "shape", [](auto& d) { d.shape = 12345; });
  body_refused(PLUMB_E_INVALID_ARGUMENT, "no shape", [](auto& d) { d.shape = 0; });
}

TEST_F(Guard, RefusesBadShapesByName) {
  PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "shapes[0].radius is 0", desc);
  desc.radius = kInfinity;
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "radius", desc);
  desc = shape_desc(PLUMB_CYLINDER);
  desc.radius = desc.half_height = 1;
  shape_refused(PLUMB_E_UNSUPPORTED, "no cylinders here", desc);
  desc = shape_desc(99);
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "type is 99", desc);

  const double flat[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  desc = shape_desc(PLUMB_CONVEX_HULL);
  desc.vertices = flat;
  desc.vertex_count = 3;
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "vertex_count is 3", desc);
  desc.vertex_count = 4;
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "vertices", desc);

  const std::uint32_t indices[] = {0, 1, 4};
  desc = shape_desc(PLUMB_TRIANGLE_MESH);
  desc.vertices = flat;
  desc.vertex_count = 4;
  desc.indices = indices;
  desc.triangle_count = 1;
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "indices[2] is 4", desc);

  const std::uint32_t corners[] = {0, 1, 2, 1, 3, 2}, of[] = {1, PLUMB_BODY_MATERIAL}, astray[] = {0, 2};
  PlumbMaterial materials[2] = {{0.5, 0, {}}, {0.1, 1, {}}};
  desc.indices = corners;
  desc.triangle_count = desc.material_count = 2;
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "shapes[0].materials is null", desc);
  desc.materials = materials;
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "shapes[0].triangle_materials is null", desc);
  desc.triangle_materials = astray;
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "triangle_materials[1] is 2", desc);
  desc.triangle_materials = of;
  materials[1].restitution = 2;
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "materials[1].restitution is 2", desc);
  materials[1] = {0, 0, {0, 0, 1}};
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "materials[1].surface_velocity", desc);

  PlumbCompoundChild child{box + 1000, identity_pose(), 0, 0, {}};
  desc = shape_desc(PLUMB_COMPOUND);
  shape_refused(PLUMB_E_INVALID_ARGUMENT, "child_count", desc);
  desc.children = &child;
  desc.child_count = 1;
  shape_refused(PLUMB_E_STALE_HANDLE, "children[0].shape", desc);
}

TEST_F(Guard, RefusesBadRowsByName) {
  const PlumbBody id = add(body());
  const auto write = [&](PlumbField field, PlumbBody body, std::vector<double> values) {
    return world->write(
        field, {&body, 1},
        ConstRows(reinterpret_cast<const std::byte*>(values.data()), 1, values.size() * sizeof(double), PLUMB_F64));
  };
  refused(PLUMB_E_INVALID_ARGUMENT, "pose column 1 is nan", [&] {
    return write(PLUMB_FIELD_POSE, id, {0, kNan, 0, 0, 0, 0, 1});
  });
  refused(PLUMB_E_INVALID_ARGUMENT, "orientation", [&] { return write(PLUMB_FIELD_POSE, id, {0, 0, 0, 0, 0, 0, 2}); });
  refused(PLUMB_E_INVALID_ARGUMENT, "stride", [&] { return write(PLUMB_FIELD_POSE, id, {0, 0, 0}); });
  refused(PLUMB_E_INVALID_ARGUMENT, "not kinematic", [&] {
    return write(PLUMB_FIELD_KINEMATIC_TARGET, id, {0, 0, 0, 0, 0, 0, 1});
  });
  refused(PLUMB_E_INVALID_ARGUMENT, "restitution", [&] { return write(PLUMB_FIELD_MATERIAL, id, {0.5, 2}); });
  refused(PLUMB_E_INVALID_ARGUMENT, "field is 77", [&] { return write(77, id, {0}); });
  PlumbBodyDesc ground = body();
  ground.motion = PLUMB_STATIC;
  const PlumbBody still = add(ground);
  refused(PLUMB_E_INVALID_ARGUMENT, "not dynamic", [&] { return write(PLUMB_FIELD_FORCE, still, {1, 0, 0}); });
  refused(PLUMB_E_INVALID_ARGUMENT, "static", [&] { return write(PLUMB_FIELD_VELOCITY, still, {1, 0, 0, 0, 0, 0}); });
  EXPECT_EQ(write(PLUMB_FIELD_POSE, id, {1, 2, 3, 0, 0, 0, 1}), PLUMB_OK);
  EXPECT_EQ(FakeWorld::last->written[PLUMB_FIELD_POSE][1], 2);
}

TEST_F(Guard, HandlesGoStaleForEver) {
  const PlumbBody first = add(body());
  ASSERT_EQ(world->destroy_bodies({&first, 1}), PLUMB_OK);
  const PlumbBody second = add(body());
  EXPECT_EQ(slot_of(first), slot_of(second));
  EXPECT_NE(first, second);
  double row[7];
  refused(PLUMB_E_STALE_HANDLE, "ids[0]", [&] {
    return world->read(PLUMB_FIELD_POSE, {&first, 1},
                       Rows(reinterpret_cast<std::byte*>(row), 1, sizeof row, PLUMB_F64));
  });
  refused(PLUMB_E_STALE_HANDLE, "bodies[0]", [&] { return world->destroy_bodies({&first, 1}); });
  const PlumbBody twice[2] = {second, second};
  refused(PLUMB_E_INVALID_ARGUMENT, "twice", [&] { return world->destroy_bodies(twice); });
  EXPECT_EQ(world->bodies().size(), 1u);
}

TEST_F(Guard, WorksOutMassOnce) {
  add(body());
  const PlumbBodyDesc& made = FakeWorld::last->made.back();
  EXPECT_EQ(made.mass_mode, PLUMB_MASS_EXPLICIT);
  EXPECT_DOUBLE_EQ(made.mass, 6000);                        // 1 x 2 x 3 m of density 1000
  EXPECT_DOUBLE_EQ(made.inertia.x, 6000 / 12.0 * (4 + 9));  // m/12 (b^2 + c^2)
  EXPECT_DOUBLE_EQ(made.inertia.y, 6000 / 12.0 * (1 + 9));
  EXPECT_DOUBLE_EQ(made.inertia.z, 6000 / 12.0 * (1 + 4));
  EXPECT_EQ(made.inertia_orientation.w, 1);
  PlumbBodyDesc total = body();
  total.mass_mode = PLUMB_MASS_FROM_TOTAL;
  total.mass = 12;
  add(total);
  EXPECT_DOUBLE_EQ(FakeWorld::last->made.back().mass, 12);
  EXPECT_DOUBLE_EQ(FakeWorld::last->made.back().inertia.x, 4 + 9);
  PlumbBodyDesc particle = body();
  particle.flags = PLUMB_BODY_NO_ROTATION;
  particle.mass_mode = PLUMB_MASS_FROM_TOTAL;
  particle.mass = 3;
  const PlumbBody id = add(particle);
  EXPECT_EQ(FakeWorld::last->made.back().inertia.x, 0);
  double row[11];
  ASSERT_EQ(world->read(PLUMB_FIELD_MASS, {&id, 1}, Rows(reinterpret_cast<std::byte*>(row), 1, sizeof row, PLUMB_F64)),
            PLUMB_OK);
  EXPECT_DOUBLE_EQ(row[0], 3);
}

TEST_F(Guard, KeepsShapesAndBodiesThatAreInUse) {
  const PlumbBody a = add(body()), b = add(body());
  refused(PLUMB_E_IN_USE, "shapes[0]", [&] { return world->destroy_shapes({&box, 1}); });
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
  desc.body_a = a;
  desc.body_b = b;
  PlumbJoint joint = 0;
  ASSERT_EQ(world->joints()->create_joints({&desc, 1}, {&joint, 1}), PLUMB_OK);
  refused(PLUMB_E_IN_USE, "bodies[0]", [&] { return world->destroy_bodies({&a, 1}); });
  ASSERT_EQ(world->joints()->destroy_joints({&joint, 1}), PLUMB_OK);
  const PlumbBody both[2] = {a, b};
  EXPECT_EQ(world->destroy_bodies(both), PLUMB_OK);
  EXPECT_EQ(world->destroy_shapes({&box, 1}), PLUMB_OK);
}

TEST_F(Guard, RefusesBadDrivesByName) {
  const auto joint_of = [&](PlumbJointType type) {
    PlumbJointDesc desc = joint_desc(type);
    desc.body_b = add(body());
    PlumbJoint joint = 0;
    EXPECT_EQ(world->joints()->create_joints({&desc, 1}, {&joint, 1}), PLUMB_OK);
    return joint;
  };
  const auto write = [&](PlumbJoint joint, PlumbJointField field, std::size_t column, double number) {
    double row[12] = {};
    row[column] = number;
    return world->joints()->write_joints(field, {&joint, 1},
                                         ConstRows(reinterpret_cast<const std::byte*>(row), 1, sizeof row, PLUMB_F64));
  };
  const PlumbJoint limb = joint_of(PLUMB_JOINT_SWING_TWIST), rod = joint_of(PLUMB_JOINT_DISTANCE);
  EXPECT_EQ(write(limb, PLUMB_JOINT_MOTOR, 9, 5), PLUMB_OK);
  EXPECT_EQ(write(limb, PLUMB_JOINT_SPRING_REST, 5, -1), PLUMB_OK);
  EXPECT_EQ(write(rod, PLUMB_JOINT_SPRING_REST, 0, 2), PLUMB_OK);
  refused(PLUMB_E_INVALID_ARGUMENT, "max force", [&] { return write(limb, PLUMB_JOINT_MOTOR, 9, -5); });
  refused(PLUMB_E_INVALID_ARGUMENT, "rows[0].rest", [&] { return write(limb, PLUMB_JOINT_SPRING_REST, 4, kNan); });
  refused(PLUMB_E_INVALID_ARGUMENT, "rows[0].rest", [&] { return write(rod, PLUMB_JOINT_SPRING_REST, 0, -2); });
  refused(PLUMB_E_INVALID_ARGUMENT, "only PLUMB_JOINT_MOTOR", [&] { return write(limb, PLUMB_JOINT_REACTION, 0, 0); });
  const PlumbJoint ball = joint_of(PLUMB_JOINT_FIXED);
  refused(PLUMB_E_UNSUPPORTED, "where springs rest of a fixed",
          [&] { return write(ball, PLUMB_JOINT_SPRING_REST, 0, 0); });
}

TEST_F(Guard, RefusesBadJointsByName) {
  const PlumbBody a = add(body()), b = add(body());
  const auto joint_refused = [&](PlumbResult code, const std::string& named,
                                 const std::function<void(PlumbJointDesc&)>& spoil) {
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
    desc.body_a = a;
    desc.body_b = b;
    spoil(desc);
    PlumbJoint id = 0;
    refused(code, named, [&] { return world->joints()->create_joints({&desc, 1}, {&id, 1}); });
  };
  joint_refused(PLUMB_E_STALE_HANDLE, "body_b", [](auto& d) { d.body_b = 0; });
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "body_b is body_a", [&](auto& d) { d.body_b = a; });
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "limits[3].lower", [](auto& d) { d.limits[3] = {1, -1, 1, 0}; });
  const auto limited = [&](std::size_t axis, const PlumbLimit& limit) {
    return [=](PlumbJointDesc& d) {
      d.type = PLUMB_JOINT_GENERIC;
      d.axis_modes[axis] = PLUMB_AXIS_LIMITED;
      d.limits[axis] = limit;
    };
  };
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "limits[1].lower", limited(1, {1, -1, 0, 0}));
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "limits[4].upper", limited(4, {0, kNan, 0, 0}));
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "motors[3].max_force", [](auto& d) { d.motors[3] = {1, -1, 1, 0}; });
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "springs[0].frequency", [](auto& d) { d.springs[0] = {0, 0, 1, 1, 0}; });
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "springs[3].frequency", [](auto& d) { d.springs[3] = {0, -1, 1, 1, 1}; });
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "springs[3].mode", [](auto& d) { d.springs[3] = {0, 1, 1, 1, 2}; });
  const auto cone = [&](const PlumbLimit& y, const PlumbLimit& z) {
    return [=](PlumbJointDesc& d) {
      d.type = PLUMB_JOINT_SWING_TWIST;
      d.limits[4] = y;
      d.limits[5] = z;
    };
  };
  const PlumbLimit good = {-1, 1, 1, 0};
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "limits[4] and limits[5] are the half angles of one cone", cone(good, {}));
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "limits[5].upper", cone(good, {-4, 4, 1, 0}));
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "limits[4].upper", cone({0, 0, 1, 0}, good));
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "limits[5].lower", cone(good, {-1, 0.5, 1, 0}));
  joint_refused(PLUMB_E_INVALID_ARGUMENT, "frame_a.position.x", [](auto& d) { d.frame_a.position.x = kNan; });
  for (const PlumbJointType type : {PLUMB_JOINT_GEAR, PLUMB_JOINT_RACK_AND_PINION})
    for (const double ratio : {0.0, kNan})
      joint_refused(PLUMB_E_INVALID_ARGUMENT, "joints[0].ratio", [=](auto& d) {
        d.type = type;
        d.ratio = ratio;
      });
}

TEST_F(Guard, ABrokenJointIsForgotten) {
  const PlumbBody a = add(body()), b = add(body());
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
  desc.body_a = a;
  desc.body_b = b;
  desc.break_force = 1;
  PlumbJoint joint = 0;
  ASSERT_EQ(world->joints()->create_joints({&desc, 1}, {&joint, 1}), PLUMB_OK);
  FakeWorld::last->event_rows = {{PLUMB_EVENT_JOINT_BROKEN, 0, a, b, joint}};
  PlumbStepReport report{};
  ASSERT_EQ(world->step(0.1), PLUMB_OK);
  ASSERT_EQ(world->wait(report), PLUMB_OK);
  EXPECT_EQ(report.joints, 0u);
  refused(PLUMB_E_STALE_HANDLE, "joints[0]", [&] { return world->joints()->destroy_joints({&joint, 1}); });
  EXPECT_EQ(world->destroy_bodies({&a, 1}), PLUMB_OK);
}

TEST_F(Guard, ExceptionsBecomeResultsAndLostWorldsStayLost) {
  FakeWorld::last->on_step = [] { throw std::runtime_error("the solver burst"); };
  EXPECT_EQ(world->step(0.1), PLUMB_E_INTERNAL);
  EXPECT_EQ(world->error_text(), "the solver burst");
  FakeWorld::last->on_step = [] { throw 7; };
  EXPECT_EQ(world->step(0.1), PLUMB_E_INTERNAL);
  FakeWorld::last->on_step = [] { throw Error(PLUMB_E_WORLD_LOST, "gone"); };
  EXPECT_EQ(world->step(0.1), PLUMB_E_WORLD_LOST);
  EXPECT_EQ(world->set_gravity({0, 0, 0}), PLUMB_E_WORLD_LOST);
  EXPECT_EQ(world->error_text(), "gone");
}

TEST_F(Guard, FailuresWithoutAnExceptionChangeNothing) {
  const PlumbBody a = add(body()), b = add(body());
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
  desc.body_a = a;
  desc.body_b = b;
  PlumbJoint joint = 0, second_joint = 0;
  ASSERT_EQ(world->joints()->create_joints({&desc, 1}, {&joint, 1}), PLUMB_OK);

  FakeWorld::last->answer = PLUMB_E_UNSUPPORTED;
  const PlumbBodyDesc another = body();
  PlumbBody none = 0;
  EXPECT_EQ(world->create_bodies({&another, 1}, {&none, 1}), PLUMB_E_UNSUPPORTED);
  EXPECT_FALSE(world->error_text().empty());
  EXPECT_EQ(none, 0u);
  EXPECT_EQ(world->joints()->create_joints({&desc, 1}, {&second_joint, 1}), PLUMB_E_UNSUPPORTED);
  EXPECT_EQ(world->joints()->destroy_joints({&joint, 1}), PLUMB_E_UNSUPPORTED);
  EXPECT_EQ(world->step(0.1), PLUMB_E_UNSUPPORTED);
  PlumbStepReport report{};
  refused(PLUMB_E_WRONG_PHASE, "without a step", [&] { return world->wait(report); });
  FakeWorld::last->answer = PLUMB_OK;

  EXPECT_EQ(world->step(0.1), PLUMB_OK) << "a step that failed has not begun";
  EXPECT_EQ(world->wait(report), PLUMB_OK);
  EXPECT_EQ(report.bodies, 2u);
  EXPECT_EQ(report.joints, 1u);
  EXPECT_EQ(world->joints()->destroy_joints({&joint, 1}), PLUMB_OK);
  FakeWorld::last->answer = PLUMB_E_UNSUPPORTED;
  EXPECT_EQ(world->destroy_bodies({&a, 1}), PLUMB_E_UNSUPPORTED);
  EXPECT_EQ(world->bodies().size(), 2u);
  FakeWorld::last->answer = PLUMB_OK;
  const PlumbBody both[2] = {a, b};
  EXPECT_EQ(world->destroy_bodies(both), PLUMB_OK);
  FakeWorld::last->answer = PLUMB_E_UNSUPPORTED;
  EXPECT_EQ(world->destroy_shapes({&box, 1}), PLUMB_E_UNSUPPORTED);
  FakeWorld::last->answer = PLUMB_OK;
  EXPECT_EQ(world->destroy_shapes({&box, 1}), PLUMB_OK) << "nothing uses it: " << world->error_text();
}

TEST_F(Guard, PhasesOfAStep) {
  PlumbStepReport report{};
  refused(PLUMB_E_WRONG_PHASE, "without a step", [&] { return world->wait(report); });
  refused(PLUMB_E_INVALID_ARGUMENT, "dt is 0", [&] { return world->step(0); });
  refused(PLUMB_E_INVALID_ARGUMENT, "dt is nan", [&] { return world->step(kNan); });
  ASSERT_EQ(world->step(0.1), PLUMB_OK);
  refused(PLUMB_E_WRONG_PHASE, "twice", [&] { return world->step(0.1); });
  ASSERT_EQ(world->wait(report), PLUMB_OK);
  EXPECT_EQ(report.step, 1u);
  EXPECT_TRUE(std::isnan(report.residual));
}

TEST_F(Guard, SettingsAreCheckedByNameTypeAndRange) {
  ISettings& settings = *world->settings();
  const auto number = [](PlumbSettingType type, double value) { return PlumbSettingValue{type, 0, value, nullptr}; };
  refused(PLUMB_E_INVALID_ARGUMENT, "\"itterations\"; did you mean \"iterations\"?",
          [&] { return settings.set_setting("itterations", number(PLUMB_SETTING_INT, 5)); });
  refused(PLUMB_E_INVALID_ARGUMENT, "from 1 to 100",
          [&] { return settings.set_setting("iterations", number(PLUMB_SETTING_INT, 101)); });
  refused(PLUMB_E_INVALID_ARGUMENT, "whole",
          [&] { return settings.set_setting("iterations", number(PLUMB_SETTING_INT, 2.5)); });
  refused(PLUMB_E_INVALID_ARGUMENT, "another type",
          [&] { return settings.set_setting("iterations", number(PLUMB_SETTING_FLOAT, 5)); });
  refused(PLUMB_E_INVALID_ARGUMENT, "fast, exact", [&] {
    return settings.set_setting("solver", {PLUMB_SETTING_CHOICE, 0, 0, "quick"});
  });
  refused(PLUMB_E_INVALID_ARGUMENT, "PlumbWorldDesc.settings",
          [&] { return settings.set_setting("margin", number(PLUMB_SETTING_FLOAT, 0.1)); });
  EXPECT_EQ(settings.set_setting("iterations", number(PLUMB_SETTING_INT, 20)), PLUMB_OK);
  PlumbSettingValue value{};
  EXPECT_EQ(settings.get_setting("iterations", value), PLUMB_OK);
  EXPECT_EQ(value.number, 20);
  const PlumbSetting wrong = {"iterations", number(PLUMB_SETTING_INT, 0)};
  PlumbWorldDesc desc = world_desc(0);
  desc.settings = &wrong;
  desc.setting_count = 1;
  EXPECT_THROW((void)fake_backend().create_world(desc), Error);
}

TEST_F(Guard, SnapshotsThatAreForeignOrTornAreKnown) {
  ISnapshot& snapshot = *world->snapshot();
  std::span<const std::byte> saved;
  ASSERT_EQ(snapshot.save(saved), PLUMB_OK);
  std::vector<std::byte> bytes(saved.begin(), saved.end());
  EXPECT_EQ(snapshot.restore(bytes), PLUMB_OK);
  EXPECT_EQ(FakeWorld::last->restored, 5u);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::byte> torn = bytes;
    torn[i] ^= std::byte{1};
    EXPECT_EQ(snapshot.restore(torn), PLUMB_E_CORRUPT) << "byte " << i;
  }
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(snapshot.restore(std::span(bytes).first(size)), PLUMB_E_CORRUPT) << size << " bytes";
  add(body());
  refused(PLUMB_E_CORRUPT, "other bodies", [&] { return snapshot.restore(bytes); });
}

TEST_F(Guard, LentRowsOutliveTheWorld) {
  add(body());
  add(body());
  PlumbStateRequest request = {sizeof request, PLUMB_FIELD_POSE, 1, 0};
  PlumbDLManagedTensor* tensor = nullptr;
  refused(PLUMB_E_UNSUPPORTED, "allow_copy", [&] { return world->state()->borrow(request, tensor, nullptr); });
  request.allow_copy = 1;
  ASSERT_EQ(world->state()->borrow(request, tensor, nullptr), PLUMB_COPIED);
  world.reset();
  ASSERT_EQ(tensor->dl_tensor.ndim, 2);
  EXPECT_EQ(tensor->dl_tensor.shape[0], 2);
  EXPECT_EQ(tensor->dl_tensor.shape[1], 7);
  EXPECT_EQ(static_cast<const double*>(tensor->dl_tensor.data)[7], 1.0);  // FakeWorld answers the slot
  tensor->deleter(tensor);
}

TEST_F(Guard, QueriesAreChecked) {
  PlumbRay ray{{0, 0, 0}, {0, 0, 0}, {1, ~0u, 0, 0}};
  refused(PLUMB_E_INVALID_ARGUMENT, "rays[0].translation", [&] {
    return world->queries()->cast_rays(PLUMB_HIT_ALL, {&ray, 1}).result;
  });
  ray.translation.x = 1;
  refused(PLUMB_E_INVALID_ARGUMENT, "mode is 5", [&] { return world->queries()->cast_rays(5, {&ray, 1}).result; });
  EXPECT_EQ(world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits.size(), 1u);
  PlumbCast cast{99, identity_pose(), {1, 0, 0}, {1, ~0u, 0, 0}};
  refused(PLUMB_E_STALE_HANDLE, "casts[0].shape", [&] {
    return world->queries()->cast_shapes(PLUMB_HIT_ALL, {&cast, 1}).result;
  });
}

/// What a host sees that calls the table itself, with arrays and structs of its own size.
class GuardedTable : public ::testing::Test {
 protected:
  GuardedTable() {
    const PlumbWorldDesc desc = world_desc(PLUMB_NEED_ROTATION | PLUMB_NEED_EVENTS);
    EXPECT_EQ(table.create_world(&desc, &world), PLUMB_OK);
  }
  ~GuardedTable() override { table.destroy_world(world); }

  const PlumbBackendTable& table = *negotiate(&backend::open<FakeWorld>, "fake");
  PlumbWorld* world = nullptr;
};

TEST_F(GuardedTable, TellsWhatDoesNotFit) {
  FakeWorld::last->event_rows = {{PLUMB_EVENT_WAKE, 0, 1, 0, 0}, {PLUMB_EVENT_SLEEP, 0, 2, 0, 0}};
  PlumbEvent out[3] = {};
  std::uint32_t count = 0;
  EXPECT_EQ(table.events(world, out, sizeof out[0], 1, &count), PLUMB_TRUNCATED);
  EXPECT_EQ(count, 2u);
  EXPECT_EQ(out[0].body_a, 1u);
  EXPECT_EQ(out[1].body_a, 0u) << "written beyond the capacity";
  EXPECT_EQ(table.events(world, nullptr, sizeof out[0], 0, &count), PLUMB_TRUNCATED);
  EXPECT_EQ(table.events(world, out, sizeof out[0], 2, &count), PLUMB_OK);
  EXPECT_EQ(out[1].body_a, 2u);
  EXPECT_EQ(out[2].body_a, 0u);
}

TEST_F(GuardedTable, ReportsFillTheHostsStructAndNoMore) {
  const PlumbStepDesc step = {sizeof step, 0, 0.1};
  for (const std::uint32_t size : {std::uint32_t{16}, std::uint32_t{sizeof(PlumbStepReport)}}) {
    ASSERT_EQ(table.step(world, &step), PLUMB_OK);
    unsigned char memory[sizeof(PlumbStepReport) + 16];
    std::fill(std::begin(memory), std::end(memory), 0xab);
    std::memcpy(memory, &size, sizeof size);
    ASSERT_EQ(table.wait(world, reinterpret_cast<PlumbStepReport*>(memory)), PLUMB_OK);
    EXPECT_EQ(std::memcmp(memory, &size, sizeof size), 0) << "struct_size is the host's";
    EXPECT_TRUE(std::all_of(memory + size, std::end(memory), [](unsigned char byte) { return byte == 0xab; })) << size;
  }
}

class UndeclaredNeeds : public Guard {
 protected:
  UndeclaredNeeds() : Guard(PLUMB_NEED_ROTATION) {}
};

TEST_F(UndeclaredNeeds, EachIsNamed) {
  const auto body_needs = [&](const std::string& need, const std::function<void(PlumbBodyDesc&)>& use) {
    body_refused(PLUMB_E_NOT_DECLARED, need, [&](PlumbBodyDesc& desc) {
      desc.material.friction = 0;
      use(desc);
    });
  };
  // The good first body of body_refused has friction, so only that need can be seen through it.
  body_needs("PLUMB_NEED_FRICTION", [](auto&) {});
  const auto alone = [&](const std::string& need, const std::function<void(PlumbBodyDesc&)>& use) {
    PlumbBodyDesc desc = body();
    desc.material.friction = 0;
    use(desc);
    PlumbBody id = 0;
    refused(PLUMB_E_NOT_DECLARED, need, [&] { return world->create_bodies({&desc, 1}, {&id, 1}); });
  };
  alone("PLUMB_NEED_RESTITUTION", [](auto& d) { d.material.restitution = 0.5; });
  alone("PLUMB_NEED_SURFACE_VELOCITY", [](auto& d) { d.material.surface_velocity.x = 1; });
  alone("PLUMB_NEED_KINEMATIC", [](auto& d) { d.motion = PLUMB_KINEMATIC; });
  alone("PLUMB_NEED_SENSORS", [](auto& d) { d.flags = PLUMB_BODY_SENSOR; });
  alone("PLUMB_NEED_CCD", [](auto& d) { d.flags = PLUMB_BODY_CCD; });
  alone("PLUMB_NEED_SLEEPING", [](auto& d) { d.flags = PLUMB_BODY_ASLEEP; });
  alone("PLUMB_NEED_AXIS_LOCKS", [](auto& d) { d.locks = PLUMB_LOCK_LINEAR_X; });
  alone("PLUMB_NEED_DAMPING", [](auto& d) { d.angular_damping = 1; });
  alone("PLUMB_NEED_ROLLING_FRICTION", [](auto& d) { d.rolling_friction = 0.1; });
  alone("PLUMB_NEED_ROLLING_FRICTION", [](auto& d) { d.spinning_friction = 0.1; });
  alone("PLUMB_NEED_FILTERS", [](auto& d) { d.filter.group = 3; });
  PlumbJointDesc joint = joint_desc(PLUMB_JOINT_BALL);
  PlumbJoint id = 0;
  refused(PLUMB_E_NOT_DECLARED, "PLUMB_NEED_JOINTS", [&] {
    return world->joints()->create_joints({&joint, 1}, {&id, 1});
  });
  std::span<const std::byte> data;
  refused(PLUMB_E_NOT_DECLARED, "PLUMB_NEED_SNAPSHOT", [&] { return world->snapshot()->save(data); });
}

TEST(CreateWorld, RefusesNeedsThatTheEngineLacks) {
  try {
    (void)fake_backend().create_world(world_desc(PLUMB_NEED_CCD));
    FAIL() << "a world with a need that the engine lacks was made";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), PLUMB_E_UNSUPPORTED);
    EXPECT_NE(std::string(error.what()).find("PLUMB_NEED_CCD: no continuous collision"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace plumb::test
