// Spheres, boxes, capsules and cylinders by closed form; hulls and closed meshes by exact integrals over their
// triangles (the divergence theorem: Mirtich 1996, "Fast and Accurate Computation of Polyhedral Mass Properties";
// written as the polynomials of Eberly 2002, "Polyhedral Mass Properties (Revisited)"); compounds as the sum of their
// children.
#include "plumb/backend/mass_properties.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "plumb/backend/convex_hull.hpp"

namespace plumb::backend {

Principal principal_axes(Matrix3 a) {
  Matrix3 v = Matrix3::diagonal(1, 1, 1);
  const double largest = std::max({std::abs(a[0][0]), std::abs(a[1][1]), std::abs(a[2][2])});
  bool turned = true;
  for (int sweep = 0; turned && sweep < 32; ++sweep) {
    turned = false;
    for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
      if (std::abs(a[p][q]) <= 1e-14 * largest) continue;
      turned = true;
      const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      Matrix3 turn = Matrix3::diagonal(1, 1, 1);
      turn[p][p] = turn[q][q] = c;
      turn[p][q] = s;
      turn[q][p] = -s;
      a = multiply(transpose(turn), multiply(a, turn));
      v = multiply(v, turn);
    }
  }
  return {{a[0][0], a[1][1], a[2][2]}, quaternion_of(v)};
}

Matrix3 inertia_tensor(const PlumbVec3& moments, const PlumbQuat& orientation) {
  const Matrix3 r = rotation_matrix(orientation);
  return multiply(r, multiply(Matrix3::diagonal(moments.x, moments.y, moments.z), transpose(r)));
}

Matrix3 parallel_axis(double mass, const PlumbVec3& d) {
  const double s = dot(d, d);
  return {{{mass * (s - d.x * d.x), -mass * d.x * d.y, -mass * d.x * d.z},
           {-mass * d.x * d.y, mass * (s - d.y * d.y), -mass * d.y * d.z},
           {-mass * d.x * d.z, -mass * d.y * d.z, mass * (s - d.z * d.z)}}};
}

namespace {

[[nodiscard]] MassProperties upright(double volume, double ix, double iy, double iz) {
  return {volume, {0, 0, 0}, {ix, iy, iz}, {0, 0, 0, 1}, volume};
}

[[nodiscard]] MassProperties of_cylinder(double r, double half_height) {
  const double m = 2 * std::numbers::pi * r * r * half_height, across = m * (r * r / 4 + half_height * half_height / 3);
  return upright(m, across, m * r * r / 2, across);
}

// The cylinder and two half spheres, whose centres of mass are 3/8 r beyond its ends.
[[nodiscard]] MassProperties of_capsule(double r, double h) {
  const double cylinder = 2 * std::numbers::pi * r * r * h, ball = 4.0 / 3 * std::numbers::pi * r * r * r;
  const double along = cylinder * r * r / 2 + ball * 2 * r * r / 5;
  const double across = cylinder * (r * r / 4 + h * h / 3) + ball * (2 * r * r / 5 + h * h + 3 * r * h / 4);
  return upright(cylinder + ball, across, along, across);
}

// A closed surface of outward triangles. Integrals of 1, x, y, z, x2, y2, z2, xy, yz, zx over the volume, taken from a
// point near the vertices so that a body far from its frame's origin loses no digits.
template <class Triangles>
[[nodiscard]] MassProperties of_surface(std::span<const PlumbVec3> vertices, const Triangles& triangles,
                                        const char* what) {
  PlumbVec3 origin{0, 0, 0};
  for (const PlumbVec3& v : vertices) origin = add(origin, scale(1.0 / static_cast<double>(vertices.size()), v));
  std::array<double, 10> integral{};
  for (const auto& t : triangles) {
    const PlumbVec3 corner[3] = {sub(vertices[t[0]], origin), sub(vertices[t[1]], origin), sub(vertices[t[2]], origin)};
    const PlumbVec3 n = cross(sub(corner[1], corner[0]), sub(corner[2], corner[0]));
    const double area[3] = {n.x, n.y, n.z};
    double c[3][3], f1[3], f2[3], f3[3], g[3][3];
    for (std::size_t i = 0; i < 3; ++i) c[0][i] = corner[i].x, c[1][i] = corner[i].y, c[2][i] = corner[i].z;
    for (std::size_t k = 0; k < 3; ++k) {
      const double w0 = c[k][0], w1 = c[k][1], w2 = c[k][2], sum = w0 + w1, mixed = w0 * w0 + w1 * sum;
      f1[k] = sum + w2;
      f2[k] = mixed + w2 * f1[k];
      f3[k] = w0 * w0 * w0 + w1 * mixed + w2 * f2[k];
      for (std::size_t i = 0; i < 3; ++i) g[k][i] = f2[k] + c[k][i] * (f1[k] + c[k][i]);
    }
    integral[0] += area[0] * f1[0] / 6;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      integral[1 + k] += area[k] * f2[k] / 24;
      integral[4 + k] += area[k] * f3[k] / 60;
      integral[7 + k] += area[k] * (c[next][0] * g[k][0] + c[next][1] * g[k][1] + c[next][2] * g[k][2]) / 120;
    }
  }
  const double volume = integral[0];
  if (!(volume > 0))
    throw Error(PLUMB_E_INVALID_ARGUMENT, std::string(what) + ": volume " + std::to_string(volume) +
                                              " m3; its triangles must be counter-clockwise seen from outside");
  const PlumbVec3 centre = {integral[1] / volume, integral[2] / volume, integral[3] / volume};
  const double xx = integral[4], yy = integral[5], zz = integral[6];
  const double xy = integral[7], yz = integral[8], zx = integral[9];
  Matrix3 tensor = {{{yy + zz, -xy, -zx}, {-xy, xx + zz, -yz}, {-zx, -yz, xx + yy}}};
  const Matrix3 shift = parallel_axis(volume, centre);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) tensor[i][j] -= shift[i][j];
  const Principal principal = principal_axes(tensor);
  return {volume, add(origin, centre), principal.moments, principal.orientation, volume};
}

