#include "convert/write/mjcf_geoms.hpp"

#include <Eigen/Eigenvalues>

#include "convert/upright.hpp"
#include "convert/write/surface.hpp"
#include "measure/instruments/mechanics.hpp"
#include "referee/hull.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;
using Attributes = std::vector<std::pair<const char*, std::string>>;

std::string mesh_name(std::size_t shape) { return fmt::format("mesh{}", shape); }

/// Type and size; capsules and cylinders lie along z, planes are above which z is.
Attributes geometry_of(const Scene& scene, std::size_t index) {
  const PlumbShapeDesc& desc = scene.shapes[index].desc;
  const PlumbVec3& half = desc.half_extents;
  switch (desc.type) {
    case PLUMB_BOX: return {{"type", "box"}, {"size", numbers_text({half.x, half.y, half.z})}};
    case PLUMB_SPHERE: return {{"type", "sphere"}, {"size", numbers_text({desc.radius})}};
    case PLUMB_CAPSULE: return {{"type", "capsule"}, {"size", numbers_text({desc.radius, desc.half_height})}};
    case PLUMB_CYLINDER: return {{"type", "cylinder"}, {"size", numbers_text({desc.radius, desc.half_height})}};
    case PLUMB_PLANE: return {{"type", "plane"}, {"size", "0 0 1"}};
    default: return {{"type", "mesh"}, {"mesh", mesh_name(index)}};
  }
}

/// Two geoms collide in MuJoCo where one's contype meets the other's conaffinity, in scenes where both do.
void add_filter(Attributes& attributes, const SceneBody& body, Remarks& remarks) {
  const PlumbFilter &filter = body.desc.filter, open = body_desc(PLUMB_DYNAMIC).filter;
  if (filter.group != 0) remarks.add("groups of filters are left out", body.name);
  if (filter.category == open.category && filter.mask == open.mask) return;
  constexpr std::uint32_t kMost = 0x7fffffff;  // MuJoCo's are signed
  if (filter.category > kMost) remarks.add("the highest bit of a category is left out", body.name);
  attributes.emplace_back("contype", fmt::format("{}", filter.category & kMost));
  attributes.emplace_back("conaffinity", fmt::format("{}", filter.mask & kMost));
}

void write_geom(MjcfOutput& out, const SceneBody& body, std::size_t shape, const Pose& pose,
                const PlumbMaterial& material) {
  Attributes attributes = geometry_of(out.scene, shape);
  const PlumbShapeType type = out.scene.shapes[shape].desc.type;
  for (auto& attribute : mjcf_pose(lies_along_y(type) ? pose * along_z().inverse() : pose))
    attributes.push_back(std::move(attribute));
  attributes.emplace_back("friction", numbers_text({material.friction}));
  add_filter(attributes, body, out.remarks);
  if (material.restitution != 0) out.remarks.add("restitution is left out", body.name);
  if (type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD)
    out.remarks.add("a mesh is its convex hull to MuJoCo", body.name);
  const Xml::Element geom(out.xml, "geom", attributes);
}

/// Whether all corners lie in a plane, of which MuJoCo makes no hull.
bool is_flat(const std::vector<double>& corners) {
  const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> all(corners.data(), 3,
                                                                       static_cast<Eigen::Index>(corners.size() / 3));
  const auto apart = (all.colwise() - all.rowwise().mean()).eval();
  const Eigen::SelfAdjointEigenSolver<referee::Mat3> spread(apart * apart.transpose());
  return spread.eigenvalues()[0] < 1e-12 * spread.eigenvalues()[2];
}

void write_mesh(MjcfOutput& out, std::size_t index) {
  std::vector<double> corners, faces;
  const auto add_corner = [&](const Vec3& v) { corners.insert(corners.end(), {v.x(), v.y(), v.z()}); };
  const SceneShape& shape = out.scene.shapes[index];
  if (shape.desc.type == PLUMB_CONVEX_HULL) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < shape.vertices.size(); i += 3)
      points.emplace_back(shape.vertices[i], shape.vertices[i + 1], shape.vertices[i + 2]);
    for (const Vec3& corner : referee::convex_hull(points).corners) add_corner(corner);
  } else {
    const referee::ShapePtr cut = shape_of(out.scene, index);
    for (const auto& triangle : cut->triangles())
      for (const Vec3& v : triangle) {
        faces.push_back(static_cast<double>(corners.size() / 3));
        add_corner(v);
      }
  }
  if (is_flat(corners))
    throw UsageError(
        fmt::format("shape \"{}\" is a flat mesh, and MuJoCo takes meshes for their convex hulls; make it a "
                    "plane or a box",
                    shape.name));
  Attributes attributes = {{"name", mesh_name(index)}, {"vertex", numbers_text(std::move(corners))}};
  if (!faces.empty()) attributes.emplace_back("face", numbers_text(std::move(faces)));
  const Xml::Element mesh(out.xml, "mesh", attributes);
}

}  // namespace

std::vector<std::pair<const char*, std::string>> mjcf_pose(const Pose& pose) {
  const referee::Quat q(pose.rotation);
  const Vec3& p = pose.position;
  return {{"pos", numbers_text({p.x(), p.y(), p.z()})}, {"quat", numbers_text({q.w(), q.x(), q.y(), q.z()})}};
}

void write_meshes(MjcfOutput& out) {
  for (std::size_t shape = 0; shape < out.scene.shapes.size(); ++shape)
    if (has_surface(out.scene.shapes[shape].desc.type)) write_mesh(out, shape);
}

void write_geoms(MjcfOutput& out, const SceneBody& body) {
  if (!body.shape) return;
  const SceneShape& shape = out.scene.shapes[*body.shape];
  if (shape.desc.type != PLUMB_COMPOUND) return write_geom(out, body, *body.shape, {}, body.desc.material);
  for (const SceneShape::Child& child : shape.children)
    write_geom(out, body, child.shape, referee::pose(child.pose), child.material.value_or(body.desc.material));
}

}  // namespace plumb::harness
