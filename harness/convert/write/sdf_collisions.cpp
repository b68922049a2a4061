#include "convert/write/sdf_collisions.hpp"

#include "convert/upright.hpp"
#include "convert/write/roll_pitch_yaw.hpp"
#include "convert/write/surface.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;

void write_mesh(SdfOutput& out, std::size_t index) {
  const std::string file = fmt::format("{}-{}.obj", out.name, index);
  out.meshes[file] = obj_of(surface_of(out.scene, index));
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
  const Vec3 turns = roll_pitch_yaw(pose.rotation);
  const Vec3& p = pose.position;
  xml.numbers("pose", {p.x(), p.y(), p.z(), turns.x(), turns.y(), turns.z()});
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
