#include "report/findings/overview.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/format.hpp"
#include "report/ordered/default_run.hpp"

namespace plumb::harness {
namespace {

constexpr std::size_t most_named = 3;  ///< how many cells a sentence names

std::string plural(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string plural(int count, const char* one, const char* many) {
  return plural(static_cast<std::size_t>(count), one, many);
}

std::string title(const Row& row) {
  const std::string variant = row.variant();
  return variant.empty() ? row.scene : row.scene + " " + variant;
}

/// "tower (12x its threshold)"
std::string worst_miss(const Row& row) {
  const MetricResult* worst = row.worst();
  if (!worst || !worst->badness()) return title(row);
  if (!worst->error) return fmt::format("{} ({} not finite)", title(row), worst->name);
  if (!worst->threshold || *worst->threshold <= 0)
    return fmt::format("{} ({} {})", title(row), worst->name, short_number(worst->error));
  return fmt::format("{} ({} at {} its threshold)", title(row), worst->name, ratio_text(*worst->badness()));
}

/// Groups in which the backend passes the largest and the smallest share of the problems that it can run.
void find_groups(BackendOverview& overview, const std::map<std::string, std::pair<int, int>>& passed_of) {
  struct Share {
    double share;
    int problems;
    std::string text;
  };
  std::vector<Share> shares;
  for (const auto& [group, count] : passed_of) {
    shares.push_back({double(count.first) / count.second, count.second,
                      fmt::format("{} ({} of {})", group.empty() ? "other" : group, count.first, count.second)});
  }
  // Of equal shares the one that rests on more problems says more.
  std::stable_sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
    return a.share != b.share ? a.share > b.share : a.problems > b.problems;
  });
  if (shares.empty() || shares.front().share <= shares.back().share) return;
  const double best = shares.front().share, worst = shares.back().share;
  for (const Share& share : shares) {
    if (share.share == best && overview.best_groups.size() < most_named) overview.best_groups.push_back(share.text);
    if (share.share == worst && overview.worst_groups.size() < most_named) overview.worst_groups.push_back(share.text);
  }
}

BackendOverview overview_of(const OrderedRows& ordered, const std::string& backend) {
  BackendOverview overview;
  overview.backend = backend;
  std::map<std::string, std::pair<int, int>> passed_of;
  for (const Problem& problem : ordered.problems) {
    const Row* any = ordered.representative(problem, backend);
    if (any && overview.version.empty()) overview.version = any->engine.version;
    const Row* row = default_run(ordered, problem, backend);
    overview.elsewhere += any && !row;
    if (!row) continue;
    const Verdict verdict = row->verdict();
    ++overview.problems;
    ++overview.counts[static_cast<std::size_t>(verdict)];
    if (verdict == Verdict::failed) overview.failures.push_back(row);
    const bool broke = verdict > Verdict::unjudged;
    if (broke) overview.broken.push_back(row);
    if (verdict == Verdict::failed || broke) overview.lost.push_back(row);
    if (verdict == Verdict::unsupported) overview.unsupported.push_back(row);
    if (verdict == Verdict::unjudged) overview.unjudged.push_back(row);
    if (!says_nothing(verdict) && verdict != Verdict::ran) {
      auto& [passed, all] = passed_of[problem.group];
      passed += verdict <= Verdict::pass;
      ++all;
    }
  }
  const auto badness = [](const Row* row) {
    const MetricResult* worst = row->worst();
    return worst ? worst->badness().value_or(0) : 0;
  };
  std::stable_sort(overview.failures.begin(), overview.failures.end(),
                   [&](const Row* a, const Row* b) { return badness(a) > badness(b); });
  find_groups(overview, passed_of);
  return overview;
}

}  // namespace

std::vector<BackendOverview> overviews(const OrderedRows& ordered, const std::vector<CostLine>& costs) {
  std::vector<BackendOverview> all;
  const std::vector<CostTest> tests = tests_of(costs);
  for (const std::string& backend : ordered.backends) {
    all.push_back(overview_of(ordered, backend));
    for (std::size_t t = 0; t < target_errors.size(); ++t) all.back().reach[t] = count_reached(tests, backend, t);
  }
  return all;
}

std::string elsewhere_text(const BackendOverview& o) {
  if (o.elsewhere == 0) return "";
  return fmt::format("{} ran with other settings only.",
                     plural(o.elsewhere, "more scene variant", "more scene variants"));
}

