#include "referee/shape.hpp"

#include <map>
#include <string>
#include <utility>

#include "plumb/assert.hpp"
#include "referee/hull.hpp"

namespace plumb::referee {

std::size_t Polytope::support(const Vec3& direction) const {
  PLUMB_ASSERT(!corners.empty());
  std::size_t best = 0;
  double furthest = corners[0].dot(direction);
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (const double reach = corners[i].dot(direction); reach > furthest) furthest = reach, best = i;
  return best;
}

namespace {

// Centre, radius, and the face offsets, which must bound every corner.
void finish(Polytope& polytope) {
  polytope.centre.setZero();
  for (const Vec3& corner : polytope.corners) polytope.centre += corner / static_cast<double>(polytope.corners.size());
  for (const Vec3& corner : polytope.corners)
    polytope.radius = std::max(polytope.radius, (corner - polytope.centre).norm());
  for (Polytope::Face& face : polytope.faces)
    face.offset = polytope.corners[polytope.support(face.normal)].dot(face.normal);
}

// Faces and edges from loops of corners, counter-clockwise seen from outside. False when the loops do not close up.
bool add_loops(Polytope& polytope, const std::vector<std::vector<std::uint32_t>>& loops,
               const std::vector<Vec3>& normals) {
  PLUMB_ASSERT(loops.size() == normals.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> face_of;
  for (std::size_t f = 0; f < loops.size(); ++f)
    for (std::size_t i = 0; i < loops[f].size(); ++i) face_of[{loops[f][i], loops[f][(i + 1) % loops[f].size()]}] = f;
  polytope.faces.clear();
  polytope.edges.clear();
  for (const Vec3& normal : normals) polytope.faces.push_back({normal, 0});
  for (const auto& [edge, left] : face_of) {
    const auto twin = face_of.find({edge.second, edge.first});
    if (twin == face_of.end()) return false;
    if (edge.first < edge.second)
      polytope.edges.push_back({edge.first, edge.second, normals[left], normals[twin->second]});
  }
  polytope.solid = true;
  return true;
}

}  // namespace

Polytope triangle_polytope(const Shape::Triangle& triangle) {
  Polytope polytope;
  polytope.corners = {triangle[0], triangle[1], triangle[2]};
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  polytope.faces = {{normal, 0}, {-normal, 0}};
  for (std::uint32_t i = 0; i < 3; ++i) polytope.edges.push_back({i, (i + 1) % 3, normal, -normal});
  finish(polytope);
  return polytope;
}

ShapePtr Shape::make(const PlumbShapeDesc& desc, std::span<const ShapePtr> children) {
  auto shape = std::make_shared<Shape>();
  shape->type_ = desc.type;
  switch (desc.type) {
    case PLUMB_SPHERE:
      shape->radius_ = desc.radius;
      shape->core_.corners = {Vec3::Zero()};
      break;
    case PLUMB_BOX:
      shape->half_extents_ = vec(desc.half_extents);
      shape->make_box_core();
      break;
    case PLUMB_CAPSULE:
      shape->radius_ = desc.radius;
      shape->half_height_ = desc.half_height;
      shape->core_.corners = {Vec3(0, -desc.half_height, 0), Vec3(0, desc.half_height, 0)};
      shape->core_.edges = {{0, 1, Vec3::Zero(), Vec3::Zero()}};
      finish(shape->core_);
      break;
    case PLUMB_CYLINDER:
      shape->radius_ = desc.radius;
      shape->half_height_ = desc.half_height;
      break;
    case PLUMB_CONVEX_HULL: shape->make_hull_core(desc); break;
    case PLUMB_TRIANGLE_MESH:
      shape->make_mesh(desc);
      shape->find_neighbours();
      break;
    case PLUMB_HEIGHT_FIELD:
      shape->make_height_field(desc);
      shape->find_neighbours();
      break;
    case PLUMB_PLANE: break;
    case PLUMB_COMPOUND:
      if (children.size() != desc.child_count || children.empty())
        throw Error(PLUMB_E_INVALID_ARGUMENT, "compound: " + std::to_string(desc.child_count) + " children, but " +
                                                  std::to_string(children.size()) + " shapes were given for them");
      for (std::size_t i = 0; i < children.size(); ++i)
        shape->children_.push_back({children[i], pose(desc.children[i].pose)});
      break;
    default:
      throw Error(PLUMB_E_INVALID_ARGUMENT, "shape type " + std::to_string(desc.type) +
                                                " does not exist; types are below " +
                                                std::to_string(PLUMB_SHAPE_TYPE_COUNT));
  }
  for (const Triangle& triangle : shape->triangles_) {
    Aabb box;
    for (const Vec3& corner : triangle) box.include(corner);
    shape->triangle_bounds_.push_back(box);
  }
  return shape;
}

void Shape::make_box_core() {
  for (int i = 0; i < 8; ++i)
    core_.corners.emplace_back((i & 1 ? 1 : -1) * half_extents_.x(), (i & 2 ? 1 : -1) * half_extents_.y(),
                               (i & 4 ? 1 : -1) * half_extents_.z());
  add_loops(core_, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}},
            {-Vec3::UnitX(), Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitY(), -Vec3::UnitZ(), Vec3::UnitZ()});
  finish(core_);
}

