// Columns of numbers beside the poses as a bundle keeps them: each as the difference from the number that was in its
// place before, so that what stays costs next to nothing.
#pragma once

#include <optional>

#include "replay/container.hpp"

namespace plumb::harness {

/// How exact a column is kept: in whole steps where `step` is above 0, else in so many bits of mantissa.
struct Exactness {
  double step = 0;
  int mantissa_bits = 23;
  float least = 0;  ///< what is smaller is 0
};

/// What was in a row's place before it: the row so many earlier, or -1 for none.
using Before = std::vector<std::int64_t>;
[[nodiscard]] Before rows_earlier(std::size_t rows, std::size_t distance);

/// `bytes` are numbers of the type ("f32", "u32", "i32", "u8"), `width` to a row. Whole numbers come back as they were;
/// of floats those that change by no more than a step (of the number, or of its last bit of mantissa) stay as they
/// were.
///
/// Section of the type and shape, coding {"kind": "differences", "planes", "before"} and "step" or "bits": for each of
/// the width columns the numbers of all rows minus those before (wrapping at 2^32), as planes; a float is number *
/// step, or, sign apart, number << (23 - bits) as its bits. `before_words` says in the header what `before` is.
[[nodiscard]] BundleSection coded_column(const std::string& type, std::vector<std::size_t> shape,
                                         const std::string& bytes, std::size_t width, const Before& before,
                                         const Json& before_words, const Exactness& exactness);

/// A list of rows by frame, put in order within each frame by its keys (integer columns), and which row of the frame
/// before has the same keys: the n-th of equal ones is matched with the n-th.
struct MatchedRows {
  std::vector<std::size_t> order;  ///< new row: old row
  Before before;                   ///< of the new rows
};
[[nodiscard]] MatchedRows match_rows(const std::vector<std::uint32_t>& start,
                                     const std::vector<std::vector<std::uint32_t>>& keys,
                                     const std::vector<std::uint32_t>& last_key);

}  // namespace plumb::harness
