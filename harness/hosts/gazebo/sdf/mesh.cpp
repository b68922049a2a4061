#include "hosts/gazebo/sdf/mesh.hpp"

#include <ignition/common/MeshManager.hh>
#include <ignition/common/SubMesh.hh>
#include <ignition/common/Util.hh>

#include "hosts/gazebo/world/console.hpp"

namespace plumb::gazebo {
namespace {

void add(Geometry& geometry, const ignition::common::SubMesh& part) {
  if (part.SubMeshPrimitiveType() != ignition::common::SubMesh::TRIANGLES) return;
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size() / 3);
  const Vector& scale = geometry.size;
  for (unsigned i = 0; i < part.VertexCount(); ++i) {
    const Vector at = part.Vertex(i) * scale;
    geometry.vertices.insert(geometry.vertices.end(), {at.X(), at.Y(), at.Z()});
  }
  const bool inside_out = scale.X() * scale.Y() * scale.Z() < 0;
  for (unsigned i = 0; i + 2 < part.IndexCount(); i += 3)
    for (const unsigned corner : {0U, inside_out ? 2U : 1U, inside_out ? 1U : 2U})
      geometry.indices.push_back(first + static_cast<std::uint32_t>(part.Index(i + corner)));
}

Geometry parts_of(const ignition::common::Mesh& mesh, const std::string& submesh, const Vector& scale) {
  Geometry geometry;
  geometry.form = Form::mesh;
  geometry.size = scale;
  for (unsigned i = 0; i < mesh.SubMeshCount(); ++i)
    if (const auto part = mesh.SubMeshByIndex(i).lock(); part && (submesh.empty() || part->Name() == submesh))
      add(geometry, *part);
  return geometry;
}

}  // namespace

Geometry mesh_of(const ignition::common::Mesh& mesh, const Vector& scale) { return parts_of(mesh, "", scale); }

Geometry mesh_of(const std::string& uri, const std::string& submesh, const Vector& scale) {
  const std::string file = ignition::common::findFile(uri);
  const ignition::common::Mesh* mesh = file.empty() ? nullptr : ignition::common::MeshManager::Instance()->Load(file);
  if (mesh != nullptr) return parts_of(*mesh, submesh, scale);
  complain("the mesh [" + uri + "] cannot be " + (file.empty() ? "found" : "read") +
           "; give a path, or its folder in IGN_FILE_PATH");
  Geometry nothing;
  nothing.form = Form::mesh;
  nothing.size = scale;
  return nothing;
}

}  // namespace plumb::gazebo
