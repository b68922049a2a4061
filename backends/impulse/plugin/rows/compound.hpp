// What the host side knows of compounds: shapes put together, each of which becomes a proxy of its own on a body.
#pragma once

#include <vector>

#include "plugin/convert.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::impulse {

/// A child of a compound.
struct CompoundPart {
  std::uint32_t shape;  ///< row of the shapes
  PlumbPose pose;       ///< in the compound's frame
  bool has_material;    ///< else the body's
  PlumbMaterial material;
};
/// Also a surface, whose one part is itself about its middle. Empty for all other shapes.
using Compound = std::vector<CompoundPart>;

inline Compound to_compound(const PlumbShapeDesc& desc) {
  Compound parts;
  for (std::uint32_t i = 0; i < desc.child_count; ++i) {
    const PlumbCompoundChild& child = desc.children[i];
    parts.push_back({slot_of(child.shape), child.pose, child.has_material != 0, child.material});
  }
  return parts;
}

/// What the host side knows of a proxy beside the engine's row.
struct ProxyRecord {
  std::uint32_t child = 0;  ///< of a compound
  bool has_material = false;
  PlumbMaterial material{};
};

}  // namespace plumb::impulse
