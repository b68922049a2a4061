// SDFormat and URDF, read by libsdformat (http://sdformat.org/spec).
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

/// All models of the file's worlds, or its one model. Throws UsageError with libsdformat's words, or for what a scene
/// cannot be: a joint or a shape of a kind that scenes lack.
[[nodiscard]] Imported read_sdf(const ModelFolders& folders);

}  // namespace plumb::harness
