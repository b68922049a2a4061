#include "replay/mesh.hpp"

#include <cmath>
#include <numbers>

namespace plumb::harness {

namespace {

using Point = std::array<double, 3>;

constexpr int segments = 24;
constexpr double reach_of_plane = 50;        // m
constexpr double radius_of_particle = 0.05;  // m

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

void add_vertex(DrawnMesh& mesh, const Point& at, const Point& normal) {
  mesh.positions.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
  mesh.normals.push_back({static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])});
}

// A flat face with vertices of its own. What has no area has no normal and is left out.
void add_face(DrawnMesh& mesh, const std::vector<Point>& corners) {
  Point normal{0, 0, 0};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Point part = cross(minus(corners[i], corners[0]), minus(corners[i + 1], corners[0]));
    for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += part[axis];
  }
  const double size = std::hypot(normal[0], normal[1], normal[2]);
  if (!(size > 0)) return;
  for (double& x : normal) x /= size;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Point& corner : corners) add_vertex(mesh, corner, normal);
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i)
    for (const std::uint32_t index : {first, first + i, first + i + 1}) mesh.indices.push_back(index);
}

/// A point of a profile that is turned about y, from the bottom up, and its normal in the profile's plane.
struct ProfilePoint {
  double radius, y, normal_radius, normal_y;
};

DrawnMesh turned(const std::vector<ProfilePoint>& profile) {
  DrawnMesh mesh;
  for (const ProfilePoint& point : profile) {
    for (int i = 0; i <= segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments, c = std::cos(angle), s = std::sin(angle);
      add_vertex(mesh, {point.radius * c, point.y, point.radius * s},
                 {point.normal_radius * c, point.normal_y, point.normal_radius * s});
    }
  }
  constexpr std::uint32_t row = segments + 1;
  for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (std::uint32_t i = 0; i < segments; ++i) {
      const std::uint32_t a = ring * row + i, b = a + 1, c = a + row, d = c + 1;
      if (profile[ring].radius > 0) mesh.indices.insert(mesh.indices.end(), {a, c, b});
      if (profile[ring + 1].radius > 0) mesh.indices.insert(mesh.indices.end(), {b, c, d});
    }
  }
  return mesh;
}

// Of a sphere (half_height 0) or a capsule.
DrawnMesh rounded(double radius, double half_height) {
  std::vector<ProfilePoint> profile;
  constexpr int rings = segments / 2;
  for (int i = 0; i <= rings; ++i) {
    const double polar = std::numbers::pi * (static_cast<double>(i) / rings - 0.5);
    const double across = i == 0 || i == rings ? 0 : std::cos(polar), up = std::sin(polar);
    if (i == rings / 2 && half_height > 0) profile.push_back({radius, -half_height, 1, 0});
    profile.push_back({radius * across, radius * up + (i < rings / 2 ? -half_height : half_height), across, up});
  }
  return turned(profile);
}

DrawnMesh cylinder(double radius, double half_height) {
  DrawnMesh mesh = turned({{radius, -half_height, 1, 0}, {radius, half_height, 1, 0}});
  std::vector<Point> top, bottom;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    const double x = radius * std::cos(angle), z = radius * std::sin(angle);
    bottom.push_back({x, -half_height, z});
    top.insert(top.begin(), {x, half_height, z});
  }
  add_face(mesh, bottom);
  add_face(mesh, top);
  return mesh;
}

DrawnMesh box(const Point& half) {
  DrawnMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::vector<Point> corners(4);
      for (std::size_t k = 0; k < 4; ++k) {
        corners[k][axis] = side * half[axis];
        corners[k][u] = (k == 1 || k == 2 ? side : -side) * half[u];
        corners[k][v] = (k >= 2 ? 1 : -1) * half[v];
      }
      add_face(mesh, corners);
    }
  }
  return mesh;
}

DrawnMesh faces(const Json& vertices, const Json& loops) {
  DrawnMesh mesh;
  for (const Json& loop : loops) {
    std::vector<Point> corners;
    for (const Json& vertex : loop) corners.push_back(vertices.at(vertex.get<std::size_t>()).get<Point>());
    add_face(mesh, corners);
  }
  return mesh;
}

DrawnMesh height_field(const Json& shape) {
  const auto rows = shape.at("rows").get<std::size_t>(), columns = shape.at("columns").get<std::size_t>();
  const auto heights = shape.at("heights").get<std::vector<double>>();
  const double dx = shape.at("spacing").at(0), dz = shape.at("spacing").at(1);
  const auto point = [&](std::size_t row, std::size_t column) {
    return Point{(static_cast<double>(column) - static_cast<double>(columns - 1) / 2) * dx,
                 heights.at(row * columns + column),
                 (static_cast<double>(row) - static_cast<double>(rows - 1) / 2) * dz};
  };
  DrawnMesh mesh;
  for (std::size_t r = 0; r + 1 < rows; ++r) {
    for (std::size_t c = 0; c + 1 < columns; ++c) {
      add_face(mesh, {point(r, c), point(r + 1, c), point(r, c + 1)});
      add_face(mesh, {point(r, c + 1), point(r + 1, c), point(r + 1, c + 1)});
    }
  }
  return mesh;
}

}  // namespace

DrawnMesh drawn_mesh(const Json& shape) {
  if (shape.is_null()) return rounded(radius_of_particle, 0);
  const std::string type = shape.at("type");
  if (type == "sphere") return rounded(shape.at("radius"), 0);
  if (type == "capsule") return rounded(shape.at("radius"), shape.at("half_height"));
  if (type == "cylinder") return cylinder(shape.at("radius"), shape.at("half_height"));
  if (type == "box") return box(shape.at("half_extents").get<Point>());
  if (type == "hull") return faces(shape.at("vertices"), shape.at("faces"));
  if (type == "mesh") return faces(shape.at("vertices"), shape.at("triangles"));
  if (type == "height_field") return height_field(shape);
  DrawnMesh plane;
  constexpr double r = reach_of_plane;
  add_face(plane, {{-r, 0, -r}, {-r, 0, r}, {r, 0, r}, {r, 0, -r}});
  return plane;
}

}  // namespace plumb::harness
