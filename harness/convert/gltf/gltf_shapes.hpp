// Colliders of glTF nodes as shapes.
#pragma once

#include "convert/builder.hpp"
#include "convert/gltf/gltf_file.hpp"

namespace plumb::harness {

/// The collider of a node as the body's frame sees it.
[[nodiscard]] LinkShape collider_shape(const GltfFile& file, int node, const referee::Pose& body, bool moves,
                                       Remarks& remarks);

}  // namespace plumb::harness
