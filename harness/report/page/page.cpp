#include "report/page/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <ostream>
#include <set>

#include "base/format.hpp"
#include "report/ordered/machine_rows.hpp"
#include "report/page/parts/assets.hpp"
#include "report/page/parts/bundled_scripts.hpp"
#include "report/page/parts/looks.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/parts/packed.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

/// All that is told of one machine's rows. Sections point into it.
struct MachinePart {
  std::string name;
  OrderedRows ordered;
  std::vector<CostLine> costs;
  std::vector<BackendOverview> overviews;
  CurveSet curves;
  std::vector<Front> fronts;

  MachinePart(std::string machine, std::vector<Row> rows)
      : name(std::move(machine)),
        ordered(std::move(rows)),
        costs(cost_of_accuracy(ordered)),
        overviews(harness::overviews(ordered, costs)),
        curves(ordered),
        fronts(pareto_fronts(ordered)) {}
};

std::vector<std::unique_ptr<MachinePart>> split_by_machine(const std::vector<Row>& rows) {
  std::vector<std::unique_ptr<MachinePart>> parts;
  for (MachineRows& machine : rows_by_machine(rows))
    parts.push_back(std::make_unique<MachinePart>(std::move(machine.name), std::move(machine.rows)));
  return parts;
}

std::vector<std::string> all_backends(const std::vector<std::unique_ptr<MachinePart>>& parts) {
  std::vector<std::string> names;
  for (const auto& part : parts)
    names.insert(names.end(), part->ordered.backends.begin(), part->ordered.backends.end());
  std::sort(names.begin(), names.end(), natural_less);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Each backend's colour and marker, and the rule by which its switch hides what is said of it.
std::string colour_style(const std::vector<std::string>& backends) {
  std::string out;
  for (std::size_t i = 0; i < backends.size(); ++i) {
    const EngineLook look = look_of(backends[i]);
    out += fmt::format(".e{0}{{--c:var(--hue{1});--m:var(--mark{2})}}.hide{0} main .of{0}{{display:none}}", i,
                       look.colour(), look.shade);
  }
  return out;
}

using Links = std::vector<std::pair<std::string, std::string>>;  ///< id and title of sections

std::string group_options(const std::vector<PageContext>& contexts) {
  std::string out = R"(<option value="">all groups</option>)";
  std::set<std::string> groups;
  for (const PageContext& context : contexts) {
    for (const std::string& group : context.ordered.groups) {
      if (!group.empty() && groups.insert(group).second) out += fmt::format("<option>{}</option>", escape_html(group));
    }
  }
  return out;
}

std::string result_options() {
  std::string out = R"(<option value="">all results</option>)";
  for (std::size_t v = 0; v < verdict_count; ++v)
    out += fmt::format("<option>{}</option>", verdict_title(static_cast<Verdict>(v)));
  return out;
}

std::string engine_switches(const PageContext& context) {
  std::string out;
  for (std::size_t i = 0; i < context.backends.size(); ++i) {
    const EngineLook look = look_of(context.backends[i]);
    out += fmt::format(
        R"(<label class="switch e{0}"><input type="checkbox" data-backend="{0}" data-hue="{1}" data-shade="{2}" data-colour="{5}" )"
        R"(value="{3}" checked>{4}</label>)",
        i, look.hue, look.shade, escape_html(context.backends[i]), backend_label(context, context.backends[i]),
        look.colour());
  }
  return out;
}

/// Sections, machines, filter, theme: stays in view.
std::string toolbar(const std::vector<PageContext>& contexts, const Links& links) {
  std::string out = R"(<nav class="tools" aria-label="page"><div class="tools-in"><span class="links">)";
  for (const auto& [id, title] : links) out += fmt::format(R"(<a href="#{}">{}</a>)", id, title);
  out += R"(</span><span class="controls" hidden>)";
  if (contexts.size() > 1) {
    out += R"(<select id="machine" aria-label="machine">)";
    for (std::size_t i = 0; i < contexts.size(); ++i)
      out += fmt::format(R"(<option value="{}">{}</option>)", i, escape_html(contexts[i].machine));
    out += "</select>";
  }
  return out +
         fmt::format(R"(<details class="filter"><summary>Filter</summary><div class="filter-in">)"
                     R"(<input id="filter" type="search" placeholder="D1, tower, gold" aria-label="words">)"
                     R"(<select id="group" aria-label="group">{}</select>)"
                     R"(<select id="result" aria-label="result">{}</select><span class="switches">{}</span>)"
                     R"(<button type="button" id="clear">Show all</button></div></details>)"
                     R"(<button type="button" id="theme" title="light or dark">Theme</button></span></div></nav>)",
                     group_options(contexts), result_options(), engine_switches(contexts.front()));
}

std::string section_html(const PageContext& context, const PageSection& section) {
  const std::string of = context.machine.empty() ? "" : fmt::format(" <small>{}</small>", escape_html(context.machine));
  return fmt::format(
      R"(<section id="{0}{1}"><details class="fold" open><summary><h2>{2}{3}</h2></summary>{4}{5}</details></section>)"
      "\n",
      section.id, context.suffix, section.title, of, section.words, packed_blocks(section.blocks));
}

/// All sections of a machine; what is there is added to the links, once for all machines.
std::string machine_body(const PageContext& context, Links& links) {
  const auto link = [&](const std::string& id, const char* title) {
    const bool known = std::any_of(links.begin(), links.end(), [&](const auto& other) { return other.first == id; });
    if (!known) links.emplace_back(id, title);
  };
  std::string body = head_section(context) + first_screen(context) + "\n";
  link("answers", "Answers");
  const auto add = [&](const char* title, const PageSection& section) {
    if (section.empty()) return;
    link(section.id, title);
    body += section_html(context, section);
  };
  add("Against", against_section(context));
  add("Scorecard", scorecard_section(context));
  add("Engines", engines_section(context));
  add("Cost", costs_section(context));
  add("Precision", precision_section(context));
  add("Fronts", fronts_section(context));
  add("Profiles", profiles_section(context));
  add("Matrix", matrix_section(context));
  add("Robustness", robustness_section(context));
  add("Seeds", distributions_section(context));
  add("Curves", curves_section(context));
  add("Scaling", scaling_section(context));
  add("Times", times_section(context));
  add("Needs", needs_section(context));
  add("Runs", rows_section(context));
  return fmt::format(R"(<div class="machine">{}</div>)", body);
}

constexpr std::string_view without_script =
    "This program was built without node and npm, whose libraries draw the tables and diagrams: what can be said in "
    "words stands here. plumb report prints tables in a terminal, and with --csv or --md elsewhere.";

}  // namespace

void write_page(std::ostream& out, const std::vector<Row>& rows, const PageOptions& options) {
  const std::vector<std::unique_ptr<MachinePart>> parts = split_by_machine(rows);
  const std::vector<std::string> backends = all_backends(parts);
  std::vector<PageContext> contexts;
  for (const auto& part : parts) {
    PageContext context{part->ordered, part->costs, part->overviews, part->curves, part->fronts, options, backends};
    if (parts.size() > 1) context.machine = part->name;
    if (!contexts.empty()) context.suffix = fmt::format("-{}", contexts.size());
    contexts.push_back(std::move(context));
  }
  Links links;
  std::string body;
  for (const PageContext& context : contexts) body += machine_body(context, links);
  if (const PageSection machines = machines_section(contexts); !machines.empty()) {
    links.emplace_back(machines.id, "Machines");
    PageContext all = contexts.front();
    all.machine.clear();
    body += section_html(all, machines);
  }
  out << "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width,initial-scale=1\">"
      // Nothing is asked of a network, and the browser sees to it.
      << "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'"
      << (options.worlds.list.empty() ? "" : " 'wasm-unsafe-eval'")
      << "; style-src 'unsafe-inline'; img-src data: blob:\">"
      << "<meta name=\"color-scheme\" content=\"light dark\"><title>Plumb report</title><style>" << page_style
      << colour_style(backends)
      // Before anything is painted, so that a chosen theme does not flash.
      << "</style><script>" << page_theme_script << "</script></head><body>\n"
      << toolbar(contexts, links) << "<main>"
      << (has_page_script() ? "<noscript>" + about("Tables and diagrams are drawn by a script.") + "</noscript>"
                            : about(without_script))
      << body << replays_place(options) << "</main><script>" << page_script << "</script></body></html>\n";
}

}  // namespace plumb::harness
