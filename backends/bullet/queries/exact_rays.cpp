#include "queries/exact_rays.hpp"

#include <algorithm>
#include <cmath>

#include "plumb/backend/small_math.hpp"

namespace plumb::bullet {

using backend::Matrix3;

namespace {

struct LocalEntry {
  double fraction;
  PlumbVec3 normal;
};

std::optional<LocalEntry> enter_sphere(double radius, const PlumbVec3& o, const PlumbVec3& d) {
  const double a = backend::dot(d, d), b = backend::dot(o, d), c = backend::dot(o, o) - radius * radius;
  const double root = b * b - a * c;
  if (c < 0 || b >= 0 || root < 0) return std::nullopt;
  const double t = (-b - std::sqrt(root)) / a;
  if (!(t <= 1)) return std::nullopt;
  return LocalEntry{t, backend::scale(1 / radius, backend::add(o, backend::scale(t, d)))};
}

/// The slab method (Kay and Kajiya 1986).
std::optional<LocalEntry> enter_box(const PlumbVec3& half, const PlumbVec3& o, const PlumbVec3& d) {
  const double origin[3] = {o.x, o.y, o.z}, along[3] = {d.x, d.y, d.z}, extent[3] = {half.x, half.y, half.z};
  double enter = -1, leave = 1;
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    if (along[i] == 0) {
      if (std::abs(origin[i]) > extent[i]) return std::nullopt;
      continue;
    }
    const double near = (-std::copysign(extent[i], along[i]) - origin[i]) / along[i];
    const double far = (std::copysign(extent[i], along[i]) - origin[i]) / along[i];
    if (near > enter) {
      enter = near;
      axis = i;
    }
    leave = std::min(leave, far);
  }
  if (axis < 0 || enter < 0 || enter > leave) return std::nullopt;
  double normal[3] = {};
  normal[axis] = along[axis] > 0 ? -1 : 1;
  return LocalEntry{enter, {normal[0], normal[1], normal[2]}};
}

}  // namespace

Matrix3 to_matrix(const btMatrix3x3& basis) {
  Matrix3 m{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) m.m[i][k] = static_cast<double>(basis[i][k]);
  return m;
}

bool has_exact_ray(const Body& body) {
  return !body.own_shape && body.shape && (body.shape->type == PLUMB_SPHERE || body.shape->type == PLUMB_BOX);
}

std::optional<RayEntry> ray_enters(const Body& body, const PlumbVec3& origin, const PlumbVec3& translation) {
  const Matrix3 basis = to_matrix(body.getWorldTransform().getBasis());
  const Matrix3 inverse = backend::transpose(basis);
  const PlumbVec3 o = backend::multiply(inverse, backend::sub(origin, to_plumb(body.getWorldTransform().getOrigin())));
  const PlumbVec3 d = backend::multiply(inverse, translation);
  const btCollisionShape* shape = body.shape->bullet.get();
  const auto found =
      body.shape->type == PLUMB_SPHERE
          ? enter_sphere(static_cast<double>(static_cast<const btSphereShape*>(shape)->getRadius()), o, d)
          : enter_box(to_plumb(static_cast<const btBoxShape*>(shape)->getHalfExtentsWithMargin()), o, d);
  if (!found) return std::nullopt;
  return RayEntry{found->fraction, backend::multiply(basis, found->normal)};
}

}  // namespace plumb::bullet