// Every edge must be run through once each way; corners at the same place count as one, so soups of triangles will do.
[[nodiscard]] MassProperties of_mesh(const PlumbShapeDesc& desc) {
  std::vector<PlumbVec3> vertices;
  std::vector<std::uint32_t> place;
  std::map<std::array<double, 3>, std::uint32_t> place_of;
  for (std::uint32_t i = 0; i < desc.vertex_count; ++i) {
    const double* v = desc.vertices + 3 * std::size_t{i};
    vertices.push_back({v[0], v[1], v[2]});
    place.push_back(place_of.try_emplace({v[0] + 0.0, v[1] + 0.0, v[2] + 0.0}, i).first->second);
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (std::uint32_t t = 0; t < desc.triangle_count; ++t) {
    const std::uint32_t* corner = desc.indices + 3 * std::size_t{t};
    triangles.push_back({corner[0], corner[1], corner[2]});
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t from = place[corner[e]], to = place[corner[(e + 1) % 3]];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (const auto& [edge, count] : balance)
    if (count != 0)
      throw Error(PLUMB_E_INVALID_ARGUMENT, "triangle mesh: open at the edge between vertices " +
                                                std::to_string(edge.first) + " and " + std::to_string(edge.second) +
                                                "; only a closed mesh has mass, others are for static bodies");
  return of_surface(std::span<const PlumbVec3>(vertices), triangles, "triangle mesh");
}

[[nodiscard]] MassProperties of_children(std::span<const PlumbCompoundChild> children,
                                         std::span<const MassProperties> properties) {
  double mass = 0;
  PlumbVec3 moment{0, 0, 0};
  std::vector<PlumbVec3> centres;
  for (std::size_t i = 0; i < children.size(); ++i) {
    const PlumbPose& pose = children[i].pose;
    centres.push_back(add(pose.position, multiply(rotation_matrix(pose.orientation), properties[i].centre_of_mass)));
    mass += properties[i].mass;
    moment = add(moment, scale(properties[i].mass, centres[i]));
  }
  const PlumbVec3 centre = scale(1 / mass, moment);
  Matrix3 tensor{};
  for (std::size_t i = 0; i < children.size(); ++i) {
    const Matrix3 turn = rotation_matrix(children[i].pose.orientation);
    const Matrix3 own = inertia_tensor(properties[i].inertia, properties[i].inertia_orientation);
    const Matrix3 turned = multiply(turn, multiply(own, transpose(turn)));
    const Matrix3 moved = parallel_axis(properties[i].mass, sub(centres[i], centre));
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) tensor[r][c] += turned[r][c] + moved[r][c];
  }
  const Principal principal = principal_axes(tensor);
  return {mass, centre, principal.moments, principal.orientation, mass};
}

}  // namespace

MassProperties unit_mass_properties(const PlumbShapeDesc& desc, std::span<const MassProperties> children_properties) {
  switch (desc.type) {
    case PLUMB_SPHERE: {
      const double m = 4.0 / 3 * std::numbers::pi * desc.radius * desc.radius * desc.radius;
      const double i = 2.0 / 5 * m * desc.radius * desc.radius;
      return upright(m, i, i, i);
    }
    case PLUMB_BOX: {
      const PlumbVec3& h = desc.half_extents;
      const double m = 8 * h.x * h.y * h.z;
      return upright(m, m * (h.y * h.y + h.z * h.z) / 3, m * (h.x * h.x + h.z * h.z) / 3,
                     m * (h.x * h.x + h.y * h.y) / 3);
    }
    case PLUMB_CAPSULE: return of_capsule(desc.radius, desc.half_height);
    case PLUMB_CYLINDER: return of_cylinder(desc.radius, desc.half_height);
    case PLUMB_CONVEX_HULL: {
      const ConvexHull hull = convex_hull(desc);
      return of_surface(std::span<const PlumbVec3>(hull.vertices), hull.triangles, "convex hull");
    }
    case PLUMB_TRIANGLE_MESH: return of_mesh(desc);
    case PLUMB_COMPOUND:
      if (desc.child_count == 0 || desc.child_count != children_properties.size())
        throw Error(PLUMB_E_INVALID_ARGUMENT, "compound: " + std::to_string(desc.child_count) + " children, but " +
                                                  std::to_string(children_properties.size()) +
                                                  " mass properties; give at least one child and one each");
      return of_children({desc.children, desc.child_count}, children_properties);
    case PLUMB_PLANE:
      throw Error(PLUMB_E_INVALID_ARGUMENT, "plane: has no volume; only static bodies can have this shape");
    case PLUMB_HEIGHT_FIELD:
      throw Error(PLUMB_E_INVALID_ARGUMENT, "height field: has no volume; only static bodies can have this shape");
    default:
      throw Error(PLUMB_E_INVALID_ARGUMENT, "shape type " + std::to_string(desc.type) +
                                                " does not exist; types are below " +
                                                std::to_string(PLUMB_SHAPE_TYPE_COUNT));
  }
}

}  // namespace plumb::backend
