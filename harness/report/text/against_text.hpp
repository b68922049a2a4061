// A comparison with a baseline, for terminals, Markdown and programs.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "report/ordered/against.hpp"
#include "report/ordered/ordered_rows.hpp"

namespace plumb::harness {

/// What was compared, and what was left out and why: sentences. `baseline` is its folder.
[[nodiscard]] std::vector<std::string> describe_comparison(const Comparison& comparison, const std::string& baseline,
                                                           const AgainstLimits& limits);

/// `before` and `after` are the rows that were compared: they name configurations.
void print_against(std::ostream& out, const Comparison& comparison, const OrderedRows& before, const OrderedRows& after,
                   const std::string& baseline, const AgainstLimits& limits, int terminal_width, bool colour);
void write_against_markdown(std::ostream& out, const Comparison& comparison, const OrderedRows& before,
                            const OrderedRows& after, const std::string& baseline, const AgainstLimits& limits);
/// One object: counts, limits, and the lists worse, better, changed, only_before, only_after.
[[nodiscard]] Json against_json(const Comparison& comparison, const std::string& baseline, const AgainstLimits& limits);

}  // namespace plumb::harness
