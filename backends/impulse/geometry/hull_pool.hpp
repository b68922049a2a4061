// All convex hulls of a world, in the arrays that kernels read.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exec/memory.hpp"
#include "geometry/shape.hpp"
#include "plumb/backend/cooking.hpp"
#include "plumb/types.h"

namespace plumb::impulse {

/// A hull by itself; its faces and edges name what is its own, from 0.
struct HullRows {
  std::vector<Vec> vertices;
  std::vector<HullFace> faces;
  std::vector<std::uint32_t> loops;
  std::vector<HullEdge> edges;
  Vec centre;
  Real inner_radius;

  /// The hull of the vertices, in the shape's frame, m; those inside it are left out. Faces that lie in one plane
  /// within 1e-6 of the hull's extent are one. Throws Error PLUMB_E_INVALID_ARGUMENT when the vertices span no volume.
  explicit HullRows(std::span<const PlumbVec3> points);
  /// As cook() wrote it. Throws Error PLUMB_E_CORRUPT for bytes that are of no hull.
  explicit HullRows(backend::CookedReader& bytes);
  void cook(backend::CookedWriter& bytes) const;
};

/// Rows are names that stay; the room of a removed hull is given to a later one that fits.
class HullPool {
 public:
  /// Returns the hull's row, for Shape::hull.
  std::uint32_t add(const HullRows& hull);
  std::uint32_t add(std::span<const PlumbVec3> points) { return add(HullRows(points)); }
  void remove(std::uint32_t row);

  /// Radius of the ball about the frame's origin that holds the hull: Shape::reach.
  [[nodiscard]] Real reach(std::uint32_t row) const;

  /// What changed since the last upload goes to where kernels run. Not within a step.
  template <class Executor>
  void upload(Executor& executor) {
    if (!changed_) return;
    executor.to_device(ranges_, row_count_);
    executor.to_device(vertices_, vertex_count_);
    executor.to_device(faces_, face_count_);
    executor.to_device(loops_, loop_count_);
    executor.to_device(edges_, edge_count_);
    changed_ = false;
  }
  /// Where kernels run; to be asked for anew after an upload.
  [[nodiscard]] Hulls device() {
    return {ranges_.device(), vertices_.device(), faces_.device(), loops_.device(), edges_.device()};
  }
  [[nodiscard]] Hulls host() { return {ranges_.host(), vertices_.host(), faces_.host(), loops_.host(), edges_.host()}; }

 private:
  /// Room that a hull has: as much as the first one needed that had it.
  struct Room {
    std::uint32_t vertices, faces, loops, edges;
  };

  std::uint32_t find_room(const Room& need);

  Mirror<HullRange> ranges_;
  Mirror<Vec> vertices_;
  Mirror<HullFace> faces_;
  Mirror<std::uint32_t> loops_;
  Mirror<HullEdge> edges_;
  std::vector<Room> rooms_;           // by row
  std::vector<std::uint32_t> empty_;  // removed rows
  std::uint32_t row_count_ = 0, vertex_count_ = 0, face_count_ = 0, loop_count_ = 0, edge_count_ = 0;
  bool changed_ = false;
};

}  // namespace plumb::impulse
