#include "joints/joint_elimination.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>

#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

using Numbers = std::vector<std::uint32_t>;

/// Products a joint may cost before its mechanism is solved joint by joint instead.
constexpr std::size_t kMostProducts = 64;
constexpr std::uint32_t kNoBody = ~0U;

std::uint32_t count_of(const auto& list) { return static_cast<std::uint32_t>(list.size()); }

/// Lists in one array, by number: list i is items[first[i]] .. items[first[i + 1] - 1].
struct Lists {
  Numbers first, items;
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t i) const {
    PLUMB_ASSERT(i + std::size_t{1} < first.size());
    return std::span(items).subspan(first[i], first[i + 1] - first[i]);
  }
};

/// Puts each item, in their order, into the list that list_of(item) names.
template <class ListOf>
Lists sorted_into(std::uint32_t lists, std::uint32_t items, const ListOf& list_of) {
  Lists all{Numbers(lists + std::size_t{1}), Numbers(items)};
  for (std::uint32_t i = 0; i < items; ++i) ++all.first[list_of(i) + 1];
  std::partial_sum(all.first.begin(), all.first.end(), all.first.begin());
  Numbers next = all.first;
  for (std::uint32_t i = 0; i < items; ++i) all.items[next[list_of(i)]++] = i;
  return all;
}

/// Of every joint those that share a body with it, ascending. Empty where they are too many.
std::vector<Numbers> neighbours_of(const Numbers& ends, std::uint32_t bodies) {
  const std::uint32_t joints = count_of(ends) / 2;
  const Lists on_body = sorted_into(bodies + 1, count_of(ends),
                                    [&](std::uint32_t end) { return ends[end] == kNoBody ? bodies : ends[end]; });
  std::size_t links = 0;
  for (const std::uint32_t body : ends)
    if (body != kNoBody) links += on_body[body].size() - 1;
  if (links > 2 * kMostProducts * joints) return {};
  std::vector<Numbers> neighbours(joints);
  for (std::uint32_t j = 0; j < joints; ++j) {
    Numbers& near = neighbours[j];
    for (const std::uint32_t body : {ends[2 * j], ends[2 * j + 1]})
      if (body != kNoBody)
        for (const std::uint32_t end : on_body[body])
          if (end / 2 != j) near.push_back(end / 2);
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
  }
  return neighbours;
}

/// The joint that is farthest from one, and how many joints lead there, both ends counted.
std::pair<std::uint32_t, std::uint32_t> farthest_from(std::uint32_t joint, const std::vector<Numbers>& neighbours) {
  Numbers way(neighbours.size()), queue = {joint};
  way[joint] = 1;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const std::uint32_t near : neighbours[queue[i]]) {
      if (way[near] != 0) continue;
      way[near] = way[queue[i]] + 1;
      queue.push_back(near);
    }
  return {queue.back(), way[queue.back()]};
}

/// Joint j goes: those around it become neighbours of each other.
void join_around(std::uint32_t j, const Numbers& around, std::vector<Numbers>& neighbours) {
  Numbers all;
  for (const std::uint32_t i : around) {
    all.clear();
    std::set_union(neighbours[i].begin(), neighbours[i].end(), around.begin(), around.end(), std::back_inserter(all));
    std::erase_if(all, [&](std::uint32_t k) { return k == i || k == j; });
    neighbours[i].swap(all);
  }
}

/// Chooses the order. below: of each joint the later ones that it then had as neighbours. False where that is too full.
bool order_joints(std::vector<Numbers>& neighbours, MechanismElimination& found, std::vector<Numbers>& below) {
  const std::uint32_t joints = count_of(neighbours);
  std::size_t products = 0;
  Numbers left(joints), later, blocked_in(joints);
  std::iota(left.begin(), left.end(), 0U);
  for (std::uint32_t round = 1; !left.empty(); ++round) {
    std::size_t least = neighbours[left.front()].size();
    for (const std::uint32_t j : left) least = std::min(least, neighbours[j].size());
    const std::size_t most = std::max<std::size_t>(least, 2);
    found.level_first.push_back(count_of(found.order));
    later.clear();
    for (const std::uint32_t j : left) {
      if (neighbours[j].size() > most || blocked_in[j] == round) {
        later.push_back(j);
        continue;
      }
      found.order.push_back(j);
      for (const std::uint32_t i : neighbours[j]) blocked_in[i] = round;
    }
    for (std::uint32_t c = found.level_first.back(); c < count_of(found.order); ++c) {
      const std::uint32_t j = found.order[c];
      below[j] = neighbours[j];
      products += below[j].size() * (below[j].size() + 1) / 2;
      if (products > kMostProducts * joints) return false;
      join_around(j, below[j], neighbours);
    }
    left.swap(later);
  }
  found.level_first.push_back(count_of(found.order));
  return true;
}

