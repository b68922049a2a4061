// The shape of a body as colliders or triggers of glTF nodes.
#pragma once

#include <map>
#include <optional>

#include "convert/write/gltf/gltf_draft.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

class GltfColliders {
 public:
  GltfColliders(const Scene& scene, GltfDraft& draft);

  /// Of a body whose node this is; parts of a compound are nodes below it.
  void write(std::size_t body, std::size_t node);

 private:
  void write_part(std::size_t body, std::size_t node, std::size_t shape, const PlumbMaterial& material);
  Json geometry_of(std::size_t shape, std::size_t node);

  const Scene& scene_;
  GltfDraft& draft_;
  std::map<std::size_t, std::size_t> meshes_;        ///< by shape
  std::vector<std::optional<std::size_t>> filters_;  ///< by body
};

}  // namespace plumb::harness
