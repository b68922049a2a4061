// The sections of the page, in its order, and what they share.
#pragma once

#include <string>
#include <vector>

#include "report/cost.hpp"
#include "report/curves.hpp"
#include "report/front.hpp"
#include "report/overview.hpp"
#include "report/page/page.hpp"
#include "report/sample.hpp"
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
  const std::vector<Front>& fronts;
  const PageOptions& options;
  const std::vector<std::string>& backends;  ///< of all machines: those of `study` among them
  std::size_t first_method = 0;              ///< methods of machines before this one
  std::string machine = {};  ///< its name, where the page has several: no figure shows runs of two of them
  std::string suffix = {};   ///< of the sections' ids; "" for the first machine

  [[nodiscard]] std::size_t backend_index(const std::string& backend) const;
  /// The colour of a method of `curves`. Backends have theirs before them, in whole rounds of hues and markers, so that
  /// backends with one method each look the same in both.
  [[nodiscard]] std::size_t method_index(std::size_t method) const;
};

[[nodiscard]] std::string head_section(const PageContext& context);
/// A card an engine: verdicts, where it is best, where it breaks. "" without rows.
[[nodiscard]] std::string engines_section(const PageContext& context);
/// Near the top: what people ask first. "" where nothing can be answered.
[[nodiscard]] std::string answers_section(const PageContext& context);
/// "" without a baseline.
[[nodiscard]] std::string against_section(const PageContext& context);
[[nodiscard]] std::string costs_section(const PageContext& context);
/// Which configurations no other one beats, and which are beaten by whom.
[[nodiscard]] std::string fronts_section(const PageContext& context);
/// Dolan-More profiles.
[[nodiscard]] std::string profiles_section(const PageContext& context);
[[nodiscard]] std::string matrix_section(const PageContext& context);
[[nodiscard]] std::string precision_section(const PageContext& context);
/// "" where no knob was turned.
[[nodiscard]] std::string curves_section(const PageContext& context);
/// "" where nothing was recorded.
[[nodiscard]] std::string replays_section(const PageOptions& options);
[[nodiscard]] std::string scaling_section(const PageContext& context);
[[nodiscard]] std::string times_section(const PageContext& context);
/// "" where no measure without a truth was made in two scenes.
[[nodiscard]] std::string robustness_section(const PageContext& context);
/// "" where no scene was run with several seeds.
[[nodiscard]] std::string distributions_section(const PageContext& context);
/// "" where no cells differ in their needs only.
[[nodiscard]] std::string needs_section(const PageContext& context);
/// Times and errors of machines beside each other, for what ran on at least two; "" for one machine.
[[nodiscard]] std::string machines_section(const std::vector<PageContext>& machines);
[[nodiscard]] std::string rows_section(const PageContext& context);

/// <section id="..."> and its heading. The title is HTML.
[[nodiscard]] std::string section_start(const PageContext& context, std::string_view id, std::string_view title);
/// A figure as a link to the row that it comes from: <a href="#r12" title="...">text</a>. Text and title are escaped
/// here.
[[nodiscard]] std::string row_link(const ResultRow& row, std::string_view text, std::string_view title);
/// What a hover says of a row: its configuration, verdict, time, and each metric with value, truth, error, threshold.
[[nodiscard]] std::string row_hover(const PageContext& context, const ResultRow& row);
/// <th> with a problem's scene, variant and title.
[[nodiscard]] std::string problem_header(const PageContext& context, const Problem& problem);
/// The attribute by which the page's filter finds an element: data-k="...", lower case.
[[nodiscard]] std::string filter_key(const PageContext& context, const Problem& problem, std::string_view more = "");
/// Below a figure: the runs that it shows, and what makes them again. `filter` finds them among all.
[[nodiscard]] std::string figure_foot(const PageContext& context, const std::vector<const ResultRow*>& rows,
                                      std::string_view filter);
/// The name of a backend with its marker.
[[nodiscard]] std::string backend_label(const PageContext& context, const std::string& backend);
/// A group's name as a heading: "Stacking"; "Other" for none.
[[nodiscard]] std::string group_title(const std::string& group);
[[nodiscard]] std::string verdict_title(Verdict verdict);  ///< "out of memory"
[[nodiscard]] std::string lower(std::string text);         ///< ASCII letters
[[nodiscard]] std::string problem_title(const ResultRow& row);

}  // namespace plumb::harness
