#include "convert/write/left_out.hpp"

#include <fmt/format.h>

#include <cmath>

#include "plumb/backend/names.hpp"

namespace plumb::harness {

void remark_body(const SceneBody& body, Remarks& remarks, const Vocabulary& known) {
  const PlumbBodyDesc& desc = body.desc;
  const auto is = [](const PlumbVec3& v) { return v.x != 0 || v.y != 0 || v.z != 0; };
  if (!known.velocities && (is(desc.linear_velocity) || is(desc.angular_velocity)))
    remarks.add("velocities at the start are left out", body.name);
  if ((desc.flags & ~known.flags) != 0 || desc.locks != 0) remarks.add("flags and locks are left out", body.name);
  if (desc.linear_damping != 0 || desc.angular_damping != 0) remarks.add("damping is left out", body.name);
  if (desc.rolling_friction != 0 || desc.spinning_friction != 0)
    remarks.add("rolling and spinning friction are left out", body.name);
  if (is(desc.material.surface_velocity)) remarks.add("surface velocities are left out", body.name);
  if (!known.gravity_scales && desc.gravity_scale != 1 && desc.gravity_scale != 0)
    remarks.add("a gravity of its own is left out", body.name);
}

void remark_joint(const SceneJoint& joint, Remarks& remarks, const Vocabulary& known) {
  if (joint.desc.break_force != 0 || joint.desc.break_torque != 0 || std::isfinite(joint.cut))
    remarks.add("that joints break is left out", joint.name);
  if (!known.connected && joint.desc.collide_connected != 0)
    remarks.add("that joined bodies collide is left out", joint.name);
  if (joint.desc.type == PLUMB_JOINT_SWING_TWIST)
    remarks.add("a swing-twist joint is a ball joint: its cone, stops, motors and springs are left out", joint.name);
}

void leave_gears_out(Imported& imported) {
  std::erase_if(imported.scene.joints, [&](const SceneJoint& joint) {
    if (!backend::is_meshing(joint.desc.type)) return false;
    imported.remarks.add("gears and racks are left out", joint.name);
    return true;
  });
}

void remark_host(const Scene& scene, Remarks& remarks) {
  for (const SceneAction& action : scene.host) remarks.add("what the host does is left out", action.name);
}

void remark_materials(const Scene& scene, Remarks& remarks) {
  for (const SceneShape& shape : scene.shapes)
    if (!shape.materials.empty()) remarks.add("materials by triangle are left out", shape.name);
}

void remark_gravity(const Scene& scene, Remarks& remarks) {
  const PlumbVec3 &g = scene.gravity, earth = Scene{}.gravity;
  if (g.x != earth.x || g.y != earth.y || g.z != earth.z)
    remarks.add("gravity is left out, and readers take 9.81 m/s2", fmt::format("{:g} {:g} {:g}", g.x, g.y, g.z));
}

void remark_axis(const SceneJoint& joint, std::size_t axis, Remarks& remarks) {
  const PlumbMotor& motor = joint.desc.motors[axis];
  if (motor.enabled != 0 && !brakes(motor)) remarks.add("motors that drive are left out", joint.name);
  remark_spring(joint, axis, remarks);
}

void remark_spring(const SceneJoint& joint, std::size_t axis, Remarks& remarks) {
  const PlumbSpring& spring = joint.desc.springs[axis];
  if (spring.enabled != 0 && !springs_by_stiffness(spring))
    remarks.add("springs by frequency are left out", joint.name);
}

}  // namespace plumb::harness
