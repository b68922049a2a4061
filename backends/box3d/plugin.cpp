// The backend's name and its one exported symbol.
#include "plumb/backend.hpp"
#include "world.hpp"

namespace plumb::box3d {

const PlumbBackendInfo& World::info() {
  static const PlumbBackendInfo info = {
      .struct_size = sizeof(PlumbBackendInfo),
      .determinism = PLUMB_DETERMINISM_THREADS,
      .name = "box3d",
      .version = PLUMB_BOX3D_VERSION,
      .build = "box3d " PLUMB_BOX3D_VERSION ", adapter 1, " __VERSION__ " " PLUMB_BOX3D_FLAGS,
      .description = "Box3D by Erin Catto, for games",
      .device = "cpu",
      .exclusion_group = "",
      .precision = PLUMB_F32,
      .max_threads = B3_MAX_WORKERS,
  };
  return info;
}

}  // namespace plumb::box3d

PLUMB_BACKEND(plumb::box3d::World)
