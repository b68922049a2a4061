#include "convert/write/urdf/urdf_collisions.hpp"

#include "convert/upright.hpp"
#include "convert/write/roll_pitch_yaw.hpp"
#include "convert/write/surface.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;
using Attributes = std::vector<std::pair<const char*, std::string>>;

void write_collision(UrdfOutput& out, const Pose& pose, const char* geometry, const Attributes& attributes) {
  const Xml::Element collision(out.xml, "collision");
  write_origin(out.xml, pose);
  const Xml::Element around(out.xml, "geometry"), inside(out.xml, geometry, attributes);
}

void write_ball(UrdfOutput& out, const Pose& pose, double radius) {
  write_collision(out, pose, "sphere", {{"radius", numbers_text({radius})}});
}

/// pose: of a shape along y.
void write_cylinder(UrdfOutput& out, const Pose& pose, const PlumbShapeDesc& desc) {
  write_collision(out, pose * along_z().inverse(), "cylinder",
                  {{"radius", numbers_text({desc.radius})}, {"length", numbers_text({2 * desc.half_height})}});
}

void write_capsule(UrdfOutput& out, const Pose& pose, const PlumbShapeDesc& desc) {
  if (desc.half_height > 0) {
    write_cylinder(out, pose, desc);
    write_ball(out, {pose.rotation, pose * Vec3(0, -desc.half_height, 0)}, desc.radius);
  }
  write_ball(out, {pose.rotation, pose * Vec3(0, desc.half_height, 0)}, desc.radius);
}

void write_mesh(UrdfOutput& out, const Pose& pose, std::size_t shape) {
  const std::string file = fmt::format("{}-{}.obj", out.name, shape);
  if (!out.meshes.contains(file)) out.meshes[file] = obj_of(surface_of(out.scene, shape));
  write_collision(out, pose, "mesh", {{"filename", file}});
}

void write_shape(UrdfOutput& out, const SceneBody& body, std::size_t shape, const Pose& pose) {
  const PlumbShapeDesc& desc = out.scene.shapes[shape].desc;
  const PlumbVec3& half = desc.half_extents;
  switch (desc.type) {
    case PLUMB_BOX:
      return write_collision(out, pose, "box", {{"size", numbers_text({2 * half.x, 2 * half.y, 2 * half.z})}});
    case PLUMB_SPHERE: return write_ball(out, pose, desc.radius);
    case PLUMB_CYLINDER: return write_cylinder(out, pose, desc);
    case PLUMB_CAPSULE:
      out.remarks.add("capsules are cylinders between two spheres", body.name);
      return write_capsule(out, pose, desc);
    case PLUMB_PLANE: return out.remarks.add("planes are left out", body.name);
    default: write_mesh(out, pose, shape);
  }
}

}  // namespace

void write_origin(Xml& xml, const Pose& pose) {
  const Vec3 turns = roll_pitch_yaw(pose.rotation);
  const Vec3& p = pose.position;
  const Xml::Element origin(
      xml, "origin",
      {{"xyz", numbers_text({p.x(), p.y(), p.z()})}, {"rpy", numbers_text({turns.x(), turns.y(), turns.z()})}});
}

void write_urdf_collisions(UrdfOutput& out, const SceneBody& body, const Pose& pose) {
  if (!body.shape) return;
  const SceneShape& shape = out.scene.shapes[*body.shape];
  if (shape.desc.type != PLUMB_COMPOUND) return write_shape(out, body, *body.shape, pose);
  for (const SceneShape::Child& child : shape.children)
    write_shape(out, body, child.shape, pose * referee::pose(child.pose));
}

}  // namespace plumb::harness
