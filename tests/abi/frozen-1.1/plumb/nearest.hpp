// The nearest right word to a misspelt one, for error messages of hosts and backends.
#pragma once

#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn a into b, letter case aside (optimal
/// string alignment: Damerau 1964 without editing a swapped pair again).
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t fewest = last[j - 1] + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      if (last[j] + 1 < fewest) fewest = last[j] + 1;
      if (row[j - 1] + 1 < fewest) fewest = row[j - 1] + 1;
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped && before[j - 2] + 1 < fewest) fewest = before[j - 2] + 1;
      row[j] = fewest;
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

/// The known word with the smallest edit distance, of several the one that begins most alike; "" when none is close
/// enough to be meant.
[[nodiscard]] inline std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_prefix = 0;
  std::size_t best_distance = (word.size() / 3 > 2 ? word.size() / 3 : 2) + 1;
  for (const std::string& candidate : known) {
    const bool begins = word.size() >= 3 && candidate.starts_with(word);
    const std::size_t distance = begins ? 1 : edit_distance(word, candidate);
    if (distance >= word.size() && distance >= candidate.size()) continue;  // not one letter in common
    std::size_t prefix = 0;
    while (prefix < word.size() && prefix < candidate.size() && word[prefix] == candidate[prefix]) ++prefix;
    if (distance < best_distance || (distance == best_distance && !best.empty() && prefix > best_prefix)) {
      best_distance = distance;
      best_prefix = prefix;
      best = candidate;
    }
  }
  return best;
}

/// Ends an error message: `; did you mean "x"?`, or `; known are a, b, c` when nothing is near, or "" without any.
[[nodiscard]] inline std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  if (const std::string best = nearest(word, known); !best.empty()) return "; did you mean \"" + best + "\"?";
  constexpr std::size_t most = 12;
  std::string text;
  for (std::size_t i = 0; i < most && i < known.size(); ++i) text += (i == 0 ? "; known are " : ", ") + known[i];
  return known.size() > most ? text + ", ..." : text;
}

}  // namespace plumb
