// The backend's name and its one exported symbol.
#include "plumb/backend.hpp"
#include "world.hpp"

#define PLUMB_TEXT_OF(number) #number
#define PLUMB_TEXT(number) PLUMB_TEXT_OF(number)
#define PLUMB_JOLT_VERSION \
  PLUMB_TEXT(JPH_VERSION_MAJOR) "." PLUMB_TEXT(JPH_VERSION_MINOR) "." PLUMB_TEXT(JPH_VERSION_PATCH)

namespace plumb::jolt {

const PlumbBackendInfo& World::info() {
  static const PlumbBackendInfo info = {
      .struct_size = sizeof(PlumbBackendInfo),
      .determinism = PLUMB_DETERMINISM_THREADS,
      .name = "jolt",
      .version = PLUMB_JOLT_VERSION,
      .build = "jolt " PLUMB_JOLT_VERSION ", adapter 1, " __VERSION__ " " PLUMB_JOLT_FLAGS,
      .description = "Jolt Physics by Jorrit Rouwe, for games",
      .device = "cpu",
      .exclusion_group = "",
      .precision = PLUMB_F32,
      .max_threads = 64,
  };
  return info;
}

/// Jolt's build says what its users are compiled for, too.
std::string World::unmet_requirement() {
#if defined(__AVX2__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx2") == 0 || __builtin_cpu_supports("fma") == 0)
    return "this Jolt was built for processors with AVX2 and FMA; build it without USE_AVX2 and USE_FMADD";
#endif
  return {};
}

}  // namespace plumb::jolt

PLUMB_BACKEND(plumb::jolt::World)
