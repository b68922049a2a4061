// A scene as glTF 2.0 with KHR_physics_rigid_bodies and KHR_implicit_shapes (drafts of 2025).
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

/// A body is a node, its shape the node's collider or, of a compound, those of nodes below it; what stands has no
/// motion, and each part of it is a body to readers. A joint is a node below body a and names one below body b. What
/// glTF has no word for becomes remarks. binary: as a .glb file has it; else text, with meshes in it as base64.
[[nodiscard]] std::string write_gltf(const Scene& scene, bool binary, Remarks& remarks);

}  // namespace plumb::harness