std::string describe_counts(const BackendOverview& o) {
  std::vector<std::string> counts;
  const auto count = [&](Verdict verdict, const char* words) {
    if (o.count(verdict) > 0) counts.push_back(fmt::format("{} {}", o.count(verdict), words));
  };
  count(Verdict::gold, "gold");
  count(Verdict::pass, "passed");
  count(Verdict::failed, "failed");
  count(Verdict::ran, "ran without a threshold");
  count(Verdict::unsupported, "unsupported");
  count(Verdict::unjudged, "not judged");
  count(Verdict::crashed, "crashed");
  count(Verdict::timeout, "timed out");
  count(Verdict::out_of_memory, "out of memory");
  count(Verdict::error, "ended in an error");
  std::string out = o.problems == 0
                        ? "Nothing was run at its defaults."
                        : fmt::format("Of {} at its defaults: {}.",
                                      plural(o.problems, "scene variant", "scene variants"), fmt::join(counts, ", "));
  if (o.elsewhere > 0) out += " " + elsewhere_text(o);
  return out;
}

std::string describe_backend(const BackendOverview& o, bool alone) {
  std::string out = describe_counts(o);
  if (o.reach[1].tests > 0) out += fmt::format(" It gets {}.", reach_text(o.reach[1], alone));
  if (!o.best_groups.empty()) {
    out += fmt::format(" Best in {}; weakest in {}.", fmt::join(o.best_groups, ", "), fmt::join(o.worst_groups, ", "));
  }
  const auto name_some = [&](const char* verb, const std::vector<const Row*>& rows, const auto& text) {
    if (rows.empty()) return;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min(most_named, rows.size()); ++i) names.push_back(text(*rows[i]));
    out += fmt::format(" {} {}", verb, fmt::join(names, ", "));
    if (rows.size() > most_named) out += fmt::format(" and {} more", rows.size() - most_named);
    out += '.';
  };
  name_some("It misses by most in", o.failures, worst_miss);
  name_some("It did not come through", o.broken, [](const Row& row) {
    std::string word(verdict_word(row.verdict()));
    std::replace(word.begin(), word.end(), '_', ' ');
    return fmt::format("{} ({})", title(row), word);
  });
  return out;
}

std::string reach_text(const ReachCount& count, bool alone) {
  std::string out = fmt::format("within 1 % in {} of {}", count.reached, plural(count.tests, "metric", "metrics"));
  if (alone || count.reached == 0) return out;
  if (count.compared == 0) return out + ", at a cost that is not known";
  out += fmt::format(", the cheapest in {} of ", count.cheapest);
  return out + (count.compared == count.reached ? "them" : fmt::format("the {} whose costs are known", count.compared));
}

std::string describe_study(const OrderedRows& ordered) {
  std::set<std::string> scenes, profiles;
  std::set<double> steps;
  for (const Row& row : ordered.rows) {
    scenes.insert(row.scene);
    if (!row.profile.empty()) profiles.insert(row.profile);
    if (row.dt) steps.insert(*row.dt);
  }
  std::string out = fmt::format(
      "{} on {} ({} with their variants), {}.", plural(ordered.backends.size(), "backend", "backends"),
      plural(scenes.size(), "scene", "scenes"), ordered.problems.size(), plural(ordered.rows.size(), "cell", "cells"));
  if (!profiles.empty()) out += fmt::format(" Profile {}.", fmt::join(profiles, ", "));
  if (steps.size() == 1) out += fmt::format(" Time step {} s.", dt_text(*steps.begin()));
  if (steps.size() > 1)
    out +=
        fmt::format(" {} time steps from {} to {} s.", steps.size(), dt_text(*steps.begin()), dt_text(*steps.rbegin()));
  return out;
}

std::vector<std::string> describe_machines(const OrderedRows& ordered) {
  std::vector<std::string> machines;
  std::set<std::string> seen;
  for (const Row& row : ordered.rows) {
    if (row.origin.machine.empty() || !seen.insert(value_text(row.origin.machine)).second) continue;
    std::vector<std::string> parts;
    for (const auto& [name, value] : row.origin.machine.items()) parts.push_back(name + ": " + value_text(value));
    machines.push_back(fmt::format("{}", fmt::join(parts, ", ")));
  }
  return machines;
}

}  // namespace plumb::harness
