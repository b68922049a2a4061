#include "convert/imported.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "base/shown.hpp"

namespace plumb::harness {
namespace fs = std::filesystem;

std::vector<std::string> Remarks::lines() const {
  constexpr std::size_t shown = 3;
  std::vector<std::string> lines;
  for (const auto& [kind, who] : who_) {
    const std::vector<std::string> first(who.begin(), who.begin() + std::min<std::ptrdiff_t>(std::ssize(who), shown));
    std::string line = fmt::format("{}: {}", kind, fmt::join(first, ", "));
    if (who.size() > shown) line += fmt::format(" and {} more", who.size() - shown);
    lines.push_back(std::move(line));
  }
  return lines;
}

namespace {

/// "model://robot/meshes/arm.stl" -> "robot/meshes/arm.stl"; "" for what is no such URI.
std::string path_in_a_package(const std::string& uri) {
  for (const char* scheme : {"model://", "package://"})
    if (uri.starts_with(scheme)) return uri.substr(std::string(scheme).size());
  return "";
}

/// In a folder that holds packages, or in the package itself.
std::optional<fs::path> find_in(const fs::path& folder, const fs::path& in_package) {
  if (fs::exists(folder / in_package)) return folder / in_package;
  if (folder.filename() != *in_package.begin()) return std::nullopt;
  const fs::path within = folder.parent_path() / in_package;
  return fs::exists(within) ? std::optional(within) : std::nullopt;
}

/// In a package whose folder has another name than the package.
std::optional<fs::path> find_below(const fs::path& folder, const fs::path& in_package) {
  if (std::next(in_package.begin()) == in_package.end()) return std::nullopt;  // the package itself
  const fs::path place = folder / in_package.lexically_relative(*in_package.begin());
  return fs::exists(place) ? std::optional(place) : std::nullopt;
}

}  // namespace

fs::path ModelFolders::find(const std::string& uri) const {
  const fs::path above = fs::absolute(file).lexically_normal().parent_path();
  const std::string in_package = path_in_a_package(uri);
  if (in_package.empty()) {
    const std::string path = uri.starts_with("file://") ? uri.substr(7) : uri;
    const fs::path place = above / path;  // an absolute path stays itself
    if (fs::exists(place)) return place;
    throw UsageError(fmt::format("{}: it names {}, and there is no {}", file.string(), shortened(uri, 200),
                                 shortened(place.string(), 200)));
  }
  std::vector<fs::path> all;
  for (const fs::path& folder : folders) all.push_back(fs::absolute(folder).lexically_normal());
  for (fs::path folder = above;; folder = folder.parent_path()) {
    all.push_back(folder);
    if (folder == folder.parent_path()) break;
  }
  for (const fs::path& folder : all)
    if (const auto found = find_in(folder, in_package)) return *found;
  for (const fs::path& folder : all)
    if (const auto found = find_below(folder, in_package)) return *found;
  throw UsageError(
      fmt::format("{}: it names {}, which is in none of the folders above it{}; name the folder that "
                  "holds {} by --folder",
                  file.string(), shortened(uri, 200), folders.empty() ? "" : " nor in those of --folder",
                  shortened(fs::path(in_package).begin()->string())));
}

std::string scene_name(const std::string& name) {
  constexpr std::size_t most = 200;
  std::string right = name.substr(0, most);
  for (char& c : right) {
    if (c == '{') c = '(';
    if (c == '}') c = ')';
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = ' ';
  }
  return right.empty() ? "nameless" : right;
}

}  // namespace plumb::harness
