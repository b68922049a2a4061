#include "rows/results_reader.hpp"

#include <fstream>
#include <istream>
#include <sstream>

#include "base/usage_error.hpp"
#include "rows/results_folder.hpp"

namespace plumb::harness {

void ResultsReader::read(std::istream& in, const std::filesystem::path& file) {
  Place start;
  read_lines(in, file, start);
}

void ResultsReader::read_on(const std::filesystem::path& file) {
  Place& place = read_[file];
  if (is_packed(file)) {
    if (place.lines != 0) return;
    std::istringstream text(unpacked_text(file));
    read_lines(text, file, place);
    return;
  }
  std::ifstream in(file, std::ios::binary);
  if (in && in.seekg(static_cast<std::streamoff>(place.bytes))) read_lines(in, file, place);
}

// The last line may be on its way. One without a newline gives its row when it is whole by itself, and is read again.
void ResultsReader::read_lines(std::istream& in, const std::filesystem::path& file, Place& place) {
  for (std::string line; std::getline(in, line);) {
    const bool torn = in.eof();
    take_line(line, file, place.lines + 1, torn);
    if (torn) return;
    place.bytes += line.size() + 1;
    ++place.lines;
  }
}

void ResultsReader::take_line(const std::string& line, const std::filesystem::path& file, std::size_t number,
                              bool torn) {
  if (line.find_first_not_of(" \t\r") == std::string::npos) return;
  std::optional<Row> row = read_row(line, file, number);
  if (!row) {
    if (!torn) results_.unreadable_lines.push_back(number);
    return;
  }
  const auto [at, is_new] = places_.try_emplace(row_key(*row), results_.rows.size());
  latest_[row->origin.cell] = at->second;
  row->origin.index = at->second;
  if (is_new) {
    results_.rows.push_back(std::move(*row));
  } else {
    results_.rows[at->second] = std::move(*row);
  }
}

const Row* ResultsReader::find(const std::string& cell_id) const {
  const auto found = latest_.find(cell_id);
  return found == latest_.end() ? nullptr : &results_.rows[found->second];
}

Results read_results(std::istream& in, const std::filesystem::path& file) {
  ResultsReader reader;
  reader.read(in, file);
  return reader.take();
}

Results read_results(const std::filesystem::path& where) {
  std::vector<std::filesystem::path> files{where};
  if (std::filesystem::is_directory(where)) files = results_files(where);
  if (files.empty()) files.push_back(where / "results.jsonl");  // which the message names
  ResultsReader reader;
  for (const std::filesystem::path& file : files) {
    if (!std::ifstream(file, std::ios::binary)) {
      throw UsageError("cannot read " + file.string() +
                       "; name a folder that `plumb run --out`, `plumb compare` or `plumb study` wrote");
    }
    reader.read_on(file);
  }
  return reader.take();
}

Json read_study(const std::filesystem::path& where) {
  std::ifstream in(where / "study.json", std::ios::binary);
  Json study = in ? Json::parse(in, nullptr, false) : Json();
  return study.is_object() ? study : Json();
}

}  // namespace plumb::harness
