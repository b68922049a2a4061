#include "scene/json_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <vector>

#include "base/locate.hpp"
#include "base/shown.hpp"
#include "scene/limits.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

namespace {

constexpr int deepest = 32;  ///< nesting of JSON that a file may have

/// Tells how far a parser has read, which it does not say itself where nothing is wrong with the JSON.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  std::size_t* read;

  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    ++at;
    ++*read;
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at == other.at; }
  bool operator!=(const CountingIterator& other) const { return at != other.at; }
};

}  // namespace

std::string read_json_text(const std::filesystem::path& path, const std::string& what) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("cannot read the {} file {}: {}", what, path.string(), why));
  };
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure)) refuse("it is a folder; name a file in it");
  if (!std::filesystem::exists(path, failure)) refuse("there is no such file");
  if (!std::filesystem::is_regular_file(path, failure)) refuse("it is no plain file");
  if (const auto bytes = std::filesystem::file_size(path, failure); bytes > most_bytes)
    refuse(fmt::format("its {} bytes are more than the most, {}", bytes, most_bytes));
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(std::strerror(errno));
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.empty()) refuse("it is empty");
  return text;
}

nlohmann::json parse_json(const std::filesystem::path& path, const std::string& text) {
  std::vector<std::set<std::string>> keys;
  std::size_t read = 0;
  const auto refuse = [&](std::size_t byte, const std::string& sentence) {
    throw UsageError(fmt::format("{}:{}: {}", path.string(), line_of_byte(text, byte), sentence));
  };
  const auto watch = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& value) {
    using Event = nlohmann::json::parse_event_t;
    if (depth > deepest) refuse(read, fmt::format("nested deeper than {}", deepest));
    if (event == Event::object_start) keys.emplace_back();
    if (event == Event::object_end) keys.pop_back();
    if (event == Event::key && !keys.back().insert(value.get<std::string>()).second)
      refuse(read, fmt::format("the key \"{}\" stands twice in one object; take one out",
                               shortened(value.get<std::string>())));
    return true;
  };
  const auto after_colon = [](const std::string& what) {
    const auto colon = what.find(": ");
    return shortened(colon == std::string::npos ? what : what.substr(colon + 2), 200);
  };
  try {
    return nlohmann::json::parse(CountingIterator{text.data(), &read},
                                 CountingIterator{text.data() + text.size(), &read}, watch);
  } catch (const nlohmann::json::parse_error& error) {
    refuse(error.byte > 0 ? error.byte - 1 : 0, "not valid JSON: " + after_colon(error.what()));
  } catch (const nlohmann::json::exception& error) {
    refuse(read, "not usable JSON: " + after_colon(error.what()));
  }
  return {};
}

}  // namespace plumb::harness
