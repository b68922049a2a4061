#include "report/findings/curves.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "base/format.hpp"
#include "plumb/assert.hpp"

namespace plumb::harness {
namespace {

bool is_knob(const Row& row, const std::string& setting) {
  return std::find(row.engine.knobs.begin(), row.engine.knobs.end(), setting) != row.engine.knobs.end();
}

/// What two rows share when they are of one method.
std::string method_key(const Row& row) {
  Json fixed = Json::object();
  for (const auto& [name, value] : row.settings.items()) {
    if (!is_knob(row, name)) fixed[name] = value;
  }
  return value_text(Json::array({row.backend, row.profile, row.needs, row.threads.value_or(0), fixed}));
}

/// What they share when they are on one curve along the knob.
std::string curve_key(const Row& row, const std::string& knob) {
  Json fixed = row.settings;
  fixed.erase(knob);
  return value_text(fixed);
}

double value_of(const Row& row, const std::string& knob) { return row.settings.at(knob).get<double>(); }

bool has_value(const Row& row, const std::string& knob) {
  return row.settings.contains(knob) && row.settings[knob].is_number();
}

/// Every state is known, and all are the same.
bool ends_alike(const Curve& curve) {
  return std::all_of(curve.rows.begin(), curve.rows.end(),
                     [&](const Row* row) { return !row->hash.empty() && row->hash == curve.rows.front()->hash; });
}

bool has_default_knobs(const Row& row) {
  return std::none_of(row.engine.knobs.begin(), row.engine.knobs.end(),
                      [&](const std::string& knob) { return !at_default(row, knob); });
}

std::vector<Curve> curves_along_knobs(const std::vector<const Row*>& rows) {
  std::vector<Curve> curves;
  for (const std::string& knob : rows.front()->engine.knobs) {
    std::map<std::string, Curve> by_key;
    for (const Row* row : rows) {
      if (has_value(*row, knob)) by_key[curve_key(*row, knob)].rows.push_back(row);
    }
    for (auto& [key, curve] : by_key) {
      std::stable_sort(curve.rows.begin(), curve.rows.end(),
                       [&](const Row* a, const Row* b) { return value_of(*a, knob) < value_of(*b, knob); });
      if (value_of(*curve.rows.front(), knob) == value_of(*curve.rows.back(), knob)) continue;
      curve.knob = knob;
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

MethodCurves curves_of(const std::vector<const Row*>& rows) {
  PLUMB_ASSERT(!rows.empty());
  MethodCurves out{0, {}, {}, {}};
  for (const Row* row : rows) {
    if (!row->completed()) out.broken.push_back(row);
  }
  for (Curve& curve : curves_along_knobs(rows)) {
    if (!ends_alike(curve)) {
      out.curves.push_back(std::move(curve));
    } else if (std::find(out.idle.begin(), out.idle.end(), curve.knob) == out.idle.end()) {
      out.idle.push_back(curve.knob);
    }
  }
  if (out.curves.empty()) {
    const auto usual = std::find_if(rows.begin(), rows.end(), [](const Row* row) { return has_default_knobs(*row); });
    out.curves.push_back({"", {usual == rows.end() ? rows.front() : *usual}});
  }
  return out;
}

/// The problem's rows by method, time step and duration.
std::vector<std::vector<const Row*>> rows_of_methods(const Problem& problem) {
  std::vector<std::vector<const Row*>> groups;
  std::map<std::string, std::size_t> places;
  const bool has_own =
      std::any_of(problem.rows.begin(), problem.rows.end(), [](const Row* row) { return row->own_needs(); });
  for (const Row* row : problem.rows) {
    if (has_own && !row->own_needs()) continue;  // it answers another question (needs.hpp)
    // Seeds have lines of their own: beside each other they show how far apart outcomes lie.
    const std::string times =
        value_text(Json::array({row->dt.value_or(0), row->seconds.value_or(0), row->params.value("seed", Json())}));
    const auto [place, is_new] = places.try_emplace(method_key(*row) + times, groups.size());
    if (is_new) groups.emplace_back();
    groups[place->second].push_back(row);
  }
  return groups;
}

/// Labels by what differs between the methods of a problem: backends, profiles, threads, settings. Where a backend's
/// name stands already, what it does by itself needs no words.
class Labels {
 public:
  void add(const Row& row) {
    note("backend", row.backend);
    note("profile", row.profile);
    note("threads", threads(row));
    for (const auto& [name, value] : row.settings.items()) {
      if (!is_knob(row, name)) note(row.backend + ":" + name, value_text(value));
    }
  }
  [[nodiscard]] std::string of(const Row& row) const {
    std::string out;
    const auto add = [&](const std::string& text) { out += (out.empty() ? "" : ", ") + text; };
    if (varies("backend")) add(row.backend);
    if (varies("profile") && row.profile != "default") add(row.profile);
    if (varies("threads")) add(threads(row));
    for (const auto& [name, value] : row.settings.items()) {
      const bool is_own = varies("backend") && row.engine.tells_defaults && at_default(row, name);
      if (!is_knob(row, name) && !is_own && varies(row.backend + ":" + name)) add(name + " " + value_text(value));
    }
    return out.empty() ? row.backend : out;
  }

 private:
  static std::string threads(const Row& row) {
    return row.threads ? shortest_number(*row.threads) + (*row.threads == 1 ? " thread" : " threads") : "";
  }
  void note(const std::string& what, const std::string& value) { values_[what].insert(value); }
  [[nodiscard]] bool varies(const std::string& what) const {
    const auto found = values_.find(what);
    return found != values_.end() && found->second.size() > 1;
  }

  std::map<std::string, std::set<std::string>> values_;
};

bool turns_something(const MethodCurves& method) {
  return !method.idle.empty() || std::any_of(method.curves.begin(), method.curves.end(),
                                             [](const Curve& curve) { return !curve.knob.empty(); });
}

/// Settings that make methods were turned, of a backend with knobs, and no cell of all came through: what would have
/// been curves.
bool lacks_methods(const std::vector<std::vector<const Row*>>& groups) {
  std::map<std::string, int> methods;
  for (const auto& rows : groups) {
    if (std::any_of(rows.begin(), rows.end(), [](const Row* row) { return row->completed(); })) return false;
    const Row& row = *rows.front();
    if (!row.engine.knobs.empty()) ++methods[value_text(Json::array({row.backend, row.profile}))];
  }
  return std::any_of(methods.begin(), methods.end(), [](const auto& backend) { return backend.second > 1; });
}

}  // namespace

bool at_default(const Row& row, const std::string& knob) { return !row.engine.defaults.contains(knob); }

CurveSet::CurveSet(const OrderedRows& ordered) {
  std::vector<const Row*> first_rows;  // of methods
  std::map<std::string, std::size_t> places;
  for (const Problem& problem : ordered.problems) {
    ProblemCurves found{&problem, {}};
    std::vector<std::vector<const Row*>> groups = rows_of_methods(problem);
    for (const auto& rows : groups) found.methods.push_back(curves_of(rows));
    if (std::none_of(found.methods.begin(), found.methods.end(), turns_something) && !lacks_methods(groups)) continue;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const auto [place, is_new] = places.try_emplace(method_key(*groups[i].front()), first_rows.size());
      if (is_new) first_rows.push_back(groups[i].front());
      found.methods[i].method = place->second;
      if (!turns_something(found.methods[i])) continue;
      std::copy_if(groups[i].begin(), groups[i].end(), std::inserter(turned_, turned_.end()),
                   [](const Row* row) { return !has_default_knobs(*row); });
    }
    std::stable_sort(found.methods.begin(), found.methods.end(),
                     [](const MethodCurves& a, const MethodCurves& b) { return a.method < b.method; });
    problems.push_back(std::move(found));
  }
  Labels labels;
  for (const Row* row : first_rows) labels.add(*row);
  for (const Row* row : first_rows) methods.push_back({row->backend, labels.of(*row)});
}

}  // namespace plumb::harness
