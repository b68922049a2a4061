#include "convert/mjcf/mjcf_shapes.hpp"

#include <fmt/format.h>

#include "convert/upright.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;

/// MuJoCo moves a mesh's vertices to the middle of its mass, and the geom's pose with them.
Model mesh_of(const mjModel& model, int mesh) {
  Model surface;
  const float* vertices = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  surface.vertices.assign(vertices, vertices + 3 * model.mesh_vertnum[mesh]);
  const int* faces = model.mesh_face + 3 * model.mesh_faceadr[mesh];
  for (int i = 0; i < 3 * model.mesh_facenum[mesh]; ++i)
    surface.indices.push_back(static_cast<std::uint32_t>(faces[i]));
  return surface;
}

/// A height field's elevations are from 0 to 1, of its third size; rows run along y.
SceneShape height_field(const mjModel& model, int field) {
  SceneShape shape;
  shape.desc = shape_desc(PLUMB_TRIANGLE_MESH);
  const int rows = model.hfield_nrow[field], columns = model.hfield_ncol[field];
  const mjtNum* size = model.hfield_size + 4 * field;
  const float* heights = model.hfield_data + model.hfield_adr[field];
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      shape.vertices.insert(shape.vertices.end(),
                            {size[0] * (2.0 * column / (columns - 1) - 1), size[1] * (2.0 * row / (rows - 1) - 1),
                             size[2] * static_cast<double>(heights[row * columns + column])});
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column + 1 < columns; ++column) {
      const auto near = static_cast<std::uint32_t>(row * columns + column),
                 far = near + static_cast<std::uint32_t>(columns);
      shape.indices.insert(shape.indices.end(), {near, near + 1, far + 1, near, far + 1, far});
    }
  return shape;
}

LinkShape shape_of(const mjModel& model, int geom, bool moves, const std::string& name, Remarks& remarks) {
  LinkShape part;
  part.pose = {rotation_at(model.geom_quat, geom), vec_at(model.geom_pos, geom)};
  part.material.friction = model.geom_friction[3 * geom];
  const Vec3 size = vec_at(model.geom_size, geom);
  switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE: part.shape = sphere_shape(size.x()); return part;
    case mjGEOM_BOX: part.shape = box_shape_of(size); return part;
    case mjGEOM_CAPSULE:
      part.shape = capsule_shape(size.x(), size.y());
      part.pose = part.pose * along_z();
      return part;
    case mjGEOM_CYLINDER:
      part.shape = cylinder_shape(size.x(), size.y());
      part.pose = part.pose * along_z();
      return part;
    case mjGEOM_ELLIPSOID:
      part.shape = ellipsoid_shape(size);
      remarks.add("ellipsoids are hulls of 64 corners", name);
      return part;
    case mjGEOM_PLANE:
      part.shape = plane_shape();
      part.pose = part.pose * along_z();
      return part;
    case mjGEOM_MESH:
      part.shape = surface_shape(mesh_of(model, model.geom_dataid[geom]), moves, name, remarks);
      return part;
    case mjGEOM_HFIELD: part.shape = height_field(model, model.geom_dataid[geom]); return part;
    default: throw UsageError(fmt::format("geom \"{}\" is of a kind that scenes lack", name));
  }
}

}  // namespace

bool collides(const mjModel& model, int geom) {
  const bool none = model.opt.collision == mjCOL_PAIR || (model.opt.disableflags & mjDSBL_CONTACT) != 0;
  return !none && (model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0);
}

std::vector<LinkShape> shapes_of(const mjModel& model, int body, bool moves, Remarks& remarks) {
  std::vector<LinkShape> shapes;
  for (int i = 0; i < model.body_geomnum[body]; ++i) {
    const int geom = model.body_geomadr[body] + i;
    if (!collides(model, geom)) continue;
    shapes.push_back(shape_of(model, geom, moves, name_of(model, mjOBJ_GEOM, geom, "geom"), remarks));
  }
  return shapes;
}

}  // namespace plumb::harness
