#include "truth/surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::truth {
namespace {

using Eigen::Vector3d;

/// Whether the origin lies within the hull of these points of a plane: no half turn about it is free of them.
bool surround_origin(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> angles;
  for (const Eigen::Vector2d& p : points) angles.push_back(std::atan2(p.y(), p.x()));
  std::sort(angles.begin(), angles.end());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2 * std::numbers::pi;
    if (next - angles[i] >= std::numbers::pi) return false;
  }
  return !angles.empty();
}

/// Smaller root t of |a + t b|^2 = r^2 where the ray comes in; 0 when it is inside at t = 0 and goes on inwards.
std::optional<double> entry(const Vector3d& a, const Vector3d& b, double r) {
  const double along = a.dot(b), c = a.squaredNorm() - r * r, bb = b.squaredNorm();
  if (along >= 0) return std::nullopt;  // it goes away
  if (c <= 0) return 0;
  const double root = along * along - bb * c;
  if (root < 0) return std::nullopt;
  return c / (-along + std::sqrt(root));
}

class Sweep {
 public:
  Sweep(const Vector3d& start, const Vector3d& direction, double radius, double reach)
      : start_(start), direction_(direction), radius_(radius), first_{reach, Vector3d::Zero()} {}

  void against(const Triangle& t) {
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    face(t, normal);
    for (std::size_t i = 0; i < 3; ++i) {
      edge(t[i], t[(i + 1) % 3]);
      if (const auto at = entry(start_ - t[i], direction_, radius_)) take(*at, t[i]);
    }
  }
  [[nodiscard]] std::optional<SphereTouch> first() const {
    return first_.normal.isZero() ? std::nullopt : std::optional(first_);
  }

 private:
  void face(const Triangle& t, const Vector3d& normal) {
    const double above = (start_ - t[0]).dot(normal), speed = direction_.dot(normal);
    if (above < 0 || speed >= 0) return;  // seen from behind, or it goes away
    const double at = std::max(0.0, (above - radius_) / -speed);
    const Vector3d point = start_ + at * direction_ - std::min(above, radius_) * normal;
    for (std::size_t i = 0; i < 3; ++i)
      if ((t[(i + 1) % 3] - t[i]).cross(point - t[i]).dot(normal) < 0) return;
    take(at, point);
  }
  void edge(const Vector3d& from, const Vector3d& to) {
    const Vector3d along = (to - from).normalized();
    const auto across = [&](const Vector3d& v) -> Vector3d { return v - v.dot(along) * along; };
    const auto at = entry(across(start_ - from), across(direction_), radius_);
    if (!at) return;
    const double place = (start_ + *at * direction_ - from).dot(along);
    if (place >= 0 && place <= (to - from).norm()) take(*at, from + place * along);
  }
  void take(double at, const Vector3d& point) {
    if (at >= first_.distance) return;
    first_ = {at, (start_ + at * direction_ - point).normalized()};
  }

  Vector3d start_, direction_;
  double radius_;
  SphereTouch first_;
};

}  // namespace

std::vector<Stand> stable_stands(std::span<const Vector3d> corners, std::span<const HalfSpace> faces,
                                 const Vector3d& centre, double flat) {
  std::vector<Stand> stands;
  for (const HalfSpace& face : faces) {
    const Vector3d u = face.normal.unitOrthogonal(), v = face.normal.cross(u);
    std::vector<Eigen::Vector2d> around;
    for (const Vector3d& p : corners) {
      if (face.offset - face.normal.dot(p) > flat) continue;
      const Vector3d from = p - centre;
      around.emplace_back(from.dot(u), from.dot(v));
    }
    if (surround_origin(around)) stands.push_back({face.normal, face.offset - face.normal.dot(centre)});
  }
  return stands;
}

std::optional<SphereTouch> first_touch(std::span<const Triangle> surface, const Vector3d& start,
                                       const Vector3d& direction, double radius, double reach) {
  Sweep sweep(start, direction, radius, reach);
  Eigen::AlignedBox3d way(start);
  way.extend(start + reach * direction);
  way.min().array() -= radius;
  way.max().array() += radius;
  for (const Triangle& t : surface) {
    Eigen::AlignedBox3d box(t[0]);
    if (way.intersects(box.extend(t[1]).extend(t[2]))) sweep.against(t);
  }
  return sweep.first();
}

}  // namespace plumb::truth
