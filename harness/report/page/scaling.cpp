// Scaling: time per step against the number of bodies, with the error on a second axis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/plot.hpp"
#include "report/page/sections.hpp"

namespace plumb::harness {
namespace {

constexpr double frame_ms = 1000.0 / 60;

struct Sized {
  double bodies;
  const ResultRow* row;
};

/// A backend's default cells over the sizes of a scene, smallest first; none where the size does not vary.
std::vector<Sized> sizes_of(const PageContext& context, const Problem* first, const Problem* last,
                            const std::string& backend) {
  std::vector<Sized> sizes;
  for (const Problem* problem = first; problem != last; ++problem) {
    const ResultRow* row = context.study.representative(*problem, backend);
    if (row && row->bodies && *row->bodies > 0 && row->fair_ms() && *row->fair_ms() > 0)
      sizes.push_back({*row->bodies, row});
  }
  std::stable_sort(sizes.begin(), sizes.end(), [](const Sized& a, const Sized& b) { return a.bodies < b.bodies; });
  const bool varies = !sizes.empty() && sizes.front().bodies < sizes.back().bodies;
  // Several variants of one size are a ladder of something else.
  const bool distinct = std::adjacent_find(sizes.begin(), sizes.end(), [](const Sized& a, const Sized& b) {
                          return a.bodies == b.bodies;
                        }) == sizes.end();
  return varies && distinct ? sizes : std::vector<Sized>{};
}

/// Bodies at which a step takes a frame, between the two sizes around it as a power law; "" where it was not reached.
std::string bodies_at_frame(const std::vector<Sized>& sizes) {
  if (*sizes.front().row->fair_ms() > frame_ms) return fmt::format("below {}", shortest_number(sizes.front().bodies));
  for (std::size_t i = 1; i < sizes.size(); ++i) {
    const double a = *sizes[i - 1].row->fair_ms(), b = *sizes[i].row->fair_ms();
    if (a <= frame_ms && b > frame_ms) {
      const double share = std::log(frame_ms / a) / std::log(b / a);
      const double bodies = sizes[i - 1].bodies * std::pow(sizes[i].bodies / sizes[i - 1].bodies, share);
      const double unit = std::max(1.0, std::pow(10.0, std::floor(std::log10(bodies)) - 1));  // two digits are known
      return fmt::format("about {}", shortest_number(std::round(bodies / unit) * unit));
    }
  }
  return fmt::format("above {}", shortest_number(sizes.back().bodies));
}

std::string scene_figure(const PageContext& context, const Problem* first, const Problem* last) {
  Plot plot;
  plot.x.title = "bodies";
  plot.y.title = "ms per step (solid)";
  plot.right = PlotAxis{"error of the worst metric (dotted)", true, std::nullopt, 10.0};
  plot.levels = {{frame_ms, "16.7 ms"}};
  plot.description = fmt::format("{}: time per step and error against the number of bodies", first->scene);
  std::string table;
  std::vector<const ResultRow*> rows;
  for (const std::string& backend : context.study.backends) {
    const std::vector<Sized> sizes = sizes_of(context, first, last, backend);
    if (sizes.empty()) continue;
    const std::size_t colour = context.backend_index(backend);
    PlotSeries time{colour, 0, true, false, fmt::format("{}: ms per step", backend), {}};
    PlotSeries error{colour, 2, true, true, fmt::format("{}: error of the worst metric", backend), {}};
    for (const Sized& sized : sizes) {
      const std::string link = fmt::format("#r{}", sized.row->index), hover = row_hover(context, *sized.row);
      time.points.push_back({sized.bodies, *sized.row->fair_ms(), {}, {}, true, hover, link});
      if (const std::optional<Interval>& band = sized.row->ci95) {
        time.points.back().y_low = band->low;
        time.points.back().y_high = band->high;
      }
      rows.push_back(sized.row);
      const MetricResult* worst = sized.row->worst();
      if (worst && worst->error && sized.row->completed())
        error.points.push_back({sized.bodies, *worst->error, {}, {}, false, hover, link});
    }
    plot.series.push_back(std::move(time));
    plot.series.push_back(std::move(error));
    table += fmt::format(R"(<li class="e{}">{}: {} bodies</li>)", colour, backend_label(context, backend),
                         bodies_at_frame(sizes));
  }
  if (plot.series.empty()) return "";
  return fmt::format(R"(<figure {}><figcaption>{}</figcaption>{}<p class="frame-note">In a frame of 16.7 ms:</p><ul )"
                     R"(class="frame-list">{}</ul>{}</figure>)",
                     filter_key(context, *first), escape_html(first->scene), render_plot(plot), table,
                     figure_foot(context, rows, first->scene));
}

}  // namespace

std::string scaling_section(const PageContext& context) {
  std::string figures;
  const std::vector<Problem>& problems = context.study.problems;
  for (std::size_t i = 0; i < problems.size();) {
    std::size_t end = i;
    while (end < problems.size() && problems[end].scene == problems[i].scene &&
           problems[end].group == problems[i].group)
      ++end;
    if (end - i > 1) figures += scene_figure(context, &problems[i], &problems[i] + (end - i));
    i = end;
  }
  std::string out =
      section_start(context, "scaling", "Scaling") +
      R"(<p class="about">Scenes that were run at several sizes, each engine )"
      R"(at its defaults: time per step on )"
      R"(the left axis, the worst error at that size on the right. The line at 16.7 ms is one frame at 60 Hz.</p>)";
  if (figures.empty()) return out + R"(<p class="about">No scene here was run at several sizes.</p></section>)";
  return out + fmt::format(R"(<div class="figures">{}</div></section>)", figures);
}

}  // namespace plumb::harness
