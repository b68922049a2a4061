// What came of a cell, in one word.
#pragma once

#include <cstddef>
#include <string_view>

namespace plumb::harness {

/// Best first. `ran` is a cell without anything scored; after `unjudged`, of which the harness could not tell what
/// came, all are the engine's loss.
enum class Verdict { gold, pass, ran, failed, unsupported, unjudged, crashed, timeout, out_of_memory, error };
inline constexpr std::size_t verdict_count = 10;

/// The word for people and machines: "gold", "out_of_memory" ...
[[nodiscard]] std::string_view verdict_word(Verdict verdict);

/// It is no word on the engine's skill: it cannot run the scene, or nobody could tell what came of it.
[[nodiscard]] constexpr bool says_nothing(Verdict verdict) {
  return verdict == Verdict::unsupported || verdict == Verdict::unjudged;
}

}  // namespace plumb::harness