void Shape::make_hull_core(const PlumbShapeDesc& desc) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < desc.vertex_count; ++i)
    points.emplace_back(desc.vertices[3 * i], desc.vertices[3 * i + 1], desc.vertices[3 * i + 2]);
  const Hull hull = convex_hull(points);
  core_.corners = hull.corners;
  for (const auto& t : hull.triangles)
    triangles_.push_back({core_.corners[t[0]], core_.corners[t[1]], core_.corners[t[2]]});

  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<Vec3> normals;
  for (const Hull::Face& face : hull.faces) {
    loops.push_back(face.loop);
    normals.push_back(face.normal);
  }
  if (!add_loops(core_, loops,
                 normals)) {  // merged faces of a nearly flat patch may disagree on a corner: triangles cannot
    loops.clear();
    normals.clear();
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      loops.emplace_back(hull.triangles[t].begin(), hull.triangles[t].end());
      normals.push_back((triangles_[t][1] - triangles_[t][0]).cross(triangles_[t][2] - triangles_[t][0]).normalized());
    }
    add_loops(core_, loops, normals);
  }
  finish(core_);
}

void Shape::make_mesh(const PlumbShapeDesc& desc) {
  const auto vertex = [&](std::uint32_t i) {
    const double* v = desc.vertices + 3 * std::size_t{i};
    return Vec3(v[0], v[1], v[2]);
  };
  for (std::size_t t = 0; t < desc.triangle_count; ++t)
    triangles_.push_back(
        {vertex(desc.indices[3 * t]), vertex(desc.indices[3 * t + 1]), vertex(desc.indices[3 * t + 2])});
}

void Shape::make_height_field(const PlumbShapeDesc& desc) {
  const auto point = [&](std::uint32_t row, std::uint32_t column) {
    return Vec3((column - (desc.columns - 1) / 2.0) * desc.spacing.x,
                desc.heights[std::size_t{row} * desc.columns + column], (row - (desc.rows - 1) / 2.0) * desc.spacing.z);
  };
  for (std::uint32_t row = 0; row + 1 < desc.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < desc.columns; ++column) {
      const Vec3 near = point(row, column), right = point(row, column + 1);
      const Vec3 far = point(row + 1, column), across = point(row + 1, column + 1);
      triangles_.push_back({near, far, right});
      triangles_.push_back({right, far, across});
    }
}

void Shape::find_neighbours() {
  using Place = std::array<double, 3>;
  const auto place = [](const Vec3& p) { return Place{p.x(), p.y(), p.z()}; };
  struct Across {
    Vec3 normal;
    int count = 0;
  };
  std::map<std::pair<Place, Place>, Across> across;
  for (const Triangle& t : triangles_)
    for (std::size_t e = 0; e < 3; ++e) {
      Across& side = across[{place(t[e]), place(t[(e + 1) % 3])}];
      side.normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
      ++side.count;
    }
  for (const Triangle& t : triangles_) {
    std::array<Vec3, 3> normals = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (std::size_t e = 0; e < 3; ++e)
      if (const auto twin = across.find({place(t[(e + 1) % 3]), place(t[e])});
          twin != across.end() && twin->second.count == 1)
        normals[e] = twin->second.normal;
    neighbour_normals_.push_back(normals);
  }
}

Vec3 Shape::core_support(const Vec3& direction) const {
  if (type_ == PLUMB_BOX)
    return {direction.x() < 0 ? -half_extents_.x() : half_extents_.x(),
            direction.y() < 0 ? -half_extents_.y() : half_extents_.y(),
            direction.z() < 0 ? -half_extents_.z() : half_extents_.z()};
  if (type_ == PLUMB_CYLINDER) {
    const double across = std::hypot(direction.x(), direction.z());
    const double s = across > 0 ? radius_ / across : 0;
    return {s * direction.x(), direction.y() < 0 ? -half_height_ : half_height_, s * direction.z()};
  }
  return core_.corners[core_.support(direction)];
}

Vec3 Shape::support(const Vec3& direction) const {
  const double grow = rounding();
  return grow > 0 ? Vec3(core_support(direction) + grow * direction.normalized()) : core_support(direction);
}

Aabb Shape::bounds(const Pose& pose) const {
  Aabb box;
  if (convex()) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 direction = pose.rotation.row(axis).transpose();  // the world's axis in local coordinates
      box.low[axis] = (pose * core_support(-direction))[axis] - rounding();
      box.high[axis] = (pose * core_support(direction))[axis] + rounding();
    }
  } else if (type_ == PLUMB_PLANE) {
    box = {Vec3::Constant(-infinity), Vec3::Constant(infinity)};
    const Vec3 normal = pose.rotation.col(1);
    for (int axis = 0; axis < 3; ++axis) {  // only a plane square to an axis is bounded, on one side
      if (normal[axis] == 1) box.high[axis] = pose.position[axis];
      if (normal[axis] == -1) box.low[axis] = pose.position[axis];
    }
  } else {
    for (const Child& child : children_) box.include(child.shape->bounds(pose * child.pose));
    for (const Triangle& triangle : triangles_)
      for (const Vec3& corner : triangle) box.include(pose * corner);
  }
  return box;
}

}  // namespace plumb::referee
