#include "joints/joint_store.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_set>

#include "broadphase/pair_filter.hpp"
#include "joints/rigid_groups.hpp"

namespace plumb::impulse {

namespace {

bool is_pushed(std::uint32_t body, const Table<BodyMass>& masses) {
  return body != kWorld && (masses[body].flags & kBodyDynamic) != 0;
}

/// Of so many joints in a row that lock turns the mobility of one end differs from the other's by more than float can
/// tell apart, and a whip of them turns too far in a sub-step for the rows at its start: they yield as those whose rows
/// repeat others.
constexpr std::uint32_t kLongBeam = 4;

/// Errors of so many joints in a row that have no limits are taken back by degrees.
constexpr std::uint32_t kLongChain = 8;

/// Whether a row may come to hold, or let go, from one sub-step to the next.
bool has_limits(const Joint& joint, const JointAxes& axes) {
  for (int i = 0; i < row_count(joint) - rows_of(joint.type); ++i)
    if (axes.row[i].coordinate != kLocked && (axes.lower[i] > -kHuge / 2 || axes.upper[i] < kHuge / 2)) return true;
  return false;
}

bool both_turn(const Joint& joint, const Table<BodyMass>& masses) {
  const auto turns = [&](std::uint32_t body) {
    return !is_pushed(body, masses) || (masses[body].flags & kBodyTurns) != 0;
  };
  return turns(joint.body_a) && turns(joint.body_b);
}

template <class T>
void copy(Buffer<T>& to, const std::vector<T>& from) {
  to.from_host(from.data(), from.size());
}

}  // namespace

void JointStore::add(const Joint& joint, const JointAxes& axes, const JointTraits& traits) {
  if (joint.slot >= rows_.size()) {
    rows_.resize(joint.slot + 1);
    drives.grow(rows_.size());
  }
  rows_[joint.slot] = {joint, axes, traits, true};
  changed_ = true;
}

void JointStore::remove(std::uint32_t slot) {
  rows_[slot].used = false;
  changed_ = true;
}

JointCode JointStore::needed_code() const {
  JointCode code = JointCode::kContacts;
  for (const Row& row : rows_) {
    if (!row.used) continue;
    code = JointCode::kPlain;
    if (wants_reactions_ || row.traits.breaks || row.joint.rows != rows_of(row.joint.type)) return JointCode::kAll;
  }
  return code;
}

/// Greedily in the order given: deterministic. What finds no colour goes last.
void JointStore::colour(const Table<BodyMass>& masses) {
  constexpr std::uint32_t kNoColour = kJointColours - 1;
  std::vector<std::uint32_t> taken(masses.size());  // by body
  struct Colour {
    std::vector<std::uint32_t> single, in_system;
  };
  std::vector<Colour> colours(kJointColours);
  colours_ = 0;
  for (std::uint32_t j = 0; j < ordered_.size(); ++j) {
    const Joint& joint = ordered_[j];
    const bool a = is_pushed(joint.body_a, masses), b = is_pushed(joint.body_b, masses);
    const std::uint32_t mask = (a ? taken[joint.body_a] : 0) | (b ? taken[joint.body_b] : 0);
    std::uint32_t colour = 0;
    while (colour < kNoColour && (mask >> colour & 1U) != 0) ++colour;
    if (a) taken[joint.body_a] |= 1U << colour;
    if (b) taken[joint.body_b] |= 1U << colour;
    (j < base_ ? colours[colour].single : colours[colour].in_system).push_back(j);
    colours_ = std::max(colours_, colour + 1);
  }
  overflow_ = colours_ == kJointColours;
  std::vector<std::uint32_t> list, first, system;
  for (const Colour& colour : colours) {
    first.push_back(static_cast<std::uint32_t>(list.size()));
    list.insert(list.end(), colour.single.begin(), colour.single.end());
    system.push_back(static_cast<std::uint32_t>(list.size()));
    list.insert(list.end(), colour.in_system.begin(), colour.in_system.end());
  }
  first.push_back(static_cast<std::uint32_t>(list.size()));
  copy(by_colour_, list);
  copy(first_, first);
  copy(system_first_, system);
}

/// By mechanism, and in each by body.
void JointStore::list_pushed_bodies(const Table<BodyMass>& masses) {
  struct End {
    std::uint32_t mechanism, body;
    JointOnBody on;
  };
  std::vector<End> ends;
  for (std::uint32_t j = base_; j < ordered_.size(); ++j) {
    if (is_pushed(ordered_[j].body_a, masses)) ends.push_back({mechanism_of_[j], ordered_[j].body_a, {j, false}});
    if (is_pushed(ordered_[j].body_b, masses)) ends.push_back({mechanism_of_[j], ordered_[j].body_b, {j, true}});
  }
  std::stable_sort(ends.begin(), ends.end(), [](const End& x, const End& y) {
    return x.mechanism != y.mechanism ? x.mechanism < y.mechanism : x.body < y.body;
  });
  pushed_list_.clear();
  std::vector<std::uint32_t> first;
  std::vector<JointOnBody> list;
  for (const End& end : ends) {
    if (pushed_list_.empty() || pushed_list_.back() != end.body) {
      pushed_list_.push_back(end.body);
      first.push_back(static_cast<std::uint32_t>(list.size()));
    }
    list.push_back(end.on);
  }
  first.push_back(static_cast<std::uint32_t>(list.size()));
  pushed_count_ = static_cast<std::uint32_t>(pushed_list_.size());
  copy(pushed_, pushed_list_);
  copy(pushed_first_, first);
  copy(on_body_, list);
}

/// Which mechanisms contacts move as a whole, and room for what that takes.
void JointStore::list_mechanisms(std::size_t bodies) {
  const auto columns = static_cast<std::uint32_t>(ordered_.size()) - base_;
  std::vector<std::uint32_t> by_mechanism(columns), number(columns), mechanism_of_body(bodies, kNone);
  std::iota(by_mechanism.begin(), by_mechanism.end(), 0U);
  const auto mechanism = [&](std::uint32_t column) { return mechanism_of_[base_ + column]; };
  std::stable_sort(by_mechanism.begin(), by_mechanism.end(),
                   [&](std::uint32_t x, std::uint32_t y) { return mechanism(x) < mechanism(y); });
  for (std::uint32_t column = 0; column < columns; ++column)
    for (const std::uint32_t body : {ordered_[base_ + column].body_a, ordered_[base_ + column].body_b})
      if (body != kWorld) mechanism_of_body[body] = mechanism(column);  // of what stands any that it holds

  std::vector<MechanismBody> rows(pushed_list_.size());
  std::vector<std::uint32_t> place_of(bodies, 0U);
  std::uint64_t mobility = 0, scratch = 0;
  held_ = 0;
  for (std::uint32_t first = 0, column = 0; first < pushed_list_.size();) {
    const std::uint32_t of = mechanism_of_body[pushed_list_[first]];
    std::uint32_t end = first, last_column = column;
    while (end < pushed_list_.size() && mechanism_of_body[pushed_list_[end]] == of) ++end;
    while (last_column < columns && mechanism(by_mechanism[last_column]) == of) {
      number[by_mechanism[last_column]] = last_column - column;
      ++last_column;
    }
    const bool whole = end - first <= kMostInMechanism;
    for (std::uint32_t place = first; place < end; ++place) {
      rows[place] = {
          pushed_list_[place], first, whole ? end - first : 0, column, last_column - column, mobility, scratch};
      if (!whole) continue;
      place_of[pushed_list_[place]] = place + 1;
      mobility += std::uint64_t{end - first} * 36;
      scratch += std::uint64_t{last_column - column} * 36;
      held_ = pushed_count_;
    }
    first = end;
    column = last_column;
  }
  copy(place_of_, place_of);
  copy(columns_, by_mechanism);
  copy(number_of_, number);
  copy(mechanism_bodies_, rows);
  loads_.grow(rows.size());
  mobility_.grow(mobility);
  scratch_.grow(scratch);
}

std::vector<std::uint64_t> JointStore::excluded() const {
  std::vector<std::uint64_t> keys;
  RigidGroups groups;
  for (const Row& row : rows_) {
    if (!row.used || row.traits.lets_bodies_touch || row.joint.body_a == kWorld) continue;
    keys.push_back(body_pair_key(row.joint.body_a, row.joint.body_b));
    // What may break bears less where contacts bear some of it.
    if (row.joint.type == JointType::kFixed && !row.traits.breaks) groups.weld(row.joint.body_a, row.joint.body_b);
  }
  const std::vector<std::uint64_t> within = groups.pairs();
  keys.insert(keys.end(), within.begin(), within.end());
  return keys;
}

void JointStore::upload(const Table<BodyMass>& masses) {
  code_ = needed_code();
  std::vector<std::uint32_t> slots;
  std::vector<Join> joins;
  const auto moving = [&](std::uint32_t body) { return is_pushed(body, masses) ? body : kWorld; };
  for (std::uint32_t slot = 0; slot < rows_.size(); ++slot) {
    const Row& row = rows_[slot];
    if (!row.used || !(is_pushed(row.joint.body_a, masses) || is_pushed(row.joint.body_b, masses))) continue;
    slots.push_back(slot);
    joins.emplace_back(moving(row.joint.body_a), moving(row.joint.body_b));
  }
  const JointElimination found = eliminator_.eliminate(joins, kWorld);

  ordered_.clear();
  ordered_.reserve(slots.size());
  mechanism_of_.clear();
  std::unordered_set<std::uint32_t> no_chains;
  std::vector<JointAxes> ordered_axes;
  const auto put = [&](std::uint32_t j) {
    const Row& row = rows_[slots[j]];
    ordered_.push_back(row.joint);
    const bool is_stiff = row.traits.locks_turns, is_long = found.length[j] >= kLongBeam;
    ordered_.back().in_chain = found.length[j] >= kLongChain;
    ordered_.back().in_ring = found.in_loop[j];
    ordered_.back().in_loop = found.in_loop[j] || (is_stiff && (is_long || !both_turn(row.joint, masses)));
    mechanism_of_.push_back(found.mechanism[j]);
    if (found.is_closed[j] || has_limits(row.joint, row.axes)) no_chains.insert(found.mechanism[j]);
    if (code_ == JointCode::kAll) ordered_axes.push_back(row.axes);
  };
  for (const std::uint32_t j : found.one_by_one) put(j);
  base_ = static_cast<std::uint32_t>(ordered_.size());
  for (const std::uint32_t j : found.order) put(j);
  for (std::uint32_t j = 0; j < ordered_.size(); ++j)
    if (no_chains.contains(mechanism_of_[j])) ordered_[j].in_chain = false;
  count_ = static_cast<std::uint32_t>(ordered_.size());
  levels_ = static_cast<std::uint32_t>(found.level_first.size() - 1);
  copy(level_first_, found.level_first);
  copy(entries_, found.entries);
  copy(column_first_, found.column_first);
  copy(row_entries_, found.row_entries);
  copy(row_first_, found.row_first);
  copy(products_, found.products);
  copy(product_first_, found.product_first);
  colour(masses);
  list_pushed_bodies(masses);
  list_mechanisms(masses.size());
  copy(joints_, ordered_);
  work_.grow(count_);
  impulses_.grow(rows_.size());
  scaled_.grow(found.entries.size());
  whole_.grow(found.entries.size());
  changes_.grow(3);
  if (code_ == JointCode::kAll) {
    copy(axes_, ordered_axes);
    axis_work_.grow(count_);
    reactions_.grow(rows_.size());
  }
  changed_ = false;
}

std::vector<SolvedJoint> JointStore::solved() const {
  std::vector<SolvedJoint> joints;
  if (count_ == 0) return joints;
  const std::vector<std::uint32_t> list = by_colour_.to_host(count_), first = first_.to_host(kJointColours + 1);
  for (std::uint32_t colour = 0; colour < colours_; ++colour)
    for (std::uint32_t i = first[colour]; i < first[colour + 1]; ++i)
      joints.push_back({ordered_[list[i]].slot, overflow_ && colour + 1 == colours_ ? kJointColours : colour});
  return joints;
}

JointSet JointStore::set(const Bodies& bodies, const SolverBodies& solver, bool gyroscopic) {
  const JointView view = {bodies,    solver, joints_.data(), work_.data(), impulses_.data(), least_moment_.data(),
                          gyroscopic};
  const JointSystem system = {view,
                              base_,
                              levels_,
                              level_first_.data(),
                              entries_.data(),
                              column_first_.data(),
                              row_entries_.data(),
                              row_first_.data(),
                              products_.data(),
                              product_first_.data(),
                              scaled_.data(),
                              whole_.data(),
                              pushed_count_,
                              pushed_.data(),
                              pushed_first_.data(),
                              on_body_.data(),
                              changes_.data()};
  const JointColours colours = {by_colour_.data(), first_.data(), system_first_.data(), colours_, overflow_};
  const AxisParts axes = {axes_.data(), drives.device(), axis_work_.data(), reactions_.data()};
  return {view, count_, colours, system, axes};
}

}  // namespace plumb::impulse
