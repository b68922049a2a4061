// MJCF, MuJoCo's own format, compiled by MuJoCo (https://mujoco.readthedocs.io/en/stable/XMLreference.html).
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

/// The model at its initial configuration. Throws UsageError with MuJoCo's words, or for what a scene cannot be.
[[nodiscard]] Imported read_mjcf(const ModelFolders& folders);

}  // namespace plumb::harness
