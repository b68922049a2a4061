#include "convert/write/write_sdf.hpp"

#include <algorithm>
#include <numeric>

#include "convert/upright.hpp"
#include "convert/write/left_out.hpp"
#include "convert/write/sdf_collisions.hpp"
#include "convert/write/sdf_name.hpp"
#include "convert/write/start_of_joint.hpp"
#include "measure/instruments/mechanics.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;

/// Bodies that joints hold together, those of the world apart.
std::vector<std::vector<std::size_t>> groups_of(const Scene& scene) {
  std::vector<std::size_t> root(scene.bodies.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::size_t body) {
    while (root[body] != body) body = root[body] = root[root[body]];
    return body;
  };
  for (const SceneJoint& joint : scene.joints)
    if (joint.body_a) root[find(joint.body_b)] = find(*joint.body_a);
  std::vector<std::vector<std::size_t>> groups(scene.bodies.size());
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) groups[find(body)].push_back(body);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

void write_inertial(Xml& xml, const referee::Mass& mass) {
  const Xml::Element inertial(xml, "inertial");
  write_pose(xml, {referee::Mat3::Identity(), mass.centre});
  xml.numbers("mass", {mass.mass});
  const Xml::Element inertia(xml, "inertia");
  static constexpr const char* names[3][3] = {{"ixx", "ixy", "ixz"}, {"", "iyy", "iyz"}, {"", "", "izz"}};
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column) xml.numbers(names[row][column], {mass.inertia(row, column)});
}

void write_link(SdfOutput& out, std::size_t index) {
  const SceneBody& body = out.scene.bodies[index];
  Xml& xml = out.xml;
  const Xml::Element link(xml, "link", {{"name", sdf_name(body.name)}});
  write_pose(xml, upright().inverse() * referee::pose(body.desc.pose));
  if (body.desc.motion == PLUMB_KINEMATIC) xml.text("kinematic", "true");
  if (body.desc.gravity_scale == 0) xml.text("gravity", "false");
  if (body.desc.motion == PLUMB_DYNAMIC) write_inertial(xml, mass_of_body(out.scene, index));
  write_collisions(out, body);
  remark_body(body, out.remarks);
}

struct SdfKind {
  const char* word;
  std::vector<std::size_t> axes;  ///< of the scene's joint
};

SdfKind kind_of(const SceneJoint& joint) {
  switch (joint.desc.type) {
    case PLUMB_JOINT_HINGE: return {"revolute", {3}};
    case PLUMB_JOINT_SLIDER: return {"prismatic", {0}};
    case PLUMB_JOINT_UNIVERSAL: return {"universal", {3, 4}};
    case PLUMB_JOINT_BALL:
    case PLUMB_JOINT_SWING_TWIST: return {"ball", {}};
    case PLUMB_JOINT_FIXED: return {"fixed", {}};
    default:
      throw UsageError(
          fmt::format("joint \"{}\" is a distance or generic one, which SDF lacks; make it a hinge, slider, "
                      "universal, ball or fixed one",
                      joint.name));
  }
}

void write_axis(SdfOutput& out, const SceneJoint& joint, std::size_t axis, bool second) {
  Xml& xml = out.xml;
  const Xml::Element element(xml, second ? "axis2" : "axis");
  xml.text("xyz", second ? "0 1 0" : "1 0 0");
  if (const PlumbLimit& limit = joint.desc.limits[axis]; limit.enabled != 0) {
    const double start = start_of_joint(out.scene, joint, axis);
    const Xml::Element inside(xml, "limit");
    xml.numbers("lower", {limit.lower - start});
    xml.numbers("upper", {limit.upper - start});
  }
  const PlumbMotor& motor = joint.desc.motors[axis];
  const PlumbSpring& spring = joint.desc.springs[axis];
  if (brakes(motor) || springs_by_stiffness(spring)) {
    const Xml::Element dynamics(xml, "dynamics");
    if (brakes(motor)) xml.numbers("friction", {motor.max_force});
    if (springs_by_stiffness(spring)) {
      xml.numbers("damping", {spring.damping_ratio});
      xml.numbers("spring_stiffness", {spring.frequency});
      xml.numbers("spring_reference", {spring.rest - start_of_joint(out.scene, joint, axis)});
    }
  }
  remark_axis(joint, axis, out.remarks);
}

void write_joint(SdfOutput& out, const SceneJoint& joint) {
  const SdfKind kind = kind_of(joint);
  Xml& xml = out.xml;
  const Xml::Element element(xml, "joint", {{"name", sdf_name(joint.name)}, {"type", kind.word}});
  xml.text("parent", joint.body_a ? sdf_name(out.scene.bodies[*joint.body_a].name) : "world");
  xml.text("child", sdf_name(out.scene.bodies[joint.body_b].name));
  write_pose(xml, referee::pose(joint.desc.frame_b));
  for (std::size_t i = 0; i < kind.axes.size(); ++i) write_axis(out, joint, kind.axes[i], i == 1);
  remark_joint(joint, out.remarks);
}

/// In a model whose other links move, one that stands is fixed to the world.
void write_fixing(SdfOutput& out, const SceneBody& body) {
  const Xml::Element element(out.xml, "joint", {{"name", sdf_name(body.name) + "/fixed"}, {"type", "fixed"}});
  out.xml.text("parent", "world");
  out.xml.text("child", sdf_name(body.name));
}

bool touches_itself(const Scene& scene, const std::vector<std::size_t>& group) {
  const std::int32_t first = scene.bodies[group.front()].desc.filter.group;
  return !(first < 0 && std::all_of(group.begin(), group.end(),
                                    [&](std::size_t body) { return scene.bodies[body].desc.filter.group == first; }));
}

void write_model(SdfOutput& out, const std::vector<std::size_t>& group) {
  const Scene& scene = out.scene;
  const auto stands = [&](std::size_t body) { return scene.bodies[body].desc.motion == PLUMB_STATIC; };
  const Xml::Element model(out.xml, "model", {{"name", sdf_name(scene.bodies[group.front()].name)}});
  const bool all_stand = std::all_of(group.begin(), group.end(), stands);
  if (all_stand) out.xml.text("static", "true");
  if (group.size() > 1 && touches_itself(scene, group)) out.xml.text("self_collide", "true");
  for (const std::size_t body : group) write_link(out, body);
  for (const SceneJoint& joint : scene.joints)
    if (std::find(group.begin(), group.end(), joint.body_b) != group.end()) write_joint(out, joint);
  if (all_stand) return;
  for (const std::size_t body : group)
    if (stands(body)) write_fixing(out, scene.bodies[body]);
}

}  // namespace

SdfFiles write_sdf(const Scene& scene, const std::string& name, Remarks& remarks) {
  SdfOutput out{scene, name, {}, {}, remarks};
  {
    const Xml::Element sdf(out.xml, "sdf", {{"version", "1.9"}}), world(out.xml, "world", {{"name", name}});
    const Vec3 gravity = upright().inverse() * referee::vec(scene.gravity);
    out.xml.numbers("gravity", {gravity.x(), gravity.y(), gravity.z()});
    {
      const Xml::Element physics(out.xml, "physics", {{"name", "default"}, {"type", "ignored"}});
      out.xml.numbers("max_step_size", {scene.dt});
      out.xml.numbers("real_time_factor", {1});
    }
    for (const auto& group : groups_of(scene)) write_model(out, group);
  }
  remark_host(scene, remarks);
  remark_materials(scene, remarks);
  return {out.xml.str(), std::move(out.meshes)};
}

}  // namespace plumb::harness
