// Joints of glTF nodes.
#pragma once

#include <map>

#include "convert/builder.hpp"
#include "convert/gltf/gltf_file.hpp"

namespace plumb::harness {

/// The joint of a node. bodies: those of nodes with motion, by index.
void add_gltf_joint(const GltfFile& file, int node, const std::map<int, std::size_t>& bodies, Imported& imported);

}  // namespace plumb::harness
