// The backend's name and its one exported symbol.
#include "device.hpp"
#include "plumb/backend.hpp"
#include "world.hpp"

#define PLUMB_TEXT_OF(number) #number
#define PLUMB_TEXT(number) PLUMB_TEXT_OF(number)
#define PLUMB_PHYSX_VERSION            \
  PLUMB_TEXT(PX_PHYSICS_VERSION_MAJOR) \
  "." PLUMB_TEXT(PX_PHYSICS_VERSION_MINOR) "." PLUMB_TEXT(PX_PHYSICS_VERSION_BUGFIX)

#ifdef PLUMB_PHYSX_CUDA
#define PLUMB_PHYSX_NAME "physx-cuda"
#else
#define PLUMB_PHYSX_NAME "physx"
#endif

namespace plumb::px {

const PlumbBackendInfo& World::info() {
  static const PlumbBackendInfo info = {
      .struct_size = sizeof(PlumbBackendInfo),
      .determinism = kOnGpu ? PLUMB_DETERMINISM_NONE : PLUMB_DETERMINISM_THREADS,
      .name = PLUMB_PHYSX_NAME,
      .version = PLUMB_PHYSX_VERSION,
      .build = PLUMB_PHYSX_NAME " " PLUMB_PHYSX_VERSION ", adapter 1, " __VERSION__ " " PLUMB_PHYSX_FLAGS,
      .description = kOnGpu ? "PhysX by NVIDIA, for games and robots, its rigid bodies on the GPU"
                            : "PhysX by NVIDIA, for games and robots, on the CPU",
      .device = device_name(),
      .exclusion_group = "",
      .precision = PLUMB_F32,
      .max_threads = 64,
  };
  return info;
}

std::string World::unmet_requirement() { return missing_device(); }

}  // namespace plumb::px

PLUMB_BACKEND(plumb::px::World)
