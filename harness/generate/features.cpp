#include "generate/features.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/shown.hpp"
#include "base/usage_error.hpp"
#include "plumb/nearest.hpp"

namespace plumb::harness {

const std::vector<std::string>& feature_words() {
  static const std::vector<std::string> words{
      "joints", "loops", "limits", "friction", "motors", "springs", "generic", "hulls",      "compounds", "slender",
      "heap",   "load",  "bounce", "terrain",  "mover",  "belt",    "spin",    "gyroscopic", "sockets",   "targets"};
  return words;
}

Feature feature_of(const std::string& word) {
  const auto& words = feature_words();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
    throw UsageError(
        fmt::format("random scenes have no \"{}\"{}", shortened(word), suggestion(shortened(word), words)));
  return static_cast<Feature>(found - words.begin());
}

Features::Features(Chance chance, const std::vector<Feature>& without) {
  for (std::size_t i = 0; i < feature_count; ++i) {
    const bool drawn = chance.happens(0.5);  // of what is left out, too: the others do not change by it
    has_.push_back(drawn && std::find(without.begin(), without.end(), static_cast<Feature>(i)) == without.end());
  }
}

std::string Features::text() const {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < feature_count; ++i)
    if (has_[i]) words.push_back(feature_words()[i]);
  return words.empty() ? "nothing" : fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace plumb::harness
