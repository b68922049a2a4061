#include "report/results_file.hpp"

#include <fstream>
#include <istream>
#include <string>
#include <unordered_map>

#include "scene/scene.hpp"

namespace plumb::harness {
namespace {

/// What makes two rows the same cell: all that was asked for, and the machine that answered.
std::string cell_key(const Json& row) {
  Json key = Json::array();
  for (const char* name : {"scene", "params", "backend", "backend_version", "settings", "profile", "dt", "seconds",
                           "threads", "machine"}) {
    const auto found = row.find(name);
    key.push_back(found == row.end() ? Json() : *found);
  }
  return key.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Results read_results(std::istream& in) {
  Results results;
  std::unordered_map<std::string, std::size_t> cells;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const bool torn = in.eof();  // no newline ended it
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    Json row = Json::parse(line, nullptr, false);
    if (!row.is_object()) {
      if (!torn) results.unreadable_lines.push_back(number);
      continue;
    }
    const auto [cell, is_new] = cells.try_emplace(cell_key(row), results.rows.size());
    if (is_new) {
      results.rows.push_back(std::move(row));
    } else {
      results.rows[cell->second] = std::move(row);
    }
  }
  return results;
}

Results read_results(const std::filesystem::path& where) {
  const std::filesystem::path file = std::filesystem::is_directory(where) ? where / "results.jsonl" : where;
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw UsageError("cannot read " + file.string() +
                     "; name a folder that `plumb run --out` or `plumb compare` wrote");
  }
  return read_results(in);
}

}  // namespace plumb::harness
