#include "report/page/page.hpp"

#include <fmt/format.h>

#include <ostream>

#include "report/page/assets.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

/// Each backend's colour and each method's, and the rule by which the backend's switch hides both everywhere.
std::string colour_style(const PageContext& context) {
  std::string out;
  const auto add = [&](std::size_t index, std::size_t hue, std::size_t backend) {
    out +=
        fmt::format(".e{0}{{--c:var(--hue{1})}}.hide{2} main .e{0}{{display:none}}", index, hue % page_hues, backend);
  };
  for (std::size_t i = 0; i < context.study.backends.size(); ++i) add(i, i, i);
  if (context.curves.problems.empty()) return out;
  for (std::size_t i = 0; i < context.curves.methods.size(); ++i)
    add(context.method_index(i), i, context.backend_index(context.curves.methods[i].backend));
  return out;
}

/// Sections, filter, groups, backends, theme: stays in view.
std::string toolbar(const PageContext& context) {
  std::string out =
      R"(<nav class="tools" aria-label="page"><div class="tools-in"><span class="links"><a href="#cost">Cost</a><a )"
      R"(href="#matrix">Matrix</a>)"
      R"(<a href="#precision">Precision</a>)";
  if (!context.curves.problems.empty()) out += R"(<a href="#curves">Curves</a>)";
  if (!context.options.replays.empty()) out += R"(<a href="#replays">Replays</a>)";
  out += R"(<a href="#scaling">Scaling</a><a href="#times">Times</a><a href="#runs">Runs</a></span>)"
         R"(<span class="controls"><input id="filter" type="search" placeholder="filter: D1, stacking, failed" )"
         R"(aria-label="filter">)";
  out += R"(<select id="group" aria-label="group"><option value="">all groups</option>)";
  for (const std::string& group : context.study.groups) {
    if (!group.empty()) out += fmt::format(R"(<option>{}</option>)", escape_html(group));
  }
  out += R"(</select><span class="switches">)";
  for (std::size_t i = 0; i < context.study.backends.size(); ++i) {
    out += fmt::format(R"(<label class="switch e{0}"><input type="checkbox" data-backend="{0}" checked>{1}</label>)", i,
                       backend_label(context, context.study.backends[i]));
  }
  return out + R"(</span><button type="button" id="theme" title="light or dark">theme</button></span></div></nav>)";
}

}  // namespace

void write_page(std::ostream& out, const std::vector<Json>& rows, const PageOptions& options) {
  const Study study(parse_rows(rows));
  const std::vector<CostLine> costs = cost_of_accuracy(study);
  const std::vector<BackendOverview> all = overviews(study, costs);
  const CurveSet curves(study);
  const PageContext context{study, costs, all, curves, options};
  out << "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width,initial-scale=1\">"
      << "<meta name=\"color-scheme\" content=\"light dark\"><title>Plumb report</title><style>" << page_style
      << colour_style(context)
      // Before anything is painted, so that a chosen theme does not flash.
      << "</style><script>" << page_theme_script << "</script></head><body>\n"
      << toolbar(context) << "<main>" << head_section(context) << '\n'
      << costs_section(context) << '\n'
      << matrix_section(context) << '\n'
      << precision_section(context) << '\n'
      << curves_section(context) << '\n'
      << replays_section(context) << '\n'
      << scaling_section(context) << '\n'
      << times_section(context) << '\n'
      << rows_section(context) << "</main><script>" << page_script << "</script></body></html>\n";
}

}  // namespace plumb::harness
