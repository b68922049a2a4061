// Performance profiles, group by group: who is cheapest how often, and who gets there at all.
#include "report/profile.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/plot.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

constexpr double smallest_error = 1e-8, largest_error = 10;

/// The staircase of a curve from x = `from` to `to`, where all curves end.
PlotSeries stairs(const PageContext& context, const ProfileCurve& curve, double from, double to) {
  PlotSeries series;
  series.colour = context.backend_index(curve.backend);
  series.stepped = true;
  series.quiet = true;
  series.hover = curve.backend;
  const auto add = [&](double x, double y) { series.points.push_back({x, y, {}, {}, false, {}, {}}); };
  add(from, curve.at(from));
  for (const ProfileStep& step : curve.steps) {
    if (step.x > from && step.x < to) add(step.x, step.share);
  }
  add(to, curve.at(to));
  return series;
}

double last_step(const Profile& profile) {
  double last = 0;
  for (const ProfileCurve& curve : profile.curves) {
    if (!curve.steps.empty()) last = std::max(last, curve.steps.back().x);
  }
  return last;
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string note(const Profile& profile) {
  return fmt::format(R"(<p class="frame-note">{} {}{}</p>)", profile.tests, profile.tests == 1 ? "test" : "tests",
                     profile.unsolved > 0 ? fmt::format(", {} of them solved by nobody", profile.unsolved) : "");
}

std::string figure(const Profile& profile, const Plot& plot, const std::string& title, const std::string& list) {
  return fmt::format(R"(<figure><figcaption>{}</figcaption>{}{}<ul class="frame-list">{}</ul></figure>)",
                     escape_html(title), render_plot(plot), note(profile), list);
}

std::string cost_figure(const PageContext& context, const std::string& group, std::size_t target) {
  const Profile profile = cost_profile(context.study, context.costs, group, target);
  const double end = std::max(2.0, 1.3 * last_step(profile));
  if (profile.tests == 0 || last_step(profile) == 0) return "";
  const std::string name = fmt::format("cost to reach {} %", limit_text(100 * target_errors[target]));
  Plot plot;
  plot.description = fmt::format("{}: performance profile, {}", group.empty() ? "all groups" : group, name);
  plot.x.title = "times the cost of the cheapest engine";
  plot.y = {"share of tests solved", false, 0.0, 1.0};
  std::string list;
  for (const ProfileCurve& curve : profile.curves) {
    plot.series.push_back(stairs(context, curve, 1, end));
    list += fmt::format(R"(<li class="e{}">{}: cheapest on {}, solves {}</li>)", context.backend_index(curve.backend),
                        backend_label(context, curve.backend), percent(curve.at(1)), percent(curve.reliability()));
  }
  return figure(profile, plot, name, list);
}

std::string error_figure(const PageContext& context, const std::string& group) {
  const Profile profile = error_profile(context.study, context.costs, group);
  if (profile.tests == 0 || last_step(profile) == 0) return "";
  Plot plot;
  plot.description = fmt::format("{}: share of tests by error at defaults", group.empty() ? "all groups" : group);
  plot.x.title = "error at the engine's defaults";
  plot.y = {"share of tests with no more error", false, 0.0, 1.0};
  std::string list;
  for (const ProfileCurve& curve : profile.curves) {
    plot.series.push_back(stairs(context, curve, smallest_error, largest_error));
    list += fmt::format(R"(<li class="e{}">{}: within 1 % on {}, within 0.1 % on {}</li>)",
                        context.backend_index(curve.backend), backend_label(context, curve.backend),
                        percent(curve.at(0.01)), percent(curve.at(0.001)));
  }
  return figure(profile, plot, "error at defaults", list);
}

std::string group_figures(const PageContext& context, const std::string& group) {
  std::string out;
  for (std::size_t t = 0; t < target_errors.size(); ++t) out += cost_figure(context, group, t);
  return out + error_figure(context, group);
}

}  // namespace

std::string profiles_section(const PageContext& context) {
  if (context.study.backends.size() < 2) return "";
  const std::string all = group_figures(context, "");
  if (all.empty()) return "";
  std::string out =
      section_start(context, "profiles", "Performance profiles") +
      R"(<p class="about">After Dolan and Mor&eacute;. A test is a )"
      R"(scene's metric that every engine of the diagram has a run of (one that ran less than half of them is left out); its cost for an engine is that of the cheapest )"
      R"(configuration that reaches the error (the <a href="#cost)" +
      context.suffix +
      R"(">table above</a>). A curve says on which share of the )"
      R"(tests the engine needs at most x times what the cheapest one needs. Read it at two places: its height at the )"
      R"(left edge is how often the engine is the cheapest, its height at the right edge how often it gets there at )"
      R"(all. Higher is better everywhere; between, a curve that rises early loses by little. The fourth diagram is of )"
      R"(errors at the engines' own settings, whatever they cost.</p>)";
  out += fmt::format(
      R"(<details class="group" open><summary>All groups</summary><div class="figures">{}</div></details>)", all);
  for (const std::string& group : context.study.groups) {
    const std::string figures = context.study.groups.size() > 1 ? group_figures(context, group) : "";
    if (figures.empty()) continue;
    out += fmt::format(R"(<details class="group"><summary>{}</summary><div class="figures">{}</div></details>)",
                       escape_html(group_title(group)), figures);
  }
  return out + "</section>";
}

}  // namespace plumb::harness
