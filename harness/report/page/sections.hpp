// The sections of the page, in its order, and what they share.
#pragma once

#include <string>
#include <vector>

#include "report/cost.hpp"
#include "report/curves.hpp"
#include "report/overview.hpp"
#include "report/page/page.hpp"
#include "report/study.hpp"

namespace plumb::harness {

/// --hue0 ... in the style; further backends use them again, with another marker.
inline constexpr std::size_t page_hues = 8;

/// What all sections draw on; lives as long as a page is written.
struct PageContext {
  const Study& study;
  const std::vector<CostLine>& costs;
  const std::vector<BackendOverview>& overviews;
  const CurveSet& curves;
  const PageOptions& options;

  [[nodiscard]] std::size_t backend_index(const std::string& backend) const;
  /// The colour of a method of `curves`. Backends have theirs before them, in whole rounds of hues and markers, so that
  /// backends with one method each look the same in both.
  [[nodiscard]] std::size_t method_index(std::size_t method) const;
};

[[nodiscard]] std::string head_section(const PageContext& context);
[[nodiscard]] std::string costs_section(const PageContext& context);
[[nodiscard]] std::string matrix_section(const PageContext& context);
[[nodiscard]] std::string precision_section(const PageContext& context);
/// "" where no knob was turned.
[[nodiscard]] std::string curves_section(const PageContext& context);
/// "" where nothing was recorded.
[[nodiscard]] std::string replays_section(const PageContext& context);
[[nodiscard]] std::string scaling_section(const PageContext& context);
[[nodiscard]] std::string times_section(const PageContext& context);
[[nodiscard]] std::string rows_section(const PageContext& context);

/// A figure as a link to the row that it comes from: <a href="#r12" title="...">text</a>. Text and title are escaped
/// here.
[[nodiscard]] std::string row_link(const ResultRow& row, std::string_view text, std::string_view title);
/// What a hover says of a row: its configuration, verdict, time, and each metric with value, truth, error, threshold.
[[nodiscard]] std::string row_hover(const PageContext& context, const ResultRow& row);
/// <th> with a problem's scene, variant and title.
[[nodiscard]] std::string problem_header(const PageContext& context, const Problem& problem);
/// The attribute by which the page's filter finds an element: data-k="...", lower case.
[[nodiscard]] std::string filter_key(const PageContext& context, const Problem& problem, std::string_view more = "");
/// The name of a backend with its marker.
[[nodiscard]] std::string backend_label(const PageContext& context, const std::string& backend);
/// The errors of the metric over the rows are 0 and 1 only, and there are some: a yes/no question, of which no diagram
/// can be drawn.
[[nodiscard]] bool is_yes_or_no(const std::vector<const ResultRow*>& rows, const std::string& metric);
/// A group's name as a heading: "Stacking"; "Other" for none.
[[nodiscard]] std::string group_title(const std::string& group);
[[nodiscard]] std::string verdict_title(Verdict verdict);  ///< "out of memory"
[[nodiscard]] std::string problem_title(const ResultRow& row);

}  // namespace plumb::harness
