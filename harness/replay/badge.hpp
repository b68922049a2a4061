// What a replay says of its run: the verdict of the tables, and the measure that decided it, in words.
#pragma once

#include "base/json.hpp"

namespace plumb::harness {

/// {"verdict": "gold" and so on (rows/row.hpp), "words"} of how a recording ended: of what failed each measure
/// that missed, of what passed the one nearest to its limit. Null where a run ended well and its measures were not
/// kept, as by older programs, or were none, as of pairs of shapes.
[[nodiscard]] Json badge_of(const Json& outcome);

}  // namespace plumb::harness
