#include "convert/write/urdf/urdf_joints.hpp"

#include <cmath>
#include <vector>

#include "convert/write/left_out.hpp"
#include "convert/write/start_of_joint.hpp"
#include "scene/build.hpp"

namespace plumb::harness {
namespace {

/// What URDF wants said and scenes do not: the number by which SDF says that there is no limit.
constexpr double no_limit = 1e16;

bool is_limited(const PlumbJointDesc& desc, std::size_t axis) {
  return desc.type == PLUMB_JOINT_GENERIC ? desc.axis_modes[axis] == PLUMB_AXIS_LIMITED
                                          : desc.limits[axis].enabled != 0;
}

UrdfKind kind_about(const PlumbJointDesc& desc, std::size_t axis) {
  if (axis < 3) return {"prismatic", axis};
  return {is_limited(desc, axis) ? "revolute" : "continuous", axis};
}

void write_limit(UrdfOutput& out, const SceneJoint& joint, const UrdfKind& kind, double effort) {
  const std::size_t axis = *kind.axis;
  const bool limited = is_limited(joint.desc, axis);
  const double start = start_of_joint(out.scene, joint, axis);
  const PlumbLimit& limit = joint.desc.limits[axis];
  const PlumbMotor& motor = joint.desc.motors[axis];
  const bool drives = motor.enabled != 0 && !brakes(motor);
  if (!limited && axis >= 3 && !drives && std::isinf(effort)) return;
  if (std::isinf(effort)) effort = drives ? motor.max_force : no_limit;
  std::vector<std::pair<const char*, std::string>> attributes;
  if (limited || axis < 3)
    attributes = {{"lower", numbers_text({limited ? limit.lower - start : -no_limit})},
                  {"upper", numbers_text({limited ? limit.upper - start : no_limit})}};
  attributes.emplace_back("effort", numbers_text({effort}));
  attributes.emplace_back("velocity", numbers_text({drives ? std::abs(motor.target_velocity) : no_limit}));
  const Xml::Element element(out.xml, "limit", attributes);
}

void write_dynamics(Xml& xml, const SceneJoint& joint, std::size_t axis, Remarks& remarks) {
  const PlumbMotor& motor = joint.desc.motors[axis];
  const PlumbSpring& spring = joint.desc.springs[axis];
  remark_axis(joint, axis, remarks);
  const double damping = springs_by_stiffness(spring) ? spring.damping_ratio : 0;
  const double friction = brakes(motor) ? motor.max_force : 0;
  if (springs_by_stiffness(spring) && spring.frequency != 0)
    remarks.add("springs by stiffness are left out, their damping is not", joint.name);
  if (damping == 0 && friction == 0) return;
  const Xml::Element dynamics(xml, "dynamics",
                              {{"damping", numbers_text({damping})}, {"friction", numbers_text({friction})}});
}

}  // namespace

UrdfKind urdf_kind(const SceneJoint& joint) {
  const PlumbJointDesc& desc = joint.desc;
  switch (desc.type) {
    case PLUMB_JOINT_HINGE: return kind_about(desc, 3);
    case PLUMB_JOINT_SLIDER: return kind_about(desc, 0);
    case PLUMB_JOINT_FIXED: return {"fixed", {}};
    case PLUMB_JOINT_GENERIC: {
      std::vector<std::size_t> axes;
      for (std::size_t axis = 0; axis < 6; ++axis)
        if (desc.axis_modes[axis] != PLUMB_AXIS_LOCKED) axes.push_back(axis);
      if (axes.empty()) return {"fixed", {}};
      if (axes.size() == 1) return kind_about(desc, axes.front());
      throw UsageError(fmt::format(
          "joint \"{}\" is a generic one with {} free axes, and URDF's have one; make it hinges and sliders "
          "in turn, or write a file of another kind, which ends with .xml or .gltf",
          joint.name, axes.size()));
    }
    case PLUMB_JOINT_DISTANCE:
      throw UsageError(fmt::format(
          "joint \"{}\" is a distance one, which URDF lacks; write glTF, to a file that ends with .gltf", joint.name));
    default:
      throw UsageError(
          fmt::format("joint \"{}\" is a {} one, which URDF lacks; make it hinges in turn, or write a file of another "
                      "kind, which ends with .sdf, .xml or .gltf",
                      joint.name, joint_words()[desc.type]));
  }
}

void write_urdf_axis(UrdfOutput& out, const SceneJoint& joint, bool forward, double effort) {
  Xml& xml = out.xml;
  const UrdfKind kind = urdf_kind(joint);
  if (!kind.axis) return;
  // The other way round what counts is a seen from b, about the same axis backwards.
  referee::Vec3 direction = referee::Vec3::Zero();
  direction[static_cast<int>(*kind.axis % 3)] = forward ? 1 : -1;
  { const Xml::Element axis(xml, "axis", {{"xyz", numbers_text({direction.x(), direction.y(), direction.z()})}}); }
  write_limit(out, joint, kind, effort);
  write_dynamics(xml, joint, *kind.axis, out.remarks);
}

}  // namespace plumb::harness
