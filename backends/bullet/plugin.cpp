// The backend's name and its one exported symbol.
#include "plumb/backend.hpp"
#include "world.hpp"

namespace plumb::bullet {

const PlumbBackendInfo& World::info() {
  static const PlumbBackendInfo info = {
      .struct_size = sizeof(PlumbBackendInfo),
      .determinism = PLUMB_DETERMINISM_RUN,
      .name = PLUMB_BULLET_NAME,
      .version = PLUMB_BULLET_VERSION,
      .build = PLUMB_BULLET_NAME " " PLUMB_BULLET_VERSION ", adapter 1, " __VERSION__ " " PLUMB_BULLET_FLAGS,
      .description = sizeof(btScalar) == 4 ? "Bullet in single precision, as the system's library"
                                           : "Bullet in double precision, as the system's library",
      .device = "cpu",
      .exclusion_group = "bullet",  // either precision binds the other's unique symbols
      .precision = sizeof(btScalar) == 4 ? PLUMB_F32 : PLUMB_F64,
      .max_threads = 1,
  };
  return info;
}

}  // namespace plumb::bullet

PLUMB_BACKEND(plumb::bullet::World)
