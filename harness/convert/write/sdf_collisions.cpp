#include "convert/write/sdf_collisions.hpp"

#include <cmath>

#include "convert/upright.hpp"
#include "measure/instruments/mechanics.hpp"
#include "referee/hull.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;

void add_obj_triangle(std::string& text, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
}

std::string obj_of_hull(const SceneShape& shape) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < shape.vertices.size(); i += 3)
    points.emplace_back(shape.vertices[i], shape.vertices[i + 1], shape.vertices[i + 2]);
  const referee::Hull hull = referee::convex_hull(points);
  std::string text;
  for (const Vec3& corner : hull.corners) text += fmt::format("v {} {} {}\n", corner.x(), corner.y(), corner.z());
  for (const auto& triangle : hull.triangles) add_obj_triangle(text, triangle[0], triangle[1], triangle[2]);
  return text;
}

/// A mesh, or a height field as the referee cuts it.
std::string obj_of_surface(const Scene& scene, std::size_t shape) {
  std::string text;
  std::uint32_t corner = 0;
  for (const auto& triangle : shape_of(scene, shape)->triangles()) {
    for (const Vec3& v : triangle) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
    add_obj_triangle(text, corner, corner + 1, corner + 2);
    corner += 3;
  }
  return text;
}

void write_mesh(SdfOutput& out, std::size_t index) {
  const SceneShape& shape = out.scene.shapes[index];
  const std::string file = fmt::format("{}-{}.obj", out.name, index);
  const bool hull = shape.desc.type == PLUMB_CONVEX_HULL;
  out.meshes[file] = hull ? obj_of_hull(shape) : obj_of_surface(out.scene, index);
  const Xml::Element mesh(out.xml, "mesh");
  out.xml.text("uri", file);
}

void write_geometry(SdfOutput& out, std::size_t index) {
  const PlumbShapeDesc& desc = out.scene.shapes[index].desc;
  Xml& xml = out.xml;
  const Xml::Element geometry(xml, "geometry");
  switch (desc.type) {
    case PLUMB_BOX: {
      const Xml::Element box(xml, "box");
      const PlumbVec3& half = desc.half_extents;
      xml.numbers("size", {2 * half.x, 2 * half.y, 2 * half.z});
      return;
    }
    case PLUMB_SPHERE: {
      const Xml::Element sphere(xml, "sphere");
      xml.numbers("radius", {desc.radius});
      return;
    }
    case PLUMB_CAPSULE:
    case PLUMB_CYLINDER: {
      const Xml::Element round(xml, desc.type == PLUMB_CAPSULE ? "capsule" : "cylinder");
      xml.numbers("radius", {desc.radius});
      xml.numbers("length", {2 * desc.half_height});
      return;
    }
    case PLUMB_PLANE: {
      const Xml::Element plane(xml, "plane");
      xml.text("normal", "0 0 1");
      return;
    }
    default: write_mesh(out, index);
  }
}

void write_surface(SdfOutput& out, const SceneBody& body, const PlumbMaterial& material) {
  Xml& xml = out.xml;
  const Xml::Element surface(xml, "surface");
  {
    const Xml::Element friction(xml, "friction"), ode(xml, "ode");
    xml.numbers("mu", {material.friction});
    xml.numbers("mu2", {material.friction});
  }
  if (material.restitution != 0) {
    const Xml::Element bounce(xml, "bounce");
    xml.numbers("restitution_coefficient", {material.restitution});
  }
  const PlumbFilter &filter = body.desc.filter, open = body_desc(PLUMB_DYNAMIC).filter;
  if (filter.category == open.category && filter.mask == open.mask) return;
  if (filter.category != filter.mask || filter.mask > 0xffff) {
    out.remarks.add("categories and masks are left out", body.name);
    return;
  }
  const Xml::Element contact(xml, "contact");
  xml.text("collide_bitmask", fmt::format("{}", filter.mask));
}

void write_collision(SdfOutput& out, const SceneBody& body, std::size_t shape, const Pose& pose,
                     const PlumbMaterial& material, std::size_t number) {
  const Xml::Element collision(out.xml, "collision", {{"name", fmt::format("collision{}", number)}});
  write_pose(out.xml, lies_along_y(out.scene.shapes[shape].desc.type) ? pose * along_z().inverse() : pose);
  write_geometry(out, shape);
  write_surface(out, body, material);
}

}  // namespace

void write_pose(Xml& xml, const Pose& pose) {
  // Roll, pitch, yaw: about x, then y, then z of the frame around it.
  const referee::Mat3& r = pose.rotation;
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  const bool upright = std::hypot(r(0, 0), r(1, 0)) < 1e-9;  // then only the sum of the other two is there
  const double roll = upright ? std::atan2(-r(1, 2), r(1, 1)) : std::atan2(r(2, 1), r(2, 2));
  const double yaw = upright ? 0 : std::atan2(r(1, 0), r(0, 0));
  const Vec3& p = pose.position;
  xml.numbers("pose", {p.x(), p.y(), p.z(), roll, pitch, yaw});
}

void write_collisions(SdfOutput& out, const SceneBody& body) {
  if (!body.shape) return;
  const SceneShape& shape = out.scene.shapes[*body.shape];
  if (shape.desc.type != PLUMB_COMPOUND) {
    write_collision(out, body, *body.shape, {}, body.desc.material, 0);
    return;
  }
  std::size_t number = 0;
  for (const SceneShape::Child& child : shape.children)
    write_collision(out, body, child.shape, referee::pose(child.pose), child.material.value_or(body.desc.material),
                    number++);
}

}  // namespace plumb::harness
