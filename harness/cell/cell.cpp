#include "cell/cell.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string_view>

namespace plumb::harness {

namespace {

// FNV-1a, 64 bits (Fowler, Noll, Vo).
class TextHash {
 public:
  void add(std::string_view text) {
    for (const char c : text) state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  [[nodiscard]] std::string hex() const { return fmt::format("{:016x}", state_); }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

// The backend and what it was asked to be.
std::string label_of(const Cell& cell) {
  std::string label = cell.backend->name;
  for (const auto& [name, value] : cell.settings.items()) label += " " + name + "=" + typed_text(value);
  if (cell.profile != "default") label += " " + cell.profile;
  return label;
}

}  // namespace

Json json_of(const Parameters& parameters) {
  Json json = Json::object();
  for (const auto& [name, value] : parameters) std::visit([&, &key = name](const auto& v) { json[key] = v; }, value);
  return json;
}

Scene instantiate_with(const SceneFile& file, const Parameters& parameters, std::optional<double> dt,
                       std::optional<double> seconds) {
  return file.instantiate(parameters, {dt, seconds});
}

std::string cell_id(const Cell& cell) {
  // Sorted by key, so that the order in which settings were typed makes no difference.
  const nlohmann::json identity{{"scene", cell.scene->hash},
                                {"id", cell.scene->id},
                                {"parameters", nlohmann::json::parse(json_of(cell.parameters).dump())},
                                {"backend", cell.backend->name},
                                {"build", cell.backend_build},
                                {"settings", nlohmann::json::parse(cell.settings.dump())},
                                {"profile", cell.profile},
                                {"needs", cell.needs},
                                {"dt", cell.dt},
                                {"seconds", cell.seconds},
                                {"threads", cell.threads}};
  TextHash hash;
  hash.add(identity.dump());
  return hash.hex();
}

Json request_of(const Cell& cell, const CellFiles& files) {
  return {{"request", "run"},
          {"scene", cell.scene->path.string()},
          {"scene_hash", fmt::format("{:016x}", cell.scene->hash)},
          {"parameters", json_of(cell.parameters)},
          {"settings", cell.settings},
          {"dt", cell.dt},
          {"seconds", cell.seconds},
          {"threads", cell.threads},
          {"needs", cell.needs},
          {"trajectory", files.trajectory},
          {"layers", files.layers},
          {"about",
           {{"title", cell.scene->title},
            {"params", json_of(cell.shown)},
            {"backend", cell.backend->name},
            {"label", label_of(cell)},
            {"cell", cell_id(cell)}}},
          {"trace", files.trace},
          {"timeline", files.timeline}};
}

std::string build_id(const BackendDescription& backend) {
  TextHash hash;
  std::ifstream library(backend.file, std::ios::binary);
  std::string block(1 << 16, '\0');
  while (library.read(block.data(), static_cast<std::streamsize>(block.size())) || library.gcount() > 0)
    hash.add(std::string_view(block.data(), static_cast<std::size_t>(library.gcount())));
  hash.add(backend.version);
  hash.add(backend.build);
  return hash.hex();
}

}  // namespace plumb::harness
