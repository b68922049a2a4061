#include "constraints/joint_elimination.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace plumb::impulse {

namespace {

using Numbers = std::vector<std::uint32_t>;
using Neighbours = std::vector<std::set<std::uint32_t>>;

/// Products a joint may cost before its mechanism is solved joint by joint instead.
constexpr std::size_t kMostProducts = 64;

/// Joints of one mechanism, round by round; below: which later joints each then had as neighbours.
struct Rounds {
  std::vector<Numbers> joints;
  std::map<std::uint32_t, Numbers> below;
  bool too_full = false;
};

Rounds eliminate(const Numbers& members, Neighbours& neighbours) {
  Rounds rounds;
  std::size_t products = 0;
  Numbers left = members;
  while (!left.empty()) {
    std::size_t least = neighbours[left.front()].size();
    for (const std::uint32_t j : left) least = std::min(least, neighbours[j].size());
    const std::size_t most = std::max<std::size_t>(least, 2);
    Numbers round, later;
    std::set<std::uint32_t> blocked;
    for (const std::uint32_t j : left) {
      if (neighbours[j].size() > most || blocked.contains(j)) {
        later.push_back(j);
        continue;
      }
      round.push_back(j);
      blocked.insert(neighbours[j].begin(), neighbours[j].end());
    }
    for (const std::uint32_t j : round) {
      const Numbers around(neighbours[j].begin(), neighbours[j].end());
      products += around.size() * (around.size() + 1) / 2;
      if (products > kMostProducts * members.size()) return rounds.too_full = true, rounds;
      for (const std::uint32_t i : around) {
        neighbours[i].erase(j);
        for (const std::uint32_t k : around)
          if (k != i) neighbours[i].insert(k);
      }
      rounds.below[j] = around;
    }
    rounds.joints.push_back(std::move(round));
    left = std::move(later);
  }
  return rounds;
}

/// Mechanisms: joints that moving bodies connect. Ordered by their first joint, joints by number.
std::vector<Numbers> mechanisms(std::size_t count, const std::map<std::uint32_t, Numbers>& of_body) {
  Numbers parent(count);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t j) {
    while (parent[j] != j) j = parent[j] = parent[parent[j]];
    return j;
  };
  for (const auto& [body, joints] : of_body)
    for (const std::uint32_t j : joints) {
      const std::uint32_t a = root(j), b = root(joints.front());
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::map<std::uint32_t, Numbers> members;
  for (std::uint32_t j = 0; j < count; ++j) members[root(j)].push_back(j);
  std::vector<Numbers> list;
  for (auto& [first, joints] : members) list.push_back(std::move(joints));
  return list;
}

/// A tree has one joint fewer than bodies; all that stands still is one body.
bool has_loop(const Numbers& members, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& joins) {
  std::set<std::uint32_t> bodies;
  for (const std::uint32_t j : members) bodies.insert({joins[j].first, joins[j].second});
  return members.size() + 1 > bodies.size();
}

void list_entries(JointElimination& result, const Rounds& all) {
  std::map<std::uint32_t, std::uint32_t> place;
  for (std::uint32_t i = 0; i < result.order.size(); ++i) place[result.order[i]] = i;
  std::vector<Numbers> by_row(result.order.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number;  // of an entry (row, column)
  for (std::uint32_t column = 0; column < result.order.size(); ++column) {
    result.column_first.push_back(static_cast<std::uint32_t>(result.entries.size()));
    Numbers rows;
    for (const std::uint32_t j : all.below.at(result.order[column])) rows.push_back(place.at(j));
    std::sort(rows.begin(), rows.end());
    for (const std::uint32_t row : rows) {
      const auto entry = static_cast<std::uint32_t>(result.entries.size());
      number[{row, column}] = entry;
      by_row[row].push_back(entry);
      result.entries.push_back({row, column});
    }
  }
  result.column_first.push_back(static_cast<std::uint32_t>(result.entries.size()));
  for (const Numbers& entries : by_row) {
    result.row_first.push_back(static_cast<std::uint32_t>(result.row_entries.size()));
    result.row_entries.insert(result.row_entries.end(), entries.begin(), entries.end());
  }
  result.row_first.push_back(static_cast<std::uint32_t>(result.row_entries.size()));

  std::vector<std::vector<JointProduct>> products(result.entries.size());
  for (std::uint32_t k = 0; k < result.order.size(); ++k)
    for (std::uint32_t e = result.column_first[k]; e < result.column_first[k + 1]; ++e)
      for (std::uint32_t f = result.column_first[k]; f < e; ++f)
        products[number.at({result.entries[e].row, result.entries[f].row})].push_back({e, f});
  for (const auto& list : products) {
    result.product_first.push_back(static_cast<std::uint32_t>(result.products.size()));
    result.products.insert(result.products.end(), list.begin(), list.end());
  }
  result.product_first.push_back(static_cast<std::uint32_t>(result.products.size()));
}

}  // namespace

JointElimination eliminate_joints(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& joins,
                                  std::uint32_t none) {
  std::map<std::uint32_t, Numbers> of_body;
  for (std::uint32_t j = 0; j < joins.size(); ++j) {
    if (joins[j].first != none) of_body[joins[j].first].push_back(j);
    if (joins[j].second != none) of_body[joins[j].second].push_back(j);
  }
  JointElimination result;
  Rounds all;
  Neighbours neighbours(joins.size());
  result.in_loop.resize(joins.size());
  result.size.resize(joins.size());
  const auto joints_of = [&](std::uint32_t body) -> const Numbers& { return of_body.at(body); };
  for (const Numbers& members : mechanisms(joins.size(), of_body)) {
    if (has_loop(members, joins))
      for (const std::uint32_t j : members) result.in_loop[j] = true;
    for (const std::uint32_t j : members) result.size[j] = static_cast<std::uint32_t>(members.size());
    std::size_t links = 0;
    for (const std::uint32_t j : members)
      for (const std::uint32_t body : {joins[j].first, joins[j].second})
        if (body != none) links += joints_of(body).size() - 1;
    Rounds rounds;
    rounds.too_full = links > 2 * kMostProducts * members.size();
    if (!rounds.too_full) {
      for (const std::uint32_t j : members)
        for (const std::uint32_t body : {joins[j].first, joins[j].second})
          if (body != none)
            for (const std::uint32_t other : joints_of(body))
              if (other != j) neighbours[j].insert(other);
      rounds = eliminate(members, neighbours);
    }
    if (rounds.too_full) {
      result.one_by_one.insert(result.one_by_one.end(), members.begin(), members.end());
      continue;
    }
    all.joints.resize(std::max(all.joints.size(), rounds.joints.size()));
    for (std::size_t round = 0; round < rounds.joints.size(); ++round)
      all.joints[round].insert(all.joints[round].end(), rounds.joints[round].begin(), rounds.joints[round].end());
    all.below.merge(rounds.below);
  }
  std::sort(result.one_by_one.begin(), result.one_by_one.end());
  for (const Numbers& round : all.joints) {
    result.level_first.push_back(static_cast<std::uint32_t>(result.order.size()));
    result.order.insert(result.order.end(), round.begin(), round.end());
  }
  result.level_first.push_back(static_cast<std::uint32_t>(result.order.size()));
  list_entries(result, all);
  return result;
}

}  // namespace plumb::impulse
