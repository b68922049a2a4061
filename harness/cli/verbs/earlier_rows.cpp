#include "cli/verbs/earlier_rows.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>

#include "base/usage_error.hpp"
#include "rows/results_reader.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {

std::vector<Row> earlier_rows(const std::string& folder) {
  Results results = read_results(std::filesystem::path(folder));
  for (const std::size_t line : results.unreadable_lines) {
    fmt::print(stderr, "plumb: line {} of the results in {} is no JSON object and is left out\n", line, folder);
  }
  if (results.rows.empty())
    throw UsageError("there are no results in " + folder + "; make some with plumb run --out " + folder);
  return std::move(results.rows);
}

std::map<std::string, SceneText> scene_texts() {
  std::map<std::string, SceneText> texts;
  try {
    for (const SceneFile& file : all_scenes()) texts[file.id] = {file.title, file.doc};
  } catch (const UsageError& error) {
    fmt::print(stderr, "plumb: the page goes without the titles of scenes: {}\n", error.what());
  }
  return texts;
}

std::string date_of_page() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(now));
}

}  // namespace plumb::harness
