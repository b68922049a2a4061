#include "conform/probe.hpp"

namespace plumb::harness::conform {
namespace {

/// Corners of the cube with half edge h.
std::vector<double> cube_vertices(double h) {
  std::vector<double> vertices;
  for (const double x : {-h, h})
    for (const double y : {-h, h})
      for (const double z : {-h, h}) vertices.insert(vertices.end(), {x, y, z});
  return vertices;
}

/// Triangles of that cube, counter-clockwise seen from outside.
constexpr std::array<std::uint32_t, 36> kCubeTriangles = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                                          2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};

}  // namespace

Probe::Probe(Conformance& conformance, PlumbNeeds needs, const Vec& gravity) : Probe(conformance, needs, gravity, {}) {}

Probe::Probe(Conformance& conformance, PlumbNeeds needs, const Vec& gravity, std::span<const PlumbSetting> settings,
             std::uint32_t threads)
    : needs_(needs),
      has_boxes_(conformance.backend().capability(PLUMB_CAP_SHAPE, PLUMB_BOX, PLUMB_DYNAMIC) != PLUMB_NONE) {
  conformance.require_needs(needs);
  PlumbWorldDesc desc = world_desc(needs);
  desc.gravity = vec3(gravity);
  desc.settings = settings.data();
  desc.setting_count = static_cast<std::uint32_t>(settings.size());
  desc.threads = threads;
  world_ = conformance.backend().create_world(desc);
}

PlumbShape Probe::shape(const PlumbShapeDesc& desc) {
  PlumbShape id = 0;
  check(*world_, world_->create_shapes({&desc, 1}, {&id, 1}));
  return id;
}

PlumbShape Probe::sphere(double radius) {
  PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
  desc.radius = radius;
  return shape(desc);
}

PlumbShape Probe::box(const Vec& half_extents) {
  PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
  desc.half_extents = vec3(half_extents);
  return shape(desc);
}

PlumbShape Probe::standard(PlumbShapeType type) {
  PlumbShapeDesc desc = shape_desc(type);
  desc.radius = 0.5;
  desc.half_height = 0.5;
  desc.half_extents = {0.5, 0.5, 0.5};
  const std::vector<double> vertices = cube_vertices(0.5);
  const std::vector<double> heights(11 * 11, 0.0);
  switch (type) {
    case PLUMB_CAPSULE: desc.radius = desc.half_height = 0.25; break;
    case PLUMB_CONVEX_HULL:
    case PLUMB_TRIANGLE_MESH:
      desc.vertices = vertices.data();
      desc.vertex_count = 8;
      desc.indices = kCubeTriangles.data();
      desc.triangle_count = 12;
      break;
    case PLUMB_HEIGHT_FIELD:
      desc.heights = heights.data();
      desc.rows = desc.columns = 11;
      desc.spacing = {1, 0, 1};
      break;
    case PLUMB_COMPOUND: {
      const PlumbShape half = box({0.25, 0.5, 0.5});
      PlumbCompoundChild children[2] = {{half, identity_pose(), 0, 0, {}}, {half, identity_pose(), 0, 0, {}}};
      children[0].pose.position.x = -0.25;
      children[1].pose.position.x = 0.25;
      desc.children = children;
      desc.child_count = 2;
      return shape(desc);
    }
    default: break;
  }
  return shape(desc);
}

PlumbBodyDesc dynamic_desc(PlumbShape shape, const Vec& position, const Vec& velocity) {
  PlumbBodyDesc desc = body_desc();
  desc.shape = shape;
  desc.pose.position = vec3(position);
  desc.linear_velocity = vec3(velocity);
  return desc;
}

PlumbBodyDesc Probe::free_desc(const Vec& position, const Vec& velocity) {
  PlumbBodyDesc desc = dynamic_desc(declares(PLUMB_NEED_ROTATION) ? sphere(0.5) : 0, position, velocity);
  desc.material.friction = 0;
  if (desc.shape == 0) {
    desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
    desc.mass = 1;
  }
  return desc;
}

PlumbBodyDesc Probe::declared(PlumbBodyDesc desc) const {
  if (!declares(PLUMB_NEED_FRICTION)) desc.material.friction = 0;
  if (!declares(PLUMB_NEED_ROTATION) && desc.motion == PLUMB_DYNAMIC) desc.flags |= PLUMB_BODY_NO_ROTATION;
  return desc;
}

