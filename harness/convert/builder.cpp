#include "convert/builder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "convert/principal.hpp"
#include "convert/upright.hpp"
#include "referee/hull.hpp"

namespace plumb::harness {
namespace {

using referee::Mat3;
using referee::Pose;
using referee::Vec3;

SceneShape shape_of(PlumbShapeType type) {
  SceneShape shape;
  shape.desc = shape_desc(type);
  return shape;
}

bool stands_alone(const LinkShape& part) {
  return part.shape.desc.type == PLUMB_PLANE || part.shape.desc.type == PLUMB_TRIANGLE_MESH;
}

bool is_identity(const Pose& pose) { return pose.position.isZero(1e-12) && pose.rotation.isIdentity(1e-12); }

bool same(const PlumbMaterial& a, const PlumbMaterial& b) {
  return a.friction == b.friction && a.restitution == b.restitution;
}

/// Of equal spheres, boxes, capsules and cylinders a scene has one.
std::optional<std::size_t> find_shape(const Scene& scene, const PlumbShapeDesc& desc) {
  if (desc.type > PLUMB_CYLINDER) return std::nullopt;
  const auto numbers = [](const PlumbShapeDesc& d) {
    return std::array{
        static_cast<double>(d.type), d.radius, d.half_height, d.half_extents.x, d.half_extents.y, d.half_extents.z};
  };
  const auto found = std::find_if(scene.shapes.begin(), scene.shapes.end(),
                                  [&](const SceneShape& other) { return numbers(other.desc) == numbers(desc); });
  if (found == scene.shapes.end()) return std::nullopt;
  return static_cast<std::size_t>(found - scene.shapes.begin());
}

std::size_t add_shape(Scene& scene, SceneShape shape, const std::string& name) {
  if (const auto same = find_shape(scene, shape.desc)) return *same;
  shape.name = name;
  shape.desc.vertex_count = static_cast<std::uint32_t>(shape.vertices.size() / 3);
  shape.desc.triangle_count = static_cast<std::uint32_t>(shape.indices.size() / 3);
  scene.shapes.push_back(std::move(shape));
  return scene.shapes.size() - 1;
}

/// The shape of all parts together, as the body's frame sees it; none for none.
std::optional<std::size_t> add_parts(Scene& scene, const std::vector<LinkShape>& parts, const std::string& name) {
  if (parts.empty()) return std::nullopt;
  if (parts.size() == 1 && is_identity(parts.front().pose)) return add_shape(scene, parts.front().shape, name);
  SceneShape compound = shape_of(PLUMB_COMPOUND);
  const bool one_material = std::all_of(
      parts.begin(), parts.end(), [&](const LinkShape& part) { return same(part.material, parts.front().material); });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    SceneShape::Child child{add_shape(scene, parts[i].shape, fmt::format("{}/{}", name, i)), plain(parts[i].pose), {}};
    if (!one_material) child.material = parts[i].material;
    compound.children.push_back(child);
  }
  return add_shape(scene, std::move(compound), name);
}

void set_mass(PlumbBodyDesc& desc, const LinkMass& mass) {
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = mass.mass;
  desc.centre_of_mass = referee::plain(mass.centre);
  const auto [moments, axes] = principal_of(mass.inertia);
  desc.inertia = referee::plain(moments);
  desc.inertia_orientation = plain(Pose{axes, Vec3::Zero()}).orientation;
}

/// In a scene no two bodies have the same name, nor two joints; "world" is what joints call the world.
template <class Things>
std::string unused_name(const Things& things, const std::string& name) {
  std::string unused = name == "world" ? "world_" : name;
  const auto is_it = [&](const auto& thing) { return thing.name == unused; };
  for (int i = 2; std::any_of(things.begin(), things.end(), is_it); ++i) unused = fmt::format("{}.{}", name, i);
  return unused;
}

SceneBody body_of(const Link& link, const std::string& name, const Pose& pose, const PlumbMaterial& material) {
  SceneBody body;
  body.name = name;
  body.desc = body_desc(link.moves ? PLUMB_DYNAMIC : PLUMB_STATIC);
  body.desc.pose = plain(pose);
  body.desc.material = material;
  body.desc.filter = link.filter;
  return body;
}

}  // namespace

SceneShape sphere_shape(double radius) {
  SceneShape shape = shape_of(PLUMB_SPHERE);
  shape.desc.radius = radius;
  return shape;
}

SceneShape box_shape_of(const Vec3& half_extents) {
  SceneShape shape = shape_of(PLUMB_BOX);
  shape.desc.half_extents = referee::plain(half_extents);
  return shape;
}

SceneShape capsule_shape(double radius, double half_height) {
  SceneShape shape = shape_of(PLUMB_CAPSULE);
  shape.desc.radius = radius;
  shape.desc.half_height = half_height;
  return shape;
}

SceneShape cylinder_shape(double radius, double half_height) {
  SceneShape shape = shape_of(PLUMB_CYLINDER);
  shape.desc.radius = radius;
  shape.desc.half_height = half_height;
  return shape;
}

