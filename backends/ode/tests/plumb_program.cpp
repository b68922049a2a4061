#include "plumb_program.hpp"

namespace plumb::ode_test {

const Backend& ode() {
  static const Backend backend = open_backend(PLUMB_ODE_FILE);
  return backend;
}

PlumbSetting setting(const char* name, double number, PlumbSettingType type) {
  return {name, {type, 0, number, nullptr}};
}
PlumbSetting setting(const char* name, const char* choice) { return {name, {PLUMB_SETTING_CHOICE, 0, 0, choice}}; }

TestWorld::TestWorld(PlumbNeeds needs, std::vector<PlumbSetting> settings) {
  PlumbWorldDesc desc = world_desc(needs);
  desc.settings = settings.data();
  desc.setting_count = static_cast<std::uint32_t>(settings.size());
  world_ = ode().create_world(desc);
}

PlumbShape TestWorld::shape(const PlumbShapeDesc& desc) const {
  PlumbShape id = 0;
  check(*world_, world_->create_shapes({&desc, 1}, {&id, 1}));
  return id;
}
PlumbShape TestWorld::box(double x, double y, double z) const {
  PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
  desc.half_extents = {x, y, z};
  return shape(desc);
}
PlumbShape TestWorld::sphere(double radius) const {
  PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
  desc.radius = radius;
  return shape(desc);
}
PlumbBody TestWorld::body(const PlumbBodyDesc& desc) const {
  PlumbBody id = 0;
  check(*world_, world_->create_bodies({&desc, 1}, {&id, 1}));
  return id;
}
PlumbBody TestWorld::fixed(PlumbShape shape, PlumbVec3 at) const {
  PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
  desc.shape = shape;
  desc.pose.position = at;
  return body(desc);
}
PlumbBody TestWorld::dynamic(PlumbShape shape, PlumbVec3 at) const {
  PlumbBodyDesc desc = body_desc();
  desc.shape = shape;
  desc.pose.position = at;
  return body(desc);
}
PlumbJoint TestWorld::joint(const PlumbJointDesc& desc) const {
  PlumbJoint id = 0;
  check(*world_, world_->joints()->create_joints({&desc, 1}, {&id, 1}));
  return id;
}
PlumbStepReport TestWorld::step(int count, double h) const {
  PlumbStepReport report{};
  report.struct_size = sizeof report;
  for (int i = 0; i < count; ++i) {
    check(*world_, world_->step(h));
    check(*world_, world_->wait(report));
  }
  return report;
}
std::vector<double> TestWorld::row(PlumbBody body, PlumbField field) const {
  std::vector<double> values(columns_of(field));
  const Rows rows(reinterpret_cast<std::byte*>(values.data()), 1, values.size() * sizeof(double), PLUMB_F64);
  check(*world_, world_->read(field, {&body, 1}, rows));
  return values;
}
std::vector<double> TestWorld::row(PlumbJoint joint, PlumbJointField field, int columns) const {
  std::vector<double> values(static_cast<std::size_t>(columns));
  const Rows rows(reinterpret_cast<std::byte*>(values.data()), 1, values.size() * sizeof(double), PLUMB_F64);
  check(*world_, world_->joints()->read_joints(field, {&joint, 1}, rows));
  return values;
}
PlumbVec3 TestWorld::position(PlumbBody body) const {
  const auto r = row(body, PLUMB_FIELD_POSE);
  return {r[0], r[1], r[2]};
}
PlumbVec3 TestWorld::velocity(PlumbBody body) const {
  const auto r = row(body, PLUMB_FIELD_VELOCITY);
  return {r[0], r[1], r[2]};
}
void TestWorld::write(PlumbBody body, PlumbField field, std::vector<double> row) const {
  const ConstRows rows(reinterpret_cast<const std::byte*>(row.data()), 1, row.size() * sizeof(double), PLUMB_F64);
  check(*world_, world_->write(field, {&body, 1}, rows));
}

PlumbProgram::PlumbProgram(const Scene& scene, PlumbNeeds needs) : world_(needs) {
  std::vector<PlumbBody> of_scene;
  for (const BoxBody& box : scene.bodies) {
    PlumbBodyDesc desc = body_desc(box.mass == 0 ? PLUMB_STATIC : PLUMB_DYNAMIC);
    desc.shape = world_.box(box.half_extents.x, box.half_extents.y, box.half_extents.z);
    desc.pose = box.pose;
    desc.mass_mode = PLUMB_MASS_EXPLICIT;
    desc.mass = box.mass;
    desc.inertia = box.inertia;
    desc.material.friction = friction;
    of_scene.push_back(world_.body(desc));
    if (box.mass != 0) moving_.push_back(of_scene.back());
  }
  for (const Link& link : scene.links) {
    PlumbJointDesc desc = joint_desc(link.type);
    const auto local = [&](int i) {
      if (i < 0) return link.anchor;
      const PlumbVec3& p = scene.bodies[static_cast<std::size_t>(i)].pose.position;
      return PlumbVec3{link.anchor.x - p.x, link.anchor.y - p.y, link.anchor.z - p.z};
    };
    desc.body_a = link.a < 0 ? 0 : of_scene[static_cast<std::size_t>(link.a)];
    desc.body_b = of_scene[static_cast<std::size_t>(link.b)];
    desc.frame_a.position = local(link.a);
    desc.frame_b.position = local(link.b);
    world_.joint(desc);
  }
}

void PlumbProgram::read(StateRows& rows) const {
  const auto fetch = [&](PlumbField field, std::vector<double>& into) {
    const std::size_t columns = columns_of(field);
    into.resize(moving_.size() * columns);
    const Rows out(reinterpret_cast<std::byte*>(into.data()), moving_.size(), columns * sizeof(double), PLUMB_F64);
    check(*world_, world_->read(field, moving_, out));
  };
  fetch(PLUMB_FIELD_POSE, rows.poses);
  fetch(PLUMB_FIELD_VELOCITY, rows.velocities);
}

}  // namespace plumb::ode_test
