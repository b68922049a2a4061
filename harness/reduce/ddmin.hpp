// The least part of a list that still fails: Zeller and Hildebrandt, "Simplifying and Isolating Failure-Inducing
// Input", IEEE Transactions on Software Engineering 28(2), 2002, algorithm ddmin.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace plumb::harness {

/// A part of `all`, in its order, that fails, and does not once any single one of it is left out. `all` fails. Where n
/// are left of N it asks about n log N times at best, and n^2 + 3 n times at worst.
template <class Thing>
[[nodiscard]] std::vector<Thing> ddmin(std::vector<Thing> all,
                                       const std::function<bool(const std::vector<Thing>&)>& fails) {
  std::size_t chunks = 2;
  if (!all.empty() && fails({})) return {};
  while (all.size() > 1) {
    chunks = std::min(chunks, all.size());
    bool is_less = false;
    for (std::size_t i = 0; i < chunks && !is_less; ++i) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(i * all.size() / chunks);
      const auto end = all.begin() + static_cast<std::ptrdiff_t>((i + 1) * all.size() / chunks);
      std::vector<Thing> rest(all.begin(), begin);
      rest.insert(rest.end(), end, all.end());
      if (!fails(rest)) continue;
      all = std::move(rest);
      chunks = std::max<std::size_t>(chunks - 1, 2);
      is_less = true;
    }
    if (is_less) continue;
    if (chunks == all.size()) break;
    chunks *= 2;
  }
  return all;
}

}  // namespace plumb::harness
