// Results that were made before, as verbs that show them read them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/page/parts/page_options.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

/// The rows of a folder or file; what is wrong with some is said on standard error. Throws UsageError where there are
/// none at all.
[[nodiscard]] std::vector<Row> earlier_rows(const std::string& folder);

/// Titles of the scenes that are at hand: without them (results from elsewhere, a broken file, which is told) a page
/// shows ids alone.
[[nodiscard]] std::map<std::string, SceneText> scene_texts();

/// "2026-11-25 13:05 UTC": now, as a page says it.
[[nodiscard]] std::string date_of_page();

}  // namespace plumb::harness
