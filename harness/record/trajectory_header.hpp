// What a trajectory's file says before its frames: enough to draw the scene and to say what is seen.
#pragma once

#include <span>

#include "base/json.hpp"
#include "simulation/simulation.hpp"

namespace plumb::harness {

/// {"type":"box","half_extents"}, {"type":"sphere","radius"}, {"type":"capsule"|"cylinder","radius","half_height"}
/// (along y), {"type":"hull","vertices":[[3]],"faces":[[..]]}, {"type":"mesh","vertices","triangles"},
/// {"type":"plane","normal","offset"}, {"type":"height_field","rows","columns","spacing":[x, z],"heights"},
/// {"type":"compound","children":[{"shape","position","orientation"}]}. m; orientations x y z w.
[[nodiscard]] Json replay_shape(const SceneShape& shape);

/// {"kind","scene","dt","seconds","shapes","bodies":[{"name","shape","motion","start":[7]}],"moving","joints"}:
/// bodies start at `poses`; moving are those that are not static; joints as in record/joint_layer.hpp, missing in the
/// files of older programs.
[[nodiscard]] Json replay_header(const Scene& scene, std::span<const PoseRow> poses);

}  // namespace plumb::harness
