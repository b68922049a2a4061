// The backend's name and its one exported symbol.
#include "plumb/backend.hpp"
#include "world.hpp"

namespace plumb::mujoco {

const PlumbBackendInfo& World::info() {
  static const PlumbBackendInfo info = {
      .struct_size = sizeof(PlumbBackendInfo),
      .determinism = PLUMB_DETERMINISM_RUN,
      .name = "mujoco",
      .version = PLUMB_MUJOCO_VERSION,
      .build = "mujoco " PLUMB_MUJOCO_VERSION ", adapter 1, " __VERSION__ " " PLUMB_MUJOCO_FLAGS,
      .description = "MuJoCo: reduced coordinates and soft constraints, for robots",
      .device = "cpu",
      .exclusion_group = "",
      .precision = PLUMB_F64,
      .max_threads = 1,
  };
  return info;
}

}  // namespace plumb::mujoco

PLUMB_BACKEND(plumb::mujoco::World)
