#include "report/findings/needs.hpp"

#include <algorithm>
#include <map>

#include "base/format.hpp"

namespace plumb::harness {
namespace {

constexpr std::string_view more = "scene+";

std::string key_without_needs(const Row& row) {
  return value_text(Json::array({row.scene, row.params, row.backend, row.engine.version, row.profile,
                                 row.dt.value_or(0), row.seconds.value_or(0), row.threads.value_or(0), row.settings}));
}

/// The need was free to do nothing, and did nothing: both did the same work.
bool same_end(const Row& a, const Row& b) { return !a.hash.empty() && a.hash == b.hash; }

bool is_timed(const Row& row) { return row.completed() && row.fair_ms().value_or(0) > 0; }

}  // namespace

std::vector<NeedCost> costs_of_needs(const OrderedRows& ordered) {
  std::map<std::string, const Row*> plain;
  for (const Row& row : ordered.rows) {
    if (is_timed(row) && row.own_needs()) plain[key_without_needs(row)] = &row;
  }
  std::map<std::pair<std::string, std::string>, NeedCost> found;
  for (const Row& row : ordered.rows) {
    if (!is_timed(row) || row.own_needs()) continue;
    const auto without = plain.find(key_without_needs(row));
    if (without == plain.end()) continue;
    const std::string need = row.needs.starts_with(more) ? row.needs.substr(more.size()) : row.needs;
    NeedCost& cost = found.try_emplace({need, row.backend}, NeedCost{need, row.backend, {}, {}, {}}).first->second;
    (same_end(row, *without->second) ? cost.pairs : cost.changed)
        .push_back({&row, without->second, *row.fair_ms() / *without->second->fair_ms()});
  }
  std::vector<NeedCost> costs;
  for (auto& [key, cost] : found) {
    std::vector<double> factors;
    for (std::vector<NeedPair>* pairs : {&cost.pairs, &cost.changed}) {
      std::stable_sort(pairs->begin(), pairs->end(),
                       [](const NeedPair& a, const NeedPair& b) { return a.factor > b.factor; });
    }
    for (const NeedPair& pair : cost.pairs) factors.push_back(pair.factor);
    cost.median = median(factors);
    costs.push_back(std::move(cost));
  }
  return costs;
}

}  // namespace plumb::harness
