#include "rows/results_file.hpp"

#include <algorithm>
#include <fstream>
#include <istream>
#include <sstream>
#include <string>
#include <unordered_map>

#include "base/usage_error.hpp"
#include "rows/results_folder.hpp"
#include "rows/row_format.hpp"

namespace plumb::harness {
namespace {

/// What makes two rows the same cell: the runner's id of it, and the machine that answered, whenever that was.
std::string cell_key(const Json& row) {
  Json machine = row.value("machine", Json());
  if (machine.is_object()) machine.erase("date");
  return line_of({machine, row["cell"]});
}

using Cells = std::unordered_map<std::string, std::size_t>;  ///< places of rows, by their keys

void read_into(std::istream& in, const std::filesystem::path& file, Results& results, Cells& cells) {
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const bool torn = in.eof();  // no newline ended it
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    Json row = read_row(line, file, number);
    if (row.is_null()) {
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
}

}  // namespace

Results read_results(std::istream& in, const std::filesystem::path& file) {
  Results results;
  Cells cells;
  read_into(in, file, results, cells);
  return results;
}

Results read_results(const std::filesystem::path& where) {
  Results results;
  Cells cells;
  std::vector<std::filesystem::path> files{where};
  if (std::filesystem::is_directory(where)) files = results_files(where);
  if (files.empty()) files.push_back(where / "results.jsonl");  // which the message names
  for (const std::filesystem::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    if (!in) {
      throw UsageError("cannot read " + file.string() +
                       "; name a folder that `plumb run --out`, `plumb compare` or `plumb study` wrote");
    }
    if (is_packed(file)) {
      std::istringstream text(unpacked_text(file));
      read_into(text, file, results, cells);
    } else {
      read_into(in, file, results, cells);
    }
  }
  return results;
}

Json read_study(const std::filesystem::path& where) {
  std::ifstream in(where / "study.json", std::ios::binary);
  Json study = in ? Json::parse(in, nullptr, false) : Json();
  return study.is_object() ? study : Json();
}

}  // namespace plumb::harness
