#include "convert/sdf/standard_models.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace plumb::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* ground = R"(<model name="ground_plane"><static>true</static><link name="link">
  <collision name="collision"><geometry><plane><normal>0 0 1</normal></plane></geometry>
    <surface><friction><ode><mu>100</mu></ode></friction></surface></collision>
</link></model>)";
constexpr const char* sun = R"(<light type="directional" name="sun"><direction>0 0 -1</direction></light>)";

void write_model(const fs::path& folder, const std::string& name, const std::string& content) {
  fs::create_directories(folder);
  std::ofstream(folder / "model.config") << fmt::format(
      R"(<model><name>{}</name><sdf version="1.6">model.sdf</sdf></model>)", name);
  std::ofstream(folder / "model.sdf") << fmt::format(R"(<sdf version="1.6">{}</sdf>)", content);
}

}  // namespace

std::string StandardModels::find(const std::string& uri) {
  for (const auto& [name, content] : {std::pair{"ground_plane", ground}, {"sun", sun}}) {
    if (uri != fmt::format("model://{}", name)) continue;
    if (!folder_) folder_.emplace("plumb-models");
    write_model(folder_->path() / name, name, content);
    return (folder_->path() / name).string();
  }
  return "";
}

}  // namespace plumb::harness
