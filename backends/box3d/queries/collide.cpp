// Collision without a step: Box3D's functions of pairs on posed shapes.
#include <algorithm>

#include "world.hpp"

namespace plumb::box3d {
namespace {

thread_local std::vector<PlumbPairPoint> pair_points;

/// What a mesh, a compound or a convex shape is made of, each at its pose in the world.
struct Part {
  const Shape* shape;
  PlumbPose pose;
};

std::vector<Part> parts_of(const Shape& shape, const PlumbPose& pose) {
  if (shape.type != PLUMB_COMPOUND) return {{&shape, pose}};
  std::vector<Part> parts;
  for (const Shape::Child& child : shape.children) parts.push_back({child.shape, backend::compose(pose, child.pose)});
  return parts;
}

constexpr int kMostPoints = 32;
struct LocalManifold {
  b3LocalManifoldPoint points[kMostPoints];
  b3LocalManifold manifold{};
  LocalManifold() { manifold.points = points; }
  LocalManifold(const LocalManifold&) = delete;
  LocalManifold& operator=(const LocalManifold&) = delete;
};

/// To the world's points; frame: that of the manifold; sign: -1 where its normal points from the second to the first.
void add_points(const b3LocalManifold& manifold, const PlumbPose& frame, double sign) {
  for (int i = 0; i < manifold.pointCount; ++i) {
    const b3LocalManifoldPoint& point = manifold.points[i];
    const PlumbVec3 normal = backend::rotate(frame.orientation, to_plumb(manifold.normal));
    pair_points.push_back({backend::compose(frame, {to_plumb(point.point), {0, 0, 0, 1}}).position,
                           backend::scale(sign, normal), -static_cast<double>(point.separation), 0});
  }
}

/// a is the one of the higher kind, as Box3D's functions want it.
void collide_ordered(b3LocalManifold& manifold, const Convex& a, const Convex& b, const b3Transform& b_to_a) {
  b3SimplexCache simplex{};
  b3SATCache axes{};
  using Kind = Convex::Kind;
  if (a.kind == Kind::sphere) return b3CollideSpheres(&manifold, kMostPoints, &a.sphere, &b.sphere, b_to_a);
  if (a.kind == Kind::capsule) {
    if (b.kind == Kind::capsule) return b3CollideCapsules(&manifold, kMostPoints, &a.capsule, &b.capsule, b_to_a);
    return b3CollideCapsuleAndSphere(&manifold, kMostPoints, &a.capsule, &b.sphere, b_to_a);
  }
  if (b.kind == Kind::hull) return b3CollideHulls(&manifold, kMostPoints, a.hull, b.hull, b_to_a, &axes);
  if (b.kind == Kind::capsule)
    return b3CollideHullAndCapsule(&manifold, kMostPoints, a.hull, &b.capsule, b_to_a, &simplex);
  b3CollideHullAndSphere(&manifold, kMostPoints, a.hull, &b.sphere, b_to_a, &simplex);
}

b3Transform seen_from(const PlumbPose& frame, const PlumbPose& other) {
  return transform(backend::compose(backend::inverse(frame), other), "pose");
}

void collide_convex(const Part& a, const Part& b) {
  const Convex shape_a = convex_of(*a.shape), shape_b = convex_of(*b.shape);
  LocalManifold found;
  if (shape_a.kind >= shape_b.kind) {
    collide_ordered(found.manifold, shape_a, shape_b, seen_from(a.pose, b.pose));
    add_points(found.manifold, a.pose, 1);
  } else {
    collide_ordered(found.manifold, shape_b, shape_a, seen_from(b.pose, a.pose));
    add_points(found.manifold, b.pose, -1);
  }
}

double distance_of_convex(const Part& a, const Part& b) {
  const Convex shape_a = convex_of(*a.shape), shape_b = convex_of(*b.shape);
  b3DistanceInput input{};
  input.proxyA = shape_a.proxy();
  input.proxyB = shape_b.proxy();
  input.transform = seen_from(a.pose, b.pose);
  input.useRadii = true;
  b3SimplexCache cache{};
  return static_cast<double>(b3ShapeDistance(&input, &cache, nullptr, 0).distance);
}

/// The convex shape in the mesh's frame: Box3D collides triangles with what lies there.
struct InMesh {
  InMesh(const Part& mesh, const Part& other) : convex(convex_of(*other.shape)), frame(mesh.pose) {
    const b3Transform at = seen_from(mesh.pose, other.pose);
    switch (convex.kind) {
      case Convex::Kind::sphere:
        convex.sphere.center = at.p;
        bounds = b3ComputeSphereAABB(&convex.sphere, b3Transform_identity);
        break;
      case Convex::Kind::capsule:
        convex.capsule.center1 = b3TransformPoint(at, convex.capsule.center1);
        convex.capsule.center2 = b3TransformPoint(at, convex.capsule.center2);
        bounds = b3ComputeCapsuleAABB(&convex.capsule, b3Transform_identity);
        break;
      case Convex::Kind::hull:
        moved.reset(b3CloneAndTransformHull(convex.hull, at, {1, 1, 1}));
        convex.hull = moved.get();
        bounds = b3ComputeHullAABB(convex.hull, b3Transform_identity);
        break;
    }
  }
  InMesh(const InMesh&) = delete;
  InMesh& operator=(const InMesh&) = delete;

