#include "report/text/text_table.hpp"

#include <algorithm>
#include <numeric>
#include <ostream>

#include "base/format.hpp"

namespace plumb::harness {
namespace {

constexpr std::size_t gap = 2;
constexpr std::size_t narrowest = 3;  ///< of a column: two letters and an ellipsis

}  // namespace

std::vector<std::size_t> TextTable::widths(std::size_t terminal_width) const {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    std::size_t width = text_width(columns_[c].header);
    for (const auto& row : rows_) width = std::max(width, text_width(row[c].text));
    widths.push_back(width);
  }
  if (terminal_width == 0) return widths;
  const std::size_t gaps = gap * (columns_.size() - 1);
  for (const bool soft_only : {true, false}) {
    while (std::accumulate(widths.begin(), widths.end(), gaps) > terminal_width) {
      std::size_t* widest = nullptr;
      for (std::size_t c = 0; c < widths.size(); ++c) {
        const bool may = widths[c] > narrowest && (columns_[c].soft || !soft_only);
        if (may && (!widest || widths[c] > *widest)) widest = &widths[c];
      }
      if (!widest) break;
      --*widest;
    }
  }
  return widths;
}

void TextTable::print(std::ostream& out, int terminal_width, bool colour) const {
  const std::vector<std::size_t> width = widths(static_cast<std::size_t>(std::max(terminal_width, 0)));
  const auto print_line = [&](const auto& cell_of) {
    std::size_t pending = 0;  // blanks are written only before something visible
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const TextCell cell = cell_of(c);
      const std::string text = clipped(cell.text, width[c]);
      const std::size_t free = width[c] - text_width(text);
      pending += columns_[c].right ? free : 0;
      if (!text.empty()) {
        out << std::string(pending, ' ');
        pending = 0;
        if (colour && *cell.colour) {
          out << "\x1b[" << cell.colour << 'm' << text << "\x1b[0m";
        } else {
          out << text;
        }
      }
      pending += (columns_[c].right ? 0 : free) + gap;
    }
    out << '\n';
  };
  print_line([&](std::size_t c) { return TextCell{columns_[c].header, "1"}; });
  for (const auto& row : rows_) print_line([&](std::size_t c) { return row[c]; });
}

}  // namespace plumb::harness
