#include "simulation/scene_nature.hpp"

namespace plumb::harness {

SceneNature nature_of(const Scene& scene) {
  SceneNature nature;
  nature.driven = (scene.needs & (PLUMB_NEED_FORCES | PLUMB_NEED_KINEMATIC | PLUMB_NEED_SURFACE_VELOCITY)) != 0;
  nature.dissipates = (scene.needs & (PLUMB_NEED_COLLISION | PLUMB_NEED_DAMPING)) != 0;
  const bool weightless = scene.gravity.x == 0 && scene.gravity.y == 0 && scene.gravity.z == 0;
  nature.closed = weightless && !nature.driven && (scene.needs & PLUMB_NEED_DAMPING) == 0;
  nature.driven = nature.driven || !scene.host.empty();
  for (const SceneBody& body : scene.bodies) {
    if (body.desc.motion != PLUMB_DYNAMIC) nature.closed = false;
    if (body.desc.gravity_scale != 1) nature.driven = true;  // the account knows one gravity only
    if (body.desc.locks != 0) nature.closed = false;
  }
  for (const SceneJoint& joint : scene.joints) {
    if (!joint.body_a) nature.closed = false;
    for (std::size_t axis = 0; axis < 6; ++axis) {
      nature.driven = nature.driven || joint.desc.motors[axis].enabled != 0;
      nature.stores = nature.stores || joint.desc.springs[axis].enabled != 0;
      nature.dissipates = nature.dissipates || joint.desc.limits[axis].enabled != 0;
    }
  }
  return nature;
}

}  // namespace plumb::harness
