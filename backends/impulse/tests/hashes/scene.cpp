#include "tests/hashes/scene.hpp"

#include <cmath>

namespace plumb::impulse::test {

std::uint64_t Random::next() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

PlumbQuat Random::turn() {
  for (;;) {  // a point of the ball, drawn from the cube, put on the sphere
    const PlumbQuat q = {between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)};
    const double squared = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    if (squared > 1 || squared < 0.01) continue;
    const double length = std::sqrt(squared);
    return {q.x / length, q.y / length, q.z / length, q.w / length};
  }
}

Scene::Scene(const Backend& backend, PlumbNeeds needs, const PlumbVec3& gravity, std::uint32_t threads,
             const Choice& choice) {
  PlumbWorldDesc desc = world_desc(needs);
  desc.gravity = gravity;
  desc.threads = threads;
  const PlumbSetting setting = {choice.setting, {PLUMB_SETTING_CHOICE, 0, 0, choice.choice}};
  if (choice.setting != nullptr) {
    desc.settings = &setting;
    desc.setting_count = 1;
  }
  world_ = backend.create_world(desc);
}

PlumbShape Scene::make(const PlumbShapeDesc& desc) {
  PlumbShape id = 0;
  check(*world_, world_->create_shapes({&desc, 1}, {&id, 1}));
  return id;
}

PlumbShape Scene::sphere(double radius) {
  PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
  desc.radius = radius;
  return make(desc);
}

PlumbShape Scene::box(const PlumbVec3& half_extents) {
  PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
  desc.half_extents = half_extents;
  return make(desc);
}

PlumbShape Scene::capsule(double radius, double half_height) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CAPSULE);
  desc.radius = radius;
  desc.half_height = half_height;
  return make(desc);
}

PlumbShape Scene::hull(const std::vector<PlumbVec3>& points) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CONVEX_HULL);
  desc.vertices = &points.front().x;
  desc.vertex_count = static_cast<std::uint32_t>(points.size());
  return make(desc);
}

PlumbBody Scene::put(PlumbMotion motion, PlumbShape shape, const PlumbVec3& position, const PlumbQuat& orientation) {
  PlumbBodyDesc desc = body;
  desc.motion = motion;
  desc.shape = shape;
  desc.pose = {position, orientation};
  if (motion != PLUMB_DYNAMIC) desc.linear_velocity = desc.angular_velocity = {0, 0, 0};
  PlumbBody id = 0;
  check(*world_, world_->create_bodies({&desc, 1}, {&id, 1}));
  return id;
}

PlumbBody Scene::add(PlumbShape shape, const PlumbVec3& position, const PlumbQuat& orientation) {
  return put(PLUMB_DYNAMIC, shape, position, orientation);
}
PlumbBody Scene::add_static(PlumbShape shape, const PlumbVec3& position, const PlumbQuat& orientation) {
  return put(PLUMB_STATIC, shape, position, orientation);
}
PlumbBody Scene::add_kinematic(PlumbShape shape, const PlumbVec3& position) {
  return put(PLUMB_KINEMATIC, shape, position, {0, 0, 0, 1});
}

void Scene::ground(double x, double z) { add_static(box({50, 0.5, 50}), {x, -0.5, z}); }

void Scene::container(double half_width, double height) {
  ground();
  const PlumbShape across = box({0.5, height / 2, half_width + 1}), along = box({half_width + 1, height / 2, 0.5});
  for (const double side : {-1.0, 1.0}) {
    add_static(across, {side * (half_width + 0.5), height / 2, 0});
    add_static(along, {0, height / 2, side * (half_width + 0.5)});
  }
}

void Scene::ball_joint(PlumbBody a, const PlumbVec3& in_a, PlumbBody b, const PlumbVec3& in_b) {
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
  desc.body_a = a;
  desc.body_b = b;
  desc.frame_a.position = in_a;
  desc.frame_b.position = in_b;
  join(desc);
}

PlumbJoint Scene::join(const PlumbJointDesc& desc) {
  PlumbJoint id = 0;
  check(*world_, world_->joints()->create_joints({&desc, 1}, {&id, 1}));
  return id;
}

void Scene::modify(const PlumbBodyChange& change) {
  if (const PlumbResult result = world_->modify()->modify_bodies({&change, 1}); result != PLUMB_E_INVALID_ARGUMENT)
    check(*world_, result);
}
void Scene::modify(const PlumbJointChange& change) { check(*world_, world_->modify()->modify_joints({&change, 1})); }

void Scene::rod(const PlumbVec3& hook, PlumbBody bob, double length) {
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_DISTANCE);
  desc.body_b = bob;
  desc.frame_a.position = hook;
  desc.rest_length = length;
  PlumbJoint id = 0;
  check(*world_, world_->joints()->create_joints({&desc, 1}, {&id, 1}));
}

void Scene::target(PlumbBody kinematic, const PlumbVec3& position, const PlumbQuat& orientation) {
  const PlumbPose pose = {position, orientation};
  check(*world_, world_->write(PLUMB_FIELD_KINEMATIC_TARGET, {&kinematic, 1},
                               const_rows_over(std::span<const PlumbPose>(&pose, 1))));
}

void Scene::write(PlumbField field, PlumbBody written, const std::vector<double>& row) {
  const ConstRows rows(reinterpret_cast<const std::byte*>(row.data()), 1, row.size() * sizeof(double), PLUMB_F64);
  check(*world_, world_->write(field, {&written, 1}, rows));
}

std::vector<double> Scene::velocity(PlumbBody asked) {
  std::vector<double> row(6);
  check(*world_, world_->read(PLUMB_FIELD_VELOCITY, {&asked, 1},
                              Rows(reinterpret_cast<std::byte*>(row.data()), 1, 6 * sizeof(double), PLUMB_F64)));
  return row;
}

void Scene::remove(PlumbBody gone) { check(*world_, world_->destroy_bodies({&gone, 1})); }

void Scene::run(int steps) {
  PlumbStepReport report{};
  for (int i = 0; i < steps; ++i, ++steps_) {
    if (before_step) before_step(*this, steps_);
    check(*world_, world_->step(1.0 / 60));
    if (modify_contacts) solve_as_modified();
    check(*world_, world_->wait(report));
    if (report.nonfinite != 0) throw Error(PLUMB_E_INTERNAL, "a body came out not finite");
  }
}

void Scene::solve_as_modified() {
  IManifolds& manifolds = *world_->manifolds();
  std::span<const PlumbManifold> rows;
  while (check(*world_, manifolds.read_manifolds(rows)), !rows.empty()) {
    std::vector<PlumbManifoldChange> changes;
    modify_contacts(rows, changes);
    check(*world_, manifolds.modify_manifolds(changes));
  }
}

std::uint64_t Scene::hash() {
  std::uint64_t value = 0;
  check(*world_, world_->hash(value));
  return value;
}

std::vector<PlumbPose> Scene::poses() {
  std::vector<PlumbPose> rows(world_->bodies().size());
  check(*world_, world_->read(PLUMB_FIELD_POSE, {}, rows_over(std::span<PlumbPose>(rows))));
  return rows;
}

}  // namespace plumb::impulse::test
