// A scene as a world behind the interface.
#pragma once

#include <memory>

#include "plumb/loader.hpp"
#include "scenes.hpp"

namespace scenes {

inline const plumb::Backend& backend() {
  static const plumb::Backend opened = plumb::open_backend(PLUMB_BACKEND_FILE);
  return opened;
}

inline constexpr PlumbNeeds kNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_JOINTS | PLUMB_NEED_GYROSCOPIC;

inline std::unique_ptr<plumb::IPhysicsWorld> make_world(PlumbNeeds needs, std::vector<PlumbSetting> settings = {}) {
  PlumbWorldDesc desc = plumb::world_desc(needs);
  desc.settings = settings.data();
  desc.setting_count = static_cast<std::uint32_t>(settings.size());
  return backend().create_world(desc);
}

inline PlumbSetting number_setting(const char* name, double value, PlumbSettingType type = PLUMB_SETTING_FLOAT) {
  return {name, {type, 0, value, nullptr}};
}
inline PlumbSetting word_setting(const char* name, const char* word) {
  return {name, {PLUMB_SETTING_CHOICE, 0, 0, word}};
}

inline PlumbShape add_shape(plumb::IPhysicsWorld& world, const PlumbShapeDesc& desc) {
  PlumbShape shape = 0;
  plumb::check(world, world.create_shapes({&desc, 1}, {&shape, 1}));
  return shape;
}
inline PlumbShape add_sphere(plumb::IPhysicsWorld& world, double radius) {
  PlumbShapeDesc desc = plumb::shape_desc(PLUMB_SPHERE);
  desc.radius = radius;
  return add_shape(world, desc);
}
inline PlumbShape add_box(plumb::IPhysicsWorld& world, PlumbVec3 half) {
  PlumbShapeDesc desc = plumb::shape_desc(PLUMB_BOX);
  desc.half_extents = half;
  return add_shape(world, desc);
}
inline PlumbBody add_body(plumb::IPhysicsWorld& world, const PlumbBodyDesc& desc) {
  PlumbBody body = 0;
  plumb::check(world, world.create_bodies({&desc, 1}, {&body, 1}));
  return body;
}
inline PlumbBodyDesc frictionless(PlumbMotion motion, PlumbShape shape, PlumbVec3 at) {
  PlumbBodyDesc desc = plumb::body_desc(motion);
  desc.shape = shape;
  desc.pose.position = at;
  desc.material.friction = 0;
  return desc;
}

inline PlumbStepReport advance(plumb::IPhysicsWorld& world, double dt = 1.0 / 60) {
  PlumbStepReport report{};
  report.struct_size = sizeof report;
  plumb::check(world, world.step(dt));
  plumb::check(world, world.wait(report));
  return report;
}

template <std::size_t Columns>
std::array<double, Columns> read_row(plumb::IPhysicsWorld& world, PlumbField field, PlumbBody body) {
  std::array<double, Columns> row{};
  plumb::check(world, world.read(field, {&body, 1}, plumb::rows_over(std::span(&row, 1))));
  return row;
}
template <std::size_t Columns>
void write_row(plumb::IPhysicsWorld& world, PlumbField field, PlumbBody body, const std::array<double, Columns>& row) {
  plumb::check(world, world.write(field, {&body, 1},
                                  plumb::const_rows_over(std::span<const std::array<double, Columns>>(&row, 1))));
}

/// A world of Plumb with a scene in it.
struct PlumbScene {
  explicit PlumbScene(const Scene& scene, PlumbNeeds needs = kNeeds, std::vector<PlumbSetting> settings = {})
      : world(make_world(needs, std::move(settings))) {
    PlumbShape shape = 0;  // of the item before; items that follow each other share it
    const Item* shaped = nullptr;
    for (const Item& item : scene.items) {
      PlumbBodyDesc desc = plumb::body_desc(item.is_static ? PLUMB_STATIC : PLUMB_DYNAMIC);
      if (shape == 0 || !same_shape(*shaped, item)) {
        shape = item.is_sphere ? add_sphere(*world, item.half.x) : add_box(*world, item.half);
        shaped = &item;
      }
      desc.shape = shape;
      desc.pose = item.pose;
      desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
      desc.mass = item.mass;
      desc.linear_velocity = item.velocity;
      desc.angular_velocity = item.spin;
      desc.material.friction = kPlumbFriction;
      if (!item.is_static) {
        desc.mass_mode = PLUMB_MASS_EXPLICIT;
        desc.inertia = inertia(item);
      }
      bodies.push_back(add_body(*world, desc));
    }
    for (const Joint& joint : scene.joints) {
      PlumbJointDesc desc = plumb::joint_desc(joint.is_hinge ? PLUMB_JOINT_HINGE : PLUMB_JOINT_BALL);
      desc.body_a = joint.a < 0 ? 0 : bodies[static_cast<std::size_t>(joint.a)];
      desc.body_b = bodies[static_cast<std::size_t>(joint.b)];
      desc.frame_a.position = joint.in_a;
      desc.frame_b.position = joint.in_b;
      if (joint.is_hinge) desc.frame_a.orientation = desc.frame_b.orientation = x_to_z();
      PlumbJoint id = 0;
      plumb::check(*world, world->joints()->create_joints({&desc, 1}, {&id, 1}));
      joints.push_back(id);
    }
  }

  std::unique_ptr<plumb::IPhysicsWorld> world;
  std::vector<PlumbBody> bodies;
  std::vector<PlumbJoint> joints;
};

}  // namespace scenes