void list_entries(MechanismElimination& found, const std::vector<Numbers>& below) {
  const std::uint32_t columns = count_of(found.order);
  Numbers place(columns), rows;
  for (std::uint32_t c = 0; c < columns; ++c) place[found.order[c]] = c;
  for (std::uint32_t c = 0; c < columns; ++c) {
    found.column_first.push_back(count_of(found.entries));
    rows.clear();
    for (const std::uint32_t j : below[found.order[c]]) rows.push_back(place[j]);
    std::sort(rows.begin(), rows.end());
    for (const std::uint32_t row : rows) found.entries.push_back({row, c});
  }
  found.column_first.push_back(count_of(found.entries));

  const auto number_of = [&](std::uint32_t row, std::uint32_t column) {
    const JointEntry* const begin = found.entries.data();
    const auto at = std::lower_bound(begin + found.column_first[column], begin + found.column_first[column + 1], row,
                                     [](const JointEntry& entry, std::uint32_t r) { return entry.row < r; });
    return static_cast<std::uint32_t>(at - begin);
  };
  std::vector<JointProduct> products;
  Numbers of_entry;
  for (std::uint32_t c = 0; c < columns; ++c)
    for (std::uint32_t e = found.column_first[c]; e < found.column_first[c + 1]; ++e)
      for (std::uint32_t f = found.column_first[c]; f < e; ++f) {
        products.push_back({e, f});
        of_entry.push_back(number_of(found.entries[e].row, found.entries[f].row));
      }
  const Lists by_entry =
      sorted_into(count_of(found.entries), count_of(products), [&](std::uint32_t p) { return of_entry[p]; });
  for (const std::uint32_t p : by_entry.items) found.products.push_back(products[p]);
  found.product_first = by_entry.first;
}

MechanismElimination eliminate_mechanism(const Numbers& ends) {
  std::uint32_t bodies = 0, standing = 0;
  for (const std::uint32_t body : ends)
    if (body == kNoBody)
      ++standing;
    else
      bodies = std::max(bodies, body + 1);
  MechanismElimination found;
  // A tree has one joint fewer than bodies; all that stands still is one body.
  found.has_loop = count_of(ends) / 2 + 1 > bodies + (standing != 0 ? 1U : 0U);
  found.is_closed = count_of(ends) / 2 - standing + 1 > bodies;
  std::vector<Numbers> neighbours = neighbours_of(ends, bodies), below(neighbours.size());
  found.length = neighbours.empty() ? bodies : farthest_from(farthest_from(0, neighbours).first, neighbours).second;
  if (neighbours.empty() || !order_joints(neighbours, found, below)) {
    MechanismElimination full;
    full.has_loop = found.has_loop;
    full.is_closed = found.is_closed;
    full.too_full = true;
    full.length = found.length;
    return full;
  }
  list_entries(found, below);
  return found;
}