SceneShape plane_shape() { return shape_of(PLUMB_PLANE); }

SceneShape ellipsoid_shape(const Vec3& radii) {
  SceneShape shape = shape_of(PLUMB_CONVEX_HULL);
  for (const PlumbVec3& direction : even_directions(64)) {
    const Vec3 corner = radii.cwiseProduct(referee::vec(direction));
    shape.vertices.insert(shape.vertices.end(), corner.begin(), corner.end());
  }
  return shape;
}

SceneShape surface_shape(const Model& model, bool moves, const std::string& name, Remarks& remarks) {
  constexpr std::size_t most_corners = 128, directions = 64;
  SceneShape shape = shape_of(moves ? PLUMB_CONVEX_HULL : PLUMB_TRIANGLE_MESH);
  if (!moves) {
    shape.vertices = model.vertices;
    shape.indices = model.indices;
    return shape;
  }
  remarks.add("meshes that move are their convex hulls", name);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < model.vertices.size(); i += 3)
    points.emplace_back(model.vertices[i], model.vertices[i + 1], model.vertices[i + 2]);
  try {
    const referee::Hull hull = referee::convex_hull(points);
    if (hull.corners.size() > most_corners) {
      remarks.add("hulls of more than 128 corners are those of their furthest points in 64 directions", name);
      shape.vertices = extreme_points(model, directions);
    } else {
      for (const Vec3& corner : hull.corners) shape.vertices.insert(shape.vertices.end(), corner.begin(), corner.end());
    }
  } catch (const Error& error) {
    throw UsageError(fmt::format("the mesh of \"{}\" moves and has no hull: {}", name, error.what()));
  }
  return shape;
}

std::size_t add_link(Imported& imported, const Link& link) {
  Scene& scene = imported.scene;
  std::vector<LinkShape> parts, alone;
  for (const LinkShape& part : link.shapes) (stands_alone(part) ? alone : parts).push_back(part);
  if (link.moves && !alone.empty())
    throw UsageError(
        fmt::format("link \"{}\" moves, and a plane or a surface cannot: make its model static", link.name));
  const PlumbMaterial material = link.shapes.empty() ? body_desc(PLUMB_STATIC).material : link.shapes.front().material;
  const std::string name = unused_name(scene.bodies, link.name);
  SceneBody body = body_of(link, name, link.pose, material);
  if (parts.empty() && alone.size() == 1) {
    body.desc.pose = plain(link.pose * alone.front().pose);
    parts.swap(alone);
    parts.front().pose = {};
  }
  body.shape = add_parts(scene, parts, name);
  if (link.moves && (link.mass.mass > 0 || !body.shape)) set_mass(body.desc, link.mass);
  scene.bodies.push_back(std::move(body));
  const std::size_t index = scene.bodies.size() - 1;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const std::string part = fmt::format("{}/surface{}", name, i);
    SceneBody surface = body_of(link, part, link.pose * alone[i].pose, alone[i].material);
    surface.shape = add_shape(scene, alone[i].shape, part);
    scene.bodies.push_back(std::move(surface));
  }
  return index;
}

Pose frame_of(const Vec3& origin, const Vec3& x, const Vec3& y) {
  Pose frame;
  frame.position = origin;
  const Vec3 first = x.normalized();
  Vec3 second = y - y.dot(first) * first;
  if (second.norm() < 1e-9) second = first.unitOrthogonal();
  second.normalize();
  frame.rotation << first, second, first.cross(second);
  return frame;
}

void add_joint(Imported& imported, const std::string& name, const JointPlace& place,
               const std::vector<JointAxis>& axes) {
  const auto& bodies = imported.scene.bodies;
  const auto in_body = [&](std::size_t body) {
    return plain(place.world.seen_from(referee::pose(bodies[body].desc.pose)));
  };
  SceneJoint joint;
  joint.name = unused_name(imported.scene.joints, name);
  joint.body_a = place.body_a;
  joint.body_b = place.body_b;
  joint.desc = joint_desc(place.type);
  joint.desc.frame_a = place.body_a ? in_body(*place.body_a) : plain(place.world);
  joint.desc.frame_b = in_body(place.body_b);
  imported.scene.joints.push_back(std::move(joint));
  imported.efforts.emplace_back().fill(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < axes.size(); ++i) set_axis(imported, place.first + i, axes[i]);
}

void set_axis(Imported& imported, std::size_t axis, const JointAxis& from) {
  PlumbJointDesc& desc = imported.scene.joints.back().desc;
  if (from.limits) desc.limits[axis] = {(*from.limits)[0], (*from.limits)[1], 1, 0};
  if (from.damping != 0 || from.stiffness != 0)
    desc.springs[axis] = {from.rest, from.stiffness, from.damping, 1, PLUMB_SPRING_STIFFNESS};
  if (from.friction > 0) desc.motors[axis] = {0, from.friction, 1, 0};
  imported.efforts.back()[axis] = from.effort;
}

}  // namespace plumb::harness
