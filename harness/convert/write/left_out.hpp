// What no format that scenes are written to has a word for.
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

void remark_body(const SceneBody& body, Remarks& remarks);
void remark_joint(const SceneJoint& joint, Remarks& remarks);
void remark_host(const Scene& scene, Remarks& remarks);

/// A motor that holds with all its force is a brake, which formats know as friction.
[[nodiscard]] inline bool brakes(const PlumbMotor& motor) { return motor.enabled != 0 && motor.target_velocity == 0; }
[[nodiscard]] inline bool springs_by_stiffness(const PlumbSpring& spring) {
  return spring.enabled != 0 && spring.mode == PLUMB_SPRING_STIFFNESS;
}
/// Of an axis what is neither of the two.
void remark_axis(const SceneJoint& joint, std::size_t axis, Remarks& remarks);

}  // namespace plumb::harness