/// Mechanisms: joints that moving bodies connect, ordered by their first joint.
Lists mechanisms_of(const std::vector<Join>& joins, std::uint32_t none, std::uint32_t bodies) {
  const std::uint32_t joints = count_of(joins);
  Numbers parent(joints), first_on(bodies, kNoBody);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t j) {
    while (parent[j] != j) j = parent[j] = parent[parent[j]];
    return j;
  };
  for (std::uint32_t j = 0; j < joints; ++j)
    for (const std::uint32_t body : {joins[j].first, joins[j].second}) {
      if (body == none) continue;
      if (first_on[body] == kNoBody) first_on[body] = j;
      const std::uint32_t a = root(j), b = root(first_on[body]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  Numbers number(joints);
  std::uint32_t count = 0;
  for (std::uint32_t j = 0; j < joints; ++j) number[j] = root(j) == j ? count++ : number[root(j)];
  return sorted_into(count, joints, [&](std::uint32_t j) { return number[j]; });
}

/// Puts a mechanism behind those that are there. joints: its numbers in the world.
void append(const MechanismElimination& mechanism, std::span<const std::uint32_t> joints, JointElimination& whole) {
  const std::uint32_t column = count_of(whole.order), entry = count_of(whole.entries),
                      level = count_of(whole.level_first), product = count_of(whole.products);
  for (const std::uint32_t j : mechanism.order) whole.order.push_back(joints[j]);
  // Of each list of beginnings the last one is the end, and so where the next mechanism begins.
  const auto append_firsts = [](const Numbers& of, std::uint32_t before, Numbers& to) {
    for (std::size_t i = 0; i + 1 < of.size(); ++i) to.push_back(before + of[i]);
  };
  append_firsts(mechanism.level_first, column, whole.level_first);
  append_firsts(mechanism.column_first, entry, whole.column_first);
  append_firsts(mechanism.product_first, product, whole.product_first);
  for (const JointEntry& of : mechanism.entries) whole.entries.push_back({column + of.row, column + of.column});
  for (const JointProduct& of : mechanism.products) whole.products.push_back({entry + of.left, entry + of.right});
  whole.columns.push_back({level, count_of(whole.level_first), column, count_of(whole.order)});
}

void finish(JointElimination& whole) {
  whole.level_first.push_back(count_of(whole.order));
  whole.column_first.push_back(count_of(whole.entries));
  whole.product_first.push_back(count_of(whole.products));
  Lists by_row = sorted_into(count_of(whole.order), count_of(whole.entries),
                             [&](std::uint32_t e) { return whole.entries[e].row; });
  whole.row_entries = std::move(by_row.items);
  whole.row_first = std::move(by_row.first);
  std::sort(whole.one_by_one.begin(), whole.one_by_one.end());
}

}  // namespace

/// FNV-1a
std::size_t JointEliminator::Hash::operator()(const Shape& shape) const {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const std::uint32_t number : shape) hash = (hash ^ number) * 0x100000001B3U;
  return static_cast<std::size_t>(hash);
}

JointElimination JointEliminator::eliminate(const std::vector<Join>& joins, std::uint32_t none) {
  ++calls_;
  std::uint32_t bodies = 0;
  for (const Join& join : joins)
    for (const std::uint32_t body : {join.first, join.second})
      if (body != none) bodies = std::max(bodies, body + 1);
  JointElimination whole;
  whole.in_loop.resize(joins.size());
  whole.length.resize(joins.size());
  whole.is_closed.resize(joins.size());
  whole.mechanism.resize(joins.size());
  const Lists mechanisms = mechanisms_of(joins, none, bodies);
  Numbers local(bodies, kNoBody);  // no body is in two mechanisms
  Shape shape;
  for (std::uint32_t m = 0; m + 1 < mechanisms.first.size(); ++m) {
    shape.clear();
    std::uint32_t count = 0;
    for (const std::uint32_t j : mechanisms[m])
      for (const std::uint32_t body : {joins[j].first, joins[j].second}) {
        if (body != none && local[body] == kNoBody) local[body] = count++;
        shape.push_back(body == none ? kNoBody : local[body]);
      }
    const auto [known, is_new] = known_.try_emplace(shape);
    if (is_new) known->second.elimination = eliminate_mechanism(shape);
    known->second.used = calls_;
    const MechanismElimination& found = known->second.elimination;
    for (const std::uint32_t j : mechanisms[m]) {
      whole.in_loop[j] = found.has_loop;
      whole.length[j] = found.length;
      whole.is_closed[j] = found.is_closed;
      whole.mechanism[j] = m;
      if (found.too_full) whole.one_by_one.push_back(j);
    }
    if (!found.too_full) append(found, mechanisms[m], whole);
  }
  finish(whole);
  std::erase_if(known_, [this](const auto& known) { return known.second.used != calls_; });
  return whole;
}

}  // namespace plumb::impulse
