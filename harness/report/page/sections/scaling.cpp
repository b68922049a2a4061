// Scaling: time per step against the number of bodies, and the error beside it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/format.hpp"
#include "report/ordered/default_run.hpp"
#include "report/page/parts/markup.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

constexpr double frame_ms = 1000.0 / 60;

struct Sized {
  double bodies;
  const Row* row;
};

/// What a row was run with that is no number: other structures, kinds, cases.
Json kind_of(const Row& row) {
  Json kind = Json::object();
  for (const auto& [name, value] : row.params.items())
    if (!value.is_number()) kind[name] = value;
  return kind;
}

/// A backend's default cells over the sizes of a scene, smallest first; none where the size does not vary.
std::vector<Sized> sizes_of(const PageContext& context, const Problem* first, const Problem* last,
                            const std::string& backend) {
  std::vector<Sized> sizes;
  for (const Problem* problem = first; problem != last; ++problem) {
    const Row* row = default_run(context.ordered, *problem, backend);
    if (row && row->completed() && row->counts.bodies && *row->counts.bodies > 0 && row->fair_ms() &&
        *row->fair_ms() > 0)
      sizes.push_back({*row->counts.bodies, row});
  }
  std::stable_sort(sizes.begin(), sizes.end(), [](const Sized& a, const Sized& b) { return a.bodies < b.bodies; });
  const bool varies = !sizes.empty() && sizes.front().bodies < sizes.back().bodies;
  // Several variants of one size are a ladder of something else; so are several kinds.
  const bool distinct = std::adjacent_find(sizes.begin(), sizes.end(), [](const Sized& a, const Sized& b) {
                          return a.bodies == b.bodies;
                        }) == sizes.end();
  const bool alike = std::all_of(sizes.begin(), sizes.end(), [&](const Sized& sized) {
    return kind_of(*sized.row) == kind_of(*sizes.front().row);
  });
  return varies && distinct && alike ? sizes : std::vector<Sized>{};
}

std::string bodies_text(const char* where, double bodies) {
  return fmt::format("{} {} {}", where, shortest_number(bodies), bodies == 1 ? "body" : "bodies");
}

/// "about 1200 bodies": at which a step takes a frame, between the two sizes around it as a power law.
std::string bodies_at_frame(const std::vector<Sized>& sizes) {
  if (*sizes.front().row->fair_ms() > frame_ms) return bodies_text("below", sizes.front().bodies);
  for (std::size_t i = 1; i < sizes.size(); ++i) {
    const double a = *sizes[i - 1].row->fair_ms(), b = *sizes[i].row->fair_ms();
    if (a <= frame_ms && b > frame_ms) {
      const double share = std::log(frame_ms / a) / std::log(b / a);
      const double bodies = sizes[i - 1].bodies * std::pow(sizes[i].bodies / sizes[i - 1].bodies, share);
      const double unit = std::max(1.0, std::pow(10.0, std::floor(std::log10(bodies)) - 1));  // two digits are known
      return bodies_text("about", std::round(bodies / unit) * unit);
    }
  }
  return bodies_text("above", sizes.back().bodies);
}

/// The same over the sizes at which the engine passes: what fails its scene tells nothing of what an engine can carry.
std::string carried(const std::vector<Sized>& sizes) {
  std::vector<Sized> passing;
  std::copy_if(sizes.begin(), sizes.end(), std::back_inserter(passing),
               [](const Sized& sized) { return sized.row->passes(); });
  if (passing.empty()) return "fails at every size";
  const std::string bodies = bodies_at_frame(passing);
  const std::size_t failed = sizes.size() - passing.size();
  return failed == 0 ? bodies : fmt::format("{}; fails at {} of {} sizes", bodies, failed, sizes.size());
}

Json scene_figure(const PageContext& context, const Problem* first, const Problem* last) {
  Plot time, error;
  time.description = fmt::format("{}: time per step against the number of bodies", first->scene);
  time.x.title = error.x.title = "bodies";
  time.y.title = "ms per step";
  time.levels = {{frame_ms, "16.7 ms"}};
  error.description = fmt::format("{}: error against the number of bodies", first->scene);
  error.y = {"error of the worst metric", true, std::nullopt, largest_error};
  std::string list;
  std::vector<const Row*> rows;
  for (const std::string& backend : context.ordered.backends) {
    const std::vector<Sized> sizes = sizes_of(context, first, last, backend);
    if (sizes.empty()) continue;
    PlotSeries times{backend, context.backend_index(backend)}, errors = times;
    for (const Sized& sized : sizes) {
      times.points.push_back({sized.bodies, *sized.row->fair_ms(), sized.row, true, false, {}, sized.row->time.ci95});
      times.points.back().failed = sized.row->missed();
      rows.push_back(sized.row);
      const MetricResult* worst = sized.row->worst();
      if (worst && worst->error && sized.row->completed())
        errors.points.push_back({sized.bodies, *worst->error, sized.row, true});
    }
    time.series.push_back(std::move(times));
    error.series.push_back(std::move(errors));
    list += fmt::format("<li>{}: {}</li>", backend_label(context, backend), carried(sizes));
  }
  FigureData figure;
  figure.title = first->scene;
  figure.key = filter_key(context, *first);
  figure.legend = false;
  figure.plots = {std::move(time), std::move(error)};
  figure.notes = fmt::format(R"(<p class="frame-note">In a frame of 16.7 ms:</p><ul class="frame-list">{}</ul>{})",
                             list, figure_foot(context, rows, first->scene));
  return figure_data(figure);
}

}  // namespace

PageSection scaling_section(const PageContext& context) {
  PageSection section{"scaling", "Scaling", ""};
  Json figures = Json::array();
  const std::vector<Problem>& problems = context.ordered.problems;
  for (std::size_t i = 0; i < problems.size();) {
    std::size_t end = i;
    while (end < problems.size() && problems[end].scene == problems[i].scene &&
           problems[end].group == problems[i].group)
      ++end;
    if (end - i > 1) {
      if (Json figure = scene_figure(context, &problems[i], &problems[i] + (end - i)); !figure.is_null())
        figures.push_back(std::move(figure));
    }
    i = end;
  }
  section.words = about(
      std::string("Scenes that were run at several sizes, each engine at its defaults: time per "
                  "step, and below it the worst error "
                  "at that size. The line at 16.7 ms is one frame at 60 Hz; the list says how many bodies an engine "
                  "steps in that time, of the sizes at which it passes: above its largest "
                  "one where none takes longer. A cross: the run missed a threshold.") +
      untimed_note(context));
  if (figures.empty()) {
    section.words += about("No engine here has times that count at several sizes of a scene.");
  } else {
    section.blocks.push_back(figures_block(std::move(figures)));
  }
  return section;
}

}  // namespace plumb::harness
