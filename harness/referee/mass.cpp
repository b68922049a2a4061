#include "referee/mass.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "plumb/assert.hpp"

namespace plumb::referee {

namespace {

constexpr double pi = std::numbers::pi;

// m (|d|^2 1 - d d^T)
Mat3 of_point(double mass, const Vec3& d) { return mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose()); }

Mass upright(double mass, const Vec3& inertia) { return {mass, Vec3::Zero(), inertia.asDiagonal().toDenseMatrix()}; }

Mass combine(std::span<const Mass> parts) {
  Mass whole;
  for (const Mass& part : parts) {
    whole.mass += part.mass;
    whole.centre += part.mass * part.centre;
  }
  PLUMB_ASSERT(whole.mass > 0);
  whole.centre /= whole.mass;
  for (const Mass& part : parts) whole.inertia += part.inertia + of_point(part.mass, part.centre - whole.centre);
  return whole;
}

// Each triangle and a fixed point span a tetrahedron, positive or negative. With corners a, b, c from that point and
// six times the volume d = a . (b x c), the second moment is d/120 (a a^T + b b^T + c c^T + s s^T), s = a + b + c.
Mass of_triangles(const std::vector<Shape::Triangle>& triangles, double density) {
  PLUMB_ASSERT(!triangles.empty());
  const Vec3 apex = triangles.front()[0];
  double six_volumes = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const Shape::Triangle& triangle : triangles) {
    const Vec3 a = triangle[0] - apex, b = triangle[1] - apex, c = triangle[2] - apex, s = a + b + c;
    const double d = a.dot(b.cross(c));
    six_volumes += d;
    first += d / 24 * s;
    second += d / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  const double volume = six_volumes / 6;
  if (!(volume > 0))
    throw Error(PLUMB_E_INVALID_ARGUMENT, "mass of a mesh: volume " + std::to_string(volume) +
                                              " m3; it must be closed, counter-clockwise seen from outside");
  const Vec3 centre = first / volume;
  const Mat3 central = second - volume * centre * centre.transpose();
  return {density * volume, apex + centre, density * (central.trace() * Mat3::Identity() - central)};
}

Mass of_capsule(double r, double h, double density) {
  const double half_ball = density * 2.0 / 3 * pi * r * r * r;
  const double along = 2.0 / 5 * half_ball * r * r;
  // About its own centre of mass, 3/8 r above the flat side, a half ball's moment across is 83/320 m r^2.
  Mass cap = upright(half_ball, {83.0 / 320 * half_ball * r * r, along, 83.0 / 320 * half_ball * r * r});
  Mass parts[3] = {cap, cap, upright(0, Vec3::Zero())};
  parts[0].centre.y() = h + 3 * r / 8;
  parts[1].centre.y() = -h - 3 * r / 8;
  const double bar = density * pi * r * r * 2 * h;
  parts[2] = upright(bar, {bar * (3 * r * r + 4 * h * h) / 12, bar * r * r / 2, bar * (3 * r * r + 4 * h * h) / 12});
  return combine(parts);
}

}  // namespace

Mass mass_of(const Shape& shape, double density) {
  const double r = shape.radius(), h = shape.half_height();
  switch (shape.type()) {
    case PLUMB_SPHERE: {
      const double m = density * 4.0 / 3 * pi * r * r * r;
      return upright(m, Vec3::Constant(0.4 * m * r * r));
    }
    case PLUMB_BOX: {
      const Vec3 side = 2 * shape.half_extents(), squares = side.cwiseProduct(side);
      const double m = density * side.prod();
      return upright(m, m / 12 * (squares.sum() * Vec3::Ones() - squares));
    }
    case PLUMB_CAPSULE: return of_capsule(r, h, density);
    case PLUMB_CYLINDER: {
      const double m = density * pi * r * r * 2 * h;
      return upright(m, {m * (3 * r * r + 4 * h * h) / 12, m * r * r / 2, m * (3 * r * r + 4 * h * h) / 12});
    }
    case PLUMB_CONVEX_HULL:
    case PLUMB_TRIANGLE_MESH: return of_triangles(shape.triangles(), density);
    case PLUMB_COMPOUND: {
      std::vector<Mass> parts;
      for (const Shape::Child& child : shape.children()) {
        const Mass own = mass_of(*child.shape, density);
        const Mat3& turn = child.pose.rotation;
        parts.push_back({own.mass, child.pose * own.centre, turn * own.inertia * turn.transpose()});
      }
      return combine(parts);
    }
    default:
      throw Error(PLUMB_E_INVALID_ARGUMENT, "shape type " + std::to_string(shape.type()) +
                                                " has no volume; only static bodies can have this shape");
  }
}

Mass mass_of(const PlumbBodyDesc& body, const Shape* shape) {
  if (body.motion != PLUMB_DYNAMIC) return {};
  if (body.mass_mode == PLUMB_MASS_EXPLICIT) {
    const Mat3 turn = quat(body.inertia_orientation).toRotationMatrix();
    return {body.mass, vec(body.centre_of_mass), turn * vec(body.inertia).asDiagonal() * turn.transpose()};
  }
  if (shape == nullptr) {
    if (body.mass_mode == PLUMB_MASS_FROM_TOTAL) return {body.mass, Vec3::Zero(), Mat3::Zero()};
    throw Error(PLUMB_E_INVALID_ARGUMENT, "body without a shape: has no mass from density; give its mass");
  }
  if (body.mass_mode == PLUMB_MASS_FROM_DENSITY) return mass_of(*shape, body.density);
  Mass unit = mass_of(*shape, 1);
  return {body.mass, unit.centre, unit.inertia * (body.mass / unit.mass)};
}

Mass mass_of_row(std::span<const double, 11> row) {
  const Mat3 turn = quat({row[7], row[8], row[9], row[10]}).toRotationMatrix();
  return {row[0], {row[1], row[2], row[3]}, turn * Vec3(row[4], row[5], row[6]).asDiagonal() * turn.transpose()};
}

}  // namespace plumb::referee
