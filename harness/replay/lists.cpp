#include "replay/lists.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "replay/planes.hpp"

namespace plumb::harness {

namespace {

constexpr double largest_number = 1 << 30;

template <class Number>
Number at(const std::string& bytes, std::size_t index) {
  Number number;
  std::memcpy(&number, bytes.data() + index * sizeof number, sizeof number);
  return number;
}

/// The whole number that stands for an entry, and whether one nearby would do as well.
struct Entry {
  std::int32_t number;
  bool is_float;
};

Entry entry_of(const std::string& type, const std::string& bytes, std::size_t index, const Exactness& exactness) {
  if (type == "u8") return {at<std::uint8_t>(bytes, index), false};
  if (type != "f32") return {at<std::int32_t>(bytes, index), false};
  const auto value = at<float>(bytes, index);
  if (!(exactness.step > 0)) return {rounded_float(value, exactness.mantissa_bits, exactness.least), true};
  const double steps = static_cast<double>(value) / exactness.step;
  return {
      static_cast<std::int32_t>(std::round(std::clamp(std::isnan(steps) ? 0 : steps, -largest_number, largest_number))),
      true};
}

std::int32_t difference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

}  // namespace

Before rows_earlier(std::size_t rows, std::size_t distance) {
  Before before(rows, -1);
  for (std::size_t row = distance; row < rows; ++row) before[row] = static_cast<std::int64_t>(row - distance);
  return before;
}

BundleSection coded_column(const std::string& type, std::vector<std::size_t> shape, const std::string& bytes,
                           std::size_t width, const Before& before, const Json& before_words,
                           const Exactness& exactness) {
  const bool is_lossless = !(exactness.step > 0) && exactness.mantissa_bits == 23;
  std::vector<std::int32_t> all;
  for (std::size_t column = 0; column < width; ++column) {
    std::vector<std::int32_t> numbers;
    for (std::size_t row = 0; row < before.size(); ++row) {
      const auto [number, is_float] = entry_of(type, bytes, row * width + column, exactness);
      const std::int32_t old = before[row] < 0 ? 0 : numbers[static_cast<std::size_t>(before[row])];
      const bool stands = is_float && !is_lossless && before[row] >= 0 && (old == 0) == (number == 0) &&
                          std::abs(static_cast<std::int64_t>(number) - old) <= 1;
      numbers.push_back(stands ? old : number);
      all.push_back(difference(numbers.back(), old));
    }
  }
  const Planes planes = planes_of(all);
  BundleSection section{type,
                        std::move(shape),
                        planes.bytes,
                        {{"kind", "differences"}, {"planes", planes.count}, {"before", before_words}}};
  if (type == "f32" && exactness.step > 0) section.coding["step"] = exactness.step;
  if (type == "f32" && !(exactness.step > 0)) section.coding["bits"] = exactness.mantissa_bits;
  return section;
}

MatchedRows match_rows(const std::vector<std::uint32_t>& start, const std::vector<std::vector<std::uint32_t>>& keys,
                       const std::vector<std::uint32_t>& last_key) {
  MatchedRows matched;
  matched.order.resize(start.empty() ? 0 : start.back());
  std::iota(matched.order.begin(), matched.order.end(), std::size_t{0});
  matched.before.assign(matched.order.size(), -1);
  const auto compare = [&](std::size_t a, std::size_t b) {
    for (const std::vector<std::uint32_t>& key : keys)
      if (key[a] != key[b]) return key[a] < key[b] ? -1 : 1;
    return 0;
  };
  for (std::size_t f = 0; f + 1 < start.size(); ++f) {
    std::stable_sort(matched.order.begin() + start[f], matched.order.begin() + start[f + 1],
                     [&](std::size_t a, std::size_t b) {
                       const int order = compare(a, b);
                       return order != 0 ? order < 0 : !last_key.empty() && last_key[a] < last_key[b];
                     });
    if (f == 0) continue;
    std::size_t old = start[f - 1];
    for (std::size_t row = start[f]; row < start[f + 1]; ++row) {
      while (old < start[f] && compare(matched.order[old], matched.order[row]) < 0) ++old;
      if (old < start[f] && compare(matched.order[old], matched.order[row]) == 0)
        matched.before[row] = static_cast<std::int64_t>(old++);
    }
  }
  return matched;
}

}  // namespace plumb::harness
