// Files of other programs, each by its reader.
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

/// SDFormat, URDF or MJCF, told by the file's outermost element; glTF, told by .gltf or .glb. Throws UsageError for any
/// other, and whatever the reader of its kind finds wrong.
[[nodiscard]] Imported read_machine(const ModelFolders& folders);

}  // namespace plumb::harness
