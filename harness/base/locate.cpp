#include "base/locate.hpp"

#include <algorithm>

namespace plumb::harness {
namespace {

/// Walks over valid JSON text by structure only.
class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text) {}

  [[nodiscard]] std::size_t at() const { return at_; }

  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r' || text_[at_] == '\n'))
      ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  void take() { ++at_; }

  std::string string() {
    const std::size_t begin = at_;
    skip_string();
    const auto parsed = nlohmann::json::parse(text_.substr(begin, at_ - begin), nullptr, false);
    return parsed.is_string() ? parsed.get<std::string>() : std::string();
  }

  void skip_value() {
    int depth = 0;
    do {
      const char c = peek();
      if (c == '\0') return;
      if (c == '"') {
        skip_string();
      } else if (c == '{' || c == '[') {
        ++depth;
        take();
      } else if (c == '}' || c == ']') {
        --depth;
        take();
      } else if (c == ',' || c == ':') {
        take();
      } else {
        while (at_ < text_.size() && std::string_view(" \t\r\n,:]}").find(text_[at_]) == std::string_view::npos) ++at_;
      }
    } while (depth > 0);
  }

 private:
  void skip_string() {
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
      if (text_[at_] == '\\') ++at_;
    ++at_;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

bool find(const nlohmann::json& here, const nlohmann::json* value, JsonPath& path) {
  if (&here == value) return true;
  if (here.is_object()) {
    for (const auto& [key, member] : here.items()) {
      path.emplace_back(key);
      if (find(member, value, path)) return true;
      path.pop_back();
    }
  } else if (here.is_array()) {
    for (std::size_t i = 0; i < here.size(); ++i) {
      path.emplace_back(i);
      if (find(here[i], value, path)) return true;
      path.pop_back();
    }
  }
  return false;
}

}  // namespace

JsonPath path_to(const nlohmann::json& root, const nlohmann::json* value) {
  JsonPath path;
  find(root, value, path);
  return path;
}

std::string text_of(const JsonPath& path) {
  std::string text;
  for (const auto& step : path) {
    if (const auto* index = std::get_if<std::size_t>(&step))
      text += "[" + std::to_string(*index) + "]";
    else
      text += (text.empty() ? "" : ".") + std::get<std::string>(step);
  }
  return text;
}

std::size_t line_of_byte(const std::string& text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

std::size_t line_of(const std::string& text, const JsonPath& path) {
  Scanner scanner(text);
  scanner.peek();
  std::size_t found = scanner.at();
  for (const auto& step : path) {
    const char open = scanner.peek();
    const bool member = std::holds_alternative<std::string>(step);
    if (open != (member ? '{' : '[')) break;
    scanner.take();
    bool descended = false;
    for (std::size_t i = 0; scanner.peek() != '}' && scanner.peek() != ']' && scanner.peek() != '\0'; ++i) {
      const std::size_t begin = scanner.at();
      bool wanted = false;
      if (member) {
        wanted = scanner.string() == std::get<std::string>(step);
        if (scanner.peek() == ':') scanner.take();
      } else {
        wanted = i == std::get<std::size_t>(step);
      }
      if (wanted) {
        found = begin;
        descended = true;
        break;
      }
      scanner.skip_value();
      if (scanner.peek() == ',') scanner.take();
    }
    if (!descended) break;
  }
  return line_of_byte(text, found);
}

}  // namespace plumb::harness
