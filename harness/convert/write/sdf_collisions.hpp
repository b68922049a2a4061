// The shape of a body as an SDF link's collisions.
#pragma once

#include "convert/write/write_sdf.hpp"
#include "convert/write/xml.hpp"

namespace plumb::harness {

/// What collisions are written with: where they go, the meshes that they name, what is lost.
struct SdfOutput {
  const Scene& scene;
  std::string name;  ///< what names of mesh files begin with
  Xml xml;
  std::map<std::string, std::string> meshes;
  Remarks& remarks;
};

void write_pose(Xml& xml, const referee::Pose& pose);

void write_collisions(SdfOutput& out, const SceneBody& body);

}  // namespace plumb::harness
