// A table of text that fits into a terminal: columns shrink to the width, cells may have a colour.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace plumb::harness {

struct TextCell {
  std::string text;         ///< UTF-8, no control characters
  const char* colour = "";  ///< the parameters of an ANSI colour sequence ("31"), "" for none
};

struct TextColumn {
  std::string header;
  bool right = false;  ///< aligned to the right, as numbers are
  bool soft = false;   ///< shrinks before others do
};

class TextTable {
 public:
  explicit TextTable(std::vector<TextColumn> columns) : columns_(std::move(columns)) {}
  /// As many cells as columns.
  void add(std::vector<TextCell> cells) { rows_.push_back(std::move(cells)); }
  /// terminal_width 0: as wide as need be. Two blanks between columns, none at the ends of lines.
  void print(std::ostream& out, int terminal_width, bool colour) const;

 private:
  [[nodiscard]] std::vector<std::size_t> widths(std::size_t terminal_width) const;

  std::vector<TextColumn> columns_;
  std::vector<std::vector<TextCell>> rows_;
};

}  // namespace plumb::harness
