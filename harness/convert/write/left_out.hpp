// What scenes have and the formats that they are written to have no word for.
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

/// What some formats say and most do not.
struct Vocabulary {
  bool velocities = false;      ///< at the start
  bool gravity_scales = false;  ///< of single bodies
  bool connected = false;       ///< whether joined bodies collide
  std::uint32_t flags = 0;      ///< of bodies
};

void remark_body(const SceneBody& body, Remarks& remarks, const Vocabulary& known = {});
void remark_joint(const SceneJoint& joint, Remarks& remarks, const Vocabulary& known = {});
/// Joints that couple two others, which no format here has a word for.
void leave_gears_out(Imported& imported);
void remark_host(const Scene& scene, Remarks& remarks);
void remark_materials(const Scene& scene, Remarks& remarks);  ///< by triangle
/// Of formats that are silent about it, and whose readers take the earth's.
void remark_gravity(const Scene& scene, Remarks& remarks);

/// A motor that holds with all its force is a brake, which formats know as friction.
[[nodiscard]] inline bool brakes(const PlumbMotor& motor) { return motor.enabled != 0 && motor.target_velocity == 0; }
[[nodiscard]] inline bool springs_by_stiffness(const PlumbSpring& spring) {
  return spring.enabled != 0 && spring.mode == PLUMB_SPRING_STIFFNESS;
}
/// Of an axis what is neither of the two.
void remark_axis(const SceneJoint& joint, std::size_t axis, Remarks& remarks);
void remark_spring(const SceneJoint& joint, std::size_t axis, Remarks& remarks);

}  // namespace plumb::harness
