// The shape of a body as geoms of an MJCF body, and the meshes that they name as assets.
#pragma once

#include "convert/imported.hpp"
#include "convert/write/xml.hpp"

namespace plumb::harness {

/// What a model is written with.
struct MjcfOutput {
  const Scene& scene;
  Xml& xml;
  Remarks& remarks;
};

/// "pos" and "quat" of a frame in the one around it.
[[nodiscard]] std::vector<std::pair<const char*, std::string>> mjcf_pose(const referee::Pose& pose);

/// All meshes of the scene; within <asset>.
void write_meshes(MjcfOutput& out);
/// Within <body>, whose frame is the scene's body's.
void write_geoms(MjcfOutput& out, const SceneBody& body);

}  // namespace plumb::harness
