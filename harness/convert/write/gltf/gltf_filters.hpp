// Which bodies may touch, as systems of KHR_physics_rigid_bodies.
#pragma once

#include <optional>
#include <vector>

#include "convert/write/gltf/gltf_draft.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// By body the filter of its colliders; none where all may touch. Bodies of one filter are one system, which names
/// those that it may not touch: so groups, too, are said.
[[nodiscard]] std::vector<std::optional<std::size_t>> add_filters(const Scene& scene, GltfDraft& draft);

}  // namespace plumb::harness
