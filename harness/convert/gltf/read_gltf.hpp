// glTF 2.0 with KHR_physics_rigid_bodies and KHR_implicit_shapes (github.com/eoineoineoin/glTF_Physics, drafts of
// 2025), read by tinygltf.
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

/// The default scene's nodes that have motion or a collider. Throws UsageError with tinygltf's words, or for what a
/// scene cannot be.
[[nodiscard]] Imported read_gltf(const ModelFolders& folders);

}  // namespace plumb::harness