  Convex convex;
  PlumbPose frame;
  Hull moved;
  b3AABB bounds{};
  double sign = 1;  ///< -1: the mesh is the pair's second
};

bool collide_triangle(b3Vec3 a, b3Vec3 b, b3Vec3 c, int /*triangle*/, void* context) {
  const InMesh& with = *static_cast<const InMesh*>(context);
  const b3Vec3 corners[3] = {a, b, c};
  LocalManifold found;
  b3SimplexCache simplex{};
  b3SATCache axes{};
  switch (with.convex.kind) {
    case Convex::Kind::sphere:
      b3CollideTriangleAndSphere(&found.manifold, kMostPoints, corners, &with.convex.sphere);
      break;
    case Convex::Kind::capsule:
      b3CollideTriangleAndCapsule(&found.manifold, kMostPoints, corners, &with.convex.capsule, &simplex);
      break;
    case Convex::Kind::hull:
      b3CollideTriangleAndHull(&found.manifold, kMostPoints, a, b, c, 0, with.convex.hull, &axes, true);
      break;
  }
  add_points(found.manifold, with.frame, with.sign);
  return true;
}

void collide_mesh(const Part& mesh, const Part& other, double sign) {
  InMesh with(mesh, other);
  with.sign = sign;
  const b3Mesh data{mesh.shape->mesh.get(), {1, 1, 1}};
  b3QueryMesh(&data, with.bounds, &collide_triangle, &with);
}

/// The distance where Box3D tells it, NaN where not: between what is not convex and apart.
double collide_parts(const Part& a, const Part& b) {
  if (a.shape->mesh && b.shape->mesh) return std::numeric_limits<double>::quiet_NaN();
  if (!a.shape->mesh && !b.shape->mesh) {
    collide_convex(a, b);
    return distance_of_convex(a, b);
  }
  a.shape->mesh ? collide_mesh(a, b, 1) : collide_mesh(b, a, -1);
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

PlumbResult World::collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                                 std::span<const PlumbPairPoint>& points) {
  pair_points.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t first = pair_points.size();
    double distance = std::numeric_limits<double>::quiet_NaN();
    for (const Part& a : parts_of(shape(pairs[i].shape_a), pairs[i].pose_a))
      for (const Part& b : parts_of(shape(pairs[i].shape_b), pairs[i].pose_b)) {
        const double apart = collide_parts(a, b);
        if (!(distance <= apart)) distance = apart;
      }
    for (const PlumbPairPoint& point : std::span(pair_points).subspan(first))
      if (!(distance <= -point.depth)) distance = -point.depth;
    results[i] = {distance, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(pair_points.size() - first)};
  }
  points = pair_points;
  return PLUMB_OK;
}

}  // namespace plumb::box3d
