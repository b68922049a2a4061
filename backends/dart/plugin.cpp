// The backend's name and its one exported symbol.
#include "plumb/backend.hpp"
#include "world.hpp"

namespace plumb::dart6 {

const PlumbBackendInfo& World::info() {
  static const PlumbBackendInfo info = {
      .struct_size = sizeof(PlumbBackendInfo),
      .determinism = PLUMB_DETERMINISM_RUN,
      .name = "dart",
      .version = PLUMB_DART_VERSION,
      .build = "dart " PLUMB_DART_VERSION ", adapter 1, " __VERSION__ " " PLUMB_DART_FLAGS,
      .description = "DART: generalised coordinates and Dantzig's method, for robots",
      .device = "cpu",
      .exclusion_group = "",
      .precision = PLUMB_F64,
      .max_threads = 1,
  };
  return info;
}

}  // namespace plumb::dart6

PLUMB_BACKEND(plumb::dart6::World)
