#include "base/shown.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::harness {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

std::string shortened(std::string_view text, std::size_t most) {
  std::size_t end = std::min(text.size(), most);
  // Not within a character of several bytes (UTF-8).
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  std::string shown;
  for (const char c : text.substr(0, end)) shown += is_control(c) ? fmt::format("\\x{:02x}", c) : std::string(1, c);
  return end == text.size() ? shown : fmt::format("{}... ({} bytes)", shown, text.size());
}

bool has_control_characters(std::string_view text) { return std::any_of(text.begin(), text.end(), is_control); }

}  // namespace plumb::harness
