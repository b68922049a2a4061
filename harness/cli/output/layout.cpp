#include "cli/output/layout.hpp"

#include <algorithm>
#include <sstream>

#include "cli/output/output.hpp"

namespace plumb::harness {

std::size_t text_width() {
  const int columns = terminal_width();
  return columns == 0 ? 100 : static_cast<std::size_t>(std::clamp(columns, 60, 120));
}

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width, std::size_t used) {
  std::string out = used == 0 ? std::string(indent, ' ') : "";
  std::size_t column = std::max(indent, used);
  bool at_start = true;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!at_start && column + 1 + word.size() > width) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
      at_start = true;
    }
    if (!at_start) {
      out += ' ';
      ++column;
    }
    out += word;
    column += word.size();
    at_start = false;
  }
  return out;
}

std::string entry(const std::string& name, const std::string& text, std::size_t name_width, std::size_t width) {
  constexpr std::size_t margin = 2, gap = 2;
  const std::size_t indent = margin + name_width + gap;
  std::string out = std::string(margin, ' ') + name;
  if (text.empty()) return out + "\n";
  if (name.size() > name_width) return out + "\n" + wrapped(text, indent, width) + "\n";
  out += std::string(indent - out.size(), ' ');
  return out + wrapped(text, indent, width, indent) + "\n";
}

}  // namespace plumb::harness
