// Performance profiles, group by group: who is cheapest how often, and who gets there at all.
#include "report/findings/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/format.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

constexpr double smallest_error = 1e-8;

/// The staircase of a curve from x = `from` to `to`, where all curves end.
PlotSeries stairs(const PageContext& context, const ProfileCurve& curve, double from, double to) {
  PlotSeries series{curve.backend, context.backend_index(curve.backend)};
  series.stepped = true;
  series.quiet = true;
  series.points.push_back({from, curve.at(from)});
  for (const ProfileStep& step : curve.steps) {
    if (step.x > from && step.x < to) series.points.push_back({step.x, step.share});
  }
  series.points.push_back({to, curve.at(to)});
  return series;
}

/// The largest x that is known.
double last_step(const Profile& profile) {
  double last = 0;
  for (const ProfileCurve& curve : profile.curves) {
    for (const ProfileStep& step : curve.steps) {
      if (std::isfinite(step.x)) last = std::max(last, step.x);
    }
  }
  return last;
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string note(const Profile& profile) {
  std::string out = fmt::format("{} {}", profile.tests, profile.tests == 1 ? "test" : "tests");
  if (profile.unsolved > 0) out += fmt::format(", {} of them solved by nobody", profile.unsolved);
  if (profile.unpriced > 0)
    out += fmt::format(", {} at costs that no fair time tells: they count at the right edge alone", profile.unpriced);
  return fmt::format(R"(<p class="frame-note">{}</p>)", out);
}

/// words: what is said of each curve. null where there is nothing to draw.
template <typename Words>
Json profile_figure(const PageContext& context, const Profile& profile, const std::string& title, Plot plot,
                    double from, double to, const Words& words) {
  if (profile.tests == 0 || last_step(profile) == 0) return nullptr;
  std::string list;
  for (const ProfileCurve& curve : profile.curves) {
    plot.series.push_back(stairs(context, curve, from, to));
    if (profile.unpriced > 0) plot.series.back().points.push_back({to, curve.reliability()});
    list += fmt::format("<li>{}: {}</li>", backend_label(context, curve.backend), words(curve));
  }
  FigureData figure;
  figure.title = title;
  figure.legend = false;
  figure.plots = {std::move(plot)};
  figure.notes = note(profile) + fmt::format(R"(<ul class="frame-list">{}</ul>)", list);
  return figure_data(figure);
}

Json cost_figure(const PageContext& context, const std::string& group, std::size_t target) {
  const Profile profile = cost_profile(context.ordered, context.costs, group, target);
  const std::string name = fmt::format("cost to reach {} %", limit_text(100 * target_errors[target]));
  Plot plot;
  plot.description = fmt::format("{}: performance profile, {}", group.empty() ? "all groups" : group, name);
  plot.x.title = "times the cost of the cheapest engine";
  plot.y = {"share of tests solved", false, 0.0, 1.0};
  return profile_figure(context, profile, name, std::move(plot), 1, std::max(2.0, 1.3 * last_step(profile)),
                        [&](const ProfileCurve& curve) {
                          return fmt::format("cheapest on {}{}, solves {}", profile.unpriced > 0 ? "at least " : "",
                                             percent(curve.at(1)), percent(curve.reliability()));
                        });
}

Json error_figure(const PageContext& context, const std::string& group) {
  Plot plot;
  plot.description = fmt::format("{}: share of tests by error at defaults", group.empty() ? "all groups" : group);
  plot.x.title = "error at the engine's defaults";
  plot.y = {"share of tests with no more error", false, 0.0, 1.0};
  return profile_figure(context, error_profile(context.ordered, context.costs, group), "error at defaults",
                        std::move(plot), smallest_error, largest_error, [](const ProfileCurve& curve) {
                          return fmt::format("within 1 % on {}, within 0.1 % on {}", percent(curve.at(0.01)),
                                             percent(curve.at(0.001)));
                        });
}

Json group_figures(const PageContext& context, const std::string& group) {
  Json out = Json::array();
  const auto add = [&](Json figure) {
    if (!figure.is_null()) out.push_back(std::move(figure));
  };
  for (std::size_t t = 0; t < target_errors.size(); ++t) add(cost_figure(context, group, t));
  add(error_figure(context, group));
  return out;
}

}  // namespace

PageSection profiles_section(const PageContext& context) {
  PageSection section{"profiles", "Performance profiles", ""};
  if (context.ordered.backends.size() < 2) return section;
  Json all = group_figures(context, "");
  if (all.empty()) return section;
  section.words = about(
      R"(After Dolan and Mor&eacute;. A test is a )"
      R"(scene's metric that every engine of the diagram has a run of (one that ran less than half of them is left out; what an engine refuses, it does not solve); its cost for an engine is that of the cheapest )"
      R"(configuration that reaches the error and passes its scene (the <a href="#cost)" +
      context.suffix +
      R"(">table above</a>). A curve says on which share of the )"
      R"(tests the engine needs at most x times what the cheapest one needs. Read it at two places: its height at the )"
      R"(left edge is how often the engine is the cheapest, its height at the right edge how often it gets there at )"
      R"(all. Higher is better everywhere; between, a curve that rises early loses by little. The fourth diagram is of )"
      R"(errors at the engines' own settings, whatever they cost.)");
  section.blocks.push_back(group_block("All groups", "", true, Json::array({figures_block(std::move(all))})));
  for (const std::string& group : context.ordered.groups) {
    Json figures = context.ordered.groups.size() > 1 ? group_figures(context, group) : Json::array();
    if (!figures.empty())
      section.blocks.push_back(
          group_block(group_title(group), "", false, Json::array({figures_block(std::move(figures))})));
  }
  return section;
}

}  // namespace plumb::harness
