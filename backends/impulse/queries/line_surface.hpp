// Where a line meets a plane or a surface, in the shape's frame and in double.
#pragma once

#include "queries/line_shapes.hpp"
#include "queries/surface_search.hpp"

namespace plumb::impulse {

/// The half space y <= 0 is solid.
PLUMB_HD inline bool cross_plane(const Vec64& p, const Vec64& d, LinePart& part) {
  part = {-line_shapes::kFar, line_shapes::kFar, {0, 1, 0}};
  if (d.y < 0)
    part.enter = -p.y / d.y;
  else if (d.y > 0)
    part.leave = -p.y / d.y;
  return d.y != 0 || p.y <= 0;
}

/// A line made ready for many triangles: Woop, Benthin and Wald, "Watertight ray/triangle intersection", JCGT 2, 2013.
/// What two triangles have in common they both see the same, so that no line slips through between them. Numbers are
/// from the line's point nearest to the surface's middle, and so as sharp for a line that begins far away.
class TriangleLine {
 public:
  PLUMB_HD TriangleLine(const Vec64& start, const Vec64& along) : middle_(-dot(start, along)) {
    base_ = start + middle_ * along;
    const Vec64 m = abs(along);
    z_ = m.x > m.y ? (m.x > m.z ? 0 : 2) : (m.y > m.z ? 1 : 2);
    x_ = z_ == 2 ? 0 : z_ + 1;
    y_ = x_ == 2 ? 0 : x_ + 1;
    shear_ = {along[x_] / along[z_], along[y_] / along[z_], 1 / along[z_]};
  }

  /// at: the place on the line, from its start.
  PLUMB_HD bool crosses(const Triangle& triangle, double& at) const {
    Vec64 c[3];
    for (int k = 0; k < 3; ++k) {
      const Vec64 v = to_numbers<double>(triangle.at[k]) - base_;
      c[k] = {v[x_] - shear_.x * v[z_], v[y_] - shear_.y * v[z_], shear_.z * v[z_]};
    }
    const double u = c[2].x * c[1].y - c[2].y * c[1].x, v = c[0].x * c[2].y - c[0].y * c[2].x,
                 w = c[1].x * c[0].y - c[1].y * c[0].x;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    const double whole = u + v + w;
    if (whole == 0) return false;  // within the triangle's plane: what it meets there is somebody's edge
    at = (u * c[0].z + v * c[1].z + w * c[2].z) / whole + middle_;
    return true;
  }

 private:
  double middle_;
  Vec64 base_, shear_;
  int x_, y_, z_;
};

/// Where a line first meets a surface.
struct SurfaceCross {
  double at;
  std::uint32_t triangle;
};

/// Meets triangles from both sides; of those that are met at the same place it is the first that counts.
template <class Surface>
struct NearestCross {
  const Surface& on;
  TriangleLine line;
  double most;
  std::uint32_t triangle = kNoCorner;

  PLUMB_HD void operator()(std::uint32_t t) {
    double at;
    if (!line.crosses(on.triangle(t), at) || !(at >= 0) || at > most) return;
    if (at == most && triangle != kNoCorner && t > triangle) return;
    most = at;
    triangle = t;
  }
};

/// p, d: as in line_shapes.hpp. False where the line meets nothing between p and p + most d.
template <class Surface>
PLUMB_HD bool cross_surface(const Surface& on, const Vec64& p, const Vec64& d, double most, SurfaceCross& cross) {
  NearestCross<Surface> nearest{on, TriangleLine(p, d), most};
  visit_way(on, {p, d, {{0, 0, 0}, {0, 0, 0}}}, nearest);
  cross = {nearest.most, nearest.triangle};
  return nearest.triangle != kNoCorner;
}

/// Of the side that looks against d; unit.
PLUMB_HD inline Vec64 normal_against(const Triangle& triangle, const Vec64& d) {
  const Vec64 a = to_numbers<double>(triangle.at[0]), b = to_numbers<double>(triangle.at[1]),
              c = to_numbers<double>(triangle.at[2]);
  const Vec64 n = cross(b - a, c - a);
  return ((dot(n, d) > 0 ? -1.0 : 1.0) / length(n)) * n;
}

}  // namespace plumb::impulse
