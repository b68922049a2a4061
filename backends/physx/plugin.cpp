// The backend's name and its one exported symbol.
#include "plumb/backend.hpp"
#include "world.hpp"

#define PLUMB_TEXT_OF(number) #number
#define PLUMB_TEXT(number) PLUMB_TEXT_OF(number)
#define PLUMB_PHYSX_VERSION            \
  PLUMB_TEXT(PX_PHYSICS_VERSION_MAJOR) \
  "." PLUMB_TEXT(PX_PHYSICS_VERSION_MINOR) "." PLUMB_TEXT(PX_PHYSICS_VERSION_BUGFIX)

namespace plumb::px {

const PlumbBackendInfo& World::info() {
  static const PlumbBackendInfo info = {
      .struct_size = sizeof(PlumbBackendInfo),
      .determinism = PLUMB_DETERMINISM_THREADS,
      .name = "physx",
      .version = PLUMB_PHYSX_VERSION,
      .build = "physx " PLUMB_PHYSX_VERSION ", adapter 1, " __VERSION__ " " PLUMB_PHYSX_FLAGS,
      .description = "PhysX by NVIDIA, for games and robots, on the CPU",
      .device = "cpu",
      .exclusion_group = "",
      .precision = PLUMB_F32,
      .max_threads = 64,
  };
  return info;
}

std::string World::unmet_requirement() { return {}; }

}  // namespace plumb::px

PLUMB_BACKEND(plumb::px::World)
