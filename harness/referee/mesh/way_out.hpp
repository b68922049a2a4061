// How far a convex shape has to go until it cuts no triangle of a surface any more.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "referee/shape.hpp"

namespace plumb::referee {

/// Normal of a triangle's front, not of unit length.
[[nodiscard]] inline Vec3 front_of(const Shape::Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

/// A convex shape, placed in the frame of a mesh or height field, that cuts some of its triangles.
class WayOut {
 public:
  /// triangles: those that it cuts. All must outlive this.
  WayOut(const Shape& mesh, const Shape& convex, const Pose& pose, std::span<const std::size_t> triangles)
      : mesh_(mesh), convex_(convex), pose_(pose), triangles_(triangles) {}

  /// The way along a unit direction, m, after which nothing is cut; none where that is not below `most`, or leads
  /// through the back of a triangle that is cut now.
  [[nodiscard]] std::optional<double> along(const Vec3& direction, double most) const;

 private:
  [[nodiscard]] bool cuts(std::size_t triangle, const Vec3& moved) const;
  /// Those that the shape may cut on a way; the surface beside the ones that it cuts now is met there.
  [[nodiscard]] std::vector<std::size_t> near(const Vec3& way) const;

  const Shape& mesh_;
  const Shape& convex_;
  const Pose& pose_;
  std::span<const std::size_t> triangles_;
};

}  // namespace plumb::referee
