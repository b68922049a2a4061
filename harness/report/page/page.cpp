#include "report/page/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <ostream>
#include <set>

#include "report/page/assets.hpp"
#include "report/page/markup.hpp"
#include "report/page/packed.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

/// All that is told of one machine's rows. Sections point into it.
struct MachinePart {
  std::string name;
  Study study;
  std::vector<CostLine> costs;
  std::vector<BackendOverview> overviews;
  CurveSet curves;
  std::vector<Front> fronts;

  MachinePart(std::string machine, std::vector<ResultRow> rows)
      : name(std::move(machine)),
        study(std::move(rows)),
        costs(cost_of_accuracy(study)),
        overviews(harness::overviews(study, costs)),
        curves(study),
        fronts(pareto_fronts(study)) {}
};

/// Rows by the hardware they ran on, in order of appearance: times of different machines are never held against each
/// other. Indices count on over all of them.
std::vector<std::unique_ptr<MachinePart>> split_by_machine(const std::vector<Json>& lines) {
  std::vector<std::pair<std::string, std::vector<ResultRow>>> groups;
  for (const Json& line : lines) {
    ResultRow row = parse_row(line, 0);
    const std::string machine = hardware_of(row.machine);
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == machine; });
    if (group == groups.end()) {
      groups.push_back({machine, {}});
      group = groups.end() - 1;
    }
    group->second.push_back(std::move(row));
  }
  if (groups.empty()) groups.emplace_back();
  std::size_t index = 0;
  std::vector<std::unique_ptr<MachinePart>> parts;
  for (auto& [machine, rows] : groups) {
    for (ResultRow& row : rows) row.index = index++;
    parts.push_back(
        std::make_unique<MachinePart>(machine.empty() ? "a machine that is not named" : machine, std::move(rows)));
  }
  return parts;
}

