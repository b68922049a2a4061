#include "convert/read.hpp"

#include <fmt/format.h>

#include <cctype>

#include "base/packed_file.hpp"
#include "base/shown.hpp"
#include "convert/gltf/read_gltf.hpp"
#include "convert/mjcf/read_mjcf.hpp"
#include "convert/sdf/read_sdf.hpp"

namespace plumb::harness {
namespace {

/// The name of the outermost XML element; "" where there is none.
std::string outermost_element(const std::string& begin) {
  for (std::size_t at = 0; (at = begin.find('<', at)) != std::string::npos; ++at) {
    if (begin.compare(at, 4, "<!--") == 0) {
      at = begin.find("-->", at);
      if (at == std::string::npos) return "";
      continue;
    }
    const auto is_letter = [&](std::size_t i) {
      return i < begin.size() && std::isalpha(static_cast<unsigned char>(begin[i])) != 0;
    };
    std::size_t end = at + 1;
    while (is_letter(end)) ++end;
    if (end > at + 1) return begin.substr(at + 1, end - at - 1);
  }
  return "";
}

}  // namespace

Imported read_machine(const ModelFolders& folders) {
  if (folders.file.extension() == ".gltf" || folders.file.extension() == ".glb") return read_gltf(folders);
  const std::string element = outermost_element(text_of_file(folders.file));
  if (element == "sdf" || element == "robot") return read_sdf(folders);
  if (element == "mujoco") return read_mjcf(folders);
  throw UsageError(fmt::format(
      "{}: {}; an SDF file begins with <sdf>, a URDF file with <robot>, an MJCF file with <mujoco>",
      folders.file.string(),
      element.empty() ? "this is no XML"
                      : fmt::format("it begins with <{}>, which is none that is known", shortened(element))));
}

}  // namespace plumb::harness
