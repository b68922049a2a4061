// Making shapes and geoms, and putting geoms in their places.
#include "shapes.hpp"

#include <string>

#include "plumb/assert.hpp"
#include "plumb/backend/convex_hull.hpp"

namespace plumb::ode {
namespace {

/// Turns z, the axis of ODE's capsules and cylinders, to y, the axis of ours. Exact.
constexpr dMatrix3 turn_axis = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0};

/// How far below its lowest point a height field still pushes up what has sunk through it.
constexpr double field_thickness = 1;

void take_hull(Shape& shape, const PlumbShapeDesc& desc) {
  const backend::ConvexHull hull = backend::convex_hull(desc);
  PLUMB_ASSERT(hull.vertices.size() >= 4 && hull.faces.size() >= 4);
  for (const PlumbVec3& vertex : hull.vertices) shape.centre = add(shape.centre, vertex);
  shape.centre = scale(1.0 / static_cast<double>(hull.vertices.size()), shape.centre);
  for (const PlumbVec3& vertex : hull.vertices) {
    const PlumbVec3 p = sub(vertex, shape.centre);
    shape.points.insert(shape.points.end(), {p.x, p.y, p.z});
  }
  for (const backend::HullFace& face : hull.faces) {
    const PlumbVec3& n = face.normal;
    shape.planes.insert(shape.planes.end(), {n.x, n.y, n.z, face.offset - dot(n, shape.centre)});
    shape.polygons.push_back(static_cast<unsigned>(face.loop.size()));
    shape.polygons.insert(shape.polygons.end(), face.loop.begin(), face.loop.end());
  }
}

/// OPCODE builds no tree over a single triangle and crashes in the search for it, so such a mesh is cut in two.
void split_single_triangle(Shape& shape) {
  const std::uint32_t a = shape.indices[0], b = shape.indices[1], c = shape.indices[2];
  const auto middle = static_cast<std::uint32_t>(shape.vertices.size() / 3);
  for (std::size_t axis = 0; axis < 3; ++axis)
    shape.vertices.push_back(0.5 *
                             (shape.vertices[3 * std::size_t{b} + axis] + shape.vertices[3 * std::size_t{c} + axis]));
  shape.indices = {a, b, middle, a, middle, c};
}

void take_mesh(Shape& shape, const PlumbShapeDesc& desc) {
  static_assert(sizeof(dTriIndex) == sizeof(std::uint32_t));
  shape.vertices.assign(desc.vertices, desc.vertices + std::size_t{desc.vertex_count} * 3);
  shape.triangle_count = desc.triangle_count;
  shape.indices.assign(desc.indices, desc.indices + std::size_t{desc.triangle_count} * 3);
  if (desc.triangle_count == 1) split_single_triangle(shape);
  shape.mesh.reset(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildDouble(shape.mesh.get(), shape.vertices.data(), 3 * sizeof(double),
                              static_cast<int>(shape.vertices.size() / 3), shape.indices.data(),
                              static_cast<int>(shape.indices.size()), 3 * sizeof(std::uint32_t));
  // Hull against mesh reads the angles between faces without asking whether they are there.
  if (dGeomTriMeshDataPreprocess2(shape.mesh.get(), 1u << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr) == 0)
    throw Error(PLUMB_E_OUT_OF_MEMORY, "ODE cannot work out the angles between the faces of a mesh of " +
                                           std::to_string(desc.triangle_count) + " triangles");
}

void take_height_field(Shape& shape, const PlumbShapeDesc& desc) {
  shape.vertices.assign(desc.heights, desc.heights + std::size_t{desc.rows} * desc.columns);
  shape.field.reset(dGeomHeightfieldDataCreate());
  dGeomHeightfieldDataBuildDouble(shape.field.get(), shape.vertices.data(), 0, (desc.columns - 1) * desc.spacing.x,
                                  (desc.rows - 1) * desc.spacing.z, static_cast<int>(desc.columns),
                                  static_cast<int>(desc.rows), 1, 0, field_thickness, 0);
}

dGeomID make_geom(const Shape& shape, dSpaceID space) {
  switch (shape.type) {
    case PLUMB_SPHERE: return dCreateSphere(space, shape.radius);
    case PLUMB_BOX:
      return dCreateBox(space, 2 * shape.half_extents.x, 2 * shape.half_extents.y, 2 * shape.half_extents.z);
    case PLUMB_CAPSULE:
      if (shape.half_height == 0) return dCreateSphere(space, shape.radius);
      return dCreateCapsule(space, shape.radius, 2 * shape.half_height);
    case PLUMB_CYLINDER: return dCreateCylinder(space, shape.radius, 2 * shape.half_height);
    case PLUMB_CONVEX_HULL:
      return dCreateConvex(space, shape.planes.data(), static_cast<unsigned>(shape.planes.size() / 4),
                           shape.points.data(), static_cast<unsigned>(shape.points.size() / 3), shape.polygons.data());
    case PLUMB_TRIANGLE_MESH: return dCreateTriMesh(space, shape.mesh.get(), nullptr, nullptr, nullptr);
    case PLUMB_HEIGHT_FIELD: return dCreateHeightfield(space, shape.field.get(), 1);
    case PLUMB_PLANE: return dCreatePlane(space, 0, 1, 0, 0);
    default: throw Error(PLUMB_E_UNSUPPORTED, "ODE has no shape of type " + std::to_string(shape.type));
  }
}

PlacedGeom place(const Shape& shape, dSpaceID space, const PlumbPose& pose) {
  PlumbPose at = pose;
  at.position = add(at.position, rotate(at.orientation, shape.centre));
  const bool lying = shape.type == PLUMB_CYLINDER || shape.type == PLUMB_CAPSULE;
  return {make_geom(shape, space), at, lying, 0, nullptr};
}

struct Rotation {
  Rotation(const PlumbQuat& orientation, bool lying) {
    if (orientation.x == 0 && orientation.y == 0 && orientation.z == 0) {
      dRSetIdentity(turn);
    } else {
      dRfromQ(turn, OdeQuaternion(orientation).wxyz);
    }
    if (!lying) return;
    dMatrix3 frame;
    std::copy(std::begin(turn), std::end(turn), std::begin(frame));
    dMultiply0_333(turn, frame, turn_axis);
  }
  dMatrix3 turn{};
};

}  // namespace

void fill_shape(Shape& shape, const PlumbShapeDesc& desc, const std::vector<const Shape*>& children) {
  shape.type = desc.type;
  shape.radius = desc.radius;
  shape.half_height = desc.half_height;
  shape.half_extents = desc.half_extents;
  if (desc.type == PLUMB_CONVEX_HULL) take_hull(shape, desc);
  if (desc.type == PLUMB_TRIANGLE_MESH) take_mesh(shape, desc);
  if (desc.type == PLUMB_HEIGHT_FIELD) take_height_field(shape, desc);
  shape.materials = backend::TriangleMaterials(desc);
  PLUMB_ASSERT(children.size() == (desc.type == PLUMB_COMPOUND ? desc.child_count : 0));
  for (std::size_t i = 0; i < children.size(); ++i) {
    const PlumbCompoundChild& child = desc.children[i];
    shape.children.push_back({children[i], child.pose, child.has_material != 0, child.material});
  }
}

void make_geoms(const Shape& shape, dSpaceID space, std::vector<PlacedGeom>& geoms) {
  if (shape.type != PLUMB_COMPOUND) {
    geoms.push_back(place(shape, space, identity_pose()));
    return;
  }
  for (std::uint32_t i = 0; i < shape.children.size(); ++i) {
    const Shape::Child& child = shape.children[i];
    PlacedGeom placed = place(*child.shape, space, child.pose);
    placed.child = i;
    placed.material = child.has_material ? &child.material : nullptr;
    geoms.push_back(placed);
  }
}

void place_geom(const PlacedGeom& geom, const PlumbPose& frame) {
  if (dGeomGetClass(geom.geom) == dPlaneClass) {
    const PlumbVec3 up = rotate(frame.orientation, {0, 1, 0});
    dGeomPlaneSetParams(geom.geom, up.x, up.y, up.z, dot(up, frame.position));
    return;
  }
  const PlumbPose pose = compose(frame, geom.place);
  dGeomSetPosition(geom.geom, pose.position.x, pose.position.y, pose.position.z);
  dGeomSetRotation(geom.geom, Rotation(pose.orientation, geom.lying).turn);
}

void offset_geom(const PlacedGeom& geom, const PlumbVec3& centre_of_mass) {
  // A geom without an offset costs ODE less, and its place is the body's to the bit.
  const PlumbVec3 at = sub(geom.place.position, centre_of_mass);
  const PlumbQuat& q = geom.place.orientation;
  if (!is_zero(at)) dGeomSetOffsetPosition(geom.geom, at.x, at.y, at.z);
  if (geom.lying || q.x != 0 || q.y != 0 || q.z != 0) dGeomSetOffsetRotation(geom.geom, Rotation(q, geom.lying).turn);
}

}  // namespace plumb::ode
