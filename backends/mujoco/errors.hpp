// MuJoCo's errors as exceptions. Left alone they end the process.
#pragma once

#include <stdexcept>

namespace plumb::mujoco {

/// What MuJoCo said. Its data are of no use any more; its model is.
struct MujocoError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Once for the process: errors are thrown, warnings kept quiet (the step looks at their counts).
void install_handlers();

}  // namespace plumb::mujoco