PlumbBody Probe::body(const PlumbBodyDesc& given) {
  const PlumbBodyDesc desc = declared(given);
  PlumbBody id = 0;
  check(*world_, world_->create_bodies({&desc, 1}, {&id, 1}));
  return id;
}

PlumbBody Probe::dynamic(PlumbShape shape, const Vec& position, const Vec& velocity) {
  return body(dynamic_desc(shape, position, velocity));
}

PlumbBody Probe::fixed(PlumbShape shape, const Vec& position) {
  PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
  desc.shape = shape;
  desc.pose.position = vec3(position);
  return body(desc);
}

PlumbBody Probe::ground() {
  return has_boxes_ ? fixed(box({100, 1, 100}), {0, -1, 0}) : fixed(sphere(100), {0, -100, 0});
}

PlumbStepReport Probe::step(int steps, double dt) {
  PlumbStepReport report{};
  for (int i = 0; i < steps; ++i) {
    check(*world_, world_->step(dt));
    check(*world_, world_->wait(report));
  }
  return report;
}

std::vector<double> Probe::read(PlumbField field, PlumbBody body) {
  std::vector<double> row(columns_of(field));
  check(*world_,
        world_->read(field, {&body, 1},
                     Rows(reinterpret_cast<std::byte*>(row.data()), 1, row.size() * sizeof(double), PLUMB_F64)));
  return row;
}

void Probe::write(PlumbField field, PlumbBody body, std::span<const double> row) {
  check(*world_,
        world_->write(field, {&body, 1},
                      ConstRows(reinterpret_cast<const std::byte*>(row.data()), 1, row.size_bytes(), PLUMB_F64)));
}

void Probe::write_pose(PlumbField field, PlumbBody body, const Vec& position, const Eigen::Quaterniond& q) {
  write(field, body, {position.x(), position.y(), position.z(), q.x(), q.y(), q.z(), q.w()});
}

Vec Probe::position(PlumbBody body) {
  const std::vector<double> row = read(PLUMB_FIELD_POSE, body);
  return {row[0], row[1], row[2]};
}

Eigen::Quaterniond Probe::orientation(PlumbBody body) {
  const std::vector<double> row = read(PLUMB_FIELD_POSE, body);
  return {row[6], row[3], row[4], row[5]};
}

Vec Probe::velocity(PlumbBody body) {
  const std::vector<double> row = read(PLUMB_FIELD_VELOCITY, body);
  return {row[0], row[1], row[2]};
}

Vec Probe::angular_velocity(PlumbBody body) {
  const std::vector<double> row = read(PLUMB_FIELD_VELOCITY, body);
  return {row[3], row[4], row[5]};
}

std::uint64_t Probe::hash() {
  std::uint64_t value = 0;
  check(*world_, world_->hash(value));
  return value;
}

std::vector<PlumbEvent> Probe::events() {
  const auto rows = world_->events();
  return {rows.begin(), rows.end()};
}

std::vector<PlumbContact> Probe::contacts() {
  const auto rows = world_->contacts();
  return {rows.begin(), rows.end()};
}

PlumbJoint Probe::joint(const PlumbJointDesc& desc) {
  if (world_->joints() == nullptr) throw Error(PLUMB_E_UNSUPPORTED, "the world has no " PLUMB_EXT_JOINTS);
  PlumbJoint id = 0;
  check(*world_, world_->joints()->create_joints({&desc, 1}, {&id, 1}));
  return id;
}

std::vector<double> Probe::read_joint(PlumbJointField field, PlumbJoint joint) {
  std::vector<double> row(joint_columns_of(field));
  check(*world_, world_->joints()->read_joints(
                     field, {&joint, 1},
                     Rows(reinterpret_cast<std::byte*>(row.data()), 1, row.size() * sizeof(double), PLUMB_F64)));
  return row;
}

void Probe::write_joint(PlumbJointField field, PlumbJoint joint, std::span<const double> row) {
  check(*world_, world_->joints()->write_joints(
                     field, {&joint, 1},
                     ConstRows(reinterpret_cast<const std::byte*>(row.data()), 1, row.size_bytes(), PLUMB_F64)));
}

}  // namespace plumb::harness::conform
