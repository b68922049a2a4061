// A scene as a world in SDFormat 1.9.
#pragma once

#include "convert/imported.hpp"

namespace plumb::harness {

/// The text, and the files of meshes that it names.
struct SdfFiles {
  std::string world;
  std::map<std::string, std::string> meshes;  ///< OBJ texts by file name
};

/// Z is up there, cylinders lie along z, and what joints hold together is one model. name: of the world, and what names
/// of mesh files begin with. Throws UsageError for joints that SDF lacks; what else it has no word for becomes remarks.
[[nodiscard]] SdfFiles write_sdf(const Scene& scene, const std::string& name, Remarks& remarks);

}  // namespace plumb::harness
