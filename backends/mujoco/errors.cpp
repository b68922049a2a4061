#include "errors.hpp"

#include <mujoco/mujoco.h>

#include <mutex>

namespace plumb::mujoco {
namespace {

/// MuJoCo's frames hold nothing that would have to be freed but its own stack, which goes with its data.
void throw_error(const char* text) { throw MujocoError(text); }
void keep_quiet(const char*) {}

}  // namespace

void install_handlers() {
  static std::once_flag once;
  std::call_once(once, [] {
    mju_user_error = &throw_error;
    mju_user_warning = &keep_quiet;
  });
}

}  // namespace plumb::mujoco