std::vector<std::string> all_backends(const std::vector<std::unique_ptr<MachinePart>>& parts) {
  std::vector<std::string> names;
  for (const auto& part : parts) names.insert(names.end(), part->study.backends.begin(), part->study.backends.end());
  std::sort(names.begin(), names.end(), natural_less);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Each backend's colour and each method's, and the rule by which the backend's switch hides both everywhere.
std::string colour_style(const std::vector<PageContext>& contexts) {
  std::string out;
  const auto add = [&](std::size_t index, std::size_t hue, std::size_t backend) {
    out +=
        fmt::format(".e{0}{{--c:var(--hue{1})}}.hide{2} main .e{0}{{display:none}}", index, hue % page_hues, backend);
  };
  for (std::size_t i = 0; i < contexts.front().backends.size(); ++i) add(i, i, i);
  for (const PageContext& context : contexts) {
    if (context.curves.problems.empty()) continue;
    for (std::size_t i = 0; i < context.curves.methods.size(); ++i)
      add(context.method_index(i), context.first_method + i, context.backend_index(context.curves.methods[i].backend));
  }
  return out;
}

using Links = std::vector<std::pair<std::string, std::string>>;  ///< id and title of sections

/// Sections, machines, filter, groups, backends, theme: stays in view.
std::string toolbar(const std::vector<PageContext>& contexts, const Links& links) {
  std::string out = R"(<nav class="tools" aria-label="page"><div class="tools-in"><span class="links">)";
  for (const auto& [id, title] : links) out += fmt::format(R"(<a href="#{}">{}</a>)", id, title);
  out += R"(</span><span class="controls">)";
  if (contexts.size() > 1) {
    out += R"(<select id="machine" aria-label="machine">)";
    for (std::size_t i = 0; i < contexts.size(); ++i)
      out += fmt::format(R"(<option value="{}">{}</option>)", i, escape_html(contexts[i].machine));
    out += "</select>";
  }
  out += R"(<input id="filter" type="search" placeholder="filter: D1, stacking, failed" aria-label="filter">)";
  out += R"(<select id="group" aria-label="group"><option value="">all groups</option>)";
  std::set<std::string> groups;
  for (const PageContext& context : contexts) {
    for (const std::string& group : context.study.groups) {
      if (!group.empty() && groups.insert(group).second)
        out += fmt::format(R"(<option>{}</option>)", escape_html(group));
    }
  }
  out += R"(</select><span class="switches">)";
  for (std::size_t i = 0; i < contexts.front().backends.size(); ++i) {
    out += fmt::format(R"(<label class="switch e{0}"><input type="checkbox" data-backend="{0}" checked>{1}</label>)", i,
                       backend_label(contexts.front(), contexts.front().backends[i]));
  }
  return out + R"(</span><button type="button" id="theme" title="light or dark">theme</button></span></div></nav>)";
}

/// All sections of a machine; what is there is added to the links, once for all machines. What is said in words can be
/// read without the script; tables and diagrams are packed.
std::string machine_body(const PageContext& context, Links& links) {
  std::string body = head_section(context) + "\n";
  const auto add = [&](const char* id, const char* title, const std::string& section) {
    if (section.empty()) return;
    const bool known = std::any_of(links.begin(), links.end(), [&](const auto& link) { return link.first == id; });
    if (!known) links.emplace_back(id, title);
    body += section + "\n";
  };
  const auto add_packed = [&](const char* id, const char* title, const std::string& section) {
    add(id, title, section.empty() ? "" : packed_markup(section));
  };
  add("against", "Against", against_section(context));
  add_packed("cost", "Cost", costs_section(context));
  add("answers", "Answers", answers_section(context));
  add("engines", "Engines", engines_section(context));
  add_packed("precision", "Precision", precision_section(context));
  add_packed("fronts", "Fronts", fronts_section(context));
  add_packed("profiles", "Profiles", profiles_section(context));
  add_packed("matrix", "Matrix", matrix_section(context));
  add_packed("robust", "Robustness", robustness_section(context));
  add_packed("seeds", "Seeds", distributions_section(context));
  add_packed("curves", "Curves", curves_section(context));
  if (context.machine.empty()) add("replays", "Replays", replays_section(context.options));
  add_packed("scaling", "Scaling", scaling_section(context));
  add_packed("times", "Times", times_section(context));
  add_packed("needs", "Needs", needs_section(context));
  add_packed("runs", "Runs", rows_section(context));
  return fmt::format(R"(<div class="machine">{}</div>)", body);
}

}  // namespace

void write_page(std::ostream& out, const std::vector<Json>& rows, const PageOptions& options) {
  const std::vector<std::unique_ptr<MachinePart>> parts = split_by_machine(rows);
  const std::vector<std::string> backends = all_backends(parts);
  std::vector<PageContext> contexts;
  std::size_t methods = 0;
  for (const auto& part : parts) {
    PageContext context{part->study,  part->costs, part->overviews, part->curves,
                        part->fronts, options,     backends,        methods};
    if (parts.size() > 1) context.machine = part->name;
    if (!contexts.empty()) context.suffix = fmt::format("-{}", contexts.size());
    methods += part->curves.methods.size();
    contexts.push_back(std::move(context));
  }
  Links links;
  std::string body = machines_section(contexts);
  for (const PageContext& context : contexts) body += machine_body(context, links);
  if (const std::string replays = replays_section(options); contexts.size() > 1 && !replays.empty()) {
    links.emplace_back("replays", "Replays");
    body += replays;
  }
  out << "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width,initial-scale=1\">"
      << "<meta name=\"color-scheme\" content=\"light dark\"><title>Plumb report</title><style>" << page_style
      << colour_style(contexts)
      // Before anything is painted, so that a chosen theme does not flash.
      << "</style><script>" << page_theme_script << "</script></head><body>\n"
      << toolbar(contexts, links)
      << "<main><noscript><p class=\"about\">The tables and diagrams of this page are packed, and a script "
         "opens them.</p></noscript>"
      << body << "</main><script>" << page_script << "</script></body></html>\n";
}

}  // namespace plumb::harness
